"""Motions and directions in space in words."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from icsolve.statics.space.figure import Figure
from icsolve.statics.space.motions import STILL, Twist
from icsolve.statics.space.vectors import AXES, Vec, cross, dot, size, sub, times, unit

SMALL = 1e-9
"""A part of a twist that is below this fraction of the whole is none (rounding)."""


def motion_words(link: str, motion: Mapping[str, Twist], figure: Figure) -> str:
    """How a link moves: `link 2 turns about the line through A along z`."""
    v, w = motion.get(link, STILL)
    fastest = max((size(p) + size(q) for p, q in motion.values()), default=0.0)
    if size(w) <= SMALL * fastest:
        return f"link {link} slides along {direction_words(unit(v))}"
    axis = unit(w)
    on_axis = times(1.0 / dot(w, w), cross(w, v))
    pitch = dot(v, axis) / size(w)
    screw = abs(pitch) > SMALL * (1.0 + size(v) / size(w))
    verb = "screws" if screw else "turns"
    return f"link {link} {verb} about the line {_line(on_axis, axis, figure)}"


def _line(p: Vec, axis: Vec, figure: Figure) -> str:
    """A line by the named points on it, or by a point and its direction."""
    shown = [(name, point) for name, point in figure.points.items() if not name.startswith("@")]
    named = [(name, point) for name, point in shown if _is_on(point, p, axis)]
    apart = [name for name, point in named if size(sub(point, named[0][1])) > SMALL]
    if apart:
        return f"through {named[0][0]} and {apart[0]}"
    if named:
        return f"through {named[0][0]} along {direction_words(axis)}"
    return f"through {point_words(figure.frame.shown(p))} along {direction_words(axis)}"


def _is_on(point: Vec, p: Vec, axis: Vec) -> bool:
    """Whether a point lies on the line through p along a unit vector."""
    apart = sub(point, p)
    return size(cross(apart, axis)) <= SMALL * (1.0 + size(apart))


def direction_words(direction: Vec) -> str:
    """``z``, ``-x``, or the components of the unit vector."""
    for name, axis in zip("xyz", AXES, strict=True):
        if size(cross(direction, axis)) <= SMALL:
            return name if dot(direction, axis) > 0.0 else f"-{name}"
    return point_words(direction)


def point_words(p: Vec) -> str:
    """Three numbers in brackets."""
    x, y, z = (0.0 if abs(c) <= SMALL * size(p) else c for c in p)
    return f"[{x:.6g}, {y:.6g}, {z:.6g}]"


def moving(motion: Mapping[str, Twist], first: Iterable[str]) -> str:
    """The first link that moves: of those named, or else of all."""
    fastest = max((size(v) + size(w) for v, w in motion.values()), default=0.0)
    moves = [link for link, (v, w) in motion.items() if size(v) + size(w) > SMALL * fastest]
    return next((link for link in first if link in moves), moves[0])
