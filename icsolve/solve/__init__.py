"""The answer of a case: of its scene, or, where a datum of the figure is unknown, of its positions of rest.

`load_function` writes the power of the loads in every mode of the figure on a record, `branches` follows
the modes and encloses the zeros over the whole range, `positions` closes in on each, `stability` tells
whether it is stable, `friction_ranges` finds the ranges in which friction holds, `known_loads` tells whether
it does, `two_data` finds pairs of data; `equilibrium` answers a case.
"""

from __future__ import annotations

from icsolve.answer import Answer
from icsolve.case import Case, Coordinates, refuse_no_case
from icsolve.errors import SceneError, Status
from icsolve.scene import balanced, judged, solve_scene, wanted, without_inertia
from icsolve.scene.parts import AnswerBuilder, scene_of
from icsolve.scene.program import EvaluatedScene, Want, prepare
from icsolve.statics.power import has_friction, is_unknown
from icsolve.tuples import NamedTuple, replace


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

    Returns
    -------
    Answer
        Loads in their case units, places in case lengths, rates in rad/s.

    Raises
    ------
    ArgumentError
        A TypeError, for what is no case, as the path of one.
    SceneError
        Where the scene has no answer: its figure can't be built, or a load has no value in this position. Its
        ``status`` is a member of `icsolve.errors.Status`, its message says what would mend it.
    """
    refuse_no_case(case)
    if not (case.unknowns or _asks_for_a_position(case)):
        found = solve_scene(
            case,
            all_centres=all_centres,
            rates=rates,
            examine=examine,
            bound=bound,
            reactions=reactions,
            dynamic=dynamic,
        )
        return _judged(found, replace(case, dynamic=True) if dynamic and not case.dynamic else case)
    asked = {"all_centres": all_centres, "rates": rates, "reactions": reactions}
    from icsolve.solve.equilibrium import solve_positions

    return solve_positions(replace(case, dynamic=True) if without_inertia(case, dynamic) else case, **asked)


def _judged(found: Answer, case: Case) -> Answer:
    """An answer with whether friction holds the loads, where these are all known."""
    rests = not case.loads or any(map(is_unknown, case.loads)) or not found.mobility
    if not rests and case.touches:
        from icsolve.cams.solving import placed

        case = placed(case)
    if case.space is not None or rests or not has_friction(case):
        return found
    from icsolve.solve import known_loads

    return known_loads.judged(found, case)


def _asks_for_a_position(case: Case) -> bool:
    """Whether an unknown coordinate is one that nothing else fixes, and the loads are all known."""
    if not case.loads or any(map(is_unknown, case.loads)):
        return False
    places = (at for at in case.points.values() if isinstance(at, Coordinates))
    if all(at.x is not None and at.y is not None for at in places):
        return False
    from icsolve.solve.equilibrium import free_coordinate

    return free_coordinate(case) is not None


class Attempt(NamedTuple):
    """A case as far as it goes: its answer, or why it has none; and the motion of its links, where that is
    known (which a case has, too, that its loads leave without an answer)."""

    answer: Answer | None
    refusal: SceneError | None
    scene: AnswerBuilder | None


def attempt(case: Case, *, reactions: bool = False) -> Attempt:
    """Solve all of a case once, and keep what was found: never raises `SceneError`.

    Parameters
    ----------
    reactions : whether the forces in the joints are asked for; given up where the loads are not in balance
    """
    if case.space is not None or case.unknowns:
        return _tried(case, reactions)
    if case.dynamic:
        whole = _tried(case, reactions, all_centres=True, rates=True)
        return whole if whole.refusal is None else _tried(case, reactions)
    if case.touches:
        return _touching(case, reactions)
    want = wanted(case, Want(True, True, False, reactions))
    try:
        parts = balanced(AnswerBuilder(EvaluatedScene(prepare(case, want), certain=True)))
    except SceneError as refusal:  # of a link or point that the answer does not need, it may be
        return _of_needed_part(case, refusal, reactions, want.bodies)
    try:
        return Attempt(_judged(judged(parts, reactions), case), None, parts)
    except SceneError as refusal:
        if not (reactions and refusal.status == Status.UNBALANCED):
            without = wanted(case, Want(True, True, False, reactions), False) != want
            return _tried(case, reactions) if without else Attempt(None, refusal, parts)
    try:  # its centres and speeds can still be told
        return Attempt(_judged(judged(parts, False), case), None, parts)
    except SceneError as refusal:
        return Attempt(None, refusal, parts)


def _of_needed_part(case: Case, refusal: SceneError, reactions: bool, bodies: bool) -> Attempt:
    """What is found of a case of which not all can be solved."""
    from icsolve.scene.needed_part import without_spare_links

    try:
        part, left_out = without_spare_links(case, refusal, bodies=bodies)
    except SceneError:
        return _tried(case, reactions)
    found = attempt(part, reactions=reactions)
    if found.answer is None:
        return _tried(case, reactions)
    answer = found.answer
    return found._replace(answer=replace(answer, notes=(*answer.notes, left_out)))


def _tried(case: Case, reactions: bool, **more: bool) -> Attempt:
    """What the answer needs, and what ``more`` is asked for."""
    try:
        answer = solve(case, reactions=reactions, **more)
    except SceneError as refusal:
        return Attempt(None, refusal, None)
    return Attempt(answer, None, scene_of(answer))


def _touching(case: Case, reactions: bool) -> Attempt:
    """A case with profiles: its contacts are found, and then it is one like any other."""
    from icsolve.cams.solving import placed

    try:
        answer = solve(case, all_centres=True, rates=True, reactions=reactions)
    except SceneError as refusal:
        own = placed(case)
        return Attempt(None, refusal, None if own is case else attempt(own).scene)
    return Attempt(answer, None, scene_of(answer))
