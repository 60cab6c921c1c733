"""The figure: points, lengths, angles, near, and what links carry besides."""

from __future__ import annotations

from collections import Counter

from icsolve.case import (
    Centroid,
    Coordinates,
    Corner,
    Direction,
    Joint,
    Length,
    Load,
    Motion,
    Pin,
    Slide,
    Slot,
    Spring,
    Torque,
    Weld,
)
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.names import Names, point_key
from icsolve.read.problems import shown, suggestion
from icsolve.read.quantities import COMPASS, number
from icsolve.read.reading import Reading


def read_points(reading: Reading, section: Mapping) -> dict[str, Coordinates | Centroid]:
    """Coordinates and centroids by point."""
    points: dict[str, Coordinates | Centroid] = {}
    for key, node in section.items.items():
        name = reading.name(Scalar(key, False, section.keys[key]), "a point")
        if name is None:
            continue
        reading.given.add(name)
        reading.marks[f"points.{name}"] = section.keys[key]
        value: Coordinates | Centroid | None
        if type(node) is Mapping:
            value = centroid_of(reading, name, node)
        else:
            value = _coordinates(reading, name, node)
        if value is not None:
            points[name] = value
    return points


def _coordinates(reading: Reading, name: str, node: Node) -> Coordinates | None:
    if type(node) is not Sequence or len(node.items) != 2:
        if type(node) is Scalar and node.text[:1] == "(" and node.text[-1] != ")":
            return None  # refused where the comma cut it
        form = decimals(node) or "as in [3, 0.5] or [unknown, 0.5]"
        reading.refuse(node.mark, f"point {name} should have two coordinates, {form}")
        return None
    open_ones = [type(item) is Scalar and item.text == "unknown" for item in node.items]
    if all(open_ones):
        reading.refuse(node.mark, f"both coordinates of {name} are unknown; leave the point out of 'points'")
        return None
    values = [
        None if is_open else number(reading, item, "length", f"points.{name}.{axis}")
        for item, is_open, axis in zip(node.items, open_ones, "xy", strict=True)
    ]
    missing = sum(value is None for value in values) - sum(open_ones)
    return None if missing else Coordinates(*values)


def decimals(node: Node) -> str:
    """How four numbers in place of two, or numbers in round brackets, are to be written."""
    if type(node) is Scalar and node.text[:1] == "(":
        return "in square brackets, as in [3, 0.5]"
    if type(node) is not Sequence or len(node.items) != 4:
        return ""
    a, b, c, d = (item.text if type(item) is Scalar else "" for item in node.items)
    return f"with decimal points, [{a}.{b}, {c}.{d}]" if b.isdigit() and d.isdigit() else ""


def centroid_of(reading: Reading, name: str, node: Mapping) -> Centroid | None:
    """A point as the mean of others."""
    reading.check_keys(node, ("centroid",), f"point {name}")
    value = node.items.get("centroid")
    if value is None:
        reading.refuse(node.mark, f"point {name} should be [x, y] or {{centroid: [C, F, G]}}")
        return None
    items = reading.names(value, f"the centroid of {name}", "{centroid: [C, F, G]}")
    if items is None:
        return None
    of = tuple(item.text for item in items)
    for item in items:
        reading.used.setdefault(item.text, item.mark)
    if len(of) < 2 or len(set(of)) < len(of) or name in of:
        reading.refuse(value.mark, f"the centroid of {name} is that of two or more other points")
        return None
    reading.centroids[name] = of
    return Centroid(of)


def read_lengths(reading: Reading, section: Mapping, known: set[str]) -> tuple[Length, ...]:
    """Distances between two points."""
    found = []
    for key, names in _keyed(reading, section, "lengths", (2,), known):
        node = section.items[key]
        value = number(reading, node, "length", f"lengths.{key}")
        if value is not None and value.value < 0.0:
            reading.refuse(node.mark, f"the length {key} should not be negative")
        elif value is not None:
            found.append(Length(names[0], names[1], value))
    return tuple(found)


def read_angles(reading: Reading, section: Mapping, known: set[str]) -> tuple[Direction | Corner, ...]:
    """Directions of pairs and angles at the middle of triples."""
    found: list[Direction | Corner] = []
    for key, names in _keyed(reading, section, "angles", (2, 3), known):
        value = number(reading, section.items[key], "angle", f"angles.{key}")
        if value is not None and len(names) == 2:
            found.append(Direction(names[0], names[1], value))
        elif value is not None:
            found.append(Corner(names[0], names[1], names[2], value))
    return tuple(found)


def _keyed(
    reading: Reading, section: Mapping, what: str, sizes: tuple[int, ...], known: set[str]
) -> list[tuple[str, Names]]:
    """The keys that name points, each once: ``AB``, ``A-B`` and, of a length, ``BA`` are the same."""
    found: list[tuple[str, Names]] = []
    first: dict[Names, str] = {}
    for key, mark in section.keys.items():
        names = point_key(key, sizes, known)
        if isinstance(names, str):
            reading.refuse(mark, names)
            reading.given.update(name for name in known if name in key)  # no second message about them
            continue
        reading.given.update(names)
        reading.measured.update(names)
        same = tuple(sorted(names)) if what == "lengths" else names
        if same in first:
            line, column = section.keys[first[same]]
            place = f"line {line}, column {column}"
            reading.refuse(mark, f"'{key}' is given twice, the first time as '{first[same]}' in {place}")
            continue
        first[same] = key
        found.append((key, names))
    return found


def read_near(reading: Reading, section: Mapping) -> dict[str, tuple[float, float]]:
    """Roughly where points lie."""
    found: dict[str, tuple[float, float]] = {}
    for key, node in section.items.items():
        name = reading.point(Scalar(key, False, section.keys[key]), "a point")
        if name is None:
            continue
        if type(node) is not Sequence or len(node.items) != 2:
            form = decimals(node) or "as in [3.5, 2.4]"
            reading.refuse(node.mark, f"near {name} should be two coordinates, {form}")
            continue
        x = number(reading, node.items[0], "length", f"near.{name}.x")
        y = number(reading, node.items[1], "length", f"near.{name}.y")
        if x is not None and y is not None:
            found[name] = (x.value, y.value)
    return found


def read_carried(reading: Reading, section: Mapping) -> dict[str, tuple[str, ...]]:
    """Further points of links, as ``links:`` names them."""
    found: dict[str, tuple[str, ...]] = {}
    for key, node in section.items.items():
        link = reading.link(Scalar(key, False, section.keys[key]), "a link")
        if type(node) is Mapping:
            reading.check_keys(node, (), f"link {shown(key)}")
        items = reading.names(node, f"the points of link {shown(key)}", "{3: [G, H]}")
        for item in items or ():
            reading.used.setdefault(item.text, item.mark)
        if link is not None and items is not None:
            reading.marks[f"links.{link}"] = section.keys[key]
            found[link] = tuple(item.text for item in items)
    return found


def check_given(reading: Reading) -> None:
    """Every point that is needed must be given by something."""
    given = reading.given | {name for name, times in Counter(reading.on_guides).items() if times > 1}
    given |= _given_backwards(reading)
    for name, mark in reading.used.items():
        if name not in given and not name.startswith("@"):
            reading.refuse(mark, _never_given(reading, name, given))


def _given_backwards(reading: Reading) -> set[str]:
    """Points of which a centroid is placed by something else: it then says where they are."""
    placed = reading.measured | set(reading.on_guides)
    return {one for name, of in reading.centroids.items() if name in placed for one in of}


def _never_given(reading: Reading, name: str, given: set[str]) -> str:
    if name in COMPASS:
        meant = f"for a direction write 'angle: {COMPASS[name]}'"
        return f"a point stands here, and nothing gives a point '{name}'; {meant}"
    likely = _likely(reading, name, given)
    said = f"point {name} is named here, but nothing gives it: no coordinates, length, angle or guide{likely}"
    of = next((point for point, others in reading.centroids.items() if name in others), None)
    if of is None:
        return said
    from icsolve.wording.sentences import listed

    return f"{said}; {of} is the centroid of {listed(reading.centroids[of])}: give {name}, or {of} by lengths"


def _likely(reading: Reading, name: str, given: set[str]) -> str:
    """What a point that nothing gives may be: another one, a link, the middle of two points."""
    cased = next((point for point in sorted(given) if point.lower() == name.lower()), "")
    near = f"; did you mean '{cased}'?" if cased else suggestion(name, sorted(given)) if len(name) > 1 else ""
    if near:
        return near
    if reading.links and name in reading.links:
        return f"; {name} is a link, and a point of it is wanted here"
    return (
        f"; the middle of two points is '{name}: {{centroid: [A, B]}}' under 'points'"
        if name[0] in "MG"
        else ""
    )


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
    placed = [pair for joint in joints for pair in _on_joint(joint)]
    placed += [pair for load in loads for pair in _on_load(load, ground)]
    placed += [(link, point) for link, points in further.items() for point in points]
    placed += [(given.link, given.point) for given in motion if given.point]
    for link, point in placed:
        found.setdefault(link, {})[point] = None
    return {link: tuple(points) for link, points in found.items()}


def _on_joint(joint: Joint) -> list[tuple[str, str]]:
    if isinstance(joint, Pin) or (isinstance(joint, Weld) and joint.at):
        return [(link, joint.at or "") for link in joint.links]
    if isinstance(joint, Slide | Slot):
        guide = joint.guide
        named = [*(guide.ends or ()), *([guide.through] if guide.through else [])]
        return [(joint.links[0], joint.at), *[(joint.links[1], point) for point in named]]
    return []


def _on_load(load: Load, ground: str) -> list[tuple[str, str]]:
    if isinstance(load, Torque):
        return []
    ends = [(load.link, load.at)]
    return [*ends, (load.against or ground, load.to)] if isinstance(load, Spring) else ends
