"""The plan holds only the steps that the wanted answer needs: its steps are counted, never timed."""

from __future__ import annotations

from itertools import pairwise
from random import Random
from typing import Any

import pytest

import icsolve
import mechanisms
import transcribe
from chains import BUTTERFLY, FLIER
from icsolve.errors import SceneError
from icsolve.structure import Topology, topology
from icsolve.structure.plan import Matching, Plan, make_plan


def chain_of_four_bars(loops: int) -> Topology:
    """Cranks 2, 4, 6 ... on the frame, couplers 3, 5, 7 ... between them."""
    cranks = [str(2 * k + 2) for k in range(loops + 1)]
    joints = [{"pin": ["1", crank], "at": f"O{crank}"} for crank in cranks]
    for left, right in pairwise(cranks):
        coupler = str(int(left) + 1)
        joints.append({"pin": [left, coupler], "at": f"P{left}"})
        joints.append({"pin": [coupler, right], "at": f"Q{right}"})
    points = {joint["at"]: [k, k % 3] for k, joint in enumerate(joints)}
    return topology(transcribe.case({"points": points, "joints": joints, "loads": {}}))


def plan_for(top: Topology, *links: str) -> Plan:
    plan = make_plan(top, frozenset(top.body_of[link] for link in links))
    assert plan is not None
    return plan


@pytest.mark.parametrize(("first", "last", "dyads"), [(2, 4, 1), (2, 22, 10), (8, 14, 3), (20, 22, 1)])
def test_a_load_only_plan_on_ten_four_bars_grows_with_the_links_between_the_loads(
    first: int, last: int, dyads: int
) -> None:
    plan = plan_for(chain_of_four_bars(10), "1", str(first), str(last))
    assert plan.closed
    assert [len(group.bodies) for group in plan.groups] == [2] * dyads
    assert len(plan.bodies) == 2 + 2 * dyads


def test_two_loads_on_one_link_need_no_group_at_all() -> None:
    plan = plan_for(chain_of_four_bars(10), "1", "6")
    assert plan.groups == ()


def test_all_links_of_ten_four_bars_need_one_dyad_a_loop() -> None:
    top = chain_of_four_bars(10)
    plan = plan_for(top, *top.body_of)
    assert [len(group.bodies) for group in plan.groups] == [2] * 10


@pytest.mark.parametrize(("edges", "largest"), [(BUTTERFLY, 6), (FLIER, 4)])
def test_the_smallest_group_that_stalls_is_solved_as_one(edges: str, largest: int) -> None:
    """Double butterfly: no dyad from any input. Single flier: a group of four at best."""
    top = topology(transcribe.case(mechanisms.pinned(Random(1), edges) | {"loads": {}}))
    plan = plan_for(top, *top.body_of)
    assert plan.closed
    assert max(len(group.bodies) for group in plan.groups) == largest


def test_a_redundant_constraint_leaves_the_plan_open() -> None:
    """Three parallel cranks count to a structure: no group order, the loop equations decide by rank."""
    joints = [
        {"pin": ["1", "2"], "at": "A"},
        {"pin": ["1", "4"], "at": "D"},
        {"pin": ["1", "5"], "at": "E"},
        {"pin": ["2", "3"], "at": "B"},
        {"pin": ["3", "4"], "at": "C"},
        {"pin": ["3", "5"], "at": "F"},
    ]
    points = {"A": [0, 0], "B": [1, 2], "C": [5, 2], "D": [4, 0], "E": [9, 0], "F": [10, 2]}
    plan = plan_for(topology(transcribe.case({"points": points, "joints": joints, "loads": {}})), "2", "1")
    assert not plan.closed
    assert plan.groups == ()


def chain_of_butterflies(count: int) -> Topology:
    """Double butterflies, the last link of each being the crank of the next."""
    joints, places = [], {}
    before, links = "2", 2
    for unit in range(count):
        names = {"0": "1", "1": before}
        for link in "234567":
            links += 1
            names[link] = str(links)
        for k, pair in enumerate(BUTTERFLY.split()):
            if unit == 0 or pair != "01":
                joints.append({"pin": [names[pair[0]], names[pair[1]]], "at": f"Q{unit}_{pair}"})
                places[f"Q{unit}_{pair}"] = [unit, k]
        before = names["5"]
    return topology(transcribe.case({"points": places, "joints": joints, "loads": {}}))


def test_a_chain_of_double_butterflies_has_a_group_of_six_each(monkeypatch: pytest.MonkeyPatch) -> None:
    """One matching an input serves all groups: what is matched anew grows with the links."""
    placed: dict[int, int] = {}
    place = Matching._place
    for count in (10, 20):
        placed[count] = 0

        def counting(matching: Matching, row: tuple[int, int], count: int = count) -> bool:
            placed[count] += 1
            return place(matching, row)

        monkeypatch.setattr(Matching, "_place", counting)
        top = chain_of_butterflies(count)
        plan = plan_for(top, *top.body_of)
        assert plan.closed
        assert [len(group.bodies) for group in plan.groups] == [6] * count
    assert placed[20] < 2.5 * placed[10]


def hung_on(seed: int) -> dict[str, Any] | None:
    """A four-bar, and links that hang on it by joints drawn at random, three constraints a link: some of the
    links may be held once too often, and others once too little. None where a link hangs on nothing."""
    rng = Random(seed)
    scene = mechanisms.four_bar(rng)
    links = [1, 2, 3, 4]
    for link in range(5, 7 + seed % 3):
        scene["joints"].append({"pin": [link, rng.choice(links)], "at": f"K{link}"})
        links.append(link)
    left = len(links) - 4  # constraints, after a pin of each
    for k in range(2 * left):
        new = rng.choice(links[4:])
        other, at = rng.choice([link for link in links if link != new]), f"Q{k}"
        more = rng.choice(["pin", "slot", "slot", "many"]) if left > 1 else "slot"
        if more == "slot":
            scene["joints"].append({"slot": [new, other], "at": at, "along": mechanisms.heading(rng)})
        elif more == "pin":
            scene["joints"].append({"pin": [new, other], "at": at})
        else:
            joint = rng.choice(scene["joints"][4:])
            if "pin" not in joint or new in joint["pin"]:
                continue
            joint["pin"].append(new)
        left -= 1 if more == "slot" else 2
        if not left:
            break
    points = {joint["at"] for joint in scene["joints"]}
    scene["points"] |= {p: mechanisms.spot(rng) for p in sorted(points - scene["points"].keys())}
    loads = {"P": {"torque": 7.5, "link": 4}, "T": {"torque": "unknown", "link": 2}}
    return scene | {"loads": loads} if not left else None


def told(scene: dict[str, Any], examine: bool) -> tuple[str, float | None]:
    """The status of a scene and its answer."""
    try:
        return "ok", icsolve.solve(transcribe.case(scene), examine=examine).answers["T"].value
    except SceneError as refused:
        return str(refused.status), None


def test_what_a_plan_leaves_out_holds_nothing_of_what_it_plans() -> None:
    """A scene has the answer that it has when all of it is examined, whatever hangs on it and how."""
    scenes = [scene for seed in range(120) if (scene := hung_on(seed)) is not None]
    found = [told(scene, examine=False) for scene in scenes]
    assert found == [told(scene, examine=True) for scene in scenes]
    assert min(sum(status == "ok" for status, _ in found), sum(status != "ok" for status, _ in found)) > 10
