"""The cases of a folder, solved once each when first asked for, and the keys of their questions."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator
from typing import TYPE_CHECKING

from icsolve.case import Case
from icsolve.errors import CaseError, SceneError
from icsolve.grade.course import Course
from icsolve.grade.keys import AnyKey, NoKeyError
from icsolve.grade.questions import canonical
from icsolve.grade.solved import Solved

if TYPE_CHECKING:
    from icsolve.grade.variants.varied import Varied


class Shelf:
    """The cases of a folder (and those in it) by name."""

    def __init__(self, folder: str | os.PathLike[str], course: Course) -> None:
        self.course = course
        self.folder = os.fspath(folder)
        self.paths: dict[str, str] = {}
        self.twice: dict[str, tuple[str, str]] = {}
        for path in _yaml_files(os.fspath(folder)):
            self._add(path)
        self.varied = False
        """whether a case with variables has been met"""
        self._lower = {name.lower(): name for name in self.paths}
        self._solved: dict[str, Solved | Varied | NoKeyError] = {}
        self._cases: dict[str, Case] = {}

    def _add(self, path: str) -> None:
        name = case_name(path)
        if name in self.paths:
            self.twice[name] = (self.paths[name], path)
        self.paths.setdefault(name, path)

    def find(self, text: str) -> str | None:
        """The question that a text names, by the name of its case's file and what is asked of it."""
        case, colon, what = text.strip().partition(":")
        case = case.removesuffix(".yaml").removesuffix(".yml")
        name = case.strip() if case.strip() in self.paths else self._lower.get(case.strip().lower())
        if name is None:
            return None
        return f"{name}:{what.strip()}" if colon and what.strip() else name

    def solved(self, name: str, student: str = "") -> Solved:
        """The case of that name, solved; with the student's own values, if it has variables.

        Raises NoKeyError where there is none, or it has no answer; the message says why.
        """
        found = self._solved.get(name)
        if found is None:
            found = self._solved[name] = self._made(name)
        if isinstance(found, NoKeyError):
            raise found
        return found if isinstance(found, Solved) else found.solved(student)

    def _made(self, name: str) -> Solved | Varied | NoKeyError:
        try:
            case = self.read(name)
            if not case.variables:
                return Solved(case, self.course)
            from icsolve.grade.variants.varied import Varied

            self.varied = True
            return Varied(name, self.text(name), self.paths[name], self.course)
        except SceneError as error:
            return NoKeyError(f"the case {name} has no answer ({error.status}): {error.message}")
        except NoKeyError as error:
            return error

    def variation(self, name: str) -> Varied | None:
        """The case as one with variables; None where it has none, or can't be read."""
        found = self._solved.get(name)
        if found is None:
            found = self._solved[name] = self._made(name)
        return found if not isinstance(found, Solved | NoKeyError) else None

    def foresee(self, questions: Iterable[str], students: Collection[str]) -> None:
        """Draw for all students at once what the questions' cases leave to be drawn."""
        for name in dict.fromkeys(question.partition(":")[0] for question in questions):
            varied = self.variation(name) if name in self.paths else None
            if varied is not None:
                varied.foresee(students)

    def read(self, name: str) -> Case:
        """The case of that name.

        Raises NoKeyError.
        """
        from icsolve.read import read_file

        if name in self.twice:
            raise NoKeyError(f"two files are the case {name}: {' and '.join(self.twice[name])}")
        if name not in self.paths:
            raise NoKeyError(f"there is no case '{name[:60]}'")
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
        name = question.partition(":")[0]
        varied = self.variation(name)
        return varied.key(question, student) if varied is not None else self.solved(name).key(question)

    def variant_of(self, question: str, student: str) -> str:
        """The label of the student's values; '' for a case without variables."""
        varied = (
            self.variation(question.partition(":")[0]) if question.partition(":")[0] in self.paths else None
        )
        if varied is None:
            return ""
        try:
            return varied.draw(student).label
        except NoKeyError:
            return ""

    def text(self, name: str) -> str:
        """The file of a case. Raises OSError."""
        with open(self.paths[name], encoding="utf-8-sig", errors="replace") as file:
            return file.read()

    def canonical(self, question: str) -> str:
        """The one name of a question: ``press`` where ``press:T12`` asks for its only unknown."""
        name, _, what = question.partition(":")
        try:
            return canonical(self.read(name), name, what)
        except NoKeyError:
            return question


def case_name(path: str) -> str:
    """``press`` of ``dir/press.icsolve.yaml``."""
    return os.path.splitext(os.path.basename(path))[0].removesuffix(".icsolve")


def _yaml_files(folder: str) -> Iterator[str]:
    """The YAML files of a folder that are cases, by name; a single file too."""
    if os.path.isfile(folder):
        yield folder
        return
    for here, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for name in sorted(files):
            path = os.path.join(here, name)
            if name.lower().endswith((".yaml", ".yml")) and _mentions(path):
                yield path


def _mentions(path: str) -> bool:
    """Whether ``icsolve`` stands near the top of a file: else it is no case (a course, say)."""
    try:
        with open(path, "rb") as file:
            head = file.read(65536)
    except OSError:
        return False
    return b"icsolve" in head.replace(b"\0", b"")
