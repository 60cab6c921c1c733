"""Enclosures of operations hold every value over a whole range, and are hardly wider than the range is:
intervals and jets against forty digits at ends, crests and between; numbers on a tape and of a record."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Sequence
from random import Random
from typing import Any

import numpy as np
import pytest
from mpmath import mp

from icsolve.assembly.driven.order import rotation_to_line
from icsolve.case import Number
from icsolve.numbers.adjoint import still_noise
from icsolve.numbers.intervals import LARGEST, MANY, WHOLE, Interval, _out, enclose, enclose_one
from icsolve.numbers.jets import BallArray, Jet
from icsolve.numbers.record import Record, Traced
from icsolve.numbers.tape import Tape
from sizes import sampled

many = mp.clone()
many.dps = 40
Ends = tuple[float, float]
SHARES = [k / 8 for k in range(9)]


def drawn(draw: Random, least: float, most: float) -> Ends:
    """A range: of a point now and then, narrow or wide."""
    a = round(draw.uniform(least, most), 3)
    return a, min(a + draw.choice([0.0, 2.0**-30, 0.3, 3.0, 300.0]), max(a, most))


def places(ends: Ends) -> list[Any]:
    """Numbers of a range with both ends."""
    low, high = (many.mpf(end) for end in ends)
    return [low + share * (high - low) for share in SHARES]


def crests(ends: Ends) -> list[Any]:
    """Angles of a range at which a cosine or sine turns."""
    low, high = ends
    return [many.mpf(90 * k) for k in range(math.ceil(low / 90.0), math.floor(high / 90.0) + 1)]


def turned(function: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """Of an angle in degrees."""
    return lambda x: function(x * many.pi / 180)


# By operation: ranges of the operands, what a record makes of them, what is true.
SIGNED, POSITIVE, DEGREES = (-5.0, 5.0), (0.1, 5.0), (-800.0, 800.0)
OPERATIONS: dict[str, tuple[list[Ends], Callable[..., Any], Callable[..., Any]]] = {
    "sum": ([SIGNED, SIGNED], operator.add, operator.add),
    "difference": ([SIGNED, SIGNED], operator.sub, operator.sub),
    "product": ([SIGNED, SIGNED], operator.mul, operator.mul),
    "quotient": ([SIGNED, POSITIVE], operator.truediv, operator.truediv),
    "quotient by what is negative": ([SIGNED, (-5.0, -0.1)], operator.truediv, operator.truediv),
    "negative": ([SIGNED], operator.neg, operator.neg),
    "square": ([SIGNED], lambda x: x * x, lambda x: x * x),
    "root": ([POSITIVE], lambda x: x.record.sqrt(x), many.sqrt),
    "nearest": ([SIGNED], lambda x: x.record.nearest(x), many.nint),
    "cosine": ([DEGREES], lambda x: x.record.turned(x)[0], turned(many.cos)),
    "sine": ([DEGREES], lambda x: x.record.turned(x)[1], turned(many.sin)),
}


def enclosed(ends: Sequence[Ends], make: Callable[..., Any], alone: bool = False) -> Ends:
    """What a record says of an operation over ranges: over many at once, or one alone."""
    record = Record()
    inputs = [record.input(f"{k}", low) for k, (low, _) in enumerate(ends)]
    made = make(*inputs)
    if alone:
        return enclose_one(
            record.nodes, made.index, {x.index: one for x, one in zip(inputs, ends, strict=True)}
        )
    given = {
        x.index: Interval(np.array([low]), np.array([high]))
        for x, (low, high) in zip(inputs, ends, strict=True)
    }
    (found,) = enclose(record, [made.index], given)
    return float(found.low[0]), float(found.high[0])


@sampled(2)
@pytest.mark.parametrize("alone", [False, True], ids=["many", "alone"])
@pytest.mark.parametrize("name", OPERATIONS)
def test_an_interval_holds_the_range_of_an_operation_and_a_few_ulps_more(name: str, alone: bool) -> None:
    within, make, truth = OPERATIONS[name]
    draw = Random(name)
    for _ in range(30):
        ends = [drawn(draw, *each) for each in within]
        first = [
            *places(ends[0]),
            *crests(ends[0]),
            *([many.zero] if ends[0][0] <= 0.0 <= ends[0][1] else []),
        ]
        values = [
            truth(x, *rest) for x in first for rest in ([(y,) for y in places(ends[1])] if ends[1:] else [()])
        ]
        low, high = enclosed(ends, make, alone)
        if (low, high) == WHOLE and name == "nearest":  # which a range alone does not ask
            continue
        least, most = min(values), max(values)
        slack = 16.0 * 2.0**-52 * max(1.0, abs(least), abs(most))
        assert least - slack <= low <= least, ends
        assert most <= high <= most + slack, ends


def test_the_directions_of_a_box_are_those_of_its_corners_and_all_about_the_origin() -> None:
    """But for whole turns; a box that does not hold the origin is seen from it within half a turn."""
    draw = Random("direction")
    for most in (0.5, 2.0) * 50:
        xs, ys = drawn(draw, -2.0, 2.0), drawn(draw, -most, most)
        low, high = enclosed([xs, ys], lambda x, y: x.record.angle(x, y))
        if xs[0] <= 0.0 <= xs[1] and ys[0] <= 0.0 <= ys[1]:
            assert (low, high) == (-180.0, 180.0)
            continue
        seen = [many.degrees(many.atan2(y, x)) for x in xs for y in ys]
        offs = [(one - seen[0] + 180) % 360 - 180 for one in seen]
        first = seen[0] + 360 * round((low - float(seen[0] + min(offs))) / 360)
        assert min(offs) - 3e-13 <= low - first <= min(offs), (xs, ys)
        assert max(offs) <= high - first <= max(offs) + 3e-13, (xs, ys)


def test_a_direction_that_does_not_vary_is_known_to_three_units_of_half_a_turn_or_of_itself() -> None:
    draw = Random("still direction")
    for _ in range(30):
        x, y = draw.uniform(-1.0, 1.0), draw.uniform(-1.0, 1.0)
        record = Record()
        found = record.angle(record.about(x, 0.0), record.about(y, 0.0))
        off = abs(many.degrees(many.atan2(y, x)) - found.value)
        assert off <= still_noise(record, found.index) <= 3.0 * math.ulp(180.0)
        taped = Tape().angle(x, y)
        assert off <= taped.tape.bound(taped) <= 2.0**-51 * abs(found.value)


def test_what_is_divided_by_a_range_with_zero_in_it_or_by_a_constant_that_is_zero_is_unbounded() -> None:
    everything = (-math.inf, math.inf)
    for below in ((-1.0, 1.0), (0.0, 1.0), (-1.0, 0.0)):
        assert enclosed([(1.0, 2.0), below], lambda x, y: x / y) == everything
        assert enclosed([(1.0, 2.0), below], lambda x, y: x / y, alone=True) == everything
        assert enclosed([(1.0, 2.0), below], lambda x, y: x / y - y / (x * y - y * x + y)) == everything
    assert enclosed([(1.0, 2.0)], lambda x: x + 1.0 / x.record.about(0.0, 1e-17)) == everything


# --- jets --------------------------------------------------------------------------------------------

JETS: dict[str, tuple[Ends, Callable[[Jet, Jet], Jet], Callable[[Any], Any]]] = {
    "quotient": (SIGNED, lambda x, one: (x * x - x).over(x * x + one), lambda x: (x * x - x) / (x * x + 1)),
    "reciprocal": (POSITIVE, lambda x, one: one.over(x), lambda x: 1 / x),
    "root": (POSITIVE, lambda x, one: (x * x * x + one).root(), lambda x: many.sqrt(x**3 + 1)),
    "cosine": (DEGREES, lambda x, one: x.cos_sin()[0], turned(many.cos)),
    "sine": (DEGREES, lambda x, one: x.cos_sin()[1], turned(many.sin)),
    "direction": (
        SIGNED,
        lambda x, one: (x * x + one).direction(x),
        lambda x: many.degrees(many.atan2(x, x * x + 1)),
    ),
}


def jet_of(ends: Ends) -> tuple[Jet, Jet]:
    """The input over a cell, and 1."""
    low, high = ends
    nothing, one = BallArray(np.zeros(1), np.zeros(1)), BallArray(np.ones(1), np.zeros(1))
    mid = 0.5 * (low + high)
    rad = max(high - mid, mid - low) * (1.0 + 2.0**-50)
    return Jet(BallArray(np.array([mid]), np.array([rad])), one, nothing), Jet(one, nothing, nothing)


@pytest.mark.parametrize("name", JETS)
def test_a_jet_holds_value_slope_and_bend_in_its_cell_and_at_a_place_is_them_to_some_ulps(name: str) -> None:
    within, make, truth = JETS[name]
    draw = Random(name)
    for k in range(16):
        ends = drawn(draw, *within)
        ends = (ends[0], ends[0]) if k % 4 == 0 else ends
        with np.errstate(all="ignore"):
            found = make(*jet_of(ends))
        for x in places(ends) if ends[1] > ends[0] else places(ends)[:1]:
            value, first, bend = many.taylor(truth, x, 2)
            for ball, true in zip(found, (value, first, 2 * bend), strict=True):
                off = abs(true - many.mpf(float(ball.mid[0])))
                assert off <= float(ball.rad[0]) + 1e-25 * (1 + abs(true)), ends
                if ends[1] == ends[0]:
                    assert ball.rad[0] <= 1e-12 * max(1.0, *(abs(v) for v in (value, first, bend))), ends


def test_balls_of_a_cell_hold_what_the_reciprocals_of_their_ends_are() -> None:
    """Sharp: one end of a reciprocal is reached but for rounding."""
    draw = Random(4)
    for _ in range(200):
        mid = draw.choice([-1.0, 1.0]) * draw.uniform(0.1, 9.0)
        rad = draw.choice([0.0, 1e-17, 1e-9, 0.5]) * abs(mid)
        found = BallArray(np.array([mid]), np.array([rad])).inverse()
        for end in (many.mpf(mid) - rad, many.mpf(mid) + rad):
            off = abs(1 / end - many.mpf(float(found.mid[0])))
            assert off <= float(found.rad[0]) <= 4 * off + 2.0**-50 / abs(mid)
    with np.errstate(all="ignore"):
        assert BallArray(np.array([1.0]), np.array([1.0])).inverse().rad == math.inf


@pytest.mark.parametrize(("low", "high"), [(0.2, 0.4), (0.3, 0.7), (-2.6, -2.4), (1.0, 3.0)])
def test_the_nearest_whole_number_of_a_cell_is_one_or_has_no_slope(low: float, high: float) -> None:
    value, first, bend = jet_of((low, high))[0].nearest()
    whole = {round(x) for x in (low, high)}
    assert all(abs(n - value.mid[0]) <= value.rad[0] for n in whole)
    assert [value.rad[0] == 0.0, first.rad[0] == 0.0, bend.rad[0] == 0.0] == [len(whole) == 1] * 3


# --- numbers on a tape and of a record ----------------------------------------------------------------


def on_a_tape(value: float) -> Any:
    return Tape().constant(value)


def of_a_record(value: float) -> Any:
    return Record().about(value, 1e-17)


@pytest.mark.parametrize("kind", [on_a_tape, of_a_record])
def test_numbers_stand_in_the_order_of_their_values(kind: Callable[[float], Any]) -> None:
    orders = (operator.lt, operator.le, operator.gt, operator.ge)
    for value, other in ((1.5, 1.5), (-2.0, 1.0), (3.0, 2.5)):
        for order in orders:
            assert order(kind(value), other) == order(value, other), order
            assert order(other, kind(value)) == order(other, value), order


def test_the_cosine_and_sine_of_right_angles_have_no_error() -> None:
    for degrees in ("0", "90", "180", "270", "-90"):
        for found in Tape().turn(Number(float(degrees), 0.5, "angles.AB", degrees)):
            assert found.tape.bound(found) == 0.0


@pytest.mark.parametrize("unit", [2.0**-40, 1.0, 2.0**40])
def test_what_vanishes_on_a_tape_does_so_in_every_unit(unit: float) -> None:
    tape = Tape()
    third = tape.constant(unit) / 3.0
    assert tape.vanishes(third * 3.0 - third - third - third, unit)
    assert not tape.vanishes(third - 0.333333333 * unit, unit)
    assert not tape.vanishes(third, unit)


@pytest.mark.parametrize("seed", range(12))
def test_a_tape_bounds_the_error_of_an_expression_and_has_its_derivatives(seed: int) -> None:
    """Sums, products, quotients and roots of decimals and of plain numbers on either side."""
    draw, tape = Random(f"tape {seed}"), Tape()
    texts = {f"lengths.{k}": f"{draw.uniform(0.3, 3.0):.3f}" for k in "ABC"}
    step = many.mpf(10) ** -15

    def made(arithmetic: Any, inputs: list[Any]) -> list[Any]:
        rng, pool = Random(f"{seed}"), list(inputs)
        for _ in range(12):
            a, b, plain = rng.choice(pool), rng.choice(pool), rng.choice([0.1, 3.0, 0.5, 7.0, 1e3])
            ways = (
                a + b,
                a * b,
                a / (b * b + plain),
                plain - a,
                a - plain,
                a * plain,
                a / plain,
                plain / (b * b + 1.0),
            )
            pool[rng.randrange(len(pool))] = rng.choice([*ways, arithmetic.sqrt(a * a + plain), -a, a - b])
        return pool

    def truth(path: str, moved: Any) -> list[Any]:
        return made(many, [many.mpf(text) + (moved if p == path else 0) for p, text in texts.items()])

    found = made(tape, [tape.given(Number(float(text), 0.0, path, text)) for path, text in texts.items()])
    exact = truth("", 0)
    for k, (one, true) in enumerate(zip(found, exact, strict=True)):
        bound, by_path = tape.back(one)
        assert abs(one.value - true) <= bound * (1 + 1e-9) <= 1e-13 * one.size, k
        for path, slope in by_path.items():
            expected = (truth(path, step)[k] - truth(path, -step)[k]) / (2 * step)
            assert slope == pytest.approx(float(expected), rel=1e-9, abs=1e-11 * (1.0 + abs(one.value)))


@pytest.mark.parametrize("off", [0.0, 3e-16, -1e-15])
def test_a_line_that_passes_its_pivot_but_for_rounding_turns_as_if_through_it_and_says_by_how_much(
    off: float,
) -> None:
    record = Record()
    for h in (off, record.about(off, 1e-17)):
        found = rotation_to_line(record, (0.6, 0.8), (1.0, 0.0), h, 1.0)
        for part, own in zip(found, (0.6, 0.8), strict=True):
            assert float(part) == own
            noise = still_noise(record, part.index) if isinstance(part, Traced) else 0.0
            assert noise == 0.0 if h is off and off == 0.0 else abs(off) * own <= noise <= 4e-15


def test_what_does_nothing_is_not_on_the_tape() -> None:
    tape = Tape()
    one = tape.constant(2.5)
    before = len(tape.nodes)
    assert [type(x) for x in (one * 0.0, one + 0.0, one - 0.0, one * 1.0, one / 1.0)] == [
        float,
        *[type(one)] * 4,
    ]
    assert len(tape.nodes) == before


@pytest.mark.parametrize("many", [1, MANY])
def test_ends_are_rounded_outward_however_many_they_are(many: int) -> None:
    ends = np.array([0.0, -0.0, 5e-324, 1.0, -1.0, 1.0 - 2**-53, 2.0**-1022, -LARGEST, np.inf, -np.inf])
    with np.errstate(all="ignore"):
        out = _out(np.tile(ends, (many, 1)))
    assert (out >= np.nextafter(ends, np.inf)).all()
