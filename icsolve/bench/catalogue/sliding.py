"""Entries 9 and 11 to 14: blocks on guides and pins in slots."""

from __future__ import annotations

from icsolve.bench.catalogue.scenes import known, scene, torques, unknown
from icsolve.bench.stress import Stress, answered, refused


def top_dead_centre(loads: str) -> str:
    """Slider-crank with crank and rod in line with the guide."""
    return scene(
        "points: {A: [0, 0], B: [1, 0], C: [3, 0]}\n"
        "joints:\n"
        "  - {pin: [0, 1], at: A}\n"
        "  - {pin: [1, 2], at: B}\n"
        "  - {pin: [2, 3], at: C}\n"
        "  - {slide: [3, 0], at: C, along: 0}\n",
        loads,
    )


def trammel(along_a: int, along_b: int, angle_b: int) -> str:
    """A rod on two blocks: a force of 1 along +x at A, the force to find at B."""
    return scene(
        "points: {A: [3, 0], B: [0, 4]}\n"
        "joints:\n"
        f"  - {{slide: [1, 0], at: A, along: {along_a}}}\n"
        "  - {pin: [1, 2], at: A}\n"
        "  - {pin: [2, 3], at: B}\n"
        f"  - {{slide: [3, 0], at: B, along: {along_b}}}\n",
        f"P: {{force: 1, link: 1, at: A, angle: 0}}, Q: {{force: unknown, link: 3, at: B, angle: {angle_b}}}",
    )


def slotted(crank: str, pivot: str, along: str, loads: str) -> str:
    """A crank about the origin with a pin in the slot of a fork."""
    return scene(
        f"points: {{A: [0, 0], B: [{crank}], D: [{pivot}]}}\n"
        "joints:\n"
        "  - {pin: [0, 1], at: A}\n"
        f"  - {{slot: [1, 2], at: B, along: {along}}}\n"
        "  - {pin: [2, 0], at: D}\n",
        loads,
    )


PISTON = "P: {force: %s, link: 3, at: C, angle: 180}"

ENTRIES = (
    Stress(
        "9a",
        "slider-crank at top dead centre, unknown piston force",
        top_dead_centre(PISTON % "unknown" + ", " + known(1)),
        refused("dead-centre", says=["no value of P balances", "stands still"]),
    ),
    Stress(
        "9b",
        "the same, unknown torque",
        top_dead_centre(PISTON % "1" + ", " + unknown(1)),
        answered({"M1": 0.0}),
    ),
    Stress(
        "11a",
        "elliptic trammel",
        trammel(0, 90, 90),
        answered({"Q": 4 / 3}, centres={("0", "2"): (3.0, 4.0)}),
    ),
    Stress(
        "11b",
        "trammel with parallel guides",
        trammel(0, 0, 0),
        answered({"Q": -1.0}, centres={("0", "2"): 90.0}),
    ),
    Stress(
        "12",
        "quick return",
        slotted("-1, 2", "-2, -4", "[D, B]", torques(2, 1)),
        answered({"M1": -11 / 37}),
    ),
    Stress(
        "13",
        "slot pin on the fork's pivot, slot across its motion",
        slotted("2, 0", "2, 0", "30", torques(2, 1)),
        refused("dead-centre", says=["no value of M1 balances", "link 1 stands still"]),
    ),
    Stress(
        "14",
        "slot along the pin's velocity (dwell)",
        slotted("2, 0", "5, 1", "90", torques(2, 1)),
        answered({"M1": 0.0}, centres={("0", "2"): (5.0, 1.0)}, rates={"2": 0.0}),
    ),
)
