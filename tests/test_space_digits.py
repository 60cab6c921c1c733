"""Every number of a case in space, within a unit in the last place of a dense system in sixty digits."""

from __future__ import annotations

import math
from random import Random

import pytest
from mpmath import lu_solve, matrix, mp, mpf

from icsolve import load, solve
from sizes import MORE, sampled
from space_statics import system
from test_space_random import text_of, tree, vector


def held(value: float, error: float | None, true: mpf, size: float) -> None:
    """Within an ulp, and within the stated error, two of them at most; zero is off by next to none."""
    assert error is not None
    off, ulp = abs(mpf(value) - true), math.ulp(value)
    assert off <= error + mpf(10) ** -50 * size, (value, true)
    assert error <= 2.0 * ulp or (value == 0.0 and error <= 1e-35 * size), (value, error)
    assert value == 0.0 or off <= ulp, (value, true)


def tied(dice: Random) -> str:
    """A tree, and a body on a hinge that nothing loads, held by a rod from ball to ball on one of the tree's.
    What turns the rod about itself is an unknown torque, the first."""
    points, joints, loads = tree(dice)
    links = max(int(entry.split("link: ")[1].split(",")[0]) for entry in loads)
    points |= {p: tuple(round(dice.uniform(-5.0, 5.0), 3) for _ in range(3)) for p in ("H", "A", "B")}
    joints += [f"hinge: [1, {links + 1}], at: H, axis: {vector(dice)}"]
    joints += [
        f"ball: [{links + 2}, {links + 1}], at: A",
        f"ball: [{links + 2}, {dice.randint(2, links)}], at: B",
    ]
    return text_of(points, joints, [f"torque: unknown, link: {links + 2}, along: [A, B]", *loads])


@sampled(3)
@pytest.mark.parametrize("seed", [5, 33, 34, *range(50, 50 + 10 * MORE)])
def test_a_rod_that_carries_nothing(seed: int) -> None:
    """Both routes know a torque of zero as zero: it is not refused for what digits leave of it."""
    found = solve(load(tied(Random(seed)))).answers["L0"]
    assert found.error is not None
    assert found.value == 0.0 and found.error < 1e-40


@pytest.mark.parametrize(("gap", "said"), [("0.001", False), ("1e-8", True), ("1e-11", True)])
def test_what_a_rod_carries_beside_the_axis_that_it_holds_is_answered_and_said(gap: str, said: bool) -> None:
    """A rod that passes a hinge's axis by next to nothing: its force is the couple over that arm."""
    answer = solve(
        load(f"""icsolve: 1
points: {{A: [0, 0, 0], B: [1, 0, 0], C: [3, {gap}, 0]}}
joints:
  - {{hinge: [1, 2], at: A, axis: z}}
  - {{ball: [2, 3], at: B}}
  - {{ball: [3, 1], at: C}}
loads: {{T: {{torque: 10, link: 2, along: z}}}}
""")
    )
    assert answer.spatial is not None
    force = answer.spatial.reactions["F23"].force
    with mp.workdps(60):
        assert force[0] is not None and abs(force[0]) == pytest.approx(float(20 / mpf(gap)), rel=1e-15)
    assert force[1] is not None and abs(force[1]) == pytest.approx(10.0, rel=1e-15)
    assert any("within a hair's breadth" in note for note in answer.notes) is said


def test_a_torque_of_zero_beside_huge_forces() -> None:
    """The rod's line passes the hinge's axis at 6e-13, and loads of 1e12 leave 1: nothing turns the rod."""
    answer = solve(
        load("""icsolve: 1
points: {A: [2, 0.5, 1], B: [6, 1.25, 4], C: [-1.999999999999370092, -0.75, -2], D: [2.1, -1.923, 7.3]}
joints:
  - {hinge: [1, 2], at: A, axis: y}
  - {ball: [3, 2], at: B}
  - {ball: [3, 1], at: C}
loads:
  R: {torque: unknown, link: 3, along: [B, C]}
  K: {torque: [41.786, -0.6, -27.2], link: 2}
  L: {force: 1000000000000, link: 2, at: D, along: -x}
  M: {force: -1000000000001, link: 2, at: D, along: -x}
""")
    )
    assert answer.answers["R"].value == 0.0


@sampled(3)
@pytest.mark.parametrize("seed", range(8 * MORE))
def test_trees_of_all_joints(seed: int) -> None:
    """Also where the third of the axes lies within 1e-3 to 1e-12 of the plane of the others' forces."""
    points, joints, loads = tree(Random(seed))
    if seed % 2:  # a point beside another: next to no arm
        first, *_ = points
        x, y, z = points[first]
        points["near"] = (x, y, float(f"{z + 10.0 ** -Random(seed).randint(3, 12):.13f}"))
        loads.append("force: [3, 4, 5], link: 2, at: near")
    case = load(text_of(points, joints, loads))
    mp.dps = 80
    a, b, count, names = system(case, lambda number: mpf(number.digits))
    x = lu_solve(matrix(a.tolist()), matrix(b.tolist()))
    answer = solve(case)
    assert answer.spatial is not None
    size = max(abs(float(v)) for v in x)
    for n, name in enumerate(names):
        found = answer.answers[name]
        held(found.value, found.error, x[6 * count + n], size)
    assert case.space is not None
    for n, joint in enumerate(case.space.joints):
        found = next(
            r
            for r in answer.spatial.reactions.values()
            if {r.by, r.on} == {*joint.links} and r.where == joint.at
        )
        assert found.errors is not None
        sign = 1 if found.on == joint.links[1] else -1
        both = zip((*found.force, *found.couple), (*found.errors[0], *found.errors[1]), strict=True)
        for k, (value, error) in enumerate(both):
            assert value is not None
            held(value, error, sign * x[6 * n + k], size)
