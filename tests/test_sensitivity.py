"""Sensitivities are derivatives: finite differences in sixty digits say the same."""

from __future__ import annotations

import math
from random import Random

import pytest
from mpmath import mpf

import icsolve
from icsolve.case import Number, Rope
from icsolve.errors import SceneError
from icsolve.scene.program import Want, evaluate, prepare
from icsolve.scene.sensitivity import band, entries, influences, numbers_of, text
from icsolve.statics.power import has_friction
from icsolve.sweep.varied_numbers import with_numbers
from library import FILES, sample
from more_digits import SixtyDigits
from sizes import sampled

PRESS = """
icsolve: 1
points: {A: [0, 0], D: [4, 0.5]}
lengths: {AB: 1, BC: 3.5, CD: 2.5, DE: 1.5}
angles: {AB: 60, CDE: 20}
near: {C: [3.5, 2.4]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
loads:
  P: {force: 100, link: 4, at: E, angle: 180}
  K: {spring: 12, free: 1.2, link: 3, at: C, to: A}
  T12: {torque: unknown, link: 2}
"""


class Moved(SixtyDigits):
    """Sixty digits with one number of the case moved."""

    def __init__(self, path: str, by: float) -> None:
        self.path, self.by = path, by

    def given(self, number: Number) -> object:
        return super().given(number) + (mpf(self.by) if number.path == self.path else 0)


def test_every_sensitivity_is_a_derivative() -> None:
    case = icsolve.load(PRESS)
    found = influences(icsolve.solve(case), "T12")
    assert {"lengths.AB", "angles.CDE", "loads.K.free", "points.D.y", "loads.P"} <= {i.path for i in found}
    program = prepare(case, Want())
    for influence in found:
        up, down = (evaluate(program, Moved(influence.path, h))[1].solution for h in (1e-12, -1e-12))
        difference = float((up.values["T12"] - down.values["T12"]) / mpf(2e-12))
        assert influence.per_unit == pytest.approx(difference, rel=1e-9, abs=1e-12), influence.path


SEVERAL_FREEDOMS = {"linkages/five_bar.yaml", "linkages/pantograph.yaml"}
"""Where the null space of loops is found by elimination, among whose numbers some are zero as they stand."""


@sampled(2)
@pytest.mark.parametrize("name", sorted(SEVERAL_FREEDOMS | {*sample(FILES, 15, "slopes")}))
def test_sensitivities_of_the_library_are_derivatives(name: str) -> None:
    """By every number, also where an answer or a coefficient is zero in the position as written."""
    case = icsolve.load(FILES[name])
    try:
        slopes = icsolve.solve(case).sensitivities
        program = prepare(case, Want())
    except icsolve.SceneError:
        pytest.skip("no answer, or one of another kind")
    if case.dynamic or has_friction(case) or any(isinstance(joint, Rope) for joint in case.joints):
        pytest.skip("inertia forces, friction and ropes have slopes of their own")
    paths = {path for by_path in slopes.values() for path in by_path}
    assert paths <= set(numbers_of(case))
    for path in sorted(paths):
        up, down = (evaluate(program, Moved(path, h))[1].solution.values for h in (1e-12, -1e-12))
        for load, by_path in slopes.items():
            if load in up:
                size = max(map(abs, by_path.values()))
                true = float((up[load] - down[load]) / mpf(2e-12))
                assert by_path.get(path, 0.0) == pytest.approx(true, rel=1e-9, abs=1e-12 * size + 1e-15), path
                assert by_path.get(path, 0.0) != 0.0 or abs(true) < 1e-14 * size, path


def test_what_an_answer_does_not_depend_on_has_no_sensitivity() -> None:
    """And not one of the order of rounding: the crank's torque, of the other crank's length and angle."""
    case = icsolve.load(FILES["linkages/five_bar.yaml"])
    assert {i.path for i in influences(icsolve.solve(case), "T12")} == {
        *("angles.AB", "angles.BC", "angles.DC", "lengths.AB", "loads.P", "loads.P.angle")
    }


@sampled(3)
@pytest.mark.parametrize("name", sample(FILES, 2, "roundings"))
def test_no_rounding_is_told_as_a_sensitivity(name: str) -> None:
    """A number of which the answer is free, such as where on a link that only shifts its weight hangs."""
    case = icsolve.load(FILES[name])
    try:
        answer = icsolve.solve(case)
        told = {load: influences(answer, load) for load in answer.answers if not answer.answers[load].holds}
    except SceneError:
        return
    for found in told.values():
        assert all(abs(one.percent) > 1e-13 * abs(found[0].percent) for one in found if one.percent)


def test_one_percent_more_of_the_only_load_is_one_percent_more_torque() -> None:
    text = "\n".join(line for line in PRESS.splitlines() if "spring" not in line)
    by_path = {i.path: i for i in influences(icsolve.solve(icsolve.load(text)), "T12")}
    assert by_path["loads.P"].percent == pytest.approx(1.0)


@pytest.mark.parametrize(("force", "arm"), [(1, 1), (3, 1), (-1, 3), (0, 1), (-2, 0.5)])
def test_a_torque_depends_on_a_force_and_its_arm(force: float, arm: float) -> None:
    """T = -(F + 2) a: slope -a, and F / (F + 2) per cent a per cent where neither F nor T is zero."""
    case = icsolve.load(
        f"icsolve: 1\npoints: {{A: [0, 0], B: [{arm}, 0]}}\njoints: [{{pin: [1, 2], at: A}}]\n"
        f"loads: {{F: {{force: {force}, link: 2, at: B, angle: 90}}, "
        "G: {force: 2, link: 2, at: B, angle: 90}, T: {torque: unknown, link: 2}}"
    )
    (found,) = (i for i in influences(icsolve.solve(case), "T") if i.path == "loads.F")
    percent = force / (force + 2) if force not in (0, -2) else None
    assert (found.value, found.per_unit, found.percent) == (
        force,
        pytest.approx(-arm),
        pytest.approx(percent),
    )


def test_the_strongest_comes_first() -> None:
    found = influences(icsolve.solve(icsolve.load(PRESS)), "T12")
    percents = [abs(i.percent) for i in found if i.percent is not None]
    assert percents == sorted(percents, reverse=True)


def test_the_band_of_a_drawing_grows_with_its_tolerance_and_covers_each_point_moved() -> None:
    answer = icsolve.solve(icsolve.load(PRESS))
    assert band(answer, "T12", 0.02) == pytest.approx(2 * band(answer, "T12", 0.01))
    for path in ("lengths.AB", "points.D.y"):
        slope = answer.sensitivities["T12"][path]
        assert band(answer, "T12", 0.01) >= abs(slope) * 0.01


def test_the_text_and_the_json_say_the_same_numbers() -> None:
    answer = icsolve.solve(icsolve.load(PRESS))
    shown = entries(answer, True, 0.01)
    first = shown["sensitivity"]["T12"][0]
    lines = text(answer, True, 0.01, 6).splitlines()
    assert lines[0].startswith(f"T12 within {shown['band']['T12']:.2g} N*m")
    assert lines[2].split() == [first["path"], f"{first['percent']:.4g}", f"{first['per_unit']:.4g}"]


@pytest.mark.parametrize("places", range(5, 18))
def test_beside_a_dead_centre_the_slopes_come_from_more_digits(places: int) -> None:
    """A tape of doubles says nothing there, and on the way there less and less; in closed form M2 is -1/2
    over the gap of B and A."""
    gap, at = float(f"37e-{places + 2}"), f"2.{'0' * places}37"
    text = """
icsolve: 1
points: {A0: [0, 0], A: [1, 0], B: [AT, 2], B0: [3, 4]}
joints:
  - {pin: [1, 2], at: A0}
  - {pin: [2, 3], at: A}
  - {pin: [3, 4], at: B}
  - {pin: [4, 1], at: B0}
loads: {M4: {torque: 1, link: 4}, M2: {torque: unknown, link: 2}}
"""
    slopes = icsolve.solve(icsolve.load(text.replace("AT", at))).sensitivities["M2"]
    assert slopes["points.B.x"] == pytest.approx(0.5 / gap**2, rel=1e-8)
    assert slopes["loads.M4"] == pytest.approx(-0.5 / gap, rel=1e-8)


@pytest.mark.parametrize("places", range(2, 16))
@pytest.mark.parametrize(
    "loads",
    [
        "M: {torque: 5, link: 3}, U: {torque: unknown, link: 4}",
        "M: {torque: 5, link: 2}, U: {torque: unknown, link: 2}, "
        "S: {spring: 9, free: 1, link: 3, at: C, to: D}",
    ],
)
def test_beside_a_limit_that_an_answer_does_not_feel_its_slopes_are_derivatives(
    loads: str, places: int
) -> None:
    """Coupler and rocker are all but in line, and the answer is what it is anywhere: doubles have
    it to all digits, and none of its derivatives."""
    text = f"""
icsolve: 1
points: {{A: [0, 0], B: [0.6, 0.8], D: [5.6, 0.8]}}
lengths: {{BC: 3.0, CD: 2.{"0" * (places - 1)}37}}
near: {{C: [3.6, 1]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 1], at: D}}
loads: {{{loads}}}
"""
    case = icsolve.load(text)
    answer, program = icsolve.solve(case), prepare(case, Want())
    slopes = answer.sensitivities["U"]
    size = max(map(abs, slopes.values()))
    for path in ("points.B.x", "points.B.y", "points.D.y", "lengths.BC", "lengths.CD", "loads.M"):
        up, down = (evaluate(program, Moved(path, h))[1].solution.values["U"] for h in (1e-25, -1e-25))
        true = float((up - down) / mpf(2e-25))
        assert slopes[path] == pytest.approx(true, rel=1e-8, abs=1e-12 * size), path
    told = any("half a unit of the last decimal of lengths.BC" in note for note in answer.notes)
    assert not told or abs(slopes["lengths.BC"]) * 0.05 > abs(answer.answers["U"].value)


def test_the_size_of_a_force_of_unknown_direction_has_the_slopes_of_a_root_of_squares() -> None:
    """It balances W = 200 and H = 70: sqrt(W^2 + H^2) changes by W / P a newton of W. The band of its foot,
    on which it does not hang, is none."""
    text = """icsolve: 1
points: {A: [0, 0], B: [3, 0], C: [3, 2]}
joints:
  - {slide: [2, 1], at: A, along: 0}
  - {slide: [3, 2], at: B, along: 90}
loads:
  W: {weight: 200, link: 3, at: B}
  H: {force: 70, link: 3, at: B, angle: 0}
  P: {force: [unknown, unknown], link: 3, at: C}
"""
    answer = icsolve.solve(icsolve.load(text))
    size = math.hypot(200.0, 70.0)
    slopes = {one.path: one.per_unit for one in influences(answer, "P")}
    assert slopes["loads.W"] == pytest.approx(200 / size, rel=1e-12)
    assert slopes["loads.H"] == pytest.approx(70 / size, rel=1e-12)
    assert not any(path.startswith("loads.P") for path in slopes)
    assert band(answer, "P", 0.01) == 0.0


FIVE_BAR = """
icsolve: 1
points: {A: [0, 0], B: [0.3, 2], C: [2.6, 4.3], D: [4.1, 1.9], E: [5, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 5], at: D}
  - {pin: [5, 1], at: E}
loads:
  P: {torque: 10, link: 2}
  Q: {torque: -7, link: 5}
  W: {weight: 3, link: 3, at: [1.5, 3]}
  R: {force: [unknown, unknown], link: 3, at: [2.5, 4]}
"""


def test_where_a_force_of_unknown_direction_is_zero_all_others_have_their_slopes() -> None:
    """A bar under a weight, and a carriage of two slides that nothing loads: T = W x, by x and by W."""
    answer = icsolve.solve(
        icsolve.load("""icsolve: 1
points: {A: [0, 0], B: [2, 0], P: [0, 2]}
joints:
  - {pin: [1, 2], at: A}
  - {slide: [3, 1], at: P, along: 0}
  - {slide: [4, 3], at: P, along: 90}
loads:
  W: {weight: 10, link: 2, at: B}
  T: {torque: unknown, link: 2}
  R: {force: [unknown, unknown], link: 4, at: P}
""")
    )
    told = entries(answer, True, 0.01)
    assert {one["path"]: one["per_unit"] for one in told["sensitivity"]["T"]} == {
        "points.B.x": 10.0, "loads.W": 2.0, "points.A.x": -10.0,
    }  # fmt: skip
    assert told["sensitivity"]["R"] is None and told["band"] == {"T": pytest.approx(0.2), "R": None}
    assert "R is zero and has no direction" in text(answer, True, 0.01, 6)


def test_the_size_of_a_force_hangs_on_its_own_place_too() -> None:
    """Its coordinates `[x, y]` are numbers of the drawing: the band holds what each of all moves it by."""
    case, step, reach = icsolve.load(FIVE_BAR), 1e-4, 0.0
    answer = icsolve.solve(case)
    slopes = {one.path: one.per_unit for one in influences(answer, "R")}
    for path, number in numbers_of(case).items():
        ends = [with_numbers(case, {path: number.value + way * step}) for way in (1, -1)]
        more, less = (icsolve.solve(end).answers["R"].value for end in ends)
        assert more is not None and less is not None
        slope = (more - less) / (2 * step)
        assert slopes.get(path, 0.0) == pytest.approx(slope, rel=1e-6, abs=1e-9), path
        reach += abs(slope) if ".x" in path or ".y" in path else 0.0
    assert band(answer, "R", 0.01) == pytest.approx(0.01 * reach, rel=1e-6)


LIKE = """
icsolve: 1
points: {{A: [0, 0], D: [8, 1]}}
lengths: {{AB: 3, BC: 8, CD: 5}}
angles: {{AB: {angle}}}
near: {{C: [6, 5]}}
joints:
  - {{pin: [1, 2], at: A{rubs}}}
  - {{pin: [2, 3], at: B{rubs}}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 1], at: D}}
loads:
  P: {{force: 200, link: 4, at: C, angle: 180}}
  T: {{torque: unknown, link: 2}}
  U: {{torque: {{like: T, times: {u}}}, link: 3}}
  V: {{torque: {{like: U, times: {v}}}, link: 4}}
{motion}
"""


@sampled(2, "rubs")
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("rubs", ["", ", mu: 0.2, radius: 0.5"])
def test_a_load_that_is_so_many_times_another_hangs_on_that_number_itself(rubs: str, seed: int) -> None:
    """As its value does, with friction and without, and where what it is like is like a third."""
    draw = Random(f"like {seed}")
    numbers = {"u": draw.uniform(0.1, 0.6), "v": -draw.uniform(0.1, 0.9), "angle": draw.uniform(70.0, 130.0)}
    motion = "motion: {link: 2, turns: cw}" if rubs else ""

    def solved(**other: float) -> icsolve.Answer:
        told = {name: f"{number!r}" for name, number in (numbers | other).items()}
        return icsolve.solve(icsolve.load(LIKE.format(rubs=rubs, motion=motion, **told)))

    answer = solved()
    for key, path in (("u", "loads.U.times"), ("v", "loads.V.times")):
        more, less = (solved(**{key: numbers[key] + h}) for h in (1e-6, -1e-6))
        for load in "TUV":
            change = (more.answers[load].value - less.answers[load].value) / 2e-6
            (found,) = (i.per_unit for i in influences(answer, load) if i.path == path)
            assert found == pytest.approx(change, rel=1e-6), (load, path)
