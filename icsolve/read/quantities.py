"""A value of the tree to a number in case units."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from icsolve.case import Number, Units
from icsolve.read.document import Mapping, Node, Scalar, is_null
from icsolve.read.problems import Problems, shown, suggestion
from icsolve.read.reading import Reading
from icsolve.units import (
    DIMENSIONS,
    ONE,
    Numeral,
    Unit,
    UnitError,
    canonical,
    exact_ratio,
    exactly,
    factor,
    kind_of,
    nearest,
    parse_unit,
    split_quantity,
    times,
)

if TYPE_CHECKING:
    from fractions import Fraction

SMALLEST, LARGEST = 1e-305, 1e305
"""Magnitudes between which a number stays; the solver scales figures and forces by powers of two."""

_A = {
    "number": "a bare number",
    "angle": "an angle",
    "angular speed": "an angular speed",
    "acceleration": "an acceleration",
    "stiffness": "a stiffness (force per length)",
    "pitch": "a number per length",
    "angular acceleration": "an angular acceleration",
    "path acceleration": "an acceleration",
}


def number(reading: Reading, node: Node, dimension: str, path: str) -> Number | None:
    """The number at ``path`` in case units of its dimension; None, with the reason noted."""
    if type(node) is not Scalar:
        reading.refuse(node.mark, f"{_a(dimension)} should stand here, not a list or mapping")
        return None
    reading.marks[path] = node.mark
    return quantity(reading, node, node.text.strip(), dimension, path)


def quantity(reading: Reading, node: Scalar, text: str, dimension: str, path: str) -> Number | None:
    """As ``number``, of a text that may be a part of the node's."""
    try:
        parts = split_quantity(text)
        if parts is None:
            reading.refuse(node.mark, _no_number(node, text, dimension))
            return None
        return _checked(reading, node, _valued(reading, parts, node.exact, dimension, path))
    except UnitError as error:
        reading.refuse(node.mark, f"{shown(text)}: {error}")
    except OverflowError:
        reading.refuse(node.mark, f"{shown(text)} is too large")
    return None


def _valued(
    reading: Reading, parts: tuple[Numeral, str], worked: Fraction | None, dimension: str, path: str
) -> Number:
    """The numeral in the case's unit; one division, or none where the unit is the case's own.

    ``worked`` is what arithmetic gave, of which the numeral has only the first digits.
    """
    numeral, rest = parts
    places = float(f"5e{numeral.exponent - 1}")
    if not rest:
        if dimension == "mass":
            raise UnitError("a mass carries its unit: kg, g, t, lbm or slug")
        if dimension == "moment of inertia":
            raise UnitError("a moment of inertia carries its unit, such as kg*m^2 or lbm*in^2")
        value = float(numeral.digits)
        if dimension == "angle" and _is_of_radians(value, numeral):
            reading.noticed.append(
                f"{path} is {numeral.digits} degrees; if radians are meant, write {numeral.digits} rad."
            )
        exact = None if worked is None else (worked.numerator, worked.denominator, 0)
        return Number(value, places, path, numeral.digits, 1.0, exact)
    target = reading.targets[dimension]
    unit = _fitting(reading, rest, dimension)
    scale = factor(unit, target)
    exact = exact_ratio(unit, target)
    if worked is None:
        exact = exactly(numeral, exact)
    else:
        exact = (worked.numerator * exact[0], worked.denominator * exact[1], exact[2])
    return Number(nearest(exact), places * scale, path, numeral.digits, scale, exact)


def _is_of_radians(value: float, numeral: Numeral) -> bool:
    """Whether a number is a twelfth of pi or several, as far as three decimals or more tell."""
    twelfth = math.pi / 12.0
    near = abs(value - round(value / twelfth) * twelfth) <= 0.51 * 10.0**numeral.exponent
    return 0.1 < abs(value) < 13.0 and near and (numeral.exponent <= -3 or abs(value) in (1.57, 3.14, 6.28))


def _fitting(reading: Reading, text: str, dimension: str) -> Unit:
    """The unit, of the wanted dimension."""
    if text[0] == "," and text[1:2].isdigit():
        raise UnitError("write a decimal point, not a comma")
    if text[0] in "_'’" and text[1:2].isdigit():
        raise UnitError("write the digits of a number without separators")
    unit = parse_unit(text)
    if unit.dims != reading.targets[dimension].dims:
        from icsolve.read.power import is_through_speed

        if not is_through_speed(unit, text, dimension):
            raise UnitError(_wrong(reading, text, unit, dimension))
    return unit


def _wrong(reading: Reading, text: str, unit: Unit, dimension: str) -> str:
    given = kind_of(unit.dims)
    if dimension == "number":
        return f"a bare number is wanted here, without the unit '{text}'"
    said = f"'{text}' is {_a(given)}" if given else f"'{text}' is no unit of {_a(dimension)}"
    wanted = f"{said}, but {_a(dimension)} is wanted here, such as '{example(reading, dimension)}'"
    if dimension == "mass" and given == "force":
        return f"{wanted}; write 'lbm' for a mass in pounds, or 'weight' in place of 'mass' for a force"
    if dimension == "force" and given == "mass":
        return f"{wanted}; for a weight given by its mass write 'mass' in place of the force"
    if dimension == "torque" and given == "power":
        return f"{wanted}; for a power at a speed write 'power' and 'speed' in place of 'torque'"
    return wanted


def example(reading: Reading, dimension: str) -> str:
    """The unit in which a bare number of the dimension stands."""
    return reading.shown_units[dimension]


def _a(dimension: str | None) -> str:
    return _A.get(dimension or "", f"a {dimension}")


def _checked(reading: Reading, node: Scalar, value: Number) -> Number | None:
    size = abs(value.value)
    zero = value.value == 0.0 and not value.digits.lower().partition("e")[0].strip("+-0.")
    zero = zero and (value.exact is None or value.exact[0] == 0)
    if zero or SMALLEST <= size <= LARGEST:
        return value
    extreme = "large" if size > LARGEST else "small"
    reading.refuse(node.mark, f"{shown(node.text.strip())} is too {extreme} for a mechanism")
    return None


COMPASS = {
    **dict.fromkeys(("right", "rightward", "rightwards", "east", "horizontal", "+x", "x"), 0),
    **dict.fromkeys(("up", "upward", "upwards", "north", "vertical", "+y", "y"), 90),
    **dict.fromkeys(("left", "leftward", "leftwards", "west", "-x"), 180),
    **dict.fromkeys(("down", "downward", "downwards", "south", "-y"), -90),
}
"""Directions in words, and the angle of each."""


def _no_number(node: Scalar, text: str, dimension: str) -> str:
    wanted = _a(dimension)
    if is_null(node):
        return f"{wanted} should stand here, but there is no value"
    if text.lower().lstrip("+-") in (".inf", ".nan", "inf", "nan", "infinity"):
        return f"'{text}' is not a number that a mechanism can have"
    if dimension == "angle" and text.lower() in COMPASS:
        return f"an angle is in degrees counterclockwise from +x: write {COMPASS[text.lower()]} for '{text}'"
    if text == "unknown":
        return f"'unknown' cannot stand here; {wanted} is wanted"
    likely = suggestion(text, ("unknown",))
    return f"{wanted} should stand here, but {shown(text)} does not start with a number{likely}"


def measures(node: Node | None, problems: Problems) -> tuple[Units, dict[str, Unit], dict[str, str]]:
    """The ``units`` section: unit names, the unit of each dimension, and the name of each for messages."""
    names = {"length": "m", "force": "N"}
    if type(node) is Mapping:
        for key, value in node.items.items():
            _unit_of_case(names, key, value, node, problems)
    elif node is not None and not is_null(node):
        problems.refuse(node.mark, "units should be a mapping, as in {length: in, force: lbf}")
    length, force = parse_unit(names["length"]), parse_unit(names["force"])
    product = times(force, length)
    torque_name = names.get("torque", f"{names['force']}*{names['length']}")
    torque = parse_unit(torque_name)
    units = Units(
        names["length"],
        names["force"],
        torque_name,
        factor(product, torque),
        factor(parse_unit("N"), force),
        factor(parse_unit("m"), length),
        exact_ratio(product, torque),
        exact_ratio(parse_unit("N"), force),
    )
    return units, _targets(length, force, torque), _shown(units)


def _unit_of_case(names: dict[str, str], key: str, node: Node, section: Mapping, problems: Problems) -> None:
    wanted = ("length", "force", "torque")
    if key not in wanted:
        problems.refuse(section.keys[key], f"units has no key {shown(key)}{suggestion(key, wanted)}")
        return
    text = node.text.strip() if type(node) is Scalar else ""
    try:
        unit = parse_unit(text)
        if unit.dims != DIMENSIONS[key]:
            given = kind_of(unit.dims)
            raise UnitError(f"'{text}' is {_a(given) if given else 'another kind of unit'}, not {_a(key)}")
        names[key] = _product_name(text) if key == "torque" else canonical(text)
    except UnitError as error:
        problems.refuse(node.mark, str(error) if text else f"a unit of {key} should stand here")


def _product_name(text: str) -> str:
    """A product as it is shown: ``N·m`` and ``N m`` as ``N*m``."""
    return "*".join(text.replace("·", " ").replace("*", " ").split())


def _targets(length: Unit, force: Unit, torque: Unit) -> dict[str, Unit]:
    """The unit of each dimension in which a case's numbers are kept."""
    second = parse_unit("s")
    return {
        "number": ONE,
        "length": length,
        "mass": parse_unit("kg"),
        "time": second,
        "angle": parse_unit("deg"),
        "force": force,
        "torque": torque,
        "stiffness": times(force, length, -1),
        "speed": times(length, second, -1),
        "angular speed": parse_unit("rad/s"),
        "acceleration": parse_unit("m/s^2"),
        "power": times(torque, second, -1),
        "pitch": times(ONE, length, -1),
        "moment of inertia": parse_unit("kg*m^2"),
        "angular acceleration": parse_unit("rad/s^2"),
        "path acceleration": times(times(length, second, -1), second, -1),
    }


def _shown(units: Units) -> dict[str, str]:
    return {
        "length": units.length,
        "mass": "kg",
        "time": "s",
        "angle": "deg",
        "force": units.force,
        "torque": units.torque,
        "stiffness": f"{units.force}/{units.length}",
        "speed": f"{units.length}/s",
        "angular speed": "rad/s",
        "acceleration": "m/s^2",
        "power": "hp",
        "pitch": f"1/{units.length}",
        "moment of inertia": "kg*m^2",
        "angular acceleration": "rad/s^2",
        "path acceleration": f"{units.length}/s^2",
    }
