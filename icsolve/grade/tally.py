"""Counts of a class: verdicts, mistakes and answers of each question, in little memory."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Container, Iterable
from typing import NamedTuple

from icsolve.grade.results import Marked

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
    """marks, and the most that there were, of what was judged"""
    texts: Counter[str]
    """the texts that wait for a person"""
    unexplained: Counter[str]
    """the wrong values of no known cause, to four figures"""


def empty() -> Counts:
    """Nothing yet."""
    return Counts(Counter(), Counter(), Counter(), Counter(), 0.0, 0.0, Counter(), Counter())


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
    verdicts, mistakes, bins, unread, score, most, texts, unexplained = counts
    for m in marked:
        judged, n = m.judged, m.count
        verdict, share, _, value, _, code, causes, _ = judged
        verdicts[verdict] += n
        if verdict == "wrong":
            mistakes[causes[0].code if causes else ""] += n
            if not causes and value is not None:
                unexplained[f"{value:.4g}"] += n
        elif verdict in ("invalid", "review"):
            unread[code] += n
            texts[" ".join(m.raw.split())[:_LONGEST]] += n
        if value is not None and band is not None:
            bins[bin_of(value, *band)] += n
        if not m.is_open:
            score += n * share * m.points
            most += n * m.points
        m.count = 0
    return Counts(verdicts, mistakes, bins, unread, score, most, _common(texts), _common(unexplained))


def _common(texts: Counter[str]) -> Counter[str]:
    """The commonest of too many texts."""
    return texts if len(texts) <= _MOST_TEXTS else Counter(dict(texts.most_common(_MOST_TEXTS // 2)))
