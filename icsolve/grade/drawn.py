"""The tolerance that a drawing allows: how far a value may lie off where every point of it may.

For unknown loads by the exact sensitivities of their backward pass; for centres, ratios, distances and
reactions by central differences of the solver's own values, which agree with those to eight digits.
"""

from __future__ import annotations

import math
from dataclasses import replace

from icsolve.answer import Answer
from icsolve.case import LoadIs, Target
from icsolve.check import value_of
from icsolve.errors import IcsolveError
from icsolve.grade.malrules.targets import solved_for
from icsolve.grade.scales import NoKeyError, parsed_unit, size_of
from icsolve.grade.written import factors_between
from icsolve.sensitivity import band
from icsolve.units import split_quantity

_STEP = 1e-5
"""Part of the mechanism's size (of a radian) by which a number is changed to each side."""
_NAME = "asked"


def drawn_width(accuracy: str, target: Target, answer: Answer) -> float:
    """The band of a target, in its unit, where every coordinate and length may be off by ``accuracy`` and
    every angle by as much over its arms, all at their worst.

    Raises NoKeyError where the target does not hang on the drawing.
    """
    width = _length(accuracy, answer)
    slopes = _exact(target, answer) or _differences(target, answer)
    found = band(replace(answer, sensitivities={_NAME: slopes}), _NAME, width)
    if not found > 0.0:
        raise NoKeyError(
            f"a drawing accurate to {accuracy} leaves no room for this answer; give it a tolerance such as 2%"
        )
    return found


def _length(accuracy: str, answer: Answer) -> float:
    """The drawing's accuracy in case units."""
    parts = split_quantity(accuracy)
    assert parts is not None
    numeral, unit = parts
    own = parsed_unit(answer.case.units.length)
    return float(numeral.digits) * ((factors_between(parsed_unit(unit), own) or 1.0) if unit else 1.0)


def _exact(target: Target, answer: Answer) -> dict[str, float]:
    """Derivatives of an unknown load; none where its backward pass has none, as with friction."""
    from icsolve.solve import solve

    if not isinstance(target, LoadIs):
        return {}
    return dict(solve(answer.case).sensitivities.get(target.load, {}))


def _differences(target: Target, answer: Answer) -> dict[str, float]:
    """Derivatives by every number of the figure; of a place, how far it goes."""
    from icsolve.grade.variants.written import as_written

    numbers = as_written(replace(answer.case, loads=()))
    return {path: _slope(target, answer, path, number.value) for path, number in numbers.items()}


def _slope(target: Target, answer: Answer, path: str, value: float) -> float:
    step = math.degrees(_STEP) if path.startswith("angles.") else _STEP * size_of(answer)
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
    from icsolve.turn.numbers import with_numbers

    near = {name: place for name, place in answer.points.items() if not name.startswith("@")}
    case = replace(with_numbers(answer.case, {path: value}), near={**answer.case.near, **near})
    try:
        return value_of(solved_for(case, target), target)
    except (IcsolveError, ArithmeticError, LookupError):
        return None
