"""The right answer of a question, with all that an answer is compared with."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from decimal import ROUND_FLOOR

from icsolve.answer import Answer
from icsolve.case import (
    AlongRope,
    Area,
    Force,
    ForceVector,
    Load,
    Spring,
    Torque,
    TorsionSpring,
    Toward,
    Weight,
    is_angle,
)
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
from icsolve.grade.mistakes.changed import Place, heading_of, place_of
from icsolve.grade.mistakes.lookup import Wrong, Wrongs
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
    rounded,
    size_of,
    unit_of_target,
    zero_width,
)
from icsolve.grade.written.words import UnitWord, WrittenDirection, direction, factors_between
from icsolve.numbers.units import Unit, UnitError
from icsolve.report.check import heading_in, value_of
from icsolve.tuples import NamedTuple, cached_property, dataclass, replace

_SQUARE = 5.0
"""Degrees: words this near to square to the answer say neither way."""
_ROUNDING = 1e-6
"""Degrees: 45 is within 45."""
_PLAIN = ("assumed", "signed", False, 0)
"""Unit, direction, capitals and figures where nothing of them is asked."""
DEGREE = 1.0
"""Degrees within which a direction that is asked for is right."""

_KINDS: dict[type, str] = {
    LoadIs: "load", RatioIs: "ratio", RateIs: "rate", SpeedIs: "speed", ReactionIs: "reaction",
    TensionIs: "reaction", CentreIs: "place", PositionIs: "position",
}  # fmt: skip
"""What is asked for, for messages; a force of unknown direction is a ``vector``, what else a ``length``."""

Places = tuple[Place | None, Mapping[str, Place]]

WITH, AGAINST, NEITHER = 1, -1, 0
SIDEWAYS = (0.0, 180.0)
"""To the right and to the left, in degrees."""


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
    vector: bool = False
    """Whether the answer is a vector, which its two components tell as well."""
    given: str = ""
    """The positive sense as the case gives it by a point, whose direction may be a part of the task."""
    size: bool = False
    """Whether the value is a size: a minus on it may be that of a component."""
    acts: ExpectedDirection | None = None
    """The way that a mass, a spring or a pressure acts, whose value has no direction of its own."""

    @property
    def is_minus_of_axis(self) -> bool:
        """Whether a size with a minus may be the component of what points along -x or -y."""
        against = () if self.heading is None or not self.size else (self.heading - 180.0, self.heading + 90.0)
        return any(abs(math.remainder(off, 360.0)) <= _ROUNDING for off in against)

    @property
    def any(self) -> bool:
        """Whether the answer has a direction at all."""
        return bool(self.turn or self.axial or self.heading is not None)

    def sign(self, words: WrittenDirection, within: float) -> int | None:
        """``WITH`` or ``AGAINST`` the positive sense, ``NEITHER``; None where a person must look."""
        if not self.any:
            return WITH if self.acts is not None and self.acts.sign(words, within) == WITH else None
        if self.by_angle and not words.measured:
            return None if words.kind != "turn" else NEITHER
        if words.kind == "turn":
            return int(words.value * self.turn)
        if words.kind == "axial" and self.axial:
            return int(words.value * self.axial)
        if words.kind == "axial":
            return None if self.heading is not None or self.turn else NEITHER
        degrees = self._degrees(words)
        if self.heading is None:  # a torque to the right may be one that turns to the right
            sideways = words.kind == "line" and not words.measured and words.value in SIDEWAYS
            return None if self.turn and sideways else NEITHER
        if degrees is None:
            return None
        found = _compared(degrees - self.heading, DEGREE if self.asked else within)
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


def expected_of(target: Target, answer: Answer) -> ExpectedDirection:
    """What a positive value of a target means in words."""
    match target:
        case LoadIs(name) if name in answer.case.directed:
            return ExpectedDirection(
                heading=_heading(answer.answers[name].components), asked=True, vector=True, size=True
            )
        case LoadIs(name):
            return _of_load(next(load for load in answer.case.loads if load.name == name), answer)
        case PositionIs(path):
            return ExpectedDirection(turn=float(is_angle(path)))
        case RateIs() | ReactionIs(part="moment"):
            return ExpectedDirection(turn=1.0)
        case TensionIs():
            return ExpectedDirection(axial=1.0)
        case ReactionIs(part="x" | "y"):
            return ExpectedDirection(heading=0.0 if target.part == "x" else 90.0)
        case ReactionIs(part=""):
            try:
                force = [value_of(answer, target._replace(part=part))[0] for part in ("x", "y")]
            except LookupError:
                force = []
            return ExpectedDirection(heading=_heading(force), by_angle=True, vector=True, size=True)
        case SpeedIs(point, link):
            velocity = (answer.velocities or {}).get((point, link))
            heading = None if isinstance(velocity, str) else _heading(velocity)
            return ExpectedDirection(heading=heading, by_angle=not answer.case.motion, vector=True, size=True)
    return ExpectedDirection()


def _heading(vector: Sequence[float] | None) -> float | None:
    """The direction of a vector in degrees ccw from +x; None of none."""
    return math.degrees(math.atan2(vector[1], vector[0])) if vector and any(vector) else None


def _of_load(load: Load, answer: Answer) -> ExpectedDirection:
    """The senses of a load's positive value."""
    if isinstance(load, Torque):
        return ExpectedDirection(turn=-1.0 if load.positive == "cw" else 1.0)
    if isinstance(load, Spring | TorsionSpring) or (isinstance(load, Weight) and load.mass):
        found = answer.answers[load.name]  # a stiffness or a mass: the way that it acts tells a minus alone
        way = _acting(direction(found.sense), found.value)
        return way if found.value < 0.0 else ExpectedDirection(acts=way)
    assert isinstance(load, Force | ForceVector | Weight)
    axial, heading, given = 0.0, heading_of(load, answer), ""
    if isinstance(load, Force) and isinstance(load.heading, Toward):
        away, point = load.heading.away, load.heading.point
        axial, given = -1.0 if away else 1.0, f"{'away from' if away else 'toward'} {point}"
    elif isinstance(load, Force) and isinstance(load.heading, AlongRope):
        axial, heading = 1.0, heading_in(answer, load.name)
    way = ExpectedDirection(
        0.0, heading, axial, lambda: (place_of(load.at, answer), answer.points), vector=True, given=given
    )
    pressure = isinstance(load, Force) and isinstance(load.over, Area)
    return ExpectedDirection(acts=way) if pressure and not answer.answers[load.name].value < 0.0 else way


def _acting(words: WrittenDirection | None, value: float) -> ExpectedDirection:
    """The direction of words in which a mass or a spring acts; of a negative value the opposite one."""
    if words is None:
        return ExpectedDirection()
    if words.kind == "line":
        return ExpectedDirection(heading=words.value + (180.0 if value < 0.0 else 0.0))
    way = math.copysign(words.value, words.value * value)
    return ExpectedDirection(turn=way) if words.kind == "turn" else ExpectedDirection(axial=way)


def _nothing_else(name: str) -> bool:
    """Of no quantity is known that a name could be another's."""
    return False


class _Key:
    """What all keys have: the unit, how wide the accepted band is, in words, the ``name`` of what is asked,
    and whether a name that stands before an answer is that of another quantity (``another``), one after it
    that of a place where what is asked does not act (``elsewhere``)."""

    unit_name: str
    policy: Policy
    kind = "load"
    """what is asked for, for messages"""

    @cached_property
    def unit(self) -> Unit:
        """The unit of the right answer."""
        return parsed_unit(self.unit_name)

    @cached_property
    def rule(self) -> str:
        """What a student may know of the band before the answer."""
        return in_words(self.policy.tolerance)

    @cached_property
    def factors(self) -> dict[str, float | None]:
        """How many of its unit make one of a name that was met; None for another kind."""
        return {}

    def factor(self, unit: UnitWord | None) -> float | None:
        """How many units of the key make one of the answer's; None for another kind."""
        if unit is None:
            return 1.0
        if unit.name not in self.factors:
            try:
                self.factors[unit.name] = factors_between(unit.unit, self.unit)
            except UnitError:
                self.factors[unit.name] = None
        return self.factors[unit.name]


@dataclass(frozen=True, eq=False, repr=False)
class NumberKey(_Key):
    """A right answer that is one number.

    ``value`` is signed as the case signs it, in the unit; ``half`` half the width of the accepted band,
    ``fixed`` the tolerance's own; ``wrongs`` the known wrong answers; ``period`` a whole turn of an angle,
    which may be added to it, or 0.
    """

    question: str
    value: float
    unit_name: str
    half: float
    fixed: float
    expected: ExpectedDirection
    policy: Policy
    wrongs: Wrongs
    kind: str = "load"
    period: float = 0.0
    another: Callable[[str], bool] = _nothing_else
    elsewhere: Callable[[str], bool] = _nothing_else
    name: str = ""

    @cached_property
    def accepted(self) -> str:
        """The accepted band, in words."""
        return range_in_words(self.value, self.half, self.unit_name, signed=self.kind == "position")

    @cached_property
    def plain(self) -> bool:
        """Whether nothing is asked but a right size, sense and unit, where one is given."""
        policy = self.policy
        asked = (policy.unit, policy.direction, policy.strict_case, policy.figures) != _PLAIN
        return not (asked or self.expected.asked or self.kind == "position") and self.value != 0.0

    @cached_property
    def _signs(self) -> dict[str, int | None]:
        """What words of direction that were met say of the positive sense."""
        return {}

    def nearest(self, value: float) -> float:
        """A value of the same meaning, less than half a period from the right one."""
        if not self.period or not math.isfinite(value):
            return value
        return self.value + math.remainder(value - self.value, self.period)

    def sign(self, words: WrittenDirection | None) -> int | None:
        """+1 or -1 for words with or against the positive sense, 0 for neither; None: a person must look."""
        if words is None:
            return 1
        name = f"{words.words} deg" if words.measured else words.words
        if name not in self._signs:
            self._signs[name] = self.expected.sign(words, self.policy.within)
        return self._signs[name]

    def scaled(self, factor: float) -> NumberKey:
        """The key where all loads are ``factor`` times as large [case units]; a width in units stays."""
        value = self.value * factor
        fixed = self.fixed if not self.policy.tolerance.drawing else abs(factor) * self.fixed
        half = half_width(self.policy.tolerance, value, fixed, abs(factor) * self.half)
        wrongs = Wrongs(lambda: [w._replace(value=w.value * factor) for w in self.wrongs.all], value, half)
        return replace(self, value=value, half=half, fixed=fixed, wrongs=wrongs)


@dataclass(frozen=True, eq=False, repr=False)
class PlaceKey(_Key):
    """A right answer that is a place, or (``toward``) a direction in which a centre lies at infinity."""

    question: str
    place: tuple[float, float]
    toward: float | None
    unit_name: str
    half: float
    wrongs: tuple[tuple[float, float, Wrong], ...]
    policy: Policy
    kind = "place"
    another: Callable[[str], bool] = _nothing_else
    elsewhere: Callable[[str], bool] = _nothing_else
    name: str = ""

    @property
    def accepted(self) -> str:
        """The accepted disc, in words; of a centre at infinity its direction."""
        if self.toward is not None:
            return f"at infinity within {DEGREE:g} deg of its direction"
        return f"within {rounded(self.half, self.half, ROUND_FLOOR)} {self.unit_name} of the place"


@dataclass(frozen=True, eq=False, repr=False)
class RangeKey(_Key):
    """A right answer that is a range: a key for each end, None for an open one."""

    question: str
    low: NumberKey | None
    high: NumberKey | None
    unit_name: str
    policy: Policy
    another: Callable[[str], bool] = _nothing_else
    elsewhere: Callable[[str], bool] = _nothing_else
    name: str = ""
    others: tuple[RangeKey, ...] = ()
    """further ranges in which friction may hold, as the solution says: a person decides"""

    @cached_property
    def end(self) -> NumberKey:
        """An end that there is: it tells units and directions."""
        return next(end for end in (self.low, self.high) if end is not None)

    @property
    def accepted(self) -> str:
        """The accepted band of each end, one of which may be open."""
        told = [
            f"no {which}"
            if end is None
            else f"its {which} {range_in_words(end.value, end.half, self.unit_name, signed=True)}"
            for which, end in (("lower end", self.low), ("upper end", self.high))
        ]
        return " and ".join(told)

    @property
    def rule(self) -> str:
        """That of each end, with the form of an answer."""
        return f"{self.end.rule} at each end, as in '113 N to 287 N'"

    def scaled(self, factor: float) -> RangeKey:
        """The same where all loads are ``factor`` times as large."""
        low, high = (None if end is None else end.scaled(factor) for end in (self.low, self.high))
        return replace(self, low=low, high=high, others=tuple([one.scaled(factor) for one in self.others]))


@dataclass(frozen=True, eq=False, repr=False)
class ChoiceKey(_Key):
    """A right answer that is one of several: a key for each position of equilibrium."""

    question: str
    keys: tuple[NumberKey | RangeKey, ...]
    unit_name: str
    policy: Policy
    kind = "position"
    another: Callable[[str], bool] = _nothing_else
    elsewhere: Callable[[str], bool] = _nothing_else
    name: str = ""

    @property
    def accepted(self) -> str:
        """What is accepted of each."""
        return " or ".join(key.accepted for key in self.keys)

    @property
    def rule(self) -> str:
        """That of the first."""
        return self.keys[0].rule


AnyKey = NumberKey | PlaceKey | RangeKey | ChoiceKey


def numbers_of(key: AnyKey) -> list[NumberKey]:
    """The numbers of a right answer: one, the ends of a range, or those of which one will do."""
    if isinstance(key, ChoiceKey):
        return [number for one in key.keys for number in numbers_of(one)]
    if isinstance(key, RangeKey):
        return [end for end in (key.low, key.high) if end is not None]
    return [key] if isinstance(key, NumberKey) else []


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
    key = _number(question, value, target, answer, policy, own_width(policy.tolerance, target, answer))
    if policy.tolerance.drawing and key.half >= abs(key.value) > 0.0:
        raise NoKeyError(
            f"a drawing accurate to {policy.tolerance.drawing} leaves this answer open, even its sense; give "
            "it a tolerance such as 2%"
        )
    return replace(key, wrongs=Wrongs(wrongs, key.value, key.half))


def range_key(question: str, target: LoadIs, answer: Answer, policy: Policy) -> RangeKey | None:
    """The key of a load that holds over a range; None of one that has one value.

    Raises NoKeyError where every value holds, or a drawing alone is to give the tolerance.
    """
    found = answer.answers.get(target.load)
    if found is None or found.holds is None:
        return None
    _not_drawn(policy, "the ends of a range over which friction holds")
    width = own_width(policy.tolerance, target, answer, drawn=False)

    def key(held: tuple[float, float]) -> RangeKey:
        low, high = (
            _number(question, end, target, answer, policy, width) if math.isfinite(end) else None
            for end in held
        )
        return RangeKey(question, low, high, found.unit, policy)

    own = key(found.holds)
    if own.low is None and own.high is None:
        raise NoKeyError(f"{answer.case.name} holds with any value of {target.load}, so nothing can be asked")
    load = next(load for load in answer.case.loads if load.name == target.load)
    is_root = not isinstance(load, ForceVector) and load.value is None  # a multiple of one has other ranges
    again = answer.friction.again if answer.friction is not None and is_root else ()
    return replace(own, others=tuple(map(key, again)))


def position_key(
    question: str,
    target: PositionIs,
    answer: Answer,
    policy: Policy,
    wrongs: Callable[[float], Iterable[Wrong]],
) -> AnyKey:
    """The key of a datum of the figure that is to find: its value, or its range with friction, in any of the
    positions of equilibrium; ``wrongs`` makes the wrong answers to a value.

    Raises NoKeyError where a drawing alone is to give the tolerance.
    """
    _not_drawn(policy, "a position of rest")
    width = own_width(policy.tolerance, target, answer, drawn=False)
    poses = {one.at[target.path]: one.answer for one in reversed(answer.positions or ())}
    others = len(poses) - 1  # several positions may share the datum: another tells them apart

    period = 360.0 if is_angle(target.path) else 0.0

    def end(value: float, pose: Answer) -> NumberKey:
        return replace(_number(question, value, target, pose, policy, width), period=period)

    def key(value: float, pose: Answer) -> NumberKey:
        found = end(value, pose)

        def within_a_turn() -> list[Wrong]:
            wide = 2.0 * period or math.inf
            return [w._replace(value=found.nearest(w.value)) for w in wrongs(value) if abs(w.value) <= wide]

        return replace(found, wrongs=Wrongs(within_a_turn, value, found.half, period, others))

    keys: list[NumberKey | RangeKey] = []
    for held, pose in reversed(poses.items()):
        if isinstance(held, float):
            keys.append(key(held, pose))
        else:
            low, high = (end(value, pose) for value in held)
            keys.append(RangeKey(question, low, high, low.unit_name, policy))
    return keys[0] if len(keys) == 1 else ChoiceKey(question, tuple(keys), keys[0].unit_name, policy)


def _not_drawn(policy: Policy, what: str) -> None:
    """Raises NoKeyError where a drawing alone is to give the tolerance, and says nothing of the answer."""
    tolerance = policy.tolerance
    if tolerance.drawing and not (tolerance.relative or tolerance.absolute or tolerance.figures):
        raise NoKeyError(f"a drawing says nothing of {what}; give it a tolerance such as 2%")


def _number(
    question: str, value: float, target: Target, answer: Answer, policy: Policy, width: float
) -> NumberKey:
    """A key without wrong answers; ``width`` is the tolerance's own. Zero but for rounding is zero."""
    zero = zero_width(target, answer)
    if abs(value) <= TRUE_ZERO / OF_LOADS * zero and not isinstance(target, PositionIs):
        value = 0.0
    half, expected = half_width(policy.tolerance, value, width, zero), expected_of(target, answer)
    unit = unit_of_target(target, answer)
    kind = "vector" if expected.asked else _KINDS.get(type(target), "length")
    return NumberKey(question, value, unit, half, width, expected, policy, Wrongs(tuple, value, half), kind)


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
    size = size_of(answer)
    toward = centre.place[0] if centre.kind == "toward" else None
    place = (centre.place[0], centre.place[1]) if toward is None else (0.0, 0.0)
    distance = max(size, from_middle(place, answer))
    width = own_width(policy.tolerance, target, answer, drawn=toward is None)
    half = half_width(policy.tolerance, distance, width, OF_LOADS * size)
    kept = tuple(w for w in wrongs if math.dist(w[:2], place) > half or toward is not None)
    return PlaceKey(question, place, toward, answer.case.units.length, half, kept, policy)
