"""Inertia: accelerations against differences, inertia forces against closed forms and both routes."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest

import icsolve
import six_bars
import transcribe
from growth import random_mechanism
from icsolve.answer import Answer
from icsolve.case import Case, Contact, Inertia, KnownCentre, Motion, Number, Pin, Roll
from icsolve.errors import CaseError, SceneError
from icsolve.manual import template
from icsolve.numbers import linear
from icsolve.numbers.balls import Ball
from icsolve.scene.sensitivity import band
from icsolve.sweep.find_on_record import Query, find
from icsolve.sweep.varied_numbers import find_number, with_numbers
from reference import MANY, many, motions, points_of
from shell import exit_status
from sizes import MORE, few, sampled

CASES = Path(__file__).parent.parent / "cases"


def solved(text: str, **options: Any) -> Answer:
    return icsolve.solve(icsolve.load("icsolve: 1\n" + text), dynamic=True, **options)


def moved(case: Case, link: str) -> Case:
    """The case with a link turning at 1 rad/s, without loads."""
    one = Number(1.0, 0.0, "motion.speed", "1")
    return replace(case, motion=(Motion(link, one),), loads=(), expect=())


# --- accelerations ---------------------------------------------------------------------------------

H = many.mpf(10) ** -18
"""The time, in seconds, by which the mechanism is moved to either side."""


def differenced(case: Case, link: str) -> tuple[dict[str, float], dict[tuple[str, str], Any]] | None:
    """Rates of the links' rates and of the velocities of material points, in sixty digits; None where the
    mechanism has not one freedom, or does not turn the link.

    All points go on by their velocities. That they then miss the joints by the square of the time is the
    same on both sides, and so falls out of the difference.
    """
    points = {name: (many.mpf(x), many.mpf(y)) for name, (x, y) in points_of(case).items()}
    now = _turning(case, points, link)
    if now is None:
        return None
    sides = [_turning(*_displaced(case, points, now, sign * H), link) for sign in (-1, 1)]
    if None in sides:
        return None
    before, after = sides
    assert before is not None and after is not None
    rates = {q: float((after[q][2] - before[q][2]) / (2 * H)) for q in now}
    material = {}
    for joint in case.joints:
        for on in joint.links if isinstance(joint, Pin) and joint.at in points else ():
            p, q = (_velocity(s, points[joint.at], now, on, t * H) for t, s in ((-1, before), (1, after)))
            material[joint.at, on] = tuple(float((b - a) / (2 * H)) for a, b in zip(p, q, strict=True))
    return rates, material


def _turning(case: Case, points: Any, link: str) -> dict[str, Any] | None:
    """The twists (X, Y, W) of all links in case lengths where the link turns at 1 rad/s."""
    found = motions(case, points, MANY)
    if len(found.basis) != 1 or abs(found.basis[0][link][2]) < 1e-6:
        return None
    (ox, oy), size, per = found.frame.origin, found.frame.size, found.basis[0][link][2]
    scaled = {q: (x * size / per, y * size / per, w / per) for q, (x, y, w) in found.basis[0].items()}
    return {q: (x + w * ox, y + w * oy, w) for q, (x, y, w) in scaled.items()}


def _displaced(case: Case, points: Any, twists: dict[str, Any], time: Any) -> tuple[Case, Any]:
    """The case and its points a short time on: each point, and each guide, with its link."""
    moved, joints = dict(points), []
    for joint in case.joints:
        guide = getattr(joint, "guide", None)
        if getattr(joint, "at", None) is not None:
            moved[joint.at] = _gone(points[joint.at], twists[joint.links[0]], time)  # type: ignore[union-attr]
        if guide is not None:
            names = {*(guide.ends or ()), guide.through} - {None, joint.at}  # type: ignore[union-attr]
            on = twists[joint.links[1]]
            moved |= {name: _gone(points[name], on, time) for name in names}
            if guide.angle is not None:
                turned = many.mpf(guide.angle.value) + time * on[2] * 180 / many.pi
                guide = guide._replace(angle=guide.angle._replace(value=turned))
            joint = joint._replace(guide=guide)  # type: ignore[call-arg]  # noqa: PLW2901
        joints.append(joint)
    return replace(case, joints=tuple(joints)), moved


def _gone(p: Any, twist: Any, time: Any) -> Any:
    x, y, w = twist
    return p[0] + time * (y - w * p[1]), p[1] + time * (w * p[0] - x)


def _velocity(twists: dict[str, Any], p: Any, now: dict[str, Any], on: str, time: Any) -> Any:
    """Of a point that the link has taken along."""
    (x, y, w), (px, py) = twists[on], _gone(p, now[on], time)
    return y - w * py, w * px - x


def random_cases(first: int, number: int) -> Iterable[Case]:
    """Those of which every joint says how it goes on."""
    for seed in range(first, first + number * MORE):
        case = icsolve.load(transcribe.text(random_mechanism(Random(seed))))
        if not any(isinstance(joint, Roll | Contact | KnownCentre) for joint in case.joints):
            yield case


def test_accelerations_are_the_differences_of_rates_in_sixty_digits_for_all_joints() -> None:
    compared, kinds = 0, set()
    for case in random_cases(0, 30 if MORE == 1 else 250):
        tries = ((q, differenced(case, q)) for q in case.links[1:])
        link, expected = next((one for one in tries if one[1] is not None), ("", None))
        if expected is None:
            continue
        found = icsolve.solve(moved(case, link), dynamic=True)
        assert found.angular_accelerations is not None
        assert found.accelerations is not None
        rates, places = expected
        largest = max(1.0, *(abs(a) for a in rates.values()))
        for other, rate in rates.items():
            assert found.angular_accelerations[other] == pytest.approx(rate, rel=1e-9, abs=1e-9 * largest)
        for key, place in places.items():
            size = max(largest, *(abs(a) for a in place))
            assert found.accelerations[key] == pytest.approx(place, rel=1e-9, abs=1e-9 * size), key
        compared += 1
        kinds |= {type(joint).__name__ for joint in case.joints}
    assert compared >= (5 if MORE == 1 else 1000)
    assert {"Pin", "Slide", "Slot"} <= kinds


@pytest.mark.parametrize("digits", [17, 7], ids=["double precision", "printed"])
@pytest.mark.parametrize("inner", [False, True], ids=["outside", "inside"])
def test_wheels_that_roll_on_a_coupler_go_on_as_gears_do(inner: bool, digits: int) -> None:
    """The crank, as a wheel about B, and a wheel about C: the contact lies on BC to the digits written.

    In 9 and 15 contacts happen to miss by next to nothing. What printed digits miss may grow a hundred
    thousand times in others than the first.
    """
    for seed in {9, 15, *range(2 * MORE)} if digits == 17 else range(3):
        rng = Random(seed)
        one, two = rng.randint(5, 20), rng.randint(1, 4)
        crank, lean, along = rng.uniform(0.3, 0.8), rng.uniform(0, 7), rng.uniform(0, 7)
        b = (crank * math.cos(lean), crank * math.sin(lean))
        c, p = (
            (b[0] + far / 10 * math.cos(along), b[1] + far / 10 * math.sin(along))
            for far in (one - two if inner else one + two, one)
        )
        d = (b[0] + 2.0, b[1] - 1.5)
        placed = ", ".join(
            f"{n}: [{x:.{digits}g}, {y:.{digits}g}]"
            for n, (x, y) in zip("ABCDP", ((0, 0), b, c, d, p), strict=True)
        )
        text = (
            f"icsolve: 1\npoints: {{{placed}}}\njoints: [{{pin: [1, 2], at: A}}, {{pin: [2, 4], at: B}}, "
            "{pin: [4, 3, 5], at: C}, {pin: [5, 1], at: D}, %s]\n"
            "motion: {link: 2, speed: 3, acceleration: 2}\n"
        )
        sign = -1 if inner else 1
        wheels = (
            f"{{roll: [2, 3], at: P, radii: [{sign * one / 10}, {two / 10}]}}",
            f"{{gears: [2, 3], teeth: [{sign * one}, {two}]}}",
        )
        rolling, geared = (icsolve.solve(icsolve.load(text % way), dynamic=True) for way in wheels)
        assert rolling.angular_accelerations is not None and geared.angular_accelerations is not None
        assert rolling.angular_accelerations == pytest.approx(
            geared.angular_accelerations, rel=1e-9 if digits == 17 else 1e-3
        )


@pytest.mark.parametrize("centre", ["[-0.16, 0.12]", "[0.2, 0]", "[0.12, 0.16]"])
@pytest.mark.parametrize("radii", ["[0, 0.2]", "[0.3, 0.2]", "[-0.7, 0.2]"])
def test_equations_of_balls_hold_no_rounded_doubles(
    centre: str, radii: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Two doubles in them are divided as doubles are, with an error that no ball carries. The normal of a
    rolling contact was one: a wheel at constant speed on a slope had an acceleration of 1e-17, and reactions
    lay beyond their bounds."""
    seen: list[Any] = []
    own = linear._Work.__init__

    def watched(self: Any, rows: Any, *rest: Any) -> None:
        seen.append([*(row.values() for row in rows)])
        own(self, rows, *rest)

    monkeypatch.setattr(linear._Work, "__init__", watched)
    text = (
        f"icsolve: 1\npoints: {{A: [-1.28, -4.04], P: [0, 0], B: {centre}, C: [1.28, -1.68]}}\n"
        "links: {4: {mass: 9.5 kg, centre: B, inertia: 0.1 kg*m^2}}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: C}, {pin: [3, 4], at: B}, "
        f"{{roll: [1, 4], at: P, radii: {radii}}}]\n"
        "loads: {T: {torque: unknown, link: 3}}\nmotion: {link: 4, speed: 6.6, turns: cw}\n"
    )
    answer = icsolve.solve(icsolve.load(text), dynamic=True, reactions=True)
    assert answer.answers["T"].error is not None
    mixed = [[a for row in rows for a in row] for rows in seen]
    mixed = [rows for rows in mixed if any(isinstance(a, Ball) for a in rows)]
    assert mixed
    for rows in mixed:  # what is a power of two divides without rounding
        assert {math.frexp(a)[0] for a in rows if isinstance(a, float)} <= {0.0, 0.5, -0.5}


def test_slider_crank_by_its_closed_form() -> None:
    """x = r cos t + sqrt(l^2 - r^2 sin^2 t) differentiated twice, with an angular acceleration."""
    r, rod, w, more, t = 0.1, 0.25, 20.0, 50.0, math.radians(35)
    answer = solved("""
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: 0.1, BC: 0.25}
angles: {AB: 35}
near: {C: [0.3, 0]}
links: {4: {mass: 3 kg, centre: C}}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads: {T: {torque: unknown, link: 2}}
motion: {link: 2, speed: 20, acceleration: 50}
""")
    s, c = math.sin(t), math.cos(t)
    root = math.sqrt(rod**2 - (r * s) ** 2)
    first = -r * s - r * r * s * c / root
    second = -r * c - r * r * (c * c - s * s) / root - (r * r * s * c) ** 2 / root**3
    assert answer.accelerations is not None
    expected = second * w**2 + first * more
    assert answer.accelerations["C", "4"] == pytest.approx((expected, 0.0), rel=1e-14)
    assert answer.answers["T"].value == pytest.approx(3 * expected * first, rel=1e-13)


def test_units_of_pounds_and_inches() -> None:
    """A rotor of 3 lbm at 4 in, started with 12 rad/s^2: the couple of its mass and its inertia."""
    answer = solved(
        """
units: {length: in, force: lbf}
points: {A: [0, 0], G: [4, 0]}
links: {2: {mass: 3 lbm, centre: G, inertia: 5 lbm*in^2}}
joints: [{pin: [1, 2], at: A}]
loads: {T: {torque: unknown, link: 2}}
motion: {link: 2, speed: 0, acceleration: 12}
""",
        reactions=True,
    )
    lbf = 0.45359237 * 0.0254 / 4.4482216152605
    assert answer.answers["T"].value == pytest.approx((3 * 16 + 5) * 12 * lbf, rel=1e-15)
    assert answer.reactions is not None
    assert answer.reactions["F12"].y == pytest.approx(3 * 4 * 12 * lbf, rel=1e-14)


def test_a_point_s_speed_and_acceleration_are_along_its_path() -> None:
    answer = solved("""
points: {A: [0, 0], B: [3, 4]}
joints: [{pin: [1, 2], at: A}]
motion: {point: B, link: 2, speed: 10, angle: 143.130102354, acceleration: 2}
""")
    assert answer.rates == pytest.approx({"1": 0.0, "2": 2.0})
    assert answer.angular_accelerations == pytest.approx({"1": 0.0, "2": 0.4})
    assert answer.accelerations is not None
    assert answer.accelerations["B", "2"] == pytest.approx((-4 * 3 - 0.4 * 4, -4 * 4 + 0.4 * 3))


def test_of_two_given_motions_a_point_s_acceleration_counts_at_its_angle() -> None:
    """Two links in series, the first driven, and the tip along a fixed direction u: v u and a u are given,
    and v is that of rigid links, w2 k x b + w3 k x c."""
    for k in range(6 * MORE):
        rng = Random(f"arm {k}")
        b, c = ((rng.uniform(0.5, 3.0), rng.uniform(-3.0, 3.0)) for _ in "bc")
        x, y, w2, e2, speed, more = (rng.uniform(-4.0, 4.0) for _ in range(6))
        lean = rng.uniform(0.0, 360.0)
        u = (math.cos(math.radians(lean)), math.sin(math.radians(lean)))
        places = {"A": (x, y), "B": (x + b[0], y + b[1]), "P": (x + b[0] + c[0], y + b[1] + c[1])}
        faster = (math.copysign(1.0, w2) * e2, math.copysign(1.0, speed) * more)
        answer = solved(f"""
points: {{{", ".join(f"{name}: [{px!r}, {py!r}]" for name, (px, py) in places.items())}}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}]
links: {{3: [P]}}
motion:
  - {{link: 2, speed: {w2!r}, acceleration: {faster[0]!r}}}
  - {{point: P, link: 3, speed: {speed!r}, angle: {lean!r}, acceleration: {faster[1]!r}}}
""")
        square_b, square_c = ((-q[1] * u[0] + q[0] * u[1]) for q in (b, c))
        w3 = (speed - w2 * square_b) / square_c
        inward = sum(n * (w2 * w2 * p + w3 * w3 * q) for n, p, q in zip(u, b, c, strict=True))
        e3 = (more - e2 * square_b + inward) / square_c
        assert answer.rates == pytest.approx({"1": 0.0, "2": w2, "3": w3}, rel=1e-9)
        assert answer.angular_accelerations == pytest.approx({"1": 0.0, "2": e2, "3": e3}, rel=1e-8)


@pytest.mark.parametrize("way", ["speed: 5, turns: cw, acceleration: 3", "speed: -5, acceleration: 3"])
def test_a_positive_acceleration_makes_the_link_faster_in_its_own_sense(way: str) -> None:
    answer = solved("points: {A: [0, 0]}\njoints: [{pin: [1, 2], at: A}]\nmotion: {link: 2, " + way + "}\n")
    assert answer.rates == {"1": 0.0, "2": -5.0}
    assert answer.angular_accelerations == {"1": 0.0, "2": -3.0}


# --- inertia forces --------------------------------------------------------------------------------


def heavy(case: Case, rng: Random) -> Case:
    """Masses on all links, at points that they carry."""

    def number(path: str) -> Number:
        digits = f"{rng.uniform(0.1, 9.0):.3f}"
        return Number(float(digits), 0.0, path, digits)

    masses = {}
    for link in case.links[1:]:
        names = [p for p in case.carries.get(link, ()) if not p.startswith("@")]
        if names:
            mass, moment = number(f"links.{link}.mass"), number(f"links.{link}.inertia")
            masses[link] = Inertia(mass, rng.choice(names), moment)
    return replace(case, inertia=masses)


def test_power_and_free_bodies_agree_with_inertia_forces_in_random_mechanisms() -> None:
    """The unknown load by both routes; and its power is the rate of the kinetic energy less the others'."""
    compared, refused = 0, set()
    for seed, case in enumerate(random_cases(500, 20 if MORE == 1 else 600)):
        rates = icsolve.solve(replace(case, loads=(), expect=())).rates or {}
        link = next((q for q, rate in rates.items() if rate), case.ground)
        one = Number(1.0, 0.0, "motion.speed", "1")
        loaded = heavy(replace(case, motion=(Motion(link, one),), expect=()), Random(seed))
        try:
            answer = icsolve.solve(loaded, dynamic=True, reactions=True)
        except SceneError as error:
            refused.add(error.status)
            continue
        compared += 1
        assert answer.witnesses
        for witness in answer.witnesses:
            assert abs(witness.difference) <= max(witness.bound, 1e-9 * abs(witness.power))
        assert sum(t.power for t in answer.terms) == pytest.approx(
            0.0, abs=1e-9 * max(abs(t.power) for t in answer.terms)
        )
    assert compared >= (4 if MORE == 1 else 2000)
    assert refused <= REFUSED


REFUSED = {
    *("dead-centre", "no-value", "any-value", "unsupported"),
    *("mobility", "near-singular", "change-point", "inconsistent"),
}


def test_inertia_s_power_is_what_the_kinetic_energy_loses() -> None:
    """Of a four-bar: by differences of the energy of its links over a sweep."""
    text = """
points: {A: [0, 0], D: [4, 0], G: {centroid: [B, C]}}
lengths: {AB: 1, BC: 3.5, CD: 2.5}
angles: {AB: 60}
near: {C: [3.5, 2.4]}
links: {3: {mass: 2 kg, centre: G, inertia: 0.4 kg*m^2}, 4: {inertia: 0.3 kg*m^2}}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
motion: {link: 2, speed: 10}
loads: {T: {torque: unknown, link: 2}}
"""
    energies = []
    for degrees in (59.99, 60.01):
        case = icsolve.load("icsolve: 1\n" + text.replace("AB: 60", f"AB: {degrees}"))
        one = icsolve.solve(case, rates=True)
        assert one.velocities is not None
        assert one.rates is not None
        (vx, vy), w3, w4 = one.velocities["G", "3"], one.rates["3"], one.rates["4"]
        assert isinstance(w3, float) and isinstance(w4, float) and isinstance(vx, float)
        energies.append(vx * vx + vy * vy + 0.2 * w3**2 + 0.15 * w4**2)
    power = (energies[1] - energies[0]) / math.radians(0.02) * 10.0
    answer = solved(text, reactions=True)
    assert answer.answers["T"].value * 10.0 == pytest.approx(power, rel=1e-7)
    assert answer.terms[0].power == pytest.approx(power, rel=1e-7)


def test_a_moment_of_inertia_of_nothing_needs_no_unit() -> None:
    """A mass at a point; 0 is the same in any unit."""
    values = []
    for inertia in ("0", "0 kg*m^2", "0.0 lbm*in^2"):
        links = f"links: {{2: {{mass: 2 kg, centre: B, inertia: {inertia}}}}}"
        text = f"""
points: {{A: [0, 0], B: [3, 4]}}
{links}
joints: [{{pin: [1, 2], at: A}}]
loads: {{T: {{torque: unknown, link: 2}}}}
motion: {{link: 2, speed: 3, acceleration: 2}}
"""
        values.append(solved(text).answers["T"].value)
    assert values == [2.0 * 25.0 * 2.0] * 3


def test_slopes_with_inertia_forces_are_the_differences_of_the_answer() -> None:
    """By masses, speed, acceleration and figure; of a link too whose inertia force is zero as it stands."""
    paths = (
        "motion.speed",
        "motion.acceleration",
        "links.3.mass",
        "links.4.inertia",
        "angles.AB",
        "lengths.BC",
    )
    case = icsolve.load("icsolve: 1\n" + FOUR_BAR.replace("speed: 10", "speed: 10, acceleration: 3"))
    rotor = icsolve.load(
        "icsolve: 1\n" + PENDULUM + "links: {2: {mass: 2 kg, centre: A, inertia: 5 kg*m^2}}\n"
        "loads: {T: {torque: unknown, link: 2}}\nmotion: {link: 2, speed: 3, acceleration: 0}\n"
    )
    assert icsolve.solve(rotor, dynamic=True).sensitivities["T"]["motion.acceleration"] == pytest.approx(5.0)
    found = icsolve.solve(case, dynamic=True).sensitivities["T"]
    for path in paths:
        value = find_number(case, path).value
        sides = [
            icsolve.solve(with_numbers(case, {path: value + h}), dynamic=True).answers["T"].value
            for h in (-1e-4, 1e-4)
        ]
        assert found[path] == pytest.approx((sides[1] - sides[0]) / 2e-4, rel=1e-5), path


IDLE = {
    "a dyad": """  - {pin: [3, 5], at: C}
  - {pin: [5, 6], at: E}
  - {pin: [6, 1], at: K}
""",
    "a wheel": """  - {pin: [1, 5], at: K}
  - {gears: [2, 5], teeth: [20, 37], carrier: 1}
""",
    "a block on a rod": """  - {pin: [3, 5], at: C}
  - {slide: [5, 6], at: C, along: [K, C]}
  - {pin: [6, 1], at: K}
""",
}


@pytest.mark.parametrize(
    "unknown", ["{torque: unknown, link: 2}", "{force: unknown, link: 4, at: C, angle: 15}"]
)
@pytest.mark.parametrize("idle", IDLE.values(), ids=IDLE)
def test_links_without_a_load_leave_the_slopes_with_inertia_forces_as_they_are(
    idle: str, unknown: str
) -> None:
    """The accelerations are found of all links together, also of those that no load is on."""
    text = FOUR_BAR.replace("{torque: unknown, link: 2}", unknown).replace(
        "speed: 10", "speed: 10, acceleration: 3"
    )
    alone = solved(text)
    more = text.replace("D: [4, 0],", "D: [4, 0], E: [2.5, 4.5], K: [-1, 3],").replace(
        "motion:", idle + "motion:"
    )
    with_idle, slopes = solved(more), alone.sensitivities["T"]
    assert {"links.3.mass", "motion.speed"} <= slopes.keys()
    for own in (with_idle.sensitivities["T"], icsolve.solve(with_idle.case).sensitivities["T"]):
        for path in own.keys() | slopes.keys():
            assert own.get(path, 0.0) == pytest.approx(slopes.get(path, 0.0), rel=1e-9, abs=1e-9), path
    assert band(with_idle, "T", 0.01) == pytest.approx(band(alone, "T", 0.01), rel=1e-9)


@sampled(2, "gravity", "bar")
@pytest.mark.parametrize("gravity", [False, True], ids=["without gravity", "with gravity"])
@pytest.mark.parametrize("bar", [six_bars.WATT, six_bars.STEPHENSON], ids=["Watt I", "Stephenson III"])
def test_six_bars_by_newton_and_euler(bar: six_bars.SixBar, gravity: bool) -> None:
    """Torque and every reaction of Watt I and Stephenson III, by equations of motion written apart."""
    case = icsolve.load(six_bars.text(bar, six_bars.SPEED, gravity))
    degrees = np.linspace(-4.0, 4.0, 2 * MORE)
    rows = icsolve.sweep(replace(case, dynamic=False), want=("points", "status"), drive={"AB": degrees})
    for n in range(len(rows)):
        answer = icsolve.solve(rows.case_of(n), dynamic=True, reactions=True)
        places = {name: xy[n] for name, xy in rows.points.items()}
        torque, forces = six_bars.newton_euler(bar, places, six_bars.SPEED, gravity)
        assert answer.answers["T"].value == pytest.approx(torque, rel=1e-9)
        largest = max(float(np.hypot(*force)) for force in forces.values())
        assert answer.reactions is not None
        for reaction in answer.reactions.values():
            (x, y), (_, on) = forces[reaction.where], bar.joints[reaction.where][1]
            sign = 1.0 if reaction.on == on else -1.0
            assert (sign * reaction.x, sign * reaction.y) == pytest.approx((x, y), abs=1e-9 * largest)


# --- slips -----------------------------------------------------------------------------------------

PENDULUM = "points: {A: [0, 0], G: [2, 0]}\njoints: [{pin: [1, 2], at: A}]\n"


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("links: {2: {mass: 2 kg}}", "needs 'centre': its centre of mass"),
        ("links: {2: {centre: G}}", "no 'mass'"),
        ("links: {2: {mass: 2, centre: G}}", "a mass carries its unit"),
        ("links: {2: {mass: 2 kg, centre: G, inertia: 3}}", "a moment of inertia carries its unit"),
        ("links: {2: {mass: 2 kg, center: G}}", "did you mean 'centre'"),
        ("links: {2: {mass: -2 kg, centre: G}}", "should not be negative"),
        ("links: {2: {mass: 2 kg, centre: H}}", "nothing gives it"),
        ("links: {2: {mass: 2 N, centre: G}}", "weight"),
        ("links: {5: {mass: 2 kg, centre: G}}", "no joint has a link '5'"),
        ("motion: {link: 2, turns: cw, acceleration: 3}", "needs a 'speed'"),
        ("motion: {link: 2, speed: 1, acceleration: 3 rad/s}", "rad/s^2"),
        ("dynamic: perhaps", "yes or no"),
    ],
)
def test_slips_are_told_with_what_mends_them(more: str, said: str) -> None:
    with pytest.raises(CaseError) as caught:
        icsolve.load("icsolve: 1\n" + PENDULUM + more)
    assert said in str(caught.value)


@pytest.mark.parametrize("motion", ["", "motion: {link: 2, turns: cw}"])
def test_without_a_speed_there_are_no_inertia_forces(motion: str) -> None:
    with pytest.raises(SceneError, match="give `motion` a `speed`"):
        solved(PENDULUM + "links: {2: {mass: 2 kg, centre: G}}\n" + motion)


def test_dynamic_may_stand_in_the_case_and_a_mass_alone_is_no_load() -> None:
    text = PENDULUM + "links: {2: {mass: 2 kg, centre: G}}\nmotion: {link: 2, speed: 3}\n"
    still = icsolve.solve(icsolve.load("icsolve: 1\n" + text + "loads: {W: {weight: 9, link: 2, at: G}}"))
    assert still.accelerations is None
    answer = icsolve.solve(icsolve.load("icsolve: 1\n" + text + "dynamic: yes\n"), reactions=True)
    assert answer.accelerations is not None
    assert answer.accelerations["G", "2"] == (-18.0, 0.0)
    assert any("counts as one point" in note for note in answer.notes) is False


def test_what_is_asked_beside_dynamic_has_the_inertia_forces_too(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The option says what `dynamic: yes` says, in the report too; a motion has no stability."""
    told = []
    for text, option in (
        (template("engine"), []),
        (template("engine").replace("dynamic: yes", ""), ["--dynamic"]),
    ):
        (tmp_path / "engine.yaml").write_text(text, encoding="utf-8")
        assert exit_status("solve", str(tmp_path / "engine.yaml"), "--report", *option) == 0
        told.append(capsys.readouterr().out)
        assert exit_status("solve", str(tmp_path / "engine.yaml"), "--stability", "2", *option) == 1
        assert "does not rest" in capsys.readouterr().err
    assert told[0] == told[1]


def test_a_link_with_a_mass_that_nothing_drives_is_refused() -> None:
    with pytest.raises(SceneError, match="Give its motion too") as caught:
        solved("""
points: {A: [0, 0], B: [2, 0], G: [3, 1]}
links: {3: {mass: 2 kg, centre: G, inertia: 1 kg*m^2}}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}]
motion: {link: 2, speed: 3}
""")
    assert caught.value.status == "mobility"


def test_inertia_forces_are_known_to_rounding() -> None:
    """Of 200 g at 0.2 rad/s^2: they were not written, so no last decimal of theirs leaves anything open."""
    answer = solved("""
points: {A: [0, 0], G: [0.01, 0.001]}
links: {2: {mass: 0.2 kg, centre: G, inertia: 0.2 kg*m^2}}
joints: [{pin: [1, 2], at: A}]
loads: {T: {torque: unknown, link: 2}}
motion: {link: 2, speed: 0.3, acceleration: 0.2}
""")
    assert answer.answers["T"].value == pytest.approx(0.2 * 0.2 * (1.0 + 0.01**2 + 0.001**2), rel=1e-15)
    assert answer.notes == ()


NEARLY_BALANCED = """icsolve: 1
units: {{length: m, force: N}}
points: {{A: [0, 0], D: [{d}, 0]}}
lengths: {{AB: {a}, BC: {b}, CD: {c}, BG: {g}}}
angles: {{AB: {t}, CBG: {u}}}
near: {{C: [{x}, {y}]}}
links:
  2: {{mass: 0.81 kg, centre: B, inertia: 1.53 kg*m^2}}
  3: {{mass: 4.52 kg, centre: G, inertia: 2.49 kg*m^2}}
  4: {{mass: 0.64 kg, centre: C, inertia: 2.19 kg*m^2}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 1], at: D}}
loads:
  P: {{force: {P}, link: 3, at: G, angle: 185.6}}
  T: {{torque: unknown, link: 2}}
motion: {{link: 2, speed: {w}, acceleration: {alpha}}}
dynamic: yes
"""


def test_a_torque_that_nearly_vanishes_among_inertia_forces_has_all_its_digits() -> None:
    """Four-bars on which the force P nearly balances the inertia forces, by complex numbers in 60 digits: the
    torque within 1 ulp, its error within 2 (inertia forces rounded to doubles would lose ten digits)."""
    rng = Random(169)
    for _ in range(12 * MORE):
        data = {name: round(rng.uniform(1.0, 2.0), 3) for name in "abcdg"}
        data |= {"t": round(rng.uniform(0.0, 360.0), 2), "u": round(rng.uniform(0.0, 360.0), 1)}
        data |= {"w": round(rng.uniform(1.0, 9.0), 2), "alpha": round(rng.uniform(-9.0, 9.0), 2)}
        found = _by_complex_numbers(data)
        if found is None:
            continue
        (x, y), unit, rest = found
        force = many.nstr(-rest / unit, 9)
        torque = -(many.mpf(force) * unit + rest) / many.mpf(str(data["w"]))
        text = NEARLY_BALANCED.format(**data, x=x, y=y, P=force)
        answer = icsolve.solve(icsolve.load(text)).answers["T"]
        one = math.ulp(answer.value)
        assert abs(many.mpf(answer.value) - torque) <= one
        assert answer.error is not None
        assert answer.error <= 2.0 * one


def _by_complex_numbers(data: dict[str, float]) -> tuple[tuple[float, float], Any, Any] | None:
    """Of `NEARLY_BALANCED`: where C is, the power of a unit of P, and that of the inertia forces; None where
    it does not assemble. Positions, and by their derivatives speeds and accelerations, are complex."""
    a, b, c, d, g, t, u, w, alpha = (many.mpf(str(x)) for x in data.values())
    crank = a * many.expj(many.radians(t))
    apart = d - crank
    share = (b * b - c * c + abs(apart) ** 2) / (2 * abs(apart))
    if abs(share) >= b:
        return None
    rod = (share + many.mpc(0, 1) * many.sqrt(b * b - share * share)) * apart / abs(apart)
    lever, turn = crank + rod - d, many.mpc(0, 1)

    def two(sum_: Any) -> tuple[Any, Any]:
        """The rates p, q with i p rod - i q lever = sum_."""
        rows = many.matrix([[-rod.imag, lever.imag], [rod.real, -lever.real]])
        p, q = many.lu_solve(rows, many.matrix([sum_.real, sum_.imag]))
        return p, q

    w3, w4 = two(-turn * w * crank)
    a3, a4 = two(-((turn * alpha - w * w) * crank - w3**2 * rod + w4**2 * lever))
    arm = g * many.expj(many.radians(u)) * rod / b
    at_b = turn * w * crank, (turn * alpha - w * w) * crank
    at_g = at_b[0] + turn * w3 * arm, at_b[1] + (turn * a3 - w3**2) * arm
    at_c = turn * w4 * lever, (turn * a4 - w4**2) * lever

    def dot(p: Any, q: Any) -> Any:
        return (many.conj(p) * q).real

    masses = ("0.81", at_b), ("4.52", at_g), ("0.64", at_c)
    moments = ("1.53", w * alpha), ("2.49", w3 * a3), ("2.19", w4 * a4)
    rest = -sum(many.mpf(m) * dot(*at) for m, at in masses) - sum(many.mpf(m) * k for m, k in moments)
    place = crank + rod
    angle = many.expj(many.radians(many.mpf("185.6")))
    return (float(place.real), float(place.imag)), dot(angle, at_g[0]), rest


# --- sweeps ----------------------------------------------------------------------------------------

FOUR_BAR = """
points: {A: [0, 0], D: [4, 0], G: {centroid: [B, C]}}
lengths: {AB: 1, BC: 3.5, CD: 2.5}
angles: {AB: 60}
near: {C: [3.5, 2.4]}
links: {3: {mass: 2 kg, centre: G, inertia: 0.4 kg*m^2}, 4: {inertia: 0.3 kg*m^2}}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
motion: {link: 2, speed: 10}
loads: {T: {torque: unknown, link: 2}}
"""


def test_rows_of_a_dynamic_sweep_are_the_scenes() -> None:
    degrees = np.array([10.0, 60.0, 200.0])
    case = icsolve.load("icsolve: 1\n" + FOUR_BAR)
    want = ("answers", "status", "velocities", "accelerations")
    rows = icsolve.sweep(case, {"angles.AB": degrees}, want, dynamic=True)
    assert list(rows.status) == ["ok"] * 3
    for n, angle in enumerate(degrees):
        scene = icsolve.load("icsolve: 1\n" + FOUR_BAR.replace("AB: 60", f"AB: {angle}"))
        answer = icsolve.solve(scene, dynamic=True)
        assert rows.answers["T"][n] == pytest.approx(answer.answers["T"].value, rel=1e-12)
        assert answer.accelerations is not None
        assert answer.velocities is not None
        assert answer.angular_accelerations is not None
        assert tuple(rows.accelerations["G on 3"][n]) == pytest.approx(answer.accelerations["G", "3"])
        assert tuple(rows.velocities["C on 4"][n]) == pytest.approx(answer.velocities["C", "4"])
        assert rows.angular_accelerations["4"][n] == pytest.approx(answer.angular_accelerations["4"])
    again = icsolve.sweep(replace(case, dynamic=True), {"angles.AB": degrees})
    assert again.answers["T"] == pytest.approx(rows.answers["T"])
    with pytest.raises(ValueError, match="dynamic"):
        icsolve.sweep(case, {"angles.AB": degrees}, ("accelerations",))


def outcome(case: Case) -> tuple[str, Answer | None]:
    """The status of a scene, and its answer."""
    try:
        return "ok", icsolve.solve(case)
    except SceneError as refusal:
        return refusal.status, None


def driven(case: Case, rng: Random) -> tuple[Case, str] | None:
    """A case in the motion of a link, or of a point where it goes; and a link that turns."""
    found = icsolve.solve(replace(case, loads=(), expect=()), rates=True)
    rates, velocities = found.rates or {}, found.velocities or {}
    turning = next((q for q, rate in rates.items() if isinstance(rate, float) and rate), None)
    if turning is None:
        return None
    size = round(rng.uniform(-3.0, 3.0), 2) or 1.0
    speed = Number(size, 0.0, "motion.speed", repr(size))
    more = Number(2.5, 0.0, "motion.acceleration", "2.5")
    given = Motion(turning, speed, rng.choice([None, "cw"]), acceleration=more)
    spots = [spot for spot, v in velocities.items() if not isinstance(v, str) and max(map(abs, v)) > 1e-6]
    if rng.random() < 0.5 and spots:
        (point, link), way = rng.choice(spots), 0.0
        way = round(math.degrees(math.atan2(*reversed(velocities[point, link]))), 9)
        angle = Number(way, 0.0, "motion.angle", repr(way))
        given = Motion(link, speed, None, point, angle, more)
    return replace(case, motion=(given,)), turning


def test_rows_with_inertia_forces_are_their_scenes_in_random_mechanisms() -> None:
    """Loads, velocities and accelerations, to 1e-9 of the largest: the record loses no more of them, and what
    it would lose more of, beside singular positions, goes to the scene."""
    turn, compared = np.array([-40.0, -3.0, -0.5, 1e-5, 0.25, 2.0, 9.0, 71.0]), 0
    want = ("answers", "status", "velocities", "accelerations")
    for seed, case in enumerate(random_cases(3000, few(20))):
        moved_by = driven(case, Random(seed))
        if moved_by is None:
            continue
        one = replace(heavy(moved_by[0], Random(seed)), expect=(), dynamic=True)
        try:
            rows = icsolve.sweep(one, None, want, drive={moved_by[1]: turn})
        except SceneError:
            continue
        for n in np.flatnonzero(rows.status != "cannot-assemble").tolist():
            status, scene = outcome(rows.case_of(n))
            assert rows.status[n] == status
            if scene is None:
                continue
            assert scene.velocities is not None and scene.accelerations is not None
            for kind, by in (("velocities", scene.velocities), ("accelerations", scene.accelerations)):
                told = {f"{p} on {q}": v for (p, q), v in by.items() if not isinstance(v, str)}
                size = max(1e-300, *(abs(x) for v in told.values() for x in v))
                for spot in told.keys() & getattr(rows, kind).keys():
                    assert getattr(rows, kind)[spot][n] == pytest.approx(told[spot], abs=1e-9 * size)
            loads = [abs(t.power) for t in scene.terms]
            for name, found in scene.answers.items():
                unit = next(abs(t.factor) for t in scene.terms if t.load == name)
                room = 1e-9 * max(loads) / unit if unit else 0.0
                assert rows.answers[name][n] == pytest.approx(found.value, rel=1e-9, abs=room)
            compared += 1
    assert compared >= few(20) * MORE


def test_a_turn_with_inertia_forces_solves_no_scene(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nor does a search in it, which proves that none is missing: it has no note."""

    def refuse(*_: object, **__: object) -> None:
        raise AssertionError("a row is a scene of its own")

    monkeypatch.setattr(import_module("icsolve.sweep.rows_by_scenes"), "_one", refuse)
    case = icsolve.load("icsolve: 1\n" + FOUR_BAR + "dynamic: yes\n")
    turn = {"angles.AB": np.linspace(0.0, 360.0, 37)}
    rows = icsolve.sweep(case, turn, ("answers", "status", "velocities", "accelerations", "error"))
    assert set(rows.status) == {"ok"} and not rows.notes
    assert (rows.error["T"] <= 1e-11 * np.abs(rows.answers["T"]).max()).all()
    found = find(case, {"angles.AB": [0.0, 360.0]}, Query("value", "T", 0.0))
    signs = np.sign(rows.answers["T"])
    assert len(found) == (signs[:-1] * signs[1:] < 0.0).sum() and not found.notes


def test_gradients_with_inertia_forces_are_differences() -> None:
    """Of the torque by a length, the input and a mass: central differences lose half the digits."""
    case = icsolve.load("icsolve: 1\n" + FOUR_BAR + "dynamic: yes\n")
    paths, at = ("lengths.BC", "angles.AB", "links.3.mass"), (3.5, 60.0, 2.0)
    torque = icsolve.evaluator(case, paths, gradient=True)
    slopes = torque(*at).gradients["T"]
    for n, path in enumerate(paths):
        beside = [[x + sign * 1e-5 * (n == k) for k, x in enumerate(at)] for sign in (1.0, -1.0)]
        high, low = (torque(*some).answers["T"][0] for some in beside)
        assert slopes[path][0] == pytest.approx((high - low) / 2e-5, rel=1e-7)
    assert torque(*at).answers["T"][0] == pytest.approx(icsolve.solve(case).answers["T"].value, rel=1e-13)


def test_a_mass_is_set_by_its_path_and_a_zero_where_the_range_is_cut_is_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The piston's inertia does no work at 0 and 180 degrees, its dead centres."""
    path = CASES / "dynamics" / "slider_crank_piston.yaml"
    heavy = icsolve.solve(icsolve.load(path)).answers["T"].value
    light = icsolve.solve(icsolve.load(path, {"links.4.mass": "500 g"})).answers["T"].value
    assert light == pytest.approx(heavy / 6.0)
    monkeypatch.setattr(import_module("icsolve.sweep.find_by_scenes"), "PLACES", 2)
    found = find(icsolve.load(path), {"angles.AB": np.array([0.0, 180.0])}, Query("value", "T", 0.0))
    assert [(spot.at, spot.answer) for spot in (found[0], found[-1])] == [(0.0, 0.0), (180.0, 0.0)]


# --- cams ------------------------------------------------------------------------------------------

CAM = """
points: {A: [0, 0], B: [%s, unknown]}
lengths: {AC: 20}
angles: {AC: 140}
near: {B: [8, 60]}
links: {4: {mass: 2 kg, centre: B}}
profile:
  2: {circle: C, radius: 40}
  4: {%s}
joints:
  - {pin: [1, 2], at: A}
  - {contact: [2, 4]}
  - {slide: [4, 1], at: B, along: 90}
loads: {T: {torque: unknown, link: 2}}
motion: {link: 2, speed: 30, acceleration: 7}
"""


@pytest.mark.parametrize(
    ("beside", "follower", "reach"),
    [(8, "roller: B, radius: 10", 50), (8, "knife: B", 40), (0, "flat: B, along: 0", None)],
    ids=["roller", "knife edge", "flat face"],
)
def test_a_follower_on_an_eccentric_disk_by_its_closed_form(
    beside: int, follower: str, reach: int | None
) -> None:
    """s = e sin t + sqrt(r^2 - (e cos t - eps)^2), of a face s = e sin t + r, differentiated twice."""
    t = many.radians(many.mpf(140))

    def lift(t: Any) -> Any:
        across = 20 * many.cos(t) - beside
        return 20 * many.sin(t) + (many.sqrt(reach**2 - across**2) if reach else 40)

    first, second = many.diff(lift, t), many.diff(lift, t, 2)
    answer = solved("units: {length: mm, force: N, torque: N*m}" + CAM % (beside, follower), reactions=True)
    assert answer.accelerations is not None
    expected = float(second * 900 + first * 7)
    assert answer.accelerations["B", "4"] == pytest.approx((0.0, expected), rel=1e-12)
    assert answer.answers["T"].value == pytest.approx(2e-6 * expected * float(first), rel=1e-11)


def test_followers_of_all_cases_by_differences_of_their_rates() -> None:
    """By profiles of arcs, polygons and tables, turning and sliding followers."""
    compared = 0
    for path in sorted((CASES / "cams").glob("*.yaml")):
        case = icsolve.load(str(path))
        if case.profiles is None:
            continue
        turning, h = moved(case, case.links[1]), 1e-3
        rows = icsolve.sweep(turning, want=("velocities", "rates"), drive={case.links[1]: [-h, h]})
        answer = icsolve.solve(turning, dynamic=True)
        assert answer.angular_accelerations is not None
        assert answer.accelerations is not None
        turns = {q: a for q, a in answer.angular_accelerations.items() if not isinstance(a, str)}
        for link, found in turns.items():  # a roller that is free to spin has none
            before, after = rows.rates[link]
            rate = (after - before) / math.radians(2 * h)
            assert found == pytest.approx(rate, rel=1e-5, abs=1e-6), path.name
        for name, (before, after) in rows.velocities.items():
            point, _, link = name.partition(" on ")
            rate = tuple((after - before) / math.radians(2 * h))
            if link in turns:
                assert answer.accelerations[point, link] == pytest.approx(rate, rel=1e-5, abs=1e-5), path.name
        compared += 1
    assert compared >= 4


@pytest.mark.parametrize("angle", [20, 128, 160, 250, 330])
def test_a_point_that_cannot_move_as_given_is_told_both_ways_that_it_can(angle: int) -> None:
    """At 3-4-5 the end of a crank moves square to it."""
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.solve(
            icsolve.load(f"""icsolve: 1
points: {{A: [0, 0], B: [4, 3]}}
joints: [{{pin: [1, 2], at: A}}]
loads: {{F: {{force: 1, link: 2, at: B, angle: 0}}, T: {{torque: unknown, link: 2}}}}
motion: {{point: B, link: 2, speed: 1, angle: {angle}}}
"""),
            rates=True,
        )
    assert refused.value.status == "inconsistent"
    assert f"only move at 126.9 or 306.9 deg in this position, not at {angle} deg" in refused.value.message


@pytest.mark.parametrize("dynamic", [False, True])
def test_a_refusal_is_the_same_with_inertia_forces_and_without(dynamic: bool) -> None:
    """The cause in the words of the file: the arm that a torsion spring follows has no length."""
    case = icsolve.load("""icsolve: 1
units: {length: m, force: N}
points: {A: [0, 2]}
lengths: {AG: 0}
angles: {AG: 0}
links: {2: {mass: 3 kg, centre: G}}
joints: [{pin: [1, 2], at: A}]
loads: {S: {spring: unknown, corner: AG, free: 2, link: 2}}
motion: {link: 2, speed: 1}
""")
    with pytest.raises(icsolve.SceneError) as refusal:
        icsolve.solve(case, dynamic=dynamic)
    assert refusal.value.status == "inconsistent"
    assert "the corner of load S: A and G lie at one place" in refusal.value.message
    assert refusal.value.message.count("Noticed: the length AG is 0") == 1


@pytest.mark.parametrize("motion", ["", "motion: {link: beam, speed: 2}\n"])
def test_of_a_structure_there_are_no_inertia_forces(motion: str) -> None:
    """Its loads are known, so that it is not told to give them numbers."""
    case = icsolve.load(f"""icsolve: 1
points: {{A: [0, 0], B: [4, 0], C: [2, 0]}}
links: {{beam: {{mass: 3 kg, centre: C}}}}
joints:
  - {{pin: [1, beam], at: A}}
  - {{slot: [beam, 1], at: B, along: 0}}
loads: {{W: {{weight: 10, link: beam, at: C}}}}
{motion}""")
    with pytest.raises(icsolve.SceneError) as refused:
        icsolve.solve(case, dynamic=True)
    assert refused.value.status == "structure"
    assert "nothing moves, and there are no inertia forces" in refused.value.message
