"""Answers from contacts on profiles, within a unit in the last place of sixty digits of their own.

Closed forms: R. L. Norton, Design of Machinery, ch. 8; the spline is solved here as a dense system.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from random import Random

import numpy as np
import pytest
from mpmath import cos, findroot, lu_solve, matrix, mp, mpc, mpf, pi, sin, sqrt

from cams import sliding, swinging, table
from icsolve.answer import Found
from icsolve.case import Case
from icsolve.errors import SceneError
from icsolve.read import load
from icsolve.solve import solve
from icsolve.sweep import sweep
from sizes import MORE, crossed, sampled

Vector = tuple[mpf, mpf]


def held(found: Found, true: mpf) -> None:
    """Within an ulp, and within the error that is stated, which is two of them at most."""
    off, ulp = abs(mpf(found.value) - true), math.ulp(found.value)
    assert off <= ulp, (found, true)
    assert found.error is not None and off <= found.error <= 2.0 * ulp, (found, true)


def pressed(at: Vector, normal: Vector) -> mpf:
    """The torque on a cam about the origin on which 100 presses down through an upright guide."""
    return 100 * (at[0] * normal[1] - at[1] * normal[0]) / normal[1]


def decimal(rng: Random, low: float, high: float) -> float:
    return round(rng.uniform(low, high), rng.choice((0, 1, 3, 6)))


def on_circle(degrees: mpf, e: float, r: float, roller: float, offset: float) -> mpf:
    """The torque under a roller or a knife edge."""
    cx, cy = e * cos(degrees * pi / 180), e * sin(degrees * pi / 180)
    x = mpf(offset) - cx
    n = (x / (mpf(r) + roller), sqrt(1 - (x / (mpf(r) + roller)) ** 2))
    return pressed((cx + r * n[0], cy + r * n[1]), n)


def exactly(value: float) -> mpf:
    return mpf(repr(value))


@pytest.mark.parametrize("seed", range(6 * MORE))
def test_rollers_and_knife_edges_on_circles(seed: int) -> None:
    rng = Random(100 + seed)
    degrees, e, r = decimal(rng, -180, 180), decimal(rng, 5, 20), decimal(rng, 30, 50)
    offset, roller = decimal(rng, -9, 9), rng.choice((0.0, decimal(rng, 3, 15)))
    if seed % 2:  # beside the place where the normal goes through the axis: next to no torque
        degrees, offset = 90.0 + rng.choice((1, -1)) * 10.0 ** -rng.uniform(3, 12), 0.0
    follower = f"{{roller: B, radius: {roller!r}}}" if roller else "{knife: B}"
    case = sliding(f"{{circle: C, radius: {r!r}}}", follower, degrees=degrees, offset=offset, e=e)
    true = on_circle(exactly(degrees), *map(exactly, (e, r, roller, offset)))
    held(solve(case).answers["T12"], true)


@pytest.mark.parametrize("seed", range(4 * MORE))
def test_a_swinging_face_and_a_swinging_roller_on_a_circle(seed: int) -> None:
    """By the arm of the normal about both pivots: T2 / T3 = -h2 / h3."""
    rng = Random(200 + seed)
    degrees, e, written = decimal(rng, -60, 180), decimal(rng, 5, 20), decimal(rng, 110, 130)
    d = exactly(written)
    x, y = (exactly(e) * turn(exactly(degrees) * pi / 180) - at for turn, at in ((cos, d), (sin, 0)))
    far = sqrt(x * x + y * y)
    if seed % 2:  # a face through D, 40 from C
        case = swinging(
            "{circle: C, radius: 40}", "{flat: D, along: [D, E]}", degrees=degrees, e=e, d=written
        )
        part = 40 / far
        rest = sqrt(1 - part**2)
        n = max(
            (((-part * x + w * y) / far, (-part * y - w * x) / far) for w in (rest, -rest)),
            key=lambda n: n[1],
        )
        at = (x + d + 40 * n[0], y + 40 * n[1])
    else:  # a roller about E, 100 from D and 50 from C
        case = swinging("{circle: C, radius: 40}", "{roller: E, radius: 10}", degrees=degrees, e=e, d=written)
        along = (far**2 + 10000 - 2500) / (2 * far)
        up = sqrt(10000 - along**2)
        u = (x / far, y / far)
        to = (along * u[0] + up * u[1], along * u[1] - up * u[0])
        n = ((to[0] - x) / 50, (to[1] - y) / 50)
        at = (x + d + 40 * n[0], y + 40 * n[1])
    found = solve(case).answers["T12"]
    h2 = at[0] * n[1] - at[1] * n[0]
    h3 = (at[0] - d) * n[1] - at[1] * n[0]
    held(found, -100 * h2 / h3)


class DenseSpline:
    """The periodic cubic spline through a table, by its slopes at the places: a dense system."""

    def __init__(self, rows: list[tuple[float, float]]) -> None:
        self.x, self.y = ([exactly(row[k]) for row in rows] for k in (0, 1))
        n = len(rows)
        self.h = [(self.x[(k + 1) % n] - self.x[k]) % 360 for k in range(n)]
        a, b = matrix(n, n), matrix(n, 1)
        for k in range(n):
            i, j = (k - 1) % n, (k + 1) % n
            a[k, i] += 1 / self.h[i]
            a[k, j] += 1 / self.h[k]
            a[k, k] += 2 / self.h[i] + 2 / self.h[k]
            b[k] = 3 * ((self.y[k] - self.y[i]) / self.h[i] ** 2 + (self.y[j] - self.y[k]) / self.h[k] ** 2)
        self.m = lu_solve(a, b)

    def at(self, x: mpf) -> tuple[mpf, mpf]:
        """Value and slope, per degree (Hermite's form)."""
        k = max(k for k in range(len(self.x)) if self.x[k] <= x % 360)
        j, h = (k + 1) % len(self.x), self.h[k]
        t = (x % 360 - self.x[k]) / h
        p, q, u, v = self.y[k], self.y[j], self.m[k] * h, self.m[j] * h
        value = p + t * u + t * t * (3 * (q - p) - 2 * u - v) + t**3 * (2 * (p - q) + u + v)
        slope = (u + 2 * t * (3 * (q - p) - 2 * u - v) + 3 * t * t * (2 * (p - q) + u + v)) / h
        return value, slope


@pytest.mark.parametrize("seed", range(4 * MORE))
def test_rollers_on_tables_of_radii(seed: int) -> None:
    """Also where a knife edge stands on a place of the table, between two cubics."""
    rng = Random(300 + seed)
    places = sorted(rng.sample(range(0, 360, 15), rng.choice((4, 9, 12))) if seed else [0, 50, 180, 270])
    places[0] = 0
    rows = [(float(x), decimal(rng, 38, 48)) for x in places]
    degrees = decimal(rng, -180, 180) if seed else 40.0
    roller = decimal(rng, 3, 10) if seed else 0.0
    follower = f"{{roller: B, radius: {roller!r}}}" if roller else "{knife: B}"
    found = solve(sliding(table(rows), follower, degrees=degrees)).answers["T12"]
    spline, zero = DenseSpline(rows), exactly(degrees)

    def touch(at: mpf) -> tuple[Vector, Vector]:
        way, (r, slope) = (zero + at) * pi / 180, spline.at(at)
        c, s, slope = cos(way), sin(way), slope * 180 / pi
        x, y = slope * s + r * c, r * s - slope * c
        size = sqrt(x * x + y * y)
        return (r * c, r * s), (x / size, y / size)

    def beside(at: mpf) -> mpf:
        (x, _), (nx, _) = touch(at)
        return x + exactly(roller) * nx

    at = findroot(beside, (90 - zero) % 360, tol=mpf(10) ** -100) if roller else 90 - zero
    held(found, pressed(*touch(at)))


FLAT = """
icsolve: 1
units: {length: mm, force: N, torque: N*mm}
points: {A: [0, 0], B: [0, unknown]}
lengths: {AC: 50}
angles: {AC: %s}
near: {B: [0, 60]}
profile:
  2: %s
  3: {flat: B, along: %s}
joints: [{pin: [1, 2], at: A}, {contact: [2, 3]}, {slide: [3, 1], at: B, along: 90}]
links: {2: [C]}
loads: {P: {force: 100, link: 3, at: B, angle: -90}, T12: {torque: unknown, link: 2}}
"""
TWO_ARCS = "{arcs: [{centre: A, radius: 40, from: 120, to: 0}, {centre: C, radius: 15, from: 0, to: 120}]}"


def flat(angle: str, shape: str, along: str) -> Case:
    return load(FLAT.strip() % (angle, shape, along))


def test_faces_on_arcs_and_on_corners() -> None:
    """A face that leans by 10 degrees touches the nose where its normal goes through the nose's centre."""
    lean = 10 * pi / 180
    n = (-sin(lean), cos(lean))
    c = (50 * cos(pi / 3), 50 * sin(pi / 3))
    held(solve(flat("60", TWO_ARCS, "10")).answers["T12"], pressed((c[0] + 15 * n[0], c[1] + 15 * n[1]), n))
    corner = flat("60", "{polygon: [[-30, -30], [40, -30], [5, 40]]}", "10")
    held(solve(corner).answers["T12"], pressed((mpf(5), mpf(40)), n))


ENDS = FLAT.replace("lengths: {AC: 50}", "lengths: {AC: 40, AP: %s, AQ: %s, CU: 10, CV: 10}")
ENDS = ENDS.replace("{AC: %s}", "{AC: %s, CAP: 60.001, CAQ: -60.001, ACU: 119.999, ACV: -119.999}")
ENDS = ENDS.replace("{2: [C]}", "{2: [C, P, Q, U, V]}")
ARCS = "{arcs: [{centre: A, radius: 30, from: P, to: Q}, {centre: C, radius: 10, from: U, to: V}]}"


def turn(degrees: mpf | int) -> mpc:
    return mpc(cos(degrees * pi / 180), sin(degrees * pi / 180))


def torque(at: mpc, normal: mpc) -> mpf:
    return pressed((at.real, at.imag), (normal.real, normal.imag))


def beside(kind: Callable[[mpf], object], low: mpf, rng: Random) -> list[float]:
    """Places about the one, within a degree, where what is touched changes."""
    first, high = kind(low), low + 1
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if kind(middle) == first else (low, middle)
    return [float(low) + sign * 10.0 ** -rng.uniform(2, 12.5) for sign in (1, -1, 1, -1)]


def swept(case: Case, rows: list[float], truth: Callable[[float], mpf]) -> None:
    """Rows are within their bounds; those in doubles, of some thousands, within 1e-8."""
    told = sweep(case, {"angles.AC": np.array(rows)}, ("answers", "status", "error"))
    found = sweep(case, {"angles.AC": np.array(rows)}, ("answers", "status"))
    assert set(found.status) == set(told.status) == {"ok"}
    for n, row in enumerate(rows):
        true = truth(row)
        assert abs(mpf(found.answers["T12"][n]) - true) <= 1e-8, row
        assert abs(mpf(told.answers["T12"][n]) - true) <= told.error["T12"][n] or not true, row


@sampled(3)
@pytest.mark.parametrize(("lean", "side"), crossed([0, 5, -12], [1, -1]))
def test_a_face_rests_on_the_end_of_a_flank_that_it_meets_first(lean: int, side: int) -> None:
    """Flanks join arcs that go on a thousandth of a degree beyond their tangents: between the arcs a face
    rests on their ends, which lie 1e-9 of the size beyond one another."""
    n, up, down = turn(90 + lean), turn(mpf("60.001")), turn(-mpf("60.001"))

    def rests(degrees: mpf) -> tuple[bool, mpc]:
        """Whether on the base circle, and where."""
        out = n / turn(degrees)
        ends = [30 * up, 30 * down, 40 + 10 * up, 40 + 10 * down]
        ends.append(30 * out if out.real < up.real else 40 + 10 * out)
        k = max(range(5), key=lambda k: (ends[k] / out).real)
        dwells = k == 4 and out.real < up.real
        return dwells, ends[k] * turn(degrees)

    rng = Random(lean)
    rows = beside(lambda x: rests(x)[0], mpf(90 + lean - side * 60) - mpf("0.6"), rng)
    case = load(ENDS.strip() % (30, 30, repr(rows[0]), ARCS, lean))

    def truth(degrees: float) -> mpf:
        dwells, at = rests(exactly(degrees))
        return mpf(0) if dwells else torque(at, n)

    swept(case, rows + [round(row + rng.uniform(-0.01, 0.01), 6) for row in rows], truth)
    for degrees in rows:
        case = load(ENDS.strip() % (30, 30, repr(degrees), ARCS, lean))
        true, found = truth(degrees), solve(case).answers["T12"]
        if true:
            held(found, true)
        else:
            assert found.value == 0.0


@sampled(3, "follower")
@pytest.mark.parametrize("seed", sorted({*range(2 * MORE), 7}))
@pytest.mark.parametrize("follower", ["roller", "knife"])
def test_a_roller_or_a_knife_edge_goes_over_from_an_edge_to_the_next(follower: str, seed: int) -> None:
    """Of a triangle C, P, Q, about whose corners the roller turns."""
    rng = Random(400 + seed)
    size, r = decimal(rng, 20, 40), exactly(decimal(rng, 2, 12)) * (follower == "roller")
    corners = [mpc(40), exactly(size) * turn(mpf("130.001")), exactly(size) * turn(-mpf("130.001"))]

    def rests(degrees: mpf) -> tuple[int, mpc, mpc]:
        met = []
        for k, (p, q) in enumerate(
            (c * turn(degrees), corners[k - 2] * turn(degrees)) for k, c in enumerate(corners)
        ):
            if abs(p.real) < r:
                met.append((k, p, mpc(-p.real, sqrt(r * r - p.real**2)) / r))
            n = mpc(0, -1) * (q - p) / abs(q - p)
            share = -(p + r * n).real / (q - p).real
            if 0 < share < 1:
                met.append((3 + k, p + share * (q - p), n))
        return max(met, key=lambda one: (one[1] + r * one[2]).imag)

    places = (k + mpf("0.3") for k in range(rng.randint(-170, 0), 180))
    low = next(x for x in places if rests(x)[0] != rests(x + 1)[0])
    rows, shape = beside(lambda x: rests(x)[0], low, rng), "{knife: B}"
    if r:
        shape = f"{{roller: B, radius: {float(r)!r}}}"
    text = ENDS.strip().replace("{flat: B, along: %s}", shape).replace("60.001", "130.001")
    cases = [load(text % (repr(size), repr(size), repr(row), "{polygon: [C, P, Q]}")) for row in rows]
    swept(cases[0], rows, lambda row: torque(*rests(exactly(row))[1:]))
    for case, degrees in zip(cases, rows, strict=True):
        held(solve(case).answers["T12"], torque(*rests(exactly(degrees))[1:]))


@pytest.mark.parametrize("off", [9.1e-13, -4e-13, 2e-11])
def test_a_knife_edge_over_an_end_that_is_hardly_hollow_is_outside(off: float) -> None:
    """Where the base circle ends a thousandth of a degree before its tangent; or it is refused there."""
    text = ENDS.strip() % (30, 30, repr(90 + 60.001 + off), ARCS, 0)
    case = load(text.replace("{flat: B, along: 0}", "{knife: B}"))
    try:
        places = solve(case).points
    except SceneError:
        return
    assert places["B"][1] == pytest.approx(30.0, abs=1e-6)


def test_where_pieces_meet_no_bound_is_told() -> None:
    """Whether a knife edge stands on the corner is open: the reason says so."""
    case = sliding("{polygon: [[-30, -30], [40, -30], [0, 40]]}", "{knife: B}", more=", normal: 100")
    found = solve(case).answers["T12"]
    assert found.error is None and "corner" in found.why


def setup_module() -> None:
    mp.dps = 140
