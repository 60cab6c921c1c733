"""Results written for a platform: one function a kind, all from the lines of ``results.csv``."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from typing import NamedTuple

from icsolve.files import check_free, write_whole
from icsolve.grade.platforms.gradebooks import (
    Filled,
    canvas_gradebook,
    gradebook_filled,
    moodle_filled,
    moodle_worksheet,
)
from icsolve.grade.platforms.graders import (
    gradescope_results,
    junit_report,
    prairielearn_results,
    prairielearn_scores,
)
from icsolve.grade.results import ResultRow, by_student, read_results
from icsolve.grade.roster import Person
from icsolve.grade.tables.text import encoding_of
from icsolve.grade.variants.sheets import file_name


class PlatformFile(NamedTuple):
    """What to write: the results, the file to write, who is who, the platform's own file to fill."""

    results: str
    path: str
    people: dict[str, Person]
    template: str
    force: bool
    total: str = ""
    """the one column for all questions together"""


_NAMED = 20
"""Students without a row who are named."""


def write(kind: str, order: PlatformFile) -> str:
    """Write the results as ``kind``; what to tell the user, '' for nothing.

    Raises ValueError for a kind or a template that can't be used, KeptError, OSError.
    """
    try:
        return KINDS[kind](order)
    except (ValueError, IndexError) as error:
        raise ValueError(f"{order.template or order.path}: {error}") from None


def check_kind(kind: str) -> None:
    """Raises ValueError for a kind that there is not."""
    if kind not in KINDS:
        raise ValueError(f"--write {kind}: there is no such kind; it is one of {', '.join(KINDS)}")


def _gradebook(order: PlatformFile) -> str:
    """Canvas, new or the teacher's own; of other platforms the teacher's own."""
    students = by_student(order.results)
    if order.template:
        return _filled(order, gradebook_filled(_text(order.template), students, order.people, order.total))
    write_whole(order.path, canvas_gradebook(students, order.people, order.total), order.force)
    return ""


def _own_gradebook(order: PlatformFile) -> str:
    if not order.template:
        raise ValueError("fill the platform's own export: name it with --template")
    return _gradebook(order)


def _moodle(order: PlatformFile) -> str:
    students = by_student(order.results)
    if not order.template:
        write_whole(order.path, moodle_worksheet(students, order.people), order.force)
        return ""
    return _filled(order, moodle_filled(_text(order.template), students, order.people))


def _filled(order: PlatformFile, made: Filled) -> str:
    """Write a template that was filled; who has no row in it is named."""
    write_whole(order.path, made.text, order.force)
    left = [student for student, _ in by_student(order.results) if student and student not in made.placed]
    names = ", ".join(left[:_NAMED]) + (f" and {len(left) - _NAMED} more" if len(left) > _NAMED else "")
    missing = f"; it has no row for {names}" if left else ""
    return f"{order.path}: marks of {len(made.placed)} students of {order.template}{missing}"


def _text(path: str) -> str:
    """The text of a template, which may be filled where it lies if it is named as the target too."""
    with open(path, "rb") as file:
        data = file.read()
    encoding = encoding_of(data[:4000])
    return data.decode(encoding, "icsolve-windows" if encoding.startswith("utf-8") else "replace")


def _single(order: PlatformFile, make: Callable[[list[ResultRow]], dict[str, object]]) -> str:
    """One student's file; of several students a folder with a file for each."""
    students = [(student, rows) for student, rows in by_student(order.results, False) if student]
    if len(students) == 1:
        write_whole(order.path, _json(make(students[0][1])), order.force)
        return ""
    folder = order.path.removesuffix(".json")
    for student, _ in students:
        check_free(os.path.join(folder, f"{file_name(student)}.json"), order.force)
    for student, rows in students:
        write_whole(os.path.join(folder, f"{file_name(student)}.json"), _json(make(rows)), order.force)
    return f"{folder}: a file for each of {len(students)} students"


def _json(entry: dict[str, object]) -> str:
    return json.dumps(entry, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _prairielearn_csv(order: PlatformFile) -> str:
    write_whole(order.path, prairielearn_scores(by_student(order.results)), order.force)
    return ""


def _junit(order: PlatformFile) -> str:
    write_whole(order.path, junit_report(read_results(order.results)), order.force)
    return ""


KINDS: dict[str, Callable[[PlatformFile], str]] = {
    "canvas": _gradebook,
    "brightspace": _own_gradebook,
    "blackboard": _own_gradebook,
    "moodle": _moodle,
    "gradescope": lambda order: _single(order, gradescope_results),
    "prairielearn": lambda order: _single(order, prairielearn_results),
    "prairielearn-csv": _prairielearn_csv,
    "junit": _junit,
}
"""Every kind by its name on the command line."""
