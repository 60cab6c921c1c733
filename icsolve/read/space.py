"""A case in space: its points have three coordinates, and its joints and loads are those of space."""

from __future__ import annotations

import math

from icsolve.case import Case, Number, Pair, Toward, Units, is_named
from icsolve.case.space import (
    Along,
    Axis,
    FromTo,
    GearPair,
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
from icsolve.numbers.balls import PRECISIONS, Balls
from icsolve.read.build import ground_of, joint_list, readable, section_of, told_of_itself
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.entry import Entry, Values
from icsolve.read.expect import read_expect
from icsolve.read.figure import read_points
from icsolve.read.joints import Builders, mention_links, read_list, read_teeth
from icsolve.read.keys import GRAVITY, SECTIONS, SPACE_JOINTS, SPACE_LOADS
from icsolve.read.loads import Forms, heading, read_section, spring, weight
from icsolve.read.names import Problems, suggestion
from icsolve.read.reading import Reading, number

WORDS = ("x", "y", "z", "-x", "-y", "-z")
_FORM = "x, y, z, -z, components such as [0, 3, 4], or two points [A, B]"


class SpaceReading(Reading):
    """The state of reading a case in space."""

    axes = "xyz"
    couples = "xyz"
    coordinates = SpatialPoint

    def __init__(self, problems: Problems, units: Units) -> None:
        super().__init__(problems, units)
        self.forms = {"axis": axis, "axis or point": _axis_or_point, "centres": _centres}


def axis(entry: Entry, key: str, node: Node) -> Axis | None:
    """A direction: a coordinate axis, components, or two points."""
    if type(node) is Sequence and len(node.items) == 2:
        names = entry.points(key, node, "[A, B]")
        if names and names[0] == names[1]:
            entry.refuse_value(node, key, "two different points")
            return None
        return FromTo(*names) if names else None
    if type(node) is Sequence:
        parts = entry.numbers(key, node, "xyz", "", "number", _FORM)
        if parts is not None and not any(part.value for part in parts):
            entry.refuse(node.mark, f"'{key}' of {entry.what} has no direction: its components are all 0")
            return None
        return Vector(*parts) if parts is not None else None
    text = node.text.lower().removeprefix("+") if type(node) is Scalar else ""
    if text in WORDS:
        return Along(text)
    entry.refuse_value(node, key, _FORM)
    return None


def _axis_or_point(entry: Entry, key: str, node: Node) -> Axis | Toward | None:
    """A direction, or a point that lies in it."""
    if type(node) is Scalar and node.text not in WORDS:
        point = entry.point(key)
        return Toward(point) if point else None
    return axis(entry, key, node)


def _centres(entry: Entry, key: str, node: Node) -> tuple[str, ...] | None:
    """The centres of the wheels: one point, or two different ones."""
    if type(node) is not Sequence:
        centre = entry.point(key)
        return (centre,) if centre else None
    return entry.points(key, node, "[G, H]")


def _gears(entry: Entry, links: Pair, v: Values) -> Joint | None:
    counts, centres = v["teeth"], v["at"]
    alone = len(counts) == 1
    if len(centres) != len(counts) or len(set(centres)) < len(centres):
        wanted = "one point" if alone else "two different points, the centres of both wheels, as in [G, H]"
        said = f"should be {wanted}: the teeth are those of {len(counts)}"
        entry.refuse(entry.node.items["at"].mark, f"'at' of {entry.what} {said}")
    if alone:
        entry.need("toward")
    elif v["toward"]:
        said = "is for one gear whose mate is not shown; here both centres stand under 'at'"
        entry.refuse(entry.mark("toward"), f"'toward' of {entry.what} {said}")
    teeth = read_teeth(entry, v, alone)
    return GearPair(links, centres, counts, v["axis"], teeth, v["toward"]) if teeth else None


BUILDERS: Builders[Joint] = {
    "ball": lambda _, links, v: SphericalJoint(links, v["at"]),
    "radial": lambda _, links, v: Radial(links, v["at"], v["axis"]),
    "thrust": lambda _, links, v: Thrust(links, v["at"], v["axis"]),
    "hinge": lambda _, links, v: Hinge(links, v["at"], v["axis"]),
    "weld": lambda _, links, v: RigidJoint(links, v["at"]),
    "gears": _gears,
}


_PLANAR = "that is for the plane; in space it is `along: z`, `along: [0, 3, 4]` or `along: [A, B]`"
_ELSEWHERE = {
    "angle": _PLANAR,
    "slope": _PLANAR,
    "turns": "in space a torque is positive about its axis `along:` by the right-hand rule",
    "turns_with": "a case in space is not moved",
}


def _force(entry: Entry, name: str, v: Values) -> Load | None:
    value, link, at, against = v["force"], v["link"], v["at"], v["against"]
    if type(value) is tuple:
        return SpatialForceVector(name, link, at, value, against)
    way = heading(entry, v)
    return SpatialForce(name, link, at, value, way, against) if way is not None else None


def _torque(entry: Entry, name: str, v: Values) -> Load:
    value, link, against = v["torque"], v["link"], v["against"]
    if type(value) is tuple:
        return TorqueVector(name, link, value, against)
    return SpatialTorque(name, link, value, v["along"], against)


SPACE: Forms[Load] = Forms(
    SPACE_LOADS,
    {
        "force": _force,
        "torque": _torque,
        "weight": weight,
        "mass": weight,
        "spring": spring,
        "power": lambda _, name, v: SpatialTorque(name, v["link"], v["power"], v["along"], v["against"]),
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
    "profile": "cams are of the plane; in space a contact is a load of unknown size along its normal",
    "motion": "a case in space is solved at rest; power as a load takes its own `speed`",
    "dynamic": "a case in space is solved at rest; give the forces of inertia as loads",
}
"""Sections that a case in space has no use for, and why."""

_FORMS = {
    "points": "as in {A: [0, 0, 0]}",
    "loads": "as in {P: {force: 100, link: 2, at: E, along: -z}}",
    "expect": "as in {F12z: 250}",
}


def build_space(root: Mapping, problems: Problems, name: str, units: Units) -> Case:
    """The case of a tree; whether it may be used, the problems tell."""
    reading = SpaceReading(problems, units)
    reading.marks.update(root.keys)
    _check_sections(reading, root)
    mention_links(reading, root.items.get("joints"))
    ground = ground_of(reading, root)
    gravity, down = _gravity(reading, root)
    listed = joint_list(reading, root, "{ball: [1, 2], at: A}")
    joints: tuple[Joint, ...] = read_list(
        reading, listed, SPACE_JOINTS, BUILDERS, "{hinge: [1, 2], at: A, axis: z}"
    )
    loads = read_section(reading, section_of(reading, root, "loads", _FORMS["loads"]), SPACE)
    points = read_points(reading, section_of(reading, root, "points", _FORMS["points"]))
    if readable(root, "points"):
        _check_given(reading)
    published = section_of(reading, root, "expect", _FORMS["expect"])
    named = reading.given | set(reading.used)
    space = Space({**points, **reading.hidden}, joints, loads, down)
    return Case(
        **told_of_itself(reading, root, name, units, ground),
        expect=read_expect(reading, published, named) if readable(root, "loads") else (),
        gravity=gravity or Case.gravity,
        space=space,
        noticed=tuple(reading.noticed),
    )


def _check_sections(reading: SpaceReading, root: Mapping) -> None:
    for key, mark in root.keys.items():
        if key in PLANAR:
            said = f"'{key}' has no place in a case in space, whose points have three coordinates"
            reading.refuse(mark, f"{said}: {PLANAR[key]}")
        elif key not in SECTIONS:
            reading.unknown_key(key, mark, SECTIONS, "a case", lambda key: "")


def _check_given(reading: SpaceReading) -> None:
    """Every point that is needed must have its coordinates."""
    for name, mark in reading.used.items():
        if name not in reading.given and is_named(name):
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
    values = entry.read()
    size = values["size"]
    return size and size._replace(path="gravity"), values["along"] or down


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
    parts = entry.numbers("gravity", node, "xyz", "gravity", "acceleration", meaning)
    if parts is None:
        return None, Along("-z")
    value = math.hypot(*(part.value for part in parts))
    if value == 0.0:
        reading.refuse(node.mark, f"gravity of nothing has no direction; write {meaning}")
        return None, Along("-z")
    balls = Balls(2 * PRECISIONS[-1])
    size = balls.sqrt(sum((balls.given(part) * balls.given(part) for part in parts), 0.0))
    return Number(value, max(part.half for part in parts), "gravity", str(size.value)), Vector(*parts)
