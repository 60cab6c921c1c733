"""The ways in which a construction assembles: every branch that the data leave open, in order.

A depth-first walk over the steps. A step with two places takes the one that `near` picks, keeps both
where nothing picks, and drops those that the data rule out; ways that get to the end are kept.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from icsolve.assembly.board import Board, Key, Point
from icsolve.assembly.data import Datum
from icsolve.assembly.frame import normalised
from icsolve.assembly.loci import Crossing, is_round
from icsolve.assembly.misfit import TOO_CLOSE, misfit
from icsolve.assembly.order import Order
from icsolve.assembly.refusals import Miss, behind, clash, concentric, degenerate, merged, parallel, too_far
from icsolve.assembly.step import CLOSED_FORMS, Step, aims
from icsolve.assembly.steps import Meet
from icsolve.assembly.words import plain
from icsolve.errors import Status

U = 2.0**-53
TOUCHING = 8.0 * U
"""Gaps below this many roundings of the lengths that made them are zero: the circles touch."""
PARALLEL = 1e-14
"""Sine of the smallest angle at which two lines still meet."""
COARSE = 0.02
"""Misfit at which a way is given up before its end; the finer test comes with the whole figure."""
EVEN = 0.99
SIDEWAYS = 0.05
"""Two ways are equally near where their distances from `near` have at least the ratio EVEN, and `near`
is seen from between them within this sine of square to the line that joins them. (Near a dead centre the two
are close together, and the ratio alone would call any two digits of `near` in between.)"""
MOST_WAYS = 256


class Way(NamedTuple):
    """One way of assembling: the steps as they were settled, and the points."""

    steps: tuple[Step, ...]
    points: dict[Key, Point]


class Fork(NamedTuple):
    """Where the walk can go on otherwise: only if no way was found since, where ``spare``."""

    depth: int
    options: list[Step]
    spare: bool
    found: int


class Walker:
    """The walk over the steps of an order on one board.

    ``ways`` has what it found, ``misses`` (with their depth) what failed on the paths that `near`
    chose; ``gave_up`` tells that there were too many branches to try.
    """

    def __init__(self, order: Order, board: Board) -> None:
        self.order, self.board = order, board
        self.near = {p: normalised(board.frame, xy) for p, xy in board.case.near.items()}
        self.checks = _due(order)
        self.steps = list(order.steps)
        self.budget = 20_000 + 20 * len(self.steps)
        self.ways: list[Way] = []
        self.misses: list[tuple[int, Miss]] = []
        self.gave_up = False
        self.spared = 0

    def walk(self) -> Walker:
        """Try every way."""
        forks: list[Fork] = []
        depth = 0
        while depth >= 0:
            if depth < len(self.steps):
                depth = self._advance(depth, forks, len(self.ways))
            if depth == len(self.steps):
                self.ways.append(Way(tuple(self.steps), dict(self.board.points)))
                depth = -1
            if depth < 0:
                depth = self._back(forks, len(self.ways))
            if self.budget <= 0 or len(self.ways) > MOST_WAYS:
                self.gave_up = depth >= 0
                break
        return self

    def _advance(self, depth: int, forks: list[Fork], found: int) -> int:
        """Run one step; the next depth, or -1 where nothing fits."""
        self.budget -= 1
        options = list(self._options(depth, self.order.steps[depth]))
        if not options:
            return -1
        if len(options) > 1:
            forks.append(Fork(depth, options[1:], self._picked(options), found))
        return self._settle(depth, options[0])

    def _back(self, forks: list[Fork], found: int) -> int:
        """Take the last fork that is still of use; -1 where there is none."""
        while forks:
            fork = forks.pop()
            if fork.spare and found > fork.found:
                continue
            self.spared += fork.spare
            if len(fork.options) > 1:
                forks.append(fork._replace(options=fork.options[1:]))
            return self._settle(fork.depth, fork.options[0])
        return -1

    def _settle(self, depth: int, step: Step) -> int:
        self.steps[depth] = step
        self._put(step)
        return depth + 1

    def _put(self, step: Step) -> None:
        if isinstance(step, Meet):
            step.put(self.board, step.cross(self.board))
        else:
            step.place(self.board)

    def _options(self, depth: int, step: Step) -> Iterator[Step]:
        """The step as it can be settled here: the nearest first."""
        try:
            for option in self._settled(depth, step):
                self._put(option)
                miss = self._ahead(option) or self._clash(depth)
                if miss is None:
                    yield option
                else:
                    self._miss(depth, miss)
        except ZeroDivisionError:
            self._miss(depth, degenerate(step, self.board))

    def _settled(self, depth: int, step: Step) -> list[Step]:
        """The step with each of the branches that it has here."""
        points = self.board.points
        for a, b in aims(step):
            if math.dist(points[a], points[b]) <= TOO_CLOSE:
                self._miss(depth, merged(plain(step.targets[0]), plain(a), plain(b)))
                return []
        if isinstance(step, Meet):
            return [*self._crossings(depth, step)]
        if isinstance(step, CLOSED_FORMS):
            return [step]
        from icsolve.assembly.group import Group
        from icsolve.assembly.newton import solutions

        assert isinstance(step, Group)
        return [*solutions(step, self.board, self.near, lambda miss: self._miss(depth, miss))]

    def _crossings(self, depth: int, step: Meet) -> list[Step]:
        found = step.cross(self.board)
        miss = self._apart(step, found)
        if miss is not None:
            self._miss(depth, miss)
            return []
        if found.half is None:
            return [step]
        if any(abs(m) <= TOUCHING * found.scale for m in found.margins):
            return [step._replace(sign=0)]
        return [step._replace(sign=sign) for sign in self._by_near(step.target, found)]

    def _apart(self, step: Meet, found: Crossing) -> Miss | None:
        if not is_round(step.second):
            return parallel(step, self.board) if abs(found.scale) <= PARALLEL else None
        touching = TOUCHING * found.scale
        if min(found.margins) < -touching:
            return too_far(step, self.board, found)
        if is_round(step.first) and max(abs(m) for m in found.margins[1:]) <= touching:
            return concentric(step, self.board)
        return None

    def _by_near(self, target: Key, found: Crossing) -> tuple[int, int]:
        near = self.near.get(target) if isinstance(target, str) else None
        if near is None or found.half is None:
            return (1, -1)
        (x, y), (hx, hy) = found.middle, found.half
        return (1, -1) if (near[0] - x) * hx + (near[1] - y) * hy >= 0.0 else (-1, 1)

    def _picked(self, options: list[Step]) -> bool:
        """Whether `near` picks the first of two places of a point."""
        held = [t for t in options[0].targets if isinstance(t, str) and t in self.near]
        if not held:
            return False
        places = []
        for option in options[:2]:
            self._put(option)
            places.append([self.board.points[t] for t in held])
        return nearer(places[0], places[1], [self.near[t] for t in held])

    def _ahead(self, step: Step) -> Miss | None:
        if not isinstance(step, Meet):
            return None
        worst = min(step.ahead(self.board), default=1.0)
        return None if worst > TOO_CLOSE else behind(step, self.board, worst)

    def _clash(self, depth: int) -> Miss | None:
        for datum in self.checks.get(depth, ()):
            off, ahead = misfit(self.board, datum)
            reach = 1.0 + max(abs(c) for p in datum.points for c in self.board.points[p])
            if not ahead or abs(off) > COARSE * reach:
                return clash(self.board, datum, off, ahead)
        return None

    def _miss(self, depth: int, miss: Miss) -> None:
        """Keep the misses of the ways that `near` chose."""
        if self.spared == 0:
            self.misses.append((depth, miss))


def nearer(one: list[Point], two: list[Point], near: list[Point]) -> bool:
    """Whether the first of two placements of some points is clearly the nearer to `near`.

    Both are points of a space of twice as many dimensions; ``side`` is how far `near` is from the
    plane midway between them.
    """
    first, second, half = _distance(one, near), _distance(two, near), _distance(one, two) / 2.0
    if half == 0.0 or first < EVEN * second:
        return half > 0.0
    side = (second - first) * (second + first) / (4.0 * half)
    return side > SIDEWAYS * math.sqrt((first * first + second * second) / 2.0)


def _distance(one: list[Point], two: list[Point]) -> float:
    return math.hypot(*(math.dist(p, q) for p, q in zip(one, two, strict=True)))


def _due(order: Order) -> dict[int, list[Datum]]:
    """The data to compare after each step: those whose last point it places."""
    depth = {key: i for i, step in enumerate(order.steps) for key in step.targets}
    due: dict[int, list[Datum]] = {}
    for datum in order.facts.data:
        if all(p in depth for p in datum.points):
            due.setdefault(max(depth[p] for p in datum.points), []).append(datum)
    return due


def refusal(walk: Walker) -> Miss:
    """The miss to report of a figure that does not assemble: the deepest, of these the smallest."""
    if walk.gave_up:
        forks = [step.target for step in walk.steps if isinstance(step, Meet) and step.sign]
        names = ", ".join(plain(key) for key in forks if key not in walk.near)
        message = f"the figure has too many open branches to try them all; give near: for some of {names}"
        return Miss(Status.AMBIGUOUS, message)
    return min(walk.misses, key=lambda at: (-at[0], at[1].amount))[1]
