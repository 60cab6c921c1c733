"""The whole of grading: files in, one sorted list of results out, and the counts of the class."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from typing import IO

from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Course, Person, Roster, read_roster
from icsolve.grade.importing import Import, Issue, Issues, Progress, Store, expand
from icsolve.grade.keys import AnyKey, NumberKey
from icsolve.grade.marking import Counts, Marker
from icsolve.grade.results import HEADER, Override, Overrides, json_line, line, read_overrides
from icsolve.grade.solved import final_questions
from icsolve.grade.tolerance import NoKeyError
from icsolve.grade.variants.record import (
    GivenValue,
    Neighbours,
    changes,
    other_seed,
    read_records,
    to_first_values,
)
from icsolve.read.variables import values_told
from icsolve.tuples import NamedTuple

_STEP = 5000
"""Results between two reports of progress."""


class Job(NamedTuple):
    """What to grade: files of answers, the folder of cases, the course, who is on the roster."""

    submissions: tuple[str, ...]
    cases: str
    course: Course = Course()
    roster: str = ""
    student: str = ""
    """whose all answers are, where the files have no ids"""
    variants: tuple[str, ...] = ()
    """files and folders that record which numbers were handed out"""
    seeds: tuple[str, ...] = ()
    """seeds that may have been meant, should most answers be to other numbers"""
    overrides: tuple[str, ...] = ()
    """files of marks given by hand"""
    dates: str = ""
    """``day`` or ``month``: which comes first in dates with slashes"""
    group: tuple[str, ...] = ()
    """those who handed in together with the student whose all answers are"""


class Graded(NamedTuple):
    """What grading found: the counts by question, what was noted, how many rows and students."""

    counts: dict[str, Counts]
    notes: tuple[Issue, ...]
    serious: bool
    rows: int
    students: int
    silent: int
    """how many of the students gave no answer"""
    marks: dict[str, tuple[tuple[str, float], ...]]
    """of each question the known wrong answers that were given, over the right one"""
    owing: dict[str, tuple[str, ...]]
    """of each question the first students who gave no answer"""
    accepted: dict[str, str]
    """of each question that asks the same of all, what is accepted, in words"""
    people: dict[str, Person]
    """those of the roster by their ids"""


def spare_collector() -> None:
    """Millions of small tuples and no cycles: look for garbage seldom."""
    import gc

    gc.set_threshold(200_000, 20, 100)


def grade(
    job: Job,
    csv: IO[str] | None = None,
    jsonl: IO[str] | None = None,
    progress: Progress = lambda what, share: None,
) -> Graded:
    """Grade all submissions of a job.

    Parameters
    ----------
    job : files of answers, cases, course, roster
    csv, jsonl : where results go as they come, sorted by student and question; None for nowhere
    progress : told what is being done, and how much of it is, from 0 to 1

    Returns
    -------
    Graded
        Counts by question, and what was noted; what is wrong with single answers is noted, never raised.

    Raises
    ------
    HeaderError
        Where the columns of a file can't be told.
    ValueError
        Where there is no case, or a file can't be used at all.
    OSError
        Where one can't be read.
    """
    issues = Issues()
    case_store = CaseStore(job.cases, job.course)
    if not case_store.paths:
        raise ValueError(f"there is no case in {job.cases}")
    case_store.check_course()
    job = job._replace(course=case_store.course)
    roster = read_roster(job.roster, lambda at, why: issues.note(job.roster, at, why)) if job.roster else None
    if job.variants:
        _keep_to_record(job, case_store, roster, issues)
    overrides: dict[tuple[str, str], Override] = {}
    for path in job.overrides:  # a later file goes over an earlier one
        overrides |= read_overrides(path, case_store, roster)
    store = Store()
    try:
        imported = Import(store, case_store, issues, roster, progress, job.dates)
        paths = expand(job.submissions)
        errors = [imported.read(path, job.course.columns, who or job.student) for path, who in paths]
        if not imported.count and any(errors):
            raise next(filter(None, errors))
        imported.note_absent(_shown(paths))
        questions = tuple(sorted(set(job.course.own) or _asked(imported)))
        owing = () if roster is None or job.student else roster.people  # all answers may be one student's
        students = sorted({*imported.students, *owing})
        if not imported.count:
            raise ValueError(f"there is no table of answers in {', '.join(job.submissions)}")
        if csv is not None:
            csv.write(HEADER + "\n")
        groups = _groups(paths, job.group, imported)
        members = {member for some in groups.values() for member in some}
        case_store.ready(sorted({*students, *members}), (*imported.questions, *questions))
        neighbours = Neighbours(case_store, students) if case_store.varied else None
        marker = Marker(case_store, _shown(paths), issues, questions, neighbours, overrides, groups)
        for n, result in enumerate(marker.results(store.sorted(), students), 1):
            if not n % _STEP:
                progress("judging", n / imported.count)
            if csv is not None:
                csv.write(line(result))
            if jsonl is not None:
                jsonl.write(json_line(result))
    finally:
        store.close()
    _note_unmet(overrides, marker, job, issues)
    if neighbours is not None:
        _note_other_numbers(job, case_store, marker.given, issues)
    people = roster.people if roster is not None else {}
    return _graded(marker, issues, case_store, imported.count, len(students), people)


def _groups(
    paths: list[tuple[str, str]], group: tuple[str, ...], imported: Import
) -> dict[str, tuple[str, ...]]:
    """Of each student who handed in with others all of these, in one order."""
    together: dict[str, list[str]] = {"": [imported.matched((who,)) for who in group]}
    for path, who in paths:
        if who:
            together.setdefault(path, []).append(imported.matched((who,)))
    groups: dict[str, dict[str, None]] = {}
    for members in together.values():
        for member in members if len(members) > 1 else ():
            groups.setdefault(member, {}).update(dict.fromkeys(members))
    return {member: tuple(others) for member, others in groups.items()}


def _note_unmet(overrides: Overrides, marker: Marker, job: Job, issues: Issues) -> None:
    """Say which marks given by hand meet no line of the results."""
    for (student, item), override in overrides.items():
        if (student, item) not in marker.overruled:
            why = f"{student} neither owes {item} nor answered it, so this mark is for nobody"
            issues.note(job.overrides[-1], override.line, why, serious=True)


def _note_other_numbers(job: Job, case_store: CaseStore, given: list[GivenValue], issues: Issues) -> None:
    """Say of a case most of whose answers are to the numbers of another seed which one that is, and of one
    whose students were all given the numbers with which it is shown that they were."""
    for name in dict.fromkeys(one.question.partition(":")[0] for one in given):
        varied = case_store.variation(name)
        if varied is None or varied.record is not None:
            continue
        own = [one for one in given if one.question.partition(":")[0] == name]
        if to_first_values(varied, own):
            shown = values_told(varied.first)
            issues.note(
                _shown([(path, "") for path in job.submissions]), 0,
                f"most answers to {name} are right for {shown}, with which it is shown, and wrong for the "
                "numbers of each student: if all were given these, write them in place of the variables",
            )  # fmt: skip
            continue
        seed = other_seed(varied, own, job.seeds)
        if seed is not None:
            issues.note(
                _shown([(path, "") for path in job.submissions]), 0,
                f"most answers to {name} are right by the seed {seed!r}, and wrong by {job.course.seed!r}: "
                "was another seed used? --variants values.csv takes the numbers that were handed out",
            )  # fmt: skip


def _keep_to_record(job: Job, case_store: CaseStore, roster: Roster | None, issues: Issues) -> None:
    """The numbers that were handed out count; what has changed since is noted."""
    case_store.keep_to(read_records(job.variants, case_store, roster))
    for name, record in case_store.records.items():
        varied = case_store.variation(name)
        if varied is not None:
            for told in changes(varied, record):
                issues.note(record.path, 0, told)


def _shown(paths: list[tuple[str, str]]) -> str:
    """The files of answers, for messages."""
    names = [path for path, _ in paths]
    return ", ".join(names) if len(names) < 4 else f"{names[0]} and {len(names) - 1} other files"


def _graded(
    marker: Marker,
    issues: Issues,
    case_store: CaseStore,
    rows: int,
    students: int,
    people: dict[str, Person],
) -> Graded:
    """What the marker found, with what the keys tell of it."""
    counts = dict(sorted(marker.counted().items()))
    keys = {item: key for item in counts if (key := case_store.common_key(item)) is not None}
    marks = {item: tuple(_marks(key, counts[item])) for item, key in keys.items()}
    owing = {item: tuple(names) for item, names in sorted(marker.owing.items())}
    accepted = {item: key.accepted for item, key in keys.items()}
    notes, silent = tuple(issues.entries()), marker.silent
    return Graded(counts, notes, issues.serious, rows, students, silent, marks, owing, accepted, people)


def _marks(key: AnyKey, counts: Counts) -> Iterator[tuple[str, float]]:
    """The nearest wrong answer of each mistake that was made."""
    if isinstance(key, NumberKey) and key.value:
        for code, _ in counts.mistakes.most_common():
            found = [w.value / key.value for w in key.wrongs.all if w.code == code]
            if found:
                yield code, min(found, key=lambda ratio: abs(ratio - 1.0))


def _asked(imported: Import) -> set[str]:
    """The questions to which each student owes an answer: those with a column of their own, and the cases
    that someone answered; an intermediate answer is owed where the course, or a column, asks for it."""
    asked, store = set(), imported.case_store
    for question in imported.questions:
        name = question.partition(":")[0]
        with suppress(NoKeyError):
            own = question in imported.columns or ":" not in question
            if own or question in final_questions(store.read(name), name):
                store.key(question, next(iter(imported.students), ""))
                asked.add(question)
    return asked
