"""The one freedom that the figure leaves to a follower, and the positions in which it touches the profile."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from icsolve.profile.curve import Curve
from icsolve.profile.pieces import TURN, Point
from icsolve.profile.roots import zeros
from icsolve.profile.shapes import Body
from icsolve.profile.touching import AT_ONE, gap_of

SAMPLES = 720
"""Positions that are looked at; touching positions nearer to each other than that may be missed."""


class Shift(NamedTuple):
    """A follower that slides along a unit direction; moved by a length."""

    along: Point

    def moved(self, body: Body, by: float) -> Body:
        """The follower after sliding."""
        x, y = body.at
        return body._replace(at=(x + by * self.along[0], y + by * self.along[1]))

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

    def reach(self, curve: Curve, body: Body) -> tuple[float, float]:
        """A whole turn; it starts where samples do not fall on round angles."""
        return 0.001, 0.001 + TURN


Freedom = Shift | Turn


class Way(NamedTuple):
    """A position in which a follower touches: how far it is moved, and on which side a face has its body."""

    by: float
    side: float
    body: Body


def ways(curve: Curve, body: Body, freedom: Freedom) -> list[Way]:
    """Every position in which the follower touches the profile, along its freedom."""
    found: list[Way] = []
    for way in _all_ways(curve, body, freedom):
        if not any(_same(way, other, curve) for other in found):
            found.append(way)
    return found


def _all_ways(curve: Curve, body: Body, freedom: Freedom) -> Iterator[Way]:
    low, high = freedom.reach(curve, body)
    for side in (1.0, -1.0) if body.kind == "flat face" else (1.0,):
        if isinstance(freedom, Shift) and body.kind == "flat face":
            yield from _face_shifted(curve, body, freedom, side)
            continue

        def gap(by: float, side: float = side) -> float:
            return gap_of(curve, freedom.moved(body, by), side)[0]

        for by in zeros(gap, low, high, SAMPLES):
            yield Way(by, side, freedom.moved(body, by))


def _face_shifted(curve: Curve, body: Body, freedom: Shift, side: float) -> Iterator[Way]:
    """A face that slides: the gap grows evenly with the way."""
    rate = side * (body.face[0] * freedom.along[1] - body.face[1] * freedom.along[0])
    if abs(rate) > AT_ONE:
        by = -gap_of(curve, body, side)[0] / rate
        yield Way(by, side, freedom.moved(body, by))


def _same(a: Way, b: Way, curve: Curve) -> bool:
    """Whether two ways are one: a turning face is met twice, half a turn apart, with its other side."""
    return math.dist(a.body.at, b.body.at) <= AT_ONE * curve.size and a.side == b.side


def _dot(a: Point, b: Point) -> float:
    return a[0] * b[0] + a[1] * b[1]
