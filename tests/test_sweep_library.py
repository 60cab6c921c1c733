"""Every case of the library, swept by every link and along every number: rows with their status, or a
refusal of the whole; never a number that is none beside an ok, never a fault, never a warning."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator
from random import Random
from typing import Any

import numpy as np
import pytest

import icsolve
from icsolve.case import Number
from icsolve.manual import kinds, template
from icsolve.sweep.table import _parted, columns
from icsolve.sweep.varied_numbers import numbers_of
from library import FILES, sample
from sizes import FULL, sampled

ALL = ("answers", "status", "error", "points", "centres", "rates")
FEW = ("answers", "status", "error", "points")
PLAIN = ("answers", "status", "points", "rates")
SOME = 6
"""So many of its numbers, drawn, are varied in each run."""
MANY = 7
"""So many links have more centres than a quick test bounds."""


def sweeps(case: icsolve.Case) -> Iterator[icsolve.Sweep]:
    """A turn of every link, and a range of every number; those that can't be are refused."""
    turns = [({}, {link: np.arange(0.0, 361.0, 30.0)}) for link in case.links if link != case.ground]
    ranges = [({path: around(path, number)}, {}) for path, number in numbers_of(case).items()]
    if not FULL and len(ranges) > SOME:
        ranges = Random(case.title).sample(ranges, SOME)
    for vary, drive in (*turns, *ranges):
        with contextlib.suppress(icsolve.SceneError):
            want = PLAIN if vary else ALL if len(case.links) < MANY else FEW
            yield icsolve.sweep(case, vary, want, drive=drive)


def around(path: str, number: Number) -> np.ndarray:
    value, least = number.value, 0.0 if number.bound else -1.0
    if path.startswith("angles.") or path.endswith(".angle"):
        return np.linspace(value - 90.0, value + 90.0, 5)
    near = np.linspace(0.7 * value, 1.3 * value, 5) if value else np.linspace(least, 1.0, 5)
    return near.round() if ".teeth" in path else near


def holes(sweep: icsolve.Sweep) -> list[str]:
    """What is not a finite number in a row whose status is ok. Of cams by profiles no bound is proven, nor of
    ropes that slip or screws that rub."""
    ok, case = sweep.status == "ok", sweep.case
    rubs = any(rope.slips for rope in case.ropes) or any(screw.rubs for screw in case.screws)
    tables = dict(sweep.kinds) if case.profiles or rubs else {**sweep.kinds, "error": sweep.error}
    arrays = {f"{kind} {name}": array for kind, table in tables.items() for name, array in table.items()}
    empty = [(name, array) for name, array in arrays.items() if not np.isfinite(array[ok]).all()]
    return [name for name, array in empty if not all(left_open(sweep, name, k) for k in gaps(array, ok))]


def gaps(array: np.ndarray, ok: np.ndarray) -> list[int]:
    """The rows in which a number is missing."""
    whole = np.isfinite(array).reshape(len(array), -1).all(axis=1)
    return np.flatnonzero(ok & ~whole).tolist()


def left_open(sweep: icsolve.Sweep, name: str, row: int) -> bool:
    """Whether the scene of a row has no speed of a link, or no one centre of two: another freedom moves it,
    or it is a structure."""
    kind, _, link = name.partition(" ")
    if kind == "centres":
        centres = icsolve.solve(sweep.case_of(row), all_centres=True).centres
        return next(c.kind for pair, c in centres.items() if "-".join(pair) == link) == "undetermined"
    if kind != "rates":
        return False
    rates = icsolve.solve(sweep.case_of(row), rates=True).rates
    return rates is None or isinstance(rates[link], str)


@sampled(3)
@pytest.mark.parametrize("name", sample(FILES, 14, "rows"))
def test_every_row_has_its_numbers_or_its_status(name: str) -> None:
    case = icsolve.load(FILES[name])
    if case.unknowns:
        return  # a case that asks for a dimension or a position is no row of a sweep
    for sweep in sweeps(case):
        assert holes(sweep) == [], (list(sweep.vary), sweep.status.tolist())
        assert len(sweep) == len(sweep.status)


TEMPLATES = {f"new {kind}": template(kind) for kind in kinds()}
SOURCES = {**{name: str(path) for name, path in FILES.items()}, **TEMPLATES}


@sampled(3)
@pytest.mark.parametrize("name", [*sample(FILES, 4, "wanted"), *TEMPLATES])
def test_what_is_wanted_besides_changes_no_row(name: str) -> None:
    """Velocities are worked out scene by scene: the rows are those of the sweep without them."""
    case = icsolve.load(SOURCES[name])
    for link in () if case.unknowns else case.links:
        turn = {link: np.array([0.0, 0.5, 25.0])}
        with contextlib.suppress(icsolve.SceneError):
            plain = icsolve.sweep(case, {}, ("answers", "status"), drive=turn)
            full = icsolve.sweep(case, {}, ("answers", "status", "velocities", "rates"), drive=turn)
            assert full.status.tolist() == plain.status.tolist()
            for load, values in plain.answers.items():
                assert full.answers[load] == pytest.approx(values, rel=1e-9, abs=1e-12, nan_ok=True)
            return


LIMITED = "linkages/double_butterfly_symmetric.yaml"
"""Link 3 turns by less than half a degree one way; in the position as written several velocities are 0."""


@sampled(5)
@pytest.mark.parametrize("name", sorted({*sample(FILES, 12, "motion"), LIMITED}))
def test_what_rows_tell_of_their_motion_is_what_the_row_as_a_scene_tells(name: str) -> None:
    """Rates, velocities, centres, and the power of a unit of each load, of one freedom or several; to 1e-9 of
    the largest."""
    case = icsolve.load(FILES[name])
    if case.unknowns or case.dynamic or case.space is not None:
        return
    want = ("answers", "rates", "velocities", "centres", "terms")
    for link in case.links:
        with contextlib.suppress(icsolve.SceneError):
            found = icsolve.sweep(case, want=want, drive={link: np.arange(-10.0, 11.0, 5.0)})
            for row in np.flatnonzero(found.status == "ok").tolist():
                answer = icsolve.solve(found.case_of(row), rates=True, all_centres=True)
                for (a, b), centre in answer.centres.items():
                    assert not centre.place or same_place(found.centres[f"{a}-{b}"][row], centre), (
                        link,
                        a,
                        b,
                    )
                for kind, scene in motion_of(answer).items():
                    rows = found.kinds[kind]
                    most = max((np.abs(value).max() for value in scene.values()), default=0.0)
                    for own, value in scene.items():
                        assert rows[own][row] == pytest.approx(value, rel=1e-9, abs=1e-9 * most), (link, own)
            assert found.terms.keys() >= found.answers.keys()


def same_place(triple: np.ndarray, centre: icsolve.Centre) -> bool:
    """Whether a homogeneous place is that of a centre, to 1e-7: one far away is near one at infinity."""
    if centre.kind == "at":
        other = np.array([*centre.place, 1.0])
    else:
        other = np.array([*(f(math.radians(centre.place[0])) for f in (math.cos, math.sin)), 0.0])
    off = np.cross(triple / np.linalg.norm(triple), other / np.linalg.norm(other))
    return bool(np.abs(off).max() <= 1e-7)


def motion_of(answer: icsolve.Answer) -> dict[str, dict[str, Any]]:
    """The same of a scene, by kind, without what is open."""
    loads = {load.name for load in answer.case.loads}
    velocities = {f"{p} on {link}": v for (p, link), v in (answer.velocities or {}).items()}
    return {
        "rates": {link: w for link, w in (answer.rates or {}).items() if not isinstance(w, str)},
        "velocities": {name: np.array(v) for name, v in velocities.items() if not isinstance(v, str)},
        "terms": {term.load: term.factor for term in answer.terms if term.load in loads},
    }


MOTION = ("points", "rates", "velocities", "accelerations", "angular_accelerations")


@sampled(3)
@pytest.mark.parametrize("name", sample(FILES, 12, "motion bounds"))
def test_every_number_of_a_motion_has_a_bound_in_rows_and_in_scenes(name: str) -> None:
    """The exact number lies within both, of a scene as of its row; those of a scene are two units at most.
    A row of another position than that of the scene, which reads the figure anew, is passed over."""
    case, paths = icsolve.load(FILES[name]), Random(f"bounds {name}")
    if case.unknowns or case.space is not None or case.profiles:
        return
    want = ("status", "error", *MOTION[: 4 if case.dynamic else 3])
    numbers = [(path, n) for path, n in numbers_of(case).items() if path.startswith(("angles.", "lengths."))]
    for path, number in paths.sample(numbers, min(3, len(numbers))):
        values = np.round(number.value * np.array([0.97, 1.0, 1.02]), 6)
        try:
            rows = icsolve.sweep(case, {path: values}, want)
        except icsolve.SceneError:
            continue
        for n in np.flatnonzero(rows.status == "ok").tolist():
            try:
                scene = icsolve.solve(icsolve.load(FILES[name], {path: repr(float(values[n]))}), rates=True)
            except icsolve.SceneError:
                continue
            size = max(abs(x) for at in scene.points.values() for x in at) if scene.points else 1.0
            if any(
                np.abs(rows.points[p][n] - at).max() > 1e-6 * size
                for p, at in scene.points.items()
                if p in rows.points
            ):
                continue
            for kind in MOTION:
                for key, value in (getattr(scene, kind) or {}).items():
                    spot = key if isinstance(key, str) else f"{key[0]} on {key[1]}"
                    if isinstance(value, str) or spot not in rows.kinds[kind]:
                        continue
                    own, bound = np.array(value), np.array(scene.errors[kind][key])
                    zero = (own == 0.0) & (bound <= 1e-30)  # nothing to within 1e-40 of its terms
                    assert (zero | (bound <= 2.0 * np.spacing(np.abs(own)))).all(), (kind, spot)
                    off = np.abs(rows.kinds[kind][spot][n] - own)
                    assert (off <= rows.errors[kind][spot][n] + bound).all(), (path, n, kind, spot)
                    header = columns(rows)
                    assert {f"error {column}" for column in _parted(kind, spot, own[None])} <= header.keys()
