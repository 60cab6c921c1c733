"""The class summary as text: marks a question, the mistakes by code, a histogram of the answers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from icsolve.grade.run import Graded
from icsolve.grade.tally import BINS, Counts

_WIDTH = 40
_MANY = 3
"""Answers from which it is told that most could not be read."""
_SHOWN = 6
"""Mistakes of one question that are shown."""


def summary(graded: Graded) -> str:
    """The summary of a class, for a terminal."""
    lines = [f"{_count(graded.rows, 'answer')} from {_count(graded.students, 'student')}"]
    lines += [told for item, counts in graded.counts.items() if (told := mostly_unread(item, counts))]
    for item, counts in graded.counts.items():
        lines += ["", *_question(item, counts)]
    return "\n".join([*lines, *_missing(graded)])


def mostly_unread(item: str, counts: Counts) -> str:
    """That most answers to a question could not be judged, with the commonest; '' where it is not so."""
    given = sum(counts.verdicts.values()) - counts.verdicts["missing"]
    waiting = counts.verdicts["invalid"] + counts.verdicts["review"]
    if waiting < _MANY or 2 * waiting <= given:
        return ""
    said = ", ".join(f"'{text}' ({n} times)" for text, n in counts.texts.most_common(3))
    return f"{item}: {waiting} of {given} answers could not be read or judged: {said}. Is the column right?"


def _count(number: int, what: str) -> str:
    return f"{number:,} {what}{'' if number == 1 else 's'}".replace(",", " ")


def _question(item: str, counts: Counts) -> Iterator[str]:
    verdicts = ", ".join(f"{n} {verdict}" for verdict, n in ordered_verdicts(counts))
    mark = f"mean {counts.score / counts.max_score:.0%}" if counts.max_score else ""
    yield f"{item}: {verdicts}" + (f"; {mark}" if mark else "")
    wrong = counts.verdicts["wrong"]
    named = [(code, n) for code, n in by_count(counts.mistakes) if code]
    for code, n in named[:_SHOWN]:
        yield f"  {n} of {wrong} wrong answers: {code}"
    if len(named) > _SHOWN:
        yield f"  {sum(n for _, n in named[_SHOWN:])} of {wrong} wrong answers: other causes"
    if counts.mistakes[""]:
        yield f"  {counts.mistakes['']} of {wrong} wrong answers: no known cause"
    common = [(value, n) for value, n in counts.unexplained.most_common(3) if n > 1]
    if common:
        yield "  the commonest of them: " + ", ".join(f"{value} ({n} times)" for value, n in common)
    if counts.unread:
        yield "  not judged: " + ", ".join(f"{n} {code}" for code, n in counts.unread.most_common(_SHOWN))
    yield from histogram(counts)


def by_count(mistakes: Counter[str]) -> list[tuple[str, int]]:
    """Mistakes by how often they were made; those of no known cause last."""
    return sorted(mistakes.items(), key=lambda item: (not item[0], -item[1], item[0]))


def ordered_verdicts(counts: Counts) -> list[tuple[str, int]]:
    """The verdicts that occur, in the order right, wrong, invalid, review, missing."""
    return [
        (v, counts.verdicts[v])
        for v in ("right", "wrong", "invalid", "review", "missing")
        if counts.verdicts[v]
    ]


def histogram(counts: Counts) -> Iterator[str]:
    """One line of blocks: answers over the right one from -2 to 2, the right one marked below."""
    if not counts.bins:
        return
    bars = "▁▂▃▄▅▆▇█"
    most = max(counts.bins.values())
    cells = [counts.bins.get(k, 0) for k in range(-BINS - 1, BINS + 2)]
    drawn = "".join(" " if not n else bars[max(0, -(-n * len(bars) // most) - 1)] for n in cells)
    place = BINS + 1 + BINS // 2
    yield f"  |{drawn}|"
    yield "   " + " " * place + "^ right; left and right of it -2 to 2 times, and beyond"


def _missing(graded: Graded) -> Iterator[str]:
    """Who gave no answer."""
    for item, students in graded.owing.items():
        count = graded.counts[item].verdicts["missing"] if item in graded.counts else len(students)
        more = f" and {count - len(students)} more" if count > len(students) else ""
        yield f"no answer to {item}: {', '.join(students)}{more}"
