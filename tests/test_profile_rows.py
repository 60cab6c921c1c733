"""Rows of cams beside the ends of strokes and dwells, and where pieces of a profile meet, are scenes.

There the answer of a row passes zero, or a force infinity: a row has the status of `solve` with its angle
written into the case, and its value to a unit of the last place. The cam is the tangent cam of Uicker,
Pennock and Shigley, ch. 5: a base circle on which the follower dwells, a nose, and flanks.
"""

from __future__ import annotations

import math
import os
from random import Random

import numpy as np
import pytest
from mpmath import mp, mpc, mpf

from cams import HEAD, swinging
from icsolve.case import Case
from icsolve.errors import SceneError
from icsolve.read import load
from icsolve.solve import solve
from icsolve.sweep import sweep
from icsolve.sweep.varied_numbers import with_numbers
from icsolve.tuples import replace
from sizes import sampled

mp.dps = 60
FULL = bool(os.environ.get("ICSOLVE_FULL"))
BASE, NOSE, APART = 40.0, 15.0, 40.0
FLANK = math.degrees(math.acos((BASE - NOSE) / APART))
FOLLOWERS = {
    "roller": ("{roller: B, radius: 10}", 0.0),
    "offset roller": ("{roller: B, radius: 10}", 6.0),
    "flat face": ("{flat: B, along: 0}", 0.0),
    "knife edge": ("{knife: B}", 3.0),
    "roller on an arm": ("{roller: E, radius: 10}", None),
    "face on an arm": ("{flat: D, along: [D, E]}", None),
    "knife edge on an arm": ("{knife: E}", None),
}


def cam(follower: str, unknown: str, degrees: float) -> Case:
    """The tangent cam, whose arcs end at points that turn with it, under a follower."""
    shape, offset = FOLLOWERS[follower]
    arm = offset is None
    rest = ", DE: 100" if arm else ""
    given, sought = ("100", "unknown") if unknown == "T" else ("unknown", "500")
    push = f"{{torque: {given}, link: 3}}" if arm else f"{{force: {given}, link: 3, at: B, angle: -90}}"
    return load(
        f"{HEAD}points: {{A: [0, 0], {'D: [120, 0]' if arm else f'B: [{offset}, unknown]'}}}\n"
        f"lengths: {{AC: {APART}, AP: {BASE}, AQ: {BASE}, CU: {NOSE}, CV: {NOSE}{rest}}}\n"
        f"angles: {{AC: {degrees}, CAP: {FLANK}, CAQ: {-FLANK}, ACU: {180 - FLANK}, ACV: {FLANK - 180}}}\n"
        f"near: {'{E: [40, 60]}' if arm else f'{{B: [{offset}, 60]}}'}\n"
        "profile:\n"
        f"  2: {{arcs: [{{centre: A, radius: {BASE}, from: P, to: Q}},"
        f" {{centre: C, radius: {NOSE}, from: U, to: V}}]}}\n"
        f"  3: {shape}\n"
        "joints: [{pin: [1, 2], at: A}, {contact: [2, 3]},"
        f" {'{pin: [3, 1], at: D}' if arm else '{slide: [3, 1], at: B, along: 90}'}]\n"
        f"links: {{2: [C, P, Q, U, V]{', 3: [E]' if arm else ''}}}\n"
        f"loads: {{P: {push}, T: {{torque: {sought}, link: 2}}}}\n"
    )


def edges(follower: str) -> tuple[float, float, float]:
    """Directions of the nose at which the dwell ends, the follower turns back, and the dwell begins."""
    shape, offset = FOLLOWERS[follower]
    out = 10.0 if "roller" in follower else 0.0

    def normal(reach: float) -> float:
        """Direction from the axis to a follower at rest that far off, or of its face's normal."""
        if offset is not None:
            return 90.0 if "flat" in shape else math.degrees(math.acos(offset / reach))
        cosine = reach / 120.0 if "flat" in shape else (reach**2 + 120.0**2 - 100.0**2) / (240.0 * reach)
        return math.degrees(math.acos(cosine))

    low, high = normal(BASE + out), normal(APART + NOSE + out)
    return low - FLANK, high, low + FLANK


def check(case: Case, unknown: str, at: float, offs: list[float]) -> None:
    """Rows so far from a place against their scenes; beyond a thousandth of a degree they may be solved in
    doubles, without bounds."""
    rows = [at + off for off in offs]
    found = sweep(case, {"angles.AC": np.array(rows)}, ("answers", "status", "points"))
    for n, row in enumerate(rows):
        near = {name: (float(at[n, 0]), float(at[n, 1])) for name, at in found.points.items()}
        near = {name: at for name, at in near.items() if math.isfinite(at[0])} or case.near
        status, value = "ok", math.nan
        try:
            answer = solve(replace(with_numbers(case, {"angles.AC": row}), near=near)).answers[unknown]
            value = float(answer.value or 0.0)
        except SceneError as refusal:
            status = refusal.status
        assert found.status[n] == status, row
        error = 4.0 * math.ulp(value) if abs(offs[n]) < 1e-3 else 1e-11 * abs(value)
        assert status != "ok" or abs(found.answers[unknown][n] - value) <= error, row


KINDS = [(follower, unknown) for follower in FOLLOWERS for unknown in "TP"]


@pytest.mark.parametrize(("follower", "unknown"), KINDS if FULL else Random("rows of cams").sample(KINDS, 3))
def test_rows_beside_strokes_and_dwells_are_scenes(follower: str, unknown: str) -> None:
    rng = Random(f"{follower} {unknown}")
    case = cam(follower, unknown, rng.choice([60.0, -80.0]))  # written on the flank, or in the dwell
    for at in edges(follower) if FULL else rng.sample(edges(follower), 1):
        offs = [s * 10.0**-k * rng.uniform(0.3, 1.0) for k in range(2, 14) for s in (1.0, -1.0)]
        check(case, unknown, at, offs if FULL else rng.sample(offs, 3))


@sampled(3)
@pytest.mark.parametrize("seed", range(3 if not FULL else 30))
def test_with_friction_rows_beside_a_follower_at_rest_are_right_to_the_last_digit(seed: int) -> None:
    """Where the arm turns back the normal goes through the cam's axis, so that the normal force has next to
    no moment about it, and its friction all: F = N (n - mu s t), N by the moments about the arm's pivot."""
    rng = Random(seed)
    e, radius, roller, mu = rng.uniform(5, 9), rng.uniform(30, 40), rng.uniform(8, 15), rng.choice((0.1, 0.3))
    x, y, radius, roller = (round(v, 2) for v in (e * 0.7, e * 0.7, radius, roller))
    case = load(
        f"{HEAD}points: {{A: [0, 0], D: [120, 0]}}\nlengths: {{DE: 100}}\nnear: {{E: [40, 60]}}\n"
        f"profile: {{2: {{circle: [{x}, {y}], radius: {radius}}}, 3: {{roller: E, radius: {roller}}}}}\n"
        f"joints: [{{pin: [1, 2], at: A}}, {{contact: [2, 3], mu: {mu}}}, {{pin: [3, 1], at: D}}]\n"
        "loads: {M: {torque: 100, link: 3}, T: {torque: unknown, link: 2}}\nmotion: {link: 2, turns: ccw}\n"
    )
    away, reach = mp.sqrt(mpf(repr(x)) ** 2 + mpf(repr(y)) ** 2), mpf(repr(radius)) + mpf(repr(roller))
    for far in (reach + away, reach - away):  # of the roller's centre from the axis, at rest
        up = mp.acos((120**2 + far**2 - 100**2) / (240 * far))
        rest = mp.degrees(up - mp.atan2(y, x)) + (0 if far > reach else 180)
        rows = [float(rest) + s * 10.0**-k * rng.uniform(0.3, 1.0) for k in (6, 9, 11, 13) for s in (1, -1)]
        found = sweep(case, want=("answers", "error"), drive={"2": np.array(rows)})
        for row, value, error in zip(rows, found.answers["T"], found.error["T"], strict=True):
            angle = mp.atan2(mpf(repr(y)), mpf(repr(x))) + mp.radians(mpf(repr(row)))
            cx, cy = away * mp.cos(angle), away * mp.sin(angle)
            dx, apart = cx - 120, mp.hypot(cx - 120, cy)
            arm = mp.atan2(cy, dx) - mp.acos((100**2 + apart**2 - reach**2) / (200 * apart))
            nx, ny = (120 + 100 * mp.cos(arm) - cx) / reach, (100 * mp.sin(arm) - cy) / reach
            px, py = cx + mpf(repr(radius)) * nx, cy + mpf(repr(radius)) * ny
            fx, fy = nx - mpf(repr(mu)) * ny, ny + mpf(repr(mu)) * nx  # with the cam's surface, ccw
            true = -100 * (px * fy - py * fx) / ((px - 120) * fy - py * fx)
            assert abs(value - true) <= error <= 4.0 * math.ulp(value), (row, value, true)


@sampled(2)
@pytest.mark.parametrize("seed", range(2 if not FULL else 20))
def test_a_knife_edge_that_only_grazes_an_edge_rests_on_it(seed: int) -> None:
    """The tip of an arm goes in and out again through one edge of a block, at places as near to each other as
    the root of how far it is from missing the block altogether. With the edge at the distance s from the
    cam's axis, its normal in the direction w, and q = (d cos w - s) / r, the arm's direction is
    w + 180 - acos q."""
    rng = Random(seed)
    side, turned = rng.uniform(18.8, 19.3), math.radians(8.6)
    c, k = side * math.cos(turned), side * math.sin(turned)
    corners = [(c - k, k + c), (-c - k, -k + c), (-c + k, -k - c), (c + k, k - c)]
    written = [(round(x, 2), round(y, 2)) for x, y in corners]
    case = swinging(f"{{polygon: [{', '.join(f'[{x}, {y}]' for x, y in written)}]}}", "{knife: E}")
    case = replace(case, near={"E": (20.3, -7.0)})
    (px, py), (qx, qy) = ([mpf(repr(v)) for v in written[n]] for n in (3, 0))
    along = mp.hypot(qx - px, qy - py)
    normal, s = mp.atan2(px - qx, qy - py), (px * (qy - py) - py * (qx - px)) / along
    least = mp.degrees(mp.acos((100 + s) / 120) - normal)
    rows = [float(least) + 10.0**-k * rng.uniform(0.3, 1.0) for k in range(1, 12)]
    ends = {"2": np.array([*rows, float(least) - 1e-9])}
    assert sweep(case, drive=ends).status.tolist() == ["ok"] * len(rows) + ["cannot-assemble"]
    found = sweep(case, want=("answers", "error"), drive=ends)
    for row, value, error in zip(rows, found.answers["T12"], found.error["T12"], strict=False):
        w = normal + mp.radians(mpf(repr(row)))
        q = (120 * mp.cos(w) - s) / 100
        true = -100 * (1 - mpf("1.2") * mp.sin(w) / mp.sqrt(1 - q * q))
        assert abs(value - true) <= error <= 4.0 * math.ulp(value), row


def arm(corners: list[tuple[float, float]], d: float, reach: float, near: tuple[float, float]) -> Case:
    """A knife edge on an arm about D at (d, 0) on a polygon that turns about A; M of 100 acts on the arm."""
    shape = f"{{polygon: [{', '.join(f'[{x}, {y}]' for x, y in corners)}]}}"
    text = (
        f"{HEAD}points: {{A: [0, 0], D: [{d}, 0]}}\nlengths: {{DE: {reach}}}\n"
        f"near: {{E: [{near[0]}, {near[1]}]}}\nprofile: {{2: {shape}, 3: {{knife: E}}}}\n"
        "joints: [{pin: [1, 2], at: A}, {contact: [2, 3]}, {pin: [3, 1], at: D}]\nlinks: {3: [E]}\n"
        "loads: {M: {torque: 100, link: 3}, T: {torque: unknown, link: 2}}\n"
    )
    return load(text)


def tips_on(corners: list[tuple[float, float]], d: float, reach: float, row: float) -> list[tuple[mpc, mpf]]:
    """The tip of the arm, on each edge (p, q) that it can reach, and the torque on the cam there: the tip is
    p + x u, u from p to q, on the circle about the arm's pivot; T2 / T3 = -h2 / h3, the normal's arms."""
    turn, pivot, found = mp.expj(mp.radians(mpf(repr(row)))), mpc(repr(d)), []
    places = [mpc(repr(x), repr(y)) * turn for x, y in corners]
    for p, q in zip(places, [*places[1:], places[0]], strict=True):
        u, w = (q - p) / abs(q - p), p - pivot
        along = (mp.conj(u) * w).real
        square = along**2 - abs(w) ** 2 + mpf(repr(reach)) ** 2
        for root in (mp.sqrt(square), -mp.sqrt(square)) if square > 0 else ():
            if 0 <= root - along <= abs(q - p):
                at, n = p + (root - along) * u, -1j * u
                found.append((at, -100 * (mp.conj(at) * n).imag / (mp.conj(at - pivot) * n).imag))
    return found


@sampled(4)
@pytest.mark.parametrize("seed", range(4 if not FULL else 200))
def test_a_knife_edge_on_an_arm_beside_a_corner_is_right_to_the_last_digit(seed: int) -> None:
    """Also where it goes in through one edge and out again through the next, and with and without bounds."""
    rng, tips = Random(f"arm {seed}"), []
    while not tips:
        count, base, d = rng.choice((3, 4, 5)), rng.uniform(0.0, 360.0), float(rng.randint(100, 130))
        reach = round(rng.uniform(0.75, 0.95) * d, rng.choice((0, 2, 5)))
        ways = [math.radians(base + 360.0 * k / count + rng.uniform(-15.0, 15.0)) for k in range(count)]
        sizes = [rng.uniform(22.0, 40.0) for _ in ways]
        corners = [
            (round(r * math.cos(w), 3), round(r * math.sin(w), 3)) for r, w in zip(sizes, ways, strict=True)
        ]
        corner = mpc(*map(repr, rng.choice(corners)))
        cosine = (abs(corner) ** 2 + mpf(d) ** 2 - mpf(repr(reach)) ** 2) / (2 * abs(corner) * d)
        tips = [tip for tip, _ in tips_on(corners, d, reach, 0.0) if cosine < 1]
    place = float(mp.degrees(mp.acos(cosine) * rng.choice((1, -1)) - mp.arg(corner)) % 360)
    rows = [place + s * 10.0**-k * rng.uniform(0.3, 1.0) for k in range(2, 14) for s in (1.0, -1.0)]
    highest = max(tips, key=lambda tip: tip.imag)
    case = arm(corners, d, reach, (float(highest.real), float(highest.imag)))
    turned = {"2": np.array(rows)}
    bare, found = sweep(case, drive=turned), sweep(case, want=("answers", "status", "error"), drive=turned)
    assert bare.status.tolist() == found.status.tolist()
    assert set(found.status) <= {"ok", "cannot-assemble"}
    for n in np.flatnonzero(found.status == "ok").tolist():
        value, error = found.answers["T"][n], found.error["T"][n]
        true = min((one for _, one in tips_on(corners, d, reach, rows[n])), key=lambda one: abs(one - value))
        assert abs(value - true) <= error <= 4.0 * math.ulp(value), (rows[n], value, true)
        assert abs(bare.answers["T"][n] - true) <= 1e-10 * abs(true), (rows[n], true)


def test_a_knife_edge_that_just_passes_a_corner_has_no_answer_there() -> None:
    """Of the last places in which it cuts the corner off doubles may miss one; of the next ones none is told
    to have an answer."""
    corners = [(6.121, 22.846), (-21.326, 12.508), (-26.814, -22.557), (12.109, -27.387), (39.309, 6.119)]
    case, limit, told = arm(corners, 111.48582, 88.0, (20.3, 40.0)), 291.0287823673611, 0
    rows = [limit + n * math.ulp(limit) for n in range(-8, 9)]
    found = sweep(case, drive={"2": np.array(rows)})
    for row, status, value in zip(rows, found.status, found.answers["T"], strict=True):
        assert status in {"ok", "cannot-assemble", "unsupported"}
        if status == "ok":
            told += 1
            (true,) = (one for _, one in tips_on(corners, 111.48582, 88.0, row) if abs(one - value) < 30.0)
            assert abs(value - true) <= math.ulp(value)
    assert told


FRAMED = """icsolve: 1
units: {length: mm, force: N, torque: N*mm}
points: {A: [0, 0], G: [0, HIGH]}
lengths: {AC: 12, UG: 20, LG: 80}
angles: {AC: 70, GU: -90, GL: -90}
profile:
  2: {circle: C, radius: 30}
  3: {flat: U, along: 0}
  4: {flat: L, along: 0}
joints:
  - {pin: [1, 2], at: A}
  - {contact: [2, 3]}
  - {contact: [2, 4]}
  - {weld: [3, 4], at: G}
  - {slide: [3, 1], at: G, along: 90, through: A}
loads:
  F: {force: 300, link: 3, at: G, angle: -90}
  T: {torque: unknown, link: 2}
"""


@pytest.mark.parametrize("high", ["61.276", "61.27631144943", "61.27631144943016"])
@pytest.mark.parametrize("by", ["angles.AC", "2"])
def test_an_eccentric_in_a_frame_drives_it_by_both_faces(high: str, by: str) -> None:
    """The two faces are one body: T = F e cos of its angle in every row, however many decimals the frame's
    place has."""
    case = load(FRAMED.replace("HIGH", high))
    turned = np.arange(-70.0, 290.0, 60.0)
    if by == "2":
        swept = sweep(case, drive={by: turned}, want=("answers", "status"))
    else:
        swept = sweep(case, vary={by: 70.0 + turned}, want=("answers", "status"))
    assert set(swept.status) == {"ok"}
    assert swept.answers["T"] == pytest.approx(3600.0 * np.cos(np.radians(70.0 + turned)), rel=1e-9, abs=1e-6)


def test_an_oval_in_a_frame_binds_wherever_it_is_narrower_or_wider() -> None:
    """A cam whose breadth is not constant: it turns in its frame in no position but the one as written."""
    oval = "{about: C, zero: 0, radii: {0: 36, 90: 30, 180: 36, 270: 30}}"
    text = FRAMED.replace("{circle: C, radius: 30}", oval).replace("HIGH", "62").replace("AC: 70", "AC: 90")
    swept = sweep(load(text), vary={"angles.AC": [80.0, 90.0, 91.0, 150.0]})
    assert [status == "ok" for status in swept.status] == [False, True, False, False]
