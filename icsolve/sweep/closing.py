"""Zeros of a smooth function, closed in on in many digits."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from decimal import Decimal
from functools import cache
from itertools import pairwise

from icsolve.sweep.exact import STEP

NOTHING = Decimal("1e-35")
"""Below this fraction of its size elsewhere a value is zero."""
CLOSED = Decimal("1e-45")
"""Zeros are closed in to this."""
MOST_ORDER = 6
"""No more than so many zeros lie where no bound tells them apart."""
MOST_STEPS = 400
POLE, GROWN = 1000, 30
"""Where places are so many times nearer to one another a function has grown by the second, at a pole."""

Function = Callable[[Decimal], Decimal]


def zeros_between(function: Function, low: Decimal, high: Decimal, order: int) -> Iterator[Decimal]:
    """The zeros between two places of a function of which a derivative, of this order at most, keeps its sign
    there: between those of its slope, which are found so, it is monotone."""
    if order > 2:  # differences of differences ask for the same places
        function = cache(function)
    size = max(abs(function(low)), abs(function(high)))
    ends = [(low, False)]
    for turn in sorted(zeros_between(_slope(function), low, high, order - 1)) if order > 1 else ():
        touches = abs(function(turn)) <= NOTHING * size
        if touches:
            yield turn
        ends.append((turn, touches))
    for (a, one), (b, two) in pairwise([*ends, (high, False)]):
        if a < b and not (one or two):
            yield from closed_in(function, a, b)


def _slope(function: Function) -> Function:
    """The slope of a function, times a step."""
    return lambda s: function(s + STEP) - function(s - STEP)


def closed_in(function: Function, low: Decimal, high: Decimal) -> Iterator[Decimal]:
    """A change of sign between two places, closed in by false position (Illinois); none where the function
    grows as the places close in, through a pole."""
    f, g = function(low), function(high)
    if not f:
        yield low
    if not g:
        yield high
    if not f * g < 0:
        return
    side, wide, size = 0, (high - low) / POLE, Decimal("Infinity")
    for _ in range(MOST_STEPS):
        at = high - g * (high - low) / (g - f)
        here = function(at)
        if here.is_nan():
            return
        if (here > 0) == (g > 0):
            moved, (high, g), f, side = high - at, (at, here), f / 2 if side > 0 else f, 1
        else:
            moved, (low, f), g, side = at - low, (at, here), g / 2 if side < 0 else g, -1
        if not here or min(moved, high - low) <= CLOSED:
            break
        if high - low <= wide:
            if min(abs(f), abs(g)) > GROWN * size:
                return
            wide, size = (high - low) / POLE, max(abs(f), abs(g))
    yield at
