"""Sixty digits, the error of every method against them, and the laws that are held on random scenes: among
them that of every number against 140 digits, and that of the rows of a sweep, which are their scenes."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from random import Random
from statistics import median
from typing import Any

from icsolve.answer import Answer
from icsolve.bench.families import ALL_JOINTS, SIX_BARS, Family, scaled
from icsolve.bench.rivals import Failed, Method, OtherData, RivalFigure, drawn
from icsolve.case import Case, Force, Number, Pair
from icsolve.errors import SceneError
from icsolve.files import can_fork, started
from icsolve.kinematics import speeds
from icsolve.numbers import FLOATS
from icsolve.numbers.units import ExactRatio, numbers_in
from icsolve.read import load
from icsolve.scene import refusals
from icsolve.scene.program import Program, Want, evaluate, evaluate_bounded, prepare
from icsolve.screws import subtract
from icsolve.solve import solve
from icsolve.statics.power import Outcome
from icsolve.sweep import sweep
from icsolve.sweep.varied_numbers import numbers_of, with_numbers
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
    case, total = program.case, 0.0
    lengths = {number.path for number in numbers_in(case.points, case.lengths)}
    directions = [joint.direction for joint in case.joints]
    headings = [load.heading for load in case.loads if isinstance(load, Force)]
    directions += [heading for heading in headings if isinstance(heading, Number)]
    angles = {number.path for number in numbers_in(*(angle.value for angle in case.angles), *directions)}
    size = size_of(case)
    for path, slope in scene.tape.back(value).by_path.items():
        if path in lengths:
            total += abs(slope) * size
        elif path in angles:
            total += abs(slope) * math.degrees(1.0)
    return total / abs(value) if abs(value) > 0.0 else math.inf


def size_of(case: Case) -> float:
    """The larger side of a figure."""
    axes = ([n.value for n in numbers_in(case.points) if n.path.endswith(axis)] for axis in (".x", ".y"))
    spans = [max(axis) - min(axis) for axis in axes if axis]
    return max([*spans, *(length.value.value for length in case.lengths)])


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


def scenes(family: Family, count: int) -> Iterator[tuple[RivalFigure, Truth]]:
    """Scenes of a family that have an answer in exact arithmetic, and what is true of them."""
    for k in range(count):
        case = load(family.draw(Random(f"{family.name} {k}")))
        try:
            scene, true = drawn(case), truth(case)
        except SceneError:
            continue
        if true.value != 0:
            yield scene, true


def scored(method: Method, family: Family, known: Iterable[tuple[RivalFigure, Truth]]) -> Score:
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


def held(measure: Measure, families: Iterable[Family], scenes: int, jobs: int = 1) -> list[Law]:
    """Hold a law on families, in so many processes; scenes that are refused are counted elsewhere."""
    laws = []
    for family in families:
        count = scenes // family.weight
        if jobs == 1 or not can_fork():
            values = _measured(measure, family, range(count))
        else:
            parts = [(_measured, (measure, family, range(k, count, jobs))) for k in range(jobs)]
            with started(parts) as found:
                values = [value for some in found() for value in some]
        sizes = [abs(value) for value in values]
        broken = sum(value < 0.0 for value in values)
        worst = max(sizes, default=math.nan)
        laws.append(Law(family.name, len(values), broken, median(sizes or [math.nan]), worst))
    return laws


def _measured(measure: Measure, family: Family, seeds: Iterable[int]) -> list[float]:
    """The law on the scenes that have an answer."""
    found = []
    for seed in seeds:
        with suppress(SceneError):
            found.append(measure(load(family.draw(Random(f"{family.name} {seed}")))))
    return found


# --- every number of a scene, and rows of sweeps ----------------------------------------------------


EVERY_DIGIT = 140
"""Digits in which every number of a scene is known."""
NOTHING = 1e-40
"""What is zero to within so much of its terms is zero."""


class Shown(NamedTuple):
    """A number of an answer beside the true one; ``size`` is that of its terms, ``error`` what the answer
    says of it (None: nothing)."""

    what: str
    value: float
    true: Any
    size: Any
    error: float | None = None

    @property
    def fault(self) -> str:
        """Why it is not the true one rounded once: within one unit in the last place, with an error of two
        at most that holds."""
        off = abs(self.true - self.value)
        rest, unit = NOTHING * (abs(self.size) + abs(self.true)), math.ulp(self.value)
        said = f"{self.what}: {self.value!r} is {float(off / unit):.3g} ulp off"
        if self.error is not None:
            if off > self.error + rest:
                return f"{said}, beyond its error {self.error:.3g}"
            if self.error > 2.0 * unit and not (self.value == 0.0 and self.error <= NOTHING * self.size):
                return f"{said}, with an error of {self.error:.3g}"
        return said if off > unit + rest else ""


def shown(case: Case) -> Iterator[Shown]:
    """Unknown loads, points, centres, rates and velocities of a scene.

    Raises SceneError where it has no answer.
    """
    arithmetic = AsWritten()
    with arithmetic.mp.workdps(EVERY_DIGIT):
        answer = solve(case, all_centres=True, rates=True)
        program, exact = evaluate(prepare(answer.case, Want(True, True)), arithmetic)
        for w in exact.balance.wrenches:
            if w.root in exact.solution.values:
                found, true = answer.answers[w.load.name], w.ratio * exact.solution.values[w.root]
                yield Shown(w.load.name, found.value, true, max(abs(true), 1e3), found.error)
        yield from _points(answer, program, exact, arithmetic.mp)
        if exact.motions.mobility == 1:
            yield from _centres(answer, program, exact, arithmetic.mp)
        yield from _rates(answer, program, exact)


def _points(answer: Answer, program: Program, exact: Outcome, mp: Any) -> Iterator[Shown]:
    ox, oy, scale = program.figure.frame
    for name, place in answer.points.items():
        for part, at, origin in zip(place, exact.points[name], (ox, oy), strict=True):
            yield Shown(name, part, mp.mpf(at) / scale + origin, 1 / scale + abs(origin))


def _centres(answer: Answer, program: Program, exact: Outcome, mp: Any) -> Iterator[Shown]:
    ox, oy, scale = program.figure.frame
    none = NOTHING * max(abs(x) for ts in exact.motions.twists.values() for t in ts for x in t)
    for pair, centre in answer.centres.items():
        x, y, w = subtract(*(exact.motions.twists[link][0] for link in reversed(pair)))
        if max(map(abs, (x, y, w))) <= none:
            continue
        if centre.kind == "at":
            worst = 2.0 * math.ulp(max(map(abs, centre.place)))
            if centre.error is None or centre.error > worst or abs(w) <= none:
                yield Shown(_named(pair), math.inf, 0, 0)
                continue
            for part, above, origin in zip(centre.place, (x, y), (ox, oy), strict=True):
                size = (abs(x) + abs(y)) / abs(w) / scale + abs(origin)
                yield Shown(_named(pair), part, mp.mpf(above) / w / scale + origin, size)
        elif centre.kind == "toward":
            true = mp.degrees(mp.atan2(y, x)) % 180
            if abs(w) > NOTHING * max(abs(x), abs(y)) + none or min(true, 180 - true) > NOTHING:
                yield Shown(_named(pair), centre.place[0], true, 180.0, centre.error)


def _named(pair: Pair) -> str:
    return f"I{pair[0]}-{pair[1]}"


def _rates(answer: Answer, program: Program, exact: Outcome) -> Iterator[Shown]:
    case, frame, twists = program.case, program.figure.frame, exact.motions.twists
    speed = speeds.speed_of(exact.place, twists)
    rates, velocities = answer.rates or {}, answer.velocities or {}
    largest = max(speeds.fastest(twists) * sum(map(abs, speed.particular)) / abs(speed.divisor), 1.0)
    for link, rate in speeds.link_rates(case, twists, speed).items():
        if not isinstance(rate, str):
            yield Shown(f"w{link}", float(rates[link]), rate, largest, answer.errors["rates"][link])
    for key, both in speeds.point_velocities(exact.place, twists, speed).items():
        if not isinstance(both, str):
            for part, true in zip(velocities[key], both, strict=True):
                value = float(part)  # type: ignore[arg-type]
                yield Shown(f"v {key[0]} on {key[1]}", value, true, largest / frame.scale)


def faultless(numbers: Callable[[Case], Iterable[Shown]], case: Case) -> float:
    """How many ``numbers`` of a scene were held to their law; negative where one breaks it."""
    faults = [one.fault for one in numbers(case)]
    return -1.0 if any(faults) else float(len(faults))


def friction_ends(case: Case) -> Iterator[Shown]:
    """The ends of the range of the crank's torque that holds a slider-crank of which all joints rub.

    In closed form, crank A B from the origin, slider C pushed to the left by P: the rod's force acts along a
    common tangent of its two friction circles (radii r sin(atan(mu))), the crank's torque balances that force
    at B and at the friction circle of A (J. L. Meriam, L. G. Kraige, Statics, 6/6). The senses of the rubs
    are those of turning one way and the other.
    """
    arithmetic = AsWritten()
    with arithmetic.mp.workdps(EVERY_DIGIT):
        mp, numbers = arithmetic.mp, numbers_of(case)
        given = {path: arithmetic.given(number) for path, number in numbers.items()}
        pins = [f"joints.{at}" for at in ("A", "B", "3-4@C")]
        circles = [given[f"{at}.radius"] * mp.sin(mp.atan(given[f"{at}.mu"])) for at in pins]
        cos, sin = arithmetic.turn(numbers["angles.AB"])
        bx, by, rod = given["lengths.AB"] * cos, given["lengths.AB"] * sin, given["lengths.BC"]
        inclined = mp.asin((given["points.C.y"] - by) / rod)
        ends = []
        for turning in (1, -1):
            rate = -turning * bx / (rod * mp.cos(inclined))
            senses = (turning, mp.sign(rate - turning), mp.sign(rate))
            a, b, c = (sense * radius for sense, radius in zip(senses, circles, strict=True))
            slides = mp.sign(-turning * by - rod * mp.sin(inclined) * rate)
            tangent = inclined - mp.asin((b + c) / rod)
            wall = slides * given["joints.4-1@C.mu"] * abs(mp.sin(tangent))
            force = given["loads.P"] / (mp.cos(tangent) - wall)
            ends.append(force * (bx * mp.sin(tangent) - by * mp.cos(tangent) + a - b))
        found = solve(case).answers["U"]
        assert found.holds is not None
        worst = max(math.ulp(end) for end in found.holds)
        for end, true in zip(found.holds, sorted(ends), strict=True):
            exact = found.error is not None and found.error <= 2.0 * worst
            yield Shown("end", end if exact else math.inf, true, max(abs(true), 1))


STEPS = (0.0, 1e-9, -1e-3)
"""By these fractions of itself a number is varied: its own first. One that poses the figure moves the
mechanism in a sweep and is read anew in a scene, so of it only its own value is the same in both."""


def every_row(case: Case) -> float:
    """How many rows of a sweep have status and value of their scenes; negative where one has not."""
    numbers = sorted(numbers_of(case))
    held = 0
    for path in numbers[:: max(len(numbers) // 3, 1)]:
        own = numbers_of(case)[path].value
        shapes = path.startswith(("lengths", "loads"))
        rows = [own + step * (abs(own) or 1.0) for step in STEPS[: None if shapes else 1]]
        try:
            found = sweep(case, {path: rows}, ("answers", "status", "error"))
        except SceneError:
            continue
        for n, row in enumerate(rows):
            scene = case if row == own else with_numbers(case, {path: row})
            answers, errors = (of.get("U", [math.nan] * len(rows)) for of in (found.answers, found.error))
            if not _is_row_of(found.status[n], answers[n], errors[n], scene):
                return -1.0
            held += 1
    return float(held)


def _is_row_of(status: str, value: float, error: float, scene: Case) -> bool:
    """Whether a row has what its scene has."""
    try:
        one = solve(scene).answers["U"]
    except SceneError as refusal:
        return status == refusal.status
    return status == "ok" and abs(value - one.value) <= error + (one.error or 0.0)
