"""Which rows of a sweep are run together, and along which line their inputs are followed.

Most rows can be run at once: no branch comes near a change point on the way to them. The others are
followed from the position as written, the main input last.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from icsolve.case import is_angle
from icsolve.numbers.intervals import enclose_one
from icsolve.numbers.record import Op
from icsolve.numbers.replay import BLOCK, Array, Mask, code_of
from icsolve.sweep.branches import (
    MOST_CELLS,
    STEEP,
    Followed,
    follow,
    grid_of,
    may_vanish,
    signs_of,
)
from icsolve.sweep.continuation import InputLine, State, written_state
from icsolve.sweep.path_tracking import PathTracker
from icsolve.sweep.program import CompiledSweep, Signs, live_roots
from icsolve.sweep.record_runner import Rows, Runner
from icsolve.sweep.request import Columns
from icsolve.sweep.starting_position import Start
from icsolve.sweep.varied_numbers import number_at
from icsolve.tuples import NamedTuple

WIDEST = 4.0
"""Longest step of a line along an angle, degrees."""
PART = 2.0**-7
"""Longest step of a line along a length, as a part of the figure's size."""
CLEAR = "clear"
"""Under this a record keeps from where to where its branches are known to meet nothing."""
SAME_FIGURE = 1e-9
"""What branches hang on differs by less, in a frame of size 1, where two figures are the same."""
GLANCES = 96
"""Places on the straight line to a row at which its branches are glanced at."""


class SweepPart(NamedTuple):
    """Rows that are run together.

    Attributes
    ----------
    runner : of a compiled sweep in which the branches that change are inputs
    rows : (n,), their indices in the sweep
    followed : the line along which they are followed, if they are
    places : (n,), where on it they lie
    ordered : whether these are all rows in their order
    """

    runner: Runner
    rows: Rows
    followed: Followed | None = None
    places: Array = np.empty(0)
    ordered: bool = False
    """whether these are all rows in their order"""

    def some(self, which: Rows) -> SweepPart:
        """Some of its rows, by their places among them, (some,)."""
        return self._replace(
            rows=self.rows[which],
            places=self.places[which] if self.followed else self.places,
            ordered=False,
        )


class SweepParts:
    """The rows of a sweep in parts."""

    def __init__(self, start: Start, columns: Columns) -> None:
        self.start, self.columns = start, columns
        self.arrays, self.runner = columns.arrays, start.runner()
        self.bearing = [name for name in self.runner.bearing if name in self.arrays]
        """the varied inputs on which branches, groups and counted turns hang"""

    def given(self, part: SweepPart) -> tuple[dict[int, Array], Mask]:
        """The inputs of a part's rows.

        Returns
        -------
        tuple[dict[int, Array], Mask]
            By node, (n,) each; and which of the rows are reached along their line, (n,).
        """
        inputs = part.runner.compiled.inputs
        every = slice(None) if part.ordered else part.rows
        given = {inputs[name]: a[every] for name, a in self.arrays.items() if name in inputs}
        if part.followed is None:
            return given, np.ones(len(part.rows), dtype=bool)
        along, good = part.followed.tracker.given(part.places)
        return {**along, **given}, good

    def all(self) -> Iterator[SweepPart]:
        """Every row in some part."""
        runner, rows = self.runner, np.arange(self.columns.rows)
        compiled = runner.compiled
        if not self.bearing:
            yield SweepPart(runner, rows, ordered=True)
            return
        main, others = self._main(self.bearing)
        at_once, left = (None, rows) if runner.sequential else self._at_once(runner, rows, main, others)
        if at_once is not None:
            yield at_once
        for alike in self._alike(left, others):
            yield self._followed(compiled, main, others, alike)

    def _main(self, bearing: list[str]) -> tuple[str, list[str]]:
        """The input that goes to its values last, and the others."""
        moving = (*self.start.links, *self.start.setting.drive.moving)
        main = next(name for name in (*moving, *bearing) if name in bearing)
        return main, [name for name in bearing if name != main]

    def straight(self, row: int) -> SweepPart | None:
        """A row that is reached with all inputs going to its values at once; None where groups do not lead
        there so."""
        compiled = self.runner.compiled
        main, others = self._main(self.bearing)
        here = {name: float(self.arrays[name][row]) for name in (main, *others)}
        found = self._all_at_once(compiled, here, written_state(compiled))
        if not found.unbroken(0.0, 1.0):
            return None
        place = here.pop(main)
        line = self._way(compiled, main, here)._replace(start=place)
        return self._on(line, found.end(1.0), np.array([row]), np.array([place]))

    def whole(self) -> SweepPart:
        """All rows in one part, along their line, where one number varies."""
        runner = self.runner
        bearing, rows = self.bearing, np.arange(self.columns.rows)
        if not bearing:
            return SweepPart(runner, rows)
        main = max(bearing, key=lambda name: float(np.ptp(self.arrays[name])))
        return self._followed(runner.compiled, main, [name for name in bearing if name != main], rows)

    # --- at once ----------------------------------------------------------------------------------

    def _at_once(
        self, runner: Runner, rows: Rows, main: str, others: list[str]
    ) -> tuple[SweepPart | None, Rows]:
        """What can be run at once, and the rows that are left."""
        if others:
            clear = self._clear(runner.compiled, main, others)
            return (SweepPart(runner, rows[clear]) if clear.any() else None), rows[~clear]
        if self._meets_nothing(runner, main):
            return SweepPart(runner, rows, ordered=True), rows[:0]
        return None, rows

    def _meets_nothing(self, runner: Runner, main: str) -> bool:
        """Whether no branch comes near a change point or a limit between the position as written and the
        rows, all of which can then be run at once."""
        record, at, start = runner.compiled.record, self.arrays[main], self._written(main)
        radicands = tuple([root.radicand for root in runner.roots])
        low, high = min(float(at.min()), start), max(float(at.max()), start)
        least, most = record.kept.get((f"{CLEAR} {main}", radicands), (math.inf, -math.inf))
        if least <= low and high <= most:
            return True  # as is known
        way = {runner.compiled.inputs[main]: (low, high)}
        if not all(enclose_one(record.nodes, radicand, way)[0] > 0.0 for radicand in radicands):
            grid = grid_of([low, high], self._way(runner.compiled, main, {}))
            if not self._glanced(runner.compiled, main, radicands, grid):
                return False
            if len(grid) >= MOST_CELLS:  # it is coarser than that of fewer rows
                return True
        record.kept[f"{CLEAR} {main}", radicands] = (min(least, low), max(most, high))
        return True

    def _glanced(self, compiled: CompiledSweep, main: str, radicands: Sequence[int], grid: Array) -> bool:
        """Whether radicands show no sign of a zero at or between places in order, (places,)."""
        code, node = code_of(compiled.record, radicands), compiled.inputs[main]
        for first in range(0, len(grid) - 1, BLOCK):
            here = grid[first : first + BLOCK + 1]
            if any(map(may_vanish, code.run({node: here}, len(here)))):
                return False
        return True

    def _clear(self, compiled: CompiledSweep, main: str, others: list[str]) -> Mask:
        """Rows on whose line from the position as written no branch comes near a change point.

        First the other inputs go to their values, then the main one over all of its own: rows that share the
        other values share the line. Where few do, each row is looked at on the straight line to it.
        """
        values, start = self.arrays[main], self._written(main)
        grid = grid_of([start, float(values.min()), float(values.max())], self._way(compiled, main, {}))
        sets, which = distinct_rows(np.stack([self.arrays[name] for name in others], axis=1))
        share, whole = np.linspace(0.0, 1.0, GLANCES), np.ones(len(grid))
        if len(sets) * (GLANCES + len(grid)) > len(values) * GLANCES:
            every = np.column_stack([*(self.arrays[name] for name in others), values])
            return self._unbroken(compiled, [*others, main], every, share)
        mains = np.full((len(sets), 1), start)
        first = self._unbroken(compiled, [*others, main], np.hstack([sets, mains]), share)
        then = self._unbroken(compiled, others, sets, whole, {compiled.inputs[main]: grid})
        return np.asarray((first & then)[which])

    def _unbroken(
        self,
        compiled: CompiledSweep,
        names: list[str],
        sets: Array,
        share: Array,
        along: dict[int, Array] | None = None,
    ) -> Mask:
        """Which sets of numbers lead away from no branch, where these shares reach them from those as
        written (and other inputs go along)."""
        code = code_of(compiled.record, [root.radicand for root in live_roots(compiled)])
        clear = np.ones(len(sets), dtype=bool)
        step = max(1, 4 * BLOCK // len(share))
        for start in range(0, len(sets), step):
            some = sets[start : start + step]
            given = {k: np.tile(values, len(some)) for k, values in (along or {}).items()}
            for n, name in enumerate(names):
                written = self._written(name)
                given[compiled.inputs[name]] = (written + (some[:, n : n + 1] - written) * share).ravel()
            for found in code.run(given, len(some) * len(share)):
                radicand = np.broadcast_to(found, len(some) * len(share)).reshape(len(some), -1)
                steps = np.abs(np.diff(radicand, axis=1)).max(axis=1)
                clear[start : start + step] &= radicand.min(axis=1) > STEEP * steps
        return clear

    # --- followed ---------------------------------------------------------------------------------

    def _alike(self, rows: Rows, others: list[str]) -> Iterator[Rows]:
        """Rows that differ in the main input only."""
        if not others or not len(rows):
            if len(rows):
                yield rows
            return
        which = distinct_rows(np.stack([self.arrays[name][rows] for name in others], axis=1))[1]
        order = np.argsort(which, kind="stable")
        yield from (rows[part] for part in np.split(order, np.flatnonzero(np.diff(which[order])) + 1))

    def _written(self, name: str) -> float:
        """An input's value as written; a link turned from there starts at zero."""
        return 0.0 if name in self.start.links else number_at(self.start.case, name).value

    def _is_angle(self, name: str) -> bool:
        return name in self.start.links or is_angle(name)

    def _followed(self, compiled: CompiledSweep, main: str, others: list[str], rows: Rows) -> SweepPart:
        """Rows along one line: first the other inputs go to their values, then the main one."""
        state = written_state(compiled)
        here = {name: float(self.arrays[name][rows[0]]) for name in others}
        if any(value != self._written(name) for name, value in here.items()):
            state = self._all_at_once(compiled, here, state).end(1.0)
        return self._on(self._way(compiled, main, here), state, rows, self.arrays[main][rows])

    def _all_at_once(self, compiled: CompiledSweep, here: dict[str, float], state: State) -> PathTracker:
        """The way on which some inputs go from their values as written (0) to others (1) at once."""
        base = {name: self._written(name) for name in compiled.inputs if name in self.arrays}
        slope = {name: value - base[name] for name, value in here.items()}
        line = InputLine(base, slope, 0.0, 2.0**-6)
        return follow(self.start.compiled, compiled, line, state, np.array([1.0])).tracker

    def _on(self, line: InputLine, state: State, rows: Rows, places: Array) -> SweepPart:
        """Rows at places of a line of the main input, from a state."""
        changed = _changed(self.runner.compiled, state)
        followed = follow(self.start.compiled, self.start.compiled(changed), line, state, places)
        return SweepPart(self.start.runner(signs_of(followed.compiled)), rows, followed, places)

    def _way(self, compiled: CompiledSweep, main: str, here: dict[str, float]) -> InputLine:
        """The line of the main input, the others being at some values, or as written."""
        angle = self._is_angle(main)
        widest = WIDEST if angle else PART / self.start.setting.figure.frame.scale
        base = {name: self._written(name) for name in compiled.inputs if name in self.arrays}
        base = {**base, **here, main: 0.0}
        turns = angle and comes_round(compiled, compiled.inputs[main])
        return InputLine(base, {main: 1.0}, self._written(main), widest, 360.0 if turns else None)


def comes_round(compiled: CompiledSweep, angle: int) -> bool:
    """Whether a whole turn of an input leads back to the same figure: a wheel that rolls is further on then,
    and one that it meshes with is turned otherwise."""
    record = compiled.record
    groups = compiled.motion.groups if compiled.motion is not None else ()
    places = [root.radicand for root in live_roots(compiled)]
    places += [record.lifted(x).index for group in groups for x in group.equations.residuals]
    turns = np.array([0.0, 360.0, -360.0])
    given = {n: np.full(3, node.value) for n, node in enumerate(record.nodes) if node.op == Op.INPUT}
    given[angle] = record.nodes[angle].value + turns
    found = [np.broadcast_to(x, 3) for x in code_of(record, places).run(given, 3)]
    changes = [np.abs(x - x[0]) for x in found]
    turned = np.radians(np.abs(turns))  # the angle of a link of a group, which goes on with the input
    return all(bool((c <= SAME_FIGURE).all() or (abs(c - turned) <= SAME_FIGURE).all()) for c in changes)


def distinct_rows(table: Array) -> tuple[Array, Rows]:
    """The different rows of a table, and which of them each row is; rows alike often follow one another."""
    new = np.ones(len(table), dtype=bool)
    np.any(table[1:] != table[:-1], axis=1, out=new[1:])
    firsts = table[new]
    sets, which = np.unique(firsts, axis=0, return_inverse=True)
    return sets, which.ravel()[np.cumsum(new) - 1]


def _changed(compiled: CompiledSweep, state: State) -> Signs:
    """The branches whose sign is no longer as written."""
    assert compiled.motion is not None
    written = compiled.motion.written
    return tuple(sorted((n, written[n]) for n, sign in state.signs.items() if sign != written[n]))
