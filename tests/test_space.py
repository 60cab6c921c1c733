"""Statics in space: closed forms, gears, what is open, refusals; problems 13.21 to 13.24.

Closed forms bind to 1e-12 of themselves, published values to their printed digits.
"""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from icsolve import Answer, load, solve
from icsolve.answer.bodies import SpatialReaction
from icsolve.errors import CaseError, SceneError
from icsolve.explain import explain
from icsolve.page import page_html
from icsolve.report import answer_text
from icsolve.report.check import AGREES, compare
from icsolve.report.derivation.known import known_of
from shell import exit_status

CHAPTER = Path(__file__).parent.parent / "cases" / "ch13"


def reaction(answer: Answer, name: str) -> SpatialReaction:
    """A reaction by its name, either way round."""
    assert answer.spatial is not None
    return answer.spatial.reactions[name]


def digits(text: str) -> object:
    """What rounds to the text: within half a unit of its last digit."""
    decimals = len(text.partition(".")[2])
    return pytest.approx(float(text), rel=0, abs=0.5 * 10.0**-decimals)


def close(*values: float) -> object:
    return pytest.approx(values, rel=1e-12, abs=1e-12)


# --- the chapter ---------------------------------------------------------------------------------


def test_13_21_door_linkage() -> None:
    """3.5 F = 9 x 30 + 18 x 250; the ball bearings push the shafts against the arms."""
    answer = solve(load(CHAPTER / "13_21_door_linkage.yaml"))
    radial = (9.0 * 30.0 + 18.0 * 250.0) / 3.5
    assert reaction(answer, "F23").force == close(0.0, 0.0, 250.0)
    for arm, low, high, pivot, end in (("2", "A1", "A2", "A", "B"), ("4", "D1", "D2", "D", "C")):
        taper, ball = reaction(answer, f"F1-{arm}@{low}"), reaction(answer, f"F1-{arm}@{high}")
        shares = dict(taper.parts)
        assert shares["thrust"] == pytest.approx(280.0, rel=1e-12)
        assert shares["radial"] == pytest.approx(radial, rel=1e-9)  # the points have 12 decimals
        assert ball.magnitude == digits("1362.86")
        assert answer.spatial is not None
        ax, ay, _ = (b - a for a, b in zip(*(answer.spatial.points[p] for p in (pivot, end)), strict=True))
        assert (ball.force[0] or 0.0) * ax + (ball.force[1] or 0.0) * ay < 0.0


def test_13_22_loads_of_the_robot_s_members() -> None:
    answer = solve(load(CHAPTER / "13_22_robot_arm.yaml"))
    assert "made up" in answer.case.reconstructed
    twist = 360.0 * math.sin(math.radians(45.0))
    assert reaction(answer, "FA-B").couple == pytest.approx((twist, twist, 0.0), rel=1e-12)
    bending = -(30.0 * 16.0 - twist)
    assert reaction(answer, "Fbase-A").couple == pytest.approx((twist, bending, 0.0), rel=1e-12)


def test_13_23_spur_gears() -> None:
    answer = solve(load(CHAPTER / "13_23_spur_gears.yaml"), reactions=True)
    assert answer.reactions is not None
    assert answer.reactions["F23"].magnitude == digits("3584.6")
    assert answer.reactions["F13"].x == digits("-1226.0")
    assert answer.reactions["F13"].y == digits("-3368.4")
    assert answer.answers["T12"].value / 12.0 == digits("271.93")


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("13_24_helical_gear", ("1746.6", "940.5", "1008.4", "1983.7", "3638.8", "727.8")),
        ("13_24_helical_gear_as_printed", ("2016.8", "1085.9", "1164.4", "2290.6", "3638.8", "727.8")),
    ],
)
def test_13_24_helical_gear(name: str, values: tuple[str, ...]) -> None:
    shares = dict(reaction(solve(load(CHAPTER / f"{name}.yaml")), "F1-2@G").parts)
    keys = ("tangential", "separating", "axial", "transverse", "couple", "bearing")
    assert [shares[key] for key in keys] == [digits(value) for value in values]


# --- closed forms --------------------------------------------------------------------------------

BOOM = """\
icsolve: 1
units: {length: m, force: kN}
points: {A: [0, 0, 0], B: [0, 6, 0], C: [-3, 0, 2], D: [3, 0, 2]}
joints: [{ball: [1, 2], at: A}]
loads:
  P: {force: 10, link: 2, at: B, along: -z}
  TC: {force: unknown, link: 2, at: B, toward: C}
  TD: {force: unknown, link: 2, at: B, toward: D}
  N: {torque: unknown, link: 2, along: y}
expect: {TC: 17.5 toward C, TD: 17.50 toward D, F12y: 30.00, A-B: 6.0, h F12 B: 0.0}
"""


@pytest.mark.parametrize("way", ["toward", "away"])
def test_the_worked_solution_says_which_way_a_load_acts_as_it_was_written(way: str) -> None:
    """Toward a point, along or about an axis: not the components of a unit vector."""
    text = BOOM.partition("expect")[0].replace("toward: C", f"{way}: C")
    told = explain(load(text), "text")
    assert f"TC: a load on link 2 at B, {'away from' if way == 'away' else 'toward'} C\n" in told
    assert solve(load(text)).answers["TC"].value == pytest.approx(-17.5 if way == "away" else 17.5, rel=1e-12)
    assert "N: a couple on link 2, about y\n" in told
    assert "P: a load of 10 kN on link 2 at B, along -z\n" in told


def test_a_mass_in_space_is_its_weight_in_any_units() -> None:
    text = BOOM.partition("expect")[0].replace("{length: m, force: kN}", "{length: in, force: lbf}")
    by_mass, by_weight = (
        solve(load(text.replace("force: 10, link: 2, at: B, along: -z", f"{said}, link: 2, at: B")))
        for said in ("mass: 12 kg", "weight: 117.72 N")
    )
    for name, found in by_mass.answers.items():
        assert found.value == pytest.approx(by_weight.answers[name].value, rel=1e-14)


def test_the_powers_in_space_tell_which_load_was_unknown() -> None:
    """A lever on a hinge about z."""
    answer = solve(
        load("""icsolve: 1
points: {A: [0, 0, 0], B: [2, 0, 1]}
joints: [{hinge: [1, 2], at: A, axis: z}]
loads:
  P: {force: 10, link: 2, at: B, along: -y}
  T: {torque: unknown, link: 2, along: z}
""")
    )
    assert {term.load: term.unknown for term in answer.terms} == {"P": False, "T": True}
    assert answer.answers["T"].value == pytest.approx(20.0, rel=1e-15)


def test_inertia_forces_in_space_are_refused_and_not_left_out() -> None:
    with pytest.raises(SceneError, match="solved at rest") as refused:
        solve(load(BOOM), dynamic=True)
    assert refused.value.status == "unsupported"


@pytest.mark.parametrize("path", ["loads.P", "lods.P", "points.C.x"])
@pytest.mark.parametrize("more", [[], ["--find", "TC=3"], ["--find", "rest"]])
def test_a_case_in_space_is_not_swept_whatever_the_path(
    path: str, more: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "boom.yaml"
    file.write_text(BOOM)
    assert exit_status("sweep", str(file), "--vary", f"{path}=1:2:1", *more) == 1
    said = capsys.readouterr().err
    assert "this case is in space" in said and "--set" in said


def test_a_boom_on_a_ball_with_two_cables() -> None:
    """Each cable lifts 5 at B: its tension is 5 x 7 / 2 (the cable is 7 long and 2 high)."""
    answer = solve(load(BOOM))
    assert answer.answers["TC"].value == pytest.approx(17.5, rel=1e-13)
    assert answer.answers["TC"].sense == "toward C"
    assert answer.answers["N"] == answer.answers["N"]._replace(value=0.0, sense="")
    assert reaction(answer, "F12").force == close(0.0, 30.0, 0.0)
    assert [row.verdict for row in compare(answer)] == [AGREES] * 5


@pytest.mark.parametrize("way", ["along: y", "along: [0, -1, 0]", "toward: D", "away: D", "along: [D, C]"])
def test_a_load_in_space_goes_the_published_way_in_any_words(way: str) -> None:
    """Its moment about the shaft is that of 20 along -y, toward the lower end of CD."""
    text = f"""icsolve: 1
points: {{A: [0, 0, 0], B: [0, 0, 5], C: [3, 0, 2], D: [3, 4, 2], E: [3, -9, 2]}}
joints:
  - {{thrust: [1, 2], at: A, axis: z}}
  - {{radial: [1, 2], at: B, axis: z}}
loads:
  F: {{force: [10, 20, -5], link: 2, at: C}}
  Q: {{force: unknown, link: 2, at: C, {way}}}
expect: {{Q: "20 %s"}}
"""
    same = ["along -y", "away D", "away from D", "toward E", "along [0, -1, 0]", "along D to C"]
    other = ["along y", "toward D", "away from E", "up", "down", "along C to D"]
    for sense in (*same, *other):
        (row,) = compare(solve(load(text % sense)))
        assert row.verdict == (AGREES if sense in same else "disagrees"), sense


UNKNOWNS = {
    "force: unknown, at: C, along: -z": ("", "along -z", "along z"),
    "force: unknown, at: C, toward: D": ("", "toward D", "away from D"),
    "force: unknown, at: C, away: D, against: 3": ("", "push", "pull"),
    "weight: unknown, at: C": ("", "down", "up"),
    "mass: unknown, at: C": (" kg", "down", "up"),
    "spring: unknown, free: 1, at: C, to: D": ("", "pull", "push"),
    "spring: unknown, free: 9, at: C, to: D": ("", "push", "pull"),
    "torque: unknown, along: -y": ("", "about -y", "about y"),
}


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("entry", UNKNOWNS)
def test_a_load_in_space_is_expected_with_the_sense_that_it_is_told_with(entry: str, sign: int) -> None:
    unit, forth, back = UNKNOWNS[entry]
    text = f"""icsolve: 1
points: {{A: [0, 0, 0], C: [3, 0, 2], D: [3, 0, -4]}}
joints: [{{hinge: [1, 2], at: A, axis: y}}, {{weld: [1, 3], at: D}}]
loads:
  Q: {{{entry}, link: 2}}
  P: {{torque: {sign * 7}, link: 2, along: y}}
"""
    found = solve(load(text)).answers["Q"]
    assert found.sense in (forth, back) and (found.sense == forth) == (found.value > 0.0)
    for sense in (forth, back):
        said = f"{abs(found.value):.6g}{unit} {sense}"
        (row,) = compare(solve(load(f'{text}expect: {{Q: "{said}"}}')))
        assert row.verdict == (AGREES if sense == found.sense else "disagrees"), row


SHAFT = """\
icsolve: 1
units: {length: mm, force: N, torque: N*m}
points: {A: [0, 0, 0], B: [400, 0, 0], C: [100, 0, 80], D: [300, 60, 0]}
joints:
  - {thrust: [1, 2], at: A, axis: x}
  - {radial: [1, 2], at: B, axis: [A, B]}
loads:
  P: {force: [-40, 500, 0], link: 2, at: C}
  Q: {force: unknown, link: 2, at: D, along: z}
"""


def test_a_shaft_with_a_crank_and_a_pulley() -> None:
    """Moments about x: 500 x 80 = Q x 60; then about A along y and z; the thrust is all at A."""
    answer = solve(load(SHAFT))
    q = 500.0 * 80.0 / 60.0
    assert answer.answers["Q"].value == pytest.approx(q, rel=1e-13)
    assert answer.answers["Q"].sense == "along z"
    by, bz = -500.0 * 100.0 / 400.0, -(q * 300.0 + 40.0 * 80.0) / 400.0
    assert reaction(answer, "F1-2@B").force == close(0.0, by, bz)
    assert reaction(answer, "F1-2@A").force == close(40.0, -500.0 - by, -q - bz)
    assert dict(reaction(answer, "F1-2@A").parts)["thrust"] == pytest.approx(40.0, rel=1e-12)


def test_couples_are_in_the_case_s_unit_of_torque() -> None:
    """A bracket welded at A: 200 N at 300 mm make 60 N*m."""
    text = (
        "icsolve: 1\nunits: {length: mm, force: N, torque: N*m}\npoints: {A: [0, 0, 0], B: [0, 300, 0]}\n"
        "joints: [{weld: [1, 2], at: A}]\nloads: {P: {force: 200, link: 2, at: B, along: -z}}\n"
        "expect: {M12: 60.00, M12x: 60.00, F12z: 200.0, M21x: -60.00}\n"
    )
    answer = solve(load(text))
    assert reaction(answer, "F12").couple == close(60.0, 0.0, 0.0)
    assert [row.verdict for row in compare(answer)] == [AGREES] * 4


def test_gravity_is_stated_where_it_is_not_along_minus_z() -> None:
    text = (
        "icsolve: 1\n{}points: {{A: [0, 0, 0], G: [2, 0, 0]}}\njoints: [{{weld: [1, 2], at: A}}]\n"
        "loads: {{M: {{mass: 3 kg, link: 2, at: G}}}}\n"
    )
    forces = {
        "": (0.0, 0.0, 3 * 9.81),
        "gravity: {along: -y}\n": (0.0, 3 * 9.81, 0.0),
        "gravity: {size: 10, along: x}\n": (-30.0, 0.0, 0.0),
        "gravity: [0, -6, 8]\n": (0.0, 18.0, -24.0),
        "gravity: 10 m/s^2\n": (0.0, 0.0, 30.0),
    }
    for gravity, force in forces.items():
        assert reaction(solve(load(text.format(gravity))), "F12").force == close(*force), gravity


def test_a_spring_and_loads_that_are_like_each_other() -> None:
    """A gate on an upright shaft, a spring of 3 N/m stretched from 3 to 5 m: 6 N over a 3-4-5 triangle."""
    text = """\
icsolve: 1
points: {A: [0, 0, 0], B: [0, 0, 2], E: [3, 0, 0], F: [0, 4, 0]}
joints: [{thrust: [1, 2], at: A, axis: z}, {radial: [1, 2], at: B, axis: z}]
loads:
  S: {spring: 3, free: 3, link: 2, at: E, to: F}
  T: {torque: unknown, link: 2, along: -z}
  U: {torque: {like: T, times: 0.5}, link: 2, along: -z}
"""
    answer = solve(load(text))
    moment = 6.0 * 0.8 * 3.0
    assert answer.answers["T"].value == pytest.approx(moment / 1.5, rel=1e-13)
    assert answer.answers["U"].value == pytest.approx(moment / 3.0, rel=1e-13)
    assert answer.answers["T"].sense == "about -z"
    back = solve(load(text.replace("S: {spring: 3, free: 3, ", "S: {spring: 3, free: 7, ")))
    assert back.answers["T"].sense == "about z"
    total = reaction(answer, "F1-2@A").force
    assert total[0] == pytest.approx(6.0 * 0.6, rel=1e-12)  # at the height of E and F, so all at A
    assert total[1] == pytest.approx(-6.0 * 0.8, rel=1e-12)


def test_a_planar_mechanism_in_space_has_its_planar_reactions() -> None:
    """Problem 13.2 with hinges about z: what lies in its plane is determined and the same."""
    flat = solve(load(CHAPTER / "13_02_four_bar_free_bodies.yaml"), reactions=True)
    text = """\
icsolve: 1
units: {length: cm, force: N}
points:
  O2: [0, 0, 0]
  A: [-4, 0, 0]
  B: [3.44, 6.61, 0]
  O4: [7.94, 0, 0]
  C: [9.158, 11.69, 0]
  D: [11.25, 5.73308, 0]
joints:
  - {hinge: [1, 2], at: O2, axis: z}
  - {hinge: [2, 3], at: A, axis: z}
  - {hinge: [3, 4], at: B, axis: z}
  - {hinge: [1, 4], at: O4, axis: z}
loads:
  F3: {force: 100, link: 3, at: C, along: -x}
  F4: {force: [-173.20508075688772, 100, 0], link: 4, at: D}
  T12: {torque: unknown, link: 2, along: z}
"""
    deep = solve(load(text))
    assert deep.answers["T12"].value == pytest.approx(flat.answers["T12"].value, rel=1e-12)
    assert deep.mobility == 1
    assert flat.reactions is not None
    for name in ("F12", "F23", "F34", "F14"):
        x, y, z = reaction(deep, name).force
        planar = flat.reactions[name]
        assert (x, y) == pytest.approx((planar.x, planar.y), rel=1e-11)
        assert z is None
    assert any("3 parts of the reactions open" in note for note in deep.notes)


# --- what is open --------------------------------------------------------------------------------


def test_two_thrust_bearings_share_the_thrust_in_a_way_that_is_said_to_be_open() -> None:
    text = SHAFT.replace("radial: [1, 2]", "thrust: [1, 2]")
    answer = solve(load(text))
    mine, known = reaction(answer, "F1-2@A"), reaction(solve(load(SHAFT)), "F1-2@A")
    assert mine.force[0] is None
    assert mine.force[1:] == pytest.approx(known.force[1:], rel=1e-12)
    assert dict(mine.parts) == {"radial": pytest.approx(dict(known.parts)["radial"]), "thrust": None}
    assert "F1-2@A along x, F1-2@B along x" in answer.notes[0]
    shown = answer.to_dict()["reactions"]["F1-2@A"]
    assert (shown["x"], shown["magnitude"]) == (None, None)
    assert "share the load" in shown["undetermined"]


def test_the_radial_share_is_known_even_where_no_component_is() -> None:
    """Two thrust bearings on a slanted shaft: the open thrust lies in every component."""
    text = (
        "icsolve: 1\npoints: {A: [0, 0, 0], B: [1, 2, 2], C: [2, 4, 4]}\njoints:\n"
        "  - {thrust: [1, 2], at: A, axis: [A, B]}\n  - {thrust: [1, 2], at: C, axis: [A, B]}\n"
        "loads: {P: {force: [2, -2, 1], link: 2, at: B}}\n"
    )
    found = reaction(solve(load(text)), "F1-2@A")
    assert found.force == (None, None, None)
    assert dict(found.parts)["radial"] == pytest.approx(1.5, rel=1e-12)


def test_bodies_that_the_loads_do_not_drive_may_move() -> None:
    answer = solve(load(CHAPTER / "13_21_door_linkage.yaml"))
    assert answer.mobility == 2
    assert answer.notes == ("the joints leave 2 degrees of freedom in which the loads are in balance.",)


def test_loads_that_balance_but_for_rounded_data_are_said_to() -> None:
    """The door's centre of mass given by coordinates that miss the midpoint by 5e-6."""
    text = (CHAPTER / "13_21_door_linkage.yaml").read_text()
    rounded = text.replace("G3: {centroid: [B, C]}", "G3: [18.70760, -6.68679, -30]")
    answer = solve(load(rounded))
    assert dict(reaction(answer, "F1-2@A1").parts)["radial"] == digits("1362.86")
    assert "taken as balanced" in answer.notes[1]


@pytest.mark.parametrize("part", ["", "00000000001", "00000000000000000000000000001"])
def test_loads_that_balance_but_for_a_last_decimal_are_said_to(part: str) -> None:
    """However far back that decimal stands; the same loads to the last decimal balance."""
    answer = solve(
        load(f"""icsolve: 1
points: {{A: [0, 0, 0], B: [1, 2, 3]}}
joints: [{{hinge: [1, 2], at: A, axis: z}}]
loads:
  P: {{torque: 100, link: 2, along: z}}
  Q: {{torque: -100.0{part}, link: 2, along: z}}
""")
    )
    assert ("taken as balanced" in " ".join(answer.notes)) == bool(part)


# --- gears ---------------------------------------------------------------------------------------

MESH = """\
icsolve: 1
units: {length: mm, force: N, torque: N*m}
points:
  A: [0, 0, -50]
  B: [0, 0, 50]
  C: [%(far)s, 0, -50]
  D: [%(far)s, 0, 50]
  G: [0, 0, 0]
  H: [%(far)s, 0, 0]
joints:
  - {thrust: [1, 2], at: A, axis: z}
  - {radial: [1, 2], at: B, axis: z}
  - {thrust: [1, 3], at: C, axis: z}
  - {radial: [1, 3], at: D, axis: z}
  - gears: [2, 3]
    teeth: %(teeth)s
    at: [G, H]
    axis: z
    %(form)s
loads:
  T2: {torque: %(torque)s, link: 2, along: z}
  T3: {torque: unknown, link: 3, along: z}
"""
HELICAL = "normal pressure angle: 20\n    helix angle: 30\n    hand: left"


def mesh(teeth: str, form: str, torque: str = "30", far: float = 90.0) -> Answer:
    return solve(load(MESH % {"teeth": teeth, "form": form, "torque": torque, "far": far}))


def test_a_left_handed_driver_is_pushed_along_its_left_hand_s_thumb() -> None:
    """Pitch radii 30 and 60 mm: W = 30 N*m / 0.03 m; driver ccw about z with a left hand: thumb along -z."""
    answer = mesh("[20, 40]", HELICAL)
    assert answer.answers["T3"].value == pytest.approx(60.0, rel=1e-12)
    w, apart = 1000.0, 1000.0 * math.tan(math.radians(20.0)) / math.cos(math.radians(30.0))
    axial = 1000.0 * math.tan(math.radians(30.0))
    assert reaction(answer, "F23").force == pytest.approx((apart, w, axial), rel=1e-12)
    shares = dict(reaction(answer, "F23").parts)
    assert shares["couple 2"] == pytest.approx(0.03 * axial, rel=1e-12)
    assert shares["couple 3"] == pytest.approx(0.06 * axial, rel=1e-12)
    assert shares["bearing 3"] == pytest.approx(axial * 60.0 / 100.0, rel=1e-12)


def test_turning_the_torque_takes_the_other_flank_and_still_pushes_apart() -> None:
    forth, back = mesh("[20, 40]", HELICAL), mesh("[20, 40]", HELICAL, "-30")
    (x, y, z), (p, q, r) = reaction(forth, "F23").force, reaction(back, "F23").force
    assert (p, q, r) == pytest.approx((x, -(y or 0.0), -(z or 0.0)), rel=1e-12)


def test_an_internal_gear_is_pushed_outward_and_has_its_pinion_s_hand() -> None:
    """A pinion of 20 in a ring of 60, centres 60 mm apart: radii 30 and 90 mm, both turn alike."""
    answer = mesh("[20, -60]", HELICAL, far=-60.0)
    assert answer.answers["T3"].value == pytest.approx(-90.0, rel=1e-12)
    x, _, z = reaction(answer, "F23").force
    assert x == pytest.approx(1000.0 * math.tan(math.radians(20.0)) / math.cos(math.radians(30.0)))
    ring_first = mesh("[-60, 20]", HELICAL, far=60.0)
    assert ring_first.answers["T3"].value == pytest.approx(-10.0, rel=1e-12)
    assert z == pytest.approx(1000.0 * math.tan(math.radians(30.0)))


def test_spur_gears_in_space_are_those_of_the_plane() -> None:
    answer = mesh("[20, 40]", "pressure angle: 20")
    assert reaction(answer, "F23").force == pytest.approx((1000 * math.tan(math.radians(20)), 1000.0, 0.0))
    assert "axial" not in dict(reaction(answer, "F23").parts)


def test_normal_and_transverse_sections_say_the_same_teeth() -> None:
    """tan(a_n) = tan(a_t) cos(h); m_n = m_t cos(h): m_t is 180 mm over 60 teeth."""
    cosine = math.cos(math.radians(30.0))
    angle = math.degrees(math.atan(math.tan(math.radians(20.0)) / cosine))
    other = f"transverse pressure angle: {angle!r}\n    helix angle: 30\n    hand: left\n"
    first = mesh("[20, 40]", f"{HELICAL}\n    normal module: {3.0 * cosine!r}")
    second = mesh("[20, 40]", f"{other}    transverse module: 3.0")
    assert reaction(first, "F23").force == pytest.approx(reaction(second, "F23").force, rel=1e-12)


def test_helical_gears_of_a_planar_case_are_those_of_space() -> None:
    """What the plane cannot show, the axial force and its couples, stands with the tooth force."""
    text = """\
icsolve: 1
units: {length: mm, force: N, torque: N*m}
points: {A: [0, 0], B: [90, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - gears: [2, 3]
    teeth: [20, 40]
    normal pressure angle: 20
    normal module: 2.598076211353316
    helix angle: 30
    bearing span: 100
loads: {T2: {torque: 30, link: 2}, T3: {torque: unknown, link: 3}}
expect: {tangential F23: 1000.0, axial F23: 577.4, couple 3 F23: 34.64, bearing 2 F23: 173.2}
"""
    answer = solve(load(text), reactions=True)
    assert [row.verdict for row in compare(answer)] == [AGREES] * 4
    assert answer.reactions is not None
    flat, deep = answer.reactions["F23"], reaction(mesh("[20, 40]", HELICAL), "F23")
    assert (flat.x, flat.y) == pytest.approx(deep.force[:2], rel=1e-12)
    shares = dict(deep.parts)
    assert dict(flat.parts) == pytest.approx({name: shares[name] for name, _ in flat.parts}, rel=1e-12)
    with pytest.raises(SceneError, match="do not fit"):
        solve(load(text.replace("normal module", "transverse module")), reactions=True)


def test_teeth_that_do_not_fit_their_centres_are_refused_with_their_line() -> None:
    with pytest.raises(SceneError, match=r"gears 2 and 3 \(line 15\) do not fit.* 105 apart.* 90 apart"):
        mesh("[20, 50]", "pressure angle: 20\n    module: 3")


def test_a_double_helical_pair_leaves_open_how_its_halves_share() -> None:
    text = MESH % {"teeth": "[20, 40]", "form": HELICAL, "torque": "30", "far": 90.0}
    twin = text[text.index("  - gears") : text.index("loads:")].replace("left", "right")
    answer = solve(load(text.replace("loads:", f"{twin}loads:")))
    assert answer.answers["T3"].value == pytest.approx(60.0, rel=1e-12)
    assert any("not determined" in note for note in answer.notes)
    assert answer.spatial is not None
    halves = [r for r in answer.spatial.reactions.values() if r.kind == "gears"]
    assert [r.force for r in halves] == [(None, None, None)] * 2  # of each all parts go with the tangential


# --- refusals ------------------------------------------------------------------------------------

DOOR = """\
icsolve: 1
points: {A: [0, 0, 0], B: [0, 0, 2], C: [1, 0, 1], D: [1, 0.5, 1]}
joints:
  - {hinge: [1, 2], at: A, axis: z}
loads:
  P: {force: %s, link: 2, at: C, %s}
"""
SCENES = {
    "driven": (DOOR % ("5", "along: y"), "mobility", "link 2 turns about the line through A and B"),
    "driven elsewhere": (
        DOOR.replace("at: C", "at: B").replace("at: A", "at: C").replace("D:", "E: [1, 0, 3], D:")
        % ("5", "along: y"),
        "mobility",
        "link 2 turns about the line through C and E",
    ),
    "any value": (DOOR % ("unknown", "along: x"), "any-value", "any value of P balances"),
    "structure": (
        DOOR.replace("hinge", "weld").replace(", axis: z", "") % ("unknown", "along: x"),
        "structure",
        "any value of P is carried",
    ),
    "too many": (
        DOOR % ("unknown", "along: y") + "  Q: {torque: unknown, link: 2, along: z}\n",
        "mobility",
        "2 unknown loads for a mobility of 1",
    ),
    "no value": (
        DOOR % ("unknown", "along: x") + "  Q: {torque: 3, link: 2, along: z}\n",
        "no-value",
        "no value of P balances",
    ),
    "loose": (
        DOOR.replace("loads:", "  - {ball: [3, 4], at: C}\nloads:") % ("5", "along: x"),
        "loose-link",
        "links 3 and 4",
    ),
    "slides": (
        DOOR.replace("hinge", "radial") % ("5", "along: z"),
        "mobility",
        "link 2 slides along z",
    ),
    "slides back": (
        DOOR.replace("hinge", "radial") % ("-5", "along: z"),
        "mobility",
        "link 2 slides along -z",
    ),
    "no direction": (
        DOOR.replace("axis: z", "axis: [A, E]").replace("C: [1", "E: [0, 0, 0], C: [1") % ("5", "along: x"),
        "inconsistent",
        "the axis of the hinge of links 1 and 2 (line 4) has no direction: A and E lie at one place",
    ),
    "hinges out of line": (
        DOOR.replace("loads:", "  - {hinge: [1, 2], at: B, axis: [0.001, 0, 1]}\nloads:") % ("5", "along: x"),
        "inconsistent",
        "out of line by a little",
    ),
    "a circle of centroids": (
        DOOR.replace("C: [1, 0, 1]", "C: {centroid: [A, D]}").replace(
            "D: [1, 0.5, 1]", "D: {centroid: [A, C]}"
        )
        % ("5", "along: x"),
        "underdetermined",
        "C is the centroid of points that depend on it",
    ),
    "far from the origin": (
        DOOR.replace("A: [0, 0, 0]", "A: [1e17, 0, 0]")
        .replace("B: [0", "B: [1e17")
        .replace("C: [1,", "C: [1e17,")
        .replace("D: [1,", "D: [1e17,")
        % ("5", "along: x"),
        "near-singular",
        "cannot resolve the figure",
    ),
    "centres askew": (
        MESH.replace("H: [%(far)s, 0, 0]", "H: [%(far)s, 0, 20]")
        % {"teeth": "[20, 40]", "form": "pressure angle: 20", "torque": "3", "far": 90.0},
        "inconsistent",
        "not square to their axis",
    ),
}


@pytest.mark.parametrize("what", SCENES)
def test_a_scene_without_an_answer_says_why(what: str) -> None:
    text, status, says = SCENES[what]
    with pytest.raises(SceneError) as caught:
        solve(load(text))
    assert (caught.value.status, says in str(caught.value)) == (status, True), str(caught.value)


CHANGES = {
    "planar joint": ("{radial: [1", "{pin: [1", 6, 6, "a 'pin' is a joint of the plane"),
    "planar slide": ("{radial: [1", "{slide: [1", 6, 6, "its place is taken by bearings with their `axis`"),
    "two coordinates": ("B: [400, 0, 0]", "B: [400, 0]", 3, 27, "point B: in space every point has three"),
    "an unknown coordinate": ("B: [400, 0, 0]", "B: [unknown, 0, 0]", 3, 28, "'unknown' cannot stand here"),
    "lengths": ("joints:", "lengths: {AB: 1}\njoints:", 4, 1, "'lengths' has no place in a case in space"),
    "motion": ("joints:", "motion: {link: 2, turns: cw}\njoints:", 4, 1, "takes its own `speed`"),
    "inertia forces": ("joints:", "dynamic: yes\njoints:", 4, 1, "give the forces of inertia as loads"),
    "cams": ("joints:", "profile: {2: {circle: C, radius: 4}}\njoints:", 4, 1, "cams are of the plane"),
    "friction": ("axis: x}", "axis: x, mu: 0.1, radius: 2}", 5, 38, "friction is solved in the plane only"),
    "no axis": (", axis: x}", "}", 5, 5, "needs 'axis': the direction of the shaft: x, y, z, -z"),
    "axis of nothing": ("axis: x", "axis: [0, 0, 0]", 5, 35, "its components are all 0"),
    "axis of one point": ("axis: [A, B]", "axis: [A, A]", 6, 35, "two different points"),
    "axis that is a number": ("axis: x", "axis: 30", 5, 35, "should be x, y, z"),
    "two kinds": ("{thrust: [1, 2]", "{thrust: [1, 2], ball: [1, 2]", 5, 22, "a joint is of one kind"),
    "kind misspelt": ("{thrust: [1", "{thurst: [1", 5, 6, "did you mean 'thrust'?"),
    "an unknown component": (
        "[-40, 500, 0]",
        "[-40, 500, unknown]",
        8,
        14,
        "it is `force: unknown` with its direction, as in `along: -z`; else one",
    ),
    "angle of a force": (", along: z}", ", angle: 90}", 9, 39, "that is for the plane; in space"),
    "no direction": (", along: z}", "}", 9, 6, "needs its direction: along, toward, away"),
    "two components": ("[-40, 500, 0]", "[-40, 500]", 8, 14, "three components [x, y, z]"),
    "components and a direction": ("2, at: C", "2, at: C, along: x", 8, 45, "so it takes no 'along'"),
    "toward itself": ("along: z", "toward: D", 9, 39, "cannot point toward it"),
    "point that is not there": ("at: D", "at: E", 9, 36, "point E is named here, but 'points'"),
    "sense of the plane": ("loads:", "expect: {Q: 3 right}\nloads:", 7, 13, "in space it is 'along -z'"),
    "centre": ("loads:", "expect: {I12: [0, 0]}\nloads:", 7, 10, "names nothing in this case"),
    "gravity upside down": ("joints:", "gravity: -9.81\njoints:", 4, 10, "not negative"),
    "gravity of nothing": ("joints:", "gravity: [0, 0, 0]\njoints:", 4, 10, "has no direction"),
}


@pytest.mark.parametrize("what", CHANGES)
def test_one_thing_wrong_is_one_message_with_its_place(what: str) -> None:
    old, new, line, column, says = CHANGES[what]
    assert SHAFT.count(old) == 1
    with pytest.raises(CaseError) as caught:
        load(SHAFT.replace(old, new))
    error = caught.value
    assert says in str(error)
    assert (error.line, error.column, len(error.problems)) == (line, column, 1), str(error)


TEETH = {
    "teeth: [20, 40]": ("teeth: [20.5, 40]", "whole numbers other than 0"),
    "teeth: [20, 40]\n": ("teeth: [20, 40, 3]\n", "the number of teeth of each gear"),
    "at: [G, H]": ("at: G", "the centres of both wheels"),
    "at: [G, H]\n": ("at: [G, G]\n", "two different points"),
    "axis: z\n    normal": ("normal", "needs 'axis': the direction of the shafts"),
    "normal pressure": ("pressure", "say whether it is the 'normal pressure angle'"),
    "    hand: left\n": ("", "needs 'hand'"),
    "    helix angle: 30\n": ("", "needs 'helix angle'"),
    "hand: left": ("hand: both", "should be right or left"),
    "helix angle: 30": ("helix angle: 90", "less than 90 degrees"),
    "gears: [2, 3]": ("gears: [2, 3]\n    toward: x", "is for one gear whose mate is not shown"),
    "[20, 40]": ("20", "needs 'toward': where the mate lies"),
    "normal pressure angle: 20\n    ": ("", "needs 'normal pressure angle'"),
    "hand: left\n": ("hand: left\n    module: 3\n", "'module' of the gear pair of 2 and 3: with a helix"),
}


@pytest.mark.parametrize("old", TEETH)
def test_teeth_that_cannot_be_read(old: str) -> None:
    new, says = TEETH[old]
    text = MESH % {"teeth": "[20, 40]", "form": HELICAL, "torque": "3", "far": 90.0}
    assert old in text
    with pytest.raises(CaseError) as caught:
        load(text.replace(old, new, 1))
    assert says in str(caught.value)


# --- how it is shown -----------------------------------------------------------------------------


def test_json_has_vectors_under_the_keys_of_the_plane(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "shaft.yaml"
    path.write_text(SHAFT)
    assert exit_status("solve", "--json", str(path)) == 0
    shown = json.loads(capsys.readouterr().out)
    assert (shown["schema"], shown["case"], shown["status"]) == ("icsolve/solve/1", "shaft", "ok")
    entry = shown["reactions"]["F1-2@A"]
    assert entry["at"] == [0.0, 0.0, 0.0]
    assert entry["moment"] == [0.0, 0.0, 0.0]
    assert entry["magnitude"] == pytest.approx(math.hypot(entry["x"], entry["y"], entry["z"]))
    assert shown["points"]["D"] == [300.0, 60.0, 0.0]
    assert shown["answers"]["Q"]["sense"] == "along z"
    assert 0.0 < shown["answers"]["Q"]["error"] < 1e-9
    assert abs(shown["free_bodies"]["Q"]["difference"]) <= shown["free_bodies"]["Q"]["bound"]


def test_text_gives_every_joint_a_line() -> None:
    text = answer_text(solve(load(SHAFT)))
    assert "Q = 666.667 N, along z" in text
    assert "F1-2@A  (40, -375, -158.667)" in text
    assert "radial at B" in text
    assert "By the equilibrium of the links alone\n  Q = 666.667, by power 666.667" in text


def test_the_power_of_all_loads_adds_up_to_nothing() -> None:
    answer = solve(load(SHAFT))
    terms = {term.load: term for term in answer.terms}
    assert terms["Q"].factor == pytest.approx(1.0)  # 1 mm/s where Q acts
    assert math.fsum(term.power for term in answer.terms) == pytest.approx(0.0, abs=1e-10)


@pytest.mark.parametrize(("path", "value"), [("points.B.z", "40"), ("loads.P.z", "7"), ("points.D.y", "30")])
def test_numbers_are_set_by_their_path(path: str, value: str) -> None:
    changed = load(SHAFT, {path: value})
    assert str(changed.space) != str(load(SHAFT).space)
    assert f"digits='{value}'" in str(changed.space)


def test_what_is_for_the_plane_alone_is_refused_in_words() -> None:
    answer = solve(load(SHAFT))
    with pytest.raises(SceneError, match="planar cases only"):
        dict(answer.sensitivities)
    assert known_of(answer.case).refusal is None


@pytest.mark.parametrize(
    ("couple", "force", "found"),
    [
        ("y", "y", {"T": (-16.0, "about -y"), "F": (-20.0, "along -y")}),
        (
            "[0, -0.6, 0.8]",
            "[3, 4, 0]",
            {"T": (5.0 / 3.0, "about [0, -0.6, 0.8]"), "F": (-25.0, "along [-0.6, -0.8, 0]")},
        ),
        (
            "[0, 3, 4]",
            "[-3, -4, 0]",
            {"T": (-5.0 / 3.0, "about [0, -0.6, -0.8]"), "F": (25.0, "along [-0.6, -0.8, 0]")},
        ),
    ],
)
def test_a_shaft_that_slides_along_y_too_is_held_along_directions(
    couple: str, force: str, found: dict[str, tuple[float, str]]
) -> None:
    """F along y balances 20 N; about y, W turns with 1 x 1 - 3 x -5 = 16 N m, and F = (-15, -20, 0) N at C
    with -15 N x 1 m."""
    text = (
        "icsolve: 1\npoints: {A: [0, 0, 0], B: [0, 5, 0], C: [3, 2, 1]}\n"
        "joints: [{radial: [1, 2], at: A, axis: y}, {radial: [1, 2], at: B, axis: y}]\n"
        "loads: {W: {force: [1, 20, -5], link: 2, at: C}, "
        f"T: {{torque: unknown, link: 2, along: {couple}}}, "
        f"F: {{force: unknown, link: 2, at: C, along: {force}}}}}\n"
    )
    answer = solve(load(text), reactions=True)
    assert answer_text(answer).count("no difference") == 2
    for name, (value, sense) in found.items():
        assert (answer.answers[name].value, answer.answers[name].sense) == (value, sense)


@pytest.mark.parametrize(
    ("units", "ratio"),
    [("{length: mm, force: N, torque: N*m}", 1000.0), ("{length: in, force: lbf, torque: lbf*ft}", 12.0)],
)
def test_powers_of_couples_and_forces_in_space_are_in_one_unit(units: str, ratio: float) -> None:
    """As the shaft turns at 1 rad/s: 20 x 30 by the force, ``ratio`` times the torques by the couples."""
    text = (
        f"icsolve: 1\nunits: {units}\npoints: {{A: [0, 0, 0], B: [0, 0, 50], C: [30, 0, 20]}}\n"
        "joints: [{thrust: [1, 2], at: A, axis: z}, {radial: [1, 2], at: B, axis: z}]\n"
        "loads: {F: {force: [0, 20, 0], link: 2, at: C}, K: {torque: 3, link: 2, along: z}, "
        "T: {torque: unknown, link: 2, along: z}}\n"
    )
    answer = solve(load(text))
    torque = -(3.0 + 600.0 / ratio)
    assert answer.answers["T"].value == pytest.approx(torque, rel=1e-15)
    found = {term.load: (term.factor, term.power) for term in answer.terms}
    wanted = {"F": (30.0, 600.0), "K": (ratio, 3.0 * ratio), "T": (ratio, torque * ratio)}
    assert found == {name: pytest.approx(both, rel=1e-15) for name, both in wanted.items()}


@pytest.mark.parametrize(
    "unknown", ["{force: unknown, link: 2, at: C, toward: D}", "{torque: unknown, link: 2, along: y}"]
)
def test_a_known_load_and_an_unknown_one_in_space_have_their_ratio_told(unknown: str) -> None:
    """A plate on two hinges, held by a rope or a couple (F. P. Beer, E. R. Johnston, Statics, ch. 4)."""
    case = load(
        "icsolve: 1\npoints: {A: [0, 0, 0], B: [0, 4, 0], D: [0, 4, 2], C: [3, 4, 0], G: [1.5, 2, 0]}\n"
        "joints: [{radial: [1, 2], at: A, axis: y}, {thrust: [1, 2], at: B, axis: y}]\n"
        f"loads: {{W: {{weight: 1000, link: 2, at: G}}, T: {unknown}}}\n"
    )
    ratio = solve(case).answers["T"].value / 1000.0
    assert f"T / W = {ratio:.6g}" in explain(case)
    assert page_html(known_of(case))


@pytest.mark.parametrize("asked", ["--rates", "--all-centres"])
def test_what_is_told_of_the_plane_alone_is_not_passed_over_in_space(asked: str) -> None:
    """Neither centres nor rates are in the answer: a note says so where they are asked for."""
    case = load(CHAPTER / "13_22_robot_arm.yaml")
    key = asked[2:].replace("-", "_")
    assert any("planar cases only" in note for note in solve(case, **{key: True}).notes)
    assert not any("planar" in note for note in solve(case).notes)
