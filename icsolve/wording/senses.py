"""The sense of a load in words, and its unit."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from icsolve.case import Case, Force, Load, Spring, Torque, Toward, Weight

if TYPE_CHECKING:
    from icsolve.statics.power import Wrench


def sense_of(w: Wrench, value: float) -> str:
    """Sense of a load with this value: ``ccw``, ``at 210 deg``, ``toward A``, ``pull``; '' for zero."""
    if value == 0.0:
        return ""
    match w.load:
        case Torque():
            return "ccw" if (value > 0) == (w.load.turns == "ccw") else "cw"
        case Spring():
            return "pull" if value * float(w.gain) > 0 else "push"
        case Force(link=link) if link.startswith("@"):
            return "pull" if value > 0 else "push"
        case Force(heading=Toward() as heading):
            if w.load.against is not None:
                return "pull" if (value > 0) != heading.away else "push"
            if (value > 0) != heading.away:
                return f"toward {heading.point}"
    degrees = _heading(w) if value > 0 else (_heading(w) + 180.0) % 360.0
    return f"at {round(degrees, 6) % 360.0:.6g} deg"


def _heading(w: Wrench) -> float:
    """Direction of the unit force of a wrench, degrees in [0, 360)."""
    return math.degrees(math.atan2(-w.unit[0], w.unit[1])) % 360.0


def unit_of(load: Load, case: Case) -> str:
    """Unit in which a load's number is given and printed."""
    match load:
        case Torque():
            return case.units.torque
        case Weight(mass=True):
            return "kg"
        case Spring():
            return f"{case.units.force}/{case.units.length}"
    return case.units.force
