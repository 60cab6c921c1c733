"""What --find tells where each row is a scene of its own, against closed forms in sixty digits.

A roller that slides upright on an eccentric circle: R. L. Norton, Design of Machinery, ch. 8.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from random import Random

import pytest
from mpmath import cos, diff, mp, mpf, pi, sin, sqrt

import icsolve
from cams import sliding, swinging
from icsolve.case import Case
from icsolve.numbers.replay import Array
from icsolve.read import load
from icsolve.solve import solve
from icsolve.sweep import find_by_scenes, sweep
from icsolve.sweep.find_by_scenes import FoundPosition, SeenRows
from icsolve.sweep.find_on_record import Query, find
from sizes import FULL, MORE, sampled

mp.dps = 60
RADIUS, AWAY, ROLLER = 40, 20, 10


def torque(degrees: mpf, offset: float) -> mpf:
    """The torque on the eccentric circle under 100 on the roller."""
    x, y = AWAY * cos(degrees * pi / 180), AWAY * sin(degrees * pi / 180)
    nx = (mpf(offset) - x) / (RADIUS + ROLLER)
    ny = sqrt(1 - nx**2)
    return 100 * ((x + RADIUS * nx) * ny - (y + RADIUS * ny) * nx) / ny


def eccentric(offset: float) -> Case:
    return sliding(
        f"{{circle: C, radius: {RADIUS}}}", f"{{roller: B, radius: {ROLLER}}}", offset=offset, e=AWAY
    )


def zero(function: Callable[[mpf], mpf], low: mpf, high: mpf) -> mpf:
    """Of a function that changes its sign once."""
    rises = function(high) > 0
    for _ in range(110):
        middle = (low + high) / 2
        low, high = (low, middle) if (function(middle) > 0) == rises else (middle, high)
    return (low + high) / 2


def peaks(offset: float) -> list[mpf]:
    """The two in a turn, in [0, 360)."""

    def slope(t: mpf) -> mpf:
        return diff(lambda u: torque(u, offset), t)

    return [zero(slope, mpf(-60), mpf(90)), zero(slope, mpf(100), mpf(240))]


def held(found: list[FoundPosition], true: list[mpf]) -> None:
    """As many places as there are, each within its error."""
    assert len(found) == len(true), (found, true)
    for spot, place in zip(found, true, strict=True):
        assert abs(mpf(spot.at) - place) <= spot.error <= 1e-4, (spot, place)


@sampled(2)
@pytest.mark.parametrize("seed", range(4 * MORE))
def test_a_peak_wherever_the_range_begins_and_however_long_it_is(seed: int) -> None:
    """In the first and the last of the places at which it is searched, too, and so near to its ends that the
    answer falls by a millionth of a millionth."""
    rng = Random(seed)
    offset = rng.choice((0.0, 6.0, -5.0))
    case = eccentric(offset)
    place, wide = rng.choice(peaks(offset)), rng.choice((90.0, 10.0, 1.0, 0.01))
    before = wide * rng.choice((0.5, 1e-3, 3e-4))
    low = float(place) - rng.choice((before, wide - before))
    (spot,) = found = find(case, {"angles.AC": [low, low + wide]}, Query("max", "T12"))
    held(found, [place])
    assert spot.answer is not None
    assert abs(torque(place, offset) - spot.answer) <= 1e-14 * abs(spot.answer)


@sampled(4)
@pytest.mark.parametrize("seed", range(4 * MORE))
def test_a_value_just_below_a_peak_is_taken_twice_and_just_above_nowhere(seed: int) -> None:
    """Between two of the places, where no row tells that it was passed."""
    rng = Random(seed)
    offset = rng.choice((0.0, 6.0, -5.0))
    case, place = eccentric(offset), rng.choice(peaks(offset))
    low = float(place) - rng.uniform(0.2, 20.0)
    ends = {"angles.AC": [low, low + rng.choice((21.0, 90.0))]}
    below = 10.0 ** -rng.uniform(3.0, 13.0)
    value = float(torque(place, offset) * (1 - mpf(below)))

    def miss(t: mpf) -> mpf:
        return torque(t, offset) - mpf(repr(value))

    apart = 4 * sqrt(mpf(below)) * 57
    true = [zero(miss, place - apart, place), zero(miss, place, place + apart)]
    first, last = map(mpf, ends["angles.AC"])
    held(find(case, ends, Query("value", "T12", value)), [t for t in true if first <= t <= last])
    value = float(torque(place, offset) * (1 + mpf(below)))
    assert find(case, ends, Query("value", "T12", value)) == []


@sampled(2)
@pytest.mark.parametrize("offset", [0.0, -5.0])
def test_a_value_that_is_only_touched_is_one_place(offset: float) -> None:
    """The answer of a scene is right to its last digit, and so is the value that it is asked for."""
    case, place = eccentric(offset), peaks(offset)[0]
    value = float(torque(place, offset))
    held(find(case, {"angles.AC": [-20.0, 71.0]}, Query("value", "T12", value)), [place])


@pytest.mark.parametrize("seed", range(40 if FULL else 1))
def test_a_jump_past_a_value_is_no_place_of_it(seed: int) -> None:
    """A flat face goes over from one corner of a square cam to the next, and the torque from one side to the
    other: what lies between is nowhere taken."""
    rng = Random(seed)
    side = rng.randint(20, 40)
    x, y = round(1.4 * side, 1), round(0.2 * side, 1)
    case = sliding(
        f"{{polygon: [[{y}, {x}], [-{x}, {y}], [-{y}, -{x}], [{x}, -{y}]]}}", "{flat: B, along: 0}"
    )
    at = -math.degrees(math.asin(0.6))
    turn = {"2": [at - rng.uniform(2.0, 5.0), at + 5.0]}
    for share in (0.85, -0.7):
        none = find(case, None, Query("value", "T12", 100.0 * side * share), drive=turn)
        (told,) = (note for note in none.notes if "jumps" in note)
        near, before, after = (float(x) for x in re.findall(r"(?:= |from |to )(-?[0-9.e+]+)", told)[:3])
        assert none == [] and near == pytest.approx(at)
        assert [before, after] == pytest.approx([-100.0 * side, 100.0 * side], rel=1e-5)
    (spot,) = find(case, None, Query("value", "T12", 100.0 * side * 0.99), drive=turn)
    assert abs(spot.at - at) == pytest.approx(
        math.degrees(math.acos(0.99 / math.sqrt(2.0))) - 45.0, abs=spot.error
    )
    (jump,) = find(case, None, Query("max", "T12"), drive=turn)
    assert abs(jump.at - at) <= jump.error <= 1e-8
    assert jump.answer is not None and abs(jump.answer) == pytest.approx(100.0 * side, rel=1e-9)


RUBBING = """icsolve: 1
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: 2, BC: 6}
angles: {AB: 30}
near: {C: [7, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B, mu: 0.3, radius: 0.4}
  - {pin: [3, 4], at: C, mu: 0.3, radius: 0.4}
  - {slide: [4, 1], at: C, along: 0, mu: 0.2}
loads:
  P: {force: 20, link: 4, at: C, angle: 180}
  V: {force: %d, link: 3, at: B, angle: -90}
  T12: {torque: unknown, link: 2}
motion: {link: 2, turns: ccw}
"""


def knife(*corner: int) -> Case:
    """A knife edge on a polygon, over a corner at 45 degrees."""
    return sliding(f"{{polygon: [[20, 20], {[*corner]}, [-20, -20], [20, -20]]}}", "{knife: B}")


JUMPS = [
    (knife(-20, 20), {"2": 0.0}, 45.0),
    (knife(-10, 20), {"2": 0.0}, 45.0),
    (knife(-80, 40), {"2": 0.0}, 45.0),
    (knife(5, 38), {"2": 0.0}, 45.0),
    *((load(RUBBING % v), {"angles.AB": 0.0}, at) for v in (10, 50, -80) for at in (0.0, 90.0, -90.0)),
]
RANGES = [(-10, 30), (-10, 0), (-9, 17.1), (0, 10), (-4.7, 8.3), (0, 7.3), (-1, 1)]
"""Over a jump, and up to it or from it on, in turn: of neighbours both."""


@sampled(4)
@pytest.mark.parametrize("n", range(len(JUMPS)))
def test_a_peak_at_a_jump_is_told_wherever_the_range_begins(n: int) -> None:
    """The answer of the very instant of a jump is neither the one before nor the one behind, or none at all:
    it makes no peak at an end of the range, and hides none within. Each range of some of the jumps."""
    case, drives, jump = JUMPS[n]
    (name,) = drives

    def ends(*offs: float) -> dict[str, dict[str, list[float]]]:
        return {"drive" if name == "2" else "vary": {name: [jump + off for off in offs]}}

    rows = icsolve.sweep(case, **ends(-1e-2, -1e-6, 1e-6, 1e-2))
    farther, before, after, beyond = abs(rows.answers["T12"])
    is_peak = before > farther if before > after else after > beyond
    ranges = [*RANGES, *RANGES][n % 7 :]
    for low, high in ranges[: 7 if FULL else 1]:
        found = find(case, **{"vary": None, "drive": None, **ends(low, high)}, query=Query("max", "T12"))
        here = [spot for spot in found if abs(spot.at - jump) <= max(spot.error, 1e-6)]
        assert len(here) == (is_peak and low < 0 < high), (low, high, found)


def test_of_a_stretch_that_has_a_value_the_ends_are_told() -> None:
    """A follower that rests on the base circle of a tangent cam, on which it takes no torque to hold it."""
    arcs = (
        "{arcs: [{centre: [0, 0], radius: 40, from: [32, 24], to: [32, -24]},"
        " {centre: [30, 0], radius: 16, from: [42.8, -9.6], to: [42.8, 9.6]}]}"
    )
    case = sliding(arcs, "{roller: B, radius: 10}")
    found = find(case, None, Query("value", "T12", 0.0), drive={"2": [0.0, 180.0]})
    flank = mp.degrees(mp.acos(mpf(4) / 5))
    held(list(found), [90 - flank, mpf(90), 90 + flank])
    assert any("whole stretches" in note for note in found.notes)


def test_a_row_alone_is_the_row_among_others() -> None:
    """Also where a knife edge on an arm has just passed a corner, so that it meets neither piece of the
    profile as far as doubles tell."""
    corners = "[31.79, 8.05], [18.57, 31.65], [-29.38, 12.99], [-31.18, -21.86], [16.63, -40.04]"
    case = swinging(f"{{polygon: [{corners}]}}", "{knife: E}")
    rows = [195.1658183610678, 249.0579407930568, 249.0579408, 249.058, 249.0589, 250.0]
    together = icsolve.sweep(case, drive={"2": rows}).answers["T12"]
    for row, value in zip(rows, together, strict=True):
        assert icsolve.sweep(case, drive={"2": [row]}).answers["T12"][0] == value


def test_what_overflows_between_two_rows_is_no_warning(monkeypatch: pytest.MonkeyPatch) -> None:
    """Loads beyond the root of the largest double, on both sides of a dead centre."""
    text = """icsolve: 1
points: {A: [0, 0], B: [3, 0]}
joints: [{slide: [2, 1], at: A, along: 0, mu: 0.4}]
loads:
  W: {weight: 1e200, link: 2, at: A}
  P: {force: unknown, link: 2, at: A, angle: 5}
motion: {point: A, link: 2, speed: 1, angle: 0}
"""
    monkeypatch.setattr(find_by_scenes, "PLACES", 20)
    spots = find(load(text), {"loads.P.angle": [0.0, 60.0]}, Query("value", "P", 3.8e199))
    assert len(spots) == 2


JACK = """icsolve: 1
points: {{B: [0.7, 0], S: [0.3, 1], O: [0, 0]}}
links: {{1: [S, O]}}
joints: [{{screw: [1, 2], at: B, along: 0, lead: 5 mm, radius: 10 mm, mu: {mu}}}]
loads:
  F: {{spring: 100 N/m, free: {free} m, link: 2, at: B, to: S}}
  T: {{torque: unknown, screw: 1-2}}
motion: {{point: B, link: 2, speed: 1, angle: {way}}}
"""


@sampled(2)
@pytest.mark.parametrize(
    ("mu", "touches", "way"),
    [
        *((0.09, True, 0), (0.05, False, 180)),
        *(
            [(0.09, True, 180), (0.05, False, 0), *((mu, True, way) for mu in (0.1, 0.3) for way in (0, 180))]
            * FULL
        ),
    ],
)
def test_where_a_load_on_a_screw_changes_its_sense_the_torque_is_zero(
    mu: float, touches: bool, way: int
) -> None:
    """A screw that locks itself is turned by a torque of one sense however it is loaded, which comes to zero
    in a corner where the load changes its sense, on sides of unlike steepness; one that does not lock itself
    passes through. No value beyond the corner is told."""
    case = icsolve.load(JACK.format(mu=mu, way=way, free=1.01**0.5))
    spots = find(case, {"points.B.x": [-2.0, 1.5]}, Query("value", "T"))
    assert len(spots) == 3
    for spot, place in zip(spots, (0.2, 0.3, 0.4), strict=True):
        assert abs(spot.at - place) <= spot.error + 1e-15
        assert spot.error <= 1e-11
    beyond = -1e-9 if way == 0 else 1e-9
    found = find(case, {"points.B.x": [0.35, 0.45]}, Query("value", "T", beyond))
    assert len(found) == (0 if touches else 1)


STUCK = """icsolve: 1
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: 2, BC: 5}
angles: {AB: 20}
near: {C: [7, 0]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C},
         {slide: [4, 1], at: C, along: 0, mu: 0.01}]
loads: {T: {torque: 5, link: 2}, P: {force: unknown, link: 4, at: C, angle: 180}}
motion: {link: 2, turns: ccw}
"""
HELD = """icsolve: 1
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 2, BC: 3, CD: 3}
angles: {DC: 110}
near: {B: [1, 2]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C},
         {pin: [4, 1], at: D, mu: 0.1, radius: 0.01}]
loads: {P: {torque: 5, link: 2}, T: {torque: unknown, link: 4}}
motion: {link: 2, turns: ccw}
"""


@sampled(3)
@pytest.mark.parametrize(
    ("text", "path", "place", "kind"),
    [
        (STUCK, "angles.AB", 0.0, "dead"),
        (STUCK, "angles.AB", 180.0, "dead"),
        (HELD, "angles.DC", 90.0, "limit"),
    ],
)
def test_where_it_locks_in_one_place_is_told_once(text: str, path: str, place: float, kind: str) -> None:
    """Cranks in line begin to lock and cease to within less than the errors; at a limit, of an upright
    triangle 3-4-5, that it is one is told."""
    (spot,) = find(load(text), {path: [place - 20.0, place + 20.0]}, Query("dead"))
    assert spot.kind == kind
    assert abs(spot.at - place) <= spot.error <= 1e-9


@pytest.mark.parametrize("place", [0.0, 360.0])
def test_a_level_peak_at_an_end_of_the_range_belongs_to_it(place: float) -> None:
    """A weight on an arm in a pin that rubs with a moment of its own: P r cos and what the pin takes."""
    case = load("""icsolve: 1
points: {A: [0, 0]}
lengths: {AB: 2}
angles: {AB: 20}
joints: [{pin: [1, 2], at: A, mu: 0.2, radius: 0.1}]
loads: {W: {weight: 5, link: 2, at: B}, T: {torque: unknown, link: 2}}
motion: {link: 2, turns: ccw}
""")
    rubs = 5.0 * 0.1 * math.sin(math.atan(0.2))
    for span in (
        (place, place + 20.0),
        (place - 20.0, place),
        (place + 20.0, place),
        (place - 7.0, place + 9.0),
    ):
        (spot,) = find(case, {"angles.AB": [*span]}, Query("max"))
        assert abs(spot.at - place) <= spot.error <= 1e-4
        assert spot.answer == pytest.approx(10.0 + rubs, rel=1e-12)


ROUGH_BLOCK = """icsolve: 1
points: {A: [0, 0], C: [unknown, 0.5]}
lengths: {AB: 2, BC: 6}
angles: {AB: 60}
near: {C: [7, 0.5]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0, mu: 0.2, length: 0.5}
loads:
  P: {force: 100, link: 4, at: C, angle: 180}
  T: {torque: unknown, link: 2}
motion: {link: 2, turns: cw}
"""
POST = """icsolve: 1
points: {A: [0, 0], P: [3, 4], E: [5, 0], D: [-1, 1]}
joints:
  - {pin: [2, 1], at: D}
  - {rope: [A, P, E], on: [2, 1], radii: {P: 0.3}, wraps: {P: cw}, mu: {P: 0.3}}
loads:
  P: {torque: 20, link: 2, turns: cw}
  T: {force: unknown, at: E}
motion: {link: 2, turns: cw}
"""
LIFT = """icsolve: 1
points: {A: [0, 0], B: [2, 0], G: [3, 0]}
joints: [{screw: [1, 2], at: B, along: 0, lead: 5 mm, radius: 10 mm, mu: 0.1}]
loads:
  P: {force: 1 kN, link: 2, at: G, angle: 180}
  T: {torque: unknown, screw: 1-2}
motion: {point: G, link: 2, speed: 0.01, angle: 0}
"""
PLACED: dict[str, tuple[str, tuple[str, float, float]]] = {
    "a rough block": (ROUGH_BLOCK, ("loads.P", 50.0, 100.0)),
    "a rough slider-crank that turns": (ROUGH_BLOCK, ("angles.AB", 20.0, 80.0)),
    "a post": (POST, ("loads.P", 10.0, 30.0)),
    "a screw": (LIFT, ("loads.P", 500.0, 1500.0)),
}


@sampled(6, "name")
@pytest.mark.parametrize("share", [0.0, 0.125, 0.25, 0.5, 0.75, 1.0])
@pytest.mark.parametrize("name", PLACED)
def test_a_value_that_a_place_has_is_found_there(name: str, share: float) -> None:
    """It was missed where rounding put it to one side of such a place and the bounds to neither: of the value
    that a row or a scene tells, and of its neighbours inside the range."""
    text, (path, low, high) = PLACED[name]
    case, at = load(text), low + share * (high - low)
    told = {float(value) for value in sweep(case, {path: [at]}).answers["T"]}
    told.add(solve(load(text, {path: at})).answers["T"].value or 0.0)
    if 0.0 < share < 1.0:
        told |= {math.nextafter(value, way) for value in told for way in (-math.inf, math.inf)}
    for value in told:
        found = find(case, {path: [low, high]}, Query("value", "T", value))
        assert [spot.at for spot in found if abs(spot.at - at) < 1e-3] == pytest.approx([at], rel=1e-9), value


def test_a_value_that_an_even_answer_misses_by_a_digit_is_nowhere() -> None:
    """A block on a rough table: 0.3 of its weight wherever it is."""
    case = load(
        "icsolve: 1\npoints: {A: [0, 0]}\njoints: [{slide: [2, 1], at: A, along: 0, mu: 0.3}]\n"
        "loads: {W: {weight: 107, link: 2, at: A}, F: {force: unknown, link: 2, at: A, angle: 0}}\n"
        "motion: {point: A, link: 2, speed: 1, angle: 0}\n"
    )
    for value, places in ((32.1, [0.0, 10.0]), (math.nextafter(32.1, 33.0), [])):
        assert [
            spot.at for spot in find(case, {"points.A.x": [0.0, 10.0]}, Query("value", "F", value))
        ] == places


def test_smooth_crests_and_zeros_are_not_closed_in_on_for_a_dead_centre(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The torque of an eccentric is largest twice a turn, and zero twice: a few places tell that it does not
    run off to infinity at any of them."""
    asked: list[int] = []
    inner = find_by_scenes.Scenes._swept

    def counted(self: find_by_scenes.Scenes, at: Array, proven: bool = False) -> SeenRows:
        asked.append(len(at))
        return inner(self, at, proven)

    monkeypatch.setattr(find_by_scenes.Scenes, "_swept", counted)
    assert not find(eccentric(5.0), {}, Query("dead"), drive={"2": (0.0, 360.0)})
    # of each crest what six halvings and a parabola ask for, of each zero three quarterings
    assert sum(asked[3:]) <= 2 * (2 * 6 + 4) + 2 * (1 + 3 * 3 + 4)


@pytest.mark.parametrize("kind", ["max", "dead", "value"])
def test_what_holds_over_a_range_is_refused_at_the_first_place(
    kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And not when all the others are solved."""
    case = load(
        "icsolve: 1\npoints: {A: [0, 0], B: [0.6, 0], G: [0.3, 0.6], H: [0, 0.5]}\njoints:\n"
        "  - {contact: [1, 2], at: A, normal: 90, mu: 0.3}\n"
        "  - {contact: [1, 2], at: B, normal: 90, mu: 0.3}\n"
        "loads:\n  W: {weight: 500, link: 2, at: G}\n  P: {force: unknown, link: 2, at: H, angle: 0}\n"
    )
    solved = []

    def counted(*given: object, **more: object) -> object:
        found = sweep(*given, **more)  # type: ignore[arg-type]
        solved.append(len(found.status))
        return found

    monkeypatch.setattr(find_by_scenes, "sweep", counted)
    with pytest.raises(icsolve.SceneError, match="holds over a range"):
        find(case, {"points.A.x": [-1.0, 0.2]}, Query(kind, "P", 20.0))
    assert sum(solved) == 1
