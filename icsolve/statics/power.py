"""Conservation of power: the loads' wrenches on the twists give the unknown loads, a term a load.

In equilibrium the power of all loads is zero for every motion that the joints allow. Each load is a
number times a unit wrench; its factor for a motion is the pairing of that wrench with the relative
twist of the bodies between which it acts.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import reduce
from operator import add, mul, sub
from typing import TYPE_CHECKING

from icsolve.assembly.workspace import PlacedCase
from icsolve.case import Case, ForceVector, Friction, Joint, Like, Load, Number
from icsolve.case.joints import without_friction
from icsolve.errors import SceneError, Status
from icsolve.kinematics.motion import Motions
from icsolve.numbers import (
    FLOATS,
    Arithmetic,
    Scalar,
    Showing,
    decider,
    largest_of,
    sum_of_sizes,
    zero_of,
)
from icsolve.statics.load_wrenches import L, Points, UnitWrench, number_of, number_taken, vector_size
from icsolve.tuples import Generic, LateModule, NamedTuple, replace

if TYPE_CHECKING:
    from icsolve.case.space import Load as SpatialLoad
    from icsolve.numbers import linear
    from icsolve.numbers.tape import Tape
else:
    linear = LateModule("icsolve.numbers.linear")


class PowerFactors(NamedTuple, Generic[L]):
    """Factors of every load for every motion, in the plane or in space.

    Attributes
    ----------
    wrenches : n loads
    factors : (motions, n), the power of a load per unit of its number, over its ``measure``
    sizes : (motions, n), what that would be summed from if its links moved as fast as the fastest, against
        which a zero is judged
    """

    wrenches: tuple[UnitWrench[L], ...]
    factors: tuple[tuple[Scalar, ...], ...]
    sizes: tuple[tuple[float, ...], ...]


Balance = PowerFactors[Load]
"""Of a case in the plane."""


def balance(
    all_wrenches: Sequence[UnitWrench[L]], twists: Mapping[str, Sequence[tuple[Scalar, ...]]], motions: int
) -> PowerFactors[L]:
    """Factors of the loads on the twists of their links.

    Parameters
    ----------
    all_wrenches : as of `wrenches`
    twists : by link, ``motions`` twists (3,) or (6,) relative to the frame [frame length/s, rad/s]
    motions : number of freedoms
    """
    factors, sizes = [], []
    for m in range(motions):
        row, scale = [], []
        fastest = largest_of([x for ts in twists.values() for x in ts[m]])
        for load, against, unit, gain, _, _, _, _, reach in all_wrenches:
            relative = map(sub, twists[load.link][m], twists[against][m])
            row.append(gain * reduce(add, map(mul, unit, relative)))
            scale.append(reach * sum_of_sizes(unit) * fastest)
        factors.append(tuple(row))
        sizes.append(tuple(scale))
    return PowerFactors(tuple(all_wrenches), tuple(factors), tuple(sizes))


class Solution(NamedTuple):
    """Values of the unknown loads, or why there are none.

    Attributes
    ----------
    verdict : ``balanced``; ``no value`` / ``any value`` (an unknown does no work; the known loads do, do
        not), ``too few unknowns`` or ``too many unknowns``
    values : by name [case units]; what vanishes is the zero of its arithmetic (`zero_of`)
    idle : the motions in which no load does work
    culprit : of ``no value`` and the like, the load that it is about
    """

    verdict: str
    values: dict[str, Scalar]
    idle: tuple[int, ...] = ()
    culprit: str = ""

    @property
    def is_workless(self) -> bool:
        """Whether an unknown load does no work."""
        return self.verdict in ("no value", "any value")


class PowerRow(NamedTuple):
    """The equation of power of a motion: of each unknown, then of the known loads together.

    Attributes
    ----------
    values : the factor of each unknown, and the power of the known loads [scaled]
    sizes : what these are summed from
    zero : the places of those that are zero
    """

    values: list[Scalar]
    sizes: list[float]
    zero: set[int]


def solve_balance(b: Balance, arithmetic: Arithmetic) -> Solution:
    """The unknown loads from the sums of power of all motions (principle of virtual power).

    In equilibrium the power of all loads is zero in every motion: as many linear equations as freedoms.

    Returns
    -------
    Solution
        With a verdict in the place of values where they are not determined.

    Raises
    ------
    SceneError
        ``near-singular`` where the equations can't be told from dependent ones.
    MoreDigits
        Of balls, where a zero is open.
    """
    unknown, scale, rows = power_rows(b, arithmetic)
    idle = tuple([m for m, row in enumerate(rows) if len(row.zero) > len(unknown)])
    working = [row for m, row in enumerate(rows) if m not in idle]
    if (len(working), len(unknown)) != (1, 1):
        return _solved_many(working, unknown, scale, idle, arithmetic)
    (factor, known), root = working[0].values, unknown[0].root
    if 0 in working[0].zero:
        return Solution("no value", {}, idle, root)
    return Solution("balanced", {root: -known / factor / scale / unknown[0].measure}, idle)


def unknown_loads(b: PowerFactors[L]) -> list[UnitWrench[L]]:
    """The loads whose own number is to find."""
    return [w for w in b.wrenches if w.number is None and w.root == w.load.name]


def power_rows(
    b: PowerFactors[L], arithmetic: Arithmetic
) -> tuple[list[UnitWrench[L]], float, list[PowerRow]]:
    """The unknown loads, `force_scale`, and the equation of power of every motion, in the unknown loads over
    their ``measure``, all times that scale."""
    unknown, scale = unknown_loads(b), force_scale(b)
    place = {w.root: k for k, w in enumerate(unknown)}
    shares = []
    for w in b.wrenches:
        k = place.get(w.root)
        if k is None:
            shares.append((len(unknown), _known(w, scale, arithmetic)))
        else:
            shares.append((k, w.ratio))  # of the same kind, so of the same measure
    both = zip(b.factors, b.sizes, strict=True)
    rows = [_row(shares, factors, sizes, len(unknown) + 1, arithmetic) for factors, sizes in both]
    return unknown, scale, rows


def is_unknown(load: Load | SpatialLoad) -> bool:
    """Whether a load's own number is to find; what is given by components has none."""
    return getattr(load, "value", 0.0) is None


def loads_to_find(case: Case) -> list[str]:
    """Names of the loads that have an answer: the unknown ones, and those that are as large as one."""
    by_name = {load.name: load for load in case.loads}
    return [n for n, load in by_name.items() if is_unknown(by_name[number_taken(load, by_name, FLOATS)[0]])]


def has_number(load: Load) -> bool:
    """Whether a load's own number is known, and not zero."""
    if isinstance(load, ForceVector):
        return vector_size(load.parts) > 0.0
    return load.value is not None and not isinstance(load.value, Like) and load.value.value != 0.0


def friction_of(joint: Joint) -> Friction | None:
    """A joint's friction, where its coefficient is not zero."""
    friction = joint.friction
    return friction if friction is not None and friction.mu.value > 0.0 else None


def has_friction(case: Case) -> bool:
    """Whether a joint, a rope or a screw has friction."""
    ropes = any(rope.slips for rope in case.ropes) or any(screw.rubs for screw in case.screws)
    return ropes or any(map(friction_of, case.joints))


def smooth(case: Case) -> Case:
    """The case without friction."""
    ropes = tuple(rope._replace(mu=(None,) * len(rope.mu)) for rope in case.ropes)
    return replace(case, joints=tuple(map(without_friction, case.joints)), ropes=ropes)


def force_scale(b: PowerFactors[L]) -> float:
    """A power of two that brings the largest known load near 1, so that nothing overflows."""
    most = 0.0
    for _, _, _, gain, _, _, measure, number, _ in b.wrenches:
        if number:
            value = number.value if isinstance(number, Number) else vector_size(number)
            most = max(most, abs(value) * abs(gain) * measure)
    # of loads of 1e-308 no double is one over them
    return math.ldexp(1.0, min(-math.frexp(most)[1], 1023)) if 0.0 < most < math.inf else 1.0


def known_value(w: UnitWrench[L]) -> float | None:
    """The number of a load in its own case unit; None where it hangs on an unknown."""
    return number_of(w, FLOATS) if w.number else None


def _known(w: UnitWrench[L], scale: float, arithmetic: Arithmetic) -> Scalar:
    """The number of a known load, scaled."""
    return number_of(w, arithmetic) * scale * w.measure * w.ratio


def load_value(w: UnitWrench[L], values: Mapping[str, Scalar], a: Arithmetic) -> Scalar:
    """The number of a load, known or found (``values``, by the load that has it), in its own unit."""
    return w.ratio * (values[w.root] if w.root in values else number_of(w, a))


def advantage(wrenches: Sequence[UnitWrench[L]], values: Mapping[str, Scalar], a: Showing) -> float | None:
    """unknown / known where there is one of each and the known one is not zero."""
    if len(wrenches) != 2 or (wrenches[0].root in values) == (wrenches[1].root in values):
        return None
    ours, known = wrenches if wrenches[0].root in values else wrenches[::-1]
    above, below = load_value(ours, values, a), load_value(known, values, a)
    return None if below == 0.0 else a.rounded(above / below)[0]


def _row(
    shares: Sequence[tuple[int, Scalar]],
    factors: Sequence[Scalar],
    sizes: Sequence[float],
    columns: int,
    arithmetic: Arithmetic,
) -> PowerRow:
    """The equation of power of one motion, the known loads scaled."""
    sums: list[Scalar] = [0.0] * columns
    terms = [0.0] * columns
    for (k, amount), factor, size in zip(shares, factors, sizes, strict=True):
        sums[k] = sums[k] + amount * factor
        terms[k] += abs(amount) * size
    zero = {k for k, size in enumerate(terms) if arithmetic.vanishes(sums[k], size)}
    for k in zero:
        sums[k] = zero_of(sums[k])
    return PowerRow(sums, terms, zero)


def _solved_many(
    powers: Sequence[PowerRow],
    unknown: Sequence[UnitWrench[L]],
    scale: float,
    idle: tuple[int, ...],
    arithmetic: Arithmetic,
) -> Solution:
    roots = [w.root for w in unknown]
    # over powers of two that bring their largest entries near 1
    sizes = [math.ldexp(1.0, math.frexp(max(map(abs, row.values)))[1]) for row in powers]
    count, rows = len(roots), [[v / s for v in row.values] for row, s in zip(powers, sizes, strict=True)]
    free = linear.null_space(rows, count + 1, 1e-13, vanishes=decider(arithmetic), among=count)
    whole = linear.null_space(rows, count + 1, 1e-13, vanishes=decider(arithmetic))
    if whole.rank > free.rank:
        verdict = "no value" if free.rank < count and len(rows) <= count else "too few unknowns"
        return Solution(verdict, {}, idle, _workless(powers, roots))
    if free.rank < count:
        verdict = "too many unknowns" if count > len(rows) + len(idle) else "any value"
        return Solution(verdict, {}, idle, _workless(powers, roots))
    if not whole.basis or not roots:
        return Solution("balanced", dict.fromkeys(roots, 0.0), idle)
    (vector,) = free.basis  # divided by what the unknowns do: where known loads cancel it has no pole
    if abs(vector[-1]) == 0.0:
        raise SceneError(
            Status.NEAR_SINGULAR, "the equations of power of the motions can't be told from dependent ones"
        )
    most = max(map(abs, vector))
    values: dict[str, Scalar] = {}
    for k, w in enumerate(unknown):
        zero = arithmetic.vanishes(vector[k], most)
        value = vector[k] / (vector[-1] * scale * w.measure)
        values[w.root] = zero_of(value) if zero else value
    return Solution("balanced", values, idle)


def _workless(rows: Sequence[PowerRow], roots: Sequence[str]) -> str:
    """The first unknown that does no work in any motion, if there is one; else the first."""
    idle = (root for k, root in enumerate(roots) if all(k in row.zero for row in rows))
    return next(idle, roots[0] if roots else "")


CANCELLED = 1e-7
"""Known loads whose powers leave less than this fraction of them all but cancel."""


def power_of(w: UnitWrench[L], factor: float) -> float:
    """The power of a load that does ``factor`` a unit, in floats [case units times the motion's speed]; 0 of
    one that hangs on an unknown."""
    return float(number_of(w, FLOATS)) * float(w.ratio) * factor * w.measure


def known_sizes(b: PowerFactors[L], motion: int) -> tuple[float, float]:
    """The power of the known loads in a motion, and the sum of its terms' sizes, as `power_of`."""
    powers = [power_of(w, float(f)) for w, f in zip(b.wrenches, b.factors[motion], strict=True)]
    return sum(powers), sum(map(abs, powers))


def known_terms(
    b: PowerFactors[L], twists: Mapping[str, Sequence[tuple[Scalar, ...]]], motion: int
) -> tuple[float, float]:
    """As `known_sizes`, each component of a load apart: where its point stands still they cancel one another,
    and so do the terms of a spring's stretch."""
    left = size = 0.0
    for w, factor in zip(b.wrenches, b.factors[motion], strict=True):
        if w.number:
            relative = map(sub, twists[w.load.link][motion], twists[w.against][motion])
            terms = sum(abs(float(u) * float(v)) for u, v in zip(w.unit, relative, strict=True))
            left += power_of(w, float(factor))
            size += abs(power_of(w, w.reach * terms))
    return left, size


def known_power(b: Balance, m: int, arithmetic: Arithmetic) -> Scalar:
    """The power of the known loads in motion m [force units times frame length, a unit of the motion], times
    `force_scale`.
    """
    scale = force_scale(b)
    total: Scalar = 0.0
    for w, factor in zip(b.wrenches, b.factors[m], strict=True):
        if w.number:
            total = total + _known(w, scale, arithmetic) * factor
    return total


class Outcome(NamedTuple):
    """A scene in one arithmetic: its place, motions, the sum of power and what it gives."""

    place: PlacedCase
    motions: Motions
    balance: Balance
    solution: Solution

    @property
    def points(self) -> Points:
        """By name [frame]."""
        return self.place.points


class Value(NamedTuple):
    """An unknown load and the bound on its error; None with the reason where none is proven."""

    value: float
    error: float | None
    why: str = ""


class Bounded(NamedTuple):
    """A scene evaluated on a tape: its values carry their derivatives, and bounds of first order."""

    outcome: Outcome
    tape: Tape

    def of(self, value: Scalar) -> float:
        """Bound on the absolute error of a value on the tape."""
        return self.tape.bound(value)
