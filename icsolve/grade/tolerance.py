"""How far an answer may lie from the right one: of itself, of the loads, or as a drawing allows."""

from __future__ import annotations

import math
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal

from icsolve.answer import Answer
from icsolve.case import (
    Area,
    Force,
    ForceVector,
    Load,
    Number,
    Spring,
    Stretch,
    Torque,
    TorsionSpring,
    Weight,
    is_angle,
    is_named,
)
from icsolve.case.expected import (
    LoadIs,
    PositionIs,
    RateIs,
    RatioIs,
    ReactionIs,
    SpeedIs,
    Target,
    TensionIs,
    Tolerance,
    dimension_of,
)
from icsolve.errors import IcsolveError, SceneError
from icsolve.grade.mistakes.engine import solved_for
from icsolve.grade.written.words import factors_between, unit_word
from icsolve.numbers.units import DIMENSIONS, Unit, nearest, numbers_in, parse_unit, split_quantity
from icsolve.read.reading import unit_names
from icsolve.report.check import value_of
from icsolve.scene.sensitivity import band
from icsolve.tuples import replace

SLACK = 1e-9
"""Relative room, so that 101 passes for 100 within 1 %."""
_FIGURES = 1.02
"""A unit in the last figure is taken this much wider, as graders that count figures do."""


DEFAULT = Tolerance(relative=0.01)


def half_width(tolerance: Tolerance, value: float, absolute: float, zero: float) -> float:
    """Half the width of the accepted band about ``value``, in its unit.

    ``absolute`` is the tolerance's own width in that unit; ``zero`` the width for a true zero, which
    has no relative band.
    """
    if value == 0.0:
        return max(zero, absolute)
    size = abs(value)
    figures = tolerance.figures
    unit_of_figure = 10.0 ** (math.floor(math.log10(size)) - figures + 1) if figures else 0.0
    return max(tolerance.relative * size, absolute, 0.5 * unit_of_figure * _FIGURES) + SLACK * size


def in_words(tolerance: Tolerance) -> str:
    """What a student may know before the answer: ``within 1 % of the right value``."""
    parts = []
    if tolerance.relative:
        parts.append(f"within {100.0 * tolerance.relative:.10g} % of the right value")
    if tolerance.figures:
        parts.append(f"right to {tolerance.figures} significant figures")
    if tolerance.absolute:
        parts.append(f"within {tolerance.absolute:.10g} {tolerance.unit}".rstrip() + " of the right value")
    if tolerance.drawing:
        parts.append(f"within what a drawing accurate to {tolerance.drawing} allows")
    return " or ".join(parts)


def range_in_words(value: float, half: float, unit: str, signed: bool = False) -> str:
    """The accepted band: ``from 408.6 to 416.8 N``; of magnitudes, where signs are judged apart. Both ends
    that are told are accepted."""
    middle = value if signed else abs(value)
    low, high = middle - half if signed else max(middle - half, 0.0), middle + half
    ends = rounded(low, half, ROUND_CEILING), rounded(high, half, ROUND_FLOOR)
    return f"from {ends[0]} to {ends[1]} {unit}".rstrip()


def rounded(number: float, half: float, way: str) -> str:
    """Three figures of the band's own width, no more, rounded ``way``: into the band."""
    if half <= 0.0 or not math.isfinite(half):
        return f"{number:.10g}"
    places = 1 - math.floor(math.log10(half))
    found = Decimal(number).quantize(Decimal(1).scaleb(-places), way)
    return f"{found:f}" if places <= 12 and abs(number) < 1e12 else f"{found:e}"


TRUE_ZERO = 1e-9
"""Below this part of the loads an answer is zero but for rounding."""
OF_LOADS = 1e-3
"""A true zero is judged against this part of the largest load."""


class NoKeyError(ValueError):
    """A question that has no key; the message says why. ``told`` is what a student may know of it."""

    def __init__(self, why: str, told: str = "") -> None:
        super().__init__(why)
        self.told = told or why


def unit_of_target(target: Target, answer: Answer) -> str:
    """The unit of a target's value in case units; '' for a ratio."""
    if isinstance(target, LoadIs):
        return answer.answers[target.load].unit if target.load in answer.answers else ""
    return unit_names(answer.case.units).get(dimension_of(target), "")


def parsed_unit(name: str) -> Unit:
    """The unit of a name in case units; a bare number for ''."""
    return parse_unit(name) if name else Unit(1, 1, 0, DIMENSIONS["number"])


def size_of(answer: Answer) -> float:
    """The mechanism's size: the diagonal of the box about its points."""
    xs, ys = zip(*answer.points.values(), strict=True) if answer.points else ((0.0, 1.0), (0.0, 0.0))
    return math.hypot(max(xs) - min(xs), max(ys) - min(ys)) or 1.0


def zero_width(target: Target, answer: Answer) -> float:
    """What a true zero is judged against: the largest load (times the size for a torque), 1, or the size."""
    match target:
        case LoadIs(name):
            load = next((load for load in answer.case.loads if load.name == name), None)
            return OF_LOADS * largest_load(answer) / ((load and _forces_per(load, answer)) or 1.0)
        case PositionIs(path) if is_angle(path):
            return OF_LOADS * 180.0
        case ReactionIs() | TensionIs():
            turning = dimension_of(target) == "torque"
            return OF_LOADS * largest_load(answer) * (_torque_scale(answer) if turning else 1.0)
        case RatioIs():
            return OF_LOADS
        case SpeedIs():
            speeds = (math.hypot(*v) for v in (answer.velocities or {}).values() if not isinstance(v, str))
            return OF_LOADS * (max(speeds, default=1.0) or 1.0)
        case RateIs():
            rates = (abs(w) for w in (answer.rates or {}).values() if not isinstance(w, str))
            return OF_LOADS * (max(rates, default=1.0) or 1.0)
    return OF_LOADS * size_of(answer)


def _torque_scale(answer: Answer) -> float:
    return size_of(answer) * answer.case.units.torque_per_force_length


def largest_load(answer: Answer) -> float:
    """The largest known load as a force: a torque is divided by the mechanism's size."""
    largest = 0.0
    for load in answer.case.loads:
        if isinstance(load, ForceVector):
            largest = max(largest, math.hypot(load.x.value, load.y.value))
        elif isinstance(load.value, Number):
            largest = max(largest, abs(load.value.value * _forces_per(load, answer)))
    return largest or 1.0


def _forces_per(load: Load, answer: Answer) -> float:
    """The force that one of a load's own unit is, at the mechanism's size."""
    match load:
        case Torque() | TorsionSpring():
            return 1.0 / _torque_scale(answer)
        case Spring() | Force(over=Stretch()):
            return size_of(answer)
        case Weight(mass=True):
            return answer.case.gravity.value * answer.case.units.force_per_newton
        case Force(over=Area() as area):
            widths = [0.0 if number is None else number.value for number in (area.bore, area.rod)]
            size = area.area.value if area.area is not None else widths[0] ** 2 - widths[1] ** 2
            return nearest(area.per) * size
    return 1.0


def from_middle(place: tuple[float, float], answer: Answer) -> float:
    """How far a place lies from the middle of the mechanism."""
    if not answer.points:
        return 1.0
    xs, ys = zip(*answer.points.values(), strict=True)
    return math.dist(place, ((max(xs) + min(xs)) / 2.0, (max(ys) + min(ys)) / 2.0))


def own_width(tolerance: Tolerance, target: Target, answer: Answer, drawn: bool = True) -> float:
    """The widest of a tolerance's absolute width and (``drawn``) what its drawing allows, in its unit.

    Raises NoKeyError where the width is in a unit of another kind, or the drawing says nothing of the target.
    """
    width = tolerance.absolute
    if tolerance.unit:
        name, found = unit_of_target(target, answer), unit_word(tolerance.unit)
        factor = factors_between(found.unit, parsed_unit(name)) if found is not None else None
        if factor is None:
            said = f"the tolerance {tolerance.absolute:g} {tolerance.unit}"
            raise NoKeyError(f"{said} does not fit an answer in {name or 'no unit'}")
        width *= factor
    return (
        max(width, drawn_width(tolerance.drawing, target, answer)) if drawn and tolerance.drawing else width
    )


_STEP = 1e-5
"""Part of the mechanism's size (of a radian) by which a number is changed to each side."""
_NAME = "asked"


def drawn_width(accuracy: str, target: Target, answer: Answer) -> float:
    """The band of a target, in its unit, where every coordinate and length may be off by ``accuracy`` and
    every angle by as much over its arms, all at their worst.

    Raises NoKeyError where the target does not hang on the drawing.
    """
    found = drawn_band(target, answer, _length(accuracy, answer))
    if not found > 0.0:
        raise NoKeyError(
            f"a drawing accurate to {accuracy} leaves no room for this answer; give it a tolerance such as 2%"
        )
    return found


def drawn_band(target: Target, answer: Answer, width: float) -> float:
    """The band of a target, in its unit, where all of the drawing may be off by ``width`` (case units): by
    exact derivatives where the scene has them, else by differences.

    Raises NoKeyError near a limit, where the drawing says nothing of it.
    """
    slopes = _exact(target, answer) or _differences(target, answer)
    return band(replace(answer, sensitivities={_NAME: slopes}), _NAME, width)


def _length(accuracy: str, answer: Answer) -> float:
    """The drawing's accuracy in case units."""
    parts = split_quantity(accuracy)
    assert parts is not None
    numeral, unit = parts
    own = parsed_unit(answer.case.units.length)
    return float(numeral.digits) * ((factors_between(parsed_unit(unit), own) or 1.0) if unit else 1.0)


def _exact(target: Target, answer: Answer) -> dict[str, float]:
    """Derivatives of an unknown load; none where its backward pass has none, as with screws and inertia."""
    from icsolve.solve import solve

    if not isinstance(target, LoadIs):
        return {}
    try:
        own = answer.sensitivities.get(target.load)
        return dict(own or solve(answer.case).sensitivities.get(target.load, {}))
    except SceneError:
        return {}


def _differences(target: Target, answer: Answer) -> dict[str, float]:
    """Derivatives by every number of the figure; of a place, how far it goes."""
    numbers = numbers_in(answer.case.points, answer.case.lengths, answer.case.angles)
    return {number.path: _slope(target, answer, number.path, number.value) for number in numbers}


def _slope(target: Target, answer: Answer, path: str, value: float) -> float:
    step = math.degrees(_STEP) if is_angle(path) else _STEP * size_of(answer)
    ends = [_changed(target, answer, path, value + side) for side in (-step, step)]
    places = [end for end in ends if end is not None]
    if len(places) < 2:
        here = _changed(target, answer, path, value)
        places, step = [*places, *([here] if here is not None else [])], step / 2.0
    if len(places) < 2:
        raise NoKeyError("a drawing says nothing of this answer, which is near a limit; give it a tolerance")
    return math.dist(*places) / (2.0 * step)


def _changed(target: Target, answer: Answer, path: str, value: float) -> tuple[float, ...] | None:
    """The target where one number is another; None where it has no value then."""
    from icsolve.sweep.varied_numbers import with_numbers

    near = {name: place for name, place in answer.points.items() if is_named(name)}
    case = replace(with_numbers(answer.case, {path: value}), near={**answer.case.near, **near})
    try:
        return value_of(solved_for(case, target), target)
    except (IcsolveError, ArithmeticError, LookupError):
        return None
