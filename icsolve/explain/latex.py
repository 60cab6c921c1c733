"""Formulas as LaTeX, for Markdown."""

from __future__ import annotations

from icsolve.explain.formula import (
    Equation,
    Expr,
    Name,
    Num,
    Product,
    Quantity,
    Quotient,
    Root,
    Span,
    Square,
    Sum,
    Trig,
    is_negative,
    needs_brackets,
)

GREEK = {"w": r"\omega"}


def latex(expression: Expr) -> str:
    """An expression as LaTeX."""
    match expression:
        case Num():
            return number_latex(expression.digits)
        case Quantity():
            unit = _upright(expression.unit)
            return number_latex(expression.number.digits) + (rf"\ {unit}" if unit else "")
        case Name():
            return name_latex(expression)
        case Span():
            return rf"\overline{{{name_latex(expression.a)}\,{name_latex(expression.b)}}}"
        case Product():
            return _product(expression)
        case Quotient():
            return rf"\frac{{{latex(expression.over)}}}{{{latex(expression.under)}}}"
        case Sum():
            return _sum(expression)
        case Trig():
            return _trig(expression)
        case Root():
            return rf"\sqrt{{{latex(expression.of)}}}"
        case Square():
            inner = latex(expression.of)
            wide = isinstance(expression.of, Sum) or is_negative(expression.of)
            return rf"\left({inner}\right)^{{2}}" if wide else f"{inner}^{{2}}"


def number_latex(digits: str) -> str:
    """``1.2e-05`` as a power of ten."""
    mantissa, _, exponent = digits.partition("e")
    return rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else mantissa


def name_latex(name: Name) -> str:
    """A symbol; names of more than one letter stand upright."""
    base = GREEK.get(name.base) or (_safe(name.base) if len(name.base) == 1 else _roman(name.base))
    if not name.low:
        return base
    low = name.low if name.low.isdigit() or len(name.low) == 1 else _roman(name.low)
    return f"{base}_{{{low}}}"


def _roman(text: str) -> str:
    return rf"\mathrm{{{_safe(text)}}}"


def _safe(text: str) -> str:
    """A name of a case: letters, digits, ``_`` and primes."""
    return text.replace("_", r"\_").replace("'", r"{}^{\prime}")


def _upright(unit: str) -> str:
    words = unit.replace("*", r"\!\cdot\!").replace(" ", r"\ ")
    return rf"\mathrm{{{words}}}" if unit else ""


def _product(expression: Product) -> str:
    parts = []
    for n, factor in enumerate(expression.factors):
        brackets = needs_brackets(factor, factor=True) and not (isinstance(factor, Num) and n == 0)
        parts.append(rf"\left({latex(factor)}\right)" if brackets else latex(factor))
    symbols = all(isinstance(f, Name | Span) for f in expression.factors)
    return (r"\," if symbols else r" \cdot ").join(parts)


def _sum(expression: Sum) -> str:
    text = ""
    for n, (sign, term) in enumerate(expression.terms):
        first = n == 0 and sign > 0
        brackets = not first and (isinstance(term, Sum) or needs_brackets(term, factor=False))
        lead = ("" if sign > 0 else "-") if n == 0 else (" + " if sign > 0 else " - ")
        text += lead + (rf"\left({latex(term)}\right)" if brackets else latex(term))
    return text


def _trig(expression: Trig) -> str:
    angle = latex(expression.angle)
    if isinstance(expression.angle, Sum) or is_negative(expression.angle):
        return rf"\{expression.function}\left({angle}\right)^\circ"
    mark = "" if isinstance(expression.angle, Name) else r"^\circ"
    return rf"\{expression.function} {angle}{mark}"


def latex_equation(equation: Equation) -> str:
    """All sides with ``=`` between."""
    return " = ".join(latex(side) for side in equation.sides)
