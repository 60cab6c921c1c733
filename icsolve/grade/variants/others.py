"""Answers to numbers that are not the student's own: a neighbour's, or those of another seed."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterable
from typing import TYPE_CHECKING

from icsolve.grade.keys import Key
from icsolve.grade.tolerance import NoKeyError
from icsolve.grade.variants.varied import Varied
from icsolve.grade.written import figures

if TYPE_CHECKING:
    from icsolve.grade.case_store import CaseStore
    from icsolve.grade.marking import GivenValue

_FIGURES = 3
"""Written figures from which an answer can be told from a neighbour's."""
_CHANCE = 0.05
"""Part of the range of a class's answers that they may cover, so that hitting one is no accident."""
_FEW = 500
"""Figures that are solved to know the answers of others; more would take too long."""
_ANSWERS = 3
"""Answers by which a wrong seed is told."""


class Neighbours:
    """The right answers of a whole class to a question with variables."""

    def __init__(self, case_store: CaseStore, students: Iterable[str]) -> None:
        self._store = case_store
        self._students = tuple(students)
        self._known: dict[str, tuple[list[float], list[str]]] = {}

    def variant(self, question: str, value: float, digits: str) -> str:
        """The label of the only variant whose right answer is ``value`` to the figures that were written; ''
        where there is none, or hitting one would be no wonder."""
        if figures(digits)[1] < _FIGURES:
            return ""
        if question not in self._known:
            self._known[question] = self._answers(question)
        values, labels = self._known[question]
        mantissa = digits.lower().partition("e")[0]
        unit = 0.5 * 10.0 ** -len(mantissa.partition(".")[2])
        reach = 1.02 * unit / abs(float(mantissa)) * abs(value)
        if not values or 2.0 * reach * len(values) > _CHANCE * (values[-1] - values[0]):
            return ""
        first, last = bisect_left(values, value - reach), bisect_right(values, value + reach)
        found = set(labels[first:last])
        return found.pop() if len(found) == 1 else ""

    def _answers(self, question: str) -> tuple[list[float], list[str]]:
        """The right answers in order, each with its label; none where they would all have to be solved."""
        varied = self._store.variation(question.partition(":")[0])
        found: dict[str, float] = {}
        figures: set[tuple[str, ...]] = set()
        for student in self._students if varied is not None else ():
            assert varied is not None
            try:
                draw = varied.draw(student)
                figure = varied.figure(draw)
                if draw.label in found or (figure not in figures and len(figures) >= _FEW):
                    continue
                figures.add(figure)
                key = varied.key(question, student)
            except NoKeyError:
                continue
            if isinstance(key, Key):
                found[draw.label] = key.value
        ordered = sorted((value, label) for label, value in found.items())
        return [value for value, _ in ordered], [label for _, label in ordered]


def other_seed(varied: Varied, given: list[GivenValue], seeds: Iterable[str]) -> str | None:
    """The seed by which most answers are right, where by the present one most are wrong; None for none."""
    if len(given) < _ANSWERS or 2 * sum(one.right for one in given) >= len(given):
        return None
    for seed in seeds:
        if seed == varied.course.seed:
            continue
        other = Varied(varied.name, varied.text, varied.path, varied.course._replace(seed=seed))
        if 2 * sum(_is_right(other, one) for one in given) > len(given):
            return seed
    return None


def _is_right(varied: Varied, one: GivenValue) -> bool:
    try:
        key = varied.key(one.question, one.student)
    except NoKeyError:
        return False
    return isinstance(key, Key) and abs(one.value - key.value) <= key.half
