"""Reading of what students write: a number, a unit, a direction, or a flag."""

from icsolve.grade.written.answer import MISSING, NO_NUMBER, TOO_LONG, TWO_VALUES, Reader, Written
from icsolve.grade.written.directions import Direction
from icsolve.grade.written.numerals import UNREAD, figures
from icsolve.grade.written.units import UnitWord, factors_between

__all__ = [
    "MISSING",
    "NO_NUMBER",
    "TOO_LONG",
    "TWO_VALUES",
    "UNREAD",
    "Direction",
    "Reader",
    "UnitWord",
    "Written",
    "factors_between",
    "figures",
]
