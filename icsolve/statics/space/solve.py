"""A case in space: figure, what joints carry, the motions that they leave, the unknown loads, the answer.

1. figure: points in a frame whose numbers are about 1
2. ties: the unit forces and couples that each joint carries
3. motions: what the joints leave free, and by the power of the loads on it the unknown loads
4. equilibrium of every body: the reactions, and the unknown loads a second time
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from icsolve.answer import Answer, Deferred, Found
from icsolve.answer.space import Spatial
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import FLOATS, Scalar, Showing
from icsolve.statics.free_bodies import carrying, on_flanks
from icsolve.statics.space.figure import SpatialFigure, figure_of, in_case
from icsolve.statics.space.power import (
    SpatialBalance,
    SpatialStatics,
    Twists,
    Wrenched,
    balance_of,
    count_of,
    motions_of,
    powers_of,
    spatial_statics,
    unit_powers,
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
from icsolve.statics.space.report import advantage_of, sense_of, terms_of_power, unit_of
from icsolve.statics.witness import (
    bounds_of,
    refuse_apart,
    refuse_doubt,
    residual,
    terms_of,
    unknowns_of,
    witnesses,
)
from icsolve.tuples import NamedTuple


class SpatialSolution(NamedTuple):
    """Motions, unknown loads by power, and the equilibrium of all bodies."""

    twists: Twists
    balance: SpatialBalance
    statics: SpatialStatics

    @property
    def parameters(self) -> Mapping[int, Scalar]:
        """Values of the columns of the loads."""
        return self.statics.parameters(self.balance.unknowns)

    @property
    def mobility(self) -> int:
        """Motions that the joints leave."""
        return count_of(self.twists)

    def carrying(self, t: int) -> float:
        """Sign of the force in a mesh along its unit; 1 for no force."""
        return carrying(self.statics, self.parameters, t)


def solve_space(case: Case, a: Showing = FLOATS) -> Answer:
    """The answer of a case in space.

    Raises SceneError where it has none.
    """
    figure = figure_of(in_case(case), a)
    ties = ties_of(case, figure)
    refuse_loose(case, ties)
    loads = wrenched(case, figure)
    solved = _on_carrying_flanks(case, ties, loads, a)
    statics, balance = solved.statics, solved.balance
    refuse_unbalanced(figure, solved.twists, loads, balance)
    terms = terms_of(statics, solved.parameters)
    powers = unit_powers(balance.powers, loads, statics.roots)
    bounds = bounds_of(statics, powers, solved.twists, terms)
    refuse_huge(statics, solved.parameters)
    unknowns = unknowns_of(statics)
    if unknowns is None:
        refuse_doubt(0, solved.mobility)
    found = witnesses({q: (float(x), 0.0) for q, x in balance.unknowns.items()}, unknowns or {}, bounds)
    refuse_apart(found, 0.0)
    reactions = reactions_of(case, figure.frame, statics, solved.parameters, a)
    spatial = Spatial(_named(figure), reactions, found, residual(terms))
    notes = notes_of(figure, solved.twists, loads, balance, statics, reactions)
    return _answer(case, solved, loads, bounds, spatial, notes)


def _on_carrying_flanks(
    case: Case, ties: tuple[SpatialTie, ...], loads: Sequence[Wrenched], a: Showing
) -> SpatialSolution:
    """The tangential forces alone show which flanks of the teeth carry; the other parts go with them."""

    def solve(flanks: Mapping[int, float]) -> SpatialSolution:
        return _solved(case, flanked(ties, flanks), loads, a)

    meshes = [t for t, tie in enumerate(ties) if tie.mesh]
    found = solve({})
    return on_flanks({t: found.carrying(t) for t in meshes}, solve) if meshes else found


def _solved(
    case: Case, ties: tuple[SpatialTie, ...], loads: Sequence[Wrenched], a: Showing
) -> SpatialSolution:
    twists = motions_of(case, ties, a)
    statics = spatial_statics(case, ties, loads, count_of(twists), a)
    refuse_doubt(len(statics.general.left), count_of(twists))
    balance = balance_of(powers_of(loads, twists, a), loads, statics.roots, a)
    return SpatialSolution(twists, balance, statics)


def _named(figure: SpatialFigure) -> dict[str, tuple[float, float, float]]:
    shown = {name: tuple(map(float, p)) for name, p in figure.places.items() if not name.startswith("@")}
    return {name: (x, y, z) for name, (x, y, z) in shown.items()}


def _answer(
    case: Case,
    solved: SpatialSolution,
    loads: Sequence[Wrenched],
    bounds: Mapping[str, float],
    spatial: Spatial,
    notes: tuple[str, ...],
) -> Answer:
    values = {}
    for w in loads:
        number = float(solved.balance.unknowns[w.root] if w.known is None else w.known)
        is_zero = w.known is None and abs(number) <= bounds[w.root]
        values[w.load.name] = 0.0 if is_zero else float(w.ratio) * number + 0.0
    found = {}
    for w in loads:
        if w.known is None:
            value, error = values[w.load.name], abs(float(w.ratio)) * bounds[w.root]
            found[w.load.name] = Found(value, unit_of(w.load, case), sense_of(w, value), error)
    return Answer(
        case=case,
        answers=found,
        terms=terms_of_power(case, loads, solved.balance, values),
        advantage=advantage_of(loads, values),
        mobility=solved.mobility,
        notes=notes,
        sensitivities=Deferred(_no_sensitivities),
        spatial=spatial,
    )


def _no_sensitivities() -> dict[str, dict[str, float]]:
    raise SceneError(
        Status.UNSUPPORTED,
        "sensitivities and tolerance bands are worked out for planar cases only; this one is in space.",
    )
