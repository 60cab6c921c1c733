"""A case in space: its points have three coordinates, and its joints and loads are those of space."""

from __future__ import annotations

import math

from icsolve.case import Case, Centroid, Expected, Number, Units
from icsolve.case.space import Along, Axis, Coordinates, Joint, Space, Vector
from icsolve.read.build import SECTIONS, TEXTS, ground_of, readable, section_of, tolerance_of_case
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.entry import Entry
from icsolve.read.expect import read_expect
from icsolve.read.geometry import centroid_of
from icsolve.read.jointed import mention_links
from icsolve.read.problems import Problems, shown, suggestion
from icsolve.read.quantities import number
from icsolve.read.space_joints import read_space_joints
from icsolve.read.space_loads import read_space_loads
from icsolve.read.vectors import SpaceReading, axis, components
from icsolve.units import Unit

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


def build_space(
    root: Mapping, problems: Problems, name: str, measures: tuple[Units, dict[str, Unit], dict[str, str]]
) -> Case:
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
    loads = read_space_loads(reading, section_of(reading, root, "loads", _FORMS))
    points = _points(reading, section_of(reading, root, "points", _FORMS))
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
        return read_space_joints(reading, node)
    mark = root.keys.get("joints", root.mark)
    reading.refuse(mark, "the case has no joints; list them, as in joints: [{ball: [1, 2], at: A}]")
    return ()


def _points(reading: SpaceReading, section: Mapping) -> dict[str, Coordinates | Centroid]:
    """Coordinates and centroids by point."""
    found: dict[str, Coordinates | Centroid] = {}
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


def _coordinates(reading: SpaceReading, name: str, node: Node) -> Coordinates | None:
    if type(node) is not Sequence or len(node.items) != 3:
        said = "in space every point has three coordinates, as in [3, 0.5, 0]"
        reading.refuse(node.mark, f"point {name}: {said}")
        return None
    x, y, z = (
        number(reading, item, "length", f"points.{name}.{letter}")
        for item, letter in zip(node.items, "xyz", strict=True)
    )
    return Coordinates(x, y, z) if x is not None and y is not None and z is not None else None


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
    entry = Entry(reading, node, "gravity", "gravity")
    entry.only("size", "along")
    size = _size(reading, node.items["size"]) if entry.has("size") else None
    return size, axis(entry, "along", "where weights pull to") or down


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
    published = section_of(reading, root, "expect", _FORMS)
    named = reading.given | set(reading.used)
    return read_expect(reading, published, named) if readable(root, "loads") else ()
