"""Within reach: the loci that a point's data put it on, and the best step that they make."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import combinations
from typing import TYPE_CHECKING

from icsolve.assembly.data import CORNER, GUIDE, LENGTH, LINE, MEAN, RAY, Datum, X, Y
from icsolve.assembly.heading import Apart, Heading
from icsolve.assembly.loci import Arc, Axis, Circle, Line, Locus, Shifted, is_round
from icsolve.assembly.shapes import Transfer, Turned
from icsolve.assembly.step import Step
from icsolve.assembly.steps import Mean, Meet, Polar

if TYPE_CHECKING:
    from icsolve.assembly.sheet import Sheet

Cost = tuple[int, int, int]
"""Authority of the data (the lowest wins): the worst datum, the sum, and the number of ways."""

EXACT, BY_LENGTH, BY_ANGLE, BY_ARC = 0, 100, 200, 300
"""What data cost: coordinates and guides, lengths, angles, angles seen from the point itself."""


Reach = tuple[int, Locus]
"""A locus of a point, after the cost of its data."""


def best_step(sheet: Sheet, point: str) -> tuple[Cost, Step] | None:
    """The step of greatest authority that places a point, if there is one."""
    found: list[tuple[Cost, Step]] = [*_means(sheet, point), *_transfers(sheet, point)]
    reaches = sorted(reaches_of(sheet, point), key=lambda reach: reach[0])
    for one, two in combinations(reaches, 2):
        step = _meet(sheet, point, one[1], two[1])
        if step is not None:
            found.append((_cost(sheet, one, two, step), step))
    return min(found, key=lambda pair: pair[0], default=None)


def _cost(sheet: Sheet, one: Reach, two: Reach, step: Step) -> Cost:
    """What a step costs; nothing where a locus that came by its vector is in place already."""
    if isinstance(step, Polar) and step.span in sheet.carried:
        return (EXACT, EXACT, 0)
    return max(one[0], two[0]), one[0] + two[0], 1 if isinstance(step, Meet) and step.sign else 0


def reaches_of(sheet: Sheet, point: str, after: tuple[str, ...] = ()) -> Iterator[Reach]:
    """The loci of a point on a sheet; ``after`` are points that already lean on it."""
    for datum in sheet.drawing.facts.of.get(point, ()):
        if sheet.number == 0 or datum.kind in (LENGTH, CORNER, LINE):
            yield from KINDS[datum.kind](sheet, datum, point)
    yield from _rays(sheet, point)
    yield from _lent(sheet, point)
    yield from _shifted(sheet, point, after)


def _circle(sheet: Sheet, datum: Datum, point: str) -> Iterator[Reach]:
    a, b = datum.points
    centre = b if a == point else a
    if centre in sheet.placed:
        yield BY_LENGTH, Circle(sheet.key(centre), datum)


def _seen(sheet: Sheet, datum: Datum, point: str) -> Iterator[Reach]:
    """The vertex of a corner whose arms' ends are in place."""
    a, at, b = datum.points
    if point != at or a not in sheet.placed or b not in sheet.placed or (at, a) in sheet.headings:
        return
    ends = sheet.key(a), sheet.key(b)
    if datum in sheet.drawing.facts.flat:
        yield BY_ARC, Line(ends[0], Heading(Apart(*ends)), False)
    else:
        yield BY_ARC, Arc(*ends, datum)


def _guided(sheet: Sheet, datum: Datum, point: str) -> Iterator[Reach]:
    """A guide by its angle: its two points lie along it."""
    at, through = datum.points
    other = through if point == at else at
    if other in sheet.placed:
        yield EXACT, Line(sheet.key(other), Heading(datum), False)


def _lined(sheet: Sheet, datum: Datum, point: str) -> Iterator[Reach]:
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
        heading = sheet.headings.get((a, b))
        if heading is None and a in sheet.placed and b in sheet.placed:
            heading = Heading(Apart(sheet.key(a), sheet.key(b)))
        if heading is not None and base in sheet.placed:
            yield EXACT, Line(sheet.key(base), heading, False)


def _axis(sheet: Sheet, datum: Datum, point: str) -> Iterator[Reach]:
    yield EXACT, Axis(datum)


def _nothing(sheet: Sheet, datum: Datum, point: str) -> Iterator[Reach]:
    yield from ()


KINDS: dict[str, Callable[[Sheet, Datum, str], Iterator[Reach]]] = {
    X: _axis, Y: _axis, MEAN: _nothing, GUIDE: _guided, LINE: _lined,
    LENGTH: _circle, RAY: _nothing, CORNER: _seen,
}  # fmt: skip


def _rays(sheet: Sheet, point: str) -> Iterator[Reach]:
    """Rays from points in place along known directions, given or made by corners."""
    others: dict[str, None] = {}
    for datum in sheet.drawing.facts.of.get(point, ()):
        if datum.kind == RAY:
            others.update(dict.fromkeys(datum.points))
        elif datum.kind == CORNER:
            at = datum.points[1]
            others.update(dict.fromkeys(datum.points[::2] if point == at else (at,)))
    for other in others:
        heading = sheet.headings.get((other, point))
        if other in sheet.placed and heading is not None:
            yield BY_ANGLE + len(heading.turns), Line(sheet.key(other), heading, True)


def _lent(sheet: Sheet, point: str) -> Iterator[Reach]:
    """Circles whose radii other sheets lend."""
    data = sheet.drawing.facts.of.get(point, ())
    lengths = {other for datum in data if datum.kind == LENGTH for other in datum.points}
    for lender in sheet.drawing.holding.get(point, ()):
        if sheet.number != 0 and sheet.drawing.lenders < (1 if lender.number else 2):
            continue
        shared = _shared(sheet, lender)
        if lender.number != 0 and len(shared) > 1:
            continue
        for other in shared:
            if other not in lengths:
                cost = max(BY_LENGTH, lender.placed[point][0], lender.placed[other][0])
                span = Apart(lender.key(other), lender.key(point))
                lengths.add(other)
                yield cost, Circle(sheet.key(other), span)


def _shared(sheet: Sheet, lender: Sheet) -> list[str]:
    """The points in place on both sheets."""
    small, large = sorted((sheet, lender), key=lambda s: len(s.placed))
    return [point for point in small.placed if point in large.placed]


def _shifted(sheet: Sheet, point: str, after: tuple[str, ...]) -> Iterator[Reach]:
    """The loci of points at known vectors from this one, none of them in place yet."""
    for datum in sheet.drawing.facts.of.get(point, ()):
        if datum.kind != LENGTH:
            continue
        a, b = datum.points
        other = b if a == point else a
        heading = sheet.headings.get((point, other))
        if heading is None or other in sheet.placed or other in after:
            continue
        for cost, locus in reaches_of(sheet, other, (*after, point)):
            yield max(cost, BY_ANGLE) + 10, Shifted(locus, datum, heading)


def _means(sheet: Sheet, point: str) -> Iterator[tuple[Cost, Step]]:
    for datum in sheet.drawing.facts.of.get(point, ()):
        if datum.kind != MEAN:
            continue
        whole, *of = datum.points
        others = [sheet.key(p) for p in of if p != point]
        if not all(p in sheet.placed for p in datum.points if p != point):
            continue
        if point == whole and point not in of:
            yield (EXACT, EXACT, 0), Mean(sheet.key(point), datum, tuple(others))
        elif point != whole:
            parts = len(of) - len(others)
            yield (EXACT, EXACT, 0), Mean(sheet.key(point), datum, tuple(others), sheet.key(whole), parts)


def _transfers(sheet: Sheet, point: str) -> Iterator[tuple[Cost, Step]]:
    """A point of a shape that two of its points hold on this sheet, or one and a direction."""
    for lender in sheet.drawing.holding.get(point, ()):
        if lender.number == 0 or lender is sheet or (sheet.number and not sheet.drawing.lenders):
            continue
        shared = _shared(sheet, lender)
        cost = (EXACT, EXACT, 0)
        if lender.number not in sheet.committed:
            worst, total, ways = lender.placed[point]
            cost = (worst, total + 1, ways)
        if len(shared) > 1:
            p, q = shared[:2]
            shape = (lender.key(p), lender.key(q), lender.key(point))
            yield cost, Transfer(sheet.key(point), (sheet.key(p), sheet.key(q)), shape)
        elif shared:
            yield from _turned(sheet, lender, shared[0], point, cost)


def _turned(sheet: Sheet, lender: Sheet, base: str, point: str, cost: Cost) -> Iterator[tuple[Cost, Step]]:
    """A point of a shape that has one point in place, by the first direction known in the shape."""
    for a, b in _sights(sheet, lender):
        heading = sheet.headings[a, b]
        shape = (lender.key(a), lender.key(b), lender.key(base), lender.key(point))
        worst = max(cost[0], BY_ANGLE + len(heading.turns))
        yield (
            (worst, cost[1] + BY_ANGLE, cost[2]),
            Turned(sheet.key(point), sheet.key(base), heading, shape),
        )
        return


def _sights(sheet: Sheet, lender: Sheet) -> Iterator[tuple[str, str]]:
    """The pairs of a shape whose direction is known on a sheet."""
    for a in lender.placed:
        for datum in sheet.drawing.facts.of.get(a, ()):
            for b in datum.points if datum.kind in (RAY, CORNER) else ():
                if b in lender.placed and (a, b) in sheet.headings:
                    yield a, b


def _meet(sheet: Sheet, point: str, one: Locus, two: Locus) -> Step | None:
    """The step that two loci make; None where they are one locus or are known not to determine a point."""
    if frozenset((one, two)) in sheet.drawing.banned:
        return None
    line, other = (two, one) if is_round(one) and not is_round(two) else (one, two)
    if isinstance(line, Line) and isinstance(other, Circle):
        if line.ray and line.through == other.centre:
            return Polar(sheet.key(point), line.through, other.radius, line.heading)
    elif isinstance(one, Circle) and isinstance(two, Circle) and one.centre == two.centre:
        return None
    elif isinstance(line, Line) and isinstance(other, Line):
        h, k = line.heading, other.heading
        if h.root == k.root and h.turns == k.turns:
            return None
    return Meet(sheet.key(point), line, other, 1 if is_round(other) else 0)
