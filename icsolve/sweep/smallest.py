"""The smallest set of links that only all their conditions together determine, by rank as written."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from itertools import combinations

import numpy as np
import numpy.typing as npt

from icsolve.assembly.workspace import Workspace
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import FLOATS
from icsolve.screws.plane import Point
from icsolve.sweep.closing import Newton, Order, touching
from icsolve.sweep.constraints import Constraint, Row, Rows
from icsolve.sweep.mechanism import Mechanism
from icsolve.sweep.poses import Moved, Places, Shape, Spot, Still
from icsolve.wording.sentences import listed

DEPENDENT = 1e-10
"""A singular value below this fraction of the largest is zero (normalised frame)."""
MOST_TRIED = 4000

Matrix = npt.NDArray[np.float64]


def bases_of(mechanism: Mechanism, bodies: Iterable[int]) -> dict[int, Spot]:
    """For each body the spot that its place is told by: a pin where it has one."""
    pins = mechanism.shape.joined
    return {
        body: next((spot for spot in mechanism.spots[body] if spot in pins), mechanism.spots[body][0])
        for body in bodies
    }


def equations(
    mechanism: Mechanism,
    rows: Rows,
    constraints: Iterable[Constraint],
    known: Moved | None = None,
) -> Iterator[Row]:
    """The equations of the bodies of ``rows``: their conditions and their pins.

    ``known`` has the spots that are located; without it the other bodies stand as written.
    """
    for c in constraints:
        yield rows.of(c)
    members: dict[Spot, list[Spot]] = {}
    for spot, one in mechanism.shape.joined.items():
        members.setdefault(one, []).append(spot)
    for one, spots in members.items():
        own = [spot for spot in spots if spot[0] in rows.bases]
        fixed = _fixed(one, spots, rows, known)
        first = own[:1] if fixed is None else []
        for spot in own[len(first) :]:
            yield from rows.pinned(spot, first[0]) if fixed is None else rows.held(spot, fixed)


def _fixed(one: Spot, spots: list[Spot], rows: Rows, known: Moved | None) -> Point | None:
    """Where a pin is known to be."""
    if known is not None:
        return known.located.get(one)
    others = [spot for spot in spots if spot[0] not in rows.bases]
    return rows.places.place(others[0]) if others else None


def jacobian(mechanism: Mechanism, bodies: Sequence[int], constraints: Iterable[Constraint]) -> Matrix:
    """Derivatives of all equations of some bodies in the position as written, the others held."""
    bases = bases_of(mechanism, bodies)
    rows = Rows(mechanism.shape, Still(mechanism.shape), bases, _board(mechanism))
    return matrix(bodies, equations(mechanism, rows, constraints))


def matrix(bodies: Sequence[int], rows: Iterable[Row]) -> Matrix:
    """The derivatives by the three parts of each body."""
    column = {body: 3 * n for n, body in enumerate(bodies)}
    found = []
    for row in rows:
        line = np.zeros(3 * len(bodies))
        for (body, part), value in row.by.items():
            if body in column:
                line[column[body] + part] += float(value)
        found.append(line)
    return np.array(found).reshape(len(found), 3 * len(bodies))


def _board(mechanism: Mechanism) -> Workspace:
    return Workspace(mechanism.case, mechanism.frame, FLOATS)


def rank(m: Matrix) -> int:
    """Rank of a matrix whose rows are scaled alike."""
    if not m.size:
        return 0
    sizes = np.abs(m).max(axis=1)
    scaled = m[sizes > 0.0] / sizes[sizes > 0.0][:, None]
    if not scaled.size:
        return 0
    values = np.linalg.svd(scaled, compute_uv=False)
    return int(np.sum(values > DEPENDENT * values[0]))


def smallest(mechanism: Mechanism, order: Order, left: Sequence[int]) -> Newton:
    """The smallest set of the bodies that are left whose conditions determine it.

    Raises SceneError where no set is determined.
    """
    tried = 0
    for size in range(1, len(left) + 1):
        for bodies in combinations(left, size):
            tried += 1
            if tried > MOST_TRIED and size < len(left):
                break
            group = _group(mechanism, order, bodies)
            if group is not None:
                return group
    raise _refusal(mechanism, order, left)


def _group(mechanism: Mechanism, order: Order, bodies: Sequence[int]) -> Newton | None:
    reach = {*bodies, *order.full}
    constraints = tuple(c for c in order.constraints if c.bodies <= reach and c.bodies & set(bodies))
    shape = _held(mechanism, order, bodies)
    rows = Rows(mechanism.shape, Still(mechanism.shape), bases_of(mechanism, bodies), _board(mechanism))
    found = matrix(bodies, equations(mechanism, rows, constraints, shape))
    return Newton(tuple(bodies), constraints) if rank(found) == 3 * len(bodies) else None


def _held(mechanism: Mechanism, order: Order, bodies: Collection[int]) -> Moved:
    """The spots that are located, as written."""
    moved = Moved(mechanism.shape)
    for one in order.located:
        x, y = mechanism.shape.ref[one[1]]
        moved.located[one] = (float(x), float(y))
    return moved


def _refusal(mechanism: Mechanism, order: Order, left: Sequence[int]) -> SceneError:
    names = [mechanism.top.members[body][0] for body in left]
    plural = "link" if len(names) == 1 else "links"
    if order.nearest is not None:
        return touching(order.nearest)
    return SceneError(
        Status.MOBILITY,
        f"nothing drives {plural} {listed(names)}: the mechanism has more freedoms than numbers that move "
        "it. Vary another angle or length too, or turn another link.",
    )


__all__ = ["Places", "Shape", "bases_of", "equations", "jacobian", "matrix", "rank", "smallest"]
