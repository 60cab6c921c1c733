"""A row is a scene: every number of every case of the library, changed by a few amounts, has in a row of a
sweep and of an evaluator the status and the value of `solve` with the number written in.

A row may be another in three ways alone, all as the manual says: a sweep turns the mechanism as written where
the figure read anew has links of other shapes; there the direction of a point's motion follows its path; and
a branch goes on by continuity where `near`, as written, would pick another. The row as a case of its own
then has the row's status and value.
"""

from __future__ import annotations

import cmath
import contextlib
import math
import random
import re
from collections.abc import Iterator
from importlib import import_module
from itertools import combinations

import numpy as np
import pytest

import icsolve
from icsolve.case import Case, Number, Torque
from icsolve.case.joints import Guided
from icsolve.numbers.units import BOUNDS
from icsolve.scene import solve_scene
from icsolve.solve.positions import find_along
from icsolve.sweep.evaluator import Evaluated
from icsolve.sweep.find_on_record import Query, find
from icsolve.sweep.program import setting_of
from icsolve.sweep.table import Sweep
from icsolve.sweep.varied_numbers import numbers_of, with_numbers
from icsolve.tuples import replace
from library import FILES, sample
from sizes import FULL, crossed, few, sampled

Row = tuple[str, dict[str, tuple[float, float]]]
"""Status, and unknown loads with their bounds."""
WANT = ("answers", "status", "points")
MANY = 30
"""Rows that an evaluator runs as arrays."""


def solved(case: Case) -> Row:
    try:
        found = solve_scene(case).answers
    except icsolve.SceneError as refusal:
        return refusal.status, {}
    return "ok", {name: (a.value, a.error or 0.0) for name, a in found.items() if a.value is not None}


def amounts(number: Number) -> list[float]:
    """What else is written at a path, near to the number and far from it."""
    path, value = number.path, number.value
    if ".teeth" in path:
        return [value + 1.0, value - 1.0]
    turns = path.startswith("angles.") or path.endswith((".angle", ".along", ".normal"))
    near = (
        [0.02, 1.2, -1.2, 14.25, -40.0]
        if turns
        else [0.02, *(f * (value or 1.0) for f in (-0.02, 0.17, -0.31))]
    )
    return [v for v in (value + one for one in near) if all(b.holds(v) for b in BOUNDS[number.bound])]


def shape(case: Case) -> list[float]:
    """What a motion leaves as it is: distances on each link, places on the frame, and the frame's guides."""
    points = solve_points(case)
    found = [x for n in case.carries.get(case.ground, ()) for x in points.get(n, ())]
    for names in case.carries.values():
        found += [
            math.dist(points[a], points[b]) for a, b in combinations(names, 2) if {a, b} <= points.keys()
        ]
    for joint in case.joints:
        if isinstance(joint, Guided) and joint.guide.angle is not None and case.ground in joint.links:
            (x, y), along = points[joint.guide.through or joint.at], math.radians(joint.guide.angle.value)
            found += [x * math.sin(along) - y * math.cos(along)]
    return found


def solve_points(case: Case) -> dict[str, tuple[float, float]]:
    figure = setting_of(case, (), ()).figure
    ox, oy, scale = figure.frame
    return {name: (float(x) / scale + ox, float(y) / scale + oy) for name, (x, y) in figure.points.items()}


def is_reshaped(case: Case, other: Case) -> bool:
    """Whether links of the case, read anew, have other shapes, or cannot be read so at all."""
    with contextlib.suppress(icsolve.SceneError):
        return shape(case) != pytest.approx(shape(other), rel=1e-9, abs=1e-9)
    return True


def agrees(row: Row, scene: Row) -> bool:
    """Of the same status, and values within both bounds."""
    (status, values), (other, found) = row, scene
    return status == other and all(
        abs(value - values[name][0]) <= error + values[name][1] for name, (value, error) in found.items()
    )


def rows_of(table: Sweep | Evaluated, scenes: list[Row]) -> Iterator[Row]:
    """Rows as scenes are; one without a bound has that of the scene, and the digits that NEAR leaves it."""
    errors = table.error if isinstance(table, Sweep) else {}
    for n, (_, found) in enumerate(scenes):
        values = {}
        for name, (value, error) in found.items():
            own = errors[name][n] if name in errors else math.nan
            own = own if math.isfinite(own) else 4.0 * error + 1e-9 * abs(value)
            values[name] = (table.answers[name][n] if name in table.answers else math.nan, own)
        yield str(table.status[n]), values


def misses(case: Case, path: str, values: list[float]) -> Iterator[tuple[str, float, Row, Row]]:
    """Rows that are not the scenes that they should be."""
    others = [with_numbers(case, {path: value}) for value in values]
    scenes = list(map(solved, others))
    call = icsolve.evaluator(case, (path,), WANT)
    tables = [("evaluator", call(np.resize(values, count))) for count in (len(values), MANY)]
    with contextlib.suppress(icsolve.SceneError):
        tables.append(("sweep", icsolve.sweep(case, {path: values}, (*WANT, "error"))))
    for who, table in tables:
        for n, row in enumerate(rows_of(table, scenes)):
            if not agrees(row, scenes[n]) and not is_elsewhere(case, path, others[n], table, n):
                yield who, values[n], row, scenes[n]


def is_elsewhere(case: Case, path: str, other: Case, table: Sweep | Evaluated, n: int) -> bool:
    """Whether a row is a scene in another position than its number, read anew, has, and may be."""
    near = {name: (float(at[n][0]), float(at[n][1])) for name, at in table.points.items()}
    is_placed = case.near and all(math.isfinite(x) for at in near.values() for x in at)
    if is_placed and holds(table, n, solved(replace(other, near=near))):
        return True
    if isinstance(table, Evaluated) or not (case.profiles or setting_of(case, (path,), ()).moves):
        return False
    goes_on = any(m.angle is not None for m in case.motion) and solved(other)[0] == "inconsistent"
    told_anew = path.startswith("points.") and not case.ropes
    if told_anew or not (goes_on or case.ropes or case.profiles or is_reshaped(case, other)):
        return False
    return table.status[n] == "cannot-assemble" or holds(table, n, solved(table.case_of(n)))


def holds(table: Sweep | Evaluated, n: int, scene: Row) -> bool:
    """Whether a row is this scene."""
    return agrees(list(rows_of(table, [scene] * (n + 1)))[n], scene)


@pytest.mark.parametrize("name", sample(FILES, 20, "rows are scenes"))
def test_every_row_of_the_library_is_a_scene(name: str) -> None:
    case = icsolve.load(FILES[name])
    if case.unknowns or case.space is not None:
        return
    numbers, draw = list(numbers_of(case).values()), random.Random(name)
    for number in numbers if FULL else draw.sample(numbers, min(2, len(numbers))):
        assert list(misses(case, number.path, amounts(number))) == []


SLIDER_CRANK = """icsolve: 1
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: 2, BC: 6}
angles: {AB: 60}
near: {C: [7, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads: {P: {force: 20, link: 4, at: C, angle: 180}, T: {torque: unknown, link: 2}}
"""
GOOD = (
    "{link: 2, speed: 3 rad/s, turns: cw}",
    "{link: 3, speed: 3 rad/s, turns: cw}",
    "{point: C, link: 4, speed: 3, angle: 180.9}",
    "{point: B, link: 2, speed: 3, angle: 150}",
)
BAD = (
    "{point: C, link: 4, speed: 1, angle: 5}",
    "{link: 1, turns: cw}",
    "{link: 4, turns: cw}",
)
TWICE = (
    "[{link: 2, turns: cw}, {link: 3, turns: cw, speed: 3}]",
    "[{link: 2, speed: 3 rad/s}, {point: B, link: 2, speed: 6, angle: 150}]",
    "[{link: 2, speed: 3.000}, {point: C, link: 4, speed: 6.101, angle: 180}]",
    "[{point: C, link: 4, speed: 6.101, angle: 180}, {link: 2, speed: 3.000}]",
)
"""Two of one freedom: they agree nowhere, everywhere, or as written alone."""


@sampled(3)
@pytest.mark.parametrize("motion", [*GOOD, *BAD, *TWICE])
def test_a_motion_that_a_scene_refuses_is_refused_in_every_row(motion: str) -> None:
    """Whatever the motion is (of the frame, of what does not turn, in a direction that is none of its path,
    against another one), and whatever is varied; link 3 stands still for an instant at 90 degrees."""
    case = icsolve.load(f"{SLIDER_CRANK}motion: {motion}\n")
    numbers = numbers_of(case)
    speeds = [path for path in numbers if path.endswith(".speed")]
    for path in numbers if FULL else ("angles.AB", "lengths.BC", "loads.P", "joints.4-1@C.along", *speeds):
        values = [
            numbers[path].value,
            *amounts(numbers[path])[1:4],
            *([90.0, 0.0] if path == "angles.AB" else []),
        ]
        if motion in BAD and path == "angles.AB":
            with pytest.raises(icsolve.SceneError):
                icsolve.sweep(case, {path: values})
        assert list(misses(case, path, values)) == []


BEYOND = """
icsolve: 1
points: {A: [0, 0], D: [4, 0], G: [unknown, 0.5]}
lengths: {AB: 1, BC: 3.5, CD: 2.5, CG: 4}
angles: {AB: 60}
near: {C: [3.5, 2.4], G: [7, 0.5]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 5], at: C}
  - {pin: [4, 1], at: D}
  - {pin: [5, 6], at: G}
  - {slide: [6, 1], at: G, along: 0}
loads: {P: {torque: 10, link: 4}, T: {torque: unknown, link: 2}}
"""


@sampled(2)
@pytest.mark.parametrize(
    "motion",
    [
        "{link: 5, turns: cw}",
        "{link: 3, turns: cw}",
        "{point: G, link: 6, speed: 1, angle: 0}",
        "{point: G, link: 6, speed: 1, angle: 90}",
    ],
)
def test_a_motion_of_a_link_beyond_the_loads_is_refused_where_a_scene_refuses_it(motion: str) -> None:
    """The rod and the slider of a six-bar bear no load, and a force between the loads needs neither."""
    case = icsolve.load(f"{BEYOND}motion: {motion}\n")
    if "angle: 90" in motion:
        with pytest.raises(icsolve.SceneError, match="can only move at"):
            icsolve.sweep(case, {"angles.AB": [60.0]})
    else:
        assert set(icsolve.sweep(case, {"angles.AB": [55.0, 60.0, 65.0]}).status.tolist()) == {"ok"}
    for path in ("angles.AB", "lengths.CG", "loads.P"):
        assert list(misses(case, path, amounts(numbers_of(case)[path])[1:4])) == []


@pytest.mark.parametrize("seed", range(8))
def test_motions_that_repeat_one_another_agree_to_half_a_unit_of_their_last_decimals(seed: int) -> None:
    """Of a crank and of its slider: R. L. Norton, Design of Machinery, ch. 6."""
    rng = random.Random(seed)
    turn, places, digits = rng.uniform(0.2, 2.9), rng.randint(1, 4), rng.randint(1, 5)
    rate = round(rng.uniform(5.0, 90.0), places)
    angle = round(math.degrees(turn), 3)
    t = math.radians(angle)
    exact = 2.0 * math.sin(t) + 4.0 * math.sin(t) * math.cos(t) / math.sqrt(36.0 - 4.0 * math.sin(t) ** 2)
    room = 0.5 * 10.0**-digits + 0.5 * 10.0**-places * abs(exact)
    text = SLIDER_CRANK.replace("AB: 60", f"AB: {angle}")
    for off in (0.0, 0.9, -0.9, 1.1, -1.1, 300.0):
        slide = f"{rate * exact + off * room:.{digits}f}"
        misses_by = abs(float(slide) - rate * exact) / room
        crank = f"{{link: 2, speed: {rate:.{places}f}}}"
        case = icsolve.load(f"{text}motion: [{crank}, {{point: C, link: 4, speed: {slide}, angle: 180}}]\n")
        if misses_by < 0.99:
            assert (icsolve.solve(case, rates=True).rates or {})["2"] == pytest.approx(rate, rel=1e-15)
        elif misses_by > 1.01:
            with pytest.raises(icsolve.SceneError, match="by the first one the speed of point C of link 4"):
                icsolve.solve(case, rates=True)


@sampled(3, "path", "motion")
@pytest.mark.parametrize("motion", GOOD)
@pytest.mark.parametrize(
    "path", ["angles.AB", "lengths.AB", "joints.4-1@C.along", "motion.speed", "motion.angle"]
)
def test_the_rates_of_an_evaluator_are_those_of_its_scenes(motion: str, path: str) -> None:
    """As if written so: in the sense of the motion as written, at its speed."""
    case = icsolve.load(f"{SLIDER_CRANK}motion: {motion}\n")
    if path not in numbers_of(case):
        return
    call = icsolve.evaluator(case, (path,), ("status", "rates"))
    written = numbers_of(case)[path]
    values = [*amounts(written)[1:4], written.value + 180.0]
    for found in (call(values), call(np.resize(values, MANY))):
        for n, value in enumerate(values):
            try:
                scene = icsolve.solve(with_numbers(case, {path: value}), rates=True)
            except icsolve.SceneError as refusal:
                assert found.status[n] == refusal.status  # noqa: PT017
                continue
            assert found.status[n] == "ok"
            for link, rate in scene.rates.items():
                assert found.rates[link][n] == pytest.approx(rate, rel=1e-9, abs=1e-9)


PAIRS = (
    ("books/meriam_mass_on_parallel_links.yaml", ("angles.AB", "angles.DC")),
    ("books/meriam_mass_on_parallel_links.yaml", ("lengths.AB", "lengths.DC")),
    ("ch13/13_14_slider_drives_crank.yaml", ("points.B.y", "points.D.x")),
    ("linkages/parallelogram_two_motors.yaml", ("points.A.x", "points.D.x")),
)


@pytest.mark.parametrize(("name", "paths"), PAIRS)
def test_rates_of_rows_of_two_numbers_are_those_of_their_scenes(name: str, paths: tuple[str, str]) -> None:
    """Numbers that are equal as written, as in a parallelogram, are not where both are varied; a point that
    has a speed goes in the sense that the case says, through whatever places the rows lie (to rounding)."""
    case = icsolve.load(FILES[name])
    written = [numbers_of(case)[path] for path in paths]
    rows = np.array([[number.value + off for number in written] for off in (0.0, 0.02, -0.05)])
    rows = np.vstack([rows, [[written[0].value * a, written[1].value * b] for a, b in ((0.9, 1), (0, 1.1))]])
    tables: list[Sweep | Evaluated] = [icsolve.evaluator(case, paths, ("status", "rates"))(*rows.T)]
    if not setting_of(case, paths, ()).moves:
        tables.append(icsolve.sweep(case, dict(zip(paths, rows.T, strict=True)), ("status", "rates")))
    for n, row in enumerate(rows.tolist()):
        try:
            scene = icsolve.solve(with_numbers(case, dict(zip(paths, row, strict=True))), rates=True)
        except icsolve.SceneError:
            continue
        for table in tables:
            assert table.status[n] == "ok"
            for link, rate in scene.rates.items():
                assert table.rates[link][n] == pytest.approx(rate, rel=1e-9, abs=1e-9)


FOUR_BAR = """icsolve: 1
points: {{A: [0, 0], D: [4, 0], G: {{centroid: [B, C]}}}}
lengths: {{AB: {}, BC: {}, CD: {}}}
angles: {{AB: 60}}
near: {{C: [4, 3]}}
links: {{3: {{points: [G], mass: 2 kg, centre: G, inertia: 1 kg*m^2}}}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 1], at: D}}
loads: {{T: {{torque: unknown, link: {}}}}}
motion: {{point: B, link: {}, speed: 3, angle: {}, acceleration: 2}}
dynamic: yes
"""
CHANGING = ((3, 3.5, 2.5), (1, 4, 1), (2, 4, 2))
"""Cranks, couplers and rockers that all lie on the line of a frame of 4 at 0 degrees."""


@sampled(2)
@pytest.mark.parametrize(
    ("lengths", "given_on"), crossed([*CHANGING, (1, 3.5, 2.5)], [(2, 1.0), (3, 1.0), (3, -1.0)])
)
def test_a_point_goes_on_along_its_path_through_change_points(
    lengths: tuple[float, ...], given_on: tuple[int, float]
) -> None:
    """The pin of a crank goes round in one sense, so that the crank does; by either of its links, whatever
    link the load is on, and though the motion is not asked for (to rounding)."""
    link, sense = given_on
    on = (2, 4) if lengths[0] == lengths[2] else (2, 3, 4)  # the coupler of a parallelogram does not turn
    given = {one: FOUR_BAR.format(*lengths, one, link, 60.0 + 90.0 * sense) for one in on}
    turn = {"angles.AB": [60.0 - 7.3 * n for n in range(15)]}
    turns = "ccw" if sense > 0.0 else "cw"
    alike = f"link: 2, speed: {3.0 / lengths[0]}, turns: {turns}, acceleration: {2.0 / lengths[0]}"
    crank = icsolve.load(re.sub(r"point: B[^}]*", alike, given[2]))
    right = icsolve.sweep(crank, turn, ("answers", "status"))
    for one, text in given.items():
        case = icsolve.load(text)
        found = icsolve.sweep(case, turn, ("answers", "status", "rates"))
        assert set(found.status) == {"ok"}
        assert found.rates["2"] == pytest.approx(np.full(15, sense * 3.0 / lengths[0]), rel=1e-9)
        if one == 2:
            assert found.answers["T"] == pytest.approx(right.answers["T"], rel=1e-9)
        assert list(icsolve.sweep(case, turn, ("answers", "status")).status) == ["ok"] * 15


@pytest.mark.parametrize("lengths", CHANGING)
@pytest.mark.parametrize("want", [("answers", "status"), ("answers", "status", "rates")])
def test_a_row_in_a_change_point_has_the_status_of_its_scene(
    lengths: tuple[float, ...], want: tuple[str, ...]
) -> None:
    """Where the links lie on one line a row does not tell which way the pin goes; the scene does."""
    written, there = (
        FOUR_BAR.format(*lengths, 2, 3, 90.0 + at).replace("AB: 60", f"AB: {at}") for at in (60, 0)
    )
    found = icsolve.sweep(icsolve.load(written), {"angles.AB": [61.0, 0.0]}, want)
    with pytest.raises(icsolve.SceneError) as refusal:
        icsolve.solve(icsolve.load(there))
    assert list(found.status) == ["ok", refusal.value.status]


TANGENT = """icsolve: 1
points: {{A: [0, 0], C: [unknown, 0.5]}}
lengths: {{AB: 2, BC: 2.5}}
angles: {{AB: {}}}
near: {{C: [{}, 0.5]}}
links: {{2: {{mass: 1 kg, centre: B}}, 4: {{mass: 3 kg, centre: C}}}}
joints:
  - {{pin: [3, 4], at: C}}
  - {{slide: [4, 1], at: C, along: 0}}
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
loads: {{T: {{torque: unknown, link: 2}}}}
motion: {{point: C, link: 4, speed: 2, angle: {}, acceleration: 3}}
dynamic: yes
"""
"""A slider-crank whose crank and rod stand on one line, square to the guide, at 270 degrees."""


@pytest.mark.parametrize("way", [0.0, 180.0])
def test_a_slider_goes_on_through_the_foot_of_its_guide(way: float) -> None:
    """Beyond the change point a row is the scene whose slider moves the same way (to 1e-9)."""
    case = icsolve.load(TANGENT.format(200.0, 0.3, way))
    turn = {"angles.AB": [200.0, 262.0, 269.7, 270.2, 281.0, 330.0]}
    found = icsolve.sweep(case, turn, ("answers", "status", "points", "rates"))
    for n, angle in enumerate(turn["angles.AB"]):
        scene = icsolve.solve(icsolve.load(TANGENT.format(angle, found.points["C"][n][0], way)), rates=True)
        assert scene.rates is not None
        assert found.rates["2"][n] == pytest.approx(scene.rates["2"], rel=1e-9)
        assert found.answers["T"][n] == pytest.approx(scene.answers["T"].value, rel=1e-9)


@pytest.mark.parametrize("way", [0.0, 180.0])
@pytest.mark.parametrize("off", [-0.2, -0.001, 0.05, 0.3])
def test_a_point_beside_its_dead_centre_goes_as_written(way: float, off: float) -> None:
    """The first row is the case as written, however near the slider is to the end of its way (to 1e-9)."""
    dead = math.degrees(math.asin(0.5 / 4.5)) + off
    case = icsolve.load(TANGENT.format(repr(dead), 4.4, way))
    scene = icsolve.solve(case, rates=True)
    found = icsolve.sweep(case, {"angles.AB": [dead, dead + 40.0]}, ("answers", "rates"))
    assert scene.rates is not None
    assert found.rates["2"][0] == pytest.approx(scene.rates["2"], rel=1e-9)
    assert found.answers["T"][0] == pytest.approx(scene.answers["T"].value, rel=1e-6)
    assert found.rates["2"][0] * found.rates["2"][1] > 0.0


@pytest.mark.parametrize("radii", ["[0.5, 0]", "[0.5, 1]", "[0.5, -1.5]"])
@pytest.mark.parametrize("path", ["points.C.x", "points.P.x", "points.C.y"])
def test_a_wheel_whose_contact_a_coordinate_leaves_behind_is_read_anew(radii: str, path: str) -> None:
    """A contact that is no longer at the radius from the centre is another figure, and no rolling on."""
    top = "" if radii == "[0.5, 0]" else "{pin: [1, 3], at: O}, {pin: [3, 2], at: C}, "
    y = {"[0.5, 0]": 0, "[0.5, 1]": -1, "[0.5, -1.5]": 1.5}[radii]
    case = icsolve.load(
        f"icsolve: 1\npoints: {{C: [0, 0.5], P: [0, 0], O: [0, {y}]}}\n"
        f"joints: [{top}{{roll: [2, 1], at: P, radii: {radii}}}]\n"
        "loads: {F: {force: unknown, link: 2, at: C, angle: 0}, M: {torque: 3, link: 2}}\n"
        "motion: {point: C, link: 2, speed: 2, angle: 0}\n"
    )
    assert solved(case)[0] == "ok"
    assert list(misses(case, path, amounts(numbers_of(case)[path]))) == []


@sampled(3)
@pytest.mark.parametrize("written", [0.0, 0.5, -0.9])
def test_a_wheel_rolls_on_what_each_row_says_that_it_rolls_on(written: float) -> None:
    """A straight track is a round one in no row, nor a round one straight, whichever was written: row by row
    (value and place, to rounding) the sweep of the angle alone of the case written with that radius."""

    def rolling(radius: float) -> Case:
        return icsolve.load(
            f"icsolve: 1\npoints: {{C: [0, 0], O: [0, 0.3]}}\nlengths: {{OA: 0.2}}\nangles: {{OA: 150}}\n"
            f"links: {{2: [O, A]}}\njoints: [{{roll: [2, 1], at: C, radii: [0.3, {radius}]}}]\n"
            "loads: {W: {weight: 10, link: 2, at: A}, M: {torque: unknown, link: 2}}\n"
        )

    radii, want = [0.5, 0.2, 0.0, -0.5, -0.9, 0.3], ("answers", "status", "points")
    found = icsolve.sweep(rolling(written), {"joints.C.radii.1": radii, "angles.OA": 120.0}, want)
    for n, radius in enumerate(radii):
        alone = icsolve.sweep(rolling(radius), {"angles.OA": 120.0}, want)
        assert (found.status[n], alone.status[0]) == ("ok", "ok")
        assert found.answers["M"][n] == pytest.approx(alone.answers["M"][0], rel=1e-12)
        assert found.points["A"][n] == pytest.approx(alone.points["A"][0], abs=1e-12)


ROLLING = {
    "wheels": ("{pin: [1, 2], at: O}, {pin: [1, 3], at: Q}", "2", "3"),
    "planet": ("{pin: [1, 3], at: Q}, {pin: [3, 2], at: O}", "2", "1"),
    "rack": ("{pin: [1, 2], at: O}, {slide: [3, 1], at: R, along: @}", "2", "3"),
    "on the flat": ("{pin: [3, 2], at: O}, {slide: [3, 1], at: O, along: @}", "2", "1"),
}
"""Two links that a third carries, by pins and guides: the joints, and which two roll."""
MISFITS = (0.0, 5e-4, -8e-4, 6e-3, -0.01, 0.4, -2.0)
"""By how much of it a radius is not that of the figure; 0.2 % fits."""


@sampled(4)
@pytest.mark.parametrize("off", MISFITS)
@pytest.mark.parametrize("kind", ROLLING)
@pytest.mark.parametrize("seed", range(40 if FULL else 3))
def test_radii_that_do_not_fit_the_figure_are_refused_in_scenes_and_rows(
    kind: str, off: float, seed: int
) -> None:
    """Of two wheels that pins carry (outside and inside of one another), of a planet, of a rack and of a hub
    on the flat: more data than the figure needs fit to 0.2 %, wherever the radius comes from."""
    draw = random.Random(f"{kind} {seed}")
    turn = cmath.rect(1.0, draw.uniform(-math.pi, math.pi))
    r, s = draw.uniform(0.5, 3), draw.choice([1, -1]) * draw.uniform(3.5, 6)
    places = {"O": -r * turn, "Q": s * turn, "P": 0 * turn, "R": (0.5 + 2j) * turn}
    joints, one, two = ROLLING[kind]
    straight = kind in ("rack", "on the flat")
    along = repr(math.degrees(cmath.phase(turn)) + 90)

    def rolling(radii: list[float]) -> Case:
        points = ", ".join(f"{p}: [{z.real!r}, {z.imag!r}]" for p, z in places.items())
        return icsolve.load(
            f"icsolve: 1\npoints: {{{points}}}\n"
            f"joints: [{joints.replace('@', along)}, {{roll: [{one}, {two}], at: P, radii: {radii}}}]\n"
            "loads: {M: {torque: 5, link: 2}, F: {force: unknown, link: 3, at: [0.3, 7], slope: [2, 3]}}\n"
        )

    fitting = [r, 0.0 if straight else s]
    k = 0 if straight else 1 if off == -2.0 else draw.choice([0, 1])
    off = abs(off) if straight else off  # what rolls on a straight link is not hollow
    given = [radius * (1 + off) if n == k else radius for n, radius in enumerate(fitting)]
    wanted = "ok" if abs(off) < 2e-3 else "inconsistent"
    case = rolling(given)
    assert solved(case)[0] == wanted
    radius = f"joints.P.radii.{k}"
    rows = icsolve.sweep(rolling(fitting), {radius: [fitting[k], given[k], fitting[k]]})
    assert rows.status.tolist() == ["ok", wanted, "ok"]
    for vary, drive in (({"loads.M": [5.0, 6.0]}, {}), ({}, {"2": [0.0, 1.0]})):
        if wanted == "ok":
            found = icsolve.sweep(case, vary, drive=drive)
            assert found.status.tolist() == ["ok", "ok"]
            assert found.answers["F"][0] == pytest.approx(solved(case)[1]["F"][0], rel=5e-3)
        else:
            with pytest.raises(icsolve.SceneError, match="radii of links") as refusal:
                icsolve.sweep(case, vary, drive=drive)
            assert refusal.value.status == wanted


@pytest.mark.parametrize("asked", ["2", "8"])
@pytest.mark.parametrize("seed", range(20 if FULL else 4))
def test_a_link_that_repeats_what_others_hold_keeps_its_length_in_every_row(seed: int, asked: str) -> None:
    """A third crank of a parallelogram, its places as programs write them: what goes over to a crossed figure
    at a change point would stretch it, and no row that has an answer does so."""
    draw = random.Random(f"third crank {seed}")
    r, start, lean = draw.uniform(0.5, 1.5), draw.uniform(0, 360), draw.uniform(0, 360)
    crank = cmath.rect(r, math.radians(start))
    base, at = cmath.rect(draw.uniform(1.6, 3), math.radians(lean)), complex(draw.uniform(-1, 1), 0.3)
    places = {"A": at, "F": at + base, "J": at + 2 * base, "H": at + base + crank, "K": at + 2 * base + crank}
    points = ", ".join(f"{p}: [{z.real!r}, {z.imag!r}]" for p, z in places.items())
    case = icsolve.load(
        f"icsolve: 1\npoints: {{{points}}}\nlengths: {{AB: {r!r}}}\nangles: {{AB: {start!r}}}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [1, 7], at: F}, {pin: [1, 8], at: J}, {pin: [2, 6], at: B}, "
        "{pin: [7, 6], at: H}, {pin: [8, 6], at: K}]\n"
        f"loads: {{W: {{force: 10, link: 6, at: H, angle: 30}}, T: {{torque: unknown, link: {asked}}}}}\n"
    )
    rows = icsolve.sweep(
        case, {"angles.AB": np.linspace(start, start + 360, 37)}, ("status", "points", "answers")
    )
    good = rows.status == "ok"
    assert good[0]
    pairs = {"FH": r, "JK": r, "HK": abs(base), "BH": abs(base)}
    for (a, b), apart in pairs.items():
        found = np.hypot(*(rows.points[a] - rows.points[b])[good].T)
        assert found == pytest.approx(apart, rel=1e-9)
    arm = 1j * r * np.exp(1j * np.radians(np.linspace(start, start + 360, 37)))
    work = (arm * cmath.rect(10, -math.radians(30))).real
    assert rows.answers["T"][good] == pytest.approx(-work[good], abs=1e-6)


@pytest.mark.parametrize("seed", range(20 if FULL else 4))
def test_coupled_wheels_leave_the_rows_of_an_engine_as_they_are(seed: int) -> None:
    """A locomotive: two more wheels, coupled to the crank by one rod, of which one is redundant and neither
    bears on the torque, pass their change points with the crank, in every row all round."""
    draw = random.Random(f"locomotive {seed}")
    r, apart, rod = (round(draw.uniform(*of), 3) for of in ((0.3, 0.6), (1.2, 2.0), (2.0, 3.5)))
    start = 15.0 * draw.randint(1, 11)
    crank = cmath.rect(r, math.radians(start))
    head = crank.real - math.sqrt(rod**2 - crank.imag**2)
    wheels = f"D: [{apart}, 0], O: [{2 * apart:.3f}, 0], "
    text = (
        f"icsolve: 1\npoints: {{A: [0, 0], {wheels}S: [0.3, 1.1], X: [unknown, 0]}}\n"
        f"lengths: {{AB: {r}, BX: {rod}, BC: {apart}, CD: {r}, CE: {apart}, EO: {r}}}\n"
        f"angles: {{AB: {start}, BCE: 180}}\n"
        f"near: {{X: [{head}, 0], C: [{apart + crank.real}, {crank.imag}]}}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: X}, "
        "{slide: [4, 1], at: X, along: 0}, {pin: [2, 5], at: B}, {pin: [5, 6], at: C}, {pin: [6, 1], at: D}, "
        "{pin: [5, 7], at: E}, {pin: [7, 1], at: O}]\n"
        f"loads: {{F: {{force: {draw.randint(10, 90)}, link: 4, at: X, angle: 0}}, "
        "K: {spring: 30, free: 0.5, link: 2, at: B, to: S}, T: {torque: unknown, link: 2}}\n"
    )
    bare = text.replace(wheels, "")
    for word in (f", BC: {apart}, CD: {r}, CE: {apart}, EO: {r}", ", BCE: 180"):
        bare = bare.replace(word, "")
    bare = bare.replace(f", C: [{apart + crank.real}, {crank.imag}]", "")
    bare = re.sub(r", \{pin: \[2, 5\].*?at: O\}", "", bare)
    turn = {"angles.AB": np.linspace(0.0, 360.0, 49)}
    found, wanted = (icsolve.sweep(icsolve.load(one), turn, ("status", "answers")) for one in (text, bare))
    assert found.status.tolist() == wanted.status.tolist() == ["ok"] * 49
    assert found.answers["T"] == pytest.approx(wanted.answers["T"], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("seed", range(40 if FULL else 2))
def test_places_as_programs_write_them_go_straight_on_through_a_change_point(seed: int) -> None:
    """A parallelogram whose places are doubles, so that as its decimals stand it just misses the change
    point: in rows, by the value of its torque, and by its rests it stays a parallelogram all round (within
    1e-5 degrees of the change point it is what its decimals make it)."""
    draw = random.Random(f"doubles {seed}")
    r, start, lean = draw.uniform(0.5, 1.5), draw.uniform(0, 360), draw.uniform(0, 360)
    crank, base, at = (
        cmath.rect(r, math.radians(start)),
        cmath.rect(2.5, math.radians(lean)),
        complex(0.1, 0.3),
    )
    places = {"A": at, "F": at + base, "H": at + base + crank}
    points = ", ".join(f"{p}: [{z.real!r}, {z.imag!r}]" for p, z in places.items())
    text = (
        f"icsolve: 1\npoints: {{{points}}}\nlengths: {{AB: {r!r}}}\nangles: {{AB: {start!r}}}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [1, 7], at: F}, {pin: [2, 6], at: B}, {pin: [7, 6], at: H}]\n"
        "loads: {W: {force: 10, link: 6, at: H, angle: 30}"
    )
    turn = np.linspace(start, start + 360, 37)
    rows = icsolve.sweep(icsolve.load(text + ", T: {torque: unknown, link: 2}}\n"), {"angles.AB": turn})
    assert set(rows.status) == {"ok"}
    assert rows.answers["T"] == pytest.approx(10 * r * np.sin(np.radians(turn - 30)), abs=1e-6)
    ways = sorted((30 + 180 * n - start) % 360 for n in range(2))
    asked = icsolve.load(text + ", T: {torque: unknown, link: 2}}\n")
    found = [one.at for one in find(asked, {"angles.AB": turn}, Query("value", "T", 0.0))]
    rests, _ = find_along(icsolve.load(text + "}\n"), "angles.AB", start, start + 360)
    for places in (found, [one.value for one in rests]):
        clear = [at for at in places if abs(math.remainder(at - lean, 180.0)) > 1e-5]
        assert sorted((at - start) % 360 for at in clear) == pytest.approx(ways, abs=1e-6)


@sampled(6)
@pytest.mark.parametrize("dynamic", [False, True])
@pytest.mark.parametrize("kind", ROLLING)
@pytest.mark.parametrize("seed", range(40 if FULL else 4))
def test_rolling_links_of_few_decimals_move_as_written(kind: str, dynamic: bool, seed: int) -> None:
    """Places of three decimals, which just miss radii, line of centres and guide: where nothing has moved the
    row is the scene in all digits, and everywhere it is as near to the row of the exact figure as the
    decimals are; inertia forces among the loads too."""
    draw = random.Random(f"few {kind} {seed}")
    turn = cmath.rect(1.0, draw.uniform(-math.pi, math.pi))
    r, s = (round(size, 3) for size in (draw.uniform(0.5, 3), draw.choice([1, -1]) * draw.uniform(3.5, 6)))
    places = {"O": -r * turn, "Q": s * turn, "P": 0 * turn, "R": (0.5 + 2j) * turn, "B": 2 - 1j}
    joints, one, two = ROLLING[kind]
    along = repr(math.degrees(cmath.phase(turn)) + 90)
    radii = [r, 0.0 if kind in ("rack", "on the flat") else s]

    def rolling(digits: int) -> Case:
        points = ", ".join(
            f"{p}: [{round(z.real, digits)}, {round(z.imag, digits)}]" for p, z in places.items()
        )
        return icsolve.load(
            f"icsolve: 1\npoints: {{{points}}}\n"
            f"joints: [{joints.replace('@', along)}, {{roll: [{one}, {two}], at: P, radii: {radii}}}]\n"
            "links: {2: {points: [O], mass: 2 kg, centre: O, inertia: 3 kg*m^2}, "
            "3: {points: [B], mass: 1 kg, centre: B, inertia: 2 kg*m^2}}\n"
            "loads: {T: {torque: unknown, link: 2}, F: {force: 5, link: 3, at: B, slope: [2, 3]}}\n"
            f"motion: {{link: 2, speed: 2, acceleration: 3}}\ndynamic: {'yes' if dynamic else 'no'}\n"
        )

    rows = [icsolve.sweep(rolling(digits), {}, drive={"2": [0.0, 5.0, 10.0]}) for digits in (3, 17)]
    assert [found.status.tolist() for found in rows] == [["ok", "ok", "ok"]] * 2
    few, exact = (found.answers["T"] for found in rows)
    assert few[0] == pytest.approx(icsolve.solve(rolling(3)).answers["T"].value, rel=1e-12)
    assert few == pytest.approx(exact, abs=2e-2 * max(abs(exact)))


@pytest.mark.parametrize("seed", range(40 if FULL else 4))
def test_a_wheel_of_which_no_point_is_the_centre_is_noted_and_not_moved(seed: int) -> None:
    """A wheel that nothing carries by its centre has any radius as it stands; where no point lies at one, or
    those that do lie on one side of the contact and not on two, the scene notes what the sweep says."""
    draw = random.Random(f"no centre {seed}")
    r, off = draw.uniform(0.5, 3), draw.choice([0.0, 0.01, -0.3])
    radii = [r * (1 + off), draw.choice([0, 2.0, -7.0])]
    case = icsolve.load(
        f"icsolve: 1\npoints: {{P: [0, 0], C: [0, {r!r}], D: [0, {radii[1]}]}}\nlinks: {{1: [D], 2: [C]}}\n"
        f"joints: [{{roll: [2, 1], at: P, radii: {radii}}}]\n"
        "loads: {M: {torque: 5, link: 2}, F: {force: unknown, link: 2, at: C, angle: 0}}\n"
    )
    is_told = bool(off) is not bool(radii[1])
    answer = icsolve.solve(case)
    assert answer.answers["F"].value == pytest.approx(5 / r, rel=1e-14)
    told = [note for note in answer.notes if "cannot be moved" in note]
    assert bool(told) is is_told
    if told:
        with pytest.raises(icsolve.SceneError) as refusal:
            icsolve.sweep(case, drive={"2": [0, 1]})
        assert [refusal.value.message] == told


@pytest.mark.parametrize("corner", [14.25, -14.25, 60.0, 170.0])
def test_a_centre_of_mass_that_data_place_anew_is_no_slip(corner: float) -> None:
    """A crank of another length turns the lever, and the angle on it that places its mass is another: G may
    then lie opposite to where it was; every row has its scene's value, to rounding."""
    case = icsolve.load(FILES["dynamics/quick_return_lever.yaml"])
    cranks = [0.1, 0.117, 0.16, 0.05]
    found = icsolve.sweep(case, {"lengths.AB": cranks, "angles.BOG": corner})
    for n, crank in enumerate(cranks):
        status, values = solved(with_numbers(case, {"lengths.AB": crank, "angles.BOG": corner}))
        assert (found.status[n], status) == ("ok", "ok")
        assert found.answers["T"][n] == pytest.approx(values["T"][0], rel=1e-12)


@pytest.mark.parametrize("want", [("answers", "centres", "rates"), ("centres",), ("rates",)])
def test_a_row_that_the_record_divides_by_zero_in_has_its_scenes_centres_and_rates(
    want: tuple[str, ...],
) -> None:
    """Two points of the butterfly on its axis: the row is a scene of its own, whatever is wanted of it."""
    case = icsolve.load(FILES["linkages/double_butterfly_symmetric.yaml"])
    row = {"points.L.y": 0.0, "points.K.x": 5.02, "points.B.y": 0.02}
    scene = icsolve.solve(with_numbers(case, row), rates=True, all_centres=True)
    found = icsolve.sweep(case, {path: [value] for path, value in row.items()}, want)
    assert scene.rates is not None
    for link, rate in scene.rates.items() if "rates" in want else ():
        assert found.rates[link][0] == pytest.approx(rate, rel=1e-12)
    for (a, b), centre in scene.centres.items() if "centres" in want else ():
        x, y, w = found.centres[f"{a}-{b}"][0].tolist()
        assert centre.kind != "at" or (x / w, y / w) == pytest.approx(centre.place, rel=1e-12)


UPRIGHT = (
    "{torque: unknown, screw: 8-7}",
    "{force: unknown, link: 6, at: H, angle: 90}",
    "{torque: unknown, link: 2}",
)
MOVING = (("rates",), ("centres",), ("rates", "centres"), ("rates", "velocities"))


@sampled(3, "want", "load", "screw")
@pytest.mark.parametrize("want", MOVING)
@pytest.mark.parametrize("load", UPRIGHT)
@pytest.mark.parametrize("screw", [True, False])
def test_what_a_scene_leaves_open_no_row_tells(want: tuple[str, ...], load: str, screw: bool) -> None:
    """A scissor jack whose arms lie on one another, upright: R and L coincide, and no motion fixes how the
    screw between them turns, which it never does in the other rows, nor how its blocks move."""
    text = FILES["tools/scissor_jack.yaml"].read_text(encoding="utf-8").split("expect:")[0]
    text = text.replace("{torque: unknown, screw: 8-7}", load)
    if not screw:
        text = re.sub(r"  - {screw.*", "", text).replace(", 8]", "]").replace(", 7]", "]")
        text = text.replace("screw: 8-7", "link: 2")
    case = icsolve.load(text)
    for others in ([], [-160.0]):
        rows = {"points.L.x": [*others, 0.0], "points.R.x": [*(-x for x in others), 0.0]}
        for table in (
            icsolve.sweep(case, rows, ("status", *want)),
            icsolve.sweep(case, rows, (*WANT, *want)),
        ):
            moves_as(table, with_numbers(case, {path: values[-1] for path, values in rows.items()}))


def moves_as(table: Sweep, case: Case) -> None:
    """The last row tells of what moves as the scene does: nothing of what that leaves open."""
    try:
        scene = icsolve.solve(case, rates=True, all_centres=True)
    except icsolve.SceneError as refusal:
        assert not table.answers or table.status[-1] == refusal.status  # noqa: PT017
        return
    assert table.status[-1] == "ok"
    assert scene.rates is not None and scene.velocities is not None
    for link, array in table.rates.items():
        rate = scene.rates.get(link, "left out of the scene, as nothing needs it")
        assert array[-1] == pytest.approx(math.nan if isinstance(rate, str) else rate, nan_ok=True), link
    for (point, on), v in scene.velocities.items():
        if f"{point} on {on}" in table.velocities:
            row = table.velocities[f"{point} on {on}"][-1]
            assert row == pytest.approx([math.nan] * 2 if isinstance(v, str) else v, abs=1e-12, nan_ok=True)
    for (a, b), centre in scene.centres.items():
        row = table.centres.get(f"{a}-{b}", np.full((1, 3), np.nan))[-1]
        if centre.kind == "undetermined":
            assert np.isnan(row).all(), (a, b)
        elif f"{a}-{b}" in table.centres:
            assert (centre.kind in ("at", "toward")) == row.any(), (a, b)


def test_two_links_on_a_pin_that_a_third_one_carries_have_their_centre_there_in_every_row() -> None:
    """Also where the two all but move as one, as links 4 and 6 here (by 7e-12 of the others' rates)."""
    case = icsolve.load(FILES["linkages/peaucellier.yaml"])
    row = {"points.O.y": 0.0, "lengths.BP": 2.999999999999, "points.Q.x": 3.0}
    scene = icsolve.solve(with_numbers(case, row), all_centres=True)
    call = icsolve.evaluator(case, tuple(row), ("centres",))
    for found in (icsolve.sweep(case, {p: [v] for p, v in row.items()}, ("centres",)), call(*row.values())):
        for pair in (("4", "6"), ("5", "7"), ("4", "5")):
            x, y, w = found.centres["-".join(pair)][0].tolist()
            assert (x / w, y / w) == pytest.approx(scene.centres[pair].place, rel=1e-12)


@pytest.mark.parametrize("name", ["gears/gear_pair.yaml", "gears/belt_crossed.yaml"])
def test_wheels_whose_pivots_come_to_one_place_are_refused_in_every_row(name: str) -> None:
    """There is no direction in which they lie, whatever the record of the others says."""
    case = icsolve.load(FILES[name])
    wheels = [p for p in case.points if p in case.carries[case.ground]][:2]
    one, two = (case.points[p] for p in wheels)
    row = {axis.path: by.value for axis, by in ((two.x, one.x), (two.y, one.y))}
    status, _ = solved(with_numbers(case, row))
    assert status == "inconsistent"
    assert icsolve.evaluator(case, tuple(row))(*row.values()).status[0] == status
    assert icsolve.sweep(case, {path: [value] for path, value in row.items()}).status[0] == status


def reduction(draw: random.Random, wheels: int) -> str:
    """Wheels in a row that reduce a speed by hundreds each; motion and loads are at any of them."""
    at, places, joints, links = 0.0, [], [], range(2, wheels + 2)
    for k in links:
        places.append(f"P{k}: [{at:.2f}, 0]")
        joints.append(f"  - {{pin: [1, {k}], at: P{k}}}\n")
        if k > 2:
            pair, teeth = (
                f"[{k - 1}, {k}]",
                f"[{draw.randrange(9, 20)}, {draw.choice([-1, 1]) * draw.randrange(2000, 6000)}]",
            )
            joints.append(f"  - {{gears: {pair}, teeth: {teeth}}}\n")
        at += draw.uniform(100.0, 300.0)
    known, unknown = draw.sample(links, 2)
    speed = draw.choice(["", f"motion: {{link: {draw.choice(links)}, speed: {draw.uniform(1, 9):.2f}}}\n"])
    return (
        f"icsolve: 1\npoints: {{{', '.join(places)}}}\njoints:\n{''.join(joints)}"
        f"loads: {{K: {{torque: 7.5, link: {known}}}, U: {{torque: unknown, link: {unknown}}}}}\n{speed}"
    )


@sampled(2)
@pytest.mark.parametrize("seed", range(400 if FULL else 10))
def test_rows_of_a_long_reduction_keep_the_slowest_wheel(seed: int) -> None:
    """What is 1e-14 and less of the fastest is no zero: its digits are known. Answers, rates and centres."""
    draw = random.Random(f"reduction {seed}")
    case = icsolve.load(reduction(draw, draw.randrange(4, 16)))
    scene = icsolve.solve(case, rates=True, all_centres=True)
    want = ("answers", "rates", "centres", "error")
    rows = icsolve.sweep(case, drive={draw.choice(["2", "3"]): [0.0, 7.0]}, want=want)
    assert list(rows.status) == ["ok", "ok"]
    assert rows.answers["U"] == pytest.approx(scene.answers["U"].value, rel=1e-13)
    assert (rows.errors["answers"]["U"] <= 1e-13 * abs(rows.answers["U"])).all()
    assert scene.rates is not None
    for link, rate in scene.rates.items():
        assert rows.rates[link] == pytest.approx(rate, rel=1e-13, abs=0.0), link
    for (a, b), centre in (scene.centres or {}).items():
        if centre.place is not None:
            x, y, w = rows.centres[f"{a}-{b}"][0]
            assert (x / w, y / w) == pytest.approx(centre.place, rel=1e-9, abs=1e-9), (a, b)


SHORT = {
    "four-bar": "points: {{A: [0, 0], D: [4, 0.5]}}\nlengths: {{AB: {r}, BC: 3.5, CD: 2.5}}\n"
    "near: {{C: [2.7, 2.3]}}\njoints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}},\n"
    "  {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]\n"
    "loads: {{K: {{torque: 10, link: 4}}, U: {{torque: unknown, link: 2}}}}\n",
    "slider-crank": "points: {{A: [0, 0], Q: [0, 0.4]}}\nlengths: {{AB: {r}, BC: 3}}\nnear: {{C: [3, 0.4]}}\n"
    "joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}},\n"
    "  {{slide: [4, 1], at: C, along: 0, through: Q}}]\nlinks: {{1: [Q]}}\n"
    "loads: {{K: {{force: 10, link: 4, at: C, angle: 0}}, U: {{torque: unknown, link: 2}}}}\n",
    "slotted arm": "points: {{A: [0, 0], D: [4, 0.5]}}\nlengths: {{AB: {r}}}\n"
    "joints: [{{pin: [1, 2], at: A}}, {{slot: [2, 4], at: B, along: [B, D]}}, {{pin: [4, 1], at: D}}]\n"
    "loads: {{K: {{torque: 10, link: 4}}, U: {{torque: unknown, link: 2}}}}\n",
}


@pytest.mark.parametrize("seed", range(300 if FULL else 4))
@pytest.mark.parametrize("kind", SHORT)
def test_rows_of_a_crank_that_is_next_to_nothing_are_scenes(kind: str, seed: int) -> None:
    """Down to 1e-15 of the frame the crank moves all else, by as little; rates below 1e-13 of its own may be
    told as none."""
    draw = random.Random(f"{kind} {seed}")
    crank = f"{draw.uniform(1, 9):.3f}e-{draw.randrange(1, 16)}"
    text = f"icsolve: 1\nangles: {{AB: 40}}\n{SHORT[kind].format(r=crank)}"
    turns = [round(draw.uniform(0.0, 360.0), 2) for _ in range(2)]
    rows = icsolve.sweep(icsolve.load(text), {"angles.AB": turns}, want=("answers", "rates", "error"))
    for n, turn in enumerate(turns):
        scene = icsolve.solve(icsolve.load(text, {"angles.AB": str(turn)}), rates=True)
        assert rows.status[n] == "ok"
        own = rows.answers["U"][n]
        assert own and abs(own - scene.answers["U"].value) <= rows.errors["answers"]["U"][n] + 2e-16 * abs(
            own
        )
        for link, rate in (scene.rates or {}).items():
            off = rows.errors["rates"][link][n] + 2e-16 * abs(rate)
            assert abs(rows.rates[link][n] - rate) <= max(
                off, 1e-13 if rows.rates[link][n] == 0.0 else 0.0
            ), link


def check_rows_of_u(text: str, path: str, values: list[float]) -> None:
    """Rows have the U of their scenes to 1e-9 and within their bounds, those of an evaluator to 1e-9."""
    rows = icsolve.sweep(icsolve.load(text), {path: values}, want=("answers", "error"))
    evaluated = icsolve.evaluator(icsolve.load(text), inputs=(path,), want=("answers",))(np.array(values))
    for n, value in enumerate(values):
        scene = icsolve.solve(icsolve.load(text, {path: str(value)})).answers["U"]
        assert rows.status[n] == evaluated.status[n] == "ok"
        off = abs(rows.answers["U"][n] - scene.value)
        assert off <= rows.errors["answers"]["U"][n] + 2e-16 * abs(scene.value)
        assert off <= 1e-9 * abs(scene.value)
        assert abs(evaluated.answers["U"][n] - scene.value) <= 1e-9 * abs(scene.value)


@sampled(3)
@pytest.mark.parametrize("seed", range(300 if FULL else 4))
@pytest.mark.parametrize("kind", SHORT)
def test_rows_of_loads_that_all_but_cancel_are_scenes(kind: str, seed: int) -> None:
    """What is left of two loads 1e4 to 1e18 times as large has its digits, whether 1e-8 of them or nothing at
    all is left of theirs in doubles."""
    draw = random.Random(f"{kind} {seed}")
    large, left = 10 ** draw.randrange(4, 19), draw.choice([0, 1, -3])
    pair = f"L1: {{torque: {large + left}, link: 2}}, L2: {{torque: {-large}, link: 2}}, K:"
    if seed % 2:  # a half of one, twice
        half = "{torque: {like: L1, times: -0.5}, link: 2}"
        rest = f"L4: {{torque: {left}, link: 2}}"
        pair = f"L1: {{torque: {large}, link: 2}}, L2: {half}, L3: {half}, {rest}, K:"
    text = "icsolve: 1\nangles: {AB: 40}\n" + SHORT[kind].format(r=1.25).replace("K:", pair)
    path = draw.choice(["angles.AB", "loads.K"])
    values = [round(draw.uniform(10.0, 80.0), 2) for _ in range(2)]
    check_rows_of_u(text, path, values)


@sampled(3)
@pytest.mark.parametrize("seed", range(100 if FULL else 4))
@pytest.mark.parametrize("kind", SHORT)
def test_rows_beside_a_large_load_that_does_no_work_are_scenes(kind: str, seed: int) -> None:
    """It stands at a point that stands still, though its link turns; or a spring of its free length there."""
    draw = random.Random(f"{kind} {seed}")
    link, at, far = (2, "A", "Q") if kind == "slider-crank" else (4, "D", "A")
    large, angle = 10.0 ** draw.randrange(4, 19), draw.randrange(5, 85)
    idle = [
        f"{{force: {large}, link: {link}, at: {at}, angle: {angle}}}",
        f"{{force: [{0.7 * large}, {-0.3 * large}], link: {link}, at: {at}}}",
        f"{{spring: {large}, free: {draw.choice([0.1, 4.1])}, link: {link}, at: {at}, to: {far}}}",
    ]
    text = "icsolve: 1\nangles: {AB: 40}\n" + SHORT[kind].format(r=1.25)
    text = text.replace("K:", f"L: {idle[seed % 3]}, K:")
    path = draw.choice(["angles.AB", "loads.K"])
    values = [round(draw.uniform(10.0, 80.0), 2) for _ in range(2)]
    check_rows_of_u(text, path, values)


@pytest.mark.parametrize("name", sample(FILES, 12, "torques against each other"))
def test_two_torques_against_each_other_change_no_row(name: str) -> None:
    """However large they are, on the first link that moves of any case of the library."""
    case = icsolve.load(FILES[name])
    if case.space is not None or case.unknowns or not case.loads:
        return
    link = next(link for link in case.links if link != case.ground)
    large = 10.0 ** random.Random(name).choice([9, 13, 17])
    first, last = (
        Torque(n, link, Number(v, 0.0, f"loads.{n}", repr(v))) for n, v in (("+", large), ("-", -large))
    )
    paired = replace(case, loads=(first, *case.loads, last))
    rows, found = (turned(one, link) for one in (case, paired))
    if isinstance(rows, str) or isinstance(found, str):
        assert rows == found
        return
    assert list(found.status) == list(rows.status)
    for load, values in rows.answers.items():
        assert found.answers[load] == pytest.approx(values, rel=1e-9, abs=0.0, nan_ok=True), load


def turned(case: Case, link: str) -> Sweep | str:
    """Two rows in which a link is turned, or why there are none."""
    try:
        return icsolve.sweep(case, drive={link: [-1.0, 2.0]})
    except icsolve.SceneError as refusal:
        return refusal.status


CRANKED = """icsolve: 1
points: {{A: [{x}, {y}]}}
lengths: {{AB: {ab}, BC: {bc}}}
angles: {{AB: {first}, ABC: {corner}{more}}}
links: {{2: [B, C]}}
joints: [{{pin: [1, 2], at: A}}]
loads: {{W: {{force: 10, link: 2, at: C, angle: 20}}, V: {{force: 3, link: 2, at: B, angle: 10}},
         T: {{torque: unknown, link: 2}}}}
"""


@pytest.mark.parametrize("seed", range(24 if FULL else 6))
def test_an_angle_is_met_on_an_arm_however_short_it_is(seed: int) -> None:
    """The direction of an arm of 1e-6 to 1e-40 of the other, and of one of length 0, is what the data say,
    not what doubles leave of it; an angle of the long arm that is off by a degree is refused beside any."""
    draw = random.Random(f"short arm {seed}")
    x, y, size = (draw.randint(-40, 40) / 10 for _ in range(3))
    size = abs(size) + 1.0
    first, corner = draw.randint(1, 359), draw.randint(1, 359)
    third = (first + 180 + corner) % 360
    short = [*(10.0 ** -draw.randint(6 * k, 6 * k + 5) for k in range(1, 7)), 0.0]
    path, told = f"lengths.{'BC' if seed % 2 else 'AB'}", bool(seed & 2)
    more = f", BC: {third}" if told else ""
    case = icsolve.load(CRANKED.format(x=x, y=y, ab=size, bc=size, first=first, corner=corner, more=more))
    tables = (
        icsolve.sweep(case, {path: short}, WANT),
        icsolve.evaluator(case, (path,), WANT)(np.array(short)),
    )
    for n, length in enumerate(short):
        scene = icsolve.solve(with_numbers(case, {path: length}))
        ab, bc = (length, size) if path == "lengths.AB" else (size, length)
        at = complex(x, y) + cmath.rect(ab, math.radians(first)) + cmath.rect(bc, math.radians(third))
        assert complex(*scene.points["C"]) == pytest.approx(at, abs=1e-13)
        for table in tables:
            assert table.status[n] == "ok"
            assert table.answers["T"][n] == pytest.approx(scene.answers["T"].value, rel=1e-12)
        if told and ab and path == "lengths.AB":
            assert solved(with_numbers(case, {path: length, "angles.ABC": corner + 1.0}))[0] == "inconsistent"


@pytest.mark.parametrize(
    ("data", "path", "values"),
    [
        ("angles: {AB: 0}", "points.B.x", [1.0, 0.5, -0.5]),
        ("angles: {ABC: -90}", "points.C.y", [2.0, 3.0, -1.0]),
        ("angles: {ABC: -90}", "points.B.x", [1.0, 0.5, 0.0, -1.0]),
        ("lengths: {AB: 1}", "points.B.x", [1.0, 0.5, -1.0]),
    ],
)
def test_a_row_contradicts_data_that_repeat_others_as_its_scene_does(
    data: str, path: str, values: list[float]
) -> None:
    """Coordinates that are varied, and a length or an angle between them that is not; or the sense alone."""
    case = icsolve.load(
        f"icsolve: 1\npoints: {{A: [0, 0], B: [1, 0], C: [1, 2]}}\n{data}\nlinks: {{2: [B, C]}}\n"
        "joints: [{pin: [1, 2], at: A}]\nloads: {W: {force: 10, link: 2, at: C, angle: -90}, V: {force: 3, "
        "link: 2, at: B, angle: 10}, T: {torque: unknown, link: 2}}\n"
    )
    assert {solved(with_numbers(case, {path: value}))[0] for value in values[1:]} >= {"inconsistent"}
    assert list(misses(case, path, values)) == []
    tables = (icsolve.sweep(case, {path: values}), icsolve.evaluator(case, (path,))(np.array(values)))
    for n, value in enumerate(values):
        for table in tables:
            assert table.status[n] == solved(with_numbers(case, {path: value}))[0], value


BESIDE = """icsolve: 1
points: {{A: [0, 0], {fixed}}}
lengths: {{AB: {sizes[0]}, BC: {sizes[1]}{more}}}
angles: {{AB: {at}}}
near: {{C: [{near}]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {last}]
loads: {{P: {{force: {p}, link: 4, at: C, angle: 180}}, T: {{torque: {t}, link: 2}}}}
"""
SLIDING = {"fixed": "C: [unknown, 0.5]", "more": "", "last": "{slide: [4, 1], at: C, along: 0}"}
ROCKING = {"fixed": "D: [4, 0]", "more": ", CD: 2.5", "last": "{pin: [4, 1], at: D}"}
NEXT_TO = {
    "a rod square to its guide": (SLIDING, (2, 2.5), "-0.1, 0.5", 270.0, -30.0),
    "a rocker at its limit": (ROCKING, (1, 3.5), "3, 2", math.degrees(math.acos(30 / 36)), 20.0),
    "a crank at its limit": (ROCKING, (3, 2), "3, 2", math.degrees(math.acos(4.75 / 24)), -20.0),
    "a parallelogram": ({**ROCKING, "more": ", CD: 2"}, (2, 4), "5, 1.5", 0.0, 30.0),
}


@sampled(2, "asked")
@pytest.mark.parametrize(("kind", "asked"), crossed([*NEXT_TO], ["torque", "force"]))
def test_rows_beside_singular_positions_have_the_digits_of_scenes(kind: str, asked: str) -> None:
    """At random distances from 1 to 1e-13 degree: to 3e-9 in a sweep, to 1e-8 in an evaluator, which is what
    doubles keep; the way of assembling is that of the row."""
    form, sizes, near, at, off = NEXT_TO[kind]
    loads = {"p": "unknown", "t": 10} if asked == "force" else {"p": 30, "t": "unknown"}
    text, name = BESIDE.format(at=at + off, sizes=sizes, near=near, **form, **loads), "PT"[asked == "torque"]
    case, draw = icsolve.load(text), random.Random(kind)
    values = [at + side * 10.0 ** -draw.uniform(0, 13) for _ in range(60 if FULL else 15) for side in (1, -1)]
    rows = icsolve.sweep(case, {"angles.AB": values}, want=("answers", "status", "points"))
    call = icsolve.evaluator(case, inputs=("angles.AB",), want=("answers", "points"))(np.array(values))
    seen = 0
    for table, least in ((rows, 3e-9), (call, 1e-8)):
        for n in np.flatnonzero(table.status == "ok").tolist():
            x, y = map(float, table.points["C"][n])
            there = text.replace(f"C: [{near}]", f"C: [{x!r}, {y!r}]")
            with contextlib.suppress(icsolve.SceneError):  # two ways that all but coincide
                right = icsolve.solve(icsolve.load(there, {"angles.AB": repr(values[n])})).answers[name].value
                assert table.answers[name][n] == pytest.approx(right, rel=least, abs=1e-15), values[n]
                seen += 1
    assert seen >= len(values)


@pytest.mark.parametrize("path", ["points.C.x", "points.C.y", "points.P.y", "joints.P.radii.0"])
def test_a_wheel_that_accelerates_about_no_point_any_more_is_refused_in_rows_too(path: str) -> None:
    """The disk's centre is the point at its radius; moved by 2 % it is no point that is named."""
    case = icsolve.load(FILES["dynamics/rolling_disk.yaml"])
    value = numbers_of(case)[path].value
    values = [value, value + 1e-6, value + 0.01, value - 0.16, value + 0.07]
    assert list(misses(case, path, values)) == []
    assert {solved(with_numbers(case, {path: one}))[0] for one in values} & {"unsupported", "inconsistent"}


@pytest.mark.parametrize("path", ["points.Q.x", "points.B.x", "points.B.y"])
def test_a_weight_whose_rope_no_longer_hangs_is_refused_in_rows_too(path: str) -> None:
    """The last part of the rope may lean by a sine of 2e-3."""
    case = icsolve.load(FILES["ropes/counterweight_door.yaml"])
    value = numbers_of(case)[path].value
    values = [value, value + 1e-6, value + 5e-3, value - 5e-3, value - 0.4, value + 3.0]
    assert list(misses(case, path, values)) == []
    assert {solved(with_numbers(case, {path: one}))[0] for one in values} == {"ok", "inconsistent"}


@pytest.mark.parametrize("size", [1e-30, 1e-45, -1e-120, 1e-250, 1e30])
@pytest.mark.parametrize("at", ["C", "D"])
def test_an_answer_is_as_small_as_its_load(size: float, at: str) -> None:
    """Statics is linear in its loads: a load of any size has the answer in its ratio, not zero, though it is
    nothing beside the load as written; one without an arm has zero."""
    text = f"""\
icsolve: 1
points: {{A: [0, 0], D: [4, 0]}}
lengths: {{AB: 1, BC: 3.5, CD: 2.5}}
angles: {{AB: 60}}
near: {{C: [3.5, 2.4]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 1], at: D}}
loads:
  P: {{force: 100, link: 4, at: {at}, angle: 180}}
  T: {{torque: unknown, link: 2}}
"""
    case = icsolve.load(text)
    rows = icsolve.sweep(case, vary={"loads.P": [size, 100.0]})
    assert list(rows.status) == ["ok", "ok"]
    found, whole = rows.answers["T"]
    assert found == pytest.approx(whole * (size / 100.0), rel=1e-15, abs=0.0)  # each rounded once
    assert (found != 0.0) == (at == "C")


SPARE = """icsolve: 1
points: {{A: [0, 0], C: [unknown, 0], X: [4, 3]}}
lengths: {{AB: 1, BC: 3, XY: {0}, YC: 2.5}}
angles: {{AB: 60}}
near: {{C: [3.4, 0], Y: [3.8, 2.4]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4, 5], at: C}}
  - {{slide: [4, 1], at: C, along: 0}}
  - {{pin: [5, 6], at: Y}}
  - {{pin: [6, 1], at: X}}
loads:
  M: {{torque: 100, link: 2}}
  F: {{force: unknown, link: 4, at: C, angle: 180}}
"""


@sampled(4)
@pytest.mark.parametrize("length", [0.6, 0.7, 1.2, 3.0])
def test_a_dyad_that_the_answer_does_not_need_changes_no_row_where_it_does_not_reach(length: float) -> None:
    """In dead centres, beside them and at what is found a row has a scene of its own: all as without it."""
    text = SPARE.format(length)
    case, alone = (icsolve.load(one) for one in (text, re.sub(r"  - .pin: .[56], .*\n", "", text)))
    angles = [0.0, 60.0, 120.0, 179.9999999999, 180.0, 180.00000000001, 181.0, 300.0, 359.99999999999, 360.0]
    rows, plain = (icsolve.sweep(one, {"angles.AB": angles}) for one in (case, alone))
    assert [*rows.status] == [*plain.status]
    np.testing.assert_allclose(rows.answers["F"], plain.answers["F"], rtol=1e-14)
    for query in (Query("dead", "F"), Query("max", "F"), Query("value", "F", -300.0)):
        found, wanted = (find(one, {"angles.AB": [0.0, 360.0]}, query) for one in (case, alone))
        assert [(spot.kind, spot.at) for spot in found] == [(spot.kind, spot.at) for spot in wanted]
        for spot, other in zip(found, wanted, strict=True):
            assert spot.answer == (None if other.answer is None else pytest.approx(other.answer, rel=1e-14))


SLIDING = """icsolve: 1
points: {A: [0, 0]}
joints: [{slide: [2, 1], at: A, along: 90}]
loads:
  W: {weight: 100, link: 2, at: A}
  F: {force: unknown, link: 2, at: A, angle: 80}
"""


@pytest.mark.parametrize("written", [90, -90, 89, 91, 0, 180])
def test_what_only_slides_goes_toward_x_in_every_row(written: float) -> None:
    """Where none turns the first link that moves does so toward positive x, upward where it goes along y:
    rows of other guides had the sense that the guide as written has."""
    case = icsolve.load(SLIDING.replace("along: 90", f"along: {written}"))
    angles = [-180.0, -100.0, -90.0, 0.0, 30.0, 89.9999999, 90.0, 90.0000001, 91.0, 160.0, 270.0]
    rows = icsolve.sweep(case, {"joints.A.along": angles}, want=("velocities",))
    for angle, found in zip(angles, rows.velocities["A on 2"], strict=True):
        scene = icsolve.solve(icsolve.load(SLIDING, {"joints.A.along": angle}), rates=True)
        assert scene.velocities is not None
        assert found == pytest.approx(scene.velocities["A", "2"], rel=1e-12, abs=1e-15)


IN_LINE = """icsolve: 1
points: {{A: [0, 0], D: [4, 0]}}
lengths: {{AB: 1.3, BC: 4.1, CD: 3.2, BF: 1.29, FC: {fc}{more}}}
angles: {{AB: 70}}
near: {{C: [5, 3]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 1], at: D}}
loads:
  W: {{weight: 7, link: 3, at: {at}}}
  T: {{torque: unknown, link: 2}}
"""


@pytest.mark.parametrize("path", ["AB", "CD", "BF", "FC", "BC"])
@pytest.mark.parametrize(
    ("fc", "more", "at"), [(2.81, "", "F"), (5.39, "", "F"), (2.81, ", FG: 1, GC: 1.81", "G")]
)
def test_a_point_in_line_with_two_pins_stays_so_on_the_record(
    fc: float, more: str, at: str, path: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """BF + FC = BC, or FC - BF = BC; G in line with F and C. Other lengths leave the circles touching, so
    that no row has to be a scene; where one of these themselves is another, the row is its scene's."""
    case = icsolve.load(IN_LINE.format(fc=fc, more=more, at=at))
    written = numbers_of(case)[f"lengths.{path}"].value
    values = [written + step for step in (-0.2, -1e-9, 0.0, 1e-9, 0.05, 0.2)]
    expected = [solve_scene_status(case, f"lengths.{path}", value) for value in values]
    if path in ("AB", "CD"):

        def refuse(*_: object) -> None:
            raise AssertionError("a row is a scene")

        monkeypatch.setattr(import_module("icsolve.sweep.rows_by_scenes"), "_one", refuse)
    rows = icsolve.sweep(case, {f"lengths.{path}": np.array(values)})
    for row, (status, torque) in enumerate(expected):
        assert rows.status[row] == status
        assert rows.answers["T"][row] == pytest.approx(torque, rel=1e-14, nan_ok=True)


def solve_scene_status(case: Case, path: str, value: float) -> tuple[str, float]:
    """The status of a scene, and its torque."""
    try:
        return "ok", solve_scene(with_numbers(case, {path: value})).answers["T"].value
    except icsolve.errors.SceneError as refusal:
        return refusal.status, math.nan


SLIDE = "slide: [{0}, 1], at: C, along: {{along}}, through: O"
GUIDED = {
    "block alone": f"points: {{{{O: {{o}}, C: {{c}}}}}}\njoints: [{{{{{SLIDE.format(2)}}}}}]\nloads:\n"
    "  P: {{force: unknown, link: 2, at: C, angle: 10}}\n  F: {{force: 5, link: 2, at: C, angle: 70}}\n",
    "block on a crank": "points: {{A: [0, 0], O: {o}, C: {c}}}\nlengths: {{AB: 4, BC: 5}}\n"
    "near: {{B: [1, 4]}}\njoints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}},\n"
    f"  {{{{{SLIDE.format(4)}}}}}]\n"
    "loads: {{F: {{force: 5, link: 4, at: C, angle: 200}}, T: {{torque: unknown, link: 2}}}}\n",
    "slotted arm": "points: {{A: [0, 0], D: [-1, -4], O: {o}, C: {c}}}\njoints: [{{pin: [1, 2], at: A}},\n"
    "  {{slot: [2, 3], at: C, along: {along}, through: O}}, {{pin: [3, 1], at: D}}]\nlinks: {{3: [O]}}\n"
    "loads: {{M: {{torque: 5, link: 3}}, T: {{torque: unknown, link: 2}}}}\n",
}
"""Guides through a point that nothing else needs."""


@pytest.mark.parametrize("seed", range(few(24)))
@pytest.mark.parametrize("kind", GUIDED)
def test_a_guide_that_misses_its_point_is_told_in_rows_and_in_scenes(kind: str, seed: int) -> None:
    """Where the point and the block have both coordinates: a row was inconsistent whose scene had an answer,
    of a slip in one of them nothing was said, and a page went on."""
    dice = random.Random(f"guided {kind} {seed}")
    along, (x, y) = dice.choice([(0, (1, 0)), (90, (0, 1)), (45, (1, 1)), (135, (-1, 1))])
    off = dice.randint(1, 30) / 10
    c = [dice.randint(20, 40) / 10, dice.randint(5, 15) / 10]
    o = [round(a - off * b, 1) for a, b in zip(c, (x, y), strict=True)]
    text = "icsolve: 1\n" + GUIDED[kind].format(o=o, c=c, along=along)
    for path, at in (("points.O.x", o[0]), ("points.O.y", o[1]), ("points.C.x", c[0]), ("points.C.y", c[1])):
        values = [at, round(at + dice.choice([-0.1, 0.1, 0.3]), 1)]
        scenes = [status_of(icsolve.load(text, {path: str(value)})) for value in values]
        misses = (along, path[-1]) not in {(0, "x"), (90, "y")}  # else it moves along the guide
        assert scenes == ["ok", "inconsistent" if misses else "ok"], path
        if path.startswith("points.O"):  # of C a coordinate may move the mechanism
            rows = icsolve.sweep(icsolve.load(text), {path: values}, want=("status",)).status.tolist()
            assert rows == scenes, path


def status_of(case: icsolve.Case) -> str:
    try:
        return icsolve.solve(case).status
    except icsolve.SceneError as refusal:
        return refusal.status
