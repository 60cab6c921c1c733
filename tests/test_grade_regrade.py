"""Regrading: marks by hand, the queue for a person, what changes; nothing unread is 0."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import pytest

from grade_shell import LEVER, Class, Ran

ANSWERS = (
    'student_id,case,answer\na,lever,200\nb,lever,"1,234"\nc,lever,1234 apples\nd,lever,1234  apples\n'
    "e,lever,no idea\nf,lever,-200\na,pusher,100\nb,pusher,100\n"
)


@pytest.fixture
def a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    return Class(tmp_path, capsys)


def graded(a_class: Class, *options: str, name: str = "results.csv", answers: str = ANSWERS) -> Ran:
    """A grading into a file."""
    table = a_class.file("answers.csv", answers)
    cases = str(a_class.path("cases"))
    return a_class.run("grade", table, "--cases", cases, "-o", a_class.path(name), "--force", *options)


def rows(a_class: Class, name: str) -> list[dict[str, str]]:
    with open(a_class.path(name), encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_what_is_not_judged_has_no_mark_and_is_in_no_mean(a_class: Class) -> None:
    ran = graded(a_class, "--jsonl", str(a_class.path("r.jsonl")))
    own = [r for r in rows(a_class, "results.csv") if r["case"] == "lever"]
    scores = {(r["student_id"], r["verdict"]): r["score"] for r in own}
    assert scores == {("a", "right"): "1", ("b", "review"): "", ("c", "review"): "", ("d", "review"): "",
                      ("e", "invalid"): "", ("f", "wrong"): "0"}  # fmt: skip
    assert "lever: 1 right, 1 wrong, 1 invalid, 3 review; mean 50%" in ran.out
    objects = [json.loads(line) for line in a_class.path("r.jsonl").read_text().splitlines()]
    assert {o["score"] for o in objects if o["verdict"] in ("review", "invalid")} == {None}


def test_a_column_most_of_which_is_unread_is_told_first(a_class: Class) -> None:
    ran = graded(a_class)
    first = ran.out.splitlines()[1]
    assert first.startswith("lever: 4 of 6 answers could not be read or judged")
    assert "'1234 apples' (2 times)" in first


def test_each_text_of_the_queue_stands_once_and_is_fed_back(a_class: Class) -> None:
    graded(a_class, "--review", str(a_class.path("queue.csv")))
    queue = rows(a_class, "queue.csv")
    assert [(q["answer"], q["count"], q["student_id"]) for q in queue] == [
        ("1234 apples", "2", "c;d"), ("1,234", "1", "b"), ("no idea", "1", "e"),
    ]  # fmt: skip
    queue[0] |= {"score": "0,5", "comment": "units?"}
    queue[2] |= {"score": "0"}
    with open(a_class.path("queue.csv"), "w", newline="") as file:
        table = csv.DictWriter(file, list(queue[0]))
        table.writeheader()
        table.writerows(queue)
    graded(a_class, "--overrides", str(a_class.path("queue.csv")), name="again.csv")
    found = {r["student_id"]: r for r in rows(a_class, "again.csv") if r["case"] == "lever"}
    assert {s: (found[s]["score"], found[s]["code"], found[s]["feedback"]) for s in "cde"} == {
        "c": ("0.5", "override", "Marked by hand: units?"),
        "d": ("0.5", "override", "Marked by hand: units?"),
        "e": ("0", "override", "Marked by hand."),
    }  # fmt: skip
    assert found["b"]["score"] == ""


def test_an_override_goes_over_a_verdict_and_leaves_all_others_alone(a_class: Class) -> None:
    graded(a_class)
    marks = a_class.file("marks.csv", "student_id,case,score,comment\nf,lever:T,50%,sense as told\n")
    ran = graded(a_class, "--overrides", marks, "--against", str(a_class.path("results.csv")), "--changes",
                 str(a_class.path("changes.csv")), name="new.csv")  # fmt: skip
    old, new = (a_class.path(name).read_text().splitlines() for name in ("results.csv", "new.csv"))
    assert [line for line in new if line not in old] == [
        "f,lever,,,-200,-200,,,wrong,0.5,1,0,override,Marked by hand: sense as told"
    ]
    (change,) = rows(a_class, "changes.csv")
    assert (change["student_id"], change["old_score"], change["new_score"]) == ("f", "0", "0.5")
    assert "against" in ran.out
    assert "f lever: 0 wrong (sign) -> 0.5 wrong (override): marked by hand: sense as told" in ran.out


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("student_id,case,score\na,lever,2\n", "marks.csv:2: the score '2' should be a number from 0 to 1"),
        ("student_id,case,score\na,lever,-1\n", "marks.csv:2: the score '-1' should be"),
        ("student_id,case,score\na,lever,nan\n", "marks.csv:2: the score 'nan' should be"),
        ("student_id,case,score\na,leber,1\n", "marks.csv:2: there is no case 'leber'"),
        ("student_id,case,score\na,lever,1\na,lever,0\n", "marks.csv:3: a has another score for lever"),
        ("student,problem,mark\na,lever,1\n", "it needs the columns student_id,case,score"),
    ],
)
def test_a_mark_by_hand_that_cannot_be_meant_is_refused(a_class: Class, text: str, message: str) -> None:
    ran = graded(a_class, "--overrides", a_class.file("marks.csv", text))
    assert ran.code == 2
    assert message in ran.err


def test_a_mark_for_nobody_is_told(a_class: Class) -> None:
    ran = graded(a_class, "--overrides", a_class.file("marks.csv", "student_id,case,score\nzz,lever,1\n"))
    assert ran.code == 1
    assert "marks.csv:2: zz neither owes lever nor answered it, so this mark is for nobody" in ran.err


def test_what_changes_is_told_with_its_reason(a_class: Class) -> None:
    """A corrected load, another tolerance, another answer, a new student, one who has left."""
    graded(a_class)
    a_class.case("lever", LEVER.replace("force: 100", "force: 101.5"))
    later = ANSWERS.replace("f,lever,-200", "f,lever,203").replace("b,pusher,100", "g,pusher,100")
    ran = graded(a_class, "--against", str(a_class.path("results.csv")), "--changes",
                 str(a_class.path("changes.csv")), name="new.csv", answers=later)  # fmt: skip
    found = {(c["student_id"], c["case"]): c["why"] for c in rows(a_class, "changes.csv")}
    assert found["a", "lever"] == "the key has changed"
    assert found["f", "lever"] == "another answer counts"
    assert found["g", "pusher"] == "a new row"
    assert found["b", "pusher"] == "another answer counts"
    assert "3 times" in ran.out or "2 times" in ran.out


BLOCK = """\
icsolve: 1
points: {A: [0, 0]}
joints: [{slide: [2, 1], at: A, along: 0, mu: 0.3}]
loads:
  N: {force: 100, link: 2, at: A, angle: -90}
  P: {force: unknown, link: 2, at: A, angle: 0}
"""
PINNED = """\
icsolve: 1
points: {A: [0, 0], B: [1, 0]}
joints: [{slide: [2, 1], at: A, along: 0}, {slide: [3, 2], at: B, along: 90}]
loads:
  W: {force: 100, link: 3, at: B, angle: -60}
  P: {force: [unknown, unknown], link: 3, at: B}
"""
LEANING = """\
icsolve: 1
points: {A: [0, 0], B: [0, 1]}
joints: [{slide: [2, 1], at: A, along: [A, B]}]
loads:
  W: {force: 100, link: 2, at: A, away: B}
  P: {force: unknown, link: 2, at: A, toward: B}
"""
TURNED = "the direction of the right answer, or how directions count"


@pytest.mark.parametrize(
    ("text", "was", "now", "answer", "why"),
    [
        (BLOCK, "mu: 0.3", "mu: 0.25", "-30 to 30 N", "the key has changed"),
        (BLOCK, "icsolve: 1", "icsolve: 1\ntolerance: 5%", "-31 to 29 N", "the tolerance, or what is asked"),
        (PINNED, "-60", "-70", "100 N at 120 deg", TURNED),
        (PINNED, "100", "110", "100 N at 120 deg", "the key has changed"),
        (LEVER, "angle: -90", "angle: 90", "200", TURNED),
        (LEANING, "B: [0, 1]", "B: [1, 0]", "100 N up", TURNED),
        (LEVER, "loads:", "lengths: {AB: 3}\nloads:", "200", "it can't be graded now"),
    ],
)
def test_a_changed_key_of_a_range_or_in_its_direction_is_told_as_one(
    a_class: Class, text: str, was: str, now: str, answer: str, why: str
) -> None:
    a_class.case("own", text)
    answers = f"student_id,case,answer\n1,own,{answer}\n"
    graded(a_class, answers=answers)
    a_class.case("own", text.replace(was, now))
    ran = graded(a_class, "--against", str(a_class.path("results.csv")), name="new.csv", answers=answers)
    assert f"1 times: {why}" in ran.out
    a_class.case("own", text)
    back = graded(a_class, "--against", str(a_class.path("new.csv")), name="back.csv", answers=answers)
    said = why.replace("can't be graded now", "could not be graded before")
    assert f"1 times: {said}" in back.out


PARTS = "credit: {number: 60%, direction: 40%}\n"


@pytest.mark.parametrize(
    ("was", "now", "answer", "why"),
    [
        (PARTS, PARTS + "points: 2\n", "-200", "the points have changed"),
        (PARTS, "credit: {number: 70%, direction: 30%}\n", "-200", "the credit"),
        (PARTS, PARTS, "203", "the direction of the right answer"),
        (PARTS, PARTS, "137", "the direction of the right answer"),
        (
            "malrules: {near-miss: 50%}\n",
            "malrules: {near-miss: 50%}\ntolerance: 0.1%\n",
            "203",
            "the tolerance",
        ),
    ],
)
def test_why_a_wrong_answer_has_another_mark_names_what_has_changed(
    a_class: Class, was: str, now: str, answer: str, why: str
) -> None:
    """The same answer, wrong before and after, under other points, another credit or tolerance, or a key
    of the other sense: what is told has it, and speaks of points where they are others alone."""
    answers = f"student_id,case,answer\n1,lever,{answer}\n"
    a_class.course(was)
    graded(a_class, answers=answers)
    a_class.course(now)
    if was == now:
        a_class.case("lever", LEVER.replace("angle: -90", "angle: 90"))
    ran = graded(a_class, "--against", str(a_class.path("results.csv")), name="new.csv", answers=answers)
    (told,) = [line for line in ran.out.splitlines() if line.startswith("  1 times: ")]
    assert why in told
    assert ("points" in told) == ("points" in now)


def test_other_points_alone_are_told_of_every_answer(a_class: Class) -> None:
    """Right, wrong, missing, and what waits for a person before and after."""
    graded(a_class)
    a_class.course("points: 3\n")
    old, changes = str(a_class.path("results.csv")), str(a_class.path("changes.csv"))
    graded(a_class, "--against", old, "--changes", changes, name="new.csv")
    found = rows(a_class, "changes.csv")
    assert len(found) == len(rows(a_class, "results.csv"))
    assert {change["old_verdict"] for change in found} == {"right", "wrong", "review", "invalid", "missing"}
    assert {change["why"] for change in found} == {"the points have changed"}


def test_results_to_compare_with_have_to_be_results(a_class: Class) -> None:
    ran = graded(a_class, "--against", a_class.file("old.csv", "a,b\n1,2\n"))
    assert (ran.code, "old.csv is no file of results" in ran.err) == (2, True)
    assert graded(a_class, "--changes", "x.csv").code == 2


CANVAS = (
    "Student,ID,SIS User ID,SIS Login ID,Section,Homework 7 (90210),Other (1)\n"
    '    Points Possible,,,,,20,5\n"A, Ann",1,a,a@x,S,,\n"B, Bob",2,b,b@x,S,3,\n"F, Fay",3,f,f@x,S,,4\n'
)


def written(a_class: Class, template: str, *options: str, kind: str = "canvas") -> list[list[str]]:
    path = a_class.file("template.csv", template)
    ran = graded(a_class, "--write", f"{kind}={a_class.path('out.csv')}", "--template", path, *options)
    assert ran.code == 0, ran.err
    delimiter = ";" if ";" in template else ","
    return list(csv.reader(io.StringIO(a_class.path("out.csv").read_text()), delimiter=delimiter))


def test_a_total_fills_one_column_scaled_to_its_points(a_class: Class) -> None:
    """Two questions of one point into twenty; who waits for a person stays blank."""
    found = written(a_class, CANVAS, "--total", "Homework 7 (90210)")
    assert found[0] == CANVAS.partition("\n")[0].split(",")
    assert [row[5:] for row in found[1:]] == [["20", "5"], ["20", ""], ["", ""], ["0", "4"]]
    template = a_class.file("t.csv", CANVAS)
    out = f"canvas={a_class.path('o.csv')}"
    ran = graded(a_class, "--write", out, "--template", template, "--total", "Homework 8")
    assert ran.code == 2
    assert "there is no column 'Homework 8' for the total" in ran.err


@pytest.mark.parametrize("points", ["1,000", "1,000.00", "1000"])
def test_points_with_divided_thousands_are_thousands(points: str, a_class: Class) -> None:
    found = written(a_class, CANVAS.replace(",20,5", f',"{points}",5'), "--total", "Homework 7 (90210)")
    assert [row[5] for row in found[1:]] == [points, "1000", "", "0"]


def test_a_column_is_filled_by_its_own_points(a_class: Class) -> None:
    found = written(a_class, CANVAS.replace("Homework 7", "lever").replace(",Other (1)", ",pusher (2)"))
    assert [row[5:] for row in found[1:]] == [["20", "5"], ["20", "5"], ["", "5"], ["0", "0"]]


def test_questions_without_a_column_of_their_name_are_told(a_class: Class) -> None:
    template = a_class.file("t.csv", CANVAS.replace("Homework 7", "lever"))
    ran = graded(a_class, "--write", f"canvas={a_class.path('o.csv')}", "--template", template)
    assert "none of its columns is named pusher, so there are new ones at its end" in ran.out + ran.err


def test_gradebooks_with_semicolons_commas_and_names_alone(a_class: Class) -> None:
    a_class.file("roster.csv", "student_id,first_name,last_name\na,Ann,Ah\nf,Fay,Eff\n")
    template = "LastName;FirstName;ID;Section;lever (7)\n    Points Possible;;;;2,50\n"
    template += "Ah;Ann;1;S;\nEff;Fay;2;S;1,25\n"
    found = written(a_class, template, "--roster", str(a_class.path("roster.csv")))
    assert [row[4] for row in found[1:]] == ["2,50", "2,5", "0"]


def test_brightspace_and_blackboard_are_filled_too(a_class: Class) -> None:
    found = written(
        a_class,
        "OrgDefinedId,lever Points Grade <Numeric MaxPoints:4>,End-of-Line Indicator\n#a,,#\n#f,,#\n",
        kind="brightspace",
    )  # fmt: skip
    assert [row[1] for row in found[1:]] == ["4", "0"]
    found = written(
        a_class, '"Last Name","First Name",Username,"HW [Total Pts: 10 Score] |77"\nAh,Ann,a,\nEff,Fay,f,\n',
        "--total", "HW", kind="blackboard",
    )  # fmt: skip
    assert [row[3] for row in found[1:]] == ["10", "0"]


@pytest.mark.parametrize("more", ["", ",Other Points Grade <Numeric MaxPoints:4>", ",lever Points Grade"])
def test_the_last_column_of_a_brightspace_file_stays_the_last(more: str, a_class: Class) -> None:
    """Its import reads up to the End-of-Line Indicator, and knows a question by the words after its name."""
    blank = "," * more.count(",")
    template = f"OrgDefinedId,Username{more},End-of-Line Indicator\n#a,ann{blank},#\n#f,fay{blank},#\n"
    header, ann, fay = written(a_class, template, kind="brightspace")
    assert header[-1] == "End-of-Line Indicator" and ann[-1] == fay[-1] == "#"
    for name in ("lever", "pusher"):
        (column,) = [n for n, title in enumerate(header) if title.startswith(f"{name} Points Grade")]
        assert (ann[column], fay[column]) == ("1", "0")
    again = written(a_class, "\n".join(map(",".join, (header, ann, fay))) + "\n", kind="brightspace")
    assert again == [header, ann, fay]


def test_a_template_that_is_cut_off_is_refused(a_class: Class) -> None:
    path = a_class.file("template.csv", CANVAS + '"Gee, G')
    ran = graded(a_class, "--write", f"canvas={a_class.path('o.csv')}", "--template", path)
    assert ran.code == 2
    assert "is it cut off?" in ran.err
