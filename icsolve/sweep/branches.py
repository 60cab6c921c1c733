"""Change points: where two places of a pin meet and part again, the motion goes straight on.

The radicand under a branch's root vanishes there like a square, so the root itself goes through zero: its
sign changes. Where it only comes near zero, the branch stays; where it goes below, the mechanism cannot
assemble. The places are found on the line from the position as written to the rows.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from decimal import Decimal, localcontext

import numpy as np

from icsolve.numbers.decimals import CONTEXT
from icsolve.numbers.record import Root, live
from icsolve.numbers.replay import BLOCK, Array, code_of
from icsolve.sweep.continuation import ChangePoints, InputLine, State
from icsolve.sweep.exact_record import Unreached, exact_record, lowest, open_by, relative
from icsolve.sweep.path_tracking import PathTracker
from icsolve.sweep.program import CompiledSweep, Signs, live_roots
from icsolve.sweep.request import RequestError
from icsolve.tuples import NamedTuple, cached_property

TOUCH = 64 * 2.0**-53
"""Margins below this fraction of their terms may be zero (rounding of shapes, twice squared)."""
DOUBT = 2.0**-20
"""Of a lowest margin below this fraction of its terms more digits say whether it is zero."""
STEEP = 2.0
"""A radicand that may vanish between two places is smaller than so many of its steps there."""
POINTS = 33
ZOOMS = 10
STEPS, STEPS_A_ROW, CLOSED = 2000, 20, 4
"""Steps of a line that may lie between rows, in all and for each row; so many times as many where every
point is found by a closed form."""
CELLS = 4
MOST_CELLS = 1_000_000
"""Branches are looked for at so many places in a longest step, and at most at so many at all."""
OFF_NICE = (3.0 - math.sqrt(5.0)) / 2.0
"""So much of a step they are beside the start of the line, which is often a round number."""

LAST = ("followed", ())
"""What a record keeps the line under that was followed last: rows on it are looked for again and again."""
Remake = Callable[[Signs], CompiledSweep]


class Passing(NamedTuple):
    """What was met on a line, of the branch of a spot; places [of the main input].

    Attributes
    ----------
    touches : where its two places meet and the motion goes on to the other side: its sign changes
    gaps : where it cannot assemble in less than a row
    grazes : where its places only meet and part again on their own sides
    """

    change_points: tuple[float, ...]
    gaps: tuple[float, ...]
    grazes: tuple[float, ...] = ()


class Followed(NamedTuple):
    """A line that was followed: the compiled sweep (changing signs are inputs), its tracker, and passages."""

    compiled: CompiledSweep
    tracker: PathTracker
    passed: dict[str, Passing]


class Radicands:
    """The radicands of branches along a tracked line."""

    def __init__(self, compiled: CompiledSweep, tracker: PathTracker, grid: Array) -> None:
        self.compiled, self.tracker, self.grid = compiled, tracker, grid
        self.roots = live_roots(compiled)

    @cached_property
    def table(self) -> tuple[list[Array], list[Array]]:
        """Radicands on the grid, (places,) a root, and the smaller margin of each over its size; not a number
        where a branch before it has no place to meet."""
        nodes = [n for root in self.roots for n in (root.radicand, *root.margins[0], *root.margins[1])]
        found = self.values(nodes, self.grid) if nodes else []
        radicands, margins = [], []
        gone = np.zeros(len(self.grid), dtype=bool)
        for n in range(len(self.roots)):
            radicand, a, a_size, b, b_size = found[5 * n : 5 * n + 5]
            margin = np.minimum(_share(a, a_size), _share(b, b_size))
            radicand[gone], margin[gone] = np.nan, np.nan
            gone = gone | (margin < -TOUCH)
            radicands.append(radicand)
            margins.append(margin)
        return radicands, margins

    def values(self, nodes: Sequence[int], at: Array) -> list[Array]:
        """Nodes at places of the line.

        Parameters
        ----------
        nodes : indices
        at : (places,)

        Returns
        -------
        list[Array]
            (places,) each; not a number where the links do not assemble.
        """
        code = code_of(self.compiled.record, nodes)
        parts = []
        for start in range(0, len(at), BLOCK):
            here = at[start : start + BLOCK]
            given, good = self.tracker.given(here)
            found = [np.broadcast_to(v, len(here)).copy() for v in code.run(given, len(here))]
            for v in found:
                v[~good] = np.nan
            parts.append(found)
        return [np.concatenate(column) for column in zip(*parts, strict=True)]

    def passing(self, n: int) -> Passing:
        """Touches and gaps of a branch on the grid."""
        root, grid, radicand = self.roots[n], self.grid, self.table[0][n]
        change_points: list[float] = []
        gaps: list[float] = []
        grazes: list[float] = []
        for k in _valleys(radicand):
            low, high = grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)]
            at = self._lowest(root, low, high)
            margin = self._margin(root, at)
            if margin < 0.0:
                gaps.append(at)
            elif margin == 0.0:
                crosses = self._order(root, at, high - low) % 4 == 2
                (change_points if crosses else grazes).append(at)
        return Passing(tuple(change_points), tuple(gaps), tuple(grazes))

    def _order(self, root: Root, at: float, wide: float) -> int:
        """The order to which a radicand vanishes: the root goes through zero where half of it is odd."""
        h = max(wide / 4.0, self.tracker.line.widest / 8.0)
        values = self._radicand(root, at + h * np.array([-1.0, 1.0, -0.5, 0.5]))
        far, near = values[:2], values[2:]
        good = np.isfinite(far) & np.isfinite(near) & (far > 0.0) & (near > 0.0)
        return 2 * round(float(np.log2(far[good].sum() / near[good].sum())) / 2.0) if good.any() else 2

    def _radicand(self, root: Root, at: Array) -> Array:
        """The radicand of a branch; not a number where those before it have no place to meet."""
        record = self.compiled.record
        behind = set(live(record.nodes, [root.radicand]))
        before = [r for r in self.roots if r.node in behind]
        nodes = [n for r in before for margin in r.margins for n in margin]
        radicand, *margins = self.values([root.radicand, *nodes], at)
        for margin, size in zip(margins[::2], margins[1::2], strict=True):
            radicand[margin < -TOUCH * np.abs(size)] = np.nan
        return radicand

    def limits(self) -> tuple[float, float]:
        """The nearest places to both sides of the start to which no motion leads."""
        gone = np.zeros(len(self.grid), dtype=bool)
        for margin in self.table[1]:
            gone |= margin < -TOUCH
        apart, start, (low, high) = self.grid[gone], self.tracker.line.start, self.tracker.ends
        low = max(low, float(apart[apart < start].max(initial=-math.inf)))
        return low, min(high, float(apart[apart > start].min(initial=math.inf)))

    def _lowest(self, root: Root, low: float, high: float) -> float:
        for _ in range(ZOOMS):
            at = np.linspace(low, high, POINTS)
            values = self._radicand(root, at)
            k = int(np.argmin(np.where(np.isnan(values), np.inf, values)))
            low, high = float(at[max(k - 1, 0)]), float(at[min(k + 1, POINTS - 1)])
        return (low + high) / 2.0

    @cached_property
    def _open(self) -> Decimal:
        return open_by(self.compiled.scene.case, self.compiled.scene.frame.scale)

    def _margin(self, root: Root, at: float) -> float:
        """The smaller margin over its size where the radicand is lowest; of one that doubles leave open more
        digits say its sign, and that it is 0."""
        nodes = [n for margin in root.margins for n in margin]
        a, a_size, b, b_size = self.values(nodes, np.array([at]))
        margin = float(np.minimum(_share(a, a_size), _share(b, b_size))[0])
        if abs(margin) > DOUBT and not self.tracker.turns_over(at):
            return margin
        along = self.tracker.along(exact_record(self.compiled), [root.radicand, *nodes], at)
        with localcontext(CONTEXT), suppress(Unreached):
            found = lowest(lambda s: along(s)[0], at)
            if found is not None:
                one, one_size, two, two_size = along(found)[1:]
                more = min(relative(one, one_size), relative(two, two_size))
                return float(more) if abs(more) > self._open else 0.0
        return margin if abs(margin) > TOUCH else 0.0


def _share(margin: Array, size: Array) -> Array:
    """A margin over its size; 0 where loci of no size touch."""
    return np.divide(margin, np.abs(size), out=np.zeros_like(margin), where=size != 0.0)


def may_vanish(radicand: Array) -> bool:
    """Whether a radicand, (places,), may vanish at or between places in order."""
    step = np.abs(radicand[1:] - radicand[:-1])
    return not bool((np.minimum(radicand[1:], radicand[:-1]) > STEEP * step).all())


def _valleys(radicand: Array) -> Iterator[int]:
    """Where it is lower than on both sides, and near enough to zero that it may vanish between places."""
    radicand = np.where(np.isnan(radicand), -np.inf, radicand)
    with np.errstate(invalid="ignore"):
        step = np.abs(np.diff(radicand))
    step = np.where(np.isfinite(step), step, 0.0)
    around = np.maximum(np.concatenate([step[:1], step]), np.concatenate([step, step[-1:]]))
    beside = np.concatenate([[np.inf], radicand, [np.inf]])
    left, right = beside[:-2], beside[2:]
    valley = (radicand <= left) & (radicand <= right) & (radicand <= STEEP * around) & np.isfinite(radicand)
    last = -2
    for k in np.flatnonzero(valley & (np.minimum(left, right) > 0.0)):
        if k > last + 1:
            yield int(k)
        last = int(k)


def grid_of(ends: Iterable[float], line: InputLine) -> Array:
    """Places by which branches are looked for, (places,): from before to beyond all ends in equal steps, the
    same whichever rows there are, and none at a round number, where places of points may coincide.
    """
    step, ends = line.widest / CELLS, [line.start, *ends]
    step *= max(1, math.ceil((max(ends) - min(ends)) / step / MOST_CELLS))
    low, high = (math.floor((end - line.start) / step) for end in (min(ends), max(ends)))
    return line.start + step * (np.arange(low - 2.0, high + 4.0) + OFF_NICE)


def _refuse_long(compiled: CompiledSweep, line: InputLine, ends: Sequence[float], rows: int) -> None:
    """Raise RequestError where far more steps than rows would have to be followed one by one."""
    assert compiled.motion is not None
    steps = (max(line.start, *ends) - min(line.start, *ends)) / line.widest
    cheap = 1 if compiled.motion.groups or compiled.record.counted else CLOSED
    if steps > cheap * (STEPS + STEPS_A_ROW * rows):
        raise RequestError(
            f"the motion is followed step by step, and {steps:.3g} steps lie between these {rows} rows: "
            "take whole turns off, or ask for rows nearer to each other"
        )


def follow(remake: Remake, compiled: CompiledSweep, line: InputLine, start: State, rows: Array) -> Followed:
    """Follow a line from a state to the rows, and find where branches change.

    Parameters
    ----------
    remake : compiles the sweep with the signs of some branches as inputs
    compiled : the sweep as it is
    line : inputs by place
    start : the state where it starts
    rows : (rows,), their places on the line

    Returns
    -------
    Followed
        Rows beyond a limit are refused by nothing here: `PathTracker.given` says so of each.

    Raises
    ------
    RequestError
        Where far more steps than rows would have to be followed one by one.
    """
    ends = [float(rows.min()), float(rows.max())]
    _refuse_long(compiled, line, ends, len(rows))
    key, kept = (line, *(part.tobytes() for part in start[:2]), start.signs), compiled.record.kept
    followed: Followed
    known, reach, followed = kept.get(LAST, (None, (0.0, 0.0), None))
    if known != key or not (reach[0] <= ends[0] and ends[1] <= reach[1]):
        followed = _followed(remake, compiled, line, start, ends)
        kept[LAST] = (key, tuple(ends), followed)
    return followed


def _followed(
    remake: Remake, compiled: CompiledSweep, line: InputLine, start: State, ends: list[float]
) -> Followed:
    grid = grid_of(ends, line)
    tracker = PathTracker(compiled, line, start, ChangePoints({}), _reach(grid))
    if _has_limits(compiled, tracker, grid):
        ends += _turns_of(line)
        grid = grid_of(ends, line)
        tracker = PathTracker(compiled, line, start, ChangePoints({}), _reach(grid))
    found: dict[str, Passing] = {}
    done: set[str] = set()
    while True:
        name = _next_passing(compiled, tracker, grid, found, done)
        if name is None:
            return Followed(compiled, tracker, found)
        compiled = remake(signs_of(compiled, (n for n, p in found.items() if p.change_points)))
        places = {name: passing.change_points for name, passing in found.items() if passing.change_points}
        tracker = PathTracker(compiled, line, start, ChangePoints(places), tracker.reach)


def _next_passing(
    compiled: CompiledSweep, tracker: PathTracker, grid: Array, found: dict[str, Passing], done: set[str]
) -> str | None:
    """The next branch that changes its sign; those that were looked at are noted."""
    radicands = Radicands(compiled, tracker, grid)
    assert compiled.motion is not None
    tracker.change_points = tracker.change_points._replace(limits=radicands.limits())
    for n, root in enumerate(radicands.roots):
        name = compiled.motion.branches[root.node]
        if name in done:
            continue
        done.add(name)
        passing = radicands.passing(n)
        if any(passing):
            found[name] = passing
        if passing.change_points:
            return name
    return None


def _has_limits(compiled: CompiledSweep, tracker: PathTracker, grid: Array) -> bool:
    """Whether the line turns a link beyond where the motion leads: what lies there may be reached by
    turning it the other way round."""
    if tracker.line.period is None or not live_roots(compiled):
        return False
    return any(math.isfinite(end) for end in Radicands(compiled, tracker, grid).limits())


def _reach(grid: Array) -> tuple[float, float]:
    """From the first to the last place, (places,): a branch that changes between two rows is seen from both
    sides, whichever rows there are."""
    return float(grid[0]), float(grid[-1])


def _turns_of(line: InputLine) -> list[float]:
    """A whole turn to both sides of the start."""
    return [line.start - (line.period or 0.0), line.start + (line.period or 0.0)]


def signs_of(compiled: CompiledSweep, more: Iterable[str] = ()) -> Signs:
    """The branches whose signs are inputs of a compiled sweep, and more of them."""
    assert compiled.motion is not None
    written = compiled.motion.written
    names = {*more, *(name for name in written if name in compiled.inputs)}
    return tuple(sorted((name, written[name]) for name in names))
