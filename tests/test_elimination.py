"""Linear and quadratic equations and zeros, by themselves: against exact fractions, and by counting steps.

A limit is held from both sides of its value: what is just below counts as zero, what is just above does not.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from decimal import Decimal
from fractions import Fraction
from itertools import combinations
from operator import mul
from random import Random
from typing import Any

import numpy as np
import pytest

from icsolve.assembly.exclusion import _Link, _narrow_length
from icsolve.numbers import ZERO
from icsolve.numbers.balls import INEXACT, Ball, Balls, MoreDigits
from icsolve.numbers.inequalities import _simplex, deepest, region
from icsolve.numbers.linear import (
    SINGULAR,
    SPENT,
    THRESHOLD,
    eliminate,
    inverse,
    null_space,
    solve_square,
)
from icsolve.numbers.quadratics import Quadratics, every_zero
from icsolve.numbers.roots import below_zero, last_that_holds, zero_between
from sizes import FULL, sampled

Matrix = list[list[float]]


def drawn(draw: Random, m: int, n: int, filled: float = 1.0) -> Matrix:
    """Small whole numbers and halves, some zero: fractions of them stay exact."""
    return [[draw.randint(-9, 9) / 2 if draw.random() < filled else 0.0 for _ in range(n)] for _ in range(m)]


def fractions(rows: Matrix) -> list[list[Fraction]]:
    return [[Fraction(x) for x in row] for row in rows]


def determinant(rows: list[list[Fraction]]) -> Fraction:
    """By Laplace's expansion."""
    if not rows:
        return Fraction(1)
    minors = (determinant([row[:c] + row[c + 1 :] for row in rows[1:]]) for c in range(len(rows)))
    return sum((x * m * (-1) ** c for c, (x, m) in enumerate(zip(rows[0], minors, strict=True))), Fraction(0))


# --- square systems ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("n", [1, 2, 3, 5])
def test_a_square_system_of_fractions_has_its_exact_solution(n: int) -> None:
    """By partial pivoting of any numbers; its inverse has the solutions of the unit vectors as columns."""
    draw = Random(n)
    for _ in range(20):
        matrix = drawn(draw, n, n, 0.7)
        rows, right = fractions(matrix), [Fraction(draw.randint(-9, 9)) for _ in range(n)]
        before = [list(row) for row in rows]
        x, other = solve_square(rows, right), inverse(matrix)
        assert rows == before
        if determinant(rows) == 0:
            assert x is None
            assert other is None
            continue
        assert x is not None
        assert [sum(a * b for a, b in zip(row, x, strict=True)) for row in rows] == right
        assert other is not None
        both = [[sum(a * other[k][c] for k, a in enumerate(row)) for c in range(n)] for row in matrix]
        assert np.allclose(both, np.eye(n), rtol=0.0, atol=1e-11)


def test_a_row_with_a_small_entry_is_no_pivot() -> None:
    """1e-20 x + y = 1, x + y = 2: without an exchange of rows x is lost."""
    assert solve_square([[1e-20, 1.0], [1.0, 1.0]], [1.0, 2.0]) == [1.0, 1.0]
    assert solve_square([[1.0, 1.0], [-4.0, 1.0]], [2.0, -3.0]) == [1.0, 1.0]


@pytest.mark.parametrize(("share", "is_there"), [(0.8, False), (1.3, True)])
def test_a_pivot_is_judged_by_its_column(share: float, is_there: bool) -> None:
    for scale in (1.0, 1e-9, 1e9):
        matrix = [[1.0, scale], [1.0, scale * (1.0 + share * SINGULAR)]]
        assert (solve_square(matrix, [1.0, 2.0]) is not None) == is_there
    assert solve_square([[1.0, 0.0], [0.0, 0.0]], [1.0, 0.0]) is None
    assert SINGULAR == 1e-14


def about(balls: Balls, value: float, radius: float) -> Ball:
    return Ball(balls, Decimal(value), radius, abs(value) * 1.001, INEXACT)


def test_of_balls_the_arithmetic_says_what_is_no_pivot() -> None:
    balls = Balls(30)
    three = balls.ball(3.0)
    assert solve_square([[three, 1.0], [three, 1.0]], [1.0, 1.0], balls.vanishes) is None
    with pytest.raises(MoreDigits):
        solve_square([[about(balls, 1e-9, 1e-6)]], [three], balls.vanishes)
    found = solve_square([[about(balls, 1e-9, 0.0)]], [three], balls.vanishes)
    assert found is not None
    assert float(found[0]) == pytest.approx(3e9)


# --- null spaces ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("rank", [0, 1, 2, 3])
@pytest.mark.parametrize("columns", [3, 4, 6])
def test_a_null_space_has_a_vector_for_each_free_unknown(rank: int, columns: int) -> None:
    draw = Random(10 * rank + columns)
    for m in (rank, rank + 2):
        parts, mix = drawn(draw, rank, columns), drawn(draw, m, rank)
        rows = [[sum(w * parts[k][c] for k, w in enumerate(ws)) for c in range(columns)] for ws in mix]
        expected = int(np.linalg.matrix_rank(rows)) if m and rank else 0
        found = null_space(rows, columns)
        assert (found.rank, len(found.basis), len(found.pivots)) == (expected, columns - expected, expected)
        assert found.dropped < 1e-14
        for x in found.basis:
            for row in rows:
                terms = [a * b for a, b in zip(row, x, strict=True)]
                assert abs(math.fsum(terms)) <= 1e-14 * columns * max(1.0, *map(abs, terms))
            assert sum(
                x[c] == 1.0 and all(y[c] == 0.0 for y in found.basis if y is not x) for c in range(columns)
            )
        if expected:
            assert found.pivots[0] == 1.0
            first = max(abs(x) for row in rows for x in row)
            product = first**expected * math.prod(found.pivots)
            if m == columns == expected:
                assert product == pytest.approx(abs(float(np.linalg.det(rows))), rel=1e-12)


def test_the_largest_entry_is_the_pivot_and_the_next_one_is_measured_by_it() -> None:
    """Rows and columns change places; 3 stands alone, what is left below -4 is 1 + 2 * 3 / 4."""
    assert null_space([[2.0, 1.0], [-4.0, 3.0]], 2).pivots == (1.0, (1.0 + 2.0 * 3.0 / 4.0) / 4.0)
    assert null_space([[0.5, 0.0, 0.25], [0.0, 8.0, 2.0]], 3).basis == ((-0.5, -0.25, 1.0),)
    assert null_space([], 2).basis == ((1.0, 0.0), (0.0, 1.0))


@pytest.mark.parametrize("zero", [ZERO, 2.0**-20])
def test_a_pivot_below_a_fraction_of_the_first_times_the_rows_is_zero(zero: float) -> None:
    for m in (2, 3):
        for share, rank in ((0.5, 1), (1.0, 1), (1.25, 2)):
            rows = [[4.0, 0.0], [0.0, 4.0 * share * m * zero], *[[0.0, 0.0]] * (m - 2)]
            found = null_space(rows, 2, zero)
            assert (found.rank, found.dropped) == (rank, share * m * zero if rank == 1 else 0.0)
    assert null_space([[0.0, 0.0]], 2, 0.0).rank == 0
    assert null_space([[1.0]], 1).rank == 1
    assert ZERO == 2.0**-47


def test_rounding_of_larger_terms_is_no_pivot() -> None:
    for unit, rank in ((0.0, 1), (1e3, 1), (1e9, 0)):
        found = null_space([[1e-6, 1e-6]], 2, 1e-13, unit)
        assert found.rank == rank
        assert found.dropped == (0.0 if rank else 1e-6 / unit)


def test_of_balls_a_pivot_is_the_largest_that_is_certainly_not_zero() -> None:
    balls = Balls(30)
    wide, sure, nothing = about(balls, 5.0, 6.0), about(balls, 0.5, 0.1), balls.ball(0.0)
    found = null_space([[wide, sure]], 2, vanishes=balls.vanishes)
    assert found.rank == 1
    assert [float(x) for x in found.basis[0]] == [1.0, -10.0]
    assert null_space([[2.0, sure]], 2, vanishes=balls.vanishes).rank == 1  # a float is certain
    assert null_space([[nothing, nothing]], 2, vanishes=balls.vanishes).rank == 0
    with pytest.raises(MoreDigits):
        null_space([[sure, 0.0], [0.0, wide]], 2, vanishes=balls.vanishes)
    small = about(Balls(120, highest=True), 0.0, 1e-30)
    for unit, open_ in ((1e11, False), (1e9, True)):  # 1e-40 of the terms is zero, at the highest precision
        rows = [[small]]
        if not open_:
            assert null_space(rows, 1, unit=unit, vanishes=small.arithmetic.vanishes).rank == 0
            continue
        with pytest.raises(MoreDigits):
            null_space(rows, 1, unit=unit, vanishes=small.arithmetic.vanishes)


# --- sparse elimination -----------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(24))
def test_a_general_solution_fills_every_equation_and_leaves_what_contradicts(seed: int) -> None:
    """The solved columns in terms of the free ones and the parameters, row by row."""
    draw = Random(seed)
    columns, parameters, m = draw.randint(2, 6), draw.randint(0, 2), draw.randint(1, 8)
    matrix = drawn(draw, m, columns + parameters, 0.5)
    if m > 2:
        matrix[-1] = [a + 2 * b for a, b in zip(matrix[0], matrix[1], strict=True)]
    rows = [dict(enumerate(row)) for row in matrix]
    given = [dict(row) for row in rows]
    found = eliminate(rows, columns)
    assert rows == given
    rank = int(np.linalg.matrix_rank([row[:columns] for row in matrix]))
    assert len(found.solved) == len(found.pivots) == rank
    assert sorted([*found.free, *found.solved]) == list(range(columns))
    assert len(found.left) == m - rank
    over = range(columns, columns + parameters)
    rest = [[each.get(p, 0.0) for p in over] for each in found.left]
    for row in rows:  # of the parameters there remains a combination of the rows that are left
        total = [
            sum(a * found.of(c).get(p, 0.0) for c, a in row.items()) for p in range(columns + parameters)
        ]
        assert np.allclose(total[:columns], 0.0, atol=1e-9)
        own = total[columns:]
        if parameters:
            before, after = (
                np.linalg.matrix_rank([[0.0] * parameters, *each], 1e-9) for each in (rest, [*rest, own])
            )
            assert before == after
    if m == rank == columns:
        square = fractions([row[:columns] for row in matrix])
        assert abs(math.prod(found.pivots)) == pytest.approx(abs(float(determinant(square))))


def test_the_pivot_is_the_column_that_the_fewest_rows_share_where_it_is_large_enough() -> None:
    other = {0: 1.0, 2: 1.0, 3: 7.0}
    for value, pivot in ((THRESHOLD, THRESHOLD), (0.9 * THRESHOLD, 1.0), (-0.2, -0.2)):
        assert eliminate([{0: 1.0, 1: value}, other], 4).pivots[0] == pivot
    assert eliminate([{0: 1.0, 1: -2.0}, {2: 1.0, 3: 1.0, 4: 1.0}], 5).pivots[0] == -2.0  # the larger
    assert list(eliminate([{1: 1.0, 0: 1.0}], 2).solved) == [0]  # the first
    assert eliminate([{0: 3.0, 1: 1.0, 2: 1.0}, {3: 5.0}], 4).pivots[0] == 5.0  # the shortest row first
    assert THRESHOLD == 0.1


@pytest.mark.parametrize(("share", "rank"), [(0.5, 1), (2.0, 2)])
def test_what_is_left_of_a_row_is_rounding_below_a_fraction_of_its_terms(share: float, rank: int) -> None:
    for spent in (SPENT, 1e-9):
        rows = [{0: 1.0, 1: 1.0}, {0: 1e3, 1: 1e3 * (1.0 + share * spent)}]
        assert len(eliminate(rows, 2, spent).pivots) == rank
    assert len(eliminate([{0: 1.0, 1: 1.0}, {0: 1.0, 1: 1.0, 2: 1.0}], 2).left) == 1
    assert SPENT == 1e-13


@pytest.mark.parametrize("tiny", [1e-6, 1e-10, 1e-14, 1e-16])
def test_a_short_row_of_next_to_nothing_waits_for_the_others(tiny: float) -> None:
    """x is 1/3 by the second row, and hardly matters in the first, which tells the parameter q: as a pivot of
    the first its rounding would be all that is left."""
    for rows in ([{0: tiny, 2: 1.0, 1: -0.7}, {0: 3.0, 1: -1.0}], [{0: tiny, 2: 1.0}, {0: 3.0, 1: -1.0}]):
        general = eliminate(rows, 1)
        ((left),) = general.left
        assert general.of(0)[1] == pytest.approx(1 / 3, rel=1e-15)
        constant = Fraction(rows[0].get(1, 0.0)) + Fraction(tiny) / 3
        assert Fraction(-left[1] / left[2]) == pytest.approx(-constant, rel=4e-16)


def test_a_row_remembers_the_largest_amount_that_was_taken_from_it() -> None:
    """1 - 1e6 + 1e6 leaves 1e-10 of rounding: beside 1e6 that is nothing, beside 1 it would be a pivot."""
    rows = [{0: 1.0, 1: 1e6}, {0: 1.0, 1: 1e6 + 1e-9, 2: 1e-8}]
    found = eliminate(rows, 3)
    assert len(found.pivots) == 1 or abs(found.pivots[-1]) > SPENT * 1e6


def test_of_balls_a_row_is_left_where_all_its_entries_are_zero_and_open_where_one_may_be() -> None:
    balls = Balls(30)
    one, wide, sure = balls.ball(1.0), about(balls, 5.0, 6.0), about(balls, 0.5, 0.1)
    found = eliminate([{0: wide, 1: sure}], 2, vanishes=balls.vanishes)
    assert list(found.solved) == [1]
    assert len(eliminate([{0: one}, {0: one, 1: 1.0}], 1, vanishes=balls.vanishes).left) == 1
    with pytest.raises(MoreDigits):
        eliminate([{0: wide, 1: one}], 1, vanishes=balls.vanishes)


# --- zeros ------------------------------------------------------------------------------------------------

FUNCTIONS: dict[str, tuple[Callable[[float], float], float, float, float, int]] = {
    # function, ends, zero, calls at most
    "line": (lambda x: 3.0 * x - 1.0, -5.0, 7.0, 1.0 / 3.0, 2),
    "parabola": (lambda x: x * x - 2.0, 0.0, 9.0, math.sqrt(2.0), 13),
    "cosine": (math.cos, 0.0, 3.0, math.pi / 2.0, 7),
    "seventh power": (lambda x: (x - 0.3) ** 7, -1.0, 1.0, 0.3, 120),
    "falling exponential": (lambda x: math.exp(-x) - 1e-4, 0.0, 50.0, -math.log(1e-4), 13),
    "steep": (lambda x: math.atan(1e6 * (x - 0.7)), 0.0, 1.0, 0.7, 24),
    "jump": (lambda x: 1.0 if x > 0.1 else -1.0, -1.0, 1.0, 0.1, 57),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_zero_is_found_to_an_ulp_in_few_calls_from_either_side(name: str) -> None:
    f, low, high, zero, most = FUNCTIONS[name]
    for a, b in ((low, high), (high, low)):
        calls: list[float] = []

        def counted(x: float, calls: list[float] = calls) -> float:
            calls.append(x)
            return f(x)

        found = zero_between(counted, a, b, f(a), f(b))
        assert abs(found - zero) <= 2.0 * math.ulp(zero) or abs(f(found)) < 1e-80
        assert len(calls) <= most
        assert all(low <= x <= high for x in calls)
    assert zero_between(f, zero, high, 0.0, f(high)) == zero


@pytest.mark.parametrize("depth", [1.0, 1e-4, 1e-8, 1e-12, 0.0, -1e-12, -1.0])
@pytest.mark.parametrize("bottom", [0.01, 0.3, 0.77])
def test_a_valley_below_zero_is_found_however_shallow_it_is(depth: float, bottom: float) -> None:
    def valley(x: float) -> float:
        return 100.0 * (x - bottom) ** 2 * (1.0 + 0.3 * x) - depth * 1e-3

    place = below_zero(valley, 0.0, 1.0)
    assert (place is not None) == (depth > 0.0)
    assert place is None or valley(place) < 0.0
    assert below_zero(lambda x: x + 1e-9, 0.0, 1.0) is None


def test_the_last_place_at_which_something_holds_is_a_double_beside_the_next() -> None:
    for limit in (0.1, math.pi, 1e-300, 12345.678):
        for inside, outside in ((0.0, 1e5), (0.0, 2e4)):
            last, beyond = last_that_holds(lambda x, limit=limit: x <= limit, inside, outside)
            assert (last, beyond) == (limit, math.nextafter(limit, math.inf))
    assert last_that_holds(lambda x: x >= -2.5, 0.0, -9.0)[0] == -2.5


# --- quadratic equations ----------------------------------------------------------------------------------


def system(*equations: tuple[float, Mapping[int, float], Mapping[tuple[int, int], float]]) -> Quadratics:
    """Of a constant, and coefficients of unknowns and of products of two, an equation."""
    n = len(equations)
    constant, gradient, hessian = np.zeros(n), np.zeros((n, n)), np.zeros((n, n, n))
    for m, (c, linear, products) in enumerate(equations):
        constant[m] = c
        for k, a in linear.items():
            gradient[m, k] = a
        for (j, k), a in products.items():
            hessian[m, j, k] += a
            hessian[m, k, j] += a
    return Quadratics(constant, gradient, hessian)


def circles(apart: float, two: float = 1.0) -> Quadratics:
    """A unit circle about the origin, and one of radius ``two`` about (apart, 0)."""
    round_ = {(0, 0): 1.0, (1, 1): 1.0}
    return system((-1.0, {}, round_), (apart * apart - two * two, {0: -2.0 * apart}, round_))


def every(equations: Quadratics, most: int = 10_000, **given: Any) -> Any:
    n = len(equations.constant)
    return every_zero(equations, np.full(n, -3.1), np.full(n, 2.9), most, **given)


@pytest.mark.parametrize(("apart", "boxes"), [(1.0, 94), (0.3, 152), (1.99, 83), (1.9999, 87)])
def test_two_circles_meet_in_two_places_that_few_boxes_show(apart: float, boxes: int) -> None:
    two = 1.0 if apart >= 1.0 else 0.9
    found = every(circles(apart, two))
    x = (apart * apart + 1.0 - two * two) / (2.0 * apart)
    y = math.sqrt(1.0 - x * x)
    assert (found.complete, found.movable, found.spent) == (True, False, False)
    assert sorted(map(tuple, found.found)) == [pytest.approx((x, s * y), abs=1e-12) for s in (-1, 1)]
    assert found.boxes <= 1.05 * boxes


@pytest.mark.parametrize(("apart", "boxes"), [(2.001, 85), (2.5, 49), (9.0, 1)])
def test_circles_apart_have_nothing_in_common_and_few_boxes_show_it(apart: float, boxes: int) -> None:
    found = every(circles(apart))
    assert (list(found.found), found.complete) == ([], True)
    assert found.boxes <= 1.05 * boxes, found.boxes


def test_circles_that_touch_have_a_double_solution_and_some_boxes_are_too_few() -> None:
    touching = every(circles(2.0))
    assert (touching.complete, touching.movable, touching.spent) == (False, False, False)
    assert np.allclose(touching.found, [1.0, 0.0], atol=1e-3)
    few = every(circles(1.0), most=3)
    assert (few.complete, few.spent) == (False, True)


def test_a_linear_equation_narrows_and_solutions_that_are_close_are_two() -> None:
    """The unit circle and a line that nearly touches it."""
    for gap, boxes in ((1e-2, 20), (1e-6, 37)):
        line = system((-1.0, {}, {(0, 0): 1.0, (1, 1): 1.0}), (gap - 1.0, {0: 0.6, 1: 0.8}, {}))
        found = every(line)
        half = math.sqrt(1.0 - (1.0 - gap) ** 2)
        along = sorted(float(z @ np.array([0.8, -0.6])) for z in found.found)
        assert along == [pytest.approx(s * half, rel=1e-5) for s in (-1, 1)]
        assert found.complete
        assert found.boxes <= 1.05 * boxes


# --- points of a box at a given distance ------------------------------------------------------------


def distant_pairs(seed: int, low: Any, high: Any, length: float) -> Any:
    """Places (ax, ay, bx, by) within a box whose two points are at a distance."""
    draw = np.random.default_rng(seed)
    start, way = draw.uniform(low[:2], high[:2], (20_000, 2)), draw.uniform(0.0, 2.0 * np.pi, 20_000)
    end = start + length * np.stack([np.cos(way), np.sin(way)], axis=1)
    places = np.hstack([start, end])
    return places[((places >= low) & (places <= high)).all(axis=1)]


@pytest.mark.parametrize("held", ["", "a", "b"])
def test_a_box_is_narrowed_to_the_places_at_a_distance_and_no_further(held: str) -> None:
    """None of them is cut off; of one axis by the other what is left ends where they do, or nearly."""
    rng, narrower = Random(f"box {held}"), 0
    for seed in range(40):
        low = np.array([rng.uniform(-1, 1) for _ in range(4)])
        high = low + [rng.choice([0.3, 1.0, 2.0]) for _ in range(4)]
        length = rng.uniform(0.2, 2.0)
        fixed = ((float(low[0]), float(low[1])), (float(low[2]), float(low[3])))
        if held == "a":
            high[:2] = low[:2]
        own = [0, 1] if held == "b" else [2, 3] if held == "a" else [0, 1, 2, 3]
        if held == "b":  # the same, seen from the other end
            turned = distant_pairs(seed, low[[2, 3, 0, 1]], np.hstack([low[2:], high[:2]]), length)
            places = turned[:, [2, 3, 0, 1]]
        else:
            places = distant_pairs(seed, low, high, length)
        columns = {"": (0, 2), "a": (-1, 0), "b": (0, -1)}[held]
        box_low, box_high = low[None, own].copy(), high[None, own].copy()
        _narrow_length(_Link(*columns, *fixed, length * length), box_low, box_high)
        inside = (places[:, own] >= box_low[0] - 1e-12) & (places[:, own] <= box_high[0] + 1e-12)
        assert inside.all()
        narrower += int((box_low[0] > low[own]).any() or (box_high[0] < high[own]).any())
        if held and len(places) > 100:
            ends = places[:, own].min(axis=0), places[:, own].max(axis=0)
            assert np.abs(box_low[0] - ends[0]).max() < 0.02 and np.abs(box_high[0] - ends[1]).max() < 0.02
    assert narrower > 10


def test_a_box_whose_points_are_too_near_or_too_far_apart_is_empty() -> None:
    for at, gone in ((1.9, True), (1.9995, False), (2.1, True)):
        for axis in (0, 1):
            low = np.zeros((1, 4))
            low[0, 2 + axis] = at
            high = low + 1e-3
            _narrow_length(_Link(0, 2, (0.0, 0.0), (0.0, 0.0), 4.0), low, high)
            assert bool((low > high).any()) is gone


# --- inequalities ---------------------------------------------------------------------------------------


@sampled(3)
@pytest.mark.parametrize("seed", range(60))
def test_the_range_that_inequalities_leave_is_that_of_their_corners(seed: int) -> None:
    """Planes of whole numbers cut a cube, or leave nothing of it: its corners, by solving for where any three
    meet. The point at each end keeps to all of them, to 1e-12."""
    dice = Random(f"inequalities {seed}")
    cube = [(9.0, *(side * float(n == k) for n in range(3))) for k in range(3) for side in (1.0, -1.0)]
    cuts = [(dice.randint(-8, 12), *(dice.randint(-5, 5) for _ in range(3))) for _ in range(5)]
    forms = [*cube, *(tuple(map(float, cut)) for cut in cuts)]
    corners = []
    for three in combinations(forms, 3):
        matrix = np.array([form[1:] for form in three])
        if abs(np.linalg.det(matrix)) > 1e-9:
            corner = np.linalg.solve(matrix, [-form[0] for form in three])
            if all(form[0] + np.dot(form[1:], corner) >= -1e-9 for form in forms):
                corners.append(corner)
    found = region(forms)
    if not corners:
        assert found.first is None
        return
    ends = min(corner[0] for corner in corners), max(corner[0] for corner in corners)
    assert found.first == pytest.approx(ends, rel=1e-12, abs=1e-12)
    for end in found.first or ():
        point = (end, *found.point(end))
        assert all(form[0] + np.dot(form[1:], point) >= -1e-12 for form in forms)


def test_a_region_without_a_wall_goes_to_infinity() -> None:
    """y >= |x| - 1 and y <= 3 leaves x in [-4, 4]; without the ceiling any x."""
    roof, walls = (3.0, 0.0, -1.0), [(1.0, 1.0, 1.0), (1.0, -1.0, 1.0)]
    assert region([*walls, roof]).first == (-4.0, 4.0)
    assert region(walls).first == (-math.inf, math.inf)
    assert region([*walls, (-2.0, 1.0, 0.0)]).first == (2.0, math.inf)
    assert region([*walls, (-2.0, 0.0, -1.0)]).first is None


@pytest.mark.parametrize("seed", range(400 if FULL else 60))
def test_the_deepest_point_of_inequalities_is_proven_by_their_shares(seed: int) -> None:
    """No form is less there than the depth, and shares of the forms, 1 in all and none negative, add up to
    the depth without variables: so no point is deeper (weak duality). To 1e-9, as numbers are about 1; two in
    five with small whole numbers, where many corners coincide. In whole numbers all of
    it is exact."""
    dice = Random(f"deepest {seed}")
    count, whole = dice.randint(0, 8), dice.random() < 0.4
    forms = []
    for _ in range(dice.randint(1, 25)):
        form = [dice.uniform(-1.0, 1.0) * (dice.random() < 0.6) for _ in range(count + 1)]
        forms.append(tuple([float(round(2.0 * a)) for a in form] if whole else form))
    exact = _simplex(forms, [1.0] * len(forms), exact=True)
    columns = zip(*(forms[k] for k in exact.of), strict=True)
    left = [sum(map(mul, map(Fraction, column), exact.shares)) for column in columns]
    at = [sum(map(mul, map(Fraction, form), (1, *exact.point))) for form in forms]
    assert not any(left[1:]) and min(exact.shares, default=0) >= 0 <= (rest := 1 - sum(exact.shares))
    assert min(at) >= exact.depth == (left[0] if left else 0) + rest
    found = deepest(forms)
    assert found.depth == pytest.approx(float(exact.depth), abs=1e-9)
    values = [form[0] + sum(a * x for a, x in zip(form[1:], found.point, strict=True)) for form in forms]
    assert min(values) >= found.depth - 1e-9
    sums = [
        sum(s * forms[k][j] for k, s in zip(found.of, found.shares, strict=True)) for j in range(count + 1)
    ]
    rest = 1.0 - sum(found.shares)
    assert min(found.shares, default=0.0) >= -1e-9 and rest >= -1e-9
    assert sums[1:] == pytest.approx([0.0] * count, abs=1e-9)
    assert sums[0] + rest == pytest.approx(found.depth, abs=1e-9)


@pytest.mark.parametrize(("least", "depth"), [(-1.0, 1.0), (0.5, 0.25), (2.0, -math.inf)])
def test_forms_that_do_not_count_may_leave_no_point(least: float, depth: float) -> None:
    """x from ``least`` to 1, whatever the depth, that is (1 - x) / 2: without a point where least is more."""
    assert deepest([(1.0, -1.0), (-least, 1.0), (0.5, -0.5)], [0.0, 0.0, 1.0]).depth == depth


@pytest.mark.parametrize("slope", [1e-9, 1e-13, 1e-17])
def test_an_end_that_lies_far_out_is_none_near_by(slope: float) -> None:
    """-1 <= x <= 1 / slope, of which x / 1000 is asked: it is 1 and more."""
    found = deepest(
        [(1.0, 1.0, 0.0), (1.0, -slope, 1.0), (1.0, 0.0, -1.0), (0.0, 1e-3, 0.0)], [0.0] * 3 + [1.0]
    )
    assert found.depth == 1.0
    assert 999.999 <= found.point[0] <= 2.0 / slope
