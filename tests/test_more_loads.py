"""Torsion springs, pressures, forces per length, forces of unknown direction: against what they come to."""

from __future__ import annotations

import math
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest

import icsolve
import transcribe
from growth import random_mechanism
from icsolve.case import Case
from icsolve.errors import CaseError, SceneError
from loading import drawn
from mechanisms import heading, spot
from shell import exit_status
from sizes import FULL, sampled
from transcribe import Scene

PRESS = """\
icsolve: 1
title: Four-bar press
units: {units}
points: {{A: [0, 0], D: [4, 0]}}
lengths: {{AB: 1, BC: 3.5, CD: 2.5, DE: 1.5}}
angles: {{AB: 60, CDE: 0}}
near: {{C: [3.5, 2.4]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 1], at: D}}
loads:
  P: {load}
  T12: {torque}
"""
INCHES = "{length: in, force: lbf}"
DOWN = "{torque: unknown, link: 2}"


def press(load: str, torque: str = DOWN, units: str = INCHES) -> Case:
    """The press with another load on it."""
    return icsolve.load(PRESS.format(load=load, torque=torque, units=units))


def torque(load: str, units: str = INCHES) -> float:
    """What holds the crank against a load; by power, and by the equilibrium of the links alone."""
    answer = icsolve.solve(press(load, units=units), reactions=True)
    return answer.answers["T12"].value


ON_E = "link: 4, at: E, angle: 200"


@pytest.mark.parametrize(
    ("pressure", "units", "force"),
    [
        ("pressure: 100 psi, area: 2", INCHES, 200.0),
        ("pressure: 100, area: 2", INCHES, 200.0),
        ("pressure: 100 psi, bore: 2", INCHES, 100 * math.pi),
        ("pressure: 100 psi, bore: 2, rod: 1", INCHES, 75 * math.pi),
        ("pressure: 8 MPa, bore: 50 mm", "{length: m, force: N}", 8e6 * math.pi / 4 * 0.05**2),
        ("pressure: 8, bore: 50", "{length: mm, force: N}", 8 * math.pi / 4 * 50**2),
        ("pressure: 80 bar, area: 1963 mm^2", "{length: cm, force: kN}", 8e6 * 1963e-6 / 1e3),
        ("pressure: 8 N/mm^2, area: 1963 mm^2", "{length: mm, force: N}", 8 * 1963),
        ("pressure: 30 kPa, area: 2 m^2", "{length: m, force: N}", 60_000.0),
        ("pressure: 2 lbf/in^2, area: 1 ft^2", "{length: ft, force: lbf}", 288.0),
    ],
)
def test_a_pressure_is_a_force_of_its_area(pressure: str, units: str, force: float) -> None:
    alike = torque(f"{{force: {force!r}, {ON_E}}}", units)
    assert torque(f"{{{pressure}, {ON_E}}}", units) == pytest.approx(alike, rel=1e-13)


@pytest.mark.parametrize(
    ("units", "unit"),
    [
        ("{length: m, force: N}", "MPa"),
        ("{length: mm, force: N}", "MPa"),
        ("{length: in, force: lbf}", "psi"),
        ("{length: ft, force: lbf}", "psi"),
        ("{length: mm, force: kN}", "kN/mm^2"),
    ],
)
def test_an_unknown_pressure_is_answered_in_the_unit_of_its_trade(units: str, unit: str) -> None:
    known = press(f"{{pressure: 3 MPa, bore: 20 mm, {ON_E}}}", units=units)
    moment = icsolve.solve(known).answers["T12"].value
    text = PRESS.format(
        load=f"{{pressure: unknown, bore: 20 mm, {ON_E}}}",
        torque=f"{{torque: {moment!r}, link: 2}}",
        units=units,
    )
    found = icsolve.solve(icsolve.load(text)).answers["P"]
    assert found.unit == unit
    assert found.error is not None
    assert found.value == pytest.approx({"MPa": 3.0, "psi": 435.1132}.get(unit, 3e-3), rel=1e-6)


@pytest.mark.parametrize("angle", range(15, 360, 30))
def test_a_fluid_that_would_have_to_suck_is_told(angle: int) -> None:
    """A cylinder on a lever with a weight, in all directions: told where its pressure is negative, and only
    there; the rod's side, turned round, then carries the load and is told nothing."""
    text = """icsolve: 1
units: {{length: mm, force: N}}
points: {{A: [0, 0], B: [150, 60], C: [400, 0]}}
joints: [{{pin: [1, 2], at: A}}]
loads:
  W: {{weight: 700, link: 2, at: C}}
  p: {{pressure: unknown, bore: 50, {rod}link: 2, at: B, angle: {angle}}}
"""
    whole = icsolve.solve(icsolve.load(text.format(rod="", angle=angle)))
    back = icsolve.solve(icsolve.load(text.format(rod="rod: 20, ", angle=angle + 180)))
    told = [any("a fluid only pushes" in note for note in one.notes) for one in (whole, back)]
    assert told == [one.answers["p"].value < 0.0 for one in (whole, back)]
    assert sorted(told) == [False, True]


SWINGING = """icsolve: 1
points: {{A: [0, 0], B: [1.5, 0.6], C: [4, 0], S: [{x}, {y}]}}
joints: [{{pin: [1, 2], at: A{rubs}}}]
loads:
  W: {{force: 700, link: 2, at: C, angle: -90}}
  Q: {{{unknown}}}
"""
SWINGING_IN_SPACE = """icsolve: 1
points: {{A: [0, 0, 0], B: [1.5, 0.6, 0], C: [4, 0, 0], S: [{x}, {y}, 0]}}
joints: [{{hinge: [1, 2], at: A, axis: z}}]
gravity: [0, -9.81, 0]
loads:
  W: {{force: [0, -700, 0], link: 2, at: C}}
  Q: {{{unknown}}}
"""
NEVER_NEGATIVE = {
    "mass: unknown, link: 2, at: {at}": "no mass is",
    "spring: unknown, free: 2, link: 2, at: B, to: S": "no spring's stiffness is",
    "spring: unknown, corner: AB, free: {free}, link: 2": "no spring's stiffness is",
    "pressure: unknown, bore: 0.05, link: 2, at: B, angle: {free}": "a fluid only pushes",
}


@pytest.mark.parametrize("scene", ["plane", "rubs", "turns", "space"])
@pytest.mark.parametrize("unknown", NEVER_NEGATIVE)
def test_what_is_never_negative_and_is_found_to_be_is_told(unknown: str, scene: str) -> None:
    """Masses and stiffnesses, which no case may give as less than none, and pressures: with friction where
    the whole range is. A negative force or weight is one of the other sense, and is told nothing."""
    draw, told, words = Random(unknown + scene), set(), NEVER_NEGATIVE[unknown]
    if scene == "space" and ("corner" in unknown or "pressure" in unknown):
        pytest.skip("a load of the plane")
    for _ in range(12):
        load = unknown.format(at=draw.choice("CS"), free=draw.randrange(360))
        rubs = ", mu: 0.2, radius: 0.01" if scene in ("rubs", "turns") else ""
        x, y = draw.choice((-3.0, 3.0)), draw.choice((-4.0, 0.9, 4.0))
        text = (SWINGING_IN_SPACE if scene == "space" else SWINGING).format(x=x, y=y, rubs=rubs, unknown=load)
        text += "motion: {link: 2, turns: ccw}\n" if scene == "turns" else ""
        answer = icsolve.solve(icsolve.load(text))
        found = answer.answers["Q"]
        most = found.value if found.holds is None else found.holds[1]
        assert any(words in note for note in answer.notes) == (most < 0.0), text
        told.add(most < 0.0)
    assert told == {True, False}
    free = text.replace(
        load, "force: unknown, link: 2, at: B, " + ("along: y" if scene == "space" else "angle: -90")
    )
    assert not any("is negative" in note for note in icsolve.solve(icsolve.load(free)).notes)


@pytest.mark.parametrize(
    ("unknowns", "words"),
    [
        (["R"], "1 too many. R counts as two, its size and its direction: give it a direction"),
        (["R", "S"], "3 too many. R and S count as two each, size and direction: give each a direction"),
        (["R", "T"], "2 too many. R counts as two, its size and its direction: give it a direction"),
    ],
)
def test_a_force_of_unknown_direction_that_is_one_unknown_too_many_is_told_so(
    unknowns: list[str], words: str
) -> None:
    """It has no number that could be given, nor can it be like another."""
    forms = {
        "R": "R: {force: [unknown, unknown], link: 4, at: E}",
        "S": "S: {force: [unknown, unknown], link: 3, at: C}",
        "T": "T: {torque: unknown, link: 2}",
    }
    text = PRESS.format(
        units=INCHES, load="{force: 100, link: 4, at: E, angle: 180}", torque="{torque: 0, link: 2}"
    )
    text = text.replace("T12:", "M:")
    with pytest.raises(SceneError, match=words) as told:
        icsolve.solve(icsolve.load(text + "".join(f"  {forms[name]}\n" for name in unknowns)))
    assert told.value.status == "mobility"
    assert "as in `force: unknown, angle: 30`" in told.value.message
    assert ("a number" in told.value.message) == (len(unknowns) > 1)


def spread(first: float, last: float, n: int = 4000) -> float:
    """The torque against many small forces along CD: a force to the left has the arm y about D."""
    answer = icsolve.solve(press("{force: 1, link: 4, at: E, angle: 180}"))
    per_arm = answer.answers["T12"].value / answer.points["E"][1]
    share = (np.arange(n) + 0.5) / n
    sizes = (first + share * (last - first)) * 2.5 / n
    return float(np.sum(sizes * per_arm * answer.points["C"][1] * (1.0 - share)))


@pytest.mark.parametrize(("first", "last"), [(100, 100), (0, 100), (100, 0), (100, 40), (-30, 60), (-50, 50)])
def test_a_force_per_length_is_the_sum_of_small_ones(first: float, last: float) -> None:
    number = f"{first}" if first == last else f"[{first}, {last}]"
    found = torque(f"{{distributed: {number}, link: 4, from: C, to: D, angle: 180}}")
    assert found == pytest.approx(spread(first, last), rel=1e-5, abs=1e-5)


def test_an_unknown_force_per_length_and_one_like_it() -> None:
    text = "{distributed: unknown, link: 4, from: C, to: D, angle: 180}"
    moment = torque("{distributed: 12 lbf/ft, link: 4, from: C, to: D, angle: 180}")
    found = icsolve.solve(press(text, f"{{torque: {moment!r}, link: 2}}")).answers["P"]
    assert (found.value, found.unit) == (pytest.approx(1.0), "lbf/in")


LEVER = """icsolve: 1
points: {A: [0, 0], B: [3, 0], C: [1, 2]}
links: {2: [B, C]}
joints: [{pin: [1, 2], at: A}]
loads:
  Q: {distributed: NUMBER, link: 2, from: A, to: B, angle: -90}
  R: {distributed: {like: Q, times: 2}, link: 2, from: A, to: C, angle: -90}
  T: {torque: unknown, link: 2}
"""


def test_a_force_per_length_like_another_is_like_a_uniform_one_alone() -> None:
    """4 a length of 3 at 1.5, twice that along the root of 5 at 0.5; of two numbers neither is meant."""
    found = icsolve.solve(icsolve.load(LEVER.replace("NUMBER", "4"))).answers["T"].value
    assert found == pytest.approx(4 * 3 * 1.5 + 8 * math.sqrt(5) * 0.5, rel=1e-14)
    for ends in ("[0, 4]", "[4, 0]", "[4, 1]"):
        with pytest.raises(
            icsolve.CaseError, match="cannot be like Q, which has two numbers, one at each end"
        ):
            icsolve.load(LEVER.replace("NUMBER", ends))


@pytest.mark.parametrize(("known", "status"), [(3, "no-value"), (0, "any-value")])
@pytest.mark.parametrize("more", ["", "  V: {torque: {like: T, times: -0.5}, link: 2}\n"])
def test_an_unknown_that_loads_like_it_undo_is_told_so(known: int, status: str, more: str) -> None:
    times = -0.5 if more else -1
    loads = f"loads:\n  K: {{torque: {known}, link: 2}}\n  T: {{torque: unknown, link: 2}}\n"
    loads += f"  S: {{torque: {{like: T, times: {times}}}, link: 2}}\n{more}"
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.solve(icsolve.load(LEVER.partition("loads:")[0] + loads))
    assert refused.value.status == status
    who = "S and V, like it, undo here" if more else "S, like it, undoes here"
    assert f"what work T does {who}" in refused.value.message
    assert "stands still" not in refused.value.message and "does not turn" not in refused.value.message


@pytest.mark.parametrize(
    "second",
    [
        "torque: unknown, link: 2, turns: cw",
        "force: unknown, link: 2, at: B, angle: 0",
        "force: unknown, link: 3, at: C, away: B",
        "torque: {like: T1, times: 2}, link: 2}\n  U: {force: unknown, link: 2, at: B, angle: 70",
    ],
)
def test_two_unknowns_that_work_in_one_motion_are_told_so(second: str) -> None:
    """Two bars, both unknowns on the first of them: that turns, and neither of them is told not to work."""
    text = f"""icsolve: 1
points: {{A: [0, 0]}}
lengths: {{AB: 3, BC: 2}}
angles: {{AB: 60, BC: -20}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
loads:
  M: {{torque: 5, link: 3}}
  T1: {{torque: unknown, link: 2}}
  T2: {{{second}}}
"""
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.solve(icsolve.load(text))
    assert refused.value.status == "no-value"
    which = "T1 and U" if "U:" in text else "T1 and T2"
    assert f"no values of {which} balance: in one of the motions" in refused.value.message
    assert "does not turn" not in refused.value.message and "stands still" not in refused.value.message
    with pytest.raises(icsolve.SceneError) as refused:  # the second bar hangs on, and nothing acts on it
        icsolve.solve(icsolve.load(text.replace("  M: {torque: 5, link: 3}\n", "")))
    idle = "2 unknown loads for a mobility of 1 beside 1 freedom in which no load does work: 1 too many"
    assert refused.value.message.startswith(idle)


@pytest.mark.parametrize(
    "load", ["force: 5, at: B", "pressure: 5, area: 1, at: B", "distributed: 3, from: A, to: B"]
)
@pytest.mark.parametrize("way", ["toward: C", "away: C", "angle: 70", "slope: [1, 2]"])
def test_a_direction_that_turns_with_a_link_starts_as_it_is_written(load: str, way: str) -> None:
    """However it is given, T stays as it is on the link that bears it; without, one by two points follows
    these, and others stay (1e-13: rounding)."""
    text = f"""icsolve: 1
points: {{A: [0, 0], C: [2, 5]}}
lengths: {{AB: 2}}
angles: {{AB: 10}}
links: {{1: [C]}}
joints: [{{pin: [1, 2], at: A}}]
loads:
  F: {{{load}, link: 2, {way}, turns_with: 2}}
  T: {{torque: unknown, link: 2}}
"""
    for own in (text, text.replace(", turns_with: 2", "")):
        found = icsolve.sweep(icsolve.load(own), vary={"angles.AB": [10, 50, 200]}).answers["T"]
        assert found[0] == pytest.approx(icsolve.solve(icsolve.load(own)).answers["T"].value, rel=1e-13)
        assert np.allclose(found, found[0], rtol=1e-13) == (own is text)


BAR = """\
icsolve: 1
points: {{A: [0, 0]}}
lengths: {{AB: 2}}
angles: {{AB: {angle}}}
joints: [{{pin: [1, 2], at: A}}]
loads:
  S: {{spring: {stiffness}, corner: AB, free: 90, link: 2}}
  W: {{weight: {weight}, link: 2, at: B}}
"""


@pytest.mark.parametrize("angle", [30.0, 89.0, 95.0, 170.0, 250.0])
def test_a_torsion_spring_holds_a_bar_up(angle: float) -> None:
    """W l cos = k (free - angle), the difference taken within half a turn."""
    case = icsolve.load(BAR.format(angle=angle, stiffness=20, weight="unknown"))
    found = icsolve.solve(case).answers["W"]
    turned = math.radians((90.0 - angle + 180.0) % 360.0 - 180.0)
    assert found.value == pytest.approx(20 * turned / (2 * math.cos(math.radians(angle))), rel=1e-13)
    assert found.error is not None
    assert found.error < 1e-12 * abs(found.value)


@pytest.mark.parametrize(
    ("angle", "free"), [(-180, 0), (180, 0), (0, 180), (120, -60), (-60, 120), (240, 60)]
)
def test_a_torsion_spring_half_a_turn_from_free_is_wound_alike_everywhere(angle: int, free: int) -> None:
    """free - AB is 180 as written, not -180, in a scene, a sweep and an evaluator: it pushes link 2 ccw."""
    text = f"""icsolve: 1
points: {{A: [0, 0]}}
lengths: {{AB: 1}}
angles: {{AB: {angle}}}
joints: [{{pin: [1, 2], at: A}}]
loads:
  K: {{spring: 10 N*m/rad, corner: AB, free: {free}, link: 2}}
  T: {{torque: unknown, link: 2}}
"""
    case = icsolve.load(text)
    rows = icsolve.sweep(case, vary={"angles.AB": [angle, angle + 9.0]}).answers["T"].tolist()
    anew = icsolve.evaluator(case, inputs=("loads.K.free",))(np.array([float(free)])).answers["T"][0]
    found = [icsolve.solve(case).answers["T"].value, rows[0], anew, rows[1] - math.radians(90.0)]
    assert found == pytest.approx([-10.0 * math.pi] * 4, rel=1e-12)


def test_the_stiffness_of_a_torsion_spring_is_found_in_torque_per_rad() -> None:
    found = icsolve.solve(icsolve.load(BAR.format(angle=30, stiffness="unknown", weight=10))).answers["S"]
    assert found.unit == "N*m/rad"
    assert found.value == pytest.approx(20 * math.cos(math.pi / 6) / (math.pi / 3), rel=1e-13)
    assert found.sense == "ccw"


def test_a_torsion_spring_between_two_links_is_a_pair_of_torques() -> None:
    spring = "{spring: 20 lbf*in/deg, corner: BCD, free: 100, link: 4, against: 3}"
    points = icsolve.solve(press(spring)).points
    (bx, by), (cx, cy), (dx, dy) = (points[name] for name in "BCD")
    angle = math.degrees(math.atan2(dy - cy, dx - cx) - math.atan2(by - cy, bx - cx)) % 360.0
    pair = f"{{torque: {20 * (100 - angle)!r}, link: 4, against: 3}}"
    assert torque(spring) == pytest.approx(torque(pair), rel=1e-12)


@pytest.mark.parametrize(("link", "against", "corner"), [("4", "3", "BFD"), ("3", "4", "DFB")])
def test_the_corner_of_a_torsion_spring_goes_with_its_own_link(link: str, against: str, corner: str) -> None:
    """The vertex and the last point are points of the link that it pushes, the first of the other."""
    spring = f"{{spring: 20, corner: {corner}, free: 100, link: {link}, against: {against}}}"
    text = PRESS.format(load=spring, torque=DOWN, units=INCHES).replace("D: [4, 0]", "D: [4, 0], F: [3, 1]")
    rows = icsolve.sweep(icsolve.load(text), {"angles.AB": np.linspace(60.0, 90.0, 4)}, ("points",))
    for other in (corner[2], "C"):
        apart = np.hypot(*(rows.points["F"] - rows.points[other]).T)
        assert apart == pytest.approx(apart[0], rel=1e-12)


ARM = """\
icsolve: 1
points: {A: [0, 0]}
lengths: {AB: 1, BC: 1}
angles: {AB: 30, ABC: 130}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}]
loads:
  W2: {weight: 10, link: 2, at: B}
  W3: {weight: 4, link: 3, at: C}
  M: {torque: 5, link: 2}
  P: {force: [unknown, unknown], link: 3, at: C}
"""


def test_a_force_of_unknown_direction_has_size_direction_and_components() -> None:
    answer = icsolve.solve(icsolve.load(ARM))
    (found,) = answer.answers.values()
    (bx, by), (cx, cy) = answer.points["B"], answer.points["C"]
    # moments about B of link 3: P - W3 lies along BC; about A of both
    rows = [[-(cy - by), cx - bx], [-cy, cx]]
    px, py = np.linalg.solve(rows, [4 * (cx - bx), 4 * cx + 10 * bx - 5])
    assert found.components == pytest.approx((px, py), rel=1e-12)
    shown = answer.to_dict()["answers"]["P"]
    assert shown.keys() >= {"value", "direction", "x", "y", "unit", "error"}
    assert (shown["value"], shown["unit"]) == (pytest.approx(math.hypot(px, py)), "N")
    assert shown["direction"] == pytest.approx(math.degrees(math.atan2(py, px)) % 360.0)
    assert abs(shown["value"] - math.hypot(px, py)) <= shown["error"] + 1e-15


def test_the_error_of_a_size_is_some_ulps_whatever_the_size() -> None:
    relative = []
    for power in (-20, 0, 20):
        text = ARM
        for number in ("weight: 10", "weight: 4", "torque: 5"):
            kind, size = number.split()
            text = text.replace(number, f"{kind} {int(size) * 2.0**power!r}")
        (found,) = icsolve.solve(icsolve.load(text)).answers.values()
        assert found.error is not None
        relative.append(found.error / found.value)
    assert relative == pytest.approx([relative[0]] * 3, rel=1e-9)
    assert 0.0 < relative[0] < 2.0**-50


LOADS = {
    "pressure": f"{{pressure: 100 psi, bore: 2, rod: 1, {ON_E}}}",
    "per length": "{distributed: 20, link: 4, from: C, to: D, angle: 180}",
    "linear": "{distributed: [20, -50], link: 4, from: C, to: D, slope: [-1, 2], turns_with: 4}",
    "couple": "{distributed: [50, -50], link: 4, from: C, to: D, angle: 180}",
    "torsion spring": "{spring: 20, corner: ADC, free: 45, link: 4}",
    "torsion spring of two": "{spring: 20, corner: BCD, free: 100, link: 4, against: 3}",
}


@pytest.mark.parametrize("kind", LOADS)
def test_rows_are_scenes(kind: str) -> None:
    case = press(LOADS[kind])
    angles = [40.0, 60.0, 75.0, 130.0]
    if "turns_with" in LOADS[kind]:
        angles = [60.0]  # as written: the direction of a scene at another angle is another one
    rows = icsolve.sweep(case, vary={"angles.AB": angles}).answers["T12"]
    for angle, row in zip(angles, rows.tolist(), strict=True):
        text = PRESS.format(load=LOADS[kind], torque=DOWN, units=INCHES).replace("AB: 60", f"AB: {angle!r}")
        assert row == pytest.approx(icsolve.solve(icsolve.load(text)).answers["T12"].value, rel=1e-12)


@sampled(3, "kind", "verb")
@pytest.mark.parametrize("kind", [*LOADS, "direction"])
@pytest.mark.parametrize("verb", ["solve", "explain", "draw", "page", "check", "validate"])
def test_every_command_knows_it(
    kind: str, verb: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = ARM if kind == "direction" else PRESS.format(load=LOADS[kind], torque=DOWN, units=INCHES)
    (tmp_path / "case.yaml").write_text(text)
    assert exit_status(verb, str(tmp_path / "case.yaml")) == 0, capsys.readouterr().err


SLIPS = {
    "an unknown place": (
        "{force: 100, link: 4, at: unknown, angle: 30}",
        "a place is no unknown: give it as",
    ),
    "no area": (f"{{pressure: 8 MPa, {ON_E}}}", "needs its area: 'bore', the cylinder's diameter, or 'area'"),
    "bore and area": (f"{{pressure: 8 MPa, bore: 2, area: 3, {ON_E}}}", "has 'bore' and 'area'; give one"),
    "rod without a bore": (f"{{pressure: 8 MPa, area: 3, rod: 1, {ON_E}}}", "goes with a 'bore'"),
    "a thick rod": (f"{{pressure: 8 MPa, bore: 2, rod: 2, {ON_E}}}", "should be thinner than its bore"),
    "a pressure in newtons": (
        f"{{pressure: 8 N, bore: 2, {ON_E}}}",
        "'N' is a force, but a pressure is wanted",
    ),
    "an area in mm": (f"{{pressure: 8 MPa, area: 3 mm, {ON_E}}}", "'mm' is a length, but an area is wanted"),
    "a force per length at a point": (f"{{distributed: 8, {ON_E}}}", "'at'; it takes link, from, to"),
    "from a point to itself": (
        "{distributed: 8, link: 4, from: C, to: C, angle: 0}",
        "begins and ends at C",
    ),
    "a line load in newtons": (
        "{distributed: 8 N, link: 4, from: C, to: D, angle: 0}",
        "'N' is a force, but a force per length is wanted",
    ),
    "one component unknown": (
        "{force: [unknown, 5], link: 4, at: E}",
        "along a known line it is `force: unknown` with its direction, else [unknown, unknown]",
    ),
    "unknown components and an angle": (
        "{force: [unknown, unknown], link: 4, at: E, angle: 3}",
        "no 'angle'",
    ),
    "a torsion spring without its corner": ("{spring: 20 N*m/rad, free: 90, link: 4}", "needs 'at'"),
    "a torsion stiffness as a torque": (
        "{spring: 20 N*m, corner: BCD, free: 90, link: 4}",
        "'N*m' is a torque, but a stiffness of torsion (torque per angle) is wanted here",
    ),
    "a corner of one point": (
        "{spring: 20, corner: D, free: 90, link: 4}",
        "'D' should name two or three points",
    ),
    "a direction against a link": (
        "{spring: 20, corner: DC, free: 90, link: 4, against: 3}",
        "to another link it has three, as in ABC",
    ),
}


@pytest.mark.parametrize("slip", SLIPS)
def test_a_slip_is_told(slip: str) -> None:
    load, said = SLIPS[slip]
    with pytest.raises(CaseError) as refused:
        press(load)
    assert said in str(refused.value)


def test_a_free_angle_in_radians_is_asked_about() -> None:
    case = press("{spring: 20, corner: ADC, free: 1.5708, link: 4}")
    assert "if radians are meant, write 1.5708 rad" in " ".join(icsolve.solve(case).notes)


def test_an_end_of_a_linear_load_is_set_by_its_number() -> None:
    text = PRESS.format(load=LOADS["linear"], torque=DOWN, units=INCHES)
    set_to = icsolve.load(text, settings={"loads.P.1": 20.0})
    uniform = press(LOADS["linear"].replace("[20, -50]", "20"))
    there, here = (icsolve.solve(case).answers["T12"].value for case in (set_to, uniform))
    assert there == pytest.approx(here, rel=1e-13)
    with pytest.raises(CaseError, match=r"P has several numbers; vary loads\.P\.0 or loads\.P\.1"):
        icsolve.sweep(icsolve.load(text), vary={"loads.P": [1.0]})


@pytest.mark.parametrize("angle", [0.0, 30.0, 1e-9])
def test_a_spring_that_is_free_at_no_length_pulls_nothing_where_its_points_meet(angle: float) -> None:
    """T = 2 W cos u + 4 k sin(u - v), the spring of a crank of 2 fixed where its end is at v, 30 or 0."""
    fixed = "D: [2, 0]" if angle < 30.0 else "D: [1.7320508075688772, 1]"
    text = f"""icsolve: 1
points: {{A: [0, 0], {fixed}}}
lengths: {{AB: 2}}
angles: {{AB: {angle!r}}}
joints:
  - {{pin: [1, 2], at: A}}
loads:
  W: {{weight: 10, link: 2, at: B}}
  S: {{spring: 30 N/m, free: 0, link: 2, at: B, to: D}}
  T: {{torque: unknown, link: 2}}
"""
    found = icsolve.solve(icsolve.load(text), reactions=True).answers["T"]
    to = math.radians(0.0 if angle < 30.0 else 30.0)
    u = math.radians(angle)
    assert found.value == pytest.approx(20.0 * math.cos(u) + 120.0 * math.sin(u - to), abs=1e-12)
    row = icsolve.sweep(icsolve.load(text), vary={"angles.AB": [angle - 5.0, angle, angle + 5.0]})
    assert row.answers["T"][1] == pytest.approx(found.value, abs=1e-12)


def test_a_free_angle_in_radians_is_asked_about_where_nothing_balances() -> None:
    """An arm under its weight on a stiff spring, which would rest near a right angle."""
    text = """
icsolve: 1
units: {length: m, force: N}
points: {A: [0, 0]}
joints: [{pin: [1, 2], at: A}]
lengths: {AB: 2}
angles: {AB: {unknown: [0, 80]}}
loads:
  S: {spring: 200, corner: AB, free: 1.57, link: 2}
  W: {weight: 8, link: 2, at: B}
"""
    with pytest.raises(SceneError, match=r"if radians are meant, write 1.57 rad") as refused:
        icsolve.solve(icsolve.load(text))
    assert refused.value.status == "no-value"


LINE = """
icsolve: 1
units: {length: m, force: N}
points: {D: [0, 0], E: [3, 0]}
joints: [{pin: [1, 2], at: D}, {pin: [2, 3], at: A}, {pin: [3, 4], at: B}, {pin: [4, 1], at: E}]
lengths: {DA: 1, AB: 2.5, BE: 2, EC: 1, BC: 2}
angles: {DA: 60}
near: {B: [2.5, 2], C: [3.5, 1]}
loads:
  M: {torque: unknown, link: 2, turns: ccw}
  W: {distributed: 10 N/m, link: 2, from: A, to: END, angle: -90}
"""


def test_a_line_load_off_its_link_is_treated_as_a_force_there_is() -> None:
    """Refused at a point that dimensions fix to another link; at a joint of others it is said."""
    with pytest.raises(CaseError, match=r"11:\d+: load W acts on link 2 at C, which is a point of link 4"):
        icsolve.load(LINE.replace("END", "C"))
    notes = icsolve.solve(icsolve.load(LINE.replace("END", "B"))).notes
    assert "load W acts on link 2 at B, a joint of link 3" in " ".join(notes)


# --- random mechanisms of all joints --------------------------------------------------------------


def dressed(rng: Random, scene: Scene) -> tuple[Scene, ...]:
    """A scene with a pressure, a line load and two torsion springs more, and with what these come to."""
    links = [str(link) for link in transcribe.case(scene).links if str(link) != "1"]
    at: dict[str, Any] = scene["points"] | {f"X{k}": spot(rng) for k in range(3)}
    a, b, c = rng.sample(list(at), 3)
    link, other = rng.choice(links), rng.choice(links)
    bore, rod, pressure, along = rng.uniform(1, 2), rng.uniform(0, 0.9), rng.uniform(-50, 50), heading(rng)
    spans = ((-30, 30), (-30, 30), (1, 90), (-180, 180))
    first, last, stiffness, free = (round(rng.uniform(*span), 2) for span in spans)
    length = math.dist(at[a], at[b])
    heads = [math.degrees(math.atan2(at[q][1] - at[p][1], at[q][0] - at[p][0])) for p, q in ((b, c), (b, a))]
    on = {"link": link, "angle": along}

    def torque(angle: float) -> float:
        return stiffness * math.radians(180.0 - (180.0 - (free - angle)) % 360.0)

    def third(near: str, far: str) -> list[float]:
        return [(2.0 * p + q) / 3.0 for p, q in zip(at[near], at[far], strict=True)]

    new = {
        "Y": {"pressure": pressure, "bore": bore, "rod": rod, "at": a, **on},
        "Z": {"distributed": [first, last], "from": a, "to": b, **on},
        "R": {"spring": stiffness, "corner": f"{b}-{c}", "free": free, "link": link},
    }
    plain = {
        "Y": {"force": pressure * math.pi / 4.0 * (bore**2 - rod**2), "at": a, **on},
        "Z": {"force": first * length / 2.0, "at": third(a, b), **on},
        "Z2": {"force": last * length / 2.0, "at": third(b, a), **on},
        "R": {"torque": torque(heads[0]), "link": link},
    }
    if other != link:
        new["R2"] = new["R"] | {"corner": f"{a}-{b}-{c}", "against": other}
        plain["R2"] = {"torque": torque(heads[0] - heads[1]), "link": link, "against": other}
    loads = ({**scene["loads"], **more} for more in (new, plain))
    return tuple(scene | {"points": at, "loads": each} for each in loads)


def about_origin(reaction: dict[str, Any]) -> tuple[float | None, ...]:
    """Force and moment about the origin: of a weld without a point the couple is about a load."""
    x, y, moment = (v if isinstance(v := reaction.get(key), float) else None for key in ("x", "y", "moment"))
    if x is None or y is None or moment is None or reaction.get("at") is None:
        return x, y, None
    at = reaction["at"]
    return x, y, moment + at[0] * y - at[1] * x


@pytest.mark.parametrize("seed", range(2000 if FULL else 5))
def test_they_do_what_the_forces_they_come_to_do(seed: int) -> None:
    """Answers by power and by the free bodies, reactions, and rows: to 1e-9 of the largest force."""
    rng = Random(f"more loads {seed}")
    texts = [transcribe.text(scene) for scene in dressed(rng, drawn(seed, random_mechanism))]
    new, plain = (icsolve.solve(icsolve.load(text), reactions=True).to_dict() for text in texts)
    own, other = (answer["answers"]["U"]["value"] for answer in (new, plain))
    forces = [
        abs(float(one.get(k) or 0.0)) for one in plain["reactions"].values() for k in ("x", "y", "moment")
    ]
    size = max([abs(other), *forces, 1.0])
    assert own == pytest.approx(other, abs=1e-9 * size)
    for witness in new["free_bodies"].values():
        assert witness["power"] == pytest.approx(witness["bodies"], abs=1e-9 * size)
    for name, reaction in new["reactions"].items():
        own_wrench, wrench = about_origin(reaction), about_origin(plain["reactions"][name])
        if None not in (*own_wrench, *wrench):
            assert own_wrench == pytest.approx(wrench, abs=4e-9 * size)
    row = icsolve.sweep(icsolve.load(texts[0]), vary={"loads.R": [0.0, 7.0]}).answers["U"]
    there = icsolve.solve(icsolve.load(texts[0], settings={"loads.R": 7.0})).answers["U"].value
    assert row[1] == pytest.approx(there, abs=1e-9 * max(size, abs(there)))


@pytest.mark.parametrize("number", ["20", "[20, -50]"])
def test_along_a_line_without_a_length_nothing_acts(number: str) -> None:
    """A and C are one point; what is unknown there can hold nothing."""
    text = f"""icsolve: 1
points: {{A: [0, 0], D: [0, 4]}}
lengths: {{AB: 1, AC: 0}}
angles: {{AB: 20, AC: 30}}
joints: [{{pin: [1, 2], at: A}}]
loads:
  q: {{distributed: {number}, link: 2, from: A, to: C, angle: -90}}
  W: {{weight: 5, link: 2, at: B}}
  T: {{torque: unknown, link: 2}}
"""
    answer = icsolve.solve(icsolve.load(text))
    assert answer.answers["T"].value == pytest.approx(5 * math.cos(math.radians(20)), rel=1e-15)
    unknown = text.replace(f"distributed: {number}", "distributed: unknown").replace(
        "torque: unknown", "torque: 3"
    )
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.solve(icsolve.load(unknown))
    assert refused.value.status == "no-value"
