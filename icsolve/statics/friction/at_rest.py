"""Friction at rest: the range of the one unknown load in which the mechanism holds still.

Its ends, where it is about to move one way or the other, or where a contact parts; what holds it farther out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial
from itertools import cycle, pairwise
from typing import TYPE_CHECKING

from icsolve.answer import AboutToMove, Answer, Deferred, Found, Later
from icsolve.answer.bodies import FrictionFound
from icsolve.errors import SceneError, Status
from icsolve.numbers import FLOATS, Showing
from icsolve.statics.equilibrium import Statics, equilibrium
from icsolve.statics.free_bodies import Solved, on_flanks
from icsolve.statics.friction import AS_SHARED, RubbingRates, SharedError, rubs_of
from icsolve.statics.friction.enclosure import TOO_CLOSE, UNBOUND, UNSURE, Proven
from icsolve.statics.friction.in_motion import (
    NO_SLOPES,
    FrictionScene,
    answer_of,
    as_ropes_slip,
    flanks_of,
    is_beyond,
    is_workless,
    proven_of,
    rates_of_motion,
    statics_of,
    with_bodies,
)
from icsolve.statics.friction.lifting import jammed
from icsolve.statics.friction.limits import Slid
from icsolve.statics.friction.static_range import (
    SAME,
    End,
    StaticRange,
    at_vertex,
    end_of,
    impending,
    pressed,
    range_of,
    smooth_load,
    static_range,
    without_ends,
)
from icsolve.statics.power import Balance, Value, is_unknown, unknown_loads
from icsolve.statics.reaction_basis import Position, ties_of
from icsolve.statics.reactions import tensions_of
from icsolve.tuples import LateModule, NamedTuple, TypeVar, replace
from icsolve.wording import less_than_none, listed, plural

if TYPE_CHECKING:
    from icsolve.statics.friction import held_ranges as limited
    from icsolve.statics.friction.pushing import RestingScene
    from icsolve.wording import sentences
else:  # where a contact parts, or rubs do not tell how they act on each other; where an answer is remarkable
    limited = LateModule("icsolve.statics.friction.held_ranges")
    sentences = LateModule("icsolve.wording.sentences")

T = TypeVar("T")


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
        ties, workless, senses = ties_of(scene.position), is_workless(scene), rates.senses.rubs
        flanks = flanks_of(scene, ties, workless)
        try:
            statics = statics_of(scene, ties, flanks)
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
    return _told(found._replace(presses=found.presses or scene.presses), ends, rates)


def _on_flanks(
    scene: FrictionScene, statics: Statics, flanks: Mapping[int, float], senses: Sequence[float]
) -> End:
    """The load at which it is about to move, with teeth on the flanks on which they push there; ``statics``
    has them on the given ones."""

    def end(own: Mapping[int, float]) -> End:
        on_these = statics if own == flanks else statics_of(scene, ties_of(scene.position), own)
        return impending(on_these, senses)._replace(statics=on_these)

    return on_flanks(flanks, end)


def _told(found: StaticRange, ends: Sequence[EndOfRange], rates: RubbingRates) -> AtRest:
    """A range as it is told, with what is proven of its ends."""
    lost = [one for one in ends if one.proven.why and is_beyond(one.statics, one.end.value)]
    ends = [one for one in ends if one not in lost]
    found = without_ends(found, [one.end for one in lost])
    proven = [one.proven for one in ends]
    bounds = [bound for each in proven for bound in each.bounds.values()]
    why = next((each.why for each in proven if each.why), "" if bounds else UNENDING)
    exact = {one.end.value: value for one in ends for value in one.proven.values.values()}
    every = (found.least, found.most, *found.possible, *found.parts)
    least, most, first, last, *parts = (exact.get(v, v) for v in every)
    found = found._replace(least=least, most=most, possible=(first, last), parts=tuple(parts))
    return AtRest(found, None if why else max(bounds), why, ends, rates)


def _of_several_freedoms(scene: FrictionScene) -> AtRest:
    """The range of the one unknown load where friction holds several freedoms, or equilibrium leaves open how
    joints that rub share it: there is no one motion that would begin at its ends.

    Raises SceneError where there is none, and where the fit of joints alone presses what rubs.
    """
    from icsolve.statics.friction.standing import beyond_friction, refuse_fit

    shared = refuse_fit(_resting(scene))
    ties = ties_of(scene.position)
    statics = equilibrium(scene.position, ties, scene.balance, rubs_of(scene.position, ties))
    within = limited.held(_resting(scene), scene.at)
    if not within.ranges:
        beyond = "" if scene.alone else beyond_friction(_resting(scene))
        raise SceneError(Status.NO_VALUE, f"{NEVER_HELD.format(statics.roots[0])} {beyond}".rstrip())
    own, again = within.nearest(0.0)
    both = zip((own.low, own.high), own.vertices, strict=True)
    ends = [at_vertex(value, vertex) for value, vertex in both]
    presses = not any(row.get(statics.root(0)) for row in statics.general.left)
    found = range_of(ends)._replace(how=within.how, again=again, presses=presses, shared=shared)
    finite = (end for end in ends if math.isfinite(end.value))
    of = [EndOfRange(1.0, scene, statics, end, _proven_end(scene, statics, end)) for end in finite]
    return _told(found, of, RubbingRates((), ()))


NEVER_HELD = (
    "no value of {} holds: friction within its limits is not enough, or a contact would have to pull."
)


def _range_with_ropes(scene: FrictionScene, rates: RubbingRates) -> tuple[StaticRange, list[EndOfRange]]:
    """The range where ropes slip: about to move one way and the other, with the pulls that go with each; and
    its ends.

    Where a rope would have to push before the mechanism is about to move, the range is that in which friction
    within its limits holds.
    """
    senses, within = rates.senses.rubs, limited.held(_resting(scene))
    moving: list[EndOfRange] = []
    for way in (1.0, -1.0):
        one = as_ropes_slip(scene, rates, way)
        ties = ties_of(one.position)
        statics = statics_of(one, ties, flanks_of(one, ties, False))
        end = end_of(statics, [way * sense for sense in senses])
        if end is not None and math.isfinite(end.value) and _pulls(statics, end):  # and no contact parts
            moving.append(EndOfRange(way, one, statics, end, _proven_end(one, statics, end)))
    still = as_ropes_slip(scene, rates, 0.0)
    bare = statics_of(still, ties := ties_of(still.position), flanks_of(still, ties, False))
    smooth = smooth_load(bare)
    if not within.ranges:
        parameters = bare.parameters({bare.roots[0]: smooth or 0.0}, (0.0,) * len(senses))
        tensions_of(bare, parameters, FLOATS, scene.position.case.units.force)
        raise SceneError(Status.NO_VALUE, NEVER_TAUT.format(bare.roots[0]))
    own, _ = within.nearest(smooth or 0.0)
    both = zip((own.low, own.high), own.vertices, strict=True)
    ends = [_same(value, moving) or at_vertex(value, vertex, senses) for value, vertex in both]
    possible = (ends[0].value, ends[1].value)
    if len(moving) == 2:
        ends = [one.end for one in moving]
    found = range_of(ends)._replace(possible=possible, how=within.how)
    if smooth is None:
        found = found._replace(presses=True)
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
        return proven_of(scene, Solved(own, {root: end.value}, end.friction), end.senses)
    with suppress(SceneError):
        value = limited.exactly(_resting(scene), vertex)
        if value is None:
            return Proven(TURNED)
        return Proven("", {root: value.error or 0.0}, {root: value.value})
    return Proven(TOO_CLOSE if scene.enclose else UNBOUND)


TURNED = f"{UNSURE} where a contact parts and pins rub"


def held(scene: FrictionScene, answer_with: Callable[[Mapping[str, Value]], Answer]) -> Answer:
    """The answer at rest; ``answer_with`` makes the rest of it from values of the unknown loads.

    Raises SceneError as `at_rest` does.
    """
    rest = at_rest(scene)
    found, (root,) = rest.range, (w.load.name for w in scene.balance.wrenches if is_unknown(w.load))
    answer = answer_with({root: Value(0.0, rest.bound, rest.why)})
    answers = {name: _held(scene, name, found, shown) for name, shown in answer.answers.items()}
    jams = jammed(scene.position, scene.balance, root, (found.least, found.most))
    told = [sentences.below_none(load) for load in less_than_none(answer.case.loads, answers)]
    notes = (*answer.notes, *told, *notes_at_rest(root, found), *([jams] if jams else ()))
    friction = FrictionFound(
        (),
        0.0,
        0.0,
        found.how,
        possible=found.possible,
        again=found.again,
        grown=found.grown,
        shared=found.shared,
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
            found = with_bodies(scene, rough, end.senses, slid, rest.rates.times(way), True)
            yield AboutToMove(way, answer_of(found, answer_with, True))


def _no_slopes() -> dict[str, dict[str, float]]:
    said = "a range in which the mechanism holds still has none. Give its `motion`."
    raise SceneError(Status.UNSUPPORTED, f"{NO_SLOPES}: {said}")


def _held(scene: FrictionScene, name: str, found: StaticRange, shown: Found) -> Found:
    """The range of a load that is the unknown, or a multiple of it; ``shown`` has its bound."""
    ratio = next(float(w.ratio) for w in scene.balance.wrenches if w.load.name == name)
    ends = sorted((ratio * found.least, ratio * found.most))
    return shown._replace(value=math.nan, sense="", holds=(ends[0], ends[1]), self_locking=found.self_locking)


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
    grown = found.grown or ()
    for low, high in found.again:
        where = f"from {root} = {low:.6g} to {high:.6g}"
        if math.isinf(high - low):
            end = low if math.isinf(high) else high
            where = f"beyond {root} = {end:.6g}, where it is about to move too,"
        notes.append(f"{where} it {'holds' if (low, high) in grown else 'may hold'} again.")
    for end, last, way in zip((found.least, found.most), found.possible, (-1, 1), strict=True):
        beside = [[low, high][::way] for low, high in grown if way * end <= way * low <= way * last][::way]
        parts = pairwise([end, *(at for part in beside for at in part), last])
        for (start, more), said in zip(parts, cycle((MAY_HOLD, HOLDS_TOO))):
            if start != more:
                notes.append(f"from {start:.6g} {_as_far_as(more)} {said}")
    return notes


MAY_HOLD = (
    "it may still hold, if friction was left the other way round at some joint (the end is that of impending "
    "motion)."
)
HOLDS_TOO = "it holds too."


def _as_far_as(end: float) -> str:
    return f"to {end:.6g}" if math.isfinite(end) else "up" if end > 0.0 else "down"
