"""Sixty digits, the error of every method against them, and the laws that are held on random scenes."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator
from random import Random
from statistics import median
from typing import Any

from icsolve.bench.families import ALL_JOINTS, BOUNDED, EXACT, SIX_BARS, Draw, Family, scaled
from icsolve.bench.rivals import Failed, Method, OtherData, RivalFigure, drawn
from icsolve.case import Case, Coordinates, Force, Number
from icsolve.errors import SceneError
from icsolve.numbers.arithmetic import FLOATS
from icsolve.numbers.units import ExactRatio
from icsolve.read import load
from icsolve.scene import refusals
from icsolve.scene.program import Program, Want, evaluate, evaluate_bounded, prepare
from icsolve.solve import solve
from icsolve.tuples import NamedTuple

DIGITS = 60
UNIT = 2.0**-53


class AsRead:
    """An arithmetic of mpmath numbers on the doubles that were read: what is left is the method's error."""

    def __init__(self) -> None:
        from mpmath import mp

        mp.dps = DIGITS
        self.mp = mp

    def given(self, number: Number) -> Any:
        """The nearest double, exactly."""
        return self.mp.mpf(number.value)

    def ratio(self, exact: ExactRatio) -> Any:
        """As it is."""
        num, den, power = exact
        return self.mp.mpf(num) / den * self.mp.pi**power

    def turn(self, number: Number) -> tuple[Any, Any]:
        """Cosine and sine of an angle in degrees."""
        radians = self.given(number) * self.mp.pi / 180
        return self.mp.cos(radians), self.mp.sin(radians)

    def sqrt(self, value: Any) -> Any:
        """Square root; of rounding below zero: zero."""
        return self.mp.sqrt(max(self.mp.mpf(value), self.mp.mpf(0)))

    def angle(self, x: Any, y: Any) -> Any:
        """Direction of a vector in degrees."""
        return self.mp.degrees(self.mp.atan2(y, x))

    def vanishes(self, value: Any, size: float) -> bool:
        """Zero to two thirds of the digits."""
        return bool(abs(value) <= self.mp.mpf(10) ** -40 * size)


class AsWritten(AsRead):
    """The same on the decimals of the file: what a bound must cover."""

    rounds = 5
    """Newton's steps to these decimals from where doubles settled"""

    def given(self, number: Number) -> Any:
        """The decimal as written, and the exact ratio of its unit."""
        return self.mp.mpf(number.digits) if number.exact is None else self.ratio(number.exact)


class Truth(NamedTuple):
    """The unknown load of a scene on the doubles as read, its condition number, and the load on the decimals
    as written."""

    value: Any
    kappa: float
    written: Any

    def error(self, value: float, as_written: bool = False) -> float:
        """Relative error of a value."""
        true = self.written if as_written else self.value
        return float(abs(value - true) / abs(true)) if true else abs(value)

    def per_unit(self, error: float) -> float:
        """A relative error over (kappa + 1) u: about 1 is as good as any method can promise."""
        return error / ((self.kappa + 1.0) * UNIT)


def truth(case: Case) -> Truth:
    """The unknown load of a case.

    Raises SceneError where it has none.
    """
    program = prepare(case, Want())
    _, outcome = evaluate(program, AsRead())
    refusals.refuse_unbalanced(outcome._replace(place=outcome.place._replace(arithmetic=FLOATS)))
    _, written = evaluate(program, AsWritten())
    values = [next(iter(one.solution.values.values())) for one in (outcome, written)]
    return Truth(values[0], condition(program), values[1])


def condition(program: Program) -> float:
    """Relative change of the unknown load when every length and coordinate moves by one size of
    the mechanism and every angle by one radian, to first order, all at their worst."""
    scene = evaluate_bounded(program)
    value = next(iter(scene.outcome.solution.values.values()), 0.0)
    size, lengths, angles = size_of(program.case), _lengths(program.case), _angles(program.case)
    total = 0.0
    for path, slope in scene.tape.back(value).by_path.items():
        if path in lengths:
            total += abs(slope) * size
        elif path in angles:
            total += abs(slope) * math.degrees(1.0)
    return total / abs(value) if abs(value) > 0.0 else math.inf


def size_of(case: Case) -> float:
    """The larger side of a figure."""
    xs, ys = [], []
    for place in case.points.values():
        if isinstance(place, Coordinates) and place.x is not None and place.y is not None:
            xs.append(place.x.value)
            ys.append(place.y.value)
    spans = [max(axis) - min(axis) for axis in (xs, ys) if axis]
    return max([*spans, *(length.value.value for length in case.lengths)])


def _lengths(case: Case) -> set[str]:
    numbers = [n for place in case.points.values() if isinstance(place, Coordinates) for n in place]
    return {n.path for n in numbers if n is not None} | {length.value.path for length in case.lengths}


def _angles(case: Case) -> set[str]:
    numbers: list[object] = [angle.value for angle in case.angles]
    for joint in case.joints:
        numbers.append(joint.direction)
    numbers += [load.heading for load in case.loads if isinstance(load, Force)]
    return {n.path for n in numbers if isinstance(n, Number)}


WRONG = 0.1
"""A relative error above this is no answer."""


class Score(NamedTuple):
    """A method on a family.

    ``error`` and ``per_unit`` (the error over (kappa + 1) u) are the worst where there is an answer,
    ``micros`` the median time of a scene (where all are lost: until that shows); ``failed`` counts
    scenes without an answer or with a wrong one, ``refused`` those refused with a cause, of ``scenes``.
    """

    method: str
    family: str
    error: float
    per_unit: float
    micros: float
    failed: int
    refused: int
    scenes: int


class KnownAnswer(NamedTuple):
    """A scene and what is true of it."""

    scene: RivalFigure
    truth: Truth


def scenes(family: Family, count: int) -> Iterator[KnownAnswer]:
    """Scenes of a family that have an answer in exact arithmetic."""
    for k in range(count):
        case = load(family.draw(Random(f"{family.name} {k}")))
        try:
            known = KnownAnswer(drawn(case), truth(case))
        except SceneError:
            continue
        if known.truth.value != 0:
            yield known


def scored(method: Method, family: Family, known: Iterable[KnownAnswer]) -> Score:
    """Run a method on the scenes of a family; where it is made for other data it has no scenes."""
    errors, units, times, lost = [], [], [], []
    refused = 0
    for scene, true in known:
        try:
            tried = _tried(method, scene)
        except OtherData:
            continue
        error = true.error(tried.value, method.as_written) if math.isfinite(tried.value) else math.inf
        if error > WRONG:
            refused += tried.refused
            lost.append(tried.seconds)
            continue
        times.append(tried.seconds)
        errors.append(error)
        units.append(true.per_unit(error))
    worst, unit = max(errors, default=math.nan), max(units, default=math.nan)
    micros = 1e6 * median(times or lost or [math.nan])
    count = len(times) + len(lost)
    return Score(method.name, family.name, worst, unit, micros, len(lost) - refused, refused, count)


class Tried(NamedTuple):
    """A value (nan without one), its seconds, and whether the scene was refused with a cause."""

    value: float
    seconds: float
    refused: bool


def _tried(method: Method, scene: RivalFigure) -> Tried:
    """The better time of two runs, of this thread alone (matrix routines may wake others that wait);
    one that ends without an answer takes time too.

    Raises OtherData where the method is made for figures given in another way.
    """
    best, value, refused = math.inf, math.nan, False
    for _ in range(2):
        start = time.thread_time()
        try:
            value = float(method.run(scene))
        except SceneError:
            refused = True
        except (Failed, ArithmeticError, ValueError, TypeError, StopIteration):
            pass
        best = min(best, time.thread_time() - start)
    return Tried(value, best, refused)


FORWARD = 4.0
"""Forward error over (kappa + 1) u that no scene may exceed."""
PESSIMISM = 100.0
"""Bound over error that a median may have."""
SCALES = (-37, 11)
"""Powers of two for lengths and for loads."""
SCENES_A_JOB = 50


class Law(NamedTuple):
    """A law on a family: how many scenes were held to it, how many broke it, median and worst.

    For the forward error median and worst are of error / ((kappa + 1) u); for the bound, of bound / error.
    """

    family: str
    scenes: int
    broken: int
    median: float
    worst: float


Measure = Callable[[Case], float]
"""What a law says of a scene: the number that is tabled; negative where the law is broken."""


def forward_error(case: Case) -> float:
    """Forward error on the doubles as read, in units of (kappa + 1) u."""
    true = truth(case)
    value = solve(case, bound=False).answers["U"].value
    ratio = true.per_unit(true.error(value))
    return ratio if ratio <= FORWARD else -ratio


def bound_over_error(case: Case) -> float:
    """Error bound over the true error (half a unit of the value at least) against the file's decimals."""
    found = solve(case).answers["U"]
    program = prepare(case, Want())
    _, exact = evaluate(program, AsWritten())
    true = abs(found.value - next(iter(exact.solution.values.values())))
    assert found.error is not None
    ratio = found.error / max(float(true), abs(found.value) * 2.0**-53, math.ulp(0.0))
    return ratio if true <= found.error else -ratio


def bits_kept(case: Case) -> float:
    """1 where lengths and loads times powers of two give the same bits of the value; else -1."""
    value = solve(case, bound=False).answers["U"].value
    try:
        other = solve(scaled(case, *SCALES), bound=False).answers["U"].value
    except SceneError:
        return -1.0
    return 1.0 if other == math.ldexp(value, SCALES[1]) else -1.0


FORWARD_FAMILIES = (*SIX_BARS, ALL_JOINTS)
HELD = (*FORWARD_FAMILIES, *BOUNDED, *EXACT)


def held(measure: Measure, families: Iterable[Family], scenes: int, jobs: int = 1) -> list[Law]:
    """Hold a law on families, in so many processes."""
    return [_table(family.name, _all(measure, family, scenes // family.weight, jobs)) for family in families]


def _table(name: str, values: list[float]) -> Law:
    sizes = [abs(value) for value in values]
    broken = sum(value < 0.0 for value in values)
    return Law(name, len(values), broken, median(sizes or [math.nan]), max(sizes, default=math.nan))


def _all(measure: Measure, family: Family, scenes: int, jobs: int) -> list[float]:
    firsts = range(0, scenes, SCENES_A_JOB)
    if jobs == 1 or family not in HELD:
        return [value for k in firsts for value in _block(measure, family, k, scenes)]
    from multiprocessing import Pool

    blocks = [(measure, HELD.index(family), k, scenes) for k in firsts]
    with Pool(jobs) as pool:
        return [value for values in pool.starmap(_job, blocks) for value in values]


def _job(measure: Measure, place: int, first: int, scenes: int) -> list[float]:
    """A block in a process of its own, which finds the family by its place."""
    return _block(measure, HELD[place], first, scenes)


def _block(measure: Measure, family: Family, first: int, scenes: int) -> list[float]:
    seeds = range(first, min(first + SCENES_A_JOB, scenes))
    return list(_measured(measure, family.name, family.draw, seeds))


def _measured(measure: Measure, name: str, draw: Draw, seeds: Iterable[int]) -> Iterator[float]:
    """The scenes that have an answer; refusals are counted elsewhere."""
    for seed in seeds:
        try:
            yield measure(load(draw(Random(f"{name} {seed}"))))
        except SceneError:
            continue


def forward(scenes: int, jobs: int = 1) -> list[Law]:
    """The forward error on random six-bars."""
    return held(forward_error, FORWARD_FAMILIES, scenes, jobs)


def bounds(scenes: int, jobs: int = 1) -> list[Law]:
    """The error bound on random scenes of all joint kinds."""
    return held(bound_over_error, BOUNDED, scenes, jobs)


def bits(scenes: int, jobs: int = 1) -> list[Law]:
    """Powers of two, on scenes of all joint kinds and on figures from lengths."""
    return held(bits_kept, BOUNDED, scenes, jobs)
