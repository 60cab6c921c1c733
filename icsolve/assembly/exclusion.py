"""Every solution of a group of points that only all their data together place, shown to be all.

The conditions are polynomials of degree two in the coordinates. Boxes of coordinates are narrowed by single
conditions, thrown away where a condition can't be met, and split, until each is empty or holds exactly one
solution (R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis, 2009, ch. 8). For a box
with the middle m and the radii r, and Y near the inverse of the derivatives J at m, a solution m + d has

    d = -Y (f(m) + d'Hd / 2) + (1 - Y J) d,   so that   |d + Y f(m)| <= |Y| (r'|H|r / 2) + |1 - Y J| r  =: s

and where 2 s < r there is at most one in the box. Roundings are covered by `SLACK`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np
import numpy.typing as npt

from icsolve.assembly.conditions import Unknown
from icsolve.assembly.loci import Axis, PlacedLine, intersection, sine_between
from icsolve.assembly.steps import Group
from icsolve.assembly.workspace import GUIDE, LENGTH, RAY, Workspace, X, Y, data_in
from icsolve.screws.plane import Point
from icsolve.tuples import NamedTuple

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

SLACK = 1e-12
"""Outward rounding of every bound: far more than some hundred operations on numbers of size 1 to 10 lose."""
MOST_BOXES = 600_000
BATCH = 2048
MOST_DOUBLE = 64
"""More double solutions than these are a curve of them: the points can move."""
FINEST = 1e-8
"""Radius, over the group's size, at which a box that is neither empty nor sure holds a double solution."""
FINE_ENOUGH = 0.3
"""Radius, over the group's size, from which the derivatives' inverse is tried."""
SHALLOW = 1e-3
"""Sine of the smallest angle of two guides that bound the points on them."""
UNBOUNDED = 50.0
"""Half the width, over the group's size, of the search for points that no lengths hold."""


class FigureSolutions(NamedTuple):
    """The solutions of a group.

    Attributes
    ----------
    places : of each solution the points by name, (x, y) [frame]
    complete : whether these are shown to be all
    boxes : how many boxes were searched
    movable : whether they lie along a curve, of which the places are some
    """

    places: list[dict[str, Point]]
    complete: bool
    boxes: int
    movable: bool


class _Quadratics(NamedTuple):
    """f(z) = constant + gradient z + z'Hz / 2, one row an equation.

    constant : (m,), gradient : (m, n), hessian : (m, n, n)
    """

    constant: Array
    gradient: Array
    hessian: Array
    bends: Array

    def at(self, z: Array) -> tuple[Array, Array]:
        """Values (k, m) and derivatives (k, m, n) at points (k, n)."""
        bent = np.einsum("mij,kj->kmi", self.hessian, z)
        values = self.constant + z @ self.gradient.T + np.einsum("kmi,ki->km", bent, z) / 2.0
        return values, bent + self.gradient

    def bound(self, r: Array) -> Array:
        """Most that the terms of degree two change within radii (k, n): r'|H|r / 2, (k, m)."""
        total: Array = np.einsum("mij,ki,kj->km", self.bends, r, r, optimize=True)
        return total / 2.0


class _Link(NamedTuple):
    """A length between two points: columns of x of each in a box, or their fixed place; and its square."""

    a: int
    b: int
    fixed_a: Point
    fixed_b: Point
    square: float


def every_solution(group: Group, workspace: Workspace) -> FigureSolutions:
    """All solutions of a group, each once, by exclusion of boxes in which an equation has no zero.

    Parameters
    ----------
    group : equations that are quadratic in the coordinates (lengths, angles; not ropes)
    workspace : the points that are placed; those of the group are moved about
    """
    unknowns = group.unknowns()
    system = _quadratics(group, workspace, unknowns)
    low, high, bounded = _bounds(group, workspace)
    search = _Exclusion(system, _links(group, workspace), low, high)
    search.run()
    places = [
        {t: (float(z[2 * k]), float(z[2 * k + 1])) for k, t in enumerate(group.targets)} for z in search.found
    ]
    return FigureSolutions(places, bounded and search.complete, search.boxes, search.movable)


def _quadratics(group: Group, workspace: Workspace, unknowns: list[Unknown]) -> _Quadratics:
    """The equations' coefficients, from their values and derivatives at the corners of the unit box."""
    n = len(unknowns)

    def derivatives(z: list[float]) -> tuple[list[float], Array]:
        for k, t in enumerate(group.targets):
            workspace.points[t] = (z[2 * k], z[2 * k + 1])
        rows = [equation.row(workspace) for equation in group.equations]
        return [float(row.value) for row in rows], np.array(
            [[float(row.by.get(u, 0.0)) for u in unknowns] for row in rows]
        )

    constant, gradient = derivatives([0.0] * n)
    columns = [derivatives([float(i == k) for i in range(n)])[1] - gradient for k in range(n)]
    hessian = np.stack(columns, axis=2)
    return _Quadratics(np.array(constant), gradient, hessian, np.abs(hessian))


def _links(group: Group, workspace: Workspace) -> list[_Link]:
    column = {t: 2 * k for k, t in enumerate(group.targets)}
    out = []
    for datum in data_in(group):
        if datum.kind == LENGTH:
            a, b = datum.points
            fixed = [(0.0, 0.0) if p in column else workspace.points[p] for p in (a, b)]
            length = float(workspace.length(datum))
            out.append(_Link(column.get(a, -1), column.get(b, -1), fixed[0], fixed[1], length * length))
    return out


def _bounds(group: Group, workspace: Workspace) -> tuple[Array, Array, bool]:
    """A box that holds every solution, by the lengths that lead from points in place; whether they do."""
    reach = {d.points: float(workspace.length(d)) for d in data_in(group) if d.kind == LENGTH}
    size = max(reach.values(), default=1.0)
    own = set(group.targets)
    low = {t: [-UNBOUNDED * size] * 2 for t in own}
    high = {t: [UNBOUNDED * size] * 2 for t in own}
    held: set[str] = set()
    for at, centre, radius in _anchors(group, workspace, reach):
        for t, d in _distances(at, reach, own).items():
            held.add(t)
            for axis in (0, 1):
                low[t][axis] = max(low[t][axis], centre[axis] - radius - d)
                high[t][axis] = min(high[t][axis], centre[axis] + radius + d)
    bounds = [np.array([side[t][axis] for t in group.targets for axis in (0, 1)]) for side in (low, high)]
    return bounds[0] - SLACK, bounds[1] + SLACK, held == own


def _anchors(
    group: Group, workspace: Workspace, reach: Mapping[tuple[str, ...], float]
) -> Iterator[tuple[str, Point, float]]:
    """Points of which it is known where they are, to within a radius.

    Those in place; and two on known lines that cross under an angle phi, no farther apart than d, of which
    each is within d / sin(phi) of the crossing (the law of sines).
    """
    own = set(group.targets)
    for anchor in {p for pair in reach for p in pair if p not in own}:
        yield anchor, workspace.points[anchor], 0.0
    lines = list(_lines(group, workspace))
    for k, (a, one) in enumerate(lines):
        apart = _distances(a, reach, own)
        for b, two in lines[:k]:
            sine = sine_between(one, two)
            if b in apart and abs(sine) > SHALLOW:
                yield a, intersection(one, two).middle, apart[b] / abs(sine) * (1.0 + SLACK)


def _lines(group: Group, workspace: Workspace) -> Iterator[tuple[str, PlacedLine]]:
    """The points of a group on lines of known place and direction: a point of the line and its direction."""
    own = set(group.targets)
    for datum in data_in(group):
        if datum.kind in (GUIDE, RAY) and len(own & {*datum.points}) == 1:
            a, b = datum.points if datum.points[0] in own else datum.points[::-1]
            yield a, PlacedLine(workspace.points[b], workspace.turn(datum))
        elif datum.kind in (X, Y):
            yield datum.points[0], Axis(datum).placed(workspace)


def _distances(anchor: str, reach: Mapping[tuple[str, ...], float], own: set[str]) -> dict[str, float]:
    """How far each point may be from one in place, along lengths."""
    far = {anchor: 0.0}
    changed = True
    while changed:
        changed = False
        for (a, b), length in reach.items():
            for p, q in ((a, b), (b, a)):
                if p in far and q in own and far[p] + length < far.get(q, math.inf):
                    far[q] = far[p] + length
                    changed = True
    if anchor not in own:
        del far[anchor]
    return far


class _Exclusion:
    """Boxes still to be searched, and the solutions found."""

    def __init__(self, system: _Quadratics, links: list[_Link], low: Array, high: Array) -> None:
        self.system, self.links = system, links
        self.size = float(max(1e-300, math.sqrt(max((link.square for link in links), default=1.0))))
        self.linear = [m for m in range(len(system.constant)) if not system.bends[m].any()]
        self.low, self.high = low[None, :], high[None, :]
        self.found: list[Array] = []
        self.double: list[Array] = []
        self.boxes = 0
        self.complete = True
        self.movable = False

    def run(self) -> None:
        """Search until no box is left, or there were too many."""
        with np.errstate(all="ignore"):
            while len(self.low):
                if self.boxes > MOST_BOXES:
                    self.complete = False
                    break
                low, high = self.low[-BATCH:], self.high[-BATCH:]
                self.low, self.high = self.low[:-BATCH], self.high[:-BATCH]
                self.boxes += len(low)
                self._batch(low, high)
        if self.double:
            near = 1e3 * FINEST * self.size
            cells = np.unique(np.round(np.array(self.double) / near), axis=0)
            self.movable = len(cells) > MOST_DOUBLE
            for z in cells[:MOST_DOUBLE] * near:
                self._keep(z, near)

    def _batch(self, low: Array, high: Array) -> None:
        before = (high - low).max(axis=1)
        for _ in range(3):
            low, high, alive = self._narrowed(low, high)
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

    def _narrowed(self, low: Array, high: Array) -> tuple[Array, Array, Mask]:
        """Boxes narrowed by each length and each linear condition; which of them are not empty."""
        low, high = low.copy(), high.copy()
        for link in self.links:
            _narrow_length(link, low, high)
        for m in self.linear:
            self._narrow_linear(m, low, high)
        return low, high, np.all(low <= high, axis=1)

    def _narrow_linear(self, m: int, low: Array, high: Array) -> None:
        row = self.system.gradient[m]
        columns = np.flatnonzero(row)
        for k in columns:
            rest = [j for j in columns if j != k]
            sides = np.stack([low[:, rest] * row[rest], high[:, rest] * row[rest]])
            sums = np.stack([sides.min(axis=0).sum(axis=1), sides.max(axis=0).sum(axis=1)])
            ends = -(self.system.constant[m] + sums) / row[k]
            low[:, k] = np.maximum(low[:, k], ends.min(axis=0) - SLACK)
            high[:, k] = np.minimum(high[:, k], ends.max(axis=0) + SLACK)

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
        inverse = _inverses(j)
        sure = np.isfinite(inverse).all(axis=(1, 2))
        inverse[~sure] = 0.0
        rest = np.abs(np.eye(n) - inverse @ j)
        spread = np.einsum("knm,km->kn", np.abs(inverse), self.system.bound(r) + SLACK)
        spread += np.einsum("kij,kj->ki", rest, r) + SLACK
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


def _narrow_length(link: _Link, low: Array, high: Array) -> None:
    """Narrow the places of two points by their distance: each axis by the other, both ways."""
    spans = []
    for axis in (0, 1):
        a_low, a_high = _side(link.a, link.fixed_a, axis, low, high)
        b_low, b_high = _side(link.b, link.fixed_b, axis, low, high)
        spans.append((b_low - a_high - SLACK, b_high - a_low + SLACK))
    for axis in (0, 1):
        other_low, other_high = spans[1 - axis]
        most = np.maximum(np.abs(other_low), np.abs(other_high))
        least = np.maximum(0.0, np.maximum(other_low, -other_high))
        far = np.sqrt(np.maximum(0.0, link.square - least * least)) + SLACK
        far = np.where(link.square - least * least < -SLACK, -1.0, far)
        near = np.sqrt(np.maximum(0.0, link.square - most * most)) - SLACK
        d_low, d_high = np.maximum(spans[axis][0], -far), np.minimum(spans[axis][1], far)
        d_low = np.where(d_low > -near, np.maximum(d_low, near), d_low)
        d_high = np.where(d_high < near, np.minimum(d_high, -near), d_high)
        empty = (far < 0.0) | (d_low > d_high)
        spans[axis] = (d_low, d_high)
        _put(link, axis, d_low, d_high, empty, low, high)


def _side(column: int, fixed: Point, axis: int, low: Array, high: Array) -> tuple[Array, Array]:
    if column < 0:
        place = np.full(len(low), fixed[axis])
        return place, place
    return low[:, column + axis].copy(), high[:, column + axis].copy()


def _put(link: _Link, axis: int, d_low: Array, d_high: Array, empty: Mask, low: Array, high: Array) -> None:
    """Narrow both ends by the difference of their coordinates, whose bounds lie outward by `SLACK`; an empty
    box gets bounds that cross."""
    a_low, a_high = _side(link.a, link.fixed_a, axis, low, high)
    b_low, b_high = _side(link.b, link.fixed_b, axis, low, high)
    if link.b >= 0:
        low[:, link.b + axis] = np.where(empty, np.inf, np.maximum(b_low, a_low + d_low))
        high[:, link.b + axis] = np.minimum(b_high, a_high + d_high)
    if link.a >= 0:
        low[:, link.a + axis] = np.where(empty, np.inf, np.maximum(a_low, b_low - d_high))
        high[:, link.a + axis] = np.minimum(a_high, b_high - d_low)
