"""The equilibrium of every link of a scene: reactions, friction, and structures, which have nothing else."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING

from icsolve.answer import Answer
from icsolve.errors import SceneError, Status
from icsolve.numbers import FLOATS, Showing
from icsolve.scene.parts import AnswerBuilder, speed_of
from icsolve.scene.program import (
    EvaluatedScene,
    Evaluation,
    HeldAt,
    Program,
    evaluate_still,
    plain,
    points_shown,
    prepare,
)
from icsolve.statics.free_bodies import FreeBodies, Reach, free_bodies
from icsolve.statics.power import Balance, Value, has_friction, is_unknown, smooth
from icsolve.statics.reaction_basis import Position, rope_ties
from icsolve.tuples import LateModule, TypeVar, replace

if TYPE_CHECKING:
    from icsolve.scene import sensitivity
    from icsolve.statics.friction.enclosure import SceneOnBalls
    from icsolve.statics.friction.in_motion import Enclose
    from icsolve.statics.friction.pushing import RestingScene
    from icsolve.statics.friction.standing import Standing
    from icsolve.wording import sentences
else:  # where a program wrote numbers
    sensitivity, sentences = map(LateModule, ("icsolve.scene.sensitivity", "icsolve.wording.sentences"))

T = TypeVar("T")


def with_bodies(parts: AnswerBuilder, reactions: bool) -> Answer:
    """The answer with the reactions, and with the unknown loads as free bodies give them."""
    if holds(parts):
        from icsolve.statics.friction.standing import held_bodies

        at_rest = parts.scene.ask(
            lambda one: held_bodies(_position(one), one.outcome.balance, one.arithmetic)
        )
        return at_rest.added_to(parts.answer(), reactions)
    by_power = {root: (value.value, value.error or 0.0) for root, value in parts.unknowns.items()}
    found = parts.scene.ask(lambda evaluated: _bodies(evaluated, by_power, parts.reach_of_figure))
    return found.added_to(parts.answer(), reactions)


def holds(parts: AnswerBuilder) -> bool:
    """Whether the friction of joints holds loads that are all known.

    Raises SceneError where it does not.
    """
    case = parts.case
    if case.motion or not has_friction(case) or any(map(is_unknown, case.loads)):
        return False
    held = _stands(parts.scene)
    if held is False:
        raise SceneError(Status.UNBALANCED, f"{SLIPS} {beyond_friction(parts.scene)}".rstrip())
    return bool(held)


def _stands(scene: EvaluatedScene) -> bool | None:
    """Whether loads that are all known are held; None where a rope or a screw turns, and where it hangs
    on how hard the fit of the joints presses them together."""
    case = scene.program.case
    if any(rope.slips for rope in case.ropes) or any(screw.rubs for screw in case.screws):
        return None
    with suppress(SceneError):
        return standing(scene).depth >= 0.0
    return None


SLIPS = (
    "friction is not enough to hold the known loads, so there are no reactions at rest. Make one of the "
    "loads `unknown`, and give the `motion` that it keeps up."
)


def _bodies(
    found: Evaluation, power: Mapping[str, tuple[float, float]], figure: Reach = lambda motion: 0.0
) -> FreeBodies:
    if found.outcome.motions.slack:  # the given centres miss the motion: no digits would be right
        found = found._replace(outcome=plain(found.outcome), arithmetic=FLOATS)
    return free_bodies(_position(found), found.outcome.balance, power, found.arithmetic, figure)


def with_friction(parts: AnswerBuilder, reactions: bool) -> Answer:
    """The answer with friction, from free bodies; its motion or the range in which it holds."""
    from icsolve.statics.friction.in_motion import FrictionScene, moving

    def answer_with(values: Mapping[str, Value]) -> Answer:
        return parts.with_values(values).answer()  # the ends of a range have values of their own

    outcome = parts.outcome
    position = _position(parts.first._replace(outcome=outcome, arithmetic=FLOATS))
    enclose, alone = _enclose(parts) if parts.scene.certain else None, parts.program.want.alone
    place = position, outcome.balance, outcome.solution, lambda: parts.speed
    at = alone.load if isinstance(alone, HeldAt) else None
    scene = FrictionScene(*place, lambda: parts.traced, enclose, bool(alone), at)
    if position.case.motion:
        return moving(scene, answer_with, reactions)
    from icsolve.statics.friction.at_rest import held

    found = held(scene, answer_with)
    if not (any(one.self_locking for one in found.answers.values()) and _but_presses(parts)):
        return found
    found = held(scene._replace(presses=True), answer_with)
    return replace(found, notes=(*found.notes, sentences.PRESSES))


FEW = 16.0
"""Half units of the last digit by which the sums and products of a program may miss."""


def _but_presses(parts: AnswerBuilder) -> bool:
    """Whether the unknown load works by the last digits alone of numbers that a program rounded."""
    if parts.outcome.solution.verdict != "balanced" or not parts.scene.certain or parts.scene.explained:
        return False
    if not sensitivity.written_by_program(parts.case):
        return False
    with suppress(SceneError):
        explained = EvaluatedScene(parts.program, True, explained=FEW)
        return explained.ask(lambda one: one.outcome.solution.is_workless)
    return False


def standing(scene: EvaluatedScene) -> Standing:
    """How far known loads are from slipping, friction counted, and contacts from parting.

    Raises SceneError where that is open.
    """
    from icsolve.statics.friction.standing import standing as found

    return found(_resting(scene))


def beyond_friction(scene: EvaluatedScene) -> str:
    """The sentence on what no friction helps where it does not hold known loads; empty where more would."""
    from icsolve.statics.friction.standing import beyond_friction as found

    return found(_resting(scene))


def jammed(scene: EvaluatedScene) -> str:
    """The sentence on contacts that push by friction alone; empty where none does."""
    from icsolve.statics.friction.lifting import jammed as found

    return found(*_in_floats(scene))


def _resting(scene: EvaluatedScene) -> RestingScene:
    from icsolve.statics.friction.pushing import RestingScene

    def ask(question: Callable[[Position, Balance, Showing], T]) -> T:
        return scene.ask(lambda one: question(_position(one), one.outcome.balance, one.arithmetic))

    return RestingScene(*_in_floats(scene), ask)


def _in_floats(scene: EvaluatedScene) -> tuple[Position, Balance]:
    first = scene.ask(lambda one: one._replace(outcome=plain(one.outcome), arithmetic=FLOATS))
    return _position(first), first.outcome.balance


def _enclose(parts: AnswerBuilder) -> Enclose:
    """Asks the scene on balls."""
    from icsolve.statics.friction.enclosure import SceneOnBalls

    known: dict[int, SceneOnBalls] = {}

    def placed(found: Evaluation) -> SceneOnBalls:
        if id(found) not in known:  # the scene keeps what it has evaluated
            position, balance = _position(found), found.outcome.balance
            known[id(found)] = SceneOnBalls(position, balance, partial(speed_of, found), found.arithmetic, {})
        return known[id(found)]

    def ask(question: Callable[[SceneOnBalls], T]) -> T:
        return parts.scene.ask(lambda found: question(placed(found)))

    return ask


def _position(found: Evaluation) -> Position:
    """An evaluated scene as free bodies take it."""
    place, moves, *_ = found.outcome
    return Position(*place, moves.twists, float(moves.slack), rope_ties(place))


def structure(program: Program, bound: bool, refusal: SceneError) -> Answer:
    """A structure by statics alone: its reactions, without friction if it stands so.

    Raises the refusal of power where there is an unknown load: nothing would determine it.
    """
    case, figure = program.case, program.figure
    parting = bool(case.ropes) or any(joint.only_pushes for joint in case.joints)
    if any(is_unknown(load) for load in case.loads):
        said = str(refusal).partition(" Take out")[0]
        raise SceneError(refusal.status, f"{said} {CARRIED_WHERE if parting else CARRIED}")
    scene = EvaluatedScene(program, bound, run=evaluate_still)
    points, errors = scene.ask(points_shown)
    said, held = "the links form a structure: nothing moves, and statics alone gives the reactions.", None
    if rubs := has_friction(case):
        said += " Friction is left out: a structure needs none."
    if rubs and parting:
        bare = EvaluatedScene(prepare(smooth(case), program.want), bound, run=evaluate_still)
        if _stands(bare) is False:
            held = _stands(scene)
            said = LETS_GO[held] + (f" {beyond_friction(scene)}".rstrip() if held is False else "")
    notes = (*figure.notes, *case.noticed, said)
    answer = Answer(
        case,
        points=points,
        mobility=0,
        notes=notes,
        skipped=figure.skipped,
        errors={"points": errors},
        holds_still=held,
    )
    if held:
        from icsolve.statics.friction.standing import held_bodies

        return scene.ask(
            lambda one: held_bodies(_position(one), one.outcome.balance, one.arithmetic)
        ).added_to(answer)
    return scene.ask(lambda found: _bodies(found, {})).added_to(answer)


CARRIED = "Any value of the unknown load is carried: give it a number, or take out a joint or a link."
CARRIED_WHERE = (
    "Its contacts only push and its ropes only pull: give the unknown load a number, and `icsolve sweep` "
    "with `--find hold` along it tells which values are carried; or take out a joint or a link."
)
LETS_GO = {
    held: f"the links form a structure, but without friction a contact or a rope of it would let go. {said}"
    for held, said in (
        (True, "Friction is enough: under the known loads it holds still."),
        (False, "Friction is not enough: under the known loads it moves. The reactions leave it out."),
        (None, "Whether friction is enough is open. The reactions leave it out."),
    )
}
