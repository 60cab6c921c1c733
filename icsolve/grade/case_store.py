"""The cases of a folder, solved once each when first asked for, and the keys of their questions."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator
from contextlib import suppress

from icsolve.case import Case
from icsolve.errors import CaseError, SceneError
from icsolve.files import files_of, reading, reading_text
from icsolve.grade.course import Course
from icsolve.grade.keys import AnyKey
from icsolve.grade.solved import (
    SolvedCase,
    asked_of,
    canonical,
    check_plane,
    folder_of,
    questions_of,
    unknowns,
)
from icsolve.grade.tolerance import NoKeyError
from icsolve.grade.variants.varied import VariantRecord, Varied
from icsolve.grade.written.numerals import without_unseen
from icsolve.read import case_name, read_file

_MOST_SLIPS = 200
"""Names that are no case for which one that may be meant is looked for."""
_LONGEST_SLIP = 60


class CaseStore:
    """The cases of a folder (and those in it) by name."""

    def __init__(self, folder: str | os.PathLike[str], course: Course) -> None:
        self.course = course
        self.folder = os.fspath(folder)
        self.paths: dict[str, str] = {}
        self.twice: dict[str, tuple[str, str]] = {}
        for path in _yaml_files(self.folder):
            name = case_name(path)
            if name in self.paths:
                self.twice[name] = (self.paths[name], path)
            self.paths.setdefault(name, path)
        self.varied = False
        """whether a case with variables has been met"""
        self._lower = {name.lower(): name for name in self.paths}
        self._near: dict[str, str] = {}
        self._solved: dict[str, SolvedCase | Varied | NoKeyError] = {}
        self._cases: dict[str, Case] = {}
        self._common: dict[str, AnyKey] = {}
        """the keys that were asked for, of questions that ask the same of all"""
        self.records: dict[str, VariantRecord] = {}
        """the numbers that were handed out, by case"""

    def find(self, text: str) -> str | None:
        """The question that a text names, by the name of its case's file and what is asked of it."""
        case, colon, what = without_unseen(text).strip().partition(":")
        case = case.removesuffix(".yaml").removesuffix(".yml")
        name = case.strip() if case.strip() in self.paths else self._lower.get(case.strip().lower())
        if name is None and not colon:
            return self._of_folder(case.strip())
        what = what.strip()
        if name is None or not (colon and what) or self._are_words(name, what):
            return name
        return f"{name}:{what}"

    def _of_folder(self, text: str) -> str | None:
        """The question that has this name as a folder (``press-w4-w2``)."""
        for name in self.paths:
            if text.startswith(f"{folder_of(name)}-"):
                with suppress(NoKeyError):
                    for question in questions_of(self.read(name), name, self.course):
                        if folder_of(question) == text:
                            return question
        return None

    def _are_words(self, name: str, what: str) -> bool:
        """Whether what follows a case's name is a title (``press: find T``), and nothing that is asked."""
        first, _, rest = what.partition(" ")
        return bool(rest) and first not in ("v", "h", "rf", "T") and bool(self._why_not_asked(name, what))

    def check_course(self) -> None:
        """Take the questions of the course by their one names.

        Raises ValueError, with the place in the course, for one that no case can answer: all would miss it.
        """
        if os.path.isfile(self.folder):
            return
        own = {}
        for text, fields in self.course.own.items():
            question = self.find(text)
            if question is None:
                why = self.no_case(text)
            else:
                name, _, what = question.partition(":")
                question = self.canonical(question)
                why = self._why_not_asked(name, what)
            if why:
                raise ValueError(f"{self.course.places.get(text, 'course')}: {why}")
            own[question or text] = fields
        self.course = self.course._replace(own=own)

    def _why_not_asked(self, name: str, what: str) -> str:
        """Why a course can't ask this of a case; '' where it can, or the case itself can't be read."""
        try:
            case = self.read(name)
        except NoKeyError:
            return ""
        if not what and len(unknowns(case)) != 1:
            return ""
        try:
            asked_of(case, what)
        except NoKeyError as error:
            return str(error)
        return ""

    def near(self, text: str) -> str:
        """The case whose name a text that names none is most like; '' for none."""
        from difflib import get_close_matches

        name = text.partition(":")[0].strip().lower()[:_LONGEST_SLIP]
        if name not in self._near and len(self._near) < _MOST_SLIPS:
            found = get_close_matches(name, list(self._lower), 1, 0.75)
            self._near[name] = self._lower[found[0]] if found else ""
        return self._near.get(name, "")

    def meant(self, text: str) -> str:
        """The question that may be meant by a text that names none; '' for none."""
        near = self.near(text)
        question = self.find("".join((near, *text.partition(":")[1:]))) if near else None
        return self.canonical(question) if question else ""

    def no_case(self, text: str) -> str:
        """That there is no such case, and which may be meant."""
        near = self.near(text)
        return f"there is no case '{text[:60]}'" + (f"; did you mean '{near}'?" if near else "")

    def solved(self, name: str, student: str = "") -> SolvedCase:
        """The case of that name, solved; with the student's own values, if it has variables.

        Raises NoKeyError where there is none, or it has no answer; the message says why.
        """
        found = self._found(name)
        if isinstance(found, NoKeyError):
            raise found
        return found if isinstance(found, SolvedCase) else found.solved(student)

    def _found(self, name: str) -> SolvedCase | Varied | NoKeyError:
        """The case of that name, or why there is none; made once."""
        if name not in self._solved:
            self._solved[name] = self._made(name)
        return self._solved[name]

    def _made(self, name: str) -> SolvedCase | Varied | NoKeyError:
        try:
            case = self.read(name)
            if not case.variables:
                return SolvedCase(case, self.course)
            check_plane(case)  # before any of its variants is looked at
            self.varied = True
            return Varied(name, self.text(name), self.paths[name], self.course)
        except SceneError as error:
            return NoKeyError(f"the case {name} has no answer ({error.status}): {error.message}")
        except NoKeyError as error:
            return error

    def variation(self, name: str) -> Varied | None:
        """The case as one with variables; None where it has none, or can't be read."""
        found = self._found(name)
        return found if isinstance(found, Varied) else None

    def keep_to(self, records: dict[str, VariantRecord]) -> None:
        """Take the numbers that were handed out for those of the students."""
        self.records = records
        for name, record in records.items():
            varied = self.variation(name)
            if varied is not None:
                varied.record = record

    def read(self, name: str) -> Case:
        """The case of that name.

        Raises NoKeyError.
        """
        if name in self.twice:
            raise NoKeyError(f"two files are the case {name}: {' and '.join(self.twice[name])}")
        if name not in self.paths:
            raise NoKeyError(self.no_case(name))
        try:
            if name not in self._cases:
                self._cases[name] = read_file(self.paths[name])
            return self._cases[name]
        except CaseError as error:
            raise NoKeyError(f"the case {name} can't be read: {error.problems[0]}") from None

    def key(self, question: str, student: str = "") -> AnyKey:
        """The key of a question, for a case with variables that of the student's own values.

        Raises NoKeyError.
        """
        key = self._common.get(question)
        if key is None:
            name = question.partition(":")[0]
            key = self.solved(name, student).key(question)
            if self.variation(name) is None:
                self._common[question] = key
        return key

    def common_key(self, question: str) -> AnyKey | None:
        """The key of a question that asks the same of all; None where there is none."""
        if question in self._common:
            return self._common[question]
        try:
            return self.key(question) if self.variation(question.partition(":")[0]) is None else None
        except NoKeyError:
            return None

    def variant_of(self, question: str, student: str) -> str:
        """The label of the student's values; '' for a case without variables."""
        name = question.partition(":")[0]
        varied = self.variation(name) if name in self.paths else None
        if varied is None:
            return ""
        try:
            return varied.draw(student).label
        except NoKeyError:
            return ""

    def by_numbers(self, question: str, text: str) -> str:
        """The label of the numbers in a text of a platform, a JSON object in which each variable of the case
        stands under its name; '' where none does. They are those of whoever is ``owner_of`` the label.

        Raises ValueError for one that is missing, or with which the case can't be read.
        """
        name = question.partition(":")[0]
        varied = self.variation(name) if name in self.paths else None
        try:
            found = json.loads(text) if varied is not None else None
        except (ValueError, RecursionError):
            found = None
        if varied is None or not isinstance(found, dict):
            return ""
        names = [variable.name for variable in varied.case.variables]
        if found.keys().isdisjoint(names):
            return ""
        values = {name: str(found.get(name, "")) for name in names}
        varied.check(values, "this row")
        return varied.told(values)

    def ready(self, students: Iterable[str], questions: Iterable[str]) -> None:
        """Solve the tasks of many students together, of the cases with variables among those asked."""
        every = list(students)
        for name in dict.fromkeys(question.partition(":")[0] for question in questions):
            found = self._found(name) if name in self.paths else None
            if isinstance(found, Varied):
                found.ready(every)

    def text(self, name: str) -> str:
        """The file of a case. Raises OSError."""
        with reading_text(self.paths[name], encoding="utf-8-sig", errors="replace") as file:
            return file.read()

    def canonical(self, question: str) -> str:
        """The one name of a question: ``press`` where ``press:T12`` asks for its only unknown."""
        name, _, what = question.partition(":")
        try:
            return canonical(self.read(name), name, what)
        except NoKeyError:
            return question


def _yaml_files(folder: str) -> Iterator[str]:
    """The YAML files of a folder that are cases, by name; a single file too."""
    if os.path.isfile(folder):
        yield folder
        return
    yield from filter(_mentions, files_of(folder, (".yaml", ".yml")))


def _mentions(path: str) -> bool:
    """Whether ``icsolve`` stands near the top of a file: else it is no case (a course, say)."""
    try:
        with reading(path) as file:
            head = file.read(65536)
    except OSError:
        return False
    return b"icsolve" in head.replace(b"\0", b"")
