"""Known mistakes: looked up by value, the simplest first, none within tolerance of the right answer."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import icsolve
from grade_shell import CASES, Class
from icsolve.grade.case_store import CaseStore, solved
from icsolve.grade.course import Course
from icsolve.grade.keys import Key
from icsolve.grade.mistakes import CODES, Wrong, Wrongs, message, wrong_answers
from icsolve.grade.mistakes.engine import shares

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


def test_shares_of_the_loads_add_up_to_the_unknown() -> None:
    for path in sorted(CASES.rglob("*.yaml")):
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
    for path in sorted(CASES.rglob("*.yaml")):
        try:
            answer = solved(icsolve.load(path))
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
    monkeypatch.setattr("icsolve.grade.case_store.wrong_answers", lambda answer: calls.append("made") or {})
    key = CaseStore(CASES, Course()).key("13_08_four_bar")
    assert isinstance(key, Key)
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
