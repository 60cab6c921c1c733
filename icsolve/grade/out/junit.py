"""JUnit XML: a suite a question, a test a student; for the pipelines that show such reports."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from icsolve.grade.out.rows import Row

_WRONG, _UNREAD, _OPEN = ("wrong",), ("invalid",), ("review", "missing")


def report(rows: Iterable[Row]) -> str:
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
    tests = "".join(_test(row) for row in rows)
    return f"<testsuite name={_attribute(case)} {_counts(rows)}>\n{tests}</testsuite>\n"


def _test(row: Row) -> str:
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
