"""`icsolve sweep`: tables of rows, each with its status; nothing half-written."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

import icsolve
from icsolve.cli import main

PRESS = """icsolve: 1
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 1, BC: 3.5, CD: 2.5, DE: 1.5}
angles: {AB: 60, CDE: 0}
near: {C: [3.5, 2.4]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
loads:
  P: {force: 100, link: 4, at: E, angle: 180}
  T12: {torque: unknown, link: 2}
"""


@pytest.fixture
def press(tmp_path: Path) -> Path:
    path = tmp_path / "press.yaml"
    path.write_text(PRESS)
    return path


def swept(*words: str) -> int:
    """The exit status of the command."""
    with pytest.raises(SystemExit) as ended:
        main(["sweep", *words])
    return int(ended.value.code or 0)


def test_a_row_is_what_solve_says_of_that_angle(press: Path, tmp_path: Path) -> None:
    out = tmp_path / "turn.csv"
    assert swept(str(press), "--vary", "angles.AB=60:90:10", "--points", "-o", str(out)) == 0
    rows = list(csv.DictReader(out.read_text().splitlines()))
    assert [float(row["angles.AB"]) for row in rows] == [60, 70, 80, 90]
    alone = icsolve.solve(icsolve.load(str(press), settings={"angles.AB": "80"}))
    assert float(rows[2]["T12"]) == pytest.approx(alone.answers["T12"].value, rel=1e-12)
    assert float(rows[2]["C.x"]) == pytest.approx(alone.points["C"][0], rel=1e-12)
    assert {row["status"] for row in rows} == {"ok"}


def test_several_ranges_are_a_product(press: Path, tmp_path: Path) -> None:
    out = tmp_path / "turn.jsonl"
    words = ("--vary", "angles.AB=60,80", "--vary", "loads.P=50:150:50", "-o", str(out))
    assert swept(str(press), *words) == 0
    rows = [json.loads(line) for line in out.read_text().splitlines()]
    varied = [(row["angles.AB"], row["loads.P"]) for row in rows]
    assert varied[:4] == [(60, 50), (60, 100), (60, 150), (80, 50)]
    assert rows[2]["T12"] == pytest.approx(3 * rows[0]["T12"])


def test_an_impossible_range_has_its_status_and_no_number(press: Path, tmp_path: Path) -> None:
    out = tmp_path / "turn.npz"
    press.write_text(PRESS.replace("AB: 1,", "AB: 3,"))
    assert swept(str(press), "--vary", "angles.AB=60:180:10", "-o", str(out)) == 0
    with np.load(out) as table:
        status, torque = table["status"], table["T12"]
    assert "cannot-assemble" in set(status)
    assert np.array_equal(np.isfinite(torque), status == "ok")


@pytest.mark.parametrize(
    ("span", "words"),
    [
        ("angles.AB=90:60:10", "empty range"),
        ("angles.AB=0:360:0", "empty range"),
        ("angles.AB=a:b:c", "is not PATH=FROM:TO:STEP"),
        ("angles.AB=0:1e12:1e-3", "rows fit"),
        ("angles.XY=0:10:1", "angles.XY"),
    ],
)
def test_a_range_that_means_nothing_is_refused(
    press: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], span: str, words: str
) -> None:
    out = tmp_path / "turn.csv"
    assert swept(str(press), "--vary", span, "-o", str(out)) == 2
    assert words in capsys.readouterr().err
    assert not out.exists()


def test_the_case_itself_is_never_written_over(press: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert swept(str(press), "--vary", "angles.AB=60:90:10", "-o", str(press)) == 2
    assert press.read_text() == PRESS
    assert ".csv, .jsonl or .npz" in capsys.readouterr().err
