"""The bound of an unknown load that was found with friction, or why none is proven; its slopes.

To first order: in the solution the equilibrium of every link and the friction of every rub leave a residual.
Each unknown load has weights, one an equation (the adjoint solution): their sum over the residuals is a step
of Newton's method for that load. Evaluated on a tape, the sum carries the rounding of the figure, of the
file's decimals and of every term into the load, and gives its slope by every number of the case.

Where next to no force presses, its size has a kink: there the friction is left out of the derivatives and
counted as open between its limits, for as large a force as rounding can make of it.

Enclosed, where the equations are smooth: that they have one solution near the one that floats found, and how
far from it (Krawczyk's operator on balls). The unknowns are the loads to find and the friction f of every rub
that slides: the sums of power are linear in them, and f^2 = limit^2 |N|^2 with the force N that presses
there, linear too. The sense of each rub is that of its rate in the motion, of which the ball has to say it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

from icsolve.case.joints import Mesh
from icsolve.kinematics.speeds import Speed
from icsolve.numbers.arithmetic import Scalar, Showing
from icsolve.numbers.balls import Balls
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
AT_KINK = "next to no force presses at a joint that rubs, and there its friction has no slope"
HELICAL = f"{UNSURE} with helical teeth"
MISSED = f"{UNSURE} where given centres or contacts miss the motion"
TOO_CLOSE = f"{UNSURE} so near to a dead centre or a jam"


class ErrorBounds(NamedTuple):
    """What is proven of the loads of a solution with friction.

    Attributes
    ----------
    bounds : by load, of the absolute error [case units]; empty where none is proven, and ``why``
    slopes : by load and by the path of a number, the derivative [case units]
    values : the loads themselves, where they were enclosed
    """

    bounds: Mapping[str, float]
    slopes: Mapping[str, Mapping[str, float]]
    why: str = ""
    values: Mapping[str, float] = MappingProxyType({})
    """the loads themselves, where they were enclosed"""


def error_bounds(
    position: Position,
    solved: Solved,
    senses: Sequence[float],
    traced: Bounded | None,
    speed: Speed,
) -> ErrorBounds:
    """Bounds of the loads of a solution, whose rubs all have these senses."""
    if traced is None:
        return ErrorBounds({}, {}, UNBOUND)
    found = SlidingSolution(solved.statics, solved.statics.filled(solved.parameters), tuple(senses))
    weights = weights_of(found, outputs_of(found))
    why = _doubt(position, traced)
    if weights is None or why:
        return ErrorBounds({}, {}, why or UNSURE)
    exact = _exact(position, solved, found, traced)
    if not _senses_are_sure(exact, senses, traced, speed):
        return ErrorBounds({}, {}, TOO_CLOSE)
    return _judged(solved, *_swept(found, solved, weights, exact, traced))


def _swept(
    found: SlidingSolution, solved: Solved, weights: Sequence[Weights], exact: Exact, traced: Bounded
) -> tuple[list[float] | None, dict[str, dict[str, float]]]:
    """Bounds of the unknown loads (scaled; None: without limit), and slopes where nothing has a kink."""
    rests = [step(found, by, exact) for by in weights]
    passes = [traced.tape.back(rest) for rest in rests]
    bounds = [abs(rest) + swept.bound for rest, swept in zip(rests, passes, strict=True)]
    roots, scale = solved.statics.roots, solved.statics.scale
    count = len(roots)
    by_root = zip(roots, passes, strict=False)
    slopes = {q: {path: -slope / scale for path, slope in swept.by_path.items()} for q, swept in by_root}
    if not found.kinks:
        return bounds, slopes
    most = open_frictions(found, weights[count:], bounds[count:])
    if most is None:
        return None, {}
    for n in range(count):
        bounds[n] += sum(abs(weights[n].rubs[k]) * f for k, f in zip(found.kinks, most, strict=True))
    return bounds[:count], {}


def _judged(solved: Solved, scaled: list[float] | None, slopes: dict[str, dict[str, float]]) -> ErrorBounds:
    """Bounds that are small beside their loads."""
    if scaled is None:
        return ErrorBounds({}, {}, AT_KINK)
    bounds = {q: bound / solved.statics.scale for q, bound in zip(solved.statics.roots, scaled, strict=False)}
    sizes = {root: abs(solved.unknowns[root]) for root in bounds}
    if any(SMALL * sizes[root] < bound < sizes[root] for root, bound in bounds.items()):
        return ErrorBounds({}, slopes, TOO_CLOSE)
    return ErrorBounds(bounds, slopes, "" if slopes else AT_KINK)


def _doubt(position: Position, traced: Bounded) -> str:
    """Why a bound of first order would not do."""
    if position.case.screws:
        return f"{UNSURE} with screws"
    if position.slack:
        return MISSED
    if any(isinstance(joint, Mesh) and joint.helix is not None for joint in position.case.joints):
        return HELICAL
    return TOO_CLOSE if max(traced.tape.doubts(SMALL), default=0.0) else ""


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


def _senses_are_sure(exact: Exact, senses: Sequence[float], traced: Bounded, speed: Speed) -> bool:
    """Whether no rate that gave a sense lies within its own bound of zero."""
    twists = traced.outcome.motions.twists
    rates = rubbing_rates(exact.position._replace(twists=twists, ropes=exact.statics.ropes), speed)
    own = zip(senses, rates.rubs, strict=True)
    ropes = (
        (s, r)
        for tie, row in zip(exact.statics.ropes, rates.ropes, strict=True)
        for s, r in zip(tie.senses, row, strict=True)
    )
    return all(rate is not None and abs(rate) > traced.of(rate) for sense, rate in (*own, *ropes) if sense)


KINK = 1e-6
"""A force that presses where links rub has a slope only well above zero: this fraction of the largest."""
OPEN = 1e-9
"""What is left of a unit of an unknown load below this is rounding."""


class SlidingSolution(NamedTuple):
    """A solution with friction: values of all columns of its statics (scaled), the senses of the rubs."""

    statics: Statics
    values: Row
    senses: tuple[float, ...]

    @property
    def kinks(self) -> tuple[int, ...]:
        """The rubs at which next to no force presses."""
        least = KINK * max(map(abs, self.values.values()))
        sizes = [math.hypot(*pressing(self.statics, rub, self.values)) for rub in self.statics.rubs]
        return tuple(k for k, size in enumerate(sizes) if self.senses[k] and size <= least)


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


Output = dict[int, float]
"""A combination of columns whose error is asked for."""


def outputs_of(found: SlidingSolution) -> list[Output]:
    """The unknown loads, then the components of the forces that press at kinks."""
    statics = found.statics
    loads: list[Output] = [{statics.root(q): 1.0} for q in range(len(statics.roots))]
    for k in found.kinks:
        rub = statics.rubs[k]
        loads += [{statics.first[rub.tie] + n: a for n, a in enumerate(row)} for row in rub.normal]
    return loads


def weights_of(found: SlidingSolution, outputs: Sequence[Output]) -> list[Weights] | None:
    """The weights of every output; None where the equations do not determine one."""
    equations = found.statics.equations
    rows = [row for _, three in equations.values() for row in three] + _frictions(found)
    by_column: dict[int, Row] = {}
    for n, row in enumerate(rows):
        for column, a in row.items():
            if column != found.statics.known:
                by_column.setdefault(column, {})[n] = a
    for q, output in enumerate(outputs):
        for column, a in output.items():
            by_column.setdefault(column, {})[len(rows) + q] = -a
    general = eliminate([by_column[c] for c in sorted(by_column)], len(rows))
    if any(abs(a) > OPEN for left in general.left for a in left.values()):
        return None
    return [
        _weights({link: about for link, (about, _) in equations.items()}, all_weights)
        for q in range(len(outputs))
        if (all_weights := [general.of(n).get(len(rows) + q, 0.0) for n in range(len(rows))])
    ]


def _weights(about: Mapping[str, Components], values: Sequence[float]) -> Weights:
    links: dict[str, tuple[Point, Force]] = {}
    for k, (link, at) in enumerate(about.items()):
        links[link] = ((at[0], at[1]), (values[3 * k], values[3 * k + 1], values[3 * k + 2]))
    return Weights(links, tuple(values[3 * len(about) :]))


def _frictions(found: SlidingSolution) -> list[Row]:
    """Derivatives of each friction's residual: itself, and its coefficient times the size of its force."""
    rows, kinks = [], found.kinks
    for k, rub in enumerate(found.statics.rubs):
        force = pressing(found.statics, rub, found.values)
        size = math.hypot(*force) or 1.0
        row: Row = {found.statics.rub(k): 1.0}
        for n in range(len(rub.normal[0]) if k not in kinks else 0):
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
    if k in found.kinks:
        return weights.rubs[k] * exact.values[found.statics.rub(k)]
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


def open_frictions(
    found: SlidingSolution, outputs: Sequence[Weights], bounds: Sequence[float]
) -> list[float] | None:
    """What the frictions at kinks can be at most (scaled), in the order of the kinks; None without a limit.

    ``outputs`` and ``bounds`` are the weights and the errors of the forces that press there, without
    these frictions, which can press too.
    """
    places: list[tuple[int, int]] = []
    for k in found.kinks:
        places += [(k, n) for n in range(len(found.statics.rubs[k].normal))]
    most = dict.fromkeys(found.kinks, 2.0**-60 * max(map(abs, found.values.values())))
    for _ in range(ROUNDS):
        before = dict(most)
        for k in found.kinks:
            rub = found.statics.rubs[k]
            force = pressing(found.statics, rub, found.values)
            rows = [m for m, (at, _) in enumerate(places) if at == k]
            off = [bounds[m] + sum(abs(outputs[m].rubs[j]) * most[j] for j in most) for m in rows]
            most[k] = rub.limit * math.hypot(*(abs(f) + b for f, b in zip(force, off, strict=True)))
        if all(most[k] <= before[k] * (1.0 + 1e-9) for k in most):
            return [2.0 * most[k] for k in found.kinks]
    return None


ROUNDS = 60
"""More often than this the frictions at kinks press each other without limit."""


class SceneOnBalls(NamedTuple):
    """A scene on balls, and which of its motions is meant."""

    position: Position
    balance: Balance
    speed: Speed
    arithmetic: Showing


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
    position = slipping(scene.position, rope_senses)
    ties = with_flanks(position, ties_of(position), carrying_flanks(position, solved.statics.ties, solved))
    rubs = rubs_of(position, ties)
    statics = equilibrium(position, ties, scene.balance, rubs)
    slides = [k for k, sense in enumerate(senses) if sense]
    columns = [statics.root(n) for n in range(len(statics.roots))] + [statics.rub(k) for k in slides]
    start = [solved.unknowns[root] * statics.scale for root in statics.roots]
    start += [solved.friction[k] for k in slides]
    found = enclosed_root(_FrictionSystem(statics, columns, slides), start, a)
    unknowns = {root: x / statics.scale for root, x in zip(statics.roots, found, strict=False)}
    sliding = dict(zip(slides, found[len(statics.roots) :], strict=True))
    return Solved(statics, unknowns, tuple(sliding.get(k, 0.0) for k in range(len(rubs))))


def _moves_so(scene: SceneOnBalls, senses: Sequence[float], rope_senses: Sequence[Sequence[float]]) -> bool:
    """Whether everything rubs in these senses; where no motion is given, perhaps in all the opposite ones."""
    moving = rubbing_rates(scene.position, scene.speed).in_floats.senses
    asked = [sense for row in (senses, *rope_senses) for sense in row]
    opposite = [-sense for sense in asked]
    return moving.every == asked or (not scene.position.case.motion and moving.every == opposite)


class _FrictionSystem:
    """The equations and their derivatives, by the place of each unknown."""

    def __init__(self, statics: Statics, columns: Sequence[int], slides: Sequence[int]) -> None:
        self.statics, self.slides = statics, slides
        self.place = {column: n for n, column in enumerate(columns)}
        every = (*columns, statics.known)
        powers = [[left.get(c, 0.0) for c in every] for left in statics.general.left]
        chosen = independent(powers, len(statics.roots))
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
            values.append(x[own] * x[own] - square * sum((n * n for n in forces), 0.0))
            slope: dict[int, Scalar] = {own: x[own] * 2.0}
            for force, row in zip(forces, self.pressing[k], strict=True):
                for c, n in self.place.items():
                    if c in row:
                        slope[n] = slope.get(n, 0.0) - square * force * row[c] * 2.0
            slopes.append(slope)
        return values, slopes

    def _at(self, row: Row, x: Sequence[Scalar]) -> Scalar:
        total = row.get(self.statics.known, 0.0)
        for c, n in self.place.items():
            if c in row:
                total = total + row[c] * x[n]
        return total


def is_smooth(position: Position, solved: Solved) -> bool:
    """Whether the equations are smooth at a solution, so that it can be enclosed.

    Not where next to no force presses, or where given centres miss the motion.
    """
    frictions = [abs(f) for f in solved.friction]
    if len(frictions) != len(solved.statics.rubs) or position.slack:
        return False
    largest = max(map(abs, solved.statics.filled(solved.parameters).values()), default=0.0)
    return all(f > KINK * largest for f in frictions if f) and math.isfinite(largest)
