"""Zeros of a function of one number on a range."""

from __future__ import annotations

from collections.abc import Callable

Function = Callable[[float], float]
MOST = 120
"""Halvings at most: no double is left between the ends then, unless the zero is at 0."""


def zeros(f: Function, low: float, high: float, samples: int) -> list[float]:
    """The zeros between neighbouring samples of different sign, each to the last digits."""
    places = [low + (high - low) * k / samples for k in range(samples + 1)]
    values = [f(x) for x in places]
    found = []
    for k in range(samples):
        if values[k] == 0.0:
            found.append(places[k])
        elif values[k] * values[k + 1] < 0.0:
            found.append(bisected(f, places[k], places[k + 1], values[k]))
    return found


def bisected(f: Function, a: float, b: float, at_a: float) -> float:
    """The zero between a and b, where f has different signs; ``at_a`` is its value at a."""
    for _ in range(MOST):
        middle = 0.5 * (a + b)
        if middle in (a, b):
            break
        value = f(middle)
        if value == 0.0:
            return middle
        if (value < 0.0) == (at_a < 0.0):
            a, at_a = middle, value
        else:
            b = middle
    return min((a, b), key=lambda x: abs(f(x)))
