"""A case in space: its points have three coordinates, and its joints and loads are those of space."""

from __future__ import annotations

import math

from icsolve.case import Case, Centroid, Number, Spring, Toward, Weight
from icsolve.case.expected import Expected
from icsolve.case.space import (
    Along,
    Axis,
    FromTo,
    GearPair,
    Heading,
    Hinge,
    Joint,
    Load,
    Radial,
    RigidJoint,
    Space,
    SpatialForce,
    SpatialForceVector,
    SpatialPoint,
    SpatialTorque,
    SphericalJoint,
    Thrust,
    TorqueVector,
    Vector,
)
from icsolve.read.build import TEXTS, ground_of, readable, section_of, tolerance_of_case
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.expect import read_expect
from icsolve.read.figure import centroid_of
from icsolve.read.joints import Builder, Builders, mention_links, read_list, whole_teeth
from icsolve.read.keys import GRAVITY, SECTIONS, SPACE_DIRECTION, SPACE_JOINTS, SPACE_LOADS
from icsolve.read.load_forms import Forms, Likes, bearer, magnitude, read_section, torque_number, word_at
from icsolve.read.names import Problems, shown, suggestion
from icsolve.read.reading import Entry, Measures, Reading, number
from icsolve.read.teeth import read_teeth

WORDS = ("x", "y", "z", "-x", "-y", "-z")
_FORM = "x, y, z, -z, components such as [0, 3, 4], or two points [A, B]"


class SpaceReading(Reading):
    """The state of reading a case in space; ``places`` are the points that a load gives by coordinates."""

    axes = "xyz"
    couples = "xyz"
    places: dict[str, SpatialPoint]


def components(entry: Entry, key: str, dimension: str, meaning: str) -> tuple[Number, Number, Number] | None:
    """A list of three numbers, at paths ``key.x``, ``key.y``, ``key.z``."""
    node = entry.node.items.get(key)
    if type(node) is not Sequence or len(node.items) != 3:
        mark = node.mark if node is not None else entry.node.mark
        entry.refuse(mark, f"'{key}' of {entry.what} should be {meaning}")
        return None
    x, y, z = (
        number(entry.reading, item, dimension, f"{entry.path}.{key}.{axis}")
        for item, axis in zip(node.items, "xyz", strict=True)
    )
    return (x, y, z) if x is not None and y is not None and z is not None else None


def axis(entry: Entry, key: str) -> Axis | None:
    """A direction: a coordinate axis, components, or two points."""
    node = entry.node.items.get(key)
    if node is None:
        return None
    if type(node) is Sequence and len(node.items) == 2:
        return _line(entry, key, node)
    if type(node) is Sequence:
        parts = components(entry, key, "number", _FORM)
        if parts is not None and not any(part.value for part in parts):
            entry.refuse(node.mark, f"'{key}' of {entry.what} has no direction: its components are all 0")
            return None
        return Vector(*parts) if parts is not None else None
    text = node.text.lower().removeprefix("+") if type(node) is Scalar else ""
    if text in WORDS:
        return Along(text)
    entry.refuse(node.mark, f"'{key}' of {entry.what} should be {_FORM}")
    return None


def _line(entry: Entry, key: str, node: Sequence) -> FromTo | None:
    items = entry.reading.names(node, f"'{key}' of {entry.what}", "[A, B]")
    if items is None:
        return None
    for item in items:
        entry.reading.used.setdefault(item.text, item.mark)
    if items[0].text == items[1].text:
        entry.refuse(node.mark, f"'{key}' of {entry.what} should be two different points")
        return None
    return FromTo(items[0].text, items[1].text)


def place(entry: Entry, key: str, hidden: str) -> str | None:
    """A point's name, or that of the hidden point whose coordinates stand in its stead."""
    node = entry.node.items.get(key)
    if type(node) is not Sequence:
        return entry.point(key)
    parts = components(entry, key, "length", "a point, or three coordinates [x, y, z]")
    if parts is None:
        return None
    assert isinstance(entry.reading, SpaceReading)
    entry.reading.places[hidden] = SpatialPoint(*parts)
    entry.reading.marks[f"points.{hidden}"] = node.mark
    return hidden


def _at_point(kind: type[SphericalJoint] | type[RigidJoint]) -> Builder[Joint]:
    def build(entry: Entry, links: tuple[str, ...], complete: bool) -> Joint | None:
        at = entry.point("at")
        return kind((links[0], links[1]), at) if at and complete else None

    return build


def _on_axis(kind: type[Radial] | type[Thrust] | type[Hinge]) -> Builder[Joint]:
    def build(entry: Entry, links: tuple[str, ...], complete: bool) -> Joint | None:
        at, along = entry.point("at"), axis(entry, "axis")
        return kind((links[0], links[1]), at, along) if at and along and complete else None

    return build


def _gears(entry: Entry, links: tuple[str, ...], complete: bool) -> Joint | None:
    along, counts = axis(entry, "axis"), _counts(entry)
    alone = counts is not None and len(counts) == 1
    centres = _centres(entry, 1 if alone else 2)
    teeth = read_teeth(entry, alone)
    toward = _toward(entry, alone, counts is not None)
    if not (along and counts and centres and teeth and complete) or (alone and toward is None):
        return None
    if not whole_teeth(entry, counts):
        return None
    if len(counts) == 1 and counts[0].value < 0.0:
        entry.refuse(entry.mark("teeth"), "a gear whose mate is not shown has external teeth")
        return None
    return GearPair((links[0], links[1]), centres, counts, along, teeth, toward)


def _counts(entry: Entry) -> tuple[Number, ...] | None:
    """One number of teeth, or those of both gears."""
    if type(entry.node.items.get("teeth")) is Sequence:
        return entry.pair("teeth", "01")
    count = entry.number("teeth")
    return (count,) if count is not None else None


def _centres(entry: Entry, count: int) -> tuple[str, ...] | None:
    """The centres of the wheels: one point, or two."""
    node = entry.node.items.get("at")
    if node is None:
        return None
    if type(node) is not Sequence:
        centre = entry.point("at")
        if count == 2:
            said = f"'at' of {entry.what} should be the centres of both wheels, as in [G, H]"
            entry.refuse(node.mark, said)
        return (centre,) if centre and count == 1 else None
    items = entry.reading.names(node, f"'at' of {entry.what}", "[G, H]")
    if items is None:
        return None
    for item in items:
        entry.reading.used.setdefault(item.text, item.mark)
    names = tuple(item.text for item in items)
    if len(names) != count or len(set(names)) < count:
        wanted = "one point" if count == 1 else "two different points"
        entry.refuse(node.mark, f"'at' of {entry.what} should be {wanted}: the teeth are those of {count}")
        return None
    return names


def _toward(entry: Entry, alone: bool, counted: bool) -> Axis | Toward | None:
    """Where the mate of a single gear lies."""
    if not alone:
        if entry.has("toward") and counted:
            said = "is for one gear whose mate is not shown; here both centres stand under 'at'"
            entry.refuse(entry.mark("toward"), f"'toward' of {entry.what} {said}")
        return None
    node = entry.need("toward")
    if type(node) is Scalar and node.text not in WORDS:
        point = entry.point("toward")
        return Toward(point) if point else None
    return axis(entry, "toward")


BUILDERS: Builders[Joint] = {
    "ball": _at_point(SphericalJoint),
    "radial": _on_axis(Radial),
    "thrust": _on_axis(Thrust),
    "hinge": _on_axis(Hinge),
    "weld": _at_point(RigidJoint),
    "gears": _gears,
}


_PLANAR = "that is for the plane; in space it is `along: z`, `along: [0, 3, 4]` or `along: [A, B]`"
_ELSEWHERE = {
    "angle": _PLANAR,
    "slope": _PLANAR,
    "turns": "in space a torque is positive about its axis `along:` by the right-hand rule",
    "turns_with": "a case in space is not moved",
}


def read_space_loads(reading: Reading, section: Mapping) -> tuple[Load, ...]:
    """The loads of a case in space that could be read."""
    return read_section(reading, section, SPACE)


def _force(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    at = place(entry, "at", f"@{name}")
    if type(entry.node.items["force"]) is Sequence:
        parts = _components(entry, "force")
        return SpatialForceVector(name, link, at, parts, against) if good and link and at and parts else None
    heading = _heading(entry)
    read, value = magnitude(entry, name, kind, likes)
    return (
        SpatialForce(name, link, at, value, heading, against)
        if good and read and link and at and heading
        else None
    )


def _components(entry: Entry, kind: str) -> tuple[Number, Number, Number] | None:
    """A load by its components, at paths ``loads.P.x``; it takes no direction."""
    for heading in SPACE_DIRECTION:
        if entry.has(heading):
            said = f"{entry.what} is given by components, so it takes no '{heading}'"
            entry.refuse(entry.mark(heading), said)
    parts = components(entry, kind, entry.keys[kind].dimension, entry.keys[kind].says)
    if parts is None:
        return None
    marks = entry.reading.marks
    for letter in "xyz":
        marks[f"{entry.path}.{letter}"] = marks.pop(f"{entry.path}.{kind}.{letter}")
    x, y, z = (part._replace(path=f"{entry.path}.{n}") for part, n in zip(parts, "xyz", strict=True))
    return x, y, z


def _heading(entry: Entry) -> Heading | None:
    key = entry.one_of(SPACE_DIRECTION)
    if key is None:
        if not _ELSEWHERE.keys() & entry.node.keys.keys():  # a direction of the plane has its own message
            entry.refuse(entry.node.mark, f"{entry.what} needs its direction: {', '.join(SPACE_DIRECTION)}")
        return None
    if key == "along":
        return axis(entry, "along")
    point = entry.point(key)
    if point is not None and point == word_at(entry, "at"):
        entry.refuse(entry.mark(key), f"{entry.what} acts at {point} and cannot point {key} it")
        return None
    return Toward(point, key == "away") if point else None


def _torque(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    if type(entry.node.items["torque"]) is Sequence:
        parts = _components(entry, "torque")
        return TorqueVector(name, link, parts, against) if good and link and parts else None
    entry.need("along")
    heading = axis(entry, "along")
    read, value = magnitude(entry, name, kind, likes)
    return SpatialTorque(name, link, value, heading, against) if good and read and link and heading else None


def _power(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    heading = axis(entry, "along")
    value = torque_number(entry)
    return SpatialTorque(name, link, value, heading, against) if good and value and link and heading else None


def _weight(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, at = entry.link("link"), place(entry, "at", f"@{name}")
    read, value = magnitude(entry, name, kind, likes)
    return Weight(name, link, at, value, kind == "mass") if read and link and at else None


def _spring(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    at, to = place(entry, "at", f"@{name}"), place(entry, "to", f"@{name}'")
    free = entry.number("free")
    read, value = magnitude(entry, name, kind, likes)
    if at is not None and at == to:
        entry.refuse(entry.mark("to"), f"both ends of {entry.what} are at {at}")
        return None
    if not (good and read and link and at and to and free):
        return None
    return Spring(name, link, at, to, value, free, against)


SPACE: Forms[Load] = Forms(
    SPACE_LOADS,
    {
        "force": _force,
        "torque": _torque,
        "weight": _weight,
        "mass": _weight,
        "spring": _spring,
        "power": _power,
    },
    "as in {force: 100, link: 2, at: E, along: -z}",
    _ELSEWHERE,
)
"""Loads of space."""


PLANAR = {
    "lengths": "points are given by their three coordinates",
    "angles": "points are given by their three coordinates",
    "near": "points are given by their three coordinates",
    "links": "points belong to a link by its joints and loads",
    "motion": "a case in space is solved at rest; power as a load takes its own `speed`",
}
"""Sections that a case in space has no use for, and why."""

_FORMS = {
    "points": "as in {A: [0, 0, 0]}",
    "loads": "as in {P: {force: 100, link: 2, at: E, along: -z}}",
    "expect": "as in {F12z: 250}",
}


def build_space(root: Mapping, problems: Problems, name: str, measures: Measures) -> Case:
    """The case of a tree; whether it may be used, the problems tell."""
    units, targets, shown_units = measures
    reading = SpaceReading(problems, targets, shown_units)
    reading.places = {}
    reading.marks.update(root.keys)
    _check_sections(reading, root)
    mention_links(reading, root.items.get("joints"))
    ground = ground_of(reading, root)
    gravity, down = _gravity(reading, root)
    joints = _joints(reading, root)
    loads = read_space_loads(reading, section_of(reading, root, "loads", _FORMS["loads"]))
    points = _points(reading, section_of(reading, root, "points", _FORMS["points"]))
    if readable(root, "points"):
        _check_given(reading)
    space = Space({**points, **reading.places}, joints, loads, down)
    texts = {key: reading.text(root.items[key], key) for key in TEXTS if key in root.items}
    return Case(
        name=name,
        path=problems.path,
        title=texts.get("title", ""),
        source=texts.get("source", ""),
        reconstructed=texts.get("reconstructed", ""),
        units=units,
        ground=ground,
        links=tuple(reading.links or ()),
        expect=_expect(reading, root),
        gravity=gravity or Case.gravity,
        tolerance=tolerance_of_case(reading, root),
        space=space,
        marks=reading.marks,
    )


def _check_sections(reading: SpaceReading, root: Mapping) -> None:
    for key, mark in root.keys.items():
        if key in PLANAR:
            said = f"'{key}' has no place in a case in space, whose points have three coordinates"
            reading.refuse(mark, f"{said}: {PLANAR[key]}")
        elif key not in SECTIONS:
            reading.unknown_key(key, mark, SECTIONS, "a case")


def _joints(reading: SpaceReading, root: Mapping) -> tuple[Joint, ...]:
    node = root.items.get("joints")
    if type(node) is Sequence and node.items:
        return read_list(reading, node, SPACE_JOINTS, BUILDERS, "{hinge: [1, 2], at: A, axis: z}")
    mark = root.keys.get("joints", root.mark)
    reading.refuse(mark, "the case has no joints; list them, as in joints: [{ball: [1, 2], at: A}]")
    return ()


def _points(reading: SpaceReading, section: Mapping) -> dict[str, SpatialPoint | Centroid]:
    """Coordinates and centroids by point."""
    found: dict[str, SpatialPoint | Centroid] = {}
    for key, node in section.items.items():
        name = reading.name(Scalar(key, False, section.keys[key]), "a point")
        if name is None:
            continue
        reading.given.add(name)
        reading.marks[f"points.{name}"] = section.keys[key]
        value = (
            centroid_of(reading, name, node) if type(node) is Mapping else _coordinates(reading, name, node)
        )
        if value is not None:
            found[name] = value
    return found


def _coordinates(reading: SpaceReading, name: str, node: Node) -> SpatialPoint | None:
    if type(node) is not Sequence or len(node.items) != 3:
        said = "in space every point has three coordinates, as in [3, 0.5, 0]"
        reading.refuse(node.mark, f"point {name}: {said}")
        return None
    x, y, z = (
        number(reading, item, "length", f"points.{name}.{letter}")
        for item, letter in zip(node.items, "xyz", strict=True)
    )
    return SpatialPoint(x, y, z) if x is not None and y is not None and z is not None else None


def _check_given(reading: SpaceReading) -> None:
    """Every point that is needed must have its coordinates."""
    for name, mark in reading.used.items():
        if name not in reading.given and not name.startswith("@"):
            likely = suggestion(name, sorted(reading.given)) if len(name) > 1 else ""
            reading.refuse(mark, f"point {name} is named here, but 'points' does not give it{likely}")


def _gravity(reading: SpaceReading, root: Mapping) -> tuple[Number | None, Axis]:
    """Size of gravity in m/s^2, None where it is the usual one, and where it pulls to."""
    node, down = root.items.get("gravity"), Along("-z")
    if node is None:
        return None, down
    if type(node) is Sequence:
        return _gravity_vector(reading, root, node)
    if type(node) is not Mapping:
        return _size(reading, node), down
    entry = Entry(reading, node, "gravity", "gravity", GRAVITY)
    entry.check()
    size = _size(reading, node.items["size"]) if entry.has("size") else None
    return size, axis(entry, "along") or down


def _size(reading: SpaceReading, node: Node) -> Number | None:
    value = number(reading, node, "acceleration", "gravity")
    if value is not None and value.value < 0.0:
        reading.refuse(
            node.mark, "gravity is given by its size, along -z, or by three components; not negative"
        )
    return value


def _gravity_vector(reading: SpaceReading, root: Mapping, node: Sequence) -> tuple[Number | None, Axis]:
    entry = Entry(reading, root, "", "gravity")
    meaning = "a size, three components as in [0, 0, -9.81], or {along: -y}"
    parts = components(entry, "gravity", "acceleration", meaning)
    if parts is None:
        return None, Along("-z")
    value = math.hypot(*(part.value for part in parts))
    if value == 0.0:
        reading.refuse(node.mark, f"gravity of nothing has no direction; write {meaning}")
        return None, Along("-z")
    digits = shown(" ".join(part.digits for part in parts))
    return Number(value, max(part.half for part in parts), "gravity", digits), Vector(*parts)


def _expect(reading: SpaceReading, root: Mapping) -> tuple[Expected, ...]:
    published = section_of(reading, root, "expect", _FORMS["expect"])
    named = reading.given | set(reading.used)
    return read_expect(reading, published, named) if readable(root, "loads") else ()
