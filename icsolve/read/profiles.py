"""Profiles of links: polygons, arcs, circles, radii by angle; flat, roller and knife-edge followers."""

from __future__ import annotations

import math
from collections.abc import Callable

from icsolve.case import Number
from icsolve.case.profiles import (
    Arc,
    Arcs,
    Circle,
    Direction,
    Flat,
    Follower,
    Knife,
    Polygon,
    Profiles,
    Radii,
    Roller,
    Shape,
)
from icsolve.numbers.units import UnitError, split_quantity
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.entry import Entry
from icsolve.read.keys import EntryKind, Key, needed, quantity_key
from icsolve.read.names import shown, suggestion
from icsolve.read.reading import Reading, number

_RADIUS = Key("its radius", "quantity", True, "length", "positive")
_OWN = Key("a point, or [x, y] in this position", "place", True)
_FACE = Key("the direction of the face in degrees, or two of its points as in [D, E]", "line", True, "angle")
PROFILES = {
    "polygon": EntryKind(
        "corners joined by straight edges, back to the first",
        Key("three or more corners, as in [A, B, C]", "corners", True),
        {},
    ),
    "arcs": EntryKind(
        "arcs one after the other, joined by straight lines where their ends are apart",
        Key("a list of arcs, as in [{centre: C, from: P, to: Q}]", "arcs", True),
        {},
    ),
    "circle": EntryKind(
        "a circle", _OWN._replace(says="its centre"), {"radius": needed(_RADIUS, "that of the circle")}
    ),
    "radii": EntryKind(
        "radius against angle: a periodic cubic spline",
        Key("radii by angle, as in {0: 20, 30: 21.5}; four or more", "table", True, "length", "positive"),
        {
            "about": Key("the point of the cam from which the radii are measured", "place", True),
            "zero": Key(
                "the direction of the angle 0 in degrees, or two points of the cam as in [A, B]",
                "line",
                True,
                "angle",
            ),
            "turns": Key("the sense in which the angles run, ccw or cw", "sense"),
        },
    ),
    "flat": EntryKind("a flat face", _OWN._replace(says="a point of the face"), {"along": _FACE}),
    "roller": EntryKind(
        "a roller", _OWN._replace(says="its centre"), {"radius": needed(_RADIUS, "that of the roller")}
    ),
    "knife": EntryKind("a knife edge", _OWN._replace(says="where the edge is"), {}),
}
"""Profiles of cams, and of their followers."""
_END = Key("where it ends: a point, or a direction from its centre in degrees", "end", True, "angle")
ARC = {
    "centre": Key("its centre, a point or [x, y]", "place", True),
    "radius": quantity_key("or 'from' as a point of the arc", "length", "positive"),
    "from": needed(_END, "where it begins: a point, or a direction from its centre in degrees"),
    "to": _END,
    "turns": Key("the sense from its beginning to its end, ccw or cw", "sense"),
}
_FORM = "as in {circle: C, radius: 40} or {roller: R, radius: 5}"
_ARC = "as in {centre: C, from: P, to: Q}"
LEAST = 4
"""Radii that a spline needs."""


def read_profiles(reading: Reading, section: Mapping) -> Profiles:
    """The profiles by link, and the contacts that they make."""
    reading.forms.update(FORMS)
    shapes: dict[str, Shape | Follower] = {}
    for key, node in section.items.items():
        link = reading.link(Scalar(key, False, section.keys[key]), "a link")
        mapping = reading.mapping(node, f"the profile of link {shown(key)}", _FORM)
        if link is None or mapping is None:
            continue
        reading.marks[f"profile.{link}"] = section.keys[key]
        profile = _profile(Entry(reading, mapping, f"profile.{link}", f"the profile of link {link}"))
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


def _profile(entry: Entry) -> Shape | Follower | None:
    kind = entry.one_of(PROFILES)
    if kind is None:
        strange = next((key for key in entry.node.items), "")
        likely = suggestion(strange, PROFILES) if strange else ""
        entry.refuse(entry.node.mark, f"{entry.what} has none of {', '.join(PROFILES)}{likely}")
        return None
    entry.keys = {kind: PROFILES[kind].own, **PROFILES[kind].keys}
    values = entry.read()
    return MADE[kind](*values.values()) if entry.whole else None


MADE: dict[str, Callable[..., Shape | Follower]] = {
    "polygon": Polygon,
    "arcs": Arcs,
    "circle": Circle,
    "radii": lambda table, about, zero, turns: Radii(about, zero, table, turns or "ccw"),
    "flat": Flat,
    "roller": Roller,
    "knife": Knife,
}
"""What makes each kind of its values, in the order of the table of keys."""


def _corners(entry: Entry, key: str, node: Node) -> tuple[str | None, ...] | None:
    """The corners of a polygon."""
    if type(node) is not Sequence or len(node.items) < 3:
        entry.refuse(node.mark, f"{entry.what} should be a list of three or more corners, as in [A, B, C]")
        return None
    found = tuple(entry.place(str(n), item, "a corner") for n, item in enumerate(node.items))
    for n, corner in enumerate(found):
        if corner is not None and corner == found[n - 1]:
            entry.refuse(node.mark, f"{entry.what} names the corner {corner} twice running")
            return None
    return found


def _arcs(entry: Entry, key: str, node: Node) -> tuple[Arc | None, ...] | None:
    if type(node) is not Sequence or not node.items:
        said = "should be a list of arcs, as in [{centre: C, from: P, to: Q}]"
        entry.refuse(node.mark, f"{entry.what} {said}")
        return None
    return tuple(_arc(entry, item, n) for n, item in enumerate(node.items))


def _arc(entry: Entry, node: Node, n: int) -> Arc | None:
    mapping = entry.reading.mapping(node, "an arc", _ARC)
    if mapping is None:
        return None
    one = Entry(entry.reading, mapping, f"{entry.path}.arcs.{n}", f"arc {n + 1} of {entry.what}", ARC)
    v = one.read()
    if v["radius"] is None and not one.has("radius") and isinstance(v["from"], Number):
        one.need("radius")
    return Arc(v["centre"], v["radius"], v["from"], v["to"], v["turns"] or "ccw") if one.whole else None


def _end(entry: Entry, key: str, node: Node) -> Direction | None:
    """A direction from the centre: degrees, or a point."""
    if type(node) is Scalar and _is_number(node.text):
        return entry.number(key)
    return entry.place(key, node)


def _is_number(text: str) -> bool:
    try:
        return split_quantity(text.strip()) is not None
    except UnitError:
        return True


def _table(entry: Entry, key: str, node: Node) -> tuple[tuple[Number, Number], ...] | None:
    """Radii by angle."""
    if type(node) is not Mapping:
        entry.refuse_value(node, key, "radii by angle, as in {0: 20, 30: 21.5}")
        return None
    table = []
    for at, value in node.items.items():
        path = f"{entry.path}.radii.{at}"
        angle = number(entry.reading, Scalar(at, True, node.keys[at]), "angle", f"{path}.angle")
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


FORMS = {"corners": _corners, "arcs": _arcs, "table": _table, "end": _end}
"""What reads the forms that only profiles have."""


def _distinct(entry: Entry, table: list[tuple[Number, Number]], node: Mapping) -> bool:
    """Angles that are a whole turn apart are one."""
    ordered = sorted((angle.value % 360.0, angle.digits) for angle, _ in table)
    for n, (angle, digits) in enumerate(ordered):
        if abs(math.remainder(angle - ordered[n - 1][0], 360.0)) < 1e-9:
            said = f"has the angle {digits} twice: {ordered[n - 1][1]} is the same direction"
            entry.refuse(node.mark, f"{entry.what} {said}")
            return False
    return True
