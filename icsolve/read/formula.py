"""Small arithmetic with ``$names`` in a quantity: ``$P``, ``2*$P + 10 N``, ``($a - 1)/3 in``.

A parser of its own, no ``eval``: numbers and names with ``+ - * /`` and brackets, in exact fractions.
What follows the arithmetic is the unit.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from fractions import Fraction

_TOKEN = re.compile(
    r"\s*(?:(\$[^\W\d_][\w']*|\$\{[^\W\d_][\w']*\})"
    r"|(\d+(?:\.\d*)?(?:[eE][-+]?\d{1,3})?|\.\d+)"
    r"|([-+*/()]))"
)
_NAME = re.compile(r"\$([^\W\d_][\w']*)|\$\{([^\W\d_][\w']*)\}")
_DEEPEST = 30
_LONGEST = 400


class FormulaError(ValueError):
    """Arithmetic that can't be read; the message says what to write."""


def names_in(text: str) -> list[str]:
    """The variables that a text names."""
    return [first or second for first, second in _NAME.findall(text)]


def with_texts(text: str, values: Mapping[str, str]) -> str:
    """A text with each ``$name`` replaced by what was drawn for it, as in a title."""
    return _NAME.sub(lambda found: values.get(found.group(1) or found.group(2), found.group()), text)


def replaced(text: str, values: Mapping[str, str]) -> tuple[str, Fraction | None]:
    """A quantity with its arithmetic worked out and its unit kept; and the exact number, where that is no
    decimal of few digits.

    Raises FormulaError.
    """
    whole = _NAME.fullmatch(text.strip())
    if whole is not None:
        return values[whole.group(1) or whole.group(2)], None
    if len(text) > _LONGEST:
        raise FormulaError(f"more than {_LONGEST} characters of arithmetic")
    parser = _Parser(text, values)
    value = parser.sum(0)
    unit = text[parser.at :].strip()
    if unit and (unit[0] in "*/)+-$(" or unit[0].isdigit()):
        raise FormulaError(f"'{unit[:20]}' is out of place after the arithmetic")
    digits = decimal(value)
    return f"{digits} {unit}".strip(), None if Fraction(digits) == value else value


def decimal(value: Fraction) -> str:
    """The shortest decimal of a fraction: exact where it has one of few digits, else 17 digits."""
    denominator = value.denominator
    for prime in (2, 5):
        while denominator % prime == 0:
            denominator //= prime
    if denominator == 1 and abs(value) < 10**15:
        places = 0
        while value.denominator != 1 and (value * 10**places).denominator != 1 and places < 18:
            places += 1
        scaled = value * 10**places
        if scaled.denominator == 1:
            return _placed(int(scaled), places)
    try:
        return repr(float(value))
    except OverflowError:
        raise FormulaError("the arithmetic gives a number that is too large") from None


def _placed(digits: int, places: int) -> str:
    sign, text = ("-" if digits < 0 else ""), str(abs(digits)).rjust(places + 1, "0")
    return f"{sign}{text[: len(text) - places]}.{text[len(text) - places :]}" if places else f"{sign}{text}"


class _Parser:
    """Reads a sum from the start of a text; ``at`` is where it ends."""

    def __init__(self, text: str, values: Mapping[str, str]) -> None:
        self.text = text
        self.values = values
        self.at = 0

    def _peek(self) -> re.Match[str] | None:
        return _TOKEN.match(self.text, self.at)

    def _operator(self, allowed: str) -> str:
        """The operator that comes next, if another value follows it: ``* m`` belongs to the unit."""
        token = self._peek()
        if token is None or token.group(3) is None or token.group(3) not in allowed:
            return ""
        after = _TOKEN.match(self.text, token.end())
        if after is None or (after.group(3) is not None and after.group(3) not in "(-+"):
            return ""
        self.at = token.end()
        return token.group(3)

    def sum(self, depth: int) -> Fraction:
        """Products with plus and minus between them."""
        if depth > _DEEPEST:
            raise FormulaError("too many brackets within each other")
        value = self._product(depth)
        while sign := self._operator("+-"):
            other = self._product(depth)
            value = value + other if sign == "+" else value - other
        return value

    def _product(self, depth: int) -> Fraction:
        value = self._factor(depth)
        while sign := self._operator("*/"):
            other = self._factor(depth)
            if sign == "/" and other == 0:
                raise FormulaError("division by zero")
            value = value * other if sign == "*" else value / other
        return value

    def _factor(self, depth: int) -> Fraction:
        token = self._peek()
        if token is None:
            raise FormulaError(f"a number or a $name should stand at '{self.text[self.at :][:20]}'")
        self.at = token.end()
        name, number, mark = token.groups()
        if name is not None:
            return self._value(name)
        if number is not None:
            return Fraction(number)
        if mark in "+-" and depth <= _DEEPEST:
            value = self._factor(depth + 1)
            return -value if mark == "-" else value
        if mark == "(":
            return self._bracket(depth)
        raise FormulaError(f"'{mark}' is out of place in the arithmetic")

    def _bracket(self, depth: int) -> Fraction:
        value = self.sum(depth + 1)
        closing = self._peek()
        if closing is None or closing.group(3) != ")":
            raise FormulaError("a bracket is not closed")
        self.at = closing.end()
        return value

    def _value(self, name: str) -> Fraction:
        text = self.values[name.strip("${}")]
        try:
            return Fraction(text)
        except (ValueError, ZeroDivisionError):
            raise FormulaError(f"'{text}' is not a bare number; in arithmetic the choices must be") from None
