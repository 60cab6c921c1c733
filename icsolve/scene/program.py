"""What of a scene does not depend on its numbers, and its evaluation in any arithmetic.

The program of a case (topology, plan, construction of the figure with its branches) is made once.
It runs on floats, on numbers that carry their error bound, on arrays of positions, in more digits.
"""

from __future__ import annotations

from functools import lru_cache

from icsolve.assembly import Figure, place, placed_figure, solve_figure
from icsolve.assembly.data import names_of
from icsolve.case import Case
from icsolve.case.joints import Mesh
from icsolve.errors import SceneError, Status
from icsolve.kinematics import motion, speeds
from icsolve.numbers.arithmetic import FLOATS, Arithmetic
from icsolve.scene import refusals
from icsolve.screws.joints import Points
from icsolve.statics import power
from icsolve.statics.power import Outcome
from icsolve.structure.plan import Plan, make_plan
from icsolve.structure.topology import Topology, topology
from icsolve.tuples import NamedTuple


class Want(NamedTuple):
    """What is asked of a scene beside its unknown loads."""

    centres: bool = False
    rates: bool = False
    examine: bool = False
    bodies: bool = False
    """reactions or friction: the equilibrium of every link"""

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
    directions: tuple[tuple[str, tuple[str, str]], ...]


@lru_cache(maxsize=32)
def prepare(case: Case, want: Want) -> Program:
    """The program of a case.

    Raises SceneError where a link is loose, the figure can't be constructed, or teeth do not fit.
    """
    top = topology(case)
    refusals.refuse_loose(case, top)
    wanted = _wanted_bodies(case, top, want)
    plan = make_plan(top, wanted)
    if plan is not None and (case.ropes or not plan.closed):
        plan = None
    bonds = motion.needed_bonds(plan, top)
    figure = _figure(case, top, bonds, want)
    refusals.refuse_no_hanging(case, figure.points, figure.frame.scale)
    if any(isinstance(joint, Mesh) for joint in case.joints):
        from icsolve.assembly.residuals import refuse_misfit

        refuse_misfit(case, top, figure.points, figure.frame.scale)
    return Program(case, want, top, plan, figure, refusals.directions(case, top))


def without_plan(program: Program) -> Program:
    """The program that takes the loop equations of the whole scene at once."""
    bonds = motion.needed_bonds(None, program.top)
    return program._replace(plan=None, figure=_figure(program.case, program.top, bonds, program.want))


def _figure(case: Case, top: Topology, bonds: tuple[int, ...], want: Want) -> Figure:
    """The points that are needed, and those whose velocities are told; of the latter only those that the
    data place, for nothing hangs on the others."""
    needed = _wanted_points(case, top, bonds, want)
    if want.examine:
        try:
            return solve_figure(case)
        except SceneError as refusal:
            if refusal.status != Status.UNDERDETERMINED:
                raise
        return placed_figure(case, names_of(case), needed)
    told = [p for link in case.links for p in speeds.moving_points(case, link)] if want.everything else []
    return placed_figure(case, list(dict.fromkeys((*needed, *told))), needed)


def _wanted_bodies(case: Case, top: Topology, want: Want) -> frozenset[int]:
    """The bodies whose twists the answer needs: those that loads act on, or all.

    Where nothing is to be balanced, whether an unknown is zero or can have any value hangs on whether
    its link can move at all.
    """
    if want.everything or not any(map(power.has_number, case.loads)):
        return frozenset(range(len(top.members)))
    if case.ropes or case.screws:
        return frozenset(range(len(top.members)))
    links = {link for load in case.loads for link in (load.link, power.reacting(case, load))}
    links |= {given.link for given in case.motion}
    return frozenset(top.body_of[link] for link in links)


def _wanted_points(case: Case, top: Topology, bonds: tuple[int, ...], want: Want) -> list[str]:
    """The points whose places the plan, the loads and the given motions need."""
    points = motion.needed_points(bonds, top)
    points += [p for load in case.loads for p in power.points_of(load)]
    points += [given.point for given in case.motion if given.point is not None]
    points += [p for rope in case.ropes for p in rope.points]
    points += [p for screw in case.screws for p in (screw.slide.at, *(screw.slide.guide.ends or ()))]
    if want.bodies:
        points += [joint.at for joint in case.joints if joint.at is not None]
    return list(dict.fromkeys(points))


def _placed(program: Program, arithmetic: Arithmetic, rounds: int = 1) -> Points:
    """The points; refused where two of them should give a direction and are one."""
    figure = program.figure
    points = figure.points if arithmetic is FLOATS else place(figure, program.case, arithmetic, rounds).points
    refusals.refuse_no_direction(program.directions, points, arithmetic)
    return points


def evaluate(program: Program, arithmetic: Arithmetic = FLOATS, rounds: int = 1) -> tuple[Program, Outcome]:
    """Places, motions and unknown loads; the program that ran (without a plan where a group of it
    is singular in this position).

    Raises SceneError for a structure and for given centres that contradict each other.
    """
    figure, case, top = program.figure, program.case, program.top
    # position
    points = _placed(program, arithmetic, rounds)
    # centres, which keep their weight: the twists of the links
    motions = None
    if program.plan is not None:
        motions = motion.by_plan(program.plan, top, points, arithmetic)
        if motions is None:
            return evaluate(without_plan(program), arithmetic, rounds)
    if motions is None:
        motions = motion.by_loops(case, top, points, arithmetic, figure.frame)
    motions = motion.with_ends(motions, case, points, figure.frame.scale, arithmetic)
    # power
    wrenches = power.wrenches(case, figure.frame, points, arithmetic)
    if case.dynamic and case.inertia:
        from icsolve.statics.inertia import exactly, is_loaded

        if is_loaded(case):
            wrenches = exactly(case, top, figure.frame, points, motions.twists, wrenches, arithmetic)
    balance = power.balance(wrenches, motions.twists, motions.mobility)
    return program, Outcome(points, motions, balance, power.solve_balance(balance, arithmetic))


def evaluate_still(program: Program, arithmetic: Arithmetic = FLOATS) -> tuple[Program, Outcome]:
    """The same of a structure: its places, and the loads on it; nothing moves."""
    figure, case = program.figure, program.case
    points = _placed(program, arithmetic)
    still = motion.Motions(dict.fromkeys((*case.links, case.ground), ()), {}, 0, 0, (), ())
    loads = power.wrenches(case, figure.frame, points, arithmetic)
    return program, Outcome(points, still, power.Balance(loads, (), ()), power.Solution("balanced", {}))
