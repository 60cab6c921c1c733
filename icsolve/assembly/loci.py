"""Loci of a point and where two of them meet: the kernels, written once for every kind of number.

Nothing here branches on a value. A crossing comes as its middle and half the chord between its two
points, with the margins that must not be negative; callers test those.
"""

from __future__ import annotations

from icsolve.assembly.data import Datum, X
from icsolve.assembly.workspace import Key, LineDirection, Point, Span, Workspace, data_in, ends_of
from icsolve.numbers.arithmetic import Arithmetic, Scalar
from icsolve.screws.ropes import rope_length
from icsolve.tuples import NamedTuple


class Crossing(NamedTuple):
    """Where two loci meet.

    Attributes
    ----------
    middle : (x, y) [frame of size 1]
    half : half the chord, so that the places are middle + half and middle - half; None: one place only
    margins : [frame], negative where the loci do not meet
    scale : what rounding is measured by [frame]; of two lines the sine of the angle between them
    """

    middle: Point
    half: Point | None
    margins: tuple[Scalar, ...]
    scale: Scalar


Values = tuple[Scalar, ...]
"""Circle: centre x, y and radius. Line: a point x, y and a unit direction."""


def gaps_of_circles(p: Values, q: Values, arithmetic: Arithmetic) -> tuple[Scalar, tuple[Scalar, ...]]:
    """The distance of two centres, and the three gaps of a triangle of it and the radii [frame]: none is
    negative where the circles meet.
    """
    (px, py, a), (qx, qy, b) = p, q
    dx, dy = qx - px, qy - py
    d = arithmetic.sqrt(dx * dx + dy * dy)
    return d, ((a + b) - d, d - (a - b), d + (a - b))


def gaps_of_line_and_circle(line: Values, circle: Values) -> tuple[Scalar, Scalar]:
    """By how much a line passes within a circle, on either side of its centre [frame]."""
    (px, py, vx, vy), (cx, cy, r) = line, circle
    off = vx * (cy - py) - vy * (cx - px)
    return r - off, r + off


def sine_between(p: Values, q: Values) -> Scalar:
    """The sine of the angle between two lines."""
    (_, _, ux, uy), (_, _, vx, vy) = p, q
    return ux * vy - uy * vx


def meet_circles(p: Values, q: Values, arithmetic: Arithmetic, tangent: bool) -> Crossing:
    """Two circles, by Heron's formula in factors.

    Heron's area in factors loses nothing where the triangle is nearly flat (Kahan, "Miscalculating area and
    angles of a needle-like triangle").

    Parameters
    ----------
    p, q : centre x, y and radius [frame]; concentric ones divide by zero
    arithmetic : of all of these
    tangent : whether the chord is zero by decree

    Returns
    -------
    Crossing
        The first of the two places (+) lies to the left of the line from p's centre to q's.
    """
    (px, py, a), (qx, qy, b) = p, q
    d, margins = gaps_of_circles(p, q, arithmetic)
    ux, uy = (qx - px) / d, (qy - py) / d
    along = ((d - b) * (d + b) + a * a) / (2.0 * d)
    middle = (px + along * ux, py + along * uy)
    far, over, under = margins
    if tangent:
        return Crossing(middle, None, margins, d + a + b)
    h = arithmetic.sqrt((d + (a + b)) * far * over * under) / (2.0 * d)
    return Crossing(middle, (-uy * h, ux * h), margins, d + a + b)


def meet_line_circle(line: Values, circle: Values, arithmetic: Arithmetic, tangent: bool) -> Crossing:
    """A line and a circle.

    Parameters
    ----------
    line : a point x, y and a unit direction [frame]
    circle : centre x, y and radius [frame]
    arithmetic : of all of these
    tangent : whether the chord is zero by decree

    Returns
    -------
    Crossing
        The first of the two places (+) is the farther along the line.
    """
    (px, py, vx, vy), (cx, cy, r) = line, circle
    wx, wy = cx - px, cy - py
    along = vx * wx + vy * wy
    middle = (px + along * vx, py + along * vy)
    margins = gaps_of_line_and_circle(line, circle)
    scale = r + arithmetic.sqrt(wx * wx + wy * wy)
    if tangent:
        return Crossing(middle, None, margins, scale)
    h = arithmetic.sqrt(margins[0] * margins[1])
    return Crossing(middle, (vx * h, vy * h), margins, scale)


def meet_lines(p: Values, q: Values) -> Crossing:
    """Two lines, each a point x, y and a unit direction [frame]. Parallel ones divide by zero: whether they
    are is the caller's to test.
    """
    (px, py, ux, uy), (qx, qy, vx, vy) = p, q
    wx, wy = qx - px, qy - py
    sine = sine_between(p, q)
    t = (wx * vy - wy * vx) / sine
    return Crossing((px + t * ux, py + t * uy), None, (), sine)


class CircleLocus(NamedTuple):
    """The circle about a point."""

    centre: Key
    radius: Span

    def values(self, workspace: Workspace) -> Values:
        """Centre and radius."""
        return (*workspace.points[self.centre], workspace.length(self.radius))

    def data(self) -> tuple[Datum, ...]:
        """The data that it comes from."""
        return data_in(self.radius)

    def needs(self) -> tuple[Key, ...]:
        """The points that it comes from."""
        return (self.centre, *ends_of(self.radius))


class ArcLocus(NamedTuple):
    """The circle from which two points are seen under a corner's angle (Euclid III 21)."""

    a: Key
    b: Key
    corner: Datum

    def values(self, workspace: Workspace) -> Values:
        """Centre and radius: the centre stands off the chord's middle by half the chord times cot."""
        (ax, ay), (bx, by) = workspace.points[self.a], workspace.points[self.b]
        c, s = workspace.turn(self.corner)
        k = c / (2.0 * s)
        dx, dy = bx - ax, by - ay
        cx, cy = (ax + bx) / 2.0 - k * dy, (ay + by) / 2.0 + k * dx
        return cx, cy, workspace.arithmetic.sqrt((ax - cx) * (ax - cx) + (ay - cy) * (ay - cy))

    def data(self) -> tuple[Datum, ...]:
        """The corner."""
        return (self.corner,)

    def needs(self) -> tuple[Key, ...]:
        """The chord's ends."""
        return (self.a, self.b)


class LineLocus(NamedTuple):
    """A line through a point; with ``ray`` only the half of it that lies ahead."""

    through: Key
    direction: LineDirection
    ray: bool

    def values(self, workspace: Workspace) -> Values:
        """Point and unit direction."""
        return (*workspace.points[self.through], *workspace.unit(self.direction))

    def data(self) -> tuple[Datum, ...]:
        """The data that it comes from."""
        return self.direction.data()

    def needs(self) -> tuple[Key, ...]:
        """The points that it comes from."""
        return (self.through, *self.direction.needs())


class Axis(NamedTuple):
    """The line of a known x or a known y."""

    datum: Datum

    def values(self, workspace: Workspace) -> Values:
        """Point and unit direction: toward +y for a known x, toward +x for a known y."""
        value = workspace.coordinate(self.datum)
        return (value, 0.0, 0.0, 1.0) if self.datum.kind == X else (0.0, value, 1.0, 0.0)

    def data(self) -> tuple[Datum, ...]:
        """The coordinate."""
        return (self.datum,)

    def needs(self) -> tuple[Key, ...]:
        """Nothing."""
        return ()


class Tether(NamedTuple):
    """The circle about a point on which what a rope of given length leaves keeps another.

    All ``parts`` of the rope that end at that other point come from the centre.
    """

    centre: Key
    rope: Datum
    point: str
    parts: int

    def values(self, workspace: Workspace) -> Values:
        """Centre and radius."""
        left = workspace.length(self.rope) - length_of(workspace, self.rope, self.point)
        return (*workspace.points[self.centre], left / float(self.parts))

    def data(self) -> tuple[Datum, ...]:
        """The rope."""
        return (self.rope,)

    def needs(self) -> tuple[Key, ...]:
        """Its other points."""
        return tuple(dict.fromkeys(p for p in self.rope.points if p != self.point))


def length_of(workspace: Workspace, datum: Datum, without: str = "") -> Scalar:
    """How long a rope is where the points are, without its parts at one (normalised)."""
    rope = workspace.case.ropes[datum.ref]  # type: ignore[index]
    points = {p: workspace.points[p] for p in rope.points if p != without}
    return rope_length(rope, points, workspace.frame.scale, workspace.arithmetic, without)


class Shifted(NamedTuple):
    """The locus of another point, moved by the known vector from this point to that one."""

    base: CircleLocus | ArcLocus | Tether | LineLocus | Axis | Shifted
    span: Span
    direction: LineDirection

    def values(self, workspace: Workspace) -> Values:
        """Those of the base, moved back along the vector."""
        x, y, *rest = self.base.values(workspace)
        length = workspace.length(self.span)
        c, s = workspace.unit(self.direction)
        return (x - length * c, y - length * s, *rest)

    def data(self) -> tuple[Datum, ...]:
        """The data of the base and of the vector."""
        return (*self.base.data(), *data_in(self.span), *self.direction.data())

    def needs(self) -> tuple[Key, ...]:
        """The points that it comes from."""
        return (*self.base.needs(), *ends_of(self.span), *self.direction.needs())


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


def crossing(first: Locus, second: Locus, workspace: Workspace, tangent: bool = False) -> Crossing:
    """Where two loci meet; a line comes first if there is one."""
    p, q = first.values(workspace), second.values(workspace)
    if not is_round(second):
        return meet_lines(p, q)
    meet = meet_circles if is_round(first) else meet_line_circle
    return meet(p, q, workspace.arithmetic, tangent)
