"""The canonical results, ``results.csv`` and JSON Lines: written, read back for every other form, compared
with earlier ones; marks given by hand, and the queue of what waits for a person.
"""

from __future__ import annotations

import csv
import io
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import groupby
from typing import Any

from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Roster, student_named
from icsolve.grade.judge import OPEN, Judgement, Read
from icsolve.grade.tables.columns import read_table, without_apostrophe
from icsolve.grade.written.answer import WrittenAnswer
from icsolve.tuples import NamedTuple
from icsolve.wording import plural


class Marked:
    """An answer judged: the same for every student who writes the same to the same question.

    ``read`` is how it was read, None where it was not; ``text`` what the student is told; ``count`` how often
    it was given.
    """

    __slots__ = ("count", "item", "judged", "points", "raw", "read", "tail", "text")

    def __init__(
        self, item: str, raw: str, judged: Judgement, points: float, text: str, read: Read | None = None
    ) -> None:
        self.item = item
        self.raw = raw
        self.judged = judged
        self.points = points
        self.text = text
        self.read = read
        self.tail = ""
        self.count = 0

    @property
    def score(self) -> float | None:
        """The mark; None while a person has still to judge it: then it is in no mean either."""
        return None if self.judged.verdict in OPEN else self.judged.share * self.points

    @property
    def value(self) -> float | None:
        """The number as written."""
        return self.read.number if isinstance(self.read, WrittenAnswer) else None

    @property
    def unit(self) -> str:
        """The unit as written, in plain spelling."""
        return self.read.unit.name if self.read is not None and self.read.unit is not None else ""

    @property
    def direction(self) -> str:
        """The direction in words, in plain spelling."""
        way = self.read.direction if isinstance(self.read, WrittenAnswer) else None
        return way.words if way is not None else ""


class Result(NamedTuple):
    """One line of the results."""

    student: str
    item: str
    variant: str
    attempt: str
    line: int
    marked: Marked


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


def tail(marked: Marked) -> str:
    """From the raw answer to the feedback, with the line's end."""
    judged = marked.judged
    off = "" if judged.off is None else f"{judged.off:.3g}"
    score = "" if marked.score is None else shown(marked.score)
    read = f"{number(marked.value)},{_cached(marked.unit)},{_cached(marked.direction)}"
    marks = f"{judged.verdict},{score},{shown(marked.points)},{off},{judged.code}"
    marked.tail = f"{cell(marked.raw)},{read},{marks},{_cached(marked.text)}\n"
    return marked.tail


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
    parts = dict(zip(("number", "unit", "direction"), judged.parts, strict=True))
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
        "parts": parts if judged.verdict in ("right", "wrong") else None,
        "score": marked.score,
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
_OF_NONE = tuple(f"Not graded: {why}" for why in ("there is no case", "this row names no case"))
"""How the feedback of a row begins that names no question."""


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


HEADER = ",".join(ResultRow._fields)


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
    return cell[1:] if cell[:1] == "'" and cell[1:2] in _RISKY else cell


def by_student(path: str, graded: bool = True) -> Iterator[tuple[str, list[ResultRow]]]:
    """Each student's lines together; with ``graded`` without those that are of no question."""
    for student, rows in groupby(read_results(path), key=lambda row: row.student_id):
        own = list(rows)
        if graded:
            own = [row for row in own if row.code != NOT_GRADED or not row.feedback.startswith(_OF_NONE)]
        yield student, own


class StudentMarks(NamedTuple):
    """Of one student's answers: the marks of those that were judged, the most that these could earn, how many
    were judged, and how many wait for a person."""

    score: float
    most: float
    judged: int
    waiting: int


def marks_of(rows: Sequence[ResultRow]) -> StudentMarks:
    """The marks of one student's lines."""
    judged = [row for row in rows if row.score is not None]
    score, most = sum(row.score or 0.0 for row in judged), sum(row.max_score for row in judged)
    return StudentMarks(score, most, len(judged), len(rows) - len(judged))


@lru_cache(maxsize=4096)
def shown(number: float) -> str:
    """A mark without needless digits."""
    return f"{number:.10g}"


REVIEW_HEADER = (
    "case", "variant", "answer", "verdict", "code", "count", "student_id", "score", "max_score", "comment",
)  # fmt: skip
CHANGES_HEADER = (
    "student_id", "case", "old_verdict", "new_verdict", "old_score", "new_score", "why", "old_answer",
    "new_answer",
)  # fmt: skip
_LISTED = 40
"""Changes that the summary lists."""


class Override(NamedTuple):
    """A mark given by hand, with what the student is told, and the line of its file."""

    score: float
    comment: str
    line: int


Overrides = Mapping[tuple[str, str], Override]
"""By student and question."""


def read_overrides(path: str, store: CaseStore, roster: Roster | None) -> dict[tuple[str, str], Override]:
    """The marks of a file: ``student_id,case,score,comment``, or a review queue that was filled.

    Several ids in one cell are divided by semicolons; a row without a score decides nothing.

    Raises ValueError, with the file's name and line, for a row that can't be used; OSError.
    """
    found: dict[tuple[str, str], Override] = {}
    columns, rows = read_table(path, lambda line, why: None)
    if not columns.has("student_id", "case", "score"):
        raise ValueError(f"{path}: it needs the columns student_id,case,score; it has {columns.listed()}")
    at = [columns.names.index(name) for name in ("student_id", "case", "score")]
    comment_at = columns.names.index("comment") if columns.has("comment") else None
    for row in rows:
        where = f"{path}:{row.line}"
        if row.trouble or len(row.cells) < len(columns.header):
            raise ValueError(f"{where}: {row.trouble or 'this row is cut short'}")
        students, case, score = (row.cells[i].strip() for i in at)
        if not score:
            continue
        question = store.find(case)
        if question is None:
            raise ValueError(f"{where}: {store.no_case(case)}")
        question = store.canonical(question)
        points = store.course.policy_of(question).points
        said = without_apostrophe(row.cells[comment_at]) if comment_at is not None else ""
        override = Override(_givenshown(score, points, where), said, row.line)
        for text in students.split(";"):
            student = student_named(text, roster)
            before = found.get((student, question))
            if before is not None and before.score != override.score:
                other = f"{student} has another score for {question} in line {before.line}"
                raise ValueError(f"{where}: {other}")
            found[student, question] = override
    return found


def _givenshown(text: str, points: float, where: str) -> float:
    """``2.5``, ``2,5`` or ``50%`` of the points."""
    try:
        share = text.endswith("%")
        value = float(text.rstrip("% ").replace(",", ".")) * (points / 100.0 if share else 1.0)
    except ValueError:
        value = -1.0
    if not 0.0 <= value <= points:
        wanted = f"should be a number from 0 to {points:g}, or a percentage"
        raise ValueError(f"{where}: the score {text!r} {wanted}")
    return value


# --- the queue --------------------------------------------------------------------------------------


def review_queue(results: str) -> str:
    """The answers that wait for a person, each text of a question once, the commonest first; to be filled in
    and handed back as overrides."""
    groups: dict[tuple[str, str, str], list[ResultRow]] = {}
    for row in read_results(results):
        if row.score is None and row.student_id:
            groups.setdefault((row.case, row.variant, " ".join(row.raw_answer.split())), []).append(row)
    lines = []
    for (case, variant, answer), rows in sorted(groups.items(), key=lambda item: (-len(item[1]), item[0])):
        first = rows[0]
        students = ";".join(row.student_id for row in rows)
        cells = (case, variant, safe(answer), first.verdict, first.code, str(len(rows)), safe(students))
        lines.append((*cells, "", shown(first.max_score), ""))
    return csv_text(REVIEW_HEADER, lines)


# --- against earlier results ------------------------------------------------------------------------


class Change(NamedTuple):
    """A mark that is another one now; None where there was, or is, no such row."""

    student: str
    case: str
    before: ResultRow | None
    now: ResultRow | None
    why: str

    @property
    def moves(self) -> str:
        """From what to what."""
        return f"{_said(self.before)} -> {_said(self.now)}"

    @property
    def by(self) -> float:
        """How much more it is; one that is not given counts as 0."""
        before, now = (row.score or 0.0 if row is not None else 0.0 for row in (self.before, self.now))
        return now - before


def compared(old: str, new: str) -> Iterator[Change]:
    """The marks that differ between two files of results, in the order of the new one.

    Raises ValueError where the old one is no such file.
    """
    before = {(row.student_id, row.case): row for row in _old(old)}
    for row in read_results(new):
        was = before.pop((row.student_id, row.case), None)
        if was is None:
            yield Change(row.student_id, row.case, None, row, "a new row")
        elif (was.score, was.max_score) != (row.score, row.max_score):
            yield Change(row.student_id, row.case, was, row, _why(was, row))
    for was in before.values():
        yield Change(was.student_id, was.case, was, None, "the row is gone")


def _old(path: str) -> Iterator[ResultRow]:
    try:
        yield from read_results(path)
    except (ValueError, IndexError, TypeError, StopIteration, RuntimeError):
        raise ValueError(f"{path} is no file of results: icsolve grade writes one with -o") from None


def _why(was: ResultRow, row: ResultRow) -> str:
    """Why a mark is another one: what differs between the rows, the plainest first."""
    if OVERRIDE in row.code.split():
        return f"marked by hand{row.feedback.removeprefix('Marked by hand')}".rstrip(".")
    if OVERRIDE in was.code.split():
        return "no longer marked by hand"
    if was.raw_answer != row.raw_answer:
        return "another answer counts"
    if was.variant != row.variant:
        return "other numbers were given out"
    if (was.code == NOT_GRADED) != (row.code == NOT_GRADED):
        return "it can't be graded now" if row.code == NOT_GRADED else "it could not be graded before"
    waits = (was.score is None) != (row.score is None)
    turned = was.verdict != row.verdict and _OF_DIRECTION & {*was.code.split(), *row.code.split()}
    if (was.value, was.unit, was.direction) != (row.value, row.unit, row.direction) or (waits and not turned):
        return "the answer is read otherwise"
    if was.rel_error != row.rel_error and not waits:
        return "the key has changed"
    if turned:
        return "the direction of the right answer, or how directions count, has changed"
    if was.verdict != row.verdict:
        return "the tolerance, or what is asked for, has changed"
    if was.max_score != row.max_score:
        return "the points have changed"
    return "the credit, the tolerance, or the direction of the right answer, has changed"


_OF_DIRECTION = {"sign", "direction", "no-direction", "square-direction", "undirected", "size-alone"}
"""Codes of answers whose number is right."""


def _said(row: ResultRow | None) -> str:
    if row is None:
        return "nothing"
    said = f"{row.verdict} ({row.code})" if row.code and row.code != row.verdict else row.verdict
    return f"{shown(row.score)} {said}" if row.score is not None else said


def changes_csv(changes: Iterable[Change]) -> str:
    """The changes as a table."""
    lines = []
    for one in changes:
        cells = []
        for row in (one.before, one.now):
            score = shown(row.score) if row is not None and row.score is not None else ""
            cells.append((row.verdict, score, safe(row.raw_answer)) if row is not None else ("", "", ""))
        verdicts, scores, answers = zip(*cells, strict=True)
        lines.append((safe(one.student), one.case, *verdicts, *scores, one.why, *answers))
    return csv_text(CHANGES_HEADER, lines)


def changes_text(changes: list[Change], old: str) -> str:
    """The changes for a terminal: how many, why, and whose."""
    up, down = sum(one.by > 0.0 for one in changes), sum(one.by < 0.0 for one in changes)
    head = f"against {old}: {plural(len(changes), 'mark')} changed"
    if not changes:
        return f"against {old}: no mark changed"
    lines = [f"{head}, {up} up, {down} down"]
    lines += [f"  {n} times: {why}" for why, n in Counter(one.why for one in changes).most_common()]
    lines += [f"  {one.student} {one.case}: {one.moves}: {one.why}" for one in changes[:_LISTED]]
    more = len(changes) - _LISTED
    return "\n".join([*lines, *([f"  and {more} more; --changes FILE lists all"] if more > 0 else [])])
