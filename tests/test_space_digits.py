"""Every number of a case in space, within a unit in the last place of a dense system in sixty digits."""

from __future__ import annotations

import math
from random import Random

import pytest
from mpmath import lu_solve, matrix, mp, mpf

from icsolve import load, solve
from sizes import MORE
from space_statics import system
from test_space_random import text_of, tree


def held(value: float, error: float | None, true: mpf, size: float) -> None:
    """Within an ulp, and within the stated error, two of them at most; zero is off by next to none."""
    assert error is not None
    off, ulp = abs(mpf(value) - true), math.ulp(value)
    assert off <= error + mpf(10) ** -50 * size, (value, true)
    assert error <= 2.0 * ulp or (value == 0.0 and error <= 1e-35 * size), (value, error)
    assert value == 0.0 or off <= ulp, (value, true)


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
