"""A figure's digits: near its dead centres, far from the origin, at any scale, in any arithmetic."""

from __future__ import annotations

import math
from dataclasses import replace
from decimal import Decimal, localcontext

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from icsolve.assembly import Figure, case_point, place, solve_figure
from icsolve.assembly.refusals import step_words
from icsolve.case import Case, Coordinates, Number
from icsolve.errors import SceneError, Status
from icsolve.numbers import Floats, Scalar, turn_of
from icsolve.numbers.balls import Balls
from icsolve.numbers.tape import Tape
from icsolve.read import load
from sizes import FULL, sampled
from test_figure import FOUR_BAR, LOOP, PINS, butterfly, case

U = 2.0**-53
DYAD = "points: {{A: [0, 0], C: [{c!r}, 0]}}\nlengths: {{AB: {a!r}, BC: {b!r}}}\nnear: {{B: [{a!r}, 5]}}\n"
DYAD += PINS.replace("{", "{{").replace("}", "}}")


class Digits:
    """Sixty digits, of the doubles as read."""

    rounds = 8

    def given(self, number: Number) -> Scalar:
        return mpmath.mpf(number.value)

    def turn(self, number: Number) -> tuple[Scalar, Scalar]:
        angle = mpmath.radians(mpmath.mpf(number.value))
        return mpmath.cos(angle), mpmath.sin(angle)

    def sqrt(self, value: Scalar) -> Scalar:
        return mpmath.sqrt(value)

    def vanishes(self, value: Scalar, size: float) -> bool:
        return bool(abs(value) < mpmath.mpf(10) ** -50 * size)


class FarOff(Floats):
    """Floats that groups take more steps of Newton's method with, from farther off."""

    rounds = 6


class Swept:
    """Arrays for the numbers of some paths."""

    rounds = 8

    def __init__(self, **arrays: np.ndarray) -> None:
        self.arrays = {path.replace("__", "."): values for path, values in arrays.items()}

    def given(self, number: Number) -> Scalar:
        return self.arrays.get(number.path, number.value)

    def turn(self, number: Number) -> tuple[Scalar, Scalar]:
        if number.path not in self.arrays:
            return turn_of(number.value)
        angle = np.radians(self.arrays[number.path])
        return np.cos(angle), np.sin(angle)

    def sqrt(self, value: Scalar) -> Scalar:
        return np.sqrt(value)

    def vanishes(self, value: Scalar, size: float) -> bool:
        return bool(np.all(np.abs(value) < 1e-14 * size))


def case_points(figure: Figure) -> dict[str, tuple[float, float]]:
    return {p: case_point(figure.frame, at) for p, at in figure.points.items()}


def moved(one: Case, scale: float, dx: float = 0.0, dy: float = 0.0) -> Case:
    """The same figure at another scale and place; angles stand."""

    def coordinate(number: Number | None, d: float) -> Number | None:
        return number and number._replace(value=number.value * scale + d)

    points = {
        p: Coordinates(coordinate(at.x, dx), coordinate(at.y, dy)) if isinstance(at, Coordinates) else at
        for p, at in one.points.items()
    }
    lengths = tuple(e._replace(value=e.value._replace(value=e.value.value * scale)) for e in one.lengths)
    near = {p: (x * scale + dx, y * scale + dy) for p, (x, y) in one.near.items()}
    return replace(one, points=points, lengths=lengths, near=near)


def exact_error(one: Case, figure: Figure) -> float:
    """Largest distance from the same construction in sixty digits (normalised: the size is about 1)."""
    with mpmath.workdps(60):
        exact = place(figure, one, Digits()).points
        return max(
            float(mpmath.hypot(exact[p][0] - at[0], exact[p][1] - at[1])) for p, at in figure.points.items()
        )


@pytest.mark.parametrize("exponent", range(1, 15))
@pytest.mark.parametrize("stretched", [True, False])
def test_dyad_near_its_dead_centre_is_as_exact_as_its_data(exponent: int, stretched: bool) -> None:
    """numerics.md section 3: factored Heron stays at 1 kappa u, kappa about 1 / sqrt(2 delta) of the arm."""
    a, b = 2.0, 3.0
    c = (a + b) * (1 - 10.0**-exponent) if stretched else (b - a) * (1 + 10.0**-exponent)
    one = case(DYAD.format(a=a, b=b, c=c))
    figure = solve_figure(one)
    with mpmath.workdps(60):
        exact = place(figure, one, Digits()).points["B"]
        kappa = max(_sensitivities(one, figure))
    error = math.hypot(float(exact[0] - figure.points["B"][0]), float(exact[1] - figure.points["B"][1]))
    assert error <= 4 * (kappa + 1) * U
    assert kappa > 0.03 * 10 ** (exponent / 2)


def _sensitivities(one: Case, figure: Figure) -> list[float]:
    """How far B moves (normalised) as each number of the dyad moves by one, in sixty digits."""
    step = mpmath.mpf(10) ** -35
    base = place(figure, one, Digits()).points["B"]
    out = []
    for path in ("lengths.AB", "lengths.BC", "points.C.x"):

        class Nudged(Digits):
            moved_path = path

            def given(self, number: Number) -> Scalar:
                return mpmath.mpf(number.value) + (step if number.path == self.moved_path else 0)

        there = place(figure, one, Nudged()).points["B"]
        out.append(float(mpmath.hypot(there[0] - base[0], there[1] - base[1]) / step))
    return out


@pytest.mark.parametrize(("a", "b", "c"), [(2, 3, 5), (0.1, 0.2, 0.3), (2, 5, 3), (0.1, 0.7, 0.6)])
def test_exactly_at_the_dead_centre_there_is_one_way(a: float, b: float, c: float) -> None:
    """Also where the decimals' rounding makes the gap 5.6e-17 and not zero; never a root of -1e-17."""
    text = DYAD.format(a=float(a), b=float(b), c=float(c)).replace("near", "#")
    figure = solve_figure(case(text))
    x, y = case_points(figure)["B"]
    assert y == 0.0
    assert abs(x) == pytest.approx(a, rel=1e-15)
    assert "(touching)" in step_words(figure.steps[-1])


def test_a_dead_centre_on_the_3_4_5_line() -> None:
    figure = solve_figure(case("points: {A: [0, 0], C: [3, 4]}\nlengths: {AB: 2, BC: 3}\n" + PINS))
    assert math.dist(case_points(figure)["B"], (1.2, 1.6)) < 5e-16


def test_a_gap_of_1e_12_is_a_gap() -> None:
    """Stretched to within 1e-12: B is 1e-6 off the line, right to four digits, as its data are."""
    figure = solve_figure(case(DYAD.format(a=2.0, b=3.0, c=5.0 - 5e-12)))
    exact = math.sqrt(2 * 5e-12 * 2 * 3 / 5)
    assert case_points(figure)["B"][1] == pytest.approx(exact, rel=2e-4)


FIGURES = {
    "four-bar": FOUR_BAR + "near: {C: [3.5, 2.4]}\n" + LOOP,
    "butterfly": butterfly("near: {F: [2.05, 2.55]}\n"),
    "carried": "points: {A: [0, 0], D: [4, 0]}\nlengths: {AB: 1, BE: 1.5, EC: 2.2, CD: 2.5}\n"
    "angles: {AB: 60, BEC: 175}\nnear: {C: [3.5, 2.4]}\n" + LOOP + "links: {3: [E]}\n",
    "slider": "points: {A: [0, 0], G: [-2, 0.5]}\nlengths: {AB: 1, BC: 3}\n"
    "angles: {AB: 60}\nnear: {C: [3, 0]}\n"
    + PINS + "  - {slide: [4, 1], at: C, along: 20, through: G}\n",
}  # fmt: skip


@sampled(2, "name", "k")
@pytest.mark.parametrize("name", FIGURES)
@pytest.mark.parametrize("k", [-990, -40, 1, 40, 990] if FULL else [-990, 1, 40])
def test_a_power_of_two_scales_bit_for_bit(name: str, k: int) -> None:
    one = case(FIGURES[name])
    base, scaled = solve_figure(one), solve_figure(moved(one, 2.0**k))
    assert scaled.points == base.points
    there = {p: (x * 2.0**k, y * 2.0**k) for p, (x, y) in case_points(base).items()}
    assert case_points(scaled) == there


@pytest.mark.parametrize("name", FIGURES)
@pytest.mark.parametrize("scale", [1e-300, 1e-12, 1e12, 1e300] if FULL else [1e-12, 1e300])
def test_any_scale_of_the_figure(name: str, scale: float) -> None:
    """Decimal factors round each number once: a few roundings times the figure's own sensitivity."""
    one = case(FIGURES[name])
    base, scaled = case_points(solve_figure(one)), case_points(solve_figure(moved(one, scale)))
    assert max(math.dist((scaled[p][0] / scale, scaled[p][1] / scale), base[p]) for p in base) < 1e-13


@sampled(2)
@pytest.mark.parametrize("name", FIGURES)
@pytest.mark.parametrize("offset", [1e3, 1e6, 1e10] if FULL else [1e3, 1e10])
def test_far_from_the_origin_nothing_is_lost(name: str, offset: float) -> None:
    """Offsets by which the coordinates stay exact: the same normalised figure, to the last bit."""
    one = case(FIGURES[name].replace("1.6, -0.4", "1.5, -0.5").replace("3.4, 0.3", "3.5, 0.25"))
    shift = 2.0 ** round(math.log2(offset))
    there = moved(one, 1.0, shift, -shift)
    base, found = solve_figure(one).points, solve_figure(there).points
    if (
        name == "butterfly"
    ):  # starts at near, whose digits an offset cuts: another last bit after Newton's steps
        assert max(math.dist(found[p], base[p]) for p in base) < 4e-15
    else:
        assert found == base


@pytest.mark.parametrize("name", FIGURES)
def test_the_figure_agrees_with_sixty_digits(name: str) -> None:
    one = case(FIGURES[name])
    figure = solve_figure(one)
    assert exact_error(one, figure) < 20 * U


@given(st.integers(-1800, 1800), st.integers(-500, 500), st.integers(-500, 500))
def test_a_rigid_motion_of_the_data_moves_the_figure(turn: int, dx: int, dy: int) -> None:
    c, s = turn_of(turn / 10)
    base = case_points(solve_figure(case(FIGURES["carried"])))

    def at(x: float, y: float) -> str:
        return f"[{c * x - s * y + dx / 100:.17g}, {s * x + c * y + dy / 100:.17g}]"

    text = FIGURES["carried"].replace("[0, 0]", at(0, 0)).replace("[4, 0]", at(4, 0))
    text = text.replace("AB: 60", f"AB: {60 + turn / 10!r}").replace("[3.5, 2.4]", at(3.5, 2.4))
    there = case_points(solve_figure(case(text)))
    for p, (x, y) in base.items():
        assert math.dist(there[p], (c * x - s * y + dx / 100, s * x + c * y + dy / 100)) < 1e-13


def test_place_runs_the_same_construction_on_arrays() -> None:
    """A crank through its range: every row as the figure of that row."""
    one = case(FIGURES["four-bar"])
    angles = np.linspace(40.0, 110.0, 15)
    swept = place(solve_figure(one), one, Swept(angles__AB=angles))
    for k, angle in enumerate(angles):
        row = solve_figure(case(FIGURES["four-bar"].replace("AB: 60", f"AB: {float(angle)!r}")))
        found = (float(swept.points["C"][0][k]), float(swept.points["C"][1][k]))
        assert math.dist(found, row.points["C"]) < 1e-15


def test_the_margins_tell_where_an_array_does_not_assemble() -> None:
    text = FIGURES["four-bar"].replace("AB: 1, BC: 3.5", "AB: 2, BC: 1.5")
    text = text.replace("AB: 60", "AB: 20")
    one = case(text)
    angles = np.array([20.0, 60.0, 180.0])
    with np.errstate(invalid="ignore"):
        swept = place(solve_figure(one), one, Swept(angles__AB=angles))
    ok = np.all([np.asarray(m) >= 0 for m in swept.margins["C"]], axis=0)
    assert list(ok) == [True, True, False]
    assert list(np.isfinite(swept.points["C"][0])) == [True, True, False]


def test_a_newton_group_follows_on_arrays_from_its_own_solution() -> None:
    text = butterfly("near: {F: [2.05, 2.55]}\n")
    one = case(text)
    figure = solve_figure(one)
    crank = next(a.value for a in one.angles if a.value.path == "angles.AD")
    angles = crank.value + np.array([-0.5, 0.0, 0.5])
    swept = place(figure, one, Swept(angles__AD=angles))
    for k, angle in enumerate(angles):
        row = solve_figure(case(text.replace(crank.digits, repr(float(angle)))))
        for p in "FGHIJ":
            found = (float(swept.points[p][0][k]), float(swept.points[p][1][k]))
            assert math.dist(found, row.points[p]) < 1e-14


@pytest.mark.parametrize("name", FIGURES)
def test_one_recorded_step_carries_the_derivatives(name: str) -> None:
    """The tape's sensitivity to each length against central differences of the solved figure."""
    one = case(FIGURES[name])
    figure = solve_figure(one)
    tape = Tape()
    last = list(figure.points)[-1]
    taped = place(figure, one, tape).points[last][0]
    assert float(taped) == pytest.approx(figure.points[last][0], abs=4e-15)
    by_path = tape.back(taped).by_path
    for k, length in enumerate(one.lengths):
        ends = []
        for d in (1e-6, -1e-6):
            value = length.value._replace(value=length.value.value + d)
            lengths = (*one.lengths[:k], length._replace(value=value), *one.lengths[k + 1 :])
            ends.append(place(figure, replace(one, lengths=lengths), FarOff()).points[last][0])
        slope = (ends[0] - ends[1]) / 2e-6
        assert by_path.get(length.value.path, 0.0) == pytest.approx(slope, abs=2e-8)


# --- beside a limit, by the decimals as written ---


def limit_angle(digits: int) -> Decimal:
    """The crank angle at which rods of 1.5 and 1.75 reach from B to D stretched, in degrees."""
    with mpmath.workdps(digits):
        return Decimal(mpmath.nstr(mpmath.degrees(mpmath.acos(mpmath.mpf("9.4375") / 16)), digits))


STRETCHED = """icsolve: 1
points: {{A: [0, 0], D: [4, 0]}}
lengths: {{AB: 2, BC: 1.5, CD: 1.75}}
angles: {{AB: {angle}}}
near: {{C: [3, 1.5]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 1], at: D}}
"""


@pytest.mark.parametrize("exponent", [*range(3, 20), 25, 40])
def test_beside_a_limit_the_decimals_decide_whether_it_assembles(exponent: int) -> None:
    with localcontext() as context:
        context.prec = 70
        limit, off = limit_angle(65), Decimal(10) ** -exponent
        inside, beyond = load(STRETCHED.format(angle=limit - off)), load(STRETCHED.format(angle=limit + off))
    figure = solve_figure(inside)
    (bx, by), (cx, cy), (dx, dy) = (case_point(figure.frame, figure.points[p]) for p in "BCD")
    # the triangle's height over BD, from its three sides: 2 A / |BD|
    height = abs((cx - bx) * (dy - by) - (cy - by) * (dx - bx)) / math.hypot(dx - bx, dy - by)
    gap = 2 * 4 * math.sin(math.radians(float(limit))) * math.radians(float(off)) / 3.25
    expected = math.sqrt(2 * gap * 1.5 * 1.75 / 3.25)
    assert height == pytest.approx(expected, rel=1e-2, abs=1e-14)
    with pytest.raises(SceneError) as refused:
        solve_figure(beyond)
    assert refused.value.status == Status.CANNOT_ASSEMBLE


FLAT = [("0.1", "0.2", "0.3"), ("1.1", "2.2", "3.3"), ("0.7", "0.1", "0.6")]


@pytest.mark.parametrize(("a", "b", "c"), FLAT)
def test_the_decimals_tell_a_gap_of_nothing_from_one_of_the_twentieth_digit(a: str, b: str, c: str) -> None:
    def span(c: str) -> Figure:
        text = f"icsolve: 1\npoints: {{A: [0, 0], C: [{c}, 0]}}\nlengths: {{AB: {a}, BC: {b}}}\n"
        return solve_figure(load(text + "near: {B: [0.1, 1]}\njoints:\n  - {pin: [1, 2], at: A}\n"), ["B"])

    more, less = c + "0" * 18 + "1", str(Decimal(c) - Decimal(10) ** -20)
    stretched = Decimal(a) + Decimal(b) == Decimal(c)
    assert "(touching)" in step_words(span(c).steps[-1])
    assert "(touching)" not in step_words(span(less if stretched else more).steps[-1])
    with pytest.raises(SceneError) as refused:
        span(more if stretched else less)
    assert refused.value.status == Status.CANNOT_ASSEMBLE


def test_lines_that_are_parallel_but_for_the_twentieth_digit_meet() -> None:
    text = (
        "icsolve: 1\npoints: {{A: [0, 0], B: [0, 1]}}\nangles: {{AC: 30, BC: {}}}\n"
        "joints:\n  - {{pin: [1, 2], at: A}}\n"
    )
    figure = solve_figure(load(text.format("29.99999999999999999999")), ["C"])
    x, _ = case_point(figure.frame, figure.points["C"])
    assert x == pytest.approx(math.cos(math.radians(30)) ** 2 / math.radians(1e-20), rel=1e-9)
    for angle in ("30", "30.00000000000000000001"):
        with pytest.raises(SceneError):
            solve_figure(load(text.format(angle)), ["C"])


@pytest.mark.parametrize("power", ["", "e4", "e-4"])
def test_two_spellings_of_one_double_are_one_place(power: str) -> None:
    """However large the figure is."""
    b, g = (f"[{x}{power}, 0.4{power}]" for x in ("0.1", "0.100000000000000001"))
    text = f"icsolve: 1\npoints: {{A: [0, 0], B: {b}, G: {g}}}\n"
    joints = "joints:\n  - {pin: [1, 2], at: A}\n"
    figure = solve_figure(load(text + joints))
    exact = place(figure, load(text + joints), Balls(30)).points
    assert figure.points["B"] == figure.points["G"]
    assert [float(a - b) for a, b in zip(exact["B"], exact["G"], strict=True)] == [0.0, 0.0]


@sampled(2)
@pytest.mark.parametrize("stages", [60, 190])
def test_scissors_whose_straight_bars_say_all_their_lengths(stages: int) -> None:
    """Each bar's three lengths make a flat triangle, so that every step is in doubt: none runs twice. Along
    190 stages the radii of balls outgrow any digits, and the errors do not."""
    turn = math.radians(40)
    width, height = 2 * math.cos(turn), 2 * math.sin(turn)
    lengths, near = [], {"R0": (width, 0.0)}
    for k in range(stages):
        for foot, head in (("L", "R"), ("R", "L")):
            lengths += [f"{foot}{k}-C{k}: 1", f"C{k}-{head}{k + 1}: 1", f"{foot}{k}-{head}{k + 1}: 2"]
        near[f"C{k}"] = (width / 2, (k + 0.5) * height)
        near |= {f"L{k + 1}": (0.0, (k + 1) * height), f"R{k + 1}": (width, (k + 1) * height)}
    where = ", ".join(f"{p}: [{x:.4f}, {y:.4f}]" for p, (x, y) in near.items())
    text = (
        f"points: {{L0: [0, 0]}}\nlengths: {{{', '.join(lengths)}}}\nangles: {{L0-C0: 40}}\n"
        f"near: {{{where}}}\n"
        "joints:\n  - {pin: [1, 2], at: L0}\n  - {slot: [3, 1], at: R0, along: 0, through: L0}\n"
    )
    figure = solve_figure(case(text), list(near))
    x, y = case_points(figure)[f"L{stages}"]
    assert (x, y) == pytest.approx((0.0, stages * height), abs=1e-9 * stages)
