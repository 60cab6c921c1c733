"""Which way a positive answer goes, and whether words say so."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

from icsolve.answer import Answer
from icsolve.case import Force, ForceVector, Load, Spring, Torque, Toward, Weight
from icsolve.grade.malrules.changed import Place, heading_of, place_of
from icsolve.grade.written import Direction

_SQUARE = 5.0
"""Degrees: words this near to square to the answer say neither way."""
_ROUNDING = 1e-6
"""Degrees: 45 is within 45."""

Places = tuple[Place | None, Mapping[str, Place]]

WITH, AGAINST, NEITHER = 1, -1, 0


class Senses(NamedTuple):
    """What a positive value means in words.

    ``turn``: +1 ccw, -1 cw, 0 where it does not turn; ``heading``: degrees ccw from +x, None where it has
    none; ``axial``: +1 pull, -1 push, 0 for neither; ``places`` tells where it acts and where the points
    are, when ``toward A`` asks for it.
    """

    turn: float = 0.0
    heading: float | None = None
    axial: float = 0.0
    places: Callable[[], Places] = lambda: (None, {})

    @property
    def any(self) -> bool:
        """Whether the answer has a direction at all."""
        return bool(self.turn or self.axial or self.heading is not None)

    def sign(self, words: Direction, within: float) -> int | None:
        """``WITH`` or ``AGAINST`` the positive sense, ``NEITHER``; None where a person must look."""
        if words.kind == "turn":
            return int(words.value * self.turn)
        if words.kind == "axial" and self.axial:
            return int(words.value * self.axial)
        if words.kind == "axial":
            return None if self.heading is not None or self.turn else NEITHER
        degrees = self._degrees(words)
        if self.heading is None:
            return NEITHER
        return _compared(degrees - self.heading, within) if degrees is not None else None

    def _degrees(self, words: Direction) -> float | None:
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


def senses_of(load: Load, answer: Answer) -> Senses:
    """The senses of a load's positive value."""
    if isinstance(load, Torque):
        return Senses(turn=-1.0 if load.turns == "cw" else 1.0)
    if isinstance(load, Spring) or (isinstance(load, Weight) and load.mass):
        return Senses()
    assert isinstance(load, Force | ForceVector | Weight)
    axial = 0.0
    if isinstance(load, Force) and isinstance(load.heading, Toward):
        axial = -1.0 if load.heading.away else 1.0
    return Senses(0.0, heading_of(load, answer), axial, lambda: (place_of(load.at, answer), answer.points))
