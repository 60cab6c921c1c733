"""Topology, and groups of links, by combinatorics alone; here which links move as one body, and the bonds
between bodies: what a plan is made from.

A bond is one joint between two bodies, with the relative freedoms (1 or 2) that it leaves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import lru_cache

from icsolve.case import Case, Joint, Rope
from icsolve.case.joints import Mesh
from icsolve.errors import SceneError, Status
from icsolve.tuples import NamedTuple, TypeVar

T = TypeVar("T")


class BareBond(NamedTuple):
    """What a plan looks at of a bond: its bodies a and b, and the freedoms that it leaves between them."""

    a: int
    b: int
    freedom: int
    pin: int = 0
    """of pins: a number from 1, the same for all bodies that turn about one"""

    @property
    def constraints(self) -> int:
        """Independent constraints that the joint imposes."""
        return 3 - self.freedom

    def other(self, body: int) -> int:
        """The body at the other end."""
        return self.b if body == self.a else self.a


class Bond(NamedTuple):
    """A joint between the bodies a and b; ``links`` are the links it joins."""

    a: int
    b: int
    freedom: int
    joint: Joint
    links: tuple[str, str]
    pivots: tuple[str, str] | tuple[()] = ()
    """of gears and belts: the points at which the two links are pinned to their carrier"""
    carrier: int = -1
    """of gears and belts: the body to which both are pinned"""

    def other(self, body: int) -> int:
        """The body at the other end."""
        return self.b if body == self.a else self.a


class Skeleton(NamedTuple):
    """Bodies and bonds without links, joints and numbers: mechanisms alike have one, and one plan."""

    bodies: int
    bonds: tuple[BareBond, ...]
    at: tuple[tuple[int, ...], ...]
    """for each body the indices of its bonds"""


class Topology(NamedTuple):
    """Bodies are numbered in order of their first link; ``members`` has the links of each."""

    body_of: dict[str, int]
    members: tuple[tuple[str, ...], ...]
    bonds: tuple[Bond, ...]
    at: tuple[tuple[int, ...], ...]
    """for each body the indices of its bonds"""
    ground: int
    ropes: tuple[Rope, ...] = ()
    """those that are fixed at both ends: each is one constraint of several bodies"""

    @property
    def skeleton(self) -> Skeleton:
        """What a plan is made from."""
        pins: dict[tuple[str, int], int] = {}
        bare: list[BareBond] = []
        for a, b, freedom, joint, *_ in self.bonds:
            pin, pivot = 0, joint.pivot
            if pivot is not None:
                pin = pins.get((pivot, a)) or pins.get((pivot, b)) or len(bare) + 1
                pins[pivot, a] = pins[pivot, b] = pin
            bare.append(BareBond(a, b, freedom, pin))
        return Skeleton(len(self.members), tuple(bare), self.at)

    @property
    def freedoms_by_count(self) -> int:
        """Mobility by counting: three a moving body less the constraints (Gruebler)."""
        return 3 * (len(self.members) - 1) - self.constraints

    @property
    def wedges(self) -> int:
        """How many independent rings there are of bodies that slide on each other."""
        group = list(range(len(self.members)))
        rings = 0
        for bond in self.bonds:
            if bond.joint.keeps_direction:
                a, b = group[bond.a], group[bond.b]
                rings += a == b
                group = [a if one == b else one for one in group]
        return rings

    @property
    def constraints(self) -> int:
        """What the joints and ropes take."""
        return sum(3 - bond.freedom for bond in self.bonds) + len(self.ropes)

    @property
    def afloat(self) -> tuple[tuple[int, ...], ...]:
        """The groups of bodies that no chain of joints ties to the frame."""
        held, groups = reached((self.ground,), self.beside), []
        for body in range(len(self.members)):
            if body not in held:
                group = reached((body,), self.beside)
                groups.append(tuple(sorted(group)))
                held |= group
        return tuple(groups)

    def beside(self, body: int) -> list[int]:
        """The bodies that joints tie to this one."""
        return [self.bonds[k].other(body) for k in self.at[body]]


def reached(first: Iterable[T], following: Callable[[T], Iterable[T]]) -> dict[T, None]:
    """All that can be reached from some, and these, in the order in which it is found."""
    found = dict.fromkeys(first)
    stack = list(found)
    while stack:
        for other in following(stack.pop()):
            if other not in found:
                found[other] = None
                stack.append(other)
    return found


@lru_cache(maxsize=32)
def topology(case: Case, *, as_ties: bool = False) -> Topology:
    """Bodies and bonds of a case; of a pin of several ``as_ties`` those that reactions are told of, or those
    with a link that an answer needs in any case, if one is: what else hangs there can be left out.

    Raises SceneError where gears or a belt have no common carrier, and for a case in space.
    """
    if case.space is not None:
        raise SceneError(Status.UNSUPPORTED, "this needs a planar case, and this one is in space.")
    if case.touches:
        said = "this needs contacts whose `at` and `normal` are given, and here profiles give them."
        raise SceneError(Status.UNSUPPORTED, said)
    if case.unknowns:
        said = (
            f"this needs a figure whose data are given, and {case.unknowns[0].path} is to find: write a "
            "number in its place, or `solve` the case for each value: it lists the positions of equilibrium."
        )
        raise SceneError(Status.UNSUPPORTED, said)
    body_of, members = _bodies(case)
    pins = _pinned_at(case, body_of) if any(isinstance(joint, Mesh) for joint in case.joints) else {}
    needed = {case.ground, *(load.link for load in case.loads), *(given.link for given in case.motion)}
    bonds = tuple(_bonds(case, body_of, pins, None if as_ties else needed))
    at: list[list[int]] = [[] for _ in members]
    for k, bond in enumerate(bonds):
        at[bond.a].append(k)
        at[bond.b].append(k)
    ropes = tuple(rope for rope in case.ropes if not rope.is_free)
    return Topology(body_of, members, bonds, tuple(map(tuple, at)), body_of[case.ground], ropes)


def welded(case: Case, link: str) -> tuple[str, ...]:
    """The links that move as one with a link, itself among them; what the frame has welded to it is frame."""
    body_of, members = _bodies(case)
    return members[body_of[link]]


@lru_cache(maxsize=32)
def _bodies(case: Case) -> tuple[dict[str, int], tuple[tuple[str, ...], ...]]:
    leader = {link: link for link in (*case.links, case.ground)}

    def find(link: str) -> str:
        while leader[link] != link:
            link = leader[link]
        return link

    for joint in case.joints:
        if not joint.freedom:
            leader[find(joint.links[1])] = find(joint.links[0])
    members: dict[str, list[str]] = {}
    for link in leader:
        members.setdefault(find(link), []).append(link)
    body_of = {link: k for k, group in enumerate(members.values()) for link in group}
    return body_of, tuple(tuple(group) for group in members.values())


def _pinned_at(case: Case, body_of: dict[str, int]) -> dict[str, list[int]]:
    """The bodies that turn about each point: one pin, or several with the same point."""
    at: dict[str, list[int]] = {}
    for joint in case.joints:
        if joint.pivot is not None:
            at.setdefault(joint.pivot, []).extend(body_of[link] for link in joint.links)
    return at


def _bonds(
    case: Case, body_of: dict[str, int], pins: dict[str, list[int]], hubs: set[str] | None
) -> Iterable[Bond]:
    pins_of: dict[int, list[str]] = {}
    for point, bodies in pins.items():
        for body in dict.fromkeys(bodies):
            pins_of.setdefault(body, []).append(point)
    for joint in case.joints:
        several = hubs is not None and len(joint.links) > 2
        hub = next((link for link in joint.links if link in hubs), None) if several and hubs else None
        others: set[int] = set()
        for links in pairs_of(joint, hub):
            a, b = body_of[links[0]], body_of[links[1]]
            if not joint.freedom or a == b or (several and b in others):
                continue
            others.add(b)
            pivots: tuple[str, str] | tuple[()] = ()
            carrier = -1
            if isinstance(joint, Mesh):
                pivots, carrier = _pivots(joint, body_of, pins, pins_of)
            yield Bond(a, b, joint.freedom, joint, links, pivots, carrier)


def pairs_of(joint: Joint, hub: str | None = None) -> list[tuple[str, str]]:
    """The pairs of links that a joint joins; a pin of several is carried by ``hub``, or the first."""
    first = joint.links[0] if hub is None else hub
    return [(first, other) for other in joint.links if other != first]


def _pivots(
    joint: Mesh, body_of: dict[str, int], pins: dict[str, list[int]], pins_of: dict[int, list[str]]
) -> tuple[tuple[str, str], int]:
    """The pins about which two wheels turn on a common carrier, and that."""
    a, b = (body_of[link] for link in joint.links)
    wanted = body_of[joint.carrier] if joint.carrier else None
    found: dict[tuple[str, str], int] = {}
    for p in pins_of.get(a, ()):
        for q in pins_of.get(b, ()):
            for carrier in sorted(set(pins[p]) & set(pins[q]) - {a, b}) if p != q else ():
                if wanted in (None, carrier):
                    found.setdefault((p, q), carrier)
    if len(found) == 1:
        return next(iter(found.items()))
    names = f"{joint.kind} {joint.links[0]} and {joint.links[1]}"
    if not found:
        raise SceneError(
            Status.INCONSISTENT,
            f"the {names} have no common carrier: pin both, each at a point of its own, to one link "
            "(the frame or an arm) and they can turn about those pins.",
        )
    ways = " or ".join(sorted(f"{p}-{q}" for p, q in found))
    mend = "give `carrier:` the link."
    if len(set(found.values())) == 1:  # two links that are pinned twice do not turn
        mend = "let one pin join each of them to their carrier, or weld what does not turn."
    message = f"the {names} could turn about several pairs of pins ({ways}): {mend}"
    raise SceneError(Status.AMBIGUOUS, message)
