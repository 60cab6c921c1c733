"""The pipeline: a case, its figure, the motions that its joints allow, the sum of power, the answer.

1. topology: which links move as one, and the joints between them
2. plan: the groups of links that the wanted twists need, and no others
3. figure: the points that those groups and the loads need
4. motions: the twist of every planned link (a centre that keeps its weight)
5. power: the loads' wrenches on the twists give the unknown loads
6. centres and rates, as far as they are asked for
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

from icsolve import power, sentences, speeds, verdicts
from icsolve.answer import Answer, Centre, Deferred, Found, Later, Term
from icsolve.arithmetic import FLOATS
from icsolve.bounds import (
    Bounded,
    Value,
    bounded_centre,
    bounded_values,
    evaluate_bounded,
    floats,
    plain,
    rate_errors,
    slopes,
    unbounded_values,
)
from icsolve.case import Case, Pair
from icsolve.centres import CentreFinder
from icsolve.errors import SceneError, Status
from icsolve.figure import Figure, case_point
from icsolve.motion import Motions
from icsolve.names import link_order
from icsolve.program import Outcome, Program, Want, evaluate, prepare
from icsolve.sense import sense_of, unit_of
from icsolve.terms import advantage, load_values, power_terms
from icsolve.topology import Topology

if TYPE_CHECKING:
    from icsolve.bodies.ties import Position


def solve(
    case: Case,
    *,
    all_centres: bool = False,
    rates: bool = False,
    examine: bool = False,
    bound: bool = True,
    reactions: bool = False,
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
        Bound the error of every answer, rate and centre (three times the work).
    reactions : bool
        The force of each link on each other at every joint too; a structure is then solved as well.

    Raises
    ------
    SceneError
        Where the scene has no answer; its ``status`` is a member of `icsolve.errors.Status`.
    """
    if case.space is not None:
        from icsolve.space.solve import solve_space

        return solve_space(case)
    if case.profiles is not None and case.profiles.touches:
        from icsolve.profile.solving import solve_touching

        asked = {"all_centres": all_centres, "rates": rates, "examine": examine}
        return solve_touching(case, **asked, bound=bound, reactions=reactions)
    want, rubbing = _wanted(case, Want(all_centres, rates, examine, reactions))
    program = prepare(case, want)
    try:
        scene = evaluate_bounded(program) if bound else None
        program, outcome = (scene.program, scene.outcome) if scene else evaluate(program)
    except SceneError as error:
        if reactions and error.status == Status.STRUCTURE:
            return _structure(program, error)
        raise
    if rubbing:
        return _with_friction(_Parts(program, outcome, {}, scene), reactions)
    verdicts.refuse_unbalanced(case, program.top, outcome.motions, outcome.balance, outcome.solution)
    values = bounded_values(scene) if scene else unbounded_values(outcome)
    parts = _Parts(program, outcome, values, scene)
    return _with_bodies(parts) if reactions else parts.answer()


@lru_cache(maxsize=32)
def _wanted(case: Case, asked: Want) -> tuple[Want, bool]:
    """What is to be found for what was asked; whether friction has a part in it."""
    if not any(power.is_unknown(load) for load in case.loads):
        return asked._replace(centres=True, rates=True), False
    rubbing = verdicts.rubs(case)
    return asked._replace(bodies=asked.bodies or rubbing), rubbing


class _Parts:
    """The parts of an answer, each made when somebody looks into it."""

    def __init__(
        self, program: Program, outcome: Outcome, unknowns: dict[str, Value], scene: Bounded | None
    ) -> None:
        self.program, self.case, self.figure = program, program.case, program.figure
        self.traced, self.unknowns, self.scene = outcome, unknowns, scene

    @cached_property
    def outcome(self) -> Outcome:
        """In floats, without the tape."""
        return plain(self.traced)

    @cached_property
    def speed(self) -> speeds.Speed:
        """Which motion is meant, and how fast."""
        return speeds.speed_of(self.case, self.outcome.motions.twists, self.figure.frame, self.figure.points)

    def answer(self) -> Answer:
        """The answer as frozen values; a given motion that can't be is refused."""
        balance, motions = self.traced.balance, self.traced.motions
        values = load_values(balance, self.unknowns)
        moving = self._moving() if self.program.want.rates else (None, None)
        if self.case.motion:
            _ = self.speed
        return Answer(
            case=self.case,
            answers=_found(self.case, balance, self.unknowns, values),
            centres=Deferred(self._centres),
            rates=moving[0],
            velocities=moving[1],
            points=Deferred(lambda: _shown(self.figure)),
            terms=Later(lambda: self._terms(values)),
            advantage=advantage(balance, values, self.unknowns),
            mobility=motions.mobility,
            notes=(*self.figure.notes, *motions.notes, *_notes(self.program.top, self.traced)),
            skipped=Later(lambda: _skipped(self.program, self.traced)),
            steps=Later(lambda: _steps(self.program)),
            sensitivities=Deferred(lambda: slopes(self.scene) if self.scene else {}),
            errors=Deferred(self._errors),
        )

    def _moving(self) -> tuple[dict[str, float | str], dict[tuple[str, str], tuple[float, float] | str]]:
        """Link rates and point velocities."""
        case, twists, figure = self.case, self.outcome.motions.twists, self.figure
        velocities = speeds.point_velocities(case, twists, self.speed, figure.frame, figure.points)
        return speeds.link_rates(case, twists, self.speed), velocities

    def _terms(self, values: dict[str, float]) -> tuple[Term, ...]:
        balance = self.outcome.balance
        return tuple(power_terms(self.case, self.figure.frame, balance, values, self.speed))

    def _errors(self) -> dict[str, dict[str, float]]:
        if self.scene is None or not self.program.want.rates:
            return {}
        return {"rates": rate_errors(self.scene, self.speed)}

    def _centres(self) -> dict[Pair, Centre]:
        """The centres that are asked for: all, or those of the loaded links."""
        case, figure, twists = self.case, self.figure, self.outcome.motions.twists
        if case.motion:
            twists = {link: speeds.meant(twists, self.speed, link) for link in twists}
        finder = CentreFinder(case, self.program.top, twists, figure.frame, figure.points, FLOATS)
        pairs = [pair for pair in wanted_pairs(case, self.program.want) if {*pair} <= twists.keys()]
        found = finder.find(pairs, self.outcome.motions.slack)
        if self.scene is None:
            return found
        return {pair: bounded_centre(self.scene, centre) for pair, centre in found.items()}


def _with_bodies(parts: _Parts) -> Answer:
    """The answer with the reactions, and with the unknown loads as free bodies give them."""
    from icsolve.bodies.statics import free_bodies

    by_power = {root: (value.value, value.error or 0.0) for root, value in parts.unknowns.items()}
    found = free_bodies(_position(parts), parts.figure.frame, parts.outcome.balance, by_power)
    return found.added_to(parts.answer())


def _with_friction(parts: _Parts, reactions: bool) -> Answer:
    """The answer with friction, from free bodies; its motion or the range in which it holds."""
    from icsolve.bodies.friction import solved
    from icsolve.bodies.rubbing import Scene

    def answer_with(values: Mapping[str, Value]) -> Answer:
        parts.unknowns = dict(values)
        return parts.answer()

    top, outcome = parts.program.top, parts.outcome
    if not verdicts.is_workless(outcome.motions, outcome.solution):
        verdicts.refuse_unbalanced(parts.case, top, outcome.motions, outcome.balance, outcome.solution)
    scene = Scene(_position(parts), parts.figure.frame, outcome.balance, outcome.solution, parts.speed)
    return solved(scene._replace(traced=parts.scene), answer_with, reactions)


def _position(parts: _Parts) -> Position:
    """The scene as free bodies take it."""
    from icsolve.bodies.ties import Position

    figure, moves = parts.figure, parts.outcome.motions
    scale, slack = figure.frame.scale, float(moves.slack)
    return Position(parts.case, parts.program.top, figure.points, scale, moves.twists, slack)


def _structure(program: Program, refusal: SceneError) -> Answer:
    """A structure by statics alone; it has no unknown load that anything would determine."""
    from icsolve.bodies.statics import structure

    return structure(program, refusal)


def _shown(figure: Figure) -> dict[str, tuple[float, float]]:
    """The points that have a name in the case, in case units."""
    named = (name for name in figure.points if not name.startswith("@"))
    return {name: case_point(figure.frame, figure.points[name]) for name in named}


def _found(
    case: Case, balance: power.Balance, unknowns: dict[str, Value], values: dict[str, float]
) -> dict[str, Found]:
    """The unknown loads and those that are like them, in order."""
    found = {}
    for w in balance.wrenches:
        if w.root in unknowns:
            name, unknown = w.load.name, unknowns[w.root]
            error = None if unknown.error is None else abs(w.ratio) * unknown.error
            sense = sense_of(w, values[name])
            found[name] = Found(values[name], unit_of(w.load, case), sense, error, unknown.why)
    return found


def wanted_pairs(case: Case, want: Want) -> list[Pair]:
    """Pairs of links whose centres are asked for, in order."""
    links = sorted(case.links, key=lambda link: link_order(case, link))
    pairs = [(a, b) for n, a in enumerate(links) for b in links[n + 1 :]]
    if want.centres or want.examine:
        return pairs
    loaded = {load.link for load in case.loads} | {case.ground}
    against = {frozenset((load.link, power.reacting(case, load))) for load in case.loads}
    return [pair for pair in pairs if {*pair} <= loaded or frozenset(pair) in against]


def _notes(top: Topology, outcome: Outcome) -> list[str]:
    """Sentences about the mechanism that a reader of the answer should know."""
    notes = []
    motions, solution = outcome.motions, outcome.solution
    if motions.redundant and not motions.notes:
        notes.append(_redundancy(top, motions))
    if solution.idle and solution.values:
        count = sentences.plural(len(solution.idle), "passive freedom")
        notes.append(f"{count} in which no load does work.")
    return notes


def _redundancy(top: Topology, motions: Motions) -> str:
    """What becomes of a motion that redundant constraints allow in this position."""
    from icsolve.second_order import goes_on

    bases = {k: tuple(map(floats, basis)) for k, basis in motions.bases.items()}
    return sentences.redundant(motions.redundant, goes_on(top, bases))


def _skipped(program: Program, outcome: Outcome) -> tuple[str, ...]:
    """What was not examined because the answer does not need it."""
    left = [link for link in program.case.links if link not in outcome.motions.twists]
    names = (f"links {sentences.listed(left)}",) if len(left) > 1 else tuple(f"link {link}" for link in left)
    return (*names, *program.figure.skipped)


def _steps(program: Program) -> tuple[str, ...]:
    """The steps of the plan that ran."""
    figure = tuple(step.name for step in program.figure.steps)
    if program.plan is None:
        return (*figure, "motions: loop equations of the whole scene")
    top = program.top
    entry = top.bonds[program.plan.entry]
    names = [f"motions: virtual input {entry.links[0]}-{entry.links[1]}"]
    for group in program.plan.groups:
        links = sentences.listed(top.members[body][0] for body in group.bodies)
        names.append(f"motions: link {links}" if len(group.bodies) == 1 else f"motions: links {links}")
    return (*figure, *names)
