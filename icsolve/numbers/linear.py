"""Small dense systems on floats, real or complex, and balls: Gaussian elimination with partial pivoting."""

from __future__ import annotations

from collections.abc import Sequence

from icsolve.numbers.arithmetic import Scalar
from icsolve.numbers.null_space import Vanishes

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
    n = len(matrix)
    work = [[*row, b] for row, b in zip(matrix, right, strict=True)]
    sizes = [max((abs(entries[c]) for entries in matrix), default=0.0) for c in range(n)]
    for c in range(n):
        r = _largest(work, c)
        pivot = work[r][c]
        if vanishes(pivot, sizes[c]) if vanishes else abs(pivot) <= SINGULAR * sizes[c]:
            return None
        work[c], work[r] = work[r], work[c]
        for below in work[c + 1 :]:
            _subtract(below, work[c], c)
    return _back(work)


def _largest(work: list[list[Scalar]], c: int) -> int:
    """The row, from the c-th on, with the largest entry in column c."""
    return max(range(c, len(work)), key=lambda k: abs(work[k][c]))


def _subtract(row: list[Scalar], pivot: list[Scalar], c: int) -> None:
    if row[c]:
        ratio = row[c] / pivot[c]
        for k in range(c + 1, len(row)):
            row[k] -= ratio * pivot[k]


def _back(work: list[list[Scalar]]) -> list[Scalar]:
    n = len(work)
    x = [row[n] for row in work]
    for r in range(n - 1, -1, -1):
        for k in range(r + 1, n):
            x[r] -= work[r][k] * x[k]
        x[r] /= work[r][r]
    return x


def inverse(matrix: Sequence[Sequence[float]]) -> list[list[float]] | None:
    """The inverse of a small matrix (n, n), by rows; None where it is singular (as in `solve_square`)."""
    n = len(matrix)
    columns = [solve_square(matrix, [float(r == c) for r in range(n)]) for c in range(n)]
    if any(column is None for column in columns):
        return None
    return [[column[r] for column in columns if column is not None] for r in range(n)]
