"""The exact pieces of a profile: straight lines, circular arcs, and a radius against the angle.

Every piece runs from ``u`` = 0 to 1; a profile is run ccw, so that its outside lies to the right. Places
are (x, y) [case length], angles rad, tangents and directions unit vectors. ``nearest`` and ``farthest`` give
u, from a start near there (which straight lines and arcs do not need).

Periodic cubic spline: twice continuously differentiable through values at given places of a period.

C. de Boor, A Practical Guide to Splines, 1978, ch. IV; the cyclic system by Sherman and Morrison's formula.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache

from icsolve.numbers import Scalar
from icsolve.tuples import NamedTuple

Point = tuple[float, float]
Slope = Callable[[float], tuple[float, float]]
"""A derivative by the angle, and its own derivative, at u."""
TURN = 2.0 * math.pi
NEWTON = 60
"""Steps of Newton's method at most; it halves where it does not get nearer."""


class Straight(NamedTuple):
    """A straight line from a to b."""

    a: Point
    b: Point

    def at(self, u: float) -> Point:
        """The point at u; exact at both ends."""
        if u == 1.0:
            return self.b
        return (self.a[0] + u * (self.b[0] - self.a[0]), self.a[1] + u * (self.b[1] - self.a[1]))

    def tangent(self, u: float) -> Point:
        """Unit vector along the line."""
        return unit(self.b[0] - self.a[0], self.b[1] - self.a[1])

    def nearest(self, p: Point, start: float) -> float:
        """Where the line is nearest to p."""
        dx, dy = self.b[0] - self.a[0], self.b[1] - self.a[1]
        u = ((p[0] - self.a[0]) * dx + (p[1] - self.a[1]) * dy) / (dx * dx + dy * dy)
        return min(max(u, 0.0), 1.0)

    def radius_at(self, u: float) -> float | None:
        """None: it is straight."""
        return None

    def farthest(self, way: Point, start: float) -> float:
        """Where the line reaches farthest in a direction."""
        rise = way[0] * (self.b[0] - self.a[0]) + way[1] * (self.b[1] - self.a[1])
        return 1.0 if rise > 0.0 else 0.0

    def reversed(self) -> Straight:
        """The same line from its end to its start."""
        return Straight(self.b, self.a)

    def chords(self) -> int:
        """Into how many chords it is cut for a rough look."""
        return 1


class CircularArc(NamedTuple):
    """An arc.

    Attributes
    ----------
    centre, radius : [case length]
    start : angle at u = 0 [rad]
    sweep : angle over which it goes [rad], ccw positive, not zero
    """

    centre: Point
    radius: float
    start: float
    sweep: float

    def at(self, u: float) -> Point:
        """The point at u."""
        angle = self.start + u * self.sweep
        return (
            self.centre[0] + self.radius * math.cos(angle),
            self.centre[1] + self.radius * math.sin(angle),
        )

    def tangent(self, u: float) -> Point:
        """Unit vector along the arc."""
        angle = self.start + u * self.sweep
        sign = 1.0 if self.sweep > 0.0 else -1.0
        return (-sign * math.sin(angle), sign * math.cos(angle))

    def nearest(self, p: Point, start: float) -> float:
        """Where the arc is nearest to p."""
        x, y = p[0] - self.centre[0], p[1] - self.centre[1]
        u = self.place(math.atan2(y, x))
        if u <= 1.0:
            return u
        return min((0.0, 1.0), key=lambda end: math.dist(self.at(end), p))

    def radius_at(self, u: float) -> float | None:
        """Radius of curvature, negative where the outside of a profile is hollow."""
        return math.copysign(self.radius, self.sweep)

    def farthest(self, way: Point, start: float) -> float:
        """Where the arc reaches farthest in a direction."""
        u = self.place(math.atan2(way[1], way[0]))
        if u <= 1.0:
            return u
        return max((0.0, 1.0), key=lambda end: _along(self.at(end), way))

    def place(self, angle: float) -> float:
        """u of a direction from the centre; above 1 where the arc does not go there."""
        return ((angle - self.start) * math.copysign(1.0, self.sweep)) % TURN / abs(self.sweep)

    def reversed(self) -> CircularArc:
        """The same arc from its end to its start."""
        return CircularArc(self.centre, self.radius, self.start + self.sweep, -self.sweep)

    def chords(self) -> int:
        """Two degrees each."""
        return max(2, math.ceil(abs(self.sweep) / TURN * 180.0))


class PolarPiece(NamedTuple):
    """A closed curve: the radius about a point as a spline of the angle.

    Attributes
    ----------
    about : the point [case length]
    zero : direction from which the angle counts [rad, ccw from +x]
    turn : 1 where the angle is ccw, -1 where it is cw; u runs ccw in both cases
    radius : by the angle [rad], in case lengths, positive, of period 2 pi
    """

    about: Point
    zero: float
    turn: float
    radius: Spline

    def angle(self, u: float) -> float:
        """The angle of the table at u."""
        return self.turn * u * TURN

    def at(self, u: float) -> Point:
        """The point at u."""
        r, _, _ = self.radius.at(self.angle(u))
        way = self.zero + u * TURN
        return (self.about[0] + r * math.cos(way), self.about[1] + r * math.sin(way))

    def derivatives(self, u: float) -> tuple[Point, Point, Point]:
        """The point from ``about``, and its first two derivatives by the ccw angle [case length, a rad, a
        rad^2].
        """
        r, slope, bend = self.radius.at(self.angle(u))
        slope *= self.turn
        c, s = math.cos(self.zero + u * TURN), math.sin(self.zero + u * TURN)
        first = (slope * c - r * s, slope * s + r * c)
        second = ((bend - r) * c - 2.0 * slope * s, (bend - r) * s + 2.0 * slope * c)
        return (r * c, r * s), first, second

    def tangent(self, u: float) -> Point:
        """Unit vector along the curve."""
        return unit(*self.derivatives(u)[1])

    def radius_at(self, u: float) -> float | None:
        """Radius of curvature [case length], ``|p'|^3 / (p' x p'')``: negative where it is hollow; None where
        it is straight.
        """
        _, (x, y), (bx, by) = self.derivatives(u)
        bend = x * by - y * bx
        return math.hypot(x, y) ** 3 / bend if bend else None

    def nearest(self, p: Point, start: float) -> float:
        """Where the curve is nearest to p, from a start near there."""
        x, y = p[0] - self.about[0], p[1] - self.about[1]

        def slope(u: float) -> tuple[float, float]:
            (cx, cy), (tx, ty), (bx, by) = self.derivatives(u)
            dx, dy = cx - x, cy - y
            return dx * tx + dy * ty, tx * tx + ty * ty + dx * bx + dy * by

        return self._flat(slope, start)

    def farthest(self, way: Point, start: float) -> float:
        """Where the curve reaches farthest in a direction, from a start near there."""

        def slope(u: float) -> tuple[float, float]:
            _, (tx, ty), (bx, by) = self.derivatives(u)
            return -(tx * way[0] + ty * way[1]), -(bx * way[0] + by * way[1])

        return self._flat(slope, start)

    def _flat(self, slope: Slope, start: float) -> float:
        """Newton to where a slope vanishes, kept between a chord before and a chord after the start."""
        room = 1.5 / self.chords()
        low, high = start - room, start + room
        u = start
        for _ in range(NEWTON):
            value, rate = slope(u)
            low, high = (low, u) if value > 0.0 else (u, high)
            step = value / rate / TURN if rate > 0.0 else math.inf
            new = u - step if low <= u - step <= high else 0.5 * (low + high)
            if new == u or value == 0.0:
                break
            u = new
        return u % 1.0

    def chords(self) -> int:
        """Two thirds of a degree at most, and eight to a value of the table."""
        return max(540, 8 * len(self.radius.places))

    def along(self) -> Iterator[Point]:
        """The points at which its chords begin."""
        count = self.chords()
        for k, r in enumerate(_radii(self.radius, self.turn, count)):
            way = self.zero + k / count * TURN
            yield self.about[0] + r * math.cos(way), self.about[1] + r * math.sin(way)


@lru_cache(maxsize=32)
def _radii(radius: Spline, turn: float, count: int) -> tuple[float, ...]:
    """The radii of a curve at the ends of its chords, ccw: the same wherever its body is."""
    return tuple([radius.at(turn * (k / count) * TURN)[0] for k in range(count)])


Piece = Straight | CircularArc | PolarPiece


def unit(x: float, y: float) -> Point:
    """Unit vector along (x, y); ZeroDivisionError for (0, 0)."""
    length = math.hypot(x, y)
    return (x / length, y / length)


def _along(p: Point, way: Point) -> float:
    return p[0] * way[0] + p[1] * way[1]


class Spline(NamedTuple):
    """A periodic cubic spline of n places.

    Attributes
    ----------
    places : (n,), increasing, within one period
    values, bends : (n,), values and second derivatives there
    period : in the unit of the places
    """

    places: tuple[Scalar, ...]
    values: tuple[Scalar, ...]
    bends: tuple[Scalar, ...]
    period: float

    def at(self, x: float) -> tuple[float, float, float]:
        """Value, first and second derivative at any x."""
        x = self.places[0] + (x - self.places[0]) % self.period
        k = min(bisect_right(self.places, x), len(self.places)) - 1
        return self.between(k, x - self.places[k])

    def step(self, k: int) -> Scalar:
        """How far the next place is beyond the k-th."""
        n = (k + 1) % len(self.places)
        return self.places[n] - self.places[k] + (self.period if n <= k else 0.0)

    def between(self, k: int, beyond: Scalar) -> tuple[Scalar, Scalar, Scalar]:
        """The same of the cubic that begins at the k-th place, at a distance beyond it."""
        n, h = (k + 1) % len(self.places), self.step(k)
        b = beyond / h
        a = 1.0 - b
        p, q, r, s = self.values[k], self.values[n], self.bends[k], self.bends[n]
        value = a * p + b * q + ((a * a * a - a) * r + (b * b * b - b) * s) * h * h / 6.0
        slope = (q - p) / h + ((3.0 * b * b - 1.0) * s - (3.0 * a * a - 1.0) * r) * h / 6.0
        return value, slope, a * r + b * s


def spline(places: Sequence[Scalar], values: Sequence[Scalar], period: float) -> Spline:
    """The periodic spline through values.

    Parameters
    ----------
    places : (n,), at least three, increasing, within one period
    values : (n,)
    period : in the unit of the places

    Nothing is checked: two places at one divide by zero.
    """
    n = len(places)
    steps = [places[(k + 1) % n] - places[k] + (period if k == n - 1 else 0.0) for k in range(n)]
    slopes = [(values[(k + 1) % n] - values[k]) / steps[k] for k in range(n)]
    middle = [2.0 * (steps[k - 1] + steps[k]) for k in range(n)]
    right = [6.0 * (slopes[k] - slopes[k - 1]) for k in range(n)]
    return Spline(tuple(places), tuple(values), tuple(_cyclic(steps, middle, right)), period)


def _cyclic(steps: Sequence[Scalar], middle: Sequence[Scalar], right: Sequence[Scalar]) -> list[Scalar]:
    """Solve ``steps[k-1] x[k-1] + middle[k] x[k] + steps[k] x[k+1] = right[k]``, cyclic."""
    corner, gamma = steps[-1], -middle[0]
    diagonal = list(middle)
    diagonal[0] -= gamma
    diagonal[-1] -= corner * corner / gamma
    u = [gamma, *([0.0] * (len(steps) - 2)), corner]
    y, z = _tridiagonal(steps, diagonal, right), _tridiagonal(steps, diagonal, u)
    ratio = corner / gamma
    factor = (y[0] + ratio * y[-1]) / (1.0 + z[0] + ratio * z[-1])
    return [a - factor * b for a, b in zip(y, z, strict=True)]


def _tridiagonal(
    steps: Sequence[Scalar], diagonal: Sequence[Scalar], right: Sequence[Scalar]
) -> list[Scalar]:
    """Thomas's elimination; the matrix is symmetric with ``steps`` beside the diagonal."""
    n = len(diagonal)
    ratios: list[Scalar] = [0.0] * n
    x: list[Scalar] = [0.0] * n
    pivot = diagonal[0]
    x[0] = right[0] / pivot
    for k in range(1, n):
        ratios[k] = steps[k - 1] / pivot
        pivot = diagonal[k] - steps[k - 1] * ratios[k]
        x[k] = (right[k] - steps[k - 1] * x[k - 1]) / pivot
    for k in range(n - 2, -1, -1):
        x[k] -= ratios[k + 1] * x[k + 1]
    return x
