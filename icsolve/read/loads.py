"""Loads: forces, torques, weights and springs, known, unknown, or like another."""

from __future__ import annotations

from icsolve.case import (
    Force,
    ForceVector,
    Heading,
    Like,
    Load,
    Magnitude,
    Mark,
    Slope,
    Spring,
    Torque,
    Toward,
    Weight,
)
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.entry import Entry
from icsolve.read.names import is_name, why_no_name
from icsolve.read.problems import shown, suggestion
from icsolve.read.reading import RESERVED, Reading

DIMENSION = {"force": "force", "torque": "torque", "weight": "force", "mass": "mass", "spring": "stiffness"}
"""Kinds of load, and the dimension of each one's number."""

HEADINGS = ("angle", "toward", "away", "slope")
KEYS = {
    "force": ("link", "at", *HEADINGS, "against", "turns_with"),
    "torque": ("link", "turns", "against"),
    "weight": ("link", "at"),
    "mass": ("link", "at"),
    "spring": ("free", "link", "at", "against", "to"),
}
"""What each kind of load takes besides its number."""

_FORM = "as in {force: 100, link: 4, at: E, angle: 180}"
Likes = dict[str, tuple[str, Mark]]
"""Loads that are like another: its name, and where that stands."""


def read_loads(reading: Reading, section: Mapping) -> tuple[Load, ...]:
    """The loads that could be read."""
    for key, node in section.items.items():
        reading.kinds[key] = _kind_of(node)
    found, likes = [], Likes()
    for key, node in section.items.items():
        load = _load(reading, key, node, section.keys[key], likes)
        if load is not None:
            found.append(load)
    _check_likes(reading, likes)
    return tuple(found)


def _kind_of(node: Node) -> str:
    """The kind of a load, '' where that is not clear; vectors have their own."""
    kinds = [key for key in node.items if key in KEYS] if type(node) is Mapping else []
    if len(kinds) != 1 or type(node) is not Mapping:
        return ""
    vector = kinds[0] == "force" and type(node.items["force"]) is Sequence
    return "vector" if vector else kinds[0]


def _load(reading: Reading, name: str, node: Node, mark: Mark, likes: Likes) -> Load | None:
    if not is_name(name):
        reading.refuse(mark, f"{shown(name)} is not a name of a load: {why_no_name(name)}")
        return None
    mapping = reading.mapping(node, f"load {name}", _FORM)
    if mapping is None:
        return None
    reading.marks[f"loads.{name}"] = mark
    entry = Entry(reading, mapping, f"loads.{name}", f"load {name}")
    kind = _kind(entry)
    if kind is None:
        return None
    _check_keys(entry, kind)
    return BUILD[kind](entry, name, kind, likes)


def _kind(entry: Entry) -> str | None:
    kind = entry.one_of(KEYS)
    if kind is None:
        parts = {key for keys in KEYS.values() for key in keys}
        strange = [key for key in entry.node.items if key not in parts]
        known = strange and strange[0] not in RESERVED
        likely = suggestion(strange[0], KEYS) if known else ""
        if strange and not known:
            entry.reading.unknown_key(strange[0], entry.mark(strange[0]), (), entry.what)
        else:
            mark = entry.mark(strange[0]) if strange else entry.node.mark
            entry.refuse(mark, f"{entry.what} has none of {', '.join(KEYS)}{likely}")
    return kind if kind and entry.reading.kinds[entry.path.removeprefix("loads.")] else None


def _check_keys(entry: Entry, kind: str) -> None:
    """Refuse what this kind has no use for; other kinds' keys are explained."""
    allowed = (kind, *KEYS[kind])
    others = {key for keys in KEYS.values() for key in keys}
    for key, mark in entry.node.keys.items():
        if key in allowed:
            continue
        if key in others:
            takes = ", ".join(KEYS[kind])
            entry.refuse(mark, f"{entry.what} is a {kind}, which has no '{key}'; it takes {takes}")
        else:
            entry.reading.unknown_key(key, mark, allowed, entry.what)


def _magnitude(entry: Entry, name: str, kind: str, likes: Likes, bound: str = "") -> tuple[bool, Magnitude]:
    """Whether the number could be read, and the number: None for the unknown."""
    node = entry.node.items[kind]
    entry.reading.marks[entry.path] = node.mark
    if type(node) is Scalar and node.text == "unknown":
        return True, None
    if type(node) is Mapping:
        like = _like(entry, name, node, likes)
        return like is not None, like
    number = entry.value(node, DIMENSION[kind], entry.path, kind, bound)
    return number is not None, number


def _like(entry: Entry, name: str, node: Mapping, likes: Likes) -> Like | None:
    inner = Entry(entry.reading, node, entry.path, entry.what)
    inner.only("like", "times")
    target = inner.need("like", "the name of another load, as in {like: M2, times: -1}")
    if target is None:
        return None
    other = entry.reading.name(target, f"'like' of {entry.what}")
    times = inner.number("times", "number")
    if other is None or (inner.has("times") and times is None):
        return None
    likes[name] = (other, target.mark)
    return Like(other, times)


def _check_likes(reading: Reading, likes: Likes) -> None:
    """Each other load exists, is a number of the same kind, and does not lead back."""
    circular = _circular(likes)
    for name, (other, mark) in likes.items():
        kind, others = reading.kinds[name], reading.kinds.get(other)
        if others is None:
            reading.refuse(mark, f"there is no load '{other}'{suggestion(other, reading.kinds)}")
        elif others == "vector":
            reading.refuse(mark, f"load {name} cannot be like {other}, which is given by components")
        elif kind and others and DIMENSION[kind] != DIMENSION[others]:
            reading.refuse(mark, f"load {name} is a {kind} and cannot be like {other}, a {others}")
        elif name in circular:
            reading.refuse(mark, f"load {name} is like {other}, which leads back to {name}")


def _circular(likes: Likes) -> set[str]:
    """The loads that are like each other in a ring; each is walked over once."""
    circular: set[str] = set()
    seen: dict[str, str] = {}
    for start in likes:
        at = start
        while at in likes and at not in seen:
            seen[at] = start
            at = likes[at][0]
        if seen.get(at) == start:
            while at not in circular:
                circular.add(at)
                at = likes[at][0]
    return circular


def _bearer(entry: Entry) -> tuple[str | None, str | None, bool]:
    """The link that a load acts on, the one that it is against, and whether both could be read."""
    link = entry.link("link", "the link that it acts on")
    against = entry.link("against")
    if link is not None and link == against:
        entry.refuse(entry.mark("against"), f"{entry.what} acts on link {link} against itself")
        return link, None, False
    return link, against, link is not None and (against is not None) == entry.has("against")


def _force(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = _bearer(entry)
    at = entry.place("at", f"@{name}", "its point, or [x, y]")
    turns_with = entry.link("turns_with")
    if type(entry.node.items["force"]) is Sequence:
        return _vector(entry, name, link, at, against, turns_with, good)
    heading = _heading(entry)
    read, value = _magnitude(entry, name, kind, likes)
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
    if point is not None and point == _text(entry, "at"):
        entry.refuse(entry.mark(key or ""), f"{entry.what} acts at {point} and cannot point {key} it")
        return None
    return Toward(point, key == "away") if point else None


def _text(entry: Entry, key: str) -> str:
    node = entry.node.items.get(key)
    return node.text if type(node) is Scalar else ""


def _slope(entry: Entry) -> Slope | None:
    pair = entry.pair("slope", "number", "xy", "a run and a rise, as in [-3, 4]")
    if pair and pair[0].value == 0.0 and pair[1].value == 0.0:
        entry.refuse(entry.mark("slope"), f"the slope [0, 0] of {entry.what} has no direction")
        return None
    return Slope(*pair) if pair else None


def _torque(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = _bearer(entry)
    turns = entry.word("turns", ("ccw", "cw"))
    read, value = _magnitude(entry, name, kind, likes)
    if not (good and read and link) or (turns is None and entry.has("turns")):
        return None
    return Torque(name, link, value, turns or "ccw", against)


def _weight(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link = entry.link("link", "the link that it acts on")
    at = entry.place("at", f"@{name}", "its point, or [x, y]")
    read, value = _magnitude(entry, name, kind, likes, "not negative" if kind == "mass" else "")
    return Weight(name, link, at, value, kind == "mass") if read and link and at else None


def _spring(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = _bearer(entry)
    at = entry.place("at", f"@{name}", "the point of its link that it is fixed to, or [x, y]")
    to = entry.place("to", f"@{name}'", "the point of its other end, or [x, y]")
    entry.need("free", "its length without load")
    free = entry.number("free", "length", "not negative")
    read, value = _magnitude(entry, name, kind, likes, "not negative")
    if at is not None and at == to:
        entry.refuse(entry.mark("to"), f"both ends of {entry.what} are at {at}")
        return None
    if not (good and read and link and at and to and free):
        return None
    return Spring(name, link, at, to, value, free, against)


BUILD = {"force": _force, "torque": _torque, "weight": _weight, "mass": _weight, "spring": _spring}
