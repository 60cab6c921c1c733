"""The position from which a sweep starts: the case as written, or the first row that assembles."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache

import numpy as np

from icsolve.assembly import place
from icsolve.assembly.conditions import residual
from icsolve.assembly.steps import Meet, PointGroup, Step, spare_data
from icsolve.assembly.workspace import Workspace, data_in, number_of
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers import FLOATS
from icsolve.sweep.exact_record import hides
from icsolve.sweep.program import CompiledSweep, RowRequest, Setting, Signs, compile_sweep, setting_of
from icsolve.sweep.record_runner import Runner
from icsolve.sweep.request import Columns
from icsolve.sweep.varied_numbers import number_at, with_numbers
from icsolve.tuples import NamedTuple

MOST_TRIED = 400
"""Rows that are tried as the position to start from."""
ELSEWHERE = (Status.CANNOT_ASSEMBLE, Status.CHANGE_POINT)
"""Why another row may serve where the case as written does not."""


@lru_cache(maxsize=64)
def setting(case: Case, paths: tuple[str, ...], links: tuple[str, ...]) -> Setting:
    """As `program.setting_of`, once a case."""
    return setting_of(case, paths, links)


@lru_cache(maxsize=16)
def runner(
    case: Case, paths: tuple[str, ...], links: tuple[str, ...], asked: RowRequest, signs: Signs
) -> Runner:
    """The runner of a compiled sweep, once a case and what is asked."""
    return Runner(compile_sweep(setting(case, paths, links), asked, signs))


def is_hard(setting: Setting) -> bool:
    """Whether numbers are varied that reshape a figure whose construction holds as written only: with a
    group that Newton's method places, with circles that touch, or with data that repeat others; radii in a
    motion, of which one may be straight; or that are of a given motion."""
    reshaping = [path for path in setting.paths if path not in setting.drive.moving]
    if any(map(drives, reshaping)) or (setting.moves and any(".radii." in path for path in reshaping)):
        return True
    shapes = list(filter(shapes_figure, reshaping))
    if not shapes:
        return False
    if any(isinstance(s, PointGroup) or _touches_only_here(s, setting, shapes) for s in setting.figure.steps):
        return True
    return any(_contradicts(setting, path) for path in shapes)


def _touches_only_here(step: Step, setting: Setting, shapes: Sequence[str]) -> bool:
    """Whether two circles touch, and may not where some numbers are others."""
    if not (isinstance(step, Meet) and step.touches):
        return False
    if not step.stays_flat:
        return True
    lengths = [number_of(setting.case, datum).path for datum in data_in(step)]
    return len(lengths) < 3 or any(path in shapes for path in lengths)


def drives(path: str) -> bool:
    """Whether a number is the direction of a given motion, of which no record tells."""
    return path.startswith("motion.") and path.rsplit(".", 1)[-1] not in ("speed", "acceleration")


NUDGED = 1e-3
"""By this fraction (of it, or of 1) a number is changed to see what hangs on it."""


def _contradicts(setting: Setting, path: str) -> bool:
    """Whether a number, changed, contradicts data that the construction of the figure does not need."""
    figure, case = setting.figure, setting.case
    spare = spare_data(figure, case)
    if not spare:
        return False
    value = number_at(case, path).value
    changed = with_numbers(case, {path: value + NUDGED * (abs(value) or 1.0)})
    workspace = Workspace(changed, figure.frame, FLOATS)
    workspace.points.update(place(figure, changed, FLOATS).points)
    return any(abs(residual(workspace, datum)[0]) > NUDGED * NUDGED for datum in spare)


class Start(NamedTuple):
    """The case whose position as written a sweep starts from, what is varied and asked; a note if it is
    not the case as it was given."""

    case: Case
    paths: tuple[str, ...]
    links: tuple[str, ...]
    asked: RowRequest
    note: str = ""
    one_by_one: bool = False
    """whether each row has to be solved as a scene of its own"""

    @property
    def setting(self) -> Setting:
        """Its position, and what the varied numbers do."""
        return setting(self.case, self.paths, self.links)

    def runner(self, signs: Signs = ()) -> Runner:
        """The runner; the branches in ``signs`` have theirs as inputs."""
        return runner(self.case, self.paths, self.links, self.asked, signs)

    @property
    def hides(self) -> bool:
        """Whether the record does not tell what is asked, or doubles lose it: each row is then a scene in its
        position."""
        return hides(self.compiled())

    def compiled(self, signs: Signs = ()) -> CompiledSweep:
        """What the runner runs."""
        return self.runner(signs).compiled


def start_of(case: Case, columns: Columns, asked: RowRequest) -> Start:
    """Where a sweep starts.

    Raises SceneError where the case as written cannot be moved so, or no row assembles.
    """
    start = Start(case, tuple(columns.paths), tuple(columns.links), asked)
    try:
        found = _checked(start)
        left_out = found.setting.left_out
        return found._replace(note=left_out) if left_out else found
    except SceneError as error:
        if error.status not in ELSEWHERE or start.links or not start.paths:
            raise
        return _elsewhere(start, columns, error)


@lru_cache(maxsize=16)
def _checked(start: Start) -> Start:
    """The start, with how its rows are run."""
    if is_hard(start.setting):
        return start._replace(one_by_one=True)
    try:
        compiled = start.compiled()
    except SceneError:
        if start.setting.moves:
            raise
        return start._replace(one_by_one=True)
    if compiled.setting.moves:
        return start
    if start.setting.left_out and (start.asked.points or start.asked.rates or start.asked.centres):
        return start._replace(one_by_one=True)  # another figure may have what is left out of this one
    if not any(map(shapes_figure, start.paths)):
        alone = compiled.refusal is None and (compiled.idle or is_open(start.runner()))
        return start._replace(one_by_one=alone)
    alone = compiled.delicate or compiled.idle or compiled.refusal is not None
    return start._replace(one_by_one=alone)


LOOSE = 1e-3
"""In a figure that stands, an answer with a bound above this fraction of it is left to the scene."""


def is_open(runner: Runner) -> bool:
    """Whether doubles leave an answer open in the figure as written, in which only loads are varied."""
    record, values = runner.compiled.record, runner.still
    sizes = [
        (value, off)
        for (_, _, value), (key, _, off) in zip(values, runner.constants, strict=True)
        if key[0] == "answers"
    ]
    if runner.answers:
        given = {k: np.array([record.nodes[k].value]) for k in runner.compiled.inputs.values()}
        bounds = (float(np.ravel(one.bound)[0]) for one in runner.bounds.run(given, 1))
        sizes += [(record.nodes[k].value, off) for (_, k), off in zip(runner.answers, bounds, strict=True)]
    return any(not off <= LOOSE * abs(value) for value, off in sizes if value)


def shapes_figure(path: str) -> bool:
    """Whether a number is one of the figure or of a joint."""
    return path.split(".", maxsplit=1)[0] in ("points", "lengths", "angles", "joints")


def _elsewhere(start: Start, columns: Columns, refusal: SceneError) -> Start:
    """The first row, along sorted values, that assembles and from which it can go on."""
    for values in _candidates(columns):
        try:
            found = _checked(start._replace(case=with_numbers(start.case, values)))
        except SceneError:
            continue
        said = ", ".join(f"{columns.names[path]} = {value:.6g}" for path, value in values.items())
        note = f"the case as written is no position to start from; the first row that is: {said}."
        return found._replace(note=note)
    raise refusal


def _candidates(columns: Columns) -> Iterator[dict[str, float]]:
    """Rows in order of their values: the first ones, then some over the whole range."""
    order = np.lexsort(list(columns.paths.values())[::-1])
    spread = order[:: max(1, len(order) // MOST_TRIED)]
    for row in spread:
        yield {path: float(a[row]) for path, a in columns.paths.items()}
