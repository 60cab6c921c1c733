"""Loads in space: forces, torques, weights, springs and power."""

from __future__ import annotations

from icsolve.case import Number, Spring, Toward, Weight
from icsolve.case.space import Force, ForceVector, Heading, Load, Torque, TorqueVector
from icsolve.read.document import Mapping, Sequence
from icsolve.read.entry import Entry
from icsolve.read.listed import Forms, Likes, bearer, magnitude, read_section, word_at
from icsolve.read.power import torque_number
from icsolve.read.reading import Reading
from icsolve.read.vectors import axis, components, place

HEADINGS = ("along", "toward", "away")
KEYS = {
    "force": ("link", "at", *HEADINGS, "against"),
    "torque": ("link", "along", "against"),
    "weight": ("link", "at"),
    "mass": ("link", "at"),
    "spring": ("free", "link", "at", "against", "to"),
    "power": ("speed", "link", "along", "against"),
}
"""What each kind of load takes besides its number."""

_PLANAR = "that is for the plane; in space it is `along: z`, `along: [0, 3, 4]` or `along: [A, B]`"
_ELSEWHERE = {
    "angle": _PLANAR,
    "slope": _PLANAR,
    "turns": "in space a torque is positive about its axis `along:` by the right-hand rule",
    "turns_with": "a case in space is not moved",
}
_ALONG_TORQUE = "the axis of the torque, positive by the right-hand rule"
_PLACE = "its point"


def read_space_loads(reading: Reading, section: Mapping) -> tuple[Load, ...]:
    """The loads of a case in space that could be read."""
    return read_section(reading, section, SPACE)


def _force(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    at = place(entry, "at", f"@{name}", _PLACE)
    if type(entry.node.items["force"]) is Sequence:
        parts = _components(entry, "force", "force")
        return ForceVector(name, link, at, parts, against) if good and link and at and parts else None
    heading = _heading(entry)
    read, value = magnitude(entry, name, kind, likes)
    return (
        Force(name, link, at, value, heading, against) if good and read and link and at and heading else None
    )


def _components(entry: Entry, kind: str, dimension: str) -> tuple[Number, Number, Number] | None:
    """A load by its components, at paths ``loads.P.x``; it takes no direction."""
    for heading in HEADINGS:
        if entry.has(heading):
            said = f"{entry.what} is given by components, so it takes no '{heading}'"
            entry.refuse(entry.mark(heading), said)
    parts = components(entry, kind, dimension, "a number, 'unknown', or three components [x, y, z]")
    if parts is None:
        return None
    marks = entry.reading.marks
    for letter in "xyz":
        marks[f"{entry.path}.{letter}"] = marks.pop(f"{entry.path}.{kind}.{letter}")
    x, y, z = (part._replace(path=f"{entry.path}.{n}") for part, n in zip(parts, "xyz", strict=True))
    return x, y, z


def _heading(entry: Entry) -> Heading | None:
    key = entry.one_of(HEADINGS)
    if key is None:
        if not _ELSEWHERE.keys() & entry.node.keys.keys():  # a direction of the plane has its own message
            entry.refuse(entry.node.mark, f"{entry.what} needs its direction: {', '.join(HEADINGS)}")
        return None
    if key == "along":
        return axis(entry, "along", "its direction")
    point = entry.point(key)
    if point is not None and point == word_at(entry, "at"):
        entry.refuse(entry.mark(key), f"{entry.what} acts at {point} and cannot point {key} it")
        return None
    return Toward(point, key == "away") if point else None


def _torque(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    if type(entry.node.items["torque"]) is Sequence:
        parts = _components(entry, "torque", "torque")
        return TorqueVector(name, link, parts, against) if good and link and parts else None
    heading = axis(entry, "along", _ALONG_TORQUE)
    read, value = magnitude(entry, name, kind, likes)
    return Torque(name, link, value, heading, against) if good and read and link and heading else None


def _power(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    heading = axis(entry, "along", "the axis of the rotation, positive by the right-hand rule")
    value = torque_number(entry)
    return Torque(name, link, value, heading, against) if good and value and link and heading else None


def _weight(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link = entry.link("link", "the link that it acts on")
    at = place(entry, "at", f"@{name}", _PLACE)
    read, value = magnitude(entry, name, kind, likes, "not negative" if kind == "mass" else "")
    return Weight(name, link, at, value, kind == "mass") if read and link and at else None


def _spring(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    at = place(entry, "at", f"@{name}", "the point of its link that it is fixed to")
    to = place(entry, "to", f"@{name}'", "the point of its other end")
    entry.need("free", "its length without load")
    free = entry.number("free", "length", "not negative")
    read, value = magnitude(entry, name, kind, likes, "not negative")
    if at is not None and at == to:
        entry.refuse(entry.mark("to"), f"both ends of {entry.what} are at {at}")
        return None
    if not (good and read and link and at and to and free):
        return None
    return Spring(name, link, at, to, value, free, against)


SPACE: Forms[Load] = Forms(
    KEYS,
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
