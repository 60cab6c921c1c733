"""A scene with friction: the unknown loads in the given motion, or the range in which it holds still."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from icsolve.answer import Answer, Found
from icsolve.bodies import gears
from icsolve.bodies.agreement import bounds_of, refuse_apart, witnesses
from icsolve.bodies.equilibrium import Statics, equilibrium, residual, terms_of
from icsolve.bodies.holding import Held, held
from icsolve.bodies.losses import unknowns_by_power
from icsolve.bodies.pressing import pressed
from icsolve.bodies.reactions import names_by_tie, reactions_of
from icsolve.bodies.reduction import forces_of
from icsolve.bodies.rubs import kind_of_rub, rates_of, rubs_of
from icsolve.bodies.said import said_of
from icsolve.bodies.sliding import Slid, slid
from icsolve.bodies.statics import Bodies, Solved, carrying_flanks, frictionless, on_flanks, refuse_doubt
from icsolve.bodies.ties import Position, Tie, ties_of
from icsolve.bodies.values import Friction, Rubbing, Witness
from icsolve.case import Gears
from icsolve.errors import SceneError, Status
from icsolve.figure import Frame
from icsolve.power import Balance, Solution, is_unknown
from icsolve.sentences import listed, plural
from icsolve.speeds import STILL, Speed


class Scene(NamedTuple):
    """What is known of a scene before its friction: position, sum of power, and the motion that is meant."""

    position: Position
    frame: Frame
    balance: Balance
    solution: Solution
    speed: Speed


class Sense(NamedTuple):
    """Of each rub the rate in the motion that is meant, 0.0 where it is at rest."""

    rates: tuple[float, ...]

    @property
    def signs(self) -> tuple[float, ...]:
        """1, -1, or 0."""
        return tuple(math.copysign(1.0, rate) if rate else 0.0 for rate in self.rates)


def in_motion(scene: Scene) -> tuple[dict[str, float], Bodies]:
    """The unknown loads (case units) that keep up the given motion, and the free bodies.

    Raises SceneError where no value does, where several do without one to prefer, and where the sense
    of a rub is open.
    """
    ties, workless = _ties(scene), _is_workless(scene)
    slides: list[Slid] = []

    def solve(flanked: Sequence[Tie]) -> Solved:
        statics = _statics(scene, flanked)
        slides.append(slid(statics, _senses(scene, statics).signs, workless))
        return Solved(statics, slides[-1].unknowns, slides[-1].friction)

    solved = on_flanks(scene.position, ties, _flanks(scene, ties, workless), solve)
    return solved.unknowns, _bodies(scene, solved, slides[-1], workless)


def at_rest(scene: Scene) -> Held:
    """The range of the one unknown load in which the mechanism holds still.

    Raises SceneError at a mobility above 1, where the range of one load depends on the others.
    """
    if scene.position.mobility - len(scene.solution.idle) != 1:
        message = (
            f"friction at {plural(scene.position.mobility, 'degree')} of freedom needs `motion`, one for "
            "each: without it each unknown load has a range that depends on the others."
        )
        raise SceneError(Status.MOBILITY, message)
    ties, workless = _ties(scene), _is_workless(scene)
    flanks = _flanks(scene, ties, workless)
    statics = _statics(scene, gears.with_flanks(scene.position, ties, flanks))
    senses = _senses(scene, statics).signs
    return pressed(statics, senses) if workless else held(statics, senses)


def _ties(scene: Scene) -> tuple[Tie, ...]:
    ties = ties_of(scene.position)
    gears.refuse_misfit(scene.position.case, ties, scene.position.points, scene.position.scale)
    return ties


def _flanks(scene: Scene, ties: Sequence[Tie], workless: bool) -> Mapping[int, float]:
    """The flanks of the teeth that carry without friction: friction seldom turns them."""
    if not gears.meshes(ties):
        return {}
    if workless:
        raise SceneError(
            Status.UNSUPPORTED,
            "the unknown load does no work, so which flanks of the teeth carry is open: put the unknown on a "
            "link that "
            "moves, or leave out the friction.",
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
    return (
        f"the friction of links {tie.by} and {tie.on}{_place(tie)} depends on a force that equilibrium "
        f"leaves open: {cause}. {remedy}"
    )


def _place(tie: Tie) -> str:
    return f" at {tie.where}" if tie.where else ""


def _senses(scene: Scene, statics: Statics) -> Sense:
    """Rates of all rubs in the motion that is meant.

    Raises SceneError where a freedom that no motion fixes moves one.
    """
    motions = range(scene.position.mobility)
    by_motion = [rates_of(scene.position, statics.ties, statics.rubs, m) for m in motions]
    fastest = max((abs(x) for ts in scene.position.twists.values() for t in ts for x in t), default=0.0)
    found = []
    for k, rub in enumerate(statics.rubs):
        rate = scene.speed.of([row[k] for row in by_motion], fastest)
        if rate is None:
            raise SceneError(Status.MOBILITY, _open(statics.ties[rub.tie]))
        found.append(rate if abs(rate * scene.speed.divisor) > STILL * fastest else 0.0)
    return Sense(tuple(found))


def _open(tie: Tie) -> str:
    return (
        f"the sense of the friction of links {tie.by} and {tie.on}{_place(tie)} is open: a freedom that no "
        "given motion fixes moves them. Give its `motion` too, or weld what does not turn."
    )


def _bodies(scene: Scene, solved: Solved, found: Slid, workless: bool) -> Bodies:
    position, statics, parameters = scene.position, solved.statics, solved.parameters
    terms = terms_of(position, statics, scene.balance, parameters)
    senses = _senses(scene, statics)
    shown: tuple[Witness, ...] = ()
    if not workless:
        bounds = bounds_of(position, statics, scene.balance, terms)
        by_power = {q: (value, 0.0) for q, value in _by_power(scene, solved).items()}
        shown = witnesses(by_power, solved.unknowns, bounds)
        refuse_apart(shown, position.slack)
    reactions = reactions_of(position, scene.frame, statics, parameters)
    rubbing = _rubbing(scene, solved, found, senses)
    _refuse_power(rubbing)
    friction = Friction(rubbing, residual(terms), found.error, found.unique, sum(r.loss for r in rubbing))
    notes = said_of(statics, reactions, names_by_tie(position.case, statics.ties))
    return Bodies(
        reactions, shown, residual(terms), (*notes, *_said(scene, statics, found, senses)), friction
    )


def _by_power(scene: Scene, solved: Solved) -> Mapping[str, float]:
    """The unknown loads from the sums of power, the losses of friction counted."""
    return unknowns_by_power(scene.position, scene.balance, solved.statics, solved.friction)


def _rubbing(scene: Scene, solved: Solved, found: Slid, senses: Sense) -> tuple[Rubbing, ...]:
    statics, case = solved.statics, scene.position.case
    names = names_by_tie(case, statics.ties)
    rows = []
    for k, rub in enumerate(statics.rubs):
        tie, kind = statics.ties[rub.tie], kind_of_rub(statics.ties[rub.tie])
        turns = kind == "pin"
        per_unit = statics.scale * (scene.frame.scale / case.units.torque_per_force_length if turns else 1.0)
        rate = senses.rates[k] / (1.0 if turns else scene.frame.scale)
        loss = 0.0 - solved.friction[k] / statics.scale * (senses.rates[k] / scene.frame.scale)
        value, limit = solved.friction[k] / per_unit + 0.0, found.limits[k] / per_unit
        radius = rub.limit / scene.frame.scale if turns else None
        rows.append(Rubbing(names[rub.tie], tie.where, kind, value, limit, rate, loss, radius))
    return tuple(rows)


def _refuse_power(rubbing: Sequence[Rubbing]) -> None:
    """Friction that gave power would be a fault: it opposes the rates, or is none."""
    for rub in rubbing:
        if rub.loss < 0.0:
            raise AssertionError(f"friction at {rub.joint} gives power")


def _said(scene: Scene, statics: Statics, found: Slid, senses: Sense) -> Sequence[str]:
    notes = []
    still = [statics.ties[rub.tie] for rub, rate in zip(statics.rubs, senses.rates, strict=True) if not rate]
    if still:
        places = listed(dict.fromkeys(f"{tie.by}-{tie.on}{_place(tie)}" for tie in still))
        notes.append(f"{places} does not rub in this motion: its friction has no sense and is left out.")
    if found.others:
        values = listed(f"{value:.6g}" for value in found.others)
        notes.append(
            f"with this friction the motion is in equilibrium at other values of {statics.roots[0]} too: "
            f"{values}."
        )
    if not found.unique:
        notes.append("there are too many rubbing joints to count all solutions: there may be others.")
    return notes


WHY = "with friction no bound of the rounding error is proven"


def solved(scene: Scene, answer_with: Callable[[Mapping[str, float]], Answer], reactions: bool) -> Answer:
    """The answer with friction; ``answer_with`` makes the rest of it from values of the unknown loads.

    Raises SceneError as `in_motion` and `at_rest` do.
    """
    if scene.position.case.motion:
        unknowns, bodies = in_motion(scene)
        return bodies.added_to(answer_with(unknowns), reactions)
    found = at_rest(scene)
    (root,) = (w.load.name for w in scene.balance.wrenches if is_unknown(w.load))
    answer = answer_with({root: 0.0})
    answers = {name: _held(scene, name, found, shown) for name, shown in answer.answers.items()}
    notes = (*answer.notes, *_said_at_rest(root, found))
    friction = Friction((), 0.0, 0.0, found.how, possible=found.possible)
    return replace(answer, answers=answers, terms=(), advantage=None, notes=notes, friction=friction)


def _held(scene: Scene, name: str, found: Held, shown: Found) -> Found:
    """The range of a load that is the unknown, or a multiple of it."""
    ratio = next(float(w.ratio) for w in scene.balance.wrenches if w.load.name == name)
    ends = sorted((ratio * found.least, ratio * found.most))
    return shown._replace(
        value=math.nan,
        sense="",
        error=None,
        why=WHY,
        holds=(ends[0], ends[1]),
        self_locking=found.self_locking,
    )


def _said_at_rest(root: str, found: Held) -> Sequence[str]:
    """Sentences about the range."""
    notes = [
        "without `motion` the friction at the joints, and with it their reactions, is open within its limits."
    ]
    if found.self_locking and found.least <= 0.0 <= found.most:
        notes.append(f"self-locking: it holds still with {root} = 0.")
    for end, way in ((found.least, "small"), (found.most, "large")):
        if math.isinf(end):
            notes.append(f"no value of {root}, however {way}, moves it that way.")
    for end, more in zip((found.least, found.most), found.possible, strict=True):
        if end != more and abs(end - more) > 1e-9 * max(abs(end), abs(more)):
            notes.append(
                f"from {end:.6g} to {more:.6g} it may still hold, if friction was left the other way round "
                "at some joint (the end is that of impending motion)."
            )
    return notes
