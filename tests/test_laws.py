"""Laws that every answer keeps, over random mechanisms of all kinds.

A rigid motion, a change of scale, other names, another order, another frame link and a mirror leave the
answer as they should; the unknown may change roles and links. `ICSOLVE_FULL=1` draws twenty times as many.
"""

from __future__ import annotations

import json
import math
from random import Random
from typing import Any

import pytest

import icsolve
import mechanisms
import reference
import transcribe
import transforms
import witness
from growth import random_mechanism
from icsolve.answer import Centre
from icsolve.case import Force, Number
from icsolve.errors import SceneError
from icsolve.sweep.varied_numbers import with_numbers
from library import FILES, sample
from sizes import MORE, sampled
from solving import LAW, kinds, random_scenes, solved, told, unknown, whole
from transcribe import Scene

# --- changes that leave the mechanics alone --------------------------------------------------------


def compare(before: Scene, after: tuple[Scene, transforms.Effect]) -> None:
    """Answers and centres of a changed scene are the changed answers and centres."""
    scene, effect = after
    both = told(before) + told(scene)
    old, new = solved(before, all_centres=True), solved(scene, all_centres=True)
    for name in old.answers.keys() & {"U", "V"}:
        factor = effect.factor.get(next(iter(before["loads"][name])), 1.0)
        assert new.answers[name].value == pytest.approx(factor * old.answers[name].value, rel=LAW), both
    case = transcribe.case(scene)
    frame = reference.frame_of(case, reference.points_of(case))
    others = {frozenset(pair): centre for pair, centre in new.centres.items()}
    for pair, centre in old.centres.items():
        other = others[frozenset(effect.link(n) for n in pair)]
        here, there = place_of(centre, effect), place_of(other, transforms.NO_EFFECT)
        assert (here is None) == (there is None), f"{centre} {other}" + both
        if here is not None and there is not None:
            sine = witness.sine(*(witness.homogeneous(frame, entry) for entry in (here, there)))
            assert sine <= 1e-10, f"{centre} {other}" + both


def place_of(centre: Centre, effect: transforms.Effect) -> dict[str, Any] | None:
    """Where a centre is after a change, as results print it; None where it has no place."""
    if centre.kind == "at":
        return {"at": effect.place(list(centre.place))}
    return {"toward": effect.direction(centre.place[0])} if centre.kind == "toward" else None


@pytest.fixture(params=range(4))
def scenes(request: pytest.FixtureRequest) -> list[Scene]:
    """Each kind, and as many random mechanisms, a quarter of them at a time."""
    everything = [*kinds(200), *random_scenes(20_000, 24)]
    return everything[request.param :: 4]


@sampled(4)
def test_a_rigid_motion_moves_centres_and_leaves_loads(scenes: list[Scene]) -> None:
    for k, scene in enumerate(scenes):
        rng = Random(k)
        degrees = rng.choice([90.0, 180.0, rng.uniform(-180, 180)])
        compare(scene, transforms.rigid_motion(scene, degrees, mechanisms.spot(rng, 30)))


@sampled(4)
def test_a_mirror_turns_torques_over(scenes: list[Scene]) -> None:
    for scene in scenes:
        compare(scene, transforms.mirror(scene))


@sampled(4)
def test_other_names_change_nothing_but_names(scenes: list[Scene]) -> None:
    for k, scene in enumerate(scenes):
        links = transforms.link_names(scene)
        words = [f"part{n}" for n in range(len(links))] if k % 2 else [str(n + 1) for n in range(len(links))]
        Random(k).shuffle(words)
        compare(scene, transforms.relabelled(scene, dict(zip(links, words, strict=True))))


@sampled(4)
def test_another_order_changes_nothing(scenes: list[Scene]) -> None:
    for k, scene in enumerate(scenes):
        order = list(range(len(scene["joints"])))
        Random(k).shuffle(order)
        compare(scene, transforms.reordered(scene, order))


@sampled(4)
def test_any_link_may_be_held_still(scenes: list[Scene]) -> None:
    """Loads between links, and all relative centres, know no frame."""
    for k, scene in enumerate(scenes):
        frame = Random(k).choice([n for n in transforms.link_names(scene) if n != "1"])
        compare(transforms.heavy_to_forces(scene), transforms.on_another_frame(scene, frame))


@sampled(3)
@pytest.mark.parametrize("seed", range(6 * MORE))
def test_changes_at_mobility_2(seed: int) -> None:
    """Both unknowns, and the centres that two freedoms leave determined."""
    rng = Random(seed)
    scene = random_mechanism(Random(50_000 + seed), 2)
    order = list(range(len(scene["joints"])))
    rng.shuffle(order)
    compare(scene, transforms.rigid_motion(scene, rng.uniform(-180, 180), mechanisms.spot(rng, 30)))
    compare(scene, transforms.mirror(scene))
    compare(scene, transforms.reordered(scene, order))
    scaled, effect = transforms.scaled(scene, rng.choice([-20, 5]))
    compare(scene, (scaled, effect))
    kinds_of_unknown = {name: next(iter(scene["loads"][name])) for name in "UV"}
    if "spring" not in kinds_of_unknown.values():  # a stiffness's column has another dimension: other pivots
        old, new = solved(scene).answers, solved(scaled).answers
        for name, kind in kinds_of_unknown.items():
            assert new[name].value == effect.factor.get(kind, 1.0) * old[name].value, told(scene)


@sampled(4)
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


@sampled(4)
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


@sampled(4)
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


@sampled(4)
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


# --- what stands for motion where none is given, and centres that no motion has ------------------------


@pytest.mark.parametrize("lean", [0.0, 30.0, 90.0, 150.0, 250.0])
def test_where_no_link_turns_the_first_that_moves_does_so_at_unit_speed_to_the_right(lean: float) -> None:
    """A block on an incline pushes another along the frame: at one length a second."""
    answer = icsolve.solve(
        icsolve.load(
            f"icsolve: 1\npoints: {{A: [0, 0], B: [5, 1]}}\nlinks: {{2: [A]}}\n"
            f"joints: [{{slide: [2, 1], at: A, along: {lean}}}, {{slide: [2, 3], at: B, along: 20}}, "
            "{slide: [3, 1], at: B, along: 80}]\n"
        ),
        rates=True,
    )
    assert answer.velocities is not None
    along = math.radians(lean) + (math.pi if 90.0 < lean < 270.0 else 0.0)
    assert answer.velocities["A", "2"] == pytest.approx((math.cos(along), math.sin(along)), abs=1e-15)


@pytest.mark.parametrize(("place", "miss"), [((3, 1), 1.6), ((9, 2), 5.8), ((-2, 2), 3)])
def test_a_centre_off_the_line_of_two_others_is_refused_with_its_distance(
    place: tuple[float, float], miss: float
) -> None:
    """From the line through (1, 1) and (4, 5); the figure's origin, the first joint, lies apart from both."""
    with pytest.raises(SceneError, match=f"centre 1-3 lies {miss} m") as refused:
        icsolve.solve(
            icsolve.load(
                f"icsolve: 1\npoints: {{A: [1, 1], B: [4, 5], C: {list(place)}, D: [7, -3]}}\n"
                "joints: [{weld: [1, 4], at: D}, {centre: [1, 3], at: C}, {pin: [1, 2], at: A}, "
                "{pin: [2, 3], at: B}]\n"
                "loads: {T: {torque: 1, link: 2}, U: {torque: unknown, link: 3}}\n"
            )
        )
    assert refused.value.status == "contradictory-centres"


def test_an_answer_owes_nothing_to_what_was_solved_before_it() -> None:
    """Arithmetics, plans and programs are remembered within a process: the library there and back, and loads
    of 1e-250 in each, which a trace of any other number would swamp."""
    names = sample(FILES, 8, "there and back")

    def told(name: str) -> str:
        case = icsolve.load(FILES[name])
        tiny = [load for load in case.loads if isinstance(load, Force) and isinstance(load.value, Number)]
        found = []
        for one in [case, *(with_numbers(case, {f"loads.{load.name}": 1e-250}) for load in tiny[:1])]:
            try:
                found.append(json.dumps(icsolve.solve(one, all_centres=True, rates=True).to_dict()))
            except icsolve.SceneError as refusal:
                found.append(str(refusal))
        return "\n".join(found)

    there = {name: told(name) for name in names}
    back = {name: told(name) for name in reversed(names)}
    assert there == back
