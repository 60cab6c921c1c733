"""Published values against found ones: digits, widths, senses, errata, and what can't be compared.

Tolerances are those of the format: a bare value agrees when the found one rounds to the digits given.
"""

from __future__ import annotations

import math
import random
from decimal import Decimal, localcontext
from fractions import Fraction
from itertools import product
from typing import Any

import pytest

from icsolve.answer import Answer, Centre, Found
from icsolve.case import Force, Like, Number, Torque, Toward, Weight
from icsolve.case.expected import (
    ArmIs,
    CentreIs,
    DistanceIs,
    Expected,
    FrictionRadiusIs,
    LoadIs,
    RateIs,
    RatioIs,
    ReactionIs,
    SpeedIs,
    Target,
)
from icsolve.errors import CaseError
from icsolve.manual import template
from icsolve.read import load
from icsolve.report.check import Row, compare, wanted
from icsolve.solve import solve
from made import four_bar_answer, four_bar_case, number, published
from sizes import FULL

T12 = LoadIs("T12")


def row(target: Target, *values: str, answer: dict[str, Any] | None = None, **more: Any) -> Row:
    """The row of one published value against the hand-made four-bar answer."""
    case = (answer or {}).pop("case", None) or four_bar_case()
    expected = published("key", target, *values, **more)
    full: Answer = four_bar_answer(four_bar_case(loads=case.loads, expect=(expected,)), **(answer or {}))
    (only,) = compare(full)
    return only


@pytest.mark.parametrize("digits", ["29.672", "29.67", "29.7", "30", "29.67219"])
def test_a_bare_value_agrees_when_the_found_one_rounds_to_its_digits(digits: str) -> None:
    assert row(T12, digits).verdict == "agrees"


@pytest.mark.parametrize("digits", ["29.671", "29.68", "29.6", "29", "-29.67", "29.67220"])
def test_a_bare_value_disagrees_when_the_found_one_rounds_to_other_digits(digits: str) -> None:
    assert row(T12, digits).verdict == "disagrees"


def test_exactly_half_a_unit_away_still_agrees() -> None:
    found = {"answers": {"T12": Found(0.15, "lbf*in", "ccw")}}
    assert row(T12, "0.1", answer=dict(found)).verdict == "agrees"
    assert row(T12, "0.2", answer=dict(found)).verdict == "agrees"


def test_within_takes_a_width_or_a_fraction() -> None:
    assert row(T12, "29.0", within=0.7).verdict == "agrees"
    assert row(T12, "29.0", within=0.6).verdict == "disagrees"
    assert row(T12, "29.0", within=0.024, relative=True).verdict == "agrees"
    assert row(T12, "29.0", within=0.023, relative=True).verdict == "disagrees"


def test_a_sense_in_words_is_part_of_the_published_value() -> None:
    assert row(T12, "29.67", sense="ccw").verdict == "agrees"
    clockwise = row(T12, "29.67", sense="cw")
    assert (clockwise.verdict, clockwise.found) == ("disagrees", "29.67219 ccw")


def test_the_sense_counts_from_counterclockwise_even_where_the_load_turns_clockwise() -> None:
    loads = (Torque("T12", "2", None, turns="cw"),)
    answer = {"case": four_bar_case(loads=loads), "answers": {"T12": Found(26.8815, "lbf*in", "cw")}}
    assert row(T12, "26.88", sense="cw", answer=dict(answer)).verdict == "agrees"
    assert row(T12, "26.88", answer=dict(answer)).verdict == "agrees"
    assert row(T12, "26.88", sense="ccw", answer=dict(answer)).verdict == "disagrees"


@pytest.mark.parametrize(
    ("sense", "verdict"),
    [
        ("right", "agrees"),
        ("left", "disagrees"),
        ("up", "disagrees"),
        ("at 10 deg", "agrees"),
        ("at 12 deg", "disagrees"),
        ("at 190 deg", "disagrees"),
        ("toward E", "agrees"),
        ("toward C", "disagrees"),
    ],
)
def test_a_force_goes_the_published_way(sense: str, verdict: str) -> None:
    # D to E of 13.8 goes at 60.0 degrees; a force at D found at 10.4 or, for the point, at 60 degrees
    loads = (Force("F", "4", "D", None, number("10.4")),)
    own = "at 60.2 deg" if sense.startswith("toward") else "at 10.4 deg"
    answer = {"case": four_bar_case(loads=loads), "answers": {"F": Found(458.2, "lbf", own)}}
    assert row(LoadIs("F"), "458", sense=sense, answer=answer).verdict == verdict


@pytest.mark.parametrize(("sense", "verdict"), [("pull", "agrees"), ("push", "disagrees")])
def test_a_pull_is_a_force_toward_the_other_end(sense: str, verdict: str) -> None:
    loads = (Force("F", "4", "E", None, Toward("A"), against="2"),)
    answer = {"case": four_bar_case(loads=loads), "answers": {"F": Found(12.0, "lbf", "pull")}}
    assert row(LoadIs("F"), "12", sense=sense, answer=dict(answer)).verdict == verdict
    toward_a = "left" if sense == "pull" else "right"
    assert row(LoadIs("F"), "12", sense=toward_a, answer=dict(answer)).verdict == verdict


HELD = """icsolve: 1
points: {A: [0, 0], B: [2, 0], P: [2, 3], Q: [2, 5], E: [4, 7]}
joints:
  - {weld: [1, 2], at: A}
  - {slide: [3, 1], at: P, along: 90}
  - {rope: [P, Q, E], on: [3, 1]}
loads:
  W: {weight: 10, link: 2, at: B}
  V: {weight: 4, link: 3, at: P}
  F: {force: unknown, at: E}
expect: {%s: "%s"}
"""
"""A cantilever, and a block on a rope whose end goes up to the right, away from its pulley."""
SENSES = [
    ("F12", "10 up", "10 down"),
    ("F12", "10 at 90 deg", "10 at 270 deg"),
    ("F12y", "10 up", "10 down"),
    ("F21", "10 down", "10 up"),
    ("M12", "20 ccw", "20 cw"),
    ("F", "4 pull", "4 push"),
    ("F", "4 at 45 deg", "4 at 225 deg"),
    ("F", "4 up", "4 down"),
    ("F", "4 right", "4 left"),
    ("T P-Q-E", "4 pull", "4 push"),
    ("W", "10 down", "10 up"),
    ("v P on 3", "1 up", "1 down"),
    ("v P on 3", "1 toward Q", "1 toward A"),
]
UNFIT = [
    "F12: 10 pull",
    "F12x: 3 up",
    "F12y: 3 left",
    "T P-Q-E: 4 up",
    "v P on 3: 1 pull",
    "normal F13: 3 up",
]


@pytest.mark.parametrize(("key", "right", "wrong"), SENSES)
def test_every_published_sense_is_compared(key: str, right: str, wrong: str) -> None:
    for words, verdict in ((right, "agrees"), (wrong, "disagrees")):
        case = load(HELD % (key, words))
        (only,) = compare(solve(case, rates=True, reactions=True))
        assert only.verdict == verdict, (words, only)


@pytest.mark.parametrize("entry", UNFIT)
def test_a_sense_that_is_not_compared_is_refused(entry: str) -> None:
    key, value = entry.split(": ")
    with pytest.raises(
        CaseError, match=rf"^<text>:11:\d+: '{value.split()[1]}' is not a sense of {key}; it is "
    ):
        load(HELD % (key, value))


def test_a_published_value_in_a_unit_of_its_own_is_shown_in_that_of_the_case() -> None:
    torque = Number(29.67, 0.06, "", "2.4725", 12.0)
    expected = Expected("T12", T12, (torque,))
    (only,) = compare(four_bar_answer(four_bar_case(expect=(expected,))))
    assert (only.verdict, only.published) == ("agrees", "29.67")


def test_an_erratum_is_expected_not_to_agree() -> None:
    wrong = row(T12, "356.1", erratum="lbf*ft taken for lbf*in")
    assert (wrong.verdict, wrong.text) == ("erratum", "lbf*ft taken for lbf*in")
    right = row(T12, "29.67", erratum="thought to be wrong")
    assert (right.verdict, right.text) == ("disagrees", "marked as an erratum, but the value agrees")


def test_a_known_load_and_one_like_another_are_compared_with_what_they_stand_for() -> None:
    loads = (
        Torque("T12", "2", None),
        Weight("W", "3", "C", number("30")),
        Force("Q", "4", "E", Like("T12", number("-2")), number("0")),
    )
    answer = {"case": four_bar_case(loads=loads)}
    assert row(LoadIs("W"), "30", answer=dict(answer)).verdict == "agrees"
    assert row(LoadIs("Q"), "-59.34", answer=dict(answer)).verdict == "agrees"


def test_every_coordinate_of_a_centre_is_compared() -> None:
    centre = CentreIs(("2", "4"))
    assert row(centre, "-1.5139", "0").verdict == "agrees"
    assert row(centre, "-1.5139", "0.0001").verdict == "disagrees"
    assert row(CentreIs(("4", "2")), "-1.514", "0.000").verdict == "agrees"
    assert row(centre, "-1.5", "0", within=0.01, relative=True).verdict == "agrees"


def test_directions_of_centres_at_infinity_are_modulo_180() -> None:
    far = {"centres": {("1", "4"): Centre(("1", "4"), "toward", (179.999,))}}
    toward = CentreIs(("1", "4"))
    assert row(toward, toward=number("0.00"), answer=dict(far)).verdict == "agrees"
    assert row(toward, toward=number("-180.00"), answer=dict(far)).verdict == "agrees"
    assert row(toward, toward=number("90"), answer=dict(far)).verdict == "disagrees"


def test_distances_run_between_centres_and_points() -> None:
    assert row(DistanceIs(("2", "4"), "A"), "1.5139").verdict == "agrees"
    assert row(DistanceIs(("2", "4"), "D"), "4.4583").verdict == "agrees"
    assert row(DistanceIs(("1", "2"), ("2", "4")), "1.5138").verdict == "disagrees"


BESIDE = """icsolve: 1
points: {{A: [{a[0]}, {a[1]}], B: [{b[0]}, {b[1]}], C: [{c[0]}, {c[1]}], D: [{d[0]}, {d[1]}],
         P: [{p[0]}, {p[1]}], Q: [{q[0]}, {q[1]}]}}
links: {{2: [P], 4: [Q]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
loads: {{M: {{torque: 10, link: 4}}, T: {{torque: unknown, link: 2}}}}
expect: {{I12-P: {near}, I24-Q: {far}}}
"""


@pytest.mark.parametrize("seed", range(100 if FULL else 12))
def test_a_distance_is_compared_by_its_own_digits_however_short_it_is(seed: int) -> None:
    """Points 1e-3 to 1e-13 beside the pin A, and to 1e-30 beside I24, where BC meets AD, far from the origin:
    what is published in four digits agrees, and disagrees with a last digit that is two off."""
    draw = random.Random(f"beside {seed}")
    (ax, ay), (bx, by), (cx, cy), (dx, dy) = places = [
        (Fraction(draw.randint(at, at + 300), 100), Fraction(draw.randint(low, low + 200), 100))
        for at, low in ((700, -1000), (700, -700), (1100, -600), (1200, -1000))
    ]
    rod, frame = (cx - bx, cy - by), (dx - ax, dy - ay)
    share = ((bx - ax) * rod[1] - (by - ay) * rod[0]) / (frame[0] * rod[1] - frame[1] * rod[0])
    meets = (ax + share * frame[0], ay + share * frame[1])
    off = [(draw.randint(1000, 9999), draw.randint(6, most)) for most in (16, 33)]
    beside = [
        tuple(c + part * n / 10**k for c, part in zip(at, (Fraction(3, 5), Fraction(-4, 5)), strict=True))
        for at, (n, k) in zip((places[0], meets), off, strict=True)
    ]

    def digits(at: tuple[Fraction, ...]) -> tuple[str, ...]:
        with localcontext(prec=60):
            return tuple(str(Decimal(c.numerator) / c.denominator) for c in at)

    for change, verdict in ((0, "agrees"), (2, "disagrees")):
        near, far = (f"{n + change}e-{k}" for n, k in off)
        a, b, c, d, p, q = map(digits, (*places, *beside))
        text = BESIDE.format(a=a, b=b, c=c, d=d, p=p, q=q, near=near, far=far)
        rows = compare(solve(load(text), all_centres=True, examine=True))
        assert [one.verdict for one in rows] == [verdict] * 2, rows


def test_no_distance_to_a_centre_at_infinity() -> None:
    far = {"centres": {("1", "4"): Centre(("1", "4"), "toward", (90.0,))}}
    said = row(DistanceIs(("1", "4"), "A"), "3.1", answer=far)
    assert said.verdict == "disagrees"
    assert "1-4 is at infinity, toward 90" in said.text


def test_an_undefined_centre_and_one_that_was_not_found_say_so() -> None:
    undefined = {"centres": {("3", "6"): Centre(("3", "6"), "undefined", why="3 and 6 move as one")}}
    assert "3 and 6 move as one" in row(CentreIs(("3", "6")), "1", "2", answer=undefined).text
    assert row(CentreIs(("1", "3")), "1", "2").text == "the centre 1-3 was not found"


def test_rates_ratios_and_speeds() -> None:
    motion = {
        "rates": {"1": 0.0, "2": -77.36, "4": 19.34},
        "velocities": {("C", "4"): (-45.0, 60.0)},
    }
    assert row(RateIs("2"), "77.36", sense="cw", answer=dict(motion)).verdict == "agrees"
    assert row(RateIs("2"), "77.36", answer=dict(motion)).verdict == "disagrees"
    assert row(RatioIs("4", "2"), "-0.25", answer=dict(motion)).verdict == "agrees"
    assert row(SpeedIs("C", "4"), "75", answer=dict(motion)).verdict == "agrees"
    assert row(SpeedIs("C", "4"), "75", sense="up", answer=dict(motion)).verdict == "agrees"
    assert row(SpeedIs("C", "4"), "75", sense="right", answer=dict(motion)).verdict == "disagrees"
    assert "does not turn" in row(RatioIs("4", "1"), "1", answer=dict(motion)).text


def test_what_is_not_solved_for_is_not_examined() -> None:
    assert row(ReactionIs("3", "4"), "909").verdict == "not examined"
    assert row(ArmIs("3", "4", "A"), "2.76").verdict == "not examined"
    assert "no pin at B has friction" in row(FrictionRadiusIs("B"), "0.196").text


def test_only_what_the_published_values_need_is_asked_of_the_solver() -> None:
    def needs(target: Target) -> tuple[bool, ...]:
        return tuple(wanted(four_bar_case(expect=(published("key", target, "1"),))).values())

    assert needs(T12) == (False, False, False)
    assert needs(DistanceIs(("2", "4"), "A")) == (True, False, False)
    assert needs(RatioIs("4", "2")) == (False, True, False)
    assert needs(ReactionIs("3", "4")) == (False, False, True)


def test_reactions_of_a_range_at_rest_can_not_agree() -> None:
    """Without `motion` the friction is open within its limits, and with it the reactions."""
    case = load("""
icsolve: 1
points: {A: [0, 0]}
joints:
  - {slide: [2, 1], at: A, along: 40, mu: 0.3}
loads:
  W: {weight: 100, link: 2, at: A}
  P: {force: unknown, link: 2, at: A, angle: 0}
expect: {F12: 182.1}
""")
    (only,) = compare(solve(case, reactions=True))
    assert only.verdict == "disagrees"
    assert any("give `motion`" in str(part) for part in only)


@pytest.mark.parametrize(("asked", "text"), [("FAD-AB", "F1-AD"), ("FAB-AD@A", "F1-AB")])
def test_a_force_between_two_links_of_a_pin_of_several_says_who_carries_it(asked: str, text: str) -> None:
    case = load(template("truss") + f"expect: {{{asked}: 4}}\n")
    (only,) = compare(solve(case, reactions=True))
    assert only.verdict == "disagrees"
    assert f"the pin at A is carried by link 1, which is named first: ask for {text}" in only.text


PUSHED = {
    "plane": "{A: [0, 0], B: [3, 0]}\njoints: [{pin: [1, 2], at: A}]\nloads:\n"
    "  P: {force: [30, 40], link: 2, at: B}\n  T: {torque: unknown, link: 2}\n",
    "space": "{A: [0, 0, 0], B: [3, 0, 0]}\njoints: [{hinge: [1, 2], at: A, axis: z}]\nloads:\n"
    "  P: {force: [30, 40, 0], link: 2, at: B}\n  T: {torque: unknown, link: 2, along: z}\n",
}


@pytest.mark.parametrize("of", PUSHED)
def test_a_load_by_its_components_is_compared_by_its_size(of: str) -> None:
    """In the plane and in space alike; so is what is like an unknown."""
    like = "  U: {torque: {like: T, times: -0.5}, link: 2" + (", along: z}\n" if of == "space" else "}\n")
    text = f"icsolve: 1\npoints: {PUSHED[of]}{like}expect: {{P: 50, T: -240, U: 120}}\n"
    assert [row.verdict for row in compare(solve(load(text)))] == ["agrees"] * 3


@pytest.mark.parametrize(
    ("given", "published", "wrong"),
    [
        ("force: 50, angle: 90, at: B", "50 up", "50 down"),
        ("force: -50, angle: 90, at: B", "50 down", "50 up"),
        ("force: 50, toward: A, at: B", "50 toward A", "50 right"),
        ("force: [30, 40], at: B", "50 at 53.13 deg", "50 left"),
        ("weight: 50, at: B", "50 down", "50 up"),
        ("torque: 50, turns: cw", "50 cw", "50 ccw"),
    ],
)
def test_the_sense_of_a_load_that_is_given_is_compared_too(given: str, published: str, wrong: str) -> None:
    text = (
        f"{PUSHED['plane'].partition('  P')[0]}  P: {{{given}, link: 2}}\n  T: {{torque: unknown, link: 2}}\n"
    )
    for value, verdict in ((published, "agrees"), (wrong, "disagrees")):
        (only,) = compare(solve(load(f"icsolve: 1\npoints: {text}expect: {{P: {value}}}\n")))
        assert only.verdict == verdict, only


def test_a_force_that_points_elsewhere_is_not_said_to_be_opposite() -> None:
    text = f"{PUSHED['plane'].partition('  P')[0]}  P: {{force: 50, angle: 90, at: B, link: 2}}\n"
    text += "  T: {torque: unknown, link: 2}\n"
    for sense in ("at 80 deg", "left"):
        (only,) = compare(solve(load(f"icsolve: 1\npoints: {text}expect: {{P: 50 {sense}}}\n")))
        assert only.found == "50 in another direction", only


@pytest.mark.parametrize("written", ["8", "8 MPa", "8000000", "8e6 Pa", "80 bar"])
def test_a_pressure_that_disagrees_is_told_with_the_unit_that_it_was_read_in(written: str) -> None:
    """Bare it is a force over a length squared of the case, and its answer in MPa: of 8 and 8 nothing would
    show why they disagree."""
    text = f"""icsolve: 1
points: {{A: [0, 0]}}
joints: [{{slide: [2, 1], at: A, along: 0}}]
loads:
  p: {{pressure: unknown, area: 2000 mm^2, link: 2, at: A, angle: 0}}
  F: {{force: 16000, link: 2, at: A, angle: 180}}
expect: {{p: {written}}}
"""
    (only,) = compare(solve(load(text)))
    assert only.verdict == ("disagrees" if written == "8" else "agrees")
    assert only.verdict == "agrees" or (only.published, only.found) == ("8e-06 MPa", "8 MPa")


_TOWARD = {"right": 0.0, "up": 90.0, "left": 180.0, "down": 270.0, "at 40 deg": 40.0, "toward A": 180.0}
_COMPARED = set(product(("P", "F21", "Q"), _TOWARD)) - {("F21", "toward A")}  # which acts there


@pytest.mark.parametrize(("key", "sense"), sorted(_COMPARED))
def test_a_negative_number_with_a_sense_is_its_size_the_other_way(key: str, sense: str) -> None:
    """Nothing else agrees, and of nothing that agrees it is said that it goes another way. A load that is
    given, the reaction to it, and one by its components, in every direction: by the angle between them."""
    room = 45.0 if sense in ("right", "up", "left", "down") else 1.0
    for degrees in (*range(0, 360, 30), 40.5, 219.5, 44.0, 136.0):
        x, y = 50.0 * math.cos(math.radians(degrees)), 50.0 * math.sin(math.radians(degrees))
        text = (
            "icsolve: 1\npoints: {A: [0, 0], B: [3, 0], C: [-3, 0]}\njoints: [{pin: [1, 2], at: A}]\n"
            f"loads:\n  P: {{force: 50, angle: {degrees}, at: B, link: 2}}\n"
            f"  Q: {{force: [{x!r}, {y!r}], at: C, link: 2}}\n"
            f"  R: {{force: [{-x!r}, {-y!r}], at: A, link: 2}}\n  T: {{torque: unknown, link: 2}}\n"
        )
        own = _TOWARD[sense] + (180.0 if key == "Q" and sense == "toward A" else 0.0)  # A lies right of C
        for size, way in ((50, 0.0), (-50, 180.0)):
            case = load(f"{text}expect: {{{key}: {size} {sense}}}\n")
            (only,) = compare(solve(case, reactions=True))
            agrees = abs(math.remainder(degrees - own - way, 360.0)) <= room + 1e-9
            assert (only.verdict, degrees) == ("agrees" if agrees else "disagrees", degrees), only
            assert only.found == (f"{size}" if agrees else "50 in another direction")
