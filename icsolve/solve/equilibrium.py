"""A case with an unknown datum of its figure, answered: its positions, or why there are none."""

from __future__ import annotations

import math
from collections.abc import Mapping

from icsolve.answer import Answer
from icsolve.answer.equilibrium import EquilibriumPosition
from icsolve.assembly import solve_figure
from icsolve.case import Case, Coordinates, Unknown
from icsolve.errors import SceneError, Status
from icsolve.scene import solve_scene
from icsolve.scene.needed_part import by_needed_part
from icsolve.solve.driven_search import without
from icsolve.solve.friction_ranges import find_ranges
from icsolve.solve.load_function import given_at, naming_uncarried
from icsolve.solve.positions import (
    Search,
    any_value,
    find_positions,
    refuse_motion,
    refuse_profiles,
)
from icsolve.solve.rest_position import with_scene
from icsolve.solve.two_data import find_pairs
from icsolve.statics.power import has_friction, is_unknown, smooth
from icsolve.sweep.program import wanted_points
from icsolve.sweep.varied_numbers import points_of
from icsolve.tuples import replace
from icsolve.wording import sentences


def solve_positions(case: Case, **asked: bool) -> Answer:
    """The positions of equilibrium of a case whose figure has an unknown datum; ``asked`` as of
    `icsolve.solve`: all_centres, rates, reactions.

    Raises SceneError (``any-value``, ``no-value``) where the loads balance everywhere or nowhere, with what
    the JSON object shows besides.
    """
    refuse_motion(case)
    refuse_profiles(case)
    told = case.unknowns
    case = case if told else replace(case, unknowns=(free_coordinate(case) or Unknown(""),))
    with naming_uncarried(case, [one.path for one in case.unknowns]):
        try:
            answer, left_out = by_needed_part(case, lambda part: _answered(part, asked), bodies=True)
        except SceneError:
            _refuse_placed(replace(case, unknowns=told))
            raise
        return replace(answer, notes=(*answer.notes, left_out)) if left_out else answer


def _refuse_placed(case: Case) -> None:
    """Refuse a datum to find between points that the other data place: it has the value that these give,
    unless the mechanism moves from there."""
    for path in [unknown.path for unknown in case.unknowns if unknown.start is None]:
        names = points_of(path)
        try:
            solve_figure(without(_written(case), path), names)
        except SceneError:
            continue
        raise SceneError(Status.UNSUPPORTED, sentences.placed_without(path, names))


def _answered(case: Case, asked: Mapping[str, bool]) -> Answer:
    if len(case.unknowns) == 2:
        return _two(case, asked)
    unknown = _unknown(case)
    start = start_of(unknown)
    if has_friction(case):
        return _resting(case, unknown, start, asked)
    search = find_positions(_written(case), unknown.path, span_of(unknown), start)
    _refuse_none(search, case.noticed)
    found = []
    for one in search.positions:
        scene = with_scene(one.answer, one.links, **asked)
        at, error = {search.path: one.value}, {search.path: one.error}
        found.append(EquilibriumPosition(at, error, one.stability, one.stiffness, one.why, scene))
    return Answer(case, positions=tuple(found), mobility=1, notes=(*case.noticed, *search.notes))


def _two(case: Case, asked: Mapping[str, bool]) -> Answer:
    """Two unknown data, of a mechanism with two freedoms."""
    _unknown(replace(case, unknowns=case.unknowns[:1]))
    if has_friction(case):
        said = "two unknown data are not searched with friction: give one of them a number, or leave it out."
        raise SceneError(Status.UNSUPPORTED, said)
    paths, starts = [one.path for one in case.unknowns], [start_of(one) for one in case.unknowns]
    if None in starts and any(start is not None for start in starts):
        open_one, written = paths[starts.index(None)], paths[1 - starts.index(None)]
        said = f"{written} says where the figure is written: give {open_one} its `from` too."
        raise SceneError(Status.UNDERDETERMINED, said)
    written_at = [start for start in starts if start is not None]
    search = find_pairs(_written(case), paths, [span_of(one) for one in case.unknowns], written_at, asked)
    if not search.positions:
        raise no_value(" and ".join(paths), None, (*case.noticed, *search.notes))
    notes = (*case.noticed, *search.notes)
    return Answer(case, positions=search.positions, mobility=2, notes=notes)


def free_coordinate(case: Case) -> Unknown | None:
    """The first unknown coordinate that nothing else fixes, where all loads are known; what a profile leaves
    open it fixes itself."""
    if any(map(is_unknown, case.loads)) or not case.loads or case.touches:
        return None
    open_ones = [
        f"points.{name}.{axis}"
        for name, at in case.points.items()
        if isinstance(at, Coordinates)
        for axis, number in (("x", at.x), ("y", at.y))
        if number is None
    ]
    if not open_ones or _is_placed(case):
        return None
    return next((Unknown(path) for path in open_ones if _is_placed(given_at(case, path, 0.5))), None)


def _is_placed(case: Case) -> bool:
    """Whether data enough place every point that is needed."""
    try:
        solve_figure(case, wanted_points(case)[1])
    except SceneError as error:
        return error.status != Status.UNDERDETERMINED
    return True


def start_of(unknown: Unknown) -> float | None:
    """Where the figure is written, if that is told."""
    return None if unknown.start is None else unknown.start.value


def span_of(unknown: Unknown) -> tuple[float, float] | None:
    """The range that a case gives, or None for all that there is."""
    if unknown.low is None or unknown.high is None:
        return None
    return unknown.low.value, unknown.high.value


def _unknown(case: Case) -> Unknown:
    loads = [load.name for load in case.loads if is_unknown(load)]
    if loads:
        raise SceneError(
            Status.MOBILITY,
            f"{loads[0]} is unknown beside {case.unknowns[0].path}: where a mechanism rests is asked for "
            "loads that are all known. Give the load a number, or the figure.",
        )
    if len(case.unknowns) > 1:
        paths = " and ".join(one.path for one in case.unknowns)
        raise SceneError(
            Status.UNSUPPORTED,
            f"{paths} are unknown: positions are searched by one unknown datum, or by two of a mechanism of "
            "mobility 2. Give the others numbers.",
        )
    return case.unknowns[0]


def _written(case: Case) -> Case:
    """The case as an ordinary one; its datum gets a number before it is used."""
    return replace(case, unknowns=(), motion=(), expect=())


def _refuse_none(search: Search, noticed: tuple[str, ...]) -> None:
    if search.any_value:
        raise any_value(search.path)
    if not search.positions:
        raise no_value(search.path, search.nearest, (*noticed, *search.notes))


def no_value(path: str, nearest: float | None, notes: tuple[str, ...]) -> SceneError:
    """The refusal of a case whose loads balance nowhere."""
    where = "" if nearest is None else f" They come nearest to it at {path} = {nearest:.6g}."
    more: dict[str, object] = {"positions": [], **({"notes": list(notes)} if notes else {})}
    if nearest is not None and math.isfinite(nearest):
        more["nearest"] = {"at": {path: nearest}}
    said = "".join(f" {note}" for note in notes)
    return SceneError(
        Status.NO_VALUE, f"the loads balance for no value of {path} that was searched.{where}{said}", more
    )


def _resting(case: Case, unknown: Unknown, start: float | None, asked: Mapping[str, bool]) -> Answer:
    """With friction: the ranges in which the mechanism holds still."""
    search = find_ranges(_written(case), unknown.path, span_of(unknown), start)
    if not search.ranges:
        bare = find_positions(smooth(_written(case)), unknown.path, span_of(unknown), start)
        nearest = next((one.value for one in bare.positions), bare.nearest)
        raise no_value(unknown.path, nearest, (*case.noticed, *search.notes))
    found = [
        EquilibriumPosition(
            {unknown.path: one.held},
            {unknown.path: one.error},
            None,
            None,
            "",
            with_scene(solve_scene(one.case), (), **{**asked, "reactions": False}),
        )
        for one in search.ranges
    ]
    notes = [*case.noticed, *search.notes]
    if asked["reactions"]:
        notes.append(
            "how much of the friction acts nothing says while it holds still, so no reactions are told."
        )
    if case.motion:
        notes.append("the ranges are those of rest: `motion` gives speeds alone, no sense to the friction.")
    return Answer(case, positions=tuple(found), mobility=1, notes=tuple(notes))
