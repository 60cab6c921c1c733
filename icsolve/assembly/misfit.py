"""How far the points are from a datum, as a distance."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection

from icsolve.assembly.board import Board
from icsolve.assembly.data import CORNER, GUIDE, LENGTH, LINE, MEAN, RAY, Datum, X, Y

TOO_CLOSE = 1e-12
"""Points nearer than this (normalised) have no direction to one another."""


Misfit = tuple[float, bool]
"""A signed distance (normalised), and False where a ray points the other way."""


ROUNDING = 1e-10
"""Misfit, over the figure's size, that is rounding in the sums and not in the data."""


def size_of(board: Board, points: Collection[str]) -> float:
    """The greater side of the box about the points, normalised."""
    at = [board.points[p] for p in points]
    if not at:
        return 0.0
    xs, ys = [p[0] for p in at], [p[1] for p in at]
    return float(max(max(xs) - min(xs), max(ys) - min(ys)))


def agrees(board: Board, data: Collection[Datum], size: float) -> bool:
    """Whether the points meet data exactly, but for rounding."""
    return all(ahead and abs(off) <= ROUNDING * size for off, ahead in (misfit(board, d) for d in data))


def misfit(board: Board, datum: Datum) -> Misfit:
    """How far the points on a board are from a datum."""
    return MISFITS[datum.kind](board, datum)


def _length(board: Board, datum: Datum) -> Misfit:
    (ax, ay), (bx, by) = (board.points[p] for p in datum.points)
    return math.hypot(bx - ax, by - ay) - board.length(datum), True


def _ray(board: Board, datum: Datum) -> Misfit:
    (ax, ay), (bx, by) = (board.points[p] for p in datum.points)
    c, s = board.turn(datum)
    dx, dy = bx - ax, by - ay
    return c * dy - s * dx, c * dx + s * dy > TOO_CLOSE or math.hypot(dx, dy) <= TOO_CLOSE


def _corner(board: Board, datum: Datum) -> Misfit:
    """The angle's error, on the longer arm."""
    (ax, ay), (vx, vy), (bx, by) = (board.points[p] for p in datum.points)
    c, s = board.turn(datum)
    px, py, qx, qy = ax - vx, ay - vy, bx - vx, by - vy
    p, q = math.hypot(px, py), math.hypot(qx, qy)
    if min(p, q) <= TOO_CLOSE:
        return max(p, q), False
    tx, ty = c * px - s * py, s * px + c * py
    return (tx * qy - ty * qx) / min(p, q), tx * qx + ty * qy > 0.0


def _guide(board: Board, datum: Datum) -> Misfit:
    (x, y), (tx, ty) = (board.points[p] for p in datum.points)
    c, s = board.turn(datum)
    return c * (y - ty) - s * (x - tx), True


def _line(board: Board, datum: Datum) -> Misfit:
    (x, y), (tx, ty), (ax, ay), (bx, by) = (board.points[p] for p in datum.points)
    dx, dy = bx - ax, by - ay
    d = math.hypot(dx, dy)
    if d <= TOO_CLOSE:
        return d, False
    return (dx * (y - ty) - dy * (x - tx)) / d, True


def _mean(board: Board, datum: Datum) -> Misfit:
    (x, y), *of = (board.points[p] for p in datum.points)
    mx, my = sum(p[0] for p in of) / len(of), sum(p[1] for p in of) / len(of)
    return max(x - mx, y - my, key=abs), True


def _axis(board: Board, datum: Datum) -> Misfit:
    x, y = board.points[datum.points[0]]
    return (x if datum.kind == X else y) - board.coordinate(datum), True


MISFITS: dict[str, Callable[[Board, Datum], Misfit]] = {
    LENGTH: _length, RAY: _ray, CORNER: _corner, GUIDE: _guide, LINE: _line, MEAN: _mean, X: _axis, Y: _axis,
}  # fmt: skip
