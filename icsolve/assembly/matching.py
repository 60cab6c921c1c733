"""Which conditions determine which coordinates: a matching, and what it leaves free.

Every scalar condition is matched to an unknown coordinate (a maximum matching, the data of greatest
authority first). What an unmatched coordinate can reach is free; the strongly connected parts of the
rest are groups that can be solved one after another (A. L. Dulmage and N. S. Mendelsohn, Canadian
Journal of Mathematics 10, 1958).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import NamedTuple

from icsolve.assembly.data import MEAN, Datum
from icsolve.assembly.equations import Equation, Unknown


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
    return System(equations, reach, of, matched, _free(of, matched))


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


def _free(of: dict[Unknown, list[int]], matched: dict[Unknown, int]) -> set[Unknown]:
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


def leans(system: System, point: str) -> list[str]:
    """The points not in place that the equations of a point's coordinates bind it to."""
    rows = [system.matched[u] for u in ((point, 0), (point, 1)) if u in system.matched]
    return list(dict.fromkeys(p for i in rows for p, _ in system.reach[i] if p != point))


def leading(system: System, wanted: list[str]) -> list[str]:
    """The wanted points and all that they lean on."""
    found = dict.fromkeys(wanted)
    stack = list(found)
    while stack:
        for p in leans(system, stack.pop()):
            if p not in found:
                found[p] = None
                stack.append(p)
    return list(found)


def groups_of(system: System, goal: list[str]) -> list[tuple[str, ...]]:
    """The strongly connected parts that lean on no other part."""
    ahead = {p: _reached(p, lambda q: leans(system, q)) for p in goal}
    parts = {p: tuple(q for q in goal if q in ahead[p] and p in ahead[q]) for p in goal}
    return [part for p, part in parts.items() if part[0] == p and set(part) == ahead[p]]


def _reached(point: str, following: Callable[[str], list[str]]) -> set[str]:
    """A point and all that can be reached from it."""
    found, stack = {point}, [point]
    while stack:
        for p in following(stack.pop()):
            if p not in found:
                found.add(p)
                stack.append(p)
    return found
