"""Positions found in a sweep, to the last digit: where it locks, where the answer peaks or takes a value."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from decimal import Decimal, localcontext
from functools import lru_cache
from itertools import pairwise
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf

import icsolve
from icsolve.assembly import newton
from icsolve.bench.full_turn import FOUR_BAR_CASE
from icsolve.errors import CaseError, SceneError
from icsolve.numbers import Scalar
from icsolve.numbers.decimals import CONTEXT
from icsolve.numbers.record import Record
from icsolve.numbers.roots import closed_in
from icsolve.statics.power import loads_to_find
from icsolve.sweep import find_by_scenes, rows_by_scenes
from icsolve.sweep.continuation import PathSegment
from icsolve.sweep.find_on_record import Query, RangeSearch, find
from icsolve.sweep.path_tracking import PathTracker
from icsolve.sweep.varied_numbers import numbers_of
from library import FILES, sample
from shell import exit_status
from sizes import FULL, crossed, few, sampled
from test_sweep_status import FOUR_BAR, PARALLELOGRAM, SLIDER_CRANK

mp.dps = 60
CASES = Path(__file__).parent.parent / "cases"
PRESS = """icsolve: 1
units: {length: in, force: lbf}
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 1, BC: 3.5, CD: 2.5, DE: 1.5}
angles: {AB: 60, CDE: 0}
near: {C: [3.5, 2.4]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads: {P: {force: 100, link: 4, at: E, angle: 180}, T12: {torque: unknown, link: 2}}
"""
YOKE = """icsolve: 1
points: {A: [0, 0], B: [0.3, 0.4], C: [0.3, 1]}
joints:
  - {pin: [1, 2], at: A}
  - {slot: [2, 3], at: B, along: 90}
  - {slide: [3, 1], at: C, along: 0}
loads: {P: {force: 8, link: 3, at: C, angle: 0}, T: {torque: unknown, link: 2}}
"""
PEAKS = [(335.0, 379.0, 1.0, 335.45462335342813), (60.0, 105.0, 5.0, 103.43328155257909)]
NOT_DEAD = [
    ("steelyard", "beam", np.array([-180.0, 180.0])),
    ("roberval_balance", "2", np.array([-180.0, 180.0])),
    ("double_butterfly", "2", np.array([-20.1, -19.9])),
]


def found(text: str, path: str, values: np.ndarray, query: Query) -> list[tuple[str, float, float | None]]:
    """Kind, place and answer of every position."""
    spots = find(icsolve.load(text), {path: values}, query)
    return [(spot.kind, spot.at, spot.answer) for spot in spots]


DEGREES = np.arange(0.0, 361.0, 3.0)
UNKNOWN_FORCE = (
    SLIDER_CRANK.replace("P_", "unknown").replace("T_", "100").replace("[unknown, 0]", "[unknown, 7]")
)
UNKNOWN_TORQUE = (
    SLIDER_CRANK.replace("P_", "2000").replace("T_", "unknown").replace("[unknown, 0]", "[unknown, 7]")
)


def test_dead_centres_of_an_offset_slider_crank() -> None:
    """Crank and rod in line: sin = 7/210 stretched, and 7/110 (plus half a turn) folded."""
    spots = found(UNKNOWN_FORCE, "angles.AB", DEGREES, Query("dead"))
    stretched, folded = np.degrees(np.arcsin(7 / 210)), 180.0 + np.degrees(np.arcsin(7 / 110))
    assert [kind for kind, _, _ in spots] == ["dead", "dead"]
    assert [at for _, at, _ in spots] == pytest.approx([stretched, folded], rel=1e-15)


def test_the_limits_of_a_rocker() -> None:
    """Crank and rod in line, at 4.5 and 2.5 from A: by the law of cosines at D."""
    spots = found(FOUR_BAR, "angles.DC", DEGREES, Query("dead"))
    ends = [180.0 - np.degrees(np.arccos((16.0 + 6.25 - r * r) / 20.0)) for r in (4.5, 2.5)]
    places = sorted([*ends, *(360.0 - end for end in ends)])
    assert [kind for kind, _, _ in spots] == ["limit"] * 4
    assert [at for _, at, _ in spots] == pytest.approx(places, abs=1e-11)


def test_change_points_to_the_last_digit() -> None:
    spots = found(PARALLELOGRAM, "angles.AB", np.arange(20.0, 340.0, 7.0), Query("dead"))
    assert [(kind, round(at, 12)) for kind, at, _ in spots] == [("change-point", 180.0)]


def test_what_is_only_sampled_is_said() -> None:
    """Beside a change point no bound shows that none is missed; away from it they do."""
    case = icsolve.load(PARALLELOGRAM.replace("T14", "W: {weight: 5, link: 3, at: C}, T14"))
    for query in (Query("value", "T12", -9.0), Query("max"), Query("dead")):
        beside, away = (find(case, {"angles.AB": rows}, query) for rows in ([20.0, 340.0], [20.0, 160.0]))
        assert any("beside a change point" in note for note in beside.notes)
        assert away.notes == ()


def test_what_is_the_same_everywhere_has_no_peak() -> None:
    """Crank and rocker of a parallelogram turn alike, so that their torques are opposite and equal."""
    for torque in (10.0, 0.1, 1 / 3):
        case = icsolve.load(PARALLELOGRAM.replace("torque: 10", f"torque: {torque}"))
        spots = find(case, {"angles.AB": [20.0, 340.0]}, Query("max"))
        assert (list(spots), spots.notes) == ([], ())


def test_where_the_torque_is_zero_and_where_it_has_a_value() -> None:
    """The zeros are the dead centres; at the others the solver gives the value that was asked."""
    zeros = found(UNKNOWN_TORQUE, "angles.AB", DEGREES, Query("value", "T", 0.0))
    dead = found(UNKNOWN_FORCE, "angles.AB", DEGREES, Query("dead"))
    assert [at for _, at, _ in zeros] == pytest.approx([at for _, at, _ in dead], rel=1e-15)
    for value in (5e4, -5e4):
        spots = found(UNKNOWN_TORQUE, "angles.AB", DEGREES, Query("value", "T", value))
        assert len(spots) == 2
        assert [answer for _, _, answer in spots] == pytest.approx([value] * 2, rel=1e-13)


DRUM = """icsolve: 1
points: {A: [0, 0], B: [0.2, -1]}
joints:
  - {pin: [1, 2], at: A}
  - {rope: [A, B], on: [2, 3], radii: {A: 0.2}, wraps: {A: cw}}
  - {slide: [3, 1], at: B, along: 90}
loads: {W: {weight: 100, link: 3, at: B}, P: {torque: unknown, link: 2, turns: cw}}
"""
WHEELS = """icsolve: 1
points: {A: [0, 0], D: [4, 0]}
joints: [{pin: [1, 2], at: A}, {pin: [1, 3], at: D}, {gears: [2, 3], teeth: [20, 50]}]
loads: {M: {torque: 8, link: 2}, P: {torque: unknown, link: 3}}
"""
SLIDES = """icsolve: 1
points: {A: [0, 0], B: [1, 0]}
joints:
  - {slide: [2, 1], at: A, along: 0, mu: 0.1}
  - {slide: [3, 1], at: B, along: 90}
  - {slide: [3, 2], at: B, along: 45}
motion: {point: A, link: 2, speed: 1, angle: 0}
loads: {W: {weight: 100, link: 3, at: B}, P: {force: unknown, link: 2, at: A, angle: 180}}
"""
LIFT = """icsolve: 1
points: {A: [0, 0], B: [unknown, 0]}
lengths: {AC: 1, BC: 1, CD: 1, CE: 1}
angles: {AC: 25, ACD: 180, BCE: 180}
near: {B: [1.8, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: C}
  - {slot: [3, 1], at: B, along: 0}
loads: {W: {weight: 4, link: 2, at: D}, P: {force: unknown, link: 3, at: E, angle: 90}}
"""
CONSTANT = {
    "drum": (DRUM, {}, {"2": [-90.0, 45.0]}, -20.0),
    "wheels": (WHEELS, {}, {"3": [0.0, 700.0]}, 20.0),
    "wheels by a number that moves nothing": (WHEELS, {"points.A.y": [-1.0, 0.0]}, {}, 20.0),
    "slides that rub": (SLIDES, {"points.A.x": [0.0, 2.0]}, {}, 90.0),
    "lift": (LIFT, {"angles.AC": [20.0, 60.0]}, {}, 4.0),
}


@sampled(2)
@pytest.mark.parametrize("kind", CONSTANT)
def test_of_a_range_that_has_the_value_throughout_the_ends_are_told(kind: str) -> None:
    """It was said to have the value nowhere; the value of no row is told nowhere as before."""
    text, varied, driven, value = CONSTANT[kind]
    case = icsolve.load(text)
    rows = icsolve.sweep(case, varied, drive=driven)
    np.testing.assert_allclose(rows.answers["P"], value, rtol=1e-14)
    (ends,) = (varied | driven).values()
    spots = find(case, varied, Query("value", "P", value), drive=driven)
    assert [(spot.kind, spot.at, spot.answer) for spot in spots] == [("value", end, value) for end in ends]
    assert any("over whole stretches" in note for note in spots.notes)
    assert not [*find(case, varied, Query("value", "P", 1.5 * value), drive=driven)]


def test_the_peaks_of_the_torque() -> None:
    """In line, where the crank is nearly square to the rod: the derivative of the closed form vanishes."""
    text = SLIDER_CRANK.replace("P_", "2000").replace("T_", "unknown")
    spots = found(text, "angles.AB", DEGREES, Query("max"))
    assert [kind for kind, _, _ in spots] == ["max", "max"]
    at = [place for _, place, _ in spots]
    assert at[0] + at[1] == pytest.approx(360.0, rel=1e-14)
    t = np.radians(at[0])
    root = np.sqrt(160.0**2 - (50.0 * np.sin(t)) ** 2)
    slope = np.cos(t) + 50.0 * np.cos(2 * t) / root + 50.0**3 * (np.sin(t) * np.cos(t)) ** 2 / root**3
    assert slope == pytest.approx(0.0, abs=1e-14)


def test_a_pole_is_no_peak() -> None:
    assert found(UNKNOWN_FORCE, "angles.AB", np.arange(0.0, 60.0, 1.0), Query("max")) == []


def test_positions_of_a_group_that_is_followed(monkeypatch: pytest.MonkeyPatch) -> None:
    from icsolve.assembly.driven.order import AssemblyOrder

    whole = found(UNKNOWN_TORQUE, "angles.AB", DEGREES, Query("max"))
    monkeypatch.setattr(AssemblyOrder, "_at_intersection", lambda self: iter(()))
    stepped = found(UNKNOWN_TORQUE, "angles.AB", DEGREES, Query("max"))
    assert [at for _, at, _ in stepped] == pytest.approx([at for _, at, _ in whole], rel=1e-12)


def test_along_a_load_or_a_length() -> None:
    """The load at which the torque is -1000 N mm, the rod for it: each checked by the solver."""
    spots = found(UNKNOWN_TORQUE, "loads.P", np.linspace(0.0, 5000.0, 11), Query("value", "T", -1e5))
    assert [answer for _, _, answer in spots] == pytest.approx([-1e5], rel=1e-14)
    rods = found(UNKNOWN_TORQUE, "lengths.BC", np.linspace(100.0, 400.0, 11), Query("value", "T", -8e4))
    assert [answer for _, _, answer in rods] == pytest.approx([-8e4], rel=1e-12)


# --- nothing missed, nothing invented ---------------------------------------------------------------


@pytest.mark.parametrize(("first", "last", "step", "peak"), PEAKS)
def test_a_peak_in_the_first_or_the_last_interval(
    first: float, last: float, step: float, peak: float
) -> None:
    spots = find(icsolve.load(PRESS), {"angles.AB": np.arange(first, last + step, step)}, Query("max"))
    assert [spot.at for spot in spots] == [peak]


ROCKING = """icsolve: 1
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 2, BC: 2.5, CD: 1.5}
angles: {AB: 40}
near: {C: [3.5, 1.4]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads: {K: {torque: 10, link: 4}, P: {force: 6, link: 3, at: C, angle: 80}, U: {torque: unknown, link: 2}}
"""


@sampled(3)
@pytest.mark.parametrize("seed", range(30 if FULL else 10))
def test_what_is_found_does_not_depend_on_how_much_of_the_range_assembles(seed: int) -> None:
    """Of a crank that rocks 151 degrees, in ranges of up to two turns."""
    rng, case = Random(seed), icsolve.load(ROCKING)
    query = rng.choice([Query("max"), Query("value", "U", 5.0)])
    alone = [spot.at for spot in find(case, {"angles.AB": np.array([-75.0, 75.0])}, query)]
    assert len(alone) == (2 if query.kind == "max" else 3)
    for _ in range(4):
        low = rng.uniform(-75.0, 50.0)
        span = np.array([round(low, 1), round(low + rng.uniform(30.0, 500.0), 1)])
        every = sorted(s + 360.0 * turn for s in alone for turn in range(3))
        expected = [s for s in every if span[0] < s < span[1]]
        found_there = find(case, {"angles.AB": span}, query)
        assert [spot.at for spot in found_there] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("rows", [[0.0, 360.0], np.arange(0.0, 361.0, 1.0), [0.0, 100.0, 101.0, 360.0]])
def test_what_is_found_does_not_depend_on_the_rows_between(rows: list[float]) -> None:
    spots = find(icsolve.load(PRESS), {"angles.AB": rows}, Query("max"))
    assert [spot.at for spot in spots] == [103.43328155257909, 335.45462335342813]
    assert spots.notes == ()


def arm(load: str, off: str) -> str:
    """A bent arm, of which the load acts at the end of the far part."""
    loads = f"{{W: {load}, T: {{torque: unknown, link: 2}}}}"
    return f"""icsolve: 1
points: {{A: [0, 0]}}
lengths: {{AB: 2, AE: 3}}
angles: {{AB: 20, BAE: {off}}}
joints: [{{pin: [1, 2], at: A}}]
loads: {loads}
"""


KITE = """icsolve: 1
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 2, BC: 3, CD: 5}
angles: {AB: 20}
near: {C: [4.5, 2.5]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads: {P: {torque: 5, link: 4}, T: {torque: unknown, link: 2}}
"""
ROCKER = """icsolve: 1
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 2, BC: 3, CD: 3}
angles: {DC: 110}
near: {B: [1, 2]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads: {P: {torque: 5, link: 2}, T: {torque: unknown, link: 4}}
"""


def at_ends(text: str, path: str, query: Query, place: float) -> list[list[float]]:
    """What is found in ranges that end at a place, rising and falling, and in one with it inside."""
    a, b = place - 20.0, place + 20.0
    spans = [(place, b), (b, place), (a, place), (place, a), (place, place + 7.0, b), (a, b)]
    return [[at for _, at, _ in found(text, path, np.array(span), query)] for span in spans]


IN_LINE = [
    (text.replace("[unknown, 7]", "[unknown, 0]"), "angles.AB", query, place)
    for text, query in ((UNKNOWN_FORCE, Query("dead")), (UNKNOWN_TORQUE, Query("value", "T")))
    for place in (0.0, 180.0, -180.0)
]


def test_an_end_of_the_range_belongs_to_it() -> None:
    """At angles of whole decimals, whose sines are none: what lies at the very end of a range comes out
    inside of it, or beyond, by a last digit. By turned arms, an upright triangle 3-4-5 and cranks in line."""
    rng = Random(11)
    trials = [
        (KITE, "angles.AB", Query("dead"), 0.0),
        (KITE, "angles.AB", Query("dead"), 360.0),
        (PARALLELOGRAM, "angles.AB", Query("dead"), 180.0),
        (PARALLELOGRAM, "angles.AB", Query("dead"), -180.0),
        (ROCKER, "angles.DC", Query("dead"), 90.0),
        *IN_LINE,
    ]
    for _ in range(few(6)):
        off, load = rng.randint(-900, 900) / 10, rng.randint(0, 1800) / 10
        text, path = arm(f"{{force: 5, link: 2, at: E, angle: {load}}}", str(off)), "angles.AB"
        unknown = text.replace("force: 5", "force: unknown").replace("torque: unknown", "torque: 7")
        trials += [
            (text, path, Query("value", "T"), round(load - off, 1)),
            (text, path, Query("max"), round(load - off + 90.0, 1)),
            (text, path, Query("value", "T", 15.0), round(load - off + 90.0, 1)),
            (unknown, path, Query("dead"), round(load - off, 1)),
        ]
    for text, path, query, place in trials[:: 1 if FULL else 2]:
        for places in at_ends(text, path, query, place):
            assert places == pytest.approx([place], abs=1e-11), (text, query, place)


def test_an_end_of_the_range_belongs_to_it_where_groups_are_followed(monkeypatch: pytest.MonkeyPatch) -> None:
    from icsolve.assembly.driven.order import AssemblyOrder

    monkeypatch.setattr(AssemblyOrder, "_at_intersection", lambda self: iter(()))
    for text, path, query, place in IN_LINE if FULL else IN_LINE[1::3]:
        for places in at_ends(text, path, query, place):
            assert places == pytest.approx([place], abs=1e-11), (query, place)


PLATE = """icsolve: 1
points: {{A: [{b[0]}, {low}], D: [{d[0]}, {d[1]}], E: [{e[0]}, {e[1]}]}}
lengths: {{AB: 5, BC: {bars[0]}, FD: {bars[1]}, GE: {bars[2]}, CF: 3, CG: 4, FG: 5}}
angles: {{AB: {turned}}}
near: {{C: [0, 0], F: [3, 0], G: [0, 4]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 4], at: B}}, {{pin: [4, 3], at: C}}, {{pin: [3, 5], at: F}},
         {{pin: [5, 1], at: D}}, {{pin: [3, 6], at: G}}, {{pin: [6, 1], at: E}}]
loads: {{W: {{weight: 20, link: 3, at: C}}, T: {{torque: unknown, link: 2}}}}
"""


@sampled(2)
@pytest.mark.parametrize(
    ("x", "y", "bars", "side"),
    [(-3, -4, (-3, 5, -1), -2.0), (4, 3, (-3, 5, -1), -0.5)],
)
def test_the_limit_of_a_group_is_told_to_the_last_digit(x: int, y: int, bars: Any, side: float) -> None:
    """A plate on three bars that are parallel with the crank at 90 degrees: its two ways of assembling become
    one there. The limit is found inside of a range and at either end."""
    b, d, e = ((px + n * x, py + n * y) for (px, py), n in zip(((0, 0), (3, 0), (0, 4)), bars, strict=True))
    sizes = [5 * abs(n) for n in bars]
    text = PLATE.format(b=b, low=b[1] - 5, d=d, e=e, bars=sizes, turned=90.0 + side)
    rows = icsolve.sweep(icsolve.load(text), {"angles.AB": [90.0 + 1e-6 * side, 90.0 - 1e-6 * side]})
    assert rows.status.tolist() == ["ok", "cannot-assemble"]
    spans = ((85.0, 95.0), (90.0, 90.0 + 2.5 * side), (90.0 - 2.5 * side, 90.0))
    for span in spans if FULL else spans[:1] if side < -1.0 else spans[1:]:
        spots = find(icsolve.load(text), {"angles.AB": np.array(span)}, Query("dead"))
        (limit,) = (spot for spot in spots if spot.kind == "limit")
        assert abs(limit.at - 90.0) <= limit.error <= 2e-14, (span, limit)


@sampled(2)
@pytest.mark.parametrize(
    ("link", "beside"),
    [(5, 0.03), (6, 1e-8), *([(6, 1e-3), (5, 1e-5), (6, 0.03), (5, 1e-3), (6, 1e-5), (5, 1e-8)] * FULL)],
)
def test_a_value_beside_the_limit_of_a_group_is_found(link: int, beside: float) -> None:
    """A rocker that a group of three bars and a plate turns: however near to its limit, where all runs like
    the root of the distance, a load that it has there is found there."""
    starts = zip(((0, 0), (3, 0), (0, 4)), (-3, 5, -1), strict=True)
    b, d, e = ((px - n * 3, py - n * 4) for (px, py), n in starts)
    text = PLATE.format(b=b, low=b[1] - 5, d=d, e=e, bars=[15, 25, 5], turned=88.0)
    case = icsolve.load(text.replace("unknown, link: 2", f"unknown, link: {link}"))
    value = icsolve.sweep(case, {"angles.AB": [90.0 - beside]}).answers["T"][0]
    spots = find(case, {"angles.AB": np.array([85.3, 94.1])}, Query("value", "T", value))
    assert 90.0 - beside in [pytest.approx(spot.at, abs=1e-12) for spot in spots]
    peaks = [find(case, {"angles.AB": np.array([30.0, end])}, Query("max", "T")) for end in (89.9, 94.1)]
    assert [spot.at for spot in peaks[0]] == [pytest.approx(spot.at, rel=1e-12) for spot in peaks[1]]


@sampled(2)
@pytest.mark.parametrize("beside", [1e-3, 1e-8, *([1e-5] * FULL)])
def test_a_value_beside_the_limit_of_two_rods_behind_a_group_is_found(beside: float) -> None:
    """Two rods on a plate that three bars hold are in line at 88.3 degrees."""
    starts = zip(((0, 0), (3, 0), (0, 4)), (-3, 5, -1), strict=True)
    b, d, e = ((px - n * 3, py - n * 4) for (px, py), n in starts)
    text = PLATE.format(b=b, low=b[1] - 5, d=d, e=e, bars=[15, 25, 5], turned=88.0)
    rows = icsolve.sweep(icsolve.load(text), {"angles.AB": [88.0, 88.3]}, want=("points",))
    away, (x, y) = rows.points["F"][1] - rows.points["F"][0], rows.points["F"][1]
    far = 10.0 * away / np.hypot(*away)
    text = text.replace("A: [", f"K: [{x - far[0]}, {y - far[1]}], A: [").replace(
        "AB: 5", "AB: 5, FH: 4, KH: 6"
    )
    near = (x - 0.5 * far[0] - 0.1 * far[1], y - 0.5 * far[1] + 0.1 * far[0])
    text = text.replace("near: {", f"near: {{H: [{near[0]}, {near[1]}], ")
    text = text.replace(
        "at: E}]", "at: E}, {pin: [3, 7], at: F}, {pin: [7, 8], at: H}, {pin: [8, 1], at: K}]"
    )
    case = icsolve.load(text.replace("unknown, link: 2", "unknown, link: 8"))
    value = icsolve.sweep(case, {"angles.AB": [88.3 - beside]}).answers["T"][0]
    spots = find(case, {"angles.AB": np.array([85.3, 89.1])}, Query("value", "T", value))
    assert 88.3 - beside in [pytest.approx(spot.at, abs=1e-9) for spot in spots]


@sampled(2)
@pytest.mark.parametrize(
    ("k", "rods"), [((-7.75, 2.03), (6.906, 18.066109)), ((9.86, -6.89), (6.135, 3.503728))]
)
def test_the_end_of_a_group_is_no_limit_where_what_lies_behind_it_reaches_on_neither_side(
    k: tuple[float, float], rods: tuple[float, float]
) -> None:
    """A plate that three bars let go to 90 degrees turns two rods that are in line some 0.01 or 0.001 degree
    before: that is the one limit. The rows to both sides of it, 1e-6 away, say so."""
    starts = zip(((0, 0), (3, 0), (0, 4)), (-3, 5, -1), strict=True)
    b, d, e = ((px - n * 3, py - n * 4) for (px, py), n in starts)
    text = PLATE.format(b=b, low=b[1] - 5, d=d, e=e, bars=[15, 25, 5], turned=85.0)
    f = icsolve.sweep(icsolve.load(text), {"angles.AB": [85.0]}, want=("points",)).points["F"][0]
    middle, across = (f + k) / 2.0, 0.3 * np.array([f[1] - k[1], k[0] - f[0]])
    h = [*map(float, middle + across)]
    text = text.replace("A: [", f"K: [{k[0]}, {k[1]}], A: [").replace("near: {", f"near: {{H: {h}, ")
    text = text.replace("AB: 5", f"AB: 5, FH: {rods[0]}, KH: {rods[1]}")
    text = text.replace(
        "at: E}]", "at: E}, {pin: [3, 7], at: F}, {pin: [7, 8], at: H}, {pin: [8, 1], at: K}]"
    )
    case = icsolve.load(text.replace("unknown, link: 2", "unknown, link: 8"))
    spots = find(case, {"angles.AB": np.array([87.0, 91.0])}, Query("dead"))
    (limit,) = (spot.at for spot in spots if spot.kind == "limit")
    assert 89.98 < limit < 89.9995
    rows = icsolve.sweep(case, {"angles.AB": [limit - 1e-6, limit + 1e-6, 90.0 - 1e-6]})
    assert rows.status.tolist() == ["ok", "cannot-assemble", "cannot-assemble"]


@sampled(3)
@pytest.mark.parametrize("beside", [0.05, 1e-3, 1e-5])
def test_a_value_beside_a_limit_is_found_with_friction(beside: float) -> None:
    """The same of a rocker whose crank rubs, by scenes: at 90 degrees its links are in line."""
    text = ROCKER.replace("at: A}", "at: A, mu: 0.2, radius: 0.1}") + "motion: {link: 4, turns: ccw}\n"
    text = text.replace("torque: 5, link: 2", "torque: 5, link: 3").replace(
        "unknown, link: 4", "unknown, link: 2"
    )
    case = icsolve.load(text)
    value = icsolve.sweep(case, {"angles.DC": [90.0 + beside]}).answers["T"][0]
    spots = find(case, {"angles.DC": np.array([50.3, 130.0])}, Query("value", "T", value))
    assert 90.0 + beside in [pytest.approx(spot.at, abs=1e-9) for spot in spots]


@sampled(2)
@pytest.mark.parametrize("side", [2.0, -0.5])
def test_a_change_point_of_a_group_is_told_as_the_rows_tell_it(side: float) -> None:
    """A plate whose bars let it go on through the position in which they are parallel."""
    points = {"b": (12, -16), "d": (0, 4), "e": (6, -4), "low": -21}
    text = PLATE.format(**points, bars=[20, 5, 10], turned=90.0 + side)
    case = icsolve.load(text)
    rows = icsolve.sweep(case, {"angles.AB": [85.0, 90.0, 95.0]})
    assert rows.status.tolist() == ["ok", "change-point", "ok"]
    for span in ((85.0, 95.0), (90.0, 95.0), (85.0, 90.0)):
        (spot,) = find(case, {"angles.AB": np.array(span)}, Query("dead"))
        assert spot.kind == "change-point"
        assert abs(spot.at - 90.0) <= spot.error <= 1e-5


@sampled(2)
@pytest.mark.parametrize("below", [1e-3, 1e-6, 1e-9, 1e-12])
def test_a_value_just_below_a_peak_is_taken_twice(below: float) -> None:
    """As far from the peak as the root of what is below it; just above, nowhere."""
    case, rows = icsolve.load(PRESS), {"angles.AB": [200.0, 360.0]}
    (peak,) = find(case, rows, Query("max"))
    assert peak.answer is not None
    pair = find(case, rows, Query("value", "T12", peak.answer * (1.0 - below)))
    assert len(pair) == 2
    assert pair[0].at < peak.at < pair[1].at
    wide = find(case, rows, Query("value", "T12", peak.answer * (1.0 - 1e-4)))
    ratio = (pair[1].at - pair[0].at) / (wide[1].at - wide[0].at)
    assert ratio == pytest.approx(np.sqrt(below / 1e-4), rel=0.05)
    assert find(case, rows, Query("value", "T12", peak.answer * (1.0 + below))) == []


def test_a_value_that_is_only_touched() -> None:
    """The torque of a Scotch yoke is P r sin(angle): 4 is its peak, taken once, and -4 the other."""
    written = np.degrees(np.arctan2(0.4, 0.3))
    for value, quarter in ((4.0, 90.0), (-4.0, 270.0)):
        spots = find(icsolve.load(YOKE), None, Query("value", "T", value), drive={"2": [0.0, 359.0]})
        assert [spot.at for spot in spots] == pytest.approx([quarter - written], rel=1e-14)


@sampled(2)
@pytest.mark.parametrize(("name", "link", "rows"), NOT_DEAD)
def test_no_dead_centre_where_the_scene_has_none(name: str, link: str, rows: np.ndarray) -> None:
    """A steelyard upright balances whatever hangs on it, and so does a Roberval balance; where a group of
    links is singular and the answer goes on, nothing locks."""
    case = icsolve.load(str(next(CASES.rglob(f"{name}.yaml"))))
    assert [spot for spot in find(case, None, Query("dead"), drive={link: rows}) if spot.kind == "dead"] == []


@pytest.mark.parametrize("seed", range(6))
def test_places_to_the_last_digit(seed: int) -> None:
    """Dead centres of random offset slider-cranks and limits of rockers, by closed forms in sixty digits."""
    rng = Random(seed)
    r, rod, e = (rng.randint(*span) for span in ((300, 600), (900, 2000), (-200, 200)))
    text = UNKNOWN_FORCE.replace("AB: 50", f"AB: {r / 10}").replace("BC: 160", f"BC: {rod / 10}")
    text = text.replace("[unknown, 7]", f"[unknown, {e / 10}]").replace("[195, 0]", f"[{rod / 10}, 0]")
    stretched, folded = mp.asin(mpf(e) / (rod + r)), mp.pi + mp.asin(mpf(e) / (rod - r))
    exact = sorted(float(mp.degrees(x) % 360) for x in (stretched, folded))
    spots = find(icsolve.load(text), {"angles.AB": [0.0, 360.0]}, Query("dead"))
    assert [spot.at for spot in spots] == exact
    assert all(0.0 < spot.error <= 2.0**-52 * spot.at for spot in spots)
    d, a, c = (mpf(rng.randint(*span)) / 100 for span in ((350, 450), (60, 120), (200, 280)))
    b = d - mpf(rng.randint(20, 60)) / 100
    text = FOUR_BAR.replace("D: [4, 0]", f"D: [{d}, 0]").replace("DC: 100", "DC: 110")
    text = text.replace("{AB: 1, BC: 3.5, CD: 2.5}", f"{{AB: {a}, BC: {b}, CD: {c}}}")
    ends = [180 - mp.degrees(mp.acos((d * d + c * c - q * q) / (2 * d * c))) for q in (a + b, b - a)]
    spots = find(icsolve.load(text), {"angles.DC": [60.0, 180.0]}, Query("dead"))
    limits = [spot.at for spot in spots if spot.kind == "limit"]
    assert limits == sorted(float(end) for end in ends if 60 < end < 180)


def test_with_friction_each_position_is_a_scene_of_its_own() -> None:
    """A block on a floor, pulled at an angle: the pull is P mu / (cos + mu sin), least where tan is mu and
    largest at the ends; it takes a value on both sides."""
    text = """icsolve: 1
points: {A: [0, 0], B: [3, 0]}
joints: [{slide: [2, 1], at: A, along: 0, mu: 0.4}]
links: {2: [B]}
loads:
  W: {weight: 100, link: 2, at: A}
  P: {force: unknown, link: 2, at: A, angle: 5}
motion: {point: A, link: 2, speed: 1, angle: 0}
"""
    case = icsolve.load(text)
    spots = find(case, {"loads.P.angle": [0.0, 60.0]}, Query("value", "P", 38.0))
    for spot in spots:
        a = np.radians(spot.at)
        assert 40.0 / (np.cos(a) + 0.4 * np.sin(a)) == pytest.approx(38.0, rel=1e-9)
    assert len(spots) == 2
    assert "scene of its own" in spots.notes[0]


BRAKE = """
icsolve: 1
points: {O: [0, 0], A: [-150, -250], C: [150, -250], L: [600, 1e-6]}
joints:
  - {pin: [1, 2], at: O}
  - {pin: [2, 3], at: A}
  - {rope: [A, O, C], on: [1, 2, 3], radii: {O: 150}, wraps: {O: cw}, mu: {O: 0.3}}
loads:
  M: {torque: 90, link: 2}
  P: {force: unknown, link: 3, at: L, angle: -90}
motion: {link: 2, turns: ccw}
"""


def test_places_are_closed_in_on_together_and_the_figure_is_followed_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Each sweep would follow it anew, by hundreds of steps to each place: the last one is kept."""
    sweeps: list[int] = []
    lines: list[tuple[float, float]] = []
    swept, followed = find_by_scenes.sweep, PathTracker._followed

    def sweep(*given, **named):  # type: ignore[no-untyped-def]
        sweeps.append(1)
        return swept(*given, **named)

    def follow(self: PathTracker, reach: tuple[float, float]) -> list[PathSegment]:
        lines.append(reach)
        return followed(self, reach)

    monkeypatch.setattr(find_by_scenes, "sweep", sweep)
    monkeypatch.setattr(find_by_scenes, "PLACES", 24)
    monkeypatch.setattr(PathTracker, "_followed", follow)
    places = find(icsolve.load(BRAKE), None, Query("dead"), drive={"2": [-180.0, 180.0]})
    assert [place.kind for place in places] == ["limit", "limit"]
    assert len(sweeps) <= 30
    assert len(lines) <= 4


@sampled(2)
@pytest.mark.parametrize(("span", "least", "most"), [((0.0, 1e-9), 13, 13), ((10.0, 40.0), 22, 28)], ids=str)
def test_searches_for_a_figure_that_does_not_assemble_are_bounded(
    span: tuple[float, float], least: int, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Points of ten links that only all their data place: the range is searched closely where they assemble,
    and the note says at how many places."""
    searched, spent = newton._searched.__wrapped__, []

    def counted(*figure: Any) -> newton.Converged:
        outcome = searched(*figure)
        spent.extend([] if outcome.groups else [1])
        return outcome

    monkeypatch.setattr(newton, "_searched", lru_cache(counted))
    monkeypatch.setattr(newton, "MOST_WORK", 5_000)
    monkeypatch.setattr(rows_by_scenes, "can_share", lambda: False)
    text = (Path(__file__).parent / "data" / "found" / "wrongmode_1.yaml").read_text()
    spots = find(icsolve.load(text), {"lengths.P9-P10": np.array(span)}, Query("max"))
    assert not spots
    (places,) = (n for n in range(400) if f"at {n} places" in spots.notes[0])
    assert least <= places <= most
    assert len(spent) <= 20


def test_a_jump_past_the_value_is_no_place_of_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """The guided bracket jams between a push down its guide and a pull up: no answer is found there."""
    text = """icsolve: 1
points: {O: [0, 0], X: [10, 3]}
joints: [{slide: [2, 1], at: O, along: 90, mu: 0.25, length: 6}]
motion: {point: O, link: 2, speed: 1, angle: 270}
loads: {W: {weight: 60, link: 2, at: X}, P: {force: unknown, link: 2, at: O, angle: 90}}
"""
    monkeypatch.setattr(find_by_scenes, "PLACES", 9)
    for value, places in ((1.0, []), (20.0, [30.0])):
        spots = found(text, "loads.P.angle", np.array([-35.0, 55.0]), Query("value", "P", value))
        assert [at for _, at, _ in spots] == pytest.approx(places)


def test_what_is_unbounded_in_a_cell_leaves_it_undecided_without_a_warning() -> None:
    """A quotient over cells that hold a zero of its divisor, where the slope of the answer is sought."""
    text = (Path(__file__).parent / "data" / "found" / "zero_bound0.yaml").read_text()
    for spot in find(icsolve.load(text), None, Query("max"), drive={"4": [-180.0, 180.0]}):
        assert spot.answer is not None


def test_what_cannot_be_looked_for() -> None:
    case = icsolve.load(UNKNOWN_TORQUE)
    with pytest.raises(ValueError, match="has one value: give FROM:TO:STEP"):
        find(case, {"angles.AB": 60.0}, Query("dead"))
    with pytest.raises(ValueError, match="one varied number"):
        find(case, {"angles.AB": [0.0, 1.0], "loads.P": [1.0, 2.0]}, Query("dead"))
    with pytest.raises(ValueError, match="no unknown load"):
        find(case, {"angles.AB": [0.0, 1.0]}, Query("value", "P", 1.0))


@pytest.mark.parametrize(
    ("function", "zeros"),
    [
        (lambda s: 1 / (s - Decimal("0.3")), []),
        (lambda s: (s - Decimal("0.3")) ** 3, ["0.3"]),
        (lambda s: (s - Decimal("0.3")) / (s + Decimal("1e-6")), ["0.3"]),
        (lambda s: (s + Decimal("1e-9")) * (s - Decimal("0.3")) * (1 + Decimal("1e-9") - s), ["0.3"]),
    ],
)
def test_a_pole_is_no_zero_and_costs_few_values(
    function: Callable[[Decimal], Decimal], zeros: list[str]
) -> None:
    asked = []

    def counted(s: Decimal) -> Decimal:
        asked.append(s)
        return function(s)

    with localcontext(CONTEXT):
        found = list(closed_in(counted, Decimal(0), Decimal(1)))
    assert [round(float(s), 12) for s in found] == [float(s) for s in zeros]
    assert zeros or len(asked) < 100


@pytest.mark.parametrize("order", [1, 3, 5, 7])
@pytest.mark.parametrize(
    "beside", [lambda s: Decimal(2), lambda s: 1 + 50 * s, lambda s: (7 * s).exp(), lambda s: 1 / (2 - s)]
)
def test_a_zero_of_any_odd_order_costs_few_values(order: int, beside: Callable[[Decimal], Decimal]) -> None:
    """Where links fold up determinants have zeros of third order; false position of the values
    halves its steps there at best (300 values), of their roots it is as quick as at a simple zero."""
    asked = []

    def counted(s: Decimal) -> Decimal:
        asked.append(s)
        return (s - place) ** order * beside(s)

    with localcontext(CONTEXT):
        place = Decimal(2).sqrt() / 3
        (found,) = closed_in(counted, Decimal(0), Decimal(1))
        assert abs(found - place) < Decimal("1e-44")
    assert len(asked) < 50


@pytest.mark.parametrize("order", [1, 2, 6])
@pytest.mark.parametrize("zeros", [0, 1])
def test_what_vanishes_over_a_whole_cell_has_no_zeros_there(order: int, zeros: int) -> None:
    """Its signs are those of rounding: the unknown does no work over a stretch of a range (a branch on which
    links have folded up), which is no row of dead centres. What has a zero at an end of the cell has it."""
    record, noise, asked = Record(), Random(7), []
    s = record.input("s", 0.5)

    def value(_: Scalar, at: Decimal) -> Decimal:
        asked.append(at)
        return at**3 if zeros else Decimal(noise.uniform(-1.0, 1.0)) * Decimal("1e-60")

    search = RangeSearch.__new__(RangeSearch)
    search.record, search._value = record, value  # type: ignore[method-assign]
    with localcontext(CONTEXT):
        found = list(search._of_cell(s, Decimal(0), Decimal(1), order))
    assert len(found) == zeros
    assert zeros or len(asked) == 3


@pytest.mark.parametrize("name", sample([name for name in FILES if name.startswith("cams/")], 2, "find"))
def test_what_turns_in_a_sweep_can_be_searched(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Also where a contact alone says where the follower is."""
    monkeypatch.setattr(find_by_scenes, "PLACES", 8)
    case, rows = icsolve.load(FILES[name]), [-5.0, 0.0, 5.0]
    for link in case.links:
        try:
            status = icsolve.sweep(case, drive={link: rows}).status.tolist()
        except icsolve.SceneError:
            continue
        if status == ["ok"] * 3:
            for spot in find(case, None, Query("max"), drive={link: rows}):
                assert abs(spot.at) <= 5.0
            return


@pytest.mark.parametrize("load", ["F.x", "F.y"])
def test_both_components_of_a_force_of_unknown_direction_are_found(load: str) -> None:
    """Two bars at 60 and -20 degrees with M on the second, F at its end: F.y cos(b) - F.x sin(b) = -M and
    F.y cos(a) - F.x sin(a) = W cos(a) with lengths of 1."""
    case = icsolve.load("""icsolve: 1
points: {A: [0, 0]}
lengths: {AB: 1, BC: 1}
angles: {AB: 60, BC: -20}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}]
loads:
  W: {weight: 9, link: 2, at: B}
  M: {torque: 8, link: 3}
  F: {force: [unknown, unknown], link: 3, at: C}
""")
    b = np.radians(-20.0)

    def held(a: float) -> np.ndarray:
        sides = np.array([[-np.sin(b), np.cos(b)], [-np.sin(a), np.cos(a)]])
        return np.linalg.solve(sides, [-8.0, 9.0 * np.cos(a)])

    (one,) = find(case, {"angles.AB": np.array([0.0, 100.0])}, Query("value", load, 3.0))
    assert one.answer == 3.0
    assert held(np.radians(one.at))["xy".index(load[-1])] == pytest.approx(3.0, abs=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_of_two_unknown_loads_each_is_linear_in_a_known_one(seed: int) -> None:
    """Of five bars with two freedoms. A line has one place and no turns, which bounds show: nothing is told
    of a search, though the known loads cancel somewhere in the range."""
    draw = Random(seed)
    unknowns = draw.sample(
        [
            "{torque: unknown, link: 2}",
            "{torque: unknown, link: 5}",
            "{force: unknown, link: 3, at: C, angle: 20}",
            "{force: unknown, link: 4, at: C, angle: 110}",
            "{force: unknown, link: 4, at: D, angle: 60}",
        ],
        2,
    )
    case = icsolve.load(
        f"""icsolve: 1
points: {{A: [0, 0], B: [0.3, 2], C: [2.6, 4.3], D: [4.1, 1.9], E: [5, 0]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 5], at: D}}
  - {{pin: [5, 1], at: E}}
loads:
  P: {{torque: 10, link: 2}}
  Q: {{torque: {draw.randint(-9, 9)}, link: 5}}
  W: {{weight: {draw.randint(1, 9)}, link: 3, at: B}}
  R: {unknowns[0]}
  S: {unknowns[1]}
"""
    )
    ends = {"loads.P": np.array([-20.0, 20.0])}
    rows = icsolve.sweep(case, ends).answers
    for load in "RS":
        first, last = rows[load]
        value = round(0.3 * first + 0.7 * last, 3)
        places, peaks = (
            find(case, ends, query) for query in (Query("value", load, value), Query("max", load))
        )
        assert (peaks, peaks.notes) == ([], ())
        if abs(last - first) > 1e-9 * abs(first):  # else it does not hang on it
            (one,), notes = places, places.notes
            assert one.at == pytest.approx(-20.0 + 40.0 * (value - first) / (last - first), rel=1e-9)
            assert not notes


@sampled(2)
@pytest.mark.parametrize("turns", ["free end", "drum"])
def test_positions_in_which_a_rope_would_have_to_push_are_left_out(turns: str) -> None:
    """A rod AB in a spring, held by a rope from B to a pulley at P: T (b x u) = -b x f, T > 0, with f of the
    weight and the spring at B and u toward P; on a drum about P the torque on the drum holds the rope."""
    rope, load = "{rope: [B, P, E], on: [2, 1]}", "{force: unknown, at: E}"
    if turns == "drum":
        rope = "{rope: [P, B], on: [3, 2], radii: {P: 0.001}, wraps: {P: ccw}}, {pin: [1, 3], at: P}"
        load = "{torque: unknown, link: 3}"
    case = icsolve.load(f"""icsolve: 1
points: {{A: [0, 0], P: [80, 90], E: [40, -20]}}
lengths: {{AB: 60}}
angles: {{AB: 20}}
joints: [{{pin: [1, 2], at: A}}, {rope}]
loads:
  W: {{weight: 100, link: 2, at: B}}
  K: {{spring: 3, free: 10, link: 2, at: B, to: [0, -90]}}
  T: {load}
""")
    at = np.linspace(-170.0, 190.0, 7201)
    b = 60.0 * np.exp(1j * np.radians(at))
    away = -90j - b
    f, u = -100j + 3.0 * (1.0 - 10.0 / np.abs(away)) * away, (80 + 90j - b) / np.abs(80 + 90j - b)
    pull = -np.imag(b.conj() * f) / np.imag(b.conj() * u)
    for value in (300.0, 50.0, -50.0, -1000.0):
        near = np.flatnonzero(((pull[:-1] - value) * (pull[1:] - value) < 0.0) & (np.abs(pull[1:]) < 1e5))
        asked = value if turns == "free end" else -0.001 * value
        spots = find(case, {"angles.AB": at[[0, -1]]}, Query("value", "T", asked))
        assert len(near) == 2
        if value < 0.0:
            named = re.findall(r"left out is angles.AB = (\S+), where the rope", " ".join(spots.notes))
            assert spots == []
            assert sorted(map(float, named)) == pytest.approx(at[near], abs=0.06)
        else:
            assert [spot.at for spot in spots] == pytest.approx(at[near], abs=0.06)
            assert {spot.answer for spot in spots} == {asked}


RACK = """icsolve: 1
points: {A: [0, 0], C: [unknown, 0.405], O: [15.231, 1.863], P: [15.231, -0.095]}
lengths: {AB: 2.33, BC: 8.759}
angles: {AB: 77.8}
near: {C: [9.049, 0.405]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
  - {pin: [1, 5], at: O}
  - {roll: [5, 4], at: P, radii: [1.958, 0]}
loads: {M: {torque: 52.7, link: 2}, T: {torque: unknown, link: 5}}
"""


def test_dead_centres_and_values_of_a_rack_that_a_crank_drives() -> None:
    """The pinion is held at both dead centres of the crank, whatever is divided by on the way to its torque;
    where that is 180.17 is told of the decimal, not of the double."""
    case = icsolve.load(RACK)
    rise = mpf("0.405")
    exact = [mp.degrees(mp.asin(rise / mpf("11.089"))), 180 + mp.degrees(mp.asin(rise / mpf("6.429")))]
    spots = find(case, {"angles.AB": [0.0, 300.0]}, Query("dead"))
    assert [(spot.kind, spot.at) for spot in spots] == [("dead", float(at)) for at in exact]

    def miss(degrees: mpf) -> mpf:
        x, y = (mpf("2.33") * f(mp.radians(degrees)) for f in (mp.cos, mp.sin))
        run = mp.sqrt(mpf("8.759") ** 2 - (rise - y) ** 2)
        return mpf("52.7") * mpf("1.958") / (y - (rise - y) * x / run) - mpf("180.17")

    spots = find(case, {"angles.AB": [5.0, 170.0]}, Query("value", "T", 180.17))
    assert [spot.at for spot in spots] == [float(mp.findroot(miss, mpf(guess))) for guess in (13.4, 164.3)]


SPRUNG = """icsolve: 1
points: {{B: [0.7, 0], S: [0.3, {height}], O: [0, 0]}}
links: {{1: [S, O]}}
joints: [{{slide: [2, 1], at: B, along: 0, through: O}}]
loads:
  F: {{spring: 100, free: {free}, link: 2, at: B, to: S}}
  P: {{force: unknown, link: 2, at: B, angle: 0}}
"""


@sampled(3, "height")
@pytest.mark.parametrize("height", ["0.7", "1"])
@pytest.mark.parametrize("digits", [3, 6, 8, 10, 12, None])
def test_positions_all_but_in_one_place_are_found(height: str, digits: int | None) -> None:
    """A block on a guide and a spring across it, as long at rest as it stands off, or a little longer:
    P = k (d - free) x / d is zero at x = 0 and where d = free, and largest where d^3 = free h^2; of free = h
    these are one place, with no peak (the doubles nearest to closed forms in sixty digits)."""
    h, apart = mpf(height), mpf(10) ** -digits if digits else mpf(0)
    free = mp.sqrt(h**2 + apart**2)
    case = icsolve.load(SPRUNG.format(height=height, free=mp.nstr(free, 50)))
    peak = mp.sqrt((free * h**2) ** (mpf(2) / 3) - h**2) if digits else mpf(0)
    for kind, off in (("value", apart), ("max", peak)):
        found = find(case, {"points.B.x": np.array([-1.9, 1.6])}, Query(kind, "P"))
        middle = [mpf("0.3")] if kind == "value" else []
        places = [mpf("0.3") - off, *middle, mpf("0.3") + off] if digits else middle
        assert [spot.at for spot in found] == [float(place) for place in places]


@sampled(2)
@pytest.mark.parametrize("digits", [3, 6, 8, 10, 12])
def test_positions_of_equilibrium_all_but_in_one_place_are_told_one_by_one(digits: int) -> None:
    """The same block without the force: it rests where d = free, stably, and unstably at x = 0 between them
    (stiffness k (1 - free h^2 / d^3), to the digits that the place as a double leaves of it)."""
    h, apart = mpf("0.7"), mpf(10) ** -digits
    free = mp.sqrt(h**2 + apart**2)
    text = SPRUNG.format(height=h, free=mp.nstr(free, 50)).partition("  P:")[0]
    rests = icsolve.solve(icsolve.load(text.replace("B: [0.7,", "B: [{unknown: [-1.9, 1.6]},"))).positions
    assert [rest.stability for rest in rests] == ["stable", "unstable", "stable"]
    for rest, off in zip(rests, (-apart, mpf(0), apart), strict=True):
        assert abs(rest.at["points.B.x"] - (mpf("0.3") + off)) <= rest.error["points.B.x"] <= 2.0**-54
        stiffness = 100 * (1 - free * h**2 / mp.hypot(h, off) ** 3)
        assert rest.stiffness.value == pytest.approx(float(stiffness), rel=1e-15 * 10**digits)


def test_a_limit_that_two_points_share_is_told_once() -> None:
    """Both corners of Peaucellier's rhombus come into line with its arms where OP = L - s, at 120 degrees."""
    case = icsolve.load(FILES["linkages/peaucellier.yaml"])
    (spot,) = find(case, {"angles.QP": np.array([-110.0, 230.0])}, Query("dead"))
    assert (spot.at, spot.kind) == (120.0, "limit")


@sampled(3)
@pytest.mark.parametrize("large", [10**7, 10**11, 10**17])
def test_loads_that_all_but_cancel_hide_no_position(large: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two equal torques against each other on the crank change nothing, however large they are."""
    monkeypatch.setattr(find_by_scenes, "PLACES", 40)
    pair = f"L1: {{torque: {large}, link: 2}}, L2: {{torque: {-large}, link: 2}}, T4:"
    plain, paired = icsolve.load(FOUR_BAR_CASE), icsolve.load(FOUR_BAR_CASE.replace("T4:", pair))
    turns = {"angles.AB": np.array([70.0, 250.0])}
    for query in (Query("value", "T2", -2.0), Query("value", "T2", 0.0), Query("max", "T2")):
        wanted, got = find(plain, turns, query), find(paired, turns, query)
        assert len(got) == len(wanted) > 0
        for one, other in zip(got, wanted, strict=True):
            assert abs(one.at - other.at) <= one.error + other.error


@pytest.mark.parametrize("large", [10**9, 10**13])
@pytest.mark.parametrize(
    "idle",
    ["{torque: LARGE, link: 2}, M: {torque: -LARGE, link: 2}", "{force: LARGE, link: 4, at: D, angle: 33}"],
)
def test_dead_centres_hang_on_no_known_load(idle: str, large: int) -> None:
    """Loads that all but cancel, and one at a pivot, leave their places what they are, to the last digit."""
    case = ROCKING.replace("torque: unknown, link: 2", "torque: unknown, link: 4")
    case = case.replace("10, link: 4", "10, link: 3").replace("2, BC: 2.5, CD: 1.5", "1, BC: 3.5, CD: 2.5")
    turns = {"angles.AB": np.array([-170.0, 190.0])}
    loaded = case.replace("loads: {", f"loads: {{L: {idle.replace('LARGE', str(large))}, ")
    alone, beside = (list(find(icsolve.load(text), turns, Query("dead"))) for text in (case, loaded))
    assert len(alone) == 2
    assert beside == alone


def told(text: str, path: str, value: float) -> str:
    """The status of a scene of its own."""
    try:
        return str(icsolve.solve(icsolve.load(text, {path: value})).status)
    except SceneError as refused:
        return str(refused.status)


@sampled(2)
@pytest.mark.parametrize("angle", ["OP", "QOP"])
def test_a_direction_that_goes_through_infinity_is_not_taken_for_its_opposite(angle: str) -> None:
    """The angle under which a block on a guide is seen, by its direction and from another line: where it is
    parallel to the guide the block is at infinity, and beyond it lies behind who looks at it."""
    for seed in range(few(6)):
        dice = Random(f"seen {seed}")
        spans = ((-1, 1), (2, 5), (-40, 40), (60, 120))
        x, y, along, start = (round(dice.uniform(*span), 2) for span in spans)
        turned = dice.choice((0, -90)) if angle == "QOP" else 0
        case = f"""icsolve: 1
points: {{O: [0, 0], Q: {[0, -1] if turned else [1, 0]}, G: [{x}, {y}]}}
angles: {{{angle}: {start - turned}}}
joints: [{{slide: [2, 1], at: P, along: {along}, through: G}}]
loads: {{F: {{force: 7, link: 2, at: P, toward: O}}, U: {{force: unknown, link: 2, at: P, angle: 130}}}}
links: {{1: [O, Q, G]}}
"""
        path = f"angles.{angle}"
        gaps = (-170, -90, -30, -1e-9, 1e-9, 30, 90, 150, 180 - 1e-9, 180 + 1e-9)
        at = [along - turned + gap for gap in gaps]
        rows = icsolve.sweep(icsolve.load(case), {path: np.array(at)}, want=("status",)).status.tolist()
        assert rows == [told(case, path, one) for one in at], case
        assert {"ok", "cannot-assemble"} <= {*rows}
        whole = {path: np.array([along - turned - 170.0, along - turned + 190.0])}
        for query in (Query("value", "U", 1e3), Query("max"), Query("dead")):
            spots = find(icsolve.load(case), whole, query)
            assert all(-1e-6 < spot.at - (along - turned) < 180.0 + 1e-6 for spot in spots), (case, query)


@sampled(3)
@pytest.mark.parametrize("span", [(-7.0, 11.0), (-5.0, 0.0), (-4.9, -4.7)])
def test_a_limit_beyond_which_a_turn_the_other_way_leads_is_told(span: tuple[float, float]) -> None:
    """The rocker of problem 13.12 stops at -4.798 degrees, where its load does no work. It comes to what lies
    beyond by nearly a turn the other way, in another way of assembling, whose rows begin right there."""
    case = icsolve.load(FILES["ch13/13_12_five_links.yaml"])
    (limit,) = find(case, None, Query("dead"), drive={"5": np.array(span)})
    assert limit.kind == "limit" and limit.error < 1e-14
    rows = icsolve.sweep(case, drive={"5": [limit.at + 1e-9, limit.at + 4e-9, limit.at - 1e-9, -5.0]})
    assert rows.status.tolist() == ["ok"] * 4
    assert rows.answers["T12"][1] == pytest.approx(2.0 * rows.answers["T12"][0], rel=1e-3)  # as a root
    assert min(rows.answers["T12"][2:]) > 100.0


@sampled(2)
@pytest.mark.parametrize(
    ("link", "sense"), [("2", -1.0), ("5", 1.0), *([("3", 1.0), ("4", -1.0), ("6", 1.0), ("7", -1.0)] * FULL)]
)
def test_a_change_point_of_several_branches_is_told_once(link: str, sense: float) -> None:
    """Within its error, which is that of doubles where a group has its singular position there too."""
    case = icsolve.load(FILES["tools/lazy_tongs.yaml"])
    (spot,) = find(case, None, Query("dead"), drive={link: sense * np.array([0.0, 36.0])})
    assert spot.kind == "change-point"
    assert abs(spot.at - sense * 28.0) <= spot.error <= (1e-5 if link in "467" else 1e-14)


READ_ANEW = ("points", "lengths", "angles")


@sampled(8)
@pytest.mark.parametrize("name", [name for name in FILES if FULL or name.startswith(("ch13/", "linkages/"))])
def test_where_links_cease_to_reach_a_limit_is_told_along_any_number_of_the_figure(name: str) -> None:
    """Wherever two rows beside each other are `ok` and `cannot-assemble`, one lies between, of a figure
    that is read anew as of one that moves; and no limit lies elsewhere."""
    case = icsolve.load(FILES[name])
    if case.space is not None or case.touches or not loads_to_find(case):
        return
    numbers = numbers_of(case)
    size = max((abs(n.value) for path, n in numbers.items() if path.startswith(READ_ANEW[:2])), default=1.0)
    paths = [path for path in numbers if path.startswith(READ_ANEW)]
    for path in paths if FULL else paths[::3]:
        value = numbers[path].value
        values = {
            "points": value + size * np.linspace(-1.0, 1.0, 121),
            "lengths": value * np.linspace(0.2, 3.0, 121),
            "angles": value + np.linspace(-170.0, 170.0, 121),
        }[path.partition(".")[0]]
        try:
            ends = ends_of(case, path, values)
        except (SceneError, CaseError):
            continue
        if not ends:
            continue
        found = find(case, {path: values[[0, -1]]}, Query("dead"))
        for low, high in ends:
            assert any(low <= one.at <= high for one in found), (path, low, high)
        for one in found:
            assert one.kind != "limit" or any(low <= one.at <= high for low, high in ends), (path, one)


def ends_of(case: icsolve.Case, path: str, values: Any) -> list[tuple[float, float]]:
    """The pairs of rows of which one assembles and the other does not; a row between may be at the limit."""
    rows = zip(values.tolist(), icsolve.sweep(case, {path: values}).status.tolist(), strict=True)
    clear = [row for row in rows if row[1] in ("ok", "cannot-assemble")]
    return [(low, high) for (low, one), (high, other) in pairwise(clear) if one != other]


TRAIN = """icsolve: 1
points:
  B: [-0.68, 3.16]
  E: [-3.48, 1.08]
  K: [-5.04, 0.16]
  F: [0.32, -1.36]
  N: [-3.48, -1.12]
  D: [-3.48, 0.08]
  G: [3, -3.88]
  H: [-3.52, 0.32]
  C: [1.6, 1.4]
  A: [-1.28, -0.16]
joints:
  - {pin: [1, 2], at: B}
  - {pin: [3, 4], at: E}
  - {slide: [3, 2], at: E, along: [E, K]}
  - {slide: [4, 1], at: F, along: -20}
  - {pin: [3, 5], at: D}
  - {roll: [4, 5], at: N, radii: [-2.2, 1.2]}
  - {pin: [6, 5], at: G}
  - {slot: [6, 3], at: H, along: 30}
links: {1: [A], 2: [E, K], 5: [C, G]}
loads:
  S: {spring: 38.5, corner: A-G-C, free: 153, link: 5}
"""


def test_zeros_where_the_scale_of_the_motion_vanishes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Links of a group are told by the motion of one of them. Where that one stands still the known loads
    have a power other than zero and the unknown a factor without bound: the answer is zero there, and the
    links rest, as the rows to both sides say."""
    probed = TRAIN + "  T: {torque: unknown, link: 6}\n"
    beside = icsolve.sweep(icsolve.load(probed), drive={"6": np.array([-15.77, -15.755])}).answers["T"]
    assert beside[0] < 0.0 < beside[1]
    path = tmp_path / "train.yaml"
    for (text, what), span in crossed([(probed, "T=0"), (TRAIN, "rest")], ["-20:-10:1", "-60:60:10"]):
        path.write_text(text)
        assert exit_status("sweep", path, "--drive", f"6={span}", "--find", what, "--json") == 0
        (found,) = json.loads(capsys.readouterr().out)["found"]
        assert found["at"]["6"] == pytest.approx(-15.762949219184383, abs=1e-12)
        assert what == "T=0" or found["stability"] == "stable"


@pytest.mark.parametrize("seed", range(20 if FULL else 6))
def test_a_place_at_zero_has_its_answer_in_whatever_order_the_joints_stand(seed: int) -> None:
    """Where the number is zero, what is found is a rounding beside it: the answer is that of the place."""
    draw = Random(f"yoke {seed}")
    joints = ["{pin: [1, 2], at: A}", "{slot: [2, 3], at: B, along: 90, through: C}"]
    joints.append("{slide: [3, 1], at: C, along: 0}")
    draw.shuffle(joints)
    case = icsolve.load(
        f"icsolve: 1\npoints: {{A: [0, 0], C: [unknown, 0]}}\nlengths: {{AB: {draw.randint(1, 9) / 10}}}\n"
        f"angles: {{AB: {draw.randint(20, 70)}}}\njoints: [{', '.join(joints)}]\ndynamic: yes\n"
        f"links: {{3: {{mass: {draw.randint(1, 9)} kg, centre: C}}}}\nmotion: {{link: 2, speed: 10}}\n"
        "loads: {T: {torque: unknown, link: 2}}\n"
    )
    (one,) = find(case, {"angles.AB": [-10.0, 70.0]}, Query("value", "T", 0.0))
    assert (one.at, one.answer) == (0.0, 0.0)
