"""Two joints of one pair of links keep their own numbers, and rows that are all rounding bind nothing."""

from __future__ import annotations

import pytest

import icsolve

WHEELS = """icsolve: 1
points: {A: [0, 0], B: [5, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {gears: [2, 3], teeth: [20, 40]}
  - {gears: [2, 3], teeth: [30, 30]}
loads: {M: {torque: 10, link: 2}, T: {torque: unknown, link: 3}}
"""
WHEEL = """icsolve: 1
points: {A: [3, -2], K: [-1, 2], P: [0, 1]}
joints: [{pin: [1, 2], at: A}, {contact: [1, 2], at: K, normal: -45}]
loads: {W: {force: 10, link: 2, at: P, angle: 0}, T: {torque: unknown, link: 2}}
"""


def test_two_meshes_of_unlike_ratio_lock_each_other() -> None:
    with pytest.raises(icsolve.SceneError) as caught:
        icsolve.solve(icsolve.load(WHEELS))
    assert caught.value.status == "structure"
    alike = icsolve.solve(icsolve.load(WHEELS.replace("[30, 30]", "[10, 20]")))
    assert alike.answers["T"].value == pytest.approx(20.0)


def test_contact_whose_normal_passes_the_pivot_lets_the_wheel_turn() -> None:
    assert icsolve.solve(icsolve.load(WHEEL)).answers["T"].value == pytest.approx(30.0)


def test_each_of_several_joints_has_its_own_reaction() -> None:
    """Three belts between two pulleys: the third took the name, and the place, of the second."""
    text = WHEELS.replace("{gears: [2, 3], teeth: [20, 40]}", "{belt: [2, 3], radii: [3, 5]}")
    belts = "".join(f"\n  - {{belt: [2, 3], radii: [{r}, {5 * r / 3!r}]}}" for r in (1.5, 0.6))
    case = icsolve.load(text.replace("\n  - {gears: [2, 3], teeth: [30, 30]}", belts))
    reactions = icsolve.solve(case, reactions=True).reactions
    assert reactions is not None and len(reactions) == len(case.joints) == 5
