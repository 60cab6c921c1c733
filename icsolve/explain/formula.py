"""Formulas as values, written out as plain text, LaTeX or MathML.

A formula is a chain of expressions with ``=`` between: symbols, then this case's numbers, then the result.
One walk decides what is set in brackets and which sign stands where; a `Notation` writes the pieces.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from html import escape

from icsolve.numbers import turn_of
from icsolve.tuples import NamedTuple


class Num(NamedTuple):
    """A number with the digits that are shown: ``-1.18``, ``1.2e-05``; ``value`` is all of it, where more may
    be shown. What is shown alike is equal."""

    digits: str
    value: float | None = None

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Num) and self.digits == other.digits

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(self.digits)


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


class Of(NamedTuple):
    """A function of an expression: ``sin``, ``cos`` or ``tan`` of an angle in degrees (a difference, or one
    number or symbol), ``sqrt``, ``square`` or ``exp``."""

    function: str
    of: Expr


class Quantity(NamedTuple):
    """A number with its unit."""

    number: Num
    unit: str


Expr = Num | Name | Spanned | Product | Quotient | Sum | Of | Quantity


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
    """Terms added up; one that is positive is itself, one number has its sign, none are 0."""
    if not terms:
        return Num("0")
    if len(terms) > 1:
        return Sum(tuple(terms))
    ((sign, term),) = terms
    if sign < 0 and isinstance(term, Num) and not is_negative(term):
        return Num(f"-{term.digits}", None if term.value is None else -term.value)
    return term if sign > 0 else Sum(tuple(terms))


def quotient(above: Expr, below: Expr) -> Expr:
    """One over another; nothing is divided by 1."""
    return above if below == Num("1") else Quotient(above, below)


def solved_for(rest: Terms, factors: Terms) -> Expr:
    """Numbers over numbers, what a factor of the sum of ``factors`` is: no sign stands behind another, none
    in front of all below, and nothing is divided by 1."""
    above, below = _signed(rest), _signed(factors)
    signs = {sign for sign, _ in below}
    if signs == {-1} or (signs == {1, -1} and {sign for sign, _ in above} == {-1}):
        above, below = ([(-sign, term) for sign, term in terms] for terms in (above, below))
    under = total(sorted(below, key=lambda term: -term[0]))
    return quotient(total(above), under)


def _signed(terms: Terms) -> list[tuple[int, Expr]]:
    """Terms, the signs of their numbers in front."""
    found = []
    for sign, term in terms:
        factors = term.factors if isinstance(term, Product) else (term,)
        minuses = sum(isinstance(f, Num) and is_negative(f) for f in factors)
        bare = (_unsigned(f) if isinstance(f, Num) else f for f in factors)
        found.append((sign * (-1) ** minuses, product(*bare)))
    return found


def _unsigned(number: Num) -> Num:
    return Num(number.digits.lstrip("-"), None if number.value is None else abs(number.value))


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


def needs_brackets(child: Expr) -> bool:
    """Whether a part is set in brackets: a sum, and what has a sign in front."""
    return isinstance(child, Sum) or is_negative(child)


# --- what a formula comes to ------------------------------------------------------------------------


def names_in(expression: Expr) -> set[Expr]:
    """The symbols of an expression."""
    match expression:
        case Name("pi") | Num() | Quantity():
            return set()
        case Name() | Spanned():
            return {expression}
        case Product(parts):
            return set().union(*map(names_in, parts))
        case Quotient(over, under):
            return names_in(over) | names_in(under)
        case Sum(terms):
            return set().union(*(names_in(term) for _, term in terms))
        case Of(_, of):
            return names_in(of)


def worth(expression: Expr) -> float:
    """What an expression comes to by its digits as they are shown, each symbol taken as 1."""
    match expression:
        case Num(digits):
            return float(digits)
        case Quantity(number):
            return worth(number)
        case Name(base):
            return math.pi if base == "pi" else 1.0
        case Spanned():
            return 1.0
        case Product(factors):
            return math.prod(map(worth, factors))
        case Quotient(over, under):
            below = worth(under)
            return worth(over) / below if below else math.inf
        case Sum(terms):
            return math.fsum(sign * worth(term) for sign, term in terms)
        case Of(function, of):
            return WORTH[function](worth(of))


def largest(expression: Expr) -> float:
    """What an expression comes to at most, were all that it adds up of one sign."""
    match expression:
        case Product(factors):
            return math.prod(map(largest, factors))
        case Quotient(over, under):
            below = abs(worth(under))
            return largest(over) / below if below else math.inf
        case Sum(terms):
            return math.fsum(largest(term) for _, term in terms)
    return abs(worth(expression))


def _tangent(degrees: float) -> float:
    co, s = turn_of(degrees)
    return s / co if co else 0.0


WORTH: dict[str, Callable[[float], float]] = {
    "sin": lambda degrees: turn_of(degrees)[1],
    "cos": lambda degrees: turn_of(degrees)[0],
    "tan": _tangent,
    "sqrt": lambda value: math.sqrt(max(value, 0.0)),
    "square": lambda value: value**2,
    "exp": math.exp,
}
"""What functions come to."""


def rewritten(expression: Expr, shown: Callable[[float], Num]) -> Expr:
    """An expression with its numbers shown another way."""

    def again(part: Expr) -> Expr:
        return rewritten(part, shown)

    match expression:
        case Num(_, value):
            return expression if value is None else shown(value)
        case Quantity(number, unit):
            return expression if number.value is None else Quantity(shown(number.value), unit)
        case Product(factors):
            return Product(tuple(map(again, factors)))
        case Quotient(over, under):
            return Quotient(again(over), again(under))
        case Sum(terms):
            return Sum(tuple((sign, again(term)) for sign, term in terms))
        case Of(function, of):
            return Of(function, again(of))
        case Name() | Spanned():
            return expression


# --- how a formula is written -----------------------------------------------------------------------


class Notation(NamedTuple):
    """A way of writing formulas: `expression` goes through the parts, each piece is set in its text."""

    number: Callable[[str], str]
    """digits; ``1.2e-05`` is a power of ten"""
    name: Callable[[str, str], str]
    """a symbol and what stands low"""
    unit: Callable[[str], str]
    quantity: str
    span: str
    signs: tuple[str, str, str]
    """a minus in front of all, plus and minus between"""
    times: str
    beside: str
    """between symbols that are multiplied"""
    quotient: str
    brackets: str
    trig: str
    """function, angle, sign of degrees"""
    degrees: str
    functions: dict[str, str]
    """the others"""
    apart: str = ""
    """between a function and an angle without brackets"""
    equals: str = " = "
    whole: str = "{}"
    """a side of an equation"""
    flat: bool = False
    """a quotient stands on the line, so that its parts need brackets, and a function has them"""

    def equation(self, sides: Iterable[Expr]) -> str:
        """Expressions that are equal, with the sign of equality between."""
        return self.equals.join(map(self.side, sides))

    def side(self, expression: Expr) -> str:
        """One side of an equation."""
        return self.whole.format(self.expression(expression))

    def expression(self, expression: Expr) -> str:
        """An expression with all its parts."""
        match expression:
            case Num():
                return self.number(expression.digits)
            case Quantity(number, unit):
                said = self.number(number.digits)
                return self.quantity.format(said, self.unit(unit)) if unit else said
            case Name():
                return self.name(*expression)
            case Spanned(a, b):
                return self.span.format(self.name(*a), self.name(*b))
            case Product(factors):
                symbols = all(isinstance(f, Name | Spanned) for f in factors)
                written = [self._factor(f, n) for n, f in enumerate(factors)]
                return (self.beside if symbols else self.times).join(written)
            case Quotient():
                return self.quotient.format(*self._over_and_under(expression))
            case Sum(terms):
                return "".join(self._term(n, *term) for n, term in enumerate(terms))
            case Of("sin" | "cos" | "tan" as function, angle):
                mark = "" if _symbols(angle) else self.degrees
                text, inner = self._grouped(angle, needed=not self.flat), self.expression(angle)
                return self.trig.format(function, self.apart + text if text == inner else text, mark)
            case Of(function, of):
                return self.functions[function].format(self._grouped(of, needed=function == "square"))

    def _grouped(self, inner: Expr, *, needed: bool = True) -> str:
        """A part, in the brackets that it needs."""
        return self._within(inner, needed and needs_brackets(inner))

    def _within(self, inner: Expr, brackets: bool) -> str:
        text = self.expression(inner)
        return self.brackets.format(text) if brackets else text

    def _factor(self, child: Expr, place: int) -> str:
        bare = isinstance(child, Num) and place == 0
        brackets = needs_brackets(child) and not bare
        return self._within(child, brackets or (self.flat and isinstance(child, Quotient) and place > 0))

    def _over_and_under(self, quotient: Quotient) -> tuple[str, str]:
        over, under = quotient
        if self.flat:
            compound = isinstance(under, Product | Quotient | Sum) or is_negative(under)
            return self._factor(over, 0), self._within(under, compound)
        return self.expression(over), self.expression(under)

    def _term(self, place: int, sign: int, term: Expr) -> str:
        first = place == 0 and sign > 0
        mark = "" if first else self.signs[1 if sign > 0 else 0 if place == 0 else 2]
        return mark + self._within(term, not first and needs_brackets(term))


# --- plain text, LaTeX, MathML ----------------------------------------------------------------------


def _plain_name(base: str, low: str) -> str:
    letters = "w" if base == OMEGA else base
    return f"{letters}{low}" if low[:1].isdigit() or not low else f"{letters}_{low}"


OMEGA = "omega"
"""An angular velocity, a w in plain text: the loads of books are w too."""
PLAIN = Notation(
    number=str,
    name=_plain_name,
    unit=str,
    quantity="{} {}",
    span="|{} {}|",
    signs=("-", " + ", " - "),
    times=" x ",
    beside=" x ",
    quotient="{} / {}",
    brackets="({})",
    trig="{}({}{})",
    degrees=" deg",
    functions={"sqrt": "sqrt({})", "exp": "exp({})", "square": "{}^2"},
    flat=True,
)
"""``w4 = 1.5 x 2 / 3``: ASCII, in the order in which a calculator takes it."""
GREEK = {
    OMEGA: "\N{GREEK SMALL LETTER OMEGA}",
    "phi": "\N{GREEK SMALL LETTER PHI}",
    "alpha": "\N{GREEK SMALL LETTER ALPHA}",
    "beta": "\N{GREEK SMALL LETTER BETA}",
    "lambda": "\N{GREEK SMALL LETTER LAMDA}",
    "mu": "\N{GREEK SMALL LETTER MU}",
    "pi": "\N{GREEK SMALL LETTER PI}",
}
"""Symbols by their names in plain text."""
_LATEX = {name: rf"\{name}" for name in GREEK} | {"phi": r"\varphi"}


def _latex_number(digits: str) -> str:
    mantissa, _, exponent = digits.partition("e")
    return rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else mantissa


def _latex_name(base: str, low: str) -> str:
    """Names of more than one letter stand upright."""
    symbol = _LATEX.get(base) or _letters(base, len(base) == 1)
    return f"{symbol}_{{{_letters(low, low.isdigit() or len(low) == 1)}}}" if low else symbol


def _letters(text: str, plain: bool) -> str:
    """A name of a case: letters, digits, ``_`` and primes; of several joints at a point with what tells them
    apart."""
    safe = text.replace("_", r"\_").replace("'", r"{}^{\prime}").replace(" ", r"\ ")
    return safe if plain else rf"\mathrm{{{safe}}}"


LATEX = Notation(
    number=_latex_number,
    name=_latex_name,
    unit=lambda unit: unit.replace("*", r"\!\cdot\!").replace(" ", r"\ "),
    quantity=r"{}\ \mathrm{{{}}}",
    span=r"\overline{{{}\,{}}}",
    signs=("-", " + ", " - "),
    times=r" \cdot ",
    beside=r"\,",
    quotient=r"\frac{{{}}}{{{}}}",
    brackets=r"\left({}\right)",
    trig=r"\{}{}{}",
    apart=" ",
    degrees=r"^\circ",
    functions={"sqrt": r"\sqrt{{{}}}", "exp": "e^{{{}}}", "square": "{}^{{2}}"},
)
"""LaTeX, as Markdown has it between dollars."""
_DOT, _MINUS = "<mo>\N{DOT OPERATOR}</mo>", "<mo>\N{MINUS SIGN}</mo>"


def _mathml_number(digits: str) -> str:
    mantissa, _, exponent = digits.partition("e")
    text = f"<mn>{mantissa.lstrip('-')}</mn>"
    if exponent:
        text += f"{_DOT}<msup><mn>10</mn><mn>{int(exponent)}</mn></msup>"
    return f"<mrow>{_MINUS}{text}</mrow>" if mantissa.startswith("-") else text


def _mathml_name(base: str, low: str) -> str:
    symbol = f"<mi>{escape(GREEK.get(base, base))}</mi>"
    return f"<msub>{symbol}<mtext>{escape(low)}</mtext></msub>" if low else symbol


MATHML = Notation(
    number=_mathml_number,
    name=_mathml_name,
    unit=lambda unit: escape(unit.replace("*", "\N{MIDDLE DOT}")),
    quantity='{}<mspace width="0.3em"/><mtext>{}</mtext>',
    span="<mrow><mo>|</mo>{}{}<mo>|</mo></mrow>",
    signs=(_MINUS, "<mo>+</mo>", _MINUS),
    times=_DOT,
    beside='<mspace width="0.17em"/>',
    quotient="<mfrac><mrow>{}</mrow><mrow>{}</mrow></mfrac>",
    brackets="<mrow><mo>(</mo>{}<mo>)</mo></mrow>",
    trig='<mrow><mi>{}</mi><mspace width="0.17em"/>{}{}</mrow>',
    degrees="<mi>\N{DEGREE SIGN}</mi>",
    functions={
        "sqrt": "<msqrt>{}</msqrt>",
        "exp": "<msup><mi>e</mi><mrow>{}</mrow></msup>",
        "square": "<msup><mrow>{}</mrow><mn>2</mn></msup>",
    },
    equals="<mo>=</mo>",
    whole="<mrow>{}</mrow>",
)
"""MathML, which browsers set without a library or a network."""
