"""Who the students are: a roster, and which of its people a submission is from."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable

from icsolve.files import reading
from icsolve.grade.tables.columns import HeaderError, TableColumns, identifier
from icsolve.grade.tables.text import AnswerTable
from icsolve.tuples import NamedTuple

Report = Callable[[int, str], None]


class Person(NamedTuple):
    """One student of a roster; ``others`` are the other ids under which a platform may know them."""

    student_id: str
    email: str = ""
    first_name: str = ""
    last_name: str = ""
    section: str = ""
    others: tuple[str, ...] = ()


class Roster:
    """The students by id, by email and by their other ids."""

    def __init__(self, people: Iterable[Person]) -> None:
        self.people: dict[str, Person] = {}
        self._ids: dict[str, list[str]] = {}
        for person in people:
            self.people.setdefault(person.student_id, person)
        for person in self.people.values():
            for other in (person.student_id, person.email, *person.others):
                if other:
                    students = self._ids.setdefault(other.casefold(), [])
                    if person.student_id not in students:
                        students.append(person.student_id)

    def match(self, ids: tuple[str, ...]) -> str | None:
        """The student of the first id that the roster has; ids are text, ``007`` is not ``7``.

        Raises ValueError, with a sentence, for an email or another id that several students share.
        """
        shared: list[str] = []
        for name in ids:
            if name in self.people:
                return name
            found = self._ids.get(name.casefold(), ())
            if len(found) == 1:
                return found[0]
            if found:
                shared.append(f"{name!r} is that of {' and '.join(found[:4])} on the roster")
        if shared:
            raise ValueError(f"{shared[0]}: whose answer is it? Give them different ones, or a student_id")
        return None

    def hint(self, ids: tuple[str, ...]) -> str:
        """Who may be meant where zeros in front were lost, for a message."""
        for name in ids:
            near = [student for student in self.people if student.lstrip("0") == name.lstrip("0")]
            if near and name.lstrip("0"):
                return f"; the roster has {near[0]!r}: did a spreadsheet change the zeros in front?"
        return ""


def read_roster(path: str | os.PathLike[str], report: Report) -> Roster:
    """The roster of a CSV file: canonical, or a platform's own (Gradescope, Canvas, Moodle).

    Raises HeaderError, with the file's name and a sentence, where it can't be used; OSError.
    """
    try:
        return _read(path, report)
    except (HeaderError, ValueError) as error:
        raise HeaderError(f"{os.fspath(path)}: {error}") from None


def _read(path: str | os.PathLike[str], report: Report) -> Roster:
    with reading(path) as file:
        table = AnswerTable(file, report)
        columns = TableColumns(table.header, (), lambda text: None)
        at = _id_columns(columns)
        rest = [columns.field(name) for name in ("email", "first_name", "last_name", "section")]
        people: dict[str, Person] = {}
        for row in table.rows():
            person = _person(row.cells, at, rest)
            if row.trouble:
                report(row.line, row.trouble)
            if person is None:
                report(row.line, "this row of the roster has no student's id and is passed over")
            elif person.student_id in people:
                report(
                    row.line,
                    f"the student {person.student_id!r} is in the roster twice; the first row counts",
                )
            elif not person.student_id.startswith(("Student, Test", "    Points")):
                people[person.student_id] = person
    return Roster(people.values())


def _id_columns(columns: TableColumns) -> list[int]:
    """The columns that may hold an id, best first."""
    named = {name: index for index, name in reversed(list(enumerate(columns.names)))}
    found = [columns.field("student_id"), named.get("sid"), named.get("sis user id")]
    found += [columns.field("id_number"), named.get("id"), columns.field("email")]
    usable = list(dict.fromkeys(i for i in found if i is not None))
    if columns.names[0] == "student" and len(usable) > 1:
        usable.remove(0)  # in a gradebook the first column has names
    if not usable:
        raise HeaderError(f"no column of the roster has a student's id; its columns are {columns.listed()}")
    return usable


def _person(cells: list[str], at: list[int], rest: list[int | None]) -> Person | None:
    ids = [identifier(cells[i]) for i in at if i < len(cells) and cells[i].strip()]
    if not ids:
        return None
    email, first, last, section = ("" if i is None or i >= len(cells) else cells[i].strip() for i in rest)
    return Person(ids[0], email, first, last, section, tuple(ids[1:]))
