"""Submissions in order of student and question: in memory while they are few, else sorted on disk."""

from __future__ import annotations

import os
from bisect import bisect_left
from collections.abc import Iterable, Iterator
from contextlib import ExitStack
from itertools import islice
from typing import NamedTuple

from icsolve.files import scratch

_CREATE = (
    "create table s (student text, item text, line integer, answer text, unit text, direction text,"
    " attempt text, variant text, time text, trouble text)"
)
_INSERT = "insert into s values (?,?,?,?,?,?,?,?,?,?)"
_SELECT = "select * from s {where} order by student, item, line"
_BATCH = 5000
IN_MEMORY = 110_000
"""Submissions that are sorted in memory; more go to disk."""


class StoredAnswer(NamedTuple):
    """A submission as stored; ``item`` is the question. Order by the first three is the order of results."""

    student: str
    item: str
    line: int
    answer: str = ""
    unit: str = ""
    direction: str = ""
    attempt: str = ""
    variant: str = ""
    time: str = ""
    trouble: str = ""


class Store:
    """Entries; those on disk are in a temporary file, gone when closed."""

    def __init__(self, most: int = IN_MEMORY) -> None:
        self._few: list[StoredAnswer] = []
        self._most = most
        self._disk: Disk | None = None

    def add(self, entries: Iterable[StoredAnswer]) -> int:
        """Store entries; how many there were."""
        count = 0
        source = iter(entries)
        while batch := list(islice(source, _BATCH)):
            count += len(batch)
            if self._disk is not None:
                self._disk.add(batch)
                continue
            self._few += batch
            if len(self._few) > self._most:
                self._disk = Disk()
                self._disk.add(self._few)
                self._few = []
        return count

    @property
    def path(self) -> str:
        """The file on disk that another process can read; '' while all is in memory."""
        return self._disk.path if self._disk is not None else ""

    def sorted(self, since: str | None = None, until: str | None = None) -> Iterator[StoredAnswer]:
        """Entries by student, question and line, of the students from ``since`` on, before ``until``."""
        if self._disk is not None:
            return self._disk.sorted(since, until)
        self._few.sort()
        first = bisect_left(self._few, (since,)) if since is not None else 0
        last = bisect_left(self._few, (until,)) if until is not None else len(self._few)
        return islice(self._few, first, last)

    def close(self) -> None:
        """Forget all, and delete the file."""
        if self._disk is not None:
            self._disk.close()


class Disk:
    """A temporary database of entries; with a ``path`` one that another process has written."""

    def __init__(self, path: str = "") -> None:
        import sqlite3

        self._own = ExitStack()
        self.path = path or os.path.join(self._own.enter_context(scratch()), "answers.sqlite")
        self._database = sqlite3.connect(self.path, isolation_level=None)
        for pragma in ("journal_mode=off", "synchronous=off", "cache_size=-20000", "temp_store=file"):
            self._database.execute(f"pragma {pragma}")
        if not path:
            self._database.execute(_CREATE)

    def add(self, entries: list[StoredAnswer]) -> None:
        """Store entries."""
        cursor = self._database.cursor()
        cursor.execute("begin")
        cursor.executemany(_INSERT, entries)
        cursor.execute("commit")

    def sorted(self, since: str | None = None, until: str | None = None) -> Iterator[StoredAnswer]:
        """Entries in order, of the students from ``since`` on, before ``until``."""
        clauses = [c for c, bound in (("student >= ?", since), ("student < ?", until)) if bound is not None]
        where = f"where {' and '.join(clauses)}" if clauses else ""
        bounds = [bound for bound in (since, until) if bound is not None]
        cursor = self._database.execute(_SELECT.format(where=where), bounds)
        while batch := cursor.fetchmany(_BATCH):
            yield from map(StoredAnswer._make, batch)

    def close(self) -> None:
        """Close, and delete what is one's own."""
        self._database.close()
        self._own.close()
