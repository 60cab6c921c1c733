"""What is said of a load's value: its sense, the range in which friction lets it be, its unit."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from icsolve.answer import Found
from icsolve.case import Area, Case, Force, Load, Spring, Stretch, Torque, TorsionSpring, Toward, Weight

if TYPE_CHECKING:
    from icsolve.case.space import Load as SpatialLoad

SPELT = {"ccw": "counterclockwise", "cw": "clockwise"}


def sense_of(load: Load, value: float, gain: float, degrees: float) -> str:
    """Sense of a load with this value, whose unit exerts ``gain`` in the direction ``degrees``: ``ccw``,
    ``at 210 deg``, ``toward A``, ``pull``; '' for zero.
    """
    if value == 0.0:
        return ""
    match load:
        case Torque(link=link) if link.startswith("@"):
            return "cw" if value > 0 else "ccw"
        case Torque():
            return "ccw" if (value > 0) == (load.turns == "ccw") else "cw"
        case TorsionSpring():
            return "ccw" if value * gain > 0 else "cw"
        case Spring():
            return "pull" if value * gain > 0 else "push"
        case Force(link=link) if link.startswith("@"):
            return "pull" if value > 0 else "push"
        case Force(heading=Toward() as heading):
            if load.against is not None:
                return "pull" if (value > 0) != heading.away else "push"
            if (value > 0) != heading.away:
                return f"toward {heading.point}"
    return f"at {round(degrees % 360.0 + (0.0 if value > 0 else 180.0), 6) % 360.0:.6g} deg"


Show = Callable[[float], str]
"""A number with the digits that are wanted."""


def spelt(sense: str, show: Show | None = None) -> str:
    """``ccw`` spelt out; with ``show`` the degrees of ``at 339.778 deg`` by their sign."""
    if show is not None and sense.startswith("at ") and sense.endswith(" deg"):
        return f"at {show(float(sense[3:-4]))}°"
    return SPELT.get(sense, sense)


def reach_of(holds: tuple[float, float], unit: str, show: Show, error: float | None = None) -> str:
    """A range of values: ``from 3 to 4 N``, ``only at 3 N`` where its ends are one within the error."""
    least, most = holds
    if most - least <= 2.0 * (error or 0.0):
        return f"only at {show(least)} {unit}"
    if math.isfinite(least) and math.isfinite(most):
        return f"from {show(least)} to {show(most)} {unit}"
    if math.isfinite(least):
        return f"from {show(least)} {unit} up"
    return f"up to {show(most)} {unit}" if math.isfinite(most) else "at any value"


def holding(found: Found, show: Show) -> str:
    """``holds still from 3 to 4 N``, and whether it locks itself."""
    reach = reach_of(found.holds or (math.nan, math.nan), found.unit, show, found.error)
    return f"holds still {reach}" + (", self-locking" if found.self_locking else "")


def unit_of(load: Load | SpatialLoad, case: Case) -> str:
    """Unit in which a load's number is given and printed."""
    match load:
        case Torque():
            return case.units.torque
        case Weight(mass=True):
            return "kg"
        case Spring() | Force(over=Stretch()):
            return f"{case.units.force}/{case.units.length}"
        case TorsionSpring():
            return f"{case.units.torque}/rad"
        case Force(over=Area()):
            return case.units.pressure
    return case.units.force
