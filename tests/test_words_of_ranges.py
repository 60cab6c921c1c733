"""What is said of a range without end: a load that drives against friction that it makes itself locks; one
that presses, as on a brake, holds the more the harder it presses; what friction alone presses is a jam."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest

import icsolve
import rough_scenes
import standing
from icsolve.draw import draw
from icsolve.explain import explain
from icsolve.report import answer_text
from icsolve.sweep.varied_numbers import find_number, with_numbers
from shell import Shell
from sizes import FULL, sampled

LOCKS, PRESSES, JAMS = "it locks that way", "the harder it presses, the more it holds", "it holds as a jam"


def shoe(dice: Random) -> str:
    """A lever whose pad lies on a drum, pulled so that it does."""
    return f"""icsolve: 1
units: {{length: mm, force: N, torque: N*m}}
points: {{O: [0, 0], S: [-150, 0], D: [{-dice.randint(160, 260)}, -250], E: [-200, 350]}}
joints:
  - {{pin: [1, drum], at: O}}
  - {{pin: [1, lever], at: D}}
  - {{contact: [drum, lever], at: S, normal: 180, mu: {dice.uniform(0.1, 0.6):.2f}}}
loads:
  T: {{torque: {dice.choice((-60, -5, 20, 200))}, link: drum}}
  F: {{force: unknown, link: lever, at: E, angle: {dice.choice((0, 180))}}}
"""


def band(dice: Random) -> str:
    """A lever that draws a band round a drum."""
    text = rough_scenes.band(dice).text.replace("F:", "T:").replace("P:", "F:")
    torque = dice.choice((-500, 200, 900))
    return "icsolve: 1\n" + re.sub(r"force: \d+", "force: unknown", text).replace("LOAD", str(torque))


def wall(dice: Random) -> str:
    """A block pressed square to a wall."""
    return f"""icsolve: 1
points: {{A: [0, 0]}}
joints:
  - {{slide: [2, 1], at: A, along: {(tilt := dice.randint(0, 179))}, mu: {dice.uniform(0.1, 0.9):.2f}}}
loads:
  W: {{force: 100, link: 2, at: A, angle: {tilt}}}
  F: {{force: unknown, link: 2, at: A, angle: {tilt + 90}}}
"""


@pytest.mark.parametrize("kind", [shoe, band, wall])
@pytest.mark.parametrize("seed", range(20 if FULL else 2))
def test_what_presses_is_not_said_to_lock(kind: Callable[[Random], str], seed: int) -> None:
    """The load does no work as the drum turns: however large, it could not drive it."""
    answer = icsolve.solve(icsolve.load(kind(Random(f"{kind.__name__} {seed}"))))
    found = answer.answers["F"]
    assert math.isinf(found.holds[1] - found.holds[0])
    assert not found.self_locking
    assert any(PRESSES in note for note in answer.notes)
    assert not any(LOCKS in note for note in answer.notes)


@pytest.mark.parametrize("seed", range(20 if FULL else 2))
def test_what_drives_against_its_own_friction_locks(seed: int) -> None:
    """A block pushed at an angle steeper than that of friction: no push of that sense moves it along."""
    dice = Random(f"pushed {seed}")
    mu = dice.uniform(0.1, 0.9)
    steep = dice.uniform(math.degrees(math.atan(1.0 / mu)) * 0.2, math.degrees(math.atan(mu)) * 0.95)
    text = f"""icsolve: 1
points: {{A: [0, 0]}}
joints: [{{slide: [2, 1], at: A, along: 0, mu: {mu!r}}}]
loads: {{W: {{weight: 100, link: 2, at: A}}, F: {{force: unknown, link: 2, at: A, angle: {steep - 90.0!r}}}}}
"""
    answer = icsolve.solve(icsolve.load(text))
    locks = math.tan(math.radians(steep)) < mu
    assert answer.answers["F"].self_locking
    assert any(LOCKS in note for note in answer.notes) is locks
    assert math.isinf(answer.answers["F"].holds[1]) is locks
    assert not any(PRESSES in note for note in answer.notes)


@pytest.mark.parametrize("seed", range(60 if FULL else 7))
def test_a_cam_that_its_spring_lifts_holds_only_as_a_jam(seed: int) -> None:
    """A bar drawn under a cam on a pin at height h: moments about the pin, S + x N + h f = 0, and f = -F at
    the contact at x give N = (h F - S) / x. Without F the spring lifts the cam where S / x is positive: what
    holds then was jammed before, and is said to be; where the spring presses it is not."""
    dice = Random(f"cam {seed}")
    x, h, mu = dice.choice((-1, 1)) * dice.randint(3, 20), dice.randint(20, 40), dice.randint(10, 60) / 100
    spring = dice.choice((-1, 1)) * dice.randint(1, 30)
    text = f"""icsolve: 1
units: {{length: mm, force: N}}
points: {{D: [0, {h}], P: [{x}, 0], B: [60, -5]}}
joints:
  - {{pin: [1, cam], at: D}}
  - {{contact: [cam, bar], at: P, normal: -90, mu: {mu}}}
  - {{slide: [bar, 1], at: B, along: 0}}
loads:
  F: {{force: PULL, link: bar, at: B, angle: 180}}
  S: {{torque: {spring}, link: cam}}
"""
    lifts = spring / x > 0.0
    case = icsolve.load(text.replace("PULL", "unknown"))
    if lifts and mu * h <= abs(x):
        with pytest.raises(icsolve.SceneError, match="is lost"):
            icsolve.solve(case)
        return
    answer = icsolve.solve(case)
    low, high = answer.answers["F"].holds
    assert (low <= 0.0 <= high) is not lifts
    assert any(JAMS in note for note in answer.notes) is lifts
    inside = (low if math.isfinite(low) else high - 1.0) + 0.5 * min(
        high - low, 2.0 if math.isfinite(low) else 0.0
    )
    given = icsolve.solve(icsolve.load(text.replace("PULL", repr(inside))))
    assert given.holds_still is True
    assert any(JAMS in note for note in given.notes) is lifts


BESIDE = """points: {K: [90, 90]}
joints: [{slide: [9, 1], at: K, along: 0, mu: 0.3}]
loads: {V: {weight: 10, link: 9, at: K}, H: {force: 2, link: 9, at: K, angle: 0}}
"""


def gap(dice: Random) -> tuple[str, bool]:
    """A block between two planes that lean on it from above, or carry it from below."""
    lean = dice.choice((-1, 1)) * dice.randint(2, 14)
    return (
        f"""points: {{A: [0, 0], B: [1, 0], G: [0.5, {dice.uniform(-1, 1):.2f}]}}
joints:
  - {{contact: [1, 2], at: A, normal: {lean}, mu: 0.3}}
  - {{contact: [1, 2], at: B, normal: {180 - lean}, mu: 0.3}}
loads: {{F: {{weight: {dice.randint(5, 50)}, link: 2, at: G}}}}
""",
        lean < 0,
    )


def cam_on_bar(dice: Random) -> tuple[str, bool]:
    """A bar drawn under a cam that its spring lifts, or presses; drawn so that it holds where it can."""
    x, h, mu = dice.choice((-1, 1)) * dice.randint(3, 9), dice.randint(30, 40), dice.randint(40, 60) / 100
    spring = dice.choice((-1, 1)) * dice.randint(1, 30)
    lifts = spring / x > 0.0
    pull = 10.0 * spring / h if lifts else 0.0
    return (
        f"""points: {{D: [0, {h}], P: [{x}, 0], B: [60, -5]}}
joints:
  - {{pin: [1, 3], at: D}}
  - {{contact: [3, 2], at: P, normal: -90, mu: {mu}}}
  - {{slide: [2, 1], at: B, along: 0}}
loads: {{F: {{force: {pull}, link: 2, at: B, angle: 180}}, S: {{torque: {spring}, link: 3}}}}
""",
        lifts,
    )


def on_a_slope(dice: Random) -> tuple[str, bool]:
    """A crate on a slope that carries it, its weight named first, and a pull that draws it down the slope or
    up, along it or a little off."""
    lean, pull = dice.choice((-1, 1)) * dice.randint(2, 20), dice.choice((-1, 1)) * dice.randint(1, 15)
    c, s = math.cos(math.radians(lean)), math.sin(math.radians(lean))
    return (
        f"""points: {{A: [0, 0], B: [{c!r}, {s!r}], G: [{0.5 * c - 0.1 * s!r}, {0.5 * s + 0.1 * c!r}]}}
joints:
  - {{contact: [1, 2], at: A, normal: {90 + lean}, mu: 0.7}}
  - {{contact: [1, 2], at: B, normal: {90 + lean}, mu: 0.7}}
loads:
  F: {{weight: 100, link: 2, at: G}}
  P: {{force: {pull}, link: 2, at: G, angle: {lean + dice.randint(-20, 20)}}}
""",
        False,
    )


@sampled(3, "kind")
@pytest.mark.parametrize("kind", [gap, cam_on_bar, on_a_slope])
@pytest.mark.parametrize("beside", ["", BESIDE], ids=["alone", "beside a block"])
@pytest.mark.parametrize("seed", range(60 if FULL else 2))
def test_a_jam_is_told_whatever_is_unknown_and_whatever_else_may_move(
    kind: Callable[[Random], tuple[str, bool]], beside: str, seed: int
) -> None:
    """What planes that lean over it hold, and a cam that its spring lifts, was pressed together before; what
    its weight presses to a slope was not, although a pull alone would lift it off."""
    text, jams = kind(Random(f"{kind.__name__} {seed}"))
    text = standing.side_by_side([text, beside] if beside else [text])
    given = icsolve.solve(icsolve.load(text))
    assert given.holds_still is True, text
    assert any(JAMS in note for note in given.notes) is jams, text
    load = r"(F0:\s+(?:force|weight): )[\d.-]+"
    if kind is not gap:  # no value of the weight moves that
        asked = icsolve.solve(icsolve.load(re.sub(load, r"\1unknown", text)))
        assert any(JAMS in note for note in asked.notes) is jams, text


PYTHAGOREAN = [(3, 4, 0.75), (1, 2, 0.5), (1, 1, 1.0), (5, 4, 1.25), (1, 8, 0.125), (3, 10, 0.3)]


@pytest.mark.parametrize(("run", "rise", "mu"), PYTHAGOREAN)
@pytest.mark.parametrize("where", ["block", "cam"])
def test_a_load_at_just_the_angle_of_friction_locks(where: str, run: int, rise: int, mu: float) -> None:
    """A block pushed along that angle, and a bar under a cam whose pin lies on it: the friction grows as fast
    as the push, and what else presses makes it more, so no push moves it."""
    block = f"""points: {{A: [0, 0]}}
joints: [{{slide: [2, 1], at: A, along: 0, mu: {mu}}}]
loads: {{W: {{weight: 100, link: 2, at: A}}, F: {{force: unknown, link: 2, at: A, slope: [{run}, {-rise}]}}}}
motion: {{point: A, link: 2, speed: 1, angle: 0}}
"""
    cam = f"""points: {{D: [0, {10 * rise}], P: [{10 * run}, 0], B: [60, -5]}}
joints:
  - {{pin: [1, cam], at: D}}
  - {{contact: [cam, bar], at: P, normal: -90, mu: {mu}}}
  - {{slide: [bar, 1], at: B, along: 0}}
loads: {{S: {{torque: -20, link: cam}}, F: {{force: unknown, link: bar, at: B, angle: 180}}}}
motion: {{point: B, link: bar, speed: 1, angle: 180}}
"""
    rest, _, motion = ("icsolve: 1\n" + {"block": block, "cam": cam}[where]).partition("motion")
    answer = icsolve.solve(icsolve.load(rest))
    found = answer.answers["F"]
    assert found.holds[0] < 0.0 and found.holds[1] == math.inf
    assert found.self_locking and found.error is not None
    assert any(LOCKS in note for note in answer.notes)
    with pytest.raises(icsolve.SceneError, match="the forces grow without bound") as refusal:
        icsolve.solve(icsolve.load(f"{rest}motion{motion}"))
    assert refusal.value.status == "jam"


def toggle(rise: float, pins: str, load: str, known: str = "F: {force: unknown") -> str:
    """A rod that pushes a crank of 1 that is turned from its dead centre by a rise; P is as far as the crank
    is long from the slider, which W pushes. The pins that rub are told."""
    rough = {at: f", {rubs}" if at in pins else "" for at, rubs in (("A", RUBS), ("B", RUBS), ("C", RUBS))}
    return f"""icsolve: 1
points: {{A: [0, 0], B: [1, {rise!r}], C: [3, 0]}}
joints:
  - {{pin: [1, 2], at: A{rough["A"]}}}
  - {{pin: [2, 3], at: B{rough["B"]}}}
  - {{pin: [3, 4], at: C{rough["C"]}}}
  - {{slide: [4, 1], at: C, along: 0, mu: 0.2}}
loads:
  V: {{force: 40, link: 4, at: C, angle: 90}}
  W: {{force: 20, link: 4, at: C, angle: 0}}
  {known}, {load}}}
"""


RUBS, CIRCLE = "mu: 0.36, radius: 0.05", 0.05 * math.sin(math.atan(0.36))


@sampled(2, "share")
@pytest.mark.parametrize("share", [1e-15, 1e-9, 1e-4, 0.3, 0.97, 1.03, 3.0])
@pytest.mark.parametrize("angle", [0, 20])
def test_a_rod_that_pushes_within_the_friction_circle_of_its_crank_locks(share: float, angle: int) -> None:
    """The rod's line passes the pivot A within the circle: no push of the slider turns the crank, whichever
    way. Beyond it the crank bears no push, and the slider's own friction alone holds what pushes it."""
    rise = share * CIRCLE / 1.5  # a line from (1, rise) to (3, 0) passes (0, 0) at 1.5 rise
    answer = icsolve.solve(icsolve.load(toggle(rise, "A", f"link: 4, at: C, angle: {angle}")))
    found = answer.answers["F"]
    if share < 1.0:
        assert found.holds == (-math.inf, math.inf) and found.self_locking
        return
    turned = math.radians(angle)
    along, across = math.cos(turned), math.sin(turned)
    ends = [-(20 + way * 8) / (along + way * 0.2 * across) for way in (-1, 1)]
    assert found.holds == pytest.approx(sorted(ends), rel=1e-12) and not found.self_locking


@sampled(2)
@pytest.mark.parametrize("rise", [1e-3, 1e-5, 1e-7, 1e-9, 1e-12, 1e-16, 1e-17])
def test_beside_a_dead_centre_it_locks_on_both_sides_of_a_pin_without_load(rise: float) -> None:
    """Pin B alone rubs, F pushes it along the rod: where (6 + d) rise = 1.5 r |d| it is about to move, with
    the slider's friction of 8, F = d - 12 and the radius r of the friction circle. Between the two it may
    move, to both sides it locks; in the end they lie closer together than doubles tell forces apart."""
    answer = icsolve.solve(icsolve.load(toggle(rise, "B", "link: 3, at: B, angle: 0")))
    low, high = answer.answers["F"].holds
    first, second = (-12 - way * 6 * rise / (1.5 * CIRCLE + way * rise) for way in (1, -1))
    assert low == -math.inf
    assert high == (math.inf if rise < 1e-8 else pytest.approx(first, abs=3 * rise))
    if high < math.inf:
        (beyond,) = (note for note in answer.notes if "it holds too" in note)
        assert float(beyond.split()[1]) == pytest.approx(second, abs=3 * rise + 1e-4)  # of six figures
        assert beyond.split()[2] == "up"
    for force in (-100, 0, 100):
        known = toggle(rise, "B", "link: 3, at: B, angle: 0", f"F: {{force: {force}")
        assert icsolve.solve(icsolve.load(known)).holds_still is True


LEFT = "left the other way round at some joint"


def left_rod(dice: Random) -> tuple[str, icsolve.Answer]:
    """A rod in two rough slots with a LOAD, and what is found of that one: friction holds more of it, as it
    was left, than what grew from rest."""
    while True:
        text = re.sub("  L1: .*\n", "", standing.rod(dice))  # a torque
        text = "LOAD".join(text.rsplit("force: 1,", 1)).replace("LOAD", "force: LOAD,")
        answer = icsolve.solve(icsolve.load(text.replace("LOAD", "unknown")))
        assert answer.friction is not None and answer.friction.possible is not None
        high, most = answer.answers["L2"].holds[1], answer.friction.possible[1]
        if math.isfinite(high) and most - high > 0.01 * abs(high):
            return text, answer


@sampled(4)
@pytest.mark.parametrize("seed", range(60 if FULL else 4))
def test_between_impending_motion_and_what_friction_can_hold_it_is_open(
    seed: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A rod in two rough slots: with one load unknown, known and sought the same is said of the stretch in
    which friction holds only as it was left."""
    text, held = left_rod(Random(f"left {seed}"))
    high, most = held.answers["L2"].holds[1], held.friction.possible[1]
    assert any(f"from {high:.6g}" in note and LEFT in note for note in held.notes)
    beyond = 0.5 * (high + most) if math.isfinite(most) else high + abs(high) + 1.0
    known = text.replace("LOAD", repr(beyond))
    given = icsolve.solve(icsolve.load(known))
    assert given.holds_still is None and "holds_still" not in given.to_dict()
    assert [LEFT in note for note in given.notes] == [True]
    case = tmp_path / "case.yaml"
    case.write_text(known)
    shell = Shell(capsys)
    assert LEFT in " ".join(shell("explain", case).out.split())
    span = f"loads.L2={high - 0.01 * abs(high)!r},{high + 0.001 * abs(high)!r}"
    (found,) = shell("sweep", case, "--vary", span, "--find", "hold", "--json").objects()
    (one,) = found["found"]
    assert (one["from"], one["to"]) == ("holds", "slips")
    assert one["at"]["loads.L2"] == pytest.approx(high, rel=1e-12)
    assert any(LEFT in note for note in found["notes"])


@sampled(2, "path")
@pytest.mark.parametrize("path", ["loads.L2", "joints.A.mu"])
@pytest.mark.parametrize("seed", range(30 if FULL else 4))
def test_where_nothing_changes_it_is_told_where_friction_holds_only_as_it_was_left(
    seed: int, path: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """From the first to the last of the places looked at of which `solve` leaves it open if the rod holds;
    at the others it slips."""
    dice = Random(f"left throughout {seed}")
    judged: list[bool | None] = [True]
    while None not in judged or True in judged:
        text, held = left_rod(dice)
        high, most = held.answers["L2"].holds[1], held.friction.possible[1]
        room = min(most - high, abs(high) + 1.0)
        known = text.replace("LOAD", repr(high + dice.uniform(0.2, 0.8) * room))
        case = icsolve.load(known)
        start = find_number(case, path).value if path == "joints.A.mu" else high + 0.1 * room
        wide = dice.uniform(0.1, 0.4) if path == "joints.A.mu" else dice.uniform(0.5, 3.0) * room
        values = [start + wide * k / 32 for k in range(33)]
        judged = [icsolve.solve(with_numbers(case, {path: value})).holds_still for value in values]
    file = tmp_path / "case.yaml"
    file.write_text(known)
    words = ("sweep", file, "--vary", f"{path}={values[0]!r},{values[-1]!r}", "--find", "hold", "--json")
    (found,) = Shell(capsys)(*words).objects()
    left = [value for value, holds in zip(values, judged, strict=True) if holds is None]
    ends = f"from {path} = {left[0]:.6g} to {left[-1]:.6g}"
    assert not found["found"]
    assert any(LEFT in note and ends in note for note in found["notes"]), (found["notes"], ends)


@pytest.mark.parametrize("turns", ["", ", turns: cw"])
def test_no_end_of_a_range_is_minus_nothing(turns: str) -> None:
    """A cylinder in a rough corner, which the least couple rolls out of it: it parts from the wall at 0."""
    answer = icsolve.solve(
        icsolve.load(f"""icsolve: 1
points: {{O: [0.2, 0.2], F: [0.2, 0], L: [0, 0.2]}}
joints:
  - {{contact: [1, 2], at: F, normal: 90, mu: 0.3}}
  - {{contact: [1, 2], at: L, normal: 0, mu: 0.3}}
loads:
  W: {{weight: 100, link: 2, at: O}}
  M: {{torque: unknown, link: 2{turns}}}
""")
    )
    told = [note for note in answer.notes if "a contact would have to pull" in note]
    assert told and "by M = 0 a contact" in told[0]
    held = answer.answers["M"].holds
    assert held is not None
    most = 100 * 0.2 * 0.3 * 1.3 / 1.09  # both rub at their limits
    assert sorted(map(abs, held)) == [0.0, pytest.approx(most, rel=1e-12)]


NARROW = """
icsolve: 1
points: {O: [0, 0], A: [-300, 20], B: [100, 40]}
joints:
  - {pin: [1, 2], at: O, radius: 1, mu: MU}
loads:
  P: {force: FORCE, link: 2, at: A, angle: -90}
  Q: {force: unknown, link: 2, at: B, angle: -90}
"""


@pytest.mark.parametrize("mu", ["1e-4", "1e-6", "1e-9", "1e-12"])
@pytest.mark.parametrize("force", [22, -7.3333, 0.05])
def test_a_narrow_range_is_told_with_digits_that_tell_its_ends_apart(mu: str, force: float) -> None:
    """In text, worked solution and figure: a pin that hardly rubs holds from 66 - 8.8e-5 to 66 + 8.8e-5, and
    was told to hold from 66 to 66. Each is the end to the digits that it is told with."""
    case = icsolve.load(NARROW.replace("MU", mu).replace("FORCE", str(force)))
    answer = icsolve.solve(case)
    ends = answer.answers["Q"].holds
    assert ends is not None
    for text in (answer_text(answer), explain(case), draw(case)):
        told = [float(one.replace("−", "-")) for one in re.findall(r"from (\S+) to (\S+) ", text)[0]]
        assert told[0] < told[1]
        for one, end in zip(told, ends, strict=True):
            assert any(one == float(f"{end:.{digits}g}") for digits in range(4, 18)), (one, end)
