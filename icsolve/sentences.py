"""Refusals in full sentences that name links and points, with what would mend them."""

from __future__ import annotations

import math
from collections.abc import Iterable

from icsolve.case import Case, KnownCentre
from icsolve.figure.frame import Frame
from icsolve.loops import Bases, all_motions
from icsolve.plane import subtract
from icsolve.topology import Bond, Topology
from icsolve.twists import Closure


def listed(names: Iterable[str]) -> str:
    """a, b and c."""
    *head, last = list(names)
    return f"{', '.join(head)} and {last}" if head else last


def plural(count: int, word: str) -> str:
    """1 load, 2 loads."""
    return f"{count} {word}" + ("" if count == 1 else "s")


def structure(top: Topology) -> str:
    """No joint lets anything move."""
    bodies = len(top.members) - 1
    constraints = sum(bond.constraints for bond in top.bonds)
    return (
        f"the links form a structure: {plural(bodies, 'moving link')} have 3 x {bodies} freedoms, and the joints "
        f"take {constraints}. Nothing moves, so power gives no equation. Take out a joint or a link to make "
        "it move."
    )


def near_structure(last: float) -> str:
    """Rigid as written, but a hair from moving."""
    return (
        f"as the data stand this is a structure, but within {last:.1g} of the figure's size of moving. "
        "Give the coordinates with more digits, or lengths and angles from which they follow."
    )


def loose(case: Case, names: list[str]) -> str:
    """Links that no chain of joints ties to the frame."""
    which = f"link {names[0]} is" if len(names) == 1 else f"links {listed(names)} are"
    return (
        f"{which} held by nothing: no chain of joints leads to the frame (link {case.ground}). "
        "Add the joint that is missing."
    )


def contradiction(top: Topology, bases: Bases, frame: Frame, unit: str) -> str:
    """Which given centre lies off the place that the others give it, and how far."""
    worst: tuple[float, str] | None = None
    for k, bond in enumerate(top.bonds):
        if not isinstance(bond.joint, KnownCentre):
            continue
        off = _off_place(top, bases, k)
        if off is not None and (worst is None or off < worst[0]):
            worst = (off, f"{bond.links[0]}-{bond.links[1]}")
    if worst is None:
        return "the given centres contradict each other: no motion has all of them. Correct one, or leave it out."
    distance = worst[0] / frame.scale
    return (
        f"the given centres contradict each other: centre {worst[1]} lies {distance:.3g} {unit} from where the "
        "other centres and joints put it. Correct it, or leave it out."
    )


def _off_place(top: Topology, bases: Bases, k: int) -> float | None:
    """Distance (normalised) of a given finite centre from the one that all else gives."""
    rest = {n: basis for n, basis in bases.items() if n != k}
    motions = all_motions(top, rest)
    bond = top.bonds[k]
    if len(motions.found.basis) != 1 or bond.a not in motions.twists or bond.b not in motions.twists:
        return None
    x, y, w = subtract(motions.twists[bond.b][0], motions.twists[bond.a][0])
    px, py, pw = bases[k][0]
    if pw == 0.0 or abs(w) <= 1e-12 * max(abs(x), abs(y)):
        return None
    return math.hypot(x / w - px, y / w - py)


def points_in_line(closures: Iterable[Closure], top: Topology, dead: Iterable[bool]) -> str:
    """Names the points of a group whose centres lie on one line, as a clause."""
    for closure, is_dead in zip(closures, dead, strict=True):
        names = [_place(top.bonds[k]) for k in closure.group.bonds]
        if is_dead and len(names) == 3 and all(names):
            return f" ({listed(names)} lie on one line)"
    return ""


def _place(bond: Bond) -> str:
    at = getattr(bond.joint, "at", None)
    return at if at and type(bond.joint).__name__ == "Pin" else ""


def workless(load: str, link: str, at_rest: bool, others_work: bool, why: str) -> str:
    """The unknown does no work: no value balances, or any value does."""
    cause = (
        f"link {link} stands still in this position{why}, so it is a dead centre for {load}"
        if at_rest
        else f"{load} does no work on link {link}: where it acts, its line is square to the motion{why}"
    )
    if others_work:
        return (
            f"no value of {load} balances: {cause}, but the known loads do work. "
            "Put the unknown on another link, or take another position."
        )
    return (
        f"any value of {load} balances: {cause}, and the known loads do none either. "
        "The joints carry it; ask for another load."
    )


def wrong_count(mobility: int, unknowns: int, idle: int) -> str:
    """Freedoms that do not match the unknowns."""
    active = mobility - idle
    if unknowns > active:
        extra = unknowns - active
        return (
            f"{plural(unknowns, 'unknown load')} for a mobility of {active}: {extra} too many. "
            f"Give {'one of them a number' if extra == 1 else f'{extra} of them numbers'}, or tie it to another "
            "with `like`."
        )
    missing = active - unknowns
    return (
        f"the mechanism has {plural(active, 'degree')} of freedom but {plural(unknowns, 'unknown load')}: it would "
        f"not stay in equilibrium. Add {plural(missing, 'unknown load')}, or {plural(missing, 'joint')} to lock it."
    )


def change_point(mobility: int, count: int) -> str:
    """Momentarily more freedoms than the joints leave elsewhere."""
    return (
        f"change point: in this position the mechanism has {plural(mobility, 'degree')} of freedom where counting "
        f"leaves {count}, so it can go on in more than one way. Take a position beside it."
    )
