"""Counts of a class: verdicts, mistakes and answers of each question, small enough to add up and to send."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Container, Iterable
from typing import NamedTuple

from icsolve.grade.results import Marked

BINS = 20
"""Bins of the histogram to each side of zero, up to twice the right answer; one more for what lies beyond."""
_SPAN = 2.0


OTHERS = "(other names that are no case)"
_MOST_STRANGE = 200
"""Names that are no case which are counted one by one."""


class Counts(NamedTuple):
    """What a class answered to one question."""

    verdicts: Counter[str]
    mistakes: Counter[str]
    """by the first cause; '' for those of no known cause"""
    bins: Counter[int]
    """answers by `bin_of` their ratio to the right one"""
    unread: Counter[str]
    """invalid answers and those for review, by their flag"""
    score: float
    max_score: float


def empty() -> Counts:
    """Nothing yet."""
    return Counts(Counter(), Counter(), Counter(), Counter(), 0.0, 0.0)


def bin_of(value: float, right: float, half: float) -> int:
    """The bin of an answer: of its ratio to the right one, of a zero by half-widths."""
    ratio = value / right if right else (value / half if half else 0.0)
    if not math.isfinite(ratio) or abs(ratio) > _SPAN:
        return (BINS + 1) * (1 if ratio > 0 else -1)
    return math.ceil(ratio / _SPAN * BINS) if ratio > 0 else math.floor(ratio / _SPAN * BINS)


class Tally:
    """Counts that grow: what was judged is counted and forgotten."""

    def __init__(self, band: Callable[[str], tuple[float, float] | None]) -> None:
        self._band = band
        self._strange = 0
        self.counts: dict[str, Counts] = {}

    def add(self, marked: Iterable[Marked]) -> None:
        """Count answers, each as often as it was given; its own count starts again."""
        items: dict[str, list[Marked]] = {}
        for m in marked:
            if m.count:
                items.setdefault(self._item_of(m, items), []).append(m)
        for item, own in items.items():
            self.counts[item] = _with(self.counts.get(item) or empty(), own, self._band(item))


    def _item_of(self, m: Marked, new: Container[str]) -> str:
        """The question under which an answer is counted; of names that are no case only so many are kept."""
        known = m.item in self.counts or m.item in new
        strange = m.judged.code == "not-graded" and not known
        if strange:
            self._strange += 1
        return OTHERS if strange and self._strange > _MOST_STRANGE else m.item


def _with(counts: Counts, marked: list[Marked], band: tuple[float, float] | None) -> Counts:
    """The counts of a question with more answers to it."""
    verdicts, mistakes, bins, unread, score, most = counts
    for m in marked:
        judged, n = m.judged, m.count
        verdict, share, _, value, _, code, causes = judged
        verdicts[verdict] += n
        if verdict == "wrong":
            mistakes[causes[0].code if causes else ""] += n
        elif verdict in ("invalid", "review"):
            unread[code] += n
        if value is not None and band is not None:
            bins[bin_of(value, *band)] += n
        score += n * share * m.points
        most += n * m.points
        m.count = 0
    return Counts(verdicts, mistakes, bins, unread, score, most)


def added(parts: Iterable[dict[str, Counts]]) -> dict[str, Counts]:
    """Counts of several groups of students together."""
    total: dict[str, Counts] = {}
    for part in parts:
        for item, counts in part.items():
            before = total.get(item) or empty()
            total[item] = Counts(
                before.verdicts + counts.verdicts,
                before.mistakes + counts.mistakes,
                before.bins + counts.bins,
                before.unread + counts.unread,
                before.score + counts.score,
                before.max_score + counts.max_score,
            )
    return dict(sorted(total.items()))
