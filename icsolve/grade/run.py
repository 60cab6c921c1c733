"""The whole of grading: files in, one sorted list of results out, and the counts of the class."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple

from icsolve.grade.course import Course
from icsolve.grade.intake import Intake, expand
from icsolve.grade.keys import Key, NoKeyError
from icsolve.grade.ledger import Entry as Noted
from icsolve.grade.ledger import Ledger
from icsolve.grade.marking import NAMED
from icsolve.grade.parts import Outcome, Sinks, Work, divided, judged
from icsolve.grade.people import Roster, read_roster
from icsolve.grade.questions import unknowns
from icsolve.grade.results import HEADER
from icsolve.grade.shelf import Shelf
from icsolve.grade.store import Store
from icsolve.grade.tally import Counts, added


class Job(NamedTuple):
    """What to grade: files of answers, the folder of cases, the course, who is on the roster."""

    submissions: tuple[str, ...]
    cases: str
    course: Course = Course()
    roster: str = ""
    jobs: int = 1
    student: str = ""
    """whose all answers are, where the files have no ids"""


class Graded(NamedTuple):
    """What grading found: the counts by question, what was noted, how many rows and students."""

    counts: dict[str, Counts]
    notes: tuple[Noted, ...]
    serious: bool
    rows: int
    students: int
    marks: dict[str, tuple[tuple[str, float], ...]]
    """of each question the known wrong answers that were given, over the right one"""
    owing: dict[str, tuple[str, ...]]
    """of each question the first students who gave no answer"""
    accepted: dict[str, str]
    """of each question that asks the same of all, what is accepted, in words"""


Progress = Callable[[str, float], None]
"""Told what is being done, and how much of it is, from 0 to 1."""


def silent(what: str, share: float) -> None:
    """No report."""


def spare_collector() -> None:
    """Millions of small tuples and no cycles: look for garbage seldom."""
    import gc

    gc.set_threshold(200_000, 20, 100)


def processes() -> int:
    """Two processes where a second core has nothing else to do."""
    busy = os.getloadavg()[0] if hasattr(os, "getloadavg") else 0.0
    return 2 if (os.cpu_count() or 1) - busy >= 0.8 else 1


def grade(job: Job, sinks: Sinks, progress: Progress = silent) -> Graded:
    """Grade all submissions of a job; results go to the sinks, sorted by student and question.

    Raises HeaderError, ValueError or OSError where a file can't be used at all.
    """
    ledger = Ledger()
    shelf = Shelf(job.cases, job.course)
    if not shelf.paths:
        raise ValueError(f"there is no case in {job.cases}")
    roster = read_roster(job.roster, lambda at, why: ledger.note(job.roster, at, why)) if job.roster else None
    store = Store()
    try:
        intake = Intake(store, shelf, ledger, roster, progress)
        paths = expand(job.submissions)
        for path, student in paths:
            intake.read(path, job.course.columns, student or job.student)
        questions = tuple(sorted(set(job.course.questions) or _asked(intake)))
        students = sorted(set(intake.students) | set(_expected(job, roster)))
        progress("drawing variants", 0.0)
        shelf.foresee(intake.questions, students)
        if not intake.count:
            raise ValueError(f"there is no table of answers in {', '.join(job.submissions)}")
        parts = divided(questions, students, intake.count, job.jobs)
        if sinks.csv is not None:
            sinks.csv.write(HEADER + "\n")
        work = Work(job.course, shelf, store, _shown(paths))
        found = judged(parts, work, sinks, lambda n: progress("judging", n / intake.count))
    finally:
        store.close()
    return _graded(found, ledger, shelf, intake.count, len(students))


def _expected(job: Job, roster: Roster | None) -> Iterable[str]:
    """Who is to hand in; where all answers are one student's, nobody else."""
    return () if roster is None or job.student else roster.people


def _shown(paths: list[tuple[str, str]]) -> str:
    """The files of answers, for messages."""
    names = [path for path, _ in paths]
    return ", ".join(names) if len(names) < 4 else f"{names[0]} and {len(names) - 1} other files"


def _graded(found: list[Outcome], ledger: Ledger, shelf: Shelf, rows: int, students: int) -> Graded:
    """The outcomes of all parts together."""
    for outcome in found:
        ledger.extend(outcome.notes)
    counts = added(outcome.counts for outcome in found)
    marks = {item: tuple(_marks(shelf, item, c)) for item, c in counts.items()}
    owing = _together(outcome.owing for outcome in found)
    accepted = {item: words for item in counts if (words := _accepted(shelf, item))}
    return Graded(counts, tuple(ledger.entries()), ledger.serious, rows, students, marks, owing, accepted)


def _accepted(shelf: Shelf, item: str) -> str:
    try:
        return "" if shelf.variation(item.partition(":")[0]) is not None else shelf.key(item).accepted
    except NoKeyError:
        return ""


def _together(parts: Iterable[dict[str, list[str]]]) -> dict[str, tuple[str, ...]]:
    found: dict[str, list[str]] = {}
    for part in parts:
        for item, students in part.items():
            found.setdefault(item, []).extend(students)
    return {item: tuple(students[:NAMED]) for item, students in sorted(found.items())}


def _marks(shelf: Shelf, item: str, counts: Counts) -> Iterator[tuple[str, float]]:
    """The nearest wrong answer of each mistake that was made."""
    try:
        key = shelf.key(item)
    except NoKeyError:
        return
    if isinstance(key, Key) and key.value and not shelf.variant_of(item, ""):
        for code, _ in counts.mistakes.most_common():
            found = [w.value / key.value for w in key.wrongs.all if w.code == code]
            if found:
                yield code, min(found, key=lambda ratio: abs(ratio - 1.0))


def _asked(intake: Intake) -> set[str]:
    """The questions to which each student owes an answer: those with a column of their own, and the cases
    that someone answered; an intermediate answer is owed where the course, or a column, asks for it."""
    asked = set()
    for question in intake.questions:
        if ":" in question and question not in intake.columns and not _is_final(intake.shelf, question):
            continue
        try:
            intake.shelf.key(question, next(iter(intake.students), ""))
        except NoKeyError:
            continue
        asked.add(question)
    return asked


def _is_final(shelf: Shelf, question: str) -> bool:
    """Whether it asks for one of several unknown loads."""
    name, _, what = question.partition(":")
    try:
        return what in unknowns(shelf.read(name))
    except NoKeyError:
        return False


__all__ = ["Graded", "Job", "Sinks", "grade", "processes", "silent", "spare_collector"]
