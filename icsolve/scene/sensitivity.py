"""How an answer depends on every number of the case: exact derivatives, and the band of a drawing.

The derivatives come from the backward pass that bounds the rounding error (see `icsolve.numbers.tape`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any

from icsolve.answer import Answer, Found
from icsolve.case import Case, Coordinates, Corner, Direction, Number
from icsolve.case.loads import name_of_inertia
from icsolve.errors import SceneError, Status
from icsolve.numbers.balls import is_long
from icsolve.numbers.units import exactly, numbers_in, split_quantity
from icsolve.tuples import NamedTuple


class Influence(NamedTuple):
    """What one number of the case does to an answer.

    ``per_unit`` is the derivative (answer's unit per the number's, degrees for angles), ``percent``
    the change of the answer in percent for one percent of the number; None where either is zero.
    """

    path: str
    value: float
    per_unit: float
    percent: float | None


def _slopes(answer: Answer, load: str) -> Mapping[str, float]:
    """Derivatives by the numbers of the case; raises SceneError where the scene has none."""
    if load not in answer.sensitivities:
        raise SceneError(
            Status.NEAR_SINGULAR,
            f"how {load} depends on the numbers of the case can't be told: the position is too close to a "
            "singular one.",
        )
    return answer.sensitivities[load]


def _has_slopes(answer: Answer, load: str) -> bool:
    """The size of a force of unknown direction grows whichever way it comes out of zero."""
    return answer.answers[load].components != (0.0, 0.0)


def influences(answer: Answer, load: str) -> list[Influence]:
    """Every number of the case that the answer depends on, the strongest first.

    Raises KeyError for a load that was not found, or an answer that was solved without its bound.
    """
    found = answer.answers[load].value
    numbers = numbers_of(answer.case)
    result = []
    for path, slope in _slopes(answer, load).items():
        if slope != 0.0 and path in numbers:  # a whole turn is no number of the case
            value = numbers[path].value
            percent = slope * value / found if found != 0.0 and value != 0.0 else None
            result.append(Influence(path, value, slope, percent))
    return sorted(result, key=lambda i: (-abs(i.percent or 0.0), -abs(i.per_unit), i.path))


def band(answer: Answer, load: str, tolerance: float) -> float:
    """Largest change of an answer when every point of the drawing may be off by ``tolerance``.

    Coordinates and lengths (case units) may each be off by it; an angle by the tolerance over its
    arms. All errors are taken at their worst, to first order.
    """
    lengths, arms = _lengths(answer.case), _arms(answer)
    total = 0.0
    for path, slope in _slopes(answer, load).items():
        if path in lengths:
            total += abs(slope) * tolerance
        elif path in arms:
            total += abs(slope) * math.degrees(tolerance * arms[path])
    return total


def entries(answer: Answer, influence: bool, tolerance: float | None) -> dict[str, Any]:
    """What ``--json`` adds: ``sensitivity`` by load, the strongest first, and the ``band`` of a drawing; None
    of a force of unknown direction that is zero."""
    shown: dict[str, Any] = {}
    if influence:
        shown["sensitivity"] = {
            load: [i._asdict() for i in influences(answer, load)] if _has_slopes(answer, load) else None
            for load in answer.answers
        }
    if tolerance is not None:
        shown["band"] = {
            load: band(answer, load, tolerance) if _has_slopes(answer, load) else None
            for load in answer.answers
        }
    return shown


def text(answer: Answer, influence: bool, tolerance: float | None, digits: int) -> str:
    """The same as lines."""
    lines = [] if answer.answers else [NONE_ASKED]
    for load, found in answer.answers.items():
        if not _has_slopes(answer, load):
            lines.append(NO_SIZE.format(load=load))
            continue
        if tolerance is not None:
            reach = format(band(answer, load, tolerance), ".2g")
            unit = answer.case.units.length
            off = f"where the drawing is off by {tolerance:g} {unit}"
            lines.append(f"{load} within {reach} {found.unit} {off}")
        if influence:
            lines += [f"Sensitivity of {load}, in % a % and in {found.unit} a unit of the number"]
            lines += [f"  {row}" for row in _rows(influences(answer, load), digits)]
    return "\n".join(lines)


NO_SIZE = "{load} is zero and has no direction: it grows whichever way a number is moved."
NONE_ASKED = "Sensitivities and tolerance bands are those of unknown loads, of which this case has none."


def _rows(found: list[Influence], digits: int) -> list[str]:
    width = max((len(i.path) for i in found), default=0)
    places = min(digits, 4)
    return [
        f"{i.path:<{width}}  {'' if i.percent is None else format(i.percent, f'.{places}g'):>10}  "
        f"{format(i.per_unit, f'.{places}g'):>10}"
        for i in found
    ]


def unsettled(
    case: Case, answers: Mapping[str, Found], change: Callable[[Number], Mapping[str, float]]
) -> list[str]:
    """Notes on answers that half a unit of a last decimal could move by more than themselves; ``change`` has
    the change of each answer by half a unit of a number."""
    worst: dict[str, tuple[float, Number]] = {}
    for number in numbers_of(case).values():
        if "." in number.digits and _is_as_written(number):  # a whole one is exact
            for load, reach in change(number).items():
                if load not in worst or reach > worst[load][0]:
                    worst[load] = reach, number
    return [
        f"half a unit of the last decimal of {number.path} ({number.digits}) could move {load} by "
        f"{reach:.2g} {answers[load].unit}, more than itself: give it with more digits."
        for load, (reach, number) in worst.items()
        if load in answers and reach > abs(answers[load].value) > 0.0
    ]


def _is_as_written(number: Number) -> bool:
    """Whether its decimals are all that is meant, in whatever unit; not so what arithmetic gave."""
    if number.exact is None or number.factor != 1.0:
        return True
    written = split_quantity(number.digits)
    assert written is not None
    (num, den, power), (a, b, _) = number.exact, exactly(written[0])
    return power == 0 and num * b == a * den


NUMBERED = (
    "points",
    "lengths",
    "angles",
    "joints",
    "ropes",
    "profiles",
    "loads",
    "motion",
    "gravity",
    "inertia",
)
"""What of a case holds numbers that have a path."""


@lru_cache(maxsize=64)
def numbers_of(case: Case) -> Mapping[str, Number]:
    """Every number of a case by its path."""
    return {path: number for numbers in parts_of(case).values() for path, number in numbers.items()}


def written_by_program(case: Case) -> bool:
    """Whether a program wrote numbers of a case."""
    return any(map(is_long, numbers_of(case).values()))


def number_at(case: Case, path: str) -> Number:
    """The number at a path; only the part of the case that the path begins with is looked through.

    Raises KeyError where there is none.
    """
    part, _, _ = path.partition(".")
    numbers = _held_by(case, part) if part in NUMBERED else {}
    return numbers[path] if path in numbers else numbers_of(case)[path]


def parts_of(case: Case) -> Mapping[str, Mapping[str, Number]]:
    """The numbers that each part of a case holds, by path."""
    return {name: _held_by(case, name) for name in NUMBERED}


@lru_cache(maxsize=64 * len(NUMBERED))
def _held_by(case: Case, part: str) -> Mapping[str, Number]:
    held = getattr(case, part)
    if part == "loads":  # no file has those of inertia forces
        held = tuple(load for load in held if not name_of_inertia(load.name))
    return {number.path: number for number in numbers_in(held) if number.path not in case.axes}


def _lengths(case: Case) -> set[str]:
    """Paths of coordinates and lengths."""
    paths = {length.value.path for length in case.lengths}
    for place in case.points.values():
        if isinstance(place, Coordinates):
            paths |= {number.path for number in place if number is not None}
    return paths


def _arms(answer: Answer) -> dict[str, float]:
    """For every angle the sum of the reciprocal lengths of its arms."""
    result = {}
    for angle in answer.case.angles:
        if isinstance(angle, Direction):
            arms = [(angle.a, angle.b)]
        else:
            assert isinstance(angle, Corner)
            arms = [(angle.at, angle.a), (angle.at, angle.b)]
        if all(p in answer.points and q in answer.points for p, q in arms):
            spans = [math.dist(answer.points[p], answer.points[q]) for p, q in arms]
            result[angle.value.path] = sum(1.0 / span for span in spans if span > 0.0)
    return result
