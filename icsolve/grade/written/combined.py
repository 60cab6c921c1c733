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
        word = self._unit(unit)
        direction = self._direction(way)
        flag = _unit_flag(written, word) or _direction_flag(written, direction)
        if flag:
            return flagged(flag)
        found_unit = written.unit if word is None else word
        found_way = written.direction if direction is None else direction
        note = written.note or (word.note if isinstance(word, UnitWord) else "")
        return Written(written.number, found_unit, found_way, written.digits, "", note)  # type: ignore[arg-type]

    def _unit(self, text: str) -> UnitWord | str | None:
        """The unit of its own column; a flag where it is none."""
        if text not in self._units:
            if len(self._units) >= _MOST:
                self._units.clear()
            words = plain(text)
            self._units[text] = None if words.lower() in _NONE else unit_word(words) or UNREAD
        return self._units[text]

    def _direction(self, text: str) -> Direction | str | None:
        if text not in self._directions:
            if len(self._directions) >= _MOST:
                self._directions.clear()
            words = plain(text)
            self._directions[text] = (
                None if words.lower() in _NONE else direction(words) or AMBIGUOUS_DIRECTION
            )
        return self._directions[text]


def _unit_flag(written: Written, word: UnitWord | str | None) -> str:
    if isinstance(word, str):
        return word
    if word is None:
        return ""
    if word.note == AMBIGUOUS_UNIT:
        return AMBIGUOUS_UNIT
    return AMBIGUOUS_UNIT if written.unit is not None and written.unit.unit != word.unit else ""


def _direction_flag(written: Written, way: Direction | str | None) -> str:
    if isinstance(way, str):
        return way
    if way is None:
        return ""
    if way.flag or written.number < 0.0 or (written.direction is not None and written.direction != way):
        return AMBIGUOUS_DIRECTION
    return ""


__all__ = ["MISSING", "Combined"]
