"""Sparse elimination of homogeneous linear equations, in rows of column: coefficient.

Some columns are to be solved for, the others are parameters. Markowitz's rule keeps rows short (the
row with the fewest entries, in it the column that the fewest rows share) among pivots that are at
least a tenth of their row (threshold pivoting: Duff, Erisman and Reid, Direct Methods for Sparse
Matrices, 1986, ch. 5 and 7).
"""

from __future__ import annotations

import heapq
from collections.abc import Mapping, Sequence

from icsolve.numbers.arithmetic import Scalar, magnitude
from icsolve.numbers.null_space import Vanishes
from icsolve.tuples import NamedTuple

Row = dict[int, Scalar]

THRESHOLD = 0.1
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
            self.sizes[n] = max((magnitude(row[c]) for c in inner), default=0.0)
            for c in inner:
                self.holders[c].add(n)
        self.heap = [(len(self.inner(row)), n) for n, row in self.rows.items()]
        heapq.heapify(self.heap)

    def inner(self, row: Row) -> list[int]:
        """The columns of a row that are to be solved for."""
        return [c for c in row if c < self.columns]

    def next_row(self) -> tuple[int | None, Row] | None:
        """The shortest row and its pivot column (None where it has none left); None at the end."""
        while self.heap:
            count, n = heapq.heappop(self.heap)
            row = self.rows.get(n)
            if row is None:
                continue
            inner = self.inner(row)
            if len(inner) > count:
                heapq.heappush(self.heap, (len(inner), n))
                continue
            del self.rows[n]
            for c in inner:
                self.holders[c].discard(n)
            return self.pivot(row, inner, self.sizes[n]), row
        return None

    def pivot(self, row: Row, inner: list[int], size: float) -> int | None:
        """The column of a row that the fewest others share, among those that are large enough."""
        if self.vanishes is not None:
            certain = [c for c in inner if getattr(row[c], "is_certain", True)]
            if not certain:
                for c in inner:
                    self.vanishes(row[c], size)  # raises where that is open
                return None
            inner = certain
        largest = max((magnitude(row[c]) for c in inner), default=0.0)
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
