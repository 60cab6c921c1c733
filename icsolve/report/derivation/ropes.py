"""Ropes of a known scene: what each straight part does to the links at its ends.

A rope keeps its length, so its tension does no work: the powers of the pulls of all parts add up to zero.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from icsolve.case import Case, Rope
from icsolve.errors import SceneError
from icsolve.numbers.arithmetic import FLOATS
from icsolve.report.derivation.known import Known
from icsolve.screws.plane import Point
from icsolve.screws.ropes import rope_parts
from icsolve.tuples import NamedTuple


class Pull(NamedTuple):
    """``strands`` parts of a rope, on one line, pull ``link`` along ``direction`` at a place of the line.

    ``part`` is the number of the first from 1, ``tension`` what each pulls with (None where it is not known),
    ``symbol`` its name with what stands low, ``where`` the part by its points (or their common point). The
    link of a free end is the rope's ``end``.
    """

    rope: Rope
    part: int
    strands: int
    link: str
    at: Point
    direction: Point
    tension: float | None
    symbol: tuple[str, str]
    where: str

    @property
    def force(self) -> Point:
        """What all of them pull with; zero where that is not known."""
        size = self.strands * (self.tension or 0.0)
        return (size * self.direction[0], size * self.direction[1])


def rope_pulls(known: Known, rope: Rope) -> list[Pull]:
    """The pulls of a rope on all links, its free end and the frame; none where it can't be laid."""
    try:
        parts = rope_parts(rope, known.points, 1.0, FLOATS)
    except (SceneError, KeyError):
        return []
    tensions = () if known.answer is None else known.answer.tensions
    found = next((t for t in tensions if t.rope == rope.name), None)
    pulls = []
    for n, part in enumerate(parts, 1):
        pull = None if found is None else found.parts[n - 1] if found.parts else found.tension
        symbol = tension_name(known.case, rope, n if rope.slips else 0)
        (x, y), (u, v), length = part.at, part.along, float(part.length)
        where = "".join(rope.points[n - 1 : n + 1]) if all(len(p) == 1 for p in rope.points) else f"part {n}"
        ends = ((part.links[0], (x, y), (u, v)), (part.links[1], (x + length * u, y + length * v), (-u, -v)))
        for end, (link, at, way) in enumerate(ends):
            own = Pull(rope, n, 1, link or rope.end, at, way, pull, symbol, where)
            pulls.append((own, rope.points[n - 1 + end]))
    alike = Counter((p.link, p.at, p.direction, p.symbol) for p, _ in pulls)
    merged: dict[object, Pull] = {}
    for p, point in pulls:
        key = (p.link, p.at, p.direction, p.symbol)
        many = p._replace(strands=alike[key], where=point) if alike[key] > 1 else p
        merged.setdefault(key, many)
    return list(merged.values())


def pulls_on(known: Known, link: str) -> Iterable[Pull]:
    """The pulls of all ropes on a link, where their tensions are known."""
    for rope in known.case.ropes:
        for pull in rope_pulls(known, rope):
            if pull.link == link and pull.tension is not None:
                yield pull


def tension_name(case: Case, rope: Rope, part: int) -> tuple[str, str]:
    """The symbol of a rope's tension, and what stands low: T, of its second ``part`` T2; with the rope's
    name where there are several, or a load is called so."""
    low = str(part) if part else ""
    if len(case.ropes) > 1 or f"T{low}" in {load.name for load in case.loads}:
        low = f"{rope.name},{low}" if low else rope.name
    return ("T", low)


def moving_names(case: Case) -> tuple[str, ...]:
    """The links, and what stands for one: free ends of ropes, screws that a torque turns."""
    ends = (rope.end for rope in case.ropes if rope.is_free)
    return (*case.links, *ends, *(screw.rotor for screw in case.screws))
