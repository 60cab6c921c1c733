"""The one freedom that a follower has, and the positions along it in which it touches the profile."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from icsolve.cams.curve import Curve
from icsolve.cams.pieces import TURN, Point
from icsolve.cams.shapes import Body
from icsolve.cams.touching import AT_ONE, gap_of, gaps_of
from icsolve.numbers.roots import zero_between

SAMPLES = 720
"""Positions that are looked at; touching positions nearer to each other than that may be missed."""


class Shift(NamedTuple):
    """A follower that slides along a unit direction; moved by a length."""

    along: Point

    def moved(self, body: Body, by: float) -> Body:
        """The follower after sliding."""
        x, y = body.at
        return body._replace(at=(x + by * self.along[0], y + by * self.along[1]))

    def velocity(self, at: Point) -> Point:
        """The way in which a point of the follower moves."""
        return self.along

    def reach(self, curve: Curve, body: Body) -> tuple[float, float]:
        """Lengths between which it can touch the profile."""
        along = [_dot(p, self.along) - _dot(body.at, self.along) for p, _, _ in curve.chords]
        room = body.radius + 0.01 * curve.size
        return min(along) - room, max(along) + room


class Turn(NamedTuple):
    """A follower that turns about a point; moved by an angle, rad."""

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

    def reach(self, curve: Curve, body: Body) -> tuple[float, float]:
        """A whole turn; it starts where samples do not fall on round angles."""
        return 0.001 - TURN / 2.0, 0.001 + TURN / 2.0


Freedom = Shift | Turn


class Way(NamedTuple):
    """A position in which a follower touches: how far it is moved, and on which side a face has its body.

    ``sense`` is 1 where the gap grows when it is moved on, -1 where it shrinks.
    """

    by: float
    side: float
    body: Body
    sense: float


def ways(curve: Curve, body: Body, freedom: Freedom) -> list[Way]:
    """Every position in which the follower touches the profile, along its freedom."""
    sides = (1.0, -1.0) if body.kind == "flat face" else (1.0,)
    return [way for side in sides for way in ways_on(curve, body, freedom, side)]


def outermost(curve: Curve, body: Body, freedom: Freedom, side: float, sense: float) -> Way | None:
    """Where a follower that comes from outside meets the profile first; None where it never does.

    Outside is where the gap grows along ``sense``. A follower that turns comes from the widest range of
    angles in which it is free.
    """
    found = ways_on(curve, body, freedom, side)
    outer = [way for way in found if way.sense == sense]
    if not outer:
        return None
    if isinstance(freedom, Shift):
        return max(outer, key=lambda way: sense * way.by)
    return max(outer, key=lambda way: _free(way, found))


def _free(way: Way, found: list[Way]) -> float:
    """The angle over which a turning follower is free beyond a position in which it touches."""
    beyond = [(way.sense * (other.by - way.by)) % TURN for other in found if other is not way]
    return min(beyond, default=TURN)


def ways_on(curve: Curve, body: Body, freedom: Freedom, side: float) -> list[Way]:
    """As `ways`, of a face on one side."""
    if isinstance(freedom, Shift) and body.kind == "flat face":
        return list(_face_shifted(curve, body, freedom, side))
    found = []
    for by, sense in _zeros(curve, body, freedom, side):
        found.append(Way(by, side, freedom.moved(body, by), sense))
    return found


def _zeros(curve: Curve, body: Body, freedom: Freedom, side: float) -> Iterator[tuple[float, float]]:
    """Where the gap changes its sign, and whether it grows there: a rough look at samples, then exactly."""

    def gap(by: float) -> float:
        return gap_of(curve, freedom.moved(body, by), side)[0]

    low, high = freedom.reach(curve, body)
    step = (high - low) / SAMPLES
    rough = gaps_of(curve, [freedom.moved(body, low + k * step) for k in range(SAMPLES + 1)], side)
    for k in range(SAMPLES):
        if rough[k] * rough[k + 1] <= 0.0 and rough[k] != rough[k + 1]:
            a, b = low + k * step, low + (k + 1) * step
            at_a, at_b = gap(a), gap(b)
            for _ in range(2):
                if at_a * at_b > 0.0:
                    a, b = a - step, b + step
                    at_a, at_b = gap(a), gap(b)
            if at_a * at_b <= 0.0 and at_a != at_b:
                yield zero_between(gap, a, b, at_a, at_b), math.copysign(1.0, at_b - at_a)


def _face_shifted(curve: Curve, body: Body, freedom: Shift, side: float) -> Iterator[Way]:
    """A face that slides: the gap grows evenly with the way."""
    rate = side * (body.face[0] * freedom.along[1] - body.face[1] * freedom.along[0])
    if abs(rate) > AT_ONE:
        by = -gap_of(curve, body, side)[0] / rate
        yield Way(by, side, freedom.moved(body, by), math.copysign(1.0, rate))


def _dot(a: Point, b: Point) -> float:
    return a[0] * b[0] + a[1] * b[1]
