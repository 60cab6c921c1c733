"""Files of answers into the store: students matched, questions named, attempts and times read."""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from typing import IO

from icsolve.files import is_plain, reading
from icsolve.grade.case_store import CaseStore
from icsolve.grade.issues import Issues
from icsolve.grade.results import HEADER
from icsolve.grade.roster import Roster
from icsolve.grade.store import Store, StoredAnswer
from icsolve.grade.tables import Columns, HeaderError, Submission, Table, TableLayout, recognise
from icsolve.grade.tables.columns import is_spoilt
from icsolve.grade.tables.hand_ins import METADATA, exported, submissions
from icsolve.grade.timestamps import order_of, year_first

_LONGEST = 500
"""Characters of an answer that are kept; the reader takes far fewer."""
_LONGEST_NAME = 200
_MOST_TROUBLES = 10_000
_STEP = 10_000
"""Answers between two reports of progress."""
Progress = Callable[[str, float], None]


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
        self._items: dict[str, tuple[str, str]] = {}
        self._people: dict[tuple[str, ...], str] = {}
        self._path = ""
        self._troubles: dict[tuple[str, ...], str] = {}
        """why no student can be told by these ids"""
        self._dates = dates
        self._order = ""

    def read(self, path: str, mapping: Iterable[tuple[str, str]], student: str = "") -> None:
        """Take in one file; all of it is of ``student``, if one is given.

        Raises HeaderError where the file can't be used, with its name and a sentence; OSError.
        """
        try:
            self._read(path, mapping, student)
        except (HeaderError, ValueError) as error:
            if not student:
                raise HeaderError(f"{path}: {error}") from None
            self._matched((student,))
            self.issues.note(path, 0, f"what {student} handed in can't be used: {error}", serious=True)

    def _read(self, path: str, mapping: Iterable[tuple[str, str]], student: str) -> None:
        self._path = path
        if student and os.path.isdir(path):
            self._matched((student,))
            self.issues.note(path, 0, f"{student} handed in no file of answers")
            return
        with _opened(path) as file:
            table = Table(file, lambda line, why: self.issues.note(path, line, why))
            near = self.case_store.near
            columns = Columns(table.header, mapping, self.case_store.find, lambda text: bool(near(text)))
            self._order = self._date_order(path, table.header)
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

    def unusable(self, path: str, why: str, student: str) -> None:
        """Note a file without a readable answer; it has a line in the results, for a person."""
        self.issues.note(path, 0, why, serious=True)
        whose = self._matched((student,)) if student else ""
        self.store.add([StoredAnswer(whose, "", 0, trouble=f"{os.path.basename(path)}: {why}")])

    def _told(self, entries: Iterator[StoredAnswer], file: IO[bytes], path: str) -> Iterator[StoredAnswer]:
        """The entries, with a report of how much of the file is read."""
        try:
            size = os.fstat(file.fileno()).st_size
        except OSError:
            return entries
        return self._counted(entries, file, path, size or 1)

    def _counted(
        self, entries: Iterator[StoredAnswer], file: IO[bytes], path: str, size: int
    ) -> Iterator[StoredAnswer]:
        while some := list(islice(entries, _STEP)):
            yield from some
            self._progress(f"reading {path}", file.tell() / size)

    def _entries(self, table: Table, layout: TableLayout) -> Iterator[StoredAnswer]:
        if layout.cells_of is not None:
            yield from self._long_entries(table, layout, layout.cells_of)
            return
        for row in table.rows():
            for submission in layout.read(row):
                yield self._entry(submission)

    def _long_entries(
        self, table: Table, layout: TableLayout, cells_of: Callable[[list[str]], tuple[str, ...]]
    ) -> Iterator[StoredAnswer]:
        """Of a long table: quickly where student and question were met before and the row is whole."""
        people, items, width = self._people, self._items, len(table.header)
        for row in table.rows():
            line, cells, trouble = row
            if len(cells) == width and not trouble:
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

    def _entry(self, s: Submission) -> StoredAnswer:
        """Of a student or question that is met for the first time, or of a row that is in trouble."""
        student = self._people.get(s.student) or self._matched(s.student)
        item, why = self._items.get(s.question) or self._item(s.question)
        unknown = self._troubles.get(s.student, "this row has no student's id")
        trouble = s.trouble or why or ("" if student else unknown)
        if trouble:
            self.issues.note(self._path, s.line, trouble, serious=True)
        elif self.roster is not None and student not in self.roster.people:
            self.issues.note(self._path, s.line, self._stranger(student, s.student))
        answer = s.answer if len(s.answer) <= _LONGEST else s.answer[:_LONGEST] + "..."
        time = year_first(s.time, self._order) if self._order else s.time
        texts = [text[:_LONGEST] for text in (s.unit, s.direction, s.attempt, s.variant, time)]
        return StoredAnswer._make((student, item, s.line, answer, *texts, trouble))

    def _matched(self, ids: tuple[str, ...]) -> str:
        """The student whose ids these are: by the roster, else the first id as it is written."""
        known = self.roster.people if self.roster is not None else {}
        good = tuple(name for name in ids if name in known or not is_spoilt(name))
        try:
            found = self.roster.match(good) if self.roster is not None else None
        except ValueError as error:
            return self._nobody(ids, str(error))
        if not good and ids[0]:
            return self._nobody(
                ids,
                f"the id {ids[0]!r} was rounded by a spreadsheet, and may be that of several students: "
                f"export the "
                "table again, or give its column the format Text",
            )
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

    def _date_order(self, path: str, header: list[str]) -> str:
        """``day`` or ``month``: how the dates with slashes of a file are ordered, as they themselves show."""
        if self._dates or path == "-":
            return self._dates
        with reading(path) as file:
            return order_of(file)

    def _stranger(self, student: str, ids: tuple[str, ...]) -> str:
        assert self.roster is not None
        return (
            f"the student {student!r} is not on the roster, and is graded all the same{self.roster.hint(ids)}"
        )

    def _item(self, text: str) -> tuple[str, str]:
        """The question that a text names, and why it names none."""
        question = self.case_store.find(text)
        if question is None:
            shown = " ".join(text.split())[:_LONGEST_NAME]
            why = f"there is no case '{shown[:60]}'" if shown else "this row names no case"
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


def _opened(path: str) -> IO[bytes]:
    """A file; ``-`` is standard input."""
    return io.BytesIO(sys.stdin.buffer.read()) if path == "-" else reading(path)


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
