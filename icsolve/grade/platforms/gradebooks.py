"""Gradebooks of platforms, new or the teacher's own filled: Canvas, Brightspace, Blackboard, Moodle.

What was not judged stays ungraded: its cell is blank, and in Moodle, whose one grade is for all questions,
the student's row is left as it is. Marks are scaled to the points that a column has.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Iterable, Sequence

from icsolve.grade.course import Person
from icsolve.grade.results import ResultRow, csv_text, marks_of, safe, shown
from icsolve.grade.tables.columns import FIELDS, plain_name
from icsolve.grade.written.numerals import numeral, without_unseen
from icsolve.tuples import NamedTuple

Students = Iterable[tuple[str, list[ResultRow]]]


class Filled(NamedTuple):
    """The file's new text, the students who have a row in it, and the questions that got a column of their
    own, as none of its columns had their name."""

    text: str
    placed: frozenset[str]
    added: tuple[str, ...] = ()


_LAST = plain_name("End-of-Line Indicator")


class Template:
    """A teacher's own grade file: its header and rows, its delimiter and its decimal mark."""

    def __init__(self, text: str) -> None:
        """Raises ValueError where it is no table."""
        text = text.lstrip("\ufeff")
        named = re.match(r"sep=([,;\t])\r?\n", text, re.IGNORECASE)
        self.start = named.group() if named else ""
        text = text[len(self.start) :]
        head = text.partition("\n")[0]
        self.delimiter = named.group(1) if named else max(",;\t", key=head.count)
        try:
            reader = csv.reader(io.StringIO(text, newline=""), delimiter=self.delimiter, strict=True)
            table = [list(row) for row in reader]
        except csv.Error as error:
            raise ValueError(f"the template can't be read as a table ({error}): is it cut off?") from None
        if not table or not any(cell.strip() for cell in table[0]):
            raise ValueError("the template is empty: it should be the platform's own export")
        width = len(table[0])
        self.header, *self.rows = [row + [""] * (width - len(row)) for row in table]
        self.names = [plain_name(name) for name in self.header]
        cells = [cell.strip() for row in self.rows for cell in row]
        commas, points = (  # before three digits they may divide thousands
            sum(bool(re.fullmatch(rf"\d+{mark}(?!\d{{3}}$)\d+", c)) for c in cells) for mark in (",", r"\.")
        )
        self.comma = commas > points

    def number(self, value: float | None, form: str = "") -> str:
        """A mark in the file's own decimals; blank for none."""
        text = "" if value is None else format(value, form) if form else shown(value)
        return text.replace(".", ",") if self.comma else text

    def points(self, text: str) -> float | None:
        """A number of the file; None where there is none above zero."""
        text = text.strip()
        found = numeral(text, 0, "comma" if self.comma else "point")
        whole = found is not None and not found.flag and found.end == len(text)
        return found.value if found is not None and whole and found.value > 0.0 else None

    def new_column(self, name: str) -> int:
        """Another column at the end; before the mark of it in a file of Brightspace, named as it wants it."""
        at = len(self.header)
        if self.names[-1] == _LAST:
            at, name = at - 1, f"{name} Points Grade"
        self.header.insert(at, name)
        self.names.insert(at, plain_name(name))
        for row in self.rows:
            row.insert(at, "")
        return at

    def text(self) -> str:
        """The file again."""
        out = io.StringIO()
        csv.writer(out, delimiter=self.delimiter, lineterminator="\n").writerows([self.header, *self.rows])
        return self.start + out.getvalue()


def aliases(marks: dict[str, list[ResultRow]], people: dict[str, Person]) -> dict[str, str]:
    """Students by every name, as `plain_name` has it, that a platform may know them by; a name of two is
    none's."""
    known: dict[str, set[str]] = {}
    for student in marks:
        person = people.get(student, Person(student))
        first, last = person.first_name, person.last_name
        names = (f"{first} {last}".strip(), f"{last}, {first}".strip(", "))
        for name in (*names, *person.others, person.email, person.email.partition("@")[0], student):
            if name:
                known.setdefault(plain_name(name), set()).add(student)
    for student in marks:
        known[plain_name(student)] = {student}
    return {name: min(students) for name, students in known.items() if len(students) == 1}


def total_of(rows: Sequence[ResultRow]) -> tuple[float | None, float]:
    """The marks of all questions together, None while one of them waits for a person; and the most."""
    score, _, _, waiting = marks_of(rows)
    return None if waiting else score, sum(row.max_score for row in rows)


def _points(all_rows: Sequence[Sequence[ResultRow]], total: str) -> dict[str, float]:
    """The columns with their points: the questions, by name, or all together in the column ``total``."""
    if total:
        return {total: max((total_of(rows)[1] for rows in all_rows), default=0.0)}
    return dict(sorted({row.case: row.max_score for rows in all_rows for row in rows}.items()))


def _marks(rows: Sequence[ResultRow], total: str) -> dict[str, tuple[float | None, float]]:
    """A student's marks by column: a question each, or all together in the column ``total``."""
    return {total: total_of(rows)} if total else {row.case: (row.score, row.max_score) for row in rows}


# --- Canvas, Brightspace, Blackboard ----------------------------------------------------------------

_CANVAS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
_POINTS = "    Points Possible"
_IDS = (
    "sis user id", "sis login id", "orgdefinedid", "student id", "username", "user name", "benutzername",
    "nom d'utilisateur", "nombre de usuario", "nome utente", "integration id", "id", "email", "email address",
)  # fmt: skip
_NAMES = (("lastname", "firstname"), ("last name", "first name"), ("nachname", "vorname"))


def canvas_gradebook(students: Students, people: dict[str, Person], total: str) -> str:
    """A gradebook of the five id columns and one for each question; names come from the roster."""
    found = list(students)
    points = _points([rows for _, rows in found], total)
    lines = [[_POINTS, "", "", "", "", *map(shown, points.values())]]
    for student, rows in found:
        if student:
            marks = {name: score for name, (score, _) in _marks(rows, total).items()}
            scores = [shown(mark) if (mark := marks.get(q)) is not None else "" for q in points]
            person = people.get(student, Person(student))
            name = ", ".join(part for part in (person.last_name, person.first_name) if part)
            lines.append([*map(safe, (name, "", student, person.email, person.section)), *scores])
    return csv_text([*_CANVAS, *points], lines)


def gradebook_filled(template: str, students: Students, people: dict[str, Person], total: str) -> Filled:
    """The teacher's export with a column for each question filled, or the one column of the ``total``.

    A column ``press (1234)`` takes the marks of ``press``, scaled to its points; a question without one gets
    a new column.

    Raises ValueError where it is no gradebook, or has no column of that total.
    """
    book = Template(template)
    ids = [book.names.index(name) for name in _IDS if name in book.names]
    pairs = [pair for pair in _NAMES if all(name in book.names for name in pair)]
    if not ids and not pairs:
        raise ValueError(
            "the template is no gradebook: none of its columns holds ids of students "
            f"(it has {', '.join(book.header[:8])})"
        )
    marks = {student: rows for student, rows in students if student}
    points = _points([*marks.values()], total)
    own = tuple(book.header)
    places = {name: _place(book, name, new=not total) for name in points}
    added = tuple(name for name, at in places.items() if book.header[at] not in own)
    possible = _possible(book, places, points)

    def put(row: list[str], own: list[ResultRow]) -> None:
        for name, (score, most) in _marks(own, total).items():
            scaled = score * possible[name] / most if score is not None and most else score
            row[places[name]] = book.number(scaled)

    return _filled(book, marks, people, ids, pairs, put)._replace(added=added)


def _filled(
    book: Template,
    marks: dict[str, list[ResultRow]],
    people: dict[str, Person],
    ids: list[int],
    pairs: list[tuple[str, str]],
    put: Callable[[list[str], list[ResultRow]], None],
) -> Filled:
    """The file with what ``put`` writes into each student's row: known by an id, without one by a name."""
    known, placed = aliases(marks, people), set()
    for row in book.rows:
        texts = [plain_name(row[i]).lstrip("#") for i in ids]
        for last, first in pairs:
            names = (row[book.names.index(name)] for name in (first, last))
            texts.append(plain_name(" ".join(names)))
        if "student" in book.names:
            texts.append(plain_name(row[book.names.index("student")]))
        student = next((known[text] for text in texts if text in known), None)
        if student is not None:
            placed.add(student)
            put(row, marks[student])
    return Filled(book.text(), frozenset(placed))


def _possible(book: Template, places: dict[str, int], points: dict[str, float]) -> dict[str, float]:
    """The points of each column: as the file has them, else those of the course, which are written in."""
    for row in book.rows:
        if row[0].strip() == _POINTS.strip():
            for name, most in points.items():
                row[places[name]] = row[places[name]] or book.number(most)
            return {name: book.points(row[places[name]]) or most for name, most in points.items()}
    found = {}
    for name, most in points.items():
        header = book.header[places[name]].lower()
        told = re.search(r"(?:maxpoints:|total pts: ?(?:up to )?)([\d.,]+)", header)
        found[name] = (book.points(told.group(1)) if told else None) or most
    return found


def _place(book: Template, name: str, new: bool) -> int:
    """The column of a question or of the total: by its full name, or without what the platform adds."""
    wanted = without_unseen(name)
    for index, header in enumerate(map(without_unseen, book.header)):
        plain = re.sub(r" *(?:\(\d+\)|<[^>]*>|\[[^\]]*\].*| Points Grade.*)$", "", header).strip()
        bare = re.sub(r" *(?:Points Grade|\[Total Pts.*)?$", "", plain)
        if wanted in (header.strip(), header.rpartition(" (")[0], plain, bare):
            return index
    if not new:
        raise ValueError(f"there is no column {name!r} for the total; it has {', '.join(book.header)[:300]}")
    return book.new_column(name)


# --- Moodle -----------------------------------------------------------------------------------------

_WORKSHEET = (
    "Identifier", "Full name", "Email address", "Status", "Grade", "Maximum Grade", "Grade can be changed",
    "Last modified (submission)", "Last modified (grade)", "Feedback comments",
)  # fmt: skip
_MOST = re.compile(r"maxim|máxim|massim|bestwertung|höchst")
_COMMENTS = re.compile(r"feedback|comment|kommentar|comentario|retroalimentación|commenti")
_MOODLE_IDS = ("id_number", "email", "full_name")


def comment(rows: Iterable[ResultRow]) -> str:
    """What a student is told of all questions."""
    return " | ".join(f"{row.case}: {row.verdict}. {row.feedback}" for row in rows)


def moodle_worksheet(students: Students, people: dict[str, Person]) -> str:
    """A worksheet with one grade for all questions together; blank where one of them was not judged."""
    lines = []
    for student, rows in students:
        if student:
            person = people.get(student, Person(student))
            name = " ".join(part for part in (person.first_name, person.last_name) if part)
            score, most = total_of(rows)
            graded = (shown(score), safe(comment(rows))) if score is not None else ("", "")
            grades = (graded[0], shown(most), "Yes", "-", "-", graded[1])
            lines.append((safe(student), safe(name), safe(person.email), "Submitted for grading", *grades))
    return csv_text(_WORKSHEET, lines)


def moodle_filled(template: str, students: Students, people: dict[str, Person]) -> Filled:
    """The teacher's own worksheet with grades and comments, always both: Moodle wipes grades otherwise.

    Grades are scaled to the worksheet's maximum; its delimiter and decimal mark are kept, and so is the row
    of a student of whom not all was judged.

    Raises ValueError where it has no column for grades, for comments or for a student's id.
    """
    book = Template(template)
    grade = next((book.names.index(name) for name in FIELDS["grade"] if name in book.names), None)
    most = next((i for i, name in enumerate(book.names) if _MOST.search(name)), None)
    comments = next((i for i, name in enumerate(book.names) if _COMMENTS.search(name)), None)
    ids = [i for i, name in enumerate(book.names) if any(name in FIELDS[field] for field in _MOODLE_IDS)]
    if grade is None or comments is None or not ids:
        raise ValueError(
            "the worksheet needs the columns Grade, Feedback comments and Email address or ID number"
        )
    marks = {student: rows for student, rows in students if student}

    def put(row: list[str], own: list[ResultRow]) -> None:
        score, total = total_of(own)
        if score is not None:
            possible = book.points(row[most]) if most is not None else None
            comma = book.comma or (most is not None and "," in row[most])
            text = f"{score / total * possible if possible and total else score:.2f}"
            row[grade] = text.replace(".", ",") if comma else text
            row[comments] = safe(comment(own))

    return _filled(book, marks, people, ids, [], put)
