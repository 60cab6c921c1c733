"""A construction from end to end: order the steps, walk them, choose the assembly mode that is meant, compare
the spare data."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from icsolve.assembly.conditions import size_of
from icsolve.assembly.order import Order, order_of
from icsolve.assembly.steps import (
    Figure,
    Given,
    Meet,
    Miss,
    Polar,
    Step,
    Turned,
    leading_to,
    points_of,
)
from icsolve.assembly.walk import Mode, Walk
from icsolve.assembly.workspace import (
    CORNER,
    RAY,
    Frame,
    Workspace,
    case_point,
    data_in,
)
from icsolve.case import Case, bare_name
from icsolve.errors import SceneError, Status
from icsolve.numbers import FLOATS
from icsolve.tuples import LateModule, TypeVar

if TYPE_CHECKING:
    from icsolve.assembly import modes, refusals
else:  # where a figure assembles in several ways, or in none
    modes, refusals = map(LateModule, ("icsolve.assembly.modes", "icsolve.assembly.refusals"))

MOST_RETRIES = 20
Outcome = TypeVar("Outcome")


def construct(case: Case, frame: Frame, goal: Sequence[str], names: Sequence[str]) -> Figure:
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
    return figure._replace(skipped=tuple(bare_name(p) for p in names if p not in figure.points))


def _by_the_rest(case: Case, frame: Frame, goal: Sequence[str], names: Sequence[str]) -> Figure | None:
    """Let the data of points that nothing asked for decide between the modes."""
    try:
        whole = _constructed(case, frame, names, best_effort=True)
    except SceneError:
        return None
    if not set(goal) <= whole.points.keys():
        return None
    steps = leading_to(goal, whole.steps)
    return whole._replace(steps=steps, points={p: whole.points[p] for p in points_of(steps)})


def _constructed(case: Case, frame: Frame, goal: Sequence[str], best_effort: bool) -> Figure:
    return by_other_data(case, goal, lambda order: _assembled(case, frame, order), best_effort)


def by_other_data(
    case: Case, goal: Sequence[str], attempt: Callable[[Order], Outcome | Miss], best_effort: bool = False
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
        return modes.refusal(walk)
    if walk.dead_ends and (miss := modes.overridden(walk, modes.nearest(walk))) is not None:
        return miss
    return _figure(walk, walk.modes[0] if len(walk.modes) == 1 else modes.choose(walk, order.points))


def _figure(walk: Walk, mode: Mode) -> Figure | Miss:
    """The figure of the mode that is meant; a miss where what lies at `near` is another."""
    order, workspace = walk.order, walk.workspace
    workspace.points = mode.points
    turned = [
        step
        for step in mode.steps
        if isinstance(step, (Polar, Meet, Turned)) and step.target in walk.near and _turns(step)
    ]
    if turned:
        miss = refusals.mirrored(workspace, turned, walk.near, size_of(workspace, order.points))
        if miss is not None:
            return miss
    notes: tuple[str, ...] = ()
    if mode.offs:
        given = any(isinstance(step, Given) for step in order.steps)
        notes = refusals.notes_of(workspace, mode.offs, walk.used, given, size_of(workspace, order.points))
    notes += (
        *walk.in_line,
        *_far_from_near(walk, mode, order.points),
        *(() if walk.complete else (NOT_SHOWN,)),
    )
    return Figure(workspace.frame, {p: mode.points[p] for p in order.points}, mode.steps, notes, ())


def _turns(step: Step) -> bool:
    """Whether a step goes by an angle."""
    return any(datum.kind in (RAY, CORNER) for datum in data_in(step))


NOT_SHOWN = (
    "near: no way of assembling was found that lies nearer to it; that there is none is not shown (it is for "
    "groups of few points, and where near is exact enough)"
)


def _far_from_near(walk: Walk, chosen: Mode, points: tuple[str, ...]) -> tuple[str, ...]:
    """Notes on the points that lie farther from their `near` than half the figure."""
    workspace = walk.workspace
    half = size_of(workspace, points) / 2.0
    out = []
    for p, near in walk.near.items():
        at = chosen.points.get(p)
        if at is not None and math.dist(at, near) > half:
            off, there = refusals.measure(workspace, math.dist(at, near)), case_point(workspace.frame, at)
            out.append(
                f"near: for {refusals.plain(p)} is {off} from where the data put it, "
                f"({there[0]:.6g}, {there[1]:.6g}): "
                "farther than half the figure"
            )
    return tuple(out)
