"""A case with its answer, and the keys of the questions that are asked of it."""

from __future__ import annotations

from copy import copy

from icsolve.answer import Answer
from icsolve.case import Case, CentreIs, LoadIs, ReactionIs, Target
from icsolve.errors import SceneError
from icsolve.grade.course import Course
from icsolve.grade.keys import AnyKey, Key, place_key, scalar_key, scaled_key
from icsolve.grade.malrules import wrong_answers
from icsolve.grade.malrules.messages import Wrong
from icsolve.grade.malrules.targets import place_wrongs, solved_for, target_wrongs
from icsolve.grade.questions import asked_of


class Solved:
    """One case with its answer, and the keys that were asked of it."""

    def __init__(self, case: Case, course: Course, bound: bool = False) -> None:
        self.case = case
        self.course = course
        self.answer = solved(case, bound)
        self.scale = 1.0
        """by what the loads, and so the answers, are larger than in ``answer``"""
        self._base: Solved | None = None
        self._keys: dict[str, AnyKey] = {}
        self._wrongs: dict[str, list[Wrong]] | None = None

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
            self._keys[question] = self._made(question)
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
        answer = self.answer
        if isinstance(target, CentreIs):
            return place_key(question, target, answer, policy, place_wrongs(answer, target))
        if isinstance(target, LoadIs):
            return scalar_key(question, target, answer, policy, lambda: self._of_load(target.load))
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


def solved(case: Case, bound: bool = False) -> Answer:
    """The answer with all centres and rates; the bare answer where those can't be had.

    Raises SceneError.
    """
    try:
        return solved_for(case, bound=bound)
    except SceneError:
        from icsolve.solve import solve

        return solve(case, bound=bound)
