"""Screws: a slide that a torque out of the plane drives, or a weld where none does."""

from __future__ import annotations

from collections.abc import Iterator

from icsolve.case import Joint, Load, Screw, Slide, Torque, Weld
from icsolve.read.document import Mapping, Node, Scalar
from icsolve.read.joints import read_guide
from icsolve.read.loads import Likes, magnitude
from icsolve.read.names import shown
from icsolve.read.reading import Entry


def driven(loads: Node | None) -> set[frozenset[str]]:
    """The pairs of links whose screws torques turn."""
    return {frozenset(pair) for pair in _pairs(loads)}


def _pairs(loads: Node | None) -> Iterator[tuple[str, str]]:
    for node in loads.items.values() if type(loads) is Mapping else ():
        if type(node) is Mapping and "torque" in node.items and "screw" in node.items:
            pair = _pair(node.items["screw"])
            if pair is not None:
                yield pair


def _pair(node: Node) -> tuple[str, str] | None:
    """Two links: ``2-3``, or ``23`` where each is one character."""
    text = node.text.strip() if type(node) is Scalar else ""
    parts = [part.strip() for part in text.split("-")] if "-" in text else list(text)
    return (parts[0], parts[1]) if len(parts) == 2 and all(parts) else None


def read_screw(entry: Entry, links: tuple[str, ...], whole: bool) -> Joint | None:
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
    entry.reading.screws.append(Screw(pair, at, guide, lead, radius, mu))
    return Slide((pair[1], pair[0]), at, guide)


def read_turning(entry: Entry, name: str, kind: str, likes: Likes) -> Load | None:
    """A torque that turns a screw: positive where it drives the second link along the axis."""
    node = entry.node.items["screw"]
    pair = _pair(node)
    for key in ("link", "against", "turns"):
        if entry.has(key):
            said = f"{entry.what} turns a screw and has no '{key}': it is positive clockwise as one looks"
            entry.refuse(entry.mark(key), f"{said} along the axis")
            return None
    screw = next((s for s in entry.reading.screws if pair and {*s.links} == {*pair}), None)
    if screw is None:
        what = shown(node.text) if type(node) is Scalar else "that"
        said = f"{entry.what} should turn a screw by its two links, as in 2-3, and no screw joins {what}"
        entry.refuse(node.mark, said)
        return None
    read, value = magnitude(entry, name, kind, likes)
    return Torque(name, screw.rotor, value) if read else None
