"""Sentences about reactions that a reader should know: what is not unique, and contacts that would part."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from icsolve.bodies.equilibrium import Statics
from icsolve.bodies.ties import Tie
from icsolve.bodies.values import Reaction, Reactions
from icsolve.case import Belt, Contact, Gears, KnownCentre
from icsolve.sentences import listed, plural


def said_of(statics: Statics, reactions: Reactions, names: Sequence[str]) -> tuple[str, ...]:
    """All sentences, in the order of the joints."""
    shown = [reactions[name] for name in names]
    both = zip(statics.ties, shown, strict=True)
    touching = [sentence for tie, reaction in both for sentence in _touching(tie, reaction)]
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
            "The bearing loads depend on the belt's initial tension: in place of the belt put its two pulls "
            "on the pulleys as loads."
        )
    return "The joints are redundant: how they share the load depends on their fit and stiffness."


def _touching(tie: Tie, reaction: Reaction) -> Iterable[str]:
    """A contact that would have to pull."""
    if not isinstance(tie.joint, Contact):
        return
    force = dict(reaction.parts).get("normal")
    place = f"the contact of links {tie.by} and {tie.on}" + (f" at {tie.where}" if tie.where else "")
    if force is not None and force < 0.0:
        yield f"{place} is lost: its normal force would have to pull ({force:.6g}). The links part there."


def _black_boxes(ties: Sequence[Tie]) -> Iterable[str]:
    pairs = [f"{tie.by}-{tie.on}" for tie in ties if isinstance(tie.joint, KnownCentre)]
    if pairs:
        yield (
            f"the force at a given centre ({listed(pairs)}) is what a pin there would carry: it stands for "
            "joints that the case does not show."
        )
