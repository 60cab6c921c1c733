"""The cases of a folder, solved once each when first asked for, and the keys of their questions."""

from __future__ import annotations

import os
from collections.abc import Iterator

from icsolve.answer import Answer
from icsolve.case import Case, CentreIs, LoadIs, Target
from icsolve.errors import CaseError, NotACase, SceneError
from icsolve.grade.course import Course
from icsolve.grade.keys import AnyKey, NoKeyError, place_key, scalar_key
from icsolve.grade.malrules import wrong_answers
from icsolve.grade.malrules.messages import Wrong
from icsolve.grade.malrules.targets import place_wrongs, solved_for, target_wrongs
from icsolve.grade.questions import asked_of, canonical, unknowns


class Solved:
    """One case with its answer, and the keys that were asked of it."""

    def __init__(self, case: Case, course: Course) -> None:
        self.case = case
        self.course = course
        self.answer = solved(case)
        self._keys: dict[str, AnyKey] = {}
        self._wrongs: dict[str, list[Wrong]] | None = None

    def key(self, question: str) -> AnyKey:
        """The key of ``case`` or ``case:what``.

        Raises NoKeyError.
        """
        if question not in self._keys:
            self._keys[question] = self._made(question)
        return self._keys[question]

    def target(self, question: str) -> Target:
        """What a question asks.

        Raises NoKeyError.
        """
        return asked_of(self.case, question.partition(":")[2])

    def _made(self, question: str) -> AnyKey:
        target = self.target(question)
        policy = self.course.policy_of(question, self.case.tolerance)
        answer = self.answer
        if isinstance(target, CentreIs):
            return place_key(question, target, answer, policy, place_wrongs(answer, target))
        if isinstance(target, LoadIs):
            if self._wrongs is None:
                self._wrongs = wrong_answers(answer)
            wrongs = self._wrongs.get(target.load, [])
        else:
            answer = solved_for(self.case, target)
            wrongs = target_wrongs(answer, target)
        return scalar_key(question, target, answer, policy, wrongs)


def solved(case: Case) -> Answer:
    """The answer with all centres and rates; the bare answer where those can't be had.

    Raises SceneError.
    """
    try:
        return solved_for(case)
    except SceneError:
        from icsolve.solve import solve

        return solve(case, bound=False)


class Shelf:
    """The cases of a folder (and those in it) by name."""

    def __init__(self, folder: str | os.PathLike[str], course: Course) -> None:
        self.course = course
        self.paths: dict[str, str] = {}
        self.twice: dict[str, tuple[str, str]] = {}
        for path in _yaml_files(os.fspath(folder)):
            self._add(path)
        self.varied = False
        """whether a case with variables has been met"""
        self._lower = {name.lower(): name for name in self.paths}
        self._solved: dict[str, Solved | NoKeyError] = {}

    def _add(self, path: str) -> None:
        name = case_name(path)
        if name in self.paths:
            self.twice[name] = (self.paths[name], path)
        self.paths.setdefault(name, path)

    def find(self, text: str) -> str | None:
        """The question that a text names, by the name of its case's file and what is asked of it."""
        case, colon, what = text.strip().partition(":")
        name = case.strip() if case.strip() in self.paths else self._lower.get(case.strip().lower())
        if name is None:
            return None
        return f"{name}:{what.strip()}" if colon and what.strip() else name

    def solved(self, name: str, student: str = "") -> Solved:
        """The case of that name, solved.

        Raises NoKeyError where there is none, or it has no answer; the message says why.
        """
        found = self._solved.get(name)
        if found is None:
            try:
                found = Solved(self.read(name), self.course)
            except SceneError as error:
                found = NoKeyError(f"the case {name} has no answer ({error.status}): {error.message}")
            except NoKeyError as error:
                found = error
            self._solved[name] = found
        if isinstance(found, NoKeyError):
            raise found
        return found

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
            return read_file(self.paths[name])
        except CaseError as error:
            raise NoKeyError(f"the case {name} can't be read: {error.problems[0]}") from None

    def key(self, question: str, student: str = "") -> AnyKey:
        """The key of a question, for a case with variables that of the student's own values.

        Raises NoKeyError.
        """
        return self.solved(question.partition(":")[0], student).key(question)

    def variant_of(self, question: str, student: str) -> str:
        """The label of the student's values; '' for a case without variables."""
        return ""

    def canonical(self, question: str) -> str:
        """The one name of a question: ``press`` where ``press:T12`` asks for its only unknown."""
        name, _, what = question.partition(":")
        try:
            return canonical(self.solved(name).case, name, what)
        except NoKeyError:
            return question

    def unknowns(self, name: str) -> tuple[str, ...]:
        """The unknown loads of a case.

        Raises NoKeyError.
        """
        return unknowns(self.solved(name).case)


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


__all__ = ["NotACase", "Shelf", "Solved", "case_name"]
