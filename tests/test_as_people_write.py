"""Cases as people write them: awkward, but what they mean is plain."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import icsolve
from icsolve.draw import Drawing, draw
from icsolve.sweep.request import RequestError

FOUR_BAR = """
icsolve: 1
units: {length: in, force: lbf}
points: {A: [0, 0], B: [1, 2], C: [5, 3], D: [6, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
loads:
  P: {force: 100, link: 4, at: C, angle: 190}
  T12: {torque: unknown, link: 2}
"""


@pytest.mark.parametrize(("known", "status"), [("100", "no-value"), ("0", "any-value")])
def test_an_unknown_on_the_frame_balances_nothing(known: str, status: str) -> None:
    text = FOUR_BAR.replace("torque: unknown, link: 2", "torque: unknown, link: 1")
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.solve(icsolve.load(text.replace("force: 100", f"force: {known}")))
    assert refused.value.status == status and "never moves" in refused.value.message


def test_centres_of_one_freedom_stand_where_the_speed_is_zero() -> None:
    still = icsolve.solve(icsolve.load(FOUR_BAR + "motion: {link: 2, speed: 0}"), all_centres=True)
    moving = icsolve.solve(icsolve.load(FOUR_BAR), all_centres=True)
    assert still.to_dict()["centres"] == moving.to_dict()["centres"]
    assert still.answers == moving.answers


PINION = """
icsolve: 1
units: {length: mm, force: N}
points: {A: [0, 0], P: [0, -40], K: [10, -50]}
lengths: {AF: 25}
angles: {AF: 0}
joints:
  - {pin: [1, 2], at: A}
  - {roll: [2, 3], at: P, radii: [40, 0]}
  - {slide: [3, 1], at: K, along: 0}
loads:
  W: {weight: 5, link: 2, at: F}
  F1: {force: unknown, link: 3, at: K, angle: 0}
"""


def test_the_angle_of_a_handle_turns_its_pinion_and_moves_the_rack() -> None:
    degrees = np.linspace(-400.0, 300.0, 8)
    sweep = icsolve.sweep(icsolve.load(PINION), vary={"angles.AF": degrees}, want=("answers", "points"))
    np.testing.assert_allclose(sweep.points["K"][:, 0], 10.0 + 40.0 * np.radians(degrees), rtol=1e-12)
    force = 5.0 * 25.0 * np.cos(np.radians(degrees)) / 40.0
    np.testing.assert_allclose(sweep.answers["F1"], force, rtol=1e-9)


def test_the_angle_of_a_handle_turns_what_a_crossed_belt_drives() -> None:
    text = """
icsolve: 1
units: {length: mm, force: N}
points: {A: [0, 0], B: [200, 0], G: [210, 20]}
lengths: {AF: 25}
angles: {AF: 30}
links: {2: [F]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {belt: [2, 3], radii: [40, 100], crossed: true}
loads:
  W: {weight: 5, link: 3, at: G}
  T: {torque: unknown, link: 2}
"""
    degrees = np.linspace(-400.0, 300.0, 8)
    sweep = icsolve.sweep(icsolve.load(text), vary={"angles.AF": degrees}, want=("answers", "points"))
    turned = -0.4 * np.radians(degrees - 30.0)
    x = 10.0 * np.cos(turned) - 20.0 * np.sin(turned)
    np.testing.assert_allclose(sweep.points["G"][:, 0], 200.0 + x, rtol=1e-12)
    np.testing.assert_allclose(sweep.answers["T"], -0.4 * 5.0 * x, rtol=1e-9)


def test_a_roller_in_a_drum_is_solved_where_its_line_of_centres_is_level() -> None:
    """A pivot of its equations is zero there, though nothing is singular."""
    text = """
icsolve: 1
units: {length: mm, force: N}
points: {O: [0, 0]}
lengths: {OC: 70, OP: 100, CF: 20}
angles: {OC: -90, OP: -90, CF: 10}
joints:
  - {pin: [1, 4], at: O}
  - {pin: [4, 3], at: C}
  - {roll: [3, 1], at: P, radii: [30, -100]}
loads:
  W: {weight: 5, link: 3, at: F}
  T4: {torque: unknown, link: 4}
"""
    degrees = np.array([-180.0, -91.0, 0.0, 90.0, 180.0])
    sweep = icsolve.sweep(icsolve.load(text), vary={"angles.OC": degrees}, want=("answers", "status"))
    assert list(sweep.status) == ["ok"] * 5
    turn, angle = np.radians(degrees), np.radians(10.0 - 70.0 / 30.0 * (degrees + 90.0))
    rise = 70.0 * np.cos(turn) - 70.0 / 30.0 * 20.0 * np.cos(angle)
    np.testing.assert_allclose(sweep.answers["T4"], 5.0 * rise, rtol=1e-9)


def test_a_slip_of_many_powers_of_ten_is_no_figure() -> None:
    text = FOUR_BAR.replace("D: [6, 0]", "D: [6e200, 0]")
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.solve(icsolve.load(text))
    assert refused.value.status == "near-singular" and "point B" in refused.value.message
    assert icsolve.solve(icsolve.load(FOUR_BAR.replace("D: [6, 0]", "D: [6e20, 0]"))).answers["T12"].value


def test_a_speed_a_hair_below_a_power_of_ten_has_its_scale() -> None:
    motion = "motion: {point: B, link: 2, speed: 100, angle: 153.5}"
    assert "100 in/s" in draw(icsolve.load(FOUR_BAR + motion), Drawing(velocities=True))


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"lengths.AB": [1.0, -1.0]}, "not be negative"),
        ({"angles.AB": [0.0, 1e9]}, "take turns off"),
        ({"angles.AB": ["x"]}, "should be numbers"),
    ],
)
def test_values_that_no_case_may_have_are_refused(values: dict[str, list[float]], said: str) -> None:
    text = FOUR_BAR.replace("B: [1, 2], ", "") + "lengths: {AB: 2}\nangles: {AB: 60}"
    with pytest.raises(RequestError, match=said):
        icsolve.sweep(icsolve.load(text), vary=values)


def test_answers_and_refusals_cross_processes() -> None:
    """What a pool of processes sends back: pickled, and the same."""
    answer = icsolve.solve(icsolve.load(FOUR_BAR), all_centres=True, rates=True, reactions=True)
    assert pickle.loads(pickle.dumps(answer)).to_dict() == answer.to_dict()
    with pytest.raises(icsolve.CaseError) as refused:
        icsolve.load(FOUR_BAR.replace("at: A", "on: A"))
    assert pickle.loads(pickle.dumps(refused.value)).problems == refused.value.problems
    with pytest.raises(icsolve.SceneError) as no_answer:
        icsolve.solve(icsolve.load(FOUR_BAR.replace("force: 100", "force: unknown")))
    assert pickle.loads(pickle.dumps(no_answer.value)).message == no_answer.value.message


def test_teeth_that_do_not_fit_their_pivots_are_refused_in_a_sweep_too() -> None:
    text = """
icsolve: 1
units: {length: mm, force: N}
points: {A: [0, 0], B: [66, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {gears: [2, 3], teeth: [20, 46], module: 3 mm}
loads:
  T2: {torque: 10, link: 2}
  T3: {torque: unknown, link: 3}
"""
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.sweep(icsolve.load(text), vary={"loads.T2": [1.0, 2.0]})
    assert refused.value.status == "inconsistent" and "do not fit" in refused.value.message
    fitting = icsolve.sweep(icsolve.load(text.replace("3 mm", "2 mm")), vary={"loads.T2": [1.0, 2.0]})
    np.testing.assert_allclose(fitting.answers["T3"], [2.3, 4.6], rtol=1e-12)


def test_a_family_keeps_the_branch_of_the_case_as_written() -> None:
    """A Stephenson six-bar without an order of construction, its frame varied: `near` alone would have
    another branch where the sweep begins."""
    text = """icsolve: 1
points: {A: [0, 0], D: [6, 0], K: [2, -3]}
lengths: {AB: 2, BC: 3.9, BE: 2.4, CE: 2.5, CD: 3.6, EF: 5.5, FK: 3}
angles: {KF: 160}
near: {B: [0.5, 1.9], C: [4.3, 3.1], E: [2.3, 3.5], F: [-0.8, -2]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
  - {pin: [3, 5], at: E}
  - {pin: [5, 6], at: F}
  - {pin: [6, 1], at: K}
loads:
  T6: {torque: unknown, link: 6}
  P: {force: 10, link: 4, at: C, angle: 0}
"""
    case = icsolve.load(text)
    written = icsolve.solve(case)
    heights = [-3.8, -3.4, -3.0]
    sweep = icsolve.sweep(case, vary={"points.K.y": heights}, want=("answers", "points"))
    assert sweep.answers["T6"][2] == pytest.approx(written.answers["T6"].value, rel=1e-9)
    for name, places in sweep.points.items():
        step = np.abs(np.diff(places, axis=0)).max()
        assert step < 0.8, name
