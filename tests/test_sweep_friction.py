"""Sweeps with friction: every row is a scene of its own, in several processes where that takes long."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import icsolve
from icsolve.sweep import scenes
from icsolve.sweep.forked import can_fork

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


@pytest.mark.parametrize(
    "name", ["13_18_slider_crank_friction_everywhere", "13_19_slider_crank_friction_at_pins"]
)
def test_a_row_is_the_scene_of_its_points(name: str) -> None:
    sweep = icsolve.sweep(case(name), drive={"2": np.arange(0.0, 360.0, 30.0)}, want=WANT)
    for row in np.flatnonzero(sweep.status == "ok"):
        answer = icsolve.solve(sweep.case_of(row))
        for load, found in answer.answers.items():
            assert sweep.answers[load][row] == found.value


def test_a_crank_that_friction_jams_says_so() -> None:
    """13.19 by its crank: near 270 degrees the friction circles take all of the lever, no force drives it."""
    sweep = icsolve.sweep(
        case("13_19_slider_crank_friction_at_pins"), drive={"2": np.arange(246.0, 300.0, 6.0)}
    )
    assert "jam" in sweep.status
    assert np.isnan(sweep.answers["F"][sweep.status == "jam"]).all()


@pytest.mark.skipif(not can_fork(), reason="needs processes that share what was read")
@pytest.mark.parametrize(
    "name", ["13_19_slider_crank_friction_at_pins", "13_20_slider_crank_with_friction"]
)
def test_several_processes_find_what_one_does(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    degrees = np.arange(0.0, 360.0, 20.0)
    monkeypatch.setattr(scenes, "can_share", lambda: False)
    alone = icsolve.sweep(case(name), drive={"2": degrees}, want=WANT)
    monkeypatch.setattr(scenes, "can_share", lambda: True)
    for constant, value in (("PATIENCE", 0.0), ("WORTH", 0.0), ("FEW", 4)):
        monkeypatch.setattr(scenes, constant, value)
    done: list[int] = []
    together = icsolve.sweep(case(name), drive={"2": degrees}, want=WANT, progress=done.append)
    assert same(alone, together)
    assert sum(done) >= len(degrees)
