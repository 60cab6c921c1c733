"""Equilibrium of every body in space: sums of forces and of moments, linear in what the joints transmit.

Bounds of the unknown loads' errors: the residual of every equation, weighed by a motion.

A motion that the joints allow is the adjoint solution of the equilibrium: what is left of an equation, and
the rounding of its terms, does power on it; divided by the power of a unit of the unknown load that is the
error of its value (to first order).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from icsolve.numbers.linear import inverse
from icsolve.numbers.sparse import General, Row, eliminate
from icsolve.statics.equilibrium import ROUNDINGS, independent
from icsolve.statics.space.figure import Vec, add, cross, sub, times
from icsolve.statics.space.power import (
    SpatialBalance,
    Twist,
    Wrenched,
    acting,
    is_unknown,
    power_of,
    scale_of,
    velocity,
)
from icsolve.statics.space.reaction_basis import SpatialTie, Wrench

SPENT_TRIES = (1e-13, 1e-12, 1e-11, 1e-10, 1e-14)
"""Below these fractions of its size the largest entry of a row counts as rounding: the usual one first."""


class SpatialStatics(NamedTuple):
    """The general solution of the equilibrium of all bodies but the frame.

    Column numbers: the units of the ties from ``first[t]`` on, then the parameters: the known loads
    together (``known``, times ``scale``), then the unknown loads ``roots`` (theirs times ``scale``).
    """

    ties: tuple[SpatialTie, ...]
    first: tuple[int, ...]
    known: int
    roots: tuple[str, ...]
    scale: float
    general: General
    equations: dict[str, tuple[Vec, tuple[Row, ...]]]
    """for each link the point of its moments, and its three forces and three moments"""

    def parameters(self, unknowns: Mapping[str, float]) -> Row:
        """Values of all parameters, from numbers in case units."""
        return {
            self.known: 1.0,
            **{self.known + 1 + n: unknowns[root] * self.scale for n, root in enumerate(self.roots)},
        }

    def columns(self, t: int) -> range:
        """The columns of a tie."""
        return range(self.first[t], self.first[t] + len(self.ties[t].units))

    def value(self, column: int, parameters: Mapping[int, float]) -> float:
        """A joint's unknown, scaled, where the free columns are zero."""
        return math.fsum(a * parameters.get(c, 0.0) for c, a in self.general.of(column).items())


def statics_of(
    links: Sequence[str], ties: tuple[SpatialTie, ...], loads: Sequence[Wrenched], freedoms: int
) -> SpatialStatics:
    """Solve the equilibrium of ``links`` for what the ties transmit.

    ``freedoms`` is how many equations have to lose all joints: rounding that hides it is seen through.
    """
    first, known = _columns(ties)
    roots = tuple(w.root for w in loads if is_unknown(w.load))
    scale = scale_of(loads)
    equations = _equations(links, ties, first, loads, roots, known, scale)
    rows = [row for _, six in equations.values() for row in six]
    general = eliminate(rows, known)
    for spent in SPENT_TRIES[1:]:
        if len(general.left) == freedoms:
            break
        other = eliminate(rows, known, spent)
        general = other if len(other.left) == freedoms else general
    return SpatialStatics(ties, first, known, roots, scale, general, equations)


def _columns(ties: Sequence[SpatialTie]) -> tuple[tuple[int, ...], int]:
    """The first column of each tie, and their number."""
    first, column = [], 0
    for tie in ties:
        first.append(column)
        column += len(tie.units)
    return tuple(first), column


def _equations(
    links: Sequence[str],
    ties: Sequence[SpatialTie],
    first: Sequence[int],
    loads: Sequence[Wrenched],
    roots: Sequence[str],
    known: int,
    scale: float,
) -> dict[str, tuple[Vec, tuple[Row, ...]]]:
    """Six equations a link; the moments are taken about a point of its own."""
    rows = _SpatialRows(links, ties)
    for tie, column in zip(ties, first, strict=True):
        for n, wrench in enumerate(tie.units):
            rows.between(tie.on, tie.by, tie.at, wrench, column + n)
    for w in loads:
        force, couple = acting(w)
        column = known if w.known is not None else known + 1 + roots.index(w.root)
        share = 1.0 if w.known is None else w.known * scale
        wrench = (times(share, force), times(share, couple))
        rows.between(w.load.link, w.against, w.at, wrench, column)
    return {link: (rows.about[link], six) for link, six in rows.rows.items()}


class _SpatialRows:
    """The equations while they are summed."""

    def __init__(self, links: Sequence[str], ties: Sequence[SpatialTie]) -> None:
        self.about: dict[str, Vec] = {}
        for tie in ties:
            self.about.setdefault(tie.on, tie.at)
            self.about.setdefault(tie.by, tie.at)
        self.rows: dict[str, tuple[Row, ...]] = {link: tuple({} for _ in range(6)) for link in links}

    def between(self, on: str, by: str, at: Vec, wrench: Wrench, column: int) -> None:
        """A force and couple on one link, the opposite on the other."""
        force, couple = wrench
        self.add(on, at, force, couple, column)
        self.add(by, at, times(-1.0, force), times(-1.0, couple), column)

    def add(self, link: str, at: Vec, force: Vec, couple: Vec, column: int) -> None:
        """A force and couple at a point of a link."""
        if link not in self.rows:
            return
        moment = add(couple, cross(sub(at, self.about[link]), force))
        for row, value in zip(self.rows[link], (*force, *moment), strict=True):
            if value:
                row[column] = row.get(column, 0.0) + value


Terms = dict[str, tuple[tuple[float, float], ...]]
"""For each link, of its six equations: the sum of absolute terms, and the sum (scaled forces)."""


class Bounds(NamedTuple):
    """``of`` has a bound for each unknown load, in case units; ``residual`` is a part of the largest term."""

    of: dict[str, float]
    residual: float


def bounds_of(
    statics: SpatialStatics,
    motions: Sequence[Mapping[str, Twist]],
    loads: Sequence[Wrenched],
    balance: SpatialBalance,
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


def _terms(statics: SpatialStatics, balance: SpatialBalance) -> Terms:
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
    statics: SpatialStatics, motion: Mapping[str, Twist], loads: Sequence[Wrenched], terms: Terms
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
