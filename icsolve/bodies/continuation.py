"""The solution that grows out of that without friction, and whether there are others.

Where the equations contract there is exactly one. Else friction is brought in little by little from
none, the solution followed, and all solutions are counted.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from icsolve.bodies.affine import Lengths, contraction, newton, scale_at, slopes, vector
from icsolve.bodies.linear import solve_square
from icsolve.bodies.roots import all_roots, can_count

Y = tuple[float, ...]

CONTRACTS = "the friction equations contract: Banach's theorem gives one solution and no other"
COUNTED = "all solutions were counted"
ESCAPED = 1e9
"""Forces that grow beyond this many times those without friction grow without bound."""
SHORTEST = 1e-8


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
    """The frictionless solution followed to full friction: its end, how far it came, if it grew away."""
    y, share, step = without_friction(equations), 0.0, 0.1
    first = max(y, default=0.0) or 1.0
    while share < 1.0:
        ahead = min(1.0, share + step)
        moved = _moved(equations, y, share, ahead)
        if moved is None:
            step /= 2.0
            if step < SHORTEST:
                return None, share, _grows(equations, y, share, first)
            continue
        y, share, step = moved, ahead, min(0.1, 2.0 * step)
        if max(y, default=0.0) > ESCAPED * first:
            return None, share, True
    return y, 1.0, False


def _grows(equations: Lengths, y: Y, share: float, first: float) -> bool:
    """Whether the solution ends because it grows without bound, rather than meets another one."""
    change = _tangent(equations.scaled(share), equations, y)
    size = max(y, default=0.0)
    return size > 1e4 * first or (change is not None and max(map(abs, change)) * SHORTEST > 0.1 * size)


def _moved(equations: Lengths, y: Y, share: float, ahead: float) -> Y | None:
    """The solution a step on: predicted along the tangent, corrected; None where the step was too long."""
    target = equations.scaled(ahead)
    change = _tangent(equations.scaled(share), equations, y)
    start = y if change is None else tuple(a + (ahead - share) * b for a, b in zip(y, change, strict=True))
    found = newton(target, start)
    if found is None or min(found, default=0.0) < -1e-10 * scale_at(target, found):
        return None
    reach = 0.3 * (max(y, default=0.0) or 1.0)
    if max((abs(a - b) for a, b in zip(found, y, strict=True)), default=0.0) > reach:
        return None
    off = max((abs(a - b) for a, b in zip(found, start, strict=True)), default=0.0)
    return found if off <= 0.1 * reach else None


def _tangent(here: Lengths, whole: Lengths, y: Y) -> list[float] | None:
    """Derivative of the solution by the share of friction."""
    right = []
    for now, forms in zip(here.vectors, whole.vectors, strict=True):
        v = vector(now, y)
        size = math.hypot(*v) or 1.0
        slope = [sum(a * x for a, x in zip(form[1:], y, strict=True)) for form in forms]
        right.append(sum(a * b for a, b in zip(v, slope, strict=True)) / size)
    return solve_square(slopes(here, y), right)
