"""Real solutions of quadrics l(z)^2 = |v(z)|^2, as many as unknowns: in closed form, or along paths."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from itertools import product
from operator import mul

from icsolve.numbers.linear import solve_square
from icsolve.statics.affine import Form

LONGEST = 0.1
"""The longest step along a path; longer ones can cross to a neighbour."""
NEAR = 1e-3
"""A prediction that the first correction moves by more, of its size, was too far."""

Quadric = tuple[Form, tuple[Form, ...]]
Point = list[complex]


def quadric_roots(quadrics: Sequence[Quadric], scale: float) -> list[list[float]]:
    """The real solutions z (rough ones too); ``scale`` is the size of the forms' constants."""
    if not quadrics:
        return [[]]
    if len(quadrics) == 1:
        return [[z] for z in _one(quadrics[0])]
    paths = _Paths([_normalised(quadric, scale) for quadric in quadrics])
    ends = [paths.follow(signs) for signs in product((1.0, -1.0), repeat=len(quadrics))]
    return [[part * scale for part in z] for z in map(_real, ends) if z is not None]


def _one(quadric: Quadric) -> list[float]:
    """Solutions of one quadratic a z^2 + 2 b z + c = 0, without cancellation."""
    length, forms = quadric
    a = length[1] ** 2 - sum(f[1] ** 2 for f in forms)
    b = length[0] * length[1] - sum(f[0] * f[1] for f in forms)
    c = length[0] ** 2 - sum(f[0] ** 2 for f in forms)
    inside = b * b - a * c
    if inside < 0.0:
        return [-b / a] if inside > -1e-12 * (b * b + abs(a * c)) and a else []
    q = -(b + math.copysign(math.sqrt(inside), b))
    return [x for x in (q / a if a else math.inf, c / q if q else math.inf) if math.isfinite(x)] or [0.0]


def _normalised(quadric: Quadric, scale: float) -> Quadric:
    length, forms = quadric
    return _scaled(length, scale), tuple(_scaled(form, scale) for form in forms)


def _scaled(form: Form, scale: float) -> Form:
    return (form[0] / scale, *form[1:])


def _real(end: Point | None) -> list[float] | None:
    """A path's end as a real point; None at infinity and off the real space."""
    if end is None or abs(end[0]) < 1e-7 * max(map(abs, end)):
        return None
    z = [part / end[0] for part in end[1:]]
    size = max(1.0, *map(abs, z))
    if any(abs(part.imag) > 1e-5 * size for part in z):
        return None
    return [part.real for part in z]


class _Paths:
    """H(z, t) = (1 - t) gamma (z_k^2 - z_0^2) + t F_k(z), homogeneous in z_0, ..., z_n, on a random patch."""

    def __init__(self, quadrics: Sequence[Quadric]) -> None:
        self.matrices = [_matrix(quadric) for quadric in quadrics]
        self.n = len(quadrics)
        self.gamma = cmath.exp(0.9137j)
        self.patch = [cmath.exp(1j * (0.7 + 1.9 * k)) for k in range(self.n + 1)]

    def follow(self, signs: Sequence[float]) -> Point | None:
        """From a start (z_k = +-1) to t = 1; None where the path can't be followed to its end."""
        z: Point = [1.0 + 0.0j, *(complex(s) for s in signs)]
        size = sum(a * b for a, b in zip(self.patch, z, strict=True))
        z = [part / size for part in z]
        t, step = 0.0, LONGEST
        while t < 1.0:
            ahead = min(1.0, t + step)
            moved = self.corrected(self.predicted(z, t, ahead - t), ahead)
            if moved is None:
                step /= 2.0
                if step < 1e-9:
                    return z if 1.0 - t < 1e-5 else None
                continue
            z, t, step = moved, ahead, min(LONGEST, 1.5 * step)
        return z

    def predicted(self, z: Point, t: float, dt: float) -> Point:
        """A step along the tangent, of second order (midpoint)."""
        first = self.tangent(z, t)
        half = [a + 0.5 * dt * b for a, b in zip(z, first, strict=True)] if first else z
        second = self.tangent(half, t + 0.5 * dt)
        return [a + dt * b for a, b in zip(z, second, strict=True)] if second else half

    def tangent(self, z: Point, t: float) -> Point | None:
        starts, targets, rows = self.system(z, t)
        change = [start - target for start, target in zip(starts, targets, strict=True)]
        return solve_square(rows, [*change, 0.0j])

    def corrected(self, z: Point, t: float) -> Point | None:
        """Newton's method at fixed t; None where three steps do not nearly reach the path."""
        for attempt in range(4):
            starts, targets, rows = self.system(z, t)
            values = [(1 - t) * a + t * b for a, b in zip(starts, targets, strict=True)]
            values.append(sum(map(mul, self.patch, z)) - 1.0)
            step = solve_square(rows, values)
            if step is None:
                return None
            z = [a - b for a, b in zip(z, step, strict=True)]
            size = max(map(abs, z))
            moved = max(map(abs, step))
            if moved <= 1e-10 * size:
                return z
            if attempt == 0 and moved > NEAR * size:
                return None
        return None

    def system(self, z: Point, t: float) -> tuple[Point, Point, list[Point]]:
        """The start system, the target system, and the derivatives of their sum at t (with the patch)."""
        starts, targets, rows = [], [], []
        twice, rest = 2.0 * t, 2.0 * (1.0 - t) * self.gamma
        first = z[0]
        for k, matrix in enumerate(self.matrices, start=1):
            half = [sum(map(mul, row, z)) for row in matrix]  # half the gradient of the form
            starts.append(self.gamma * (z[k] * z[k] - first * first))
            targets.append(sum(map(mul, half, z)))
            derivatives = [twice * part for part in half]
            derivatives[k] += rest * z[k]
            derivatives[0] -= rest * first
            rows.append(derivatives)
        rows.append(list(self.patch))
        return starts, targets, rows


def _matrix(quadric: Quadric) -> list[list[float]]:
    """The symmetric matrix of a quadric l(z)^2 - |v(z)|^2."""
    length, forms = quadric
    count = range(len(length))
    return [[length[i] * length[j] - sum(form[i] * form[j] for form in forms) for j in count] for i in count]
