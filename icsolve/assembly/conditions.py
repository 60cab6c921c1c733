"""Each condition on points stated once: what is to vanish, and its derivative by every point.

From one statement follow the equations of Newton's method for points (`FigureEquation`) and for links
(`icsolve.assembly.driven.constraints`), and how far a finished figure is from its data
(`icsolve.assembly.residuals`). In any arithmetic; nothing branches on a value.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

from icsolve.assembly.data import CORNER, GUIDE, LENGTH, LINE, MEAN, RAY, ROPE, Datum, X, Y
from icsolve.assembly.loci import length_of
from icsolve.assembly.workspace import Workspace
from icsolve.numbers.arithmetic import Scalar
from icsolve.screws.plane import Point
from icsolve.screws.ropes import rope_parts
from icsolve.tuples import NamedTuple

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
    p, q = (workspace.points[name] for name in datum.points)
    return at_distance(p, q, workspace.length(datum))


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
    parts = rope_parts(rope, workspace.points, workspace.frame.scale, workspace.arithmetic)  # type: ignore[arg-type]
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
