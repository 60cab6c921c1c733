"""The witnesses themselves: against closed forms of the field, against each other, against 60 digits."""

from __future__ import annotations

import math
from itertools import combinations
from random import Random
from typing import Any

import pytest

import equilibrium
import mechanisms
import reference
import transcribe
import witness
from growth import random_mechanism
from loading import drawn
from sizes import sampled
from transcribe import Scene

CLOSE = 1e-12
"""Closed forms hold to rounding; twelve digits leave room for the SVD's condition."""


def pins(text: str) -> list[dict[str, Any]]:
    """`1-2@A 2-3@B` as pin joints."""
    pairs = (word.split("@") for word in text.split())
    return [{"pin": pair.split("-"), "at": at} for pair, at in pairs]


def rates(scene: Scene) -> dict[str, float | None]:
    """Angular velocities, scaled as the format says."""
    case = transcribe.case(scene)
    found = witness.speeds(case)
    return {n: found.rate(n) for n in case.links}


def answer(scene: Scene) -> float:
    """The one unknown, by virtual power; the free bodies must agree."""
    case = transcribe.case(scene)
    (value,) = witness.answers(reference.motions(case)).values()
    (other,) = equilibrium.answers(case).values()
    assert other == pytest.approx(value, rel=1e-9, abs=1e-9)
    return value


def mobility(scene: Scene) -> int:
    """Freedoms by rank."""
    return len(reference.motions(transcribe.case(scene)).basis)


FOUR_BAR: Scene = {
    "points": {"A": [0, 0], "B": [1, 2], "C": [5, 3], "D": [6, 0]},
    "joints": pins("1-2@A 2-3@B 3-4@C 4-1@D"),
}


# --- velocities ------------------------------------------------------------------------------------


def test_four_bar_velocity_ratios_by_the_sine_formula() -> None:
    """w3/w2 = -a sin(t4 - t2) / (b sin(t4 - t3)), w4/w2 = a sin(t2 - t3) / (c sin(t4 - t3)); Norton, 6.18."""
    a, b, c = complex(1, 2), complex(4, 1), complex(-1, 3)
    t2, t3, t4 = (math.atan2(z.imag, z.real) for z in (a, b, c))
    found = rates(FOUR_BAR)
    assert found["2"] == 1.0
    assert found["3"] == pytest.approx(abs(a) / abs(b) * math.sin(t4 - t2) / math.sin(t3 - t4), rel=CLOSE)
    assert found["4"] == pytest.approx(abs(a) / abs(c) * math.sin(t2 - t3) / math.sin(t4 - t3), rel=CLOSE)


@pytest.mark.parametrize("degrees", [10.0, 75.0, 200.0])
def test_slider_crank_piston_velocity(degrees: float) -> None:
    """v = -r w (sin t + r sin t cos t / sqrt(l^2 - r^2 sin^2 t)): r 1, l 3.5, w 20 rad/s."""
    r, rod, w = 1.0, 3.5, 20.0
    co, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    scene: Scene = {
        "points": {"A": [0, 0], "B": [r * co, r * s], "C": [r * co + math.sqrt(rod**2 - (r * s) ** 2), 0]},
        "joints": [*pins("1-2@A 2-3@B 3-4@C"), {"slide": [4, 1], "at": "C", "along": 0}],
        "motion": {"link": 2, "speed": w},
    }
    found = witness.speeds(transcribe.case(scene)).velocity("C", "4")
    expected = -r * w * (s + r * s * co / math.sqrt(rod**2 - (r * s) ** 2))
    assert found == pytest.approx((expected, 0), rel=CLOSE, abs=1e-12)


def test_quick_return_lever_by_the_projected_pin_velocity() -> None:
    """The lever takes the part of the crank pin's velocity across the slot: w3 = v sin(.) / DB."""
    scene: Scene = {
        "points": {"A": [0, 2], "D": [0, 0], "B": [math.sqrt(3) / 2, 2.5]},
        "joints": [*pins("1-2@A 3-1@D"), {"slot": [2, 3], "at": "B", "along": ["D", "B"]}],
    }
    across = (scene["points"]["B"][0] * (math.sqrt(3) / 2) + scene["points"]["B"][1] * 0.5) / 7.0
    assert rates(scene)["3"] == pytest.approx(across, rel=CLOSE)


def test_scotch_yoke_moves_harmonically() -> None:
    """x = r cos t, so v = -r sin t at w = 1; clockwise the other way."""
    r, t = 2.0, math.radians(50)
    scene: Scene = {
        "points": {"A": [0, 0], "B": [r * math.cos(t), r * math.sin(t)], "C": [4, 0]},
        "joints": [
            *pins("1-2@A"),
            {"slot": [2, 3], "at": "B", "along": 90},
            {"slide": [3, 1], "at": "C", "along": 0},
        ],
        "motion": {"link": 2, "turns": "cw"},
    }
    found = witness.speeds(transcribe.case(scene))
    assert found.velocity("C", "3") == pytest.approx((r * math.sin(t), 0), rel=CLOSE, abs=1e-12)
    assert found.rate("3") == pytest.approx(0, abs=1e-12)


def test_trammel_turns_about_the_corner() -> None:
    """The rod's centre is where the normals to both guides meet (Cardan circles)."""
    scene: Scene = {
        "points": {"A": [3, 0], "B": [0, 2]},
        "joints": [
            {"slide": [2, 1], "at": "A", "along": 0},
            *pins("2-3@A 3-4@B"),
            {"slide": [4, 1], "at": "B", "along": 90},
        ],
    }
    found = reference.motions(transcribe.case(scene))
    corner = witness.homogeneous(found.frame, {"at": [3, 2]})
    assert witness.sine(witness.centre(found, "1", "3"), corner) < CLOSE  # type: ignore[arg-type]
    assert rates(scene)["3"] == 1.0


def test_oldham_coupling_turns_evenly() -> None:
    scene = mechanisms.oldham(Random(3))
    assert rates(scene) == pytest.approx({"1": 0, "2": 1, "3": 1, "4": 1}, rel=CLOSE)


def test_nothing_turns_then_the_first_link_moves_at_unit_speed_to_the_right() -> None:
    scene: Scene = {
        "points": {"A": [0, 0], "B": [2, 1]},
        "joints": [
            {"slide": [2, 1], "at": "A", "along": 150},
            {"slide": [2, 3], "at": "B", "along": 90},
            {"slide": [3, 1], "at": "B", "along": 0},
        ],
    }
    found = witness.speeds(transcribe.case(scene))
    assert found.velocity("A", "2") == pytest.approx((math.cos(math.pi / 6), -0.5), rel=CLOSE)
    assert found.velocity("B", "3") == pytest.approx((math.cos(math.pi / 6), 0), rel=CLOSE, abs=1e-12)


# --- wheels ----------------------------------------------------------------------------------------


def test_epicyclic_train_with_the_annulus_held() -> None:
    """w_arm / w_sun = Ns / (Ns + Na); the planet by Willis on the sun mesh."""
    sun, planet = 20, 30
    ring = sun + 2 * planet
    scene: Scene = {
        "points": {"O": [0, 0], "P": [3, 4]},
        "joints": [
            *pins("1-3@O 1-2@O 2-4@P"),
            {"gears": [3, 4], "teeth": [sun, planet]},
            {"gears": [4, 1], "teeth": [planet, -ring]},
        ],
    }
    found = rates(scene)
    arm = sun / (sun + ring)
    assert found["3"] == 1.0
    assert found["2"] == pytest.approx(arm, rel=CLOSE)
    assert found["4"] == pytest.approx(arm - (1 - arm) * sun / planet, rel=CLOSE)


def test_planetary_of_mobility_2_shares_torques_by_teeth() -> None:
    """Simple train: T_sun : T_ring : T_arm = Ns : Na : -(Ns + Na), whatever the speeds (Willis)."""
    sun, planet = 24, 18
    ring = sun + 2 * planet
    scene: Scene = {
        "points": {"O": [1, 1], "P": [4, 2]},
        "joints": [
            *pins("1-2@O 1-3@O 1-5@O 2-4@P"),
            {"gears": [3, 4], "teeth": [sun, planet]},
            {"gears": [4, 5], "teeth": [planet, -ring]},
        ],
        "loads": {
            "S": {"torque": 10, "link": 3},
            "R": {"torque": "unknown", "link": 5},
            "A": {"torque": "unknown", "link": 2},
        },
    }
    case = transcribe.case(scene)
    expected = {"R": 10 * ring / sun, "A": -10 * (sun + ring) / sun}
    assert mobility(scene) == 2
    assert witness.answers(reference.motions(case)) == pytest.approx(expected, rel=CLOSE)
    assert equilibrium.answers(case) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(("crossed", "ratio"), [(False, 0.6), (True, -0.6)])
def test_belt_ratio(crossed: bool, ratio: float) -> None:
    scene: Scene = {
        "points": {"O": [0, 0], "A": [12, 5]},
        "joints": [*pins("1-2@O 1-3@A"), {"belt": [2, 3], "radii": [3, 5], "crossed": crossed}],
        "loads": {"T2": {"torque": 3, "link": 2}, "T3": {"torque": "unknown", "link": 3}},
    }
    assert rates(scene)["3"] == pytest.approx(ratio, rel=CLOSE)
    assert answer(scene) == pytest.approx(-3 / ratio, rel=1e-9)


def test_rolling_disk_and_rack() -> None:
    """A disk of radius 2 that rolls on the ground: its centre moves 2 to the left for a radian ccw."""
    disk: Scene = {
        "points": {"C": [1, 2], "P": [1, 0]},
        "joints": [{"roll": [2, 1], "at": "P"}],
        "links": {2: ["C"]},
    }
    assert witness.speeds(transcribe.case(disk)).velocity("C", "2") == pytest.approx((-2, 0), abs=CLOSE)
    rack: Scene = {
        "points": {"O": [0, 0], "P": [0, -1.5]},
        "joints": [*pins("1-2@O"), {"roll": [2, 3], "at": "P"}, {"slide": [3, 1], "at": "P", "along": 0}],
        "loads": {
            "T": {"torque": 6, "link": 2},
            "F": {"force": "unknown", "link": 3, "at": "P", "angle": 180},
        },
    }
    assert witness.speeds(transcribe.case(rack)).velocity("P", "3") == pytest.approx((1.5, 0), abs=CLOSE)
    assert answer(rack) == pytest.approx(4, rel=CLOSE)


def test_flat_follower_on_an_eccentric() -> None:
    """Lift e sin t, so v = e cos t; the torque that lifts a weight is W e cos t."""
    e, t = 0.5, math.radians(25)
    scene: Scene = {
        "points": {"O": [0, 0], "K": [e * math.cos(t), e * math.sin(t) + 2], "G": [0, 3]},
        "joints": [
            *pins("1-2@O"),
            {"contact": [2, 3], "at": "K", "normal": 90},
            {"slide": [3, 1], "at": "G", "along": 90},
        ],
        "loads": {"W": {"weight": 30, "link": 3, "at": "G"}, "T": {"torque": "unknown", "link": 2}},
    }
    assert witness.speeds(transcribe.case(scene)).velocity("G", "3") == pytest.approx(
        (0, e * math.cos(t)), abs=CLOSE
    )
    assert answer(scene) == pytest.approx(30 * e * math.cos(t), rel=CLOSE)


# --- mobility by rank (the count in brackets) ------------------------------------------------------

SQUARE: dict[str, list[float]] = {"A": [0, 0], "B": [0, 1], "C": [2, 1], "D": [2, 0]}


@pytest.mark.parametrize(
    ("points", "joints", "freedoms"),
    [
        pytest.param(SQUARE, pins("1-2@A 2-3@B 3-4@C 4-1@D"), 1, id="parallelogram (1)"),
        pytest.param(
            SQUARE | {"B": [1, 0], "C": [3, 0]}, pins("1-2@A 2-3@B 3-4@C 4-1@D"), 2, id="folded flat (1)"
        ),
        pytest.param(SQUARE, pins("1-2@A 2-3@B 3-1@C"), 0, id="triangle (0)"),
        pytest.param(
            SQUARE | {"E": [1, 0], "F": [1, 1]},
            pins("1-2@A 2-3@B 3-4@C 4-1@D 5-1@E 3-5@F"),
            1,
            id="three cranks (0)",
        ),
        pytest.param(SQUARE | {"E": [4, 4]}, pins("1-2@A 2-3@B 3-4@E 4-5@C 5-1@D"), 2, id="five-bar (2)"),
        pytest.param(
            {"A": [0, 0], "P": [1, 0], "D": [3, 0]}, pins("1-2@A 2-3@P 3-1@D"), 1, id="gears as a pin (0)"
        ),
    ],
)
def test_mobility(points: dict[str, Any], joints: list[dict[str, Any]], freedoms: int) -> None:
    case = transcribe.case({"points": points, "joints": joints})
    assert len(reference.motions(case).basis) == freedoms
    assert len(reference.motions(case, digits=reference.MANY).basis) == freedoms


# --- loads -----------------------------------------------------------------------------------------


def test_four_bar_torque_by_the_rate_ratio() -> None:
    """T2 w2 + T4 w4 = 0 with w4/w2 = 7/13."""
    loads = {"T4": {"torque": 1, "link": 4}, "T2": {"torque": "unknown", "link": 2}}
    assert answer(FOUR_BAR | {"loads": loads}) == pytest.approx(-7 / 13, rel=CLOSE)


def test_waldron_kinzel_13_2() -> None:
    """Chapter 13, problem 2: T12 = -835.2 N cm as printed, from figures with two decimals."""
    points = {
        "O": [0, 0],
        "A": [-4, 0],
        "B": [3.44, 6.61],
        "Q": [7.94, 0],
        "C": [9.158, 11.69],
        "D": [11.25, 5.73308],
    }
    loads = {
        "P": {"force": 100, "link": 3, "at": "C", "angle": 180},
        "Q": {"force": 200, "link": 4, "at": "D", "angle": 150},
        "T": {"torque": "unknown", "link": 2},
    }
    scene = {"points": points, "joints": pins("1-2@O 2-3@A 3-4@B 4-1@Q"), "loads": loads}
    assert answer(scene) == pytest.approx(-835.2, abs=0.05)


def test_grips_that_are_alike_bite_by_the_lever_ratio() -> None:
    """Pliers: both hands press 40 at arms of 10, so the jaws press back 40 * 10 / 2 each."""
    points = {"O": [0, 0], "H": [-10, 1], "K": [-10, -1], "J": [2, 0]}
    loads = {
        "H": {"force": 40, "link": 2, "at": "H", "angle": -90},
        "K": {"force": {"like": "H"}, "link": 3, "at": "K", "angle": 90},
        "J": {"force": "unknown", "link": 2, "at": "J", "angle": -90, "against": 3},
    }
    case = transcribe.case({"points": points, "joints": pins("2-3@O 1-2@O"), "loads": loads})
    assert witness.answers(reference.motions(case)) == pytest.approx({"J": 200}, rel=CLOSE)


def test_every_kind_of_load_on_one_lever() -> None:
    """A lever along x about O, moments by hand: 2*9.81*1, 30*2, spring 100*(1.5-0.5)*3, (5, 7) at x = 2."""
    loads = {
        "M": {"mass": "2 kg", "link": 2, "at": [1, 0]},
        "W": {"weight": 30, "link": 2, "at": [2, 0]},
        "S": {"spring": 100, "free": 0.5, "link": 2, "at": "B", "to": "C"},
        "V": {"force": [5, 7], "link": 2, "at": [2, 0]},
        "F": {"force": 4, "link": 2, "at": "B", "slope": [3, 4]},
        "A": {"force": 6, "link": 2, "at": "B", "away": "C"},
        "T": {"torque": "unknown", "link": 2, "turns": "cw"},
    }
    scene = {"points": {"O": [0, 0], "B": [3, 0], "C": [3, 1.5]}, "joints": pins("1-2@O"), "loads": loads}
    assert answer(scene) == pytest.approx(-2 * 9.81 - 60 + 300 + 14 + 3 * 4 * 0.8 - 18, rel=CLOSE)


# --- the witnesses against each other --------------------------------------------------------------


def agree(scene: Scene) -> None:
    """Power by SVD, power in 60 digits, and free bodies."""
    case = transcribe.case(scene)
    exact = witness.answers(reference.motions(case, digits=reference.MANY))
    assert witness.answers(reference.motions(case)) == pytest.approx(exact, rel=1e-10)
    assert equilibrium.answers(case) == pytest.approx(exact, rel=1e-9)


@sampled(2)
@pytest.mark.parametrize("generator", mechanisms.ALL, ids=lambda g: g.__name__)
def test_power_and_free_bodies_agree(generator: mechanisms.Generator) -> None:
    for seed in range(3):
        agree(drawn(seed, generator))


@sampled(4)
@pytest.mark.parametrize("block", range(4))
def test_power_and_free_bodies_agree_on_random_mechanisms(block: int) -> None:
    for seed in range(25 * block, 25 * block + 25):
        agree(random_mechanism(Random(seed)))


@pytest.mark.parametrize("generator", [mechanisms.butterfly, mechanisms.flier], ids=lambda g: g.__name__)
def test_centres_of_the_eight_bars_keep_kennedys_theorem(generator: mechanisms.Generator) -> None:
    """Each of the 56 triples of links has its three centres on a line, to 40 of 60 digits."""
    case = transcribe.case(drawn(1, generator))
    found = reference.motions(case, digits=reference.MANY)
    centre = {pair: witness.centre(found, *pair) for pair in combinations(case.links, 2)}
    for i, j, k in combinations(case.links, 3):
        a, b, c = centre[i, j], centre[j, k], centre[i, k]
        line = tuple(a[p] * b[q] - a[q] * b[p] for p, q in ((1, 2), (2, 0), (0, 1)))  # type: ignore[operator]
        assert abs(sum(x * y for x, y in zip(line, c, strict=True))) < 1e-40
