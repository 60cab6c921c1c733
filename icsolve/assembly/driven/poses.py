"""Where the links are: each by a place of one of its points and a rotation since the position as written.

A link's shape is that of the position as written. What it carries (points, lines, directions) moves with
it: as complex numbers, place = base + z (ref - ref base) / z_ref with z a vector that the link carries
and z_ref the same vector in the position as written.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from icsolve.numbers import Scalar
from icsolve.numbers.record import Record
from icsolve.screws import Point
from icsolve.tuples import NamedTuple

Spot = tuple[int, str]
"""A point as a body carries it: the body and the point's name."""


class WrittenPlaces(dict[str, Point]):
    """Places as written [frame] on a record, each worked out when it is first asked for: of many points only
    the lengths between them matter. ``still`` has all of them in doubles, to choose by."""

    def __init__(self, still: Mapping[str, Point], late: Callable[[str], Point]) -> None:
        super().__init__()
        self.still = {name: (float(x), float(y)) for name, (x, y) in still.items()}
        self._late = late

    def __missing__(self, name: str) -> Point:
        found = self[name] = self._late(name)
        return found

    def add(self, name: str, at: Point) -> None:
        """A place that has no name in the figure."""
        self[name], self.still[name] = at, (float(at[0]), float(at[1]))


class Arm(NamedTuple):
    """The vector from one spot to another as written, in parts of a length."""

    start: Spot
    end: Spot
    length: Scalar = 1.0


class Shape:
    """The bodies as written.

    Parameters
    ----------
    record : on which the places of a motion are expressions
    ref : by name, the places of points [frame of size 1]; ``still`` has them in doubles
    joined : by spot on a pin, the spot that stands for all on it
    spans : by pair of names, the distances that the case gives [frame]
    ground : index of the frame's body
    """

    def __init__(
        self,
        record: Record,
        ref: WrittenPlaces,
        joined: Mapping[Spot, Spot],
        spans: Mapping[frozenset[str], Scalar],
        ground: int,
    ) -> None:
        self.record, self.ref, self.joined, self.spans, self.ground = record, ref, joined, spans, ground
        self.still = ref.still

    def one(self, spot: Spot) -> Spot:
        """The spot that stands for all on its pin."""
        return self.joined.get(spot, spot)

    def between(self, p: Spot, q: Spot) -> Point:
        """Vector from p to q as written [frame]."""
        (px, py), (qx, qy) = self.ref[p[1]], self.ref[q[1]]
        return (qx - px, qy - py)

    def vector(self, written: Point | Arm) -> Point:
        """A vector as written [frame], or of length 1."""
        if not isinstance(written, Arm):
            return written
        x, y = self.between(written.start, written.end)
        return (x / written.length, y / written.length)

    def span(self, p: Spot, q: Spot) -> Scalar:
        """Distance of two points of a body [frame]: as the case gives it, else from their places."""
        given = self.spans.get(frozenset((p[1], q[1])))
        if given is not None:
            return given
        x, y = self.between(p, q)
        return self.record.sqrt(x * x + y * y)

    def apart(self, p: Spot, q: Spot) -> float:
        """The distance in the position as written, to choose by."""
        (px, py), (qx, qy) = self.still[p[1]], self.still[q[1]]
        return abs(complex(qx - px, qy - py))


class Rotation(NamedTuple):
    """How a body has turned.

    Attributes
    ----------
    z : a vector that it carries, of any length
    ref : the same vector as written, or what it is the vector of
    degrees : the turning since then, whole turns too; None until it is asked for
    unit : ``ref`` where ``z`` is the unit vector of it, whose length is known
    """

    z: Point
    ref: Point | Arm = (1.0, 0.0)
    degrees: Scalar | None = None
    unit: Arm | None = None


def rotated(shape: Shape, degrees: Scalar) -> Rotation:
    """The rotation by an angle."""
    return Rotation(shape.record.turned(degrees), (1.0, 0.0), degrees)


class Places:
    """Where the bodies are: in the position as written; `Moved` has them in motion."""

    def __init__(self, shape: Shape) -> None:
        self.shape = shape

    def place(self, spot: Spot) -> Point:
        """Where a body's point is."""
        return self.shape.still[spot[1]]

    def point(self, body: int, at: Point) -> Point:
        """Where a place of a body is that was at ``at`` as written."""
        return (float(at[0]), float(at[1]))

    def vector(self, body: int, v: Point) -> Point:
        """A vector that a body carries."""
        return (float(v[0]), float(v[1]))

    def degrees(self, body: int) -> Scalar:
        """By how much a body has turned."""
        return 0.0


class Moved(Places):
    """The bodies in motion, as far as they are known; places [frame of size 1] are numbers of a record.

    A body that is not placed yet raises KeyError.
    """

    def __init__(self, shape: Shape) -> None:
        super().__init__(shape)
        self.located: dict[Spot, Point] = {}
        self.rotations: dict[int, Rotation] = {shape.ground: Rotation((1.0, 0.0), (1.0, 0.0), 0.0)}
        self.bases: dict[int, Spot] = {}

    def place(self, spot: Spot) -> Point:
        """Where a body's point is."""
        found = self.located.get(self.shape.one(spot))
        if found is not None:
            return found
        body, name = spot
        if body == self.shape.ground:
            return self.shape.ref[name]
        base, rotation = self.bases[body], self.rotations[body]
        x, y = self._arm(rotation, base, spot) or self.vector(body, self.shape.between(base, spot))
        bx, by = self.place(base)
        return (bx + x, by + y)

    def _arm(self, rotation: Rotation, base: Spot, spot: Spot) -> Point | None:
        if rotation.unit is None:
            return None
        p, q, length = rotation.unit
        (x, y), one = rotation.z, self.shape.one
        if (one(base), one(spot)) == (one(p), one(q)):
            return (x * length, y * length)
        return (-x * length, -y * length) if (one(base), one(spot)) == (one(q), one(p)) else None

    def point(self, body: int, at: Point) -> Point:
        """Where a place of a body is that was at ``at`` as written."""
        if body == self.shape.ground:
            return at
        base = self.bases[body]
        return plus(self.place(base), self.vector(body, minus(at, self.shape.ref[base[1]])))

    def vector(self, body: int, v: Point) -> Point:
        """A vector that a body carries."""
        if body == self.shape.ground:
            return v
        rotation = self.rotations[body]
        return product(rotation.z, quotient(v, self.shape.vector(rotation.ref)))

    def degrees(self, body: int) -> Scalar:
        """By how much a body has turned."""
        rotation = self.rotations[body]
        if rotation.degrees is None:
            c, s = self.vector(body, (1.0, 0.0))
            rotation = rotation._replace(degrees=self.shape.record.turns(c, s))
            self.rotations[body] = rotation
        return rotation.degrees


def product(a: Point, b: Point) -> Point:
    """Product of two complex numbers (x, y)."""
    return (a[0] * b[0] - a[1] * b[1], a[1] * b[0] + a[0] * b[1])


def quotient(a: Point, b: Point) -> Point:
    """Quotient of two complex numbers (x, y); divides by zero where b is (0, 0)."""
    size = b[0] * b[0] + b[1] * b[1]
    return ((a[0] * b[0] + a[1] * b[1]) / size, (a[1] * b[0] - a[0] * b[1]) / size)


def square(v: Point) -> Point:
    """A vector turned by +90 degrees."""
    return (-v[1], v[0])


def dot(a: Point, b: Point) -> Scalar:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1]


def minus(a: Point, b: Point) -> Point:
    """Vector from b to a."""
    return (a[0] - b[0], a[1] - b[1])


def plus(a: Point, b: Point) -> Point:
    """Sum."""
    return (a[0] + b[0], a[1] + b[1])


def scaled(k: Scalar, v: Point) -> Point:
    """A multiple."""
    return (k * v[0], k * v[1])
