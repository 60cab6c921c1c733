"""A construction from end to end: order the steps, walk the modes, compare the spare data, choose; or list
every way in which the figure assembles, whatever its `near` says."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

from icsolve.assembly.data import names_of
from icsolve.assembly.modes import (
    Mode,
    Walk,
    choose,
    differing,
    distinct,
    far_from_near,
    nearest,
    overridden,
    refusal,
)
from icsolve.assembly.order import Order, order_of
from icsolve.assembly.refusals import Miss, mirrored
from icsolve.assembly.residuals import notes_of, size_of
from icsolve.assembly.steps import CLOSED_FORMS, Figure, Given, Meet, Step, leading_to, points_of
from icsolve.assembly.words import plain
from icsolve.assembly.workspace import Frame, Workspace, case_point, frame_of
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import FLOATS
from icsolve.tuples import NamedTuple, replace
from icsolve.wording.sentences import listed

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


# --- every way in which the figure of a case assembles ---


Place = tuple[float, float]

DIGITS = 6
"""Significant digits of `near`, where these tell the ways apart."""


class AssemblyWay(NamedTuple):
    """One way: the points in case units, and the `near` that picks it."""

    points: dict[str, Place]
    near: dict[str, Place]


class Ways(NamedTuple):
    """All ways that were found, whether these are shown to be all, and what else is to be said."""

    ways: tuple[AssemblyWay, ...]
    complete: bool
    notes: tuple[str, ...]


def ways_of(case: Case) -> Ways:
    """Every way in which all points of a case find their places, each once.

    Raises
    ------
    SceneError
        ``cannot-assemble``, ``inconsistent``: there is none; ``underdetermined``: a joint can be anywhere.
    """
    if case.space is not None:
        raise SceneError(Status.UNSUPPORTED, "the ways of assembling are found for planar figures")
    if case.unknowns:
        path = case.unknowns[0].path
        said = f"{path} is unknown: the ways of assembling are those at a value of it, --set {path}=..."
        raise SceneError(Status.UNSUPPORTED, said)
    case = replace(case, near={})
    goal, loose = _placed(case)
    frame = frame_of(case)

    def attempt(order: Order) -> Ways | Miss:
        walk = every_mode(case, order, frame)
        return _ways(case, walk, order, loose) if walk.modes else refusal(walk)

    return by_other_data(case, goal, attempt)


def order_that_assembles(case: Case, goal: list[str]) -> Order:
    """An order of construction in which no two loci of a point are one; one with points that only together
    have places as it stands.

    Raises SceneError where the case assembles in none.
    """
    frame = frame_of(case)

    def attempt(order: Order) -> Order | Miss:
        if _groups(order):
            return order
        walk = every_mode(case, order, frame)
        return order if walk.modes else refusal(walk)

    return by_other_data(case, goal, attempt)


def every_mode(case: Case, order: Order, frame: Frame) -> Walk:
    """All modes of an order of construction."""
    return Walk(order, Workspace(case, frame, FLOATS), every=True).run()


def _placed(case: Case) -> tuple[list[str], list[str]]:
    """The points that the data place, and those that nothing needs and that may be anywhere."""
    names = names_of(case)
    try:
        order_of(case, names)
    except SceneError as error:
        if error.status != Status.UNDERDETERMINED:
            raise
        needed = {getattr(joint, "at", None) for joint in case.joints}
        loose = [name for name in names if not _can_be_placed(case, name)]
        if needed & set(loose):
            if case.profiles is not None:
                said = "the ways of a figure that rests on profiles are not listed: "
                raise SceneError(Status.UNSUPPORTED, f"{said}{error.message}") from None
            raise
        return [name for name in names if name not in loose], loose
    return names, []


def _can_be_placed(case: Case, name: str) -> bool:
    try:
        order_of(case, [name])
    except SceneError:
        return False
    return True


def _ways(case: Case, walk: Walk, order: Order, loose: list[str]) -> Ways:
    modes = distinct(walk.modes, order.points)
    notes = []
    if walk.gave_up:
        notes.append(f"there are more ways: the search ended after {len(modes)}")
    elif not walk.complete:
        names = "; ".join(listed([plain(t) for t in group.targets]) for group in _groups(order))
        notes.append(
            f"not shown to be all: points {names} can only be found together, and the search of their places "
            "by exclusion came to an end before every part was empty or held one way"
        )
    if loose:
        notes.append(f"nothing says where {listed([plain(p) for p in loose])} may be")
    frame = walk.workspace.frame
    picked = _choices(modes, order)
    digits = _digits(modes, picked, frame)
    ways = []
    for mode in modes:
        places = {p: case_point(frame, mode.points[p]) for p in order.points}
        near = {p: (round(places[p][0], digits), round(places[p][1], digits)) for p in picked}
        ways.append(AssemblyWay({p: at for p, at in places.items() if not p.startswith("@")}, near))
    return Ways(tuple(ways), walk.complete and not walk.gave_up, tuple(notes))


def _groups(order: Order) -> list[Step]:
    """The steps that place points only all together."""
    return [step for step in order.steps if not isinstance(step, (Meet, *CLOSED_FORMS))]


def _choices(modes: list[Mode], order: Order) -> list[str]:
    """The points whose places tell the ways apart, and those that can only be found from `near`."""
    apart = {p for mode in modes[1:] for p in differing(modes[0], mode, order.points)}
    grouped = [t for group in _groups(order) for t in group.targets]
    forks = [
        step.target
        for mode in modes
        for step in mode.steps
        if isinstance(step, Meet) and step.sign and step.target in apart
    ]
    chosen = dict.fromkeys([str(p) for p in (*forks, *grouped) if isinstance(p, str)])
    alike = [
        mode for mode in modes[1:] if not any(p in chosen for p in differing(modes[0], mode, order.points))
    ]
    return [p for p in order.points if p in chosen or (alike and p in apart)]


def _digits(modes: list[Mode], picked: list[str], frame: Frame) -> int:
    """Decimals of `near` that tell each way from every other."""
    least = min(
        (
            math.hypot(*(math.dist(one.points[p], two.points[p]) for p in picked))
            for k, one in enumerate(modes)
            for two in modes[:k]
        ),
        default=1.0,
    )
    size = max((abs(c) for mode in modes for p in picked for c in mode.points[p]), default=1.0) or 1.0
    figures = DIGITS - 1 - math.floor(math.log10(size / frame.scale))
    return max(figures, 3 - math.floor(math.log10(max(least, 1e-12) / frame.scale)))
