"""Regrading: marks given by hand, what changes against earlier results, and the queue for a person."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping

from icsolve.files import reading
from icsolve.grade.case_store import CaseStore
from icsolve.grade.results import OVERRIDE, ResultRow, csv_text, read_results, safe, shown
from icsolve.grade.roster import Roster
from icsolve.grade.tables.columns import TableColumns, identifier
from icsolve.grade.tables.text import AnswerTable
from icsolve.tuples import NamedTuple

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
    with reading(path) as file:
        table = AnswerTable(file, lambda line, why: None)
        columns = TableColumns(table.header, (), lambda text: None)
        if not columns.has("student_id", "case", "score"):
            raise ValueError(f"{path}: it needs the columns student_id,case,score; it has {columns.listed()}")
        at = [columns.names.index(name) for name in ("student_id", "case", "score")]
        comment_at = columns.names.index("comment") if columns.has("comment") else None
        for row in table.rows():
            where = f"{path}:{row.line}"
            if row.trouble or len(row.cells) < len(table.header):
                raise ValueError(f"{where}: {row.trouble or 'this row is cut short'}")
            students, case, score = (row.cells[i].strip() for i in at)
            if not score:
                continue
            question = store.find(case)
            if question is None:
                raise ValueError(f"{where}: there is no case '{case[:60]}'")
            question = store.canonical(question)
            points = store.course.policy_of(question).points
            said = row.cells[comment_at].strip() if comment_at is not None else ""
            override = Override(_score(score, points, where), _plain(said), row.line)
            for text in students.split(";"):
                name = identifier(text)
                student = (roster.match((name,)) if roster is not None else None) or name
                before = found.get((student, question))
                if before is not None and before.score != override.score:
                    other = f"{student} has another score for {question} in line {before.line}"
                    raise ValueError(f"{where}: {other}")
                found[student, question] = override
    return found


def _score(text: str, points: float, where: str) -> float:
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


def _plain(text: str) -> str:
    return text[1:] if text[:1] == "'" else text


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
    by_hand = OVERRIDE in row.code.split()
    if by_hand:
        return f"marked by hand{row.feedback.removeprefix('Marked by hand')}".rstrip(".")
    if OVERRIDE in was.code.split():
        return "no longer marked by hand"
    if was.raw_answer != row.raw_answer:
        return "another answer counts"
    if was.variant != row.variant:
        return "other numbers were given out"
    if (was.value, was.unit, was.direction) != (row.value, row.unit, row.direction) or was.score is None:
        return "the answer is read otherwise"
    if was.rel_error != row.rel_error:
        return "the key has changed"
    if was.verdict != row.verdict:
        return "the tolerance, or what is asked for, has changed"
    return "the points or the credit have changed"


def _said(row: ResultRow | None) -> str:
    if row is None:
        return "nothing"
    said = f"{row.verdict} ({row.code})" if row.code and row.code != row.verdict else row.verdict
    return f"{shown(row.score)} {said}" if row.score is not None else said


def changes_csv(changes: Iterable[Change]) -> str:
    """The changes as a table."""
    lines = []
    for one in changes:
        old_verdict, old_score, old_answer = _fields(one.before)
        verdict, score, answer = _fields(one.now)
        cells = (old_verdict, verdict, old_score, score, one.why, safe(old_answer), safe(answer))
        lines.append((safe(one.student), one.case, *cells))
    return csv_text(CHANGES_HEADER, lines)


def _fields(row: ResultRow | None) -> tuple[str, str, str]:
    if row is None:
        return "", "", ""
    return row.verdict, shown(row.score) if row.score is not None else "", row.raw_answer


def changes_text(changes: list[Change], old: str) -> str:
    """The changes for a terminal: how many, why, and whose."""
    up = sum(1 for one in changes if _marks(one.now) > _marks(one.before))
    down = sum(1 for one in changes if _marks(one.now) < _marks(one.before))
    head = f"against {old}: {len(changes)} mark{'' if len(changes) == 1 else 's'} changed"
    if not changes:
        return f"against {old}: no mark changed"
    lines = [f"{head}, {up} up, {down} down"]
    lines += [f"  {n} times: {why}" for why, n in Counter(one.why for one in changes).most_common()]
    lines += [f"  {one.student} {one.case}: {one.moves}: {one.why}" for one in changes[:_LISTED]]
    more = len(changes) - _LISTED
    return "\n".join([*lines, *([f"  and {more} more; --changes FILE lists all"] if more > 0 else [])])


def _marks(row: ResultRow | None) -> float:
    return row.score or 0.0 if row is not None else 0.0
