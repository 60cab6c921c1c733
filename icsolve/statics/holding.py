"""Friction without a given motion: the values of the unknown load at which the mechanism holds still.

Its ends are the equilibria in which the mechanism is about to move one way and the other, as textbooks
have them. Friction that is not at its limit everywhere, or that a history has left the other way round,
can hold more: the set of values for which any equilibrium exists with every friction within its limit.
Where the rubs have little influence on each other the two are proven to be one, else it is looked for.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

from icsolve.statics.affine import at, contraction, is_sound
from icsolve.statics.continuation import followed, solutions, without_friction
from icsolve.statics.equilibrium import Statics
from icsolve.statics.reduction import Reduced, reduced
from icsolve.statics.roots import all_roots, can_count

PROVEN = "proven: no friction within its limits holds more"
SEARCHED = "every combination of full friction was tried"
IMPENDING = "only impending motion was looked at"
MOST_TRIED = 6
"""More rubs have too many combinations of senses."""


class End(NamedTuple):
    """An end of the interval: the value (case units), the senses of the rubs, and their friction (scaled).

    No friction where the value is infinite, or is not that of an equilibrium about to move.
    """

    value: float
    senses: tuple[float, ...]
    friction: tuple[float, ...] = ()


class Held(NamedTuple):
    """The interval, in case units; infinite where no value moves the mechanism that way.

    ``possible`` is the range in which friction within its limits can hold; ``how`` says how that was
    found: only `PROVEN` is a proof. ``ends`` are those ends at which it is about to move, ``again`` values
    outside of the interval at which it is so too.
    """

    least: float
    most: float
    possible: tuple[float, float]
    how: str
    self_locking: bool = False
    ends: tuple[End, ...] = ()
    again: tuple[float, ...] = ()


def held(statics: Statics, senses: Sequence[float]) -> Held:
    """The interval of the one unknown load; ``senses`` are those of the rubs in the motion.

    Self-locking: it holds with the unknown at zero (against loads), or no value moves it one way.
    """
    ends = [end for d in (1.0, -1.0) if (end := _end(statics, [d * s for s in senses])) is not None]
    least, most = min(end.value for end in ends), max(end.value for end in ends)
    unbounded = math.isinf(least) or math.isinf(most)
    locks = unbounded or (least <= 0.0 <= most and least < most)
    about_to_move = tuple(end for end in ends if math.isfinite(end.value))
    possible, how = _possible(statics, senses, (least, most))
    again = _again(statics, senses, least, most) if unbounded else ()
    return Held(least, most, possible, how, locks, about_to_move, again)


def _again(statics: Statics, senses: Sequence[float], least: float, most: float) -> tuple[float, ...]:
    """Values outside of a range without end at which the mechanism is about to move too.

    A load that locks one way can lock the other way as well, from some value on: the range goes on there.
    """
    found = set()
    for direction in (1.0, -1.0):
        equations = reduced(statics, [direction * s for s in senses])
        if equations is not None and can_count(equations.equations):
            found |= {equations.load(y)[0] / statics.scale for y in all_roots(equations.equations)}
    room = 1e-9 * max((abs(end) for end in (least, most) if math.isfinite(end)), default=0.0)
    return tuple(sorted(value for value in found if value < least - room or value > most + room))


def _possible(
    statics: Statics, senses: Sequence[float], ends: tuple[float, float]
) -> tuple[tuple[float, float], str]:
    """The range in which friction within its limits can hold, and how that is known."""
    if _is_proven(statics, senses):
        return ends, PROVEN
    if len(senses) > MOST_TRIED:
        return ends, IMPENDING
    tried = [_end(statics, signs, True) for signs in product((1.0, -1.0), repeat=len(senses))]
    sound = [*ends, *(end.value for end in tried if end is not None)]
    return (min(sound), max(sound)), SEARCHED


def _end(statics: Statics, senses: Sequence[float], pushing: bool = False) -> End | None:
    """The unknown load at full friction of these senses; infinite where the forces grow without bound.

    With ``pushing``, None where a contact would have to pull.
    """
    equations = reduced(statics, senses)
    assert equations is not None
    if contraction(equations.equations) is not None:
        found = solutions(equations.equations)
        assert found.main is not None
        return _moving(statics, equations, senses, found.main, pushing)
    y, share, grows = followed(equations.equations)
    if y is not None:
        return _moving(statics, equations, senses, y, pushing)
    last = followed(equations.equations.scaled(0.999 * share))[0] or without_friction(equations.equations)
    change = sum(a * x for a, x in zip(equations.loads[0][1:], last, strict=True))
    if pushing and not is_sound(equations.equations.scaled(0.999 * share), last):
        return None
    if grows or _locks(equations):
        return End(math.copysign(math.inf, change), tuple(senses))
    return End((equations.loads[0][0] + 0.999 * share * change) / statics.scale, tuple(senses))


def _moving(
    statics: Statics, equations: Reduced, senses: Sequence[float], y: Sequence[float], pushing: bool
) -> End | None:
    """The end at an equilibrium about to move; None where a contact would have to pull."""
    if pushing and not is_sound(equations.equations, y):
        return None
    return End(equations.load(y)[0] / statics.scale, tuple(senses), equations.friction(y))


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
