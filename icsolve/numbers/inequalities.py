"""Linear inequalities: what range they leave the first of their variables, and a point of it.

One variable after the other is eliminated (J. Fourier, 1826; T. Motzkin, 1936): of two inequalities that
bound it from below and from above a multiple of each makes one without it. What is made of more inequalities
than variables are gone, and one more, follows from the others (S. N. Chernikov, 1960).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from operator import mul, sub, truediv
from typing import Any

from icsolve.numbers import largest_of
from icsolve.numbers.linear import eliminate
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


class Deepest(NamedTuple):
    """Where the least of some forms is greatest.

    Attributes
    ----------
    depth : that least, at most 1; negative where no point has all of them not less than zero, infinite where
        those that do not count are the cause
    of : the places of the forms that set it, each as deep as the others at the point
    point : (n,), one of those
    shares : of those forms, in the sum that shows that no point is deeper; of an infinite depth in a sum that
        is less than zero everywhere
    """

    depth: Any
    of: tuple[int, ...]
    point: tuple[Any, ...]
    shares: tuple[Any, ...]

    def is_proven(self, forms: Sequence[Form], counts: Sequence[float]) -> bool:
        """Whether no form is less than it is to be at the point, and the shares of forms leave no variable,
        but for rounding."""
        columns = zip(*(forms[k] for k in self.of), strict=True)
        left = [sum(map(mul, column, self.shares)) for column in columns]
        is_sum = max(map(abs, left[1:]), default=0.0) <= CLOSE and min(self.shares, default=0.0) >= -CLOSE
        if math.isinf(self.depth):
            counted = sum(map(mul, (counts[k] for k in self.of), self.shares))
            return is_sum and counted <= CLOSE and left[0] < -CLOSE
        for form, many in zip(forms, counts, strict=True):
            terms = [form[0], *map(mul, form[1:], self.point), -many * self.depth]
            if sum(terms) < -CLOSE * largest_of(terms):
                return False
        return is_sum


def deepest(forms: Sequence[Form], counts: Sequence[float] | None = None) -> Deepest:
    """Where the least of some forms, (1 + n,) each, is greatest.

    By the simplex method (G. Dantzig, 1947; ties by the first place, R. Bland, 1977) on the dual: of the
    shares, 1 in all, with which the forms add up to one without variables, those that make it least.

    Parameters
    ----------
    counts : by how many times the depth each form is to exceed zero; without them all by it once
    """
    counts = [1.0] * len(forms) if counts is None else counts
    found = _simplex(forms, counts, exact=(small := _has_small(forms)))
    if not (small or found.is_proven(forms, counts)):  # pivots add up roundings, of the point first
        found = _solved_again(found, forms, counts)
        if not found.is_proven(forms, counts):  # they led to rows that hang on each other
            found = _simplex(forms, counts, exact=True)
    point, shares = (tuple(map(float, own)) for own in (found.point, found.shares))
    return Deepest(float(found.depth), found.of, point, shares)


def _has_small(forms: Sequence[Form]) -> bool:
    """Whether a form has next to nothing of a variable, which floats take for rounding: of one without end it
    counts all the same."""
    for form in forms:
        least = CLOSE * largest_of(form[1:])
        if any(0.0 < abs(a) < least for a in form[1:]):
            return True
    return False


def _solved_again(found: Deepest, forms: Sequence[Form], counts: Sequence[float]) -> Deepest:
    """The same with its point from the forms that set it."""
    if math.isinf(found.depth):
        return found
    ends = [dict(enumerate((*forms[k][1:], forms[k][0] - counts[k] * found.depth))) for k in found.of]
    count = len(found.point)
    point = eliminate(ends, count).solved
    return found._replace(point=tuple([point.get(j, {}).get(count, 0.0) for j in range(count)]))


def _simplex(forms: Sequence[Form], counts: Sequence[Any], exact: bool = False) -> Deepest:
    """`deepest` in floats, or in whole numbers over one denominator, its numbers then fractions."""
    count, last = len(forms[0]) - 1 if forms else 0, len(forms)
    over: Callable[[Any, Any], Any] = truediv
    nothing, below = CLOSE, 1
    costs: list[Any] = [*(form[0] for form in forms), 1.0]
    if exact:
        from fractions import Fraction

        over, nothing = Fraction, 0.0
        costs, counts = list(map(Fraction, costs)), list(map(Fraction, counts))
    # shares, how often each equation is taken, right side; the last form is 1, wherever it is asked
    table: list[list[Any]] = [[*(form[1 + j] for form in forms), *[0.0] * (count + 2)] for j in range(count)]
    for j, row in enumerate(table):
        row[last + 1 + j] = 1.0
    table.append([*counts, 1.0, *[0.0] * count, 1.0])
    table.append([*map(sub, costs, counts), *[0.0] * (count + 1), -1.0])
    table = [*map(_whole, table)] if exact else table
    unit = -table[-1][-1]
    basis = [-1] * count + [last]
    for r in range(count):  # nothing has a share yet: any place will do
        c = max(range(last), key=lambda k: abs(table[r][k]), default=last)
        if abs(table[r][c]) > nothing:
            below = _pivot(table, below, basis, r, c)
    rows = [r for r, c in enumerate(basis) if c >= 0]
    for pivots in range(MOST_PIVOTS):
        worth = table[-1][: last + 1]
        enters = worth.index(min(worth)) if pivots < STEEPEST else None
        if enters is None or enters in basis:
            enters = next((c for c, w in enumerate(worth) if w < -nothing and c not in basis), None)
        if enters is None or worth[enters] >= -nothing:
            break
        positive = [r for r in rows if table[r][enters] > nothing]
        if not positive:
            both = {**{basis[r]: over(-table[r][enters], below) for r in rows}, enters: over(1, 1)}
            of = tuple(sorted(c for c in both if c < last))
            return Deepest(-math.inf, of, (0.0,) * count, tuple([both[c] for c in of]))
        leaves = min((over(table[r][-1], table[r][enters]), basis[r], r) for r in positive)[2]
        below = _pivot(table, below, basis, leaves, enters)
    values = {basis[r]: over(table[r][-1], below) for r in rows}
    depth = sum(costs[c] * value for c, value in values.items())
    of = tuple(sorted(c for c in values if c < last))
    point = tuple([over(a, below * unit) for a in table[-1][last + 1 : -1]])
    return Deepest(depth, of, point, tuple([values[k] for k in of]))


MOST_PIVOTS = 10_000
"""Rounding may lead around in a circle."""
STEEPEST = 40
"""So many times the form that makes the sum least by its share enters, thereafter the first that does: that
leads around in no circle."""


def _whole(row: Sequence[Any]) -> list[int]:
    """The numbers times a power of two, by which they are whole."""
    ratios = [a.as_integer_ratio() for a in row]
    most = max(below for _, below in ratios)
    return [above * (most // below) for above, below in ratios]


def _pivot(table: list[list[Any]], below: int, basis: list[int], r: int, c: int) -> int:
    """Take a place into the basis, in the row of another; returns the denominator.

    Of whole numbers that is the pivot, and what a row becomes can be divided by the denominator before (J.
    Edmonds, 1967; E. Bareiss, 1968).
    """
    basis[r], own, entry = c, table[r], table[r][c]
    if isinstance(entry, float):
        own = table[r] = [a / entry for a in own]
        for k, row in enumerate(table):
            if k != r and (share := row[c]):
                table[k] = [a - share * b for a, b in zip(row, own, strict=True)]
        return 1
    if entry < 0:
        own, entry = [-a for a in own], -entry
    for k, row in enumerate(table):
        share = row[c]
        table[k] = (
            [(entry * a - share * b) // below for a, b in zip(row, own, strict=True)] if k != r else own
        )
    return int(entry)
