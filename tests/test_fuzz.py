"""Whatever a file holds, every command ends: in a result, or in a refusal with its place.

A sample of the mutations of `fuzzing.py`, and all inputs that once broke something.
"""

from __future__ import annotations

import os
import random
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from corpus import ALL
from fuzzing import FOUND, TOKENS, Dice, by_characters, by_lines, by_nodes, campaign, faults_of, run
from icsolve.assembly import newton
from icsolve.errors import CaseError
from icsolve.manual import template
from icsolve.read import load
from icsolve.sweep import find_by_scenes
from sizes import FULL, few, sampled

SAMPLE = int(os.environ.get("ICSOLVE_FUZZ", "40"))
"""Cases that go through all commands; ``python tests/fuzzing.py`` takes any number."""


def four_bar() -> str:
    """A case with nothing unusual."""
    return template("four-bar")


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ICSOLVE_DEBUG", "1")
    if not FULL:
        monkeypatch.setattr("fuzzing.SHARE", 1 / 3)
        monkeypatch.setattr(newton, "MOST_BOXES", 1_000)
        monkeypatch.setattr("icsolve.page.motion.COARSE", 45.0)  # rows that are solved one by one
        monkeypatch.setattr("icsolve.page.motion.STEP", 15.0)  # of doubtful rows each is so too
        monkeypatch.setattr(find_by_scenes, "PLACES", 20)
        monkeypatch.setattr(newton, "MOST_WORK", 6_000)
        monkeypatch.setattr(newton, "CLOSE_WORK", 2_000)
    return tmp_path


@sampled(3)
@pytest.mark.parametrize("path", sorted(FOUND.glob("*.yaml")), ids=lambda path: path.stem)
def test_what_once_broke_something_goes_through_every_command(path: Path, here: Path) -> None:
    assert not faults_of(random.Random(path.name), path.read_text(encoding="utf-8", errors="surrogateescape"))


@pytest.mark.parametrize("path", sorted(FOUND.glob("*.csv")), ids=lambda path: path.stem)
def test_tables_that_once_broke_something_are_graded(path: Path, here: Path) -> None:
    Path("cases").mkdir()
    Path("cases/case.yaml").write_text(four_bar())
    code, said, trace = run(["grade", str(path), "--cases", "cases", "-o", "out.csv"], apart=False)
    assert code in (0, 1, 2), trace
    assert code == 2 or Path("out.csv").exists()
    assert said or code == 0


@sampled(2)
@pytest.mark.parametrize("seed", [1, 2, 4, 5])  # 0 and 3 draw the ten-bar, which once broke something
def test_mutated_cases_go_through_every_command(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ICSOLVE_DEBUG", "1")
    found = list(campaign(SAMPLE // 4, seed))
    assert not found, found[0]


@pytest.mark.parametrize("mutate", [by_characters, by_lines, by_nodes])
def test_no_mutation_ends_otherwise_than_in_a_case_or_a_refusal(mutate: Callable[[Dice, str], str]) -> None:
    dice = Dice(20240229)
    texts = list(ALL.values())
    read, refused = 0, 0
    for _ in range(few(400)):
        text = mutate(dice, dice.choice(texts))
        refusal = _refusal(text + "\n", {})
        read, refused = read + (refusal is None), refused + (refusal is not None)
        for problem in refusal.problems if refusal else ():
            assert 1 <= problem.line <= len(text.splitlines()) + 2
            assert problem.column >= 1
            assert problem.message
            assert str(problem).isprintable()
    assert read > few(5)
    assert refused > few(100)


@sampled(3)
@pytest.mark.parametrize("seed", range(3))
def test_no_setting_ends_otherwise_than_in_a_case_or_a_refusal(seed: int) -> None:
    """Paths of the case's own marks, cut and mixed, with strange values."""
    dice = Dice(seed)
    text = dice.choice(list(ALL.values()))
    paths = list(load(text).marks)
    for _ in range(few(400)):
        steps = ".".join(dice.choice(paths) for _ in range(dice.choice((1, 1, 2)))).split(".")
        path = ".".join(dice.sample(steps, dice.randint(1, len(steps))) if dice.random() < 0.5 else steps)
        value = dice.choice([dice.choice(TOKENS), "30", 3.5, float("nan"), float("inf"), "2 mm"])
        refusal = _refusal(text, {path: value})
        assert refusal is None or all(str(problem).isprintable() for problem in refusal.problems)


def _refusal(text: str, settings: dict[str, str | float]) -> CaseError | None:
    try:
        load(text, settings)
    except CaseError as error:
        return error
    return None


# --- nothing hangs --------------------------------------------------------------------------------------

LINKAGE = Path(__file__).parent.parent / "cases" / "linkages" / "chebyshev_lambda.yaml"


@pytest.mark.parametrize("name", ["pipe.yaml", "pipe.csv", "submission_metadata.yml", "course.yaml"])
def test_only_regular_files_of_a_folder_are_read(name: str, here: Path) -> None:
    Path("all").mkdir()
    Path("all/case.yaml").write_text(four_bar())
    Path("all/a.csv").write_text("student_id,case,answer\n1,case,3\n")
    os.mkfifo(f"all/{name}")
    lines = ["solve all", "check all/*.yaml", "gallery all -o out", "grade all --cases all -o r.csv"]
    for line in (*lines, "export gift all -o quiz.gift"):
        code, _, trace = run(line.split(), apart=False)
        assert code in (0, 1), (line, trace)


def test_links_that_lead_round_are_seen_once(here: Path) -> None:
    Path("all/in").mkdir(parents=True)
    Path("all/in/case.yaml").write_text(four_bar())
    for n in range(8):
        Path(f"all/round{n}").symlink_to(".")
        Path(f"all/in/up{n}").symlink_to("..")
    code, said, trace = run(["check", "all/**/*.yaml"], apart=False)
    assert (code, said.count("case.yaml")) == (0, 0), trace
    from icsolve.cli.run import sources

    assert [source.path for source in sources("all/**/*.yaml")] == ["all/in/case.yaml"]
    assert [source.path for source in sources(f"{here}/**/c*.yaml")] == [f"{here}/all/in/case.yaml"]
    assert [source.path for source in sources("**/in/*.yaml")] == ["all/in/case.yaml"]
    assert [source.path for source in sources("all/**")] == ["all/in/case.yaml"]


@pytest.mark.parametrize("number", ["1e99999999", "1e-99999999", "1e9999", "2e400", "1e-400", "-1e+99999"])
@pytest.mark.parametrize("where", ["choices: [{}, 2]", "range: [{}, 2], step: 1", "range: [1, 2], step: {}"])
@pytest.mark.parametrize("use", ["$P", "2*$P", "$P + 1", "1/$P"])
def test_exponents_are_limited(number: str, where: str, use: str) -> None:
    text = four_bar().replace("force: 100,", f"force: {use},", 1)
    text = text.replace("points:", f"variables: {{P: {{{where.format(number)}}}}}\npoints:", 1)
    with pytest.raises(CaseError) as refused:
        load(text)
    assert all(problem.line > 1 for problem in refused.value.problems)


@pytest.mark.parametrize(
    "formula", ["$P/1e400", "$P*1e400", "$P/1e300/1e300", "1e305*$P*10", "$P*1e-200*1e-200"]
)
def test_a_formula_beyond_all_numbers_is_refused_and_never_zero(formula: str) -> None:
    text = four_bar().replace("force: 100,", f"force: {formula},", 1)
    text = text.replace("points:", "variables: {P: {choices: [1, 2]}}\npoints:", 1)
    with pytest.raises(CaseError, match=r"too (large|small)"):
        load(text)


def test_a_formula_that_is_zero_is_zero() -> None:
    text = four_bar().replace("force: 100,", "force: 0*$P + 1e-400*0,", 1)
    text = text.replace("points:", "variables: {P: {choices: [1, 2]}}\npoints:", 1)
    assert load(text).loads[0].value.value == 0.0  # type: ignore[union-attr]


@sampled(3)
@pytest.mark.parametrize(
    "fill", [" ", "\t", "-", "=", "(", "1", "1,", "e", '"', "''", "° ", "\u00a0", "x10^"]
)
def test_long_answers_are_read_in_linear_work(fill: str, here: Path) -> None:
    """Work is counted in seconds of the processor, of which a square would take thousands."""
    Path("case.yaml").write_text(four_bar())
    long = fill * (200_000 // len(fill))
    rows = "".join(f"1,case,{text}\n" for text in (f"3{long}N", long, f"{long}3"))
    Path("a.csv").write_text(f"student_id,case,answer\n{rows}2,{long},3\n{long},case,3\n")
    Path("b.txt").write_text(f"case:{long}3\n{long}case: 3\ncase{long}= 3\n")
    for line in ("grade a.csv --cases case.yaml", "grade b.txt --student 7 --cases case.yaml"):
        code, _, trace = run(line.split(), apart=False)
        assert code in (0, 1, 2), trace


@pytest.mark.parametrize("span", ["0:100000:50000", "0:1e9:5e8", "0,1e300", "-1e7:1e7:1e7"])
@pytest.mark.parametrize("more", [[], ["--find", "dead"], ["--find", "max"], ["--plot", "x.svg"]])
def test_the_work_of_a_sweep_is_that_of_its_rows(span: str, more: list[str], here: Path) -> None:
    for link in ("2", "3"):
        code, said, trace = run(["sweep", str(LINKAGE), "--drive", f"{link}={span}", *more], apart=False)
        assert code in (0, 1, 2), trace
        assert code != 2 or said


# --- statuses -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("band", ["nan", "inf", "-1", "0", "1e999", "x"])
def test_a_tolerance_is_a_finite_number_above_zero(band: str, here: Path) -> None:
    Path("case.yaml").write_text(four_bar())
    assert run(["solve", "case.yaml", "--tolerance", band], apart=False)[0] == 2


@pytest.mark.parametrize("kind", ["moodle-xml", "gift", "prairielearn", "gradescope-zip"])
def test_an_answer_of_zero_is_exported(kind: str, here: Path) -> None:
    Path("case.yaml").write_text(re.sub("force: 100,", "force: 0,", four_bar()))
    code, _, trace = run(["export", kind, "case.yaml", "-o", "out"], apart=False)
    assert code in (0, 1), trace


BAD = {
    "empty.csv": b"",
    "binary.csv": bytes(range(256)) * 20,
    "zip.csv": b"PK\x03\x04" + b"\0" * 300,
    "nul.txt": b"\0" * 300,
    "header.csv": b"student_id,case,answer\n",
    "cut.csv": b'student_id,case,answer\n1,case,"3 N\n',
    "other.csv": b"a,b\n1,2\n",
    "html.csv": b"<html><body>404</body></html>",
}


@pytest.mark.parametrize("how", ["a folder", "names", "an export"])
@pytest.mark.parametrize("bad", BAD)
def test_one_bad_hand_in_is_one_students(bad: str, how: str, here: Path) -> None:
    Path("case.yaml").write_text(four_bar())
    good = b"student_id,case,answer\n7,case,3 N\n8,case,4 N\n"
    if how == "an export":
        for folder, content, name in (("s1", BAD[bad], bad), ("s2", b"case: 3 N\n", "answers.txt")):
            Path("hand", folder).mkdir(parents=True)
            Path("hand", folder, name).write_bytes(content)
        people = "".join(f"{s}:\n  :submitters:\n  - :sid: {n}\n" for s, n in (("s1", "5"), ("s2", "7")))
        Path("hand/submission_metadata.yml").write_text(people)
    else:
        Path("hand").mkdir()
        Path("hand", bad).write_bytes(BAD[bad])
        Path("hand/good.csv").write_bytes(good)
    what = ["hand"] if how != "names" else [f"hand/{bad}", "hand/good.csv"]
    code, said, trace = run(["grade", *what, "--cases", "case.yaml", "-o", "out.csv", "-q"], apart=False)
    assert code in (0, 1), trace
    assert "\n7,case," in Path("out.csv").read_text()
    assert bad in said or how == "an export"


def test_a_file_of_answers_alone_that_cannot_be_used_is_refused(here: Path) -> None:
    Path("case.yaml").write_text(four_bar())
    for name, content in BAD.items():
        Path(name).write_bytes(content)
        code, said, _ = run(["grade", name, "--cases", "case.yaml", "-o", f"{name}.out"], apart=False)
        assert name in said
        assert code == (1 if name == "cut.csv" else 2)
