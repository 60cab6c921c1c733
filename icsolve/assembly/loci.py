"""Where two loci of a point meet, and the loci that data of the written figure put a point on.

The kernels are written once for every kind of number: the written figure and the driven one ask the same,
in floats, in balls of decimals, on a tape, on a record. Nothing in them branches on a value. An
intersection comes as its middle, the direction of the common chord, and the two factors under its root,
which must not be negative; callers test those.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from icsolve.assembly.workspace import Datum, Key, LineDirection, Span, Workspace, X
from icsolve.numbers import Arithmetic, Scalar
from icsolve.screws import Point
from icsolve.tuples import LateModule, NamedTuple

if TYPE_CHECKING:
    from icsolve.screws import ropes as rope_screws
else:
    rope_screws = LateModule("icsolve.screws.ropes")


class PlacedCircle(NamedTuple):
    """A circle: its centre (x, y) and radius [frame of size 1]."""

    centre: Point
    radius: Scalar


class PlacedLine(NamedTuple):
    """A line: a point (x, y) of it [frame of size 1] and a unit vector along it."""

    through: Point
    along: Point


PlacedLocus = PlacedCircle | PlacedLine

Factor = tuple[Scalar, Scalar]
"""A factor under a root, and the size of the terms that it is a difference of."""


class Intersection(NamedTuple):
    """Where two loci meet: at ``middle`` + and - the root of the product of the factors times ``chord``.

    Attributes
    ----------
    middle : (x, y) [frame]
    chord : the + place lies on this side of ``middle``; None: one place only, of two lines
    factors : negative where the loci do not meet; two, or none of two lines
    """

    middle: Point
    chord: Point | None = None
    factors: tuple[Factor, Factor] | None = None

    def at(self, root: Scalar) -> Point:
        """One of the two places, by the root with its sign."""
        (x, y), (cx, cy) = self.middle, self.chord or (0.0, 0.0)
        return (x + root * cx, y + root * cy)


def intersection(one: PlacedLocus, two: PlacedLocus, apart: Scalar | None = None) -> Intersection:
    """Where two loci meet; of a line and a circle either may come first. ``apart`` is the distance of the
    centres of two circles [frame], where a datum gives it.

    The first of two places (+) lies to the left of the way from the first circle's centre to the second's, or
    is the farther one along the line. Parallel lines and concentric circles divide by zero: whether they are
    is the caller's to test.
    """
    if isinstance(one, PlacedLine):
        return _of_lines(one, two) if isinstance(two, PlacedLine) else _of_line_and_circle(one, two)
    return _of_line_and_circle(two, one) if isinstance(two, PlacedLine) else _of_circles(one, two, apart)


def _of_circles(one: PlacedCircle, two: PlacedCircle, apart: Scalar | None) -> Intersection:
    """Heron's formula on squares: ``((a + b)^2 - d^2)(d^2 - (a - b)^2)`` is (4 area)^2.

    In factors it loses nothing where the triangle is nearly flat (Kahan, "Miscalculating area and angles of a
    needle-like triangle").
    """
    (px, py), (qx, qy), a, b = one.centre, two.centre, one.radius, two.radius
    ex, ey = qx - px, qy - py
    d2 = ex * ex + ey * ey if apart is None else apart * apart
    far, near = (a + b) * (a + b), (a - b) * (a - b)
    half = 0.5 / d2
    along = 0.5 + (a - b) * (a + b) * half
    middle = (px + along * ex, py + along * ey)
    return Intersection(middle, (-(half * ey), half * ex), ((far - d2, far + d2), (d2 - near, far + d2)))


def _of_line_and_circle(line: PlacedLine, circle: PlacedCircle) -> Intersection:
    (px, py), (vx, vy), (cx, cy), r = *line, *circle
    wx, wy = cx - px, cy - py
    off, along = vx * wy - vy * wx, vx * wx + vy * wy
    middle = (px + along * vx, py + along * vy)
    return Intersection(middle, (vx, vy), ((r - off, r), (r + off, r)))  # off is r where they touch


def _of_lines(one: PlacedLine, two: PlacedLine) -> Intersection:
    (px, py), (ux, uy), (qx, qy), (vx, vy) = *one, *two
    t = ((qx - px) * vy - (qy - py) * vx) / sine_between(one, two)
    return Intersection((px + t * ux, py + t * uy))


def side(one: PlacedLocus, two: PlacedLocus, at: Point) -> float:
    """Which of the two places where loci meet is the nearer to ``at``: +1.0, -1.0, or 0.0 of two lines.

    In floats, without a root and without a division: also where the loci do not meet.
    """
    if isinstance(one, PlacedLine) and isinstance(two, PlacedLine):
        return 0.0
    (x, y), (cx, cy) = _chord(one, two)
    return 1.0 if float((at[0] - x) * cx + (at[1] - y) * cy) >= 0.0 else -1.0


def sideways(one: PlacedLocus, two: PlacedLocus, at: Point) -> float:
    """How far ``at`` lies toward one of the two places where loci meet, in floats."""
    if isinstance(one, PlacedLine) and isinstance(two, PlacedLine):
        return 0.0
    (x, y), (cx, cy) = _chord(one, two)
    size = math.hypot(cx, cy)
    return abs(float((at[0] - x) * cx + (at[1] - y) * cy)) / size if size else 0.0


def _chord(one: PlacedLocus, two: PlacedLocus) -> tuple[Point, Point]:
    """A point halfway between the two places where loci meet, or on the line square to theirs that it is on,
    and the direction from one to the other."""
    if isinstance(one, PlacedLine):
        assert isinstance(two, PlacedCircle)
        return two.centre, one.along
    if isinstance(two, PlacedLine):
        return one.centre, two.along
    (x, y), (qx, qy) = one.centre, two.centre
    return (x, y), (y - qy, qx - x)


# --- whether they meet, and how well ---


def gaps_of(
    one: PlacedLocus, two: PlacedLocus, arithmetic: Arithmetic, apart: Scalar | None = None
) -> tuple[Scalar, ...]:
    """By how much two loci meet [frame]: none is negative where they do. A line comes first if there is one.

    Of two lines the sine of the angle between them; of a line and a circle by how much it passes within the
    circle on either side; of two circles the three gaps of a triangle of the radii and the distance of the
    centres, and that distance: 0 where they are one point. ``apart`` as of `intersection`.
    """
    if isinstance(two, PlacedLine):
        assert isinstance(one, PlacedLine)
        return (sine_between(one, two),)
    (qx, qy), b = two
    if isinstance(one, PlacedLine):
        (px, py), (vx, vy) = one
        off = vx * (qy - py) - vy * (qx - px)
        return (b - off, b + off)
    (px, py), a = one
    dx, dy = qx - px, qy - py
    d = arithmetic.sqrt(dx * dx + dy * dy) if apart is None else apart
    return ((a + b) - d, d - (a - b), d + (a - b), d)


def sine_between(one: PlacedLine, two: PlacedLine) -> Scalar:
    """The sine of the angle between two lines."""
    (ux, uy), (vx, vy) = one.along, two.along
    return ux * vy - uy * vx


def crossing_sine(one: PlacedLocus, two: PlacedLocus, at: Point) -> float:
    """The size of the sine of the angle at which two loci cross at a place, in floats."""
    (ax, ay), (bx, by) = _normal(one, at), _normal(two, at)
    size = math.hypot(ax, ay) * math.hypot(bx, by)
    return abs(ax * by - ay * bx) / size if size else 0.0


def _normal(locus: PlacedLocus, at: Point) -> tuple[float, float]:
    if isinstance(locus, PlacedCircle):
        return float(at[0] - locus.centre[0]), float(at[1] - locus.centre[1])
    return float(-locus.along[1]), float(locus.along[0])


class CircleLocus(NamedTuple):
    """The circle about a point."""

    centre: Key
    radius: Span

    def placed(self, workspace: Workspace) -> PlacedCircle:
        """The circle where its points are."""
        return PlacedCircle(workspace.points[self.centre], workspace.length(self.radius))


class ArcLocus(NamedTuple):
    """The circle from which two points are seen under a corner's angle (Euclid III 21)."""

    a: Key
    b: Key
    corner: Datum

    def placed(self, workspace: Workspace) -> PlacedCircle:
        """The centre stands off the chord's middle by half the chord times the angle's cotangent."""
        (ax, ay), (bx, by) = workspace.points[self.a], workspace.points[self.b]
        c, s = workspace.turn(self.corner)
        k = c / (2.0 * s)
        dx, dy = bx - ax, by - ay
        cx, cy = (ax + bx) / 2.0 - k * dy, (ay + by) / 2.0 + k * dx
        radius = workspace.arithmetic.sqrt((ax - cx) * (ax - cx) + (ay - cy) * (ay - cy))
        return PlacedCircle((cx, cy), radius)


class LineLocus(NamedTuple):
    """A line through a point; with ``ray`` only the half of it that lies ahead.

    ``datum`` puts the point there where the direction, one between points, does not name it.
    """

    through: Key
    direction: LineDirection
    ray: bool
    datum: Datum | None = None

    def placed(self, workspace: Workspace) -> PlacedLine:
        """The line where its points are."""
        return PlacedLine(workspace.points[self.through], workspace.unit(self.direction))


class Axis(NamedTuple):
    """The line of a known x or a known y."""

    datum: Datum

    def placed(self, workspace: Workspace) -> PlacedLine:
        """The line: toward +y for a known x, toward +x for a known y."""
        value = workspace.coordinate(self.datum)
        if self.datum.kind == X:
            return PlacedLine((value, 0.0), (0.0, 1.0))
        return PlacedLine((0.0, value), (1.0, 0.0))


class Tether(NamedTuple):
    """The circle about a point on which what a rope of given length leaves keeps another.

    All ``parts`` of the rope that end at that other point come from the centre; ``others`` are its points but
    that one.
    """

    centre: Key
    rope: Datum
    others: tuple[str, ...]
    parts: int

    def placed(self, workspace: Workspace) -> PlacedCircle:
        """The circle where its points are."""
        own = next(p for p in self.rope.points if p not in self.others)
        left = workspace.length(self.rope) - length_of(workspace, self.rope, own)
        return PlacedCircle(workspace.points[self.centre], left / float(self.parts))


def length_of(workspace: Workspace, datum: Datum, without: str = "") -> Scalar:
    """How long a rope is where the points are, without its parts at one (normalised)."""
    rope = workspace.case.ropes[datum.ref]  # type: ignore[index]
    points = {p: workspace.points[p] for p in rope.points if p != without}
    return rope_screws.rope_length(rope, points, workspace.frame.scale, workspace.arithmetic, without)


class Shifted(NamedTuple):
    """The locus of another point, moved by the known vector from this point to that one."""

    base: CircleLocus | ArcLocus | Tether | LineLocus | Axis | Shifted
    span: Span
    direction: LineDirection

    def placed(self, workspace: Workspace) -> PlacedLocus:
        """That of the base, moved back along the vector."""
        base = self.base.placed(workspace)
        length, (c, s) = workspace.length(self.span), workspace.unit(self.direction)
        x, y = base[0]
        at = (x - length * c, y - length * s)
        return PlacedCircle(at, base.radius) if isinstance(base, PlacedCircle) else PlacedLine(at, base.along)


Locus = CircleLocus | ArcLocus | Tether | LineLocus | Axis | Shifted


def is_round(locus: Locus) -> bool:
    """Whether it is a circle, not a line."""
    while type(locus) is Shifted:
        locus = locus.base
    return type(locus) in (CircleLocus, ArcLocus, Tether)


def is_ray(locus: Locus) -> bool:
    """Whether only the half of a line that lies ahead will do."""
    while type(locus) is Shifted:
        locus = locus.base
    return type(locus) is LineLocus and locus.ray


def directions_of(locus: Locus) -> list[LineDirection]:
    """The directions that a locus goes by."""
    if isinstance(locus, Shifted):
        return [locus.direction, *directions_of(locus.base)]
    return [locus.direction] if isinstance(locus, LineLocus) else []
