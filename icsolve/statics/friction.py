"""A scene with friction: the unknown loads in the given motion, or the range in which it holds still."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from icsolve.answer import Answer, Deferred, Found
from icsolve.answer.bodies import Friction, Witness
from icsolve.case import Belt, Gears
from icsolve.errors import SceneError, Status
from icsolve.solve.bounds import Value
from icsolve.statics import gears
from icsolve.statics.agreement import bounds_of, refuse_apart, witnesses
from icsolve.statics.certain import Certain, certain
from icsolve.statics.equilibrium import Statics, equilibrium, residual, terms_of
from icsolve.statics.holding import End, Held, held
from icsolve.statics.losses import unknowns_by_power
from icsolve.statics.power import is_unknown
from icsolve.statics.pressing import pressed
from icsolve.statics.reactions import names_by_tie, reactions_of
from icsolve.statics.reduction import forces_of
from icsolve.statics.rubbing import (
    Scene,
    place_of,
    refuse_power,
    rubbing_of,
    said_at_rest,
    said_in_motion,
    senses_of,
)
from icsolve.statics.rubs import rubs_of
from icsolve.statics.said import said_of
from icsolve.statics.sliding import Slid, slid
from icsolve.statics.statics import Bodies, Solved, carrying_flanks, frictionless, on_flanks, refuse_doubt
from icsolve.statics.ties import Tie, ties_of
from icsolve.wording.sentences import plural


def in_motion(scene: Scene) -> tuple[dict[str, float], Bodies, Certain]:
    """The unknown loads (case units) that keep up the given motion, the free bodies, and bounds.

    Raises SceneError where no value does, where several do without one to prefer, and where the sense
    of a rub is open.
    """
    ties, workless = ties_of(scene.position), _is_workless(scene)
    slides: list[Slid] = []

    def solve(flanked: Sequence[Tie]) -> Solved:
        statics = _statics(scene, flanked)
        slides.append(slid(statics, senses_of(scene, statics).signs, workless))
        return Solved(statics, slides[-1].unknowns, slides[-1].friction)

    solved = on_flanks(scene.position, ties, _flanks(scene, ties, workless), solve)
    sure = _certain(scene, solved, senses_of(scene, solved.statics).signs)
    return solved.unknowns, _bodies(scene, solved, slides[-1], workless), sure


def _certain(scene: Scene, solved: Solved, senses: Sequence[float]) -> Certain:
    return certain(scene.position, scene.balance, solved, senses, scene.traced, scene.speed)


def at_rest(scene: Scene) -> tuple[Held, float | None, str]:
    """The range of the one unknown load in which the mechanism holds still.

    With it the bound of its ends (case units), None with the reason where none is proven.

    Raises SceneError at a mobility above 1, where the range of one load depends on the others.
    """
    if scene.position.mobility - len(scene.solution.idle) != 1:
        message = (
            f"friction at {plural(scene.position.mobility, 'degree')} of freedom needs `motion`, one for "
            "each: without it each unknown load has a range that depends on the others."
        )
        raise SceneError(Status.MOBILITY, message)
    ties, workless = ties_of(scene.position), _is_workless(scene)
    flanks = _flanks(scene, ties, workless)
    statics = _statics(scene, gears.with_flanks(scene.position, ties, flanks))
    senses = senses_of(scene, statics).signs
    found = pressed(statics, senses) if workless else held(statics, senses)
    sure = [_certain_end(scene, statics, end) for end in found.ends]
    bounds = [bound for each in sure for bound in each.bounds.values()]
    why = next((each.why for each in sure if not each.bounds), "" if bounds else PRESSED)
    return found, None if why else max(bounds), why


PRESSED = "no bound is proven of a range whose ends no motion sets"


def _certain_end(scene: Scene, statics: Statics, end: End) -> Certain:
    """The bound of an end, at which the mechanism is about to move."""
    (root,) = statics.roots
    return _certain(scene, Solved(statics, {root: end.value}, end.friction), end.senses)


def _flanks(scene: Scene, ties: Sequence[Tie], workless: bool) -> Mapping[int, float]:
    """The flanks of the teeth that carry without friction: friction seldom turns them."""
    if not gears.meshes(ties):
        return {}
    if workless:
        raise SceneError(
            Status.UNSUPPORTED,
            "the unknown load does no work, so which flanks of the teeth carry is open: put the unknown on a "
            "link that moves, or leave out the friction.",
        )
    return carrying_flanks(scene.position, ties, frictionless(scene.position, scene.balance, ties))


def _is_workless(scene: Scene) -> bool:
    """Whether the one unknown load does no work: then only friction can balance the known ones."""
    return scene.solution.verdict in ("no value", "any value")


def _statics(scene: Scene, ties: Sequence[Tie]) -> Statics:
    """Statics with the rubs of the ties.

    Raises SceneError where the joints leave a rubbing force open.
    """
    rubs = rubs_of(scene.position, ties)
    statics = equilibrium(scene.position, ties, scene.balance, rubs)
    refuse_doubt(scene.position, statics)
    try:
        forces_of(statics)
    except LookupError as error:
        tie = ties[error.args[0]]
        raise SceneError(Status.UNSUPPORTED, _shared(tie, ties)) from None
    return statics


def _shared(tie: Tie, ties: Sequence[Tie]) -> str:
    remedy = "Take out `mu` there, or make the joints fewer (a pin in a slot in place of a slide)."
    cause = "the joints are redundant and share the load by their fit"
    if any(isinstance(other.joint, Gears) and other.joint.pressure_angle is None for other in ties):
        cause, remedy = "it hangs on how hard teeth push apart", "Give the gears their `pressure angle`."
    elif any(isinstance(other.joint, Belt) for other in ties):
        cause = "it hangs on the initial tension of the belt"
        remedy = "Take out `mu` there, or in place of the belt put its two pulls on the pulleys as loads."
    return (
        f"the friction of links {tie.by} and {tie.on}{place_of(tie)} depends on a force that equilibrium "
        f"leaves open: {cause}. {remedy}"
    )


def _bodies(scene: Scene, solved: Solved, found: Slid, workless: bool) -> Bodies:
    position, statics, parameters = scene.position, solved.statics, solved.parameters
    terms = terms_of(position, statics, scene.balance, parameters)
    senses = senses_of(scene, statics)
    shown: tuple[Witness, ...] = ()
    if not workless:
        bounds = bounds_of(position, statics, scene.balance, terms)
        by_power = {q: (value, 0.0) for q, value in _by_power(scene, solved).items()}
        shown = witnesses(by_power, solved.unknowns, bounds)
        refuse_apart(shown, position.slack)
    reactions = reactions_of(position, scene.frame, statics, parameters)
    rubbing = rubbing_of(scene, solved, found, senses)
    refuse_power(rubbing)
    friction = Friction(rubbing, residual(terms), found.error, found.unique, sum(r.loss for r in rubbing))
    notes = said_of(statics, reactions, names_by_tie(position.case, statics.ties))
    return Bodies(
        reactions, shown, residual(terms), (*notes, *said_in_motion(scene, statics, found, senses)), friction
    )


def _by_power(scene: Scene, solved: Solved) -> Mapping[str, float]:
    """The unknown loads from the sums of power, the losses of friction counted."""
    return unknowns_by_power(scene.position, scene.balance, solved.statics, solved.friction)


def solved(scene: Scene, answer_with: Callable[[Mapping[str, Value]], Answer], reactions: bool) -> Answer:
    """The answer with friction; ``answer_with`` makes the rest of it from values of the unknown loads.

    Raises SceneError as `in_motion` and `at_rest` do.
    """
    if scene.position.case.motion:
        return _moving(scene, answer_with, reactions)
    found, bound, why = at_rest(scene)
    (root,) = (w.load.name for w in scene.balance.wrenches if is_unknown(w.load))
    answer = answer_with({root: Value(0.0, bound, why)})
    answers = {name: _held(scene, name, found, shown) for name, shown in answer.answers.items()}
    notes = (*answer.notes, *said_at_rest(root, found))
    friction = Friction((), 0.0, 0.0, found.how, possible=found.possible)
    bare = replace(answer, answers=answers, terms=(), advantage=None, sensitivities=Deferred(_no_slopes))
    return replace(bare, notes=notes, friction=friction)


def _moving(scene: Scene, answer_with: Callable[[Mapping[str, Value]], Answer], reactions: bool) -> Answer:
    unknowns, bodies, sure = in_motion(scene)
    values = {root: Value(value, sure.bounds.get(root), sure.why) for root, value in unknowns.items()}
    answer = replace(answer_with(values), sensitivities=Deferred(lambda: _slopes(scene, sure)))
    return bodies.added_to(answer, reactions)


def _slopes(scene: Scene, sure: Certain) -> dict[str, dict[str, float]]:
    """Slopes of every unknown load and of those like it, friction included."""
    if not sure.slopes:
        raise SceneError(Status.UNSUPPORTED, f"{NO_SLOPES}: {sure.why}.")
    return {
        w.load.name: {path: float(w.ratio) * slope for path, slope in sure.slopes[w.root].items()}
        for w in scene.balance.wrenches
        if w.root in sure.slopes
    }


NO_SLOPES = "sensitivities and tolerance bands are not worked out here"


def _no_slopes() -> dict[str, dict[str, float]]:
    said = "a range in which the mechanism holds still has none. Give its `motion`."
    raise SceneError(Status.UNSUPPORTED, f"{NO_SLOPES}: {said}")


def _held(scene: Scene, name: str, found: Held, shown: Found) -> Found:
    """The range of a load that is the unknown, or a multiple of it; ``shown`` has its bound."""
    ratio = next(float(w.ratio) for w in scene.balance.wrenches if w.load.name == name)
    ends = sorted((ratio * found.least, ratio * found.most))
    return shown._replace(
        value=math.nan, sense="", holds=(ends[0], ends[1]), self_locking=found.self_locking
    )
