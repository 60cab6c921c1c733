"""A position in which the loads balance, as the searches find it, and unknown loads that would show how far
from it another is."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from decimal import Decimal
from itertools import combinations

from icsolve.answer import Answer, by_load
from icsolve.answer.equilibrium import Stiffness
from icsolve.case import Case, Force, ForceVector, Number, Torque
from icsolve.errors import SceneError, Status
from icsolve.numbers.balls import Ball, MoreDigits
from icsolve.numbers.units import found_number
from icsolve.scene import solve_by_power, solve_scene
from icsolve.scene.program import EvaluatedScene, Evaluation, Want, prepare
from icsolve.statics.power import has_friction, is_unknown
from icsolve.tuples import NamedTuple, replace
from icsolve.wording.sentences import left_out

PROBE = "@equilibrium"
"""The name of the unknown load by which `icsolve.solve` tells how far a position is from equilibrium."""
AT_LIMIT = "at a limit of the unknown the other links' rates per unit of it grow without bound."
MOST_TRIES = 28
"""Loads that might hold a mechanism of several freedoms are tried so many times."""
NEAR = 1e-6
"""Loads balance where the torque that would balance them is this small beside the largest times the size."""


class RestPosition(NamedTuple):
    """One position of equilibrium of a mode.

    ``answer`` is the solved scene in it and ``case`` that scene, ``links`` those that turn, the
    fastest first, ``size`` the torque of the largest load at the size of the figure [case units].
    """

    value: float
    error: float
    stability: str
    stiffness: Stiffness | None
    why: str
    answer: Answer
    case: Case
    links: list[str]
    size: float


def with_scene(
    answer: Answer,
    links: Sequence[str],
    freedoms: int = 1,
    *,
    all_centres: bool = False,
    rates: bool = False,
    reactions: bool = False,
) -> Answer:
    """The scene in a position with what is asked of it; reactions are those of loads that balance."""
    if not (all_centres or rates or reactions):
        return replace(answer, rates=None, velocities=None, centres={})
    asked = {"all_centres": all_centres, "rates": rates}
    found = held(answer.case, links, freedoms, solve_scene, **asked, reactions=True) if reactions else None
    found = found or solve_scene(answer.case, **asked)
    found = found if rates else replace(found, rates=None, velocities=None)
    shown = found.centres if all_centres else {}
    return replace(found, case=answer.case, answers={}, witnesses=(), centres=shown)


def balances(rest: RestPosition) -> bool:
    """Whether the loads balance there, to what a figure written in decimals can tell."""
    answer = held(rest.case, rest.links, solve=solve_by_power)
    return answer is None or abs(answer.answers[PROBE].value) <= NEAR * rest.size


def taut(rests: Sequence[RestPosition], path: str) -> tuple[list[RestPosition], list[str]]:
    """The positions in which every rope pulls, and a sentence on each of the others."""
    found, notes = list[RestPosition](), list[str]()
    for rest in rests:
        slack = why_slack(rest.case, rest.links)
        if slack:
            notes.append(left_out(f"{path} = {rest.value:.6g}", slack))
        else:
            found.append(rest)
    return found, notes


def why_slack(case: Case, links: Sequence[str], freedoms: int = 1) -> str:
    """Which rope would have to push in a position in which the loads balance; empty where none would."""
    try:
        if case.ropes:
            held(case, links, freedoms)
    except SceneError as refusal:
        if refusal.status == Status.SLACK:
            return refusal.message
    return ""


def held(
    case: Case,
    links: Sequence[str],
    freedoms: int = 1,
    solve: Callable[..., Answer] = solve_scene,
    **asked: bool,
) -> Answer | None:
    """The scene with the first unknown loads, one a freedom, that do work in its motions; None where it has
    none to try. Of several freedoms those of the first loads that hold it with the least: in a position of
    equilibrium others may all but do no work in one motion, and are then as large as may be.

    Raises SceneError where none do, and where a rope would have to push.
    """
    refusal: SceneError | None = None
    best: tuple[float, Case] | None = None
    tries = combinations(probes(case, links, freedoms), freedoms)
    for n, some in enumerate(tries):
        if best is not None and n >= MOST_TRIES:
            break
        named = (load._replace(name=f"{PROBE}{k or ''}") for k, load in enumerate(some))
        loaded = replace(case, loads=(*case.loads, *named))
        try:
            answer = solve(loaded, **(asked if freedoms == 1 else {}))
        except SceneError as error:
            if error.status == Status.SLACK:
                raise
            refusal = error
            continue
        if freedoms == 1:
            return answer
        most = max(abs(answer.answers[load.name].value) for load in loaded.loads[len(case.loads) :])
        if best is None or most < best[0]:
            best = (most, loaded)
    if best is not None:
        return solve(best[1], **asked)
    if refusal is not None:
        raise refusal
    return None


def probes(case: Case, links: Sequence[str], freedoms: int) -> Iterator[Torque | Force]:
    """Unknown loads, one after the other, each of which might hold the mechanism: torques on ``links``; where
    these are too few, forces on points."""
    for link in links:
        yield Torque(PROBE, link, None)
    if links and freedoms == 1:
        return
    for link, names in case.carries.items():
        for name in names if link != case.ground else ():
            for degrees in ("0", "90"):
                along = Number(float(degrees), 0.0, f"loads.{PROBE}.angle", degrees)
                yield Force(PROBE, link, name, None, along)


def holding(case: Case, answer: Answer) -> Case:
    """The case with its unknown loads at the values that were found, in the digits of the balls where power
    alone gives them: how stiff a position is hangs on what doubles cut off."""
    loads, found, digits = [], by_load(answer.answers), _found_digits(case)
    for load in case.loads:
        if is_unknown(load) and not isinstance(load, ForceVector):
            value, path = found[load.name].value, f"loads.{load.name}"
            number = Number(value, 0.0, path, repr(value))
            if load.name in digits and float(digits[load.name]) == value:
                number = found_number(digits[load.name], path)
            load = load._replace(value=number)  # noqa: PLW2901
        loads.append(load)
    return replace(case, loads=tuple(loads), directed=(), expect=(), motion=())


HELD = 1e-60
"""What a found load that is held may lie off, as a fraction: far less than what counts as zero beside it."""


def _found_digits(case: Case) -> dict[str, Decimal]:
    """The unknown loads by power, by name; none where friction or inertia has a share in them."""
    if case.space is not None or case.touches or case.dynamic or has_friction(case):
        return {}
    with suppress(SceneError):
        return EvaluatedScene(prepare(case, Want()), True).ask(_digits)
    return {}


def _digits(found: Evaluation) -> dict[str, Decimal]:
    values = found.outcome.solution.values.items()
    balls = {name: value for name, value in values if isinstance(value, Ball) and not value.holds_zero}
    if any(ball.radius > HELD * abs(ball) for ball in balls.values()):
        raise MoreDigits
    return {name: ball.value for name, ball in balls.items()}
