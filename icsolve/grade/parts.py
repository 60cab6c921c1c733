"""The students in ranges, each judged by a process of its own where that pays; results come in one order."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, nullcontext
from typing import IO, NamedTuple

from icsolve.forked import can_fork, started
from icsolve.grade.course import Course
from icsolve.grade.keys import Key
from icsolve.grade.ledger import Entry as Noted
from icsolve.grade.ledger import Ledger
from icsolve.grade.marking import Marker
from icsolve.grade.results import json_line, line
from icsolve.grade.shelf import Shelf
from icsolve.grade.store import Disk, Entry, Store
from icsolve.grade.tally import Counts

_WORTH_TWO = 20_000
"""Answers from which another process pays."""
_STEP = 5000
"""Results between two reports of progress."""


class Sinks(NamedTuple):
    """Where results go as they come: CSV and JSON Lines, None for neither."""

    csv: IO[str] | None = None
    jsonl: IO[str] | None = None


class Part(NamedTuple):
    """The students from ``since`` on, before ``until``; all ``students`` owe answers to ``questions``."""

    questions: tuple[str, ...]
    students: tuple[str, ...]
    since: str | None
    until: str | None


class Work(NamedTuple):
    """What all parts share; ``path`` is the file of answers, for what is noted."""

    course: Course
    shelf: Shelf
    store: Store
    path: str


class Outcome(NamedTuple):
    """What a part found: counts by question, what is noted, and who gave no answer."""

    counts: dict[str, Counts]
    notes: list[Noted]
    owing: dict[str, list[str]]


Report = Callable[[int], None]


def divided(questions: tuple[str, ...], students: list[str], answers: int, jobs: int) -> list[Part]:
    """The students in as many ranges as there are processes."""
    count = jobs if can_fork() and answers >= _WORTH_TWO and len(students) >= 2 * jobs else 1
    cuts = [len(students) * k // count for k in range(count + 1)]
    bounds = [None, *(students[cut] for cut in cuts[1:-1]), None]
    return [
        Part(questions, tuple(students[cuts[k] : cuts[k + 1]]), bounds[k], bounds[k + 1])
        for k in range(count)
    ]


def judged(parts: list[Part], work: Work, sinks: Sinks, report: Report) -> list[Outcome]:
    """Judge all parts; their results go to the sinks one after the other.

    Raises RuntimeError where a process failed.
    """
    report(0)
    if len(parts) == 1:
        return [_judge(parts[0], work, work.store.sorted(), sinks, report)]
    from tempfile import TemporaryDirectory

    first, *others = parts
    _foresee(first.questions, work.shelf)
    entries = work.store.sorted(None, first.until)
    with TemporaryDirectory(prefix="icsolve-grade-") as folder:
        files = [_files(folder, n, sinks) for n in range(len(others))]
        calls = [(_apart, (part, work, names)) for part, names in zip(others, files, strict=True)]
        with started(calls) as waiting:
            own = _judge(first, work, entries, sinks, report)
            outcomes = [own, *waiting()]
        for names in files:
            for sink, name in zip(sinks, names, strict=True):
                _append(sink, name)
    return outcomes


def _foresee(questions: tuple[str, ...], shelf: Shelf) -> None:
    """Compute all wrong answers now, once for all processes; what is there is not looked at for garbage."""
    import gc

    for question in questions:
        key = shelf.key(question)
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


def _apart(part: Part, work: Work, names: tuple[str, ...]) -> Outcome:
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


def _judge(part: Part, work: Work, entries: Iterator[Entry], sinks: Sinks, report: Report) -> Outcome:
    """Judge sorted entries."""
    ledger = Ledger()
    marker = Marker(work.shelf, work.course, ledger, work.path, part.questions)
    csv, jsonl = sinks
    for n, result in enumerate(marker.results(entries, part.students), 1):
        if not n % _STEP:
            report(n)
        if csv is not None:
            csv.write(line(result))
        if jsonl is not None:
            jsonl.write(json_line(result))
    return Outcome(marker.counted(), list(ledger.entries()), marker.owing)
