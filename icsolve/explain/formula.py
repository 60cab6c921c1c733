"""Formulas as values, written out as plain text, LaTeX or MathML.

A formula is a chain of expressions with ``=`` between: symbols, then this case's numbers, then the result.
One walk decides what is set in brackets and which sign stands where; a `Notation` writes the pieces.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from html import escape
from typing import ClassVar

from icsolve.tuples import NamedTuple


class Num(NamedTuple):
    """A number with the digits that are shown: ``-1.18``, ``1.2e-05``."""

    digits: str


class Name(NamedTuple):
    """A symbol with what stands low: w and 4, h and P."""

    base: str
    low: str = ""


class Spanned(NamedTuple):
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
    """``sin``, ``cos`` or ``tan`` of an angle in degrees (a difference, or one number or symbol)."""

    function: str
    angle: Expr


class RootOf(NamedTuple):
    """A square root."""

    of: Expr


class Square(NamedTuple):
    """A square."""

    of: Expr


class Exp(NamedTuple):
    """A power of e."""

    of: Expr


class Quantity(NamedTuple):
    """A number with its unit."""

    number: Num
    unit: str


Expr = Num | Name | Spanned | Product | Quotient | Sum | Trig | RootOf | Square | Exp | Quantity


class ShownEquation(NamedTuple):
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


Terms = Sequence[tuple[int, "Expr"]]
"""Terms of a sum, each with its sign."""


def total(terms: Terms) -> Expr:
    """Terms added up; one that is positive is itself, none are 0."""
    if not terms:
        return Num("0")
    return terms[0][1] if len(terms) == 1 and terms[0][0] > 0 else Sum(tuple(terms))


def solved_for(rest: Terms, factors: Terms) -> Expr:
    """Numbers over numbers, what a factor of the sum of ``factors`` is: no sign stands behind another, none
    in front of all below, and nothing is divided by 1."""
    above, below = _signed(rest), _signed(factors)
    signs = {sign for sign, _ in below}
    if signs == {-1} or (signs == {1, -1} and {sign for sign, _ in above} == {-1}):
        above, below = ([(-sign, term) for sign, term in terms] for terms in (above, below))
    under = total(sorted(below, key=lambda term: -term[0]))
    return total(above) if under == Num("1") else Quotient(total(above), under)


def _signed(terms: Terms) -> list[tuple[int, Expr]]:
    """Terms, the signs of their numbers in front."""
    found = []
    for sign, term in terms:
        factors = term.factors if isinstance(term, Product) else (term,)
        minuses = sum(isinstance(f, Num) and is_negative(f) for f in factors)
        bare = (Num(f.digits.lstrip("-")) if isinstance(f, Num) else f for f in factors)
        found.append((sign * (-1) ** minuses, product(*bare)))
    return found


def is_negative(expression: Expr) -> bool:
    """Whether it is written with a sign in front."""
    if isinstance(expression, Num):
        return expression.digits.startswith("-")
    if isinstance(expression, Product):
        return is_negative(expression.factors[0])
    return isinstance(expression, Sum) and expression.terms[0][0] < 0


def _symbols(angle: Expr) -> bool:
    """Whether an angle is of symbols, not of degrees."""
    parts = [term for _, term in angle.terms] if isinstance(angle, Sum) else [angle]
    return all(isinstance(part, Name) for part in parts)


def needs_brackets(child: Expr, *, factor: bool) -> bool:
    """Whether a part is set in brackets: sums among factors, and what is negative after another sign."""
    if isinstance(child, Sum):
        return factor or is_negative(child)
    return is_negative(child)


# --- how a formula is written -----------------------------------------------------------------------


class Notation(ABC):
    """A way of writing formulas: `expression` goes through the parts, the methods write one piece each."""

    flat = False
    """a quotient stands on the line, so that its parts need brackets"""
    equals = " = "

    def equation(self, equation: ShownEquation) -> str:
        """All sides with the sign of equality between."""
        return self.equals.join(self.side(side) for side in equation.sides)

    def side(self, expression: Expr) -> str:
        """One side of an equation."""
        return self.expression(expression)

    def expression(self, expression: Expr) -> str:
        """An expression with all its parts."""
        match expression:
            case Num():
                return self.number(expression.digits)
            case Quantity():
                return self.quantity(self.number(expression.number.digits), expression.unit)
            case Name():
                return self.name(expression)
            case Spanned():
                return self.span(self.name(expression.a), self.name(expression.b))
            case Product():
                symbols = all(isinstance(f, Name | Spanned) for f in expression.factors)
                return self.product([self._factor(f, n) for n, f in enumerate(expression.factors)], symbols)
            case Quotient():
                return self.quotient(*self._over_and_under(expression))
            case Sum():
                return "".join(self._term(n, *term) for n, term in enumerate(expression.terms))
            case Trig():
                wide = isinstance(expression.angle, Sum) or is_negative(expression.angle)
                degrees = not _symbols(expression.angle)
                return self.trig(expression.function, self.expression(expression.angle), wide, degrees)
            case RootOf():
                return self.root(self.expression(expression.of))
            case Exp():
                return self.exp(self.expression(expression.of))
            case Square():
                inner = self.expression(expression.of)
                wide = isinstance(expression.of, Sum) or is_negative(expression.of)
                return self.square(self.brackets(inner) if wide else inner, wide)

    def _factor(self, child: Expr, place: int) -> str:
        bare = isinstance(child, Num) and place == 0
        brackets = needs_brackets(child, factor=True) and not bare
        brackets = brackets or (self.flat and isinstance(child, Quotient) and place > 0)
        return self.brackets(self.expression(child)) if brackets else self.expression(child)

    def _over_and_under(self, quotient: Quotient) -> tuple[str, str]:
        over, under = self.expression(quotient.over), self.expression(quotient.under)
        if self.flat:
            compound = isinstance(quotient.under, Product | Quotient | Sum) or is_negative(quotient.under)
            return self._factor(quotient.over, 0), self.brackets(under) if compound else under
        return over, under

    def _term(self, place: int, sign: int, term: Expr) -> str:
        first = place == 0 and sign > 0
        brackets = not first and (isinstance(term, Sum) or needs_brackets(term, factor=False))
        text = self.expression(term)
        return ("" if first else self.sign(sign, place)) + (self.brackets(text) if brackets else text)

    @abstractmethod
    def number(self, digits: str) -> str:
        """A number; ``1.2e-05`` is a power of ten."""

    @abstractmethod
    def quantity(self, number: str, unit: str) -> str:
        """A number with its unit."""

    @abstractmethod
    def name(self, name: Name) -> str:
        """A symbol with what stands low."""

    @abstractmethod
    def span(self, a: str, b: str) -> str:
        """A distance."""

    @abstractmethod
    def product(self, factors: Sequence[str], symbols: bool) -> str:
        """Factors; of ``symbols`` alone without a sign between."""

    @abstractmethod
    def quotient(self, over: str, under: str) -> str:
        """One over another."""

    @abstractmethod
    def sign(self, sign: int, place: int) -> str:
        """The sign in front of a term."""

    @abstractmethod
    def brackets(self, inner: str) -> str:
        """What is taken together."""

    @abstractmethod
    def trig(self, function: str, angle: str, wide: bool, degrees: bool) -> str:
        """A sine or cosine; ``wide``: of more than one number, ``degrees``: of a number."""

    @abstractmethod
    def root(self, inner: str) -> str:
        """A square root."""

    @abstractmethod
    def exp(self, inner: str) -> str:
        """A power of e."""

    @abstractmethod
    def square(self, inner: str, wide: bool) -> str:
        """A square, of something that has its brackets where it is ``wide``."""


class Plain(Notation):
    """``w4 = 1.5 x 2 / 3``: ASCII, in the order in which a calculator takes it."""

    flat = True

    def number(self, digits: str) -> str:
        return digits

    def quantity(self, number: str, unit: str) -> str:
        return f"{number} {unit}".rstrip()

    def name(self, name: Name) -> str:
        short = name.low[:1].isdigit() or not name.low
        return f"{name.base}{name.low}" if short else f"{name.base}_{name.low}"

    def span(self, a: str, b: str) -> str:
        return f"|{a} {b}|"

    def product(self, factors: Sequence[str], symbols: bool) -> str:
        return " x ".join(factors)

    def quotient(self, over: str, under: str) -> str:
        return f"{over} / {under}"

    def sign(self, sign: int, place: int) -> str:
        return "-" if place == 0 else " + " if sign > 0 else " - "

    def brackets(self, inner: str) -> str:
        return f"({inner})"

    def trig(self, function: str, angle: str, wide: bool, degrees: bool) -> str:
        return f"{function}({angle}{' deg' if degrees else ''})"

    def root(self, inner: str) -> str:
        return f"sqrt({inner})"

    def exp(self, inner: str) -> str:
        return f"exp({inner})"

    def square(self, inner: str, wide: bool) -> str:
        return f"{inner}^2"


GREEK = {
    "w": "\N{GREEK SMALL LETTER OMEGA}",
    "phi": "\N{GREEK SMALL LETTER PHI}",
    "alpha": "\N{GREEK SMALL LETTER ALPHA}",
    "beta": "\N{GREEK SMALL LETTER BETA}",
    "lambda": "\N{GREEK SMALL LETTER LAMDA}",
    "mu": "\N{GREEK SMALL LETTER MU}",
    "pi": "\N{GREEK SMALL LETTER PI}",
}
"""Symbols by their names in plain text."""


class Latex(Notation):
    """LaTeX, as Markdown has it between dollars."""

    greek: ClassVar = {name: rf"\{name}" for name in GREEK} | {"w": r"\omega", "phi": r"\varphi"}

    def number(self, digits: str) -> str:
        mantissa, _, exponent = digits.partition("e")
        return rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else mantissa

    def quantity(self, number: str, unit: str) -> str:
        words = unit.replace("*", r"\!\cdot\!").replace(" ", r"\ ")
        return rf"{number}\ \mathrm{{{words}}}" if unit else number

    def name(self, name: Name) -> str:
        """Names of more than one letter stand upright."""
        letter = _safe(name.base) if len(name.base) == 1 else _roman(name.base)
        base = self.greek.get(name.base) or letter
        if not name.low:
            return base
        low = name.low if name.low.isdigit() or len(name.low) == 1 else _roman(name.low)
        return f"{base}_{{{low}}}"

    def span(self, a: str, b: str) -> str:
        return rf"\overline{{{a}\,{b}}}"

    def product(self, factors: Sequence[str], symbols: bool) -> str:
        return (r"\," if symbols else r" \cdot ").join(factors)

    def quotient(self, over: str, under: str) -> str:
        return rf"\frac{{{over}}}{{{under}}}"

    def sign(self, sign: int, place: int) -> str:
        return "-" if place == 0 else " + " if sign > 0 else " - "

    def brackets(self, inner: str) -> str:
        return rf"\left({inner}\right)"

    def trig(self, function: str, angle: str, wide: bool, degrees: bool) -> str:
        if wide:
            return rf"\{function}{self.brackets(angle)}^\circ"
        return rf"\{function} {angle}{'^' + chr(92) + 'circ' if degrees else ''}"

    def root(self, inner: str) -> str:
        return rf"\sqrt{{{inner}}}"

    def exp(self, inner: str) -> str:
        return rf"e^{{{inner}}}"

    def square(self, inner: str, wide: bool) -> str:
        return f"{inner}^{{2}}"


def _roman(text: str) -> str:
    return rf"\mathrm{{{_safe(text)}}}"


def _safe(text: str) -> str:
    """A name of a case: letters, digits, ``_`` and primes."""
    return text.replace("_", r"\_").replace("'", r"{}^{\prime}")


class MathML(Notation):
    """MathML, which browsers set without a library or a network."""

    equals = "<mo>=</mo>"
    greek: ClassVar = GREEK
    times, minus = "\N{DOT OPERATOR}", "\N{MINUS SIGN}"

    def side(self, expression: Expr) -> str:
        return f"<mrow>{self.expression(expression)}</mrow>"

    def number(self, digits: str) -> str:
        mantissa, _, exponent = digits.partition("e")
        text = f"<mn>{mantissa.lstrip('-')}</mn>"
        if exponent:
            text += f"<mo>{self.times}</mo><msup><mn>10</mn><mn>{int(exponent)}</mn></msup>"
        return f"<mrow><mo>{self.minus}</mo>{text}</mrow>" if mantissa.startswith("-") else text

    def quantity(self, number: str, unit: str) -> str:
        words = escape(unit.replace("*", "\N{MIDDLE DOT}"))
        return f'{number}<mspace width="0.3em"/><mtext>{words}</mtext>'

    def name(self, name: Name) -> str:
        base = f"<mi>{escape(self.greek.get(name.base, name.base))}</mi>"
        return f"<msub>{base}<mtext>{escape(name.low)}</mtext></msub>" if name.low else base

    def span(self, a: str, b: str) -> str:
        return f"<mrow><mo>|</mo>{a}{b}<mo>|</mo></mrow>"

    def product(self, factors: Sequence[str], symbols: bool) -> str:
        return ('<mspace width="0.17em"/>' if symbols else f"<mo>{self.times}</mo>").join(factors)

    def quotient(self, over: str, under: str) -> str:
        return f"<mfrac><mrow>{over}</mrow><mrow>{under}</mrow></mfrac>"

    def sign(self, sign: int, place: int) -> str:
        return f"<mo>{'+' if sign > 0 else self.minus}</mo>"

    def brackets(self, inner: str) -> str:
        return f"<mrow><mo>(</mo>{inner}<mo>)</mo></mrow>"

    def trig(self, function: str, angle: str, wide: bool, degrees: bool) -> str:
        mark = "<mi>\N{DEGREE SIGN}</mi>" if degrees else ""
        whole = (self.brackets(angle) if wide else angle) + mark
        return f'<mrow><mi>{function}</mi><mspace width="0.17em"/>{whole}</mrow>'

    def root(self, inner: str) -> str:
        return f"<msqrt>{inner}</msqrt>"

    def exp(self, inner: str) -> str:
        return f"<msup><mi>e</mi><mrow>{inner}</mrow></msup>"

    def square(self, inner: str, wide: bool) -> str:
        return f"<msup>{inner if wide else f'<mrow>{inner}</mrow>'}<mn>2</mn></msup>"


PLAIN, LATEX, MATHML = Plain(), Latex(), MathML()
