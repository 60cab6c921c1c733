"""The whole command: attempts, who is who, order, what is noted, and that nothing is overwritten."""

from __future__ import annotations

import csv
import io
import json
import random
from datetime import datetime
from itertools import permutations
from pathlib import Path

import pytest

from grade_bench import CASES, write_class
from grade_shell import PRESS, Class
from icsolve.grade import importing
from icsolve.grade.run import Job, grade
from icsolve.grade.tables.columns import timestamp


@pytest.fixture
def a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    return Class(tmp_path, capsys)


ATTEMPTS = (
    "student_id,case,answer,attempt,submitted_at\n"
    "a,lever,200,2,2025-03-02T10:00:00Z\n"
    "a,lever,150,3,2025-03-03T10:00:00Z\n"
    "a,lever,100,1,2025-03-01T10:00:00Z\n"
)


@pytest.mark.parametrize(("which", "answer"), [("last", "150"), ("first", "100"), ("best", "200")])
def test_the_last_first_or_best_attempt_counts(a_class: Class, which: str, answer: str) -> None:
    ran = a_class.grade(ATTEMPTS, "--attempt", which)
    assert [row["raw_answer"] for row in ran.rows()] == [answer]
    assert ran.err == ""
    a_class.course(f"attempt: {which}\n")
    assert [row["raw_answer"] for row in a_class.grade(ATTEMPTS).rows()] == [answer]


@pytest.mark.parametrize("attempts", list(permutations(("150", "200 N", "200 N*m", '"200,000"', "none"), 3)))
def test_the_best_attempt_is_not_a_wrong_one_while_another_waits(
    a_class: Class, attempts: tuple[str, ...]
) -> None:
    """What a person has to read may be the best; where one has the whole mark nothing need be read. The
    number alone earns 60 %, and of equal attempts the last counts."""
    a_class.course("attempt: best\ncredit: {number: 60%, unit: 40%}\n")
    lines = [f"a,lever,{answer},{n}" for n, answer in enumerate(attempts)]
    (row,) = a_class.grade("student_id,case,answer,attempt\n" + "\n".join(lines) + "\n").rows()
    order = ["200 N*m", '"200,000"', "200 N", "150", "none"]
    counts = min(attempts, key=order.index)
    assert row["raw_answer"] == counts.strip('"')
    assert row["score"] == {"200 N*m": "1", '"200,000"': "", "200 N": "0.6", "150": "0.4"}[counts]


def test_times_tell_where_attempts_have_no_numbers(a_class: Class) -> None:
    table = (
        "student_id,case,answer,submitted_at\n"
        "a,lever,150,1 March 2025 9:30 PM\n"
        "a,lever,200,2025-03-02 10:00:00 UTC\n"
        "a,lever,100,2025-03-02T11:00:00+02:00\n"
    )
    assert [row["raw_answer"] for row in a_class.grade(table).rows()] == ["200"]


@pytest.mark.parametrize(
    ("text", "iso"),
    [
        ("2025/03/01 10:00:00 AM GMT+1", "2025-03-01T09:00:00"),  # Google Forms
        ("2025/03/01 10:00:00 PM MEZ", "2025-03-01T21:00:00"),
        ("2025/03/01 1:05:00 PM GMT+05:30", "2025-03-01T07:35:00"),
        ("2025-03-01 10:00:00 -0800", "2025-03-01T18:00:00"),  # Gradescope
        ("2025-03-01 10:00:00 UTC", "2025-03-01T10:00:00"),  # Canvas
        ("1 March 2025  10:30 AM", "2025-03-01T10:30:00"),  # Moodle
        ("1. März 2025  22:30", "2025-03-01T22:30:00"),
        ("3/1/2025 10:00:00", "2025-03-01T10:00:00"),
        ("2025-03-01 1:05 PM", "2025-03-01T13:05:00"),  # spreadsheets
        ("2025-3-1 9:05", "2025-03-01T09:05:00"),
        ("2025-03-01 12:00 AM", "2025-03-01T00:00:00"),
        ("01.03.25 22:30", "2025-03-01T22:30:00"),
        ("1.3.2025", "2025-03-01T00:00:00"),
        ("1 Mar 2025 22:30", "2025-03-01T22:30:00"),
        ("1-Mar-2025 10:30:05 pm", "2025-03-01T22:30:05"),
        ("March 1, 2025 at 10:30 p.m.", "2025-03-01T22:30:00"),
        ("1. März 2025 um 22:30 Uhr", "2025-03-01T22:30:00"),
    ],
)
def test_the_times_that_platforms_write(text: str, iso: str) -> None:
    assert timestamp(text) == datetime.fromisoformat(f"{iso}+00:00").timestamp()


@pytest.mark.parametrize("text", ["13:00 PM", "2025-03-01 0:30 PM", "2025-03-01 25:00", "2025-13-01 10:00"])
def test_what_is_no_time_is_none(text: str) -> None:
    assert timestamp(text) is None


@pytest.mark.parametrize("empty", [",,", " , ,", '"",,""', ",,,,"])
@pytest.mark.parametrize(
    "table", ["student_id,case,answer\na,lever,200\n", "student_id,lever,press\na,200,\n"]
)
def test_rows_in_which_nothing_stands_are_passed_over(a_class: Class, table: str, empty: str) -> None:
    """As spreadsheets have them between the rows of a table and below it."""
    plain = a_class.grade(table)
    header, row = table.splitlines()
    ran = a_class.grade("\n".join([empty, header, empty, row, empty, empty, ""]))
    assert (ran.code, ran.err, ran.rows()) == (plain.code, plain.err, plain.rows())


def test_rows_that_nothing_tells_apart_are_listed(a_class: Class) -> None:
    ran = a_class.grade("student_id,case,answer\na,lever,150\nb,lever,1\na,lever,200\na,lever,210\n")
    assert ran.row("a")["raw_answer"] == "210"
    assert (
        "answers.csv:2: the same student answers the same question again; the last row counts (and line 4)"
        in ran.err
    )


def test_a_time_that_cant_be_read_is_noted(a_class: Class) -> None:
    ran = a_class.grade("student_id,case,answer,submitted_at\na,lever,150,yesterday\na,lever,200,today\n")
    assert ran.row("a")["raw_answer"] == "200"
    assert "this time can't be read" in ran.err


def test_students_are_matched_by_the_roster_and_nobody_is_dropped(a_class: Class) -> None:
    roster = a_class.file(
        "roster.csv", "student_id,email,first_name,last_name\n007,ann@x.test,Ann,Bee\n008,,Bob,Cee\n"
    )
    ran = a_class.grade("student_id,case,answer\nANN@x.test,lever,200\n7,lever,200\n", "--roster", roster)
    assert [(r["student_id"], r["verdict"]) for r in ran.rows()] == [
        ("007", "right"),
        ("008", "missing"),
        ("7", "right"),
    ]
    assert "'7' is not on the roster" in ran.err
    assert "the roster has '007'" in ran.err


def test_a_gradebook_serves_as_the_roster(a_class: Class) -> None:
    roster = a_class.file(
        "gradebook.csv",
        "Student,ID,SIS User ID,SIS Login ID,Section,x (1)\n    Points Possible,,,,,1\n"
        '"Bee, Ann",31,s-01,ann@x.test,A,\n',
    )
    ran = a_class.grade("student_id,case,answer\nann@x.test,lever,200\n", "--roster", roster)
    assert [(r["student_id"], r["verdict"]) for r in ran.rows()] == [("s-01", "right")]


def test_who_owes_an_answer_to_what_others_were_asked(a_class: Class) -> None:
    table = "student_id,case,answer\na,lever,200\nb,pusher,100\n"
    ran = a_class.grade(table)
    assert [r["verdict"] for r in ran.rows()] == ["right", "missing", "missing", "right"]
    shown = a_class.run("grade", str(a_class.path("answers.csv")), "--cases", str(a_class.path("cases")))
    assert "no answer to lever: b" in shown.out
    a_class.course("cases: {lever: {}}\n")
    assert [(r["student_id"], r["case"]) for r in a_class.grade(table).rows()] == [
        ("a", "lever"),
        ("b", "lever"),
        ("b", "pusher"),
    ]


def test_a_missing_case_and_one_without_an_answer_leave_the_others_alone(a_class: Class) -> None:
    a_class.case("broken", "icsolve: 1\njoints:\n  - {pin: [1, 2], att: A}\n")
    table = "student_id,case,answer\na,lever,200\na,nowhere,1\na,dead,1\na,broken,1\nb,dead,2\n"
    ran = a_class.grade(table)
    assert ran.code == 1
    assert ran.row("a")["verdict"] == "right"
    assert "answers.csv:3: there is no case 'nowhere'" in ran.err
    assert "answers.csv:4: not graded: the case dead has no answer (dead-centre)" in ran.err
    assert "(and line 6)" in ran.err
    assert "broken.yaml:3:" in ran.err
    assert {
        r["verdict"] for r in ran.rows() if r["case"] in ("nowhere", "dead", "broken") and r["raw_answer"]
    } == {"review"}


def test_a_case_with_several_unknowns_asks_which(a_class: Class) -> None:
    a_class.case("two", (CASES / "linkages" / "five_bar.yaml").read_text())
    ran = a_class.grade("student_id,case,answer\na,two,1\na,two:T12,-5.24\na,two:T15,11.75\na,two:X,1\n")
    assert "the case two has 2 unknown loads; write two:T12 or two:T15" in ran.err
    assert [ran.row("a", f"two:{name}")["verdict"] for name in ("T12", "T15")] == ["right", "right"]
    assert "'X' names nothing in this case" in ran.err


def test_two_files_of_one_name_are_no_case(a_class: Class) -> None:
    (a_class.path("cases/deep")).mkdir()
    a_class.case("deep/lever", a_class.path("cases/lever.yaml").read_text())
    ran = a_class.grade("student_id,case,answer\na,lever,200\n")
    assert ran.code == 1
    assert "two files are the case lever" in ran.err


def graded(table: str, folder: Path, most: int | None = None) -> str:
    """The results of a table; with ``most`` at most so many answers in memory."""
    path = folder / "answers.csv"
    path.write_text(table, encoding="utf-8")
    out = io.StringIO()
    with pytest.MonkeyPatch.context() as patch:
        if most is not None:
            patch.setattr(importing, "IN_MEMORY", most)
        grade(Job((str(path),), str(CASES)), out)
    return out.getvalue()


@pytest.fixture(scope="module")
def large(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("large") / "class.csv"
    write_class(path, 120)
    return path.read_text(encoding="utf-8")


def test_results_are_sorted_by_student_and_case(large: str, tmp_path: Path) -> None:
    rows = [(row["student_id"], row["case"]) for row in csv.DictReader(io.StringIO(graded(large, tmp_path)))]
    assert len(rows) == 120 * 25
    assert rows == sorted(rows)


def test_the_same_bytes_in_memory_and_on_disk(large: str, tmp_path: Path) -> None:
    once = graded(large, tmp_path)
    assert graded(large, tmp_path) == once
    assert graded(large, tmp_path, most=500) == once


@pytest.mark.parametrize("most", [0, importing.IN_MEMORY])
def test_of_several_files_the_last_counts_wherever_its_rows_stand(
    most: int, a_class: Class, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Not the answer of the greatest line, nor of the greatest text."""
    monkeypatch.setattr(importing, "IN_MEMORY", most)
    header, cases = "student_id,case,answer\n", str(a_class.path("cases"))
    first = a_class.file("first.csv", f"{header}a,lever,9\nx,lever,1\nb,lever,201\n")
    second = a_class.file("second.csv", f"{header}a,lever,200\nb,lever,100\n")
    for files, answers in (((first, second), ("200", "100")), ((second, first), ("9", "201"))):
        ran = a_class.run("grade", *files, "--cases", cases, "-o", "-", "-q")
        assert tuple(ran.row(student, "lever")["raw_answer"] for student in "ab") == answers


def test_the_same_bytes_with_the_rows_in_any_order(large: str, tmp_path: Path) -> None:
    """Attempts and times tell which row is last."""
    header, *rows = large.splitlines(keepends=True)
    more = [row.replace(",2025-", ",2024-") for row in rows[:200]]
    mixed = rows + more
    random.Random(3).shuffle(mixed)
    assert graded(header + "".join(mixed), tmp_path) == graded(header + "".join(rows + more), tmp_path)


def test_nothing_is_overwritten_unless_asked(a_class: Class) -> None:
    table = a_class.file("answers.csv", "student_id,case,answer\na,lever,200\n")
    out = a_class.file("results.csv", "kept")
    call = ("grade", table, "--cases", str(a_class.path("cases")), "-o", out)
    ran = a_class.run(*call)
    assert ran.code == 2
    assert "is there already" in ran.err
    assert Path(out).read_text() == "kept"
    assert a_class.run(*call, "--force").code == 0
    assert Path(out).read_text().startswith("student_id,case")
    assert a_class.run(*call[:-1], table, "--force").code == 2
    assert Path(table).read_text().startswith("student_id,case,answer")
    assert {path.name for path in a_class.folder.iterdir()} == {"cases", "answers.csv", "results.csv"}


def test_a_file_that_fails_halfway_leaves_nothing_under_its_name(a_class: Class) -> None:
    table = a_class.file("answers.csv", "student_id,case\na,lever\n")
    out = a_class.path("results.csv")
    assert a_class.run("grade", table, "--cases", str(a_class.path("cases")), "-o", str(out)).code == 2
    assert not out.exists()


def test_json_lines_name_every_part_and_cause(a_class: Class) -> None:
    lines = a_class.path("results.jsonl")
    a_class.grade("student_id,case,answer\na,lever,-200\nb,lever,200\n", "--jsonl", str(lines))
    wrong, right = (json.loads(line) for line in lines.read_text().splitlines())
    assert wrong["schema"] == "icsolve/grade/1"
    assert wrong["parts"] == {"number": True, "unit": True, "direction": False}
    assert wrong["mistakes"] == [{"code": "sign", "where": ""}]
    assert (right["verdict"], right["line"], right["value"]) == ("right", 3, 200.0)


def test_an_answer_under_a_name_like_that_of_a_case_is_not_missing_too(a_class: Class) -> None:
    """It waits for a person; a mark by hand puts it right, and whoever gave no answer is not counted."""
    roster = a_class.file("roster.csv", "student_id\na\nb\nc\n")
    marks = a_class.file("marks.csv", "student_id,case,score\na,lever,1\n")
    a_class.course("cases: {lever: {}, pusher: {}}\n")
    table = "student_id,case,answer\na,levr,200\na,pusher,1\nb,lever,200\n"
    ran = a_class.grade(table, "--roster", roster)
    assert ran.code == 1
    assert "answers.csv:2: there is no case 'levr'; did you mean 'lever'?" in ran.err
    files = (str(a_class.path("answers.csv")), "--cases", str(a_class.path("cases")), "--roster", roster)
    assert "3 answers from 2 of 3 students" in a_class.run("grade", *files).out
    verdicts = {(row["student_id"], row["case"]): row["verdict"] for row in ran.rows()}
    assert ("a", "lever") not in verdicts and verdicts["a", "levr"] == "review"
    assert verdicts["b", "pusher"] == verdicts["c", "lever"] == verdicts["c", "pusher"] == "missing"
    again = a_class.grade(table, "--roster", roster, "--overrides", marks)
    assert [r["score"] for r in again.rows() if (r["student_id"], r["case"]) == ("a", "lever")] == ["1"]


def test_the_summary_counts_marks_and_mistakes(a_class: Class) -> None:
    answers = "".join(f"s{n},lever,{value}\n" for n, value in enumerate([200] * 5 + [-200] * 3 + [100, "x"]))
    table = a_class.file("answers.csv", "student_id,case,answer\n" + answers)
    page = a_class.path("summary.html")
    ran = a_class.run("grade", table, "--cases", str(a_class.path("cases")), "--html", str(page))
    assert ran.code == 0
    assert "10 answers from 10 students" in ran.out
    assert "lever: 5 right, 4 wrong, 1 invalid; mean 56%" in ran.out
    assert "3 of 4 wrong answers: sign" in ran.out
    html = page.read_text(encoding="utf-8")
    assert '<th scope="row"><code>sign</code></th><td class="n">3</td>' in html
    assert html.count("<rect") == 3
    assert "http" not in html.replace("http://www.w3.org", "")


def test_a_course_file_that_is_wrong_says_where(a_class: Class) -> None:
    a_class.course("tolerance: 200%\nunit: maybe\ncases:\n  lever: {ponts: 5}\nmalrules: {sine: 50%}\n")
    ran = a_class.grade("student_id,case,answer\na,lever,200\n")
    assert ran.code == 2
    for said in (
        "course.yaml:1:12:",
        "course.yaml:2:7:",
        "course.yaml:4:11:",
        "did you mean 'points'",
        "'sine'",
    ):
        assert said in ran.err


def test_a_folder_that_is_not_there(a_class: Class) -> None:
    table = a_class.file("answers.csv", "student_id,case,answer\na,lever,200\n")
    ran = a_class.run("grade", table, "--cases", str(a_class.path("nowhere")))
    assert ran.code == 2
    assert "there is no such folder" in ran.err


def test_several_files_are_one_class(a_class: Class) -> None:
    first = a_class.file("first.csv", "student_id,case,answer\na,lever,200\n")
    second = a_class.file("second.csv", "student_id;pusher\na;100\nb;100\n")
    ran = a_class.run("grade", first, second, "--cases", str(a_class.path("cases")), "-o", "-", "-q")
    assert [(r["student_id"], r["case"], r["verdict"]) for r in ran.rows()] == [
        ("a", "lever", "right"),
        ("a", "pusher", "right"),
        ("b", "lever", "missing"),
        ("b", "pusher", "right"),
    ]


def test_one_students_text_of_answers(a_class: Class) -> None:
    """As an autograder gets it: no ids, a line a case."""
    metadata = a_class.file("metadata.json", json.dumps({"users": [{"email": "ann@x.test", "name": "Ann"}]}))
    text = "lever: 200 N*m ccw\n# a remark\npusher = -100\nwhat is this\n"
    ran = a_class.grade(text, "--metadata", metadata, name="answers.txt")
    assert [(r["student_id"], r["case"], r["verdict"]) for r in ran.rows()] == [
        ("ann@x.test", "", "review"),
        ("ann@x.test", "lever", "right"),
        ("ann@x.test", "pusher", "wrong"),
    ]
    table = a_class.grade("case,answer\nlever,200\n", "--student", "ann")
    assert [(r["student_id"], r["verdict"]) for r in table.rows()] == [("ann", "right")]


def test_a_students_text_may_start_with_a_comment(a_class: Class) -> None:
    answers = a_class.file("answers.txt", '# mine, all of it\nlever: 200 N*m\n\npusher: 100 "\n')
    options = ("--cases", str(a_class.path("cases")), "--student", "ann", "-o", "-", "-q")
    ran = a_class.run("grade", answers, *options)
    assert [(r["case"], r["verdict"]) for r in ran.rows()] == [("lever", "right"), ("pusher", "wrong")]
    assert ran.code == 0


def test_gradescopes_export_of_what_each_student_handed_in(a_class: Class) -> None:
    export = a_class.path("assignment_77_export")
    for number, text in (("1", "lever: 200\n"), ("2", "case,answer\nlever,-200\n"), ("3", "")):
        (export / f"submission_{number}").mkdir(parents=True)
        name = "answers.csv" if "," in text else "answers.txt"
        if text:
            (export / f"submission_{number}" / name).write_text(text)
    who = "".join(
        f"submission_{n}:\n  :submitters:\n  - :name: {name}\n    :sid: '{sid}'\n    :email: {name}@x.test\n"
        for n, name, sid in ((1, "Ann", "007"), (2, "Bob", ""), (3, "Cy", "009"))
    )
    (export / "submission_metadata.yml").write_text(who)
    ran = a_class.run("grade", str(export), "--cases", str(a_class.path("cases")), "-o", "-", "-q")
    verdicts = [(r["student_id"], r["verdict"]) for r in ran.rows()]
    assert verdicts == [("007", "right"), ("009", "missing"), ("Bob@x.test", "wrong")]
    assert "submission_3: 009 handed in no file of answers" in ran.err
    (export / "submission_metadata.yml").write_text("a: [\n")
    assert a_class.run("grade", str(export), "--cases", str(a_class.path("cases"))).code == 2


def test_each_student_is_judged_by_the_key_of_their_own_variant(a_class: Class) -> None:
    a_class.case("press", PRESS)
    roster = a_class.file("roster.csv", "student_id\n" + "".join(f"{n:02d}\n" for n in range(12)))
    cases, sheets = str(a_class.path("cases")), a_class.path("sheets")
    a_class.run("variants", cases, "--roster", roster, "-o", str(sheets), "--no-figures", "-q")
    with open(sheets / "press" / "key.csv", newline="") as file:
        keys = list(csv.DictReader(file))
    assert len({key["value"] for key in keys}) > 6
    answers = "student_id,case,answer\n" + "".join(f"{k['student_id']},press,{k['value']}\n" for k in keys)
    ran = a_class.grade(answers)
    assert {r["verdict"] for r in ran.rows()} == {"right"}
    assert [r["variant"] for r in ran.rows()] == [key["variant"] for key in keys]
    swapped = "student_id,case,answer\n" + "".join(
        f"{k['student_id']},press,{keys[n - 1]['value']}\n" for n, k in enumerate(keys)
    )
    assert sum(r["verdict"] == "wrong" for r in a_class.grade(swapped).rows()) >= 9
    others = "student_id,case,answer,variant\n" + "".join(
        f"{k['student_id']},press,{k['value']},{keys[n - 1]['variant']}\n" for n, k in enumerate(keys)
    )
    assert {r["code"] for r in a_class.grade(others).rows()} <= {"other-variant", ""}
    halves = "student_id,case,answer\n" + "".join(
        f"{k['student_id']},press,{float(k['value']) / 2}\n" for k in keys
    )
    assert {r["code"].split()[0] for r in a_class.grade(halves).rows()} == {"half"}


@pytest.mark.parametrize(
    ("course", "message"),
    [
        ("unit: required\ncases: {levr: {}}\n", ":2:9: there is no case 'levr'; did you mean 'lever'?"),
        ("cases:\n  lever: {}\n  pusher:w9/w2: {}\n", "course.yaml:3:3: pusher: "),
    ],
)
def test_a_question_of_the_course_that_is_none_is_refused(a_class: Class, course: str, message: str) -> None:
    """Everyone would miss it."""
    a_class.course(course)
    ran = a_class.grade("student_id,case,answer\na,lever,200\n")
    assert (ran.code, message in ran.err) == (2, True), ran.err


def test_the_course_may_name_a_question_by_its_load(a_class: Class) -> None:
    a_class.course("cases: {'lever:T': {points: 3}}\n")
    ran = a_class.grade("student_id,case,answer\na,lever,200\n")
    assert [(row["case"], row["score"]) for row in ran.rows()] == [("lever", "3")]
