"""What one student hands in: a table of cases and answers without ids, or a text with a line a case."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator

from icsolve.grade.tables.columns import Columns
from icsolve.grade.tables.layout import Submission, identifier
from icsolve.grade.tables.platforms import fields_of, padded
from icsolve.grade.tables.text import Table

_LINE = re.compile(r"\s*(?:[-*] )?([^=\s][^=]*?)(?:\s*=\s*|:\s+)(\S.*?)?\s*$")


def submissions(table: Table, columns: Columns, student: str) -> Iterator[Submission]:
    """All answers of a file, as one student's."""
    who = (identifier(student),)
    if columns.field("case") is not None and columns.field("answer") is not None:
        cells_of = fields_of(columns)
        for row in table.rows():
            _, *texts = cells_of(padded(row.cells, len(columns.header)))
            yield Submission._make((row.line, who, *texts, row.trouble))
        return
    first = table.delimiter.join(columns.header)
    if not first.startswith("#"):
        yield _of_line(1, first, who)
    for row in table.rows():
        text = table.delimiter.join(row.cells)
        if text.strip() and not text.lstrip().startswith("#"):
            found = _of_line(row.line, text, who)
            yield found._replace(trouble=row.trouble) if row.trouble else found


def _of_line(line: int, text: str, who: tuple[str, ...]) -> Submission:
    """``press: 29.67 lbf*in ccw``."""
    found = _LINE.match(text)
    if found is None:
        return Submission(line, who, "", text[:200], trouble="a line is like 'press: 29.67 lbf*in ccw'")
    return Submission(line, who, found.group(1).strip(), found.group(2) or "")


def student_of(metadata: str) -> str:
    """The student of a Gradescope ``submission_metadata.json``: the email, or the id, of its first user.

    Raises ValueError, with a sentence; OSError.
    """
    with open(metadata, encoding="utf-8") as file:
        try:
            found = json.load(file)
        except (ValueError, RecursionError):
            found = None
    users = found.get("users") if isinstance(found, dict) else None
    first = users[0] if isinstance(users, list) and users and isinstance(users[0], dict) else {}
    for key in ("email", "sid", "id", "name"):
        if first.get(key):
            return str(first[key])
    raise ValueError(f"{os.fspath(metadata)} names no user")
