"""Entry 32b, and 35: what a sweep says row by row."""

from __future__ import annotations

from icsolve.bench.catalogue.scenes import FOUR_PINS, scene, torques
from icsolve.bench.stress import Stress, Turned, answered


def turning(b0: str, lengths: str, near: str, on: int, to_find: int) -> str:
    """A four-bar by its lengths, the crank of length 1 at 60 degrees."""
    body = f"points: {{A0: [0, 0], B0: [{b0}]}}\nlengths: {{A0-A: 1, {lengths}}}\nangles: {{A0-A: 60}}\n"
    return scene(f"{body}near: {{B: [{near}]}}\n{FOUR_PINS}", torques(on, to_find))


PARALLELOGRAM = turning("2, 0", "A-B: 2, B-B0: 1", "2.5, 0.9", 3, 1)
SHORT_REACH = turning("3, 0", "A-B: 1.5, B-B0: 1.5", "2, 2", 3, 1)
"""The pins A and B0 are 3 apart, the reach of coupler and rocker, where the crank stands at
acos(1/6) = 80.4 degrees: beyond that it cannot turn."""

ENTRIES = (
    Stress(
        "32b",
        "a parallelogram swept through its change points",
        PARALLELOGRAM,
        answered({"M1": -1.0}),
        Turned("angles.A0-A", 60, 1, 361, {180: "change-point", 360: "change-point"}),
    ),
    Stress(
        "35",
        "a sweep beyond what the links reach",
        SHORT_REACH,
        answered({}),
        Turned("angles.A0-A", 60, 1, 61, dict.fromkeys(range(81, 121), "cannot-assemble")),
    ),
)
