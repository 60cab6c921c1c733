"""Joints: each of one kind, between links that it names, where it stands."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Container
from collections.abc import Mapping as Table
from itertools import chain, count
from typing import TypeVar

from icsolve.case import (
    Belt,
    Contact,
    Friction,
    Gears,
    Guide,
    Joint,
    KnownCentre,
    Number,
    Pin,
    Roll,
    Screw,
    Slide,
    Slot,
    Thread,
    Weld,
)
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.keys import HELICAL, JOINTS, SPACE_JOINTS, EntryKind
from icsolve.read.names import is_name, meant_by, shown, suggestion
from icsolve.read.reading import Entry, Reading

T = TypeVar("T")
Builder = Callable[[Entry, tuple[str, ...], bool], T | None]
Builders = Table[str, Builder[T]]
"""What reads each kind of joint."""

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
    kinds = ["on" if key == "rope" else key for key in kinds]
    return [
        name
        for key in kinds
        if type(value := item.items.get(key)) is Sequence
        for name in value.items
        if type(name) is Scalar
    ]


NAMES = frozenset((*JOINTS, *SPACE_JOINTS))
"""All kinds, of the plane and of space."""


def read_list(
    reading: Reading, section: Sequence, kinds: Table[str, EntryKind], builders: Builders[T], example: str
) -> tuple[T, ...]:
    """The joints that could be read."""
    shared = Counter(_at(item) for item in section.items)
    found = []
    for index, item in enumerate(section.items):
        reading.marks[f"joints[{index}]"] = item.mark
        reading.joint_number = index
        node = reading.mapping(item, "a joint", f"as in {example}")
        joint = _joint(reading, node, shared, kinds, builders) if node is not None else None
        if joint is not None:
            found.append(joint)
    return tuple(found)


def _at(item: Node) -> str:
    """The name at which a joint stands, '' where there is none."""
    node = item.items.get("at") if type(item) is Mapping else None
    return node.text if type(node) is Scalar else ""


def _joint(
    reading: Reading, node: Mapping, shared: Counter[str], kinds: Table[str, EntryKind], builders: Builders[T]
) -> T | None:
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
    keys = kinds[kind].keys
    name = "gear pair" if kind == "gears" else kind
    what = f"the {name} of {' and '.join(links)}" if links else f"a {name}"
    entry = Entry(reading, node, where, what, keys)
    rubbing = () if "mu" in keys else _rubbing(entry, "hinge" in kinds)
    entry.check(kind, *rubbing)
    return builders[kind](entry, links or ("?", "?"), bool(links))


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


def _kind(reading: Reading, node: Mapping, kinds: Table[str, EntryKind]) -> str | None:
    found = [key for key in node.items if key in kinds]
    if len(found) == 1:
        return found[0]
    if len(found) > 1:
        said = f"this one is '{found[0]}' and '{found[1]}'"
        reading.refuse(node.keys[found[1]], f"a joint is of one kind; {said}")
        return None
    parts = {key for kind in kinds.values() for key in kind.keys}
    for key in node.items:
        if key in NAMES:
            reading.refuse(node.keys[key], _elsewhere(key))
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


def _rewritten(node: Mapping, said: str, kinds: Table[str, EntryKind]) -> str:
    """A joint that was written with a key for its kind, as the format has it."""
    word, at = node.items[said], _at(node) or "A"
    links = next((value for value in node.items.values() if type(value) is Sequence), None)
    names = [item.text for item in links.items if type(item) is Scalar] if links else ["1", "2"]
    kind = meant_by(word.text, kinds) if type(word) is Scalar else ""
    return f"{{{kind or 'pin'}: [{', '.join(names)}], at: {at}}}"


def _elsewhere(kind: str) -> str:
    """A joint of the plane in space, or the other way round."""
    if kind not in JOINTS:
        return (
            f"a '{kind}' is a joint in space, and the points of this case have two coordinates: give each as "
            f"[x, y, z], or take a joint of the plane{', a pin' if kind == 'hinge' else ''}"
        )
    return (
        f"a '{kind}' is a joint of the plane, and the points of this case have three coordinates: in space "
        f"its place is taken by {JOINTS[kind].instead}"
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


Pair = tuple[str, str]


def read_joints(reading: Reading, section: Sequence) -> tuple[Joint, ...]:
    """The joints of a planar case that could be read."""
    return read_list(reading, section, JOINTS, BUILDERS, "{pin: [1, 2], at: B}")


def _friction(entry: Entry) -> Friction | None:
    """``mu``, with the pin's ``radius`` or the block's ``length``."""
    mu = entry.number("mu")
    sizes = {key: entry.number(key) for key in ("radius", "length") if key in entry.keys}
    return Friction(mu, **sizes) if mu is not None else None


def _pin(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    at, friction = entry.point("at"), _friction(entry)
    if entry.has("mu") and not entry.has("radius"):
        entry.refuse(entry.mark("mu"), f"friction of {entry.what} needs 'radius', the pin's own")
    return Pin(links, at, friction) if at and whole else None


def _slide(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    at = entry.point("at")
    guide, friction = read_guide(entry, at), _friction(entry)
    return Slide(_two(links), at, guide, friction) if at and guide and whole else None


def _slot(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    at = entry.point("at")
    guide, friction = read_guide(entry, at), _friction(entry)
    return Slot(_two(links), at, guide, friction) if at and guide and whole else None


def _two(links: tuple[str, ...]) -> Pair:
    return links[0], links[1]


def read_guide(entry: Entry, at: str | None) -> Guide | None:
    """The guide line; its joint's own point is then given by it."""
    if at:
        entry.reading.given.add(at)
    along, through = entry.node.items.get("along"), entry.point("through")
    if along is None or (entry.has("through") and through is None):
        return None
    if type(along) is not Sequence:
        angle, ends = entry.number("along"), None
    else:
        angle, ends = None, entry.two_points("along", "[A, G]")
    entry.reading.on_guides.extend([*(ends or ()), *([through] if through else [])])
    return Guide(angle, ends, through) if angle is not None or ends else None


def _roll(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    at = entry.point("at")
    radii = entry.pair("radii", "01", _RADII) if entry.has("radii") else None
    if radii and max(radius.value for radius in radii) <= 0.0:
        entry.refuse(entry.mark("radii"), f"one of the radii of {entry.what} should be greater than zero")
    angle = _pressure_angle(entry)
    return Roll(_two(links), at, radii, angle) if at and whole else None


_RADII = "two radii, as in [1.5, 3]"


def _pressure_angle(entry: Entry) -> Number | None:
    angle = entry.number("pressure angle")
    if angle is not None and angle.value >= 90.0:
        entry.refuse(entry.mark("pressure angle"), "a pressure angle is less than 90 degrees")
    return angle


def _gears(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    teeth, carrier = _teeth(entry), _carrier(entry, links)
    if any(key in HELICAL for key in entry.node.items):
        from icsolve.read.teeth import read_helical

        form = read_helical(entry)
        return Gears(_two(links), teeth, carrier, *form) if teeth and form and whole else None
    entry.one_of(("diametral pitch", "module"))
    angle = _pressure_angle(entry)
    pitch, module = entry.number("diametral pitch"), entry.number("module")
    return Gears(_two(links), teeth, carrier, angle, pitch, module) if teeth and whole else None


MOST_TEETH = 1e9


def _teeth(entry: Entry) -> tuple[Number, Number] | None:
    teeth = entry.pair("teeth", "01") if entry.has("teeth") else None
    return teeth if teeth is not None and whole_teeth(entry, teeth) else None


def whole_teeth(entry: Entry, counts: tuple[Number, ...]) -> bool:
    """Whether numbers of teeth are whole, and internal teeth surround external ones."""
    values = [count.value for count in counts]
    if any(value == 0.0 or abs(value) > MOST_TEETH or value != int(value) for value in values):
        entry.refuse(entry.mark("teeth"), f"the teeth of {entry.what} should be whole numbers other than 0")
    elif max(values) < 0.0:
        entry.refuse(entry.mark("teeth"), f"only one gear of {entry.what} can be internal (negative)")
    elif min(values) < 0.0 and abs(min(values)) <= max(values):
        entry.refuse(entry.mark("teeth"), "an internal gear has more teeth than the one inside it")
    else:
        return True
    return False


def _carrier(entry: Entry, links: tuple[str, ...]) -> str | None:
    carrier = entry.link("carrier")
    if carrier in links:
        entry.refuse(entry.mark("carrier"), f"the carrier of {entry.what} is a third link")
    return carrier


def _belt(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    carrier = _carrier(entry, links)
    crossed = (entry.word("crossed", ("true", "false", "True", "False")) or "").lower() == "true"
    radii = entry.pair("radii", "01", _RADII) if entry.has("radii") else None
    if radii and min(radius.value for radius in radii) <= 0.0:
        entry.refuse(entry.mark("radii"), f"the radii of {entry.what} should be greater than zero")
    return Belt(_two(links), radii, crossed, carrier) if radii and whole else None


def _contact(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    if whole and not entry.has("at") and {*links} <= entry.reading.profiled:
        _touch(entry, links)
        return None
    into = f" from {links[0]} into {links[1]}" if whole else ""
    entry.need("at")
    entry.need("normal", entry.keys["normal"].says + into)
    at, normal, friction = entry.point("at"), entry.number("normal"), _friction(entry)
    return Contact(_two(links), at, normal, friction) if at and normal is not None and whole else None


def _touch(entry: Entry, links: tuple[str, ...]) -> None:
    """A contact whose place the profiles of its links give; it stands apart from the joints until then."""
    from icsolve.case.profiles import Touch

    touch = Touch(_two(links), entry.reading.joint_number, entry.number("normal"), _friction(entry))
    entry.reading.touches.append((touch, entry.node.mark))


def _centre(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    both = entry.one_of(("at", "toward"))
    if both is None:
        entry.need("at")
    if both == "toward":
        toward = entry.number("toward")
        return KnownCentre(_two(links), None, toward) if toward is not None and whole else None
    at = entry.place("at", f"@{'-'.join(links)}") if both else None
    return KnownCentre(_two(links), at) if at and whole else None


def _weld(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    at = entry.point("at")
    return Weld(_two(links), at) if whole else None


def _screw(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
    """The slide of a screw that a torque turns; the weld of one that is locked."""
    at = entry.point("at")
    guide = read_guide(entry, at)
    lead, radius, mu = entry.number("lead"), entry.number("radius"), entry.number("mu")
    if entry.has("mu") and not entry.has("radius"):
        entry.refuse(entry.mark("mu"), f"friction of {entry.what} needs 'radius', the mean one of its thread")
    if not (at and guide and lead and whole) or (entry.has("mu") and radius is None):
        return None
    pair = (links[0], links[1])
    if frozenset(pair) not in entry.reading.driven:
        return Weld(pair, at)
    slide = Slide((pair[1], pair[0]), at, guide, thread=Thread(lead, radius, mu))
    entry.reading.screws.append(Screw(slide, Thread(lead, radius, mu)))
    return slide


BUILDERS: Builders[Joint] = {
    "pin": _pin,
    "slide": _slide,
    "slot": _slot,
    "roll": _roll,
    "gears": _gears,
    "belt": _belt,
    "contact": _contact,
    "centre": _centre,
    "weld": _weld,
    "screw": _screw,
}
