"""The right answer of a question, with all that an answer is compared with."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping

from icsolve.answer import Answer
from icsolve.case import Force, ForceVector, Load, Spring, Torque, TorsionSpring, Toward, Weight
from icsolve.case.expected import (
    CentreIs,
    LoadIs,
    PositionIs,
    RateIs,
    RatioIs,
    ReactionIs,
    SpeedIs,
    Target,
    TensionIs,
)
from icsolve.grade.course import Policy
from icsolve.grade.mistakes import Wrong, Wrongs
from icsolve.grade.mistakes.changed import Place, heading_of, place_of
from icsolve.grade.tolerance import (
    OF_LOADS,
    TRUE_ZERO,
    NoKeyError,
    from_middle,
    half_width,
    in_words,
    own_width,
    parsed_unit,
    range_in_words,
    size_of,
    unit_of_target,
    width_of,
    zero_width,
)
from icsolve.grade.written.words import UnitWord, WrittenDirection, direction, factors_between
from icsolve.numbers.units import Unit, UnitError
from icsolve.report.check import value_of
from icsolve.tuples import NamedTuple

_SQUARE = 5.0
"""Degrees: words this near to square to the answer say neither way."""
_ROUNDING = 1e-6
"""Degrees: 45 is within 45."""
_PLAIN = ("assumed", "signed", False, 0)
"""Unit, direction, capitals and figures where nothing of them is asked."""
_DEGREE = 1.0
"""Degrees within which a direction that is asked for is right."""

Places = tuple[Place | None, Mapping[str, Place]]

WITH, AGAINST, NEITHER = 1, -1, 0


class ExpectedDirection(NamedTuple):
    """What a positive value means in words.

    ``turn``: +1 ccw, -1 cw, 0 where it does not turn; ``heading``: degrees ccw from +x, None where it has
    none; ``axial``: +1 pull, -1 push, 0 for neither; ``places`` tells where it acts and where the points
    are, when ``toward A`` asks for it.
    """

    turn: float = 0.0
    heading: float | None = None
    axial: float = 0.0
    places: Callable[[], Places] = lambda: (None, {})
    by_angle: bool = False
    """Whether only an angle tells it: words on a reaction may mean either link's force."""
    asked: bool = False
    """Whether the direction is itself asked for, and has to be right to a degree."""

    @property
    def any(self) -> bool:
        """Whether the answer has a direction at all."""
        return bool(self.turn or self.axial or self.heading is not None)

    def sign(self, words: WrittenDirection, within: float) -> int | None:
        """``WITH`` or ``AGAINST`` the positive sense, ``NEITHER``; None where a person must look."""
        if self.by_angle and not words.measured:
            return None if words.kind != "turn" else NEITHER
        if words.kind == "turn":
            return int(words.value * self.turn)
        if words.kind == "axial" and self.axial:
            return int(words.value * self.axial)
        if words.kind == "axial":
            return None if self.heading is not None or self.turn else NEITHER
        degrees = self._degrees(words)
        if self.heading is None:
            return NEITHER
        if degrees is None:
            return None
        found = _compared(degrees - self.heading, _DEGREE if self.asked else within)
        return NEITHER if self.asked and found is None else found

    def _degrees(self, words: WrittenDirection) -> float | None:
        """A direction in words as degrees; None for a point that the case does not have."""
        if words.kind == "line":
            return words.value
        at, points = self.places()
        there = points.get(words.name)
        if there is None or at is None or there == at:
            return None
        degrees = math.degrees(math.atan2(there[1] - at[1], there[0] - at[0]))
        return degrees + (180.0 if words.kind == "away" else 0.0)


def _compared(difference: float, within: float) -> int | None:
    off = abs(math.remainder(difference, 360.0))
    if off <= within + _ROUNDING:
        return WITH
    if off >= 180.0 - within - _ROUNDING:
        return AGAINST
    return None if abs(off - 90.0) <= _SQUARE + _ROUNDING else NEITHER


def expected_direction(load: Load, answer: Answer) -> ExpectedDirection:
    """The senses of a load's positive value."""
    if isinstance(load, Torque):
        return ExpectedDirection(turn=-1.0 if load.positive == "cw" else 1.0)
    if isinstance(load, Spring | TorsionSpring) or (isinstance(load, Weight) and load.mass):
        found = answer.answers[load.name]  # a stiffness or a mass: the way that it acts tells a minus alone
        words = direction(found.sense) if found.value < 0.0 else None
        if words is None:
            return ExpectedDirection()
        if words.kind == "line":
            return ExpectedDirection(heading=words.value + 180.0)
        turns = words.kind == "turn"
        return ExpectedDirection(turn=-words.value) if turns else ExpectedDirection(axial=-words.value)
    assert isinstance(load, Force | ForceVector | Weight)
    axial = 0.0
    if isinstance(load, Force) and isinstance(load.heading, Toward):
        axial = -1.0 if load.heading.away else 1.0
    heading = heading_of(load, answer)
    return ExpectedDirection(0.0, heading, axial, lambda: (place_of(load.at, answer), answer.points))


class NumberKey(NamedTuple):
    """A right answer that is one number.

    ``value`` is signed as the case signs it, in ``unit``; ``half`` half the width of the accepted band;
    ``wrongs`` the known wrong answers; ``accepted`` and ``rule`` tell a student the band and how it is made.
    """

    question: str
    value: float
    unit_name: str
    unit: Unit
    half: float
    expected: ExpectedDirection
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
    kind: str
    """what is asked for: `kind_of`"""
    plain: bool
    """whether nothing is asked but a right size, sense and unit, where one is given"""
    period: float = 0.0
    """of an angle a whole turn, which may be added to it; 0 for none"""

    def nearest(self, value: float) -> float:
        """A value of the same meaning, less than half a period from the right one."""
        if not self.period or not math.isfinite(value):
            return value
        return self.value + math.remainder(value - self.value, self.period)

    def factor(self, unit: UnitWord | None) -> float | None:
        """How many units of the key make one of the answer's; None for another kind."""
        if unit is None:
            return 1.0
        if unit.name not in self.factors:
            self.factors[unit.name] = unit_factor(self, unit.unit)
        return self.factors[unit.name]

    def sign(self, words: WrittenDirection | None) -> int | None:
        """+1 or -1 for words with or against the positive sense, 0 for neither; None: a person must look."""
        if words is None:
            return 1
        name = f"{words.words} deg" if words.measured else words.words
        if name not in self.signs:
            self.signs[name] = self.expected.sign(words, self.policy.within)
        return self.signs[name]


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


class RangeKey(NamedTuple):
    """A right answer that is a range: a key for each end, None for an open one."""

    question: str
    low: NumberKey | None
    high: NumberKey | None
    unit_name: str
    unit: Unit
    policy: Policy
    accepted: str
    rule: str

    @property
    def end(self) -> NumberKey:
        """An end that there is: it tells units and directions."""
        found = self.low or self.high
        assert found is not None
        return found


class ChoiceKey(NamedTuple):
    """A right answer that is one of several: a key for each position of equilibrium."""

    question: str
    keys: tuple[NumberKey | RangeKey, ...]
    unit_name: str
    policy: Policy
    accepted: str
    rule: str


AnyKey = NumberKey | PlaceKey | RangeKey | ChoiceKey


def scalar_key(
    question: str, target: Target, answer: Answer, policy: Policy, wrongs: Callable[[], Iterable[Wrong]]
) -> NumberKey:
    """The key of a target that is one number.

    Parameters
    ----------
    question : its name
    target : what is asked of the answer
    answer : of the case
    policy : tolerance, directions and credit
    wrongs : makes the known wrong answers when they are needed

    Raises
    ------
    NoKeyError
        Where the answer has no such value, or the policy's tolerance does not fit it.
    """
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
    expected = _expected(target, answer)
    kind = kind_of(target)
    return _key(question, value, (unit_name, unit), (half, width), expected, policy, wrongs, kind)


def numbers_of(key: AnyKey) -> list[NumberKey]:
    """The numbers of a right answer: one, the ends of a range, or those of which one will do."""
    if isinstance(key, ChoiceKey):
        return [number for one in key.keys for number in numbers_of(one)]
    if isinstance(key, RangeKey):
        return [end for end in (key.low, key.high) if end is not None]
    return [key] if isinstance(key, NumberKey) else []


def position_key(
    question: str,
    target: PositionIs,
    answer: Answer,
    policy: Policy,
    wrongs: Callable[[float], Iterable[Wrong]],
) -> AnyKey:
    """The key of a datum of the figure that is to find: its value, or its range with friction, in any of the
    positions of equilibrium; ``wrongs`` makes the wrong answers to a value.

    Raises NoKeyError where a drawing is to give the tolerance.
    """
    if policy.tolerance.drawing:
        raise NoKeyError("a drawing says nothing of a position of rest; give it a tolerance such as 2%")
    angle = target.path.startswith("angles.")
    unit_name = unit_of_target(target, answer)
    unit, period = parsed_unit(unit_name), 360.0 if angle else 0.0
    expected = ExpectedDirection(turn=1.0) if angle else ExpectedDirection()
    width = width_of(policy.tolerance, unit, unit_name)

    def key(value: float, pose: Answer, own: Callable[[float], Iterable[Wrong]]) -> NumberKey:
        widths = (half_width(policy.tolerance, value, width, zero_width(target, pose)), width)
        found = _key(question, value, (unit_name, unit), widths, expected, policy, tuple, "position")
        found = found._replace(period=period, plain=False)

        def within_a_turn() -> list[Wrong]:
            wide = 2.0 * period or math.inf
            return [w._replace(value=found.nearest(w.value)) for w in own(value) if abs(w.value) <= wide]

        others = len(answer.positions or ()) - 1
        return found._replace(wrongs=Wrongs(within_a_turn, value, found.half, period, others))

    keys: list[NumberKey | RangeKey] = []
    for position in answer.positions or ():
        held = position.at[target.path]
        if isinstance(held, float):
            keys.append(key(held, position.answer, wrongs))
        else:
            low, high = (key(end, position.answer, lambda value: ())._replace(period=0.0) for end in held)
            keys.append(_range(question, low, high, policy))
    accepted, rule = " or ".join(key.accepted for key in keys), keys[0].rule
    return keys[0] if len(keys) == 1 else ChoiceKey(question, tuple(keys), unit_name, policy, accepted, rule)


def kind_of(target: Target) -> str:
    """What a target asks for, for messages: ``load``, ``ratio``, ``rate``, ``reaction``, ``place`` or
    ``length``.
    """
    match target:
        case LoadIs():
            return "load"
        case RatioIs():
            return "ratio"
        case RateIs() | SpeedIs():
            return "rate"
        case ReactionIs() | TensionIs():
            return "reaction"
        case CentreIs():
            return "place"
    return "length"


def _key(
    question: str,
    value: float,
    unit: tuple[str, Unit],
    widths: tuple[float, float],
    expected: ExpectedDirection,
    policy: Policy,
    wrongs: Callable[[], Iterable[Wrong]],
    kind: str = "load",
) -> NumberKey:
    """A key with what follows from its value, unit, and half and own width."""
    half, width = widths
    accepted, rule = range_in_words(value, half, unit[0]), in_words(policy.tolerance)
    plain = (policy.unit, policy.direction, policy.strict_case, policy.figures) == _PLAIN
    plain = plain and value != 0.0 and not expected.asked
    foreseen = Wrongs(wrongs, value, half)
    return NumberKey(
        question, value, *unit, half, expected, foreseen, policy, accepted, rule, {}, {}, width, kind, plain
    )


def range_key(question: str, target: LoadIs, answer: Answer, policy: Policy) -> RangeKey | None:
    """The key of a load that holds over a range; None of one that has one value.

    Raises NoKeyError where every value holds.
    """
    found = answer.answers.get(target.load)
    if found is None or found.holds is None:
        return None
    expected, zero = _expected(target, answer), zero_width(target, answer)
    unit = parsed_unit(found.unit)
    width = width_of(policy.tolerance, unit, found.unit)

    def end(value: float) -> NumberKey | None:
        if not math.isfinite(value):
            return None
        value = 0.0 if abs(value) <= TRUE_ZERO / OF_LOADS * zero else value
        widths = (half_width(policy.tolerance, value, width, zero), width)
        return _key(question, value, (found.unit, unit), widths, expected, policy, tuple)

    low, high = map(end, found.holds)
    if low is None and high is None:
        raise NoKeyError(f"{answer.case.name} holds with any value of {target.load}, so nothing can be asked")
    return _range(question, low, high, policy)


def _range(question: str, low: NumberKey | None, high: NumberKey | None, policy: Policy) -> RangeKey:
    """The key of a range, one end of which may be open."""
    said = [f"from {low.value:.6g} to {high.value:.6g}"] if low and high else []
    said += [f"{low.value:.6g} or more"] if low and not high else []
    said += [f"{high.value:.6g} or less"] if high and not low else []
    rule = f"{in_words(policy.tolerance)} at each end, as in '113 N to 287 N'"
    end = low or high
    assert end is not None
    accepted = f"{said[0]} {end.unit_name}".strip()
    return RangeKey(question, low, high, end.unit_name, end.unit, policy, accepted, rule)


def scaled_key(key: NumberKey, factor: float) -> NumberKey:
    """The key where all loads are ``factor`` times as large [case units]; a width in units stays."""
    value = key.value * factor
    tolerance = key.policy.tolerance
    fixed = key.fixed if not tolerance.drawing else abs(factor) * key.fixed
    half = half_width(tolerance, value, fixed, abs(factor) * key.half)

    def wrongs() -> list[Wrong]:
        return [Wrong(code, wrong * factor, where, load) for code, wrong, where, load in key.wrongs.all]

    return key._replace(
        value=value,
        half=half,
        fixed=fixed,
        wrongs=Wrongs(wrongs, value, half),
        accepted=range_in_words(value, half, key.unit_name),
    )


def scaled_range(key: RangeKey, factor: float) -> RangeKey:
    """The same of a load that holds over a range."""
    low, high = (None if end is None else scaled_key(end, factor) for end in (key.low, key.high))
    return _range(key.question, low, high, key.policy)


def _expected(target: Target, answer: Answer) -> ExpectedDirection:
    if isinstance(target, LoadIs) and target.load in answer.case.directed:
        parts = answer.answers[target.load].components
        heading = math.degrees(math.atan2(parts[1], parts[0])) if parts is not None and any(parts) else None
        return ExpectedDirection(heading=heading, asked=True)
    if isinstance(target, LoadIs):
        load = next(load for load in answer.case.loads if load.name == target.load)
        return expected_direction(load, answer)
    turning = isinstance(target, RateIs) or (isinstance(target, ReactionIs) and target.part == "moment")
    if isinstance(target, ReactionIs) and target.part in ("x", "y"):
        return ExpectedDirection(heading=0.0 if target.part == "x" else 90.0)
    if isinstance(target, ReactionIs) and not target.part:
        return ExpectedDirection(heading=_reaction_heading(target, answer), by_angle=True)
    if isinstance(target, SpeedIs):
        return ExpectedDirection(heading=_speed_heading(target, answer), by_angle=not answer.case.motion)
    return ExpectedDirection(turn=1.0) if turning else ExpectedDirection()


def _reaction_heading(target: ReactionIs, answer: Answer) -> float | None:
    """The direction of a force in a joint, in degrees."""
    try:
        x, y = (value_of(answer, target._replace(part=part))[0] for part in ("x", "y"))
    except LookupError:
        return None
    return math.degrees(math.atan2(y, x)) if x or y else None


def _speed_heading(target: SpeedIs, answer: Answer) -> float | None:
    """The direction of a point's velocity, in degrees."""
    found = (answer.velocities or {}).get((target.point, target.link))
    if found is None or isinstance(found, str) or not any(found):
        return None
    return math.degrees(math.atan2(found[1], found[0]))


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


def unit_factor(key: NumberKey | PlaceKey | RangeKey, unit: Unit) -> float | None:
    """How many units of the key make one of the answer's; None for another kind."""
    try:
        return factors_between(unit, key.unit)
    except UnitError:
        return None
