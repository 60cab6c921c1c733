"""A place as a student wrote it: two coordinates, or a direction in which it lies at infinity."""

from __future__ import annotations

import re
from typing import NamedTuple

from icsolve.grade.written.answer import LONGEST, MISSING, NO_NUMBER, TOO_LONG, TWO_VALUES
from icsolve.grade.written.characters import plain
from icsolve.grade.written.numerals import AMBIGUOUS, UNREAD, numeral
from icsolve.grade.written.unit_words import UnitWord, unit_word

_NUMBER = r"([-+]? ?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?)"
_COMMA_NUMBER = r"([-+]? ?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][-+]?\d+)?)"
_UNIT = r" ?([A-Za-z]{1,12})?"
_X, _Y = r"(?:x ?[:=] ?)?", r"(?:y ?[:=] ?)?"
_COMMA = re.compile(rf"{_X}{_NUMBER}{_UNIT} ?,+ ?(?:and )?{_Y}{_NUMBER}{_UNIT}$", re.IGNORECASE)
_OTHER = re.compile(
    rf"{_X}{_COMMA_NUMBER}{_UNIT}(?: ?; ?| ?\| ?| and | )(?:and )?{_Y}{_COMMA_NUMBER}{_UNIT}$", re.IGNORECASE
)
_FAR = re.compile(
    r"(?:is )?(?:at |to )?(?:inf|infinity|infinite|∞|oo|unendlich)(?:ly far)?(?![a-z])\.?[ ,]*(.*)$",
    re.IGNORECASE,
)
_TOWARD = re.compile(
    rf"(?:in direction|in the direction|direction|towards?|at|along|:|=)? ?{_NUMBER} ?(?:deg|degrees|°)?$",
    re.IGNORECASE,
)
_NAME = re.compile(r"\s*[^\W\d_][\w'-]*\s*(?:=|:|\bis\b)\s*(?=[\[({]|at|inf|∞|[-+.\d])")


class WrittenPlace(NamedTuple):
    """``x`` and ``y`` in ``unit`` (None: none given), or ``toward`` in degrees for a place at infinity.

    ``toward`` is NaN where it is at infinity in no direction that is said. ``flag`` as for other answers.
    """

    x: float = 0.0
    y: float = 0.0
    unit: UnitWord | None = None
    toward: float | None = None
    flag: str = ""


def read_place(text: str) -> WrittenPlace:
    """The reading of an answer that should be a place."""
    words = plain(text[: LONGEST * 20])
    if words.lower() in ("", "-", "n/a", "na", "none"):
        return WrittenPlace(flag=MISSING)
    if len(words) > LONGEST:
        return WrittenPlace(flag=TOO_LONG)
    name = _NAME.match(words)
    if name is not None and name.group().strip().lower()[:1] != "x":
        words = words[name.end() :].strip()
    far = _FAR.match(words)
    return _far(far.group(1)) if far is not None else _near(words)


def _far(rest: str) -> WrittenPlace:
    if not rest:
        return WrittenPlace(toward=float("nan"))
    found = _TOWARD.match(rest)
    return WrittenPlace(toward=float(found.group(1).replace(" ", ""))) if found else WrittenPlace(flag=UNREAD)


def _near(words: str) -> WrittenPlace:
    """Two numbers between which a comma, a semicolon or a space stands."""
    bare, after = _unbracketed(words)
    found = _COMMA.match(bare) or _OTHER.match(bare)
    if found is None:
        count = len(re.findall(r"\d+(?:[.,]\d+)*", bare))
        return WrittenPlace(
            flag=NO_NUMBER if not count else AMBIGUOUS if "," in bare else TWO_VALUES if count > 2 else UNREAD
        )
    first, unit, second, second_unit = found.groups()
    x, y = (numeral(part.lstrip("-+ ")) for part in (first, second))
    if x is None or y is None or x.flag or y.flag:
        return WrittenPlace(flag=AMBIGUOUS)
    return _with_unit(_signed(first, x.value), _signed(second, y.value), unit, second_unit or after)


def _unbracketed(words: str) -> tuple[str, str]:
    """What stands in brackets, and the unit after them."""
    inside = re.match(r"[\[({] ?([^\[\](){}]*?) ?[\])}] ?([A-Za-z]*)\.?$", words)
    return (inside.group(1), inside.group(2)) if inside else (words.rstrip("."), "")


def _signed(text: str, value: float) -> float:
    return -value if text.startswith("-") else value


def _with_unit(x: float, y: float, first: str | None, second: str | None) -> WrittenPlace:
    if first and second and first != second:
        return WrittenPlace(flag=UNREAD)
    name = first or second
    unit = unit_word(name) if name else None
    return WrittenPlace(flag=UNREAD) if name and unit is None else WrittenPlace(x, y, unit)
