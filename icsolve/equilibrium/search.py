"""Zeros of the power of the loads over a whole range: enclosed in intervals first, then closed in on.

The range is cut into cells. A cell on which the figure nowhere assembles, or whose enclosure of the power
does not hold zero, has no position; one on which the figure assembles and the power's derivative keeps its
sign has one at most, told by the signs at its ends; the others are halved. Nothing is missed but in cells
that stay open to the last, which are handed on.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from icsolve.equilibrium.load_function import LoadFunction
from icsolve.numbers.intervals import Interval, enclose
from icsolve.numbers.replay import Array

CELLS = 256
HALVINGS = 46
MOST_CELLS = 4096
POINTLIKE = 1e-3
"""Open cells that together take less than this fraction of the range lie about single points."""


class Found(NamedTuple):
    """Brackets with one position each; clusters of cells that stay open; what the search gave up on."""

    brackets: list[tuple[float, float]]
    open_cells: list[tuple[float, float]]
    complete: bool


def isolate(function: LoadFunction, low: float, high: float) -> Found:
    """The zeros of a mode's power from ``low`` to ``high``."""
    edges = np.linspace(low, high, CELLS + 1)
    edges[1:-1] += (high - low) / CELLS * 0.0137  # not on the round numbers where symmetric figures rest
    cells = Interval(edges[:-1].copy(), edges[1:].copy())
    brackets: list[tuple[float, float]] = []
    complete = True
    for _ in range(HALVINGS):
        cells, found = _pass(function, cells)
        brackets += found
        if not cells.low.size:
            break
        if cells.low.size > MOST_CELLS:
            complete = float(np.sum(cells.high - cells.low)) <= POINTLIKE * (high - low)
            break
        middle = 0.5 * (cells.low + cells.high)
        inside = (middle > cells.low) & (middle < cells.high)
        if not inside.any():
            break
        cells = Interval(
            np.concatenate([cells.low, middle[inside]]),
            np.concatenate([np.where(inside, middle, cells.high), cells.high[inside]]),
        )
    order = np.argsort(cells.low)
    return Found(sorted(brackets), _clusters(cells.low[order], cells.high[order]), complete)


def _pass(function: LoadFunction, cells: Interval) -> tuple[Interval, list[tuple[float, float]]]:
    """The cells that stay open, and brackets."""
    record, given = function.record, function.input
    middle = 0.5 * (cells.low + cells.high)
    wanted = [function.power, function.slope, *function.margins]
    value, slope, *margins = enclose(record, wanted, {given: cells})
    shape = cells.low.shape
    apart, whole = np.zeros(shape, dtype=bool), np.ones(shape, dtype=bool)
    for margin in margins:
        apart |= np.broadcast_to(margin.high < 0.0, shape)
        whole &= np.broadcast_to(margin.low > 0.0, shape)
    (centre,) = enclose(record, [function.power], {given: Interval(middle, middle)})
    with np.errstate(all="ignore"):
        half = np.nextafter(0.5 * (cells.high - cells.low), np.inf) * (1.0 + 1e-15)
        reach = half * np.maximum(np.abs(slope.low), np.abs(slope.high))
        reach = np.where(np.isnan(reach), np.inf, reach)
        low = np.maximum(value.low, np.where(whole, np.nextafter(centre.low - reach, -np.inf), -np.inf))
        high = np.minimum(value.high, np.where(whole, np.nextafter(centre.high + reach, np.inf), np.inf))
    possible = ~apart & ~(low > 0.0) & ~(high < 0.0)
    steady = whole & np.broadcast_to((slope.low > 0.0) | (slope.high < 0.0), shape)
    at_low = _signs(function, cells.low)
    at_high = _signs(function, cells.high)
    decided = possible & steady & (at_low != 0) & (at_high != 0)
    crossing = decided & (at_low != at_high)
    found = list(zip(cells.low[crossing].tolist(), cells.high[crossing].tolist(), strict=True))
    left = possible & ~decided
    return Interval(cells.low[left], cells.high[left]), found


def _signs(function: LoadFunction, at: Array) -> Array:
    """Signs of the power; 0 where rounding leaves them open."""
    (value,) = enclose(function.record, [function.power], {function.input: Interval(at, at)})
    signs = np.where(value.low > 0.0, 1, np.where(value.high < 0.0, -1, 0))
    return np.broadcast_to(signs, at.shape)


def _clusters(low: Array, high: Array) -> list[tuple[float, float]]:
    """Cells that touch, as one."""
    found: list[tuple[float, float]] = []
    for a, b in zip(low.tolist(), high.tolist(), strict=True):
        if found and a <= found[-1][1]:
            found[-1] = (found[-1][0], max(b, found[-1][1]))
        else:
            found.append((a, b))
    return found
