"""All motions that the joints allow: by the plan where one freedom follows group by group, else from the loop
equations of the whole scene. What is singular, redundant or rigid is said here.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

from icsolve.assembly.workspace import PlacedCase
from icsolve.errors import SceneError, Status
from icsolve.kinematics import Closure, is_singular, run
from icsolve.numbers import Arithmetic, decider
from icsolve.numbers.units import Number
from icsolve.screws import ORIGIN, Bases, Triple, cross, subtract, velocity
from icsolve.screws.joints import freedoms, guide_direction
from icsolve.structure import Topology
from icsolve.structure.plan import Plan
from icsolve.tuples import LateModule, NamedTuple

if TYPE_CHECKING:
    from icsolve.kinematics import loops
    from icsolve.kinematics.loops import LoopMotions
    from icsolve.screws import ropes as rope_screws
    from icsolve.screws.ropes import RopePart
    from icsolve.wording import sentences
else:
    loops = LateModule("icsolve.kinematics.loops")
    rope_screws, sentences = map(LateModule, ("icsolve.screws.ropes", "icsolve.wording.sentences"))


class Motions(NamedTuple):
    """The motions that the joints allow.

    Attributes
    ----------
    twists : by link, one twist a freedom, relative to the frame [frame length/s, frame length/s, rad/s]
    bases : by bond, its basis twists
    mobility : number of freedoms
    redundant : constraints beyond those that the motion needs
    closures : how the groups of the plan closed; empty where the loop equations gave all at once
    notes : sentences for the reader
    """

    twists: dict[str, tuple[Triple, ...]]
    bases: Bases
    mobility: int
    redundant: int
    closures: tuple[Closure, ...]
    notes: tuple[str, ...]
    slack: float = 0.0
    """by how much given centres and rolling contacts miss each other, of the figure's size"""


def needed_bonds(plan: Plan | None, top: Topology) -> tuple[int, ...]:
    """The bonds whose places the plan needs; every one where the plan is not closed."""
    if plan is None or not plan.closed:
        return tuple(range(len(top.bonds)))
    return plan.bonds


def by_plan(plan: Plan, place: PlacedCase, wanted: Collection[int] | None = None) -> Motions | None:
    """The one motion by the groups of the plan, of the wanted bodies (None: of all that are planned); None
    where a group is singular."""
    top, (_, _, points, arithmetic) = place.top, place
    bonds, members = top.bonds, top.members
    bases = {k: freedoms(bonds[k], points, arithmetic) for k in plan.bonds}
    found, closures = run(plan, top, bases, arithmetic, None if wanted is None else {top.ground, *wanted})
    for closure in closures:
        if is_singular(closure, arithmetic):
            return None
    frame = found.get(top.ground)
    twists: dict[str, tuple[Triple, ...]] = {}
    for body, twist in found.items():
        relative = twist if frame is None or frame is ORIGIN else subtract(twist, frame)
        for link in members[body]:
            twists[link] = (relative,)
    return Motions(twists, bases, 1, 0, closures, ())


def by_loops(place: PlacedCase) -> Motions:
    """Every motion from the loop equations of the whole scene.

    Raises
    ------
    SceneError
        For a structure, for given centres that contradict each other, and where the rank is in doubt.
    """
    top, points, arithmetic = place.top, place.points, place.arithmetic
    bases = {k: freedoms(bond, points, arithmetic) for k, bond in enumerate(top.bonds)}
    ropes = [rope_screws.rope_parts(rope, points, place.frame.scale, arithmetic) for rope in top.ropes]
    motions = loops.all_motions(top, bases, ropes=ropes, vanishes=decider(arithmetic))
    notes: tuple[str, ...] = ()
    exact = bool(motions.found.basis)
    if not exact:
        motions, notes = _almost(place, bases, ropes, motions)
    mobility = len(motions.found.basis)
    redundant = max(mobility - top.freedoms_by_count, 0)
    twists = {link: motions.twists[body] for body, links in enumerate(top.members) for link in links}
    slack = 0.0 if exact else motions.found.dropped
    return Motions(twists, bases, mobility, redundant, (), notes, slack)


TURN = Number(6.283185307179586, 0.0, "turn", "6.283185307179586", 1.0, (2, 1, 1))
"""Radians of a turn."""


def with_ends(motions: Motions, place: PlacedCase) -> Motions:
    """The motions with the turning of screws, cw as one looks along their axes, and with those of the ends of
    ropes that loads pull: under the names of what stands there for links.

    A screw turns by ``2 pi / lead`` rad a length that its slide moves.
    """
    case, frame, points, arithmetic = place
    if not (case.screws or case.ropes):
        return motions
    twists = dict(motions.twists)
    for screw in case.screws:
        x, y = guide_direction(screw.slide.guide, points, arithmetic)
        per = arithmetic.given(TURN) / (arithmetic.given(screw.thread.lead) * frame.scale)
        by, on = (twists[link] for link in screw.links)
        both = [velocity(subtract(b, a), points[screw.slide.at]) for a, b in zip(by, on, strict=True)]
        twists[screw.rotor] = tuple((0.0, 0.0, per * (x * vx + y * vy)) for vx, vy in both)
    for rope in case.ropes:
        if rope.is_free:
            parts = rope_screws.rope_parts(rope, points, frame.scale, arithmetic)
            each = [{link: ts[m] for link, ts in motions.twists.items()} for m in range(motions.mobility)]
            twists[rope.end] = tuple(rope_screws.end_twist(parts, one) for one in each)
    return motions._replace(twists=twists)


AGREE = 2e-3
"""Given centres and rolling contacts may miss each other by this fraction of the figure's size."""
DOUBT = 1e-6
"""A structure whose last pivot is below this may move as far as its data can tell."""


def _almost(
    place: PlacedCase, bases: Bases, ropes: Sequence[Sequence[RopePart]], rigid: LoopMotions
) -> tuple[LoopMotions, tuple[str, ...]]:
    """The motion that data of few digits just miss; refuses a structure and what is in doubt."""
    top = place.top
    pivots = rigid.found.pivots
    last = pivots[-1] if pivots else 1.0
    inexact = [joint for joint in place.case.joints if joint.has_written_centre]
    if inexact and last < AGREE:
        motions = loops.all_motions(top, bases, AGREE / len(pivots), ropes)
        if len(motions.found.basis) == 1:
            miss = f"{float(motions.found.dropped):.1g} of the figure's size"
            return motions, (f"the given centres and rolling contacts agree with each other to {miss}.",)
    if any(joint.stands_in for joint in inexact):
        raise SceneError(Status.CONTRADICTORY, contradiction(place, bases))
    raise _rigid(top, rigid)


def _rigid(top: Topology, motions: LoopMotions) -> SceneError:
    """The refusal of links that cannot move, or of which that is in doubt."""
    pivots = motions.found.pivots
    last = pivots[-1] if pivots else 1.0
    if last < DOUBT:
        return SceneError(Status.NEAR_SINGULAR, sentences.near_structure(last))
    return SceneError(Status.STRUCTURE, sentences.structure(top))


def contradiction(place: PlacedCase, bases: Bases) -> str:
    """Which given centre lies off the place that the others give it, and how far."""
    worst: tuple[float, str] | None = None
    for k, bond in enumerate(place.top.bonds):
        if not bond.joint.stands_in:
            continue
        off = _off_place(place.top, bases, k, place.arithmetic)
        if off is not None and (worst is None or off < worst[0]):
            worst = (off, f"{bond.links[0]}-{bond.links[1]}")
    if worst is None:
        return (
            "the given centres contradict each other: no motion has all of them. Correct one, or leave it "
            "out."
        )
    distance, unit = worst[0] / place.frame.scale, place.case.units.length
    return (
        f"the given centres contradict each other: centre {worst[1]} lies {distance:.3g} {unit} from where "
        "the other centres and joints put it. Correct it, or leave it out."
    )


def _off_place(top: Topology, bases: Bases, k: int, arithmetic: Arithmetic) -> float | None:
    """Distance (normalised) of a given finite centre from the point, or the line, that all else gives."""
    bond, (px, py, pw) = top.bonds[k], bases[k][0]
    others = {n: basis for n, basis in bases.items() if n != k}
    motions = loops.all_motions(top, others, vanishes=decider(arithmetic))
    if pw == 0.0 or bond.a not in motions.twists or bond.b not in motions.twists:
        return None
    both = zip(motions.twists[bond.a], motions.twists[bond.b], strict=True)
    relative = [subtract(b, a) for a, b in both]
    if len(relative) == 2:
        x, y, w = cross(*relative)
        return abs(x * px + y * py + w) / math.hypot(x, y) if x or y else None
    if len(relative) != 1:
        return None
    x, y, w = relative[0]
    return None if arithmetic.vanishes(w, max(abs(x), abs(y))) else math.hypot(x / w - px, y / w - py)
