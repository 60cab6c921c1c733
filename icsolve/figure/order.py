"""The order of construction: which steps place the points that are asked for, and no others.

Topology alone decides; numbers come later. Closed forms first; where they stall, the shapes of
loose links (their distances then serve as lengths); where these stall too, the smallest group of
points that only all their data together determine.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import NamedTuple

from icsolve.case import Case
from icsolve.figure.board import Key
from icsolve.figure.data import LENGTH, Datum, Facts, given_points, facts_of
from icsolve.figure.sheet import Drawing, Sheet
from icsolve.figure.steps import Base, Given, Step


class Order(NamedTuple):
    """Steps in the order in which they run, the points that they place on the ground, and all data."""

    steps: tuple[Step, ...]
    points: tuple[str, ...]
    facts: Facts

    def used(self) -> frozenset[Datum]:
        """The data of which the construction is made."""
        return frozenset(datum for step in self.steps for datum in step.data())


def order_of(
    case: Case, goal: Collection[str], banned: frozenset[frozenset[object]] = frozenset(), best_effort: bool = False
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
    drawing = Drawing(facts_of(case), banned)
    ground, wanted = drawing.ground, set(goal)
    ground.begin(given_points(case))
    ground.run(wanted)
    while not wanted <= ground.placed.keys():
        if not grow(drawing) and not _group(drawing, case, wanted, best_effort):
            break
        ground.run(wanted)
    return _pruned(drawing, wanted & ground.placed.keys() if best_effort else wanted)


def grow(drawing: Drawing) -> bool:
    """Draw the shapes of loose links until no sheet gains a point; whether the ground may go on."""
    ground = drawing.ground
    before = len(drawing.steps)
    _start(drawing)
    grew = True
    while grew:
        grew = False
        for sheet in drawing.sheets[1:]:
            _touch(sheet)
            grew = sheet.run() or grew
    if len(drawing.steps) == before:
        return False
    for point in [p for sheet in drawing.sheets[1:] for p in sheet.placed]:
        ground.mark(point)
    return True


def _start(drawing: Drawing) -> None:
    """A loose sheet for every length that no sheet holds."""
    for datum in drawing.facts.data:
        if datum.kind != LENGTH:
            continue
        a, b = datum.points
        if any(b in sheet.placed for sheet in drawing.holding.get(a, ())):
            continue
        sheet = Sheet(drawing)
        drawing.sheets.append(sheet)
        sheet.put(Base(sheet.key(a), sheet.key(b), datum), (a, b), (100, 100, 0))
        sheet.run()


def _touch(sheet: Sheet) -> None:
    """Mark all that hangs on a loose sheet: it grows when others did."""
    for point in list(sheet.placed):
        sheet.reach_from(point)


def _group(drawing: Drawing, case: Case, wanted: set[str], best_effort: bool) -> bool:
    """The smallest group that its data determine together becomes one step; else say what is free."""
    if best_effort:
        return False
    from icsolve.figure.group import next_group

    step, points = next_group(drawing, case, wanted)
    drawing.ground.put(step, points, (400, 400, 1))
    return True


def _pruned(drawing: Drawing, wanted: set[str]) -> Order:
    """Only the steps that lead to the wanted points."""
    needed: set[Key] = set(wanted)
    kept: list[Step] = []
    for step in reversed(drawing.steps):
        targets = tuple(key for key in step.targets if key in needed)
        if targets:
            needed.update(step.needs())
            kept.append(Given(targets) if isinstance(step, Given) else step)
    kept.reverse()
    points = [key for step in kept for key in step.targets if isinstance(key, str)]
    return Order(tuple(kept), tuple(points), drawing.facts)
