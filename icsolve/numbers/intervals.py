"""A record run on intervals: enclosures of its values over whole ranges of its inputs, many ranges at once.

Every operation rounds outward by an ulp or more, so that an enclosure holds all values that exact arithmetic
takes over the range (R. E. Moore, R. B. Kearfott and M. J. Cloud, Introduction to Interval Analysis, 2009).
A quotient by what may be zero is unbounded; of a radicand its part that is not negative counts, and where
there is none the root is 0: whoever asks whether a figure exists asks the radicands.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from icsolve.numbers.record import Op, Record, live, operands
from icsolve.numbers.replay import Array
from icsolve.tuples import NamedTuple

TURN_ULPS = 6
"""Ulps by which a sine or cosine of an angle in degrees is widened: its reduction and its own rounding."""


class Interval(NamedTuple):
    """Lower and upper ends, arrays of one shape (n,)."""

    low: Array
    high: Array


def enclose(record: Record, wanted: Sequence[int], given: Mapping[int, Interval]) -> list[Interval]:
    """Enclosures of the wanted nodes for intervals of the inputs.

    Parameters
    ----------
    record : the record
    wanted : indices of nodes
    given : by node, an interval with ends of shape (n,), the same n for all; degrees for angles

    Returns
    -------
    list[Interval]
        Ends of shape (n,); () where nothing that is given leads to the node. Constants are widened by their
        noise; an input that is not given keeps the value with which it was recorded.
    """
    nodes = record.nodes
    found: dict[int, Interval] = dict(given)
    with np.errstate(all="ignore"):
        for k in live(record, wanted, given):
            if k in found:
                continue
            node = nodes[k]
            if node.op == Op.INPUT:
                found[k] = Interval(np.array(node.value), np.array(node.value))
                continue
            if node.op in (Op.COS, Op.SIN):
                cosine = k if node.op == Op.COS else node.b
                found[cosine], found[cosine + 1] = _turned(_of(record, node.a, found))
                continue
            parts = [_of(record, n, found) for n in operands(record, k)]
            found[k] = _run(node.op, parts, node.a == node.b)
    return [_of(record, k, found) for k in wanted]


def _of(record: Record, k: int, found: Mapping[int, Interval]) -> Interval:
    if k in found:
        return found[k]
    value, noise = np.array(record.nodes[k].value), _still(record, k)
    return _out(value - noise, value + noise) if noise else Interval(value, value)


def _still(record: Record, k: int) -> float:
    """A bound of the error of a value that is the same in every row."""
    from icsolve.numbers.adjoint import still_noise

    return 2.0 * still_noise(record, k)


def _out(low: Array, high: Array) -> Interval:
    """Rounded outward by an ulp; what is no number is unbounded."""
    low, high = np.nextafter(low, -np.inf), np.nextafter(high, np.inf)
    return Interval(np.where(np.isnan(low), -np.inf, low), np.where(np.isnan(high), np.inf, high))


def _run(op: Op, parts: Sequence[Interval], same: bool) -> Interval:
    a, b = parts[0], parts[-1]
    match op:
        case Op.ADD:
            return _out(a.low + b.low, a.high + b.high)
        case Op.SUB:
            return _out(a.low - b.high, a.high - b.low)
        case Op.MUL:
            return _square(a) if same else _product(a, b)
        case Op.DIV:
            return _quotient(a, b)
        case Op.NEG:
            return Interval(-a.high, -a.low)
        case Op.SQRT:
            low = np.sqrt(np.maximum(a.low, 0.0))
            wide = _out(low, np.sqrt(np.maximum(a.high, 0.0)))
            return Interval(np.maximum(wide.low, 0.0), wide.high)
        case Op.ANGLE:
            return _angle(a, b)
        case Op.NEAREST:
            return Interval(np.rint(a.low), np.rint(a.high))
    raise TypeError(op.name)


def _square(a: Interval) -> Interval:
    one, two = a.low * a.low, a.high * a.high
    low = np.where((a.low <= 0.0) & (a.high >= 0.0), 0.0, np.minimum(one, two))
    wide = _out(low, np.maximum(one, two))
    return Interval(np.maximum(wide.low, 0.0), wide.high)


def _product(a: Interval, b: Interval) -> Interval:
    products = (a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high)
    ends = [np.where(np.isnan(end), 0.0, end) for end in products]  # zero times what has no bound
    low, high = np.minimum(ends[0], ends[1]), np.maximum(ends[0], ends[1])
    return _out(np.minimum(low, np.minimum(ends[2], ends[3])), np.maximum(high, np.maximum(ends[2], ends[3])))


def _quotient(a: Interval, b: Interval) -> Interval:
    through = (b.low <= 0.0) & (b.high >= 0.0)
    found = _product(a, _out(1.0 / b.high, 1.0 / b.low))
    return Interval(np.where(through, -np.inf, found.low), np.where(through, np.inf, found.high))


def _turned(a: Interval) -> tuple[Interval, Interval]:
    """Cosine and sine of angles in degrees."""
    low, high = np.broadcast_arrays(a.low, a.high)
    return _wave(low, high, 0.0), _wave(low, high, 90.0)


def _wave(low: Array, high: Array, crest: float) -> Interval:
    """Cosine of an angle less ``crest`` degrees: 1 at whole turns from the crest, -1 halfway between."""
    ends = [np.cos(np.radians(np.remainder(x, 360.0) - crest)) for x in (low, high)]
    slack = TURN_ULPS * 2.0**-53
    least, most = np.minimum(*ends) - slack, np.maximum(*ends) + slack

    def passes(at: float) -> Array:
        return np.asarray(np.floor((high - at) / 360.0 + 1e-12) >= np.ceil((low - at) / 360.0 - 1e-12))

    most = np.where(passes(crest), 1.0, np.minimum(most, 1.0))
    least = np.where(passes(crest + 180.0), -1.0, np.maximum(least, -1.0))
    return Interval(least, most)


def _angle(x: Interval, y: Interval) -> Interval:
    """Directions of vectors in degrees, but for whole turns; all of one where the box holds the origin."""
    both_sides = (x.low <= 0.0) & (y.low <= 0.0) & (y.high >= 0.0)
    corners = [np.degrees(np.arctan2(b, a)) for a in x for b in y]
    corners = [np.where(both_sides & (corner < 0.0), corner + 360.0, corner) for corner in corners]
    low, high = np.minimum.reduce(corners), np.maximum.reduce(corners)
    slack = 8.0 * 2.0**-53 * 180.0
    origin = both_sides & (x.high >= 0.0)
    return Interval(np.where(origin, -180.0, low - slack), np.where(origin, 180.0, high + slack))
