"""The loci that links and joints leave to a spot, and how far a link has turned toward a line."""

from __future__ import annotations

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
from icsolve.assembly.intersections import PlacedCircle, PlacedLine, PlacedLocus
from icsolve.numbers.arithmetic import RADIAN, Scalar
from icsolve.numbers.record import Record
from icsolve.screws.plane import Point
from icsolve.tuples import NamedTuple


def rotation_to_line(record: Record, e: Point, along: Point, h: Scalar, sign: Scalar) -> Point:
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


def locus(shape: Shape, places: Places, by: By) -> PlacedLocus:
    """The locus where the bodies are."""
    if isinstance(by, Through):
        return PlacedCircle(places.place(by.pivot), shape.span(by.spot, by.pivot))
    c = by.by
    if isinstance(c, SpotDistance):
        own, other = (c.one, c.two) if by.own == c.one else (c.two, c.one)
        return PlacedCircle(plus(places.place(other), _off(shape, places, own, by.spot)), c.distance)
    if isinstance(c, Roped):
        assert by.own is not None
        tied = c.tied_to(by.own)
        assert tied is not None
        left = -c.longer(places, shape.record, shape.record.turns, by.own) / float(tied[1])
        return PlacedCircle(plus(places.place(tied[0]), _off(shape, places, by.own, by.spot)), left)
    if by.own is None:
        return _of_line(shape, places, c, by.spot)
    along = places.vector(c.line.body, c.line.along)
    through = plus(places.point(c.line.body, c.line.through), _off(shape, places, by.own, by.spot))
    if isinstance(c, OnLine):
        return PlacedLine(plus(through, scaled(c.offset, square(along))), along)
    return PlacedLine(plus(through, scaled(_way(places, c), along)), square(along))


def _of_line(shape: Shape, places: Places, c: OnLine | RolledStraight, spot: Spot) -> PlacedLine:
    """Of a body whose line meets a known spot: so lies a spot of that body."""
    body = spot[0]
    along = places.vector(body, c.line.along)
    x, y = shape.ref[spot[1]]
    from_line = places.vector(body, minus((x, y), c.line.through))
    if isinstance(c, OnLine):
        foot = minus(places.place(c.spot), scaled(c.offset, square(along)))
        return PlacedLine(plus(foot, from_line), along)
    foot = minus(places.place(c.centre), scaled(_way(places, c), along))
    return PlacedLine(plus(foot, from_line), square(along))


def _way(places: Places, c: RolledStraight) -> Scalar:
    """How far the centre has gone along the flank."""
    turned = places.degrees(c.centre[0]) - places.degrees(c.line.body)
    return -(c.radius * (turned * RADIAN))


def _off(shape: Shape, places: Places, own: Spot, spot: Spot) -> Point:
    """Vector from the body's own spot to another of its spots."""
    if shape.one(own) == shape.one(spot):
        return (0.0, 0.0)
    return places.vector(spot[0], shape.between((spot[0], own[1]), spot))


def reference(shape: Shape, by: By, spot: Spot) -> PlacedLocus:
    """The locus in the position as written, in floats."""
    found = locus(shape, Still(shape), by)
    if isinstance(found, PlacedCircle):
        return PlacedCircle(_floats(found.centre), float(found.radius))
    return PlacedLine(_floats(found.through), _floats(found.along))


def _floats(p: Point) -> Point:
    return (float(p[0]), float(p[1]))
