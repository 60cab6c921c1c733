"""From case units to picture units: the scale, and the window that far things are clipped to."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from icsolve.draw.marks import Box, Point

WIDTH, HEIGHT = 560.0, 420.0
"""The largest that the mechanism and its near centres are drawn."""
MARGIN = 58.0
"""Room for symbols and loads around what is drawn to scale."""
NEAR = 2.1
"""Centres that make the figure no larger than so many times the mechanism are drawn in place."""


class View(NamedTuple):
    """``scale`` picture units per case unit; ``origin`` is the case point at picture (0, 0); y turns."""

    scale: float
    origin: Point
    window: Box

    def at(self, p: Point) -> Point:
        """A point of the case in the picture."""
        return ((p[0] - self.origin[0]) * self.scale, (self.origin[1] - p[1]) * self.scale)

    def holds(self, p: Point) -> bool:
        """Whether a picture point lies in the window."""
        left, top, right, bottom = self.window
        return left <= p[0] <= right and top <= p[1] <= bottom


def view_of(
    mechanism: Sequence[Box], centres: Iterable[Point], size: float, room: Point = (WIDTH, HEIGHT)
) -> View:
    """The view of a mechanism (rectangles in case units) and of those centres that are not far, in a room."""
    left, low, right, high = _grown(mechanism) if mechanism else (0.0, 0.0, 0.0, 0.0)
    span = max(right - left, high - low, 0.2 * size) or 1.0
    middle = ((left + right) / 2.0, (low + high) / 2.0)
    for x, y in sorted(centres, key=lambda p: math.dist(p, middle)):
        wider = (min(left, x), min(low, y), max(right, x), max(high, y))
        if max(wider[2] - wider[0], wider[3] - wider[1]) <= NEAR * span:
            left, low, right, high = wider
    width, height = max(right - left, 1e-9 * span), max(high - low, 1e-9 * span)
    scale = min(room[0] / width, room[1] / height, 0.75 * max(room) / (0.4 * span))
    half = (width * scale / 2.0 + MARGIN, height * scale / 2.0 + MARGIN)
    return View(scale, ((left + right) / 2.0, (low + high) / 2.0), (-half[0], -half[1], *half))


def _grown(boxes: Sequence[Box]) -> Box:
    lefts, lows, rights, highs = zip(*boxes, strict=True)
    return (min(lefts), min(lows), max(rights), max(highs))


def direction(degrees: float) -> Point:
    """Unit vector in the picture (y down) of a direction counterclockwise from +x."""
    angle = math.radians(degrees)
    return (math.cos(angle), -math.sin(angle))


def along(p: Point, u: Point, distance: float) -> Point:
    """The point at a distance from p in the direction u."""
    return (p[0] + u[0] * distance, p[1] + u[1] * distance)


def unit(dx: float, dy: float) -> Point:
    """The vector with length 1; of no length: to the right."""
    size = math.hypot(dx, dy)
    return (dx / size, dy / size) if size else (1.0, 0.0)
