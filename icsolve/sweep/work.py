"""The work of a sweep: its rows run part by part, doubtful ones settled, the arrays filled."""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np

from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers.replay import BLOCK, Array
from icsolve.sweep.ask import Columns
from icsolve.sweep.flat import bound_flat
from icsolve.sweep.parts import Part, Parts
from icsolve.sweep.runner import Found, Key, Progress, column
from icsolve.sweep.second import CODE, Look, look_again
from icsolve.sweep.start import Start
from icsolve.sweep.swept import by_kind
from icsolve.sweep.way import Way

AT = 1e-7
"""A row that is this near to a change point (as a part of the longest step) is at it."""
ROUGHLY = 1e-6
"""The same for a change point of a group, whose place is known to the root of rounding only."""
GRAZED = 1e-3
"""The same where places meet and part again: that goes like a square, or slower."""
CHUNK = 16 * BLOCK
"""Rows whose followed states are held at once."""


class Tables(NamedTuple):
    """Arrays by name, of each kind, and the bounds by kind."""

    answers: dict[str, Array]
    points: dict[str, Array]
    centres: dict[str, Array]
    rates: dict[str, Array]
    errors: dict[str, dict[str, Array]]


class Work:
    """One sweep as it is worked on; ``codes`` and ``values`` are filled by ``run``."""

    def __init__(
        self, start: Start, columns: Columns, error: bool, progress: Progress | None = None
    ) -> None:
        self.start, self.columns, self.error = start, columns, error
        self.running = None if error else progress
        self.bounding = progress if error else None
        self.parts = Parts(start, columns, self.running)
        self.notes: list[str] = [start.note] if start.note else []
        self.codes = np.zeros(columns.rows, dtype=np.int8)
        self.values: dict[Key, Array] = {}
        self.errors: dict[Key, Array] = {}
        self.done: list[Part] = []

    def run(self) -> None:
        """Run every row."""
        refusal = self.start.sheet().refusal
        if refusal is not None:
            self._refused(refusal)
            return
        for part in self.parts.all():
            self.done.append(part._replace(found=None))
            if part.found is not None and part.ordered:
                self.values = part.found.values
                self._settle(part, part.found)
                self._bounds(part)
            else:
                self._run(part)

    def _refused(self, refusal: SceneError) -> None:
        """Every row is refused for the same reason."""
        self.values = self.start.runner().empty(self.columns.rows)
        self.codes[:] = CODE[refusal.status]
        self.notes.append(refusal.message)
        for array in self.values.values():
            array[:] = np.nan

    def _run(self, part: Part) -> None:
        """Run the rows of a part in chunks, and put what is found into the tables."""
        self.values = self.values or part.runner.empty(self.columns.rows)
        for start in range(0, len(part.rows), CHUNK):
            chunk = part if part.found else part.some(np.arange(start, min(start + CHUNK, len(part.rows))))
            found = part.found
            if found is None:
                given, good = self.parts.given(chunk)
                found = part.runner.run(given, len(chunk.rows), self.running)
                self.codes[chunk.rows[~good]] = CODE[Status.CANNOT_ASSEMBLE]
                found = _with_singular(chunk, found)
            self._settle(chunk, found)
            self._bounds(chunk)
            for key, array in found.values.items():
                self.values[key][chunk.rows] = array
            if part.found is not None:
                break
        self._passed(part)

    def _settle(self, part: Part, found: Found) -> None:
        """Look again at doubtful rows."""
        if not found.doubtful.size:
            return
        codes = self.codes[part.rows]

        def case_of(row: int) -> Case:
            return self._case(part.some(np.array([row])))

        given = lambda rows: self.parts.given(part.some(rows))[0]  # noqa: E731
        look_again(Look(part.runner, given, found, codes, case_of))
        self.codes[part.rows] = codes

    def _case(self, one: Part) -> Case:
        """The case of a part of one row."""
        given, _ = self.parts.given(one)
        row = one.rows[0]
        return one.runner.cases.at(given, {path: float(a[row]) for path, a in self.columns.paths.items()})

    def case_of(self, row: int) -> Case:
        """The case of a row: its points by coordinates (or, in a family, as if written so)."""
        for part in self.done:
            where = np.flatnonzero(part.rows == row)
            if where.size:
                return self._case(part.some(where[:1]))
        raise IndexError(row)

    def _bounds(self, part: Part) -> None:
        """Bounds of all that is found of a part's rows."""
        if not self.error:
            return
        self.errors = self.errors or part.runner.blank(self.columns.rows)
        for key, k, noise in part.runner.constants:
            column(self.errors[key], k)[part.rows] = noise
        given, _ = self.parts.given(part)
        done = 0
        for outputs, passes in part.runner.batches():
            tables = [column(self.errors[key], k) for key, k in outputs]
            for start in range(0, len(part.rows), passes.rows):
                here = slice(start, min(start + passes.rows, len(part.rows)))
                rows = {k: v[here] if v.ndim else v for k, v in given.items()}
                found = passes.run(rows, here.stop - start)
                for table, passed in zip(tables, found, strict=True):
                    table[part.rows[here]] = passed.bound
                done = self._told(part, done, len(outputs) * (here.stop - start))
        if not done:
            self._told(part, 0, len(part.rows))
        self._flat_bounds(part)

    def _flat_bounds(self, part: Part) -> None:
        """Bounds of rows that have none yet: at a limit."""
        open_ = np.zeros(len(part.rows), dtype=bool)
        for array in self.errors.values():
            bounds = array[part.rows]
            open_ |= ~np.isfinite(bounds if bounds.ndim == 1 else bounds.sum(axis=1))
        rows = np.flatnonzero(open_ & (self.codes[part.rows] == 0))
        if rows.size:
            given = lambda some: self.parts.given(part.some(some))[0]  # noqa: E731
            bound_flat(part.runner, given, self.errors, rows, part.rows[rows])

    def _told(self, part: Part, done: int, more: int) -> int:
        """Tell of rows whose bounds are found: each takes as many passes as there are outputs."""
        passes = max(1, len(part.runner.moving))
        if self.bounding is not None:
            self.bounding((done + more) // passes - done // passes)
        return done + more

    def _passed(self, part: Part) -> None:
        """Say at which rows change points were passed, and what was not reached."""
        if part.followed is None:
            return
        for touch in part.followed.track.passages():
            self._change(part, touch, ROUGHLY)
        for passing in part.followed.passed.values():
            for touch in passing.touches:
                self._change(part, touch)
            for touch in passing.grazes:
                self._change(part, touch, GRAZED)
            for gap in passing.gaps:
                self._gap(part.followed.track.way, gap)

    def _change(self, part: Part, touch: float, near: float = AT) -> None:
        """Mark the row at a change point (it has no answer), else the first one beyond."""
        assert part.followed is not None
        way, at = part.followed.track.way, part.places
        beyond = at > touch if touch >= way.start else at < touch
        there = np.abs(at - touch) <= near * way.widest
        if there.any():
            beyond = there
            for key, array in self.values.items():
                if key[0] == "answers":
                    array[part.rows[there]] = np.nan
        if beyond.any():
            nearest = np.abs(at - touch)[beyond].min()
            rows = part.rows[beyond & (np.abs(at - touch) == nearest)]
            plain = (self.codes[rows] == 0) | (self.codes[rows] == CODE[Status.NEAR_SINGULAR])
            self.codes[rows[plain]] = CODE[Status.CHANGE_POINT]

    def _gap(self, way: Way, gap: float) -> None:
        (name,) = way.slope
        self.notes.append(
            f"at {self.columns.names[name]} = {gap:.6g} the links do not reach, in less than a row: beyond, "
            "the branch of the position as written is kept, though no motion leads there."
        )

    # --- tables -----------------------------------------------------------------------------------

    @cached_property
    def silent(self) -> dict[str, np.typing.NDArray[np.bool_]]:
        """By kind, the rows that have no value."""
        apart = self.codes == CODE[Status.CANNOT_ASSEMBLE]
        none = (self.codes != 0) & (self.codes != CODE[Status.CHANGE_POINT])
        return {"answers": none, "points": apart, "centres": apart, "rates": apart}

    def tables(self) -> Tables:
        """The arrays and their bounds, not a number where a row has no value."""
        for table in (self.values, self.errors):
            for (kind, _), array in table.items():
                array[self.silent[kind]] = np.nan
        return Tables(**by_kind(self.values), errors=by_kind(self.errors))


def _with_singular(part: Part, found: Found) -> Found:
    """Rows in a step through a singular position are doubtful, too."""
    if part.followed is None:
        return found
    singular = np.flatnonzero(part.followed.track.singular(part.places))
    return found._replace(doubtful=np.union1d(found.doubtful, singular)) if singular.size else found
