"""The canonical results: ``results.csv`` and JSON Lines."""

from __future__ import annotations

import json
import re
from typing import Any

from icsolve.grade.marking import Marked, Result

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


def cell(text: str) -> str:
    """A cell of a CSV line: safe, and quoted where it must be."""
    text = safe(text)
    if text.isalnum() or not (any(c in text for c in ',"\r\n') or text != text.strip(" ")):
        return text
    return '"' + text.replace('"', '""') + '"'


def number(value: float | None) -> str:
    """The shortest text that gives the number again; '' for none."""
    if value is None:
        return ""
    return repr(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)


def tail(marked: Marked) -> str:
    """From the raw answer to the feedback, with the line's end."""
    if not marked.tail:
        judged = marked.judged
        off = "" if judged.off is None else f"{judged.off:.3g}"
        cells = (
            cell(marked.raw),
            number(marked.value),
            cell(marked.unit),
            cell(marked.direction),
            judged.verdict,
            f"{judged.share * marked.points:.10g}",
            f"{marked.points:.10g}",
            off,
            judged.code,
            cell(marked.text),
        )
        marked.tail = ",".join(cells) + "\n"
    return marked.tail


def line(result: Result) -> str:
    """One line of ``results.csv``."""
    first = f"{cell(result.student)},{cell(result.item)},{cell(result.variant)},{cell(result.attempt)},"
    return first + tail(result.marked)


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
        "score": judged.share * marked.points,
        "max_score": marked.points,
        "rel_error": judged.off,
        "code": judged.code,
        "mistakes": [{"code": m.code, "where": m.where} for m in judged.mistakes],
        "feedback": marked.text,
    }


def json_line(result: Result) -> str:
    """The object on one line."""
    return json.dumps(record(result), allow_nan=False, ensure_ascii=False) + "\n"
