"""`icsolve sweep`: tables of rows, each with its status; nothing half-written."""

from __future__ import annotations

import csv
import io
import json
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import icsolve
from icsolve.cli import run as verbs
from icsolve.cli.sweeping import progression
from shell import exit_status

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


def test_a_row_is_what_solve_says_of_that_angle(press: Path, tmp_path: Path) -> None:
    out = tmp_path / "turn.csv"
    assert exit_status("sweep", str(press), "--vary", "angles.AB=60:90:10", "--points", "-o", str(out)) == 0
    rows = list(csv.DictReader(out.read_text().splitlines()))
    assert [float(row["angles.AB"]) for row in rows] == [60, 70, 80, 90]
    alone = icsolve.solve(icsolve.load(str(press), settings={"angles.AB": "80"}))
    assert float(rows[2]["T12"]) == pytest.approx(alone.answers["T12"].value, rel=1e-12)
    assert float(rows[2]["C.x"]) == pytest.approx(alone.points["C"][0], rel=1e-12)
    assert {row["status"] for row in rows} == {"ok"}


def test_several_ranges_are_a_product(press: Path, tmp_path: Path) -> None:
    out = tmp_path / "turn.jsonl"
    words = ("--vary", "angles.AB=60,80", "--vary", "loads.P=50:150:50", "-o", str(out))
    assert exit_status("sweep", str(press), *words) == 0
    rows = [json.loads(line) for line in out.read_text().splitlines()]
    varied = [(row["angles.AB"], row["loads.P"]) for row in rows]
    assert varied[:4] == [(60, 50), (60, 100), (60, 150), (80, 50)]
    assert rows[2]["T12"] == pytest.approx(3 * rows[0]["T12"])


def test_an_impossible_range_has_its_status_and_no_number(press: Path, tmp_path: Path) -> None:
    out = tmp_path / "turn.npz"
    press.write_text(PRESS.replace("AB: 1,", "AB: 3,"))
    assert exit_status("sweep", str(press), "--vary", "angles.AB=60:180:10", "-o", str(out)) == 0
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
    assert exit_status("sweep", str(press), "--vary", span, "-o", str(out)) == 2
    assert words in capsys.readouterr().err
    assert not out.exists()


def test_the_case_itself_is_never_written_over(press: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert exit_status("sweep", str(press), "--vary", "angles.AB=60:90:10", "-o", str(press)) == 2
    assert press.read_text() == PRESS
    assert ".csv, .jsonl or .npz" in capsys.readouterr().err


def test_values_of_a_range_are_the_decimals_that_were_meant(press: Path, tmp_path: Path) -> None:
    """0.3, not 0.1 + 0.1 + 0.1; and the last value is met."""
    out = tmp_path / "turn.csv"
    assert exit_status("sweep", str(press), "--vary", "angles.AB=0:1:0.1", "-o", str(out)) == 0
    shown = [row["angles.AB"] for row in csv.DictReader(out.read_text().splitlines())]
    assert shown == ["0.0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1.0"]


@settings(derandomize=True)
@given(st.decimals(-1000, 1000, places=6), st.decimals(-3, 3, places=5).filter(bool), st.integers(1, 500))
def test_every_value_of_a_range_is_rounded_once(first: Decimal, step: Decimal, count: int) -> None:
    found = progression(Fraction(first), Fraction(step), count).tolist()
    assert found == [float(Fraction(first) + k * Fraction(step)) for k in range(count)]


# --- positions --------------------------------------------------------------------------------------

TOGGLE = """icsolve: 1
units: {length: in, force: lbf}
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: 5, BC: 8}
angles: {AB: 40}
near: {C: [11, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads:
  P: {force: 10, link: 3, at: B, angle: -90}
  Q: {force: unknown, link: 4, at: C, angle: 180}
"""


@pytest.fixture
def toggle(tmp_path: Path) -> Path:
    path = tmp_path / "toggle.yaml"
    path.write_text(TOGGLE)
    return path


def test_where_a_toggle_locks(toggle: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Crank and rod in line: the block stands still, the force that it takes grows beyond bounds."""
    assert exit_status("sweep", str(toggle), "--vary", "angles.AB=-60:60:7", "--find", "dead") == 0
    assert capsys.readouterr().out == "angles.AB = 0: dead centre, no Q balances\n"
    assert exit_status("sweep", str(toggle), "--vary", "angles.AB=10:60:7", "--find", "dead") == 0
    said = "no dead centre, limit or change point in this range of angles.AB\n"
    assert capsys.readouterr().out == said


def test_at_which_angle_a_toggle_gives_a_force(toggle: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """By the closed form Q = P / (tan a + tan b) with 5 sin a = 8 sin b; asked in another unit."""
    words = ("--vary", "angles.AB=5:60:5", "--find", "Q=0.1 kN", "--json")
    assert exit_status("sweep", str(toggle), *words) == 0
    entry = json.loads(capsys.readouterr().out)
    (spot,) = entry["found"]
    force = 100.0 / 4.4482216152605
    a = np.radians(spot["at"]["angles.AB"])
    b = np.arcsin(5.0 / 8.0 * np.sin(a))
    assert 10.0 / (np.tan(a) + np.tan(b)) == pytest.approx(force, rel=1e-14)
    assert spot["answers"]["Q"]["value"] == pytest.approx(force, rel=1e-14)
    assert (spot["kind"], spot["answers"]["Q"]["unit"]) == ("value", "lbf")
    assert (entry["schema"], entry["case"], entry["status"]) == ("icsolve/find/1", "toggle", "ok")


def test_where_the_torque_of_a_slider_crank_peaks(toggle: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Force on the block, torque on the crank: largest where its derivative by the closed form is zero."""
    text = TOGGLE.replace("P: {force: 10, link: 3, at: B, angle: -90}", "T: {torque: unknown, link: 2}")
    toggle.write_text(text.replace("force: unknown", "force: 10"))
    assert exit_status("sweep", str(toggle), "--vary", "angles.AB=0:180:10", "--find", "max", "--json") == 0
    (spot,) = json.loads(capsys.readouterr().out)["found"]
    t = np.radians(spot["at"]["angles.AB"])
    root = np.sqrt(64.0 - (5.0 * np.sin(t)) ** 2)
    slope = np.cos(t) + 5.0 * np.cos(2 * t) / root + 125.0 * (np.sin(t) * np.cos(t)) ** 2 / root**3
    assert slope == pytest.approx(0.0, abs=1e-14)
    torque = 10.0 * (5.0 * np.sin(t) + 25.0 * np.sin(t) * np.cos(t) / root)
    assert abs(spot["answers"]["T"]["value"]) == pytest.approx(torque, rel=1e-14)


def test_a_link_that_is_turned_and_a_refusal_as_json(
    toggle: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert exit_status("sweep", str(toggle), "--drive", "2=-60:10:7", "--find", "dead") == 0
    assert capsys.readouterr().out == "link 2 turned by -40: dead centre, no Q balances\n"
    toggle.write_text(TOGGLE.replace("along: 0}", "along: 0, mu: 0.1}"))
    assert exit_status("sweep", str(toggle), "--drive", "2=-60:10:7", "--find", "dead", "--json") == 1
    entry = json.loads(capsys.readouterr().out)
    assert (entry["case"], entry["status"]) == ("toggle", "unsupported")


# --- the bar ----------------------------------------------------------------------------------------


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_a_bar_is_shown_of_long_work_on_a_terminal_only(
    press: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(verbs, "PATIENCE", 0.0)
    for stream, shares in ((Terminal(), (0.5, 1.0)), (Terminal(), ()), (io.StringIO(), (0.5, 1.0))):
        monkeypatch.setattr("sys.stderr", stream)
        with verbs.progress() as told:
            for share in shares:
                told("rows", share)
        assert ("100%" in stream.getvalue()) == (bool(shares) and stream.isatty())
    terminal = Terminal()
    monkeypatch.setattr("sys.stderr", terminal)
    exit_status("sweep", str(press), "--vary", "angles.AB=0:360:1", "-o", str(tmp_path / "turn.csv"))
    assert "rows" in terminal.getvalue() and "100%" in terminal.getvalue()


@pytest.mark.parametrize("want", [("answers",), ("answers", "error")])
def test_every_row_is_told_once_it_is_done(want: tuple[str, ...]) -> None:
    done: list[int] = []
    case = icsolve.load(PRESS)
    icsolve.sweep(case, {"angles.AB": np.linspace(0, 360, 10_001)}, want, progress=done.append)
    assert sum(done) == 10_001
    assert len(done) > 2


def test_rows_that_friction_holds_are_answers_as_the_scene_is(tmp_path: Path) -> None:
    """A range in which it holds is what `solve` ends with 0 for; of rows that are not posed none is one."""
    block = tmp_path / "block.yaml"
    block.write_text(
        "icsolve: 1\npoints: {C: [0, 0]}\njoints: [{slide: [2, 1], at: C, along: 30, mu: 0.1}]\n"
        "loads: {Q: {weight: 100, link: 2, at: C}, W: {force: unknown, link: 2, at: C, angle: 30}}\n"
    )
    assert exit_status("solve", block) == 0
    assert exit_status("sweep", block, "--vary", "loads.Q=50:150:50") == 0
    block.write_text(block.read_text().replace("angle: 30", "angle: 120").replace("mu: 0.1", "mu: 0"))
    assert exit_status("solve", block) == 1
    assert exit_status("sweep", block, "--vary", "loads.Q=50:150:50") == 1


def test_rows_that_tell_nothing_but_their_status_say_what_would_tell_more(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "crate.yaml"
    path.write_text("""icsolve: 1
points: {A: [0, 0], B: [1, 0], G: [0.5, 0.5], H: [0, 0.5]}
joints:
  - {contact: [1, 2], at: A, normal: 90, mu: 0.5}
  - {contact: [1, 2], at: B, normal: 90, mu: 0.5}
loads:
  W: {weight: 100, link: 2, at: G}
  P: {force: 20, link: 2, at: H, angle: 0}
""")
    for words, said in (
        (("--vary", "loads.P=0:40:20"), True),
        (("--vary", "loads.P=0:40:20", "--rates"), False),
    ):
        assert exit_status("sweep", str(path), *words) == 0
        assert ("--find hold tells where friction holds" in capsys.readouterr().err) is said
    path.write_text(PRESS)
    assert exit_status("sweep", str(path), "--vary", "angles.AB=60:90:10") == 0
    assert "status alone" not in capsys.readouterr().err
