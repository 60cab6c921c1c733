"""Numbers that were handed out stay what they were: the record, and what is told of changes since."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

import icsolve
from grade_shell import LEVER, PRESS, Class, Ran
from sizes import sampled

pytestmark = pytest.mark.usefixtures("wide_ranges")

STUDENTS = [f"{n:04d}" for n in range(40)]
_PHI = "variables:\n  phi: {range: [0, 170], step: 1}\n"
WIDE = PRESS.replace("AB: 60", "AB: $phi").replace("variables:\n", _PHI)
"""With positions near a dead centre, of which the filter takes none."""
PUMP = PRESS.replace("Press", "Pump").replace("DE: 1 + $a/2", "DE: 1.5 + $a/4")


@pytest.fixture
def a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    found = Class(tmp_path, capsys)
    found.case("press", PRESS)
    found.file("roster.csv", "student_id\n" + "".join(f"{s}\n" for s in STUDENTS))
    return found


def handed_out(a_class: Class, *options: str) -> Path:
    """The folder of a case's numbers."""
    ran = a_class.run("variants", a_class.path("cases"), "--roster", a_class.path("roster.csv"), "-o",
                      a_class.path("sheets"), "--no-figures", "-q", *options)  # fmt: skip
    assert ran.code == 0
    return a_class.path("sheets")


def answers(a_class: Class, case: str = "press", factor: float = 1.0) -> str:
    """Every student's own right answer, by the keys of that time."""
    with open(a_class.path(f"sheets/{case}/key.csv"), newline="") as file:
        keys = list(csv.DictReader(file))
    rows = (f"{key['student_id']},{case},{float(key['value']) * factor:.6g} {key['unit']}\n" for key in keys)
    return "student_id,case,answer\n" + "".join(rows)


def verdicts(ran: Ran, case: str = "press") -> list[str]:
    return [row["verdict"] for row in ran.rows() if row["case"] == case]


def test_a_corrected_case_leaves_every_student_the_numbers_that_were_handed_out(a_class: Class) -> None:
    """The corrected coupler gives other keys, and by other suitability other draws: the record stands."""
    a_class.case("press", WIDE)
    record = handed_out(a_class)
    with open(record / "press" / "values.csv", newline="") as file:
        before = {row["student_id"]: row for row in csv.DictReader(file)}
    a_class.case("press", WIDE.replace("BC: 3.5", "BC: 3.8").replace("CDE: 0", "CDE: 15"))
    ran = a_class.grade(answers(a_class), "--variants", str(record / "press" / "values.csv"))
    assert [row["variant"] for row in ran.rows()] == [before[s]["variant"] for s in STUDENTS]
    assert f"the key of press has changed for {len(STUDENTS)} of {len(STUDENTS)} students" in ran.err
    assert "would now be given other numbers" in ran.err
    unrecorded = a_class.grade(answers(a_class))
    assert [row["variant"] for row in unrecorded.rows()] != [row["variant"] for row in ran.rows()]


def test_a_variant_that_a_corrected_case_can_not_have_is_told_with_its_numbers(a_class: Class) -> None:
    """With a coupler too short for the crank; as a person writes them, to the student too."""
    record = handed_out(a_class)
    table = answers(a_class)
    a_class.case("press", PRESS.replace("BC: 3.5", "BC: 0.9"))
    ran = a_class.grade(table, "--variants", str(record / "press" / "values.csv"))
    with open(record / "press" / "values.csv", newline="") as file:
        handed = {row["student_id"]: row for row in csv.DictReader(file)}
    for row in ran.rows():
        own = handed[row["student_id"]]
        assert row["feedback"] == f"Not graded: press can't be solved with P = {own['P']}, a = {own['a']}"


def test_another_filter_changes_no_number_that_is_out(a_class: Class) -> None:
    """Values that the case would not draw now: told, and all answers stay right."""
    record = handed_out(a_class)
    a_class.case("press", PRESS.replace("step: 10", "step: 20"))
    ran = a_class.grade(answers(a_class), "--variants", str(record))
    assert verdicts(ran) == ["right"] * len(STUDENTS)
    assert "values.csv: these numbers were not drawn with the seed '0' from the variables" in ran.err


def test_two_corrections_and_overrides_leave_the_untouched_alone(a_class: Class) -> None:
    """Two cases with variables and two without; two keys corrected, a few marks by hand: all other lines
    of the results are the same, byte for byte."""
    a_class.case("pump", PUMP)
    record = handed_out(a_class)
    rows = answers(a_class).splitlines() + answers(a_class, "pump", 1.3).splitlines()[1:]
    rows += [f"{s},{case},{value}" for s in STUDENTS for case, value in (("lever", 200), ("pusher", 100))]
    table = "\n".join(rows) + "\n"
    before = a_class.grade(table, "--variants", str(record))
    a_class.case("lever", LEVER.replace("force: 100", "force: 90"))
    a_class.case("press", PRESS.replace("CDE: 0", "CDE: 5"))
    marks = "student_id,case,score\n" + "".join(f"{s},pump,1\n" for s in STUDENTS[:5])
    after = a_class.grade(table, "--variants", str(record), "--overrides", a_class.file("marks.csv", marks))
    pairs = list(zip(before.out.splitlines(), after.out.splitlines(), strict=True))
    changed = [new.split(",")[:2] for old, new in pairs if old != new]
    touched = [[s, case] for s in STUDENTS for case in ("lever", "press")]
    touched += [[s, "pump"] for s in STUDENTS[:5]]
    assert sorted(changed) == sorted(touched)


def test_nothing_is_said_where_nothing_has_changed(a_class: Class) -> None:
    record = handed_out(a_class)
    roster = str(a_class.path("roster.csv"))
    ran = a_class.grade(answers(a_class), "--variants", str(record), "--roster", roster)
    assert (ran.code, ran.err, verdicts(ran)) == (0, "", ["right"] * len(STUDENTS))


def test_the_records_of_several_cases_are_found_in_their_folder(a_class: Class) -> None:
    a_class.case("pump", PUMP)
    record = handed_out(a_class)
    both = answers(a_class) + answers(a_class, "pump").partition("\n")[2]
    ran = a_class.grade(both, "--variants", str(record))
    assert verdicts(ran) + verdicts(ran, "pump") == ["right"] * 2 * len(STUDENTS)


@pytest.mark.parametrize(
    ("spoilt", "message"),
    [
        ("student_id,email,variant,P\n0001,,x,100\n", "it has no column for the variable a of press"),
        ("email,variant,P,a\n,x,100,1\n", "it has no column student_id"),
        ("student_id,variant,P,a\n1,x,100,1\n1,x,110,1\n", "the student 1 stands in it twice"),
        ("student_id,variant,P,a\n1,x,100\n", "line 2: this row is not whole"),
    ],
)
def test_a_spoilt_record_is_refused_by_name(a_class: Class, spoilt: str, message: str) -> None:
    path = a_class.path("press")
    path.mkdir()
    (path / "values.csv").write_text(spoilt)
    ran = a_class.grade("student_id,case,answer\n1,press,3\n", "--variants", str(path / "values.csv"))
    assert ran.code == 2
    assert f"values.csv: {message}" in ran.err


def test_a_student_without_numbers_is_for_a_person(a_class: Class) -> None:
    record = handed_out(a_class)
    ran = a_class.grade("student_id,case,answer\nzz,press,30\n", "--variants", str(record))
    assert ran.row("zz", "press")["verdict"] == "review"
    assert "no numbers of press were handed out to zz" in ran.err


def test_a_wrong_seed_is_recognised(a_class: Class) -> None:
    handed_out(a_class)
    ran = a_class.grade(answers(a_class), "--seed", "2026")
    assert verdicts(ran).count("wrong") > len(STUDENTS) / 2
    assert "most answers to press are right by the seed '0', and wrong by '2026'" in ran.err


@pytest.mark.parametrize("is_wide", [False, True])
def test_that_all_were_given_the_numbers_of_the_shown_case_is_recognised(
    a_class: Class, is_wide: bool
) -> None:
    """Who hands out one sheet of a case with variables has given everyone its first values; so it is told of
    a table with a row an answer, and of one with a column a case."""
    handed_out(a_class)
    right = icsolve.solve(icsolve.load(a_class.path("cases/press.yaml"))).answers["T12"]
    case, head = ("", "press") if is_wide else ("press,", "case,answer")
    rows = "".join(f"{student},{case}{right.value} {right.unit}\n" for student in STUDENTS)
    ran = a_class.grade(f"student_id,{head}\n{rows}")
    assert "most answers to press are right for P = 100, a = 1, with which it is shown" in ran.err
    assert "with which it is shown" not in a_class.grade(answers(a_class)).err


def test_a_wrong_seed_beside_the_record_is_told_and_changes_nothing(a_class: Class) -> None:
    record = handed_out(a_class)
    ran = a_class.grade(answers(a_class), "--seed", "2026", "--variants", str(record))
    assert verdicts(ran) == ["right"] * len(STUDENTS)
    assert "these numbers were not drawn with the seed '2026'" in ran.err


def test_a_neighbours_answer_is_recognised(a_class: Class) -> None:
    """Ten students, each with the next one's right answer to five figures."""
    a_class.file("roster.csv", "student_id\n" + "".join(f"{s}\n" for s in STUDENTS[:10]))
    record = handed_out(a_class)
    with open(record / "press" / "key.csv", newline="") as file:
        keys = [float(key["value"]) for key in csv.DictReader(file)]
    swapped = [*keys[1:], keys[0]]
    rows = "".join(f"{s},press,{value:.5g}\n" for s, value in zip(STUDENTS, swapped, strict=False))
    ran = a_class.grade("student_id,case,answer\n" + rows, "--variants", str(record))
    pairs = zip(ran.rows(), keys, swapped, strict=True)
    codes = [row["code"] for row, own, other in pairs if abs(own / other - 1.0) > 0.2]
    assert codes.count("neighbour") >= 0.6 * len(codes) > 2


BLOCK = """\
icsolve: 1
variables: {W: {choices: [100, 120, 140]}}
points: {A: [0, 0]}
joints: [{slide: [2, 1], at: A, along: 20, mu: 0.3}]
loads:
  W: {force: $W, link: 2, at: A, angle: -90}
  P: {force: unknown, link: 2, at: A, angle: 20}
"""
PINNED = """\
icsolve: 1
variables: {W: {choices: [100, 120, 140]}}
points: {A: [0, 0], B: [1, 0]}
joints: [{slide: [2, 1], at: A, along: 0}, {slide: [3, 2], at: B, along: 90}]
loads:
  W: {force: $W, link: 3, at: B, angle: -60}
  P: {force: [unknown, unknown], link: 3, at: B}
"""
BAR = """\
icsolve: 1
variables: {W: {choices: [8, 9, 10]}}
points: {A: [0, 0]}
lengths: {AB: 2}
angles: {AB: unknown}
joints: [{pin: [1, 2], at: A}]
loads:
  M: {torque: 4, link: 2}
  W: {force: $W, link: 2, at: B, angle: -90}
"""


@sampled(3)
@pytest.mark.parametrize(
    ("text", "was", "now"),
    [(BLOCK, "mu: 0.3", "mu: 0.25"), (PINNED, "angle: -60", "angle: -70"), (BAR, "torque: 4", "torque: 5")],
    ids=["the ends of a range", "a direction alone", "each of several positions"],
)
def test_a_corrected_key_of_any_kind_is_told(a_class: Class, text: str, was: str, now: str) -> None:
    a_class.case("own", text)
    record = handed_out(a_class)
    table = "student_id,case,answer\n" + "".join(f"{student},own,1\n" for student in STUDENTS)
    assert "has changed" not in a_class.grade(table, "--variants", str(record)).err
    a_class.case("own", text.replace(was, now))
    ran = a_class.grade(table, "--variants", str(record))
    assert f"the key of own has changed for {len(STUDENTS)} of {len(STUDENTS)} students" in ran.err


def test_the_numbers_of_a_case_that_is_not_there_are_told_as_such(a_class: Class) -> None:
    """A folder of records, of which one is of a case that was taken out, or that can't be read any more."""
    a_class.case("own", BLOCK)
    record = handed_out(a_class)
    a_class.case("own", BLOCK.replace("joints:", "jonts:"))
    table = "student_id,case,answer\n0001,lever,200\n"
    ran = a_class.grade(table, "--variants", str(record))
    assert ran.code == 2 and "own can't be read" in ran.err and "jonts" in ran.err
    a_class.path("cases/own.yaml").unlink()
    ran = a_class.grade(table, "--variants", str(record))
    assert ran.code == 2 and "none is named own, and none has their variables" in ran.err
