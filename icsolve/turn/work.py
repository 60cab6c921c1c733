"""The work of a sweep: which rows belong to one way, how they are run, what becomes of doubtful ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.turn.ask import Columns, Wanted
from icsolve.turn.branches import Followed, follow, live_roots, signs_of
from icsolve.turn.numbers import numbers_of, with_numbers
from icsolve.turn.program import Asked, Setting, Sheet, Signs, setting_of, sheet_of
from icsolve.turn.replay import BLOCK, Array
from icsolve.turn.rows import RowCases
from icsolve.turn.runner import Found, Key, Rows, Runner, column
from icsolve.turn.second import CODE, SLICE, Look, backward, look_again
from icsolve.turn.way import Mask, Way, written_state

CHUNK = 16 * BLOCK
"""Rows whose followed states are held at once."""
FEW = 64
"""So few rows are always followed from the position as written."""
WIDEST = {"angles": 4.0}
"""Longest step of a way along an angle, degrees."""
PART = 2.0**-7
"""Longest step of a way along a length, as a part of the figure's size."""
MOST_TRIED = 1000
"""Rows that are tried as the position to start from, where the case as written does not assemble."""


@lru_cache(maxsize=32)
def _setting(case: Case, paths: tuple[str, ...], links: tuple[str, ...]) -> Setting:
    return setting_of(case, paths, links)


@lru_cache(maxsize=64)
def _sheet(case: Case, paths: tuple[str, ...], links: tuple[str, ...], asked: Asked, signs: Signs) -> Sheet:
    return sheet_of(_setting(case, paths, links), asked, signs)


@lru_cache(maxsize=64)
def _runner(case: Case, paths: tuple[str, ...], links: tuple[str, ...], asked: Asked, signs: Signs) -> Runner:
    return Runner(_sheet(case, paths, links, asked, signs))


class Part(NamedTuple):
    """Rows that are run together, and how their inputs come about."""

    runner: Runner
    rows: Rows
    followed: Followed | None
    places: Array


class Work:
    """One sweep as it is worked on."""

    def __init__(self, case: Case, columns: Columns, wanted: Wanted) -> None:
        self.case, self.columns, self.wanted = case, columns, wanted
        self.asked = wanted.asked
        self.paths, self.links = tuple(columns.paths), tuple(columns.links)
        self.notes: list[str] = []
        self.codes = np.zeros(columns.rows, dtype=np.int8)
        self.setting = self._start()
        self.values: dict[Key, Array] = {}
        self.errors: dict[str, Array] = {}

    # --- the position to start from ---------------------------------------------------------------

    def _start(self) -> Setting:
        """The setting of the case as written, or of the first row that assembles."""
        try:
            return _setting(self.case, self.paths, self.links)
        except SceneError as error:
            if error.status != Status.CANNOT_ASSEMBLE or self.links:
                raise
            return self._first_that_assembles(error)

    def _first_that_assembles(self, refusal: SceneError) -> Setting:
        order = np.lexsort([a for a in reversed(list(self.columns.paths.values()))])
        for row in order[:MOST_TRIED]:
            values = {path: float(a[row]) for path, a in self.columns.paths.items()}
            try:
                self.case = with_numbers(self.case, values)
                found = _setting(self.case, self.paths, self.links)
            except SceneError:
                continue
            said = ", ".join(f"{path} = {value:.6g}" for path, value in values.items())
            self.notes.append(f"the case as written does not assemble; the sweep starts from the first value that does, {said}.")
            return found
        raise refusal

    # --- ways -------------------------------------------------------------------------------------

    def run(self) -> None:
        """Fill the tables."""
        runner = self._runner(())
        sheet = runner.sheet
        self.values = runner.empty(self.columns.rows)
        if sheet.refusal is not None:
            self._refused(sheet.refusal)
            return
        for part in self._parts(runner):
            self._run(part)

    def _runner(self, signs: Signs) -> Runner:
        asked = self.asked
        if asked == Asked(True) and not _has_unknown(self.case):
            asked = Asked(rates=True)
        return _runner(self.case, self.paths, self.links, asked, signs)

    def _remade(self, signs: Signs) -> Sheet:
        return self._runner(signs).sheet

    def _refused(self, refusal: SceneError) -> None:
        """Every row is refused for the same reason."""
        self.codes[:] = CODE[refusal.status]
        self.notes.append(refusal.message)
        for array in self.values.values():
            array[:] = np.nan

    def _parts(self, runner: Runner) -> Iterator[Part]:
        """Rows by the way on which they lie; all at once where nothing has to be followed."""
        sheet = runner.sheet
        bearing = self._bearing(sheet)
        everything = np.arange(self.columns.rows)
        if not bearing:
            yield Part(runner, everything, None, np.empty(0))
            return
        main = next((name for name in (*self.links, *self.setting.drive.moving) if name in bearing), None)
        assert main is not None
        others = [name for name in bearing if name != main]
        if not others and self._plain(runner, main):
            return
        for rows in self._alike(others):
            yield self._followed(sheet, main, others, rows)

    def _bearing(self, sheet: Sheet) -> list[str]:
        """The inputs on which branches, groups and counted turns hang."""
        if sheet.motion is None:
            return []
        nodes = [root.radicand for root in live_roots(sheet)]
        nodes += [k for group in sheet.motion.groups for k in group.solved]
        if sheet.motion.groups or sheet.record.counted:
            return [name for name in sheet.inputs if name in self.columns.arrays]
        behind = ancestors(sheet, nodes)
        return [name for name, k in sheet.inputs.items() if k in behind and name in self.columns.arrays]

    def _plain(self, runner: Runner, main: str) -> bool:
        """Run all rows at once where no branch can change on the way to them; False where one may."""
        sheet = runner.sheet
        assert sheet.motion is not None
        at = self.columns.arrays[main]
        if sheet.motion.groups or sheet.record.counted or len(at) < FEW:
            return False
        start = self._written(main)
        order = _order(at)
        low, high = (at[0], at[-1]) if order is None else (at[order[0]], at[order[-1]])
        if not min(low, high) <= start <= max(low, high):
            return False
        arrays = self.columns.arrays
        given = {sheet.inputs[name]: a if order is None else a[order] for name, a in arrays.items()}
        found = runner.run(given, len(at))
        if found.touching:
            return False
        rows = np.arange(len(at)) if order is None else order
        self._keep(Part(runner, rows, None, np.empty(0)), found, order is None)
        return True

    def _alike(self, others: list[str]) -> Iterator[Rows]:
        """Rows that differ in the main input only."""
        if not others:
            yield np.arange(self.columns.rows)
            return
        table = np.stack([self.columns.arrays[name] for name in others], axis=1)
        _, which = np.unique(table, axis=0, return_inverse=True)
        order = np.argsort(which.ravel(), kind="stable")
        ends = np.flatnonzero(np.diff(which.ravel()[order])) + 1
        yield from np.split(order, ends)

    def _written(self, name: str) -> float:
        """An input's value as written; a link turned from there starts at zero."""
        return 0.0 if name in self.links else numbers_of(self.case)[name].value

    def _period(self, name: str) -> float | None:
        return 360.0 if name in self.links or name.startswith("angles.") else None

    def _widest(self, name: str) -> float:
        if name in self.links or name.startswith("angles."):
            return WIDEST["angles"]
        return PART / self.setting.figure.frame.scale

    def _followed(self, sheet: Sheet, main: str, others: list[str], rows: Rows) -> Part:
        """Rows on one way: first the other inputs go to their values, then the main one."""
        arrays = self.columns.arrays
        start = written_state(sheet)
        here = {name: float(arrays[name][rows[0]]) for name in others}
        base = {name: self._written(name) for name in sheet.inputs if name in arrays}
        if any(here[name] != base[name] for name in others):
            slope = {name: here[name] - base[name] for name in others}
            first = follow(self._remade, sheet, Way(base, slope, 0.0, 1.0 / 16.0), start, np.array([1.0]))
            start = first.track.end(1.0)
        places = arrays[main][rows]
        way = Way({**base, **here, main: 0.0}, {main: 1.0}, self._written(main), self._widest(main), self._period(main))
        followed = follow(self._remade, self._remade(_changed(sheet, start)), way, start, places)
        return Part(self._runner(signs_of(followed.sheet)), rows, followed, places)

    # --- rows -------------------------------------------------------------------------------------

    def _given(self, part: Part, some: Rows) -> tuple[dict[int, Array], Mask]:
        """Inputs of some rows of a part."""
        sheet, arrays = part.runner.sheet, self.columns.arrays
        given = {sheet.inputs[name]: a[part.rows[some]] for name, a in arrays.items() if name in sheet.inputs}
        if part.followed is None:
            return given, np.ones(len(some), dtype=bool)
        along, good = part.followed.track.given(part.places[some])
        return {**along, **given}, good

    def _run(self, part: Part) -> None:
        """Run the rows of a part in chunks."""
        for start in range(0, len(part.rows), CHUNK):
            some = np.arange(start, min(start + CHUNK, len(part.rows)))
            given, good = self._given(part, some)
            found = part.runner.run(given, len(some))
            self.codes[part.rows[some[~good]]] = CODE[Status.CANNOT_ASSEMBLE]
            chunk = part._replace(rows=part.rows[some], places=part.places[some] if part.places.size else part.places)
            self._keep(chunk, found, False)
        self._passed(part)

    def _keep(self, part: Part, found: Found, whole: bool) -> None:
        """Settle the doubtful rows of a run, and put its values into the tables."""
        codes = self.codes[part.rows]
        if found.doubtful.size:
            cases = RowCases(part.runner.sheet)

            def case_of(row: int) -> Case:
                some = np.array([row])
                values = {path: float(a[part.rows[row]]) for path, a in self.columns.paths.items()}
                return cases.at(self._given(part, some)[0], values)

            look_again(Look(part.runner, lambda rows: self._given(part, rows)[0], found, codes, case_of))
            self.codes[part.rows] = codes
        if self.wanted.error:
            self._bounds(part)
        for key, array in found.values.items():
            if whole:
                self.values[key] = array
            else:
                self.values[key][part.rows] = array

    def _bounds(self, part: Part) -> None:
        """Bounds of the answers of a part's rows."""
        answers = [(key[1], index) for key, _, index in part.runner.moving if key[0] == "answers"]
        for (kind, name), _, _ in ((k, p, v) for k, p, v in part.runner.still):
            if kind == "answers":
                self.errors.setdefault(name, np.zeros(self.columns.rows))
        if not answers:
            return
        passes = backward(part.runner, [index for _, index in answers])
        for start in range(0, len(part.rows), SLICE):
            some = np.arange(start, min(start + SLICE, len(part.rows)))
            given, _ = self._given(part, some)
            for (name, _), passed in zip(answers, passes.run(given, len(some)), strict=True):
                self.errors.setdefault(name, np.empty(self.columns.rows))[part.rows[some]] = passed.bound

    def _passed(self, part: Part) -> None:
        """Say at which rows change points were passed."""
        if part.followed is None:
            return
        start, at = part.followed.track.way.start, part.places
        for passing in part.followed.passed.values():
            for touch in passing.touches:
                beyond = at > touch if touch >= start else at < touch
                if beyond.any():
                    nearest = np.abs(at - touch)[beyond].min()
                    rows = part.rows[beyond & (np.abs(at - touch) == nearest)]
                    self.codes[rows[self.codes[rows] == 0]] = CODE[Status.CHANGE_POINT]
            self.notes += [
                f"near {part.followed.track.way.slope and next(iter(part.followed.track.way.slope))} = {gap:.6g} the links "
                "do not reach, in less than a row: beyond, the branch of the position as written is kept."
                for gap in passing.gaps
            ]

    # --- tables -----------------------------------------------------------------------------------

    def tables(self) -> dict[str, dict[str, Array]]:
        """The arrays by kind, not a number where a row has no value."""
        bad = self.codes == CODE[Status.CANNOT_ASSEMBLE]
        silent = bad | ((self.codes != 0) & (self.codes != CODE[Status.CHANGE_POINT]))
        tables: dict[str, dict[str, Array]] = {"answers": {}, "points": {}, "centres": {}, "rates": {}}
        for (kind, name), array in self.values.items():
            array[silent if kind == "answers" else bad] = np.nan
            if kind != "rates" or self.asked.rates:
                tables[kind][name] = array
        for array in self.errors.values():
            array[silent] = np.nan
        return {**tables, "error": self.errors}


def _has_unknown(case: Case) -> bool:
    from icsolve.power import is_unknown

    return any(map(is_unknown, case.loads))


def _order(at: Array) -> Rows | None:
    """The order of the rows by value; None where they are in order."""
    return None if bool(np.all(at[1:] >= at[:-1])) else np.argsort(at, kind="stable")


def _changed(sheet: Sheet, state) -> Signs:  # type: ignore[no-untyped-def]
    """The branches whose sign is no longer as written."""
    assert sheet.motion is not None
    written = sheet.motion.written
    return tuple(sorted((n, written[n]) for n, sign in state.signs.items() if sign != written[n]))


def ancestors(sheet: Sheet, nodes: list[int]) -> set[int]:
    """The nodes that lead to some."""
    from icsolve.turn.replay import live

    return set(live(sheet.record, nodes, ()))


__all__ = ["Mapping", "Work", "column"]
