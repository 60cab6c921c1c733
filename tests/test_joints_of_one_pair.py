"""Two joints of one pair of links keep their own numbers, and rows that are all rounding bind nothing."""

from __future__ import annotations

from pathlib import Path

import pytest

import icsolve
from icsolve.explain import explain
from icsolve.grade.one import Task
from icsolve.report.check import compare
from library import FILES, sample

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


CORNER = """icsolve: 1
points: {A: [0, 0], B: [1, 0], G: [0.5, 0.5]}
joints:
  - {contact: [1, 2], at: A, normal: 90}
  - {contact: [1, 2], at: A, normal: 0}
  - {contact: [1, 2], at: B, normal: 90}
loads: {W: {weight: 100, link: 2, at: G}, F: {force: [-30, 0], link: 2, at: G}}
"""


def test_each_of_several_joints_has_its_own_reaction() -> None:
    """Three belts between two pulleys: the third took the name, and the place, of the second."""
    text = WHEELS.replace("{gears: [2, 3], teeth: [20, 40]}", "{belt: [2, 3], radii: [3, 5]}")
    belts = "".join(f"\n  - {{belt: [2, 3], radii: [{r}, {5 * r / 3!r}]}}" for r in (1.5, 0.6))
    case = icsolve.load(text.replace("\n  - {gears: [2, 3], teeth: [30, 30]}", belts))
    reactions = icsolve.solve(case, reactions=True).reactions
    assert reactions is not None and len(reactions) == len(case.joints) == 5


LOCKED = """icsolve: 1
points: {A: [0, 0], B: [5, 0], P: [2, 0.5]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {gears: [2, 3], teeth: [30, 20], pressure angle: 20}
  - {contact: [2, 3], at: P, normal: 90}
loads: {M: {torque: 10, link: 2}}
"""
NAMED = {"a corner": CORNER, "teeth and a contact": LOCKED}


@pytest.mark.parametrize("name", [*NAMED, *sample(FILES, 8, "names of reactions")])
def test_a_reaction_is_compared_and_asked_by_the_name_that_it_has(name: str, tmp_path: Path) -> None:
    text = NAMED.get(name) or FILES[name].read_text(encoding="utf-8")
    case = icsolve.load(text)
    answer = icsolve.solve(case, reactions=True)
    found = answer.reactions or (answer.spatial.reactions if answer.spatial is not None else {})
    loads = {load.name for load in case.loads}
    told = {
        own: one.magnitude for own, one in found.items() if one.magnitude is not None and own not in loads
    }
    plain = text.partition("expect:")[0].rstrip()
    file = tmp_path / "case.yaml"
    file.write_text(f"{plain}\nexpect:\n" + "".join(f"  '{own}': {size!r}\n" for own, size in told.items()))
    if not told:
        return
    rows = compare(icsolve.solve(icsolve.load(file), reactions=True))
    assert {row.key: row.verdict for row in rows} == dict.fromkeys(told, "agrees")
    if case.space is None:
        task = Task(file)
        assert {
            own: task.grade(own, f"{size:.6g}")["verdict"] for own, size in told.items()
        } == dict.fromkeys(told, "right")


def test_each_of_several_joints_at_a_point_has_its_own_symbol_in_a_worked_solution() -> None:
    """The push of the wall stood under the symbol of the floor's."""
    case = icsolve.load(CORNER)
    told = explain(case, bodies=True)
    assert "F12@A contact 2,x + F_x = 30 + (-30) = 0" in told
    assert "F12@A,y + F12@B,y + W_y = 65 + 35 + (-100) = 0" in told
