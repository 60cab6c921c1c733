"""Change points on the way: where two places of a pin meet and part again, the motion goes straight on.

The radicand under a branch's root vanishes there like a square, so the root itself goes through zero: its
sign changes. Where it only comes near zero, the branch stays; where it goes below, the mechanism cannot
assemble. The places are found on the way from the position as written to the rows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from icsolve.turn.program import Sheet, Signs
from icsolve.turn.record import Root, Traced
from icsolve.turn.replay import BLOCK, Array, Code, live
from icsolve.turn.track import Track
from icsolve.turn.way import State, Way

TOUCH = 64 * 2.0**-53
"""Margins below this fraction of their terms are zero (rounding of shapes, twice squared)."""
STEEP = 2.0
"""A radicand that may vanish between two places is smaller than so many of its steps there."""
POINTS = 33
ZOOMS = 10

Remake = Callable[[Signs], Sheet]


class Passing(NamedTuple):
    """Where the branch of a spot changes (``touches``), or cannot assemble in less than a row (``gaps``)."""

    touches: tuple[float, ...]
    gaps: tuple[float, ...]


class Followed(NamedTuple):
    """A way that was followed: its sheet (changing signs are inputs), its track, what was passed."""

    sheet: Sheet
    track: Track
    passed: dict[str, Passing]


class _Radicands:
    """The radicands of branches along a track."""

    def __init__(self, sheet: Sheet, track: Track) -> None:
        self.sheet, self.track = sheet, track

    def values(self, nodes: Sequence[int], at: Array) -> list[Array]:
        """Nodes at places of the way; not a number where the links do not assemble."""
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

    def passing(self, root: Root, grid: Array) -> Passing:
        """Touches and gaps of a branch on a grid of the way."""
        (radicand,) = self.values([root.radicand], grid)
        touches, gaps = [], []
        for k in _valleys(radicand):
            low = self._lowest(root, grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)])
            margin = self._margin(root, low)
            if margin < -TOUCH:
                gaps.append(low)
            elif margin <= TOUCH:
                touches.append(low)
        return Passing(tuple(touches), tuple(gaps))

    def _lowest(self, root: Root, low: float, high: float) -> float:
        for _ in range(ZOOMS):
            at = np.linspace(low, high, POINTS)
            values = self.values([root.radicand], at)[0]
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


def grid_of(rows: Array, start: float, widest: float) -> Array:
    """The rows' places and the start in order, with places between so that no step is too wide."""
    known = np.unique(np.append(rows, start))
    steps = np.diff(known)
    between = [
        np.linspace(known[k], known[k + 1], int(steps[k] / widest) + 2)[1:-1]
        for k in np.flatnonzero(steps > widest)
    ]
    return np.unique(np.concatenate([known, *between])) if between else known


def follow(remake: Remake, sheet: Sheet, way: Way, start: State, rows: Array) -> Followed:
    """Follow a way from a state to the rows, and find where branches change.

    ``remake`` makes the sheet with the signs of some branches as inputs.
    """
    grid = grid_of(rows, way.start, way.widest)
    reach = (float(grid[0]), float(grid[-1]))
    found: dict[str, Passing] = {}
    done: set[str] = set()
    assert sheet.motion is not None
    while True:
        touches = {name: passing.touches for name, passing in found.items() if passing.touches}
        track = Track(sheet, way, start, touches, reach)
        radicands = _Radicands(sheet, track)
        for root in live_roots(sheet):
            name = sheet.motion.branches[root.node]
            if name in done:
                continue
            done.add(name)
            passing = radicands.passing(root, grid)
            if passing.touches or passing.gaps:
                found[name] = passing
            if passing.touches:
                sheet = remake(signs_of(sheet, (n for n, p in found.items() if p.touches)))
                assert sheet.motion is not None
                break
        else:
            return Followed(sheet, track, found)


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
