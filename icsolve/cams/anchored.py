"""Profiles whose every direction is told by points of their link, so that all of them moves with it."""

from __future__ import annotations

import math
from dataclasses import replace

from icsolve.cams.freedom import Places, places_of
from icsolve.cams.pieces import Point
from icsolve.case import Case, Coordinates, Number
from icsolve.case.profiles import Arc, Arcs, Flat, Follower, Radii, Shape, points_of


def anchored(case: Case) -> Case:
    """The case with hidden points in the place of directions in degrees, carried by the links that have them.

    Raises SceneError where a point of a profile is not determined.
    """
    assert case.profiles is not None
    shapes, points, carries = {}, dict(case.points), dict(case.carries)
    for link, shape in case.profiles.shapes.items():
        own = _Anchors(link, places_of(case, points_of(shape)))
        shapes[link] = own.of(shape)
        points |= {name: coordinates(name, place) for name, place in own.added.items()}
        carries[link] = (*carries.get(link, ()), *own.added)
    profiles = case.profiles._replace(shapes=shapes)
    return replace(case, profiles=profiles, points=points, carries=carries)


def coordinates(name: str, place: Point) -> Coordinates:
    """A hidden point's place as it would be given."""
    x, y = (Number(v, 0.0, f"points.{name}.{axis}", repr(v)) for v, axis in zip(place, "xy", strict=True))
    return Coordinates(x, y)


class _Anchors:
    """The points that stand for the directions of one profile."""

    def __init__(self, link: str, places: Places) -> None:
        self.link, self.places = link, places
        self.added: dict[str, Point] = {}

    def of(self, shape: Shape | Follower) -> Shape | Follower:
        """The profile with points for directions."""
        match shape:
            case Flat(at, Number(degrees)):
                return Flat(at, (at, self.point(at, degrees, 1.0)))
            case Radii(about, Number(degrees)):
                return shape._replace(zero=(about, self.point(about, degrees, 1.0)))
            case Arcs(arcs):
                return Arcs(tuple(map(self.arc, arcs)))
        return shape

    def arc(self, arc: Arc) -> Arc:
        """An arc whose ends are points of it."""
        radius = arc.radius.value if arc.radius is not None else self.distance(arc)
        start, stop = (
            self.point(arc.centre, end.value, radius) if isinstance(end, Number) else end
            for end in (arc.start, arc.stop)
        )
        return arc._replace(start=start, stop=stop)

    def distance(self, arc: Arc) -> float:
        """The radius of an arc that is given by a point of it."""
        ends = (end for end in (arc.start, arc.stop) if isinstance(end, str))
        return max(math.dist(self.places[end], self.places[arc.centre]) for end in ends)

    def point(self, at: str, degrees: float, away: float) -> str:
        """A new point, so far from another in a direction."""
        (x, y), angle = self.places[at], math.radians(degrees)
        name = f"@profile.{self.link}.{len(self.added)}"
        self.added[name] = (x + away * math.cos(angle), y + away * math.sin(angle))
        return name
