"""Gradebooks of platforms, new or the teacher's own filled: Canvas, and Moodle's offline worksheet.

To Moodle both the grade and the comment are always written: it wipes the grades of an import without them.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from icsolve.grade.results import Row, safe, shown
from icsolve.grade.roster import Person


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


_CANVAS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
_POINTS = "    Points Possible"


def canvas_gradebook(students: Iterable[tuple[str, list[Row]]], people: dict[str, Person]) -> str:
    """A gradebook of the five id columns and one for each question; names come from the roster."""
    found = list(students)
    points = _questions(rows for _, rows in found)
    out = io.StringIO()
    table = csv.writer(out, lineterminator="\n")
    table.writerow([*_CANVAS, *points])
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


def canvas_filled(
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


_WORKSHEET = (
    "Identifier",
    "Full name",
    "Email address",
    "Status",
    "Grade",
    "Maximum Grade",
    "Grade can be changed",
    "Last modified (submission)",
    "Last modified (grade)",
    "Feedback comments",
)
_GRADE = ("grade", "bewertung", "note", "calificación")
_MOST = ("maximum grade", "bestwertung", "maximale bewertung", "note maximale")
_COMMENTS = ("feedback comments", "feedback als kommentar", "commentaires")
_IDS = (
    "id number",
    "id-nummer",
    "email address",
    "e-mail-adresse",
    "e-mail address",
    "username",
    "full name",
)


def comment(rows: Iterable[Row]) -> str:
    """What a student is told of all questions."""
    return " | ".join(f"{row.case}: {row.verdict}. {row.feedback}" for row in rows)


def moodle_worksheet(students: Iterable[tuple[str, list[Row]]], people: dict[str, Person]) -> str:
    """A worksheet with one grade for all questions together."""
    out = io.StringIO()
    table = csv.writer(out, lineterminator="\n")
    table.writerow(_WORKSHEET)
    for student, rows in students:
        if student:
            person = people.get(student, Person(student))
            name = " ".join(part for part in (person.first_name, person.last_name) if part)
            score, most = sum(row.score for row in rows), sum(row.max_score for row in rows)
            grades = (shown(score), shown(most), "Yes", "-", "-", safe(comment(rows)))
            table.writerow((safe(student), safe(name), safe(person.email), "Submitted for grading", *grades))
    return out.getvalue()


def moodle_filled(
    template: str, students: Iterable[tuple[str, list[Row]]], people: dict[str, Person]
) -> Filled:
    """The teacher's own worksheet with grades and comments.

    Grades are scaled to the worksheet's maximum; its delimiter and decimal comma are kept.

    Raises ValueError where it has no column for grades, for comments or for a student's id.
    """
    head = template.partition("\n")[0]
    delimiter = ";" if head.count(";") > head.count(",") else ","
    table = rows_of(template, delimiter)
    names = [name.lower().lstrip("\ufeff").strip() for name in table[0]]
    grade, most, comments = (_column(names, words) for words in (_GRADE, _MOST, _COMMENTS))
    ids = [names.index(word) for word in _IDS if word in names]
    if grade is None or comments is None or not ids:
        raise ValueError(
            "the worksheet needs the columns Grade, Feedback comments and Email address or ID number"
        )
    marks = dict(students)
    known = aliases(marks, people)
    placed = set()
    for row in table[1:]:
        student = next((known[row[i].strip().lower()] for i in ids if row[i].strip().lower() in known), None)
        if student is not None:
            placed.add(student)
            row[grade] = _grade(marks[student], row[most] if most is not None else "")
            row[comments] = safe(comment(marks[student]))
    return Filled(text_of(table, delimiter), frozenset(placed))


def _column(names: Sequence[str], words: Iterable[str]) -> int | None:
    return next((names.index(word) for word in words if word in names), None)


def _grade(rows: Sequence[Row], most: str) -> str:
    """The student's share of the worksheet's maximum, with its decimal mark."""
    score, total = sum(row.score for row in rows), sum(row.max_score for row in rows)
    comma = "," in most
    try:
        scaled = score / total * float(most.replace(",", ".")) if total else 0.0
    except ValueError:
        scaled = score
    text = f"{scaled:.2f}"
    return text.replace(".", ",") if comma else text
