"""Power at a speed as a load: the torque that transmits it; units of a torque by way of a power."""

from __future__ import annotations

import re

from icsolve.case import Number
from icsolve.read.document import Mapping, Scalar
from icsolve.read.entry import Entry
from icsolve.units import DIMENSIONS, ONE, UNITS, Unit, exactly, nearest, quotient, split_quantity


def torque_number(entry: Entry) -> Number | None:
    """Power over speed in the case's unit of torque, rounded once; None, with the reason noted.

    Positive power at a positive speed is a positive torque, which drives its link; a negative power is taken
    out of the link.
    """
    node = entry.node.items["power"]
    entry.need("speed", "the angular speed at which the power is transmitted, such as 1500 rpm")
    speed = entry.number("speed", "angular speed")
    if type(node) is Mapping or (type(node) is Scalar and node.text == "unknown"):
        said = "is a number with its unit; what is to find is a torque, `torque: unknown`"
        entry.refuse(node.mark, f"the power of {entry.what} {said}")
        return None
    power = entry.value(node, "power", entry.path, "power")
    if power is None or speed is None or type(node) is not Scalar:
        return None
    if speed.value == 0.0:
        entry.refuse(entry.mark("speed"), f"at the speed 0 {entry.what} would need an endless torque")
        return None
    if power.exact is None:
        entry.refuse(node.mark, f"the power of {entry.what} carries its unit: W, kW or hp")
        return None
    numeral = split_quantity(speed.digits)
    assert numeral is not None
    exact = quotient(power.exact, speed.exact or exactly(numeral[0]))
    value = nearest(exact)
    per_power = value / power.value if power.value else 1.0
    half = abs(per_power) * power.half
    return Number(value, half, entry.path, power.digits, per_power * power.factor, exact)


def is_through_speed(unit: Unit, text: str, dimension: str) -> bool:
    """Whether a unit is of power by way of a torque at an angular speed, or of torque by way of a power.

    ``hp/rpm`` is a torque, ``lbf*ft*rpm`` a power. ``N*m/rad`` has the dimension of ``hp/rpm`` and is none:
    it is the stiffness of a torsion spring.
    """
    if dimension == "power":
        return unit.dims == (2, 1, -3, 1)
    words = re.findall(r"[^\W\d_]+", text)
    by_power = any((UNITS.get(w) or UNITS.get(w.lower(), ONE)).dims == DIMENSIONS["power"] for w in words)
    return dimension == "torque" and unit.dims == (2, 1, -2, -1) and by_power
