"""A case in space: figure, what joints carry, the motions that they leave, the unknown loads, the answer.

1. figure: points in a frame whose numbers are about 1
2. ties: the unit forces and couples that each joint carries
3. motions: what the joints leave free, and by the power of the loads on it the unknown loads
4. equilibrium of every body: the reactions, and the unknown loads a second time
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress

from icsolve.answer import Answer, Deferred, Found
from icsolve.answer.bodies import Spatial
from icsolve.case import Case, is_named
from icsolve.errors import SceneError, Status
from icsolve.numbers import FLOATS, Showing
from icsolve.numbers.balls import PRECISIONS, Balls, HalfUnits, MoreDigits, is_long
from icsolve.numbers.units import numbers_in
from icsolve.statics.free_bodies import on_flanks
from icsolve.statics.power import advantage, load_value
from icsolve.statics.space.power import SpatialSolution, solution_of, wrenches
from icsolve.statics.space.reaction_basis import (
    SpatialFigure,
    SpatialTie,
    figure_of,
    flanked,
    in_case,
    ties_of,
)
from icsolve.statics.space.reactions import (
    notes_of,
    reactions_of,
    refuse_loose,
    refuse_unbalanced,
    sense_of,
    terms_of_power,
    unit_of,
)
from icsolve.statics.witness import (
    bounds_of,
    compared,
    refuse_doubt,
    residual,
    terms_of,
    unknowns_of,
)
from icsolve.tuples import replace
from icsolve.wording import less_than_none
from icsolve.wording.sentences import EXPLAINED, below_none


def solve_space(case: Case, bound: bool) -> Answer:
    """The answer of a case in space, in as many digits as its questions need; without ``bound`` in doubles.

    Raises SceneError where it has none, and where the highest precision leaves it open.
    """
    if not bound:
        return _solve(case, FLOATS)
    try:
        return _exactly(case, [Balls(p, highest=p == PRECISIONS[-1]) for p in PRECISIONS])
    except SceneError as refusal:
        if refusal.status not in INEXACT or not any(map(is_long, numbers_in(in_case(case)))):
            raise
        try:  # what half a unit of the last digits of long numbers may make zero is zero
            answer = _exactly(case, [HalfUnits(PRECISIONS[0])])
        except SceneError:
            raise refusal from None
    return replace(answer, notes=(EXPLAINED, *answer.notes))


INEXACT = (Status.STRUCTURE, Status.MOBILITY, Status.NEAR_SINGULAR, Status.CONTRADICTORY, Status.NO_VALUE)
"""What a case may seem whose numbers a program has rounded."""


def _exactly(case: Case, arithmetics: Sequence[Balls]) -> Answer:
    """The answer by the fewest digits that settle every question."""
    for arithmetic in arithmetics:
        with suppress(MoreDigits):
            return _solve(case, arithmetic)
    raise SceneError(
        Status.NEAR_SINGULAR,
        "the position is so near a singular one that 120 digits do not settle what the joints carry: move a "
        "point, or an axis.",
    )


def _solve(case: Case, a: Showing) -> Answer:
    """The answer in an arithmetic; raises SceneError where there is none, and MoreDigits."""
    figure = figure_of(in_case(case), a)
    ties = ties_of(case, figure)
    refuse_loose(case, ties)
    solved = _on_carrying_flanks(case, figure, ties)
    statics = solved.statics
    refuse_unbalanced(solved)
    terms = terms_of(statics, solved.parameters)
    bounds = bounds_of(statics, solved.powers, solved.twists, terms)
    unknowns = unknowns_of(statics)
    if unknowns is None:
        refuse_doubt(0, solved.mobility)
    by_power = {q: (a.rounded(x)[0], 0.0) for q, x in solved.balance.unknowns.items()}
    roundings = bounds if a is FLOATS else None
    found = compared(by_power, unknowns or {}, roundings, 0.0, statics, solved.parameters, a)
    reactions = reactions_of(solved, a)
    shown = {name: tuple(map(float, p)) for name, p in figure.places.items() if is_named(name)}
    places = {name: (x, y, z) for name, (x, y, z) in shown.items()}
    spatial = Spatial(places, reactions, found, residual(terms))
    return _answer(solved, bounds, spatial, a)


def _on_carrying_flanks(case: Case, figure: SpatialFigure, ties: tuple[SpatialTie, ...]) -> SpatialSolution:
    """The tangential forces alone show which flanks of the teeth carry; the other parts go with them."""
    loads = wrenches(case, figure)

    def solve(flanks: Mapping[int, float]) -> SpatialSolution:
        return solution_of(case, figure, flanked(ties, flanks), loads)

    meshes = [t for t, tie in enumerate(ties) if tie.mesh]
    found = solve({})
    return on_flanks({t: found.carrying(t) for t in meshes}, solve) if meshes else found


def _answer(solved: SpatialSolution, bounds: Mapping[str, float], spatial: Spatial, a: Showing) -> Answer:
    case, exact, values, found = solved.case, solved.balance.unknowns, {}, {}
    for w in solved.powers.wrenches:
        value, error = a.rounded(load_value(w, exact, a))
        if w.root in exact:
            if not error < math.inf:  # in doubles
                error = abs(float(w.ratio)) * bounds[w.root]
                value = 0.0 if abs(value) <= error else value
            found[w.load.name] = Found(value, unit_of(w.load, case), sense_of(w, value), error)
        values[w.load.name] = value
    assert case.space is not None
    told = map(below_none, less_than_none(case.space.loads, found))
    return Answer(
        case=case,
        answers=found,
        terms=terms_of_power(solved, values, a),
        advantage=advantage(solved.powers.wrenches, exact, a),
        mobility=solved.mobility,
        notes=(*case.noticed, *told, *notes_of(solved, spatial.reactions)),
        sensitivities=Deferred(_no_sensitivities),
        spatial=spatial,
    )


def _no_sensitivities() -> dict[str, dict[str, float]]:
    raise SceneError(
        Status.UNSUPPORTED,
        "sensitivities and tolerance bands are worked out for planar cases only; this one is in space.",
    )
