"""The stress catalogue: pins, slides and slots, turning blocks, wheels; figures near their limits, and large
ones."""

from __future__ import annotations

import math
from random import Random

from icsolve.bench.families import chain
from icsolve.bench.stress import UNREADABLE, Stress, TrueValue, TurnedScene, answered, refused

FOUR_PINS = """\
joints:
  - {pin: [0, 1], at: A0}
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 0], at: B0}
"""


def scene(body: str, loads: str = "") -> str:
    """A case with the frame 0."""
    return f"icsolve: 1\nground: 0\n{body}" + (f"loads: {{{loads}}}\n" if loads else "")


def four_bar(a: str, b: str, b0: str, loads: str) -> str:
    """Crank 1 from the origin to A, coupler 2, rocker 3 from B0 to B."""
    points = f"points: {{A0: [0, 0], A: [{a}], B: [{b}], B0: [{b0}]}}\n"
    return scene(points + FOUR_PINS, loads)


def known(link: int) -> str:
    """A torque of 1 on a link."""
    return f"M{link}: {{torque: 1, link: {link}}}"


def unknown(link: int) -> str:
    """The torque to find, on a link."""
    return f"M{link}: {{torque: unknown, link: {link}}}"


def torques(on: int, to_find: int) -> str:
    """One known torque and one unknown."""
    return f"{known(on)}, {unknown(to_find)}"


GENERIC = four_bar("1, 2", "5, 3", "6, 0", torques(3, 1))
FLAT_PARALLELOGRAM = four_bar("2, 0", "7, 0", "5, 0", torques(3, 1))


def near_toggle(delta: str, loads: str) -> str:
    """A, B and B0 within delta of a line: coupler and rocker stretched, the crank at its limit."""
    return four_bar("1, 0", f"2{delta}, 2", "3, 4", loads)


CRANK_ALIGNED = "1, 0", "3, 0", "3, 2"
"""Crank and coupler in line: the rocker at its limit."""

DEAD = ("dead-centre",)


def pinned(points: str, edges: str, loads: str) -> str:
    """Links from 0, pinned in the pattern of a graph, pins A, B, C, ... in its order."""
    pins = [f"  - {{pin: [{e[0]}, {e[1]}], at: {chr(65 + k)}}}\n" for k, e in enumerate(edges.split())]
    places = ", ".join(f"{chr(65 + k)}: [{p}]" for k, p in enumerate(points.split("; ")))
    return scene(f"points: {{{places}}}\njoints:\n{''.join(pins)}", loads)


CRANKS = "01 02 03 14 24 34"


def three_cranks(third: str) -> str:
    """A coupler on three cranks; the end of the third as given."""
    return pinned(f"0, 0; 2, 0; 5, 0; 1, 2; 3, 2; {third}", CRANKS, torques(2, 1))


def turned_cranks(angle: float) -> str:
    """The same with all points turned by an angle in radians, as a program writes them."""
    c, s = math.cos(angle), math.sin(angle)
    spots = ((0, 0), (2, 0), (5, 0), (1, 2), (3, 2), (6, 2))
    return pinned("; ".join(f"{x * c - y * s!r}, {x * s + y * c!r}" for x, y in spots), CRANKS, torques(2, 1))


FIVE_BAR = pinned("0, 0; 1, 2; 3, 3; 5, 2; 6, 0", "01 12 23 34 40", torques(4, 1))
TRIANGLE = pinned("0, 0; 4, 0; 1, 3", "01 02 12", torques(2, 1))
TRUSS = pinned("0, 0; 4, 0; 1, 0", "01 02 12", torques(2, 1))
BUTTERFLY = pinned(
    "6, 1; 1, -1; 11, -1; 4, 3; 8, 3; 7, 9; -1, 4; 3, 6; 11, 4; 9, 6",
    "01 04 05 16 17 23 24 26 35 37",
    "M4: {torque: 60, link: 4}, M5: {torque: unknown, link: 5}",
)
FLIER = pinned(
    "0, 0; 6, -1; 9, 1; 2, 5; 4, 2; 7, 6; 5, 8; 1, 9; 3, 7; 8, 4",
    "01 06 07 14 23 26 27 34 45 57",
    torques(7, 1),
)

PINNED = (
    Stress("1", "generic four-bar", GENERIC, answered({"M1": TrueValue(-7 / 13, error=1e-15)})),
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
            answered({"M1": TrueValue(-0.5 / delta, 10.0**-digits, 0.5 / delta * 10.0**-digits)}),
        )
        for letter, places, delta, digits in (("a", 6, 1e-6, 9), ("b", 9, 1e-9, 6), ("c", 12, 1e-12, 3))
    ),
    Stress(
        "6d",
        "the same + 1e-15",
        near_toggle(".000000000000001", torques(3, 1)),
        answered({"M1": TrueValue(-5e14, 0.0, 0.1)}),
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
        answered({"M1": TrueValue(1 / 3)}, says=("only for an instant",)),
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
        answered({"M1": TrueValue(-1.0, 1e-9)}, says=["half a unit of the last digit"]),
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

SLIDING = (
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


def turning(b0: str, lengths: str, near: str, on: int, to_find: int) -> str:
    """A four-bar by its lengths, the crank of length 1 at 60 degrees."""
    body = f"points: {{A0: [0, 0], B0: [{b0}]}}\nlengths: {{A0-A: 1, {lengths}}}\nangles: {{A0-A: 60}}\n"
    return scene(f"{body}near: {{B: [{near}]}}\n{FOUR_PINS}", torques(on, to_find))


PARALLELOGRAM = turning("2, 0", "A-B: 2, B-B0: 1", "2.5, 0.9", 3, 1)
SHORT_REACH = turning("3, 0", "A-B: 1.5, B-B0: 1.5", "2, 2", 3, 1)
"""The pins A and B0 are 3 apart, the reach of coupler and rocker, where the crank stands at
acos(1/6) = 80.4 degrees: beyond that it cannot turn."""

TURNING = (
    Stress(
        "32b",
        "a parallelogram swept through its change points",
        PARALLELOGRAM,
        answered({"M1": -1.0}),
        TurnedScene("angles.A0-A", 60, 1, 361, {180: "change-point", 360: "change-point"}),
    ),
    Stress(
        "35",
        "a sweep beyond what the links reach",
        SHORT_REACH,
        answered({}),
        TurnedScene("angles.A0-A", 60, 1, 61, dict.fromkeys(range(81, 121), "cannot-assemble")),
    ),
)


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

WHEELS = (
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


# --- figures from lengths and angles near their limits, and large ones ---------------------------------


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


def _place(stress: Stress) -> tuple[int, str]:
    """Sorting key: the number, then its letter."""
    digits = stress.number.rstrip("abcdefgh")
    return int(digits), stress.number[len(digits) :]


_ENTRIES = (*PINNED, *SLIDING, *TURNING, *WHEELS, *FIGURES, *LARGE)
CATALOGUE: tuple[Stress, ...] = tuple(sorted(_ENTRIES, key=_place))
"""Every scene, in the order of its number."""
