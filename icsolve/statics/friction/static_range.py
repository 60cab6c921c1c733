"""Friction at rest: the range of the unknown load at which the mechanism holds still.

Its ends are the equilibria in which the mechanism is about to move one way and the other, as textbooks have
them. Friction that is not at its limit everywhere, or that a history has left the other way round, can hold
more: the set of values for which any equilibrium exists with every friction within its limit. Where the rubs
have little influence on each other the two are proven to be one, else it is found part by part
(`held_ranges`).

Where the unknown load does no work it presses links together until friction holds: the mechanism holds
where the most that friction can do against the motion that the known loads drive is at least what they do.
The ends of the range are the loads at which it is just that.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import cache, partial
from itertools import pairwise
from typing import TYPE_CHECKING

from icsolve.errors import SceneError, Status
from icsolve.numbers import largest_of
from icsolve.statics.equilibrium import Statics
from icsolve.statics.free_bodies import carrying
from icsolve.statics.friction import PROVEN
from icsolve.statics.friction.equations import (
    NOTHING,
    Reduced,
    at,
    contracted,
    contraction,
    fixed_point,
    forces_of,
    loads_from_power,
    reduced,
    reduced_workless,
    shared_normals,
    without_friction,
)
from icsolve.statics.friction.lifting import pulling
from icsolve.statics.friction.limits import ROUNDED, SHORT, parting, well_told
from icsolve.tuples import LateModule, NamedTuple
from icsolve.wording import listed

if TYPE_CHECKING:
    from icsolve.statics.friction import solutions as every
    from icsolve.statics.friction.held_ranges import HeldRange, HeldRanges, Vertex
else:  # where one is not proven to be the only one
    every = LateModule("icsolve.statics.friction.solutions")

IMPENDING = "only impending motion was looked at"


class End(NamedTuple):
    """An end of the interval.

    Attributes
    ----------
    value : the unknown load [case units], perhaps infinite; not a number where a contact parts before
    senses : (rubs,), those of the motion that is about to begin
    friction : (rubs,) [scaled]; empty where the value is infinite, or not that of an equilibrium about to
        move
    pushes : whether every contact pushes there
    vertex : of an end of linear inequalities, which these are
    statics : whose equilibrium it is, of an end at which the teeth of the wheels push
    locks : whether it is none: a force vanishes there, and on both sides the mechanism locks by it
    """

    value: float
    senses: tuple[float, ...]
    friction: tuple[float, ...] = ()
    pushes: bool = True
    vertex: Vertex | None = None
    statics: Statics | None = None
    locks: bool = False

    def carrying(self, t: int) -> float:
        """Sign of the force in a mesh along its first unit; 1 where nothing is about to move."""
        if self.statics is None or not self.friction:
            return 1.0
        unknowns = {self.statics.roots[0]: self.value}
        return carrying(self.statics, self.statics.parameters(unknowns, self.friction), t)


class StaticRange(NamedTuple):
    """The interval in which a mechanism holds still.

    Attributes
    ----------
    least, most : [case units]; infinite where no value moves the mechanism that way
    possible : the range in which friction within its limits can hold
    how : how that was found: only `PROVEN` is a proof
    ends : those ends at which it is about to move
    again : other ranges in which friction within its limits can hold
    grown : the parts of these, and of what is possible beside the interval, that hold however friction was
        left; None where it is not told apart
    parts : at which ends a contact would have to pull: there it parts, before the end
    presses : the load does no work: it holds by what it presses
    shared : it holds as joints share the load, which equilibrium leaves open, in one way at least
    """

    least: float
    most: float
    possible: tuple[float, float]
    how: str
    ends: tuple[End, ...] = ()
    again: tuple[tuple[float, float], ...] = ()
    grown: tuple[tuple[float, float], ...] | None = None
    parts: tuple[float, ...] = ()
    presses: bool = False
    shared: bool = False

    @property
    def self_locking(self) -> bool:
        """Whether it holds with the unknown at zero, or no value moves it one way."""
        holds = self.least <= 0.0 <= self.most and self.least < self.most
        return not self.presses and (holds or math.isinf(self.least) or math.isinf(self.most))


Within = Callable[[], "HeldRanges"]
"""Finds the ranges in which friction within its limits holds."""
Moving = Callable[[], list[End]]
"""Finds all equilibria that are about to move."""


def static_range(
    statics: Statics, senses: Sequence[float], alone: bool, within: Within, ends: Sequence[End]
) -> StaticRange:
    """The interval of the one unknown load.

    Parameters
    ----------
    statics : of one motion and one unknown load, with friction as parameters
    senses : (rubs,), those of the rubs in the motion, 1, -1 or 0
    ends : where it is about to move so, and the opposite way
    alone : whether what friction that is not about to slip can hold is not looked for
    within : finds where it can

    Returns
    -------
    StaticRange
        Self-locking: it holds with the unknown at zero (against loads), or no value moves it one way.
    """
    locks = all(math.isinf(end.value) for end in ends)  # where contacts push, one way at most
    parts = not all(end.pushes for end in ends) or (locks and _may_part(statics))
    parts = parts or bool(shared_normals(statics))
    if parts or _nothing_presses(statics, senses):
        return of_limits(statics, senses, within(), alone, ends)
    if all(_is_proven(end.statics or statics, senses) for end in ends):
        return range_of(ends)._replace(how=PROVEN)
    if alone and all(math.isfinite(end.value) and not end.locks for end in ends):
        return range_of(ends)
    found = within()
    if not all(_is_held(found, end) for end in ends):  # doubles have lost the range of one about to move
        return range_of(ends)
    own, others = found.nearest(smooth_load(statics) or 0.0)
    moving = cache(partial(_about_to_move, statics, senses))
    told = range_of([_kept(own, end, senses) for end in _past_locks(own, ends, senses, moving)])
    possible = _same_ends(statics, (own.low, own.high), (told.least, told.most))
    return _with_grown(statics, moving, told._replace(possible=possible, how=found.how, again=others))


def _is_held(found: HeldRanges, end: End) -> bool:
    """Whether one of the ranges in which friction within its limits holds has an end about to move."""
    if not math.isfinite(end.value):
        return bool(found.ranges)
    room = SAME * abs(end.value)
    return any(one.low - room <= end.value <= one.high + room for one in found.ranges)


def _kept(own: HeldRange, end: End, senses: Sequence[float]) -> End:
    """An end within a range; where it lies in another one, the end of that range toward it."""
    for value, side, vertex in zip((own.low, own.high), (-1.0, 1.0), own.vertices, strict=True):
        if side * (end.value - value) > SAME * abs(value):
            return End(value, tuple(senses), vertex=vertex)
    return end


def _past_locks(
    own: HeldRange, ends: Sequence[End], senses: Sequence[float], moving: Moving
) -> Iterator[End]:
    """The ends, in the place of one that is none the next beyond: the mechanism is about to move there, or
    friction within its limits holds no farther."""
    sides = zip(sorted(ends, key=lambda end: end.value), (-1.0, 1.0), own[:2], own.vertices, strict=True)
    for end, side, last, vertex in sides:
        if not end.locks:
            yield end
            continue
        beyond = [one for one in moving() if side * end.value < side * one.value < side * last]
        far = min(beyond, key=lambda one: side * one.value, default=None)
        yield far or at_vertex(last, vertex, senses)


def at_vertex(value: float, vertex: Vertex, senses: Sequence[float] = ()) -> End:
    """An end that the limits of friction set, with whether a contact parts there."""
    return End(value, tuple(senses), pushes=not vertex.parts, vertex=vertex)


def _same_ends(
    statics: Statics, values: tuple[float, float], ends: tuple[float, float]
) -> tuple[float, float]:
    """Two ends, each as it is told already where that is the same."""
    low, high = (
        told if value == told or _is_same(statics, told, value) else value
        for value, told in zip(values, ends, strict=True)
    )
    return low, high


def _may_part(statics: Statics) -> bool:
    """Whether there is a contact, which only pushes."""
    return any(tie.joint.only_pushes for tie in statics.ties)


def _nothing_presses(statics: Statics, senses: Sequence[float]) -> bool:
    """Whether the loads press nowhere that rubs in the motion without friction, but for rounding of what the
    known ones alone would: from nothing no friction grows."""
    equations = reduced(statics, senses)
    if equations is None:
        return False
    known = [row.get(statics.known, 0.0) for row in statics.general.solved.values()]
    least = NOTHING * largest_of(known)
    return all(a <= least for a, s in zip(without_friction(equations.equations), senses, strict=True) if s)


def of_limits(
    statics: Statics,
    senses: Sequence[float],
    within: HeldRanges,
    alone: bool,
    ends: Sequence[End] = (),
    toward: float | None = None,
) -> StaticRange:
    """The range, of those in which friction within its limits holds, that is nearest to a load [case units]
    (None: to that without friction). It ends where the mechanism is about to move, or where a contact parts.

    Raises SceneError where there is none.
    """
    smooth = smooth_load(statics) or 0.0
    if not within.ranges:
        raise SceneError(Status.NO_VALUE, _lost(statics, smooth))
    own, others = within.nearest(smooth if toward is None else toward)
    moving = [] if alone else [*(end for end in ends if end.friction), *_about_to_move(statics, senses)]
    told = []
    for value, vertex in zip((own.low, own.high), own.vertices, strict=True):
        room = SAME * abs(value) if math.isfinite(value) else -1.0
        same = (end for end in moving if abs(end.value - value) <= room)
        told.append(next(same, None) or at_vertex(value, vertex, senses))
    return range_of(told)._replace(how=within.how, again=others)


SAME = 1e-9
"""Ends of two ways that differ by less of their size are one."""
LEFT = 1e-12
"""So much of the known loads rounding leaves of an end."""


def smooth_load(statics: Statics) -> float | None:
    """The unknown load that balances without friction [case units]; None where it does no work."""
    loads = loads_from_power(statics)
    return None if loads is None else loads[0].get(statics.known, 0.0) / statics.scale


def _lost(statics: Statics, smooth: float) -> str:
    """Which contacts would have to pull, at the load without friction."""
    root = statics.roots[0]
    lost = pulling(statics, {root: smooth})
    what = f"the contact {listed(lost)}" if lost else "a contact"
    return (
        f"no value of {root} holds: {what} is lost, its normal force would have to pull. The "
        "links part there, and tip or lift off."
    )


def _about_to_move(statics: Statics, senses: Sequence[float]) -> list[End]:
    """All equilibria that are about to move, one way or the other."""
    found = []
    for direction in (1.0, -1.0):
        own = tuple([direction * s for s in senses])
        equations = reduced(statics, own) or reduced_workless(statics, own)
        if equations is not None:
            by = well_told(statics, own, equations)
            roots = every.all_roots(by.equations) or ()
            proper = [y for y in roots if not every.folds(by.equations, y)]
            found += [End(by.load(y)[0] / statics.scale, own, by.friction(y)) for y in proper]
    return found


def range_of(ends: Sequence[End]) -> StaticRange:
    """The interval between equilibria that are about to move one way and the other."""
    least, most = min(end.value for end in ends), max(end.value for end in ends)
    about_to_move = tuple(end for end in ends if math.isfinite(end.value))
    parts = tuple(sorted(end.value for end in ends if not end.pushes))
    return StaticRange(least, most, (least, most), IMPENDING, about_to_move, parts=parts)


def without_ends(found: StaticRange, ends: Sequence[End]) -> StaticRange:
    """A range that goes on without end where it has these."""

    def beyond(value: float) -> float:
        return math.copysign(math.inf, value) if any(value == end.value for end in ends) else value

    least, most, *possible = map(beyond, (found.least, found.most, *found.possible))
    left = tuple(end for end in found.ends if end not in ends)
    return found._replace(least=least, most=most, possible=(possible[0], possible[1]), ends=left)


def end_of(statics: Statics, senses: Sequence[float]) -> End | None:
    """The unknown load at full friction of these senses; None where power does not give it."""
    return None if reduced(statics, senses) is None else impending(statics, senses)


def impending(statics: Statics, senses: Sequence[float]) -> End:
    """The unknown load at full friction of these senses; infinite where the forces grow without bound.

    Raises SceneError where the equilibrium ends and nothing says at which load.
    """
    equations = reduced(statics, senses)
    assert equations is not None
    if contraction(equations.equations) is not None:
        return _moving(statics, equations, senses, contracted(equations.equations))
    by = well_told(statics, senses, equations)
    y, share, grows = every.followed(by.equations)
    if y is not None:
        return _moving(statics, by, senses, y)._replace(locks=every.folds(by.equations, y))
    far = SHORT * share
    short = equations.equations.scaled(far)
    last = every.followed(short)[0] or without_friction(equations.equations)
    change = sum(a * x for a, x in zip(equations.loads[0][1:], last, strict=True))
    pushes = equations.scaled(far).least_push(last) >= -ROUNDED
    if not pushes or (not grows and parting(equations.equations, share) is not None):
        return _before(senses)
    if grows or _locks(equations):
        return End(math.copysign(math.inf, change), tuple(senses))
    raise SceneError(
        Status.UNSUPPORTED,
        f"the equilibrium with friction at rest ends where {share:.3g} of it is used, and neither the forces "
        "grow there nor does a contact part: where the load ends is not known. Give a `motion`, or a smaller "
        "`mu`.",
    )


def _moving(statics: Statics, equations: Reduced, senses: Sequence[float], y: Sequence[float]) -> End:
    """The end at an equilibrium about to move, or where a contact parts before."""
    if equations.least_push(y) < -ROUNDED:
        return _before(senses)
    return End(equations.load(y)[0] / statics.scale, tuple(senses), equations.friction(y))


def _before(senses: Sequence[float]) -> End:
    """An end at which a contact parts before anything moves: the limits of friction say at which load."""
    return End(math.nan, tuple(senses), pushes=False)


def _locks(equations: Reduced) -> bool:
    """Whether friction of these senses can carry itself, however large: y_k <= |B_k y| for some y > 0.

    By power iteration of the homogeneous part, whose growth is then 1 or more.
    """
    forms = equations.equations.vectors
    y = [1.0] * len(forms)
    growth = 0.0
    for _ in range(200):
        grown = [math.hypot(*(at((0.0, *form[1:]), y) for form in three)) for three in forms]
        growth = min((a / b for a, b in zip(grown, y, strict=True) if b > 1e-6), default=0.0)
        size = max(grown, default=0.0)
        if not size:
            return False
        y = [a / size for a in grown]
    return growth >= 1.0


def _is_proven(statics: Statics, senses: Sequence[float]) -> bool:
    """Whether the load changes one way with each friction, whatever the others are.

    With f_k = e_k limit_k |v_k| and e in the cube [-1, 1]^K, the load changes with e_k in proportion to
    s_k + (J^T diag(e limit) lambda)_k, where s is its rate of change with the frictions and J that of the
    sizes. Bounds on J bound the second term; where it is less than s_k the extremes are at corners.
    """
    equations = reduced(statics, [1.0] * len(senses))
    if equations is None or not all(senses):
        return False
    spread = contraction(equations.equations)
    gains = [rub.limit for rub in statics.rubs]
    if spread is None:
        return False
    n = len(gains)
    own = [abs(a) for a in equations.loads[0][1:]]
    factors = [
        [math.hypot(*(f[j + 1] for f in forms)) for j in range(n)] for forms in equations.equations.vectors
    ]
    reach = [sum(spread[k][j] * own[k] for k in range(n)) for j in range(n)]
    return all(sum(factors[k][j] * reach[k] for k in range(n)) < own[j] for j in range(n) if gains[j])


def pressed(statics: Statics, senses: Sequence[float], driven: bool, within: Within) -> StaticRange:
    """The range of an unknown load that does no work; ``senses`` are those of the rubs in the motion, and
    ``driven`` tells whether the known loads do work. Of several ranges that with the largest loads.

    Raises SceneError where nothing drives the mechanism (any value holds) and where none holds it.
    """
    name, found = statics.roots[0], within()
    ends = [end for one in found.ranges for end in (one.low, one.high) if math.isfinite(end)]
    if not (driven or ends):
        raise SceneError(
            Status.ANY_VALUE, f"any value of {name} holds: it does no work, and nothing drives the mechanism."
        )
    if not (found.ranges or _may_part(statics)):
        raise SceneError(
            Status.NO_VALUE, f"no value of {name} holds: the friction that it makes is never enough."
        )
    told = None if _may_part(statics) else _as_it_grows(statics)
    if told is None:
        least = of_limits(statics, senses, found, False, toward=max(ends, default=0.0))
        return least._replace(presses=True)
    own, others = found.nearest(max(0.0, 2.0 * told.least, told.least + 1.0))  # well inside
    possible = _same_ends(statics, (own.low, own.high), (told.least, told.most))
    moving = partial(_about_to_move, statics, senses)
    return _with_grown(statics, moving, told._replace(possible=possible, how=found.how, again=others))


def _as_it_grows(statics: Statics) -> StaticRange | None:
    """From where on friction that is against the motion which the known loads drive is enough: the larger the
    load, the more it presses, unless it presses nowhere; None where it is enough at no load.
    """
    against, drive = _against(statics)
    senses = tuple([-a for a in against])
    equations = reduced_workless(statics, senses) if drive else None
    roots = None if equations is None else every.all_roots(equations.equations)
    if equations is None or roots is None:
        return None
    roots = [y for y in roots if not every.folds(equations.equations, y)]
    if not roots and not _is_enough(statics):
        return None
    end, y = max(((equations.load(y)[0], y) for y in roots), default=(-math.inf, ()))
    about_to_move = (End(end / statics.scale, senses, equations.friction(y)),) if roots else ()
    both = (end / statics.scale, math.inf)
    return StaticRange(*both, both, IMPENDING, ends=about_to_move, presses=True)


def _with_grown(statics: Statics, moving: Moving, told: StaticRange) -> StaticRange:
    """A range with the parts beside it that hold however friction was left, of what friction within its
    limits can hold: they begin and end where it is about to move. Beside the range that is told, and beside
    an end of another at which it is not about to move, friction has to have been left the other way round;
    not where there are two such ends, but for rounding in one place."""
    sides = [(told.most, told.possible[1], False), (told.least, told.possible[0], False)]
    sides = [side for side in sides if side[0] != side[1]]
    if not (sides or told.again):
        return told._replace(grown=())
    about, found = [end.value for end in moving()], list[tuple[float, float]]()
    for low, high in told.again:
        start, end = (low, high) if math.isfinite(low) else (high, low)
        sides.append((start, end, any(_is_same(statics, start, at) for at in about)))
    for start, end, again in sides:
        here = [at for at in about if _is_same(statics, start, at)]
        holds = again or len(here) == 2
        marks = [at for at in about if min(start, end) < at < max(start, end) and at not in here]
        marks.sort(reverse=end < start)
        parts = enumerate(pairwise([start, *marks, end]))
        found += [(min(part), max(part)) for n, part in parts if (n % 2 == 0) is holds]
    return told._replace(grown=tuple(sorted(found)))


def _is_same(statics: Statics, end: float, other: float) -> bool:
    """Whether two ends are one: of one near zero doubles keep the digits that the known loads leave it."""
    rows = (*statics.general.solved.values(), *statics.general.left)
    known = largest_of([row.get(statics.known, 0.0) for row in rows]) / statics.scale
    return abs(end - other) <= max(SAME * abs(end), LEFT * known)


def _against(statics: Statics) -> tuple[list[float], float]:
    """The senses of friction against the motion that the known loads drive, and their power."""
    (left,) = statics.general.left
    drive = left.get(statics.known, 0.0)
    powers = [left.get(statics.rub(k), 0.0) for k in range(len(statics.rubs))]
    return [-math.copysign(1.0, drive * p) if p else 0.0 for p in powers], drive


def _is_enough(statics: Statics) -> bool:
    """Whether the most power that friction can take against the motion is that of the known loads at least,
    where an unknown one presses on nothing: also where the forces grow without bound."""
    (left,), (against, drive) = statics.general.left, _against(statics)
    limits = [rub.limit * a for rub, a in zip(statics.rubs, against, strict=True)]
    vectors = [
        tuple(
            (
                row.get(statics.known, 0.0),
                *(row.get(statics.rub(k), 0.0) * limit for k, limit in enumerate(limits)),
            )
            for row in rows
        )
        for rows in forces_of(statics)
    ]
    y, _, _ = every.followed(fixed_point(vectors, [False] * len(vectors)))
    if y is None:
        return True
    takes = (abs(left.get(statics.rub(k), 0.0)) * rub.limit for k, rub in enumerate(statics.rubs))
    return bool(sum(a * size for a, size in zip(takes, y, strict=True)) >= abs(drive))
