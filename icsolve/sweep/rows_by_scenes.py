"""Rows that are solved one by one as scenes of their own: with friction, and families of figures that have
no construction for all rows at once. Slower, and with every rule of a single scene."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress

import numpy as np

from icsolve.assembly import Figure, case_point, place, placed_figure
from icsolve.assembly.steps import Meet
from icsolve.assembly.workspace import Frame
from icsolve.case import Case, is_named
from icsolve.errors import SceneError, Status
from icsolve.files import can_fork, started
from icsolve.numbers import FLOATS
from icsolve.numbers.balls import PRECISIONS, Balls, BelowZero, MoreDigits
from icsolve.numbers.replay import Array
from icsolve.scene import examined, solve_scene
from icsolve.screws import Point
from icsolve.sweep.program import wanted_points
from icsolve.sweep.record_runner import Progress, Rows
from icsolve.sweep.request import Columns
from icsolve.sweep.table import Table
from icsolve.sweep.varied_numbers import number_at, with_numbers
from icsolve.tuples import replace

Place = tuple[float, float]
FEW = 8
PATIENCE, WORTH = 0.3, 0.8
"""Seconds: how long rows are solved one after another before the others are asked for help, if as much as
that is left."""
MOST = 8


def by_scenes(
    table: Table,
    rows: Iterable[int],
    case_of: Callable[[int], Case],
    progress: Progress | None = None,
    *,
    missing: bool = False,
) -> None:
    """Solve rows as scenes (where ``missing``, for their status and what they have no value of); in several
    processes once they turn out to take long."""
    every = list(rows)
    start = time.monotonic()
    for n, row in enumerate(every):
        _one(table, row, case_of, missing)
        if progress is not None:
            progress(1)
        spent = time.monotonic() - start
        if n % FEW == FEW - 1 and spent > PATIENCE and spent * (len(every) - n) > WORTH * n and can_share():
            shared(table, every[n + 1 :], case_of, progress, missing)
            return


def _one(table: Table, row: int, case_of: Callable[[int], Case], missing: bool) -> None:
    asked = table.asked
    try:
        case = case_of(row)
        if missing:
            centres = table.lacks(row, "centres")
            rates, dynamic = table.lacks(row), asked.dynamic
            answer = solve_scene(case, rates=rates, all_centres=centres, dynamic=dynamic, alone=True)
        else:
            solved = examined if asked.points else solve_scene
            answer = solved(
                case,
                rates=asked.rates or asked.velocities,
                all_centres=bool(asked.centres),
                dynamic=asked.dynamic,
                reactions=asked.reactions,
                alone=True,
            )
        table.fill(row, answer, missing)
    except SceneError as error:
        table.refuse(row, error)


def can_share() -> bool:
    """Whether other processors can help: not where threads run, which a new process would not have."""
    from multiprocessing import current_process

    many = (os.cpu_count() or 1) > 1 and threading.active_count() == 1
    return many and can_fork() and not current_process().daemon


def shared(
    table: Table,
    rows: list[int],
    case_of: Callable[[int], Case],
    progress: Progress | None = None,
    missing: bool = False,
) -> None:
    """Solve rows in as many processes as there are processors, this one among them."""
    count = min(os.cpu_count() or 1, MOST)
    shares = [rows[k::count] for k in range(count)]

    def alone(some: list[int]) -> Table:
        for row in some:
            _one(table, row, case_of, missing)
        return table.some(some)

    with started([(alone, (some,)) for some in shares[1:]]) as results:
        for row in shares[0]:
            _one(table, row, case_of, missing)
            if progress is not None:
                progress(count)
        for some, part in zip(shares[1:], results(), strict=True):
            table.take(some, part)


# --- families that have no construction for all rows ----------------------------------------------


def families(case: Case, columns: Columns, moving: Iterable[str]) -> Iterator[tuple[Case, Rows]]:
    """For each set of reshaping numbers the case as if written so, and the indices of its rows, (some,):
    outward from the case as written, each near to the closest that was placed before, so that branches are
    kept; one that does not assemble is given as it is."""
    reshaping = [path for path in columns.paths if path not in set(moving)]
    table = np.stack([columns.paths[path] for path in reshaping], axis=1)
    sets, which = np.unique(table, axis=0, return_inverse=True)
    steps = _steps(sets, [number_at(case, path).value for path in reshaping])
    done, nears = [np.zeros(len(reshaping))], [_places(case)[0] or case.near]
    for n in np.argsort(np.abs(steps).max(axis=1), kind="stable"):
        changed = with_numbers(case, dict(zip(reshaping, map(float, sets[n]), strict=True)))
        closest = int(np.abs(np.array(done) - steps[n]).max(axis=1).argmin())
        placed = replace(changed, near=nears[closest])
        found, status = _places(placed)
        # what data place anew may lie opposite to where it was; a point that no joint needs is then left out
        if status == Status.INCONSISTENT or (found is not None and not placed.near.keys() <= found.keys()):
            placed = changed
            found, _ = _places(placed)
        yield placed, np.flatnonzero(which.ravel() == n)
        if found is not None:
            done.append(steps[n])
            nears.append(found)


def _steps(sets: Array, written: list[float]) -> Array:
    """How far sets of numbers are from the written ones, as parts of the range of each number."""
    size = np.ptp(np.vstack([sets, written]), axis=0)
    steps: Array = (sets - written) / np.where(size > 0.0, size, 1.0)
    return steps


def placed_near(case: Case, figure: Figure) -> Case:
    """A case with other numbers, with `near` where the branches of its figure as written put the points, to
    so many digits that beside a limit too it is nearer to the one place than to the other."""
    for arithmetic in (Balls(PRECISIONS[0]), FLOATS):  # floats where it does not assemble
        with suppress(SceneError, ZeroDivisionError, BelowZero, MoreDigits):
            points = place(figure, case, arithmetic).points
            near = {p: (float(x), float(y)) for p, (x, y) in points.items()}
            return replace(case, near=_shown(figure.frame, near))
    return case


def _shown(frame: Frame, points: Mapping[str, Point]) -> dict[str, Place]:
    """The points that the file names, in case units."""
    return {name: case_point(frame, at) for name, at in points.items() if is_named(name)}


def _places(case: Case) -> tuple[dict[str, Place] | None, str]:
    """Where the points of a figure are, in case units, or what the case's `near` says where circles touch,
    which tells no side; None, and why, where it does not assemble."""
    try:
        figure = placed_figure(case, *wanted_points(case))
    except SceneError as refusal:
        return None, refusal.status
    touches = any(isinstance(step, Meet) and step.touches for step in figure.steps)
    return dict(case.near) if touches else _shown(figure.frame, figure.points), Status.OK
