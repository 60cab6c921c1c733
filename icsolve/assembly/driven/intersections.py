"""Closed forms: the loci of a spot, where they meet, and how far a link has swung."""

from __future__ import annotations

import math

from icsolve.assembly.driven.constraints import OnLine, RolledStraight, Roped, SpotDistance
from icsolve.assembly.driven.poses import (
    Places,
    Shape,
    Spot,
    Still,
    dot,
    minus,
    plus,
    product,
    quotient,
    scaled,
    square,
)
from icsolve.numbers.arithmetic import RADIAN, Scalar
from icsolve.numbers.record import Record
from icsolve.screws.plane import Point
from icsolve.tuples import NamedTuple


class RoundLocus(NamedTuple):
    """A circle: its centre and radius [frame]."""

    centre: Point
    radius: Scalar


class StraightLocus(NamedTuple):
    """A line by a place [frame] and a unit vector."""

    through: Point
    along: Point


PinLocus = RoundLocus | StraightLocus


def sine(one: PinLocus, two: PinLocus, at: Point) -> float:
    """Sine of the angle at which two loci cross at a place."""
    (ax, ay), (bx, by) = _normal(one, at), _normal(two, at)
    size = math.hypot(ax, ay) * math.hypot(bx, by)
    return abs(ax * by - ay * bx) / size if size else 0.0


def _normal(locus: PinLocus, at: Point) -> tuple[float, float]:
    x, y = minus(at, locus.centre) if isinstance(locus, RoundLocus) else square(locus.along)
    return float(x), float(y)


def side(one: PinLocus, two: PinLocus, at: Point) -> float:
    """Which of the two places where loci meet is ``at``: +1, -1, or 0 where there is only one.

    Two circles: left or right of the way from the first centre to the second. A line and a circle: ahead of
    the centre or behind it.
    """
    if isinstance(one, StraightLocus):
        if isinstance(two, StraightLocus):
            return 0.0
        return math.copysign(1.0, float(dot(minus(at, two.centre), one.along)))
    if isinstance(two, StraightLocus):
        return side(two, one, at)
    (dx, dy), (x, y) = minus(two.centre, one.centre), minus(at, one.centre)
    return math.copysign(1.0, float(dx * y - dy * x))


def meet(record: Record, one: PinLocus, two: PinLocus, sign: Scalar) -> Point:
    """The place where two loci meet.

    Parameters
    ----------
    record : on which the root and its margins are written
    one, two : the loci [frame]
    sign : +1 or -1, or a number of the record: the side as of `side`

    Returns
    -------
    Point
        (x, y) [frame]. Where they do not meet the root of what is negative counts as zero, and its margins on
        the record (`Record.root`) tell so; parallel lines divide by zero.
    """
    if isinstance(one, StraightLocus):
        if isinstance(two, StraightLocus):
            return _lines(one, two)
        return _line_circle(record, one, two, sign)
    if isinstance(two, StraightLocus):
        return _line_circle(record, two, one, sign)
    return _circles(record, one, two, sign)


def _circles(record: Record, one: RoundLocus, two: RoundLocus, sign: Scalar) -> Point:
    """Heron's formula on squares: ``((a + b)^2 - d^2)(d^2 - (a - b)^2)`` is (4 area)^2, in factors."""
    (a, b), e = (one.radius, two.radius), minus(two.centre, one.centre)
    d2 = dot(e, e)
    far, near = (a + b) * (a + b), (a - b) * (a - b)
    root = record.root((far - d2, far + d2), (d2 - near, far + d2))
    half = 0.5 / d2
    along, off = 0.5 + (a - b) * (a + b) * half, sign * (root * half)
    return plus(one.centre, (along * e[0] - off * e[1], along * e[1] + off * e[0]))


def _line_circle(record: Record, line: StraightLocus, circle: RoundLocus, sign: Scalar) -> Point:
    w, r = minus(circle.centre, line.through), circle.radius
    off, along = dot(square(line.along), w), dot(line.along, w)
    reach = dot(w, w)
    root = record.root((r - off, r + reach), (r + off, r + reach))
    return plus(line.through, scaled(along + sign * root, line.along))


def _lines(one: StraightLocus, two: StraightLocus) -> Point:
    w = minus(two.through, one.through)
    normal = square(two.along)
    t = dot(w, normal) / dot(one.along, normal)
    return plus(one.through, scaled(t, one.along))


def swung(record: Record, e: Point, along: Point, h: Scalar, sign: Scalar) -> Point:
    """The rotation after which a line passes a place at a given distance.

    Parameters
    ----------
    e : vector from the pivot of the line's body to the place [frame]
    along : unit vector along the line as written
    h : distance of the place to the left of the line through the pivot [frame]
    sign : +1 where the place lies ahead, -1 behind

    Returns
    -------
    Point
        Cosine and sine since the position as written.
    """
    d2 = dot(e, e)
    if isinstance(h, float) and h == 0.0:
        d = record.root((d2, 1.0), (1.0, 1.0))
        return quotient((sign * (e[0] / d), sign * (e[1] / d)), along)
    ahead = sign * record.root((d2 - h * h, d2 + h * h), (1.0, 1.0))
    x, y = product((ahead, h), along)
    return ((e[0] * x + e[1] * y) / d2, (e[1] * x - e[0] * y) / d2)


# --- the loci of a spot: about another spot of its body, or what a joint leaves to a body that has turned ---


class Through(NamedTuple):
    """The spot is on the circle about another spot of its body."""

    spot: Spot
    pivot: Spot


class ThroughTurned(NamedTuple):
    """The spot is on the locus that a condition gives to a body.

    ``own`` is the body's spot that the condition speaks of; None where it speaks of the body's line.
    A spot other than ``own`` needs a body whose rotation is known.
    """

    spot: Spot
    by: OnLine | SpotDistance | RolledStraight | Roped
    own: Spot | None


By = Through | ThroughTurned


def locus(shape: Shape, places: Places, by: By) -> PinLocus:
    """The locus where the bodies are."""
    if isinstance(by, Through):
        return RoundLocus(places.place(by.pivot), shape.span(by.spot, by.pivot))
    c = by.by
    if isinstance(c, SpotDistance):
        own, other = (c.one, c.two) if by.own == c.one else (c.two, c.one)
        return RoundLocus(plus(places.place(other), _off(shape, places, own, by.spot)), c.distance)
    if isinstance(c, Roped):
        assert by.own is not None
        tied = c.tied_to(by.own)
        assert tied is not None
        left = -c.longer(places, shape.record, shape.record.turns, by.own) / float(tied[1])
        return RoundLocus(plus(places.place(tied[0]), _off(shape, places, by.own, by.spot)), left)
    if by.own is None:
        return _of_line(shape, places, c, by.spot)
    along = places.vector(c.line.body, c.line.along)
    through = plus(places.point(c.line.body, c.line.through), _off(shape, places, by.own, by.spot))
    if isinstance(c, OnLine):
        return StraightLocus(plus(through, scaled(c.offset, square(along))), along)
    return StraightLocus(plus(through, scaled(_way(places, c), along)), square(along))


def _of_line(shape: Shape, places: Places, c: OnLine | RolledStraight, spot: Spot) -> StraightLocus:
    """Of a body whose line meets a known spot: so lies a spot of that body."""
    body = spot[0]
    along = places.vector(body, c.line.along)
    x, y = shape.ref[spot[1]]
    from_line = places.vector(body, minus((x, y), c.line.through))
    if isinstance(c, OnLine):
        foot = minus(places.place(c.spot), scaled(c.offset, square(along)))
        return StraightLocus(plus(foot, from_line), along)
    foot = minus(places.place(c.centre), scaled(_way(places, c), along))
    return StraightLocus(plus(foot, from_line), square(along))


def _way(places: Places, c: RolledStraight) -> Scalar:
    """How far the centre has gone along the flank."""
    turned = places.degrees(c.centre[0]) - places.degrees(c.line.body)
    return -(c.radius * (turned * RADIAN))


def _off(shape: Shape, places: Places, own: Spot, spot: Spot) -> Point:
    """Vector from the body's own spot to another of its spots."""
    if shape.one(own) == shape.one(spot):
        return (0.0, 0.0)
    return places.vector(spot[0], shape.between((spot[0], own[1]), spot))


def reference(shape: Shape, by: By, spot: Spot) -> PinLocus:
    """The locus in the position as written, in floats."""
    found = locus(shape, Still(shape), by)
    if isinstance(found, RoundLocus):
        return RoundLocus(_floats(found.centre), float(found.radius))
    return StraightLocus(_floats(found.through), _floats(found.along))


def _floats(p: Point) -> Point:
    return (float(p[0]), float(p[1]))
