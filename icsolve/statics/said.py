"""Sentences about reactions that a reader should know: what is not unique, and contacts that would part."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from icsolve.answer.bodies import Reaction, Reactions
from icsolve.case import Belt, Contact, Gears, KnownCentre
from icsolve.statics.equilibrium import Statics
from icsolve.statics.ties import Tie
from icsolve.wording.sentences import listed, plural


def said_of(statics: Statics, reactions: Reactions, names: Sequence[str]) -> tuple[str, ...]:
    """All sentences, in the order of the joints."""
    shown = [reactions[name] for name in names]
    both = zip(statics.ties, shown, strict=True)
    touching = [sentence for tie, reaction in both for sentence in _touching(tie, reaction)]
    return (*_not_unique(statics, shown, names), *touching, *_black_boxes(statics.ties))


def _not_unique(statics: Statics, shown: Sequence[Reaction], names: Sequence[str]) -> Iterable[str]:
    said = _open_parts(dict(zip(names, shown, strict=True)))
    if said:
        yield (
            f"equilibrium leaves {plural(len(statics.general.free), 'part')} of the reactions open; not "
            f"determined: {', '.join(said)}. {_remedy(statics.ties)}"
        )


def _open_parts(shown: Mapping[str, Reaction]) -> list[str]:
    """The forces that are open, those of which only one component is, and further couples."""
    kinds: dict[tuple[bool, bool], list[str]] = {}
    for name, r in shown.items():
        kinds.setdefault((r.x is None, r.y is None), []).append(name)
    ends = {(True, True): "", (True, False): " along x", (False, True): " along y"}
    said = [f"{listed(kinds[kind])}{end}" for kind, end in ends.items() if kind in kinds]
    whole = kinds.get((True, True), [])
    couples = [name for name, r in shown.items() if r.moment is None and name not in whole]
    return [*said, f"the couples of {listed(couples)}"] if couples else said


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
