"""A scene with friction: the unknown loads in the given motion, or the range in which it holds still.

What rubs, which way, and what it takes: of a scene and of its solution, in case units and in words.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, TypeVar

from icsolve.answer import AboutToMove, Answer, Deferred, Found, Later
from icsolve.answer.bodies import FrictionFound, Rubbing, Tension
from icsolve.errors import SceneError, Status
from icsolve.kinematics.speeds import Speed, fastest
from icsolve.numbers.arithmetic import FLOATS, Showing, largest_of
from icsolve.numbers.linear import General, Row
from icsolve.statics import reaction_basis
from icsolve.statics.equilibrium import Statics, equilibrium
from icsolve.statics.free_bodies import FreeBodies, Solved, carrying_flanks, frictionless, on_flanks, told
from icsolve.statics.friction.enclosure import (
    MISSED,
    TOO_CLOSE,
    UNBOUND,
    UNSURE,
    Proven,
    SceneOnBalls,
    Senses,
    enclosed,
    slopes,
)
from icsolve.statics.friction.equations import forces_of
from icsolve.statics.friction.interface import (
    AS_SHARED,
    RubbingRates,
    SharedError,
    place_of,
    rubbing_rates,
    rubs_of,
    shared,
    unknowns_by_power,
)
from icsolve.statics.friction.lifting import ROUNDED, jammed
from icsolve.statics.friction.limits import Slid, jams_at_last, slid
from icsolve.statics.friction.static_range import (
    SAME,
    End,
    StaticRange,
    end_of,
    impending,
    pressed,
    range_of,
    smooth_load,
    static_range,
    without_ends,
)
from icsolve.statics.power import Balance, Bounded, Solution, Value, is_unknown, unknown_loads
from icsolve.statics.reaction_basis import Position, Tie, ties_of
from icsolve.statics.reactions import names_by_tie, reactions_of, tensions_of
from icsolve.statics.witness import refuse_doubt, residual, terms_of
from icsolve.tuples import LateModule, NamedTuple, Protocol, replace
from icsolve.wording.sentences import listed, plural

if TYPE_CHECKING:
    from icsolve.statics.friction import held_ranges as limited
    from icsolve.statics.friction.pushing import RestingScene
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
    scene, senses = _slipping(scene, rates), rates.senses.rubs
    ties, workless = ties_of(scene.position), _is_workless(scene)
    slides: list[Slid] = []

    def solve(flanks: Mapping[int, float]) -> Solved:
        statics = _statics(scene, ties, flanks)
        slides.append(slid(statics, senses, workless, scene.alone))
        return Solved(statics, slides[-1].unknowns, slides[-1].friction)

    rough = on_flanks(_flanks(scene, ties, workless), solve)
    found = _with_bodies(scene, rough, senses, slides[-1], rates, reactions)
    if found.proven.why and any(_is_beyond(rough.statics, load) for load in rough.unknowns.values()):
        raise SceneError(Status.JAM, jams_at_last(rough.statics))
    return found


def _with_bodies(
    scene: FrictionScene,
    rough: Solved,
    senses: tuple[float, ...],
    slid: Slid,
    rates: RubbingRates,
    reactions: bool,
) -> Slipping:
    """A solution in a motion with what is proven of it and its free bodies."""
    proven = _proven(scene, rough, senses, reactions)
    solved = rough if proven.why else rough._replace(unknowns=dict(proven.values), friction=proven.friction)
    bodies = _bodies(scene, solved, slid, rates, reactions)
    if proven.reactions is not None:
        bodies = bodies._replace(reactions=proven.reactions, tensions=proven.tensions)
    return Slipping(scene, solved, senses, proven, bodies)


def _proven(scene: FrictionScene, solved: Solved, senses: Sequence[float], reactions: bool = False) -> Proven:
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
        return _proven(scene, solved, senses)
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


class EndOfRange(NamedTuple):
    """An end of a range, with what is proven of it: in the motion that is meant (``way`` is 1.0), or the
    opposite one; the scene has the pulls of its ropes as they slip."""

    way: float
    scene: FrictionScene
    statics: Statics
    end: End
    proven: Proven


class AtRest(NamedTuple):
    """Where a mechanism holds still.

    Attributes
    ----------
    range : of the one unknown load
    bound, why : of the errors of its ends [case units]; with None, why none is proven
    ends : those that are finite
    rates : how fast everything rubs in the motion that is meant
    """

    range: StaticRange
    bound: float | None
    why: str
    ends: Sequence[EndOfRange]
    rates: RubbingRates


def at_rest(scene: FrictionScene) -> AtRest:
    """The range of the one unknown load in which the mechanism holds still.

    Raises
    ------
    SceneError
        ``mobility`` above 1, where the range of one load depends on the others.
    """
    mobility, rates = scene.position.mobility, None
    if mobility - len(scene.solution.idle) == 1 or mobility == 1:
        try:
            rates = rates_of_motion(scene)
        except SceneError:  # what no load moves rubs
            if mobility == 1:
                raise
    if rates is None:
        if len(unknown_loads(scene.balance)) == 1:
            return _of_several_freedoms(scene)
        unknown = [w.root for w in unknown_loads(scene.balance)]
        message = (
            f"the loads {listed(unknown)} are unknown on {plural(mobility, 'degree')} of freedom with "
            "friction: at rest the range of each may hang on the others. Give `motion`, one for each "
            "freedom: the loads that keep it up are found. Or leave one load unknown, a force along one "
            "line: the range in which it holds is found."
        )
        raise SceneError(Status.MOBILITY, message)
    if any(rope.slips for rope in scene.position.case.ropes):
        found, ends = _range_with_ropes(scene, rates)
    else:
        ties, workless, senses = ties_of(scene.position), _is_workless(scene), rates.senses.rubs
        flanks = _flanks(scene, ties, workless)
        try:
            statics = _statics(scene, ties, flanks)
        except SharedError:  # no one motion begins: each way of sharing has its own
            return _of_several_freedoms(scene)
        driven = scene.solution.verdict == "no value"
        within = partial(limited.held, _resting(scene))
        if workless:
            found = pressed(statics, senses, driven, within)
        else:
            moving = [_on_flanks(scene, statics, flanks, [way * s for s in senses]) for way in (1.0, -1.0)]
            found = static_range(statics, senses, scene.alone, within, moving)
        ways = [1.0 if end.senses == senses else -1.0 for end in found.ends]
        of = [end.statics or statics for end in found.ends]
        ends = [
            EndOfRange(way, scene, own, end, _proven_end(scene, own, end))
            for way, own, end in zip(ways, of, found.ends, strict=True)
        ]
    return _told(found, ends, rates)


def _on_flanks(
    scene: FrictionScene, statics: Statics, flanks: Mapping[int, float], senses: Sequence[float]
) -> End:
    """The load at which it is about to move, with teeth on the flanks on which they push there; ``statics``
    has them on the given ones."""

    def end(own: Mapping[int, float]) -> End:
        on_these = statics if own == flanks else _statics(scene, ties_of(scene.position), own)
        return impending(on_these, senses)._replace(statics=on_these)

    return on_flanks(flanks, end)


def _told(found: StaticRange, ends: Sequence[EndOfRange], rates: RubbingRates) -> AtRest:
    """A range as it is told, with what is proven of its ends."""
    lost = [one for one in ends if one.proven.why and _is_beyond(one.statics, one.end.value)]
    ends = [one for one in ends if one not in lost]
    found = without_ends(found, [one.end for one in lost])
    proven = [one.proven for one in ends]
    bounds = [bound for each in proven for bound in each.bounds.values()]
    why = next((each.why for each in proven if each.why), "" if bounds else UNENDING)
    exact = {one.end.value: value for one in ends for value in one.proven.values.values()}
    least, most, *possible = (exact.get(v, v) for v in (found.least, found.most, *found.possible))
    found = found._replace(least=least, most=most, possible=(possible[0], possible[1]))
    return AtRest(found, None if why else max(bounds), why, ends, rates)


def _of_several_freedoms(scene: FrictionScene) -> AtRest:
    """The range of the one unknown load where friction holds several freedoms, or equilibrium leaves open how
    joints that rub share it: there is no one motion that would begin at its ends.

    Raises SceneError where there is none, and where the fit of joints alone presses what rubs.
    """
    from icsolve.statics.friction.standing import refuse_fit

    shared = refuse_fit(_resting(scene))
    ties = ties_of(scene.position)
    statics = equilibrium(scene.position, ties, scene.balance, rubs_of(scene.position, ties))
    within = limited.held(_resting(scene), scene.at)
    if not within.ranges:
        raise SceneError(Status.NO_VALUE, NEVER_HELD.format(statics.roots[0]))
    own, again = within.nearest(0.0)
    both = zip((own.low, own.high), own.vertices, strict=True)
    ends = [End(value, (), (), True, vertex) for value, vertex in both]
    presses = not any(row.get(statics.root(0)) for row in statics.general.left)
    found = range_of(ends)._replace(how=within.how, again=again, presses=presses, shared=shared)
    finite = (end for end in ends if math.isfinite(end.value))
    of = [EndOfRange(1.0, scene, statics, end, _proven_end(scene, statics, end)) for end in finite]
    return _told(found._replace(self_locking=found.self_locking and not presses), of, RubbingRates((), ()))


NEVER_HELD = (
    "no value of {} holds: friction within its limits is not enough, or a contact would have to pull."
)


def _is_beyond(statics: Statics, load: float) -> bool:
    """Whether the known loads are rounding beside a load [case units]: where nothing is proven of it the
    forces grow without bound, as with friction at just the angle of the load."""
    rows = (*statics.general.solved.values(), *statics.general.left)
    known = largest_of([row.get(statics.known, 0.0) for row in rows])
    return abs(load) * statics.scale * ROUNDED > known


def _slipping(scene: FrictionScene, rates: RubbingRates, direction: float = 1.0) -> FrictionScene:
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


def _range_with_ropes(scene: FrictionScene, rates: RubbingRates) -> tuple[StaticRange, list[EndOfRange]]:
    """The range where ropes slip: about to move one way and the other, with the pulls that go with each; and
    its ends.

    Where a rope would have to push before the mechanism is about to move, the range is that in which friction
    within its limits holds.
    """
    senses, within = rates.senses.rubs, limited.held(_resting(scene))
    moving: list[EndOfRange] = []
    for way in (1.0, -1.0):
        one = _slipping(scene, rates, way)
        ties = ties_of(one.position)
        statics = _statics(one, ties, _flanks(one, ties, False))
        end = end_of(statics, [way * sense for sense in senses])
        if end is not None and math.isfinite(end.value) and _pulls(statics, end):
            moving.append(EndOfRange(way, one, statics, end, _proven_end(one, statics, end)))
    still = _slipping(scene, rates, 0.0)
    bare = _statics(still, ties := ties_of(still.position), _flanks(still, ties, False))
    smooth = smooth_load(bare)
    if not within.ranges:
        parameters = bare.parameters({bare.roots[0]: smooth or 0.0}, (0.0,) * len(senses))
        tensions_of(bare, parameters, FLOATS, scene.position.case.units.force)
        raise SceneError(Status.NO_VALUE, NEVER_TAUT.format(bare.roots[0]))
    own, _ = within.nearest(smooth or 0.0)
    both = zip((own.low, own.high), own.vertices, strict=True)
    ends = [_same(value, moving) or End(value, senses, vertex=vertex) for value, vertex in both]
    possible = (ends[0].value, ends[1].value)
    if len(moving) == 2:
        ends = [one.end for one in moving]
    found = range_of(ends)._replace(possible=possible, how=within.how)
    if smooth is None:
        found = found._replace(presses=True, self_locking=False)
    known = [one.end for one in moving]
    moving += [
        EndOfRange(1.0, still, bare, end, _proven_end(still, bare, end)) for end in ends if end not in known
    ]
    return found, moving


def _same(value: float, moving: Sequence[EndOfRange]) -> End | None:
    """The end at which it is about to move that this value is, but for rounding."""
    room = SAME * abs(value) if math.isfinite(value) else -1.0
    return next((one.end for one in moving if abs(one.end.value - value) <= room), None)


def _resting(scene: FrictionScene) -> RestingScene:
    """The scene as what friction within its limits can do is asked of."""
    from icsolve.statics.friction.pushing import RestingScene

    def ask(question: Callable[[Position, Balance, Showing], T]) -> T:
        if scene.enclose is None:
            raise SceneError(Status.UNSUPPORTED, UNBOUND)
        return scene.enclose(lambda placed: question(placed.position, placed.balance, placed.arithmetic))

    return RestingScene(scene.position, scene.balance, ask)


NEVER_TAUT = "no value of {} holds: a rope would have to push, or a contact to pull."


def _pulls(statics: Statics, end: End) -> bool:
    """Whether every rope pulls at an end."""
    (root,) = statics.roots
    parameters = statics.parameters({root: end.value}, end.friction or (0.0,) * len(statics.rubs))
    return all(statics.value(statics.tension(n), parameters) >= 0.0 for n in range(len(statics.ropes)))


UNENDING = "the range has no ends"


def _proven_end(scene: FrictionScene, own: Statics, end: End) -> Proven:
    """What is proven of an end: at which the mechanism is about to move, or that inequalities set."""
    (root,), vertex = own.roots, end.vertex
    if vertex is None:
        return _proven(scene, Solved(own, {root: end.value}, end.friction), end.senses)
    with suppress(SceneError):
        value = limited.exactly(_resting(scene), vertex)
        if value is None:
            return Proven(TURNED)
        return Proven("", {root: value.error or 0.0}, {root: value.value})
    return Proven(TOO_CLOSE if scene.enclose else UNBOUND)


TURNED = f"{UNSURE} where a contact parts and pins rub"


def _flanks(scene: FrictionScene, ties: Sequence[Tie], workless: bool) -> Mapping[int, float]:
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


def _is_workless(scene: FrictionScene) -> bool:
    """Whether the one unknown load does no work: then only friction can balance the known ones.

    What draws a rope that slips is as good as one that works.
    """
    slips = any(rope.slips for rope in scene.position.case.ropes)
    return scene.solution.verdict in ("no value", "any value") and not slips


def _statics(scene: FrictionScene, ties: Sequence[Tie], flanks: Mapping[int, float]) -> Statics:
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
    if scene.solution.verdict not in ("no value", "any value"):
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


def solved(
    scene: FrictionScene, answer_with: Callable[[Mapping[str, Value]], Answer], reactions: bool
) -> Answer:
    """The answer with friction; ``answer_with`` makes the rest of it from values of the unknown loads.

    Raises SceneError as `in_motion` and `at_rest` do.
    """
    if scene.position.case.motion:
        return _moving(scene, answer_with, reactions)
    rest = at_rest(scene)
    found, (root,) = rest.range, (w.load.name for w in scene.balance.wrenches if is_unknown(w.load))
    answer = answer_with({root: Value(0.0, rest.bound, rest.why)})
    answers = {name: _held(scene, name, found, shown) for name, shown in answer.answers.items()}
    jams = jammed(scene.position, scene.balance, root, (found.least, found.most))
    notes = (*answer.notes, *notes_at_rest(root, found), *([jams] if jams else ()))
    friction = FrictionFound(
        (), 0.0, 0.0, found.how, possible=found.possible, again=found.again, shared=found.shared
    )
    bare = replace(answer, answers=answers, terms=(), advantage=None, sensitivities=Deferred(_no_slopes))
    ends = Later(lambda: list(_about_to_move(rest, answer_with)))
    return replace(bare, notes=notes, friction=friction, about_to_move=ends)


def _about_to_move(
    rest: AtRest, answer_with: Callable[[Mapping[str, Value]], Answer]
) -> Iterator[AboutToMove]:
    """The finite ends at which everything rubs that can, as answers of that motion; none where a contact
    parts before."""
    for way, scene, statics, end, _ in sorted(rest.ends, key=lambda one: one.end.value):
        if len(end.friction) == len(statics.rubs):
            rough = Solved(statics, dict.fromkeys(statics.roots, end.value), end.friction)
            slid = Slid(rough.unknowns, end.friction, 0.0, rest.range.how, ())
            found = _with_bodies(scene, rough, end.senses, slid, rest.rates.times(way), True)
            yield AboutToMove(way, _answer_of(found, answer_with, True))


def _moving(
    scene: FrictionScene, answer_with: Callable[[Mapping[str, Value]], Answer], reactions: bool
) -> Answer:
    return _answer_of(in_motion(scene, reactions), answer_with, reactions)


def _answer_of(
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
    return {
        w.load.name: {path: float(w.ratio) * slope for path, slope in by_root[w.root].items()}
        for w in scene.balance.wrenches
        if w.root in by_root
    }


NO_SLOPES = "sensitivities and tolerance bands are not worked out here"


def _no_slopes() -> dict[str, dict[str, float]]:
    said = "a range in which the mechanism holds still has none. Give its `motion`."
    raise SceneError(Status.UNSUPPORTED, f"{NO_SLOPES}: {said}")


def _held(scene: FrictionScene, name: str, found: StaticRange, shown: Found) -> Found:
    """The range of a load that is the unknown, or a multiple of it; ``shown`` has its bound."""
    ratio = next(float(w.ratio) for w in scene.balance.wrenches if w.load.name == name)
    ends = sorted((ratio * found.least, ratio * found.most))
    return shown._replace(value=math.nan, sense="", holds=(ends[0], ends[1]), self_locking=found.self_locking)


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


def notes_at_rest(root: str, found: StaticRange) -> Sequence[str]:
    """Sentences about the range."""
    notes = [
        "without `motion` the friction at the joints, and with it their reactions, is open within its limits."
    ]
    if found.shared:
        notes.append(f"it holds so {AS_SHARED}")
    if found.self_locking and found.least <= 0.0 <= found.most:
        notes.append(f"self-locking: it holds still with {root} = 0.")
    if found.parts:
        finite = (end + 0.0 for end in found.parts if math.isfinite(end))  # no -0
        ends = listed(f"{end:.6g}" for end in dict.fromkeys(finite))
        where = f"by {root} = {ends}" if ends else "from some value on"
        notes.append(
            f"{where} a contact would have to pull: it parts there, and the links tip or lift off before "
            "they slide."
        )
    elif math.isinf(found.least) and math.isinf(found.most):
        notes.append(f"no value of {root}, however large, moves it either way.")
    elif math.isinf(found.most) or math.isinf(found.least):
        side = "above" if math.isinf(found.most) else "below"
        why = "the harder it presses, the more it holds" if found.presses else "it locks that way"
        notes.append(f"no value of {root} {side} the range moves it, however large: {why}.")
    for low, high in found.again:
        where = f"from {root} = {low:.6g} to {high:.6g}"
        if math.isinf(high - low):
            end = low if math.isinf(high) else high
            where = f"beyond {root} = {end:.6g}, where it is about to move too,"
        notes.append(f"{where} it may hold again.")
    for end, more in zip((found.least, found.most), found.possible, strict=True):
        if end != more and abs(end - more) > SAME * abs(end):
            far = f"to {more:.6g}" if math.isfinite(more) else "up" if more > 0.0 else "down"
            notes.append(
                f"from {end:.6g} {far} it may still hold, if friction was left the other way round "
                "at some joint (the end is that of impending motion)."
            )
    return notes
