"""How far the points are from a datum, as a distance."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from icsolve.figure.board import Board
from icsolve.figure.data import CORNER, GUIDE, LENGTH, LINE, MEAN, RAY, Datum, X, Y

TOO_CLOSE = 1e-12
"""Points nearer than this (normalised) have no direction to one another."""


class Misfit(NamedTuple):
    """``off`` is a signed distance (normalised); ``ahead`` is False where a ray points the other way."""

    off: float
    ahead: bool = True


def misfit(board: Board, datum: Datum) -> Misfit:
    """How far the points on a board are from a datum."""
    return MISFITS[datum.kind](board, datum)


def _length(board: Board, datum: Datum) -> Misfit:
    (ax, ay), (bx, by) = (board.points[p] for p in datum.points)
    return Misfit(math.hypot(bx - ax, by - ay) - board.length(datum))


def _ray(board: Board, datum: Datum) -> Misfit:
    (ax, ay), (bx, by) = (board.points[p] for p in datum.points)
    c, s = board.turn(datum)
    dx, dy = bx - ax, by - ay
    return Misfit(c * dy - s * dx, c * dx + s * dy > TOO_CLOSE or math.hypot(dx, dy) <= TOO_CLOSE)


def _corner(board: Board, datum: Datum) -> Misfit:
    """The angle's error, on the longer arm."""
    (ax, ay), (vx, vy), (bx, by) = (board.points[p] for p in datum.points)
    c, s = board.turn(datum)
    px, py, qx, qy = ax - vx, ay - vy, bx - vx, by - vy
    p, q = math.hypot(px, py), math.hypot(qx, qy)
    if min(p, q) <= TOO_CLOSE:
        return Misfit(max(p, q), ahead=False)
    tx, ty = c * px - s * py, s * px + c * py
    return Misfit((tx * qy - ty * qx) / min(p, q), tx * qx + ty * qy > 0.0)


def _guide(board: Board, datum: Datum) -> Misfit:
    (x, y), (tx, ty) = (board.points[p] for p in datum.points)
    c, s = board.turn(datum)
    return Misfit(c * (y - ty) - s * (x - tx))


def _line(board: Board, datum: Datum) -> Misfit:
    (x, y), (tx, ty), (ax, ay), (bx, by) = (board.points[p] for p in datum.points)
    dx, dy = bx - ax, by - ay
    d = math.hypot(dx, dy)
    if d <= TOO_CLOSE:
        return Misfit(d, ahead=False)
    return Misfit((dx * (y - ty) - dy * (x - tx)) / d)


def _mean(board: Board, datum: Datum) -> Misfit:
    (x, y), *of = (board.points[p] for p in datum.points)
    mx, my = sum(p[0] for p in of) / len(of), sum(p[1] for p in of) / len(of)
    return Misfit(max(x - mx, y - my, key=abs))


def _axis(board: Board, datum: Datum) -> Misfit:
    x, y = board.points[datum.points[0]]
    return Misfit((x if datum.kind == X else y) - board.coordinate(datum))


MISFITS: dict[str, Callable[[Board, Datum], Misfit]] = {
    LENGTH: _length, RAY: _ray, CORNER: _corner, GUIDE: _guide, LINE: _line, MEAN: _mean, X: _axis, Y: _axis,
}  # fmt: skip
