"""Tables of learning platforms, recognised by their headers, and what single students hand in: a table or a
text, or Gradescope's export with a folder for each.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from operator import itemgetter

from icsolve.files import is_plain, reading_text
from icsolve.grade.tables.columns import (
    ABOUT_STUDENTS,
    FIELDS,
    HeaderError,
    StoredAnswer,
    Submission,
    TableColumns,
    TableLayout,
    candidates,
    identifier,
    is_aside,
)
from icsolve.grade.tables.text import AnswerTable, TableRow
from icsolve.read.document import Mapping, Node, Scalar, parse
from icsolve.read.document import Sequence as Items
from icsolve.read.names import Problems, Stop

_RESPONSE = re.compile(r"(?:response|antwort|réponse|respuesta|risposta|resposta|antwoord) \d+$")
_META = re.compile(
    r"(?:name|id|#|sis_id|section_id|section_sis_id|n correct|n incorrect|score|total"
    r"|total score|total points|max points|quiz feedback|submission id|view count"
    r"|lateness \(h:m:s\)|submission count|user id|sis user id|root account|integration id"
    r"|time spent.*|section_name|section #|(?:question|right answer|frage|richtige antwort|réponse correcte"
    r"|respuesta correcta|risposta corretta|resposta correta|juiste antwoord|question id|possible points"
    r"|auto score|manual score|domanda|pregunta|questão|vraag) ?\d*"
    r"|current score|final score|unposted .*|current grade|final grade|current points|final points"
    r"|start time|last modified time|startzeit|heure de début|hora de inicio|ora di inizio"
    r"|hora de la última modificación|feedback|comments?"
    r"|email.*|e-mail.*|adresse .*|correo.*|dirección .*|indirizzo .*|posta .*|endereço .*"
    r"|first.?name|last.?name|full.?name|apellido.*"
    r"|student|user|last access|availability|child course id|end-of-line indicator"
    r"|ip.?address|ip|attempt start|out of|difficulty|q (?:#|type|text)|bonus\?|answer match"
    r"|language|sprache|\d+(?:[.,]\d+)?)$"
)
"""Other columns that platforms add and that are no question."""


Asked = tuple[str, str, str]
"""A question, the answer to it, and what is wrong with that."""


def recognise(columns: TableColumns) -> TableLayout:
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


def fields_of(columns: TableColumns) -> Callable[[list[str]], tuple[str, ...]]:
    """Of a row with an empty cell added: student, case, answer, unit, direction, attempt, variant, time."""
    wanted = ("student_id", "case", "answer", "unit", "direction", "attempt", "variant", "submitted_at")
    at = [columns.field(name) for name in wanted]
    if at[0] is None:
        at[0] = columns.field("email")
    for index in at:
        if index is not None:
            columns.check_once(index)
    return itemgetter(*(len(columns.header) if i is None else i for i in at))


def _long(columns: TableColumns, kind: str) -> TableLayout:
    """One answer a row."""
    cells_of, width = fields_of(columns), len(columns.header)

    def read(row: TableRow) -> Sequence[Submission]:
        line, cells, unclosed = row
        trouble = unclosed or _wrong_width(cells, width)
        student, *texts = cells_of(padded(cells, width))
        return (_submission(line, (identifier(student),), texts, trouble),)

    return TableLayout(kind, read, cells_of=cells_of)


def _submission(line: int, who: tuple[str, ...], texts: Sequence[str], trouble: str) -> Submission:
    """Of case, answer, unit, direction, attempt, variant and time."""
    case, *rest = texts
    return who, StoredAnswer._make(("", case, line, *rest, trouble))


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


def _ids(columns: TableColumns, kind: str) -> list[int]:
    """The columns by which a platform's students are known, best first.

    Raises HeaderError where there is none, or two have one name.
    """
    ids = columns.places(*_IDS.get(kind, _ANY_ID))
    if not ids:
        raise HeaderError(
            f'no column holds the student\'s id: {columns.listed()}; name it with --map student_id="..."'
        )
    for index in ids:
        columns.check_once(index)
    return ids


def _wide(columns: TableColumns, kind: str) -> TableLayout:
    """A column a question."""
    ids = _ids(columns, kind)
    asked, strange = _questions(columns, set(ids))
    if not asked:
        if (columns.field("case") is None) != (columns.field("answer") is None):  # a row an answer
            there, other = ("answer", "case") if columns.field("case") is None else ("case", "answer")
            raise HeaderError(
                f"a table with a column '{there}' has a column '{other}' too, an answer a row, and there is "
                f'none: {columns.listed()}; name it with --map {other}="..."'
            )
        raise HeaderError(
            f'no column names a case: {columns.listed()}; name them with --map, such as --map "Q3=press"'
        )
    if kind == "wide":  # a column much like a case is meant for one, and is listed answer by answer
        meant = [i for i in strange if columns.near(columns.header[i])]
        asked |= {i: columns.header[i] for i in meant}
        strange = [i for i in strange if i not in meant]
    cells_of = sorted(asked.items())
    read = _rows(columns, kind, ids, lambda cells: [(what, cells[i], "") for i, what in cells_of])
    notes = tuple(f"the column '{columns.header[i][:60]}' names no case and is passed over" for i in strange)
    return TableLayout(kind, read, tuple(dict.fromkeys(asked.values())), notes)


def _rows(
    columns: TableColumns,
    kind: str,
    ids: list[int],
    answers: Callable[[list[str]], Iterable[Asked]],
    numbers: int | None = None,
) -> Callable[[TableRow], Sequence[Submission]]:
    """Reads a row a student, by the ``answers`` that its cells hold; ``numbers`` is the column of those that
    the student was given."""
    width, skipped = len(columns.header), _SKIPPED.get(kind, _no_row)
    tried, when = (width if (i := columns.field(name)) is None else i for name in ("attempt", "submitted_at"))

    def read(row: TableRow) -> Sequence[Submission]:
        if skipped(row.cells):
            return ()
        trouble = row.trouble or _wrong_width(row.cells, width)
        cells = padded(row.cells, width)
        found = (identifier(cells[i]) for i in ids if cells[i].strip().lower() not in _NOBODY)
        student = tuple(dict.fromkeys(found)) or ("",)
        attempt, time = cells[tried], cells[when]
        variant = cells[numbers] if numbers is not None and cells[numbers][:1] == "{" else ""
        return [
            _submission(row.line, student, (question, answer, "", "", attempt, variant, time), trouble or why)
            for question, answer, why in answers(cells)
        ]

    return read


def _questions(columns: TableColumns, ids: set[int]) -> tuple[dict[int, str], list[int]]:
    """Questions by column, and the columns that seem to be questions but name no case."""
    asked, strange = {}, []
    taken = ids | set(columns.fields.values())
    for index, name in enumerate(columns.names):
        mapped = index in columns.questions
        if (index in taken and not mapped) or (not mapped and name in ("", *FIELDS["attempt"])):
            continue
        exact = columns.find(columns.header[index]) is not None
        about = name.partition("/")[0] in ABOUT_STUDENTS  # ``Grade/10.00``
        meta = not exact and (about or bool(_META.match(name)) or is_aside(name))
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


_NOBODY = ("", "anonymous", "anonym", "anonyme", "anónimo", "anonimo")
"""What stands where a form does not ask who answers."""
_SKIPPED = {"canvas-gradebook": _canvas_row, "canvas-quiz": _canvas_row, "moodle": _moodle_row}
_ANY_ID = ("student_id", "email")
_IDS = {
    "wide": ("student_id", "id", "uid", "user", "email"),
    "prairielearn": ("uid",),
    "gradescope": ("sid", "student_id", "email"),
    "canvas-quiz": ("student_id", "sis_id", "id", "email"),
    "canvas-gradebook": ("sis user id", "sis login id", "integration id", "id"),
    "moodle": ("student_id", "id_number", "email"),
    "google-forms": ("student_id", "email"),
    "microsoft-forms": ("student_id", "email"),
}
"""Columns by which a platform's students are known, best first."""


def _prairielearn(columns: TableColumns, kind: str) -> TableLayout:
    """A question a row; its answers are JSON."""
    qid, answers = (columns.names.index(name) for name in ("qid", "submitted_answer"))

    def answered(cells: list[str]) -> Iterator[Asked]:
        case = cells[qid].strip().rsplit("/", 1)[-1]
        for what, answer, wrong in _json_answers(cells[answers]):
            yield f"{case}:{what}" if what not in ("", "answer", case) else case, answer, wrong

    if "attempt" not in columns.fields and columns.has("submission_id"):
        columns.fields["attempt"] = columns.names.index("submission_id")
    numbers = columns.names.index("params") if columns.has("params") else None
    return TableLayout(kind, _rows(columns, kind, _ids(columns, kind), answered, numbers))


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


def _is_long(columns: TableColumns) -> bool:
    who = any(columns.field(name) is not None for name in _ANY_ID)
    return who and all(columns.field(name) is not None for name in ("case", "answer"))


def _by_text(columns: TableColumns, text: str) -> str:
    """The question that a text in a cell is about; the text itself where it names none."""
    return next((q for c in candidates(text) if (q := columns.find(c)) is not None), text)


def _long_by_text(columns: TableColumns, kind: str) -> TableLayout:
    """One answer a row, whose question stands there in its own words (Blackboard, Brightspace)."""
    plain = _long(columns, kind)

    def read(row: TableRow) -> Sequence[Submission]:
        return [(who, s._replace(item=_by_text(columns, s.item))) for who, s in plain.read(row)]

    return TableLayout(kind, read)


def _blackboard(columns: TableColumns, kind: str) -> TableLayout:
    """A row a student, with the words of each question beside its answer."""
    pairs = [
        (columns.names.index(f"question {name.removeprefix('answer ')}"), index)
        for index, name in enumerate(columns.names)
        if re.fullmatch(r"answer \d+", name) and f"question {name.removeprefix('answer ')}" in columns.names
    ]

    def answered(cells: list[str]) -> Iterator[Asked]:
        for question, answer in pairs:
            if cells[question].strip():
                yield columns.questions.get(answer) or _by_text(columns, cells[question]), cells[answer], ""

    return TableLayout(kind, _rows(columns, kind, _ids(columns, kind), answered))


_STAMPS = ("timestamp", "zeitstempel", "horodateur", "marca temporal", "informazioni cronologiche")
_FORMS = ("start time", "startzeit", "heure de début", "hora de inicio", "ora di inizio")


def _is_wide(columns: TableColumns) -> bool:
    named = any(columns.field(name) is not None for name in ("student_id", "email"))
    return named or columns.names[0] in ("id", "uid")


def _is_gradebook(columns: TableColumns) -> bool:
    """Of Canvas: ids and sections beside names, in one column or two; a long export has SIS ids, not a
    short.
    """
    named = columns.has("student") or columns.has("lastname", "firstname")
    return named and columns.has("id", "section") and columns.names[0] in ("student", "lastname")


_KINDS: tuple[tuple[str, Callable[[TableColumns], bool], Callable[[TableColumns, str], TableLayout]], ...] = (
    ("prairielearn", lambda c: c.has("uid", "qid", "submitted_answer"), _prairielearn),
    ("brightspace", lambda c: c.has("q title", "answer"), _long_by_text),
    ("blackboard", lambda c: c.has("question 1", "answer 1"), _blackboard),
    ("blackboard-long", lambda c: c.has("username", "question", "answer"), _long_by_text),
    ("long", _is_long, _long),
    ("microsoft-forms", lambda c: c.names[0] == "id" and any(name in c.names for name in _FORMS), _wide),
    (
        "canvas-quiz",
        lambda c: c.has("name", "id") and (c.has("sis_id") or c.has("submitted", "score")),
        _wide,
    ),
    ("canvas-gradebook", _is_gradebook, _wide),
    ("gradescope", lambda c: c.has("sid", "email"), _wide),
    ("moodle", lambda c: c.field("email") is not None and c.field("state") is not None, _wide),
    ("google-forms", lambda c: c.names[0] in _STAMPS, _wide),
    ("wide", _is_wide, _wide),
)


_LINE = re.compile(r"\s*(?:[-*] )?([^=\s][^=]*?)(?:\s*=\s*|:(?:\s+|$))(\S.*?)?\s*$")


def submissions(table: AnswerTable, columns: TableColumns, student: str) -> Iterator[Submission]:
    """All answers of a file, as one student's."""
    who = (identifier(student),)
    if columns.field("case") is not None and columns.field("answer") is not None:
        cells_of = fields_of(columns)
        for row in table.rows():
            _, *texts = cells_of(padded(row.cells, len(columns.header)))
            yield _submission(row.line, who, texts, row.trouble)
        return
    first = table.delimiter.join(columns.header)
    if not first.startswith("#"):
        yield _of_line(1, first, who)
    for row in table.rows():
        text = table.delimiter.join(row.cells)
        if text.strip(" ,;\t|") and not text.lstrip().startswith("#"):
            _, found = _of_line(row.line, text, who)
            yield who, found._replace(trouble=row.trouble) if row.trouble else found


def _of_line(line: int, text: str, who: tuple[str, ...]) -> Submission:
    """``press: 29.67 lbf*in ccw``."""
    found = _LINE.match(text)
    if found is None:
        why = "a line is like 'press: 29.67 lbf*in ccw'"
        return who, StoredAnswer("", "", line, text[:200], trouble=why)
    return who, StoredAnswer("", found.group(1).strip(), line, found.group(2) or "")


def students_of(metadata: str) -> tuple[str, ...]:
    """The students of a Gradescope ``submission_metadata.json``, of a group several: the email, or the id, of
    each user.

    Raises ValueError, with a sentence; OSError.
    """
    with reading_text(metadata, encoding="utf-8") as file:
        try:
            found = json.load(file)
        except (ValueError, RecursionError):
            found = None
    users = found.get("users") if isinstance(found, dict) else None
    known = [user for user in users if isinstance(user, dict)] if isinstance(users, list) else []
    ids = ([str(user[key]) for key in ("email", "sid", "id", "name") if user.get(key)] for user in known)
    students = tuple(own[0] for own in ids if own)
    if not students:
        raise ValueError(f"{os.fspath(metadata)} names no user")
    return students


METADATA = "submission_metadata.yml"
_ANSWERS = (".csv", ".tsv", ".txt")


def exported(folder: str) -> Iterator[tuple[str, str]]:
    """The files of answers in an export, each with its student (the SID, else the email), of a group once for
    each of its students.

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
        for student in _students(about) or [name]:
            for at in files or [path]:
                yield at, student


def _students(about: Node) -> list[str]:
    """Of ``:submitters: [{:name, :sid, :email}]``, of a group several; Ruby's symbols start with a colon."""
    submitters = _item(about, "submitters")
    people = submitters.items if type(submitters) is Items else ()
    found = ([_item(person, key) for key in ("sid", "email", "name")] for person in people)
    ids = ([value.text for value in values if type(value) is Scalar and value.text] for values in found)
    return [known[0] for known in ids if known]


def _item(node: Node | None, key: str) -> Node | None:
    if type(node) is not Mapping:
        return None
    return node.items.get(f":{key}") or node.items.get(key)
