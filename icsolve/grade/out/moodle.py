"""Moodle's offline grading worksheet: a new one, or the teacher's own, filled.

Both the grade and the comment are always written: Moodle wipes the grades of an import without them.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence

from icsolve.grade.out.rows import Row, shown
from icsolve.grade.out.template import Filled, aliases, rows_of, text_of
from icsolve.grade.people import Person
from icsolve.grade.results import safe

_COLUMNS = (
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


def worksheet(students: Iterable[tuple[str, list[Row]]], people: dict[str, Person]) -> str:
    """A worksheet with one grade for all questions together."""
    out = io.StringIO()
    table = csv.writer(out, lineterminator="\n")
    table.writerow(_COLUMNS)
    for student, rows in students:
        if student:
            person = people.get(student, Person(student))
            name = " ".join(part for part in (person.first_name, person.last_name) if part)
            score, most = sum(row.score for row in rows), sum(row.max_score for row in rows)
            grades = (shown(score), shown(most), "Yes", "-", "-", safe(comment(rows)))
            table.writerow((safe(student), safe(name), safe(person.email), "Submitted for grading", *grades))
    return out.getvalue()


def filled(
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
