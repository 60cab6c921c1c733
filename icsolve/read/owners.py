"""To which links points belong: what links carry; and slips in good YAML that this gives away.

What a case says may be read as the format has it and still not be what its figure shows. Where the case
itself holds the evidence (joints or dimensions fix a point to another link, a link is called `ground`), the
slip is refused with both ways to say what is meant; without evidence nothing is suspected.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from icsolve.case import (
    Centroid,
    Coordinates,
    Corner,
    Direction,
    Force,
    Inertia,
    Joint,
    Length,
    Load,
    Mark,
    Motion,
    Spring,
    Stretch,
    Torque,
    TorsionSpring,
    Weight,
    is_link,
    is_named,
)
from icsolve.read.document import Mapping, Node, Sequence
from icsolve.read.reading import Reading
from icsolve.tuples import NamedTuple

if TYPE_CHECKING:
    from icsolve.case.expected import Expected


def carried(
    links: tuple[str, ...],
    ground: str,
    joints: tuple[Joint, ...],
    loads: tuple[Load, ...],
    further: dict[str, tuple[str, ...]],
    motion: tuple[Motion, ...],
) -> dict[str, tuple[str, ...]]:
    """The points that each link carries, in order of mention: of joints, loads, ``links:``, motion."""
    found: dict[str, dict[str, None]] = {link: {} for link in links}
    placed = [pair for joint in joints for pair in joint.carried]
    placed += [pair for load in loads for pair in _on_load(load, ground)]
    placed += [(link, point) for link, points in further.items() for point in points]
    placed += [(given.link, given.point) for given in motion if given.point]
    for link, point in placed:
        found.setdefault(link, {})[point] = None
    return {link: tuple(points) for link, points in found.items()}


def with_masses(
    further: dict[str, tuple[str, ...]], masses: dict[str, Inertia]
) -> dict[str, tuple[str, ...]]:
    """Further points of links and their centres of mass."""
    centres = {link: (one.centre,) for link, one in masses.items() if one.centre}
    return {link: (*further.get(link, ()), *centres.get(link, ())) for link in {**further, **centres}}


def _on_load(load: Load, ground: str) -> list[tuple[str, str]]:
    """The points of a load, each with the link that it is put on; the other end of a spring last."""
    if isinstance(load, Torque):
        return []
    other = load.against or ground if not isinstance(load, Weight) else ground
    if isinstance(load, TorsionSpring):
        own, arm = load.corner[-2:], load.corner[:-2]
        return [*((load.link, point) for point in own), *((other, point) for point in arm)]
    over = load.over if isinstance(load, Force) else None
    ends = [load.at, *(over[:2] if isinstance(over, Stretch) else ())]
    placed = [(load.link, point) for point in ends]
    return [*placed, (other, load.to)] if isinstance(load, Spring) else placed


FRAMES = ("0", "frame", "ground", "base", "fixed", "gnd", "earth")
"""What books call the frame."""


class FigureData(NamedTuple):
    """What tells to which link a point belongs."""

    joints: tuple[Joint, ...]
    lengths: tuple[Length, ...]
    angles: tuple[Direction | Corner, ...]
    points: dict[str, Coordinates | Centroid]
    further: dict[str, tuple[str, ...]]
    """points of links by `links:` and by profiles"""


def check_frame(reading: Reading, given: bool, ground: str, welds: Iterable[tuple[str, ...]]) -> None:
    """Refuse a link that is called as frames are where the case leaves it open which link is the frame."""
    if given or not reading.links or ground not in reading.links:
        return
    still = _welded(ground, welds)
    for link, mark in reading.links.items():
        if link.lower() in FRAMES and link not in still:
            said = f"link {link} has the name of a frame, but without 'ground:' link {ground} is the frame"
            reading.refuse(mark, f"{said}; write 'ground: {link}', or 'ground: {ground}' if that is meant")
            return


def _welded(link: str, welds: Iterable[tuple[str, ...]]) -> set[str]:
    """The links that move as one with a link."""
    pairs = list(welds)
    found = {link}
    while more := {b for pair in pairs for a, *_, b in (pair, pair[::-1]) if a in found} - found:
        found |= more
    return found


def check_loads(
    reading: Reading,
    root: Mapping,
    figure: FigureData,
    loads: tuple[Load, ...],
    motion: tuple[Motion, ...],
    masses: dict[str, Inertia],
    expect: tuple[Expected, ...],
    ground: str,
) -> tuple[str, ...]:
    """Refuse loads, motions, masses and published speeds at a point fixed to another link; sentences on what
    may be meant.

    A joint's point is at one place with the links that it does not join, and a load may act on these there:
    that is said, not refused. A point that dimensions fix to one link belongs to it and to no other.
    """
    bare, said = _Owners(figure, ground), []
    owners = _Owners(figure._replace(further=with_masses(figure.further, masses)), ground)
    places = (*_places(loads, motion, masses, ground), *_speeds(expect))
    for what, link, point, key, way in places:
        others, fixed = (owners if key else bare).instead(link, point)
        if not others:
            continue
        whose = " and ".join(f"link {other}" for other in others[:2])
        remedy = "write " + " or ".join(f"'{key} {other}'" for other in others[:2])
        too, if_not = f"'links: {{{link}: [{point}]}}'", f"if one of these is meant, {remedy}"
        if not key:  # a mass is of its link: its point is the slip
            remedy, too = f"name a point of link {link}", f"'points: [{point}]'"
            if_not = f"if a point of link {link} is meant, name it"
        if fixed:
            message = f"{what} link {link} at {point}, which is a point of {whose}: {remedy}"
            reading.refuse(_mark(root, *way), f"{message}, or {too} if link {link} has it too")
        else:
            said.append(f"{what} link {link} at {point}, a joint of {whose}; {if_not}.")
    for load in loads:
        known = getattr(load, "value", 0) is not None
        alone = getattr(load, "against", None) is None and not isinstance(load, Spring)
        if load.link == ground and alone and known:
            idle = f"load {load.name} acts on link {ground}, the frame, which never moves: it does no work."
            said.append(idle)
    return tuple(said)


def check_guides(figure: FigureData) -> tuple[str, ...]:
    """Sentences on guides that a joint of other links gives, and on slots along points of their own pin's
    link, which it takes along: their line holds in this position, but it may be that the guide is one of
    those links'."""
    said, bearing = [], dict[str, dict[str, None]]()
    for joint in figure.joints:
        for point in (one for one in joint.named if one == joint.at or one not in _guide_points(joint)):
            bearing.setdefault(point, {}).update(dict.fromkeys(joint.links))
    welds = [joint.links for joint in figure.joints if not joint.freedom]
    for joint in (one for one in figure.joints if one.guide is not None):
        pin, slotted = joint.links[0], joint.links[-1]
        own, theirs = _welded(pin, welds), _welded(slotted, welds)
        held, carried_along = False, []
        for point in (one for one in _guide_points(joint) if one != joint.at):
            others = [*bearing.get(point, ())]
            bearers = {*others, *(link for link, points in figure.further.items() if point in points)}
            if not theirs.isdisjoint(bearers):
                held = True
            elif not own.isdisjoint(bearers):
                carried_along.append(point)
            elif others:
                guide = f"the guide of links {' and '.join(joint.links)} at {joint.at} is given by {point}"
                whose = " and ".join(f"link {other}" for other in others[:2])
                meant = "if it is a guide of one of these, name that link second"
                said.append(f"{guide}, a joint of {whose}; {meant}.")
        if joint.freedom > 1 and carried_along and not held:
            said.append(OWN_SLOT.format(pin=pin, link=slotted, point=carried_along[0], at=joint.at))
    return tuple(said)


OWN_SLOT = (
    "the slot of link {link} at {at} is given by {point}, a point of link {pin}, whose pin runs in it: write "
    "'slot: [{link}, {pin}]' if the slot is in link {pin}, 'links: {{{link}: [{point}]}}' if link {link} has "
    "{point} too."
)


def _guide_points(joint: Joint) -> tuple[str, ...]:
    """The points that give the line of a joint's guide."""
    if joint.guide is None:
        return ()
    return (*(joint.guide.ends or ()), *((joint.guide.through,) if joint.guide.through else ()))


def _places(
    loads: tuple[Load, ...], motion: tuple[Motion, ...], masses: dict[str, Inertia], ground: str
) -> Iterator[tuple[str, str, str, str, tuple[str | int, ...]]]:
    """What is put on which link at which point, what the link is written after ('': nothing), and where that
    stands."""
    for load in loads:
        if isinstance(load, Torque) or not is_link(load.link):
            continue
        placed, way = _on_load(load, ground), ("loads", load.name)
        own = 2 if isinstance(load, TorsionSpring) else len(placed) - isinstance(load, Spring)
        if isinstance(load, TorsionSpring) and len(load.corner) > 2:  # about a hinge of both
            placed.append((placed[-1][0], load.corner[1]))
        for link, point in placed[:own]:
            yield f"load {load.name} acts on", link, point, "link:", (*way, "link")
        end = "against" if getattr(load, "against", None) else "to" if isinstance(load, Spring) else "corner"
        for link, point in placed[own:]:
            yield f"the other end of load {load.name} is fixed to", link, point, "against:", (*way, end)
    for index, given in enumerate(motion):
        if given.point:
            yield "the motion is given on", given.link, given.point, "link:", ("motion", index, "link")
    for link, mass in masses.items():
        if mass.centre:
            yield "a mass is given on", link, mass.centre, "", ("links", link, "centre")


def _speeds(expect: tuple[Expected, ...]) -> Iterator[tuple[str, str, str, str, tuple[str | int, ...]]]:
    """The same of published speeds."""
    for one in expect:
        if one.key.startswith("v "):  # its target may not be imported where no case has values
            _, point, on, link = one.key.split()
            yield f"'{one.key}' asks for a speed on", link, point, f"v {point} {on}", ("expect", one.key)


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

    def __init__(self, figure: FigureData, ground: str) -> None:
        self.figure, self.ground = figure, ground
        welds = [joint.links for joint in figure.joints if not joint.freedom]
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
        means = ((name, *at.of) for name, at in figure.points.items() if isinstance(at, Centroid))
        self.dimensioned.update(name for names in means for name in names)
        self.centres = {joint.at for joint in figure.joints if joint.stands_in}
        self.fixed: dict[str, set[str]] = {}

    def instead(self, link: str, point: str) -> tuple[list[str], bool]:
        """The links that have a point, where a link has it not, and whether dimensions say so."""
        own = self.own.get(link, set())
        if point in own or point in self.centres or not is_named(point):
            return [], False
        if point in self._fixed_to(link):
            return [], False
        by_joints = [other for other, points in self.own.items() if point in points]
        if by_joints or point not in self.dimensioned:
            return by_joints, False
        others = [other for other in self.own if point in self._fixed_to(other)]
        posed = others == [self.ground] or not self._has_ends(own)
        if link != self.ground and posed and point in self._closed(own | self._arms(own)):
            return [], True  # an arm's end, or fixed to it: lengths say whose it is, an angle poses the arm
        return others, True

    def _arms(self, own: set[str]) -> set[str]:
        """The ends of the arms of a link: points a length away from one of its own."""
        ends = [{length.a, length.b} for length in self.figure.lengths]
        return {point for pair in ends if len(pair - own) == 1 for point in pair - own}

    def _has_ends(self, own: set[str]) -> bool:
        """Whether two points of a link say how it lies, so that none of its arms need do so."""
        places = (self.figure.points.get(point) for point in own)
        given = [at for at in places if isinstance(at, Coordinates) and None not in (at.x, at.y)]
        return len(given) > 1 or any({length.a, length.b} <= own for length in self.figure.lengths)

    def _fixed_to(self, link: str) -> set[str]:
        """The points of a link, and those that two dimensions each fix to these."""
        if link not in self.fixed:
            self.fixed[link] = self._closed(set(self.own.get(link, ())))
        return self.fixed[link]

    def _closed(self, found: set[str]) -> set[str]:
        while more := set(_tied(self.figure, found)) - found:
            found |= more
        return found


def _on_joints(joints: Iterable[Joint]) -> Iterator[tuple[str, str]]:
    for joint in joints:
        if not joint.stands_in:  # a known centre is no point of its links
            yield from ((link, point) for link in joint.links for point in joint.named)


def _tied(figure: FigureData, known: set[str]) -> Iterator[str]:
    """Points that two lengths or corners, or a mean, fix to points that are known."""
    ties: dict[str, int] = {}
    sets = [{length.a, length.b} for length in figure.lengths]
    sets += [{angle.a, angle.at, angle.b} for angle in figure.angles if isinstance(angle, Corner)]
    for points in sets:
        if len(free := points - known) == 1:
            (point,) = free
            ties[point] = ties.get(point, 0) + 1
    yield from (point for point, count in ties.items() if count > 1)
    for point, value in figure.points.items():
        if isinstance(value, Centroid) and len(free := {point, *value.of} - known) == 1:
            yield from free
