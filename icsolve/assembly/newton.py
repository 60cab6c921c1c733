"""Newton's method for a group of points: many starts, every solution found once, the nearest first.

The first start is `near` itself. Others come from the construction that holds points where `near` puts
them (and about there), with all of its branches, and from points spread evenly about the group. Each solution
is polished to full precision.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from functools import lru_cache
from itertools import islice, product
from typing import TYPE_CHECKING

from icsolve.assembly.clusters import LooseFigure
from icsolve.assembly.refusals import datum_words, measure, plain
from icsolve.assembly.steps import Given, Meet, Miss, PointGroup, Step, needs, newton_step
from icsolve.assembly.workspace import CORNER, LENGTH, LINE, ROPE, Frame, Key, Workspace, data_in, facts_of
from icsolve.case import Case, Centroid, Coordinates, Corner, Direction, Joint, Length, Rope, Units
from icsolve.errors import SceneError, Status
from icsolve.numbers import FLOATS
from icsolve.numbers.linear import inverse
from icsolve.tuples import NamedTuple
from icsolve.wording import listed

if TYPE_CHECKING:
    from icsolve.numbers.quadratics import Array, Quadratics

Spot = tuple[float, float]
Start = dict[str, Spot]

MOST_STEPS = 18
MOST_NEAR_STEPS = 60
"""Steps from `near` itself, which is worth more patience than other starts."""
MOST_DOWNHILL = 200
"""Steps to where data are violated least: beside a fold the valley is flat and bent."""
LARGEST = 1e100
"""Of data that miss by more squares are beyond all doubles."""
BENT = 0.75
"""A step down a valley bends by less than this part of it."""
LONGEST_STEP = 0.4
"""Longest move of a coordinate in one step, over the group's size."""
CLOSED = 1e-9
"""Residual, over the square of the group's size, below which a start has arrived, before polishing."""
FLAT = 1e-11
"""Smallest over largest pivot of a solution that stands alone."""
HALVED = 0.75
"""Steps that close in on a solution are shorter than this of the one before, those on a double one too."""
ARRIVED = 1e-4
"""What was found lies nearer to a solution than this [frame of size 1]: a longer step is one from between
two."""
MISSED = 1e-13
"""Residual [frame of size 1] above which what was arrived at is no solution: of a smaller one the decimals
tell."""
ONE = 3e-8
"""Solutions nearer than this, over their distance and the group's size, are one: so far apart are the two
beside a fold where doubles no longer tell that there are two."""
MOST_BRANCHES = 64
SPREAD = 16
TOGETHER = 64
"""Starts from which one descends at once."""
MOST_WORK = 250_000
"""Steps times the square of the number of equations, over all starts but `near` itself."""
MOST_BOXES = 600_000
"""Of a search for every solution, by exclusion of boxes."""
BOX_WORK = 250_000
"""Boxes times the square of the number of equations, in a search about one solution."""
FEW = 5
"""Points of the largest group of which every solution is looked for."""
CLEARLY = 1.02
"""A solution that is so many times as far from `near` as another is no rival of it (`walk.EVEN`)."""
CLOSE_WORK = 60_000
"""The same once a solution was found from `near` itself, and the starts about it were tried."""


def every(group: PointGroup, workspace: Workspace) -> Converged:
    """Every solution of a group, by exclusion; ``complete`` where they are shown to be all."""
    if any(equation.datum.kind == ROPE for equation in group.equations):
        raise SceneError(Status.UNSUPPORTED, ROPED)
    from icsolve.assembly.exclusion import every_solution

    found = every_solution(group, workspace, MOST_BOXES)
    if found.movable:
        return Converged([], Miss(Status.UNDERDETERMINED, _of(group, MOVABLE)), {}, False)
    groups = [group._replace(start=tuple(place[t] for t in group.targets)) for place in found.places]
    miss = None if groups else _unreached(group, workspace, {})
    return Converged(groups, miss, {}, found.complete)


ROPED = (
    "the length of a rope and other data place points only together, and no search for every way in which "
    "that can be is complete. Give `near` for one of them."
)


class Converged(NamedTuple):
    """What a search for the solutions of a group found: the nearest to `near` first.

    ``miss`` says why there is none, or that the data are not met at ``closest``, where they are violated
    least downhill from `near`: a way that does not assemble, which may be nearer than those that do.
    ``complete`` where it is shown that no other solution is nearer to `near`.
    """

    groups: list[PointGroup]
    miss: Miss | None
    closest: Start
    complete: bool


class Descent(NamedTuple):
    """Where Newton steps led: the residual, the points, and how many steps there were."""

    off: float
    end: Start
    steps: int


def solutions(group: PointGroup, workspace: Workspace, near: Mapping[str, Spot]) -> Converged:
    """The solutions found of a group: from `near` itself first, then from other starts."""
    known = ((key, place) for key, place in workspace.points.items() if key not in group.targets)
    case = workspace.case
    figure = (tuple(case.points.items()), case.lengths, case.angles, case.joints, case.ropes, case.units)
    return _searched(group, figure, workspace.frame, tuple(known), tuple(near.items()))


FigureData = tuple[
    tuple[tuple[str, Coordinates | Centroid], ...],
    tuple[Length, ...],
    tuple[Direction | Corner, ...],
    tuple[Joint, ...],
    tuple[Rope, ...],
    Units,
]
"""Points, lengths, angles, joints, ropes and units of a case: all that a search may look at."""


@lru_cache(maxsize=512)
def _searched(
    group: PointGroup,
    figure: FigureData,
    frame: Frame,
    known: tuple[tuple[Key, Spot], ...],
    about: tuple[tuple[str, Spot], ...],
) -> Converged:
    """The same, kept: a figure is placed for its loads, its points and its pictures, also where it fails, and
    is the same figure whatever its loads are."""
    points, lengths, angles, joints, ropes, units = figure
    case = Case(points=dict(points), lengths=lengths, angles=angles, joints=joints, ropes=ropes, units=units)
    workspace, near = Workspace(case, frame, FLOATS), dict(about)
    workspace.points.update(known)
    if not any(p in near for p in group.targets):
        return Converged([], _vague(Status.AMBIGUOUS, _of(group, NEEDS_NEAR)), {}, False)
    search = _NewtonSearch(group, workspace, near)
    search.run()
    search.found.sort(key=lambda end: search.off(end.places))
    polished = [_polished(group, end) for end in search.found]
    settled = [option for option in polished if option is not None]
    if settled and polished[0] is not None:
        if not search.beside:
            return Converged(settled, None, {}, search.complete)
        return Converged(settled, _unreached(group, workspace, search.beside), search.beside, False)
    if polished:
        return Converged([], _vague(Status.NEAR_SINGULAR, _of(group, FLAT_THERE)), {}, False)
    spent = _vague(Status.AMBIGUOUS, _of(group, UNFINISHED)) if search.spent else None
    miss = spent or _unreached(group, workspace, search.closest.end)
    return Converged([], miss, search.beside, False)


class _NewtonSearch:
    """Starts one after another, until it is shown that nothing nearer is left, or the work is spent."""

    def __init__(self, group: PointGroup, workspace: Workspace, near: Mapping[str, Spot]) -> None:
        self.group, self.workspace, self.near = group, workspace, near
        lengths = (workspace.length(d) for d in data_in(group) if d.kind == LENGTH)
        self.reach: float = max(lengths, default=0.0) or 1.0
        """the size of the group: its longest length"""
        self.found: list[Settled] = []
        self.closest = Descent(math.inf, {}, 0)
        self.beside: Start = {}
        self.complete = self.spent = False

    def run(self) -> None:
        """Try `near` itself, then the others."""
        held = {t: self.near[t] for t in self.group.targets if t in self.near}
        if len(held) == len(self.group.targets):
            self._try(held, MOST_NEAR_STEPS)
            if self.found and _alone(self.group, self.workspace, held, self.found[0].places):
                self.complete = True
                return
            with suppress(SceneError):
                self.beside = _least_residual(self.group, self.workspace, held, self.reach)
                if self.beside and self._meets(self.beside):
                    self.beside = {}
        self.complete = self._excluded()
        if self.complete and (self.found or self.closest.end):
            return  # else starts tell where the data come closest to being met
        work, most = 0, CLOSE_WORK if self.found else MOST_WORK
        for tried, descent in enumerate(self._descents(self._starts(list(held)))):
            self._keep(descent)
            work += descent.steps * len(self.group.equations) ** 2
            if work > most and not (self.found and tried < SPREAD // 2):
                self.spent = not self.complete
                return

    def _try(self, start: Start, most: int) -> Descent:
        """Descend from a start; what was found is kept."""
        try:
            descent = _descend(self.group, self.workspace, start, self.reach, most)
        except SceneError:  # on the way no rope can be laid
            return Descent(math.inf, start, most)
        self._keep(descent)
        return descent

    def _descents(self, starts: Iterator[Start]) -> Iterator[Descent]:
        """Descents from starts, many at once; one by one where a rope is laid."""
        if any(equation.datum.kind == ROPE for equation in self.group.equations):
            yield from (self._try(start, MOST_STEPS) for start in starts)
            return
        system = None
        while some := list(islice(starts, TOGETHER)):
            if system is None:
                from icsolve.assembly.exclusion import quadratics_of

                system = quadratics_of(self.group, self.workspace)
            yield from _descend_together(system, some, self.reach)

    def _keep(self, descent: Descent) -> None:
        """Keep a new solution, or where the data were violated least."""
        if descent.off > CLOSED * self.reach * self.reach:
            self.closest = min(self.closest, descent, key=lambda each: each.off)
            return
        settled = _settled(self.group, self.workspace, descent.end)
        if settled.off > MISSED:
            self.closest = min(self.closest, descent, key=lambda each: each.off)
        elif not any(_same(settled.places, other.places, self.reach) for other in self.found):
            self.found.append(settled)

    def _meets(self, lowest: Start) -> bool:
        """Whether the data are met where their residual is least: there, or about as far from it as the two
        places that are to be expected beside a fold."""
        away = ARRIVED * self.reach
        for start in (lowest, *_pair(self.group, self.workspace, lowest, self.reach)):
            self._try(start, MOST_STEPS)
            away = max(away, *(2.0 * math.dist(start[t], lowest[t]) for t in start))
        return any(all(math.dist(end.places[t], lowest[t]) <= away for t in lowest) for end in self.found)

    def _excluded(self) -> bool:
        """Whether it is shown that all solutions are found, or all that are no farther from `near` than
        one of them."""
        group, near = self.group, {t: self.near[t] for t in self.group.targets if t in self.near}
        if any(equation.datum.kind == ROPE for equation in group.equations):
            return False
        from icsolve.assembly.exclusion import every_solution

        most = BOX_WORK // len(group.equations) ** 2
        radii = [math.inf] if len(group.targets) <= FEW else []
        radii += [CLEARLY * min(self.off(end.places) for end in self.found)] if self.found else []
        for radius in radii:
            shown = every_solution(group, self.workspace, most, near, radius)
            for place in shown.places:
                self._keep(Descent(0.0, place, 0))
            if shown.complete:
                return True
        return False

    def off(self, end: Start) -> float:
        """How far from `near` a place is: the root of the sum of squares."""
        return math.hypot(*(math.dist(end[t], self.near[t]) for t in end if t in self.near))

    def _starts(self, held: list[str]) -> Iterator[Start]:
        group, near = self.group, self.near
        for end in list(self.found):
            with suppress(SceneError):
                yield from _pair(group, self.workspace, end.places, self.reach)
        if self.found:
            yield from _about(near, self.found[0].places)
        if held:
            yield from _constructed(group, self.workspace, near, held, self.reach)
        for point in held[:2] if len(held) > 1 else ():
            yield from _constructed(group, self.workspace, near, [point], self.reach)
        for k in range(1, SPREAD + 1):
            yield {target: even(k, j, near[held[0]], self.reach) for j, target in enumerate(group.targets)}


def _about(near: Mapping[str, Spot], end: Start) -> Iterator[Start]:
    """Starts within the ball about `near` that has a solution on its rim: a nearer one lies inside."""
    held = [t for t in end if t in near]
    yield {
        t: (2.0 * near[t][0] - x, 2.0 * near[t][1] - y) if t in near else (x, y) for t, (x, y) in end.items()
    }
    radius = max(math.dist(near[t], end[t]) for t in held)
    for k in range(1, SPREAD // 2 + 1):
        yield {t: even(k, j, near.get(t, end[t]), radius) for j, t in enumerate(end)}


def _pair(group: PointGroup, workspace: Workspace, end: Start, reach: float) -> list[Start]:
    """Where two solutions that lie close together are to be expected, from a place near them or from one of
    the two; none beyond a fold.

    The equations F change least along v, the singular vector of their smallest singular value, and by that
    along u. There u F is a parabola nearly, for the data are squares of distances: it is laid through three
    of its values.
    """
    import numpy as np

    values, slopes = _system(group, workspace, end)
    left, _, right = np.linalg.svd(slopes)
    u, v = left[:, -1].tolist(), right[-1].tolist()
    step = max(BESIDE * reach, math.sqrt(np.linalg.norm(values)))
    along = []
    for way in (-step, 0.0, step):
        workspace.points.update(_moved(end, v, -way))
        along.append(sum(w * f for w, f in zip(u, group.system(workspace)[0], strict=True)))
    before, here, after = along
    slope, bend = (after - before) / 2.0, (after + before) / 2.0 - here
    inside = slope * slope - 4.0 * bend * here
    if not (inside >= 0.0 and bend):
        return []
    return [_moved(end, v, step * (slope + way * math.sqrt(inside)) / (2.0 * bend)) for way in (1.0, -1.0)]


BESIDE = 1e-3
"""How far aside, over a group's size, values are taken from which two solutions close together are told."""


def even(k: int, j: int, about: Spot, reach: float) -> Spot:
    """The k-th of places spread evenly over a square about one, `reach` to each side: multiples of irrational
    numbers, modulo one, others for each ``j``."""
    u, v = (math.fmod(k * math.sqrt(n + 8 * j), 1.0) for n in (3, 5))
    return about[0] + (2.0 * u - 1.0) * reach, about[1] + (2.0 * v - 1.0) * reach


STEEPEST = {LENGTH: 2.0, CORNER: 4.0, LINE: 4.0, ROPE: math.inf}
"""How fast the derivatives of a datum's equation change at most, per move of one of its points."""
MOST_SHOWN = 100
"""Equations of the largest group for which an inverse is taken."""


def _alone(group: PointGroup, workspace: Workspace, near: Start, end: Start) -> bool:
    """Whether it is shown that no other solution is as near to `near` as one that was found.

    All points have a `near`. With Y the inverse of the derivatives J at `near`, there is at most one solution
    in a ball where |Y (J(x) - J)| < 1: the mean of J between two solutions would be singular else.
    """
    if len(group.equations) > MOST_SHOWN:
        return False
    workspace.points.update(near)
    _, rows = group.system(workspace)
    inverted = inverse([[row.get(k, 0.0) for k in range(len(rows))] for row in rows])
    if inverted is None:
        return False
    radius = math.hypot(*(math.dist(near[t], end[t]) for t in near)) * (1.0 + 1e-9)
    squares = dict.fromkeys(group.targets, 0.0)
    for equation in group.equations:
        share = STEEPEST.get(equation.datum.kind, 0.0)
        for p in {*equation.datum.points} & squares.keys():
            squares[p] += share * share
    change = math.sqrt(max(squares.values())) * radius
    return math.sqrt(sum(v * v for row in inverted for v in row)) * change < 1.0


def _least_residual(group: PointGroup, workspace: Workspace, start: Start, reach: float) -> Start:
    """Where the data of a group are violated least, downhill from a start.

    By damped steps of least squares (Levenberg and Marquardt) that bend with the valley: the data are squares
    of distances, so what a step leaves is their second derivative along it, and half of what mends that is
    added (M. K. Transtrum and J. P. Sethna, arXiv:1201.5885, 2012).
    """
    if len(group.unknowns()) > MOST_SHOWN:
        return {}
    import numpy as np

    at, held = start, np.eye(len(group.unknowns()))
    damping, least, most = (share * reach * reach for share in (1e-1, 1e-16, 1e6))
    values, slopes = _system(group, workspace, at)
    if math.hypot(*values, *slopes.flat) > LARGEST:
        return {}
    for _ in range(MOST_DOWNHILL):
        off, normal = np.linalg.norm(values), slopes.T @ slopes + damping * held
        move = np.linalg.solve(normal, slopes.T @ values)
        left = _system(group, workspace, _moved(at, move.tolist(), 1.0))[0] - values + slopes @ move
        bend = np.linalg.solve(normal, slopes.T @ left)
        after = _moved(at, (move + bend).tolist(), 1.0)
        values_after, slopes_after = _system(group, workspace, after)
        gain = off - np.linalg.norm(values_after)
        if gain > 0.0 and np.linalg.norm(bend) <= BENT * np.linalg.norm(move):
            at, values, slopes, damping = after, values_after, slopes_after, max(damping / 5.0, least)
            if gain < 1e-9 * off:
                break
        else:
            damping *= 5.0
            if damping > most:
                break
    return at


def _system(group: PointGroup, workspace: Workspace, at: Start) -> tuple[Array, Array]:
    """How far a group's data are from being met at its places, (n,), and the derivatives of that, (n, n)."""
    import numpy as np

    workspace.points.update(at)
    values, rows = group.system(workspace)
    return np.array(values), np.array([[row.get(k, 0.0) for k in range(len(rows))] for row in rows])


def _same(one: Start, two: Start, reach: float) -> bool:
    return all(math.dist(one[t], two[t]) <= ONE * (reach + math.hypot(*one[t])) for t in one)


def _descend(group: PointGroup, workspace: Workspace, start: Start, reach: float, most: int) -> Descent:
    """Newton steps of limited length from a start: the residual reached, where, and after how many.

    Without a line search: measured on random groups, a search triples the time and ends in
    local minima as often as the plain steps wander off.
    """
    workspace.points.update(start)
    off, taken = math.inf, 0
    while taken < most:
        taken += 1
        values, rows = group.system(workspace)
        off = math.hypot(*values)
        if not math.isfinite(off):
            return Descent(math.inf, start, taken)
        if off <= CLOSED * reach * reach:
            break
        move = newton_step(values, rows).move
        longest = max(map(abs, move))
        fraction = min(1.0, LONGEST_STEP * reach / longest) if longest > 0.0 else 0.0
        workspace.points.update(_moved(_places(group, workspace), move, fraction))
    return Descent(off, _places(group, workspace), taken)


def _descend_together(system: Quadratics, starts: Sequence[Start], reach: float) -> Iterator[Descent]:
    """The same as `_descend` from many starts at once, by `MOST_STEPS` steps at most."""
    import numpy as np

    at = np.array([[part for place in start.values() for part in place] for start in starts])
    off, taken, going = np.full(len(at), math.inf), np.zeros(len(at), int), np.arange(len(at))
    for _ in range(MOST_STEPS):
        values, slopes = system.at(at[going])
        taken[going] += 1
        off[going] = np.nan_to_num(np.linalg.norm(values, axis=1), nan=math.inf)
        left = np.isfinite(off[going]) & (off[going] > CLOSED * reach * reach)
        going, values, slopes = going[left], values[left], slopes[left]
        if not len(going):
            break
        try:
            move = np.linalg.solve(slopes, values[..., None])[..., 0]
        except np.linalg.LinAlgError:
            both = zip(slopes, values, strict=True)
            move = np.array([np.linalg.lstsq(slope, value, rcond=None)[0] for slope, value in both])
        longest = np.abs(move).max(axis=1, keepdims=True)
        at[going] -= move * np.minimum(1.0, LONGEST_STEP * reach / np.maximum(longest, LONGEST_STEP * reach))
    for place, residual, steps, start in zip(at.tolist(), off.tolist(), taken.tolist(), starts, strict=True):
        end = dict(zip(start, zip(place[::2], place[1::2], strict=True), strict=True))
        yield Descent(residual, end, steps)


def _places(group: PointGroup, workspace: Workspace) -> Start:
    return {t: workspace.points[t] for t in group.targets}


def _moved(at: Start, move: Sequence[float], fraction: float) -> Start:
    """Places, in the order of the group's targets, less a fraction of a step."""
    return {
        t: (x - fraction * move[2 * k], y - fraction * move[2 * k + 1])
        for k, (t, (x, y)) in enumerate(at.items())
    }


class Settled(NamedTuple):
    """Where Newton's method settles: the places with the least residual, this, and the flatness there."""

    places: Start
    off: float
    flatness: float


def _settled(group: PointGroup, workspace: Workspace, end: Start) -> Settled:
    """Newton's method in full precision, while it closes in: where two solutions lie close together its steps
    at least halve, and where there is none beyond a fold they grow again."""
    workspace.points.update(end)
    found, last = Settled(end, math.inf, 0.0), math.inf
    for _ in range(MOST_NEAR_STEPS):
        values, rows = group.system(workspace)
        step, off, places = newton_step(values, rows), math.hypot(*values), _places(group, workspace)
        if off <= found.off:
            found = Settled(places, off, step.flatness)
        longest = max(map(abs, step.move))
        if not 0.0 < longest < HALVED * last:
            break
        last = longest
        workspace.points.update(_moved(places, step.move, min(1.0, ARRIVED / longest)))
    return found


def _polished(group: PointGroup, settled: Settled) -> PointGroup | None:
    """The group on a solution that was settled on; None where that does not stand alone."""
    return None if settled.flatness < FLAT else group._replace(start=tuple(settled.places.values()))


def _constructed(
    group: PointGroup, workspace: Workspace, near: Mapping[str, Spot], held: list[str], reach: float
) -> Iterator[Start]:
    """Starts by closed forms, with points held where `near` puts them, one of them also about there."""
    drawing = LooseFigure(facts_of(workspace.case, data_in(group)), frozenset())
    ground = drawing.ground
    ground.begin([p for p in needs(group) if isinstance(p, str)] + held)
    ground.run(set(group.targets))
    forks = [i for i, step in enumerate(drawing.steps) if isinstance(step, Meet) and step.sign]
    point, places = held[0], {p: near[p] for p in held}
    (x, y), r = near[point], 0.1 * reach
    ring = [(x, y), (x + r, y), (x, y + r), (x - r, y), (x, y - r)] if len(held) == 1 else [(x, y)]
    for spot in ring:
        for signs in islice(product((1, -1), repeat=len(forks)), MOST_BRANCHES):
            start = _run(
                drawing.steps, dict(zip(forks, signs, strict=True)), workspace, places | {point: spot}
            )
            if start is not None:
                yield {t: start.get(t, near.get(t, spot)) for t in group.targets}


def _run(steps: list[Step], signs: dict[int, int], workspace: Workspace, held: Start) -> Start | None:
    """Run a construction with given branches; circles that do not meet give the point between them."""
    scratch = Workspace(workspace.case, workspace.frame, workspace.arithmetic)
    scratch.points = dict(workspace.points)
    scratch.points.update(held)
    placed: Start = dict(held)
    try:
        for i, step in enumerate(steps):
            if isinstance(step, Given):
                continue
            (step._replace(sign=signs[i]) if isinstance(step, Meet) and i in signs else step).place(scratch)
            placed.update({t: scratch.points[t] for t in step.targets if isinstance(t, str)})
    except ZeroDivisionError:
        return None
    return placed


def _unreached(group: PointGroup, workspace: Workspace, closest: Start) -> Miss:
    """No solution: the datum that is farthest off where the rest comes closest."""
    from icsolve.assembly.conditions import residual

    names = listed([plain(t) for t in group.targets])
    if not closest:
        return Miss(Status.CANNOT_ASSEMBLE, f"no position found in which points {names} fit their data")
    workspace.points.update(closest)
    off, datum = max(((abs(residual(workspace, d)[0]), d) for d in data_in(group)), key=lambda pair: pair[0])
    return Miss(
        Status.CANNOT_ASSEMBLE,
        f"the figure cannot be assembled: no position found in which points {names} fit their data "
        f"together; the closest misses {datum_words(datum)} by {measure(workspace, off)}",
        off,
    )


NEEDS_NEAR = (
    "{names} can only be found together, there is no order of construction; say roughly where one of them "
    "is: near: {{{first}: [x, y]}}"
)
UNFINISHED = (
    "no position was found in which points {names} fit their data together, and the search ended before all "
    "starts were tried: say roughly where more of them are, near: {{...}} for each"
)
FLAT_THERE = (
    "points {names} are not held by their data: where these are met, the points can still move (a dead "
    "centre, or a datum that repeats others); give one more length, angle or coordinate"
)
MOVABLE = (
    "{names} may lie anywhere along a curve: some of the data tell the same; give one more length, angle or "
    "coordinate for {names}"
)


def _of(group: PointGroup, sentence: str) -> str:
    """A sentence about the points of a group."""
    names = [plain(t) for t in group.targets]
    return sentence.format(names=listed(names), first=names[0])


def _vague(status: str, message: str) -> Miss:
    """A miss of which others may say more."""
    return Miss(status, message, 0.0, vague=True)
