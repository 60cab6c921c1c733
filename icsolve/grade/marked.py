"""Answers judged, and the lines of results that they make."""

from __future__ import annotations

from typing import NamedTuple

from icsolve.grade.judge import Judgement


class Marked:
    """An answer judged: the same for every student who writes the same to the same question."""

    __slots__ = (
        "count",
        "direction",
        "given",
        "item",
        "judged",
        "points",
        "raw",
        "tail",
        "text",
        "unit",
        "value",
    )

    def __init__(self, item: str, raw: str, judged: Judgement, points: float, text: str) -> None:
        self.item = item
        self.raw = raw
        self.judged = judged
        self.points = points
        self.text = text
        self.value: float | None = None
        self.unit = ""
        self.direction = ""
        self.given: tuple[float, ...] = ()
        self.tail = ""
        self.count = 0


class Result(NamedTuple):
    """One line of the results."""

    student: str
    item: str
    variant: str
    attempt: str
    line: int
    marked: Marked
