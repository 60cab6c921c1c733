"""A case with variables: every student's own task, solved once for each figure that occurs."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from icsolve.case import Case
from icsolve.errors import CaseError, IcsolveError, SceneError
from icsolve.grade.course import Course
from icsolve.grade.keys import AnyKey, NoKeyError
from icsolve.grade.solved import Solved
from icsolve.grade.variants.draw import TRIALS, drawn, label
from icsolve.grade.variants.magnitudes import Magnitudes
from icsolve.grade.variants.suitable import Seen, looked_at
from icsolve.read.variables import first_values

if TYPE_CHECKING:
    from icsolve.grade.variants.together import Together

Texts = dict[str, str]
_REFERENCES = 8
"""Draws by which it is told which mistakes no variant shows."""
_KEPT = 1000
"""Figures that are kept solved."""
_KNOWN = 100_000
"""Students whose draw is kept, and variants of which it is known whether they suit."""
_TOGETHER = 4096
"""Students whose variants are looked at in one sweep."""
_FEW = 16
"""So few are looked at one by one."""
_UNFIT = Seen(False, frozenset())


class Draw(NamedTuple):
    """A student's variant: its label and its values."""

    label: str
    values: Texts


class Varied:
    """One case with variables; ``text`` is its file."""

    def __init__(self, name: str, text: str, path: str, course: Course) -> None:
        self.name = name
        self.text = text
        self.path = path
        self.course = course
        self.case = self.read({})
        self.magnitudes = Magnitudes(text, self.case)
        self._first = first_values(self.case.variables)
        self._solved: OrderedDict[tuple[str, ...], Solved | None] = OrderedDict()
        self._tasks: OrderedDict[str, Solved] = OrderedDict()
        self._draws: OrderedDict[str, Draw] = OrderedDict()
        self._seen: OrderedDict[tuple[str, ...], Seen | None] = OrderedDict()
        self._inherent: frozenset[tuple[str, str, str]] | None = None

    def draw(self, student: str) -> Draw:
        """The student's values: the first draw that suits.

        Raises NoKeyError where none of many does.
        """
        found = self._draws.get(student)
        if found is None:
            found = self._drawn(student)
            _keep(self._draws, student, found, _KNOWN)
        return found

    def foresee(self, students: Iterable[str]) -> None:
        """Draw for many students, whose variants are looked at in one sweep where that can be."""
        waiting = [student for student in students if student not in self._draws]
        for start in range(0, len(waiting), _TOGETHER):
            self._foresee(waiting[start : start + _TOGETHER])

    def solved(self, student: str) -> Solved:
        """The student's own task, solved.

        Raises NoKeyError.
        """
        return self.task(self.draw(student))

    def key(self, question: str, student: str) -> AnyKey:
        """The key of a student's own task; as far as a sweep tells it, nothing more is solved.

        Raises NoKeyError.
        """
        from icsolve.grade.variants.swept import swept_key

        draw = self.draw(student)
        return swept_key(self, draw, question) or self.task(draw).key(question)

    def task(self, draw: Draw) -> Solved:
        """A variant, solved.

        Raises NoKeyError.
        """
        found = self._tasks.get(draw.label)
        if found is None:
            found = self._task(draw.values)
            _keep(self._tasks, draw.label, found, _KEPT)
        return found

    def value(self, draw: Draw) -> float | None:
        """The answer of a variant that was looked at in a sweep; None where it was not."""
        base = self._figure(draw.values)
        factor = self.magnitudes.factor(base, draw.values)
        if factor is not None and factor > 0.0:
            seen = self._seen.get(tuple(base.values()))
            return seen.value * factor if seen is not None and seen.value is not None else None
        seen = self._seen.get(tuple(draw.values.values()))
        return seen.value if seen is not None else None

    def is_fixed(self, path: str) -> bool:
        """Whether the number at a path is the same in all variants that a sweep gave."""
        return self._together is not None and all(n.path != path for n in self._together.numbers)

    def read(self, values: Texts) -> Case:
        """The case with these values, its figure and all."""
        from icsolve.read import read_text

        return read_text(self.text, self.path, {f"variables.{name}": value for name, value in values.items()})

    # --- tasks ------------------------------------------------------------------------------------

    def _task(self, values: Texts) -> Solved:
        """The case with values that suit, solved.

        Where they only make all loads larger alike, the solution of another task is scaled.
        """
        base = self._figure(values)
        factor = self.magnitudes.factor(base, values)
        grows = factor is not None and factor > 0.0
        found = self._exactly(base if grows else values)
        if found is None:
            raise NoKeyError(f"{self.name} can't be solved with {values}")
        return found.scaled(factor) if grows and factor is not None else found

    def _figure(self, values: Texts) -> Texts:
        """These values, and the first ones of variables that only scale loads."""
        return {n: self._first[n] if n in self.magnitudes.names else v for n, v in values.items()}

    def _exactly(self, values: Texts) -> Solved | None:
        """The case with these values; None where it has no answer."""
        key = tuple(values.values())
        if key not in self._solved:
            _keep(self._solved, key, self._made(values), _KEPT)
        return self._solved[key]

    def _made(self, values: Texts) -> Solved | None:
        try:
            return Solved(self.read(values), self.course, bound=True)
        except (CaseError, SceneError, IcsolveError, ArithmeticError):
            return None

    # --- drawing ----------------------------------------------------------------------------------

    def _drawn(self, student: str) -> Draw:
        for trial in range(TRIALS):
            values = self._values(student, trial)
            if self._suits(values):
                return Draw(label(self.name, values), values)
        asked = "assembles, no dead centre near, mistakes apart"
        raise NoKeyError(
            f"none of {TRIALS} variants of {self.name} suits ({asked}): narrow the ranges of its variables"
        )

    def _values(self, student: str, trial: int) -> Texts:
        return drawn(self.name, self.case.variables, student, self.course.seed, trial)

    def _suits(self, values: Texts) -> bool:
        """By its figure; where its loads do not grow alike, by all of it."""
        base = self._figure(values)
        seen = self._looked_at(base)
        if not (seen.far and seen.swallowed <= self._always_swallowed()):
            return False
        return self._scales(base, values) or self._looked_at(values).far

    def _scales(self, base: Texts, values: Texts) -> bool:
        factor = self.magnitudes.factor(base, values)
        return factor is not None and factor > 0.0

    def _looked_at(self, values: Texts) -> Seen:
        """A variant by what is known of it, or as a scene of its own."""
        key = tuple(values.values())
        seen = self._seen.get(key)
        if seen is None:
            solved = self._exactly(values)
            seen = looked_at(solved.answer) if solved is not None else _UNFIT
            _keep(self._seen, key, seen, _KNOWN)
        return seen

    def _always_swallowed(self) -> frozenset[tuple[str, str, str]]:
        """Mistakes that hardly any variant shows: they lie in the task, not in its numbers."""
        if self._inherent is None:
            sets = [seen.swallowed for _, seen in self._references if seen.far]
            found = frozenset().union(*sets)
            self._inherent = frozenset(m for m in found if 2 * sum(m in s for s in sets) > len(sets))
        return self._inherent

    @cached_property
    def _references(self) -> list[tuple[Texts, Seen]]:
        """A few variants, each looked at as a scene of its own."""
        draws = (drawn(self.name, self.case.variables, "", "", trial) for trial in range(_REFERENCES))
        return [(figure, self._looked_at(figure)) for figure in map(self._figure, draws)]

    # --- many at once -----------------------------------------------------------------------------

    def _foresee(self, waiting: list[str]) -> None:
        for trial in range(TRIALS):
            if len(waiting) < _FEW or self._together is None:
                return
            draws = {student: self._values(student, trial) for student in waiting}
            figures = {student: self._figure(values) for student, values in draws.items()}
            self._see(list(figures.values()))
            self._see([v for s, v in draws.items() if not self._scales(figures[s], v)])
            for student, values in draws.items():
                if self._suits(values):
                    _keep(self._draws, student, Draw(label(self.name, values), values), _KNOWN)
            waiting = [student for student in waiting if student not in self._draws]

    def _see(self, draws: Sequence[Texts]) -> None:
        """Look at the variants that were not looked at yet, in one sweep."""
        new = {key: values for values in draws if (key := tuple(values.values())) not in self._seen}
        if new and self._together is not None:
            for key, seen in zip(new, self._together.seen(list(new.values())), strict=True):
                if seen is not None:
                    _keep(self._seen, key, seen, _KNOWN)

    @cached_property
    def _together(self) -> Together | None:
        """The sweep of this case, from a variant that suits; None where it can't be made."""
        base = next((values for values, seen in self._references if seen.far), None)
        solved = self._exactly(base) if base is not None else None
        if solved is None:
            return None
        from icsolve.grade.variants.together import Together
        from icsolve.grade.variants.written import UnsuitedError

        try:
            return Together(self.text, solved.case, solved.answer)
        except (UnsuitedError, SceneError):
            return None


K = TypeVar("K")
V = TypeVar("V")


def _keep(store: OrderedDict[K, V], key: K, value: V, most: int) -> None:
    """Remember, and forget the oldest of too many."""
    if len(store) >= most:
        store.popitem(last=False)
    store[key] = value
