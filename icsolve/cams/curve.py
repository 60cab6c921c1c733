"""A profile in one position: exact pieces run ccw, and chords of them for a rough look.

Profiles and followers where the figure puts them, in case units.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache

from icsolve.cams.pieces import TURN, CircularArc, Piece, Point, PolarPiece, Spline, Straight, spline, unit
from icsolve.case import Number
from icsolve.case.profiles import (
    Arc,
    Arcs,
    Circle,
    Flat,
    Follower,
    Knife,
    Line,
    Polygon,
    Radii,
    Roller,
    Shape,
)
from icsolve.errors import SceneError, Status
from icsolve.numbers import turn_of
from icsolve.tuples import NamedTuple

CORNER = 1e-9
"""Pieces whose tangents differ by less (sine) meet smoothly."""
MEETING = 1e-9
"""Ends that are nearer than this fraction of the profile's size are one point."""


class Foot(NamedTuple):
    """A point of a profile.

    Attributes
    ----------
    point : (x, y) [case length]
    piece, u : on which piece it lies, and where there
    normals : the outward unit normal where the profile is smooth; at a corner those of both pieces, before
        and after
    """

    point: Point
    piece: int
    u: float
    normals: tuple[Point, ...]

    @property
    def is_corner(self) -> bool:
        """Whether the profile has a corner there."""
        return len(self.normals) > 1

    @property
    def is_convex(self) -> bool:
        """Whether the profile turns left at the corner: then its normals spread outward."""
        (ax, ay), (bx, by) = self.normals[0], self.normals[-1]
        return ax * by - ay * bx >= 0.0


Chord = tuple[Point, int, float]


class Block(NamedTuple):
    """Chords that begin within ``reach`` of a point [case length]."""

    middle: Point
    reach: float
    chords: tuple[Chord, ...]


class Curve(NamedTuple):
    """A closed profile, run ccw.

    Attributes
    ----------
    pieces : in order
    size : diagonal of the box about it [case length]
    chords : start, piece and u (of their middles) of straight lines along it
    blocks : of a curve of one polar piece its chords by blocks, by which the nearest is found
    """

    pieces: tuple[Piece, ...]
    size: float
    chords: tuple[Chord, ...]
    blocks: tuple[Block, ...]

    def foot(self, piece: int, u: float) -> Foot:
        """A point of a piece with its normals; an end that is a corner has two."""
        at = self.pieces[piece].at(u)
        own = self.normal(piece, u)
        if isinstance(self.pieces[piece], PolarPiece) or 0.0 < u < 1.0:
            return Foot(at, piece, u, (own,))
        other = (piece - 1 if u <= 0.0 else piece + 1) % len(self.pieces)
        beside = self.normal(other, 1.0 if u <= 0.0 else 0.0)
        if abs(own[0] * beside[1] - own[1] * beside[0]) < CORNER and dot(own, beside) > 0.0:
            return Foot(at, piece, u, (own,))
        return Foot(at, piece, u, (beside, own) if u <= 0.0 else (own, beside))

    def normal(self, piece: int, u: float) -> Point:
        """Outward unit normal of a piece."""
        tx, ty = self.pieces[piece].tangent(u)
        return (ty, -tx)

    def radius_at(self, foot: Foot) -> float | None:
        """Radius of curvature at a foot [case length]: 0 at a corner, negative where hollow, None where
        straight.
        """
        return 0.0 if foot.is_corner else self.pieces[foot.piece].radius_at(foot.u)

    def nearest(self, p: Point) -> list[Foot]:
        """The feet of a point on all pieces, nearest first."""
        near = self._chord_near(p) if self.blocks else 0.5
        feet = [self.foot(n, piece.nearest(p, near)) for n, piece in enumerate(self.pieces)]
        return sorted(feet, key=lambda foot: math.dist(foot.point, p))

    def _chord_near(self, p: Point) -> float:
        """Where the chord lies whose start is nearest to a point; a block that is farther off than the best
        so far and its own reach has none."""
        best, u = math.inf, 0.5
        for apart, block in sorted((math.dist(block.middle, p), block) for block in self.blocks):
            if apart - block.reach < best:
                near, _, at = min((math.dist(q, p), n, at) for q, n, at in block.chords)
                best, u = (near, at) if near < best else (best, u)
        return u

    def farthest(self, way: Point) -> list[Foot]:
        """Where the profile reaches farthest in a direction, and its corners that come next."""
        start = max(range(len(self.chords)), key=lambda n: dot(self.chords[n][0], way))
        begin = self.chords[start][2]
        feet = [
            self.foot(n, piece.farthest(way, begin if n == self.chords[start][1] else 0.5))
            for n, piece in enumerate(self.pieces)
        ]
        return sorted(feet, key=lambda foot: -dot(foot.point, way))

    def height(self, p: Point) -> tuple[float, Foot]:
        """How far a point lies outside the profile [case length] (negative: inside), and its nearest foot."""
        foot = self.nearest(p)[0]
        x, y = p[0] - foot.point[0], p[1] - foot.point[1]
        if not foot.is_corner:
            return x * foot.normals[0][0] + y * foot.normals[0][1], foot
        return math.copysign(math.hypot(x, y), sum(dot((x, y), normal) for normal in foot.normals)), foot


def curve_of(pieces: Sequence[Piece]) -> Curve | None:
    """The closed curve of pieces in order, joined by straight lines where ends are apart.

    Pieces in cw order are turned round. None where it crosses itself, or has fewer than three chords.
    """
    size = _size(pieces)
    joined = _joined(pieces, size)
    chords = tuple(_chords(joined))
    points = [p for p, _, _ in chords]
    if not size < math.inf or len(points) < 3 or (len(joined) > 1 and crosses_itself(points)):
        return None
    if _area(points) < 0.0:
        return curve_of([piece.reversed() for piece in reversed(joined) if not isinstance(piece, PolarPiece)])
    return Curve(joined, size, chords, tuple(_blocks(chords)) if isinstance(joined[0], PolarPiece) else ())


def crosses_itself(points: Sequence[Point]) -> bool:
    """Whether a closed line through points meets itself away from its corners; decided exactly."""
    n = len(points)
    lines = sorted(
        (min(a[0], b[0]), max(a[0], b[0]), k, a, b)
        for k, (a, b) in enumerate(zip(points, [*points[1:], points[0]], strict=True))
    )
    for place, (_, last, k, a, b) in enumerate(lines):
        for first, _, m, c, d in lines[place + 1 :]:
            if first > last:
                break
            if max(min(a[1], b[1]), min(c[1], d[1])) > min(max(a[1], b[1]), max(c[1], d[1])):
                continue
            if (k - m) % n in (1, n - 1):
                corner, (p, q) = (c, (a, d)) if b == c else (a, (b, c))
                if not _turn(p, corner, q) and dot(_from(corner, p), _from(corner, q)) > 0.0:
                    return True
            elif _turn(a, b, c) * _turn(a, b, d) <= 0 and _turn(c, d, a) * _turn(c, d, b) <= 0:
                return True
    return False


def _turn(a: Point, b: Point, c: Point) -> int:
    """1 where c lies left of the line from a to b, -1 right of it, 0 on it."""
    left, right = (b[0] - a[0]) * (c[1] - a[1]), (b[1] - a[1]) * (c[0] - a[0])
    if abs(left - right) > ROUNDING * (abs(left) + abs(right)):
        return 1 if left > right else -1
    from fractions import Fraction

    (ax, ay), (bx, by), (cx, cy) = (map(Fraction, p) for p in (a, b, c))
    exact = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return (exact > 0) - (exact < 0)


ROUNDING = 2.0**-50
"""Of the difference of two products of differences, over their sizes: more than it can be."""


def _from(a: Point, b: Point) -> Point:
    return b[0] - a[0], b[1] - a[1]


def _size(pieces: Sequence[Piece]) -> float:
    ends = [piece.at(u) for piece in pieces for u in (0.0, 0.25, 0.5, 0.75, 1.0)]
    xs, ys = [x for x, _ in ends], [y for _, y in ends]
    return math.hypot(max(xs) - min(xs), max(ys) - min(ys))


def _joined(pieces: Sequence[Piece], size: float) -> tuple[Piece, ...]:
    """Pieces with a straight line wherever one ends away from the start of the next."""
    found: list[Piece] = []
    for n, piece in enumerate(pieces):
        found.append(piece)
        end, start = piece.at(1.0), pieces[(n + 1) % len(pieces)].at(0.0)
        if math.dist(end, start) > MEETING * size:
            found.append(Straight(end, start))
    return tuple(found)


def _chords(pieces: Sequence[Piece]) -> Iterator[Chord]:
    for n, piece in enumerate(pieces):
        count = piece.chords()
        polar = list(piece.along()) if isinstance(piece, PolarPiece) else None
        for k in range(count):
            yield polar[k] if polar else piece.at(k / count), n, (k + 0.5) / count


BLOCK = 24
"""Chords of a block: about the root of their number."""


def _blocks(chords: Sequence[Chord]) -> Iterator[Block]:
    for first in range(0, len(chords), BLOCK):
        some = tuple(chords[first : first + BLOCK])
        middle = some[len(some) // 2][0]
        yield Block(middle, max(math.dist(middle, p) for p, _, _ in some), some)


def _area(points: Sequence[Point]) -> float:
    """Twice the area, positive ccw."""
    x, y = points[0]
    both = zip(points, [*points[1:], points[0]], strict=True)
    return math.fsum((a - x) * (d - y) - (c - x) * (b - y) for (a, b), (c, d) in both)


def dot(a: Point, b: Point) -> float:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1]


Places = Mapping[str, Point]
AGREE = 2e-3
"""Two radii of one arc may differ by this fraction."""


class Body(NamedTuple):
    """A follower in one position.

    Attributes
    ----------
    kind : ``knife edge``, ``roller`` or ``flat face``
    at : its point [case length]
    radius : of its roller
    face : unit direction of its face
    """

    kind: str
    at: Point
    radius: float = 0.0
    face: Point = (0.0, 0.0)


def body_of(follower: Follower, places: Places, what: str) -> Body:
    """A follower where it is.

    Raises SceneError where its face has no direction.
    """
    match follower:
        case Knife(at):
            return Body("knife edge", places[at])
        case Roller(at, radius):
            return Body("roller", places[at], radius.value)
        case Flat(at, along):
            return Body("flat face", places[at], 0.0, direction(along, places, f"the face of {what}"))


def direction(line: Line, places: Places, what: str) -> Point:
    """Unit vector of a direction in degrees, or from one point to another.

    Raises SceneError where the points lie at one place.
    """
    if isinstance(line, Number):
        return turn_of(line.value)
    (ax, ay), (bx, by) = places[line[0]], places[line[1]]
    if (ax, ay) == (bx, by):
        raise SceneError(
            Status.INCONSISTENT,
            f"{what} has no direction: {line[0]} and {line[1]} lie at one place. Give it by an angle, or "
            "correct the points.",
        )
    return unit(bx - ax, by - ay)


def placed(shape: Shape, places: Places, what: str) -> Curve:
    """A profile as a curve.

    Raises SceneError where it crosses itself, or is of no size.
    """
    pieces = pieces_of(shape, places, what)
    flat = all(isinstance(piece, Straight) and piece.a == piece.b for piece in pieces)
    curve = None if flat else curve_of([p for p in pieces if not isinstance(p, Straight) or p.a != p.b])
    if curve is None:
        raise SceneError(
            Status.INCONSISTENT,
            f"{what} crosses itself, or encloses nothing: it should be one closed line around its inside. "
            "Correct the order of its corners or arcs, or its radii.",
        )
    return curve


def pieces_of(shape: Shape, places: Places, what: str) -> list[Piece]:
    """The exact pieces of a profile, in the order of the case."""
    match shape:
        case Polygon(corners):
            ends = [places[corner] for corner in corners]
            return [Straight(a, b) for a, b in zip(ends, [*ends[1:], ends[0]], strict=True)]
        case Circle(centre, radius):
            return [CircularArc(places[centre], radius.value, 0.0, TURN)]
        case Arcs(arcs):
            return [_bow(arc, places, what) for arc in arcs]
        case Radii():
            return [_polar(shape, places, what)]


def _bow(arc: Arc, places: Places, what: str) -> CircularArc:
    centre = places[arc.centre]
    start, stop = (_bearing(end, arc, places, what) for end in (arc.start, arc.stop))
    sweep = (stop - start) % TURN if arc.turns == "ccw" else -((start - stop) % TURN)
    radii = [math.dist(centre, places[end]) for end in (arc.start, arc.stop) if isinstance(end, str)]
    radius = arc.radius.value if arc.radius is not None else radii[0]
    if arc.radius is None and any(abs(other - radius) > AGREE * radius for other in radii):
        raise SceneError(
            Status.INCONSISTENT,
            f"the arc about {arc.centre} of {what} begins {radii[0]:.6g} and ends {radii[-1]:.6g} from its "
            "centre. Correct a point, or give the `radius`.",
        )
    return CircularArc(centre, radius, start, sweep or math.copysign(TURN, sweep))


def _bearing(end: Number | str, arc: Arc, places: Places, what: str) -> float:
    """The direction from the centre of an arc to its end, rad."""
    if isinstance(end, Number):
        return math.radians(end.value)
    x, y = direction((arc.centre, end), places, f"an end of the arc about {arc.centre} of {what}")
    return math.atan2(y, x)


def _polar(shape: Radii, places: Places, what: str) -> PolarPiece:
    x, y = direction(shape.zero, places, f"the zero of {what}")
    turn = 1.0 if shape.turns == "ccw" else -1.0
    radius = table_spline(tuple((angle.value, r.value) for angle, r in shape.table))
    if not _is_positive(radius):
        raise SceneError(
            Status.INCONSISTENT,
            f"{what} crosses itself: between its values the spline through its radii falls to zero. Give "
            "more of them.",
        )
    return PolarPiece(places[shape.about], math.atan2(y, x), turn, radius)


@lru_cache(maxsize=32)
def _is_positive(radius: Spline) -> bool:
    """Whether a radius is above zero at every half degree."""
    return all(radius.at(math.radians(0.5 * k))[0] > 0.0 for k in range(720))


@lru_cache(maxsize=32)
def table_spline(table: tuple[tuple[float, float], ...]) -> Spline:
    """The periodic spline through radii [case length] by angle [degrees, in any order]; its own angle is in
    rad.
    """
    ordered = sorted((math.radians(angle) % TURN, radius) for angle, radius in table)
    return spline([angle for angle, _ in ordered], [radius for _, radius in ordered], TURN)
