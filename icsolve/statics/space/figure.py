"""Points in space, in a frame whose numbers are about 1, and unit vectors, in any arithmetic."""

from __future__ import annotations

import math
from collections.abc import Mapping

from icsolve.case import Case, Centroid, Number, Spring, Toward
from icsolve.case.space import Along, Axis, FromTo, Space, Vector
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import FLOATS, Arithmetic, Scalar
from icsolve.screws.space import AXES, Vec, size, sub, times, unit
from icsolve.tuples import NamedTuple

Places = Mapping[str, Vec]


class SpatialFrame(NamedTuple):
    """Normalised points are (p - origin) * scale; ``scale`` is a power of two, so that it rounds nothing.

    ``origin`` is a place of doubles [case length].
    """

    origin: tuple[float, float, float]
    scale: float

    def normalised(self, p: Vec) -> Vec:
        """A point in case units, normalised."""
        return times(self.scale, sub(p, self.origin))

    def shown(self, p: Vec) -> Vec:
        """A normalised point in case units."""
        x, y, z = (a / self.scale + o + 0.0 for a, o in zip(p, self.origin, strict=True))
        return (x, y, z)


class SpatialFigure(NamedTuple):
    """Every point of a case.

    Attributes
    ----------
    places : by name, (3,) [case length]
    points : the same (3,) [frame]
    frame : origin and scale of the points
    arithmetic : of both
    """

    places: Places
    points: Places
    frame: SpatialFrame
    arithmetic: Arithmetic = FLOATS


def figure_of(space: Space, arithmetic: Arithmetic = FLOATS) -> SpatialFigure:
    """The points of a case in space.

    Raises
    ------
    SceneError
        ``underdetermined`` where centroids are of each other, ``near-singular`` where doubles cannot resolve
        the figure.
    """
    places: dict[str, Vec] = {}
    for name in space.points:
        _place(space, name, places, (), arithmetic)
    frame = frame_of(places)
    return SpatialFigure(places, {name: frame.normalised(p) for name, p in places.items()}, frame, arithmetic)


def _place(
    space: Space, name: str, places: dict[str, Vec], below: tuple[str, ...], arithmetic: Arithmetic
) -> Vec:
    if name in places:
        return places[name]
    if name in below:
        raise SceneError(Status.UNDERDETERMINED, f"{name} is the centroid of points that depend on it.")
    given = space.points[name]
    if isinstance(given, Centroid):
        of = [_place(space, other, places, (*below, name), arithmetic) for other in given.of]
        x, y, z = (sum(values, 0.0) / len(of) for values in zip(*of, strict=True))
    else:
        x, y, z = vector_of((given.x, given.y, given.z), arithmetic)
    places[name] = (x, y, z)
    return places[name]


def frame_of(places: Places) -> SpatialFrame:
    """The frame about the first point; the farthest point is 1/2 to 1 from it along an axis.

    Raises SceneError (``near-singular``) where doubles there are farther apart than a thousandth of that.
    """
    rough = [(float(x), float(y), float(z)) for x, y, z in places.values()]
    origin = next(iter(rough), (0.0, 0.0, 0.0))
    reach = max((abs(c) for p in rough for c in sub(p, origin)), default=0.0)
    offset = max((abs(c) for p in rough for c in p), default=0.0)
    if reach and math.ulp(offset) > 1e-3 * reach:
        raise SceneError(
            Status.NEAR_SINGULAR,
            "the points lie so far from the origin that doubles cannot resolve the figure: move the origin.",
        )
    exponent = math.frexp(reach)[1] if reach else 0
    return SpatialFrame(origin, math.ldexp(1.0, -exponent))


def direction(axis: Axis, figure: SpatialFigure, what: str) -> Vec:
    """The unit vector of an axis.

    Raises SceneError, about ``what``, where its two points lie at one place.
    """
    match axis:
        case Along(word):
            vector = AXES["xyz".index(word[-1])]
            return times(-1.0, vector) if word[0] == "-" else vector
        case Vector():
            return unit(vector_of(axis, figure.arithmetic), figure.arithmetic)
        case FromTo(a, b):
            return between(a, b, figure, what)


def vector_of(parts: tuple[Number, ...], arithmetic: Arithmetic = FLOATS) -> Vec:
    """Three numbers as a vector."""
    x, y, z = (arithmetic.given(part) for part in parts)
    return (x, y, z)


def between(a: str, b: str, figure: SpatialFigure, what: str) -> Vec:
    """The unit vector from one point to another.

    Raises SceneError, about ``what``, where they lie at one place.
    """
    apart = sub(figure.places[b], figure.places[a])
    if not any(map(float, apart)):
        raise SceneError(
            Status.INCONSISTENT,
            f"{what} has no direction: {_shown(a)} and {_shown(b)} lie at one place. Give it by its "
            "components, or correct the points.",
        )
    return unit(apart, figure.arithmetic)


def heading(load_heading: Axis | Toward, at: str, figure: SpatialFigure, what: str) -> Vec:
    """The unit vector of a force at a point."""
    if isinstance(load_heading, Toward):
        sign = -1.0 if load_heading.away else 1.0
        return times(sign, between(at, load_heading.point, figure, what))
    return direction(load_heading, figure, what)


def spring_length(spring: Spring, figure: SpatialFigure) -> Scalar:
    """Distance of a spring's ends, case lengths."""
    return size(sub(figure.places[spring.to], figure.places[spring.at]), figure.arithmetic)


def _shown(name: str) -> str:
    return "its point" if name.startswith("@") else name


def in_case(case: Case) -> Space:
    """What a case in space says of it."""
    assert case.space is not None
    return case.space
