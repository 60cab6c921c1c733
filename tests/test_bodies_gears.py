"""Tooth forces and the loads on bearings, against the formulas of machine design and problem 13.23.

A tooth force has a tangential part T / r and a separating part (T / r) tan(phi); tolerance 1e-12.
"""

from __future__ import annotations

import math
import random
from pathlib import Path
from typing import Any

import pytest

import icsolve
from icsolve.answer import Answer
from icsolve.answer.bodies import Reaction

CASES = Path(__file__).parent.parent / "cases" / "gears"
TAN = math.tan(math.radians(20))


def solved(text: str) -> Answer:
    return icsolve.solve(icsolve.load("icsolve: 1\n" + text), reactions=True)


def force(answer: Answer, name: str) -> Reaction:
    assert answer.reactions is not None
    return answer.reactions[name]


def is_force(reaction: Reaction, x: float, y: float) -> bool:
    return (reaction.x, reaction.y) == (exactly(x), exactly(y))


def exactly(number: float) -> Any:
    return pytest.approx(number, rel=1e-12, abs=1e-12)


def digits(text: str) -> Any:
    return pytest.approx(float(text), rel=0, abs=0.5 * 10.0 ** -len(text.partition(".")[2]))


def pair(apart: float = 2.75, tooth: str = "pressure angle: 20, diametral pitch: 16") -> str:
    return f"""
units: {{length: in, force: lbf}}
points: {{O2: [0, 0], O3: [0, {apart}]}}
joints:
  - {{pin: [1, 2], at: O2}}
  - {{pin: [1, 3], at: O3}}
  - {{gears: [2, 3], teeth: [31, 57], {tooth}}}
loads:
  T3: {{torque: 500 lbf*ft, link: 3}}
  T2: {{torque: unknown, link: 2}}
"""


def test_13_23_spur_gears() -> None:
    """Recomputed values of the source document's problem 13.23; in print they are 12 times too small."""
    answer = solved(pair())
    assert answer.answers["T2"].value / 12 == digits("271.93")
    tooth = force(answer, "F23")
    assert dict(tooth.parts) == {"tangential": digits("3368.4"), "separating": digits("1226.0")}
    assert tooth.magnitude == digits("3584.6")
    assert force(answer, "F13").magnitude == force(answer, "F12").magnitude == digits("3584.6")


def test_the_separating_force_pushes_gears_apart_whichever_flank_carries() -> None:
    for text in (pair(), pair().replace("torque: 500", "torque: -500")):
        tooth = force(solved(text), "F23")
        assert tooth.y == digits("1226.0")  # the wheel is above the pinion


def test_teeth_that_do_not_fit_their_pivots_are_refused_with_the_line() -> None:
    with pytest.raises(icsolve.SceneError, match="gears 2 and 3 \\(line 8\\) do not fit") as caught:
        solved(pair(2.8))
    assert caught.value.status == "inconsistent"
    assert "2.75 in" in str(caught.value)


@pytest.mark.parametrize("pitch", ["16 1/in", "16.0 / in", "16 /in", "16 in^-1"])
def test_a_diametral_pitch_may_have_its_unit(pitch: str) -> None:
    bare, named = (solved(pair(tooth=f"diametral pitch: {p}")).answers["T2"].value for p in ("16", pitch))
    assert named == bare


def test_without_a_pressure_angle_the_bearing_loads_are_open_and_the_torque_is_not() -> None:
    answer = solved(pair(tooth="diametral pitch: 16"))
    tooth = force(answer, "F23")
    assert (tooth.x, tooth.y) == (digits("-3368.4"), None)
    assert "pressure angle" in tooth.why
    assert any("`pressure angle`" in note for note in answer.notes)


def test_idler_of_a_train_carries_both_tooth_forces() -> None:
    answer = solved("""
points: {A: [0, 0], B: [3, 0], C: [3, 4]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {pin: [1, 4], at: C}
  - {gears: [2, 3], teeth: [20, 40], pressure angle: 20}
  - {gears: [3, 4], teeth: [40, 40], pressure angle: 20}
loads:
  T2: {torque: 10, link: 2}
  T4: {torque: unknown, link: 4}
""")
    assert answer.answers["T4"].value == exactly(-20)
    assert is_force(force(answer, "F23"), 10 * TAN, 10)
    assert is_force(force(answer, "F34"), 10, 10 * TAN)
    assert is_force(force(answer, "F13"), 10 - 10 * TAN, 10 * TAN - 10)


def test_epicyclic_with_a_fixed_annulus() -> None:
    """Sun 20, planet 10, annulus 40: the planet's pin carries both tangential forces, no separating one."""
    answer = solved("""
points: {O: [0, 0], P: [0, 3]}
joints:
  - {pin: [1, 2, 4], at: O}
  - {pin: [4, 3], at: P}
  - {gears: [2, 3], teeth: [20, 10], pressure angle: 20}
  - {gears: [3, 1], teeth: [10, -40], pressure angle: 20}
loads:
  T2: {torque: 10, link: 2}
  T4: {torque: unknown, link: 4}
""")
    assert answer.answers["T4"].value == exactly(-30)
    assert is_force(force(answer, "F23"), -5, 5 * TAN)
    assert is_force(force(answer, "F13"), -5, -5 * TAN)  # the annulus presses the planet inward
    assert is_force(force(answer, "F34"), -10, 0)
    assert is_force(force(answer, "F12"), -5, 5 * TAN)


def test_internal_gear_is_pushed_outward() -> None:
    answer = solved("""
points: {A: [0, 0], B: [2, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {gears: [2, 3], teeth: [60, -100], pressure angle: 20}
loads:
  T2: {torque: 30, link: 2}
  T3: {torque: unknown, link: 3}
""")
    assert answer.answers["T3"].value == exactly(-50)
    tooth = force(answer, "F23")
    assert tooth.at == (exactly(-3), exactly(0))
    assert is_force(tooth, -10 * TAN, -10)  # the pitch point is at the left, and outward is left


@pytest.mark.parametrize("teeth", ["roll: [2, 3]", "roll: [3, 2]", "roll: [2, 3], radii: [-3, 1]"])
def test_teeth_that_roll_in_a_ring_press_the_pinion_inward(teeth: str) -> None:
    """Tangential 9 / 3 = 3, separating 3 tan 20 from the ring at (3, 0) to the pinion's centre (2, 0), in
    whatever order the links are named; of two pins nobody could tell which is its centre."""
    text = """
points: {{O: [0, 0], Q: [2, 0], P: [3, 0]}}
joints:
  - {{pin: [1, 2], at: O}}
  - {{pin: [1, 3], at: Q}}
  - {{{teeth}, at: P, pressure angle: 20}}
loads:
  T2: {{torque: 9, link: 2}}
  T3: {{torque: unknown, link: 3}}
"""
    answer = solved(text.format(teeth=teeth))
    assert answer.answers["T3"].value == exactly(-3)
    tooth = force(answer, "F23")
    assert is_force(tooth, *((-3 * TAN, 3) if tooth.on == "3" else (3 * TAN, -3)))
    rod = "  - {pin: [3, 4], at: R}\n  - {pin: [4, 5], at: S}\n  - {slide: [5, 1], at: S, along: 0}\nloads:"
    several = text.format(teeth=teeth).replace("P: [3, 0]", "P: [3, 0], R: [2.4, 0.3], S: [6, 0]")
    several = several.replace("loads:", rod)
    if "radii" in teeth:
        assert solved(several).answers["T3"].value == exactly(-3)
    else:
        with pytest.raises(icsolve.SceneError, match="need the pin of the round one: give `radii`"):
            solved(several)


RACK = """
points: {O: [0, 1.5], P: [0, 0], R: [3, -0.5]}
joints:
  - {pin: [1, 2], at: O}
  - {slide: [3, 1], at: R, along: 0}
  - {roll: [2, 3], at: P, radii: [1.5, 0], pressure angle: 20}
loads:
  F: {force: 100, link: 3, at: R, angle: 180}
  T2: {torque: unknown, link: 2}
"""


def test_rack_is_pressed_to_its_guide() -> None:
    answer = solved(RACK)
    assert answer.answers["T2"].value == exactly(150)
    assert is_force(force(answer, "F23"), 100, -100 * TAN)
    assert dict(force(answer, "F23").parts) == {"tangential": exactly(100), "separating": exactly(100 * TAN)}
    assert is_force(force(answer, "F13"), 0, 100 * TAN)
    assert force(answer, "F13").moment == exactly(0.5 * 100 - 3 * 100 * TAN)


def test_rack_without_a_pressure_angle_leaves_the_pressure_open() -> None:
    answer = solved(RACK.replace(", pressure angle: 20", ""))
    assert force(answer, "F23").x == exactly(100)
    assert force(answer, "F23").y is None
    assert force(answer, "F13").x == exactly(0)


def test_friction_of_a_gear_bearing_needs_the_pressure_angle() -> None:
    rubbing = pair().replace("at: O3", "at: O3, mu: 0.1, radius: 0.5") + "motion: {link: 2, turns: ccw}\n"
    with pytest.raises(icsolve.SceneError, match="Give the gears their `pressure angle`"):
        solved(rubbing.replace("pressure angle: 20, ", ""))
    # the wheel's bearing carries the tooth force; its friction adds mu R sin to the load torque
    r = 0.5 * math.sin(math.atan(0.1))
    wheel = 57 / 32
    tangential = -6000 / (wheel + math.copysign(r, -1) / math.cos(math.radians(20)))
    answer = solved(rubbing)
    assert abs(dict(force(answer, "F23").parts)["tangential"]) == exactly(abs(tangential))


def test_teeth_that_do_not_fit_are_refused_where_only_the_torque_is_asked_too() -> None:
    case = icsolve.load("icsolve: 1\n" + pair(2.8))
    with pytest.raises(icsolve.SceneError, match="do not fit"):
        icsolve.solve(case)


@pytest.mark.parametrize("angle", [0, 30, 90, 215])
def test_helical_gears_load_their_bearings_alike_wherever_one_stands_about_the_other(angle: int) -> None:
    """The axial force W tan(helix) acts at the pitch radius: r W tan(h) on either wheel, over the span of its
    bearings on each (K. J. Waldron, G. L. Kinzel and S. K. Agrawal, ch. 11)."""
    x, y = 21.0 * math.cos(math.radians(angle)), 21.0 * math.sin(math.radians(angle))
    answer = solved(f"""
points: {{A: [0, 0], B: [{x}, {y}]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [1, 3], at: B}}
  - {{gears: [2, 3], teeth: [9, 12], normal pressure angle: 20, helix angle: 30, bearing span: 2}}
loads: {{T2: {{torque: 18, link: 2}}, T3: {{torque: unknown, link: 3}}}}
""")
    shares = dict(force(answer, "F23").parts)
    axial = 18.0 / 9.0 * math.tan(math.radians(30.0))
    assert shares["axial"] == exactly(axial)
    assert (shares["couple 2"], shares["couple 3"]) == (exactly(9.0 * axial), exactly(12.0 * axial))
    assert (shares["bearing 2"], shares["bearing 3"]) == (exactly(4.5 * axial), exactly(6.0 * axial))


@pytest.mark.parametrize("crossed", ["no", "yes"])
def test_a_belt_runs_only_over_pulleys_that_a_line_of_its_strands_touches(crossed: str) -> None:
    """Crossed its strands touch both between the centres, which are then farther apart than both radii; open
    from outside, and neither pulley may lie in the other. The ratio is that of the radii all the same."""
    text = f"""icsolve: 1
points: {{A: [0, 0], B: [5, 0]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [1, 3], at: B}}
  - {{belt: [2, 3], radii: [2, %s], crossed: {crossed}}}
loads:
  K: {{torque: 10, link: 2}}
  U: {{torque: unknown, link: 3}}
"""
    limit = 3.0 if crossed == "yes" else 7.0
    for radius in (limit - 0.01, limit + 0.01):
        answer = icsolve.solve(icsolve.load(text % radius))
        assert abs(answer.answers["U"].value) == pytest.approx(5 * radius, rel=1e-15)
        assert any("belt runs over pulleys 2 and 3" in note for note in answer.notes) is (radius > limit)


TRAIN = """\
icsolve: 1
points: {{O: [0, 0], P: [{apart}, 0], Q: [{end}, 0]}}
joints:
  - {{pin: [1, sun], at: O}}
  - {{pin: [{arm}, planet], at: P}}
  - {{gears: [sun, planet], teeth: [{sun}, {planet}]}}
  - {{gears: [planet, {last}], teeth: [{planet}, %d]}}
  - {{pin: [1, {moved}], at: {where}}}
loads:
  T: {{torque: 10, link: sun}}
  M: {{torque: unknown, link: {moved}}}
"""


@pytest.mark.parametrize("seed", range(12))
def test_teeth_on_the_wrong_side_are_noted_with_what_would_make_a_wheel_of_one_size(seed: int) -> None:
    """A planet has one size where it meets the sun and where it meets the next wheel, an annulus about the
    sun or an outer wheel beyond the planet; with the other sign two. What is told to write mends it."""
    dice = random.Random(seed)
    sun, planet, apart = dice.randint(15, 40), dice.randint(15, 40), dice.uniform(0.1, 50)
    module, annulus = 2.0 * apart / (sun + planet), bool(seed % 2)
    teeth = -(sun + 2 * planet) if annulus else dice.randint(41, 80)
    end = apart + module * (planet + abs(teeth)) / 2.0
    links = {"arm": "arm", "last": 1, "moved": "arm", "where": "O"}
    if not annulus:
        links = {"arm": 1, "last": "wheel", "moved": "wheel", "where": "Q"}
    text = TRAIN.format(apart=apart, end=end, sun=sun, planet=planet, **links)
    right = icsolve.solve(icsolve.load(text % teeth))
    assert not any("pitch radius" in note for note in right.notes)
    wrong = icsolve.solve(icsolve.load(text % -teeth))
    told = next(note for note in wrong.notes if "pitch radius" in note)
    assert f"write teeth: [{planet}, {teeth}]" in told
    assert right.answers["M"].value != pytest.approx(wrong.answers["M"].value)


STAGES = """\
icsolve: 1
points: {O: [0, 0], P: [60, 0], Q: [0, 60]}
joints:
  - {pin: [1, s, c, d], at: O}
  - {pin: [c, p], at: P}
  - {pin: [d, q], at: Q}
  - {gears: [s, p], teeth: [20, 30]}
  - {gears: [1, p], teeth: [-80, 30]}
  - {gears: [c, q], teeth: [24, 28]}
  - {gears: [q, 1], teeth: [28, -80]}
loads:
  T: {torque: 10, link: s}
  M: {torque: unknown, link: d}
"""


@pytest.mark.parametrize("slips", [["-80, 30"], ["28, -80"], ["-80, 30", "28, -80"]])
def test_of_several_meshes_only_those_on_the_wrong_side_are_told(slips: list[str]) -> None:
    """A wheel that meets both a right mesh and a wrong one is no reason to turn the right one."""
    text = STAGES
    for slip in slips:
        text = text.replace(slip, slip.replace("-", ""))
    told = [note for note in icsolve.solve(icsolve.load(text)).notes if "pitch radius" in note]
    assert [note.partition("write teeth: ")[2] for note in told] == [f"[{slip}]." for slip in slips]


@pytest.mark.parametrize(
    "name",
    ["compound_epicyclic", "ferguson_paradox", "ravigneaux_low", "differential_train", "sun_and_planet"],
)
def test_wheels_of_several_sizes_on_one_link_are_not_noted(name: str) -> None:
    """A stepped planet has two wheels, and those with a tooth more or less keep their distance."""
    answer = icsolve.solve(icsolve.load(CASES / f"{name}.yaml"))
    assert not any("pitch radius" in note for note in answer.notes)
