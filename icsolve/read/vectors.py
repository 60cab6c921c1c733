"""Directions, components and places in space, as a case writes them."""

from __future__ import annotations

from icsolve.case import Number
from icsolve.case.space import Along, Axis, Coordinates, Line, Vector
from icsolve.read.document import Scalar, Sequence
from icsolve.read.entry import Entry
from icsolve.read.quantities import number
from icsolve.read.reading import Reading

WORDS = ("x", "y", "z", "-x", "-y", "-z")
_FORM = "x, y, z, -z, components such as [0, 3, 4], or two points [A, B]"


class SpaceReading(Reading):
    """The state of reading a case in space; ``places`` are the points that a load gives by coordinates."""

    axes = "xyz"
    couples = "xyz"
    places: dict[str, Coordinates]


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


def axis(entry: Entry, key: str, meaning: str) -> Axis | None:
    """A direction that must stand there: a coordinate axis, components, or two points."""
    node = entry.need(key, f"{meaning}: {_FORM}")
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


def _line(entry: Entry, key: str, node: Sequence) -> Line | None:
    items = entry.reading.names(node, f"'{key}' of {entry.what}", "[A, B]")
    if items is None:
        return None
    for item in items:
        entry.reading.used.setdefault(item.text, item.mark)
    if items[0].text == items[1].text:
        entry.refuse(node.mark, f"'{key}' of {entry.what} should be two different points")
        return None
    return Line(items[0].text, items[1].text)


def place(entry: Entry, key: str, hidden: str, meaning: str) -> str | None:
    """A point's name, or that of the hidden point whose coordinates stand in its stead."""
    node = entry.need(key, f"{meaning}, or [x, y, z]")
    if type(node) is not Sequence:
        return entry.point(key) if node is not None else None
    parts = components(entry, key, "length", "a point, or three coordinates [x, y, z]")
    if parts is None:
        return None
    assert isinstance(entry.reading, SpaceReading)
    entry.reading.places[hidden] = Coordinates(*parts)
    entry.reading.marks[f"points.{hidden}"] = node.mark
    return hidden
