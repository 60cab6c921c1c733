"""``variables``: numbers that are others for each student, and small arithmetic with them: ``2*$P + 10 N``.

The arithmetic has a parser of its own, no ``eval``: numbers and names with ``+ - * /`` and brackets, in exact
fractions. What follows it is the unit.
"""

from __future__ import annotations

import re
from collections.abc import Mapping as Named
from fractions import Fraction
from functools import lru_cache

from icsolve.case.expected import Variable
from icsolve.read.document import Mapping, Node, Scalar, Sequence, is_null
from icsolve.read.names import Problems, is_name, shown, suggestion, why_no_name

_TOKEN = re.compile(
    r"\s*(?:(\$[^\W\d_][\w']*|\$\{[^\W\d_][\w']*\})"
    r"|(\d+(?:\.\d*)?(?:[eE][-+]?\d{1,3})?|\.\d+)"
    r"|([-+*/()]))"
)
_NUMBER = re.compile(r"[-+]?(?:\d{1,400}(?:\.\d{0,400})?|\.\d{1,400})(?:[eE][-+]?(\d+))?", re.ASCII)
_NAME = re.compile(r"\$([^\W\d_][\w']*)|\$\{([^\W\d_][\w']*)\}")
_LARGEST = 305
"""Decimal exponent that no number of a case exceeds, up or down."""
_DEEPEST = 30
_LONGEST = 400


class FormulaError(ValueError):
    """Arithmetic that can't be read; the message says what to write."""


@lru_cache(maxsize=4096)
def exact(text: str) -> Fraction:
    """The number, or the fraction of two, that a text says; exact, and of a size that a case may have.

    Raises FormulaError. What is longer, or has an exponent of more than three digits, is never worked out.
    """
    parts = text.strip().replace("−", "-").split("/")
    found = [_NUMBER.fullmatch(part.strip()) for part in parts]
    if len(parts) > 2 or not all(found):
        raise FormulaError(f"'{text[:40]}' is not a bare number; in arithmetic the choices must be")
    if any(len(number.group(1) or "") > 3 for number in found if number):
        raise FormulaError(f"'{text[:40]}' is too large or too small for a mechanism")
    above, below = Fraction(parts[0].strip()), Fraction(parts[1].strip() if len(parts) == 2 else 1)
    if below == 0:
        raise FormulaError("division by zero")
    return _sized(above / below, f"'{text[:40]}'")


def _sized(value: Fraction, what: str) -> Fraction:
    if value and not 1 <= abs(value) * 10**_LARGEST <= 10 ** (2 * _LARGEST):
        raise FormulaError(f"{what} is too {'large' if abs(value) > 1 else 'small'} for a mechanism")
    return value


def names_in(text: str) -> list[str]:
    """The variables that a text names."""
    return [first or second for first, second in _NAME.findall(text)]


def named(text: str) -> str:
    """A text with the name of each variable in the place of its value."""
    return _NAME.sub(lambda name: name[1] or name[2], text)


def values_told(values: Named[str, str]) -> str:
    """Variables with their values, for a sentence: ``P = 250, a = 1.25``."""
    return ", ".join(f"{name} = {value}" for name, value in values.items())


def replaced(text: str, values: Named[str, str]) -> tuple[str, Fraction | None]:
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
    digits = decimal(_sized(value, "its value"))
    return f"{digits} {unit}".strip(), None if Fraction(digits) == value else value


def decimal(value: Fraction) -> str:
    """The shortest decimal of a fraction: exact where it has one of few digits, else 17 digits."""
    for places in range(19) if abs(value) < 10**15 else ():
        if 10**places % value.denominator == 0:
            return _placed(int(value * 10**places), places)
    try:
        return repr(float(value))
    except OverflowError:
        raise FormulaError("the arithmetic gives a number that is too large") from None


def _placed(digits: int, places: int) -> str:
    sign, text = ("-" if digits < 0 else ""), str(abs(digits)).rjust(places + 1, "0")
    return f"{sign}{text[: len(text) - places]}.{text[len(text) - places :]}" if places else f"{sign}{text}"


class _Parser:
    """Reads a sum from the start of a text; ``at`` is where it ends."""

    def __init__(self, text: str, values: Named[str, str]) -> None:
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
            return exact(self.values[name.strip("${}")])
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


_FORM = "as in {P: {range: [100, 500], step: 10}, a: {choices: [1.5, 2, 2.5]}}"
_TEXTS = ("title", "source", "reconstructed")
_LEFT_OUT = ("icsolve", "units", "variables")
MOST = 1_000_000
"""Values of one variable."""


def read_variables(root: Mapping, problems: Problems) -> tuple[Variable, ...]:
    """The variables of a case, in the order of the file."""
    section = root.items.get("variables")
    if section is None or is_null(section):
        return ()
    if type(section) is not Mapping:
        problems.refuse(section.mark, f"'variables' should be a mapping, {_FORM}")
        return ()
    found = (_variable(name, node, section.keys[name], problems) for name, node in section.items.items())
    return tuple(variable for variable in found if variable is not None)


def _variable(name: str, node: Node, mark: tuple[int, int], problems: Problems) -> Variable | None:
    if not is_name(name) or not name[0].isalpha():
        problems.refuse(
            mark,
            f"{shown(name)} is not a name of a variable, a letter first: {why_no_name(name, is_key=True)}",
        )
        return None
    try:
        return _range_or_choices(name, node)
    except ValueError as error:
        problems.refuse(node.mark, f"the variable {name}: {error}")
        return None


def _range_or_choices(name: str, node: Node) -> Variable:
    keys = set(node.items) if type(node) is Mapping else set()
    if type(node) is not Mapping or keys not in ({"choices"}, {"range", "step"}):
        raise ValueError("it has either 'choices: [...]', or 'range: [low, high]' and 'step'")
    if "choices" in keys:
        choices = _texts(node.items["choices"])
        if not choices:
            raise ValueError("there is nothing to choose")
        return Variable(name, choices=choices)
    ends = _texts(node.items["range"])
    step = _texts(Sequence([node.items["step"]], node.mark))[0]
    if len(ends) != 2:
        raise ValueError("a range has two ends, as in [100, 500]")
    start, stop, width = (_fraction(text) for text in (*ends, step))
    if width <= 0 or stop < start:
        raise ValueError("a range goes from the lower to the higher number, in steps above zero")
    if (stop - start) / width >= MOST:
        raise ValueError(f"there are more than {MOST} values in it")
    return Variable(name, start=ends[0], stop=ends[1], step=step)


def _texts(node: Node) -> tuple[str, ...]:
    if type(node) is not Sequence or not all(type(item) is Scalar and item.text for item in node.items):
        raise ValueError("there should be a list of values")
    return tuple(item.text for item in node.items if type(item) is Scalar)


def _fraction(text: str) -> Fraction:
    try:
        value = exact(text) if "/" not in text else None
    except FormulaError:
        value = None
    if value is None or abs(value) > 10**30:
        raise ValueError(f"{shown(text)} is not a number; its unit stands where it is used, as in '$P lbf'")
    return value


def count(variable: Variable) -> int:
    """How many values it can take."""
    if variable.choices:
        return len(variable.choices)
    start, stop, step = (exact(text) for text in (variable.start, variable.stop, variable.step))
    return int((stop - start) // step) + 1


def value_at(variable: Variable, index: int) -> str:
    """Its value of an index, as text; exact."""
    if variable.choices:
        return variable.choices[index]
    return decimal(exact(variable.start) + index * exact(variable.step))


def first_values(variables: tuple[Variable, ...]) -> dict[str, str]:
    """The values that a case is solved with where none are said."""
    return {variable.name: value_at(variable, 0) for variable in variables}


def substitute(
    root: Mapping, variables: tuple[Variable, ...], given: Named[str, str], problems: Problems
) -> None:
    """Put values in for ``$names`` throughout the tree; those that are not given take their first.

    The title tells the values, so that no answer stands without them.
    """
    section = root.keys.get("variables", root.mark)
    names = [variable.name for variable in variables]
    for name in given:
        if name not in names:
            problems.refuse(section, f"there is no variable {shown(name)}{suggestion(name, names)}")
    values = first_values(variables) | dict(given)
    stated = root.items.get("variables")  # of what can't be read in it nothing more is to be said
    used = set(stated.items) - set(names) if type(stated) is Mapping else set()
    for key, node in root.items.items():
        if key not in _LEFT_OUT:
            root.items[key] = _put_in(node, values, used, problems, key in _TEXTS)
    for name in names:
        if name not in used:
            problems.refuse(section, f"the variable {name} is used nowhere; write ${name} where it stands")
    if variables:
        _tell(root, values)


def _tell(root: Mapping, values: dict[str, str]) -> None:
    title = root.items.get("title")
    text = title.text if type(title) is Scalar else ""
    mark = title.mark if title is not None else root.mark
    root.items["title"] = Scalar(f"{text} ({values_told(values)})".strip(), False, mark)


def _put_in(node: Node, values: dict[str, str], used: set[str], problems: Problems, free: bool) -> Node:
    """The node with its variables put in; in ``free`` text nothing is worked out."""
    if type(node) is Sequence:
        return Sequence([_put_in(item, values, used, problems, free) for item in node.items], node.mark)
    if type(node) is Mapping:
        items = {key: _put_in(item, values, used, problems, free) for key, item in node.items.items()}
        return Mapping(items, node.keys, node.mark)
    assert type(node) is Scalar
    names = names_in(node.text)
    if not names:
        return node
    unknown = [name for name in names if name not in values]
    if unknown:
        if unknown[0] not in used:
            problems.refuse(node.mark, f"there is no variable ${unknown[0]}{suggestion(unknown[0], values)}")
        return Scalar("1", node.plain, node.mark)
    used.update(() if free else names)
    try:
        if free:
            text = _NAME.sub(lambda name: values.get(name[1] or name[2], name[0]), node.text)
            return Scalar(text, node.plain, node.mark)
        text, exact = replaced(node.text, values)
        return Scalar(text, node.plain, node.mark, exact)
    except FormulaError as error:
        problems.refuse(node.mark, f"{shown(node.text)}: {error}")
        return Scalar("1", node.plain, node.mark)
