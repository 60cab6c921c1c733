"""Names of columns: what each platform calls them, and which question a column is for; ids, and times as the
platforms write them.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from datetime import UTC, datetime, time, timedelta
from typing import IO

from icsolve.files import reading
from icsolve.grade.tables.text import AnswerTable, Report, TableRow
from icsolve.grade.written.numerals import without_unseen
from icsolve.tuples import NamedTuple


class StoredAnswer(NamedTuple):
    """An answer of one student to the question ``item``, as text; in order as the results are.

    ``trouble`` says why it can't be graded; '' where it can.
    """

    student: str
    item: str
    line: int
    answer: str = ""
    unit: str = ""
    direction: str = ""
    attempt: str = ""
    variant: str = ""
    time: str = ""
    trouble: str = ""


Submission = tuple[tuple[str, ...], StoredAnswer]
"""The ids by which a student may be known, best first, and what was answered to a question as written."""


class TableLayout(NamedTuple):
    """How a table is read: the ``kind`` that its header shows, and what each row gives.

    ``questions`` are those that have a column of their own (none in a long table).
    """

    kind: str
    read: Callable[[TableRow], Sequence[Submission]]
    questions: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    cells_of: Callable[[list[str]], tuple[str, ...]] | None = None
    """Of a long table: student, question, answer, unit, direction, attempt, variant and time of a full row to
    which an empty cell was added."""


class HeaderError(ValueError):
    """A header that can't be used; the message says what to do."""


def identifier(text: str) -> str:
    """An id as text: without spaces around it, signs that are not seen, and what a spreadsheet puts about it
    (``="007"``)."""
    if text.isascii() and text.isalnum():
        return text
    text = without_unseen(text).strip()
    if text.startswith('="') and text.endswith('"'):
        text = text[2:-1]
    return text.lstrip("'#").strip() if text[:1] in ("'", "#") else text


def is_spoilt(name: str) -> bool:
    """Whether a spreadsheet has made an id a rounded number, as ``2.00E+08``: many ids look like that
    then.
    """
    return re.fullmatch(r"\d(?:[.,]\d+)?[eE]\+\d+", name) is not None


FIELDS = {
    name: tuple(texts.split("|"))
    for name, texts in {
        "student_id": "student_id|student id|studentid|student|sid|matriculation number|matrikelnummer"
        "|numéro d'étudiant|número de estudiante|matricola|orgdefinedid|org defined id",
        "case": "case|case_id|case id|question|problem|q title",
        "answer": "answer|response|submitted_answer",
        "unit": "unit|units",
        "direction": "direction|sense",
        "attempt": "attempt|attempt number|attempt #|versuch|tentative|intento|tentativo",
        "variant": "variant",
        "submitted_at": "submitted_at|submitted at|submitted|submission time|timestamp|time|zeitstempel"
        "|horodateur"
        "|marca temporal|informazioni cronologiche|completion time|fertigstellungszeit|heure de fin"
        "|hora de finalización|ora di completamento|attempt end|completed|beendet|terminé|finalizado"
        "|terminato|completato|completo|voltooid",
        "email": "email|email address|e-mail-adresse|e-mail address|e-mail|username|sis login id"
        "|adresse de courriel|adresse e-mail|adresse de messagerie|courriel|dirección de correo"
        "|correo electrónico|dirección de correo electrónico|indirizzo email|indirizzo e-mail"
        "|posta elettronica|endereço de email|endereço de e-mail|e-mailadres|benutzername|user name"
        "|nom d'utilisateur|nombre de usuario|nome utente|nome de usuário|gebruikersnaam",
        "id_number": "id number|id-nummer|numéro d'identification|número de id|numero id|codice id"
        "|codice identificativo|número de identificação",
        "first_name": "first_name|first name|firstname|vorname|prénom|nombre|nome|voornaam",
        "last_name": "last_name|last name|lastname|surname|nachname|nom|nom de famille|apellido(s)"
        "|apellidos|cognome|sobrenome|apelido|achternaam",
        "full_name": "full name|vollständiger name|nom complet|nombre completo|nome completo|volledige naam",
        "section": "section|sections",
        "institution": "institution|institución|istituzione|instituição|instelling|department|departamento"
        "|dipartimento|abteilung|département|afdeling",
        "state": "state|status|started|started on|completed|begonnen am|beendet|statut|état|commencé le"
        "|terminé|estado|comenzado el|finalizado|stato|iniziato|terminato|completato|iniciado em|completo"
        "|gestart op|voltooid",
        "duration": "time taken|duration|verbrauchte zeit|dauer|temps utilisé|durée|tiempo requerido"
        "|tempo impiegato|tempo utilizado|verstreken tijd",
        "grade": "grade|bewertung|note|calificación|valutazione|nota|puntuación|punteggio|avaliar|cijfer",
    }.items()
}
"""What columns are for, those that can be mapped first, and the headers by which each is known: in English,
German, French, Spanish, Italian, Portuguese and Dutch."""
_ANSWERED = {"case", "answer", "unit", "direction", "variant"}
ABOUT_STUDENTS = frozenset(text for name, texts in FIELDS.items() if name not in _ANSWERED for text in texts)
"""Headers that are of no question."""

_ASIDE = re.compile(
    r"(?:points|score|feedback|punkte|puntos|punti|commentaires?|comentarios|rückmeldung|grade|max "
    r"points|status) - .*"
    r"|.*\[(?:score|feedback|punktzahl|punkte)\]"
    r"|.*[-_ ](?:score|feedback|comments?|points|punkte|grade|correct\??|status|time|timestamp)"
)
"""What quizzes add to a question: columns of its points and comments, which are no answers."""


def is_aside(name: str) -> bool:
    """Whether a column, by its plain name, is one that a platform adds to a question."""
    return _ASIDE.fullmatch(name) is not None


Find = Callable[[str], "str | None"]
"""The question that a text names: ``press``, ``press:w4/w2``; None for none."""


def plain_name(text: str) -> str:
    """A header in small letters with single spaces and plain apostrophes."""
    return " ".join(without_unseen(text).replace("\u2019", "'").lower().split())


class TableColumns:
    """The columns of a header, and the user's own mapping of them."""

    def __init__(
        self,
        header: Sequence[str],
        mapping: Iterable[tuple[str, str]],
        find: Find,
        near: Callable[[str], str] = lambda text: "",
    ) -> None:
        self.header = list(header)
        self.names = [plain_name(text) for text in header]
        self.find = find
        self.near = near
        """the case whose name a text is much like; '' for none"""
        self.fields: dict[str, int] = {}
        self.questions: dict[int, str] = {}
        self.absent: dict[str, str] = {}
        """questions by the mapped columns that this table has not"""
        for left, right in mapping:
            self._map(left, right)

    def _map(self, left: str, right: str) -> None:
        """``student_id=Email Address`` names a field's column; ``Q3=press`` a question's; and the other way
        round, where that can be meant."""
        if not self._matching(left) and self.find(left) is not None and self._matching(right):
            left, right = right, left
        if right in FIELDS and left not in FIELDS and self._matching(left) and self.find(right) is None:
            left, right = right, left
        if left in FIELDS and self._matching(right):
            self.fields[left] = self._one(right)
            return
        columns = self._matching(left)
        if not columns:
            if left in FIELDS:
                raise HeaderError(f"there is no column '{right}' for {left}; the columns are {self.listed()}")
            self.absent[left] = right
            return
        question = self.find(right)
        if question is None:
            if left in FIELDS:
                raise HeaderError(
                    f"there is no column '{right}' for {left}; leave it out to take the column '{left}'"
                )
            raise HeaderError(f"there is no case '{right}' for the column '{left}'")
        self.questions[self._one(left)] = question

    def _matching(self, name: str) -> list[int]:
        """Columns of that name; else those that start with it (``Q3`` of ``Q3: crank torque (2 pts)``)."""
        wanted = plain_name(name)
        exact = [i for i, text in enumerate(self.names) if text == wanted]
        start = re.compile(re.escape(wanted) + r"(?![\w-])")
        return exact or [i for i, text in enumerate(self.names) if start.match(text) and not is_aside(text)]

    def _one(self, name: str) -> int:
        columns = self._matching(name)
        if len(columns) > 1:
            found = ", ".join(f"'{self.header[i]}'" for i in columns)
            raise HeaderError(f"'{name}' can mean {len(columns)} columns: {found}; write one of them in full")
        return columns[0]

    def field(self, name: str) -> int | None:
        """The column of a field, as mapped or by its usual names."""
        if name in self.fields:
            return self.fields[name]
        found = [i for i, text in enumerate(self.names) if text in FIELDS[name] and i not in self.questions]
        return found[0] if found else None

    def places(self, *names: str) -> list[int]:
        """The columns of fields, or of other names, that there are, in this order."""
        at = {name: index for index, name in reversed([*enumerate(self.names)])}
        found = (self.field(name) if name in FIELDS else at.get(name) for name in names)
        return list(dict.fromkeys(index for index in found if index is not None))

    def check_once(self, index: int) -> None:
        """Raises HeaderError where two columns of the table have the name of one that is to be read."""
        if self.names.count(self.names[index]) > 1:
            raise HeaderError(
                f"two columns are called '{self.header[index]}': rename one, so that it is plain which counts"
            )

    def has(self, *names: str) -> bool:
        """Whether all these headers stand there."""
        return all(name in self.names for name in names)

    def question_of(self, index: int) -> str | None:
        """The question of a column: mapped, or named in its header."""
        if index in self.questions:
            return self.questions[index]
        for text in candidates(self.header[index]):
            question = self.find(text)
            if question is not None:
                return question
        return None

    def listed(self) -> str:
        """The columns, for a message."""
        shown = ", ".join(f"'{text[:40]}'" for text in self.header[:20])
        return shown + (", ..." if len(self.header) > 20 else "")


def read_table(path: str | os.PathLike[str], report: Report) -> tuple[TableColumns, Iterator[TableRow]]:
    """The columns and rows of a table in which no column is a question: a roster, a record, marks by hand.

    Raises ValueError, with a sentence, where it is none; OSError.
    """
    with reading(path) as file:
        table = AnswerTable(file, report)
        return TableColumns(table.header, (), lambda text: None), iter([*table.rows()])


def read_whole_table(path: str | os.PathLike[str]) -> tuple[TableColumns, list[list[str]]]:
    """The columns of such a table and the cells of its rows, each of which is whole.

    Raises ValueError, with a sentence, where one is not; OSError.
    """
    troubles: list[str] = []
    columns, rows = read_table(path, lambda line, why: troubles.append(f"line {line}: {why}"))
    found = []
    for row in rows:
        if row.trouble or len(row.cells) != len(columns.header):
            troubles.append(f"line {row.line}: {row.trouble or 'this row is not whole'}")
        found.append(row.cells)
    if troubles:
        raise ValueError(troubles[0])
    return columns, found


def without_apostrophe(cell: str) -> str:
    """A cell without the apostrophe that keeps a spreadsheet from taking it for a formula."""
    text = cell.strip()
    return text[1:] if text[:1] == "'" else text


def candidates(header: str) -> Iterable[str]:
    """Texts of a header that may name a case: all of it, what brackets hold, what stands before a colon."""
    text = " ".join(header.split())
    yield text
    for inside in re.findall(r"[\[(]([^\])(\[]+)[\])]", text):
        yield inside.strip()
    points = re.sub(r"\s*\(\d+(?:\.\d+)? ?(?:pts?|points?)?\)$", "", text)
    yield points
    yield from (part.strip() for part in points.split(": "))
    yield from (part.strip() for part in re.split(r":\s+|\s+-\s+", points))
    yield re.split(r"\s", points)[0].rstrip(":.)")


_ZONE = re.compile(r" ?(?:UTC|GMT|Z)?(?:(?<=[TC ])([-+])(\d{1,2}):?(\d\d)?|(?<=[TCZ]))$")
"""``UTC``, ``GMT+1``, ``-0800``."""
_DATES = (
    "%d %B %Y",
    "%d %b %Y",
    "%B %d, %Y",
    "%b %d, %Y",
    "%B %d %Y",
    "%b %d %Y",
    "%d.%m.%Y",
    "%d.%m.%y",
    "%Y/%m/%d",
)
_CLOCK = re.compile(
    r"(?:^| |T)(\d{1,2}):(\d\d)(?::(\d\d)(?:[.,]\d+)?)?(?: ?(?P<half>[ap])\.? ?m\.?)?$", re.IGNORECASE
)
_MONTHS = {
    word: english
    for english, words in {
        "January": "januar janvier enero gennaio janeiro januari",
        "February": "februar février fevrier febrero febbraio fevereiro februari",
        "March": "märz mars marzo março maart",
        "April": "avril abril aprile",
        "May": "mai mayo maggio maio mei",
        "June": "juni juin junio giugno junho",
        "July": "juli juillet julio luglio julho",
        "August": "août aout agosto augustus",
        "September": "septembre septiembre settembre setembro",
        "October": "oktober octobre octubre ottobre outubro",
        "November": "novembre noviembre novembro",
        "December": "dezember décembre decembre diciembre dicembre dezembro",
    }.items()
    for word in words.split()
}
_FOREIGN = re.compile(rf"\b({'|'.join(_MONTHS)})\b", re.IGNORECASE)
_SLASHED = re.compile(r"(?<!\d)(\d{1,2})([/-])(\d{1,2})\2(\d{4}|\d{2})(?![\d/-])")
_SLASHED_BYTES = re.compile(
    rb"([/-])(?:(?<=[^\d/-](\d).)|(?<=[^\d/-](\d\d).))(\d{1,2})\1(?:\d{4}|\d{2})(?![\d/-])"
)
"""From the first slash, which is found soonest; the number before it is one of two groups."""
_NAMED = {"CET": 1, "MEZ": 1, "CEST": 2, "MESZ": 2, "BST": 1, "EST": -5, "EDT": -4} | {
    "CST": -6,
    "CDT": -5,
    "MST": -7,
    "MDT": -6,
    "PST": -8,
    "PDT": -7,
}
"""Zones that exports name, in hours; those of North America where a name has two meanings."""
NEVER = -1.0
"""For a time that is not given."""


def timestamp(text: str) -> float | None:
    """Seconds since 1970, a time without a zone taken for UTC; NEVER for '', None for what can't be read.

    A date with slashes that could be read both ways is taken month first; `readings` has both.
    """
    text = " ".join(text.split())
    if not text:
        return NEVER
    with suppress(ValueError):
        return _seconds(datetime.fromisoformat(text))
    before, _, name = text.rpartition(" ")
    if name in _NAMED:
        text = f"{before} GMT{_NAMED[name]:+d}"
    zone, off = _ZONE.search(text), 0.0
    if zone is not None:
        text = text[: zone.start()]
        sign, hours, minutes = zone.groups()
        off = float(f"{sign}1") * (3600.0 * int(hours) + 60.0 * int(minutes or 0)) if sign else 0.0
    plain = re.sub(r"(?<=\d)(?:st|nd|rd|th)\b|, (?=\d+:)|^[A-Za-z]+, ", " ", text).replace(". ", " ")
    plain = _FOREIGN.sub(
        lambda found: _MONTHS[found.group().lower()], re.sub(r"\b(?:de|del|le|at|um|à|Uhr)\b", " ", plain)
    )
    plain = re.sub(r"^[^\W\d]+\.?,? (?=\d{1,2}\.? +[^\W\d])", "", " ".join(plain.split()))
    plain = re.sub(r"(?<=\d), (?=\d+:)", " ", year_first(plain, "month"))
    plain = re.sub(r"^(\d{4})-(\d\d?)-(?=\d)|^(\d\d?)-([A-Za-z]{3,})-(?=\d)", _spaced, plain)
    clock = _CLOCK.search(plain)
    day = plain[: clock.start()] if clock is not None else plain
    for form in _DATES:
        with suppress(ValueError):
            return _seconds(datetime.strptime(day, form) + (_time_of(clock) if clock else timedelta())) - off
    with suppress(ValueError):
        return _seconds(datetime.fromisoformat(text)) - off
    return None


def _spaced(found: re.Match[str]) -> str:
    """``2025/11/`` of ``2025-11-``, ``5 Nov `` of ``5-Nov-``."""
    year, month, day, name = found.groups()
    return f"{year}/{month}/" if year else f"{day} {name} "


def _time_of(clock: re.Match[str]) -> timedelta:
    """The time of a day, of twelve hours or of twenty-four. Raises ValueError."""
    hour, minute, second = (int(part or 0) for part in clock.group(1, 2, 3))
    if clock.group("half"):
        half = clock.group("half").lower()
        hour = datetime.strptime(f"{hour} {half}m", "%I %p").hour
    time(hour, minute, second)
    return timedelta(hours=hour, minutes=minute, seconds=second)


def _seconds(found: datetime) -> float:
    return (found if found.tzinfo is not None else found.replace(tzinfo=UTC)).timestamp()


def year_first(text: str, order: str) -> str:
    """A time whose date of slashes has its year first; by ``order`` (``day``, ``month``) where both could
    be.
    """

    def turned(found: re.Match[str]) -> str:
        first, _, second, year = found.groups()
        by_day = int(first) > 12 or (order == "day" and int(second) <= 12)
        day, month = (first, second) if by_day else (second, first)
        return f"{year if len(year) == 4 else '20' + year}/{month}/{day}"

    return _SLASHED.sub(turned, text, count=1)


def readings(text: str) -> tuple[float | None, float | None]:
    """A time with its date read month first, and day first."""
    if _SLASHED.search(text) is None:
        found = timestamp(text)
        return found, found
    return timestamp(year_first(text, "month")), timestamp(year_first(text, "day"))


def order_of(file: IO[bytes]) -> str:
    """How dates with slashes are ordered in a file, by those that can be read in one way only: ``day``,
    ``month``, or '' where none, or both, are to be seen."""
    seen = set()
    rest = b"\n"
    while block := file.read(1 << 20):
        for found in _SLASHED_BYTES.finditer(rest + block):
            first, second = int(found.group(2) or found.group(3)), int(found.group(4))
            if first > 12 >= second > 0:
                seen.add("day")
            elif second > 12 >= first > 0:
                seen.add("month")
        rest = block[-16:]
    return seen.pop() if len(seen) == 1 else ""


def attempt_number(text: str) -> int:
    """The number of an attempt: ``2``, ``attempt 2``; 0 where none is given."""
    found = re.search(r"\d{1,15}", text)
    return int(found.group()) if found else 0
