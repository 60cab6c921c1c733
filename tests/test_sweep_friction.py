"""Sweeps with friction: every row says what its scene says; in several processes where that takes long."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import icsolve
from icsolve.files import can_fork
from icsolve.solve import attempt
from icsolve.sweep import rows_by_scenes
from sizes import FULL, crossed, sampled

CASES = Path(__file__).parent.parent / "cases" / "ch13"
WANT = ("answers", "status", "error", "points", "centres", "rates")


def case(name: str) -> icsolve.Case:
    return icsolve.load(str(CASES / f"{name}.yaml"))


def same(one: icsolve.Sweep, two: icsolve.Sweep) -> bool:
    """Whether two sweeps are the same to the last bit."""
    tables = [(one.kinds[kind], two.kinds[kind]) for kind in one.kinds]
    tables += [(one.errors[kind], two.errors[kind]) for kind in one.errors] + [(one.holds, two.holds)]
    return (one.status == two.status).all() and all(
        a.keys() == b.keys() and all(np.array_equal(a[name], b[name], equal_nan=True) for name in a)
        for a, b in tables
    )


FOUR_BAR = """\
icsolve: 1
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 1, BC: 3.5, CD: 2.5}
angles: {AB: 60}
near: {C: [3.1, 2.3]}
joints:
  - {pin: [1, 2], at: A, mu: 0.2, radius: 0.1}
  - {pin: [2, 3], at: B, mu: 0.3, radius: 0.1}
  - {pin: [3, 4], at: C, mu: 0.3, radius: 0.1}
  - {pin: [4, 1], at: D, mu: 0.2, radius: 0.1}
loads: {T4: {torque: 10, link: 4}, T2: {torque: unknown, link: 2}}
"""
BLOCK = """\
icsolve: 1
points: {A: [0, 0]}
lengths: {AB: 1, BC: 3}
angles: {AB: 40}
near: {C: [3.7, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C, mu: 0.2, radius: 0.2}
  - {slide: [4, 1], at: C, along: 0, through: A, mu: 0.3, length: 1}
loads: {P: {force: 7, link: 4, at: C, angle: 190}, T2: {torque: unknown, link: 2}}
"""
CW = "motion: {link: 2, turns: cw}\n"
BACK = "motion: {link: 2, speed: -3}\n"
MOVED = {"drive": {"2": np.linspace(-170.0, 180.0, 36)}}
LOADED = {"vary": {"loads.T4": np.linspace(-5.0, 8.0, 8), "angles.AB": np.linspace(20.0, 300.0, 8)}}
ROUGHER = {"vary": {"joints.B.mu": np.linspace(0.05, 0.5, 8)}}
SAME = 1e-11
"""Part of an answer: a row is in doubles, whose roundings the equations of the rubs spread a little."""


@sampled(2)
@pytest.mark.parametrize(
    ("of", "more"),
    crossed(
        [(FOUR_BAR, MOVED), (FOUR_BAR, LOADED), (FOUR_BAR, ROUGHER), (BLOCK, MOVED)],
        ["", CW, "motion: {link: 4, turns: ccw}\n", BACK, "motion: {link: 4, turns: cw, speed: -2 rpm}\n"],
    ),
)
def test_a_row_is_the_scene_of_its_points(of: tuple[str, dict[str, Any]], more: str) -> None:
    """Values, ranges and statuses, whichever senses the rubs have there."""
    text, moved = of
    more = "" if text == BLOCK and "4" in more else more
    found = icsolve.sweep(icsolve.load(text + more), **moved)
    for row in range(0, len(found), 1 if FULL else 2):
        _is_scene(found, row)


def test_the_sign_of_a_speed_says_which_way_it_goes() -> None:
    """Also where the speed is what varies, with and without bounds."""
    speeds = {"motion.speed": [-2.0, -1e-9, 0.0, 0.5, 3.0]}
    for text in (FOUR_BAR + BACK, BLOCK + "motion: {link: 2, turns: cw, speed: 1}\n"):
        for want in (("answers", "status"), ("answers", "status", "error")):
            found = icsolve.sweep(icsolve.load(text), speeds, want)
            assert found.answers["T2"][0] != pytest.approx(found.answers["T2"][-1], rel=1e-3)
            for row in range(len(found)):
                _is_scene(found, row)


@pytest.mark.parametrize(
    "name", ["13_18_slider_crank_friction_everywhere", "13_19_slider_crank_friction_at_pins"]
)
def test_rows_of_the_library_are_scenes(name: str) -> None:
    found = icsolve.sweep(case(name), drive={"2": np.arange(0.0, 360.0, 30.0)}, want=WANT[:2])
    for row in range(len(found)):
        _is_scene(found, row)


def _is_scene(found: icsolve.Sweep, row: int) -> None:
    """Whether a row says what the scene of its points says."""
    tried = attempt(found.case_of(row))
    if tried.answer is None:
        assert tried.refusal is not None and found.status[row] == tried.refusal.status
        return
    for load, own in tried.answer.answers.items():
        if own.holds is None:
            assert found.answers[load][row] == pytest.approx(own.value, rel=SAME)
        else:
            assert found.status[row] == "holds"
            assert found.holds[load][row] == pytest.approx(
                own.holds, rel=SAME, abs=SAME * max(map(abs, own.holds))
            )
            assert found.locks[load][row] == own.self_locking


def test_a_crank_that_friction_jams_says_so() -> None:
    """13.19 by its crank: near 270 degrees the friction circles take all of the lever, no force drives it."""
    sweep = icsolve.sweep(
        case("13_19_slider_crank_friction_at_pins"), drive={"2": np.arange(246.0, 300.0, 6.0)}
    )
    assert "jam" in sweep.status
    assert np.isnan(sweep.answers["F"][sweep.status == "jam"]).all()


@pytest.mark.skipif(not can_fork(), reason="needs processes that share what was read")
@pytest.mark.parametrize("name", ["13_19_slider_crank_friction_at_pins", "13_20_slider_crank_with_friction"])
def test_several_processes_find_what_one_does(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    degrees = np.arange(0.0, 360.0, 20.0)
    monkeypatch.setattr(rows_by_scenes, "can_share", lambda: False)
    alone = icsolve.sweep(case(name), drive={"2": degrees}, want=WANT)
    monkeypatch.setattr(rows_by_scenes, "can_share", lambda: True)
    for constant, value in (("PATIENCE", 0.0), ("WORTH", 0.0), ("FEW", 4)):
        monkeypatch.setattr(rows_by_scenes, constant, value)
    done: list[int] = []
    together = icsolve.sweep(case(name), drive={"2": degrees}, want=WANT, progress=done.append)
    assert same(alone, together)
    assert sum(done) >= len(degrees)


@pytest.mark.parametrize("toward", [0, 180])
def test_a_point_goes_on_in_the_sense_in_which_it_is_given(toward: int) -> None:
    """To either side: the row as written is the case, and beyond the dead centre the crank turns on."""
    text = f"""icsolve: 1
points: {{A: [0, 0], C: [unknown, 0]}}
lengths: {{AB: 0.1, BC: 0.25}}
angles: {{AB: 35}}
near: {{C: [0.3, 0]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{slide: [4, 1], at: C, along: 0, mu: 0.1}}
loads: {{T: {{torque: unknown, link: 2}}, P: {{force: 10, link: 4, at: C, angle: 180}}}}
motion: {{point: C, link: 4, speed: 1, angle: {toward}}}
"""
    written = icsolve.load(text)
    rows = icsolve.sweep(written, drive={"2": np.array([-80.0, 0.0, 90.0, 225.0])}, want=WANT)
    answer = icsolve.solve(written, rates=True)
    assert rows.answers["T"][1] == pytest.approx(answer.answers["T"].value)
    assert answer.rates is not None
    assert np.sign(rows.rates["2"]).tolist() == [np.sign(answer.rates["2"])] * 4


def test_the_powers_of_loads_are_those_of_loads_with_and_without_bounds() -> None:
    """Friction's own power stands in an answer's terms, but is not that of a unit of any load."""
    case = icsolve.load(FRICTIONAL_CRANK)
    rows = {"angles.AB": np.linspace(20.0, 160.0, 8)}
    bare = icsolve.sweep(case, rows, ("answers", "terms"))
    told = icsolve.sweep(case, rows, ("answers", "terms", "error"))
    assert bare.terms.keys() == told.terms.keys() == {"P", "T"}
    for found in (bare, told):
        assert np.isfinite(found.terms["P"] / found.terms["T"]).all()
    assert bare.terms["P"] / bare.terms["T"] == pytest.approx(told.terms["P"] / told.terms["T"], rel=1e-9)


FRICTIONAL_CRANK = """icsolve: 1
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: 2, BC: 6}
angles: {AB: 40}
near: {C: [7, 0]}
joints:
  - {pin: [1, 2], at: A, mu: 0.2, radius: 0.3}
  - {pin: [2, 3], at: B, mu: 0.1, radius: 0.2}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0, mu: 0.1}
loads: {P: {force: 100, link: 4, at: C, angle: 180}, T: {torque: unknown, link: 2}}
motion: {link: 2, turns: ccw}
"""


PARALLEL = """icsolve: 1
points: {{A: [0, 0], D: [4, 0]}}
lengths: {{AB: 2, BC: 4, CD: 2}}
angles: {{AB: {0}}}
near: {{C: [{1}, {2}]}}
joints:
  - {{pin: [1, 2], at: A, mu: 0.3, radius: 0.2}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C, mu: 0.2, radius: 0.1}}
  - {{pin: [4, 1], at: D}}
loads: {{P: {{force: 10, link: 4, at: C, angle: 30}}, T: {{torque: unknown, link: 2}}}}
"""


def parallel(degrees: float, motion: str) -> icsolve.Case:
    """A parallelogram with its cranks at an angle: C is at 4 + 2 cos, 2 sin."""
    c, s = (2.0 * f(math.radians(degrees)) for f in (math.cos, math.sin))
    return icsolve.load(PARALLEL.format(degrees, 4.0 + c, s) + motion)


@sampled(2, "motion", "want")
@pytest.mark.parametrize(
    "motion",
    [
        "motion: {link: 2, turns: ccw}",
        "motion: {link: 4, turns: cw}",
        "",
        "motion: {point: B, link: 3, speed: 1, angle: A}",
    ],
)
@pytest.mark.parametrize("want", [("answers", "status"), ("answers", "status", "points")])
def test_rows_with_friction_go_straight_on_through_change_points(motion: str, want: tuple[str, ...]) -> None:
    """Whatever is wanted of them: all links lie on one line at 0 and 180 degrees; a row is the scene of the
    parallelogram (to 1e-7: its places are doubles)."""
    angles = [60.0 - 17.3 * n for n in range(15)]
    found = icsolve.sweep(parallel(60.0, motion.replace("A}", "150}")), {"angles.AB": angles}, want)
    for n, angle in enumerate(angles):
        scene = icsolve.solve(parallel(angle, motion.replace("A}", f"{angle + 90.0}}}"))).answers["T"]
        right = scene.holds or (scene.value, scene.value)
        row = found.holds["T"][n] if scene.holds else [found.answers["T"][n]] * 2
        assert row == pytest.approx(right, rel=1e-7)


LADDER = """icsolve: 1
points: {{A: [0, 0], G: {{centroid: [A, B]}}}}
lengths: {{AB: 5}}
angles: {{AB: 60}}
{named}joints:
  - {{contact: [1, 2], at: A, normal: 90, mu: 0.3}}
  - {{contact: [1, 2], at: B, normal: 180, mu: 0.2}}
loads:
  W: {{weight: 200, link: 2, at: {weight}}}
  U: {{force: unknown, link: 2, at: {push}, angle: 0}}
"""


@sampled(4, "path", "named", "push", "weight")
@pytest.mark.parametrize("weight", "GAB")
@pytest.mark.parametrize("push", "AB")
@pytest.mark.parametrize("named", ["", "links: {2: [A, B]}\n"], ids=["", "named"])
@pytest.mark.parametrize(("path", "values"), [("angles.AB", (50, 60, 65)), ("lengths.AB", (4, 5, 5.5))])
def test_a_number_that_puts_contacts_elsewhere_gives_figures_written_so(
    weight: str, push: str, named: str, path: str, values: tuple[float, ...]
) -> None:
    """A ladder whose foot is elsewhere on the floor, wherever its loads act and whatever points are named of
    it: each row is its scene."""
    if (weight, push) == ("A", "B"):  # it does no work, and nothing drives
        return
    text = LADDER.format(named=named, weight=weight, push=push)
    sweep = icsolve.sweep(icsolve.load(text), vary={path: values})
    for row, value in enumerate(values):
        was = {"angles.AB": "AB: 60", "lengths.AB": "AB: 5"}[path]
        scene = icsolve.solve(icsolve.load(text.replace(was, f"AB: {value}")))
        assert sweep.status[row] == "holds"
        assert tuple(sweep.holds["U"][row]) == scene.answers["U"].holds


@pytest.mark.parametrize(
    ("joint", "path"),
    [
        ("{slide: [2, 1], at: C, along: 30, mu: 0.2}", "joints.C.mu"),
        ("{pin: [2, 1], at: B, mu: 0.2, radius: 0.1}", "joints.B.mu"),
        ("{pin: [2, 1], at: B, mu: 0.3, radius: 0.1}", "loads.W"),
    ],
)
def test_a_row_in_which_nothing_rubs_has_one_value_as_its_scene_has(joint: str, path: str) -> None:
    """No friction, or no load, among rows with both: `ok` and a value, or a range of one point, as `solve`
    says (1e-15: rounding)."""
    text = f"""icsolve: 1
points: {{B: [-1, 0.4], C: [0, 0], G: [0, 0.3]}}
links: {{2: [C]}}
joints:
  - {joint}
loads:
  W: {{weight: 100, link: 2, at: G}}
  P: {{force: unknown, link: 2, at: C, angle: 30}}
"""
    values = [0.0, 0.05, 0.2]
    swept = icsolve.sweep(icsolve.load(text), vary={path: values})
    for k, value in enumerate(values):
        found = icsolve.solve(icsolve.load(text, settings={path: value})).answers["P"]
        assert swept.status[k] == ("ok" if found.holds is None else "holds")
        row = [swept.answers["P"][k]] if found.holds is None else swept.holds["P"][k].tolist()
        assert row == pytest.approx(found.holds or [found.value], rel=1e-15, abs=1e-15)


@pytest.mark.parametrize("motion", ["", "motion: {point: A, link: 2, speed: 1, angle: %d}\n"])
@pytest.mark.parametrize(
    ("push", "mu", "along", "at"),
    [
        (45, 1, 0, (50, 0)),
        (45, 1, 90, (50, 0)),
        (90, 1, 45, (30, 30)),
        (45, 0.3, 0, (50, 0)),
        (-60, 0.3, 90, (50, 0)),
    ],
)
def test_a_row_whose_load_cancels_has_the_zero_of_its_scene(
    motion: str, push: int, mu: float, along: int, at: tuple[int, int]
) -> None:
    """On the edge of locking what the push needs is just what the friction takes: what rounding leaves of
    both, -1.4e-14 N, is no row's answer."""
    case = icsolve.load(
        f"icsolve: 1\npoints: {{A: [0, 0], D: [{at[0]}, {at[1]}]}}\n"
        f"joints:\n  - {{slide: [2, 1], at: A, along: {along}, mu: {mu}, length: 30}}\n"
        f"loads:\n  P: {{force: 100, link: 2, at: D, angle: {push}}}\n"
        f"  Q: {{force: unknown, link: 2, at: A, angle: {along}}}\n" + (motion % along if motion else "")
    )
    scene = icsolve.solve(case).answers["Q"]
    rows = icsolve.sweep(case, {"joints.A.mu": np.array([mu])})
    found = rows.holds["Q"][0] if "Q" in rows.holds else (rows.answers["Q"][0],) * 2
    own = scene.holds or (scene.value, scene.value)
    for row, end in zip(found, own, strict=True):
        assert end is not None and (row == 0.0) == (end == 0.0) and row == pytest.approx(end)
