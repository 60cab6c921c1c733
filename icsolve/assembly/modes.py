"""Assembly modes: the one that `near` means, or why a figure does not assemble."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from icsolve.assembly.steps import (
    Figure,
    Meet,
    Miss,
    place,
)
from icsolve.assembly.walk import EVEN, DeadEnd, Mode, Path, Walk, squared_distance
from icsolve.assembly.workspace import (
    Workspace,
    case_point,
)
from icsolve.errors import SceneError, Status
from icsolve.numbers import Scalar
from icsolve.screws import Point
from icsolve.tuples import LateModule
from icsolve.wording import listed

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
        names = ", ".join(dict.fromkeys(refusals.plain(key) for key in forks if key not in walk.near))
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
    beside = ", beside what stands under near" if workspace.case.near else ""
    return f"add near: {{{refusals.plain(point)}: [{example}]}} for the one that is meant{beside}"


def _pair(at: tuple[float, float]) -> str:
    return f"{at[0]:.6g}, {at[1]:.6g}"
