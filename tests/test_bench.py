"""The benchmark measures what it says: rivals that solve, closed forms that agree, laws on a sample."""

from __future__ import annotations

import math
import shutil
import sys
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from random import Random
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from click.testing import CliRunner
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import icsolve
from icsolve.bench import report
from icsolve.bench.accuracy import (
    FORWARD_FAMILIES,
    Law,
    Score,
    bits_kept,
    bound_over_error,
    forward_error,
    held,
    scenes,
    scored,
)
from icsolve.bench.families import BOUNDED, BUTTERFLY, FAMILIES, Draw, Family, all_joints, by_sides, linkage
from icsolve.bench.full_turn import (
    FOUR_BAR,
    MECHANISMS,
    PEERS,
    TORQUE,
    CrankTurning,
    Peer,
    compiled,
    componentwise,
    four_bar,
    in_c,
    ran,
    written_out,
)
from icsolve.bench.gates import Effort, Gate, cpu_seconds, gate_table, least, nothing, ratio
from icsolve.bench.promises import SEED, STARTS, butterflies, gears, newton_in_c, scissors
from icsolve.bench.report import figure, picture
from icsolve.bench.rivals import METHODS, Method
from icsolve.bench.speed import BOUNDED as BOUNDED_SWEEP
from icsolve.bench.speed import BY_HAND, IN_C, SWEPT
from icsolve.case import Gears
from icsolve.cli.commands import icsolve as command
from icsolve.files import started
from sizes import few, sampled
from texts import PAGES

BY_NAME = {family.name: family for family in FAMILIES}


# --- the rivals are no straw men -------------------------------------------------------------------


@sampled(3, "method", "name")
@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.name)
@pytest.mark.parametrize(
    "name", ["four-bar", "Watt", "Stephenson", "from lengths", "chain of 12", "parallel"]
)
def test_every_method_solves_what_it_is_made_for(method: Method, name: str) -> None:
    """Far from dead centres and the origin all agree with sixty digits to eight digits or more."""
    score = scored(method, BY_NAME[name], list(scenes(BY_NAME[name], 6)))
    assert score.failed == score.refused == 0
    assert score.micros > 0 or (method.name == "Newton and SVD" and name != "from lengths")
    assert not score.error > 1e-8


@pytest.mark.parametrize("method", [m for m in METHODS if m.name != "Newton and SVD"], ids=lambda m: m.name)
def test_all_kinds_of_joints_are_solved_by_every_method(method: Method) -> None:
    """But now and then by slopes, where two centres lie on one upright line."""
    score = scored(method, BY_NAME["all joints"], list(scenes(BY_NAME["all joints"], 12)))
    assert score.failed <= (2 if method.name == "slope and intercept" else 0)
    assert not score.error > 1e-8


def test_kennedy_alone_stalls_at_the_double_butterfly_and_icsolve_does_not() -> None:
    family = BY_NAME["double butterfly"]
    known = list(scenes(family, 3))
    by_name = {method.name: scored(method, family, known) for method in METHODS}
    assert by_name["homogeneous, normalised"].failed == 3
    assert by_name["icsolve"].failed == 0
    assert by_name["icsolve"].per_unit < 4


def test_what_is_close_to_singular_is_answered_by_its_decimals_and_not_failed() -> None:
    family = BY_NAME["toggle 1e-15"]
    score = scored(METHODS[1], family, list(scenes(family, 5)))
    assert (score.refused, score.failed) == (0, 0)
    assert score.scenes > 0
    assert score.error <= 2.0**-53


# --- closed forms ----------------------------------------------------------------------------------


@pytest.mark.parametrize("mechanism", MECHANISMS, ids=lambda m: m.name)
def test_the_closed_form_by_hand_is_what_solve_gives(mechanism: CrankTurning) -> None:
    for degrees in (60.0, 61.5, 75.0):
        case = icsolve.load(mechanism.case.replace("AB: 60", f"AB: {degrees}"))
        by_hand = mechanism.by_hand(np.array([math.radians(degrees)]))[0]
        assert icsolve.solve(case).answers["T2"].value == pytest.approx(by_hand, rel=1e-12)


@sampled(3)
@pytest.mark.skipif(not (shutil.which("cc") or shutil.which("gcc")), reason="no C compiler")
@pytest.mark.parametrize("mechanism", MECHANISMS, ids=lambda m: m.name)
def test_the_closed_form_in_c_is_that_by_hand(mechanism: CrankTurning, tmp_path: Path) -> None:
    library = compiled(str(tmp_path))
    assert library is not None
    angle, out = np.linspace(0.0, 6.0, 100), np.empty(100)
    in_c(library, mechanism.function, mechanism.data, angle, out)()
    assert out == pytest.approx(mechanism.by_hand(angle), rel=1e-13)


@pytest.mark.skipif(not (shutil.which("cc") or shutil.which("gcc")), reason="no C compiler")
def test_newtons_method_in_c_finds_the_rows_of_the_sweep(tmp_path: Path) -> None:
    """Each row of the double butterfly from the one before it, wherever the first one lies."""
    library, case = compiled(str(tmp_path)), icsolve.load(by_sides(linkage(BUTTERFLY), (1, 4))(Random(SEED)))
    assert library is not None
    angle = case.angles[0].value
    degrees, out = angle.value + np.linspace(-6.0, 6.0, 40), np.empty(40)
    newton_in_c(library, case, degrees, out)()
    assert out == pytest.approx(icsolve.sweep(case, {angle.path: degrees}).answers["U"], rel=1e-10)


@pytest.mark.parametrize(
    "draw", [gears(5), scissors(3), butterflies(2)], ids=["gears", "scissors", "butterflies"]
)
def test_what_grows_has_answers(draw: Draw) -> None:
    text = draw(Random(1))
    assert icsolve.solve(icsolve.load(text)).answers.keys() <= {"U", "F"}


def test_the_bare_kernels_are_the_same_scene() -> None:
    a, b, c, d, torque = FOUR_BAR
    one, two = componentwise(d, a, b, c, 60.0, torque), written_out(d, a, b, c, 60.0, torque)
    assert one[1] == pytest.approx(two[1], rel=1e-14)
    assert one[1] == pytest.approx(icsolve.solve(icsolve.load(MECHANISMS[0].case)).answers["T2"].value)
    assert one[0][0] / one[0][2] == pytest.approx(two[0][0] / two[0][2], rel=1e-14)


# --- other programs --------------------------------------------------------------------------------


@sampled(2)
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("peer", PEERS, ids=lambda peer: peer.package)
def test_another_program_is_used_as_it_should_be(peer: Peer) -> None:
    """Where it is installed: its full turn is right, so its time is that of a right answer."""
    if find_spec(peer.package) is None:
        pytest.skip(f"{peer.package} is not installed")
    with started([(ran, (peer, 1))]) as results:  # what it imports is not kept
        (found,) = results()
    assert found.why == ""
    assert found.error < 1e-9
    assert found.seconds > 0


def test_another_programs_fault_and_its_error_are_told() -> None:
    right = Peer("numpy", TORQUE, lambda angle: lambda: four_bar(angle))
    wrong = Peer("numpy", TORQUE, lambda angle: lambda: -four_bar(angle))
    broken = Peer("numpy", TORQUE, lambda angle: lambda: np.zeros(3)[5])
    assert ran(right, 1).error == 0.0
    assert ran(wrong, 1).error == pytest.approx(2.0)
    assert ran(broken, 1).why.startswith("IndexError")
    assert ran(right._replace(package="no-such-program"), 1).why == "not installed"


# --- laws ------------------------------------------------------------------------------------------


def check(laws: list[Law], median: float) -> None:
    """No scene breaks the law, and there are scenes; a median is of ten scenes or more."""
    for law in laws:
        assert law.scenes > 0, law
        assert law.broken == 0, law
        assert law.median <= median or law.scenes < 10, law


def test_the_forward_error_on_random_six_bars() -> None:
    """At most 4 (kappa + 1) u against the doubles as read; `icsolve bench --full` holds it on 10,000."""
    check(held(forward_error, FORWARD_FAMILIES, 20), 1.0)


@pytest.mark.parametrize("seed", [3091, 7224, 8452])
def test_small_wheels_far_from_the_input_lose_nothing(seed: int) -> None:
    """Scenes of `--full` that a pitch point rounded in the frame had cost up to 7.5 (kappa + 1) u."""
    case = icsolve.load(all_joints(Random(f"all joints {seed}")))
    assert any(isinstance(joint, Gears) for joint in case.joints)
    assert forward_error(case) < 1.0


def test_the_forward_error_on_every_family() -> None:
    """At most 4 (kappa + 1) u on each family of the tables, and no answer is wrong."""
    for family in FAMILIES:
        known = list(scenes(family, max(1, few(10) // family.weight)))
        for method in METHODS[:2]:
            score = scored(method, family, known)
            assert score.failed == 0, score
            assert not score.per_unit > 4, score
            assert score.refused < score.scenes or family.name == "toggle 1e-15", score


def test_powers_of_two_change_no_bit() -> None:
    """Lengths times 2^-37 and loads times 2^11, on scenes of all joint kinds and from lengths; `--full` holds
    more."""
    found = held(bits_kept, BOUNDED, 60)
    assert [law.broken for law in found] == [0] * len(found)
    assert all(law.scenes for law in found)


def test_a_changed_bit_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Three tenths are no power of two."""
    from icsolve.bench import accuracy as laws

    monkeypatch.setattr(laws, "SCALES", (math.log2(0.3), 0))
    assert sum(law.broken for law in laws.held(laws.bits_kept, FORWARD_FAMILIES[:1], 20)) > 0


def test_the_bound_on_scenes_of_all_joint_kinds() -> None:
    """Never broken against the decimals, and in the median at most 100 times the error; 100,000 in full."""
    check(held(bound_over_error, BOUNDED, 60), 100.0)


def test_a_broken_law_is_counted() -> None:
    found = held(lambda case: -5.0, [Family("any", linkage("01 12 23 03"))], 3)
    assert found == [Law("any", 3, 3, 5.0, 5.0)]


def test_families_are_drawn_the_same_again_and_have_answers() -> None:
    for family in (*FAMILIES, *BOUNDED):
        assert family.draw(Random("seed")) == family.draw(Random("seed"))
    texts = "".join(all_joints(Random(k)) for k in range(60))
    for kind in ("slot", "contact", "slide", "gears", "belt", "roll", "centre"):
        assert f"{kind}:" in texts


# --- what is printed -------------------------------------------------------------------------------


def marks(words: str, of: Figure) -> list[Any]:
    """The curves and marks of the diagram whose names have these words."""
    return [line for panel in of.findobj(Axes) for line in panel.lines if words in str(line.get_gid())]


SVG = "{http://www.w3.org/2000/svg}"
EASY, HARD = ("easy", 1e-16, 0.5, 40.0, 0, 0, 9), ("hard", 1e-9, 0.5, 50.0, 0, 0, 9)


def test_the_picture_draws_every_method_its_failures_and_its_refusals() -> None:
    scores = [
        Score("icsolve", *EASY),
        Score("icsolve", *HARD),
        Score("icsolve", "hardest", math.nan, math.nan, 60.0, 0, 9, 9),
        Score("bad", "easy", 1e-14, 10.0, 400.0, 0, 0, 9),
        Score("bad", "hard", math.nan, math.nan, 500.0, 9, 0, 9),
    ]
    sheet = figure(scores, [], [])
    for method in ("icsolve", "bad"):
        assert len(marks(f"{method}, easy: error", sheet)) == 2
    failed = marks("bad, hard: error nan, 500 µs; 9 of 9 without an answer", sheet)
    assert [mark.get_marker() for mark in failed] == ["x", "x"]
    refused = marks("icsolve, hardest: error nan, 60 µs; 9 of 9 refused", sheet)
    assert [mark.get_markerfacecolor() for mark in refused] == ["none", "none"]
    assert [list(curve.get_xdata()) for curve in marks("icsolve, easy", sheet)] == [[1e-16, 1e-9], [0.5, 0.5]]


def test_the_picture_names_the_programs_of_a_full_turn_and_those_that_did_not_run() -> None:
    turns = [Score("icsolve sweep", *EASY), Score("kinepy", "easy", 1e-15, math.nan, 9e3, 0, 0, 9)]
    text = picture([Score("icsolve", *EASY)], turns, ["sympy: not installed"])
    words = [e.text for e in ElementTree.fromstring(text).iter(f"{SVG}text")]
    assert {"icsolve sweep", "kinepy", "easy", "Not in the full turn: sympy: not installed."} <= set(words)


def test_the_picture_in_the_readme_shows_every_method() -> None:
    """As `icsolve bench` writes it now: the same methods and families, and programs that gave a torque."""
    root = Path(__file__).parent.parent
    place = ".pictures/work-precision.svg"
    assert f"](../../{place})" in PAGES["accuracy"]
    words = {e.text or "" for e in ElementTree.parse(root / place).iter(f"{SVG}text")}
    assert {*(method.name for method in METHODS), SWEPT, BOUNDED_SWEEP, BY_HAND, IN_C, "kinepy"} <= words
    assert any(line.startswith(f"{len(FAMILIES)} families of up to") for line in words)


def test_a_figure_is_held_to_its_limit_from_the_right_side() -> None:
    gates = [ratio("fast", 2.5, 3), ratio("slow", 3.5, 3), ratio("far", 90, 100, floor=True)]
    assert [gate.held for gate in (*gates, Gate("error", 0, 0))] == [True, False, False, True]
    assert not Gate("never measured", math.nan, 3).held
    assert "| slow | 3.5 x | at most 3 x | NO |" in gate_table(gates)


def test_a_promise_that_is_not_kept_is_no_success(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for gate, code in ((ratio("slow", 3.5, 3), 1), (ratio("fast", 2.5, 3), 0)):
        kept = nothing()._replace(gates=[gate], scenes=[])
        monkeypatch.setattr("icsolve.bench.report.run", lambda full, say, kept=kept: kept)
        monkeypatch.setattr("icsolve.bench.report.picture", lambda *what: "<svg/>")
        ran = CliRunner().invoke(command, ["bench", "-o", str(tmp_path / "plot.svg")], standalone_mode=False)
        assert ran.return_value == code
        assert ("not kept: slow" in ran.stderr) == bool(code)


def test_least_gives_seconds_a_call() -> None:
    short, long = least([lambda: sum(range(10)), lambda: sum(range(10_000))], 0.1)
    assert 0 < 20 * short < long < 1


def test_the_whole_benchmark_in_small(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(report, "USUAL", Effort(2, 4, 4, 4, 10, 0.02, 1))
    monkeypatch.setattr(report, "FAMILIES", FAMILIES[:4])
    monkeypatch.setattr("icsolve.bench.speed.MILLION", 10_000)
    monkeypatch.setattr("icsolve.bench.promises.STARTS", STARTS[::7])
    monkeypatch.setattr("icsolve.bench.speed.PEERS", PEERS[:1])  # each is used in a test of its own
    monkeypatch.setattr("icsolve.bench.speed.SAMPLE", 4)  # positions of sixty digits
    once = cache(lambda *command: cpu_seconds([*command]))  # of each process one run
    monkeypatch.setattr("icsolve.bench.promises.cpu_seconds", lambda command: once(*command))

    def printed() -> tuple[int, str]:
        ran = CliRunner().invoke(command, ["bench", "-o", str(tmp_path / "plot.svg")], standalone_mode=False)
        return ran.return_value, ran.stdout

    with started([(printed, ())]) as results:  # what it measures is not kept
        ((code, text),) = results()
    assert code == int("| NO |" in text)
    for heading in ("One scene", "A full turn", "Grading", "Rows", "Time", "Laws", "Figures"):
        assert f"\n## {heading}" in text
    assert "| Watt |" in text
    assert "| bounds that are less than the error, of " in text
    assert ElementTree.parse(tmp_path / "plot.svg").getroot().tag.endswith("svg")


def test_the_stress_catalogue_is_printed_with_its_verdicts(monkeypatch: pytest.MonkeyPatch) -> None:
    from icsolve.bench import catalogue
    from icsolve.bench.stress import answered

    few = [entry for entry in catalogue.CATALOGUE if entry.number in ("1", "5")]
    monkeypatch.setattr(catalogue, "CATALOGUE", few)
    ran = CliRunner().invoke(command, ["bench", "--stress"], standalone_mode=False)
    assert (ran.return_value, "every verdict is the one asked" in ran.stderr) == (0, True)
    assert "| 5 | coupler and rocker in line, unknown on the crank | dead-centre" in ran.stdout
    monkeypatch.setattr(catalogue, "CATALOGUE", [few[0]._replace(asked=answered({"M1": 1.0}))])
    ran = CliRunner().invoke(command, ["bench", "--stress"], standalone_mode=False)
    assert ran.return_value == 1
    assert "WRONG (M1 = -0.538" in ran.stdout


def test_a_broken_law_is_told_and_fails_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And so does a time that is not kept; what is kept is a success."""
    kept = nothing()
    monkeypatch.setattr(report, "run", lambda full, say: kept)
    monkeypatch.setattr("icsolve.bench.report.picture", lambda *what: "<svg/>")  # drawn in tests of its own
    arguments = ["bench", "-o", str(tmp_path / "plot.svg")]
    kept.gates.append(ratio("a fast machine", 2, 3))
    assert CliRunner().invoke(command, arguments, standalone_mode=False).return_value == 0
    kept.gates[:] = [ratio("a slow machine", 9, 3)]
    ran = CliRunner().invoke(command, arguments, standalone_mode=False)
    assert (ran.return_value, "not kept: a slow machine" in ran.stderr) == (1, True)
    kept.gates.clear()
    kept.gates.append(Gate("bounds that are less than the error", 1, 0))
    ran = CliRunner().invoke(command, arguments, standalone_mode=False)
    assert ran.return_value == 1
    assert "not kept: bounds that are less than the error" in ran.stderr


@pytest.mark.parametrize("missing", ["mpmath", "matplotlib"])
def test_without_its_tools_it_says_what_to_install(missing: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, missing, None)
    ran = CliRunner().invoke(command, ["bench"], standalone_mode=False)
    assert ran.return_value == 2
    assert "icsolve[bench]" in ran.stderr


def test_a_law_in_two_processes_is_that_in_one() -> None:
    """Scenes are shared out by their seeds, so that the same ones are met."""
    assert held(forward_error, FORWARD_FAMILIES[:2], 20, jobs=2) == held(
        forward_error, FORWARD_FAMILIES[:2], 20
    )


def test_where_no_picture_can_be_written_nothing_is_measured(tmp_path: Path) -> None:
    target = tmp_path / "no folder" / "plot.svg"
    ran = CliRunner().invoke(command, ["bench", "-o", str(target)], standalone_mode=False)
    assert ran.return_value == 2
    assert "can't be written" in ran.stderr
    assert ran.stdout == ""
