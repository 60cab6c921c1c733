"""Statics with friction, reduced to the equations of the rubs alone.

Every joint force is affine in the unknown loads and the frictions; the equations in which no joint is
left (the sums of power) give the unknown loads. With the sense of each rub given, what remains are as
many equations as rubs.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from icsolve.numbers.linear import inverse
from icsolve.numbers.sparse import Row
from icsolve.statics.affine import Form, Lengths, at, fixed_point
from icsolve.statics.agreement import independent
from icsolve.statics.equilibrium import Statics
from icsolve.statics.ties import is_touching

OPEN = 1e-9
"""A share of a force in what the joints leave open that is below this is none (rounding)."""
NOTHING = 1e-13
"""A force of the known loads below this fraction of the largest in any joint is none (rounding)."""


class Reduced(NamedTuple):
    """The equations of the rubs for given senses, and what turns their solution into loads.

    ``loads`` has for each unknown load (scaled) an affine form in y; ``gains`` is the friction of each rub
    over the size of its force.
    """

    equations: Lengths
    loads: tuple[Form, ...]
    gains: tuple[float, ...]

    def friction(self, y: Sequence[float]) -> tuple[float, ...]:
        """Friction at every rub, on the tie's second link; a size below zero is rounding of zero."""
        sizes = (max(at(form, y), 0.0) for form in self.equations.lengths)
        return tuple(gain * size for gain, size in zip(self.gains, sizes, strict=True))

    def load(self, y: Sequence[float]) -> tuple[float, ...]:
        """Unknown loads, scaled."""
        return tuple(at(form, y) for form in self.loads)


def forces_of(statics: Statics) -> tuple[tuple[Row, ...], ...]:
    """The vector that bounds each rub, as combinations of the parameters.

    Raises LookupError, with the tie's number, where equilibrium does not determine it.
    """
    return tuple(tuple(_force(statics, rub.tie, row) for row in rub.normal) for rub in statics.rubs)


def _force(statics: Statics, tie: int, shares: Sequence[float]) -> Row:
    total: Row = {}
    for n, share in enumerate(shares):
        for c, a in statics.general.of(statics.first[tie] + n).items():
            total[c] = total.get(c, 0.0) + share * a
    largest = max(map(abs, total.values()), default=0.0)
    if any(abs(a) > OPEN * max(largest, 1.0) for c, a in total.items() if c < statics.known):
        raise LookupError(tie)
    return total


def loads_from_power(statics: Statics) -> list[Row] | None:
    """Each unknown load by the known loads and the frictions; None where power does not say."""
    count = len(statics.roots)
    columns = [statics.root(n) for n in range(count)]
    others = [statics.known, *(statics.rub(k) for k in range(len(statics.rubs)))]
    rows = [[left.get(c, 0.0) for c in (*columns, *others)] for left in statics.general.left]
    chosen = independent(rows, count)
    by_row = inverse([row[:count] for row in chosen]) if len(chosen) == count else None
    if by_row is None:
        return None
    return [
        {
            c: -sum(a * row[count + n] for a, row in zip(weights, chosen, strict=True))
            for n, c in enumerate(others)
        }
        for weights in by_row
    ]


def reduced(statics: Statics, senses: Sequence[float]) -> Reduced | None:
    """The fixed point of the rubs: y are the sizes of the forces; None where power does not give the loads.

    ``senses`` are those of the rubbing motions of the second links: 1, -1, or 0 for no friction.
    """
    loads = loads_from_power(statics)
    if loads is None:
        return None
    gains = [-sense * rub.limit for sense, rub in zip(senses, statics.rubs, strict=True)]
    roots = {statics.root(n): row for n, row in enumerate(loads)}

    def form(row: Mapping[int, float], least: float = 0.0) -> Form:
        whole = _without(row, roots)
        known = whole.get(statics.known, 0.0)
        friction = (g * whole.get(statics.rub(k), 0.0) for k, g in enumerate(gains))
        return (known if abs(known) > least else 0.0, *friction)

    least = NOTHING * max((abs(form(row)[0]) for row in statics.general.solved.values()), default=0.0)
    vectors = [tuple(form(row, least) for row in rows) for rows in forces_of(statics)]
    return Reduced(fixed_point(vectors, _touching(statics)), tuple(map(form, loads)), tuple(gains))


def _without(row: Mapping[int, float], roots: Mapping[int, Row]) -> Row:
    """A combination with the unknown loads put in."""
    whole: Row = {}
    for c, a in row.items():
        for d, b in roots.get(c, {c: 1.0}).items():
            whole[d] = whole.get(d, 0.0) + a * b
    return whole


def _alone(k: int, n: int, gain: float) -> Form:
    return tuple(gain if j == k + 1 else 0.0 for j in range(n + 1))


def _touching(statics: Statics) -> list[bool]:
    return [is_touching(statics.ties[rub.tie].joint) for rub in statics.rubs]


def reduced_workless(statics: Statics, senses: Sequence[float]) -> Reduced | None:
    """The equations where the one unknown load does no work: the frictions alone balance the known loads.

    y are the sizes of the forces, but for the one whose friction counts most: it follows from the sum of
    power, and the unknown load (scaled) stands in its place. None where no friction does work.
    """
    (left,) = statics.general.left
    gains = [-sense * rub.limit for sense, rub in zip(senses, statics.rubs, strict=True)]
    powers = [left.get(statics.rub(k), 0.0) * gain for k, gain in enumerate(gains)]
    most = max(range(len(powers)), key=lambda k: abs(powers[k]))
    if not powers[most]:
        return None
    others = tuple(-p / powers[most] if k != most else 0.0 for k, p in enumerate(powers))
    length: Form = (-left.get(statics.known, 0.0) / powers[most], *others)
    n = len(gains)
    lengths = tuple(length if k == most else _alone(k, n, 1.0) for k in range(n))
    frictions = tuple(tuple(gain * a for a in form) for form, gain in zip(lengths, gains, strict=True))

    def form(row: Mapping[int, float]) -> Form:
        total = [row.get(statics.known, 0.0)] + [0.0] * n
        total[most + 1] = row.get(statics.root(0), 0.0)
        for k, friction in enumerate(frictions):
            total = [t + row.get(statics.rub(k), 0.0) * a for t, a in zip(total, friction, strict=True)]
        return tuple(total)

    vectors = tuple(tuple(form(row) for row in rows) for rows in forces_of(statics))
    return Reduced(
        Lengths(lengths, vectors, tuple(_touching(statics))), (_alone(most, n, 1.0),), tuple(gains)
    )
