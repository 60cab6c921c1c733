"""A class of simulated students on 25 cases, each with one known mistake, or none."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

from grade_bench import CASES, questions
from grade_mistakes import mistakes
from icsolve.grade.run import Job, grade

FILES = {path.stem: path for path in CASES.rglob("*.yaml")}


class Student(NamedTuple):
    """What a student hands in to one case, and the mistake that was made ('' for none)."""

    case: str
    answer: str
    mistake: str
    within: bool
    """whether the wrong answer lies within tolerance of the right one, or so near that rounding decides"""


def right_spellings(value: float, unit: str) -> Iterator[str]:
    """The right answer as people write it; a negative one keeps its sign."""
    yield f"{value:.4g} {unit}"
    yield f"{value:.6g}"
    yield f"{value:.4e}{unit}"
    yield f"{value:.4f} {unit}".replace("*", "·").replace(".", ",")
    yield f" {value * 1.004:.6g} {unit} "
    mantissa, exponent = f"{value:.5e}".split("e")
    yield f"{mantissa} x 10^{int(exponent)} {unit}"


def hand_ins() -> list[Student]:
    """Every mistake that each of the 25 cases allows, and the right answer in several spellings."""
    found = []
    for case, value, unit in questions(25):
        found += [Student(case, text, "", False) for text in right_spellings(value, unit)]
        for code, wrong in mistakes(FILES[case]):
            within = abs(abs(wrong) - abs(value)) <= 0.0101 * abs(value) and wrong * value > 0
            found.append(Student(case, f"{wrong:.7g} {unit}", code, within))
    return found


@pytest.fixture(scope="module")
def graded(tmp_path_factory: pytest.TempPathFactory) -> list[tuple[Student, dict[str, str]]]:
    """Each student with the line of the results."""
    students = hand_ins()
    table: Path = tmp_path_factory.mktemp("class") / "answers.csv"
    with open(table, "w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["student_id", "case", "answer"])
        rows.writerows([f"{n:05d}", s.case, s.answer] for n, s in enumerate(students))
    out = io.StringIO()
    grade(Job((str(table),), str(CASES)), out)
    lines = {(row["student_id"], row["case"]): row for row in csv.DictReader(io.StringIO(out.getvalue()))}
    return [(s, lines[f"{n:05d}", s.case]) for n, s in enumerate(students)]


Graded = list[tuple[Student, dict[str, str]]]


def test_the_class_makes_every_kind_of_mistake(graded: Graded) -> None:
    made = {student.mistake for student, _ in graded}
    assert made >= {"sign", "power-of-ten", "unit-factor", "deg-rad", "no-cos", "sin-cos", "inverse-ratio"}
    assert made >= {"wrong-ic", "missed-load", "load-sense", "half", "double", "other-mode", "near-miss"}


def test_no_right_answer_is_marked_wrong(graded: Graded) -> None:
    right = [line for student, line in graded if not student.mistake]
    assert len(right) == 150
    assert [line for line in right if line["verdict"] != "right"] == []


def test_no_wrong_answer_is_marked_right(graded: Graded) -> None:
    wrong = [(student, line) for student, line in graded if student.mistake and not student.within]
    assert [(student, line) for student, line in wrong if line["verdict"] != "wrong"] == []


def test_at_least_95_percent_of_the_mistakes_are_named(graded: Graded) -> None:
    wrong = [(student, line) for student, line in graded if student.mistake and not student.within]
    unnamed = [
        (student, line["code"]) for student, line in wrong if student.mistake not in line["code"].split()
    ]
    assert len(wrong) > 500
    assert len(unnamed) <= 0.05 * len(wrong), unnamed


def test_no_feedback_on_a_wrong_answer_gives_the_answer_away(graded: Graded) -> None:
    values = {case: value for case, value, _ in questions(25)}
    for student, line in graded:
        if line["verdict"] == "wrong":
            assert f"{abs(values[student.case]):.3g}" not in line["feedback"]
