"""The equilibrium of every link of a scene: reactions, friction, and structures, which have nothing else."""

from __future__ import annotations

from collections.abc import Mapping

from icsolve.answer import Answer
from icsolve.assembly import case_point
from icsolve.errors import SceneError
from icsolve.numbers.arithmetic import FLOATS
from icsolve.scene.parts import Parts
from icsolve.scene.program import Program
from icsolve.screws.plane import Triple
from icsolve.statics.free_bodies import free_bodies
from icsolve.statics.friction import Scene, solved
from icsolve.statics.friction_interface import has_friction
from icsolve.statics.power import Balance, Value, is_unknown, wrenches
from icsolve.statics.reaction_basis import Position, rope_ties


def with_bodies(parts: Parts, reactions: bool) -> Answer:
    """The answer with the reactions, and with the unknown loads as free bodies give them."""
    by_power = {root: (value.value, value.error or 0.0) for root, value in parts.unknowns.items()}
    found = free_bodies(_position(parts), parts.figure.frame, parts.outcome.balance, by_power)
    return found.added_to(parts.answer(), reactions)


def with_friction(parts: Parts, reactions: bool) -> Answer:
    """The answer with friction, from free bodies; its motion or the range in which it holds."""

    def answer_with(values: Mapping[str, Value]) -> Answer:
        parts.given = dict(values)
        return parts.answer()

    outcome = parts.outcome
    scene = Scene(_position(parts), parts.figure.frame, outcome.balance, outcome.solution, parts.speed)
    return solved(scene._replace(traced=parts.traced), answer_with, reactions)


def _position(parts: Parts) -> Position:
    """The scene as free bodies take it."""
    case, figure, moves = parts.case, parts.figure, parts.outcome.motions
    scale, slack = figure.frame.scale, float(moves.slack)
    found = parts.first.outcome.points
    points = {name: (float(x), float(y)) for name, (x, y) in found.items()}  # the exact places, rounded once
    ropes = rope_ties(case, points, scale)
    return Position(case, parts.program.top, points, scale, moves.twists, slack, ropes)


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
    scale = figure.frame.scale
    place = Position(case, top, figure.points, scale, still, 0.0, rope_ties(case, figure.points, scale))
    balance = Balance(wrenches(case, figure.frame, figure.points, FLOATS), (), ())
    points = {n: case_point(figure.frame, p) for n, p in figure.points.items() if not n.startswith("@")}
    said = "the links form a structure: nothing moves, and statics alone gives the reactions."
    if has_friction(case):
        said += " Friction is left out: a structure needs none."
    answer = Answer(case, points=points, mobility=0, notes=(*figure.notes, said), skipped=figure.skipped)
    return free_bodies(place, figure.frame, balance, {}).added_to(answer)
