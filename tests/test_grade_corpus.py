"""Over 1,600 answers as students write them, with the verdicts of a teacher who reads them.

Each section of the data file names a question and a verdict (two, where a teacher may decide either way);
each line below it is one answer.
"""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import NamedTuple

import pytest

from icsolve.grade.run import Job, grade

CORPUS = Path(__file__).parent / "data" / "written_answers.txt"
HEAD = "icsolve: 1\njoints:\n  - {pin: [1, 2], at: A}\n"
QUESTIONS = {
    "torque": HEAD
    + """\
points: {A: [0, 0], B: [1, 0]}
loads:
  P: {force: 64.5, link: 2, at: B, angle: 90}
  T12: {torque: unknown, link: 2}
""",
    "pull": HEAD
    + """\
points: {A: [0, 0], B: [1, 0], C: [2, 2]}
loads:
  M: {torque: -993.7086, link: 2}
  Q: {force: unknown, link: 2, at: B, toward: C}
""",
    "right": HEAD
    + """\
points: {A: [0, 0], B: [0, 1]}
loads:
  M: {torque: 387, link: 2}
  F: {force: unknown, link: 2, at: B, angle: 0}
""",
    "large": HEAD
    + """\
points: {A: [0, 0], B: [1, 0]}
loads:
  M: {torque: -12345, link: 2}
  L: {force: unknown, link: 2, at: B, angle: 90}
""",
    "zero": HEAD
    + """\
points: {A: [0, 0], B: [2, 0]}
loads:
  P: {force: 100, link: 2, at: B, angle: 180}
  T12: {torque: unknown, link: 2}
""",
    "reaction": HEAD
    + """\
points: {A: [0, 0], B: [1, 0]}
loads:
  W: {weight: 58.2, link: 2, at: B}
  T12: {torque: unknown, link: 2}
""",
    "range": """\
icsolve: 1
points: {A: [0, 0]}
joints:
  - {slide: [2, 1], at: A, along: 0, mu: 0.2}
loads:
  W: {weight: 435, link: 2, at: A}
  H: {force: 200, link: 2, at: A, angle: 180}
  P: {force: unknown, link: 2, at: A, angle: 0}
""",
    "ratio": """\
icsolve: 1
points: {A: [0, 0], B: [1, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {gears: [2, 3], teeth: [133, -1000]}
loads:
  M: {torque: 10, link: 3}
  T12: {torque: unknown, link: 2}
""",
    "centre": """\
icsolve: 1
points: {A: [0, 0], B: [1, 3], C: [3, 2], D: [4, 1]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
loads:
  M: {torque: 10, link: 4}
  T12: {torque: unknown, link: 2}
""",
}
ASKED = {"ratio": "ratio:w3/w2", "centre": "centre:I24", "reaction": "reaction:F12"}


class Answered(NamedTuple):
    """An answer of the corpus: its question, the verdicts that are good, and the text."""

    question: str
    verdicts: tuple[str, ...]
    text: str


def corpus() -> list[Answered]:
    """All answers of the data file."""
    found: list[Answered] = []
    question, verdicts = "", ("",)
    for line in CORPUS.read_text(encoding="utf-8").split("\n"):
        if line.startswith("== "):
            question, said = line.removeprefix("== ").split(": ")
            verdicts = tuple(said.split("|"))
        elif line:
            found.append(Answered(question, verdicts, line))
    return found


Judged = list[tuple[Answered, dict[str, str]]]


@pytest.fixture(scope="module")
def judged(tmp_path_factory: pytest.TempPathFactory) -> Judged:
    """Every answer with its line of the results."""
    folder = tmp_path_factory.mktemp("corpus")
    cases = folder / "cases"
    cases.mkdir()
    for name, text in QUESTIONS.items():
        (cases / f"{name}.yaml").write_text(text, encoding="utf-8")
    answers = corpus()
    table, out = folder / "answers.csv", io.StringIO()
    with open(table, "w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["student_id", "case", "answer"])
        rows.writerows([f"{n:05d}", ASKED.get(a.question, a.question), a.text] for n, a in enumerate(answers))
    grade(Job((str(table),), str(cases)), out)
    found = {(row["student_id"], row["case"]): row for row in csv.DictReader(io.StringIO(out.getvalue()))}
    lines = (found[f"{n:05d}", ASKED.get(a.question, a.question)] for n, a in enumerate(answers))
    return list(zip(answers, lines, strict=True))


def off(judged: Judged, verdict: str) -> list[tuple[str, str, tuple[str, ...]]]:
    """The answers that have a verdict which they may not have."""
    return [
        (a.question, a.text, a.verdicts)
        for a, row in judged
        if row["verdict"] == verdict and verdict not in a.verdicts
    ]


def test_the_corpus_has_over_a_thousand_different_answers() -> None:
    answers = corpus()
    assert len({(a.question, a.text) for a in answers}) == len(answers) >= 1600


def test_no_answer_is_right_or_wrong_that_is_not(judged: Judged) -> None:
    assert off(judged, "right") == []
    assert off(judged, "wrong") == []


def test_what_holds_a_number_is_never_invalid(judged: Judged) -> None:
    assert off(judged, "invalid") == []
    assert off(judged, "missing") == []


def test_hardly_anything_is_left_to_a_person_needlessly(judged: Judged) -> None:
    needless = off(judged, "review")
    assert len(needless) <= 0.01 * len(judged), needless
