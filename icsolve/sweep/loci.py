"""The loci of a spot: about another spot of its body, or what a joint leaves to a body that has turned."""

from __future__ import annotations

from typing import NamedTuple

from icsolve.numbers.arithmetic import Scalar
from icsolve.screws.plane import Point
from icsolve.sweep.constraints import RADIAN, Apart, OnLine, RolledStraight
from icsolve.sweep.meeting import Circle, Locus, Straight
from icsolve.sweep.poses import Places, Shape, Spot, Still, minus, plus, scaled, square


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
    by: OnLine | Apart | RolledStraight
    own: Spot | None


By = Through | ThroughTurned


def locus(shape: Shape, places: Places, by: By) -> Locus:
    """The locus where the bodies are."""
    if isinstance(by, Through):
        return Circle(places.place(by.pivot), shape.span(by.spot, by.pivot))
    c = by.by
    if isinstance(c, Apart):
        own, other = (c.one, c.two) if by.own == c.one else (c.two, c.one)
        return Circle(plus(places.place(other), _off(shape, places, own, by.spot)), c.distance)
    if by.own is None:
        return _of_line(shape, places, c, by.spot)
    along = places.vector(c.line.body, c.line.along)
    through = plus(places.point(c.line.body, c.line.through), _off(shape, places, by.own, by.spot))
    if isinstance(c, OnLine):
        return Straight(plus(through, scaled(c.offset, square(along))), along)
    return Straight(plus(through, scaled(_way(places, c), along)), square(along))


def _of_line(shape: Shape, places: Places, c: OnLine | RolledStraight, spot: Spot) -> Straight:
    """Of a body whose line meets a known spot: so lies a spot of that body."""
    body = spot[0]
    along = places.vector(body, c.line.along)
    x, y = shape.ref[spot[1]]
    from_line = places.vector(body, minus((x, y), c.line.through))
    if isinstance(c, OnLine):
        foot = minus(places.place(c.spot), scaled(c.offset, square(along)))
        return Straight(plus(foot, from_line), along)
    foot = minus(places.place(c.centre), scaled(_way(places, c), along))
    return Straight(plus(foot, from_line), square(along))


def _way(places: Places, c: RolledStraight) -> Scalar:
    """How far the centre has gone along the flank."""
    turned = places.degrees(c.centre[0]) - places.degrees(c.line.body)
    return -(c.radius * (turned * RADIAN))


def _off(shape: Shape, places: Places, own: Spot, spot: Spot) -> Point:
    """Vector from the body's own spot to another of its spots."""
    if shape.one(own) == shape.one(spot):
        return (0.0, 0.0)
    return places.vector(spot[0], shape.between((spot[0], own[1]), spot))


def reference(shape: Shape, by: By, spot: Spot) -> Locus:
    """The locus in the position as written, in floats."""
    found = locus(shape, Still(shape), by)
    if isinstance(found, Circle):
        return Circle(_floats(found.centre), float(found.radius))
    return Straight(_floats(found.through), _floats(found.along))


def _floats(p: Point) -> Point:
    return (float(p[0]), float(p[1]))
