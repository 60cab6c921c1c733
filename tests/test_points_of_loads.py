"""A load, a mass, the end of a spring stand at a point of their own link, and go on with it: another name of
the place, that this link alone carries, is the same load in every position, whatever joint has its point
there as written (a pin that runs in a slot of the link, a block on its guide, a contact that rolls on)."""

from __future__ import annotations

import random

import numpy as np
import pytest

import icsolve
from icsolve.page.model import gain_rows, heading_rows
from icsolve.page.motion import motion_of
from icsolve.report.derivation.known import acting_loads, known_of
from icsolve.solve.positions import find_along
from icsolve.solve.stability import with_stability
from sizes import sampled

SLOT = """\
  - {pin: [1, 2], at: A}
  - {slot: [2, 3], at: P, along: {along}}
  - {pin: [1, 3], at: D}
"""
BLOCK = """\
  - {pin: [1, 3], at: A}
  - {slide: [4, 3], at: P, along: {along}}
  - {pin: [4, 2], at: P}
  - {pin: [1, 2], at: D}
"""
RACK = """\
  - {pin: [1, 2], at: O}
  - {slide: [3, 1], at: P, along: 0}
  - {roll: [2, 3], at: P, radii: [1.25, 0]}
"""
WHEEL = """\
  - {pin: [1, 3], at: O}
  - {slide: [2, 1], at: P, along: 0}
  - {roll: [3, 2], at: P, radii: [1.25, 0]}
"""
ROLLER = """\
  - {pin: [3, 2], at: O}
  - {slide: [2, 1], at: O, along: 0}
  - {roll: [3, 1], at: P, radii: [1.25, 0]}
"""
JOINTS = {"slot": SLOT, "guide": BLOCK, "rack": RACK, "wheel": WHEEL, "roller": ROLLER}
"""Mechanisms in which link 3 has a load at P, which another link or the contact takes elsewhere."""
DRIVEN = {"wheel": "3", "roller": "3"}
"""The link that turns, where it is not 2."""
LOADS = {
    "force": "{force: 30, link: 3, at: {P}, angle: {angle}}",
    "turning": "{force: 30, link: 3, at: {P}, angle: {angle}, turns_with: 2}",
    "toward": "{force: 30, link: 3, at: {P}, toward: X}",
    "weight": "{weight: 30, link: 3, at: {P}}",
    "spring": "{spring: 20, free: 1, link: 3, at: {P}, to: X}",
    "end of a spring": "{spring: 20, free: 1, link: 2, at: K, against: 3, to: {P}}",
    "line": "{distributed: 20, link: 3, from: {P}, to: L, angle: {angle}}",
    "triangle": "{distributed: [20, 5], link: 3, from: L, to: {P}, angle: {angle}}",
    "winding": "{spring: 20, corner: {P}-L, free: 30, link: 3}",
    "winding between": "{spring: 20, corner: K-{P}-L, free: 30, link: 3, against: 2}",
    "mass": "",
}


def scene(joints: str, load: str, name: str, seed: int) -> str:
    """A case whose load stands at P, or at another name of that place."""
    rng = random.Random(f"{joints} {load} {seed}")
    near = [f"[{rng.uniform(-2, 2):.3f}, {rng.uniform(1, 4):.3f}]" for _ in range(3)]
    free = ", ".join(f"{point}: {at}" for point, at in zip("XKL", near, strict=True))
    own = f"3: [L, {name}]" if name != "P" else "3: [L]"
    if load == "mass":
        own = own.replace("[", "{points: [") + f", mass: 3 kg, centre: {name}}}"
    told = LOADS[load].replace("{P}", name).replace("{angle}", f"{rng.uniform(0, 360):.1f}")
    return f"""\
icsolve: 1
points: {{A: [0, 0], D: [3, -1], O: [0.5, 2.25], P: [0.5, 1], Q: [0.5, 1], {free}}}
links: {{{own}, 2: [K]}}
joints:
{JOINTS[joints].replace("{along}", f"{rng.uniform(0, 180):.1f}")}
loads:
  W: {{weight: 20, link: 3, at: L}}
  T: {{torque: unknown, link: {DRIVEN.get(joints, 2)}}}
{f"  S: {told}" if told else ""}
motion: {{link: {DRIVEN.get(joints, 2)}, speed: 4}}
"""


@sampled(8, "joints", "load")
@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("joints", JOINTS)
def test_a_load_goes_on_with_its_own_link(joints: str, load: str, seed: int) -> None:
    """Rows and the stability as written."""
    one, other = (icsolve.load(scene(joints, load, name, seed)) for name in "PQ")
    driven = DRIVEN.get(joints, "2")
    dynamic = load == "mass"
    turned = {driven: [-11.0, -4.0, 0.0, 3.0, 8.0]}
    rows = [icsolve.sweep(case, drive=turned, dynamic=dynamic) for case in (one, other)]
    assert [*rows[0].status] == [*rows[1].status]
    assert np.isfinite(rows[1].answers["T"]).sum() > 2
    assert np.allclose(rows[0].answers["T"], rows[1].answers["T"], rtol=1e-9, atol=1e-9, equal_nan=True)
    if not dynamic:
        told = [with_stability(case, icsolve.solve(case), driven).stiffness for case in (one, other)]
        assert told[0].value == pytest.approx(told[1].value, rel=1e-9, abs=1e-9)


@sampled(3, "joints", "load")
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("load", ["toward", "spring", "end of a spring", "winding", "winding between"])
@pytest.mark.parametrize("joints", ["slot", "guide", "rack"])
def test_a_page_draws_and_reckons_it_on_its_own_link(joints: str, load: str, seed: int) -> None:
    """How it acts and what a unit of it does, in every position: its powers are those of rows."""
    told = []
    for name in "PQ":
        known = known_of(icsolve.load(scene(joints, load, name, seed)))
        motion = motion_of(known, ())
        (acting,) = (one for one in acting_loads(known) if one.load.name == "S")
        told.append([rows(known, motion, acting) for rows in (gain_rows, heading_rows)])
        if load.startswith("winding"):  # the sum of powers of a row, by the terms of a unit of each load
            powers = motion.found.terms
            held = 20.0 * gain_rows(known, motion, acting) * (motion.found.rates["3"])
            if load == "winding between":
                held -= 20.0 * gain_rows(known, motion, acting) * motion.found.rates["2"]
            assert np.allclose(20.0 * powers["S"], held, rtol=1e-7, atol=1e-7, equal_nan=True)
    for one, other in zip(*told, strict=True):
        assert np.allclose(one, other, rtol=1e-9, atol=1e-9, equal_nan=True)


@pytest.mark.parametrize("joints", ["slot", "guide"])
def test_a_page_has_the_couple_of_a_torsion_spring_wherever_its_links_meet(joints: str) -> None:
    """Also where the first of its rows, or some between, are beyond the limits of the motion."""
    known = known_of(icsolve.load(scene(joints, "winding", "Q", 0)))
    motion = motion_of(known, ())
    (acting,) = (one for one in acting_loads(known) if one.load.name == "S")
    met = motion.found.status == "ok"
    assert 0 < np.count_nonzero(~met) < len(met) // 2
    assert (np.isfinite(gain_rows(known, motion, acting)) == met).all()


ARM = """\
icsolve: 1
points: {{A: [0, 0], D: [3, -1], X: [0, 4]}}
lengths: {{AP: 1.2, DL: 2}}
angles: {{AP: {datum}, PDL: 0}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{slot: [2, 3], at: P, along: [D, L]}}
  - {{pin: [1, 3], at: D}}
loads:
  K: {load}
  T: {{torque: {torque}, link: 2}}
"""
HELD = {
    "spring": ("{spring: 50, free: 1, link: 3, at: P, to: X}", -60),
    "force": ("{force: 40, link: 3, at: P, angle: 30}", -20),
    "triangle": ("{distributed: [30, 10], link: 3, from: L, to: P, angle: 30}", 5),
}


@pytest.mark.parametrize(("load", "torque"), HELD.values(), ids=HELD)
def test_where_it_stands_on_its_link_counts_from_the_position_as_written(load: str, torque: int) -> None:
    """The datum that is to find says where that is; a sweep finds the same."""

    def posed(datum: str) -> icsolve.Case:
        return icsolve.load(ARM.format(datum=datum, load=load, torque=torque))

    with pytest.raises(icsolve.SceneError, match="load K at P, which goes with link 2, counts from") as open_:
        icsolve.solve(posed("{unknown: [0, 90]}"))
    assert "from: 30" in str(open_.value)
    case = posed("{unknown: [0, 90], from: 40}")
    found = [position.at["angles.AP"] for position in icsolve.solve(case).positions]
    swept, _ = find_along(posed("40"), "angles.AP", 0.0, 90.0)
    assert found == pytest.approx([one.value for one in swept], rel=1e-12)
    assert found
