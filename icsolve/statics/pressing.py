"""Friction at rest where the unknown load does no work: it presses links together until friction holds.

The mechanism holds where the most that friction can do against the motion that the known loads drive is
at least what they do. The ends of the range are the loads at which it is just that.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from icsolve.errors import SceneError, Status
from icsolve.statics.affine import fixed_point
from icsolve.statics.continuation import followed
from icsolve.statics.equilibrium import Statics
from icsolve.statics.holding import Held
from icsolve.statics.reduction import forces_of, reduced_workless
from icsolve.statics.roots import all_roots, can_count
from icsolve.statics.ties import is_touching

SAID = "the unknown load does no work; between the ends friction was compared with the known loads"


def pressed(statics: Statics, senses: Sequence[float]) -> Held:
    """The range of an unknown load that does no work; ``senses`` are those of the rubs in the motion.

    Raises SceneError where nothing drives the mechanism (any value holds) and where none holds it.
    """
    name = statics.roots[0]
    (left,) = statics.general.left
    powers = [left.get(statics.rub(k), 0.0) for k in range(len(senses))]
    drive = left.get(statics.known, 0.0)
    if abs(drive) <= 1e-12 * max(map(abs, (*left.values(), drive)), default=0.0):
        raise SceneError(
            Status.ANY_VALUE, f"any value of {name} holds: it does no work, and nothing drives the mechanism."
        )
    against = [-math.copysign(1.0, drive * p) if p else 0.0 for p in powers]
    equations = reduced_workless(statics, [-a for a in against])
    if equations is None or not can_count(equations.equations):
        raise SceneError(Status.NO_VALUE, f"no value of {name} holds: it does no work, and no friction does.")
    ends = sorted({equations.load(y)[0] for y in all_roots(equations.equations)})
    marks = [-math.inf, *ends, math.inf]
    holding = [
        (a, b)
        for a, b in pairwise(marks)
        if a < b and _capacity(statics, against, powers, _between(a, b)) >= abs(drive)
    ]
    if not holding:
        raise SceneError(
            Status.NO_VALUE, f"no value of {name} holds: the friction that it makes is never enough."
        )
    least, most = max(holding, key=lambda pair: (pair[1] == math.inf, pair[1]))
    both = (least / statics.scale, most / statics.scale)
    others = {end / statics.scale for pair in holding if pair != (least, most) for end in pair}
    again = sorted(end for end in others if math.isfinite(end) and end not in both)
    return Held(*both, both, SAID, again=tuple(again))


def _between(a: float, b: float) -> float:
    if a == -math.inf:
        return b - max(1.0, abs(b)) if b < math.inf else 0.0
    return a + max(1.0, abs(a)) if b == math.inf else (a + b) / 2.0


def _capacity(statics: Statics, against: Sequence[float], powers: Sequence[float], load: float) -> float:
    """The most power that friction can take at this value of the load (scaled); -1 where a contact parts."""
    limits = [rub.limit * a for rub, a in zip(statics.rubs, against, strict=True)]
    vectors = [
        tuple(
            (
                row.get(statics.known, 0.0) + row.get(statics.root(0), 0.0) * load,
                *(row.get(statics.rub(k), 0.0) * limit for k, limit in enumerate(limits)),
            )
            for row in rows
        )
        for rows in forces_of(statics)
    ]
    touching = [is_touching(statics.ties[rub.tie].joint) for rub in statics.rubs]
    equations = fixed_point(vectors, touching)
    y, _, _ = followed(equations)
    if y is None:
        return math.inf
    for forms, only in zip(equations.vectors, touching, strict=True):
        if only and forms[0][0] + sum(a * b for a, b in zip(forms[0][1:], y, strict=True)) < 0.0:
            return -1.0
    return sum(abs(p) * rub.limit * size for p, rub, size in zip(powers, statics.rubs, y, strict=True))
