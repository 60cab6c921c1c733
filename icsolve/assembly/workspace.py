"""What a case says of its figure, as data that bear on points, and the workspace on which a construction
runs.

A `Datum` refers into its case (by kind and index), so a construction that is made of data can be run again
on another case of the same shape. A `Workspace` is the normalised frame, the points so far, and how to
measure on them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import lru_cache

from icsolve.case import Case, Centroid, Coordinates, Corner, Guide, Number, Rope, is_named
from icsolve.case.joints import Guided
from icsolve.errors import SceneError, Status
from icsolve.numbers import Arithmetic, Scalar, Showing, largest_of
from icsolve.screws import Point, unit_between
from icsolve.structure import Topology, topology
from icsolve.tuples import NamedTuple

X, Y, MEAN, GUIDE, LINE, LENGTH, RAY, CORNER = "x", "y", "mean", "guide", "line", "length", "ray", "corner"
ROPE = "rope"


class Datum(NamedTuple):
    """One condition on points.

    ``kind`` and ``points``: ``x`` and ``y`` (p) a coordinate of a point whose other one is
    unknown; ``mean`` (p, of...) a centroid; ``guide`` (at, through) a guide line by its angle;
    ``line`` (at, through, e1, e2) a guide line by two points; ``length`` (a, b); ``ray`` (a, b)
    a direction; ``corner`` (a, at, b); ``rope`` (a, p, ..., b) one that is as long as given.
    ``ref`` is its place in the case.
    """

    kind: str
    ref: int | str
    points: tuple[str, ...]


def number_of(case: Case, datum: Datum) -> Number:
    """The number that the case writes for a datum (not for ``mean`` and ``line``, which have none)."""
    kind, ref = datum.kind, datum.ref
    if kind == LENGTH:
        return case.lengths[ref].value  # type: ignore[index]
    if kind in (RAY, CORNER):
        return case.angles[ref].value  # type: ignore[index]
    if kind == ROPE:
        return case.ropes[ref].length  # type: ignore[index, return-value]
    if kind == GUIDE:
        return case.joints[ref].guide.angle  # type: ignore[index, union-attr, return-value]
    place = case.points[ref]  # type: ignore[index]
    return place.x if kind == X else place.y  # type: ignore[union-attr, return-value]


POSING = (LENGTH, RAY, CORNER, X, Y)
"""Data that can pose a figure."""


def datum_at(case: Case, path: str) -> Datum | None:
    """The datum of a path that can pose the figure; of the coordinates of a point that has both, none."""
    return next((d for d in data_of(case) if d.kind in POSING and number_of(case, d).path == path), None)


def given_points(case: Case) -> list[str]:
    """The points that both coordinates are given of."""
    return [
        name
        for name, place in case.points.items()
        if type(place) is Coordinates and place.x is not None and place.y is not None
    ]


@lru_cache(maxsize=32)
def data_of(case: Case) -> tuple[Datum, ...]:
    """Every datum but the full coordinates: those of greatest authority first."""
    return tuple(_data(case))


def _data(case: Case) -> Iterator[Datum]:
    for name, place in case.points.items():
        if type(place) is Centroid:
            yield Datum(MEAN, name, (name, *place.of))
        elif type(place) is Coordinates and (place.x is None) != (place.y is None):
            yield Datum(Y if place.x is None else X, name, (name,))
    for i, joint in enumerate(case.joints):
        if isinstance(joint, Guided):
            yield from _guide(i, joint.at, joint.guide)
    for i, length in enumerate(case.lengths):
        yield Datum(LENGTH, i, (length.a, length.b))
    for i, angle in enumerate(case.angles):
        if type(angle) is Corner:
            yield Datum(CORNER, i, (angle.a, angle.at, angle.b))
        else:
            yield Datum(RAY, i, (angle.a, angle.b))
    for i, rope in enumerate(case.ropes):
        if rope.length is not None and not rope.is_free:
            yield Datum(ROPE, i, rope.points)


def _guide(index: int, at: str, guide: Guide) -> Iterator[Datum]:
    """The guide's condition on its points; none where its line goes through the point by definition."""
    if guide.ends is None:
        if guide.through is not None and guide.through != at:
            yield Datum(GUIDE, index, (at, guide.through))
        return
    first, second = guide.ends
    through = first if guide.through is None else guide.through
    if through != at and not (at in guide.ends and through in guide.ends):
        yield Datum(LINE, index, (at, through, first, second))


@lru_cache(maxsize=32)
def names_of(case: Case) -> tuple[str, ...]:
    """Every point that the case names, in order of first mention in the figure, joints and links."""
    names = [*case.points]
    for datum in data_of(case):
        names += datum.points
    for joint in case.joints:
        names += joint.named
    for carried in case.carries.values():
        names += carried
    return tuple(dict.fromkeys(names))


class Facts(NamedTuple):
    """The data of a figure, looked up by point.

    ``of`` has the data that bear on each point. ``arms`` has for each arm (vertex, point) of a
    corner the corners that turn it into another arm: (corner, the other arm's point, +1 or -1).
    ``flat`` has the corners of a multiple of 180 degrees.
    """

    data: tuple[Datum, ...]
    of: dict[str, list[Datum]]
    arms: dict[tuple[str, str], list[tuple[Datum, str, int]]]
    flat: frozenset[Datum]
    ropes: tuple[Rope, ...]


def facts_of(case: Case, only: tuple[Datum, ...] | None = None) -> Facts:
    """Look-up tables over the data of a case, or over some of them."""
    data = data_of(case) if only is None else only
    return facts_about(data, flat_corners(case, data), case.ropes)


def flat_corners(case: Case, data: tuple[Datum, ...]) -> frozenset[Datum]:
    """The corners of a multiple of 180 degrees: the one thing that facts need numbers for."""
    return frozenset([d for d in data if d.kind == CORNER and number_of(case, d).value % 180.0 == 0.0])


@lru_cache(maxsize=64)
def facts_about(data: tuple[Datum, ...], flat: frozenset[Datum], ropes: tuple[Rope, ...]) -> Facts:
    """The same of data: figures alike share them."""
    of: dict[str, list[Datum]] = {}
    arms: dict[tuple[str, str], list[tuple[Datum, str, int]]] = {}
    for datum in data:
        for point in dict.fromkeys(datum.points):
            of.setdefault(point, []).append(datum)
        if datum.kind == CORNER:
            a, at, b = datum.points
            arms.setdefault((at, a), []).append((datum, b, 1))
            arms.setdefault((at, b), []).append((datum, a, -1))
    return Facts(data, of, arms, flat, ropes)


SMALLEST_RESOLUTION = 1e-3
"""Coarsest step between neighbouring doubles that still draws a figure, over the figure's size."""

SMALLEST_PART = 1e-80
"""Smallest distance or length, over the figure's size, whose products with others are numbers still."""


SMALLEST_DIFFERENCE = 2.0**-52
"""Smallest difference of two coordinates, over the figure's size, that a figure of doubles shows."""


class Frame(NamedTuple):
    """Normalised coordinates are (p - o) * scale: the frame of size 1 in which a figure is computed.

    The origin (ox, oy) [case length] is a given point, so that differences of given coordinates are exact
    where they matter (Sterbenz); ``scale`` [1 / case length] is a power of two, so that scaling rounds
    nothing.
    """

    ox: float
    oy: float
    scale: float

    def twist_shown(self, t: tuple[float, float, float], divisor: float) -> tuple[float, float, float]:
        """A twist of the frame about the case's origin [case length/s, case length/s, rad/s], divided; a zero
        is positive.
        """
        x, y, w = (value / divisor + 0.0 for value in t)
        return (x / self.scale + w * self.ox, y / self.scale + w * self.oy, w)


class PlacedCase(NamedTuple):
    """A case in one position.

    Attributes
    ----------
    case : the case
    frame : scale and origin of the frame of size 1
    points : by name, (x, y) [frame]
    arithmetic : of the points, and of all that is made of them
    """

    case: Case
    frame: Frame
    points: Mapping[str, Point]
    arithmetic: Arithmetic

    @property
    def top(self) -> Topology:
        """Its bodies and bonds."""
        return topology(self.case)


def case_point(frame: Frame, xy: tuple[float, float]) -> tuple[float, float]:
    """A point of the frame of size 1 in case lengths; a zero is positive."""
    return xy[0] / frame.scale + frame.ox + 0.0, xy[1] / frame.scale + frame.oy + 0.0


def case_places(
    frame: Frame, points: Mapping[str, tuple[Scalar, Scalar]], arithmetic: Showing
) -> tuple[dict[str, tuple[float, float]], dict[str, tuple[float, float]]]:
    """The points that have a name in the case, in case lengths, each coordinate rounded once; and bounds on
    their errors.

    Raises MoreDigits where the digits of the arithmetic do not settle one.
    """
    ox, oy, scale = frame
    spans = ((ox, 1.0 / scale + abs(ox)), (oy, 1.0 / scale + abs(oy)))
    found, errors = {}, {}
    for name, at in points.items():
        if is_named(name):
            (x, off_x), (y, off_y) = (
                arithmetic.rounded(c / scale + o, size) for c, (o, size) in zip(at, spans, strict=True)
            )
            found[name], errors[name] = (x, y), (off_x, off_y)
    return found, errors


def normalised(frame: Frame, xy: tuple[float, float]) -> tuple[float, float]:
    """A point in case lengths (a float pair, as in ``near``) in the frame of size 1."""
    return (xy[0] - frame.ox) * frame.scale, (xy[1] - frame.oy) * frame.scale


def frame_of(case: Case) -> Frame:
    """The frame of a case's figure; refuses coordinates that cannot resolve the size.

    The same for every part of the figure that is asked for. The largest length or distance from
    the origin becomes 1/2 to 1.

    Raises
    ------
    SceneError
        ``near-singular``: neighbouring doubles are farther apart than a thousandth of the
        figure, or two points that are written differently are the same doubles.
    """
    xs: list[Number] = []
    ys: list[Number] = []
    for place in case.points.values():
        if type(place) is Coordinates:
            if place.x is not None:
                xs.append(place.x)
            if place.y is not None:
                ys.append(place.y)
    ox, oy = _origin(case, xs, ys)
    reach = largest_of([x.value - ox for x in xs])
    rise = largest_of([y.value - oy for y in ys])
    size = max(reach, rise, largest_of([length.value.value for length in case.lengths]))
    _resolved(case, xs, ys, size)
    _beside_its_size(case, (ox, oy), size)
    exponent = max(math.frexp(size)[1], -1023) if size > 0.0 else 0
    return Frame(ox, oy, math.ldexp(1.0, -exponent))


def _origin(case: Case, xs: list[Number], ys: list[Number]) -> tuple[float, float]:
    """The first pin whose coordinates are given, else the first given coordinates."""
    for joint in case.joints:
        place = case.points.get(getattr(joint, "at", None) or "")
        if type(place) is Coordinates and place.x is not None and place.y is not None:
            return place.x.value, place.y.value
    return (xs[0].value if xs else 0.0), (ys[0].value if ys else 0.0)


def _resolved(case: Case, xs: list[Number], ys: list[Number], size: float) -> None:
    """Refuse a figure that its coordinates cannot draw."""
    farthest = largest_of([n.value for n in (*xs, *ys)])
    if not math.isfinite(size) or not math.isfinite(farthest):
        raise SceneError(Status.NEAR_SINGULAR, "the coordinates are too large to be told apart")
    if size > 0.0 and math.ulp(farthest) > SMALLEST_RESOLUTION * size:
        raise SceneError(
            Status.NEAR_SINGULAR,
            f"the coordinates cannot resolve the figure: near {farthest:.6g} neighbouring numbers are "
            f"{math.ulp(farthest):.3g} apart, and the figure's size is {size:.6g}; "
            "give coordinates from an origin in or near the figure",
        )
    _refuse_lost_difference(case, size)


def _beside_its_size(case: Case, origin: tuple[float, float], size: float) -> None:
    """Refuse a figure with parts so small beside it that products of theirs vanish."""
    parts = {f"length {length.a}-{length.b}": abs(length.value.value) for length in case.lengths}
    for name, place in case.points.items():
        if type(place) is Coordinates and place.x is not None and place.y is not None:
            parts[f"point {name}"] = max(abs(place.x.value - origin[0]), abs(place.y.value - origin[1]))
    for name, part in parts.items():
        if 0.0 < part < SMALLEST_PART * size:
            raise SceneError(
                Status.NEAR_SINGULAR,
                f"the figure's size is {size:.6g}, beside which {name}, with {part:.6g}, cannot be told from "
                "nothing; look for a slip in the numbers, or leave out what lies so far away",
            )


def _refuse_lost_difference(case: Case, size: float) -> None:
    """Refuse two points that are written differently and became one by more than doubles lose."""
    for name, other in respelled(case).items():
        (x, y), (u, v) = _numbers(case, name), _numbers(case, other)
        if max(_difference(x, u), _difference(y, v)) > SMALLEST_DIFFERENCE * size:
            raise SceneError(
                Status.NEAR_SINGULAR,
                f"the coordinates of {other} and {name} are different numbers, but too far from the origin "
                "to be told apart; give coordinates from an origin in or near the figure",
            )


@lru_cache(maxsize=32)
def respelled(case: Case) -> dict[str, str]:
    """The points whose coordinates spell the doubles of a point before them otherwise: one place."""
    seen: dict[tuple[float, float], str] = {}
    same: dict[str, str] = {}
    for name, place in case.points.items():
        if type(place) is Coordinates and place.x is not None and place.y is not None:
            other = seen.setdefault((place.x.value, place.y.value), name)
            (x, y), (u, v) = _numbers(case, name), _numbers(case, other)
            if other != name and (_difference(x, u) or _difference(y, v)):
                same[name] = other
    return same


def _numbers(case: Case, name: str) -> tuple[Number, Number]:
    """The coordinates that the case gives of a point."""
    place = case.points[name]
    assert type(place) is Coordinates and place.x is not None and place.y is not None
    return place.x, place.y


def _difference(a: Number, b: Number) -> float:
    """By how much two numerals with one double differ (``1`` and ``1.0`` do not)."""
    if a.digits == b.digits or a.factor != b.factor:
        return 0.0
    from decimal import Decimal, InvalidOperation

    try:
        return abs(float(Decimal(a.digits) - Decimal(b.digits))) * a.factor
    except InvalidOperation:
        return 0.0


# --- where a construction takes its directions and its lengths from ---


class Apart(NamedTuple):
    """The distance (or the direction) from one constructed point to another."""

    a: Key
    b: Key


class LineDirection(NamedTuple):
    """A direction: that of a datum or between two points, turned by corners, reversed if ``flip``."""

    root: Datum | Apart
    flip: bool = False
    turns: tuple[tuple[Datum, int], ...] = ()

    def reverse(self) -> LineDirection:
        """The opposite direction."""
        if isinstance(self.root, Apart):
            return LineDirection(Apart(self.root.b, self.root.a), self.flip, self.turns)
        return LineDirection(self.root, not self.flip, self.turns)

    def turned(self, corner: Datum, sense: int) -> LineDirection:
        """Turned by a corner, ccw with sense +1."""
        return LineDirection(self.root, self.flip, (*self.turns, (corner, sense)))


Span = Datum | Apart
"""Where a length comes from: a length of the case, or two points that are in place."""


def data_in(made: object) -> tuple[Datum, ...]:
    """The data that a direction, a locus or a step is made of, each once: those among its fields."""
    return tuple(dict.fromkeys(part for part in _parts(made, []) if isinstance(part, Datum)))


def keys_in(made: object) -> tuple[Key, ...]:
    """The points that a direction or a locus is made of, and those that a step puts: each once."""
    return tuple(dict.fromkeys(part for part in _parts(made, []) if not isinstance(part, Datum)))


def _parts(made: object, found: list[Datum | Key]) -> list[Datum | Key]:
    """The data and the points among the fields of a value, and among theirs, behind those found before."""
    if type(made) is Datum or type(made) is str:
        found.append(made)
    elif isinstance(made, tuple):
        if len(made) == 2 and type(made[0]) is int and type(made[1]) is str:
            found.append(made)
        else:
            for part in made:
                _parts(part, found)
    return found


# --- the drawing workspace on which a construction runs: its case, its arithmetic, and the points so far ---


Key = str | tuple[int, str]
"""A point of the figure by its name, or of a link's own cluster by the cluster and the name."""


class Workspace:
    """Points in the frame of size 1, and how to measure on them.

    Attributes
    ----------
    points : by name (or cluster and name), (x, y) [frame]
    starts : where groups that Newton's method solves start, if not where they were settled
    """

    __slots__ = ("arithmetic", "case", "frame", "points", "starts")

    def __init__(self, case: Case, frame: Frame, arithmetic: Arithmetic) -> None:
        self.case = case
        self.frame = frame
        self.arithmetic = arithmetic
        self.points: dict[Key, Point] = {}
        self.starts: Mapping[str, Point] = {}

    def length(self, span: Span) -> Scalar:
        """A length [frame]: as the case gives it, or between two points."""
        if isinstance(span, Datum):
            return self.arithmetic.given(number_of(self.case, span)) * self.frame.scale
        (ax, ay), (bx, by) = self.points[span.a], self.points[span.b]
        dx, dy = bx - ax, by - ay
        return self.arithmetic.sqrt(dx * dx + dy * dy)

    def turn(self, datum: Datum) -> Point:
        """Cosine and sine of an angle of the case."""
        return self.arithmetic.turn(number_of(self.case, datum))

    def unit(self, direction: LineDirection) -> Point:
        """The unit vector of a direction."""
        root = direction.root
        if isinstance(root, Datum):
            x, y = self.turn(root)
        else:
            (x, y), _ = unit_between(self.points[root.a], self.points[root.b], self.arithmetic)
        for datum, sense in direction.turns:
            c, s = self.turn(datum)
            x, y = (c * x - s * y, s * x + c * y) if sense > 0 else (c * x + s * y, c * y - s * x)
        return (-x, -y) if direction.flip else (x, y)

    def coordinates(self, name: str) -> Point:
        """A point that the case gives, (x, y) [frame]."""
        place = self.case.points[respelled(self.case).get(name, name)]
        assert type(place) is Coordinates
        assert place.x is not None
        assert place.y is not None
        given, (ox, oy, scale) = self.arithmetic.given, self.frame
        return (given(place.x) - ox) * scale, (given(place.y) - oy) * scale

    def coordinate(self, datum: Datum) -> Scalar:
        """The one coordinate that the case gives of a point [frame]."""
        value = self.arithmetic.given(number_of(self.case, datum))
        return (value - (self.frame.ox if datum.kind == X else self.frame.oy)) * self.frame.scale
