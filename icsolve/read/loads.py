"""Loads of the plane, each known, unknown or like another; power at a speed; the given motion."""

from __future__ import annotations

from collections.abc import Callable
from collections.abc import Mapping as Table
from typing import Generic, NamedTuple, TypeVar

from icsolve.case import (
    Area,
    Force,
    ForceVector,
    Heading,
    Like,
    Load,
    Magnitude,
    Mark,
    Motion,
    Number,
    Slope,
    Spring,
    Stretch,
    Torque,
    TorsionSpring,
    Toward,
    Weight,
)
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.keys import DIRECTION, LIKE, LOADS, MOTION, Kind
from icsolve.read.names import is_name, point_key, shown, suggestion, why_no_name
from icsolve.read.reading import Entry, Reading
from icsolve.units import exact_ratio, exactly, nearest, quotient, split_quantity, times

VECTORS = {"force": "vector", "torque": "couple"}
"""Kinds that can be given by components, and what they are called then."""

Likes = dict[str, tuple[str, Mark]]
"""Loads that are like another: its name, and where that stands."""
T = TypeVar("T")


class Forms(NamedTuple, Generic[T]):
    """The kinds of load and what reads each, an example; and why a key has no place here."""

    kinds: Table[str, Kind]
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


_ELSEWHERE = {
    "along": "that is for a case in space, whose points have three coordinates; here it is `angle`, "
    "`toward`, `away` or `slope`"
}


def read_loads(reading: Reading, section: Mapping) -> tuple[Load, ...]:
    """The loads of a planar case that could be read."""
    return read_section(reading, section, PLANE)


def _force(entry: Entry, name: str, kind: str, likes: Likes) -> Load | list[Load] | None:
    if not entry.has("link") and word_at(entry, "at") in entry.reading.ends:
        from icsolve.read.ropes import read_pull

        return read_pull(entry, name, kind, likes)
    link, against, good = bearer(entry)
    at, turns_with = entry.place("at", f"@{name}"), entry.link("turns_with")
    node = entry.node.items["force"]
    if type(node) is Sequence:
        open_ones = [type(one) is Scalar and one.text == "unknown" for one in node.items]
        if any(open_ones):
            pair = _directed(entry, name, node, all(open_ones))
            whole = pair and good and link and at
            return [Force(n, link, at, None, h, against) for n, h in pair] if whole and link and at else None
        parts = _components(entry)
        if parts is None or not (good and link and at):
            return None
        return ForceVector(name, link, at, *parts, against, turns_with)
    heading = _heading(entry)
    read, value = magnitude(entry, name, kind, likes)
    if not (good and read and link and at and heading):
        return None
    return Force(name, link, at, value, heading, against, turns_with)


def _directed(entry: Entry, name: str, node: Sequence, both: bool) -> list[tuple[str, Number]]:
    """Names and directions of the two components of a force of unknown direction."""
    entry.reading.marks[entry.path] = node.mark
    if not both or len(node.items) != 2:
        said = "along a known line it is `force: unknown` with its direction, else [unknown, unknown]"
        entry.refuse(node.mark, f"'force' of {entry.what}: {said}")
        return []
    heading = entry.one_of(DIRECTION)
    if heading is not None:
        entry.refuse(entry.mark(heading), f"{entry.what} is given by components, so it takes no '{heading}'")
        return []
    entry.reading.directed.append(name)
    return [
        (f"{name}.{axis}", Number(degrees, 0.0, f"{entry.path}.{axis}.angle", f"{degrees:.0f}"))
        for axis, degrees in (("x", 0.0), ("y", 90.0))
    ]


def _pressure(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    at, turns_with, heading = entry.place("at", f"@{name}"), entry.link("turns_with"), _heading(entry)
    area = _area(entry)
    read, value = magnitude(entry, name, kind, likes)
    if not (good and read and link and at and heading and area):
        return None
    return Force(name, link, at, value, heading, against, turns_with, area)


def _area(entry: Entry) -> Area | None:
    """The area under a pressure."""
    key = entry.one_of(("bore", "area"))
    if key is None:
        said = "needs its area: 'bore', the cylinder's diameter, or 'area'"
        entry.refuse(entry.node.mark, f"{entry.what} {said}")
        return None
    if entry.has("rod") and key == "area":
        entry.refuse(entry.mark("rod"), f"'rod' of {entry.what} goes with a 'bore'; an area is the whole one")
        return None
    area, bore, rod = entry.number("area"), entry.number("bore"), entry.number("rod")
    if bore and rod and rod.value >= bore.value:
        entry.refuse(entry.mark("rod"), f"the rod of {entry.what} should be thinner than its bore")
        return None
    if (area is None and bore is None) or (rod is None and entry.has("rod")):
        return None
    targets = entry.reading.targets
    per = times(targets["force"], targets["area"], -1)
    exact = exact_ratio(targets["pressure"], per)
    if bore is not None:
        exact = (exact[0], 4 * exact[1], exact[2] + 1)
    return Area(exact, area, bore, rod)


def _distributed(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    a, b, turns_with = entry.point("from"), entry.point("to"), entry.link("turns_with")
    heading = _heading(entry)
    if a is not None and a == b:
        entry.refuse(entry.mark("to"), f"{entry.what} begins and ends at {a}")
        return None
    ends: tuple[Number, Number] | None = None
    value: Magnitude = None
    if type(entry.node.items["distributed"]) is Sequence:
        ends = entry.pair("distributed", "01")
        read, value = ends is not None, ends[0] if ends else None
        for n in "01":
            entry.reading.marks[f"{entry.path}.{n}"] = entry.reading.marks.get(
                f"{entry.path}.{kind}.{n}", (1, 1)
            )
    else:
        read, value = magnitude(entry, name, kind, likes)
    if not (good and read and link and a and b and heading):
        return None
    over = Stretch(a, b)
    if ends is not None:
        first, last = (end._replace(path=f"{entry.path}.{n}") for n, end in enumerate(ends))
        steep = abs(last.value) > abs(first.value)  # per unit of the larger, which is not zero
        value, over = (last, Stretch(b, a, first)) if steep else (first, Stretch(a, b, last))
    entry.reading.middles[f"@{name}"] = (a, b)
    return Force(name, link, f"@{name}", value, heading, against, turns_with, over)


def _torsion(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    corner, free = _corner(entry), entry.number("free")
    if corner and len(corner) == 2 and against is not None:
        said = "two points give the angle to the frame; to another link it has three, as in ABC"
        entry.refuse(entry.mark("against"), f"'corner' of {entry.what}: {said}")
        return None
    read, value = magnitude(entry, name, kind, likes)
    if not (good and read and link and corner and free):
        return None
    return TorsionSpring(name, link, corner, value, free, against)


def _corner(entry: Entry) -> tuple[str, ...] | None:
    """The two or three points of an angle."""
    node = entry.node.items.get("corner")
    if node is None:
        return None
    text = node.text if type(node) is Scalar else ""
    reading = entry.reading
    names = point_key(text, (2, 3), reading.given | reading.used.keys())
    if isinstance(names, str):
        entry.refuse(node.mark, f"'corner' of {entry.what}: {names}")
        return None
    for point in names:
        reading.used.setdefault(point, node.mark)
    return names


def _components(entry: Entry) -> tuple[Number, Number] | None:
    """A force by its components, at paths ``loads.P.x``; it takes no direction."""
    heading = entry.one_of(DIRECTION)
    if heading is not None:
        entry.refuse(entry.mark(heading), f"{entry.what} is given by components, so it takes no '{heading}'")
    parts = entry.pair("force", "xy")
    if parts is None:
        return None
    for axis in "xy":
        entry.reading.marks[f"{entry.path}.{axis}"] = entry.reading.marks.pop(f"{entry.path}.force.{axis}")
    x, y = (part._replace(path=f"{entry.path}.{axis}") for part, axis in zip(parts, "xy", strict=True))
    return x, y


def _heading(entry: Entry) -> Heading | None:
    key = entry.one_of(DIRECTION)
    if key is None:
        *first, last = DIRECTION
        entry.refuse(entry.node.mark, f"{entry.what} needs its direction: {', '.join(first)} or {last}")
    if key == "angle":
        return entry.number(key)
    if key == "slope":
        return _slope(entry)
    point = entry.point(key) if key else None
    if point is not None and point == word_at(entry, "at"):
        entry.refuse(entry.mark(key or ""), f"{entry.what} acts at {point} and cannot point {key} it")
        return None
    return Toward(point, key == "away") if point else None


def _slope(entry: Entry) -> Slope | None:
    pair = entry.pair("slope", "xy")
    if pair and pair[0].value == 0.0 and pair[1].value == 0.0:
        entry.refuse(entry.mark("slope"), f"the slope [0, 0] of {entry.what} has no direction")
        return None
    return Slope(*pair) if pair else None


def _torque(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    if entry.has("screw"):
        from icsolve.read.screws import read_turning

        return read_turning(entry, name, kind, likes)
    link, against, good = bearer(entry)
    turns = entry.sense()
    read, value = magnitude(entry, name, kind, likes)
    return Torque(name, link, value, turns, against) if good and read and link and turns else None


def _weight(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    if not entry.has("link") and word_at(entry, "at") in entry.reading.ends:
        from icsolve.read.ropes import read_pull

        return read_pull(entry, name, kind, likes)
    link, at = entry.link("link"), entry.place("at", f"@{name}")
    read, value = magnitude(entry, name, kind, likes)
    return Weight(name, link, at, value, kind == "mass") if read and link and at else None


def _spring(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    at, to = entry.place("at", f"@{name}"), entry.place("to", f"@{name}'")
    free = entry.number("free")
    read, value = magnitude(entry, name, kind, likes)
    if at is not None and at == to:
        entry.refuse(entry.mark("to"), f"both ends of {entry.what} are at {at}")
        return None
    if not (good and read and link and at and to and free):
        return None
    return Spring(name, link, at, to, value, free, against)


def _power(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    link, against, good = bearer(entry)
    turns, value = entry.sense(), torque_number(entry)
    return Torque(name, link, value, turns, against) if value and good and link and turns else None


PLANE: Forms[Load] = Forms(
    LOADS,
    {
        "force": _force,
        "torque": _torque,
        "weight": _weight,
        "mass": _weight,
        "spring": _spring,
        "torsion spring": _torsion,
        "pressure": _pressure,
        "distributed": _distributed,
        "power": _power,
    },
    "as in {force: 100, link: 4, at: E, angle: 180}",
    _ELSEWHERE,
)
"""Loads of the plane."""


_FORM = "as in {link: 2, speed: 12 rad/s} or {link: 2, turns: cw}"


def read_motion(reading: Reading, section: Node) -> tuple[Motion, ...]:
    """One motion or a list of them."""
    if type(section) is not Sequence:
        single = _motion(reading, section, "motion")
        return (single,) if single is not None else ()
    found = [_motion(reading, node, f"motion.{index}") for index, node in enumerate(section.items)]
    return tuple(motion for motion in found if motion is not None)


def _motion(reading: Reading, node: Node, path: str) -> Motion | None:
    mapping = reading.mapping(node, "motion", _FORM)
    if mapping is None:
        return None
    reading.marks[path] = mapping.mark
    entry = Entry(reading, mapping, path, "motion", MOTION)
    entry.check()
    link = entry.link("link")
    return _of_point(entry, link) if entry.has("point") else _of_link(entry, link, mapping)


def _of_link(entry: Entry, link: str | None, mapping: Mapping) -> Motion | None:
    if entry.has("angle"):
        entry.refuse(entry.mark("angle"), "a link's motion has no 'angle'; a point's motion has")
        return None
    if not entry.has("speed") and not entry.has("turns"):
        entry.refuse(mapping.mark, "motion of a link needs 'speed', 'turns: ccw' or 'turns: cw'")
        return None
    speed = entry.number("speed")
    turns = entry.word("turns", ("ccw", "cw"))
    more = _acceleration(entry)
    good = (speed is not None) == entry.has("speed") and (turns is not None) == entry.has("turns")
    return Motion(link, speed, turns, acceleration=more) if link and good else None


def _acceleration(entry: Entry, dimension: str = "") -> Number | None:
    """How fast the speed grows; there has to be one."""
    if entry.has("acceleration") and not entry.has("speed"):
        mark = entry.mark("acceleration")
        entry.refuse(mark, "motion with an 'acceleration' needs a 'speed', 0 where it starts")
    return entry.number("acceleration", dimension)


def _of_point(entry: Entry, link: str | None) -> Motion | None:
    if entry.has("turns"):
        entry.refuse(entry.mark("turns"), "a point's motion has 'speed' and 'angle', not 'turns'")
        return None
    point = entry.point("point")
    entry.need("speed")
    entry.need("angle")
    speed, angle = entry.number("speed", "speed"), entry.number("angle")
    more = _acceleration(entry, "path acceleration")
    good = link and point and speed is not None and angle is not None
    return Motion(link, speed, None, point, angle, more) if good and link else None
