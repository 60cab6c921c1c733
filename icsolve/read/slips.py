"""Slips in good YAML and good keys: a load on a link that lacks its point, a frame by its name alone.

What a case says may be read as the format has it and still not be what its figure shows. Where the case
itself holds the evidence (joints or dimensions fix a point to another link, a link is called `ground`), the
slip is refused with both ways to say what is meant; without evidence nothing is suspected.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from icsolve.case import (
    Centroid,
    Contact,
    Coordinates,
    Corner,
    Direction,
    Joint,
    KnownCentre,
    Length,
    Load,
    Mark,
    Motion,
    Pin,
    Roll,
    Slide,
    Slot,
    Spring,
    Torque,
    Weld,
)
from icsolve.read.document import Mapping, Node, Sequence
from icsolve.read.reading import Reading

FRAMES = ("0", "frame", "ground", "base", "fixed", "gnd", "earth")
"""What books call the frame."""
_PLACED = Pin | Slide | Slot | Weld | Roll | Contact
"""Joints whose point is a point of their links; a known centre is none."""


class Figure(NamedTuple):
    """What tells to which link a point belongs."""

    joints: tuple[Joint, ...]
    lengths: tuple[Length, ...]
    angles: tuple[Direction | Corner, ...]
    points: dict[str, Coordinates | Centroid]
    further: dict[str, tuple[str, ...]]
    """points of links by `links:` and by profiles"""


def check_frame(reading: Reading, given: bool, ground: str, welds: Iterable[tuple[str, str]]) -> None:
    """Refuse a link that is called as frames are where the case leaves it open which link is the frame."""
    if given or not reading.links or ground not in reading.links:
        return
    still = _welded(ground, welds)
    for link, mark in reading.links.items():
        if link.lower() in FRAMES and link not in still:
            said = f"link {link} has the name of a frame, but without 'ground:' link {ground} is the frame"
            reading.refuse(mark, f"{said}; write 'ground: {link}', or 'ground: {ground}' if that is meant")
            return


def _welded(link: str, welds: Iterable[tuple[str, str]]) -> set[str]:
    """The links that move as one with a link."""
    pairs = list(welds)
    found = {link}
    while more := {b for pair in pairs for a, b in (pair, pair[::-1]) if a in found} - found:
        found |= more
    return found


def check_loads(
    reading: Reading,
    root: Mapping,
    figure: Figure,
    loads: tuple[Load, ...],
    motion: tuple[Motion, ...],
    ground: str,
) -> tuple[str, ...]:
    """Refuse loads and motions at a point that is fixed to another link; sentences on what may be meant.

    A joint's point is at one place with the links that it does not join, and a load may act on these there:
    that is said, not refused. A point that dimensions fix to one link belongs to it and to no other.
    """
    owners, said = _Owners(figure, ground), []
    for what, link, point, key, way in _places(loads, motion, ground):
        others, fixed = owners.instead(link, point)
        if not others:
            continue
        whose = " and ".join(f"link {other}" for other in others[:2])
        remedy = " or ".join(f"'{key}: {other}'" for other in others[:2])
        if fixed:
            mark = _mark(root, *way)
            message = f"{what} link {link} at {point}, which is a point of {whose}: write {remedy}"
            reading.refuse(mark, f"{message}, or 'links: {{{link}: [{point}]}}' if link {link} has it too")
        else:
            there = f"{what} link {link} at {point}, a joint of {whose}"
            said.append(f"{there}; if one of these is meant, write {remedy}.")
    for load in loads:
        known = getattr(load, "value", 0) is not None
        if (
            load.link == ground
            and getattr(load, "against", None) is None
            and known
            and not isinstance(load, Spring)
        ):
            said.append(
                f"load {load.name} acts on link {ground}, the frame, which never moves: it does no work."
            )
    return tuple(said)


def _places(
    loads: tuple[Load, ...], motion: tuple[Motion, ...], ground: str
) -> Iterator[tuple[str, str, str, str, tuple[str | int, ...]]]:
    """What is put on which link at which point, the key that says the link, and where that stands."""
    for load in loads:
        if isinstance(load, Torque):
            continue
        way = ("loads", load.name)
        yield f"load {load.name} acts on", load.link, load.at, "link", (*way, "link")
        if isinstance(load, Spring):
            key = "against" if load.against else "to"
            what = f"the other end of load {load.name} is fixed to"
            yield what, load.against or ground, load.to, "against", (*way, key)
    for index, given in enumerate(motion):
        if given.point:
            yield "the motion is given on", given.link, given.point, "link", ("motion", index, "link")


def _mark(root: Mapping, *way: str | int) -> Mark:
    """Where a key's value stands; of what is missing, the nearest that is there."""
    node: Node = root
    for step in way:
        if type(node) is Mapping and step in node.items:
            node = node.items[str(step)]
        elif type(node) is Sequence and isinstance(step, int):
            node = node.items[step]
    return node.mark


class _Owners:
    """To which links points belong, as joints, `links:` and dimensions tell."""

    def __init__(self, figure: Figure, ground: str) -> None:
        self.figure, self.ground = figure, ground
        welds = [joint.links for joint in figure.joints if isinstance(joint, Weld)]
        self.own: dict[str, set[str]] = {}
        for link, point in _on_joints(figure.joints):
            self.own.setdefault(link, set()).add(point)
        for link, points in figure.further.items():
            self.own.setdefault(link, set()).update(points)
        for links in welds:
            together = _welded(links[0], welds)
            points_of_all = set().union(*(self.own.get(link, ()) for link in together))
            self.own.update(dict.fromkeys(together, points_of_all))
        self.dimensioned = {end for length in figure.lengths for end in (length.a, length.b)}
        self.centres = {joint.at for joint in figure.joints if isinstance(joint, KnownCentre)}
        self.fixed: dict[str, set[str]] = {}

    def instead(self, link: str, point: str) -> tuple[list[str], bool]:
        """The links that have a point, where a link has it not, and whether dimensions say so."""
        own = self.own.get(link, set())
        if point in own or point in self.centres or point.startswith("@"):
            return [], False
        by_joints = [other for other, points in self.own.items() if point in points]
        if by_joints or point not in self.dimensioned:
            return by_joints, False
        arms = (length for length in self.figure.lengths if {length.a, length.b} - own == {point})
        if link != self.ground and any(arms):
            return (
                [],
                True,
            )  # an arm's free end: its length says whose it is, its angle may be to another link
        return [other for other in self.own if point in self._fixed_to(other)], True

    def _fixed_to(self, link: str) -> set[str]:
        """The points of a link, and those that two dimensions each fix to these."""
        if link not in self.fixed:
            found = set(self.own[link])
            while more := set(_tied(self.figure, found)) - found:
                found |= more
            self.fixed[link] = found
        return self.fixed[link]


def _on_joints(joints: Iterable[Joint]) -> Iterator[tuple[str, str]]:
    for joint in joints:
        if not isinstance(joint, _PLACED) or joint.at is None:
            continue
        guide = joint.guide if isinstance(joint, Slide | Slot) else None
        named = [*(guide.ends or ()), guide.through] if guide else []
        for link in joint.links:
            yield from ((link, point) for point in (joint.at, *named) if point)


def _tied(figure: Figure, known: set[str]) -> Iterator[str]:
    """Points that two lengths or corners, or the mean of known points, fix to points that are known."""
    ties: dict[str, int] = {}
    sets = [{length.a, length.b} for length in figure.lengths]
    sets += [{angle.a, angle.at, angle.b} for angle in figure.angles if isinstance(angle, Corner)]
    for points in sets:
        if len(free := points - known) == 1:
            (point,) = free
            ties[point] = ties.get(point, 0) + 1
    yield from (point for point, count in ties.items() if count > 1)
    for point, value in figure.points.items():
        if isinstance(value, Centroid) and {*value.of} <= known:
            yield point
