"""The smallest group of bodies that the known bodies determine, where no monad or dyad is left.

Every constraint is matched to a body that it helps to determine, three a body; the closed and
saturated parts of the resulting graph are the groups (Dulmage-Mendelsohn decomposition, the Assur
groups of the theory of machines).
"""

from __future__ import annotations

from collections.abc import Collection

from icsolve.structure.topology import Topology


def smallest_group(top: Topology, known: Collection[int]) -> tuple[int, ...]:
    """The bodies of the smallest group, in order; empty where nothing is determined."""
    owner = _matching(top, known)
    needs = _needs(top, known, owner)
    counts = dict.fromkeys(needs, 0)
    for body in owner.values():
        counts[body] += 1
    loose = [body for body in needs if counts[body] < 3]
    determined = set(needs) - _reach_back(needs, loose)
    best: set[int] = set()
    for body in determined:
        group = _reach(needs, body)
        if not best or len(group) < len(best):
            best = group
    return tuple(sorted(best))


def _matching(top: Topology, known: Collection[int]) -> dict[tuple[int, int], int]:
    """Constraint (bond, row) -> the unknown body it is matched to; at most three a body."""
    owner: dict[tuple[int, int], int] = {}
    load: dict[int, list[tuple[int, int]]] = {}

    def place(row: tuple[int, int], seen: set[int]) -> bool:
        bond = top.bonds[row[0]]
        for body in (bond.a, bond.b):
            if body in known or body in seen:
                continue
            seen.add(body)
            rows = load.setdefault(body, [])
            if len(rows) < 3:
                rows.append(row)
                owner[row] = body
                return True
            for other in list(rows):
                if place(other, seen):
                    rows.remove(other)
                    rows.append(row)
                    owner[row] = body
                    return True
        return False

    for k, bond in enumerate(top.bonds):
        if bond.a not in known or bond.b not in known:
            for row in range(bond.constraints):
                place((k, row), set())
    return owner


def _needs(
    top: Topology, known: Collection[int], owner: dict[tuple[int, int], int]
) -> dict[int, set[int]]:
    """For each unknown body the other unknown bodies that its own constraints touch."""
    needs: dict[int, set[int]] = {body: set() for body in range(len(top.members)) if body not in known}
    for (k, _), body in owner.items():
        other = top.bonds[k].other(body)
        if other not in known:
            needs[body].add(other)
    return needs


def _reach(needs: dict[int, set[int]], start: int) -> set[int]:
    seen, stack = {start}, [start]
    while stack:
        for body in needs[stack.pop()] - seen:
            seen.add(body)
            stack.append(body)
    return seen


def _reach_back(needs: dict[int, set[int]], ends: list[int]) -> set[int]:
    """The bodies from which one of ``ends`` can be reached."""
    users: dict[int, set[int]] = {body: set() for body in needs}
    for body, others in needs.items():
        for other in others:
            users[other].add(body)
    seen = set(ends)
    stack = list(ends)
    while stack:
        for body in users[stack.pop()] - seen:
            seen.add(body)
            stack.append(body)
    return seen
