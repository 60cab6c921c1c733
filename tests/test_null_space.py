"""Answers, all centres, rates and velocities are those of the joints' null space in 60 digits.

Over every kind of mechanism, random ones, the chains at which Kennedy's construction stalls, and two
freedoms. `ICSOLVE_FULL=1` draws twenty times as many.
"""

from __future__ import annotations

import math
from random import Random

import pytest

import icsolve
import mechanisms
import reference
import transcribe
import transforms
import witness
from chains import STALLED_TEN_BARS
from growth import random_mechanism
from loading import drawn
from reference import MANY
from sizes import FULL, few, sampled
from solving import (
    LAW,
    MORE,
    SINE,
    check_answers,
    check_rates,
    random_scenes,
    solved,
    told,
    unknown,
    worst_sine,
)
from transcribe import Scene


@sampled(3)
@pytest.mark.parametrize("generator", mechanisms.ALL, ids=lambda g: g.__name__)
def test_the_joints_null_space_agrees_on_every_kind(generator: mechanisms.Generator) -> None:
    for seed in range(100, 160 if FULL else 102):
        scene = drawn(seed, generator)
        found = reference.motions(transcribe.case(scene), digits=MANY)
        check_answers(scene, found)
        assert worst_sine(scene, found) <= SINE, told(scene)
        check_rates(scene)


@pytest.mark.parametrize("block", range(8 if FULL else 1))
def test_the_joints_null_space_agrees_on_random_mechanisms(block: int) -> None:
    for scene in random_scenes(1000 * block, few(15)):
        found = reference.motions(transcribe.case(scene), digits=MANY)
        if witness.hangs_on_last_digits(found):
            continue
        check_answers(scene, found)
        assert worst_sine(scene, found) <= 10 * SINE, told(scene)
        check_rates(scene)


@pytest.mark.parametrize("block", range(3 if FULL else 1))
def test_two_freedoms_want_two_unknowns(block: int) -> None:
    """Both are balanced for every motion; what the second freedom leaves open is said to be so."""
    for seed in range(1000 * block, 1000 * block + few(6) * MORE):
        scene = random_mechanism(Random(seed), 2)
        found = reference.motions(transcribe.case(scene), digits=MANY)
        if witness.hangs_on_last_digits(found):
            continue
        check_answers(scene, found)
        assert worst_sine(scene, found) <= 10 * SINE, told(scene)
        check_rates(scene)


def test_an_unknown_with_nothing_to_balance_is_zero() -> None:
    """A five-bar whose cranks 2 and 5 are free of each other: what acts on 2 asks nothing of 5."""
    for seed in range(20 * MORE):
        rng = Random(seed)
        loads = {
            "P": {"force": 30, "link": 2, "at": "B", "angle": mechanisms.heading(rng)},
            "U": {"torque": "unknown", "link": 2},
            "V": {"force": "unknown", "link": 5, "at": "D", "angle": mechanisms.heading(rng)},
        }
        scene = mechanisms.five_bar(rng) | {"loads": loads}
        found = reference.motions(transcribe.case(scene), digits=MANY)
        if len(found.basis) == 2 and witness.firmness(found) > 1e-2:
            answers = solved(scene).answers
            assert answers["U"].value == pytest.approx(witness.answers(found)["U"], rel=LAW), told(scene)
            assert answers["V"].value == pytest.approx(0, abs=1e-12), told(scene)


def test_a_passive_freedom_does_not_stop_the_answer() -> None:
    """A link that hangs free and bears no load; nor may a load on it pass in silence."""
    for seed in range(few(20) * MORE):
        rng = Random(seed)
        scene = random_mechanism(rng)
        hung = scene | {"points": scene["points"] | {"Z": mechanisms.spot(rng)}}
        hung["joints"] = [
            *scene["joints"],
            {"pin": [rng.choice(transforms.link_names(scene)), 99], "at": "Z"},
        ]
        found = reference.motions(transcribe.case(hung), digits=MANY)
        assert unknown(hung) == pytest.approx(witness.answers(found)["U"], rel=LAW), told(hung)
        check_rates(hung)
        loaded = hung | {"loads": hung["loads"] | {"Z": {"torque": 1, "link": 99}}}
        with pytest.raises(icsolve.SceneError) as refused:
            solved(loaded)
        assert refused.value.status == "mobility", told(loaded)


@sampled(2)
@pytest.mark.parametrize("generator", [mechanisms.butterfly, mechanisms.flier], ids=lambda g: g.__name__)
def test_all_28_centres_of_the_eight_bars_at_which_kennedy_stalls(generator: mechanisms.Generator) -> None:
    for seed in range(10 * MORE):
        scene = drawn(seed, generator)
        assert len(solved(scene, all_centres=True).centres) == 28
        assert worst_sine(scene, reference.motions(transcribe.case(scene), digits=MANY)) <= SINE, told(scene)


@pytest.mark.parametrize("block", range(4 if FULL else 1))
def test_all_45_centres_of_each_ten_bar_at_which_kennedy_stalls(block: int) -> None:
    """The 58 of the 230 chains of ten links."""
    for edges in STALLED_TEN_BARS[block :: 4 if FULL else 12]:

        def ten_bar(rng: Random, edges: str = edges) -> Scene:
            return mechanisms.pinned(rng, edges)

        for seed in range(MORE):
            scene = drawn(seed, ten_bar)
            assert len(solved(scene, all_centres=True).centres) == 45
            assert worst_sine(scene, reference.motions(transcribe.case(scene), digits=MANY)) <= SINE, told(
                scene
            )


def test_ten_four_bars_in_series() -> None:
    """22 links, 231 centres."""
    scene = drawn(0, mechanisms.ten_loops)
    found = reference.motions(transcribe.case(scene), digits=MANY)
    check_answers(scene, found)
    assert worst_sine(scene, found) <= SINE, told(scene)


def test_two_unknowns_of_a_planetary_are_balanced_for_every_motion() -> None:
    for seed in range(5 * MORE):
        rng = Random(seed)
        torque = {"torque": round(rng.uniform(-50, 50), 2)}
        loads = {
            "S": torque | {"link": 3},
            "R": {"torque": "unknown", "link": 5},
            "A": {"torque": "unknown", "link": 2},
        }
        scene = mechanisms.planetary(rng) | {"loads": loads}
        check_answers(scene, reference.motions(transcribe.case(scene), digits=MANY))


def test_given_speeds() -> None:
    """A link's speed in either sense; a point's along its own direction."""
    for seed in range(8 * MORE):
        rng, scene = Random(seed), drawn(seed, mechanisms.four_bar)
        sense = {"turns": "cw"} if seed % 2 else {}
        link = rng.choice([2, 3, 4])
        check_rates(scene | {"motion": {"link": link, "speed": round(rng.uniform(1, 30), 2)} | sense})
        check_rates(scene | {"motion": {"link": link, "turns": rng.choice(["cw", "ccw"])}})
        velocity = witness.speeds(transcribe.case(scene), digits=MANY).velocity("C", "4")
        assert velocity is not None
        angle = math.degrees(math.atan2(velocity[1], velocity[0])) + rng.choice([0, 180])
        check_rates(scene | {"motion": {"point": "C", "link": 4, "speed": 2.5, "angle": angle}})


def parallelograms(dice: Random, cranks: int, lean: float, stories: int) -> str:
    """Cranks of one length between equal bases, one such mechanism on another, the lowest turned by ``lean``
    from the base; the uppermost base is loaded, the first crank holds it."""
    along = complex(*dice.choice([(0.6, 0.8), (1.0, 0.0), (-0.28, 0.96), (0.0, 1.0)]))
    feet = [round(dice.uniform(1.2, 2.0), 1) * n for n in range(cranks)]
    at, joints, base, link = {f"P0{n}": along * x for n, x in enumerate(feet)}, [], 1, 2
    for story in range(stories):
        turn = complex(1.0, 0.0) if not (lean or story) else complex(0.6, 0.8)
        upper = link + cranks
        for n in range(cranks):
            at[f"P{story + 1}{n}"] = at[f"P{story}{n}"] + along * turn
            joints += [f"{{pin: [{base}, {link + n}], at: P{story}{n}}}"]
            joints += [f"{{pin: [{link + n}, {upper}], at: P{story + 1}{n}}}"]
        base, link = upper, upper + 1
    points = ", ".join(f"{name}: [{z.real:.6g}, {z.imag:.6g}]" for name, z in at.items())
    return (
        f"icsolve: 1\npoints: {{{points}}}\njoints: [{', '.join(joints)}]\nloads:\n"
        f"  T: {{torque: unknown, link: 2}}\n  P: {{force: 5, link: {base}, at: P{stories}1, angle: 33}}\n"
    )


@pytest.mark.parametrize("seed", range(few(24)))
@pytest.mark.parametrize("cranks", [2, 3, 4])
def test_a_freedom_that_is_not_kept_is_one_of_a_change_point(cranks: int, seed: int) -> None:
    """Flat cranks have two freedoms to first order, of which one goes on, however many cranks there are:
    counting, which tells it of two, says nothing of redundant ones. Two stories have two that they keep."""
    dice = Random(f"kept {cranks} {seed}")
    status = {}
    for lean, stories in ((0.0, 1), (1.0, 1), (1.0, 2)):
        try:
            status[lean, stories] = icsolve.solve(
                icsolve.load(parallelograms(dice, cranks, lean, stories))
            ).status
        except icsolve.SceneError as refusal:
            status[lean, stories] = refusal.status
    assert status == {(0.0, 1): "change-point", (1.0, 1): "ok", (1.0, 2): "mobility"}
