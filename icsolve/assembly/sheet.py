"""A sheet on which points are put one after another: the ground's, or one that moves with a shape.

The ground's sheet has coordinates and absolute directions. A loose sheet starts from a length whose
place is not known yet and grows by lengths, corners and guides alone: the shape of a link, or of
several that hold one another. A shape that shares one point with another sheet lends it
distances; one that shares two is carried by them.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterable

from icsolve.assembly.board import Key
from icsolve.assembly.data import LENGTH, LINE, MEAN, RAY, Facts
from icsolve.assembly.given import Given
from icsolve.assembly.heading import Apart, Heading
from icsolve.assembly.loci import Circle, Line, Shifted
from icsolve.assembly.reach import Cost, best_step
from icsolve.assembly.shapes import Transfer, Turned
from icsolve.assembly.step import Step
from icsolve.assembly.steps import Meet, Polar

NOBODY, LOOSE_SHEETS, ALL_SHEETS = 0, 1, 2
"""Which sheets lend their distances to loose ones."""


class Drawing:
    """All sheets of a figure, and the steps so far in the order in which they can run.

    ``lenders`` says which sheets lend distances to loose ones; ``holding`` which sheets hold a
    point; ``banned`` has the pairs of loci that turned out not to determine a point (parallel
    lines, concentric circles).
    """

    __slots__ = ("banned", "count", "facts", "holding", "lenders", "sheets", "steps")

    def __init__(self, facts: Facts, banned: frozenset[frozenset[object]]) -> None:
        self.facts = facts
        self.banned = banned
        self.holding: dict[str, list[Sheet]] = {}
        self.steps: list[Step] = []
        self.count = 0
        self.lenders = NOBODY
        self.sheets: list[Sheet] = []
        self.sheets.append(Sheet(self))

    def tick(self) -> int:
        """A number that rises."""
        self.count += 1
        return self.count

    @property
    def ground(self) -> Sheet:
        """The sheet that does not move."""
        return self.sheets[0]


class Sheet:
    """Points that are in place with respect to one another; ``number`` 0 is the ground.

    ``placed`` has the cost of each point's step. ``headings`` has the known directions of pairs
    that are arms of corners or have a direction given. ``committed`` has the numbers of the
    sheets that lent a distance: their shapes are part of this one; ``carried`` the lengths of the
    vectors by which loci were moved.
    """

    __slots__ = ("carried", "committed", "dirty", "drawing", "headings", "heap", "number", "placed", "turn")

    def __init__(self, drawing: Drawing) -> None:
        self.drawing = drawing
        self.number = len(drawing.sheets)
        self.placed: dict[str, Cost] = {}
        self.headings: dict[tuple[str, str], Heading] = {}
        self.committed: set[int] = set()
        self.carried: set[object] = set()
        self.dirty: dict[str, None] = {}
        self.heap: list[tuple[Cost, int, str, Step]] = []
        self.turn: dict[str, int] = {}

    def key(self, point: str) -> Key:
        """The point's key on a board."""
        return point if self.number == 0 else (self.number, point)

    def begin(self, points: list[str]) -> None:
        """Start the ground's sheet from the given points and directions."""
        if points:
            self.put(Given(tuple(points)), points, (0, 0, 0))
        for datum in self.drawing.facts.data:
            if datum.kind == RAY:
                a, b = datum.points
                self.learn(a, b, Heading(datum))
        for point in self.drawing.facts.of:
            self.mark(point)

    def put(self, step: Step, points: Iterable[str], cost: Cost) -> None:
        """Take a step: its points are in place, and others come within reach."""
        drawing = self.drawing
        drawing.steps.append(step)
        aimed = _aimed_from(step)
        self._commit(step)
        for point in points:
            self.placed[point] = cost
            drawing.holding.setdefault(point, []).append(self)
            self._orient(point, aimed)
        for point in points:
            self.reach_from(point)

    def reach_from(self, point: str) -> None:
        """Mark what a point in place may help to place."""
        for datum in self.drawing.facts.of.get(point, ()):
            for other in datum.points:
                self.mark(other)
        for sheet in self.drawing.holding.get(point, ()):
            if sheet is not self and sheet.number != 0:
                for other in sheet.placed:
                    self.mark(other)

    def mark(self, point: str) -> None:
        """Look at a point again, and at those that hang on it by a known vector."""
        stack = [point]
        while stack:
            p = stack.pop()
            if p in self.placed or p in self.dirty:
                continue
            self.dirty[p] = None
            for datum in self.drawing.facts.of.get(p, ()):
                if datum.kind == LENGTH:
                    a, b = datum.points
                    if (a, b) in self.headings:
                        stack.append(b if a == p else a)

    def learn(self, a: str, b: str, heading: Heading) -> None:
        """Note a direction, and those that corners make of it."""
        arms, stack = self.drawing.facts.arms, [(a, b, heading)]
        while stack:
            a, b, heading = stack.pop()
            if (a, b) in self.headings:
                continue
            self.headings[a, b], self.headings[b, a] = heading, heading.reverse()
            self._renew(a)
            self._renew(b)
            for at, arm in ((a, b), (b, a)):
                for corner, other, sense in arms.get((at, arm), ()):
                    stack.append((at, other, self.headings[at, arm].turned(corner, sense)))

    def run(self, goal: set[str] | None = None, most: int | None = None) -> bool:
        """Place what can be placed, cheapest data first, until the goal is reached; whether any was.

        At most ``most`` points, where it is given.
        """
        start = len(self.placed)
        while goal is None or not goal <= self.placed.keys():
            if most is not None and len(self.placed) >= start + most:
                break
            self._weigh()
            if not self.heap:
                break
            cost, turn, point, step = heapq.heappop(self.heap)
            if point not in self.placed and self.turn[point] == turn:
                self.put(step, (point,), cost)
        return len(self.placed) > start

    def _weigh(self) -> None:
        """Find the best step of every marked point."""
        dirty, self.dirty = self.dirty, {}
        for point in dirty:
            found = None if point in self.placed else best_step(self, point)
            if found is not None:
                turn = self.turn[point] = self.drawing.tick()
                heapq.heappush(self.heap, (found[0], turn, point, found[1]))

    def _renew(self, point: str) -> None:
        self.mark(point)
        for datum in self.drawing.facts.of.get(point, ()):
            if datum.kind == LINE:
                for other in datum.points:
                    self.mark(other)
        for sheet in self.drawing.holding.get(point, ()):
            if sheet is not self and sheet.number != 0:
                for other in sheet.placed:
                    self.mark(other)

    def _commit(self, step: Step) -> None:
        self.carried.update(carried_by(step))
        if isinstance(step, Transfer | Turned):
            self.committed.add(step.shape[0][0])  # type: ignore[arg-type]
        elif isinstance(step, Meet):
            for locus in (step.first, step.second):
                if isinstance(locus, Circle) and isinstance(locus.radius, Apart):
                    key = locus.radius.a
                    self.committed.add(key[0] if isinstance(key, tuple) else 0)

    def _orient(self, point: str, aimed: set[Key]) -> None:
        """Directions between the point and its neighbours in place.

        A direction that the data gave stays where it placed the point; elsewhere the points
        outrank it.
        """
        for datum in self.drawing.facts.of.get(point, ()):
            if datum.kind in (LENGTH, MEAN):
                continue
            for other in datum.points:
                if other == point or other not in self.placed or self.key(other) in aimed:
                    continue
                pair = Heading(Apart(self.key(point), self.key(other)))
                if (point, other) in self.headings:
                    self.headings[point, other], self.headings[other, point] = pair, pair.reverse()
                else:
                    self.learn(point, other, pair)


def carried_by(step: Step) -> set[object]:
    """The lengths of the vectors by which a step moves loci."""
    spans: set[object] = set()
    loci = [step.first, step.second] if isinstance(step, Meet) else []
    for locus in loci:
        if isinstance(locus, Shifted):
            spans.add(locus.span)
            loci.append(locus.base)
    return spans


def _aimed_from(step: Step) -> set[Key]:
    """The points from which a step aims along a known direction."""
    if isinstance(step, Polar):
        return {step.base}
    if isinstance(step, Meet):
        return {locus.through for locus in (step.first, step.second) if isinstance(locus, Line) and locus.ray}
    return set()
