"""Whether a variant makes a fair task: it assembles, no dead centre is near, mistakes show in its answer."""

from __future__ import annotations

from typing import NamedTuple

from icsolve.answer import Answer
from icsolve.errors import IcsolveError
from icsolve.grade.malrules.centres import centre_wrongs
from icsolve.grade.malrules.changed import without_friction
from icsolve.grade.malrules.gather import resolve
from icsolve.grade.malrules.loads import load_wrongs
from icsolve.grade.malrules.messages import Wrong
from icsolve.grade.scales import size_of
from icsolve.sensitivity import band

DRAWING = 1e-3
"""Part of the mechanism's size by which every point may be off."""
SWING = 0.1
"""Part of itself by which an answer may change for it; near a dead centre it changes more."""
APART = 0.02
"""Part of itself by which an answer and a wrong one differ at least."""


Mistake = tuple[str, str, str]
"""The unknown, the code, and where the mistake sits."""


class Seen(NamedTuple):
    """A variant looked at: whether it is far from dead centres, and the mistakes that it would not show;
    its answer, if it was looked at in a sweep."""

    far: bool
    swallowed: frozenset[Mistake]
    value: float | None = None


def looked_at(answer: Answer) -> Seen:
    """A variant that was solved with its bound."""
    far = far_from_dead_centres(answer)
    return Seen(far, swallowed(answer) if far else frozenset())


def far_from_dead_centres(answer: Answer) -> bool:
    """Whether rounding the figure to a thousandth of its size leaves the answers within 10 %.

    ``answer`` has been solved with its bound, whose backward pass gives the sensitivities; with friction,
    which has none, those of the smooth mechanism stand for them.
    """
    width = DRAWING * size_of(answer)
    for name, found in answer.answers.items():
        smooth = answer if name in answer.sensitivities else _smooth(answer)
        if name not in smooth.sensitivities:
            continue
        swing = band(smooth, name, width)
        if found.value == 0.0 or not swing <= SWING * abs(found.value):
            return False
    return True


def _smooth(answer: Answer) -> Answer:
    """The case without its friction; itself where that has no answer."""
    from icsolve.solve import solve

    case = without_friction(answer.case)
    try:
        return solve(case) if case is not None else answer
    except IcsolveError:
        return answer


def swallowed(answer: Answer) -> frozenset[Mistake]:
    """The mistakes that this variant would not show: their answers are as good as the right one."""
    found = set()
    for name, wrong in _wrongs(answer):
        right = answer.answers[name].value
        if abs(wrong.value - right) <= APART * abs(right):
            found.add((name, wrong.code, wrong.where))
    return frozenset(found)


def _wrongs(answer: Answer) -> list[tuple[str, Wrong]]:
    """The mistakes of loads and centres; those of signs, powers of ten and units are always apart."""
    try:
        found = list(load_wrongs(answer, resolve))
    except (ArithmeticError, StopIteration):
        found = []
    if len(answer.answers) == 1:
        (name,) = answer.answers
        found += [(name, wrong) for wrong in centre_wrongs(answer, name)]
    return [(name, wrong) for name, wrong in found if name in answer.answers]
