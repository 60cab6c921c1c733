"""What an answer is measured by: its unit, the mechanism's size, its loads, the width of its tolerance."""

from __future__ import annotations

import math

from icsolve.answer import Answer
from icsolve.case import (
    ForceVector,
    Load,
    LoadIs,
    Number,
    RateIs,
    RatioIs,
    ReactionIs,
    SpeedIs,
    Spring,
    Target,
    Tolerance,
    Torque,
    Weight,
)
from icsolve.grade.written import factors_between
from icsolve.grade.written.unit_words import unit_word
from icsolve.units import DIMENSIONS, Unit, parse_unit

TRUE_ZERO = 1e-9
"""Below this part of the loads an answer is zero but for rounding."""
OF_LOADS = 1e-3
"""A true zero is judged against this part of the largest load."""


class NoKeyError(ValueError):
    """A question that has no key; the message says why. ``told`` is what a student may know of it."""

    def __init__(self, why: str, told: str = "") -> None:
        super().__init__(why)
        self.told = told or why


def unit_of_target(target: Target, answer: Answer) -> str:
    """The unit of a target's value in case units; '' for a ratio."""
    from icsolve.sense import unit_of

    units = answer.case.units
    match target:
        case LoadIs(name):
            return unit_of(next(load for load in answer.case.loads if load.name == name), answer.case)
        case RatioIs():
            return ""
        case RateIs():
            return "rad/s"
        case SpeedIs():
            return f"{units.length}/s"
        case ReactionIs(part="moment"):
            return units.torque
        case ReactionIs():
            return units.force
    return units.length


def parsed_unit(name: str) -> Unit:
    """The unit of a name in case units; a bare number for ''."""
    return parse_unit(name) if name else Unit(1, 1, 0, DIMENSIONS["number"])


def size_of(answer: Answer) -> float:
    """The mechanism's size: the diagonal of the box about its points."""
    xs, ys = zip(*answer.points.values(), strict=True) if answer.points else ((0.0, 1.0), (0.0, 0.0))
    return math.hypot(max(xs) - min(xs), max(ys) - min(ys)) or 1.0


def zero_width(target: Target, answer: Answer) -> float:
    """What a true zero is judged against: the largest load (times the size for a torque), 1, or the size."""
    match target:
        case LoadIs(name):
            load = next(load for load in answer.case.loads if load.name == name)
            return (
                OF_LOADS * largest_load(answer) * (_torque_scale(answer) if isinstance(load, Torque) else 1.0)
            )
        case ReactionIs(part=part):
            return OF_LOADS * largest_load(answer) * (_torque_scale(answer) if part == "moment" else 1.0)
        case RatioIs():
            return OF_LOADS
        case RateIs() | SpeedIs():
            return OF_LOADS * _fastest(target, answer)
    return OF_LOADS * size_of(answer)


def _of_loads(answer: Answer, torque: bool) -> float:
    return OF_LOADS * largest_load(answer) * (_torque_scale(answer) if torque else 1.0)


def _torque_scale(answer: Answer) -> float:
    return size_of(answer) * answer.case.units.torque_per_force_length


def largest_load(answer: Answer) -> float:
    """The largest known load as a force: a torque is divided by the mechanism's size."""
    values = [_as_force(load, answer) for load in answer.case.loads]
    return max((abs(value) for value in values), default=0.0) or 1.0


def _as_force(load: Load, answer: Answer) -> float:
    if isinstance(load, ForceVector):
        return math.hypot(load.x.value, load.y.value)
    if not isinstance(load.value, Number):
        return 0.0
    if isinstance(load, Torque):
        return load.value.value / _torque_scale(answer)
    if isinstance(load, Spring):
        return load.value.value * size_of(answer)
    if isinstance(load, Weight) and load.mass:
        return load.value.value * answer.case.gravity.value * answer.case.units.force_per_newton
    return load.value.value


def _fastest(target: Target, answer: Answer) -> float:
    if isinstance(target, SpeedIs):
        speeds = [math.hypot(*v) for v in (answer.velocities or {}).values() if not isinstance(v, str)]
        return max(speeds, default=1.0) or 1.0
    return max((abs(w) for w in (answer.rates or {}).values() if not isinstance(w, str)), default=1.0) or 1.0


def from_middle(place: tuple[float, float], answer: Answer) -> float:
    """How far a place lies from the middle of the mechanism."""
    if not answer.points:
        return 1.0
    xs, ys = zip(*answer.points.values(), strict=True)
    return math.dist(place, ((max(xs) + min(xs)) / 2.0, (max(ys) + min(ys)) / 2.0))


def own_width(tolerance: Tolerance, target: Target, answer: Answer, unit: Unit, unit_name: str) -> float:
    """The widest of a tolerance's absolute width and what its drawing allows, in the answer's unit.

    Raises NoKeyError where the width is in a unit of another kind, or the drawing says nothing of the target.
    """
    width = width_of(tolerance, unit, unit_name)
    if not tolerance.drawing:
        return width
    from icsolve.grade.drawn import drawn_width

    return max(width, drawn_width(tolerance.drawing, target, answer))


def width_of(tolerance: Tolerance, unit: Unit, unit_name: str) -> float:
    """A tolerance's absolute width in the answer's unit. Raises NoKeyError where it is of another kind."""
    if not tolerance.unit:
        return tolerance.absolute
    found = unit_word(tolerance.unit)
    factor = factors_between(found.unit, unit) if found is not None else None
    if factor is None:
        said = f"the tolerance {tolerance.absolute:g} {tolerance.unit}"
        raise NoKeyError(f"{said} does not fit an answer in {unit_name or 'no unit'}")
    return tolerance.absolute * factor

