"""Kernels of statics in space: vectors, forces with their couples, twists.

A wrench is (Fx, Fy, Fz, Mx, My, Mz) about a point that is said, a twist (vx, vy, vz, wx, wy, wz) with the
velocity of the point of the link at the origin. Units, wherever they stand: force [force], couple [force
times frame length], velocity [frame length/s], angular velocity [rad/s]; a point or vector `Vec` is (x, y, z)
[frame length]. Each entry is a float or any other number with + - * /.

All but `unit` and `square_to` refuse nothing; these divide by the length of a vector, which must not be zero.
"""

from __future__ import annotations

import math

from icsolve.numbers import FLOATS, Arithmetic, Scalar
from icsolve.screws import add, cross, subtract

Vec = tuple[Scalar, Scalar, Scalar]
Components = tuple[Scalar, ...]
"""(6,), a wrench or a twist."""

ZERO: Vec = (0.0, 0.0, 0.0)
AXES: tuple[Vec, Vec, Vec] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def times(s: Scalar, a: Vec) -> Vec:
    """s a; a zero is positive."""
    return (s * a[0] + 0.0, s * a[1] + 0.0, s * a[2] + 0.0)


def dot(a: Vec, b: Vec) -> Scalar:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def size(a: Vec, arithmetic: Arithmetic = FLOATS) -> Scalar:
    """Length; in floats also of what has no square."""
    return math.hypot(*a) if arithmetic is FLOATS else arithmetic.sqrt(dot(a, a))


def unit(a: Vec, arithmetic: Arithmetic = FLOATS) -> Vec:
    """Unit vector along a; a must not be zero."""
    length = size(a, arithmetic)
    return (a[0] / length, a[1] / length, a[2] / length)


def square_to(axis: Vec, arithmetic: Arithmetic) -> tuple[Vec, Vec]:
    """Two unit vectors square to a unit vector and to each other, along coordinate axes where they can be."""
    least = min(AXES, key=lambda e: (abs(float(dot(e, axis))), -e[0], -e[1]))
    first = unit(subtract(least, times(dot(least, axis), axis)), arithmetic)
    return first, unit(cross(axis, first), arithmetic)


def moved(wrench: Components, at: Components, about: Components) -> Components:
    """A wrench about ``at`` seen from ``about``: the couple M + (at - about) x F."""
    x, y, z, u, v, w = wrench
    a, b, c = at[0] - about[0], at[1] - about[1], at[2] - about[2]
    return (x, y, z, u + b * z - c * y, v + c * x - a * z, w + a * y - b * x)


def velocity_of(twist: Components, at: Components) -> Vec:
    """Velocity of the point of a link that is at ``at``: v + w x at."""
    return add((twist[0], twist[1], twist[2]), cross((twist[3], twist[4], twist[5]), (at[0], at[1], at[2])))


def spatial(place: tuple[float, ...]) -> Vec:
    """A place of the plane or of space by three coordinates."""
    x, y, *z = place
    return (x, y, z[0] if z else 0.0)
