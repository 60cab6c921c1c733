"""Joints and drivers as conditions on where the links are; each with its derivatives, for Newton's method.

A pin is no condition here but one spot of several bodies. A slide is a `Turning` (its two bodies turn
alike) and an `OnLine`; a slot is an `OnLine`; gears and belts are a `Turning`; rolling is in `mechanism`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from itertools import pairwise

from icsolve.assembly.conditions import FigureEquation, at_distance, on_line
from icsolve.assembly.driven.poses import (
    Arm,
    Places,
    Rotation,
    Shape,
    Spot,
    dot,
    minus,
    plus,
    scaled,
    square,
)
from icsolve.assembly.workspace import Datum, Workspace
from icsolve.case import Rope
from icsolve.errors import SceneError, Status
from icsolve.numbers import Scalar
from icsolve.numbers.record import Record
from icsolve.screws import Point, Triple
from icsolve.screws.ropes import RopePart, part_between
from icsolve.tuples import NamedTuple

BEYOND = "how links roll on one another is beyond all numbers: give them radii of the figure's size."


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
    """A body has the rotation of a driver: an arm of it is to point at so many degrees; ``written`` are those
    in the position as written."""

    body: int
    arm: Arm
    degrees: Scalar
    written: Scalar

    def rotation(self, record: Record) -> Rotation:
        """How the body has turned."""
        return Rotation(record.turned(self.degrees), self.arm, self.degrees - self.written, self.arm)


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
        return dot(along, minus(places.place(self.centre), through)) / shape.record.radian


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
        return self.rope.tied_to(self.spots, spot)

    @property
    def terms(self) -> Terms:
        """The bodies on which its ends are wound, and by how much a rad of each makes it longer [frame]."""
        ends = [(0, -1.0), (len(self.written), 1.0)]
        return tuple((self.spots[k][0], sign * self.offsets[k]) for k, sign in ends if self.is_round(k))

    def rest(self, shape: Shape, places: Places, turned: Turn) -> Scalar:
        """By how much it has become longer but for what its drums take up [degrees times a radius]."""
        return self.longer(places, shape.record, turned) / shape.record.radian

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
                more = more + (self.offsets[k] - self.offsets[k + 1]) * angle * record.radian
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


Push = tuple[int, Point, Point]
"""A body, a force on it, and where it acts: its work on a step of the body is a derivative."""


class ConditionRows:
    """The equations of constraints on bodies that are at places."""

    def __init__(self, shape: Shape, places: Places, bases: dict[int, Spot], workspace: Workspace) -> None:
        self.shape, self.places, self.bases, self.workspace = shape, places, bases, workspace

    def of(self, constraint: Constraint) -> ConditionRow:
        """The equation of a constraint."""
        match constraint:
            case Turning() as c:
                by = {(body, 2): factor for body, factor in c.terms if body in self.bases}
                if not c.alike:
                    return ConditionRow(self._left(c), by)
                a, b = (self.places.vector(body, (1.0, 0.0)) for body, _ in c.terms)
                return ConditionRow(dot(square(b), a), by)
            case Pointed(body, arm, degrees):
                z, along = self.places.vector(body, self.shape.vector(arm)), self.shape.record.turned(degrees)
                return ConditionRow(dot(square(along), z), {(body, 2): dot(along, z)})
            case Immovable():
                return ConditionRow(0.0, self._power(constraint))
        value, pushes = self._pushing(constraint)
        return self._pushed(value, pushes)

    def pinned(self, one: Spot, two: Spot) -> list[ConditionRow]:
        """The two equations of a pin."""
        p, q = self.places.place(one), self.places.place(two)
        return [
            self._pushed(p[n] - q[n], [(one[0], w, p), (two[0], _less(w), q)]) for n, w in enumerate(AXES)
        ]

    def held(self, spot: Spot, at: Point) -> list[ConditionRow]:
        """The two equations of a pin whose place is known."""
        p = self.places.place(spot)
        return [self._pushed(p[n] - at[n], [(spot[0], w, p)]) for n, w in enumerate(AXES)]

    def _pushed(self, value: Scalar, pushes: Iterable[Push]) -> ConditionRow:
        """An equation with the derivatives that forces make by their work."""
        by: dict[tuple[int, int], Scalar] = {}
        for body, w, p in pushes:
            if body == self.shape.ground or body not in self.bases:
                continue
            arm = minus(p, self.places.place(self.bases[body]))
            for part, share in enumerate((w[0], w[1], dot(w, square(arm)))):
                by[body, part] = by.get((body, part), 0.0) + share
        return ConditionRow(value, by)

    def _pushing(
        self, c: OnLine | SpotDistance | RolledStraight | RolledRound | Roped | Drawn
    ) -> tuple[Scalar, list[Push]]:
        """The value of a condition on places, and the forces that are its derivatives by them."""
        places = self.places
        match c:
            case OnLine(spot, line, offset):
                p, through = places.place(spot), places.point(line.body, line.through)
                value, (pull, back) = on_line(p, through, places.vector(line.body, line.along), offset)
                return value, [(spot[0], pull, p), (line.body, back, p)]
            case SpotDistance(one, two, distance):
                p, q = places.place(one), places.place(two)
                value, (pull, back) = at_distance(p, q, distance)
                return value, [(one[0], pull, p), (two[0], back, q)]
            case RolledStraight(centre, line, radius):
                along = places.vector(line.body, line.along)
                contact = minus(places.place(centre), scaled(radius, square(along)))
                return self._left(c), [(centre[0], along, contact), (line.body, _less(along), contact)]
            case RolledRound(one, two, (r, s)):
                p, whole = places.place(one), r + s
                normal = scaled(1.0 / whole, minus(places.place(two), p))
                along, contact = square(normal), plus(p, scaled(r, normal))
                # the line of the centres may have turned any number of times
                around = whole * 360.0 * self.shape.record.radian
                value = self._left(c)
                if not math.isfinite(float(value / around)):
                    raise SceneError(Status.UNSUPPORTED, BEYOND)
                value = value - around * self.shape.record.nearest(value / around)
                return value, [(one[0], along, contact), (two[0], _less(along), contact)]
            case Roped():  # each part pulls at the points of its links on its line
                pulls: list[Push] = []
                for k, (one, two) in enumerate(pairwise(c.spots)):
                    part = c.part(k, places, self.shape.record)
                    pulls += [(one[0], _less(part.along), part.at), (two[0], part.along, part.at)]
                return self._left(c), pulls
        points, bodies = self.workspace.points, {name: body for body, name in c.owners}
        points |= {spot[1]: places.place(spot) for spot in c.owners}
        value, forces = FigureEquation(c.datum).at(self.workspace)
        return value, [(bodies[p], w, points[p]) for p, w in zip(c.datum.points, forces, strict=True)]

    def _left(self, c: Spinning) -> Scalar:
        """The sum of the terms and the rest [radians times a factor]."""
        return (
            c.rest(self.shape, self.places, self.shape.record.angle) + spun(c.terms, self.places)
        ) * self.shape.record.radian

    def _power(self, c: Immovable) -> dict[tuple[int, int], Scalar]:
        """Power of the wrench on the relative step of the two bodies."""
        x, y, m = c.wrench
        by: dict[tuple[int, int], Scalar] = {}
        for body, sign in zip(c.ends, (-1.0, 1.0), strict=True):
            if body in self.bases:
                px, py = self.places.place(self.bases[body])
                for part, value in enumerate((y, -x, x * px + y * py + m)):
                    by[body, part] = sign * value
        return by


AXES: tuple[Point, Point] = ((1.0, 0.0), (0.0, 1.0))


def _less(v: Point) -> Point:
    return (-v[0], -v[1])
