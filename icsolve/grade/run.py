"""The whole of grading: files in, one sorted list of results out, and the counts of the class."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, ExitStack, nullcontext
from typing import IO, TYPE_CHECKING, NamedTuple

from icsolve.files import scratch
from icsolve.forked import can_fork, started
from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Course
from icsolve.grade.importing import Import, expand
from icsolve.grade.issues import Issue, Issues
from icsolve.grade.keys import Key
from icsolve.grade.marking import NAMED, GivenValue, Marker
from icsolve.grade.results import HEADER, json_line, line
from icsolve.grade.roster import Roster, read_roster
from icsolve.grade.solved import unknowns
from icsolve.grade.store import Disk, Store, StoredAnswer
from icsolve.grade.tables import HeaderError
from icsolve.grade.tally import Counts, added
from icsolve.grade.tolerance import NoKeyError

if TYPE_CHECKING:
    from icsolve.grade.regrade import Override, Overrides
    from icsolve.grade.variants.others import Neighbours

_WORTH_TWO = 20_000
"""Answers from which another process pays."""
_STEP = 5000
"""Results between two reports of progress."""


class Sinks(NamedTuple):
    """Where results go as they come: CSV and JSON Lines, None for neither."""

    csv: IO[str] | None = None
    jsonl: IO[str] | None = None


class ClassPart(NamedTuple):
    """The students from ``since`` on, before ``until``; all ``students`` owe answers to ``questions``."""

    questions: tuple[str, ...]
    students: tuple[str, ...]
    since: str | None
    until: str | None


class MarkingWork(NamedTuple):
    """What all parts share; ``path`` is the file of answers, for what is noted."""

    course: Course
    case_store: CaseStore
    store: Store
    path: str
    neighbours: Neighbours | None = None
    """the right answers of the whole class, where they differ"""
    overrides: Overrides | None = None
    """marks given by hand"""


class PartOutcome(NamedTuple):
    """What a part found: counts by question, what is noted, and who gave no answer."""

    counts: dict[str, Counts]
    notes: list[Issue]
    owing: dict[str, list[str]]
    given: list[GivenValue]
    """values that were given to questions with variables"""
    overruled: set[tuple[str, str]]
    """students and questions whose marks were given by hand"""


Report = Callable[[int], None]


def divided(questions: tuple[str, ...], students: list[str], answers: int, jobs: int) -> list[ClassPart]:
    """The students in as many ranges as there are processes."""
    count = jobs if can_fork() and answers >= _WORTH_TWO and len(students) >= 2 * jobs else 1
    cuts = [len(students) * k // count for k in range(count + 1)]
    bounds = [None, *(students[cut] for cut in cuts[1:-1]), None]
    return [
        ClassPart(questions, tuple(students[cuts[k] : cuts[k + 1]]), bounds[k], bounds[k + 1])
        for k in range(count)
    ]


def judged(parts: list[ClassPart], work: MarkingWork, sinks: Sinks, report: Report) -> list[PartOutcome]:
    """Judge all parts; their results go to the sinks one after the other.

    Raises RuntimeError where a process failed.
    """
    report(0)
    if len(parts) == 1:
        return [_judge(parts[0], work, work.store.sorted(), sinks, report)]
    first, *others = parts
    _foresee(first.questions, work.case_store)
    entries = work.store.sorted(None, first.until)
    with scratch() as folder:
        files = [_files(folder, n, sinks) for n in range(len(others))]
        calls = [(_apart, (part, work, names)) for part, names in zip(others, files, strict=True)]
        with started(calls) as waiting:
            own = _judge(first, work, entries, sinks, report)
            outcomes = [own, *waiting()]
        for names in files:
            for sink, name in zip(sinks, names, strict=True):
                _append(sink, name)
    return outcomes


def _foresee(questions: tuple[str, ...], case_store: CaseStore) -> None:
    """Compute all wrong answers now, once for all processes; what is there is not looked at for garbage."""
    import gc

    for question in questions:
        key = case_store.key(question)
        if isinstance(key, Key):
            key.wrongs.near(0.0)
    gc.freeze()


def _files(folder: str, n: int, sinks: Sinks) -> tuple[str, ...]:
    """The files of a part's own results; '' for a sink that there is not."""
    return tuple(os.path.join(folder, f"{n}-{k}") if sink is not None else "" for k, sink in enumerate(sinks))


def _append(sink: IO[str] | None, name: str) -> None:
    if sink is not None:
        with open(name, encoding="utf-8", newline="") as file:
            while block := file.read(1 << 20):
                sink.write(block)


def _apart(part: ClassPart, work: MarkingWork, names: tuple[str, ...]) -> PartOutcome:
    """Judge a part in a process of its own, which must not use its parent's database."""
    disk = Disk(work.store.path) if work.store.path else None
    entries = (disk or work.store).sorted(part.since, part.until)
    with ExitStack() as stack:
        if disk is not None:
            stack.callback(disk.close)
        files = [stack.enter_context(_opened(name)) for name in names]
        return _judge(part, work, entries, Sinks(*files), lambda n: None)


def _opened(name: str) -> AbstractContextManager[IO[str] | None]:
    return open(name, "w", encoding="utf-8", newline="") if name else nullcontext()


def _judge(
    part: ClassPart, work: MarkingWork, entries: Iterator[StoredAnswer], sinks: Sinks, report: Report
) -> PartOutcome:
    """Judge sorted entries."""
    issues = Issues()
    marker = Marker(work, issues, part.questions)
    csv, jsonl = sinks
    for n, result in enumerate(marker.results(entries, part.students), 1):
        if not n % _STEP:
            report(n)
        if csv is not None:
            csv.write(line(result))
        if jsonl is not None:
            jsonl.write(json_line(result))
    return PartOutcome(marker.counted(), list(issues.entries()), marker.owing, marker.given, marker.overruled)


class Job(NamedTuple):
    """What to grade: files of answers, the folder of cases, the course, who is on the roster."""

    submissions: tuple[str, ...]
    cases: str
    course: Course = Course()
    roster: str = ""
    jobs: int = 1
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


class Graded(NamedTuple):
    """What grading found: the counts by question, what was noted, how many rows and students."""

    counts: dict[str, Counts]
    notes: tuple[Issue, ...]
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
    issues = Issues()
    case_store = CaseStore(job.cases, job.course)
    if not case_store.paths:
        raise ValueError(f"there is no case in {job.cases}")
    case_store.check_course()
    job = job._replace(course=case_store.course)
    roster = read_roster(job.roster, lambda at, why: issues.note(job.roster, at, why)) if job.roster else None
    if job.variants:
        _keep_to_record(job, case_store, roster, issues)
    overrides = _overrides(job, case_store, roster)
    store = Store()
    try:
        imported = Import(store, case_store, issues, roster, progress, job.dates)
        paths = expand(job.submissions)
        _take_in(imported, paths, job)
        questions = tuple(sorted(set(job.course.questions) or _asked(imported)))
        students = sorted(set(imported.students) | set(_expected(job, roster)))
        if not imported.count:
            raise ValueError(f"there is no table of answers in {', '.join(job.submissions)}")
        parts = divided(questions, students, imported.count, job.jobs)
        if sinks.csv is not None:
            sinks.csv.write(HEADER + "\n")
        neighbours = _neighbours(case_store, students)
        work = MarkingWork(job.course, case_store, store, _shown(paths), neighbours, overrides)
        found = judged(parts, work, sinks, lambda n: progress("judging", n / imported.count))
    finally:
        store.close()
    for outcome in found:
        issues.extend(outcome.notes)
    _note_unmet(overrides, found, job, issues)
    if neighbours is not None:
        _note_other_seeds(job, case_store, [one for outcome in found for one in outcome.given], issues)
    return _graded(found, issues, case_store, imported.count, len(students))


def _overrides(job: Job, case_store: CaseStore, roster: Roster | None) -> dict[tuple[str, str], Override]:
    """The marks given by hand; a later file goes over an earlier one."""
    from icsolve.grade.regrade import read_overrides

    found: dict[tuple[str, str], Override] = {}
    for path in job.overrides:
        found |= read_overrides(path, case_store, roster)
    return found


def _note_unmet(overrides: Overrides, found: list[PartOutcome], job: Job, issues: Issues) -> None:
    """Say which marks given by hand meet no line of the results."""
    met = set().union(*(outcome.overruled for outcome in found))
    for (student, item), override in overrides.items():
        if (student, item) not in met:
            why = f"{student} owes and gave no answer to {item}, so this mark is for nobody"
            issues.note(job.overrides[-1], override.line, why, serious=True)


def _take_in(imported: Import, paths: Iterable[tuple[str, str]], job: Job) -> None:
    """Read every file; one that can't be used is told, and leaves the others alone.

    Raises the first trouble where no file has an answer, and FileNotFoundError.
    """
    first: Exception | None = None
    for path, student in paths:
        try:
            imported.read(path, job.course.columns, student or job.student)
        except FileNotFoundError:
            raise
        except (HeaderError, OSError) as error:
            first = first or error
            why = str(error).removeprefix(f"{path}: ") if isinstance(error, HeaderError) else error.strerror
            imported.unusable(path, why or str(error), student or job.student)
    if first is not None and not imported.count:
        raise first


def _neighbours(case_store: CaseStore, students: Iterable[str]) -> Neighbours | None:
    """The right answers of all students, where a case gives each other numbers."""
    if not case_store.varied:
        return None
    from icsolve.grade.variants.others import Neighbours

    return Neighbours(case_store, students)


def _note_other_seeds(job: Job, case_store: CaseStore, given: list[GivenValue], issues: Issues) -> None:
    """Say of a case most of whose answers are to the numbers of another seed which one that is."""
    from icsolve.grade.variants.others import other_seed

    for name in dict.fromkeys(one.question.partition(":")[0] for one in given):
        varied = case_store.variation(name)
        if varied is None or varied.record is not None:
            continue
        own = [one for one in given if one.question.partition(":")[0] == name]
        seed = other_seed(varied, own, job.seeds)
        if seed is not None:
            issues.note(
                _shown([(path, "") for path in job.submissions]), 0,
                f"most answers to {name} are right by the seed {seed!r}, and wrong by {job.course.seed!r}: "
                "was another seed used? --variants values.csv takes the numbers that were handed out",
            )  # fmt: skip


def _keep_to_record(job: Job, case_store: CaseStore, roster: Roster | None, issues: Issues) -> None:
    """The numbers that were handed out count; what has changed since is noted."""
    from icsolve.grade.variants.record import changes, read_records

    case_store.keep_to(read_records(job.variants, case_store, roster))
    for name, record in case_store.records.items():
        varied = case_store.variation(name)
        if varied is not None:
            for told in changes(varied, record):
                issues.note(record.path, 0, told)


def _expected(job: Job, roster: Roster | None) -> Iterable[str]:
    """Who is to hand in; where all answers are one student's, nobody else."""
    return () if roster is None or job.student else roster.people


def _shown(paths: list[tuple[str, str]]) -> str:
    """The files of answers, for messages."""
    names = [path for path, _ in paths]
    return ", ".join(names) if len(names) < 4 else f"{names[0]} and {len(names) - 1} other files"


def _graded(
    found: list[PartOutcome], issues: Issues, case_store: CaseStore, rows: int, students: int
) -> Graded:
    """The outcomes of all parts together."""
    counts = added(outcome.counts for outcome in found)
    marks = {item: tuple(_marks(case_store, item, c)) for item, c in counts.items()}
    owing = _together(outcome.owing for outcome in found)
    accepted = {item: words for item in counts if (words := _accepted(case_store, item))}
    return Graded(counts, tuple(issues.entries()), issues.serious, rows, students, marks, owing, accepted)


def _accepted(case_store: CaseStore, item: str) -> str:
    try:
        varied = case_store.variation(item.partition(":")[0]) is not None
        return "" if varied else case_store.key(item).accepted
    except NoKeyError:
        return ""


def _together(parts: Iterable[dict[str, list[str]]]) -> dict[str, tuple[str, ...]]:
    found: dict[str, list[str]] = {}
    for part in parts:
        for item, students in part.items():
            found.setdefault(item, []).extend(students)
    return {item: tuple(students[:NAMED]) for item, students in sorted(found.items())}


def _marks(case_store: CaseStore, item: str, counts: Counts) -> Iterator[tuple[str, float]]:
    """The nearest wrong answer of each mistake that was made."""
    try:
        key = case_store.key(item)
    except NoKeyError:
        return
    if isinstance(key, Key) and key.value and not case_store.variant_of(item, ""):
        for code, _ in counts.mistakes.most_common():
            found = [w.value / key.value for w in key.wrongs.all if w.code == code]
            if found:
                yield code, min(found, key=lambda ratio: abs(ratio - 1.0))


def _asked(imported: Import) -> set[str]:
    """The questions to which each student owes an answer: those with a column of their own, and the cases
    that someone answered; an intermediate answer is owed where the course, or a column, asks for it."""
    asked = set()
    for question in imported.questions:
        own = question in imported.columns or ":" not in question
        if not own and not _is_final(imported.case_store, question):
            continue
        try:
            imported.case_store.key(question, next(iter(imported.students), ""))
        except NoKeyError:
            continue
        asked.add(question)
    return asked


def _is_final(case_store: CaseStore, question: str) -> bool:
    """Whether it asks for one of several unknown loads."""
    name, _, what = question.partition(":")
    try:
        return what in unknowns(case_store.read(name))
    except NoKeyError:
        return False
