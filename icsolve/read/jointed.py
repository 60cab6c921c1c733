"""The list of joints: each of one kind, between links that it names. What a kind takes, its table says."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Container
from collections.abc import Mapping as Table
from itertools import chain, count
from typing import TypeVar

from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.entry import Entry
from icsolve.read.names import is_name
from icsolve.read.problems import nearest, shown, suggestion
from icsolve.read.reading import RESERVED, Reading

T = TypeVar("T")
Builder = Callable[[Entry, tuple[str, ...], bool], T | None]
Kinds = Table[str, tuple[tuple[str, ...], Builder[T]]]
"""Each kind's keys besides its links, and what reads it."""

PLANAR = {
    "pin": "a `hinge` with its `axis`",
    "slide": "bearings with their `axis`",
    "slot": "an unknown force along the normal",
    "roll": "an unknown force along each direction",
    "belt": "a load for the pull of each strand",
    "contact": "an unknown force along the normal",
    "centre": "the joints themselves",
}
"""Kinds that only the plane has, and what stands for each in space."""
SPATIAL = ("ball", "radial", "thrust", "hinge")
"""Kinds that only space has."""
FRICTION = ("mu", "radius", "length")
"""What a joint with friction has: the coefficient, and with it the size of its pin or block."""


def mention_links(reading: Reading, section: Node | None) -> None:
    """The links of all joints, faulty ones too, in order of first mention: other sections know them."""
    if type(section) is not Sequence or not section.items:
        return
    reading.links = {}
    for item in section.items:
        for name in _named(item):
            if is_name(name.text):
                reading.links.setdefault(name.text, name.mark)


def _named(item: Node) -> list[Scalar]:
    """The items of a joint's list of links, whatever the kind is called."""
    if type(item) is not Mapping:
        return []
    kinds = [key for key in item.items if key in NAMES] or list(item.items)[:1]
    return [
        name
        for key in kinds
        if type(value := item.items[key]) is Sequence
        for name in value.items
        if type(name) is Scalar
    ]


NAMES = frozenset((*PLANAR, *SPATIAL, "gears", "weld"))
"""All kinds, of the plane and of space."""


def read_list(reading: Reading, section: Sequence, kinds: Kinds[T], example: str) -> tuple[T, ...]:
    """The joints that could be read."""
    shared = Counter(_at(item) for item in section.items)
    found = []
    for index, item in enumerate(section.items):
        reading.marks[f"joints[{index}]"] = item.mark
        reading.joint_number = index
        node = reading.mapping(item, "a joint", f"as in {example}")
        joint = _joint(reading, node, shared, kinds) if node is not None else None
        if joint is not None:
            found.append(joint)
    return tuple(found)


def _at(item: Node) -> str:
    """The name at which a joint stands, '' where there is none."""
    node = item.items.get("at") if type(item) is Mapping else None
    return node.text if type(node) is Scalar else ""


def _joint(reading: Reading, node: Mapping, shared: Counter[str], kinds: Kinds[T]) -> T | None:
    kind = _kind(reading, node, kinds)
    if kind is None:
        reading.given.add(_at(node))  # it may have been the guide that gives the point
        return None
    if type(node.items[kind]) is Scalar and "links" in node.items:
        node.items["at"] = node.items[kind]
        reading.refuse(node.mark, f"write {_rewritten(node, kind, {kind: kinds[kind]})}")
        return None
    links = _links(reading, kind, node.items[kind])
    pair = "-".join(links) if links else "?"
    at = _at(node)
    where = f"joints.{at}" if shared[at] == 1 and at else f"joints.{pair}@{at}" if at else f"joints.{pair}"
    where = _unlike(where, reading.marks)  # two joints of one pair: a path has one value
    reading.marks[where] = node.mark
    keys, build = kinds[kind]
    name = "gear pair" if kind == "gears" else kind
    entry = Entry(reading, node, where, f"the {name} of {' and '.join(links)}" if links else f"a {name}")
    rubbing = () if "mu" in keys else _rubbing(entry, "hinge" in kinds)
    entry.only(kind, *keys, *rubbing)
    return build(entry, links or ("?", "?"), bool(links))


def _rubbing(entry: Entry, in_space: bool) -> tuple[str, ...]:
    """The keys of friction on a joint that takes none, refused in words."""
    there = tuple(key for key in FRICTION if entry.has(key)) if entry.has("mu") else ()
    if there:
        if in_space:
            said = "friction is solved in the plane only, and this case is in space; take it out"
        else:
            said = "friction is that of a pin, a slide, a slot or a contact; take it out"
        entry.refuse(entry.node.keys["mu"], f"'mu' of {entry.what}: {said}")
    return there


def _unlike(where: str, taken: Container[str]) -> str:
    """The path, with ``#2``, ``#3`` ... behind it where another joint has it already."""
    ways = chain((where,), (f"{where}#{n}" for n in count(2)))
    return next(way for way in ways if way not in taken)


def _kind(reading: Reading, node: Mapping, kinds: Kinds[T]) -> str | None:
    found = [key for key in node.items if key in kinds]
    if len(found) == 1:
        return found[0]
    if len(found) > 1:
        said = f"this one is '{found[0]}' and '{found[1]}'"
        reading.refuse(node.keys[found[1]], f"a joint is of one kind; {said}")
        return None
    parts = {key for keys, _ in kinds.values() for key in keys}
    for key in node.items:
        if key in NAMES:
            reading.refuse(node.keys[key], _elsewhere(key))
            return None
        if key in RESERVED:
            reading.unknown_key(key, node.keys[key], (), "a joint")
            return None
    strange = [key for key in node.items if key not in parts]
    named = [key for key in ("type", "kind", "joint") if key in node.items]
    if named:
        form = _rewritten(node, named[0], kinds)
        reading.refuse(node.keys[named[0]], f"a joint is named by its kind; write {form}")
        return None
    first = strange[0] if strange else None
    likely = suggestion(first, kinds) if first else ""
    mark = node.keys[first] if first else node.mark
    said = f"there is no joint kind {shown(first)}" if first else "this joint has no kind"
    reading.refuse(mark, said + (likely or f"; the kinds are {', '.join(kinds)}"))
    return None


def _rewritten(node: Mapping, said: str, kinds: Kinds[T]) -> str:
    """A joint that was written with a key for its kind, as the format has it."""
    word, at = node.items[said], _at(node) or "A"
    links = next((value for value in node.items.values() if type(value) is Sequence), None)
    names = [item.text for item in links.items if type(item) is Scalar] if links else ["1", "2"]
    kind = nearest(word.text, kinds) if type(word) is Scalar else ""
    return f"{{{kind or 'pin'}: [{', '.join(names)}], at: {at}}}"


def _elsewhere(kind: str) -> str:
    """A joint of the plane in space, or the other way round."""
    if kind in SPATIAL:
        return (
            f"a '{kind}' is a joint in space, and the points of this case have two coordinates: give each as "
            f"[x, y, z], or take a joint of the plane{', a pin' if kind == 'hinge' else ''}"
        )
    return (
        f"a '{kind}' is a joint of the plane, and the points of this case have three coordinates: in space "
        f"its place is taken by {PLANAR[kind]}"
    )


def _links(reading: Reading, kind: str, node: Node) -> tuple[str, ...] | None:
    """The names of a joint's links: two, of a pin two or more, all different."""
    items = reading.names(node, f"the links of a {kind}", f"{{{kind}: [1, 2]}}")
    if items is None:
        return None
    links = tuple(item.text for item in items)
    if len(set(links)) < len(links):
        reading.refuse(node.mark, f"a {kind} joins different links; {_twice(links)} is named twice")
    elif len(links) < 2:
        reading.refuse(node.mark, f"a {kind} joins two links; only {links[0] if links else 'none'} is named")
    elif len(links) > 2 and kind != "pin":
        reading.refuse(node.mark, f"a {kind} joins two links; {len(links)} are named")
    else:
        return links
    return None


def _twice(links: tuple[str, ...]) -> str:
    return next(link for link in links if links.count(link) > 1)
