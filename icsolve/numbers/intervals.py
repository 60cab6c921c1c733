"""A record run on intervals: enclosures of its values over whole ranges of its inputs, many ranges at once.

Every operation rounds outward by an ulp or more, so that an enclosure holds all values that exact arithmetic
takes over the range (R. E. Moore, R. B. Kearfott and M. J. Cloud, Introduction to Interval Analysis, 2009).
A quotient by what may be zero is unbounded; of a radicand its part that is not negative counts, and where
there is none the root is 0: whoever asks whether a figure exists asks the radicands.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache

import numpy as np

from icsolve.numbers.record import Op, Record, Traced, live
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
        Ends of shape (n,); (1,) where nothing that is given leads to the node. Constants are widened by their
        noise; an input that is not given keeps the value with which it was recorded.
    """
    nodes = record.nodes
    found = {k: np.array([-one.low, one.high]) for k, one in given.items()}
    with np.errstate(all="ignore"):
        for k in _live(record, tuple(wanted), frozenset(given)):
            if k in found:
                continue
            node = nodes[k]
            if node.op == Op.INPUT:
                found[k] = _exactly(node.value)
                continue
            if node.op in (Op.COS, Op.SIN):
                cosine = k if node.op == Op.COS else node.b
                low, high = _ends(_of(record, node.a, found))
                found[cosine], found[cosine + 1] = _wave(low, high, 0.0), _wave(low, high, 90.0)
                continue
            parts = [_of(record, n, found) for n in record.nodes[k].of]
            found[k] = _run(node.op, parts, node.a == node.b)
    return [Interval(*_ends(_of(record, k, found))) for k in wanted]


Ends = tuple[float, float]
"""Lower and upper end of one range."""
WIDENED = 2.0**-51
"""By this part of its ends, and `LEAST`, a range is widened for the roundings of an operation."""
LEAST = 1e-300
WHOLE: Ends = (-math.inf, math.inf)


def enclose_one(nodes: Sequence[Traced], wanted: int, given: Mapping[int, Ends]) -> Ends:
    """As `enclose`, of one node that varies over one range, in a tenth of the time; an angle has no bounds.

    Parameters
    ----------
    nodes : of a record; constants are as they were recorded
    wanted : index of a node
    given : by node, the ends of an input's range, for every input that leads there; degrees for angles

    Raises
    ------
    KeyError
        Where an input that leads there is not given.
    """
    found = dict(given)
    for k in live(nodes, (wanted,)):
        if k not in found:
            node = nodes[k]
            parts = [found[n] if nodes[n].row else (nodes[n].value, nodes[n].value) for n in node.of]
            low, high = _spanned(node, *parts[0], *parts[-1])
            slack = WIDENED * (abs(low) + abs(high)) + LEAST
            found[k] = (low - slack, high + slack)
    return found[wanted]


def _spanned(node: Traced, a: float, b: float, c: float, d: float) -> Ends:
    """Of one operation on (a, b) and (c, d)."""
    op = node.op
    if op == Op.MUL:
        if node.a == node.b:
            return (0.0 if a <= 0.0 <= b else min(a * a, b * b)), max(a * a, b * b)
        products = (a * c, a * d, b * c, b * d)
        return min(products), max(products)
    if op == Op.ADD:
        return a + c, b + d
    if op == Op.SUB:
        return a - d, b - c
    if op == Op.NEG:
        return -b, -a
    if op == Op.DIV and (c > 0.0 or d < 0.0):
        quotients = (a / c, a / d, b / c, b / d)
        return min(quotients), max(quotients)
    if op == Op.SQRT:
        return math.sqrt(max(a, 0.0)), math.sqrt(max(b, 0.0))
    if op in (Op.COS, Op.SIN):
        return _turning(a, b, 0.0 if op == Op.COS else 90.0)
    return WHOLE


def _turning(low: float, high: float, crest: float) -> Ends:
    """Cosine of angles less ``crest`` degrees: as `_wave`."""
    ends = [math.cos(math.radians(math.remainder(x, 360.0) - crest)) for x in (low, high)]
    first, last = math.ceil((low - crest) / 180.0 - 1e-12), math.floor((high - crest) / 180.0 + 1e-12)
    ends += [1.0 - 2.0 * (k % 2) for k in range(first, min(last, first + 1) + 1)]
    slack = TURN_ULPS * 2.0**-53
    return max(min(ends) - slack, -1.0), min(max(ends) + slack, 1.0)


# --- operations on (2, n): minus the lower ends and the upper ones, so that upward is outward -------------

SIGNS = np.array([[-1.0], [1.0]])
PRODUCTS = np.array([[[-1.0], [1.0], [1.0], [-1.0]], [[1.0], [-1.0], [-1.0], [1.0]]])
"""By which the products of ends, as they stand, become minus those of the true ends, and these."""


def _exactly(value: float) -> Array:
    return np.array([[-value], [value]])


def _ends(a: Array) -> tuple[Array, Array]:
    """The lower and the upper ends."""
    return -a[0], a[1]


def _of(record: Record, k: int, found: Mapping[int, Array]) -> Array:
    return found[k] if k in found else _still(record, k)


@lru_cache(maxsize=64)
def _live(record: Record, wanted: tuple[int, ...], given: frozenset[int]) -> tuple[int, ...]:
    return tuple(live(record.nodes, wanted, given))


@lru_cache(maxsize=4096)
def _still(record: Record, k: int) -> Array:
    """A value that is the same in every row, widened by a bound of its error."""
    from icsolve.numbers.adjoint import still_noise

    here, noise = _exactly(record.nodes[k].value), 2.0 * still_noise(record, k)
    return _out(_numbers(here + noise)) if noise else here


def _numbers(a: Array) -> Array:
    """What is no number is unbounded."""
    return np.where(np.isnan(a), np.inf, a)


MANY = 1000
"""Of as many numbers `nextafter` takes longer than four operations that widen by an ulp or two."""
ULP, LARGEST = 2.0**-52, float(np.finfo(float).max)


def _out(a: Array) -> Array:
    """Rounded outward by an ulp, or two; nothing is bounded by minus infinity."""
    if a.size < MANY:
        return np.asarray(np.nextafter(a, np.inf))
    out: Array = np.abs(a)
    out *= ULP
    out += LEAST
    out += a
    return np.asarray(np.fmax(out, -LARGEST, out=out))


def _run(op: int, parts: Sequence[Array], same: bool) -> Array:
    a, b = parts[0], parts[-1]
    match op:
        case Op.ADD:
            return _out(a + b)
        case Op.SUB:
            return _out(a + b[::-1])
        case Op.MUL:
            return _square(a) if same else _product(a, b)
        case Op.DIV:
            return _quotient(a, b)
        case Op.NEG:
            return a[::-1]
        case Op.SQRT:
            return _not_negative(_out(np.sqrt(np.maximum(a * SIGNS, 0.0)) * SIGNS))
        case Op.ANGLE:
            return _angle(_ends(a), _ends(b))
        case Op.NEAREST:
            return np.asarray(np.rint(a))
    raise TypeError(op)


def _not_negative(a: Array) -> Array:
    return np.array([np.minimum(a[0], 0.0), a[1]])


def _square(a: Array) -> Array:
    squares = a * a
    low = np.where((a >= 0.0).all(axis=0), 0.0, squares.min(axis=0))
    return _not_negative(_out(np.array([-low, squares.max(axis=0)])))


def _product(a: Array, b: Array) -> Array:
    products = a[:, None] * b
    ends = np.fmax.reduce(PRODUCTS * products.reshape(4, -1), axis=1)  # passes over 0 times what has no bound
    return _out(_numbers(ends))


def _quotient(a: Array, b: Array) -> Array:
    return np.where((b >= 0.0).all(axis=0), np.inf, _product(a, _out(-1.0 / b[::-1])))


def _wave(low: Array, high: Array, crest: float) -> Array:
    """Cosine of angles less ``crest`` degrees: 1 at whole turns from the crest, -1 halfway between."""
    ends = [np.cos(np.radians(np.remainder(x, 360.0) - crest)) for x in (low, high)]
    slack = TURN_ULPS * 2.0**-53
    least, most = np.minimum(*ends) - slack, np.maximum(*ends) + slack

    def passes(at: float) -> Array:
        return np.asarray(np.floor((high - at) / 360.0 + 1e-12) >= np.ceil((low - at) / 360.0 - 1e-12))

    most = np.where(passes(crest), 1.0, np.minimum(most, 1.0))
    least = np.where(passes(crest + 180.0), -1.0, np.maximum(least, -1.0))
    return np.array([-least, most])


def _angle(x: tuple[Array, Array], y: tuple[Array, Array]) -> Array:
    """Directions of vectors in degrees, but for whole turns; all of one where the box holds the origin."""
    both_sides = (x[0] <= 0.0) & (y[0] <= 0.0) & (y[1] >= 0.0)
    corners = [np.degrees(np.arctan2(b, a)) for a in x for b in y]
    corners = [np.where(both_sides & (corner < 0.0), corner + 360.0, corner) for corner in corners]
    low, high = np.minimum.reduce(corners), np.maximum.reduce(corners)
    slack = 8.0 * 2.0**-53 * 180.0
    origin = both_sides & (x[1] >= 0.0)
    return np.array([np.where(origin, 180.0, slack - low), np.where(origin, 180.0, high + slack)])
