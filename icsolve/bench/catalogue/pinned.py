"""Entries 1 to 8, 10 and 19 to 23: pinned linkages."""

from __future__ import annotations

import math

from icsolve.bench.catalogue.scenes import four_bar, scene, torques, unknown
from icsolve.bench.stress import Stress, Value, answered, refused

GENERIC = four_bar("1, 2", "5, 3", "6, 0", torques(3, 1))
FLAT_PARALLELOGRAM = four_bar("2, 0", "7, 0", "5, 0", torques(3, 1))


def near_toggle(delta: str, loads: str) -> str:
    """A, B and B0 within delta of a line: coupler and rocker stretched, the crank at its limit."""
    return four_bar("1, 0", f"2{delta}, 2", "3, 4", loads)


CRANK_ALIGNED = "1, 0", "3, 0", "3, 2"
"""Crank and coupler in line: the rocker at its limit."""

DEAD = ("dead-centre",)
CLOSE = ("dead-centre", "near-singular")


def three_cranks(third: str) -> str:
    """A coupler on three cranks; the end of the third as given."""
    return scene(
        f"points: {{A: [0, 0], B: [2, 0], C: [5, 0], D: [1, 2], E: [3, 2], F: [{third}]}}\n"
        "joints:\n"
        "  - {pin: [0, 1], at: A}\n"
        "  - {pin: [0, 2], at: B}\n"
        "  - {pin: [0, 3], at: C}\n"
        "  - {pin: [1, 4], at: D}\n"
        "  - {pin: [2, 4], at: E}\n"
        "  - {pin: [3, 4], at: F}\n",
        torques(2, 1),
    )


def turned_cranks(angle: float) -> str:
    """The same with all points turned by an angle in radians, as a program writes them."""
    c, s = math.cos(angle), math.sin(angle)
    spots = {"A": (0, 0), "B": (2, 0), "C": (5, 0), "D": (1, 2), "E": (3, 2), "F": (6, 2)}
    points = ", ".join(f"{p}: [{x * c - y * s!r}, {x * s + y * c!r}]" for p, (x, y) in spots.items())
    text = three_cranks("6, 2")
    return text.replace(text[text.index("points:") : text.index("\njoints:")], f"points: {{{points}}}")


FIVE_BAR = scene(
    "points: {A: [0, 0], B: [1, 2], C: [3, 3], D: [5, 2], E: [6, 0]}\n"
    "joints:\n"
    "  - {pin: [0, 1], at: A}\n"
    "  - {pin: [1, 2], at: B}\n"
    "  - {pin: [2, 3], at: C}\n"
    "  - {pin: [3, 4], at: D}\n"
    "  - {pin: [4, 0], at: E}\n",
    torques(4, 1),
)

TRIANGLE = scene(
    "points: {A: [0, 0], B: [4, 0], C: [1, 3]}\n"
    "joints:\n  - {pin: [0, 1], at: A}\n  - {pin: [0, 2], at: B}\n  - {pin: [1, 2], at: C}\n",
    torques(2, 1),
)

TRUSS = scene(
    "points: {A: [0, 0], B: [4, 0], C: [1, 0]}\n"
    "joints:\n  - {pin: [0, 1], at: A}\n  - {pin: [0, 2], at: B}\n  - {pin: [1, 2], at: C}\n",
    torques(2, 1),
)


def eight_bar(points: str, edges: str, loads: str) -> str:
    """Links from 0, pinned in the pattern of a graph, pins A, B, C, ... in its order."""
    pins = [f"  - {{pin: [{e[0]}, {e[1]}], at: {chr(65 + k)}}}\n" for k, e in enumerate(edges.split())]
    places = ", ".join(f"{chr(65 + k)}: [{p}]" for k, p in enumerate(points.split("; ")))
    return scene(f"points: {{{places}}}\njoints:\n{''.join(pins)}", loads)


BUTTERFLY = eight_bar(
    "6, 1; 1, -1; 11, -1; 4, 3; 8, 3; 7, 9; -1, 4; 3, 6; 11, 4; 9, 6",
    "01 04 05 16 17 23 24 26 35 37",
    "M4: {torque: 60, link: 4}, M5: {torque: unknown, link: 5}",
)
FLIER = eight_bar(
    "0, 0; 6, -1; 9, 1; 2, 5; 4, 2; 7, 6; 5, 8; 1, 9; 3, 7; 8, 4",
    "01 06 07 14 23 26 27 34 45 57",
    torques(7, 1),
)

ENTRIES = (
    Stress("1", "generic four-bar", GENERIC, answered({"M1": Value(-7 / 13, error=1e-15)})),
    Stress(
        "2",
        "cranks parallel, unequal",
        four_bar("0, 1", "4, 2", "4, 0", torques(3, 1)),
        answered({"M1": -0.5}, centres={("0", "2"): 90.0}),
    ),
    Stress(
        "3",
        "parallelogram",
        four_bar("1, 2", "6, 2", "5, 0", torques(3, 1)),
        answered({"M1": -1.0}, centres={("0", "2"): 63.43494882292201, ("1", "3"): 0.0}),
    ),
    Stress(
        "4",
        "parallelogram folded flat",
        FLAT_PARALLELOGRAM,
        refused("change-point", says=["2 degrees of freedom", "more than one way"]),
    ),
    Stress(
        "5",
        "coupler and rocker in line, unknown on the crank",
        near_toggle("", torques(3, 1)),
        refused(*DEAD, says=["no value of M1 balances", "link 1 stands still", "A, B and B0"]),
    ),
    *(
        Stress(
            f"6{letter}",
            f"the same + {delta:g}",
            near_toggle(f".{'0' * (places - 1)}1", torques(3, 1)),
            answered({"M1": Value(-0.5 / delta, 10.0**-digits, 0.5 / delta * 10.0**-digits)}),
        )
        for letter, places, delta, digits in (("a", 6, 1e-6, 9), ("b", 9, 1e-9, 6), ("c", 12, 1e-12, 3))
    ),
    Stress(
        "6d",
        "the same + 1e-15",
        near_toggle(".000000000000001", torques(3, 1)),
        answered({"M1": Value(-5e14, 0.0, 0.1)}),
    ),
    Stress(
        "7",
        "crank and coupler in line, unknown on the crank",
        four_bar(*CRANK_ALIGNED, torques(3, 1)),
        answered({"M1": 0.0}),
    ),
    Stress(
        "8",
        "the same, unknown on the rocker",
        four_bar(*CRANK_ALIGNED, torques(1, 3)),
        refused(*DEAD, says=["no value of M3 balances", "link 3 stands still"]),
    ),
    Stress(
        "10",
        "an unknown that does no work, and no known load",
        near_toggle("", unknown(1)),
        refused("any-value", says=["any value of M1 balances"]),
    ),
    Stress(
        "19",
        "five-bar with one unknown",
        FIVE_BAR,
        refused("mobility", says=["2 degrees of freedom", "lock"]),
    ),
    Stress("20", "triangle frame", TRIANGLE, refused("structure", says=["Nothing moves", "give every load"])),
    Stress(
        "20b",
        "two bars in line between two fixed pins",
        TRUSS,
        answered({"M1": Value(1 / 3)}, says=("only for an instant",)),
    ),
    Stress(
        "21",
        "three parallel cranks",
        three_cranks("6, 2"),
        answered({"M1": -1.0}, says=("1 redundant constraint", "not unique", "goes on moving")),
    ),
    Stress(
        "22a",
        "turned by a program, to 16 digits",
        turned_cranks(0.3),
        answered({"M1": Value(-1.0, 1e-9)}, says=["half a unit of the last digit"]),
    ),
    Stress(
        "22b",
        "one pin off 1e-10",
        three_cranks("6.0000000001, 2"),
        refused("near-singular", says=["structure, but within", "of moving"]),
    ),
    Stress(
        "22c",
        "one pin off 1e-6",
        three_cranks("6.000001, 2"),
        refused("near-singular", says=["structure, but within", "of moving"]),
    ),
    Stress("22d", "one pin off 1e-3", three_cranks("6.001, 2"), refused("structure")),
    Stress("23a", "double butterfly", BUTTERFLY, answered({"M5": -30.0}, by="loop equations")),
    Stress("23b", "single flier", FLIER, answered({"M1": 0.2575592777898629}, by="loop equations")),
)
