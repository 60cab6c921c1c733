"""What automatic graders read: Gradescope's and PrairieLearn's ``results.json``, scores by CSV, JUnit XML."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from html import escape
from typing import Any

from icsolve.grade.results import Row

_LARGEST = 1_000_000


def prairielearn_results(rows: Iterable[Row]) -> dict[str, Any]:
    """The object of ``/grade/results/results.json`` for one student; unreadable answers cost no attempt."""
    rows = list(rows)
    most = sum(row.max_score for row in rows)
    unread = [row for row in rows if row.verdict == "invalid"]
    entry: dict[str, Any] = {
        "gradable": not unread,
        "score": sum(row.score for row in rows) / most if most else 0.0,
        "message": f"{sum(row.verdict == 'right' for row in rows)} of {len(rows)} answers are right.",
        "tests": [_test(row) for row in rows],
    }
    if unread:
        entry["format_errors"] = [f"{row.case}: {row.feedback}" for row in unread]
    return entry


def _test(row: Row) -> dict[str, Any]:
    return {
        "name": row.case,
        "description": f"Your answer: {row.raw_answer[:200]}" if row.raw_answer else "No answer",
        "points": row.score,
        "max_points": row.max_score,
        "message": row.feedback,
        "output": row.code,
    }


def prairielearn_scores(students: Iterable[tuple[str, list[Row]]]) -> str:
    """``uid,instance,qid,score_perc,feedback``, to be uploaded as manual grades."""
    out = io.StringIO()
    table = csv.writer(out, lineterminator="\n")
    table.writerow(("uid", "instance", "qid", "score_perc", "feedback"))
    for student, rows in students:
        for row in rows:
            if student:
                percent = 100.0 * row.score / row.max_score if row.max_score else 0.0
                table.writerow((student, "1", row.case, f"{percent:.6g}", row.feedback))
    return out.getvalue()


_WRONG, _UNREAD, _OPEN = ("wrong",), ("invalid",), ("review", "missing")


def junit_report(rows: Iterable[Row]) -> str:
    """The report of all results."""
    suites: dict[str, list[Row]] = {}
    for row in rows:
        suites.setdefault(row.case, []).append(row)
    body = "".join(_suite(case, own) for case, own in sorted(suites.items()))
    counts = _counts([row for own in suites.values() for row in own])
    head = '<?xml version="1.0" encoding="UTF-8"?>'
    return f'{head}\n<testsuites name="icsolve grade" {counts}>\n{body}</testsuites>\n'


def _counts(rows: list[Row]) -> str:
    def count(verdicts: tuple[str, ...]) -> int:
        return sum(row.verdict in verdicts for row in rows)

    bad = f'failures="{count(_WRONG)}" errors="{count(_UNREAD)}" skipped="{count(_OPEN)}"'
    return f'tests="{len(rows)}" {bad} time="0"'


def _suite(case: str, rows: list[Row]) -> str:
    tests = "".join(_testcase(row) for row in rows)
    return f"<testsuite name={_attribute(case)} {_counts(rows)}>\n{tests}</testsuite>\n"


def _testcase(row: Row) -> str:
    head = (
        f'<testcase classname={_attribute(row.case)} name={_attribute(row.student_id or "(no id)")} time="0"'
    )
    if row.verdict == "right":
        return f"{head}/>\n"
    said = f"message={_attribute(row.code or row.verdict)}"
    if row.verdict in _OPEN:
        return f"{head}><skipped {said}/></testcase>\n"
    tag = "failure" if row.verdict in _WRONG else "error"
    return f"{head}><{tag} {said} type={_attribute(row.verdict)}>{_text(row.feedback)}</{tag}></testcase>\n"


def _attribute(text: str) -> str:
    return f'"{escape(_printable(text))}"'


def _text(text: str) -> str:
    return escape(_printable(text), quote=False)


def _printable(text: str) -> str:
    """Without the characters that XML has no place for."""
    return "".join(c if c in "\t\n\r" or (c >= " " and c not in "\ufffe\uffff") else "?" for c in text)
