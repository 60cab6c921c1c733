"""Friction in the given motion: the unknown loads that keep it up.

What rubs, which way, and what it takes: of a scene and of its solution, in case units and in words.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING

from icsolve.answer import Answer, Deferred
from icsolve.answer.bodies import FrictionFound, Rubbing, Tension
from icsolve.errors import SceneError, Status
from icsolve.kinematics.speeds import Speed, fastest
from icsolve.numbers import FLOATS, largest_of
from icsolve.numbers.linear import General, Row
from icsolve.statics import reaction_basis
from icsolve.statics.equilibrium import Statics, equilibrium
from icsolve.statics.free_bodies import FreeBodies, Solved, carrying_flanks, frictionless, on_flanks, told
from icsolve.statics.friction import (
    RubbingRates,
    place_of,
    rubbing_rates,
    rubs_of,
    shared,
    unknowns_by_power,
)
from icsolve.statics.friction.enclosure import (
    MISSED,
    TOO_CLOSE,
    UNBOUND,
    Proven,
    SceneOnBalls,
    Senses,
    enclosed,
    slopes,
)
from icsolve.statics.friction.equations import forces_of
from icsolve.statics.friction.limits import ROUNDED, Slid, jams_at_last, slid
from icsolve.statics.power import Balance, Bounded, Solution, Value
from icsolve.statics.reaction_basis import Position, Tie, ties_of
from icsolve.statics.reactions import names_by_tie, reactions_of, tensions_of
from icsolve.statics.witness import refuse_doubt, residual, terms_of
from icsolve.tuples import LateModule, NamedTuple, Protocol, TypeVar, replace
from icsolve.wording import listed

if TYPE_CHECKING:
    from icsolve.statics.friction import held_ranges as limited
else:  # where a contact parts, or rubs do not tell how they act on each other
    limited = LateModule("icsolve.statics.friction.held_ranges")


class Slipping(NamedTuple):
    """A scene in the motion that is given: what its ropes and rubs do in it.

    Attributes
    ----------
    scene : with the pulls of its ropes as they slip
    solved, senses : loads and frictions, each rounded once where that is proven; senses of the rubs
    proven : of them
    bodies : what the free bodies say
    """

    scene: FrictionScene
    solved: Solved
    senses: tuple[float, ...]
    proven: Proven
    bodies: FreeBodies


def in_motion(scene: FrictionScene, reactions: bool = False) -> Slipping:
    """The unknown loads that keep up the given motion, the free bodies, and bounds; of reactions if asked.

    Raises
    ------
    SceneError
        Where no value does, where several do without one to prefer, and where the sense of a rub is open.
    """
    rates = rates_of_motion(scene)
    scene, senses = as_ropes_slip(scene, rates), rates.senses.rubs
    ties, workless = ties_of(scene.position), is_workless(scene)
    slides: list[Slid] = []

    def solve(flanks: Mapping[int, float]) -> Solved:
        statics = statics_of(scene, ties, flanks)
        slides.append(slid(statics, senses, workless, scene.alone))
        return Solved(statics, slides[-1].unknowns, slides[-1].friction)

    rough = on_flanks(flanks_of(scene, ties, workless), solve)
    found = with_bodies(scene, rough, senses, slides[-1], rates, reactions)
    if found.proven.why and any(is_beyond(rough.statics, load) for load in rough.unknowns.values()):
        raise SceneError(Status.JAM, jams_at_last(rough.statics))
    return found


def with_bodies(
    scene: FrictionScene,
    rough: Solved,
    senses: tuple[float, ...],
    slid: Slid,
    rates: RubbingRates,
    reactions: bool,
) -> Slipping:
    """A solution in a motion with what is proven of it and its free bodies."""
    proven = proven_of(scene, rough, senses, reactions)
    solved = rough if proven.why else rough._replace(unknowns=dict(proven.values), friction=proven.friction)
    bodies = _bodies(scene, solved, slid, rates, reactions)
    if proven.reactions is not None:
        bodies = bodies._replace(reactions=proven.reactions, tensions=proven.tensions)
    return Slipping(scene, solved, senses, proven, bodies)


def proven_of(
    scene: FrictionScene, solved: Solved, senses: Sequence[float], reactions: bool = False
) -> Proven:
    """The loads and frictions of a solution (with its reactions, where these are asked for and can be), each
    rounded once, or why nothing is proven of them."""
    if scene.enclose is None:
        return Proven(UNBOUND)
    if scene.position.slack:
        return Proven(MISSED)
    if len(solved.friction) != len(solved.statics.rubs):
        return Proven(TOO_CLOSE)
    try:
        found = scene.enclose(lambda placed: _rounded(placed, solved, senses, reactions))
    except SceneError:  # no digits show that the solution stands alone
        found = None
    if found is None and reactions:
        return proven_of(scene, solved, senses)
    return found or Proven(TOO_CLOSE)


def _rounded(placed: SceneOnBalls, solved: Solved, senses: Sequence[float], reactions: bool) -> Proven | None:
    found, a = enclosed(placed, solved, senses), placed.arithmetic
    if found is None:
        return None
    both = {root: a.rounded(x) for root, x in found.unknowns.items()}
    values, bounds = ({root: two[n] for root, two in both.items()} for n in (0, 1))
    proven = Proven("", bounds, values, tuple(map(float, found.friction)))
    if not reactions:
        return proven
    statics, parameters, unit = found.statics, found.parameters, placed.position.case.units.force
    return proven._replace(
        reactions=reactions_of(placed.position, statics, parameters, a),
        tensions=tensions_of(statics, parameters, a, unit),
    )


def is_beyond(statics: Statics, load: float) -> bool:
    """Whether the known loads are rounding beside a load [case units]: where nothing is proven of it the
    forces grow without bound, as with friction at just the angle of the load."""
    rows = (*statics.general.solved.values(), *statics.general.left)
    known = largest_of([row.get(statics.known, 0.0) for row in rows])
    return abs(load) * statics.scale * ROUNDED > known


def as_ropes_slip(scene: FrictionScene, rates: RubbingRates, direction: float = 1.0) -> FrictionScene:
    """The scene with the pulls of its ropes as they slip in the motion that is meant, or in its opposite."""
    senses = (tuple([direction * sense for sense in row]) for row in rates.senses.ropes)
    return scene._replace(position=reaction_basis.slipping(scene.position, senses))


def rates_of_motion(scene: FrictionScene) -> RubbingRates:
    """How fast everything rubs in the motion that is meant, zero only where it does not.

    Raises SceneError where a freedom that no motion fixes moves it.
    """
    speed = scene.speed()
    found = rubbing_rates(scene.position, speed)
    size = fastest(scene.position.twists) * max(map(abs, speed.particular))
    if any(abs(rate * speed.divisor) <= SLOW * size for rate in found.every) and scene.enclose:
        with suppress(SceneError):  # where balls leave it open, rounding alone would say more
            found = scene.enclose(lambda placed: rubbing_rates(placed.position, placed.speed()).in_floats)
    return found


SLOW = 1e-7


"""Rates below this fraction of the fastest are looked at on balls."""


def flanks_of(scene: FrictionScene, ties: Sequence[Tie], workless: bool) -> Mapping[int, float]:
    """The flanks of the teeth that carry without friction: friction seldom turns them."""
    if not reaction_basis.meshes(ties):
        return {}
    if workless:
        raise SceneError(
            Status.UNSUPPORTED,
            "the unknown load does no work, so which flanks of the teeth carry is open: put the unknown on a "
            "link that moves, or leave out the friction.",
        )
    return carrying_flanks(scene.position, ties, frictionless(scene.position, scene.balance, ties))


def is_workless(scene: FrictionScene) -> bool:
    """Whether the one unknown load does no work: then only friction can balance the known ones.

    What draws a rope that slips is as good as one that works.
    """
    slips = any(rope.slips for rope in scene.position.case.ropes)
    return scene.solution.is_workless and not slips


def statics_of(scene: FrictionScene, ties: Sequence[Tie], flanks: Mapping[int, float]) -> Statics:
    """Statics with the rubs of the ties; its numbers those of balls, rounded, where bounds are asked for.

    Raises SceneError where the joints leave a rubbing force open.
    """
    ties = reaction_basis.with_flanks(scene.position, ties, flanks)
    general, asks = None, None
    if scene.enclose is not None:
        asks = partial(_asked, scene.enclose, flanks, [tie.senses for tie in scene.position.ropes])
        with suppress(SceneError):  # what no digits decide is left to rounding
            solved, free, left, pivots = asks(lambda exact: exact.general)
            rows = {c: _floats(row) for c, row in solved.items()}
            general = General(rows, free, tuple(map(_floats, left)), pivots=tuple(map(float, pivots)))
    statics = equilibrium(scene.position, ties, scene.balance, rubs_of(scene.position, ties), general)
    statics = statics._replace(asks=asks)
    refuse_doubt(len(statics.general.left), scene.position.mobility)
    try:
        forces_of(statics)
    except LookupError as error:
        tie = ties[error.args[0]]
        raise shared(tie, ties) from None
    return statics


def _asked(
    enclose: Enclose, flanks: Mapping[int, float], senses: Senses, question: Callable[[Statics], T]
) -> T:
    """The answer to a question of the statics on balls."""
    return enclose(lambda placed: question(placed.statics(flanks, senses)))


def _floats(row: Row) -> Row:
    return {c: float(a) for c, a in row.items()}


def _bodies(
    scene: FrictionScene, solved: Solved, found: Slid, rates: RubbingRates, reactions: bool
) -> FreeBodies:
    """What the free bodies say, and what rubs."""
    statics, by_power = solved.statics, None
    if not scene.solution.is_workless:
        by_power = {q: (value, 0.0) for q, value in _by_power(scene, solved).items()}
    bodies = told(scene.position, scene.balance, solved, by_power, FLOATS, reactions)
    of_ropes = _ropes_rubbing(scene, statics, bodies.tensions, rates)
    rubbing = (*rubbing_of(scene, solved, rates.rubs), *of_ropes)
    refuse_power(rubbing)
    error, losses = found.error if math.isfinite(found.error) else None, sum(r.loss for r in rubbing)
    left = residual(terms_of(statics, solved.parameters))
    friction = FrictionFound(rubbing, left, error, found.unique, losses)
    notes = (*bodies.notes, *notes_in_motion(statics, found, rates.rubs))
    return bodies._replace(notes=notes, friction=friction)


def _ropes_rubbing(
    scene: FrictionScene, statics: Statics, pulls: Sequence[Tension], found: RubbingRates
) -> Iterator[Rubbing]:
    """Where ropes slip: the difference of the two pulls, and the power that it takes."""
    for tie, rates, pull in zip(statics.ropes, found.ropes, pulls, strict=True):
        for k, rate in enumerate(rates, start=1):
            if tie.rope.mu[k] is None or not pull.parts:
                continue
            speed = rate / scene.position.scale
            apart = abs(pull.parts[k] - pull.parts[k - 1])
            value = -math.copysign(apart, rate) if rate else 0.0
            loss = apart * abs(speed)
            yield Rubbing(pull.name, tie.rope.points[k], "rope", value, apart, speed, loss)


def _by_power(scene: FrictionScene, solved: Solved) -> Mapping[str, float]:
    """The unknown loads from the sums of power, the losses of friction counted."""
    statics, parameters = solved.statics, solved.parameters
    columns = [statics.tension(n) for n in range(len(statics.ropes))]
    pulls = [statics.value(column, parameters) / statics.scale for column in columns]
    return unknowns_by_power(scene.position, scene.balance, statics, solved.friction, pulls)


def moving(
    scene: FrictionScene, answer_with: Callable[[Mapping[str, Value]], Answer], reactions: bool
) -> Answer:
    """The answer in the given motion; ``answer_with`` makes the rest of it from values of the unknown loads.

    Raises SceneError as `in_motion` does.
    """
    return answer_of(in_motion(scene, reactions), answer_with, reactions)


def answer_of(
    found: Slipping, answer_with: Callable[[Mapping[str, Value]], Answer], reactions: bool
) -> Answer:
    bounds, why = found.proven.bounds, found.proven.why
    values = {root: Value(x, bounds.get(root), why) for root, x in found.solved.unknowns.items()}
    answer = replace(answer_with(values), sensitivities=Deferred(lambda: _slopes(found)))
    return found.bodies.added_to(answer, reactions)


def _slopes(found: Slipping) -> dict[str, dict[str, float]]:
    """Slopes of every unknown load and of those like it, friction included."""
    scene, why = found.scene, found.proven.why
    try:
        traced = None if why else scene.trace()
        by_root = {} if traced is None else slopes(scene.position, found.solved, found.senses, traced)
    except LookupError as error:
        why = error.args[0]
    if why:
        raise SceneError(Status.UNSUPPORTED, f"{NO_SLOPES}: {why}.")
    if traced is None:
        return {}
    by_load = {}
    for w in traced.outcome.balance.wrenches:
        if w.root in by_root:
            times, value, own = (
                traced.tape.back(w.ratio).by_path,
                found.solved.unknowns[w.root],
                by_root[w.root],
            )
            by_load[w.load.name] = {  # how many times it is as large is a number too
                path: float(w.ratio) * own.get(path, 0.0) + value * times.get(path, 0.0)
                for path in {**own, **times}
            }
    return by_load


NO_SLOPES = "sensitivities and tolerance bands are not worked out here"


T = TypeVar("T")


class Enclose(Protocol):
    """Asks a question of the scene on balls."""

    def __call__(self, question: Callable[[SceneOnBalls], T]) -> T:
        """The answer by the fewest digits that settle it; SceneError where none do."""


class FrictionScene(NamedTuple):
    """What is known of a scene before its friction: position, sum of power, and the motion that is meant."""

    position: Position
    balance: Balance
    solution: Solution
    speed: Callable[[], Speed]
    trace: Callable[[], Bounded | None]
    """the same on a tape"""
    enclose: Enclose | None
    """the same on balls, of as many digits as that takes, where bounds are asked for"""
    alone: bool
    """whether what is said of other solutions is left out"""
    at: float | None
    """of several freedoms the load of which alone it is asked whether friction holds it"""
    presses: bool = False
    """whether the unknown load works by the last digits alone of numbers that a program rounded"""


def rubbing_of(scene: FrictionScene, solved: Solved, rates: Sequence[float]) -> tuple[Rubbing, ...]:
    """Friction, its limit, rate and loss at every rub, case units."""
    statics, case, size = solved.statics, scene.position.case, scene.position.scale
    names = names_by_tie(case, statics.ties)
    rows = []
    for k, rub in enumerate(statics.rubs):
        tie, kind = statics.ties[rub.tie], statics.ties[rub.tie].kind
        turns = kind == "pin"
        per_unit = statics.scale * (
            scene.position.scale / case.units.torque_per_force_length if turns else 1.0
        )
        rate = rates[k] / (1.0 if turns else scene.position.scale)
        loss = 0.0 - solved.friction[k] / statics.scale * (rates[k] / scene.position.scale)
        value = solved.friction[k] / per_unit + 0.0
        radius = rub.limit / size if turns else None
        rows.append(Rubbing(names[rub.tie], tie.where, kind, value, abs(value), rate, loss, radius))
    return tuple(rows)


def refuse_power(rubbing: Sequence[Rubbing]) -> None:
    """Friction that gave power would be a fault: it opposes the rates, or is none."""
    for rub in rubbing:
        if rub.loss < 0.0:
            raise AssertionError(f"friction at {rub.joint} gives power")


def notes_in_motion(statics: Statics, found: Slid, rates: Sequence[float]) -> Sequence[str]:
    """Sentences about what does not rub, and about other solutions."""
    notes = []
    still = [statics.ties[rub.tie] for rub, rate in zip(statics.rubs, rates, strict=True) if not rate]
    if still:
        places = listed(dict.fromkeys(f"{tie.by}-{tie.on}{place_of(tie)}" for tie in still))
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
