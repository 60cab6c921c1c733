"""Sweeps: many positions of one mechanism, or a family of mechanisms, with the kernels of one scene.

A case is solved as written and becomes a mechanism of links that keep their shapes (`assembly.driven`);
``drivers`` says what the varied numbers do to it. ``program`` writes places (``continuation`` and
``branches`` where they have to be followed) and statics (``recorded_scene``) into a record, which
``record_runner`` replays on blocks of rows. ``rows_on_record`` sends doubtful rows to ``recheck``;
``rows_by_scenes`` solves those of which there is no record.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import lru_cache, partial

import numpy as np
import numpy.typing as npt

from icsolve.case import Case, refuse_no_case
from icsolve.errors import SceneError, Status
from icsolve.kinematics.speeds import NO_SPEED
from icsolve.numbers.replay import Array
from icsolve.scene import wanted as needed
from icsolve.scene.needed_part import UNPLACED, left_out_of, moving_part
from icsolve.scene.program import Want
from icsolve.scene.refusals import rubs
from icsolve.sweep.program import RowRequest
from icsolve.sweep.record_runner import Progress
from icsolve.sweep.request import (
    Columns,
    SweepRequest,
    columns_of,
    names_in,
    refuse_size,
    request_of,
    shown_points,
    told,
)
from icsolve.sweep.rows_by_scenes import by_scenes, families
from icsolve.sweep.rows_on_record import SweepRun
from icsolve.sweep.starting_position import Start, start_of
from icsolve.sweep.table import CODE, Sweep, Table, among
from icsolve.sweep.varied_numbers import refuse_space
from icsolve.tuples import replace
from icsolve.wording import plural

__all__ = ["Sweep", "sweep"]

CaseOf = Callable[[int], Case]
"""The case of a row, by its index."""
SOLVED = (Status.OK, "holds")
BY_SCENES = "each row is solved as a scene of its own."


def sweep(
    case: Case,
    vary: Mapping[str, npt.ArrayLike] | None = None,
    want: Sequence[str] = ("answers", "status"),
    *,
    drive: Mapping[str, npt.ArrayLike] | None = None,
    dynamic: bool = False,
    progress: Progress | None = None,
) -> Sweep:
    """Solve a case for many values of some of its numbers.

    A number that only poses the figure moves the mechanism from the position as written; one that would
    reshape a link, or a load's, gives another case in each row, as if written so.

    Parameters
    ----------
    case : as `icsolve.load` returns it
    vary : by path (``angles.AB``, ``loads.P``), values, (n,) or one number for all rows; zipped; case
        units, degrees
    want : ``answers``, ``status``, ``error``, ``points``, ``centres``, ``rates``, ``velocities``,
        ``accelerations`` (with inertia forces), ``terms``, ``reactions`` (each row is then solved as a scene,
        milliseconds a row); or single ones, ``points.C``, ``centres.2-4``
    drive : by link, degrees by which it is turned from the position as written, (n,) or one number
    dynamic : with the inertia forces of the given motion, as in `icsolve.solve`
    progress : called with the number of rows that were done, time and again

    Returns
    -------
    Sweep
        A row without an answer says so in ``status`` and is not a number in the arrays; it raises nothing.

    Raises
    ------
    ArgumentError
        A TypeError, for what is no case, as the path of one, and columns that have no names.
    CaseError
        For a path that the case does not have.
    SceneError
        Where no row can be solved: the case as written has no figure, lies in space, or cannot be moved so.
    ValueError
        For arrays that can't be columns (of unlike lengths, empty, not finite, of two dimensions), numbers
        that no case may have there, and words that can't be wanted.
    """
    refuse_no_case(case)
    refuse_space(case)
    columns = columns_of(case, vary, drive)
    dynamic = dynamic or case.dynamic
    wanted = request_of(case, names_in(want, "want=('answers', 'points.C')"), dynamic)
    refuse_size(columns, wanted.asked, wanted.error)
    if dynamic and not any(given.speed is not None for given in case.motion):
        raise SceneError(Status.MOBILITY, NO_SPEED)
    if case.touches:
        from icsolve.sweep.cam_sweep import sweep_touching

        return sweep_touching(case, columns, wanted, progress)
    start = start_of(case, columns, told(case, wanted.asked))
    if start.one_by_one:
        return _family(start, columns, wanted, progress)
    alone = wanted.asked.reactions or start.hides or (case.ropes and not start.compiled().taut)
    if alone or (_rubs(case) and not _rubs_at_once(start, wanted)):
        return _by_scenes(start, columns, wanted, progress)
    return _together(start, columns, wanted, progress)


def _together(start: Start, columns: Columns, wanted: SweepRequest, progress: Progress | None) -> Sweep:
    """All rows by one record."""
    work = SweepRun(start, columns, wanted.error, progress)
    work.run()
    left_out, case_of = _without_spare_links(work.table, start, columns, wanted, work.case_of)
    notes = (*work.notes, *left_out)
    found = work.table.sweep(start.case, _shown(columns), wanted.error, notes, case_of)
    if wanted.asked.rates or not found.rates:
        return found
    return replace(found, rates={}, errors={**found.errors, "rates": {}})


@lru_cache(maxsize=64)
def _rubs(case: Case) -> bool:
    return rubs(case)


def _rubs_at_once(start: Start, wanted: SweepRequest) -> bool:
    """Whether the friction of all rows is on the record; it has no bounds."""
    return start.compiled().rubbing is not None and not wanted.error


def _by_scenes(start: Start, columns: Columns, wanted: SweepRequest, progress: Progress | None) -> Sweep:
    """Positions at once, each row then a scene of its own: with friction, ropes, or in a given motion."""
    placed = start._replace(asked=RowRequest(answers=False, points=tuple(shown_points(start.case))))
    work = SweepRun(placed, columns, False)
    work.run()
    table = Table(columns.rows, wanted.asked)
    table.codes[:] = work.codes
    places = [("points", p) for p in wanted.asked.points]  # a spare point may have none
    table.values |= {key: work.values[key] for key in places if key in work.values}
    by_scenes(table, np.flatnonzero(table.codes == 0).tolist(), work.case_of, progress)
    left_out, case_of = _without_spare_links(table, start, columns, wanted, work.case_of)
    notes = (*work.notes, BY_SCENES, *left_out)
    return table.sweep(start.case, _shown(columns), wanted.error, notes, case_of)


def _without_spare_links(
    table: Table, start: Start, columns: Columns, wanted: SweepRequest, case_of: CaseOf
) -> tuple[tuple[str, ...], CaseOf]:
    """Fill in the rows that have no answer as they are, but have one without links that it does not need; a
    note on these, and the case of a row."""
    case = start.setting.case
    part = None
    if table.codes.any():
        with suppress(SceneError):
            part = moving_part(case, start.paths, start.links, wanted.asked.dynamic)
    if part is None:
        return (), case_of
    found_none = ~among(table.codes, SOLVED)
    if needed(start.case, Want()).bodies:
        found_none &= among(table.codes, UNPLACED)
    refused = np.flatnonzero(found_none)
    if not refused.size:
        return (), case_of
    try:
        found = _of_rows(part, columns, refused, wanted)
    except SceneError:
        return (), case_of
    solved = np.flatnonzero(among(found.codes, SOLVED))
    rows = refused[solved]
    if not rows.size:
        return (), case_of
    for array in (*table.values.values(), *table.errors.values()):
        array[rows] = np.nan  # of what is left out a row has nothing
    table.take(rows, found, solved)
    number = dict(zip(rows.tolist(), solved.tolist(), strict=True))
    note = f"{left_out_of(case, part)}, in {plural(len(rows), 'row')}"
    return (note,), lambda row: found.case_of(number[row]) if row in number else case_of(row)


def _of_rows(
    case: Case,
    columns: Columns,
    rows: npt.NDArray[np.intp],
    wanted: SweepRequest,
    progress: Progress | None = None,
) -> Sweep:
    """Some rows, by their indices (n,), as a sweep of another case."""
    vary = {path: array[rows] for path, array in columns.paths.items()}
    drive = {link: array[rows] for link, array in columns.links.items()}
    return sweep(case, vary, wanted.words, drive=drive, dynamic=wanted.asked.dynamic, progress=progress)


def _family(start: Start, columns: Columns, wanted: SweepRequest, progress: Progress | None) -> Sweep:
    """A family of figures without a construction for all: each solved as if written so."""
    table, moving = Table(columns.rows, wanted.asked), start.setting.drive.moving
    notes: dict[str, None] = dict.fromkeys([start.note] if start.note else [])

    cases: dict[int, Callable[[], Case]] = {}

    def case_of(row: int) -> Case:
        return cases[row]()

    for case, rows in families(start.case, columns, moving):
        cases |= dict.fromkeys(rows.tolist(), lambda case=case: case)
        if not moving and not columns.links:
            by_scenes(table, rows.tolist(), case_of, progress)
            continue
        moved = columns._replace(paths={path: columns.paths[path] for path in moving})
        try:
            part = _of_rows(case, moved, rows, wanted, progress)
        except SceneError as error:
            table.codes[rows] = CODE.get(error.status, CODE[Status.NEAR_SINGULAR])
            continue
        notes |= dict.fromkeys(part.notes)
        table.take(rows, part)
        cases |= {row: partial(part.case_of, n) for n, row in enumerate(rows.tolist())}
    return table.sweep(start.case, _shown(columns), wanted.error, tuple(notes), case_of)


def _shown(columns: Columns) -> dict[str, Array]:
    return {columns.names[own]: array for own, array in columns.arrays.items()}
