"""All likely wrong answers of a case, computed once by the solver, ready to be looked up."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Iterator
from functools import cached_property

from icsolve.answer import Answer
from icsolve.case import Case
from icsolve.errors import IcsolveError
from icsolve.grade.malrules.centres import centre_wrongs
from icsolve.grade.malrules.changed import (
    in_radians,
    other_modes,
    with_motion_reversed,
    with_other_meshes,
    without_friction,
)
from icsolve.grade.malrules.loads import load_wrongs
from icsolve.grade.malrules.messages import ORDER, Wrong
from icsolve.grade.malrules.plain import plain_wrongs

MOST = 3
"""Causes that are named where several fit."""


def resolve(case: Case | None) -> dict[str, float]:
    """The answers of a changed case; none where it can't be solved, which is no one's mistake then."""
    from icsolve.solve import solve

    if case is None:
        return {}
    try:
        answers = solve(case, bound=False).answers
        return {name: found.value for name, found in answers.items() if found.holds is None}
    except (IcsolveError, ArithmeticError):
        return {}


def wrong_answers(answer: Answer) -> dict[str, list[Wrong]]:
    """The wrong answers of every unknown; ``answer`` has been solved with all centres and rates."""
    found: dict[str, list[Wrong]] = {name: list(plain_wrongs(a.value)) for name, a in answer.answers.items()}
    for name, wrong in (*load_wrongs(answer, resolve), *_resolved(answer)):
        if name in found:
            found[name].append(wrong)
    if len(found) == 1:
        (name,) = found
        found[name].extend(centre_wrongs(answer, name))
    for name, wrong in _exchanged(answer):
        found[name].append(wrong)
    return found


def _exchanged(answer: Answer) -> Iterator[tuple[str, Wrong]]:
    """Of several unknowns the value of another one, if both have the same unit."""
    for name, one in answer.answers.items():
        for other, two in answer.answers.items():
            if other != name and one.unit == two.unit:
                yield name, Wrong("other-unknown", two.value, other)


def changed_cases(answer: Answer) -> Iterator[tuple[str, Case]]:
    """Cases that a student may have solved instead, each with the code of the mistake."""
    case = answer.case
    for figure, loads in ((True, True), (False, True), (True, False)):
        changed = in_radians(case, figure, loads)
        if changed is not None:
            yield "deg-rad", changed
    for changed in with_other_meshes(case):
        yield "mesh-sense", changed
    for changed in other_modes(case, answer):
        yield "other-mode", changed
    for code, turned in (
        ("no-friction", without_friction(case)),
        ("friction-sense", with_motion_reversed(case)),
    ):
        if turned is not None:
            yield code, turned


def _resolved(answer: Answer) -> Iterator[tuple[str, Wrong]]:
    for code, changed in changed_cases(answer):
        for name, value in resolve(changed).items():
            yield name, Wrong(code, value)


class Wrongs:
    """Wrong answers sorted by value, made when the first wrong answer asks for them.

    What the band about the ``right`` answer holds is dropped. ``reach`` is the relative half-width within
    which a wrong answer is recognised: that of the right one, 5 % at most.
    """

    def __init__(self, make: Callable[[], Iterable[Wrong]], right: float, half: float) -> None:
        self._make = make
        self._right = right
        self._half = half
        self.reach = min(half / abs(right), 0.05) if right else 0.01

    @cached_property
    def all(self) -> tuple[Wrong, ...]:
        """The wrong answers by value."""
        right, half = self._right, self._half
        kept = [w for w in self._make() if math.isfinite(w.value) and w.value and abs(w.value - right) > half]
        return tuple(sorted(kept, key=lambda w: (w.value, ORDER[w.code])))

    @cached_property
    def _values(self) -> list[float]:
        return [wrong.value for wrong in self.all]

    def near(self, value: float) -> tuple[Wrong, ...]:
        """The wrong answers that a value may be, simplest cause first, one of each code."""
        values, reach = self._values, self.reach
        width = reach * abs(value) * (1.0 + reach)
        first = bisect_left(values, value - width)
        last = bisect_right(values, value + width, first)
        if first == last or not math.isfinite(value):
            return ()
        fitting = [w for w in self.all[first:last] if abs(value - w.value) <= reach * abs(w.value)]
        return tuple(fitting) if len(fitting) < 2 else _simplest(fitting, value)


def _simplest(fitting: list[Wrong], value: float) -> tuple[Wrong, ...]:
    """The nearest of each code, simplest code first."""
    nearest: dict[str, Wrong] = {}
    for wrong in sorted(fitting, key=lambda w: abs(value - w.value)):
        nearest.setdefault(wrong.code, wrong)
    return tuple(sorted(nearest.values(), key=lambda w: ORDER[w.code])[:MOST])
