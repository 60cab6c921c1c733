"""Ropes: entries of ``joints`` that join several links, and the loads that pull their free ends."""

from __future__ import annotations

from collections.abc import Iterator

from icsolve.case import AlongRope, Force, Joint, Load, Number, Pin, Rope, Weight
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.entry import Entry
from icsolve.read.joints import JOINTS, unlike
from icsolve.read.keys import PULLS
from icsolve.read.names import shown, suggestion
from icsolve.read.reading import Reading
from icsolve.wording import plural

_FORM = "{rope: [A, P, B], on: [4, 3, 1]}"


def read_ropes(reading: Reading, section: Sequence) -> tuple[tuple[Rope, ...], Sequence]:
    """The ropes among the joints, and the other joints."""
    reading.forms.update(FORMS)
    others: list[Node] = []
    found, ends = [], set[str]()
    for item in section.items:
        if type(item) is Mapping and "rope" in item.items:
            rope = _rope(reading, item)
            if rope is not None:
                found.append(rope)
            else:  # perhaps a free one
                ends.update(_through(item)[-1:])
        else:
            others.append(item)
    reading.ends.update(dict.fromkeys(ends))
    for rope in found:
        if rope.is_free:
            reading.ends[rope.points[-1]] = rope
    return tuple(found), Sequence(others, section.mark)


def _rope(reading: Reading, node: Mapping) -> Rope | None:
    names = reading.names(node.items["rope"], "the points of a rope", _FORM)
    points = tuple(item.text for item in names or ())
    for item in names or ():
        reading.used.setdefault(item.text, item.mark)
    path = unlike(f"joints.{'-'.join(points) or '?'}", reading.marks)
    name = path.partition(".")[2]
    reading.marks[path] = node.mark
    reading.ropes.add(name)
    entry = Entry(reading, node, path, f"the rope {name}", JOINTS["rope"].keys)
    if len(points) < 2 and names is not None:
        said = f"{entry.what} needs two points or more: its ends and its pulleys"
        entry.refuse(node.items["rope"].mark, said)
        names = None
    v = entry.read("rope")
    if names is None or v["on"] is None or not entry.whole:
        return None
    none = (None,) * len(points)
    radii, wraps, mu, turns = (v[key] or none for key in ("radii", "wraps", "mu", "turns"))
    _check_wraps(entry, points, len(v["on"]))
    return Rope(name, points, v["on"], radii, wraps, mu, v["length"], turns)


def _through(entry: Mapping) -> tuple[str, ...]:
    """The points that a rope runs through."""
    node = entry.items["rope"]
    return tuple(i.text for i in node.items if type(i) is Scalar) if type(node) is Sequence else ()


def _links(entry: Entry, key: str, node: Node) -> tuple[str, ...] | None:
    """One link for each point, or one less where the last end is free."""
    items = entry.reading.names(node, f"'on' of {entry.what}", "[4, 3, 1]")
    if items is None:
        return None
    links = [entry.reading.link(item, f"'on' of {entry.what}") for item in items]
    points = _through(entry.node)
    if len(points) > 1 and (len(items) not in (len(points), len(points) - 1) or not items):
        said = f"{entry.what} runs through {len(points)} points, and 'on' names {plural(len(items), 'link')}"
        entry.refuse(node.mark, f"{said}: give one for each point, or one less where its last end is free")
        return None
    return tuple(link for link in links if link is not None) if None not in links else None


def _by_place(entry: Entry, key: str, node: Node) -> tuple[Number | str | None, ...] | None:
    """What a mapping from points has for each place of the rope: a number, or a sense."""
    own, points = entry.keys[key], _through(entry.node)
    form = own.says.partition(" as in ")[2]
    mapping = entry.reading.mapping(node, f"'{key}' of {entry.what}", f"as in {form}")
    if mapping is None:
        return None
    inner = Entry(entry.reading, mapping, f"{entry.path}.{key}", f"'{key}' of {entry.what}")
    before = {*_places(entry, points, key)}
    for name, mark in mapping.keys.items():
        if name not in points and name not in before:
            entry.refuse(mark, f"{entry.what} does not run through {shown(name)}{suggestion(name, points)}")

    def read(at: str) -> Number | str | None:
        if own.form == "senses":
            return inner.word(at, ("ccw", "cw"))
        return inner.value(mapping.items[at], own.dimension, f"{inner.path}.{at}", at, own.bound)

    found = {name: read(name) for name in mapping.items if name in points}
    return tuple(found.get(point) for point in points)


def _places(entry: Entry, points: tuple[str, ...], until: str) -> Iterator[str]:
    """The names in the mappings of a rope that stand before another: of each it is told once."""
    for key, node in entry.node.items.items():
        if key == until:
            return
        if key in entry.keys and entry.keys[key].form in FORMS and type(node) is Mapping:
            yield from node.items


FORMS = {"links of a rope": _links, "sizes": _by_place, "senses": _by_place, "numbers": _by_place}
"""What reads the forms that only ropes have."""


def _check_wraps(entry: Entry, points: tuple[str, ...], links: int) -> None:
    """A pulley with a size has its sense, and one that rubs has both."""
    given = {key: {*node.items} for key, node in entry.node.items.items() if type(node) is Mapping}
    sized, wound, rubbing, more = (given.get(key, set()) for key in ("radii", "wraps", "mu", "turns"))
    for k, point in enumerate(points):
        inside = 0 < k < len(points) - 1
        if point in sized and point not in wound:
            said = f"{entry.what} goes round {point}, which has a radius: give its sense, {{{point}: ccw}}"
            way = f"as one follows the rope from {points[0]} to {points[-1]}"
            entry.refuse(entry.mark("radii"), f"{said} or cw under 'wraps', {way}")
        if point in wound and point not in sized:
            said = f"{entry.what} goes round {point}: give its radius, radii: {{{point}: 0.1}}"
            entry.refuse(entry.mark("wraps"), said)
        if point in rubbing and (point not in sized or not inside):
            where = "with its 'radii' and 'wraps'" if inside else "between its ends"
            said = f"{entry.what} slips only on what it goes round {where}, and has 'mu' at {point}"
            entry.refuse(entry.mark("mu"), said)
        if point in more and (point not in sized or not inside):
            said = f"{entry.what} has 'turns' at {point}, which belong to a pulley with 'radii' and 'wraps'"
            entry.refuse(entry.mark("turns"), said)
    if links < len(points) and points[-1] in sized:
        said = f"the last end {points[-1]} of {entry.what} is free and has no radius"
        entry.refuse(entry.mark("radii"), said)


HELD_BY_A_LINK = (
    "; where it is a link that pulls, as a man in the chair that the rope bears, fix the end to that link: "
    "name it last in 'on', give the load up, and the rope's tension is the pull"
)


def read_pull(entry: Entry, name: str, kind: str) -> Load | None:
    """A load without a link, which pulls the free end of a rope; None where one of the two can't be read."""
    rope = entry.reading.ends[entry.text("at")]
    entry.keys = {kind: PULLS[kind].own, **PULLS[kind].keys}
    others = [key for key in entry.node.items if key not in entry.keys]
    if rope is not None:
        said = f"{entry.what} pulls the free end of the rope {rope.name}, along it: take out"
        for key in others:
            held = HELD_BY_A_LINK if key == "against" else ""
            entry.refuse(entry.mark(key), f"{said} '{key}'{held}")
    value = entry.read(*others)[kind]
    if rope is None or not entry.whole:
        return None
    if kind in ("weight", "mass"):
        return Weight(name, rope.end, rope.points[-1], value, kind == "mass")
    return Force(name, rope.end, rope.points[-1], value, AlongRope(rope))


def check_ends(reading: Reading, ropes: tuple[Rope, ...], joints: tuple[Joint, ...], loads: Mapping) -> None:
    """A free end without a load pulls nothing, and a load pulls one end; a rope that ends on the pin of a
    wheel does not turn it, which is said."""
    pulling = [one.items for one in loads.items.values() if type(one) is Mapping and "link" not in one.items]
    pulled = {node.text for one in pulling if type(node := one.get("at")) is Scalar}  # readable or not
    of_link = {
        link: [joint for joint in joints if link in joint.links] for rope in ropes for link in rope.links
    }
    ended: dict[str, Rope] = {}
    for rope in (rope for rope in ropes if rope.is_free):
        first = ended.setdefault(rope.points[-1], rope)
        if first is not rope:
            said = f"the ropes {first.name} and {rope.name} have one free end, {rope.points[-1]}, and a load"
            way = "there pulls one of them: give each end its own point, or name the link at it last in 'on'"
            reading.refuse(reading.marks[f"joints.{rope.name}"], f"{said} {way}")
    for rope in ropes:
        for k in {0, len(rope.points) - 1} & {*range(len(rope.links))}:
            (link, at), only = (rope.links[k], rope.points[k]), of_link[rope.links[k]]
            if rope.radii[k] is None and [type(joint) for joint in only] == [Pin] and only[0].at == at:
                said = f"the rope {rope.name} ends at {at}, the pin of link {link}, and so does not turn it"
                drum = f"'radii' and 'wraps', as in {{{at}: 0.1}} and {{{at}: ccw}}"
                reading.noticed.append(f"{said}; if it is wound on it as on a drum, give {drum}.")
        if rope.is_free and rope.points[-1] not in pulled:
            mark = reading.marks[f"joints.{rope.name}"]
            end = rope.points[-1]
            said = f"the last end {end} of the rope {rope.name} is free, and no load pulls it: give one,"
            reading.refuse(mark, f"{said} {{force: 100, at: {end}}}, or name the link at {end} last in 'on'")
