"""The smallest group of points that only all their data together determine; what is free in a figure with too
few data, and what would fix it, in words.

Which conditions determine which coordinates is a matching, and so is what it leaves free.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence, Set
from itertools import combinations, pairwise
from typing import TYPE_CHECKING

from icsolve.assembly.clusters import (
    LooseFigure,
)
from icsolve.assembly.conditions import FigureEquation, InLine, Unknown, parts_of
from icsolve.assembly.steps import PointGroup
from icsolve.assembly.workspace import (
    CORNER,
    GUIDE,
    LENGTH,
    LINE,
    MEAN,
    RAY,
    Datum,
    X,
    Y,
    data_in,
)
from icsolve.errors import SceneError, Status
from icsolve.structure import reached
from icsolve.structure.plan import determined, loose, matched
from icsolve.tuples import LateModule, NamedTuple
from icsolve.wording import listed

if TYPE_CHECKING:
    from icsolve.assembly import refusals
else:
    refusals = LateModule("icsolve.assembly.refusals")


class System(NamedTuple):
    """The conditions on the points that are not in place, matched to their coordinates.

    ``of`` has for each coordinate the equations that it bears on; ``matched`` the equation of a
    coordinate and ``solves`` the coordinate of an equation; ``free`` what is not determined.
    """

    equations: list[FigureEquation]
    reach: list[list[Unknown]]
    of: dict[Unknown, list[int]]
    matched: dict[Unknown, int]
    free: Set[Unknown]


def system_of(data: Iterable[Datum], placed: Iterable[str], wanted: Iterable[str]) -> System:
    """Match every condition on points not in place to one of their coordinates."""
    known = set(placed)
    equations = [
        FigureEquation(datum, part)
        for datum in data
        for part in parts_of(datum)
        if not known.issuperset(datum.points)
    ]
    reach = [[u for u in equation.unknowns() if u[0] not in known] for equation in equations]
    of: dict[Unknown, list[int]] = {(p, part): [] for p in wanted if p not in known for part in (0, 1)}
    for equation in equations:
        for p in equation.datum.points:
            if p not in known:
                of.setdefault((p, 0), [])
                of.setdefault((p, 1), [])
    for i, unknowns in enumerate(reach):
        for u in unknowns:
            of[u].append(i)
    held: dict[Unknown, list[int]] = {u: [] for u in of}
    for i in range(len(equations)):
        matched(i, reach.__getitem__, held, 1)
    solved = {u: rows[0] for u, rows in held.items() if rows}
    return System(equations, reach, of, solved, loose(held, reach.__getitem__, 1).keys())


def leans(system: System, point: str) -> list[str]:
    """The points not in place that the equations of a point's coordinates bind it to."""
    rows = [system.matched[u] for u in ((point, 0), (point, 1)) if u in system.matched]
    return list(dict.fromkeys(p for i in rows for p, _ in system.reach[i] if p != point))


COUNT = {1: "one more length, angle or coordinate", 2: "two more (lengths, angles or coordinates)"}


def underdetermined(system: System, placed: Iterable[str], goal: Sequence[str]) -> SceneError:
    """The refusal that lists every free part of the figure that the goal leans on, and points that may be
    meant by another case of their letters."""
    known = set(placed)
    parts = [part for part in _parts(system) if any(p in part for p in goal)]
    said = [_said(system, part, known) for part in parts]
    pairs = ((p, q) for part in parts for p in part for q in known if p.lower() == q.lower())
    said += [f"the file has a point {q}, which is another than {p}" for p, q in pairs]
    return SceneError(Status.UNDERDETERMINED, "; ".join(said))


def _parts(system: System) -> list[list[str]]:
    """The free points, together where an equation binds them."""
    free = list(dict.fromkeys(p for p, part in system.of if (p, part) in system.free))
    parts: list[list[str]] = []

    def bound(point: str) -> Iterator[str]:
        rows = (i for u in ((point, 0), (point, 1)) for i in system.of[u])
        return (u[0] for i in rows for u in system.reach[i] if u in system.free)

    for root in free:
        if not any(root in part for part in parts):
            parts.append(sorted(reached((root,), bound), key=free.index))
    return parts


def _said(system: System, part: list[str], known: set[str]) -> str:
    """What one free part lacks."""
    names = listed([refusals.plain(p) for p in part])
    unknowns = [(p, axis) for p in part for axis in (0, 1)]
    missing = sum(u not in system.matched for u in unknowns)
    rows = {i for u in unknowns for i in system.of[u]}
    if not rows:
        return f"nothing says where point {names} is: give its coordinates, or two lengths or angles"
    data = [system.equations[i].datum for i in rows]
    anchors = {p for datum in data for p in datum.points if p in known}
    absolute = any(datum.kind in (X, Y) for datum in data)
    turned = any(datum.kind in (RAY, GUIDE, X, Y) for datum in data)
    if not anchors and not absolute:
        direction = "" if turned else " and one direction (the angle of a pair)"
        return (
            f"nothing fixes where the figure of {names} lies: "
            f"give coordinates of one of its points{direction}"
        )
    hint = ""
    if len(anchors) == 1 and not turned and missing == 1:
        about = refusals.plain(next(iter(anchors)))
        hint = f"; nothing fixes how it is turned about {about}: give the direction of a pair"
    subject = "point" if len(part) == 1 else "points"
    verb = "is" if missing == 1 else "are"
    return f"{subject} {names}: {COUNT.get(missing, f'{missing} more data')} {verb} needed{hint}"


def _counting(drawing: LooseFigure) -> list[Datum]:
    """The data without those that only repeat the shape of a loose cluster or the direction of a line: they
    hold nothing more.
    """
    used = {datum for step in drawing.steps for datum in data_in(step)}
    shapes = [cluster.placed.keys() for cluster in drawing.clusters[1:]]
    counting = (
        datum
        for datum in drawing.facts.data
        if datum in used
        or datum.kind not in (LENGTH, CORNER, LINE, MEAN)
        or not any(shape >= set(datum.points) for shape in shapes)
    )
    return list(_directing_once(counting, drawing.ground.placed.keys()))


def _directing_once(data: Iterable[Datum], placed: Collection[str]) -> Iterator[Datum]:
    """The data without directions and corners that follow from other ones: a corner between two lines whose
    directions are known, or tied by other corners.
    """
    known: frozenset[str] = frozenset()
    tied: dict[frozenset[str], frozenset[str]] = {}

    def leader(line: frozenset[str]) -> frozenset[str]:
        if line.issubset(placed):
            return known
        while line in tied:
            line = tied[line]
        return line

    for datum in data:
        if datum.kind in (RAY, CORNER):
            arms = [frozenset(pair) for pair in pairwise(datum.points)]
            one, other = sorted(map(leader, arms if datum.kind == CORNER else [known, *arms]), key=bool)
            if one == other:
                continue
            tied[other] = one
        yield datum


def next_group(drawing: LooseFigure, wanted: Iterable[str]) -> PointGroup:
    """The smallest group that leads to the wanted points.

    Raises
    ------
    SceneError
        ``underdetermined`` with what is free.
    """
    placed = drawing.ground.placed.keys()
    goal = [p for p in wanted if p not in placed]
    system = system_of(_counting(drawing), placed, goal)
    goal = list(reached(goal, lambda p: leans(system, p)))
    if any((p, part) in system.free for p in goal for part in (0, 1)):
        raise underdetermined(system, placed, goal)
    number = {p: n for n, p in enumerate(goal)}
    held = {number[p]: [system.matched[p, part] for part in (0, 1)] for p in goal}
    parts = determined(held, lambda i: dict.fromkeys(number[p] for p, _ in system.reach[i]), 2)
    closed = (sorted(part.bodies) for part in parts if not part.others)
    points = min(closed, key=lambda part: (len(part), part))
    equations = (system.equations[i] for i in sorted(i for n in points for i in held[n]))
    return PointGroup(tuple(goal[n] for n in points), tuple(equations))


# --- triangles that three lengths make flat -------------------------------------------------------


def with_points_in_line(group: PointGroup, detour: Callable[[Datum, Datum, Datum], int]) -> PointGroup:
    """The group with each point in line with two others by three lengths put by these two (`InLine`).

    ``detour`` is the sign of two lengths less a third.
    """
    sides = {frozenset(e.datum.points): e.datum for e in group.equations if e.datum.kind == LENGTH}
    beside: dict[str, list[str]] = {}
    for a, b in sides:
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    replaced: dict[Datum, InLine] = {}
    ends: set[str] = set()
    for point in group.targets:
        for p, q in combinations(beside.get(point, ()), 2):
            whole = sides.get(frozenset((p, q)))
            along, rest = sides[frozenset((point, p))], sides[frozenset((point, q))]
            if whole is None or point in ends or along in replaced or rest in replaced:
                continue
            beyond = detour(along, whole, rest) == 0
            if beyond or detour(along, rest, whole) == 0 or detour(rest, whole, along) == 0:
                sense = -1.0 if beyond else 1.0
                for part, side in enumerate((along, rest)):
                    replaced[side] = InLine(point, p, q, along, whole, rest, sense, part)
                ends |= {p, q}
    return group._replace(equations=tuple(replaced.get(e.datum, e) for e in group.equations))
