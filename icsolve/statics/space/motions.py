"""The motions that the joints leave to the bodies, and the power of the loads on them.

A twist is (velocity of the point at the origin of the frame, angular velocity); all motions are those on
which no joint does work.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from icsolve.numbers.sparse import Row, eliminate
from icsolve.statics.space.loading import Wrenched, acting
from icsolve.statics.space.ties import Tie
from icsolve.statics.space.vectors import ZERO, Vec, add, cross, dot, size, sub, times

Twist = tuple[Vec, Vec]
STILL: Twist = (ZERO, ZERO)

NOTHING = 1e-12
"""Power below this fraction of what force and speed could make is none (rounding)."""
NEARLY = 1e-5
"""Known loads that balance to this fraction of their own size are taken as balanced, and it is said."""


def motions_of(links: Sequence[str], ties: Sequence[Tie]) -> tuple[dict[str, Twist], ...]:
    """A basis of the motions of ``links``, each scaled to a largest component of 1."""
    place = {link: 6 * n for n, link in enumerate(links)}
    rows = [_row(tie, wrench, place) for tie in ties for wrench in tie.units]
    general = eliminate(rows, 6 * len(links))
    motions = []
    for free in general.free:
        x = {c: row.get(free, 0.0) for c, row in general.solved.items()}
        x[free] = 1.0
        largest = max(map(abs, x.values()))
        motions.append({link: _twist(x, at, largest) for link, at in place.items()})
    return tuple(motions)


def _row(tie: Tie, wrench: tuple[Vec, Vec], place: Mapping[str, int]) -> Row:
    """The power of a unit of a tie, in the components of all twists."""
    force, couple = wrench
    row: Row = {}
    for link, sign in ((tie.on, 1.0), (tie.by, -1.0)):
        if link in place:
            parts = (*force, *add(couple, cross(tie.at, force)))
            row.update({place[link] + n: sign * part for n, part in enumerate(parts) if part})
    return row


def _twist(x: Mapping[int, float], at: int, largest: float) -> Twist:
    a, b, c, d, e, f = (x.get(at + n, 0.0) / largest for n in range(6))
    return (a, b, c), (d, e, f)


def relative(motion: Mapping[str, Twist], on: str, by: str) -> Twist:
    """Twist of one link as another sees it."""
    (v, w), (p, q) = motion.get(on, STILL), motion.get(by, STILL)
    return sub(v, p), sub(w, q)


def velocity(twist: Twist, at: Vec) -> Vec:
    """Velocity of a point."""
    return add(twist[0], cross(twist[1], at))


class Power(NamedTuple):
    """Power of a load, per unit of its root's number, on a motion; and what it could be at most."""

    value: float
    most: float


def power_of(w: Wrenched, motion: Mapping[str, Twist]) -> Power:
    """Power of a load on a motion; zero where it is rounding."""
    force, couple = acting(w)
    twist = relative(motion, w.load.link, w.against)
    value = dot(force, velocity(twist, w.at)) + dot(couple, twist[1])
    fastest = max((size(v) + size(o) * (1.0 + size(w.at)) for v, o in motion.values()), default=0.0)
    most = (size(force) + size(couple)) * fastest
    return Power(value if abs(value) > NOTHING * most else 0.0, most)


def combined(motions: Sequence[Mapping[str, Twist]], shares: Sequence[float]) -> dict[str, Twist]:
    """A sum of motions."""
    total: dict[str, Twist] = {}
    for motion, share in zip(motions, shares, strict=True):
        for link, (v, w) in motion.items():
            p, q = total.get(link, STILL)
            total[link] = (add(p, times(share, v)), add(q, times(share, w)))
    return total


class Balance(NamedTuple):
    """The unknown loads by power, in case units; ``free`` are those that it leaves open.

    ``left`` is, for each motion, the power that is not balanced, and what it is summed from.
    """

    unknowns: dict[str, float]
    free: tuple[str, ...]
    left: tuple[tuple[float, float], ...]

    @property
    def unbalanced(self) -> tuple[float, ...]:
        """The power left on each motion; zero where it is rounding."""
        return tuple(rest if abs(rest) > NOTHING * most else 0.0 for rest, most in self.left)

    @property
    def off(self) -> float:
        """The largest power left, as a fraction of what it is summed from."""
        rests = zip(self.unbalanced, self.left, strict=True)
        return max((abs(rest) / most for rest, (_, most) in rests if rest), default=0.0)


def balance_of(
    motions: Sequence[Mapping[str, Twist]], loads: Sequence[Wrenched], roots: Sequence[str]
) -> Balance:
    """The unknown loads that make the power of all loads zero on every motion."""
    table = [[power_of(w, motion) for w in loads] for motion in motions]
    rows = [_equation(powers, loads, roots) for powers in table]
    general = eliminate(rows, len(roots))
    values = {root: general.of(n).get(len(roots), 0.0) for n, root in enumerate(roots)}
    free = tuple(roots[n] for n in general.free)
    return Balance(values, free, tuple(_left(powers, loads, values) for powers in table))


def _equation(powers: Sequence[Power], loads: Sequence[Wrenched], roots: Sequence[str]) -> Row:
    row: Row = {}
    for power, w in zip(powers, loads, strict=True):
        column = len(roots) if w.known is not None else roots.index(w.root)
        amount = power.value * (1.0 if w.known is None else w.known)
        if amount:
            row[column] = row.get(column, 0.0) + amount
    return row


def _left(
    powers: Sequence[Power], loads: Sequence[Wrenched], values: Mapping[str, float]
) -> tuple[float, float]:
    numbers = [values[w.root] if w.known is None else w.known for w in loads]
    terms = [(p.value * n, p.most * abs(n)) for p, n in zip(powers, numbers, strict=True)]
    return math.fsum(value for value, _ in terms), math.fsum(most for _, most in terms)
