"""The error bound holds: against sixty digits on the file's decimals, on scenes of all joint kinds."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from fractions import Fraction
from random import Random
from statistics import median

import numpy as np
import pytest
from mpmath import mpf, pi, workdps

import growth
import icsolve
import loading
import mechanisms
import transcribe
from figures import from_lengths, without_order
from icsolve.case import Number
from icsolve.errors import SceneError
from icsolve.numbers.jets import BallArray, Jet
from icsolve.numbers.tape import decimal_noise
from icsolve.report import answer_text
from icsolve.scene.program import EvaluatedScene, Want, evaluate, prepare, unknown_values
from more_digits import SixtyDigits
from sizes import FULL, sampled

Measure = Callable[[mechanisms.Scene, Random], mechanisms.Scene | None]
PINNED = [mechanisms.four_bar, mechanisms.watt, mechanisms.stephenson, mechanisms.butterfly]
SLIDING = [mechanisms.slider_crank, mechanisms.coupler_slot, mechanisms.oldham, mechanisms.trammel]
TURNING = [mechanisms.gear_pair, mechanisms.epicyclic, mechanisms.belt, mechanisms.cam]


def pessimism(text: str) -> float:
    """Bound over true error; the law itself is asserted here."""
    program = prepare(icsolve.load(text), Want())
    _, exact = evaluate(program, SixtyDigits())
    scene = EvaluatedScene(program, certain=True).ask(unknown_values)
    worst = 1.0
    for w in exact.balance.wrenches:
        if w.root not in exact.solution.values:
            continue
        name, truth = w.load.name, w.ratio * exact.solution.values[w.root]
        found = scene[name]
        true = max(abs(found.value - truth) - mpf("1e-40") * abs(truth), mpf(0))
        assert found.error is not None
        assert true <= found.error, f"{name}: error {float(true):.3g} above its bound {found.error:.3g}"
        assert found.error <= 2.0 * math.ulp(found.value), f"{name}: {found.error:.3g} is more than two ulps"
        worst = max(worst, float(found.error / max(true, abs(found.value) * 2.0**-53)))
    return worst


@sampled(3)
@pytest.mark.parametrize("generator", PINNED + SLIDING + TURNING)
def test_the_bound_is_never_violated_on_a_family(generator: mechanisms.Generator) -> None:
    scenes = (loading.drawn(seed, generator) for seed in range(200 if FULL else 4))
    assert median(pessimism(transcribe.text(scene)) for scene in scenes) <= 100


@pytest.mark.parametrize("block", range(100 if FULL else 1))
def test_the_bound_is_never_violated_on_random_mechanisms(block: int) -> None:
    """Median pessimism at most 100: a bound that is far too wide tells nobody anything."""
    scenes = (growth.random_mechanism(Random(f"bound {block} {k}")) for k in range(20))
    assert median(pessimism(transcribe.text(scene)) for scene in scenes) <= 100


def by_lengths(generator: mechanisms.Generator, measure: Measure, count: int) -> list[str]:
    """Scenes of a family whose figure follows from lengths and a crank's direction."""
    texts: list[str] = []
    seed = 0
    while len(texts) < count:
        measured = measure(loading.drawn(seed, generator), Random(seed))
        if measured is not None:
            texts.append(transcribe.text(measured))
        seed += 1
    return texts


def test_the_bound_of_a_chain_from_lengths_does_not_explode() -> None:
    """Twelve four-bars in series: a running bound doubles at every dyad, the adjoint bound does not."""
    for text in by_lengths(mechanisms.chain(12), from_lengths, 40 if FULL else 2):
        assert pessimism(text) < 1e4


def test_the_bound_holds_for_a_double_butterfly_from_lengths() -> None:
    """Its six points have no order of construction: Newton, with one last recorded step."""
    for text in by_lengths(mechanisms.butterfly, without_order, 20 if FULL else 1):
        assert pessimism(text) < 1e4


TOGGLE = """
icsolve: 1
points: {A0: [0, 0], A: [1, 0], B: [%s, 2], B0: [3, 4]}
joints:
  - {pin: [1, 2], at: A0}
  - {pin: [2, 3], at: A}
  - {pin: [3, 4], at: B}
  - {pin: [4, 1], at: B0}
loads: {M4: {torque: 1, link: 4}, M2: {torque: unknown, link: 2}}
"""


@pytest.mark.parametrize("delta", ["1e-1", "1e-3", "1e-6", "1e-9", "1e-12"])
def test_near_a_dead_centre_the_digits_that_are_left_are_said(delta: str) -> None:
    """A, B and B0 within delta of a line: the bound grows as 1 / delta and holds."""
    digits = f"{2 + float(delta):.12f}"
    assert pessimism(TOGGLE % digits) < 1e3


@pytest.mark.parametrize("digits", ["2.0000000000000002", "1.9999999999999999", "2." + 37 * "0" + "1"])
def test_closer_than_doubles_can_tell_the_decimals_do(digits: str) -> None:
    """In closed form M2 is -1/2 over the gap; at the dead centre itself none will do."""
    found = icsolve.solve(icsolve.load(TOGGLE % digits)).answers["M2"]
    gap = Fraction(digits) - 2
    assert Fraction(found.value) == pytest.approx(Fraction(-1, 2) / gap, rel=1e-15)
    with pytest.raises(SceneError) as refused:
        icsolve.solve(icsolve.load(TOGGLE % "2.00"))
    assert refused.value.status == "dead-centre"


FAR = """
icsolve: 1
points: {A: [%s0.1, %s0.2], B: [%s1.3, %s2.7], C: [%s5.1, %s3.3], D: [%s6.2, %s0.4]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
loads: {T4: {torque: 1, link: 4}, T2: {torque: unknown, link: 2}}
"""


@pytest.mark.parametrize("offset", ["10000", "10000000000", "1000000000000"])
def test_no_number_of_the_text_has_digits_that_its_bound_leaves_open(offset: str) -> None:
    """Far from the origin the coordinates have lost digits: those that are shown of the answer, the ratio,
    rates, powers and velocities are those of the same figure at the origin, to one in the last."""
    near, far = (_numbers_of(FAR % ((text,) * 8)) for text in ("", offset))
    assert len(near) == len(far) > 20
    for (value, _), (shown, step) in zip(near, far, strict=True):
        assert abs(value - shown) <= 1.01 * step


def _numbers_of(text: str) -> list[tuple[float, float]]:
    """The numbers after the sections of coordinates, each with a unit of its last digit."""
    shown = answer_text(icsolve.solve(icsolve.load(text), rates=True), digits=14)
    kept = [part for part in shown.split("\n\n") if not part.startswith("Instant centres")]
    found = re.findall(r"(?<![\w.])-?\d+(?:\.(\d+))?(?:e(-?\d+))?", "\n\n".join(kept))
    numbers = re.finditer(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e-?\d+)?", "\n\n".join(kept))
    steps = [10.0 ** (int(power or 0) - len(decimals)) for decimals, power in found]
    return [(float(n.group()), step) for n, step in zip(numbers, steps, strict=True)]


TWO_FREEDOMS = """
icsolve: 1
points: {A: [0, 0], B: [0, 0.3], C: [0.7, 0.55], D: [1.1, 0.35], E: [1, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 5], at: D}
  - {pin: [5, 1], at: E}
"""


def test_the_centre_of_a_joint_has_its_bound_where_several_motions_are_possible() -> None:
    """As written in decimals: 0.7 and 0.55 are off by what doubles lose of them."""
    centres = icsolve.solve(icsolve.load(TWO_FREEDOMS), all_centres=True).centres
    pins = {("1", "2"): "A", ("2", "3"): "B", ("3", "4"): "C", ("4", "5"): "D", ("1", "5"): "E"}
    assert {pair for pair in pins if centres[pair].error is not None} == set(pins)
    error = centres["3", "4"].error
    assert error is not None and 1e-17 < error < 1e-14


GIVEN = "motion: [{link: 2, speed: 0.7 rad/s}, {link: 5, speed: 300 rpm}]\n"


def test_rates_and_centres_of_two_given_motions_have_bounds_that_hold() -> None:
    """The five-bar with both cranks driven, against closed forms in fifty digits: B and D are known, C moves
    square to BC seen from B and to CD seen from D."""
    answer = icsolve.solve(icsolve.load(TWO_FREEDOMS + GIVEN), rates=True, all_centres=True)
    with workdps(50):
        two, five = mpf("0.7"), 10 * pi
        b, c, d = (mpf(0), mpf("0.3")), (mpf("0.7"), mpf("0.55")), (mpf("1.1"), mpf("0.35"))
        vb, vd = (-two * b[1], mpf(0)), (-five * d[1], five * (d[0] - 1))
        u, v = (c[0] - b[0], c[1] - b[1]), (c[0] - d[0], c[1] - d[1])
        # vb + three (-uy, ux) = vd + four (-vy, vx)
        rhs, det = (vd[0] - vb[0], vd[1] - vb[1]), u[1] * v[0] - u[0] * v[1]
        three = -(rhs[0] * v[0] + rhs[1] * v[1]) / det
        four = -(rhs[0] * u[0] + rhs[1] * u[1]) / det
        truth = {"2": two, "3": three, "4": four, "5": five}
        for link, rate in truth.items():
            off, bound = abs(answer.rates[link] - rate), answer.errors["rates"][link]
            assert off <= bound < 1e-12 * abs(rate)
        x, y = b[0] - vb[1] / three, b[1] + vb[0] / three
        centre = answer.centres["1", "3"]
        assert centre.error is not None
        assert abs(centre.place[0] - x) + abs(centre.place[1] - y) <= centre.error < 1e-12
    assert all(one.error is not None for one in answer.centres.values())


@pytest.mark.parametrize(
    "written", ["0.1", "1.00000000000000005", "3", "2.7182818284590452353", "-123456.789", "1e-7"]
)
def test_a_written_decimal_is_half_a_unit_of_its_double_off_and_no_more(written: str) -> None:
    """Of a number without a unit's factor the rounding is that of reading it: 2^-53 of it."""
    number = Number(float(written), 0.0, "lengths.AB", written)
    true = abs(Fraction(written) - Fraction(number.value))
    assert true <= Fraction(decimal_noise(number)) <= Fraction(abs(number.value)) / 2**53


def test_bounds_about_the_middle_of_a_wide_cell_hold_the_whole_cell() -> None:
    """x^3 on cells of half-width 3: value, slope and bend of every place lie in their balls."""
    middles, half = np.array([-4.0, 0.0, 5.0]), np.full(3, 3.0)

    def cube(mid: np.ndarray, rad: np.ndarray) -> Jet:
        one, none = BallArray(np.ones(3), np.zeros(3)), BallArray(np.zeros(3), np.zeros(3))
        x = Jet(BallArray(mid, rad), one, none)
        return x * x * x

    found = cube(middles, half).within(cube(middles, np.zeros(3)), half)
    for share in np.linspace(-1.0, 1.0, 21):
        x = middles + share * half
        for ball, true in zip(found, (x**3, 3.0 * x**2, 6.0 * x), strict=True):
            assert (np.abs(true - ball.mid) <= ball.rad * (1.0 + 1e-12)).all()
