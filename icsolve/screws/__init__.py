"""Twists and wrenches; here joins, meets and pairings of the plane, on homogeneous triples.

A twist is ``(X, Y, W) = omega * (x, y, 1)`` with ``(x, y)`` the instant centre: a centre that keeps
its weight. A translation has W = 0, its centre lies at infinity. A wrench is
``(-Fy, Fx, M)`` with M the moment about the origin, so that the power of a wrench on a twist is
their scalar product (the pairing). Lines have the same coordinates as wrenches: the line through
two centres and the point where two lines meet are both cross products (J. Duffy, Statics and Kinematics
with Applications to Robotics, 1996, has both in the plane).

Units, wherever a `Triple` stands: twist [length/s, length/s, rad/s], wrench [force, force, force length],
centre [length, length, 1], counter-clockwise positive; a `Point` is (x, y) [length]. Each entry is a float
or an array of any shape (the same for all, or broadcast).

All functions are componentwise and branch-free: they run on floats, arrays, and any other number
type with + - *. None but `unit_between` refuses anything: a centre or line that does not exist comes out as
(0, 0, 0).
"""

from __future__ import annotations

from collections.abc import Mapping

from icsolve.numbers import Arithmetic, Scalar

Triple = tuple[Scalar, Scalar, Scalar]
Point = tuple[Scalar, Scalar]
Bases = Mapping[int, tuple[Triple, ...]]
"""Basis twists by bond."""
ORIGIN: Triple = (0.0, 0.0, 0.0)
FREE: tuple[Triple, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
"""Twists of a body that no joint holds."""


def pin_twist(p: Point) -> Triple:
    """Unit rotation about the point p [rad/s 1]: its instant centre."""
    return (p[0], p[1], 1.0)


def slide_twist(direction: Point) -> Triple:
    """Unit translation along a direction, a unit vector (cos, sin): its centre lies square to it."""
    return (-direction[1], direction[0], 0.0)


def normal_twist(normal: Point) -> Triple:
    """Unit translation square to a normal, a unit vector (cos, sin): its centre lies along it."""
    return (normal[0], normal[1], 0.0)


def unit_between(a: Point, b: Point, arithmetic: Arithmetic) -> tuple[Point, Scalar]:
    """Unit vector from a to b, and the distance; where they are one place it divides by zero."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = arithmetic.sqrt(dx * dx + dy * dy)
    return (dx / length, dy / length), length


def force_wrench(force: Point, p: Point) -> Triple:
    """Wrench of a force (Fx, Fy) [force] at the point p [length]."""
    return (-force[1], force[0], p[0] * force[1] - p[1] * force[0])


def velocity(twist: Triple, p: Point) -> Point:
    """Velocity [length/s] of the point p of a body with this twist: omega x (p - centre)."""
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
    """Power of a wrench on a twist [force length/s]: ``Fx vx + Fy vy + M omega`` at the origin.

    Of a line and a point it is zero where the point lies on the line.
    """
    return wrench[0] * twist[0] + wrench[1] * twist[1] + wrench[2] * twist[2]


def cross(a: Triple, b: Triple) -> Triple:
    """Join of two points (the line through them), meet of two lines (their point, W = 0 where parallel).

    (0, 0, 0) where both are the same.
    """
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def shift(a: Triple, o: Point) -> Triple:
    """A twist seen from the origin o [length], axes kept."""
    return (a[0] - a[2] * o[0], a[1] - a[2] * o[1], a[2])


def basis_at(o: Point, basis: Triple) -> Triple:
    """A basis twist seen from o: a turning about o itself is exactly one."""
    if basis[0] is o[0] and basis[1] is o[1] and type(basis[2]) is float and basis[2] == 1.0:
        return (0.0, 0.0, 1.0)
    return shift(basis, o)


def dyad_twists(b1: Triple, b3: Triple, b2: Triple, r: Triple) -> tuple[Scalar, Scalar, Scalar]:
    """Rates of a dyad without division.

    Link u hangs on a known link a by the freedom b1, link v on a known link c by b2, and b3 joins
    u and v. With ``r = t_c - t_a`` the loop closes as ``s1 b1 + s3 b3 - s2 b2 = r`` (Cramer).

    Parameters
    ----------
    b1, b3, b2 : basis twists of the joints, in the order of the links
    r : twist of c relative to a

    Returns
    -------
    tuple[Scalar, Scalar, Scalar]
        ``(D, s1 D, s2 D)``, and the twists are ``t_a + s1 b1`` and ``t_c + s2 b2``. D is zero where the three
        centres lie on one line: the dead centre of the input that drives a and c; it is a value here, no
        error.
    """
    m = cross(b3, b2)
    n = cross(b1, b3)
    return pairing(b1, m), pairing(r, m), -pairing(n, r)


def monad_twist(b: Triple, line: Triple, r: Triple) -> tuple[Scalar, Scalar]:
    """Rate of one link without division: ``(D, s D)``.

    The link hangs on a known link a by the freedom b and must stay on the line (a slot, contact or
    mesh) of a known link c; ``r = t_c - t_a``: the condition is ``line . (s b - r) = 0``. The twist is
    ``t_a + s b``; D is zero where the centre b lies on the line.

    Parameters
    ----------
    b : basis twist of the joint
    line : join of the two centres that the contact leaves, as a wrench
    r : twist of c relative to a
    """
    return pairing(line, b), pairing(line, r)
