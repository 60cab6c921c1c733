"""Redundant joints: a mechanism that goes on moving, or a structure that yields for an instant."""

from __future__ import annotations

import re
from decimal import Decimal
from fractions import Fraction
from random import Random

import pytest

import icsolve

MOVES, BINDS = "goes on moving to second order", "only for an instant"


def note(text: str) -> str:
    """What the answer says of its redundant joints."""
    return " ".join(icsolve.solve(icsolve.load(text)).notes)


def rod_on_three_guides(third: str, along: str) -> str:
    """A rod on blocks at (3, 0) and (0, 4) that slide on the axes, and a third block on it."""
    return (
        "icsolve: 1\n"
        f"points: {{O: [0, 0], A: [3, 0], B: [0, 4], C: [{third}]}}\n"
        "joints:\n"
        "  - {slide: [2, 1], at: A, along: 0}\n  - {pin: [2, 5], at: A}\n"
        "  - {slide: [3, 1], at: B, along: 90}\n  - {pin: [3, 5], at: B}\n"
        f"  - {{slide: [4, 1], at: C, along: {along}}}\n  - {{pin: [4, 5], at: C}}\n"
        "loads:\n"
        "  P: {force: 1, link: 2, at: A, angle: 0}\n  Q: {force: unknown, link: 3, at: B, angle: 90}\n"
    )


def test_cardan_circles_a_third_point_of_the_small_circle_runs_straight() -> None:
    """The circle on A and B through O: its point (2.2, -0.4) moves on the line through O for ever."""
    assert MOVES in note(rod_on_three_guides("2.2, -0.4", "[O, C]"))


def test_another_point_of_the_rod_runs_straight_for_an_instant_only() -> None:
    """(1, 1): its guide is square to the ray from the centre (3, 4), as its velocity is."""
    text = rod_on_three_guides("1, 1", "[C, D]").replace("C: [1, 1]", "C: [1, 1], D: [4, -1]")
    assert BINDS in note(text)


@pytest.mark.parametrize(
    ("third", "along", "end"), [("2.2, -0.4", "[O, C]", MOVES), ("1, 1", "[C, D]", BINDS)]
)
def test_a_pin_in_a_slot_says_the_same_as_on_a_block(third: str, along: str, end: str) -> None:
    """The third block left out: its pin slides in the guide."""
    text = rod_on_three_guides(third, along).replace("{slide: [4, 1], at: C", "{slot: [5, 1], at: C")
    text = text.replace("  - {pin: [4, 5], at: C}\n", "").replace("C: [1, 1]", "C: [1, 1], D: [4, -1]")
    said = note(text)
    assert "1 redundant constraint" in said
    assert end in said


def test_wheels_in_a_ring_go_on() -> None:
    """Two pairs of equal teeth on one shaft and another: the second pair repeats the first."""
    text = (
        "icsolve: 1\npoints: {A: [0, 0], B: [3, 0]}\n"
        "joints:\n  - {pin: [2, 1], at: A}\n  - {pin: [3, 1], at: B}\n"
        "  - {gears: [2, 3], teeth: [20, 40]}\n  - {gears: [2, 3], teeth: [10, 20]}\n"
        "loads: {T: {torque: 1, link: 3}, U: {torque: unknown, link: 2}}\n"
    )
    assert MOVES in note(text)


def pinned(points: str, pairs: str) -> str:
    """Links pinned two by two at A, B, C, ..., a torque on the last link, another to find on link 2."""
    names = [chr(65 + k) for k in range(len(pairs.split()))]
    places = ", ".join(f"{n}: [{p}]" for n, p in zip(names, points.split("; "), strict=True))
    both = zip(names, pairs.split(), strict=True)
    joints = "".join(f"  - {{pin: [{pair[0]}, {pair[1]}], at: {n}}}\n" for n, pair in both)
    last = max(pairs.replace(" ", ""))
    return (
        f"icsolve: 1\npoints: {{{places}}}\njoints:\n{joints}"
        f"loads: {{K: {{torque: 1, link: {last}}}, U: {{torque: unknown, link: 2}}}}\n"
    )


def test_a_truss_of_two_bars_in_line_gives_way_for_an_instant() -> None:
    assert BINDS in note(pinned("0, 0; 4, 0; 1, 0", "12 13 23"))


@pytest.mark.parametrize("ends", ["1, 2; 3, 2; 6, 2", "-2, 1; 0, 1; 3, 1"])
def test_parallel_cranks_go_on(ends: str) -> None:
    """Three equal parallel cranks on one coupler (links 2, 3, 4 and 5)."""
    assert MOVES in note(pinned(f"0, 0; 2, 0; 5, 0; {ends}", "12 13 14 25 35 45"))


def test_cranks_parallel_but_unequal_bind() -> None:
    """All three crank ends move alike for an instant: the coupler translates, and then cannot."""
    assert BINDS in note(pinned("0, 0; 2, 0; 5, -1; 1, 2; 3, 2; 6.5, 2", "12 13 14 25 35 45"))


@pytest.mark.parametrize("off", ["1e-10", "-1e-18"])
def test_cranks_as_good_as_equal_bind_by_their_decimals(off: str) -> None:
    """The third of three parallel cranks is longer or shorter by that much, of sqrt(5)."""
    x, y = (Fraction(off) * k for k in (1, 2))
    end = f"{_decimal(6 + x)}, {_decimal(2 + y)}"
    assert BINDS in note(pinned(f"0, 0; 2, 0; 5, 0; 1, 2; 3, 2; {end}", "12 13 14 25 35 45"))


def _decimal(value: Fraction) -> str:
    return f"{Decimal(value.numerator) / Decimal(value.denominator)}"


EXACT, HELD = "moves only because the figure is exact", "the motion does not depend on"


@pytest.mark.parametrize("seed", range(24))
def test_what_holds_a_part_in_itself_twice_does_not_make_the_others_move(seed: int) -> None:
    """A slider-crank or a four-bar of any figure, one link of which carries more: a plate on two pins of it,
    a triangle of bars and one bar over, a plate on one pin with two more pins in slots."""
    draw = Random(f"held {seed}")
    base = draw.choice("1234")
    p, q, r, s = ([round(draw.uniform(-3, 3), 3) for _ in "xy"] for _ in range(4))
    near = f"P: {p}, Q: {q}, R: {r}, S: {s}"
    held, parts = draw.choice(
        [
            (f"{{pin: [{base}, 5], at: P}}, {{pin: [{base}, 5], at: Q}}", "5"),
            (
                f"{{pin: [{base}, 5], at: P}}, {{pin: [{base}, 6], at: Q}}, {{pin: [5, 6], at: R}}, "
                f"{{pin: [5, 7], at: S}}, {{pin: [{base}, 7], at: R}}",
                "567",
            ),
            (
                f"{{pin: [{base}, 5], at: P}}, {{slot: [5, {base}], at: Q, along: 17}}, "
                f"{{slot: [5, {base}], at: R, along: 62.5}}",
                "5",
            ),
        ]
    )
    last = draw.choice(["{pin: [4, 1], at: D}", "{slide: [4, 1], at: C, along: 4}"])
    said = note(
        f"icsolve: 1\npoints: {{A: [0, 0], B: [1, 1.1], C: [4, 1.9], D: [3.7, -0.3], {near}}}\n"
        f"joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {last}, {held}]\n"
        "loads: {P1: {force: 9, link: 4, at: C, angle: 7}, U: {torque: unknown, link: 2}}\n"
    )
    assert "1 redundant constraint" in said
    assert HELD in said
    assert EXACT not in said
    for link in (base, *parts):
        assert re.search(rf"links [^;]*\b{link}\b", said), (link, said)


@pytest.mark.parametrize("seed", range(8))
def test_a_rack_by_teeth_is_not_held_twice(seed: int) -> None:
    """Teeth push along their line of action; a wheel that rolls without teeth keeps its distance too."""
    draw = Random(f"rack {seed}")
    r, y = draw.choice([20, 35.5, 40]), draw.choice([-7, 0, 12.25])
    roll = f"roll: [2, 3], at: P, radii: [{r}, 0]"
    text = (
        f"icsolve: 1\npoints: {{A: [3, {y}], P: [3, {y - r}], R: [{draw.randint(30, 90)}, {y - r - 5}]}}\n"
        f"joints: [{{pin: [1, 2], at: A}}, {{{roll}}}, {{slide: [3, 1], at: R, along: 0}}]\n"
        "loads: {T: {torque: 10, link: 2}, F: {force: unknown, link: 3, at: R, angle: 180}}\n"
    )
    assert EXACT in note(text)
    toothed = note(text.replace(roll, f"{roll}, pressure angle: {draw.choice([14.5, 20, 25])}"))
    assert "redundant" not in toothed


def test_wedges_and_a_part_that_is_held_twice_are_told_apart() -> None:
    """Links that only slide on each other, and a plate on two pins of the frame."""
    said = note(
        "icsolve: 1\npoints: {A: [0, 0], B: [0.1, 0.05], C: [0.2, 0.2], P: [1, 1], Q: [2, 1.5]}\n"
        "joints: [{slide: [w, 1], at: A, along: 0}, {slide: [b, w], at: B, along: 160},\n"
        "  {slide: [b, 1], at: C, along: 90}, {pin: [1, p], at: P}, {pin: [1, p], at: Q}]\n"
        "loads: {W: {weight: 10, link: b, at: C}, F: {force: unknown, link: w, at: A, angle: 180}}\n"
    )
    assert "2 redundant constraints" in said
    assert EXACT not in said
    assert HELD in said


@pytest.mark.parametrize("lengths", ["AB: 1, BC: 3.5, CD: 2.5", "AB: 3, BC: 4, CD: 3", "AB: 3, BC: 2, CD: 1"])
def test_a_four_bar_at_a_change_point_moves_elsewhere_too(lengths: str) -> None:
    """All its links in one line: one freedom it has whatever its lengths, another one here."""
    said = note(
        f"icsolve: 1\npoints: {{A: [0, 0], D: [2, 0]}}\nlengths: {{{lengths}}}\nangles: {{AB: 0}}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]\n"
        "loads: {P: {force: 30, link: 4, at: C, angle: 180}, T: {torque: unknown, link: 2}}\n"
    )
    assert "1 of its 2 freedoms it has only because the figure is exact" in said
    assert "it moves only" not in said
