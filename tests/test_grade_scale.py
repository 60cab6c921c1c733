"""Scale: large classes in little memory; `ICSOLVE_FULL=1` runs the full sizes."""

from __future__ import annotations

import csv
import os
import subprocess
import sys
from pathlib import Path

import pytest

from grade_bench import CASES, questions, write_class
from grade_shell import PRESS
from sizes import FULL

ROOT = Path(__file__).parent.parent


def command(*arguments: str) -> tuple[float, int]:
    """CPU seconds and kilobytes at most of a command, with those that it starts."""
    script = (
        "import resource,subprocess,sys;code=subprocess.run(sys.argv[1:]).returncode;"
        "u=resource.getrusage(resource.RUSAGE_CHILDREN);print(u.ru_utime+u.ru_stime,u.ru_maxrss,code)"
    )
    run = [sys.executable, "-c", script, sys.executable, "-m", "icsolve", *arguments]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    ran = subprocess.run(run, capture_output=True, text=True, check=True, env=environment)
    seconds, kilobytes, code = ran.stdout.split()
    assert code == "0", ran.stderr
    return float(seconds), int(kilobytes)


@pytest.mark.skipif(not FULL, reason="a million answers; set ICSOLVE_FULL=1")
def test_a_million_answers_in_under_400_megabytes(tmp_path: Path) -> None:
    table, out = tmp_path / "class.csv", tmp_path / "results.csv"
    write_class(table, 40_000)
    _, kilobytes = command("grade", str(table), "--cases", str(CASES), "-o", str(out), "-q")
    assert kilobytes < 400_000
    with open(out, encoding="utf-8") as file:
        assert sum(1 for _ in file) > 999_000


def test_memory_does_not_grow_with_the_answers(tmp_path: Path) -> None:
    """Twice the answers, the same memory: what is judged is counted and forgotten."""
    if not FULL:
        pytest.skip("600,000 answers; set ICSOLVE_FULL=1")
    sizes = []
    for students in (12_000, 24_000):
        table = tmp_path / f"{students}.csv"
        write_class(table, students)
        sizes.append(
            command(
                "grade", str(table), "--cases", str(CASES), "-o", str(tmp_path / f"{students}.out"), "-q"
            )[1]
        )
    assert sizes[1] < 1.25 * sizes[0]


@pytest.mark.skipif(not FULL, reason="3,000 scenes; set ICSOLVE_FULL=1")
def test_3000_different_variants_of_a_four_bar_with_values_and_keys(tmp_path: Path) -> None:
    """Of crank lengths by hundredths and crank angles by tenths of a degree."""
    (tmp_path / "cases").mkdir()
    ranges = "a: {range: [1, 1.5], step: 0.01}\n  phi: {range: [40, 80], step: 0.1}"
    text = PRESS.replace("a: {choices: [1, 1.25, 1.5]}", ranges).replace("AB: 60", "AB: $phi")
    (tmp_path / "cases" / "press.yaml").write_text(text)
    roster = tmp_path / "roster.csv"
    roster.write_text("student_id\n" + "".join(f"{n:05d}\n" for n in range(3000)))
    out = tmp_path / "out"
    command(
        "variants", str(tmp_path / "cases"), "--roster", str(roster), "-o", str(out), "--no-figures", "-q"
    )
    with open(out / "press" / "key.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 3000
    assert len({row["variant"] for row in rows}) > 2900


def test_two_corrections_and_40_overrides_leave_all_other_lines_alone(tmp_path: Path) -> None:
    """3,000 students and 25 cases (60 in a sample): keys of two cases corrected, 40 marks by hand."""
    table, cases = tmp_path / "class.csv", tmp_path / "cases"
    cases.mkdir()
    files = {path.stem: path for path in CASES.rglob("*.yaml")}
    for name, _, _ in questions():
        (cases / f"{name}.yaml").write_text(files[name].read_text())
    write_class(table, 3000 if FULL else 60)
    corrected = {"13_07_slider_crank": ("force: 10,", "force: 13,"), "gear_pair": ("[20, 50]", "[25, 50]")}
    marks = tmp_path / "marks.csv"
    with open(table, newline="") as file:
        rows = list(csv.DictReader(file))
    others = [(row["student_id"], row["case"]) for row in rows if row["case"] not in corrected]
    overruled = set(others[:: len(rows) // 45][:40])
    marks.write_text("student_id,case,score\n" + "".join(f"{s},{c},0.25\n" for s, c in sorted(overruled)))
    command("grade", str(table), "--cases", str(cases), "-o", str(tmp_path / "before.csv"), "-q")
    for name, (misprint, right) in corrected.items():
        (cases / f"{name}.yaml").write_text(files[name].read_text().replace(misprint, right))
    more = ("--overrides", str(marks), "--against", str(tmp_path / "before.csv"))
    command("grade", str(table), "--cases", str(cases), "-o", str(tmp_path / "after.csv"), "-q", *more)
    before, after = ((tmp_path / f"{name}.csv").read_bytes().splitlines() for name in ("before", "after"))
    pairs = zip(before, after, strict=True)
    changed = {tuple(old.decode().split(",")[:2]) for old, new in pairs if old != new}
    assert overruled <= changed
    assert {case for _, case in changed - overruled} == set(corrected)
