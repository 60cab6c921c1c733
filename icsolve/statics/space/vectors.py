"""Vectors of three floats."""

from __future__ import annotations

import math

Vec = tuple[float, float, float]
ZERO: Vec = (0.0, 0.0, 0.0)
AXES: tuple[Vec, Vec, Vec] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def add(a: Vec, b: Vec) -> Vec:
    """a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a: Vec, b: Vec) -> Vec:
    """a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(s: float, a: Vec) -> Vec:
    """s a; a zero is positive."""
    return (s * a[0] + 0.0, s * a[1] + 0.0, s * a[2] + 0.0)


def dot(a: Vec, b: Vec) -> float:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vec, b: Vec) -> Vec:
    """Vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def size(a: Vec) -> float:
    """Length."""
    return math.hypot(*a)


def unit(a: Vec) -> Vec:
    """Unit vector along a; a must not be zero."""
    length = size(a)
    return (a[0] / length, a[1] / length, a[2] / length)


def square_to(axis: Vec) -> tuple[Vec, Vec]:
    """Two unit vectors square to a unit vector and to each other, along coordinate axes where they can be."""
    least = min(AXES, key=lambda e: (abs(dot(e, axis)), -e[0], -e[1]))
    first = unit(sub(least, times(dot(least, axis), axis)))
    return first, unit(cross(axis, first))
