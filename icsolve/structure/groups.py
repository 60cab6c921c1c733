"""The smallest group of bodies that the known bodies determine, where no monad or dyad is left.

Every constraint is matched to a body that it helps to determine, three a body; the closed and
saturated parts of the resulting graph are the groups (Dulmage-Mendelsohn decomposition, the Assur
groups of the theory of machines).
"""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable, Mapping
from typing import TypeVar

from icsolve.structure.topology import Topology
from icsolve.tuples import NamedTuple

T = TypeVar("T", bound=Hashable)

Constraint = tuple[int, int]
"""A bond and one of its constraints."""


class GroupPart(NamedTuple):
    """Bodies that determine one another, and the other bodies that they need to be known first."""

    bodies: set[int]
    others: set[int]


class Matching:
    """Constraints matched to the unknown bodies that they help to determine, at most three a body.

    As bodies become known their constraints are matched anew, and only these: a matching of all serves
    every group of a mechanism.
    """

    def __init__(self, top: Topology, known: set[int]) -> None:
        self.top = top
        self.known = known
        self.parts: list[GroupPart] = []
        self.load: dict[int, list[Constraint]] = {
            body: [] for body in range(len(top.members)) if body not in known
        }
        for k, bond in enumerate(top.bonds):
            for row in range(bond.constraints):
                self._place((k, row))

    def smallest_group(self) -> tuple[int, ...]:
        """The bodies of the smallest group, in order; empty where nothing is determined."""
        moved = self._follow()
        self.parts = [part for part in self.parts if not part.bodies <= self.known]
        if moved or not self.parts or any(part.bodies & self.known for part in self.parts):
            self.parts = self._determined()
        closed = [part for part in self.parts if part.others <= self.known]
        best = min(closed, key=lambda part: len(part.bodies), default=None)
        return () if best is None else tuple(sorted(best.bodies))

    def _follow(self) -> bool:
        """Match anew what was matched to bodies that are known now; whether anything was."""
        gone = [body for body in self.load if body in self.known]
        freed = [row for body in gone for row in self.load.pop(body)]
        placed = [self._place(row) for row in freed]
        return any(placed)

    def _determined(self) -> list[GroupPart]:
        """The parts that no body with too few constraints bears on."""
        needs = {body: self._needs(body, rows) for body, rows in self.load.items()}
        loose = [body for body, rows in self.load.items() if len(rows) < 3]
        reaching = _reach_back(needs, loose)
        held = {body: others for body, others in needs.items() if body not in reaching}
        return [
            GroupPart(set(members), {other for body in members for other in held[body]} - set(members))
            for members in strongly_connected(held)
        ]

    def _place(self, root: Constraint) -> bool:
        """Match a constraint, moving others along an alternating path (breadth first); whether it can be."""
        came: dict[int, Constraint] = {}
        before: dict[Constraint, int | None] = {root: None}
        queue = [root]
        for row in queue:
            bond = self.top.bonds[row[0]]
            for body in (bond.a, bond.b):
                if body in came or body not in self.load or body in self.known:
                    continue
                came[body] = row
                if len(self.load[body]) < 3:
                    self._flip(body, came, before)
                    return True
                for other in self.load[body]:
                    if other not in before:
                        before[other] = body
                        queue.append(other)
        return False

    def _flip(
        self, end: int, came: Mapping[int, Constraint], before: Mapping[Constraint, int | None]
    ) -> None:
        body: int | None = end
        while body is not None:
            row = came[body]
            self.load[body].append(row)
            body = before[row]
            if body is not None:
                self.load[body].remove(row)

    def _needs(self, body: int, rows: Iterable[Constraint]) -> list[int]:
        """The other unknown bodies that a body's own constraints touch."""
        found = dict.fromkeys(self.top.bonds[k].other(body) for k, _ in rows)
        return [other for other in found if other not in self.known]


def _reach_back(needs: Mapping[int, Collection[int]], ends: list[int]) -> set[int]:
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


def strongly_connected(needs: Mapping[T, Collection[T]]) -> list[list[T]]:
    """The strongly connected parts of a graph, each after those that it leads to.

    R. Tarjan, SIAM Journal on Computing 1, 1972, without recursion.
    """
    order: dict[T, int] = {}
    low: dict[T, int] = {}
    placed: set[T] = set()
    out: list[list[T]] = []
    path: list[T] = []
    for root in needs:
        if root in order:
            continue
        order[root] = low[root] = len(order)
        path.append(root)
        stack = [(root, iter(needs[root]))]
        while stack:
            node, others = stack[-1]
            for other in others:
                if other not in order:
                    order[other] = low[other] = len(order)
                    path.append(other)
                    stack.append((other, iter(needs[other])))
                    break
                if other not in placed:
                    low[node] = min(low[node], order[other])
            else:
                stack.pop()
                if stack:
                    low[stack[-1][0]] = min(low[stack[-1][0]], low[node])
                if low[node] == order[node]:
                    members: list[T] = []
                    while not members or members[-1] != node:
                        members.append(path.pop())
                    placed.update(members)
                    out.append(members)
    return out
