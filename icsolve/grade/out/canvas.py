"""The Canvas gradebook: a column a question, in a new table or in the teacher's own export."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence

from icsolve.grade.out.rows import Row, shown
from icsolve.grade.out.template import Filled, aliases, rows_of, text_of
from icsolve.grade.people import Person
from icsolve.grade.results import safe

_COLUMNS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
_POINTS = "    Points Possible"


def gradebook(students: Iterable[tuple[str, list[Row]]], people: dict[str, Person]) -> str:
    """A gradebook of the five id columns and one for each question; names come from the roster."""
    found = list(students)
    points = _questions(rows for _, rows in found)
    out = io.StringIO()
    table = csv.writer(out, lineterminator="\n")
    table.writerow([*_COLUMNS, *points])
    table.writerow([_POINTS, "", "", "", "", *map(shown, points.values())])
    for student, rows in found:
        if student:
            scores = {row.case: shown(row.score) for row in rows}
            table.writerow([safe(c) for c in _ids(student, people)] + [scores.get(q, "") for q in points])
    return out.getvalue()


def _questions(all_rows: Iterable[Sequence[Row]]) -> dict[str, float]:
    """The questions with their points, by name."""
    return dict(sorted({row.case: row.max_score for rows in all_rows for row in rows}.items()))


def _ids(student: str, people: dict[str, Person]) -> tuple[str, ...]:
    person = people.get(student, Person(student))
    name = ", ".join(part for part in (person.last_name, person.first_name) if part)
    return (name, "", student, person.email, person.section)


def filled(
    template: str, students: Iterable[tuple[str, list[Row]]], people: dict[str, Person]
) -> Filled:
    """The teacher's export with a column for each question filled.

    A column ``press (1234)`` takes the marks of ``press``; a question without one gets a new column.

    Raises ValueError where it is no gradebook.
    """
    table = rows_of(template)
    header = table[0]
    ids = [header.index(name) for name in ("SIS User ID", "SIS Login ID", "ID") if name in header]
    if header[0].lstrip("\ufeff") != "Student" or not ids:
        raise ValueError("the template is no Canvas gradebook, which starts with Student,ID,SIS User ID")
    marks = dict(students)
    known, points = aliases(marks, people), _questions(marks.values())
    places = {question: _place(header, question) for question in points}
    placed = set()
    for row in table[1:]:
        row.extend([""] * (len(header) - len(row)))
        if row[0].startswith(_POINTS):
            for question, most in points.items():
                row[places[question]] = row[places[question]] or shown(most)
            continue
        student = next((known[row[i].strip().lower()] for i in ids if row[i].strip().lower() in known), None)
        if student is not None:
            placed.add(student)
            for mark in marks[student]:
                row[places[mark.case]] = shown(mark.score)
    return Filled(text_of(table), frozenset(placed))


def _place(header: list[str], question: str) -> int:
    """The column of a question; a new one at the end where there is none."""
    for index, name in enumerate(header):
        if name == question or name.rpartition(" (")[0] == question:
            return index
    header.append(question)
    return len(header) - 1
