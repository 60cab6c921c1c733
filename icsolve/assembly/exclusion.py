"""Every solution of a group of points that only all their data together place, shown to be all.

The conditions are polynomials of degree two in the coordinates, and lengths bound these: so
`icsolve.numbers.quadratics` finds all.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import partial

import numpy as np

from icsolve.assembly.loci import Axis, PlacedLine, intersection, sine_between
from icsolve.assembly.steps import PointGroup
from icsolve.assembly.workspace import GUIDE, LENGTH, RAY, Workspace, X, Y, data_in
from icsolve.numbers.quadratics import SLACK, Array, Mask, Narrowing, Quadratics, every_zero
from icsolve.screws import Point
from icsolve.tuples import NamedTuple

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


class _Link(NamedTuple):
    """A length between two points: columns of x of each in a box, or their fixed place; and its square."""

    a: int
    b: int
    fixed_a: Point
    fixed_b: Point
    square: float


def every_solution(
    group: PointGroup,
    workspace: Workspace,
    most: int,
    about: Mapping[str, Point] | None = None,
    within: float = math.inf,
) -> FigureSolutions:
    """All solutions of a group, each once, by exclusion of boxes in which an equation has no zero.

    Parameters
    ----------
    group : equations that are quadratic in the coordinates (lengths, angles; not ropes)
    workspace : the points that are placed; those of the group are moved about
    most : boxes at most
    about, within : places of some of its points, and the root of the sum of squares of how far from these it
        is searched [frame]
    """
    system = quadratics_of(group, workspace)
    low, high, bounded = _bounds(group, workspace)
    links = _links(group, workspace)
    size = math.sqrt(max((link.square for link in links), default=1.0)) or 1e-300
    narrowing: list[Narrowing] = [partial(_narrow_length, link) for link in links]
    if about is not None and within < math.inf:
        places = [about.get(t, (math.nan, math.nan))[axis] for t in group.targets for axis in (0, 1)]
        low, high = np.fmax(low, np.array(places) - within), np.fmin(high, np.array(places) + within)
        bounded = bounded or about.keys() >= set(group.targets)
        narrowing.append(partial(_narrow_ball, np.array(places), within))
    zeros = every_zero(system, low, high, most, size, narrowing)
    places = [
        {t: (float(z[2 * k]), float(z[2 * k + 1])) for k, t in enumerate(group.targets)} for z in zeros.found
    ]
    return FigureSolutions(places, bounded and zeros.complete, zeros.boxes, zeros.movable)


def quadratics_of(group: PointGroup, workspace: Workspace) -> Quadratics:
    """The equations' coefficients, from their values and derivatives at the corners of the unit box.

    Not of a rope, whose length is no polynomial; the points of the group are moved about.
    """
    unknowns = group.unknowns()
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
    return Quadratics(np.array(constant), gradient, hessian)


def _links(group: PointGroup, workspace: Workspace) -> list[_Link]:
    column = {t: 2 * k for k, t in enumerate(group.targets)}
    out = []
    for datum in data_in(group):
        if datum.kind == LENGTH:
            a, b = datum.points
            fixed = [(0.0, 0.0) if p in column else workspace.points[p] for p in (a, b)]
            length = float(workspace.length(datum))
            out.append(_Link(column.get(a, -1), column.get(b, -1), fixed[0], fixed[1], length * length))
    return out


def _bounds(group: PointGroup, workspace: Workspace) -> tuple[Array, Array, bool]:
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
    group: PointGroup, workspace: Workspace, reach: Mapping[tuple[str, ...], float]
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


def _lines(group: PointGroup, workspace: Workspace) -> Iterator[tuple[str, PlacedLine]]:
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


def _narrow_ball(centre: Array, radius: float, low: Array, high: Array) -> None:
    """Narrow boxes by a ball, whose centre is not a number where it reaches without end."""
    squares = np.nan_to_num(np.clip(centre, low, high) - centre) ** 2
    left = radius * radius + SLACK - squares.sum(axis=1, keepdims=True) + squares
    reach = np.sqrt(np.maximum(left, 0.0)) + SLACK
    np.fmax(low, centre - reach, out=low)
    np.fmin(high, centre + reach, out=high)
    high[(left < 0.0).any(axis=1)] = -np.inf


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
        near = np.sqrt(np.maximum(0.0, link.square - most * most)) - SLACK
        d_low, d_high = np.maximum(spans[axis][0], -far), np.minimum(spans[axis][1], far)
        d_low = np.where(d_low > -near, np.maximum(d_low, near), d_low)
        d_high = np.where(d_high < near, np.minimum(d_high, -near), d_high)
        empty = d_low > d_high
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
