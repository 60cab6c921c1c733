"""`icsolve sweep` on what makes no sense, and on a disk or a reader that gives up: one clear line, the right
exit status, nothing half-written."""

from __future__ import annotations

import os
import re
import resource
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import icsolve
from icsolve.errors import ArgumentError
from icsolve.scene.sensitivity import numbers_of
from icsolve.sweep import request
from icsolve.sweep.find_on_record import Query, find
from icsolve.sweep.request import RequestError
from shell import Shell, exit_status
from sizes import sampled
from test_sweep_command import PRESS, press

__all__ = ["press"]
ROOT = Path(__file__).parent.parent
TURN = ("--vary", "angles.AB=0:360:1")
IN_SPACE = """icsolve: 1
points: {A: [0, 0, 0], B: [0, 0, 1]}
joints: [{ball: [1, 2], at: A}, {radial: [1, 2], at: B, axis: [0, 0, 1]}]
loads: {P: {force: [1, 2, 3], link: 2, at: B}}
"""


TRUSS = """icsolve: 1
points: {A: [0, 0], B: [3, 0], C: [1, 2]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: C}, {pin: [3, 1], at: B}]
loads: {P: {force: 120, link: 2, at: C, angle: -70}}
"""


@pytest.mark.parametrize(
    ("text", "links", "said"),
    [
        (TRUSS, "2", "nothing is left to move, the links hold one another. Vary a load"),
        (PRESS, "23", "the turning of link 3 and the turning of link 2 cannot both be given"),
        (PRESS, "1", "link 1 is the frame. Turn another link"),
    ],
)
def test_why_a_link_cannot_be_turned(text: str, links: str, said: str) -> None:
    with pytest.raises(icsolve.SceneError, match=said):
        icsolve.sweep(icsolve.load(text), drive={link: [0.0, 1.0] for link in links})


OTHERS: dict[str, Callable[[Any], Any]] = {
    "load": icsolve.load,
    "settings": lambda given: icsolve.load(PRESS, given),
    "a path of settings": lambda given: icsolve.load(PRESS, {given: 30}),
    "solve": icsolve.solve,
    "sweep": lambda given: icsolve.sweep(given, {"angles.AB": [30.0]}),
    "vary": lambda given: icsolve.sweep(icsolve.load(PRESS), given),
    "drive": lambda given: icsolve.sweep(icsolve.load(PRESS), drive=given),
    "a path": lambda given: icsolve.sweep(icsolve.load(PRESS), {given: [30.0]}),
    "want": lambda given: icsolve.sweep(icsolve.load(PRESS), {"angles.AB": [30.0]}, given),
    "evaluator": lambda given: icsolve.evaluator(given, ("angles.AB",)),
    "inputs": lambda given: icsolve.evaluator(icsolve.load(PRESS), given),
    "find": lambda given: find(given, {"angles.AB": [30.0, 60.0]}, Query("max")),
}
MEANT = {"load": (str, Path), "want": (str, list), "inputs": (str, list)}
"""What is meant there; whether it is a path or a word that the case has is another question."""


@pytest.mark.parametrize("at", OTHERS)
def test_what_an_argument_should_be_is_told(at: str) -> None:
    """The path of a case in the place of the case above all."""
    answer = icsolve.solve(icsolve.load(PRESS))
    for given in ("press.yaml", Path("press.yaml"), b"press.yaml", 3, 2.5, ["angles.AB"], object(), answer):
        allowed = (str,) if "path" in at else MEANT.get(at, ())
        if isinstance(given, allowed) or (isinstance(given, list) and "path" in at):
            continue
        with pytest.raises(ArgumentError, match=r"icsolve\.load\(|load\(\"|=\{|=\(|'angles.AB'") as told:
            OTHERS[at](given)
        assert isinstance(told.value, TypeError)
        assert "this is of the type " in str(told.value)
    with pytest.raises(ArgumentError, match=r"icsolve\.load\('tools/press.yaml'\)"):
        icsolve.solve("tools/press.yaml")  # type: ignore[arg-type]


@pytest.mark.parametrize("value", [None, [30.0], np.array([30.0, 40.0]), {}])
def test_a_setting_that_is_no_number_is_refused(value: Any) -> None:
    with pytest.raises(icsolve.CaseError, match=r"cannot set 'angles.AB': a value is a number or a text"):
        icsolve.load(PRESS, {"angles.AB": value})


def test_what_is_no_number_is_no_column() -> None:
    at = icsolve.evaluator(icsolve.load(PRESS), "angles.AB")
    for value in ("thirty", ["a"], {}, object()):
        with pytest.raises(RequestError, match=r"'angles\.AB' should be numbers"):
            at(value)  # type: ignore[arg-type]


def refused(*words: str) -> Callable[[str], bool]:
    return lambda text: all(word in text for word in words) and "fault of icsolve" not in text


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--vary", "angles.AC=0:10:1"], ["cannot vary 'angles.AC'", "angles.AB"]),
        (["--vary", "loads.T12=0:10:1"], ["T12 is the unknown"]),
        (["--vary", "load.P=0:10:1"], ["did you mean 'loads.P'?"]),
        (["--drive", "22=0:10:1"], ["no link '22'", "'2'"]),
        (["--vary", "angles.AB=90:60:10"], ["empty range"]),
        (["--vary", "angles.AB=0:360:-1"], ["empty range"]),
        (["--vary", "angles.AB=0:360:0"], ["empty range"]),
        (
            ["--vary", "angles.AB=0:360"],
            ["is not PATH=FROM:TO:STEP: a range has three numbers, and here are 2"],
        ),
        (["--vary", "angles.AB=0:x:1"], ["is not PATH=FROM:TO:STEP: 'x' is no bare number"]),
        (["--vary", "lengths.AB=1:2 mm:0.1"], ["'2 mm' is no bare number"]),
        (["--vary", "angles.AB=0::1"], ["a number is missing"]),
        (["--drive", "2=0:360"], ["is not LINK=FROM:TO:STEP", "2=0:360:1"]),
        (["--vary", "angles.AB=0:inf:1"], ["is not PATH=FROM:TO:STEP: 'inf' is no number of a mechanism"]),
        (["--vary", "angles.AB=nan"], ["is not PATH=FROM:TO:STEP"]),
        (["--vary", "angles.AB=1e300,1e301"], ["is not PATH=FROM:TO:STEP"]),
        (["--vary", "=0:1:1"], ["is not PATH=FROM:TO:STEP"]),
        (["--vary", "angles.AB=0:1e30:1e-20"], ["rows fit"]),
        (["--vary", "angles.AB=0:100:1e-3", "--vary", "loads.P=0:1e4:1"], ["rows together"]),
        (["--vary", "angles.AB=0:100:1e-3", "--points", "--centres", "--error"], ["numbers", "fewer rows"]),
        (["--vary", "angles.AB=0:9:1", "--vary", "angles.AB=0:9:1"], ["angles.AB is given twice"]),
        (["--vary", "lengths.AB=1:2:1", "--vary", "lengths.BA=1:2:1"], ["are the same number"]),
        ([], ["nothing is varied"]),
        ([*TURN, "--json"], ["--json is for --find"]),
        ([*TURN, "--find", "best"], ["dead, max or NAME=VALUE"]),
        ([*TURN, "--find", "T13=0"], ["no load 'T13'", "'T12'"]),
        ([*TURN, "--find", "P=0"], ["P is no unknown load"]),
        ([*TURN, "--find", "T12=12 lbf"], ["'lbf' is a unit of force", "T12 is in N*m"]),
        ([*TURN, "--find", "T12=much"], ["no number"]),
        ([*TURN, "--vary", "loads.P=1:9:1", "--find", "dead"], ["along one varied number"]),
        ([*TURN, "--plot", "x.svg", "--find", "dead"], ["leave --plot out"]),
        ([*TURN, "--points", "--rates", "--find", "max"], ["leave --points and --rates out"]),
    ],
)
def test_what_makes_no_sense_is_refused_in_one_line(
    press: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    options: list[str],
    words: list[str],
) -> None:
    monkeypatch.setattr(request, "MOST_NUMBERS", 4_000_000)  # so that no test has to make more
    out = tmp_path / "turn.csv"
    assert exit_status("sweep", str(press), *options, "-o", str(out)) == 2
    said = capsys.readouterr().err
    assert refused(*words)(said), said
    assert not out.exists()


def test_a_case_in_space_is_refused_by_name(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "space.yaml"
    path.write_text(IN_SPACE)
    for words in (["sweep", str(path), "--vary", "gravity=1:9:1"], ["solve", str(path), "--stability", "2"]):
        assert exit_status(*words) == 1
        assert refused("unsupported", "in space", "--set")(capsys.readouterr().err)


def test_a_case_without_an_unknown_has_rows_but_nothing_to_find(
    press: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    press.write_text(PRESS.replace("  T12: {torque: unknown, link: 2}\n", ""))
    out = tmp_path / "turn.csv"
    assert exit_status("sweep", str(press), "--vary", "angles.AB=60:80:10", "--rates", "-o", str(out)) == 0
    assert out.read_text().splitlines()[0] == "angles.AB,w1,w2,w3,w4,status"
    assert exit_status("sweep", str(press), *TURN, "--find", "dead") == 2
    assert "this case has none" in capsys.readouterr().err


def test_all_centres_of_a_thousand_links_are_more_than_a_table_holds() -> None:
    """499,500 pairs; single ones are had without them."""
    points = ", ".join(f"A{k}: [{k}, 0]" for k in range(1, 1000))
    joints = "\n".join(f"  - {{pin: [1, {k + 1}], at: A{k}}}" for k in range(1, 1000))
    case = icsolve.load(
        f"icsolve: 1\npoints: {{{points}}}\njoints:\n{joints}\n"
        "loads: {P: {torque: 1, link: 2}, T: {torque: unknown, link: 2}}\n"
    )
    with pytest.raises(request.RequestError, match="499500"):
        icsolve.sweep(case, {"loads.P": np.arange(3.0)}, ("centres",))


# --- what is written --------------------------------------------------------------------------------


def test_a_file_that_was_there_is_not_replaced_in_silence(
    press: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "turn.csv"
    assert exit_status("sweep", str(press), *TURN, "-o", str(out)) == 0
    assert "replaced" not in capsys.readouterr().err
    assert exit_status("sweep", str(press), *TURN, "-o", str(out)) == 0
    assert f"{out} was there and is replaced" in capsys.readouterr().err


def command(*words: str, **more: object) -> subprocess.Popen[bytes]:
    """The command in a process of its own."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    pipe = subprocess.PIPE
    return subprocess.Popen(
        [sys.executable, "-m", "icsolve", "sweep", *words],
        env=environment,
        stderr=pipe,
        **{"stdout": pipe, **more},  # type: ignore[call-overload]
    )


def _small_files() -> None:
    """As a full disk: no file may grow beyond so many bytes."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))


@sampled(3)
@pytest.mark.parametrize("ending", ["csv", "jsonl", "npz"])
def test_a_disk_that_is_full_leaves_no_file_and_keeps_the_old_one(
    press: Path, tmp_path: Path, ending: str
) -> None:
    """3601 rows do not fit into 20 kB."""
    out = tmp_path / f"turn.{ending}"
    for old in (None, b"what was there"):
        if old is not None:
            out.write_bytes(old)
        process = command(
            str(press), "--vary", "angles.AB=0:360:0.1", "-o", str(out), preexec_fn=_small_files
        )
        _, said = process.communicate(timeout=60)
        assert process.returncode == 2
        assert b"can't be written" in said
        assert (out.read_bytes() if out.exists() else None) == old
        assert {path.name for path in tmp_path.iterdir()} <= {press.name, out.name}


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full here")
def test_a_full_device_on_standard_output_is_said(press: Path) -> None:
    with open("/dev/full", "wb") as full:
        process = command(str(press), *TURN, stdout=full)
        _, said = process.communicate(timeout=60)
    assert process.returncode == 2
    assert b"No space left" in said


def test_a_reader_that_goes_away_ends_it_without_a_word(press: Path) -> None:
    with command(str(press), "--vary", "angles.AB=0:3600:0.1") as process:
        assert process.stdout is not None
        assert process.stderr is not None
        assert process.stdout.readline() == b"angles.AB,T12,status\n"
        process.stdout.close()
        assert process.stderr.read() == b""
        assert process.wait(timeout=60) == 141


MIXED = """
icsolve: 1
points: {A: [0, 0], B: [0.3, 0.4], C: [2, 0.5], O: [-1, 0], E: [-3, 1], L: [1, -2]}
joints:
  - {pin: [1, 2], at: A, mu: 0.2, radius: 0.05}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0, mu: 0.1, length: 0.4}
  - {pin: [1, 5], at: O}
  - {gears: [2, 5], teeth: [20, 31], pressure angle: 20}
  - {rope: [L, O, E], on: [1, 5], radii: {O: 0.3}, wraps: {O: ccw}, mu: {O: 0.3}}
loads:
  T: {torque: unknown, link: 2}
  P: {pressure: 8, bore: 0.05, link: 4, at: C, angle: 180}
  S: {spring: 40, free: 0.3, link: 3, at: B, to: L}
  F: {force: 3, at: E}
"""


def test_what_no_case_may_have_no_row_has() -> None:
    """A number that the reader refuses in its place, a sweep refuses among its values, in the same words."""
    case = icsolve.load(MIXED)
    told = 0
    for path, number in numbers_of(case).items():
        for value in (-number.value, 0.0, 90.0, number.value + 0.5):
            try:
                icsolve.load(MIXED, {path: value})
            except icsolve.CaseError as refusal:
                said = str(refusal).partition(" should ")[2]
            else:
                continue
            if said:
                told += 1
                with pytest.raises(ValueError, match=re.escape(f" should {said}")):
                    icsolve.sweep(case, {path: [number.value, value]})
    assert told >= 20


@pytest.mark.parametrize("word", ["dead", "max", "F=50", "rest", "neutral", "hold"])
@pytest.mark.parametrize("path", ["joints.2-3.teeth.1", "joints.A-O-B.turns.O"])
def test_no_position_is_found_at_a_part_of_a_tooth_or_of_a_turn(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, word: str, path: str
) -> None:
    """No case may have there what lies between whole numbers; a row of each has its answer."""
    pull = "98" if word in ("rest", "neutral", "hold") else "unknown"
    text = f"""icsolve: 1
points: {{A: [-1, 0.3], O: [0, 0], B: [1, 0.3], D: [3, 0]}}
joints:
  - {{rope: [A, O, B], on: [4, 1], radii: {{O: 0.3}}, wraps: {{O: ccw}}, turns: {{O: 1}}, mu: {{O: 0.1}}}}
  - {{slide: [4, 1], at: A, along: 0}}
  - {{slot: [4, 2], at: A, along: 90}}
  - {{pin: [2, 1], at: O}}
  - {{pin: [3, 1], at: D}}
  - {{gears: [2, 3], teeth: [20, 40]}}
loads: {{W: {{torque: 30, link: 3}}, F: {{force: {pull}, at: B}}}}
"""
    file = tmp_path / "train.yaml"
    file.write_text(text)
    run = Shell(capsys)("sweep", file, "--vary", f"{path}=1:60:1", "--find", word)
    assert run.code == 2 and "is whole" in run.err
