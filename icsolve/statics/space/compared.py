"""Published values of a case in space: the found values that they are about."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from icsolve.answer.space import Reaction, Spatial
from icsolve.case import ArmIs, DistanceIs, Like, LoadIs, ReactionIs, Target
from icsolve.case.space import ForceVector, TorqueVector
from icsolve.statics.space.figure import in_case, vector_of
from icsolve.statics.space.vectors import cross, size, sub

if TYPE_CHECKING:
    from icsolve.answer import Answer

_AXES = "xyz"


def found_value(answer: Answer, spatial: Spatial, target: Target, sense: str | None = None) -> float:
    """The value of a target, in case units; positive in a published ``sense``.

    Raises LookupError, with a sentence, where the answer has none.
    """
    match target:
        case LoadIs(load):
            return _load(answer, load, sense)
        case DistanceIs(str() as a, str() as b):
            return size(sub(spatial.points[a], spatial.points[b]))
        case ArmIs(by, on, point):
            return _arm(answer, spatial, _reaction(spatial, by, on, None), point)
        case ReactionIs():
            return _share(spatial, target)
    raise LookupError("a case in space has no such value")


def _load(answer: Answer, name: str, sense: str | None) -> float:
    """A load's number, as found, as given, or as another load has it."""
    if name in answer.answers:
        found = answer.answers[name]
        against = sense is not None and found.sense not in ("", sense)
        return -abs(found.value) if against else abs(found.value) if sense else found.value
    load = next(load for load in in_case(answer.case).loads if load.name == name)
    if isinstance(load, ForceVector | TorqueVector):
        return size(vector_of(load.parts))
    if isinstance(load.value, Like):
        ratio = 1.0 if load.value.times is None else load.value.times.value
        return ratio * _load(answer, load.value.load, None)
    assert load.value is not None
    return load.value.value


def _share(spatial: Spatial, target: ReactionIs) -> float:
    """Part of a reaction."""
    reaction = _reaction(spatial, target.by, target.on, target.at)
    value = _part(reaction, target.part)
    if value is None:
        raise LookupError(f"it is not determined: {reaction.why}")
    return value


def _part(reaction: Reaction, part: str) -> float | None:
    """Size or component of the force or couple, or a share of it."""
    if part == "":
        return reaction.magnitude
    if part in ("x", "y", "z"):
        return reaction.force[_AXES.index(part)]
    if part == "moment":
        return reaction.moment
    if part.startswith("moment "):
        return reaction.couple[_AXES.index(part[-1])]
    shares = dict(reaction.parts)
    if part not in shares:
        raise LookupError(f"a {reaction.kind} has no '{part}' share; it has {', '.join(shares) or 'none'}")
    return shares[part]


def _reaction(spatial: Spatial, by: str, on: str, at: str | None) -> Reaction:
    """The one reaction between two links (at a point, where they have several joints)."""
    both = [r for r in spatial.reactions.values() if {r.by, r.on} == {by, on}]
    found = both if at is None else [r for r in both if r.where == at]
    if not found:
        place = f" at {at}" if at else ""
        raise LookupError(f"links {by} and {on} have no joint{place}")
    if len(found) > 1:
        which = f"F{by}-{on}@{found[0].where}"
        raise LookupError(f"links {by} and {on} have {len(found)} joints: say which, as in {which}")
    return found[0] if (found[0].by, found[0].on) == (by, on) else found[0].reversed()


def _arm(answer: Answer, spatial: Spatial, reaction: Reaction, point: str) -> float:
    """Arm of a force about a point: the size of its moment there, with its couple, over its own size."""
    if point not in spatial.points:
        raise LookupError(f"the point {point} was not found")
    x, y, z = reaction.force
    u, v, w = reaction.couple
    if x is None or y is None or z is None or u is None or v is None or w is None:
        raise LookupError(f"the force is not determined: {reaction.why}")
    force = math.hypot(x, y, z)
    if force == 0.0:
        raise LookupError("the force is zero: it has no arm")
    per = answer.case.units.torque_per_force_length
    mx, my, mz = cross(sub(reaction.at, spatial.points[point]), (x, y, z))
    return size((mx + u / per, my + v / per, mz + w / per)) / force
