"""Sentences about reactions that a reader should know: what is not unique, and contacts that would part."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from icsolve.bodies.equilibrium import Statics
from icsolve.bodies.ties import Position, Tie
from icsolve.bodies.values import Reaction, Reactions
from icsolve.case import Belt, Contact, Gears, KnownCentre
from icsolve.plane import velocity
from icsolve.sentences import listed, plural


def said_of(
    position: Position, statics: Statics, reactions: Reactions, names: Sequence[str]
) -> tuple[str, ...]:
    """All sentences, in the order of the joints."""
    shown = [reactions[name] for name in names]
    both = zip(statics.ties, shown, strict=True)
    touching = [sentence for tie, reaction in both for sentence in _touching(position, tie, reaction)]
    return (*_not_unique(statics, shown, names), *touching, *_black_boxes(statics.ties))


def _not_unique(statics: Statics, shown: Sequence[Reaction], names: Sequence[str]) -> Iterable[str]:
    forces = [name for name, r in zip(names, shown, strict=True) if None in (r.x, r.y)]
    couples = [name for name, r in zip(names, shown, strict=True) if r.moment is None and name not in forces]
    said = [listed(forces)] if forces else []
    said += [f"the couples of {listed(couples)}"] if couples else []
    if said:
        yield (
            f"equilibrium leaves {plural(len(statics.general.free), 'part')} of the reactions open; not "
            f"determined: {', '.join(said)}. {_remedy(statics.ties)}"
        )


def _remedy(ties: Sequence[Tie]) -> str:
    if any(isinstance(tie.joint, Gears) and tie.joint.pressure_angle is None for tie in ties):
        return "Give the gears their `pressure angle` for the loads on their bearings."
    if any(isinstance(tie.joint, Belt) for tie in ties):
        return (
            "The bearing loads depend on the belt's initial tension: put its pulls on the pulleys as loads."
        )
    return "The joints are redundant: how they share the load depends on their fit and stiffness."


def _touching(position: Position, tie: Tie, reaction: Reaction) -> Iterable[str]:
    """A contact that would have to pull, and its pressure angle."""
    if not isinstance(tie.joint, Contact):
        return
    force = dict(reaction.parts).get("normal")
    place = f"the contact of links {tie.by} and {tie.on}" + (f" at {tie.where}" if tie.where else "")
    if force is not None and force < 0.0:
        yield f"{place} is lost: its normal force would have to pull ({force:.6g}). The links part there."
    angle = pressure_angle(position, tie)
    if angle is not None:
        against = f"its normal against the motion of link {tie.on} there"
        yield f"{place} has a pressure angle of {angle:.6g} deg ({against})."


def pressure_angle(position: Position, tie: Tie) -> float | None:
    """Degrees between the normal of a contact and the velocity of its second link there; None at rest."""
    if position.mobility != 1:
        return None
    twist = position.relative(position.case.ground, tie.on)
    vx, vy = velocity(twist, tie.at)
    speed, size = math.hypot(vx, vy), max(map(abs, twist))
    if speed <= 1e-12 * size or size == 0.0:
        return None
    nx, ny = tie.units[0][0], tie.units[0][1]
    along, across = vx * nx + vy * ny, vx * ny - vy * nx
    return math.degrees(math.atan2(abs(across), abs(along)))


def _black_boxes(ties: Sequence[Tie]) -> Iterable[str]:
    pairs = [f"{tie.by}-{tie.on}" for tie in ties if isinstance(tie.joint, KnownCentre)]
    if pairs:
        yield (
            f"the force at a given centre ({listed(pairs)}) is what a pin there would carry: it stands for "
            "joints that the case does not show."
        )
