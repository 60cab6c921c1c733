"""Loads of the plane, each known, unknown or like another; power at a speed; the given motion."""

from __future__ import annotations

from collections.abc import Iterator

from icsolve.case import (
    Area,
    Force,
    ForceVector,
    Heading,
    Load,
    Magnitude,
    Motion,
    Number,
    Slope,
    Spring,
    Stretch,
    Torque,
    TorsionSpring,
    Toward,
    Weight,
)
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.keys import DIRECTION, LOADS, MOTION
from icsolve.read.load_forms import Forms, Likes, bearer, magnitude, read_section, torque_number, word_at
from icsolve.read.names import point_key, shown
from icsolve.read.reading import Entry, Reading
from icsolve.units import exact_ratio, times

_ELSEWHERE = {
    "along": "that is for a case in space, whose points have three coordinates; here it is `angle`, "
    "`toward`, `away` or `slope`"
}


def read_loads(reading: Reading, section: Mapping) -> tuple[Load, ...]:
    """The loads of a planar case that could be read."""
    return read_section(reading, section, PLANE)


def _force(entry: Entry, name: str, kind: str, likes: Likes) -> Load | list[Load] | None:
    if not entry.has("link") and word_at(entry, "at") in entry.reading.ends:
        from icsolve.read.ropes import read_pull

        return read_pull(entry, name, kind, likes)
    link, against, good = bearer(entry)
    at, turns_with = entry.place("at", f"@{name}"), entry.link("turns_with")
    node = entry.node.items["force"]
    if type(node) is Sequence:
        open_ones = [type(one) is Scalar and one.text == "unknown" for one in node.items]
        if any(open_ones):
            pair = _directed(entry, name, node, all(open_ones))
            whole = pair and good and link and at
            return [Force(n, link, at, None, h, against) for n, h in pair] if whole and link and at else None
        parts = _components(entry)
        if parts is None or not (good and link and at):
            return None
        return ForceVector(name, link, at, *parts, against, turns_with)
    heading = _heading(entry)
    read, value = magnitude(entry, name, kind, likes)
    if not (good and read and link and at and heading):
        return None
    return Force(name, link, at, value, heading, against, turns_with)


def _directed(entry: Entry, name: str, node: Sequence, both: bool) -> list[tuple[str, Number]]:
    """Names and directions of the two components of a force of unknown direction."""
    entry.reading.marks[entry.path] = node.mark
    if not both or len(node.items) != 2:
        said = "along a known line it is `force: unknown` with its direction, else [unknown, unknown]"
        entry.refuse(node.mark, f"'force' of {entry.what}: {said}")
        return []
    heading = entry.one_of(DIRECTION)
    if heading is not None:
        entry.refuse(entry.mark(heading), f"{entry.what} is given by components, so it takes no '{heading}'")
        return []
    entry.reading.directed.append(name)
    return [
        (f"{name}.{axis}", Number(degrees, 0.0, f"{entry.path}.{axis}.angle", f"{degrees:.0f}"))
        for axis, degrees in (("x", 0.0), ("y", 90.0))
    ]


def _pressure(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    at, turns_with, heading = entry.place("at", f"@{name}"), entry.link("turns_with"), _heading(entry)
    area = _area(entry)
    read, value = magnitude(entry, name, kind, likes)
    if not (good and read and link and at and heading and area):
        return None
    return Force(name, link, at, value, heading, against, turns_with, area)


def _area(entry: Entry) -> Area | None:
    """The area under a pressure."""
    key = entry.one_of(("bore", "area"))
    if key is None:
        said = "needs its area: 'bore', the cylinder's diameter, or 'area'"
        entry.refuse(entry.node.mark, f"{entry.what} {said}")
        return None
    if entry.has("rod") and key == "area":
        entry.refuse(entry.mark("rod"), f"'rod' of {entry.what} goes with a 'bore'; an area is the whole one")
        return None
    area, bore, rod = entry.number("area"), entry.number("bore"), entry.number("rod")
    if bore and rod and rod.value >= bore.value:
        entry.refuse(entry.mark("rod"), f"the rod of {entry.what} should be thinner than its bore")
        return None
    if (area is None and bore is None) or (rod is None and entry.has("rod")):
        return None
    targets = entry.reading.targets
    per = times(targets["force"], targets["area"], -1)
    exact = exact_ratio(targets["pressure"], per)
    if bore is not None:
        exact = (exact[0], 4 * exact[1], exact[2] + 1)
    return Area(exact, area, bore, rod)


def _distributed(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    a, b, turns_with = entry.point("from"), entry.point("to"), entry.link("turns_with")
    heading = _heading(entry)
    if a is not None and a == b:
        entry.refuse(entry.mark("to"), f"{entry.what} begins and ends at {a}")
        return None
    ends: tuple[Number, Number] | None = None
    value: Magnitude = None
    if type(entry.node.items["distributed"]) is Sequence:
        ends = entry.pair("distributed", "01")
        read, value = ends is not None, ends[0] if ends else None
        for n in "01":
            entry.reading.marks[f"{entry.path}.{n}"] = entry.reading.marks.get(
                f"{entry.path}.{kind}.{n}", (1, 1)
            )
    else:
        read, value = magnitude(entry, name, kind, likes)
    if not (good and read and link and a and b and heading):
        return None
    over = Stretch(a, b)
    if ends is not None:
        first, last = (end._replace(path=f"{entry.path}.{n}") for n, end in enumerate(ends))
        steep = abs(last.value) > abs(first.value)  # per unit of the larger, which is not zero
        value, over = (last, Stretch(b, a, first)) if steep else (first, Stretch(a, b, last))
    entry.reading.middles[f"@{name}"] = (a, b)
    return Force(name, link, f"@{name}", value, heading, against, turns_with, over)


def _torsion(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    corner, free = _corner(entry), entry.number("free")
    if corner and len(corner) == 2 and against is not None:
        said = "two points give the angle to the frame; to another link it has three, as in ABC"
        entry.refuse(entry.mark("against"), f"'corner' of {entry.what}: {said}")
        return None
    read, value = magnitude(entry, name, kind, likes)
    if not (good and read and link and corner and free):
        return None
    return TorsionSpring(name, link, corner, value, free, against)


def _corner(entry: Entry) -> tuple[str, ...] | None:
    """The two or three points of an angle."""
    node = entry.node.items.get("corner")
    if node is None:
        return None
    text = node.text if type(node) is Scalar else ""
    reading = entry.reading
    names = point_key(text, (2, 3), reading.given | reading.used.keys())
    if isinstance(names, str):
        entry.refuse(node.mark, f"'corner' of {entry.what}: {names}")
        return None
    for point in names:
        reading.used.setdefault(point, node.mark)
    return names


def _components(entry: Entry) -> tuple[Number, Number] | None:
    """A force by its components, at paths ``loads.P.x``; it takes no direction."""
    heading = entry.one_of(DIRECTION)
    if heading is not None:
        entry.refuse(entry.mark(heading), f"{entry.what} is given by components, so it takes no '{heading}'")
    parts = entry.pair("force", "xy")
    if parts is None:
        return None
    for axis in "xy":
        entry.reading.marks[f"{entry.path}.{axis}"] = entry.reading.marks.pop(f"{entry.path}.force.{axis}")
    x, y = (part._replace(path=f"{entry.path}.{axis}") for part, axis in zip(parts, "xy", strict=True))
    return x, y


def _heading(entry: Entry) -> Heading | None:
    key = entry.one_of(DIRECTION)
    if key is None:
        *first, last = DIRECTION
        entry.refuse(entry.node.mark, f"{entry.what} needs its direction: {', '.join(first)} or {last}")
    if key == "angle":
        return entry.number(key)
    if key == "slope":
        return _slope(entry)
    point = entry.point(key) if key else None
    if point is not None and point == word_at(entry, "at"):
        entry.refuse(entry.mark(key or ""), f"{entry.what} acts at {point} and cannot point {key} it")
        return None
    return Toward(point, key == "away") if point else None


def _slope(entry: Entry) -> Slope | None:
    pair = entry.pair("slope", "xy")
    if pair and pair[0].value == 0.0 and pair[1].value == 0.0:
        entry.refuse(entry.mark("slope"), f"the slope [0, 0] of {entry.what} has no direction")
        return None
    return Slope(*pair) if pair else None


def _torque(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    if entry.has("screw"):
        return _turning(entry, name, kind, likes)
    link, against, good = bearer(entry)
    turns = entry.sense()
    read, value = magnitude(entry, name, kind, likes)
    return Torque(name, link, value, turns, against) if good and read and link and turns else None


def _weight(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    if not entry.has("link") and word_at(entry, "at") in entry.reading.ends:
        from icsolve.read.ropes import read_pull

        return read_pull(entry, name, kind, likes)
    link, at = entry.link("link"), entry.place("at", f"@{name}")
    read, value = magnitude(entry, name, kind, likes)
    return Weight(name, link, at, value, kind == "mass") if read and link and at else None


def _spring(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    at, to = entry.place("at", f"@{name}"), entry.place("to", f"@{name}'")
    free = entry.number("free")
    read, value = magnitude(entry, name, kind, likes)
    if at is not None and at == to:
        entry.refuse(entry.mark("to"), f"both ends of {entry.what} are at {at}")
        return None
    if not (good and read and link and at and to and free):
        return None
    return Spring(name, link, at, to, value, free, against)


def _power(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    turns, value = entry.sense(), torque_number(entry)
    return Torque(name, link, value, turns, against) if value and good and link and turns else None


PLANE: Forms[Load] = Forms(
    LOADS,
    {
        "force": _force,
        "torque": _torque,
        "weight": _weight,
        "mass": _weight,
        "spring": _spring,
        "torsion spring": _torsion,
        "pressure": _pressure,
        "distributed": _distributed,
        "power": _power,
    },
    "as in {force: 100, link: 4, at: E, angle: 180}",
    _ELSEWHERE,
)
"""Loads of the plane."""


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
    entry = Entry(reading, mapping, path, "motion", MOTION)
    entry.check()
    link = entry.link("link")
    return _of_point(entry, link) if entry.has("point") else _of_link(entry, link, mapping)


def _of_link(entry: Entry, link: str | None, mapping: Mapping) -> Motion | None:
    if entry.has("angle"):
        entry.refuse(entry.mark("angle"), "a link's motion has no 'angle'; a point's motion has")
        return None
    if not entry.has("speed") and not entry.has("turns"):
        entry.refuse(mapping.mark, "motion of a link needs 'speed', 'turns: ccw' or 'turns: cw'")
        return None
    speed = entry.number("speed")
    turns = entry.word("turns", ("ccw", "cw"))
    more = _acceleration(entry)
    good = (speed is not None) == entry.has("speed") and (turns is not None) == entry.has("turns")
    return Motion(link, speed, turns, acceleration=more) if link and good else None


def _acceleration(entry: Entry, dimension: str = "") -> Number | None:
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
    entry.need("speed")
    entry.need("angle")
    speed, angle = entry.number("speed", "speed"), entry.number("angle")
    more = _acceleration(entry, "path acceleration")
    good = link and point and speed is not None and angle is not None
    return Motion(link, speed, None, point, angle, more) if good and link else None


def driven(loads: Node | None) -> set[frozenset[str]]:
    """The pairs of links whose screws torques turn."""
    return {frozenset(pair) for pair in _pairs(loads)}


def _pairs(loads: Node | None) -> Iterator[tuple[str, str]]:
    for node in loads.items.values() if type(loads) is Mapping else ():
        if type(node) is Mapping and "torque" in node.items and "screw" in node.items:
            pair = _pair(node.items["screw"])
            if pair is not None:
                yield pair


def _pair(node: Node) -> tuple[str, str] | None:
    """Two links: ``2-3``, or ``23`` where each is one character."""
    text = node.text.strip() if type(node) is Scalar else ""
    parts = [part.strip() for part in text.split("-")] if "-" in text else list(text)
    return (parts[0], parts[1]) if len(parts) == 2 and all(parts) else None


def _turning(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    """A torque that turns a screw: positive where it drives the second link along the axis."""
    node = entry.node.items["screw"]
    pair = _pair(node)
    for key in ("link", "against", "turns"):
        if entry.has(key):
            said = f"{entry.what} turns a screw and has no '{key}': it is positive clockwise as one looks"
            entry.refuse(entry.mark(key), f"{said} along the axis")
            return None
    screw = next((s for s in entry.reading.screws if pair and {*s.links} == {*pair}), None)
    if screw is None:
        what = shown(node.text) if type(node) is Scalar else "that"
        said = f"{entry.what} should turn a screw by its two links, as in 2-3, and no screw joins {what}"
        entry.refuse(node.mark, said)
        return None
    read, value = magnitude(entry, name, kind, likes)
    return Torque(name, screw.rotor, value) if read else None
