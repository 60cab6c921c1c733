"""Variants: values by hash, the same everywhere; fair tasks only; keys that are those of the case itself."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from random import Random

import pytest

import icsolve
from grade_shell import CASES, LEVER, PRESS, Class
from icsolve.case.expected import Variable
from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Course, Person
from icsolve.grade.keys import NumberKey, numbers_of
from icsolve.grade.variants.record import VariantTask, key_csv
from icsolve.grade.variants.varied import Varied, drawn, label
from sizes import sampled

VARIABLES = (Variable("P", start="100", stop="500", step="10"), Variable("a", choices=("1.5", "2", "2.5")))


@pytest.fixture
def a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    found = Class(tmp_path, capsys)
    found.case("press", PRESS)
    return found


def varied(a_class: Class, seed: str = "0") -> Varied:
    found = CaseStore(a_class.path("cases"), Course(seed=seed)).variation("press")
    assert found is not None
    return found


def test_values_follow_from_case_student_and_seed_alone() -> None:
    """SHA-256 of the five texts: these values are to come out on every machine and in every version."""
    assert drawn("press", VARIABLES, "0007", "2025", 0) == {"P": "310", "a": "1.5"}
    assert drawn("press", VARIABLES, "0007", "2025", 1) != drawn("press", VARIABLES, "0007", "2025", 2)
    assert label("press", {"P": "490", "a": "2"}) == label("press", {"P": "490", "a": "2"})
    assert len(label("press", {"P": "490", "a": "2"})) == 8


def test_every_value_is_drawn_about_equally_often() -> None:
    """A chi-square of 41 values over 4100 students stays below its 99.9 % quantile, 73.4."""
    counts: dict[str, int] = {}
    for n in range(4100):
        value = drawn("press", VARIABLES, str(n), "", 0)["P"]
        counts[value] = counts.get(value, 0) + 1
    assert set(counts) == {str(p) for p in range(100, 501, 10)}
    assert sum((count - 100) ** 2 / 100 for count in counts.values()) < 73.4


def test_another_seed_gives_other_values(a_class: Class) -> None:
    first, second = varied(a_class, "a"), varied(a_class, "b")
    students = [str(n) for n in range(40)]
    assert sum(first.draw(s) == second.draw(s) for s in students) < 10
    assert [first.draw(s) for s in students] == [varied(a_class, "a").draw(s) for s in students]


def test_a_key_is_what_the_case_gives_with_those_values(a_class: Class) -> None:
    case_store = CaseStore(a_class.path("cases"), Course())
    found = case_store.variation("press")
    assert found is not None
    for n in range(30):
        draw = found.draw(str(n))
        settings = {f"variables.{name}": value for name, value in draw.values.items()}
        answer = icsolve.solve(icsolve.load(a_class.path("cases/press.yaml"), settings))
        key = case_store.key("press", str(n))
        assert key.value == pytest.approx(answer.answers["T12"].value, rel=1e-13)  # type: ignore[union-attr]


def test_loads_that_do_not_grow_alike_are_solved_each(a_class: Class) -> None:
    text = PRESS.replace("  T12:", "  W: {weight: 50, link: 3, at: C}\n  T12:")
    a_class.case("press", text)
    test_a_key_is_what_the_case_gives_with_those_values(a_class)


@sampled(3)
@pytest.mark.parametrize(
    ("name", "changes", "variables"),
    [
        ("ch13/13_08_four_bar", {"AB: 110": "AB: $phi"}, "phi: {range: [0, 359], step: 1}"),
        ("sliders/slider_crank_offset", {"AB: 120": "AB: $t"}, "t: {range: [10, 170], step: 1}"),
        ("linkages/watt_six_bar", {"C: [5, 3]": "C: [$x, 3]"}, "x: {range: [4, 6], step: 0.01}"),
        ("ropes/crank_and_rope", {"B: [0.3,": "B: [$x,"}, "x: {range: [0.1, 0.6], step: 0.01}"),
        ("ropes/capstan", {"mu: {O: 0.25}": "mu: {O: $m}"}, "m: {range: [0.1, 0.4], step: 0.01}"),
        ("equilibrium/toggle_with_spring", {"weight: 30": "weight: $W"}, "W: {range: [20, 40], step: 1}"),
    ],
)
def test_a_class_gets_what_each_student_would_get_alone(
    a_class: Class, name: str, changes: dict[str, str], variables: str
) -> None:
    """Many variants are rows of one record, and of what it doubts scenes: the same are drawn, of the same
    answers, the other way of assembling and dead centres among them."""
    text = (CASES / f"{name}.yaml").read_text()
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new)
    a_class.case("press", f"{text}variables: {{{variables}}}\n")
    together, alone = varied(a_class), varied(a_class)
    students = [str(n) for n in range(9)]
    together.ready(students)
    for student in students:
        assert together.draw(student) == alone.draw(student)
        one, other = (numbers_of(v.solved(student).key("press"))[0].value for v in (together, alone))
        assert one == pytest.approx(other, rel=1e-11)


TURNED = """icsolve: 1
points: {A: [0, 0]}
lengths: {AB: 1, BC: 3.5, CD: 2.5, AD: 4}
angles: {AB: 60, AD: $s}
near: {C: NEAR}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads:
  P: {force: $P, link: 4, at: C, angle: 180}
  T12: {torque: unknown, link: 2}
variables: {s: {range: [0, 350], step: 10}, P: {range: [100, 200], step: 10}, VARIABLE}
"""


@pytest.mark.parametrize("near", ["[3.5, 2.4]", "[-1, 3]", "[$x, 2.4]", "[3.5, 2.4], G: [2, 4]"])
def test_a_variant_is_the_way_that_its_own_near_means(a_class: Class, near: str) -> None:
    """Wherever the ground has turned to, and whoever's numbers are solved first."""
    x = "x: {range: [-3, 3], step: 0.5}" if "$x" in near else ""
    text = TURNED.replace("NEAR", near).replace(", VARIABLE", f", {x}" if x else "")
    if "G" in near:  # which nothing needs
        text = text.replace("AD: 4}", "AD: 4, BG: 2, CG: 2.5}")
    a_class.case("press", text)
    together = varied(a_class)
    students = [str(n) for n in range(40 if near in ("[3.5, 2.4]", "[-1, 3]") else 12)]
    together.ready(students)
    for student in students:
        variant = together.draw(student)
        settings = {f"variables.{name}": value for name, value in variant.values.items()}
        alone = icsolve.solve(icsolve.load(a_class.path("cases/press.yaml"), settings))
        found = numbers_of(together.solved(student).key("press"))[0].value
        assert found == pytest.approx(alone.answers["T12"].value, rel=1e-9), variant.values


def test_only_variants_that_assemble_and_are_far_from_a_dead_centre(a_class: Class) -> None:
    """With AB from 1 to 2.5 at 0 to 60 degrees the coupler and rocker stretch out, or do not meet."""
    text = PRESS.replace(
        "a: {choices: [1, 1.25, 1.5]}", "a: {range: [0.2, 2.6], step: 0.2}\n  phi: {range: [0, 60], step: 2}"
    )
    a_class.case("press", text.replace("AB: 60", "AB: $phi"))
    found = varied(a_class)
    for n in range(60):
        values = found.draw(str(n)).values
        settings = {f"variables.{name}": value for name, value in values.items()}
        answer = icsolve.solve(icsolve.load(a_class.path("cases/press.yaml"), settings))
        assert abs(answer.answers["T12"].value) < 20.0 * float(values["P"])
    assert any(not seen.far for seen in found._seen.values())


def test_with_friction_variants_near_a_dead_centre_are_not_given_either(a_class: Class) -> None:
    """A crank of 1 on a coupler of 3, from stretched out to 60 degrees, its slider pushed: near 0 degrees P
    grows without bound."""
    text = (
        "icsolve: 1\nvariables: {phi: {range: [0, 60], step: 1}}\npoints: {A: [0, 0], C: [unknown, 0]}\n"
        "lengths: {AB: 1, BC: 3}\nangles: {AB: $phi}\nnear: {C: [4, 0]}\njoints:\n"
        "  - {pin: [1, 2], at: A, mu: 0.1, radius: 0.05}\n  - {pin: [2, 3], at: B}\n"
        "  - {pin: [3, 4], at: C}\n"
        "  - {slide: [4, 1], at: C, along: 0, mu: 0.1}\nloads:\n  T12: {torque: 10, link: 2}\n"
        "  P: {force: unknown, link: 4, at: C, angle: 180}\nmotion: {link: 2, turns: ccw}\n"
    )
    a_class.case("press", text)
    found = varied(a_class)
    drawn_angles = {int(found.draw(str(n)).values["phi"]) for n in range(80)}
    assert min(drawn_angles) > 3
    assert len(drawn_angles) > 30


@pytest.mark.parametrize(
    ("name", "number"),
    [
        ("ropes/capstan", "weight: 100"),
        ("tools/screw_jack", "weight: 10 kN"),
        ("dynamics/hoist_starting", "mass: 40 kg"),
        ("tools/toggle_clamp", "force: 80"),
        ("ropes/differential_hoist", "weight: 1000"),
    ],
)
def test_variants_of_what_has_no_derivatives_and_of_what_is_near_a_dead_centre_by_nature(
    a_class: Class, name: str, number: str
) -> None:
    """Ropes that slip, screws, inertia; toggles and differential hoists amplify, whatever their numbers."""
    text = (CASES / f"{name}.yaml").read_text()
    kind, _, written = number.partition(": ")
    plain, _, unit = written.partition(" ")
    assert number in text
    text = text.replace(number, f"{kind}: $P {unit}")
    a_class.case("press", f"{text}variables: {{P: {{range: [{plain}, {2 * int(plain)}], step: 1}}}}\n")
    found = varied(a_class)
    for student in "ab":
        values = found.draw(student).values
        settings = {f"variables.{name}": value for name, value in values.items()}
        ((_, one),) = icsolve.solve(icsolve.load(a_class.path("cases/press.yaml"), settings)).answers.items()
        key = found.solved(student).key("press")
        assert isinstance(key, NumberKey) and key.value == pytest.approx(one.value, rel=1e-12)


def test_the_key_of_a_position_says_what_is_accepted_of_it(a_class: Class) -> None:
    """A bar of 2 m with 10 N at its end on a couple rests at -60 degrees: of an angle the sign counts."""
    a_class.case(
        "press",
        "icsolve: 1\nvariables: {W: {range: [10, 12], step: 1}}\npoints: {A: [0, 0]}\nlengths: {AB: 2}\n"
        "angles: {AB: {unknown: [-90, 0]}}\njoints: [{pin: [1, 2], at: A}]\n"
        "loads: {W: {weight: $W, link: 2, at: B}, T: {torque: 10, link: 2}}\n",
    )
    found = varied(a_class)
    tasks = [VariantTask(Person(student), found.draw(student)) for student in "abc"]
    for row in csv.DictReader(io.StringIO(key_csv(found, tasks))):
        assert float(row["from"]) < float(row["value"]) < float(row["to"]) < 0.0


def test_a_case_none_of_whose_variants_suits_says_so(a_class: Class) -> None:
    a_class.case("press", PRESS.replace("[1, 1.25, 1.5]", "[7, 8]"))
    roster = a_class.file("roster.csv", "student_id\n1\n2\n")
    ran = a_class.run(
        "variants", str(a_class.path("cases")), "--roster", roster, "-o", str(a_class.path("out"))
    )
    assert ran.code == 1
    assert "1: none of 60 variants of press suits" in ran.err


def test_sheets_keys_and_figures_of_a_class(a_class: Class) -> None:
    roster = a_class.file(
        "roster.csv", "student_id,email,first_name,last_name\n007,a@x.test,Ann,Bee\n../8,,Bob,Cee\n"
    )
    out = a_class.path("out")
    cases = str(a_class.path("cases"))
    ran = a_class.run("variants", cases, "--roster", roster, "-o", str(out), "-q")
    assert ran.code == 0
    with open(out / "press" / "values.csv", newline="") as file:
        values = list(csv.DictReader(file))
    assert [row["student_id"] for row in values] == ["007", "../8"]
    assert set(values[0]) == {"student_id", "email", "variant", "P", "a"}
    with open(out / "press" / "key.csv", newline="") as file:
        key = next(csv.DictReader(file))
    assert key["unit"] == "lbf*in"
    assert key["sense"] in ("cw", "ccw")
    assert float(key["from"]) < abs(float(key["value"])) < float(key["to"])
    figure = (out / "press" / "figures" / f"{values[0]['variant']}.svg").read_text()
    assert "T12 = ?" in figure
    sheets = sorted(path.name for path in (out / "press" / "sheets").iterdir())
    assert sheets[0].startswith("007") or sheets[1].startswith("007")
    assert all(path.parent == out / "press" / "sheets" for path in (out / "press" / "sheets").iterdir())
    sheet = (out / "press" / "sheets" / "007.html").read_text()
    assert f"{values[0]['P']} lbf" in sheet
    assert key["value"][:6].lstrip("-") not in sheet
    assert a_class.run("variants", cases, "--roster", roster, "-o", str(out), "-q").code == 2


@pytest.mark.parametrize("loads", [True, False], ids=["beside an unknown", "of a case without loads"])
def test_what_the_course_asks_by_name_stands_in_key_and_sheet(a_class: Class, loads: bool) -> None:
    """Each student owes an answer to it, so each is asked for it; where the case is corrected since it
    is told that its key is another one. A centre is asked for, and has no line in the key: no number."""
    alone = PRESS.partition("loads:")[0].replace("  P: {range: [100, 500], step: 10}\n", "")
    text = PRESS if loads else alone
    a_class.case("press", text)
    a_class.course('cases: {"press:w4/w2": {points: 2}, "press:I24": {}}\n')
    roster = a_class.file("roster.csv", "student_id\n1\n2\n")
    cases, out = str(a_class.path("cases")), a_class.path("out")
    assert a_class.run("variants", cases, "--roster", roster, "-o", str(out), "-q").code == 0
    with open(out / "press" / "key.csv", newline="") as file:
        keys = list(csv.DictReader(file))
    assert [row["case"] for row in keys] == [*["press"] * loads, "press:w4/w2"] * 2
    for row in keys[loads :: loads + 1]:
        task = varied(a_class).solved(row["student_id"]).key("press:w4/w2")
        assert isinstance(task, NumberKey) and float(row["value"]) == pytest.approx(task.value, rel=1e-11)
    sheet = (out / "press" / "sheets" / "1.html").read_text()
    assert "Find w4/w2." in sheet and "Where is the centre I24?" in sheet and loads == ("Find T12" in sheet)
    a_class.case("press", text.replace("CD: 2.5", "CD: 2.6"))
    ran = a_class.grade("student_id,case,answer\n1,press:w4/w2,0.3\n", "--variants", str(out))
    assert "the key of press:w4/w2 has changed for 2 of 2 students" in ran.err


@pytest.mark.parametrize(("asked", "why"), [("rf B", "no pin at B has friction"), ("v C on 3", "")])
def test_what_has_no_right_answer_is_left_out_by_name(a_class: Class, asked: str, why: str) -> None:
    """One question of the course without a key keeps no student from the others."""
    a_class.course(f'cases: {{press: {{}}, "press:{asked}": {{}}}}\n')
    roster = a_class.file("roster.csv", "student_id\n1\n2\n")
    out = a_class.path("out")
    ran = a_class.run("variants", str(a_class.path("cases")), "--roster", roster, "-o", str(out), "-q")
    keys = list(csv.DictReader(io.StringIO((out / "press" / "key.csv").read_text())))
    assert [row["case"] for row in keys] == ["press", *[f"press:{asked}"] * (not why)] * 2
    assert "Find T12" in (out / "press" / "sheets" / "1.html").read_text()
    assert ran.code == bool(why)
    assert (f"press:{asked} is left out for 2 students (1; 2): {why}" in ran.err) == bool(why)


@pytest.mark.parametrize(
    ("number", "spoilt"),
    [("P", ""), ("P", "abc"), ("P", "12,5"), ("P", "nan"), ("P", "1e999"), ("P", "$P"), ("P", "9" * 6000),
     ("a", "1,25"), ("a", "1 N"), ("a", "1, D: 3")],
)  # fmt: skip
def test_a_number_of_the_record_that_is_none_is_told_with_its_student(
    a_class: Class, number: str, spoilt: str
) -> None:
    """A cell that a spreadsheet, or a person, has spoilt: no other number counts in its place."""
    roster = a_class.file("roster.csv", "student_id\n1\n2\n")
    out = a_class.path("out")
    a_class.run(
        "variants", str(a_class.path("cases")), "--roster", roster, "-o", str(out), "-q", "--no-figures"
    )
    values = out / "press" / "values.csv"
    table = list(csv.DictReader(io.StringIO(values.read_text())))
    table[1][number] = spoilt
    written = io.StringIO()
    rows = csv.DictWriter(written, list(table[0]))
    rows.writeheader()
    rows.writerows(table)
    values.write_text(written.getvalue())
    ran = a_class.grade("student_id,case,answer\n1,press,3\n2,press,3\n", "--variants", str(out))
    assert ran.code == 2
    assert f"values.csv: the number {number} of 2 is {spoilt[:40]!r}" in ran.err


def test_a_folder_without_variables_says_what_they_look_like(a_class: Class) -> None:
    a_class.path("cases/press.yaml").unlink()
    roster = a_class.file("roster.csv", "student_id\n1\n")
    ran = a_class.run(
        "variants", str(a_class.path("cases")), "--roster", roster, "-o", str(a_class.path("out"))
    )
    assert ran.code == 2
    assert "variables: {P: {range: [100, 500], step: 10}}" in ran.err


SPACE = """\
icsolve: 1
variables: {W: {range: [10, 50], step: 5}}
units: {length: mm, force: N, torque: N*m}
points: {A: [0, 0, 0], B: [0, 0, 400], C: [100, 0, 150]}
joints:
  - {thrust: [1, 2], at: A, axis: z}
  - {radial: [1, 2], at: B, axis: z}
loads:
  W: {weight: $W, link: 2, at: C}
  F: {force: [100, 200, -50], link: 2, at: C}
"""


@pytest.mark.parametrize("unknown", ["", "  T: {torque: unknown, link: 2, along: z}\n"])
def test_a_case_in_space_with_variables_is_refused_by_name_and_spoils_no_other(
    a_class: Class, unknown: str
) -> None:
    """No answers to it are judged, so it gives no key, no question and no verdict; the others go on."""
    a_class.case("shaft", SPACE + unknown)
    case, roster = a_class.path("cases/shaft.yaml"), a_class.file("roster.csv", "student_id\n1\n2\n")
    told = "the case shaft is in space, and answers are judged of plane cases"
    handed = a_class.run("variants", case, "--roster", roster, "-o", a_class.path("out"))
    assert handed.code == 2 and handed.err.strip() == told and not a_class.path("out").exists()
    for kind in ("gift", "moodle-xml", "qti", "prairielearn"):
        made = a_class.run("export", kind, case, "-o", a_class.path(f"out-{kind}"))
        assert made.code == 1 and "space" in made.err and "fault" not in made.err
    ran = a_class.grade("student_id,case,answer\n1,lever,200\n1,shaft,3\n2,shaft:F12,3\n")
    assert [ran.row("1", "lever")["verdict"], ran.row("1", "shaft")["verdict"]] == ["right", "review"]
    assert told in ran.row("1", "shaft")["feedback"]


SHORT = """\
icsolve: 1
variables: {a: {choices: [1, 2, 3]}}
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: LENGTH, BC: $a}
angles: {AB: DIRECTION}
near: {C: [20, 0]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {slide: [4, 1], at: C, along: 0}]
loads:
  P: {force: 10, link: 4, at: C, angle: 180}
  T: {torque: unknown, link: 2}
"""


@pytest.mark.parametrize(
    ("length", "degrees", "why"),
    [("10", "90", "60 do not assemble or have no answer"), ("0.5", "0.01", "60 are near a dead centre")],
)
def test_why_no_variant_suits_is_told_with_counts(
    a_class: Class, length: str, degrees: str, why: str
) -> None:
    a_class.case("short", SHORT.replace("LENGTH", length).replace("DIRECTION", degrees))
    roster = a_class.file("roster.csv", "student_id\n1\n")
    ran = a_class.run(
        "variants", a_class.path("cases/short.yaml"), "--roster", roster, "-o", a_class.path("o")
    )
    assert ran.code == 1 and f"1: none of 60 variants of short suits ({why}): narrow" in ran.err


def test_a_case_that_can_not_be_read_is_told_and_nothing_else_of_it(a_class: Class) -> None:
    a_class.case("short", SHORT.replace("$a", "$a + $b").replace("LENGTH", "1").replace("DIRECTION", "90"))
    roster = a_class.file("roster.csv", "student_id\n1\n")
    ran = a_class.run(
        "variants", a_class.path("cases/short.yaml"), "--roster", roster, "-o", a_class.path("o")
    )
    assert ran.code == 2 and "can't be read" in ran.err and "no case has variables" not in ran.err


def a_group(a_class: Class, groups: list[list[str]], handed: list[str]) -> list[dict[str, str]]:
    """The results of an export of Gradescope with a file for each group."""
    export = a_class.path("assignment_77_export")
    export.mkdir()
    who = ""
    for n, (members, text) in enumerate(zip(groups, handed, strict=True)):
        (export / f"submission_{n}").mkdir()
        (export / f"submission_{n}" / "answers.txt").write_text(text)
        who += f"submission_{n}:\n  :submitters:\n" + "".join(f"  - :sid: '{m}'\n" for m in members)
    (export / "submission_metadata.yml").write_text(who)
    ran = a_class.run("grade", str(export), "--cases", str(a_class.path("cases")), "-o", "-", "-q")
    assert ran.code == 0, ran.err
    return ran.rows()


@sampled(2)
@pytest.mark.parametrize("seed", range(4))
def test_a_group_is_judged_by_the_numbers_of_the_member_whose_variant_it_hands_in(
    seed: int, a_class: Class
) -> None:
    """Any of them: right answers are right for each, a known mistake is known for each, and each has the
    variant that the answers are to; a case with the same numbers for all is judged as ever."""
    a_class.case("lever", LEVER)
    dice, store = Random(seed), CaseStore(a_class.path("cases"), Course())
    names = iter(f"{n:03d}" for n in range(40))
    groups = [[next(names) for _ in range(size)] for size in (1, 2, 3, 2, 3)]
    meant = [dice.choice(group) for group in groups]
    keys = [store.key("press", member) for member in meant]
    values = [key.value for key in keys if isinstance(key, NumberKey)]
    made = [1.0, 1.0, 0.5, 1.0, 3.33]
    handed = [f"press: {v * times:.6g}\nlever: 200\n" for v, times in zip(values, made, strict=True)]
    rows = a_group(a_class, groups, handed)
    for group, member, value, times in zip(groups, meant, values, made, strict=True):
        theirs = [key.value for key in (store.key("press", m) for m in group) if isinstance(key, NumberKey)]
        if times != 1.0 and min(abs(times * value / other - 1.0) for other in theirs) < 0.05:
            continue  # what is wrong for one is right for another
        own = [row for row in rows if row["student_id"] in group and row["case"] == "press"]
        assert len(own) == len(group)
        assert {row["verdict"] for row in own} == {"right" if times == 1.0 else "wrong"}
        assert len({(row["score"], row["variant"], row["feedback"]) for row in own}) == 1
        assert times == 3.33 or {row["variant"] for row in own} == {store.variant_of("press", member)}
        assert times != 0.5 or all("half" in row["code"] for row in own)
    assert {row["verdict"] for row in rows if row["case"] == "lever"} == {"right"}


def test_an_answer_to_the_numbers_of_another_group_is_still_a_neighbours(a_class: Class) -> None:
    store = CaseStore(a_class.path("cases"), Course())
    keys = [store.key("press", student) for student in ("a", "c")]
    mine, theirs = (key.value for key in keys if isinstance(key, NumberKey))
    rows = a_group(a_class, [["a", "b"], ["c", "d"]], [f"press: {theirs:.6g}", f"press: {theirs:.6g}"])
    assert mine != pytest.approx(theirs, rel=0.05)
    told = [(row["verdict"], row["code"]) for row in rows]
    assert told == [("wrong", "neighbour")] * 2 + [("right", "")] * 2


def test_the_autograder_takes_the_numbers_of_any_who_hand_in_together(a_class: Class) -> None:
    """Gradescope names all of a group; the marks are those of the first, which it gives to all."""
    store = CaseStore(a_class.path("cases"), Course())
    key = store.key("press", "b@x.test")
    assert isinstance(key, NumberKey)
    answers = a_class.file("answers.csv", f"case,answer\npress,{key.value:.6g}\n")
    users = [{"email": f"{name}@x.test"} for name in "abc"]
    metadata = a_class.file("metadata.json", json.dumps({"users": users}))
    ran = a_class.run(
        "grade", answers, "--cases", str(a_class.path("cases")), "--metadata", metadata, "-o", "-", "-q"
    )
    (row,) = ran.rows()
    assert (row["student_id"], row["verdict"]) == ("a@x.test", "right")
    assert row["variant"] == store.variant_of("press", "b@x.test")
