"""Rows in motion: velocities and accelerations of points, with the inertia forces among the loads.

The positions of all rows are found at once; each row is then solved as a scene of its own.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from icsolve.answer import Answer
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers.replay import Array
from icsolve.scene import solve_scene
from icsolve.sweep.ask import AskError, Columns, Wanted, shown_points
from icsolve.sweep.program import Asked
from icsolve.sweep.runner import Progress
from icsolve.sweep.start import start_of
from icsolve.sweep.table import Sweep, Table
from icsolve.sweep.work import Work

SAID = "each row is solved as a scene of its own, in the given motion."


def refuse_still(case: Case, wanted: Wanted, dynamic: bool) -> None:
    """Refuse accelerations without inertia forces, and inertia forces without a speed."""
    if "accelerations" in wanted.words and not dynamic:
        raise AskError("accelerations are those of a motion with its inertia forces: ask for `dynamic` too")
    if dynamic and not any(given.speed is not None for given in case.motion):
        from icsolve.kinematics.accelerations import NO_SPEED

        raise SceneError(Status.MOBILITY, NO_SPEED)


def refuse_profiles(dynamic: bool) -> None:
    """Refuse inertia forces of followers on profiles."""
    if dynamic:
        said = "inertia forces are not worked out where profiles give the contacts. Leave out `dynamic`."
        raise SceneError(Status.UNSUPPORTED, said)


def sweep_moving(
    case: Case, columns: Columns, wanted: Wanted, dynamic: bool, progress: Progress | None = None
) -> Sweep:
    """The sweep of a case in motion; ``dynamic`` with its inertia forces.

    Raises SceneError as `icsolve.sweep`.
    """
    start = start_of(case, columns, Asked(answers=False, points=tuple(shown_points(case))))
    if start.one_by_one:
        said = "velocities and accelerations of a family of figures are found one by one: solve with --set."
        raise SceneError(Status.UNSUPPORTED, said)
    work = Work(start, columns, False)
    work.run()
    table = Table(columns.rows, wanted.asked)
    table.codes[:] = work.codes
    seen = _Moving(columns.rows)
    options = {"rates": True, "all_centres": bool(wanted.asked.centres), "examine": bool(wanted.asked.points)}
    for row in np.flatnonzero(table.codes == 0).tolist():
        try:
            answer = solve_scene(work.case_of(row), **options, dynamic=dynamic)
            table.fill(row, answer)
            seen.take(row, answer)
        except SceneError as error:
            table.refuse(row, error)
        if progress is not None:
            progress(1)
    shown = {columns.names[own]: array for own, array in columns.arrays.items()}
    found = table.sweep(case, shown, wanted.error, (*work.notes, SAID), work.case_of)
    if "velocities" in wanted.words:
        found = replace(found, velocities=seen.velocities)
    if "accelerations" in wanted.words:
        found = replace(found, accelerations=seen.accelerations, angular_accelerations=seen.turning)
    return found


class _Moving:
    """Velocities and accelerations of all rows, not a number where there is none."""

    def __init__(self, rows: int) -> None:
        self.rows = rows
        self.velocities: dict[str, Array] = {}
        self.accelerations: dict[str, Array] = {}
        self.turning: dict[str, Array] = {}

    def take(self, row: int, answer: Answer) -> None:
        """Keep those of a row."""
        for kept, found in (
            (self.velocities, answer.velocities),
            (self.accelerations, answer.accelerations),
        ):
            self._points(kept, row, found or {})
        for link, rate in (answer.angular_accelerations or {}).items():
            if not isinstance(rate, str):
                self.turning.setdefault(link, np.full(self.rows, np.nan))[row] = rate

    def _points(
        self,
        kept: dict[str, Array],
        row: int,
        found: Mapping[tuple[str, str], tuple[float, float] | str],
    ) -> None:
        for (point, link), value in found.items():
            if not isinstance(value, str) and not point.startswith("@"):
                kept.setdefault(f"{point} on {link}", np.full((self.rows, 2), np.nan))[row] = value
