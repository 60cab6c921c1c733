"""Every reaction is the exact one for the decimals in the file, rounded once: components, size, direction.

Against free bodies in 140 digits of mpmath, which know joints by what they hold and nothing of motions:
within one unit in the last place, stated errors at most two of them and never broken. `ICSOLVE_FULL=1` takes
300 scenes of all joints and 100 scenes a hair from a dead centre.
"""

from __future__ import annotations

from random import Random
from typing import Any

import pytest
from mpmath import mp, mpf

import icsolve
from icsolve import case as c
from icsolve.answer import Answer
from icsolve.answer.bodies import Reaction
from icsolve.bench.accuracy import Shown
from icsolve.scene.program import Want, evaluate, prepare
from icsolve.statics.power import is_unknown, number_of
from more_digits import SixtyDigits
from sizes import FULL
from test_digits import all_joints, beside_a_dead_centre

Force = tuple[Any, Any, Any]
"""Force components, and the moment about the origin."""
X, Y, COUPLE = (1, 0), (0, 1), (0, 0, 1)


def near(shown: float, true: Any, size: Any, what: str, error: float | None = None) -> None:
    """The law for one number; ``size`` is that of its terms."""
    assert Shown(what, shown, true, size, error).fault == ""


def through(p: Any, u: Any) -> Force:
    """A unit force along u through p."""
    return u[0], u[1], p[0] * u[1] - p[1] * u[0]


def held(joint: c.Joint, pivots: tuple[str, str], points: Any, digits: Any) -> list[Force]:
    """What a joint can transmit; of a mesh or a belt what the shafts feel along its tangent."""
    if isinstance(joint, c.Gears | c.Belt):
        return [_mesh(joint, pivots, points, digits)]
    at = getattr(joint, "at", None)
    p = points[at] if at else (mpf(0), mpf(0))
    if isinstance(joint, c.Contact):
        return [through(p, digits.turn(joint.normal))]
    if isinstance(joint, c.Slide | c.Slot):
        if joint.guide.angle is not None:
            ux, uy = digits.turn(joint.guide.angle)
        else:
            a, b = (points[end] for end in joint.guide.ends or ())
            ux, uy = b[0] - a[0], b[1] - a[1]
        return [through(p, (-uy, ux)), *([COUPLE] if isinstance(joint, c.Slide) else [])]
    if isinstance(joint, c.KnownCentre) and joint.toward is not None:
        return [through(p, digits.turn(joint.toward)), COUPLE]
    return [through(p, X), through(p, Y), *([COUPLE] if isinstance(joint, c.Weld) else [])]


def _mesh(joint: c.Gears | c.Belt, pivots: tuple[str, str], points: Any, digits: Any) -> Force:
    """A couple in the ratio of the wheels on the second, and the force that this is for the first."""
    (ax, ay), (bx, by) = (points[p] for p in pivots)
    n, m = (digits.given(one) for one in (joint.teeth if isinstance(joint, c.Gears) else joint.radii))
    if isinstance(joint, c.Belt) and not joint.crossed:
        m = -m
    # square to the line of the pivots through the point that divides it as n : m, times n + m
    ex, ey = -(by - ay), bx - ax
    return (n + m) * ex, (n + m) * ey, (ax * m + bx * n) * ey - (ay * m + by * n) * ex


def free_bodies(case: c.Case) -> dict[Any, Force] | None:
    """The force of every joint on its second link, and its moment about the joint's point, case units.

    None where the joints share a load.
    """
    digits: Any = SixtyDigits()
    program, outcome = evaluate(prepare(case, Want(bodies=True)), digits)
    row = {link: 3 * k for k, link in enumerate(link for link in case.links if link != case.ground)}
    wrenches = []
    pivots = {(id(bond.joint), bond.links): bond.pivots for bond in program.top.bonds}
    for joint in case.joints:
        for link in joint.links[1:]:
            of = pivots.get((id(joint), (joint.links[0], link)), ("", ""))
            wrenches += [(joint, joint.links[0], link, w) for w in held(joint, of, outcome.points, digits)]
    unknown = [w.load.name for w in outcome.balance.wrenches if is_unknown(w.load)]
    if len(wrenches) + len(unknown) != 3 * len(row):
        return None
    a, b = mp.zeros(3 * len(row)), mp.zeros(3 * len(row), 1)
    for k, (_, by, on, w) in enumerate(wrenches):
        for link, sign in ((by, -1), (on, 1)):
            for n in range(3 if link in row else 0):
                a[row[link] + n, k] += sign * w[n]
    for load in outcome.balance.wrenches:
        gain = load.gain * load.measure * load.ratio
        unit = [gain * u for u in (load.unit[1], -load.unit[0], load.unit[2])]
        for link, sign in ((load.load.link, 1), (load.against, -1)):
            for n in range(3 if link in row else 0):
                if load.root in unknown:
                    a[row[link] + n, len(wrenches) + unknown.index(load.root)] += sign * unit[n]
                else:
                    b[row[link] + n] -= sign * unit[n] * number_of(load, digits)
    x = mp.lu_solve(a, b)
    found: dict[Any, Any] = {}
    for k, (joint, by, on, w) in enumerate(wrenches):
        key = (joint, by, on)
        found[key] = tuple(p + x[k] * q for p, q in zip(found.get(key, (0, 0, 0)), w, strict=True))
    places = {key: outcome.points.get(getattr(key[0], "at", None), (0, 0)) for key in found}
    return {
        key: (fx, fy, (moment - px * fy + py * fx) / mpf(program.figure.frame.scale))
        for key, (fx, fy, moment) in found.items()
        for px, py in [places[key]]
    }


def check(text: str) -> int:
    """How many reactions of a scene were held against free bodies."""
    with mp.workdps(140):
        case = icsolve.load(text)
        truth = free_bodies(case)
        if truth is None:
            return 0
        answer = icsolve.solve(case, reactions=True)
        return _compared(case, answer, truth)


def _compared(case: c.Case, answer: Answer, truth: dict[Any, Force]) -> int:
    assert answer.reactions is not None
    pairs = [(joint, joint.links[0], link) for joint in case.joints for link in joint.links[1:]]
    largest = max(max(map(abs, force)) for force in truth.values())
    for (joint, by, on), (name, shown) in zip(pairs, answer.reactions.items(), strict=True):
        fx, fy, moment = truth[joint, by, on]
        if shown.by != by:
            fx, fy, moment = -fx, -fy, -moment
        _one(name, shown, (fx, fy, moment), largest, joint)
    return len(pairs)


def _one(name: str, shown: Reaction, true: Force, largest: Any, joint: c.Joint) -> None:
    fx, fy, moment = true
    errors = shown.errors
    if shown.x is not None:
        near(shown.x, fx, largest, f"{name}x", errors["x"])
    if shown.y is not None:
        near(shown.y, fy, largest, f"{name}y", errors["y"])
    if shown.x is None or shown.y is None or isinstance(joint, c.Gears | c.Belt):
        return
    assert shown.magnitude is not None
    near(shown.magnitude, mp.hypot(fx, fy), largest, f"|{name}|", errors["magnitude"])
    if shown.direction is not None and shown.opposite is not None:
        toward = mp.degrees(mp.atan2(fy, fx)) % 360
        if abs(fy) > mpf(10) ** -40 * largest:
            near(shown.direction, toward, 360, f"direction of {name}", errors["direction"])
            near(shown.opposite, (toward + 180) % 360, 360, f"opposite of {name}")
    if shown.moment is not None and getattr(joint, "at", None) is not None:
        near(shown.moment, moment, largest, f"moment of {name}", errors["moment"])


@pytest.mark.parametrize("block", range(30 if FULL else 1))
def test_every_reaction_of_scenes_of_all_joints(block: int) -> None:
    texts = [text for k, text in enumerate(all_joints(10 * (block + 1))) if k >= 10 * block]
    assert sum(map(check, texts)) > 0


@pytest.mark.parametrize("seed", range(100 if FULL else 10))
def test_every_reaction_beside_a_dead_centre(seed: int) -> None:
    assert check(beside_a_dead_centre(Random(f"beside {seed}"))) > 0


LEVER = """
icsolve: 1
points: {{A: [0, 0], B: [1, 0], C: [-1, 0]}}
joints: [{{pin: [1, 2], at: A}}]
loads: {{P: {{force: {p}, link: 2, at: B, angle: 90}}, Q: {{force: 3, link: 2, at: C, angle: 90}}}}
"""


@pytest.mark.parametrize("more", ["0.000000001", "0.000000000000001", "0.00000000000000000000000000001"])
def test_known_loads_that_do_not_balance_are_never_taken_so_in_silence(more: str) -> None:
    """However little they leave, of loads whose decimals are exact to it."""
    balanced = icsolve.solve(icsolve.load(LEVER.format(p="3")), reactions=True)
    assert not [note for note in balanced.notes if "leave" in note]
    answer = icsolve.solve(icsolve.load(LEVER.format(p=f"3{more[1:]}")), reactions=True)
    assert len([note for note in answer.notes if "P and Q leave" in note]) == 1


@pytest.mark.parametrize("power", [-980, -700, -530, -270, 270, 520, 700, 980])
def test_loads_of_any_size_that_doubles_hold_have_their_reactions_by_size_and_direction(power: int) -> None:
    """Loads times a power of two: components, couples and sizes are so many times as large, and directions
    the same (1e-15: the decimals of the power round); the squares of these forces no double holds."""
    text = """icsolve: 1
points: {A: [0, 0], B: [1, 2], C: [5, 3], D: [6, 0], E: [4, 4]}
links: {3: [E]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {weld: [4, 5], at: D}
  - {slide: [5, 1], at: D, along: 20}
loads:
  P: {force: FORCE, link: 3, at: E, angle: 230}
  T: {torque: unknown, link: 2}
"""
    factor = 2.0**power
    plain, scaled = (
        icsolve.solve(icsolve.load(text.replace("FORCE", repr(f))), reactions=True) for f in (1.0, factor)
    )
    assert plain.reactions and scaled.reactions
    for name, own in plain.reactions.items():
        other = scaled.reactions[name]
        sizes = (own.x, own.y, own.moment, own.magnitude)
        assert all(v is not None for v in sizes)
        found = (other.x, other.y, other.moment, other.magnitude)
        assert found == pytest.approx(tuple(factor * (v or 0.0) for v in sizes), rel=1e-15, abs=0.0)
        assert other.direction == pytest.approx(own.direction, rel=1e-15)
