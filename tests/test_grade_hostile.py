"""Tables and answers that are out to break the grader: nobody's row is lost, nothing is read two ways."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from grade_shell import Class

HEADER = "student_id,case,answer\n"


@pytest.fixture
def a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    return Class(tmp_path, capsys)


@pytest.mark.parametrize(
    "lines",
    [
        ['01,lever,"200', "02,lever,200", '03,lever,"200"x', "04,lever,200"],
        ['01,lever,"200', "02,lever,200", '03,lever,2000"', "04,lever,200"],
        ['01,lever,"200', "02,lever,200", "03,lever,2000", "04,lever,200"],
    ],
    ids=["closed within a cell", "closed by an inch mark", "never closed"],
)
def test_a_quote_that_is_not_closed_takes_no_other_student_with_it(a_class: Class, lines: list[str]) -> None:
    ran = a_class.grade(HEADER + "\n".join(lines) + "\n")
    verdicts = {row["student_id"]: row["verdict"] for row in ran.rows()}
    assert verdicts.keys() == {"01", "02", "03", "04"}
    assert (verdicts["01"], verdicts["02"], verdicts["04"]) == ("review", "right", "right")
    assert "answers.csv:2: a quoted cell starts here and does not end" in ran.err
    assert ran.code == 1


def test_a_quoted_cell_of_several_lines_is_one_cell(a_class: Class) -> None:
    ran = a_class.grade(HEADER + '01,lever,"T =\n200 N*m"\n02,lever,200\n')
    assert [(row["student_id"], row["verdict"]) for row in ran.rows()] == [("01", "right"), ("02", "right")]


def test_numbers_that_no_double_holds_in_the_answers_unit(a_class: Class) -> None:
    """1e308 MN*m is a number, and wrong; the results stay valid JSON."""
    table = HEADER + "01,lever,1e308 MN*m\n02,lever,-1e308 kip*ft\n03,lever:I12,\"(1e308, 1e308)\"\n"
    path = str(a_class.path("out.jsonl"))
    ran = a_class.grade(table, "--jsonl", path, "--html", str(a_class.path("out.html")))
    assert [row["verdict"] for row in ran.rows()] == ["wrong", "wrong", "missing", "wrong"]
    with open(path, encoding="utf-8") as file:
        found = [json.loads(line, parse_constant=pytest.fail) for line in file]
    assert found[0]["value"] == 1e308
    assert found[0]["rel_error"] is None


def test_two_columns_of_one_name_are_refused(a_class: Class) -> None:
    ran = a_class.grade("student_id,case,answer,answer\n01,lever,200,100\n")
    assert ran.code == 2
    assert "two columns are called 'answer': rename one" in ran.err
    assert a_class.grade("student_id,student_id,lever\n01,02,200\n").code == 2


def test_a_folder_without_tables(a_class: Class) -> None:
    a_class.path("answers").mkdir()
    ran = a_class.run("grade", str(a_class.path("answers")), "--cases", str(a_class.path("cases")))
    assert ran.code == 2
    assert "there is no table of answers in" in ran.err


def test_a_roster_with_an_open_quote_keeps_its_other_students(a_class: Class) -> None:
    roster = a_class.file("roster.csv", 'student_id,email\n01,"a@x.test\n02,b@x.test\n03,c@x.test\n')
    ran = a_class.grade(HEADER + "02,lever,200\n", "--roster", roster)
    assert [(row["student_id"], row["verdict"]) for row in ran.rows()] == [
        ("01", "missing"), ("02", "right"), ("03", "missing"),
    ]  # fmt: skip
    assert "roster.csv:2: a quoted cell starts here and does not end" in ran.err
