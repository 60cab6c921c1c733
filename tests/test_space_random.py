"""Random bodies in space against a dense system written apart, and laws that every answer keeps.

Tolerance 1e-9 of the largest component: the figures are of size 1 to 10 and well away from singular ones.
"""

from __future__ import annotations

import random

import numpy as np
import pytest

from icsolve import Answer, Case, load, solve
from icsolve.answer.bodies import SpatialReaction
from sizes import FULL, sampled
from space_statics import load_wrench, place
from space_statics import solve as solve_apart

SEEDS = range(60 if FULL else 8)
Dice = random.Random


def text_of(points: dict[str, tuple[float, ...]], joints: list[str], loads: list[str]) -> str:
    """A case of these parts."""
    lines = ["icsolve: 1", "units: {length: m, force: N}", "points:"]
    lines += [f"  {name}: [{', '.join(map(str, p))}]" for name, p in points.items()]
    lines += ["joints:", *(f"  - {{{joint}}}" for joint in joints)]
    lines += ["loads:", *(f"  L{n}: {{{entry}}}" for n, entry in enumerate(loads))]
    return "\n".join(lines) + "\n"


def vector(dice: Dice) -> str:
    """Components of a direction or a load."""
    return f"[{', '.join(str(dice.randint(-9, 9) or 1) for _ in range(3))}]"


def tree(dice: Dice) -> tuple[dict[str, tuple[float, ...]], list[str], list[str]]:
    """Bodies each on one before it, by joints of all kinds, with an unknown load for every freedom."""
    points: dict[str, tuple[float, ...]] = {}

    def point() -> str:
        name = f"P{len(points)}"
        points[name] = tuple(round(dice.uniform(-5.0, 5.0), 3) for _ in range(3))
        return name

    joints, loads = [], []
    for link in range(2, 3 + dice.randint(0, 4)):
        on, kind = dice.randint(1, link - 1), dice.choice(("weld", "hinge", "ball", "shaft"))
        free = []
        if kind == "shaft":
            a, b = point(), point()
            joints += [f"radial: [{on}, {link}], at: {a}, axis: [{a}, {b}]"]
            joints += [f"thrust: [{on}, {link}], at: {b}, axis: [{a}, {b}]"]
            free = [f"[{a}, {b}]"]
        elif kind == "hinge":
            free = [vector(dice)]
            joints += [f"hinge: [{on}, {link}], at: {point()}, axis: {free[0]}"]
        else:
            free = ["x", "y", "z"] if kind == "ball" else []
            joints += [f"{kind}: [{on}, {link}], at: {point()}"]
        loads += [f"torque: unknown, link: {link}, along: {axis}, against: {on}" for axis in free]
        loads += [f"force: {vector(dice)}, link: {link}, at: {point()}"]
        loads += [f"torque: {dice.randint(1, 9)}, link: {link}, along: {vector(dice)}"]
    return points, joints, loads


def held(dice: Dice) -> str:
    """A tree without unknowns, every link tied to the frame besides: a structure with redundant joints."""
    points, joints, loads = tree(dice)
    links = sorted({entry.split("link: ")[1].split(",")[0] for entry in loads})
    loads = [entry for entry in loads if "unknown" not in entry]
    for link in links:
        for kind in dice.sample(("ball", "ball", "hinge", "thrust"), 2):
            name = f"P{len(points)}"
            points[name] = tuple(round(dice.uniform(-5.0, 5.0), 3) for _ in range(3))
            axis = "" if kind == "ball" else f", axis: {vector(dice)}"
            joints.append(f"{kind}: [1, {link}], at: {name}{axis}")
    return text_of(points, joints, loads)


def components(reaction: SpatialReaction) -> list[float | None]:
    return [*reaction.force, *reaction.couple]


def of_joint(answer: Answer, case: Case, n: int) -> list[float | None]:
    """The reaction of the n-th joint, on its second link."""
    assert answer.spatial is not None
    assert case.space is not None
    reaction = list(answer.spatial.reactions.values())[n]
    by, on = case.space.joints[n].links
    assert {reaction.by, reaction.on} == {by, on}
    return components(reaction if reaction.on == on else reaction.reversed())


def agrees(case: Case, answer: Answer) -> int:
    """Compare every component that the other system determines; returns how many are open in both."""
    apart = solve_apart(case)
    assert apart.rest < 1e-9
    scale = max(1.0, *(float(np.max(np.abs(joint))) for joint in apart.joints))
    left_open = 0
    for n, (values, known) in enumerate(zip(apart.joints, apart.determined, strict=True)):
        found = of_joint(answer, case, n)
        for value, is_known, mine in zip(values, known, found, strict=True):
            assert (mine is not None) == is_known, (n, found, known)
            assert mine is None or mine == pytest.approx(value, rel=0, abs=1e-9 * scale)
            left_open += mine is None
    for name, value in apart.loads.items():
        assert answer.answers[name].value == pytest.approx(value, rel=0, abs=1e-9 * scale)
    return left_open


@sampled(2)
@pytest.mark.parametrize("seed", SEEDS)
def test_trees_of_bodies_against_a_dense_system(seed: int) -> None:
    case = load(text_of(*tree(Dice(seed))))
    answer = solve(case)
    assert agrees(case, answer) == 0
    assert answer.mobility == len(answer.answers)


def test_redundant_structures_against_a_dense_system() -> None:
    """What is open in one is open in the other, and what is determined agrees."""
    left_open = 0
    some = range(60 if FULL else 4)
    for seed in some:
        case = load(held(Dice(seed)))
        answer = solve(case)
        assert answer.mobility == 0
        count = agrees(case, answer)
        assert (count > 0) == any("not determined" in note for note in answer.notes)
        left_open += count
    assert left_open > len(some)


@pytest.mark.parametrize("seed", SEEDS)
def test_power_and_free_bodies_agree_within_their_bound(seed: int) -> None:
    answer = solve(load(text_of(*tree(Dice(seed)))))
    assert answer.spatial is not None
    assert answer.spatial.residual < 1e-13
    for witness in answer.spatial.witnesses:
        assert abs(witness.difference) <= max(witness.bound, 1e-9 * abs(witness.power))
        assert abs(witness.difference) <= 1e-11 * max(1.0, abs(witness.power))


@pytest.mark.parametrize("seed", SEEDS[:20])
def test_every_body_is_in_equilibrium(seed: int) -> None:
    """The reactions as shown, with the loads, add up to nothing on every link."""
    case = load(text_of(*tree(Dice(seed))))
    answer = solve(case)
    assert case.space is not None
    totals = {link: np.zeros(6) for link in case.links}
    for n, joint in enumerate(case.space.joints):
        values = np.array(of_joint(answer, case, n), dtype=float)
        at = place(case, joint.at)
        whole = np.concatenate([values[:3], values[3:] + np.cross(at, values[:3])])
        totals[joint.links[1]] += whole
        totals[joint.links[0]] -= whole
    for entry in case.space.loads:
        size = answer.answers[entry.name].value if entry.name in answer.answers else 1.0
        totals[entry.link] += size * load_wrench(case, entry)
        totals[getattr(entry, "against", None) or "1"] -= size * load_wrench(case, entry)
    largest = max(float(np.max(np.abs(total))) for total in totals.values())
    assert largest < 1e-9


@sampled(2)
@pytest.mark.parametrize("seed", SEEDS[:20])
def test_turning_the_axes_turns_the_reactions(seed: int) -> None:
    """x to y to z to x: every reaction turns along, and no unknown changes."""
    points, joints, loads = tree(Dice(seed))
    turned = {name: (p[2], p[0], p[1]) for name, p in points.items()}
    first = solve(load(text_of(points, joints, loads)))
    second = solve(load(text_of(turned, *(list(map(cycled, part)) for part in (joints, loads)))))
    assert first.spatial is not None
    assert second.spatial is not None
    for name, found in first.answers.items():
        assert second.answers[name].value == pytest.approx(found.value, rel=1e-9, abs=1e-9)
    for mine, other in zip(first.spatial.reactions.values(), second.spatial.reactions.values(), strict=True):
        x, y, z = other.force
        assert (y, z, x) == pytest.approx(mine.force, rel=1e-9, abs=1e-8)


def cycled(entry: str) -> str:
    """A joint or load with its axes and components turned x to y to z."""
    parts = entry.split("along: ") if "along: " in entry else entry.split("axis: ")
    key = "along: " if "along: " in entry else "axis: "
    out = [cycled_list(part) if "[" in part else part for part in parts]
    for index, part in enumerate(out):
        if index and part[0] in "xyz":
            out[index] = {"x": "y", "y": "z", "z": "x"}[part[0]] + part[1:]
    return key.join(out)


def cycled_list(text: str) -> str:
    """The list of three numbers of a text, turned; lists of names stay."""
    head, _, rest = text.partition("[")
    inside, _, tail = rest.partition("]")
    items = inside.split(", ")
    if len(items) == 3:
        items = [items[2], items[0], items[1]]
    return f"{head}[{', '.join(items)}]{tail}"


@pytest.mark.parametrize(("length", "force"), [(1e-6, 1.0), (1e6, 1.0), (1.0, 1e-8), (1.0, 1e8)])
def test_scales_of_length_and_force(length: float, force: float) -> None:
    """Unknown torques scale as force times length (rounding of the decimals: 1e-9)."""
    points, joints, loads = tree(Dice(7))
    loads = [entry for entry in loads if not entry.startswith("torque") or "unknown" in entry]
    first = solve(load(text_of(points, joints, loads)))
    scaled = {name: tuple(length * c for c in p) for name, p in points.items()}
    stronger = [forced(entry, force) for entry in loads]
    second = solve(load(text_of(scaled, joints, stronger)))
    for name, found in first.answers.items():
        assert second.answers[name].value == pytest.approx(length * force * found.value, rel=1e-9)


def forced(entry: str, factor: float) -> str:
    if not entry.startswith("force: ["):
        return entry
    inside, _, tail = entry.removeprefix("force: [").partition("]")
    return f"force: [{', '.join(str(factor * float(c)) for c in inside.split(', '))}]{tail}"


def test_a_figure_far_from_the_origin_loses_nothing() -> None:
    points, joints, loads = tree(Dice(3))
    exact = {name: tuple(round(c * 8) / 8 for c in p) for name, p in points.items()}
    far = {name: tuple(c + 1048576.0 for c in p) for name, p in exact.items()}
    first, second = (solve(load(text_of(ps, joints, loads))) for ps in (exact, far))
    for name, found in first.answers.items():
        assert second.answers[name].value == pytest.approx(found.value, rel=1e-12, abs=1e-12)
