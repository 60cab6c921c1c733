"""Null space by Gaussian elimination with complete pivoting, on any number type whose ``abs`` is a float.

Complete pivoting is backward stable enough to decide ranks of the small systems of a linkage (N. J.
Higham, Accuracy and Stability of Numerical Algorithms, 2002, ch. 9), and needs no numpy.
"""

from __future__ import annotations

from collections.abc import Callable

from icsolve.numbers.arithmetic import Scalar
from icsolve.tuples import NamedTuple

ROUNDING = 2.0**-53
ZERO = 64 * ROUNDING
"""A pivot below this fraction of the largest is zero, times the number of rows (normalised frame)."""


Vanishes = Callable[[Scalar, float], bool]
"""Whether a value is zero, by the size of its terms; raises where that is open."""


class NullSpace(NamedTuple):
    """All solutions of homogeneous equations in n unknowns.

    Attributes
    ----------
    basis : n - rank vectors, (n,) each: in each one free unknown is 1 and the other free ones 0
    rank : number of pivots
    pivots : (rank,), sizes as fractions of the first, which was the largest entry; a later one may exceed it
    dropped : the size, as such a fraction, of the largest entry that was taken for zero
    """

    basis: tuple[tuple[Scalar, ...], ...]
    rank: int
    pivots: tuple[float, ...]
    dropped: float


def null_space(
    rows: list[list[Scalar]],
    columns: int,
    zero: float = ZERO,
    unit: float = 0.0,
    vanishes: Vanishes | None = None,
) -> NullSpace:
    """All x with ``rows @ x = 0``, by elimination with complete pivoting.

    Parameters
    ----------
    rows : (m, columns) of any number type whose ``abs`` is a float; not changed. Rows are weighed by their
        size: units should be such that entries compare (a frame of size 1)
    columns : number of unknowns, also where there are no rows
    zero : a pivot below this fraction of the first, times m, counts as none
    unit : the first pivot is measured by itself or this, whichever is larger: where all rows are
        rounding of terms of this size, none counts
    vanishes : of balls, what decides instead: a pivot is the largest that is certainly not zero

    Raises
    ------
    MoreDigits
        Of balls, where it is open whether all that is left is zero.
    """
    work = [list(row) for row in rows]
    order = list(range(columns))
    limit = zero * max(len(work), 1)
    pivots: list[float] = []
    rank = 0
    dropped = 0.0
    while rank < min(len(work), columns):
        size, r, c = _largest(work, rank, columns, vanishes is not None)
        if vanishes is None:
            fraction = size / (pivots[0] if pivots else max(size, unit)) if size else 0.0
            if fraction <= limit:
                dropped = fraction
                break
        elif size <= 0.0:
            for row in work[rank:]:
                for value in row[rank:columns]:
                    vanishes(value, max((unit, *pivots)))  # raises where that is open
            break
        pivots.append(size)
        _pivot(work, order, rank, r, c)
        rank += 1
    basis = tuple(_back_substituted(work, order, rank, free) for free in range(rank, columns))
    top = pivots[0] if pivots else 1.0
    return NullSpace(basis, rank, tuple(p / top for p in pivots), dropped)


def _largest(work: list[list[Scalar]], rank: int, columns: int, certain: bool) -> tuple[float, int, int]:
    """The largest entry; if ``certain``, of those that are certainly not zero."""
    best, where = 0.0 if certain else -1.0, (rank, rank)
    for r in range(rank, len(work)):
        row = work[r]
        for c in range(rank, columns):
            size = abs(row[c])
            if size > best and (not certain or getattr(row[c], "is_certain", True)):
                best, where = size, (r, c)
    return best, where[0], where[1]


def _pivot(work: list[list[Scalar]], order: list[int], rank: int, r: int, c: int) -> None:
    work[rank], work[r] = work[r], work[rank]
    order[rank], order[c] = order[c], order[rank]
    for row in work:
        row[rank], row[c] = row[c], row[rank]
    top = work[rank]
    for row in work[rank + 1 :]:
        if not row[rank]:  # a zero that varies is none: of a number on a tape it has derivatives
            continue
        ratio = row[rank] / top[rank]
        for k in range(rank + 1, len(row)):
            row[k] = row[k] - ratio * top[k]
        row[rank] = 0.0


def _back_substituted(work: list[list[Scalar]], order: list[int], rank: int, free: int) -> tuple[Scalar, ...]:
    x: list[Scalar] = [0.0] * len(order)
    x[free] = 1.0
    for r in range(rank - 1, -1, -1):
        row = work[r]
        total = row[free]
        for k in range(r + 1, rank):
            total = total + row[k] * x[k]
        x[r] = -total / row[r]
    result: list[Scalar] = [0.0] * len(order)
    for place, column in enumerate(order):
        result[column] = x[place]
    return tuple(result)
