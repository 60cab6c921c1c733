"""Motion: the speed of a link or of a point, or the sense in which a link turns."""

from __future__ import annotations

from icsolve.case import Motion, Number
from icsolve.read.document import Mapping, Node, Sequence
from icsolve.read.entry import Entry
from icsolve.read.reading import Reading

KEYS = ("link", "speed", "turns", "point", "angle", "acceleration")
_FORM = "as in {link: 2, speed: 12 rad/s} or {link: 2, turns: cw}"


def read_motion(reading: Reading, section: Node) -> tuple[Motion, ...]:
    """One motion or a list of them."""
    if type(section) is not Sequence:
        single = _motion(reading, section, "motion")
        return (single,) if single is not None else ()
    found = [_motion(reading, node, f"motion.{index}") for index, node in enumerate(section.items)]
    return tuple(motion for motion in found if motion is not None)


def _motion(reading: Reading, node: Node, path: str) -> Motion | None:
    mapping = reading.mapping(node, "motion", _FORM)
    if mapping is None:
        return None
    reading.marks[path] = mapping.mark
    entry = Entry(reading, mapping, path, "motion")
    entry.only(*KEYS)
    link = entry.link("link", "the link that moves")
    return _of_point(entry, link) if entry.has("point") else _of_link(entry, link, mapping)


def _of_link(entry: Entry, link: str | None, mapping: Mapping) -> Motion | None:
    if entry.has("angle"):
        entry.refuse(entry.mark("angle"), "a link's motion has no 'angle'; a point's motion has")
        return None
    if not entry.has("speed") and not entry.has("turns"):
        entry.refuse(mapping.mark, "motion of a link needs 'speed', 'turns: ccw' or 'turns: cw'")
        return None
    speed = entry.number("speed", "angular speed")
    turns = entry.word("turns", ("ccw", "cw"))
    more = _acceleration(entry, "angular acceleration")
    good = (speed is not None) == entry.has("speed") and (turns is not None) == entry.has("turns")
    return Motion(link, speed, turns, acceleration=more) if link and good else None


def _acceleration(entry: Entry, dimension: str) -> Number | None:
    """How fast the speed grows; there has to be one."""
    if entry.has("acceleration") and not entry.has("speed"):
        mark = entry.mark("acceleration")
        entry.refuse(mark, "motion with an 'acceleration' needs a 'speed', 0 where it starts")
    return entry.number("acceleration", dimension)


def _of_point(entry: Entry, link: str | None) -> Motion | None:
    if entry.has("turns"):
        entry.refuse(entry.mark("turns"), "a point's motion has 'speed' and 'angle', not 'turns'")
        return None
    point = entry.point("point")
    entry.need("speed", "the point's speed")
    entry.need("angle", "the direction of its velocity in degrees")
    speed, angle = entry.number("speed", "speed"), entry.number("angle", "angle")
    more = _acceleration(entry, "path acceleration")
    good = link and point and speed is not None and angle is not None
    return Motion(link, speed, None, point, angle, more) if good and link else None
