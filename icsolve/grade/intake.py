"""Files of answers into the store: students matched, questions named, attempts and times read."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator

from icsolve.grade.ledger import Ledger
from icsolve.grade.moments import NEVER, attempt_number, moment
from icsolve.grade.people import Roster
from icsolve.grade.shelf import Shelf
from icsolve.grade.store import Entry, Store
from icsolve.grade.tables import Columns, HeaderError, Layout, Submission, Table, recognise

_LONGEST = 500
"""Characters of an answer that are kept; the reader takes far fewer."""
_LONGEST_NAME = 200


class Intake:
    """Takes files in; remembers what questions were asked and who answered."""

    def __init__(self, store: Store, shelf: Shelf, ledger: Ledger, roster: Roster | None) -> None:
        self.store = store
        self.shelf = shelf
        self.ledger = ledger
        self.roster = roster
        self.questions: dict[str, None] = {}
        self.students: dict[str, None] = {}
        self.count = 0
        self._items: dict[str, tuple[str, str]] = {}
        self._people: dict[tuple[str, ...], str] = {}
        self._times: dict[str, float] = {}
        self._path = ""

    def read(self, path: str, mapping: Iterable[tuple[str, str]]) -> Layout:
        """Take in one file.

        Raises HeaderError or ValueError where the file can't be used, with a sentence; OSError.
        """
        self._path = path
        with open(path, "rb") as file:
            table = Table(file, lambda line, why: self.ledger.note(path, line, why))
            layout = recognise(Columns(table.header, mapping, self.shelf.find))
            for note in layout.notes:
                self.ledger.note(path, 1, note)
            self.questions |= dict.fromkeys(self._item(question)[0] for question in layout.questions)
            self.count += self.store.add(self._entries(table, layout))
        if not self.count:
            raise HeaderError("there is no answer in it, only a header")
        return layout

    def _entries(self, table: Table, layout: Layout) -> Iterator[Entry]:
        read, entry = layout.read, self._entry
        for row in table.rows():
            for submission in read(row):
                yield entry(submission)

    def _entry(self, s: Submission) -> Entry:
        student = self._people.get(s.student)
        if student is None:
            student = self._matched(s.student)
        item, why = self._items.get(s.question) or self._item(s.question)
        trouble = s.trouble or why or ("" if student else "this row has no student's id")
        time = self._times.get(s.time)
        if time is None:
            time = self._time(s.time, s.line)
        attempt = attempt_number(s.attempt) if s.attempt else 0
        if trouble:
            self.ledger.note(self._path, s.line, trouble, serious=True)
        elif self.roster is not None and student not in self.roster.people:
            self.ledger.note(self._path, s.line, self._stranger(student, s.student))
        answer = s.answer if len(s.answer) <= _LONGEST else s.answer[:_LONGEST] + "..."
        tried = s.attempt if len(s.attempt) < _LONGEST_NAME else ""
        return Entry(
            student, item, attempt, time, s.line, answer, s.unit[:_LONGEST], s.direction[:_LONGEST], tried,
            s.variant[:_LONGEST_NAME], trouble,
        )  # fmt: skip

    def _matched(self, ids: tuple[str, ...]) -> str:
        """The student whose ids these are: by the roster, else the first id as it is written."""
        found = self.roster.match(ids) if self.roster is not None else None
        student = found if found is not None else ids[0][:_LONGEST_NAME]
        student = student.encode("utf-8", "replace").decode("utf-8")
        if len(self._people) < 200_000:
            self._people[ids] = student
        if student:
            self.students[student] = None
        return student

    def _stranger(self, student: str, ids: tuple[str, ...]) -> str:
        assert self.roster is not None
        return (
            f"the student {student!r} is not on the roster, and is graded all the same{self.roster.hint(ids)}"
        )

    def _item(self, text: str) -> tuple[str, str]:
        """The question that a text names, and why it names none."""
        question = self.shelf.find(text)
        if question is None:
            shown = " ".join(text.split())[:_LONGEST_NAME]
            why = f"there is no case '{shown[:60]}'" if shown else "this row names no case"
            found = (shown, why)
        else:
            found = (self.shelf.canonical(question) if ":" in question else question, "")
            self.questions[found[0]] = None
        if len(self._items) < 100_000:
            self._items[text] = found
        return found

    def _time(self, text: str, line: int) -> float:
        found = moment(text)
        if found is None:
            self.ledger.note(
                self._path, line, "this time can't be read; the order of the rows tells which is last"
            )
            found = NEVER
        if len(self._times) < 100_000:
            self._times[text] = found
        return found


def expand(paths: Iterable[str]) -> list[str]:
    """Files, and the CSV files of folders, in order."""
    found: list[str] = []
    for path in paths:
        if os.path.isdir(path):
            names = sorted(n for n in os.listdir(path) if n.lower().endswith((".csv", ".tsv", ".txt")))
            found += [os.path.join(path, name) for name in names]
        else:
            found.append(path)
    return found
