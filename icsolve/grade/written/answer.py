"""An answer as a student wrote it, to a number, a unit and a direction, or to a place.

What has two readings is flagged."""

from __future__ import annotations

import re
from typing import NamedTuple

from icsolve.grade.written.directions import AMBIGUOUS as AMBIGUOUS_DIRECTION
from icsolve.grade.written.directions import Direction, direction
from icsolve.grade.written.numerals import AMBIGUOUS, UNREAD, Numeral, numeral, plain
from icsolve.grade.written.units import AMBIGUOUS as AMBIGUOUS_UNIT
from icsolve.grade.written.units import UnitWord, unit_word

MISSING = "missing"
NO_NUMBER = "no-number"
TOO_LONG = "too-long"
TWO_VALUES = "two-values"
REVIEW = frozenset({"ambiguous-number", AMBIGUOUS_DIRECTION, AMBIGUOUS_UNIT, TWO_VALUES})
"""Flags that ask for a person; the others say that the text can't be read as an answer."""
LONGEST = 200
"""Characters of an answer; more is no number with a unit and a direction."""


class Written(NamedTuple):
    """What an answer says.

    ``number`` is signed, in ``unit`` (None: none was given); ``digits`` carries its significant figures;
    ``direction`` is None where no words give one. ``flag`` is '' where all of the text was read in
    one way; ``note`` is ``unit-case`` where capitals were overlooked.
    """

    number: float
    unit: UnitWord | None
    direction: Direction | None
    digits: str = ""
    flag: str = ""
    note: str = ""


def flagged(flag: str) -> Written:
    """An answer that is not to be judged."""
    return Written(0.0, None, None, "", flag)


_NOTHING = {"", "-", "--", "---", ".", "n/a", "na", "none", "null", "nil"} | {
    "no answer",
    "not answered",
    "no response",
    "keine antwort",
}
_LEAD = re.compile(
    r"(?:approximately|approx\.?|about|around|roughly|ca\.?|circa|answer|ans\.?|result|value|magnitude|is|equals|~|=|:"
    r"|answer is|the answer is)+\s*",
    re.IGNORECASE,
)
_INTRODUCE = set(
    "the a an force torque moment load answer value required unknown result is of about i get got and".split()
)
_NAME = re.compile(r"\s*\|?[^\W\d_][\w'\-/ω{}^.]*(?: ?\([\w' ]*\))?\|?\s*(?:=|:|~)\s*(?=[^=])")
_LETTERS = ("T", "C")
"""Tension and compression; only tonnes and coulombs would end so."""
_AXES = {
    "+x",
    "-x",
    "+y",
    "-y",
    "x",
    "y",
    "positive",
    "negative",
    "the",
    "a",
    "tension",
    "compression",
    "direction",
}
_SEXAGESIMAL = re.compile(r"(\d+(?:\.\d+)?) ?° ?(\d+(?:\.\d+)?) ?'(?: ?(\d+(?:\.\d+)?) ?\")?$")


class Reader:
    """Reads answers; remembers what followed the numbers, which repeats from student to student.

    ``decimal`` says what a comma before three digits is: ``point`` (a group of thousands), ``comma``
    (a decimal mark) or ``either`` (flagged).
    """

    _MOST = 4096

    def __init__(self, decimal: str = "either") -> None:
        self.decimal = decimal
        self._rests: dict[str, Written] = {}

    def read(self, text: str) -> Written:
        """The reading of an answer's text."""
        if text[-1:].isdigit() and "_" not in text and self.decimal != "comma":
            try:
                number = float(text)
            except ValueError:
                return self.slowly(text)
            if number - number == 0.0:
                return Written(number, None, None, text)
        quick = _QUICK.match(text)
        if quick is not None and self.decimal != "comma":
            digits, rest = quick.groups()
            after = self._rests.get(rest) or self._remember(rest)
            number = float(digits)
            if not after.flag and (number >= 0.0 or after.direction is None):
                return Written(number, after.unit, after.direction, digits, "", after.note)
        return self.slowly(text)

    def _remember(self, rest: str) -> Written:
        if len(self._rests) >= self._MOST:
            self._rests.clear()
        found = self._rests[rest] = _rest(plain(rest), Written(0.0, None, None))
        return found

    def slowly(self, text: str) -> Written:
        """As ``read``, of any text."""
        if len(text) > LONGEST * 20:
            return flagged(TOO_LONG)
        words = plain(text)
        if words.lower() in _NOTHING:
            return flagged(MISSING)
        if len(words) > LONGEST:
            return flagged(TOO_LONG)
        return _answer(words, self.decimal)


_QUICK = re.compile(
    r"([-+]?\d{1,30}(?:\.\d{1,30})?(?:[eE][-+]?\d\d?)?)"
    r"((?: ?[A-Za-z°][A-Za-z °·*/.-]*)?)\Z",
    re.ASCII,
)
"""Plain answers, which are most: digits, then words without digits."""


def _answer(text: str, decimal: str) -> Written:
    text = _unwrapped(text)
    before, start = _before(text)
    if start is None:
        return flagged(NO_NUMBER)
    if _is_accounting(text):
        return flagged("ambiguous-number")
    if before.rstrip().endswith("±"):
        return flagged(TWO_VALUES)
    sign, before = _sign(before)
    angle = _SEXAGESIMAL.fullmatch(text[start:])
    found = _sexagesimal(angle) if angle else numeral(text, start, decimal)
    if found is None:
        return flagged(NO_NUMBER)
    if found.flag:
        return flagged(found.flag)
    read = _rest(text[found.end :].strip(), Written(0.0, None, None))
    if angle:
        read = _rest("deg", read)
    return _joined(read, _leading(before), found, sign)


def _sexagesimal(parts: re.Match[str]) -> Numeral:
    """Degrees, minutes and seconds."""
    degrees, minutes, seconds = (float(part or 0) for part in parts.groups())
    return Numeral(degrees + minutes / 60.0 + seconds / 3600.0, parts.end(), "")


def _unwrapped(text: str) -> str:
    """Without what only introduces: ``T12 = ...``, ``approx.``, brackets around all of it, quotes, a stop."""
    if text[:1] in "\"'" and text[-1:] == text[:1]:
        text = text[1:-1].strip()
    if text[:1] == "'" and text.count("'") == 1:
        text = text[1:].lstrip()  # by which a spreadsheet keeps a text
    inside = text[1:-1]
    bracketed = text[:1] in tuple("([{") and text[-1:] in tuple(")]}") and not set(inside) & set("()[]{}")
    if bracketed and not _is_accounting(text):
        text = inside.strip()
    name = _NAME.match(text)
    if name is not None and _is_name(name.group()):
        text = text[name.end() :]
    lead = _LEAD.match(text)
    return text[lead.end() :] if lead is not None and lead.end() < len(text) else text


def _is_name(text: str) -> bool:
    """Whether what stands before a ``=`` or a colon names the answer: ``down: 5 N`` gives its direction, and
    so does ``T: 5 N``, but ``T = 5`` does not."""
    said = text.strip(" :~=")
    return (text.rstrip().endswith("=") and len(said) == 1) or direction(said) is None


def _is_accounting(text: str) -> bool:
    """``(412.7)``: bare brackets mean a negative number to a spreadsheet."""
    return bool(re.fullmatch(r"\(\s*[\d.,' ]+\)", text))


def _before(text: str) -> tuple[str, int | None]:
    """What stands before the number, and where the number starts."""
    found = re.search(r"(?<![A-Za-z_])(?:\d|[.,]\d|√|sqrt ?\(|pi(?![a-z]))", text, re.IGNORECASE)
    return (text[: found.start()], found.start()) if found is not None else (text, None)


def _sign(before: str) -> tuple[str, str]:
    """The sign right before the number, and what stands before that."""
    stripped = before.rstrip()
    if stripped.endswith(("-", "+")):
        return stripped[-1], stripped[:-1].rstrip()
    return "", stripped


def _leading(before: str) -> Direction | str | None:
    """The direction that stands before the number; a flag where the words are not understood."""
    words = before.strip(" ,;:=~([{")
    if not words or all(word in _INTRODUCE for word in words.lower().split()):
        return None
    found = direction(words)
    return found if found is not None else UNREAD


def _rest(text: str, read: Written) -> Written:
    """What follows the number: a unit, a direction, both in this order, or nothing."""
    text = re.sub(r"[.!]+$", "", text).strip(" ,;)") if text not in ('"', "'") else text
    if not text:
        return read
    whole = unit_word(text) or unit_word(text.strip("[](){} "))
    if whole is not None and not text.endswith(_LETTERS):
        return _doubted(whole.note) or read._replace(unit=whole, note=whole.note)
    return _parted(text, read)


def _doubted(note: str) -> Written | None:
    """A reading that is flagged for a unit of two meanings."""
    return flagged(AMBIGUOUS_UNIT) if note == AMBIGUOUS_UNIT else None


def _parted(text: str, read: Written) -> Written:
    """A unit and a direction: the longest unit after which a direction stands."""
    words = _pieces(text)
    for cut in range(len(words), -1, -1):
        unit_text, rest = " ".join(words[:cut]).strip("[](){},; "), words[cut:]
        unit = unit_word(unit_text) if unit_text else None
        if (unit is None and unit_text) or _belongs_to_direction(words, cut):
            continue
        way = direction(" ".join(rest)) if rest else None
        if way is not None:
            return _checked(read._replace(unit=unit, direction=way, note=unit.note if unit else ""))
    return flagged(_why_unread(text))


def _pieces(text: str) -> list[str]:
    """Words, with signs and brackets that touch them set apart from the unit before."""
    spaced = re.sub(r"(?<=[A-Za-z°%])(?=[(\[{@])|(?<=[,;])(?=\S)|(?<=[)\]}])(?=\S)|(?=@)", " ", text)
    return spaced.split()


def _belongs_to_direction(words: list[str], cut: int) -> bool:
    """Whether the ``in`` before the cut is the preposition: ``N in tension``, ``in the -x direction``."""
    if not 0 < cut < len(words) or words[cut - 1].lower() != "in":
        return False
    return words[cut].lower().strip("([,") in _AXES


def _checked(read: Written) -> Written:
    """Flags of its parts."""
    assert read.direction is not None
    return flagged(read.direction.flag) if read.direction.flag else _doubted(read.note) or read


def _why_unread(text: str) -> str:
    """Two values where another number stands in it, else not understood."""
    return TWO_VALUES if re.search(r"(?<![A-Za-z^\d.,])\d", text) else UNREAD


def _joined(read: Written, leading: Direction | str | None, found: Numeral, sign: str) -> Written:
    """Number, sign, and the directions before and after it as one reading."""
    if read.flag or isinstance(leading, str):
        return read if read.flag else flagged(UNREAD)
    way = read.direction or leading
    if read.direction is not None and leading is not None and read.direction != leading:
        return flagged(AMBIGUOUS_DIRECTION)
    if way is not None and (way.flag or (sign == "-" and found.value != 0.0)):
        return flagged(AMBIGUOUS_DIRECTION)
    number = -found.value if sign == "-" else found.value
    return read._replace(number=number, direction=way, digits=found.digits)


_NONE = {"", "-", "1", "none", "n/a", "na", "dimensionless", "[-]"}
_MOST = 4096


class Combined:
    """Reads answers of up to three columns; remembers units and directions, which repeat."""

    def __init__(self, reader: Reader) -> None:
        self.reader = reader
        self._units: dict[str, UnitWord | str | None] = {}
        self._directions: dict[str, Direction | str | None] = {}

    def read(self, answer: str, unit: str = "", way: str = "") -> Written:
        """The reading of all of it; what one column says against another is flagged."""
        written = self.reader.read(answer)
        if (not unit and not way) or written.flag:
            return written
        number, own_unit, own_way, digits, _, note = written
        word, direction = self._unit(unit), self._direction(way)
        flag = _unit_flag(own_unit, word) or _direction_flag(number, own_way, direction)
        if flag:
            return flagged(flag)
        if word is not None:
            own_unit, note = word, note or word.note  # type: ignore[assignment, union-attr]
        return Written(number, own_unit, direction or own_way, digits, "", note)  # type: ignore[arg-type]

    def _unit(self, text: str) -> UnitWord | str | None:
        """The unit of its own column; a flag where it is none."""
        if not text:
            return None
        if text not in self._units:
            if len(self._units) >= _MOST:
                self._units.clear()
            words = plain(text)
            self._units[text] = None if words.lower() in _NONE else unit_word(words) or UNREAD
        return self._units[text]

    def _direction(self, text: str) -> Direction | str | None:
        if not text:
            return None
        if text not in self._directions:
            if len(self._directions) >= _MOST:
                self._directions.clear()
            words = plain(text)
            self._directions[text] = (
                None if words.lower() in _NONE else direction(words) or AMBIGUOUS_DIRECTION
            )
        return self._directions[text]


def _unit_flag(own: UnitWord | None, word: UnitWord | str | None) -> str:
    """What is against a unit in a column of its own: it is none, or ambiguous, or the answer has another."""
    if word is None:
        return ""
    if isinstance(word, str):
        return word
    if word.note == AMBIGUOUS_UNIT or (own is not None and own.unit != word.unit):
        return AMBIGUOUS_UNIT
    return ""


def _direction_flag(number: float, own: Direction | None, way: Direction | str | None) -> str:
    if way is None:
        return ""
    if isinstance(way, str):
        return way
    return AMBIGUOUS_DIRECTION if way.flag or number < 0.0 or (own is not None and own != way) else ""


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
_PLACE_NAME = re.compile(r"\s*[^\W\d_][\w'-]*\s*(?:=|:|\bis\b)\s*(?=[\[({]|at|inf|∞|[-+.\d])")


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
    name = _PLACE_NAME.match(words)
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
