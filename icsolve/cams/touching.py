"""Where a follower touches a profile: the gap between the two, the point, the normal."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from icsolve.cams.curve import Curve, Foot
from icsolve.cams.pieces import Point
from icsolve.cams.shapes import Body
from icsolve.errors import SceneError, Status

AT_ONE = 1e-9
"""Places that are nearer than this fraction of the profile's size are one."""


class Meeting(NamedTuple):
    """A gap (negative: overlap), where it is least, and the unit normal from the profile into the follower.

    At a corner on which a knife edge stands there are two normals, and any between them will do.
    """

    gap: float
    foot: Foot
    normals: tuple[Point, ...]


def gap_of(curve: Curve, body: Body, side: float) -> tuple[float, Foot]:
    """The gap between a profile and a follower; ``side`` is that of a flat face on which it has its body."""
    if body.kind == "flat face":
        way = (-side * body.face[1], side * body.face[0])
        foot = curve.farthest(way)[0]
        x, y = body.at[0] - foot.point[0], body.at[1] - foot.point[1]
        return way[0] * x + way[1] * y, foot
    height, foot = curve.height(body.at)
    return height - body.radius, foot


def gaps_of(curve: Curve, bodies: Sequence[Body], side: float) -> list[float]:
    """The gaps of a follower in several positions, roughly: between it and the chords of the profile."""
    import numpy as np
    import shapely

    at = np.array([body.at for body in bodies])
    if bodies[0].kind == "flat face":
        way = side * np.array([(-body.face[1], body.face[0]) for body in bodies])
        corners = np.array([p for p, _, _ in curve.chords])
        rough = (way * at).sum(axis=1) - (way @ corners.T).max(axis=1)
    else:
        inside = shapely.contains_xy(curve.inside, at[:, 0], at[:, 1])
        apart = shapely.distance(curve.inside.exterior, shapely.points(at))
        rough = np.where(inside, -apart, apart) - bodies[0].radius
    found: list[float] = rough.tolist()
    return found


def meeting_of(curve: Curve, body: Body, side: float, what: str) -> Meeting:
    """The meeting of a profile and a follower that (nearly) touch.

    Raises SceneError where the follower touches it at several places at once.
    """
    gap, foot = gap_of(curve, body, side)
    if body.kind == "flat face":
        way = (-side * body.face[1], side * body.face[0])
        _refuse_edge(curve, way, what)
        return Meeting(gap, foot, (way,))
    if foot.is_corner and math.dist(foot.point, body.at) <= AT_ONE * curve.size:
        return Meeting(gap, foot, foot.normals)
    if body.kind == "roller":
        _refuse_second(curve, body, foot, what)
    return Meeting(gap, foot, (_toward(foot, body),))


def _toward(foot: Foot, body: Body) -> Point:
    """The normal of a smooth place; at a corner the direction to the follower's point."""
    if not foot.is_corner:
        return foot.normals[0]
    x, y = body.at[0] - foot.point[0], body.at[1] - foot.point[1]
    length = math.hypot(x, y) * (1.0 if foot.is_convex else -1.0)
    return (x / length, y / length)


def _refuse_edge(curve: Curve, way: Point, what: str) -> None:
    """A face flat on a straight edge, or on two corners."""
    first, *others = curve.farthest(way)
    reach = way[0] * first.point[0] + way[1] * first.point[1]
    for foot in others:
        level = abs(way[0] * foot.point[0] + way[1] * foot.point[1] - reach) <= AT_ONE * curve.size
        if level and math.dist(foot.point, first.point) > AT_ONE * curve.size:
            raise SceneError(
                Status.UNSUPPORTED,
                f"{what}: the flat face lies on the profile along a line, or at two places, so no one point "
                "carries the force. Give the contact its `at` and `normal`, or take a `slide` for a block on "
                "an edge.",
            )


def _refuse_second(curve: Curve, body: Body, foot: Foot, what: str) -> None:
    """A roller in a hollow corner."""
    near = math.dist(foot.point, body.at) + AT_ONE * curve.size
    for other in curve.nearest(body.at)[1:]:
        apart = math.dist(other.point, foot.point) > AT_ONE * curve.size
        if apart and math.dist(other.point, body.at) <= near:
            raise SceneError(
                Status.UNSUPPORTED,
                f"{what}: the roller touches the profile at two places at once. Give the contact the `at` "
                "and the `normal` of the one that carries.",
            )
