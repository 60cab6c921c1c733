"""Statistics of a class from its results: totals of students, and how hard and how telling a question is."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from icsolve.grade.results import ResultRow, by_student
from icsolve.grade.roster import Person

_LEAST = 10
"""Students from whom it is told how telling a question is."""


class ItemStatistics(NamedTuple):
    """Of one question: the mean share of its points among those who were judged (its difficulty, 1 the
    easiest), and the correlation of that share with the share of all other points (its discrimination, None
    where students are too few or all alike)."""

    judged: int
    difficulty: float | None
    discrimination: float | None


class Total(NamedTuple):
    """One student's marks of all that was judged, and how many answers wait for a person."""

    student: str
    section: str
    score: float
    most: float
    waiting: int


class Statistics(NamedTuple):
    """Of a class: its questions by name, its students in order, and the mean share of each section."""

    items: dict[str, ItemStatistics]
    totals: list[Total]
    sections: dict[str, tuple[int, float]]


class _Sums:
    """The sums from which a mean and a correlation follow."""

    def __init__(self) -> None:
        self.n = 0
        self.pairs = 0
        self.x = self.all = self.y = self.xx = self.yy = self.xy = 0.0

    def add(self, x: float, y: float | None) -> None:
        """A student's share of this question, and of all others (None: there are none)."""
        self.n += 1
        self.all += x
        if y is not None:
            self.pairs += 1
            self.x += x
            self.y += y
            self.xx += x * x
            self.yy += y * y
            self.xy += x * y

    def item(self) -> ItemStatistics:
        """What follows from the sums."""
        mean = self.all / self.n if self.n else None
        n = self.pairs
        if n < _LEAST:
            return ItemStatistics(self.n, mean, None)
        spread = (n * self.xx - self.x**2) * (n * self.yy - self.y**2)
        found = (n * self.xy - self.x * self.y) / math.sqrt(spread) if spread > 1e-9 * n**4 else None
        return ItemStatistics(self.n, mean, found)


def statistics(results: str, people: Mapping[str, Person]) -> Statistics:
    """The statistics of a file of results, read once."""
    sums: dict[str, _Sums] = {}
    totals: list[Total] = []
    for student, rows in by_student(results):
        if student and rows:
            totals.append(_total(student, rows, people))
            _count(sums, [row for row in rows if row.score is not None and row.max_score])
    return Statistics({name: sums[name].item() for name in sorted(sums)}, totals, _sections(totals))


def _total(student: str, rows: Sequence[ResultRow], people: Mapping[str, Person]) -> Total:
    judged = [row for row in rows if row.score is not None]
    section = people[student].section if student in people else ""
    score, most = sum(row.score or 0.0 for row in judged), sum(row.max_score for row in judged)
    return Total(student, section, score, most, len(rows) - len(judged))


def _count(sums: dict[str, _Sums], rows: Sequence[ResultRow]) -> None:
    score, most = sum(row.score or 0.0 for row in rows), sum(row.max_score for row in rows)
    for row in rows:
        others = most - row.max_score
        rest = (score - (row.score or 0.0)) / others if others else None
        sums.setdefault(row.case, _Sums()).add((row.score or 0.0) / row.max_score, rest)


def _sections(totals: Sequence[Total]) -> dict[str, tuple[int, float]]:
    """How many students each section has, and the mean of their shares."""
    shares: dict[str, list[float]] = {}
    for total in totals:
        if total.section and total.most:
            shares.setdefault(total.section, []).append(total.score / total.most)
    return {name: (len(found), sum(found) / len(found)) for name, found in sorted(shares.items())}
