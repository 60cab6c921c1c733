"""What every load exerts, as force and couple in case units."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

from icsolve.assembly import Frame
from icsolve.case import ForceVector, Like, Load, Torque
from icsolve.construction.known import Known
from icsolve.errors import SceneError
from icsolve.numbers.arithmetic import FLOATS
from icsolve.screws.plane import Point
from icsolve.statics.power import Wrench, known_value, points_of, wrenches
from icsolve.wording.senses import unit_of


class Acting(NamedTuple):
    """A load as it acts on ``link``; the opposite acts on ``against``.

    ``value`` is its number in ``unit`` (None where it was not found, or where it ``holds`` over a range),
    ``gain`` the force (force times
    length for a torque) per unit of it, ``direction`` the unit vector of a force of positive value;
    ``at`` the point's place, None for a torque.
    """

    load: Load
    link: str
    against: str
    at: Point | None
    direction: Point
    gain: float
    value: float | None
    unit: str
    unknown: bool
    holds: tuple[float, float] | None = None

    @property
    def force(self) -> Point:
        """Components of the force in force units; zero for a torque, and where the number is not known."""
        size = 0.0 if self.at is None else (self.value or 0.0) * self.gain
        return (size * self.direction[0], size * self.direction[1])

    @property
    def couple(self) -> float:
        """The torque in force times length, ccw positive; zero for a force."""
        return (self.value or 0.0) * self.gain if self.at is None else 0.0


def acting_loads(known: Known) -> list[Acting]:
    """The loads whose points are known, in order."""
    case = known.case
    placed = [load for load in case.loads if set(points_of(load)) <= set(known.points)]
    names = {load.name for load in placed}
    placed = [load for load in placed if _like(load) in (None, *names)]
    try:
        found = wrenches(replace(case, loads=tuple(placed)), Frame(0.0, 0.0, 1.0), known.points, FLOATS)
    except (SceneError, ZeroDivisionError):
        return []
    return [_acting(known, w) for w in found]


def _like(load: Load) -> str | None:
    """The load whose number a load takes."""
    value = None if isinstance(load, ForceVector) else load.value
    return value.load if isinstance(value, Like) else None


def _acting(known: Known, w: Wrench) -> Acting:
    number = known_value(w)
    found = None if known.answer is None else known.answer.answers.get(w.load.name)
    holds = None if found is None else found.holds
    if number is not None:
        value: float | None = float(w.ratio) * number
    else:
        value = None if found is None or holds is not None else found.value
    torque = isinstance(w.load, Torque)
    at = None if isinstance(w.load, Torque) else known.points[w.load.at]
    gain = float(w.gain) * (float(w.unit[2]) if torque else 1.0)
    direction = (0.0, 0.0) if torque else (float(w.unit[1]), -float(w.unit[0]))
    unit = unit_of(w.load, known.case)
    return Acting(w.load, w.load.link, w.against, at, direction, gain, value, unit, number is None, holds)
