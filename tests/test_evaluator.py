"""A case as a compiled function: each row is the scene's own answer, its gradient the scene's derivatives.

Rows run as Python where they are few and as numpy where they are many: both against `icsolve.solve` of the
case with the row's numbers, which is another program from the figure on.
"""

from __future__ import annotations

import pickle
import random
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import pytest

import icsolve
from icsolve.case import Case
from icsolve.errors import SceneError
from icsolve.numbers.adjoint import gradient
from icsolve.numbers.record import OPERATIONS, Op, Record, Traced
from icsolve.numbers.source import JAVASCRIPT, straight_line
from icsolve.scene.refusals import rubs
from icsolve.sweep.varied_numbers import numbers_of, with_numbers
from library import FILES, sample
from sizes import sampled

FOUR_BAR = """icsolve: 1
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


def solved(case: Case) -> tuple[str, dict[str, float]]:
    """Status and unknown loads of a scene."""
    try:
        answer = icsolve.solve(case)
    except SceneError as refusal:
        return refusal.status, {}
    return answer.status, {name: one.value for name, one in answer.answers.items() if one.value is not None}


def some_inputs(case: Case, draw: random.Random) -> tuple[str, ...]:
    """A few numbers of the figure and of the loads."""
    known = [p for p in numbers_of(case) if p.split(".")[0] in ("points", "lengths", "angles", "loads")]
    return tuple(draw.sample(known, min(4, len(known))))


@sampled(3)
@pytest.mark.parametrize("name", sample(FILES, 2, "evaluator"))
def test_rows_of_the_library_are_the_scenes_own(name: str) -> None:
    path = FILES[name]
    case, draw = icsolve.load(path), random.Random(path.stem)
    inputs = some_inputs(case, draw)
    if case.space is not None or case.unknowns or not inputs or solved(case)[0] != "ok":
        pytest.skip("nothing to vary, or no answer as written")
    written = [numbers_of(case)[p].value for p in inputs]
    rows = [[v + draw.uniform(-0.002, 0.002) * (abs(v) or 1.0) for v in written] for _ in range(3)]
    found = icsolve.evaluator(case, inputs)(*np.array([written, *rows]).T)
    for n, numbers in enumerate([written, *rows]):
        status, values = solved(with_numbers(case, dict(zip(inputs, numbers, strict=True))))
        assert found.status[n] == status
        for load, value in values.items():  # near a dead centre the digits of the row itself are fewer
            assert found.answers[load][n] == pytest.approx(value, rel=1e-7, abs=1e-9)


def planar_without_friction(names: Sequence[str]) -> Iterator[tuple[Case, list[str]]]:
    """Cases with answers as written, and their known loads; none with profiles, ropes or screws."""
    for case in map(icsolve.load, map(FILES.__getitem__, names)):
        loads = [p for p in numbers_of(case) if p.startswith("loads.") and p.count(".") == 1]
        apart = case.space is not None or case.unknowns or case.screws or case.ropes or case.touches
        if loads and not (apart or rubs(case)) and solved(case)[0] == "ok":
            yield case, loads


def test_in_the_figure_as_written_an_answer_is_linear_in_the_loads() -> None:
    """Also where links move by exact data alone (a rack and its pinion, a wedge): these stay as they are."""
    held = 0
    for case, loads in planar_without_friction(sample(FILES, 2, "gradients")):
        call = icsolve.evaluator(case, loads, gradient=True)
        written = np.array([numbers_of(case)[p].value for p in loads])
        here, there = call(*written), call(*(1.25 * written))
        for load, slopes in here.gradients.items():
            value, change = here.answers[load][0], there.answers[load][0] - here.answers[load][0]
            parts = [slopes[p][0] * w for p, w in zip(loads, written, strict=True)]
            size = 1e-9 * max(map(abs, parts))
            assert value == pytest.approx(solved(case)[1][load], rel=1e-9, abs=size), case
            assert change == pytest.approx(sum(parts) / 4.0, rel=1e-9, abs=size), (case, load)
            held += 1
    assert held > 20


def test_many_rows_are_those_that_few_are() -> None:
    call = icsolve.evaluator(
        icsolve.load(FOUR_BAR), ("angles.AB", "lengths.BC", "loads.P"), ("answers", "points")
    )
    angles, couplers = np.linspace(5.0, 355.0, 200), np.linspace(3.2, 3.8, 200)
    many = call(angles, couplers, 100.0)
    for n in range(0, 200, 7):
        one = call(float(angles[n]), float(couplers[n]), 100.0)
        assert one.answers["T12"][0] == pytest.approx(many.answers["T12"][n], rel=1e-12)
        assert one.points["C"][0] == pytest.approx(many.points["C"][n], rel=1e-13)


def test_the_gradient_is_the_scenes_sensitivity() -> None:
    case = icsolve.load(FOUR_BAR)
    inputs = ("angles.AB", "lengths.AB", "lengths.BC", "lengths.CD", "lengths.DE", "points.D.x", "loads.P")
    call = icsolve.evaluator(case, inputs, gradient=True)
    for angle in (20.0, 60.0, 133.0, 290.0):
        numbers = [angle, 1.0, 3.5, 2.5, 1.5, 4.0, 100.0]
        row = call.case_of(*numbers)
        slopes = icsolve.solve(row).sensitivities["T12"]
        for found in (call(*numbers), call(*np.tile(numbers, (40, 1)).T)):
            for path in inputs:
                assert found.gradients["T12"][path][-1] == pytest.approx(slopes[path], rel=1e-9)


@sampled(3, "rows", "angle")
@pytest.mark.parametrize("angle", [20.0, 60.0, 133.0, 290.0])
@pytest.mark.parametrize("rows", [1, 3, 25])
def test_where_an_answer_vanishes_its_gradient_is_that_of_both_sides(angle: float, rows: int) -> None:
    """A crank that a weight balances is what Newton's method looks for: its place is one as all others.

    A slope is linear in the weight, so it is the mean of those beside."""
    text = FOUR_BAR.replace("loads:", "loads:\n  W: {weight: 200, link: 2, at: B}")
    call = icsolve.evaluator(icsolve.load(text), ("angles.AB", "lengths.BC", "loads.W"), gradient=True)
    ends = call(angle, 3.5, np.array([0.0, 100.0])).answers["T12"]
    balance = float(100.0 * ends[0] / (ends[0] - ends[1]))
    beside = call(angle, 3.5, np.array([balance - 10.0, balance + 10.0])).gradients["T12"]
    there = call(*([angle, 3.5, balance] if rows == 1 else np.tile([angle, 3.5, balance], (rows, 1)).T))
    assert there.answers["T12"] == pytest.approx(np.zeros(rows), abs=1e-9)
    for path, slopes in there.gradients["T12"].items():
        assert slopes == pytest.approx(np.full(rows, beside[path].mean()), rel=1e-9), path
    weight = np.array([200.0])
    for _ in range(4):
        found = call(angle, 3.5, weight)
        weight = weight - found.answers["T12"] / found.gradients["T12"]["loads.W"]
    assert weight == pytest.approx([balance], rel=1e-12)


@pytest.mark.parametrize("gap", [1e-3, 1e-7, 1e-11, 1e-15])
def test_beside_a_dead_centre_a_row_has_the_gradient_of_the_closed_form(gap: float) -> None:
    """M2 is -1/2 over the gap between the coupler and the line of link 4, however narrow that is."""
    case = icsolve.load("""icsolve: 1
points: {A0: [0, 0], A: [1, 0], B: [2.5, 2], B0: [3, 4]}
joints:
  - {pin: [1, 2], at: A0}
  - {pin: [2, 3], at: A}
  - {pin: [3, 4], at: B}
  - {pin: [4, 1], at: B0}
loads: {M4: {torque: 1, link: 4}, M2: {torque: unknown, link: 2}}
""")
    call = icsolve.evaluator(case, ("points.B.x", "loads.M4"), gradient=True)
    x = 2.0 + gap
    found = call(x, 1.0)
    exact = icsolve.solve(call.case_of(x, 1.0))
    assert found.answers["M2"][0] == pytest.approx(exact.answers["M2"].value, rel=1e-9)
    for path, slopes in found.gradients["M2"].items():
        assert slopes[0] == pytest.approx(exact.sensitivities["M2"][path], rel=1e-6)
    assert found.gradients["M2"]["loads.M4"][0] == pytest.approx(-0.5 / gap, rel=1e-8)


def test_a_row_that_does_not_assemble_says_so_and_the_others_stand() -> None:
    found = icsolve.evaluator(icsolve.load(FOUR_BAR), ("lengths.BC",))(np.array([3.5, 9.0, 3.4]))
    assert found.status.tolist() == ["ok", "cannot-assemble", "ok"]
    assert np.isnan(found.answers["T12"]).tolist() == [False, True, False]


def test_a_row_at_a_dead_centre_has_its_status() -> None:
    text = FOUR_BAR.replace("link: 2}", "link: 4}").replace("BC: 3.5", "BC: 3").replace("CD: 2.5", "CD: 2")
    text = text.replace("P: {force: 100, link: 4, at: E, angle: 180}", "M: {torque: 5, link: 2}")
    beside = icsolve.evaluator(icsolve.load(text), ("angles.AB",))  # at 180 coupler and rocker are in line
    for angle in (179.999, 90.0, 180.0):
        status, values = solved(beside.case_of(angle))
        found = beside(angle)
        assert found.status[0] == status
        assert values == {} or found.answers["T12"][0] == pytest.approx(values["T12"], rel=1e-9)


def side(a: Sequence[float], c: Sequence[float], d: Sequence[float]) -> float:
    """How far C lies left of the line from A to D, as a part of their distance."""
    turned = (d[0] - a[0]) * (c[1] - a[1]) - (d[1] - a[1]) * (c[0] - a[0])
    return turned / ((d[0] - a[0]) ** 2 + (d[1] - a[1]) ** 2)


BRANCHES = {
    "as a record": "",
    "no load": "loads.P",
    "spare point": "G",
    "friction": "mu",
}


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("kind", BRANCHES)
def test_every_row_is_on_the_branch_of_the_case_as_written(kind: str, seed: int) -> None:
    """However far its numbers take the points from `near`, whether rows are solved as scenes (where the load
    is nothing, with friction) or not, and whatever else `near` names."""
    draw = random.Random(seed)
    up = draw.choice((-1.0, 1.0))
    text = FOUR_BAR.replace("near: {C: [3.5, 2.4]}", f"near: {{C: [3.5, {2.4 * up}]}}")
    if kind == "spare point":
        text = text.replace("DE: 1.5", "DE: 1.5, BG: 2, CG: 2.2").replace("{C: [", "{G: [1, 2], C: [")
    if kind == "friction":
        text = text.replace("at: D}", "at: D, mu: 0.2, radius: 0.01}") + "motion: {link: 2, turns: cw}\n"
    turns = np.sort(np.array([draw.uniform(0.0, 360.0) for _ in range(9)]))
    x, y = 4.0 * np.cos(np.radians(turns)), 4.0 * np.sin(np.radians(turns))
    wanted = ("answers", "points.B", "points.C", "points.D")
    load = np.array([100.0, 0.0, 100.0] * 3) if kind != "as a record" else 100.0
    call = icsolve.evaluator(icsolve.load(text), ("points.D.x", "points.D.y", "loads.P"), wanted)
    found = call(x, y, load)
    assert set(found.status.tolist()) == {"ok"}
    for n in range(9):
        assert side(found.points["B"][n], found.points["C"][n], found.points["D"][n]) * up > 0.0


@pytest.mark.parametrize("seed", range(6))
def test_to_the_last_double_before_a_limit_a_row_is_the_scene_of_its_branch(seed: int) -> None:
    """The two places of C are one there but for half of the digits of a double."""
    draw = random.Random(seed)
    angle, up = draw.uniform(70.0, 110.0), draw.choice((-1.0, 1.0))
    text = FOUR_BAR.replace("AB: 60", f"AB: {angle!r}").replace(
        "near: {C: [3.5, 2.4]}", f"near: {{C: [3, {3 * up}]}}"
    )
    ends = []
    for step in range(-3, 3):
        x = float(np.cos(np.radians(angle)) + np.sqrt(36.0 - np.sin(np.radians(angle)) ** 2))
        ends.append(x + step * np.spacing(x))
    call = icsolve.evaluator(icsolve.load(text), ("points.D.x",), ("answers", "points"))
    found = call(np.array(ends))
    assert set(found.status.tolist()) <= {"ok", "cannot-assemble"}
    for n in np.flatnonzero(found.status == "ok"):
        assert side(*(found.points[p][n] for p in "BCD")) * up >= 0.0


def test_with_friction_rows_are_solved_one_by_one_and_have_no_gradient() -> None:
    text = FOUR_BAR.replace("at: D}", "at: D, mu: 0.2, radius: 0.1}") + "motion: {link: 2, turns: cw}\n"
    case = icsolve.load(text)
    found = icsolve.evaluator(case, ("loads.P",))([100.0, 200.0])
    expected = [solved(with_numbers(case, {"loads.P": p}))[1]["T12"] for p in (100.0, 200.0)]
    assert found.answers["T12"].tolist() == expected
    with pytest.raises(ValueError, match="friction"):
        icsolve.evaluator(case, ("loads.P",), gradient=True)


@pytest.mark.parametrize(
    ("inputs", "columns", "words"),
    [
        ((), (), "nothing is varied"),
        (("lengths.BC", "lengths.CB"), (), "named twice"),
        (("lengths.BC",), (1.0, 2.0), "1 numbers are varied"),
        (("lengths.BC", "loads.P"), ([1.0, 2.0], [1.0, 2.0, 3.0]), "shape"),
        (("angles.AB",), (1e8,), "take turns off"),
        (("angles.AB",), (10**400,), "should be numbers"),
        (("lengths.BC",), ([3.5, 10**400],), "should be numbers"),
        (("angles.AB", "lengths.BC"), ([60.0, -1e300], 3.5), "take turns off"),
    ],
)
def test_what_makes_no_sense_is_refused(
    inputs: tuple[str, ...], columns: tuple[float, ...], words: str
) -> None:
    with pytest.raises(ValueError, match=words):
        icsolve.evaluator(icsolve.load(FOUR_BAR), inputs)(*columns)


def test_a_gradient_is_given_whatever_else_is_wanted() -> None:
    found = icsolve.evaluator(icsolve.load(FOUR_BAR), ("loads.P",), ("points",), gradient=True)(100.0)
    assert found.gradients["T12"]["loads.P"] == pytest.approx(found.answers["T12"] / 100.0)


def test_a_case_of_more_or_fewer_numbers_is_refused() -> None:
    call = icsolve.evaluator(icsolve.load(FOUR_BAR), ("angles.AB", "loads.P"))
    for numbers in ((), (60.0,), (60.0, 100.0, 1.0)):
        with pytest.raises(ValueError, match=r"2 numbers are varied \(angles.AB, loads.P\), not"):
            call.case_of(*numbers)


@pytest.mark.parametrize("rows", [0, 1, 3, 40])
@pytest.mark.parametrize("friction", [False, True])
def test_rows_are_as_many_as_the_columns_have(rows: int, friction: bool) -> None:
    """Beside numbers for all rows, and columns of one row, too: none of nothing, in the shapes of some."""
    rough = FOUR_BAR.replace("at: D}", "at: D, mu: 0.2, radius: 0.1}") + "motion: {link: 2, turns: cw}\n"
    case = icsolve.load(rough if friction else FOUR_BAR)
    ask = icsolve.evaluator(case, ("angles.AB", "lengths.BC", "loads.P"), ("answers", "points"))
    for others in ((3.5, 100.0), ([3.5], 100.0), (3.5, np.full(rows, 100.0)), ([3.5], [100.0])):
        found = ask(np.linspace(50.0, 60.0, rows), *others)
        assert found.status.shape == found.answers["T12"].shape == (rows,)
        assert found.points["C"].shape == (rows, 2)
    if rows != 1:
        with pytest.raises(ValueError, match="rows are asked for"):
            ask(np.linspace(50.0, 60.0, rows), [3.5, 3.6], 100.0)


@pytest.mark.parametrize("kind", [float, int])
def test_what_a_mask_hides_is_no_number(kind: type) -> None:
    """A row of its own has no answer, and a sweep refuses it: the number behind a mask is no datum."""
    case = icsolve.load(FOUR_BAR)
    angles = np.ma.array([60, 61, 62], mask=[False, True, False], dtype=kind)
    found = icsolve.evaluator(case, ("angles.AB",))(angles)
    assert found.status.tolist() == ["ok", "cannot-assemble", "ok"]
    assert np.isnan(found.answers["T12"]).tolist() == [False, True, False]
    with pytest.raises(ValueError, match="not all finite"):
        icsolve.sweep(case, vary={"angles.AB": angles})
    whole = np.ma.array([60.0, 61.0, 62.0])
    assert icsolve.sweep(case, vary={"angles.AB": whole}).status.tolist() == ["ok"] * 3


def recorded() -> tuple[Record, list[int], dict[int, str], list[float]]:
    """Every operation of a record on two inputs, and the gradient of their sum."""
    record = Record()
    x, y = record.input("x", 0.7), record.input("y", 2.3)
    c, s = record.turned(x * 100.0)
    parts = [
        x + y,
        x - y,
        x * y,
        x / y,
        -x,
        record.sqrt(x + y),
        c,
        s,
        record.angle(x, y),
        record.nearest(y * 3.0),
    ]
    total = parts[0]
    for part in parts[1:9]:
        total = total + part * part
    slopes = gradient(record, total, (x.index, y.index))
    shown = [*parts, total, *slopes.values()]
    return record, [v.index for v in shown], {x.index: "x", y.index: "y"}, [float(v) for v in shown]


@pytest.mark.parametrize("rows", [1, 3, 200])
@pytest.mark.parametrize("path", ["angles.AB", "lengths.BC", "loads.P"])
@pytest.mark.parametrize("number", [float("nan"), float("inf"), float("-inf")])
def test_a_number_that_is_none_spoils_its_own_row_alone(rows: int, path: str, number: float) -> None:
    case = icsolve.load(FOUR_BAR)
    values = np.full(rows, numbers_of(case)[path].value)
    values[-1] = number
    found = icsolve.evaluator(case, inputs=(path,), want=("answers",))(values)
    assert found.status.tolist() == ["ok"] * (rows - 1) + ["cannot-assemble"]
    assert np.isfinite(found.answers["T12"]).tolist() == [True] * (rows - 1) + [False]


@pytest.mark.parametrize("pitch", ["module: 4", "diametral pitch: 0.25"])
@pytest.mark.parametrize(
    ("path", "values"),
    [
        ("joints.2-3.teeth.0", [30.0, 31.0, 29.0]),
        ("joints.2-3.teeth.1", [60.0, 61.0, 58.0]),
        ("points.B.x", [180.0, 180.35, 180.37, 179.65, 179.63, 170.0]),
        ("points.A.y", [0.0, 8.0, 12.0, -30.0]),
        ("lengths.AB", [180.0, 180.35, 180.37, 170.0]),
    ],
)
def test_teeth_that_no_longer_fit_their_pivots_are_refused_as_in_a_scene(
    pitch: str, path: str, values: list[float]
) -> None:
    """Two wheels of 30 and 60 teeth of module 4: their pitch circles touch 180 apart. A row is a scene, in a
    sweep and in an evaluator, whichever of the numbers is another one."""
    figure = "points: {A: [0, 0], B: [180, 0]}"
    if path == "lengths.AB":
        figure = "points: {A: [0, 0]}\nlengths: {AB: 180}\nangles: {AB: 20}"
    case = icsolve.load(
        f"icsolve: 1\nunits: {{length: mm, force: N, torque: N*mm}}\n{figure}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [1, 3], at: B},"
        f" {{gears: [2, 3], teeth: [30, 60], pressure angle: 20, {pitch}}}]\n"
        "loads: {M: {torque: 100, link: 3}, T: {torque: unknown, link: 2}}\n"
    )
    scenes = [solved(with_numbers(case, {path: value}))[0] for value in values]
    assert {"ok", "inconsistent"} == set(scenes)
    assert icsolve.evaluator(case, (path,))(np.array(values)).status.tolist() == scenes
    assert icsolve.sweep(case, {path: np.array(values)}).status.tolist() == scenes


@pytest.mark.parametrize("rows", [1, 3, 200])
@pytest.mark.parametrize(
    ("path", "bad"),
    [("lengths.AB", -1.0), ("loads.S", -0.5), ("loads.S.free", -1.0), ("joints.4-5.teeth.0", 20.5)],
)
def test_a_number_that_no_case_may_have_spoils_its_own_row_alone(rows: int, path: str, bad: float) -> None:
    """A sweep refuses such a number, and so does the reader: it has no answer here either."""
    text = FOUR_BAR.replace("D: [4, 0]", "D: [4, 0], K: [8, 0]").replace(
        "loads:", "loads:\n  S: {spring: 2, free: 1, link: 4, at: C, to: A}"
    )
    text = text.replace("joints:", "joints:\n  - {pin: [5, 1], at: K}\n  - {gears: [4, 5], teeth: [20, 40]}")
    case = icsolve.load(text)
    values = np.full(rows, numbers_of(case)[path].value)
    values[-1] = bad
    with pytest.raises(ValueError, match="should"):
        icsolve.sweep(case, {path: values})
    call = icsolve.evaluator(case, inputs=(path,), want=("answers",), gradient=True)
    for found in (call(values), call(bad)):
        assert found.status.tolist() == ["ok"] * (len(found) - 1) + ["cannot-assemble"]
        assert np.isfinite(found.answers["T12"]).tolist() == [True] * (len(found) - 1) + [False]
        assert np.isnan(found.gradients["T12"][path][-1])


SCRIPT = Path(__file__).parent.parent / "icsolve/page/script"


@pytest.mark.skipif(shutil.which("node") is None, reason="no JavaScript engine")
@pytest.mark.parametrize("kind", ["DOUBLES", "DIGITS"])
def test_the_generated_javascript_does_what_the_record_does(kind: str) -> None:
    """On both kinds of numbers of a page."""
    record, wanted, names, expected = recorded()
    language = JAVASCRIPT._replace(number=lambda v: f"of({v!r})")
    text = straight_line(record.nodes, wanted, names, language)
    script = "const {entries} = Object;const abs = (v) => (v < 0 ? -v : v);\n"
    script += (SCRIPT / "digits.js").read_text(encoding="utf-8")
    script += f"const x={kind}.of(0.7),y={kind}.of(2.3);{{const {{of,root,angle,nearest,turn}}={kind};\n"
    script += f"let {', '.join(text.names)};\n" + "\n".join(text.lines)
    script += f"\nconsole.log(JSON.stringify(plainly([{','.join(text.wanted)}])));}}"
    ran = subprocess.run(["node", "-e", script], capture_output=True, text=True, check=True)
    assert [float(v) for v in ran.stdout.strip()[1:-1].split(",")] == pytest.approx(expected, rel=1e-13)


def test_a_gradient_on_the_record_is_that_of_differences() -> None:
    _, _, _, at = recorded()
    total, by_x, by_y = at[10], at[11], at[12]

    def f(x: float, y: float) -> float:
        c, s = np.cos(np.radians(100.0 * x)), np.sin(np.radians(100.0 * x))
        angle = np.degrees(np.arctan2(y, x))
        squares = (x - y) ** 2 + (x * y) ** 2 + (x / y) ** 2 + x * x + (x + y) + c * c + s * s + angle**2
        return float(x + y + squares)

    assert f(0.7, 2.3) == pytest.approx(total, rel=1e-13)
    h = 1e-5
    assert (f(0.7 + h, 2.3) - f(0.7 - h, 2.3)) / (2 * h) == pytest.approx(by_x, rel=1e-6)
    assert (f(0.7, 2.3 + h) - f(0.7, 2.3 - h)) / (2 * h) == pytest.approx(by_y, rel=1e-6)


def test_a_record_has_no_nodes_for_what_is_exact() -> None:
    """A quarter turn and a difference of equal exact numbers are numbers; what varies stays, zero too."""
    record = Record()
    for degrees, both in ((0.0, (1.0, 0.0)), (90.0, (0.0, 1.0)), (180.0, (-1.0, 0.0))):
        turned = record.turned(record.about(degrees, 0.0))
        assert turned == both and all(type(part) is float for part in turned)
    three, moved = record.about(3.0, 0.0), record.input("x", 3.0)
    assert type(three + record.about(-3.0, 0.0)) is float
    assert isinstance(moved - three, Traced) and isinstance(record.about(3.0, 1e-16) - three, Traced)
    assert sorted(code for name, code in vars(Op).items() if name.isupper()) == list(range(OPERATIONS))


def test_an_evaluator_goes_to_other_processes() -> None:
    own = icsolve.evaluator(icsolve.load(FOUR_BAR), ("angles.AB",), gradient=True)
    other = pickle.loads(pickle.dumps(own))
    for one, two in zip((own(70.0), own(50.0)), (other(70.0), other(50.0)), strict=True):
        assert (one.answers["T12"], one.gradients["T12"]) == (two.answers["T12"], two.gradients["T12"])
