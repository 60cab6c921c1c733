"""The section of loads: each of one kind, with the keys that its kind takes. What reads it, a table says."""

from collections.abc import Callable
from collections.abc import Mapping as Table
from typing import Generic, NamedTuple, TypeVar

from icsolve.case import Like, Magnitude, Mark
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.entry import Entry
from icsolve.read.names import is_name, why_no_name
from icsolve.read.problems import shown, suggestion
from icsolve.read.reading import RESERVED, Reading

DIMENSION = {
    "force": "force",
    "torque": "torque",
    "weight": "force",
    "mass": "mass",
    "spring": "stiffness",
    "power": "torque",
}
"""Kinds of load, and the dimension of each one's number (power at a speed is a torque)."""

VECTORS = {"force": "vector", "torque": "couple"}
"""Kinds that can be given by components, and what they are called then."""

Likes = dict[str, tuple[str, Mark]]
"""Loads that are like another: its name, and where that stands."""
T = TypeVar("T")


class Forms(NamedTuple, Generic[T]):
    """What each kind takes besides its number, what reads it, an example; and why a key has no place here."""

    keys: Table[str, tuple[str, ...]]
    build: Table[str, Callable[[Entry, str, str, Likes], T | None]]
    example: str
    elsewhere: Table[str, str]


def read_section(reading: Reading, section: Mapping, forms: Forms[T]) -> tuple[T, ...]:
    """The loads that could be read."""
    for key, node in section.items.items():
        reading.kinds[key] = _kind_of(node, forms)
    found, likes = [], Likes()
    for key, node in section.items.items():
        load = _load(reading, key, node, section.keys[key], likes, forms)
        if load is not None:
            found.append(load)
    _check_likes(reading, likes)
    return tuple(found)


def _kind_of(node: Node, forms: Forms[T]) -> str:
    """The kind of a load, '' where that is not clear; vectors have their own."""
    kinds = [key for key in node.items if key in forms.keys] if type(node) is Mapping else []
    if len(kinds) != 1 or type(node) is not Mapping:
        return ""
    kind = kinds[0]
    return VECTORS.get(kind, kind) if type(node.items[kind]) is Sequence else kind


def _load(reading: Reading, name: str, node: Node, mark: Mark, likes: Likes, forms: Forms[T]) -> T | None:
    if not is_name(name):
        reading.refuse(mark, f"{shown(name)} is not a name of a load: {why_no_name(name)}")
        return None
    mapping = reading.mapping(node, f"load {name}", forms.example)
    if mapping is None:
        return None
    reading.marks[f"loads.{name}"] = mark
    entry = Entry(reading, mapping, f"loads.{name}", f"load {name}")
    kind = _kind(entry, forms)
    if kind is None:
        return None
    _check_keys(entry, kind, forms)
    return forms.build[kind](entry, name, kind, likes)


def _kind(entry: Entry, forms: Forms[T]) -> str | None:
    kind = entry.one_of(forms.keys)
    if kind is None:
        parts = {key for keys in forms.keys.values() for key in keys}
        strange = [key for key in entry.node.items if key not in parts]
        known = strange and strange[0] not in RESERVED
        likely = suggestion(strange[0], forms.keys) if known else ""
        if strange and not known:
            entry.reading.unknown_key(strange[0], entry.mark(strange[0]), (), entry.what)
        else:
            mark = entry.mark(strange[0]) if strange else entry.node.mark
            entry.refuse(mark, f"{entry.what} has none of {', '.join(forms.keys)}{likely}")
    return kind if kind and entry.reading.kinds[entry.path.removeprefix("loads.")] else None


def _check_keys(entry: Entry, kind: str, forms: Forms[T]) -> None:
    """Refuse what this kind has no use for; other kinds' keys are explained."""
    takes = forms.keys[kind]
    others = {key for keys in forms.keys.values() for key in keys}
    for key, mark in list(entry.node.keys.items()):
        if key == kind or key in takes:
            continue
        if key in others:
            said = f"is a {kind}, which has no '{key}'; it takes {', '.join(takes)}"
            entry.refuse(mark, f"{entry.what} {said}")
        elif key in forms.elsewhere:
            entry.refuse(mark, f"{entry.what} has no '{key}': {forms.elsewhere[key]}")
        else:
            entry.reading.unknown_key(key, mark, (kind, *takes), entry.what)
            entry.reading.take_for(entry.node, key, takes)


def magnitude(entry: Entry, name: str, kind: str, likes: Likes, bound: str = "") -> tuple[bool, Magnitude]:
    """Whether the number could be read, and the number: None for the unknown."""
    node = entry.node.items[kind]
    entry.reading.marks[entry.path] = node.mark
    if type(node) is Scalar and node.text == "unknown":
        return True, None
    if type(node) is Scalar and node.text.strip().lower() in _WANTED:
        entry.refuse(node.mark, f"write 'unknown' for what is to find, {kind}: unknown")
        return False, None
    if type(node) is Mapping and "like" not in node.items:
        entry.refuse(node.mark, _no_mapping(kind, node))
        return False, None
    if type(node) is Sequence and [type(one) is Scalar and one.text for one in node.items] == ["unknown"]:
        entry.refuse(node.mark, f"write it without brackets, {kind}: unknown")
        return False, None
    if type(node) is Mapping:
        like = _like(entry, name, node, likes)
        return like is not None, like
    number = entry.value(node, DIMENSION[kind], entry.path, kind, bound)
    return number is not None, number


_WANTED = (
    "?",
    "??",
    "???",
    "x",
    "find",
    "to find",
    "wanted",
    "solve",
    "tbd",
    "unk",
    "required",
    "to be found",
)
"""What people write for the unknown."""


def _no_mapping(kind: str, node: Mapping) -> str:
    """A mapping in place of a number: what it may have been."""
    parts = [node.items[key] for key in ("value", "magnitude", "size", "unit", "units") if key in node.items]
    text = (
        " ".join(part.text for part in parts if type(part) is Scalar) or next(iter(node.items), "") or "100"
    )
    return f"a number stands here without braces, '{kind}: {text}', or the name of another load, {{like: M2}}"


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
        elif others in VECTORS.values():
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


def bearer(entry: Entry) -> tuple[str | None, str | None, bool]:
    """The link that a load acts on, the one that it is against, and whether both could be read."""
    link = entry.link("link", "the link that it acts on")
    against = entry.link("against")
    if link is not None and link == against:
        entry.refuse(entry.mark("against"), f"{entry.what} acts on link {link} against itself")
        return link, None, False
    return link, against, link is not None and (against is not None) == entry.has("against")


def word_at(entry: Entry, key: str) -> str:
    """The text of a key, '' where there is none."""
    node = entry.node.items.get(key)
    return node.text if type(node) is Scalar else ""
