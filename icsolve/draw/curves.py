"""Curves over a range: where they run off to infinity, and the pieces between gaps and asymptotes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from icsolve.draw.marks import Point

STEEP = 3.0
"""Where a curve runs off to infinity, the axis shows so many times the middle half of its values."""
WIDE_GAP = 2.5
"""Rows farther apart than so many mean steps have something unknown between them."""
EVEN = 0.4
"""Reciprocals that change so much less evenly than those at a pole belong to a jump."""
SAME = 1e-5
"""Values that differ by less, of their size, are one value: more digits than an axis shows."""


class Curve(NamedTuple):
    """Values over the range, not a number where there is none; ``unit`` stands at the axis, ``dead`` are
    known dead centres."""

    name: str
    values: Sequence[float]
    unit: str
    dead: Sequence[float] = ()


class Frame(NamedTuple):
    """Where a plot's axes are: picture units of its corners, and the values there."""

    left: float
    top: float
    right: float
    bottom: float
    x: tuple[float, float]
    y: tuple[float, float]

    def at(self, x: float, y: float) -> Point:
        """A point of a curve; one beyond the frame lies on its edge."""
        across = (x - self.x[0]) / (self.x[1] - self.x[0])
        up = min(max((y - self.y[0]) / (self.y[1] - self.y[0]), 0.0), 1.0)
        return (self.left + across * (self.right - self.left), self.bottom - up * (self.bottom - self.top))


class Row(NamedTuple):
    """A value of a curve."""

    x: float
    y: float


def rows_of(x: Sequence[float], values: Sequence[float]) -> list[Row]:
    """The rows that have a value."""
    return [Row(a, v) for a, v in zip(x, values, strict=True) if math.isfinite(v)]


def asymptotes(x: Sequence[float], values: Sequence[float], dead: Sequence[float] = ()) -> list[float]:
    """The dead centres of a curve: those known, and where it runs off to infinity and comes back.

    Between two neighbours of opposite sign lies a pole, and not a zero, where the curve grows toward it
    on both sides. Near a pole p values go as 1 / (x - p), which places it between the neighbours.
    """
    rows = rows_of(x, values)
    usual = sorted(abs(row.y) for row in rows)[len(rows) // 2] if rows else 0.0
    step = (x[-1] - x[0]) / max(len(x) - 1, 1)
    places = list(dead)
    for n in range(len(rows) - 1):
        a, b = rows[n], rows[n + 1]
        if b.x - a.x > WIDE_GAP * step or (a.y < 0.0) == (b.y < 0.0) or min(abs(a.y), abs(b.y)) <= usual:
            continue
        before, after = rows[n - 1] if n else None, rows[n + 2] if n + 2 < len(rows) else None
        known = any(a.x <= place <= b.x for place in dead)
        pace = abs(1.0 / a.y - 1.0 / b.y) / (b.x - a.x)
        if not known and _grows(a, before, usual, pace) and _grows(b, after, usual, pace):
            share = abs(b.y) / (abs(a.y) + abs(b.y))
            places.append(a.x + (b.x - a.x) * share)
    return sorted(dict.fromkeys(places))


def _grows(row: Row, behind: Row | None, usual: float, pace: float) -> bool:
    """Whether a curve grows from the row behind to this one as toward a pole; at an end: whether it is large.

    Toward a pole 1 / y goes down evenly, at ``pace``; at a jump (friction that turns round) it hardly does.
    """
    if behind is None:
        return abs(row.y) > 4.0 * usual
    if abs(row.y) <= abs(behind.y) or (row.y < 0.0) != (behind.y < 0.0):
        return False
    return abs(1.0 / behind.y - 1.0 / row.y) >= EVEN * pace * abs(row.x - behind.x)


def limits(curves: Sequence[Curve], x: Sequence[float]) -> tuple[float, float]:
    """The values that an axis shows: all; of curves that run off to infinity, what can be seen beside."""
    values = sorted(v for curve in curves for v in curve.values if math.isfinite(v))
    if not values:
        return (-1.0, 1.0)
    low, high = values[0], values[-1]
    broken = any(not math.isfinite(v) for curve in curves for v in curve.values)
    if broken or any(asymptotes(x, curve.values, curve.dead) for curve in curves):
        first, last = values[len(values) // 4], values[-1 - len(values) // 4]
        room = STEEP * ((last - first) or abs(last) or 1.0)
        low, high = max(low, first - room), min(high, last + room)
    size = max(abs(low), abs(high))
    pad = 0.06 * (high - low) if high - low > SAME * size else 0.5 * size or 1.0
    return (low - pad, high + pad)


def pieces(frame: Frame, x: Sequence[float], curve: Curve) -> Iterator[tuple[Point, ...]]:
    """The stretches of a curve between gaps and asymptotes, cut off at the frame."""
    breaks = asymptotes(x, curve.values, curve.dead)
    for stretch in _stretches(x, curve.values, breaks):
        if len(stretch) == 1 and frame.y[0] <= stretch[0].y <= frame.y[1]:
            p = frame.at(*stretch[0])
            yield ((p[0] - 0.8, p[1]), (p[0] + 0.8, p[1]))
        yield from _inside(frame, stretch)


def _stretches(
    x: Sequence[float], values: Sequence[float], breaks: Sequence[float]
) -> Iterable[list[Row]]:
    """Rows without a gap or an asymptote between them."""
    stretch: list[Row] = []
    for a, v in zip(x, values, strict=True):
        broken = bool(stretch) and any(stretch[-1].x <= place <= a for place in breaks)
        if stretch and (broken or not math.isfinite(v)):
            yield stretch
            stretch = []
        if math.isfinite(v):
            stretch.append(Row(a, v))
    if stretch:
        yield stretch


def _inside(frame: Frame, stretch: Sequence[Row]) -> Iterable[tuple[Point, ...]]:
    """The parts of a stretch between the frame's lower and upper edge."""
    chain: list[Point] = []
    for n in range(len(stretch) - 1):
        ends = _clipped(frame, stretch[n], stretch[n + 1])
        if ends is None:
            continue
        a, b = (frame.at(*end) for end in ends)
        if not chain or chain[-1] != a:
            if chain:
                yield tuple(chain)
            chain = [a]
        chain.append(b)
    if chain:
        yield tuple(chain)


def _clipped(frame: Frame, a: Row, b: Row) -> tuple[Row, Row] | None:
    """What of the line between two rows is within the frame's values; None where nothing is."""
    low, high = frame.y
    if max(a.y, b.y) < low or min(a.y, b.y) > high:
        return None
    return _pulled(a, b, low, high), _pulled(b, a, low, high)


def _pulled(row: Row, other: Row, low: float, high: float) -> Row:
    """A row, or where the line to the other one enters the limits."""
    if low <= row.y <= high:
        return row
    edge = low if row.y < low else high
    return Row(row.x + (edge - row.y) / (other.y - row.y) * (other.x - row.x), edge)
