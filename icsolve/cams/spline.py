"""Periodic cubic spline: twice continuously differentiable through values at given places of a period.

C. de Boor, A Practical Guide to Splines, 1978, ch. IV; the cyclic system by Sherman and Morrison's formula.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from typing import NamedTuple


class Spline(NamedTuple):
    """``values`` and second derivatives ``bends`` at increasing ``places``, repeated with the ``period``."""

    places: tuple[float, ...]
    values: tuple[float, ...]
    bends: tuple[float, ...]
    period: float

    def at(self, x: float) -> tuple[float, float, float]:
        """Value, first and second derivative."""
        x = self.places[0] + (x - self.places[0]) % self.period
        k = min(bisect_right(self.places, x), len(self.places)) - 1
        n = (k + 1) % len(self.places)
        h = self.places[n] - self.places[k] + (self.period if n <= k else 0.0)
        b = (x - self.places[k]) / h
        a = 1.0 - b
        p, q, r, s = self.values[k], self.values[n], self.bends[k], self.bends[n]
        value = a * p + b * q + ((a**3 - a) * r + (b**3 - b) * s) * h * h / 6.0
        slope = (q - p) / h + ((3.0 * b * b - 1.0) * s - (3.0 * a * a - 1.0) * r) * h / 6.0
        return value, slope, a * r + b * s


def spline(places: Sequence[float], values: Sequence[float], period: float) -> Spline:
    """The spline through the values; at least three places, increasing, within one period."""
    n = len(places)
    steps = [places[(k + 1) % n] - places[k] + (period if k == n - 1 else 0.0) for k in range(n)]
    slopes = [(values[(k + 1) % n] - values[k]) / steps[k] for k in range(n)]
    middle = [2.0 * (steps[k - 1] + steps[k]) for k in range(n)]
    right = [6.0 * (slopes[k] - slopes[k - 1]) for k in range(n)]
    return Spline(tuple(places), tuple(values), tuple(_cyclic(steps, middle, right)), period)


def _cyclic(steps: Sequence[float], middle: Sequence[float], right: Sequence[float]) -> list[float]:
    """Solve ``steps[k-1] x[k-1] + middle[k] x[k] + steps[k] x[k+1] = right[k]``, cyclic."""
    corner, gamma = steps[-1], -middle[0]
    diagonal = list(middle)
    diagonal[0] -= gamma
    diagonal[-1] -= corner * corner / gamma
    u = [gamma, *([0.0] * (len(steps) - 2)), corner]
    y, z = _tridiagonal(steps, diagonal, right), _tridiagonal(steps, diagonal, u)
    ratio = corner / gamma
    factor = (y[0] + ratio * y[-1]) / (1.0 + z[0] + ratio * z[-1])
    return [a - factor * b for a, b in zip(y, z, strict=True)]


def _tridiagonal(steps: Sequence[float], diagonal: Sequence[float], right: Sequence[float]) -> list[float]:
    """Thomas's elimination; the matrix is symmetric with ``steps`` beside the diagonal."""
    n = len(diagonal)
    ratios, x = [0.0] * n, [0.0] * n
    pivot = diagonal[0]
    x[0] = right[0] / pivot
    for k in range(1, n):
        ratios[k] = steps[k - 1] / pivot
        pivot = diagonal[k] - steps[k - 1] * ratios[k]
        x[k] = (right[k] - steps[k - 1] * x[k - 1]) / pivot
    for k in range(n - 2, -1, -1):
        x[k] -= ratios[k + 1] * x[k + 1]
    return x
