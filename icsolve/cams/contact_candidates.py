"""The one freedom that a follower has, and the positions along it in which it touches the profile.

Where a follower touches a profile: the gap between the two, the point, the normal.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from icsolve.cams.curve import Body, Curve, Foot, dot
from icsolve.cams.pieces import TURN, Point, unit
from icsolve.numbers.roots import below_zero, zero_between
from icsolve.tuples import NamedTuple

SAMPLES = 720
"""Positions that are looked at; of touching positions nearer to each other than that, all but two may be
missed."""


class Shift(NamedTuple):
    """A follower that slides along a unit direction; moved by a length [case length]."""

    along: Point

    def moved(self, body: Body, by: float) -> Body:
        """The follower after sliding."""
        x, y = body.at
        return body._replace(at=(x + by * self.along[0], y + by * self.along[1]))

    def velocity(self, at: Point) -> Point:
        """The way in which a point of the follower moves."""
        return self.along

    def fastest(self, curve: Curve, body: Body) -> float:
        """Most by which the gap changes, over the way that the follower is moved."""
        return 1.0

    def reach(self, curve: Curve, body: Body) -> tuple[float, float]:
        """Lengths between which it can touch the profile."""
        along = [dot(p, self.along) - dot(body.at, self.along) for p, _, _ in curve.chords]
        room = body.radius + 0.01 * curve.size
        return min(along) - room, max(along) + room


class Turn(NamedTuple):
    """A follower that turns about a point [case length]; moved by an angle [rad], ccw positive."""

    about: Point

    def moved(self, body: Body, by: float) -> Body:
        """The follower after turning."""
        c, s = math.cos(by), math.sin(by)
        x, y = body.at[0] - self.about[0], body.at[1] - self.about[1]
        u, v = body.face
        at = (self.about[0] + c * x - s * y, self.about[1] + s * x + c * y)
        return body._replace(at=at, face=(c * u - s * v, s * u + c * v))

    def velocity(self, at: Point) -> Point:
        """The way in which a point of the follower moves."""
        return (self.about[1] - at[1], at[0] - self.about[0])

    def fastest(self, curve: Curve, body: Body) -> float:
        """Most by which the gap changes, over the angle by which the follower is turned [case length]."""
        own = math.dist(body.at, self.about)
        if body.kind != "flat face":
            return own
        return own + max(math.dist(p, self.about) for p, _, _ in curve.chords) + 0.01 * curve.size

    def reach(self, curve: Curve, body: Body) -> tuple[float, float]:
        """A whole turn; it starts where samples do not fall on round angles."""
        return 0.001 - TURN / 2.0, 0.001 + TURN / 2.0


Freedom = Shift | Turn


class Candidate(NamedTuple):
    """A position in which a follower touches.

    Attributes
    ----------
    by : how far it is moved [case length, or rad]
    side : of a flat face the side on which it has its body, 1 or -1
    body : the follower there
    sense : 1 where the gap grows when it is moved on, -1 where it shrinks
    """

    by: float
    side: float
    body: Body
    sense: float


def candidates(curve: Curve, body: Body, freedom: Freedom) -> list[Candidate]:
    """Every position in which the follower touches the profile, along its freedom.

    Found where the gap changes its sign between 720 places, or comes back to it between two of them, then
    closed in by Brent's method: of more than two between the same places some may be missed.
    """
    sides = (1.0, -1.0) if body.kind == "flat face" else (1.0,)
    return [way for side in sides for way in candidates_on(curve, body, freedom, side)]


def outermost(curve: Curve, body: Body, freedom: Freedom, side: float, sense: float) -> Candidate | None:
    """Where a follower that comes from outside meets the profile first; None where it never does.

    Parameters
    ----------
    side : of a flat face the side on which it has its body
    sense : outside is where the gap grows along it, 1 or -1. A follower that turns comes from the widest
        range of angles in which it is free
    """
    found = candidates_on(curve, body, freedom, side)
    outer = [way for way in found if way.sense == sense]
    if not outer:
        return None
    if isinstance(freedom, Shift):
        return max(outer, key=lambda way: sense * way.by)
    return max(outer, key=lambda way: _free(way, found))


def _free(way: Candidate, found: list[Candidate]) -> float:
    """The angle over which a turning follower is free beyond a position in which it touches."""
    beyond = [(way.sense * (other.by - way.by)) % TURN for other in found if other is not way]
    return min(beyond, default=TURN)


def candidates_on(curve: Curve, body: Body, freedom: Freedom, side: float) -> list[Candidate]:
    """As `candidates`, of a flat face with its body on one side."""
    if isinstance(freedom, Shift) and body.kind == "flat face":
        return list(_face_shifted(curve, body, freedom, side))
    found = []
    for by, sense in _zeros(curve, body, freedom, side):
        found.append(Candidate(by, side, freedom.moved(body, by), sense))
    return found


def _zeros(curve: Curve, body: Body, freedom: Freedom, side: float) -> Iterator[tuple[float, float]]:
    """Where the gap changes its sign between samples, and whether it grows there.

    As far as the gap is wide it can't close on the way: samples are left out there.
    """

    def gap(by: float) -> float:
        return gap_of(curve, freedom.moved(body, by), side)[0]

    low, high = freedom.reach(curve, body)
    step = (high - low) / SAMPLES
    most = 1.01 * freedom.fastest(curve, body) * step
    k, at_a = 0, gap(low)
    while k < SAMPLES:
        left = SAMPLES - k
        k += left if abs(at_a) >= left * most else max(int(abs(at_a) / most), 1)
        at_b = gap(low + k * step)
        if at_a * at_b < 0.0 or at_b == 0.0 != at_a:
            by = zero_between(gap, low + (k - 1) * step, low + k * step, at_a, at_b)
            yield by, math.copysign(1.0, at_b - at_a)
        elif at_a * at_b > 0.0 and abs(at_a) + abs(at_b) < most:  # so near that it may pass zero twice
            sign, ends = math.copysign(1.0, at_a), (low + (k - 1) * step, low + k * step)
            between = below_zero(lambda by, sign=sign: sign * gap(by), *ends)  # type: ignore[misc]
            if between is not None:
                at_c = gap(between)
                yield zero_between(gap, ends[0], between, at_a, at_c), -sign
                yield zero_between(gap, between, ends[1], at_c, at_b), sign
        at_a = at_b


def _face_shifted(curve: Curve, body: Body, freedom: Shift, side: float) -> Iterator[Candidate]:
    """A face that slides: the gap grows evenly with the way."""
    rate = side * (body.face[0] * freedom.along[1] - body.face[1] * freedom.along[0])
    if abs(rate) > AT_ONE:
        by = -gap_of(curve, body, side)[0] / rate
        yield Candidate(by, side, freedom.moved(body, by), math.copysign(1.0, rate))


AT_ONE = 1e-9
"""Places that are nearer than this fraction of the profile's size are one."""


class Meeting(NamedTuple):
    """A profile and a follower that touch.

    Attributes
    ----------
    gap : [case length], negative: overlap
    foot : where it is least
    normals : the unit normal from the profile into the follower; at a corner on which a knife edge stands
        two, and any between them will do
    ties : other feet that are as near to the follower as far as doubles tell, with the ways to it
    shared : what is said where these touch as well; empty where none of them seems to
    """

    gap: float
    foot: Foot
    normals: tuple[Point, ...]
    ties: tuple[tuple[Foot, Point], ...] = ()
    shared: str = ""


def gap_of(curve: Curve, body: Body, side: float) -> tuple[float, Foot]:
    """The gap between a profile and a follower [case length], negative where they overlap, and the foot.

    Parameters
    ----------
    side : that of a flat face on which it has its body, 1 or -1
    """
    if body.kind == "flat face":
        way = (-side * body.face[1], side * body.face[0])
        foot = curve.farthest(way)[0]
        x, y = body.at[0] - foot.point[0], body.at[1] - foot.point[1]
        return way[0] * x + way[1] * y, foot
    height, foot = curve.height(body.at)
    return height - body.radius, foot


def meeting_of(curve: Curve, body: Body, side: float) -> Meeting:
    """The meeting of a profile and a follower that (nearly) touch.

    Of the ties elsewhere those touch that are corners, or whose normal leads to the follower, too.
    """
    gap, foot = gap_of(curve, body, side)
    if body.kind == "flat face":
        way = (-side * body.face[1], side * body.face[0])
        first, *others = curve.farthest(way)
        reach = dot(way, first.point)
        ties = [(o, way) for o in others if abs(dot(way, o.point) - reach) <= AT_ONE * curve.size]
        return _shared(Meeting(gap, foot, (way,), tuple(ties)), curve, ALONG)
    near = math.dist(foot.point, body.at) + AT_ONE * curve.size
    own, *feet = (o for o in curve.nearest(body.at) if math.dist(o.point, body.at) <= near)
    on_corner = foot.is_corner and math.dist(foot.point, body.at) <= AT_ONE * curve.size
    if body.kind != "roller":
        toward = foot.normals if on_corner else (_toward(foot, body, gap),)
        knives = tuple((o, curve.normal(o.piece, o.u)) for o in ([own, *feet] if on_corner else feet))
        return Meeting(gap, foot, toward, knives)
    if on_corner:
        return Meeting(gap, foot, foot.normals)
    toward = (_toward(foot, body, gap + body.radius),)
    ways = tuple((o, unit(body.at[0] - o.point[0], body.at[1] - o.point[1])) for o in feet)
    return _shared(Meeting(gap, foot, toward, ways), curve, TWICE)


ALONG = (
    "the flat face lies on the profile along a line, or at two places, so no one point carries the force. "
    "Give the contact its `at` and `normal`, or take a `slide` for a block on an edge."
)
TWICE = (
    "the roller touches the profile at two places at once. Give the contact the `at` and the `normal` of the "
    "one that carries."
)


def _shared(met: Meeting, curve: Curve, said: str) -> Meeting:
    """A meeting of which it is said where its ties that lie elsewhere seem to touch as well."""
    touch = [
        foot.is_corner or abs(foot.normals[0][0] * y - foot.normals[0][1] * x) <= AT_ONE
        for foot, (x, y) in met.ties
        if math.dist(foot.point, met.foot.point) > AT_ONE * curve.size
    ]
    return met._replace(shared=said if any(touch) else "")


def _toward(foot: Foot, body: Body, height: float) -> Point:
    """The normal of a smooth place; at a corner the direction to the follower's point, so far outside."""
    if not foot.is_corner:
        return foot.normals[0]
    return ((body.at[0] - foot.point[0]) / height, (body.at[1] - foot.point[1]) / height)
