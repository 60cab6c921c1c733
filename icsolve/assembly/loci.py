"""The loci that data of the written figure put a point on, each placed on a workspace of any arithmetic."""

from __future__ import annotations

from icsolve.assembly.data import Datum, X
from icsolve.assembly.intersections import PlacedCircle, PlacedLine, PlacedLocus
from icsolve.assembly.workspace import Key, LineDirection, Span, Workspace, data_in, ends_of
from icsolve.numbers.arithmetic import Scalar
from icsolve.screws.ropes import rope_length
from icsolve.tuples import NamedTuple


class CircleLocus(NamedTuple):
    """The circle about a point."""

    centre: Key
    radius: Span

    def placed(self, workspace: Workspace) -> PlacedCircle:
        """The circle where its points are."""
        return PlacedCircle(workspace.points[self.centre], workspace.length(self.radius))

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

    def placed(self, workspace: Workspace) -> PlacedCircle:
        """The centre stands off the chord's middle by half the chord times the angle's cotangent."""
        (ax, ay), (bx, by) = workspace.points[self.a], workspace.points[self.b]
        c, s = workspace.turn(self.corner)
        k = c / (2.0 * s)
        dx, dy = bx - ax, by - ay
        cx, cy = (ax + bx) / 2.0 - k * dy, (ay + by) / 2.0 + k * dx
        radius = workspace.arithmetic.sqrt((ax - cx) * (ax - cx) + (ay - cy) * (ay - cy))
        return PlacedCircle((cx, cy), radius)

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

    def placed(self, workspace: Workspace) -> PlacedLine:
        """The line where its points are."""
        return PlacedLine(workspace.points[self.through], workspace.unit(self.direction))

    def data(self) -> tuple[Datum, ...]:
        """The data that it comes from."""
        return self.direction.data()

    def needs(self) -> tuple[Key, ...]:
        """The points that it comes from."""
        return (self.through, *self.direction.needs())


class Axis(NamedTuple):
    """The line of a known x or a known y."""

    datum: Datum

    def placed(self, workspace: Workspace) -> PlacedLine:
        """The line: toward +y for a known x, toward +x for a known y."""
        value = workspace.coordinate(self.datum)
        if self.datum.kind == X:
            return PlacedLine((value, 0.0), (0.0, 1.0))
        return PlacedLine((0.0, value), (1.0, 0.0))

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

    def placed(self, workspace: Workspace) -> PlacedCircle:
        """The circle where its points are."""
        left = workspace.length(self.rope) - length_of(workspace, self.rope, self.point)
        return PlacedCircle(workspace.points[self.centre], left / float(self.parts))

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

    def placed(self, workspace: Workspace) -> PlacedLocus:
        """That of the base, moved back along the vector."""
        base = self.base.placed(workspace)
        length, (c, s) = workspace.length(self.span), workspace.unit(self.direction)
        x, y = base[0]
        at = (x - length * c, y - length * s)
        return PlacedCircle(at, base.radius) if isinstance(base, PlacedCircle) else PlacedLine(at, base.along)

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
