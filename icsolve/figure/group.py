"""Points that have no order of construction: the smallest group that its data determine together.

Every scalar condition is matched to an unknown coordinate (maximum matching, the data of greatest authority
first). What an unmatched coordinate can reach is free (Dulmage and Mendelsohn 1958); the strongly connected
parts of the rest are groups that can be solved one after another.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from icsolve.arithmetic import Scalar
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.figure.board import Board, Key, Point
from icsolve.figure.data import MEAN, Datum
from icsolve.figure.equations import Equation, Pivot, Unknown, solved
from icsolve.figure.free import underdetermined
from icsolve.figure.sheet import Drawing
from icsolve.figure.words import listed, plain


class Group(NamedTuple):
    """Points placed by Newton's method. ``start`` is the solution that was settled on.

    ``place`` takes ``board.rounds`` steps from there with the elimination's order held: at the
    solution, one step carries the derivatives by all data.
    """

    targets: tuple[str, ...]
    equations: tuple[Equation, ...]
    start: tuple[tuple[float, float], ...] = ()
    order: tuple[Pivot, ...] = ()

    @property
    def name(self) -> str:
        """What the step does."""
        return f"{', '.join(map(plain, self.targets))}: together, by Newton's method on their {len(self.equations)} data"

    def place(self, board: Board) -> None:
        """Put the points, and improve them."""
        for target, at in zip(self.targets, self.start, strict=True):
            board.points[target] = board.starts.get(target, at)
        unknown = set(self.unknowns())
        for _ in range(board.rounds):
            self.improve(board, unknown)

    def improve(self, board: Board, unknown: set[Unknown]) -> None:
        """One Newton step."""
        rows = [equation.row(board) for equation in self.equations]
        inner = [{u: v for u, v in row.by.items() if u in unknown} for row in rows]
        move = solved(inner, [row.value for row in rows], list(self.order))
        for target in self.targets:
            x, y = board.points[target]
            board.points[target] = (x - _moved(move, target, 0), y - _moved(move, target, 1))

    def unknowns(self) -> list[Unknown]:
        """The coordinates that it solves for."""
        return [(target, part) for target in self.targets for part in (0, 1)]

    def data(self) -> tuple[Datum, ...]:
        """The data of its equations."""
        return tuple(dict.fromkeys(equation.datum for equation in self.equations))

    def needs(self) -> tuple[Key, ...]:
        """The points that its equations bind to it."""
        own = set(self.targets)
        return tuple(dict.fromkeys(p for e in self.equations for p in e.datum.points if p not in own))


def _moved(move: dict[Unknown, Scalar], target: str, part: int) -> Scalar:
    return move.get((target, part), 0.0)


class System(NamedTuple):
    """The conditions on the points that are not in place, matched to their coordinates.

    ``of`` has for each coordinate the equations that it bears on; ``matched`` the equation of a
    coordinate and ``solves`` the coordinate of an equation; ``free`` what is not determined.
    """

    equations: list[Equation]
    reach: list[list[Unknown]]
    of: dict[Unknown, list[int]]
    matched: dict[Unknown, int]
    free: set[Unknown]


def next_group(drawing: Drawing, case: Case, wanted: Iterable[str]) -> tuple[Group, tuple[str, ...]]:
    """The smallest group that leads to the wanted points.

    Raises
    ------
    SceneError
        ``underdetermined`` with what is free; ``ambiguous`` for a group without ``near``.
    """
    placed = drawing.ground.placed.keys()
    goal = [p for p in wanted if p not in placed]
    system = system_of(drawing.facts.data, placed, goal)
    goal = _leading(system, goal)
    if any((p, part) in system.free for p in goal for part in (0, 1)):
        raise underdetermined(case, system, placed, goal)
    groups = [group for group in _groups(system, goal) if group]
    points = min(groups, key=len)
    own = {(p, part) for p in points for part in (0, 1)}
    equations = tuple(system.equations[i] for i in sorted(system.matched[u] for u in own))
    if not any(p in case.near for p in points):
        raise SceneError(
            Status.AMBIGUOUS,
            f"points {listed([plain(p) for p in points])} hang together without an order of construction; "
            f"say roughly where one of them is: near: {{{plain(points[0])}: [x, y]}}",
        )
    return Group(points, equations), points


def system_of(data: Iterable[Datum], placed: Iterable[str], wanted: Iterable[str]) -> System:
    """Match every condition on points not in place to one of their coordinates."""
    known = set(placed)
    equations = [
        Equation(datum, part)
        for datum in data
        for part in ((0, 1) if datum.kind == MEAN else (0,))
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
    matched: dict[Unknown, int] = {}
    for i in range(len(equations)):
        _augment(i, reach, matched)
    return System(equations, reach, of, matched, _free(of, reach, matched))


def _augment(root: int, reach: list[list[Unknown]], matched: dict[Unknown, int]) -> None:
    """Give an equation a coordinate, moving others along an alternating path (breadth first)."""
    came: dict[Unknown, int] = {}
    before: dict[int, Unknown | None] = {root: None}
    queue = [root]
    for i in queue:
        for u in reach[i]:
            if u in came:
                continue
            came[u] = i
            if u not in matched:
                _flip(u, came, before, matched)
                return
            before.setdefault(matched[u], u)
            queue.append(matched[u])


def _flip(
    end: Unknown, came: dict[Unknown, int], before: dict[int, Unknown | None], matched: dict[Unknown, int]
) -> None:
    u: Unknown | None = end
    while u is not None:
        i = came[u]
        matched[u] = i
        u = before[i]


def _free(of: dict[Unknown, list[int]], reach: list[list[Unknown]], matched: dict[Unknown, int]) -> set[Unknown]:
    """The coordinates that an unmatched one reaches: its equations may solve for it instead of theirs."""
    solves = {i: u for u, i in matched.items()}
    stack = [u for u in of if u not in matched]
    free = set(stack)
    while stack:
        for i in of[stack.pop()]:
            u = solves.get(i)
            if u is not None and u not in free:
                free.add(u)
                stack.append(u)
    return free


def _leans(system: System, point: str) -> list[str]:
    """The points not in place that the equations of a point's coordinates bind it to."""
    rows = [system.matched[u] for u in ((point, 0), (point, 1)) if u in system.matched]
    return list(dict.fromkeys(p for i in rows for p, _ in system.reach[i] if p != point))


def _leading(system: System, wanted: list[str]) -> list[str]:
    """The wanted points and all that they lean on."""
    found = dict.fromkeys(wanted)
    stack = list(found)
    while stack:
        for p in _leans(system, stack.pop()):
            if p not in found:
                found[p] = None
                stack.append(p)
    return list(found)


def _groups(system: System, goal: list[str]) -> list[tuple[str, ...]]:
    """The strongly connected parts that lean on no other part (Tarjan 1972, without recursion)."""
    number: dict[str, int] = {}
    low: dict[str, int] = {}
    done: set[str] = set()
    trail: list[str] = []
    groups: list[tuple[str, ...]] = []
    for root in goal:
        if root in number:
            continue
        work = [(root, iter(_leans(system, root)))]
        number[root] = low[root] = len(number)
        trail.append(root)
        while work:
            point, following = work[-1]
            after = next((q for q in following if q not in done), None)
            if after is None:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[point])
                if low[point] == number[point]:
                    part = trail[trail.index(point) :]
                    del trail[trail.index(point) :]
                    done.update(part)
                    if all(q in part for p in part for q in _leans(system, p)):
                        groups.append(tuple(part))
            elif after in number:
                low[point] = min(low[point], number[after])
            else:
                number[after] = low[after] = len(number)
                trail.append(after)
                work.append((after, iter(_leans(system, after))))
    return groups



