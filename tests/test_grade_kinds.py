"""Questions for positions of equilibrium, forces of unknown direction, and the mistakes of springs and
pressures; truths from closed forms."""

from __future__ import annotations

import csv
import importlib
import io
import math
from itertools import product
from pathlib import Path

import pytest

import icsolve
from grade_shell import CASES, Class
from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Course
from icsolve.grade.judge import judge_answer
from icsolve.grade.one import Task
from icsolve.grade.platforms.export import ExportOrder, questions
from icsolve.grade.platforms.questions import rights
from icsolve.grade.written.answer import Reader
from icsolve.wording.statement import Statement
from sizes import FULL, sampled

pytestmark = pytest.mark.usefixtures("wide_ranges")
BAR = """\
icsolve: 1
points: {A: [0, 0]}
lengths: {AB: 2}
angles: {AB: {unknown: [-110, 80]}}
joints: [{pin: [1, 2], at: A}]
loads:
  S: {spring: 0.2, corner: AB, free: 90, link: 2}
  W: {weight: 8, link: 2, at: B}
"""
"""W l cos t = k (pi/2 - t): the bar hangs almost, with the stiffness per degree it stands out."""
ARM = """\
icsolve: 1
points: {A: [0, 0]}
lengths: {AB: 1, BC: 1}
angles: {AB: 0, ABC: 90}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}]
loads:
  W2: {weight: 10, link: 2, at: B}
  M: {torque: 4, link: 2}
  Q: {force: 3, link: 3, at: C, angle: 180}
  P: {force: [unknown, unknown], link: 3, at: C}
"""
"""C = (1, -1): about B px = 3; about A 3 - 3 + py - 10 + 4 = 0, py = 6."""
HINGED = """\
icsolve: 1
points: {A: [0, 0], G: {centroid: [A, B]}, H: {centroid: [B, C]}}
lengths: {AB: 1, BC: 1}
angles: {AB: {unknown: [-180, 180]}, BC: {unknown: [-180, 180]}}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}]
loads:
  W2: {weight: 40, link: 2, at: G}
  W3: {weight: 40, link: 3, at: H}
  P: {force: 20, link: 3, at: C, angle: 0}
"""
LOADED = """\
icsolve: 1
points: {{A: [0, 0], E: [2, -6]}}
lengths: {{AB: 2}}
angles: {{AB: 0}}
joints: [{{pin: [1, 2], at: A}}]
loads:
  L: {load}
  M: {{torque: 3, link: 2}}
  T: {{torque: unknown, link: 2}}
"""


@pytest.fixture
def a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    return Class(tmp_path, capsys)


def rest(stiffness: float, weight: float = 8.0) -> float:
    """Degrees at which the weight and the torsion spring balance, by bisection."""
    low, high = math.radians(-110.0), math.radians(80.0)
    for _ in range(60):
        middle = 0.5 * (low + high)
        falls = 2.0 * weight * math.cos(middle) > stiffness * (0.5 * math.pi - middle)
        low, high = (low, middle) if falls else (middle, high)
    return math.degrees(low)


def test_a_torque_to_the_right_may_turn_to_the_right(a_class: Class) -> None:
    """`rechts` is short for clockwise; up and down, or at an angle, no torque is."""
    a_class.case("four", (CASES / "ch13" / "13_08_four_bar.yaml").read_text())
    sideways = ("29.67 rechts", "29.67 (rechts)", "29.67 N m, links", "29.67 to the left", "29.67 right")
    given = (*sideways, "29.67 up", "29.67 at 0 deg", "29.67 rechtsdrehend", "29.67 linksdrehend")
    judged = ["review"] * len(sideways) + ["wrong", "wrong"]
    found = a_class.verdicts(*given, case="four")
    assert found[: len(judged)] == judged and sorted(found[len(judged) :]) == ["right", "wrong"]


TWO = CASES / "equilibrium" / "two_springs_on_a_crank.yaml"


def test_any_position_of_equilibrium_is_right_and_whole_turns_do_not_count(a_class: Class) -> None:
    """Published: 50.0394 degrees; the other is unstable, at 233.1255."""
    a_class.case("crank", TWO.read_text())
    right = ("50.04", "50.04 deg", "0.8734 rad", "410.04", "233.1", "-126.9", "at 50.04 deg", "50.04° ccw")
    assert set(a_class.verdicts(*right, case="crank")) == {"right"}
    given = ("-50.04", "309.96", "39.96", "130", "70", "50.04° above the horizontal")
    assert [(row["verdict"], row["code"]) for row in a_class.judge(*given, case="crank")] == [
        ("wrong", "sign"), ("wrong", "sign"), ("wrong", "sin-cos"), ("wrong", "angle-sense"), ("wrong", ""),
        ("review", "ambiguous-direction"),
    ]  # fmt: skip
    named = a_class.judge("50.04", case="crank:angles.AB") + a_class.judge("50.04", case="crank:angles.A-B")
    assert {(row["case"], row["verdict"]) for row in named} == {("crank", "right")}


def test_several_positions_are_right_where_each_is_and_never_one_with_a_direction(a_class: Class) -> None:
    """An angle has no direction at an angle: two angles are two values."""
    a_class.case("crank", TWO.read_text())
    right = ("50.04 deg, 233.1 deg", "50,04°; 233,1°", "50.04 and 233.1 deg", "50.04 deg or -126.9 deg")
    assert set(a_class.verdicts(*right, case="crank")) == {"right"}
    open_ = ("50.04 deg, 130 deg", "50.04° and 70°", "50.04 deg at 30 deg", "50.04, unstable, 233.1")
    assert set(a_class.verdicts(*open_, case="crank")) == {"review"}


def test_a_list_of_positions_is_read_as_a_list_where_the_last_has_the_unit(a_class: Class) -> None:
    """The second of two angles is no direction of the first."""
    a_class.case("two", TWO.read_text())
    a_class.case("bar", BAR)
    both, one = {}, []
    for join, unit in product((", ", "; ", " ", " and ", " & "), (" deg", "°")):
        both |= {
            f"50.04{join}233.1{unit}": "right", f"50.04{unit}{join}233.1{unit}": "right",
            f"50.04{join}200{unit}": "review", f"200{join}50.04{unit}": "review",
        }  # fmt: skip
        one.append(f"{rest(0.2 * 180.0 / math.pi):.4g}{join}20{unit}")
    assert dict(zip(both, a_class.verdicts(*both, case="two"), strict=True)) == both
    assert set(a_class.verdicts(*one, case="bar")) == {"review"}


def test_a_value_that_several_positions_share_is_accepted_once(a_class: Class) -> None:
    """Of two hinged bars each rests along the pull at it or against it, however the other does."""
    a_class.case("bars", HINGED)
    first, second = (math.degrees(math.atan2(-w, 20.0)) for w in (60.0, 20.0))
    for path, rest_at in (("AB", first), ("BC", second)):
        either = f"{rest_at:.5g} deg, {rest_at + 180.0:.5g} deg"
        rows = a_class.judge(f"{rest_at:.5g}", either, case=f"bars:angles.{path}")
        assert [row["verdict"] for row in rows] == ["right", "right"]
        assert rows[0]["feedback"].count(" to ") == 2


def test_mistakes_with_a_position_are_named(a_class: Class) -> None:
    a_class.case("bar", BAR)
    assert a_class.verdicts(f"{rest(0.2):.5g}", case="bar") == ["right"]
    (row,) = a_class.judge(f"{rest(0.2 * math.degrees(1.0)):.5g}", case="bar")
    assert (row["verdict"], row["code"]) == ("wrong", "deg-rad")


def test_a_case_with_nothing_unknown_costs_no_search_for_its_mistakes(
    a_class: Class, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Right positions cost one search; wrong ones one for each thing that can be misread, however many."""
    solves: list[str] = []
    room = importlib.import_module("icsolve.solve")
    plain = room.solve

    def counted(case: icsolve.Case, **asked: bool) -> icsolve.Answer:
        solves.append(case.name)
        return plain(case, **asked)

    monkeypatch.setattr(room, "solve", counted)
    a_class.case("crank", TWO.read_text())
    a_class.judge("50.04", "50", "233.1", case="crank")
    assert len(solves) == 1
    solves.clear()
    a_class.judge("10", "20", "30", case="crank")
    dropped_reversed_and_free = 3 * 2 + 2  # of three loads, two of them springs
    assert len(solves) <= 3 + dropped_reversed_and_free


def test_a_force_of_unknown_direction_is_its_size_and_an_angle(a_class: Class) -> None:
    a_class.case("arm", ARM)
    size, angle = math.hypot(3.0, 6.0), math.degrees(math.atan2(6.0, 3.0))
    answers = {
        f"{size:.4g} N at {angle:.4g} deg": "right", f"{size:.4g} N, {angle:.3g}°": "right",
        f"{size:.4g} N at {angle + 3.0:.4g} deg": "wrong", f"{size:.4g} N": "wrong",
        f"{size:.4g} N at {angle + 180.0:.4g} deg": "wrong", f"{2 * size:.4g} N at {angle:.4g} deg": "wrong",
    }  # fmt: skip
    rows = a_class.judge(*answers, case="arm")
    assert [row["verdict"] for row in rows] == list(answers.values())
    assert [row["code"] for row in rows[2:]] == ["direction", "no-direction", "sign", "double"]
    assert "the angle of its direction is wrong" in rows[2]["feedback"]
    assert "say its direction as well, as an angle" in rows[3]["feedback"]


@pytest.mark.parametrize(
    "form", ["{} N at {} deg", "{} N, {}°", "{} N ({}°)", "{} N bei {} Grad", "{} N @ {}°"]
)
def test_a_size_and_an_angle_with_decimal_commas_are_read_as_with_points(a_class: Class, form: str) -> None:
    a_class.case("arm", ARM)
    size, angle = math.hypot(3.0, 6.0), math.degrees(math.atan2(6.0, 3.0))
    for mark in (".", ","):
        near = form.format(f"{size:.2f}", f"{angle:.2f}").replace(".", mark)
        off = form.format(f"{size:.2f}", f"{angle + 3.0:.2f}").replace(".", mark)
        assert a_class.verdicts(near, off, case="arm") == ["right", "wrong"], near


@pytest.mark.parametrize("axis", ["-x", "the -x axis", "negative x", "+y", "the positive y axis", "-y"])
def test_an_angle_from_an_axis_that_goes_no_side_is_never_guessed(a_class: Class, axis: str) -> None:
    """Of +x it is counterclockwise everywhere; of the others it is taken either way, so right and wrong wait,
    unless the side is said. The force is at 63.43 degrees, 26.57 right of +y."""
    a_class.case("arm", ARM)
    rows = a_class.judge(f"6.708 N at 26.57 deg from {axis}", f"6.708 N at 300 deg from {axis}", case="arm")
    assert [(row["verdict"], row["code"]) for row in rows] == [("review", "ambiguous-direction")] * 2
    said = ("63.43 deg from +x", "26.57 deg right of +y", "26.57 deg cw from +y", "116.57 deg cw from -x")
    assert set(a_class.verdicts(*(f"6.708 N at {one}" for one in said), case="arm")) == {"right"}


LINE = "{distributed: 50, link: 2, from: A, to: B, angle: 90}"
TRIANGLE = "{distributed: [0, 50], link: 2, from: A, to: B, angle: 90}"
PISTON = "{pressure: 2 MPa, bore: 3, link: 2, at: B, angle: 90}"
AREA = math.pi / 4.0
WRONG = {
    "uniform, at A": (LINE, "line-load", 0.0),
    "uniform, at B": (LINE, "line-load", 200.0),
    "length left out": (LINE, "line-load", 50.0),
    "triangle, in the middle": (TRIANGLE, "line-load", 50.0),
    "triangle turned round": (TRIANGLE, "line-load", 50.0 * 2.0 / 3.0),
    "bore as radius": (PISTON, "area", 2e6 * 9 * AREA * 4 * 2),
    "without pi/4": (PISTON, "area", 2e6 * 9 * 2),
    "rod not left out": (PISTON.replace("3,", "3, rod: 1,"), "area", 2e6 * 9 * AREA * 2),
    "free length": ("{spring: 10, free: 1, link: 2, at: B, to: E}", "free-length", -120.0),
    "mass as weight": ("{mass: 5 kg, link: 2, at: B}", "mass", -10.0),
    "stiffness per degree": ("{spring: 7, corner: AB, free: 90, link: 2}", "deg-rad", 7 * 90.0),
}
"""A load, the code of a mistake, and the moment about A for which the load is taken then."""


@pytest.mark.parametrize("kind", WRONG)
def test_what_springs_pressures_and_line_loads_are_often_taken_for(a_class: Class, kind: str) -> None:
    load, code, moment = WRONG[kind]
    a_class.case("loaded", LOADED.format(load=load))
    (row,) = a_class.judge(f"{-(moment + 3.0):.6g}", case="loaded")
    assert row["verdict"] == "wrong"
    assert code in row["code"].split(), row


SLOPE = """\
icsolve: 1
variables: {W: {range: [100, 500], step: 10}}
points: {A: [0, 0]}
joints: [{slide: [2, 1], at: A, along: 30, mu: 0.2}]
loads:
  W: {weight: $W, link: 2, at: A}
  P: {force: unknown, link: 2, at: A, angle: 30}
"""
"""P from W (sin 30 - 0.2 cos 30) to W (sin 30 + 0.2 cos 30)."""


def test_variants_of_ranges_and_positions_have_keys_of_their_own(a_class: Class) -> None:
    """Each student's range grows with the weight; a position hangs on the ratio of weight and stiffness."""
    for name in ("lever", "pusher", "dead"):
        a_class.path(f"cases/{name}.yaml").unlink()
    a_class.case("slope", SLOPE)
    varied = BAR.replace("points:", "variables: {W: {range: [5, 10], step: 1}}\npoints:", 1)
    a_class.case("bar", varied.replace("weight: 8", "weight: $W"))
    roster = a_class.file("roster.csv", "student_id\na\nb\nc\n")
    cases, sheets = str(a_class.path("cases")), a_class.path("sheets")
    assert a_class.run("variants", cases, "--roster", roster, "-o", str(sheets), "--no-figures").code == 0
    table = "student_id,case,answer\n"
    for name in ("slope", "bar"):
        values = list(csv.DictReader(io.StringIO((sheets / name / "values.csv").read_text())))
        assert len({row["W"] for row in values}) > 1
        for row in values:
            weight, sine, friction = float(row["W"]), 0.5, 0.2 * math.cos(math.radians(30.0))
            low, high = weight * (sine - friction), weight * (sine + friction)
            right = f"{low:.5g} to {high:.5g}" if name == "slope" else f"{rest(0.2, weight):.6g}"
            table += f"{row['student_id']},{name},{right}\n"
    assert [row["verdict"] for row in a_class.grade(table).rows()] == ["right"] * 6
    assert (sheets / "slope" / "key.csv").read_text().count("\n") == 7


@pytest.mark.parametrize(
    ("text", "name", "told"),
    [
        (LOADED.format(load=LINE), "L", "force per length of 50 N/m on link 2 from A to B, at 90 deg"),
        (
            LOADED.format(load=TRIANGLE),
            "L",
            "force per length of 50 N/m on link 2 from B to A, 0 N/m there, at 90 deg",
        ),
        (BAR, "direction AB", "unknown, between -110 and 80 deg from +x"),
        (ARM, "P", "to be found in size and direction, on link 3 at C"),
    ],
)
def test_what_a_question_of_these_kinds_gives(text: str, name: str, told: str) -> None:
    assert dict(Statement(icsolve.load(text)).rows())[name] == told


STUCK = """\
icsolve: 1
points: {A: [0, 0]}
lengths: {AB: 1}
angles: {AB: {unknown: [-179, 179], from: 0}}
joints: [{pin: [1, 2], at: A, mu: 0.3, radius: 0.2}]
loads: {P: {force: 10, link: 2, at: B, angle: 0}, M: {torque: 0, link: 2}}
"""
STUCK_BY = 0.2 * math.sin(math.atan(0.3))
"""The radius of the friction circle, within which the line of P has to pass."""


@sampled(2)
@pytest.mark.parametrize("degrees", [70, 178, *([0, 350] * FULL)])
def test_ranges_of_rest_are_angles_too(a_class: Class, degrees: int) -> None:
    """Either range is right, in any turn and however it is named, and no other arc; so it is asked for."""
    text = STUCK.replace("{unknown: [-179, 179], from: 0}", "unknown")
    a_class.case("stuck", text.replace("angle: 0", f"angle: {degrees}"))
    off = math.degrees(math.asin(STUCK_BY))
    ends = [(degrees + side - off, degrees + side + off) for side in (0.0, 180.0)]
    turns = (-720.0, -360.0, 0.0, 360.0)
    right = [f"{a + turn:.6g} to {b + turn:.6g} deg" for a, b in ends for turn in turns]
    right += [f"{a % 360.0:.6g} to {b % 360.0:.6g}" for a, b in ends]  # perhaps on through 0
    right += [f"{b:.6g} deg to {a:.6g} deg" for a, b in ends]
    right += [f"{math.radians(a):.6g} to {math.radians(b):.6g} rad" for a, b in ends]
    wrong = [f"{a + turn:.6g} to {b:.6g} deg" for a, b in ends for turn in (-360.0, 720.0)]
    wrong += [f"{b:.6g} to {a + 360.0:.6g} deg" for a, b in ends]  # the arc between
    rows = a_class.judge(*right, *wrong, case="stuck")
    assert [row["verdict"] for row in rows] == ["right"] * len(right) + ["wrong"] * len(wrong)
    task = Task(a_class.path("cases/stuck.yaml"))
    assert task.asked() == (
        "Over which range of the angle AB in deg, counterclockwise positive, does the mechanism hold still? "
        "Give both ends."
    )


def test_of_ranges_that_mirror_one_another_each_is_right(a_class: Class) -> None:
    """A weight and a couple: W cos t - M within W times the friction radius, for t and for -t. The one is no
    wrong sense of the other, and right in another unit it lacks its unit alone."""
    text = STUCK.replace("angle: 0}", "angle: -90}").replace("torque: 0", "torque: 5")
    a_class.case("stuck", text)
    low, high = (math.degrees(math.acos((5.0 + side * 10.0 * STUCK_BY) / 10.0)) for side in (1.0, -1.0))
    given = {
        f"{low:.6g} to {high:.6g} deg": ("right", ""), f"{-high:.6g} to {-low:.6g} deg": ("right", ""),
        f"{low:.6g} to {high:.6g} rad": ("wrong", "unit"),
        f"{low:.6g} to {1.2 * high:.6g}": ("wrong", "one-end"),
        f"{low:.6g} to {high:.6g} deg; {-high:.6g} to {-low:.6g} deg": ("right", ""),
    }  # fmt: skip
    rows = a_class.judge(*given, case="stuck")
    assert [(row["verdict"], row["code"]) for row in rows] == list(given.values())


MACHINES = {
    "two parts not counted": ("ropes/tackle_four_parts", "rope-parts", 500.0),
    "exp(mu) alone": ("ropes/capstan", "wrap", 100 * math.exp(0.25)),
    "round the other side": ("ropes/capstan", "wrap", 100 * math.exp(0.25 * 1.5 * math.pi)),
    "whole turns left out": ("ropes/bollard", "wrap", 5000 * math.exp(-0.25 * math.pi)),
    "smooth post": ("ropes/capstan", "no-friction", 100.0),
    "slipping the other way": ("ropes/capstan", "friction-sense", 100 * math.exp(-0.125 * math.pi)),
    "smooth thread": ("tools/screw_jack", "no-friction", 10 * 5 / (2 * math.pi)),
    "lead a radian": ("tools/scissor_jack", "lead", 6 * 4),
    "no inertia of the drum": ("dynamics/hoist_starting", "no-inertia", 40 * 0.25 * (9.81 + 1.0)),
    "no acceleration": ("dynamics/hoist_starting", "no-acceleration", 40 * 0.25 * 9.81),
    "revolutions for radians": ("dynamics/scotch_yoke_piston", "rpm", 8.6602540378 * (math.pi / 30) ** 2),
}
"""A case, the code of a mistake, and what is found with it."""


@pytest.mark.parametrize("kind", MACHINES)
def test_what_ropes_screws_and_masses_are_often_taken_for(a_class: Class, kind: str) -> None:
    name, code, found = MACHINES[kind]
    a_class.case("machine", (CASES / f"{name}.yaml").read_text())
    (row,) = a_class.judge(f"{found:.7g}", case="machine")
    assert row["verdict"] == "wrong"
    assert code in row["code"].split(), row


LIFTED = """\
icsolve: 1
points: {{C: [0, 0], P: [0, 3], E: [{x}, {y}]}}
joints:
  - {{slide: [2, 1], at: C, along: 90}}
  - {{rope: [C, P, E], on: [2, 1]}}
loads:
  V: {{weight: 40, link: 2, at: C}}
  F: {{force: unknown, at: E}}
"""
"""A block on a rope over a pulley, whose free end is pulled with 40 N away from it."""


@pytest.mark.parametrize("degrees", [0.0, 30.0, 135.0, 200.0, 315.0])
def test_a_rope_is_pulled_the_way_it_runs(a_class: Class, degrees: float) -> None:
    """A pull is no push, and no pull the other way; square to it a person decides."""
    angle = math.radians(degrees)
    a_class.case("lifted", LIFTED.format(x=4.0 * math.cos(angle), y=3.0 + 4.0 * math.sin(angle)))
    with_it = ("40 N", "40 N, pull", f"40 N at {degrees} deg", "40 N away from P", "8.992 lbf in tension")
    against = ("-40 N", "40 N push", f"40 N at {degrees + 180.0} deg", "40 N toward P")
    square = f"40 N at {degrees + 90.0} deg"
    rows = a_class.judge(*with_it, *against, square, case="lifted")
    assert [row["verdict"] for row in rows] == ["right"] * 5 + ["wrong"] * 4 + ["review"]
    assert {row["code"] for row in rows[5:9]} == {"sign"}
    pulls = a_class.judge("40 N tension", "40 N (T)", "40 N compression", case="lifted:T C-P-E")
    assert [(row["verdict"], row["code"]) for row in pulls] == [("right", "")] * 2 + [("wrong", "sign")]


def test_the_pull_of_a_rope_is_a_question(a_class: Class) -> None:
    a_class.case("hoist", (CASES / "ropes" / "differential_hoist.yaml").read_text())
    rows = a_class.judge("500 N", "500", "1000 N", case="hoist:T O-P-N")
    assert [row["verdict"] for row in rows] == ["right", "right", "wrong"]


HELD = STUCK.replace("{unknown: [-179, 179], from: 0}", "30").replace("torque: 0", "torque: unknown")
LOCKS = """\
icsolve: 1
points: {A: [0, 0]}
joints: [{slide: [2, 1], at: A, along: 0, mu: 0.7}]
loads:
  N: {force: 100, link: 2, at: A, angle: -90}
  P: {force: unknown, link: 2, at: A, angle: -60}
"""
_TEXTS = {"size and direction": ARM, "ranges of rest": STUCK, "range": HELD, "open range": LOCKS}
_FILES = {
    "positions": ("equilibrium/two_springs_on_a_crank", ""), "place at infinity": ("sliders/wedge", "I23"),
    "place": ("sliders/quick_return", "I24"), "torque": ("ch13/13_08_four_bar", ""),
    "ratio": ("ch13/13_08_four_bar", "w4/w2"), "reaction": ("ch13/13_08_four_bar", "F34"),
    "pull of a rope": ("ropes/capstan", ""), "length": ("equilibrium/collar_on_level_rod", ""),
}  # fmt: skip


def case_of(a_class: Class, kind: str) -> str:
    """Puts the case of a kind into the folder; what is asked of it."""
    name, what = _FILES.get(kind, ("", ""))
    a_class.case("own", _TEXTS[kind] if kind in _TEXTS else (CASES / f"{name}.yaml").read_text())
    return what


@sampled(2)
@pytest.mark.parametrize("kind", [*_TEXTS, *_FILES])
def test_the_right_answer_as_a_program_is_told_it_is_right(a_class: Class, kind: str) -> None:
    """Of every kind of question; so PrairieLearn shows it, and a text that it takes for wrong is none."""
    what = case_of(a_class, kind)
    task = Task(a_class.path("cases/own.yaml"))
    judged = task.grade(what, task.right(what))
    assert judged["verdict"] == "right", (task.right(what), judged)


@sampled(2)
@pytest.mark.parametrize("kind", [*_TEXTS, *_FILES])
def test_the_right_answers_of_an_exported_question_are_right(a_class: Class, kind: str) -> None:
    """Each number that Moodle and Canvas hold as right, in the unit of the question, as a student would write
    it; what is no single number is not asked there."""
    case_of(a_class, kind)
    store = CaseStore(a_class.path("cases/own.yaml"), Course())
    key = store.solved("own").key("own")
    order = ExportOrder(store, "", False, False, 1)
    told: list[str] = []
    for question in questions(order, told.append):
        for own, right in rights(question):
            judged, _ = judge_answer(key, Reader(), f"{right:.12g} {own.unit_name}")
            assert judged.verdict == "right"
    assert bool(told) == (kind in _TEXTS)


FORMS = (
    "({x}, {y}) {u}",
    "({x} {u}, {y} {u})",
    "[{x}; {y}] {u}",
    "{x}i {y:+}j {u}",
    "{x} i {y:+} j",
    "{x} {u} i {y:+} {u} j",
    "{x}\u00ee {y:+}\u0135 {u}",
    r"${x}\mathbf{{i}} {y:+}\mathbf{{j}}$ {u}",
    "x = {x} {u}, y = {y} {u}",
    "{n}x = {x} {u} and {n}y = {y} {u}",
    "{n}y = {y} {u}; {n}x = {x} {u}",
    "Fx: {x} {u}, Fy: {y} {u}",
    "{n} = ({x}, {y}) {u}",
)
"""How people write the two components of a vector."""


@pytest.mark.parametrize("turned", [17.0, 118.0, 200.0, 304.0])
def test_a_vector_is_right_by_its_two_components_and_they_are_never_taken_for_size_and_angle(
    a_class: Class, turned: float
) -> None:
    """The load whose direction is unknown is the other one reversed, which A as well as B bears; the force of
    the frame on the pin holds both blocks."""
    a_class.case("arm", ARM.replace("angle: 180", f"angle: {turned}"))
    answer = icsolve.solve(icsolve.load(a_class.folder / "cases" / "arm.yaml"), reactions=True)
    found, pin = answer.answers["P"], answer.reactions["F12"]
    assert found.components is not None
    for question, name, (x, y) in (("arm", "P", found.components), ("arm:F12", "F12", (pin.x, pin.y))):
        size, direction = math.hypot(x, y), math.degrees(math.atan2(y, x)) % 360.0
        wanted = [
            (form.format(x=float(f"{a:.5g}"), y=float(f"{b:.5g}"), u="N", n=name), verdict)
            for form, (verdict, (a, b)) in product(
                FORMS, (("right", (x, y)), ("wrong", (-x, -y)), ("wrong", (y, x)), ("wrong", (x, -y)))
            )
        ]
        others = (f"({size:.5g}, {direction:.5g})", f"({x:.5g}, {y:.5g}, 0) N", f"Qx = {x:.5g}, Qy = {y:.5g}")
        wanted += [(text, "review") for text in others]
        texts = [text for text, _ in wanted]
        assert list(zip(texts, a_class.verdicts(*texts, case=question), strict=True)) == wanted


def test_pounds_of_a_mass_wait_for_a_person(a_class: Class) -> None:
    """They are a force here, and many write them for a mass: 1440 lbf at half the arm carry 720 lbm, as a
    mass or as what it weighs. What is no such mass is wrong, and so is its weight in newtons."""
    a_class.case(
        "lever",
        """icsolve: 1
units: {length: ft, force: lbf}
points: {A: [0, 0], B: [2, 0], C: [-1, 0]}
joints: [{pin: [1, 2], at: A}]
loads:
  M: {mass: unknown, link: 2, at: B}
  F: {force: 1440, link: 2, at: C, angle: 270}
""",
    )
    wanted = {
        **dict.fromkeys(("720 lb", "M = 720 pounds", "720 lbs"), "review"),
        **dict.fromkeys(("720 lbm", "326.6 kg", "22.38 slug"), "right"),
        **dict.fromkeys(("360 lb", "1440 pounds", "3203 N", "720 kg"), "wrong"),
    }
    assert dict(zip(wanted, a_class.verdicts(*wanted, case="lever"), strict=True)) == wanted
