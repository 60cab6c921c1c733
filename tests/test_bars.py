"""Bars that two forces pull or push, against the equilibrium of the nodes of their trusses."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest

import icsolve
from icsolve.explain import explain
from icsolve.report import answer_text
from icsolve.report.derivation.known import bars_of
from sizes import sampled


def truss(dice: Random, nodes: int) -> tuple[str, dict[str, float]]:
    """A row of triangles between a pin and a roller, loaded at its nodes, and what is in its bars by two
    equations a node."""
    places = [(k + dice.uniform(-0.2, 0.2), k % 2 * dice.uniform(0.6, 1.4)) for k in range(nodes)]
    bars = [(a, a + step) for step in (1, 2) for a in range(nodes - step)]
    names = {bar: f"b{n}" for n, bar in enumerate(bars)}
    size = 2 * nodes
    matrix, right, loads = np.zeros((size, size)), np.zeros(size), []
    for n, (a, b) in enumerate(bars):
        span = math.dist(places[a], places[b])
        for axis in (0, 1):
            along = (places[b][axis] - places[a][axis]) / span
            matrix[2 * a + axis, n], matrix[2 * b + axis, n] = along, -along
    matrix[0, -3] = matrix[1, -2] = matrix[2 * nodes - 1, -1] = 1.0
    for node in range(1, nodes - 1):
        x, y = dice.uniform(-5.0, 5.0), dice.uniform(-20.0, 5.0)
        right[2 * node], right[2 * node + 1] = -x, -y
        bar = names[node, node + 1]
        loads.append(f"  L{node}: {{force: [{x!r}, {y!r}], link: {bar}, at: P{node}}}")
    points = ", ".join(f"P{n}: [{x!r}, {y!r}]" for n, (x, y) in enumerate(places))
    joints = []
    for node in range(nodes):
        here = [name for bar, name in names.items() if node in bar]
        here = ["1", *here] if node == 0 else here
        joints.append(f"  - {{pin: [{', '.join(here)}], at: P{node}}}")
    joints.append(f"  - {{slot: [{names[nodes - 2, nodes - 1]}, 1], at: P{nodes - 1}, along: 0}}")
    text = f"icsolve: 1\npoints: {{{points}}}\njoints:\n" + "\n".join(joints)
    forces = np.linalg.solve(matrix, right)
    return f"{text}\nloads:\n" + "\n".join(loads), {names[b]: float(forces[n]) for n, b in enumerate(bars)}


@sampled(3)
@pytest.mark.parametrize("seed", range(6))
def test_bars_of_a_truss_are_pulled_and_pushed_as_its_nodes_say(seed: int) -> None:
    """Every bar is told, to 1e-9 of the largest (both in floats), and in words."""
    text, right = truss(Random(seed), 4 + seed)
    case = icsolve.load(text)
    answer = icsolve.solve(case, reactions=True)
    found, most = bars_of(answer), max(map(abs, right.values()))
    assert found == {name: pytest.approx(force, abs=1e-9 * most) for name, force in right.items()}
    told = answer_text(answer)
    for name, force in right.items():
        words = "tension" if force > 0.0 else "compression"
        assert any(line.split()[:2] == ["link", name] and words in line for line in told.splitlines())
        assert f"link {name}: {abs(force):.6g} N, {words}" in explain(case, bodies=True)


def test_what_bends_or_is_loaded_between_its_ends_is_no_bar() -> None:
    """A rod of an engine is one; its crank, which a torque turns, and its piston are not, nor is a rod with a
    weight at its middle."""
    text = """
icsolve: 1
points: {A: [0, 0], C: [unknown, 0], G: {centroid: [B, C]}}
lengths: {AB: 1, BC: 3}
angles: {AB: 50}
near: {C: [3, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads:
  P: {force: 100, link: 4, at: C, angle: 180}
  T: {torque: unknown, link: 2}
"""
    (link, force), *more = bars_of(icsolve.solve(icsolve.load(text), reactions=True)).items()
    lean = math.asin(math.sin(math.radians(50.0)) / 3.0)
    assert (link, more) == ("3", []) and force == pytest.approx(-100.0 / math.cos(lean), rel=1e-12)
    for place in ("G", "[2, 0.4]"):
        heavy = f"{text}  W: {{weight: 5, link: 3, at: {place}}}\n"
        assert not bars_of(icsolve.solve(icsolve.load(heavy), reactions=True))


def test_a_bar_that_nothing_loads_has_no_force() -> None:
    """The post under the middle of an upper chord, with three bars on the pin at its foot."""
    text = """
icsolve: 1
points: {A: [0, 0], B: [1.1, 0], C: [2.3, 0], D: [1.1, 0.7]}
joints:
  - {pin: [1, ab, ad], at: A}
  - {pin: [bd, ab, bc], at: B}
  - {pin: [ad, bd, cd], at: D}
  - {pin: [bc, cd], at: C}
  - {slot: [bc, 1], at: C, along: 0}
loads: {P: {force: 10, link: ad, at: D, angle: -75}}
"""
    answer = icsolve.solve(icsolve.load(text), reactions=True)
    assert bars_of(answer)["bd"] == 0.0
    assert "no force" in answer_text(answer)


@pytest.mark.parametrize("pushed", ["rod", "barrel"])
def test_the_barrel_of_a_cylinder_is_not_told_as_a_bar_without_force(pushed: str) -> None:
    """Its pressure passes between its pin and the piston without stretching it, but nobody would say that
    the cylinder has no force: that is the load's own."""
    other, at, away = ("barrel", "Q", "P") if pushed == "rod" else ("rod", "P", "Q")
    case = icsolve.load(f"""icsolve: 1
points: {{O: [0, 0], P: [1.8, -0.3], Q: [2.4, 1.1]}}
joints:
  - {{pin: [1, body], at: O}}
  - {{pin: [1, barrel], at: P}}
  - {{slide: [rod, barrel], at: Q, along: [P, Q]}}
  - {{pin: [rod, body], at: Q}}
loads:
  W: {{weight: 100, link: body, at: Q}}
  p: {{force: unknown, link: {pushed}, at: {at}, away: {away}, against: {other}}}
""")
    answer = icsolve.solve(case, reactions=True)
    assert not {"rod", "barrel"} & bars_of(answer).keys()
    assert "no force" not in answer_text(answer)
