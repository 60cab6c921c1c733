"""Joints: each of one kind, between links that it names, where it stands."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Container
from collections.abc import Mapping as Table
from itertools import chain, count
from typing import TYPE_CHECKING, Any

from icsolve.case import (
    Belt,
    Contact,
    Friction,
    Gears,
    Guide,
    Helix,
    Joint,
    KnownCentre,
    Number,
    Pair,
    Pin,
    Roll,
    Screw,
    Slide,
    Slot,
    Thread,
    Weld,
)
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.entry import Entry, Values
from icsolve.read.keys import (
    HELICAL,
    HELIX,
    LINKS,
    PRESSURE_ANGLE,
    SPACE_JOINTS,
    TEETH,
    TOOTH_ANGLES,
    TOOTH_FORM,
    TOOTH_SIZES,
    EntryKind,
    Key,
    Rule,
    needed,
    quantity_key,
)
from icsolve.read.names import is_name, meant_by, shown, suggestion
from icsolve.read.reading import Reading
from icsolve.tuples import TypeVar
from icsolve.wording import listed

if TYPE_CHECKING:
    from icsolve.case.space import Teeth

T = TypeVar("T")
Builders = Table[str, Callable[[Entry, Any, Values], T | None]]
"""What makes each kind of joint of its links and values, where nothing was wrong with them."""


def mention_links(reading: Reading, section: Node | None) -> None:
    """The links of all joints, faulty ones too, in order of first mention: other sections know them."""
    if type(section) is not Sequence or not section.items or any(type(n) is Scalar for n in section.items):
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
    where = unlike(where, reading.marks)  # two joints of one pair: a path has one value
    reading.marks[where] = node.mark
    keys = kinds[kind].keys
    name = "gear pair" if kind == "gears" else kind
    what = f"the {name} of {' and '.join(links)}" if links else f"a {name}"
    entry = Entry(reading, node, where, what, keys, kinds[kind].ties, f"@{pair}")
    if kind == "contact":
        _need_place(entry, links)
    values = entry.read(kind, *_rubbing(entry, "hinge" in kinds))
    if "along" in keys:
        _note_guide(reading, values)
    if entry.whole and links:
        return builders[kind](entry, links, values)
    if kind == "screw" and links:
        reading.unread.add(frozenset(links))
    return None


def _need_place(entry: Entry, links: tuple[str, ...] | None) -> None:
    """A contact says where it is, or the profiles of both its links do."""
    if links and not entry.has("at") and {*links} <= entry.reading.profiled:
        return
    into = f" from {links[0]} into {links[1]}" if links else ""
    entry.need("at")
    entry.need("normal", entry.keys["normal"].says + into)


def _note_guide(reading: Reading, values: Values) -> None:
    """A guide gives its joint's own point, and lies on others."""
    if values["at"]:
        reading.given.add(values["at"])
    ends = values["along"] if not isinstance(values["along"], Number) else None
    reading.on_guides.extend([*(ends or ()), *([values["through"]] if values["through"] else [])])


def _rubbing(entry: Entry, in_space: bool) -> tuple[str, ...]:
    """The keys of friction on a joint that takes none, refused in words."""
    if "mu" in entry.keys or not entry.has("mu"):
        return ()
    if in_space:
        said = "friction is solved in the plane only, and this case is in space; take it out"
    else:
        said = "friction is that of a pin, a slide, a slot or a contact; take it out"
    entry.refuse(entry.mark("mu"), f"'mu' of {entry.what}: {said}")
    return ("mu", "radius", "length")


def unlike(where: str, taken: Container[str]) -> str:
    """The path, with ``#2``, ``#3`` ... behind it where another joint or rope has it already."""
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
        twice = next(link for link in links if links.count(link) > 1)
        reading.refuse(node.mark, f"a {kind} joins different links; {twice} is named twice")
    elif len(links) < 2:
        reading.refuse(node.mark, f"a {kind} joins two links; only {links[0] if links else 'none'} is named")
    elif len(links) > 2 and kind != "pin":
        reading.refuse(node.mark, f"a {kind} joins two links; {len(links)} are named")
    else:
        return links
    return None


_AT = Key("its point", "name", True)
_MU = quantity_key("the coefficient of friction", "number", "not negative")
_ALONG = Key("a direction in degrees, or two points of the guide as in [A, G]", "line", True, "angle")
_THROUGH = Key("a point of the guide line; left out, the line of the two points, or `at` itself")
_RADII = Key("the two radii, as in [3, 5]", "pair", False, "length", "positive")
_CARRIER = Key("the link to which both are pinned, where several could be", "link")
JOINTS = {
    "pin": EntryKind(
        "a revolute: its links turn about one point",
        Key("the links that it joins, two or more", "links", True),
        {
            "at": needed(_AT, "the point about which its links turn"),
            "mu": _MU,
            "radius": quantity_key("the pin's own radius, for its friction", "length", "positive"),
        },
        "a `hinge` with its `axis`",
        ties=(Rule("needs", ("mu", "radius"), "friction of {what} needs 'radius', the pin's own"),),
    ),
    "slide": EntryKind(
        "a prismatic: the block, named first, on a guide of the second link",
        LINKS,
        {
            "at": needed(_AT, "the point of the block"),
            "along": _ALONG,
            "through": _THROUGH,
            "mu": _MU,
            "length": quantity_key("the block's own length: its two ends rub", "length", "positive"),
        },
        "bearings with their `axis`",
    ),
    "slot": EntryKind(
        "a pin of the first link in a slot of the second",
        LINKS,
        {"at": needed(_AT, "the pin's point"), "along": _ALONG, "through": _THROUGH, "mu": _MU},
        "an unknown force along the normal",
    ),
    "roll": EntryKind(
        "rolling without slip; a rack and its pinion",
        LINKS,
        {
            "at": needed(_AT, "the point of contact"),
            "radii": Key(
                "the two radii, as in [1.5, 0], where it is to move; 0 straight, negative inside",
                "pair",
                False,
                "length",
                "one positive",
            ),
            "pressure angle": PRESSURE_ANGLE,
        },
        "an unknown force along each direction",
    ),
    "gears": EntryKind(
        "a mesh; their pivots are the pins of both to one carrier",
        LINKS,
        {
            "teeth": Key(
                "the two numbers of teeth, as in [31, 57], or [31, -92] where 92 are internal",
                "counts",
                True,
                "number",
            ),
            "carrier": _CARRIER,
            **TEETH,
            **HELIX,
            "bearing span": quantity_key("the distance of each shaft's bearings", "length", "positive"),
        },
        ties=(
            *TOOTH_FORM,
            *(Rule("needs", (key, "helix angle")) for key in HELICAL if key != "helix angle"),
        ),
    ),
    "belt": EntryKind(
        "a belt or chain over two pulleys that are pinned to one carrier",
        LINKS,
        {
            "radii": needed(_RADII),
            "carrier": _CARRIER,
            "crossed": Key("whether the belt is crossed: yes or no", "truth"),
        },
        "a load for the pull of each strand",
    ),
    "contact": EntryKind(
        "a contact that rolls and slips, as of a cam; without `at` and `normal` by the links' profiles",
        LINKS,
        {
            "at": Key("the point of contact"),
            "normal": quantity_key("the direction of the common normal in degrees", "angle"),
            "mu": _MU,
        },
        "an unknown force along the normal",
    ),
    "centre": EntryKind(
        "a relative centre that is known, without the joints between",
        LINKS,
        {
            "at": Key("its place, or 'toward', its direction where it is at infinity", "place"),
            "toward": quantity_key("its direction in degrees, where it is at infinity", "angle"),
        },
        "the joints themselves",
        ties=(Rule("one", ("at", "toward")),),
    ),
    "weld": EntryKind(
        "two links that move as one", LINKS, {"at": Key("the point that its reaction is given for")}
    ),
    "rope": EntryKind(
        "a rope: fixed at its ends, over pulleys in between",
        Key("the points that it runs through, as in [A, P, B]", "points of a rope", True),
        {
            "on": Key(
                "the link at each of its points, in order; the last left out where loads pull its end",
                "links of a rope",
                True,
            ),
            "radii": Key("radii of pulleys and drums, as in {P: 0.1}", "sizes", False, "length", "positive"),
            "wraps": Key("the sense in which one goes round each, as in {P: ccw}", "senses"),
            "mu": Key("friction where it slips, as in {P: 0.3}", "numbers", False, "number", "not negative"),
            "turns": Key(
                "whole turns beside the angle that the figure shows, as in {P: 2}",
                "numbers",
                False,
                "number",
                "turns",
            ),
            "length": quantity_key("its own length, where the figure leaves it open", "length", "positive"),
        },
        "loads for its pull on each link",
    ),
    "screw": EntryKind(
        "a screw: the second link moves on the first along its axis, as far as a torque load turns it",
        LINKS,
        {
            "at": needed(_AT, "the point of the second link"),
            "along": _ALONG,
            "through": _THROUGH,
            "lead": Key("how far it moves in a turn", "quantity", True, "length", "positive"),
            "radius": quantity_key("the thread's mean radius, for its friction", "length", "positive"),
            "mu": _MU,
        },
        "a hinge and a load for its force",
        ties=(
            Rule("needs", ("mu", "radius"), "friction of {what} needs 'radius', the mean one of its thread"),
        ),
    ),
}
"""Joints of the plane."""
NAMES = frozenset((*JOINTS, *SPACE_JOINTS))
"""All kinds, of the plane and of space."""


def read_joints(reading: Reading, section: Sequence) -> tuple[Joint, ...]:
    """The joints of a planar case that could be read."""
    joints: tuple[Joint, ...] = read_list(reading, section, JOINTS, BUILDERS, "{pin: [1, 2], at: B}")
    pins = Counter((frozenset(joint.links), joint.pivot) for joint in joints if joint.pivot)
    for (links, at), times in pins.items():
        if times > 1:
            reading.noticed.append(f"the pin of {listed(sorted(links))} at {at} is given more than once.")
    return joints


def _friction(values: Values) -> Friction | None:
    """``mu``, with the pin's ``radius`` or the block's ``length``."""
    return Friction(values["mu"], values.get("radius"), values.get("length")) if values["mu"] else None


def _guide(values: Values) -> Guide:
    """The guide line."""
    along = values["along"]
    angle, ends = (along, None) if isinstance(along, Number) else (None, along)
    return Guide(angle, ends, values["through"])


def _gears(entry: Entry, links: Pair, v: Values) -> Joint | None:
    if not _is_apart(entry, links, v):
        return None
    if any(key in HELICAL for key in entry.node.items):
        return _helical(entry, links, v)
    return Gears(links, v["teeth"], v["carrier"], v["pressure angle"], v["diametral pitch"], v["module"])


def _is_apart(entry: Entry, links: Pair, v: Values) -> bool:
    """Whether the carrier of two wheels is a third link."""
    if v["carrier"] in links:
        entry.refuse(entry.mark("carrier"), f"the carrier of {entry.what} is a third link")
    return v["carrier"] not in links


def _belt(entry: Entry, links: Pair, v: Values) -> Joint | None:
    return Belt(links, v["radii"], bool(v["crossed"]), v["carrier"]) if _is_apart(entry, links, v) else None


def _contact(entry: Entry, links: Pair, v: Values) -> Joint | None:
    """A contact; one whose place the profiles of its links give stands apart from the joints until then."""
    if v["at"] is not None:
        return Contact(links, v["at"], v["normal"], _friction(v))
    from icsolve.case.profiles import Touch

    touch = Touch(links, entry.reading.joint_number, v["normal"], _friction(v))
    entry.reading.touches.append((touch, entry.node.mark))
    return None


def _screw(entry: Entry, links: Pair, v: Values) -> Joint:
    """The slide of a screw that a torque turns; the weld of one that is locked."""
    if frozenset(links) not in entry.reading.driven:
        load = f"{{torque: unknown, screw: {'-'.join(links)}}}"
        entry.reading.noticed.append(f"{entry.what} is locked, as no load turns it: {load} would.")
        return Weld(links, v["at"])
    thread = Thread(v["lead"], v["radius"], v["mu"])
    slide = Slide((links[1], links[0]), v["at"], _guide(v), thread=thread)
    entry.reading.screws.append(Screw(slide, thread))
    return slide


BUILDERS: Builders[Joint] = {
    "pin": lambda _, links, v: Pin(links, v["at"], _friction(v)),
    "slide": lambda _, links, v: Slide(links, v["at"], _guide(v), _friction(v)),
    "slot": lambda _, links, v: Slot(links, v["at"], _guide(v), _friction(v)),
    "roll": lambda _, links, v: Roll(links, v["at"], v["radii"], v["pressure angle"]),
    "gears": _gears,
    "belt": _belt,
    "contact": _contact,
    "centre": lambda _, links, v: KnownCentre(links, v["at"], v["toward"]),
    "weld": lambda _, links, v: Weld(links, v["at"]),
    "screw": _screw,
}


# --- the form of teeth -----------------------------------------------------------------------------------


def _helical(entry: Entry, links: Pair, v: Values) -> Gears | None:
    """A mesh of the plane with helical teeth: what is given in their normal section is turned into it."""
    teeth = read_teeth(entry, v, False)
    if teeth is None or teeth.helix_angle is None:
        return None
    helix = Helix(teeth.helix_angle, v["bearing span"], teeth.normal_angle, teeth.normal_pitch)
    size = (teeth.diametral_pitch, teeth.module)
    return Gears(links, v["teeth"], v["carrier"], teeth.pressure_angle, *size, helix)


def read_teeth(entry: Entry, values: Values, pitch_needed: bool) -> Teeth | None:
    """The teeth of a mesh; None, with the reason noted, where they can't be read.

    With a helix angle the pressure angle and the pitch say in which section they are meant: square to the
    teeth (``normal``) or in the plane of the wheel (``transverse``).
    """
    from icsolve.case.space import Teeth

    angle_key = next((key for key in TOOTH_ANGLES if entry.has(key)), "")
    size_key = next((key for key in TOOTH_SIZES if entry.has(key)), "")
    helical = entry.has("helix angle")
    if not angle_key:
        said = "that of the teeth, such as 20" + (", or 'transverse pressure angle'" if helical else "")
        entry.need("normal pressure angle" if helical else "pressure angle", said)
    if not size_key and pitch_needed:
        said = "or 'module': it gives the pitch circle of a gear whose mate is not shown"
        entry.need("diametral pitch", said)
    for key in (angle_key, size_key):
        _check_section(entry, key, helical)
    if not entry.whole:
        return None
    size = values[size_key] if size_key else None
    pitch, module = (size, None) if size_key.endswith("pitch") else (None, size)
    normal_angle, normal_size = (key.startswith("normal") for key in (angle_key, size_key))
    helix, hand = values["helix angle"], values["hand"] or "right"
    return Teeth(values[angle_key], normal_angle, helix, hand, pitch, module, normal_size)


def _check_section(entry: Entry, key: str, helical: bool) -> None:
    """Straight teeth have one section; of a helix one must say which."""
    if not key or key.startswith(("normal", "transverse")) == helical:
        return
    if helical:
        said = f"with a helix angle say whether it is the 'normal {key}' or the 'transverse {key}'"
    else:
        kind = key.partition(" ")[2]
        said = f"straight teeth have one {kind}; without a helix angle leave out the first word"
    entry.refuse(entry.mark(key), f"'{key}' of {entry.what}: {said}")
