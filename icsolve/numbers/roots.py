"""Zeros of a function of one number, and where what holds ends."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from decimal import Decimal, localcontext
from functools import cache
from itertools import pairwise

Function = Callable[[float], float]
MOST = 120
"""Steps at most: as many halvings leave no double between the ends, unless the zero is at 0."""
ULP = 2.0**-52
BESIDE = 1e-3
"""So near to its ends, as a part of an interval, a valley is not looked for."""


def zero_between(f: Function, a: float, b: float, at_a: float, at_b: float) -> float:
    """The zero of f between a and b, where f has the values at_a and at_b of different signs.

    R. P. Brent, Algorithms for Minimization without Derivatives, 1973, ch. 4: secants and inverse quadratics
    where they shrink the interval quickly, halvings else. f is called 120 times at most, and not at the ends;
    its argument comes out to an ulp. Of several zeros it finds one; at a jump from one sign to the other, the
    jump. That the signs differ is not checked.
    """
    c, at_c = a, at_a
    step = before = b - a
    for _ in range(MOST):
        if abs(at_c) < abs(at_b):
            a, b, c = b, c, b
            at_a, at_b, at_c = at_b, at_c, at_b
        least, middle = ULP * abs(b), 0.5 * (c - b)
        if at_b == 0.0 or abs(middle) <= least:
            break
        step, before = _step(middle, least, step, before, (a, b, c), (at_a, at_b, at_c))
        a, at_a = b, at_b
        b += step if abs(step) > least else (least if middle > 0.0 else -least)
        at_b = f(b)
        if (at_b > 0.0) == (at_c > 0.0):
            c, at_c = a, at_a
            step = before = b - a
    return b


GOLDEN = 0.5 * (5.0**0.5 - 1.0)


def below_zero(f: Function, a: float, b: float) -> float | None:
    """A place between a and b at which f, positive at both, is negative: on the way to its least value, by
    golden sections (J. Kiefer, 1953); None where that is not below zero. Of several valleys it looks into
    one.
    """
    wide, near = b - a, (b - a) * BESIDE
    if f(a + near) >= f(a) or f(b - near) >= f(b):
        return None
    c, d = b - GOLDEN * (b - a), a + GOLDEN * (b - a)
    at_c, at_d = f(c), f(d)
    while b - a > 2.0**-27 * wide and min(at_c, at_d) >= 0.0:
        if at_c < at_d:
            b, d, at_d = d, c, at_c
            c = b - GOLDEN * (b - a)
            at_c = f(c)
        else:
            a, c, at_c = c, d, at_d
            d = a + GOLDEN * (b - a)
            at_d = f(d)
    place, least = min((c, at_c), (d, at_d), key=lambda one: one[1])
    return place if least < 0.0 else None


def last_that_holds(
    holds: Callable[[float], bool],
    inside: float,
    outside: float,
    least: float = 0.0,
    vanishing: Callable[[float], float | None] | None = None,
) -> tuple[float, float]:
    """The last double at which something holds, from ``inside`` where it does, and the next toward
    ``outside``, where it does not, or one no farther than ``least`` from it: by halving. Of several such
    places it finds one.

    Where a value ``vanishing`` (None: not known there) runs to that place like a straight line, both sides
    of where it would be zero are tried besides: some 20 places in all, for the 50 of halving alone.
    """
    line = _StraightLine(vanishing) if vanishing is not None else None
    while abs(outside - inside) > least and (middle := 0.5 * (inside + outside)) not in (inside, outside):
        inside, outside = (middle, outside) if holds(middle) else (inside, middle)
        for place in line.beside_zero(inside, outside) if line is not None else ():
            if min(inside, outside) < place < max(inside, outside):
                inside, outside = (place, outside) if holds(place) else (inside, place)
    return inside, outside


class _StraightLine:
    """A value that runs to zero like a straight line, by the last two places at which it is known."""

    def __init__(self, value: Callable[[float], float | None]) -> None:
        self.value = value
        self.known: list[tuple[float, float]] = []
        self.zero: float | None = None

    def beside_zero(self, inside: float, outside: float) -> tuple[float, ...]:
        """Both sides of the zero; it moved by more than it is still off when the last place came to it."""
        if self.known and self.known[-1][0] == inside:
            return ()
        value = self.value(inside)
        self.known = [*self.known[-1:], *([] if value is None else [(inside, value)])]
        if len(self.known) < 2:
            return ()
        (a, at_a), (b, at_b) = self.known
        before = self.zero if self.zero is not None else inside
        self.zero = b + at_b * ((b - a) / (at_a - at_b)) if at_a != at_b else b
        off = max(abs(self.zero - before) / CLOSER, 2.0 * math.ulp(self.zero))
        off = math.copysign(off, outside - inside)
        return self.zero - off, self.zero + off


CLOSER = 8.0
"""A zero by a straight line is so many times nearer than it moved."""


Three = tuple[float, float, float]


def _step(
    middle: float, least: float, step: float, before: float, places: Three, values: Three
) -> tuple[float, float]:
    """The next step and the one before: of the quadratic through three places, or half the interval."""
    (a, b, c), (at_a, at_b, at_c) = places, values
    if abs(before) < least or abs(at_a) <= abs(at_b):
        return middle, middle
    s = at_b / at_a
    if a == c:
        p, q = 2.0 * middle * s, 1.0 - s
    else:
        q, r = at_a / at_c, at_b / at_c
        p = s * (2.0 * middle * q * (q - r) - (b - a) * (r - 1.0))
        q = (q - 1.0) * (r - 1.0) * (s - 1.0)
    p, q = (p, -q) if p > 0.0 else (-p, q)
    if 2.0 * p < min(3.0 * middle * q - abs(least * q), abs(before * q)):
        return p / q, step
    return middle, middle


# --- in many digits ----------------------------------------------------------------------------------

ExactFunction = Callable[[Decimal], Decimal]
STEP = Decimal("1e-30")
"""Derivatives are differences over such steps: exact to twice as many digits as this has."""
NOTHING = Decimal("1e-35")
"""Below this fraction of its size elsewhere a value is zero."""
CLOSED = Decimal("1e-45")
"""Zeros are closed in to this."""
MOST_ORDER = 6
"""No more than so many zeros lie where no bound tells them apart."""
MOST_STEPS = 400
ORDERS, SLOW = (1, 3, 5, 7), 8
"""Zeros may be of these orders; which one is asked where so many steps are not a thousand times shorter."""
POLE, GROWN = 1000, 30
"""Where places are so many times nearer to one another a function has grown by the second, at a pole."""


def zeros_between(function: ExactFunction, low: Decimal, high: Decimal, order: int) -> Iterator[Decimal]:
    """The zeros between two places of a function of which a derivative, of this order at most, keeps its sign
    there: between those of its slope, which are found so, it is monotone."""
    if order > 2:  # differences of differences ask for the same places
        function = cache(function)
    size = max(abs(function(low)), abs(function(high)))
    ends = [(low, False)]
    for turn in sorted(zeros_between(slope(function), low, high, order - 1)) if order > 1 else ():
        touches = abs(function(turn)) <= NOTHING * size
        if touches:
            yield turn
        ends.append((turn, touches))
    for (a, one), (b, two) in pairwise([*ends, (high, False)]):
        if a < b and not (one or two):
            yield from closed_in(function, a, b)


def slope(function: ExactFunction) -> ExactFunction:
    """The slope of a function, times two steps."""
    return lambda s: function(s + STEP) - function(s - STEP)


def closed_in(function: ExactFunction, low: Decimal, high: Decimal) -> Iterator[Decimal]:
    """A change of sign between two places, closed in by false position (Illinois; of the values' cube roots,
    fifth roots and so on where steps do not become shorter, as at a zero of such an order); none where the
    function grows as the places close in, through a pole."""
    f, g = function(low), function(high)
    if not f:
        yield low
    if not g:
        yield high
    if not f * g < 0:
        return
    side, wide, size = 0, (high - low) / POLE, Decimal("Infinity")
    at_low, at_high, order, first = f, g, 1, high - low
    for step in range(1, MOST_STEPS + 1):
        at = high - g * (high - low) / (g - f)
        here = function(at)
        if here.is_nan():
            return
        if (here > 0) == (g > 0):
            before = high, at_high
            moved, high, at_high, f, side = high - at, at, here, f / 2 if side > 0 else f, 1
            g = _root_of(here, order)
        else:
            before = low, at_low
            moved, low, at_low, g, side = at - low, at, here, g / 2 if side < 0 else g, -1
            f = _root_of(here, order)
        if not here or min(moved, high - low) <= CLOSED:
            break
        if high - low <= wide:
            if min(abs(at_low), abs(at_high)) > GROWN * size:
                return
            wide, size = (high - low) / POLE, max(abs(at_low), abs(at_high))
        if step % SLOW == 0:
            if moved > first / POLE:
                order, side = _order((low, at_low), (high, at_high), before), 0
                f, g = _root_of(at_low, order), _root_of(at_high, order)
            first = moved
    yield at


Place = tuple[Decimal, Decimal]
"""A place and the value there."""


def _order(low: Place, high: Place, other: Place) -> int:
    """The order of a zero: that of which the roots of the values at three places are nearest to a line."""

    def bend(order: int) -> Decimal:
        (a, f), (b, g), (c, h) = ((at, _root_of(value, order)) for at, value in (low, high, other))
        return abs(f + (g - f) * (c - a) / (b - a) - h) / abs(h)

    return min(ORDERS, key=bend)


def _root_of(value: Decimal, order: int) -> Decimal:
    """The real root of an odd order, to so many digits as a choice of the next place needs."""
    if order == 1 or not value:
        return value
    with localcontext() as context:
        context.prec = 40
        return (abs(value) ** (Decimal(1) / order)).copy_sign(value)
