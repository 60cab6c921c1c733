"""Tables of every platform, of any encoding and delimiter, whole, cut short or hostile."""

from __future__ import annotations

import csv
import io
import json
import random
from pathlib import Path
from unicodedata import normalize

import pytest

from grade_shell import Class
from sizes import FULL, sampled

FORMULA = '=HYPERLINK("http://x.test","click")'


@pytest.fixture
def a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    return Class(tmp_path, capsys)


LONG = (
    "student_id,case,answer,unit,direction,attempt,submitted_at\n"
    "007,lever,200,N*m,ccw,1,2025-03-01T10:00:00Z\n"
)


@sampled(3)
@pytest.mark.parametrize("delimiter", [",", ";", "\t", "|"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"])
@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_any_delimiter_encoding_and_line_end(
    a_class: Class, delimiter: str, encoding: str, newline: str
) -> None:
    text = LONG.replace(",", delimiter).replace("\n", newline).replace("N*m", "N·m")
    ran = a_class.grade(text.encode(encoding))
    assert (ran.code, ran.err) == (0, "")
    row = ran.row("007")
    assert (row["verdict"], row["value"], row["unit"], row["direction"]) == ("right", "200", "N*m", "ccw")


def test_the_canonical_columns_of_the_results(a_class: Class) -> None:
    ran = a_class.grade(LONG)
    assert ran.out.splitlines()[0] == (
        "student_id,case,variant,attempt,raw_answer,value,unit,direction,verdict,score,max_score,rel_error,code"
        ",feedback"
    )


def test_a_wide_table_has_a_column_a_case(a_class: Class) -> None:
    ran = a_class.grade("student_id,lever,pusher\n01,200,100 N\n02,,-100\n")
    assert [(r["student_id"], r["case"], r["verdict"]) for r in ran.rows()] == [
        ("01", "lever", "right"),
        ("01", "pusher", "right"),
        ("02", "lever", "missing"),
        ("02", "pusher", "wrong"),
    ]


def test_a_wide_column_that_is_no_case_is_listed_and_its_answers_kept(a_class: Class) -> None:
    ran = a_class.grade("student_id,lever,levver\n01,200,5\n")
    assert ran.code == 1
    assert "answers.csv:2: there is no case 'levver'" in ran.err
    assert ran.row("01", "levver")["verdict"] == "review"


def test_gradescope(a_class: Class) -> None:
    header = (
        "First Name,Last Name,SID,Email,Sections,Total Score,Max Points,Status,Submission ID,Submission Time"
    )
    ran = a_class.grade(
        f"{header},Lateness (H:M:S),View Count,Submission Count,1: lever (5.0 pts),2: pusher (5.0 pts)\n"
        "Ann,Bee,00123,ann@x.test,A,,10.0,Graded,77,2025-03-01 10:00:00 UTC,00:00:00,1,1,200 N*m,100\n"
    )
    assert [(r["student_id"], r["case"], r["verdict"]) for r in ran.rows()] == [
        ("00123", "lever", "right"),
        ("00123", "pusher", "right"),
    ]


def test_canvas_quiz_analysis(a_class: Class) -> None:
    ran = a_class.grade(
        "name,id,sis_id,section,section_id,section_sis_id,submitted,attempt,"
        "991: lever,5.0,992: Find Q. [pusher],5.0,n correct,n incorrect,score\n"
        "Ann Bee,31,s-01,A,1,,2025-03-01 10:00:00 UTC,1,200,5.0,90,0.0,1,1,5.0\n"
        "Ann Bee,31,s-01,A,1,,2025-03-01 11:00:00 UTC,2,190,0.0,100,5.0,1,1,5.0\n"
    )
    assert {(r["student_id"], r["case"]): (r["attempt"], r["verdict"]) for r in ran.rows()} == {
        ("s-01", "lever"): ("2", "wrong"),
        ("s-01", "pusher"): ("2", "right"),
    }


def test_canvas_gradebook_skips_what_is_no_student(a_class: Class) -> None:
    ran = a_class.grade(
        "Student,ID,SIS User ID,SIS Login ID,Section,lever (1234)\n"
        ",,,,,Manual Posting\n"
        "    Points Possible,,,,,5.0\n"
        '"Bee, Ann",31,s-01,ann,A,200\n'
        '"Student, Test",99,,x,A,1\n'
    )
    assert [(r["student_id"], r["verdict"]) for r in ran.rows()] == [("s-01", "right")]


def test_moodle_responses_in_german_with_a_mapped_question(a_class: Class) -> None:
    table = (
        "\ufeffVorname;Nachname;E-Mail-Adresse;Status;Begonnen am;Beendet;Verbrauchte Zeit;"
        "Bewertung/10,00;Antwort 1\r\n"
        "Ann;Bee;ann@x.test;Beendet;1. März 2025  10:00;1. März 2025  10:30;30 Minuten;10,00;200,0 N·m\r\n"
        "Bob;Cee;bob@x.test;Beendet;1. März 2025  10:00;1. März 2025  10:30;30 Minuten;0,00;-\r\n"
        "Gesamtdurchschnitt;;;;;;;5,00;\r\n"
    )
    ran = a_class.grade(table, "--map", "Antwort 1=lever")
    assert [(r["student_id"], r["verdict"]) for r in ran.rows()] == [
        ("ann@x.test", "right"),
        ("bob@x.test", "missing"),
    ]


def test_moodle_questions_without_a_map_are_asked_for(a_class: Class) -> None:
    ran = a_class.grade(
        "First name,Surname,Email address,State,Response 1\nAnn,Bee,ann@x.test,Finished,200\n"
    )
    assert ran.code == 2
    assert "'Response 1'" in ran.err
    assert "--map" in ran.err


@pytest.mark.parametrize(
    ("header", "missing", "own"), [("student,case,P", "answer", "P"), ("student,task,answer", "case", "task")]
)
def test_of_a_table_of_a_row_an_answer_the_column_that_is_missing_is_named(
    a_class: Class, header: str, missing: str, own: str
) -> None:
    table = f"{header}\n7,lever,200\n"
    ran = a_class.grade(table)
    assert ran.code == 2 and f'--map {missing}="..."' in ran.err
    assert [r["verdict"] for r in a_class.grade(table, "--map", f"{missing}={own}").rows()] == ["right"]


def test_a_mapped_column_that_is_missing_is_named_with_the_way_out(a_class: Class) -> None:
    ran = a_class.grade("student_id,case,answer\n7,lever,200\n", "--map", "student_id=Email Address")
    assert ran.code == 2
    assert "there is no column 'Email Address' for student_id" in ran.err
    assert "leave it out" in ran.err


def test_google_forms(a_class: Class) -> None:
    ran = a_class.grade(
        'Timestamp,Email Address,Score,"lever: What is T in N*m?",Your name\n'
        "3/1/2025 10:00:00,ann@x.test,0 / 10,200,Ann\n"
        "3/1/2025 11:00:00,ann@x.test,0 / 10,210,Ann\n"
    )
    (row,) = ran.rows()
    assert (row["student_id"], row["raw_answer"]) == ("ann@x.test", "210")
    assert "'Your name' names no case" in ran.err


def test_a_quiz_of_google_forms_has_columns_that_are_no_answers(a_class: Class) -> None:
    ran = a_class.grade(
        "Timestamp,Email Address,Score,Q1 (lever),Q1 (lever) [Score],Q1 (lever) [Feedback],Q2,Q2 [Score]\n"
        "2025/03/01 10:00:00 AM GMT+1,ann@x.test,0 / 2,200,0 / 1,no,100,0 / 1\n",
        "--map",
        "Q2=pusher",
    )
    assert (ran.code, ran.err) == (0, "")
    assert [(r["case"], r["raw_answer"]) for r in ran.rows()] == [("lever", "200"), ("pusher", "100")]


def test_prairielearn_manual_grading(a_class: Class) -> None:
    out = io.StringIO()
    table = csv.writer(out)
    table.writerow(
        "uid uin qid old_score_perc old_feedback submission_id params true_answer submitted_answer".split()
    )
    for uid, qid, answer in (
        ("ann@x.test", "statics/lever", json.dumps({"T": "200 N*m"})),
        ("bob@x.test", "statics/lever", json.dumps({"answer": -200, "_file": "x"})),
        ("cee@x.test", "statics/lever", "{broken"),
    ):
        table.writerow([uid, "1", qid, "", "", "5", "{}", "{}", answer])
    ran = a_class.grade(out.getvalue())
    assert [(r["student_id"], r["case"], r["verdict"]) for r in ran.rows()] == [
        ("ann@x.test", "lever", "right"),
        ("bob@x.test", "lever", "wrong"),
        ("cee@x.test", "lever", "review"),
    ]
    assert "answers.csv:4: the submitted answer is not a JSON object" in ran.err


def test_a_mapped_column_of_a_question_that_no_table_has_is_told(a_class: Class) -> None:
    """All would miss the question in silence; of several tables one may have it."""
    mapped = ("--map", "Q3=lever", "--map", "Q4=pusher")
    told = "no column is called 'Q4', by which the answers to pusher are to be known"
    ran = a_class.grade("student_id,Q3\n7,200\n", *mapped)
    assert ran.code == 0 and told in ran.err and "'Q3'" not in ran.err
    a_class.course("map: {Q3: lever, Q4: pusher}\n")
    assert told in a_class.grade("student_id,lever\n7,200\n").err
    assert a_class.grade("student_id,Q3,Q4\n7,200,3\n", *mapped).err == ""


@pytest.mark.parametrize("swapped", [(), ("student_id",), ("Q3",), ("student_id", "Q3")])
def test_a_map_may_be_written_either_way_round(a_class: Class, swapped: tuple[str, ...]) -> None:
    maps = [("student_id", "Matr"), ("Q3", "lever")]
    turned = [f"{b}={a}" if a in swapped else f"{a}={b}" for a, b in maps]
    ran = a_class.grade("Matr,Name,Q3\n7,A,200\n", *(word for one in turned for word in ("--map", one)))
    assert [(row["student_id"], row["verdict"]) for row in ran.rows()] == [("7", "right")]


def test_unknown_headers_are_mapped_on_the_command_line_or_in_the_course(a_class: Class) -> None:
    table = "Matr,Lösung Q3 (5 Punkte)\n0042,200\n"
    ran = a_class.grade(table)
    assert ran.code == 2
    assert "'Matr', 'Lösung Q3 (5 Punkte)'" in ran.err
    ran = a_class.grade(table, "--map", "student_id=Matr", "--map", "Lösung Q3=lever")
    assert ran.row("0042")["verdict"] == "right"
    a_class.course("map: {student_id: Matr, Lösung Q3: lever}\n")
    assert a_class.grade(table).row("0042")["verdict"] == "right"


def test_ids_are_text(a_class: Class) -> None:
    ran = a_class.grade(
        'student_id,case,answer\n007,lever,200\n7,lever,200\n"=""0012""",lever,200\n1E5,lever,200\n'
    )
    assert [r["student_id"] for r in ran.rows()] == ["0012", "007", "1E5", "7"]


@pytest.mark.parametrize("unseen", ["\u200b", "\u200e", "\u2060", "\ufeff", "\u00a0"])
def test_signs_that_are_not_seen_make_no_other_student(a_class: Class, unseen: str) -> None:
    ran = a_class.grade(f"student_id,case,answer,attempt\n0042{unseen},lever,200,2\n0042,lever,1,1\n")
    assert [(r["student_id"], r["verdict"]) for r in ran.rows()] == [("0042", "right")]


def test_a_line_that_is_cut_short_is_listed_and_the_others_graded(a_class: Class) -> None:
    ran = a_class.grade("student_id,case,answer\na,lever,200\nb,lev")
    assert ran.code == 1
    assert ran.row("a")["verdict"] == "right"
    assert "answers.csv:3: this row has 2 cells under 3 columns" in ran.err
    assert ran.row("b", "lev")["verdict"] == "review"


def test_a_quote_that_is_never_closed_costs_its_own_line_only(a_class: Class) -> None:
    rows = [f"s{n:03d},lever,200" for n in range(120)]
    rows[40] = 's040,lever,"200'
    ran = a_class.grade("student_id,case,answer\n" + "\n".join(rows) + "\n")
    assert "answers.csv:42: a quoted cell starts here and does not end" in ran.err
    assert {r["student_id"] for r in ran.rows() if r["verdict"] == "right"} == {
        f"s{n:03d}" for n in range(120) if n != 40
    }


def test_a_file_cut_within_a_quoted_cell(a_class: Class) -> None:
    ran = a_class.grade('student_id,case,answer\na,lever,200\nb,lever,"20')
    assert ran.row("a")["verdict"] == "right"
    assert "answers.csv:3: a quoted cell starts here and does not end" in ran.err


def test_bytes_of_another_encoding_do_not_lose_a_row(a_class: Class) -> None:
    ran = a_class.grade(b"student_id,case,answer\nm\xfcller,lever,200\n\xff\xfe,lever,200\n")
    assert [r["verdict"] for r in ran.rows()] == ["right", "right"]
    assert "müller" in {r["student_id"] for r in ran.rows()}


def test_nul_characters_are_taken_out_and_told(a_class: Class) -> None:
    ran = a_class.grade(b"student_id,case,answer\na,lever,2\x0000\nb,lever,200\n")
    assert [r["verdict"] for r in ran.rows()] == ["right", "right"]
    assert "answers.csv:2: nul characters are taken out" in ran.err


def test_a_cell_of_a_million_characters(a_class: Class) -> None:
    ran = a_class.grade("student_id,case,answer\na,lever," + "9" * 10**6 + "\nb,lever,200\n")
    assert ran.row("b")["verdict"] == "right"
    assert ran.row("a")["verdict"] == "review"
    assert len(ran.out) < 5000


def test_a_line_longer_than_any_answer_is_for_a_person(a_class: Class) -> None:
    ran = a_class.grade("student_id,case,answer\na,lever," + "9" * 5 * 10**6 + "\nb,lever,200\n")
    assert (ran.row("a")["verdict"], ran.row("b")["verdict"]) == ("review", "right")
    assert "answers.csv:2: this line is longer than" in ran.err


def test_a_formula_in_a_name_comes_out_as_text(a_class: Class) -> None:
    out = io.StringIO()
    csv.writer(out).writerows(
        [("student_id", "case", "answer"), (FORMULA, "lever", "=1+1"), ("@x", "lever", "-200")]
    )
    ran = a_class.grade(out.getvalue())
    cells = [cell for row in ran.rows() for cell in row.values()]
    assert "'" + FORMULA in cells
    assert "'=1+1" in cells
    assert "'@x" in cells
    assert "-200" in cells
    assert not any(cell.startswith(("=", "+", "@")) for cell in cells)


def test_a_thousands_separator_without_quotes_is_listed(a_class: Class) -> None:
    ran = a_class.grade('student_id,case,answer\na,lever,1,234\nb,lever,"1,234.5"\nc,lever,"200,00"\n')
    assert (
        "answers.csv:2: this row has 4 cells under 3 columns: is a comma within a cell without quotes?"
        in ran.err
    )
    assert [(r["student_id"], r["verdict"]) for r in ran.rows()] == [
        ("a", "review"),
        ("b", "wrong"),
        ("c", "right"),
    ]


def test_half_empty_rows(a_class: Class) -> None:
    ran = a_class.grade("student_id,case,answer\n,lever,200\nb,,200\n\n , ,\nc,lever,\nd,lever,200\n")
    assert ran.code == 1
    assert (
        "answers.csv:2: (and line 5)" in ran.err or "answers.csv:2: this row has no student's id" in ran.err
    )
    assert "answers.csv:3: this row names no case" in ran.err
    assert ran.row("c")["verdict"] == "missing"
    assert ran.row("d")["verdict"] == "right"


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"", "there is nothing in it"),
        (b"\n\n", "there is nothing in it"),
        (b"student_id,case,answer\n", "there is no answer in it, only a header"),
        (b"PK\x03\x04rest of a spreadsheet", "this is not a text file; save it as CSV"),
        (b"a,b\n1,2\n", "these columns are of no known platform: 'a', 'b'"),
    ],
)
def test_a_file_that_is_no_table_of_answers(a_class: Class, data: bytes, said: str) -> None:
    ran = a_class.grade(data)
    assert ran.code == 2
    assert said in ran.err


def test_excels_own_first_line(a_class: Class) -> None:
    assert a_class.grade("sep=;\nstudent_id;case;answer\na;lever;200,0\n").row("a")["verdict"] == "right"


def test_damaged_files_never_break_the_command(a_class: Class) -> None:
    """A table with bytes changed, cut out and repeated at random: graded or refused, and said so."""
    rng = random.Random(11)
    rows = "".join(f's{n:02d},lever,"{200 + n} N·m ccw",{n % 3},2025-03-0{1 + n % 9}\r\n' for n in range(40))
    whole = ("student_id,case,answer,attempt,submitted_at\r\n" + rows).encode()
    for _ in range(120 if FULL else 50):
        data = bytearray(whole)
        for _ in range(rng.randrange(1, 12)):
            at = rng.randrange(len(data))
            damage = rng.choice(("byte", "cut", "again", "quote", "nul"))
            if damage == "byte":
                data[at] = rng.randrange(256)
            elif damage == "cut":
                del data[at : at + rng.randrange(40)]
            elif damage == "again":
                data[at:at] = data[at : at + rng.randrange(60)]
            else:
                data[at:at] = b'"' if damage == "quote" else b"\0"
            data = data or bytearray(b",")
        ran = a_class.grade(bytes(data))
        assert ran.code in (0, 1, 2), ran.err
        assert ran.code != 2 or ran.err


def test_of_two_columns_of_one_question_the_last_counts_and_is_told_as_a_column(a_class: Class) -> None:
    ran = a_class.grade("student_id,lever,lever:T\n1,100,200\n2,200,100\n")
    assert [row["verdict"] for row in ran.rows()] == ["right", "wrong"]
    assert "the last column counts" in ran.err
    ran = a_class.grade("student_id,case,answer\n1,lever,100\n1,lever,200\n")
    assert "the last row counts" in ran.err


@pytest.mark.parametrize("unseen", ["\u200b", "\u200d", "\u2060", "\u00ad", "\ufe0f"])
@pytest.mark.parametrize(
    "table",
    [
        "student_id,ca*se,answer\n1,lever,200\n",
        "*student_id,case,answ*er*\n1,lever,200\n",
        "student_id,case,answer\n1,lev*er*,200\n",
        "student_id,case,answer\n1,lever:*T*,200\n",
        "student_id,le*ver\n1,200\n",
    ],
)
def test_what_nobody_sees_makes_no_other_name(table: str, unseen: str, a_class: Class) -> None:
    """Of a column or of a case: pages put such marks between the letters of what is copied from them."""
    plain, marked = (a_class.grade(table.replace("*", mark)).rows() for mark in ("", unseen))
    assert plain == marked
    assert marked[0]["verdict"] == "right"


ACCENTS = {
    "answers": "student_id,case,answer\n{o},{o},200 N*m\n김철수,{o},200 N*m sentido horário\n",
    "wide": "student_id,{o},lever\n{o},200 N*m,200\n",
    "mapped": "student_id,Réponse\n{o},200 N*m\n",
    "roster": "student_id,name,email\n{o},Zoë,z@x.edu\n김철수,Kim,k@x.edu\n",
    "marks": "student_id,case,score\n{o},{o},50%\n",
    "book": "Student,ID,SIS User ID,SIS Login ID,Section,{o} (91)\n    Points Possible,,,,,8\nZ,1,{o},,,\n",
    "course": 'cases: {{"{o}": {{points: 4}}, "{o}:T": {{points: 4}}}}\n',
}


@pytest.mark.parametrize("changed", ["nothing", "case", *ACCENTS])
def test_an_accent_is_one_with_its_letter_wherever_a_name_stands(a_class: Class, changed: str) -> None:
    """Names of students, cases and columns, and words of answers, are the same however a system writes its
    accents: beside or within their letters."""

    def written(what: str) -> str:
        text = ACCENTS.get(what, "{o}.yaml").format(o="Prüfung José")
        return normalize("NFD" if what == changed else "NFC", text)

    (a_class.folder / "cases/lever.yaml").rename(a_class.folder / "cases" / written("case"))
    a_class.case("lever", (a_class.folder / "cases" / written("case")).read_text(encoding="utf-8"))
    a_class.course(written("course"))
    options = ["--roster", a_class.file("roster.csv", written("roster"))]
    options += ["--overrides", a_class.file("marks.csv", written("marks"))]
    form = "NFD" if changed == "mapped" else "NFC"
    found = []
    for table, more in (
        ("answers", []),
        ("wide", []),
        ("mapped", ["--map", normalize(form, "Réponse=Prüfung José")]),
    ):
        ran = a_class.grade(written(table), *options, *more)
        assert ran.code == 0
        assert "roster" not in ran.err
        assert "no case" not in ran.err
        found.append([(r["student_id"], r["case"], r["verdict"], r["score"]) for r in ran.rows()])
    one = "Prüfung José"
    assert (one, one, "wrong", "2") in found[0]
    assert ("김철수", one, "wrong", "0") in found[0]
    assert all(student in (one, "김철수") for rows in found for student, *_ in rows)
    assert (one, "lever", "right", "1") in found[1]
    assert (one, one, "wrong", "2") in found[2]
    book = ("--template", a_class.file("book.csv", written("book")))
    out = str(a_class.path("marks-out.csv"))
    for more in ((), ("--total", f"{one} (91)")):
        ran = a_class.grade(written("answers"), *options, *book, "--write", f"canvas={out}", "--force", *more)
        assert ran.code == 0
        points, student = Path(out).read_text(encoding="utf-8").splitlines()[1:]
        assert (points.split(",")[5], student.split(",")[5]) == ("8", "4")
