"""The work of a sweep: its rows run part by part on the record, doubtful ones solved as scenes."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal

import numpy as np

from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers.replay import BLOCK, Array
from icsolve.numbers.tape import UNIT
from icsolve.sweep.continuation import InputLine
from icsolve.sweep.path_tracking import PathTracker
from icsolve.sweep.recheck import Recheck
from icsolve.sweep.record_runner import Key, Progress, Rows, RowsFound, column
from icsolve.sweep.request import Columns
from icsolve.sweep.row_parts import SweepPart, SweepParts
from icsolve.sweep.rows_by_scenes import by_scenes, placed_near
from icsolve.sweep.starting_position import Start
from icsolve.sweep.table import CODE, Codes, Table
from icsolve.sweep.varied_numbers import with_numbers

CHUNK = 16 * BLOCK
"""Rows whose followed states are held at once."""
SPANS = 4
"""So many parts of a sweep to which no motion leads are told."""
SAME = 1e-6
"""Change points nearer to each other than this, as a part of the longest step, are one."""


class SweepRun:
    """One sweep as it is worked on; ``table`` is filled by ``run``."""

    def __init__(self, start: Start, columns: Columns, error: bool, progress: Progress | None = None) -> None:
        self.start, self.columns, self.error = start, columns, error
        self.running = None if error else progress
        self.bounding = progress if error else None
        self.parts = SweepParts(start, columns)
        self.notes: list[str] = [start.note] if start.note else []
        self.table = Table(columns.rows, start.asked)
        self.done: list[SweepPart] = []

    @property
    def codes(self) -> Codes:
        """The statuses of the rows, (rows,), as places in `table.WORDS`."""
        return self.table.codes

    @property
    def values(self) -> dict[Key, Array]:
        """The values of the rows, (rows,) or (rows, parts) by what they are."""
        return self.table.values

    def run(self) -> None:
        """Run every row."""
        refusal = self.start.compiled().refusal
        if refusal is not None:
            self._refused(refusal)
            return
        for part in self.parts.all():
            self.done.append(part)
            if part.ordered:
                given, _ = self.parts.given(part)
                found = part.runner.run(given, len(part.rows), self.running)
                self.table.values = found.values
                self._bounds(part)
                self._settle(part, found.doubtful)
            else:
                self._run(part)
        self._straighten()
        self._hold()
        self._silence()

    def _straighten(self) -> None:
        """Try rows to which groups did not lead with one number changed after the other on the straight way,
        on which all go to their values at once."""
        self.running = self.bounding = None  # every row was told of
        followed = [part for part in self.done if part.followed is not None and part.runner.sequential]
        for part in followed if len(self.parts.bearing) > 1 else ():
            for row in part.rows[self.codes[part.rows] == CODE[Status.CANNOT_ASSEMBLE]].tolist():
                straight = self.parts.straight(row)
                if straight is None:
                    continue
                self.codes[row] = 0
                self.done.insert(0, straight)
                self._run(straight)

    def _hold(self) -> None:
        """Rows with friction and no motion: the ranges over which they hold."""
        answered = self.codes == 0
        for key in [key for key in self.values if key[0] == "holds"]:
            found = self.values.pop(key)
            held = answered & ~np.isnan(found[:, 0])
            low, high = found[held].T
            self.table.hold(key[1], held, found[held], (low <= 0.0) & (high >= 0.0))  # the load does work
            self.codes[held] = CODE["holds"]

    def _refused(self, refusal: SceneError) -> None:
        """Every row is refused for the same reason."""
        self.table.values = self.start.runner().empty(self.columns.rows)
        self.codes[:] = CODE[refusal.status]
        self.notes.append(refusal.message)
        for array in self.values.values():
            array[:] = np.nan

    def _run(self, part: SweepPart) -> None:
        """Run the rows of a part in chunks, and put what is found into the table."""
        self.table.values = self.values or part.runner.empty(self.columns.rows)
        for start in range(0, len(part.rows), CHUNK):
            chunk = part.some(np.arange(start, min(start + CHUNK, len(part.rows))))
            given, good = self.parts.given(chunk)
            found = part.runner.run(given, len(chunk.rows), self.running)
            self.codes[chunk.rows[~good]] = CODE[Status.CANNOT_ASSEMBLE]
            found = _with_singular(chunk, found)
            for key, array in found.values.items():
                self.values[key][chunk.rows] = array
            self._bounds(chunk)
            self._settle(chunk, found.doubtful)
        self._passed(part)

    def _settle(self, part: SweepPart, doubtful: Rows) -> None:
        """Solve doubtful rows as scenes."""
        if doubtful.size:
            doubtful = doubtful[self.codes[part.rows[doubtful]] == 0]
        if not doubtful.size:
            return
        apart = part.runner.apart(self.parts.given(part.some(doubtful))[0], len(doubtful))
        if part.followed is not None:  # what is beyond an end may have another state than doubles tell
            apart &= ~part.followed.tracker.ending(part.places[doubtful])
        self.codes[part.rows[doubtful[apart]]] = CODE[Status.CANNOT_ASSEMBLE]
        rows = part.rows[doubtful[~apart]].tolist()
        recheck = Recheck(self.parts, part)
        for row in rows:
            self._place(recheck, row)
        asked = self.start.asked.answers
        left = [row for row in rows if self.codes[row] == 0 and (asked or self.table.lacks(row))]
        by_scenes(self.table, left, recheck.case, missing=True)

    def _place(self, recheck: Recheck, row: int) -> None:
        """The numbers of a row in high precision, each rounded once."""
        try:
            recheck.refuse_apart(row)
        except SceneError as refusal:
            self.table.refuse(row, refusal)
            return
        for (kind, name), value in recheck.outputs(row).items():
            error = [abs(x) * UNIT for x in value]
            pair = (value[0], error[0]) if len(value) == 1 else (tuple(value), tuple(error))
            self.table.put(kind, name, row, *pair)

    def case_of(self, row: int, exact: Mapping[str, Decimal] | None = None) -> Case:
        """The case of a row: its points by coordinates (in a family as if written so, with `near` where they
        are); ``exact`` as in `Recheck`."""
        setting = self.start.setting
        if not setting.moves:
            numbers = {p: float(a[row]) for p, a in self.columns.paths.items()}
            return placed_near(with_numbers(self.start.case, numbers), setting.figure)
        for part in self.done:
            if (part.rows == row).any():
                return Recheck(self.parts, part, exact).case(row)
        raise IndexError(row)

    def _bounds(self, part: SweepPart) -> None:
        """Bounds of all that is found of a part's rows."""
        if not self.error:
            return
        errors = self.table.errors = self.table.errors or part.runner.blank(self.columns.rows)
        for key, k, noise in part.runner.constants:
            column(errors[key], k)[part.rows] = noise
        given, _ = self.parts.given(part)
        done = 0
        for outputs, passes in part.runner.batches():
            tables = [column(errors[key], k) for key, k in outputs]
            for start in range(0, len(part.rows), passes.rows):
                here = slice(start, min(start + passes.rows, len(part.rows)))
                rows = {k: v[here] if v.ndim else v for k, v in given.items()}
                found = passes.run(rows, here.stop - start)
                for table, passed in zip(tables, found, strict=True):
                    table[part.rows[here]] = passed.bound
                done = self._told(part, done, len(outputs) * (here.stop - start))
        if not done:
            self._told(part, 0, len(part.rows))

    def _told(self, part: SweepPart, done: int, more: int) -> int:
        """Tell of rows whose bounds are found: each takes as many passes as there are outputs."""
        passes = max(1, len(part.runner.moving))
        if self.bounding is not None:
            self.bounding((done + more) // passes - done // passes)
        return done + more

    def _passed(self, part: SweepPart) -> None:
        """Say where change points were passed, and what was not reached."""
        if part.followed is None:
            return
        line = part.followed.tracker.line
        self._islands(part, part.followed.tracker)
        change_points = [*part.followed.tracker.passages()]
        first, last = min(line.start, *part.places), max(line.start, *part.places)
        for passing in part.followed.passed.values():
            change_points += [*passing.change_points, *passing.grazes]
            for gap in passing.gaps:
                if first <= gap <= last:
                    self._gap(line, gap)
        said: list[float] = []
        for at in sorted(change_points):
            if first <= at <= last and all(abs(at - other) > SAME * line.widest for other in said):
                said.append(at)
                self._change(line, at)

    def _change(self, line: InputLine, at: float) -> None:
        (name,) = line.slope
        at = SAME * line.widest * round(at / (SAME * line.widest))
        note = (
            f"change point at {self.columns.names[name]} = {at:.6g}: it can go on there in more than one "
            "way, and the rows beyond are those to which it goes straight on."
        )
        if note not in self.notes:
            self.notes.append(note)

    def _islands(self, part: SweepPart, tracker: PathTracker) -> None:
        """Say to which rows no motion leads."""
        line, order = tracker.line, np.argsort(part.places)
        places, answered = part.places[order], self.codes[part.rows[order]] == 0
        apart = answered & ~tracker.change_points.reached(places, line) & ~tracker.ending(places)
        ends = np.flatnonzero(np.diff(apart, prepend=False, append=False)).reshape(-1, 2)
        if len(ends):
            (name,) = line.slope
            spans = [f"{places[a]:.6g} to {places[b - 1]:.6g}" for a, b in ends[:SPANS]]
            self.notes.append(
                f"no motion leads from the position as written to the rows at {self.columns.names[name]} = "
                f"{', '.join(spans)}{' ...' if len(ends) > SPANS else ''}: "
                "the branch of that position is kept in them."
            )

    def _gap(self, line: InputLine, gap: float) -> None:
        (name,) = line.slope
        self.notes.append(
            f"at {self.columns.names[name]} = {gap:.6g} the links do not reach, in less than a row: beyond, "
            "the branch of the position as written is kept, though no motion leads there."
        )

    # --- the table --------------------------------------------------------------------------------

    def _silence(self) -> None:
        """What a row without a status of its own may not have."""
        if not self.codes.any():
            return
        apart, none = self.codes == CODE[Status.CANNOT_ASSEMBLE], self.codes != 0
        for tables in (self.table.values, self.table.errors):
            for (kind, _), array in tables.items():
                array[none if kind == "answers" else apart] = np.nan


def _with_singular(part: SweepPart, found: RowsFound) -> RowsFound:
    """Rows beside a singular position of a group or beside its end, and those that doubles do not settle, are
    doubtful, too."""
    if part.followed is None:
        return found
    tracker = part.followed.tracker
    at = part.places
    singular = np.flatnonzero(
        tracker.singular(at) | tracker.bent(at) | tracker.ending(at) | tracker.unsettled(at)
    )
    return found._replace(doubtful=np.union1d(found.doubtful, singular)) if singular.size else found
