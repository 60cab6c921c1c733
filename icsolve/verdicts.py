"""Why a scene has no answer: the refusals, each with its status and a full sentence."""

from __future__ import annotations

from icsolve import power, sentences
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.motion import Motions
from icsolve.topology import Topology
from icsolve.twists import is_dead


def refuse_loose(case: Case, top: Topology) -> None:
    """Refuse links that no chain of joints ties to the frame."""
    seen, stack = {top.ground}, [top.ground]
    while stack:
        for k in top.at[stack.pop()]:
            for body in (top.bonds[k].a, top.bonds[k].b):
                if body not in seen:
                    seen.add(body)
                    stack.append(body)
    names = [link for body, links in enumerate(top.members) if body not in seen for link in links]
    if names:
        raise SceneError(Status.LOOSE, sentences.loose(case, names))


def refuse_friction(case: Case) -> None:
    """Refuse joints with friction until free bodies are solved: an answer without it would be wrong."""
    for joint in case.joints:
        friction = getattr(joint, "friction", None)
        if friction is not None and friction.mu.value > 0:
            raise SceneError(
                Status.UNSUPPORTED,
                f"the joint of links {sentences.listed(joint.links)} has friction (mu {friction.mu.digits}), which "
                "is not solved yet. Take out `mu` to solve without friction.",
            )


def refuse_unbalanced(
    case: Case, top: Topology, motions: Motions, balance: power.Balance, solution: power.Solution
) -> None:
    """Refuse unknown loads that have no value, or any, or are not as many as the freedoms."""
    unknowns = sum(power.is_unknown(load) for load in case.loads)
    if solution.verdict == "balanced" or not unknowns:
        return
    active = motions.mobility - len(solution.idle)
    if solution.verdict in ("too few unknowns", "too many unknowns") or unknowns > max(active, 1):
        if motions.redundant and top.freedoms_by_count == unknowns:
            message = sentences.change_point(motions.mobility, top.freedoms_by_count)
            raise SceneError(Status.CHANGE_POINT, message)
        message = sentences.wrong_count(motions.mobility, unknowns, len(solution.idle))
        raise SceneError(Status.MOBILITY, message)
    raise _no_work(top, motions, balance, solution)


def _no_work(
    top: Topology, motions: Motions, balance: power.Balance, solution: power.Solution
) -> SceneError:
    """An unknown that does no work: a dead centre, no value, or any value."""
    culprit = next(w for w in balance.wrenches if w.load.name == solution.culprit)
    largest = max(abs(x) for ts in motions.twists.values() for t in ts for x in t)
    on, off = motions.twists[culprit.load.link], motions.twists[culprit.against]
    apart = max(abs(x - y) for a, b in zip(on, off, strict=True) for x, y in zip(a, b, strict=True))
    at_rest = apart <= AT_REST * largest
    others = solution.verdict == "no value"
    clause = sentences.points_in_line(motions.closures, top, map(is_dead, motions.closures))
    message = sentences.workless(culprit.load.name, culprit.load.link, at_rest, others, clause)
    status = Status.DEAD_CENTRE if at_rest and others else Status.NO_VALUE if others else Status.ANY_VALUE
    return SceneError(status, message)


AT_REST = 1e-13
"""A link whose twist is below this fraction of the fastest stands still (rounding)."""
