"""Linear inequalities: what range they leave the first of their variables, and a point of it.

One variable after the other is eliminated (J. Fourier, 1826; T. Motzkin, 1936): of two inequalities that
bound it from below and from above a multiple of each makes one without it. What is made of more inequalities
than variables are gone, and one more, follows from the others (S. N. Chernikov, 1960).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from icsolve.numbers.arithmetic import largest_of
from icsolve.tuples import NamedTuple

Form = tuple[float, ...]
"""An affine form: the constant, then the coefficients of the variables."""
NOTHING = 2.0**-48
"""What is left of two terms that cancel, as a fraction of them, is rounding; so is what is so small beside
the largest number of an inequality."""

CLOSE = 2.0**-40
"""Ends that differ by less of their size may be one."""


class Inequality(NamedTuple):
    """``form`` is not less than zero; ``of`` are the places of the given ones that it was made of."""

    form: Form
    of: frozenset[int]


class Region(NamedTuple):
    """Where all of some inequalities hold.

    ``stages`` has them as given, and then without the last variable, the last two and so on: of each stage
    the least number of variables is one.
    """

    stages: tuple[tuple[Inequality, ...], ...]

    @property
    def first(self) -> tuple[float, float] | None:
        """From where to where the first variable goes, perhaps to infinity; None of an empty region."""
        low, high = _between(self.stages[-1], ())
        room = NOTHING * largest_of([end for end in (low, high) if math.isfinite(end)])
        return None if low > high + room else (min(low, high), max(low, high))

    def vertex(self, end: int) -> tuple[frozenset[int], ...]:
        """The places of the given inequalities of which an end of the first variable, the least or the most,
        follows where they are equations; several where these are apart by next to nothing."""
        value = _between(self.stages[-1], ())[end]
        sides = [one for one in self.stages[-1] if one.form[1] * (1.0, -1.0)[end] > 0.0]
        near = ((abs(one.form[0] + one.form[1] * value), one) for one in sides)
        return tuple([one.of for off, one in near if off <= CLOSE * abs(one.form[1] * value)])

    def point(self, first: float) -> tuple[float, ...]:
        """Its other variables at a value of the first: each in the middle of what the ones before leave, ends
        that for rounding may be turned about."""
        found = [first]
        for stage in self.stages[-2::-1]:
            ends = [end for end in _between(stage, found) if math.isfinite(end)]
            found.append(sum(ends) / len(ends) if ends else 0.0)
        return tuple(found[1:])


def region(forms: Sequence[Form]) -> Region:
    """Where all of the forms, (1 + n,) each, are not less than zero."""
    stages = [tuple(_normed(Inequality(form, frozenset([k])) for k, form in enumerate(forms)))]
    for gone, column in enumerate(range(len(forms[0]) - 1, 1, -1), start=1):
        stages.append(tuple(_normed(_without(stages[-1], column, gone))))
    return Region(tuple(stages))


def _normed(given: Iterator[Inequality]) -> Iterator[Inequality]:
    """Each over its largest number, beside which others may be rounding, without those that say nothing."""
    for form, of in given:
        size = largest_of(form)
        if size:
            yield Inequality(tuple([a / size if abs(a) > NOTHING * size else 0.0 for a in form]), of)


def _without(given: Sequence[Inequality], column: int, gone: int) -> Iterator[Inequality]:
    """What the inequalities say without a variable, the last but for so many that are ``gone`` with it."""
    yield from (one for one in given if not one.form[column])
    above = [one for one in given if one.form[column] < 0.0]
    for low in given:
        for high in above if low.form[column] > 0.0 else ():
            if len(of := low.of | high.of) <= gone + 1:
                a, b = low.form[column], high.form[column]
                both = zip(low.form[:column], high.form[:column], strict=True)
                yield Inequality(
                    (*(_sum(x / a, -y / b) for x, y in both), *[0.0] * (len(low.form) - column)), of
                )


def _sum(a: float, b: float) -> float:
    """A sum, zero where that is rounding."""
    total = a + b
    return total if abs(total) > NOTHING * max(abs(a), abs(b)) else 0.0


def _between(given: Sequence[Inequality], known: Sequence[float]) -> tuple[float, float]:
    """From where to where a variable goes, the ones before it known; turned about where nowhere."""
    low, high = -math.inf, math.inf
    for form, _ in given:
        terms = [form[0], *(a * x for a, x in zip(form[1:], known, strict=False))]
        rest, slope = sum(terms), form[1 + len(known)]
        if slope > 0.0:
            low = max(low, -rest / slope)
        elif slope < 0.0:
            high = min(high, -rest / slope)
        elif rest < 0.0 and not known:
            return math.inf, -math.inf
    return low, high
