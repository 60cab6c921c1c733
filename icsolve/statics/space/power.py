"""Loads in space, each a number times a unit force or couple.

The motions that the joints leave to the bodies, and the power of the loads on them.

A twist is (velocity of the point at the origin of the frame, angular velocity); all motions are those on
which no joint does work.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from icsolve.case import Case, Like, Spring, Weight
from icsolve.case.space import Load, SpatialForce, SpatialForceVector, SpatialTorque, TorqueVector
from icsolve.numbers.arithmetic import Arithmetic, Scalar, decider
from icsolve.numbers.null_space import Vanishes
from icsolve.numbers.sparse import Row, eliminate
from icsolve.screws.space import ZERO, Components, Vec, dot, moved, size, times, unit, velocity_of
from icsolve.statics.equilibrium import NOTHING_SOLVED, Action, Equilibrium, columns_of, solve_statics
from icsolve.statics.power import is_unknown, source_of
from icsolve.statics.space.reaction_basis import (
    SpatialFigure,
    SpatialTie,
    between,
    direction,
    heading,
    in_case,
    spring_length,
    vector_of,
)
from icsolve.tuples import NamedTuple

SpatialStatics = Equilibrium[SpatialTie]


class Wrenched(NamedTuple):
    """A load: number times ``gain`` times ``unit`` acts on its link at ``at``, the opposite on ``against``.

    Attributes
    ----------
    load : the load
    against : link that takes the opposite
    at : [frame]
    unit : a force of length 1 and no couple, or a couple of 1
    gain : what brings the load's own unit to force units, of a couple to force units times frame length
    root, ratio : the load whose number it takes, ``ratio`` times
    known : the number of a given load, None of an unknown one
    """

    load: Load
    against: str
    at: Vec
    unit: tuple[Vec, Vec]
    gain: Scalar
    root: str
    ratio: Scalar
    known: Scalar | None

    @property
    def size(self) -> float:
        """What a unit of the root's number exerts, in force units (and frame lengths)."""
        return abs(float(self.gain * self.ratio))

    @property
    def wrench(self) -> Components:
        """What a unit of the root's number exerts about ``at``, (6,)."""
        force, couple = (times(self.gain * self.ratio, part) for part in self.unit)
        return (*force, *couple)


def wrenched(case: Case, figure: SpatialFigure) -> tuple[Wrenched, ...]:
    """All loads of a case in space.

    Raises SceneError where a load has no direction.
    """
    loads = in_case(case).loads
    by_name = {load.name: load for load in loads}
    return tuple(_wrenched(case, figure, load, by_name) for load in loads)


def _wrenched(case: Case, figure: SpatialFigure, load: Load, by_name: Mapping[str, Load]) -> Wrenched:
    root, ratio = source_of(load, by_name, figure.arithmetic)
    unit_wrench, gain = _unit(case, figure, load)
    at = figure.points[load.at] if not isinstance(load, SpatialTorque | TorqueVector) else ZERO
    against = getattr(load, "against", None) or case.ground
    known = _number(root, figure.arithmetic)
    return Wrenched(load, against, at, unit_wrench, gain, root.name, ratio, known)


def _number(load: Load, arithmetic: Arithmetic) -> Scalar | None:
    if isinstance(load, SpatialForceVector | TorqueVector):
        return size(vector_of(load.parts, arithmetic), arithmetic)
    assert not isinstance(load.value, Like)
    return None if load.value is None else arithmetic.given(load.value)


def _unit(case: Case, figure: SpatialFigure, load: Load) -> tuple[tuple[Vec, Vec], Scalar]:
    name, a = f"load {load.name}", figure.arithmetic
    num, den, pi = case.units.exact_torque
    per_torque = a.ratio((den, num, -pi)) * figure.frame.scale
    match load:
        case SpatialTorque():
            return (ZERO, direction(load.heading, figure, name)), per_torque
        case TorqueVector():
            return (ZERO, _along(vector_of(load.parts, a), a)), per_torque
        case SpatialForceVector():
            return (_along(vector_of(load.parts, a), a), ZERO), 1.0
        case SpatialForce():
            return (heading(load.heading, load.at, figure, name), ZERO), 1.0
        case Weight():
            gain = a.given(case.gravity) * a.ratio(case.units.exact_newton) if load.mass else 1.0
            return (direction(in_case(case).down, figure, "gravity"), ZERO), gain
        case Spring():
            stretch = spring_length(load, figure) - a.given(load.free)
            return (between(load.at, load.to, figure, name), ZERO), stretch
    raise TypeError(type(load).__name__)


def _along(vector: Vec, arithmetic: Arithmetic) -> Vec:
    """Unit vector of a load by components; of a load of nothing, x."""
    return unit(vector, arithmetic) if any(map(float, vector)) else (1.0, 0.0, 0.0)


def scale_of(loads: Sequence[Wrenched]) -> float:
    """A power of two that brings the largest known load near 1."""
    largest = max((w.size * abs(float(w.known)) for w in loads if w.known is not None), default=0.0)
    return math.ldexp(1.0, -math.frexp(largest)[1]) if largest else 1.0


Twists = Mapping[str, Sequence[Components]]
"""By link, one a motion, each (6,); of the frame too."""

NOTHING = 1e-12
"""In floats power below this fraction of what force and speed could make is none (rounding)."""
NEARLY = 1e-5
"""Known loads that balance to this fraction of their own size are taken as balanced, and it is said."""


def motions_of(case: Case, ties: Sequence[SpatialTie], arithmetic: Arithmetic) -> Twists:
    """A basis of the motions of the links, each scaled by a power of two to a largest component of 1/2 to 1.

    Parameters
    ----------
    case : the links and the frame, which is at rest
    ties : each unit of which does no work
    arithmetic : of the ties
    """
    links = [link for link in case.links if link != case.ground]
    place = {link: 6 * n for n, link in enumerate(links)}
    rows = [_row(tie, wrench, place) for tie in ties for wrench in tie.units]
    general = eliminate(rows, 6 * len(links), vanishes=decider(arithmetic))
    found: dict[str, list[Components]] = {link: [] for link in (case.ground, *links)}
    for free in general.free:
        x = {c: row.get(free, 0.0) for c, row in general.solved.items()} | {free: 1.0}
        scale = math.ldexp(1.0, -math.frexp(max(abs(float(value)) for value in x.values()))[1])
        found[case.ground].append((0.0,) * 6)
        for link, at in place.items():
            found[link].append(tuple(x.get(at + n, 0.0) * scale for n in range(6)))
    return found


def _row(tie: SpatialTie, wrench: Components, place: Mapping[str, int]) -> Row:
    """The power of a unit of a tie, in the components of all twists."""
    parts = moved(wrench, tie.at, ZERO)
    row: Row = {}
    for link, sign in ((tie.on, 1.0), (tie.by, -1.0)):
        if link in place:
            row.update({place[link] + n: sign * part for n, part in enumerate(parts) if part})
    return row


def count_of(twists: Twists) -> int:
    """The number of motions."""
    return len(next(iter(twists.values())))


class Power(NamedTuple):
    """Power of a load, per unit of its root's number, on a motion; and what it could be at most."""

    value: Scalar
    most: float


def powers_of(loads: Sequence[Wrenched], twists: Twists, arithmetic: Arithmetic) -> list[list[Power]]:
    """The power of every load on every motion, (motions, loads); zero where it is rounding."""
    vanishes = decider(arithmetic)
    found: list[list[Power]] = []
    for m in range(count_of(twists)):
        speeds = [(float(size(t[m][:3])), float(size(t[m][3:]))) for t in twists.values()]
        found.append([_power(w, twists, m, speeds, vanishes) for w in loads])
    return found


def _power(
    w: Wrenched, twists: Twists, m: int, speeds: Sequence[tuple[float, float]], vanishes: Vanishes | None
) -> Power:
    """On the m-th motion, in which the links have these speeds (of the origin; angular)."""
    wrench = w.wrench
    on, off = twists[w.load.link][m], twists[w.against][m]
    twist = tuple(a - b for a, b in zip(on, off, strict=True))
    value = dot(wrench[:3], velocity_of(twist, w.at)) + dot(wrench[3:], twist[3:])
    reach = 1.0 + float(size(w.at))
    most = (float(size(wrench[:3])) + float(size(wrench[3:]))) * max(v + o * reach for v, o in speeds)
    none = vanishes(value, most) if vanishes else abs(value) <= NOTHING * most
    return Power(0.0 if none else value, most)


class SpatialBalance(NamedTuple):
    """The unknown loads by power, in case units; ``free`` are those that it leaves open.

    ``powers`` are those of every load, (motions, loads); ``left`` is, for each motion, the power that is not
    balanced, and what it is summed from.
    """

    unknowns: dict[str, Scalar]
    free: tuple[str, ...]
    powers: Sequence[Sequence[Power]]
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
    powers: Sequence[Sequence[Power]],
    loads: Sequence[Wrenched],
    roots: Sequence[str],
    arithmetic: Arithmetic,
) -> SpatialBalance:
    """The unknown loads that make the power of all loads zero on every motion."""
    rows = [_equation(row, loads, roots) for row in powers]
    general = eliminate(rows, len(roots), vanishes=decider(arithmetic))
    values = {root: general.of(n).get(len(roots), 0.0) for n, root in enumerate(roots)}
    free = tuple(roots[n] for n in general.free)
    return SpatialBalance(values, free, powers, tuple(_left(row, loads, values) for row in powers))


def _equation(powers: Sequence[Power], loads: Sequence[Wrenched], roots: Sequence[str]) -> Row:
    row: Row = {}
    for power, w in zip(powers, loads, strict=True):
        column = len(roots) if w.known is not None else roots.index(w.root)
        amount = power.value * (1.0 if w.known is None else w.known)
        row[column] = row.get(column, 0.0) + amount
    return row


def _left(
    powers: Sequence[Power], loads: Sequence[Wrenched], values: Mapping[str, Scalar]
) -> tuple[float, float]:
    numbers = [values[w.root] if w.known is None else w.known for w in loads]
    terms = [(float(p.value * n), p.most * abs(float(n))) for p, n in zip(powers, numbers, strict=True)]
    return math.fsum(value for value, _ in terms), math.fsum(most for _, most in terms)


def unit_powers(
    powers: Sequence[Sequence[Power]], loads: Sequence[Wrenched], roots: Sequence[str]
) -> list[list[float]]:
    """The power of a unit of each unknown load, (motions, unknowns)."""
    both = [list(zip(row, loads, strict=True)) for row in powers]
    return [
        [sum(float(p.value) for p, w in row if w.known is None and w.root == q) for q in roots]
        for row in both
    ]


def spatial_statics(
    case: Case, ties: tuple[SpatialTie, ...], loads: Sequence[Wrenched], mobility: int, arithmetic: Arithmetic
) -> SpatialStatics:
    """Solve the equilibrium of every link in space but the frame: six equations a link.

    Parameters and result as of `icsolve.statics.equilibrium.equilibrium`.
    """
    first, known = columns_of(ties)
    roots = tuple(w.root for w in loads if is_unknown(w.load))
    bare = SpatialStatics(ties, (), first, known, roots, (), scale_of(loads), {}, NOTHING_SOLVED, arithmetic)
    return solve_statics(bare, _actions(bare, loads), case.ground, mobility)


def _actions(statics: SpatialStatics, loads: Sequence[Wrenched]) -> Iterator[Action]:
    """What the units of the ties, and the loads, do."""
    for tie, column in zip(statics.ties, statics.first, strict=True):
        for n, force in enumerate(tie.units):
            yield Action(column + n, tie.on, tie.by, tie.at, force)
    for w in loads:
        column, share = statics.known, 1.0
        if w.known is None:
            column = statics.root(statics.roots.index(w.root))
        else:
            share = w.known * statics.scale
        yield Action(column, w.load.link, w.against, w.at, tuple(share * part for part in w.wrench))
