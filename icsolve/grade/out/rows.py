"""The canonical results read back: every other form of output is made from them."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from itertools import groupby
from typing import NamedTuple

NOT_GRADED = "not-graded"


class Row(NamedTuple):
    """One line of ``results.csv``."""

    student_id: str
    case: str
    variant: str
    attempt: str
    raw_answer: str
    value: str
    unit: str
    direction: str
    verdict: str
    score: float
    max_score: float
    rel_error: str
    code: str
    feedback: str


def read_results(path: str) -> Iterator[Row]:
    """The lines of a results file, in its order; the apostrophes against formulas are taken off again."""
    csv.field_size_limit(max(csv.field_size_limit(), 2_000_000))
    with open(path, encoding="utf-8", newline="") as file:
        lines = csv.reader(file)
        next(lines)
        for cells in lines:
            plain = [_unsafe(cell) for cell in cells]
            yield Row._make((*plain[:9], float(plain[9]), float(plain[10]), *plain[11:]))


def _unsafe(cell: str) -> str:
    return cell[1:] if cell[:1] == "'" and cell[1:2] in tuple("=+-@\t\r\n") else cell


def by_student(path: str, graded: bool = True) -> Iterator[tuple[str, list[Row]]]:
    """Each student's lines together; with ``graded`` without those that could not be graded."""
    for student, rows in groupby(read_results(path), key=lambda row: row.student_id):
        yield student, [row for row in rows if not graded or row.code != NOT_GRADED]


def shown(number: float) -> str:
    """A mark without needless digits."""
    return f"{number:.10g}"
