"""Tolerances that a drawing allows: how far an answer may lie off where every point of the figure may."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest

import icsolve
from grade_shell import CASES, PRESS, Class
from icsolve.case.expected import LoadIs
from icsolve.grade import tolerance as drawn
from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Course
from icsolve.grade.keys import NumberKey
from icsolve.grade.one import Task
from sizes import sampled

pytestmark = pytest.mark.usefixtures("wide_ranges")


@pytest.fixture
def a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    return Class(tmp_path, capsys)


DRAWN = "tolerance: {drawing: 0.01 in}\n"


def widths(a_class: Class, question: str) -> tuple[float, float]:
    """The right value of a question of the press, and half the width of its band."""
    key = CaseStore(a_class.path("cases"), Course()).key(question)
    return (key.value if isinstance(key, NumberKey) else math.hypot(*key.place)), key.half


def press_with(a_class: Class, extra: str) -> Path:
    path = a_class.path("cases/press.yaml")
    text = PRESS.replace("$P", "100").replace("1 + $a/2", "1.5").replace("$a", "1")
    path.write_text(re.sub(r"variables:\n(?: .*\n)+", "", text) + extra)
    return path


@pytest.mark.parametrize("what", ["w4/w2", "I24-A", "F34", "I24"])
def test_a_tolerance_from_the_drawing_for_ratios_distances_reactions_and_centres(
    a_class: Class, what: str
) -> None:
    """By differences of the solver's own values; the band grows with the accuracy, to first order."""
    press_with(a_class, DRAWN)
    value, half = widths(a_class, f"press:{what}")
    press_with(a_class, DRAWN.replace("0.01", "0.02"))
    assert widths(a_class, f"press:{what}")[1] == pytest.approx(2.0 * half, rel=1e-7)
    assert 1e-3 * abs(value) < half < 0.2 * abs(value)


def test_the_band_of_a_drawing_by_differences_is_that_of_the_backward_pass(a_class: Class) -> None:
    """The unknown torque, both ways: to six digits."""
    case = icsolve.load(press_with(a_class, ""))
    answer, target = icsolve.solve(case, all_centres=True, rates=True), LoadIs("T12")
    exact, near = drawn._exact(target, answer), drawn._differences(target, answer)
    assert near.keys() <= exact.keys()
    for path, slope in near.items():
        assert slope == pytest.approx(abs(exact[path]), rel=1e-6, abs=1e-6)


def test_a_drawing_allows_a_band_where_a_scene_has_no_derivatives(a_class: Class) -> None:
    """A rope that slips on a post, F = W exp(mu beta), level to B and upright to A: beta changes by what A, B
    and the post are off across the rope, over the 2 and 3 m between. Differences leave some millionths."""
    a_class.case("rope", (CASES / "ropes" / "capstan.yaml").read_text() + "tolerance: {drawing: 1 mm}\n")
    value, half = widths(a_class, "rope")
    assert half == pytest.approx(0.25 * value * 0.001 * (1.0 / 2.0 + 1.0 / 3.0) * 2.0, rel=1e-5)


def test_a_drawing_that_leaves_the_answer_open_is_refused_by_name(a_class: Class) -> None:
    press_with(a_class, DRAWN.replace("0.01 in", "1 in"))
    (row,) = a_class.judge("33.76", case="press")
    assert (row["verdict"], row["code"]) == ("review", "not-graded")
    assert "a drawing accurate to 1 in leaves this answer open" in row["feedback"]
    press_with(a_class, DRAWN.replace("0.01 in", "0 in"))
    (row,) = a_class.judge("33.76", case="press")
    assert "leaves no room for this answer" in row["feedback"]


CRANK_THAT_RUBS = """\
icsolve: 1
points: {A: [0, 0], B: [-80, 0], C: [0, 60]}
joints: [{pin: [1, 2], at: A, mu: 0.2, radius: 15}]
loads:
  W: {force: 500, link: 2, at: B, angle: 90}
  P: {force: unknown, link: 2, at: C, angle: 0}
"""
BLOCK_THAT_RUBS = """\
icsolve: 1
points: {A: [0, 0], B: [4, 3], C: [2, 1.5]}
joints: [{slide: [2, 1], at: C, along: [A, B], mu: 0.3}]
loads:
  W: {force: 100, link: 2, at: C, angle: -90}
  P: {force: unknown, link: 2, at: C, angle: 0}
"""
BAR_THAT_RUBS = """\
icsolve: 1
points: {A: [0, 0]}
lengths: {AB: 1}
angles: {AB: unknown}
joints: [{pin: [1, 2], at: A, mu: 0.3, radius: 0.2}]
loads: {P: {force: 10, link: 2, at: B, angle: 0}, M: {torque: 0, link: 2}}
"""


@sampled(2)
@pytest.mark.parametrize("text", [CRANK_THAT_RUBS, BLOCK_THAT_RUBS, BAR_THAT_RUBS])
def test_no_answer_to_a_range_is_wrong_by_a_drawing_that_says_nothing_of_it(
    a_class: Class, text: str
) -> None:
    """A person judges what is right and what is wrong; with a part of the value beside it that counts."""
    a_class.case("rubs", text)
    right = Task(a_class.path("cases/rubs.yaml")).right().partition(" or ")[0]
    a_class.case("rubs", text + DRAWN)
    rows = a_class.judge(right, "1 to 2", case="rubs")
    assert [(row["verdict"], row["code"]) for row in rows] == [("review", "not-graded")] * 2
    assert all("a drawing says nothing of" in row["feedback"] for row in rows)
    a_class.case("rubs", text + "tolerance: {drawing: 0.01 in, relative: 1%}\n")
    assert a_class.verdicts(right, "1 to 2", case="rubs") == ["right", "wrong"]
