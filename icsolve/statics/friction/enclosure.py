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
from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal
from types import MappingProxyType

from icsolve.answer.bodies import Reactions, Tension
from icsolve.kinematics.speeds import Speed
from icsolve.numbers import Scalar, Showing, all_vanish, size_of
from icsolve.numbers.balls import Balls, MoreDigits
from icsolve.numbers.krawczyk import enclosed_root
from icsolve.numbers.linear import Row, eliminate
from icsolve.statics.equilibrium import Rub, Statics, equations_of, equilibrium
from icsolve.statics.free_bodies import Solved, carrying_flanks, on_flanks
from icsolve.statics.friction import rubbing_rates, rubs_of
from icsolve.statics.friction.equations import forces_of
from icsolve.statics.load_wrenches import Wrench
from icsolve.statics.power import Balance, Bounded
from icsolve.statics.reaction_basis import Position, meshes, rope_ties, slipping, ties_of, with_flanks
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
    reactions, tensions : of the solution, where they were asked for
    """

    why: str = ""
    bounds: Mapping[str, float] = MappingProxyType({})
    values: Mapping[str, float] = MappingProxyType({})
    friction: tuple[float, ...] = ()
    reactions: Reactions | None = None
    tensions: tuple[Tension, ...] = ()


def slopes(
    position: Position, solved: Solved, senses: Sequence[float], traced: Bounded
) -> dict[str, dict[str, float]]:
    """By load and by the path of a number, the derivative [case units].

    Raises LookupError, with the reason, where it has none, and so near a singular position that the tape does
    not tell.
    """
    if any(sense and not friction for sense, friction in zip(senses, solved.friction, strict=True)):
        raise LookupError(AT_KINK)
    from icsolve.numbers.tape import SMALL

    tape, outcome, statics = traced.tape, traced.outcome, solved.statics
    x = statics.filled(solved.parameters)
    weights = _weights(statics, x, senses)
    if weights is None or max(tape.doubts(SMALL), default=0.0):
        raise LookupError(TOO_CLOSE)
    placed = position._replace(points=outcome.points, arithmetic=tape)
    placed = slipping(placed._replace(ropes=rope_ties(outcome.place)), [tie.senses for tie in statics.ropes])
    ties = with_flanks(placed, ties_of(placed), carrying_flanks(position, statics.ties, solved))
    exact = statics._replace(ties=ties, rubs=rubs_of(placed, ties), ropes=placed.ropes, arithmetic=tape)
    rest = residuals(exact, placed, outcome.balance.wrenches, x, senses)
    steps = [sum((w * value for w, value in zip(row, rest, strict=True)), 0.0) for row in weights]
    return {
        q: {path: -slope / statics.scale for path, slope in tape.back(step).by_path.items()}
        for q, step in zip(statics.roots, steps, strict=True)
    }


def residuals(
    columns: Statics,
    position: Position,
    wrenches: Sequence[Wrench],
    x: Mapping[int, Scalar],
    senses: Sequence[float],
) -> list[Scalar]:
    """What is left of the equilibrium of every link, then of every friction, which is against its sense and
    as large as its coefficient makes it (scaled); ``columns`` are of the position's arithmetic.
    """
    equations = equations_of(columns, position, wrenches)
    rest: list[Scalar] = [
        sum((a * x[c] for c, a in row.items()), 0.0) for link in equations.values() for row in link[1]
    ]
    for k, rub in enumerate(columns.rubs):
        force = pressing(columns, rub, x)
        size = size_of(force[0]) if len(force) == 1 else columns.arithmetic.sqrt(sum(f * f for f in force))
        rest.append(x[columns.rub(k)] + senses[k] * (rub.limit * size))
    return rest


def pressing(statics: Statics, rub: Rub, values: Mapping[int, Scalar]) -> list[Scalar]:
    """The force that bounds the friction of a rub, by components."""
    first = statics.first[rub.tie]
    return [sum((values[first + n] * a for n, a in enumerate(row)), 0.0) for row in rub.normal]


OPEN = 1e-9
"""What is left of a unit of an unknown load below this is rounding."""


def _weights(statics: Statics, x: Row, senses: Sequence[float]) -> list[list[float]] | None:
    """What a unit of each residual does to each unknown load (the adjoint solution), (roots, residuals); None
    where the equations do not determine one."""
    rows = [row for _, three in statics.equations.values() for row in three]
    for k, rub in enumerate(statics.rubs):
        force = pressing(statics, rub, x)
        size = math.hypot(*force) or 1.0
        parts = zip(*rub.normal, strict=True)
        shares = [sum(f * a / size for f, a in zip(force, part, strict=True)) for part in parts]
        first, most = statics.first[rub.tie], senses[k] * rub.limit
        rows.append({statics.rub(k): 1.0, **{first + n: most * share for n, share in enumerate(shares)}})
    by_column: dict[int, Row] = {}
    for n, row in enumerate(rows):
        for column, a in row.items():
            if column != statics.known:
                by_column.setdefault(column, {})[n] = a
    loads = range(len(statics.roots))
    for q in loads:
        by_column.setdefault(statics.root(q), {})[len(rows) + q] = -1.0
    general = eliminate([by_column[c] for c in sorted(by_column)], len(rows))
    if any(abs(a) > OPEN for left in general.left for a in left.values()):
        return None
    return [[general.of(n).get(len(rows) + q, 0.0) for n in range(len(rows))] for q in loads]


Flanks = Mapping[int, float]
Senses = Sequence[tuple[float, ...]]


class SceneOnBalls(NamedTuple):
    """A scene on balls, and which of its motions is meant; ``made`` keeps its statics."""

    position: Position
    balance: Balance
    speed: Callable[[], Speed]
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

    None where a sense is another than the balls say, or no flanks of the teeth are those that carry. Raises
    MoreDigits where they leave that open, and where no solution is shown.
    """
    rope_senses = [tie.senses for tie in solved.statics.ropes]
    if not _moves_so(scene, senses, rope_senses):
        return None
    flanks = {}
    if meshes(solved.statics.ties):
        flanks = carrying_flanks(scene.position, ties_of(scene.position), solved)
    # doubles lose a tooth force beside far larger ones, and with it the flank that carries
    found = on_flanks(
        flanks, lambda these: _on_flanks(scene, solved, senses, scene.statics(these, rope_senses))
    )
    return found if all(found.carrying(t) > 0.0 for t in flanks) else None


def _on_flanks(scene: SceneOnBalls, solved: Solved, senses: Sequence[float], statics: Statics) -> Solved:
    """The solution on balls near one in doubles, of statics with teeth on some flanks."""
    a, rubs = scene.arithmetic, statics.rubs
    assert isinstance(a, Balls)
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
    moving = rubbing_rates(scene.position, scene.speed()).in_floats.senses
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
