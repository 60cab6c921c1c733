"""The assembly modes of a construction: every way in which it assembles, and the one that `near` means.

A depth-first walk over the steps, nearest places first. Of the modes that assemble the one with the least
sum of squared distances from `near` is taken (branch and bound: a partial sum only grows). A partial way that
lies clearly nearer to `near` than that mode, and does not go on, is a refusal: `near` is a promise.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import partial

from icsolve.assembly.data import Datum
from icsolve.assembly.decided import (
    Decimals,
    Gap,
    gaps_ahead,
    gaps_ahead_of,
    gaps_between,
    merged_pairs,
    places_of,
)
from icsolve.assembly.intersections import PlacedCircle, gaps_of, side
from icsolve.assembly.loci import is_ray, is_round
from icsolve.assembly.order import Order
from icsolve.assembly.refusals import (
    Miss,
    behind,
    clash,
    concentric,
    degenerate,
    measure,
    merged,
    parallel,
    too_far,
)
from icsolve.assembly.residuals import TOO_CLOSE, agrees, compare, residual, size_of
from icsolve.assembly.steps import CLOSED_FORMS, Meet, Step, aims
from icsolve.assembly.words import plain
from icsolve.assembly.workspace import Key, Point, Workspace, case_point, normalised
from icsolve.errors import SceneError, Status
from icsolve.tuples import NamedTuple
from icsolve.wording.sentences import listed

U = 2.0**-53
TOUCHING = 8.0 * U
"""Where the decimals leave it open: gaps of this many roundings are zero, the circles touch."""
PARALLEL = 1e-14
"""Where the decimals leave it open: sine of the smallest angle at which two lines still meet."""
DOUBT = 1e-6
"""Gaps below this, over the lengths that made them, are put to the decimals as written."""
COARSE = 0.02
"""Residual at which a way is given up before its end; the finer test comes with the whole figure."""
EVEN = 0.99
SIDEWAYS = 0.05
"""Two ways are equally near where their distances from `near` have at least the ratio EVEN, and `near`
is seen from between them within this sine of square to the line that joins them, over the root of the
number of points: of a guess that is off in every coordinate so much lies along one line. (Near a dead
centre the two are close together, and the ratio alone would call any digits of `near` in between.)"""
MOST_MODES = 256
MOST_WAYS = 4096
"""Ways at most where all are asked for."""
SAME = 1e-11
"""Points nearer than this (normalised, over 1 + their distance from the origin) are one point."""
MOST_LISTED = 4


class Path(NamedTuple):
    """The last step of a way so far, as it was settled; ``before`` leads to the others.

    ``off`` is the sum of the squared distances from `near` up to here; ``places`` has the step's points.
    """

    before: Path | None
    step: Step | None
    off: float
    places: Mapping[Key, Point]

    def steps(self) -> tuple[Step, ...]:
        """All steps, the first one first."""
        out: list[Step] = []
        at: Path | None = self
        while at is not None and at.step is not None:
            out.append(at.step)
            at = at.before
        return tuple(reversed(out))


START = Path(None, None, 0.0, {})


class Mode(NamedTuple):
    """One way of assembling: the steps as they were settled, the points, and the end of its path.

    ``offs`` is how far the data that made no points are from them [frame].
    """

    steps: tuple[Step, ...]
    points: dict[Key, Point]
    path: Path
    offs: Mapping[Datum, float] = {}


class DeadEnd(NamedTuple):
    """A way that does not go on: after how many steps, why, and the path so far.

    The path may end with a place where its point comes closest to its data.
    """

    depth: int
    miss: Miss
    path: Path


class Fork(NamedTuple):
    """Where the walk can go on otherwise."""

    depth: int
    options: list[Path]


class Walk:
    """The walk over the steps of an order on one workspace.

    ``modes`` has what it found, ``dead_ends`` what failed; ``gave_up`` tells that there were too many
    branches to try. With ``every`` the walk leaves out none, however far from `near`.
    """

    def __init__(self, order: Order, workspace: Workspace, every: bool = False) -> None:
        self.order, self.workspace, self.used = order, workspace, order.used()
        self.near = {p: normalised(workspace.frame, xy) for p, xy in workspace.case.near.items()}
        self.checks = _due(order)
        self.budget = (10 if every else 1) * (20_000 + 20 * len(order.steps))
        self.most = MOST_WAYS if every else MOST_MODES
        self.placed: dict[Key, Path] = {}
        self.decimals = Decimals(workspace, self.placed)
        self.modes: list[Mode] = []
        self.dead_ends: list[DeadEnd] = []
        self.gave_up = False
        self.best = math.inf
        self.every = every
        self.complete = True
        """Whether groups that only all their data together place were searched to the end."""

    def run(self) -> Walk:
        """Try every way that is not clearly farther from `near` than another."""
        forks: list[Fork] = []
        path: Path | None = START
        depth = 0
        while path is not None:
            while path is not None and depth < len(self.order.steps):
                path = self._advance(depth, path, forks)
                depth += 1
            if path is not None:
                self._arrived(path)
            if self.budget <= 0 or len(self.modes) > self.most:
                self.gave_up = bool(forks)
                break
            path, depth = self._back(forks)
        self.modes = [mode for mode in self.modes if not self._beyond(mode.path)]
        return self

    def _arrived(self, path: Path) -> None:
        """Keep a mode that no datum contradicts."""
        mode = Mode(path.steps(), dict(self.workspace.points), path)
        miss, offs = self._compared(mode)
        if miss is None:
            self.modes.append(mode._replace(offs=offs))
            self.best = min(self.best, path.off)
        else:
            self.dead_ends.append(DeadEnd(len(self.order.steps), miss, path))

    def _compared(self, mode: Mode) -> tuple[Miss | None, Mapping[Datum, float]]:
        """What data that made no points have against a mode, and how far off they are."""
        size = size_of(self.workspace, self.order.points)
        data = [d for d in self.order.facts.data if all(p in mode.points for p in d.points)]
        if self.used.issuperset(data) and agrees(self.workspace, data, size):
            return None, {}
        return compare(self.workspace, mode.steps, data, size)

    def _beyond(self, path: Path) -> bool:
        """Whether a way is clearly farther from `near` already than the best mode so far."""
        return not self.every and self.best < EVEN * EVEN * path.off

    def _advance(self, depth: int, path: Path, forks: list[Fork]) -> Path | None:
        """Run one step; None where nothing fits."""
        self.budget -= 1
        settled = self._options(depth, path, self.order.steps[depth])
        options = [option for option in settled if not self._beyond(option)]
        if not options:
            return None
        options.sort(key=lambda option: option.off)
        if len(options) > 1:
            forks.append(Fork(depth, options[1:]))
        self._take(options[0])
        return options[0]

    def _back(self, forks: list[Fork]) -> tuple[Path | None, int]:
        """Take the last fork that is still of use; None where there is none."""
        while forks:
            fork = forks.pop()
            option = fork.options[0]
            if self._beyond(option):
                continue
            if len(fork.options) > 1:
                forks.append(Fork(fork.depth, fork.options[1:]))
            self._take(option)
            return option, fork.depth + 1
        return None, 0

    def _take(self, path: Path) -> None:
        """Put a path's last step on the workspace."""
        self.workspace.points.update(path.places)
        self.placed.update(dict.fromkeys(path.places, path))

    def _options(self, depth: int, path: Path, step: Step) -> Iterator[Path]:
        """The step as it can be settled here."""
        try:
            for option in self._settled(depth, path, step):
                miss = self._ahead(path, option) or self._clash(depth)
                longer = self._longer(path, option)
                if miss is None:
                    yield longer
                else:
                    self.dead_ends.append(DeadEnd(depth, miss, longer))
        except ZeroDivisionError:
            self.dead_ends.append(DeadEnd(depth, degenerate(step, self.workspace), path))

    def _longer(self, path: Path, step: Step) -> Path:
        """The path with one more step, whose points are on the workspace."""
        places = {t: self.workspace.points[t] for t in step.targets}
        off = sum(_square(at, self.near[t]) for t, at in places.items() if t in self.near)
        return Path(path, step, path.off + off, places)

    def _settled(self, depth: int, path: Path, step: Step) -> Iterator[Step]:
        """The step with each of the branches that it has here, one after another put on the workspace."""
        close = self._close(path, step)
        if close is None:
            yield from self._put(self._branches(depth, path, step), in_doubt=False)
        elif not close:
            yield from self._put(self._branches(depth, path, step), in_doubt=True)
        else:
            miss = merged(plain(step.targets[0]), *map(plain, close[0]))
            self.dead_ends.append(DeadEnd(depth, miss, path))

    def _put(self, branches: Sequence[Step], in_doubt: bool) -> Iterator[Step]:
        """Put each branch on the workspace: by the decimals as written where floats lose too much."""
        first = branches[0] if branches else None  # the loci of all branches are the same
        doubtful = in_doubt or (isinstance(first, Meet) and _doubtful(gaps_between(first, self.workspace)))
        for branch in branches:
            question = partial(places_of, branch)
            places = self.decimals.decided(branch, question) if doubtful else None
            if places is None:
                branch.place(self.workspace)
            else:
                self.workspace.points.update(places)
            yield branch

    def _close(self, path: Path, step: Step) -> list[tuple[Key, Key]] | None:
        """The pairs of points that a step aims by and that are one place; None where none is in doubt."""
        points = self.workspace.points
        apart = {(a, b): math.dist(points[a], points[b]) for a, b in aims(step)}
        if min(apart.values(), default=1.0) > DOUBT:
            return None
        found = self.decimals.decided(step, partial(merged_pairs, step))
        return [pair for pair, d in apart.items() if d <= TOO_CLOSE] if found is None else found

    def _branches(self, depth: int, path: Path, step: Step) -> Sequence[Step]:
        if isinstance(step, Meet):
            return self._crossings(depth, path, step)
        if isinstance(step, CLOSED_FORMS):
            return [step]
        from icsolve.assembly import newton
        from icsolve.assembly.groups import Group

        assert isinstance(step, Group)
        search = newton.every if self.every else partial(newton.solutions, near=self.near)
        found = search(step, self.workspace)
        if found.miss is not None:
            self.workspace.points.update(found.closest)
            longer = self._longer(path, step) if found.closest else path
            self.dead_ends.append(DeadEnd(depth, found.miss, longer))
        self.complete &= found.complete
        return found.groups

    def _crossings(self, depth: int, path: Path, step: Meet) -> list[Step]:
        """The places where two loci meet, the one nearer to `near` first."""
        gaps = gaps_between(step, self.workspace)
        if _doubtful(gaps):
            gaps = self.decimals.decided(step, partial(gaps_between, step)) or _rounded(step, gaps)
        signs = [gap.sign for gap in gaps]
        if not is_round(step.second):
            if signs[0] != 0:
                return [step]
            miss = parallel(step, self.workspace)
        elif is_round(step.first) and signs[3] == 0:
            miss = concentric(step, self.workspace)
        elif min(signs) < 0:
            miss = too_far(step, self.workspace, [gap.value for gap in gaps])
            self.workspace.points[step.target] = _between(step, self.workspace)
            path = self._longer(path, step)
        elif min(signs) == 0:
            return [step._replace(sign=0)]
        else:
            return self._by_near(step)
        self.dead_ends.append(DeadEnd(depth, miss, path))
        return []

    def _by_near(self, step: Meet) -> list[Step]:
        near = self.near.get(step.target) if isinstance(step.target, str) else None
        sign = 1 if near is None else int(side(*step.loci(self.workspace), near))
        return [step._replace(sign=sign), step._replace(sign=-sign)]

    def _ahead(self, path: Path, step: Step) -> Miss | None:
        if not isinstance(step, Meet) or not (is_ray(step.first) or is_ray(step.second)):
            return None
        gaps = gaps_ahead(step, self.workspace)
        if min(abs(gap.value) for gap in gaps) <= DOUBT:
            exact = self.decimals.decided(step, partial(gaps_ahead_of, step))
            gaps = exact or [gap._replace(sign=int(gap.value > TOO_CLOSE)) for gap in gaps]
        worst = min(gaps, key=lambda gap: (gap.sign, gap.value))
        return None if worst.sign > 0 else behind(step, self.workspace, worst.value)

    def _clash(self, depth: int) -> Miss | None:
        for datum in self.checks.get(depth, ()):
            off, ahead = residual(self.workspace, datum)
            reach = 1.0 + max(abs(c) for p in datum.points for c in self.workspace.points[p])
            if not ahead or abs(off) > COARSE * reach:
                return clash(self.workspace, datum, off, ahead)
        return None


def _doubtful(gaps: list[Gap]) -> bool:
    """Whether floats may be wrong on whether and where two loci meet."""
    sizes = [abs(gap.value) for gap in gaps]
    return min(sizes) <= DOUBT * max(1.0, *sizes)


def _rounded(step: Meet, gaps: list[Gap]) -> list[Gap]:
    """Gaps that stay in doubt: zero where rounding explains them."""
    most = PARALLEL if not is_round(step.second) else TOUCHING * max(1.0, *(abs(gap.value) for gap in gaps))
    return [gap._replace(sign=0) if abs(gap.value) <= most else gap for gap in gaps]


def _between(step: Meet, workspace: Workspace) -> Point:
    """Where two loci that do not meet come closest: the middle between them."""
    one, two = step.loci(workspace)
    assert isinstance(two, PlacedCircle)
    (qx, qy), b = two
    if not isinstance(one, PlacedCircle):
        (px, py), (vx, vy) = one
        along = (qx - px) * vx + (qy - py) * vy
        x, y = px + along * vx, py + along * vy
        share = (1.0 + b / (math.hypot(x - qx, y - qy) or 1.0)) / 2.0
        return qx + (x - qx) * share, qy + (y - qy) * share
    (px, py), a = one
    far, over, _, d = gaps_of(one, two, workspace.arithmetic)
    # on the line of centres: between the circles, or where the one inside comes closest to the other
    along = (a + d - b) / 2.0 if far < 0.0 else (a + d + b) / 2.0 if over < 0.0 else -(a + b - d) / 2.0
    return px + along * (qx - px) / (d or 1.0), py + along * (qy - py) / (d or 1.0)


def _square(one: Point, two: Point) -> float:
    dx, dy = one[0] - two[0], one[1] - two[1]
    return float(dx * dx + dy * dy)


def _due(order: Order) -> dict[int, list[Datum]]:
    """The data to compare after each step: those whose last point it places."""
    depth = {key: i for i, step in enumerate(order.steps) for key in step.targets}
    due: dict[int, list[Datum]] = {}
    for datum in order.facts.data:
        if all(p in depth for p in datum.points):
            due.setdefault(max(depth[p] for p in datum.points), []).append(datum)
    return due


def refusal(walk: Walk) -> Miss:
    """The miss to report of a figure that does not assemble.

    Of the way that lies nearest to `near`: the deepest dead end, of these the smallest.
    """
    if walk.gave_up:
        steps = walk.order.steps
        forks = [step.target for step in steps if isinstance(step, Meet) and step.sign]
        names = ", ".join(plain(key) for key in forks if key not in walk.near)
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
    ours, theirs = _line(one), _line(two)
    at = 0
    while at < min(len(ours), len(theirs)) and ours[at] is theirs[at]:
        at += 1
    return _places(ours[at:], walk.near), _places(theirs[at:], walk.near)


def _line(path: Path) -> list[Path]:
    out: list[Path] = []
    at: Path | None = path
    while at is not None:
        out.append(at)
        at = at.before
    return out[::-1]


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
    modes = sorted(distinct(walk.modes, points), key=lambda mode: mode.path.off)
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
        gain = sum(_square(theirs[p], walk.near[p]) - _square(at, walk.near[p]) for p, at in ours.items())
        if worst is None or gain > worst[0]:
            worst = (gain, end)
    return None if worst is None else _promise(walk, chosen, worst[1])


def _promise(walk: Walk, chosen: Mode, end: DeadEnd) -> Miss:
    """What lies at `near`, why it does not assemble, and where another way lies."""
    workspace = walk.workspace
    ours, theirs = parted(walk, end.path, chosen.path)
    held = [p for p in ours if _square(ours[p], walk.near[p]) < _square(theirs[p], walk.near[p])]
    there = {p: _pair(case_point(workspace.frame, theirs[p])) for p in held[:MOST_LISTED]}
    places = listed([f"{plain(p)} at ({at})" for p, at in there.items()])
    away = measure(workspace, max(math.dist(theirs[p], walk.near[p]) for p in held))
    message = (
        f"what lies at near: does not assemble: {end.miss.message}; the figure assembles only with {places}, "
        f"{away} from near: correct the data, or move near: there if that is meant"
    )
    return Miss(end.miss.status, message, end.miss.amount)


def far_from_near(walk: Walk, chosen: Mode, points: tuple[str, ...]) -> tuple[str, ...]:
    """Notes on the points that lie farther from their `near` than half the figure."""
    workspace = walk.workspace
    half = size_of(workspace, points) / 2.0
    out = []
    for p, near in walk.near.items():
        at = chosen.points.get(p)
        if at is not None and math.dist(at, near) > half:
            out.append(
                f"near: for {plain(p)} is {measure(workspace, math.dist(at, near))} from where the data put "
                f"it, ({_pair(case_point(workspace.frame, at))}): farther than half the figure"
            )
    return tuple(out)


def distinct(modes: list[Mode], points: tuple[str, ...]) -> list[Mode]:
    """Each mode once."""
    out: list[Mode] = []
    for mode in modes:
        if not any(not differing(mode, other, points) for other in out):
            out.append(mode)
    return out


def differing(one: Mode, two: Mode, points: tuple[str, ...]) -> list[str]:
    """The points that are not in the same place in both."""
    out = []
    for p in points:
        (ax, ay), (bx, by) = one.points[p], two.points[p]
        if math.hypot(ax - bx, ay - by) > SAME * (1.0 + math.hypot(ax, ay)):
            out.append(p)
    return out


def _nearer(walk: Walk, one: Mode, two: Mode, points: tuple[str, ...]) -> bool:
    """Whether the one mode is clearly nearer to `near` where the two differ."""
    held = [p for p in differing(one, two, points) if p in walk.near]
    near: list[Point] = [walk.near[p] for p in held]
    return nearer([one.points[p] for p in held], [two.points[p] for p in held], near)


def _listing(workspace: Workspace, rivals: list[Mode], points: tuple[str, ...]) -> str:
    """The modes point by point: first the points that have a choice of their own."""
    forked = [p for p in points if any(differing(rivals[0], mode, (p,)) for mode in rivals[1:])]
    forks = [
        step.target
        for step in rivals[0].steps
        if isinstance(step, Meet) and step.sign and step.target in forked
    ] or forked
    lines = [f"{plain(p)}: {_listed(workspace, rivals, str(p))}" for p in forks]
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
            f"near: for {plain(point)} is about as far from the one as from the other; "
            "move it nearer to the one that is meant"
        )
    return f"add near: {{{plain(point)}: [{example}]}} for the one that is meant"


def _pair(at: tuple[float, float]) -> str:
    return f"{at[0]:.6g}, {at[1]:.6g}"
