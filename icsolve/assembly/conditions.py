"""Each condition on points stated once: what is to vanish, and its derivative by every point.

From one statement follow the equations of Newton's method for points (`FigureEquation`) and for links
(`icsolve.assembly.driven.constraints`), and how far a finished figure is from its data: residuals,
redundant data, teeth that do not fit. The statements run in any arithmetic, and nothing in them branches on
a value.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

from icsolve.assembly.loci import length_of
from icsolve.assembly.workspace import (
    CORNER,
    GUIDE,
    LENGTH,
    LINE,
    MEAN,
    RAY,
    ROPE,
    Datum,
    Workspace,
    X,
    Y,
    data_of,
)
from icsolve.numbers import Scalar, decider
from icsolve.screws import Point
from icsolve.tuples import LateModule, NamedTuple

if TYPE_CHECKING:
    from icsolve.screws import ropes as rope_screws
else:
    rope_screws = LateModule("icsolve.screws.ropes")

Unknown = tuple[str, int]
"""A coordinate: the point and 0 for x, 1 for y."""


class Condition(NamedTuple):
    """A condition on some points, in their order.

    Attributes
    ----------
    value : how far it is from being met; zero at a solution [frame, or frame squared]
    pulls : (points, 2), the derivative of the value by each point
    """

    value: Scalar
    pulls: tuple[Point, ...]


def at_distance(p: Point, q: Point, distance: Scalar) -> Condition:
    """Two points are ``distance`` [frame] apart: (d^2 - l^2) / 2 [frame squared]."""
    x, y = q[0] - p[0], q[1] - p[1]
    return Condition((x * x + y * y - distance * distance) * 0.5, ((-x, -y), (x, y)))


def on_line(p: Point, through: Point, along: Point, offset: Scalar = 0.0) -> Condition:
    """A point lies ``offset`` [frame] to the left of the line through another along a unit vector that stays
    as it is."""
    c, s = along
    value = c * (p[1] - through[1]) - s * (p[0] - through[0])
    return Condition(value - offset, ((-s, c), (s, -c)))


def _length(workspace: Workspace, datum: Datum, part: int) -> Condition:
    p, q = datum.points
    return at_distance(workspace.points[p], workspace.points[q], workspace.length(datum))


def _along(workspace: Workspace, datum: Datum, part: int) -> Condition:
    """The second point lies along a known direction from the first, or against it."""
    p, q = (workspace.points[name] for name in datum.points)
    value, (second, first) = on_line(q, p, workspace.turn(datum))
    return Condition(value, (first, second))


def _corner(workspace: Workspace, datum: Datum, part: int) -> Condition:
    """The first arm, turned by the angle, lies along the second."""
    (ax, ay), (vx, vy), (bx, by) = (workspace.points[p] for p in datum.points)
    c, s = workspace.turn(datum)
    px, py, qx, qy = ax - vx, ay - vy, bx - vx, by - vy
    tx, ty = c * px - s * py, s * px + c * py
    dax, day = c * qy - s * qx, -s * qy - c * qx
    return Condition(tx * qy - ty * qx, ((dax, day), (ty - dax, -tx - day), (-ty, tx)))


def _line(workspace: Workspace, datum: Datum, part: int) -> Condition:
    """From through to at is parallel to from e1 to e2."""
    (x, y), (tx, ty), (ax, ay), (bx, by) = (workspace.points[p] for p in datum.points)
    dx, dy, wx, wy = bx - ax, by - ay, x - tx, y - ty
    return Condition(dx * wy - dy * wx, ((-dy, dx), (dy, -dx), (-wy, wx), (wy, -wx)))


def _mean(workspace: Workspace, datum: Datum, part: int) -> Condition:
    """n times a coordinate of the centroid less the sum of the points'."""
    whole, *of = datum.points
    n = float(len(of))
    value = n * workspace.points[whole][part]
    for p in of:
        value = value - workspace.points[p][part]
    return Condition(value, ((n, n), *((-1.0, -1.0) for _ in of)))


def _rope(workspace: Workspace, datum: Datum, part: int) -> Condition:
    """The rope's length less the given one; its pull at each place is the derivative by it."""
    rope = workspace.case.ropes[datum.ref]  # type: ignore[index]
    parts = rope_screws.rope_parts(rope, workspace.points, workspace.frame.scale, workspace.arithmetic)  # type: ignore[arg-type]
    aways = [(0.0, 0.0), *(each.along for each in parts), (0.0, 0.0)]
    pulls = tuple((before[0] - after[0], before[1] - after[1]) for before, after in pairwise(aways))
    return Condition(length_of(workspace, datum) - workspace.length(datum), pulls)


def _axis(workspace: Workspace, datum: Datum, part: int) -> Condition:
    at = workspace.points[datum.points[0]]
    return Condition(at[0 if datum.kind == X else 1] - workspace.coordinate(datum), ((1.0, 1.0),))


CONDITIONS: dict[str, Callable[[Workspace, Datum, int], Condition]] = {
    LENGTH: _length, RAY: _along, GUIDE: _along, CORNER: _corner,
    LINE: _line, MEAN: _mean, X: _axis, Y: _axis, ROPE: _rope,
}  # fmt: skip


def parts_of(datum: Datum) -> tuple[int, ...]:
    """The coordinates in which it is a condition of its own: of a centroid both."""
    return (0, 1) if datum.kind == MEAN else (0,)


class JacobianRow(NamedTuple):
    """An equation at the points on a workspace: its value as of `Condition`, and its derivatives by the
    coordinates that bear on it."""

    value: Scalar
    by: dict[Unknown, Scalar]


class FigureEquation(NamedTuple):
    """A datum, or one coordinate of a centroid."""

    datum: Datum
    part: int = 0

    def unknowns(self) -> list[Unknown]:
        """The coordinates that bear on it."""
        return [(p, axis) for p in dict.fromkeys(self.datum.points) for axis in self._axes()]

    def _axes(self) -> tuple[int, ...]:
        kind = self.datum.kind
        return (self.part,) if kind == MEAN else (0,) if kind == X else (1,) if kind == Y else (0, 1)

    def at(self, workspace: Workspace) -> Condition:
        """The condition at the points on a workspace."""
        return CONDITIONS[self.datum.kind](workspace, self.datum, self.part)

    def row(self, workspace: Workspace) -> JacobianRow:
        """Value and derivatives at the points on a workspace; points may repeat."""
        value, pulls = self.at(workspace)
        by: dict[Unknown, Scalar] = {}
        for p, pull in zip(self.datum.points, pulls, strict=True):
            for axis in self._axes():
                by[p, axis] = by[p, axis] + pull[axis] if (p, axis) in by else pull[axis]
        return JacobianRow(value, by)


IN_LINE = "in line"


class InLine(NamedTuple):
    """A coordinate of the point that three lengths put in line with two others, as these put it.

    With the lengths themselves the equations are singular wherever that flat triangle lies. ``along`` leads
    from ``p`` to the point, ``whole`` from ``p`` to ``q``; ``sense`` is -1 where it lies beyond ``p``, and
    ``rest`` is the third length.
    """

    point: str
    p: str
    q: str
    along: Datum
    whole: Datum
    rest: Datum
    sense: float
    part: int

    @property
    def datum(self) -> Datum:
        """The points and the kind."""
        return Datum(IN_LINE, self.part, (self.p, self.point, self.q))

    def row(self, workspace: Workspace) -> JacobianRow:
        """Value and derivatives at the points on a workspace."""
        k, points = self.part, workspace.points
        whole, along = workspace.length(self.whole), self.sense * workspace.length(self.along)
        x, p, q = points[self.point][k], points[self.p][k], points[self.q][k]
        value = whole * (x - p) - along * (q - p)
        return JacobianRow(value, {(self.point, k): whole, (self.p, k): along - whole, (self.q, k): -along})


TOO_CLOSE = 1e-12
"""Points nearer than this (normalised) have no direction to one another that doubles tell."""
NEAR = 1e-6
"""Of points nearer than this (normalised) it is looked at in more digits."""


Residual = tuple[float, bool]
"""A signed distance (normalised), and False where a ray points the other way."""
Scale = tuple[float, bool | None]
"""What the condition of a datum is divided by to be a distance, and whether its ray points ahead; None where
points that are one have no direction, with how far the others are."""


ROUNDING = 1e-10
"""Residual, over the figure's size, that is rounding in the sums and not in the data."""


def size_of(workspace: Workspace, points: Collection[str]) -> float:
    """The greater side of the box about the points, normalised."""
    at = [workspace.points[p] for p in points]
    if not at:
        return 0.0
    xs, ys = [p[0] for p in at], [p[1] for p in at]
    return float(max(max(xs) - min(xs), max(ys) - min(ys)))


def agrees(workspace: Workspace, data: Collection[Datum], size: float) -> bool:
    """Whether the points meet data exactly, but for rounding."""
    return all(ahead and abs(off) <= ROUNDING * size for off, ahead in (residual(workspace, d) for d in data))


def residual(workspace: Workspace, datum: Datum) -> Residual:
    """How far the points on a workspace are from a datum: a signed distance [frame], of an angle its error on
    the longer arm; and False where a ray points the other way, or has no direction.
    """
    size, ahead = scale_of(workspace, datum)
    if ahead is None:
        return size, False
    offs = (CONDITIONS[datum.kind](workspace, datum, part).value for part in parts_of(datum))
    return float(max(offs, key=abs)) / (size or 1.0), ahead


def ahead(workspace: Workspace, datum: Datum) -> Scalar:
    """How far a ray, or the far arm of a corner, goes the way of its angle: negative where it points against
    it [frame, of a corner frame squared]."""
    return ahead_of([workspace.points[p] for p in datum.points], workspace.turn(datum))


def ahead_of(at: Sequence[Point], turn: Point) -> Scalar:
    """The same of the places of its points, and the cosine and sine of its angle."""
    (ax, ay), *vertex, (bx, by) = at
    c, s = turn
    if not vertex:
        return c * (bx - ax) + s * (by - ay)
    ((vx, vy),) = vertex
    px, py, qx, qy = ax - vx, ay - vy, bx - vx, by - vy
    return (c * px - s * py) * qx + (s * px + c * py) * qy


def scale_of(workspace: Workspace, datum: Datum) -> Scale:
    """What the condition of a datum is divided by where the points are."""
    at, kind = [workspace.points[p] for p in datum.points], datum.kind
    if kind == MEAN:
        return float(len(at) - 1), True
    if kind == LENGTH:  # (d^2 - l^2) / 2 is d - l times their mean
        return (math.dist(*at) + workspace.length(datum)) / 2.0, True
    if kind == RAY:
        return 1.0, bool(ahead(workspace, datum) > TOO_CLOSE or math.dist(*at) <= TOO_CLOSE)
    if kind == CORNER:  # the angle's error, on the longer arm
        arms = [(x - at[1][0], y - at[1][1]) for x, y in (at[0], at[2])]
        p, q = (math.hypot(*map(float, arm)) for arm in arms)
        if none := [
            end for end, arm in zip(datum.points[::2], arms, strict=True) if _is_none(workspace, arm)
        ]:
            sure = decider(workspace.arithmetic) and all(
                _is_told(workspace, {p, datum.points[1]}) for p in none
            )
            return max(p, q), True if sure else None
        return min(p, q), bool(ahead(workspace, datum) > 0.0)
    if kind == LINE:
        (ax, ay), (bx, by) = at[2:]
        return math.hypot(float(bx - ax), float(by - ay)), None if _is_none(
            workspace, (bx - ax, by - ay)
        ) else True
    return 1.0, True


def is_vague(workspace: Workspace, datum: Datum) -> bool:
    """Whether doubles leave open what the points make of a datum: it goes by the direction between two of
    them that lie near to each other."""
    if datum.kind not in (CORNER, LINE):
        return False
    size, ahead = scale_of(workspace, datum)
    return ahead is None or size < NEAR


def _is_none(workspace: Workspace, arm: Point) -> bool:
    """Whether a vector has no direction: its length is zero, or doubles do not tell.

    Raises MoreDigits where balls leave it open.
    """
    vanishes = decider(workspace.arithmetic)
    return all(vanishes(part, 1.0) for part in arm) if vanishes else math.hypot(*arm) <= TOO_CLOSE


def _is_told(workspace: Workspace, points: set[str]) -> bool:
    """Whether the distance of two points is a datum: an arm that is given as zero may have any angle."""
    return any(d.kind == LENGTH and {*d.points} == points for d in data_of(workspace.case))
