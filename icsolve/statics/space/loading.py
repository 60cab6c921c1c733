"""Loads in space, each a number times a unit force or couple."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from icsolve.case import Case, Like, Spring, Weight
from icsolve.case.space import Force, ForceVector, Load, Torque, TorqueVector
from icsolve.statics.space.figure import (
    Figure,
    between,
    direction,
    heading,
    in_case,
    spring_length,
    vector_of,
)
from icsolve.statics.space.ties import Wrench
from icsolve.statics.space.vectors import ZERO, Vec, size, times, unit


class Wrenched(NamedTuple):
    """A load: number times ``gain`` times ``unit`` acts on its link at ``at``, the opposite on ``against``.

    ``unit`` is a force of length 1, or a couple of 1; ``at`` is normalised. ``gain`` brings the load's own
    unit to force units, of a couple to force units times normalised lengths. ``known`` is the number of a
    given load, None of an unknown one; ``root`` names the load whose number it takes, ``ratio`` times.
    """

    load: Load
    against: str
    at: Vec
    unit: Wrench
    gain: float
    root: str
    ratio: float
    known: float | None

    @property
    def size(self) -> float:
        """What a unit of the root's number exerts, in force units (and normalised lengths)."""
        return abs(self.gain * self.ratio)


def wrenched(case: Case, figure: Figure) -> tuple[Wrenched, ...]:
    """All loads of a case in space.

    Raises SceneError where a load has no direction.
    """
    loads = in_case(case).loads
    by_name = {load.name: load for load in loads}
    return tuple(_wrenched(case, figure, load, by_name) for load in loads)


def _wrenched(case: Case, figure: Figure, load: Load, by_name: Mapping[str, Load]) -> Wrenched:
    root, ratio = _root(load, by_name)
    unit_wrench, gain = _unit(case, figure, load)
    at = figure.points[load.at] if not isinstance(load, Torque | TorqueVector) else ZERO
    against = getattr(load, "against", None) or case.ground
    return Wrenched(load, against, at, unit_wrench, gain, root.name, ratio, _number(root))


def _root(load: Load, by_name: Mapping[str, Load]) -> tuple[Load, float]:
    """The load whose number it takes, and how many times that."""
    ratio = 1.0
    while not isinstance(load, ForceVector | TorqueVector) and isinstance(load.value, Like):
        ratio *= 1.0 if load.value.times is None else load.value.times.value
        load = by_name[load.value.load]
    return load, ratio


def _number(load: Load) -> float | None:
    if isinstance(load, ForceVector | TorqueVector):
        return size(vector_of(load.parts))
    assert not isinstance(load.value, Like)
    return None if load.value is None else load.value.value


def _unit(case: Case, figure: Figure, load: Load) -> tuple[Wrench, float]:
    places, name = figure.places, f"load {load.name}"
    per_torque = figure.frame.scale / case.units.torque_per_force_length
    match load:
        case Torque():
            return (ZERO, direction(load.heading, places, name)), per_torque
        case TorqueVector():
            return (ZERO, _along(load.parts)), per_torque
        case ForceVector():
            return (_along(load.parts), ZERO), 1.0
        case Force():
            return (heading(load.heading, load.at, places, name), ZERO), 1.0
        case Weight():
            gain = case.gravity.value * case.units.force_per_newton if load.mass else 1.0
            return (direction(in_case(case).down, places, "gravity"), ZERO), gain
        case Spring():
            stretch = spring_length(load, places) - load.free.value
            return (between(load.at, load.to, places, name), ZERO), stretch
    raise TypeError(type(load).__name__)


def _along(parts: Sequence[object]) -> Vec:
    """Unit vector of a load by components; of a load of nothing, x."""
    vector = vector_of(parts)  # type: ignore[arg-type]
    return unit(vector) if size(vector) else (1.0, 0.0, 0.0)


def scale_of(loads: Sequence[Wrenched]) -> float:
    """A power of two that brings the largest known load near 1."""
    largest = max((w.size * abs(w.known) for w in loads if w.known is not None), default=0.0)
    return math.ldexp(1.0, -math.frexp(largest)[1]) if largest else 1.0


def is_unknown(load: Load) -> bool:
    """Whether a load is one to find."""
    return not isinstance(load, ForceVector | TorqueVector) and load.value is None


def acting(w: Wrenched) -> tuple[Vec, Vec]:
    """Force and couple on the load's link, in force units (and normalised lengths), per unit of the root."""
    force, couple = w.unit
    amount = w.gain * w.ratio
    return times(amount, force), times(amount, couple)
