"""Formulas as values, written out as plain text, LaTeX or MathML.

A formula is a chain of expressions with ``=`` between: symbols, then this case's numbers, then the result.
"""

from __future__ import annotations

from typing import NamedTuple


class Num(NamedTuple):
    """A number with the digits that are shown: ``-1.18``, ``1.2e-05``."""

    digits: str


class Name(NamedTuple):
    """A symbol with what stands low: w and 4, h and P."""

    base: str
    low: str = ""


class Span(NamedTuple):
    """The distance between two points or centres."""

    a: Name
    b: Name


class Product(NamedTuple):
    """Factors, multiplied."""

    factors: tuple[Expr, ...]


class Quotient(NamedTuple):
    """One over another."""

    over: Expr
    under: Expr


class Sum(NamedTuple):
    """Terms, each with its sign: 1 or -1."""

    terms: tuple[tuple[int, Expr], ...]


class Trig(NamedTuple):
    """``sin`` or ``cos`` of an angle in degrees (a difference, or one number or symbol)."""

    function: str
    angle: Expr


class Root(NamedTuple):
    """A square root."""

    of: Expr


class Square(NamedTuple):
    """A square."""

    of: Expr


class Quantity(NamedTuple):
    """A number with its unit."""

    number: Num
    unit: str


Expr = Num | Name | Span | Product | Quotient | Sum | Trig | Root | Square | Quantity


class Equation(NamedTuple):
    """Expressions that are equal."""

    sides: tuple[Expr, ...]


def product(*factors: Expr) -> Expr:
    """Factors, without what is 1 where others stand; products in it are taken apart; one factor is itself."""
    flat = tuple(g for f in factors for g in (f.factors if isinstance(f, Product) else (f,)))
    kept = tuple(f for f in flat if f != Num("1")) or flat[:1]
    return kept[0] if len(kept) == 1 else Product(kept)


def minus(expression: Expr) -> Expr:
    """The opposite."""
    return Sum(((-1, expression),))


def is_negative(expression: Expr) -> bool:
    """Whether it is written with a sign in front."""
    if isinstance(expression, Num):
        return expression.digits.startswith("-")
    if isinstance(expression, Product):
        return is_negative(expression.factors[0])
    return isinstance(expression, Sum) and expression.terms[0][0] < 0


def needs_brackets(child: Expr, *, factor: bool) -> bool:
    """Whether a part is set in brackets: sums among factors, and what is negative after another sign."""
    if isinstance(child, Sum):
        return factor or is_negative(child)
    return is_negative(child)


# --- plain text ----------------------------------------------------------------------------------------


def plain(expression: Expr) -> str:
    """``w4 = 1.5 x 2 / 3``: ASCII, in the order in which a calculator takes it."""
    match expression:
        case Num():
            return expression.digits
        case Quantity():
            return f"{expression.number.digits} {expression.unit}".rstrip()
        case Name():
            return name_text(expression)
        case Span():
            return f"|{name_text(expression.a)} {name_text(expression.b)}|"
        case Product():
            return " x ".join(_plain_factor(f, n) for n, f in enumerate(expression.factors))
        case Quotient():
            return f"{_plain_factor(expression.over, 0)} / {_plain_under(expression.under)}"
        case Sum():
            return _plain_sum(expression)
        case Trig():
            return f"{expression.function}({_degrees(expression.angle)})"
        case Root():
            return f"sqrt({plain(expression.of)})"
        case Square():
            inner = plain(expression.of)
            return (
                f"({inner})^2"
                if isinstance(expression.of, Sum) or is_negative(expression.of)
                else f"{inner}^2"
            )


def _degrees(angle: Expr) -> str:
    return f"{plain(angle)} deg"


def name_text(name: Name) -> str:
    """``w4``, ``h_P``, ``w_crank``."""
    short = name.low[:1].isdigit() or not name.low
    return f"{name.base}{name.low}" if short else f"{name.base}_{name.low}"


def _plain_factor(child: Expr, place: int) -> str:
    brackets = needs_brackets(child, factor=True) and not (isinstance(child, Num) and place == 0)
    brackets = brackets or (isinstance(child, Quotient) and place > 0)
    return f"({plain(child)})" if brackets else plain(child)


def _plain_under(child: Expr) -> str:
    compound = isinstance(child, Product | Quotient | Sum) or is_negative(child)
    return f"({plain(child)})" if compound else plain(child)


def _plain_sum(expression: Sum) -> str:
    parts = []
    for n, (sign, term) in enumerate(expression.terms):
        first = n == 0 and sign > 0
        text = plain(term) if first or not needs_brackets(term, factor=False) else f"({plain(term)})"
        text = f"({plain(term)})" if isinstance(term, Sum) and not first else text
        lead = ("" if sign > 0 else "-") if n == 0 else (" + " if sign > 0 else " - ")
        parts.append(lead + text)
    return "".join(parts)


def plain_equation(equation: Equation) -> str:
    """All sides with `` = `` between."""
    return " = ".join(plain(side) for side in equation.sides)
