"""The parts of an answer, each made when somebody looks into it."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

from icsolve.answer import Answer, Centre, Deferred, Found, Later, Term
from icsolve.assembly import Figure, case_point
from icsolve.case import Case, Pair
from icsolve.case.names import link_order
from icsolve.errors import SceneError
from icsolve.kinematics import speeds
from icsolve.kinematics.centres import CentreFinder
from icsolve.kinematics.motion import Motions
from icsolve.numbers.arithmetic import FLOATS
from icsolve.screws.plane import Triple
from icsolve.solve.bounds import (
    Bounded,
    Value,
    bounded_centre,
    coefficients,
    floats,
    plain,
    rate_errors,
    slopes,
)
from icsolve.solve.program import Outcome, Program, Want
from icsolve.solve.terms import advantage, load_values, power_terms
from icsolve.statics import power
from icsolve.wording import sentences
from icsolve.wording.senses import sense_of, unit_of


class Parts:
    """What was found of a scene, and what an answer shows of it."""

    def __init__(self, program: Program, outcome: Outcome, scene: Bounded | None) -> None:
        self.program, self.case, self.figure = program, program.case, program.figure
        self.traced, self.scene = outcome, scene
        self.unknowns: dict[str, Value] = {}

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
            notes=(*self.figure.notes, *motions.notes, *_notes(self.program, self.traced)),
            skipped=Later(lambda: _skipped(self.program, self.traced)),
            steps=Later(lambda: _steps(self.program)),
            sensitivities=Deferred(lambda: slopes(self.scene) if self.scene else {}),
            errors=Deferred(self._errors),
            scene=self,
        )

    def moving(self) -> Answer:
        """The motion alone, without bounds: all centres, rates, velocities and points.

        Where the given motion can't be, those of the motion that a case without one has.
        """
        try:
            rates, velocities = self._moving()
        except SceneError:
            if not self.case.motion:
                raise
            bare = replace(self.case, motion=())
            return Parts(self.program._replace(case=bare), self.traced, self.scene).moving()
        return Answer(
            case=self.case,
            centres=Deferred(self.plain_centres),
            rates=rates,
            velocities=velocities,
            points=Deferred(lambda: _shown(self.figure)),
            mobility=self.traced.motions.mobility,
            scene=self,
        )

    @cached_property
    def twists(self) -> dict[str, Triple]:
        """The motion of every link as ``omega * (x, y, 1)`` in case units, where it is determined."""
        motions, frame, speed = self.outcome.motions.twists, self.figure.frame, self.speed
        meant = {link: speeds.meant(motions, speed, link) for link in motions}
        known = {
            link: first
            for link, (first, *rest) in meant.items()
            if all(_extent(t) <= STILL * _extent(first) for t in rest)
        }
        least = STILL * max(map(_extent, known.values()), default=0.0)
        cleaned = {link: _without_rounding(t, least) for link, t in known.items()}
        return {link: frame.twist_shown(t, speed.divisor) for link, t in cleaned.items()}

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

    def plain_centres(self) -> dict[Pair, Centre]:
        """The centres that are asked for: all, or those of the loaded links. With one freedom they are the
        same at every speed, 0 among them."""
        case, figure, twists = self.case, self.figure, self.outcome.motions.twists
        if case.motion and any(len(motions) > 1 for motions in twists.values()):
            twists = {link: speeds.meant(twists, self.speed, link) for link in twists}
        finder = CentreFinder(case, self.program.top, twists, figure.frame, figure.points, FLOATS)
        pairs = [pair for pair in wanted_pairs(case, self.program.want) if {*pair} <= twists.keys()]
        return finder.find(pairs, self.outcome.motions.slack)

    def _centres(self) -> dict[Pair, Centre]:
        """The centres with the bounds of their errors."""
        case, found = self.case, self.plain_centres()
        if self.scene is None:
            return found
        several = case.motion and self.outcome.motions.mobility == 2
        weights = coefficients(self.scene, self.speed) if several else None
        return {pair: bounded_centre(self.scene, centre, weights) for pair, centre in found.items()}


STILL = 1e-12
"""A velocity below this fraction of the fastest is shown as none (rounding)."""


def _extent(t: Triple) -> float:
    return float(max(map(abs, t)))


def _without_rounding(t: Triple, least: float) -> Triple:
    """A twist without what rounding left of a rest or of a turning."""
    if _extent(t) <= least:
        return (0.0, 0.0, 0.0)
    return (t[0], t[1], 0.0 if abs(t[2]) <= least else t[2])


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
    links = list(case.links)
    against = {frozenset((load.link, power.reacting(case, load))) for load in case.loads}
    if not (want.centres or want.examine):
        loaded = {load.link for load in case.loads} | {case.ground}
        links = [link for link in links if link in loaded or any(link in pair for pair in against)]
    links.sort(key=lambda link: link_order(case, link))
    pairs = [(a, b) for n, a in enumerate(links) for b in links[n + 1 :]]
    if want.centres or want.examine:
        return pairs
    return [pair for pair in pairs if {*pair} <= loaded or frozenset(pair) in against]


def _notes(program: Program, outcome: Outcome) -> list[str]:
    """Sentences about the mechanism that a reader of the answer should know."""
    notes = [*program.case.noticed]
    motions, solution = outcome.motions, outcome.solution
    if motions.redundant and not motions.notes:
        notes.append(_redundancy(program, motions))
    if solution.idle and solution.values:
        count = sentences.plural(len(solution.idle), "passive freedom")
        ends = sentences.free_ends(program.top)
        notes.append(f"{count} in which no load does work{': ' if ends else ''}{ends}.")
    return notes


def _redundancy(program: Program, motions: Motions) -> str:
    """What becomes of a motion that redundant constraints allow in this position."""
    from icsolve.kinematics.second_order import goes_on

    bases = {k: tuple(map(floats, basis)) for k, basis in motions.bases.items()}
    return sentences.redundant(motions.redundant, goes_on(program.top, bases), program.want.bodies)


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
