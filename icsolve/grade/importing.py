"""Files of answers into the store: students matched, questions named, attempts and times read; what could not
be graded, matched or read, by reason, each with its lines.
"""

from __future__ import annotations

import io
import marshal
import os
import sys
from array import array
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, suppress
from heapq import merge
from itertools import islice, pairwise
from operator import itemgetter
from tempfile import TemporaryFile
from typing import IO

from icsolve.files import is_plain, reading
from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Roster
from icsolve.grade.results import HEADER
from icsolve.grade.tables.columns import (
    HeaderError,
    StoredAnswer,
    Submission,
    TableColumns,
    TableLayout,
    is_spoilt,
    order_of,
    year_first,
)
from icsolve.grade.tables.platforms import METADATA, exported, recognise, submissions
from icsolve.grade.tables.text import AnswerTable
from icsolve.tuples import NamedTuple

_LONGEST = 500
"""Characters of an answer that are kept; the reader takes far fewer."""
_LONGEST_NAME = 200
_MOST_TROUBLES = 10_000
_STEP = 10_000
"""Answers between two reports of progress."""
Progress = Callable[[str, float], None]
"""Told what is being done, and how much of it is, from 0 to 1."""


class Import:
    """Takes files in; remembers what questions were asked and who answered."""

    def __init__(
        self, store: Store, case_store: CaseStore, issues: Issues, roster: Roster | None, progress: Progress,
        dates: str = "",
    ) -> None:  # fmt: skip
        self.store = store
        self.case_store = case_store
        self.issues = issues
        self.roster = roster
        self._progress = progress
        self.questions: dict[str, None] = {}
        self.columns: set[str] = set()
        """questions with a column of their own"""
        self.students: dict[str, None] = {}
        self.count = 0
        self._absent: dict[str, str] | None = None
        """questions by mapped columns that no table has; None before one is read"""
        self._items: dict[str, tuple[str, str]] = {}
        self._people: dict[tuple[str, ...], str] = {}
        self._path = ""
        self._troubles: dict[tuple[str, ...], str] = {}
        """why no student can be told by these ids"""
        self._dates = dates
        self._order = ""

    def read(self, path: str, mapping: Iterable[tuple[str, str]], student: str = "") -> Exception | None:
        """Take in one file; all of it is of ``student``, if one is given.

        Where it can't be used that is noted, and it has a line in the results, for a person; the error comes
        back, unless the file is one student's alone. Raises FileNotFoundError.
        """
        try:
            self._read(path, mapping, student)
        except FileNotFoundError:
            raise
        except OSError as error:
            return self._unusable(path, error.strerror or str(error), student, error)
        except ValueError as error:
            if not student:
                return self._unusable(path, str(error), student, HeaderError(f"{path}: {error}"))
            self.matched((student,))
            self.issues.note(path, 0, f"what {student} handed in can't be used: {error}", serious=True)
        return None

    def _unusable(self, path: str, why: str, student: str, error: Exception) -> Exception:
        self.issues.note(path, 0, why, serious=True)
        whose = self.matched((student,)) if student else ""
        self.store.add([StoredAnswer(whose, "", 0, trouble=f"{os.path.basename(path)}: {why}")])
        return error

    def _read(self, path: str, mapping: Iterable[tuple[str, str]], student: str) -> None:
        self._path = path
        if student and os.path.isdir(path):
            self.matched((student,))
            self.issues.note(path, 0, f"{student} handed in no file of answers")
            return
        with io.BytesIO(sys.stdin.buffer.read()) if path == "-" else reading(path) as file:
            table = AnswerTable(file, lambda line, why: self.issues.note(path, line, why))
            columns = TableColumns(table.header, mapping, self.case_store.find, self.case_store.near)
            before = columns.absent if self._absent is None else self._absent
            self._absent = {name: before[name] for name in before if name in columns.absent}
            self._order = self._date_order(path)
            entries: Iterator[StoredAnswer]
            if student:
                entries = map(self._entry, submissions(table, columns, student))
            else:
                layout = recognise(columns)
                for note in layout.notes:
                    self.issues.note(path, 1, note)
                self.columns |= {self._item(question)[0] for question in layout.questions}
                entries = self._entries(table, layout)
            count = self.store.add(self._told(entries, file, path))
        self.count += count
        if not count:
            raise HeaderError("there is no answer in it, only a header")

    def note_absent(self, shown: str) -> None:
        """Tell which mapped columns none of the tables has, so that all would miss their questions."""
        for column, question in (self._absent or {}).items():
            why = f"no column is called '{column}', by which the answers to {question} are to be known"
            self.issues.note(shown, 1, why)

    def _told(self, entries: Iterator[StoredAnswer], file: IO[bytes], path: str) -> Iterator[StoredAnswer]:
        """The entries, with a report of how much of the file is read."""
        try:
            size = os.fstat(file.fileno()).st_size or 1
        except OSError:
            size = 0
        while some := list(islice(entries, _STEP)):
            yield from some
            if size:
                self._progress(f"reading {path}", file.tell() / size)

    def _entries(self, table: AnswerTable, layout: TableLayout) -> Iterator[StoredAnswer]:
        """Of a long table quickly where student and question were met before and the row is whole."""
        people, items, cells_of, width = self._people, self._items, layout.cells_of, len(table.header)
        for row in table.rows():
            line, cells, trouble = row
            if cells_of is not None and len(cells) == width and not trouble:
                cells.append("")
                student, question, answer, unit, direction, attempt, variant, time = cells_of(cells)
                known, found = people.get((student,)), items.get(question)
                if known and found is not None and not found[1] and len(answer) < _LONGEST:
                    if self._order:
                        time = year_first(time, self._order)
                    yield StoredAnswer(known, found[0], line, answer, unit, direction, attempt, variant, time)
                    continue
                cells.pop()
            for submission in layout.read(row):
                yield self._entry(submission)

    def _entry(self, submission: Submission) -> StoredAnswer:
        """Of a student or question that is met for the first time, or of a row that is in trouble."""
        ids, s = submission
        student = self._people.get(ids) or self.matched(ids)
        item, why = self._items.get(s.item) or self._item(s.item)
        unknown = self._troubles.get(ids, "this row has no student's id")
        trouble = s.trouble or why or ("" if student else unknown)
        variant = s.variant
        if variant.startswith("{"):
            try:
                variant = self.case_store.by_numbers(item, variant)
            except ValueError as error:
                variant, trouble = "", trouble or str(error)
        if trouble:
            self.issues.note(self._path, s.line, trouble, serious=True)
        elif self.roster is not None and student not in self.roster.people:
            said = f"the student {student!r} is not on the roster, and is graded all the same"
            self.issues.note(self._path, s.line, f"{said}{self.roster.hint(ids)}")
        answer = s.answer if len(s.answer) <= _LONGEST else s.answer[:_LONGEST] + "..."
        time = year_first(s.time, self._order) if self._order else s.time
        texts = [text[:_LONGEST] for text in (s.unit, s.direction, s.attempt, variant, time)]
        return StoredAnswer._make((student, item, s.line, answer, *texts, trouble))

    def matched(self, ids: tuple[str, ...]) -> str:
        """The student whose ids these are: by the roster, else the first id as it is written."""
        known = self.roster.people if self.roster is not None else {}
        good = tuple(name for name in ids if name in known or not is_spoilt(name))
        try:
            found = self.roster.match(good) if self.roster is not None else None
        except ValueError as error:
            return self._nobody(ids, str(error))
        if not good and ids[0]:
            why = f"the id {ids[0]!r} was rounded by a spreadsheet, and may be that of several students"
            return self._nobody(ids, f"{why}: export the table again, or give its column the format Text")
        student = found if found is not None else (good or ids)[0][:_LONGEST_NAME]
        student = student.encode("utf-8", "replace").decode("utf-8")
        if len(self._people) < 200_000:
            self._people[ids] = student
        if student:
            self.students[student] = None
        return student

    def _nobody(self, ids: tuple[str, ...], why: str) -> str:
        if len(self._troubles) < _MOST_TROUBLES:
            self._troubles[ids] = why
        return ""

    def _date_order(self, path: str) -> str:
        """``day`` or ``month``: how the dates with slashes of a file are ordered, as they themselves show."""
        if self._dates or path == "-":
            return self._dates
        with reading(path) as file:
            return order_of(file)

    def _item(self, text: str) -> tuple[str, str]:
        """The question that a text names, and why it names none."""
        question = self.case_store.find(text)
        if question is None:
            shown = " ".join(text.split())[:_LONGEST_NAME]
            why = self.case_store.no_case(shown) if shown else "this row names no case"
            found = (shown, why)
        else:
            found = (self.case_store.canonical(question) if ":" in question else question, "")
            self.questions[found[0]] = None
        if len(self._items) < 100_000:
            self._items[text] = found
        return found


def _are_results(path: str) -> bool:
    """Whether a file is what `grade` itself wrote."""
    head = (HEADER + "\n").encode()
    try:
        with open(path, "rb") as file:
            return file.read(len(head)) == head
    except OSError:
        return False


def expand(paths: Iterable[str]) -> list[tuple[str, str]]:
    """Files of answers in order, each with the student whose it is ('': it says so itself).

    A folder stands for its CSV and text files, without results that were written among them;
    Gradescope's export for what each student handed in.
    """
    found: list[tuple[str, str]] = []
    for path in paths:
        if not os.path.isdir(path):
            found.append((path, ""))
        elif os.path.isfile(os.path.join(path, METADATA)):
            found += exported(path)
        else:
            names = sorted(n for n in os.listdir(path) if n.lower().endswith((".csv", ".tsv", ".txt")))
            inside = (os.path.join(path, name) for name in names)
            found += [(name, "") for name in inside if is_plain(name) and not _are_results(name)]
    return found


LISTED = 40
"""Ranges of lines that a reason shows before it says how many more there are."""


MOST = 500
"""Reasons that are told one by one."""
OTHERS = "these rows were not graded either, each for the reason that stands in its line of the results"
OTHER_NOTES = "a note like those above, which were the first"


class Issue(NamedTuple):
    """One reason with its lines; ``serious`` where an answer was not graded for it."""

    path: str
    reason: str
    lines: tuple[int, ...]
    serious: bool

    def __str__(self) -> str:
        first = f"{self.path}:{self.lines[0]}: " if self.lines and self.lines[0] else f"{self.path}: "
        more = f" (and {ranges(self.lines[1:])})" if len(self.lines) > 1 else ""
        return f"{first}{self.reason}{more}"


class Issues:
    """Reasons in the order in which they were met."""

    def __init__(self) -> None:
        self._lines: dict[tuple[str, str, bool], array[int]] = {}

    def note(self, path: str, line: int, reason: str, serious: bool = False) -> None:
        """A line of a file and what is wrong there; line 0 for the file itself."""
        shown = "".join(c if c.isprintable() else " " for c in reason[:600])  # it can't break a terminal
        key = (path, shown, serious)
        if key not in self._lines and len(self._lines) >= MOST:
            key = (path, OTHERS if serious else OTHER_NOTES, serious)
        self._lines.setdefault(key, array("q")).append(line)

    def entries(self) -> Iterator[Issue]:
        """Every reason, those of the earliest lines first."""
        found = [
            Issue(path, reason, tuple(sorted(set(at))), s) for (path, reason, s), at in self._lines.items()
        ]
        yield from sorted(found, key=lambda entry: (entry.path, entry.lines[:1], entry.reason))

    @property
    def serious(self) -> bool:
        """Whether any answer could not be graded."""
        return any(serious for _, _, serious in self._lines)


def ranges(lines: tuple[int, ...]) -> str:
    """``lines 3, 5-9``."""
    runs: list[list[int]] = [[lines[0], lines[0]]]
    for before, line in pairwise(lines):
        if line == before + 1:
            runs[-1][1] = line
        else:
            runs.append([line, line])
    shown = ", ".join(f"{a}-{b}" if b > a else str(a) for a, b in runs[:LISTED])
    more = sum(b - a + 1 for a, b in runs[LISTED:])
    word = "line" if len(lines) == 1 else "lines"
    return f"{word} {shown}" + (f" and {more} more" if more else "")


_BATCH = 5000
IN_MEMORY = 110_000
"""Submissions that are sorted in memory; more go to disk."""


class Store:
    """Entries; of many each part that memory holds is sorted into a temporary file, and all are merged."""

    def __init__(self) -> None:
        self._few: list[StoredAnswer] = []
        self._files = ExitStack()
        self._parts: list[Iterator[StoredAnswer]] = []

    def add(self, entries: Iterable[StoredAnswer]) -> int:
        """Store entries; how many there were."""
        count = 0
        source = iter(entries)
        while batch := list(islice(source, _BATCH)):
            count += len(batch)
            self._few += batch
            if len(self._few) > IN_MEMORY:
                self._to_disk()
        return count

    def _to_disk(self) -> None:
        """Put what is in memory, sorted, into a file of its own."""
        file = self._files.enter_context(TemporaryFile())  # noqa: SIM115
        self._few.sort(key=_ORDER)
        for start in range(0, len(self._few), _BATCH):
            marshal.dump([*map(tuple, self._few[start : start + _BATCH])], file)
        file.seek(0)
        self._parts.append(_entries_of(file))
        self._few = []

    def sorted(self) -> Iterator[StoredAnswer]:
        """Entries by student and question, of those the ones that were added first."""
        self._few.sort(key=_ORDER)
        return merge(*self._parts, iter(self._few), key=_ORDER) if self._parts else iter(self._few)

    def close(self) -> None:
        """Forget all, and delete the files."""
        self._files.close()


_ORDER = itemgetter(0, 1)


def _entries_of(file: IO[bytes]) -> Iterator[StoredAnswer]:
    """The entries of a temporary file."""
    with suppress(EOFError):
        while True:
            yield from map(StoredAnswer._make, marshal.load(file))
