"""Points in space, in a frame whose numbers are about 1, and directions as unit vectors.

Vectors of three floats.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from icsolve.case import Case, Centroid, Number, Spring, Toward
from icsolve.case.space import Along, Axis, FromTo, Space, Vector
from icsolve.errors import SceneError, Status

Vec = tuple[float, float, float]
Places = Mapping[str, Vec]


class SpatialFrame(NamedTuple):
    """Normalised points are (p - origin) * scale; ``scale`` is a power of two, so that it rounds nothing."""

    origin: Vec
    scale: float

    def normalised(self, p: Vec) -> Vec:
        """A point in case units, normalised."""
        return times(self.scale, sub(p, self.origin))

    def shown(self, p: Vec) -> Vec:
        """A normalised point in case units."""
        x, y, z = (a / self.scale + o + 0.0 for a, o in zip(p, self.origin, strict=True))
        return (x, y, z)


class SpatialFigure(NamedTuple):
    """Every point of a case: in case units and normalised."""

    places: Places
    points: Places
    frame: SpatialFrame


def figure_of(space: Space) -> SpatialFigure:
    """The points of a case in space.

    Raises SceneError where centroids are of each other, and where coordinates cannot resolve the figure.
    """
    places: dict[str, Vec] = {}
    for name in space.points:
        _place(space, name, places, ())
    frame = frame_of(places)
    return SpatialFigure(places, {name: frame.normalised(p) for name, p in places.items()}, frame)


def _place(space: Space, name: str, places: dict[str, Vec], below: tuple[str, ...]) -> Vec:
    if name in places:
        return places[name]
    if name in below:
        raise SceneError(Status.UNDERDETERMINED, f"{name} is the centroid of points that depend on it.")
    given = space.points[name]
    if isinstance(given, Centroid):
        of = [_place(space, other, places, (*below, name)) for other in given.of]
        x, y, z = (math.fsum(values) / len(of) for values in zip(*of, strict=True))
    else:
        x, y, z = given.x.value, given.y.value, given.z.value
    places[name] = (x, y, z)
    return places[name]


def frame_of(places: Places) -> SpatialFrame:
    """The frame about the first point; the farthest point is 1/2 to 1 from it along an axis.

    Raises SceneError (``near-singular``) where doubles there are farther apart than a thousandth of that.
    """
    origin = next(iter(places.values()), ZERO)
    reach = max((abs(c) for p in places.values() for c in sub(p, origin)), default=0.0)
    offset = max((abs(c) for p in places.values() for c in p), default=0.0)
    if reach and math.ulp(offset) > 1e-3 * reach:
        raise SceneError(
            Status.NEAR_SINGULAR,
            "the points lie so far from the origin that doubles cannot resolve the figure: move the origin.",
        )
    exponent = math.frexp(reach)[1] if reach else 0
    return SpatialFrame(origin, math.ldexp(1.0, -exponent))


def direction(axis: Axis, places: Places, what: str) -> Vec:
    """The unit vector of an axis.

    Raises SceneError, about ``what``, where its two points lie at one place.
    """
    match axis:
        case Along(word):
            vector = AXES["xyz".index(word[-1])]
            return times(-1.0, vector) if word[0] == "-" else vector
        case Vector():
            return unit(vector_of(axis))
        case FromTo(a, b):
            return between(a, b, places, what)


def vector_of(parts: tuple[Number, ...]) -> Vec:
    """Three numbers as a vector."""
    x, y, z = (part.value for part in parts)
    return (x, y, z)


def between(a: str, b: str, places: Places, what: str) -> Vec:
    """The unit vector from one point to another.

    Raises SceneError, about ``what``, where they lie at one place.
    """
    if places[a] == places[b]:
        raise SceneError(
            Status.INCONSISTENT,
            f"{what} has no direction: {_shown(a)} and {_shown(b)} lie at one place. Give it by its "
            "components, or correct the points.",
        )
    return unit(sub(places[b], places[a]))


def heading(load_heading: Axis | Toward, at: str, places: Places, what: str) -> Vec:
    """The unit vector of a force at a point."""
    if isinstance(load_heading, Toward):
        sign = -1.0 if load_heading.away else 1.0
        return times(sign, between(at, load_heading.point, places, what))
    return direction(load_heading, places, what)


def spring_length(spring: Spring, places: Places) -> float:
    """Distance of a spring's ends, case lengths."""
    return size(sub(places[spring.to], places[spring.at]))


def _shown(name: str) -> str:
    return "its point" if name.startswith("@") else name


def in_case(case: Case) -> Space:
    """What a case in space says of it."""
    assert case.space is not None
    return case.space


ZERO: Vec = (0.0, 0.0, 0.0)
AXES: tuple[Vec, Vec, Vec] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def add(a: Vec, b: Vec) -> Vec:
    """a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a: Vec, b: Vec) -> Vec:
    """a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(s: float, a: Vec) -> Vec:
    """s a; a zero is positive."""
    return (s * a[0] + 0.0, s * a[1] + 0.0, s * a[2] + 0.0)


def dot(a: Vec, b: Vec) -> float:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vec, b: Vec) -> Vec:
    """Vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def size(a: Vec) -> float:
    """Length."""
    return math.hypot(*a)


def unit(a: Vec) -> Vec:
    """Unit vector along a; a must not be zero."""
    length = size(a)
    return (a[0] / length, a[1] / length, a[2] / length)


def square_to(axis: Vec) -> tuple[Vec, Vec]:
    """Two unit vectors square to a unit vector and to each other, along coordinate axes where they can be."""
    least = min(AXES, key=lambda e: (abs(dot(e, axis)), -e[0], -e[1]))
    first = unit(sub(least, times(dot(least, axis), axis)))
    return first, unit(cross(axis, first))
