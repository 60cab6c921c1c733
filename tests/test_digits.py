"""Every number of a scene is the exact one for the decimals in the file, rounded once.

Against the same program in 140 digits of mpmath: within one unit in the last place, stated errors at
most two of them and never broken; scenes of all joints, and scenes a hair from a dead centre.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf

import growth
import icsolve
import loading
import mechanisms
import transcribe
from figures import from_lengths, without_order
from icsolve.bench.accuracy import every_row, friction_ends, shown
from icsolve.bench.families import EXACT, RUBBING, Family
from icsolve.errors import SceneError
from icsolve.manual import template
from icsolve.report.derivation.known import known_of
from sizes import FULL, sampled


def check(text: str) -> None:
    """All numbers of a scene against 140 digits, of which the nearest singular position leaves enough."""
    case = icsolve.load(text)
    assert [one.fault for one in shown(case) if one.fault] == []


def all_joints(count: int) -> Iterator[str]:
    """Scenes of all joint kinds, by coordinates and by lengths."""
    kinds = [
        mechanisms.four_bar, mechanisms.watt, mechanisms.slider_crank, mechanisms.coupler_slot,
        mechanisms.oldham, mechanisms.trammel, mechanisms.gear_pair, mechanisms.epicyclic, mechanisms.belt,
        mechanisms.cam, mechanisms.stephenson,
    ]  # fmt: skip
    seed = 0
    while count > 0:
        seed += 1
        rng = Random(f"digits {seed}")
        way = seed % 4
        if way == 0:
            scene: Any = growth.random_mechanism(rng, 1 + seed % 3 // 2)
        elif way == 1:
            scene = loading.drawn(seed, kinds[seed % len(kinds)])
        elif way == 2:
            scene = from_lengths(loading.drawn(seed, rng.choice(kinds[:2] + kinds[-1:])), rng)
        else:
            scene = without_order(loading.drawn(seed, mechanisms.butterfly), rng) if seed % 8 == 7 else None
        if scene is not None:
            count -= 1
            yield transcribe.text(scene)


@pytest.mark.parametrize("block", range(30 if FULL else 1))
def test_every_number_of_scenes_of_all_joints(block: int) -> None:
    for k, text in enumerate(all_joints(10 * (block + 1))):
        if k >= 10 * block:
            check(text)


def beside_a_dead_centre(rng: Random) -> str:
    """A four-bar or a slider-crank 1e-3 to 1e-12 from where its input is dead, or its output stands still."""
    gap = f"{rng.randint(1, 9)}e-{rng.randint(3, 12)}"
    if rng.random() < 0.5:
        crank, rod, degrees = rng.uniform(0.5, 2.0), rng.uniform(2.5, 6.0), rng.choice([0, 180])
        angle = f"{mp.nstr(mpf(degrees) + mpf(gap) * rng.choice([-1, 1]), 30)}"
        return f"""
icsolve: 1
points: {{A: [{rng.uniform(-2, 2):.3f}, {rng.uniform(-2, 2):.2f}], C: [unknown, unknown]}}
lengths: {{AB: {crank:.3f}, BC: {rod:.3f}}}
angles: {{AB: {angle}, AC: 0}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{slide: [4, 1], at: C, along: 0}}
loads: {{P: {{force: {rng.uniform(1, 90):.2f}, link: 4, at: C, angle: 180}}, T: {{torque: unknown, link: 2}}}}
""".replace(", C: [unknown, unknown]", "")
    x, y, u, v = (round(rng.uniform(1, 4), 2) for _ in range(4))
    side = mpf(gap) * rng.choice([-1, 1])
    bx, by = mpf(str(x)), mpf(str(y))
    cx, cy = bx + mpf(str(u)), by + mpf(str(v))
    t = mpf(str(round(rng.uniform(0.5, 2), 1)))
    dx, dy = mp.nstr(cx + t * mpf(str(u)) - side * mpf(str(v)), 40), mp.nstr(cy + t * mpf(str(v)) + side, 40)
    on = rng.choice([(4, 2), (2, 4)])
    return f"""
icsolve: 1
points: {{A: [0, 0], B: [{x}, {y}], C: [{mp.nstr(cx, 20)}, {mp.nstr(cy, 20)}], D: [{dx}, {dy}]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
loads: {{K: {{torque: {rng.uniform(1, 90):.2f}, link: {on[0]}}}, T: {{torque: unknown, link: {on[1]}}}}}
"""


@pytest.mark.parametrize("seed", range(100 if FULL else 12))
def test_every_number_beside_a_dead_centre(seed: int) -> None:
    check(beside_a_dead_centre(Random(f"beside {seed}")))


def notes(text: str) -> list[str]:
    return [note for note in icsolve.solve(icsolve.load(text)).notes if "half a unit" in note]


TOGGLE = """
icsolve: 1
points: {A0: [0, 0], A: [%s, 0], B: [%s, 2], B0: [3, 4]}
joints:
  - {pin: [1, 2], at: A0}
  - {pin: [2, 3], at: A}
  - {pin: [3, 4], at: B}
  - {pin: [4, 1], at: B0}
loads: {M4: {torque: 1, link: 4}, M2: {torque: unknown, link: 2}}
"""


@pytest.mark.parametrize("gap", ["2.00001", "2.0000000000000001", "2.0000000000000000000000001"])
def test_what_half_a_unit_of_a_last_decimal_could_do_is_told(gap: str) -> None:
    """A measured 1.0 leaves open on which side of the dead centre it is; a whole 1 is exact."""
    (note,) = notes(TOGGLE % ("1.0", gap))
    assert "points.A.x (1.0) could move M2" in note
    assert notes(TOGGLE % ("1", gap)) == []
    assert notes(TOGGLE % ("1.0", "2.4")) == []


@pytest.mark.parametrize("unit", ["m", "cm", "in"])
def test_a_decimal_in_the_unit_of_the_case_is_a_bare_one(unit: str) -> None:
    """It is no whole number for that it carries the unit."""
    bare = TOGGLE + f"units: {{length: {unit}}}\n"
    (note,) = notes(bare % ("1.0", "2.00001"))
    assert notes(bare % (f"1.0 {unit}", f"2.00001 {unit}")) == [note]
    assert notes(bare % (f"1 {unit}", f"2.00001 {unit}")) == []


def turned_parallelogram(angle: float, off: float = 0.0) -> str:
    """Three parallel cranks, turned by a program: one constraint repeats the others to 1e-16."""
    c, s = math.cos(angle), math.sin(angle)
    spots = {"A": (0, 0), "B": (2, 0), "C": (5, 0), "D": (1, 2), "E": (3, 2), "F": (6 + off, 2)}
    points = ", ".join(f"{p}: [{x * c - y * s!r}, {x * s + y * c!r}]" for p, (x, y) in spots.items())
    return f"""
icsolve: 1
ground: 0
points: {{{points}}}
joints:
  - {{pin: [0, 1], at: A}}
  - {{pin: [0, 2], at: B}}
  - {{pin: [0, 3], at: C}}
  - {{pin: [1, 4], at: D}}
  - {{pin: [2, 4], at: E}}
  - {{pin: [3, 4], at: F}}
loads: {{K: {{torque: 1, link: 2}}, M1: {{torque: unknown, link: 1}}}}
"""


@pytest.mark.parametrize("angle", [0.3, 1.1, 2.7, -0.8])
def test_a_constraint_that_a_program_rounded_counts_as_exact_and_that_is_said(angle: float) -> None:
    answer = icsolve.solve(icsolve.load(turned_parallelogram(angle)))
    found = answer.answers["M1"]
    assert found.error is not None
    assert abs(found.value + 1.0) <= found.error < 1e-11
    assert any("half a unit of the last digit" in note for note in answer.notes)
    with pytest.raises(SceneError):
        icsolve.solve(icsolve.load(turned_parallelogram(angle, off=1e-9)))


def scenes(family: Family, count: int) -> Iterator[icsolve.Case]:
    """The scenes of the benchmark, each with an answer."""
    for seed in range(count // family.weight + 1):
        case = icsolve.load(family.draw(Random(f"{family.name} {seed}")))
        with contextlib.suppress(SceneError):
            icsolve.solve(case)
            yield case


@sampled(2)
@pytest.mark.parametrize("family", EXACT, ids=lambda family: family.name)
def test_every_number_of_the_families_of_the_benchmark(family: Family) -> None:
    for case in scenes(family, 1000 if FULL else 4):
        assert [one.fault for one in shown(case) if one.fault] == []


@pytest.mark.parametrize("family", RUBBING, ids=lambda family: family.name)
def test_both_ends_that_friction_holds_are_those_in_closed_form(family: Family) -> None:
    for case in scenes(family, 1000 if FULL else 3):
        assert [one.fault for one in friction_ends(case) if one.fault] == []


@pytest.mark.parametrize("family", EXACT[:5], ids=lambda family: family.name)
def test_rows_are_scenes_and_the_first_is_the_position_as_written(family: Family) -> None:
    for case in scenes(family, 300 if FULL else 3):
        assert every_row(case) > 0.0


def test_where_no_load_does_work_no_row_has_a_value() -> None:
    """Links 6 and 4 move as one, and the known torque does no work either: found among random scenes."""
    mixed = EXACT[0]
    assert every_row(icsolve.load(mixed.draw(Random(f"{mixed.name} 1385")))) > 0.0


HAIRS = ["179.999", "179.999999", "179.999999999", "179.9999999999999999", "180.000001"]


@pytest.mark.parametrize("degrees", HAIRS)
def test_a_change_point_is_a_hair_beside_and_no_dead_centre(degrees: str) -> None:
    """Lengths 4, 1, 3, 2 fold flat at 180 degrees: beside it there is an answer, with all its digits."""
    check(f"""
icsolve: 1
points: {{A: [0, 0], D: [4, 0]}}
lengths: {{AB: 1, BC: 3, CD: 2}}
angles: {{AB: {degrees}}}
near: {{C: [2.13, {0.7 if float(degrees) < 180 else -0.7}]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 1], at: D}}
loads: {{T4: {{torque: 10, link: 4}}, T: {{torque: unknown, link: 2}}}}
""")


@pytest.mark.parametrize("power", [-300, -299, -150, 150, 299])
def test_loads_of_any_size_have_answers_of_the_same_digits(power: int) -> None:
    """Nothing is small or large but beside something else."""
    press = template("four-bar")
    (one,) = icsolve.solve(icsolve.load(press)).answers.values()
    other = icsolve.solve(icsolve.load(press.replace("force: 100", f"force: 1e{power}")))
    (value,) = (found.value for found in other.answers.values())
    assert value == pytest.approx(one.value * 10.0 ** (power - 2), rel=1e-15, abs=0.0)
    assert other.advantage == pytest.approx(one.value / 100.0, rel=1e-15)


def test_a_train_of_gears_keeps_the_digits_of_its_last_wheel() -> None:
    """Fourteen meshes of 11 to 253: the last wheel turns at 23^-14, and no threshold calls that nothing."""
    count = 15
    points = ", ".join(f"P{k}: [{3 * k}, 0]" for k in range(count))
    joints = [f"  - {{pin: [1, {k + 2}], at: P{k}}}" for k in range(count)]
    joints += [f"  - {{gears: [{k + 2}, {k + 3}], teeth: [11, 253]}}" for k in range(count - 1)]
    text = f"icsolve: 1\npoints: {{{points}}}\njoints:\n" + "\n".join(joints)
    text += f"\nloads: {{K: {{torque: 7.5, link: {count + 1}}}, U: {{torque: unknown, link: 2}}}}\n"
    check(text)
    answer = icsolve.solve(icsolve.load(text), rates=True)
    assert answer.rates is not None
    assert answer.rates[str(count + 1)] == pytest.approx(23.0**-14, rel=1e-15)
    assert answer.answers["U"].value == pytest.approx(-7.5 * 23.0**-14, rel=1e-15)


ONCE_WRONG = sorted((Path(__file__).parent / "data" / "digits").glob("*.yaml"))


@pytest.mark.parametrize("file", ONCE_WRONG, ids=lambda file: file.stem)
def test_scenes_that_were_once_wrong(file: Path) -> None:
    check(file.read_text())


@pytest.mark.parametrize("speed", [3.0, 0.125])
def test_all_rates_go_with_the_given_speed(speed: float) -> None:
    """A mutant that divided by the speed lived."""
    text = beside_a_dead_centre(Random("beside 0"))
    given = [f"{text}motion: {{link: 2, turns: cw, speed: {w} rad/s}}\n" for w in (1, speed)]
    one, many = (icsolve.solve(icsolve.load(case), rates=True).rates for case in given)
    assert one is not None
    assert many is not None
    assert many["2"] == -speed
    assert many == pytest.approx({link: speed * float(rate) for link, rate in one.items()}, rel=1e-15)


KNEE = """
icsolve: 1
points: {{A: [{x}, {y}]}}
lengths: {{AB: {bar}, BC: {bar}}}
angles: {{AB: {angle}}}
near: {{C: [{x}, {y}]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{slide: [4, 1], at: C, along: {along}, through: A}}
loads:
  S: {{{load}, link: 4, at: C}}
  P: {{force: unknown, link: 2, at: B, angle: -90}}
"""


@pytest.mark.parametrize(
    "load", ["spring: 2, free: 400, to: A", "force: 3, toward: A", "spring: 2, free: 0, to: A"]
)
@pytest.mark.parametrize("seed", range(60 if FULL else 6))
def test_two_points_that_the_decimals_make_one_give_no_direction(load: str, seed: int) -> None:
    """Folded together a knee has its end on its foot, wherever rounding of doubles puts it."""
    rng = Random(f"knee {seed}")
    near = {key: f"{rng.uniform(1, 80):.2f}" for key in ("x", "y", "bar", "angle", "along")}
    case = icsolve.load(KNEE.format(load=load, **near))
    if "free: 0" in load:
        assert icsolve.solve(case).answers["P"].value == 0.0
        return
    with pytest.raises(SceneError, match="lie at one place") as refusal:
        icsolve.solve(case)
    assert refusal.value.status == "inconsistent"


NEAR_REST = """\
icsolve: 1
points: {{A: [0, 0], B: [3, {off}], C: [9, 0], D: [7, -4]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
loads: {{M: {{torque: 5, link: 4}}, T: {{torque: unknown, link: 2}}}}
motion: {{link: 2, speed: 1 rad/s}}
"""


@pytest.mark.parametrize("off", ["0", "1e-13", "-1e-25"])
def test_a_slow_link_is_not_told_to_rest(off: str) -> None:
    """Explanations and pictures have the rates of the answer, however slow a link is: a rocker where
    crank and coupler are in line, and beside that."""
    known = known_of(icsolve.load(NEAR_REST.format(off=off)))
    rates = icsolve.solve(known.case, rates=True).rates
    assert rates is not None
    for link, (_, _, rate) in known.twists.items():
        assert rate == pytest.approx(rates[link], rel=1e-15, abs=0.0)
    assert known.turns("4") == (float(off) != 0.0)


def lift(stages: int, wide: Decimal, high: Decimal) -> str:
    """Scissors by coordinates alone: a load on the top, a force at the foot that slides."""
    points = [f"{p}{k}: [{x}, {k * high}]" for k in range(stages + 1) for p, x in (("A", 0), ("B", wide))]
    points += [f"M{k}: [{wide / 2}, {(2 * k + 1) * high / 2}]" for k in range(stages)]
    joints = ["{pin: [1, 2], at: A0}", "{slot: [3, 1], at: B0, along: 0}"]
    joints += [f"{{pin: [{2 + 2 * k}, {3 + 2 * k}], at: M{k}}}" for k in range(stages)]
    for k in range(1, stages):
        joints += [
            f"{{pin: [{2 * k}, {2 * k + 3}], at: B{k}}}",
            f"{{pin: [{2 * k + 1}, {2 * k + 2}], at: A{k}}}",
        ]
    loads = f"W: {{force: 100, link: {2 * stages}, at: B{stages}, angle: -90}}, "
    loads += "P: {force: unknown, link: 3, at: B0, angle: 180}"
    return f"icsolve: 1\npoints: {{{', '.join(points)}}}\njoints: [{', '.join(joints)}]\nloads: {{{loads}}}\n"


@sampled(2, "stages", "wide")
@pytest.mark.parametrize("stages", [200, 300, 400] if FULL else [200, 400])
@pytest.mark.parametrize(("wide", "high"), [("1.2", "1.6"), ("1.9968", "0.112")])
def test_tall_scissors_by_coordinates_are_not_too_near_to_anything(stages: int, wide: str, high: str) -> None:
    """P is W's rise for each move of the foot, stages times wide over high: no digit of it is lost."""
    w, h = Decimal(wide), Decimal(high)
    found = icsolve.solve(icsolve.load(lift(stages, w, h))).answers["P"]
    assert found.value == float(100 * stages * Fraction(w) / Fraction(h)) and found.error is not None


def test_folded_scissors_have_no_answer_however_many_digits() -> None:
    """All bars on one line: the foot's force has no power, whatever it is."""
    with pytest.raises(SceneError) as one:
        icsolve.solve(icsolve.load(lift(100 if FULL else 40, Decimal(2), Decimal(0))))
    assert one.value.status != "near-singular"


def test_rows_of_tall_scissors_are_their_closed_form() -> None:
    """Rows that doubles leave open are scenes by coordinates, of as many links."""
    case = icsolve.load(lift(220, Decimal("1.2"), Decimal("1.6")))
    turns = np.array([-20.0, -7.5, 0.0, 11.0])
    rows = icsolve.sweep(case, drive={"2": turns})
    bars = np.arctan2(1.6, 1.2) + np.radians(turns)
    assert list(rows.status) == ["ok"] * len(turns)
    assert rows.answers["P"] == pytest.approx(22000.0 / np.tan(bars), rel=1e-13)
