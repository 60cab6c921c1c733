"""The order of construction: which steps place the points that are asked for, and no others.

Topology alone decides; numbers come later. Closed forms first; where they stall, the shapes of loose links
(their distances then serve as lengths); where these stall too, a group of points (`point_groups`).
"""

from __future__ import annotations

from collections.abc import Collection
from functools import lru_cache
from typing import TYPE_CHECKING

from icsolve.assembly.clusters import (
    ALL_CLUSTERS,
    BY_GROUP,
    BY_LENGTH,
    LOOSE_CLUSTERS,
    NOBODY,
    Cluster,
    LooseFigure,
)
from icsolve.assembly.steps import Base, Step, leading_to, points_of, sensed
from icsolve.assembly.workspace import (
    CORNER,
    LENGTH,
    RAY,
    Datum,
    Facts,
    data_in,
    data_of,
    facts_about,
    flat_corners,
    given_points,
)
from icsolve.case import Case, Rope
from icsolve.tuples import LateModule, cached_property, dataclass

if TYPE_CHECKING:
    from icsolve.assembly import point_groups
else:  # where points can only be placed together, or data are missing
    point_groups = LateModule("icsolve.assembly.point_groups")


@dataclass(frozen=True, eq=False, repr=False)
class Order:
    """Steps in the order in which they run, the points that they place on the ground, and all data."""

    steps: tuple[Step, ...]
    points: tuple[str, ...]
    facts: Facts

    @cached_property
    def used(self) -> frozenset[Datum]:
        """The data of which the construction is made."""
        return frozenset(datum for step in self.steps for datum in data_in(step))

    @cached_property
    def due(self) -> dict[int, list[Datum]]:
        """The data to compare after each step: those whose last point it places, but for lengths of which the
        steps are made, which have no sense that a way could miss."""
        depth = {key: i for i, step in enumerate(self.steps) for key in step.targets}
        due: dict[int, list[Datum]] = {}
        for datum in self.facts.data:
            if (datum.kind != LENGTH or datum not in self.used) and all(p in depth for p in datum.points):
                due.setdefault(max(depth[p] for p in datum.points), []).append(datum)
        return due

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
    data = data_of(case)
    told = (data, flat_corners(case, data), case.ropes, tuple(given_points(case)))
    return _ordered(*told, tuple(goal), banned, best_effort)


@lru_cache(maxsize=64)
def _ordered(
    data: tuple[Datum, ...],
    flat: frozenset[Datum],
    ropes: tuple[Rope, ...],
    given: tuple[str, ...],
    goal: tuple[str, ...],
    banned: frozenset[frozenset[object]],
    best_effort: bool,
) -> Order:
    """The order for figures of these data, whatever their numbers: figures alike share it."""
    drawing = LooseFigure(facts_about(data, flat, ropes), banned)
    ground, wanted = drawing.ground, set(goal)
    ground.begin(given)
    ground.run(wanted)
    while not wanted <= ground.placed.keys():
        if not grow(drawing):
            if best_effort:
                break
            step = point_groups.next_group(drawing, goal)
            ground.put(step, step.targets, (BY_GROUP, BY_GROUP, 1))
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
        cluster.put(Base(cluster.key(a), cluster.key(b), datum), (a, b), (BY_LENGTH, BY_LENGTH, 0))
        cluster.run()
