"""Entries 15 to 18: cams and gears."""

from __future__ import annotations

from icsolve.bench.catalogue.scenes import scene, torques
from icsolve.bench.stress import Stress, answered, refused

JAMMED_CAM = scene(
    "points: {A: [0, 0], K: [2, 1], D: [6, 1]}\n"
    "joints:\n"
    "  - {pin: [0, 1], at: A}\n"
    "  - {contact: [1, 2], at: K, normal: 0}\n"
    "  - {pin: [2, 0], at: D}\n",
    torques(2, 1),
)

ROLLER_FOLLOWER = scene(
    "points: {A: [0, 0], K: [3, 1], C: [3, 2], D: [20, 0]}\n"
    "joints:\n"
    "  - {pin: [0, 1], at: A}\n"
    "  - {contact: [1, 2], at: K, normal: 90}\n"
    "  - {pin: [2, 3], at: C}\n"
    "  - {pin: [3, 0], at: D}\n",
    torques(3, 1),
)


def gear_pair(mesh: str) -> str:
    """Wheels about (0, 0) and (3, 0) that touch at (1, 0)."""
    return scene(
        "points: {A: [0, 0], B: [3, 0], P: [1, 0]}\n"
        f"joints:\n  - {{pin: [0, 1], at: A}}\n  - {{pin: [0, 2], at: B}}\n  - {{{mesh}}}\n",
        torques(1, 2),
    )


EPICYCLIC = scene(
    "points: {O: [0, 0], P: [60, 0]}\n"
    "joints:\n"
    "  - {pin: [0, 1], at: O}\n"
    "  - {pin: [0, 2], at: O}\n"
    "  - {pin: [0, 3], at: O}\n"
    "  - {pin: [2, 4], at: P}\n"
    "  - {gears: [1, 4], teeth: [20, 40], carrier: 2}\n"
    "  - {gears: [4, 3], teeth: [40, 20], carrier: 2}\n"
    "  - {gears: [4, 0], teeth: [40, -100], carrier: 2}\n",
    torques(1, 3),
)

ENTRIES = (
    Stress(
        "15",
        "cam whose normal passes through the follower's pivot",
        JAMMED_CAM,
        refused("dead-centre", says=["no value of M1 balances", "link 1 stands still"]),
    ),
    Stress(
        "16",
        "roller follower, the roller free to spin",
        ROLLER_FOLLOWER,
        answered({"M1": 3 / 17}, says=("1 passive freedom",)),
    ),
    Stress("17a", "gear pair 2:1", gear_pair("gears: [1, 2], teeth: [20, 40]"), answered({"M2": 2.0})),
    Stress(
        "17b",
        "the same as a pin at the pitch point",
        gear_pair("pin: [1, 2], at: P"),
        answered({"M2": 2.0}, says=("1 redundant constraint",)),
    ),
    Stress(
        "18",
        "epicyclic train, two members 1:1",
        EPICYCLIC,
        answered({"M3": -1.0}, centres={("1", "3"): "undefined"}),
    ),
)
