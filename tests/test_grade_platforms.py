"""Tables of all platforms: found by their headers, in the languages that they speak; what is junk is no
question.
"""

from __future__ import annotations

import csv
import io
import json
import random
import zipfile
from pathlib import Path
from xml.sax.saxutils import escape

import pytest

from grade_shell import PRESS, Class, Ran


@pytest.fixture
def a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    return Class(tmp_path, capsys)


def marks(ran: Ran) -> dict[tuple[str, str], str]:
    """Verdicts by student and question."""
    return {(row["student_id"], row["case"]): row["verdict"] for row in ran.rows()}


RIGHT = {("a@x.test", "lever"): "right", ("b@x.test", "lever"): "wrong"}
MOODLE = {
    "English": "Last name,First name,Email address,State,Started on,Completed,Time "
    "taken,Grade/10.00,Response 1",
    "German": "Nachname;Vorname;E-Mail-Adresse;Status;Begonnen am;Beendet;Verbrauchte "
    "Zeit;Bewertung/10,00;Antwort 1",
    "French": "Nom,Prénom,Adresse de courriel,État,Commencé le,Terminé,Temps utilisé,Note/10.00,Réponse 1",
    "Spanish": "Apellido(s),Nombre,Dirección de correo,Estado,Comenzado el,Finalizado,Tiempo requerido,"
    "Calificación/10.00,Respuesta 1",
    "Italian": "Cognome,Nome,Indirizzo email,Stato,Iniziato,Terminato,Tempo "
    "impiegato,Valutazione/10.00,Risposta 1",
    "Portuguese": "Sobrenome,Nome,Endereço de email,Estado,Iniciado em,Completo,Tempo "
    "utilizado,Avaliar/10.00,Resposta 1",
    "Dutch": "Achternaam;Voornaam;E-mailadres;Status;Gestart op;Voltooid;Verstreken "
    "tijd;Cijfer/10,00;Antwoord 1",
}


@pytest.mark.parametrize("language", MOODLE)
def test_moodle_in_its_common_languages(a_class: Class, language: str) -> None:
    header = MOODLE[language]
    d = ";" if ";" in header else ","
    rows = [
        ["A", "Ann", "a@x.test", "x", "", "", "", "1", "200"],
        ["B", "Bob", "b@x.test", "x", "", "", "", "0", "-200"],
    ]
    column = header.split(d)[-1]
    table = "\n".join([header, *(d.join(row) for row in rows)]) + "\n"
    assert marks(a_class.grade(table, "--map", f"{column}=lever")) == RIGHT


ENDED = {
    "English": ("28 February 2025  11:30 PM", "1 March 2025  9:05 AM"),
    "German": ("28. Februar 2025 23:30", "1. März 2025 09:05"),
    "French": ("28 février 2025, 23:30", "1 mars 2025, 09:05"),
    "Spanish": ("28 de febrero de 2025, 23:30", "1 de marzo de 2025, 09:05"),
    "Italian": ("28 febbraio 2025, 23:30", "1 marzo 2025, 09:05"),
    "Portuguese": ("28 de fevereiro de 2025 23:30", "1 de março de 2025 09:05"),
    "Dutch": ("28 februari 2025 23:30", "1 maart 2025 09:05"),
}
"""When two attempts of a student were handed in, as Moodle writes it."""


@pytest.mark.parametrize("language", MOODLE)
def test_the_last_attempt_on_moodle_is_the_one_handed_in_last(a_class: Class, language: str) -> None:
    """In whichever order the rows stand; nothing is noted, for nothing is in doubt."""
    header = MOODLE[language]
    d = ";" if ";" in header else ","
    column = header.split(d)[-1]
    before, last = ENDED[language]
    rows = [f'A{d}Ann{d}a@x.test{d}x{d}{d}"{time}"{d}{d}1{d}{answer}' for time, answer in
            ((before, "200"), (last, "-200"))]  # fmt: skip
    for lines in (rows, rows[::-1]):
        for which, verdict in (("last", "wrong"), ("first", "right")):
            table = "\n".join([header, *lines]) + "\n"
            ran = a_class.grade(table, "--map", f"{column}=lever", "--attempt", which)
            assert (marks(ran), ran.err) == ({("a@x.test", "lever"): verdict}, "")


ID_NUMBERS = {
    "German": "Nachname,Vorname,ID-Nummer,E-Mail-Adresse,Status,Begonnen am,Antwort 1",
    "French": "Nom,Prénom,Numéro d\u2019identification,Adresse de courriel,Statut,Commencé le,Réponse 1",
    "Spanish": "Apellido(s),Nombre,Número de ID,Dirección de correo,Estado,Comenzado el,Respuesta 1",
    "Dutch": "Achternaam,Voornaam,ID-nummer,E-mailadres,Status,Gestart op,Antwoord 1",
}


@pytest.mark.parametrize("language", ID_NUMBERS)
def test_id_numbers_are_known_by_the_answers_and_by_a_roster_of_the_same_language(
    a_class: Class, language: str
) -> None:
    """The roster is Moodle's own list of people; the answers have the id number alone."""
    header = ID_NUMBERS[language].split(",")
    roster = a_class.file("people.csv", ",".join(header[:4]) + "\nA,Ann,0042,a@x.test\n")
    table = ",".join(header) + "\nA,Ann,0042,,x,,200\n"
    ran = a_class.grade(table, "--map", f"{header[-1]}=lever", "--roster", roster)
    assert marks(ran) == {("0042", "lever"): "right"}


FORMS = (
    "ID,Start time,Completion time,Email,Name,Total points,Quiz feedback,Find T. [lever],Points - Find "
    "T. [lever],"
    "Feedback - Find T. [lever],How long did you work?\n"
    "1,11/25/24 10:00:00,11/25/24 10:05:00,a@x.test,Ann,1,,200,1,good,2 h\n"
    "2,11/25/24 10:00:00,11/25/24 10:09:00,b@x.test,Bob,0,,-200,0,,3 h\n"
)


def test_microsoft_forms_has_no_question_but_the_ones_that_name_a_case(a_class: Class) -> None:
    ran = a_class.grade(FORMS)
    assert marks(ran) == RIGHT
    assert "'How long did you work?' names no case and is passed over" in ran.err


def workbook(rows: list[list[object]]) -> bytes:
    """An ``.xlsx`` as Forms writes it: shared texts, numbers, dates as numbers with a style."""
    texts: list[str] = []
    body = []
    for n, row in enumerate(rows, 1):
        cells = []
        for k, value in enumerate(row):
            name = f"{chr(65 + k)}{n}"
            if isinstance(value, str) and value:
                texts.append(value)
                cells.append(f'<c r="{name}" t="s"><v>{len(texts) - 1}</v></c>')
            elif isinstance(value, tuple):
                cells.append(f'<c r="{name}" s="1"><v>{value[0]}</v></c>')
            elif value != "":
                cells.append(f'<c r="{name}"><v>{value}</v></c>')
        body.append(f'<row r="{n}">{"".join(cells)}</row>')
    main = 'xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"'
    relation = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
    package = "http://schemas.openxmlformats.org/package/2006/relationships"
    parts = {
        "xl/workbook.xml": f'<workbook {main} xmlns:r="{relation}"><sheets>'
        '<sheet name="Form1" sheetId="1" r:id="rId7"/></sheets></workbook>',
        "xl/_rels/workbook.xml.rels": f'<Relationships xmlns="{package}"><Relationship Id="rId7" '
        'Target="worksheets/answers.xml"/></Relationships>',
        "xl/styles.xml": f'<styleSheet {main}><cellXfs><xf numFmtId="0"/><xf numFmtId="22"/></cellXfs>'
        "</styleSheet>",
        "xl/sharedStrings.xml": f"<sst {main}>{''.join(f'<si><t>{escape(t)}</t></si>' for t in texts)}</sst>",
        "xl/worksheets/answers.xml": f"<worksheet {main}><sheetData>{''.join(body)}</sheetData></worksheet>",
    }
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        for name, text in parts.items():
            archive.writestr(name, text)
    return out.getvalue()


def test_a_workbook_is_a_table_in_a_zip(a_class: Class) -> None:
    """Two attempts of one student: the later one, by a date that is kept as a number, counts."""
    header = ["ID", "Start time", "Completion time", "Email", "Name", "lever"]
    data = workbook([
        header, [1, (45678.5,), (45679.25,), "a@x.test", "Ann", 200],
        [2, (45678.5,), (45678.75,), "a@x.test", "Ann", 5],
        [3, (45678.5,), (45678.75,), "b@x.test", "Bob & Co", "-200 N*m"],
    ])  # fmt: skip
    assert marks(a_class.grade(data, name="forms.xlsx")) == RIGHT


@pytest.mark.parametrize("cut", [100, 400])
def test_a_broken_workbook_is_refused_by_name(a_class: Class, cut: int) -> None:
    data = workbook([["student_id", "lever"], ["a", 200]])
    ran = a_class.grade(data[:cut], name="forms.xlsx")
    assert (ran.code, "forms.xlsx: " in ran.err) == (2, True)


def test_canvas_quizzes_without_sis_ids(a_class: Class) -> None:
    table = (
        "name,id,section,section_id,section_sis_id,submitted,attempt,991: lever,1.0,n correct,n "
        "incorrect,score\n"
        "Ann,41,S,7,,2025-03-01 10:00:00 UTC,1,200,1.0,1,0,1\nBob,42,S,7,,2025-03-01 10:00:00 "
        "UTC,1,-200,0,0,1,0\n"
    )
    assert marks(a_class.grade(table)) == {("41", "lever"): "right", ("42", "lever"): "wrong"}


@pytest.mark.parametrize(
    "header",
    [
        "Student;ID;SIS User ID;SIS Login ID;Section;lever (12)",
        "Student,ID,Section,lever (12)",
        "LastName,FirstName,ID,SIS User ID,Section,lever (12)",
    ],
)
def test_canvas_gradebooks_with_other_separators_and_names(a_class: Class, header: str) -> None:
    d = ";" if ";" in header else ","
    names = header.split(d)
    rows = [
        d.join({"ID": i, "SIS User ID": i, "lever (12)": v, names[0]: "x"}.get(name, "") for name in names)
        for i, v in (("41", "200"), ("42", "-200"))
    ]
    points = d.join(["    Points Possible", *[""] * (len(names) - 2), "1"])
    ran = a_class.grade("\n".join([header, points, *rows]) + "\n")
    assert marks(ran) == {("41", "lever"): "right", ("42", "lever"): "wrong"}


def test_a_comma_of_a_blank_that_canvas_escapes(a_class: Class) -> None:
    table = 'name,id,sis_id,991: lever,1.0\nAnn,1,a,"200\\,0 N*m",1\n'
    assert marks(a_class.grade(table)) == {("a", "lever"): "right"}


def test_blackboard_by_user_and_by_question(a_class: Class) -> None:
    wide = (
        "Username,Last Name,First Name,Question ID 1,Question 1,Answer 1,Possible Points 1,Auto Score 1\n"
        "a,A,Ann,_1,Find T. [lever],200,1,1\nb,B,Bob,_1,Find T. [lever],-200,1,0\n"
    )
    long = (
        "Username\tLast Name\tFirst Name\tQuestion ID\tQuestion\tAnswer\tPossible Points\n"
        "a\tA\tAnn\t_1\tFind T. [lever]\t200\t1\nb\tB\tBob\t_1\tFind T. [lever]\t-200\t1\n"
    )
    for table in (wide, long.encode("utf-16")):
        assert marks(a_class.grade(table)) == {("a", "lever"): "right", ("b", "lever"): "wrong"}


def test_blackboard_knows_its_students_by_the_first_id_of_its_columns(a_class: Class) -> None:
    """In whatever column it stands, the first one too; a table without ids is refused."""
    answers = "Question 1,Answer 1"
    for head, cells in (("Student ID,Username", "007,ann"), ("Username,Student ID", "ann,007")):
        table = f"{head},{answers}\n{cells},Find T. [lever],200\n"
        assert marks(a_class.grade(table)) == {("007", "lever"): "right"}
    ran = a_class.grade(f"{answers}\nFind T. [lever],200\n")
    assert ran.code == 2
    assert "no column holds the student's id" in ran.err


def test_brightspace_with_its_hashes(a_class: Class) -> None:
    table = (
        "Org Defined ID,Username,FirstName,LastName,Attempt #,Attempt Start,Attempt End,Section #,Q #,Q "
        "Type,Q Title,"
        "Q Text,Bonus?,Difficulty,Answer,Answer Match,Score,Out Of\n"
        "#0017,a,Ann,A,1,,,,1,SA,lever,Find T,,1,200,,1,1\n#0018,b,Bob,B,1,,,,1,SA,lever,Find "
        "T,,1,-200,,0,1\n"
    )
    assert marks(a_class.grade(table)) == {("0017", "lever"): "right", ("0018", "lever"): "wrong"}


def test_a_column_much_like_a_case_is_listed_and_junk_is_not(a_class: Class) -> None:
    ran = a_class.grade("student_id,lever,pushr,Duration,IP address,Remarks\na,200,5,12,1.2.3.4,hi\n")
    assert {row["case"] for row in ran.rows()} == {"lever", "pushr"}
    assert "there is no case 'pushr'" in ran.err
    assert "'Remarks' names no case" in ran.err


DATED = "student_id,case,answer,submitted_at\n"


def test_dates_are_read_in_the_order_that_their_column_shows(a_class: Class) -> None:
    """5 December is after 6 November; month first 05/12 would be in May."""
    rows = "a,lever,200,05/12/2024 10:00\na,lever,5,06/11/2024 10:00\n"
    day = a_class.grade(DATED + rows + "b,lever,1,25/11/2024 10:00\n")
    month = a_class.grade(DATED + rows + "b,lever,1,11/25/2024 10:00\n")
    assert (day.row("a")["verdict"], month.row("a")["verdict"]) == ("right", "wrong")


def test_dates_whose_order_is_not_to_be_seen_are_refused_with_both_readings(a_class: Class) -> None:
    rows = "a,lever,200,05/12/2024 10:00\na,lever,5,06/11/2024 10:00\nb,lever,200,05/12/2024 9:00\n"
    ran = a_class.grade(DATED + rows)
    assert (ran.code, ran.row("a")["verdict"], ran.row("b")["verdict"]) == (1, "review", "right")
    assert "can be read month first or day first" in ran.err
    assert a_class.grade(DATED + rows, "--dates", "day").row("a")["verdict"] == "right"
    assert a_class.grade(DATED + rows, "--dates", "month").row("a")["verdict"] == "wrong"


def test_the_order_of_dates_does_not_matter_where_both_give_the_same(a_class: Class) -> None:
    ran = a_class.grade(DATED + "a,lever,5,05/10/2024 10:00\na,lever,200,06/11/2024 10:00\n")
    assert (ran.code, ran.row("a")["verdict"]) == (0, "right")


def test_ids_that_a_spreadsheet_has_rounded_are_refused_by_name(a_class: Class) -> None:
    ran = a_class.grade("student_id,case,answer\n2.00E+08,lever,200\n2.00E+08,lever,5\n200000003,lever,200\n")
    assert ran.code == 1
    assert "the id '2.00E+08' was rounded by a spreadsheet" in ran.err
    assert [row["verdict"] for row in ran.rows() if not row["student_id"]] == ["review", "review"]
    assert ran.row("200000003")["verdict"] == "right"


def test_an_email_of_two_students_is_refused_by_name(a_class: Class) -> None:
    roster = a_class.file("roster.csv", "student_id,email\n1,x@x.test\n2,x@x.test\n3,y@x.test\n")
    ran = a_class.grade("email,case,answer\nx@x.test,lever,200\ny@x.test,lever,200\n", "--roster", roster)
    assert "'x@x.test' is that of 1 and 2 on the roster" in ran.err
    assert ran.row("3")["verdict"] == "right"
    assert ran.row("1")["verdict"] == ran.row("2")["verdict"] == "missing"


def test_one_bad_hand_in_is_one_students(a_class: Class) -> None:
    """A class's export in which one file is empty, one binary, one has empty lines and blank answers."""
    folder = a_class.path("export")
    people = {
        "1": b"lever: 200\n\npusher:\n",
        "2": b"",
        "3": b"\x89PNG\r\n\x1a\n\0\0",
        "4": b"\n\nlever = 200\n,,\n",
    }
    about = ""
    for student, data in people.items():
        (folder / f"submission_{student}").mkdir(parents=True)
        (folder / f"submission_{student}" / "answers.txt").write_bytes(data)
        about += f'submission_{student}:\n  :submitters:\n  - :name: N\n    :sid: "{student}"\n'
    (folder / "submission_metadata.yml").write_text(about)
    ran = a_class.run("grade", folder, "--cases", a_class.path("cases"), "-o", "-", "-q")
    found = {s: ran.row(s)["verdict"] for s in people}
    assert found == {"1": "right", "2": "missing", "3": "missing", "4": "right"}
    assert ran.row("1", "pusher")["verdict"] == "missing"
    assert "what 2 handed in can't be used: there is nothing in it" in ran.err


def test_what_a_group_handed_in_is_each_ones(a_class: Class) -> None:
    """Groups of one to four, of whom some have no SID; of one group no answer came in."""
    groups = (["1"], ["2", "0003"], ["4", "e@x.test", "6"], ["7", "8", "9", "10"])
    folder, about = a_class.path("export"), ""
    for n, people in enumerate(groups):
        (folder / f"submission_{n}").mkdir(parents=True)
        if n != 2:
            (folder / f"submission_{n}" / "answers.txt").write_text("lever: 200\n")
        about += f"submission_{n}:\n  :submitters:\n"
        for who in people:
            about += f"  - :name: N\n    :{'email' if '@' in who else 'sid'}: '{who}'\n"
    (folder / "submission_metadata.yml").write_text(about)
    ran = a_class.run("grade", folder, "--cases", a_class.path("cases"), "-o", "-", "-q")
    found = [[ran.row(who, "lever")["verdict"] for who in people] for people in groups]
    assert found == [["right"], ["right"] * 2, ["missing"] * 3, ["right"] * 4]


def test_a_title_beside_the_name_of_a_case_names_the_case(a_class: Class) -> None:
    """In Blackboard's cells, in Canvas' headers; a quantity that the case does not have is no title."""
    table = "Username,Question 1,Answer 1\njdoe,lever: find the torque,200\n"
    assert marks(a_class.grade(table)) == {("jdoe", "lever"): "right"}
    head = "name,id,sis_id,submitted,991: lever - what is T?,2,n correct,n incorrect,score\n"
    row = "Jo,11,007,2026-11-20 10:00:00 UTC,200,2,1,0,2\n"
    assert marks(a_class.grade(head + row)) == {("007", "lever"): "right"}
    ran = a_class.grade("student_id,case,answer\n1,lever: w9/w2,200\n2,lever: v C on 9,200\n")
    assert {row["verdict"] for row in ran.rows()} == {"review"}


FIVE_BAR = """\
icsolve: 1
variables: {F: {range: [100, 400], step: 10}}
points: {A: [0, 0], E: [2, 0]}
lengths: {AB: 1, BC: 1.8, CD: 1.8, DE: 1}
angles: {AB: 110, ED: 60}
near: {C: [1, 2.6]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 5], at: D}
  - {pin: [5, 1], at: E}
loads:
  F: {force: $F, link: 3, at: C, angle: -60}
  T2: {torque: unknown, link: 2}
  T5: {torque: unknown, link: 5}
"""
SUBMITTED = (
    "uid uin qid old_score_perc old_feedback submission_id params true_answer submitted_answer".split()
)


def test_what_prairielearn_was_given_comes_back_from_it(a_class: Class) -> None:
    """Each question has its folder's name there, and each student's numbers stand in its row, drawn by
    PrairieLearn's own seed, another for every question: these are the numbers of the answer."""
    a_class.case("press", PRESS)
    a_class.case("five", FIVE_BAR)
    a_class.course('cases: {press: {}, "press:w4/w2": {}, "five:T2": {}, "five:T5": {}, lever: {}}\n')
    out = a_class.path("questions")
    assert "wrote" in a_class.run("export", "prairielearn", a_class.path("cases"), "-o", out).err
    folders = {"press", "press-w4-w2", "five-T2", "five-T5", "lever"}
    assert folders <= {folder.name for folder in out.iterdir()}
    rng, rows = random.Random(5), []
    for student in range(4):
        for folder in sorted(folders):
            scope = {"__file__": str(out / folder / "server.py")}
            exec((out / folder / "server.py").read_text(), scope)
            data = {"variant_seed": str(rng.randrange(10**6)), "params": {}, "correct_answers": {}}
            scope["generate"](data)  # type: ignore[operator]
            params = dict(sorted(data["params"].items()))  # type: ignore[attr-defined]
            answer = data["correct_answers"]["answer"]  # type: ignore[index]
            turned = answer if student else answer.removeprefix("-") if answer[0] == "-" else "-" + answer
            cells = [json.dumps(params), "{}", json.dumps({"answer": turned})]
            rows.append([f"s{student}@x.test", student, f"statics/{folder}", "", "", len(rows), *cells])
    text = io.StringIO()
    csv.writer(text).writerows([SUBMITTED, *rows])
    scores = a_class.path("scores.csv")
    ran = a_class.grade(text.getvalue(), "--write", f"prairielearn-csv={scores}")
    assert ran.code == 0, ran.err
    verdicts = [(row["verdict"], row["code"]) for row in ran.rows() if row["student_id"] != "s0@x.test"]
    assert verdicts == [("right", "")] * (len(rows) - 5)
    assert [row["code"].split()[:1] for row in ran.rows() if row["student_id"] == "s0@x.test"] == [
        ["sign"]
    ] * 5
    table = csv.DictReader(io.StringIO(scores.read_text()))
    assert {row["qid"] for row in table} == folders


@pytest.mark.parametrize(
    "spoilt", ['{"P": "12,5", "a": "1"}', '{"P": NaN, "a": 1}', '{"P": 1e999, "a": "1"}']
)
def test_a_row_of_prairielearn_with_numbers_that_are_none_is_for_a_person(
    a_class: Class, spoilt: str
) -> None:
    a_class.case("press", PRESS)
    cells = ["s@x.test", 1, "press", "", "", 1, spoilt, "{}", json.dumps({"answer": "5 lbf*in cw"})]
    text = io.StringIO()
    csv.writer(text).writerows([SUBMITTED, cells])
    ran = a_class.grade(text.getvalue())
    assert [row["verdict"] for row in ran.rows()] == ["review"]
    assert "answers.csv:2: the number P of this row is " in ran.err
