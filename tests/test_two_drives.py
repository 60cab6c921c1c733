"""Two cranks that are turned together, and behind them a group that only Newton's method places: a row is
reached where the straight way leads to it, whatever other way does not."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import numpy.typing as npt
import pytest

import icsolve
from sizes import few

Array = npt.NDArray[np.float64]
STEPS = 120
CLEAR = 0.3
"""The determinant of the three lengths' directions, over which nothing is near to a limit."""


def drawn(seed: int) -> tuple[str, Array, Array, Array]:
    """A plate on three rods, two of which hang on cranks, the third on the frame: the case; the pivots, the
    outer ends of the rods and the plate's pins, (3, 2) each, as written."""
    rng = Random(seed)
    pivots = np.array([[0.0, 0.0], [6.0, 0.0], [3.0, 7.0]])
    ends = np.round(
        [[*(pivots[k] + rng.uniform(0.8, 1.6) * np.array([math.cos(t), math.sin(t)]))] for k, t in
         ((0, rng.uniform(0, 6)), (1, rng.uniform(0, 6)))] + [[3.0, 7.0]], 3
    )  # fmt: skip
    pins = np.round(
        np.array([[2.0, 2.5], [4.2, 2.3], [3.1, 4.4]]) + [[rng.uniform(-0.4, 0.4)] * 2 for _ in range(3)], 3
    )
    names = ["A", "B", "P", "Q", "R", "U", "V", "W"]
    at = dict(zip(names, [pivots[0], pivots[1], ends[0], ends[1], ends[2], *pins], strict=True))
    points = ", ".join(f"{name}: [{x:.3f}, {y:.3f}]" for name, (x, y) in at.items())
    text = f"""icsolve: 1
points: {{{points}}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [1, 3], at: B}}
  - {{pin: [2, 5], at: P}}
  - {{pin: [3, 6], at: Q}}
  - {{pin: [1, 7], at: R}}
  - {{pin: [4, 5], at: U}}
  - {{pin: [4, 6], at: V}}
  - {{pin: [4, 7], at: W}}
loads:
  F: {{force: [3, -7], link: 4, at: W}}
  S: {{torque: unknown, link: 2}}
  T: {{torque: unknown, link: 3}}
"""
    return text, pivots, ends, pins


def followed(pivots: Array, ends: Array, pins: Array, turns: tuple[float, float]) -> Array | None:
    """The plate's pins, (3, 2), where both cranks have turned so far [degrees] at once, in small steps; None
    where a step comes near to a limit."""
    lengths = np.linalg.norm(pins - ends, axis=1)
    pose, arms = np.zeros(3), pins - pins[0]
    for step in range(1, STEPS + 1):
        out = ends.copy()
        for k, turn in enumerate(turns):
            c, s = (f(math.radians(turn * step / STEPS)) for f in (math.cos, math.sin))
            x, y = ends[k] - pivots[k]
            out[k] = pivots[k] + (c * x - s * y, s * x + c * y)
        for _ in range(5):
            c, s = math.cos(pose[2]), math.sin(pose[2])
            turned = arms @ np.array([[c, s], [-s, c]])
            way = pins[0] + pose[:2] + turned - out
            along = way / np.linalg.norm(way, axis=1, keepdims=True)
            lever = along[:, 1] * turned[:, 0] - along[:, 0] * turned[:, 1]
            slopes = np.column_stack((along, lever))
            pose -= np.linalg.solve(slopes, np.linalg.norm(way, axis=1) - lengths)
        if abs(np.linalg.det(slopes)) < CLEAR or not np.isfinite(pose).all():
            return None
    return np.asarray(pins[0] + pose[:2] + turned)


@pytest.mark.parametrize("seed", range(5, 5 + few(60, 40)))
def test_a_row_is_reached_where_the_straight_way_leads_to_it(seed: int) -> None:
    """Places to 1e-9 of the figure, which small steps and Newton's method without the library give."""
    text, pivots, ends, pins = drawn(seed)
    rng = Random(f"turns {seed}")
    turns = np.array([[rng.uniform(-110, 110), rng.uniform(-110, 110)] for _ in range(8)])
    drive = {"2": turns[:, 0], "3": turns[:, 1]}
    found = icsolve.sweep(icsolve.load(text), want=("answers", "status", "points"), drive=drive)
    told = [followed(pivots, ends, pins, (a, b)) for a, b in turns.tolist()]
    for n, at in enumerate(told):
        if at is not None:
            assert found.status[n] == "ok"
            assert np.allclose([found.points[p][n] for p in "UVW"], at, rtol=0.0, atol=1e-9)
            assert math.isfinite(found.answers["T"][n])
