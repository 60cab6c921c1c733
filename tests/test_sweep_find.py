"""Positions found in a sweep, to the last digit: where it locks, where the answer peaks or takes a value."""

from __future__ import annotations

import numpy as np
import pytest

import icsolve
from icsolve.sweep.finding import Query, find
from test_sweep_status import FOUR_BAR, PARALLELOGRAM, SLIDER_CRANK


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


def test_where_the_torque_is_zero_and_where_it_has_a_value() -> None:
    """The zeros are the dead centres; at the others the solver gives the value that was asked."""
    zeros = found(UNKNOWN_TORQUE, "angles.AB", DEGREES, Query("value", "T", 0.0))
    dead = found(UNKNOWN_FORCE, "angles.AB", DEGREES, Query("dead"))
    assert [at for _, at, _ in zeros] == pytest.approx([at for _, at, _ in dead], rel=1e-15)
    for value in (5e4, -5e4):
        spots = found(UNKNOWN_TORQUE, "angles.AB", DEGREES, Query("value", "T", value))
        assert len(spots) == 2
        assert [answer for _, _, answer in spots] == pytest.approx([value] * 2, rel=1e-13)


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
    from icsolve.assembly.driven.order import ClosingOrder

    whole = found(UNKNOWN_TORQUE, "angles.AB", DEGREES, Query("max"))
    monkeypatch.setattr(ClosingOrder, "_meets", lambda self: iter(()))
    stepped = found(UNKNOWN_TORQUE, "angles.AB", DEGREES, Query("max"))
    assert [at for _, at, _ in stepped] == pytest.approx([at for _, at, _ in whole], rel=1e-12)


def test_along_a_load_or_a_length() -> None:
    """The load at which the torque is -1000 N mm, the rod for it: each checked by the solver."""
    spots = found(UNKNOWN_TORQUE, "loads.P", np.linspace(0.0, 5000.0, 11), Query("value", "T", -1e5))
    assert [answer for _, _, answer in spots] == pytest.approx([-1e5], rel=1e-14)
    rods = found(UNKNOWN_TORQUE, "lengths.BC", np.linspace(100.0, 400.0, 11), Query("value", "T", -8e4))
    assert [answer for _, _, answer in rods] == pytest.approx([-8e4], rel=1e-12)


def test_what_cannot_be_looked_for() -> None:
    case = icsolve.load(UNKNOWN_TORQUE)
    with pytest.raises(ValueError, match="one varied number"):
        find(case, {"angles.AB": [0.0, 1.0], "loads.P": [1.0, 2.0]}, Query("dead"))
    with pytest.raises(ValueError, match="no unknown load"):
        find(case, {"angles.AB": [0.0, 1.0]}, Query("value", "P", 1.0))
