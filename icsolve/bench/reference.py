"""What is true of a scene: its program in sixty digits, and how sensitive its answer is.

mpmath is imported here only.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from icsolve.case import Case, Contact, Coordinates, Force, KnownCentre, Number
from icsolve.solve import refusals
from icsolve.solve.bounds import evaluate_bounded
from icsolve.solve.program import Program, Want, evaluate, prepare
from icsolve.units import ExactRatio

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

    def given(self, number: Number) -> Any:
        """The decimal as written, and the exact ratio of its unit."""
        return self.mp.mpf(number.digits) if number.exact is None else self.ratio(number.exact)


class Truth(NamedTuple):
    """The unknown load of a scene on the doubles as read, and its condition number."""

    value: Any
    kappa: float

    def error(self, value: float) -> float:
        """Relative error of a value."""
        return float(abs(value - self.value) / abs(self.value)) if self.value else abs(value)

    def per_unit(self, error: float) -> float:
        """A relative error over (kappa + 1) u: about 1 is as good as any method can promise."""
        return error / ((self.kappa + 1.0) * UNIT)


def truth(case: Case) -> Truth:
    """The unknown load of a case.

    Raises SceneError where it has none.
    """
    program = prepare(case, Want())
    _, outcome = evaluate(program, AsRead())
    refusals.refuse_unbalanced(case, program.top, outcome.motions, outcome.balance, outcome.solution)
    return Truth(next(iter(outcome.solution.values.values())), condition(program))


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
        if isinstance(joint, Contact):
            numbers.append(joint.normal)
        elif isinstance(joint, KnownCentre):
            numbers.append(joint.toward)
        guide = getattr(joint, "guide", None)
        numbers.append(guide.angle if guide is not None else None)
    numbers += [load.heading for load in case.loads if isinstance(load, Force)]
    return {n.path for n in numbers if isinstance(n, Number)}
