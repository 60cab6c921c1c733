"""How far a link has moved from the position as written: a turning and where a point of it is."""

from __future__ import annotations

import math
from typing import NamedTuple

from icsolve.cams.curve import Foot
from icsolve.cams.lift import Freedom, Shift, Turn
from icsolve.cams.pieces import Point
from icsolve.cams.shapes import Body
from icsolve.cams.touching import Meeting


class Pose(NamedTuple):
    """``turn`` is (cos, sin) of the turning; ``written`` and ``now`` are the places of one of its points."""

    turn: Point
    written: Point
    now: Point

    def out(self, v: Point) -> Point:
        """A vector that the link carries, as it is now."""
        (c, s), (x, y) = self.turn, v
        return (c * x - s * y, s * x + c * y)

    def back(self, v: Point) -> Point:
        """A vector as the link carried it in the position as written."""
        (c, s), (x, y) = self.turn, v
        return (c * x + s * y, c * y - s * x)

    def place(self, p: Point) -> Point:
        """A point that the link carries, as it is now."""
        x, y = self.out((p[0] - self.written[0], p[1] - self.written[1]))
        return (x + self.now[0], y + self.now[1])

    def place_back(self, p: Point) -> Point:
        """Where a point is as the link sees it, in the position as written."""
        x, y = self.back((p[0] - self.now[0], p[1] - self.now[1]))
        return (x + self.written[0], y + self.written[1])

    def body_back(self, body: Body) -> Body:
        """A follower as the link sees it."""
        return body._replace(at=self.place_back(body.at), face=self.back(body.face))

    def freedom_back(self, freedom: Freedom) -> Freedom:
        """A follower's freedom as the link sees it."""
        if isinstance(freedom, Turn):
            return Turn(self.place_back(freedom.about))
        return Shift(self.back(freedom.along))

    def meeting(self, meeting: Meeting) -> Meeting:
        """A meeting that the link sees, as it is now."""
        foot = meeting.foot
        turned = Foot(self.place(foot.point), foot.piece, foot.u, tuple(map(self.out, foot.normals)))
        return Meeting(meeting.gap, turned, tuple(map(self.out, meeting.normals)))


def pose_of(written: tuple[Point, Point], now: tuple[Point, Point]) -> Pose:
    """The pose of a link by two of its points."""
    (ax, ay), (bx, by) = written
    (cx, cy), (dx, dy) = now
    ux, uy, vx, vy = bx - ax, by - ay, dx - cx, dy - cy
    c, s = ux * vx + uy * vy, ux * vy - uy * vx
    size = math.hypot(c, s)
    return Pose((c / size, s / size), written[0], now[0])
