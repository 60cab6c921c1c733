"""A row is a scene: beside limits, dead centres, change points and toggles, 1e-2 to 1e-13 degrees away, each
row has the status and the value of its own position, whatever the other rows are.

Truth is the closed form in sixty digits, on the decimals as written; where there is none, the record of the
sweep in sixty digits.
"""

from __future__ import annotations

import cmath
import contextlib
import math
import re
from collections.abc import Iterator
from dataclasses import replace
from decimal import Decimal
from functools import partial
from itertools import chain, combinations
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf

import full_turns
import icsolve
import transcribe
from icsolve.bench.promises import scissors
from icsolve.solve.stability import with_stability
from icsolve.sweep.find_on_record import Query, find
from icsolve.sweep.varied_numbers import numbers_of, with_numbers
from library import FILES, sample
from recorded import truths
from sizes import FULL, few, sampled
from test_sweep_status import FOUR_BAR, PARALLELOGRAM, SLIDER_CRANK

mp.dps = 60
WANT = ("answers", "status", "error", "points")
OFFS = [sign * 10.0**-k for k in range(2, 14) for sign in (-1.0, 1.0)]
FRAME = """icsolve: 1
points: {{A: [0, 0], D: [{d}, 0]}}
lengths: {{AB: {a}, BC: {b}, CD: {c}}}
angles: {{{path}: {written}}}
near: {{{point}: [{x}, {y}]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
loads: {{T14: {{torque: 10, link: 4}}, T12: {{torque: unknown, link: 2}}}}
"""


def written_as(a: Any, b: Any, c: Any, d: Any, path: str, written: int, point: str, near: Any) -> str:
    """A four-bar posed by an angle, with a point near a place."""
    at = {"x": float(near.real), "y": float(near.imag)}
    return FRAME.format(a=a, b=b, c=c, d=d, path=path, written=written, point=point, **at)


def turned(degrees: Any) -> Any:
    """A unit vector as a complex number."""
    return mp.expjpi(mpf(degrees) / 180)


def meets(p: Any, q: Any, r: Any, s: Any, sign: int) -> Any:
    """Where circles of radii r and s about p and q meet, to the left of pq or to its right; None apart."""
    d = abs(q - p)
    along = (r * r - s * s + d * d) / (2 * d)
    left = r * r - along * along
    return None if left < 0 else p + (q - p) / d * (along + mp.mpc(0, 1) * sign * mp.sqrt(left))


def torque(a: Any, b: Any, d: Any, c: Any) -> Any:
    """T12 against 10 on link 4: speeds of B and C along BC are equal."""
    rod = c - b
    w2, w4 = ((mp.conj(rod) * mp.mpc(0, 1) * arm).real for arm in (b - a, c - d))
    return -10 * w2 / w4


def checked(text: str, path: str, place: float, exact: Any, relative: float = 1e-6) -> icsolve.Sweep:
    """The rows beside a place held against the exact answer of each (None: it does not assemble)."""
    rows = np.array([place + off for off in OFFS])
    sweep = icsolve.sweep(icsolve.load(text), {path: rows}, WANT)
    for n, value in enumerate(rows):
        truth = exact(mpf(repr(float(value))))
        if truth is None:
            assert sweep.status[n] == "cannot-assemble", (value, sweep.status[n])
            continue
        assert sweep.status[n] == "ok", (float(value) - place, sweep.status[n])
        error, bound = abs(mpf(float(sweep.answers["T12"][n])) - truth), sweep.error["T12"][n]
        assert error <= bound, (float(value) - place, float(error), bound)
        assert bound <= relative * abs(truth)
    return sweep


# --- four-bars --------------------------------------------------------------------------------------


@sampled(2)
@pytest.mark.parametrize("seed", range(8))
def test_beside_the_limits_of_a_rocker_that_drives(seed: int) -> None:
    """Crank and rod in line, stretched: B is lost like a root, the torque falls like one."""
    rng = Random(seed)
    d, a, c = rng.randint(300, 500), rng.randint(50, 120), rng.randint(150, 280)
    b = d + rng.randint(-60, 20)
    d, a, b, c = (mpf(x) / 100 for x in (d, a, b, c))
    limit = 180 - mp.degrees(mp.acos((d * d + c * c - (a + b) ** 2) / (2 * d * c)))
    written = mp.nint(limit + 7)
    sign = rng.choice((-1, 1))

    def at(degrees: Any) -> Any:
        end = d + c * turned(degrees)
        b_ = meets(mpf(0), end, a, b, sign)
        return None if b_ is None else torque(0, b_, d, end)

    start = meets(mpf(0), d + c * turned(written), a, b, sign)
    text = written_as(a, b, c, d, "DC", int(written), "B", start)
    checked(text, "angles.DC", float(limit), at)


@sampled(2)
@pytest.mark.parametrize("seed", range(8))
def test_beside_the_dead_centres_of_a_crank(seed: int) -> None:
    """Rod and rocker in line, where the crank can go no further; and where the rocker stands still."""
    rng = Random(seed)
    d, a, b, c = (mpf(rng.randint(*r)) / 100 for r in ((300, 320), (150, 190), (200, 240), (100, 130)))
    limit = mp.degrees(mp.acos((a * a + d * d - (b + c) ** 2) / (2 * a * d)))
    written, sign = mp.nint(limit - 9), rng.choice((-1, 1))

    def at(degrees: Any) -> Any:
        pin = a * turned(degrees)
        c_ = meets(pin, d, b, c, sign)
        return None if c_ is None else torque(0, pin, d, c_)

    start = meets(a * turned(written), d, b, c, sign)
    text = written_as(a, b, c, d, "AB", int(written), "C", start)
    checked(text, "angles.AB", float(limit), at)


@sampled(4)
@pytest.mark.parametrize("seed", range(8))
def test_beside_change_points_the_way_goes_straight_on(seed: int) -> None:
    """All links in line where the crank lies along the frame: C goes through the line to its other side."""
    rng = Random(seed)
    a, d = rng.randint(5, 30), rng.randint(40, 60)
    folded = rng.random() < 0.5
    c = rng.randint(a + 5, d - 5)
    b, place = (d + a - c, 180.0) if folded else (d - a + c, 0.0)
    a, b, c, d = (mpf(x) / 10 for x in (a, b, c, d))
    written, sign = place - 35, rng.choice((-1, 1))

    def at(degrees: Any) -> Any:
        pin = a * turned(degrees)
        c_ = meets(pin, d, b, c, sign if degrees < place else -sign)
        return torque(0, pin, d, c_)

    start = meets(a * turned(written), d, b, c, sign)
    text = written_as(a, b, c, d, "AB", int(written), "C", start)
    sweep = checked(text, "angles.AB", place, at, 1e-3)
    assert any(f"change point at angles.AB = {place:.6g}" in note for note in sweep.notes)
    there = icsolve.sweep(icsolve.load(text), {"angles.AB": [place]}, WANT)
    assert there.status.tolist() == ["change-point"]
    assert np.isnan(there.answers["T12"]).all()


@sampled(4)
@pytest.mark.parametrize("seed", range(32 if FULL else 8))
def test_a_change_point_is_missed_by_whatever_the_decimals_miss_it(seed: int) -> None:
    """Links that miss the line by 1e-9 to 1e-30: too long or too short to fold, they are held up beside it;
    else C turns back before the line, and stays on its side of it."""
    rng = Random(f"missed {seed}")
    a, d, c = mpf(rng.randint(5, 30)), mpf(rng.randint(60, 80)), mpf(rng.randint(35, 55))
    folded, held = bool(seed & 1), bool(seed & 2)
    off = mpf(10) ** -rng.randint(9, 30) * (1 if folded != held else -1)
    b, place = (d + a - c + off, 180) if folded else (d - a + c + off, 0)
    reach = b + c if folded else b - c
    written, sign = place - 35, rng.choice((-1, 1))
    start = meets(a * turned(written), d, b, c, sign)
    text = written_as(*(mp.nstr(x, 40) for x in (a, b, c, d)), "AB", written, "C", start)
    found = find(icsolve.load(text), {"angles.AB": [place - 20.0, place + 20.0]}, Query("dead"))
    assert "change-point" not in {spot.kind for spot in found}, off
    limit = mp.acos((a * a + d * d - reach * reach) / (2 * a * d)) if held else None
    aside = mp.pi - limit if folded and limit else limit
    limits = [float(place + k * mp.degrees(aside)) for k in (-1, 1)] if held else []
    places = [spot.at for spot in found if spot.kind == "limit"]
    assert places == pytest.approx(limits, rel=1e-15, abs=0.0), (off, places, limits)
    rows = icsolve.sweep(icsolve.load(text), {"angles.AB": [place - 20.0, place + 20.0]}, WANT)
    for n, degrees in enumerate((place - 20, place + 20)):
        there = meets(a * turned(degrees), d, b, c, sign)
        assert complex(*rows.points["C"][n]) == pytest.approx(complex(there), abs=1e-12), (off, degrees)
    assert not any("change point" in note for note in rows.notes)
    assert any("do not reach" in note for note in rows.notes) == held


IN_LINE = """icsolve: 1
points: {{A: [10, -7], D: [{d}, -7]}}
lengths: {{AB: {ab}, BC: 2, CD: {cd}}}
angles: {{AB: {angle}}}
near: {{{near}}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
loads: {{T14: {{torque: 10, link: 4}}, T12: {{torque: unknown, link: 2}}}}
"""


@pytest.mark.parametrize("near", ["C: [11.9, -4.8]", "C: [11.3, -5.6]"])
def test_from_a_limit_as_written_the_rows_are_the_scenes_that_near_says(near: str) -> None:
    """B, C and D in line: the sides 3, 4 and 5 of a triangle. Either way leads on, without `near` none."""
    case = icsolve.load(IN_LINE.format(d=14, ab=3, cd=3, angle=90, near=near))
    angles = [89.9, 85.0, 80.0]
    rows = icsolve.sweep(case, {"angles.AB": angles}, WANT)
    for row, angle in enumerate(angles):
        scene = icsolve.solve(with_numbers(case, {"angles.AB": angle}))
        assert rows.points["C"][row] == pytest.approx(scene.points["C"], abs=1e-12)
        assert rows.answers["T12"][row] == pytest.approx(scene.answers["T12"].value, rel=1e-12)
    open_rows = icsolve.sweep(replace(case, near={}), {"angles.AB": angles}, WANT)
    assert open_rows.status.tolist() == ["ambiguous"] * 3


@pytest.mark.parametrize("side", [1, -1])
def test_from_a_change_point_as_written_near_says_which_way(side: int) -> None:
    """A parallelogram in line: C goes along with B, or round D the other way."""
    a, along = 10 - 7j, 0.6 + 0.8j
    near = a + (2.6 + 0.9j * side) * along
    text = IN_LINE.format(d=11.2, ab=1, cd=1, angle=0, near=f"C: [{near.real}, {near.imag}]")
    case = icsolve.load(text.replace("11.2, -7", "11.2, -5.4").replace("AB: 0", "DAB: 0"))
    for by in ({"vary": {"angles.DAB": [5.0]}}, {"drive": {"2": [5.0]}}):
        (place,) = icsolve.sweep(case, want=("points",), **by).points["C"]  # type: ignore[arg-type]
        b, c, d = a + complex(turned(5)) * along, complex(*place), a + 2 * along
        assert abs(c - b) == pytest.approx(2.0, rel=1e-12) and abs(c - d) == pytest.approx(1.0, rel=1e-12)
        assert (abs(c - b - 2 * along) < 1e-12) == (side > 0)


def flat_cranks(dice: Random, third: bool) -> tuple[str, list[str]]:
    """A crank AB of one length with others along one line, whose couplers reach as far as their pivots: the
    head of a case, its joints, and by how much `near` of C may lie off along that line, which is no side."""
    along = complex(*dice.choice([(0.6, 0.8), (1.0, 0.0), (-0.28, 0.96), (0.0, -1.0)]))
    crank, wide = dice.choice([0.5, 1.0, 1.5]), dice.choice([2.0, 2.5, 3.0])
    a = complex(dice.randint(-3, 3), dice.randint(-3, 3))
    d, c, e = a + wide * along, a + (wide + crank) * along, a + wide / 2 * along
    near = c + along * dice.choice([0.0, 0.2, -0.3]) + 1j * along * dice.choice([0.0, 0.001, -0.001])
    lengths, more = f"AB: {crank}, BC: {wide}, CD: {crank}", ""
    joints = ["{pin: [1, 2], at: A}", "{pin: [2, 3], at: B}", "{pin: [3, 4], at: C}", "{pin: [4, 1], at: D}"]
    if third:
        lengths, more = lengths + f", BF: {wide / 2}", ", CBF: 0"
        joints += ["{pin: [3, 5], at: F}", "{pin: [5, 1], at: E}"]
    points = {"A": a, "D": d} | ({"E": e} if third else {})
    text = ", ".join(f"{name}: [{z.real:.12g}, {z.imag:.12g}]" for name, z in points.items())
    head = (
        f"icsolve: 1\npoints: {{{text}}}\nlengths: {{{lengths}}}\nangles: {{DAB: 0{more}}}\n"
        f"near: {{C: [{near.real:.12g}, {near.imag:.12g}]}}\n"
        "loads: {T: {torque: unknown, link: 2}, P: {force: 5, link: 3, at: B, angle: 33}}\n"
    )
    return head, joints


@pytest.mark.parametrize("third", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_a_near_in_line_with_flat_links_tells_no_side_in_whatever_order_the_joints_stand(
    seed: int, third: bool
) -> None:
    """The rows then start from one that assembles, and are what `near` says there: the order of the joints,
    and of their links, chose between a parallelogram and the crossed one."""
    dice = Random(f"flat {seed} {third}")
    head, joints = flat_cranks(dice, third)
    found = set()
    for _ in range(4):
        own = dice.sample(joints, len(joints))
        own = [re.sub(r"\[(\d), (\d)\]", r"[\2, \1]", one) if dice.random() < 0.5 else one for one in own]
        case = icsolve.load(f"{head}joints: [{', '.join(own)}]\n")
        rows = icsolve.sweep(case, {"angles.DAB": [-40.0, 25.0]}, ("status", "points"))
        found.add((*rows.status.tolist(), *np.round(rows.points["C"], 9).ravel().tolist()))
    assert len(found) == 1
    assert next(iter(found))[:2] == ("ok", "ok")


def test_a_rough_near_does_not_put_a_driven_figure_on_another_branch_than_it_is_written_on() -> None:
    """B lies a little above the line AC, and its `near`, which the data do not need, below."""
    text = IN_LINE.format(d=14, ab=2, cd=3.5, angle=64, near="C: [12.4, -3.9], B: [11.6, -5.6]")
    case = icsolve.load(text)
    b, c = icsolve.solve(case).points["B"], icsolve.solve(case).points["C"]
    assert (b[0] - 10) * (c[1] + 7) < (b[1] + 7) * (c[0] - 10)
    assert (11.6 - 10) * (c[1] + 7) > (-5.6 + 7) * (c[0] - 10)
    driven = icsolve.sweep(case, want=("points",), drive={"4": [0.0]})
    assert driven.points["B"][0] == pytest.approx(b, abs=1e-12)


# --- slider-cranks ----------------------------------------------------------------------------------


@sampled(2, "offset", "unknown")
@pytest.mark.parametrize("offset", ["0", "0.1", "-7.3"])
@pytest.mark.parametrize("unknown", ["P", "T"])
def test_beside_the_dead_centres_of_a_slider_crank(offset: str, unknown: str) -> None:
    """An unknown force that grows without bound, an unknown torque that goes through zero."""
    text = SLIDER_CRANK.replace("P_", "unknown" if unknown == "P" else "2000")
    text = text.replace("T_", "unknown" if unknown == "T" else "100")
    text = text.replace("C: [unknown, 0]", f"C: [unknown, {offset}]").replace("[195, 0]", f"[195, {offset}]")
    case, y = icsolve.load(text), mpf(offset)
    for reach, turn in ((210, 0), (110, 180)):
        place = float(mp.degrees(mp.asin(y / reach)) + turn)
        rows = np.array([place + off for off in OFFS])
        sweep = icsolve.sweep(case, {"angles.AB": rows}, WANT)
        assert (sweep.status == "ok").all()
        for n, value in enumerate(rows):
            pin = 50 * turned(repr(float(value)))
            rise = y - pin.imag
            run = mp.sqrt(25600 - rise * rise)
            speed = -pin.imag - rise / run * -pin.real  # of C along the guide at unit speed of the crank
            truth = 100 / speed if unknown == "P" else 2000 * speed
            error = abs(mpf(float(sweep.answers[unknown][n])) - truth)
            assert error <= sweep.error[unknown][n], (float(value) - place, float(error))
            assert sweep.error[unknown][n] <= 1e-6 * abs(truth) or unknown == "T"


WHEELS = """icsolve: 1
points: {{A: [0, 0], D: [6, 0], C: [unknown, 0.5]}}
lengths: {{AB: 1, DE: 1.5, EC: 5}}
angles: {{{path}: 24.3, DE: 61.7}}
near: {{C: [11.5, 0.5]}}
links: {{2: [B]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [1, 3], at: D}}
  - {{{wheels}}}
  - {{pin: [3, 4], at: E}}
  - {{pin: [4, 5], at: C}}
  - {{slide: [5, 1], at: C, along: 0}}
loads: {{P: {{force: 10, link: 5, at: C, angle: 180}}, T12: {{torque: unknown, link: 2}}}}
"""


@sampled(2, "path")
@pytest.mark.parametrize("path", ["AB", "DAB"])
@pytest.mark.parametrize(
    ("wheels", "first", "second"),
    [
        ("gears: [2, 3], teeth: [17, 31]", "-17", "31"),
        ("belt: [2, 3], radii: [1.1, 1.1]", "1.1", "1.1"),
        ("belt: [2, 3], radii: [0.7, 1.5], crossed: true", "-0.7", "1.5"),
    ],
)
def test_beside_the_dead_centres_of_a_crank_that_wheels_turn(
    path: str, wheels: str, first: str, second: str
) -> None:
    """The wheels carry their turning on from the angle as written, 24.3 and not the double nearest to it."""
    ratio = mpf(first) / mpf(second)

    def at(degrees: Any) -> Any:
        pin = mpf("1.5") * turned(mpf("61.7") + ratio * (degrees - mpf("24.3")))
        rise = mpf("0.5") - pin.imag
        return 10 * ratio * (-pin.imag + rise / mp.sqrt(25 - rise * rise) * pin.real)

    for reach, turn in (("6.5", 0), ("3.5", 180)):
        crank = mp.degrees(mp.asin(mpf("0.5") / mpf(reach))) + turn
        place = mpf("24.3") + (crank - mpf("61.7")) / ratio
        checked(WHEELS.format(path=path, wheels=wheels), f"angles.{path}", float(place), at)


# --- as `solve` has it ------------------------------------------------------------------------------

CASES = Path(__file__).parent.parent / "cases"


def as_solved(case: icsolve.Case, path: str, value: float, sweep: icsolve.Sweep) -> tuple[str, Any]:
    """Status and answers of `solve` with the value set, near the branch that the sweep followed."""
    near = {name: (float(at[0, 0]), float(at[0, 1])) for name, at in sweep.points.items()}
    near = {name: at for name, at in near.items() if np.isfinite(at).all()}
    try:
        found = icsolve.solve(replace(with_numbers(case, {path: value}), near=near or case.near))
    except icsolve.SceneError as refusal:
        return refusal.status, {}
    return "ok", found.answers


def posing(case: icsolve.Case) -> list[str]:
    """The numbers that move the mechanism to what `solve` has with the number set, too."""
    paths = []
    for path, number in numbers_of(case).items():
        if path.split(".")[0] in ("angles", "lengths"):
            value = number.value + (1.7 if path.startswith("angles") else 0.01 * number.value)
            with contextlib.suppress(icsolve.SceneError):
                probe = icsolve.sweep(case, {path: [value]}, WANT)
                status, answers = as_solved(case, path, value, probe)
                same = (answers[k].value == pytest.approx(probe.answers[k][0], rel=1e-9) for k in answers)
                if status == probe.status[0] == "ok" and all(same):
                    paths.append(path)
    return paths


@sampled(3)
@pytest.mark.parametrize("name", sample(FILES, 14, "singular rows"))
def test_rows_have_the_status_and_the_value_that_solve_has(name: str) -> None:
    """Beside every dead centre, limit and change point of cases of the library."""
    try:
        case = icsolve.load(FILES[name])
    except icsolve.CaseError:
        pytest.skip("a case that is told what it lacks")
    if case.unknowns:
        pytest.skip("it asks for a dimension or a position: no row of a sweep")
    for path in posing(case)[:1]:
        value = numbers_of(case)[path].value
        wide = 180.0 if path.startswith("angles") else 0.4 * value
        try:
            spots = find(case, {path: [value - wide, value + wide]}, Query("dead"))
        except (icsolve.SceneError, ValueError):
            continue
        for spot in spots[:2]:
            for off in OFFS[::5]:
                row = spot.at + off * wide / 180.0
                sweep = icsolve.sweep(case, {path: [row]}, WANT)
                status, answers = as_solved(case, path, row, sweep)
                assert sweep.status[0] == status, (path, spot, off)
                for load, found in answers.items() if status == "ok" else ():
                    room = sweep.error[load][0] + (found.error or 0.0)
                    assert abs(sweep.answers[load][0] - found.value) <= room, (path, spot, off)


# --- every row by itself ----------------------------------------------------------------------------

SINGULAR = [
    ("limit", FOUR_BAR, "angles.DC", 95.73917047726678),
    ("change point", PARALLELOGRAM, "angles.AB", 180.0),
    ("dead centre", SLIDER_CRANK.replace("P_", "unknown").replace("T_", "100"), "angles.AB", 180.0),
    ("toggle", FOUR_BAR.replace("{DC: 100}", "{AB: 20}").replace("B: [0.5", "C: [3.5"), "angles.AB", 180.0),
]


@sampled(2)
@pytest.mark.parametrize(("text", "path", "place"), [s[1:] for s in SINGULAR], ids=[s[0] for s in SINGULAR])
def test_a_row_is_the_same_alone_in_a_long_sweep_and_in_another_order(
    text: str, path: str, place: float
) -> None:
    case, rng = icsolve.load(text), np.random.default_rng(1)
    rows = np.array([place + off for off in [*OFFS, 0.0]])
    alone = [icsolve.sweep(case, {path: [row]}, WANT) for row in rows]
    order = rng.permutation(len(rows))
    mixed = icsolve.sweep(case, {path: rows[order]}, WANT)
    long = icsolve.sweep(case, {path: np.concatenate([np.arange(0.0, 360.0, 0.7), rows])}, WANT)
    for n, one in enumerate(alone):
        there = int(np.flatnonzero(order == n)[0])
        for other, k in ((mixed, there), (long, len(long) - len(rows) + n)):
            assert other.status[k] == one.status[0], (rows[n] - place, other.status[k], one.status[0])
            for kind, name in (("answers", "T12"), ("points", "C")):
                if name in one.kinds[kind]:
                    both = np.array([other.kinds[kind][name][k], one.kinds[kind][name][0]])
                    assert np.array_equal(both[0], both[1], equal_nan=True), (rows[n] - place, both)


@sampled(4)
@full_turns.EVERY
def test_beside_whatever_is_singular_on_a_full_turn(
    name: str, scene: transcribe.Scene, link: str, period: float
) -> None:
    """Where the answer of a mechanism of all kinds of joints vanishes or has its pole: rows beside the place
    have their bounds."""
    case = icsolve.load(transcribe.text(scene))
    coarse = icsolve.sweep(case, drive={link: np.linspace(0.3, period, 361)}, want=WANT)
    answer = coarse.answers["U"]
    changes = np.flatnonzero(answer[:-1] * answer[1:] < 0.0)
    for k in changes[: 2 if FULL else 1]:
        low, high = coarse.vary[link][k], coarse.vary[link][k + 1]
        for _ in range(4):
            cut = np.linspace(low, high, 65)
            found = np.sign(icsolve.sweep(case, drive={link: cut}).answers["U"])
            n = int(np.flatnonzero(found[:-1] * found[1:] <= 0.0)[0])
            low, high = cut[n], cut[n + 1]
        rows = np.array([low + off for off in OFFS])
        sweep = icsolve.sweep(case, drive={link: rows}, want=WANT)
        assert (sweep.status == "ok").all()
        for n in range(0, len(rows), 3):
            (true,) = truths(sweep, n)["answers", "U"]
            assert abs(true - mpf(float(sweep.answers["U"][n]))) <= sweep.error["U"][n], rows[n] - low


OBLIQUE = """icsolve: 1
points: {A: [0, 0]}
lengths: {AB: 1, BC: 2.5}
angles: {AB: 40}
near: {C: [3, 1.6]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 30, through: A}
loads:
  T: {torque: 10, link: 2}
  P: {force: unknown, link: 4, at: C, angle: 30}
"""
LID = """icsolve: 1
points: {A: [0, 0]}
lengths: {AG: 0.25}
angles: {AG: 40}
joints:
  - {pin: [1, 2], at: A}
loads:
  W: {mass: 3 kg, link: 2, at: G}
  S: {SPRING, link: 2}
"""
WOUND = LID.replace("SPRING", "spring: unknown, corner: AG, free: 100")


@pytest.mark.parametrize(
    ("text", "at", "status"),
    [(OBLIQUE, 30.0, "dead-centre"), (OBLIQUE, 210.0, "dead-centre"), (WOUND, 100.0, "no-value")],
)
def test_a_row_at_a_singular_position_that_no_coordinates_meet_is_what_solve_says(
    text: str, at: float, status: str
) -> None:
    """The row's own coordinates are rounded, and miss it by their last digit."""
    path = next(path for path in numbers_of(icsolve.load(text)) if path.startswith("angles."))
    found = icsolve.sweep(icsolve.load(text), vary={path: [at - 1.0, at, at + 1.0]})
    assert found.status.tolist() == ["ok", status, "ok"]
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.solve(icsolve.load(text, {path: at}))
    assert refused.value.status == status


@pytest.mark.parametrize("path", ["lengths.AG", "loads.S.free", "points.A.x", "angles.AG"])
def test_a_torsion_spring_is_followed_and_sought_over_every_number(path: str) -> None:
    """S = W cos u AG / (free - u): rows of a family as if written so, those of a motion from the case."""
    case = icsolve.load(WOUND)
    values = {"lengths.AG": (0.1, 0.5), "loads.S.free": (60.0, 140.0), "points.A.x": (1.0, 9.0)}
    low, high = values.get(path, (-30.0, 70.0))
    rows = np.linspace(low, high, 5)
    found = icsolve.sweep(case, vary={path: rows}).answers["S"]
    alone = [icsolve.solve(icsolve.load(WOUND, {path: float(v)})).answers["S"].value for v in rows]
    assert found == pytest.approx(alone, rel=1e-14)
    spots = find(case, {path: [low, high]}, Query("value", "S", 5.3))
    for spot in spots:
        there = icsolve.solve(icsolve.load(WOUND, {path: spot.at})).answers["S"].value
        assert there == pytest.approx(5.3, rel=1e-12)
    changes = int(
        (
            np.diff(np.sign(icsolve.sweep(case, vary={path: np.linspace(low, high, 101)}).answers["S"] - 5.3))
            != 0
        ).sum()
    )
    assert len(spots) == changes


def test_a_row_where_links_fold_up_is_refused_and_its_neighbours_are_not() -> None:
    """The lazy tongs shut, its crossings on one another: `solve` says change point, and so do rows."""
    case = icsolve.load(str(CASES / "tools" / "lazy_tongs.yaml"))
    sweep = icsolve.sweep(
        case, want=("answers", "status", "points"), drive={"3": [-153.0, -152.0, -151.0, 28.0]}
    )
    assert sweep.status.tolist() == ["ok", "change-point", "ok", "change-point"]
    assert sweep.answers["Q"][0] == pytest.approx(-sweep.answers["Q"][2], rel=1e-12)


@sampled(3)
@pytest.mark.parametrize("stages", range(1, 5 if FULL else 4))
def test_a_lift_of_scissors_folds_and_goes_straight_on_whichever_bar_is_turned(stages: int) -> None:
    """F = n W / tan(theta) of n stages, over a turn through both folds, where all points of a stage fall in
    two; whichever bar is turned, a fold is a whole number of degrees away."""
    rng = Random(f"scissors {stages}")
    text, written = scissors(stages)(rng), rng.randint(30, 50)
    case = icsolve.load(re.sub("angles: {L0-C0: [0-9.]+", f"angles: {{L0-C0: {written}", text))
    step = rng.choice([4.0, 5.0, 7.0])
    theta = np.unique([*(written + step * np.arange(-170 // step, 170 // step)), -90.0, 0.0, 90.0])
    fold = theta % 90.0 == 0.0
    right = 10.0 * stages / np.tan(np.radians(theta[~fold]))
    bars = [(str(link), 1.0 if link % 2 == 0 else -1.0) for link in range(2, 2 * stages + 2)]
    for link, sense in bars if FULL else [bars[0], rng.choice(bars[1:])]:
        found = icsolve.sweep(case, drive={link: sense * (theta - written)})
        upright, flat = found.status[abs(theta) == 90.0], found.status[theta == 0.0]
        assert set(upright) <= {"change-point", "ok"} and flat != "ok"
        assert set(found.answers["F"][(found.status == "ok") & fold].tolist()) <= {0.0}
        assert set(found.status[~fold]) == {"ok"}
        assert found.answers["F"][~fold] == pytest.approx(right, rel=1e-9), link


LOCKED = """
icsolve: 1
points:
  P1: [1.0053, -0.2402]
  P2: [0.1961, 1.1498]
  P3: [1.9157, -2.4219]
  P4: [3.3635, -0.4504]
  P5: [-0.2177, 1.22]
  P6: [-2.7456, 1.5106]
  P7: [-3.1352, 2.7973]
  P8: [-0.671, 0.3141]
joints:
  - {pin: [1, 2], at: P1}
  - {weld: [2, 3]}
  - {pin: [2, 4], at: P1}
  - {pin: [4, 5], at: P2}
  - {slide: [2, 5], at: P3, along: 151.198}
  - {roll: [3, 6], at: P4}
  - {slot: [4, 6], at: P5, along: 65.0}
  - {pin: [6, 7], at: P6}
  - {pin: [7, 8], at: P7}
  - {slide: [5, 8], at: P8, along: 131.462}
loads: {K: {torque: 7.5, link: 5}, U: {torque: unknown, link: 5, against: 6}}
"""


@pytest.mark.parametrize("path", ["loads.K", "gravity"])
def test_a_load_that_is_varied_in_a_dead_centre_finds_it(path: str) -> None:
    """Only loads differ from row to row: what the figure leaves open in doubles is the scene's to decide."""
    case = icsolve.load(LOCKED)
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.solve(case)
    rows = icsolve.sweep(case, {path: [7.5, 9.81]}, ("answers", "status"))
    assert list(rows.status) == [refused.value.status] * 2


FOLDING = """icsolve: 1
points: {{A: [0, 0]}}
lengths: {{AB: {crank}, DC: {crank}, AD: {frame}{more}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
loads: {{W: {{weight: 20, link: 3, at: C}}, M: {{torque: unknown, link: 2}}}}
"""


@sampled(2, "by", "link", "lies")
@pytest.mark.parametrize("by", ["directions", "lengths"])
@pytest.mark.parametrize("link", ["2", "4"])
@pytest.mark.parametrize("lies", [0, 37])
def test_exactly_where_a_parallelogram_folds_it_may_go_on_in_two_ways(by: str, link: str, lies: int) -> None:
    """Its circles touch there: what is under the root is zero, whatever rounding leaves of it."""
    dice = Random(f"{by} {link}")
    for _ in range(40 if FULL else 4):
        frame, crank = (dice.randint(2, 99) / 100 for _ in range(2))
        turned = dice.randint(1, 1700) / 10
        angle = round(lies + turned, 1)
        if by == "directions":
            more = f"}}\nangles: {{AD: {lies}, AB: {angle}, DC: {angle}}}"
        else:
            near = cmath.rect(frame, math.radians(lies)) + cmath.rect(crank, math.radians(angle))
            more = f", BC: {frame}}}\nangles: {{AD: {lies}, AB: {angle}}}\n"
            more += f"near: {{C: [{near.real}, {near.imag}]}}"
        case = icsolve.load(FOLDING.format(crank=crank, frame=frame, more=more))
        rows = [-turned, 0.0, round(180.0 - turned, 1)]
        status = icsolve.sweep(case, drive={link: rows}).status.tolist()
        assert status == ["change-point", "ok", "change-point"], (frame, crank, turned)


PLATE = """icsolve: 1
points: {{A: [{b[0]}, {low}], D: [{d[0]}, {d[1]}], E: [{e[0]}, {e[1]}]{more}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 4], at: B}}, {{pin: [4, 3], at: C}}, {{pin: [3, 5], at: F}},
         {{pin: [5, 1], at: D}}, {{pin: [3, 6], at: G}}, {{pin: [6, 1], at: E}}]
loads: {{W: {{weight: 20, link: 3, at: C}}, T: {{torque: unknown, link: 2}}}}
"""
BY_LENGTHS = """}}
lengths: {{AB: 5, BC: {bars[0]}, FD: {bars[1]}, GE: {bars[2]}, CF: 3, CG: 4, FG: 5}}
angles: {{AB: {turned}}}
near: {{C: [0, 0], F: [3, 0], G: [0, 4]}}"""


def _plates(dice: Random) -> Iterator[tuple[float, icsolve.Case, str]]:
    """A plate on three bars that are parallel at 90 degrees of the crank, all in whole numbers: two ways to
    assemble become one there. Each where it is drawn beside that, with what is left to turn, and what its
    coordinates there are told."""
    x, y = dice.choice([(4, 3), (-4, 3), (3, -4), (1, 0), (-3, -4)])
    sizes = [dice.choice([-1, 1]) * n for n in dice.sample(range(1, 7), 3)]
    b, d, e = ((px + n * x, py + n * y) for (px, py), n in zip(((0, 0), (3, 0), (0, 4)), sizes, strict=True))
    bars = [abs(n) * math.hypot(x, y) for n in sizes]
    plate = partial(PLATE.format, b=b, low=b[1] - 5, d=d, e=e)
    there = icsolve.load(plate(more=f", B: [{b[0]}, {b[1]}], C: [0, 0], F: [3, 0], G: [0, 4]}}"))
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.solve(there)
    for off in (-2.0, -0.5, 0.5, 2.0):
        with contextlib.suppress(icsolve.SceneError):
            case = icsolve.load(plate(more=BY_LENGTHS.format(bars=bars, turned=90.0 - off)))
            icsolve.solve(case)
            yield off, case, refused.value.status


def test_a_group_at_its_fold_is_where_its_lengths_put_it_from_wherever_it_comes() -> None:
    """Beside a fold the root of a rounding counts: links whose shape is taken from doubles give other values
    (2e-6 apart, 1e-9 degrees off), and none of them the fold itself."""
    dice, folds, pairs = Random("plates"), 0, 0
    for _ in range(60 if FULL else 3):
        beside: dict[int, list[tuple[float, float]]] = {0: [], 2: []}
        for off, case, status in _plates(dice):
            rows = [off - 1e-9, off, off + 1e-9]
            found = icsolve.sweep(case, drive={"2": rows}, want=WANT)
            off_there = sum(
                abs(found.points[p] - at) for p, at in (("C", (0, 0)), ("F", (3, 0)), ("G", (0, 4)))
            )
            near = [n for n in (0, 2) if found.status[n] == "ok" and off_there[n].max() < 1e-3]
            for n in near:
                folds += 1
                assert found.status[1] == status
                beside[n].append((found.answers["T"][n], found.error["T"][n]))
        for (one, error), (two, other) in chain(*(combinations(beside[n], 2) for n in beside)):
            if abs(one - two) < 0.01 * abs(one):
                pairs += 1
                assert abs(one - two) <= error + other
    assert min(folds, pairs) > 0


FEET = """icsolve: 1
units: {{length: in, force: lbf, torque: {torque}}}
points: {{A: [0, 0], D: [{d}, 0]}}
lengths: {{AB: {a}, BC: {b}, CD: {c}}}
angles: {{AB: {written}}}
near: {{C: [{x}, {y}]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
loads: {{T14: {{torque: {load}, link: 4}}, T12: {{torque: unknown, link: 2}}}}
"""


@pytest.mark.parametrize("seed", range(12 if FULL else 3))
def test_rows_of_a_case_in_other_units_are_its_rows(seed: int) -> None:
    """An inch is 25.4 mm, a foot 12 inches: the figure whose lengths are written so, or by arithmetic, is the
    same figure, and beside the limit of its crank each row is the same number."""
    draw = Random(seed)
    d, a, b = (draw.randint(*ends) / 10 for ends in ((40, 50), (20, 30), (20, 30)))
    c = draw.randint(12, 15) / 10
    reach = mpf(str(b)) + mpf(str(c))
    cosine = (mpf(str(a)) ** 2 + mpf(str(d)) ** 2 - reach**2) / (2 * mpf(str(a)) * mpf(str(d)))
    limit = float(mp.degrees(mp.acos(cosine)))
    written = round(limit - 5.0)
    bend = turned(written) * a
    middle = bend + (d - bend) * b / (b + c)
    place = {"written": written, "x": middle.real, "y": middle.imag + 0.5}
    plain = FEET.format(a=a, b=b, c=c, d=d, torque="lbf*in", load=120, **place)
    sizes = dict(zip("abcd", (a, b, c, d), strict=True))
    in_mm = {name: f"{Decimal(str(size)) * Decimal('25.4')} mm" for name, size in sizes.items()}
    metric = FEET.format(**in_mm, torque="lbf*in", load="10 lbf*ft", **place)
    thirds = {name: f'"$n*{size}/3"' for name, size in sizes.items()}
    reckoned = "variables: {n: {choices: [3]}}\n" + FEET.format(**thirds, torque="lbf*ft", load=10, **place)
    rows = np.array([limit - 10.0**-k for k in range(2, 13)])
    want = {"angles.AB": rows}
    one, two, three = (icsolve.sweep(icsolve.load(text), want, WANT) for text in (plain, metric, reckoned))
    assert two.status.tolist() == three.status.tolist() == one.status.tolist()
    beside = slice(4, None)  # there rows are scenes, each rounded once
    assert one.answers["T12"][beside].tolist() == two.answers["T12"][beside].tolist()
    assert two.answers["T12"] == pytest.approx(one.answers["T12"], rel=1e-10, nan_ok=True)
    assert 12.0 * three.answers["T12"] == pytest.approx(one.answers["T12"], rel=1e-10, nan_ok=True)
    assert one.status.tolist() == ["ok"] * len(rows)


def _ways_at_a_plates_fold(dice: Random, powers: range) -> Iterator[tuple[str, float, str, float]]:
    """How each side of the fold of a random plate is answered, `near` being the fold itself, or a place just
    on the side on which the plate assembles: what is near, degrees past the fold on that side (so many powers
    of a tenth), the status, and how far the plate is then. Nothing where both sides assemble."""
    x, y = dice.choice([(4, 3), (-4, 3), (3, -4), (-3, -4)])
    sizes = [dice.choice([-1, 1]) * n for n in dice.sample(range(1, 7), 3)]
    b, d, e = ((px + n * x, py + n * y) for (px, py), n in zip(((0, 0), (3, 0), (0, 4)), sizes, strict=True))
    plate = partial(PLATE.format, b=b, low=b[1] - 5, d=d, e=e)
    fold = {"C": [0.0, 0.0], "F": [3.0, 0.0], "G": [0.0, 4.0]}

    def solved(off: float, near: dict[str, list[float]]) -> tuple[str, dict[str, Any]]:
        text = plate(more=BY_LENGTHS.format(bars=[5 * abs(n) for n in sizes], turned=repr(90.0 + off)))
        case = icsolve.load(text.replace("near: {C: [0, 0], F: [3, 0], G: [0, 4]}", f"near: {near}"))
        try:
            return "ok", icsolve.solve(case).to_dict()["points"]
        except icsolve.SceneError as refusal:
            return refusal.status, {}

    sides = [side for side in (1.0, -1.0) if solved(0.01 * side, fold)[0] != "cannot-assemble"]
    if len(sides) != 1:
        return
    side = sides[0]
    aside = {p: [x + 0.02, y - 0.01] for p, (x, y) in fold.items()}
    beside = next(
        at for status, at in (solved(0.01 * side, near) for near in (fold, aside)) if status == "ok"
    )
    places = {"fold": fold, "beside": {p: [round(x, 4) for x in beside[p]] for p in fold}}
    for name, near in places.items():
        for k in (k for k in powers if name == "beside" or k < 9):
            for off in (10.0**-k, -(10.0**-k)):
                status, points = solved(off * side, near)
                yield name, off, status, math.hypot(*points["C"]) if points else 0.0


def test_beyond_the_fold_of_a_group_nothing_assembles_however_near_it_is() -> None:
    """What lies at `near` there is named, never another way a long way off; on the other side two ways lie
    about the fold, equally near to it; beyond 1e-6 degree one of them may be clearly nearer."""
    dice, asked = Random("folds"), set()
    for n in range(60 if FULL else 12):  # of one plate a third of the distances, of each third of one plate
        powers = range(3, 14) if FULL else range(3 + n % 3, 14, 3)
        if not FULL and ("beside", 10.0 ** -powers[0]) in asked:
            continue
        for name, off, status, away in _ways_at_a_plates_fold(dice, powers):
            asked.add((name, off))
            assert away < 0.5, (name, off)
            wanted = "cannot-assemble" if off < 0.0 else "ok" if name == "beside" else "ambiguous"
            assert status == wanted or (wanted == "ambiguous" and off > 2e-6 and status == "ok"), (name, off)
    offs = [side * 10.0**-k for k in range(3, 14) for side in (1.0, -1.0)]
    assert asked == {("beside", off) for off in offs} | {("fold", off) for off in offs[:12]}


@pytest.mark.parametrize("seed", range(24 if FULL else 1))
def test_a_group_is_followed_to_its_fold_from_wherever_it_is_written(seed: int) -> None:
    """A plate on parallel bars: rows 1e-2 to 1e-13 degrees before the fold assemble, the nearer to it the
    nearer, however long the steps to it were."""
    dice, met = Random(f"followed {seed}"), 0
    for _ in range(3):
        if met and not FULL:
            break
        x, y = dice.choice([(4, 3), (-4, 3), (3, -4), (-3, -4)])
        sizes = [dice.choice([-1, 1]) * n for n in dice.sample(range(1, 7), 3)]
        b, d, e = (
            (px + n * x, py + n * y) for (px, py), n in zip(((0, 0), (3, 0), (0, 4)), sizes, strict=True)
        )
        plate = partial(PLATE.format, b=b, low=b[1] - 5, d=d, e=e)
        for start in (side * off for side in (1.0, -1.0) for off in (2.0, 0.5, 0.2, 0.1)):
            text = plate(more=BY_LENGTHS.format(bars=[5 * abs(n) for n in sizes], turned=90.0 + start))
            case = icsolve.load(text)
            try:
                icsolve.solve(case)
            except icsolve.SceneError:
                continue
            rows = [90.0 + math.copysign(10.0**-k, start) for k in range(2, 14)]
            sweep = icsolve.sweep(case, {"angles.AB": rows}, WANT)
            away = np.hypot(*sweep.points["C"].T)
            if not away[-1] > 0.1:  # else it is not this fold that they lead to
                met += 1
                assert set(sweep.status) == {"ok"}, (sizes, start, sweep.status)
                assert np.all(np.diff(away) < 1e-12)
    assert met


FAR = """icsolve: 1
points: {{A: [0, 0], B: [{b}, 0], C: [{c.real}, {c.imag}], D: [{d.real}, {d.imag}]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
loads: {{T14: {{torque: 10, link: 4}}, T12: {{torque: unknown, link: 2}}}}
"""


@sampled(3)
@pytest.mark.parametrize("seed", range(24 if FULL else 6))
def test_links_that_are_all_but_parallel_and_very_long_are_followed(seed: int) -> None:
    """Rod and rocker a million to a hundred million times the crank: what doubles leave open of a row its own
    digits settle, and no limit is told where there is none."""
    rng = Random(f"far {seed}")
    b, d = rng.randint(100, 300), complex(rng.randint(350, 500), rng.randint(40, 120))
    c = complex(10 ** rng.randint(8, 10), rng.randint(200, 500))
    case = icsolve.load(FAR.format(b=b, c=c, d=d))
    pin, end, top = mpf(b), mp.mpc(d), mp.mpc(c)
    rod, rocker = abs(top - pin), abs(top - end)
    sign = 1 if ((top - pin) * mp.conj(end - pin)).imag > 0 else -1
    rows = [round(0.07 * k, 2) for k in range(30)]
    sweep = icsolve.sweep(case, drive={"2": rows}, want=WANT)
    for n, row in enumerate(rows):
        at = b * turned(mpf(repr(row)))
        place = meets(at, end, rod, rocker, sign)
        assert place is not None and sweep.status[n] == "ok", row
        truth = torque(0, at, end, place)
        assert abs(mpf(float(sweep.answers["T12"][n])) - truth) <= sweep.error["T12"][n], row
    assert (sweep.error["T12"] <= 1e-4 * abs(sweep.answers["T12"]).max()).all()
    spots = find(case, None, Query("dead"), drive={"2": [0.0, 2.0]})
    assert [spot.kind for spot in spots] == []


@sampled(2)
@pytest.mark.parametrize("seed", range(40 if FULL else 2))
def test_tongs_folded_flat_are_at_a_change_point_on_either_side(seed: int) -> None:
    """Two pins of the next pair coincide there: the root of the group is double, and what its digits leave of
    a coordinate that is 0 must not decide."""
    draw = Random(seed)
    bar, angle = draw.choice([50, 100, 40.5, 0.3, 7]), draw.randint(12, 60)
    lean = math.radians(angle)
    text = f"""icsolve: 1
points: {{A: [0, 0], B: [0, unknown]}}
lengths: {{AC: {bar}, CD: {bar}, CE: {bar}, BC: {bar}, DF: {bar}, EF: {bar}}}
angles: {{AC: {angle}, ACD: 180, BCE: 180}}
near: {{B: [0, {2 * bar * math.sin(lean)}], F: [{3 * bar * math.cos(lean)}, {bar * math.sin(lean)}]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{slot: [3, 1], at: B, along: 90}}
  - {{pin: [2, 3], at: C}}
  - {{pin: [2, 5], at: D}}
  - {{pin: [3, 4], at: E}}
  - {{pin: [4, 5], at: F}}
loads: {{P: {{force: 120, link: 3, at: B, angle: 270}}, Q: {{force: unknown, link: 5, at: F, angle: 180}}}}
"""
    case = icsolve.load(text)
    for link, flat in (("5", angle), ("2", -angle)):
        for turn in (0.0, -180.0, 180.0):
            degrees = flat + turn + np.array([-0.5, 0.0, 0.5])
            found = icsolve.sweep(case, drive={link: degrees})
            assert found.status.tolist() == ["ok", "change-point", "ok"], (link, turn)


HARDLY_TURNING = """icsolve: 1
units: {length: ft, force: kN}
points:
  A6: [1.68, 2.6]
  G4: [-2.56, 3.08]
  E3: [-1.96, -2.28]
  C8: [0.32, 3.84]
  A4: [1.84, 4]
  P: [-1.2, 3.68]
  S: [-2.84, -3.32]
  C3: [-2.84, -4.04]
  E7: [1, -3.24]
  D7: [2, 2.8]
  G7: [-1.96, -0.44]
  A1: [-3.68, -2.04]
  A2: [-0.6, 3.16]
  C7: [-2.76, 3.04]
  C: [1.6, -0.96]
  Q: [0.84, 0.36]
joints:
  - {pin: [2, 1], at: A6}
  - {pin: [1, 3], at: G4}
  - {pin: [2, 4], at: E3}
  - {slide: [4, 3], at: C8, along: [A4, P]}
  - {pin: [5, 6], at: C3}
  - {pin: [6, 3], at: E7}
  - {roll: [2, 5], at: S, radii: [0, 0.72]}
  - {pin: [7, 4], at: D7}
  - {pin: [7, 8], at: G7}
  - {pin: [8, 6], at: A1}
links:
  3: [A4, P]
loads:
  L1: {distributed: -2.4, link: 2, from: A2, to: C7, slope: [3, 1], turns_with: 1}
  L2: {spring: 44.5, free: 0.7, link: 6, at: A1, to: E3, against: 2}
  L3: {mass: 44.1 kg, link: 3, at: C}
  U: {force: unknown, link: 6, at: Q, slope: [-1, 4], turns_with: 4}
"""


def test_a_link_that_all_but_stands_still_is_turned_between_its_limits() -> None:
    """One of its limits lies 0.0016 degrees from the position as written, nearer than a record is made beside
    it elsewhere: that position is none itself, and what moves by another link moves by this one too."""
    case = icsolve.load(HARDLY_TURNING)
    swept = icsolve.sweep(case, drive={"2": np.array([-0.01, -1e-4, 0.0, 1e-4])})
    assert swept.status.tolist() == ["cannot-assemble", "ok", "ok", "ok"]
    assert swept.answers["U"][2] == pytest.approx(icsolve.solve(case).answers["U"].value, rel=1e-9)
    by = {link: with_stability(case, icsolve.solve(case), link) for link in ("2", "4")}
    assert {found.stability for found in by.values()} == {"stable"}


INSTANT = {
    "a slot square to the way to its pivot": "lengths: {{AB: {r}}}\nangles: {{AB: 0}}\n"
    "joints: [{{pin: [1, 2], at: A}}, {{slot: [2, 4], at: B, along: 90}}, {{pin: [4, 1], at: D}}]\n"
    "loads: {{M: {{torque: 10, link: 4}}, T: {{torque: unknown, link: 2}}}}\n",
    "a rocker that is told too": "lengths: {{AB: {r}, BC: {d}, CD: {r}}}\nangles: {{AB: 0, DC: 0}}\n"
    "near: {{C: [{c}, 0.3]}}\njoints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}},\n"
    "  {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]\n"
    "loads: {{T: {{torque: unknown, link: 2}}, P: {{force: 5, link: 3, at: B, angle: 33}}}}\n",
}


@pytest.mark.parametrize("seed", range(few(12)))
@pytest.mark.parametrize("kind", INSTANT)
def test_no_row_goes_on_from_a_freedom_that_is_one_for_an_instant(kind: str, seed: int) -> None:
    """A link that can move alone to first order was held, or its datum: every row had the torque of another
    mechanism, or did not assemble. Rows begin elsewhere, and it is said, or the position is refused."""
    dice = Random(f"instant {kind} {seed}")
    r, d = dice.randint(5, 15) / 10, dice.randint(20, 40) / 10
    text = f"icsolve: 1\npoints: {{A: [0, 0], D: [{d}, 0]}}\n" + INSTANT[kind].format(r=r, d=d, c=d + r)
    case = icsolve.load(text)
    for link in ("2", "4"):
        with pytest.raises(icsolve.SceneError) as refused:
            icsolve.sweep(case, drive={link: np.array([-20.0, 0.0, 20.0])})
        assert refused.value.status == "change-point", link
    if "rocker" in kind:
        return  # no other row assembles
    rows = icsolve.sweep(case, {"angles.AB": [-50.0, 0.0, 20.0]}, want=("answers", "status"))
    assert any("no position to start from" in note for note in rows.notes)
    own = icsolve.solve(icsolve.load(text, {"angles.AB": "-50"}))
    assert rows.answers["T"][0] == pytest.approx(own.answers["T"].value, rel=1e-12)
