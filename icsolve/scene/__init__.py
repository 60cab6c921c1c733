"""A mechanism in one position: its figure, the motions that its joints allow, the sum of power, the answer.

1. topology: which links move as one, and the joints between them
2. plan: the groups of links that the wanted twists need, and no others
3. figure: the points that those groups and the loads need
4. motions: the twist of every planned link (a centre that keeps its weight)
5. power: the loads' wrenches on the twists give the unknown loads
6. centres and rates, as far as they are asked for
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from icsolve.answer import Answer
from icsolve.assembly import NOT_NEEDED
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.scene import refusals
from icsolve.scene.parts import AnswerBuilder
from icsolve.scene.program import EvaluatedScene, HeldAt, Want, evaluate_still, prepare
from icsolve.statics.power import has_friction, is_unknown
from icsolve.tuples import LateModule, replace

if TYPE_CHECKING:
    from icsolve.scene import needed_part, sensitivity
    from icsolve.statics.friction.standing import Standing
else:  # where the whole is refused
    needed_part, sensitivity = map(LateModule, ("icsolve.scene.needed_part", "icsolve.scene.sensitivity"))


def solve_scene(
    case: Case,
    *,
    all_centres: bool = False,
    rates: bool = False,
    examine: bool = False,
    bound: bool = True,
    reactions: bool = False,
    dynamic: bool = False,
    alone: bool | HeldAt = False,
) -> Answer:
    """Solve a case whose figure is given; the options are those of `icsolve.solve`, ``alone`` is that of
    `Want`.

    Inertia forces and contacts of profiles are worked out first: with them it is a case like any other.
    Raises SceneError where the scene has no answer.
    """
    asked: dict[str, Any] = {"all_centres": all_centres, "rates": rates, "examine": examine, "bound": bound}
    asked["alone"] = alone
    if case.space is not None:
        if without_inertia(case, dynamic):
            raise SceneError(Status.UNSUPPORTED, AT_REST)
        from icsolve.statics.space.solve import solve_space

        found = solve_space(case, bound)
        return replace(found, notes=(*found.notes, PLANAR)) if all_centres or rates else found
    try:
        if case.touches:
            from icsolve.cams.solving import solve_touching

            return solve_touching(case, solve_scene, **asked, reactions=reactions, dynamic=dynamic)
        if without_inertia(case, dynamic):
            from icsolve.scene.dynamics import solve_dynamic

            return solve_dynamic(case, solve_scene, **{**asked, "rates": True}, reactions=reactions)
        return _answer(case, Want(all_centres, rates, examine, reactions, alone), bound)
    except SceneError as refusal:
        if not case.noticed or refusal.status not in MISTAKEN or NOTICED in refusal.message:
            raise
        said = f"{refusal.message.rstrip('.')}.{NOTICED}{' '.join(case.noticed)}"
        raise SceneError(refusal.status, said, refusal.more) from None


def examined(case: Case, solve: Callable[..., Answer] = solve_scene, **asked: bool) -> Answer:
    """The answer with all of the figure that can be placed; a note on what nothing needs and can't.

    Raises SceneError where what the answer needs has none.
    """
    try:
        return solve(case, **asked, examine=True)
    except SceneError as refusal:
        answer = solve(case, **asked)
        if any(refusal.message in note for note in answer.notes):
            return answer
        return replace(answer, notes=(*answer.notes, f"{NOT_NEEDED}{refusal.message}"))


def _answer(case: Case, asked: Want, bound: bool) -> Answer:
    """The answer; where all that is asked is refused, without links that it does not need, or without what
    is said of contacts."""
    want, least = wanted(case, asked), wanted(case, asked, False)
    try:
        return _solved(case, want, bound, asked.bodies)
    except SceneError as refusal:
        if want.everything and not want.examine:
            with suppress(SceneError):
                part, left_out = needed_part.without_spare_links(case, refusal, bodies=want.bodies)
                answer = _solved(part, want, bound, asked.bodies)
                return replace(answer, notes=(*answer.notes, left_out))
        if want == least:
            raise
        answer = _solved(case, least, bound, asked.bodies)
        said = "" if refusal.status == Status.SLACK else UNEXAMINED
        return replace(answer, notes=(*answer.notes, f"{said}{refusal.message}"))


def solve_by_power(case: Case, *, rates: bool = False) -> Answer:
    """The unknown loads by power alone, whether ropes and contacts pull and push for them or not.

    Raises SceneError as `solve_scene`.
    """
    if case.touches:
        from icsolve.cams.solving import solve_touching

        return solve_touching(case, lambda found, **_: solve_by_power(found, rates=rates), bound=True)
    return _solved(case, Want(rates=rates), True, False)


PLANAR = "instant centres and rates are told of planar cases only, and this one is in space."
AT_REST = "a case in space is solved at rest: give the forces of inertia as loads, and leave `dynamic` out."
NOTICED = " Noticed: "
UNEXAMINED = "whether its contacts have to pull was not examined: "
MISTAKEN = (
    *(Status.STRUCTURE, Status.MOBILITY, Status.NO_VALUE, Status.ANY_VALUE, Status.DEAD_CENTRE),
    *(Status.INCONSISTENT, Status.CANNOT_ASSEMBLE, Status.UNDERDETERMINED),
)
"""Refusals of which the cause may be what was noticed in the file."""


def without_inertia(case: Case, dynamic: bool) -> bool:
    """Whether inertia forces are asked for and are not yet among the loads."""
    return (dynamic or case.dynamic) and not any(load.name.startswith("inertia ") for load in case.loads)


@lru_cache(maxsize=32)
def wanted(case: Case, asked: Want, touching: bool = True) -> Want:
    """What is to be found for what was asked: without an unknown, what moves; with friction, ropes, which
    have to pull, and contacts, which have to push (unless not ``touching``), all forces."""
    asks = _asks(case)
    presses = bool(case.ropes and asks) or refusals.rubs(case)
    if touching and case.loads:
        presses = presses or bool(case.ropes) or any(joint.only_pushes for joint in case.joints)
    asked = asked._replace(bodies=asked.bodies or presses)
    return asked if asks else asked._replace(centres=True, rates=True)


def _asks(case: Case) -> bool:
    """Whether a load is unknown."""
    return any(map(is_unknown, case.loads))


def _solved(case: Case, want: Want, bound: bool, reactions: bool) -> Answer:
    """Position, centres, power: the answer of a planar case whose contacts are given."""
    program = prepare(case, want)  # the steps that are needed, and the figure in its position
    try:  # the twist of every link, and the power of the loads on them
        return judged(balanced(AnswerBuilder(EvaluatedScene(program, bound))), reactions)
    except SceneError as refusal:
        if bound and refusal.status in INEXACT and sensitivity.written_by_program(case):
            try:
                return judged(AnswerBuilder(EvaluatedScene(program, bound, explained=1.0)), reactions)
            except SceneError as other:
                if other.status not in INEXACT or refusals.rubs(case):
                    raise
        if refusal.status == Status.STRUCTURE and (reactions or not _asks(case)):
            from icsolve.scene.free_bodies import structure

            return structure(prepare(case, want._replace(bodies=True)), bound, refusal)
        raise


def standing(case: Case) -> Standing:
    """How far a case whose loads are all known is from slipping at rest, friction counted, and its contacts
    from parting; a structure too.

    Raises SceneError where the scene can't be built, and where that is open.
    """
    from icsolve.scene import free_bodies

    return free_bodies.standing(_with_known_loads(case))


def beyond_friction(case: Case) -> str:
    """The sentence on what no friction helps where it does not hold known loads; empty where more would.

    Raises SceneError where the scene can't be built.
    """
    from icsolve.scene import free_bodies

    return free_bodies.beyond_friction(_with_known_loads(case))


def jammed(case: Case) -> str:
    """The sentence on contacts that push by friction alone where known loads are held; empty where none does.

    Raises SceneError where the scene can't be built.
    """
    from icsolve.scene import free_bodies

    return free_bodies.jammed(_with_known_loads(case))


def _with_known_loads(case: Case) -> EvaluatedScene:
    """A scene whose loads are all known; a structure too."""
    from icsolve.cams.solving import placed

    case = placed(case)
    program = prepare(case, wanted(case, Want(bodies=True)))
    try:
        return balanced(AnswerBuilder(EvaluatedScene(program, certain=True))).scene
    except SceneError as refusal:
        if refusal.status != Status.STRUCTURE:
            raise
        return EvaluatedScene(program, True, run=evaluate_still)


INEXACT = (Status.STRUCTURE, Status.MOBILITY, Status.NEAR_SINGULAR, Status.CONTRADICTORY)
"""What a case may seem whose numbers a program has rounded."""


def balanced(parts: AnswerBuilder) -> AnswerBuilder:
    """The scene; where its known loads balance but for the last digits of numbers that a program rounded, as
    explained by these."""
    scene = parts.scene
    if _asks(parts.case) or scene.explained or not (scene.certain and parts.first.outcome.motions.mobility):
        return parts
    if parts.in_equilibrium or not sensitivity.written_by_program(parts.case):
        return parts
    with suppress(SceneError):
        explained = AnswerBuilder(EvaluatedScene(parts.program, True, explained=1.0))
        return explained if explained.in_equilibrium else parts
    return parts


def judged(parts: AnswerBuilder, reactions: bool) -> Answer:
    """The answer of an evaluated scene; refused where power does not determine it."""
    rubs = parts.program.want.bodies and refusals.rubs(parts.case)
    if not (rubs and refusals.may_hold(parts.outcome)):
        parts.scene.ask(lambda found: refusals.refuse_unbalanced(found.outcome))
    if rubs:
        from icsolve.scene.free_bodies import with_friction

        return with_friction(parts, reactions)
    if reactions or (parts.program.want.bodies and (_asks(parts.case) or _rests(parts))):
        from icsolve.scene.free_bodies import with_bodies

        return with_bodies(parts, reactions)
    return parts.answer()


def _rests(parts: AnswerBuilder) -> bool:
    """Whether the known loads balance, and nothing rubs."""
    return parts.in_equilibrium and not has_friction(parts.case)
