"""The solution with friction enclosed, and the slopes of its loads by every number of the case.

Enclosed: that the equations have one solution near the one that floats found, and how far from it
(Krawczyk's operator on balls). The unknowns are the loads to find and the friction f of every rub that
slides: the sums of power are linear in them, and f^2 = limit^2 |N|^2 with the force N that presses there,
linear too. Where N vanishes f does, and that is all that there is to solve. The sense of each rub is that of
its rate in the motion, of which the ball has to say it.

Slopes: in the solution the equilibrium of every link and the friction of every rub leave a residual. Each
unknown load has weights, one an equation (the adjoint solution): their sum over the residuals is a step of
Newton's method for that load. Evaluated on a tape, the sum gives its slope by every number of the case.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from decimal import Decimal
from types import MappingProxyType

from icsolve.kinematics.speeds import Speed
from icsolve.numbers.arithmetic import Scalar, Showing, all_vanish
from icsolve.numbers.balls import Balls, MoreDigits
from icsolve.numbers.krawczyk import enclosed_root
from icsolve.numbers.sparse import Row, eliminate
from icsolve.numbers.tape import SMALL
from icsolve.screws.plane import Point
from icsolve.statics.equilibrium import Components, Rub, Statics, actions_of, equilibrium
from icsolve.statics.free_bodies import Solved, carrying_flanks
from icsolve.statics.friction_equations import forces_of
from icsolve.statics.friction_interface import rubbing_rates, rubs_of
from icsolve.statics.power import Balance, Bounded, Wrench
from icsolve.statics.reaction_basis import Force, Position, rope_ties, slipping, ties_of, with_flanks
from icsolve.statics.witness import independent
from icsolve.tuples import NamedTuple

UNBOUND = "no bound was asked for"
UNSURE = "with friction no bound of the rounding error is proven"
AT_KINK = "nothing presses at a joint that rubs, and there its friction has no slope"
MISSED = f"{UNSURE} where given centres or contacts miss the motion"
TOO_CLOSE = f"{UNSURE} so near to a dead centre or a jam"


class Proven(NamedTuple):
    """What is proven of a solution with friction.

    Attributes
    ----------
    why : why nothing is
    bounds, values : by load, the number rounded once and the bound of its error [case units]
    friction : (rubs,), rounded once [scaled]
    """

    why: str = ""
    bounds: Mapping[str, float] = MappingProxyType({})
    values: Mapping[str, float] = MappingProxyType({})
    friction: tuple[float, ...] = ()


def slopes(
    position: Position, solved: Solved, senses: Sequence[float], traced: Bounded
) -> dict[str, dict[str, float]]:
    """By load and by the path of a number, the derivative [case units].

    Raises LookupError, with the reason, where it has none, and so near a singular position that the tape does
    not tell.
    """
    if any(sense and not friction for sense, friction in zip(senses, solved.friction, strict=True)):
        raise LookupError(AT_KINK)
    found = SlidingSolution(solved.statics, solved.statics.filled(solved.parameters), tuple(senses))
    weights = weights_of(found)
    if weights is None or max(traced.tape.doubts(SMALL), default=0.0):
        raise LookupError(TOO_CLOSE)
    exact = _exact(position, solved, found, traced)
    passes = [traced.tape.back(step(found, by, exact)).by_path for by in weights]
    scale = solved.statics.scale
    by_root = zip(solved.statics.roots, passes, strict=True)
    return {q: {path: -slope / scale for path, slope in swept.items()} for q, swept in by_root}


def _exact(position: Position, solved: Solved, found: SlidingSolution, traced: Bounded) -> Exact:
    """The scene on the tape."""
    tape, outcome = traced.tape, traced.outcome
    placed = position._replace(points=outcome.points, arithmetic=tape)
    flanks = carrying_flanks(position, solved.statics.ties, solved)
    ties = with_flanks(placed, ties_of(placed), flanks)
    values = {column: tape.constant(value) for column, value in found.values.items()}
    ropes = slipping(
        placed._replace(ropes=rope_ties(position.case, placed.points, position.scale, tape)),
        [tie.senses for tie in found.statics.ropes],
    ).ropes
    statics = found.statics._replace(ties=ties, rubs=rubs_of(placed, ties), ropes=ropes, arithmetic=tape)
    return Exact(statics, placed, outcome.balance.wrenches, values)


OPEN = 1e-9
"""What is left of a unit of an unknown load below this is rounding."""


class SlidingSolution(NamedTuple):
    """A solution with friction: values of all columns of its statics (scaled), the senses of the rubs."""

    statics: Statics
    values: Row
    senses: tuple[float, ...]


class Weights(NamedTuple):
    """What a unit of each residual does to an unknown load, as a motion does power on forces.

    ``links`` has those of the force along x and y and of the moment about a point of each link, ``rubs``
    those of the frictions.
    """

    links: Mapping[str, tuple[Point, Force]]
    rubs: tuple[float, ...]


class Exact(NamedTuple):
    """A scene in one arithmetic: its columns (ties, ropes, rubs), position and loads, and their values.

    Attributes
    ----------
    statics : the columns, whose units are of this arithmetic; not solved in it
    position, wrenches : points and loads
    values : by column [scaled]
    """

    statics: Statics
    position: Position
    wrenches: Sequence[Wrench]
    values: Mapping[int, Scalar]


def weights_of(found: SlidingSolution) -> list[Weights] | None:
    """The weights of every unknown load; None where the equations do not determine one."""
    equations = found.statics.equations
    rows = [row for _, three in equations.values() for row in three] + _frictions(found)
    by_column: dict[int, Row] = {}
    for n, row in enumerate(rows):
        for column, a in row.items():
            if column != found.statics.known:
                by_column.setdefault(column, {})[n] = a
    count = len(found.statics.roots)
    for q in range(count):
        by_column.setdefault(found.statics.root(q), {})[len(rows) + q] = -1.0
    general = eliminate([by_column[c] for c in sorted(by_column)], len(rows))
    if any(abs(a) > OPEN for left in general.left for a in left.values()):
        return None
    return [
        _weights({link: about for link, (about, _) in equations.items()}, all_weights)
        for q in range(count)
        if (all_weights := [general.of(n).get(len(rows) + q, 0.0) for n in range(len(rows))])
    ]


def _weights(about: Mapping[str, Components], values: Sequence[float]) -> Weights:
    links: dict[str, tuple[Point, Force]] = {}
    for k, (link, at) in enumerate(about.items()):
        links[link] = ((at[0], at[1]), (values[3 * k], values[3 * k + 1], values[3 * k + 2]))
    return Weights(links, tuple(values[3 * len(about) :]))


def _frictions(found: SlidingSolution) -> list[Row]:
    """Derivatives of each friction's residual: itself, and its coefficient times the size of its force."""
    rows = []
    for k, rub in enumerate(found.statics.rubs):
        force = pressing(found.statics, rub, found.values)
        size = math.hypot(*force) or 1.0
        row: Row = {found.statics.rub(k): 1.0}
        for n in range(len(rub.normal[0])):
            share = sum(f * part[n] for f, part in zip(force, rub.normal, strict=True)) / size
            row[found.statics.first[rub.tie] + n] = found.senses[k] * rub.limit * share
        rows.append(row)
    return rows


def pressing(statics: Statics, rub: Rub, values: Mapping[int, Scalar]) -> tuple[Scalar, ...]:
    """The force that bounds the friction of a rub, by components."""
    first = statics.first[rub.tie]
    return tuple(_sum(values[first + n] * a for n, a in enumerate(row)) for row in rub.normal)


def _sum(terms: Iterable[Scalar]) -> Scalar:
    total: Scalar = 0.0
    for term in terms:
        total = term + total
    return total


def step(found: SlidingSolution, weights: Weights, exact: Exact) -> Scalar:
    """The weighted sum of all residuals (scaled): the unknown load is too large by so much."""
    links = _sum(
        exact.values[a.column] * _pairing(a.force, _apart(weights, a.on, a.by, a.at))
        for a in actions_of(exact.statics, exact.position, exact.wrenches)
    )
    return links + _sum(_of_rub(found, weights, exact, k) for k in range(len(exact.statics.rubs)))


def _of_rub(found: SlidingSolution, weights: Weights, exact: Exact, k: int) -> Scalar:
    """A friction, which is against its sense and as large as its coefficient makes it."""
    rub = exact.statics.rubs[k]
    force = pressing(found.statics, rub, exact.values)
    if len(force) == 1:
        size = force[0] if float(force[0]) >= 0.0 else -force[0]
    else:
        size = exact.statics.arithmetic.sqrt(force[0] * force[0] + force[1] * force[1])
    rest = exact.values[found.statics.rub(k)] + found.senses[k] * (rub.limit * size)
    return weights.rubs[k] * rest


def _apart(weights: Weights, on: str, by: str, at: Components) -> Force:
    """Weights of a force along x and y and of a couple at a point, on one link and back on the other."""
    a, b = _at(weights, on, at), _at(weights, by, at)
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _at(weights: Weights, link: str, at: Components) -> Force:
    if link not in weights.links:
        return (0.0, 0.0, 0.0)
    (ox, oy), (x, y, couple) = weights.links[link]
    return (x - couple * (at[1] - oy), y + couple * (at[0] - ox), couple)


def _pairing(force: Components, apart: Components) -> Scalar:
    return _sum(f * a for f, a in zip(force, apart, strict=True))


Flanks = Mapping[int, float]
Senses = Sequence[tuple[float, ...]]


class SceneOnBalls(NamedTuple):
    """A scene on balls, and which of its motions is meant; ``made`` keeps its statics."""

    position: Position
    balance: Balance
    speed: Speed
    arithmetic: Showing
    made: dict[object, Statics]

    def statics(self, flanks: Flanks, rope_senses: Senses) -> Statics:
        """The equilibrium of its links, with the teeth on these flanks and ropes that slip so.

        Raises MoreDigits where the balls leave a pivot open.
        """
        key = (tuple(sorted(flanks.items())), tuple(rope_senses))
        if key not in self.made:
            position = slipping(self.position, rope_senses)
            ties = with_flanks(position, ties_of(position), flanks)
            self.made[key] = equilibrium(position, ties, self.balance, rubs_of(position, ties))
        return self.made[key]


def enclosed(scene: SceneOnBalls, solved: Solved, senses: Sequence[float]) -> Solved | None:
    """The solution on balls; the rubs have these senses.

    None where a sense, or the flank of a tooth, is another than the balls say. Raises MoreDigits where they
    leave that open, and where no solution is shown.
    """
    a = scene.arithmetic
    assert isinstance(a, Balls)
    rope_senses = [tie.senses for tie in solved.statics.ropes]
    if not _moves_so(scene, senses, rope_senses):
        return None
    flanks = carrying_flanks(scene.position, ties_of(scene.position), solved)
    statics = scene.statics(flanks, rope_senses)
    rubs = statics.rubs
    roots = {statics.root(n): solved.unknowns[q] * statics.scale for n, q in enumerate(statics.roots)}
    largest = max(map(abs, solved.statics.filled(solved.parameters).values()))
    every = {statics.rub(k): f for k, f in enumerate(solved.friction) if senses[k]}
    begun = {column: f for column, f in every.items() if abs(f) > SLIGHT * largest}
    start = {column: Decimal(x) for column, x in {**roots, **begun}.items()}
    while True:
        system = _FrictionSystem(statics, list(start), senses)
        found = dict(zip(start, enclosed_root(system, list(start.values()), a), strict=True))
        start = {column: x.value for column, x in found.items()}
        for k, rub in enumerate(rubs):
            if senses[k] and statics.rub(k) not in found and (size := system.pressed(k, found, a)):
                start[statics.rub(k)] = Decimal(-senses[k] * float(rub.limit) * size)
        if len(start) == len(found):
            break
    if any(found[statics.rub(k)].sign != -senses[k] for k in system.slides):
        raise MoreDigits
    unknowns = {q: found[statics.root(n)] / statics.scale for n, q in enumerate(statics.roots)}
    return Solved(statics, unknowns, tuple(found.get(statics.rub(k), 0.0) for k in range(len(rubs))))


SLIGHT = 1e-6
"""Of a friction below this fraction of the largest force it is asked first whether anything presses there."""


def _moves_so(scene: SceneOnBalls, senses: Sequence[float], rope_senses: Sequence[Sequence[float]]) -> bool:
    """Whether everything rubs in these senses; where no motion is given, perhaps in all the opposite ones."""
    moving = rubbing_rates(scene.position, scene.speed).in_floats.senses
    asked = [sense for row in (senses, *rope_senses) for sense in row]
    opposite = [-sense for sense in asked]
    return moving.every == asked or (not scene.position.case.motion and moving.every == opposite)


class _FrictionSystem:
    """The equations and their derivatives, by the place of each unknown: a column of the statics."""

    def __init__(self, statics: Statics, columns: Sequence[int], senses: Sequence[float]) -> None:
        self.statics, self.senses = statics, senses
        self.slides = [k for k in range(len(statics.rubs)) if statics.rub(k) in columns]
        self.place = {column: n for n, column in enumerate(columns)}
        every, count = (*columns, statics.known), len(statics.roots)
        powers = [[left.get(c, 0.0) for c in every] for left in statics.general.left]
        chosen = independent(powers, count)
        if len(chosen) < count:  # a load that does no work presses, and the frictions balance the others
            chosen = powers
        if len(chosen) != count:
            raise MoreDigits
        self.powers = [dict(zip(every, row, strict=True)) for row in chosen]
        self.pressing = forces_of(statics)

    def __call__(self, x: Sequence[Scalar]) -> tuple[list[Scalar], list[dict[int, Scalar]]]:
        values, slopes = [], []
        for row in self.powers:
            values.append(self._at(row, x))
            slopes.append({n: row[c] for c, n in self.place.items() if c in row})
        for k in self.slides:
            limit, own = self.statics.rubs[k].limit, self.place[self.statics.rub(k)]
            forces = [self._at(row, x) for row in self.pressing[k]]
            square = limit * limit
            if len(forces) == 1:  # its sign is that of a friction against its sense
                ahead = self.senses[k] * math.copysign(1.0, float(forces[0])) * limit
                values.append(x[own] + ahead * forces[0])
                weights = [ahead]
            else:
                values.append(x[own] * x[own] - square * sum((n * n for n in forces), 0.0))
                weights = [0.0 - square * force * 2.0 for force in forces]
            slope: dict[int, Scalar] = {own: x[own] * 2.0 if len(forces) > 1 else 1.0}
            for weight, row in zip(weights, self.pressing[k], strict=True):
                for c, n in self.place.items():
                    if c in row:
                        slope[n] = slope.get(n, 0.0) + weight * row[c]
            slopes.append(slope)
        return values, slopes

    def pressed(self, k: int, found: Mapping[int, Scalar], a: Balls) -> float:
        """How large the force is that presses at a rub; 0.0 where it vanishes."""
        x = [found[column] for column in self.place]
        forces = [self._at(row, x) for row in self.pressing[k]]
        size = max(
            abs(row.get(c, 0.0)) * abs(x[n]) for row in self.pressing[k] for c, n in self.place.items()
        )
        size = max(size, *(abs(row.get(self.statics.known, 0.0)) for row in self.pressing[k]))
        if all_vanish(a, ((force, size) for force in forces)):
            return 0.0
        return math.hypot(*map(float, forces))

    def _at(self, row: Row, x: Sequence[Scalar]) -> Scalar:
        total = row.get(self.statics.known, 0.0)
        for c, n in self.place.items():
            if c in row:
                total = total + row[c] * x[n]
        return total
