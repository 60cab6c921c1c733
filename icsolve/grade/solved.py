"""One case with its answer, what can be asked of it, and the keys of its questions."""

from __future__ import annotations

from copy import copy

from icsolve.answer import Answer
from icsolve.case import Case, CentreIs, LoadIs, ReactionIs, Target
from icsolve.errors import SceneError
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
