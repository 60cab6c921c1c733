"""Answers judged, and the lines of results that they make."""

from __future__ import annotations

from typing import NamedTuple

from icsolve.grade.judge import Judgement
from icsolve.grade.written import UnitWord, Written


class Marked:
    """An answer judged: the same for every student who writes the same to the same question.

    ``written`` is its reading, None where there is none, or it is of a ``place`` (in the question's
    unit; ``place_unit`` as written); ``text`` what the student is told; ``count`` how often it was given.
    """

    __slots__ = ("count", "item", "judged", "place", "place_unit", "points", "raw", "tail", "text", "written")

    def __init__(
        self,
        item: str,
        raw: str,
        judged: Judgement,
        points: float,
        text: str,
        written: Written | None = None,
    ) -> None:
        self.item = item
        self.raw = raw
        self.judged = judged
        self.points = points
        self.text = text
        self.written = written
        self.place: tuple[float, ...] = ()
        self.place_unit: UnitWord | None = None
        self.tail = ""
        self.count = 0

    @property
    def value(self) -> float | None:
        """The number as written."""
        return self.written.number if self.written is not None else None

    @property
    def unit(self) -> str:
        """The unit as written, in plain spelling."""
        unit = self.written.unit if self.written is not None else self.place_unit
        return unit.name if unit is not None else ""

    @property
    def direction(self) -> str:
        """The direction in words, in plain spelling."""
        way = self.written.direction if self.written is not None else None
        return way.words if way is not None else ""

    @property
    def given(self) -> tuple[float, ...]:
        """The answer in the question's unit: one number, or the place."""
        return self.place if self.judged.value is None else (self.judged.value,)


class Result(NamedTuple):
    """One line of the results."""

    student: str
    item: str
    variant: str
    attempt: str
    line: int
    marked: Marked
