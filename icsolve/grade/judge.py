"""The verdict on a place: the distance from the right one."""

from __future__ import annotations

import math
from typing import NamedTuple

from icsolve.grade.keys import AGAINST, NEITHER, AnyKey, Key, PlaceKey, unit_factor
from icsolve.grade.mistakes import Wrong, message
from icsolve.grade.tolerance import SLACK
from icsolve.grade.written import MISSING, REVIEW, UNREAD, Direction, Written, figures
from icsolve.grade.written.answer import WrittenPlace

RIGHT, WRONG, INVALID, IN_REVIEW = "right", "wrong", "invalid", "review"
VERDICTS = (RIGHT, WRONG, INVALID, IN_REVIEW, MISSING)
SQUARE = "square-direction"
_NEAR = 3.0
"""A near miss lies within this many half-widths."""


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


_NO_PARTS = (False, False, False)
_ALL_PARTS = (True, True, True)


def judge(key: Key, written: Written) -> Judgement:
    """The verdict on an answer to a question that is one number."""
    number, unit, way, _, flag, note = written
    if flag:
        return _unjudged(flag)
    if key.plain and not note:
        factor, sign = key.factor(unit), key.sign(way)
        if factor and sign:
            value = number * factor * sign
            if abs(value - key.value) <= key.half:
                return Judgement(RIGHT, 1.0, _ALL_PARTS, value, abs(value - key.value) / abs(key.value))
            if not _has_size(key, value) and (factor == 1.0 or not _has_size(key, number)):
                return _wrong_size(key, value, True, (value > 0.0) == (key.value > 0.0), way is None)
    return _in_full(key, written)


def _has_size(key: Key, value: float) -> bool:
    return -key.half <= abs(value) - abs(key.value) <= key.half


def _wrong_size(key: Key, value: float, unit: bool, direction: bool, unsigned: bool) -> Judgement:
    """A wrong number, with the causes that were foreseen; ``unsigned``: it may be meant as a size only."""
    mistakes = key.wrongs.near(value)
    size = abs(key.value)
    if not mistakes and unsigned and (value > 0.0 > key.value or key.policy.direction == "ignored"):
        mistakes = key.wrongs.near(-value)
    off = abs(abs(value) - size)
    if off <= _NEAR * key.half * (1.0 + SLACK) and direction and size:
        mistakes = (*mistakes, Wrong("near-miss", value))
    parts = (False, unit, direction)
    code = _codes(mistakes) if mistakes else ""
    share = share_of(key, parts, mistakes)
    return Judgement(WRONG, share, parts, value, relative(off, size), code, mistakes)


def relative(off: float, size: float) -> float | None:
    """An error as a part of the right size; None where that is zero, or no double holds it."""
    part = off / size if size else math.inf
    return part if part < math.inf else None


def _in_full(key: Key, written: Written) -> Judgement:
    """Number, unit and direction apart."""
    factor = key.factor(written.unit)
    sign = key.sign(_words(key, written))
    value = written.number * (factor or 1.0) * (sign or 1)
    size = abs(key.value)
    number = abs(abs(value) - size) <= key.half
    unit = _unit_is_right(key, written, factor)
    if not number and factor != 1.0 and abs(abs(written.number) - size) <= key.half:
        number, unit = True, key.policy.unit == "ignored"
        value = written.number * (sign or 1)
    if number and sign is None and key.value:
        return Judgement(IN_REVIEW, 0.0, (number, unit, False), value, None, SQUARE)
    direction = _direction_is_right(key, written, value, sign)
    off = relative(abs(abs(value) - size), size)
    if number and unit and direction:
        return _right(key, written, value, off)
    if not number:
        return _wrong_size(key, value, unit, direction, written.direction is None)
    parts = (number, unit, direction)
    mistakes = _seen(key, written, value, parts, sign)
    return Judgement(WRONG, share_of(key, parts, mistakes), parts, value, off, _codes(mistakes), mistakes)


def _unjudged(flag: str) -> Judgement:
    if flag == MISSING:
        return Judgement(MISSING, 0.0, _NO_PARTS, code=MISSING)
    return Judgement(IN_REVIEW if flag in REVIEW else INVALID, 0.0, _NO_PARTS, code=flag or UNREAD)


def _words(key: Key, written: Written) -> Direction | None:
    """The answer's direction in words, where those are looked at."""
    return written.direction if key.policy.direction != "ignored" and key.expected.any else None


def _unit_is_right(key: Key, written: Written, factor: float | None) -> bool:
    if key.policy.unit == "ignored":
        return True
    if written.unit is None:
        return key.policy.unit == "assumed" or not key.unit_name
    return factor is not None and not (written.note and key.policy.strict_case)


def _direction_is_right(key: Key, written: Written, value: float, sign: int | None) -> bool:
    """By the sign of the value; by words as well where the course wants them."""
    if not key.value or key.policy.direction == "ignored":
        return True
    if sign == NEITHER or sign is None:
        return False
    if key.policy.direction == "required" and written.direction is None and key.expected.any:
        return False
    return (value > 0.0) == (key.value > 0.0)


def _right(key: Key, written: Written, value: float, off: float | None) -> Judgement:
    """Right, unless too few figures are written."""
    if key.policy.figures and written.digits and figures(written.digits)[1] < key.policy.figures:
        mistakes = (Wrong("figures", value),)
        share = share_of(key, (False, True, True), mistakes)
        return Judgement(WRONG, share, (False, True, True), value, off, "figures", mistakes)
    return Judgement(RIGHT, 1.0, _ALL_PARTS, value, off, written.note if written.unit else "")


def _seen(
    key: Key, written: Written, value: float, parts: tuple[bool, bool, bool], sign: int | None
) -> tuple[Wrong, ...]:
    """What is wrong about a right number: its unit, its sense."""
    _, unit, direction = parts
    found = [] if unit else [Wrong(_unit_code(key, written), value)]
    if not direction:
        found.append(Wrong(_direction_code(key, written, sign), value))
    return tuple(found)


def _unit_code(key: Key, written: Written) -> str:
    if written.unit is None:
        return "no-unit"
    factor = key.factor(written.unit)
    return "unit-case" if written.note and factor and _has_size(key, written.number * factor) else "unit"


def _direction_code(key: Key, written: Written, sign: int | None) -> str:
    if sign == NEITHER or sign is None:
        return "direction"
    if written.direction is None and sign != AGAINST and (written.number > 0.0) == (key.value > 0.0):
        return "no-direction"
    return "sign"


def share_of(key: Key, parts: tuple[bool, bool, bool], mistakes: tuple[Wrong, ...]) -> float:
    """The share of the mark: for the right parts, or for the known mistake, whichever is more."""
    credit = key.policy.credit
    if credit is None and not key.policy.mistakes:
        return 0.0
    earned = (
        sum(part for part, right in zip(credit, parts, strict=True) if right) if credit is not None else 0.0
    )
    known = dict(key.policy.mistakes)
    return min(1.0, max([earned, *(known.get(mistake.code, 0.0) for mistake in mistakes[:1])]))


def _codes(mistakes: tuple[Wrong, ...]) -> str:
    return mistakes[0].code if len(mistakes) == 1 else " ".join(mistake.code for mistake in mistakes)


def feedback(key: AnyKey, judged: Judgement, reveal: bool = False) -> str:
    """What the student is told; never the answer, unless it is right or the course reveals it."""
    if judged.verdict == RIGHT:
        noted = " Mind the capitals of its unit." if judged.code else ""
        return f"Right: {key.accepted} is accepted.{noted}"
    band = f" Accepted is {key.accepted}." if reveal else f" Accepted is an answer {key.rule}."
    if judged.mistakes:
        said = " Or: ".join(message(m.code, m.where) for m in judged.mistakes)
        return said + (band if reveal or judged.mistakes[0].code == "near-miss" else "")
    if judged.verdict == WRONG:
        return f"Not right.{band}"
    return UNJUDGED.get(judged.code, "This can't be read as an answer.")


UNJUDGED = {
    MISSING: "No answer was given.",
    UNREAD: "This can't be read: write a number, a unit and a direction, such as '41.2 N*m ccw'.",
    "no-number": "There is no number in this.",
    "too-long": "This is too long to be an answer.",
    "ambiguous-number": "This number can be read in two ways; a person will look at it. Write no commas.",
    "ambiguous-direction": "Sign and words, or words alone, say two directions; a person will look at it.",
    "ambiguous-unit": "This unit has several meanings; a person will look at it.",
    "two-values": "There are two values in this; a person will look at it.",
    SQUARE: "These words are square to the answer's direction; a person will look at it.",
}
"""What is told where nothing was judged, by the flag."""


_WITHIN = 1.0
"""Degrees within which the direction of a centre at infinity is right."""


def judge_place(key: PlaceKey, written: WrittenPlace) -> Judgement:
    """The verdict on an answer to the question where a centre is."""
    if written.flag:
        verdict = MISSING if written.flag == MISSING else IN_REVIEW if written.flag in REVIEW else INVALID
        return Judgement(verdict, 0.0, (False, False, False), code=written.flag)
    if key.toward is not None or written.toward is not None:
        return _far(key, written)
    factor = unit_factor(key, written.unit.unit) if written.unit is not None else 1.0
    unit = key.policy.unit == "ignored" or factor is not None
    if written.unit is None and key.policy.unit == "required":
        unit = False
    x, y = written.x * (factor or 1.0), written.y * (factor or 1.0)
    off = math.dist((x, y), key.place)
    if (
        off > key.half
        and factor not in (None, 1.0)
        and math.dist((written.x, written.y), key.place) <= key.half
    ):
        off, unit = 0.0, key.policy.unit == "ignored"
    return _judged(key, (x, y), off, unit)


def _judged(key: PlaceKey, at: tuple[float, float], off: float, unit: bool) -> Judgement:
    number = off <= key.half
    parts = (number, unit, True)
    part = relative(off * (key.policy.tolerance.relative or 0.01), key.half)
    if number and unit:
        return Judgement(RIGHT, 1.0, parts, None, part)
    mistakes = (Wrong("unit", 0.0),) if number else _mistakes(key, at, off)
    share = share_of(key, parts, mistakes)  # type: ignore[arg-type]
    return Judgement(WRONG, share, parts, None, part, " ".join(m.code for m in mistakes), mistakes)


def _mistakes(key: PlaceKey, at: tuple[float, float], off: float) -> tuple[Wrong, ...]:
    found = {w.code: w for x, y, w in reversed(key.wrongs) if math.dist(at, (x, y)) <= key.half}
    if off <= _NEAR * key.half:
        found["near-miss"] = Wrong("near-miss", 0.0)
    return tuple(found.values())[:3]


def _far(key: PlaceKey, written: WrittenPlace) -> Judgement:
    """A centre at infinity: right in its direction, modulo a half turn."""
    if key.toward is None or written.toward is None:
        return Judgement(WRONG, 0.0, (False, True, False))
    if math.isnan(written.toward):
        return Judgement(IN_REVIEW, 0.0, (True, True, False), code="no-direction")
    right = abs(math.remainder(written.toward - key.toward, 180.0)) <= _WITHIN
    return Judgement(RIGHT if right else WRONG, float(right), (right, True, right))
