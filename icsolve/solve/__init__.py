"""The pipeline: a case, its figure, the motions that its joints allow, the sum of power, the answer.

1. topology: which links move as one, and the joints between them
2. plan: the groups of links that the wanted twists need, and no others
3. figure: the points that those groups and the loads need
4. motions: the twist of every planned link (a centre that keeps its weight)
5. power: the loads' wrenches on the twists give the unknown loads
6. centres and rates, as far as they are asked for
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from icsolve.answer import Answer
from icsolve.case import Case, Coordinates, Number
from icsolve.errors import SceneError, Status
from icsolve.numbers.balls import is_long
from icsolve.solve import refusals
from icsolve.solve.bounds import Evaluation, Scene, Value
from icsolve.solve.parts import Parts
from icsolve.solve.program import Program, Want, prepare
from icsolve.statics import power

if TYPE_CHECKING:
    from icsolve.statics.reaction_basis import Position


def solve(
    case: Case,
    *,
    all_centres: bool = False,
    rates: bool = False,
    examine: bool = False,
    bound: bool = True,
    reactions: bool = False,
    dynamic: bool = False,
) -> Answer:
    """Solve a case.

    Parameters
    ----------
    case : Case
        As `icsolve.load` returns it.
    all_centres : bool
        All n(n-1)/2 centres rather than those that the loads need.
    rates : bool
        Link rates and point velocities too.
    examine : bool
        Solve and check the whole figure, also what the answer does not need.
    bound : bool
        Every number to the last digit of its double, with a bound on its error; else in floats alone.
    reactions : bool
        The force of each link on each other at every joint too. A structure whose loads are all known is
        solved for them in any case.
    dynamic : bool
        With the inertia forces of the given motion among the loads, and the accelerations; as `dynamic: yes`
        in the case.

    Raises SceneError where the scene has no answer; its ``status`` is a member of `icsolve.errors.Status`.
    """
    if (dynamic or case.dynamic) and not any(load.name.startswith("inertia ") for load in case.loads):
        from icsolve.solve.dynamics import solve_dynamic

        asked = {"all_centres": all_centres, "rates": True, "examine": examine}
        return solve_dynamic(case, solve, **asked, bound=bound, reactions=reactions)
    if case.unknowns or (None in _coordinates(case) and _asks_for_a_position(case)):
        from icsolve.equilibrium import solve_positions

        return solve_positions(case, all_centres=all_centres, rates=rates, reactions=reactions)
    if case.space is not None:
        from icsolve.statics.space.solve import solve_space

        return solve_space(case)
    if case.profiles is not None and case.profiles.touches:
        from icsolve.cams.solving import solve_touching

        asked = {"all_centres": all_centres, "rates": rates, "examine": examine}
        return solve_touching(case, **asked, bound=bound, reactions=reactions)
    return _solved(case, _wanted(case, Want(all_centres, rates, examine, reactions)), bound, reactions)


def _coordinates(case: Case) -> list[Number | None]:
    places = (at for at in case.points.values() if isinstance(at, Coordinates))
    return [number for at in places for number in (at.x, at.y)]


def _asks_for_a_position(case: Case) -> bool:
    """Whether an unknown coordinate is one that nothing else fixes, and the loads are all known."""
    if not case.loads or any(map(power.is_unknown, case.loads)):
        return False
    from icsolve.equilibrium.answering import free_coordinate

    return free_coordinate(case) is not None


@lru_cache(maxsize=32)
def _wanted(case: Case, asked: Want) -> Want:
    """What is to be found for what was asked: without an unknown, what moves; with friction, all forces."""
    if not _asks(case):
        return asked._replace(centres=True, rates=True)
    return asked._replace(bodies=asked.bodies or refusals.rubs(case))


def _asks(case: Case) -> bool:
    """Whether a load is unknown."""
    return any(power.is_unknown(load) for load in case.loads)


class Attempt(NamedTuple):
    """A case as far as it goes: its answer, or why it has none; and the motion of its links, where that is
    known (which a case has, too, that its loads leave without an answer)."""

    answer: Answer | None
    refusal: SceneError | None
    scene: Parts | None


def attempt(case: Case, *, reactions: bool = False) -> Attempt:
    """Solve all of a case once, and keep what was found: never raises `SceneError`."""
    if case.space is not None or case.dynamic or case.unknowns:
        return _tried(case, reactions)
    if case.profiles is not None and case.profiles.touches:
        return _touching(case, reactions)
    want = _wanted(case, Want(True, True, False, reactions))
    try:
        parts = Parts(Scene(prepare(case, want), certain=True))
    except SceneError:  # of a link or point that the answer does not need, it may be
        return _tried(case, reactions)
    try:
        return Attempt(_judged(parts, reactions), None, parts)
    except SceneError as refusal:
        if not (reactions and refusal.status == Status.UNBALANCED):
            return Attempt(None, refusal, parts)
    try:  # its centres and speeds can still be told
        return Attempt(_judged(parts, False), None, parts)
    except SceneError as refusal:
        return Attempt(None, refusal, parts)


def _tried(case: Case, reactions: bool) -> Attempt:
    """What the answer needs, and no more."""
    try:
        answer = solve(case, reactions=reactions)
    except SceneError as refusal:
        return Attempt(None, refusal, None)
    return Attempt(answer, None, answer.scene)


def _touching(case: Case, reactions: bool) -> Attempt:
    """A case with profiles: its contacts are found, and then it is one like any other."""
    from icsolve.cams.solving import placed

    try:
        answer = solve(case, all_centres=True, rates=True, reactions=reactions)
    except SceneError as refusal:
        own = placed(case)
        return Attempt(None, refusal, None if own is case else attempt(own).scene)
    return Attempt(answer, None, answer.scene)


def _solved(case: Case, want: Want, bound: bool, reactions: bool) -> Answer:
    """Position, centres, power: the answer of a planar case whose contacts are given."""
    program = prepare(case, want)  # the steps that are needed, and the figure in its position
    try:  # the twist of every link, and the power of the loads on them
        return _judged(Parts(Scene(program, bound)), reactions)
    except SceneError as refusal:
        if bound and refusal.status in INEXACT and _has_long_numbers(case):
            try:
                return _judged(Parts(Scene(program, bound, explained=True)), reactions)
            except SceneError as other:
                if other.status not in INEXACT or refusals.rubs(case):
                    raise
        if refusal.status == Status.STRUCTURE and (reactions or not _asks(case)):
            return _structure(prepare(case, want._replace(bodies=True)), refusal)
        raise


INEXACT = (Status.STRUCTURE, Status.MOBILITY, Status.NEAR_SINGULAR, Status.CONTRADICTORY)
"""What a case may seem whose numbers a program has rounded."""


def _has_long_numbers(case: Case) -> bool:
    """Whether a program wrote numbers of a case."""
    from icsolve.solve.sensitivity import numbers_of

    return any(map(is_long, numbers_of(case).values()))


def _judged(parts: Parts, reactions: bool) -> Answer:
    """The answer of an evaluated scene; refused where power does not determine it."""
    if parts.program.want.bodies and refusals.rubs(parts.case):
        return _with_friction(parts, reactions)
    _refuse_unbalanced(parts)
    slack = parts.case.ropes and _asks(parts.case)  # whether a rope would have to push, its tension tells
    return _with_bodies(parts, reactions) if reactions or slack else parts.answer()


def _refuse_unbalanced(parts: Parts) -> None:
    """Refuse unknown loads that power does not determine."""

    def refuse(found: Evaluation) -> None:
        top, (_, motions, balance, solution) = found.program.top, found.outcome
        refusals.refuse_unbalanced(parts.case, top, motions, balance, solution, found.arithmetic)

    parts.scene.ask(refuse)


def _with_bodies(parts: Parts, reactions: bool) -> Answer:
    """The answer with the reactions, and with the unknown loads as free bodies give them."""
    from icsolve.statics.free_bodies import free_bodies

    by_power = {root: (value.value, value.error or 0.0) for root, value in parts.unknowns.items()}
    found = free_bodies(_position(parts), parts.figure.frame, parts.outcome.balance, by_power)
    return found.added_to(parts.answer(), reactions)


def _with_friction(parts: Parts, reactions: bool) -> Answer:
    """The answer with friction, from free bodies; its motion or the range in which it holds."""
    from icsolve.statics.friction import Scene, solved

    def answer_with(values: Mapping[str, Value]) -> Answer:
        parts.given = dict(values)
        return parts.answer()

    outcome = parts.outcome
    if not refusals.is_workless(outcome.motions, outcome.solution):
        _refuse_unbalanced(parts)
    scene = Scene(_position(parts), parts.figure.frame, outcome.balance, outcome.solution, parts.speed)
    return solved(scene._replace(traced=parts.traced), answer_with, reactions)


def _position(parts: Parts) -> Position:
    """The scene as free bodies take it."""
    from icsolve.statics.reaction_basis import Position, rope_ties

    case, figure, moves = parts.case, parts.figure, parts.outcome.motions
    scale, slack = figure.frame.scale, float(moves.slack)
    found = parts.first.outcome.points
    points = {name: (float(x), float(y)) for name, (x, y) in found.items()}  # the exact places, rounded once
    ropes = rope_ties(case, points, scale)
    return Position(case, parts.program.top, points, scale, moves.twists, slack, ropes)


def _structure(program: Program, refusal: SceneError) -> Answer:
    """A structure by statics alone; it has no unknown load that anything would determine."""
    from icsolve.statics.free_bodies import structure

    return structure(program, refusal)
