"""Verdicts: number, unit and direction apart; tolerances, zeros, figures; marks as the course sets them."""

from __future__ import annotations

import math
import random
import re
from pathlib import Path

import pytest

import icsolve
from grade_shell import CASES, Class
from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Course
from icsolve.grade.keys import AnyKey, NumberKey, PlaceKey
from icsolve.grade.one import Task
from icsolve.grade.tolerance import SLACK, range_in_words
from library import FILES, sample

ZERO = """\
icsolve: 1
points: {A: [0, 0], B: [2, 0]}
joints:
  - {pin: [1, 2], at: A}
loads:
  P: {force: 100, link: 2, at: B, angle: 180}
  T: {torque: unknown, link: 2}
"""


GEARS = """\
icsolve: 1
points: {A: [0, 0], B: [3, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {gears: [2, 3], teeth: [20, -40]}
loads:
  M: {torque: 10, link: 3}
  T12: {torque: unknown, link: 2}
"""


PLAIN_PRESS = """\
icsolve: 1
units: {length: in, force: lbf}
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 1, BC: 3.5, CD: 2.5, DE: 1.5}
angles: {AB: 60, CDE: 0}
near: {C: [3.5, 2.4]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
loads:
  P: {force: 100, link: 4, at: E, angle: 180}
  T12: {torque: unknown, link: 2}
"""
"""The answer is 33.7582 lbf*in clockwise."""


@pytest.fixture
def a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    return Class(tmp_path, capsys)


def test_one_percent_is_the_default_and_its_ends_count(a_class: Class) -> None:
    """198 and 202 for 200: the band is closed, with room for rounding."""
    assert a_class.verdicts("200", "198", "202", "197.9", "202.1") == [
        "right",
        "right",
        "right",
        "wrong",
        "wrong",
    ]


def test_units_are_converted(a_class: Class) -> None:
    answers = ("200 N*m", "0.2 kN·m", "20000 N·cm", "147.5 ft-lb", "1770 in-lb")
    assert set(a_class.verdicts(*answers)) == {"right"}


def test_a_right_number_in_a_wrong_unit_is_told_apart_from_a_wrong_number(a_class: Class) -> None:
    for row in a_class.judge("200 kN*m", "200 N", "200 lbf*ft"):
        assert (row["verdict"], row["code"]) == ("wrong", "unit")


def test_a_missing_unit_is_assumed_required_or_ignored_as_the_course_says(a_class: Class) -> None:
    assert a_class.verdicts("200") == ["right"]
    a_class.course("unit: required\n")
    assert [(r["verdict"], r["code"]) for r in a_class.judge("200", "200 N*m")] == [
        ("wrong", "no-unit"),
        ("right", ""),
    ]
    a_class.course("unit: ignored\n")
    assert a_class.verdicts("200", "200 lbf", "0.2 kN*m", "150 ft-lb") == ["right", "right", "right", "wrong"]


def test_capitals_of_a_unit_are_overlooked_or_refused(a_class: Class) -> None:
    (row,) = a_class.judge("0.2 KNm")
    assert (row["verdict"], row["code"], row["score"]) == ("right", "unit-case", "1")
    assert row["feedback"].endswith("Mind the capitals of its unit.")
    a_class.course("unit_case: refuse\n")
    (row,) = a_class.judge("0.2 KNm")
    assert (row["verdict"], row["code"]) == ("wrong", "unit-case")


def test_a_direction_in_words_stands_for_the_sign(a_class: Class) -> None:
    rows = a_class.judge("200 ccw", "200 cw", "-200", "200 N*m clockwise")
    assert [row["verdict"] for row in rows] == ["right", "wrong", "wrong", "wrong"]
    assert {row["code"] for row in rows[1:]} == {"sign"}


def test_a_direction_lies_within_45_degrees_and_is_for_review_within_5_of_square(a_class: Class) -> None:
    """The answer points to 0 degrees."""
    angles = {0: "right", 45: "right", -45: "right", 46: "wrong", 84: "wrong", 85: "review", 90: "review"}
    angles |= {95: "review", 96: "wrong", 135: "wrong", 180: "wrong", 270: "review"}
    found = a_class.verdicts(*(f"100 N at {angle} deg" for angle in angles), case="pusher")
    assert dict(zip(angles, found, strict=True)) == angles


def test_directions_toward_points_and_sides(a_class: Class) -> None:
    answers = {
        "100 N to the right": "right", "100 N left": "wrong", "100 N up": "review",
        "100 N toward G": "right", "100 N away from A": "right", "100 N toward A": "wrong",
        "100 N toward Z": "review", "100 N in compression": "review", "100 N ccw": "wrong",
    }  # fmt: skip
    assert dict(zip(answers, a_class.verdicts(*answers, case="pusher"), strict=True)) == answers


def test_a_course_can_require_or_ignore_the_direction(a_class: Class) -> None:
    a_class.course("direction: required\n")
    rows = a_class.judge("200", "200 ccw")
    assert [(row["verdict"], row["code"]) for row in rows] == [("wrong", "no-direction"), ("right", "")]
    a_class.course("direction: ignored\n")
    assert a_class.verdicts("200", "-200", "200 cw") == ["right", "right", "right"]


def test_a_true_zero_is_judged_against_the_loads_and_the_size(a_class: Class) -> None:
    """100 N on a lever of 2 m: a thousandth of 200 N*m."""
    a_class.case("zero", ZERO)
    assert a_class.verdicts("0", "0.19", "-0.19 N*m cw", "0.21", case="zero") == [
        "right",
        "right",
        "review",
        "wrong",
    ]
    assert a_class.verdicts("0.19 ccw", "0.19 cw", case="zero") == ["right", "right"]


def test_significant_figures_as_a_tolerance(a_class: Class) -> None:
    """Three figures of 200: half a unit of the third, times 1.02."""
    a_class.course("tolerance: 3 sf\n")
    assert a_class.verdicts("200", "200.51", "199.49", "200.52") == ["right", "right", "right", "wrong"]


def test_an_absolute_tolerance_has_its_own_unit(a_class: Class) -> None:
    a_class.course("tolerance: 0.5 N*m\n")
    assert a_class.verdicts("200.5", "200.6") == ["right", "wrong"]
    a_class.course("cases: {lever: {tolerance: 0.002 kN*m}}\n")
    assert a_class.verdicts("202", "202.1") == ["right", "wrong"]


def test_a_cases_own_tolerance_goes_over_the_courses_and_a_questions_over_both(a_class: Class) -> None:
    a_class.case("lever", Path(a_class.path("cases/lever.yaml")).read_text() + "tolerance: 5%\n")
    a_class.course("tolerance: 2%\n")
    assert a_class.verdicts("209", "211") == ["right", "wrong"]
    assert a_class.verdicts("101.9", "102.1", case="pusher") == ["right", "wrong"]
    a_class.course("tolerance: 2%\ncases: {lever: {tolerance: 10%}}\n")
    assert a_class.verdicts("219") == ["right"]


def test_a_tolerance_from_the_drawing_by_exact_sensitivities(a_class: Class) -> None:
    """T = P (x_B - x_A): both may be off by 0.02 m, 4 N*m together."""
    a_class.case("lever", Path(a_class.path("cases/lever.yaml")).read_text() + "tolerance: {drawing: 2 cm}\n")
    rows = a_class.judge("200", "203.9", "204.1", "195.9")
    assert [row["verdict"] for row in rows] == ["right", "right", "wrong", "wrong"]
    assert "from 196.0 to 204.0 N*m" in rows[0]["feedback"]


def test_too_few_written_figures(a_class: Class) -> None:
    a_class.course("tolerance: 5%\nwritten_figures: at_least 3\n")
    rows = a_class.judge("200", "2.0e2", "199.8", "0.20 kN*m")
    assert [(row["verdict"], row["code"]) for row in rows] == [
        ("right", ""), ("wrong", "figures"), ("right", ""), ("wrong", "figures"),
    ]  # fmt: skip


def test_part_credit_for_number_unit_and_direction(a_class: Class) -> None:
    a_class.course("points: 10\ncredit: {number: 60%, unit: 20%, direction: 20%}\nunit: required\n")
    rows = a_class.judge("200 N*m", "200", "-200 N*m", "-200", "150 N*m", "-150")
    assert [row["score"] for row in rows] == ["10", "8", "8", "6", "4", "0"]
    assert {row["max_score"] for row in rows} == {"10"}


def test_credit_for_a_known_mistake(a_class: Class) -> None:
    a_class.course("points: 4\nmalrules: {sign: 50%, half: 25%}\n")
    assert [row["score"] for row in a_class.judge("-200", "100", "400")] == ["2", "1", "0"]


def test_the_five_verdicts(a_class: Class) -> None:
    answers = ("200", "150", "two hundred", "1,234", "")
    assert a_class.verdicts(*answers) == ["right", "wrong", "invalid", "review", "missing"]


def test_the_student_is_told_the_accepted_range_but_not_with_a_wrong_answer(a_class: Class) -> None:
    right, wrong = a_class.judge("200", "150")
    assert "from 198.0 to 202.0 N*m" in right["feedback"]
    assert "within 1 % of the right value" in wrong["feedback"]
    assert "198" not in wrong["feedback"]
    a_class.course("reveal: yes\n")
    assert "from 198.0 to 202.0 N*m" in a_class.judge("150")[0]["feedback"]


def test_a_decimal_comma_is_settled_by_the_course(a_class: Class) -> None:
    a_class.case("lever", Path(a_class.path("cases/lever.yaml")).read_text().replace("100", "617"))
    for decimal, verdict in (("either", "review"), ("point", "right"), ("comma", "wrong")):
        a_class.course(f"decimal: {decimal}\n")
        assert a_class.verdicts("1,234") == [verdict]


def test_intermediate_answers_are_graded_like_the_final_one(a_class: Class) -> None:
    """Four-bar 13.8 of Waldron, Kinzel and Agrawal: I24 at (-1.5139, 0), w4/w2 = 0.3396."""
    table = (
        "student_id,case,answer\n"
        'a,13_08_four_bar:I24,"(-1.51, 0)"\na,13_08_four_bar:w4/w2,0.34\na,13_08_four_bar:w4,0.34\n'
        'b,13_08_four_bar:I24,"(0, -1.51)"\nb,13_08_four_bar:w4/w2,2.945\n'
        'c,13_08_four_bar:I24,"(2.9444, 0) in"\nc,13_08_four_bar:w4/w2,-0.34\n'
        'd,13_08_four_bar:I24,"(-38.5, 0) mm"\nd,13_08_four_bar:I24-A,1.51 in\n'
        "e,13_08_four_bar:I24,at infinity toward 90\ne,13_08_four_bar:I24-A,nonsense\n"
    )
    file, cases = a_class.file("steps.csv", table), str(CASES / "ch13")
    ran = a_class.run("grade", file, "--cases", cases, "-o", "-", "--quiet")
    found = {(r["student_id"], r["case"].partition(":")[2]): (r["verdict"], r["code"]) for r in ran.rows()}
    right = {what for (student, what), (verdict, _) in found.items() if student == "a" and verdict == "right"}
    assert right >= {"I24", "w4/w2", "w4"}
    assert found["b", "I24"] == ("wrong", "swapped")
    assert found["b", "w4/w2"] == ("wrong", "inverse-ratio")
    assert found["c", "I24"] == ("wrong", "wrong-ic")
    assert found["c", "w4/w2"] == ("wrong", "sign")
    assert found["d", "I24"] == ("right", "")
    assert found["d", "I24-A"] == ("right", "")
    assert found["e", "I24"][0] == "wrong"
    assert found["e", "I24-A"] == ("invalid", "no-number")


def test_an_error_carried_forward_is_recognised(a_class: Class) -> None:
    """T2 = P * (arm about I14) * w4/w2: with a ratio 1.3 times too large the torque is so too."""
    case, ratio, torque = "13_08_four_bar", 0.33957 * 1.3, 29.672200960383297 * 1.3
    rows = (("a", f"{case}:w4/w2", ratio), ("a", case, torque), ("b", case, torque))
    table = "student_id,case,answer\n" + "".join(f"{who},{what},{value}\n" for who, what, value in rows)
    course = a_class.file("carried.yaml", "malrules: {carried: 100%}\n")
    cases = str(CASES / "ch13")
    file = a_class.file("a.csv", table)
    ran = a_class.run("grade", file, "--cases", cases, "--course", course, "-o", "-", "-q")
    first = ran.row("a", case)
    assert (first["verdict"], first["code"].split()[0], first["score"]) == ("wrong", "carried", "1")
    assert "w4/w2" in first["feedback"]
    assert "carried" not in ran.row("b", case)["code"]


@pytest.mark.parametrize(
    ("what", "given", "follows"),
    [
        ("I24", "(0, 1.8)", 300.0 / 1.8),
        ("I24-A", "1.8 in", 300.0 / 1.8),
        ("v C on 4", "60 in/s", 197.078254 * 47.8225160 / 60.0),
    ],
)
def test_an_error_carried_forward_to_a_slider(a_class: Class, what: str, given: str, follows: float) -> None:
    """P = T12 / I24-A = T12 w2 / v: by the right method from a wrong centre, distance or speed."""
    case = "slider_crank_offset"
    table = f'student_id,case,answer\na,{case}:{what},"{given}"\na,{case},{follows:.6g} lbf\n'
    file = a_class.file("a.csv", table)
    ran = a_class.run("grade", file, "--cases", str(CASES / "sliders"), "-o", "-", "-q")
    assert ran.row("a", f"{case}:{what}")["verdict"] == "wrong"
    assert ran.row("a", case)["code"].split()[0] == "carried"
    assert f"({what})" in ran.row("a", case)["feedback"]


BLOCK = (
    "icsolve: 1\npoints: {A: [0, 0]}\njoints:\n  - {slide: [2, 1], at: A, along: 0, mu: 0.2}\n"
    "loads:\n  N: {force: 100, link: 2, at: A, angle: -90}\n"
    "  P: {force: unknown, link: 2, at: A, angle: 0}\n"
)


def test_a_load_that_holds_over_a_range_asks_for_both_ends(a_class: Class) -> None:
    a_class.case("block", BLOCK)
    named = ("Pmin = -20 N, Pmax = 20 N", "min -20 max 20", "P_max=20 N and P_min=-20 N")
    named += ("|P| <= 20 N", "|P| < 0.02 kN", "|P|≤20")
    assert set(a_class.verdicts(*named, case="block")) == {"right"}
    answers = ("-20 N to 20 N", "20 to -20", "-20 lbf to 20 lbf", "20 N", "-20 N to 25 N")
    rows = a_class.judge(*answers, case="block")
    assert [(row["verdict"], row["code"]) for row in rows] == [
        ("right", ""), ("right", ""), ("wrong", "unit"), ("wrong", "one-end"), ("wrong", "one-end"),
    ]  # fmt: skip
    assert set(a_class.verdicts("|P| >= 20 N", "|P| <= -20 N", "|P| <= 20 N left", case="block")) == {
        "review"
    }
    told = "its lower end from -20.20 to -19.80 N and its upper end from 19.80 to 20.20 N"
    assert told in rows[0]["feedback"]


def test_a_range_with_an_open_end_is_answered_by_the_other(a_class: Class) -> None:
    """Any push 60 degrees into the guide locks; a pull of 70 / (cos 60 + 0.7 sin 60) = 63.28 N moves it."""
    a_class.case("block", BLOCK.replace("angle: 0}", "angle: -60}").replace("mu: 0.2", "mu: 0.7"))
    answers = {
        "P >= -63.3 N": "right", "P>=-63.3": "right", "-63.3 N or more": "right", "at least -63.3": "right",
        "P <= -63.3 N": "wrong",
        "-63.3 N": "wrong", "-63.3 N to 500 N": "wrong", "P >= 63.3 N": "wrong",
    }  # fmt: skip
    assert dict(zip(answers, a_class.verdicts(*answers, case="block"), strict=True)) == answers


UPRIGHT = """\
icsolve: 1
points: {A: [0, 0], G: [0.010471, 0.599909]}
joints: [{pin: [1, 2], at: A, mu: 0.3, radius: 0.1}]
loads:
  W: {weight: unknown, link: 2, at: G}
  T: {torque: -20, link: 2}
"""


def test_another_range_in_which_it_may_hold_is_for_a_person(a_class: Class) -> None:
    """A bar that all but stands upright holds under a weight of 20 / (r - c) and more, c = 0.010471 and
    r = 0.1 sin(atan 0.3), as it does when it is pulled up by 20 / (r + c): no weight pulls."""
    a_class.case("bar", UPRIGHT)
    circle = 0.1 * math.sin(math.atan(0.3))
    pulls, presses = -20.0 / (circle + 0.010471), 20.0 / (circle - 0.010471)
    answers = (f"W <= {pulls:.2f} N", f"W >= {presses:.1f} N", f"{presses:.1f} N or more", "W >= 900 N")
    assert a_class.verdicts(*answers, case="bar") == ["right", "review", "review", "wrong"]


def test_credit_is_given_for_the_parts_that_a_question_has(a_class: Class) -> None:
    """A ratio has neither unit nor direction, a centre no direction: what is not asked earns nothing."""
    a_class.course("points: 10\ncredit: {number: 60%, unit: 20%, direction: 20%}\n")
    a_class.case("gears", GEARS)
    for case, answers in (("gears:w3/w2", ("0.5", "0.7")), ("gears:I23", ("(-3, 0)", "(-3, 0) lbf"))):
        right, partly = a_class.judge(*answers, case=case)
        assert (right["score"], partly["score"]) == ("10", "0" if case == "gears:w3/w2" else "7.5")


def test_the_direction_of_a_reaction_is_judged_by_its_angle(a_class: Class) -> None:
    """F12, the force of the frame on the lever, is 100 N upward."""
    answers = {
        "100 N": "right", "100 N at 90 deg": "right", "100 N at -90 deg": "wrong", "100 N up": "review",
        "100 N down": "review", "80 N up": "wrong",
    }  # fmt: skip
    assert dict(zip(answers, a_class.verdicts(*answers, case="lever:F12"), strict=True)) == answers


BLOCK_IN_A_GUIDE = """\
icsolve: 1
points: {{A: [0, 0], C: [1, 1]}}
joints: [{{slide: [2, 1], at: A, along: {along}}}]
motion: {{point: A, link: 2, speed: 3, angle: {angle}}}
loads:
  P: {{force: unknown, link: 2, at: A, angle: {along}}}
  W: {{force: 20, link: 2, at: A, angle: {load}}}
"""


@pytest.mark.parametrize(("angle", "minus"), [(180, "review"), (-90, "review"), (0, "wrong"), (90, "wrong")])
def test_a_minus_on_a_size_may_be_that_of_a_component(a_class: Class, angle: int, minus: str) -> None:
    """A block that moves to the left at 3 has the velocity -3, though its speed is 3; the force of the guide
    is of the same kind. Moving to the right, or aslant, -3 can be no component that is right."""
    block = BLOCK_IN_A_GUIDE.format(along=angle % 180, angle=angle, load=angle + 30)
    a_class.case("block", block)
    answers = ("3", "-3", "-3 m/s", "-4")
    expected = ["right", minus, minus, "wrong"]
    assert a_class.verdicts(*answers, case="block:v A on 2") == expected
    across = {180: "wrong", -90: "review", 0: "review", 90: "wrong"}
    assert a_class.verdicts("10 N", "-10 N", case="block:F12") == ["right", across[angle]]


def test_a_minus_on_a_size_aslant_is_a_wrong_sense(a_class: Class) -> None:
    a_class.case("block", BLOCK_IN_A_GUIDE.format(along=30, angle=210, load=0))
    (row,) = a_class.judge("-3", case="block:v A on 2")
    assert (row["verdict"], row["code"]) == ("wrong", "sign")
    assert "Which way does the point move?" in row["feedback"]


def test_a_point_before_three_digits_may_divide_thousands(a_class: Class) -> None:
    a_class.case("lever", Path(a_class.path("cases/lever.yaml")).read_text().replace("100", "617"))
    assert a_class.verdicts("1.234", "1.234 kN*m", "1.235", "1.334") == ["review", "right", "review", "wrong"]
    a_class.course("decimal: point\n")
    assert a_class.verdicts("1.234") == ["wrong"]


def test_a_joule_is_no_unit_of_torque(a_class: Class) -> None:
    assert [(r["verdict"], r["code"]) for r in a_class.judge("200 J", "0.2 kJ")] == [("wrong", "unit")] * 2


@pytest.mark.parametrize("area", ["bore: 1e-200 m", "area: 1e-200 m^2"])
def test_a_pressure_on_next_to_nothing_is_next_to_no_force(a_class: Class, area: str) -> None:
    """What a zero is judged against: the square of the bore is no double, and 100 N is the largest load."""
    load = f"loads:\n  S: {{pressure: 1 MPa, {area}, link: 2, at: B, angle: 180}}"
    a_class.case(
        "zero", ZERO.replace("icsolve: 1", "icsolve: 1\nunits: {length: m, force: N}").replace("loads:", load)
    )
    assert a_class.verdicts("0", "0.19", "0.21", case="zero") == ["right", "right", "wrong"]


BAR = """\
icsolve: 1
points: {A: [0, 0]}
lengths: {AB: 2}
angles: {AB: {unknown: [-110, 80]}}
joints: [{pin: [1, 2], at: A}]
loads:
  S: {spring: 0.1, corner: AB, free: -90, link: 2}
  W: {force: 1, link: 2, at: B, angle: 0}
"""
FOUR_BAR = """\
icsolve: 1
units: {length: in, force: lbf, torque: lbf*in}
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 1, BC: 3.5, CD: 2.5, DE: 1.5}
angles: {AB: 60, CDE: 0}
near: {C: [3.5, 2.4]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads:
  P: {force: 100, link: 4, at: E, angle: 180}
  T4: {torque: 20, link: 4}
  T12: {torque: unknown, link: 2}
"""
_NO_QUANTITY = ("x", "F", "answer", "ans", "Value", "T_in", "R")
_OWN_NAMES = {
    "T12": ("T12", "T_12", "$T_{12}$", "T₁₂", "t12"), "w4/w2": ("w4/w2", "ω4/ω2", "ω_4/ω_2"),
    "I24": ("I24", "I42", "IC24"), "F34": ("F34", "F_34"), "F34x": ("F34x", "F_{34x}"), "F43x": ("F43x",),
    "I24-A": ("I24-A", "A-I24"),
}  # fmt: skip
_FURTHER_NAMES = {"P", "T4", "M12", "I13", "F23", "F34y", "w3"}
_OF_ITS_KIND = {"T12": {"T14", "T_21"}, "w4/w2": {"w7/w2"}, "F34x": {"F84x"}}


@pytest.mark.parametrize("what", _OWN_NAMES)
def test_an_answer_under_the_name_of_another_quantity_is_for_a_person(a_class: Class, what: str) -> None:
    """The right value under each name: the own one and one of no quantity leave it right, that of any other
    quantity of the case, or of one of its kind, may say another thing."""
    a_class.case("press", FOUR_BAR)
    task = Task(a_class.path("cases/press.yaml"))
    right, own = task.right(what), _OWN_NAMES[what]
    others = {name for names in _OWN_NAMES.values() for name in names} | _FURTHER_NAMES
    others |= _OF_ITS_KIND.get(what, set()) | {f"{what}/2", f"{what}/P", f"w3/{what}"}
    for form in ("{} = {}", "{}: {}", "the answer is {} = {}"):
        for name in own + _NO_QUANTITY:
            judged = task.grade(what, form.format(name, right))
            unread = what == "I24" and judged["verdict"] == "review" and judged["code"] != "other-quantity"
            assert judged["verdict"] == "right" or unread, (form, name)
        for name in others - set(own):
            judged = task.grade(what, form.format(name, right))
            assert judged["verdict"] == "review", (form, name)


@pytest.mark.parametrize(
    "form", ["{} = {} N to {} N", "{}min = {}, {}max = {}", "{1} N < {0} < {2} N", "{} >= {}"]
)
def test_a_range_under_the_name_of_another_load_is_for_a_person(a_class: Class, form: str) -> None:
    a_class.case("block", BLOCK)
    low, high = ("-20", "20")
    found = []
    for name in ("P", "F", "N"):
        ends = (name, low, name, high) if form.count("{") == 4 and "{}max" in form else (name, low, high)
        found += a_class.judge(form.format(*ends), case="block")
    known = "wrong" if form == "{} >= {}" else "right"
    assert [row["verdict"] for row in found] == [known, known, "review"]


def _told(key: AnyKey) -> list[float]:
    """The numbers of the accepted band as it is told."""
    return [float(text) for text in re.findall(r"(?<![\w.])-?\d[\d.]*(?:[eE][-+]?\d+)?", key.accepted)]


def test_both_ends_of_a_band_that_is_told_are_accepted() -> None:
    """Of numbers of every size, with bands from a millionth of them to all of them; and they tell nine tenths
    of the band at least."""
    rng = random.Random(20261126)
    for _ in range(400):
        value = rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-20.0, 20.0)
        half = abs(value) * 10.0 ** rng.uniform(-6.0, 0.0) * (1.0 + SLACK)
        low, high = map(float, re.findall(r"\d[\d.]*(?:[eE][-+]?\d+)?", range_in_words(value, half, "")))
        assert abs(low - abs(value)) <= half and abs(high - abs(value)) <= half, (value, half, low, high)
        assert high - low >= 1.8 * half


@pytest.mark.parametrize("tolerance", ["1%", "3 sf", "0.3 lbf*in", "{drawing: 0.02 in}"])
def test_what_is_told_to_be_accepted_is_right_and_what_lies_beyond_is_not(
    a_class: Class, tolerance: str
) -> None:
    a_class.case("press", FOUR_BAR + f"tolerance: {tolerance}\n")
    store = CaseStore(a_class.path("cases/press.yaml"), Course())
    key, task = store.key("press"), Task(a_class.path("cases/press.yaml"))
    assert isinstance(key, NumberKey)
    low, high = _told(key)
    way = "cw" if key.value < 0.0 else "ccw"
    beyond = 0.11 * key.half
    found = [
        task.grade("", f"{end:.8g} {way}")["verdict"] for end in (low, high, low - beyond, high + beyond)
    ]
    assert found == ["right", "right", "wrong", "wrong"]


def test_of_a_range_an_angle_and_a_place_the_accepted_numbers_are_told(a_class: Class) -> None:
    a_class.case("block", BLOCK)
    a_class.case("bar", BAR)
    a_class.case("press", FOUR_BAR)
    a_class.case("wedge", (CASES / "sliders" / "wedge.yaml").read_text())
    store = CaseStore(a_class.path("cases"), Course())
    low, low_high, high, high_high = _told(store.key("block"))
    ends = [(low, high), (low, high_high), (low_high, high), (low_high, high_high)]
    assert set(a_class.verdicts(*(f"{a} to {b}" for a, b in ends), case="block")) == {"right"}
    bar = store.key("bar")
    assert isinstance(bar, NumberKey) and bar.value < 0.0
    assert set(a_class.verdicts(*map(str, _told(bar)), case="bar")) == {"right"}
    place = store.key("press:I24")
    assert isinstance(place, PlaceKey)
    (width,), (x, y) = _told(place), place.place
    assert (
        a_class.verdicts(f"({x + width!r}, {y!r})", f"({x!r}, {y - width!r})", case="press:I24")
        == ["right"] * 2
    )
    assert store.key("wedge:I23").accepted == "at infinity within 1 deg of its direction"


def _questions(name: str) -> list[str]:
    """Names of what `solve` tells of a case, as ``expect`` has them, one of a kind."""
    case = icsolve.load(FILES[name])
    if case.space is not None or case.variables or case.unknowns:
        return []
    found = icsolve.solve(case, rates=True, reactions=True)
    loads = {load.name for load in case.loads}
    forces = {own: one for own, one in (found.reactions or {}).items() if own not in loads}
    kinds = [
        list(found.answers),
        [f"I{a}-{b}" for (a, b), centre in found.centres.items() if centre.kind in ("at", "toward")],
        [f"w{link}" for link, rate in (found.rates or {}).items() if isinstance(rate, float) and rate],
        [f"v {p} on {link}" for (p, link), v in (found.velocities or {}).items() if not isinstance(v, str)],
        [own for own, one in forces.items() if one.magnitude is not None and own not in loads],
        [
            f"normal {own}"
            for own, one in forces.items()
            if dict(one.parts).get("normal") and own not in loads
        ],
        [f"T {one.rope}" for one in found.tensions if one.tension],
    ]
    return [kind[0] for kind in kinds if kind]


@pytest.mark.parametrize("name", sample(FILES, 4, "names of questions"))
def test_an_answer_may_begin_with_the_name_of_its_question(name: str) -> None:
    """Also where that has several words, or hyphens: such answers waited for a person."""
    names = _questions(name)
    task = Task(FILES[name]) if names else None
    for what in names:
        assert task is not None
        right = task.right(what)
        for answer in (right, f"{what} = {right}", f"{what}={right} ."):
            assert task.grade(what, answer)["verdict"] == "right", (what, answer)


@pytest.mark.parametrize("name", ["push", "up", "left", "cw"])
def test_the_name_of_a_load_is_no_direction(name: str, tmp_path: Path) -> None:
    """24 down, the load so called."""
    file = tmp_path / "lever.yaml"
    file.write_text(
        "icsolve: 1\npoints: {A: [0, 0], B: [2, 0], C: [-1, 0]}\njoints: [{pin: [1, 2], at: A}]\n"
        "loads:\n  W: {weight: 12, link: 2, at: B}\n"
        f"  {name}: {{force: unknown, link: 2, at: C, angle: -90}}\n"
    )
    task = Task(file)
    assert task.grade("", f"{name} = 24 N")["verdict"] == "right"
    assert task.grade("", f"{name} = 24 N up")["verdict"] == "wrong"
    assert task.grade("", f"{name} = 12 N")["verdict"] == "wrong"


CRATE = """\
icsolve: 1
points: {A: [0, 0]}
joints: [{slide: [2, 1], at: A, along: 30, mu: 0.3}]
loads:
  W: {weight: 100, link: 2, at: A}
  P: {force: unknown, link: 2, at: A, angle: 30}
"""


@pytest.mark.parametrize(
    ("case", "question", "form"),
    [
        ("linkages/four_bar", "T12", "a number, a unit and a direction"),
        ("linkages/four_bar", "I24", "two coordinates"),
        ("linkages/four_bar", "w4/w2", "a number"),
        ("linkages/four_bar", "I24-A", "a number and a unit"),
        ("equilibrium/lamp_arm", "", "a number and a unit"),
        ("equilibrium/boom_by_its_cylinder", "", "a number and a unit"),
        ("springs/balanced_arm", "", "a number and a unit"),
        ("", "", "both ends"),
    ],
)
def test_what_cannot_be_read_is_told_how_to_write_in_a_form_that_is_read(
    case: str, question: str, form: str, tmp_path: Path
) -> None:
    """A centre has two coordinates, a position no sense: the example has the parts of the question asked."""
    (tmp_path / "crate.yaml").write_text(CRATE)
    task = Task(CASES / f"{case}.yaml" if case else tmp_path / "crate.yaml")
    told = task.grade(question, "18 something")
    assert told["code"] == "unread"
    advice = re.search(r"Write ([^']*), such as '([^']*)'\.", told["feedback"])
    assert advice is not None and advice[1] == form
    assert task.grade(question, advice[2])["verdict"] in ("right", "wrong")


@pytest.mark.parametrize(
    ("given", "verdict"), [(None, "missing"), (200, "right"), (200.0, "right"), (-200, "wrong")]
)
def test_a_task_takes_what_a_form_hands_over(a_class: Class, given: float | None, verdict: str) -> None:
    assert Task(a_class.path("cases/lever.yaml")).grade("", given)["verdict"] == verdict


@pytest.mark.parametrize("said", ["|T12| = {}", "|T12| = {} lbf*in", "magnitude {}", "size {} lbf*in"])
def test_a_size_is_no_wrong_sense(said: str, tmp_path: Path) -> None:
    """What is written as a size says nothing of its sense: a person decides where the sense may be the
    other, and a wrong size is wrong."""
    (tmp_path / "press.yaml").write_text(PLAIN_PRESS)
    press = Task(tmp_path / "press.yaml")
    found = press.grade("", said.format(33.758))
    assert (found["verdict"], found["code"]) == ("review", "size-alone")
    assert press.grade("", said.format(43.9))["verdict"] == "wrong"
    (tmp_path / "gears.yaml").write_text(GEARS.replace("torque: 10", "torque: -10"))
    assert (
        Task(tmp_path / "gears.yaml").grade("", said.format(5).replace("lbf*in", "N*m"))["verdict"] == "right"
    )


@pytest.mark.parametrize("number", ["5", "-5"])
def test_a_minus_in_brackets_is_read_as_no_plus(number: str, tmp_path: Path) -> None:
    """``5 (-)`` may be -5 where the answer has a unit; of a ratio it is the unit."""
    (tmp_path / "gears.yaml").write_text(GEARS)
    gears = Task(tmp_path / "gears.yaml")
    assert gears.grade("", f"{number} (-)")["verdict"] == ("review" if number == "5" else "right")
    assert gears.grade("w3/w2", "0.5 (-)")["verdict"] == "right"


@pytest.mark.parametrize(
    ("place", "verdict"),
    [
        ("on link 2", "right"),
        ("on Link 2", "right"),
        ("acting on the link 2", "right"),
        ("at A", "right"),
        ("on the crank", "right"),  # no link of the case is called so
        ("on link 4", "review"),
        ("(on link 4)", "review"),
        ("on the frame", "review"),
        ("at D", "review"),
    ],
)
def test_what_acts_on_another_link_waits_for_a_person(place: str, verdict: str, tmp_path: Path) -> None:
    (tmp_path / "press.yaml").write_text(PLAIN_PRESS)
    assert Task(tmp_path / "press.yaml").grade("", f"33.758 lbf*in cw {place}")["verdict"] == verdict


@pytest.mark.parametrize(("place", "verdict"), [("on link 4", "right"), ("on link 3", "review")])
def test_a_reaction_is_the_force_on_its_second_link(place: str, verdict: str) -> None:
    task = Task(CASES / "linkages/four_bar.yaml")
    force = icsolve.solve(icsolve.load(CASES / "linkages/four_bar.yaml"), reactions=True).to_dict()
    size = math.hypot(force["reactions"]["F34"]["x"], force["reactions"]["F34"]["y"])
    assert task.grade("F34", f"{size:.6g} N {place}")["verdict"] == verdict
