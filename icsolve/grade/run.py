"""The whole of grading: files in, one sorted list of results out, and the counts of the class."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack
from typing import IO, NamedTuple

from icsolve.grade.course import Course
from icsolve.grade.intake import Intake, expand
from icsolve.grade.keys import Key, NoKeyError
from icsolve.grade.ledger import Entry as Noted
from icsolve.grade.ledger import Ledger
from icsolve.grade.marking import NAMED, Marker
from icsolve.grade.people import Roster, read_roster
from icsolve.grade.questions import unknowns
from icsolve.grade.results import HEADER, json_line, line
from icsolve.grade.shelf import Shelf
from icsolve.grade.store import Disk, Entry, Store
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


def spare_collector() -> None:
    """Millions of small tuples and no cycles: look for garbage seldom."""
    import gc

    gc.set_threshold(200_000, 20, 100)


class Part(NamedTuple):
    """The work of one process: the students from ``since`` on, before ``until``."""

    job: Job
    store: str
    path: str
    questions: tuple[str, ...]
    students: tuple[str, ...]
    since: str | None
    until: str | None
    csv: str
    jsonl: str


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


class Sinks(NamedTuple):
    """Where results go as they come: CSV and JSON Lines, None for neither."""

    csv: IO[str] | None = None
    jsonl: IO[str] | None = None


Progress = Callable[[str, float], None]
"""Told what is being done, and how much of it is, from 0 to 1."""
_STEP = 5000
"""Results between two reports of progress."""


def silent(what: str, share: float) -> None:
    """No report."""


def grade(job: Job, sinks: Sinks, progress: Progress = silent) -> Graded:
    """Grade all submissions of a job; results go to the sinks, sorted by student and question.

    Raises HeaderError, ValueError or OSError where a file can't be used at all.
    """
    ledger = Ledger()
    shelf = Shelf(job.cases, job.course)
    if not shelf.paths:
        raise ValueError(f"there is no case in {job.cases}")
    roster = read_roster(job.roster, lambda at, why: ledger.note(job.roster, at, why)) if job.roster else None
    with ExitStack() as stack:
        store = Store()
        stack.callback(store.close)
        intake = Intake(store, shelf, ledger, roster, job.student)
        paths = expand(job.submissions)
        for n, path in enumerate(paths):
            progress(f"reading {path}", n / len(paths))
            intake.read(path, job.course.columns)
        folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="icsolve-grade-"))
        parts = list(_parts(job, intake, roster, store.path, ", ".join(paths), folder, sinks))
        found = list(_done(parts, shelf, store, lambda n: progress("judging", n / max(intake.count, 1))))
        _join(parts, sinks)
        for _, notes, _ in found:
            ledger.extend(notes)
        counts = added(counts for counts, _, _ in found)
        owing = _together(owing for _, _, owing in found)
        students = len(parts[0].students) if len(parts) == 1 else sum(len(part.students) for part in parts)
    marks = {item: tuple(_marks(shelf, item, c)) for item, c in counts.items()}
    return Graded(counts, tuple(ledger.entries()), ledger.serious, intake.count, students, marks, owing)


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


def _parts(
    job: Job, intake: Intake, roster: Roster | None, store: str, path: str, folder: str, sinks: Sinks
) -> Iterator[Part]:
    """The students in as many ranges as there are processes."""
    questions = tuple(sorted(set(job.course.questions) or _asked(intake)))
    students = sorted(set(intake.students) | set(roster.people if roster is not None else ()))
    count = job.jobs if store and len(students) >= 2 * job.jobs else 1
    cuts = [students[len(students) * k // count] for k in range(1, count)]
    for n, (since, until) in enumerate(zip([None, *cuts], [*cuts, None], strict=True)):
        own = tuple(s for s in students if (since is None or s >= since) and (until is None or s < until))
        csv = os.path.join(folder, f"{n}.csv") if sinks.csv is not None else ""
        jsonl = os.path.join(folder, f"{n}.jsonl") if sinks.jsonl is not None else ""
        yield Part(job, store, path, questions, own, since, until, csv, jsonl)


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


Outcome = tuple[dict[str, Counts], list[Noted], dict[str, list[str]]]


def _done(parts: list[Part], shelf: Shelf, store: Store, report: Callable[[int], None]) -> Iterable[Outcome]:
    """Each part's outcome: of one part here, of several in as many processes."""
    report(0)
    if len(parts) == 1:
        return [_judged(parts[0], shelf, store.sorted(), report)]
    from concurrent.futures import ProcessPoolExecutor

    with ProcessPoolExecutor(len(parts)) as pool:
        return list(pool.map(work, parts))


def work(part: Part) -> Outcome:
    """Judge the answers of one range of students, in a process of its own."""
    spare_collector()
    disk = Disk(part.store)
    try:
        return _judged(part, Shelf(part.job.cases, part.job.course), disk.sorted(part.since, part.until))
    finally:
        disk.close()


def _judged(
    part: Part, shelf: Shelf, entries: Iterator[Entry], report: Callable[[int], None] = lambda n: None
) -> Outcome:
    """Judge sorted entries; results go to the part's own files."""
    ledger = Ledger()
    marker = Marker(shelf, part.job.course, ledger, part.path, part.questions)
    with ExitStack() as stack:
        csv = stack.enter_context(open(part.csv, "w", encoding="utf-8", newline="")) if part.csv else None
        jsonl = (
            stack.enter_context(open(part.jsonl, "w", encoding="utf-8", newline="")) if part.jsonl else None
        )
        for n, result in enumerate(marker.results(entries, part.students), 1):
            if not n % _STEP:
                report(n)
            if csv is not None:
                csv.write(line(result))
            if jsonl is not None:
                jsonl.write(json_line(result))
    return marker.counted(), list(ledger.entries()), marker.owing


def _join(parts: list[Part], sinks: Sinks) -> None:
    """The parts' files one after the other, under one header."""
    if sinks.csv is not None:
        sinks.csv.write(HEADER + "\n")
    for sink, names in ((sinks.csv, [p.csv for p in parts]), (sinks.jsonl, [p.jsonl for p in parts])):
        for name in names if sink is not None else ():
            assert sink is not None
            with open(name, encoding="utf-8", newline="") as file:
                shutil.copyfileobj(file, sink, 1 << 20)


def processes() -> int:
    """Two processes where the machine has two cores."""
    return min(2, os.cpu_count() or 1)
