"""What stands in exported questions, read as the platforms read it: the bands of their right answers are
those by which `grade` judges, and their titles are the case's own."""

from __future__ import annotations

import json
import re
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import pytest

from grade_shell import Class
from icsolve.grade.course import read_course
from icsolve.grade.keys import numbers_of
from icsolve.grade.one import Task
from sizes import few

QTI = "{http://www.imsglobal.org/xsd/ims_qtiasiv1p2}"
ROD = """\
icsolve: 1
title: Rod
variables:
  P: {range: [3, 900], step: 0.0137}
points: {A: [0, 0], B: [1.3, 0.7]}
joints: [{pin: [1, 2], at: A}]
loads:
  P: {force: $P, link: 2, at: B, angle: 33}
  T: {torque: unknown, link: 2}
"""
ENDINGS = {"moodle-xml": ".xml", "gift": ".gift", "qti": ".zip"}


@pytest.fixture
def a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    return Class(tmp_path, capsys)


def bands(kind: str, path: Path) -> list[tuple[float, float]]:
    """What a platform accepts as right, in the order of the questions, each of which has one band."""
    if kind == "gift":
        rows = re.findall(r"=%100%([^:]+):([^#]+)#", path.read_text())
    elif kind == "moodle-xml":
        answers = ElementTree.parse(path).getroot().iter("answer")
        right = [a for a in answers if a.get("fraction") == "100"]
        rows = [(a.findtext("text") or "", a.findtext("tolerance") or "") for a in right]
    else:
        with zipfile.ZipFile(path) as archive:
            (name,) = [n for n in archive.namelist() if re.fullmatch(r"(quiz_\w+)/\1\.xml", n)]
            root = ElementTree.fromstring(archive.read(name))
        ends = [[float(e.text or 0) for e in root.iter(f"{QTI}{tag}")] for tag in ("vargte", "varlte")]
        return list(zip(*ends, strict=True))
    return [(float(value) - float(half), float(value) + float(half)) for value, half in rows]


@pytest.mark.parametrize("tolerance", ["1%", "0.2%", "3 sf", "0.01 N*m"])
@pytest.mark.parametrize("kind", ENDINGS)
def test_a_platform_takes_what_grade_takes(kind: str, tolerance: str, a_class: Class) -> None:
    """Both ends of the band of `grade`, and no more beyond them than the shown answer is rounded by."""
    count = few(90)
    a_class.case("rod", ROD)
    a_class.course(f"tolerance: {tolerance}\n")
    path, out = a_class.path("cases/rod.yaml"), a_class.path(f"quiz{ENDINGS[kind]}")
    a_class.run("export", kind, path, "-o", out, "--no-figures", "--count", str(count))
    course = read_course(a_class.path("cases/course.yaml"))
    found = bands(kind, out)
    assert len(found) == count
    for n, (low, high) in enumerate(found, 1):
        task = Task(path, str(n), course)
        key = task._key("")
        half = key.half - 1e-10 * abs(key.value)  # exported numbers have twelve digits
        ends = key.value - half, key.value + half
        assert [task.grade("", f"{end!r}")["verdict"] for end in ends] == ["right", "right"]
        assert low <= ends[0] and ends[1] <= high
        assert high - low <= 2.0 * (key.half + 1e-5 * abs(key.value))


TITLES = ["Rod of US$100, P = $P N", "Rod (P = $P)", "Rod at ${P}deg", "Rod,P=$P,and no more", "$P"]


@pytest.mark.parametrize("title", TITLES)
def test_a_title_keeps_its_words_and_names_its_variables(title: str, a_class: Class) -> None:
    """As the solver's own title, but that a variable's name stands for its number."""
    a_class.case("rod", ROD.replace("title: Rod", f"title: '{title}'"))
    a_class.run("export", "prairielearn", a_class.path("cases/rod.yaml"), "-o", a_class.path("out"))
    told = json.loads((a_class.path("out") / "rod" / "info.json").read_text())["title"]
    solved = a_class.run("solve", a_class.path("cases/rod.yaml"), "--set", "variables.P=20", "--json").out
    assert told == title.replace("${P}", "P").replace("$P", "P")
    assert json.loads(solved)["title"] == title.replace("${P}", "20").replace("$P", "20") + " (P = 20)"


UNITS = {
    "force": ("F: {force: unknown, link: 2, at: B, angle: 90}", "N kN lbf kip"),
    "torque": ("T: {torque: unknown, link: 2}", "N*m N*mm kN*m lbf*ft lbf*in"),
    "mass": ("m: {mass: unknown, link: 2, at: D}", "kg g t lbm"),
    "stiffness": ("k: {spring: unknown, free: 0.5, link: 2, at: B, to: C}", "N/m N/mm kN/m lbf/in lbf/ft"),
    "torsion": (
        "k: {spring: unknown, corner: AB, free: 40, link: 2}",
        "N*m/rad N*mm/rad lbf*in/rad lbf*ft/rad",
    ),
    "line load": (
        "q: {distributed: unknown, link: 2, from: A, to: B, angle: 90}",
        "N/m N/mm kN/m lbf/in lbf/ft",
    ),
    "pressure": (
        "p: {pressure: unknown, bore: 50 mm, link: 2, at: B, angle: 90}",
        "MPa kPa Pa bar psi N/mm^2",
    ),
}
"""What balances a weight on a rod, and the units in which it is answered."""


@pytest.mark.parametrize("of", UNITS)
@pytest.mark.parametrize("units", ["", "units: {length: in, force: lbf}\n"])
def test_moodle_takes_every_unit_of_a_kind(of: str, units: str, a_class: Class) -> None:
    """Each with its multiplier, by which the answer is right where `grade` judges it."""
    unknown, names = UNITS[of]
    points = "points: {A: [0, 0], B: [2, 0], C: [2, 3], D: [-1, 0]}\n"
    joints = "joints: [{pin: [1, 2], at: A}]\n"
    loads = f"loads:\n  W: {{force: 70, link: 2, at: B, angle: -90}}\n  {unknown}\n"
    a_class.case("rod", f"icsolve: 1\n{units}{points}{joints}{loads}")
    path, out = a_class.path("cases/rod.yaml"), a_class.path("quiz.xml")
    a_class.run("export", "moodle-xml", path, "-o", out, "--no-figures")
    listed = [
        (unit.findtext("unit_name") or "", float(unit.findtext("multiplier") or 0))
        for unit in ElementTree.parse(out).getroot().iter("unit")
    ]
    task = Task(path)
    assert set(names.split()) <= {name for name, _ in listed}
    for name, multiplier in listed:
        assert task.grade("", f"{task._key('').value * multiplier!r} {name}")["verdict"] == "right", name


HANGING = """\
icsolve: 1
points: {A: [0, 0]}
lengths: {AB: 2}
angles: {AB: unknown}
joints: [{pin: [1, 2], at: A}]
loads: {W: {weight: 10, link: 2, at: B}, T: {torque: 13, link: 2}}
"""


@pytest.mark.parametrize("direction", ["signed", "ignored"])
@pytest.mark.parametrize("text", [ROD, HANGING], ids=["torque", "position"])
@pytest.mark.parametrize("kind", ENDINGS)
def test_a_sign_counts_on_a_platform_where_it_counts_for_grade(
    kind: str, text: str, direction: str, a_class: Class
) -> None:
    """Of the answer, its opposite, and whole turns of both; and none that is right is told a mistake."""
    a_class.case("own", text)
    a_class.course(f"direction: {direction}\n")
    path, out = a_class.path("cases/own.yaml"), a_class.path(f"quiz{ENDINGS[kind]}")
    a_class.run("export", kind, path, "-o", out, "--no-figures", "--count", "1")
    task = Task(path, "1", read_course(a_class.path("cases/course.yaml")))
    found, value = bands(kind, out), numbers_of(task._key(""))[0].value
    for answer in (sign * value + turn for sign in (1.0, -1.0) for turn in (-360.0, 0.0, 360.0)):
        right = task.grade("", f"{answer!r}")["verdict"] == "right"
        assert any(low <= answer <= high for low, high in found) == right or abs(answer) > 360.0, answer
    if kind == "moodle-xml":
        rows = [a for a in ElementTree.parse(out).getroot().iter("answer") if a.get("fraction") == "0"]
        for row in rows[:-1]:
            assert task.grade("", row.findtext("text"))["verdict"] != "right"


CREDITS = ["", "credit: {number: 60%, unit: 20%, direction: 20%}\n", "credit: {number: 50%, unit: 50%}\n"]


@pytest.mark.parametrize("credit", CREDITS)
def test_a_missing_unit_costs_on_moodle_what_it_costs_for_grade(credit: str, a_class: Class) -> None:
    a_class.case("rod", ROD)
    a_class.course(f"unit: required\n{credit}")
    path, out = a_class.path("cases/rod.yaml"), a_class.path("quiz.xml")
    a_class.run("export", "moodle-xml", path, "-o", out, "--no-figures", "--count", "1")
    (question,) = list(ElementTree.parse(out).getroot())[1:]
    task = Task(path, "1", read_course(a_class.path("cases/course.yaml")))
    score = task.grade("", f"{task._key('').value!r}")["score"]
    assert (question.findtext("unitgradingtype"), task.grade("", task.right())["score"]) == ("1", 1.0)
    assert 1.0 - float(question.findtext("unitpenalty") or "nan") == pytest.approx(score)


TRAIN = """\
icsolve: 1
points: {A: [0, 0], B: [68, 0]}
joints: [{pin: [1, 2], at: A}, {pin: [1, 3], at: B}, {gears: [2, 3], teeth: [17, 51]}]
loads: {T2: {torque: 10, link: 2}, T3: {torque: unknown, link: 3}}
"""
COURSES = [
    "malrules: {sign: 50%, power-of-ten: 25%}",
    "tolerance: 5%\nmalrules: {sign: 50%}",
    "credit: {number: 60%, unit: 20%, direction: 20%}",
    "credit: {number: 50%, unit: 25%, direction: 25%}\nmalrules: {half: 90%}\ntolerance: 3 sf",
]


@pytest.mark.parametrize("course", COURSES)
def test_a_known_mistake_is_worth_on_moodle_what_grade_gives_for_it(course: str, a_class: Class) -> None:
    """To the nearest of the fractions that Moodle knows, which lie 17 % apart at most."""
    a_class.case("train", TRAIN)
    a_class.course(f'{course}\ncases: {{train: {{points: 1}}, "train:w3/w2": {{points: 1}}}}\n')
    path, out = a_class.path("cases/train.yaml"), a_class.path("quiz.xml")
    a_class.run("export", "moodle-xml", path, "-o", out, "--no-figures")
    task = Task(path, course=read_course(a_class.path("cases/course.yaml")))
    compared = 0
    for question in ElementTree.parse(out).getroot().iter("question"):
        name = question.findtext("name/text") or ""
        what, unit = ("w3/w2" if "w3/w2" in name else ""), question.findtext("units/unit/unit_name") or ""
        for answer in question.iter("answer"):
            value, share = answer.findtext("text") or "*", float(answer.get("fraction") or 0)
            if value != "*" and share < 100.0:
                judged = task.grade(what, f"{value} {unit}")
                compared += 1
                assert abs(100.0 * judged["score"] - share) <= 8.5, (name, value)
    assert compared > 6
