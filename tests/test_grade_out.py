"""Results and questions for platforms, each against the form that the platform documents."""

from __future__ import annotations

import base64
import csv
import io
import json
import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from grade_shell import CASES, PRESS, Class
from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Course
from icsolve.grade.keys import NumberKey
from shell import Ran
from sizes import sampled
from test_grade_verdict import ZERO

ANSWERS = (
    "student_id,case,answer\n"
    "007,lever,200 N*m ccw\n007,pusher,-100\n"
    '008,lever,"1,234"\n008,pusher,nonsense\n'
    "009,lever,\n009,nowhere,5\n"
)
ROSTER = (
    "student_id,email,first_name,last_name,section\n"
    "007,ann@x.test,Ann,Bee,A\n008,bob@x.test,Bob,Cee,A\n009,,=Cy,Dee,B\n"
)


@pytest.fixture
def a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    return Class(tmp_path, capsys)


def written(a_class: Class, kind: str, name: str, *options: str, answers: str = ANSWERS) -> Path:
    """The file that `--write` makes of these answers."""
    roster = a_class.file("roster.csv", ROSTER)
    out = a_class.path(name)
    ran = a_class.grade(answers, "--write", f"{kind}={out}", "--roster", roster, *options)
    assert ran.code in (0, 1)
    return out


def table(path: Path, **options: Any) -> list[list[str]]:
    return list(csv.reader(io.StringIO(path.read_text(encoding="utf-8")), **options))


STATUS = {"passed", "failed"}
VISIBLE = {"hidden", "after_due_date", "after_published", "visible"}
FORMATS = {"text", "html", "simple_format", "md", "ansi"}


def check_gradescope(entry: dict[str, Any]) -> None:
    """``results.json`` as Gradescope's autograder specification gives it."""
    known = {"score", "execution_time", "output", "output_format", "test_output_format", "test_name_format"}
    known |= {"visibility", "stdout_visibility", "extra_data", "leaderboard", "tests"}
    assert set(entry) <= known
    assert isinstance(entry["score"], int | float)
    assert {entry["visibility"], entry["stdout_visibility"]} <= VISIBLE
    assert entry["output_format"] in FORMATS
    fields = {
        "score",
        "max_score",
        "status",
        "name",
        "name_format",
        "number",
        "output",
        "output_format",
        "tags",
    }
    for test in entry["tests"]:
        assert set(test) <= fields | {"visibility", "extra_data"}
        assert isinstance(test["score"], int | float) and isinstance(test["max_score"], int | float)
        assert test["status"] in STATUS and test["visibility"] in VISIBLE
        assert isinstance(test["number"], str) and all(isinstance(tag, str) for tag in test["tags"])
    assert entry["score"] == pytest.approx(sum(test["score"] for test in entry["tests"]))


def test_gradescope_results_of_each_student(a_class: Class) -> None:
    folder = written(a_class, "gradescope", "gs")
    assert {path.name for path in folder.iterdir()} == {"007.json", "008.json", "009.json"}
    for path in folder.iterdir():
        check_gradescope(json.loads(path.read_text()))
    ann = json.loads((folder / "007.json").read_text())
    assert [(test["name"], test["status"], test["score"]) for test in ann["tests"]] == [
        ("lever", "passed", 1.0),
        ("pusher", "failed", 0.0),
    ]
    assert ann["tests"][1]["tags"] == ["wrong", "sign"]


def test_the_autograder_zip_runs_as_gradescope_runs_it(a_class: Class, tmp_path: Path) -> None:
    archive = a_class.path("autograder.zip")
    a_class.course("cases: {lever: {points: 5}, pusher: {points: 5}}\n")
    cases = str(a_class.path("cases"))
    assert a_class.run("export", "gradescope-zip", cases, "-o", str(archive)).code == 0
    first = archive.read_bytes()
    a_class.run("export", "gradescope-zip", cases, "-o", str(archive), "--force")
    assert archive.read_bytes() == first
    base = tmp_path / "autograder"
    with zipfile.ZipFile(archive) as zipped:
        assert {"setup.sh", "run_autograder", "cases/lever.yaml", "cases/course.yaml"} <= set(
            zipped.namelist()
        )
        assert all(zipped.getinfo(n).external_attr >> 16 & 0o111 for n in ("setup.sh", "run_autograder"))
        zipped.extractall(base / "source")
    (base / "submission").mkdir()
    (base / "submission" / "answers.txt").write_text("lever: 200 N*m ccw\npusher: -100\n")
    metadata = {"users": [{"email": "ann@x.test"}], "created_at": "2025-03-01T10:00:00Z"}
    (base / "submission_metadata.json").write_text(json.dumps(metadata))
    graded = autograded(base)
    check_gradescope(graded)
    assert graded["score"] == 5.0
    (base / "submission" / "answers.txt").unlink()
    (base / "results" / "results.json").unlink()
    assert autograded(base)["score"] == 0


def autograded(base: Path) -> Any:
    """What the unpacked zip writes, by the icsolve that is in it and no other."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "AUTOGRADER": str(base), "PATH": path}
    environment.pop("PYTHONPATH", None)
    package = base / "source" / "icsolve" / "__init__.py"
    package.write_text(package.read_text() + f"\nopen({str(base / 'ran')!r}, 'w').close()\n")
    subprocess.run(["bash", str(base / "source" / "run_autograder")], env=environment, check=False)
    assert (base / "ran").exists()
    return json.loads((base / "results" / "results.json").read_text())


def test_the_autograder_gives_each_student_the_key_of_their_variant(a_class: Class, tmp_path: Path) -> None:
    """Gradescope knows an email, the roster whose it is; seed, course and roster are in the zip."""
    a_class.case("press", PRESS)
    a_class.course("points: 7\n")
    roster = a_class.file("roster.csv", "student_id,email\n0017,ann@x.test\n0018,bob@x.test\n")
    archive, cases = a_class.path("autograder.zip"), str(a_class.path("cases"))
    options = ("--roster", roster, "--seed", "it's 2025")
    assert a_class.run("export", "gradescope-zip", cases, "-o", str(archive), *options).code == 0
    base = tmp_path / "autograder"
    with zipfile.ZipFile(archive) as zipped:
        zipped.extractall(base / "source")
    key = CaseStore(cases, Course(seed="it's 2025")).key("press", "0017")
    assert isinstance(key, NumberKey)
    (base / "submission").mkdir()
    (base / "submission" / "answers.csv").write_text(f"case,answer\npress,{key.value:.6g}\n")
    (base / "submission_metadata.json").write_text(json.dumps({"users": [{"email": "ann@x.test"}]}))
    entry = autograded(base)
    assert (entry["score"], len(entry["tests"])) == (7.0, 1)


def test_the_canvas_gradebook(a_class: Class) -> None:
    rows = table(written(a_class, "canvas", "canvas.csv"))
    assert rows[0] == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "lever", "pusher"]
    assert rows[1] == ["    Points Possible", "", "", "", "", "1", "1"]
    assert rows[2] == ["Bee, Ann", "", "007", "ann@x.test", "A", "1", "0"]
    assert rows[4][0] == "Dee, =Cy"


def test_the_teachers_own_canvas_export_is_filled(a_class: Class) -> None:
    template = a_class.file(
        "export.csv",
        "Student,ID,SIS User ID,SIS Login ID,Section,lever (991)\n    Points Possible,,,,,1.0\n"
        '"Bee, Ann",31,007,ann,A,\n"Cee, Bob",32,,bob@x.test,A,0.5\n"Other, One",33,x,x,A,0.25\n',
    )
    rows = table(written(a_class, "canvas", "canvas.csv", "--template", template))
    assert rows[0] == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "lever (991)", "pusher"]
    assert [row[5:] for row in rows[1:]] == [["1.0", "1"], ["1", "0"], ["", ""], ["0.25", ""]]


def test_moodles_worksheet_has_grade_and_comment_always(a_class: Class) -> None:
    """An import of comments alone wipes the grades."""
    header, *rows = table(written(a_class, "moodle", "moodle.csv"))
    assert header == (
        "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed,"
        "Last modified (submission),Last modified (grade),Feedback comments"
    ).split(",")
    assert [row[:2] + row[4:6] for row in rows] == [
        ["007", "Ann Bee", "1", "2"],
        ["008", "Bob Cee", "", "2"],
        ["009", "'=Cy Dee", "0", "2"],
    ]
    assert all(bool(row[4]) == bool(row[-1]) for row in rows)


def test_the_teachers_own_worksheet_in_german_is_filled(a_class: Class) -> None:
    template = a_class.file(
        "blatt.csv",
        "ID;Vollständiger Name;E-Mail-Adresse;Status;Bewertung;Bestwertung;Feedback als Kommentar\n"
        "Teilnehmer/in 123;Ann Bee;ann@x.test;;;10,00;\nTeilnehmer/in 124;Zoe;zoe@x.test;;;10,00;\n",
    )
    _, ann, zoe = table(written(a_class, "moodle", "moodle.csv", "--template", template), delimiter=";")
    assert ann[:2] == ["Teilnehmer/in 123", "Ann Bee"]
    assert ann[4] == "5,00"
    assert "lever: right" in ann[6]
    assert zoe[4:] == ["", "10,00", ""]


def test_prairielearn_results_and_scores(a_class: Class) -> None:
    folder = written(a_class, "prairielearn", "pl")
    ann, bob = (json.loads((folder / f"{name}.json").read_text()) for name in ("007", "008"))
    for entry in (ann, bob):
        assert set(entry) <= {"gradable", "score", "message", "output", "images", "format_errors", "tests"}
        assert 0.0 <= entry["score"] <= 1.0
        for test in entry["tests"]:
            assert set(test) == {"name", "description", "points", "max_points", "message", "output"}
    assert (ann["gradable"], ann["score"]) == (True, 0.5)
    assert bob["gradable"] is False
    assert [error.partition(":")[0] for error in bob["format_errors"]] == ["lever", "pusher"]
    rows = table(written(a_class, "prairielearn-csv", "pl.csv"))
    assert rows[0] == ["uid", "instance", "qid", "score_perc", "feedback"]
    assert rows[1][:4] == ["007", "1", "lever", "100"]


def test_the_prairielearn_question_grades_by_itself(a_class: Class, monkeypatch: pytest.MonkeyPatch) -> None:
    a_class.case("press", PRESS)
    a_class.course("cases: {press: {tolerance: 5%}}\n")
    folder = a_class.path("elements")
    assert a_class.run("export", "prairielearn", str(a_class.path("cases")), "-o", str(folder)).code == 1
    info = json.loads((folder / "press" / "info.json").read_text())
    assert {"uuid", "title", "topic", "type"} <= set(info)
    assert re.fullmatch(r"[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}", info["uuid"])
    assert (folder / "lever" / "clientFilesQuestion" / "figure.svg").read_text().startswith("<svg")
    assert (folder / "press" / "course.yaml").exists()
    html = (folder / "press" / "question.html").read_text()
    assert '<pl-figure file-name="figure.svg" type="dynamic" alt="' in html
    scope: dict[str, Any] = {"__file__": str(folder / "press" / "server.py")}
    exec((folder / "press" / "server.py").read_text(), scope)
    data: dict[str, Any] = {"variant_seed": "77", "params": {}, "correct_answers": {}}
    data |= {"submitted_answers": {}, "format_errors": {}, "partial_scores": {}}
    scope["generate"](data)
    assert set(data["params"]) >= {"P", "a", "given", "asked"}
    data["submitted_answers"]["answer"] = data["correct_answers"]["answer"]
    scope["parse"](data)
    scope["grade"](data)
    assert (data["score"], data["format_errors"]) == (1.0, {})
    value = float(data["correct_answers"]["answer"].split()[0])
    data["submitted_answers"]["answer"] = f"{1.04 * value}"
    scope["grade"](data)
    assert data["score"] == 1.0
    assert data["params"]["P"] in scope["file"]({**data, "filename": "figure.svg"})
    data["submitted_answers"]["answer"] = f"{-value}"
    scope["grade"](data)
    assert data["partial_scores"]["answer"]["score"] == 0.0
    assert "sense" in data["partial_scores"]["answer"]["feedback"]
    # PrairieLearn's own text field leaves None where nothing was written, and no person looks at what is
    # taken back as a format error
    for answer in ("five", "33 and 34 lbf*in", "12,345 lbf*in", "", None):
        data |= {"submitted_answers": {"answer": answer}, "format_errors": {}}
        scope["parse"](data)
        assert "person" not in data["format_errors"]["answer"]
    assert data["format_errors"]["answer"] == "No answer was given."


def test_junit(a_class: Class) -> None:
    root = ElementTree.fromstring(written(a_class, "junit", "report.xml").read_text(encoding="utf-8"))
    assert root.tag == "testsuites"
    assert {key: root.get(key) for key in ("tests", "failures", "errors", "skipped")} == {
        "tests": "7", "failures": "1", "errors": "1", "skipped": "4",
    }  # fmt: skip
    for suite in root:
        assert suite.tag == "testsuite"
        cases = list(suite)
        assert len(cases) == int(suite.get("tests") or -1)
        assert sum(case.find("failure") is not None for case in cases) == int(suite.get("failures") or 0)
        assert all(case.get("name") and case.get("classname") for case in cases)


def moodle(a_class: Class, cases: str, *options: str) -> ElementTree.Element:
    out = a_class.path("quiz.xml")
    a_class.run("export", "moodle-xml", cases, "-o", str(out), "--force", *options)
    return ElementTree.fromstring(out.read_text(encoding="utf-8"))


FRACTIONS = (
    "100 90 83.33333 80 75 70 66.66667 60 50 40 33.33333 30 25 20 16.66667 14.28571 12.5 11.11111 10 5 0"
).split()


def test_moodle_questions_with_tolerances_units_and_wrong_answers(a_class: Class) -> None:
    a_class.course("malrules: {sign: 50%, half: 34%}\nunit: required\npoints: 3\n")
    category, *questions = moodle(a_class, str(a_class.path("cases")))
    assert category.find("category/text").text == "$course$/icsolve"  # type: ignore[union-attr]
    assert [q.findtext("name/text") for q in questions] == ["lever", "pusher"]
    (lever, _) = questions
    assert lever.get("type") == "numerical"
    tags = "name questiontext generalfeedback defaultgrade penalty hidden answer units".split()
    assert set(tags) <= {child.tag for child in lever}
    answers = lever.findall("answer")
    assert all(answer.get("fraction") in FRACTIONS for answer in answers)
    right, *wrong, rest = [(a.get("fraction"), a.findtext("text"), a.findtext("tolerance")) for a in answers]
    assert right == ("100", "200", "2.0000002")
    assert ("50", "-200", "2.0000002") in wrong
    assert ("33.33333", "100", "1.0000001") in wrong
    assert rest == ("0", "*", "0")
    assert lever.findtext("defaultgrade") == "3"
    assert lever.findtext("unitgradingtype") == "1"
    units = {
        u.findtext("unit_name"): float(u.findtext("multiplier") or 0) for u in lever.findall("units/unit")
    }
    assert units["N*m"] == 1.0
    assert units["kN*m"] == pytest.approx(0.001)
    assert units["lbf*ft"] == pytest.approx(0.7375621)
    assert all(len(name or "") <= 50 for name in units)


def test_no_wrong_answer_of_a_moodle_question_swallows_the_right_one(a_class: Class) -> None:
    """Moodle takes the first row that matches, and rows may not take each other's answers."""
    for question in moodle(a_class, str(CASES / "ch13"), "--no-figures")[1:]:
        rows = [
            (float(a.findtext("text") or 0), float(a.findtext("tolerance") or 0))
            for a in question.findall("answer")[:-1]
        ]
        right, half = rows[0]
        assert half == pytest.approx(0.01 * abs(right), rel=1e-3)
        assert all(abs(value - right) > half for value, _ in rows[1:])


def test_the_figure_of_a_question_is_in_the_file_and_shows_no_answer(a_class: Class) -> None:
    (question,) = moodle(a_class, str(CASES / "ch13" / "13_08_four_bar.yaml"))[1:]
    file = question.find("questiontext/file")
    assert file is not None and file.get("encoding") == "base64"
    picture = base64.b64decode(file.text or "").decode("utf-8")
    assert "@@PLUGINFILE@@/figure.svg" in (question.findtext("questiontext/text") or "")
    assert "T12 = ?" in picture
    assert "29.67" not in picture


def test_variants_become_questions_of_their_own(a_class: Class) -> None:
    a_class.case("press", PRESS)
    path = str(a_class.path("cases/press.yaml"))
    questions = moodle(a_class, path, "--no-figures", "--count", "4")[1:]
    assert [q.findtext("name/text") for q in questions] == [f"press v{n}" for n in (1, 2, 3, 4)]
    assert len({q.findtext("answer/text") for q in questions}) > 1


def test_gift(a_class: Class) -> None:
    """``{#=%100%value:tolerance#feedback ...}`` with its own characters escaped."""
    out = a_class.path("quiz.gift")
    a_class.run("export", "gift", str(a_class.path("cases/lever.yaml")), "-o", str(out))
    text = out.read_text(encoding="utf-8")
    category, question = text.strip().split("\n\n")
    assert category == "$CATEGORY: $course$/icsolve"
    found = re.fullmatch(r"::lever::(.*) \{#\n(.*)\n####(.*)\n\}", question, re.DOTALL)
    assert found is not None
    for part in (found.group(1), found.group(3)):
        assert not re.search(r"(?<!\\)[~=#{}:]", part)
    rows = [
        re.fullmatch(r"=%([\d.]+)%(-?[\d.e+-]+):([\d.e+-]+)#(.*)", row) for row in found.group(2).split("\n")
    ]
    assert all(rows)
    assert [row.groups()[:3] for row in rows[:2] if row] == [
        ("100", "200", "2.0000002"),
        ("0", "-200", "2.0000002"),
    ]
    assert not any(re.search(r"(?<!\\)[~=#{}:]", row.group(4)) for row in rows if row)


def test_an_unknown_kind_is_refused(a_class: Class) -> None:
    ran = a_class.grade(ANSWERS, "--write", f"schoology={a_class.path('x')}")
    assert ran.code == 2
    assert "there is no such kind" in ran.err
    assert a_class.run("export", "scorm", str(a_class.path("cases")), "-o", "x").code == 2


QTI = "{http://www.imsglobal.org/xsd/ims_qtiasiv1p2}"
PACKAGE = "{http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1}"


def test_a_canvas_quiz_as_qti(a_class: Class) -> None:
    """Every file that the manifest names is in the package; each question has its band, figure and unit."""
    a_class.case("press", PRESS)
    a_class.case("zero", ZERO)
    a_class.course("course: Mechanics <II>\ncases: {lever: {points: 3}}\n")
    out = a_class.path("quiz.zip")
    ran = a_class.run("export", "qti", str(a_class.path("cases")), "-o", str(out), "--count", "3")
    assert ran.code == 1
    assert "dead.yaml: " in ran.err
    with zipfile.ZipFile(out) as archive:
        names = set(archive.namelist())
        manifest = ElementTree.fromstring(archive.read("imsmanifest.xml"))
        named = {file.get("href") for file in manifest.iter(f"{PACKAGE}file")}
        assert named | {"imsmanifest.xml"} == names
        (quiz,) = [r for r in manifest.iter(f"{PACKAGE}resource") if r.get("type") == "imsqti_xmlv1p2"]
        root = ElementTree.fromstring(archive.read(quiz[0].get("href") or ""))
        pictures = [archive.read(name).decode() for name in names if name.endswith(".svg")]
    assert root[0].get("title") == "Mechanics <II>"
    items = {item.get("title"): item for item in root.iter(f"{QTI}item")}
    assert set(items) == {"lever", "pusher", "press v1", "press v2", "press v3", "zero"}
    lever = items["lever"]
    told = {field[0].text: field[1].text for field in lever.iter(f"{QTI}qtimetadatafield")}
    assert (told["question_type"], told["points_possible"]) == ("numerical_question", "3")
    assert lever.find(f".//{QTI}render_fib").get("fibtype") == "Decimal"  # type: ignore[union-attr]
    assert band(lever) == pytest.approx([200.0, 198.0, 202.0])
    assert band(items["zero"]) == pytest.approx([0.0, -0.2, 0.2])
    text = lever.findtext(f".//{QTI}mattext") or ""
    assert "$IMS-CC-FILEBASE$/figures/" in text
    assert "Write the number alone, in N*m." in text
    assert lever.findtext(f".//{QTI}setvar") == "100"
    told_after = {f.get("ident") for f in lever.iter(f"{QTI}itemfeedback")}
    assert told_after >= {"correct_fb", "general_incorrect_fb"}
    assert told_after == {f.get("linkrefid") for f in lever.iter(f"{QTI}displayfeedback")}
    wrong = {condition.findtext(f"{QTI}conditionvar/{QTI}varequal"): condition[-1].get("linkrefid")
             for condition in lever.iter(f"{QTI}respcondition")}  # fmt: skip
    said = {f.get("ident"): f.findtext(f".//{QTI}mattext") or "" for f in lever.iter(f"{QTI}itemfeedback")}
    assert "Right size, wrong sense" in said[wrong["-200"]]
    assert "Half the right size" in said[wrong["100"]]
    assert "Right size, wrong sense" in said["general_incorrect_fb"]
    assert "200" not in said["general_incorrect_fb"]
    for way in ("or", "and"):  # Canvas takes each of them for a right answer
        assert len(list(lever.iter(f"{QTI}{way}"))) == 1
    group = next(s for s in root.iter(f"{QTI}section") if s.get("title") == "press")
    assert group.findtext(f".//{QTI}selection_number") == "1"
    assert len(group.findall(f"{QTI}item")) == 3
    assert len(pictures) == 6
    assert all("= ?" in picture for picture in pictures)


def band(item: ElementTree.Element) -> list[float]:
    """The right answer of an item, and the ends of what is accepted."""
    return [float(item.findtext(f".//{QTI}{tag}") or "nan") for tag in ("varequal", "vargte", "varlte")]


ENDINGS = {
    "moodle-xml": (".xml",),
    "gift": (".gift", ".txt"),
    "qti": (".zip",),
    "gradescope-zip": (".zip",),
    "prairielearn": (".questions", ".v2"),
}
"""What the file, or the folder, of each kind may end in."""


@sampled(2)
@pytest.mark.parametrize("kind", ENDINGS)
def test_an_export_is_not_written_under_the_ending_of_something_else(kind: str, a_class: Class) -> None:
    """Its own endings, also in capitals, and none at all; a folder may have any that no file has."""
    cases = a_class.path("cases")

    def ran(name: str) -> Ran:
        return a_class.run("export", kind, str(cases), "-o", str(a_class.path(name)), "--count", "1")

    for name in ("good", *(f"good{ending}" for ending in ENDINGS[kind]), f"GOOD{ENDINGS[kind][0].upper()}"):
        assert ran(name).code in (0, 1) and a_class.path(name).exists()
    said = f"should end in {ENDINGS[kind][0]}" if kind != "prairielearn" else "writes is a folder"
    others = {".xml", ".gift", ".txt", ".zip", *({".csv", ".pdf"} if kind != "prairielearn" else ())}
    for ending in others - {*ENDINGS[kind]}:
        refused = ran(f"bad{ending}")
        assert refused.code == 2 and f"{kind} writes" in refused.err and said in refused.err
        assert not a_class.path(f"bad{ending}").exists()


@pytest.mark.parametrize("option", ["roster", "variants"])
def test_what_is_for_the_autograder_alone_is_refused_elsewhere(a_class: Class, option: str) -> None:
    cases, to = a_class.path("cases"), a_class.path("q.gift")
    ran = a_class.run("export", "gift", str(cases), "-o", str(to), f"--{option}", "x.csv")
    assert ran.code == 2 and f"--{option} is for gradescope-zip" in ran.err


@pytest.mark.parametrize("option", [("--count", "4"), ("--figures",)])
def test_what_an_autograder_has_none_of_is_told(option: tuple[str, ...], a_class: Class) -> None:
    """No option does nothing in silence: an autograder has no questions."""
    path = str(a_class.path("cases/lever.yaml"))
    for kind, told in (("gradescope-zip", True), ("moodle-xml", False)):
        to = str(a_class.path("a" + ENDINGS[kind][0]))
        ran = a_class.run("export", kind, path, "-o", to, *option)
        assert ran.code == 0 and (f"{option[0]} is for questions" in ran.err) == told


def test_questions_whose_answer_is_zero_are_exported(a_class: Class) -> None:
    for name in ("lever", "pusher", "dead"):
        a_class.path(f"cases/{name}.yaml").unlink()
    a_class.case("zero", ZERO)
    for kind in ("moodle-xml", "gift", "qti", "prairielearn"):
        ran = a_class.run("export", kind, str(a_class.path("cases")), "-o", str(a_class.path(f"out-{kind}")))
        assert (ran.code, kind) == (0, kind)


def test_a_question_of_several_right_answers_takes_each_of_them(a_class: Class) -> None:
    """A bar of 2 m with 10 N at its end and a couple of 10 N*m rests at 60 and at 300 degrees; as the readers
    of Moodle, of GIFT and of Canvas take it: with whole turns, and no other angle."""
    text = (
        "icsolve: 1\npoints: {A: [0, 0]}\nlengths: {AB: 2}\nangles: {AB: unknown}\n"
        "joints: [{pin: [1, 2], at: A}]\n"
        "loads: {W: {weight: 10, link: 2, at: B}, T: {torque: 10, link: 2}}\n"
    )
    a_class.case("bar", text)
    path, bands = str(a_class.path("cases/bar.yaml")), []
    question = moodle(a_class, path, "--no-figures")[1]
    rows = [
        [a.findtext("text"), a.findtext("tolerance")]
        for a in question.iter("answer")
        if a.get("fraction") == "100"
    ]
    bands.append([(float(value or 0), float(half or 0)) for value, half in rows])
    names = {"gift": "bar.gift", "qti": "bar.zip", "prairielearn": "bar"}
    out = {kind: a_class.path(name) for kind, name in names.items()}
    assert [a_class.run("export", kind, path, "-o", str(at)).code for kind, at in out.items()] == [0, 0, 0]
    found = re.findall(r"=%100%([-.\d]+):([-.\d]+)#", out["gift"].read_text())
    bands.append([(float(value), float(half)) for value, half in found])
    with zipfile.ZipFile(out["qti"]) as archive:
        (name,) = [n for n in archive.namelist() if re.fullmatch(r"(quiz_\w+)/\1\.xml", n)]
        root = ElementTree.fromstring(archive.read(name))
    ends = [[float(e.text or 0) for e in root.iter(f"{QTI}{tag}")] for tag in ("vargte", "varlte")]
    bands.append([((a + b) / 2.0, (b - a) / 2.0) for a, b in zip(*ends, strict=True)])
    for accepted in bands:
        for angle in (60.2, 300.2, -60.2, -300.2):
            assert any(abs(angle - value) <= half for value, half in accepted)
        for angle in (0.0, 66.0, 120.0, 180.0, 240.0):
            assert not any(abs(angle - value) <= half for value, half in accepted)
    scope: dict[str, Any] = {"__file__": str(out["prairielearn"] / "bar" / "server.py")}
    server = (out["prairielearn"] / "bar" / "server.py").read_text()
    exec(server, scope)
    marks = [
        scope["task"]({"variant_seed": "1"}).grade("", answer)["score"] for answer in ("60", "300 deg", "66")
    ]
    assert marks == [1.0, 1.0, 0.0]


def test_a_question_of_prairielearn_takes_a_range_in_words(a_class: Class) -> None:
    """A block on rough ground, 0.2 * 100 N about 50 N; Moodle, which takes one number, refuses it by name."""
    a_class.case(
        "block",
        "icsolve: 1\npoints: {A: [0, 0]}\njoints: [{slide: [2, 1], at: A, along: 0, mu: 0.2}]\nloads:\n"
        "  N: {force: 100, link: 2, at: A, angle: -90}\n  F: {force: 50, link: 2, at: A, angle: 180}\n"
        "  P: {force: unknown, link: 2, at: A, angle: 0}\n",
    )
    path, folder = str(a_class.path("cases/block.yaml")), a_class.path("elements")
    refused = a_class.run("export", "moodle-xml", path, "-o", str(a_class.path("block.xml")))
    assert refused.code == 1 and "P holds over a range" in refused.err
    assert a_class.run("export", "prairielearn", path, "-o", str(folder)).code == 0
    scope: dict[str, Any] = {"__file__": str(folder / "block" / "server.py")}
    exec((folder / "block" / "server.py").read_text(), scope)
    task = scope["task"]({"variant_seed": "1"})
    answers = (task.right(), "30 N to 70 N", "30 N", "30 N to 60 N")
    assert [task.grade("", answer)["verdict"] for answer in answers] == ["right", "right", "wrong", "wrong"]


def test_exports_carry_no_number_of_one_variant_in_titles(a_class: Class) -> None:
    a_class.case("press", PRESS.replace("title: Press", "title: Press with P = $P"))
    folder = a_class.path("elements")
    a_class.run("export", "prairielearn", str(a_class.path("cases/press.yaml")), "-o", str(folder))
    title = json.loads((folder / "press" / "info.json").read_text())["title"]
    assert not re.search(r"\d", title)
    assert not re.search(r"\d", (folder / "press" / "question.html").read_text())
    a_class.case("press", PRESS)
    questions = moodle(a_class, str(a_class.path("cases/press.yaml")), "--no-figures", "--count", "2")[1:]
    assert all("<p>Press</p>" in (q.findtext("questiontext/text") or "") for q in questions)


def test_right_answers_have_sensible_digits(a_class: Class) -> None:
    case, out = str(CASES / "ch13" / "13_08_four_bar.yaml"), a_class.path("e")
    a_class.run("export", "prairielearn", case, "-o", str(out))
    server = out / "13_08_four_bar" / "server.py"
    scope: dict[str, Any] = {"__file__": str(server)}
    exec(server.read_text(), scope)
    data: dict[str, Any] = {"variant_seed": "1", "params": {}, "correct_answers": {}}
    scope["generate"](data)
    assert data["correct_answers"]["answer"] == "29.6722 lbf*in"
    pins = r"icsolve 0\S+ where (?s:.*)serverFilesCourse \. numpy==\S+ shapely==\S+ click==\S+ pyyaml==\S+"
    assert re.search(pins, server.read_text())
    data |= {"submitted_answers": {"answer": "1,234"}, "format_errors": {}}
    scope["parse"](data)
    assert "two ways" in data["format_errors"]["answer"]


def test_an_autograder_carries_the_record_of_the_numbers(a_class: Class) -> None:
    a_class.case("press", PRESS)
    roster = a_class.file("roster.csv", "student_id\n1\n2\n")
    cases, sheets = str(a_class.path("cases")), str(a_class.path("sheets"))
    a_class.run("variants", cases, "--roster", roster, "-o", sheets, "--no-figures")
    out = str(a_class.path("auto.zip"))
    a_class.run("export", "gradescope-zip", cases, "-o", out, "--roster", roster, "--variants", sheets)
    with zipfile.ZipFile(out) as archive:
        assert {"variants/press/values.csv", "variants/press/key.csv"} <= set(archive.namelist())
        assert "--variants variants" in archive.read("run_autograder").decode()
        setup = archive.read("setup.sh").decode()
    assert re.search(r'install "numpy==\S+" "shapely==\S+" "click==\S+" "pyyaml==\S+"', setup)


def test_a_class_of_one_is_counted_in_the_singular(a_class: Class) -> None:
    """One student, one answer, right or wrong, in every output, and the numbers of one student."""
    a_class.case("press", PRESS)
    a_class.file("one.csv", "student_id\n0017\n")
    template = a_class.file("book.csv", "Student,ID,SIS User ID,SIS Login ID,Section\nA,1,0017,,\n")
    told = ""
    for answer in ("200 N*m ccw", "-200 N*m", "200 N*m maybe", "17"):
        path = a_class.file("answers.csv", f"student_id,case,answer\n0017,lever,{answer}\n")
        for kind in ("canvas", "gradescope", "prairielearn", "moodle"):
            out = a_class.path(f"{kind}-{len(told)}")
            more = ("--template", template) if kind == "canvas" else ()
            ran = a_class.run(
                "grade", path, "--cases", a_class.path("cases"), "--write", f"{kind}={out}", *more
            )
            told += ran.out + ran.err
    words = ("--roster", a_class.path("one.csv"), "-o", a_class.path("sheets"))
    told += a_class.run("variants", a_class.path("cases"), *words).err
    assert "1 student" in told and "1 sheet" in told
    nouns = "students|answers|wrong answers|figures|sheets|questions|marks"
    assert re.findall(rf"(?<![\d.])1 (?:{nouns})\b[^\n]*", told) == []


FEW = """\
icsolve: 1
variables: {P: {choices: [CHOICES]}}
points: {A: [0, 0], B: [2, 0]}
joints: [{pin: [1, 2], at: A}]
loads:
  P: {force: $P, link: 2, at: B, angle: -90}
  T: {torque: unknown, link: 2}
"""


@pytest.mark.parametrize(
    ("choices", "made"), [("10, 20, 30", 3), ("10, 20, 30, 40", 4), ("10, 20, 30, 40, 50, 60", 4)]
)
def test_no_two_exported_variants_are_alike(a_class: Class, choices: str, made: int) -> None:
    a_class.case("few", FEW.replace("CHOICES", choices))
    out = a_class.path("few.gift")
    a_class.run("export", "gift", a_class.path("cases/few.yaml"), "-o", out, "--count", "4")
    forces = re.findall(r"force of (\d+) N", out.read_text())
    assert len(forces) == len(set(forces)) == made


@sampled(2)
@pytest.mark.parametrize("folder", ["ropes", "sliders"])
def test_what_is_given_reads_as_sentences_in_gift(a_class: Class, folder: str) -> None:
    """No name stands before an equals sign with nothing after, and no sentence is made equal to something."""
    out = a_class.path("q.gift")
    a_class.run("export", "gift", CASES / folder, "-o", out)
    given = re.findall(r"Given\\: (.*?)\. (?:Find|In which|Over)", out.read_text())
    parts = [part for text in given for part in text.split("; ")]
    assert parts and not [part for part in parts if re.search(r"\\= *$|^\S+ \S[^:]* \\= ", part)]


@pytest.mark.parametrize("kind", ["moodle-xml", "gift", "qti", "prairielearn"])
def test_what_the_course_asks_by_name_is_exported_beside_the_unknowns(a_class: Class, kind: str) -> None:
    """Each student owes an answer to it, in a quiz too; that a centre has none is told."""
    a_class.case("press", PRESS)
    a_class.course('cases: {press: {}, "press:w4/w2": {points: 2}, "press:I24": {}, "press:F12": {}}\n')
    ending = {"moodle-xml": ".xml", "gift": ".gift", "qti": ".zip", "prairielearn": ""}[kind]
    out = a_class.path(f"quiz{ending}")
    ran = a_class.run("export", kind, str(a_class.path("cases/press.yaml")), "-o", str(out), "--count", "1")
    assert "I24 is a place, for which no such question can ask" in ran.err
    assert ran.err.endswith(": 3 questions\n") and ran.code == 1
    if kind == "prairielearn":
        assert sorted(folder.name for folder in out.iterdir()) == ["press", "press-F12", "press-w4-w2"]
        server = (out / "press-w4-w2" / "server.py").read_text()
        assert "QUESTION = 'w4/w2'" in server
    if kind == "moodle-xml":
        assert "Find the size of F12 in lbf." in out.read_text() and "Find w4/w2." in out.read_text()
