"""A construction from end to end: order the steps, walk the modes, compare the spare data, choose."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from icsolve.assembly.modes import Mode, Walk, choose, far_from_near, nearest, overridden, refusal
from icsolve.assembly.order import Order, order_of
from icsolve.assembly.refusals import Miss, mirrored
from icsolve.assembly.residuals import notes_of, size_of
from icsolve.assembly.steps import Figure, Given, leading_to, points_of
from icsolve.assembly.workspace import Frame, Workspace
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import FLOATS

MOST_RETRIES = 20
Outcome = TypeVar("Outcome")


def construct(case: Case, frame: Frame, goal: list[str], names: list[str]) -> Figure:
    """The wanted points of a figure that needs construction (see ``solve_figure``)."""
    figure = None
    spare = [p for p in case.near if p not in goal and p in names]
    if spare:
        figure = _by_the_rest(case, frame, goal, [*goal, *spare])
    try:
        figure = figure or _constructed(case, frame, goal, best_effort=False)
    except SceneError as error:
        if error.status != Status.AMBIGUOUS or set(names) <= set(goal):
            raise
        figure = _by_the_rest(case, frame, goal, names)
        if figure is None:
            raise
    return figure._replace(skipped=tuple(p.lstrip("@") for p in names if p not in figure.points))


def _by_the_rest(case: Case, frame: Frame, goal: list[str], names: list[str]) -> Figure | None:
    """Let the data of points that nothing asked for decide between the modes."""
    try:
        whole = _constructed(case, frame, names, best_effort=True)
    except SceneError:
        return None
    if not set(goal) <= whole.points.keys():
        return None
    steps = leading_to(goal, whole.steps)
    return whole._replace(steps=steps, points={p: whole.points[p] for p in points_of(steps)})


def _constructed(case: Case, frame: Frame, goal: list[str], best_effort: bool) -> Figure:
    return by_other_data(case, goal, lambda order: _assembled(case, frame, order), best_effort)


def by_other_data(
    case: Case, goal: list[str], attempt: Callable[[Order], Outcome | Miss], best_effort: bool = False
) -> Outcome:
    """What an attempt makes of an order of construction; of another where two loci turned out to be one.

    Raises SceneError where the attempt misses for another reason, or no order is left.
    """
    first: Miss | None = None
    banned: frozenset[frozenset[object]] = frozenset()
    for _ in range(MOST_RETRIES):
        try:
            order = order_of(case, goal, banned, best_effort)
        except SceneError as error:
            if first is not None:
                raise SceneError(first.status, first.message) from error
            raise
        outcome = attempt(order)
        if not isinstance(outcome, Miss):
            return outcome
        first = first or outcome
        if outcome.loci is None:
            told = first if outcome.vague else outcome
            raise SceneError(told.status, told.message)
        banned |= {outcome.loci}
    raise SceneError(
        Status.NEAR_SINGULAR, "too many lines and circles of the figure coincide to construct it"
    )


def _assembled(case: Case, frame: Frame, order: Order) -> Figure | Miss:
    """The one mode in which an order of construction is meant to assemble, or why it does not."""
    walk = Walk(order, Workspace(case, frame, FLOATS)).run()
    if not walk.modes or walk.gave_up:
        return refusal(walk)
    miss = overridden(walk, nearest(walk))
    if miss is not None:
        return miss
    return _figure(walk, walk.modes[0] if len(walk.modes) == 1 else choose(walk, order.points))


def _figure(walk: Walk, mode: Mode) -> Figure | Miss:
    """The figure of the mode that is meant; a miss where what lies at `near` is another."""
    order, workspace = walk.order, walk.workspace
    workspace.points = mode.points
    miss = mirrored(workspace, mode.steps, walk.near, size_of(workspace, order.points))
    if miss is not None:
        return miss
    notes: tuple[str, ...] = ()
    if mode.offs:
        given = any(isinstance(step, Given) for step in order.steps)
        notes = notes_of(workspace, mode.offs, walk.used, given, size_of(workspace, order.points))
    notes += far_from_near(walk, mode, order.points)
    return Figure(workspace.frame, {p: mode.points[p] for p in order.points}, mode.steps, notes, ())
