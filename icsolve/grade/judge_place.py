"""The verdict on a place: the distance from the right one."""

from __future__ import annotations

import math

from icsolve.grade.judge import IN_REVIEW, INVALID, RIGHT, WRONG, Judgement, relative, share_of
from icsolve.grade.keys import PlaceKey, unit_factor
from icsolve.grade.malrules import Wrong
from icsolve.grade.written import MISSING, REVIEW
from icsolve.grade.written.place import WrittenPlace

_WITHIN = 1.0
"""Degrees within which the direction of a centre at infinity is right."""
_NEAR = 3.0


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
