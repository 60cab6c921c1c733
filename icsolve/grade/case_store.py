"""The cases of a folder, solved once each when first asked for, and the keys of their questions."""

from __future__ import annotations

import os
from collections.abc import Iterator
from copy import copy
from typing import TYPE_CHECKING

from icsolve.answer import Answer
from icsolve.case import Case, CentreIs, LoadIs, ReactionIs, Target
from icsolve.errors import CaseError, SceneError
from icsolve.files import files_of, reading, reading_text
from icsolve.grade.course import Course
from icsolve.grade.keys import AnyKey, Key, place_key, range_key, scalar_key, scaled_key
from icsolve.grade.mistakes import wrong_answers
from icsolve.grade.mistakes.codes import Wrong
from icsolve.grade.mistakes.engine import place_wrongs, solved_for, target_wrongs
from icsolve.grade.tolerance import NoKeyError
from icsolve.read.expect import target_of
from icsolve.read.names import Problems
from icsolve.read.reading import Reading
from icsolve.statics.power import is_unknown

if TYPE_CHECKING:
    from icsolve.grade.variants.record import VariantRecord
    from icsolve.grade.variants.varied import Varied

def unknowns(case: Case) -> tuple[str, ...]:
    """The unknown loads that a student can be asked for; those that are like another are left out."""
    return tuple(load.name for load in case.loads if is_unknown(load))


def asked_of(case: Case, what: str) -> Target:
    """The target of ``T12``, ``I24``, ``w4/w2``; of '' the only unknown.

    Raises NoKeyError, with a sentence, where it names nothing, or the case has not one unknown.
    """
    if not what:
        names = unknowns(case)
        if len(names) == 1:
            return LoadIs(names[0])
        if not names:
            raise NoKeyError(
                f"the case {case.name} has no unknown load; say what is asked, as in {case.name}:w4/w2"
            )
        asked = " or ".join(f"{case.name}:{name}" for name in names)
        raise NoKeyError(f"the case {case.name} has {len(names)} unknown loads; write {asked}")
    target = target_of(_reading(case), what, _points(case))
    if isinstance(target, str):
        raise NoKeyError(f"{case.name}: {target}")
    if isinstance(target, LoadIs) and target.load not in unknowns(case):
        raise NoKeyError(f"{case.name}: {what} is given in the case, not asked")
    return target


def canonical(case: Case, name: str, what: str) -> str:
    """The one name of a question."""
    names = unknowns(case)
    return name if not what or names == (what,) else f"{name}:{what}"


def _reading(case: Case) -> Reading:
    """What the reader of keys needs to know of a case."""
    reading = Reading(Problems(case.path), {}, {})
    reading.kinds = {load.name: "force" for load in case.loads}
    reading.links = dict.fromkeys(case.links, (1, 1))
    return reading


def _points(case: Case) -> set[str]:
    named = set(case.points) | {p for carried in case.carries.values() for p in carried}
    return {name for name in named if not name.startswith("@")}


class Solved:
    """One case with its answer, and the keys that were asked of it."""

    def __init__(self, case: Case, course: Course, bound: bool = False, full: bool = False) -> None:
        """Solved plainly, or at once in ``full``. Raises SceneError."""
        self.case = case
        self.course = course
        self._bound = bound
        self.scale = 1.0
        """by what the loads, and so the answers, are larger than in ``answer``"""
        self._answer = solved(case, bound) if full else None
        self.plain = self._answer or solved_plainly(case)
        """the answers alone: enough for the key of a load"""
        self._base: Solved | None = None
        self._keys: dict[str, AnyKey] = {}
        self._wrongs: dict[str, list[Wrong]] | None = None

    @property
    def answer(self) -> Answer:
        """The answers with all centres and rates; solved when it is first asked for."""
        origin = self._base or self
        if origin._answer is None:
            origin._answer = solved(self.case, self._bound)
        return origin._answer

    def scaled(self, factor: float) -> Solved:
        """The same with all loads ``factor`` times as large; it shares what was solved."""
        other = copy(self)
        other.scale, other._base, other._keys = factor, self, {}
        return other

    def key(self, question: str) -> AnyKey:
        """The key of ``case`` or ``case:what``.

        Raises NoKeyError.
        """
        if question not in self._keys:
            try:
                self._keys[question] = self._made(question)
            except SceneError as error:
                raise NoKeyError(f"{question} has no answer ({error.status}): {error.message}") from None
        return self._keys[question]

    def target(self, question: str) -> Target:
        """What a question asks.

        Raises NoKeyError.
        """
        return asked_of(self.case, question.partition(":")[2])

    def _made(self, question: str) -> AnyKey:
        target = self.target(question)
        if self._base is not None:
            key = self._base.key(question)
            return self._with_scale(key, target)
        policy = self.course.policy_of(question, self.case.tolerance)
        if isinstance(target, CentreIs):
            return place_key(question, target, self.answer, policy, place_wrongs(self.answer, target))
        if isinstance(target, LoadIs):
            ranged = range_key(question, target, self.plain, policy)
            name = target.load
            return ranged or scalar_key(question, target, self.plain, policy, lambda: self._of_load(name))
        own = solved_for(self.case, target)
        return scalar_key(question, target, own, policy, lambda: target_wrongs(own, target))

    def _with_scale(self, key: AnyKey, target: Target) -> AnyKey:
        """Loads and reactions grow with the loads; ratios and places do not."""
        grows = isinstance(target, LoadIs | ReactionIs) and isinstance(key, Key)
        return scaled_key(key, self.scale) if grows else key  # type: ignore[arg-type]

    def _of_load(self, name: str) -> list[Wrong]:
        """The wrong answers of one unknown; those of all are computed together, once."""
        if self._wrongs is None:
            self._wrongs = wrong_answers(self.answer)
        return self._wrongs.get(name, [])


def solved_plainly(case: Case, bound: bool = False) -> Answer:
    """The answers alone. Raises SceneError."""
    from icsolve.solve import solve

    return solve(case, bound=bound)


def solved(case: Case, bound: bool = False) -> Answer:
    """The answer with all centres and rates; the bare answer where those can't be had.

    Raises SceneError.
    """
    try:
        return solved_for(case, bound=bound)
    except SceneError:
        return solved_plainly(case, bound)


class CaseStore:
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
        self.records: dict[str, VariantRecord] = {}
        """the numbers that were handed out, by case"""

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

    def check_course(self) -> None:
        """Take the questions of the course by their one names.

        Raises ValueError, with the place in the course, for one that no case can answer: all would miss it.
        """
        if os.path.isfile(self.folder):
            return
        own = []
        for text, fields in self.course.own:
            question = self.find(text)
            why = f"there is no case '{text}'"
            if question is not None:
                name, _, what = question.partition(":")
                question = self.canonical(question)
                why = self._why_not_asked(name, what)
            elif near := self.near(text):
                why += f"; did you mean '{near}'?"
            if why:
                raise ValueError(f"{dict(self.course.places).get(text, 'course')}: {why}")
            own.append((question or text, fields))
        self.course = self.course._replace(own=tuple(own))

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

        name = text.partition(":")[0].strip().lower()
        found = get_close_matches(name, list(self._lower), 1, 0.75)
        return self._lower[found[0]] if found else ""

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
        with reading_text(self.paths[name], encoding="utf-8-sig", errors="replace") as file:
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
    yield from filter(_mentions, files_of(folder, (".yaml", ".yml")))


def _mentions(path: str) -> bool:
    """Whether ``icsolve`` stands near the top of a file: else it is no case (a course, say)."""
    try:
        with reading(path) as file:
            head = file.read(65536)
    except OSError:
        return False
    return b"icsolve" in head.replace(b"\0", b"")
