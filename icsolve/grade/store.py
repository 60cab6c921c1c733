"""Submissions in order of student and question: in memory while they are few, else sorted on disk."""

from __future__ import annotations

import os
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
_SELECT = "select * from s order by student, item, line"
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

    def sorted(self) -> Iterator[StoredAnswer]:
        """Entries by student, question and line."""
        if self._disk is not None:
            return self._disk.sorted()
        self._few.sort()
        return iter(self._few)

    def close(self) -> None:
        """Forget all, and delete the file."""
        if self._disk is not None:
            self._disk.close()


class Disk:
    """A temporary database of entries."""

    def __init__(self) -> None:
        import sqlite3

        self._own = ExitStack()
        path = os.path.join(self._own.enter_context(scratch()), "answers.sqlite")
        self._database = sqlite3.connect(path, isolation_level=None)
        for pragma in ("journal_mode=off", "synchronous=off", "cache_size=-20000", "temp_store=file"):
            self._database.execute(f"pragma {pragma}")
        self._database.execute(_CREATE)

    def add(self, entries: list[StoredAnswer]) -> None:
        """Store entries."""
        cursor = self._database.cursor()
        cursor.execute("begin")
        cursor.executemany(_INSERT, entries)
        cursor.execute("commit")

    def sorted(self) -> Iterator[StoredAnswer]:
        """Entries in order."""
        cursor = self._database.execute(_SELECT)
        while batch := cursor.fetchmany(_BATCH):
            yield from map(StoredAnswer._make, batch)

    def close(self) -> None:
        """Close and delete it."""
        self._database.close()
        self._own.close()
