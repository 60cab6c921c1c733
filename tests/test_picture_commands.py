"""`icsolve draw` and `icsolve explain` as commands: what they write, what they refuse, and that what was read
is never written over."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import icsolve
from icsolve.draw.tikz import escaped, escaped_in_math
from icsolve.draw.words import answer_sentences
from icsolve.report.derivation.known import known_of
from library import FILES, sample
from pictures import parsed
from shell import exit_status
from sizes import sampled
from test_draw import DEAD_CENTRE, FOUR_BAR

ROOT = Path(__file__).parent.parent
VERBS = ("draw", "explain")
ENDINGS = {"draw": ".svg", "explain": ".txt", "page": ".html"}


@pytest.fixture
def press(tmp_path: Path) -> Path:
    path = tmp_path / "press.yaml"
    path.write_text(FOUR_BAR.format(title="Press", crank=1))
    return path


@pytest.mark.parametrize("verb", VERBS)
def test_a_file_is_what_standard_output_would_be(
    verb: str, press: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / f"out{ENDINGS[verb]}"
    assert exit_status(verb, str(press)) == 0
    shown = capsys.readouterr()
    assert exit_status(verb, str(press), "-o", str(out)) == 0
    assert out.read_text(encoding="utf-8") == shown.out
    assert shown.err == capsys.readouterr().err == ""


@pytest.mark.parametrize("verb", VERBS)
@pytest.mark.parametrize("name", ["missing/out", "."])
def test_a_path_that_cannot_be_written_is_said(
    verb: str, name: str, press: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert exit_status(verb, str(press), "-o", str(tmp_path / name)) == 2
    assert "can't be written" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["press.yaml"]


@pytest.mark.parametrize("verb", VERBS)
def test_the_case_itself_is_never_written_over(
    verb: str, press: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """By its own name, by another way to it, or by a link."""
    text = press.read_text()
    (tmp_path / "link.svg").symlink_to(press)
    os.link(press, tmp_path / "hard.svg")
    for name in ("press.yaml", "../" + tmp_path.name + "/press.yaml", "link.svg", "hard.svg"):
        assert exit_status(verb, str(press), "-o", str(tmp_path / name)) == 2
        assert "is one of the files read here, and is left as it is" in capsys.readouterr().err
        assert press.read_text() == text


@pytest.mark.parametrize("verb", VERBS)
def test_several_cases_have_no_one_result(
    verb: str, press: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "second.yaml").write_text(press.read_text())
    assert exit_status(verb, str(tmp_path)) == 2
    assert "several files" in capsys.readouterr().err


@pytest.mark.parametrize("verb", VERBS)
@pytest.mark.parametrize(
    ("text", "status"),
    [(DEAD_CENTRE, "dead-centre"), (FOUR_BAR.format(title="t", crank=20), "cannot-assemble")],
)
def test_a_case_without_an_answer_is_written_with_the_reason(
    verb: str, text: str, status: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case, out = tmp_path / "case.yaml", tmp_path / "out"
    case.write_text(text)
    assert exit_status(verb, str(case), "-o", str(out)) == 1
    said = capsys.readouterr().err
    assert f": {status}: " in said
    reason = said.partition(f": {status}: ")[2].split()
    shown = out.read_text(encoding="utf-8")
    if verb == "draw":
        shown = " ".join(parsed(shown).texts("t-reason"))
    assert " ".join(reason)[1:40] in " ".join(shown.split())


@pytest.mark.parametrize("verb", VERBS)
def test_what_is_no_case_leaves_no_file(
    verb: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case, out = tmp_path / "case.yaml", tmp_path / "out"
    case.write_text("icsolve: 1\njoints: [\n")
    assert exit_status(verb, str(case), "-o", str(out)) == 2
    assert "case.yaml:" in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.parametrize("words", [("--step", "-1"), ("--centres", "some"), ("--step", "x")])
def test_options_that_cannot_be_are_refused(words: tuple[str, ...], press: Path) -> None:
    assert exit_status("draw", str(press), *words) == 2


@sampled(2)
@pytest.mark.parametrize(
    "words",
    [
        ("draw", "cases/linkages/watt_six_bar.yaml", "--centres", "all", "--circle", "--velocities"),
        ("draw", "cases/linkages/watt_six_bar.yaml", "--bodies"),
        ("draw", "cases/ch13/13_21_door_linkage.yaml", "--bodies"),
        ("explain", "cases/gears/epicyclic_train.yaml", "--format", "html", "--bodies"),
    ],
)
def test_the_same_bytes_in_every_process(words: tuple[str, ...]) -> None:
    """Whatever order sets and dictionaries have there."""
    both = [
        subprocess.run(
            [sys.executable, "-m", "icsolve", *words],
            cwd=ROOT,
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
        ).stdout
        for seed in ("1", "7")
    ]
    assert both[0] == both[1] and both[0]


@pytest.mark.parametrize("verb", VERBS)
@pytest.mark.parametrize("ending", ["png", "pdf", "eps", "dxf", "docx"])
def test_an_ending_that_is_not_known_is_refused_with_those_that_are(
    verb: str, ending: str, press: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / f"out.{ending}"
    assert exit_status(verb, str(press), "-o", str(out)) == 2
    said = capsys.readouterr().err
    assert ENDINGS[verb] in said and "should end in" in said
    assert not out.exists()


@pytest.mark.skipif(not shutil.which("pdflatex"), reason="LaTeX is not installed")
@pytest.mark.parametrize("name", sample(FILES, 40, "lines of LaTeX"))
def test_no_equation_is_wider_than_its_page(name: str, tmp_path: Path) -> None:
    """Sums of many moments are broken into several lines."""
    assert exit_status("explain", str(FILES[name]), "--bodies", "-o", str(tmp_path / "out.tex")) == 0
    run = ["pdflatex", "-interaction=batchmode", "-halt-on-error", "out.tex"]
    subprocess.run(run, cwd=tmp_path, check=True)
    log = (tmp_path / "out.log").read_text(encoding="latin-1")
    assert not re.search(r"Overfull .hbox \(\S+ too wide\) detected", log)


@pytest.mark.parametrize("verb", ["draw", "explain"])
def test_latex_is_written_by_its_ending(verb: str, tmp_path: Path) -> None:
    """Every group is closed, every style that is used is defined once, and no text is left to chance."""
    case, out = tmp_path / "case.yaml", tmp_path / "out.tex"
    case.write_text(FOUR_BAR.format(title="'50 % & more: #1 $x_2$ ^~\\{}'", crank=1))
    assert exit_status(verb, str(case), "-o", str(out)) == 0
    text = out.read_text(encoding="utf-8")
    begun, ended = re.findall(r"\\begin{(.*?)}", text), re.findall(r"\\end{(.*?)}", text)
    assert sorted(begun) == sorted(ended) and "tikzpicture" in begun
    bare = re.sub(r"\\[\\{}%]", "", re.sub(r"(?m)(?<!\\)%.*$", "", text))
    assert bare.count("{") == bare.count("}")
    styles = re.findall(r"\\tikzset{ic ([\w-]+)/", text)
    assert len(styles) == len(set(styles))
    assert set(re.findall(r"\[ic ([\w-]+)[],]", text)) <= set(styles)
    assert r"50 \% \& more: \#1 \$x\_2\$" in text
    if shutil.which("pdflatex"):
        subprocess.run(["pdflatex", "-interaction=batchmode", out.name], cwd=tmp_path, check=True)


@pytest.mark.skipif(not shutil.which("pdflatex"), reason="LaTeX is not installed")
def test_latex_sets_every_character_that_a_case_may_have(tmp_path: Path) -> None:
    """In texts and in formulas, of which the fonts have fewer letters."""
    codes = (*range(0x20, 0x600), *range(0x1E00, 0x2400), *range(0x3000, 0x3040), *range(0xFB00, 0xFB10))
    letters = [chr(n) for n in codes]
    lines = [rf"{escaped(c)}\par" for c in letters]
    lines += [f"$\\mathrm{{{escaped_in_math(c)}}}$" for c in letters if c.isalpha()]
    packages = "\\usepackage[utf8]{inputenc}\n\\usepackage[T1]{fontenc}\n\\usepackage{amsmath,textcomp}\n"
    body = "\n".join(lines)
    (tmp_path / "out.tex").write_text(
        f"\\documentclass{{article}}\n{packages}\\begin{{document}}\n{body}\n\\end{{document}}\n",
        encoding="utf-8",
    )
    run = ["pdflatex", "-interaction=batchmode", "-halt-on-error", "out.tex"]
    subprocess.run(run, cwd=tmp_path, check=True)
    assert "Missing character" not in (tmp_path / "out.log").read_text(encoding="latin-1")


def test_letters_of_other_alphabets_stay_what_they_are_in_latex(tmp_path: Path) -> None:
    """Greek as symbols, in names too; of a letter that the fonts lack its own without the accent, if they
    have that."""
    case, out = tmp_path / "case.yaml", tmp_path / "out.tex"
    title = "Kräfte – µ ≥ 0,2; φ → Ω/2, Łódź, Čapek, “Ș”, ở"
    case.write_text(BRACKET.replace("icsolve: 1", f"icsolve: 1\ntitle: {title!r}").replace("W:", "W_ü:"))
    assert exit_status("explain", str(case), "-o", str(out)) == 0
    text = out.read_text(encoding="utf-8")
    told = r"Kräfte – µ \ensuremath{\geq} 0,2; \ensuremath{\varphi} \ensuremath{\rightarrow} "
    assert told + r"\ensuremath{\Omega}/2, Łódź, Čapek, “Ș”, o" in text
    assert r"$\mathrm{W\_\textnormal{ü}}$" in text


BRACKET = """icsolve: 1
units: {length: m, force: kN}
points: {A: [0, 0], B: [0, 1.5], C: [2, 0]}
joints: [{pin: [1, 2], at: A}, {pin: [1, 3], at: B}, {pin: [2, 3], at: C}]
loads: {W: {force: 6, link: 2, at: C, angle: -90}}
"""


def test_a_sheet_asks_for_the_forces_in_a_structure_and_has_them_in_its_key(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """By hand: the tie pulls with 6 / 0.6 = 10, the strut pushes with 10 x 0.8 = 8."""
    (tmp_path / "bracket.yaml").write_text(BRACKET)
    assert exit_status("sheet", str(tmp_path / "bracket.yaml")) == 0
    question, _, key = capsys.readouterr().out.partition("\\section*{Key")
    assert "\\section*{Exercises}\n\\subsection*{1. " in question  # no page has the heading alone
    assert "The forces and couples in the joints." in question and "8 kN" not in question
    assert "$F_{12}$ = 8 kN at 0 deg" in key and "$F_{13}$ = 10 kN at 143.1 deg" in key


VARIED = FOUR_BAR.format(title="Press", crank=1).replace("force: 100", "force: $P")
VARIED += "variables: {P: {choices: [40, 80]}}\n"
NUMBERS = "student_id,email,variant,P\n7,a@b.c,v1,40\n8,d@e.f,v2,80\n"


@pytest.mark.parametrize("bore", [30, 50])
def test_a_sheet_asks_for_a_length_whether_or_not_the_loads_balance(bore: float, tmp_path: Path) -> None:
    """A boom on its cylinder: of 30 it rests at one length, of 50 at none; then the key says so."""
    case = tmp_path / "boom.yaml"
    case.write_text(f"""icsolve: 1
units: {{length: m, force: kN}}
points: {{A: [0, 0], D: [1, 0]}}
lengths: {{AB: 2, AC: 1, CD: unknown}}
angles: {{CAB: 0}}
near: {{C: [0, 1]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: C}}
  - {{pin: [1, 4], at: D}}
  - {{slide: [3, 4], at: C, along: [D, C]}}
loads:
  W: {{weight: 5, link: 2, at: B}}
  P: {{pressure: 10 MPa, bore: {bore} mm, link: 3, at: C, away: D, against: 4}}
""")
    assert exit_status("sheet", str(case), "-o", str(tmp_path / "boom.tex")) == int(bore == 50)
    assert ("No answer (no-value)" in (tmp_path / "boom.tex").read_text()) == (bore == 50)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_a_sheet_reads_the_numbers_as_a_spreadsheet_saves_them(
    tmp_path: Path, encoding: str, delimiter: str
) -> None:
    case, values, out = (tmp_path / name for name in ("press.yaml", "values.csv", "exam.tex"))
    case.write_text(VARIED)
    values.write_bytes(NUMBERS.replace("7,", '="007",').replace(",", delimiter).encode(encoding))
    of_one = ("--variants", str(values), "--student", "007")
    assert exit_status("sheet", str(case), *of_one, "-o", str(out)) == 0
    assert "Key 007" in out.read_text(encoding="utf-8")


def test_a_sheet_has_the_numbers_of_each_student_and_the_key_behind(tmp_path: Path) -> None:
    case, values, out = (tmp_path / name for name in ("press.yaml", "values.csv", "exam.tex"))
    case.write_text(VARIED)
    values.write_text(NUMBERS)
    assert exit_status("sheet", str(case), "--variants", str(values), "-o", str(out)) == 0
    questions, _, keys = out.read_text(encoding="utf-8").partition("\\section*{Key 7}")
    for force in (40, 80):
        known = known_of(icsolve.load(case, {"variables.P": str(force)}))
        (sentence,) = answer_sentences(known)
        number = sentence.split()[2]
        assert f"= {force} " in questions or f"of {force} " in questions
        assert number in keys and f"= {number} " not in questions
    assert exit_status("sheet", str(case), "--variants", str(values), "--student", "8", "-o", str(out)) == 0
    assert "Key 7" not in out.read_text(encoding="utf-8")
    assert exit_status("sheet", str(case), "--variants", str(values), "--student", "9", "-o", str(out)) == 2
    assert exit_status("sheet", str(case), "-o", str(tmp_path / "exam.pdf")) == 2
