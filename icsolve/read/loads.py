"""Loads, planar and in space: each of one kind, known, unknown or like another; and the given motion."""

from __future__ import annotations

from collections.abc import Callable, Container
from collections.abc import Mapping as Table
from typing import Any

from icsolve.case import (
    Area,
    Force,
    ForceVector,
    Load,
    Mark,
    Motion,
    Number,
    Spring,
    Stretch,
    Torque,
    TorsionSpring,
    Toward,
    Weight,
)
from icsolve.numbers.units import exact_ratio, times
from icsolve.read.document import Mapping, Node, Scalar, Sequence, take_in
from icsolve.read.entry import Entry, Values
from icsolve.read.keys import LOADS, MOTION_OF_LINK, MOTION_OF_POINT, PULLS, EntryKind
from icsolve.read.names import is_name, meant_by, point_key, shown, suggestion, why_no_name
from icsolve.read.reading import Reading
from icsolve.tuples import Generic, NamedTuple, TypeVar

VECTORS = {"force": "vector", "torque": "couple"}
"""Kinds that can be given by components, and what they are called then."""

T = TypeVar("T")


class Forms(NamedTuple, Generic[T]):
    """The kinds of load and what makes each of its values, an example; and why a key has no place here."""

    kinds: Table[str, EntryKind]
    build: Table[str, Callable[[Entry, str, Values], T | list[T] | None]]
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
    parts = {key for kind in forms.kinds.values() for key in kind.keys}
    take_in(section, parts | forms.own_keys().keys(), reading.problems)
    for key, node in section.items.items():
        reading.kinds[key] = _kind_of(node, forms)
    found: list[T] = []
    for key, node in section.items.items():
        load = _load(reading, key, node, section.keys[key], forms)
        found.extend(load if isinstance(load, list) else [load] if load is not None else [])
    linear = {getattr(one, "name", "") for one in found if getattr(getattr(one, "over", None), "end", None)}
    _check_likes(reading, linear)
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


def _load(reading: Reading, name: str, node: Node, mark: Mark, forms: Forms[T]) -> T | list[T] | None:
    """The load of an entry, None where it can't be read; of an unknown direction, its two components."""
    if not is_name(name):
        reading.refuse(mark, f"{shown(name)} is not a name of a load: {why_no_name(name, is_key=True)}")
        return None
    mapping = reading.mapping(node, f"load {name}", forms.example)
    if mapping is None:
        return None
    reading.marks[f"loads.{name}"] = mark
    entry = Entry(reading, mapping, f"loads.{name}", f"load {name}", hidden=f"@{name}")
    key = _own_key(entry, forms)
    if key is None:
        return None
    sort = "torsion spring" if reading.kinds[name] == "torsion spring" else key
    kind = forms.kinds[sort]
    if sort in PULLS and not entry.has("link") and entry.text("at") in reading.ends:
        from icsolve.read.ropes import read_pull

        return read_pull(entry, name, sort)  # type: ignore[return-value]
    entry.keys, entry.ties = {key: kind.own, **kind.keys}, kind.ties
    values = entry.read(*_explain_keys(entry, sort, forms))
    link = values["link"]
    if link is not None and link == values.get("against"):
        entry.refuse(entry.mark("against"), f"{entry.what} acts on link {link} against itself")
    return forms.build[sort](entry, name, values) if entry.whole else None


def _own_key(entry: Entry, forms: Forms[T]) -> str | None:
    """The key that says of which kind a load is."""
    own = forms.own_keys()
    key = entry.one_of(own)
    if key is None:
        parts = {key for one in forms.kinds.values() for key in one.keys}
        strange = [key for key in entry.node.items if key not in parts]
        likely = suggestion(strange[0], own) if strange else ""
        if strange and strange[0] in ("type", "kind", "value", "magnitude", "size"):
            likely = "; its number stands under the name of its kind, as in {force: 100} or {torque: 5}"
        elif strange and strange[0] in ("like", "times"):
            likely = "; what is like another load says so in place of its number, as in {force: {like: P}}"
        elif strange and strange[0].lower() in ("fx", "fy", "x", "y"):
            likely = "; a force by its components is {force: [30, -40]}"
        mark = entry.mark(strange[0]) if strange else entry.node.mark
        entry.refuse(mark, f"{entry.what} has none of {', '.join(own)}{likely}")
        meant = meant_by(strange[0], own) if strange else ""
        if meant:  # a guess: what stands there is read on, nothing is missed
            node = entry.node
            node.items[meant], node.keys[meant] = node.items.pop(strange[0]), node.keys.pop(strange[0])
            kind = forms.kinds["torsion spring" if _kind_of(node, forms) == "torsion spring" else meant]
            entry.keys = {meant: kind.own, **kind.keys}
            entry.reading.check_keys(node, parts | own.keys(), entry.what)
            for one in entry.keys:
                entry.form(one)
    return key if key and entry.reading.kinds[entry.path.removeprefix("loads.")] else None


def _explain_keys(entry: Entry, sort: str, forms: Forms[T]) -> list[str]:
    """Refuse keys of other kinds, and those that have their place elsewhere, in words; which these are."""
    others = {*forms.own_keys(), *(key for one in forms.kinds.values() for key in one.keys)}
    told = []
    for key, mark in entry.node.keys.items():
        if key in entry.keys or (key not in others and key not in forms.elsewhere):
            continue
        told.append(key)
        if key in others:
            kind = "distributed load" if sort == "distributed" else sort
            said = f"is a {kind}, which has no '{key}'; it takes {', '.join(forms.kinds[sort].keys)}"
            if sort in ("weight", "mass") and key in forms.kinds["force"].keys:
                said += ". Weights pull as gravity does: along another line write 'force' in place of "
                said += "'mass', the mass times g" if sort == "mass" else "'weight'"
        else:
            said = f"has no '{key}': {forms.elsewhere[key]}"
            entry.ties = tuple(tie for tie in entry.ties if tie.kind != "direction")
        entry.refuse(mark, f"{entry.what} {said}")
    return told


def _check_likes(reading: Reading, linear: Container[str]) -> None:
    """Each other load exists, is one number of the same kind, and does not lead back."""
    likes = reading.likes
    circular = _circular(likes)
    for name, (other, mark) in likes.items():
        kind, others = reading.kinds[name], reading.kinds.get(other)
        if others is None:
            reading.refuse(mark, f"there is no load '{other}'{suggestion(other, reading.kinds)}")
        elif others in VECTORS.values():
            reading.refuse(mark, f"load {name} cannot be like {other}, which is given by components")
        elif other in linear:
            ends = "which has two numbers, one at each end"
            reading.refuse(mark, f"load {name} cannot be like {other}, {ends}")
        elif kind and others and dimension_of(kind) != dimension_of(others):
            reading.refuse(mark, f"load {name} is a {kind} and cannot be like {other}, a {others}")
        elif name in circular:
            reading.refuse(mark, f"load {name} is like {other}, which leads back to {name}")


def _circular(likes: dict[str, tuple[str, Mark]]) -> set[str]:
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


_ELSEWHERE = {
    "along": "that is for a case in space, whose points have three coordinates; here it is `angle`, "
    "`toward`, `away` or `slope`"
}


def heading(entry: Entry, v: Values) -> Any:
    """What directs a force; None, with the reason noted, where it would be its own point."""
    for key in ("toward", "away"):
        if v[key] and v[key] == entry.text("at"):
            entry.refuse(entry.mark(key), f"{entry.what} acts at {v[key]} and cannot point {key} it")
            return None
        if v[key]:
            return Toward(v[key], key == "away")
    return next(v[key] for key in ("angle", "slope", "along") if v.get(key) is not None)


def _force(entry: Entry, name: str, v: Values) -> Load | list[Load] | None:
    value, link, at, against, turns_with = (v[k] for k in ("force", "link", "at", "against", "turns_with"))
    if type(value) is not tuple:
        way = heading(entry, v)
        return Force(name, link, at, value, way, against, turns_with) if way is not None else None
    if value:
        x, y = value
        return ForceVector(name, link, at, x, y, against, turns_with)
    entry.reading.directed.append(name)
    parts = (("x", 0.0), ("y", 90.0))
    angles = {axis: Number(a, 0.0, f"{entry.path}.{axis}.angle", f"{a:.0f}") for axis, a in parts}
    return [Force(f"{name}.{axis}", link, at, None, angle, against) for axis, angle in angles.items()]


def _pressure(entry: Entry, name: str, v: Values) -> Load | None:
    area, way = _area(entry, v), heading(entry, v)
    if area is None or way is None:
        return None
    return Force(name, v["link"], v["at"], v["pressure"], way, v["against"], v["turns_with"], area)


def _area(entry: Entry, v: Values) -> Area | None:
    """The area under a pressure."""
    bore, rod = v["bore"], v["rod"]
    if rod and rod.value >= bore.value:
        entry.refuse(entry.mark("rod"), f"the rod of {entry.what} should be thinner than its bore")
        return None
    unit = entry.reading.unit
    exact = exact_ratio(unit("pressure"), times(unit("force"), unit("area"), -1))
    if bore is not None:
        exact = (exact[0], 4 * exact[1], exact[2] + 1)
    return Area(exact, v["area"], bore, rod)


def _distributed(entry: Entry, name: str, v: Values) -> Load | None:
    a, b, value, way = v["from"], v["to"], v["distributed"], heading(entry, v)
    if a == b:
        entry.refuse(entry.mark("to"), f"{entry.what} begins and ends at {a}")
        return None
    over = Stretch(a, b)
    if type(value) is tuple:
        first, last = value
        steep = abs(last.value) > abs(first.value)  # per unit of the larger, which is not zero
        value, over = (last, Stretch(b, a, first)) if steep else (first, Stretch(a, b, last))
    entry.reading.middles[f"@{name}"] = (a, b)
    return Force(name, v["link"], f"@{name}", value, way, v["against"], v["turns_with"], over)


def _torsion(entry: Entry, name: str, v: Values) -> Load | None:
    corner = _corner(entry, v["corner"])
    if corner and len(corner) == 2 and v["against"] is not None:
        said = "two points give the angle to the frame; to another link it has three, as in ABC"
        entry.refuse(entry.mark("against"), f"'corner' of {entry.what}: {said}")
    if not entry.whole or corner is None:
        return None
    return TorsionSpring(name, v["link"], corner, v["spring"], v["free"], v["against"])


def _corner(entry: Entry, node: Node) -> tuple[str, ...] | None:
    """The two or three points of an angle."""
    text = node.text if type(node) is Scalar else ""
    reading = entry.reading
    names = point_key(text, (2, 3), reading.given | reading.used.keys())
    if not isinstance(names, str) and names[0] == names[-1]:
        names = f"'{'-'.join(names)}' names one arm twice, and has no angle"
    if isinstance(names, str):
        entry.refuse(node.mark, f"'corner' of {entry.what}: {names}")
        return None
    for point in names:
        reading.used.setdefault(point, node.mark)
    return names


def _torque(entry: Entry, name: str, v: Values) -> Load | None:
    if v["screw"] is not None:
        return _turning(entry, name, v)
    return Torque(name, v["link"], v["torque"], v["turns"] or "ccw", v["against"])


def weight(entry: Entry, name: str, v: Values) -> Weight:
    """A weight, given by its force or its mass."""
    mass = "mass" in v
    return Weight(name, v["link"], v["at"], v["mass" if mass else "weight"], mass)


def spring(entry: Entry, name: str, v: Values) -> Spring | None:
    """A spring between two different points."""
    if v["at"] == v["to"]:
        entry.refuse(entry.mark("to"), f"both ends of {entry.what} are at {v['at']}")
        return None
    return Spring(name, v["link"], v["at"], v["to"], v["spring"], v["free"], v["against"])


PLANE: Forms[Load] = Forms(
    LOADS,
    {
        "force": _force,
        "torque": _torque,
        "weight": weight,
        "mass": weight,
        "spring": spring,
        "torsion spring": _torsion,
        "pressure": _pressure,
        "distributed": _distributed,
        "power": lambda _, name, v: Torque(name, v["link"], v["power"], v["turns"] or "ccw", v["against"]),
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
    own, other = MOTION_OF_LINK, MOTION_OF_POINT
    told = "a link's motion has no '{}'; a point's motion has"
    if "point" in mapping.items or ("angle" in mapping.items and "turns" not in mapping.items):
        own, other, told = other, own, "a point's motion has 'speed' and 'angle', not '{}'"
    entry = Entry(reading, mapping, path, "motion", own.keys, own.ties)
    strange = [key for key in mapping.items if key in other.keys and key not in own.keys]
    for key in strange:
        entry.refuse(entry.mark(key), told.format(key))
    v = entry.read(*strange)
    if not entry.whole:
        return None
    return Motion(v["link"], v["speed"], v.get("turns"), v.get("point"), v.get("angle"), v["acceleration"])


def driven(loads: Node | None) -> set[frozenset[str]]:
    """The pairs of links whose screws torques turn."""
    entries = loads.items.values() if type(loads) is Mapping else ()
    given = (node.items for node in entries if type(node) is Mapping)
    turned = (_pair(items["screw"]) for items in given if {"torque", "screw"} <= items.keys())
    return {frozenset(pair) for pair in turned if pair is not None}


def _pair(node: Node) -> tuple[str, str] | None:
    """Two links: ``2-3``, or ``23`` where each is one character."""
    text = node.text.strip() if type(node) is Scalar else ""
    parts = [part.strip() for part in text.split("-")] if "-" in text else list(text)
    return (parts[0], parts[1]) if len(parts) == 2 and all(parts) else None


def _turning(entry: Entry, name: str, v: Values) -> Load | None:
    """A torque that turns a screw: positive where it drives the second link along the axis."""
    node, pair = v["screw"], _pair(v["screw"])
    for key in ("link", "against", "turns"):
        if entry.has(key):
            said = f"{entry.what} turns a screw and has no '{key}': it is positive clockwise as one looks"
            entry.refuse(entry.mark(key), f"{said} along the axis")
            return None
    if pair and frozenset(pair) in entry.reading.unread:
        return None
    screw = next((s for s in entry.reading.screws if pair and {*s.links} == {*pair}), None)
    if screw is None:
        what = shown(node.text) if type(node) is Scalar else "that"
        said = f"{entry.what} should turn a screw by its two links, as in 2-3, and no screw joins {what}"
        entry.refuse(node.mark, said)
        return None
    return Torque(name, screw.rotor, v["torque"])
