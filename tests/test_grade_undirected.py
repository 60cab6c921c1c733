"""Words of direction beside what has none of its own, a mass, a stiffness, a pressure, a ratio or a
distance: the way that the first three act may be said with them, and of anything else a person decides."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import pytest

from icsolve.grade.course import Course, Credit
from icsolve.grade.one import Task
from sizes import sampled

FRAME = """\
icsolve: 1
points: {A: [0, 0], B: [2, 0], C: [4, 0], D: [2, 3]}
joints: [{pin: [1, 2], at: A}]
loads:
"""
GEARED = """\
icsolve: 1
points: {A: [0, 0], B: [4, 0]}
joints: [{pin: [1, 2], at: A}, {pin: [1, 3], at: B}, {gears: [2, 3], teeth: [20, -50]}]
loads: {T2: {torque: 5, link: 2}, T3: {torque: unknown, link: 3}}
"""
FORCE = "  F: {force: 90, link: 2, at: C, angle: ANGLE}\n"
OF = {
    "mass": (
        FRAME + FORCE.replace("ANGLE", "90") + "  m: {mass: unknown, link: 2, at: B}\n", "", "18.3486 kg",
    ),
    "pulling": (
        FRAME + FORCE.replace("ANGLE", "-90") + "  k: {spring: unknown, free: 1, link: 2, at: B, to: D}\n",
        "", "90 N/m",
    ),
    "pushing": (
        FRAME + FORCE.replace("ANGLE", "90") + "  k: {spring: unknown, free: 5, link: 2, at: B, to: D}\n",
        "", "90 N/m",
    ),
    "turning": (
        FRAME + FORCE.replace("ANGLE", "-90") + "  k: {spring: unknown, corner: AB, free: 90, link: 2}\n",
        "", "229.183 N*m/rad",
    ),
    "pressure": (
        "icsolve: 1\npoints: {A: [0, 0]}\njoints: [{slide: [2, 1], at: A, along: 0}]\nloads:\n"
        "  F: {force: 90, link: 2, at: A, angle: 180}\n"
        "  p: {pressure: unknown, area: 20 mm^2, link: 2, at: A, angle: 0}\n",
        "", "4.5 MPa",
    ),
    "ratio": (GEARED, "w3/w2", "0.4"),
    "distance": (GEARED, "I12-B", "4 m"),
}  # fmt: skip
ACTS = {
    "mass": ("down", "downwards", "at -90 deg", "at 300 deg"),
    "pulling": ("pull", "in tension"),
    "pushing": ("push", "in compression"),
    "turning": ("ccw", "counterclockwise"),
    "pressure": ("to the right", "at 30 deg"),
}
"""What a mass that hangs, a spring longer or shorter than when free, one that is to turn up a bar, and a
piston do."""
WORDS = (
    *("down", "downwards", "at -90 deg", "at 300 deg", "pull", "in tension", "push", "in compression"),
    *("ccw", "counterclockwise", "cw", "up", "left", "to the right", "at 30 deg"),
)


@sampled(3, "of")
@pytest.mark.parametrize(("of", "words"), list(product(OF, WORDS)))
def test_words_beside_what_has_no_direction(of: str, words: str, tmp_path: Path) -> None:
    text, what, right = OF[of]
    (tmp_path / "own.yaml").write_text(text)
    number, _, unit = right.partition(" ")
    wrong = f"{1.37 * float(number):.6g} {unit} {words}"

    def verdict(answer: str, direction: str) -> str:
        course = Course()
        course = course._replace(policy=course.policy._replace(direction=direction))
        return str(Task(tmp_path / "own.yaml", "1", course).grade(what, answer)["verdict"])

    for direction in ("signed", "required"):
        told = verdict(f"{right} {words}", direction)
        assert told == ("right" if words in ACTS.get(of, ()) else "review"), (told, direction)
        assert verdict(right, direction) == "right"
        assert verdict(wrong, direction) == "wrong"
    assert verdict(f"{right} {words}", "ignored") == "right"


CREDIT = Credit(number=0.6, unit=0.2, direction=0.2)


@pytest.mark.parametrize("of", OF)
def test_a_part_that_a_question_has_not_is_one_of_its_number(of: str, tmp_path: Path) -> None:
    """The sign of a mass, or a unit beside a ratio: where it is wrong the number is, and earns nothing."""
    text, what, right = OF[of]
    (tmp_path / "own.yaml").write_text(text)
    course = Course()
    course = course._replace(policy=course.policy._replace(credit=CREDIT))
    task = Task(tmp_path / "own.yaml", "1", course)
    number, _, unit = right.partition(" ")
    marks = [task.grade(what, answer) for answer in (right, f"-{right}", f"{number} kPa")]
    assert [mark["verdict"] for mark in marks] == ["right", "wrong", "wrong"]
    scores = [1.0, 0.25, 0.75] if unit else [1.0, 0.0, 0.0]
    assert [mark["score"] for mark in marks] == pytest.approx(scores)
