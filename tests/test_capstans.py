"""Ropes that slip, every digit: capstans, band brakes and lengths, against sixty digits of closed forms.

Euler and Eytelwein: the pull grows by exp(mu beta) in the sense in which the rope runs over what it lies on.
With D from a point to the centre of a circle, the line that touches it leans from D by asin(r / |D|).
"""

from __future__ import annotations

import math
import re
from random import Random
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf

import icsolve
from icsolve.errors import CaseError, SceneError
from icsolve.scene.sensitivity import influences
from icsolve.solve.stability import holding_values
from sizes import FULL, MORE, few, sampled

mp.dps = 60
Vector = tuple[Any, Any]


def number(rng: Random, low: float, high: float) -> str:
    return f"{rng.uniform(low, high):.4f}"


def exact(*written: str) -> list[Any]:
    return [mpf(one) for one in written]


def toward(degrees: str) -> Vector:
    angle = mpf(degrees) * mp.pi / 180
    return mp.cos(angle), mp.sin(angle)


def cross(a: Vector, b: Vector) -> Any:
    return a[0] * b[1] - a[1] * b[0]


class Lying:
    """A rope from a point over a circle about the origin to another point: its directions and wrap."""

    def __init__(self, first: Vector, last: Vector, radius: Any, wrap: str) -> None:
        side = 1 if wrap == "ccw" else -1
        one = mp.atan2(-first[1], -first[0]) - mp.asin(side * radius / mp.hypot(*first))
        two = mp.atan2(last[1], last[0]) + mp.asin(side * radius / mp.hypot(*last))
        self.side = side
        self.wrap = side * (two - one) % (2 * mp.pi)
        self.onto, self.off = (mp.cos(one), mp.sin(one)), (mp.cos(two), mp.sin(two))
        straight = [mp.sqrt(p[0] ** 2 + p[1] ** 2 - radius**2) for p in (first, last)]
        self.length = sum(straight) + radius * self.wrap


def agrees(value: float, error: float | None, true: Any, what: str) -> None:
    """Rounded once, and the bound holds and is at most two units in the last place."""
    assert error is not None, what
    assert error <= 2 * math.ulp(value), what
    assert abs(mpf(value) - true) <= error, what


def capstan(rng: Random) -> tuple[str, dict[float, Any]]:
    """A block on a guide, a rope from it over a post to a hand; and the pull by the block's sense."""
    a, b = ((number(rng, -4, -1), number(rng, -4, 4)) for _ in "ab")
    r, mu, along, w, lean = (
        number(rng, *ends) for ends in ((0.1, 0.9), (0.05, 0.8), (-60, 60), (10, 200), (100, 250))
    )
    wrap = rng.choice(["cw", "ccw"])
    rope = Lying((mpf(a[0]), mpf(a[1])), (mpf(b[0]), mpf(b[1])), mpf(r), wrap)
    d, f = toward(along), toward(lean)
    first = -mpf(w) * (f[0] * d[0] + f[1] * d[1]) / (rope.onto[0] * d[0] + rope.onto[1] * d[1])
    running = 1 if rope.onto[0] * d[0] + rope.onto[1] * d[1] > 0 else -1
    pulls = {sense: first * mp.exp(sense * running * mpf(mu) * rope.wrap) for sense in (1.0, -1.0)}
    return (
        f"""icsolve: 1
points: {{A: [{a[0]}, {a[1]}], O: [0, 0], B: [{b[0]}, {b[1]}]}}
joints:
  - {{slide: [2, 1], at: A, along: {along}}}
  - {{rope: [A, O, B], on: [2, 1], radii: {{O: {r}}}, wraps: {{O: {wrap}}}, mu: {{O: {mu}}}}}
loads:
  W: {{force: {w}, link: 2, at: A, angle: {lean}}}
  U: {{force: unknown, at: B}}
""",
        pulls,
    )


def brake(rng: Random) -> tuple[str, dict[float, Any]]:
    """A band from the frame over a drum on a rough pin to a lever; and its load by the drum's sense."""
    e, c = ((number(rng, -3, 3), number(rng, -4, -1)) for _ in "ec")
    a, at = ((number(rng, -3, 3), number(rng, -4, 4)) for _ in "al")
    r, mu, torque, lean, rough, pin = (
        number(rng, *ends) for ends in ((0.1, 0.9), (0.05, 0.8), (5, 50), (0, 360), (0.05, 0.5), (0.01, 0.05))
    )
    wrap = rng.choice(["cw", "ccw"])
    (ex, ey, cx, cy, ax, ay, lx, ly) = exact(*e, *c, *a, *at)
    rope = Lying((ex, ey), (cx, cy), mpf(r), wrap)
    circle = mpf(pin) * mp.sin(mp.atan(mpf(rough)))
    loads = {}
    for sense in (1.0, -1.0):
        grown = mp.exp(-sense * rope.side * mpf(mu) * rope.wrap)
        rest = mp.hypot(*(grown * x - y for x, y in zip(rope.off, rope.onto, strict=True)))
        first = -mpf(torque) / (rope.side * mpf(r) * (grown - 1) - sense * circle * rest)
        lever = cross((lx - ax, ly - ay), toward(lean))
        loads[sense] = first * grown * cross((cx - ax, cy - ay), rope.off) / lever if first > 0 else None
    return (
        f"""icsolve: 1
points: {{O: [0, 0], E: [{e[0]}, {e[1]}], A: [{a[0]}, {a[1]}], C: [{c[0]}, {c[1]}], L: [{at[0]}, {at[1]}]}}
joints:
  - {{pin: [1, 2], at: O, mu: {rough}, radius: {pin}}}
  - {{pin: [1, 3], at: A}}
  - {{rope: [E, O, C], on: [1, 2, 3], radii: {{O: {r}}}, wraps: {{O: {wrap}}}, mu: {{O: {mu}}}}}
loads:
  M: {{torque: {torque}, link: 2}}
  U: {{force: unknown, link: 3, at: L, angle: {lean}}}
""",
        loads,
    )


def motion(text: str, sense: float) -> str:
    if "slide" in text:
        along = float(text.partition("along: ")[2].partition("}")[0])
        return f"motion: {{point: A, link: 2, speed: 1, angle: {along + (0 if sense > 0 else 180)!r}}}\n"
    return f"motion: {{link: 2, turns: {'ccw' if sense > 0 else 'cw'}}}\n"


@pytest.mark.parametrize("kind", [capstan, brake])
def test_what_slips_is_the_closed_form_rounded_once(kind: Any) -> None:
    compared = 0
    for seed in range(12 * MORE):
        text, truths = kind(Random(seed))
        for sense, true in truths.items():
            if true is None or (kind is capstan and true <= 0):
                continue
            answer = icsolve.solve(icsolve.load(text + motion(text, sense)), reactions=True)
            found = answer.answers["U"]
            agrees(found.value, found.error, true, f"{kind.__name__} {seed} {sense}")
            compared += 1
    assert compared >= 8


def test_the_range_that_a_capstan_holds_has_proven_ends() -> None:
    compared = 0
    for seed in range(10 * MORE):
        text, truths = capstan(Random(seed))
        if min(truths.values()) > 0:
            found = icsolve.solve(icsolve.load(text)).answers["U"]
            assert found.holds is not None
            assert found.error is not None
            for end, true in zip(found.holds, sorted(truths.values()), strict=True):
                assert abs(mpf(end) - true) <= found.error <= 2 * math.ulp(found.holds[1]), seed
            compared += 1
    assert compared >= 4


def test_tensions_of_the_parts_are_rounded_once() -> None:
    for seed in range(6 * MORE):
        text, truths = capstan(Random(seed))
        if truths[1.0] > 0:
            answer = icsolve.solve(icsolve.load(text + motion(text, 1.0)), reactions=True)
            (pull,) = answer.tensions
            assert abs(mpf(pull.parts[1]) - truths[1.0]) <= math.ulp(pull.parts[1])
            assert pull.error is not None


def test_rows_of_a_rope_that_slips_are_proven_too() -> None:
    text, truths = next(
        (text, truths)
        for seed in range(20)
        if min((made := capstan(Random(seed)))[1].values()) > 0
        for text, truths in [made]
    )
    mu = float(text.partition("mu: {O: ")[2].partition("}")[0])
    case = icsolve.load(text + motion(text, 1.0))
    rows = icsolve.sweep(case, {"joints.O.mu": np.array([mu, mu + 0.1])}, ("answers", "error"))
    agrees(float(rows.answers["U"][0]), float(rows.error["U"][0]), truths[1.0], "row")


def test_what_a_rope_of_given_length_places_is_rounded_once() -> None:
    """A block on an upright guide hangs by a rope over a pulley with a radius."""
    for seed in range(4 * MORE):
        rng = Random(seed)
        x, r, bx, by = (number(rng, *ends) for ends in ((0.5, 0.9), (0.1, 0.3), (-0.9, -0.5), (-1.9, -1.1)))
        text = f"""icsolve: 1
points: {{A: [-1, -2], P: [0, 0], B: [{bx}, {by}], C: [{x}, unknown]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{slide: [3, 1], at: C, along: 90}}
  - {{rope: [B, P, C], on: [2, 1, 3], length: 4, radii: {{P: {r}}}, wraps: {{P: cw}}}}
near: {{C: [{x}, -1.6]}}
loads: {{W: {{weight: 100, link: 3, at: C}}, T: {{torque: unknown, link: 2}}}}
"""
        first = (mpf(bx), mpf(by))

        def left(y: Any, first: Vector = first, x: str = x, r: str = r) -> Any:
            return Lying(first, (mpf(x), y), mpf(r), "cw").length - 4

        true = mp.findroot(left, mpf("-1.6"))
        found = icsolve.solve(icsolve.load(text)).points["C"][1]
        assert abs(mpf(found) - true) <= math.ulp(found), seed


def test_the_slope_by_the_coefficient_of_a_rope_is_that_of_the_exponential() -> None:
    text, truths = capstan(Random(3))
    answer = icsolve.solve(icsolve.load(text + motion(text, 1.0)))
    (slope,) = (one.per_unit for one in influences(answer, "U") if one.path == "joints.A-O-B.mu.O")
    grown = mp.log(truths[1.0] / truths[-1.0]) / 2  # mu beta, with the sense
    mu = mpf(text.partition("mu: {O: ")[2].partition("}")[0])
    assert slope == pytest.approx(float(truths[1.0] * grown / mu), rel=1e-12)


@sampled(2)
@pytest.mark.parametrize("near", [0.4, 0.8, 1.1, 1.148, 1.3])
def test_near_may_say_where_the_rope_puts_a_point(near: float) -> None:
    """Starts from which no rope can be laid are none; where the point lies is as good a word as any."""
    text = f"""icsolve: 1
points: {{A: [0, 0], P: [1, 2], B: [0.3, 0.5], C: [1, unknown]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{slide: [3, 1], at: C, along: 90}}
  - {{rope: [B, P, C], on: [2, 1, 3], length: 3.084, radii: {{P: 0.2}}, wraps: {{P: cw}}}}
near: {{C: [1, {near}]}}
loads: {{W: {{weight: 100, link: 3, at: C}}, T: {{torque: unknown, link: 2}}}}
"""
    case = icsolve.load(text)
    assert icsolve.solve(case).points["C"][1] == pytest.approx(1.1479677368961603)
    assert icsolve.sweep(case, {"points.A.y": [0.0]}).status.tolist() == ["ok"]


@pytest.mark.parametrize(("angle", "sense"), [(90, 1.0), (270, -1.0)])
def test_the_friction_of_a_rope_is_against_its_slip(angle: int, sense: float) -> None:
    """W goes up: the rope slips toward P = W exp(mu pi), and the post holds it back by P - W; going down the
    other way round, with P = W exp(-mu pi)."""
    text = (
        "icsolve: 1\npoints: {A: [0, 0], C: [-1, -3], B: [1, -5]}\n"
        "joints:\n  - {slide: [2, 1], at: C, along: 90}\n"
        "  - {rope: [C, A, B], on: [2, 1], radii: {A: 1}, wraps: {A: cw}, mu: {A: 0.25}}\n"
        "loads: {W: {weight: 100, link: 2, at: C}, P: {force: unknown, at: B}}\n"
        f"motion: {{point: C, link: 2, speed: 1, angle: {angle}}}\n"
    )
    answer = icsolve.solve(icsolve.load(text))
    pull = 100.0 * math.exp(sense * 0.25 * math.pi)
    assert answer.friction is not None
    (rub,) = answer.friction.rubbing
    assert (rub.rate, rub.value) == (sense, pytest.approx(100.0 - pull, rel=1e-12))
    (term,) = (term for term in answer.terms if term.load.startswith("friction"))
    assert term.power == pytest.approx(rub.value * rub.rate, rel=1e-15) == -rub.loss


def two_cranks(seed: int, posts: int) -> tuple[str, np.ndarray]:
    """A rope from one crank round a post on the other, and for two posts one on the frame, to an end; and the
    torques on the second crank that hold loads on both, over a grid of the pulls' ratios in which friction
    within its limits has them: (ratios, ...), not a number where the rope would have to push."""
    dice = Random(seed)
    at: dict[str, tuple[float, float]] = {}
    while len(at) < 8:  # rope and posts apart
        place = (round(dice.uniform(-5, 5), 3), round(dice.uniform(-5, 5), 3))
        if all(math.dist(place, other) > 1.0 for other in at.values()):
            at["ABCPQEMN"[len(at)]] = place
    radii, wraps = (
        [round(dice.uniform(0.1, 0.4), 3) for _ in "PQ"],
        [dice.choice(("cw", "ccw")) for _ in "PQ"],
    )
    mu, one, two = [round(dice.uniform(0.05, 0.5), 3) for _ in "PQ"], *(dice.uniform(-40, 40) for _ in "MN")
    sides = [round(dice.uniform(-180, 180), 2) for _ in "MN"]
    ends, middle = dice.choice((("2", "2"), ("2", "1"), ("1", "2"))), ["3", "1"][:posts]
    links, names = [ends[0], *middle, ends[1]], ["C", *"PQ"[:posts], "E"]
    turned = ((1 if w == "ccw" else -1) * r for w, r in zip(wraps, radii, strict=True))
    round_it = [0.0, *list(turned)[:posts], 0.0]
    pivots = {"2": at["A"], "3": at["B"]}
    angles, arms = [], {"2": np.zeros(posts + 1), "3": np.zeros(posts + 1)}
    for k in range(posts + 1):
        (ax, ay), (bx, by) = at[names[k]], at[names[k + 1]]
        lean = (round_it[k + 1] - round_it[k]) / math.hypot(bx - ax, by - ay)
        angles.append(math.atan2(by - ay, bx - ax) - math.asin(lean))
        ux, uy = math.cos(angles[k]), math.sin(angles[k])
        for link, (x, y), side, pull in ((links[k], (ax, ay), k, 1.0), (links[k + 1], (bx, by), k + 1, -1.0)):
            if link in pivots:
                px, py = pivots[link]
                arms[link][k] += pull * ((x - px) * uy - (y - py) * ux + round_it[side])
    grids = []
    for k in range(posts):
        wrap = math.copysign(1.0, round_it[k + 1]) * (angles[k + 1] - angles[k]) % (2 * math.pi)
        grids.append(np.exp(np.linspace(-mu[k] * wrap, mu[k] * wrap, 401 if posts == 1 else 81)))
    pulls = [np.ones_like(np.meshgrid(*grids)[0])]
    for ratio in np.meshgrid(*grids):
        pulls.append(pulls[-1] * ratio)

    def torque(link: str, force: float, degrees: float, name: str) -> float:
        (x, y), (px, py) = at[name], pivots[link]
        return force * (
            (x - px) * math.sin(math.radians(degrees)) - (y - py) * math.cos(math.radians(degrees))
        )

    first = -torque("2", one, sides[0], "M") / sum(a * p for a, p in zip(arms["2"], pulls, strict=True))
    asked = -torque("3", two, sides[1], "N") - first * sum(
        a * p for a, p in zip(arms["3"], pulls, strict=True)
    )
    on = ", ".join(links)
    text = (
        "icsolve: 1\npoints: {" + ", ".join(f"{n}: [{x}, {y}]" for n, (x, y) in at.items()) + "}\n"
        "joints:\n  - {pin: [1, 2], at: A}\n  - {pin: [1, 3], at: B}\n"
        f"  - {{rope: [{', '.join(names)}], on: [{on}], "
        + ", ".join(
            f"{what}: {{{', '.join(f'{n}: {v}' for n, v in zip(names[1:-1], of, strict=False))}}}"
            for what, of in (("radii", radii), ("wraps", wraps), ("mu", mu))
        )
        + "}\nloads:\n"
        f"  G: {{force: {one!r}, link: 2, at: M, angle: {sides[0]}}}\n"
        f"  H: {{force: {two!r}, link: 3, at: N, angle: {sides[1]}}}\n"
        "  U: {torque: unknown, link: 3}\n"
    )
    return text, np.where(first > 0.0, asked, math.nan)


@sampled(2)
@pytest.mark.parametrize("posts", [1, 2])
def test_a_rope_that_slips_holds_what_friction_within_its_limits_holds(posts: int) -> None:
    """The range is that of the equilibria in which the rope pulls: its finite ends are met at the corners of
    the grid (1e-9), and it goes on without end just where the pulls grow without bound inside the grid."""
    met = dict.fromkeys(("closed", "open", "none"), 0)
    for seed in range(few(80) * MORE):
        text, asked = two_cranks(seed, posts)
        held = asked[~np.isnan(asked)]
        case = icsolve.load(text)
        if not held.size:
            with pytest.raises(SceneError, match="would have to push"):
                icsolve.solve(case)
            met["none"] += 1
            continue
        answer = icsolve.solve(case)
        found = answer.answers["U"].holds
        assert found is not None, text
        assert answer.friction is not None
        low, high = answer.friction.possible
        size = 1e-9 * np.abs(held).max()
        assert low - size <= held.min(), (seed, text)
        assert held.max() <= high + size, (seed, text)
        assert low <= found[0] <= found[1] <= high, (seed, text)
        if held.size == asked.size:
            assert (low, high) == pytest.approx((held.min(), held.max()), rel=1e-9, abs=size), (seed, text)
        else:  # where a pull is without bound so is the torque, but for one that the rope does not change
            assert math.isinf(low) or math.isinf(high), (seed, text)
        met["closed" if held.size == asked.size else "open"] += 1
        if answer.answers["U"].self_locking:
            assert low <= 0.0 <= high or math.isinf(low) or math.isinf(high)
    assert min(met.values()) >= (5 if FULL else 2), met


@sampled(2)
@pytest.mark.parametrize("posts", [1, 2])
def test_along_its_own_number_a_load_ceases_to_hold_where_its_range_ends(posts: int) -> None:
    """The cranks on rough pins; also where the rope would have to push without friction: the load does work
    all the same. To 1e-9."""
    compared = 0
    for seed in range(400 if MORE > 1 else 4):
        text, _ = two_cranks(seed, posts)
        text = re.sub("at: ([AB])}", r"at: \1, mu: 0.2, radius: 0.3}", text)
        try:
            answer = icsolve.solve(icsolve.load(text))
        except SceneError:
            continue
        assert answer.friction is not None
        ranges = [answer.answers["U"].holds, *answer.friction.again]
        ends = sorted(end for one in ranges for end in one if math.isfinite(end))
        low, high = (side * 2.0 * max(map(abs, ends), default=1.0) for side in (-1.0, 1.0))
        case = icsolve.load(text.replace("torque: unknown", "torque: 1"))
        found = [one.value for one in holding_values(case, "loads.U", low, high)]
        assert found == pytest.approx(ends, rel=1e-9), seed
        compared += len(found)
    assert compared > (4 if FULL else 2)


@pytest.mark.parametrize("seed", range(few(30, 5)))
def test_a_crate_at_a_rope_over_a_rough_post_slides_or_tips_whichever_comes_first(seed: int) -> None:
    """A rope that is pulled holds what the crate holds, times e to the power of mu by the quarter turn on the
    post (L. Euler, J. A. Eytelwein); with no pull it is slack, and never pushes."""
    rng = Random(seed)
    rough, mu, high = rng.uniform(0.2, 0.9), rng.uniform(0.05, 0.4), rng.uniform(0.3, 2.5)
    weight, at = rng.uniform(50.0, 500.0), rng.uniform(0.3, 0.7)
    answer = icsolve.solve(
        icsolve.load(f"""icsolve: 1
points: {{A: [0, 0], B: [1, 0], G: [{at}, 0.8], H: [1, {high}], P: [4, {high - 0.25}], E: [4.25, -3]}}
joints:
  - {{contact: [1, 2], at: A, normal: 90, mu: {rough}}}
  - {{contact: [1, 2], at: B, normal: 90, mu: {rough}}}
  - {{rope: [H, P, E], on: [2, 1], radii: {{P: 0.25}}, wraps: {{P: cw}}, mu: {{P: {mu}}}}}
loads:
  W: {{weight: {weight}, link: 2, at: G}}
  T: {{force: unknown, at: E}}
""")
    )
    slides, tips = rough * weight, weight * (1.0 - at) / high
    most = min(slides, tips) * math.exp(mu * math.pi / 2.0)
    assert answer.answers["T"].holds == pytest.approx((0.0, most), rel=1e-9)
    assert answer.answers["T"].error <= 1e-9 * most
    assert any("would have to pull: it parts there" in note for note in answer.notes) is (tips < slides)


@pytest.mark.parametrize("seed", range(few(12)))
def test_whole_turns_are_added_to_the_angle_that_the_figure_shows(seed: int) -> None:
    """Each multiplies the ratio of the pulls by exp(2 pi mu); parts of a turn, which the figure has, are
    refused in a case, as a number that is set and in a row."""
    rng = Random(f"turns {seed}")
    mu, more = rng.randint(1, 40) / 100, rng.randint(0, 4)
    part = rng.choice([0.25, 0.5, 1.75, 2.5, 1e-9])

    def bollard(turns: float) -> str:
        return f"""icsolve: 1
points: {{A: [-1, 0.3], O: [0, 0], B: [1, 0.3]}}
joints:
  - rope: [A, O, B]
    on: [2, 1]
    radii: {{O: 0.3}}
    wraps: {{O: ccw}}
    turns: {{O: {turns}}}
    mu: {{O: {mu}}}
  - {{slide: [2, 1], at: A, along: 0}}
loads: {{W: {{force: 100, link: 2, at: A, angle: 180}}, F: {{force: unknown, at: B}}}}
motion: {{point: A, link: 2, speed: 1, angle: 180}}
"""

    path = "joints.A-O-B.turns.O"
    case = icsolve.load(bollard(0))
    least = icsolve.solve(case).answers["F"].value
    assert least is not None and least > 0.0
    rows = icsolve.sweep(case, {path: [more, more + 1]}).answers["F"]
    pulls = [icsolve.solve(icsolve.load(bollard(more))).answers["F"].value, *rows]
    for pull, turns in zip(pulls, (more, more, more + 1), strict=True):
        assert pull == pytest.approx(least * math.exp(-2.0 * math.pi * mu * turns), rel=1e-12)
    for refused in (
        lambda: icsolve.load(bollard(more + part)),
        lambda: icsolve.load(bollard(0), settings={path: more + part}),
        lambda: icsolve.sweep(case, {path: [more, more + part]}),
    ):
        with pytest.raises((CaseError, ValueError), match="whole"):
            refused()
