"""Grading and drawing: answers judged beside the reading of them, the whole command, variants, a figure."""

from __future__ import annotations

import csv
import os
import random
import sys
from collections.abc import Sequence
from shutil import rmtree

from icsolve.bench.gates import Effort, Gate, Kept, cpu_seconds, once, ratio, table
from icsolve.files import scratch
from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Course
from icsolve.grade.judge import judge
from icsolve.grade.keys import NumberKey
from icsolve.grade.solved import unknowns
from icsolve.grade.written.answer import Reader
from icsolve.manual import kinds, template
from icsolve.read import load

Asked = tuple[str, float, str]
"""A question, its answer and its unit."""
WRONG = (-1.0, 0.5, 2.0, 10.0, 0.001, 25.4, 1.02, 1.37, 0.62)
MANY = 5000
"""Answers from which the time of one more is told."""


def asked_of(folder: str, names: Sequence[str]) -> list[Asked]:
    """The questions of cases that have one number for an answer."""
    store = CaseStore(folder, Course())
    keys = [store.key(name) for name in names]
    return [(key.question, key.value, key.unit_name) for key in keys if isinstance(key, NumberKey)]


def write_class(path: str | os.PathLike[str], students: int, asked: Sequence[Asked], seed: int = 1) -> int:
    """A row a student and question; right answers differ in their fourth figure; how many rows."""
    rng = random.Random(seed)
    with open(path, "w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["student_id", "case", "answer", "attempt", "submitted_at"])
        for _ in range(students):
            student = f"{rng.randrange(10**8):08d}"
            for case, value, unit in asked:
                factor = rng.choice(WRONG) if rng.random() < 0.35 else 1.0
                answer = value * factor * (1.0 + rng.uniform(-0.004, 0.004))
                text = f"{answer:.5g} {unit}" if rng.random() < 0.9 else f"{answer:.4e}"
                day, hour, minute = rng.randrange(1, 29), rng.randrange(24), rng.randrange(60)
                time = f"2025-03-{day:02d}T{hour:02d}:{minute:02d}:00"
                rows.writerow([student, case, text, rng.randrange(1, 4), time])
    return students * len(asked)


def read_plainly(path: str) -> None:
    """What no program can do without: Python's csv reads the file and float its numbers."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = csv.reader(file)
        next(rows)
        for row in rows:
            float(row[2].partition(" ")[0])


def judging(path: str, folder: str) -> float:
    """Seconds to judge every answer; no verdict is remembered. Keys and wrong answers are made before."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))[1:]
    store, reader = CaseStore(folder, Course()), Reader()
    keys = {name: key for name in {row[1] for row in rows} if isinstance(key := store.key(name), NumberKey)}
    for key in keys.values():
        key.wrongs.near(0.0)
    return min(once(lambda: [judge(keys[row[1]], reader.read(row[2])) for row in rows]) for _ in range(3))


def grading(effort: Effort, kept: Kept) -> str:
    """A class that answers the questions of every template, and variants of one of them for each student."""
    with scratch() as folder:
        path, cases = os.path.join(folder, "class.csv"), os.path.join(folder, "cases")
        os.mkdir(cases)
        for kind in kinds():
            _put(os.path.join(cases, f"{kind}.yaml"), template(kind))
        names = [kind for kind in kinds() if unknowns(load(template(kind)))]
        asked, size = asked_of(cases, names), max(40, 10 * effort.scenes)
        answers = write_class(path, size, asked)
        plainly = min(once(lambda: read_plainly(path)) for _ in range(5))
        alone = judging(path, cases)
        out = os.path.join(folder, "results.csv")
        wholes = [_command("grade", path, "--cases", cases, "-o", out, "--force", "-q")]
        if answers > MANY:  # starting, and solving each case with every mistake, takes as long for any class
            write_class(path, 3 * size, asked)
            wholes.append(_command("grade", path, "--cases", cases, "-o", out, "--force", "-q"))
        more = (wholes[-1] - wholes[0]) / 2.0
        students = 30 * effort.scenes
        variants = _variants(folder, students)
        for name in os.listdir(cases):
            os.unlink(os.path.join(cases, name))
        os.rmdir(cases)
    kept.gates.append(ratio("judging answers / reading them by csv and float", alone / plainly, 5))
    if answers > MANY:
        kept.gates.append(ratio("a further answer by the command `grade` / the same", more / plainly, 25))
    kept.gates.append(
        Gate(f"values and keys of {students} variants, a thousand", 1e3 * variants / students, 0.7, " s")
    )
    timed = [
        ("csv and float", plainly),
        ("judging alone", alone),
        ("icsolve grade, whole process", wholes[0]),
    ]
    timed += [("icsolve grade, each further answer", more)] if answers > MANY else []
    rows = [[name, f"{seconds / plainly:.1f}", f"{1e6 * seconds / answers:.2f}"] for name, seconds in timed]
    return table((f"{answers} answers", "x csv", "us an answer"), rows)


def _variants(folder: str, students: int) -> float:
    """Seconds of a process that gives each student a four-bar of their own."""
    ranges = "variables: {a: {range: [1, 1.5], step: 0.01}, phi: {range: [40, 80], step: 0.1}}\n"
    text = template("four-bar").replace("AB: 1,", "AB: $a,").replace("AB: 60", "AB: $phi")
    case, roster = os.path.join(folder, "varied.yaml"), os.path.join(folder, "roster.csv")
    _put(case, text.replace("lengths:", f"{ranges}lengths:", 1))
    _put(roster, "student_id\n" + "".join(f"{n:05d}\n" for n in range(students)))
    out = os.path.join(folder, "sheets")
    seconds = _command("variants", case, "--roster", roster, "-o", out, "--no-figures", "-q", "--force")
    rmtree(out)
    return seconds


def _put(path: str, text: str) -> None:
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def _command(*arguments: str) -> float:
    return cpu_seconds([sys.executable, "-m", "icsolve", *arguments])


def drawing(effort: Effort, kept: Kept) -> str:
    """The figure of a six-bar with everything on it."""
    from icsolve.draw import Drawing, draw

    case = load(template("six-bar"))
    plain, full = (lambda: draw(case)), (lambda: draw(case, Drawing("all", circle=True, velocities=True)))
    draw(case)
    seconds = [min(once(call) for _ in range(effort.rounds)) for call in (plain, full)]
    kept.gates.append(Gate("a drawing with all centres, circle and velocities", seconds[1], 2.0, " s"))
    named = zip(("as it comes", "all centres, circle, velocities"), seconds, strict=True)
    return table(("a six-bar drawn", "ms"), [[name, f"{1e3 * took:.0f}"] for name, took in named])
