"""Loads in space, each a number times a unit force or couple.

The motions that the joints leave to the bodies, and the power of the loads on them.

A twist is (velocity of the point at the origin of the frame, angular velocity); all motions are those on
which no joint does work.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from icsolve.case import Case, Like, Spring, Weight
from icsolve.case.space import Load, SpatialForce, SpatialForceVector, SpatialTorque, TorqueVector
from icsolve.numbers.sparse import Row, eliminate
from icsolve.statics.space.figure import (
    ZERO,
    SpatialFigure,
    Vec,
    add,
    between,
    cross,
    direction,
    dot,
    heading,
    in_case,
    size,
    spring_length,
    sub,
    times,
    unit,
    vector_of,
)
from icsolve.statics.space.reaction_basis import SpatialTie, Wrench


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


def wrenched(case: Case, figure: SpatialFigure) -> tuple[Wrenched, ...]:
    """All loads of a case in space.

    Raises SceneError where a load has no direction.
    """
    loads = in_case(case).loads
    by_name = {load.name: load for load in loads}
    return tuple(_wrenched(case, figure, load, by_name) for load in loads)


def _wrenched(case: Case, figure: SpatialFigure, load: Load, by_name: Mapping[str, Load]) -> Wrenched:
    root, ratio = _root(load, by_name)
    unit_wrench, gain = _unit(case, figure, load)
    at = figure.points[load.at] if not isinstance(load, SpatialTorque | TorqueVector) else ZERO
    against = getattr(load, "against", None) or case.ground
    return Wrenched(load, against, at, unit_wrench, gain, root.name, ratio, _number(root))


def _root(load: Load, by_name: Mapping[str, Load]) -> tuple[Load, float]:
    """The load whose number it takes, and how many times that."""
    ratio = 1.0
    while not isinstance(load, SpatialForceVector | TorqueVector) and isinstance(load.value, Like):
        ratio *= 1.0 if load.value.times is None else load.value.times.value
        load = by_name[load.value.load]
    return load, ratio


def _number(load: Load) -> float | None:
    if isinstance(load, SpatialForceVector | TorqueVector):
        return size(vector_of(load.parts))
    assert not isinstance(load.value, Like)
    return None if load.value is None else load.value.value


def _unit(case: Case, figure: SpatialFigure, load: Load) -> tuple[Wrench, float]:
    places, name = figure.places, f"load {load.name}"
    per_torque = figure.frame.scale / case.units.torque_per_force_length
    match load:
        case SpatialTorque():
            return (ZERO, direction(load.heading, places, name)), per_torque
        case TorqueVector():
            return (ZERO, _along(load.parts)), per_torque
        case SpatialForceVector():
            return (_along(load.parts), ZERO), 1.0
        case SpatialForce():
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
    return not isinstance(load, SpatialForceVector | TorqueVector) and load.value is None


def acting(w: Wrenched) -> tuple[Vec, Vec]:
    """Force and couple on the load's link, in force units (and normalised lengths), per unit of the root."""
    force, couple = w.unit
    amount = w.gain * w.ratio
    return times(amount, force), times(amount, couple)


Twist = tuple[Vec, Vec]
STILL: Twist = (ZERO, ZERO)

NOTHING = 1e-12
"""Power below this fraction of what force and speed could make is none (rounding)."""
NEARLY = 1e-5
"""Known loads that balance to this fraction of their own size are taken as balanced, and it is said."""


def motions_of(links: Sequence[str], ties: Sequence[SpatialTie]) -> tuple[dict[str, Twist], ...]:
    """A basis of the motions of ``links``, each scaled to a largest component of 1."""
    place = {link: 6 * n for n, link in enumerate(links)}
    rows = [_row(tie, wrench, place) for tie in ties for wrench in tie.units]
    general = eliminate(rows, 6 * len(links))
    motions = []
    for free in general.free:
        x = {c: row.get(free, 0.0) for c, row in general.solved.items()}
        x[free] = 1.0
        largest = max(map(abs, x.values()))
        motions.append({link: _twist(x, at, largest) for link, at in place.items()})
    return tuple(motions)


def _row(tie: SpatialTie, wrench: tuple[Vec, Vec], place: Mapping[str, int]) -> Row:
    """The power of a unit of a tie, in the components of all twists."""
    force, couple = wrench
    row: Row = {}
    for link, sign in ((tie.on, 1.0), (tie.by, -1.0)):
        if link in place:
            parts = (*force, *add(couple, cross(tie.at, force)))
            row.update({place[link] + n: sign * part for n, part in enumerate(parts) if part})
    return row


def _twist(x: Mapping[int, float], at: int, largest: float) -> Twist:
    a, b, c, d, e, f = (x.get(at + n, 0.0) / largest for n in range(6))
    return (a, b, c), (d, e, f)


def relative(motion: Mapping[str, Twist], on: str, by: str) -> Twist:
    """Twist of one link as another sees it."""
    (v, w), (p, q) = motion.get(on, STILL), motion.get(by, STILL)
    return sub(v, p), sub(w, q)


def velocity(twist: Twist, at: Vec) -> Vec:
    """Velocity of a point."""
    return add(twist[0], cross(twist[1], at))


class Power(NamedTuple):
    """Power of a load, per unit of its root's number, on a motion; and what it could be at most."""

    value: float
    most: float


def power_of(w: Wrenched, motion: Mapping[str, Twist]) -> Power:
    """Power of a load on a motion; zero where it is rounding."""
    force, couple = acting(w)
    twist = relative(motion, w.load.link, w.against)
    value = dot(force, velocity(twist, w.at)) + dot(couple, twist[1])
    fastest = max((size(v) + size(o) * (1.0 + size(w.at)) for v, o in motion.values()), default=0.0)
    most = (size(force) + size(couple)) * fastest
    return Power(value if abs(value) > NOTHING * most else 0.0, most)


def combined(motions: Sequence[Mapping[str, Twist]], shares: Sequence[float]) -> dict[str, Twist]:
    """A sum of motions."""
    total: dict[str, Twist] = {}
    for motion, share in zip(motions, shares, strict=True):
        for link, (v, w) in motion.items():
            p, q = total.get(link, STILL)
            total[link] = (add(p, times(share, v)), add(q, times(share, w)))
    return total


class SpatialBalance(NamedTuple):
    """The unknown loads by power, in case units; ``free`` are those that it leaves open.

    ``left`` is, for each motion, the power that is not balanced, and what it is summed from.
    """

    unknowns: dict[str, float]
    free: tuple[str, ...]
    left: tuple[tuple[float, float], ...]

    @property
    def unbalanced(self) -> tuple[float, ...]:
        """The power left on each motion; zero where it is rounding."""
        return tuple(rest if abs(rest) > NOTHING * most else 0.0 for rest, most in self.left)

    @property
    def off(self) -> float:
        """The largest power left, as a fraction of what it is summed from."""
        rests = zip(self.unbalanced, self.left, strict=True)
        return max((abs(rest) / most for rest, (_, most) in rests if rest), default=0.0)


def balance_of(
    motions: Sequence[Mapping[str, Twist]], loads: Sequence[Wrenched], roots: Sequence[str]
) -> SpatialBalance:
    """The unknown loads that make the power of all loads zero on every motion."""
    table = [[power_of(w, motion) for w in loads] for motion in motions]
    rows = [_equation(powers, loads, roots) for powers in table]
    general = eliminate(rows, len(roots))
    values = {root: general.of(n).get(len(roots), 0.0) for n, root in enumerate(roots)}
    free = tuple(roots[n] for n in general.free)
    return SpatialBalance(values, free, tuple(_left(powers, loads, values) for powers in table))


def _equation(powers: Sequence[Power], loads: Sequence[Wrenched], roots: Sequence[str]) -> Row:
    row: Row = {}
    for power, w in zip(powers, loads, strict=True):
        column = len(roots) if w.known is not None else roots.index(w.root)
        amount = power.value * (1.0 if w.known is None else w.known)
        if amount:
            row[column] = row.get(column, 0.0) + amount
    return row


def _left(
    powers: Sequence[Power], loads: Sequence[Wrenched], values: Mapping[str, float]
) -> tuple[float, float]:
    numbers = [values[w.root] if w.known is None else w.known for w in loads]
    terms = [(p.value * n, p.most * abs(n)) for p, n in zip(powers, numbers, strict=True)]
    return math.fsum(value for value, _ in terms), math.fsum(most for _, most in terms)
