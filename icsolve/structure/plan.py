"""Topology -> the ordered steps that the wanted twists need, and no others: pure combinatorics.

Only relative motion matters, so any joint with one freedom may serve as the virtual input: its two bodies
are known, and every further group of bodies that their constraints determine follows: one link (monad), two
links (dyad), or the smallest larger group. The input is chosen so that the wanted bodies need the fewest
steps.

For the larger groups every constraint is matched to a body that it helps to determine, three a body; the
closed and saturated parts of the resulting graph are the groups (Dulmage-Mendelsohn decomposition, the
Assur groups of the theory of machines).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Container, Hashable, Iterable, Mapping
from functools import lru_cache

from icsolve.structure import Skeleton, Topology, reached
from icsolve.tuples import NamedTuple, TypeVar

T = TypeVar("T", bound=Hashable)
Row = TypeVar("Row", bound=Hashable)
Column = TypeVar("Column", bound=Hashable)

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

    def __init__(self, top: Skeleton, known: set[int]) -> None:
        self.top = top
        self.known = known
        self.parts: list[GroupPart] = []
        self.load: dict[int, list[Constraint]] = {body: [] for body in range(top.bodies) if body not in known}
        for k, bond in enumerate(top.bonds):
            for row in range(bond.constraints):
                self._place((k, row))

    def smallest_group(self) -> tuple[int, ...]:
        """The bodies of the smallest group, in order; empty where nothing is determined."""
        moved = self._follow()
        self.parts = [part for part in self.parts if not part.bodies <= self.known]
        if moved or not self.parts or any(part.bodies & self.known for part in self.parts):
            self.parts = determined(self.load, self._bodies, 3)
        closed = [part for part in self.parts if part.others <= self.known]
        best = min(closed, key=lambda part: len(part.bodies), default=None)
        return () if best is None else tuple(sorted(best.bodies))

    def _follow(self) -> bool:
        """Match anew what was matched to bodies that are known now; whether anything was."""
        gone = [body for body in self.load if body in self.known]
        freed = [row for body in gone for row in self.load.pop(body)]
        placed = [self._place(row) for row in freed]
        return any(placed)

    def _place(self, root: Constraint) -> bool:
        """Match a constraint to one of its unknown bodies; whether it can be."""
        return matched(root, self._bodies, self.load, 3)

    def _bodies(self, row: Constraint) -> list[int]:
        bond = self.top.bonds[row[0]]
        return [body for body in (bond.a, bond.b) if body in self.load and body not in self.known]


def matched(
    root: Row, reach: Callable[[Row], Iterable[Column]], held: dict[Column, list[Row]], most: int
) -> bool:
    """Give a row one of the columns that it reaches, moving others along an alternating path; whether it can
    be.

    Parameters
    ----------
    root : the row; the path to it is the shortest (breadth first)
    reach : the columns of a row, all of them among ``held``
    held : by column, the rows that have it; changed
    most : how many rows may have a column
    """
    came: dict[Column, Row] = {}
    before: dict[Row, Column | None] = {root: None}
    queue = [root]
    for row in queue:
        for column in reach(row):
            if column in came:
                continue
            came[column] = row
            if len(held[column]) < most:
                _flip(column, came, before, held)
                return True
            for other in held[column]:
                if other not in before:
                    before[other] = column
                    queue.append(other)
    return False


def loose(
    held: Mapping[Column, Collection[Row]], reach: Callable[[Row], Iterable[Column]], most: int
) -> dict[Column, None]:
    """The columns that too few rows determine: those that have fewer than ``most``, and those whose rows bear
    on such a one (A. L. Dulmage, N. S. Mendelsohn, Canadian Journal of Mathematics 10, 1958).

    Parameters
    ----------
    held, reach, most : as of `matched`, when all rows have been given a column
    """
    users: dict[Column, list[Column]] = {column: [] for column in held}
    for column, rows in held.items():
        for other in (other for row in rows for other in reach(row)):
            users[other].append(column)
    return reached((column for column, rows in held.items() if len(rows) < most), users.__getitem__)


def determined(
    held: Mapping[int, Collection[Row]], reach: Callable[[Row], Iterable[int]], most: int
) -> list[GroupPart]:
    """The parts of a matching of bodies that determine one another, each after those that it needs; the
    parameters are those of `loose`."""
    free = loose(held, reach, most)
    needs = {
        body: dict.fromkeys(other for row in rows for other in reach(row) if other != body)
        for body, rows in held.items()
        if body not in free
    }
    return [
        GroupPart(set(members), {other for body in members for other in needs[body]} - set(members))
        for members in strongly_connected(needs)
    ]


def _flip(
    end: Column,
    came: Mapping[Column, Row],
    before: Mapping[Row, Column | None],
    held: Mapping[Column, list[Row]],
) -> None:
    column: Column | None = end
    while column is not None:
        row = came[column]
        held[column].append(row)
        column = before[row]
        if column is not None:
            held[column].remove(row)


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


class Group(NamedTuple):
    """One step: the bodies that ``bonds`` determine from the bodies known before.

    ``kind`` is ``monad`` (one body; the bonds are that with one freedom, that with two), ``dyad`` (two
    bodies; the bonds are the first's to what is known, the one between them, the second's to what is
    known) or empty; ``ends`` are the known bodies of the first and last bond of a monad or dyad.
    """

    bodies: tuple[int, ...]
    bonds: tuple[int, ...]
    kind: str = ""
    ends: tuple[int, int] = (-1, -1)


class Plan(NamedTuple):
    """``entry`` is the bond of the virtual input; then the groups in order.

    ``closed`` says that the groups reach every body of the scene and use every bond once: counting
    finds one freedom and nothing redundant. Where it is False the loop equations of the whole scene
    are to be solved at once.
    """

    entry: int
    groups: tuple[Group, ...]
    closed: bool
    bodies: frozenset[int]
    """the bodies whose twists the plan finds"""
    bonds: tuple[int, ...] = ()
    """the bonds whose places it needs"""


CANDIDATES = 12
"""Virtual inputs that are tried; those at the wanted bodies come first."""


def make_plan(top: Topology, wanted: Iterable[int]) -> Plan | None:
    """The cheapest plan for the twists of the wanted bodies, relative to one another.

    None where no joint with one freedom can serve as input. A plan that is not ``closed`` has no
    groups to run.
    """
    return _planned(top.skeleton, frozenset(wanted))


@lru_cache(maxsize=64)
def _planned(top: Skeleton, wanted: frozenset[int]) -> Plan | None:
    best: Plan | None = None
    bodies = max(2, len(wanted))
    for entry in _entries(top, wanted):
        plan = _pruned(top, _grown(top, entry), wanted)
        if best is None or _cost(plan) < _cost(best):
            best = plan
        small = len(best.bodies) <= bodies and all(len(group.bodies) <= 2 for group in best.groups)
        if best.closed and (small or _cost(best) <= _least(top, bodies)):
            break
    return best


def _entries(top: Skeleton, wanted: Collection[int]) -> list[int]:
    singles = [k for k, bond in enumerate(top.bonds) if bond.freedom == 1]
    inside = [k for k in singles if top.bonds[k].a in wanted or top.bonds[k].b in wanted]
    both = [k for k in inside if top.bonds[k].a in wanted and top.bonds[k].b in wanted]
    return list(dict.fromkeys(both + inside + singles))[:CANDIDATES]


def _cost(plan: Plan) -> tuple[bool, int]:
    return (not plan.closed, sum(len(group.bodies) ** 3 for group in plan.groups))


def _least(top: Skeleton, bodies: int) -> tuple[bool, int]:
    """No plan that finds so many bodies costs less; where each joint leaves one freedom, groups have two."""
    alone = any(bond.freedom == 2 for bond in top.bonds)
    return (False, bodies - 2 if alone else 8 * ((bodies - 1) // 2))


def _grown(top: Skeleton, entry: int) -> Plan:
    """All bodies that follow from this input, group by group."""
    bond = top.bonds[entry]
    growth = _Growth(top, (bond.a, bond.b), entry)
    groups = tuple(growth.groups())
    used = {entry}.union(*(group.bonds for group in groups))
    closed = len(growth.known) == top.bodies and len(used) == len(top.bonds) and not growth.surplus
    return Plan(entry, groups, closed, frozenset(growth.known))


class _Growth:
    """The set of known bodies as it grows; each body is looked at again only when a neighbour is found."""

    def __init__(self, top: Skeleton, known: Iterable[int], entry: int) -> None:
        self.top = top
        self.entry = entry
        self.known = set(known)
        self.matching: Matching | None = None
        self.queue = deque(self._neighbours(self.known))
        self.surplus = any(
            k != entry and top.bonds[k].a in self.known and top.bonds[k].b in self.known
            for body in self.known
            for k in top.at[body]
        )

    def groups(self) -> Iterable[Group]:
        while True:
            bodies = self._next()
            if not bodies:
                return
            yield self._take(bodies)

    def _next(self) -> tuple[int, ...]:
        while self.queue:
            body = self.queue.popleft()
            if body in self.known:
                continue
            if self._held(body) >= 3:
                return (body,)
            for other in self._neighbours((body,)):
                if self._held(body) + self._held(other) + self._constraints(body, (other,)) >= 6:
                    return (body, other)
        if len(self.known) == self.top.bodies:
            return ()
        if self.matching is None:
            self.matching = Matching(self.top, self.known)
        return self.matching.smallest_group()

    def _take(self, bodies: tuple[int, ...]) -> Group:
        self.known.update(bodies)
        bonds = tuple(
            dict.fromkeys(
                k for body in bodies for k in self.top.at[body] if self.top.bonds[k].other(body) in self.known
            )
        )
        if sum(self.top.bonds[k].constraints for k in bonds) > 3 * len(bodies):
            self.surplus = True
        self.queue.extend(self._neighbours(bodies))
        return Group(bodies, bonds)

    def _neighbours(self, bodies: Iterable[int]) -> list[int]:
        found = (self.top.bonds[k].other(body) for body in bodies for k in self.top.at[body])
        return list(dict.fromkeys(body for body in found if body not in self.known))

    def _held(self, body: int) -> int:
        """Constraints of a body against known bodies."""
        return self._constraints(body, self.known)

    def _constraints(self, body: int, others: Container[int]) -> int:
        bonds = [self.top.bonds[k] for k in self.top.at[body]]
        return sum(3 - bond.freedom for bond in bonds if (bond.b if body == bond.a else bond.a) in others)


def _pruned(top: Skeleton, plan: Plan, wanted: Collection[int]) -> Plan:
    """The plan without the groups that no wanted body needs; not closed where one of these holds some of its
    bodies more than once, and with them what it is left out of."""
    if not plan.closed:
        return plan._replace(groups=())
    needed = set(wanted)
    kept: list[Group] = []
    for group in reversed(plan.groups):
        if needed.isdisjoint(group.bodies):
            if _repeats(top, group):
                return plan._replace(closed=False, groups=())
            continue
        kept.append(group)
        for k in group.bonds:
            needed.update((top.bonds[k].a, top.bonds[k].b))
    entry = top.bonds[plan.entry]
    bodies = frozenset({entry.a, entry.b}.union(*(group.bodies for group in kept)))
    groups = tuple(_classified(top, group) for group in reversed(kept))
    bonds = dict.fromkeys((plan.entry, *(k for group in kept for k in group.bonds)))
    return plan._replace(groups=groups, bodies=bodies, bonds=tuple(bonds))


KNOWN = -1
"""All bodies that are known before a group, as one."""


def _repeats(top: Skeleton, group: Group) -> bool:
    """Whether some bodies of a group, or some and what is known, have more constraints among them than they
    have freedoms, so that others have fewer.

    The pebble game: no constraint is one too many where three more between the same two still find a place
    (A. Lee and I. Streinu, Discrete Mathematics 308, 2008). Bodies on one pin hold its point, not one another
    (W. Whiteley, SIAM Journal on Discrete Mathematics 2, 1989).
    """
    bonds = [top.bonds[k] for k in group.bonds]
    pinned = [bond for bond in bonds if bond.pin]
    if _classified(top, group).kind and len(pinned) == len({bond.pin for bond in pinned}):
        return False
    inside = {*group.bodies}

    def side(body: int) -> int:
        return body if body in inside else KNOWN

    on_pins = dict.fromkeys((body, KNOWN - bond.pin) for bond in pinned for body in (bond.a, bond.b))
    ends = [(side(body), pin, 2) for body, pin in on_pins]
    ends += [(side(bond.a), side(bond.b), bond.constraints) for bond in bonds if not bond.pin]
    held: dict[int, list[tuple[int, int, int]]] = {body: [] for body in (KNOWN, *inside)}
    held |= {pin: [(pin, pin, 0)] for _, pin in on_pins}  # a point has two freedoms
    for n, (a, b, constraints) in enumerate(ends, 1):
        rows = [(a, b, 8 * n + row) for row in range(constraints + 3)]
        if not all(matched(row, lambda row: row[:2], held, 3) for row in rows):
            return True
        for kept in held.values():
            kept[:] = [row for row in kept if row not in rows[constraints:]]
    return False


def _classified(top: Skeleton, group: Group) -> Group:
    """The group as a monad or dyad, if it is one."""
    bonds = sorted(group.bonds, key=lambda k: top.bonds[k].freedom)
    shape = [top.bonds[k].freedom for k in bonds]
    if len(group.bodies) == 1 and shape == [1, 2]:
        (body,) = group.bodies
        ends = (top.bonds[bonds[0]].other(body), top.bonds[bonds[1]].other(body))
        return Group(group.bodies, tuple(bonds), "monad", ends)
    if len(group.bodies) != 2 or shape != [1, 1, 1]:
        return group
    u, v = group.bodies
    inner = [k for k in bonds if {top.bonds[k].a, top.bonds[k].b} == {u, v}]
    outer = [[k for k in bonds if k not in inner and k in top.at[body]] for body in (u, v)]
    if len(inner) != 1 or any(len(held) != 1 for held in outer):
        return group
    ends = (top.bonds[outer[0][0]].other(u), top.bonds[outer[1][0]].other(v))
    return Group(group.bodies, (outer[0][0], inner[0], outer[1][0]), "dyad", ends)
