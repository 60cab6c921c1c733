"""All loads that friction within its limits can hold: of rough pins, guides and contacts, however they act on
one another, the ranges that are told are complete, and they end where they are said to."""

from __future__ import annotations

import math
from collections.abc import Iterator
from copy import deepcopy
from random import Random

import numpy as np
import pytest

import icsolve
import rubbing
import standing
import transcribe
import transforms
from growth import Growing, random_mechanism
from icsolve.numbers.replay import Array
from icsolve.scene import standing as all_loads
from mechanisms import polar, spot
from sizes import FULL, few, sampled

Range = tuple[float, float]


def scene(seed: int) -> str:
    """A random mechanism that rubs in up to three places, much or little."""
    rng = Random(seed)
    return transcribe.text(rubbing.roughened(rng, random_mechanism(rng), 3))


def ranges(answer: icsolve.Answer) -> list[Range]:
    """The range in which friction can hold, and those beyond it."""
    assert answer.friction is not None and answer.friction.possible is not None
    return sorted((answer.friction.possible, *answer.friction.again))


LINEAR = {
    33: [(-math.inf, -0.0546992258), (2.30280599, math.inf)],
    93: [(-math.inf, math.inf)],
    237: [(-math.inf, 429.502953), (475.592826, math.inf)],
    291: [(-math.inf, -208.278393), (106119.623, math.inf)],
    302: [(-math.inf, -1459.40384), (40.0080592, math.inf)],
    306: [(-math.inf, -69.3915131)],
}
"""Ends by linear programs (HiGHS) on cones in which the force of a pin lies, cut to 1e-5 rad."""


@sampled(2)
@pytest.mark.parametrize("seed", LINEAR)
def test_ranges_beyond_a_gap_are_those_of_linear_programs(seed: int) -> None:
    """To 1e-7, as far as the programs go."""
    answer = icsolve.solve(icsolve.load(scene(seed)))
    for found, true in zip(ranges(answer), LINEAR[seed], strict=True):
        assert found == pytest.approx(true, rel=1e-7)
    assert answer.friction is not None and answer.friction.unique.startswith("proven")


@sampled(2)
@pytest.mark.parametrize("seed", LINEAR)
def test_all_loads_at_once_are_held_in_these_ranges_and_beside_none(seed: int) -> None:
    """A thousandth of its size to both sides of each end."""
    text = scene(seed)
    for low, high in LINEAR[seed]:
        for end, side in ((low, 1.0), (high, -1.0)):
            for inside in (True, False) if math.isfinite(end) else ():
                value = end + (side if inside else -side) * 1e-3 * abs(end)
                depth = all_loads(icsolve.load(text.replace("unknown", repr(value)))).depth
                assert (depth >= 0.0) is inside, value


@pytest.mark.parametrize("part", range(30 if FULL else 1))
def test_no_friction_within_its_limits_holds_a_load_that_is_not_told(part: int) -> None:
    """Frictions of any sense and share of their limits, drawn: the load that each balances lies in a range,
    to 1e-6 of the largest load."""
    compared = 0
    for seed in range(12 * part, 12 * part + few(12)):
        text, dice = scene(seed), Random(f"shares {seed}")
        case = icsolve.load(text)
        try:
            answer = icsolve.solve(case)
        except icsolve.SceneError:
            continue
        if answer.friction is None or answer.friction.possible is None:
            continue
        told = ranges(answer)
        a, friction, b, places = standing.with_friction(case)
        room = 1e-6 * np.abs(b).max()
        for _ in range(12):
            shares = tuple([dice.choice((-1.0, 1.0, dice.uniform(-1, 1))) for _ in places])
            x = rubbing.followed(a, b, friction, places, shares, rubbing.STEPS)
            if x is not None and pushes(case, x):
                load = float(x[a.shape[1] - 1])
                held = any(low - room <= load <= high + room for low, high in told)
                assert held, (text, shares, load, told)
                compared += 1
    assert compared > few(10)


def geared(dice: Random) -> str:
    """Two wheels on rough pivots, heavy beside the torque that the second bears: on which flank its teeth
    carry is for its friction to say."""
    outer = dice.choice((-60, 25, 40))
    return f"""icsolve: 1
points: {{O: [0, 0], Q: [2, {dice.uniform(-1, 1):.2f}]}}
joints:
  - {{pin: [1, 2], at: O, mu: {dice.uniform(0.1, 0.6):.2f}, radius: {dice.uniform(0.05, 0.3):.2f}}}
  - {{pin: [1, 3], at: Q, mu: {dice.uniform(0.1, 0.6):.2f}, radius: {dice.uniform(0.05, 0.3):.2f}}}
  - {{gears: [2, 3], teeth: [20, {outer}], pressure angle: {dice.choice((14.5, 20, 25))}}}
loads:
  V: {{force: {dice.uniform(10, 100):.1f}, link: 2, at: O, angle: {dice.randint(0, 359)}}}
  W: {{force: {dice.uniform(10, 100):.1f}, link: 3, at: Q, angle: {dice.randint(0, 359)}}}
  T: {{torque: {dice.uniform(-8, 8):.2f}, link: 3}}
  U: {{torque: unknown, link: 2}}
"""


@pytest.mark.parametrize("part", range(20 if FULL else 1))
def test_the_teeth_of_a_range_carry_on_the_flank_on_which_they_push(part: int) -> None:
    """A thousandth of the range within each end all loads at once are held, and so much beyond they are not;
    in the motion that begins at an end the torque is that of the end, to 1e-12."""
    for seed in range(10 * part, 10 * part + few(10)):
        text = geared(Random(f"geared {seed}"))
        low, high = icsolve.solve(icsolve.load(text)).answers["U"].holds
        room = 1e-3 * (high - low)
        for end, inward, turns in ((low, room, "cw"), (high, -room, "ccw")):
            for value, held in ((end + inward, True), (end - inward, False)):
                given = icsolve.load(text.replace("unknown", repr(value)))
                assert (all_loads(given).depth >= 0.0) is held, (seed, value, (low, high))
            moved = icsolve.solve(icsolve.load(f"{text}motion: {{link: 2, turns: {turns}}}\n"))
            assert moved.answers["U"].value == pytest.approx(end, rel=1e-12), seed


def pushes(case: icsolve.Case, x: Array) -> bool:
    """Whether no contact pulls."""
    return all(x[column] >= -1e-9 for column in standing.pushing(case))


def told_of(scene: transcribe.Scene, factor: float = 1.0) -> tuple[str, list[float], bool, bool]:
    """What is told of a scene's load times a factor: a status, or where it holds, whether by itself, and
    whether that is proven."""
    try:
        answer = icsolve.solve(icsolve.load(transcribe.text(scene)))
    except icsolve.SceneError as refusal:
        return str(refusal.status), [], False, False
    found = answer.answers["U"]
    ends = [found.value] if found.holds is None else sorted(factor * end for end in found.holds)
    return "", ends, bool(found.self_locking), found.error is not None


def pressing(dice: Random) -> str:
    """A weightless lever on a rough pivot that is pressed to a heavy block on a rough guide."""
    x, y = dice.uniform(-0.5, 0.5), dice.uniform(1.5, 3)
    u, v = dice.uniform(0.1, 0.6), dice.uniform(0.5, 1.4)
    return f"""icsolve: 1
points: {{O: [0, 0], A: [{x:.3f}, {y:.3f}], C: [{u:.3f}, {v:.3f}], G: [1.5, 0.3]}}
joints:
  - {{pin: [1, 2], at: O, mu: {dice.uniform(0.05, 0.6):.2f}, radius: {dice.uniform(0.02, 0.2):.3f}}}
  - {{contact: [2, 3], at: C, normal: {dice.uniform(-20, 20):.1f}}}
  - {{slide: [3, 1], at: G, along: {dice.uniform(-10, 10):.1f}, mu: {dice.uniform(0.3, 0.6):.2f}}}
loads:
  W: {{weight: {dice.uniform(10, 100):.1f}, link: 3, at: G}}
  U: {{force: unknown, link: 2, at: A, angle: {dice.uniform(-20, 20):.1f}}}
"""


def test_a_lever_holds_what_it_presses_from_nothing_on() -> None:
    """Where its load vanishes so does all that it presses with, whereto the force of its pivot points."""
    for seed in range(few(60)):
        text = pressing(Random(f"lever {seed}"))
        found = icsolve.solve(icsolve.load(text)).answers["U"]
        assert found.holds is not None and found.holds[0] == 0.0 < found.holds[1], text
        assert found.error is not None and found.self_locking, text


def with_idle_links(rng: Random, scene: transcribe.Scene, slots: bool) -> transcribe.Scene:
    """A scene with one link more in three rough slots, or two on thin rough pins at right angles."""
    more = deepcopy(scene)
    g = Growing(rng)
    g.points, g.joints = more["points"], more["joints"]
    g.links = [*range(1, 1 + max(map(int, transforms.link_names(scene))))]
    i, j = g.two_links()
    if slots:
        a = g.link()
        for other in (i, j, i):
            at, mu = g.point(), round(rng.uniform(0.1, 0.9), 2)
            g.joints.append({"slot": [other, a], "at": at, "mu": mu} | g.guide(at))
        return more
    here, (a, b), lean = spot(rng), (g.link(), g.link()), rng.uniform(0, 360)
    places = [polar(here, 2.0, lean), here, polar(here, 3.0, lean + 90.0)]
    for pair, at in zip(([i, a], [a, b], [b, j]), places, strict=True):
        g.joints.append({"pin": pair, "at": g.point(at), "mu": 0.5, "radius": 0.03})
    return more


def test_links_that_bear_no_load_leave_a_range_as_it_is() -> None:
    """On pins far too thin to lock: and as proven as it is without them."""
    compared = 0
    for seed in range(few(60)):
        rng = Random(f"idle {seed}")
        scene = rubbing.roughened(rng, random_mechanism(rng), 2)
        status, ends, locks, proven = told_of(scene)
        if len(ends) > 1:
            found = told_of(with_idle_links(rng, scene, slots=False))
            assert (found[0], found[2], found[3]) == (status, locks, proven), seed
            assert found[1] == pytest.approx(ends, rel=1e-9), seed
            compared += 1
    assert compared >= few(30)


NUDGES = 8


@pytest.mark.parametrize("part", range(24) if FULL else [4])
def test_an_idle_link_locks_where_a_little_load_on_it_would(part: int) -> None:
    """Several forces vanish at once where a mechanism with a link in rough slots is about to move: it holds
    on past the end that it has without this link if it does under some load of next to nothing on the link
    (of more than one, as doubles lose an end now and then)."""
    for seed in range(4 * part, 4 * part + 4):
        rng = Random(f"wedge {seed}")
        scene = rubbing.roughened(rng, random_mechanism(rng), 1)
        _, ends, *_ = told_of(scene)
        if len(ends) < 2 or ends[0] == ends[1] or any("contact" in joint for joint in scene["joints"]):
            continue
        more, told = with_idle_links(rng, scene, slots=True), list[list[float]]()
        idle = more["joints"][-1]["slot"][1]
        for load in (0.0, *[1e-5] * NUDGES):
            nudge = {"force": load, "link": idle, "at": spot(rng), "angle": round(rng.uniform(0, 360), 2)}
            told.append(told_of(more | {"loads": more["loads"] | {"E": nudge}})[1])
        room = 1e-3 * (ends[1] - ends[0] if math.isfinite(ends[1] - ends[0]) else max(map(abs, ends)))
        for side in (0, 1):
            if math.isfinite(ends[side]):
                near = [len(one) > 1 and abs(one[side] - ends[side]) <= room for one in told]
                assert near[0] is (sum(near[1:]) >= NUDGES - 1), (seed, side, near)


def rewritten(rng: Random, scene: transcribe.Scene) -> Iterator[tuple[transcribe.Scene, transforms.Effect]]:
    """One scene as it might have been written too."""
    yield transforms.rigid_motion(scene, rng.uniform(-180, 180), spot(rng))
    yield transforms.mirror(scene)
    names = transforms.link_names(scene)
    yield transforms.relabelled(scene, dict(zip(names, rng.sample(range(50, 99), len(names)), strict=True)))
    yield transforms.on_another_frame(scene, rng.choice([name for name in names if name != "1"]))
    if not any(len(joint.get("pin", ())) > 2 and "mu" in joint for joint in scene["joints"]):
        order = rng.sample(range(len(scene["joints"])), len(scene["joints"]))
        yield transforms.reordered(scene, order)


WRITTEN = [59, 61, 85, 10051, 10622, 10675]
"""Of a thousand, some that were told differently."""


@sampled(3)
@pytest.mark.parametrize("seed", [*WRITTEN, *range(100, 300 if FULL else 106)])
def test_a_range_is_the_same_however_its_scene_is_written(seed: int) -> None:
    """Turned, mirrored, by other names, on another frame, in another order: ends to 1e-7 of their size."""
    rng = Random(seed)
    scene = transforms.heavy_to_forces(rubbing.roughened(rng, random_mechanism(rng), 3))
    kind = next(iter(scene["loads"]["U"]))
    for other, effect in rewritten(rng, scene):
        factor = effect.factor.get(kind, 1.0)
        status, ends, locks, proven = told_of(scene, factor)
        again = told_of(other)
        assert (again[0], again[2], again[3]) == (status, locks, proven)
        assert again[1] == pytest.approx(ends, rel=1e-7, abs=1e-12)
