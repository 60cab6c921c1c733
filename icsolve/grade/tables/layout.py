"""What the columns of a table are, and its rows as submissions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from icsolve.grade.tables.text import Row


class Submission(NamedTuple):
    """One answer of one student to one question, as text.

    ``student`` has the ids by which the student may be known, best first. ``trouble`` says why a row
    can't be graded; '' where it can.
    """

    line: int
    student: tuple[str, ...]
    question: str
    answer: str
    unit: str = ""
    direction: str = ""
    attempt: str = ""
    variant: str = ""
    time: str = ""
    trouble: str = ""


class Layout(NamedTuple):
    """How a table is read: the ``kind`` that its header shows, and what each row gives.

    ``questions`` are those that have a column of their own (none in a long table).
    """

    kind: str
    read: Callable[[Row], Sequence[Submission]]
    questions: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    cells_of: Callable[[list[str]], tuple[str, ...]] | None = None
    """Of a long table: student, question, answer, unit, direction, attempt, variant and time of a full row to
    which an empty cell was added."""


class HeaderError(ValueError):
    """A header that can't be used; the message says what to do."""


def identifier(text: str) -> str:
    """An id as text: without spaces around it, and without what a spreadsheet puts about it (``="007"``)."""
    if text.isalnum():
        return text
    text = text.strip()
    if text.startswith('="') and text.endswith('"'):
        text = text[2:-1]
    return text.lstrip("'").strip() if text[:1] == "'" else text
