"""Newton's method for a group of points: many starts, every solution found once, the nearest first.

Starts come from the construction that holds one point where `near` puts it (and about there), with all of
its branches, and from points spread evenly about the group. Each solution is polished to full precision.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from itertools import islice, product

from icsolve.assembly.board import Board
from icsolve.assembly.data import LENGTH, facts_of
from icsolve.assembly.equations import Unknown, pivots, solved
from icsolve.assembly.given import Given
from icsolve.assembly.group import Group
from icsolve.assembly.order import grow
from icsolve.assembly.refusals import Miss, measure
from icsolve.assembly.sheet import Drawing
from icsolve.assembly.step import Step
from icsolve.assembly.steps import Meet
from icsolve.assembly.words import datum_words, listed, plain
from icsolve.errors import Status

Spot = tuple[float, float]
Start = dict[str, Spot]

MOST_STEPS = 18
LONGEST_STEP = 0.4
"""Longest move of a coordinate in one step, over the group's size."""
CLOSED = 1e-9
"""Residual, over the square of the group's size, below which a start has arrived, before polishing."""
FLAT = 1e-11
"""Smallest over largest pivot of a solution that stands alone."""
MOST_BRANCHES = 64
SPREAD = 16
MOST_WORK = 250_000
"""Steps times the square of the number of equations, over all starts."""


def solutions(
    group: Group, board: Board, near: Mapping[str, Spot], missed: Callable[[Miss], None]
) -> list[Group]:
    """Every solution found of a group, the nearest to `near` first; ``missed`` is told why there is none."""
    found, closest = _search(group, board, near)
    held = [t for t in group.targets if t in near]
    found.sort(key=lambda end: math.hypot(*(math.dist(end[t], near[t]) for t in held)))
    polished = [_polished(group, board, end) for end in found]
    settled = [option for option in polished if option is not None]
    if not settled:
        missed(_flat(group) if polished else _unreached(group, board, closest))
    return settled


def _search(group: Group, board: Board, near: Mapping[str, Spot]) -> tuple[list[Start], Start]:
    """The distinct ends of the starts that arrive, and the closest of those that do not."""
    found: list[Start] = []
    closest: tuple[float, Start] = (math.inf, {})
    reach = _reach(group, board)
    work, per_step = 0, len(group.equations) ** 2
    for start in _starts(group, board, near, reach):
        off, end, taken = _descend(group, board, start, reach)
        work += taken * per_step
        if off > CLOSED * reach * reach:
            closest = min(closest, (off, end), key=lambda pair: pair[0])
        elif not any(_same(end, other, reach) for other in found):
            found.append(end)
        if work > MOST_WORK:
            break
    return found, closest[1]


def _reach(group: Group, board: Board) -> float:
    """The size of a group: its longest length, else 1."""
    return max((board.length(d) for d in group.data() if d.kind == LENGTH), default=0.0) or 1.0


def _same(one: Start, two: Start, reach: float) -> bool:
    return all(math.dist(one[t], two[t]) <= 1e-6 * (reach + math.hypot(*one[t])) for t in one)


def _rows(group: Group, board: Board) -> tuple[list[dict[Unknown, float]], list[float]]:
    unknown = set(group.unknowns())
    rows = [equation.row(board) for equation in group.equations]
    return [{u: v for u, v in row.by.items() if u in unknown} for row in rows], [row.value for row in rows]


def _descend(group: Group, board: Board, start: Start, reach: float) -> tuple[float, Start, int]:
    """Newton steps of limited length from a start: the residual reached, where, and after how many.

    Without a line search: measured on random groups, a search triples the time and ends in
    local minima as often as the plain steps wander off.
    """
    board.points.update(start)
    off, taken = math.inf, 0
    while taken < MOST_STEPS:
        taken += 1
        rows, values = _rows(group, board)
        off = math.hypot(*values)
        if off <= CLOSED * reach * reach:
            break
        order, _ = pivots(rows)
        move = solved(rows, values, order)
        longest = max(map(abs, move.values()), default=0.0)
        fraction = min(1.0, LONGEST_STEP * reach / longest) if longest > 0.0 else 0.0
        board.points.update(_moved({t: board.points[t] for t in group.targets}, move, fraction))
    return off, {t: board.points[t] for t in group.targets}, taken


def _moved(at: Start, move: dict[Unknown, float], fraction: float) -> Start:
    return {
        t: (x - fraction * move.get((t, 0), 0.0), y - fraction * move.get((t, 1), 0.0))
        for t, (x, y) in at.items()
    }


def _polished(group: Group, board: Board, end: Start) -> Group | None:
    """The group settled on a solution in full precision; None where it does not stand alone."""
    board.points.update(end)
    best = math.inf
    option = group
    for _ in range(12):
        rows, values = _rows(group, board)
        order, flatness = pivots(rows)
        if flatness < FLAT:
            return None
        option = group._replace(start=tuple(board.points[t] for t in group.targets), order=tuple(order))
        move = solved(rows, values, order)
        longest = max(map(abs, move.values()))
        if longest >= best / 2.0 and best < 1e-7:
            break
        best = longest
        board.points.update(_moved({t: board.points[t] for t in group.targets}, move, 1.0))
    return option


def _starts(group: Group, board: Board, near: Mapping[str, Spot], reach: float) -> Iterator[Start]:
    held = [t for t in group.targets if t in near]
    for point in held[:2]:
        yield from _constructed(group, board, near, point, reach)
    yield from _spread(group, near[held[0]], reach)


def _constructed(
    group: Group, board: Board, near: Mapping[str, Spot], point: str, reach: float
) -> Iterator[Start]:
    """Starts by closed forms, with one point held at and about where `near` puts it."""
    drawing = Drawing(facts_of(board.case, group.data()), frozenset())
    ground, goal = drawing.ground, set(group.targets)
    ground.begin([p for p in group.needs() if isinstance(p, str)] + [point])
    ground.run(goal)
    while not goal <= ground.placed.keys() and grow(drawing):
        ground.run(goal)
    forks = [i for i, step in enumerate(drawing.steps) if isinstance(step, Meet) and step.sign]
    (x, y), r = near[point], 0.1 * reach
    ring = [(x, y), (x + r, y), (x, y + r), (x - r, y), (x, y - r)]
    for spot in ring:
        for signs in islice(product((1, -1), repeat=len(forks)), MOST_BRANCHES):
            start = _run(drawing.steps, dict(zip(forks, signs, strict=True)), board, {point: spot})
            if start is not None:
                yield {t: start.get(t, near.get(t, spot)) for t in group.targets}


def _run(steps: list[Step], signs: dict[int, int], board: Board, held: Start) -> Start | None:
    """Run a construction with given branches; circles that do not meet give the point between them."""
    scratch = Board(board.case, board.frame, board.arithmetic)
    scratch.points = dict(board.points)
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


def _spread(group: Group, about: Spot, reach: float) -> Iterator[Start]:
    """Points spread evenly over a square about one: multiples of irrational numbers, modulo one."""
    for k in range(1, SPREAD + 1):
        start = {}
        for j, target in enumerate(group.targets):
            u, v = (math.fmod(k * math.sqrt(prime), 1.0) for prime in (2 + 8 * j + 1, 3 + 8 * j + 2))
            start[target] = (about[0] + (2.0 * u - 1.0) * reach, about[1] + (2.0 * v - 1.0) * reach)
        yield start


def _unreached(group: Group, board: Board, closest: Start) -> Miss:
    """No solution: the datum that is farthest off where the rest comes closest."""
    from icsolve.assembly.misfit import misfit

    names = listed([plain(t) for t in group.targets])
    if not closest:
        return Miss(Status.CANNOT_ASSEMBLE, f"no position found in which points {names} fit their data")
    board.points.update(closest)
    off, datum = max(((abs(misfit(board, d)[0]), d) for d in group.data()), key=lambda pair: pair[0])
    return Miss(
        Status.CANNOT_ASSEMBLE,
        f"the figure cannot be assembled: no position found in which points {names} fit their data "
        f"together; the closest misses {datum_words(datum)} by {measure(board, off)}",
        off,
    )


def _flat(group: Group) -> Miss:
    names = listed([plain(t) for t in group.targets])
    return Miss(
        Status.NEAR_SINGULAR,
        f"points {names} are not held by their data: where these are met, the points can still move "
        "(a dead centre, or a datum that repeats others); give one more length, angle or coordinate",
        0.0,
        vague=True,
    )
