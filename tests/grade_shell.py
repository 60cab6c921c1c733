"""Grading as a user runs it: files in a folder, a command, and what comes back."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import pytest

from shell import Ran, Shell

CASES = Path(__file__).parent.parent / "cases"
LEVER = """\
icsolve: 1
title: Lever
points: {A: [0, 0], B: [2, 0]}
joints:
  - {pin: [1, 2], at: A}
loads:
  P: {force: 100, link: 2, at: B, angle: -90}
  T: {torque: unknown, link: 2}
"""
"""T = +200 N*m, counterclockwise."""
PUSHER = """\
icsolve: 1
title: Slider pushed along a guide at 30 degrees
points: {A: [0, 0], G: [4, 3], C: [1, 0.75]}
joints:
  - {slide: [2, 1], at: C, along: [A, G]}
loads:
  P: {force: 100, link: 2, at: C, angle: 180}
  Q: {force: unknown, link: 2, at: C, angle: 0}
"""
"""Q = +100 N, at 0 degrees."""
DEAD = """\
icsolve: 1
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: 1, BC: 3}
angles: {AB: 0}
near: {C: [4, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads:
  T12: {torque: 10, link: 2}
  P: {force: unknown, link: 4, at: C, angle: 180}
"""
PRESS = """\
icsolve: 1
title: Press
units: {length: in, force: lbf}
variables:
  P: {range: [100, 500], step: 10}
  a: {choices: [1, 1.25, 1.5]}
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: $a, BC: 3.5, CD: 2.5, DE: 1 + $a/2}
angles: {AB: 60, CDE: 0}
near: {C: [3.5, 2.4]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
loads:
  P: {force: $P, link: 4, at: E, angle: 180}
  T12: {torque: unknown, link: 2}
"""
"""A four-bar whose load and crank are others for each student."""


class Class:
    """A folder with cases; `grade` runs the command there."""

    def __init__(self, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
        self.folder = folder
        self.run = Shell(capsys)
        (folder / "cases").mkdir()
        for name, text in (("lever", LEVER), ("pusher", PUSHER), ("dead", DEAD)):
            self.case(name, text)

    def case(self, name: str, text: str) -> None:
        (self.folder / "cases" / f"{name}.yaml").write_text(text, encoding="utf-8")

    def course(self, text: str) -> None:
        (self.folder / "cases" / "course.yaml").write_text(text, encoding="utf-8")

    def file(self, name: str, data: str | bytes) -> str:
        path = self.folder / name
        path.write_bytes(data if isinstance(data, bytes) else data.encode("utf-8"))
        return str(path)

    def path(self, name: str) -> Path:
        return self.folder / name

    def grade(self, answers: str | bytes, *options: str, name: str = "answers.csv") -> Ran:
        """Grade a table of answers; the results come on standard output."""
        table = self.file(name, answers)
        cases = str(self.folder / "cases")
        return self.run("grade", table, "--cases", cases, "-o", "-", "--quiet", *options)

    def judge(self, *answers: str, case: str = "lever") -> list[dict[str, str]]:
        """Each answer as that of a student of its own; the lines of the results in their order."""
        out = io.StringIO()
        table = csv.writer(out)
        table.writerow(["student_id", "case", "answer"])
        table.writerows([f"{n:04d}", case, answer] for n, answer in enumerate(answers))
        return self.grade(out.getvalue()).rows()

    def verdicts(self, *answers: str, case: str = "lever") -> list[str]:
        return [row["verdict"] for row in self.judge(*answers, case=case)]
