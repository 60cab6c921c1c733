"""The order of construction: which steps place the points that are asked for, and no others.

Topology alone decides; numbers come later. Closed forms first; where they stall, the shapes of loose links
(their distances then serve as lengths); where these stall too, the smallest group of points that only all
their data together determine.

Points are put one after another on clusters. The ground's has coordinates and absolute directions. A loose
cluster starts from a length whose place is not known yet and grows by lengths, corners and guides alone:
the shape of a link, or of several that hold one another. A shape that shares one point with another cluster
lends it distances; one that shares two is carried by them.
"""

from __future__ import annotations

import heapq
from collections.abc import Collection, Iterable

from icsolve.assembly.candidates import Cost, best_step
from icsolve.assembly.loci import CircleLocus, LineLocus, Shifted
from icsolve.assembly.steps import (
    Base,
    Given,
    Meet,
    Polar,
    Step,
    Turned,
    leading_to,
    points_of,
    sensed,
)
from icsolve.assembly.workspace import (
    CORNER,
    LENGTH,
    LINE,
    MEAN,
    RAY,
    ROPE,
    Apart,
    Datum,
    Facts,
    Key,
    LineDirection,
    data_in,
    facts_of,
    given_points,
)
from icsolve.case import Case
from icsolve.tuples import NamedTuple

NOBODY, LOOSE_CLUSTERS, ALL_CLUSTERS = 0, 1, 2
"""Which clusters lend their distances to loose ones."""


class LooseFigure:
    """All clusters of a figure, and the steps so far in the order in which they can run.

    ``lenders`` says which clusters lend distances to loose ones; ``holding`` which clusters hold a
    point; ``banned`` has the pairs of loci that turned out not to determine a point (parallel
    lines, concentric circles).
    """

    __slots__ = ("banned", "clusters", "count", "facts", "holding", "lenders", "steps")

    def __init__(self, facts: Facts, banned: frozenset[frozenset[object]]) -> None:
        self.facts = facts
        self.banned = banned
        self.holding: dict[str, list[Cluster]] = {}
        self.steps: list[Step] = []
        self.count = 0
        self.lenders = NOBODY
        self.clusters: list[Cluster] = []
        self.clusters.append(Cluster(self))

    def tick(self) -> int:
        """The next number of a count: a step of a point that was weighed later makes its older ones stale."""
        self.count += 1
        return self.count

    @property
    def ground(self) -> Cluster:
        """The cluster that does not move."""
        return self.clusters[0]


class Cluster:
    """Points that are in place with respect to one another; ``number`` 0 is the ground.

    ``placed`` has the cost of each point's step. ``directions`` has the known directions of pairs
    that are arms of corners or have a direction given. ``committed`` has the numbers of the
    clusters that lent a distance: their shapes are part of this one; ``carried`` the lengths of the
    vectors by which loci were moved.
    """

    __slots__ = ("carried", "committed", "directions", "dirty", "drawing", "heap", "number", "placed", "turn")

    def __init__(self, drawing: LooseFigure) -> None:
        self.drawing = drawing
        self.number = len(drawing.clusters)
        self.placed: dict[str, Cost] = {}
        self.directions: dict[tuple[str, str], LineDirection] = {}
        self.committed: set[int] = set()
        self.carried: set[object] = set()
        self.dirty: dict[str, None] = {}
        self.heap: list[tuple[Cost, int, str, Step]] = []
        self.turn: dict[str, int] = {}

    def key(self, point: str) -> Key:
        """The point's key on a workspace."""
        return point if self.number == 0 else (self.number, point)

    def begin(self, points: list[str]) -> None:
        """Start the ground's cluster from the given points and directions."""
        if points:
            self.put(Given(tuple(points)), points, (0, 0, 0))
        for datum in self.drawing.facts.data:
            if datum.kind == RAY:
                a, b = datum.points
                self.learn(a, b, LineDirection(datum))
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
        for cluster in self.drawing.holding.get(point, ()):
            if cluster is not self and cluster.number != 0:
                for other in cluster.placed:
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
                    if (a, b) in self.directions:
                        stack.append(b if a == p else a)

    def learn(self, a: str, b: str, direction: LineDirection) -> None:
        """Note a direction, and those that corners make of it."""
        arms, stack = self.drawing.facts.arms, [(a, b, direction)]
        while stack:
            a, b, direction = stack.pop()
            if (a, b) in self.directions:
                continue
            self.directions[a, b], self.directions[b, a] = direction, direction.reverse()
            self._renew(a)
            self._renew(b)
            for at, arm in ((a, b), (b, a)):
                for corner, other, sense in arms.get((at, arm), ()):
                    stack.append((at, other, self.directions[at, arm].turned(corner, sense)))

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
        for cluster in self.drawing.holding.get(point, ()):
            if cluster is not self and cluster.number != 0:
                for other in cluster.placed:
                    self.mark(other)

    def _commit(self, step: Step) -> None:
        self.carried.update(carried_by(step))
        if isinstance(step, Turned):
            self.committed.add(step.shape[0][0])  # type: ignore[arg-type]
        elif isinstance(step, Meet):
            for locus in (step.first, step.second):
                if isinstance(locus, CircleLocus) and isinstance(locus.radius, Apart):
                    key = locus.radius.a
                    self.committed.add(key[0] if isinstance(key, tuple) else 0)

    def _orient(self, point: str, aimed: set[Key]) -> None:
        """Directions between the point and its neighbours in place.

        A direction that the data gave stays where it placed the point; elsewhere the points
        outrank it.
        """
        for datum in self.drawing.facts.of.get(point, ()):
            if datum.kind in (LENGTH, MEAN, ROPE):
                continue
            for other in datum.points:
                if other == point or other not in self.placed or self.key(other) in aimed:
                    continue
                pair = LineDirection(Apart(self.key(point), self.key(other)))
                if (point, other) in self.directions:
                    self.directions[point, other], self.directions[other, point] = pair, pair.reverse()
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
        return {
            locus.through for locus in (step.first, step.second) if isinstance(locus, LineLocus) and locus.ray
        }
    return set()


class Order(NamedTuple):
    """Steps in the order in which they run, the points that they place on the ground, and all data."""

    steps: tuple[Step, ...]
    points: tuple[str, ...]
    facts: Facts

    def used(self) -> frozenset[Datum]:
        """The data of which the construction is made."""
        return frozenset(datum for step in self.steps for datum in data_in(step))

    def either_sense(self) -> tuple[Datum, ...]:
        """The angles whose sense no step takes: their points may come to lie the opposite way."""
        held = {pair for step in self.steps for pair in sensed(step)}
        return tuple(
            datum
            for datum in self.facts.data
            if datum.kind in (RAY, CORNER)
            and set(datum.points) <= set(self.points)
            and not any(datum == one and ends <= set(datum.points) for one, ends in held)
        )


def order_of(
    case: Case,
    goal: Collection[str],
    banned: frozenset[frozenset[object]] = frozenset(),
    best_effort: bool = False,
) -> Order:
    """The order of construction of the goal's points.

    Parameters
    ----------
    goal : points to place
    banned : pairs of loci that are known not to determine a point
    best_effort : place whatever closed forms reach, and be silent about the rest

    Raises
    ------
    SceneError
        ``underdetermined``, ``ambiguous`` (a group without ``near``).
    """
    drawing = LooseFigure(facts_of(case), banned)
    ground, wanted = drawing.ground, set(goal)
    ground.begin(given_points(case))
    ground.run(wanted)
    while not wanted <= ground.placed.keys():
        if not grow(drawing) and not _group(drawing, case, goal, best_effort):
            break
        ground.run(wanted)
    steps = leading_to(wanted & ground.placed.keys() if best_effort else wanted, drawing.steps)
    return Order(steps, points_of(steps), drawing.facts)


def grow(drawing: LooseFigure) -> bool:
    """Draw the shapes of loose links, by no more than is needed; whether the ground may go on.

    First by their own data alone, then by distances that they lend one another, then point by point
    by those that the ground lends.
    """
    before = len(drawing.steps)
    _start(drawing)
    for lenders in (NOBODY, LOOSE_CLUSTERS, ALL_CLUSTERS):
        drawing.lenders = lenders
        _extend(drawing, most=1 if lenders == ALL_CLUSTERS else None)
        if len(drawing.steps) > before:
            for point in [p for cluster in drawing.clusters[1:] for p in cluster.placed]:
                drawing.ground.mark(point)
            return True
    return False


def _extend(drawing: LooseFigure, most: int | None) -> None:
    """Let every loose cluster take what is within its reach; with ``most``, the first that can.

    One of which two points are on the ground is part of it: what it could take the ground takes.
    """
    ground = drawing.ground.placed
    for cluster in drawing.clusters[1:]:
        if sum(point in ground for point in cluster.placed) > 1:
            continue
        for point in list(cluster.placed):
            cluster.reach_from(point)
        if cluster.run(most=most) and most is not None:
            return


def _start(drawing: LooseFigure) -> None:
    """A loose cluster for every length that no cluster holds."""
    for datum in drawing.facts.data:
        if datum.kind != LENGTH:
            continue
        a, b = datum.points
        if any(b in cluster.placed for cluster in drawing.holding.get(a, ())):
            continue
        cluster = Cluster(drawing)
        drawing.clusters.append(cluster)
        cluster.put(Base(cluster.key(a), cluster.key(b), datum), (a, b), (100, 100, 0))
        cluster.run()


def _group(drawing: LooseFigure, case: Case, goal: Collection[str], best_effort: bool) -> bool:
    """The smallest group that its data determine together becomes one step; else say what is free."""
    if best_effort:
        return False
    from icsolve.assembly.groups import next_group

    step, points = next_group(drawing, case, goal)
    drawing.ground.put(step, points, (400, 400, 1))
    return True
