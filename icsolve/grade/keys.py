"""The right answer of a question, with all that an answer is compared with."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import NamedTuple

from icsolve.answer import Answer
from icsolve.case import (
    CentreIs,
    ForceVector,
    Load,
    LoadIs,
    Number,
    RateIs,
    RatioIs,
    ReactionIs,
    SpeedIs,
    Spring,
    Target,
    Tolerance,
    Torque,
    Weight,
)
from icsolve.check import value_of
from icsolve.grade.course import Policy
from icsolve.grade.malrules import Wrong, Wrongs
from icsolve.grade.senses import Senses, senses_of
from icsolve.grade.tolerance import half_width, in_words, range_in_words
from icsolve.grade.written import Direction, UnitWord, factors_between
from icsolve.grade.written.unit_words import unit_word
from icsolve.units import DIMENSIONS, Unit, UnitError, parse_unit

_TRUE_ZERO = 1e-9
"""Below this part of the loads an answer is zero but for rounding."""
_OF_LOADS = 1e-3
"""A true zero is judged against this part of the largest load."""


class Key(NamedTuple):
    """A right answer that is one number.

    ``value`` is signed as the case signs it, in ``unit``; ``half`` half the width of the accepted band;
    ``wrongs`` the known wrong answers; ``accepted`` and ``rule`` tell a student the band and how it is made.
    """

    question: str
    value: float
    unit_name: str
    unit: Unit
    half: float
    senses: Senses
    wrongs: Wrongs
    policy: Policy
    accepted: str
    rule: str
    factors: dict[str, float | None]
    """how many of its unit make one of a name that was met; None for another kind"""
    signs: dict[str, int | None]
    """what words of direction that were met say of the positive sense"""
    fixed: float
    """the tolerance's own width, in the unit"""
    plain: bool
    """whether nothing is asked but a right size, sense and unit, where one is given"""

    def factor(self, unit: UnitWord | None) -> float | None:
        """How many units of the key make one of the answer's; None for another kind."""
        if unit is None:
            return 1.0
        if unit.name not in self.factors:
            self.factors[unit.name] = unit_factor(self, unit.unit)
        return self.factors[unit.name]

    def sign(self, words: Direction | None) -> int | None:
        """+1 or -1 for words with or against the positive sense, 0 for neither; None: a person must look."""
        if words is None:
            return 1
        if words.words not in self.signs:
            self.signs[words.words] = self.senses.sign(words, self.policy.within)
        return self.signs[words.words]


class PlaceKey(NamedTuple):
    """A right answer that is a place, or (``toward``) a direction in which a centre lies at infinity."""

    question: str
    place: tuple[float, float]
    toward: float | None
    unit_name: str
    unit: Unit
    half: float
    wrongs: tuple[tuple[float, float, Wrong], ...]
    policy: Policy
    accepted: str
    rule: str


AnyKey = Key | PlaceKey


class NoKeyError(ValueError):
    """A question that has no key; the message says why."""


def unit_of_target(target: Target, answer: Answer) -> str:
    """The unit of a target's value in case units; '' for a ratio."""
    from icsolve.sense import unit_of

    units = answer.case.units
    match target:
        case LoadIs(name):
            return unit_of(next(load for load in answer.case.loads if load.name == name), answer.case)
        case RatioIs():
            return ""
        case RateIs():
            return "rad/s"
        case SpeedIs():
            return f"{units.length}/s"
        case ReactionIs(part="moment"):
            return units.torque
        case ReactionIs():
            return units.force
    return units.length


def size_of(answer: Answer) -> float:
    """The mechanism's size: the diagonal of the box about its points."""
    xs, ys = zip(*answer.points.values(), strict=True) if answer.points else ((0.0, 1.0), (0.0, 0.0))
    return math.hypot(max(xs) - min(xs), max(ys) - min(ys)) or 1.0


def zero_width(target: Target, answer: Answer) -> float:
    """What a true zero is judged against: the largest load (times the size for a torque), 1, or the size."""
    match target:
        case LoadIs(name):
            load = next(load for load in answer.case.loads if load.name == name)
            return (
                _OF_LOADS
                * largest_load(answer)
                * (_torque_scale(answer) if isinstance(load, Torque) else 1.0)
            )
        case ReactionIs(part=part):
            return _OF_LOADS * largest_load(answer) * (_torque_scale(answer) if part == "moment" else 1.0)
        case RatioIs():
            return _OF_LOADS
        case RateIs() | SpeedIs():
            return _OF_LOADS * _fastest(target, answer)
    return _OF_LOADS * size_of(answer)


def _of_loads(answer: Answer, torque: bool) -> float:
    return _OF_LOADS * largest_load(answer) * (_torque_scale(answer) if torque else 1.0)


def _torque_scale(answer: Answer) -> float:
    return size_of(answer) * answer.case.units.torque_per_force_length


def largest_load(answer: Answer) -> float:
    """The largest known load as a force: a torque is divided by the mechanism's size."""
    values = [_as_force(load, answer) for load in answer.case.loads]
    return max((abs(value) for value in values), default=0.0) or 1.0


def _as_force(load: Load, answer: Answer) -> float:
    if isinstance(load, ForceVector):
        return math.hypot(load.x.value, load.y.value)
    if not isinstance(load.value, Number):
        return 0.0
    if isinstance(load, Torque):
        return load.value.value / _torque_scale(answer)
    if isinstance(load, Spring):
        return load.value.value * size_of(answer)
    if isinstance(load, Weight) and load.mass:
        return load.value.value * answer.case.gravity.value * answer.case.units.force_per_newton
    return load.value.value


def _fastest(target: Target, answer: Answer) -> float:
    if isinstance(target, SpeedIs):
        speeds = [math.hypot(*v) for v in (answer.velocities or {}).values() if not isinstance(v, str)]
        return max(speeds, default=1.0) or 1.0
    return max((abs(w) for w in (answer.rates or {}).values() if not isinstance(w, str)), default=1.0) or 1.0


def parsed_unit(name: str) -> Unit:
    """The unit of a name in case units; a bare number for ''."""
    return parse_unit(name) if name else Unit(1, 1, 0, DIMENSIONS["number"])


def scalar_key(
    question: str, target: Target, answer: Answer, policy: Policy, wrongs: Callable[[], Iterable[Wrong]]
) -> Key:
    """The key of a target that is one number; ``wrongs`` makes its wrong answers when they are needed.

    Raises NoKeyError where the answer has no such value, or the policy's tolerance does not fit it.
    """
    _refuse_range(target, answer)
    try:
        (value,) = value_of(answer, target)
    except LookupError as error:
        raise NoKeyError(str(error)) from None
    unit_name = unit_of_target(target, answer)
    unit = parsed_unit(unit_name)
    zero = zero_width(target, answer)
    if abs(value) <= _TRUE_ZERO / _OF_LOADS * zero:
        value = 0.0
    width = own_width(policy.tolerance, target, answer, unit, unit_name)
    half = half_width(policy.tolerance, value, width, zero)
    foreseen, senses = Wrongs(wrongs, value, half), _senses(target, answer)
    accepted, rule = range_in_words(value, half, unit_name), in_words(policy.tolerance)
    plain = _is_plain(policy) and value != 0.0 and senses.any
    return Key(
        question, value, unit_name, unit, half, senses, foreseen, policy, accepted, rule, {}, {}, width, plain
    )


def _refuse_range(target: Target, answer: Answer) -> None:
    """A load that holds over a range has not one right value."""
    found = answer.answers.get(target.load) if isinstance(target, LoadIs) else None
    if found is not None and found.holds is not None:
        low, high = found.holds
        raise NoKeyError(
            f"{answer.case.name} holds with any value from {low:.6g} to {high:.6g} {found.unit}; "
            "say which way it moves with 'motion:', and one value is right"
        )


def scaled_key(key: Key, factor: float) -> Key:
    """The key where all loads are ``factor`` times as large; a width in units stays what it is."""
    value = key.value * factor
    tolerance = key.policy.tolerance
    fixed = key.fixed if not tolerance.drawing else abs(factor) * key.fixed
    half = half_width(tolerance, value, fixed, abs(factor) * key.half)

    def wrongs() -> list[Wrong]:
        return [Wrong(code, wrong * factor, where) for code, wrong, where in key.wrongs.all]

    return key._replace(
        value=value,
        half=half,
        fixed=fixed,
        wrongs=Wrongs(wrongs, value, half),
        accepted=range_in_words(value, half, key.unit_name),
    )


def _is_plain(policy: Policy) -> bool:
    asked = (policy.unit, policy.direction, policy.strict_case, policy.figures)
    return asked == ("assumed", "signed", False, 0)


def _senses(target: Target, answer: Answer) -> Senses:
    if isinstance(target, LoadIs):
        return senses_of(next(load for load in answer.case.loads if load.name == target.load), answer)
    turning = isinstance(target, RateIs) or (isinstance(target, ReactionIs) and target.part == "moment")
    if isinstance(target, ReactionIs) and target.part in ("x", "y"):
        return Senses(heading=0.0 if target.part == "x" else 90.0)
    return Senses(turn=1.0) if turning else Senses()


def own_width(tolerance: Tolerance, target: Target, answer: Answer, unit: Unit, unit_name: str) -> float:
    """The widest of a tolerance's absolute width and what its drawing allows, in the answer's unit.

    Raises NoKeyError where the width is in a unit of another kind, or the drawing says nothing of the target.
    """
    drawn = _drawn(tolerance.drawing, target, answer) if tolerance.drawing else 0.0
    if not tolerance.unit:
        return max(tolerance.absolute, drawn)
    found = unit_word(tolerance.unit)
    factor = factors_between(found.unit, unit) if found is not None else None
    if factor is None:
        said = f"the tolerance {tolerance.absolute:g} {tolerance.unit}"
        raise NoKeyError(f"{said} does not fit an answer in {unit_name or 'no unit'}")
    return max(tolerance.absolute * factor, drawn)


def _drawn(accuracy: str, target: Target, answer: Answer) -> float:
    """The band of a load when each point of the drawing may be off by ``accuracy``."""
    from icsolve.sensitivity import band
    from icsolve.solve import solve
    from icsolve.units import split_quantity

    if not isinstance(target, LoadIs):
        raise NoKeyError(
            "a tolerance from the drawing is for loads; give this question one of its own, such as 2%"
        )
    parts = split_quantity(accuracy)
    assert parts is not None
    factor = (
        factors_between(parsed_unit(parts[1]), parsed_unit(answer.case.units.length)) if parts[1] else 1.0
    )
    width = float(parts[0].digits) * (factor or 1.0)
    return band(solve(answer.case), target.load, width)


def place_key(
    question: str, target: CentreIs, answer: Answer, policy: Policy, wrongs: list[tuple[float, float, Wrong]]
) -> PlaceKey:
    """The key of a centre.

    Raises NoKeyError where there is no such centre.
    """
    pair = target.pair
    centre = answer.centres.get(pair) or answer.centres.get((pair[1], pair[0]))
    if centre is None or centre.kind not in ("at", "toward"):
        raise NoKeyError(centre.why if centre is not None and centre.why else "there is no such centre")
    unit = parsed_unit(answer.case.units.length)
    size = size_of(answer)
    toward = centre.place[0] if centre.kind == "toward" else None
    place = (centre.place[0], centre.place[1]) if toward is None else (0.0, 0.0)
    distance = max(size, _from_middle(place, answer))
    absolute = own_width(policy.tolerance, target, answer, unit, answer.case.units.length)
    half = half_width(policy.tolerance, distance, absolute, _OF_LOADS * size)
    kept = tuple(w for w in wrongs if math.dist(w[:2], place) > half or toward is not None)
    accepted = f"within {half:.3g} {answer.case.units.length} of the place"
    return PlaceKey(
        question,
        place,
        toward,
        answer.case.units.length,
        unit,
        half,
        kept,
        policy,
        accepted,
        in_words(policy.tolerance),
    )


def _from_middle(place: tuple[float, float], answer: Answer) -> float:
    if not answer.points:
        return 1.0
    xs, ys = zip(*answer.points.values(), strict=True)
    return math.dist(place, ((max(xs) + min(xs)) / 2.0, (max(ys) + min(ys)) / 2.0))


def unit_factor(key: AnyKey, unit: Unit) -> float | None:
    """How many units of the key make one of the answer's; None for another kind."""
    try:
        return factors_between(unit, key.unit)
    except UnitError:
        return None
