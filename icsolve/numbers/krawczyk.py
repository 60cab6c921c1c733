"""The root of a system of equations near a start, enclosed: that it is there and the only one is shown.

Krawczyk's operator (R. Krawczyk, Computing 4, 1969; R. E. Moore, SIAM J. Numer. Anal. 14, 1977): with C near
the inverse of the Jacobian J, and a box X of half-width r about m,

    K(X) = m - C F(m) + (1 - C J(X)) (X - m).

Where K(X) lies inside X there is one root in X, and it lies in K(X). The data of F are balls: it then is so
for every system that they hold.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal, Overflow

from icsolve.numbers import Scalar
from icsolve.numbers.balls import INEXACT, TINY, UP, Ball, Balls, MoreDigits
from icsolve.tuples import TypeVar

System = Callable[[Sequence[Scalar]], tuple[Sequence[Scalar], Sequence[Mapping[int, Scalar]]]]
"""Values of the equations at a point or box, and their derivatives by the unknowns that bear on each."""

MOST_STEPS = 60
WIDENINGS = 4
ROUNDING = 2.0**-51
SHORTEST = 1e-30
"""Steps shorter than this may grow by what all digits leave open."""
FEW = 8
"""Equations whose inverse is soon had in decimals."""
WIDEST = 1e-6
"""A box that is wider says nothing of a root near the start (which lies in a frame of size 1)."""


def enclosed_root(system: System, start: Sequence[float | Decimal], balls: Balls) -> list[Ball]:
    """Balls that hold the one root near a start.

    Parameters
    ----------
    system : at n balls, the values of n equations and, a row each, their derivatives by the unknowns that
        bear on it (by index); derivatives over a box have to hold all those in it
    start : (n,) [frame of size 1]: near enough that Newton steps close in on the root
    balls : the arithmetic, whose digits say how narrow the enclosure becomes

    Returns
    -------
    list[Ball]
        (n,): inside them there is one root for every system that the data of ``system`` hold.

    Raises
    ------
    MoreDigits
        Where that is not shown: the Jacobian is singular or near it, the start is far from any root, or the
        data are too wide. It does not say that there is no root.
    """
    if not all(math.isfinite(x) for x in start):
        raise MoreDigits
    try:
        found = _closed_in(system, [Decimal(x) for x in start], balls)
    except Overflow:  # so far from a root that no number holds the equations' values
        found = None
    if found is None:
        raise MoreDigits
    return found


def _closed_in(system: System, middle: list[Decimal], balls: Balls) -> list[Ball] | None:
    """The same; None where no root is shown."""
    longest = math.inf
    for n in range(MOST_STEPS):
        values, rows = system([balls.exactly(x) for x in middle])
        near = _in_decimals(rows, balls) if n else _in_floats(rows, balls)
        found = None if near is None else _enclosed(system, middle, near, balls)
        if found is not None:
            return found
        if n == 0:
            continue
        if near is None:
            break
        step = [_product(row, values, balls)[0] for row in near]
        before, longest = longest, max(abs(float(x)) for x in step)
        if not longest < 0.5 * before:
            break
        middle = [balls.subtract(x, d) for x, d in zip(middle, step, strict=True)]
    return None


def turns_away(system: System, start: Sequence[float | Decimal], balls: Balls) -> bool:
    """Whether Newton's method, with all digits, closes in on no root near a start: as beyond a fold, where a
    root of a negative number would have to be taken, its steps halve, and then grow beyond all of them.

    It is no proof; where two roots are one the steps halve for ever, and nothing is said.
    """
    middle, last = [Decimal(x) for x in start], math.inf
    for _ in range(4 * MOST_STEPS):
        values, rows = system([balls.exactly(x) for x in middle])
        near = _in_decimals(rows, balls)
        if near is None:
            return False
        step = [_product(row, values, balls)[0] for row in near]
        longest = max(abs(float(x)) for x in step)
        if longest < balls.unit:
            return False
        if not longest < last and longest > SHORTEST:
            return True
        middle, last = [balls.subtract(x, d) for x, d in zip(middle, step, strict=True)], longest
    return False


def _enclosed(
    system: System, middle: list[Decimal], inverse: list[list[Decimal]], balls: Balls
) -> list[Ball] | None:
    """The root, with what is near the inverse of the Jacobian; None where it is not shown."""
    middle, off, inverse = _refined(system, middle, inverse, balls)
    if not all(x < WIDEST for x in off):
        return None
    rough = [[float(c) for c in row] for row in inverse]
    radius = 4.0 * max(off) + 4.0 * balls.unit * (1.0 + max(abs(float(x)) for x in middle))
    for _ in range(WIDENINGS):
        box = [_ball(balls, x, radius) for x in middle]
        rows = system(box)[1]
        left = _left(rough, rows)
        if max(left) >= 1.0:  # the rounding of doubles alone, beside a singular position
            left = _left_in_digits(inverse, rows, balls)
        if max(left) >= 1.0:  # a wider box contracts no more than this one
            break
        reach = [(step + radius * most) * UP + TINY for step, most in zip(off, left, strict=True)]
        if max(reach) < radius < WIDEST:
            return [_ball(balls, x, r) for x, r in zip(middle, reach, strict=True)]
        radius *= 16.0
    return None


def _ball(balls: Balls, value: Decimal, radius: float) -> Ball:
    return Ball(balls, value, radius, abs(float(value)) * UP + TINY, INEXACT)


def _refined(
    system: System, middle: list[Decimal], inverse: list[list[Decimal]], balls: Balls
) -> tuple[list[Decimal], list[float], list[list[Decimal]]]:
    """The point after Newton steps, bounds of the next step, C F, and C: the inverse, which after a step is
    taken again with all digits where that costs less than the steps that it saves."""
    best: float | None = None
    off: list[float] = []
    for n in range(MOST_STEPS):
        values, rows = system([balls.exactly(x) for x in middle])
        if 1 <= n <= 2 and len(rows) <= FEW:
            inverse = _in_decimals(rows, balls) or inverse
        step = [_product(row, values, balls) for row in inverse]
        off = [abs(float(x)) + r for x, r in step]  # how they are rounded, `_left` has room for
        longest = max(off)
        if not all(map(math.isfinite, off)):
            break
        if n > 1 and best is not None and longest > 0.25 * best:
            break  # not sooner: where a rub turns over, the first step may lead to the wrong side of zero
        best = longest
        middle = [balls.subtract(x, d) for x, (d, _) in zip(middle, step, strict=True)]
    return middle, off, inverse


def _product(row: Sequence[Decimal], values: Sequence[Scalar], balls: Balls) -> tuple[Decimal, float]:
    """Sum of products, and a bound on its error."""
    total, radius = Decimal(0), TINY
    for c, value in zip(row, values, strict=True):
        if type(value) is Ball:
            total = balls.add(total, balls.multiply(c, value.value))
            weight = abs(float(c)) * UP
            radius += weight * (value.radius + 2.0 * len(row) * balls.unit * value.size) * UP + TINY
        else:
            assert value == 0.0
    return total, radius * UP


def _left(rough: list[list[float]], rows: Sequence[Mapping[int, Scalar]]) -> list[float]:
    """Bounds of the row sums of abs(1 - C J)."""
    n = len(rough)
    entries = [[(j, float(v), getattr(v, "radius", 0.0)) for j, v in row.items()] for row in rows]
    sums = []
    for i, row in enumerate(rough):
        rest, spread = [0.0] * n, [0.0] * n
        rest[i], spread[i] = 1.0, ROUNDING
        for c, entry in zip(row, entries, strict=True):
            if c:
                for j, value, radius in entry:
                    product = c * value
                    rest[j] -= product
                    spread[j] += abs(product) * ROUNDING * n + abs(c) * radius * UP
        sums.append((sum(map(abs, rest)) + 2.0 * sum(spread)) * UP)
    return sums


def _left_in_digits(
    inverse: list[list[Decimal]], rows: Sequence[Mapping[int, Scalar]], balls: Balls
) -> list[float]:
    """The same with all digits."""
    sums = []
    for i, row in enumerate(inverse):
        rest = dict.fromkeys(range(len(inverse)), Decimal(0)) | {i: Decimal(1)}
        spread = TINY
        for c, entry in zip(row, rows, strict=True):
            weight = abs(float(c)) * UP
            for j, v in entry.items():
                value, radius = (v.value, v.radius) if type(v) is Ball else (Decimal(v), 0.0)
                rest[j] = balls.subtract(rest[j], balls.multiply(c, value))
                size = abs(float(value)) * UP + TINY
                spread += weight * (radius + 4.0 * len(row) * balls.unit * size) * UP + TINY
        sums.append((sum(abs(float(one)) for one in rest.values()) + spread) * UP)
    return sums


def _in_floats(rows: Sequence[Mapping[int, Scalar]], balls: Balls) -> list[list[Decimal]] | None:
    """The inverse of a Jacobian in floats (of no bound); None where it has none."""
    work = [[0.0] * len(rows) for _ in rows]
    for line, row in zip(work, rows, strict=True):
        for j, value in row.items():
            line[j] = float(value)
    found = _inverse(work, 1.0, operator.truediv, operator.mul, operator.sub)
    return None if found is None else [[Decimal(c) for c in row] for row in found]


def _in_decimals(rows: Sequence[Mapping[int, Scalar]], balls: Balls) -> list[list[Decimal]] | None:
    """The same with all digits."""
    work = [[Decimal(0)] * len(rows) for _ in rows]
    for line, row in zip(work, rows, strict=True):
        for j, value in row.items():
            line[j] = value.value if type(value) is Ball else Decimal(value)
    return _inverse(work, Decimal(1), balls.divide, balls.multiply, balls.subtract)


N = TypeVar("N", float, Decimal)


def _inverse(
    rows: list[list[N]],
    one: N,
    divide: Callable[[N, N], N],
    multiply: Callable[[N, N], N],
    subtract: Callable[[N, N], N],
) -> list[list[N]] | None:
    """By Gauss and Jordan, with row pivots."""
    n, zero = len(rows), subtract(one, one)
    work = [row + [one if i == k else zero for k in range(n)] for i, row in enumerate(rows)]
    for c in range(n):
        r = max(range(c, n), key=lambda k: abs(float(work[k][c])))
        if not work[r][c]:
            return None
        work[c], work[r] = work[r], work[c]
        top, pivot = work[c], work[c][c]
        used = [k for k in range(c, 2 * n) if top[k]]
        for k in used:
            top[k] = divide(top[k], pivot)
        for i, row in enumerate(work):
            ratio = row[c]
            if i != c and ratio:
                for k in used:
                    row[k] = subtract(row[k], multiply(ratio, top[k]))
    return [row[n:] for row in work]
