"""Whether many variants of a case suit, and their answers, in one sweep."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from icsolve.answer import Answer
from icsolve.case import Case, Coordinates, Corner
from icsolve.errors import IcsolveError
from icsolve.grade.variants.family import Columns, Family, Mask, Rows
from icsolve.grade.variants.mistakes import slips
from icsolve.grade.variants.suitable import APART, DRAWING, SWING, Mistake, Seen
from icsolve.grade.variants.written import Array, UnsuitedError, Values, columns, written_numbers

_PLAIN = 1e-6
"""A comparison is left to a scene of its own where it is as near as this to going the other way."""


class Together:
    """The variants of one case; ``answer`` is that of ``case``, one of them."""

    def __init__(self, text: str, case: Case, answer: Answer) -> None:
        """Raises UnsuitedError, SceneError where they can't be taken together."""
        self.numbers = written_numbers(text, case)
        self.family = Family(case, answer)
        if not {number.path for number in self.numbers} <= self.family.numbers.keys():
            raise UnsuitedError("a variable stands in a joint")

    def seen(self, draws: Sequence[Values]) -> list[Seen | None]:
        """Each variant; None for one that has to be looked at as a scene of its own."""
        try:
            return look(self.family, columns(self.numbers, draws), len(draws))
        except (IcsolveError, LookupError, ArithmeticError, ValueError):
            return [None] * len(draws)  # what one of them can't be is for scenes of their own to say


def look(family: Family, given: Columns, count: int) -> list[Seen | None]:
    """The rows of a family; None for those that have to be looked at as scenes of their own."""
    with np.errstate(all="ignore"):
        rows = family.run(given, count)
        clear = rows.clear.copy()
        swing = _swing(family, given, rows) / (SWING * np.abs(rows.value))
        clear &= np.abs(swing - 1.0) > _PLAIN
        hidden: list[tuple[Mistake, Mask]] = []
        for slip in slips(family, given, rows):
            off = np.abs(slip.value - rows.value) / (APART * np.abs(rows.value))
            clear &= ~(np.abs(off - 1.0) <= _PLAIN)
            if (off <= 1.0).any():
                hidden.append(((family.unknown, slip.code, slip.where), off <= 1.0))
    return [_seen(row, hidden, swing, rows.value) if clear[row] else None for row in range(count)]


def _seen(row: int, hidden: list[tuple[Mistake, Mask]], swing: Array, value: Array) -> Seen:
    inside = frozenset(mistake for mistake, at in hidden if at[row])
    return Seen(bool(swing[row] < 1.0), inside, float(value[row]))


def _swing(family: Family, given: Columns, rows: Rows) -> Array:
    """By how much the answer may change where the figure is drawn to a thousandth of its size."""
    places = np.stack([rows.points[name] for name in family.named])
    size = np.hypot(*(places.max(axis=0) - places.min(axis=0)).T)
    case, slopes = family.case, family.slopes(given, len(rows.value))
    total = np.zeros(len(rows.value))
    for path in _lengths(case):
        total += np.abs(slopes[path]) * DRAWING * size
    for angle in case.angles:
        ends = [(angle.at, angle.a), (angle.at, angle.b)] if isinstance(angle, Corner) else [angle[:2]]
        if not {p for pair in ends for p in pair} <= rows.points.keys():
            continue  # of a point that nothing asks for
        arms = sum(1.0 / np.hypot(*(rows.points[p] - rows.points[q]).T) for p, q in ends)
        total += np.abs(slopes[angle.value.path]) * np.degrees(DRAWING * size * arms)
    return total


def _lengths(case: Case) -> Iterator[str]:
    """Paths of coordinates and lengths."""
    yield from (length.value.path for length in case.lengths)
    for place in case.points.values():
        if isinstance(place, Coordinates):
            yield from (number.path for number in place if number is not None)
