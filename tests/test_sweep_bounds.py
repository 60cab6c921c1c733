"""Bounds of a sweep's answers, points, centres, rates and velocities hold against sixty digits on the case's
decimals.

The record that the sweep replays is run again in mpmath; groups that Newton's method placed are solved to
the last digit. Pessimism: at most 100 in the median, as for one scene.
"""

from __future__ import annotations

from decimal import Decimal
from random import Random

import numpy as np
import pytest

import full_turns
import icsolve
import mechanisms
import transcribe
from figures import from_lengths
from growth import random_mechanism
from icsolve.sweep.exact_record import exact_record
from icsolve.sweep.program import RowRequest, compile_sweep, setting_of
from loading import drawn
from recorded import is_recorded, truths
from sizes import FULL, MORE, few, sampled
from test_sweep import STILL, plain

ALL = ("answers", "error", "points", "centres", "rates", "velocities")
LAST = Decimal("1e-100")
"""Of numbers of size 1 in all digits."""


def pessimism(sweep: icsolve.Sweep, rows: range) -> list[float]:
    """Bound over true error of every number in some rows; a bound below the error fails."""
    found = []
    for row in rows:
        if sweep.status[row] != "ok":
            continue
        for (kind, name), exact in truths(sweep, row).items():
            if name not in sweep.kinds[kind]:
                continue
            values, bounds = (np.atleast_1d(t[kind][name][row]) for t in (sweep.kinds, sweep.errors))
            for value, bound, true in zip(values, bounds, exact, strict=True):
                error = float(abs(true - float(value)))
                assert error <= bound or error < 1e-50, (kind, name, row)
                if error > 0.0:
                    found.append(bound / error)
    return found


def bounded(case: icsolve.Case, degrees: np.ndarray, **vary: object) -> icsolve.Sweep | None:
    """A sweep with bounds by the first link that can drive; None where none can, or each row is a scene."""
    for link in [k for k in case.links if k != case.ground]:
        try:
            sweep = icsolve.sweep(case, want=ALL, drive={link: degrees})
        except icsolve.SceneError:
            continue
        return sweep if is_recorded(sweep) else None
    return None


@sampled(2)
@pytest.mark.parametrize("seed", range(12))
def test_in_all_digits_a_record_has_the_numbers_of_the_file(seed: int) -> None:
    """Every number of a figure and of its loads, a 1 too: no double beside it rounds it unseen."""
    rng = Random(seed)
    spots = {
        name: [rng.choice(["0", "1", "-1", "2", f"{rng.uniform(-3, 3):.2f}"]) for _ in "xy"]
        for name in ("A", "B", "C", "D", "E")
    }
    push = [rng.choice(["1", "-1", f"{rng.uniform(1, 3):.1f}"]) for _ in "xy"]
    case = icsolve.load(
        f"icsolve: 1\npoints: {str(spots).replace(chr(39), '')}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]\n"
        f"loads: {{P: {{force: [{', '.join(push)}], link: 2, at: E}}, U: {{torque: unknown, link: 2}}}}\n"
    )
    compiled = compile_sweep(setting_of(case, [], ["2"]), RowRequest(points=tuple(spots)))
    exact, given = exact_record(compiled), {compiled.inputs["2"]: Decimal(0)}
    for name, xy in spots.items():
        found = exact.values(compiled.outputs.get(("points", name), ()), given)  # none of a dyad left out
        assert all(abs(a - Decimal(b)) < LAST for a, b in zip(found, xy, strict=False)), name
    ax, ay, ex, ey = map(Decimal, (*spots["A"], *spots["E"]))
    px, py = map(Decimal, push)
    (answer,) = exact.values(compiled.outputs["answers", "U"], given)
    assert abs(answer + (ex - ax) * py - (ey - ay) * px) < LAST


@sampled(3)
@full_turns.EVERY
def test_on_full_turns(name: str, scene: transcribe.Scene, link: str, period: float) -> None:
    case = icsolve.load(transcribe.text(scene))
    sweep = icsolve.sweep(case, want=ALL, drive={link: np.linspace(0.3, period, 97)})
    found = pessimism(sweep, range(0, 97, 8))
    assert not found or np.median(found) < 100.0


def test_on_random_mechanisms() -> None:
    found, scenes = list[float](), 0
    turning = [g for g in mechanisms.ALL if g.__name__ not in STILL]
    for generator in turning if FULL else Random("bounds").sample(turning, few(len(turning))):
        for seed in range(MORE):
            case = icsolve.load(transcribe.text(drawn(seed, generator)))
            sweep = bounded(case, np.linspace(-7.3, 8.1, 23))
            found += pessimism(sweep, range(0, 23, 4 if FULL else 11)) if sweep else []
            scenes += sweep is None
    for seed in range(160 if FULL else 2):
        scene = plain(random_mechanism(Random(seed)), seed)
        sweep = bounded(icsolve.load(transcribe.text(scene)), np.linspace(-2.3, 3.1, 11)) if scene else None
        found += pessimism(sweep, range(0, 11, 5)) if sweep else []
    assert len(found) > few(60) and 10 * scenes <= few(len(turning)) * MORE
    assert np.median(found) < 100.0


def test_on_figures_by_lengths() -> None:
    """Chains of four-bars and the like whose figure is constructed: the bounds hold from the decimals on."""
    found: list[float] = []
    for generator in (mechanisms.four_bar, mechanisms.watt, mechanisms.slider_crank, mechanisms.three_loops):
        for seed in range(few(3) * MORE):
            scene = from_lengths(drawn(seed, generator), Random(seed))
            if scene is None:
                continue
            case = icsolve.load(transcribe.text(scene))
            sweep = bounded(case, np.linspace(-4.3, 5.1, 9))
            found += pessimism(sweep, range(0, 9, 2)) if sweep else []
    assert len(found) > few(40)
    assert np.median(found) < 100.0


def test_a_family_has_bounds_too() -> None:
    text = """icsolve: 1
points: {A: [0, 0], C: [unknown, 0.3]}
lengths: {AB: 0.7, BC: 2.1}
angles: {AB: 41.3}
near: {C: [2.5, 0.3]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads: {P: {force: 20, link: 4, at: C, angle: 180}, T: {torque: unknown, link: 2}}
"""
    case = icsolve.load(text)
    values = np.linspace(1.3, 3.7, 25)
    sweep = icsolve.sweep(case, {"lengths.BC": values}, ALL)
    for k in range(0, 25, 6):
        one = icsolve.solve(icsolve.load(text, settings={"lengths.BC": repr(float(values[k]))}))
        found = one.answers["T"]
        assert found.error is not None
        assert abs(found.value - sweep.answers["T"][k]) <= found.error + sweep.error["T"][k]
    assert pessimism(sweep, range(0, 25, 6))


def test_rows_near_a_limit_have_bounds_that_hold() -> None:
    """A rocker that drives, ever nearer to the end of its reach: in doubles the rod's place is lost like a
    root, and the bound says so; nearest, where that would be much, a row has its decimals' own value."""
    text = """icsolve: 1
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 1, BC: 3.5, CD: 2.5}
angles: {DC: 100}
near: {B: [0.5, 0.9]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads: {T14: {torque: 10, link: 4}, T12: {torque: unknown, link: 2}}
"""
    case = icsolve.load(text)
    limit = 95.73917047726678
    sweep = icsolve.sweep(case, {"angles.DC": limit + 10.0 ** -np.arange(0.0, 13.0)}, ALL)
    assert pessimism(sweep, range(13))
    assert (sweep.status == "ok").all()
    relative = sweep.error["T12"] / np.abs(sweep.answers["T12"])
    assert (np.diff(relative[1:4]) > 0.0).all()
    assert relative.max() < 1e-9


def test_bounds_cost_few_operations_and_change_no_answer() -> None:
    case = icsolve.load(transcribe.text(full_turns.FOUR_BAR))
    degrees = np.linspace(0.0, 360.0, 1001)
    plain_one = icsolve.sweep(case, drive={"2": degrees})
    with_bounds = icsolve.sweep(case, want=("answers", "error"), drive={"2": degrees})
    assert (plain_one.answers["U"] == with_bounds.answers["U"]).all()
    assert plain_one.error == {}
    assert with_bounds.error["U"] == pytest.approx(1e-14, abs=1e-12)
