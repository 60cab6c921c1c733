"""An answer whose number, unit and direction may stand in columns of their own."""

from __future__ import annotations

from icsolve.grade.written.answer import MISSING, Reader, Written, flagged
from icsolve.grade.written.characters import plain
from icsolve.grade.written.directions import AMBIGUOUS as AMBIGUOUS_DIRECTION
from icsolve.grade.written.directions import Direction, direction
from icsolve.grade.written.numerals import UNREAD
from icsolve.grade.written.unit_words import AMBIGUOUS as AMBIGUOUS_UNIT
from icsolve.grade.written.unit_words import UnitWord, unit_word

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


__all__ = ["MISSING", "Combined"]
