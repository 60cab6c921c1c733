"""Known mistakes: looked up by value, the simplest first, none within tolerance of the right answer."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import icsolve
from grade_shell import CASES, Class
from icsolve.grade.course import Course
from icsolve.grade.keys import Key
from icsolve.grade.malrules import CODES, Wrong, Wrongs, message, wrong_answers
from icsolve.grade.malrules.centres import shares
from icsolve.grade.shelf import Shelf
from icsolve.grade.solved import solved


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
    monkeypatch.setattr("icsolve.grade.solved.wrong_answers", lambda answer: calls.append("made") or {})
    key = Shelf(CASES, Course()).key("13_08_four_bar")
    assert isinstance(key, Key)
    assert calls == []
    assert key.wrongs.near(5.0) == ()
    assert calls == ["made"]
