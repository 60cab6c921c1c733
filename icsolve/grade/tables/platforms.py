"""Tables of learning platforms, recognised by their headers."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Sequence
from operator import itemgetter

from icsolve.grade.tables.columns import ASIDE, FIELDS, Columns, HeaderError, Layout, Submission, identifier
from icsolve.grade.tables.text import Row

_RESPONSE = re.compile(r"(?:response|antwort|réponse|respuesta|risposta) \d+$")
_MOODLE_STATE = ("state", "status", "started on", "completed", "begonnen am", "beendet", "statut", "estado")
_META = re.compile(
    r"(?:name|id|sis_id|section|section_id|section_sis_id|submitted|attempt|n correct|n incorrect|score|total"
    r"|grade/.*|bewertung/.*|total score|max points|status|submission id|submission time|view count"
    r"|lateness \(h:m:s\)|submission count|user id|sis user id|sis login id|root account|integration id"
    r"|institution|department|id number|id-nummer|state|started|started on|completed|time taken|begonnen am"
    r"|beendet|verbrauchte zeit|section_name|sections|(?:question|right answer|frage) \d+|current score"
    r"|final score|unposted .*|current grade|final grade|current points|final points|timestamp|username"
    r"|feedback|comments?|email.*|e-mail.*|first.?name|last.?name|surname|vorname|nachname|student"
    r"|\d+(?:\.\d+)?)$"
)
"""Columns that platforms add and that are no question."""


def recognise(columns: Columns) -> Layout:
    """The layout of a table.

    Raises HeaderError where no student's id, or no question, can be told from the columns.
    """
    for kind, matches, build in _KINDS:
        if matches(columns):
            return build(columns, kind)
    raise HeaderError(
        f"these columns are of no known platform: {columns.listed()}; name them with --map, such as"
        ' --map student_id="Email Address" --map "Q3=press"'
    )


def fields_of(columns: Columns) -> Callable[[list[str]], tuple[str, ...]]:
    """Of a row with an empty cell added: student, case, answer, unit, direction, attempt, variant, time."""
    wanted = ("student_id", "case", "answer", "unit", "direction", "attempt", "variant", "submitted_at")
    at = [columns.field(name) for name in wanted]
    if at[0] is None:
        at[0] = columns.field("email")
    for index in at:
        if index is not None:
            columns.check_once(index)
    return itemgetter(*(len(columns.header) if i is None else i for i in at))


def _long(columns: Columns, kind: str) -> Layout:
    """One answer a row."""
    cells_of, width = fields_of(columns), len(columns.header)

    def read(row: Row) -> Sequence[Submission]:
        line, cells, unclosed = row
        trouble = unclosed or _wrong_width(cells, width)
        student, *texts = cells_of(padded(cells, width))
        return (Submission._make((line, (identifier(student),), *texts, trouble)),)

    return Layout(kind, read, cells_of=cells_of)


def padded(cells: list[str], width: int) -> list[str]:
    """The first ``width`` cells, empty ones where they are missing, and an empty one more."""
    cells = cells[:width]
    return cells + [""] * (width + 1 - len(cells))


def _wrong_width(cells: Sequence[str], width: int) -> str:
    if len(cells) == width or (len(cells) > width and not any(cell.strip() for cell in cells[width:])):
        return ""
    if len(cells) > width:
        return (
            f"this row has {len(cells)} cells under {width} columns: is a comma within a cell without quotes?"
        )
    return f"this row has {len(cells)} cells under {width} columns: is it cut short?"


def _wide(columns: Columns, kind: str) -> Layout:
    """A column a question."""
    ids = [i for name in _IDS.get(kind, _ANY_ID) if (i := _id_column(columns, name)) is not None]
    if not ids:
        raise HeaderError(
            f'no column holds the student\'s id: {columns.listed()}; name it with --map student_id="..."'
        )
    for index in ids:
        columns.check_once(index)
    asked, strange = _questions(columns, kind, set(ids))
    if not asked:
        raise HeaderError(
            f'no column names a case: {columns.listed()}; name them with --map, such as --map "Q3=press"'
        )
    attempt, time = columns.field("attempt"), columns.field("submitted_at")
    if kind == "wide":  # every column there is a case; one that is none is listed answer by answer
        asked |= {i: columns.header[i] for i in strange}
        strange = []
    read = _wide_reader(ids, dict(sorted(asked.items())), (attempt, time), len(columns.header), kind)
    notes = tuple(f"the column '{columns.header[i][:60]}' names no case and is passed over" for i in strange)
    return Layout(kind, read, tuple(dict.fromkeys(asked.values())), notes)


def _wide_reader(
    ids: list[int], asked: dict[int, str], tried_at: tuple[int | None, int | None], width: int, kind: str
) -> Callable[[Row], Sequence[Submission]]:
    attempt, time = tried_at
    skipped = _SKIPPED.get(kind, _no_row)

    def read(row: Row) -> Sequence[Submission]:
        cells = row.cells
        if skipped(cells):
            return ()
        trouble = row.trouble or _wrong_width(cells, width)
        cells = cells + [""] * (width - len(cells))
        found = (identifier(cells[i]) for i in ids if cells[i].strip())
        student = tuple(dict.fromkeys(found)) or ("",)
        tried = cells[attempt] if attempt is not None else ""
        when = cells[time] if time is not None else ""
        return [
            Submission(row.line, student, question, cells[index], "", "", tried, "", when, trouble)
            for index, question in asked.items()
        ]

    return read


def _id_column(columns: Columns, name: str) -> int | None:
    return columns.field(name) if name in FIELDS else _index(columns, name)


def _index(columns: Columns, name: str) -> int | None:
    return columns.names.index(name) if name in columns.names else None


def _questions(columns: Columns, kind: str, ids: set[int]) -> tuple[dict[int, str], list[int]]:
    """Questions by column, and the columns that seem to be questions but name no case."""
    asked, strange = {}, []
    taken = ids | set(columns.fields.values())
    for index, name in enumerate(columns.names):
        mapped = index in columns.questions
        if (index in taken and not mapped) or (not mapped and name in ("", *FIELDS["attempt"])):
            continue
        meta = bool(_META.match(name)) or name.endswith(ASIDE)
        question = columns.question_of(index) if mapped or not meta else None
        if question is not None:
            asked[index] = question
        elif _RESPONSE.match(name) or not meta:
            strange.append(index)
    return asked, strange


def _no_row(cells: list[str]) -> bool:
    return not any(cell.strip() for cell in cells)


def _canvas_row(cells: list[str]) -> bool:
    """Canvas puts posting policies, points and a test student among the students."""
    first = cells[0].strip()
    return (
        _no_row(cells)
        or first in ("Points Possible", "Student, Test", "Test Student")
        or (not first and any("Manual Posting" in cell for cell in cells))
    )


def _moodle_row(cells: list[str]) -> bool:
    """Moodle adds averages at the end."""
    first = " ".join(cells[:2]).strip().lower()
    return _no_row(cells) or first.startswith(("overall average", "gesamtdurchschnitt", "durchschnitt"))


_SKIPPED = {"canvas-gradebook": _canvas_row, "canvas-quiz": _canvas_row, "moodle": _moodle_row}
_ANY_ID = ("student_id", "email")
_IDS = {
    "wide": ("student_id", "id", "uid", "user", "email"),
    "gradescope": ("sid", "student_id", "email"),
    "canvas-quiz": ("student_id", "sis_id", "id", "email"),
    "canvas-gradebook": ("sis user id", "sis login id", "id"),
    "moodle": ("student_id", "id number", "id-nummer", "email"),
    "google-forms": ("student_id", "email"),
}
"""Columns by which a platform's students are known, best first."""


def _prairielearn(columns: Columns, kind: str) -> Layout:
    """A question a row; its answers are JSON."""
    uid, qid, answers = (columns.names.index(name) for name in ("uid", "qid", "submitted_answer"))
    number = _index(columns, "submission_id")
    width = len(columns.header)

    def read(row: Row) -> Sequence[Submission]:
        cells = row.cells
        trouble = row.trouble or _wrong_width(cells, width)
        cells = cells + [""] * (width - len(cells))
        student = (identifier(cells[uid]),)
        attempt = cells[number] if number is not None else ""
        case = cells[qid].strip().rsplit("/", 1)[-1]
        found = []
        for what, answer, wrong in _json_answers(cells[answers]):
            question = f"{case}:{what}" if what not in ("", "answer", case) else case
            why = trouble or wrong
            found.append(Submission(row.line, student, question, answer, attempt=attempt, trouble=why))
        return found

    return Layout(kind, read)


def _json_answers(text: str) -> Iterator[tuple[str, str, str]]:
    """What is asked, the answer, and what is wrong with the JSON."""
    try:
        found = json.loads(text) if text.strip() else {}
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, dict):
        yield "", text[:200], "the submitted answer is not a JSON object"
        return
    named = {key: value for key, value in found.items() if not key.startswith("_")}
    for key, value in named.items():
        yield key, _json_text(value), ""
    if not named:
        yield "", "", ""


def _json_text(value: object) -> str:
    if isinstance(value, str):
        return value
    return (
        repr(value) if isinstance(value, int | float) and not isinstance(value, bool) else json.dumps(value)
    )


def _is_long(columns: Columns) -> bool:
    who = any(columns.field(name) is not None for name in _ANY_ID)
    return who and all(columns.field(name) is not None for name in ("case", "answer"))


def _is_wide(columns: Columns) -> bool:
    named = columns.fields.keys() & {"student_id", "email"}
    return (
        bool(named)
        or columns.names[0] in (*FIELDS["student_id"], "id", "uid")
        or columns.field("email") is not None
    )


_KINDS: tuple[tuple[str, Callable[[Columns], bool], Callable[[Columns, str], Layout]], ...] = (
    ("prairielearn", lambda c: c.has("uid", "qid", "submitted_answer"), _prairielearn),
    ("long", _is_long, _long),
    ("canvas-quiz", lambda c: c.has("name", "id", "sis_id"), _wide),
    ("canvas-gradebook", lambda c: c.has("student", "id", "section") and "sis login id" in c.names, _wide),
    ("gradescope", lambda c: c.has("sid", "email"), _wide),
    ("moodle", lambda c: c.field("email") is not None and any(s in c.names for s in _MOODLE_STATE), _wide),
    ("google-forms", lambda c: c.names[0] in ("timestamp", "zeitstempel"), _wide),
    ("wide", _is_wide, _wide),
)
