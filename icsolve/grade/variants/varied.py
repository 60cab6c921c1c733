"""A case with variables: every student's own task, solved once for each figure that occurs."""

from __future__ import annotations

from collections import OrderedDict
from typing import NamedTuple, TypeVar

from icsolve.case import Case
from icsolve.errors import CaseError, IcsolveError, SceneError
from icsolve.grade.course import Course
from icsolve.grade.keys import NoKeyError
from icsolve.grade.solved import Solved
from icsolve.grade.variants.draw import TRIALS, drawn, label
from icsolve.grade.variants.magnitudes import Magnitudes
from icsolve.grade.variants.suitable import far_from_dead_centres, swallowed

_REFERENCES = 8
"""Draws by which it is told which mistakes no variant shows."""
_KEPT = 5000
"""Figures that are kept solved, and students whose draw is kept."""


class Draw(NamedTuple):
    """A student's variant: its label and its values."""

    label: str
    values: dict[str, str]


class Varied:
    """One case with variables; ``text`` is its file."""

    def __init__(self, name: str, text: str, path: str, course: Course) -> None:
        self.name = name
        self.text = text
        self.path = path
        self.course = course
        self.case = self._read({})
        self.magnitudes = Magnitudes(text, self.case)
        self._figures: OrderedDict[tuple[str, ...], Solved | None] = OrderedDict()
        self._tasks: OrderedDict[str, Solved] = OrderedDict()
        self._draws: OrderedDict[str, Draw] = OrderedDict()
        self._inherent: frozenset[tuple[str, str, str]] | None = None

    def draw(self, student: str) -> Draw:
        """The student's values: the first draw that suits.

        Raises NoKeyError where none of many does.
        """
        found = self._draws.get(student)
        if found is None:
            found = self._drawn(student)
            _keep(self._draws, student, found)
        return found

    def solved(self, student: str) -> Solved:
        """The student's own task, solved.

        Raises NoKeyError.
        """
        draw = self.draw(student)
        found = self._tasks.get(draw.label)
        if found is None:
            found = self.task(draw.values)
            assert found is not None
            _keep(self._tasks, draw.label, found)
        return found

    def task(self, values: dict[str, str]) -> Solved | None:
        """The case with these values, solved; None where it does not suit.

        Where values only make all loads larger alike, the solution of another task is scaled.
        """
        base = self._figure(values)
        if base is None:
            return None
        factor = self.magnitudes.factor(base.case, values)
        if factor is not None and factor > 0.0:
            return base.scaled(factor)
        return self._exactly(values)

    def read(self, values: dict[str, str]) -> Case:
        """The case with these values, its figure and all."""
        return self._read(values)

    def _read(self, values: dict[str, str]) -> Case:
        from icsolve.read import read_text

        return read_text(self.text, self.path, {f"variables.{name}": value for name, value in values.items()})

    def _drawn(self, student: str) -> Draw:
        for trial in range(TRIALS):
            values = drawn(self.name, self.case.variables, student, self.course.seed, trial)
            if self._suits(values):
                return Draw(label(self.name, values), values)
        asked = "assembles, no dead centre near, mistakes apart"
        raise NoKeyError(
            f"none of {TRIALS} variants of {self.name} suits ({asked}): narrow the ranges of its variables"
        )

    def _suits(self, values: dict[str, str]) -> bool:
        solved = self._figure(values)
        return solved is not None and solved.swallowed <= self._always_swallowed()

    def _always_swallowed(self) -> frozenset[tuple[str, str, str]]:
        """Mistakes that hardly any variant shows: they lie in the task, not in its numbers."""
        if self._inherent is None:
            draws = (drawn(self.name, self.case.variables, "", "", trial) for trial in range(_REFERENCES))
            sets = [solved.swallowed for solved in map(self._figure, draws) if solved is not None]
            found = frozenset().union(*sets)
            self._inherent = frozenset(m for m in found if 2 * sum(m in s for s in sets) > len(sets))
        return self._inherent

    def _figure(self, values: dict[str, str]) -> Solved | None:
        """The figure with these values, and reference values of what only scales its loads."""
        key = tuple(value for name, value in values.items() if name not in self.magnitudes.names)
        if key not in self._figures:
            figure = {n: v for n, v in values.items() if n not in self.magnitudes.names}
            _keep(self._figures, key, self._exactly(figure))
        return self._figures[key]

    def _exactly(self, values: dict[str, str]) -> Solved | None:
        try:
            solved = Solved(self._read(values), self.course, bound=True)
        except (CaseError, SceneError):
            return None
        except (IcsolveError, ArithmeticError):
            return None
        if not far_from_dead_centres(solved.answer):
            return None
        solved.swallowed = swallowed(solved.answer)
        return solved


K = TypeVar("K")
V = TypeVar("V")


def _keep(store: OrderedDict[K, V], key: K, value: V) -> None:
    """Remember, and forget the oldest of too many."""
    if len(store) >= _KEPT:
        store.popitem(last=False)
    store[key] = value
