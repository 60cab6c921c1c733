"""PrairieLearn: the external grader's ``results.json``, scores by CSV, and an example of a question."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from typing import Any

from icsolve.grade.out.rows import Row

_LARGEST = 1_000_000


def results(rows: Iterable[Row]) -> dict[str, Any]:
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


def scores(students: Iterable[tuple[str, list[Row]]]) -> str:
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
