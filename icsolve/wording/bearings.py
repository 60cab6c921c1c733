"""Senses in words as directions: ``right``, ``at 30 deg``, ``toward P``, ``pull``."""

from __future__ import annotations

import math
from collections.abc import Mapping

from icsolve.case import Force, Load, Spring, Toward

Places = Mapping[str, tuple[float, float]]

_WORDS = {"right": 0.0, "up": 90.0, "left": 180.0, "down": 270.0}
_LOOSE = 45.0
"""Degrees within which a direction may be called by one of the four words."""
_CLOSE = 1.0
"""Degrees within which it may be called by an angle or by a point."""


def same_way(published: str, found: str, load: Load, places: Places) -> bool:
    """Whether a force of sense ``found`` goes the way that ``published`` says, as books round directions."""
    theirs, ours = bearing(published, load, places), bearing(found, load, places)
    if theirs is None or ours is None:
        return published == found
    return turned_at_most(theirs, ours, published)


def turned_at_most(theirs: float, ours: float, published: str) -> bool:
    """Whether two directions in degrees differ by no more than the published words leave open."""
    room = _LOOSE if published in _WORDS else _CLOSE
    return abs(math.remainder(theirs - ours, 360.0)) <= room + 1e-9


def bearing(sense: str, load: Load | None, places: Places) -> float | None:
    """Direction of a sense in degrees ccw from +x; None where the words alone do not give one."""
    lead, _, rest = sense.partition(" ")
    if sense in _WORDS:
        return _WORDS[sense]
    if lead == "at":
        return _degrees(rest)
    start = places.get(getattr(load, "at", ""))
    if lead == "toward":
        return _from(start, places.get(rest))
    if lead in {"pull", "push"}:
        along = _from(start, places.get(_far_end(load)))
        return along if along is None or lead == "pull" else along + 180.0
    return None


def _degrees(text: str) -> float | None:
    try:
        return float(text.split(maxsplit=1)[0])
    except (ValueError, IndexError):
        return None


def _from(start: tuple[float, float] | None, end: tuple[float, float] | None) -> float | None:
    if start is None or end is None or start == end:
        return None
    return math.degrees(math.atan2(end[1] - start[1], end[0] - start[0]))


def _far_end(load: Load | None) -> str:
    """The point that a pull draws a load's own point to."""
    if isinstance(load, Spring):
        return load.to
    if isinstance(load, Force) and isinstance(load.heading, Toward):
        return load.heading.point
    return ""
