"""Laws that every answer keeps, over random mechanisms of all kinds.

The answer is that of the joints' null space in 60 digits; a rigid motion, a change of scale, other names,
another order, another frame link and a mirror leave it as they should. `ICSOLVE_FULL=1` draws twenty
times as many.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from itertools import combinations
from random import Random
from typing import Any

import pytest

import icsolve
import mechanisms
import reference
import transcribe
import transforms
import witness
from chains import STALLED_TEN_BARS
from figures import from_lengths, without_order
from growth import random_mechanism
from icsolve.answer import Answer
from loading import drawn
from reference import MANY, Motions
from transcribe import Scene

FULL = os.environ.get("ICSOLVE_FULL") == "1"
MORE = 20 if FULL else 1

LAW = 1e-9
"""What the format promises of answers, rates and velocities."""
SINE = 1e-12
"""Of the angle between homogeneous centres, where no centre is ill-conditioned."""


def solved(scene: Scene, **options: Any) -> Answer:
    """The solver's answer to a scene."""
    return icsolve.solve(icsolve.load(transcribe.text(scene)), **options)


def whole(scene: Scene) -> Answer:
    """With all centres, rates and velocities."""
    return solved(scene, all_centres=True, rates=True)


def unknown(scene: Scene) -> float:
    """The value of the unknown `U`."""
    return solved(scene).answers["U"].value


def random_scenes(first: int, number: int) -> Iterable[Scene]:
    """Random mechanisms of any kinds of joints, by seed."""
    return (random_mechanism(Random(seed)) for seed in range(first, first + number * MORE))


def kinds(seed: int) -> Iterable[Scene]:
    """Each named kind, drawn once (in full runs, twenty times)."""
    return (drawn(s, g) for g in mechanisms.ALL for s in range(seed, seed + MORE))


def told(scene: Scene) -> str:
    """The scene, to see it where a law fails."""
    return "\n" + transcribe.text(scene)


# --- the reference ---------------------------------------------------------------------------------


def check_answers(scene: Scene, found: Motions) -> None:
    """Unknown loads as virtual power over the null space has them."""
    answers = solved(scene).answers
    for name, value in witness.answers(found).items():
        assert answers[name].value == pytest.approx(value, rel=LAW), name + told(scene)


def worst_sine(scene: Scene, found: Motions) -> float:
    """Of all centres of a scene, checked by kind; the largest angle from the reference's."""
    centres = {tuple(sorted(pair)): c for pair, c in solved(scene, all_centres=True).centres.items()}
    worst = 0.0
    for pair in combinations(found.case.links, 2):
        mine, theirs = witness.centre(found, *pair), centres[tuple(sorted(pair))]
        if isinstance(mine, str):
            assert theirs.kind == mine, f"{pair}: {theirs}" + told(scene)
            continue
        assert theirs.kind in ("at", "toward"), f"{pair}: {theirs}" + told(scene)
        place = theirs.place if theirs.kind == "at" else theirs.place[0]
        shown = witness.homogeneous(found.frame, {theirs.kind: place}, MANY)
        worst = max(worst, witness.sine(mine, shown))
    return worst


def check_rates(scene: Scene) -> None:
    """Angular velocities, and the velocity of every point on the links that carry it."""
    answer, speeds = solved(scene, rates=True), witness.speeds(transcribe.case(scene), digits=MANY)
    assert answer.rates is not None
    assert answer.velocities is not None
    rates = {link: speeds.rate(link) for link in answer.case.links}
    velocities = {key: speeds.velocity(*key) for key in answer.velocities}
    size = speeds.found.frame.size
    fastest = max(
        [
            *(abs(w) for w in rates.values() if w is not None),
            *(math.hypot(*v) / size for v in velocities.values() if v is not None),
        ]
    )
    for link, rate in rates.items():
        assert known(answer.rates[link]) == near(rate, fastest), link + told(scene)
    for key, v in velocities.items():
        assert known(answer.velocities[key]) == near(v, fastest * size), str(key) + told(scene)
    assert carried(scene) <= set(answer.velocities)


def near(value: Any, scale: float) -> Any:
    """Within the law of a value; of zero, within the law of the scene's scale; None is None."""
    return None if value is None else pytest.approx(value, rel=LAW, abs=LAW * scale)


def known(value: Any) -> Any:
    """A rate or velocity; None where it is undetermined."""
    return None if isinstance(value, str) else value


def carried(scene: Scene) -> set[tuple[str, str]]:
    """Points and the moving links that carry them by a pin, or as first of a slide or slot."""
    frame = str(scene.get("ground", 1))
    pairs = {
        (joint["at"], str(link))
        for joint in scene["joints"]
        if {"pin", "slide", "slot"} & set(joint)
        for link in (joint["pin"] if "pin" in joint else next(iter(joint.values()))[:1])
    }
    return {(at, link) for at, link in pairs if link != frame}


@pytest.mark.parametrize("generator", mechanisms.ALL, ids=lambda g: g.__name__)
def test_the_joints_null_space_agrees_on_every_kind(generator: mechanisms.Generator) -> None:
    for seed in range(100, 100 + 3 * MORE):
        scene = drawn(seed, generator)
        found = reference.motions(transcribe.case(scene), digits=MANY)
        check_answers(scene, found)
        assert worst_sine(scene, found) <= SINE, told(scene)
        check_rates(scene)


@pytest.mark.parametrize("block", range(8))
def test_the_joints_null_space_agrees_on_random_mechanisms(block: int) -> None:
    for scene in random_scenes(1000 * block, 15):
        found = reference.motions(transcribe.case(scene), digits=MANY)
        check_answers(scene, found)
        assert worst_sine(scene, found) <= 10 * SINE, told(scene)
        check_rates(scene)


@pytest.mark.parametrize("block", range(3))
def test_two_freedoms_want_two_unknowns(block: int) -> None:
    """Both are balanced for every motion; what the second freedom leaves open is said to be so."""
    for seed in range(1000 * block, 1000 * block + 12 * MORE):
        scene = random_mechanism(Random(seed), 2)
        found = reference.motions(transcribe.case(scene), digits=MANY)
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
    for seed in range(20 * MORE):
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


@pytest.mark.parametrize("generator", [mechanisms.butterfly, mechanisms.flier], ids=lambda g: g.__name__)
def test_all_28_centres_of_the_eight_bars_at_which_kennedy_stalls(generator: mechanisms.Generator) -> None:
    for seed in range(10 * MORE):
        scene = drawn(seed, generator)
        assert len(solved(scene, all_centres=True).centres) == 28
        assert worst_sine(scene, reference.motions(transcribe.case(scene), digits=MANY)) <= SINE, told(scene)


@pytest.mark.parametrize("block", range(4))
def test_all_45_centres_of_each_ten_bar_at_which_kennedy_stalls(block: int) -> None:
    """The 58 of the 230 chains of ten links."""
    for edges in STALLED_TEN_BARS[block::4]:

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


# --- changes that leave the mechanics alone --------------------------------------------------------


def turned_over(angle: float) -> float:
    """A direction modulo 180."""
    return angle % 180.0


def compare(before: Scene, after: tuple[Scene, transforms.Effect], close: float = LAW) -> None:
    """Answers and centres of a changed scene are the changed answers and centres."""
    scene, effect = after
    old, new = solved(before, all_centres=True), solved(scene, all_centres=True)
    kind = next(iter(before["loads"]["U"]))
    expected = old.answers["U"].value * effect.factor.get(kind, 1.0)
    assert new.answers["U"].value == pytest.approx(expected, rel=close), told(before) + told(scene)
    frame = reference.frame_of(transcribe.case(scene), reference.points_of(transcribe.case(scene)))
    others = {tuple(sorted(pair)): centre for pair, centre in new.centres.items()}
    for pair, centre in old.centres.items():
        other = others[tuple(sorted(effect.link(n) for n in pair))]
        assert (other.kind in ("at", "toward")) == (centre.kind in ("at", "toward")), told(before) + told(
            scene
        )
        if centre.kind in ("at", "toward"):
            moved = (
                {"at": effect.place(list(centre.place))}
                if centre.kind == "at"
                else {"toward": effect.direction(centre.place[0])}
            )
            seen = {"at": list(other.place)} if other.kind == "at" else {"toward": other.place[0]}
            sine = witness.sine(witness.homogeneous(frame, moved), witness.homogeneous(frame, seen))
            assert sine <= 1e-10, f"{pair} {centre} {other}" + told(before) + told(scene)


@pytest.fixture(params=range(4))
def scenes(request: pytest.FixtureRequest) -> list[Scene]:
    """Each kind, and as many random mechanisms, a quarter of them at a time."""
    everything = [*kinds(200), *random_scenes(20_000, 24)]
    return everything[request.param :: 4]


def test_a_rigid_motion_moves_centres_and_leaves_loads(scenes: list[Scene]) -> None:
    for k, scene in enumerate(scenes):
        rng = Random(k)
        degrees = rng.choice([90.0, 180.0, rng.uniform(-180, 180)])
        compare(scene, transforms.rigid_motion(scene, degrees, mechanisms.spot(rng, 30)))


def test_a_mirror_turns_torques_over(scenes: list[Scene]) -> None:
    for scene in scenes:
        compare(scene, transforms.mirror(scene))


def test_other_names_change_nothing_but_names(scenes: list[Scene]) -> None:
    for k, scene in enumerate(scenes):
        links = transforms.link_names(scene)
        words = [f"part{n}" for n in range(len(links))] if k % 2 else [str(n + 1) for n in range(len(links))]
        Random(k).shuffle(words)
        compare(scene, transforms.relabelled(scene, dict(zip(links, words, strict=True))))


def test_another_order_changes_nothing(scenes: list[Scene]) -> None:
    for k, scene in enumerate(scenes):
        order = list(range(len(scene["joints"])))
        Random(k).shuffle(order)
        compare(scene, transforms.reordered(scene, order))


def test_any_link_may_be_held_still(scenes: list[Scene]) -> None:
    """Loads between links, and all relative centres, know no frame."""
    for k, scene in enumerate(scenes):
        frame = Random(k).choice([n for n in transforms.link_names(scene) if n != "1"])
        compare(transforms.heavy_to_forces(scene), transforms.on_another_frame(scene, frame))


def test_rates_of_another_frame_are_differences(scenes: list[Scene]) -> None:
    for k, scene in enumerate(scenes):
        frame = Random(k).choice([n for n in transforms.link_names(scene) if n != "1"])
        old, new = (
            solved(s, rates=True).rates for s in (scene, transforms.on_another_frame(scene, frame)[0])
        )
        assert old is not None
        assert new is not None
        before, after = ({n: float(w) for n, w in r.items()} for r in (old, new))
        relative = {n: w - before[frame] for n, w in before.items()}
        largest = max(relative, key=lambda n: abs(relative[n]))
        if abs(relative[largest]) > 1e-3:
            factor = after[largest] / relative[largest]
            assert after == pytest.approx(
                {n: factor * w for n, w in relative.items()}, rel=LAW, abs=LAW * abs(factor)
            )


# --- scale by powers of two, bit for bit -----------------------------------------------------------


def test_a_scale_of_a_power_of_two_changes_no_bit(scenes: list[Scene]) -> None:
    for k, scene in enumerate(scenes):
        power = Random(k).choice([-40, -10, -3, -1, 1, 2, 7, 33])
        scaled, effect = transforms.scaled(scene, power)
        old, new = whole(scene), whole(scaled)
        factor = effect.factor.get(next(iter(scene["loads"]["U"])), 1.0)
        assert new.answers["U"].value == factor * old.answers["U"].value, told(scene)
        assert new.centres.keys() == old.centres.keys()
        for pair, centre in old.centres.items():
            place = tuple(effect.place(list(centre.place))) if centre.kind == "at" else centre.place
            assert (new.centres[pair].kind, new.centres[pair].place) == (centre.kind, place), (
                f"{pair}" + told(scene)
            )
        assert new.rates == old.rates
        assert old.rates is not None
        speed = effect.speed if any(old.rates.values()) else 1.0
        assert new.velocities == times(old.velocities, speed)


def times(velocities: Any, factor: float) -> Any:
    """All velocities times a factor; words stay."""
    return {k: v if isinstance(v, str) else (factor * v[0], factor * v[1]) for k, v in velocities.items()}


# --- the unknown elsewhere -------------------------------------------------------------------------


def test_the_unknown_and_a_known_load_may_change_roles(scenes: list[Scene]) -> None:
    """With the value found put in, the known load is what the scene said."""
    for scene in scenes:
        found = unknown(scene)
        if found < 0 and {"mass", "spring"} & set(scene["loads"]["U"]):
            continue  # no such thing can be put in
        for name in [n for n in scene["loads"] if firm(scene, n)]:
            value = next(iter(scene["loads"][name].values()))
            value = float(value.removesuffix(" kg")) if isinstance(value, str) else value
            swapped = transforms.reversed_roles(scene, name, found)
            assert solved(swapped).answers[name].value == pytest.approx(value, rel=1e-8), told(swapped)


def firm(scene: Scene, name: str) -> bool:
    """A known load with one number, that does a fair part of the work."""
    load = scene["loads"][name]
    number = load[next(iter(load))]
    if name in ("U", "L") or isinstance(number, list | dict):
        return False
    swapped = transcribe.case(transforms.reversed_roles(scene, name, 1.0))
    return witness.firmness(reference.motions(swapped)) > 1e-2


def test_a_torque_elsewhere_does_the_same_work(scenes: list[Scene]) -> None:
    """T on link a and T' on link b balance the same loads where T wa = T' wb."""
    for k, scene in enumerate(scenes):
        if "L" in scene["loads"]:
            continue
        rates = {n: float(w) for n, w in (solved(scene, rates=True).rates or {}).items()}
        turning = [n for n, w in rates.items() if abs(w) > 0.05 * max(map(abs, rates.values()))]
        if len(turning) > 1:
            a, b = Random(k).sample(turning, 2)
            one, other = (unknown(transforms.moved_to(scene, n)) for n in (a, b))
            assert one * rates[a] == pytest.approx(other * rates[b], rel=LAW), told(scene)


# --- figures by lengths and angles -----------------------------------------------------------------

DYADIC = [
    mechanisms.four_bar,
    mechanisms.watt,
    mechanisms.stephenson,
    mechanisms.three_loops,
    mechanisms.triple_pin,
    mechanisms.welded,
    mechanisms.slider_crank,
]


def check_figure(scene: Scene, measured: Scene, close: float) -> None:
    """Points where they were measured, and the answer of the scene by coordinates."""
    answer = solved(measured)
    assert set(answer.points) <= set(scene["points"]) | {p for p in answer.points if p.startswith("@")}
    for name, xy in answer.points.items():
        if name in scene["points"]:
            assert xy == pytest.approx(scene["points"][name], abs=close), name + told(measured)
    found = reference.motions(transcribe.case(scene), digits=MANY)
    assert answer.answers["U"].value == pytest.approx(witness.answers(found)["U"], rel=LAW), told(measured)


@pytest.mark.parametrize("generator", DYADIC, ids=lambda g: g.__name__)
def test_lengths_and_angles_give_back_the_figure(generator: mechanisms.Generator) -> None:
    done = 0
    for seed in range(12 * MORE):
        scene = drawn(300 + seed, generator)
        measured = from_lengths(scene, Random(seed))
        if measured is not None:
            done += 1
            check_figure(scene, measured, 1e-11)
    assert done > 1


def test_the_double_butterfly_by_its_side_lengths() -> None:
    """No order of construction: the group is solved as a whole, from `near`."""
    done = 0
    for seed in range(8 * MORE):
        scene = drawn(400 + seed, mechanisms.butterfly)
        measured = without_order(scene, Random(seed))
        if measured is not None:
            done += 1
            check_figure(scene, measured, 1e-10)
    assert done > 1
