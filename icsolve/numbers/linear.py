"""Linear equations on any numbers whose ``abs`` is a float: square systems, null spaces, sparse elimination.

Square systems take partial pivoting. Null spaces take complete pivoting, which is backward stable enough to
decide ranks of the small systems of a linkage (N. J. Higham, Accuracy and Stability of Numerical
Algorithms, 2002, ch. 9). In sparse elimination some columns are to be solved for and the others are
parameters; Markowitz's rule keeps rows short (the row with the fewest entries, in it the column that the
fewest rows share) among pivots that are at least a tenth of their row (threshold pivoting: Duff, Erisman
and Reid, Direct Methods for Sparse Matrices, 1986, ch. 5 and 7). None of them needs numpy.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Mapping, Sequence
from typing import cast

from icsolve.numbers import ZERO, Scalar, largest_of, magnitude
from icsolve.tuples import NamedTuple

SINGULAR = 1e-14
"""A pivot below this fraction of the largest entry of its column counts as none."""


def solve_square(
    matrix: Sequence[Sequence[Scalar]], right: Sequence[Scalar], vanishes: Vanishes | None = None
) -> list[Scalar] | None:
    """x with ``matrix @ x = right``, by elimination with partial pivoting.

    Parameters
    ----------
    matrix : (n, n), by rows: floats, complex numbers or balls; not changed
    right : (n,)
    vanishes : of balls, what decides whether a pivot is zero, by the size of its column

    Returns
    -------
    list[Scalar] | None
        (n,); None where the matrix is singular: a pivot below 1e-14 of the largest entry of its column as
        given, of balls one that ``vanishes``.

    Raises
    ------
    MoreDigits
        Of balls, where it is open whether a pivot is zero.
    """
    work = [[*row, b] for row, b in zip(matrix, right, strict=True)]
    return _back(work, len(matrix)) if _is_triangular(work, vanishes) else None


def _is_triangular(work: list[list[Scalar]], vanishes: Vanishes | None = None) -> bool:
    """Make the first square of rows triangular, by partial pivoting; false where it is singular."""
    n = len(work)
    sizes = [max(abs(entries[c]) for entries in work) for c in range(n)]
    for c in range(n):
        r = _largest(work, c)
        pivot = work[r][c]
        if vanishes(pivot, sizes[c]) if vanishes else abs(pivot) <= SINGULAR * sizes[c]:
            return False
        work[c], work[r] = work[r], work[c]
        for below in work[c + 1 :]:
            _subtract(below, work[c], c)
    return True


def _largest(work: list[list[Scalar]], c: int) -> int:
    """The row, from the c-th on, with the largest entry in column c."""
    return max(range(c, len(work)), key=lambda k: abs(work[k][c]))


def _subtract(row: list[Scalar], pivot: list[Scalar], c: int) -> None:
    if row[c]:
        ratio = row[c] / pivot[c]
        for k in range(c + 1, len(row)):
            row[k] -= ratio * pivot[k]


def _back(work: list[list[Scalar]], column: int) -> list[Scalar]:
    """The solution of triangular rows for one of the right sides behind their square."""
    n = len(work)
    x = [row[column] for row in work]
    for r in range(n - 1, -1, -1):
        for k in range(r + 1, n):
            x[r] -= work[r][k] * x[k]
        x[r] /= work[r][r]
    return x


def determinant(matrix: Sequence[Sequence[Scalar]]) -> Scalar:
    """The determinant of a square matrix, (n, n) by rows, with partial pivoting; 0 where a column is zero."""
    work, found = [list(row) for row in matrix], cast("Scalar", 1)
    for c in range(len(work)):
        r = _largest(work, c)
        if not work[r][c]:
            return work[r][c]
        if r != c:
            work[c], work[r], found = work[r], work[c], -found
        found = found * work[c][c]
        for below in work[c + 1 :]:
            _subtract(below, work[c], c)
    return found


def inverse(matrix: Sequence[Sequence[float]]) -> list[list[float]] | None:
    """The inverse of a small matrix (n, n), by rows; None where it is singular (as in `solve_square`)."""
    n = len(matrix)
    work: list[list[Scalar]] = [[*row, *(float(r == c) for c in range(n))] for r, row in enumerate(matrix)]
    if not _is_triangular(work):
        return None
    return [list(row) for row in zip(*(_back(work, n + c) for c in range(n)), strict=True)]


# --- null space, by complete pivoting -------------------------------------------------------------------


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
    among: int | None = None,
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
    among : pivots are taken in so many columns, the first ones, alone

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
    among = columns if among is None else among
    while rank < min(len(work), among):
        size, r, c = _largest_entry(work, rank, among, vanishes is not None)
        if vanishes is None:
            fraction = size / (pivots[0] if pivots else max(size, unit)) if size else 0.0
            if fraction <= limit:
                dropped = fraction
                break
        elif size <= 0.0:
            for row in work[rank:]:
                for value in row[rank:among]:
                    vanishes(value, max((unit, *pivots)))  # raises where that is open
            break
        pivots.append(size)
        _pivot(work, order, rank, r, c)
        rank += 1
    basis = tuple(_null_vectors(work, order, rank, free) for free in range(rank, columns))
    top = pivots[0] if pivots else 1.0
    return NullSpace(basis, rank, tuple(p / top for p in pivots), dropped)


def _largest_entry(
    work: list[list[Scalar]], rank: int, columns: int, certain: bool
) -> tuple[float, int, int]:
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


def _null_vectors(work: list[list[Scalar]], order: list[int], rank: int, free: int) -> tuple[Scalar, ...]:
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


# --- sparse elimination of homogeneous equations, in rows of column: coefficient ------------------------


Row = dict[int, Scalar]

THRESHOLD = 0.1
SMALL = 1e-4
"""A row whose pivot is below this fraction of what other rows have in its column waits for them: they may
take it out."""
SPENT = 1e-13
"""A row whose largest entry is below this fraction of what it was summed from says nothing more."""


class General(NamedTuple):
    """The general solution of homogeneous equations: of each solved column what it is made of.

    Attributes
    ----------
    solved : by column, its combination of parameters and free columns
    free : columns that the equations leave open
    left : the rows in which only parameters remain; each of these sums has to be zero
    """

    solved: dict[int, Row]
    free: tuple[int, ...]
    left: tuple[Row, ...]
    pivots: tuple[float, ...] = ()
    """what was divided by; of a square system their product is the determinant, but for its sign"""

    def of(self, column: int) -> Row:
        """A column as a combination of parameters and free columns."""
        return self.solved.get(column, {column: 1.0})


def eliminate(
    rows: Sequence[Mapping[int, Scalar]], columns: int, spent: float = SPENT, vanishes: Vanishes | None = None
) -> General:
    """Solve ``sum of row[c] x[c] = 0`` for the columns below ``columns``; the others are parameters.

    Parameters
    ----------
    rows : m equations, each {column: coefficient}; a right side b is a parameter column with -b whose value
        is 1. Not changed
    columns : columns from 0 to below this are solved for
    spent : fraction of a row's size below which its largest entry counts as rounding, so that the row says
        nothing more
    vanishes : of balls, what decides instead: a pivot is certainly not zero

    Returns
    -------
    General
        Nothing is refused: equations that contradict each other stand in ``left``.

    Raises
    ------
    MoreDigits
        Of balls, where it is open whether all that is left of a row is zero.
    """
    work = _Work(rows, columns, spent, vanishes)
    pivots: list[tuple[int, Row]] = []
    left = []
    while (found := work.next_row()) is not None:
        column, row = found
        if column is None:
            left.append({c: a for c, a in row.items() if c >= columns})
            continue
        work.clear(column, row)
        pivots.append((column, row))
    solved = _back_substituted(pivots)
    free = tuple(c for c in range(columns) if c not in solved)
    return General(solved, free, tuple(left), tuple(row[column] for column, row in pivots))


class _Work:
    """The rows that are still active, and which of them each column touches."""

    def __init__(
        self, rows: Sequence[Mapping[int, Scalar]], columns: int, spent: float, vanishes: Vanishes | None
    ) -> None:
        self.columns = columns
        self.spent, self.vanishes = spent, vanishes
        self.rows: dict[int, Row] = {
            n: {c: a for c, a in row.items() if _is_there(a)} for n, row in enumerate(rows)
        }
        self.holders: list[set[int]] = [set() for _ in range(columns)]
        self.sizes: dict[int, float] = {}
        for n, row in self.rows.items():
            inner = self.inner(row)
            self.sizes[n] = largest_of([row[c] for c in inner])
            for c in inner:
                self.holders[c].add(n)
        self.late: list[int] = []
        self.heap = [(len(self.inner(row)), n) for n, row in self.rows.items()]
        heapq.heapify(self.heap)

    def inner(self, row: Row) -> list[int]:
        """The columns of a row that are to be solved for."""
        return [c for c in row if c < self.columns]

    def next_row(self) -> tuple[int | None, Row] | None:
        """The shortest row and its pivot column (None where it has none left); None at the end."""
        while self.heap or self.late:
            waited = not self.heap
            count, n = (self.columns, self.late.pop()) if waited else heapq.heappop(self.heap)
            row = self.rows.get(n)
            if row is None:
                continue
            inner = self.inner(row)
            if len(inner) > count:
                heapq.heappush(self.heap, (len(inner), n))
                continue
            column = self.pivot(row, inner, self.sizes[n])
            if not waited and column is not None and self.is_small(row, column):
                self.late.append(n)
                continue
            del self.rows[n]
            for c in inner:
                self.holders[c].discard(n)
            return column, row
        return None

    def is_small(self, row: Row, column: int) -> bool:
        """Whether a pivot is next to nothing beside its column in other rows."""
        most = largest_of([self.rows[n][column] for n in self.holders[column]])
        return magnitude(row[column]) < SMALL * most

    def pivot(self, row: Row, inner: list[int], size: float) -> int | None:
        """The column of a row that the fewest others share, among those that are large enough."""
        if self.vanishes is not None:
            certain = [c for c in inner if getattr(row[c], "is_certain", True)]
            if not certain:
                for c in inner:
                    self.vanishes(row[c], size)  # raises where that is open
                return None
            inner = certain
        largest = largest_of([row[c] for c in inner])
        if self.vanishes is None and largest <= self.spent * size:
            return None
        fit = [c for c in inner if magnitude(row[c]) >= THRESHOLD * largest]
        return min(fit, key=lambda c: (len(self.holders[c]), -magnitude(row[c]), c))

    def clear(self, column: int, pivot: Row) -> None:
        """Take the column out of every other row."""
        for n in self.holders[column]:
            row = self.rows[n]
            ratio = row.pop(column) / pivot[column]
            for c, a in pivot.items():
                if c != column:
                    self.subtract(n, row, c, ratio * a)
            heapq.heappush(self.heap, (len(self.inner(row)), n))
        self.holders[column] = set()

    def subtract(self, n: int, row: Row, c: int, amount: Scalar) -> None:
        """Subtract from one entry, and keep the books."""
        old = row.get(c, 0.0)
        new = old - amount
        there = _is_there(new)
        if there:
            row[c] = new
        elif c in row:
            del row[c]
        if c < self.columns:
            self.sizes[n] = max(self.sizes[n], magnitude(amount))
            (self.holders[c].add if there else self.holders[c].discard)(n)


def _is_there(value: Scalar) -> bool:
    """Whether a coefficient is kept: all but zeros; arrays, whatever they hold."""
    return value != 0.0 if type(value) is float else hasattr(value, "shape") or bool(value)


def _back_substituted(pivots: list[tuple[int, Row]]) -> dict[int, Row]:
    solved: dict[int, Row] = {}
    for column, row in reversed(pivots):
        total: Row = {}
        for c, a in row.items():
            if c == column:
                continue
            share = a / row[column]
            for p, b in solved[c].items() if c in solved else ((c, 1.0),):
                total[p] = total.get(p, 0.0) - share * b
        solved[column] = total
    return solved
