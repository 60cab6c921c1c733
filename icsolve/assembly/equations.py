"""A datum as an equation in coordinates, with its derivatives; and the solution of linear systems.

On any number type, without a test on a value: polynomials, so that no start is a singular one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from icsolve.assembly.board import Board
from icsolve.assembly.data import CORNER, GUIDE, LENGTH, LINE, MEAN, RAY, Datum, X, Y
from icsolve.numbers.arithmetic import Scalar

Unknown = tuple[str, int]
"""A coordinate: the point and 0 for x, 1 for y."""


class Row(NamedTuple):
    """An equation at the points on a board: its value and its derivatives by the coordinates."""

    value: Scalar
    by: dict[Unknown, Scalar]


class Equation(NamedTuple):
    """A datum, or one coordinate of a centroid."""

    datum: Datum
    part: int = 0

    def unknowns(self) -> list[Unknown]:
        """The coordinates that bear on it."""
        kind, points = self.datum.kind, self.datum.points
        if kind in (X, Y):
            return [(points[0], 0 if kind == X else 1)]
        parts = (self.part,) if kind == MEAN else (0, 1)
        return [(p, part) for p in dict.fromkeys(points) for part in parts]

    def row(self, board: Board) -> Row:
        """Value and derivatives at the points on a board."""
        return ROWS[self.datum.kind](board, self)


def _sum(value: Scalar, *parts: tuple[str, Scalar, Scalar]) -> Row:
    """A row whose points may repeat."""
    by: dict[Unknown, Scalar] = {}
    for point, dx, dy in parts:
        by[point, 0] = by[point, 0] + dx if (point, 0) in by else dx
        by[point, 1] = by[point, 1] + dy if (point, 1) in by else dy
    return Row(value, by)


def _length(board: Board, equation: Equation) -> Row:
    """(d^2 - l^2) / 2."""
    a, b = equation.datum.points
    (ax, ay), (bx, by), length = board.points[a], board.points[b], board.length(equation.datum)
    dx, dy = bx - ax, by - ay
    return _sum((dx * dx + dy * dy - length * length) / 2.0, (a, -dx, -dy), (b, dx, dy))


def _along(board: Board, equation: Equation) -> Row:
    """The second point lies along a known direction from the first, or against it."""
    a, b = equation.datum.points
    (ax, ay), (bx, by), (c, s) = board.points[a], board.points[b], board.turn(equation.datum)
    return _sum(c * (by - ay) - s * (bx - ax), (a, s, -c), (b, -s, c))


def _corner(board: Board, equation: Equation) -> Row:
    """The first arm, turned by the angle, lies along the second."""
    a, v, b = equation.datum.points
    (ax, ay), (vx, vy), (bx, by) = (board.points[p] for p in equation.datum.points)
    c, s = board.turn(equation.datum)
    px, py, qx, qy = ax - vx, ay - vy, bx - vx, by - vy
    tx, ty = c * px - s * py, s * px + c * py
    dax, day = c * qy - s * qx, -s * qy - c * qx
    return _sum(tx * qy - ty * qx, (a, dax, day), (b, -ty, tx), (v, ty - dax, -tx - day))


def _line(board: Board, equation: Equation) -> Row:
    """From through to at is parallel to from e1 to e2."""
    at, through, a, b = equation.datum.points
    (x, y), (tx, ty), (ax, ay), (bx, by) = (board.points[p] for p in equation.datum.points)
    dx, dy, wx, wy = bx - ax, by - ay, x - tx, y - ty
    return _sum(dx * wy - dy * wx, (at, -dy, dx), (through, dy, -dx), (a, -wy, wx), (b, wy, -wx))


def _mean(board: Board, equation: Equation) -> Row:
    """n times a coordinate of the centroid less the sum of the points'."""
    part = equation.part
    whole, *of = equation.datum.points
    n = float(len(of))
    by: dict[Unknown, Scalar] = {(whole, part): n}
    value = n * board.points[whole][part]
    for p in of:
        value = value - board.points[p][part]
        by[p, part] = by.get((p, part), 0.0) - 1.0
    return Row(value, by)


def _axis(board: Board, equation: Equation) -> Row:
    ((point, part),) = equation.unknowns()
    return Row(board.points[point][part] - board.coordinate(equation.datum), {(point, part): 1.0})


ROWS: dict[str, Callable[[Board, Equation], Row]] = {
    LENGTH: _length, RAY: _along, GUIDE: _along, CORNER: _corner,
    LINE: _line, MEAN: _mean, X: _axis, Y: _axis,
}  # fmt: skip


class Pivot(NamedTuple):
    """An equation, and the unknown that it is solved for."""

    row: int
    unknown: Unknown


def pivots(rows: list[dict[Unknown, float]]) -> tuple[list[Pivot], float]:
    """Complete pivoting: the order of elimination, and the smallest pivot over the largest."""
    work = {i: dict(row) for i, row in enumerate(rows)}
    order: list[Pivot] = []
    sizes: list[float] = []
    while work:
        size, i, unknown = max(
            ((abs(v), i, u) for i, row in work.items() for u, v in row.items()), default=(0.0, -1, ("", 0))
        )
        if size == 0.0:
            return order, 0.0
        order.append(Pivot(i, unknown))
        sizes.append(size)
        top = work.pop(i)
        for row in work.values():
            _clear(row, top, unknown)
    return order, min(sizes) / max(sizes)


def _clear(row: dict[Unknown, Scalar], top: dict[Unknown, Scalar], unknown: Unknown) -> Scalar:
    """Take the multiple of a pivot row that clears one unknown; the multiple."""
    if unknown not in row:
        return None
    ratio = row.pop(unknown) / top[unknown]
    for u, v in top.items():
        if u != unknown:
            row[u] = row[u] - ratio * v if u in row else -(ratio * v)
    return ratio


def solved(
    rows: list[dict[Unknown, Scalar]], values: list[Scalar], order: list[Pivot]
) -> dict[Unknown, Scalar]:
    """x with rows . x = values, eliminated in a given order; unknowns without a pivot stay at zero."""
    work, right = [dict(row) for row in rows], list(values)
    for k, (i, unknown) in enumerate(order):
        for j, _ in order[k + 1 :]:
            ratio = _clear(work[j], work[i], unknown)
            if ratio is not None:
                right[j] = right[j] - ratio * right[i]
    out: dict[Unknown, Scalar] = {}
    for i, unknown in reversed(order):
        total = right[i]
        for u, v in work[i].items():
            if u in out:
                total = total - v * out[u]
        out[unknown] = total / work[i][unknown]
    return out
