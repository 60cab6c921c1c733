"""The solution that grows out of that without friction, and whether there are others.

Where the equations contract there is exactly one. Else friction is brought in little by little from
none, the solution followed, and all solutions are counted.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from icsolve.numbers.linear import solve_square
from icsolve.statics.affine import Lengths, contraction, newton, scale_at, slopes, vector
from icsolve.statics.roots import all_roots, can_count

Y = tuple[float, ...]

CONTRACTS = "the friction equations contract: Banach's theorem gives one solution and no other"
COUNTED = "all solutions were counted"
LONGEST = 0.125
FINE = 1e-6
"""How closely the share of friction is found at which forces grow without bound."""
SHORTEST = 1e-7
STEPS = 8
"""A good prediction needs fewer of Newton's steps."""
NEAR = 0.05
"""A prediction that is corrected by more was too far, of the sum of the sizes."""


class Solutions(NamedTuple):
    """``main`` continues the frictionless solution (None: it stops at ``share`` of the friction).

    ``grows`` says that its forces grew without bound there; ``others`` are all other solutions, where
    ``unique`` is not empty (how this is known); ``unique`` is empty where they were too many to count.
    """

    main: Y | None
    others: tuple[Y, ...]
    unique: str
    share: float = 1.0
    grows: bool = False


def solutions(equations: Lengths) -> Solutions:
    """The solutions of a fixed point y = |v(y)|."""
    if contraction(equations) is not None:
        return Solutions(contracted(equations), (), CONTRACTS)
    main, share, grows = followed(equations)
    if not can_count(equations):
        return Solutions(main, (), "", share, grows)
    found = all_roots(equations)
    others = tuple(y for y in found if main is None or not near(y, main))
    return Solutions(main, others, COUNTED, share, grows)


def near(y: Sequence[float], other: Sequence[float]) -> bool:
    """Whether two solutions are one."""
    size = max(map(abs, (*y, *other)), default=0.0) or 1.0
    return max((abs(a - b) for a, b in zip(y, other, strict=True)), default=0.0) <= 1e-7 * size


def contracted(equations: Lengths) -> Y:
    """The fixed point of a contraction: Newton's method, from plain iteration where that does not settle."""
    y = without_friction(equations)
    for _ in range(200):
        found = newton(equations, y)
        if found is not None and min(found, default=0.0) >= -1e-12 * scale_at(equations, found):
            return found
        for _ in range(20):
            y = tuple(math.hypot(*vector(forms, y)) for forms in equations.vectors)
    return y


def without_friction(equations: Lengths) -> Y:
    """Sizes of the forces where nothing rubs."""
    return tuple(math.hypot(*(form[0] for form in forms)) for forms in equations.vectors)


def followed(equations: Lengths) -> tuple[Y | None, float, bool]:
    """The frictionless solution followed to full friction: its end, how far it came, if it grew away.

    In homogeneous coordinates (z, w) with y = z / w, so that forces without bound are a point like others:
    there w passes through zero.
    """
    first = max(without_friction(equations), default=0.0)
    if not first:
        return without_friction(equations), 1.0, False
    z: Y = (*(size / first for size in without_friction(equations)), 1.0)
    share, step = 0.0, LONGEST
    while share < 1.0:
        ahead = min(1.0, share + step)
        moved = _moved(equations, first, z, share, ahead)
        if moved is not None and moved[-1] <= 0.0:
            if step < FINE:
                return None, share, True
            moved = None
        if moved is None:
            step /= 2.0
            if step < SHORTEST:
                return None, share, False
            continue
        z, share, step = moved, ahead, min(LONGEST, 2.0 * step)
    return tuple(part * first / z[-1] for part in z[:-1]), 1.0, False


def _moved(equations: Lengths, first: float, z: Y, share: float, ahead: float) -> Y | None:
    """The solution a step on: predicted along the tangent, corrected; None where the step was too long."""
    change = _tangent(equations, first, z, share)
    start = z if change is None else tuple(a + (ahead - share) * b for a, b in zip(z, change, strict=True))
    found = newton(_homogeneous(equations, first, ahead), start, STEPS)
    if found is None or min(found[:-1], default=0.0) < -1e-10:
        return None
    off = max(abs(a - b) for a, b in zip(found, start, strict=True))
    return found if off <= NEAR else None


def _homogeneous(equations: Lengths, first: float, share: float) -> Lengths:
    """z_k = |w a_k / first + share B_k z| and, to fix the scale, sum of z + w = sum of the first ones + 1."""
    n = len(equations.vectors)
    vectors = tuple(
        tuple((0.0, *(share * a for a in form[1:]), form[0] / first) for form in forms)
        for forms in equations.vectors
    )
    lengths = tuple(tuple(float(j == k + 1) for j in range(n + 2)) for k in range(n))
    whole = 1.0 + sum(without_friction(equations)) / first
    return Lengths((*lengths, (-whole, *[1.0] * (n + 1))), (*vectors, ()), (*equations.touching, False))


def _tangent(equations: Lengths, first: float, z: Y, share: float) -> list[float] | None:
    """Derivative of the solution by the share of friction."""
    here = _homogeneous(equations, first, share)
    right = []
    for now, forms in zip(here.vectors, equations.vectors, strict=False):
        v = vector(now, z)
        size = math.hypot(*v) or 1.0
        slope = [sum(a * x for a, x in zip(form[1:], z, strict=False)) for form in forms]
        right.append(sum(a * b for a, b in zip(v, slope, strict=True)) / size)
    return solve_square(slopes(here, z), [*right, 0.0])
