"""The canonical results: ``results.csv`` and JSON Lines."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Any

from icsolve.grade.marked import Marked, Result

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
        score = "0" if not judged.share else _score(judged.share * marked.points)
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
        "score": judged.share * marked.points,
        "max_score": marked.points,
        "rel_error": judged.off,
        "code": judged.code,
        "mistakes": [{"code": m.code, "where": m.where} for m in judged.mistakes],
        "feedback": marked.text,
    }


def json_line(result: Result) -> str:
    """The object on one line."""
    import json

    return json.dumps(record(result), allow_nan=False, ensure_ascii=False) + "\n"
