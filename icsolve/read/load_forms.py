"""An entry of `loads`, planar or in space: its kind, what it acts on, its number, loads like others."""

from __future__ import annotations

from collections.abc import Callable
from collections.abc import Mapping as Table
from typing import Generic, TypeVar

from icsolve.case import Like, Magnitude, Mark, Number
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.keys import LIKE, LOADS, EntryKind
from icsolve.read.names import is_name, shown, suggestion, why_no_name
from icsolve.read.reading import Entry, Reading
from icsolve.tuples import NamedTuple
from icsolve.units import exactly, nearest, quotient, split_quantity

VECTORS = {"force": "vector", "torque": "couple"}
"""Kinds that can be given by components, and what they are called then."""

Likes = dict[str, tuple[str, Mark]]
"""Loads that are like another: its name, and where that stands."""

T = TypeVar("T")


class Forms(NamedTuple, Generic[T]):
    """The kinds of load and what reads each, an example; and why a key has no place here."""

    kinds: Table[str, EntryKind]
    build: Table[str, Callable[[Entry, str, str, Likes], T | list[T] | None]]
    example: str
    elsewhere: Table[str, str]

    def own_keys(self) -> dict[str, None]:
        """The keys by which kinds are known, each once."""
        return dict.fromkeys(kind.key or name for name, kind in self.kinds.items())


def dimension_of(kind: str) -> str:
    """The dimension of the number of a kind of load; of a vector, that of its components; '' for none."""
    whole = {name: key for key, name in VECTORS.items()}.get(kind, kind)
    return LOADS[whole].own.dimension if whole in LOADS else ""


def read_section(reading: Reading, section: Mapping, forms: Forms[T]) -> tuple[T, ...]:
    """The loads that could be read."""
    for key, node in section.items.items():
        reading.kinds[key] = _kind_of(node, forms)
    found: list[T] = []
    likes = Likes()
    for key, node in section.items.items():
        load = _load(reading, key, node, section.keys[key], likes, forms)
        found.extend(load)
    _check_likes(reading, likes)
    return tuple(found)


def _kind_of(node: Node, forms: Forms[T]) -> str:
    """The kind of a load, '' where that is not clear; vectors have their own."""
    kinds = [key for key in node.items if key in forms.own_keys()] if type(node) is Mapping else []
    if len(kinds) != 1 or type(node) is not Mapping:
        return ""
    kind = kinds[0]
    if kind == "spring" and {"corner"} & node.items.keys() and "torsion spring" in forms.kinds:
        return "torsion spring"
    return VECTORS.get(kind, kind) if type(node.items[kind]) is Sequence else kind


def _load(
    reading: Reading, name: str, node: Node, mark: Mark, likes: Likes, forms: Forms[T]
) -> tuple[T, ...]:
    """The load of an entry, none where it can't be read; of an unknown direction, its two components."""
    if not is_name(name):
        reading.refuse(mark, f"{shown(name)} is not a name of a load: {why_no_name(name)}")
        return ()
    mapping = reading.mapping(node, f"load {name}", forms.example)
    if mapping is None:
        return ()
    reading.marks[f"loads.{name}"] = mark
    entry = Entry(reading, mapping, f"loads.{name}", f"load {name}")
    key = _own_key(entry, forms)
    if key is None:
        return ()
    kind = "torsion spring" if reading.kinds[name] == "torsion spring" else key
    entry.keys = {key: forms.kinds[kind].own, **forms.kinds[kind].keys}
    _explain_keys(entry, kind, forms)
    load = forms.build[kind](entry, name, key, likes)
    if load is None:
        return ()
    return tuple(load) if isinstance(load, list) else (load,)


def _own_key(entry: Entry, forms: Forms[T]) -> str | None:
    """The key that says of which kind a load is."""
    own = forms.own_keys()
    key = entry.one_of(own)
    if key is None:
        parts = {key for one in forms.kinds.values() for key in one.keys}
        strange = [key for key in entry.node.items if key not in parts]
        likely = suggestion(strange[0], own) if strange else ""
        mark = entry.mark(strange[0]) if strange else entry.node.mark
        entry.refuse(mark, f"{entry.what} has none of {', '.join(own)}{likely}")
    return key if key and entry.reading.kinds[entry.path.removeprefix("loads.")] else None


def _explain_keys(entry: Entry, kind: str, forms: Forms[T]) -> None:
    """Refuse what this kind has no use for; other kinds' keys are explained."""
    takes = forms.kinds[kind].keys
    others = {*forms.own_keys(), *(key for one in forms.kinds.values() for key in one.keys)}
    told = []
    for key, mark in entry.node.keys.items():
        if key in entry.keys:
            continue
        if key in others:
            said = f"is a {kind}, which has no '{key}'; it takes {', '.join(takes)}"
            entry.refuse(mark, f"{entry.what} {said}")
            told.append(key)
        elif key in forms.elsewhere:
            entry.refuse(mark, f"{entry.what} has no '{key}': {forms.elsewhere[key]}")
            told.append(key)
    entry.check(*told)
    borne = entry.has("link") or entry.has("screw") or word_at(entry, "at") in entry.reading.ends
    if "link" in takes and not takes["link"].needed and not borne:
        entry.need("link", "the link that it acts on")


def magnitude(entry: Entry, name: str, kind: str, likes: Likes) -> tuple[bool, Magnitude]:
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
    own = entry.keys[kind]
    number = entry.value(node, own.dimension, entry.path, kind, own.bound)
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
    inner = Entry(entry.reading, node, entry.path, entry.what, LIKE)
    inner.check()
    target = node.items["like"]
    other = entry.reading.name(target, f"'like' of {entry.what}")
    times = inner.number("times")
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
        elif kind and others and dimension_of(kind) != dimension_of(others):
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
    link, against = entry.link("link"), entry.link("against")
    if link is not None and link == against:
        entry.refuse(entry.mark("against"), f"{entry.what} acts on link {link} against itself")
        return link, None, False
    return link, against, link is not None and (against is not None) == entry.has("against")


def word_at(entry: Entry, key: str) -> str:
    """The text of a key, '' where there is none."""
    node = entry.node.items.get(key)
    return node.text if type(node) is Scalar else ""


def torque_number(entry: Entry) -> Number | None:
    """Power over speed in the case's unit of torque, rounded once; None, with the reason noted.

    Positive power at a positive speed is a positive torque, which drives its link; a negative power is taken
    out of the link.
    """
    node = entry.node.items["power"]
    speed = entry.number("speed")
    if type(node) is Mapping or (type(node) is Scalar and node.text == "unknown"):
        said = "is a number with its unit; what is to find is a torque, `torque: unknown`"
        entry.refuse(node.mark, f"the power of {entry.what} {said}")
        return None
    power = entry.value(node, "power", entry.path, "power")
    if power is None or speed is None or type(node) is not Scalar:
        return None
    if speed.value == 0.0:
        entry.refuse(entry.mark("speed"), f"at the speed 0 {entry.what} would need an endless torque")
        return None
    if power.exact is None:
        entry.refuse(node.mark, f"the power of {entry.what} carries its unit: W, kW or hp")
        return None
    numeral = split_quantity(speed.digits)
    assert numeral is not None
    exact = quotient(power.exact, speed.exact or exactly(numeral[0]))
    value = nearest(exact)
    per_power = value / power.value if power.value else 1.0
    half = abs(per_power) * power.half
    return Number(value, half, entry.path, power.digits, per_power * power.factor, exact)
