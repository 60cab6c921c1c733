"""Why a case in space has no answer, in full sentences; and what a reader of the answer should know."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

from icsolve.answer.space import Reaction, Reactions
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.statics.space.equilibrium import Statics
from icsolve.statics.space.figure import Figure
from icsolve.statics.space.loading import Wrenched, is_unknown
from icsolve.statics.space.motions import NEARLY, Balance, Twist, combined, power_of
from icsolve.statics.space.ties import Tie
from icsolve.statics.space.words import motion_words, moving
from icsolve.wording.sentences import listed, plural, wrong_count

Motions = Sequence[Mapping[str, Twist]]


def refuse_loose(case: Case, ties: Iterable[Tie]) -> None:
    """Refuse links that no chain of joints ties to the frame."""
    beside: dict[str, set[str]] = {}
    for tie in ties:
        beside.setdefault(tie.by, set()).add(tie.on)
        beside.setdefault(tie.on, set()).add(tie.by)
    seen, stack = {case.ground}, [case.ground]
    while stack:
        new = beside.get(stack.pop(), set()) - seen
        seen |= new
        stack.extend(new)
    loose = [link for link in case.links if link not in seen]
    if loose:
        which = f"link {loose[0]}" if len(loose) == 1 else f"links {listed(loose)}"
        said = f"no chain of joints ties {which} to the frame {case.ground}. Add a joint."
        raise SceneError(Status.LOOSE, said)


def refuse_unbalanced(figure: Figure, motions: Motions, loads: Sequence[Wrenched], balance: Balance) -> None:
    """Refuse unknown loads that have no value, or any, and known loads that nothing balances."""
    unknowns = [w for w in loads if is_unknown(w.load)]
    if unknowns and not motions:
        raise SceneError(
            Status.STRUCTURE,
            f"the joints hold every link, so any value of {unknowns[0].load.name} is carried. Give it a "
            "number, or take out what holds its link.",
        )
    unbalanced = balance.off > NEARLY
    if balance.free:
        raise _undetermined(motions, unknowns, balance, unbalanced)
    if unbalanced:
        raise SceneError(Status.MOBILITY, _driven(figure, motions, loads, balance))


def _undetermined(
    motions: Motions, unknowns: Sequence[Wrenched], balance: Balance, unbalanced: bool
) -> SceneError:
    """An unknown that does no work, or more of them than motions that they work on."""
    idle = next((w for w in unknowns if not any(power_of(w, motion).value for motion in motions)), None)
    if idle is None:
        working = len(unknowns) - len(balance.free)
        return SceneError(Status.MOBILITY, wrong_count(len(motions), len(unknowns), len(motions) - working))
    name = idle.load.name
    why = f"{name} does no work on any motion that the joints leave to link {idle.load.link}"
    if unbalanced:
        said = f"no value of {name} balances: {why}, but the known loads do work."
        return SceneError(Status.NO_VALUE, f"{said} Give it another direction, or put it on another link.")
    said = f"any value of {name} balances: {why}, and the known loads do none either."
    return SceneError(Status.ANY_VALUE, f"{said} The joints carry it; ask for another load.")


def _driven(figure: Figure, motions: Motions, loads: Sequence[Wrenched], balance: Balance) -> str:
    words = driven_motion(figure, motions, loads, balance)
    return (
        f"the joints leave {plural(len(motions), 'degree')} of freedom and the loads do not balance: they "
        f"drive a motion in which {words}. Add an unknown load that does work on it, or a joint that "
        "prevents it; or correct a point or a load that is off."
    )


def driven_motion(figure: Figure, motions: Motions, loads: Sequence[Wrenched], balance: Balance) -> str:
    """The motion that the loads drive most, by that of the first loaded link that takes part."""
    rests = zip(balance.unbalanced, balance.left, strict=True)
    shares = [rest / most if rest else 0.0 for rest, (_, most) in rests]
    most = max(range(len(shares)), key=lambda m: abs(shares[m]))
    motion = combined((motions[most],), (math.copysign(1.0, shares[most]),))
    link = moving(motion, [w.load.link for w in loads])
    return motion_words(link, motion, figure)


def refuse_huge(statics: Statics, parameters: Mapping[int, float]) -> None:
    """Refuse forces that only a figure out of true by its last digits would make."""
    loads = max((abs(value) for value in parameters.values()), default=0.0)
    values = [abs(statics.value(column, parameters)) for column in range(statics.known)]
    if loads and max(values, default=0.0) > HUGE * loads:
        raise SceneError(
            Status.NEAR_SINGULAR,
            f"the joints would carry more than {HUGE:.0g} times the loads: the bodies are within a hair's "
            "breadth of a position in which they can move. Give the points and axes with more digits, or an "
            "axis by two points of it.",
        )


HUGE = 1e6


def notes_of(
    figure: Figure,
    motions: Motions,
    loads: Sequence[Wrenched],
    balance: Balance,
    statics: Statics,
    reactions: Reactions,
) -> tuple[str, ...]:
    """All that a reader of the answer should know."""
    working, notes = len(balance.unknowns), []
    if not motions:
        notes.append("the joints hold every link: statics alone gives the reactions.")
    if len(motions) > working:
        idle = plural(len(motions) - working, "degree")
        notes.append(f"the joints leave {idle} of freedom in which the loads are in balance.")
    if balance.off:
        words = driven_motion(figure, motions, loads, balance)
        notes.append(
            f"the loads balance to a fraction of {balance.off:.1g} only (a motion in which {words}): taken "
            "as balanced, the rest being rounding of the data."
        )
    return (*notes, *_not_unique(statics, reactions))


def _not_unique(statics: Statics, reactions: Reactions) -> Iterable[str]:
    named = [part for name, reaction in reactions.items() for part in _open_parts(name, reaction)]
    if not named:
        return
    yield (
        f"equilibrium leaves {plural(len(statics.general.free), 'part')} of the reactions open; not "
        f"determined: {', '.join(named)}. "
        "The joints are redundant: how they share the load depends on their fit and stiffness."
    )


def _open_parts(name: str, reaction: Reaction) -> Iterable[str]:
    force = "".join(axis for axis, part in zip("xyz", reaction.force, strict=True) if part is None)
    couple = "".join(axis for axis, part in zip("xyz", reaction.couple, strict=True) if part is None)
    if force:
        yield name if force == "xyz" else f"{name} along {' and '.join(force)}"
    if couple:
        about = "" if couple == "xyz" else f" about {' and '.join(couple)}"
        yield f"the couple of {name}{about}"
