"""Groups of points that only all their data together place: the solution is enclosed, and shown to be one."""

from __future__ import annotations

import math
from decimal import Decimal
from random import Random
from typing import Any

import pytest
from mpmath import mp

import icsolve
import loading
import mechanisms
import transcribe
from figures import without_order
from icsolve.assembly import solve_figure
from icsolve.errors import SceneError, Status
from icsolve.numbers.balls import INEXACT, Ball, Balls, MoreDigits
from icsolve.numbers.krawczyk import enclosed_root, turns_away
from sizes import sampled

many = mp.clone()
many.dps = 150


def circles(offset: str) -> Any:
    """Where the unit circle meets the line y = offset: x^2 + y^2 - 1 and y - offset."""

    def system(z: Any) -> Any:
        x, y = z
        balls = x.arithmetic
        level = balls.exactly(Decimal(offset))
        return [x * x + y * y - 1.0, y - level], [{0: x * 2.0, 1: y * 2.0}, {1: balls.ball(1.0)}]

    return system


@pytest.mark.parametrize("start", [math.nan, math.inf, "1e600000"])
def test_a_start_beyond_all_numbers_shows_no_root(start: float | str) -> None:
    """Forces of a scene whose data are 1e300 apart: what it solves for is refused in words."""
    with pytest.raises(MoreDigits):
        enclosed_root(circles("0.3"), [Decimal(start), Decimal("0.3")], Balls(60))


@pytest.mark.parametrize("digits", [30, 60, 120])
@pytest.mark.parametrize("offset", ["0.3", "-0.75", "0.99", "0.999999999"])
def test_the_root_lies_in_its_balls(digits: int, offset: str) -> None:
    y = many.mpf(offset)
    x = many.sqrt(1 - y * y)
    found = enclosed_root(circles(offset), [float(x) * (1 + 1e-13), float(y)], Balls(digits))
    for ball, true in zip(found, (x, y), strict=True):
        assert abs(many.mpf(str(ball.value)) - true) <= ball.radius < 10.0 ** (10 - digits)


@pytest.mark.parametrize("spread", [0.0, 0.2, 0.4])
def test_all_that_wide_data_allow_lies_in_the_ball(spread: float) -> None:
    """a x = 1e-8 with a within 1 - spread and 1 + spread."""

    def system(z: Any) -> Any:
        a = Ball(z[0].arithmetic, Decimal(1), spread, 2.0, INEXACT)
        return [a * z[0] - z[0].arithmetic.exactly(Decimal("1e-8"))], [{0: a}]

    (found,) = enclosed_root(system, [1e-8], Balls(30))
    for a in (1.0 - spread, 1.0, 1.0 + spread):
        assert abs(float(found.value) - 1e-8 / a) <= found.radius + 1e-23 < 1e-6


@pytest.mark.parametrize("start", [0.3, -0.1, 5.0])
def test_what_has_no_root_is_given_up_soon(start: float) -> None:
    """x^2 + 1: three steps of Newton, with a few looks about each."""
    calls = []

    def system(z: Any) -> Any:
        calls.append(z)
        return [z[0] * z[0] + 1.0], [{0: z[0] * 2.0}]

    with pytest.raises(MoreDigits):
        enclosed_root(system, [start], Balls(30))
    assert len(calls) <= 24


@pytest.mark.parametrize(
    ("gap", "away"), [("1e-40", True), ("1e-8", True), ("0", False), ("-1e-40", False), ("-1e-8", False)]
)
def test_newton_turns_away_where_there_is_no_root_however_narrow_the_gap(gap: str, away: bool) -> None:
    """x^2 + gap: the steps halve down to the root of the gap, and grow again where there is none."""

    def system(z: Any) -> Any:
        balls = z[0].arithmetic
        return [z[0] * z[0] + balls.exactly(Decimal(gap))], [{0: z[0] * 2.0}]

    assert turns_away(system, [1.0], Balls(120, highest=True)) is away
    assert not turns_away(system, [0.0], Balls(120, highest=True))  # there no step is known


@pytest.mark.parametrize("offset", ["1", "1.0000000000000001"])
def test_a_double_root_and_one_that_is_not_there_are_not_shown(offset: str) -> None:
    for digits in (30, 120):
        with pytest.raises((MoreDigits, ZeroDivisionError)):
            enclosed_root(circles(offset), [1e-9, 1.0], Balls(digits, highest=True))


@sampled(3)
@pytest.mark.parametrize("seed", range(3))
def test_a_double_butterfly_from_lengths_has_all_digits(seed: int) -> None:
    """Six points found together: every one rounded once, against Newton in 150 digits."""
    measured, k = None, seed
    while measured is None:
        measured, k = without_order(loading.drawn(k, mechanisms.butterfly), Random(k)), k + 1
    case = icsolve.load(transcribe.text(measured))
    answer = icsolve.solve(case, examine=True)
    places = {p: [many.mpf(c) for c in at] for p, at in answer.points.items()}
    places |= {p: [many.mpf(c.digits) for c in at] for p, at in case.points.items()}
    for _ in range(8):
        _newton(case, places)
    for p, at in answer.points.items():
        for shown, true in zip(at, places[p], strict=True):
            assert abs(shown - true) <= 2.0**-53 * abs(true) * 1.001 + many.mpf(10) ** -60, p


def _newton(case: icsolve.Case, places: dict[str, list[Any]]) -> None:
    """One step on all lengths, for the points that are not given."""
    free = [p for p in places if p not in case.points]
    column = {(p, k): 2 * n + k for n, p in enumerate(free) for k in (0, 1)}
    angles = [(a.a, a.b, a.value.digits) for a in case.angles]
    rows, right = many.matrix(2 * len(free), 2 * len(free)), many.matrix(2 * len(free), 1)
    equations = [(one.a, one.b, None, one.value.digits) for one in case.lengths]
    equations += [(a, b, degrees, None) for a, b, degrees in angles]
    for i, (a, b, degrees, length) in enumerate(equations):
        dx, dy = (places[b][k] - places[a][k] for k in (0, 1))
        if length is not None:
            value, by = (dx * dx + dy * dy - many.mpf(length) ** 2) / 2, (dx, dy)
        else:
            t = many.mpf(degrees) * many.pi / 180
            value, by = many.cos(t) * dy - many.sin(t) * dx, (-many.sin(t), many.cos(t))
        right[i] = value
        for k in (0, 1):
            for p, sign in ((a, -1), (b, 1)):
                if (p, k) in column:
                    rows[i, column[p, k]] += sign * by[k]
    move = many.lu_solve(rows, right)
    for (p, k), j in column.items():
        places[p][k] -= move[j]


PLATFORM = """
icsolve: 1
points: {{A: [0, 0], B: [5, 0], C: [3, 4], D: [-2, 3]}}
lengths: {{AP: 1.803, BQ: 1.664, CR: 1.612, PQ: 3.513, QR: 2.247, PR: 1.836, PS: 1.3, SD: {rod}}}
near: {{P: [0.6, 1.7], Q: [4.1, 1.4], R: [2.2, 2.6], S: [-0.5, 2.4]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [1, 3], at: B}}
  - {{pin: [1, 4], at: C}}
  - {{pin: [2, 5, 6], at: P}}
  - {{pin: [3, 5], at: Q}}
  - {{pin: [4, 5], at: R}}
  - {{pin: [6, 7], at: S}}
  - {{pin: [7, 1], at: D}}
"""


def reach() -> Any:
    """How far P, which Newton's method places with Q and R, is from D."""
    bars = [(0, 3, "1.803"), (1, 4, "1.664"), (2, 5, "1.612")]
    bars += [(3, 4, "3.513"), (4, 5, "2.247"), (3, 5, "1.836")]

    def off(*x: Any) -> list[Any]:
        at = [(0, 0), (5, 0), (3, 4), x[0:2], x[2:4], x[4:6]]
        return [many.hypot(at[i][0] - at[j][0], at[i][1] - at[j][1]) - many.mpf(n) for i, j, n in bars]

    x = many.findroot(off, (0.6, 1.7, 4.1, 1.4, 2.2, 2.6))
    return many.hypot(x[0] + 2, x[1] - 3)


@pytest.mark.parametrize("gap", ["1e-12", "1e-15", "1e-18", "1e-24"])
def test_a_step_after_a_group_is_judged_by_the_decimals(gap: str) -> None:
    """Two rods from a point that Newton's method places reach or not, by a hair that doubles do not see."""
    rod = reach() - many.mpf("1.3")
    longer, shorter = (PLATFORM.format(rod=many.nstr(rod + s * many.mpf(gap), 50)) for s in (1, -1))
    figure = solve_figure(icsolve.load(longer))
    assert [type(step).__name__ for step in figure.steps] == ["Given", "PointGroup", "Meet"]
    with pytest.raises(SceneError, match="too far") as refused:
        solve_figure(icsolve.load(shorter))
    assert refused.value.status == Status.CANNOT_ASSEMBLE


@pytest.mark.parametrize("off", [0.05, 0.3])
def test_a_root_of_many_equations_is_closed_in_on_from_a_rough_start(off: float) -> None:
    """x_k^2 + x_k+1 / 8 = k + 2, of twelve: more than inverses are taken of in each step, so that the first
    one leads nowhere near; against the fixed point in 150 digits."""
    count = 12

    def system(z: Any) -> Any:
        values = [z[k] * z[k] + z[(k + 1) % count] * 0.125 - (k + 2.0) for k in range(count)]
        return values, [{k: z[k] * 2.0, (k + 1) % count: z[k].arithmetic.ball(0.125)} for k in range(count)]

    true = [many.sqrt(k + 2) for k in range(count)]
    for _ in range(400):
        true = [many.sqrt(k + 2 - true[(k + 1) % count] / 8) for k in range(count)]
    start = [float(x) * (1.0 + off * (-1) ** k) for k, x in enumerate(true)]
    for ball, x in zip(enclosed_root(system, start, Balls(30)), true, strict=True):
        assert abs(many.mpf(str(ball.value)) - x) <= ball.radius < 1e-20
