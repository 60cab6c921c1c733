"""Profiles and followers where the figure puts them, in case units."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from icsolve.cams.curve import Curve, curve_of
from icsolve.cams.pieces import TURN, Bow, Piece, Point, Polar, Straight, unit
from icsolve.cams.spline import Spline, spline
from icsolve.case import Number
from icsolve.case.profiles import (
    Arc,
    Arcs,
    Circle,
    Flat,
    Follower,
    Knife,
    Line,
    Polygon,
    Radii,
    Roller,
    Shape,
)
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import turn_of

Places = Mapping[str, Point]
AGREE = 2e-3
"""Two radii of one arc may differ by this fraction."""


class Body(NamedTuple):
    """A follower in one position: its point, the radius of its roller, or the unit direction of its face."""

    kind: str
    at: Point
    radius: float = 0.0
    face: Point = (0.0, 0.0)


def body_of(follower: Follower, places: Places, what: str) -> Body:
    """A follower where it is.

    Raises SceneError where its face has no direction.
    """
    match follower:
        case Knife(at):
            return Body("knife edge", places[at])
        case Roller(at, radius):
            return Body("roller", places[at], radius.value)
        case Flat(at, along):
            return Body("flat face", places[at], 0.0, direction(along, places, f"the face of {what}"))


def direction(line: Line, places: Places, what: str) -> Point:
    """Unit vector of a direction in degrees, or from one point to another.

    Raises SceneError where the points lie at one place.
    """
    if isinstance(line, Number):
        return turn_of(line.value)
    (ax, ay), (bx, by) = places[line[0]], places[line[1]]
    if (ax, ay) == (bx, by):
        raise SceneError(
            Status.INCONSISTENT,
            f"{what} has no direction: {line[0]} and {line[1]} lie at one place. Give it by an angle, or "
            "correct the points.",
        )
    return unit(bx - ax, by - ay)


def placed(shape: Shape, places: Places, what: str) -> Curve:
    """A profile as a curve.

    Raises SceneError where it crosses itself, or is of no size.
    """
    pieces = pieces_of(shape, places, what)
    flat = all(isinstance(piece, Straight) and piece.a == piece.b for piece in pieces)
    curve = None if flat else curve_of([p for p in pieces if not isinstance(p, Straight) or p.a != p.b])
    if curve is None:
        raise SceneError(
            Status.INCONSISTENT,
            f"{what} crosses itself, or encloses nothing: it should be one closed line around its inside. "
            "Correct the order of its corners or arcs, or its radii.",
        )
    return curve


def pieces_of(shape: Shape, places: Places, what: str) -> list[Piece]:
    """The exact pieces of a profile, in the order of the case."""
    match shape:
        case Polygon(corners):
            ends = [places[corner] for corner in corners]
            return [Straight(a, b) for a, b in zip(ends, [*ends[1:], ends[0]], strict=True)]
        case Circle(centre, radius):
            return [Bow(places[centre], radius.value, 0.0, TURN)]
        case Arcs(arcs):
            return [_bow(arc, places, what) for arc in arcs]
        case Radii():
            return [_polar(shape, places, what)]


def _bow(arc: Arc, places: Places, what: str) -> Bow:
    centre = places[arc.centre]
    start, stop = (_bearing(end, arc, places, what) for end in (arc.start, arc.stop))
    sweep = (stop - start) % TURN if arc.turns == "ccw" else -((start - stop) % TURN)
    radii = [math.dist(centre, places[end]) for end in (arc.start, arc.stop) if isinstance(end, str)]
    radius = arc.radius.value if arc.radius is not None else radii[0]
    if arc.radius is None and any(abs(other - radius) > AGREE * radius for other in radii):
        raise SceneError(
            Status.INCONSISTENT,
            f"the arc about {arc.centre} of {what} begins {radii[0]:.6g} and ends {radii[-1]:.6g} from its "
            "centre. Correct a point, or give the `radius`.",
        )
    return Bow(centre, radius, start, sweep or math.copysign(TURN, sweep))


def _bearing(end: Number | str, arc: Arc, places: Places, what: str) -> float:
    """The direction from the centre of an arc to its end, rad."""
    if isinstance(end, Number):
        return math.radians(end.value)
    x, y = direction((arc.centre, end), places, f"an end of the arc about {arc.centre} of {what}")
    return math.atan2(y, x)


def _polar(shape: Radii, places: Places, what: str) -> Polar:
    x, y = direction(shape.zero, places, f"the zero of {what}")
    turn = 1.0 if shape.turns == "ccw" else -1.0
    radius = table_spline([(angle.value, r.value) for angle, r in shape.table])
    curve = Polar(places[shape.about], math.atan2(y, x), turn, radius)
    if min(radius.at(curve.angle(k / 720.0))[0] for k in range(720)) <= 0.0:
        raise SceneError(
            Status.INCONSISTENT,
            f"{what} crosses itself: between its values the spline through its radii falls to zero. Give "
            "more of them.",
        )
    return curve


def table_spline(table: Sequence[tuple[float, float]]) -> Spline:
    """The periodic spline through radii by angle (degrees, in any order)."""
    ordered = sorted((math.radians(angle) % TURN, radius) for angle, radius in table)
    return spline([angle for angle, _ in ordered], [radius for _, radius in ordered], TURN)
