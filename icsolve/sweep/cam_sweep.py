"""Sweeps of cases with profiles: all rows by one record, and those in doubt as scenes of their own.

The pressure angles of a cam for `solve --report`: now, and over a turn.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from icsolve.answer import Answer
from icsolve.answer.bodies import Touching
from icsolve.cams.contact_candidates import Turn
from icsolve.cams.words import follower_driven, lost_rows, widest_pressure
from icsolve.case import Case
from icsolve.case.joints import Mesh
from icsolve.case.profiles import Flat, Knife, Roller
from icsolve.errors import SceneError, Status
from icsolve.numbers.replay import Array
from icsolve.scene import solve_scene
from icsolve.sweep.cam_motion import CamMotion, Rows, cam_motion
from icsolve.sweep.first_contact import Mask
from icsolve.sweep.numbers import with_numbers
from icsolve.sweep.program import RowRequest, setting_of
from icsolve.sweep.request import Columns, SweepRequest
from icsolve.sweep.runner import Key, Progress
from icsolve.sweep.runner import Rows as Which
from icsolve.sweep.table import CODE, KINDS, Sweep, Table
from icsolve.tuples import NamedTuple, replace
from icsolve.wording.sentences import listed

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


class _Seen:
    """What the rows tell of each contact: the widest pressure angle and where, and the rows that lose it."""

    def __init__(self) -> None:
        self.widest: dict[tuple[str, ...], tuple[float, int]] = {}
        self.lost: dict[tuple[str, ...], list[int]] = {}
        self.at: dict[tuple[str, ...], list[tuple[Which, Array]]] = {}

    def take(self, row: int, touching: Iterable[Touching]) -> None:
        """Note a row's contacts."""
        for one in touching:
            angle = np.nan if one.pressure_angle is None else one.pressure_angle
            here = (np.array([row]), np.array([one.at]), np.array([angle]), np.array([one.lost]))
            self.take_all(one.links, *here)

    def take_all(self, links: tuple[str, ...], rows: Which, at: Array, angles: Array, lost: Mask) -> None:
        """Note a contact in some rows: its places (rows, 2), pressure angles (rows,) [degrees; nan: none],
        where it is lost (rows,).
        """
        self.at.setdefault(links, []).append((rows, at))
        if np.isfinite(angles).any():
            k = int(np.flatnonzero(angles >= np.nanmax(angles) - ONE_ANGLE)[0])
            widest, row = self.widest.get(links, (-1.0, 0))
            wider = float(angles[k]) - widest
            if wider > ONE_ANGLE or (wider > -ONE_ANGLE and rows[k] < row):
                self.widest[links] = (float(angles[k]), int(rows[k]))
        if lost.any():
            self.lost.setdefault(links, []).extend(rows[lost].tolist())

    def places(self, count: int) -> dict[str, Array]:
        """Where the contacts are in all rows, (count, 2) each [case lengths]; nan where one is lost."""
        found = {"-".join(links): np.full((count, 2), np.nan) for links in self.at}
        for links, parts in self.at.items():
            for rows, at in parts:
                found["-".join(links)][rows] = at
        return found

    def notes(self, columns: Columns) -> Iterator[str]:
        """Sentences about them."""

        def where(row: int) -> str:
            return ", ".join(f"{columns.names[k]} = {float(a[row]):.6g}" for k, a in columns.arrays.items())

        for links, (angle, row) in self.widest.items():
            yield widest_pressure(links, angle, where(row))
        for links, rows in self.lost.items():
            yield lost_rows(links, len(rows), where(rows[0]))


def sweep_touching(case: Case, columns: Columns, wanted: SweepRequest, progress: Progress | None) -> Sweep:
    """The sweep of a case with profiles; ``progress`` is told each row.

    Raises SceneError as `icsolve.sweep`, and where a follower cannot be followed.
    """
    table, seen, parts = Table(columns.rows, wanted.asked), _Seen(), []
    first = cam_motion(case)
    moving = _moving(first, columns)
    for part in _parts(case, columns, moving, table):
        parts.append(part)
        done = _together(table, part, wanted.error, seen)
        if progress is not None and done.any():
            progress(int(done.sum()))
        for n in np.flatnonzero(~done).tolist():
            _fill(table, part, n, int(part.rows[n]), columns, seen)
            if progress is not None:
                progress(1)
    notes = (SAID, *(one.note for one in first.touching if one.note), *seen.notes(columns))

    def case_of(row: int) -> Case:
        part = next(part for part in parts if row in part.rows)
        at = int(np.flatnonzero(part.rows == row)[0])
        return part.run.case_of(at) if part.run else _written(part.case, columns, row)

    shown = {columns.names[own]: array for own, array in columns.arrays.items()}
    swept = table.sweep(case, shown, wanted.error, notes, case_of)
    return replace(swept, touching=seen.places(columns.rows)) if wanted.asked.points else swept


def _moving(course: CamMotion, columns: Columns) -> set[str]:
    """The varied paths that move the mechanism.

    Raises SceneError where a follower is to be turned, or a link cannot be.
    """
    for follow in course.follows:
        if follow.seeking.guided in columns.links:
            cams = [one.seeking.cam for one in course.follows if one.driver == follow.driver]
            raise SceneError(Status.MOBILITY, follower_driven(follow.seeking.guided, cams))
    turned = [follow.driver for follow in course.follows if isinstance(follow.freedom, Turn)]
    slid = [follow.driver for follow in course.follows if not isinstance(follow.freedom, Turn)]
    own = [path for path in columns.paths if not path.startswith("profile.")]
    setting = setting_of(course.open, [*own, *slid], [*columns.links, *turned])
    return {path for path in setting.drive.moving if path in columns.paths}


def _parts(case: Case, columns: Columns, moving: set[str], table: Table) -> Iterator[CamRows]:
    """The rows by figures: those whose reshaping numbers are the same."""
    shaping = [p for p in columns.paths if p not in moving and p.split(".")[0] in SHAPING]
    for values, rows in _alike(columns, shaping):
        try:
            changed = with_numbers(case, values) if values else case
            alike = set(columns.paths) <= {*shaping, *moving}
            yield CamRows(changed, rows, _run(changed, columns, rows, moving, shaping), alike)
        except SceneError as error:
            if not shaping:
                raise
            for row in rows.tolist():
                table.refuse(row, error)


def _alike(columns: Columns, shaping: list[str]) -> Iterator[tuple[dict[str, float], Which]]:
    """Sets of numbers, and the rows that have them."""
    if not shaping:
        yield {}, np.arange(columns.rows)
        return
    table = np.stack([columns.paths[p] for p in shaping], axis=1)
    sets, which = np.unique(table, axis=0, return_inverse=True)
    for n, numbers in enumerate(sets):
        yield dict(zip(shaping, map(float, numbers), strict=True)), np.flatnonzero(which.ravel() == n)


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


def _together(table: Table, part: CamRows, error: bool, seen: _Seen) -> Mask:
    """Fill in the rows of a part that one record solves all at once; which these are."""
    case, run = part.case, part.run
    teeth = any(isinstance(joint, Mesh) and joint.pressure_angle is not None for joint in case.joints)
    if run is None or teeth or error or table.asked.in_motion:
        return np.zeros(len(part.rows), dtype=bool)
    values, done = run.together(table.asked)
    if part.alike and table.asked.answers:
        _dwell(run, values, done, table.asked)
    rows = part.rows[done]
    own = Table(len(rows), table.asked)
    own.values = {key: array[done] for key, array in values.items() if key[0] in KINDS}
    table.take(rows, own)
    for follow, rested in zip(run.course.follows, run.rested, strict=True):
        force = values.get(("contact", follow.seeking.hidden))
        lost = force[done] < 0.0 if force is not None else np.zeros(len(rows), dtype=bool)
        at = rested.point[done]
        seen.take_all(follow.seeking.touch.links, rows, at, follow.pressure(at, rested.normal[done]), lost)
    return done


def _dwell(run: Rows, values: dict[Key, Array], done: Mask, asked: RowRequest) -> None:
    """Fill in doubtful rows in which every follower rests: what the first, the middle and the last of them
    have as scenes, no answer or none but 0, they all have."""
    rows = np.flatnonzero(run.dwelling & ~done)
    if len(rows) <= len(PROOFS):
        return
    found: list[Answer] = []
    refused: list[str] = []
    for n in (int(share * (len(rows) - 1)) for share in PROOFS):
        try:
            found.append(solve_scene(run.case_of(int(rows[n])), **_options(asked)))
        except SceneError as error:
            refused.append(error.status)
    if len(refused) == len(PROOFS) and len(set(refused)) == 1 and refused[0] in CODE:
        run.codes[rows] = CODE[refused[0]]
    elif not refused and not any(one.value for answer in found for one in answer.answers.values()):
        rates = [answer.rates or {} for answer in found]
        still = {link for link in run.course.case.links if all(one.get(link) == 0.0 for one in rates)}
        for (kind, name), array in values.items():
            if kind == "answers" or (kind == "rates" and name in still):
                array[rows] = 0.0
        done[rows] = True


def _fill(table: Table, part: CamRows, n: int, row: int, columns: Columns, seen: _Seen) -> None:
    """Solve one row."""
    asked = table.asked
    if part.run is not None and part.run.codes[n]:
        table.codes[row] = part.run.codes[n]
        return
    try:
        case = part.run.case_of(n) if part.run is not None else _written(part.case, columns, row)
        answer = solve_scene(case, **_options(asked))
    except SceneError as error:
        table.refuse(row, error)
        return
    table.fill(row, answer)
    seen.take(row, answer.touching)


def _options(asked: RowRequest) -> Mapping[str, bool]:
    rates = asked.rates or asked.velocities
    more = {"all_centres": bool(asked.centres), "examine": bool(asked.points), "dynamic": asked.dynamic}
    return {**more, "rates": rates, "bound": True}


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
    if not case.pivots(cam, case.ground):
        return {}
    try:
        rows = Rows(cam_motion(case), Columns({}, {cam: np.arange(0.0, 360.0, STEP)}, {cam: cam}))
        if rows.codes.any():
            return {}
        seen: dict[tuple[str, str], list[float]] = {}
        for row in range(rows.columns.rows):
            for one in rows.touching(row):
                if one.pressure_angle is not None:
                    seen.setdefault(one.links, []).append(one.pressure_angle)
    except SceneError:
        return {}
    return {links: (min(angles), max(angles)) for links, angles in seen.items()}
