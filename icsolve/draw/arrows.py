"""Straight arrows and arcs with heads."""

from __future__ import annotations

import math

from icsolve.draw.marks import Arc, Area, Mark, Point, Stroke
from icsolve.draw.view import along, unit

HEAD = 11.0
"""Length of an arrow's head; it is 0.8 times as wide."""


def head(tip: Point, u: Point, kind: str, size: float = HEAD) -> Area:
    """A head that ends at ``tip``, pointing along u."""
    back, v = along(tip, u, -size), (-u[1], u[0])
    return Area(
        ((tip, along(back, v, 0.4 * size), along(tip, u, -0.75 * size), along(back, v, -0.4 * size)),), kind
    )


def arrow(tail: Point, tip: Point, kind: str, size: float = HEAD) -> tuple[Mark, ...]:
    """A straight arrow; its head is no longer than the whole."""
    u = unit(tip[0] - tail[0], tip[1] - tail[1])
    size = min(size, 0.9 * math.dist(tail, tip))
    neck = along(tip, u, -0.7 * size)
    return (Stroke((tail, neck), kind), head(tip, u, f"{kind}-head", size))


def turning(
    centre: Point, radius: float, start: float, ccw: bool, kind: str, sweep: float = 250.0
) -> tuple[Mark, ...]:
    """An arc with a head, counterclockwise or clockwise as seen, from a direction in degrees."""
    sign = 1.0 if ccw else -1.0
    lean = math.degrees(0.75 * HEAD / radius)
    arc = Arc(centre, radius, start, sign * (sweep - lean), kind)
    tip = arc.at(sign * sweep)
    tail = arc.at(sign * (sweep - lean * 1.25))
    return (arc, head(tip, unit(tip[0] - tail[0], tip[1] - tail[1]), f"{kind}-head"))
