"""What a row says of itself: dead centres, change points, ranges that do not assemble, rounding.

The peers of ../shared/peers.md 4 turn a parallelogram into an antiparallelogram without a word; here every
row has its status, and none is without a number and without a status.
"""

from __future__ import annotations

from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import icsolve
from icsolve.assembly.driven.order import AssemblyOrder
from icsolve.case import Case
from icsolve.scene.sensitivity import numbers_of
from icsolve.statics.power import is_unknown
from icsolve.sweep.varied_numbers import with_numbers
from library import FILES

ALL = ("answers", "status", "error", "points", "centres", "rates")

PARALLELOGRAM = """icsolve: 1
points: {A: [0, 0], D: [2, 0]}
lengths: {AB: 1, BC: 2, CD: 1}
angles: {AB: 60}
near: {C: [2.5, 0.9]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads: {T14: {torque: 10, link: 4}, T12: {torque: unknown, link: 2}}
"""
SLIDER_CRANK = """icsolve: 1
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: 50, BC: 160}
angles: {AB: 40}
near: {C: [195, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads:
  P: {force: P_, link: 4, at: C, angle: 180}
  T: {torque: T_, link: 2}
"""
FOUR_BAR = """icsolve: 1
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 1, BC: 3.5, CD: 2.5}
angles: {DC: 100}
near: {B: [0.5, 0.9]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads: {T14: {torque: 10, link: 4}, T12: {torque: unknown, link: 2}}
"""


def complete(sweep: icsolve.Sweep) -> bool:
    """Whether nothing is without a number unless its row has a status."""
    tables = (sweep.answers, sweep.error, sweep.points, sweep.centres, sweep.rates)
    arrays = [array.reshape(len(sweep), -1) for table in tables for array in table.values()]
    return all(np.isfinite(array[sweep.status == "ok"]).all() for array in arrays)


# --- change points ----------------------------------------------------------------------------------


def of_circle(degrees: Any) -> Any:
    """Where C of the parallelogram is: as far from D as B from A."""
    return np.stack([2.0 + np.cos(np.radians(degrees)), np.sin(np.radians(degrees))], axis=1)


@pytest.mark.parametrize("step", [0.5, 1.0, 0.7, 7.0, 47.0, 90.0])
def test_a_parallelogram_stays_one_through_its_change_points(step: float) -> None:
    """Rows at the change points at 0 and 180 degrees say so, none beside them; what is passed is noted."""
    degrees = np.arange(0.0, 360.001, step)
    sweep = icsolve.sweep(icsolve.load(PARALLELOGRAM), {"angles.AB": degrees}, ALL)
    assert np.abs(sweep.points["C"] - of_circle(degrees)).max() < 1e-13
    said = degrees[sweep.status == "change-point"]
    there = np.isin(degrees, (0.0, 180.0, 360.0))
    assert said.tolist() == degrees[there].tolist()
    assert any("change point at angles.AB = 180" in note for note in sweep.notes)
    assert np.isnan(sweep.answers["T12"][there]).all()
    assert sweep.answers["T12"][~there] == pytest.approx(-10.0, rel=1e-9)
    assert complete(sweep)


def test_rows_far_from_the_case_as_written_are_reached_through_the_change_point() -> None:
    sweep = icsolve.sweep(icsolve.load(PARALLELOGRAM), {"angles.AB": [240.0, 250.0]}, ALL)
    assert np.abs(sweep.points["C"] - of_circle([240.0, 250.0])).max() < 1e-14
    assert sweep.status.tolist() == ["ok", "ok"]
    assert "change point at angles.AB = 180" in sweep.notes[0]


def test_near_a_change_point_the_branch_stays() -> None:
    """Links 1, 2, 2 and frame 2.999 (../shared/peers.md 4): C stays to the left of BD all the way round."""
    text = PARALLELOGRAM.replace("D: [2, 0]", "D: [2.999, 0]").replace("CD: 1", "CD: 2")
    case = icsolve.load(text.replace("near: {C: [2.5, 0.9]}", "near: {C: [2.2, 1.8]}"))
    degrees = np.arange(0.0, 360.0, 5.0)
    sweep = icsolve.sweep(case, {"angles.AB": degrees}, ALL)
    c, d = sweep.points["C"], np.array([2.999, 0.0])
    b = np.stack([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))], axis=1)
    left = (d - b)[:, 0] * (c - b)[:, 1] - (d - b)[:, 1] * (c - b)[:, 0]
    assert (left > 0.0).all()
    assert (sweep.status == "ok").all()


def test_newtons_method_keeps_the_branch_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """The parallelogram without closed forms: as a group, followed step by step through its change points."""
    monkeypatch.setattr(AssemblyOrder, "_at_intersection", lambda self: iter(()))
    degrees = np.arange(0.5, 360.0, 1.0)
    sweep = icsolve.sweep(icsolve.load(PARALLELOGRAM), {"angles.AB": degrees}, ALL)
    assert np.abs(sweep.points["C"] - of_circle(degrees)).max() < 1e-12
    assert (sweep.status == "ok").all()
    assert "change point at angles.AB = 180" in sweep.notes[0]
    assert sweep.answers["T12"] == pytest.approx(-10.0, rel=1e-9)
    at = icsolve.sweep(icsolve.load(PARALLELOGRAM), {"angles.AB": [100.0, 180.0, 181.0]}, ALL)
    assert at.status.tolist() == ["ok", "change-point", "ok"]


def test_a_rhombus_goes_on_where_two_pins_meet() -> None:
    """All links alike: at 0 degrees B comes to D. The frame is 1, the crank parallel to the rocker."""
    text = PARALLELOGRAM.replace("D: [2, 0]", "D: [1, 0]").replace("BC: 2", "BC: 1")
    case = icsolve.load(text.replace("[2.5, 0.9]", "[1.5, 0.9]"))
    degrees = np.arange(-60.5, 60.0, 1.0)
    sweep = icsolve.sweep(case, {"angles.AB": degrees}, ALL)
    assert np.abs(sweep.points["C"] - of_circle(degrees) + [1.0, 0.0]).max() < 1e-12
    assert (sweep.status == "ok").all()
    assert "change point at angles.AB = " in sweep.notes[0]


# --- dead centres -----------------------------------------------------------------------------------


def test_a_sweep_through_dead_centres_says_so() -> None:
    """At 0 and 180 degrees the block stands still: no force on it balances the crank."""
    text = SLIDER_CRANK.replace("P_", "unknown").replace("T_", "100")
    degrees = np.arange(0.0, 361.0, 1.0)
    sweep = icsolve.sweep(icsolve.load(text), {"angles.AB": degrees}, ALL)
    dead = np.isin(degrees, (0.0, 180.0, 360.0))
    assert (sweep.status[dead] == "dead-centre").all()
    assert (sweep.status[~dead] == "ok").all()
    assert np.isnan(sweep.answers["P"][dead]).all()
    assert complete(sweep)


def test_where_the_known_load_does_no_work_the_answer_is_zero() -> None:
    """The same positions with the torque unknown: exactly zero, with a bound."""
    text = SLIDER_CRANK.replace("P_", "2000").replace("T_", "unknown")
    sweep = icsolve.sweep(icsolve.load(text), {"angles.AB": np.arange(0.0, 361.0, 90.0)}, ALL)
    assert sweep.answers["T"][[0, 2, 4]].tolist() == [0.0, 0.0, 0.0]
    assert sweep.answers["T"][1] == pytest.approx(-100_000.0, rel=1e-14)
    assert (sweep.status == "ok").all()


def test_close_to_a_dead_centre_the_force_grows_and_keeps_its_digits() -> None:
    """Unknown force 10^-k degrees beside the dead centre: as large as the nearness makes it, to the end."""
    text = (
        SLIDER_CRANK.replace("P_", "unknown")
        .replace("T_", "100")
        .replace("C: [unknown, 0]", "C: [unknown, 0.1]")
    )
    case = icsolve.load(text.replace("[195, 0]", "[195, 0.1]"))
    dead = np.degrees(np.arcsin(0.1 / 210.0))  # crank and rod in line
    offs = 10.0 ** -np.arange(1.0, 15.0)
    sweep = icsolve.sweep(case, {"angles.AB": dead + offs}, ALL)
    assert (sweep.status[:-1] == "ok").all()
    force = np.abs(sweep.answers["P"])
    assert force[1:10] / force[:9] == pytest.approx(10.0, rel=1e-2)
    assert (sweep.error["P"] <= 1e-9 * force)[:-1].all()


# --- what does not assemble -------------------------------------------------------------------------


def test_an_impossible_range_is_said_row_by_row() -> None:
    """A rocker that drives: it reaches from 95.74 to 143.13 degrees, and the same below the frame."""
    degrees = np.arange(0.0, 361.0, 1.0)
    sweep = icsolve.sweep(icsolve.load(FOUR_BAR), {"angles.DC": degrees}, ALL)
    c = np.stack([4.0 + 2.5 * np.cos(np.radians(degrees)), 2.5 * np.sin(np.radians(degrees))], axis=1)
    far = np.hypot(c[:, 0], c[:, 1])
    reached = (far < 4.5) & (far > 2.5)
    assert (sweep.status[reached] == "ok").all()
    assert (sweep.status[~reached] == "cannot-assemble").all()
    assert complete(sweep)


def test_a_case_that_does_not_assemble_as_written_starts_from_the_first_row_that_does() -> None:
    text = FOUR_BAR.replace("DC: 100", "DC: 10")
    sweep = icsolve.sweep(icsolve.load(text), {"angles.DC": np.arange(90.0, 150.0, 1.0)}, ALL)
    assert sweep.status[10] == "ok"
    assert "first row" in sweep.notes[0]
    assert "96" in sweep.notes[0]


def test_no_row_that_assembles() -> None:
    text = FOUR_BAR.replace("DC: 100", "DC: 10")
    with pytest.raises(icsolve.SceneError, match="BC"):
        icsolve.sweep(icsolve.load(text), {"angles.DC": [10.0, 20.0]})


def test_beyond_a_limit_a_group_is_not_taken_up_elsewhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """Followed step by step, a rocker's second range (another circuit) is not reached, nor jumped into."""
    monkeypatch.setattr(AssemblyOrder, "_at_intersection", lambda self: iter(()))
    degrees = np.arange(90.0, 280.0, 2.0)
    sweep = icsolve.sweep(icsolve.load(FOUR_BAR), {"angles.DC": degrees}, ALL)
    reached = (degrees > 95.74) & (degrees < 143.13)
    assert (sweep.status[reached] == "ok").all()
    assert (sweep.status[~reached] == "cannot-assemble").all()


def test_a_turn_later_a_group_is_as_it_was(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(AssemblyOrder, "_at_intersection", lambda self: iter(()))
    degrees = np.array([100.0, 120.0, 460.0, 480.0])
    sweep = icsolve.sweep(icsolve.load(FOUR_BAR), {"angles.DC": degrees}, ALL)
    assert (sweep.status == "ok").all()
    assert sweep.answers["T12"][2:] == pytest.approx(sweep.answers["T12"][:2], rel=1e-10)


# --- refusals of the whole --------------------------------------------------------------------------


def test_loads_that_never_balance_are_said_in_every_row() -> None:
    """A force through the frame pin of its link never works: every row says so, and a note says why."""
    text = PARALLELOGRAM.replace(
        "T12: {torque: unknown, link: 2}", "F: {force: unknown, link: 2, at: A, angle: 0}"
    )
    sweep = icsolve.sweep(icsolve.load(text), {"angles.AB": np.arange(10.0, 80.0)})
    assert set(sweep.status) == {"no-value"}
    assert "does no work" in sweep.notes[0]


@pytest.mark.parametrize(
    ("joint", "said"),
    [
        ("{contact: [4, 1], at: C, normal: 90}", "contact of links 4 and 1 at C"),
        ("{centre: [4, 1], at: [3, 3]}", "given centre of links 4 and 1"),
        ("{roll: [4, 1], at: C}", "rolling of links 4 and 1 at C"),
    ],
)
def test_joints_that_cannot_be_moved_are_named(joint: str, said: str) -> None:
    """../shared/case-format.md, A sweep: a contact without a profile, a centre, a roll without radii."""
    text = f"""icsolve: 1
points: {{A: [0, 0], B: [1, 1], C: [3, 2], E: [4, 1]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: E}}
  - {joint}
loads: {{P: {{torque: 10, link: 4}}, T: {{torque: unknown, link: 2}}}}
"""
    with pytest.raises(icsolve.SceneError) as refusal:
        icsolve.sweep(icsolve.load(text), drive={"2": [0.0, 1.0]})
    assert refusal.value.status in ("unsupported", "mobility")
    if refusal.value.status == "unsupported":
        assert said in refusal.value.message


def test_more_freedoms_than_are_driven() -> None:
    text = """icsolve: 1
points: {A: [0, 0], B: [1, 1], C: [3, 2], D: [5, 1], E: [6, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 5], at: D}
  - {pin: [5, 1], at: E}
"""
    with pytest.raises(icsolve.SceneError, match="more freedoms") as refusal:
        icsolve.sweep(icsolve.load(text), drive={"2": [0.0, 1.0]})
    assert refusal.value.status == "mobility"
    both = icsolve.sweep(icsolve.load(text), drive={"2": [0.0, 5.0], "5": [0.0, -3.0]}, want=("points",))
    assert (both.status == "ok").all()


def test_two_cranks_of_a_five_bar_make_a_product() -> None:
    """Rows of a product of two drives are those of the single positions."""
    text = """icsolve: 1
points: {A: [0, 0], B: [1, 1], C: [3, 4], D: [5, 1], E: [6, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 5], at: D}
  - {pin: [5, 1], at: E}
loads:
  P: {force: 7, link: 3, at: C, angle: -90}
  T2: {torque: unknown, link: 2}
  T5: {torque: unknown, link: 5}
"""
    case = icsolve.load(text)
    pairs = np.array(list(product(np.linspace(-40.0, 40.0, 9), np.linspace(-30.0, 30.0, 7))))
    sweep = icsolve.sweep(case, want=ALL, drive={"2": pairs[:, 0], "5": pairs[:, 1]})
    assert (sweep.status == "ok").all()
    for k in range(0, len(pairs), 10):
        one = icsolve.solve(sweep.case_of(k))
        for name, found in one.answers.items():
            assert sweep.answers[name][k] == pytest.approx(found.value, rel=1e-11)


REPEATED = """icsolve: 1
points: {A: [0, 0], B: [1, 2], C: [5, 3], D: [6, 0]}
%s
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {%s}
loads: {T: {torque: unknown, link: 2}, P: {torque: 3, link: 4}}
"""


@pytest.mark.parametrize("path", ["points.C.y", "points.B.x", "points.D.y", "lengths.BC"])
@pytest.mark.parametrize(
    ("datum", "last"),
    [
        ("lengths: {BC: 4.1231056256176606}", "pin: [4, 1], at: D"),
        ("angles: {AB: 63.43494882292201}", "pin: [4, 1], at: D"),
        ("", "slide: [4, 1], at: C, along: -71.56505117707799, through: D"),
    ],
)
def test_a_row_whose_data_contradict_one_another_says_so(datum: str, last: str, path: str) -> None:
    """As its scene: the coordinates pose the figure, and a length, angle or guide repeats what they say."""
    text = REPEATED % (datum, last)
    case = icsolve.load(text)
    if path == "lengths.BC" and "lengths" not in text:
        return
    for value in (numbers_of(case)[path].value, 2.5):
        row = icsolve.sweep(case, {path: [value]})
        try:
            one = icsolve.solve(icsolve.load(text, {path: value}))
            assert row.answers["T"][0] == pytest.approx(one.answers["T"].value, rel=1e-12)
        except icsolve.SceneError as refusal:
            assert row.status[0] == refusal.status  # noqa: PT017


@pytest.mark.parametrize("path", ["angles.AB", "loads.P"])
def test_where_links_yield_for_an_instant_only_loads_can_be_swept(path: str) -> None:
    """Two links in a straight line between two pivots: a scene has an answer there, and nothing can turn."""
    case = icsolve.load(
        "icsolve: 1\npoints: {A: [0, 0], C: [2, 0]}\nlengths: {AB: 1, BC: 1}\nangles: {AB: 0}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 1], at: C}]\n"
        "loads: {P: {force: 5, link: 2, at: B, angle: -90}, Q: {force: unknown, link: 3, at: B, angle: 90}}\n"
    )
    assert icsolve.solve(case).answers["Q"].value == 5.0
    if path == "loads.P":
        assert icsolve.sweep(case, {path: [5.0, 7.0]}).answers["Q"].tolist() == [5.0, 7.0]
    else:
        with pytest.raises(icsolve.SceneError, match="in the position as written alone, for an instant"):
            icsolve.sweep(case, {path: [0.0, 5.0]})


def test_circles_that_fall_together_beside_the_position_as_written_break_no_sweep() -> None:
    """Peaucellier's cell with its pivots 1e-6 apart: moved a little, two of its circles are one."""
    name = "data/found/circles_that_fall_together_beside.yaml"
    case = icsolve.load((Path(__file__).parent / name).read_text())
    assert [*icsolve.sweep(case, {"points.O.y": [1.0, 0.0]}).status] == ["cannot-assemble", "ok"]


def status_of(case: Case, settings: dict[str, float]) -> str:
    """That of the scene as if written so."""
    try:
        icsolve.solve(with_numbers(case, settings))
    except icsolve.SceneError as refusal:
        return refusal.status
    return "ok"


@pytest.mark.parametrize(
    ("name", "path", "rows"),
    [
        ("rolling/rolling_disk.yaml", "angles.KO", [20.0, 35.0001, 90.0, 110.0, 214.99]),
        ("cams/roller_follower.yaml", "angles.CB", [101.0, 120.0, 200.0, 269.98, 269.99999]),
    ],
)
def test_a_row_that_is_read_anew_has_its_scenes_status_whichever_the_others_are(
    name: str, path: str, rows: list[float]
) -> None:
    """A given motion whose direction no longer fits; a point that comes to lie opposite to where it was."""
    case = icsolve.load(FILES[name])
    expected = [status_of(case, {path: row}) for row in rows]
    assert icsolve.sweep(case, {path: rows}).status.tolist() == expected
    assert [icsolve.sweep(case, {path: [row]}).status[0] for row in rows] == expected


@pytest.mark.parametrize(
    ("name", "path", "rows"),
    [
        ("sliders/v_engine.yaml", "angles.OD", [135.0, 160.0, 185.0, 208.46]),
        ("ch13/13_01_drag_link.yaml", "angles.CDE", [0.0, 50.0, 135.0, 136.0, 200.0]),
    ],
)
def test_a_row_is_given_as_a_case_on_its_own_branch(name: str, path: str, rows: list[float]) -> None:
    """Continuity keeps a branch on which `near`, as written, would no longer decide, or would be opposite."""
    case = icsolve.load(FILES[name])
    (load,) = (load.name for load in case.loads if is_unknown(load))
    found = icsolve.sweep(case, {path: rows})
    solved = [icsolve.solve(found.case_of(n)).answers[load].value for n in range(len(rows))]
    assert found.answers[load] == pytest.approx(solved, rel=1e-11)


@pytest.mark.parametrize("want", [("answers", "status"), ("status", "points"), ("status", "rates")])
@pytest.mark.parametrize(
    ("ground", "guide", "status"),
    [
        (0, "{slide: [hub, 1], at: C, along: 0}", "ok"),
        (5, "{slide: [hub, 1], at: C, along: 0}", "cannot-assemble"),
        (-9, "{slide: [hub, 1], at: C, along: 0}", "cannot-assemble"),
        (5, "{pin: [hub, 1], at: D}", "ok"),
    ],
)
def test_a_rolling_wheel_leaves_no_guide_behind(
    ground: float, guide: str, status: str, want: tuple[str, ...]
) -> None:
    """A wheel of 2 on the flat keeps to a straight guide, and one on a hump of 5 about D to an arm from D;
    on a hump or in a hollow a straight guide holds it fast, whatever of it is asked."""
    text = f"""icsolve: 1
points: {{C: [0, 2], P: [0, 0], D: [0, {-ground or -5}]}}
links: {{1: [D], hub: [D]}}
joints:
  - {guide}
  - {{pin: [hub, wheel], at: C}}
  - {{roll: [wheel, 1], at: P, radii: [2, {ground}]}}
loads:
  F: {{force: 10, link: wheel, at: C, angle: 0}}
  T: {{torque: unknown, link: wheel}}
"""
    swept = icsolve.sweep(icsolve.load(text), drive={"wheel": [0, -1, -10, 25]}, want=want)
    assert swept.status.tolist() == ["ok", *[status] * 3]
