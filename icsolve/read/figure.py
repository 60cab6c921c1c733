"""The figure: points, lengths, angles, near, links; and points that something names and nothing gives."""

from __future__ import annotations

import math
import re
from collections import Counter
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from icsolve.case import (
    Centroid,
    Coordinates,
    Corner,
    Direction,
    Inertia,
    Length,
    Load,
    Number,
    Unknown,
    is_named,
)
from icsolve.read.document import Mapping, Node, Scalar, Sequence, is_null
from icsolve.read.entry import Entry, truth_of
from icsolve.read.keys import CENTROID, MASSES, MASSES_TIES, UNKNOWN
from icsolve.read.names import Names, point_key, shown, suggestion
from icsolve.read.owners import FigureData
from icsolve.read.reading import COMPASS, Reading, number, numbers
from icsolve.wording import listed

if TYPE_CHECKING:
    from icsolve.case.space import SpatialPoint

MOST_TURNS = 20
"""Over so many turns a position is searched at most: the work grows with them."""


def read_points(reading: Reading, section: Mapping) -> dict[str, Any]:
    """Coordinates and centroids by point."""
    points: dict[str, Any] = {}
    for key, node in section.items.items():
        name = reading.name(Scalar(key, False, section.keys[key]), "a point")
        if name is None:
            continue
        reading.given.add(name)
        reading.marks[f"points.{name}"] = section.keys[key]
        value: Centroid | Coordinates | SpatialPoint | None
        if type(node) is Mapping:
            value = _centroid(reading, name, node)
        else:
            value = _coordinates(reading, name, node)
        if value is not None:
            points[name] = value
    return points


def _coordinates(reading: Reading, name: str, node: Node) -> Coordinates | SpatialPoint | None:
    """A point by its coordinates, in the plane one of them unknown or none."""
    axes = reading.axes
    if type(node) is not Sequence or len(node.items) != len(axes) or has_semicolon(node):
        form = decimals(node) or "as in [3, 0.5] or [unknown, 0.5]"
        said = f"point {name} should have two coordinates, {form}"
        if len(axes) == 3:
            said = f"point {name}: in space every point has three coordinates, as in [3, 0.5, 0]"
        reading.refuse(node.mark, said)
        return None
    open_ones = [len(axes) == 2 and _is_unknown(item) for item in node.items]
    if all(open_ones):
        reading.refuse(node.mark, f"both coordinates of {name} are unknown; leave the point out of 'points'")
        return None
    values = []
    for item, is_open, axis in zip(node.items, open_ones, axes, strict=True):
        path = f"points.{name}.{axis}"
        if is_open and type(item) is Mapping:
            _unknown(reading, item, "length", path)
        values.append(None if is_open else number(reading, item, "length", path))
    missing = values.count(None) - sum(open_ones)
    return None if missing else reading.coordinates(*values)  # type: ignore[arg-type]


def has_semicolon(node: Sequence) -> bool:
    """Whether two coordinates have a semicolon between them, as people put it beside decimal commas."""
    return any(type(item) is Scalar and ";" in item.text for item in node.items)


def decimals(node: Node) -> str:
    """How numbers that commas cut, two in one text, or numbers in round brackets, are to be written."""
    if type(node) is Scalar and node.text[:1] == "(":
        return "in square brackets, as in [3, 0.5]"
    if type(node) is not Sequence or not all(type(item) is Scalar for item in node.items):
        return ""
    items = [item for item in node.items if type(item) is Scalar]
    texts = [item.text for item in items]
    cut = [n for n, (before, item) in enumerate(pairwise(items)) if _is_cut(before, item)]
    if len(texts) == 3 and len(cut) == 1:
        texts[cut[0] : cut[0] + 2] = [f"{texts[cut[0]]}.{texts[cut[0] + 1]}"]
        return f"with a decimal point, [{texts[0]}, {texts[1]}]"
    two = re.split(r"\s*;\s*" if ";" in "".join(texts) else r"\s+", ",".join(texts))
    if len(two) == 2:
        return f"with a comma between, [{two[0].replace(',', '.')}, {two[1].replace(',', '.')}]"
    if len(texts) != 4 or not texts[1].isdigit() or not texts[3].isdigit():
        return ""
    return f"with decimal points, [{texts[0]}.{texts[1]}, {texts[2]}.{texts[3]}]"


def _is_cut(before: Scalar, item: Scalar) -> bool:
    """Whether two numbers are one that its comma cuts: digits on both sides, and no space."""
    (line, column), whole = before.mark, before.text.lstrip("+-−")
    return whole.isdigit() and item.text.isdigit() and item.mark == (line, column + len(before.text) + 1)


def _centroid(reading: Reading, name: str, node: Mapping) -> Centroid | None:
    """A point as the mean of others."""
    if node.items and node.items.keys() <= {"x", "y"}:
        x, y = (at.text if type(at := node.items.get(axis)) is Scalar else "unknown" for axis in "xy")
        reading.refuse(node.mark, f"point {name} is written by its two numbers alone, {name}: [{x}, {y}]")
        return None
    if node.items and all(map(is_null, node.items.values())):
        reading.refuse(node.mark, f"write square brackets, {name}: [{', '.join(node.items)}]")
        return None
    reading.check_keys(node, CENTROID, f"point {name}")
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
    slips = [item for k, item in enumerate(items) if item.text in (name, *of[:k])]
    for item in slips:
        why = "not of itself" if item.text == name else "each of which counts once"
        said = f"the centroid of {name} is that of other points, {why}: take {item.text} out"
        reading.refuse(item.mark, said + f", or give {name} by a length and an angle")
    if len(of) < 2:
        reading.refuse(value.mark, f"the centroid of {name} is that of two or more other points")
    if slips or len(of) < 2:
        return None
    reading.centroids[name] = of
    return Centroid(of)


def read_lengths(reading: Reading, section: Mapping, known: set[str]) -> tuple[Length, ...]:
    """Distances between two points."""
    found = []
    for key, names in _keyed(reading, section, "lengths", (2,), known):
        node = section.items[key]
        value = _datum(reading, node, "length", f"lengths.{key}")
        if value is not None and value.value < 0.0:
            reading.refuse(node.mark, f"the length {key} should not be negative")
        elif value is not None:
            if value.value == 0.0:
                reading.noticed.append(f"the length {key} is 0: {names[0]} and {names[1]} are one place.")
            found.append(Length(names[0], names[1], value._replace(bound="not negative")))
    return tuple(found)


def read_angles(reading: Reading, section: Mapping, known: set[str]) -> tuple[Direction | Corner, ...]:
    """Directions of pairs and angles at the middle of triples."""
    found: list[Direction | Corner] = []
    for key, names in _keyed(reading, section, "angles", (2, 3), known):
        value = _datum(reading, section.items[key], "angle", f"angles.{key}")
        if value is not None and len(names) == 2:
            found.append(Direction(names[0], names[1], value))
        elif value is not None:
            found.append(Corner(names[0], names[1], names[2], value))
    return tuple(found)


def _is_unknown(node: Node) -> bool:
    """Whether a datum is to find: ``unknown``, or ``{unknown: [0, 90]}``."""
    return type(node) is Mapping or (type(node) is Scalar and node.text == "unknown")


def _datum(reading: Reading, node: Node, dimension: str, path: str) -> Number | None:
    """The number of an angle or length; of one that is to find, a number to stand in its place."""
    if not _is_unknown(node):
        return number(reading, node, dimension, path)
    reading.marks[path] = node.mark
    found = _unknown(reading, node, dimension, path)
    if found is None:
        return None
    if found.start is not None:
        value = found.start.value
    elif found.low is not None and found.high is not None:
        value = 0.5 * (found.low.value + found.high.value)
    else:
        value = math.nan
    return Number(value, 0.0, path, "unknown", dimension=dimension)


def _unknown(reading: Reading, node: Node, dimension: str, path: str) -> Unknown | None:
    """A datum that is to find, with its range and where the figure is written; None if it can't be read."""
    low = high = start = None
    if type(node) is Mapping:
        entry = Entry(reading, node, path, f"the unknown {path}", UNKNOWN)
        entry.check()
        start = entry.number("from", dimension)
        span = node.items.get("unknown")
        if type(span) is not Sequence or len(span.items) != 2:
            if span is not None:
                form = "[0, 90]" if dimension == "angle" else "[0.2, 0.35]"
                entry.refuse(span.mark, f"an unknown has a range of two numbers, {{unknown: {form}}}")
                return None
        else:
            ends = numbers(reading, span.items, dimension, path, ("low", "high"))
            if ends is None:
                return None
            low, high = ends
            if low.value >= high.value:
                entry.refuse(span.mark, "a range goes from the lower to the higher number")
                return None
            turns = (high.value - low.value) / 360.0
            if dimension == "angle" and turns > MOST_TURNS:
                said = f"over {turns:,.0f} turns, and at most {MOST_TURNS} are searched: take whole turns off"
                entry.refuse(span.mark, f"this range goes {said}")
                return None
            if low.value < 0.0 and path.startswith("lengths."):
                entry.refuse(span.mark, "a length should not be negative")
                return None
        if span is None or (start is None and entry.has("from")):
            return None
    found = Unknown(path, low, high, start, node.mark)
    reading.unknowns.append(found)
    return found


def check_unknowns(reading: Reading, loads: tuple[Load, ...]) -> None:
    """A position is asked only where every load is known."""
    for unknown in reading.unknowns:
        idle = next((load.name for load in loads if getattr(load, "value", 0) is None), None)
        if idle is not None and not unknown.path.startswith("points."):
            said = f"load {idle} is to find too, and a position is asked only where every load is known; "
            said += "what the other data of the figure give is left out"
            reading.refuse(unknown.mark, f"'unknown' cannot stand here: {said}")


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
        at = numbers(reading, node.items, "length", f"near.{name}", "xy")
        if at is not None:
            found[name] = (at[0].value, at[1].value)
    return found


def read_links(reading: Reading, section: Mapping) -> tuple[dict[str, tuple[str, ...]], dict[str, Inertia]]:
    """Further points of links, as ``links:`` names them, and the masses of those that have one."""
    found: dict[str, tuple[str, ...]] = {}
    masses: dict[str, Inertia] = {}
    for key, node in section.items.items():
        link = reading.link(Scalar(key, False, section.keys[key]), "a link")
        inertia, listed = None, node
        if type(node) is Mapping:
            entry = Entry(reading, node, f"links.{key}", f"link {shown(key)}", MASSES, MASSES_TIES)
            inertia, listed = _inertia(entry), node.items.get("points", Sequence([], node.mark))
        if type(listed) is Scalar and listed.text[:1].isdigit() and " " in listed.text.strip():
            form = f"{{{key}: {{mass: {listed.text}, centre: G}}}}"
            reading.refuse(listed.mark, f"a mass stands in braces, with the point where it is: {form}")
            continue
        items = reading.names(listed, f"the points of link {shown(key)}", "{3: [G, H]}")
        for item in items or ():
            reading.used.setdefault(item.text, item.mark)
        if link is None or items is None:
            continue
        reading.marks[f"links.{link}"] = section.keys[key]
        found[link] = tuple(dict.fromkeys(item.text for item in items))
        if inertia is not None:
            masses[link] = inertia
    return found, masses


def _inertia(entry: Entry) -> Inertia | None:
    """The mass of a link; None where it has none, or it can't be read."""
    entry.check()
    if not entry.has("mass") and not entry.has("inertia"):
        if entry.has("centre"):
            entry.refuse(entry.mark("centre"), f"{entry.what} has a centre of mass and no 'mass'; give it")
        return None
    entry.check_ties()
    centre, mass, moment = entry.point("centre"), entry.number("mass"), entry.number("inertia")
    read = all(value is not None for key, value in (("mass", mass), ("inertia", moment)) if entry.has(key))
    return Inertia(mass, centre, moment) if read and (centre or mass is None) else None


def read_dynamic(reading: Reading, node: Node | None) -> bool:
    """Whether the case asks for inertia forces."""
    if node is None:
        return False
    found = truth_of(node)
    if found is None:
        reading.refuse(node.mark, "'dynamic' should be yes or no: whether inertia forces are among the loads")
    return bool(found)


def check_given(reading: Reading) -> None:
    """Every point that is needed must be given by something."""
    given = reading.given | {name for name, times in Counter(reading.on_guides).items() if times > 1}
    placed = reading.measured | set(reading.on_guides)  # a centroid that is placed says where its points are
    given |= {one for name, of in reading.centroids.items() if name in placed for one in of}
    for name, mark in reading.used.items():
        if name not in given and is_named(name):
            reading.refuse(mark, _never_given(reading, name, given))


def stray_points(reading: Reading, figure: FigureData) -> list[str]:
    """Sentences on points that one length or angle alone names: it places nothing."""
    names = Counter(name for datum in (*figure.lengths, *figure.angles) for name in datum[:-1])
    shaped = {name for names in figure.further.values() for name in names}
    known = {*figure.points, *shaped, *reading.used, *reading.on_guides}
    said = []
    for datum in (*figure.angles, *figure.lengths):
        alone = [name for name in dict.fromkeys(datum[:-1]) if names[name] == 1 and name not in known]
        if alone:
            cased = [name.swapcase() if name.swapcase() in names else name for name in datum[:-1]]
            meant = f"; did you mean {'-'.join(cased)}?" if not {*cased} & {*alone} else "."
            points = f"point{'s' * (len(alone) > 1)} {listed(alone)}"
            said.append(f"nothing but {datum.value.path} names {points}{meant}")
    return said


def guides_without_line(reading: Reading, figure: FigureData) -> list[str]:
    """Sentences on guides by a direction alone, whose line is where their point is, at points that too little
    else places: they place nothing."""
    times = Counter(name for datum in (*figure.lengths, *figure.angles) for name in datum[:-1])
    placed = {*figure.points, *reading.centroids, *reading.on_guides}
    said = []
    for joint in figure.joints:
        guide, at = joint.guide, joint.at
        if guide is None or at is None or guide.ends or guide.through or at in placed or times[at] > 1:
            continue
        links = " and ".join(joint.links)
        said.append(
            f"the guide of links {links} at {at} has a direction, and no line: give 'through', a point of "
            f"that line, or a coordinate of {at}."
        )
    return said


def small_angles(figure: FigureData) -> list[str]:
    """A sentence where all angles may be radians: each has decimals, and none is more than a turn of them."""
    angles = [datum.value for datum in figure.angles if datum.value.factor == 1.0]
    small = [one for one in angles if 0.0 < abs(one.value) <= 2.0 * math.pi and not one.value.is_integer()]
    if len(small) < 2 or len(small) < len(figure.angles):
        return []
    return [
        "all angles of the figure are of a few degrees; if radians are meant, write each with its unit, as "
        f"in {small[0].digits} rad."
    ]


def _never_given(reading: Reading, name: str, given: set[str]) -> str:
    if name in COMPASS:
        meant = f"for a direction write 'angle: {COMPASS[name]}'"
        return f"a point stands here, and nothing gives a point '{name}'; {meant}"
    if name == "unknown":
        return (
            "a place is no unknown: give it as [x, y], and ask for where it is to be by `icsolve sweep CASE "
            "--vary loads.LOAD.at.x=FROM:TO:STEP --find hold`, or `--find` of an answer"
        )
    likely = _likely(reading, name, given)
    said = f"point {name} is named here, but nothing gives it: no coordinates, length, angle or guide{likely}"
    of = next((point for point, others in reading.centroids.items() if name in others), None)
    if of is None:
        return said
    return f"{said}; {of} is the centroid of {listed(reading.centroids[of])}: give {name}, or {of} by lengths"


def _likely(reading: Reading, name: str, given: set[str]) -> str:
    """What a point that nothing gives may be: another one, a link, the middle of two points."""
    if len(name) == len({*name}) == 2 and {*name} <= given:
        return f"; {name} reads as two points, and one of them is wanted here, {name[0]} or {name[1]}"
    cased = next((point for point in sorted(given) if point.lower() == name.lower()), "")
    likely = len(name) > 1 or not name.isascii()
    near = f"; did you mean '{cased}'?" if cased else suggestion(name, sorted(given)) if likely else ""
    if near:
        return near
    if reading.links and name in reading.links:
        return f"; {name} is a link, and a point of it is wanted here"
    if name in ("centroid", "centre", "center", "middle", "midpoint"):
        return "; a centroid is a point with a name, 'G: {centroid: [A, B]}' under 'points'"
    middle = f"; the middle of two points is '{name}: {{centroid: [A, B]}}' under 'points'"
    return middle if name[0] in "MG" else ""
