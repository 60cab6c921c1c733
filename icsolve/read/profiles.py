"""Profiles of links: polygons, arcs, circles, radii by angle; flat, roller and knife-edge followers."""

from __future__ import annotations

import math

from icsolve.case import Coordinates, Number
from icsolve.case.profiles import (
    Arc,
    Arcs,
    Circle,
    Direction,
    Flat,
    Follower,
    Knife,
    Line,
    Polygon,
    Profiles,
    Radii,
    Roller,
    Shape,
)
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.keys import ARC, PROFILES
from icsolve.read.names import shown, suggestion
from icsolve.read.reading import Entry, Reading, number
from icsolve.units import UnitError, split_quantity

_FORM = "as in {circle: C, radius: 40} or {roller: R, radius: 5}"
_ARC = "as in {centre: C, from: P, to: Q}"
LEAST = 4
"""Radii that a spline needs."""


def read_profiles(reading: Reading, section: Mapping) -> Profiles:
    """The profiles by link, and the contacts that they make."""
    shapes: dict[str, Shape | Follower] = {}
    for key, node in section.items.items():
        link = reading.link(Scalar(key, False, section.keys[key]), "a link")
        mapping = reading.mapping(node, f"the profile of link {shown(key)}", _FORM)
        if link is None or mapping is None:
            continue
        reading.marks[f"profile.{link}"] = section.keys[key]
        profile = _profile(Entry(reading, mapping, f"profile.{link}", f"the profile of link {link}"), link)
        if profile is not None:
            shapes[link] = profile
    touches = tuple(touch for touch, _ in reading.touches if {*touch.links} <= shapes.keys())
    _check_pairs(reading, shapes)
    used = {link for touch, _ in reading.touches for link in touch.links}
    for link in shapes.keys() - used:
        said = (
            "no contact uses it; a contact whose `at` and `normal` are left out takes them from the profiles"
        )
        reading.refuse(reading.marks[f"profile.{link}"], f"the profile of link {link}: {said}")
    return Profiles(shapes, touches)


def _check_pairs(reading: Reading, shapes: dict[str, Shape | Follower]) -> None:
    """Of the two links of a contact one has a profile, the other is its follower."""
    for touch, mark in reading.touches:
        if not {*touch.links} <= shapes.keys():
            continue
        followers = [isinstance(shapes[link], Flat | Roller | Knife) for link in touch.links]
        if followers[0] == followers[1]:
            a, b = touch.links
            have = "are both followers" if followers[0] else "both have a profile of their own"
            said = (
                "one should be a polygon, arcs, a circle or radii, the other flat, a roller or a knife edge"
            )
            reading.refuse(mark, f"links {a} and {b} {have}: {said}")


def _profile(entry: Entry, link: str) -> Shape | Follower | None:
    kind = entry.one_of(PROFILES)
    if kind is None:
        strange = next((key for key in entry.node.items), "")
        likely = suggestion(strange, PROFILES) if strange else ""
        entry.refuse(entry.node.mark, f"{entry.what} has none of {', '.join(PROFILES)}{likely}")
        return None
    entry.keys = {kind: PROFILES[kind].own, **PROFILES[kind].keys}
    entry.check()
    build = {
        "polygon": _polygon,
        "arcs": _arcs,
        "circle": _circle,
        "radii": _radii,
        "flat": _flat,
        "roller": _roller,
        "knife": _knife,
    }
    return build[kind](entry)


def _place(entry: Entry, node: Node, what: str, hidden: str) -> str | None:
    """A point's name, or that of the hidden point whose coordinates stand in its stead."""
    if type(node) is not Sequence:
        return entry.reading.point(node, what)
    if len(node.items) != 2:
        entry.refuse(node.mark, f"{what} should be a point, or two coordinates [x, y]")
        return None
    x, y = (
        number(entry.reading, item, "length", f"{entry.path}.{hidden}.{axis}")
        for item, axis in zip(node.items, "xy", strict=True)
    )
    if x is None or y is None:
        return None
    name = f"@{entry.path}.{hidden}"
    entry.reading.hidden[name] = Coordinates(x, y)
    entry.reading.marks[f"points.{name}"] = node.mark
    return name


def _own_place(entry: Entry, key: str) -> str | None:
    return _place(entry, entry.node.items[key], f"'{key}' of {entry.what}", key)


def _polygon(entry: Entry) -> Polygon | None:
    node = entry.node.items["polygon"]
    if type(node) is not Sequence or len(node.items) < 3:
        entry.refuse(node.mark, f"{entry.what} should be a list of three or more corners, as in [A, B, C]")
        return None
    found = [_place(entry, item, "a corner", str(n)) for n, item in enumerate(node.items)]
    corners = tuple(corner for corner in found if corner is not None)
    if len(corners) < len(found):
        return None
    for n, corner in enumerate(corners):
        if corner == corners[n - 1]:
            entry.refuse(node.mark, f"{entry.what} names the corner {corner} twice running")
            return None
    return Polygon(corners)


def _circle(entry: Entry) -> Circle | None:
    centre = _own_place(entry, "circle")
    radius = entry.number("radius")
    return Circle(centre, radius) if centre and radius else None


def _roller(entry: Entry) -> Roller | None:
    centre = _own_place(entry, "roller")
    radius = entry.number("radius")
    return Roller(centre, radius) if centre and radius else None


def _knife(entry: Entry) -> Knife | None:
    at = _own_place(entry, "knife")
    return Knife(at) if at else None


def _flat(entry: Entry) -> Flat | None:
    at = _own_place(entry, "flat")
    along = _line(entry, "along")
    return Flat(at, along) if at and along else None


def _line(entry: Entry, key: str) -> Line | None:
    """A direction in degrees, or two points."""
    node = entry.node.items.get(key)
    if type(node) is Sequence:
        return entry.two_points(key, "[D, E]")
    return entry.number(key)


def _arcs(entry: Entry) -> Arcs | None:
    node = entry.node.items["arcs"]
    if type(node) is not Sequence or not node.items:
        entry.refuse(
            node.mark, f"{entry.what} should be a list of arcs, as in [{{centre: C, from: P, to: Q}}]"
        )
        return None
    found = [_arc(entry, item, n) for n, item in enumerate(node.items)]
    arcs = tuple(arc for arc in found if arc is not None)
    return Arcs(arcs) if len(arcs) == len(found) else None


def _arc(entry: Entry, node: Node, n: int) -> Arc | None:
    mapping = entry.reading.mapping(node, "an arc", _ARC)
    if mapping is None:
        return None
    one = Entry(entry.reading, mapping, f"{entry.path}.arcs.{n}", f"arc {n + 1} of {entry.what}", ARC)
    one.check()
    centre = mapping.items.get("centre")
    at = _place(one, centre, f"'centre' of {one.what}", "centre") if centre is not None else None
    radius = one.number("radius")
    start, stop = _end(one, "from"), _end(one, "to")
    turns = one.sense()
    if start is not None and radius is None and not one.has("radius") and isinstance(start, Number):
        one.need("radius")
        return None
    good = at and start is not None and stop is not None and turns
    return Arc(at, radius, start, stop, turns) if good and at and start and stop and turns else None


def _end(entry: Entry, key: str) -> Direction | None:
    """A direction from the centre: degrees, or a point."""
    node = entry.node.items.get(key)
    if node is None or type(node) is not Scalar:
        return _place(entry, node, f"'{key}' of {entry.what}", key) if node is not None else None
    return entry.number(key) if _is_number(node.text) else entry.point(key)


def _is_number(text: str) -> bool:
    try:
        return split_quantity(text.strip()) is not None
    except UnitError:
        return True


def _radii(entry: Entry) -> Radii | None:
    about = entry.node.items.get("about")
    at = _place(entry, about, f"'about' of {entry.what}", "about") if about is not None else None
    zero, turns, table = _line(entry, "zero"), entry.sense(), _table(entry)
    return Radii(at, zero, table, turns) if at and zero is not None and table and turns else None


def _table(entry: Entry) -> tuple[tuple[Number, Number], ...] | None:
    node = entry.node.items["radii"]
    if type(node) is not Mapping:
        entry.refuse(
            node.mark, f"'radii' of {entry.what} should be radii by angle, as in {{0: 20, 30: 21.5}}"
        )
        return None
    table = []
    for key, value in node.items.items():
        path = f"{entry.path}.radii.{key}"
        angle = number(entry.reading, Scalar(key, True, node.keys[key]), "angle", f"{path}.angle")
        radius = entry.value(value, "length", path, "radius", "positive")
        if angle is not None and radius is not None:
            table.append((angle, radius))
    if len(table) < len(node.items):
        return None
    if len(table) < LEAST:
        said = f"has {len(table)} radii; a spline that closes needs {LEAST} at least"
        entry.refuse(node.mark, f"{entry.what} {said}")
        return None
    return tuple(table) if _distinct(entry, table, node) else None


def _distinct(entry: Entry, table: list[tuple[Number, Number]], node: Mapping) -> bool:
    """Angles that are a whole turn apart are one."""
    ordered = sorted((angle.value % 360.0, angle.digits) for angle, _ in table)
    for n, (angle, digits) in enumerate(ordered):
        if abs(math.remainder(angle - ordered[n - 1][0], 360.0)) < 1e-9:
            said = f"has the angle {digits} twice: {ordered[n - 1][1]} is the same direction"
            entry.refuse(node.mark, f"{entry.what} {said}")
            return False
    return True
