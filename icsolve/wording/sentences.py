"""Refusals in full sentences that name links and points, with what would mend them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from icsolve.case import Case, Load, Spring, TorsionSpring, Weight
from icsolve.structure import Topology
from icsolve.wording import link_words, links_named, listed, plural

if TYPE_CHECKING:
    from icsolve.case.space import Load as SpatialLoad

RECONSTRUCTED = "Reconstructed"


def provenance(case: Case) -> tuple[str, ...]:
    """What of a figure is not its source's own, as a sentence; nothing where all is."""
    return (f"{RECONSTRUCTED}: {case.reconstructed}",) if case.reconstructed else ()


def structure(top: Topology) -> str:
    """No joint lets anything move: moving links, the freedoms that the joints take, and the slides that keep
    a link of several joints from turning, where a roller may be meant."""
    bodies = len(top.members) - 1
    if not bodies:
        return (
            "no link moves: all of them are welded to the frame, or locked. Let a joint turn or slide; or "
            "give every load and every datum a number, and its reactions are found by statics."
        )
    held = [
        f"The slide at {bond.joint.at} keeps links {listed(bond.links)} from turning against each other: "
        "where a pin or a roller of one runs along the other, it is a `slot`. "
        for bond in top.bonds
        if bond.joint.guide is not None and bond.joint.keeps_direction
        if any(len(top.at[body]) > 2 for body in {bond.a, bond.b} - {top.ground})
    ]
    return (
        f"the links form a structure: 3 x {bodies} freedoms of {plural(bodies, 'link')} beside the frame, of "
        f"which the joints take {top.constraints}. Nothing moves, so power gives no equation. "
        f"{''.join(held)}Take out a joint or a link to make it move; or give every load and every "
        "datum a number, and its reactions are found by statics."
    )


def on_the_frame(load: str, link: str, others: bool) -> str:
    """An unknown load that acts between the frame and itself; ``others``: the known loads do work."""
    outcome = "no value of it balances the known loads" if others else "it can have any value"
    return (
        f"{load} acts on link {link}, which never moves: it does no work, {outcome}. Put it on a moving link."
    )


def near_structure(last: float) -> str:
    """Rigid as written, but a hair from moving."""
    return (
        f"as the data stand this is a structure, but within {last:.1g} of the figure's size of moving. "
        "Give the coordinates with more digits, or lengths and angles from which they follow."
    )


EXPLAINED = (
    "constraints that agree to within half a unit of the last digit of numbers of 15 digits or more count as "
    "exact; the errors say what that leaves open."
)
PRESSES = (
    "the unknown load works by the last digits alone of numbers of 15 digits or more: it counts as one that "
    "only presses."
)


def not_as_written() -> str:
    """Links that meet within the rounding of doubles, and not as their decimals are written."""
    return (
        "the figure cannot be assembled: links that all but reach each other miss by less than doubles tell, "
        "as the decimals are written. Lengthen one by half a unit of its last decimal."
    )


def too_close(load: str, why: str, open_by: float | None) -> str:
    """The data do not tell this position from the singular one beside it."""
    cause = f"a dead centre ({why})" if why else "a dead centre or a change point"
    how = "" if open_by is None else f" (the data leave it open by {100 * open_by:.2g} %)"
    return f"the position is too close to {cause} to give {load}{how}. Take a position farther from it."


def loose(case: Case, names: list[str]) -> str:
    """Links that no chain of joints ties to the frame."""
    which = f"{links_named(names)} {'is' if len(names) == 1 else 'are'}"
    points = {*case.points, *(point for length in case.lengths for point in (length.a, length.b))}
    if set(names) <= points:
        return (
            f"{which} held by nothing, and so are points called: a joint names the links that it joins, and "
            "its point after `at`, as in {pin: [2, 3], at: B}."
        )
    return (
        f"{which} held by nothing: no chain of joints leads to the frame (link {case.ground}). "
        "Add the joint that is missing."
    )


def workless(load: str, cause: str, others_work: bool, turned: bool = False) -> str:
    """The unknown does no work, and why: no value balances, or any value does; ``turned``: it would do some
    in another direction."""
    if others_work:
        remedy = "Give it another direction, put it" if turned else "Put the unknown"
        return (
            f"no value of {load} balances: {cause}, but the known loads do work. "
            f"{remedy} on another link, or take another position."
        )
    return (
        f"any value of {load} balances: {cause}, and the known loads do none either. "
        "The joints carry it; ask for another load."
    )


def workless_together(loads: Sequence[str], others_work: bool) -> str:
    """Of several unknowns there is a motion in which none does work."""
    which, idle = listed([*loads]), "in one of the motions that the joints leave none of them does work"
    if others_work:
        remedy = "Put one of them where it does work in that motion, or take another position."
        return f"no values of {which} balance: {idle}, but the known loads do. {remedy}"
    outcome = "so that they can make up for one another. Give one of them a number."
    return f"many values of {which} balance: {idle}, nor do the known loads, {outcome}"


def undone(load: str, alike: Sequence[str]) -> str:
    """Why a load does no work though its link moves: others that are like it do the opposite."""
    return f"what work {load} does {listed(alike)}, like it, {'undoes' if len(alike) == 1 else 'undo'} here"


def at_rest(load: str, links: Sequence[str], why: str) -> str:
    """Why a load does no work: its link stands still, or does so against the one that takes the opposite."""
    here, *other = map(link_words, links)
    still = f"{here} and {other[0]} move as one" if other else f"{here} stands still"
    clause = f" ({why})" if why else ""
    return f"{still} in this position{clause}, so it is a dead centre for {load}"


def known_at_rest(loads: Sequence[str], link: str) -> str:
    """Known loads that do no work, for their link stands still."""
    verb = "does" if len(loads) == 1 else "do"
    return f"{link_words(link)} stands still in this position: {listed(loads)} {verb} no work on it."


def below_none(load: Load | SpatialLoad) -> str:
    """A load that is found to be negative, as none of its kind is, and what would do its work."""
    if isinstance(load, Weight):
        why = "no mass is: it would have to rise against gravity here. Let a force carry the load."
    elif isinstance(load, Spring | TorsionSpring):
        why = (
            "no spring's stiffness is: it would have to stretch or wind itself further here. Give it a "
            "`free` on the other side of what it has in this position, or let it act elsewhere."
        )
    else:
        why = (
            "a fluid only pushes: it would have to suck here. Let the other side of the piston carry the "
            "load, with its own area and the opposite direction."
        )
    return f"{load.name} is negative, and {why}"


def idle_load(load: str, links: Sequence[str], couple: bool, slack: bool) -> str:
    """Why a load does no work on links that move; ``slack``: a spring that is neither stretched nor wound."""
    here, *other = map(link_words, links)
    if slack:
        return f"the spring {load} is as it is when free, and neither pulls nor turns"
    if couple:
        turned = f"{here} does not turn against {other[0]}" if other else f"{here} does not turn"
        return f"{load} does no work: {turned} in this position"
    motion = f"the motion of {here} against {other[0]}" if other else "the motion"
    return f"{load} does no work on {here}: where it acts, its line is square to {motion}"


def uncarried(case: Case, points: Iterable[str]) -> str:
    """Of the points to which an unknown is measured those that are of no link, and how they become one's."""
    told = {*case.points}.union(*case.carries.values())
    links = [link for link in case.links if link != case.ground]
    found: dict[str, list[str]] = {}
    for point in points:
        data = [{one for one in datum if isinstance(one, str)} for datum in (*case.lengths, *case.angles)]
        beside = set().union(*(names for names in data if point in names))
        link = max(links, key=lambda link: len(beside & {*case.carries.get(link, ())}), default="2")
        if point not in told:
            found.setdefault(link, []).append(point)
    entries = ", ".join(f"{link}: [{', '.join(names)}]" for link, names in found.items())
    names = [name for some in found.values() for name in some]
    goes = "it goes" if len(names) == 1 else "they go"
    with_ = links_named(found)
    said = f"no link carries {listed(names)}: if {goes} with {with_}, write `links: {{{entries}}}`."
    return said if found else ""


def poses_nothing(path: str, moves: bool = False, sought: bool = True) -> str:
    """A number that is to find by the positions that it gives, and gives none; whether the mechanism
    ``moves`` all the same. Without ``sought`` only the stability by it was asked, in one position."""
    why = "it moves nothing."
    if moves:
        why = "the mechanism moves without changing it. Take an angle, a length or a coordinate that the "
        why += "motion changes, or a link that turns."
    if not sought:
        return f"{path} does not pose the figure: {why}"
    return (
        f"{path} does not pose the figure: {why} At which value of it the loads balance in the position as "
        f"written is asked by a sweep: `icsolve sweep CASE --vary {path}=FROM:TO:STEP --find hold`, with a "
        "number in the case."
    )


def placed_without(path: str, names: Sequence[str]) -> str:
    """A datum that is to find between points that the others place."""
    return (
        f"{path} is not to find: the other data place {listed(names)} without it. Leave it out; in place of "
        "a datum that the motion changes write 'unknown' to ask where the loads balance."
    )


def left_out(at: str, slack: str) -> str:
    """A position that is not told as it is asked for one, with the refusal of what it would ask of a rope."""
    return f"left out is {at}, where {slack.partition('. ')[0]}."


def free_ends(top: Topology, case: Case) -> str:
    """Which links beside the frame have a free end: ``link 4 has a free end (its only joint is at C)``."""
    roped = {top.body_of[link] for rope in case.ropes for link in rope.links} - {top.ground}
    afloat = [top.members[body][0] for body in sorted(roped) if not top.at[body]]
    if afloat:
        return f"link {listed(afloat)} has no joint, and hangs on ropes alone"
    moving = {*range(len(top.members))} - {top.ground} - roped
    ends = {body: top.at[body][0] for body in sorted(moving) if len(top.at[body]) == 1}
    names = [top.members[body][0] for body in ends]
    if len(names) > 1:
        return f"links {listed(names)} have a free end (only one joint each)"
    if not names:
        return ""
    at = getattr(top.bonds[next(iter(ends.values()))].joint, "at", None)
    return f"link {names[0]} has a free end (its only joint is {f'at {at}' if at else 'a mesh'})"


def wrong_count(mobility: int, unknowns: int, idle: int, ends: str = "", directed: Sequence[str] = ()) -> str:
    """Freedoms that do not match the unknowns; ``ends``: which links have a free end; ``directed``: which
    forces are of unknown direction."""
    active = mobility - idle
    beside = f" beside {plural(idle, 'freedom')} in which no load does work" if idle else ""
    if unknowns > active:
        extra = unknowns - active
        wrong = f"{plural(unknowns, 'unknown load')} for a mobility of {active}{beside}: {extra} too many."
        if directed:
            return f"{wrong} {_two_each(directed, extra)}"
        give = "one of them a number" if extra == 1 else f"{extra} of them numbers"
        return f"{wrong} Give {give}, or tie it to another with `like`."
    missing = active - unknowns
    wrong = (
        f"the mechanism has {plural(active, 'degree')} of freedom{beside} but "
        f"{plural(unknowns, 'unknown load')}: it would not stay in equilibrium."
    )
    several = missing > 2  # the freedoms that one pin takes
    if ends:
        lost = "joints are missing" if several else "one joint is missing"
        return f"{wrong} It seems that {lost}: {ends}. Add it, or {plural(missing, 'unknown load')}."
    lock = f"joints that take {missing} freedoms" if several else "one more joint"
    return f"{wrong} Add {plural(missing, 'unknown load')}, or {lock} to lock it."


def _two_each(directed: Sequence[str], extra: int) -> str:
    """What forces of unknown direction are to have where so many unknowns are too many."""
    one, left = len(directed) == 1, extra - len(directed)
    counts = "counts as two, its size and its direction" if one else "count as two each, size and direction"
    whom = "it" if one else "each" if left >= 0 else "one of them" if extra == 1 else f"{extra} of them"
    numbers = "" if left <= 0 else f", and {plural(left, 'unknown load')} a number"
    return (
        f"{listed(directed)} {counts}: give {whom} a direction, as in `force: unknown, angle: 30`{numbers}."
    )


def nothing_asked(mobility: int, left: Sequence[str], turning: Sequence[str]) -> str:
    """Known loads alone, on links that are free to move.

    Parameters
    ----------
    left : what the loads may leave for want of in each motion in which they leave something; '' where they do
        not balance in it
    turning : the links that can turn by themselves, where nothing else can move
    """
    balance = "balance in this position" + (f" but for {left[0]}" if left else "")
    if not all(left):
        balance = "do not balance: make one `unknown` to hold them"
    free = f"The links can move ({plural(mobility, 'freedom')}): where they should stand still, a joint is "
    free += "missing."
    if turning:
        one = len(turning) == 1
        free = f"Link{'' if one else 's'} {listed(turning)} can turn by {'itself' if one else 'themselves'}."
    return f"no load is `unknown`, and those that are given {balance}. {free}"


def redundant(
    count: int,
    goes_on: bool | None,
    bodies: bool,
    wedges: int,
    exact: tuple[int, int] | None,
    on: Sequence[str],
) -> str:
    """Redundant constraints, and whether the motion is more than a moment's (None: not known).

    Without ``bodies`` nobody looked which reactions are unique. ``wedges`` further constraints are those of
    rings of links that only slide on each other, which keep their directions whatever the numbers. ``exact``:
    how many freedoms of how many there are only because the figure is as it is; None where the links on which
    the constraints are do not move against one another.
    """
    cause = f"the joints have {plural(count + wedges, 'redundant constraint')}"
    end = "." if bodies else "; reactions that share a load are not unique (`--reactions` tells which)."
    slides = "links that only slide keep their direction by each of their guides, as wedges do"
    if not count:
        return f"{cause}: {slides}{end}"
    if exact is None:
        told = f"links {listed(on)} are held together by more than they need"
        told = f"{told}; {slides}" if wedges else told
        return f"{cause}: {told}; the motion does not depend on it{end}"
    if goes_on is False:
        return (
            f"{cause}: the links yield only for an instant, then they bind (second order), so the answer is "
            f"for this position alone{end}"
        )
    some, freedoms = exact
    if some < freedoms:
        return f"{cause}: {some} of its {freedoms} freedoms it has only because the figure is exact{end}"
    onward = ", and it goes on moving to second order" if goes_on else ""
    return f"{cause}: it moves only because the figure is exact{onward}{end}"


def turned_roller(at: str, along: float) -> str:
    """A roller on whose line a link that should stand still yields."""
    square = (along + 90.0) % 180.0
    return (
        f"{at} can run along its line at {along:g} deg, and what holds it there is square to that; "
        f"for a roller that carries force along {along:g} deg the line is `along: {square:g}`."
    )


def change_point(mobility: int, count: int | None) -> str:
    """Momentarily more freedoms than the joints leave elsewhere; by counting, where that tells."""
    fewer = ", not all of which it keeps beside it"
    if count is not None:
        fewer = f" where counting leaves {count}, so it can go on in more than one way"
    freedoms = f"in this position the mechanism has {plural(mobility, 'degree')} of freedom{fewer}"
    return f"change point: {freedoms}. Take a position beside it."
