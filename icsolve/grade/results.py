"""The canonical results, ``results.csv`` and JSON Lines: written, and read back for every other form."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from itertools import groupby
from typing import Any

from icsolve.grade.judge import OPEN, Judgement
from icsolve.grade.written.answer import WrittenAnswer
from icsolve.grade.written.units import UnitWord
from icsolve.tuples import NamedTuple


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
        written: WrittenAnswer | None = None,
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
    def is_open(self) -> bool:
        """Whether a person has still to judge it: it has no mark, and is in no mean."""
        return self.judged.verdict in OPEN

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


HEADER = (
    "student_id,case,variant,attempt,raw_answer,value,unit,direction,verdict,score,max_score,rel_error,code"
    ",feedback"
)
_RISKY = tuple("=+-@\t\r\n")
_SIGNED = re.compile(r"[-+]\s?[\d.,]+(?:[eE][-+]?\d+)?(?:\s?[A-Za-zµ°%·*/^ -]*)?$")


def safe(text: str) -> str:
    """A cell that no spreadsheet takes for a formula: an apostrophe goes before; signed quantities stay."""
    if text.startswith(_RISKY) and not _SIGNED.match(text):
        return "'" + text
    return text


def csv_text(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table as CSV."""
    out = io.StringIO()
    table = csv.writer(out, lineterminator="\n")
    table.writerow(header)
    table.writerows(rows)
    return out.getvalue()


_PLAIN = re.compile(r"[A-Za-z0-9_.](?:[^,\"\r\n]*[^,\"\r\n ])?\Z|\Z")


def cell(text: str) -> str:
    """A cell of a CSV line: safe, and quoted where it must be."""
    if _PLAIN.match(text):
        return text
    text = safe(text)
    if not any(c in text for c in ',"\r\n') and text == text.strip(" "):
        return text
    return '"' + text.replace('"', '""') + '"'


_cached = lru_cache(maxsize=4096)(cell)
"""Students, questions and feedback come again and again."""


def number(value: float | None) -> str:
    """The shortest text that gives the number again; '' for none."""
    if value is None:
        return ""
    text = repr(value)
    return text[:-2] if text.endswith(".0") else text


@lru_cache(maxsize=1024)
def _score(value: float) -> str:
    return f"{value:.10g}"


def tail(marked: Marked) -> str:
    """From the raw answer to the feedback, with the line's end."""
    if not marked.tail:
        judged = marked.judged
        off = "" if judged.off is None else f"{judged.off:.3g}"
        score = "" if marked.is_open else "0" if not judged.share else _score(judged.share * marked.points)
        read = _read(marked)
        marks = f"{judged.verdict},{score},{_score(marked.points)},{off},{judged.code}"
        marked.tail = f"{cell(marked.raw)},{read},{marks},{_cached(marked.text)}\n"
    return marked.tail


def _read(marked: Marked) -> str:
    """Value, unit and direction as they were read."""
    if marked.written is None:
        return f",{_cached(marked.unit)},"
    value, unit, way, _, _, _ = marked.written
    return f"{number(value)},{_cached(unit.name) if unit else ''},{_cached(way.words) if way else ''}"


def line(result: Result) -> str:
    """One line of ``results.csv``."""
    student, item, variant, attempt, _, marked = result
    if not attempt.isalnum():
        attempt = cell(attempt)
    rest = marked.tail or tail(marked)
    return f"{_cached(student)},{_cached(item)},{variant and cell(variant)},{attempt},{rest}"


def record(result: Result) -> dict[str, Any]:
    """One object of the JSON Lines: as the table, with the parts and every cause that fits."""
    marked = result.marked
    judged = marked.judged
    number_right, unit_right, direction_right = judged.parts
    judged_at_all = judged.verdict in ("right", "wrong")
    return {
        "schema": "icsolve/grade/1",
        "student_id": result.student,
        "case": result.item,
        "variant": result.variant,
        "attempt": result.attempt,
        "line": result.line,
        "raw_answer": marked.raw,
        "value": marked.value,
        "unit": marked.unit,
        "direction": marked.direction,
        "verdict": judged.verdict,
        "parts": {"number": number_right, "unit": unit_right, "direction": direction_right}
        if judged_at_all
        else None,
        "score": None if marked.is_open else judged.share * marked.points,
        "max_score": marked.points,
        "rel_error": judged.off,
        "code": judged.code,
        "together": judged.both,
        "mistakes": [{"code": m.code, "where": m.where} for m in judged.mistakes],
        "feedback": marked.text,
    }


def json_line(result: Result) -> str:
    """The object on one line."""
    import json

    return json.dumps(record(result), allow_nan=False, ensure_ascii=False) + "\n"


NOT_GRADED = "not-graded"
OVERRIDE = "override"
"""The code of a mark given by hand."""
NO_CASE = ("there is no case", "this row names no case")
"""How the reason of a row begins that names no question."""


class ResultRow(NamedTuple):
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
    score: float | None
    """None while a person has to judge it"""
    max_score: float
    rel_error: str
    code: str
    feedback: str


def read_results(path: str) -> Iterator[ResultRow]:
    """The lines of a results file, in its order; the apostrophes against formulas are taken off again."""
    csv.field_size_limit(max(csv.field_size_limit(), 2_000_000))
    with open(path, encoding="utf-8", newline="") as file:
        lines = csv.reader(file)
        next(lines)
        for cells in lines:
            plain = [_unsafe(cell) for cell in cells]
            score = float(plain[9]) if plain[9] else None
            yield ResultRow._make((*plain[:9], score, float(plain[10]), *plain[11:]))


def _unsafe(cell: str) -> str:
    return cell[1:] if cell[:1] == "'" and cell[1:2] in tuple("=+-@\t\r\n") else cell


def by_student(path: str, graded: bool = True) -> Iterator[tuple[str, list[ResultRow]]]:
    """Each student's lines together; with ``graded`` without those that are of no question."""
    for student, rows in groupby(read_results(path), key=lambda row: row.student_id):
        yield student, [row for row in rows if not graded or not _is_strange(row)]


def _is_strange(row: ResultRow) -> bool:
    return row.code == NOT_GRADED and row.feedback.removeprefix("Not graded: ").startswith(NO_CASE)


def shown(number: float) -> str:
    """A mark without needless digits."""
    return f"{number:.10g}"
