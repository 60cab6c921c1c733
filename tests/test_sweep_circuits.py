"""Rows beyond a limit, where branches meet without changing, and trains of wheels that only together tell
how far a link turns."""

from __future__ import annotations

import json
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest

import icsolve
import mechanisms
from icsolve.assembly.driven.order import AssemblyOrder
from icsolve.sweep.branches import Followed
from icsolve.sweep.program import RowRequest
from icsolve.sweep.request import columns_of
from icsolve.sweep.row_parts import SweepParts
from icsolve.sweep.starting_position import start_of
from sizes import FULL, sampled
from test_sweep_status import PARALLELOGRAM

CASES = Path(__file__).parent.parent / "cases"
PEAUCELLIER = icsolve.load(str(CASES / "linkages" / "peaucellier.yaml"))


@sampled(3)
@pytest.mark.parametrize("link", ["2", "3", "4", "5", "6", "7", "8"] if FULL else ["3", "4", "7"])
def test_peaucelliers_cell_draws_its_line_whichever_link_is_turned(link: str) -> None:
    """S stays on x = 4 in every row that assembles, also where the rhombus is flat (P and S meet there and
    part again each on its own side), where it is folded, and beyond a limit, which is reached by turning
    the other way round. Near the fold S is far away: its place there loses digits."""
    sweep = icsolve.sweep(PEAUCELLIER, drive={link: np.arange(0.0, 361.0, 2.0)}, want=("points", "status"))
    x = sweep.points["S"][:, 0]
    placed = np.isfinite(x)
    assert placed.sum() > 70
    assert set(sweep.status[~placed]) <= {"cannot-assemble", "change-point"}
    assert np.abs(x[placed] - 4.0).max() < 1e-9
    assert sweep.points["S"][180] == pytest.approx(sweep.points["S"][0], rel=1e-9)


def test_power_of_peaucelliers_cell_in_every_row() -> None:
    """S runs at (L^2 - s^2) / (4 q cos^2(phi / 2)) w8: the torque is 30 times that."""
    turned = np.arange(0.0, 361.0, 1.0)
    sweep = icsolve.sweep(PEAUCELLIER, drive={"8": turned}, want=("answers", "status"))
    phi = np.radians(60.0 + turned)
    torque = 30.0 * 2.0 / np.cos(phi / 2.0) ** 2
    known = np.isfinite(sweep.answers["T18"])
    assert known.sum() > 230
    assert sweep.answers["T18"][known] == pytest.approx(torque[known], rel=1e-9)


def test_a_branch_that_is_met_beyond_a_limit_is_the_one_of_the_other_way_round() -> None:
    """Rows far from the case as written, alone: as in the whole turn."""
    whole = icsolve.sweep(PEAUCELLIER, drive={"2": np.arange(0.0, 361.0, 10.0)}, want=("points", "status"))
    some = icsolve.sweep(PEAUCELLIER, drive={"2": np.arange(220.0, 240.0, 10.0)}, want=("points", "status"))
    back = icsolve.sweep(PEAUCELLIER, drive={"2": np.arange(-140.0, -120.0, 10.0)}, want=("points", "status"))
    for name in ("B", "S"):
        assert some.points[name] == pytest.approx(whole.points[name][22:24], rel=1e-12)
        assert some.points[name] == pytest.approx(back.points[name], rel=1e-12)


def followed(case: icsolve.Case, link: str) -> list[Followed]:
    """The lines on which a link is turned, half a turn to both sides; none where it cannot be turned."""
    columns = columns_of(case, None, {link: np.array([-180.0, 180.0])})
    try:
        start = start_of(case, columns, RowRequest())
        return [part.followed for part in SweepParts(start, columns).all() if part.followed]
    except icsolve.SceneError:
        return []


@sampled(3)
@pytest.mark.parametrize("seed", range(100) if FULL else (8, 13, 26, 57, 79))
def test_at_every_change_point_the_motion_goes_straight_on(seed: int) -> None:
    """Chains of four-bars that fold, whichever link is turned: after a change point each point goes on as it
    came (to a tenth of a step of 0.01 degree, beside which its way is straight), also where several branches
    change at once, where two points coincide, and in parts to which no motion leads."""
    try:
        case = icsolve.load(json.dumps(mechanisms.loaded(mechanisms.folding, Random(seed))) + "\n")
        icsolve.solve(case)
    except icsolve.SceneError:
        pytest.skip("it does not assemble, or is locked as drawn")
    places = 0
    for link in list(case.links)[1:]:
        for way in followed(case, link):
            touches = {at for passing in way.passed.values() for at in passing.change_points}
            for at in sorted({round(at, 3) for at in (*touches, *way.tracker.passages()) if abs(at) < 180.0}):
                rows = at + np.array([-0.03, -0.02, 0.02, 0.03])
                found = icsolve.sweep(case, drive={link: rows}, want=("points", "status"))
                if set(found.status) == {"ok"}:
                    places += 1
                    # of links that the answer does not need, and that do not reach, a row has no place
                    told = [column for column in found.points.values() if np.isfinite(column).all()]
                    before, last, first, after = np.stack(told, axis=1)
                    step = np.abs(last - before).max()
                    assert first - last == pytest.approx(4.0 * (last - before), abs=0.4 * step), (link, at)
                    assert first - last == pytest.approx(4.0 * (after - first), abs=0.4 * step), (link, at)
    assert places or FULL


LIMITED = [(mechanisms.butterfly, 28, "8"), (mechanisms.butterfly, 32, "2"), (mechanisms.butterfly, 32, "4")]
KINDS = (mechanisms.butterfly, mechanisms.stephenson, mechanisms.watt, mechanisms.inverted_slider_crank)
EVERY = [(kind, seed, str(link)) for kind in KINDS for seed in range(40) for link in range(2, 9)]


@sampled(2)
@pytest.mark.parametrize(("kind", "seed", "link"), EVERY if FULL else LIMITED)
def test_just_beyond_a_limit_rows_are_those_of_a_whole_turn_before(kind: Any, seed: int, link: str) -> None:
    """Whichever link of a random mechanism is turned: also where doubles do not tell whether its way ends
    before a row, from 1.5e-4 degree (they know a limit to 1e-4 degree) to half a degree beyond."""
    case = icsolve.load(json.dumps(mechanisms.loaded(kind, Random(f"{kind.__name__} {seed}"))) + "\n")
    if link not in case.links:
        pytest.skip("it has no such link")
    ends = {e for way in followed(case, link) for e in (*way.tracker.ends, *way.tracker.change_points.limits)}
    offs = np.array([0.5, 0.1, 0.02, 2e-3, 9.9e-4, 9e-4, 5e-4, 3e-4, 1.5e-4])
    for end in (end for end in ends if abs(end) < 180.0):
        rows = end + np.sign(end) * offs
        here, before = (icsolve.sweep(case, drive={link: at}) for at in (rows, rows - 360.0 * np.sign(end)))
        if before.answers["U"].any():  # a torque that is always 0 needs no place
            assert here.status.tolist() == before.status.tolist(), end
            assert here.answers["U"] == pytest.approx(before.answers["U"], rel=1e-3, nan_ok=True), end


def test_ten_thousand_turns_of_an_arm_for_one_of_its_wheel() -> None:
    """The compound epicyclic reducer, driven by its slow wheel: both ratios together tell the arm's turning,
    whole turns too (at 10,000 times the wheel's)."""
    case = icsolve.load(str(CASES / "gears" / "compound_epicyclic.yaml"))
    degrees = np.array([0.0, 0.001, 0.009, 0.0135, 90.0, 360.0])
    sweep = icsolve.sweep(case, drive={"5": degrees}, want=("answers", "points", "rates", "status"))
    assert (sweep.status == "ok").all()
    assert sweep.answers["T15"] == pytest.approx(-30.0, rel=1e-10)
    arm = np.radians(1e4 * degrees)
    assert sweep.points["P"] == pytest.approx(100.0 * np.stack([np.cos(arm), np.sin(arm)], axis=1), abs=1e-6)


@sampled(3, "start", "rows")
@pytest.mark.parametrize("start", [20.0, 60.0, 100.0])
@pytest.mark.parametrize("rows", [[180.0], [100.0, 180.0, 181.0], [175.0, 180.0, 185.0]])
def test_a_group_at_its_change_point_says_so(
    monkeypatch: pytest.MonkeyPatch, start: float, rows: list[float]
) -> None:
    """The parallelogram without closed forms, a row exactly in line: also as the last of the way."""
    monkeypatch.setattr(AssemblyOrder, "_at_intersection", lambda self: iter(()))
    near = 2.0 + np.cos(np.radians(start)), np.sin(np.radians(start))
    text = PARALLELOGRAM.replace("AB: 60", f"AB: {start}").replace("[2.5, 0.9]", f"[{near[0]}, {near[1]}]")
    sweep = icsolve.sweep(icsolve.load(text), {"angles.AB": rows})
    assert sweep.status[rows.index(180.0)] == "change-point"


def test_known_centres_that_hold_a_mechanism_are_refused_by_name() -> None:
    """13.10 is known by its centres alone: no link of it can be moved."""
    case = icsolve.load(str(CASES / "ch13" / "13_10_black_box.yaml"))
    with pytest.raises(icsolve.SceneError, match="given centre of links") as refusal:
        icsolve.sweep(case, drive={"5": [0.0, 1.0]})
    assert refusal.value.status == "unsupported"


def test_a_row_exactly_at_a_limit_has_a_bound() -> None:
    """Chebyshev's lambda, driven by its rocker to where crank and coupler are in line: 3 = 5 - 2 as written,
    so that C is at (0, -3) and B at (0, -5), and the torque 75 N m. The last digit of a double would be worth
    the root of it there; in the decimals as written nothing is lost."""
    case = icsolve.load(str(CASES / "linkages" / "chebyshev_lambda.yaml"))
    want = ("answers", "status", "error", "points")
    sweep = icsolve.sweep(case, drive={"4": [90.0, 100.0]}, want=want)
    assert sweep.status[0] == "ok"
    assert sweep.points["B"][0] == pytest.approx([0.0, -5.0], abs=1e-12)
    assert abs(sweep.answers["T12"][0] + 75.0) <= sweep.error["T12"][0]
    assert (sweep.error["T12"] < 1e-9).all()
    assert (sweep.errors["points"]["B"] < 1e-12).all()


@pytest.mark.parametrize("side", [0.4, -0.4])
def test_a_figure_written_where_its_circles_only_touch_goes_on_as_near_says(side: float) -> None:
    """A four-bar with coupler and rocker in line: as its angle grows, C comes to the side of `near`."""
    case = icsolve.load(f"""icsolve: 1
points: {{A: [0, 0], D: [4, 0]}}
lengths: {{AB: 1, BC: 3, CD: 2}}
angles: {{AB: 180}}
near: {{C: [2.2, {side}]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 1], at: D}}
loads: {{M: {{torque: 5, link: 4}}, T12: {{torque: unknown, link: 2}}}}
""")
    rows = icsolve.sweep(case, {"angles.AB": [170.0, 190.0, 200.0]}, ("points",))
    assert (rows.points["C"][:, 1] * side > 0.0).tolist() == [False, True, True]
