"""Tables and answers that are out to break the grader: nobody's row is lost, nothing is read two ways."""

from __future__ import annotations

import csv
import io
import json
from itertools import permutations
from pathlib import Path

import pytest

from grade_shell import Class
from sizes import sampled

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


@sampled(4)
@pytest.mark.parametrize("order", list(permutations(("student_id", "case", "answer", "attempt"))))
def test_columns_in_any_order_hold_cells_of_several_lines(a_class: Class, order: tuple[str, ...]) -> None:
    """And a quote that is not closed in one of them takes no other student with it."""
    answers = ["200", "T =\n200 N*m", "50\n\nor 60", "T = 200\nN*m\nccw", "-200"]
    out = io.StringIO()
    table = csv.DictWriter(out, order)
    table.writeheader()
    for n, answer in enumerate(answers):
        table.writerow({"student_id": f"0{n}", "case": "lever", "answer": answer, "attempt": "1"})
    ran = a_class.grade(out.getvalue())
    assert [row["raw_answer"] for row in ran.rows()] == answers
    assert [row["verdict"] for row in ran.rows()] == ["right", "right", "review", "right", "wrong"]
    rows = []
    for student, answer in (("01", '"200'), ("02", "200"), ("03", "-200")):
        own = {"student_id": student, "case": "lever", "answer": answer, "attempt": "1"}
        rows.append(",".join(own[name] for name in order))
    found = a_class.grade(f"{','.join(order)}\n" + "\n".join(rows) + "\n").rows()
    assert [(row["student_id"], row["verdict"]) for row in found] == [
        ("01", "review"), ("02", "right"), ("03", "wrong"),
    ]  # fmt: skip


@pytest.mark.parametrize("order", list(permutations(("student_id", "lever", "pusher"))))
def test_a_wide_table_has_its_columns_in_any_order(a_class: Class, order: tuple[str, ...]) -> None:
    own = {"student_id": "01", "lever": '"T =\n200 N*m"', "pusher": "100 N"}
    ran = a_class.grade(f"{','.join(order)}\n{','.join(own[name] for name in order)}\n")
    assert [(row["case"], row["verdict"]) for row in ran.rows()] == [("lever", "right"), ("pusher", "right")]


def test_numbers_that_no_double_holds_in_the_answers_unit(a_class: Class) -> None:
    """1e308 MN*m is a number, and wrong; the results stay valid JSON."""
    table = HEADER + '01,lever,1e308 MN*m\n02,lever,-1e308 kip*ft\n03,lever:I12,"(1e308, 1e308)"\n'
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


@pytest.mark.parametrize("kind", ["canvas", "moodle"])
@pytest.mark.parametrize(
    ("data", "said"),
    [
        ("", "the template is empty"),
        ("x,y\n1,2\n", "the"),
        ("Student\n", "the"),
    ],
)
def test_a_template_that_is_none_is_refused_by_name(a_class: Class, kind: str, data: str, said: str) -> None:
    template, out = a_class.file("template.csv", data), a_class.path("out.csv")
    table = a_class.file("answers.csv", HEADER + "01,lever,200\n")
    cases = str(a_class.path("cases"))
    ran = a_class.run("grade", table, "--cases", cases, "--write", f"{kind}={out}", "--template", template)
    assert ran.code == 2
    assert f"template.csv: {said}" in ran.err
    assert not out.exists()


def test_students_without_a_row_in_the_template_are_named(a_class: Class) -> None:
    """Two students of one name are told apart by their ids, or not at all."""
    template = a_class.file(
        "sheet.csv",
        "Identifier,Full name,Email address,Grade,Maximum Grade,Feedback comments\n"
        "P1,Ann Bee,a1@x.test,,10\nP2,Ann Bee,,,10,\nP3,Cy Dee,,,10,\n",
    )
    roster = a_class.file(
        "roster.csv",
        "student_id,email,first_name,last_name\n01,a1@x.test,Ann,Bee\n02,a2@x.test,Ann,Bee\n03,,Cy,Dee\n",
    )
    table = a_class.file("answers.csv", HEADER + "01,lever,200\n02,lever,1\n03,lever,200\n")
    out = a_class.path("out.csv")
    cases = str(a_class.path("cases"))
    options = ("--roster", roster, "--template", template, "--write", f"moodle={out}")
    ran = a_class.run("grade", table, "--cases", cases, *options)
    rows = [line.split(",") for line in out.read_text().splitlines()]
    assert [row[3] for row in rows[1:]] == ["10.00", "", "10.00"]
    assert "marks of 2 students of" in ran.err
    assert "it has no row for 02" in ran.err


def test_a_kind_of_output_that_there_is_not_is_refused_before_anything_is_read(a_class: Class) -> None:
    ran = a_class.run("grade", "nothing.csv", "--cases", str(a_class.path("cases")), "--write", "x=y")
    assert ran.code == 2
    assert "--write x: there is no such kind" in ran.err


def test_messages_about_a_file_name_it(a_class: Class) -> None:
    good = a_class.file("good.csv", HEADER + "01,lever,200\n")
    bad = a_class.file("bad.csv", "colour,shape\nred,round\n")
    cases = str(a_class.path("cases"))
    ran = a_class.run("grade", good, bad, "--cases", cases)
    assert "bad.csv: these columns are of no known platform" in ran.err
    ran = a_class.run("grade", good, "--cases", cases, "--roster", bad)
    assert "bad.csv: no column of the roster" in ran.err


def test_a_new_name_of_a_case_in_every_row_is_told_and_counted_within_bounds(a_class: Class) -> None:
    """3000 names that are no case: each row has its line and reason in the results, the list stays short."""
    table = HEADER + "".join(f"s{n},bogus{n},1\n" for n in range(3000)) + "ann,lever,200\n"
    page = a_class.path("summary.html")
    ran = a_class.grade(table, "--html", str(page))
    reasons = {row["case"]: row["feedback"] for row in ran.rows() if row["verdict"] == "review"}
    assert len(reasons) == 3000
    assert reasons["bogus2999"] == "Not graded: there is no case 'bogus2999'"
    assert ran.row("ann")["verdict"] == "right"
    lines = ran.err.splitlines()
    assert len(lines) < 600
    assert "not graded either" in lines[-1]
    assert "lines 503-3001" in lines[-1]
    assert "2800" in page.read_text(encoding="utf-8")
