"""Loads in space, each a number times a unit force or couple.

The motions that the joints leave to the bodies, and the power of the loads on them.

A twist is (velocity of the point at the origin of the frame, angular velocity); all motions are those on
which no joint does work.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from icsolve.case import Case, Spring, Weight
from icsolve.case.space import Load, SpatialForce, SpatialForceVector, SpatialTorque, TorqueVector
from icsolve.numbers import Arithmetic, Scalar, decider, largest_of
from icsolve.numbers.linear import Row, eliminate
from icsolve.screws.space import AXES, ZERO, Components, Vec, moved
from icsolve.statics.equilibrium import (
    Action,
    Equilibrium,
    columns_of,
    load_action,
    solve_statics,
    tie_actions,
)
from icsolve.statics.free_bodies import carrying
from icsolve.statics.load_wrenches import UnitWrench, acting, vector_size
from icsolve.statics.power import PowerFactors, PowerRow, balance, power_rows
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
from icsolve.statics.witness import refuse_doubt
from icsolve.tuples import NamedTuple

SpatialStatics = Equilibrium[SpatialTie]
SpatialFactors = PowerFactors[Load]
SpatialWrench = UnitWrench[Load]


def wrenches(case: Case, figure: SpatialFigure) -> tuple[SpatialWrench, ...]:
    """The unit wrenches of all loads of a case in space, in its order.

    Raises SceneError where a load has no direction.
    """
    loads = in_case(case).loads
    by_name = {load.name: load for load in loads}
    result = []
    for load in loads:
        (force, couple), gain = _unit(case, figure, load)
        about = moved((*force, *couple), place_of(load, figure) or ZERO, ZERO)
        measure = figure.frame.scale if is_couple(load) else 1.0
        result.append(acting(load, by_name, case, about, gain, measure, figure.arithmetic))
    return tuple(result)


def is_couple(load: Load) -> bool:
    """Whether a load has no force."""
    return isinstance(load, SpatialTorque | TorqueVector)


def place_of(load: Load, figure: SpatialFigure) -> Vec | None:
    """Where a load acts [frame]; None of a couple."""
    return None if isinstance(load, SpatialTorque | TorqueVector) else figure.points[load.at]


def _unit(case: Case, figure: SpatialFigure, load: Load) -> tuple[tuple[Vec, Vec], Scalar]:
    """A force of length 1 or a couple of 1, and what brings the load's own unit to force units (of a couple
    times case length)."""
    name, a = f"load {load.name}", figure.arithmetic
    num, den, pi = case.units.exact_torque
    match load:
        case SpatialTorque():
            return (ZERO, direction(load.heading, figure, name)), a.ratio((den, num, -pi))
        case TorqueVector():
            return (ZERO, _along(load, figure)), a.ratio((den, num, -pi))
        case SpatialForceVector():
            return (_along(load, figure), ZERO), 1.0
        case SpatialForce():
            return (heading(load.heading, load.at, figure, name), ZERO), 1.0
        case Weight():
            gain = a.given(case.gravity) * a.ratio(case.units.exact_newton) if load.mass else 1.0
            return (direction(in_case(case).down, figure, "gravity"), ZERO), gain
        case Spring():
            stretch = spring_length(load, figure) - a.given(load.free)
            return (between(load.at, load.to, figure, name), ZERO), stretch
    raise TypeError(type(load).__name__)


def _along(load: SpatialForceVector | TorqueVector, figure: SpatialFigure) -> Vec:
    """The components of a load over its size, which its number is; of a load of nothing, x."""
    size = vector_size(load.parts)
    x, y, z = vector_of(load.parts, figure.arithmetic)
    return (x / size, y / size, z / size) if size else AXES[0]


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


class SpatialBalance(NamedTuple):
    """The unknown loads by power, in case units; ``free`` are those that it leaves open.

    ``rows`` are the equations of power; ``left`` is, for each motion, the power that is not balanced (zero
    where it is rounding), and what it is summed from.
    """

    unknowns: dict[str, Scalar]
    free: tuple[str, ...]
    rows: Sequence[PowerRow]
    left: tuple[tuple[float, float], ...]

    @property
    def shares(self) -> tuple[float, ...]:
        """The power left on each motion, as a fraction of what it is summed from."""
        return tuple(rest / most if rest else 0.0 for rest, most in self.left)

    @property
    def off(self) -> float:
        """The largest of these fractions."""
        return largest_of(self.shares)


def balance_of(powers: SpatialFactors, arithmetic: Arithmetic) -> SpatialBalance:
    """The unknown loads that make the power of all loads zero on every motion."""
    unknown, scale, rows = power_rows(powers, arithmetic)
    count = len(unknown)
    equations = [dict(enumerate(row.values)) for row in rows]
    general = eliminate(equations, count, vanishes=decider(arithmetic))
    scaled = [general.of(n).get(count, 0.0) for n in range(count)]
    values = {w.root: x / (scale * w.measure) for w, x in zip(unknown, scaled, strict=True)}
    free = tuple(unknown[n].root for n in general.free)
    return SpatialBalance(values, free, rows, tuple(_left(row, [*scaled, 1.0], arithmetic) for row in rows))


def _left(row: PowerRow, numbers: Sequence[Scalar], arithmetic: Arithmetic) -> tuple[float, float]:
    most = math.fsum(size * abs(float(n)) for size, n in zip(row.sizes, numbers, strict=True))
    parts = [value * n for value, n in zip(row.values, numbers, strict=True)]
    vanishes = decider(arithmetic)
    if vanishes is not None:
        rest = sum(parts, 0.0)
        return (0.0 if vanishes(rest, most) else float(rest)), most
    rest = math.fsum(map(float, parts))
    return (rest if abs(rest) > NOTHING * most else 0.0), most


class SpatialSolution(NamedTuple):
    """Motions, unknown loads by power, and the equilibrium of all bodies: six equations each."""

    case: Case
    figure: SpatialFigure
    twists: Twists
    powers: SpatialFactors
    balance: SpatialBalance
    statics: SpatialStatics

    @property
    def parameters(self) -> Mapping[int, Scalar]:
        """Values of the columns of the loads."""
        return self.statics.parameters(self.balance.unknowns)

    @property
    def mobility(self) -> int:
        """Motions that the joints leave."""
        return count_of(self.twists)

    def carrying(self, t: int) -> float:
        """Sign of the force in a mesh along its unit; 1 for no force."""
        return carrying(self.statics, self.parameters, t)


def solution_of(
    case: Case, figure: SpatialFigure, ties: tuple[SpatialTie, ...], loads: tuple[SpatialWrench, ...]
) -> SpatialSolution:
    """Both ways to the unknown loads of a case in space, by power and by equilibrium.

    Raises SceneError where the two count different freedoms.
    """
    twists = motions_of(case, ties, figure.arithmetic)
    powers = balance(loads, twists, count_of(twists))
    bare = columns_of(ties, powers, figure.arithmetic)
    statics = solve_statics(bare, _actions(bare, figure, loads), case.ground)
    refuse_doubt(len(statics.general.left), count_of(twists))
    return SpatialSolution(case, figure, twists, powers, balance_of(powers, figure.arithmetic), statics)


def _actions(
    statics: SpatialStatics, figure: SpatialFigure, loads: Sequence[SpatialWrench]
) -> Iterator[Action]:
    """What the units of the ties, and the loads, do."""
    yield from tie_actions(statics)
    for w in loads:
        at = place_of(w.load, figure)
        yield load_action(w, statics, at or ZERO, (*w.unit[:3], *ZERO) if at else w.unit)
