"""Every way in which the figure of a case assembles, whatever its `near` says."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from icsolve.assembly.construction import by_other_data
from icsolve.assembly.modes import differing, distinct, refusal
from icsolve.assembly.order import Order, order_of
from icsolve.assembly.steps import (
    CLOSED_FORMS,
    Figure,
    Meet,
    Miss,
    Step,
    place,
)
from icsolve.assembly.walk import Mode, Walk
from icsolve.assembly.workspace import (
    Frame,
    Workspace,
    case_places,
    case_point,
    frame_of,
    names_of,
)
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers import FLOATS
from icsolve.tuples import LateModule, NamedTuple, replace
from icsolve.wording import listed

if TYPE_CHECKING:
    from icsolve.assembly import refusals
else:
    refusals = LateModule("icsolve.assembly.refusals")

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
        return _ways(walk, order, loose) if walk.modes else refusal(walk)

    return by_other_data(case, goal, attempt)


def order_that_assembles(case: Case, goal: Sequence[str]) -> Order:
    """An order of construction in which no two loci of a point are one; one with points that only together
    have places as it stands.

    Raises SceneError where the case assembles in none.
    """
    frame = frame_of(case)

    def attempt(order: Order) -> Order | Miss:
        if _groups(order):
            return order
        walk = every_mode(case, order, frame)
        if not walk.modes:
            return refusal(walk)
        pairs = zip(order.steps, walk.modes[0].steps, strict=True)
        steps = (own if isinstance(own, Meet) and own.stays_flat else step for step, own in pairs)
        return replace(order, steps=tuple(steps))  # what touches in one position touches in all

    return by_other_data(case, goal, attempt)


def every_mode(case: Case, order: Order, frame: Frame) -> Walk:
    """All modes of an order of construction."""
    return Walk(order, Workspace(case, frame, FLOATS), every=True).run()


def _placed(case: Case) -> tuple[Sequence[str], list[str]]:
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


def _ways(walk: Walk, order: Order, loose: list[str]) -> Ways:
    modes = distinct(walk.modes, order.points)
    notes = []
    if walk.gave_up:
        notes.append(f"there are more ways: the search ended after {len(modes)}")
    elif not walk.complete:
        names = "; ".join(listed([refusals.plain(t) for t in group.targets]) for group in _groups(order))
        notes.append(
            f"not shown to be all: points {names} can only be found together, and the search of their places "
            "by exclusion came to an end before every part was empty or held one way"
        )
    misses = [end.miss for end in walk.dead_ends]
    free = dict.fromkeys(miss.message for miss in misses if miss.status == Status.UNDERDETERMINED)
    notes += [f"not shown to be all: another way leaves a point free: {message}" for message in free]
    if loose:
        notes.append(f"nothing says where {listed([refusals.plain(p) for p in loose])} may be")
    frame = walk.workspace.frame
    picked = _choices(modes, order)
    digits = _digits(modes, picked, frame)
    ways = []
    for mode in modes:
        places = {p: case_point(frame, mode.points[p]) for p in order.points}
        near = {p: (round(places[p][0], digits), round(places[p][1], digits)) for p in picked}
        figure = Figure(frame, {p: mode.points[p] for p in order.points}, mode.steps)
        ways.append(AssemblyWay(_rounded_once(figure, walk.workspace.case), near))
    return Ways(tuple(ways), walk.complete and not (walk.gave_up or free), tuple(notes))


def _rounded_once(figure: Figure, case: Case) -> dict[str, Place]:
    """The points by name in case units, as a scene shows them; as found where no digits settle one."""
    from icsolve.numbers.balls import PRECISIONS, Balls, BelowZero, MoreDigits

    for digits in PRECISIONS:
        balls = Balls(digits, highest=digits == PRECISIONS[-1])
        try:
            points = place(figure, case, balls).points
            return case_places(figure.frame, {p: points[p] for p in figure.points}, balls)[0]
        except (MoreDigits, BelowZero, ZeroDivisionError):
            continue
    return case_places(figure.frame, figure.points, FLOATS)[0]


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
