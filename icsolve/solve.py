"""The pipeline: a case, its figure, the motions that its joints allow, the sum of power, the answer.

1. topology: which links move as one, and the joints between them
2. plan: the groups of links that the wanted twists need, and no others
3. figure: the points that those groups and the loads need
4. motions: the twist of every planned link (a centre that keeps its weight)
5. power: the loads' wrenches on the twists give the unknown loads
6. centres and rates, as far as they are asked for
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from icsolve import motion, power, sentences, speeds
from icsolve.answer import Answer, Centre, Found, Term
from icsolve.arithmetic import FLOATS
from icsolve.case import Case, Pair
from icsolve.centres import CentreFinder, ordered_pair
from icsolve.errors import SceneError, Status
from icsolve.figure import Figure, case_point, solve_figure
from icsolve.plan import Plan, make_plan
from icsolve.plane import Triple
from icsolve.sense import sense_of, unit_of
from icsolve.topology import Topology, topology
from icsolve.twists import is_dead


class Want(NamedTuple):
    """What is asked of a scene."""

    centres: bool
    rates: bool
    examine: bool

    @property
    def everything(self) -> bool:
        """Whether every link is to be solved."""
        return self.centres or self.rates or self.examine


class Scene(NamedTuple):
    """A case in its position, with the motions that its joints allow."""

    case: Case
    top: Topology
    plan: Plan | None
    figure: Figure
    motions: motion.Motions


def solve(case: Case, *, all_centres: bool = False, rates: bool = False, examine: bool = False) -> Answer:
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

    Raises
    ------
    SceneError
        Where the scene has no answer; its ``status`` is a member of `icsolve.errors.Status`.
    """
    want = Want(all_centres, rates, examine)
    if not any(power.is_unknown(load) for load in case.loads):
        want = Want(True, True, examine)
    refuse_friction(case)
    scene = set_scene(case, want)
    balance, solution = balanced(scene)
    speed = speeds.speed_of(case, scene.motions.twists, scene.figure.frame, scene.figure.points)
    return answer(scene, want, balance, solution, speed)


def set_scene(case: Case, want: Want) -> Scene:
    """Topology, plan, figure and motions of a case."""
    top = topology(case)
    wanted = wanted_bodies(case, top, want)
    plan = make_plan(top, wanted)
    refuse_loose(case, top)
    bonds = motion.needed_bonds(plan, top)
    figure = solve_figure(case, None if want.examine else wanted_points(case, top, bonds, want))
    if plan is not None and plan.closed:
        found = motion.by_plan(plan, top, figure.points, FLOATS)
        if found is not None:
            return Scene(case, top, plan, figure, found)
        figure = solve_figure(case, None)
    found = motion.by_loops(case, top, figure.points, FLOATS, figure.frame)
    return Scene(case, top, None, figure, found)


def wanted_bodies(case: Case, top: Topology, want: Want) -> frozenset[int]:
    """The bodies whose twists the answer needs: those that loads act on, or all."""
    if want.everything:
        return frozenset(range(len(top.members)))
    links = {link for load in case.loads for link in (load.link, reacting(case, load))}
    return frozenset(top.body_of[link] for link in links)


def reacting(case: Case, load: object) -> str:
    """The link that takes the opposite of a load."""
    return getattr(load, "against", None) or case.ground


def wanted_points(case: Case, top: Topology, bonds: tuple[int, ...], want: Want) -> list[str]:
    """The points whose places the plan, the loads and the given motions need."""
    points = motion.needed_points(bonds, top)
    points += [p for load in case.loads for p in power.points_of(load)]
    points += [given.point for given in case.motion if given.point is not None]
    if want.rates or want.centres:
        points += [p for carried in case.carries.values() for p in carried]
    return list(dict.fromkeys(points))


def refuse_loose(case: Case, top: Topology) -> None:
    """Refuse links that no chain of joints ties to the frame."""
    seen, stack = {top.ground}, [top.ground]
    while stack:
        for k in top.at[stack.pop()]:
            for body in (top.bonds[k].a, top.bonds[k].b):
                if body not in seen:
                    seen.add(body)
                    stack.append(body)
    names = [link for body, links in enumerate(top.members) if body not in seen for link in links]
    if names:
        raise SceneError(Status.LOOSE, sentences.loose(case, names))


def refuse_friction(case: Case) -> None:
    """Refuse joints with friction until free bodies are solved: an answer without it would be wrong."""
    for joint in case.joints:
        friction = getattr(joint, "friction", None)
        if friction is not None and friction.mu.value > 0:
            raise SceneError(
                Status.UNSUPPORTED,
                f"the joint of links {' and '.join(joint.links)} has friction (mu {friction.mu.digits}), which is not "
                "solved yet. Take out `mu` to solve without friction.",
            )


def balanced(scene: Scene) -> tuple[power.Balance, power.Solution]:
    """The sum of power over all loads, and the unknown loads that make it zero.

    Raises SceneError where no value balances, any value does, or the unknowns do not match the
    mobility.
    """
    case, motions = scene.case, scene.motions
    all_wrenches = power.wrenches(case, scene.figure.frame, scene.figure.points, FLOATS)
    balance = power.balance(all_wrenches, motions.twists, motions.mobility)
    solution = power.solve_balance(balance, FLOATS)
    unknowns = [load for load in case.loads if power.is_unknown(load)]
    if solution.verdict != "balanced" and unknowns:
        raise refusal(scene, balance, solution, len(unknowns))
    return balance, solution


def refusal(scene: Scene, balance: power.Balance, solution: power.Solution, unknowns: int) -> SceneError:
    """Why the unknown loads have no value."""
    motions, top = scene.motions, scene.top
    active = motions.mobility - len(solution.idle)
    if solution.verdict in ("too few unknowns", "too many unknowns") or unknowns > max(active, 1):
        if motions.redundant and top.freedoms_by_count == unknowns:
            message = sentences.change_point(motions.mobility, top.freedoms_by_count, motions.twists)
            return SceneError(Status.CHANGE_POINT, message)
        message = sentences.wrong_count(motions.mobility, unknowns, len(solution.idle))
        return SceneError(Status.MOBILITY, message)
    return no_work(scene, balance, solution)


def no_work(scene: Scene, balance: power.Balance, solution: power.Solution) -> SceneError:
    """An unknown that does no work: a dead centre, no value, or any value."""
    culprit = next(w for w in balance.wrenches if w.load.name == solution.culprit)
    motions = scene.motions
    largest = max(max(map(abs, t)) for ts in motions.twists.values() for t in ts)
    on, off = motions.twists[culprit.load.link], motions.twists[culprit.against]
    apart = max(abs(x - y) for a, b in zip(on, off, strict=True) for x, y in zip(a, b, strict=True))
    at_rest = apart <= 1e-13 * largest
    others = solution.verdict == "no value"
    clause = sentences.points_in_line(motions.closures, scene.top, map(is_dead, motions.closures))
    message = sentences.workless(culprit.load.name, culprit.load.link, at_rest, others, clause)
    status = Status.DEAD_CENTRE if at_rest and others else Status.NO_VALUE if others else Status.ANY_VALUE
    return SceneError(status, message)


def answer(
    scene: Scene, want: Want, balance: power.Balance, solution: power.Solution, speed: speeds.Speed
) -> Answer:
    """The answer as frozen values."""
    case, figure, motions = scene.case, scene.figure, scene.motions
    values = load_values(balance, solution)
    terms = tuple(power_terms(scene, balance, values, speed))
    found = {
        w.load.name: Found(values[w.load.name], unit_of(w.load, case), sense_of(w, values[w.load.name]))
        for w in balance.wrenches
        if w.root in solution.values
    }
    link_rates = speeds.link_rates(case, motions.twists, speed) if want.rates else None
    velocities = None
    if want.rates:
        velocities = speeds.point_velocities(case, motions.twists, speed, figure.frame, figure.points)
    return Answer(
        case=case,
        answers=found,
        centres=centres(scene, want, speed),
        rates=link_rates,
        velocities=velocities,
        points={n: case_point(figure.frame, p) for n, p in figure.points.items() if not n.startswith("@")},
        terms=terms,
        advantage=advantage(balance, values, solution),
        mobility=motions.mobility,
        notes=(*figure.notes, *motions.notes, *scene_notes(scene, solution)),
        skipped=skipped(scene),
        steps=step_names(scene),
    )


def load_values(balance: power.Balance, solution: power.Solution) -> dict[str, float]:
    """The number of every load, known or found, in its own unit."""
    values = {}
    for w in balance.wrenches:
        known = power.known_value(w, balance)
        value = solution.values.get(w.root, 0.0) if known is None else known
        values[w.load.name] = w.ratio * value + 0.0
    return values


def power_terms(
    scene: Scene, balance: power.Balance, values: dict[str, float], speed: speeds.Speed
) -> Iterable[Term]:
    """One term a load, for the motion that is printed."""
    unknown = {w.load.name for w in balance.wrenches if power.known_value(w, balance) is None}
    for n, w in enumerate(balance.wrenches):
        name, case = w.load.name, scene.case
        row = [balance.factors[m][n] for m in range(scene.motions.mobility)]
        scale = max(balance.sizes[m][n] for m in range(scene.motions.mobility))
        factor = (speed.of(row, scale) or 0.0) / scene.figure.frame.scale
        at = getattr(w.load, "at", "@")
        where = f"{name} on link {w.load.link}" + ("" if at.startswith("@") else f" at {at}")
        if w.against != case.ground:
            where += f" against link {w.against}"
        unit = unit_of(w.load, case) if name in values else ""
        yield Term(name, w.load.link, values[name], unit, factor, values[name] * factor, name in unknown, where)


def advantage(balance: power.Balance, values: dict[str, float], solution: power.Solution) -> float | None:
    """unknown / known where there is one of each and the known one is not zero."""
    found = [w.load.name for w in balance.wrenches if w.root in solution.values]
    known = [w.load.name for w in balance.wrenches if w.root not in solution.values]
    if len(found) != 1 or len(known) != 1 or values[known[0]] == 0.0:
        return None
    return values[found[0]] / values[known[0]]


def centres(scene: Scene, want: Want, speed: speeds.Speed) -> dict[Pair, Centre]:
    """The centres that are asked for: all, or those of the loaded links."""
    case, motions = scene.case, scene.motions
    given = bool(case.motion)
    twists = {link: speeds.meant(motions.twists, speed, link) if given else ts for link, ts in motions.twists.items()}
    finder = CentreFinder(case, scene.top, twists, scene.figure.frame, scene.figure.points, FLOATS)
    slack = 2e-3 if motions.notes else 0.0
    return finder.find(wanted_pairs(case, want), slack)


def wanted_pairs(case: Case, want: Want) -> list[Pair]:
    """Pairs of links whose centres are asked for, in order."""
    if want.centres or want.examine:
        links = sorted(case.links, key=lambda link: (not link.isdigit(), int(link) if link.isdigit() else 0))
        if not all(link.isdigit() for link in links):
            links = list(case.links)
        return [(a, b) for n, a in enumerate(links) for b in links[n + 1 :]]
    loaded = list(dict.fromkeys(load.link for load in case.loads if load.link != case.ground))
    pairs = [(load.link, reacting(case, load)) for load in case.loads]
    pairs += [(a, case.ground) for a in loaded]
    pairs += [(a, b) for n, a in enumerate(loaded) for b in loaded[n + 1 :]]
    return list(dict.fromkeys(ordered_pair(case, a, b) for a, b in pairs if a != b))


def scene_notes(scene: Scene, solution: power.Solution) -> list[str]:
    """Sentences about the mechanism that a reader of the answer should know."""
    notes = []
    if scene.motions.redundant:
        count = sentences.plural(scene.motions.redundant, "redundant constraint")
        notes.append(f"the joints have {count}: they move freely only because the figure is exact.")
    if solution.idle and solution.values:
        count = sentences.plural(len(solution.idle), "passive freedom")
        notes.append(f"{count} in which no load does work.")
    return notes


def skipped(scene: Scene) -> tuple[str, ...]:
    """What was not examined because the answer does not need it."""
    left = [link for link in scene.case.links if link not in scene.motions.twists]
    names = (f"links {sentences.listed(left)}",) if len(left) > 1 else tuple(f"link {link}" for link in left)
    return (*names, *scene.figure.skipped)


def step_names(scene: Scene) -> tuple[str, ...]:
    """The steps of the plan that ran."""
    figure = tuple(str(getattr(step, "name", step)) for step in scene.figure.steps)
    if scene.plan is None:
        return (*figure, "motions: loop equations of the whole scene")
    entry = scene.top.bonds[scene.plan.entry]
    names = [f"motions: virtual input {entry.links[0]}-{entry.links[1]}"]
    for group in scene.plan.groups:
        links = [scene.top.members[body][0] for body in group.bodies]
        names.append(f"motions: links {sentences.listed(links)}")
    return (*figure, *names)
