"""Change points on the way: where two places of a pin meet and part again, the motion goes straight on.

The radicand under a branch's root vanishes there like a square, so the root itself goes through zero: its
sign changes. Where it only comes near zero, the branch stays; where it goes below, the mechanism cannot
assemble. The places are found on the way from the position as written to the rows.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np

from icsolve.numbers.record import Root, Traced
from icsolve.numbers.replay import BLOCK, Array, Code, live
from icsolve.sweep.ask import AskError
from icsolve.sweep.program import Sheet, Signs
from icsolve.sweep.track import Track
from icsolve.sweep.way import State, Touches, Way

TOUCH = 64 * 2.0**-53
"""Margins below this fraction of their terms are zero (rounding of shapes, twice squared)."""
STEEP = 2.0
"""A radicand that may vanish between two places is smaller than so many of its steps there."""
POINTS = 33
ZOOMS = 10
PAST = 0.125
"""A way is followed beyond its last place by this part of its longest step."""
STEPS, STEPS_A_ROW, CLOSED = 2000, 20, 4
"""Steps of a way that may lie between rows, in all and for each row; so many times as many where every
point is found by a closed form."""
CELLS = 4
MOST_CELLS = 1_000_000
"""Branches are looked for at so many places in a longest step, and at most at so many at all."""

Remake = Callable[[Signs], Sheet]


class Passing(NamedTuple):
    """What was met on a way, of the branch of a spot; places [of the main input].

    Attributes
    ----------
    touches : where its two places meet and the motion goes on to the other side: its sign changes
    gaps : where it cannot assemble in less than a row
    grazes : where its places only meet and part again on their own sides
    """

    touches: tuple[float, ...]
    gaps: tuple[float, ...]
    grazes: tuple[float, ...] = ()


class Followed(NamedTuple):
    """A way that was followed: its sheet (changing signs are inputs), its track, what was passed."""

    sheet: Sheet
    track: Track
    passed: dict[str, Passing]


class Radicands:
    """The radicands of branches along a track."""

    def __init__(self, sheet: Sheet, track: Track, grid: Array) -> None:
        self.sheet, self.track, self.grid = sheet, track, grid
        self.roots = live_roots(sheet)

    @cached_property
    def table(self) -> tuple[list[Array], list[Array]]:
        """Radicands on the grid, and the smaller margin of each over its size; not a number where a branch
        before it has no place to meet."""
        nodes = [n for root in self.roots for n in (root.radicand, *root.margins[0], *root.margins[1])]
        found = self.values(nodes, self.grid) if nodes else []
        radicands, margins = [], []
        gone = np.zeros(len(self.grid), dtype=bool)
        for n in range(len(self.roots)):
            radicand, a, a_size, b, b_size = found[5 * n : 5 * n + 5]
            margin = np.minimum(a / a_size, b / b_size)
            radicand[gone], margin[gone] = np.nan, np.nan
            gone = gone | ~(margin >= -TOUCH)
            radicands.append(radicand)
            margins.append(margin)
        return radicands, margins

    def values(self, nodes: Sequence[int], at: Array) -> list[Array]:
        """Nodes at places of the way.

        Parameters
        ----------
        nodes : indices
        at : (places,)

        Returns
        -------
        list[Array]
            (places,) each; not a number where the links do not assemble.
        """
        code = Code(self.sheet.record, nodes)
        parts = []
        for start in range(0, len(at), BLOCK):
            here = at[start : start + BLOCK]
            given, good = self.track.given(here)
            found = [np.broadcast_to(v, len(here)).copy() for v in code.run(given, len(here))]
            for v in found:
                v[~good] = np.nan
            parts.append(found)
        return [np.concatenate(column) for column in zip(*parts, strict=True)]

    @property
    def touching(self) -> bool:
        """Whether a branch may come to change points, or have no place to meet, somewhere on the grid."""
        for radicand in self.table[0]:
            step = np.abs(np.diff(radicand, append=radicand[-1]))
            if not (radicand > STEEP * np.maximum(step, np.roll(step, 1))).all():
                return True
        return False

    def passing(self, n: int) -> Passing:
        """Touches and gaps of a branch on the grid."""
        root, grid, radicand = self.roots[n], self.grid, self.table[0][n]
        touches: list[float] = []
        gaps: list[float] = []
        grazes: list[float] = []
        for k in _valleys(radicand):
            low, high = grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)]
            at = self._lowest(root, low, high)
            margin = self._margin(root, at)
            if margin < -TOUCH:
                gaps.append(at)
            elif margin <= TOUCH:
                crosses = self._order(root, at, high - low) % 4 == 2
                (touches if crosses else grazes).append(at)
        return Passing(tuple(touches), tuple(gaps), tuple(grazes))

    def _order(self, root: Root, at: float, wide: float) -> int:
        """The order to which a radicand vanishes: the root goes through zero where half of it is odd."""
        h = max(wide / 4.0, self.track.way.widest / 8.0)
        values = self._radicand(root, at + h * np.array([-1.0, 1.0, -0.5, 0.5]))
        far, near = values[:2], values[2:]
        good = np.isfinite(far) & np.isfinite(near) & (far > 0.0) & (near > 0.0)
        return 2 * round(float(np.log2(far[good].sum() / near[good].sum())) / 2.0) if good.any() else 2

    def _radicand(self, root: Root, at: Array) -> Array:
        """The radicand of a branch; not a number where those before it have no place to meet."""
        record = self.sheet.record
        behind = set(live(record, [root.radicand], ()))
        before = [r for r in self.roots if r.node in behind]
        nodes = [n for r in before for margin in r.margins for n in margin]
        radicand, *margins = self.values([root.radicand, *nodes], at)
        for margin, size in zip(margins[::2], margins[1::2], strict=True):
            radicand[margin < -TOUCH * size] = np.nan
        return radicand

    def limits(self) -> tuple[float, float]:
        """The nearest places to both sides of the start to which no motion leads."""
        gone = np.zeros(len(self.grid), dtype=bool)
        for margin in self.table[1]:
            gone |= ~(margin >= -TOUCH)
        apart, start, (low, high) = self.grid[gone], self.track.way.start, self.track.ends
        low = max(low, float(apart[apart < start].max(initial=-math.inf)))
        return low, min(high, float(apart[apart > start].min(initial=math.inf)))

    def _lowest(self, root: Root, low: float, high: float) -> float:
        for _ in range(ZOOMS):
            at = np.linspace(low, high, POINTS)
            values = self._radicand(root, at)
            k = int(np.argmin(np.where(np.isnan(values), np.inf, values)))
            low, high = float(at[max(k - 1, 0)]), float(at[min(k + 1, POINTS - 1)])
        return (low + high) / 2.0

    def _margin(self, root: Root, at: float) -> float:
        """The smaller margin over its size."""
        nodes = [n for margin in root.margins for n in margin]
        a, a_size, b, b_size = (float(v[0]) for v in self.values(nodes, np.array([at])))
        return min(a / a_size, b / b_size)


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


def grid_of(ends: Iterable[float], way: Way) -> Array:
    """Places by which branches are looked for, (places,): from the start of the way to beyond all ends in
    equal steps, the same whichever rows there are.
    """
    step, ends = way.widest / CELLS, [way.start, *ends]
    step *= max(1, math.ceil((max(ends) - min(ends)) / step / MOST_CELLS))
    low, high = (math.floor((end - way.start) / step) for end in (min(ends), max(ends)))
    return np.asarray(way.start + step * np.arange(low - 2, high + 4), dtype=np.float64)


def _refuse_long(sheet: Sheet, way: Way, ends: Sequence[float], rows: int) -> None:
    """Raise AskError where far more steps than rows would have to be followed one by one."""
    assert sheet.motion is not None
    steps = (max(way.start, *ends) - min(way.start, *ends)) / way.widest
    cheap = 1 if sheet.motion.groups or sheet.record.counted else CLOSED
    if steps > cheap * (STEPS + STEPS_A_ROW * rows):
        raise AskError(
            f"the motion is followed step by step, and {steps:.3g} steps lie between these {rows} rows: "
            "take whole turns off, or ask for rows nearer to each other"
        )


def follow(remake: Remake, sheet: Sheet, way: Way, start: State, rows: Array) -> Followed:
    """Follow a way from a state to the rows, and find where branches change.

    Parameters
    ----------
    remake : makes the sheet with the signs of some branches as inputs
    sheet : the sheet as it is
    way : inputs by place
    start : the state where it starts
    rows : (rows,), their places on the way

    Returns
    -------
    Followed
        Rows beyond a limit are refused by nothing here: `Track.given` says so of each.

    Raises
    ------
    AskError
        Where far more steps than rows would have to be followed one by one.
    """
    ends = [float(rows.min()), float(rows.max())]
    _refuse_long(sheet, way, ends, len(rows))
    grid = grid_of(ends, way)
    track = Track(sheet, way, start, Touches({}), _reach(ends, way))
    if _has_limits(sheet, track, grid):
        ends += _turns_of(way)
        grid = grid_of(ends, way)
        track = Track(sheet, way, start, Touches({}), _reach(ends, way))
    found: dict[str, Passing] = {}
    done: set[str] = set()
    while True:
        name = _next_passing(sheet, track, grid, found, done)
        if name is None:
            return Followed(sheet, track, found)
        sheet = remake(signs_of(sheet, (n for n, p in found.items() if p.touches)))
        places = {name: passing.touches for name, passing in found.items() if passing.touches}
        track = Track(sheet, way, start, Touches(places), track.reach)


def _next_passing(
    sheet: Sheet, track: Track, grid: Array, found: dict[str, Passing], done: set[str]
) -> str | None:
    """The next branch that changes its sign; those that were looked at are noted."""
    radicands = Radicands(sheet, track, grid)
    assert sheet.motion is not None
    if track.way.period is not None:
        track.touches = track.touches._replace(limits=radicands.limits())
    for n, root in enumerate(radicands.roots):
        name = sheet.motion.branches[root.node]
        if name in done:
            continue
        done.add(name)
        passing = radicands.passing(n)
        if any(passing):
            found[name] = passing
        if passing.touches:
            return name
    return None


def _has_limits(sheet: Sheet, track: Track, grid: Array) -> bool:
    """Whether the way turns a link beyond where the motion leads: what lies there may be reached by
    turning it the other way round."""
    if track.way.period is None or not live_roots(sheet):
        return False
    return any(math.isfinite(end) for end in Radicands(sheet, track, grid).limits())


def _reach(ends: Iterable[float], way: Way) -> tuple[float, float]:
    """From the first to the last place and a little beyond, so that none is at the very end of the way."""
    ends = [way.start, *ends]
    return min(ends) - PAST * way.widest, max(ends) + PAST * way.widest


def _turns_of(way: Way) -> list[float]:
    """A whole turn to both sides of the start."""
    return [way.start - (way.period or 0.0), way.start + (way.period or 0.0)]


def signs_of(sheet: Sheet, more: Iterable[str] = ()) -> Signs:
    """The branches whose signs are inputs of a sheet, and more of them."""
    assert sheet.motion is not None
    written = sheet.motion.written
    names = {*more, *(name for name in written if name in sheet.inputs)}
    return tuple(sorted((name, written[name]) for name in names))


def live_roots(sheet: Sheet) -> list[Root]:
    """The branches that bear on what is asked, in order."""
    record, groups = sheet.record, sheet.motion.groups if sheet.motion else ()
    stack = [v.index for values in sheet.outputs.values() for v in values if isinstance(v, Traced) and v.row]
    alive: set[int] = set()
    while stack:
        alive.update(live(record, stack, ()))
        used = [group for group in groups if alive.intersection(group.solved)]
        parts = [v for g in used for v in (*g.residuals, *(v for row in g.derivatives for v in row))]
        stack = [v.index for v in parts if isinstance(v, Traced) and v.row and v.index not in alive]
    return [record.roots[k] for k in sorted(alive) if k in record.roots]
