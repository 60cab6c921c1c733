"""The forces in the joints in every row of a sweep: those of the row as a scene, and in equilibrium with the
loads and the inertia forces by sums that no solver writes."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from random import Random

import numpy as np
import pytest

import icsolve as library
from icsolve.sweep.request import RequestError
from library import FILES, sample
from shell import Shell
from sizes import few

FOUR_BAR = """icsolve: 1
points: {{A: [0, 0], B: [{bx}, 2], C: [5, {cy}], D: [6, 0], E: [3, {ey}]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
links: {{3: {mass}}}
motion: {{link: 2, speed: 2 rad/s}}
{dynamic}loads:
  P: {{force: [{px}, -12], link: 4, at: C}}
  T: {{torque: unknown, link: 2}}
"""


def drawn(seed: int, dynamic: bool) -> str:
    rng = Random(seed)
    numbers = {
        "bx": rng.uniform(0.5, 1.2),
        "cy": rng.uniform(3, 4),
        "ey": rng.uniform(2, 5),
        "px": rng.uniform(-9, 9),
    }
    mass = "{mass: 1.5 kg, centre: E}" if dynamic else "[E]"
    shown = {name: round(value, 2) for name, value in numbers.items()}
    return FOUR_BAR.format(**shown, mass=mass, dynamic="dynamic: true\n" * dynamic)


@pytest.mark.parametrize("dynamic", [False, True])
@pytest.mark.parametrize("seed", range(few(12)))
def test_every_link_of_a_four_bar_is_in_equilibrium_in_every_row(seed: int, dynamic: bool) -> None:
    """The crank turns by the force on its pin, the coupler bears its mass times its acceleration, and the
    rocker turns by nothing. To 1e-12 of the largest force."""
    want = ("reactions", "points", *["accelerations"] * dynamic)
    found = library.sweep(
        library.load(drawn(seed, dynamic)), want=want, drive={"2": np.linspace(-9.0, 9.0, 7)}
    )
    assert set(found.status) == {"ok"}
    f12, f23, f34, f14 = (found.reactions[name] for name in ("F12", "F23", "F34", "F14"))
    room = 1e-12 * np.abs(f34).max()
    a, b, c, d = (found.points[name] for name in "ABCD")
    px = float(drawn(seed, dynamic).split("force: [")[1].split(",")[0])

    def moment(arm: np.ndarray, force: np.ndarray) -> np.ndarray:
        return arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]

    assert np.allclose(f12[:, :2], f23[:, :2], rtol=0.0, atol=room)
    assert np.allclose(found.answers["T"], moment(b - a, f23), rtol=0.0, atol=9.0 * room)
    carried = 1.5 * found.accelerations["E on 3"] if dynamic else 0.0
    assert np.allclose(f23[:, :2] - f34[:, :2], carried, rtol=0.0, atol=room)
    load = f34[:, :2] + (px, -12.0)
    assert np.allclose(f14[:, :2], -load, rtol=0.0, atol=room)
    assert np.allclose(moment(c - d, load), 0.0, atol=9.0 * room)
    assert all((force[:, 2] == 0.0).all() for force in (f12, f23, f34, f14))


@pytest.mark.parametrize("name", sample(FILES, 12, "reactions of rows"))
def test_each_row_has_the_forces_of_its_scene(name: str) -> None:
    """To the last digit, with bounds: none where a scene tells none."""
    case = library.load(FILES[name])
    load = next((load for load in case.loads if getattr(getattr(load, "value", None), "value", None)), None)
    if load is None or case.unknowns or case.space:
        pytest.skip("no load to vary in the plane")
    vary = {load.value.path: load.value.value * np.array([1.0, 1.25])}
    found = library.sweep(case, vary, want=("reactions", "error"))
    for row in range(2):
        if found.status[row] != "ok":
            continue
        scene = library.solve(found.case_of(row), reactions=True)
        told = {name: (force.x, force.y, force.moment) for name, force in scene.reactions.items()}
        assert told.keys() | {pull.name for pull in scene.tensions} == found.reactions.keys()
        for joint, parts in told.items():
            wanted = [math.nan if part is None else part for part in parts]
            assert np.array_equal(found.reactions[joint][row], wanted, equal_nan=True)
        for pull in scene.tensions:
            assert found.reactions[pull.name][row] == pull.tension


def test_the_command_writes_them_in_every_form(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    run = Shell(capsys)
    Path("bar.yaml").write_text(drawn(1, dynamic=False), encoding="utf-8")
    for ending in ("csv", "jsonl", "npz"):
        ran = run("sweep", "bar.yaml", "--drive", "2=0:10:5", "--reactions", "-o", f"out.{ending}")
        assert ran.code == 0
    assert "each row is solved as a scene of its own" in ran.err
    columns = next(csv.reader(Path("out.csv").read_text(encoding="utf-8").splitlines()))
    assert columns[:5] == ["2", "T", "F12.x", "F12.y", "F12.moment"]
    assert json.loads(Path("out.jsonl").read_text(encoding="utf-8").splitlines()[0]).keys() == {*columns}
    assert {*np.load("out.npz").keys()} == {*columns}


def test_an_evaluator_says_where_they_are() -> None:
    case = library.load(drawn(1, dynamic=False))
    with pytest.raises(RequestError, match=r"`icsolve.sweep` has them"):
        library.evaluator(case, inputs=("loads.P.x",), want=("reactions",))
