"""Balls hold the exact result of every operation: against exact fractions and 400 digits of mpmath."""

from __future__ import annotations

import contextlib
import decimal
import itertools
import math
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

import pytest
from mpmath import mp

import icsolve
from icsolve.case import Number
from icsolve.numbers.balls import Ball, Balls, BelowZero, HalfUnits, MoreDigits
from icsolve.scene.parts import scene_of
from icsolve.sweep.find_on_record import Query, find
from icsolve.sweep.request import RequestError
from icsolve.sweep.varied_numbers import numbers_of
from library import FILES, sample
from sizes import sampled

CASES = Path(__file__).parent.parent / "cases"

many = mp.clone()
many.dps = 400
DIGITS = [7, 16, 30, 60, 120]


def exact(value: decimal.Decimal) -> Any:
    """A decimal, in 400 digits (none of those here has as many)."""
    return many.mpf(str(value))


def holds(ball: Any, true: Any) -> bool:
    """Whether a ball holds a number, and its size bounds its value."""
    if not isinstance(ball, Ball):
        return bool(
            abs(many.mpf(ball) - true) <= many.mpf(10) ** -250
        )  # half a turn of `many` has 400 digits
    assert ball.size >= abs(float(ball.value)) or not ball.value
    return bool(abs(exact(ball.value) - true) <= many.mpf(ball.radius) + many.mpf(10) ** -250)


def numeral(draw: Random) -> str:
    """A decimal of one to twenty digits, between 1e-12 and 1e12; now and then a zero."""
    if draw.random() < 0.05:
        return "0"
    digits = "".join(draw.choice("0123456789") for _ in range(draw.randint(1, 20)))
    return f"{draw.choice(['', '-'])}{int(digits) or 3}e{draw.randint(-20, -1)}"


def numbers(draw: Random, balls: Balls, count: int) -> list[tuple[Any, Any]]:
    """Numbers of a case, each as a ball and in 400 digits; some in another unit, some doubles."""
    found: list[tuple[Any, Any]] = []
    for k in range(count):
        text = numeral(draw)
        kind = draw.random()
        if kind < 0.6:
            found.append((balls.given(Number(float(text), 0.0, f"{k}", text)), many.mpf(text)))
        elif kind < 0.8:
            num, den, power = draw.randint(1, 10**9), draw.randint(1, 10**5), draw.choice([-1, 0, 0, 1])
            true = many.mpf(num) / den * many.pi**power
            found.append((balls.given(Number(float(true), 0.0, f"{k}", "0", 2.0, (num, den, power))), true))
        else:
            value = draw.choice([0.0, 1.0, 0.5, draw.uniform(-3.0, 3.0)])
            found.append((value, many.mpf(value)))
    return found


@sampled(4)
@pytest.mark.parametrize("digits", DIGITS)
@pytest.mark.parametrize("seed", range(40))
def test_every_operation_holds_its_exact_result(digits: int, seed: int) -> None:
    """Expressions of a hundred operations, differences of nearly equal numbers among them."""
    draw, balls = Random(f"{digits} {seed}"), Balls(digits)
    pool = numbers(draw, balls, 6)
    for _ in range(100):
        (a, x), (b, y) = draw.choice(pool), draw.choice(pool)
        a = balls.ball(a) if isinstance(a, float) else a
        operation = draw.choice(["+", "-", "*", "/", "sqrt", "neg", "near"])
        try:
            if operation == "+":
                made = a + b, x + y
            elif operation == "-":
                made = a - b, x - y
            elif operation == "*":
                made = a * b, x * y
            elif operation == "/":
                made = a / b, x / y
            elif operation == "neg":
                made = -a, -x
            elif operation == "near":
                made = (a + b) - a, y
            else:
                made = balls.sqrt(a), many.sqrt(x)
        except (MoreDigits, ZeroDivisionError):
            continue
        except BelowZero:
            assert x < 0
            continue
        assert holds(*made), operation
        if isinstance(made[0], Ball) and (made[0].is_certain or made[0].exact):
            assert made[0].sign == many.sign(made[1]), operation
        if many.mpf(10) ** -60 < abs(made[1]) < many.mpf(10) ** 60:
            pool[draw.randrange(len(pool))] = made


@pytest.mark.parametrize("digits", DIGITS)
def test_cosine_and_sine_hold_theirs(digits: int) -> None:
    draw, balls = Random(digits), Balls(digits)
    for k in range(60):
        drawn = repr(draw.uniform(-1e4, 1e4))
        text = draw.choice(["30", "45", "-90", "120", "359.9999999999999999", "1e-30", drawn])
        for found, function in zip(
            balls.turn(Number(float(text), 0.0, f"{k}", text)), (many.cos, many.sin), strict=True
        ):
            assert holds(found, function(many.mpf(text) * many.pi / 180)) or abs(found - 0.0) < 1e-300


@pytest.mark.parametrize("digits", DIGITS)
def test_directions_hold_theirs_and_lose_few_digits(digits: int) -> None:
    draw, balls = Random(f"direction {digits}"), Balls(digits)
    for k in range(40):
        texts = [draw.choice(["0", "1", "-1", numeral(draw)]) for _ in "xy"]
        if texts != ["0", "0"]:
            x, y = (
                balls.given(Number(float(t), 0.0, f"{axis}{k}", t))
                for axis, t in zip("xy", texts, strict=True)
            )
            found, true = balls.angle(x, y), many.degrees(many.atan2(*map(many.mpf, reversed(texts))))
            assert holds(found, true), texts
            assert not isinstance(found, Ball) or found.radius <= 10.0 ** (4 - digits)


def test_where_nothing_is_carried_on_a_ball_has_its_own_rounding_alone() -> None:
    """Half a unit of its last digit: of quotients, products, sums and roots."""
    balls = Balls(30, carried=0.0)
    third = balls.ball(1.0) / 3.0
    for _ in range(4):
        made_of = (
            third / (third + 1.0),
            third * third,
            third + third,
            third - 2.0,
            balls.sqrt(third),
            third.exp(),
        )
        for made in made_of:
            assert 0.0 < made.radius <= 5.1e-30 * made.size
        third = (third * 7.0) / (third + 2.0)


def test_an_angle_in_radians_is_converted_exactly() -> None:
    """180 / pi degrees a radian, to as many digits as are asked for."""
    for digits in DIGITS:
        c, s = Balls(digits).turn(Number(57.29577951308232, 0.0, "a", "1", 57.29577951308232, (180, 1, -1)))
        assert holds(c, many.cos(1))
        assert holds(s, many.sin(1))
        assert c.radius < 10.0 ** (2 - digits)


def test_the_bound_is_not_far_above_the_error() -> None:
    """Sixty digits lose no more than a few in a hundred well-conditioned operations."""
    balls, draw = Balls(60), Random(1)
    total: Any = balls.ball(1.0)
    for k in range(100):
        factor = balls.given(Number(0.0, 0.0, f"{k}", repr(draw.uniform(0.5, 2.0))))
        total = total * factor + 1.0 / (total + 3.0)
    assert total.radius <= 1e-56 * total.size


def test_right_angles_and_thirds_of_them_are_exact() -> None:
    balls = Balls(30)
    for degrees, (c, s) in {"0": (1, 0), "90": (0, 1), "-450": (0, -1), "540": (-1, 0)}.items():
        assert balls.turn(Number(0.0, 0.0, degrees, degrees)) == (c, s)
    for degrees, half in {"30": 1, "150": 1, "-30": -1, "210": -1}.items():
        assert balls.turn(Number(0.0, 0.0, degrees, degrees))[1] == half / 2
    for degrees, half in {"60": 1, "120": -1, "240": -1}.items():
        assert balls.turn(Number(0.0, 0.0, degrees, degrees))[0] == half / 2


@pytest.mark.parametrize("places", [20, 27, 28, 29, 39, 60, 110])
@pytest.mark.parametrize("digits", [30, 120])
def test_beside_thirds_of_right_angles_sines_and_cosines_are_those_of_the_angle(
    digits: int, places: int
) -> None:
    """However near: an angle that differs in its last places alone has a half no more."""
    balls = Balls(digits)
    for third, sign in itertools.product(range(-90, 300, 30), "+-"):
        text = str(
            decimal.Context(prec=200).add(decimal.Decimal(third), decimal.Decimal(f"{sign}1e-{places}"))
        )
        turned = balls.turn(Number(float(text), 0.0, text, text))
        true = many.radians(many.mpf(text))
        assert holds(turned[0], many.cos(true)) and holds(turned[1], many.sin(true)), text


def test_short_numbers_stay_exact_through_products_roots_and_quotients() -> None:
    """A determinant of decimals that vanishes is zero, and not a ball about it."""
    balls = Balls(30)
    x, y, z = (balls.given(Number(0.0, 0.0, t, t)) for t in ("1.25", "-0.37", "4.3e2"))
    found = (x * y - y * x) + (x * (y + z) - x * y - x * z)
    assert found == 0.0
    assert balls.vanishes(found, 1.0)
    assert balls.rounded(found) == (0.0, 0.0)
    assert balls.sqrt(balls.ball(9.0) + balls.ball(16.0)) == 5.0
    assert balls.ball(1.0) / balls.ball(8.0) == 0.125
    assert not (balls.ball(1.0) / balls.ball(3.0)).exact


def test_a_sign_that_is_open_asks_for_more_digits_and_a_root_below_zero_is_none() -> None:
    third = Balls(30).ball(1.0) / 3.0
    nothing = third * 3.0 - 1.0
    with pytest.raises(MoreDigits):
        assert nothing > 0.0
    with pytest.raises(MoreDigits):
        Balls(30).vanishes(nothing, 1.0)
    with pytest.raises(MoreDigits):
        Balls(30).sqrt(nothing)
    with pytest.raises(MoreDigits):
        _ = 1.0 / nothing
    with pytest.raises(BelowZero):
        Balls(30).sqrt(-third)


def test_balls_are_compared_as_the_numbers_that_they_are() -> None:
    balls = Balls(30)
    for x in (-0.5, 0.0, 0.25, 2.0):
        for y in (-0.5, 0.0, 0.25, 2.0):
            for one, two in ((balls.ball(x), y), (balls.ball(x), balls.ball(y))):
                assert ((one < two), (one <= two), (one > two), (one >= two), (one == two)) == (
                    (x < y), (x <= y), (x > y), (x >= y), (x == y)
                )  # fmt: skip


def test_at_the_highest_precision_what_lies_within_1e_40_of_its_terms_is_zero_and_says_how_far() -> None:
    balls = Balls(120, highest=True)
    nothing = (balls.ball(1.0) / 3.0) * 3.0 - 1.0
    assert balls.vanishes(nothing, 1.0)
    value, error = balls.rounded(nothing, 1.0)
    assert value == 0.0
    assert 0.0 < error < 1e-115
    assert balls.vanishes(nothing, 1e-90)  # within what a frame of size 1 spends of the digits
    with pytest.raises(MoreDigits):
        balls.vanishes(nothing * 1e35, 1e-90)


@pytest.mark.parametrize("kind", [Balls, HalfUnits])
def test_a_zero_is_shown_without_a_sign(kind: type[Balls]) -> None:
    balls = kind(30, highest=True)
    x = balls.given(Number(0.1234567890123456, 0.0, "a", "0.1234567890123456"))
    for nothing in (x - x, -(x - x), (x - x) * -1.0):
        assert math.copysign(1.0, balls.rounded(nothing, 1.0)[0]) == 1.0


def test_the_context_of_the_program_that_calls_does_not_matter() -> None:
    """Not even for a sign: a minus in `decimal` rounds to the default context."""
    with decimal.localcontext() as context:
        context.prec = 3
        balls = Balls(50)
        value = balls.given(Number(0.0, 0.0, "a", "0.12345678901234567890123456789012345678901234567"))
        negative = -value
        assert -negative == value
        assert (0.0 - value) + value == 0.0
        assert abs(-value) == float(value)
        assert balls.rounded(value * 1.0)[0] == 0.12345678901234568
        assert holds(balls.sqrt(value), many.sqrt(exact(value.value)))


@pytest.mark.parametrize("seed", range(20))
def test_a_number_is_rounded_once_and_its_error_is_at_most_two_ulps(seed: int) -> None:
    draw, balls = Random(seed), Balls(30)
    a, b = draw.randint(1, 10**8), draw.randint(1, 10**8)
    value, error = balls.rounded(balls.ratio((a, b, 0)))
    true = Fraction(a, b)
    assert value == a / b
    assert abs(Fraction(value) - true) <= Fraction(error) <= 2 * Fraction(math.ulp(value))


def test_nothing_times_anything_is_nothing() -> None:
    """An exact zero stays exact, whatever it is multiplied by: what lies on an axis is on it."""
    a = Balls(30)
    zero, third = a.ball(1.0) - a.ball(1.0), a.ball(1.0) / a.ball(3.0)
    for product in (zero * third, third * zero):
        assert (product, type(product)) == (0.0, float)


def test_a_centre_on_an_axis_needs_no_more_digits() -> None:
    """Waldron, Kinzel and Agrawal, problem 13.8: the rocker turns about a pivot on the x axis, so its centre
    with the crank lies there, by the structure of its twist and not by a difference that vanishes."""
    answer = icsolve.solve(icsolve.load(CASES / "ch13" / "13_08_four_bar.yaml"))
    scene = scene_of(answer)
    assert scene is not None
    _, y, _ = scene.first.outcome.motions.twists["4"][0]
    assert (type(y), y) == (float, 0.0)
    assert answer.centres["2", "4"].place[1] == 0.0


@pytest.mark.parametrize("power", [-1074, -1040, -1024])
@pytest.mark.parametrize("value", ["3", "1e-300"])
def test_a_divisor_too_small_for_a_double_to_turn_over_is_refused(value: str, power: int) -> None:
    """Powers of two too, by which ball and decimal are multiplied elsewhere: 1 / 2^-1074 is infinite."""
    with pytest.raises(MoreDigits):
        Balls(30).exactly(decimal.Decimal(value)) / 2.0**power


@pytest.mark.parametrize("digits", DIGITS)
def test_no_operation_changes_a_number_that_an_arithmetic_remembers(digits: int) -> None:
    """They serve all scenes of a process: what one leaves in them would be in the answers of the next."""
    balls, draw = Balls(digits, highest=False), Random(digits)
    axes = [(x, y) for x in (-1.0, -0.0, 0.0, 1.0) for y in (-1.0, -0.0, 0.0, 1.0) if x or y]
    for x, y in (*axes, *((draw.uniform(-1.0, 1.0), draw.uniform(-1.0, 1.0)) for _ in range(40))):
        for a, b in ((x, y), (balls.ball(x + 0.0), balls.ball(y + 0.0))):
            with contextlib.suppress(MoreDigits):
                turned = balls.angle(a, b)
                balls.rounded(turned, 180.0)
        p, q = balls.ball(x + 0.0), balls.ball(y + 0.0)
        for made in (p + q, p - q, p * q, -p, *([p / q] if y else []), *([balls.sqrt(p)] if x > 0.0 else [])):
            assert not isinstance(made, Ball) or holds(made, exact(made.value))
    for value, kept in balls.floats.items():
        read = balls.exactly(decimal.Decimal(value))
        told = [(b.value.as_tuple(), b.radius, b.size, b.last) for b in (kept, read)]
        assert told[0] == told[1], value
        assert value or not kept.value.is_signed()


@sampled(3)
@pytest.mark.parametrize("name", sample(FILES, 12, "digits of decimals"))
def test_no_operation_on_decimals_rounds_to_the_digits_of_the_default_context(name: str) -> None:
    """28 digits are none that anything here is asked for: where they round, an operation has lost the context
    that it belongs in, or abs() or a minus has rounded a number on its way."""
    with decimal.localcontext() as context:
        context.traps[decimal.Inexact] = True
        with contextlib.suppress(icsolve.SceneError, icsolve.CaseError):
            case = icsolve.load(FILES[name])
            answer = icsolve.solve(case, rates=True, all_centres=True)
            assert answer.to_dict() and dict(answer.sensitivities) is not None
            icsolve.solve(case, reactions=True).to_dict()
        angles = [path for path in numbers_of(case) if path.startswith("angles.")]
        for path in () if case.unknowns else angles[:1]:
            with contextlib.suppress(icsolve.SceneError, RequestError):  # some have no unknown load
                icsolve.sweep(case, {path: [1.0, 2.5, 179.99999999, 180.0]}, ("answers", "error", "rates"))
                find(case, {path: [0.5, 200.0]}, Query("dead"))
