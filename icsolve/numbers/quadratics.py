"""Every solution of as many quadratic equations as unknowns in a box, shown to be all, by exclusion.

Boxes are narrowed by single equations, thrown away where one can't be met, and split, until each is empty or
holds exactly one solution (R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis, 2009,
ch. 8). For a box with the middle m and the radii r, and Y near the inverse of the derivatives J at m, a
solution m + d has

    d = -Y (f(m) + d'Hd / 2) + (1 - Y J) d,   so that   |d + Y f(m)| <= |Y| (r'|H|r / 2) + |1 - Y J| r  =: s

and where 2 s < r there is at most one in the box. Roundings are covered by `SLACK`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import numpy.typing as npt

from icsolve.tuples import NamedTuple

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]
Narrowing = Callable[[Array, Array], None]
"""Narrows boxes, lower and upper ends (k, n), by what their solutions meet besides; an empty one gets ends
that cross."""

SLACK = 1e-12
"""Outward rounding of every bound: far more than some hundred operations on numbers of size 1 to 10 lose."""
BATCH = 2048
MOST_DOUBLE = 64
"""More double solutions than these are a curve of them."""
FINEST = 1e-8
"""Radius, over the solutions' size, at which a box that is neither empty nor sure holds a double one."""
FINE_ENOUGH = 0.3
"""Radius, over that size, from which the derivatives' inverse is tried."""

FLATTEST = 0.05
"""Smallest radius over the largest of what is tried: on the rim of a circle a box is narrowed to so flat a
one that nothing can be shown of it."""


class Zeros(NamedTuple):
    """The solutions found, (n,) each.

    Attributes
    ----------
    complete : whether these are shown to be all
    boxes : how many boxes were searched
    movable : whether they lie along a curve, of which these are some
    spent : whether boxes were left
    """

    found: list[Array]
    complete: bool
    boxes: int
    movable: bool
    spent: bool


class Quadratics(NamedTuple):
    """f(z) = constant + gradient z + z'Hz / 2, one row an equation.

    constant : (n,), gradient : (n, n), hessian : (n, n, n)
    """

    constant: Array
    gradient: Array
    hessian: Array

    def at(self, z: Array) -> tuple[Array, Array]:
        """Values (k, m) and derivatives (k, m, n) at points (k, n)."""
        bent = np.einsum("mij,kj->kmi", self.hessian, z)
        values = self.constant + z @ self.gradient.T + np.einsum("kmi,ki->km", bent, z) / 2.0
        return values, bent + self.gradient

    def bound(self, r: Array) -> Array:
        """Most that the terms of degree two change within radii (k, n): r'|H|r / 2, (k, m)."""
        most = np.einsum("mij,kj->kmi", np.abs(self.hessian), r)
        return np.asarray(np.einsum("kmi,ki->km", most, r) / 2.0)


def every_zero(
    system: Quadratics,
    low: Array,
    high: Array,
    most: int,
    size: float = 1.0,
    narrowing: Sequence[Narrowing] = (),
) -> Zeros:
    """All solutions in a box, each once, by exclusion of boxes in which an equation has no zero.

    Parameters
    ----------
    system : n equations in n unknowns, of size 1 to 10
    low, high : (n,)
    most : boxes at most
    size : of the solutions
    narrowing : what narrows boxes besides linear equations
    """
    search = _Exclusion(system, low, high, size, most)
    search.run(narrowing)
    return Zeros(search.found, search.complete, search.boxes, search.movable, search.spent)


class _Exclusion:
    """Boxes still to be searched, and the solutions found."""

    def __init__(self, system: Quadratics, low: Array, high: Array, size: float, most: int) -> None:
        self.system, self.size, self.most = system, size, most
        self.linear = [m for m in range(len(system.constant)) if not system.hessian[m].any()]
        self.low, self.high = low[None, :], high[None, :]
        self.found: list[Array] = []
        self.double: list[Array] = []
        self.boxes = 0
        self.complete = True
        self.movable = self.spent = False

    def run(self, narrowing: Sequence[Narrowing]) -> None:
        """Search until no box is left, or there were too many."""
        with np.errstate(all="ignore"):
            while len(self.low):
                if self.boxes > self.most:
                    self.complete, self.spent = False, True
                    break
                low, high = self.low[-BATCH:], self.high[-BATCH:]
                self.low, self.high = self.low[:-BATCH], self.high[:-BATCH]
                self.boxes += len(low)
                self._batch(low, high, narrowing)
        if self.double:
            near = 1e3 * FINEST * self.size
            cells = np.unique(np.round(np.array(self.double) / near), axis=0)
            self.movable = len(cells) > MOST_DOUBLE
            for z in cells[:MOST_DOUBLE] * near:
                self._keep(z, near)

    def _batch(self, low: Array, high: Array, narrowing: Sequence[Narrowing]) -> None:
        before = (high - low).max(axis=1)
        for _ in range(3):
            low, high = low.copy(), high.copy()
            for narrow in narrowing:
                narrow(low, high)
            for m in self.linear:
                self._narrow_linear(m, low, high)
            alive = np.all(low <= high, axis=1)
            low, high, before = low[alive], high[alive], before[alive]
            if not len(low):
                return
        middle, radius = (low + high) / 2.0, (high - low) / 2.0 + SLACK
        values, slopes = self.system.at(middle)
        most = np.einsum("kmn,kn->km", np.abs(slopes), radius) + self.system.bound(radius)
        alive = (np.abs(values) <= most + SLACK).all(axis=1)
        low, high, before, middle, radius, values, slopes = (
            each[alive] for each in (low, high, before, middle, radius, values, slopes)
        )
        small = radius.max(axis=1) < FINE_ENOUGH * self.size
        if small.any():
            low, high, before = self._by_inverse(low, high, before, middle, radius, values, slopes, small)
        self._again(low, high, before)

    def _narrow_linear(self, m: int, low: Array, high: Array) -> None:
        """Narrow every unknown of a linear equation by what the others leave it."""
        columns = np.flatnonzero(self.system.gradient[m])
        row = self.system.gradient[m, columns]
        ends = np.stack([low[:, columns] * row, high[:, columns] * row])
        least, most = ends.min(axis=0), ends.max(axis=0)
        others = np.stack([least.sum(axis=1)[:, None] - least, most.sum(axis=1)[:, None] - most])
        ends = -(self.system.constant[m] + others) / row
        low[:, columns] = np.maximum(low[:, columns], ends.min(axis=0) - SLACK)
        high[:, columns] = np.minimum(high[:, columns], ends.max(axis=0) + SLACK)

    def _by_inverse(
        self,
        low: Array,
        high: Array,
        before: Array,
        middle: Array,
        radius: Array,
        values: Array,
        slopes: Array,
        small: Mask,
    ) -> tuple[Array, Array, Array]:
        """What the test with the inverse of the derivatives leaves of the boxes; solutions are kept."""
        n = radius.shape[1]
        which = np.flatnonzero(small)
        j, r = slopes[which], radius[which] * 1.1 + SLACK
        r = np.maximum(r, FLATTEST * r.max(axis=1, keepdims=True))
        inverse = _inverses(j)
        sure = np.isfinite(inverse).all(axis=(1, 2))
        inverse[~sure] = 0.0
        rest = np.abs(np.eye(n) - inverse @ j)
        spread = np.einsum("knm,km->kn", np.abs(inverse), self.system.bound(r) + SLACK)
        spread += np.einsum("kij,kj->ki", rest, r)
        shift = -np.einsum("knm,km->kn", inverse, values[which])
        apart = sure & (np.abs(shift) > spread + r).any(axis=1)
        single = sure & (2.0 * spread < r).all(axis=1)
        holds = single & (np.abs(shift) + spread < r).all(axis=1)
        for k in np.flatnonzero(holds):
            self._refined(middle[which[k]] + shift[k])
        usable = sure & ~apart & ~holds
        rows = which[usable]
        low[rows] = np.maximum(low[rows], middle[rows] + shift[usable] - spread[usable])
        high[rows] = np.minimum(high[rows], middle[rows] + shift[usable] + spread[usable])
        keep = np.ones(len(low), dtype=bool)
        keep[which[apart | holds]] = False
        keep &= (low <= high).all(axis=1)
        return low[keep], high[keep], before[keep]

    def _again(self, low: Array, high: Array, before: Array) -> None:
        """Split the boxes that did not shrink; what is too fine to split is a double solution."""
        width = high - low
        widest = width.max(axis=1)
        fine = widest < 2.0 * FINEST * self.size
        if fine.any():
            self.double.extend(((low + high) / 2.0)[fine])
            self.complete = False
            low, high, width, widest, before = (each[~fine] for each in (low, high, width, widest, before))
        shrunk = widest < 0.6 * before
        kept_low, kept_high = [low[shrunk]], [high[shrunk]]
        low, high, width = low[~shrunk], high[~shrunk], width[~shrunk]
        if len(low):
            rows, at = np.arange(len(low)), width.argmax(axis=1)
            middle = (low[rows, at] + high[rows, at]) / 2.0
            left, right = high.copy(), low.copy()
            left[rows, at], right[rows, at] = middle, middle
            kept_low += [low, right]
            kept_high += [left, high]
        self.low = np.concatenate([self.low, *kept_low])
        self.high = np.concatenate([self.high, *kept_high])

    def _refined(self, z: Array) -> None:
        """Newton's steps to the solution that a box holds."""
        for _ in range(6):
            values, slopes = self.system.at(z[None, :])
            z = z - np.linalg.solve(slopes[0], values[0])
        self._keep(z, 1e-9 * self.size)

    def _keep(self, z: Array, near: float) -> None:
        if all(float(np.abs(z - other).max()) > near for other in self.found):
            self.found.append(z)


def _inverses(matrices: Array) -> Array:
    """The inverses; not a number where a matrix is singular."""
    try:
        return np.asarray(np.linalg.inv(matrices))
    except np.linalg.LinAlgError:
        bad = np.full_like(matrices, np.nan)
        for k, matrix in enumerate(matrices):
            try:
                bad[k] = np.linalg.inv(matrix)
            except np.linalg.LinAlgError:
                continue
        return bad
