"""Every operation of the arithmetics has the rounding and the derivatives that it should, and no more.

What only widens a bound shows in no answer: so bounds are held from above and from below here, one operation
at a time, against exact fractions and 400 digits. The enclosure of an operation's result is that of its
operands' ends and its own rounding, to a few parts in a million.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Sequence
from decimal import Decimal
from random import Random
from typing import Any

import numpy as np
import pytest
from mpmath import mp

from icsolve.assembly.loci import CircleLocus, LineLocus, PlacedCircle, PlacedLine, crossing_sine
from icsolve.assembly.steps import Meet
from icsolve.assembly.walk import Gap, _rounded
from icsolve.assembly.workspace import Apart, LineDirection
from icsolve.case import Number
from icsolve.numbers import FLOATS
from icsolve.numbers.adjoint import gradient, still_noise
from icsolve.numbers.backward import Backward
from icsolve.numbers.balls import INEXACT, Ball, Balls
from icsolve.numbers.intervals import Interval, enclose
from icsolve.numbers.jets import BallArray, Jet
from icsolve.numbers.record import Record
from icsolve.numbers.tape import LONG, Tape
from icsolve.statics.load_wrenches import at_one_place

many = mp.clone()
many.dps = 400
HALF_ULP = 2.0**-53
HAIR = 1e-9

Operation = Callable[..., Any]
OPERATIONS: dict[str, tuple[int, Operation, Operation]] = {
    "sum": (2, operator.add, operator.add),
    "difference": (2, operator.sub, operator.sub),
    "product": (2, operator.mul, operator.mul),
    "quotient": (2, operator.truediv, operator.truediv),
    "root": (1, lambda x: x.arithmetic.sqrt(x), many.sqrt),
    "exponential": (1, lambda x: x.exp(), many.exp),
}


def exact(value: Decimal) -> Any:
    """A decimal in 400 digits."""
    return many.mpf(str(value))


def ball(draw: Random, balls: Balls, positive: bool) -> Ball:
    """A decimal of all digits with a radius: of a rounding, or of a measurement."""
    digits = "".join(draw.choice("0123456789") for _ in range(balls.digits))
    value = Decimal(f"{draw.randint(1, 9)}.{digits}"[: balls.digits])
    radius = draw.choice([0.0, 10.0 ** -(balls.digits - 1), 10.0 ** -(balls.digits // 2), 0.03])
    value = value if positive or draw.random() < 0.5 else -value
    return Ball(balls, value, radius, abs(float(value)) * (1 + 2.0**-50), INEXACT)


@pytest.mark.parametrize("digits", [16, 60, 120])
@pytest.mark.parametrize("name", OPERATIONS)
def test_a_radius_is_that_of_the_operands_ends_and_one_rounding(name: str, digits: int) -> None:
    count, make, truth = OPERATIONS[name]
    draw, balls = Random(f"{name} {digits}"), Balls(digits)
    for _ in range(40):
        operands = [ball(draw, balls, count == 1) for _ in range(count)]
        made = make(*operands)
        value = exact(made.value)
        ends = [[exact(x.value) + s * many.mpf(x.radius) for s in (-1, 1)] for x in operands]
        every = [truth(a, *b) for a in ends[0] for b in ([(b,) for b in ends[1]] if count > 1 else [()])]
        spread = max(abs(end - value) for end in every)
        own = 5 * many.mpf(10) ** -digits * abs(value)
        assert spread <= made.radius, operands
        if name == "root":  # to first order half as much: a secant bounds it
            spread *= 2
        assert made.radius <= (spread + 2 * own) * (1 + HAIR), operands
        size = abs(float(made.value))
        assert size <= made.size <= size * (1 + 1e-13) * (1 + 50.0**-digits) + 1e-15 * (size < 1e-12)


@pytest.mark.parametrize("digits", [16, 60])
@pytest.mark.parametrize("name", OPERATIONS)
def test_where_nothing_is_carried_a_radius_is_one_rounding(name: str, digits: int) -> None:
    count, make, _ = OPERATIONS[name]
    draw, balls = Random(f"{name} {digits}"), Balls(digits, carried=0.0)
    for _ in range(20):
        made = make(*[ball(draw, balls, count == 1) for _ in range(count)])
        own = 5.0 * 10.0**-digits * abs(float(made.value))
        assert made.exact or own <= made.radius <= own * (1 + HAIR)


@pytest.mark.parametrize("digits", [16, 30, 60, 120])
def test_series_are_good_to_two_digits_more_than_are_asked_for(digits: int) -> None:
    balls, draw = Balls(digits), Random(digits)
    pi = balls.pi()
    assert abs(exact(pi.value) - many.pi) <= 10.0 ** -(digits + 9)
    assert 10.0**-digits <= pi.radius <= 10.0**-digits * (1 + HAIR)
    for _ in range(20):
        radius = draw.choice([0.0, 1e-3 * 10.0**-digits, 10.0**-digits, 1e-6])
        angle = draw.choice([draw.uniform(-1000.0, 1000.0), 10.0 ** draw.uniform(-40.0, 0.0)])
        degrees = Ball(balls, Decimal(repr(angle)), radius, 1e3, INEXACT)
        true = exact(degrees.value) * many.pi / 180
        for part, wanted in zip(balls.cos_sin(degrees), (many.cos(true), many.sin(true)), strict=True):
            assert abs(exact(part.value) - wanted) <= 10.0 ** -(digits + 7) * abs(wanted)
            off = math.radians(radius) + 10.0 ** -(digits + 2) * abs(float(wanted))
            assert off <= part.radius <= off * (1 + 1e-6)


@pytest.mark.parametrize("digits", [30, 60, 120])
def test_a_direction_loses_what_its_quotient_does(digits: int) -> None:
    """In degrees: eight roundings of the tangent of what is left of it, and those of its sum."""
    balls, draw = Balls(digits), Random(f"direction {digits}")
    for _ in range(20):
        x, y = (balls.exactly(Decimal(repr(draw.uniform(-3.0, 3.0)))) for _ in "xy")
        found, true = balls.angle(x, y), many.degrees(many.atan2(exact(y.value), exact(x.value)))
        assert abs(exact(found.value) - true) <= found.radius <= 3e3 * 10.0**-digits


@pytest.mark.parametrize("value", ["0.1", "0.7", "-123.456"])
def test_zero_lies_in_a_ball_to_the_last_digit(value: str) -> None:
    """A float's rounding of the value does not tell; a hair of a hundredth of a millionth of a ball does."""
    balls, radius = Balls(60), abs(float(value))
    for share, holds in (("1e-30", True), ("-1e-30", True), ("1e-14", False), ("-1e-14", True)):
        edge = Decimal(radius) * (1 + Decimal(share))
        assert Ball(balls, edge, radius, radius * 1.001, INEXACT).holds_zero == holds
        assert Ball(balls, -edge, radius, radius * 1.001, INEXACT).is_certain != holds


@pytest.mark.parametrize("carried", [0.0, 1.0])
def test_an_exact_zero_stays_exact_in_quotients_and_what_cancels_has_what_is_carried(carried: float) -> None:
    balls = Balls(30, carried=carried)
    third, nothing = balls.ball(1.0) / 3.0, balls.ball(1.0) - balls.ball(1.0)
    assert (nothing / third).exact
    for rest in (third - third, third + -third):
        assert rest.radius == pytest.approx(2.0 * carried * third.radius, rel=1e-12)


# --- numbers on a tape and of a record: first-order sums, to the last bit or so ----------------------------

RATE = math.pi / 180.0
ROUNDED: dict[str, tuple[int, Operation, Callable[..., Sequence[float]], float]] = {
    # operands, what makes it (of the arithmetic too), its derivatives by them, its own roundings in half ulps
    "sum": (2, lambda a, x, y: x + y, lambda x, y: (1.0, 1.0), 1.0),
    "difference": (2, lambda a, x, y: x - y, lambda x, y: (1.0, -1.0), 1.0),
    "product": (2, lambda a, x, y: x * y, lambda x, y: (y, x), 1.0),
    "quotient": (2, lambda a, x, y: x / y, lambda x, y: (1.0 / y, -x / y / y), 1.0),
    "negative": (1, lambda a, x: -x, lambda x: (-1.0,), 0.0),
    "root": (1, lambda a, x: a.sqrt(x), lambda x: (0.5 / math.sqrt(x),), 1.0),
    "sum with a plain number": (1, lambda a, x: x + 0.3, lambda x: (1.0,), 1.0),
    "plain less a number": (1, lambda a, x: 0.3 - x, lambda x: (-1.0,), 1.0),
    "less a plain number": (1, lambda a, x: x - 0.3, lambda x: (1.0,), 1.0),
    "times a plain number": (1, lambda a, x: 0.3 * x, lambda x: (0.3,), 1.0),
    "over a plain number": (1, lambda a, x: x / 0.3, lambda x: (1.0 / 0.3,), 1.0),
    "plain over a number": (1, lambda a, x: 0.3 / x, lambda x: (-0.3 / x / x,), 1.0),
    "times a power of two": (1, lambda a, x: x * 4.0, lambda x: (4.0,), 0.0),
    "over a power of two": (1, lambda a, x: x / 4.0, lambda x: (0.25,), 0.0),
}
ANGLES: dict[str, tuple[Operation, Callable[[float], float]]] = {
    "cosine": (lambda turned: turned[0], lambda d: -RATE * math.sin(RATE * d)),
    "sine": (lambda turned: turned[1], lambda d: RATE * math.cos(RATE * d)),
}


def drawn(draw: Random, count: int) -> list[str]:
    """Positive decimals of three places, of which no double is one."""
    return [f"{draw.randint(0, 4)}.{draw.randint(10, 99)}{draw.choice('13579')}" for _ in range(count)]


def expected(operands: Sequence[float], made: float, slopes: Sequence[float], own: float) -> float:
    """The first-order bound: each operand's half ulp times its derivative, and the operation's own."""
    return HALF_ULP * (sum(abs(s * x) for s, x in zip(slopes, operands, strict=True)) + own * abs(made))


@pytest.mark.parametrize("name", ROUNDED)
def test_a_tape_has_the_rounding_and_the_derivatives_of_each_operation(name: str) -> None:
    count, make, derivatives, own = ROUNDED[name]
    draw = Random(name)
    for _ in range(8):
        tape, texts = Tape(), drawn(draw, count)
        x = [float(text) for text in texts]
        made = make(tape, *(tape.given(Number(v, 0.0, f"{k}", texts[k])) for k, v in enumerate(x)))
        slopes = derivatives(*x)
        assert tape.bound(made) == pytest.approx(expected(x, made.value, slopes, own), rel=1e-12)
        assert tape.back(made).by_path == pytest.approx({f"{k}": s for k, s in enumerate(slopes)}, rel=1e-12)


@pytest.mark.parametrize("name", ROUNDED)
def test_a_record_has_the_rounding_and_the_derivatives_of_each_operation(name: str) -> None:
    """Where its numbers are the same in every row, and where they vary: backwards over rows, and as nodes."""
    count, make, derivatives, own = ROUNDED[name]
    draw = Random(name)
    for _ in range(4):
        record, texts = Record(), drawn(draw, count)
        x = [float(text) for text in texts]
        still = make(record, *(record.given(Number(v, 0.0, f"{k}", texts[k])) for k, v in enumerate(x)))
        # no look at whether a plain operand is a power of two: a rounding that is not there is counted
        lost = max(own, 1.0) if "power of two" in name else own
        bound = expected(x, still.value, derivatives(*x), lost)
        assert still_noise(record, still.index) == pytest.approx(bound, rel=1e-12)

        inputs = [record.input(f"x{k}", v) for k, v in enumerate(x)]
        made = make(record, *inputs)
        nodes = [one.index for one in inputs]
        slopes = derivatives(*x)
        by = gradient(record, made, nodes)
        assert [float(by[k]) for k in nodes] == pytest.approx(slopes, rel=1e-12)
        given = {k: np.array([v]) for k, v in zip(nodes, x, strict=True)}
        (passed,) = Backward(record, [made.index], ()).run(given, 1)
        assert passed.bound[0] == pytest.approx(expected(x, made.value, slopes, own), rel=1e-12)
        assert [passed.by[k][0] for k in nodes] == pytest.approx(slopes, rel=1e-12)
        (passed,) = Backward(record, [made.index], nodes).run(given, 1)  # exact
        assert passed.bound[0] == pytest.approx(HALF_ULP * own * abs(made.value), rel=1e-12)


@pytest.mark.parametrize(("factor", "half_ulps"), [(1.0, 1.0), (25.4, 3.0)])
def test_a_decimal_has_half_an_ulp_and_with_the_factor_of_its_unit_three(
    factor: float, half_ulps: float
) -> None:
    for value in (0.3, 7.5, 2.0**53, 3.0):
        tape, number = Tape(), Number(value, 0.0, "a", f"{value!r}", factor)
        noise = 0.0 if (factor, value) == (1.0, 3.0) else half_ulps * HALF_ULP * value
        assert tape.bound(tape.given(number)) == noise
        assert tape.converted == ({} if factor == 1.0 else {"a": noise})
    assert tape.bound(tape.ratio((1, 3, 0))) == HALF_ULP / 3.0
    assert tape.bound(tape.ratio((3, 3, 0))) == 0.0


def test_a_long_tape_is_swept_as_a_short_one_is() -> None:
    """Of a long one only the values that lead to the result are swept: it has the bound and the derivatives
    to the last bit that it has where nothing else was recorded between them."""
    swept = []
    for idle in (0, 2 * LONG):
        tape = Tape()
        x, y = (tape.given(Number(v, 0.0, path, repr(v))) for path, v in (("x", 0.7), ("y", 1.9)))
        value: Any = x
        for _ in range(9):
            value = (value * y + x) / (value + 0.3)
            for _ in range(idle // 9):
                y * 0.1
        swept.append((len(tape.nodes) > LONG, tape.bound(value), tape.back(value).by_path))
    (short, *plain), (long, *sparse) = swept
    assert long and not short
    assert plain == sparse


def test_a_number_on_a_tape_is_equal_to_its_value() -> None:
    one = Tape().constant(1.5)
    assert (one == 1.5, one == 2.5, one != 2.5) == (True, False, True)


@pytest.mark.parametrize("name", ANGLES)
def test_a_cosine_or_sine_has_three_half_ulps_and_the_derivative_by_degrees(name: str) -> None:
    part, slope = ANGLES[name]
    draw = Random(name)
    for _ in range(8):
        text = drawn(draw, 1)[0]
        degrees = float(text) * 1.0
        tape, record = Tape(), Record()
        number = Number(degrees, 0.0, "a", text)
        taped, still = part(tape.turn(number)), part(record.turn(number))
        bound = expected([degrees], taped.value, [slope(degrees)], 3.0)
        assert tape.bound(taped) == pytest.approx(bound, rel=1e-12)
        assert still_noise(record, still.index) == pytest.approx(bound, rel=1e-12)
        assert tape.back(taped).by_path["a"] == pytest.approx(slope(degrees), rel=1e-12)
        angle = record.input("x", degrees)
        made = part(record.turned(angle))
        by = gradient(record, made, [angle.index])
        assert float(by[angle.index]) == pytest.approx(slope(degrees), rel=1e-12)
        (passed,) = Backward(record, [made.index], ()).run({angle.index: np.array([degrees])}, 1)
        assert passed.bound[0] == pytest.approx(bound, rel=1e-12)
        assert passed.by[angle.index][0] == pytest.approx(slope(degrees), rel=1e-12)


def test_a_direction_has_the_rounding_of_its_degrees_and_the_derivatives_by_both_parts() -> None:
    draw = Random("direction")
    for _ in range(8):
        texts = drawn(draw, 2)
        x, y = map(float, texts)
        square = (x * x + y * y) * RATE
        slopes = -y / square, x / square
        degrees = math.degrees(math.atan2(y, x))
        tape, record = Tape(), Record()
        numbers = [Number(v, 0.0, f"{k}", t) for k, (v, t) in enumerate(zip((x, y), texts, strict=True))]
        taped = tape.angle(*map(tape.given, numbers))
        assert tape.bound(taped) == pytest.approx(expected([x, y], degrees, slopes, 4.0), rel=1e-12)
        assert list(tape.back(taped).by_path.values()) == pytest.approx(slopes, rel=1e-12)
        still = record.angle(*map(record.given, numbers))
        bound = expected([x, y], 720.0, slopes, 1.0)
        assert still_noise(record, still.index) == pytest.approx(bound, rel=1e-12)
        inputs = [record.input("x", x), record.input("y", y)]
        nodes = [one.index for one in inputs]
        made = record.angle(*inputs)
        by = gradient(record, made, nodes)
        assert [float(by[k]) for k in nodes] == pytest.approx(slopes, rel=1e-12)
        given = {nodes[0]: np.array([x]), nodes[1]: np.array([y])}
        (passed,) = Backward(record, [made.index], ()).run(given, 1)
        assert passed.bound[0] == pytest.approx(bound, rel=1e-12)
        assert [passed.by[k][0] for k in nodes] == pytest.approx(slopes, rel=1e-12)


def test_what_nearly_vanishes_is_looked_at_and_what_does_has_the_root_of_its_rounding() -> None:
    tape = Tape()
    third = tape.constant(1.0) / 3.0
    for off, looked in ((3e-6, 0), (3e-7, 1), (-3e-7, 2)):
        small = third - (1.0 / 3.0 - off)
        assert len(tape.suspects) == looked - (looked > 0)
        _ = 1.0 / small
        assert len(tape.suspects) == looked
    nothing = third - 1.0 / 3.0
    root = tape.sqrt(nothing)
    assert root.value == 0.0
    assert tape.bound(root) == pytest.approx(math.sqrt(HALF_ULP / 3.0), rel=1e-12)
    assert root.size == pytest.approx(math.sqrt(1.0 / 3.0), rel=1e-12)
    assert list(tape.doubts(1e-3)) == [math.inf] or all(doubt >= 0.0 for doubt in tape.doubts(1e-3))


# --- intervals and balls of cells: the width at a place -----------------------------------------------------


@pytest.mark.parametrize("name", ["cosine", "sine"])
def test_the_cosine_and_sine_of_a_place_are_twelve_half_ulps_wide(name: str) -> None:
    part = ANGLES[name][0]
    draw = Random(name)
    for _ in range(40):
        degrees = draw.uniform(-720.0, 720.0)
        record = Record()
        angle = record.input("x", degrees)
        made = part(record.turned(angle))
        here = np.array([degrees])
        ((low, high),) = enclose(record, [made.index], {angle.index: Interval(here, here)})
        assert 10.5 * HALF_ULP <= high[0] - low[0] <= 13.0 * HALF_ULP or 1.0 in (high[0], -low[0])


def test_a_direction_of_a_cell_is_a_whole_turn_wider_only_where_it_holds_the_cut() -> None:
    nothing = BallArray(np.zeros(1), np.zeros(1))
    for degrees in (-179.9, -90.0, 0.0, 90.0, 179.0, 179.9):
        x, y = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        off = 0.01
        one, two = (Jet(BallArray(np.array([v]), np.array([off])), nothing, nothing) for v in (x, y))
        value = one.direction(two).value
        turn = 360.0 if abs(degrees) > 179.5 else 0.0
        rad = math.degrees(math.asin(math.hypot(off, off))) + turn + 360.0 * 2.0**-51
        assert value.mid[0] == pytest.approx(degrees, abs=1e-12)
        assert value.rad[0] == pytest.approx(rad, abs=2e-13)


CELLS: dict[str, tuple[int, Operation]] = {
    "sum": (2, operator.add),
    "difference": (2, operator.sub),
    "product": (2, operator.mul),
    "multiple": (1, lambda x: x.times(0.7) if isinstance(x, BallArray) else x * many.mpf(0.7)),
    "reciprocal": (1, lambda x: x.inverse() if isinstance(x, BallArray) else 1 / x),
    "root": (1, lambda x: x.root() if isinstance(x, BallArray) else many.sqrt(x)),
}


@pytest.mark.parametrize("name", CELLS)
def test_the_radius_in_a_cell_is_that_of_the_operands_ends_and_two_ulps(name: str) -> None:
    count, make = CELLS[name]
    draw = Random(name)
    for _ in range(60):
        mids = [
            draw.uniform(0.5, 4.0) * (draw.choice([-1.0, 1.0]) if count > 1 else 1.0) for _ in range(count)
        ]
        rads = [draw.choice([0.0, 1e-12, 0.2]) for _ in range(count)]
        made = make(*(BallArray(np.array([m]), np.array([r])) for m, r in zip(mids, rads, strict=True)))
        ends = [[many.mpf(m) + s * many.mpf(r) for s in (-1, 1)] for m, r in zip(mids, rads, strict=True)]
        every = [make(a, *b) for a in ends[0] for b in ([(b,) for b in ends[1]] if count > 1 else [()])]
        mid, rad = float(made.mid[0]), float(made.rad[0])
        spread = max(abs(end - many.mpf(mid)) for end in every)
        assert spread <= rad
        roundings = 2 if name == "root" else 1
        assert rad <= (spread + (roundings * 2.0**-51 + 2.0**-53) * abs(mid)) * (1 + HAIR)
        assert rad >= 2.0**-51 * abs(mid)


def test_two_loci_cross_at_the_angle_of_their_tangents() -> None:
    """Of lines and circles through a place, wherever it is."""
    draw = Random("crossing")
    for _ in range(60):
        x, y, one, two = (draw.uniform(-3.0, 3.0) for _ in range(4))
        made = []
        for toward in (one, two):
            c, s, radius = math.cos(toward), math.sin(toward), draw.uniform(0.1, 4.0)
            line = PlacedLine((x - radius * c, y - radius * s), (c, s))
            circle = PlacedCircle((x + radius * s, y - radius * c), radius)
            made.append(draw.choice([line, circle]))
        assert crossing_sine(*made, (x, y)) == pytest.approx(abs(math.sin(two - one)), abs=1e-13)


# --- what rounding explains is zero ----------------------------------------------------------------


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("place", [0.0, 0.3, -1.0, 1.0])
def test_points_within_a_few_roundings_are_one(place: float, axis: int) -> None:
    for off, one in ((0.0, True), (1e-14, True), (1e-12, False), (0.1, False)):
        a, b = [place, place], [place, place]
        b[axis] += off
        assert at_one_place((a[0], a[1]), (b[0], b[1]), FLOATS) is one


@pytest.mark.parametrize(("size", "scale"), [(1e-3, 1.0), (1.0, 1.0), (64.0, 64.0)])
def test_circles_touch_within_a_few_roundings_and_lines_are_parallel(size: float, scale: float) -> None:
    """Of gaps that the decimals leave in doubt: over the figure's size, or the larger circles'."""
    circle = CircleLocus("A", Apart("A", "B"))
    line = LineLocus("A", LineDirection(Apart("A", "B")), False)
    for meet, most in ((Meet("P", circle, circle), 8 * HALF_ULP * scale), (Meet("P", line, line, 0), 1e-14)):
        for off, sign in ((0.5 * most, 0), (-0.5 * most, 0), (2.0 * most, 1), (-2.0 * most, -1)):
            gaps = [Gap(1 if off > 0.0 else -1, off), Gap(1, size)]
            assert [gap.sign for gap in _rounded(meet, gaps)] == [sign, 1]
