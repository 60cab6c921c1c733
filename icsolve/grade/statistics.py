"""What a class answered: counts of verdicts, mistakes and answers while they are judged; totals of students,
how hard and how telling a question is, from the results.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from operator import add

from icsolve.grade.course import Person
from icsolve.grade.results import Marked, ResultRow, by_student, marks_of
from icsolve.tuples import NamedTuple

_LEAST = 10
"""Students from whom it is told how telling a question is."""


class Total(NamedTuple):
    """One student's marks of all that was judged, and how many answers wait for a person."""

    student: str
    section: str
    score: float
    most: float
    waiting: int


class Statistics(NamedTuple):
    """Of a class: how telling its questions are, by name, its students in order, and the mean share of each
    section."""

    discriminations: dict[str, float | None]
    """the correlation of the share of a question's points with the share of all other points; None where
    students are too few or all alike"""
    totals: list[Total]
    sections: dict[str, tuple[int, float]]


def _correlation(n: float, x: float, y: float, xx: float, yy: float, xy: float) -> float | None:
    """What follows from the sums over students of 1, x, y, their squares and their product."""
    spread = (n * xx - x**2) * (n * yy - y**2)
    known = n >= _LEAST and spread > 1e-9 * n**4
    return (n * xy - x * y) / math.sqrt(spread) if known else None


def statistics(results: str, people: Mapping[str, Person]) -> Statistics:
    """The statistics of a file of results, read once."""
    sums: dict[str, list[float]] = {}
    totals: list[Total] = []
    for student, rows in by_student(results):
        if student and rows:
            score, most, _, waiting = marks_of(rows)
            section = people[student].section if student in people else ""
            totals.append(Total(student, section, score, most, waiting))
            _count(sums, [row for row in rows if row.score is not None and row.max_score])
    return Statistics({name: _correlation(*own) for name, own in sums.items()}, totals, _sections(totals))


def _count(sums: dict[str, list[float]], rows: Sequence[ResultRow]) -> None:
    """Add a student's share of each question, and of all others."""
    score, most = sum(row.score or 0.0 for row in rows), sum(row.max_score for row in rows)
    for row in rows:
        others = most - row.max_score
        if others:
            x, y = (row.score or 0.0) / row.max_score, (score - (row.score or 0.0)) / others
            before = sums.get(row.case, [0.0] * 6)
            sums[row.case] = [*map(add, before, (1.0, x, y, x * x, y * y, x * y))]


def _sections(totals: Sequence[Total]) -> dict[str, tuple[int, float]]:
    """How many students each section has, and the mean of their shares."""
    shares: dict[str, list[float]] = {}
    for total in totals:
        if total.section and total.most:
            shares.setdefault(total.section, []).append(total.score / total.most)
    return {name: (len(found), sum(found) / len(found)) for name, found in sorted(shares.items())}


BINS = 20
"""Bins of the histogram to each side of zero, up to twice the right answer; one more for what lies beyond.

The right answer, its half and its double lie in the middle of bins, so that rounding does not divide them."""
_SPAN = 2.0


OTHERS = "(other names that are no case)"
_MOST_STRANGE = 200
"""Names that are no case which are counted one by one."""
_MOST_TEXTS = 4000
"""Texts of a question that are counted one by one; of more the commonest half is kept."""
_LONGEST = 80


class Counts:
    """What a class answered to one question."""

    def __init__(self) -> None:
        self.verdicts: Counter[str] = Counter()
        self.mistakes: Counter[str] = Counter()
        """by the first cause; '' for those of no known cause"""
        self.bins: Counter[int] = Counter()
        """answers by `bin_of` their ratio to the right one"""
        self.unread: Counter[str] = Counter()
        """invalid answers and those for review, by their flag"""
        self.score = self.max_score = 0.0
        """marks, and the most that there were, of what was judged"""
        self.texts: Counter[str] = Counter()
        """the texts that wait for a person"""
        self.unexplained: Counter[str] = Counter()
        """the wrong values of no known cause, to four figures"""

    def add(self, m: Marked, band: tuple[float, float] | None) -> None:
        """Count an answer as often as it was given; its own count starts again."""
        judged, n = m.judged, m.count
        verdict, share, _, value, _, code, causes, _ = judged
        self.verdicts[verdict] += n
        if verdict == "wrong":
            self.mistakes[causes[0].code if causes else ""] += n
            if not causes and value is not None:
                _count_text(self.unexplained, f"{value:.4g}", n)
        elif verdict in ("invalid", "review"):
            self.unread[code] += n
            _count_text(self.texts, " ".join(m.raw.split())[:_LONGEST], n)
        if value is not None and band is not None:
            self.bins[bin_of(value, *band)] += n
        if m.score is not None:
            self.score += n * share * m.points
            self.max_score += n * m.points
        m.count = 0


def _count_text(texts: Counter[str], text: str, n: int) -> None:
    """Count a text; of too many the commonest half is kept."""
    texts[text] += n
    if len(texts) > _MOST_TEXTS:
        common = texts.most_common(_MOST_TEXTS // 2)
        texts.clear()
        texts.update(dict(common))


def bin_of(value: float, right: float, half: float) -> int:
    """The bin of an answer: of its ratio to the right one, of a zero by half-widths."""
    ratio = value / right if right else (value / half if half else 0.0)
    if not math.isfinite(ratio) or abs(ratio) > _SPAN * (1.0 + 0.5 / BINS):
        return (BINS + 1) * (1 if ratio > 0 else -1)
    return round(ratio / _SPAN * BINS)


class Tally:
    """Counts that grow: what was judged is counted and forgotten."""

    def __init__(self, band: Callable[[str], tuple[float, float] | None]) -> None:
        self._band = band
        self._strange = 0
        self.counts: dict[str, Counts] = {}

    def add(self, marked: Iterable[Marked]) -> None:
        """Count answers, each as often as it was given."""
        for m in marked:
            item = self._item_of(m)
            if item not in self.counts:
                self.counts[item] = Counts()
            self.counts[item].add(m, self._band(item))

    def _item_of(self, m: Marked) -> str:
        """The question under which an answer is counted; of names that are no case only so many are kept."""
        strange = m.judged.code == "not-graded" and m.item not in self.counts
        if strange:
            self._strange += 1
        return OTHERS if strange and self._strange > _MOST_STRANGE else m.item
