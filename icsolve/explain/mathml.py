"""Formulas as MathML, which browsers set without a library or a network."""

from __future__ import annotations

from html import escape

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

GREEK = {"w": "\N{GREEK SMALL LETTER OMEGA}"}
TIMES, MINUS = "\N{DOT OPERATOR}", "\N{MINUS SIGN}"


def mathml(expression: Expr) -> str:
    """An expression as MathML."""
    match expression:
        case Num():
            return _number(expression.digits)
        case Quantity():
            unit = expression.unit.replace("*", "\N{MIDDLE DOT}")
            return _number(expression.number.digits) + (
                f'<mspace width="0.3em"/><mtext>{escape(unit)}</mtext>'
            )
        case Name():
            return name_mathml(expression)
        case Span():
            ends = name_mathml(expression.a) + name_mathml(expression.b)
            return f"<mrow><mo>|</mo>{ends}<mo>|</mo></mrow>"
        case Product():
            return _product(expression)
        case Quotient():
            return f"<mfrac>{_row(expression.over)}{_row(expression.under)}</mfrac>"
        case Sum():
            return _sum(expression)
        case Trig():
            return _trig(expression)
        case Root():
            return f"<msqrt>{mathml(expression.of)}</msqrt>"
        case Square():
            inner = mathml(expression.of)
            wide = isinstance(expression.of, Sum) or is_negative(expression.of)
            return f"<msup>{_bracketed(inner) if wide else f'<mrow>{inner}</mrow>'}<mn>2</mn></msup>"


def _number(digits: str) -> str:
    mantissa, _, exponent = digits.partition("e")
    text = f"<mn>{mantissa.lstrip('-')}</mn>"
    if exponent:
        text += f"<mo>{TIMES}</mo><msup><mn>10</mn><mn>{int(exponent)}</mn></msup>"
    return f"<mrow><mo>{MINUS}</mo>{text}</mrow>" if mantissa.startswith("-") else text


def name_mathml(name: Name) -> str:
    """A symbol with what stands low."""
    base = f"<mi>{escape(GREEK.get(name.base, name.base))}</mi>"
    return f"<msub>{base}<mtext>{escape(name.low)}</mtext></msub>" if name.low else base


def _row(expression: Expr) -> str:
    return f"<mrow>{mathml(expression)}</mrow>"


def _bracketed(inner: str) -> str:
    return f"<mrow><mo>(</mo>{inner}<mo>)</mo></mrow>"


def _product(expression: Product) -> str:
    parts = []
    for n, factor in enumerate(expression.factors):
        brackets = needs_brackets(factor, factor=True) and not (isinstance(factor, Num) and n == 0)
        parts.append(_bracketed(mathml(factor)) if brackets else mathml(factor))
    symbols = all(isinstance(f, Name | Span) for f in expression.factors)
    return ('<mspace width="0.17em"/>' if symbols else f"<mo>{TIMES}</mo>").join(parts)


def _sum(expression: Sum) -> str:
    text = ""
    for n, (sign, term) in enumerate(expression.terms):
        first = n == 0 and sign > 0
        brackets = not first and (isinstance(term, Sum) or needs_brackets(term, factor=False))
        lead = "" if first else f"<mo>{'+' if sign > 0 else MINUS}</mo>"
        text += lead + (_bracketed(mathml(term)) if brackets else mathml(term))
    return text


def _trig(expression: Trig) -> str:
    inner = mathml(expression.angle)
    wide = isinstance(expression.angle, Sum) or is_negative(expression.angle)
    mark = "" if isinstance(expression.angle, Name) else "<mi>\N{DEGREE SIGN}</mi>"
    angle = _bracketed(inner) + mark if wide else inner + mark
    return f'<mrow><mi>{expression.function}</mi><mspace width="0.17em"/>{angle}</mrow>'


def mathml_equation(equation: Equation, *, block: bool = True) -> str:
    """A whole formula."""
    sides = "<mo>=</mo>".join(_row(side) for side in equation.sides)
    return f"<math{' display=' + chr(34) + 'block' + chr(34) if block else ''}>{sides}</math>"
