"""Known mistakes: looked up by value, the simplest first, none within tolerance of the right answer."""

from __future__ import annotations

import math
import random
from pathlib import Path

import pytest

import icsolve
from grade_mistakes import mistakes
from grade_shell import CASES, Class
from icsolve.case.expected import LoadIs
from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Course
from icsolve.grade.judge import judge_answer
from icsolve.grade.keys import NumberKey
from icsolve.grade.mistakes.changed import changed_figures
from icsolve.grade.mistakes.engine import WrongAnswers, shares
from icsolve.grade.mistakes.engine import solved_for as solved
from icsolve.grade.mistakes.lookup import CODES, Wrong, Wrongs, message, near_miss
from icsolve.grade.written.answer import Reader
from library import FILES, sample
from sizes import sampled

CAM = """\
icsolve: 1
units: {length: mm, force: N, torque: N*mm}
points: {A: [0, 0], B: [0, unknown]}
lengths: {AC: 20}
angles: {AC: 40}
near: {B: [0, 500]}
profile:
  2: {circle: C, radius: 40}
  3: {flat: B, along: 0}
joints:
  - {pin: [1, 2], at: A}
  - {contact: [2, 3]}
  - {slide: [3, 1], at: B, along: 90}
links: {2: [C]}
loads:
  P: {force: 100, link: 3, at: B, angle: -90}
  T12: {torque: unknown, link: 2}
"""
"""An eccentric disk under a flat follower: T12 = P e cos 40."""


def wrong_answers(answer: icsolve.Answer) -> dict[str, list[Wrong]]:
    """The wrong answers of every unknown load."""
    wrongs = WrongAnswers(answer)
    return {name: wrongs.of(LoadIs(name)) for name in answer.answers}


@pytest.fixture
def a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    return Class(tmp_path, capsys)


def test_the_nearest_of_each_code_simplest_first() -> None:
    wrongs = Wrongs(
        lambda: [Wrong("double", 200.0), Wrong("wrong-ic", 199.5, "I24"), Wrong("wrong-ic", 199.0)],
        100.0,
        1.0,
    )
    assert [(w.code, w.where) for w in wrongs.near(199.6)] == [("wrong-ic", "I24"), ("double", "")]
    assert wrongs.near(150.0) == ()
    assert wrongs.near(math.inf) == ()


def test_a_wrong_answer_within_tolerance_of_the_right_one_is_dropped() -> None:
    wrongs = Wrongs(
        lambda: [Wrong("no-cos", 100.9), Wrong("half", 50.0), Wrong("sin-cos", math.nan)], 100.0, 1.0
    )
    assert [w.code for w in wrongs.all] == ["half"]


def test_two_causes_that_coincide_are_both_named(a_class: Class) -> None:
    """Two equal loads side by side: without one of them the answer is half."""
    text = a_class.path("cases/lever.yaml").read_text()
    a_class.case("lever", text.replace("  T:", "  W: {weight: 100, link: 2, at: B}\n  T:"))
    (row,) = a_class.judge("200")
    assert row["code"].split() == ["missed-load", "half"]
    assert "missing (P)" in row["feedback"]
    assert "Half the right size" in row["feedback"]


def test_the_other_ways_to_assemble_that_are_tried_are_few() -> None:
    """Ten links that are found together have mirror images by every two lengths of a point."""
    case = icsolve.load(Path(__file__).parent / "data" / "found" / "wrongmode_1.yaml")
    codes = [changed.code for changed in changed_figures(case, solved(case))]
    assert 4 <= codes.count("other-mode") <= 12


def test_shares_of_the_loads_add_up_to_the_unknown() -> None:
    for path in (FILES[name] for name in sample(FILES, 3, "shares")):
        try:
            answer = solved(icsolve.load(path))
        except icsolve.SceneError:
            continue
        for name, found in answer.answers.items():
            parts = shares(answer, name)
            if parts and not any(getattr(joint, "friction", None) for joint in answer.case.joints):
                assert sum(parts.values()) == pytest.approx(found.value, rel=1e-9), path


def test_every_case_of_the_library_gets_its_wrong_answers() -> None:
    """No rule fails on any joint or load, and each case has dozens of wrong answers."""
    for name in sample(FILES, 6, "wrong answers"):
        try:
            answer = solved(icsolve.load(FILES[name]))
        except icsolve.SceneError:
            continue
        for wrongs in wrong_answers(answer).values():
            assert len(wrongs) > 30
            assert {w.code for w in wrongs} <= set(CODES)


def test_a_message_names_the_cause_and_the_place() -> None:
    assert message("missed-load", "P").endswith("missing (P).")
    assert message("wrong-ic", "I24").startswith(
        "A distance is taken from another centre of the same link (I24)"
    )
    assert all("{" not in message(code) for code in CODES)


def test_friction_left_out_or_turned_is_recognised() -> None:
    """A block of 100 N on the level, mu = 0.2, pulled to the right: 20 N; the other way -20 N; without, 0."""
    text = (
        "icsolve: 1\npoints: {A: [0, 0]}\njoints:\n  - {slide: [2, 1], at: A, along: 0, mu: 0.2}\n"
        "loads:\n  N: {force: 100, link: 2, at: A, angle: -90}\n"
        "  F: {force: 50, link: 2, at: A, angle: 180}\n"
        "  P: {force: unknown, link: 2, at: A, angle: 0}\nmotion: {point: A, link: 2, speed: 1, angle: 0}\n"
    )
    answer = solved(icsolve.load(text))
    assert answer.answers["P"].value == pytest.approx(70.0)
    found = {w.code: w.value for w in wrong_answers(answer)["P"]}
    assert found["no-friction"] == pytest.approx(50.0)
    assert found["friction-sense"] == pytest.approx(30.0)


def test_a_size_without_a_sign_is_looked_up_in_both_senses(a_class: Class) -> None:
    """The answer is negative; 'half, and no sign' is still half."""
    text = a_class.path("cases/lever.yaml").read_text()
    a_class.case("lever", text.replace("link: 2}\n", "link: 2, turns: cw}\n"))
    rows = a_class.judge("-200", "200", "100")
    assert [(r["verdict"], r["code"]) for r in rows] == [("right", ""), ("wrong", "sign"), ("wrong", "half")]


def test_wrong_answers_wait_until_they_are_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """A right answer costs one solution of the case."""
    calls: list[str] = []
    monkeypatch.setattr(WrongAnswers, "of", lambda *given: calls.append("made") or [])
    key = CaseStore(CASES, Course()).key("13_08_four_bar")
    assert isinstance(key, NumberKey)
    assert calls == []
    assert key.wrongs.near(5.0) == ()
    assert calls == ["made"]


def named(case: str, unknown: str, code: str) -> list[tuple[float, str]]:
    """The wrong answers of a code for a case of the library, with where the mistake sits."""
    (path,) = CASES.rglob(f"{case}.yaml")
    return [(w.value, w.where) for w in wrong_answers(solved(icsolve.load(path)))[unknown] if w.code == code]


def test_the_crank_taken_for_the_distance_to_the_centre_of_a_slider() -> None:
    """P = T12 / I12-I24; with I12-I23, the crank of 2 in, 300 lbf*in give 150 lbf."""
    assert any(value == pytest.approx(150.0) for value, _ in named("slider_crank_offset", "P", "wrong-ic"))


def test_an_annulus_taken_for_an_outer_wheel() -> None:
    """w4/w2 = 24/(24 - 60) in place of 24/84: 10 N*m ask for 15 N*m the other way."""
    found = named("epicyclic_train", "T14", "mesh-sense")
    assert any(value == pytest.approx(15.0) for value, _ in found)


def test_one_unknown_taken_for_the_other() -> None:
    (path,) = CASES.rglob("five_bar.yaml")
    answers = solved(icsolve.load(path)).answers
    assert named("five_bar", "T12", "other-unknown") == [(answers["T15"].value, "T15")]
    assert message("other-unknown", "T15") == "This is the size of another unknown (T15)."


def test_a_ratio_upside_down_with_two_unknowns() -> None:
    """Each known torque asks of each unknown a ratio of its own."""
    (path,) = CASES.rglob("differential_train.yaml")
    answer = solved(icsolve.load(path))
    (known,) = [load for load in answer.case.loads if load.name not in answer.answers]
    number = known.value.value  # type: ignore[union-attr]
    for name, found in answer.answers.items():
        ((value, where),) = named("differential_train", name, "inverse-ratio")
        assert value == pytest.approx(number**2 / found.value)
        assert where == f"{name} and {known.name}"


def test_the_direction_of_a_guide_in_radians() -> None:
    """A block on a guide at 30 degrees, pushed level: P cos 30 = Q; with 30 rad, |cos| = 0.154."""
    text = (
        "icsolve: 1\npoints: {A: [0, 0]}\njoints:\n  - {slide: [2, 1], at: A, along: 30}\n"
        "loads:\n  P: {force: 100, link: 2, at: A, angle: 180}\n"
        "  Q: {force: unknown, link: 2, at: A, slope: [4, 3]}\n"
    )
    found = [w.value for w in wrong_answers(solved(icsolve.load(text)))["Q"] if w.code == "deg-rad"]
    c, s = math.cos(30.0), math.sin(30.0)
    assert any(value == pytest.approx(100.0 * c / (0.8 * c + 0.6 * s)) for value in found)


def test_a_cam_with_a_profile_gets_its_wrong_answers(a_class: Class) -> None:
    a_class.case("cam", CAM)
    right = 2000.0 * math.cos(math.radians(40.0))
    rows = a_class.judge(f"{right:.6g}", f"{-right:.6g}", f"{right / 2:.6g}", case="cam")
    assert [(r["verdict"], r["code"].split(" ")[0]) for r in rows] == [
        ("right", ""), ("wrong", "sign"), ("wrong", "half"),
    ]  # fmt: skip


TRAIN = """\
icsolve: 1
points: {A: [0, 0], B: [3, 0], C: [8, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {pin: [1, 4], at: C}
  - {gears: [2, 3], teeth: [20, 50]}
  - {gears: [3, 4], teeth: [18, 63]}
loads:
  M4: {torque: 70, link: 4}
  M3: {torque: 11, link: 3}
  T2: {torque: unknown, link: 2}
motion: {link: 2, speed: 120 rpm}
"""
"""w3/w2 = -0.4, w4/w3 = -2/7: T2 = -70 (0.8/7) + 11 (0.4) = -8 + 4.4 = -3.6 N*m."""
CRANKS = """\
icsolve: 1
points: {A: [0, 0], B: [0.3, 0.4], C: [0.7, 0.2]}
joints:
  - {pin: [1, 2], at: A}
loads:
  P: {force: 100, link: 2, at: B, angle: 25}
  Q: {force: 40, link: 2, at: C, angle: -70}
  T: {torque: unknown, link: 2}
"""


def codes(a_class: Class, case: str, values: dict[str, float]) -> dict[str, list[str]]:
    """The codes of the answers of one case, each with the name under which it is listed."""
    rows = a_class.judge(*(f"{value:.5g}" for value in values.values()), case=case)
    return {name: row["code"].split() for name, row in zip(values, rows, strict=True)}


def test_wrong_steps_of_a_gear_train_are_named(a_class: Class) -> None:
    a_class.case("train", TRAIN)
    found = codes(a_class, "train", {
        "ratio-one": 70.0 + 4.4, "ratio-one ": -8.0 - 11.0,
        "missed-stage": -70.0 * (-0.4) * (-1.0) + 4.4, "missed-stage ": -20.0 + 4.4,
        "missed-load": -8.0, "load-sense": -12.4,
    })  # fmt: skip
    assert {name for name, given in found.items() if name.strip() not in given} == set()


@sampled(3)
@pytest.mark.parametrize("seed", range(6))
def test_a_drive_upside_down_is_named_behind_a_rope_too(seed: int, a_class: Class) -> None:
    """What hangs on a drum has no rate of its own to turn over: the ratio is that of its drum and the other,
    and of a train it may be that of one stage."""
    draw = random.Random(f"drive {seed}")
    teeth, height = draw.sample(range(17, 60), 2), draw.randint(10, 40) / 100.0
    drive = draw.choice(
        [f"gears: [2, 3], teeth: {teeth}", f"belt: [2, 3], radii: {[n / 100 for n in teeth]}"]
    )
    a_class.case(
        "hoist",
        f"""icsolve: 1
points: {{O: [0, 0], Q: [2, 0.4], B: [{2 + height}, -2]}}
joints:
  - {{pin: [1, 2], at: O}}
  - {{pin: [1, 3], at: Q}}
  - {{{drive}}}
  - {{rope: [Q, B], on: [3], radii: {{Q: {height}}}, wraps: {{Q: cw}}}}
loads:
  W: {{weight: 500, at: B}}
  T: {{torque: unknown, link: 2}}
""",
    )
    sign = -1.0 if "gears" in drive else 1.0
    found = codes(a_class, "hoist", {"inverse-ratio": sign * 500.0 * height * teeth[1] / teeth[0]})
    assert "inverse-ratio" in found["inverse-ratio"]
    a_class.case("train", TRAIN)
    stages = {"first": -70.0 * 2.5 * 2.0 / 7.0 + 11.0 * 2.5, "second": -70.0 * 0.4 * 3.5 + 4.4}
    assert all("inverse-ratio" in given for given in codes(a_class, "train", stages).values())


def test_revolutions_a_minute_taken_for_radians_a_second(a_class: Class) -> None:
    a_class.case("train", TRAIN)
    found = codes(a_class, "train:w3", {"rpm": -48.0})
    assert found["rpm"] == ["rpm"]


def moments(p: float, q: float, px: float = 1.0, py: float = 1.0) -> float:
    """T of the two forces at the crank, of P by its components times ``px`` and ``py``."""
    a, b = math.radians(p), math.radians(q)
    by_p = 100.0 * (px * -0.4 * math.cos(a) + py * 0.3 * math.sin(a))
    return -(by_p + 40.0 * (0.7 * math.sin(b) - 0.2 * math.cos(b)))


def test_one_angle_or_one_component_taken_wrong_is_named(a_class: Class) -> None:
    a_class.case("crank", CRANKS)
    found = codes(a_class, "crank", {
        "deg-rad": moments(math.degrees(25.0), -70.0), "sin-cos": moments(65.0, -70.0),
        "angle-sense": moments(-25.0, -70.0), "one-component": moments(25.0, -70.0, px=0.0),
        "one-component ": moments(25.0, -70.0, py=0.0),
    })  # fmt: skip
    assert {name for name, given in found.items() if name.strip() not in given} == set()


def test_two_mistakes_at_once_are_named_by_both(a_class: Class) -> None:
    """A load missed and the sign lost; a component alone, the other load reversed; mm taken for m on top."""
    a_class.case("crank", CRANKS)
    by_q = -40.0 * (0.7 * math.sin(math.radians(-70.0)) - 0.2 * math.cos(math.radians(-70.0)))
    right = moments(25.0, -70.0)
    rows = a_class.judge(
        f"{-(right - by_q):.5g}",
        f"{moments(25.0, -70.0, px=0.0) - 2.0 * by_q:.5g}",
        f"{1000.0 * by_q:.5g}",
        case="crank",
    )
    named = [set(row["code"].split()) for row in rows]
    assert named[0] == {"sign", "missed-load"}
    assert named[1] == {"one-component", "load-sense"}
    assert named[2] == {"power-of-ten", "missed-load"}
    assert all(row["feedback"].startswith("Two mistakes at once: ") for row in rows)


def test_a_random_number_seldom_gets_a_cause(a_class: Class) -> None:
    """Of numbers even up to three times the right one at most 8 %."""
    rng = random.Random(5)
    a_class.case("crank", CRANKS)
    right = moments(25.0, -70.0)
    factors = [f for f in (rng.uniform(-3.0, 3.0) for _ in range(1500)) if abs(f - 1.0) > 0.04]
    rows = a_class.judge(*(f"{right * f:.4g}" for f in factors), case="crank")
    named = [row for row in rows if row["verdict"] == "wrong" and row["code"]]
    assert len(named) <= 0.08 * len(rows)


def test_a_message_fits_the_question(a_class: Class) -> None:
    """A centre is not told of the signs of loads."""
    folder = str(CASES / "ch13" / "13_08_four_bar.yaml")
    table = 'student_id,case,answer\na,13_08_four_bar:I24,"(1.5139, 0)"\nb,13_08_four_bar:w4/w2,-0.34\n'
    file = a_class.file("steps.csv", table)
    ran = a_class.run("grade", file, "--cases", folder, "-o", "-", "--quiet")
    assert "a coordinate has the wrong sign" in ran.row("a", "13_08_four_bar:I24")["feedback"]
    assert "Do the two links turn the same way?" in ran.row("b", "13_08_four_bar:w4/w2")["feedback"]


TWO = """\
icsolve: 1
points: {A: [0, 0], B: [3, 0], C: [20, 0], D: [23, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {pin: [1, 4], at: C}
  - {pin: [1, 5], at: D}
  - {gears: [2, 3], teeth: [20, 50]}
  - {gears: [4, 5], teeth: [30, 45]}
loads:
  M3: {torque: 10, link: 3}
  M5: {torque: 6, link: 5}
  T2: {torque: unknown, link: 2}
  T4: {torque: unknown, link: 4}
"""
"""T2 = 0.4 M3 = 4 N*m, T4 = 2/3 M5 = 4 N*m."""


def test_errors_are_carried_forward_to_one_of_two_unknowns(a_class: Class) -> None:
    """w3/w2 = -0.5 for -0.4: T2 = 5 by the right method; T4 hangs on another ratio."""
    a_class.case("two", TWO)
    rows = ("a,two:w3/w2,-0.5", "a,two:T2,5", "a,two:T4,4", "b,two:T2,5")
    ran = a_class.grade("student_id,case,answer\n" + "\n".join(rows) + "\n")
    found = {(row["student_id"], row["case"]): (row["verdict"], row["code"]) for row in ran.rows()}
    assert found["a", "two:T2"][1].split()[0] == "carried"
    assert found["a", "two:T4"][0] == "right"
    assert "carried" not in found["b", "two:T2"][1]


def test_errors_are_carried_forward_through_friction(a_class: Class) -> None:
    """Of the shares that add up to T12 some are those of friction, which no load has."""
    a_class.case("slider", (CASES / "ch13/13_16_slider_crank_with_friction.yaml").read_text())
    store = CaseStore(a_class.path("cases"), Course())
    ratio, torque = (store.key(f"slider{what}") for what in (":w3/w2", ""))
    assert isinstance(ratio, NumberKey) and isinstance(torque, NumberKey)
    given = f"1,slider:w3/w2,{1.7 * ratio.value:.6g}\n1,slider,{1.7 * torque.value:.6g}\n"
    assert a_class.grade(f"student_id,case,answer\n{given}").row("1", "slider")["code"] == "carried"


@pytest.mark.parametrize(
    ("name", "first", "second", "of_first"),
    [
        # link 2 held: Q goes round B, 180 to the left and 360 up, and 360 Qx + 180 Qy balances P
        ("linkages/pantograph", "Qx", "Qy", -2.0),
        # the train turned as a whole: the three torques add up to nothing
        ("gears/differential_train", "T12", "T15", -1.0),
        # the motion of the case, w5 = 2 w2: T12 + 2 T15 and the power of P add up to nothing
        ("linkages/five_bar", "T12", "T15", -0.5),
    ],
)
def test_the_second_of_two_unknowns_follows_from_a_wrong_first(
    a_class: Class, name: str, first: str, second: str, of_first: float
) -> None:
    """The first off by 30 %, the second as the equation has it that holds both; not without the first, nor
    where it does not follow; a right second stays right, and the first keeps its own causes."""
    path = CASES / f"{name}.yaml"
    case, answers = path.stem, icsolve.solve(icsolve.load(path)).answers
    off = 0.3 * answers[first].value
    one, two = answers[first].value + off, answers[second].value + of_first * off
    rows = [
        ("a", first, one), ("a", second, two), ("b", second, two), ("c", first, one),
        ("c", second, 1.37 * two), ("d", first, one), ("d", second, answers[second].value),
        ("e", first, -answers[first].value), ("e", second, two - 2.3 * of_first * off / 0.3),
    ]  # fmt: skip
    lines = [f"{student},{case}:{what},{value:.6g}\n" for student, what, value in rows]
    table = a_class.file("x.csv", "".join(["student_id,case,answer\n", *lines]))
    ran = a_class.run("grade", table, "--cases", str(path), "-o", "-", "--quiet")
    found = {(row["student_id"], row["case"].partition(":")[2]): row for row in ran.rows()}
    assert found["a", second]["code"].split()[0] == "carried"
    assert f"earlier answer ({first})" in found["a", second]["feedback"]
    assert found["e", second]["code"].split()[0] == "carried"
    assert "carried" not in found["a", first]["code"]
    assert "carried" not in found["b", second]["code"]
    assert "carried" not in found["c", second]["code"]
    assert found["d", second]["verdict"] == "right"
    assert found["e", first]["code"].split()[0] == "sign"


BLOCK = """\
icsolve: 1
points: {A: [0, 0]}
joints:
  - {slide: [2, 1], at: A, along: 0, mu: 0.2}
loads:
  N: {force: 100, link: 2, at: A, angle: -90}
  F: {force: 50, link: 2, at: A, angle: 180}
  P: {force: unknown, link: 2, at: A, angle: 0}
motion: {point: A, link: 2, speed: 1, angle: 0}
"""
"""P = 50 + 0.2 * 100 = 70 N."""
ANNULUS = """\
icsolve: 1
points: {A: [0, 0], B: [40, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {gears: [2, 3], teeth: [20, -60]}
loads:
  M: {torque: 11, link: 3}
  T: {torque: unknown, link: 2}
"""
"""w3/w2 = 1/3: T = -11/3 N*m."""


def modelled() -> dict[str, tuple[str, str, float, str]]:
    """33 kinds of mistakes: the case, what is asked, the wrong answer by plain mechanics, its code."""
    p, q, right = 25.0, -70.0, moments(25.0, -70.0)
    by_q = -40.0 * (0.7 * math.sin(math.radians(q)) - 0.2 * math.cos(math.radians(q)))
    by_p, whole = right - by_q, math.copysign(50.0, right - by_q)  # the arm of P is 0.5 m
    square = math.sqrt(50.0**2 - by_p**2)
    found = {
        "wrong sense": ("crank", "", -right, "sign"),
        "mm for m": ("crank", "", 1000.0 * right, "power-of-ten"),
        "kN for N": ("crank", "", right / 1000.0, "power-of-ten"),
        "in and mm": ("crank", "", 25.4 * right, "unit-factor"),
        "ft and in": ("crank", "", right / 12.0, "unit-factor"),
        "lb and N": ("crank", "", 4.448 * right, "unit-factor"),
        "kg and N": ("crank", "", right / 9.81, "unit-factor"),
        "counted twice": ("crank", "", 2.0 * right, "double"),
        "counted by half": ("crank", "", right / 2.0, "half"),
        "rounded on the way": ("crank", "", 1.02 * right, "near-miss"),
        "a load missed": ("crank", "", by_q, "missed-load"),
        "a load reversed": ("crank", "", by_q - by_p, "load-sense"),
        "calculator in radians": ("crank", "", moments(math.degrees(p), math.degrees(q)), "deg-rad"),
        "one angle in radians": ("crank", "", moments(math.degrees(p), q), "deg-rad"),
        "sine for cosine": ("crank", "", moments(90.0 - p, q), "sin-cos"),
        "angle the other way round": ("crank", "", moments(-p, q), "angle-sense"),
        "one component, x": ("crank", "", moments(p, q, py=0.0), "one-component"),
        "one component, y": ("crank", "", moments(p, q, px=0.0), "one-component"),
        "force times the whole arm": ("crank", "", by_q + whole, "no-cos"),
        "component along the arm": ("crank", "", by_q + math.copysign(square, by_p), "sin-cos"),
        "sign, and a load missed": ("crank", "", -by_q, "sign missed-load"),
        "mm for m, and a load missed": ("crank", "", 1000.0 * by_q, "power-of-ten missed-load"),
        "ratio taken as 1": ("train", "", 70.0 + 4.4, "ratio-one"),
        "ratio upside down": ("train", "", -70.0 / (0.8 / 7.0) + 4.4, "inverse-ratio"),
        "first stage forgotten": ("train", "", -70.0 * 2.0 / 7.0 + 4.4, "missed-stage"),
        "second stage forgotten": ("train", "", -70.0 * 0.4 + 4.4, "missed-stage"),
        "rpm for rad/s": ("train", "w3", -48.0, "rpm"),
        "annulus as an outer wheel": ("annulus", "", 11.0 / 3.0, "mesh-sense sign"),
        "friction left out": ("block", "", 50.0, "no-friction"),
        "friction the other way": ("block", "", 30.0, "friction-sense"),
        "one unknown for the other": ("two", "T2", 3.7, "other-unknown"),
    }  # fmt: skip
    for case, kind, code in (
        ("13_08_four_bar", "another centre", "wrong-ic"), ("13_08_four_bar", "other assembly", "other-mode"),
    ):  # fmt: skip
        (path,) = CASES.rglob(f"{case}.yaml")
        found[kind] = (case, "", next(m.value for m in mistakes(path) if m.code == code), code)
    return found


ARM = """\
icsolve: 1
points: {A: [0, 0], B: [1, 1], C: [2.5, 1.2], D: [3, 0.4]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}]
loads:
  P: {force: 100, link: 4, at: D, angle: -90}
  T2: {torque: unknown, link: 2}
  T3: {torque: unknown, link: 3}
  T4: {torque: unknown, link: 4}
"""
"""T4 = 50, T3 + T4 = 200 with links 3 and 4 as one, T2 + T3 + T4 = 300 with all of them."""


@pytest.mark.parametrize(
    ("given", "carried"),
    [
        ({"T4": 83.0, "T3": 117.0, "T2": 100.0}, {"T4"}),  # from T3, and T2 is right
        ({"T4": 83.0, "T3": 150.0, "T2": 67.0}, {"T4"}),  # from T2
        ({"T4": 83.0, "T3": 131.0, "T2": 86.0}, {"T4"}),  # from both of them
        ({"T4": 83.0, "T3": 131.0, "T2": 77.0}, set()),
    ],
)
def test_of_three_unknowns_one_follows_from_the_others(
    a_class: Class, given: dict[str, float], carried: set[str]
) -> None:
    """Which of those that agree was first can't be told: the first one of the case keeps its own cause."""
    a_class.case("arm", ARM)
    table = "student_id,case,answer\n" + "".join(f"1,arm:{name},{value}\n" for name, value in given.items())
    rows = {row["case"].partition(":")[2]: row["code"].split() for row in a_class.grade(table).rows()}
    assert {name for name, codes in rows.items() if "carried" in codes} == carried


def test_32_of_33_kinds_of_mistakes_are_named(a_class: Class) -> None:
    """Each by one code at least that is its own; of two at once both."""
    texts = {"crank": CRANKS, "train": TRAIN, "annulus": ANNULUS, "block": BLOCK}
    texts["two"] = TWO.replace("torque: 6", "torque: 5.55")
    texts["13_08_four_bar"] = (CASES / "ch13" / "13_08_four_bar.yaml").read_text()
    for name, text in texts.items():
        a_class.case(name, text)
    kinds = modelled()
    assert len(kinds) == 33
    lines = [f"{n},{case}{':' * bool(what)}{what},{value:.5g}" for n, (case, what, value, _) in
             enumerate(kinds.values())]  # fmt: skip
    ran = a_class.grade("student_id,case,answer\n" + "\n".join(lines) + "\n")
    given = {int(row["student_id"]): set(row["code"].split()) for row in ran.rows() if row["raw_answer"]}
    missed = []
    for n, (kind, (*_, codes)) in enumerate(kinds.items()):
        wanted = set(codes.split())
        if not (wanted <= given[n] if "," in kind else wanted & given[n]):
            missed.append(kind)
    assert len(kinds) - len(missed) >= 32, missed


def test_random_numbers_seldom_get_a_cause_in_the_library() -> None:
    """Numbers even up to three times the right one, and even in their powers of ten: at most 8 % get one."""
    rng, case_store, reader = random.Random(7), CaseStore(CASES, Course()), Reader()
    names = "13_08_four_bar 13_11_vice_grip five_bar:T12 geneva lamp_arm compound_epicyclic bolt_cutter wedge"
    named = wrong = 0
    for name in names.split():
        key = case_store.key(name)
        assert isinstance(key, NumberKey)
        sizes = [rng.uniform(-3.0, 3.0) for _ in range(60)]
        sizes += [rng.choice((-1.0, 1.0)) * 10.0 ** rng.uniform(-3.0, 3.0) for _ in range(60)]
        for factor in sizes:
            judged, _ = judge_answer(key, reader, f"{key.value * factor:.4g}")
            wrong += judged.verdict == "wrong"
            named += judged.verdict == "wrong" and bool(judged.code)
    assert wrong > 900
    assert named <= 0.08 * wrong


def test_the_bare_size_of_a_negative_answer_seldom_gets_a_cause_either() -> None:
    """With thirty misreadings and an answer of -196 N*m, positive sizes are looked up twice: 8 % in all."""
    rng, key = random.Random(7), CaseStore(CASES, Course()).key("v_engine")
    assert isinstance(key, NumberKey) and key.value < 0.0
    reader = Reader()
    found = [judge_answer(key, reader, f"{key.value * rng.uniform(-3.0, 3.0):.4g}")[0] for _ in range(4000)]
    wrong = [judged for judged in found if judged.verdict == "wrong"]
    assert sum(bool(judged.code) for judged in wrong) <= 0.08 * len(wrong)


def test_a_near_miss_of_an_angle_is_not_a_percent_of_a_turn() -> None:
    """3 % of 350 degrees are ten: more than one random angle in twenty would be a near miss."""
    assert near_miss(3.5, 360.0) == 5.0 and near_miss(0.6, 360.0) == pytest.approx(1.8)
    assert near_miss(8.0, 360.0) == 8.0 and near_miss(8.0, 0.0) == 24.0
