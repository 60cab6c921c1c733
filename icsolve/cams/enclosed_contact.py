"""A contact on a profile enclosed: its point, its normal and its follower's place in balls of 300 digits.

The search in doubles says which piece of the profile is touched, and about where. The equations of that
piece (line, circle, spline, corner) and of the follower have one solution there (Krawczyk's operator):

    n.n = 1,  P on the piece, n square to it,  Q = P + R n   (a face: n along its own normal, (Q - P).n = 0)

with the point P, the normal n into the follower, the radius R of a roller, and the follower's point Q where
its freedom takes it. Of a follower whose place is given, its gap from the profile is unknown instead.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Iterator, Mapping, Sequence
from decimal import Decimal
from functools import lru_cache

from icsolve.assembly import place, solve_figure
from icsolve.cams.curve import Curve, Foot
from icsolve.cams.pieces import TURN, CircularArc, Point, PolarPiece, Spline, Straight, spline
from icsolve.case import Case, Number
from icsolve.case.profiles import Arc, Arcs, Circle, Follower, Line, Polygon, Radii, Roller, Shape
from icsolve.numbers import Scalar
from icsolve.numbers.balls import INEXACT, UP, Ball, Balls, MoreDigits
from icsolve.numbers.decimals import WIDE
from icsolve.numbers.krawczyk import enclosed_root
from icsolve.numbers.units import found_number
from icsolve.tuples import NamedTuple

DIGITS = 160
"""More than any scene is evaluated with."""
KEPT = 145
"""Digits of what is found that are handed on: the rest is less than a scene's own rounding."""
NEARBY = 1e-5
"""The solution lies within this fraction of the profile's size of where doubles put it."""
Vector = tuple[Scalar, Scalar]


class Derived:
    """A number and its derivatives by the unknowns, by index."""

    __slots__ = ("by", "value")

    def __init__(self, value: Scalar, by: Mapping[int, Scalar]) -> None:
        self.value, self.by = value, by

    def __add__(self, other: Derived | Scalar) -> Derived:
        if not isinstance(other, Derived):
            return Derived(self.value + other, self.by)
        return Derived(self.value + other.value, _joined(self.by, other.by))

    def __mul__(self, other: Derived | Scalar) -> Derived:
        if not isinstance(other, Derived):
            return Derived(self.value * other, {k: v * other for k, v in self.by.items()})
        own = {k: v * other.value for k, v in self.by.items()}
        return Derived(
            self.value * other.value, _joined(own, {k: v * self.value for k, v in other.by.items()})
        )

    def __neg__(self) -> Derived:
        return self * -1.0

    def __sub__(self, other: Derived | Scalar) -> Derived:
        return self + (-other if isinstance(other, Derived) else 0.0 - other)

    __radd__, __rmul__ = __add__, __mul__


def _joined(one: Mapping[int, Scalar], two: Mapping[int, Scalar]) -> dict[int, Scalar]:
    out = dict(one)
    for k, v in two.items():
        out[k] = out[k] + v if k in out else v
    return out


class Locus(NamedTuple):
    """What is touched, at the point P with the normal n [lengths over the unit].

    Attributes
    ----------
    equations : of P, n and the unknown of its own, as values that vanish
    start : of that unknown; None where it has none
    within : whether P and n do not lie beyond an end of it, as far as the digits tell
    radius : the radius of curvature there [case length], by its own unknown; None where straight
    """

    equations: Callable[[Sequence[Derived], Sequence[Derived], Derived], list[Derived]]
    start: float | None
    within: Callable[[Vector, Vector], bool]
    radius: Callable[[Scalar], Scalar | None]


class TouchingAbout(NamedTuple):
    """Where doubles put a contact: the point [case length] and the normal, and how far the follower moved:
    its datum [case length], its turn [rad], or its gap."""

    at: Point
    normal: Point
    by: float


class EnclosedContact(NamedTuple):
    """A contact in balls: the point [case length], the normal from the cam into the follower, the radius of
    curvature of the profile there (None: straight), how far its freedom has moved the follower [case
    length, or degrees], and how fast the gap grows as it moves on (only the sign counts; 0 where
    it has no freedom)."""

    at: Vector
    normal: Vector
    radius: Scalar | None
    change: Scalar
    opens: Scalar


class FollowerPlaces(NamedTuple):
    """A follower's point and the direction of its face in balls, and how it moves.

    ``along`` is the way of the point as its datum grows by one [case length]; ``about`` the point about which
    it turns.
    """

    follower: Follower
    at: Vector
    face: Vector | None
    along: Vector | None = None
    about: Vector | None = None


def ball_places(case: Case, names: Sequence[str], balls: Balls) -> dict[str, Vector]:
    """Points of the figure [case length]; raises SceneError and MoreDigits."""
    figure = solve_figure(case, tuple(names))
    ox, oy, scale = figure.frame
    points = place(figure, case, balls).points
    return {name: (points[name][0] / scale + ox, points[name][1] / scale + oy) for name in names}


def direction(line: Line, places: Mapping[str, Vector], balls: Balls) -> Vector:
    """Unit vector of a direction in degrees, or from one point to another."""
    if isinstance(line, Number):
        return balls.turn(line)
    return unit(_less(places[line[1]], places[line[0]]), balls)


def unit(v: Vector, balls: Balls) -> Vector:
    """Unit vector along a vector."""
    length = balls.sqrt(v[0] * v[0] + v[1] * v[1])
    return v[0] / length, v[1] / length


def enclosed_contact(
    locus: Locus, body: FollowerPlaces, start: TouchingAbout, size: float, balls: Balls
) -> EnclosedContact | None:
    """The contact near where doubles put it; None where it lies beyond the end of the piece.

    Parameters
    ----------
    locus : what is touched, in lengths over ``size``
    body : the follower and its freedom [case length]
    start : the contact in doubles
    size : power of two near the profile's size [case length]
    balls : arithmetic of `DIGITS`

    Raises
    ------
    MoreDigits
        Where no single solution is shown near there.
    """
    scale, turns = 1.0 / size, body.about is not None
    begin = [start.at[0] * scale, start.at[1] * scale, *start.normal]
    begin += [] if locus.start is None else [locus.start]
    first = len(begin)
    begin += [math.cos(start.by), math.sin(start.by)] if turns else [start.by * scale]
    at, face = _times(body.at, scale), body.face
    r = balls.given(body.follower.radius) * scale if isinstance(body.follower, Roller) else 0.0

    def system(x: Sequence[Scalar]) -> tuple[list[Scalar], list[dict[int, Scalar]]]:
        v = [Derived(value, {k: 1.0}) for k, value in enumerate(x)]
        p, n, move = v[:2], v[2:4], v[first:]
        rows = [n[0] * n[0] + n[1] * n[1] - 1.0, *locus.equations(p, n, v[4])]
        gap, q, w = Derived(0.0, {}), at, face
        if body.about is not None:
            rows.append(move[0] * move[0] + move[1] * move[1] - 1.0)
            about = _times(body.about, scale)
            turned = _turned(move, _less(at, about))
            q, w = (turned[0] + about[0], turned[1] + about[1]), None if face is None else _turned(move, face)
        elif body.along is not None:
            q = (move[0] * body.along[0] + at[0], move[0] * body.along[1] + at[1])
        else:
            gap = move[0]
        if w is None:
            rows += [p[k] + n[k] * (gap + r) - q[k] for k in (0, 1)]
        else:
            rows.append(n[0] * w[0] + n[1] * w[1])
            rows.append((p[0] - q[0]) * n[0] + (p[1] - q[1]) * n[1] + gap)
        return [row.value for row in rows], [dict(row.by) for row in rows]

    found = enclosed_root(system, begin, balls)
    point, normal = (found[0], found[1]), (found[2], found[3])
    far = any(abs(float(x) - b) > NEARBY for x, b in zip(found, begin, strict=True))
    if far:
        raise MoreDigits
    if not locus.within(point, normal):
        return None
    change = balls.angle(*found[first:]) if turns else found[first] * size
    way = body.along or (0.0, 0.0)
    if body.about is not None:
        x, y = _less(point, _times(body.about, scale))
        way = (0.0 - y, x)
    opens = way[0] * normal[0] + way[1] * normal[1]
    return EnclosedContact(_times(point, size), normal, locus.radius(found[4]), change, opens)


def _times(v: Vector, factor: float) -> Vector:
    return v[0] * factor, v[1] * factor


def _less(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1]


def _turned(turn: Sequence[Scalar], v: Vector) -> Vector:
    c, s = turn
    return c * v[0] - s * v[1], s * v[0] + c * v[1]


class LocusFinder:
    """The pieces of a profile in balls, as its case gives them: what doubles touched, exactly."""

    def __init__(self, shape: Shape, curve: Curve, places: Mapping[str, Vector], balls: Balls) -> None:
        self.shape, self.curve, self.places, self.balls = shape, curve, places, balls
        self.size = 2.0 ** math.frexp(curve.size)[1]
        self.ends = list(self._ends())

    def locus(self, foot: Foot) -> Locus:
        """What is touched at a foot; raises MoreDigits where that is open."""
        if foot.is_corner:
            return self._corner(foot)
        piece = self.curve.pieces[foot.piece]
        if isinstance(piece, Straight):
            return self._line(self._end(piece.a), self._end(piece.b))
        return self._spline(piece, foot) if isinstance(piece, PolarPiece) else self._circle(piece, foot)

    def _ends(self) -> Iterator[Vector]:
        """The points at which pieces may begin or end [case length]."""
        if isinstance(self.shape, Polygon):
            yield from (self.places[name] for name in self.shape.corners)
        for arc in self.shape.arcs if isinstance(self.shape, Arcs) else ():
            centre, r = self.places[arc.centre], self._radius(arc)
            for end in (arc.start, arc.stop):
                x, y = self._bearing(arc, end)
                yield centre[0] + r * x, centre[1] + r * y

    def _bearing(self, arc: Arc, end: Number | str) -> Vector:
        line: Line = end if isinstance(end, Number) else (arc.centre, end)
        return direction(line, self.places, self.balls)

    def _radius(self, arc: Arc | Circle) -> Scalar:
        if arc.radius is not None:
            return self.balls.given(arc.radius)
        assert isinstance(arc, Arc) and isinstance(arc.start, str)
        x, y = _less(self.places[arc.start], self.places[arc.centre])
        return self.balls.sqrt(x * x + y * y)

    def _end(self, at: Point) -> Vector:
        """The exact end of a piece that doubles put at a point."""
        return min(self.ends, key=lambda end: math.dist(at, (float(end[0]), float(end[1]))))

    def _corner(self, foot: Foot) -> Locus:
        """An end of a piece: the normal turns freely about it."""
        (x, y), balls = _times(self._end(foot.point), 1.0 / self.size), self.balls
        return Locus(
            lambda p, n, own: [p[0] - x, p[1] - y], None, lambda p, n: True, lambda own: balls.ball(0.0)
        )

    def _line(self, a: Vector, b: Vector) -> Locus:
        """A straight edge."""
        (ax, ay), (bx, by) = _times(a, 1.0 / self.size), _times(b, 1.0 / self.size)
        tx, ty = bx - ax, by - ay

        def within(p: Vector, n: Vector) -> bool:
            before, after = ((x - p[0]) * tx + (y - p[1]) * ty for x, y in ((ax, ay), (bx, by)))
            return at_least(0.0 - before) and at_least(after)

        def equations(p: Sequence[Derived], n: Sequence[Derived], own: Derived) -> list[Derived]:
            return [(p[0] - ax) * ty - (p[1] - ay) * tx, n[0] * tx + n[1] * ty]

        return Locus(equations, None, within, lambda own: None)

    def _circle(self, piece: CircularArc, foot: Foot) -> Locus:
        """A circle or an arc, seen from its centre (hollow: from outside)."""
        arc, side = self._arc(piece), math.copysign(1.0, piece.sweep)
        r, centre = self._radius(arc), _times(self.places[arc.centre], 1.0 / self.size)

        def within(p: Vector, n: Vector) -> bool:
            if isinstance(arc, Circle) or 0.25 < foot.u < 0.75:
                return True
            ends = [self._bearing(arc, end) for end in (arc.start, arc.stop)]
            (ax, ay), (bx, by) = ends if arc.turns == "ccw" else ends[::-1]
            x, y = n[0] * side, n[1] * side
            near_first = (foot.u < 0.5) is (piece.sweep > 0.0)
            return at_least(ax * y - ay * x if near_first else x * by - y * bx)

        def equations(p: Sequence[Derived], n: Sequence[Derived], own: Derived) -> list[Derived]:
            return [p[k] - n[k] * (r * (side / self.size)) - centre[k] for k in (0, 1)]

        return Locus(equations, None, within, lambda own: r * side)

    def _arc(self, piece: CircularArc) -> Arc | Circle:
        """The arc of the case that a piece in doubles is."""
        if isinstance(self.shape, Circle):
            return self.shape
        assert isinstance(self.shape, Arcs)
        middle, options = piece.at(0.5), {}
        for arc in self.shape.arcs:
            (ax, ay), (bx, by) = (self._bearing(arc, end) for end in (arc.start, arc.stop))
            start, stop = math.atan2(float(ay), float(ax)), math.atan2(float(by), float(bx))
            sense = 1.0 if arc.turns == "ccw" else -1.0
            sweep = (sense * (stop - start)) % TURN or TURN
            centre = (float(self.places[arc.centre][0]), float(self.places[arc.centre][1]))
            own = CircularArc(centre, float(self._radius(arc)), start, sense * sweep)
            options[math.dist(own.at(0.5), middle)] = arc
        return options[min(options)]

    def _spline(self, piece: PolarPiece, foot: Foot) -> Locus:
        """A table of radii: its own unknown is the direction from the centre, degrees ccw from its zero."""
        shape, balls, scale = self.shape, self.balls, 1.0 / self.size
        assert isinstance(shape, Radii)
        radius = exact_spline(shape.table, balls.digits)
        zx, zy = direction(shape.zero, self.places, balls)
        ox, oy = _times(self.places[shape.about], scale)
        degree = balls.pi() / 180.0

        def at(own: Scalar) -> tuple[Scalar, Scalar, Scalar]:
            value, slope, bend = _spline_at(radius, own * piece.turn)
            return value, slope * piece.turn, bend

        def equations(p: Sequence[Derived], n: Sequence[Derived], own: Derived) -> list[Derived]:
            (r, slope, bend), (c, s) = at(own.value), balls.cos_sin(own.value)
            x, y = zx * c - zy * s, zx * s + zy * c
            (k,) = own.by
            value, rate = Derived(r, {k: slope}), Derived(slope, {k: bend})
            ex, ey = Derived(x, {k: 0.0 - y * degree}), Derived(y, {k: x * degree})
            along = (ex * rate - ey * value * degree, ey * rate + ex * value * degree)
            return [
                p[0] - ex * value * scale - ox,
                p[1] - ey * value * scale - oy,
                (n[0] * along[0] + n[1] * along[1]) * scale,
            ]

        def curvature(own: Scalar) -> Scalar:
            r, slope, bend = at(own)
            slope, bend = slope / degree, bend / (degree * degree)
            square = r * r + slope * slope
            return square * balls.sqrt(square) / (square + slope * slope - r * bend)

        return Locus(equations, foot.u * 360.0, lambda p, n: True, curvature)


def at_least(value: Scalar) -> bool:
    """Whether a number is not known to be below zero."""
    return float(value) > 0.0 or type(value) is not Ball or value.holds_zero


@lru_cache(maxsize=8)
def exact_spline(table: tuple[tuple[Number, Number], ...], digits: int) -> Spline:
    """`table_spline` in balls, its angle in degrees: the same in every position of its cam."""
    balls = Balls(digits)
    rows = sorted(((angle.value % 360.0, angle, r) for angle, r in table), key=lambda row: row[0])
    angles = [balls.given(a) - 360.0 * math.floor(a.value / 360.0) for _, a, _ in rows]
    return spline(angles, [balls.given(r) for _, _, r in rows], 360.0)


def _spline_at(radius: Spline, at: Scalar) -> tuple[Scalar, Scalar, Scalar]:
    """Value and two derivatives of a spline in balls: about one of its places, of both cubics there.

    It has two continuous derivatives, and between two points its slopes lie among those of its pieces.
    """
    at = at - 360.0 * math.floor((float(at) - float(radius.places[0])) / 360.0)
    count, found = len(radius.places), []
    near = bisect_right([float(x) for x in radius.places], float(at)) - 1
    for k in (near - 1, near, near + 1):
        place = radius.places[k % count] + 360.0 * (k // count)
        if at_least(at - place) and at_least(place + radius.step(k % count) - at):
            found.append(radius.between(k % count, at - place))
    return (_hull([f[0] for f in found]), _hull([f[1] for f in found]), _hull([f[2] for f in found]))


def _hull(values: Sequence[Ball]) -> Ball:
    """A ball that holds all."""
    first = values[0]
    radius = first.radius
    for other in values[1:]:
        off = other - first
        radius = max(radius, (abs(off) + off.radius + other.radius) * UP)
    return (
        first if radius == first.radius else Ball(first.arithmetic, first.value, radius, first.size, INEXACT)
    )


def exact_number(value: Scalar, size: float, path: str) -> Number:
    """A number that the profile gives [case length, or degrees]: a ball to `KEPT` digits of a size."""
    if type(value) is not Ball:
        return Number(float(value), 0.0, path, repr(float(value)))
    return found_number(kept_digits(value, size), path)


def kept_digits(value: Scalar, size: float) -> Decimal:
    """A ball to `KEPT` digits of a size; a double as a file would name it."""
    if type(value) is not Ball:
        return Decimal(repr(float(value)))
    last = Decimal(1).scaleb(math.frexp(size)[1] * 3 // 10 - KEPT)
    return value.value.quantize(last, context=WIDE).normalize(WIDE)
