"""Screws: jacks, clamps and vices by the formulas of the square thread; the linkages that they drive."""

from __future__ import annotations

import math
from typing import Any

import pytest

import icsolve
from icsolve.answer import Answer
from icsolve.errors import CaseError, SceneError


def solved(text: str, **options: Any) -> Answer:
    return icsolve.solve(icsolve.load("icsolve: 1\n" + text), **options)


def exactly(number: float) -> Any:
    return pytest.approx(number, rel=1e-12)


JACK = """
units: {length: mm, force: N, torque: N*m}
points: {B: [0, 100]}
joints:
  - {screw: [1, 2], at: B, along: 90, lead: %g, radius: %g, mu: %g}
loads:
  W: {weight: 10 kN, link: 2, at: B}
  T: {torque: unknown, screw: 1-2}
"""
THREADS = [(5.0, 10.0, 0.1), (6.0, 11.0, 0.15), (40.0, 12.0, 0.08), (3.0, 25.0, 0.3)]


@pytest.mark.parametrize(("lead", "radius", "mu"), THREADS)
def test_torque_to_raise_and_to_lower_by_the_square_thread(lead: float, radius: float, mu: float) -> None:
    """T = W r tan(phi + l) up, W r tan(l - phi) down; the efficiency tan l / tan(phi + l)."""
    rise, phi = math.atan(lead / (2 * math.pi * radius)), math.atan(mu)
    text = JACK % (lead, radius, mu)
    up = solved(text + "motion: {point: B, link: 2, speed: 1, angle: 90}\n", reactions=True)
    down = solved(text + "motion: {point: B, link: 2, speed: 1, angle: 270}\n", reactions=True)
    assert up.answers["T"].value == exactly(10 * radius * math.tan(phi + rise))
    assert down.answers["T"].value == exactly(10 * radius * math.tan(rise - phi))
    assert up.answers["T"].sense == "cw"
    assert up.friction is not None
    assert up.friction.efficiency == exactly(math.tan(rise) / math.tan(phi + rise))
    held = solved(text).answers["T"]
    ends = (10 * radius * math.tan(rise - phi), 10 * radius * math.tan(rise + phi))
    assert held.holds == tuple(map(exactly, ends))
    assert held.self_locking == (phi > rise)
    for answer in (up, down):
        assert sum(term.power for term in answer.terms) == pytest.approx(0.0, abs=1e-9)
        assert answer.reactions is not None
        assert (answer.reactions["F12"].kind, answer.reactions["F12"].y) == ("screw", exactly(1e4))


@pytest.mark.parametrize("load", ["{force: 700, link: 2, at: B, angle: 90}", "{weight: 700, link: 2, at: B}"])
def test_a_load_that_draws_along_turns_the_friction_s_side(load: str) -> None:
    """Moving up, with the load pulling up too, the other flank carries: T = -F r tan(l - phi)."""
    text = JACK.replace("{weight: 10 kN, link: 2, at: B}", load) % (5.0, 10.0, 0.1)
    rise, phi = math.atan(5 / (2 * math.pi * 10)), math.atan(0.1)
    answer = solved(text + "motion: {point: B, link: 2, speed: 1, angle: 90}\n")
    up = "angle: 90" in load
    expected = -0.7 * 10 * math.tan(rise - phi) if up else 0.7 * 10 * math.tan(rise + phi)
    assert answer.answers["T"].value == exactly(expected)


def test_without_friction_the_torque_s_work_is_the_load_s() -> None:
    answer = solved((JACK % (5.0, 10.0, 0.1)).replace(", radius: 10, mu: 0.1", ""), reactions=True)
    assert answer.answers["T"].value == exactly(10 * 5 / (2 * math.pi))
    error = answer.answers["T"].error
    assert error is not None
    assert error < 1e-13


@pytest.mark.parametrize("half", [20.0, 35.0, 60.0])
def test_scissor_jack_by_its_screw(half: float) -> None:
    """Four arms at an angle t: the screw pulls W / tan t, whatever their length."""
    t = math.radians(half)
    x, y = 200 * math.cos(t), 200 * math.sin(t)
    answer = solved(
        f"""
units: {{length: mm, force: N, torque: N*m}}
points: {{O: [0, 0], L: [{-x!r}, {y!r}], R: [{x!r}, {y!r}], H: [0, {2 * y!r}]}}
joints:
  - {{pin: [1, 2, 3], at: O}}
  - {{pin: [2, 4, 8], at: R}}
  - {{pin: [3, 5, 7], at: L}}
  - {{pin: [4, 5, 6], at: H}}
  - {{slide: [6, 1], at: H, along: 90}}
  - {{screw: [8, 7], at: L, along: 0, lead: 4}}
loads:
  W: {{weight: 5000, link: 6, at: H}}
  T: {{torque: unknown, screw: 8-7}}
""",
        reactions=True,
    )
    pull = 5000 / math.tan(t)
    assert answer.answers["T"].value == pytest.approx(pull * 0.004 / (2 * math.pi), rel=1e-9)


def test_a_screw_that_no_torque_turns_is_locked() -> None:
    answer = solved((JACK % (5.0, 10.0, 0.1)).replace("  T: {torque: unknown, screw: 1-2}\n", ""))
    assert (answer.mobility, answer.answers) == (0, {})
    assert answer.reactions is not None
    assert answer.reactions["F12"].y == exactly(1e4)


def test_a_known_torque_presses() -> None:
    """A vice: 20 N m on a lead of 5 mm, radius 10 mm, mu 0.1 presses with T / r tan(l + phi)."""
    answer = solved("""
units: {length: mm, force: N, torque: N*m}
points: {B: [0, 0]}
joints: [{screw: [1, 2], at: B, along: 0, lead: 5, radius: 10, mu: 0.1}]
loads:
  P: {force: unknown, link: 2, at: B, angle: 180}
  T: {torque: 20, screw: 1-2}
motion: {point: B, link: 2, speed: 1, angle: 0}
""")
    rise, phi = math.atan(5 / (2 * math.pi * 10)), math.atan(0.1)
    assert answer.answers["P"].value == exactly(2000 / math.tan(rise + phi))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ((", radius: 10", ""), "needs 'radius', the mean one of its thread"),
        (("lead: 5, ", ""), "needs 'lead': how far it moves in a turn"),
        (("lead: 5", "lead: 0"), "greater than zero"),
        (("lead: 5", "pitch: 5"), "lead"),
        (("screw: 1-2", "screw: 1-3"), "no screw joins '1-3'"),
        (("screw: 1-2", "screw: 1-2, link: 2"), "has no 'link'"),
        (("screw: [1, 2]", "screw: [1, 2, 3]"), "joins two links"),
    ],
)
def test_slips_are_told_with_what_mends_them(change: tuple[str, str], said: str) -> None:
    text = (JACK % (5.0, 10.0, 0.1)).replace(*change)
    with pytest.raises(CaseError) as caught:
        icsolve.load("icsolve: 1\n" + text)
    assert said in str(caught.value)


def test_an_unknown_force_along_a_locked_screw_is_carried() -> None:
    load = "force: unknown, link: 2, at: B, angle: 90"
    text = (JACK % (5.0, 10.0, 0.1)).replace("torque: unknown, screw: 1-2", load)
    with pytest.raises(SceneError) as caught:
        solved(text)
    assert caught.value.status == "structure"
    assert "the screw of 1 and 2 is locked, as no load turns it" in caught.value.message
