"""Published reactions, arms and friction radii: the found values that they are about."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from icsolve.answer.bodies import Reaction
from icsolve.case import Pin
from icsolve.case.expected import ArmIs, FrictionRadiusIs, OfBodies, TensionIs

if TYPE_CHECKING:
    from icsolve.answer import Answer


def found_value(answer: Answer, target: OfBodies) -> float:
    """The value of a target, in case units.

    Raises LookupError, with a sentence, where the answer has none.
    """
    if isinstance(target, FrictionRadiusIs):
        return _friction_radius(answer, target.point)
    if isinstance(target, ArmIs):
        return _arm(answer, _reaction(answer, target.by, target.on, None), target.point)
    if isinstance(target, TensionIs):
        return _tension(answer, target)
    reaction = _reaction(answer, target.by, target.on, target.at)
    whole = {"": reaction.magnitude, "x": reaction.x, "y": reaction.y, "moment": reaction.moment}
    value = whole[target.part] if target.part in whole else _share(reaction, target.part)
    if value is None:
        raise LookupError(f"it is not determined: {reaction.why}")
    return value


def _tension(answer: Answer, target: TensionIs) -> float:
    """The pull of a rope, or of a part of it."""
    found = next(one for one in answer.tensions if one.rope == target.rope)
    if found.tension is None:
        raise LookupError(f"it is not determined: {found.why}")
    return found.parts[target.part - 1] if found.parts else found.tension


def _share(reaction: Reaction, name: str) -> float | None:
    """A share of the force by its name; None where the force is open."""
    shares = dict(reaction.parts)
    if name not in shares and (reaction.x is None or reaction.y is None):
        return None
    if name not in shares:
        raise LookupError(f"a {reaction.kind} has no '{name}' share; it has {', '.join(shares) or 'none'}")
    return shares[name]


def _reaction(answer: Answer, by: str, on: str, at: str | None) -> Reaction:
    """The one reaction between two links (at a point, where they have several joints)."""
    both = [r for r in (answer.reactions or {}).values() if {r.by, r.on} == {by, on}]
    found = both if at is None else [r for r in both if r.where == at]
    if not found:
        place = f" at {at}" if at else ""
        raise LookupError(f"links {by} and {on} have no joint{place}")
    if len(found) > 1:
        which = f"F{by}-{on}@{found[0].where or 'B'}"
        raise LookupError(f"links {by} and {on} have {len(found)} joints: say which, as in {which}")
    return found[0] if (found[0].by, found[0].on) == (by, on) else found[0].reversed()


def _arm(answer: Answer, reaction: Reaction, point: str) -> float:
    """Arm of a force about a point: its moment there, with its couple, over its size.

    Where a pin of the same link rubs at the point, its reaction is tangent to the friction circle: the arm
    is to that line, as books draw it.
    """
    if point not in answer.points:
        raise LookupError(f"the point {point} was not found")
    if reaction.x is None or reaction.y is None or reaction.moment is None:
        raise LookupError(f"the force is not determined: {reaction.why}")
    size = math.hypot(reaction.x, reaction.y)
    if size == 0.0:
        raise LookupError("the force is zero: it has no arm")
    px, py = answer.points[point]
    couple = (reaction.moment + _rubbed(answer, reaction, point)) / answer.case.units.torque_per_force_length
    x, y = reaction.at
    return abs((x - px) * reaction.y - (y - py) * reaction.x + couple) / size


def _rubbed(answer: Answer, reaction: Reaction, point: str) -> float:
    """The couples of pins at a point on the link that a force acts on, other than with the force itself."""
    total = 0.0
    for other in (answer.reactions or {}).values():
        if (
            other.kind == "pin"
            and other.where == point
            and {other.by, other.on} != {reaction.by, reaction.on}
        ):
            sign = 1.0 if other.on == reaction.on else -1.0 if other.by == reaction.on else 0.0
            total += sign * (other.moment or 0.0)
    return total


def _friction_radius(answer: Answer, point: str) -> float:
    """Radius of a pin's friction circle: its own radius times the sine of the friction angle."""
    for joint in answer.case.joints:
        if isinstance(joint, Pin) and joint.at == point and joint.friction and joint.friction.radius:
            return float(joint.friction.radius.value * math.sin(math.atan(joint.friction.mu.value)))
    raise LookupError(f"no pin at {point} has friction")
