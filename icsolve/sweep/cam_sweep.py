"""Sweeps of cases with profiles: all rows by one record, and those in doubt as scenes of their own.

The pressure angles of a cam for `solve --report`: now, and over a turn.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from icsolve.answer import Answer
from icsolve.cams.contact_candidates import Turn
from icsolve.cams.words import follower_driven, lost_rows, widest_pressure
from icsolve.case import Case
from icsolve.case.joints import Mesh
from icsolve.case.profiles import Flat, Knife, Roller
from icsolve.errors import SceneError, Status
from icsolve.numbers.replay import Array, Mask
from icsolve.scene.sensitivity import parts_of
from icsolve.structure import welded
from icsolve.sweep.cam_motion import CamMotion, Rows, cam_motion
from icsolve.sweep.program import RowRequest, setting_of
from icsolve.sweep.record_runner import Key, Progress
from icsolve.sweep.record_runner import Rows as Which
from icsolve.sweep.request import Columns, SweepRequest
from icsolve.sweep.row_parts import distinct_rows
from icsolve.sweep.rows_by_scenes import by_scenes
from icsolve.sweep.table import Sweep, Table
from icsolve.sweep.varied_numbers import with_numbers
from icsolve.tuples import NamedTuple, replace
from icsolve.wording import listed

SAID = "in every row the contacts are found on the profiles."
PROOFS = (0.0, 0.5, 1.0)
"""Which of the rows of a dwell are solved as scenes: as shares of their number."""
ONE_ANGLE = 1e-9
"""Pressure angles nearer to each other than this [degrees] are one."""
SHAPING = ("points", "lengths", "angles", "profile", "joints")


class CamRows(NamedTuple):
    """Rows of one figure: what they are run by, None where no link moves; and whether they differ in their
    position alone."""

    case: Case
    rows: Which
    run: Rows | None
    alike: bool


def sweep_touching(case: Case, columns: Columns, wanted: SweepRequest, progress: Progress | None) -> Sweep:
    """The sweep of a case with profiles; ``progress`` is told each row.

    Raises SceneError as `icsolve.sweep`, and where a follower cannot be followed.
    """
    table, first = Table(columns.rows, wanted.asked), cam_motion(case)
    parts: list[CamRows] = []

    def case_of(row: int) -> Case:
        part = next(part for part in parts if row in part.rows)
        at = int(np.flatnonzero(part.rows == row)[0])
        return part.run.case_of(at) if part.run else _written(part.case, columns, row)

    for part in _parts(case, columns, _moving(case, first, columns), table):
        parts.append(part)
        left = part.rows[~_together(table, part, wanted.error)]
        left = left[table.codes[left] == 0]
        if progress is not None and len(left) < len(part.rows):
            progress(len(part.rows) - len(left))
        by_scenes(table, left.tolist(), case_of, progress)
    notes = (SAID, *(one.note for one in first.touching if one.note), *_notes(case, columns, table))
    shown = {columns.names[own]: array for own, array in columns.arrays.items()}
    swept = table.sweep(case, shown, wanted.error, notes, case_of)
    if not wanted.asked.points:
        return swept
    places = {name: array[:, :2] for (kind, name), array in table.values.items() if kind == "touching"}
    return replace(swept, touching=places)


def _notes(case: Case, columns: Columns, table: Table) -> Iterator[str]:
    """What the rows tell of each contact: the widest pressure angle and where, and the rows that lose it."""

    def where(row: int) -> str:
        return ", ".join(f"{columns.names[k]} = {float(a[row]):.6g}" for k, a in columns.arrays.items())

    found = {touch.links: table.values.get(("touching", "-".join(touch.links))) for touch in case.touches}
    known = {links: array for links, array in found.items() if array is not None}
    for links, (_, _, angles, _) in ((links, array.T) for links, array in known.items()):
        if np.isfinite(angles).any():
            row = int(np.flatnonzero(angles >= np.nanmax(angles) - ONE_ANGLE)[0])
            yield widest_pressure(links, float(angles[row]), where(row))
    for links, array in known.items():
        lost = np.flatnonzero(array[:, 3] == 1.0)
        if lost.size:
            yield lost_rows(links, len(lost), where(int(lost[0])))


def _moving(case: Case, course: CamMotion, columns: Columns) -> set[str]:
    """The varied paths that move the mechanism; those of its profiles and contacts do not.

    Raises SceneError where a follower is to be turned, or a link cannot be.
    """
    for follow in course.follows:
        driven = [link for link in welded(course.open, follow.seeking.guided) if link in columns.links]
        if driven:
            cams = [one.seeking.cam for one in course.follows if one.driver == follow.driver]
            raise SceneError(Status.MOBILITY, follower_driven(driven[0], cams))
    turned = [follow.driver for follow in course.follows if isinstance(follow.freedom, Turn)]
    slid = [follow.driver for follow in course.follows if not isinstance(follow.freedom, Turn)]
    shapes = parts_of(case)["profiles"]
    own = [path for path in columns.paths if path not in shapes]
    paths, links = dict.fromkeys((*own, *slid)), dict.fromkeys((*columns.links, *turned))
    setting = setting_of(course.open, [*paths], [*links])
    return {path for path in setting.drive.moving if path in columns.paths}


def _parts(case: Case, columns: Columns, moving: set[str], table: Table) -> Iterator[CamRows]:
    """The rows by figures: those whose reshaping numbers are the same."""
    shaping = [p for p in columns.paths if p not in moving and p.split(".")[0] in SHAPING]
    table_of = np.array([columns.paths[p] for p in shaping]).T
    sets, which = distinct_rows(table_of) if shaping else (np.empty((1, 0)), np.zeros(columns.rows, np.int64))
    for n, numbers in enumerate(sets):
        values, rows = dict(zip(shaping, map(float, numbers), strict=True)), np.flatnonzero(which == n)
        try:
            changed = with_numbers(case, values) if values else case
            alike = set(columns.paths) <= {*shaping, *moving}
            yield CamRows(changed, rows, _run(changed, columns, rows, moving, shaping), alike)
        except SceneError as error:
            if not shaping:
                raise
            for row in rows.tolist():
                table.refuse(row, error)


def _run(case: Case, columns: Columns, rows: Which, moving: set[str], shaping: list[str]) -> Rows | None:
    """What runs the rows of a figure; None where nothing moves."""
    if not moving and not columns.links:
        return None
    paths = {path: a[rows] for path, a in columns.paths.items() if path not in shaping}
    links = {link: a[rows] for link, a in columns.links.items()}
    return Rows(cam_motion(case), Columns(paths, links, columns.names))


def _written(case: Case, columns: Columns, row: int) -> Case:
    """The case of a row as if written so."""
    return with_numbers(case, {path: float(a[row]) for path, a in columns.paths.items()})


def _together(table: Table, part: CamRows, error: bool) -> Mask:
    """Fill in the rows of a part that one record solves all at once, and the statuses of those that do not
    assemble; which are solved."""
    case, run = part.case, part.run
    done = np.zeros(len(part.rows), dtype=bool)
    if run is None:
        return done
    teeth = any(isinstance(joint, Mesh) and joint.pressure_angle is not None for joint in case.joints)
    if not (teeth or error or table.asked.reactions):
        values, done = run.together(table.asked)
        if values and part.alike and table.asked.answers:
            _dwell(run, values, done, table.asked)
        own = Table(int(done.sum()), table.asked)
        own.values = {key: array[done] for key, array in values.items()}
        table.take(part.rows[done], own)
    table.codes[part.rows[~done]] = run.codes[~done]
    return done


def _dwell(run: Rows, values: dict[Key, Array], done: Mask, asked: RowRequest) -> None:
    """Fill in doubtful rows in which every follower rests: what the first, the middle and the last of them
    have as scenes, no answer or none but 0, they all have."""
    rows = np.flatnonzero(run.dwelling & ~done)
    if len(rows) <= len(PROOFS):
        return
    some = [int(rows[int(share * (len(rows) - 1))]) for share in PROOFS]
    proofs = Table(run.columns.rows, asked)
    by_scenes(proofs, some, run.case_of)
    codes, found = proofs.codes[some], {key: array[some] for key, array in proofs.values.items()}
    if codes.any():
        run.codes[rows] = codes[0] if len(set(codes.tolist())) == 1 else run.codes[rows]
    elif not any(array.any() for (kind, _), array in found.items() if kind == "answers"):
        for key, array in values.items():
            if key[0] == "answers" or (key[0] == "rates" and not found[key].any()):
                array[rows] = 0.0
        done[rows] = True


STEP = 2.0
"""Degrees between the positions of a turn that are looked at."""


class Pressure(NamedTuple):
    """The pressure angle of a contact, degrees: now, and its least and greatest over a turn of ``cam``.

    ``over`` is None where the cam does not turn fully with its follower on it.
    """

    links: tuple[str, str]
    on: str
    now: float | None
    cam: str
    over: tuple[float, float] | None = None

    def text(self, digits: int) -> str:
        """A line for people."""
        if self.now is None:
            return f"  contact of links {listed(self.links)}: its follower has no guide on the frame"
        said = f"  contact of links {listed(self.links)}: pressure angle {self.now + 0.0:.{digits}g} deg"
        if self.over is None:
            return said
        least, greatest = self.over
        return f"{said}, from {least:.4g} to {greatest:.4g} over a turn of link {self.cam} by {STEP:g} deg"


def pressures(answer: Answer) -> tuple[Pressure, ...]:
    """The pressure angles of an answer, in the order of the contacts."""
    case, found = answer.case, []
    for one in answer.touching:
        cam = _cam(case, one.links)
        over = _over_a_turn(case, cam) if one.pressure_angle is not None else {}
        found.append(Pressure(one.links, one.on, one.pressure_angle, cam, over.get(one.links)))
    return tuple(found)


def _cam(case: Case, links: tuple[str, str]) -> str:
    """The link of a contact that has the profile."""
    assert case.profiles is not None
    a, b = links
    return b if isinstance(case.profiles.shapes[a], Flat | Roller | Knife) else a


def _over_a_turn(case: Case, cam: str) -> Mapping[tuple[str, str], tuple[float, float]]:
    """Least and greatest pressure angle of every contact that the whole turn of a cam keeps."""
    if not any(case.pivots(own, held) for own in welded(case, cam) for held in welded(case, case.ground)):
        return {}
    try:
        rows = Rows(cam_motion(case), Columns({}, {cam: np.arange(0.0, 360.0, STEP)}, {cam: cam}))
        found = {} if rows.codes.any() else rows.pressures()
    except SceneError:
        return {}
    return {links: (float(angles.min()), float(angles.max())) for links, angles in found.items()}
