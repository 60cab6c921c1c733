"""Friction as equations between lengths: l_k(y) = |v_k(y)| for every rub k, all of them affine in y.

l_k is the size of the normal force (or of a pin's force) that friction was computed with, v_k that
force itself. Where y are the lengths themselves this is a fixed point y = |v(y)|.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from icsolve.numbers.linear import inverse, solve_square

Form = tuple[float, ...]
"""An affine form: the constant, then the coefficients of y."""


class Lengths(NamedTuple):
    """The equations: ``lengths[k]`` is l_k, ``vectors[k]`` the one or two components of v_k.

    ``touching[k]`` says that v_k (of one component) is a contact's normal force, which only pushes.
    """

    lengths: tuple[Form, ...]
    vectors: tuple[tuple[Form, ...], ...]
    touching: tuple[bool, ...]

    @property
    def is_fixed_point(self) -> bool:
        """Whether y are the lengths themselves."""
        n = len(self.lengths)
        return all(form == _unit(k, n) for k, form in enumerate(self.lengths))

    def scaled(self, share: float) -> Lengths:
        """The equations with friction reduced to a share of it (where y are the lengths)."""
        vectors = tuple(
            tuple((form[0], *(share * a for a in form[1:])) for form in forms) for forms in self.vectors
        )
        return self._replace(vectors=vectors)


def _unit(k: int, n: int) -> Form:
    return tuple(float(j == k + 1) for j in range(n + 1))


def fixed_point(vectors: Sequence[tuple[Form, ...]], touching: Sequence[bool]) -> Lengths:
    """The equations y = |v(y)|."""
    n = len(vectors)
    return Lengths(tuple(_unit(k, n) for k in range(n)), tuple(vectors), tuple(touching))


def at(form: Form, y: Sequence[float]) -> float:
    """Value of an affine form."""
    return form[0] + sum(a * x for a, x in zip(form[1:], y, strict=True))


def vector(forms: Sequence[Form], y: Sequence[float]) -> tuple[float, ...]:
    """Value of v_k."""
    return tuple(at(form, y) for form in forms)


def misfits(equations: Lengths, y: Sequence[float]) -> list[float]:
    """l_k - |v_k|."""
    both = zip(equations.lengths, equations.vectors, strict=True)
    return [at(form, y) - math.hypot(*vector(forms, y)) for form, forms in both]


def slopes(equations: Lengths, y: Sequence[float]) -> list[list[float]]:
    """Derivatives of l_k - |v_k|; where v_k vanishes, of one side of the kink."""
    rows = []
    for form, forms in zip(equations.lengths, equations.vectors, strict=True):
        v = vector(forms, y)
        size = math.hypot(*v)
        unit = [part / size for part in v] if size else [1.0, 0.0][: len(v)]
        rows.append(
            [p - sum(u * f[j + 1] for u, f in zip(unit, forms, strict=True)) for j, p in enumerate(form[1:])]
        )
    return rows


MOST_STEPS = 60
ROUNDING = 2.0**-52


def newton(equations: Lengths, start: Sequence[float], most: int = MOST_STEPS) -> tuple[float, ...] | None:
    """Newton's method on the piecewise smooth equations; None where it does not settle."""
    y = list(start)
    before = math.inf
    for _ in range(most):
        g = misfits(equations, y)
        size = max(map(abs, g), default=0.0)
        if size <= 4.0 * ROUNDING * scale_at(equations, y) or (
            size < 1e-12 * scale_at(equations, y) and size >= before
        ):
            return tuple(y)
        step = solve_square(slopes(equations, y), g)
        if step is None or not all(map(math.isfinite, step)):
            return None
        y = [a - b for a, b in zip(y, step, strict=True)]
        before = size
    return None


def scale_at(equations: Lengths, y: Sequence[float]) -> float:
    """The largest term in any of the forms: what rounding is measured by."""
    forms = [*equations.lengths, *(form for forms in equations.vectors for form in forms)]
    terms = (abs(f[0]) + sum(abs(a * x) for a, x in zip(f[1:], y, strict=True)) for f in forms)
    return max(terms, default=0.0) or 1.0


def contraction(equations: Lengths) -> list[list[float]] | None:
    """(I - L)^-1 where y -> |v(y)| contracts, None where that is not sure.

    L has the lengths of the derivatives of v. Where I - L has an inverse without a negative entry the
    spectral radius of L is below 1 (Berman and Plemmons, Nonnegative Matrices, 1994, ch. 6), and Banach's
    theorem gives one solution, no more and no less.
    """
    if not equations.is_fixed_point:
        return None
    n = len(equations.lengths)
    factors = [
        [math.hypot(*(form[j + 1] for form in forms)) for j in range(n)] for forms in equations.vectors
    ]
    found = inverse([[float(k == j) - factors[k][j] for j in range(n)] for k in range(n)])
    if found is None or any(a < -1e-12 or a > 1e6 for row in found for a in row):
        return None
    return found


def error_of(equations: Lengths, y: Sequence[float]) -> float:
    """Bound on the relative error of a solution, from what is left of its equations.

    With a contraction (I - L)^-1 times the misfits bounds the error; else it is twice the Newton step.
    """
    rest = [abs(g) + ROUNDING * scale_at(equations, y) for g in misfits(equations, y)]
    spread = contraction(equations)
    twice = 1.0
    if spread is None:
        spread, twice = inverse(slopes(equations, y)), 2.0
    if spread is None:
        return math.inf
    size = max(map(abs, y), default=0.0) or 1.0
    return (
        twice
        * max((sum(abs(a) * r for a, r in zip(row, rest, strict=True)) for row in spread), default=0.0)
        / size
    )


def is_sound(equations: Lengths, y: Sequence[float]) -> bool:
    """Whether no length is negative and every contact pushes (but for rounding)."""
    least = -1e-10 * scale_at(equations, y)
    if any(at(form, y) < least for form in equations.lengths):
        return False
    touching = (forms for forms, only in zip(equations.vectors, equations.touching, strict=True) if only)
    return all(at(forms[0], y) >= least for forms in touching)
