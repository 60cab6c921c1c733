"""Quantities: units by name, their dimensions, and conversion that rounds once.

A unit is an exact ratio of integers to the SI unit of its dimension, times a power of pi (degrees,
revolutions). A numeral is converted by one division of integers, which Python rounds correctly, so
``30 mm`` in a case in metres is the double nearest to 0.03. Factors: NIST SP 811, appendix B
(international foot and pound, standard gravity, horsepower of 550 ft*lbf/s).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from operator import ge, gt, lt
from typing import TYPE_CHECKING, Any

from icsolve.tuples import NamedTuple

if TYPE_CHECKING:
    from decimal import Decimal

Dimension = tuple[int, int, int, int]
"""Powers of length, mass, time and angle."""
ExactRatio = tuple[int, int, int]
"""``num / den * pi**power``, exactly."""

DIMENSIONS: dict[str, Dimension] = {
    "number": (0, 0, 0, 0),
    "length": (1, 0, 0, 0),
    "mass": (0, 1, 0, 0),
    "time": (0, 0, 1, 0),
    "angle": (0, 0, 0, 1),
    "force": (1, 1, -2, 0),
    "torque": (2, 1, -2, 0),
    "stiffness": (0, 1, -2, 0),
    "speed": (1, 0, -1, 0),
    "angular speed": (0, 0, -1, 1),
    "acceleration": (1, 0, -2, 0),
    "power": (2, 1, -3, 0),
    "pitch": (-1, 0, 0, 0),
    "pressure": (-1, 1, -2, 0),
    "area": (2, 0, 0, 0),
    "torsional stiffness": (2, 1, -2, -1),
    "moment of inertia": (2, 1, 0, 0),
    "angular acceleration": (0, 0, -2, 1),
}

_PI = (314159265358979323846264338327950288419716939937510582097494, 10**59)
_LONGEST = 80
"""Characters of a unit's text; no quantity of mechanics needs more."""


class UnitError(ValueError):
    """Text that is not a unit or a quantity; the message says what to write."""


class Unit(NamedTuple):
    """``num / den * pi**pi`` SI units of dimension ``dims``."""

    num: int
    den: int
    pi: int
    dims: Dimension


class Numeral(NamedTuple):
    """A decimal numeral ``mantissa * 10**exponent``; ``digits`` as written."""

    digits: str
    mantissa: int
    exponent: int


_POUND = (44482216152605, 10**13)  # lbf in N
_TABLE: tuple[tuple[str, int, int, int, str], ...] = (
    ("m metre metres meter meters", 1, 1, 0, "length"),
    ("mm millimetre millimetres millimeter millimeters", 1, 1000, 0, "length"),
    ("cm centimetre centimetres centimeter centimeters", 1, 100, 0, "length"),
    ("km kilometre kilometres kilometer kilometers", 1000, 1, 0, "length"),
    ("in inch inches", 127, 5000, 0, "length"),
    ("ft foot feet", 381, 1250, 0, "length"),
    ("yd yard yards", 1143, 1250, 0, "length"),
    ("N newton newtons Newton Newtons", 1, 1, 0, "force"),
    ("kN kilonewton kilonewtons", 1000, 1, 0, "force"),
    ("MN meganewton meganewtons", 10**6, 1, 0, "force"),
    ("lbf lb lbs lbsf pound pounds", *_POUND, 0, "force"),
    ("kip kips", _POUND[0] * 1000, _POUND[1], 0, "force"),
    ("ozf oz ounce ounces", _POUND[0], _POUND[1] * 16, 0, "force"),
    ("kgf", 980665, 10**5, 0, "force"),
    ("tonf", _POUND[0] * 2000, _POUND[1], 0, "force"),
    ("kg kilogram kilograms", 1, 1, 0, "mass"),
    ("g gram grams", 1, 1000, 0, "mass"),
    ("t tonne tonnes", 1000, 1, 0, "mass"),
    ("lbm", 45359237, 10**8, 0, "mass"),
    ("slug slugs", _POUND[0] * 1250, _POUND[1] * 381, 0, "mass"),
    ("rad radian radians", 1, 1, 0, "angle"),
    ("deg ° º ˚ degree degrees", 1, 180, 1, "angle"),
    ("rev revolution revolutions r turn turns", 2, 1, 1, "angle"),
    ("s sec secs second seconds", 1, 1, 0, "time"),
    ("min mins minute minutes", 60, 1, 0, "time"),
    ("h hr hrs hour hours", 3600, 1, 0, "time"),
    ("W watt watts Watt Watts", 1, 1, 0, "power"),
    ("kW kilowatt kilowatts", 1000, 1, 0, "power"),
    ("hp horsepower", 550 * _POUND[0] * 381, _POUND[1] * 1250, 0, "power"),
    ("rpm", 1, 30, 1, "angular speed"),
    ("Pa pascal pascals", 1, 1, 0, "pressure"),
    ("kPa kilopascal kilopascals", 1000, 1, 0, "pressure"),
    ("MPa megapascal megapascals", 10**6, 1, 0, "pressure"),
    ("bar bars", 10**5, 1, 0, "pressure"),
    ("psi", _POUND[0] * 5000**2, _POUND[1] * 127**2, 0, "pressure"),
    ("ksi", 1000 * _POUND[0] * 5000**2, _POUND[1] * 127**2, 0, "pressure"),
)
_EITHER_CASE = frozenset(
    "in inch inches ft foot feet yd lbf lb lbs lbm kip kips ozf oz kgf tonf slug slugs deg rev rpm hp psi "
    "ksi bar".split()
)
"""Names without a prefix that case could change: ``RPM``, ``LBF``, ``In`` are what they seem."""


def _names() -> dict[str, Unit]:
    """Every name and spelling of a single unit, and the torques that people write as one word."""
    found = {}
    for names, num, den, pi, kind in _TABLE:
        unit = Unit(num, den, pi, DIMENSIONS[kind])
        for name in names.split():
            found[name] = unit
    for forces, lengths in (("N kN MN", "m cm mm"), ("lb lbf lbs kip", "in ft"), ("in ft", "lb lbf lbs kip")):
        for first in forces.split():
            for second in lengths.split():
                found[first + second] = times(found[first], found[second])
    return found


def times(a: Unit, b: Unit, power: int = 1) -> Unit:
    """The unit ``a * b**power``, power 1 or -1."""
    num, den = (b.num, b.den) if power > 0 else (b.den, b.num)
    dims = tuple(p + power * q for p, q in zip(a.dims, b.dims, strict=True))
    return Unit(a.num * num, a.den * den, a.pi + power * b.pi, dims)  # type: ignore[arg-type]


ONE = Unit(1, 1, 0, DIMENSIONS["number"])
UNITS = _names()
LISTED = {name for names, *_ in _TABLE for name in names.split()[:1]} | {"lb"}
"""The names by which a result shows a unit; other spellings are shown as the one they stand for."""

_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_PRODUCT = frozenset("*·⋅∙•×.- ")
_cache: dict[str, Unit] = {}


def parse_unit(text: str) -> Unit:
    """The unit that ``text`` names: words, products and quotients of words.

    Raises
    ------
    UnitError
        An unknown word, or text that is no product or quotient of words.
    """
    text = text.strip()
    unit = UNITS.get(text) or _cache.get(text)
    if unit is None:
        if len(text) > _LONGEST:
            raise UnitError("the unit's text is too long")
        unit, rest = _product(text, text)
        if rest:
            raise UnitError(f"'{text}' is not a unit: nothing fits before '{rest}'")
        _cache[text] = unit
    return unit


def _product(text: str, whole: str) -> tuple[Unit, str]:
    """Factors with their signs of operation, left to right, up to ``)`` or the end; and what is left."""
    unit, text = (ONE, text.lstrip()) if text.lstrip().startswith("/") else _factor(text, whole)
    while text and not text.startswith(")"):
        power, text = _operator(text, whole)
        factor, text = _factor(text, whole)
        unit = times(unit, factor, power)
    return unit, text


def _operator(text: str, whole: str) -> tuple[int, str]:
    """1 for a product, -1 for a quotient; and the text after it."""
    rest = text.lstrip()
    spaced = len(rest) < len(text)
    if rest.startswith("/"):
        return -1, rest[1:]
    if rest.startswith("per ") and spaced:
        return -1, rest[4:]
    if rest.startswith("**"):
        raise UnitError(f"'{whole}' is not a unit: a power follows its word directly, as in 's^2'")
    if rest and rest[0] in _PRODUCT:
        return 1, rest[1:]
    if spaced or rest.startswith("("):
        return 1, rest
    raise UnitError(f"'{whole}' is not a unit: '{rest[0]}' is out of place")


def _factor(text: str, whole: str) -> tuple[Unit, str]:
    """One word, bracket or the 1 of ``1/s``, raised to its power; and the text after it."""
    text = text.lstrip()
    if text.startswith("("):
        unit, rest = _product(text[1:], whole)
        if not rest.startswith(")"):
            raise UnitError(f"'{whole}' is not a unit: a bracket is not closed")
        rest = rest[1:]
    elif text.startswith("1") and text[1:].lstrip().startswith("/"):
        return ONE, text[1:]
    else:
        end = next((i for i, c in enumerate(text) if not (c.isalpha() or c in "°˚")), len(text))
        unit, rest = word(text[:end], whole), text[end:]
        if rest[:1] == "." and text[:end].lower() in _SHORTENED and not rest[1:2].isalpha():
            rest = rest[1:]
    power, rest = _power(rest, whole)
    return _raised(unit, power), rest


def _power(text: str, whole: str) -> tuple[int, str]:
    """The power at the start of the text (``^2``, ``**2``, ``²``, ``2``; else 1); and the rest."""
    mark = 2 if text.startswith("**") else 1 if text.startswith("^") else 0
    body = text[mark:].translate(_SUPERSCRIPTS)
    signed = (mark or text[:1] == "⁻") and body[:1] in ("-", "+")
    end = 1 if signed else 0
    while end < len(body) and body[end] in "0123456789":
        end += 1
    digits = body[:end]
    if not digits and not mark:
        return 1, text
    if len(digits.lstrip("-+")) != 1:
        raise UnitError(f"'{whole}' is not a unit: a power is one digit, as in 's^2'")
    return int(digits), text[mark + end :]


def _raised(unit: Unit, power: int) -> Unit:
    result = ONE
    for _ in range(abs(power)):
        result = times(result, unit, 1 if power > 0 else -1)
    return result


_SHORTENED = {"in", "ft", "yd", "lb", "lbs", "lbf", "oz", "sec", "min", "deg", "rev"}
"""Words that may end with a full stop, as in ``in.-lb`` and ``20 lb/in.``."""


def word(name: str, whole: str) -> Unit:
    """One unit by its name or spelling."""
    unit = UNITS.get(name)
    if unit is None and name.lower() in _EITHER_CASE:
        unit = UNITS[name.lower()]
    if unit is None:
        raise UnitError(_unknown(name, whole))
    return unit


_MEANT = {
    "ton": "'tonf' (2000 lbf) or 't' (1000 kg)",
    "tons": "'tonf' (2000 lbf) or 't' (1000 kg)",
    "lbm's": "'lbm'",
    "atm": "'bar' (1 atm is 1.01325 bar)",
    "at": "'bar' (1 at is 0.980665 bar)",
    **{name: f"'kPa' (1 {name} is 0.133322 kPa)" for name in ("mmHg", "Torr")},
    **dict.fromkeys(("blob", "blobs", "slinch"), "'lbf*s^2/in'"),
    "psf": "'lbf/ft^2'",
    "ksf": "'kip/ft^2'",
    **dict.fromkeys(("kp", "kilopond"), "'kgf'"),
    **{name: f"'kgf' (1 {name} is 0.001 kgf)" for name in ("p", "gf")},
    "dyn": "'N' (1 dyn is 0.00001 N)",
    **{name: f"'kW' (1 {name} is 0.73549875 kW)" for name in ("PS", "CV", "ch")},
    "mi": "'ft' (1 mi is 5280 ft)",
    **{name: f"'in' (1 {name} is 0.001 in)" for name in ("mil", "thou")},
    "stone": "'lbm' (1 stone is 14 lbm)",
    "gon": "'deg' (1 gon is 0.9 deg)",
    "arcmin": "'deg' (1 arcmin is 0.0166667 deg)",
    **dict.fromkeys(("U", "Umdr"), "'rev'"),
    **dict.fromkeys(("Hz", "rps"), "'rev/s'"),
    "K": "'kip' or 'kN'",
    "k": "'kip' or 'kN'",
    **{f"{prefix}J": f"'{prefix}N*m'" for prefix in ("", "k", "M")},
    **dict.fromkeys(("d", "o", "Grad", "grad"), "'deg'"),
}
"""What stands for a unit that there is elsewhere, with its ratio where it is another."""
_PREFIXES = {"da": "10", "d": "0.1", "h": "100", "k": "1000", "M": "1000000", "G": "1000000000", "c": "0.01"}
_PREFIXES |= {"m": "0.001", "n": "0.000000001", **dict.fromkeys("u\u00b5\u03bc", "0.000001")}
_PREFIXED = ("m", "g", "N", "Pa", "W", "bar", "t", "rad", "s")


def _unknown(name: str, whole: str) -> str:
    if not name:
        return f"'{whole}' is not a unit"
    meant = _MEANT.get(name) or " or ".join(_like(name))
    return f"there is no unit '{name}'" + (f"; did you mean {meant}?" if meant else "")


def _like(name: str) -> list[str]:
    """Units of which one may be meant: with other capitals, the unit that a prefix multiplies, one much like
    it."""
    from difflib import get_close_matches

    found = [f"'{unit}'" for unit in UNITS if unit.lower() == name.lower()][:1]
    for unit in _PREFIXED:
        many = _PREFIXES.get(name.removesuffix(unit))
        if name.endswith(unit) and many is not None:
            return [*found, f"'{unit}' (1 {name} is {many} {unit})"]
    return found or [f"'{unit}'" for unit in get_close_matches(name, list(UNITS), 1, 0.6)]


_MOST_DIGITS = 320


def _signed(text: str) -> tuple[str, str, str]:
    """The sign at the start of a text, the digits after it, and the rest."""
    bare = text[1:] if text[:1] in ("-", "+", "−") else text
    rest = bare.lstrip("0123456789")
    return text[: len(text) - len(bare)].replace("−", "-"), bare[: len(bare) - len(rest)], rest


def split_quantity(text: str) -> tuple[Numeral, str] | None:
    """The numeral at the start of a text and the unit after it; None where no numeral stands.

    Raises
    ------
    UnitError
        A numeral of too many digits.
    """
    sign, whole, rest = _signed(text)
    after, decimals, end = _signed(rest[1:]) if rest[:1] == "." else ("", "", rest)
    if after or not (whole or decimals):
        decimals, end = "", rest[1:] if rest[:1] == "." else rest
    if not (whole or decimals):
        return None
    minus, power, behind = _signed(end[1:]) if end[:1] in ("e", "E") else ("", "", "")
    end = behind if power else end
    digits = text[: len(text) - len(end)].replace("−", "-")
    if len(digits) > _MOST_DIGITS or len(minus + power) > 5:
        raise UnitError("the numeral is too long: a number has at most 17 digits that count")
    exponent = int(minus + power) if power else 0
    mantissa = int(sign + whole + decimals)
    return Numeral(digits, mantissa, exponent - len(decimals)), end.strip()


def exact_ratio(unit: Unit, target: Unit) -> ExactRatio:
    """How many ``target`` make one ``unit``."""
    return unit.num * target.den, unit.den * target.num, unit.pi - target.pi


def factor(unit: Unit, target: Unit) -> float:
    """The same, rounded once."""
    return nearest(exact_ratio(unit, target))


def exactly(numeral: Numeral, by: ExactRatio = (1, 1, 0)) -> ExactRatio:
    """A numeral, times a ratio."""
    num, den, power = by
    tens: int = 10 ** abs(numeral.exponent)
    if numeral.exponent >= 0:
        return numeral.mantissa * num * tens, den, power
    return numeral.mantissa * num, den * tens, power


def quotient(a: ExactRatio, b: ExactRatio) -> ExactRatio:
    """a over b."""
    return a[0] * b[1], a[1] * b[0], a[2] - b[2]


def nearest(exact: ExactRatio) -> float:
    """The nearest double (pi to 60 digits).

    Raises
    ------
    OverflowError
        The value is beyond a double.
    """
    num, den, power = exact
    if power:
        top, bottom = _PI if power > 0 else _PI[::-1]
        num, den = num * top ** abs(power), den * bottom ** abs(power)
    return num / den


def converted(numeral: Numeral, unit: Unit, target: Unit) -> float:
    """The numeral, in ``unit``, as the nearest double in ``target``."""
    return nearest(exactly(numeral, exact_ratio(unit, target)))


def canonical(name: str) -> str:
    """The listed name of a single unit: ``inches`` gives ``in``; ``lb`` stays."""
    if name in LISTED:
        return name
    unit = word(name, name)
    return next(names.split()[0] for names, *_ in _TABLE if UNITS[names.split()[0]] == unit)


def kind_of(dims: Dimension) -> str | None:
    """The name of a dimension, None where it has none."""
    return next((kind for kind, value in DIMENSIONS.items() if value == dims), None)


# --- a number as the case gives it ----------------------------------------------------------------------


class Number(NamedTuple):
    """A number that the case gives.

    ``value`` is the nearest double in case units, ``half`` half a unit of the last decimal
    that was written (case units), ``path`` its place (``lengths.AB``, ``loads.P.angle``),
    ``digits`` the numeral as written and ``factor`` case units per written unit. ``exact`` is the value as
    it was meant, where that is not the decimal ``digits``: a unit was converted, or arithmetic gave it.
    ``bound`` names what any number in its place keeps to (`BOUNDS`), ``dimension`` what it is a number of
    (``angle``, ``length``, ...), which has a unit in each case.
    """

    value: float
    half: float
    path: str
    digits: str
    factor: float = 1.0
    exact: ExactRatio | None = None
    bound: str = ""
    dimension: str = ""

    def written(self, show: Callable[[float], str]) -> str:
        """The digits of the file, where they are of its value in case units; else as ``show`` has it."""
        return self.digits if self.factor == 1.0 and self.exact is None else show(self.value)


def found_number(exact: Decimal, path: str) -> Number:
    """A number of more digits than anyone writes, which was found."""
    near, (num, den) = float(exact) + 0.0, exact.as_integer_ratio()
    return Number(near, 0.0, path, repr(near), exact=(num, den, 0))


class NumberLimit(NamedTuple):
    """What a number keeps to: it is ``than`` (``>``, ``>=``, ``<``) a value, or ``whole`` and another; and
    what is said of one that does not."""

    than: str
    value: float
    says: str

    def holds(self, number: Any) -> Any:
        """Whether a number, or each of an array (n,), keeps to it."""
        return COMPARISONS[self.than](number, self.value)


COMPARISONS: dict[str, Callable[[Any, float], Any]] = {
    ">": gt,
    ">=": ge,
    "<": lt,
    "whole": lambda number, other: (number % 1.0 == 0.0) & (number != other),
}
_RIGHT = NumberLimit("<", 90.0, "should be less than 90 degrees")
_SOME = NumberLimit(">", 0.0, "should be greater than zero")
_NOT_LESS = NumberLimit(">=", 0.0, "should not be negative")
BOUNDS = {
    "": (),
    "positive": (_SOME,),
    "not negative": (_NOT_LESS,),
    "acute": (_SOME, _RIGHT),
    "acute or zero": (_NOT_LESS, _RIGHT),
    "turns": (_NOT_LESS, NumberLimit("whole", -1.0, "should be whole: the figure shows the part of a turn")),
    "teeth": (NumberLimit("whole", 0.0, "should be whole numbers other than 0"),),
}
"""The limits of a number by the name of what bounds it."""


def numbers_in(*values: object) -> Iterator[Number]:
    """The numbers that values of a case hold, in their order: in tuples, named ones too, and in dicts."""
    left = list(values[::-1])
    while left:
        value = left.pop()
        if isinstance(value, Number):
            yield value
        elif isinstance(value, tuple):
            left += value[::-1]
        elif isinstance(value, dict):
            left += reversed(value.values())
