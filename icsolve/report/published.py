"""What published values of free bodies are compared with: reactions, arms, tensions, friction radii."""

from __future__ import annotations

import math

from icsolve.answer import Answer
from icsolve.answer.bodies import Reaction, SpatialReaction
from icsolve.case import pair_name
from icsolve.case.expected import ArmIs, FrictionRadiusIs, OfBodies, ReactionIs, TensionIs
from icsolve.screws.plane import add, cross, subtract
from icsolve.screws.space import Vec, size, times


def found_value(answer: Answer, target: OfBodies) -> float:
    """The value of a target about joints or ropes, in case units, in the plane or in space.

    Raises LookupError, with a sentence, where the answer has none.
    """
    match target:
        case FrictionRadiusIs(point):
            return _friction_radius(answer, point)
        case ArmIs(by, on, point):
            return _arm(answer, _reaction(answer, by, on, None), point)
        case TensionIs():
            return _tension(answer, target)
        case ReactionIs(by, on, at=at, part=part):
            return _part(_reaction(answer, by, on, at), part)


def force_of(answer: Answer, target: ReactionIs) -> tuple[tuple[float, float], tuple[float, float]]:
    """The force of a joint in the plane, of which a component alone may be meant, and where it acts [case
    units]. Raises LookupError as `found_value` does.
    """
    reaction = _reaction(answer, target.by, target.on, target.at)
    assert isinstance(reaction, Reaction)
    x, y = (0.0 if part == target.part.translate(_OTHER) else _part(reaction, part) for part in "xy")
    return (x, y), reaction.at


_OTHER = str.maketrans("xy", "yx")


def _tension(answer: Answer, target: TensionIs) -> float:
    """The pull of a rope, or of a part of it."""
    found = next(one for one in answer.tensions if one.rope == target.rope)
    if found.tension is None:
        raise LookupError(f"it is not determined: {found.why}")
    return found.parts[target.part - 1] if found.parts else found.tension


def _part(reaction: Reaction | SpatialReaction, part: str) -> float:
    """Size or component of a force or couple, or a share of it by its name."""
    parts: dict[str, float | None] = {"": reaction.magnitude, "moment": reaction.moment}
    if isinstance(reaction, Reaction):
        parts |= {"x": reaction.x, "y": reaction.y}
    else:
        parts |= dict(zip("xyz", reaction.force, strict=True))
        parts |= dict(zip(("moment x", "moment y", "moment z"), reaction.couple, strict=True))
    parts |= dict(reaction.parts)
    is_open = isinstance(reaction, Reaction) and None in (reaction.x, reaction.y)
    if part not in parts and not is_open:
        shares = ", ".join(name for name, _ in reaction.parts) or "none"
        raise LookupError(f"a {reaction.kind} has no '{part}' share; it has {shares}")
    value = parts.get(part)
    if value is None:
        raise LookupError(f"it is not determined: {reaction.why}")
    return value


def _reaction(answer: Answer, by: str, on: str, at: str | None) -> Reaction | SpatialReaction:
    """The one reaction between two links (at a point, where they have several joints)."""
    found: list[Reaction | SpatialReaction] = [*(answer.reactions or {}).values()]
    if answer.spatial is not None:
        found = [*answer.spatial.reactions.values()]
    found = [r for r in found if {r.by, r.on} == {by, on} and at in (None, r.where)]
    if not found:
        for joint in answer.case.joints:
            if joint.pivot and {by, on} <= {*joint.links} and at in (None, joint.at):
                first = joint.links[0]
                said = f"the pin at {joint.at} is carried by link {first}, which is named first: ask for"
                raise LookupError(f"{said} F{pair_name(answer.case, (first, by))}, or name another first")
        place = f" at {at}" if at else ""
        raise LookupError(f"links {by} and {on} have no joint{place}")
    if len(found) > 1:
        which = f"F{by}-{on}@{found[0].where or 'B'}"
        raise LookupError(f"links {by} and {on} have {len(found)} joints: say which, as in {which}")
    return found[0] if (found[0].by, found[0].on) == (by, on) else found[0].reversed()


def _arm(answer: Answer, reaction: Reaction | SpatialReaction, point: str) -> float:
    """Arm of a force about a point: the size of its moment there, with its couple, over its own size.

    Where a pin of the same link rubs at the point, its reaction is tangent to the friction circle: the arm
    is to that line, as books draw it.
    """
    place = place_of(answer, point)
    force, couple = reaction.components
    rubbed = _rubbed(answer, reaction, point) if isinstance(reaction, Reaction) else 0.0
    if None in (*force, *couple):
        raise LookupError(f"the force is not determined: {reaction.why}")
    if not any(force):
        raise LookupError("the force is zero: it has no arm")
    per = answer.case.units.torque_per_force_length
    moment = cross(subtract(spatial(reaction.at), spatial(place)), force)
    whole = add(moment, times(1.0 / per, add(couple, (0.0, 0.0, rubbed))))
    return float(size(whole) / size(force))


def place_of(answer: Answer, point: str) -> tuple[float, ...]:
    """A point of an answer, in the plane or in space. Raises LookupError where it was not found."""
    points = answer.points if answer.spatial is None else answer.spatial.points
    if point not in points:
        raise LookupError(f"the point {point} was not found")
    return points[point]


def spatial(place: tuple[float, ...]) -> Vec:
    """A place of the plane or of space by three coordinates."""
    x, y, *z = place
    return (x, y, z[0] if z else 0.0)


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
        if joint.pivot == point and joint.friction and joint.friction.radius:
            return float(joint.friction.radius.value * math.sin(math.atan(joint.friction.mu.value)))
    raise LookupError(f"no pin at {point} has friction")
