"""Where two loci of a point meet: the kernels, written once for every kind of number.

The written figure and the driven one ask the same: in floats, in balls of decimals, on a tape, on a record.
Nothing here branches on a value. An intersection comes as its middle, the direction of the common chord, and
the two factors under its root, which must not be negative; callers test those.
"""

from __future__ import annotations

import math

from icsolve.numbers.arithmetic import Arithmetic, Scalar
from icsolve.screws.plane import Point
from icsolve.tuples import NamedTuple


class PlacedCircle(NamedTuple):
    """A circle: its centre (x, y) and radius [frame of size 1]."""

    centre: Point
    radius: Scalar


class PlacedLine(NamedTuple):
    """A line: a point (x, y) of it [frame of size 1] and a unit vector along it."""

    through: Point
    along: Point


PlacedLocus = PlacedCircle | PlacedLine

Factor = tuple[Scalar, Scalar]
"""A factor under a root, and the size of the terms that it is a difference of."""


class Intersection(NamedTuple):
    """Where two loci meet: at ``middle`` + and - the root of the product of the factors times ``chord``.

    Attributes
    ----------
    middle : (x, y) [frame]
    chord : the + place lies on this side of ``middle``; None: one place only, of two lines
    factors : negative where the loci do not meet; two, or none of two lines
    """

    middle: Point
    chord: Point | None = None
    factors: tuple[Factor, Factor] | None = None

    def at(self, root: Scalar) -> Point:
        """One of the two places, by the root with its sign."""
        (x, y), (cx, cy) = self.middle, self.chord or (0.0, 0.0)
        return (x + root * cx, y + root * cy)


def intersection(one: PlacedLocus, two: PlacedLocus) -> Intersection:
    """Where two loci meet; of a line and a circle either may come first.

    The first of two places (+) lies to the left of the way from the first circle's centre to the second's, or
    is the farther one along the line. Parallel lines and concentric circles divide by zero: whether they are
    is the caller's to test.
    """
    if isinstance(one, PlacedLine):
        return _of_lines(one, two) if isinstance(two, PlacedLine) else _of_line_and_circle(one, two)
    return _of_line_and_circle(two, one) if isinstance(two, PlacedLine) else _of_circles(one, two)


def _of_circles(one: PlacedCircle, two: PlacedCircle) -> Intersection:
    """Heron's formula on squares: ``((a + b)^2 - d^2)(d^2 - (a - b)^2)`` is (4 area)^2.

    In factors it loses nothing where the triangle is nearly flat (Kahan, "Miscalculating area and angles of a
    needle-like triangle").
    """
    (px, py), (qx, qy), a, b = one.centre, two.centre, one.radius, two.radius
    ex, ey = qx - px, qy - py
    d2 = ex * ex + ey * ey
    far, near = (a + b) * (a + b), (a - b) * (a - b)
    half = 0.5 / d2
    along = 0.5 + (a - b) * (a + b) * half
    middle = (px + along * ex, py + along * ey)
    return Intersection(middle, (-(half * ey), half * ex), ((far - d2, far + d2), (d2 - near, far + d2)))


def _of_line_and_circle(line: PlacedLine, circle: PlacedCircle) -> Intersection:
    (px, py), (vx, vy), (cx, cy), r = *line, *circle
    wx, wy = cx - px, cy - py
    off, along, reach = vx * wy - vy * wx, vx * wx + vy * wy, wx * wx + wy * wy
    middle = (px + along * vx, py + along * vy)
    return Intersection(middle, (vx, vy), ((r - off, r + reach), (r + off, r + reach)))


def _of_lines(one: PlacedLine, two: PlacedLine) -> Intersection:
    (px, py), (ux, uy), (qx, qy), (vx, vy) = *one, *two
    t = ((qx - px) * vy - (qy - py) * vx) / sine_between(one, two)
    return Intersection((px + t * ux, py + t * uy))


def side(one: PlacedLocus, two: PlacedLocus, at: Point) -> float:
    """Which of the two places where loci meet is the nearer to ``at``: +1.0, -1.0, or 0.0 of two lines.

    In floats, without a root and without a division: also where the loci do not meet.
    """
    if isinstance(one, PlacedLine):
        if isinstance(two, PlacedLine):
            return 0.0
        (x, y), (cx, cy) = two.centre, one.along
    elif isinstance(two, PlacedLine):
        (x, y), (cx, cy) = one.centre, two.along
    else:
        (x, y), (qx, qy) = one.centre, two.centre
        cx, cy = y - qy, qx - x
    return 1.0 if float((at[0] - x) * cx + (at[1] - y) * cy) >= 0.0 else -1.0


# --- whether they meet, and how well ---


def gaps_of(one: PlacedLocus, two: PlacedLocus, arithmetic: Arithmetic) -> tuple[Scalar, ...]:
    """By how much two loci meet [frame]: none is negative where they do. A line comes first if there is one.

    Of two lines the sine of the angle between them; of a line and a circle by how much it passes within the
    circle on either side; of two circles the three gaps of a triangle of the radii and the distance of the
    centres, and that distance: 0 where they are one point.
    """
    if isinstance(two, PlacedLine):
        assert isinstance(one, PlacedLine)
        return (sine_between(one, two),)
    (qx, qy), b = two
    if isinstance(one, PlacedLine):
        (px, py), (vx, vy) = one
        off = vx * (qy - py) - vy * (qx - px)
        return (b - off, b + off)
    (px, py), a = one
    dx, dy = qx - px, qy - py
    d = arithmetic.sqrt(dx * dx + dy * dy)
    return ((a + b) - d, d - (a - b), d + (a - b), d)


def sine_between(one: PlacedLine, two: PlacedLine) -> Scalar:
    """The sine of the angle between two lines."""
    (ux, uy), (vx, vy) = one.along, two.along
    return ux * vy - uy * vx


def crossing_sine(one: PlacedLocus, two: PlacedLocus, at: Point) -> float:
    """The size of the sine of the angle at which two loci cross at a place, in floats."""
    (ax, ay), (bx, by) = _normal(one, at), _normal(two, at)
    size = math.hypot(ax, ay) * math.hypot(bx, by)
    return abs(ax * by - ay * bx) / size if size else 0.0


def _normal(locus: PlacedLocus, at: Point) -> tuple[float, float]:
    if isinstance(locus, PlacedCircle):
        return float(at[0] - locus.centre[0]), float(at[1] - locus.centre[1])
    return float(-locus.along[1]), float(locus.along[0])
