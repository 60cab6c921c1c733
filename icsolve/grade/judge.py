"""The verdict: number, unit and direction apart, and which mistake."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import partial
from typing import Any

from icsolve.grade.keys import (
    AGAINST,
    DEGREE,
    NEITHER,
    AnyKey,
    ChoiceKey,
    ExpectedDirection,
    NumberKey,
    PlaceKey,
    RangeKey,
    numbers_of,
)
from icsolve.grade.mistakes.lookup import Wrong, message, near_miss, together
from icsolve.grade.tolerance import SLACK
from icsolve.grade.written.answer import (
    MINUS,
    MISSING,
    NO_NUMBER,
    SIZE,
    TWO_VALUES,
    Reader,
    WrittenAnswer,
    flagged,
    may_name,
    names_in,
    places_in,
)
from icsolve.grade.written.numerals import AMBIGUOUS, UNREAD, figures, plain
from icsolve.grade.written.two_numbers import (
    WrittenPlace,
    WrittenRange,
    read_components,
    read_place,
    read_range,
    without_axes,
)
from icsolve.grade.written.words import (
    AMBIGUOUS_DIRECTION,
    AMBIGUOUS_UNIT,
    CASE,
    ENERGY,
    WrittenDirection,
    at_angle,
    unit_word,
)
from icsolve.grade.written.words import direction as direction_of
from icsolve.numbers.units import UNITS
from icsolve.tuples import NamedTuple, replace
from icsolve.wording import listed

RIGHT, WRONG, INVALID, IN_REVIEW = "right", "wrong", "invalid", "review"
OPEN = (IN_REVIEW, INVALID)
"""Verdicts that leave an answer ungraded."""
VERDICTS = (RIGHT, WRONG, INVALID, IN_REVIEW, MISSING)
SQUARE = "square-direction"
OTHER_NAME = "other-quantity"
OTHER_RANGE = "other-range"
BY_ANGLE = "direction-in-words"
UNDIRECTED = "undirected"
SIZE_ALONE = "size-alone"


class Judgement(NamedTuple):
    """What an answer earns, and why.

    ``share`` is that of the mark, 0 to 1; ``parts`` whether number, unit and direction are right;
    ``value`` the answer in the question's unit, signed as the case signs it; ``off`` its relative
    error (None where there is no number, or the right one is zero); ``mistakes`` the causes that
    fit, simplest first.
    """

    verdict: str
    share: float
    parts: tuple[bool, bool, bool]
    value: float | None = None
    off: float | None = None
    code: str = ""
    mistakes: tuple[Wrong, ...] = ()
    both: bool = False
    """whether the two mistakes were made together, and are not two readings of one answer"""


_made: Callable[[tuple[Any, ...]], Judgement] = partial(tuple.__new__, Judgement)
"""Half the time of the class itself, where there are millions."""
_SLACK = 1.0 + SLACK
_CLOSE = 3.1
"""Half-widths beyond which no answer is close."""
_NO_PARTS = (False, False, False)
_ALL_PARTS = (True, True, True)


Read = WrittenAnswer | WrittenPlace | WrittenRange
_LISTED = re.compile(r" ?; ?|, | (?:and|or|und|oder|et|ou|y|o|e|&) ")
_SPACED = re.compile(r"(?<=[\d°.g]) (?=[-+]?\d)")
"""Two numbers with nothing but a space between, the first perhaps in degrees."""
_GROUPED = re.compile(r"[-+]?[1-9]\d{0,2}\.\d{3}(?![\d.])")


def judge_answer(
    key: AnyKey, reader: Reader, answer: str, unit: str = "", direction: str = ""
) -> tuple[Judgement, Read]:
    """The verdict on an answer as it was written; what is named as another quantity is for a person.

    Parameters
    ----------
    key : of any kind: a number, a place, a range, a choice
    reader : reads numbers, with the decimal mark of the course
    answer, unit, direction : texts; unit and direction perhaps in columns of their own

    Returns
    -------
    tuple[Judgement, Read]
        The verdict, and how the answer was read. Nothing that a student writes raises.
    """
    answer = _behind_own_name(key.name, answer)
    if key.name and isinstance(key, NumberKey) and key.expected.vector:
        answer = without_axes(answer, key.name)
    found = _judged(key, reader, answer, unit, direction)
    if may_name(answer) and found[0].verdict in (RIGHT, WRONG) and any(map(key.another, names_in(answer))):
        return _unjudged(OTHER_NAME), flagged(OTHER_NAME)
    placed = "on " in answer or "at " in answer or "bout " in answer or "ound " in answer  # few are
    if placed and found[0].verdict in (RIGHT, WRONG) and any(map(key.elsewhere, places_in(answer))):
        return _unjudged(OTHER_NAME), flagged(OTHER_NAME)
    return found


_PARTED = re.compile(r"[ @-]")


def _behind_own_name(name: str, answer: str) -> str:
    """What an answer says behind the name of what is asked: ``v C on 8 = 75``, ``F1-2@B: 35 N``, and
    ``pull = 50 N`` where a load is called so, which else were a direction."""
    if not name or not may_name(answer):
        return answer
    text = answer.replace(":", "=", 1) if _PARTED.search(name) else answer
    before, _, after = text.partition("=")
    return after if after and before.split() == name.split() else answer


def _judged(key: AnyKey, reader: Reader, answer: str, unit: str, direction: str) -> tuple[Judgement, Read]:
    """By what stands behind its name."""
    if isinstance(key, PlaceKey):
        place = read_place(f"{answer} {unit}".strip())
        judged = judge_place(key, place)
        doubted = place.doubtful and judged.verdict == WRONG
        return (_unjudged(AMBIGUOUS) if doubted else judged), place
    if isinstance(key, ChoiceKey):
        return _judge_choice(key, reader, answer, unit, direction)
    if isinstance(key, RangeKey):
        text = " ".join(part for part in (answer, unit, direction) if part)
        found = read_range(text, reader.decimal)
        return judge_range(key, found), found
    written = reader.read(answer, unit, direction)
    if key.period and written.direction is not None and written.direction.measured:
        return _unjudged(TWO_VALUES), flagged(TWO_VALUES)  # an angle has no angle as its direction
    if key.period and written.flag == UNREAD:
        written = _as_heading(answer) or written
    if written.flag and key.expected.vector:
        parts = read_components(f"{answer} {unit}".strip())
        if not parts.flag:
            return _by_components(key, parts, written.flag)
    judged = judge(key, written)
    if judged.verdict == WRONG and reader.decimal == "either" and _GROUPED.match(written.digits):
        other = judge(key, written._replace(number=written.number * 1000.0))
        if other.verdict == RIGHT:
            return _unjudged(AMBIGUOUS), flagged(AMBIGUOUS)
    return judged, written


def _by_components(key: NumberKey, parts: WrittenPlace, flag: str) -> tuple[Judgement, Read]:
    """A vector by its two components: its size, and its direction to a degree. What is right in no way that
    it may be read is wrong where it can be nothing else; else it keeps its flag."""
    way = at_angle(math.degrees(math.atan2(parts.y, parts.x)))
    written = WrittenAnswer(math.hypot(parts.x, parts.y), parts.unit, way)
    strict = replace(key, expected=key.expected._replace(asked=True))
    judged = judge(strict, written)
    by_angle = WrittenAnswer(parts.x, parts.unit, at_angle(parts.y))  # if (100, 30) is 100 N at 30 deg
    if judged.verdict == WRONG and (parts.doubtful or judge(strict, by_angle).verdict == RIGHT):
        return _unjudged(flag), flagged(flag)
    return judged, written


def _as_heading(answer: str) -> WrittenAnswer | None:
    """An angle that is written as a direction: ``at 30 deg``, ``30 deg above +x``."""
    found = direction_of(plain(answer))
    if found is None or not found.measured:
        return None
    return flagged(found.flag) if found.flag else WrittenAnswer(found.value, unit_word("deg"), None)


def _judge_choice(
    key: ChoiceKey, reader: Reader, answer: str, unit: str, direction: str
) -> tuple[Judgement, Read]:
    """By the nearest of several right values, whose mistakes alone are looked up where it is right; else by
    the first of which it shows a known mistake. Several values are right where each of them is."""
    number, word, way, _, flag, _, _ = reader.read(answer, unit, direction)
    several = flag in (TWO_VALUES, UNREAD) or (way is not None and way.measured)
    words = plain(answer) if several else ""
    parts = (_LISTED if _LISTED.search(words) else _SPACED).split(words)
    if len(parts) > 1:
        each = [_judge_choice(key, reader, part, unit, direction) for part in parts]
        if all(judged.verdict == RIGHT for judged, _ in each):
            return each[0]

    def off(one: NumberKey | RangeKey) -> float:
        if isinstance(one, RangeKey):
            return 0.0
        return abs(one.nearest(number * (one.factor(word) or 1.0)) - one.value)

    found = []
    for one in sorted(key.keys, key=off):
        found.append(judge_answer(one, reader, answer, unit, direction))
        if found[-1][0].verdict == RIGHT:
            return found[-1]
    return next((judged for judged in found if judged[0].mistakes), found[0])


def judge(key: NumberKey, written: WrittenAnswer) -> Judgement:
    """The verdict on an answer to a question that is one number.

    Parameters
    ----------
    key : the right value, half the width in which an answer is right, and how unit and direction count
    written : the number with its unit and direction, each perhaps missing

    Returns
    -------
    Judgement
        The share is from 0 to 1; a text that could not be read has a flag in the place of a verdict.
    """
    number, unit, way, _, flag, note, unsigned = written
    if flag:
        return _unjudged(flag)
    if unsigned == MINUS and key.unit_name:
        return _unjudged(AMBIGUOUS_DIRECTION)
    if key.plain and not note and not unsigned:
        factor = 1.0 if unit is None else key.factors.get(unit.name) or key.factor(unit)
        sign = 1 if way is None else key.sign(way)
        if factor and sign:
            value, right, half = number * factor * sign, key.value, key.half
            off = abs(value - right)
            if off <= half:
                return _made((RIGHT, 1.0, _ALL_PARTS, value, off / abs(right), "", (), False))
            if abs(abs(value) - abs(right)) > half and (factor == 1.0 or not _has_size(key, number)):
                return _wrong_size(key, value, True, (value > 0.0) == (right > 0.0), written)
    return _in_full(key, written)


def _has_size(key: NumberKey, value: float) -> bool:
    return -key.half <= abs(value) - abs(key.value) <= key.half


def _wrong_size(
    key: NumberKey, value: float, unit: bool, direction: bool, written: WrittenAnswer
) -> Judgement:
    """A wrong number, with the causes that were foreseen; without words it may be meant as a size only."""
    wrongs, digits, policy = key.wrongs, written.digits, key.policy
    mistakes = wrongs.near(value, digits)
    may_be_size = value > 0.0 > key.value or policy.direction == "ignored"
    if may_be_size and not mistakes and written.direction is None:
        mistakes = wrongs.near(-value, digits)
    size = abs(key.value)
    off = abs(abs(value) - size)
    if off <= _CLOSE * key.half and direction and size and off <= near_miss(key.half, key.period) * _SLACK:
        mistakes = (*mistakes, Wrong("near-miss", value))
    parts = (False, unit, direction)
    earned = policy.credit is not None or policy.mistakes
    share = share_of(key, parts, mistakes) if earned else 0.0
    both = () if mistakes else wrongs.two(value, digits)
    causes = mistakes or both
    return _made((WRONG, share, parts, value, relative(off, size), codes(causes), causes, bool(both)))


def relative(off: float, size: float) -> float | None:
    """An error as a part of the right size; None where that is zero, or no double holds it."""
    part = off / size if size else math.inf
    return part if part < math.inf else None


def _in_full(key: NumberKey, written: WrittenAnswer) -> Judgement:
    """Number, unit and direction apart."""
    factor = key.factor(written.unit)
    sign = key.sign(_words_that_count(key, written.direction))
    value = key.nearest(written.number * (factor or 1.0) * (sign or 1))
    size = abs(key.value)
    number = abs(abs(value) - size) <= key.half
    unit = _unit_is_right(key, written, factor)
    if not number and factor != 1.0 and abs(abs(written.number) - size) <= key.half:
        number, unit = True, key.policy.unit == "ignored"
        value = written.number * (sign or 1)
    if number and sign is None and key.value:
        return Judgement(IN_REVIEW, 0.0, (number, unit, False), value, None, _why_unsure(key.expected))
    if number and _may_be_component(key, written):
        return Judgement(IN_REVIEW, 0.0, (number, unit, False), value, None, AMBIGUOUS_DIRECTION)
    if not number and factor is None and _is_mass_in_pounds(key, written):
        return Judgement(IN_REVIEW, 0.0, (number, unit, False), value, None, AMBIGUOUS_UNIT)
    direction = _direction_is_right(key, written, value, sign)
    if number and not direction and written.unsigned == SIZE and value > 0.0 > key.value:
        return Judgement(IN_REVIEW, 0.0, (number, unit, False), value, None, SIZE_ALONE)
    off = relative(abs(abs(value) - size), size)
    if number and unit and direction:
        return _right(key, written, value, off)
    if not number:
        return _wrong_size(key, value, unit, direction, written)
    parts = (number, unit, direction)
    return _wrong(key, parts, _seen(key, written, value, parts, sign), value, off)


def _is_mass_in_pounds(key: NumberKey, written: WrittenAnswer) -> bool:
    """Whether pounds, which are a force here, are the right mass where they are meant so."""
    pounds = key.factor(unit_word("lbm")) if written.unit and written.unit.unit == UNITS["lbf"] else None
    return pounds is not None and _has_size(key, written.number * pounds)


def _may_be_component(key: NumberKey, written: WrittenAnswer) -> bool:
    """Whether a minus on a size may say that it points along -x or -y, as it does."""
    bare = written.number < 0.0 and written.direction is None and key.policy.direction != "ignored"
    return bare and key.expected.is_minus_of_axis


def _words_that_count(key: NumberKey, direction: WrittenDirection | None) -> WrittenDirection | None:
    """Words of direction, where the course asks for one."""
    return direction if key.policy.direction != "ignored" else None


def _why_unsure(expected: ExpectedDirection) -> str:
    """Why words of direction say neither that the sense is right nor that it is not."""
    if not expected.any:
        return UNDIRECTED
    return BY_ANGLE if expected.by_angle else SQUARE


def _unjudged(flag: str) -> Judgement:
    """What holds a number is for a person to read; what holds none is no answer."""
    verdict = {MISSING: MISSING, NO_NUMBER: INVALID}.get(flag, IN_REVIEW)
    return Judgement(verdict, 0.0, _NO_PARTS, code=flag)


def _unit_is_right(key: NumberKey, written: WrittenAnswer, factor: float | None) -> bool:
    if key.policy.unit == "ignored":
        return True
    if written.unit is None:
        return key.policy.unit == "assumed" or not key.unit_name
    if written.note == ENERGY:
        return False
    return factor is not None and not (written.note and key.policy.strict_case)


def _direction_is_right(key: NumberKey, written: WrittenAnswer, value: float, sign: int | None) -> bool:
    """By the sign of the value; by words as well where the course wants them."""
    if not key.value or key.policy.direction == "ignored":
        return True
    if sign == NEITHER or sign is None:
        return False
    wanted = key.expected.asked or key.policy.direction == "required"
    if wanted and written.direction is None and key.expected.any:
        return False
    return (value > 0.0) == (key.value > 0.0)


def _right(key: NumberKey, written: WrittenAnswer, value: float, off: float | None) -> Judgement:
    """Right, unless too few figures are written."""
    if key.policy.figures and written.digits and figures(written.digits)[1] < key.policy.figures:
        return _wrong(key, (False, True, True), (Wrong("figures", value),), value, off)
    return Judgement(RIGHT, 1.0, _ALL_PARTS, value, off, written.note if written.unit else "")


def _seen(
    key: NumberKey, written: WrittenAnswer, value: float, parts: tuple[bool, bool, bool], sign: int | None
) -> tuple[Wrong, ...]:
    """What is wrong about a right number: its unit, its sense."""
    _, unit, direction = parts
    found = [] if unit else [Wrong(_unit_code(key, written), value)]
    if not direction:
        found.append(Wrong(_direction_code(key, written, sign), value))
    return tuple(found)


def _unit_code(key: NumberKey, written: WrittenAnswer) -> str:
    if written.unit is None:
        return "no-unit"
    factor = key.factor(written.unit) if written.note == CASE else None
    return "unit-case" if factor and _has_size(key, written.number * factor) else "unit"


def _direction_code(key: NumberKey, written: WrittenAnswer, sign: int | None) -> str:
    if sign == NEITHER or sign is None:
        return "direction"
    bare = written.direction is None and sign != AGAINST and not key.period  # an angle's sign is its sense
    if bare and (written.number > 0.0) == (key.value > 0.0):
        return "no-direction"
    return "sign"


def share_of(key: AnyKey, parts: tuple[bool, bool, bool], mistakes: tuple[Wrong, ...]) -> float:
    """The share of the mark: for the right ones of the parts that the question has, or for the known mistake,
    whichever is more. Of a part that it has not, as the sign of a ratio, what is wrong is the number."""
    policy = key.policy
    if policy.credit is None and not policy.mistakes:
        return 0.0
    asked, earned = _asked_parts(key), 0.0
    whole = sum(share for share, has in zip(policy.credit or (), asked, strict=False) if has)
    if policy.credit is not None and whole:
        number = parts[0] and all(part or has for part, has in zip(parts, asked, strict=True))
        good = (part and has for part, has in zip((number, *parts[1:]), asked, strict=True))
        earned = sum(share for share, right in zip(policy.credit, good, strict=True) if right) / whole
    return min(1.0, max([earned, *(policy.mistakes.get(mistake.code, 0.0) for mistake in mistakes[:1])]))


def _asked_parts(key: AnyKey) -> tuple[bool, bool, bool]:
    """Whether a question has a number, a unit and a direction: a ratio has but the first."""
    if isinstance(key, PlaceKey):
        return True, True, False
    end = numbers_of(key)[0]
    directed = end.expected.any and key.policy.direction != "ignored"
    return True, bool(key.unit_name) and key.policy.unit != "ignored", directed and bool(end.value)


def _wrong(
    key: AnyKey,
    parts: tuple[bool, bool, bool],
    mistakes: tuple[Wrong, ...],
    value: float | None = None,
    off: float | None = None,
) -> Judgement:
    """A wrong answer with its causes."""
    return Judgement(WRONG, share_of(key, parts, mistakes), parts, value, off, codes(mistakes), mistakes)


def codes(mistakes: tuple[Wrong, ...]) -> str:
    """The codes of causes that fit, as they stand in the results."""
    return mistakes[0].code if len(mistakes) == 1 else " ".join(mistake.code for mistake in mistakes)


def feedback(key: AnyKey, judged: Judgement, reveal: bool = False, by_person: bool = True) -> str:
    """What the student is told; never the answer, unless it is right or the course reveals it.

    ``by_person`` says whether a person looks at what waits for one: else it has to be written otherwise.
    """
    if judged.verdict == RIGHT:
        noted = " Mind the capitals of its unit." if judged.code else ""
        return f"Right: {key.accepted} is accepted.{noted}"
    band = f" Accepted is {key.accepted}." if reveal else f" Accepted is an answer {key.rule}."
    if judged.mistakes:
        said = " Or: ".join(message(m.code, m.where, key.kind) for m in judged.mistakes)
        if judged.both:
            said = together(judged.mistakes[0], judged.mistakes[1], key.kind)
        return said + (band if reveal or judged.mistakes[0].code == "near-miss" else "")
    if judged.verdict == WRONG:
        return f"Not right.{band}"
    why, advice = UNJUDGED.get(judged.code, ("This can't be read as an answer", ""))
    looked_at = "; a person will look at it" if judged.verdict == IN_REVIEW and by_person else ""
    if judged.code == UNREAD:
        advice = f"Write {form_of(key)}."
    return f"{why}{looked_at}. {advice}".rstrip()


def form_of(key: AnyKey) -> str:
    """How an answer to a question is written, with an example of other numbers."""
    if isinstance(key, PlaceKey):
        return "two coordinates, such as '(0.9, 1.2)'"
    end = numbers_of(key)[0]
    _, unit, direction = _asked_parts(end)
    direction = direction and end.kind != "position"  # an angle is counterclockwise by itself
    sense = "ccw" if end.expected.turn else "pull" if end.expected.axial else "at 30 deg"
    parts = ["a number", *["a unit"] * unit, *["a direction"] * direction]
    number = " ".join(["41.2", *[end.unit_name] * unit])
    if isinstance(key.keys[0] if isinstance(key, ChoiceKey) else key, RangeKey):
        return f"both ends, such as '{number.replace('41.2', '11.3')} to {number}'"
    return f"{listed(parts)}, such as '{' '.join([number, *[sense] * direction])}'"


UNJUDGED = {
    MISSING: ("No answer was given", ""),
    UNREAD: ("This can't be read surely", ""),
    "no-number": ("There is no number in this", ""),
    "too-long": ("This is too long to be read as an answer", ""),
    "ambiguous-number": (
        "This number can be read in two ways",
        "Write a point before decimals, and nothing between thousands.",
    ),
    "ambiguous-direction": ("Sign and words, or words alone, say two directions", ""),
    "ambiguous-unit": ("This unit has several meanings", ""),
    "two-values": ("There are two values in this", ""),
    OTHER_RANGE: ("This is another range than the one that is asked for, in which it may hold too", ""),
    OTHER_NAME: ("This is named as another quantity than the one that is asked for, or acts elsewhere", ""),
    SQUARE: ("These words are square to the answer's direction", ""),
    SIZE_ALONE: ("This is a size, whose direction is not said", ""),
    UNDIRECTED: ("What is asked for has no such direction", ""),
    BY_ANGLE: ("This direction in words is not judged by itself", "Write an angle, as 'at 30 deg'."),
    "no-direction": ("In which direction it lies at infinity is not said", ""),
}
"""What is told where nothing was judged, by the flag: why, and how to write it."""


def judge_place(key: PlaceKey, written: WrittenPlace) -> Judgement:
    """The verdict on an answer to the question where a centre is."""
    if written.flag:
        return _unjudged(written.flag)
    if key.toward is not None or written.toward is not None:
        return _far(key, written)
    factor = key.factor(written.unit)
    unit = key.policy.unit == "ignored" or factor is not None
    if written.unit is None and key.policy.unit == "required":
        unit = False
    at = (written.x * (factor or 1.0), written.y * (factor or 1.0))
    off, bare = math.dist(at, key.place), math.dist((written.x, written.y), key.place)
    if factor not in (None, 1.0) and bare <= key.half < off:
        off, unit = 0.0, key.policy.unit == "ignored"
    number = off <= key.half
    parts = (number, unit, True)
    part = relative(off * (key.policy.tolerance.relative or 0.01), key.half)
    if number and unit:
        return Judgement(RIGHT, 1.0, parts, None, part)
    if number:
        return _wrong(key, parts, (Wrong("unit", 0.0),), None, part)
    found = {w.code: w for x, y, w in reversed(key.wrongs) if math.dist(at, (x, y)) <= key.half}
    if off <= near_miss(key.half, 0.0):
        found["near-miss"] = Wrong("near-miss", 0.0)
    return _wrong(key, parts, tuple(found.values())[:3], None, part)


def _far(key: PlaceKey, written: WrittenPlace) -> Judgement:
    """A centre at infinity: right in its direction, modulo a half turn."""
    if key.toward is None or written.toward is None:
        return Judgement(WRONG, 0.0, (False, True, False))
    if math.isnan(written.toward):
        return Judgement(IN_REVIEW, 0.0, (True, True, False), code="no-direction")
    right = abs(math.remainder(written.toward - key.toward, 180.0)) <= DEGREE
    return Judgement(RIGHT if right else WRONG, float(right), (right, True, right))


# --- ranges -----------------------------------------------------------------------------------------


Ends = tuple[float | None, float | None]


def judge_range(key: RangeKey, written: WrittenRange) -> Judgement:
    """The verdict on an answer to the question over which range a load holds: both ends have to be right."""
    if written.flag:
        return _unjudged(written.flag)
    end = key.end
    factor, sign = end.factor(written.unit), end.sign(_words_that_count(end, written.direction))
    unit = _unit_is_right(end, WrittenAnswer(0.0, written.unit, written.direction), factor)
    if sign is None:
        return Judgement(IN_REVIEW, 0.0, _NO_PARTS, code=_why_unsure(end.expected))
    ends = _times(written, (factor or 1.0) * (sign or 1))
    fits = _fits(key, ends)
    if not all(fits) and factor != 1.0 and all(_fits(key, _times(written, sign or 1))):
        fits, unit = (True, True), key.policy.unit == "ignored"
    if not all(fits) and any(all(_fits(other, ends)) for other in key.others):
        return _unjudged(OTHER_RANGE)
    parts = (all(fits), unit, sign != NEITHER)
    off = _off_range(key, ends)
    if all(parts):
        return Judgement(RIGHT, 1.0, _ALL_PARTS, None, off)
    return _wrong(key, parts, _of_range(key, parts, fits, ends, written), None, off)


def _off_range(key: RangeKey, ends: Ends) -> float | None:
    """The error of the worse end, in whichever order they are written, as a part of the larger; None where
    one is open, or should be."""
    right = [end for end in (key.low, key.high) if end is not None]
    orders = [[end for end in order if end is not None] for order in (ends, ends[::-1])]
    if any(len(order) != len(right) for order in orders):
        return None
    offs = (max(abs(k.nearest(v) - k.value) for k, v in zip(right, order, strict=True)) for order in orders)
    return relative(min(offs), max(abs(end.value) for end in right))


def _times(written: WrittenRange, factor: float) -> Ends:
    """The ends in the question's unit, positive its positive way."""
    low, high = (end if end is None else end * factor for end in (written.low, written.high))
    return (low, high) if factor > 0.0 else (high, low)


def _fits(key: RangeKey, ends: Ends) -> tuple[bool, bool]:
    """Whether each end is right. Of two that are written the larger first the smaller is the lower, or of an
    angle perhaps one of the next turn."""
    low, high = ends
    if low is None or high is None or low <= high:
        return _fit(key, low, high)
    onward = _fit(key, low, high + key.end.period)
    return onward if key.end.period and all(onward) else _fit(key, high, low)


def _fit(key: RangeKey, low: float | None, high: float | None) -> tuple[bool, bool]:
    """Whether each end is right; whole turns of an angle do not count where both have them."""
    turned = key.low.nearest(low) - low if key.low is not None and low is not None else 0.0
    return _is_end(key.low, low, turned), _is_end(key.high, high, turned)


def _is_end(key: NumberKey | None, value: float | None, turned: float = 0.0) -> bool:
    if key is None or value is None:
        return key is None and value is None
    return abs(value + turned - key.value) <= key.half


def _of_range(
    key: RangeKey, parts: tuple[bool, bool, bool], fits: tuple[bool, bool], ends: Ends, written: WrittenRange
) -> tuple[Wrong, ...]:
    """What is wrong about a range: its unit, one of its ends, its sense."""
    number, unit, direction = parts
    if number:
        codes = [] if unit else ["unit" if written.unit else "no-unit"]
        return tuple(Wrong(code, 0.0) for code in (*codes, *([] if direction else ["direction"])))
    low, high = ends
    if any(fits) or (low == high and low is not None and (_is_end(key.low, low) or _is_end(key.high, low))):
        return (Wrong("one-end", 0.0),)
    back = (None if high is None else -high, None if low is None else -low)
    return (Wrong("sign", 0.0),) if all(_fits(key, back)) else ()
