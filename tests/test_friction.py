"""Friction: closed forms of the textbooks, limits and symmetries, and brute force over all senses.

Closed forms hold to 1e-12 relative (a few roundings); against brute force, which follows Newton's method in
least squares, the answers hold to 1e-9.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from random import Random
from typing import Any

import numpy as np
import pytest

import icsolve
import rubbing
import transcribe
from growth import random_mechanism
from icsolve.answer import Answer, Found
from icsolve.explain import explain
from icsolve.numbers.linear import solve_square
from icsolve.statics.friction import solutions as homotopy
from icsolve.statics.friction.equations import (
    Lengths,
    fixed_point,
    misfits,
    newton,
    scale_at,
    without_friction,
)
from icsolve.statics.friction.equations import (
    slopes as jacobian,
)
from reference import frame_of, motions, points_of
from sizes import FULL, MORE, sampled

EXACT = 1e-12
LAW = 1e-9


def solved(text: str, **options: Any) -> Answer:
    """The answer to a case without its first line."""
    return icsolve.solve(icsolve.load("icsolve: 1\n" + text), **options)


def value(text: str, load: str) -> float:
    return solved(text).answers[load].value


def held(text: str, load: str) -> Found:
    found = solved(text).answers[load]
    assert found.holds is not None
    return found


def refused(text: str) -> icsolve.SceneError:
    with pytest.raises(icsolve.SceneError) as caught:
        solved(text)
    return caught.value


def exactly(number: float) -> Any:
    return pytest.approx(number, rel=EXACT, abs=EXACT)


# --- closed forms ----------------------------------------------------------------------------------


@pytest.mark.parametrize("height", [0.5, 1.1, 1.5, 2.0])
@pytest.mark.parametrize("mu", [0.3, 0.5])
def test_a_crate_slides_or_tips_whichever_comes_first(height: float, mu: float) -> None:
    """J. L. Meriam, Statics, ch. 6: pushed at a height h it slides at mu W, or tips at W b / 2h."""
    answer = solved(f"""
points: {{A: [0, 0], B: [1, 0], G: [0.5, 0.8], H: [0, {height}]}}
joints:
  - {{contact: [1, 2], at: A, normal: 90, mu: {mu}}}
  - {{contact: [1, 2], at: B, normal: 90, mu: {mu}}}
loads:
  W: {{weight: 300, link: 2, at: G}}
  P: {{force: unknown, link: 2, at: H, angle: 0}}
""")
    slides, tips = 300 * mu, 150 / height
    found = answer.answers["P"]
    assert found.holds == pytest.approx((-min(slides, tips), min(slides, tips)), rel=1e-9)
    assert any("tip or lift off" in note for note in answer.notes) is (tips < slides)
    assert found.error is not None
    assert found.error <= 2.0 * math.ulp(found.holds[1])


@pytest.mark.parametrize("slippery", ["", ", mu: 0", ", mu: 1e-9", ", mu: 0.2"])
def test_a_corner_that_slides_on_oil_lifts_as_any_other(slippery: str) -> None:
    """Pushed at 1.2 its sides a block presses with 150 - 1.2 P and 150 + 1.2 P on its corners: to the left it
    tips at 125, which is before it would slide."""
    answer = solved(f"""
points: {{A: [0, 0], B: [1, 0], G: [0.5, 0.5], H: [1, 1.2]}}
joints:
  - {{contact: [1, 2], at: A, normal: 90, mu: 0.7}}
  - {{contact: [1, 2], at: B, normal: 90{slippery}}}
loads:
  W: {{weight: 300, link: 2, at: G}}
  P: {{force: unknown, link: 2, at: H, angle: 0}}
""")
    other = 0.2 if "0.2" in slippery else 0.0
    slides = 150 * (0.7 + other) / (1 + 1.2 * (0.7 - other))
    found = answer.answers["P"]
    assert found.holds == pytest.approx((-125.0, slides), rel=1e-8)
    assert any("P = -125 a contact would have to pull" in note for note in answer.notes)
    rows = icsolve.sweep(answer.case, {"loads.W": [300.0, 600.0]}, ("answers", "status"))
    assert rows.holds["P"] == pytest.approx(np.outer([1.0, 2.0], found.holds), rel=1e-8)


def incline(alpha: float, mu: float, motion: str = "") -> str:
    """A block of weight 100 on an incline, pushed along the horizontal."""
    return f"""
points: {{A: [0, 0]}}
joints:
  - {{slide: [2, 1], at: A, along: {alpha}, mu: {mu}}}
loads:
  W: {{weight: 100, link: 2, at: A}}
  P: {{force: unknown, link: 2, at: A, angle: 0}}
{motion}
"""


@pytest.mark.parametrize("alpha", [5.0, 20.0, 40.0])
@pytest.mark.parametrize("mu", [0.05, 0.3])
def test_block_on_an_incline_is_a_screw_unrolled(alpha: float, mu: float) -> None:
    """P = W tan(alpha + phi) to raise, W tan(alpha - phi) to lower (square-threaded screw)."""
    a, phi = math.radians(alpha), math.atan(mu)
    up = f"motion: {{point: A, link: 2, speed: 1, angle: {alpha}}}"
    down = f"motion: {{point: A, link: 2, speed: 1, angle: {alpha + 180}}}"
    raising, lowering = 100 * math.tan(a + phi), 100 * math.tan(a - phi)
    assert value(incline(alpha, mu, up), "P") == exactly(raising)
    assert value(incline(alpha, mu, down), "P") == exactly(lowering)
    found = held(incline(alpha, mu), "P")
    assert found.holds == (exactly(lowering), exactly(raising))
    assert found.self_locking == (phi > a)
    answer = solved(incline(alpha, mu, up))
    assert answer.friction is not None
    assert answer.friction.efficiency == exactly(math.tan(a) / math.tan(a + phi))


@pytest.mark.parametrize(("angle", "sign"), [(0, -1), (180, 1)])
def test_a_block_that_no_push_moves_up_is_locked_by_a_strong_pull_too(angle: int, sign: int) -> None:
    """On the guide's other side it slides down until P = W (sin a + mu cos a) / (mu sin a - cos a)."""
    a = math.radians(50)
    pull = 100 * (math.sin(a) + 1.2 * math.cos(a)) / (1.2 * math.sin(a) - math.cos(a))
    text = incline(50, 1.2).replace("angle: 0", f"angle: {angle}")
    (said,) = (note for note in solved(text).notes if "it holds again" in note)
    assert said == f"beyond P = {sign * pull:.6g}, where it is about to move too, it holds again."


@pytest.mark.parametrize(("slope", "ends"), [("[4, 3]", (0.0, 60.0)), ("[-4, -3]", (-60.0, 0.0))])
def test_a_block_just_held_by_friction_is_self_locking(slope: str, ends: tuple[float, float]) -> None:
    """mu = tan alpha = 3/4: it holds with nothing, an end of the range, whichever way P is counted."""
    text = (
        "points: {A: [0, 0], B: [4, 3], C: [0.8, 0.6]}\n"
        "joints: [{slide: [2, 1], at: C, along: [A, B], mu: 0.75}]\n"
        "loads: {W: {weight: 50, link: 2, at: C}, "
        f"P: {{force: unknown, link: 2, at: C, slope: {slope}}}}}\n"
    )
    assert held(text, "P").holds == ends
    assert "self-locking: it holds still with P = 0." in solved(text).notes


def test_no_force_raises_a_block_where_the_incline_and_the_angle_of_friction_make_a_right_angle() -> None:
    up = "motion: {point: A, link: 2, speed: 1, angle: 50}"
    assert refused(incline(50, 1.2, up)).status == "jam"
    found = held(incline(50, 1.2), "P")
    assert found.holds == (exactly(100 * math.tan(math.radians(50) - math.atan(1.2))), math.inf)
    assert found.self_locking
    assert solved(incline(50, 1.2)).to_dict()["answers"]["P"]["holds"][1] is None
    for mu, holds in ((1.2, True), (1.0, False)):  # of 1.0 the angle is 45 degrees: it slides down
        said = [note for note in solved(incline(50, mu)).notes if note.startswith("self-locking")]
        assert said == ["self-locking: it holds still with P = 0."] * holds


def wedge(alpha: float, mu: float, motion: str = "") -> str:
    """A wedge on the floor that lifts a block along a wall; all three faces rub alike."""
    return f"""
points: {{A: [0, 0], B: [2, 1], K: [2, 0.5]}}
joints:
  - {{slide: [2, 1], at: A, along: 0, mu: {mu}}}
  - {{contact: [2, 3], at: K, normal: {90 - alpha}, mu: {mu}}}
  - {{slide: [3, 1], at: B, along: 90, mu: {mu}}}
loads:
  W: {{force: 100, link: 3, at: B, angle: 270}}
  P: {{force: unknown, link: 2, at: A, angle: 0}}
{motion}
"""


def wedging(alpha: float, mu: float, way: int) -> float:
    """The push on the wedge in impending motion; drawn out below phi, the block leans on the other wall."""
    a, phi = math.radians(alpha), math.atan(mu)
    if way < 0 and a < phi:
        return 100 * math.sin(a - 2 * phi) / math.cos(a)
    return 100 * math.tan(a + way * 2 * phi)


@pytest.mark.parametrize(("alpha", "mu"), [(10.0, 0.2), (25.0, 0.1), (11.3, 0.1), (11.5, 0.1)])
def test_wedge(alpha: float, mu: float) -> None:
    """P = W tan(alpha + 2 phi) to raise, W tan(alpha - 2 phi) to lower; 11.42 deg is 2 atan 0.1."""
    phi = math.atan(mu)
    right, left = (f"motion: {{point: A, link: 2, speed: 1, angle: {angle}}}" for angle in (0, 180))
    raising, lowering = wedging(alpha, mu, 1), wedging(alpha, mu, -1)
    assert value(wedge(alpha, mu, right), "P") == exactly(raising)
    assert value(wedge(alpha, mu, left), "P") == exactly(lowering)
    found = held(wedge(alpha, mu), "P")
    assert found.holds == (exactly(lowering), exactly(raising))
    assert found.self_locking == (2 * phi > math.radians(alpha))


def lever(motion: str = "", mu: float = 0.4) -> str:
    """A lever on a journal of radius 0.5: weight at 3 on the one side, force at 5 on the other."""
    return f"""
points: {{O: [0, 0], A: [-3, 0], B: [5, 0]}}
joints:
  - {{pin: [1, 2], at: O, mu: {mu}, radius: 0.5}}
loads:
  W: {{force: 80, link: 2, at: A, angle: 270}}
  P: {{force: unknown, link: 2, at: B, angle: 270}}
{motion}
"""


def test_friction_circle_of_one_journal() -> None:
    """P (b - r) = W (a + r) with r = 0.5 sin(atan 0.4), the force of the journal being P + W."""
    r = 0.5 * math.sin(math.atan(0.4))
    lifting, sinking = 80 * (3 + r) / (5 - r), 80 * (3 - r) / (5 + r)
    assert value(lever("motion: {link: 2, turns: cw}"), "P") == exactly(lifting)
    assert value(lever("motion: {link: 2, turns: ccw}"), "P") == exactly(sinking)
    assert held(lever(), "P").holds == (exactly(sinking), exactly(lifting))
    answer = solved(lever("motion: {link: 2, turns: cw}"), reactions=True)
    assert answer.reactions is not None
    force = answer.reactions["F12"]
    assert force.y == exactly(80 + lifting)
    assert abs(force.moment or 0.0) == exactly(r * (80 + lifting))


def slider_crank(motion: str, mu: float = 0.3, slide: str = "") -> str:
    return f"""
points: {{A: [0, 0], B: [1, 1.5], C: [6, 0]}}
joints:
  - {{pin: [1, 2], at: A, mu: {mu}, radius: 0.25}}
  - {{pin: [2, 3], at: B, mu: {mu}, radius: 0.3}}
  - {{pin: [3, 4], at: C, mu: {mu}, radius: 0.2}}
  - {{slide: [4, 1], at: C, along: 0{slide}}}
loads:
  P: {{force: 500, link: 4, at: C, angle: 180}}
  T: {{torque: unknown, link: 2}}
{motion}
"""


def test_slider_crank_with_three_friction_circles() -> None:
    """The coupler's force is tangent to two circles, the crank's to the third (graphical statics)."""
    s = math.sin(math.atan(0.3))
    beta, length = math.atan2(1.5, 5), math.hypot(5, 1.5)
    # the crank turns cw and drives: C moves right against P, and the coupler turns ccw
    for turns, rod, crank in (("cw", 1, -1), ("ccw", -1, 1)):
        tilt = beta + rod * math.asin((0.3 + 0.2) * s / length)
        force = 500 / math.cos(tilt)
        fx, fy = -force * math.cos(tilt), force * math.sin(tilt)  # of the rod on the crank at B
        torque = -(1 * fy - 1.5 * fx) - rod * 0.3 * s * force + crank * 0.25 * s * force
        assert value(slider_crank(f"motion: {{link: 2, turns: {turns}}}"), "T") == exactly(torque)


def drawer(length: float, motion: str = "motion: {point: C, link: 2, speed: 1, angle: 0}") -> str:
    """A drawer pulled off its middle: the couple is carried by the two ends of its guide."""
    return f"""
points: {{C: [0, 0], H: [0, 0.6]}}
joints:
  - {{slide: [2, 1], at: C, along: 0, mu: 0.4, length: {length}}}
loads:
  W: {{force: 10, link: 2, at: C, angle: 180}}
  P: {{force: unknown, link: 2, at: H, angle: 0}}
{motion}
"""


def test_drawer_rubs_at_both_ends_and_jams_when_it_is_short() -> None:
    """P = W / (1 - 2 mu e / l): no force opens it where l <= 2 mu e."""
    assert value(drawer(1.5), "P") == exactly(10 / (1 - 2 * 0.4 * 0.6 / 1.5))
    error = refused(drawer(0.47))
    assert error.status == "jam"
    assert "97.92 %" in str(error)  # 0.47 / (2 0.4 0.6)
    assert held(drawer(0.47, ""), "P").holds[1] == math.inf  # type: ignore[index]


def brake(c: float, turns: str, unknown: str) -> str:
    """A shoe on a lever against a drum of radius 2; the friction line passes the lever's pivot at c."""
    loads = {"P": "T: {torque: 60, link: 2}\n  P: {force: unknown, link: 3, at: H, angle: 270}"}
    loads["T"] = "P: {force: 50, link: 3, at: H, angle: 270}\n  T: {torque: unknown, link: 2}"
    return f"""
points: {{O: [0, 0], A: [-3, {2 + c}], K: [0, 2], H: [5, 2]}}
joints:
  - {{pin: [1, 2], at: O}}
  - {{pin: [1, 3], at: A}}
  - {{contact: [2, 3], at: K, normal: 90, mu: 0.35}}
loads:
  {loads[unknown]}
motion: {{link: 2, turns: {turns}}}
"""


def test_short_shoe_brake_by_its_actuating_force_which_does_no_work() -> None:
    """N = T / (mu r); P a = N (b +- mu c), with a = 8, b = 3: self-energising one way (Shigley)."""
    n = 60 / (0.35 * 2)
    # the drum turns ccw and drags the shoe to the left, which draws the lever in: its pivot is above
    assert value(brake(0.5, "ccw", "P"), "P") == exactly(n * (3 - 0.35 * 0.5) / 8)
    assert refused(brake(0.5, "cw", "P")).status == "no-value"
    assert value(brake(0.5, "ccw", "T"), "T") == exactly(0.35 * 2 * 50 * 8 / (3 - 0.35 * 0.5))
    assert value(brake(0.5, "cw", "T"), "T") == exactly(-0.35 * 2 * 50 * 8 / (3 + 0.35 * 0.5))


def test_a_crate_pushed_above_the_middle_slides_or_tips_and_never_jams() -> None:
    """Pushed at the height h it slides at mu W while mu h is less than half of its width, else it tips."""
    dice = Random(8)
    for _ in range(20):
        mu, wide, high = dice.randint(10, 90) / 100, dice.randint(3, 15) / 10, dice.randint(3, 20) / 10
        text = f"""points: {{A: [0, 0], B: [{wide}, 0], G: [{wide / 2}, 0.5], H: [0, {high}]}}
joints:
  - {{contact: [1, 2], at: A, normal: 90, mu: {mu}}}
  - {{contact: [1, 2], at: B, normal: 90, mu: {mu}}}
motion: {{point: G, link: 2, speed: 1, angle: 0}}
loads: {{W: {{weight: 500, link: 2, at: G}}, P: {{force: unknown, link: 2, at: H, angle: 0}}}}
"""
        if mu * high < 0.499 * wide:
            assert solved(text).answers["P"].value == pytest.approx(500 * mu, rel=EXACT)
        elif mu * high > 0.501 * wide:
            with pytest.raises(
                icsolve.SceneError, match="contact of links 1 and 2 at A ceases to push"
            ) as error:
                solved(text)
            assert error.value.status == "jam" and "jams" not in error.value.message


def test_self_locking_brake_jams() -> None:
    """Where mu c > b the shoe draws itself in: no torque turns the drum that way."""
    assert refused(brake(9.0, "ccw", "T")).status == "jam"
    assert value(brake(9.0, "cw", "T"), "T") == exactly(-0.35 * 2 * 50 * 8 / (3 + 0.35 * 9.0))


@pytest.mark.parametrize("mu", [0.25, 0.75, 5.0])
def test_force_that_presses_a_block_to_a_wall(mu: float) -> None:
    """It does no work; it holds the weight from W / mu up."""
    text = f"""
points: {{A: [0, 0]}}
joints:
  - {{slide: [2, 1], at: A, along: 90, mu: {mu}}}
loads:
  W: {{weight: 30, link: 2, at: A}}
  P: {{force: unknown, link: 2, at: A, angle: 0}}
"""
    found, least = held(text, "P"), 30 / mu
    assert found.holds == (exactly(least), math.inf)
    assert not found.self_locking
    assert any(f"beyond P = -{least:g}, where it is about to move" in note for note in solved(text).notes)
    down = "motion: {point: A, link: 2, speed: 1, angle: 270}\n"
    assert abs(value(text + down, "P")) == exactly(least)
    assert refused(text + down.replace("270", "90")).status == "no-value"


@pytest.mark.parametrize(("angle", "other"), [(-60, -1), (120, 1)])
@pytest.mark.parametrize("mu", [0.2, 0.35, 0.5])
def test_force_that_presses_a_block_to_either_side_of_its_slope(mu: float, angle: int, other: int) -> None:
    """Square to a guide at 30 degrees: mu N >= W sin 30 holds it, where N is P + W cos 30 on the flank below
    it, P - W cos 30 on the one above."""
    text = f"""
points: {{A: [0, 0]}}
joints:
  - {{slide: [2, 1], at: A, along: 30, mu: {mu}}}
loads:
  W: {{weight: 100, link: 2, at: A}}
  P: {{force: unknown, link: 2, at: A, angle: {angle}}}
"""
    least = 50.0 / mu + other * 50.0 * math.sqrt(3.0)
    assert held(text, "P").holds == (exactly(least), math.inf)


def test_of_two_ranges_the_one_of_the_larger_loads_is_told_however_the_wall_is_turned() -> None:
    """Pressed from either side it holds: at every whole degree W / mu is where the range begins."""
    for tilt in range(0, 180, 1 if FULL else 3):
        text = f"""
points: {{A: [0, 0]}}
joints:
  - {{slide: [2, 1], at: A, along: {tilt}, mu: 0.3}}
loads:
  W: {{force: 30, link: 2, at: A, angle: {tilt}}}
  P: {{force: unknown, link: 2, at: A, angle: {tilt + 90}}}
"""
        assert held(text, "P").holds == (exactly(100.0), math.inf), tilt


@pytest.mark.parametrize("down", [30, 90, -60])
@pytest.mark.parametrize(("mu", "nu"), [(0.3, 0.05), (0.27, 0.11), (0.06, 0.3)])
def test_force_that_presses_a_block_between_two_faces(mu: float, nu: float, down: int) -> None:
    """It holds what pushes the block where mu (F + V) + nu F >= W; V alone holds less than W, whichever way
    it presses, and so does F while it takes V off the lower face."""
    text = f"""
points: {{A: [0, 0], B: [0, 1]}}
joints:
  - {{slide: [2, 1], at: A, along: 0, mu: {mu}}}
  - {{slide: [2, 3], at: B, along: 0, mu: {nu}}}
  - {{slide: [3, 1], at: B, along: 90}}
loads:
  W: {{force: 100, link: 2, at: A, angle: 0}}
  V: {{force: {down}, link: 2, at: A, angle: -90}}
  F: {{force: unknown, link: 3, at: B, angle: -90}}
"""
    assert held(text, "F").holds == (exactly((100 - mu * down) / (mu + nu)), math.inf)
    other = -(100 + mu * down) / (mu + nu)
    assert any(f"beyond F = {other:.6g}, where it is about to move" in note for note in solved(text).notes)


@pytest.mark.parametrize(("rough", "said"), [("", "and no friction does"), (", mu: 0.3", "that it makes")])
def test_an_unknown_that_does_no_work_where_nothing_rubs_or_what_rubs_does_not_balance(
    rough: str, said: str
) -> None:
    """Two links glide on together: their pin does not turn, and P presses the smooth guide alone."""
    refusal = refused(f"""
points: {{A: [0, 0], B: [1, 0.5], C: [2, 1]}}
joints:
  - {{slide: [2, 1], at: A, along: 0}}
  - {{pin: [3, 2], at: B, mu: 0.2, radius: 0.1}}
  - {{slot: [3, 1], at: C, along: 0{rough}}}
motion: {{point: A, link: 2, speed: 1, angle: 0}}
loads:
  W: {{force: 10, link: 3, at: C, angle: 180}}
  P: {{force: unknown, link: 2, at: A, angle: 90}}
""")
    assert refusal.status == "no-value"
    assert said in refusal.message


def test_ladder_on_a_rough_floor_and_wall() -> None:
    """Push at the foot: N_B = (W/2 - mu N_B) cot(theta), P = N_B - mu (W - mu N_B) at the least."""
    theta, mu, w = math.radians(50), 0.2, 100.0
    x, y = 5 * math.cos(theta), 5 * math.sin(theta)
    text = f"""
points: {{A: [{-x}, 0], B: [0, {y}], G: [{-x / 2}, {y / 2}]}}
joints:
  - {{contact: [1, 2], at: A, normal: 90, mu: {mu}}}
  - {{contact: [1, 2], at: B, normal: 180, mu: {mu}}}
loads:
  W: {{weight: {w}, link: 2, at: G}}
  P: {{force: unknown, link: 2, at: A, angle: 0}}
"""
    cot = 1 / math.tan(theta)
    for sense, end in ((1, 0), (-1, 1)):
        m = sense * mu
        n = w / 2 * cot / (1 + m * cot)
        assert held(text, "P").holds[end] == exactly(n - m * (w - m * n))  # type: ignore[index]


# --- limits and symmetries -------------------------------------------------------------------------


def test_the_limit_of_little_friction_is_none() -> None:
    free = value(slider_crank("", mu=0.0), "T")
    for mu in (1e-3, 1e-6, 1e-9):
        for turns in ("cw", "ccw"):
            slow = value(slider_crank(f"motion: {{link: 2, turns: {turns}}}", mu, f", mu: {mu}"), "T")
            assert slow == pytest.approx(free, rel=2 * mu)
            assert slow != free


def test_turning_the_loads_and_the_motion_round_turns_the_answer_round() -> None:
    text = slider_crank("motion: {link: 2, turns: cw}", 0.3, ", mu: 0.3")
    back = text.replace("force: 500", "force: -500").replace("cw", "ccw")
    assert value(back, "T") == exactly(-value(text, "T"))


def test_the_range_at_rest_ends_at_the_two_motions() -> None:
    ends = [
        value(slider_crank(f"motion: {{link: 2, turns: {t}}}", 0.3, ", mu: 0.3"), "T") for t in ("cw", "ccw")
    ]
    assert held(slider_crank("", 0.3, ", mu: 0.3"), "T").holds == tuple(map(exactly, sorted(ends)))


def test_the_sum_of_power_is_zero_with_the_losses_counted() -> None:
    answer = solved(slider_crank("motion: {link: 2, turns: cw, speed: 3}", 0.3, ", mu: 0.3"))
    assert answer.friction is not None
    largest = max(abs(term.power) for term in answer.terms)
    assert sum(term.power for term in answer.terms) == pytest.approx(0.0, abs=EXACT * largest)
    assert sum(rub.loss for rub in answer.friction.rubbing) == exactly(answer.friction.losses)
    assert all(rub.loss > 0.0 for rub in answer.friction.rubbing)
    assert answer.friction.efficiency == exactly(1 - answer.friction.losses / _power_in(answer))
    assert answer.friction.residual < 1e-14
    assert answer.friction.error < 1e-13


def _power_in(answer: Answer) -> float:
    return sum(term.power for term in answer.terms if term.power > 0.0 and " " not in term.load)


def test_two_values_where_a_guide_can_press_from_either_side() -> None:
    """Drawn down an incline steeper than 90 - phi: W tan(alpha - phi), or hung from it W tan(alpha + phi)."""
    down = incline(50, 1.2, "motion: {point: A, link: 2, speed: 1, angle: 230}")
    answer, phi = solved(down), math.atan(1.2)
    assert answer.answers["P"].value == exactly(100 * math.tan(math.radians(50) - phi))
    other = 100 * math.tan(math.radians(50) + phi)
    assert any(f"other values of P too: {other:.6g}" in note for note in answer.notes)


def test_a_joint_that_is_at_rest_in_the_motion_does_not_rub() -> None:
    """With the crank square to the slide the coupler only translates: nothing turns at C."""
    text = """
points: {A: [0, 0], B: [0, 1], C: [3, 0]}
joints:
  - {pin: [1, 2], at: A, mu: 0.2, radius: 0.1}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C%s}
  - {slide: [4, 1], at: C, along: 0}
loads:
  P: {force: 10, link: 4, at: C, angle: 180}
  T: {torque: unknown, link: 2}
motion: {link: 2, turns: cw}
"""
    rough = solved(text % ", mu: 0.5, radius: 0.2")
    assert rough.answers["T"].value == value(text % "", "T")
    assert any("3-4 at C does not rub in this motion" in note for note in rough.notes)


TWO = """
points: {A: [0, 0], B: [5, 0]}
joints:
  - {slide: [2, 1], at: A, along: 20, mu: 0.3}
  - {slide: [3, 1], at: B, along: 35, mu: 0.1}
loads:
  W: {weight: 100, link: 2, at: A}
  V: {weight: 50, link: 3, at: B}
  P: {force: unknown, link: 2, at: A, angle: 0}
  Q: {force: unknown, link: 3, at: B, angle: 0}
"""


def test_two_degrees_of_freedom_need_two_motions() -> None:
    up, down = "{point: A, link: 2, speed: 1, angle: 20}", "{point: B, link: 3, speed: 1, angle: 215}"
    answer = solved(f"{TWO}motion: [{up}, {down}]\n")
    assert answer.answers["P"].value == exactly(100 * math.tan(math.radians(20) + math.atan(0.3)))
    assert answer.answers["Q"].value == exactly(50 * math.tan(math.radians(35) - math.atan(0.1)))
    assert refused(TWO).status == "mobility"
    assert "open" in str(refused(f"{TWO}motion: {up}\n"))


def test_friction_has_no_part_where_nothing_is_unknown() -> None:
    text = incline(20, 0.3).replace("unknown", "30")
    answer = solved(text)
    assert answer.rates == {"2": 0.0, "1": 0.0}
    assert answer.friction is None
    held = solved(text, reactions=True)
    assert held.friction is None and held.reactions is not None
    assert (held.reactions["F12"].x, held.reactions["F12"].y) == (exactly(-30), exactly(100))
    assert "leans by no more than the angle" in explain(held.case)


@pytest.mark.parametrize("motion", ["", "motion: {link: 3, turns: ccw}"])
def test_a_load_that_presses_a_brake_is_not_said_to_do_no_work(motion: str) -> None:
    """The shoe's lever stands still, and what friction takes hangs on the load on it."""
    answer = solved(f"""
points: {{A: [0, 0], B: [200, -50], O: [200, -200], H: [600, 0]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [1, 3], at: O}}
  - {{contact: [3, 2], at: B, normal: 90, mu: 0.35}}
{motion}
loads:
  P: {{force: 300, link: 2, at: H, angle: 270}}
  M: {{torque: unknown, link: 3}}
""")
    assert not any("stands still in this position" in note for note in answer.notes)


@sampled(4)
@pytest.mark.parametrize("seed", range(24 * MORE))
def test_a_brake_that_a_program_turned_presses_as_the_upright_one(seed: int) -> None:
    """The shoe's lever stands still but for the last digits of its 17: the load on it presses, and locks
    nothing. A figure that misses by more than that is as it is written."""
    dice = Random(f"turned {seed}")
    radius, mu = dice.randint(50, 300), dice.choice([0.1, 0.25, 0.4])
    places = {"O": (0, 0), "S": (0, radius), "A": (-dice.randint(100, 300), radius + dice.randint(-60, 60))}
    places["H"] = (dice.randint(100, 400), radius + dice.randint(-20, 60))
    drive, lean, more = dice.choice([-40, 40]), dice.randint(-40, 40), dice.choice([0, 20 * dice.random()])

    def told(turn: float, off: float = 0.0) -> tuple[Found, str]:
        cos, sin = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        at = {p: [x * cos - y * sin, x * sin + y * cos] for p, (x, y) in places.items()}
        at["S"][0] += off
        answer = solved(f"""
points: {at}
joints:
  - {{pin: [1, 2], at: O}}
  - {{pin: [1, 3], at: A}}
  - {{contact: [2, 3], at: S, normal: {90 + turn!r}, mu: {mu}}}
loads:
  F: {{force: unknown, link: 3, at: H, angle: {lean - 90 + turn!r}}}
  T: {{torque: {drive}, link: 2}}
  D: {{torque: {more!r}, link: 2}}
""")
        return answer.answers["F"], " ".join(answer.notes)

    turn = float(90 * dice.randint(0, 3) + dice.randint(1, 89))
    (upright, said), (turned, of_turned) = told(0.0), told(turn)
    assert "the harder it presses, the more it holds" in said
    assert not (upright.self_locking or turned.self_locking)
    assert turned.holds == pytest.approx(upright.holds, rel=1e-9)
    assert said in of_turned and ("only presses" in of_turned or said == of_turned)
    off, of_off = told(0.0, 1e-9)
    assert off.self_locking and "only presses" not in of_off


@pytest.mark.parametrize("reach", [0.1, 0.4, 0.7, 0.95])
def test_a_ladder_that_friction_holds_carries_what_equilibrium_says(reach: float) -> None:
    """A man a share of the way up a ladder of slope 2.4 on a smooth wall: the wall pushes by W reach / 2.4,
    as much as the floor rubs, less than half the weight up to the top. Against a rough wall equilibrium does
    not say how much of each friction acts, and on a floor with mu = 0.1 it slips under most of the way."""
    text = f"""
points: {{A: [0, 0], B: [5, 12], M: [{5 * reach}, {12 * reach}]}}
joints:
  - {{contact: [1, 2], at: A, normal: 90, mu: 0.5}}
  - {{contact: [1, 2], at: B, normal: 180}}
loads: {{W: {{weight: 180, link: 2, at: M}}}}
"""
    told = solved(text, reactions=True).reactions
    assert told is not None
    foot, top = told["F1-2@A"], told["F1-2@B"]
    assert (foot.x, foot.y, top.x) == (exactly(75 * reach), exactly(180), exactly(-75 * reach))
    assert dict(foot.parts)["friction"] == exactly(75 * reach)
    rough = solved(text.replace("180}", "180, mu: 0.3}"), reactions=True)
    assert rough.reactions is not None and rough.reactions["F1-2@A"].y is None
    assert any("equilibrium leaves 1 part of the reactions open" in note for note in rough.notes)
    if reach > 0.3:
        with pytest.raises(icsolve.SceneError, match="friction is not enough") as caught:
            solved(text.replace("0.5}", "0.1}"), reactions=True)
        assert caught.value.status == "unbalanced"


def test_reactions_of_loads_that_friction_does_not_hold_are_found_as_the_refusal_says() -> None:
    text = """
points: {A: [0, 0], B: [1.5, 1.3], C: [7.4, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B, mu: 0.2, radius: 0.2}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0, mu: 0.1}
loads:
  P: {force: 100, link: 4, at: C, angle: 180}
  T: {torque: 160, link: 2}
"""
    with pytest.raises(icsolve.SceneError, match=r"`unknown`, and give the `motion` that it keeps up\.$"):
        solved(text, reactions=True)
    both = solved(text.replace("160", "unknown") + "motion: {link: 2, turns: ccw}\n", reactions=True)
    assert both.reactions is not None and both.reactions["F12"].x is not None


def test_the_sense_of_a_passive_freedom_is_open() -> None:
    text = """
points: {A: [0, 0], C: [0, 3], K: [-0.6, 2.2]}
joints:
  - {pin: [1, 2], at: A}
  - {slide: [3, 1], at: C, along: 90}
  - {pin: [3, 4], at: C, mu: 0.2, radius: 0.1}
  - {contact: [2, 4], at: K, normal: 53.13010235415598}
loads:
  W: {weight: 10, link: 3, at: C}
  T: {torque: unknown, link: 2}
motion: {link: 2, turns: ccw}
"""
    assert "links 3 and 4 at C is open" in str(refused(text))
    assert solved(text.replace("mu: 0.2", "mu: 0")).answers["T"].value != 0.0


# --- brute force -----------------------------------------------------------------------------------


def check_against_brute_force(text: str, load: str) -> None:
    """Both motions against the one of all 2^k combinations that takes power everywhere."""
    for turns in ("cw", "ccw"):
        case = icsolve.load(f"icsolve: 1\n{text}motion: {{link: 2, turns: {turns}}}\n")
        points = points_of(case)
        theirs = rubbing.against_the_motion(case, points, rubbing.motion_sense(case, points))
        if theirs.unknowns is None:
            assert refused(f"{text}motion: {{link: 2, turns: {turns}}}\n").status == "jam"
            continue
        mine = icsolve.solve(case, reactions=True)
        assert mine.answers[load].value == pytest.approx(theirs.unknowns[load], rel=LAW)
        assert mine.friction is not None
        size = frame_of(case, points).size
        assert all(rub.loss >= 0.0 for rub in mine.friction.rubbing)
        sizes = [abs(rub.value) / (size if rub.kind == "pin" else 1.0) for rub in mine.friction.rubbing]
        assert sorted(sizes) == pytest.approx(sorted(map(abs, theirs.friction or ())), rel=LAW)


QUICK_RETURN = """
points: {O2: [0, 0], A: [0.8, 1.1], O4: [0, -2.5], B: [1.2, 2.9], C: [4, 3.1], D: [6, 3.1]}
joints:
  - {pin: [1, 2], at: O2, mu: 0.15, radius: 0.3}
  - {slot: [2, 3], at: A, along: [O4, A], mu: 0.25}
  - {pin: [1, 3], at: O4, mu: 0.15, radius: 0.3}
  - {pin: [3, 4], at: B, mu: 0.1, radius: 0.2}
  - {pin: [4, 5], at: C, mu: 0.1, radius: 0.2}
  - {slide: [5, 1], at: C, along: 0, mu: 0.2}
loads:
  F: {force: 300, link: 5, at: D, angle: 180}
  T: {torque: unknown, link: 2}
"""

BLOCK = """
points: {A: [0, 0], B: [1, 1.2], C: [4, 0], H: [4.5, 0.7]}
joints:
  - {pin: [1, 2], at: A, mu: 0.2, radius: 0.15}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C, mu: 0.2, radius: 0.15}
  - {slide: [4, 1], at: C, along: 0, mu: 0.3, length: 1.1}
loads:
  P: {force: 40, link: 4, at: H, angle: 190}
  T: {torque: unknown, link: 2}
"""

SIX_BAR = """
points:
  {A: [0, 0], B: [0.5, 1.4], C: [3.2, 2.4], D: [3.5, 0], E: [4.4, 2.9], F: [6.6, 2.2], G: [6.3, 0.2],
   H: [7, 3]}
joints:
  - {pin: [1, 2], at: A, mu: 0.25, radius: 0.2}
  - {pin: [2, 3], at: B, mu: 0.25, radius: 0.2}
  - {pin: [3, 4], at: C, mu: 0.2, radius: 0.2}
  - {pin: [4, 1], at: D, mu: 0.2, radius: 0.25}
  - {pin: [4, 5], at: E, mu: 0.15, radius: 0.2}
  - {pin: [5, 6], at: F, mu: 0.15, radius: 0.2}
  - {pin: [6, 1], at: G, mu: 0.25, radius: 0.25}
loads:
  F: {force: 200, link: 6, at: H, angle: 170}
  W: {weight: 30, link: 5, at: F}
  T: {torque: unknown, link: 2}
"""


@sampled(2)
@pytest.mark.parametrize("text", [QUICK_RETURN, BLOCK, SIX_BAR], ids=["quick return", "block", "six-bar"])
def test_of_all_senses_the_one_that_the_rates_give(text: str) -> None:
    check_against_brute_force(text, "T")


@sampled(2)
@pytest.mark.parametrize("mu", [0.1, 0.17, 0.18, 0.3])
def test_wedge_near_self_locking_by_brute_force(mu: float) -> None:
    """A lever drives a wedge of 20 degrees, whose angle of friction goes through 10."""
    text = f"""
points: {{O: [-3, 0], L: [-3, 1], A: [0, 1], B: [2, 2], K: [2, 1.5]}}
joints:
  - {{pin: [1, 2], at: O}}
  - {{slot: [4, 2], at: L, along: 90}}
  - {{slide: [4, 1], at: A, along: 0, through: A, mu: {mu}}}
  - {{contact: [4, 3], at: K, normal: 70, mu: {mu}}}
  - {{slide: [3, 1], at: B, along: 90, mu: {mu}}}
loads:
  W: {{force: 100, link: 3, at: B, angle: 270}}
  T: {{torque: unknown, link: 2, turns: cw}}
"""
    check_against_brute_force(text, "T")
    assert held(text, "T").holds == tuple(exactly(wedging(20, mu, way)) for way in (-1, 1))


def turning(case: Any) -> str | None:
    """A link that turns in the one motion of a mechanism; None where there is none."""
    (motion,) = motions(case, points_of(case)).basis
    fastest = max(abs(float(part)) for twist in motion.values() for part in twist)
    return next((q for q in case.links if abs(float(motion[q][2])) > 1e-3 * fastest), None)


def check_random(seed: int) -> str:
    """A random mechanism with four rubs: both motions against brute force, and the range at rest."""
    rng = Random(seed)
    text = transcribe.text(rubbing.roughened(rng, random_mechanism(rng), 4))
    case = icsolve.load(text)
    points, driven = points_of(case), turning(case)
    if driven is None:
        return "nothing turns"
    ends = []
    for turns in ("ccw", "cw"):
        case = icsolve.load(f"{text}motion: {{link: {driven}, turns: {turns}}}\n")
        try:
            mine = icsolve.solve(case, reactions=True)
        except icsolve.SceneError as error:
            if error.status != "jam":
                return error.status
            ends.append(math.inf)
            continue
        if any("does not rub" in note for note in mine.notes):
            return "at rest"
        if any("is lost" in note for note in mine.notes):
            return "parts"  # at rest a contact does not pull
        theirs = rubbing.against_the_motion(case, points, rubbing.motion_sense(case, points), every=False)
        assert theirs.unknowns is not None, text
        assert mine.answers["U"].value == pytest.approx(theirs.unknowns["U"], rel=1e-8), text
        check_laws(mine)
        ends.append(mine.answers["U"].value)
    try:
        rest = icsolve.solve(icsolve.load(text))
        free = icsolve.solve(icsolve.load(text.replace("mu: 0.", "mu: 0.0000000000000"))).answers["U"].holds
    except icsolve.SceneError as error:
        return "parts" if "is lost" in error.message else error.status
    if any("have to pull" in note for note in rest.notes):
        return "parts"  # before it moves
    least, most = rest.answers["U"].holds or (0.0, 0.0)
    finite = sorted(end for end in ends if math.isfinite(end))
    if len(finite) == 2 and finite[1] - finite[0] <= 1e-9 * abs(finite[0]):
        assert least - 1e-9 * abs(least) <= finite[0] <= most + 1e-9 * abs(most), text
        return "nothing presses"  # but at other loads: there friction may lock it
    assert [end for end in (least, most) if math.isfinite(end)] == pytest.approx(finite, rel=1e-9), text
    assert free is not None and least <= sum(free) / 2 <= most, text
    return "jams" if len(finite) < 2 else "checked"


def check_laws(answer: Answer) -> None:
    """Friction takes power everywhere, the sum of power is zero, and no more comes out than goes in."""
    assert answer.friction is not None
    largest = max(abs(term.power) for term in answer.terms)
    assert abs(sum(term.power for term in answer.terms)) <= 1e-9 * largest
    assert all(rub.loss >= 0.0 for rub in answer.friction.rubbing)
    assert all(abs(rub.value) <= rub.limit * (1 + 1e-12) for rub in answer.friction.rubbing)
    assert answer.friction.residual < 1e-11
    if answer.friction.efficiency is not None:
        assert -1e-12 <= answer.friction.efficiency <= 1 + 1e-12
    (w,) = answer.witnesses
    assert abs(w.difference) <= w.bound


def test_random_mechanisms_by_brute_force() -> None:
    found = [check_random(seed) for seed in range(900, 900 + (320 if FULL else 8))]
    assert found.count("checked") >= len(found) // 5
    assert set(found) <= {
        "checked",
        "jams",
        "at rest",
        "parts",
        "nothing turns",
        "unsupported",
        "nothing presses",
    }


@pytest.mark.parametrize("turned", [0, 90, 180, 270])
def test_a_rod_pulls_or_pushes_a_block_that_is_held_by_friction(turned: int) -> None:
    """Pressed with 100 at mu 0.2 and driven by 5: a crank holds it from -15 to 25, through no force too."""
    a, b, d = (1j ** (turned // 90) * place for place in (0, 2, 2 - 1j))
    found = held(
        f"""
points: {{A: [{a.real}, {a.imag}], B: [{b.real}, {b.imag}], D: [{d.real}, {d.imag}]}}
joints:
  - {{slide: [2, 1], at: A, along: {turned}, mu: 0.2}}
  - {{pin: [2, 3], at: A}}
  - {{pin: [3, 4], at: B}}
  - {{pin: [4, 1], at: D}}
loads:
  W: {{force: 100, link: 2, at: A, angle: {turned - 90}}}
  P: {{force: 5, link: 2, at: A, angle: {turned}}}
  T: {{torque: unknown, link: 4}}
""",
        "T",
    )
    assert found.holds == (exactly(-15), exactly(25))


def test_a_range_without_an_end_says_which_way_it_locks() -> None:
    """A short drawer can be let slide back, but no pull opens it."""
    answer = solved(drawer(0.47, motion=""))
    least, most = answer.answers["P"].holds or (0.0, 0.0)
    assert least == exactly(10 / (1 + 2 * 0.4 * 0.6 / 0.47))
    assert most == math.inf
    assert any("no value of P above the range moves it" in note for note in answer.notes)


def test_a_push_within_the_angle_of_friction_locks_both_ways() -> None:
    """Q + P cos(a) = mu |P sin(a)| with both signs of P: it holds below the one value, above the other."""
    answer = solved("""
points: {C: [0, 0]}
joints:
  - {slide: [2, 1], at: C, along: 0, mu: 0.5}
loads:
  P: {force: unknown, link: 2, at: C, angle: 280}
  Q: {force: 5, link: 2, at: C, angle: 0}
""")
    cosine, sine = math.cos(math.radians(80)), math.sin(math.radians(80))
    assert answer.answers["P"].holds == (-math.inf, exactly(-5 / (cosine + 0.5 * sine)))
    other = 5 / (0.5 * sine - cosine)
    assert any(f"beyond P = {other:.6g}, where it is about to move too" in note for note in answer.notes)


def test_friction_of_a_pulley_s_bearing_hangs_on_the_belt_s_tension() -> None:
    error = refused("""
points: {A: [0, 0], B: [10, 0]}
joints:
  - {pin: [1, 2], at: A, mu: 0.1, radius: 0.5}
  - {pin: [1, 3], at: B}
  - {belt: [2, 3], radii: [2, 3]}
loads:
  T2: {torque: 10, link: 2}
  T3: {torque: unknown, link: 3}
motion: {link: 2, turns: ccw}
""")
    assert error.status == "unsupported"
    assert "links 1 and 2 at A depends" in str(error)
    assert "initial tension of the belt" in str(error)


@pytest.mark.parametrize("at", ["A", "B", "C", "D"])
def test_a_joint_that_rubs_without_pressing_has_no_friction_and_strict_json(at: str) -> None:
    """Loads on the frame alone press nowhere: nothing bounds a relative error of what is zero."""
    joints = {"A": "{pin: [1, 2], at: A%s}", "B": "{pin: [2, 3], at: B%s}"}
    joints |= {"C": "{pin: [3, 4], at: C%s}", "D": "{pin: [4, 1], at: D%s}"}
    lines = (j % (", mu: 0.2, radius: 0.1" if n == at else "") for n, j in joints.items())
    answer = solved(f"""
points: {{A: [0, 0], B: [1, 2], C: [4, 3], D: [5, 0]}}
joints: [{", ".join(lines)}]
loads:
  U: {{force: unknown, link: 1, at: B, angle: 180}}
  K: {{force: 100, link: 1, at: C, angle: 0}}
motion: {{link: 2, speed: 10}}
""")
    assert answer.answers["U"].value == 0.0
    json.dumps(answer.to_dict(), allow_nan=False)


# --- all solutions, with bounded work ---------------------------------------------------------------


def rubs_in_parts(rng: Random) -> Lengths:
    """Two pins of one force told in two frames, a guide that two others press, a pin that all do."""

    def form(*needed: int) -> tuple[float, ...]:
        return (rng.uniform(-1, 1), *(rng.uniform(-3, 3) if j in needed else 0.0 for j in range(4)))

    x, y = form(0, 1, 2), form(0, 1, 2)
    turned = complex(math.cos(one := rng.uniform(0, 6)), math.sin(one))
    both = [complex(a, b) * turned for a, b in zip(x, y, strict=True)]
    again = (tuple(z.real for z in both), tuple(z.imag for z in both))
    return fixed_point(((x, y), again, (form(0, 1),), (form(0, 1, 2, 3), form(0, 3))), (False,) * 4)


def test_solutions_found_in_parts_are_those_of_the_whole() -> None:
    rng = Random(2)
    several = 0
    for _ in range(6 * MORE):
        equations = rubs_in_parts(rng)
        parts, (whole, _) = homotopy.all_roots(equations), homotopy.together(equations, homotopy.MOST_BOXES)
        assert parts is not None and whole is not None and len(parts) == len(whole)
        assert all(any(homotopy.near(y, other) for other in whole) for y in parts)
        several += len(parts) > 0
    assert several


@pytest.mark.parametrize("pins", [0, 1])
def test_forces_along_lines_are_found_by_linear_equations(pins: int) -> None:
    """The same as of pins whose forces happen to lie in one line, which are searched for; without a pin
    nothing is searched."""
    rng = Random(f"lines {pins}")
    several = 0
    for _ in range(10 * MORE):
        n = rng.choice((2, 3))
        forms = [tuple(rng.uniform(-1.5, 1.5) for _ in range(n + 1)) for _ in range(n + pins)]
        across = [(0.0,) * (n + 1)] * n + [forms.pop() for _ in range(pins)]
        told = [(form,) if k >= pins else (form, across[-1]) for k, form in enumerate(forms)]
        both = [(form, across[-1] if k < pins else across[k]) for k, form in enumerate(forms)]
        found, boxes = homotopy.together(fixed_point(told, (False,) * n), homotopy.MOST_BOXES)
        searched, _ = homotopy.together(fixed_point(both, (False,) * n), homotopy.MOST_BOXES)
        assert found is not None and searched is not None and len(found) == len(searched)
        assert all(any(homotopy.near(y, other) for other in searched) for y in found)
        assert (boxes == 0) == (pins == 0)
        several += len(found) > 1
    assert several


def test_a_contact_that_would_have_to_pull_is_no_solution() -> None:
    """y = |1 - 2 y|, z = |y|: 1/3 and 1, of which a contact has the one in which its force presses."""
    forms = [((1.0, -2.0, 0.0),), ((0.0, 1.0, 0.0),)]
    for pushes, expected in ((False, [1 / 3, 1.0]), (True, [1 / 3])):
        found, _ = homotopy.together(fixed_point(forms, (pushes, False)), homotopy.MOST_BOXES)
        assert sorted(y[0] for y in found or ()) == pytest.approx(expected, rel=1e-15)


def rubs_at_random(seed: int, number: int) -> Iterator[Lengths]:
    """One to three rubs whose forces hang on one another."""
    rng = Random(seed)

    def form(n: int) -> tuple[float, ...]:
        return (rng.uniform(-1, 1), *(rng.uniform(-1, 1) for _ in range(n)))

    for _ in range(number):
        n = rng.choice([1, 2, 3])
        yield fixed_point([(form(n), form(n)) for _ in range(n)], (False,) * n)


def test_a_solution_that_is_followed_is_one_of_full_friction() -> None:
    """Where there is none it says at which share of friction it ends, and whether the forces grow there."""
    ended = {True: 0, False: 0}
    for equations in rubs_at_random(5, 16):
        end, share, grows = homotopy.followed(equations)
        first = max(without_friction(equations))
        if end is not None:
            assert (share, grows) == (1.0, False)
            assert max(map(abs, misfits(equations, end))) <= 1e-11 * scale_at(equations, end)
            continue
        ended[grows] += 1
        before, _, _ = homotopy.followed(equations.scaled((1.0 - 1e-4) * share))
        assert before is not None and (max(before) > 1e3 * first) is grows
        assert homotopy.followed(equations.scaled((1.0 + 1e-4) * share))[0] is None
    assert all(ended.values())


def test_newton_ends_where_no_further_step_is_better() -> None:
    """At its end the misfit is a few roundings of the largest term, or the next step does not lessen it."""
    several = 0
    for equations in rubs_at_random(7, 60):
        found = newton(equations, without_friction(equations))
        if found is None:
            continue
        left = max(map(abs, misfits(equations, found)))
        step = solve_square(jacobian(equations, found), misfits(equations, found))
        if left <= 8 * 2.0**-52 * scale_at(equations, found) or step is None:
            continue
        several += 1
        then = [a - b for a, b in zip(found, step, strict=True)]
        assert max(map(abs, misfits(equations, then))) >= left, (several, left)


def test_the_change_with_friction_is_the_tangent_of_its_solutions() -> None:
    """Where u = share y, with u = share |v(u)|, is followed in homogeneous coordinates (z, w)."""
    for equations in rubs_at_random(6, 10):
        first, share, h = max(without_friction(equations)), 0.1, 1e-5
        whole = homotopy._homogeneous(equations, first)
        z: tuple[float, ...] = (*[0.0] * len(equations.lengths), 1.0)
        for k in range(1, 5):
            found = newton(homotopy._with(whole, z, k * share / 4), z)
            assert found is not None
            z = homotopy._normed(found)
        both = [newton(homotopy._with(whole, z, s), z) for s in (share - h, share + h)]
        change = homotopy._tangent(whole, z, share)
        assert change is not None
        assert None not in both
        slopes = [(b - a) / (2 * h) for a, b in zip(*both, strict=True)]
        assert change == pytest.approx(slopes, rel=1e-6, abs=1e-6 * max(map(abs, slopes)))
        y = [part * first / z[-1] / share for part in z[:-1]]
        scaled = equations.scaled(share)
        assert max(map(abs, misfits(scaled, y))) <= 1e-11 * scale_at(scaled, y)


def test_pins_of_an_unloaded_rod_are_one_unknown(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(homotopy, "MOST_RUBS", 2)
    rough = slider_crank("motion: {link: 2, turns: cw}", 40.0, ", mu: 0.2").replace(
        "radius: 0.3", "radius: 9"
    )
    assert "could be counted" not in str(refused(rough))


def test_too_long_a_search_leaves_open_whether_there_are_other_solutions(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    hard = fixed_point((((1.0, 2.0, 0.0), (0.0, 0.0, 1.0)), ((2.0, 1.0, 0.0), (1.0, 0.0, 3.0))), (False,) * 2)
    assert homotopy.all_roots(hard) is not None
    monkeypatch.setattr(homotopy, "MOST_BOXES", 3)
    assert homotopy.all_roots(hard) is None


def test_solutions_that_multiply_are_not_counted_for_long(monkeypatch: pytest.MonkeyPatch) -> None:
    """y_k = |2 y_k - 1| is met at 1/3 and at 1: of twelve that is 4096 times."""

    def alike(n: int) -> Lengths:
        rows = [(-1.0, *(2.0 * (j == k) for j in range(n))) for k in range(n)]
        return fixed_point([(row,) for row in rows], (False,) * n)

    assert len(homotopy.all_roots(alike(4)) or ()) == 16
    monkeypatch.setattr(homotopy, "MOST_BOXES", 10_000)
    assert homotopy.all_roots(alike(12)) is None


@sampled(3, "text")
@pytest.mark.parametrize("large", [10**k for k in range(7, 18, 2)])
@pytest.mark.parametrize("text", [QUICK_RETURN, SIX_BAR], ids=["quick return", "six-bar"])
def test_two_torques_against_each_other_change_nothing(text: str, large: int) -> None:
    """However large they are: power and free bodies are compared beside what both are summed from."""
    first, last = (f"  L{n}: {{torque: {one}, link: 2}}\n" for n, one in ((1, large), (2, -large)))
    plain, paired = (
        icsolve.solve(icsolve.load(f"icsolve: 1\n{one}motion: {{link: 2, turns: cw}}\n"))
        for one in (text, text.replace("loads:\n", f"loads:\n{first}") + last)
    )
    assert paired.answers["T"].value == pytest.approx(plain.answers["T"].value, rel=1e-12)


def test_of_two_rubs_one_of_which_cannot_hold_alone_the_clamped_one_holds_the_rest() -> None:
    """F = 50 pulls two blocks on a bar; one presses with W2 = 100, the other with W1 + P = 30 + P: mu (100 +
    abs(30 + P)) >= F holds from P = 120 up and, drawn against its guide's other side, below -180."""
    answer = icsolve.solve(
        icsolve.load("""
icsolve: 1
points: {A: [0, 0], B: [2, 0]}
joints:
  - {slide: [2, 1], at: A, along: 0, mu: 0.2}
  - {slide: [3, 1], at: B, along: 0, mu: 0.2}
  - {pin: [2, 4], at: A}
  - {pin: [4, 3], at: B}
loads:
  W1: {weight: 30, link: 2, at: A}
  W2: {weight: 100, link: 3, at: B}
  F: {force: 50, link: 2, at: A, angle: 0}
  P: {force: unknown, link: 2, at: A, angle: 270}
""")
    )
    assert answer.answers["P"].holds == (pytest.approx(120.0, rel=1e-12), math.inf)
    assert any("beyond P = -180" in note for note in answer.notes)
