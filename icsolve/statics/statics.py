"""Free bodies of a scene without friction: reactions, and the witness for the unknown loads."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from icsolve.answer import Answer
from icsolve.answer.bodies import Friction, Reactions, Witness
from icsolve.assembly import Frame, case_point
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import FLOATS
from icsolve.numbers.sparse import Row
from icsolve.screws.plane import Triple
from icsolve.solve.program import Program
from icsolve.statics import gears
from icsolve.statics.agreement import bounds_of, refuse_apart, unknowns_of, witnesses
from icsolve.statics.equilibrium import Statics, equilibrium, residual, terms_of
from icsolve.statics.imbalance import refuse_imbalance
from icsolve.statics.losses import efficiency, friction_terms
from icsolve.statics.power import Balance, is_unknown, wrenches
from icsolve.statics.reactions import is_unique, names_by_tie, reactions_of
from icsolve.statics.rubs import has_friction
from icsolve.statics.said import said_of
from icsolve.statics.ties import Position, Tie, ties_of
from icsolve.wording.sentences import plural


class Bodies(NamedTuple):
    """What free bodies say of a scene."""

    reactions: Reactions
    witnesses: tuple[Witness, ...] = ()
    residual: float = 0.0
    notes: tuple[str, ...] = ()
    friction: Friction | None = None

    def added_to(self, answer: Answer, reactions: bool = True) -> Answer:
        """An answer with what free bodies add to it; friction brings its losses to the sum of power."""
        friction, terms = self.friction, answer.terms
        if friction is not None:
            friction = friction._replace(efficiency=efficiency(terms))
            terms = (*terms, *friction_terms(friction, answer.case))
        return replace(
            answer,
            terms=terms,
            reactions=self.reactions if reactions else None,
            witnesses=self.witnesses if reactions else (),
            friction=friction,
            notes=(*answer.notes, *self.notes),
        )


def structure(program: Program, refusal: SceneError) -> Answer:
    """A structure by statics alone: its reactions.

    Raises the refusal of power where there is an unknown load: nothing would determine it.
    """
    case, top, figure = program.case, program.top, program.figure
    if any(is_unknown(load) for load in case.loads):
        said = str(refusal).partition(" Take out")[0]
        remedy = "Any value of the unknown load is carried: give it a number, or take out a joint or a link."
        raise SceneError(refusal.status, f"{said} {remedy}")
    still: dict[str, tuple[Triple, ...]] = dict.fromkeys((*case.links, case.ground), ())
    place = Position(case, top, figure.points, figure.frame.scale, still)
    balance = Balance(wrenches(case, figure.frame, figure.points, FLOATS), (), ())
    points = {n: case_point(figure.frame, p) for n, p in figure.points.items() if not n.startswith("@")}
    said = "the links form a structure: nothing moves, and statics alone gives the reactions."
    if has_friction(case):
        said += " Friction is left out: a structure needs none."
    answer = Answer(case, points=points, mobility=0, notes=(*figure.notes, said), skipped=figure.skipped)
    return free_bodies(place, figure.frame, balance, {}).added_to(answer)


def free_bodies(
    position: Position, frame: Frame, balance: Balance, power: Mapping[str, tuple[float, float]]
) -> Bodies:
    """Equilibrium of every link; ``power`` has the unknown loads as power found them, and their bounds.

    Raises SceneError where the two disagree.
    """
    known = position.mobility and not any(is_unknown(w.load) for w in balance.wrenches)
    left = refuse_imbalance(position, balance) if known else ()
    ties = ties_of(position)
    solved = frictionless(position, balance, ties)
    statics, parameters = solved.statics, solved.parameters
    terms = terms_of(position, statics, balance, parameters)
    bounds = bounds_of(position, statics, balance, terms) if position.mobility else {}
    found = witnesses(power, solved.unknowns, bounds)
    refuse_apart(found, position.slack)
    reactions = reactions_of(position, frame, statics, parameters)
    notes = said_of(statics, reactions, names_by_tie(position.case, statics.ties))
    return Bodies(reactions, found, residual(terms), (*left, *notes))


class Solved(NamedTuple):
    """Statics with the values of its parameters: unknown loads in case units, friction scaled."""

    statics: Statics
    unknowns: dict[str, float]
    friction: tuple[float, ...] = ()

    @property
    def parameters(self) -> Row:
        """Values by column."""
        return self.statics.parameters(self.unknowns, self.friction)


def frictionless(position: Position, balance: Balance, ties: Sequence[Tie]) -> Solved:
    """The statics without friction, with the tooth forces on the flanks that carry."""
    return with_tooth_forces(position, ties, lambda flanked: _solved(position, balance, flanked))


def carrying_flanks(position: Position, ties: Sequence[Tie], found: Solved) -> dict[int, float]:
    """The flanks on which the tooth forces of a solution lie."""
    flanks = {}
    for t in gears.meshes(ties):
        if len(found.statics.ties[t].units) == 1:
            tangent, _ = gears.tangent_and_separating(position, ties[t])
            x, y, _ = found.statics.ties[t].units[0]
            flanks[t] = math.copysign(1.0, x * tangent[0] + y * tangent[1])
    return flanks


def _solved(position: Position, balance: Balance, ties: Sequence[Tie]) -> Solved:
    statics = equilibrium(position, ties, balance)
    refuse_doubt(position, statics)
    unknowns = unknowns_of(statics)
    if unknowns is None:
        raise SceneError(Status.NEAR_SINGULAR, _doubtful(position, 0))
    return Solved(statics, unknowns)


def refuse_doubt(position: Position, statics: Statics) -> None:
    """Refuse a position in which the links' equilibrium and their motions count different freedoms."""
    freedoms = len(statics.general.left)
    if freedoms != position.mobility:
        raise SceneError(Status.NEAR_SINGULAR, _doubtful(position, freedoms))


def _doubtful(position: Position, freedoms: int) -> str:
    return (
        f"by its motions the mechanism has {plural(position.mobility, 'degree')} of freedom, by the "
        f"equilibrium of its links {freedoms}: this position is too near to a singular one. Take another "
        "position, or give its data with more digits."
    )


MOST_TURNS = 4
"""Flanks are tried again where friction turns a tooth force."""


Solve = Callable[[Sequence[Tie]], Solved]


def with_tooth_forces(position: Position, ties: Sequence[Tie], solve: Solve) -> Solved:
    """Solve with the tooth forces on the flanks that carry.

    The tangential forces are found first, with the separating ones open. Where equilibrium determines
    both parts of a force (wheels that no bearing keeps apart), it needs no pressure angle.
    """
    meshes = gears.meshes(ties)
    if not meshes:
        return solve(ties)
    found = solve(gears.with_flanks(position, ties, dict.fromkeys(meshes, 0.0)))
    flanks = {t: carrying(found, t) for t in meshes if is_unique(found.statics, t, 0)}
    flanks = {t: flank for t, flank in flanks.items() if not is_unique(found.statics, t, 1)}
    return on_flanks(position, ties, flanks, solve)


def on_flanks(position: Position, ties: Sequence[Tie], flanks: Mapping[int, float], solve: Solve) -> Solved:
    """Solve with tooth forces on these flanks first; where a force pulls, on the other one."""
    for _ in range(MOST_TURNS):
        found = solve(gears.with_flanks(position, ties, flanks))
        turned = {t: flank * carrying(found, t) for t, flank in flanks.items()}
        if turned == flanks:
            break
        flanks = turned
    return found


def carrying(found: Solved, t: int) -> float:
    """Sign of the force in a mesh along its first unit."""
    return math.copysign(1.0, found.statics.value(found.statics.first[t], found.parameters))
