"""All solutions of the friction equations, where one is not proven to be the only one.

The signs of the scalar forces are tried one by one, which makes their equations linear. What remains,
the pins, are as many quadrics as unknowns: one is solved in closed form, several by following every
path of a homotopy from a system whose solutions are known (A. J. Sommese and C. W. Wampler, The
Numerical Solution of Systems of Polynomials, 2005, ch. 8: total degree, on a random path in the complex
projective space, so that solutions at infinity are points like others).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import product

from icsolve.numbers.linear import solve_square
from icsolve.statics.affine import Form, Lengths, at, is_sound, newton, scale_at
from icsolve.statics.paths import quadric_roots

MOST_RUBS = 6
MOST_PINS = 4
"""More than these have too many combinations to try."""


def can_count(equations: Lengths) -> bool:
    """Whether all solutions can be found in reasonable time."""
    pins = sum(len(forms) == 2 for forms in equations.vectors)
    return len(equations.vectors) <= MOST_RUBS and pins <= MOST_PINS


def all_roots(equations: Lengths) -> list[tuple[float, ...]]:
    """Every solution with lengths that are not negative and contacts that push."""
    scalars = [k for k, forms in enumerate(equations.vectors) if len(forms) == 1]
    choices = [(1.0,) if equations.touching[k] else (1.0, -1.0) for k in scalars]
    found: list[tuple[float, ...]] = []
    for signs in product(*choices):
        for rough in _with_signs(equations, dict(zip(scalars, signs, strict=True))):
            y = newton(equations, rough)
            if (
                y is not None
                and is_sound(equations, y)
                and not any(_same(equations, y, other) for other in found)
            ):
                found.append(y)
    return found


def _same(equations: Lengths, y: Sequence[float], other: Sequence[float]) -> bool:
    size = max(map(abs, (*y, *other)), default=0.0) or 1.0
    return max((abs(a - b) for a, b in zip(y, other, strict=True)), default=0.0) <= 1e-7 * size


def _with_signs(equations: Lengths, signs: dict[int, float]) -> Iterable[Sequence[float]]:
    """Rough solutions in which the scalar forces have these signs."""
    linear = [_minus(equations.lengths[k], equations.vectors[k][0], sign) for k, sign in signs.items()]
    space = _solution_space(linear, len(equations.lengths))
    if space is None:
        return
    pins = [k for k in range(len(equations.lengths)) if k not in signs]
    quadrics = [
        (_on(equations.lengths[k], space), tuple(_on(form, space) for form in equations.vectors[k]))
        for k in pins
    ]
    scale = scale_at(equations, space[0])
    for z in quadric_roots(quadrics, scale):
        y = (
            [
                o + sum(a * b for a, b in zip(z, row, strict=True))
                for o, row in zip(space[0], zip(*space[1:], strict=True), strict=True)
            ]
            if z
            else list(space[0])
        )
        rough = all(
            sign * at(equations.vectors[k][0], y) >= -1e-6 * scale_at(equations, y)
            for k, sign in signs.items()
        )
        if rough:
            yield y


def _minus(length: Form, force: Form, sign: float) -> Form:
    return tuple(a - sign * b for a, b in zip(length, force, strict=True))


def _on(form: Form, space: Sequence[Sequence[float]]) -> Form:
    """An affine form in the coordinates of an affine space (origin, then directions)."""
    return (
        at(form, space[0]),
        *(sum(a * d for a, d in zip(form[1:], direction, strict=True)) for direction in space[1:]),
    )


def _solution_space(linear: list[Form], n: int) -> list[list[float]] | None:
    """Origin and directions of the solutions of affine equations; None where there are none, or too many."""
    work = [list(form) for form in linear]
    pivots: list[tuple[int, list[float]]] = []
    while work:
        size, r, c = max((abs(row[c + 1]), r, c) for r, row in enumerate(work) for c in range(n))
        if size <= 1e-12 * max(abs(a) for form in linear for a in form[1:]):
            return None
        row = work.pop(r)
        pivots.append((c, row))
        for other in work:
            ratio = other[c + 1] / row[c + 1]
            other[:] = [a - ratio * b for a, b in zip(other, row, strict=True)]
    free = [c for c in range(n) if c not in [p for p, _ in pivots]]
    origin = _completed(pivots, n, {}, 1.0)
    return [origin, *(_completed(pivots, n, {c: 1.0}, 0.0) for c in free)]


def _completed(
    pivots: list[tuple[int, list[float]]], n: int, chosen: dict[int, float], constant: float
) -> list[float]:
    """The vector with these free entries that solves the (homogeneous) equations."""
    y = [chosen.get(c, 0.0) for c in range(n)]
    for c, row in reversed(pivots):
        rest = constant * row[0] + sum(row[k + 1] * y[k] for k in range(n) if k != c)
        y[c] = -rest / row[c + 1]
    return y


__all__ = ["all_roots", "can_count", "math", "solve_square"]
