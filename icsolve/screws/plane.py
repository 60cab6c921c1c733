"""Kernels of plane kinematics and statics on homogeneous triples.

A twist is ``(X, Y, W) = omega * (x, y, 1)`` with ``(x, y)`` the instant centre: a centre that keeps
its weight. A translation has W = 0, its centre lies at infinity. A wrench is
``(-Fy, Fx, M)`` with M the moment about the origin, so that the power of a wrench on a twist is
their scalar product (the pairing). Lines have the same coordinates as wrenches: the line through
two centres and the point where two lines meet are both cross products.

All functions are componentwise and branch-free: they run on floats, arrays, and any other number
type with + - *.
"""

from __future__ import annotations

from icsolve.numbers.arithmetic import Scalar

Triple = tuple[Scalar, Scalar, Scalar]
Point = tuple[Scalar, Scalar]


def pin_twist(p: Point) -> Triple:
    """Unit rotation about the point p."""
    return (p[0], p[1], 1.0)


def slide_twist(direction: Point) -> Triple:
    """Unit translation along a direction (cos, sin): its centre lies square to it."""
    return (-direction[1], direction[0], 0.0)


def normal_twist(normal: Point) -> Triple:
    """Unit translation square to a normal (cos, sin): its centre lies along the normal."""
    return (normal[0], normal[1], 0.0)


def force_wrench(force: Point, p: Point) -> Triple:
    """Wrench of a force at the point p."""
    return (-force[1], force[0], p[0] * force[1] - p[1] * force[0])


def velocity(twist: Triple, p: Point) -> Point:
    """Velocity of the point p of a body with this twist: omega x (p - centre)."""
    return (twist[1] - twist[2] * p[1], twist[2] * p[0] - twist[0])


def add(a: Triple, b: Triple) -> Triple:
    """Sum."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a: Triple, b: Triple) -> Triple:
    """Difference: of two twists, the relative twist (Aronhold-Kennedy: t_ij = t_j - t_i)."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(s: Scalar, a: Triple) -> Triple:
    """A multiple."""
    return (s * a[0], s * a[1], s * a[2])


def blend(s: Scalar, a: Triple, r: Scalar, b: Triple) -> Triple:
    """s a + r b."""
    return (s * a[0] + r * b[0], s * a[1] + r * b[1], s * a[2] + r * b[2])


def pairing(wrench: Triple, twist: Triple) -> Scalar:
    """Power of a wrench on a twist; zero says that a point lies on a line."""
    return wrench[0] * twist[0] + wrench[1] * twist[1] + wrench[2] * twist[2]


def cross(a: Triple, b: Triple) -> Triple:
    """Join of two points, meet of two lines."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def shift(a: Triple, o: Point) -> Triple:
    """A twist seen from the origin o (axes kept)."""
    return (a[0] - a[2] * o[0], a[1] - a[2] * o[1], a[2])


def dyad_twists(b1: Triple, b3: Triple, b2: Triple, r: Triple) -> tuple[Scalar, Scalar, Scalar]:
    """Rates of a dyad without division: ``(D, s1 D, s2 D)``.

    Link u hangs on a known link a by the freedom b1, link v on a known link c by b2, and b3 joins
    u and v. With ``r = t_c - t_a`` the loop closes as ``s1 b1 + s3 b3 - s2 b2 = r`` (Cramer). D is
    zero where the three centres lie on one line: the dead centre of the input that drives a and c.
    """
    m = cross(b3, b2)
    n = cross(b1, b3)
    return pairing(b1, m), pairing(r, m), -pairing(n, r)


def monad_twist(b: Triple, line: Triple, r: Triple) -> tuple[Scalar, Scalar]:
    """Rate of one link without division: ``(D, s D)``.

    The link hangs on a known link a by the freedom b and must stay on the line (a slot, contact or
    mesh) of a known link c; ``r = t_c - t_a``: the condition is ``line . (s b - r) = 0``.
    """
    return pairing(line, b), pairing(line, r)
