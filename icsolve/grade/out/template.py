"""A teacher's own grade file: read as a table, its rows matched with students, filled."""

from __future__ import annotations

import csv
import io
from typing import NamedTuple

from icsolve.grade.out.rows import Row
from icsolve.grade.people import Person


class Filled(NamedTuple):
    """The file's new text, and the students who have a row in it."""

    text: str
    placed: frozenset[str]


def rows_of(template: str, delimiter: str = ",") -> list[list[str]]:
    """The rows, each as long as the first.

    Raises ValueError where there is no header.
    """
    table = [list(row) for row in csv.reader(io.StringIO(template), delimiter=delimiter)]
    if not table or not any(cell.strip() for cell in table[0]):
        raise ValueError("the template is empty: it should be the platform's own export")
    width = len(table[0])
    return [row + [""] * (width - len(row)) for row in table]


def text_of(table: list[list[str]], delimiter: str = ",") -> str:
    """The rows as a file."""
    out = io.StringIO()
    csv.writer(out, delimiter=delimiter, lineterminator="\n").writerows(table)
    return out.getvalue()


def aliases(marks: dict[str, list[Row]], people: dict[str, Person]) -> dict[str, str]:
    """Students by every name, in small letters, that a platform may know them by; a name of two is none's."""
    known: dict[str, set[str]] = {}
    for student in marks:
        person = people.get(student, Person(student))
        full = f"{person.first_name} {person.last_name}".strip()
        for name in (full, *person.others, person.email, student):
            if name:
                known.setdefault(name.lower(), set()).add(student)
    for student in marks:
        known[student.lower()] = {student}
    return {name: min(students) for name, students in known.items() if len(students) == 1}
