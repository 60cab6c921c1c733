"""What single students hand in: a table or a text, or Gradescope's export with a folder for each."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator

from icsolve.files import is_plain, reading_text
from icsolve.grade.tables.columns import Submission, TableColumns, identifier
from icsolve.grade.tables.platforms import fields_of, padded
from icsolve.grade.tables.text import AnswerTable
from icsolve.read.document import Mapping, Node, Scalar, Sequence, parse
from icsolve.read.names import Problems, Stop

_LINE = re.compile(r"\s*(?:[-*] )?([^=\s][^=]*?)(?:\s*=\s*|:(?:\s+|$))(\S.*?)?\s*$")


def submissions(table: AnswerTable, columns: TableColumns, student: str) -> Iterator[Submission]:
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
        if text.strip(" ,;\t|") and not text.lstrip().startswith("#"):
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
    with reading_text(metadata, encoding="utf-8") as file:
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


METADATA = "submission_metadata.yml"
_ANSWERS = (".csv", ".tsv", ".txt")


def exported(folder: str) -> Iterator[tuple[str, str]]:
    """The files of answers in an export, each with its student (the SID, else the email).

    Of a student without such a file the folder is given.

    Raises ValueError, with a sentence, where the metadata can't be read; OSError.
    """
    with reading_text(os.path.join(folder, METADATA), encoding="utf-8") as file:
        text = file.read()
    problems = Problems(METADATA)
    try:
        root = parse(text, problems)
    except Stop:
        root = None
    if type(root) is not Mapping:
        raise ValueError(
            f"{METADATA} can't be read: {problems.found[0] if problems.found else 'it is empty'}"
        )
    for name, about in sorted(root.items.items()):
        path = os.path.join(folder, name)
        names = sorted(os.listdir(path)) if os.path.isdir(path) else []
        inside = (os.path.join(path, n) for n in names if n.lower().endswith(_ANSWERS))
        files = [at for at in inside if is_plain(at)]
        for at in files:
            yield at, _student(about) or name
        if not files:
            yield path, _student(about) or name


def _student(about: Node) -> str:
    """Of ``:submitters: [{:name, :sid, :email}]``; Ruby's symbols start with a colon."""
    submitters = _item(about, "submitters")
    first = submitters.items[0] if type(submitters) is Sequence and submitters.items else None
    for key in ("sid", "email", "name"):
        value = _item(first, key)
        if type(value) is Scalar and value.text:
            return value.text
    return ""


def _item(node: Node | None, key: str) -> Node | None:
    if type(node) is not Mapping:
        return None
    return node.items.get(f":{key}") or node.items.get(key)
