"""Rows that are solved one by one as scenes of their own: with friction, and families of figures that have
no construction for all rows at once. Slower, and with every rule of a single scene."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

import numpy as np

from icsolve.answer import Answer
from icsolve.assembly import case_point, placed_figure
from icsolve.case import Case
from icsolve.case.names import link_order
from icsolve.errors import SceneError
from icsolve.numbers.replay import Array
from icsolve.numbers.tape import UNIT
from icsolve.solve import solve
from icsolve.sweep.ask import Columns
from icsolve.sweep.forked import can_fork, started
from icsolve.sweep.numbers import numbers_of, with_numbers
from icsolve.sweep.program import Asked, wanted_points
from icsolve.sweep.runner import Key, Progress, Rows
from icsolve.sweep.second import CODE, Codes
from icsolve.sweep.swept import Sweep, by_kind

FEW = 8
PATIENCE, WORTH = 0.3, 0.8
"""Seconds: how long rows are solved one after another before the others are asked for help, if as much as
that is left."""
MOST = 8
Value = float | tuple[float, ...]
OTHER = CODE["near-singular"]


class Table:
    """Rows filled one by one."""

    def __init__(self, rows: int, asked: Asked) -> None:
        self.rows, self.asked = rows, asked
        self.codes: Codes = np.zeros(rows, dtype=np.int8)
        self.values: dict[Key, Array] = {}
        self.errors: dict[Key, Array] = {}
        self.holds: dict[str, Array] = {}

    def put(self, kind: str, name: str, row: int, value: Value, error: Value | None = None) -> None:
        """One value, and the bound of its error where one is proven."""
        shape = (self.rows,) if isinstance(value, float) else (self.rows, len(value))
        self._table(self.values, (kind, name), shape)[row] = value
        self._table(self.errors, (kind, name), shape)[row] = np.nan if error is None else error

    def _table(self, tables: dict[Key, Array], key: Key, shape: tuple[int, ...]) -> Array:
        """The array of a kind and name; not a number where nothing was put."""
        if key not in tables:
            tables[key] = np.full(shape, np.nan)
        return tables[key]

    def refuse(self, row: int, error: SceneError) -> None:
        """A row without an answer."""
        self.codes[row] = CODE.get(error.status, OTHER)

    def take(self, rows: Rows, part: Sweep) -> None:
        """Rows that were swept together."""
        self.codes[rows] = part.codes
        for tables, kinds in ((self.values, part.kinds), (self.errors, part.errors)):
            for kind, arrays in kinds.items():
                for name, array in arrays.items():
                    self._table(tables, (kind, name), (self.rows, *array.shape[1:]))[rows] = array

    def some(self, rows: Rows | list[int]) -> Table:
        """Some rows as a table of their own."""
        part = Table(len(rows), self.asked)
        part.codes = self.codes[rows]
        part.values = {key: array[rows] for key, array in self.values.items()}
        part.errors = {key: array[rows] for key, array in self.errors.items()}
        part.holds = {name: array[rows] for name, array in self.holds.items()}
        return part

    def merge(self, rows: Rows | list[int], part: Table) -> None:
        """Rows of a table of their own."""
        self.codes[rows] = part.codes
        for mine, theirs in ((self.values, part.values), (self.errors, part.errors)):
            for key, array in theirs.items():
                self._table(mine, key, (self.rows, *array.shape[1:]))[rows] = array
        for name, array in part.holds.items():
            self.holds.setdefault(name, np.full((self.rows, 2), np.nan))[rows] = array

    def fill(self, row: int, answer: Answer) -> None:
        """All that is asked of a solved row."""
        asked, case = self.asked, answer.case
        for name, found in answer.answers.items() if asked.answers else ():
            value = float(found.value) if found.holds is None else np.nan
            self.put("answers", name, row, value, found.error)
            if found.holds is not None:
                self.codes[row] = CODE["holds"]
                self.holds.setdefault(name, np.full((self.rows, 2), np.nan))[row] = found.holds
        for name in asked.points:
            if name in answer.points:
                self.put("points", name, row, answer.points[name])
        errors = answer.errors.get("rates", {})
        for link, rate in (answer.rates or {}).items() if asked.rates else ():
            if isinstance(rate, float):
                self.put("rates", link, row, rate, errors.get(link, 0.0 if rate == 0.0 else None))
        for pair in asked.centres:
            triple = _triple(answer, pair)
            if triple is not None:
                first, second = sorted(pair, key=lambda link: link_order(case, link))
                self.put("centres", f"{first}-{second}", row, triple, _centre_error(answer, pair))

    def sweep(
        self,
        case: Case,
        vary: dict[str, Array],
        error: bool,
        notes: tuple[str, ...],
        case_of: Callable[[int], Case],
    ) -> Sweep:
        """The table as a sweep."""
        return Sweep(
            case,
            vary,
            **by_kind(self.values),
            errors=by_kind(self.errors) if error else {},
            holds=self.holds,
            notes=notes,
            codes=self.codes,
            _case_of=case_of,
        )


def _triple(answer: Answer, pair: tuple[str, str]) -> tuple[float, float, float] | None:
    centre = answer.centres.get(pair)
    if centre is None or centre.kind == "undetermined":
        return None
    if centre.kind == "at":
        return (centre.place[0], centre.place[1], 1.0)
    if centre.kind == "toward":
        angle = np.radians(centre.place[0])
        return (float(np.cos(angle)), float(np.sin(angle)), 0.0)
    return (0.0, 0.0, 0.0)


def _centre_error(answer: Answer, pair: tuple[str, str]) -> tuple[float, float, float] | None:
    """Bounds of the coordinates of `_triple`, of which the weight is exact."""
    centre = answer.centres[pair]
    if centre.kind not in ("at", "toward"):
        return (0.0, 0.0, 0.0)
    if centre.error is None:
        return None
    error = centre.error if centre.kind == "at" else float(np.radians(centre.error)) + UNIT
    return (error, error, 0.0)


def solved(case: Case, asked: Asked) -> Answer:
    """A row as a scene."""
    return solve(case, rates=asked.rates, all_centres=bool(asked.centres), examine=bool(asked.points))


def by_scenes(
    table: Table, rows: Iterable[int], case_of: Callable[[int], Case], progress: Progress | None = None
) -> None:
    """Solve rows as scenes; in several processes once they turn out to take long."""
    every = list(rows)
    start = time.monotonic()
    for n, row in enumerate(every):
        _one(table, row, case_of)
        if progress is not None:
            progress(1)
        spent = time.monotonic() - start
        if n % FEW == FEW - 1 and spent > PATIENCE and spent * (len(every) - n) > WORTH * n and can_share():
            shared(table, every[n + 1 :], case_of, progress)
            return


def _one(table: Table, row: int, case_of: Callable[[int], Case]) -> None:
    try:
        table.fill(row, solved(case_of(row), table.asked))
    except SceneError as error:
        table.refuse(row, error)


def can_share() -> bool:
    """Whether other processors can help: not where threads run, which a new process would not have."""
    from multiprocessing import current_process

    many = (os.cpu_count() or 1) > 1 and threading.active_count() == 1
    return many and can_fork() and not current_process().daemon


def shared(
    table: Table, rows: list[int], case_of: Callable[[int], Case], progress: Progress | None = None
) -> None:
    """Solve rows in as many processes as there are processors, this one among them."""
    count = min(os.cpu_count() or 1, MOST)
    shares = [rows[k::count] for k in range(count)]

    def alone(some: list[int]) -> Table:
        part = Table(table.rows, table.asked)
        for row in some:
            _one(part, row, case_of)
        return part.some(some)

    with started([(alone, (some,)) for some in shares[1:]]) as results:
        for row in shares[0]:
            _one(table, row, case_of)
            if progress is not None:
                progress(count)
        for some, part in zip(shares[1:], results(), strict=True):
            table.merge(some, part)


# --- families that have no construction for all rows ----------------------------------------------


def families(case: Case, columns: Columns, moving: Iterable[str]) -> Iterator[tuple[Case, Rows]]:
    """For each set of reshaping numbers the case as if written so, and its rows: outward from the case as
    written, each near to the closest that was placed before, so that branches are kept."""
    reshaping = [path for path in columns.paths if path not in set(moving)]
    table = np.stack([columns.paths[path] for path in reshaping], axis=1)
    sets, which = np.unique(table, axis=0, return_inverse=True)
    steps = _steps(sets, [numbers_of(case)[path].value for path in reshaping])
    done, nears = [np.zeros(len(reshaping))], [_places(case) or case.near]
    for n in np.argsort(np.abs(steps).max(axis=1), kind="stable"):
        changed = with_numbers(case, dict(zip(reshaping, map(float, sets[n]), strict=True)))
        closest = int(np.abs(np.array(done) - steps[n]).max(axis=1).argmin())
        placed = replace(changed, near=nears[closest])
        yield placed, np.flatnonzero(which.ravel() == n)
        found = _places(placed)
        if found is not None:
            done.append(steps[n])
            nears.append(found)


def _steps(sets: Array, written: list[float]) -> Array:
    """How far sets of numbers are from the written ones, as parts of the range of each number."""
    size = np.ptp(np.vstack([sets, written]), axis=0)
    steps: Array = (sets - written) / np.where(size > 0.0, size, 1.0)
    return steps


def _places(case: Case) -> dict[str, tuple[float, float]] | None:
    """Where the points of a figure are, in case units; None where it does not assemble."""
    try:
        figure = placed_figure(case, *wanted_points(case))
    except SceneError:
        return None
    named = {name: place for name, place in figure.points.items() if not name.startswith("@")}
    return {name: case_point(figure.frame, place) for name, place in named.items()}
