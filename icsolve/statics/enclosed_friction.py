"""Loads with friction, enclosed: that the equations of equilibrium and friction have one solution near the
one that floats found, and how far from it (Krawczyk's operator on balls).

The unknowns are the loads to find and the friction f of every rub that slides: the sums of power are linear
in them, and f^2 = limit^2 |N|^2 with the force N that presses there, linear too. The sense of each rub is
that of its rate in the motion, of which the ball has to say it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from icsolve.numbers.arithmetic import Scalar, Showing
from icsolve.numbers.balls import Balls
from icsolve.numbers.krawczyk import enclosed_root
from icsolve.numbers.sparse import Row
from icsolve.statics.equilibrium import Statics, equilibrium, independent
from icsolve.statics.free_bodies import Solved, carrying_flanks
from icsolve.statics.friction_equations import forces_of
from icsolve.statics.friction_interface import rates_of, rubs_of
from icsolve.statics.power import Balance
from icsolve.statics.reaction_basis import Position, ties_of, with_flanks
from icsolve.tuples import NamedTuple


class SceneOnBalls(NamedTuple):
    """A scene on balls, and the share of each of its motions in the one that is meant."""

    position: Position
    balance: Balance
    particular: Sequence[Scalar]
    arithmetic: Showing


def enclosed(
    scene: SceneOnBalls, solved: Solved, senses: Sequence[float]
) -> Mapping[str, tuple[float, float]] | None:
    """The unknown loads (case units) rounded once, and their errors; the rubs have these senses.

    None where a sense, or the flank of a tooth, is another than the balls say. Raises MoreDigits where they
    leave that open, and where no solution is shown.
    """
    position, a = scene.position, scene.arithmetic
    assert isinstance(a, Balls)
    ties = with_flanks(position, ties_of(position), carrying_flanks(position, solved.statics.ties, solved))
    rubs = rubs_of(position, ties)
    rates = [rates_of(position, ties, rubs, m) for m in range(position.mobility)]
    for k, sense in enumerate(senses):
        rate = sum((part * row[k] for part, row in zip(scene.particular, rates, strict=True)), 0.0)
        if a.vanishes(rate, max(map(abs, scene.particular))) == bool(sense):
            return None
    statics = equilibrium(position, ties, scene.balance, rubs)
    slides = [k for k, sense in enumerate(senses) if sense]
    columns = [statics.root(n) for n in range(len(statics.roots))] + [statics.rub(k) for k in slides]
    start = [solved.unknowns[root] * statics.scale for root in statics.roots]
    start += [solved.friction[k] for k in slides]
    found = enclosed_root(_FrictionSystem(statics, columns, slides), start, a)
    return {root: a.rounded(x / statics.scale) for root, x in zip(statics.roots, found, strict=False)}


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
    """Whether the equations are smooth at a solution, and all of them algebraic.

    Not where next to no force presses, where ropes slip (by an exponential), or where given centres miss the
    motion.
    """
    frictions = [abs(f) for f in solved.friction]
    if len(frictions) != len(solved.statics.rubs) or position.slack:
        return False
    if any(rope.slips for rope in position.case.ropes):
        return False
    largest = max(map(abs, solved.statics.filled(solved.parameters).values()), default=0.0)
    return all(f > KINK * largest for f in frictions if f) and math.isfinite(largest)


KINK = 1e-6
"""A friction below this fraction of the largest force is not enclosed: the first-order bound tells of it."""
