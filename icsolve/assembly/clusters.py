"""Rigid clusters: points in place with respect to one another, the candidate loci on which their data put
further points, and the best step that these make.

The ground's cluster has coordinates and absolute directions. A loose one starts from a length whose place is
not known yet and grows by lengths, corners and guides alone: the shape of a link, or of several that hold one
another. A shape that shares one point with another cluster lends it distances; one that shares two is carried
by them.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import combinations

from icsolve.assembly.loci import ArcLocus, Axis, CircleLocus, LineLocus, Locus, Shifted, Tether, is_round
from icsolve.assembly.steps import Base, Given, Mean, Meet, Polar, Step, Turned
from icsolve.assembly.workspace import (
    CORNER,
    GUIDE,
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
    Span,
    X,
    Y,
)

Cost = tuple[int, int, int]
"""Authority of the data (the lowest wins): the worst datum, the sum, and the number of ways."""

EXACT, BY_LENGTH, BY_ANGLE, BY_ARC, BY_GROUP = range(0, 500, 100)
"""What data cost: coordinates and guides, lengths, angles, angles seen from the point itself, groups."""


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
    vectors by which loci were moved; ``lines`` the direction along which a point was put from another, and
    ``spans`` the distance.
    """

    __slots__ = (
        "carried", "committed", "directions", "dirty", "drawing", "heap", "lines", "number", "placed",
        "spans", "turn",
    )  # fmt: skip

    def __init__(self, drawing: LooseFigure) -> None:
        self.drawing = drawing
        self.number = len(drawing.clusters)
        self.placed: dict[str, Cost] = {}
        self.directions: dict[tuple[str, str], LineDirection] = {}
        self.committed: set[int] = set()
        self.carried: set[object] = set()
        self.lines: dict[frozenset[Key], LineDirection] = {}
        self.spans: dict[frozenset[Key], Span] = {}
        self.dirty: dict[str, None] = {}
        self.heap: list[tuple[Cost, int, str, Step]] = []
        self.turn: dict[str, int] = {}

    def key(self, point: str) -> Key:
        """The point's key on a workspace."""
        return point if self.number == 0 else (self.number, point)

    def begin(self, points: Sequence[str]) -> None:
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
        self._mark_shapes_of(point)

    def _mark_shapes_of(self, point: str) -> None:
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
        self._mark_shapes_of(point)

    def _commit(self, step: Step) -> None:
        self.carried.update(carried_by(step))
        if isinstance(step, Turned):
            self.committed.add(step.shape[0][0])  # type: ignore[arg-type]
            self.spans[frozenset((step.base, step.target))] = Apart(*step.shape[2:])
        elif isinstance(step, Base):
            self.spans[frozenset(step.targets)] = step.span
        elif isinstance(step, Polar):
            self.spans[frozenset((step.base, step.target))] = step.span
        elif isinstance(step, Meet):
            for locus in (step.first, step.second):
                if isinstance(locus, LineLocus):
                    self.lines[frozenset((locus.through, step.target))] = locus.direction
                elif isinstance(locus, CircleLocus):
                    self.spans[frozenset((locus.centre, step.target))] = locus.radius
                    if isinstance(locus.radius, Apart):
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


# --- the loci that a point's data put it on, and the best step that they make ---


Candidate = tuple[int, Locus]
"""A locus of a point, after the cost of its data."""


def best_step(cluster: Cluster, point: str) -> tuple[Cost, Step] | None:
    """The step of greatest authority that places a point, if there is one."""
    found: list[tuple[Cost, Step]] = [*_means(cluster, point), *_transfers(cluster, point)]
    candidates = sorted(candidates_of(cluster, point), key=lambda candidate: candidate[0])
    for one, two in combinations(candidates, 2):
        step = _meet(cluster, point, one[1], two[1])
        if step is not None:
            found.append((_cost(cluster, one, two, step), step))
    return min(found, key=lambda pair: pair[0], default=None)


def _cost(cluster: Cluster, one: Candidate, two: Candidate, step: Step) -> Cost:
    """What a step costs; nothing where a locus that came by its vector is in place already."""
    if isinstance(step, Polar) and step.span in cluster.carried:
        return (EXACT, EXACT, 0)
    return max(one[0], two[0]), one[0] + two[0], 1 if isinstance(step, Meet) and step.sign else 0


def candidates_of(cluster: Cluster, point: str, after: tuple[str, ...] = ()) -> Iterator[Candidate]:
    """The loci of a point on a cluster; ``after`` are points that already lean on it."""
    for datum in cluster.drawing.facts.of.get(point, ()):
        if datum.kind in LOCI and (cluster.number == 0 or datum.kind in (LENGTH, CORNER, LINE)):
            yield from LOCI[datum.kind](cluster, datum, point)
    yield from _rays(cluster, point)
    yield from _derived(cluster, point)
    yield from _shifted(cluster, point, after)


def _circle(cluster: Cluster, datum: Datum, point: str) -> Iterator[Candidate]:
    a, b = datum.points
    centre = b if a == point else a
    if centre in cluster.placed:
        yield BY_LENGTH, CircleLocus(cluster.key(centre), datum)


def _seen(cluster: Cluster, datum: Datum, point: str) -> Iterator[Candidate]:
    """The vertex of a corner whose arms' ends are in place."""
    a, at, b = datum.points
    if point != at or a not in cluster.placed or b not in cluster.placed or (at, a) in cluster.directions:
        return
    ends = cluster.key(a), cluster.key(b)
    if datum in cluster.drawing.facts.flat:
        yield BY_ARC, LineLocus(ends[0], LineDirection(Apart(*ends)), False, datum)
    else:
        yield BY_ARC, ArcLocus(*ends, datum)


def _guided(cluster: Cluster, datum: Datum, point: str) -> Iterator[Candidate]:
    """A guide by its angle: its two points lie along it."""
    at, through = datum.points
    other = through if point == at else at
    if other in cluster.placed:
        yield EXACT, LineLocus(cluster.key(other), LineDirection(datum), False)


def _lined(cluster: Cluster, datum: Datum, point: str) -> Iterator[Candidate]:
    """A guide by two of its points: at to through is parallel to e1 to e2."""
    at, through, e1, e2 = datum.points
    if point in (at, through) and point not in (e1, e2):
        pairs = [(through if point == at else at, e1, e2)]
    elif point in (e1, e2) and point not in (at, through):
        pairs = [(e2 if point == e1 else e1, at, through)]
    else:
        others = list(dict.fromkeys(p for p in datum.points if p != point))
        pairs = [(others[0], others[0], others[1])] if len(others) == 2 else []
    for base, a, b in pairs:
        direction = cluster.directions.get((a, b))
        if direction is None and a in cluster.placed and b in cluster.placed:
            direction = LineDirection(Apart(cluster.key(a), cluster.key(b)))
        if direction is not None and base in cluster.placed:
            yield EXACT, LineLocus(cluster.key(base), direction, False, datum)


def _tethered(cluster: Cluster, datum: Datum, point: str) -> Iterator[Candidate]:
    """The one point of a rope that is not in place, tied to one place by straight parts alone."""
    rope = cluster.drawing.facts.ropes[datum.ref]  # type: ignore[index]
    if any(p != point and p not in cluster.placed for p in datum.points):
        return
    tied = rope.tied_to(datum.points, point)
    if tied is not None:
        rest = tuple(p for p in datum.points if p != point)
        yield BY_LENGTH, Tether(cluster.key(tied[0]), datum, rest, tied[1])


def _axis(cluster: Cluster, datum: Datum, point: str) -> Iterator[Candidate]:
    yield EXACT, Axis(datum)


LOCI: dict[str, Callable[[Cluster, Datum, str], Iterator[Candidate]]] = {
    X: _axis, Y: _axis, GUIDE: _guided, LINE: _lined, LENGTH: _circle, CORNER: _seen, ROPE: _tethered,
}  # fmt: skip
"""By kind of datum, the loci on which one puts a point."""


def _rays(cluster: Cluster, point: str) -> Iterator[Candidate]:
    """Rays from points in place along known directions, given or made by corners."""
    others: dict[str, None] = {}
    for datum in cluster.drawing.facts.of.get(point, ()):
        if datum.kind == RAY:
            others.update(dict.fromkeys(datum.points))
        elif datum.kind == CORNER:
            at = datum.points[1]
            others.update(dict.fromkeys(datum.points[::2] if point == at else (at,)))
    for other in others:
        direction = cluster.directions.get((other, point))
        if other in cluster.placed and direction is not None:
            yield BY_ANGLE + len(direction.turns), LineLocus(cluster.key(other), direction, True)


def _derived(cluster: Cluster, point: str) -> Iterator[Candidate]:
    """Circles whose radii other clusters lend."""
    data = cluster.drawing.facts.of.get(point, ())
    lengths = {other for datum in data if datum.kind == LENGTH for other in datum.points}
    for lender in cluster.drawing.holding.get(point, ()):
        if cluster.number != 0 and cluster.drawing.lenders < (1 if lender.number else 2):
            continue
        shared = _shared(cluster, lender)
        if lender.number != 0 and len(shared) > 1:
            continue
        for other in shared:
            if other not in lengths:
                cost = max(BY_LENGTH, lender.placed[point][0], lender.placed[other][0])
                span = Apart(lender.key(other), lender.key(point))
                lengths.add(other)
                yield cost, CircleLocus(cluster.key(other), span)


def _shared(cluster: Cluster, lender: Cluster) -> list[str]:
    """The points in place on both clusters."""
    small, large = sorted((cluster, lender), key=lambda s: len(s.placed))
    return [point for point in small.placed if point in large.placed]


def _shifted(cluster: Cluster, point: str, after: tuple[str, ...]) -> Iterator[Candidate]:
    """The loci of points at known vectors from this one, none of them in place yet."""
    for datum in cluster.drawing.facts.of.get(point, ()):
        if datum.kind != LENGTH:
            continue
        a, b = datum.points
        other = b if a == point else a
        direction = cluster.directions.get((point, other))
        if direction is None or other in cluster.placed or other in after:
            continue
        for cost, locus in candidates_of(cluster, other, (*after, point)):
            yield max(cost, BY_ANGLE) + 10, Shifted(locus, datum, direction)


def _means(cluster: Cluster, point: str) -> Iterator[tuple[Cost, Step]]:
    for datum in cluster.drawing.facts.of.get(point, ()):
        if datum.kind != MEAN:
            continue
        whole, *of = datum.points
        others = [cluster.key(p) for p in of if p != point]
        if not all(p in cluster.placed for p in datum.points if p != point):
            continue
        if point == whole:
            yield (EXACT, EXACT, 0), Mean(cluster.key(point), datum, tuple(others))
        else:
            parts = len(of) - len(others)
            yield (EXACT, EXACT, 0), Mean(cluster.key(point), datum, tuple(others), cluster.key(whole), parts)


def _transfers(cluster: Cluster, point: str) -> Iterator[tuple[Cost, Step]]:
    """A point of a shape that two of its points hold on this cluster, or one and a direction."""
    for lender in cluster.drawing.holding.get(point, ()):
        if lender.number == 0 or lender is cluster or (cluster.number and not cluster.drawing.lenders):
            continue
        shared = _shared(cluster, lender)
        cost = (EXACT, EXACT, 0)
        if lender.number not in cluster.committed:
            worst, total, ways = lender.placed[point]
            cost = (worst, total + 1, ways)
        if len(shared) > 1:
            p, q = shared[:2]
            shape = (lender.key(p), lender.key(q), lender.key(p), lender.key(point))
            toward = LineDirection(Apart(cluster.key(p), cluster.key(q)))
            yield cost, Turned(cluster.key(point), cluster.key(p), toward, shape)
        elif shared:
            yield from _turned(cluster, lender, shared[0], point, cost)


def _turned(
    cluster: Cluster, lender: Cluster, base: str, point: str, cost: Cost
) -> Iterator[tuple[Cost, Step]]:
    """A point of a shape that has one point in place, by the first direction known in the shape."""
    for a, b in _sights(cluster, lender):
        direction = cluster.directions[a, b]
        shape = (lender.key(a), lender.key(b), lender.key(base), lender.key(point))
        worst = max(cost[0], BY_ANGLE + len(direction.turns))
        yield (
            (worst, cost[1] + BY_ANGLE, cost[2]),
            Turned(cluster.key(point), cluster.key(base), direction, shape),
        )
        return


def _sights(cluster: Cluster, lender: Cluster) -> Iterator[tuple[str, str]]:
    """The pairs of a shape whose direction is known on a cluster."""
    for a in lender.placed:
        for datum in cluster.drawing.facts.of.get(a, ()):
            for b in datum.points if datum.kind in (RAY, CORNER) else ():
                if b in lender.placed and (a, b) in cluster.directions:
                    yield a, b


def _meet(cluster: Cluster, point: str, one: Locus, two: Locus) -> Step | None:
    """The step that two loci make; None where they are one locus or are known not to determine a point."""
    if frozenset((one, two)) in cluster.drawing.banned:
        return None
    line, other = (two, one) if is_round(one) and not is_round(two) else (one, two)
    span: Span | None = None
    if isinstance(line, LineLocus) and isinstance(other, CircleLocus):
        if line.ray and line.through == other.centre:
            return Polar(cluster.key(point), line.through, other.radius, line.direction)
    elif isinstance(one, CircleLocus) and isinstance(two, CircleLocus):
        if one.centre == two.centre:
            return None
        span = cluster.spans.get(frozenset((one.centre, two.centre)))
    elif (
        isinstance(line, LineLocus)
        and isinstance(other, LineLocus)
        and _course(cluster, line.direction) == _course(cluster, other.direction)
    ):
        return None
    return Meet(cluster.key(point), line, other, 1 if is_round(other) else 0, span)


def _course(cluster: Cluster, direction: LineDirection) -> tuple[object, tuple[tuple[Datum, int], ...]]:
    """What a direction comes from, either way along it: that between two points of which one was put along a
    line from the other comes from the line's."""
    root, turns = direction.root, direction.turns
    while isinstance(root, Apart) and (line := cluster.lines.get(frozenset(root))) is not None:
        root, turns = line.root, (*line.turns, *turns)
    return (frozenset(root) if isinstance(root, Apart) else root), turns
