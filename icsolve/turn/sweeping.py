"""A sweep: many positions of one mechanism, or a family of mechanisms, with the kernels of one scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import numpy.typing as npt

from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.power import is_unknown
from icsolve.turn.ask import Columns, Wanted, columns_of, shown_points, wanted_of
from icsolve.turn.numbers import with_numbers
from icsolve.turn.program import Asked
from icsolve.turn.replay import Array
from icsolve.turn.scenes import Table, by_scenes, families
from icsolve.turn.second import CODE, WORDS, Codes
from icsolve.turn.start import Start, start_of
from icsolve.turn.work import Work
from icsolve.verdicts import rubs


@dataclass(frozen=True, eq=False)
class Sweep:
    """The rows of a sweep; n is their number. Arrays that were not wanted are not there.

    Attributes
    ----------
    vary : the varied numbers by path, and the turnings of driven links by link, (n,)
    answers : unknown loads by name, (n,) [case units]; not a number where the status is another than
        ok, or change-point for a row beyond one that was passed
    error : bounds of the absolute rounding errors of the answers, (n,)
    points : places, (n, 2) [case length]
    centres : relative centres as homogeneous coordinates, (n, 3): (x, y, w) at (x/w, y/w), at infinity
        toward (x, y) where w is zero; all zero where the two links have no relative motion
    rates : angular velocities of the links, (n,) [rad/s, or scaled as in one scene]
    holds : with friction and no motion, the ranges in which unknown loads hold, (n, 2)
    notes : sentences about the sweep
    """

    case: Case
    vary: dict[str, Array]
    answers: dict[str, Array] = field(default_factory=dict)
    error: dict[str, Array] = field(default_factory=dict)
    points: dict[str, Array] = field(default_factory=dict)
    centres: dict[str, Array] = field(default_factory=dict)
    rates: dict[str, Array] = field(default_factory=dict)
    holds: dict[str, Array] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    codes: Codes = field(default_factory=lambda: np.empty(0, np.int8))
    _case_of: Callable[[int], Case] | None = None

    def __len__(self) -> int:
        return len(self.codes)

    @cached_property
    def status(self) -> npt.NDArray[np.str_]:
        """The status of every row in words, (n,)."""
        if not self.codes.any():
            return np.full(len(self.codes), WORDS[0])
        return np.array(WORDS)[self.codes]

    def case_of(self, row: int) -> Case:
        """The case of a row, as `icsolve.solve` takes it: its points by coordinates.

        In a family of figures: the case as if written so. Raises ValueError where the links do not
        assemble.
        """
        if self.status[row] == Status.CANNOT_ASSEMBLE:
            raise ValueError(f"row {row} does not assemble")
        if self._case_of is None:
            return with_numbers(self.case, {path: float(array[row]) for path, array in self.vary.items()})
        return self._case_of(row)


def sweep(
    case: Case,
    vary: Mapping[str, npt.ArrayLike] | None = None,
    want: Sequence[str] = ("answers", "status"),
    *,
    drive: Mapping[str, npt.ArrayLike] | None = None,
) -> Sweep:
    """Solve a case for many values of some of its numbers.

    A number that only poses the figure moves the mechanism from the position as written; one that would
    reshape a link, or a load's, gives another case in each row, as if written so.

    Parameters
    ----------
    case : as `icsolve.load` returns it
    vary : arrays of values by path (``angles.AB``, ``loads.P``), zipped; case units, degrees
    want : ``answers``, ``status``, ``error``, ``points``, ``centres``, ``rates``; or single ones,
        ``points.C``, ``centres.2-4``
    drive : arrays of degrees by which links are turned from the position as written, by link

    Raises
    ------
    CaseError
        For a path that the case does not have.
    SceneError
        Where no row can be solved: the case as written has no figure, or cannot be moved so.
    ValueError
        For arrays that can't be columns, or words that can't be wanted.
    """
    columns = columns_of(case, vary, drive)
    wanted = wanted_of(case, tuple(want) if not isinstance(want, str) else (want,))
    start = start_of(case, columns, _told(case, wanted.asked))
    if start.one_by_one:
        return _family(start, columns, wanted)
    if rubs(case):
        return _rubbing(start, columns, wanted)
    work = Work(start, columns, wanted.error)
    work.run()
    tables = work.tables()
    if not wanted.asked.rates:
        tables["rates"] = {}
    return Sweep(case, _shown(columns), **tables, notes=tuple(work.notes), codes=work.codes, _case_of=work.case_of)


def _rubbing(start: Start, columns: Columns, wanted: Wanted) -> Sweep:
    """A sweep with friction: positions at once, each row then a scene of its own."""
    placed = start._replace(asked=Asked(answers=False, points=tuple(shown_points(start.case))))
    work = Work(placed, columns, False)
    work.run()
    table = Table(columns.rows, wanted.asked)
    table.codes[:] = np.where(work.codes == CODE[Status.CHANGE_POINT], 0, work.codes)
    by_scenes(table, np.flatnonzero(table.codes == 0).tolist(), work.case_of)
    table.codes[:] = np.where(table.codes == 0, work.codes, table.codes)
    return _swept(start, columns, wanted, table, (*work.notes, BY_SCENES), work.case_of)


BY_SCENES = "with friction each row is solved as a scene of its own."


def _family(start: Start, columns: Columns, wanted: Wanted) -> Sweep:
    """A family of figures without a construction for all: each solved as if written so."""
    table, moving = Table(columns.rows, wanted.asked), start.setting.drive.moving
    notes: dict[str, None] = dict.fromkeys([start.note] if start.note else [])
    for case, rows in families(start.case, columns, moving):
        if not moving and not columns.links:
            by_scenes(table, rows.tolist(), lambda _, case=case: case)  # type: ignore[misc]
            continue
        try:
            part = sweep(case, {p: columns.paths[p][rows] for p in moving}, wanted.words, drive={k: a[rows] for k, a in columns.links.items()})
        except SceneError as error:
            table.codes[rows] = CODE.get(error.status, CODE[Status.NEAR_SINGULAR])
            continue
        notes |= dict.fromkeys(part.notes)
        table.take(rows, part.codes, {"answers": part.answers, "points": part.points, "centres": part.centres, "rates": part.rates}, part.error)
    return _swept(start, columns, wanted, table, tuple(notes), None)


def _swept(
    start: Start, columns: Columns, wanted: Wanted, table: Table, notes: tuple[str, ...], case_of: Callable[[int], Case] | None
) -> Sweep:
    tables: dict[str, dict[str, Array]] = {"answers": {}, "points": {}, "centres": {}, "rates": {}}
    for (kind, name), array in table.values.items():
        tables[kind][name] = array
    error = table.errors if wanted.error else {}
    return Sweep(start.case, _shown(columns), **tables, error=error, holds=table.holds, notes=notes, codes=table.codes, _case_of=case_of)


def _told(case: Case, asked: Asked) -> Asked:
    """What has to be run: where no load is unknown, rates, so that the status means something."""
    unknown = any(map(is_unknown, case.loads))
    return asked if unknown or asked.rates or asked.centres else asked._replace(rates=True)


def _shown(columns: Columns) -> dict[str, Array]:
    return {columns.names[own]: array for own, array in columns.arrays.items()}
