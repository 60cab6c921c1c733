"""Results written for a platform: one function a kind, all from the lines of ``results.csv``; among them what
automatic graders read.

An answer that was not judged costs nothing: PrairieLearn takes it back as a format error, Gradescope shows it
as a test of zero points out of zero.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable
from typing import Any

from icsolve.files import check_free, write_whole
from icsolve.grade.course import Person
from icsolve.grade.platforms.gradebooks import (
    Filled,
    canvas_gradebook,
    gradebook_filled,
    moodle_filled,
    moodle_worksheet,
)
from icsolve.grade.results import ResultRow, by_student, csv_text, marks_of, read_results
from icsolve.grade.solved import folder_of
from icsolve.grade.tables.text import encoding_of
from icsolve.grade.variants.record import file_name
from icsolve.tuples import NamedTuple
from icsolve.wording import escaped, plural


class PlatformFile(NamedTuple):
    """What to write: the results, the file to write, who is who, the platform's own file to fill."""

    results: str
    path: str
    people: dict[str, Person]
    template: str
    force: bool
    total: str = ""
    """the one column for all questions together"""


_NAMED = 20
"""Students without a row who are named."""


def write(kind: str, order: PlatformFile) -> str:
    """Write the results as ``kind``; what to tell the user, '' for nothing.

    Raises ValueError for a kind or a template that can't be used, KeptError, OSError.
    """
    try:
        return KINDS[kind](order)
    except (ValueError, IndexError) as error:
        raise ValueError(f"{order.template or order.path}: {error}") from None


def check_kind(kind: str) -> None:
    """Raises ValueError for a kind that there is not."""
    if kind not in KINDS:
        raise ValueError(f"--write {kind}: there is no such kind; it is one of {', '.join(KINDS)}")


def _gradebook(order: PlatformFile) -> str:
    """Canvas, new or the teacher's own; of other platforms the teacher's own."""
    students = by_student(order.results)
    if order.template:
        return _filled(order, gradebook_filled(_content(order.template), students, order.people, order.total))
    return _whole(order, canvas_gradebook(students, order.people, order.total))


def _own_gradebook(order: PlatformFile) -> str:
    if not order.template:
        raise ValueError("fill the platform's own export: name it with --template")
    return _gradebook(order)


def _moodle(order: PlatformFile) -> str:
    students = by_student(order.results)
    if order.template:
        return _filled(order, moodle_filled(_content(order.template), students, order.people))
    return _whole(order, moodle_worksheet(students, order.people))


def _filled(order: PlatformFile, made: Filled) -> str:
    """Write a template that was filled; who has no row in it is named."""
    write_whole(order.path, made.text, order.force)
    left = [student for student, _ in by_student(order.results) if student and student not in made.placed]
    names = ", ".join(left[:_NAMED]) + (f" and {len(left) - _NAMED} more" if len(left) > _NAMED else "")
    missing = f"; it has no row for {names}" if left else ""
    if made.added:
        missing += (
            f"; none of its columns is named {' or '.join(made.added)}, so there are new ones at its end"
        )
    return f"{order.path}: marks of {plural(len(made.placed), 'student')} of {order.template}{missing}"


def _content(path: str) -> str:
    """The text of a template, which may be filled where it lies if it is named as the target too."""
    with open(path, "rb") as file:
        data = file.read()
    encoding = encoding_of(data[:4000])
    return data.decode(encoding, "icsolve-windows" if encoding.startswith("utf-8") else "replace")


def _single(order: PlatformFile, make: Callable[[list[ResultRow]], dict[str, object]]) -> str:
    """One student's file; of several students a folder with a file for each."""
    students = [(student, rows) for student, rows in by_student(order.results, False) if student]
    if len(students) == 1:
        write_whole(order.path, _json(make(students[0][1])), order.force)
        return ""
    folder = order.path.removesuffix(".json")
    for student, _ in students:
        check_free(os.path.join(folder, f"{file_name(student)}.json"), order.force)
    for student, rows in students:
        write_whole(os.path.join(folder, f"{file_name(student)}.json"), _json(make(rows)), order.force)
    return f"{folder}: a file for each of {len(students)} students"


def _json(entry: dict[str, object]) -> str:
    return json.dumps(entry, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _whole(order: PlatformFile, text: str) -> str:
    """One file for all students, of which nothing is to tell."""
    write_whole(order.path, text, order.force)
    return ""


KINDS: dict[str, Callable[[PlatformFile], str]] = {
    "canvas": _gradebook,
    "brightspace": _own_gradebook,
    "blackboard": _own_gradebook,
    "moodle": _moodle,
    "gradescope": lambda order: _single(order, gradescope_results),
    "prairielearn": lambda order: _single(order, prairielearn_results),
    "prairielearn-csv": lambda order: _whole(order, prairielearn_scores(by_student(order.results))),
    "junit": lambda order: _whole(order, junit_report(read_results(order.results))),
}
"""Every kind by its name on the command line."""


_STATUS = {"right": "passed"}


def _told(rows: list[ResultRow]) -> str:
    _, _, judged, waiting = marks_of(rows)
    said = f"{sum(row.verdict == 'right' for row in rows)} of {judged} answers are right."
    return said if not waiting else f"{said} {waiting} not judged yet."


def gradescope_results(rows: Iterable[ResultRow]) -> dict[str, Any]:
    """The object of ``results.json`` for one student's rows."""
    rows = list(rows)
    return {
        "score": sum(row.score or 0.0 for row in rows),
        "output": _told(rows),
        "output_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "tests": [_test(row, number) for number, row in enumerate(rows, 1)],
        "extra_data": {"schema": "icsolve/grade/1"},
    }


def _test(row: ResultRow, number: int) -> dict[str, Any]:
    answer = f"Your answer: {row.raw_answer}\n" if row.raw_answer else ""
    return {
        "score": row.score or 0.0,
        "max_score": row.max_score if row.score is not None else 0.0,
        "status": _STATUS.get(row.verdict, "failed"),
        "name": row.case,
        "name_format": "text",
        "number": str(number),
        "output": f"{answer}{row.feedback}",
        "output_format": "text",
        "tags": [tag for tag in (row.verdict, *row.code.split()) if tag],
        "visibility": "visible",
        "extra_data": {"verdict": row.verdict, "code": row.code, "variant": row.variant},
    }


def prairielearn_results(rows: Iterable[ResultRow]) -> dict[str, Any]:
    """The object of ``/grade/results/results.json`` for one student; what was not judged costs no attempt."""
    rows = list(rows)
    score, most, _, waiting = marks_of(rows)
    entry: dict[str, Any] = {
        "gradable": not waiting,
        "score": score / most if most else 0.0,
        "message": _told(rows),
        "tests": [_points(row) for row in rows if row.score is not None],
    }
    if waiting:
        entry["format_errors"] = [f"{row.case}: {row.feedback}" for row in rows if row.score is None]
    return entry


def _points(row: ResultRow) -> dict[str, Any]:
    return {
        "name": row.case,
        "description": f"Your answer: {row.raw_answer[:200]}" if row.raw_answer else "No answer",
        "points": row.score,
        "max_points": row.max_score,
        "message": row.feedback,
        "output": row.code,
    }


def prairielearn_scores(students: Iterable[tuple[str, list[ResultRow]]]) -> str:
    """``uid,instance,qid,score_perc,feedback``, to be uploaded as manual grades; only what was judged."""
    lines = []
    for student, rows in students:
        for row in rows:
            if student and row.score is not None:
                percent = 100.0 * row.score / row.max_score if row.max_score else 0.0
                lines.append((student, "1", folder_of(row.case), f"{percent:.6g}", row.feedback))
    return csv_text(("uid", "instance", "qid", "score_perc", "feedback"), lines)


# --- JUnit ------------------------------------------------------------------------------------------

_WRONG, _UNREAD, _OPEN = ("wrong",), ("invalid",), ("review", "missing")


def junit_report(rows: Iterable[ResultRow]) -> str:
    """The report of all results: a suite a question, a test a student."""
    suites: dict[str, list[ResultRow]] = {}
    for row in rows:
        suites.setdefault(row.case, []).append(row)
    body = "".join(
        f'<testsuite name="{escaped(case)}" {_counts(own)}>\n{"".join(map(_testcase, own))}</testsuite>\n'
        for case, own in sorted(suites.items())
    )
    counts = _counts([row for own in suites.values() for row in own])
    head = '<?xml version="1.0" encoding="UTF-8"?>'
    return f'{head}\n<testsuites name="icsolve grade" {counts}>\n{body}</testsuites>\n'


def _counts(rows: list[ResultRow]) -> str:
    def count(verdicts: tuple[str, ...]) -> int:
        return sum(row.verdict in verdicts for row in rows)

    bad = f'failures="{count(_WRONG)}" errors="{count(_UNREAD)}" skipped="{count(_OPEN)}"'
    return f'tests="{len(rows)}" {bad} time="0"'


def _testcase(row: ResultRow) -> str:
    head = f'<testcase classname="{escaped(row.case)}" name="{escaped(row.student_id or "(no id)")}" time="0"'
    if row.verdict == "right":
        return f"{head}/>\n"
    said = f'message="{escaped(row.code or row.verdict)}"'
    if row.verdict in _OPEN:
        return f"{head}><skipped {said}/></testcase>\n"
    tag = "failure" if row.verdict in _WRONG else "error"
    kind = f'{tag} {said} type="{escaped(row.verdict)}"'
    return f"{head}><{kind}>{escaped(row.feedback)}</{tag}></testcase>\n"
