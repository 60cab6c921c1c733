"""A case in space: figure, what joints carry, the motions that they leave, the unknown loads, the answer.

1. figure: points in a frame whose numbers are about 1
2. ties: the unit forces and couples that each joint carries
3. motions: what the joints leave free, and by the power of the loads on it the unknown loads
4. equilibrium of every body: the reactions, and the unknown loads a second time
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from icsolve.answer import Answer, Deferred, Found
from icsolve.answer.space import Spatial, Witness
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers.linear import solve_square
from icsolve.statics.equilibrium import independent
from icsolve.statics.space.equilibrium import Bounds, SpatialStatics, bounds_of, statics_of
from icsolve.statics.space.figure import SpatialFigure, figure_of, in_case
from icsolve.statics.space.power import (
    SpatialBalance,
    Twist,
    Wrenched,
    balance_of,
    is_unknown,
    motions_of,
    wrenched,
)
from icsolve.statics.space.reaction_basis import SpatialTie, flanked, ties_of
from icsolve.statics.space.reactions import (
    notes_of,
    reactions_of,
    refuse_huge,
    refuse_loose,
    refuse_unbalanced,
)
from icsolve.statics.space.report import advantage_of, sense_of, terms_of, unit_of

MOST_TURNS = 4
"""The flanks that carry are tried again so often, where a separating force turns a tangential one."""


class SpatialSolution(NamedTuple):
    """Motions, unknown loads by power, and the equilibrium of all bodies."""

    motions: tuple[Mapping[str, Twist], ...]
    balance: SpatialBalance
    statics: SpatialStatics


def solve_space(case: Case) -> Answer:
    """The answer of a case in space.

    Raises SceneError where it has none.
    """
    figure = figure_of(in_case(case))
    ties = ties_of(case, figure)
    refuse_loose(case, ties)
    loads = wrenched(case, figure)
    solved = _on_carrying_flanks(case, ties, loads)
    refuse_unbalanced(figure, solved.motions, loads, solved.balance)
    bounds = bounds_of(solved.statics, solved.motions, loads, solved.balance)
    parameters = solved.statics.parameters(solved.balance.unknowns)
    refuse_huge(solved.statics, parameters)
    witnesses = _witnesses(solved, bounds)
    reactions = reactions_of(case, figure.frame, solved.statics, parameters)
    spatial = Spatial(_named(figure), reactions, witnesses, bounds.residual)
    notes = notes_of(figure, solved.motions, loads, solved.balance, solved.statics, reactions)
    return _answer(case, solved, loads, bounds, spatial, notes)


def _on_carrying_flanks(
    case: Case, ties: tuple[SpatialTie, ...], loads: Sequence[Wrenched]
) -> SpatialSolution:
    """The tangential forces alone show which flanks of the teeth carry; the other parts go with them."""
    solved = _solved(case, ties, loads)
    flanks: dict[int, float] = {t: 0.0 for t, tie in enumerate(ties) if tie.mesh}
    for _ in range(MOST_TURNS):
        turned = {t: _carrying(solved, t) * (flank or 1.0) for t, flank in flanks.items()}
        if turned == flanks:
            break
        flanks = turned
        solved = _solved(case, flanked(ties, flanks), loads)
    return solved


def _carrying(solved: SpatialSolution, t: int) -> float:
    """Sign of the force in a mesh along its unit."""
    value = solved.statics.value(solved.statics.first[t], solved.statics.parameters(solved.balance.unknowns))
    return 0.0 if value == 0.0 else math.copysign(1.0, value)


def _solved(case: Case, ties: tuple[SpatialTie, ...], loads: Sequence[Wrenched]) -> SpatialSolution:
    links = [link for link in case.links if link != case.ground]
    motions = motions_of(links, ties)
    roots = [w.root for w in loads if is_unknown(w.load)]
    statics = statics_of(links, ties, loads, len(motions))
    if len(statics.general.left) != len(motions):
        raise SceneError(Status.NEAR_SINGULAR, _doubtful(len(motions), len(statics.general.left)))
    return SpatialSolution(motions, balance_of(motions, loads, roots), statics)


def _doubtful(motions: int, left: int) -> str:
    return (
        f"by its motions the case has {motions} degrees of freedom, by the equilibrium of its bodies {left}: "
        "it is too near to a singular one. Give its data with more digits."
    )


def _witnesses(solved: SpatialSolution, bounds: Bounds) -> tuple[Witness, ...]:
    """The unknown loads by the equilibrium of the bodies alone, beside those from power.

    Raises SceneError where they disagree by more than rounding explains.
    """
    statics, roots = solved.statics, solved.statics.roots
    columns = [statics.known + 1 + n for n in range(len(roots))]
    rows = [
        [*(left.get(c, 0.0) for c in columns), -left.get(statics.known, 0.0)] for left in statics.general.left
    ]
    rows = independent(rows, len(roots))
    values = solve_square([row[:-1] for row in rows], [row[-1] for row in rows]) if roots else []
    if values is None or len(rows) < len(roots):
        raise SceneError(Status.NEAR_SINGULAR, _doubtful(len(solved.motions), len(rows)))
    found = []
    for root, value in zip(roots, values, strict=True):
        power, bodies = solved.balance.unknowns[root], value / statics.scale
        found.append(Witness(root, power, bodies, bodies - power, bounds.of[root]))
        if abs(bodies - power) > max(bounds.of[root], 1e-9 * max(abs(power), abs(bodies))):
            raise SceneError(Status.NEAR_SINGULAR, _apart(found[-1]))
    return tuple(found)


def _apart(w: Witness) -> str:
    return (
        f"power gives {w.load} = {w.power:.9g} and the equilibrium of the bodies {w.bodies:.9g}: they should "
        "be one number, so the case is too near to a singular one. Give its data with more digits."
    )


def _named(figure: SpatialFigure) -> dict[str, tuple[float, float, float]]:
    return {name: place for name, place in figure.places.items() if not name.startswith("@")}


def _answer(
    case: Case,
    solved: SpatialSolution,
    loads: Sequence[Wrenched],
    bounds: Bounds,
    spatial: Spatial,
    notes: tuple[str, ...],
) -> Answer:
    values = {}
    for w in loads:
        number = solved.balance.unknowns[w.root] if w.known is None else w.known
        error = bounds.of.get(w.root, 0.0)
        values[w.load.name] = 0.0 if w.known is None and abs(number) <= error else w.ratio * number + 0.0
    unknown = [w for w in loads if w.known is None]
    return Answer(
        case=case,
        answers={w.load.name: _found(case, w, values[w.load.name], bounds) for w in unknown},
        terms=terms_of(case, loads, solved.motions, values),
        advantage=advantage_of(loads, values),
        mobility=len(solved.motions),
        notes=notes,
        sensitivities=Deferred(_no_sensitivities),
        spatial=spatial,
    )


def _found(case: Case, w: Wrenched, value: float, bounds: Bounds) -> Found:
    return Found(value, unit_of(w.load, case), sense_of(w, value), abs(w.ratio) * bounds.of[w.root])


def _no_sensitivities() -> dict[str, dict[str, float]]:
    raise SceneError(
        Status.UNSUPPORTED,
        "sensitivities and tolerance bands are worked out for planar cases only; this one is in space.",
    )
