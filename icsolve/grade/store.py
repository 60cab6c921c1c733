"""Submissions in order of student and question, sorted on disk so that memory stays bounded."""

from __future__ import annotations

import os
import sqlite3
import tempfile
from collections.abc import Iterable, Iterator
from typing import NamedTuple

_CREATE = """
create table s (student text, item text, attempt integer, time real, line integer, answer text, unit text,
 direction text, tried text, variant text, trouble text)
"""
_INSERT = "insert into s values (?,?,?,?,?,?,?,?,?,?,?)"
_SELECT = "select * from s {where} order by student, item, attempt, time, line"
_BATCH = 5000


class Entry(NamedTuple):
    """A submission as stored; ``item`` is the question, a case's own before its intermediate ones."""

    student: str
    item: str
    attempt: int
    time: float
    line: int
    answer: str
    unit: str
    direction: str
    tried: str
    variant: str
    trouble: str


class Store:
    """A temporary database of entries; gone when closed."""

    def __init__(self, path: str | None = None) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="icsolve-grade-") if path is None else None
        self.path = (
            os.path.join(self._folder.name, "answers.sqlite") if self._folder is not None else path or ""
        )
        self._database = sqlite3.connect(self.path, isolation_level=None)
        for pragma in (
            "journal_mode=off",
            "synchronous=off",
            "cache_size=-20000",
            "temp_store=file",
        ):
            self._database.execute(f"pragma {pragma}")
        if self._folder is not None:
            self._database.execute(_CREATE)

    def add(self, entries: Iterable[Entry]) -> int:
        """Store entries; how many there were."""
        cursor = self._database.cursor()
        cursor.execute("begin")
        before = self._database.total_changes
        cursor.executemany(_INSERT, entries)
        cursor.execute("commit")
        return self._database.total_changes - before

    def sorted(self, since: str | None = None, until: str | None = None) -> Iterator[Entry]:
        """Entries by student, question, attempt, time and line: students from ``since`` up to ``until``."""
        clauses = [c for c, bound in (("student >= ?", since), ("student < ?", until)) if bound is not None]
        where = f"where {' and '.join(clauses)}" if clauses else ""
        bounds = [bound for bound in (since, until) if bound is not None]
        cursor = self._database.execute(_SELECT.format(where=where), bounds)
        while batch := cursor.fetchmany(_BATCH):
            yield from map(Entry._make, batch)

    def close(self) -> None:
        """Close and delete."""
        self._database.close()
        if self._folder is not None:
            self._folder.cleanup()
