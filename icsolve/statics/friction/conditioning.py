"""The equations of the rubs in coordinates of which all that they tell is made with moderate coefficients.

Beside a dead centre or a change point forces are thousands of times the frictions and loads that make them:
beside such coefficients doubles lose the others, and solutions with them. Here the coordinates are those of
the sizes and forces that vary most, one after the other (elimination with complete pivoting), found on balls,
so that each coefficient is rounded once.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from icsolve.numbers import Scalar, largest_of
from icsolve.numbers.balls import Ball, MoreDigits
from icsolve.statics.equilibrium import Statics
from icsolve.statics.friction.equations import Form, Lengths, Reduced, forces_of, smooth_normals, touching_of

SHARP = 2.0**-60
"""A ball is as good as a number where its radius is below this fraction of the largest in its row."""


def conditioned(exact: Statics, senses: Sequence[float]) -> Reduced | None:
    """The equations of the rubs in such coordinates; None where power leaves more than as many open.

    Parameters
    ----------
    exact : statics on balls, with friction as parameters
    senses : (rubs,), those of the rubbing motions of the second links: 1, -1, or 0 for no friction

    Raises
    ------
    LookupError
        Where equilibrium does not determine a force that presses.
    MoreDigits
        Where the balls leave a pivot, or more of a coefficient than its last digits, open.
    """
    roots, rubs = len(exact.roots), len(exact.rubs)
    gains = [-sense * rub.limit for sense, rub in zip(senses, exact.rubs, strict=True)]

    def own(column: int) -> list[Scalar]:
        return [float(c == column) for c in range(roots + rubs + 1)]

    def whole(row: Mapping[int, Scalar]) -> list[Scalar]:
        loads = [row.get(exact.root(n), 0.0) for n in range(roots)]
        frictions = [row.get(exact.rub(k), 0.0) * gain for k, gain in enumerate(gains)]
        return [*loads, *frictions, row.get(exact.known, 0.0)]

    sizes, loads = [own(roots + k) for k in range(rubs)], [own(n) for n in range(roots)]
    vectors = [[whole(row) for row in rows] for rows in forces_of(exact)]
    smooth = [whole(row) for row in smooth_normals(exact)]
    asked = [*sizes, *(row for rows in vectors for row in rows)]
    table = _Table([whole(left) for left in exact.general.left], asked, [*smooth, *loads], roots)
    table.turn()
    if len(table.chosen) != rubs:
        return None
    place = {row: row for row in table.chosen if row < rubs}
    others = iter([k for k in range(rubs) if k not in place])
    place |= {row: next(others) for row in table.chosen if row >= rubs}
    order = [table.chosen[row] for row in sorted(place, key=place.__getitem__)]

    def forms(rows: Iterable[list[Scalar]]) -> tuple[Form, ...]:
        return tuple([_rounded([row[-1], *(row[c] for c in order)]) for row in rows])

    lengths = Lengths(forms(sizes), tuple(map(forms, vectors)), touching_of(exact))
    return Reduced(lengths, forms(loads), tuple(map(float, gains)), forms(smooth))


class _Table:
    """Affine forms in columns, the last of which is the constant; ``chosen`` has, by the rows of those asked
    that became coordinates, their columns."""

    def __init__(
        self,
        powers: list[list[Scalar]],
        asked: list[list[Scalar]],
        others: list[list[Scalar]],
        roots: int,
    ) -> None:
        self.powers, self.asked, self.others = powers, asked, others
        self.open = list(range(len(asked[0]) - 1))
        self.chosen: dict[int, int] = {}
        self.weights = [1.0] * len(self.open)
        for n in range(roots):  # a load counts by what it does to the forces
            largest = largest_of([row[n] for row in asked]) or largest_of([row[n] for row in powers])
            self.weights[n] = 1.0 / largest if largest else 1.0

    def turn(self) -> None:
        """Take the sums of power, which are zero, and then rows that are asked for as coordinates, until no
        column is open that one of them hangs on."""
        for _ in self.powers[: len(self.open)]:
            row, column = self._largest(self.powers, ())
            if self.powers[row][column]:
                self._substitute(self.powers[row], column, 0.0)
        while self.open:
            row, column = self._largest(self.asked, self.chosen)
            if not self.asked[row][column]:
                return
            self._substitute(self.asked[row], column, 1.0)
            self.chosen[row] = column

    def _largest(self, rows: Sequence[list[Scalar]], without: Iterable[int]) -> tuple[int, int]:
        """The row and open column of the largest entry; raises MoreDigits where it may be zero."""
        places = [(n, c) for n in range(len(rows)) if n not in without for c in self.open]
        row, column = max(places, key=lambda at: abs(float(rows[at[0]][at[1]])) * self.weights[at[1]])
        if isinstance(pivot := rows[row][column], Ball) and not pivot.is_certain:
            raise MoreDigits
        return row, column

    def _substitute(self, pivot: list[Scalar], column: int, unit: float) -> None:
        """Put what a row says of a column into all others: the column is then that of the row's value, or of
        nothing."""
        whole, size = list(pivot), pivot[column]
        for rows in (self.powers, self.asked, self.others):
            for row in rows:
                share = row[column] / size
                if share and row is not pivot:
                    row[:] = [a - share * b for a, b in zip(row, whole, strict=True)]
                    row[column] = share * unit
        pivot[:] = [unit if c == column else 0.0 for c in range(len(pivot))]
        self.open.remove(column)


def _rounded(row: Sequence[Scalar]) -> Form:
    """A row of doubles; raises MoreDigits where the balls are not sharp."""
    room = SHARP * largest_of(row)
    if any(isinstance(a, Ball) and a.radius > room and not a.arithmetic.highest for a in row):
        raise MoreDigits
    return tuple(map(float, row))
