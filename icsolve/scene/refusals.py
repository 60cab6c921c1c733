"""Why a scene has no answer: the refusals, each with its status and a full sentence."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from icsolve.case import AlongRope, Case, Force, TorsionSpring, Weight
from icsolve.errors import SceneError, Status
from icsolve.kinematics.motion import Motions
from icsolve.numbers import FLOATS, Arithmetic, Scalar, all_vanish
from icsolve.screws import Point
from icsolve.screws.joints import Points
from icsolve.statics import load_wrenches, power
from icsolve.structure import Topology, reached, topology
from icsolve.tuples import LateModule
from icsolve.wording import direction_words, listed

if TYPE_CHECKING:
    from icsolve.kinematics import accelerations
    from icsolve.screws import ropes as rope_screws
    from icsolve.wording import sentences
else:
    accelerations = LateModule("icsolve.kinematics.accelerations")
    rope_screws, sentences = map(LateModule, ("icsolve.screws.ropes", "icsolve.wording.sentences"))


def refuse_loose(case: Case) -> None:
    """Refuse links that no chain of joints ties to the frame."""
    top = topology(case)
    held = [{top.body_of[link] for link in rope.links} for rope in case.ropes]

    def beside(body: int) -> list[int]:
        return [*top.beside(body), *(other for bodies in held if body in bodies for other in bodies)]

    seen = reached((top.ground,), beside)
    names = [link for body, links in enumerate(top.members) if body not in seen for link in links]
    if names:
        raise SceneError(Status.LOOSE, sentences.loose(case, names))


Directions = tuple[tuple[str, tuple[str, str]], ...]
"""What has its direction from two points, and these."""


def directions(case: Case) -> Directions:
    """Those of loads, the arms of torsion springs, guides and wheels."""
    lines = [
        (f"load {load.name}", load_wrenches.line_of(load))
        for load in case.loads
        if not load_wrenches.may_vanish(load)
    ]
    for load in case.loads:
        if isinstance(load, TorsionSpring):
            lines += [(f"the corner of load {load.name}", (load.at, p)) for p in load.corner if p != load.at]
    return (*((what, ends) for what, ends in lines if ends is not None), *directions_of_joints(case))


def directions_of_joints(case: Case) -> Directions:
    """Those of guides and wheels."""
    lines: list[tuple[str, tuple[str, str]]] = []
    for bond in topology(case).bonds:
        guide = bond.joint.guide
        if guide is not None and guide.ends is not None:
            lines.append((f"the guide of links {listed(bond.links)}", guide.ends))
        if bond.pivots:
            lines.append((f"the wheels {listed(bond.links)}", bond.pivots))
    return tuple(lines)


def refuse_no_direction(lines: Directions, points: Points, arithmetic: Arithmetic) -> None:
    """Refuse directions that two points give that lie at one place [frame]."""
    for what, (a, b) in lines:
        if a in points and b in points and load_wrenches.at_one_place(points[a], points[b], arithmetic):
            raise SceneError(
                Status.INCONSISTENT,
                f"there is no direction for {what}: {listed((a, b))} lie at one place. Give it "
                "by an angle, or correct the points.",
            )


def direction_margins(lines: Directions, points: Points) -> Iterator[Scalar]:
    """In any arithmetic, numbers of which none is zero but where `refuse_no_direction` may refuse:
    squares of distances [frame]."""
    for _, (a, b) in lines:
        if a in points and b in points:
            (ax, ay), (bx, by) = points[a], points[b]
            yield (bx - ax) * (bx - ax) + (by - ay) * (by - ay)


HANGS = 2e-3
"""Sine by which a part of a rope may lean on which a weight hangs."""


def refuse_no_hanging(case: Case, points: Points, scale: float) -> None:
    """Refuse a weight at the free end of a rope whose last part does not hang, and parts without a length."""
    for load, (x, y) in _hung(case, points, scale, FLOATS):
        if abs(x) > HANGS or y > 0.0:
            toward = direction_words(math.degrees(math.atan2(y, x)))
            raise SceneError(
                Status.INCONSISTENT,
                f"the weight {load.name} hangs at {load.at}, and the last part of the rope "
                f"{load.link[1:]} does not hang, but runs at {toward}. Put {load.at} under the "
                "last pulley, or give the pull as a `force`.",
            )


def _hung(case: Case, points: Points, scale: float, a: Arithmetic) -> Iterator[tuple[Weight, Point]]:
    """The weights at free ends of ropes, each with the unit vector along the last part of its rope."""
    ropes = {rope.end: rope_screws.rope_parts(rope, points, scale, a) for rope in case.ropes}
    for load in case.loads:
        if isinstance(load, Weight) and load.link in ropes:
            yield load, ropes[load.link][-1].along


def hanging_margins(case: Case, points: Points, scale: float, a: Arithmetic) -> Iterator[Scalar]:
    """In any arithmetic, numbers of which none is negative but where `refuse_no_hanging` may refuse."""
    for _, (x, y) in _hung(case, points, scale, a):
        yield HANGS * HANGS - x * x
        yield -y


def rubs(case: Case) -> bool:
    """Whether friction has a part in the answer: a joint rubs, and a load is unknown."""
    return any(map(power.is_unknown, case.loads)) and power.has_friction(case)


def may_hold(outcome: power.Outcome) -> bool:
    """Whether one unknown load may with friction balance what it does not without: it does no work, or there
    are several freedoms, and no motion is given."""
    if outcome.motions.mobility > 1:
        return len(power.unknown_loads(outcome.balance)) == 1 and not outcome.place.case.motion
    return outcome.solution.is_workless and outcome.motions.mobility == 1


def refuse_unbalanced(outcome: power.Outcome) -> None:
    """Refuse unknown loads that have no value, or any, or are not as many as the freedoms."""
    _, motions, balance, solution = outcome
    unknowns = 0 if solution.verdict == "balanced" else len(power.unknown_loads(balance))
    if not unknowns:
        return
    case, top = outcome.place.case, outcome.place.top
    active = motions.mobility - len(solution.idle)
    if motions.redundant and unknowns < motions.mobility:
        # whatever the loads do: in which of its motions they do no work is a choice of these
        count = top.freedoms_by_count
        if count == unknowns or accelerations.go_on_together(outcome.place, motions.twists) is False:
            message = sentences.change_point(motions.mobility, count if count == unknowns else None)
            raise SceneError(Status.CHANGE_POINT, message)
    if solution.verdict in ("too few unknowns", "too many unknowns") or unknowns > max(active, 1):
        ends = sentences.free_ends(top, case)
        message = sentences.wrong_count(motions.mobility, unknowns, len(solution.idle), ends, case.directed)
        raise SceneError(Status.MOBILITY, message)
    raise _no_work(outcome)


def _no_work(outcome: power.Outcome) -> SceneError:
    """An unknown that does no work: a dead centre, no value, or any value."""
    place, motions, balance, solution = outcome
    top, arithmetic = place.top, place.arithmetic
    culprit = next(w for w in balance.wrenches if w.load.name == solution.culprit)
    others = solution.verdict == "no value"
    if culprit.load.link == culprit.against:
        status = Status.NO_VALUE if others else Status.ANY_VALUE
        return SceneError(status, sentences.on_the_frame(culprit.load.name, culprit.load.link, others))
    largest = max(abs(x) for ts in motions.twists.values() for t in ts for x in t)
    on, off = motions.twists[culprit.load.link], motions.twists[culprit.against]
    apart = [x - y for a, b in zip(on, off, strict=True) for x, y in zip(a, b, strict=True)]
    at_rest = all_vanish(arithmetic, ((part, largest) for part in apart))
    links = [culprit.load.link, *([] if culprit.against == place.case.ground else [culprit.against])]
    slack = culprit.gain == 0.0 or arithmetic.vanishes(culprit.gain, culprit.reach)
    alike = [w.load.name for w in balance.wrenches if w.root == culprit.root and w is not culprit]
    place_in = next(n for n, w in enumerate(balance.wrenches) if w is culprit)
    works = any(not arithmetic.vanishes(factors[place_in], largest) for factors in balance.factors)
    unknown = [w.load.name for w in power.unknown_loads(balance)]
    turned = False
    if works and alike:
        cause = sentences.undone(culprit.load.name, alike)
    elif at_rest and not slack:
        why = _why_at_rest(top, motions, links[0], arithmetic) if len(links) == 1 else ""
        cause = sentences.at_rest(culprit.load.name, links, why)
    else:
        couple, load = not any(culprit.unit[:2]), culprit.load
        turned = not (couple or slack) and isinstance(load, Force) and not isinstance(load.heading, AlongRope)
        cause = sentences.idle_load(culprit.load.name, links, couple, slack)
    message = sentences.workless(culprit.load.name, cause, others, turned)
    if works and len(unknown) > 1:
        message = sentences.workless_together(unknown, others)
    if len(top.members) > 2 and (ends := sentences.free_ends(top, place.case)):
        message += f" Is a joint missing? {ends[0].upper()}{ends[1:]}."
    status = Status.DEAD_CENTRE if at_rest and others else Status.NO_VALUE if others else Status.ANY_VALUE
    return SceneError(status, message)


def _why_at_rest(top: Topology, motions: Motions, link: str, arithmetic: Arithmetic) -> str:
    """Which centres on one line hold a link at rest."""
    body = top.body_of.get(link, -1)  # none of a screw, or of a rope's end
    own_first = sorted(motions.closures, key=lambda closure: body not in closure.group.bodies)
    from icsolve.kinematics.centres import aligned, lined_up

    clauses = (aligned(top, lined_up(closure, top, body, arithmetic)) for closure in own_first)
    return next(filter(None, clauses), "")


def not_as_written() -> SceneError:
    """The refusal of a figure that the doubles close, and the decimals of the file do not."""
    return SceneError(Status.CANNOT_ASSEMBLE, sentences.not_as_written())


FLAT = 1e-6
"""How flat a loop of links is whose three centres are said to lie nearly on one line."""


def too_close(top: Topology, motions: Motions, load: str, open_by: float | None) -> SceneError:
    """The refusal of a scene whose data do not decide it."""
    from icsolve.kinematics.centres import aligned, flatness, tightest

    group = tightest(motions.closures)
    flat = group is not None and flatness(group) < FLAT
    why = aligned(top, sorted(group.group.bonds), "lie nearly on") if group and flat else ""
    return SceneError(Status.NEAR_SINGULAR, sentences.too_close(load, why, open_by))
