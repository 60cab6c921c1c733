"""Bounds of the unknown loads' errors: the residual of every equation, weighed by a motion.

A motion that the joints allow is the adjoint solution of the equilibrium: what is left of an equation, and
the rounding of its terms, does power on it; divided by the power of a unit of the unknown load that is the
error of its value (to first order).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from icsolve.numbers.linear import inverse
from icsolve.statics.agreement import ROUNDINGS, independent
from icsolve.statics.space.equilibrium import Statics
from icsolve.statics.space.loading import Wrenched
from icsolve.statics.space.motions import Balance, Twist, power_of, velocity

Terms = dict[str, tuple[tuple[float, float], ...]]
"""For each link, of its six equations: the sum of absolute terms, and the sum (scaled forces)."""


class Bounds(NamedTuple):
    """``of`` has a bound for each unknown load, in case units; ``residual`` is a part of the largest term."""

    of: dict[str, float]
    residual: float


def bounds_of(
    statics: Statics, motions: Sequence[Mapping[str, Twist]], loads: Sequence[Wrenched], balance: Balance
) -> Bounds:
    """How far rounding can have moved each unknown load."""
    terms = _terms(statics, balance)
    sums = [both for equations in terms.values() for both in equations]
    largest = max((size for size, _ in sums), default=0.0) or 1.0
    residual = max((abs(rest) for _, rest in sums), default=0.0) / largest
    rows = [_row(statics, motion, loads, terms) for motion in motions]
    count = len(statics.roots)
    chosen = independent(rows, count)
    by_motion = inverse([row[:-1] for row in chosen]) if len(chosen) == count else None
    if by_motion is None:
        return Bounds(dict.fromkeys(statics.roots, math.inf), residual)
    lost = [row[-1] / statics.scale for row in chosen]
    errors = [sum(abs(a) * p for a, p in zip(row, lost, strict=True)) for row in by_motion]
    return Bounds(dict(zip(statics.roots, errors, strict=True)), residual)


def _terms(statics: Statics, balance: Balance) -> Terms:
    """What the equations of every link are summed from, in the solution."""
    parameters = statics.parameters(balance.unknowns)
    x = {c: statics.value(c, parameters) for c in range(statics.known)} | parameters
    return {
        link: _summed([[a * x[c] for c, a in row.items()] for row in six])
        for link, (_, six) in statics.equations.items()
    }


def _summed(rows: Sequence[Sequence[float]]) -> tuple[tuple[float, float], ...]:
    """Size and sum of each equation; a moment is as uncertain as the forces on the figure's size."""
    sizes = [math.fsum(map(abs, row)) for row in rows]
    force = math.fsum(sizes[:3])
    return tuple(
        (size + (force if n > 2 else 0.0), math.fsum(row))
        for n, (size, row) in enumerate(zip(sizes, rows, strict=True))
    )


def _row(
    statics: Statics, motion: Mapping[str, Twist], loads: Sequence[Wrenched], terms: Terms
) -> list[float]:
    """Powers of the unknown loads on a motion, and that of all residuals and roundings."""
    powers = dict.fromkeys(statics.roots, 0.0)
    for w in loads:
        if w.known is None:
            powers[w.root] += power_of(w, motion).value
    lost = 0.0
    for link, (about, _) in statics.equations.items():
        twist = motion[link]
        speeds = (*velocity(twist, about), *twist[1])
        for speed, (size, rest) in zip(speeds, terms[link], strict=True):
            lost += abs(speed) * (ROUNDINGS * size + abs(rest))
    return [*powers.values(), lost]
