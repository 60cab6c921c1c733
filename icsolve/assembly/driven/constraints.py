"""Joints and drivers as conditions on where the links are; each with its derivatives, for Newton's method.

A pin is no condition here but one spot of several bodies. A slide is a `Turning` (its two bodies turn
alike) and an `OnLine`; a slot is an `OnLine`; gears and belts are a `Turning`; rolling is in `rolling`.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

from icsolve.assembly.conditions import FigureEquation, at_distance, on_line
from icsolve.assembly.driven.poses import Places, Rotation, Shape, Spot, dot, minus, scaled, square
from icsolve.assembly.workspace import Datum, Workspace
from icsolve.case import Rope
from icsolve.errors import SceneError
from icsolve.numbers.arithmetic import RADIAN, Scalar
from icsolve.numbers.record import Record
from icsolve.screws.plane import Point, Triple
from icsolve.screws.ropes import RopePart, part_between
from icsolve.tuples import NamedTuple


class BodyLine(NamedTuple):
    """A line that a body carries.

    Attributes
    ----------
    body : its index
    through : a point, as written [frame of size 1]
    along : unit direction, as written
    """

    body: int
    through: Point
    along: Point


class OnLine(NamedTuple):
    """A spot lies ``offset`` [frame] to the left of a line."""

    spot: Spot
    line: BodyLine
    offset: Scalar = 0.0


class SpotDistance(NamedTuple):
    """Two spots are ``distance`` [frame] apart."""

    one: Spot
    two: Spot
    distance: Scalar


Terms = tuple[tuple[int, Scalar], ...]
"""Pairs of a body and the factor of the angle by which it has turned since the position as written."""
Turn = Callable[[Scalar, Scalar], Scalar]
"""By how much a vector (x, y) has turned from +x, degrees."""


def spun(terms: Terms, places: Places, but: int | None = None) -> Scalar:
    """The angles by which bodies have turned [degrees], each times its factor, without those of one body."""
    total: Scalar = 0.0
    for body, factor in terms:
        if body != but:
            total = total + factor * places.degrees(body)
    return total


class Turning(NamedTuple):
    """The angles of the ``terms``, each times its factor, add up to ``degrees``.

    Of gears the factors are the teeth, as the arm sees them (R. Willis, Principles of Mechanism, 1841).
    """

    terms: Terms
    degrees: Scalar = 0.0

    @property
    def alike(self) -> bool:
        """Whether it says that two bodies turn alike."""
        factors = [factor for _, factor in self.terms]
        return factors == [1.0, -1.0] and type(self.degrees) is float and self.degrees == 0.0

    def rest(self, shape: Shape, places: Places, turned: Turn) -> Scalar:
        """What the sum of the terms lacks to zero [degrees times a factor]."""
        return -self.degrees


class Pointed(NamedTuple):
    """A body has the rotation of a driver: the direction of two of its spots is given."""

    body: int
    rotation: Rotation


class RolledStraight(NamedTuple):
    """A round body has rolled along a straight flank: its centre's way is its turning times the radius.

    The flank's line runs so that the centre is on its left; ``radius`` [frame].
    """

    centre: Spot
    line: BodyLine
    radius: Scalar

    @property
    def terms(self) -> Terms:
        """How far the turning of either body rolls the centre."""
        return (self.centre[0], self.radius), (self.line.body, -self.radius)

    def rest(self, shape: Shape, places: Places, turned: Turn) -> Scalar:
        """How far the centre has gone along the flank [degrees times a radius]."""
        through = places.point(self.line.body, self.line.through)
        along = places.vector(self.line.body, self.line.along)
        return dot(along, minus(places.place(self.centre), through)) / RADIAN


class RolledRound(NamedTuple):
    """Two round bodies have rolled on one another: equal arcs. ``radii`` [frame] of their centres; a negative
    one is hollow.
    """

    one: Spot
    two: Spot
    radii: tuple[Scalar, Scalar]

    @property
    def terms(self) -> Terms:
        """The arc that the turning of either body rolls."""
        return (self.one[0], self.radii[0]), (self.two[0], self.radii[1])

    def rest(self, shape: Shape, places: Places, turned: Turn) -> Scalar:
        """What the turning of the line of the centres makes of the arcs [degrees times a radius]."""
        e, written = minus(places.place(self.two), places.place(self.one)), shape.between(self.one, self.two)
        whole = self.radii[0] + self.radii[1]
        return -(whole * turned(dot(written, e), dot(square(written), e)))


class Drawn(NamedTuple):
    """A length, an angle or a coordinate of the case that no kind above is: by its equation."""

    datum: Datum
    owners: tuple[Spot, ...]


class Roped(NamedTuple):
    """A rope keeps its length: its straight parts, and the arcs on what it goes round.

    Attributes
    ----------
    spots : the centres of its circles
    offsets : their radii [frame], positive where it goes round ccw, 0 of a point
    written : its parts as written
    scale : frame lengths a case length
    """

    rope: Rope
    spots: tuple[Spot, ...]
    offsets: tuple[Scalar, ...]
    written: tuple[RopePart, ...]
    scale: float

    def is_round(self, k: int) -> bool:
        """Whether it goes round its place ``k``, a pulley or a drum."""
        return self.rope.radii[k] is not None

    def part(self, k: int, places: Places, record: Record) -> RopePart:
        """A straight part where the bodies are."""
        one, two = ((places.place(self.spots[n]), self.offsets[n]) for n in (k, k + 1))
        return part_between(self.rope, k, one, two, self.scale, record)

    def tied_to(self, spot: Spot) -> tuple[Spot, int] | None:
        """The one spot from which straight parts alone lead to another, and how many do; None elsewhere."""
        own = [k for k in range(len(self.written)) if spot in self.spots[k : k + 2]]
        others = {end for k in own for end in self.spots[k : k + 2]} - {spot}
        if len(others) != 1 or any(self.is_round(n) for k in own for n in (k, k + 1)):
            return None
        return next(iter(others)), len(own)

    @property
    def terms(self) -> Terms:
        """The bodies on which its ends are wound, and by how much a rad of each makes it longer [frame]."""
        ends = [(0, -1.0), (len(self.written), 1.0)]
        return tuple((self.spots[k][0], sign * self.offsets[k]) for k, sign in ends if self.is_round(k))

    def rest(self, shape: Shape, places: Places, turned: Turn) -> Scalar:
        """By how much it has become longer but for what its drums take up [degrees times a radius]."""
        return self.longer(places, shape.record, turned) / RADIAN

    def longer(self, places: Places, record: Record, turned: Turn, without: Spot | None = None) -> Scalar:
        """By how much the rope is longer than as written [frame], but for the turning of its drums.

        On a drum it is wound by as much as its part turns.

        Parameters
        ----------
        places : where the bodies are
        record : arithmetic of the places
        turned : by how much a vector (x, y) has turned from +x [degrees], whole turns counted
        without : a spot whose parts do not count
        """
        more: Scalar = 0.0
        for k, then in enumerate(self.written):
            more = more - then.length
            if without in self.spots[k : k + 2]:
                continue
            now = self.part(k, places, record)
            more = more + now.length
            if self.is_round(k) or self.is_round(k + 1):
                angle = turned(dot(then.along, now.along), dot(square(then.along), now.along))
                more = more + (self.offsets[k] - self.offsets[k + 1]) * angle * RADIAN
        return more


Spinning = Turning | RolledStraight | RolledRound | Roped
"""The angles of their ``terms``, each times its factor, and their ``rest`` add up to zero."""


class Immovable(NamedTuple):
    """A joint that is known as written only: the wrenches that it transmits, and why it cannot be moved."""

    ends: tuple[int, int]
    wrench: Triple
    refusal: SceneError


Constraint = (
    OnLine | SpotDistance | Turning | Pointed | RolledStraight | RolledRound | Roped | Drawn | Immovable
)


def bodies_of(constraint: Constraint) -> frozenset[int]:
    """The bodies that a constraint ties."""
    match constraint:
        case OnLine(spot, line):
            return frozenset((spot[0], line.body))
        case SpotDistance(one, two):
            return frozenset((one[0], two[0]))
        case Pointed(body):
            return frozenset((body,))
        case Roped():
            return frozenset(body for body, _ in constraint.spots)
        case Drawn():
            return frozenset(body for body, _ in constraint.owners)
        case Immovable(ends):
            return frozenset(ends)
    return frozenset(body for body, _ in constraint.terms)


class ConditionRow(NamedTuple):
    """An equation: its value, which is to vanish, and its derivatives by (body, part): the steps of
    the body's base along x and y, and its turning in radians."""

    value: Scalar
    by: dict[tuple[int, int], Scalar]


class ConditionRows:
    """The equations of constraints on bodies that are at places."""

    def __init__(self, shape: Shape, places: Places, bases: dict[int, Spot], workspace: Workspace) -> None:
        self.shape, self.places, self.bases, self.workspace = shape, places, bases, workspace

    def of(self, constraint: Constraint) -> ConditionRow:
        """The equation of a constraint."""
        match constraint:
            case OnLine():
                return self._on_line(constraint)
            case SpotDistance():
                return self._apart(constraint)
            case Turning():
                return self._turning(constraint)
            case Pointed():
                return self._pointed(constraint)
            case RolledStraight():
                return self._straight(constraint)
            case RolledRound():
                return self._round(constraint)
            case Roped():
                return self._roped(constraint)
            case Immovable():
                return self._immovable(constraint)
        return self._drawn(constraint)

    def pinned(self, one: Spot, two: Spot) -> list[ConditionRow]:
        """The two equations of a pin."""
        p, q = self.places.place(one), self.places.place(two)
        rows = []
        for axis in (0, 1):
            w = (1.0 - axis, float(axis))
            rows.append(ConditionRow(p[axis] - q[axis], self._pushed((one[0], w, p), (two[0], _less(w), q))))
        return rows

    def held(self, spot: Spot, at: Point) -> list[ConditionRow]:
        """The two equations of a pin whose place is known."""
        p = self.places.place(spot)
        axes = (((1.0, 0.0), p[0] - at[0]), ((0.0, 1.0), p[1] - at[1]))
        return [ConditionRow(value, self._pushed((spot[0], w, p))) for w, value in axes]

    def _pushed(self, *pushes: tuple[int, Point, Point]) -> dict[tuple[int, int], Scalar]:
        """Derivatives of a force's work: (body, force, point) for each."""
        by: dict[tuple[int, int], Scalar] = {}
        for body, w, p in pushes:
            if body == self.shape.ground or body not in self.bases:
                continue
            arm = minus(p, self.places.place(self.bases[body]))
            for part, value in enumerate((w[0], w[1], dot(w, square(arm)))):
                by[body, part] = by.get((body, part), 0.0) + value
        return by

    def _on_line(self, c: OnLine) -> ConditionRow:
        p, through = self.places.place(c.spot), self.places.point(c.line.body, c.line.through)
        value, (pull, back) = on_line(p, through, self.places.vector(c.line.body, c.line.along), c.offset)
        return ConditionRow(value, self._pushed((c.spot[0], pull, p), (c.line.body, back, p)))

    def _apart(self, c: SpotDistance) -> ConditionRow:
        p, q = self.places.place(c.one), self.places.place(c.two)
        value, (pull, back) = at_distance(p, q, c.distance)
        return ConditionRow(value, self._pushed((c.one[0], pull, p), (c.two[0], back, q)))

    def _turning(self, c: Turning) -> ConditionRow:
        by = {(body, 2): factor for body, factor in c.terms if body in self.bases}
        if c.alike:
            a, b = (self.places.vector(body, (1.0, 0.0)) for body, _ in c.terms)
            return ConditionRow(dot(square(b), a), by)
        return ConditionRow(self._left(c) * RADIAN, by)

    def _left(self, c: Spinning) -> Scalar:
        """The sum of the terms and the rest [degrees times a factor]."""
        return c.rest(self.shape, self.places, self.shape.record.angle) + spun(c.terms, self.places)

    def _pointed(self, c: Pointed) -> ConditionRow:
        z = self.places.vector(c.body, c.rotation.ref)
        return ConditionRow(dot(square(c.rotation.z), z), {(c.body, 2): dot(c.rotation.z, z)})

    def _straight(self, c: RolledStraight) -> ConditionRow:
        o, b = self.places.place(c.centre), c.line.body
        along = self.places.vector(b, c.line.along)
        contact = minus(o, scaled(c.radius, square(along)))
        pushes = self._pushed((c.centre[0], along, contact), (b, _less(along), contact))
        return ConditionRow(self._left(c) * RADIAN, pushes)

    def _round(self, c: RolledRound) -> ConditionRow:
        """Slip of the arcs; the line of the centres may have turned any number of times."""
        (one, two), (r, q) = (c.one, c.two), c.radii
        p = self.places.place(one)
        e, whole = minus(self.places.place(two), p), r + q
        value, around = self._left(c), whole * 360.0
        value = value - around * self.shape.record.nearest(value / around)
        normal = (e[0] / whole, e[1] / whole)
        along = square(normal)
        contact = (p[0] + r * normal[0], p[1] + r * normal[1])
        return ConditionRow(
            value * RADIAN, self._pushed((one[0], along, contact), (two[0], _less(along), contact))
        )

    def _roped(self, c: Roped) -> ConditionRow:
        """Each part pulls at the points of its links on its line."""
        record = self.shape.record
        pulls = []
        for k, (one, two) in enumerate(pairwise(c.spots)):
            part = c.part(k, self.places, record)
            pulls += [(one[0], _less(part.along), part.at), (two[0], part.along, part.at)]
        return ConditionRow(self._left(c) * RADIAN, self._pushed(*pulls))

    def _immovable(self, c: Immovable) -> ConditionRow:
        """Power of the wrench on the relative step of the two bodies."""
        x, y, m = c.wrench
        by: dict[tuple[int, int], Scalar] = {}
        for body, sign in zip(c.ends, (-1.0, 1.0), strict=True):
            if body in self.bases:
                px, py = self.places.place(self.bases[body])
                for part, value in enumerate((y, -x, x * px + y * py + m)):
                    by[body, part] = sign * value
        return ConditionRow(0.0, by)

    def _drawn(self, c: Drawn) -> ConditionRow:
        owners = {name: (body, name) for body, name in c.owners}
        for name, spot in owners.items():
            self.workspace.points[name] = self.places.place(spot)
        value, pulls = FigureEquation(c.datum).at(self.workspace)
        pairs = zip(c.datum.points, pulls, strict=True)
        pushes = ((owners[name][0], pull, self.workspace.points[name]) for name, pull in pairs)
        return ConditionRow(value, self._pushed(*pushes))


def _less(v: Point) -> Point:
    return (-v[0], -v[1])
