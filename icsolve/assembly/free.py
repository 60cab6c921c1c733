"""What is free in a figure with too few data, and what would fix it, in words."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from icsolve.assembly.data import GUIDE, RAY, X, Y
from icsolve.assembly.words import listed, plain
from icsolve.case import Case
from icsolve.errors import SceneError, Status

if TYPE_CHECKING:
    from icsolve.assembly.matching import System

COUNT = {1: "one more length, angle or coordinate", 2: "two more (lengths, angles or coordinates)"}


def underdetermined(case: Case, system: System, placed: Iterable[str], goal: list[str]) -> SceneError:
    """The refusal that lists every free part of the figure that the goal leans on."""
    known = set(placed)
    parts = [part for part in _parts(system) if any(p in part for p in goal)]
    return SceneError(Status.UNDERDETERMINED, "; ".join(_said(system, part, known) for part in parts))


def _parts(system: System) -> list[list[str]]:
    """The free points, together where an equation binds them."""
    free = list(dict.fromkeys(p for p, part in system.of if (p, part) in system.free))
    parts: list[list[str]] = []
    seen: set[str] = set()
    for root in free:
        if root in seen:
            continue
        part = [root]
        seen.add(root)
        for point in part:
            for u in ((point, 0), (point, 1)):
                for i in system.of[u]:
                    for p, axis in system.reach[i]:
                        if p not in seen and (p, axis) in system.free:
                            seen.add(p)
                            part.append(p)
        parts.append(sorted(part, key=free.index))
    return parts


def _said(system: System, part: list[str], known: set[str]) -> str:
    """What one free part lacks."""
    names = listed([plain(p) for p in part])
    unknowns = [(p, axis) for p in part for axis in (0, 1)]
    missing = sum(u not in system.matched for u in unknowns)
    rows = {i for u in unknowns for i in system.of[u]}
    if not rows:
        return f"nothing says where point {names} is: give its coordinates, or two lengths or angles"
    data = [system.equations[i].datum for i in rows]
    anchors = {p for datum in data for p in datum.points if p in known}
    absolute = any(datum.kind in (X, Y) for datum in data)
    turned = any(datum.kind in (RAY, GUIDE, X, Y) for datum in data)
    if not anchors and not absolute:
        direction = "" if turned else " and one direction (the angle of a pair)"
        return (
            f"nothing fixes where the figure of {names} lies: "
            f"give coordinates of one of its points{direction}"
        )
    hint = ""
    if len(anchors) == 1 and not turned and missing == 1:
        about = plain(next(iter(anchors)))
        hint = f"; nothing fixes how it is turned about {about}: give the direction of a pair"
    subject = "point" if len(part) == 1 else "points"
    verb = "is" if missing == 1 else "are"
    return f"{subject} {names}: {COUNT.get(missing, f'{missing} more data')} {verb} needed{hint}"
