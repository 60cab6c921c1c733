"""Screws: a slide that a torque out of the plane drives, or a weld where none does."""

from __future__ import annotations

from collections.abc import Iterator

from icsolve.case import Load, Torque
from icsolve.read.document import Mapping, Node, Scalar
from icsolve.read.load_forms import Likes, magnitude
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
