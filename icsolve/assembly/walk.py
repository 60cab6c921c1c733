"""The walk over the steps of a construction: every way in which it assembles, nearest places first.

Depth first. Of the modes that assemble the one with the least sum of squared distances from `near` is taken
(branch and bound: a partial sum only grows). A partial way that lies clearly nearer to `near` than that
mode, and does not go on, is a refusal: `near` is a promise.

Questions that floats leave in doubt are put to the decimals as written: the steps that lead to a doubtful
one run again on balls of more and more digits, until its signs are certain.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING

from icsolve.assembly.conditions import TOO_CLOSE, agrees, is_vague, residual, size_of
from icsolve.assembly.loci import CircleLocus, PlacedCircle, is_ray, is_round, side
from icsolve.assembly.order import Order
from icsolve.assembly.steps import CLOSED_FORMS, Meet, Miss, Step, aims, needs
from icsolve.assembly.workspace import Datum, Key, Workspace, normalised
from icsolve.numbers import Scalar
from icsolve.screws import Point
from icsolve.tuples import LateModule, NamedTuple, TypeVar

if TYPE_CHECKING:
    from icsolve.assembly import refusals
else:
    refusals = LateModule("icsolve.assembly.refusals")

T = TypeVar("T")


LONG_CHAINS = 300
"""Digits where bounds have grown along some hundred steps. Beyond, a zero is what is below 1e-40 of its terms
by these digits, each number with its own rounding alone: radii explode there that no error fills."""


class _Decision(NamedTuple):
    """A construction on balls of some digits: what put each point, and the points that these digits lose."""

    workspace: Workspace
    made: dict[Key, Path]
    lost: dict[Key, Path]


class Decimals:
    """A construction run again on balls, as far as doubtful steps need it.

    ``placed`` has for each point the step that put it. What was run stays as long as that is the same one,
    so that a chain of doubtful steps runs once.
    """

    def __init__(self, workspace: Workspace, placed: Mapping[Key, Path]) -> None:
        self.workspace, self.placed = workspace, placed
        self.runs: dict[tuple[int, float], _Decision] = {}

    def decided(self, step: Step, question: Callable[[Workspace], T]) -> T | None:
        """The answer to a question about a step; None where the digits leave it open."""
        from icsolve.numbers.balls import PRECISIONS, Balls, BelowZero, MoreDigits

        rungs = [(digits, 1.0) for digits in (*PRECISIONS, LONG_CHAINS)]
        for digits, carried in (*rungs, (LONG_CHAINS, 0.0)):
            if (digits, carried) not in self.runs:
                balls = Balls(digits, digits >= PRECISIONS[-1], carried)
                exact = Workspace(self.workspace.case, self.workspace.frame, balls)
                self.runs[digits, carried] = _Decision(exact, {}, {})
            run = self.runs[digits, carried]
            try:
                if not self._place(needs(step), run):
                    return None
                for target in step.targets:
                    run.made.pop(target, None)
                return question(run.workspace)
            except (MoreDigits, BelowZero, ZeroDivisionError):
                continue
        return None

    def _place(self, keys: Iterable[Key], run: _Decision) -> bool:
        """Put points and all that they need; False where a start of Newton's method is being tried."""
        from icsolve.numbers.balls import BelowZero, MoreDigits

        stack = [key for key in keys if run.made.get(key) is not self.placed[key]]
        while stack:
            settled = self.placed[stack[-1]]
            step = settled.step
            if step is None:
                return False
            ahead = [key for key in needs(step) if run.made.get(key) is not self.placed[key]]
            try:
                if any(run.lost.get(key) is self.placed[key] for key in (stack[-1], *ahead)):
                    raise MoreDigits
                if ahead:
                    stack += ahead
                    continue
                if run.made.get(stack[-1]) is not settled:
                    step.place(run.workspace)
                    run.made.update(dict.fromkeys(step.targets, settled))
            except (MoreDigits, BelowZero, ZeroDivisionError):
                run.lost.update({key: self.placed[key] for key in stack if self._leads(key, stack[-1])})
                raise
            stack.pop()
        return True

    def _leads(self, key: Key, lost: Key) -> bool:
        """Whether a point is the one that was lost, or needs it directly."""
        step = self.placed[key].step
        return key == lost or (step is not None and lost in needs(step))


class Gap(NamedTuple):
    """A value in floats and its sign, -1, 0 or 1."""

    sign: int
    value: float


def _gap(workspace: Workspace, value: Scalar, size: float) -> Gap:
    if value == 0.0 if type(value) is float else workspace.arithmetic.vanishes(value, size):
        return Gap(0, 0.0)
    return Gap(1 if value > 0.0 else -1, float(value))


def gaps_between(step: Meet, workspace: Workspace) -> list[Gap]:
    """What must not be negative for two loci to meet, as `gaps_of` has it."""
    loci = step.loci(workspace)
    gaps = step.gaps(workspace, *loci)
    size = sum(abs(locus.radius) for locus in loci if isinstance(locus, PlacedCircle)) + 1.0
    size = size + abs(gaps[3]) if len(gaps) > 3 else size
    return [_gap(workspace, gap, size) for gap in gaps]


def gaps_ahead(step: Meet, workspace: Workspace) -> list[Gap]:
    """How far ahead on each ray the point lies, which is in place."""
    return [_gap(workspace, value, 1.0) for value in step.ahead(workspace)]


def gaps_ahead_of(step: Meet, workspace: Workspace) -> list[Gap]:
    """How far ahead on each ray the point comes to lie."""
    step.place(workspace)
    return gaps_ahead(step, workspace)


def merged_pairs(step: Step, workspace: Workspace) -> list[tuple[Key, Key]]:
    """The pairs of points that a step aims by and that are one place."""
    out = []
    for a, b in aims(step):
        (ax, ay), (bx, by) = workspace.points[a], workspace.points[b]
        if _gap(workspace, bx - ax, 1.0).sign == 0 and _gap(workspace, by - ay, 1.0).sign == 0:
            out.append((a, b))
    return out


def places_of(step: Step, workspace: Workspace) -> dict[Key, Point]:
    """Where a step puts its points, each coordinate the nearest double."""
    from icsolve.numbers.balls import Balls

    step.place(workspace)
    balls = workspace.arithmetic
    assert isinstance(balls, Balls)
    points = workspace.points
    return {
        t: (balls.rounded(points[t][0], 1.0)[0], balls.rounded(points[t][1], 1.0)[0]) for t in step.targets
    }


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
"""A way is farther than another where their distances from `near` have less than this ratio."""
MOST_MODES = 256
MOST_WAYS = 4096
"""Ways at most where all are asked for."""
MOST_PLACED = 40_000
"""Steps at most of all these ways together: each is placed in all digits."""


class Path(NamedTuple):
    """The last step of a way so far, as it was settled; ``before`` leads to the others.

    ``off`` is the sum of the squared distances from `near` up to here, and ``least`` what it comes to at
    least in the end; ``places`` has the step's points.
    """

    before: Path | None
    step: Step | None
    off: float
    places: Mapping[Key, Point]
    least: float = 0.0

    def line(self) -> list[Path]:
        """The paths that lead here, the first one first."""
        out: list[Path] = []
        at: Path | None = self
        while at is not None:
            out.append(at)
            at = at.before
        return out[::-1]

    def steps(self) -> tuple[Step, ...]:
        """All steps, the first one first."""
        return tuple(path.step for path in self.line() if path.step is not None)


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
        self.order, self.workspace, self.used = order, workspace, order.used
        self.near = {p: normalised(workspace.frame, xy) for p, xy in workspace.case.near.items()}
        self.checks = order.due
        self.budget = (10 if every else 1) * (20_000 + 20 * len(order.steps))
        self.most = min(MOST_WAYS, MOST_PLACED // max(len(order.steps), 1)) if every else MOST_MODES
        self.placed: dict[Key, Path] = {}
        self.decimals = Decimals(workspace, self.placed)
        self.modes: list[Mode] = []
        self.dead_ends: list[DeadEnd] = []
        self.gave_up = False
        self.best = math.inf
        self.every = every
        self.complete = True
        self.in_line: dict[str, None] = {}
        """sentences on points that lengths put in line but for their last digits"""
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
        return refusals.compare(self.workspace, mode.steps, data, size)

    def _beyond(self, path: Path) -> bool:
        """Whether a way is clearly farther from `near` already than the best mode so far."""
        return not self.every and self.best < EVEN * EVEN * path.least

    def _advance(self, depth: int, path: Path, forks: list[Fork]) -> Path | None:
        """Run one step; None where nothing fits."""
        self.budget -= 1
        settled = self._options(depth, path, self.order.steps[depth])
        options = [option for option in settled if not self._beyond(option)]
        if not options:
            return None
        options.sort(key=lambda option: (option.least, option.off))
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
                miss = self._ahead(option) or self._clash(depth)
                longer = self._longer(path, option)
                if miss is None:
                    yield longer
                else:
                    self.dead_ends.append(DeadEnd(depth, miss, longer))
        except ZeroDivisionError:
            self.dead_ends.append(DeadEnd(depth, refusals.degenerate(step, self.workspace), path))

    def _longer(self, path: Path, step: Step) -> Path:
        """The path with one more step, whose points are on the workspace."""
        places = {t: self.workspace.points[t] for t in step.targets}
        off = path.off + sum(squared_distance(at, self.near[t]) for t, at in places.items() if t in self.near)
        longer = Path(path, step, off, places, max(path.least, off))
        if isinstance(step, Meet) and step.sign and isinstance(step.target, tuple) and self.near:
            return longer._replace(least=max(longer.least, self._off_of_shape(longer, step.target[0])))
        return longer

    def _off_of_shape(self, path: Path, cluster: int) -> float:
        """The least sum of squared distances from `near` that a cluster's points have wherever it is put."""
        here = {key[1]: at for one in path.line() for key, at in one.places.items() if key[0] == cluster}
        held = [p for p in here if p in self.near and p in self.order.points]
        shape, near = ([complex(*at[p]) for p in held] for at in (here, self.near))
        return misfit_of_shapes(shape, near)

    def _settled(self, depth: int, path: Path, step: Step) -> Iterator[Step]:
        """The step with each of the branches that it has here, one after another put on the workspace."""
        close = self._close(step)
        if close:
            miss = refusals.merged(refusals.plain(step.targets[0]), *map(refusals.plain, close[0]))
            self.dead_ends.append(DeadEnd(depth, miss, path))
            return
        branches, doubtful = self._branches(depth, path, step)
        for branch in branches:
            places = None
            if doubtful or close is not None:  # by the decimals as written where floats lose too much
                places = self.decimals.decided(branch, partial(places_of, branch))
            if places is None:
                branch.place(self.workspace)
            else:
                self.workspace.points.update(places)
            yield branch

    def _close(self, step: Step) -> list[tuple[Key, Key]] | None:
        """The pairs of points that a step aims by and that are one place; None where none is in doubt."""
        points = self.workspace.points
        apart = {(a, b): math.dist(points[a], points[b]) for a, b in aims(step)}
        if min(apart.values(), default=1.0) > DOUBT:
            return None
        found = self.decimals.decided(step, partial(merged_pairs, step))
        return [pair for pair, d in apart.items() if d <= TOO_CLOSE] if found is None else found

    def _branches(self, depth: int, path: Path, step: Step) -> tuple[Sequence[Step], bool]:
        """The branches of a step, and whether floats may lose where they lie."""
        if isinstance(step, Meet):
            return self._crossings(depth, path, step)
        if isinstance(step, CLOSED_FORMS):
            return [step], False
        from icsolve.assembly import newton, point_groups

        step = point_groups.with_points_in_line(step, partial(self._detour, step))
        search = newton.every if self.every else partial(newton.solutions, near=self.near)
        found = search(step, self.workspace)
        if found.miss is not None:
            self.workspace.points.update(found.closest)
            longer = self._longer(path, step) if found.closest else path
            self.dead_ends.append(DeadEnd(depth, found.miss, longer))
        self.complete &= found.complete
        return found.groups, False

    def _detour(self, step: Step, a: Datum, b: Datum, c: Datum) -> int:
        """The sign of two lengths less a third, by the decimals as written."""

        def less(workspace: Workspace) -> Gap:
            sizes = [workspace.length(datum) for datum in (a, b, c)]
            return _gap(workspace, sizes[0] + sizes[1] - sizes[2], sum(sizes))

        gap = less(self.workspace)
        if abs(gap.value) > DOUBT * float(self.workspace.length(c)):
            return gap.sign
        exact = self.decimals.decided(step, less)
        sign = gap.sign if exact is None else exact.sign
        return 0 if sign and self._in_line((a, b, c)) else sign

    def _all_but_flat(self, step: Meet) -> bool:
        """Whether a triangle that moves as a whole is flat but for the last digits of its lengths."""
        circles = [locus for locus in (step.first, step.second) if isinstance(locus, CircleLocus)]
        sides = [span for span in (step.apart, *(one.radius for one in circles)) if isinstance(span, Datum)]
        return len(sides) == 3 and self._in_line(sides)

    def _in_line(self, sides: Sequence[Datum]) -> bool:
        """Whether half units of the last digits of three lengths, as programs write them, explain that two of
        them are not as long as the third."""
        from icsolve.numbers.balls import PRECISIONS, HalfUnits, MoreDigits

        balls = HalfUnits(PRECISIONS[0])
        exact = Workspace(self.workspace.case, self.workspace.frame, balls)
        *short, long = sorted(map(exact.length, sides), key=float)
        gap = short[0] + short[1] - long
        try:
            explained = balls.vanishes(gap, float(long)) and float(gap) != 0.0
        except MoreDigits:
            return False
        if explained:
            self.in_line[refusals.all_but_in_line(exact, sides, abs(float(gap)))] = None
        return explained

    def _crossings(self, depth: int, path: Path, step: Meet) -> tuple[list[Step], bool]:
        """The places where two loci meet, the one nearer to `near` first; whether floats may lose them."""
        gaps = gaps_between(step, self.workspace)
        if doubtful := _doubtful(gaps):
            gaps = self.decimals.decided(step, partial(gaps_between, step)) or _rounded(step, gaps)
        signs = [gap.sign for gap in gaps]
        if doubtful and (min(signs) < 0 or step.target not in self.near) and self._all_but_flat(step):
            return [step._replace(sign=0)], doubtful
        if not is_round(step.second):
            if signs[0] != 0:
                return [step], doubtful
            miss = refusals.parallel(step, self.workspace)
        elif is_round(step.first) and signs[3] == 0:
            miss = refusals.concentric(step, self.workspace)
        elif min(signs) < 0:
            miss = refusals.too_far(step, self.workspace, [gap.value for gap in gaps])
            self.workspace.points[step.target] = _middle_of_gap(step, self.workspace)
            path = self._longer(path, step)
        elif min(signs) == 0:
            return [step._replace(sign=0)], doubtful
        else:
            return self._by_near(step), doubtful
        self.dead_ends.append(DeadEnd(depth, miss, path))
        return [], doubtful

    def _by_near(self, step: Meet) -> list[Step]:
        near = self.near.get(step.target) if isinstance(step.target, str) else None
        sign = 1 if near is None else int(side(*step.loci(self.workspace), near))
        return [step._replace(sign=sign), step._replace(sign=-sign)]

    def _ahead(self, step: Step) -> Miss | None:
        if not isinstance(step, Meet) or not (is_ray(step.first) or is_ray(step.second)):
            return None
        gaps = gaps_ahead(step, self.workspace)
        if min(abs(gap.value) for gap in gaps) <= DOUBT:
            exact = self.decimals.decided(step, partial(gaps_ahead_of, step))
            gaps = exact or [gap._replace(sign=int(gap.value > TOO_CLOSE)) for gap in gaps]
        worst = min(gaps, key=lambda gap: (gap.sign, gap.value))
        return None if worst.sign > 0 else refusals.behind(step, self.workspace, worst.value)

    def _clash(self, depth: int) -> Miss | None:
        for datum in self.checks.get(depth, ()):
            if is_vague(self.workspace, datum):
                continue
            off, ahead = residual(self.workspace, datum)
            reach = 1.0 + max(abs(c) for p in datum.points for c in self.workspace.points[p])
            if not ahead or abs(off) > COARSE * reach:
                return refusals.clash(self.workspace, datum, off, ahead)
        return None


def _doubtful(gaps: list[Gap]) -> bool:
    """Whether floats may be wrong on whether and where two loci meet."""
    sizes = [abs(gap.value) for gap in gaps]
    return min(sizes) <= DOUBT * max(1.0, *sizes)


def _rounded(step: Meet, gaps: list[Gap]) -> list[Gap]:
    """Gaps that stay in doubt: zero where rounding explains them."""
    most = PARALLEL if not is_round(step.second) else TOUCHING * max(1.0, *(abs(gap.value) for gap in gaps))
    return [gap._replace(sign=0) if abs(gap.value) <= most else gap for gap in gaps]


def _middle_of_gap(step: Meet, workspace: Workspace) -> Point:
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
    far, over, _, d = step.gaps(workspace, one, two)
    # on the line of centres: between the circles, or where the one inside comes closest to the other
    along = (a + d - b) / 2.0 if far < 0.0 else (a + d + b) / 2.0 if over < 0.0 else -(a + b - d) / 2.0
    return px + along * (qx - px) / (d or 1.0), py + along * (qy - py) / (d or 1.0)


def misfit_of_shapes(one: Sequence[complex], two: Sequence[complex]) -> float:
    """The least sum of squared distances between the points of two shapes, one of them moved as a whole: a
    lower bound of it, by what rounding may add."""
    if len(one) < 3:
        return 0.0
    first, second = ([z - sum(shape) / len(shape) for z in shape] for shape in (one, two))
    sizes = sum(abs(z) ** 2 for z in (*first, *second))
    fit = abs(sum(z.conjugate() * w for z, w in zip(first, second, strict=True)))
    return max(0.0, sizes - 2.0 * fit - 8.0 * len(one) * U * (sizes + sum(abs(z) ** 2 for z in (*one, *two))))


def squared_distance(one: Point, two: Point) -> float:
    """Of two points."""
    dx, dy = one[0] - two[0], one[1] - two[1]
    return float(dx * dx + dy * dy)
