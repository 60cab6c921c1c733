"""Closed forms: where the loci of a spot meet, and how far a link has swung.

Each writes its operations into the record once. A square root that picks between two places takes the
sign of the position as written (`signs` says otherwise for the rows beyond a change point).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from icsolve.numbers.arithmetic import Scalar
from icsolve.numbers.record import Record
from icsolve.screws.plane import Point
from icsolve.sweep.poses import dot, minus, plus, product, quotient, scaled, square


class Circle(NamedTuple):
    """About a place."""

    centre: Point
    radius: Scalar


class Straight(NamedTuple):
    """A line by a place and a unit vector."""

    through: Point
    along: Point


Locus = Circle | Straight


def sine(one: Locus, two: Locus, at: Point) -> float:
    """Sine of the angle at which two loci cross at a place."""
    (ax, ay), (bx, by) = _normal(one, at), _normal(two, at)
    size = math.hypot(ax, ay) * math.hypot(bx, by)
    return abs(ax * by - ay * bx) / size if size else 0.0


def _normal(locus: Locus, at: Point) -> tuple[float, float]:
    x, y = minus(at, locus.centre) if isinstance(locus, Circle) else square(locus.along)
    return float(x), float(y)


def side(one: Locus, two: Locus, at: Point) -> float:
    """Which of the two places is ``at``: +1, -1, or 0 where there is only one."""
    if isinstance(one, Straight):
        if isinstance(two, Straight):
            return 0.0
        return math.copysign(1.0, float(dot(minus(at, two.centre), one.along)))
    if isinstance(two, Straight):
        return side(two, one, at)
    (dx, dy), (x, y) = minus(two.centre, one.centre), minus(at, one.centre)
    return math.copysign(1.0, float(dx * y - dy * x))


def meet(record: Record, one: Locus, two: Locus, sign: Scalar) -> Point:
    """The place where two loci meet, on the side that ``side`` tells by its sign."""
    if isinstance(one, Straight):
        if isinstance(two, Straight):
            return _lines(one, two)
        return _line_circle(record, one, two, sign)
    if isinstance(two, Straight):
        return _line_circle(record, two, one, sign)
    return _circles(record, one, two, sign)


def _circles(record: Record, one: Circle, two: Circle, sign: Scalar) -> Point:
    """Heron's formula on squares: ``((a + b)^2 - d^2)(d^2 - (a - b)^2)`` is (4 area)^2, in factors."""
    (a, b), e = (one.radius, two.radius), minus(two.centre, one.centre)
    d2 = dot(e, e)
    far, near = (a + b) * (a + b), (a - b) * (a - b)
    root = record.root((far - d2, far + d2), (d2 - near, far + d2))
    half = 0.5 / d2
    along, off = 0.5 + (a - b) * (a + b) * half, sign * (root * half)
    return plus(one.centre, (along * e[0] - off * e[1], along * e[1] + off * e[0]))


def _line_circle(record: Record, line: Straight, circle: Circle, sign: Scalar) -> Point:
    w, r = minus(circle.centre, line.through), circle.radius
    off, along = dot(square(line.along), w), dot(line.along, w)
    reach = dot(w, w)
    root = record.root((r - off, r + reach), (r + off, r + reach))
    return plus(line.through, scaled(along + sign * root, line.along))


def _lines(one: Straight, two: Straight) -> Point:
    w = minus(two.through, one.through)
    normal = square(two.along)
    t = dot(w, normal) / dot(one.along, normal)
    return plus(one.through, scaled(t, one.along))


def swung(record: Record, e: Point, along: Point, h: Scalar, sign: Scalar) -> Point:
    """Cosine and sine of the rotation after which the line ``along`` passes ``h`` beside: e then has the
    component h to its left, and ``sign`` says whether it lies ahead."""
    d2 = dot(e, e)
    if isinstance(h, float) and h == 0.0:
        d = record.root((d2, 1.0), (1.0, 1.0))
        return quotient((sign * (e[0] / d), sign * (e[1] / d)), along)
    ahead = sign * record.root((d2 - h * h, d2 + h * h), (1.0, 1.0))
    x, y = product((ahead, h), along)
    return ((e[0] * x + e[1] * y) / d2, (e[1] * x - e[0] * y) / d2)
