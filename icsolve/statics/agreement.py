"""The unknown loads from free bodies alone, against those from power."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from icsolve.answer.bodies import Witness
from icsolve.errors import SceneError, Status
from icsolve.numbers.linear import inverse, solve_square
from icsolve.screws.plane import velocity
from icsolve.statics.equilibrium import Statics, Terms
from icsolve.statics.power import Balance
from icsolve.statics.ties import Position

AGREE = 1e-9
"""Power and free bodies may differ by this fraction of the largest term, or by the bound if that is more."""
ROUNDINGS = 32 * 2.0**-53
"""What the operations from a point to a term of an equation can lose together, of the term."""


def unknowns_of(statics: Statics, friction: Mapping[int, float] | None = None) -> dict[str, float] | None:
    """The unknown loads (case units) from the equations in which no joint is left.

    None where these do not determine them. ``friction`` has the values of the friction columns.
    """
    fixed = {statics.known: 1.0, **(friction or {})}
    columns = [statics.root(n) for n in range(len(statics.roots))]
    rows = [
        [*(left.get(c, 0.0) for c in columns), -sum(a * fixed.get(c, 0.0) for c, a in left.items())]
        for left in statics.general.left
    ]
    rows = independent(rows, len(columns))
    if len(rows) < len(columns):
        return None
    values = solve_square([row[:-1] for row in rows], [row[-1] for row in rows])
    if values is None:
        return None
    return {root: value / statics.scale for root, value in zip(statics.roots, values, strict=True)}


def independent(rows: Sequence[Sequence[float]], count: int) -> list[list[float]]:
    """As many rows as there are unknowns (the first ``count`` entries), those with most to say about them."""
    work = [(row, list(row)) for row in map(list, rows)]
    chosen = []
    for _ in range(min(count, len(work))):
        _, r, c = max((abs(left[c]), r, c) for r, (_, left) in enumerate(work) for c in range(count))
        row, pivot = work.pop(r)
        chosen.append(row)
        if pivot[c]:
            for _, left in work:
                ratio = left[c] / pivot[c]
                left[:] = [a - ratio * b for a, b in zip(left, pivot, strict=True)]
                left[c] = 0.0
    return chosen


def bounds_of(position: Position, statics: Statics, balance: Balance, terms: Terms) -> dict[str, float]:
    """What rounding can make of the difference between power and free bodies, for each unknown load.

    The residual of every equation, and the rounding of its terms, does power on the motions; divided by
    the power of a unit of the unknown that is its error (the motions are the adjoint solution).
    """
    columns = [[n for n, w in enumerate(balance.wrenches) if w.root == root] for root in statics.roots]
    rows = []
    for m, factors in enumerate(balance.factors):
        both = zip(balance.wrenches, factors, strict=True)
        powers = [float(w.ratio) * float(f) * w.measure for w, f in both]
        row = [sum(powers[n] for n in ns) for ns in columns]
        rows.append([*row, _lost(position, terms, m)])
    rows = independent(rows, len(columns))
    by_motion = inverse([row[:-1] for row in rows]) if len(rows) == len(columns) else None
    if by_motion is None:
        return dict.fromkeys(statics.roots, float("inf"))
    lost = [row[-1] / statics.scale for row in rows]
    sums = [sum(abs(a) * p for a, p in zip(row, lost, strict=True)) for row in by_motion]
    return dict(zip(statics.roots, sums, strict=True))


def _lost(position: Position, terms: Terms, motion: int) -> float:
    """Power of the residuals and of the roundings of all equations on a motion."""
    lost = 0.0
    for link, (about, equations) in terms.items():
        twist = position.twists[link][motion]
        vx, vy = velocity(twist, about)
        for speed, (size, rest) in zip((vx, vy, twist[2]), equations, strict=True):
            lost += abs(speed) * (ROUNDINGS * size + abs(rest))
    return lost


def witnesses(
    power: Mapping[str, tuple[float, float]], bodies: Mapping[str, float], bounds: Mapping[str, float]
) -> tuple[Witness, ...]:
    """Both values of each unknown beside each other; that of power comes with its own bound."""
    return tuple(
        Witness(q, power[q][0], value, value - power[q][0], bounds[q] + power[q][1])
        for q, value in bodies.items()
    )


def refuse_apart(found: Sequence[Witness], slack: float) -> None:
    """Refuse a scene in which power and free bodies disagree by more than their bounds."""
    for w in found:
        room = max(w.bound, max(AGREE, slack) * max(abs(w.power), abs(w.bodies)))
        if not abs(w.difference) <= room:
            raise SceneError(Status.NEAR_SINGULAR, _apart(w))


def _apart(w: Witness) -> str:
    return (
        f"power gives {w.load} = {w.power:.9g} and the equilibrium of the links {w.bodies:.9g}: they should "
        "be one number, so this position is too near to a singular one. Take another position, or give its "
        "data with more digits."
    )
