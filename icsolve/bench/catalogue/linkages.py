"""The stress catalogue: figures from lengths and angles near their limits, and large ones."""

from __future__ import annotations

from random import Random

from icsolve.bench.catalogue.joints import FOUR_PINS, GENERIC, four_bar, known, scene, torques
from icsolve.bench.families import chain
from icsolve.bench.stress import UNREADABLE, Stress, TrueValue, answered, refused


def scaled(exponent: int) -> str:
    """The generic four-bar times a power of ten."""
    e = f"e{exponent}"
    return four_bar(f"1{e}, 2{e}", f"5{e}, 3{e}", f"6{e}, 0", torques(3, 1))


def moved(offset: str) -> str:
    """The generic four-bar far from the origin, at coordinates that are no doubles."""
    whole = int(offset)
    points = ", ".join(
        f"{name}: [{whole + x}.1, {y}.1]"
        for name, x, y in (("A0", 0, 0), ("A", 1, 2), ("B", 5, 3), ("B0", 6, 0))
    )
    return scene(f"points: {{{points}}}\n{FOUR_PINS}", torques(3, 1))


THREE_ON_A_PIN = scene(
    "points: {A: [0, 0], B: [1, 2], C: [4, 3], D: [5, 0], E: [2, 5], F: [-1, 4]}\n"
    "joints:\n"
    "  - {pin: [0, 1], at: A}\n"
    "  - {pin: [1, 2, 4], at: B}\n"
    "  - {pin: [2, 3], at: C}\n"
    "  - {pin: [3, 0], at: D}\n"
    "  - {pin: [4, 5], at: E}\n"
    "  - {pin: [5, 0], at: F}\n",
    torques(5, 3),
)

THROUGH_CENTRE = four_bar(
    "0, 2", "5, 1", "6, 0", known(3) + ", P: {force: unknown, link: 2, at: [3, 3], slope: [-1, 1]}"
)

LOOSE = scene(
    "points: {A0: [0, 0], A: [1, 2], B: [5, 3], B0: [6, 0], C: [7, 7]}\n"
    + FOUR_PINS
    + "  - {pin: [4, 5], at: C}\n",
    torques(3, 1),
)
NO_DIRECTION = scene(
    "points: {A: [0, 0], B: [2, 0], D: [5, 1], E: [2, 0]}\n"
    "joints:\n"
    "  - {pin: [0, 1], at: A}\n"
    "  - {slot: [1, 2], at: B, along: [B, E]}\n"
    "  - {pin: [2, 0], at: D}\n",
    torques(2, 1),
)


def by_lengths(pivots: str, lengths: str, loads: str, near: str = "") -> str:
    """A four-bar whose points A and B0 are given and B is found from two lengths."""
    body = f"units: {{length: mm}}\npoints: {{{pivots}}}\nlengths: {{{lengths}}}\n{near}"
    return scene(body + FOUR_PINS, loads)


def stretched(coupler: str, near: str = "") -> str:
    """Lengths over a distance of 5."""
    return by_lengths("A0: [1, -1], A: [0, 0], B0: [3, 4]", f"A-B: {coupler}, B-B0: 3", torques(3, 1), near)


MILLIMETRES = "A0: [0, 0], A: [20, 0], B0: [100, 0]"

OFF_THE_LINE = scene(
    "joints:\n"
    "  - {centre: [0, 1], at: [0, 0]}\n"
    "  - {centre: [1, 2], at: [45, 0.279]}\n"
    "  - {centre: [0, 2], at: [108, 0]}\n",
    torques(2, 1),
)

FIGURES = (
    *(
        Stress(
            f"24{letter}",
            f"scale 1e{exponent}",
            scaled(exponent),
            answered({"M1": TrueValue(-7 / 13, error=1e-14)}),
        )
        for letter, exponent in (("a", -300), ("b", -12), ("c", 12), ("d", 300))
    ),
    Stress("25a", "offset 1e6", moved("1000000"), answered({"M1": TrueValue(-7 / 13, 1e-9, 1e-8)})),
    Stress("25b", "offset 1e12", moved("1000000000000"), answered({"M1": TrueValue(-7 / 13, 1e-3, 1e-2)})),
    Stress(
        "25c",
        "offset 1e17",
        moved("100000000000000000"),
        refused("near-singular", says=["cannot resolve the figure"]),
    ),
    Stress(
        "26a",
        "three links on one pin",
        THREE_ON_A_PIN,
        answered({"M3": -0.25}, centres={("1", "4"): (1.0, 2.0), ("2", "4"): (1.0, 2.0)}),
    ),
    Stress(
        "26b", "crank of length zero", four_bar("0, 0", "4, 3", "6, 0", torques(3, 1)), answered({"M1": 0.0})
    ),
    Stress(
        "27",
        "a force through the centre of its link",
        THROUGH_CENTRE,
        refused("no-value", says=["no value of P balances"]),
    ),
    Stress("28a", "links that nothing holds", LOOSE, refused("loose-link", says=["links 4 and 5"])),
    Stress(
        "28b",
        "a coordinate that is NaN",
        GENERIC.replace("[5, 3]", "[.nan, 3]"),
        refused(UNREADABLE, says=["<text>:3:"]),
    ),
    Stress(
        "28c",
        "an infinite coordinate",
        GENERIC.replace("[5, 3]", "[.inf, 3]"),
        refused(UNREADABLE, says=["<text>:3:"]),
    ),
    Stress("28d", "a slot without a direction", NO_DIRECTION, refused("inconsistent", says=["B and E"])),
    Stress(
        "29a",
        "too short by 0.3 mm",
        by_lengths(MILLIMETRES, "A-B: 50, B-B0: 29.7", torques(3, 1)),
        refused("cannot-assemble", says=["0.3 mm", "AB", "B-B0"]),
    ),
    Stress(
        "29b",
        "too long by 0.3 mm",
        by_lengths(MILLIMETRES, "A-B: 120.3, B-B0: 40", torques(3, 1)),
        refused("cannot-assemble", says=["0.3 mm", "AB", "B-B0"]),
    ),
    Stress(
        "30a",
        "lengths 2 and 3 over the 5 of a 3-4-5",
        stretched("2"),
        refused("dead-centre", says=["A, B and B0"]),
    ),
    Stress(
        "30b",
        "lengths 0.1 and 0.2 over 0.3",
        by_lengths("A0: [0, -1], A: [0, 0], B0: [0.3, 0]", "A-B: 0.1, B-B0: 0.2", torques(3, 1)),
        refused("dead-centre", says=["A, B and B0"]),
    ),
    Stress(
        "31a",
        "the same stretched by 1e-12",
        stretched("2.000000000001", "near: {B: [1.1999988, 1.6000009]}\n"),
        answered({"M1": TrueValue(-361478.4056460647, 1e-4, 361.0)}),
    ),
    Stress(
        "31b",
        "equal lengths about one point",
        by_lengths("A0: [-2, 0], A: [0, 0], B0: [0, 0]", "A-B: 4, B-B0: 4", torques(3, 1)),
        refused("underdetermined", says=["any angle fits"]),
    ),
    Stress(
        "32a",
        "two ways to assemble and nothing that picks one",
        by_lengths("A0: [0, 0], A: [1, 2], B0: [6, 0]", "A-B: 4, B-B0: 3.2", torques(3, 1)),
        refused("ambiguous", says=["near"]),
    ),
    Stress(
        "33",
        "a given centre off the Kennedy line",
        OFF_THE_LINE,
        refused("contradictory-centres", says=["0.279 m", "1-2"]),
    ),
)


LOOPS = 5000


LARGE = (
    Stress(
        "34",
        f"chain of {LOOPS} four-bars",
        lambda: chain(LOOPS)(Random(1)),
        answered({"U": TrueValue(-34323.82142315836, 1e-15, 1e-11)}),
    ),
)

ENTRIES = (*FIGURES, *LARGE)
