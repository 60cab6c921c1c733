"""What of a scene does not depend on its numbers, and its evaluation in as many digits as its questions
need.

The program of a case (topology, plan, construction of the figure with its branches) is made once. It runs
on floats, on numbers that carry their error bound, on arrays of positions, and on balls of 30 digits. Where
these leave a question open (a sign, a zero, a pivot), or a number wider than a quarter of the last digit of
its double, it runs again with 60, then with 120. What that leaves open is refused as too near a singular
position. Each number is rounded once; its error is what that rounding did, and the radius of its ball.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Iterable
from functools import lru_cache, partial
from typing import TYPE_CHECKING

from icsolve.assembly import Figure, place, placed_figure, solve_figure
from icsolve.assembly.workspace import PlacedCase, case_places, data_of, names_of
from icsolve.case import Case, is_named
from icsolve.errors import SceneError, Status, refuse_overflow
from icsolve.kinematics import motion, speeds
from icsolve.numbers import FLOATS, Arithmetic, Scalar, Showing
from icsolve.numbers.balls import PRECISIONS, Balls, BelowZero, HalfUnits, MoreDigits
from icsolve.scene import refusals
from icsolve.screws import Triple
from icsolve.screws.joints import carried_round, points_of
from icsolve.statics import load_wrenches, power
from icsolve.statics.power import Bounded, Outcome, Value
from icsolve.structure import Topology, topology
from icsolve.structure.plan import Plan, make_plan
from icsolve.tuples import LateModule, NamedTuple, TypeVar

if TYPE_CHECKING:
    from icsolve.kinematics import accelerations
else:  # with inertia forces alone
    accelerations = LateModule("icsolve.kinematics.accelerations")


class HeldAt(NamedTuple):
    """With friction it is asked whether a load holds alone; of several freedoms not from where to where."""

    load: float


class Want(NamedTuple):
    """What is asked of a scene beside its unknown loads."""

    centres: bool = False
    rates: bool = False
    examine: bool = False
    bodies: bool = False
    """reactions or friction: the equilibrium of every link"""
    alone: bool | HeldAt = False
    """with friction the answer alone, not what is said of other solutions beside it"""

    @property
    def everything(self) -> bool:
        """Whether every link is to be solved."""
        return self.centres or self.rates or self.examine or self.bodies


class Program(NamedTuple):
    """A case with its topology, the plan for what is wanted, the construction of its figure, and what has
    its direction from two points."""

    case: Case
    want: Want
    top: Topology
    plan: Plan | None
    figure: Figure
    directions: refusals.Directions


@lru_cache(maxsize=32)
def prepare(case: Case, want: Want) -> Program:
    """The program of a case.

    Raises SceneError where a link is loose, the figure can't be constructed, or teeth do not fit.
    """
    top = topology(case)
    refusals.refuse_loose(case)
    if case.dynamic and load_wrenches.is_loaded(case):  # accelerations are those of all links together
        want = want._replace(rates=True)
    wanted = _wanted_bodies(case, top, want)
    plan = make_plan(top, wanted)
    if plan is not None and (case.ropes or not plan.closed):
        plan = None
    bonds = motion.needed_bonds(plan, top)
    figure = _figure(case, top, bonds, want)
    refusals.refuse_no_hanging(case, figure.points, figure.frame.scale)
    if case.rollings or any(bond.pivots for bond in top.bonds):
        from icsolve.assembly.wheels import noticed_of_wheels, refuse_misfit

        placed = case, figure.points, figure.frame.scale
        refuse_misfit(*placed)
        figure = figure._replace(notes=(*figure.notes, *noticed_of_wheels(*placed)))
    return Program(case, want, top, plan, figure, refusals.directions(case))


def without_plan(program: Program) -> Program:
    """The program that takes the loop equations of the whole scene at once."""
    bonds = motion.needed_bonds(None, program.top)
    return program._replace(plan=None, figure=_figure(program.case, program.top, bonds, program.want))


def _figure(case: Case, top: Topology, bonds: tuple[int, ...], want: Want) -> Figure:
    """The points that are needed, those whose velocities are told, and those that may be centres of wheels;
    of the others only those that the data place, for nothing hangs on them."""
    needed = needed_points(case, top, bonds, want)
    if want.examine:
        try:
            return solve_figure(case)
        except SceneError as refusal:
            if refusal.status != Status.UNDERDETERMINED:
                raise
        return placed_figure(case, names_of(case), needed)
    told = [p for link in case.links for p in speeds.moving_points(case, link)] if want.everything else []
    told += [p for joint in case.rollings for own in carried_round(joint, case) for p in own]
    return placed_figure(case, list(dict.fromkeys((*needed, *told))), needed)


def _wanted_bodies(case: Case, top: Topology, want: Want) -> frozenset[int]:
    """The bodies whose twists the answer needs: the frame and those that loads act on, or all.

    Where nothing is to be balanced, whether an unknown is zero or can have any value hangs on whether
    its link can move at all.
    """
    if want.everything or not any(map(power.has_number, case.loads)):
        return frozenset(range(len(top.members)))
    if case.ropes or case.screws:
        return frozenset(range(len(top.members)))
    return frozenset(top.body_of[link] for link in load_wrenches.moving_links(case))


def needed_points(case: Case, top: Topology, bonds: tuple[int, ...], want: Want) -> list[str]:
    """The points whose places the plan, the loads and the given motions need."""
    points = [p for k in bonds for p in points_of(top.bonds[k])]
    points += [p for load in case.loads for p in load_wrenches.points_of(load)]
    points += [given.point for given in case.motion if given.point is not None]
    points += [p for rope in case.ropes for p in rope.points]
    points += [p for screw in case.screws for p in (screw.slide.at, *(screw.slide.guide.ends or ()))]
    if case.dynamic:
        points += [mass.centre for mass in case.inertia.values() if mass.centre is not None]
    if want.bodies:
        points += [joint.at for joint in case.joints if joint.at is not None]
    needed = dict.fromkeys(points)
    return [*needed, *_measured_from(case, needed)]


def _measured_from(case: Case, needed: Container[str]) -> Iterable[str]:
    """The points by coordinates from which alone a datum places needed ones: whether these agree takes no
    step."""
    found: dict[str, None] = {}
    for datum in data_of(case):
        others = [p for p in datum.points if p not in needed]
        if 0 < len(others) < len(datum.points) and all(p in case.given_places for p in others):
            found |= dict.fromkeys(others)
    return found


def _placed(program: Program, arithmetic: Arithmetic) -> PlacedCase:
    """The case with its points; refused where two of them should give a direction and are one."""
    figure = program.figure
    points = figure.points if arithmetic is FLOATS else place(figure, program.case, arithmetic).points
    refusals.refuse_no_direction(program.directions, points, arithmetic)
    return PlacedCase(program.case, figure.frame, points, arithmetic)


def evaluate(program: Program, arithmetic: Arithmetic = FLOATS) -> tuple[Program, Outcome]:
    """Places, motions and unknown loads; the program that ran (without a plan where a group of it
    is singular in this position).

    Raises SceneError for a structure and for given centres that contradict each other.
    """
    # position
    place = _placed(program, arithmetic)
    # centres, which keep their weight: the twists of the links
    motions = None
    if program.plan is not None:
        motions = motion.by_plan(program.plan, place)
        if motions is None:
            return evaluate(without_plan(program), arithmetic)
    if motions is None:
        motions = motion.by_loops(place)
    motions = motion.with_ends(motions, place)
    # power
    case, wrenches = program.case, load_wrenches.wrenches(place)
    if case.dynamic and load_wrenches.is_loaded(case):
        moves = accelerations.moving(place, motions.twists, motions.slack)
        wrenches = load_wrenches.exactly(place, moves, wrenches)
    balance = power.balance(wrenches, motions.twists, motions.mobility)
    return program, Outcome(place, motions, balance, power.solve_balance(balance, arithmetic))


def evaluate_still(program: Program, arithmetic: Arithmetic = FLOATS) -> tuple[Program, Outcome]:
    """The same of a structure: its places, and the loads on it; nothing moves."""
    case, place = program.case, _placed(program, arithmetic)
    still = motion.Motions(dict.fromkeys((*case.links, case.ground), ()), {}, 0, 0, (), ())
    nothing = power.Balance(load_wrenches.wrenches(place), (), ())
    return program, Outcome(place, still, nothing, power.Solution("balanced", {}))


T = TypeVar("T")
Run = Callable[[Program, Showing], tuple[Program, Outcome]]
"""What evaluates a program: all of it, or its places alone."""


class Evaluation(NamedTuple):
    """A program that ran, its values, and the arithmetic in which it did."""

    program: Program
    outcome: Outcome
    arithmetic: Showing


class EvaluatedScene:
    """A program, evaluated in more digits as questions need them; ``certain`` False: in floats alone.

    What ``explained`` half units of the last digits of long numbers may make zero is zero.
    """

    def __init__(self, program: Program, certain: bool, explained: float = 0.0, run: Run = evaluate) -> None:
        self.program, self.certain, self.explained, self.run = program, certain, explained, run
        self._arithmetics: list[Callable[[], Showing]] = [lambda: FLOATS]
        if certain:
            self._arithmetics = (
                [lambda: HalfUnits(PRECISIONS[-1], count=explained)] if explained else _arithmetics(program)
            )
        self._found: list[Evaluation | None] = []

    def ask(self, question: Callable[[Evaluation], T]) -> T:
        """The answer to a question by the fewest digits that settle it.

        Raises SceneError where the scene has no answer, and where the highest precision leaves it open.
        """
        evaluated = self._found
        for k, arithmetic in enumerate(self._arithmetics):
            if k == len(evaluated):
                evaluated.append(self._evaluate(arithmetic()))
            if (found := evaluated[k]) is not None:
                try:
                    return question(found)
                except MoreDigits:
                    continue
        raise self.too_close()

    def _evaluate(self, arithmetic: Showing) -> Evaluation | None:
        """The program in one of the arithmetics; None where its digits do not suffice."""
        try:
            return Evaluation(*self.run(self.program, arithmetic), arithmetic)
        except MoreDigits:
            return None
        except (BelowZero, ZeroDivisionError):
            raise refusals.not_as_written() from None

    def too_close(self) -> SceneError:
        """The refusal of what the highest precision leaves open."""
        try:
            program, outcome = self.run(self.program, FLOATS)
        except (BelowZero, ZeroDivisionError):
            return refusals.not_as_written()
        unknown = next(iter(outcome.solution.values), "the answer")
        return refusals.too_close(program.top, outcome.motions, unknown, None)


MOST = 160
"""Digits that a chain may cost: with more, radii go beyond what floats hold."""


def _arithmetics(program: Program) -> list[Callable[[], Showing]]:
    """Balls of more and more digits, by as many more as a chain costs.

    Measured: a step that places a point costs some 1.1 digits, a group of the plan 0.1; of scissors by
    coordinates, each of whose stages hangs on the one before with both its bars, a link costs 0.4, which are
    spent only where fewer leave a question open.
    """
    spent = 1.2 * len(program.figure.steps) + (0.15 * len(program.plan.groups) if program.plan else 0.0)
    extra = max(round(spent) - 12, 0)
    unbounded = partial(Balls, PRECISIONS[1], highest=True, carried=0.0)
    if extra > MOST:
        return [unbounded]
    last, dear = PRECISIONS[-1], round(0.4 * len(program.top.members)) - 12
    few = PRECISIONS[0]  # what they leave open is mostly a zero, which only the most digits tell
    rungs: list[Callable[[], Showing]] = [partial(_balls, p + extra, p == last) for p in (few, last)]
    if dear > extra:
        rungs.append(partial(_balls, last + min(dear, MOST), True))
    if dear > MOST:
        rungs.append(unbounded)
    return rungs


KEPT = 4096
"""Numbers of cases whose decimals an arithmetic remembers, at most."""


def _balls(digits: int, highest: bool) -> Balls:
    """The arithmetic of so many digits, which remembers the numbers that it has read."""
    found = _made(digits, highest)
    for kept in (found.inputs, found.turns, found.floats):
        if len(kept) > KEPT:
            kept.clear()
    return found


@lru_cache(maxsize=16)
def _made(digits: int, highest: bool) -> Balls:
    return Balls(digits, highest)


def places_in(found: Evaluation) -> dict[str, tuple[Scalar, Scalar]]:
    """The points that have a name in the case, in case units and the arithmetic of the evaluation."""
    ox, oy, scale = found.program.figure.frame
    named = {name: at for name, at in found.outcome.points.items() if is_named(name)}
    return {name: (x / scale + ox, y / scale + oy) for name, (x, y) in named.items()}


def points_shown(
    found: Evaluation,
) -> tuple[dict[str, tuple[float, float]], dict[str, tuple[float, float]]]:
    """The points that have a name in the case, in case units, each coordinate rounded once; and bounds on
    their errors."""
    return case_places(found.program.figure.frame, found.outcome.points, found.arithmetic)


def unknown_values(found: Evaluation) -> dict[str, Value]:
    """The unknown loads by name, and those that are like them."""
    solution, values = found.outcome.solution, {}
    for w in found.outcome.balance.wrenches:
        if w.root in solution.values:
            exact = w.ratio * solution.values[w.root]
            value, error = found.arithmetic.rounded(exact)
            refuse_overflow(w.load.name, value)
            known = error < math.inf
            values[w.load.name] = Value(value, error if known else None, "" if known else UNASKED)
    return values


UNASKED = "no bound was asked for"


def evaluate_bounded(program: Program) -> Bounded:
    """Evaluate a program on a tape."""
    from icsolve.numbers.tape import Tape

    tape = Tape()
    return Bounded(evaluate(program, tape)[1], tape)


def slopes(scene: Bounded) -> dict[str, dict[str, float]]:
    """Derivative of every unknown load (and those like it) by every number of the case, by its path."""
    values = scene.outcome.solution.values
    return {
        w.load.name: scene.tape.back(w.ratio * values[w.root]).by_path  # how many times is a number too
        for w in scene.outcome.balance.wrenches
        if w.root in values
    }


def plain(outcome: Outcome) -> Outcome:
    """The outcome in floats, each number rounded once."""
    motions, balance = outcome.motions, outcome.balance
    twists = {link: tuple(map(floats, ts)) for link, ts in motions.twists.items()}
    wrenches = tuple(
        w._replace(unit=floats(w.unit), gain=float(w.gain), ratio=float(w.ratio)) for w in balance.wrenches
    )
    factors = tuple(tuple(map(float, row)) for row in balance.factors)
    points = {name: (float(x), float(y)) for name, (x, y) in outcome.points.items()}
    return outcome._replace(
        place=outcome.place._replace(points=points, arithmetic=FLOATS),
        motions=motions._replace(twists=twists),
        balance=balance._replace(wrenches=wrenches, factors=factors),
    )


def floats(t: Triple) -> Triple:
    """A triple off the tape."""
    return (float(t[0]), float(t[1]), float(t[2]))
