"""The unknown loads from the equilibrium of the links alone, against those from power, and how far rounding
can part the two; in the plane and in space.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from icsolve.answer.bodies import Witness
from icsolve.errors import SceneError, Status, overflow, refuse_overflow
from icsolve.numbers import Scalar, Showing, decider, largest_of
from icsolve.numbers.linear import Row, inverse, solve_square
from icsolve.screws import velocity
from icsolve.statics.equilibrium import Components, Equilibrium, T
from icsolve.statics.load_wrenches import L
from icsolve.statics.power import PowerFactors, known_sizes
from icsolve.tuples import LateModule
from icsolve.wording import plural

if TYPE_CHECKING:
    from icsolve.screws import space
else:
    space = LateModule("icsolve.screws.space")

Terms = dict[str, tuple[Components, tuple[tuple[float, float], ...]]]
"""For each link the point of its moments; of its equations the sum of absolute terms, and the sum."""


def terms_of(statics: Equilibrium[T], parameters: Mapping[int, Scalar]) -> Terms:
    """What the equations of every link are summed from, in the solution with these parameters.

    Raises SceneError (``unsupported``) where that is beyond the range of doubles.
    """
    x = statics.filled(parameters)
    try:
        found = {link: (about, _summed(rows, x)) for link, (about, rows) in statics.equations.items()}
    except (OverflowError, ValueError):  # of `fsum`: beyond the largest number, or inf - inf
        raise overflow("a force between the links") from None
    return found


def _summed(rows: tuple[Row, ...], x: Mapping[int, Scalar]) -> tuple[tuple[float, float], ...]:
    """Size and sum of each equation; a moment is as uncertain as the forces on the figure's size."""
    terms = [[float(a * x[c]) for c, a in row.items()] for row in rows]
    sizes = [sum(map(abs, row)) for row in terms]
    forces = 3 if len(rows) == 6 else 2
    force = sum(sizes[:forces])
    return tuple(
        (size + (force if n >= forces else 0.0), math.fsum(row))
        for n, (size, row) in enumerate(zip(sizes, terms, strict=True))
    )


def residual(terms: Terms) -> float:
    """What is left of the equilibrium of any link, as a fraction of the largest sum of all; 0 where nothing
    acts.
    """
    sums = [both for _, equations in terms.values() for both in equations]
    largest = max((size for size, _ in sums), default=0.0)
    return largest_of([rest for _, rest in sums]) / (largest or 1.0)


AGREE = 1e-9
"""Power and free bodies may differ by this fraction of the largest term, or by the bound if that is more."""
ROUNDINGS = 32 * 2.0**-53
"""What the operations from a point to a term of an equation can lose together, of the term."""


def unknowns_of(statics: Equilibrium[T]) -> dict[str, Scalar] | None:
    """The unknown loads [case units] from the equations in which no joint is left, without friction; None
    where these do not determine them."""
    vanishes = decider(statics.arithmetic)
    columns = [statics.root(n) for n in range(len(statics.roots))]
    rows = [
        [*(left.get(c, 0.0) for c in columns), -left.get(statics.known, 0.0)] for left in statics.general.left
    ]
    rows = independent(rows, len(columns))
    if len(rows) < len(columns):
        return None
    values = solve_square([row[:-1] for row in rows], [row[-1] for row in rows], vanishes)
    if values is None:
        return None
    return {root: value / statics.scale for root, value in zip(statics.roots, values, strict=True)}


def independent(rows: Sequence[Sequence[Scalar]], count: int) -> list[list[Scalar]]:
    """As many rows as there are unknowns (the first ``count`` entries), those with most to say about them.

    Parameters
    ----------
    rows : (m, at least ``count``)

    Returns
    -------
    list[list[Scalar]]
        At most ``count`` of the rows as given, in the order of complete pivoting; fewer where m is less.
    """
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


def bounds_of(
    statics: Equilibrium[T],
    balance: PowerFactors[L],
    twists: Mapping[str, Sequence[Components]],
    terms: Terms,
) -> dict[str, float]:
    """What rounding can make of the difference between power and free bodies, by unknown load [case units].

    The residual of every equation, and the rounding of its terms, does power on the motions, beside the
    rounding of the known loads' own power; divided by the power of a unit of the unknown that is its error
    (the motions are the adjoint solution). inf where the motions do not determine the loads.

    Parameters
    ----------
    statics : as solved
    balance : power of the loads
    twists : by link, one a motion
    terms : of the solution
    """
    count = len(statics.roots)
    powers = powers_of(statics, balance)
    lost = (
        _lost(twists, terms, m) + ROUNDINGS * known_sizes(balance, m)[1] * statics.scale
        for m in range(len(powers))
    )
    rows = independent([[*row, rest] for row, rest in zip(powers, lost, strict=True)], count)
    by_motion = inverse([row[:-1] for row in rows]) if len(rows) == count else None
    if by_motion is None:
        return dict.fromkeys(statics.roots, float("inf"))
    left = [row[-1] / statics.scale for row in rows]
    sums = [sum(abs(a) * p for a, p in zip(row, left, strict=True)) for row in by_motion]
    return dict(zip(statics.roots, sums, strict=True))


def powers_of(statics: Equilibrium[T], balance: PowerFactors[L]) -> list[list[float]]:
    """The power of a unit of each unknown load, (motions, unknowns)."""
    columns = [[n for n, w in enumerate(balance.wrenches) if w.root == root] for root in statics.roots]
    rows = []
    for factors in balance.factors:
        both = zip(balance.wrenches, factors, strict=True)
        powers = [float(w.ratio) * float(f) * w.measure for w, f in both]
        rows.append([sum(powers[n] for n in ns) for ns in columns])
    return rows


def _lost(twists: Mapping[str, Sequence[Components]], terms: Terms, motion: int) -> float:
    """Power of the residuals and of the roundings of all equations on a motion."""
    lost = 0.0
    for link, (about, equations) in terms.items():
        speeds = _speeds(twists[link][motion], about)
        for speed, (size, rest) in zip(speeds, equations, strict=True):
            lost += abs(speed) * (ROUNDINGS * size + abs(rest))
    return lost


def _speeds(twist: Components, at: Components) -> Components:
    """Velocity of the point of a link, then its angular velocity."""
    if len(twist) == 6:
        return (*space.velocity_of(twist, at), *twist[3:])
    x, y, w = twist
    return (*velocity((x, y, w), (at[0], at[1])), w)


def compared(
    power: Mapping[str, tuple[float, float]],
    bodies: Mapping[str, Scalar],
    roundings: Mapping[str, float] | None,
    slack: float,
    statics: Equilibrium[T],
    parameters: Mapping[int, Scalar],
    a: Showing,
) -> tuple[Witness, ...]:
    """Both values of each unknown beside each other, each rounded once: zero is zero in both.

    Parameters
    ----------
    power : value by power and the bound of that, by unknown load [case units]
    bodies : value by the equilibrium of the links alone
    roundings : what rounding can make of the difference; None where the arithmetic knows its own errors
    slack : as `refuse_apart` has it, which raises SceneError where the two disagree
    statics, parameters : the solution, beside whose largest force a load may vanish
    """
    found = []
    for q, x in bodies.items():
        size = _largest(statics, parameters) if getattr(x, "holds_zero", False) else 0.0
        (by_power, bound), (by_bodies, error) = power[q], a.rounded(x, size)
        room = (roundings[q] if roundings else error) + bound
        found.append(Witness(q, by_power, by_bodies, by_bodies - by_power, room))
    refuse_apart(found, slack)
    return tuple(found)


def _largest(statics: Equilibrium[T], parameters: Mapping[int, Scalar]) -> float:
    """The largest of all loads and of what the joints carry [case units]."""
    return max(abs(float(value)) for value in statics.filled(parameters).values()) / statics.scale


def refuse_apart(found: Sequence[Witness], slack: float) -> None:
    """Raise SceneError (``near-singular``) where power and free bodies disagree by more than their bounds,
    ``unsupported`` where the forces on the way are beyond the range of doubles.

    ``slack`` is how far given centres contradict each other [fraction of the figure's size].
    """
    for w in found:
        refuse_overflow(w.load, w.power + w.bodies)
        room = max(w.bound, max(AGREE, slack) * max(abs(w.power), abs(w.bodies)))
        if not abs(w.difference) <= room:
            raise SceneError(Status.NEAR_SINGULAR, _routes_disagree(w))


def _routes_disagree(w: Witness) -> str:
    return (
        f"power gives {w.load} = {w.power:.9g} and the equilibrium of the links {w.bodies:.9g}: they should "
        "be one number, so this position is too near to a singular one. Take another position, or give its "
        "data with more digits."
    )


def refuse_doubt(freedoms: int, mobility: int) -> None:
    """Refuse a position in which the links' equilibrium and their motions count different freedoms."""
    if freedoms != mobility:
        raise SceneError(
            Status.NEAR_SINGULAR,
            f"by its motions the mechanism has {plural(mobility, 'degree')} of freedom, by the "
            f"equilibrium of its links {freedoms}: this position is too near to a singular one. Take another "
            "position, or give its data with more digits.",
        )
