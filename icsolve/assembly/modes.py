"""Assembly modes: the one that `near` means, and every one there is.

A construction from end to end: order the steps, walk them, compare the spare data, choose; or list
every way in which the figure assembles, whatever its `near` says.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from icsolve.assembly.conditions import size_of
from icsolve.assembly.order import Order, order_of
from icsolve.assembly.steps import (
    CLOSED_FORMS,
    Figure,
    Given,
    Meet,
    Miss,
    Polar,
    Step,
    Turned,
    leading_to,
    place,
    points_of,
)
from icsolve.assembly.walk import EVEN, DeadEnd, Mode, Path, Walk, squared_distance
from icsolve.assembly.workspace import (
    CORNER,
    RAY,
    Frame,
    Workspace,
    case_places,
    case_point,
    data_in,
    frame_of,
    names_of,
)
from icsolve.case import Case, bare_name
from icsolve.errors import SceneError, Status
from icsolve.numbers import FLOATS, Scalar
from icsolve.screws import Point
from icsolve.tuples import LateModule, NamedTuple, TypeVar, replace
from icsolve.wording.sentences import listed

if TYPE_CHECKING:
    from icsolve.assembly import refusals
else:
    refusals = LateModule("icsolve.assembly.refusals")

SIDEWAYS = 0.05
"""Two ways are equally near where their distances from `near` have at least the ratio EVEN, and `near`
is seen from between them within this sine of square to the line that joins them, over the root of the
number of points: of a guess that is off in every coordinate so much lies along one line. (Near a dead
centre the two are close together, and the ratio alone would call any digits of `near` in between.)"""
SAME = 1e-11
"""Points nearer than this (normalised, over 1 + their distance from the origin) are one point."""
COINCIDING = 1e-6
"""Ways that differ by less are told apart in digits."""
MOST_LISTED = 4


def refusal(walk: Walk) -> Miss:
    """The miss to report of a figure that does not assemble.

    Of the way that lies nearest to `near`: the deepest dead end, of these the smallest.
    """
    if walk.gave_up:
        steps = walk.order.steps
        forks = [step.target for step in steps if isinstance(step, Meet) and step.sign]
        names = ", ".join(refusals.plain(key) for key in forks if key not in walk.near)
        message = f"the figure has too many open branches to try them all; give near: for some of {names}"
        return Miss(Status.AMBIGUOUS, message)
    first = walk.dead_ends[0]
    nearest = [end for end in walk.dead_ends if not _clearly(walk, first, end.path)]
    return min(nearest or walk.dead_ends, key=lambda at: (-at.depth, at.miss.amount)).miss


def _clearly(walk: Walk, one: DeadEnd, other: Path) -> bool:
    """Whether a dead end lies clearly nearer to `near` than another way."""
    ours, theirs = parted(walk, one.path, other)
    held = [p for p in ours if p in theirs]
    return nearer([ours[p] for p in held], [theirs[p] for p in held], [walk.near[p] for p in held])


def parted(walk: Walk, one: Path, two: Path) -> tuple[dict[str, Point], dict[str, Point]]:
    """The places with a `near` of two ways, from where they part."""
    ours, theirs = one.line(), two.line()
    at = 0
    while at < min(len(ours), len(theirs)) and ours[at] is theirs[at]:
        at += 1
    return _places(ours[at:], walk.near), _places(theirs[at:], walk.near)


def _places(paths: list[Path], near: Mapping[str, Point]) -> dict[str, Point]:
    return {str(p): at for path in paths for p, at in path.places.items() if p in near}


def nearer(one: list[Point], two: list[Point], near: list[Point]) -> bool:
    """Whether the first of two placements of some points is clearly the nearer to `near`.

    Both are points of a space of twice as many dimensions; ``side`` is how far `near` is from the
    plane midway between them.
    """
    first, second, half = _distance(one, near), _distance(two, near), _distance(one, two) / 2.0
    if half == 0.0 or first < EVEN * second:
        return half > 0.0
    side = (second - first) * (second + first) / (4.0 * half)
    return side > SIDEWAYS * math.sqrt((first * first + second * second) / (2.0 * len(near)))


def _distance(one: list[Point], two: list[Point]) -> float:
    return math.hypot(*(math.dist(p, q) for p, q in zip(one, two, strict=True)))


# --- the mode that is meant ---


def choose(walk: Walk, points: tuple[str, ...]) -> Mode:
    """The mode that is meant: the nearest to `near`.

    Raises
    ------
    SceneError
        ``ambiguous``: several are about as near, listed point by point.
    """
    workspace = walk.workspace
    modes = distinct(walk.modes, points)
    for mode in walk.modes:
        if all(_parted(walk, mode, other, points) for other in modes):
            modes.append(mode)
    modes.sort(key=lambda mode: mode.path.off)
    best = modes[0]
    rivals = [mode for mode in modes if mode is best or not _nearer(walk, best, mode, points)]
    if len(rivals) > 1:
        raise SceneError(Status.AMBIGUOUS, _listing(workspace, rivals, points))
    return best


def nearest(walk: Walk) -> Mode:
    """The mode nearest to `near`, the first of those that are as near."""
    return min(walk.modes, key=lambda mode: mode.path.off)


def overridden(walk: Walk, chosen: Mode) -> Miss | None:
    """Why the mode that was chosen is not the one at `near`: one that lies nearer does not assemble."""
    worst: tuple[float, DeadEnd] | None = None
    for end in walk.dead_ends:
        if not _clearly(walk, end, chosen.path):
            continue
        ours, theirs = parted(walk, end.path, chosen.path)
        gain = sum(
            squared_distance(theirs[p], walk.near[p]) - squared_distance(at, walk.near[p])
            for p, at in ours.items()
        )
        if worst is None or gain > worst[0]:
            worst = (gain, end)
    return None if worst is None else _promise(walk, chosen, worst[1])


def _promise(walk: Walk, chosen: Mode, end: DeadEnd) -> Miss:
    """What lies at `near`, why it does not assemble, and where another way lies."""
    workspace = walk.workspace
    ours, theirs = parted(walk, end.path, chosen.path)
    held = [
        p for p in ours if squared_distance(ours[p], walk.near[p]) < squared_distance(theirs[p], walk.near[p])
    ]
    there = {p: _pair(case_point(workspace.frame, theirs[p])) for p in held[:MOST_LISTED]}
    places = listed([f"{refusals.plain(p)} at ({at})" for p, at in there.items()])
    away = refusals.measure(workspace, max(math.dist(theirs[p], walk.near[p]) for p in held))
    message = (
        f"what lies at near: does not assemble: {end.miss.message}; the figure assembles only with {places}, "
        f"{away} from near: correct the data, or move near: there if that is meant"
    )
    return Miss(end.miss.status, message, end.miss.amount)


NOT_SHOWN = (
    "near: no way of assembling was found that lies nearer to it; that there is none is not shown (it is for "
    "groups of few points, and where near is exact enough)"
)


def far_from_near(walk: Walk, chosen: Mode, points: tuple[str, ...]) -> tuple[str, ...]:
    """Notes on the points that lie farther from their `near` than half the figure."""
    workspace = walk.workspace
    half = size_of(workspace, points) / 2.0
    out = []
    for p, near in walk.near.items():
        at = chosen.points.get(p)
        if at is not None and math.dist(at, near) > half:
            off, there = refusals.measure(workspace, math.dist(at, near)), case_point(workspace.frame, at)
            out.append(
                f"near: for {refusals.plain(p)} is {off} from where the data put it, ({_pair(there)}): "
                "farther than half the figure"
            )
    return tuple(out)


def distinct(modes: list[Mode], points: tuple[str, ...]) -> list[Mode]:
    """Each mode once."""
    out: list[Mode] = []
    for mode in modes:
        if all(any(_differing(mode, other, points)) for other in out):
            out.append(mode)
    return out


def _forks(one: Mode, two: Mode) -> bool:
    """Whether two loci meet on another side in the one than in the other."""
    pairs = zip(one.steps, two.steps, strict=True)
    return any(isinstance(a, Meet) and isinstance(b, Meet) and a.sign != b.sign for a, b in pairs)


def _parted(walk: Walk, one: Mode, two: Mode, points: Sequence[str]) -> bool:
    """Whether some of the points lie apart in two modes, if only in more digits than doubles have."""
    if any(_differing(one, two, tuple(points))):
        return True
    return one is not two and _forks(one, two) and bool(_in_digits(walk, one, two, points))


def differing(one: Mode, two: Mode, points: tuple[str, ...]) -> list[str]:
    """The points that are not in the same place in both."""
    return list(_differing(one, two, points))


def _differing(one: Mode, two: Mode, points: tuple[str, ...]) -> Iterator[str]:
    """The same, one after another."""
    for p in points:
        (ax, ay), (bx, by) = one.points[p], two.points[p]
        if math.hypot(ax - bx, ay - by) > SAME * (1.0 + math.hypot(ax, ay)):
            yield p


def _nearer(walk: Walk, one: Mode, two: Mode, points: tuple[str, ...]) -> bool:
    """Whether the one mode is clearly nearer to `near` where the two differ; of those that all but coincide
    more digits tell."""
    held = [p for p in differing(one, two, points) if p in walk.near]
    first, second = [one.points[p] for p in held], [two.points[p] for p in held]
    if not _forks(one, two) or _distance(first, second) > COINCIDING:
        return nearer(first, second, [walk.near[p] for p in held])
    places = _in_digits(walk, one, two, [p for p in points if p in walk.near])
    if not places:
        return False
    apart = [part for gone, _ in places.values() for part in gone]
    off = [
        part - n for p, (_, middle) in places.items() for part, n in zip(middle, walk.near[p], strict=True)
    ]
    side = sum((d * a for d, a in zip(apart, off, strict=True)), 0.0)
    size = float(sum((d * d for d in apart), 0.0)) ** 0.5
    return bool(float(side) > SIDEWAYS * size * math.hypot(*map(float, off)) / math.sqrt(len(places)))


def _in_digits(
    walk: Walk, one: Mode, two: Mode, points: Sequence[str]
) -> dict[str, tuple[list[Scalar], list[Scalar]]]:
    """Of the points that lie apart in two modes by how much, and the middle between [frame], in many digits;
    of none where these do not tell."""
    from icsolve.numbers.balls import PRECISIONS, Balls, BelowZero, MoreDigits

    workspace, balls = walk.workspace, Balls(PRECISIONS[-1], highest=True)
    found = {}
    try:
        ways = [Figure(workspace.frame, {}, mode.steps) for mode in (one, two)]
        first, second = (place(figure, workspace.case, balls).points for figure in ways)
        for p in points:
            pairs = list(zip(first[p], second[p], strict=True))
            apart = [b - a for a, b in pairs]
            if not all(balls.vanishes(d, 1.0) for d in apart):
                found[p] = apart, [(a + b) / 2.0 for a, b in pairs]
    except (MoreDigits, BelowZero, ZeroDivisionError):
        return {}
    return found


def _listing(workspace: Workspace, rivals: list[Mode], points: tuple[str, ...]) -> str:
    """The modes point by point: first the points that have a choice of their own."""
    forked = [p for p in points if any(differing(rivals[0], mode, (p,)) for mode in rivals[1:])]
    if not forked:
        names = listed([refusals.plain(p) for p in points if p not in workspace.case.points])
        return (
            f"the figure assembles in several ways that all but coincide, of points {names}, and near: does "
            "not tell which is meant; give it on the side that is meant, some way off"
        )
    forks = [
        step.target
        for step in rivals[0].steps
        if isinstance(step, Meet) and step.sign and step.target in forked
    ] or forked
    lines = [f"{refusals.plain(p)}: {_listed(workspace, rivals, str(p))}" for p in forks]
    hint = _hint(workspace, rivals, str(next((p for p in forks if p not in workspace.case.near), forks[0])))
    return f"the figure assembles in several ways, {'; '.join(lines)}; {hint}"


def _listed(workspace: Workspace, rivals: list[Mode], point: str) -> str:
    seen: list[tuple[float, float]] = []
    for mode in rivals:
        at = mode.points[point]
        if all(math.dist(at, other) > SAME * (1.0 + math.hypot(*at)) for other in seen):
            seen.append(at)
    places = [_pair(case_point(workspace.frame, at)) for at in seen[:MOST_LISTED]]
    more = f" or {len(seen) - MOST_LISTED} more" if len(seen) > MOST_LISTED else ""
    return " or ".join(f"({place})" for place in places) + more


def _hint(workspace: Workspace, rivals: list[Mode], point: str) -> str:
    example = _pair(case_point(workspace.frame, rivals[0].points[point]))
    if point in workspace.case.near:
        return (
            f"near: for {refusals.plain(point)} is about as far from the one as from the other; "
            "move it nearer to the one that is meant"
        )
    return f"add near: {{{refusals.plain(point)}: [{example}]}} for the one that is meant"


def _pair(at: tuple[float, float]) -> str:
    return f"{at[0]:.6g}, {at[1]:.6g}"


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
        return refusal(walk)
    miss = overridden(walk, nearest(walk))
    if miss is not None:
        return miss
    return _figure(walk, walk.modes[0] if len(walk.modes) == 1 else choose(walk, order.points))


def _figure(walk: Walk, mode: Mode) -> Figure | Miss:
    """The figure of the mode that is meant; a miss where what lies at `near` is another."""
    order, workspace = walk.order, walk.workspace
    workspace.points = mode.points
    turned = [
        step
        for step in mode.steps
        if isinstance(step, Polar | Meet | Turned) and step.target in walk.near and _turns(step)
    ]
    if turned:
        miss = refusals.mirrored(workspace, turned, walk.near, size_of(workspace, order.points))
        if miss is not None:
            return miss
    notes: tuple[str, ...] = ()
    if mode.offs:
        given = any(isinstance(step, Given) for step in order.steps)
        notes = refusals.notes_of(workspace, mode.offs, walk.used, given, size_of(workspace, order.points))
    notes += (*far_from_near(walk, mode, order.points), *(() if walk.complete else (NOT_SHOWN,)))
    return Figure(workspace.frame, {p: mode.points[p] for p in order.points}, mode.steps, notes, ())


def _turns(step: Step) -> bool:
    """Whether a step goes by an angle."""
    return any(datum.kind in (RAY, CORNER) for datum in data_in(step))


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
        return order if walk.modes else refusal(walk)

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
    return Ways(tuple(ways), walk.complete and not walk.gave_up, tuple(notes))


def _rounded_once(figure: Figure, case: Case) -> dict[str, Place]:
    """The points by name in case units, as a scene shows them; as found where no digits settle one."""
    from icsolve.numbers.balls import PRECISIONS, Balls, BelowZero, MoreDigits

    for digits in PRECISIONS:
        balls = Balls(digits, highest=digits == PRECISIONS[-1])
        try:
            points = place(figure, case, balls).points
            return case_places(figure.frame, {p: points[p] for p in figure.points}, balls)
        except (MoreDigits, BelowZero, ZeroDivisionError):
            continue
    return case_places(figure.frame, figure.points, FLOATS)


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
