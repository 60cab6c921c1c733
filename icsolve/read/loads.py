"""Loads of the plane: forces, torques, weights, springs and power, known, unknown, or like another."""

from __future__ import annotations

from icsolve.case import Force, ForceVector, Heading, Load, Slope, Spring, Torque, Toward, Weight
from icsolve.read.document import Mapping, Sequence
from icsolve.read.entry import Entry
from icsolve.read.listed import Forms, Likes, bearer, magnitude, read_section, word_at
from icsolve.read.reading import Reading

HEADINGS = ("angle", "toward", "away", "slope")
KEYS = {
    "force": ("link", "at", *HEADINGS, "against", "turns_with"),
    "torque": ("link", "turns", "against"),
    "weight": ("link", "at"),
    "mass": ("link", "at"),
    "spring": ("free", "link", "at", "against", "to"),
    "power": ("speed", "link", "turns", "against"),
}
"""What each kind of load takes besides its number."""

_ELSEWHERE = {
    "along": "that is for a case in space, whose points have three coordinates; here it is `angle`, "
    "`toward`, `away` or `slope`"
}


def read_loads(reading: Reading, section: Mapping) -> tuple[Load, ...]:
    """The loads of a planar case that could be read."""
    return read_section(reading, section, PLANE)


def _force(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    at = entry.place("at", f"@{name}", "its point, or [x, y]")
    turns_with = entry.link("turns_with")
    if type(entry.node.items["force"]) is Sequence:
        return _vector(entry, name, link, at, against, turns_with, good)
    heading = _heading(entry)
    read, value = magnitude(entry, name, kind, likes)
    if not (good and read and link and at and heading):
        return None
    return Force(name, link, at, value, heading, against, turns_with)


def _vector(
    entry: Entry,
    name: str,
    link: str | None,
    at: str | None,
    against: str | None,
    turns_with: str | None,
    good: bool,
) -> ForceVector | None:
    heading = entry.one_of(HEADINGS)
    if heading is not None:
        entry.refuse(entry.mark(heading), f"{entry.what} is given by components, so it takes no '{heading}'")
    parts = entry.pair("force", "force", "xy", "a number, 'unknown', or two components [Fx, Fy]")
    if parts is None:
        return None
    x, y = (part._replace(path=f"{entry.path}.{axis}") for part, axis in zip(parts, "xy", strict=True))
    for axis in "xy":
        entry.reading.marks[f"{entry.path}.{axis}"] = entry.reading.marks.pop(f"{entry.path}.force.{axis}")
    return ForceVector(name, link, at, x, y, against, turns_with) if good and link and at else None


def _heading(entry: Entry) -> Heading | None:
    key = entry.one_of(HEADINGS)
    if key is None:
        entry.refuse(entry.node.mark, f"{entry.what} needs its direction: {', '.join(HEADINGS[:3])} or slope")
    if key == "angle":
        return entry.number(key, "angle")
    if key == "slope":
        return _slope(entry)
    point = entry.point(key) if key else None
    if point is not None and point == word_at(entry, "at"):
        entry.refuse(entry.mark(key or ""), f"{entry.what} acts at {point} and cannot point {key} it")
        return None
    return Toward(point, key == "away") if point else None


def _slope(entry: Entry) -> Slope | None:
    pair = entry.pair("slope", "number", "xy", "a run and a rise, as in [-3, 4]")
    if pair and pair[0].value == 0.0 and pair[1].value == 0.0:
        entry.refuse(entry.mark("slope"), f"the slope [0, 0] of {entry.what} has no direction")
        return None
    return Slope(*pair) if pair else None


def _torque(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    turns = entry.word("turns", ("ccw", "cw"))
    read, value = magnitude(entry, name, kind, likes)
    if not (good and read and link) or (turns is None and entry.has("turns")):
        return None
    return Torque(name, link, value, turns or "ccw", against)


def _weight(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link = entry.link("link", "the link that it acts on")
    at = entry.place("at", f"@{name}", "its point, or [x, y]")
    read, value = magnitude(entry, name, kind, likes, "not negative" if kind == "mass" else "")
    return Weight(name, link, at, value, kind == "mass") if read and link and at else None


def _spring(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    at = entry.place("at", f"@{name}", "the point of its link that it is fixed to, or [x, y]")
    to = entry.place("to", f"@{name}'", "the point of its other end, or [x, y]")
    entry.need("free", "its length without load")
    free = entry.number("free", "length", "not negative")
    read, value = magnitude(entry, name, kind, likes, "not negative")
    if at is not None and at == to:
        entry.refuse(entry.mark("to"), f"both ends of {entry.what} are at {at}")
        return None
    if not (good and read and link and at and to and free):
        return None
    return Spring(name, link, at, to, value, free, against)


def _power(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    from icsolve.read.power import torque_number

    link, against, good = bearer(entry)
    turns = entry.word("turns", ("ccw", "cw"))
    value = torque_number(entry)
    if value is None or not (good and link) or (turns is None and entry.has("turns")):
        return None
    return Torque(name, link, value, turns or "ccw", against)


PLANE: Forms[Load] = Forms(
    KEYS,
    {
        "force": _force,
        "torque": _torque,
        "weight": _weight,
        "mass": _weight,
        "spring": _spring,
        "power": _power,
    },
    "as in {force: 100, link: 4, at: E, angle: 180}",
    _ELSEWHERE,
)
"""Loads of the plane."""
