"""Bars: links that forces load at two points alone, and what pulls or pushes each along itself."""

from __future__ import annotations

import math
from collections.abc import Mapping

from icsolve.answer import Answer
from icsolve.case import Case, Coordinates, Load
from icsolve.statics.load_wrenches import line_of, place_of, points_of

Place = tuple[float, float]
NEAR = 1e-9
"""Of the length of a bar, and of its force: places are one, and forces along it, but for rounding."""

ROUNDED = 1e-14
"""What is left of the forces at an end, as a part of them, is rounding."""


def bars_of(answer: Answer) -> dict[str, float]:
    """The force along each link that is loaded at two points alone and by no couple, as its end without a
    load has it: positive where the bar is pulled [case force]. None is told of what equilibrium leaves open.
    """
    case, found = answer.case, dict[str, float]()
    tied = {link for rope in case.ropes for link in rope.links}
    tied.update(link for screw in case.screws for link in screw.links)
    moved = answer.accelerations is not None  # inertia forces act all along
    if answer.reactions is None or moved:
        return {}
    for link in case.links:
        held = [] if link == case.ground else [r for _, r in answer.reactions.of_link(link)]
        ends = [*dict.fromkeys(r.at for r in held)]
        if len(ends) != 2 or link in tied or any(None in (r.x, r.y) or r.moment != 0.0 for r in held):
            continue
        places, span = _loaded(answer, link), math.dist(*ends)
        free = [end for end in ends if not any(p and math.dist(p, end) <= NEAR * span for p in places)]
        if not free or not all(p and min(math.dist(p, end) for end in ends) <= NEAR * span for p in places):
            continue
        x, y = (sum(getattr(r, part) for r in held if r.at == free[0]) for part in "xy")
        own, other = free[0], ends[1 - ends.index(free[0])]
        u, v = ((a - b) / span for a, b in zip(own, other, strict=True))
        size = sum(r.magnitude or 0.0 for r in held if r.at == free[0])
        if math.hypot(x, y) <= ROUNDED * size:
            found[link] = 0.0
        elif abs(x * v - y * u) <= NEAR * math.hypot(x, y):
            found[link] = x * u + y * v
    return found


def _loaded(answer: Answer, link: str) -> list[Place | None]:
    """The places of the loads on a link; None of a couple, and of a load along a line."""
    points = dict(answer.points)
    for name, at in answer.case.points.items():  # loads at coordinates have theirs in the case alone
        if isinstance(at, Coordinates) and at.x is not None and at.y is not None:
            points.setdefault(name, (at.x.value, at.y.value))
    return [place for load in answer.case.loads for place in _places(answer.case, points, load, link)]


def _places(case: Case, points: Mapping[str, Place], load: Load, link: str) -> list[Place | None]:
    if link not in (load.link, getattr(load, "against", None) or case.ground):
        return []
    if not points.keys() >= {*points_of(load)}:  # spread along a line
        return [None]
    if link == load.link:
        return [place_of(load, points)]
    line = line_of(load)
    return [place_of(load, points) if line is None else points[line[1]]]
