"""The right answer of a question, with all that an answer is compared with."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import NamedTuple

from icsolve.answer import Answer
from icsolve.case import (
    CentreIs,
    LoadIs,
    RateIs,
    ReactionIs,
    Target,
)
from icsolve.check import value_of
from icsolve.grade.course import Policy
from icsolve.grade.malrules import Wrong, Wrongs
from icsolve.grade.scales import (
    OF_LOADS,
    TRUE_ZERO,
    NoKeyError,
    from_middle,
    own_width,
    parsed_unit,
    size_of,
    unit_of_target,
    width_of,
    zero_width,
)
from icsolve.grade.senses import Senses, senses_of
from icsolve.grade.tolerance import half_width, in_words, range_in_words
from icsolve.grade.written import Direction, UnitWord, factors_between
from icsolve.units import Unit, UnitError


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
    if abs(value) <= TRUE_ZERO / OF_LOADS * zero:
        value = 0.0
    width = own_width(policy.tolerance, target, answer, unit, unit_name)
    half = half_width(policy.tolerance, value, width, zero)
    if policy.tolerance.drawing and half >= abs(value) > 0.0:
        raise NoKeyError(
            f"a drawing accurate to {policy.tolerance.drawing} leaves this answer open, even its sense; give "
            "it a tolerance such as 2%"
        )
    senses = _senses(target, answer)
    return _key(question, value, (unit_name, unit), (half, width), senses, policy, wrongs)


def simple_key(
    question: str,
    value: float,
    unit_name: str,
    policy: Policy,
    senses: Senses,
    wrongs: Callable[[], Iterable[Wrong]],
) -> Key:
    """The key of a value other than zero, without a tolerance from the drawing.

    Raises NoKeyError where the tolerance is in a unit of another kind.
    """
    unit = parsed_unit(unit_name)
    width = width_of(policy.tolerance, unit, unit_name)
    half = half_width(policy.tolerance, value, width, 0.0)
    return _key(question, value, (unit_name, unit), (half, width), senses, policy, wrongs)


def _key(
    question: str,
    value: float,
    unit: tuple[str, Unit],
    widths: tuple[float, float],
    senses: Senses,
    policy: Policy,
    wrongs: Callable[[], Iterable[Wrong]],
) -> Key:
    """A key with what follows from its value, unit, and half and own width."""
    half, width = widths
    accepted, rule = range_in_words(value, half, unit[0]), in_words(policy.tolerance)
    plain = _is_plain(policy) and value != 0.0 and senses.any
    foreseen = Wrongs(wrongs, value, half)
    return Key(
        question, value, *unit, half, senses, foreseen, policy, accepted, rule, {}, {}, width, plain
    )


def _refuse_range(target: Target, answer: Answer) -> None:
    """A load that holds over a range has not one right value."""
    found = answer.answers.get(target.load) if isinstance(target, LoadIs) else None
    if found is not None and found.holds is not None:
        low, high = found.holds
        raise NoKeyError(
            f"{answer.case.name} holds with any value from {low:.6g} to {high:.6g} {found.unit}; "
            "say which way it moves with 'motion:', and one value is right",
            f"{answer.case.name} holds over a range of values, not with one",
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
    distance = max(size, from_middle(place, answer))
    tolerance = policy.tolerance if toward is None else policy.tolerance._replace(drawing="")
    absolute = own_width(tolerance, target, answer, unit, answer.case.units.length)
    half = half_width(policy.tolerance, distance, absolute, OF_LOADS * size)
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


def unit_factor(key: AnyKey, unit: Unit) -> float | None:
    """How many units of the key make one of the answer's; None for another kind."""
    try:
        return factors_between(unit, key.unit)
    except UnitError:
        return None


__all__ = ["AnyKey", "Key", "NoKeyError", "PlaceKey", "place_key", "scalar_key", "scaled_key", "unit_factor"]
