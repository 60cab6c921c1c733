"""Equilibrium in space written apart: all six components of every joint, less what its kind cannot carry.

Nothing of icsolve is used but the values of a case. The moments are all about the origin, the system is
dense, and the SVD says what it determines.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from icsolve import Case
from icsolve.case import Centroid, Number
from icsolve.case.space import (
    Along,
    FromTo,
    Hinge,
    Radial,
    SpatialForce,
    SpatialForceVector,
    SpatialTorque,
    SphericalJoint,
    Thrust,
    Vector,
)

Array = npt.NDArray[np.float64]


class Solution(NamedTuple):
    """For each joint its six components (force, couple about its point), and which are determined.

    ``loads`` are the unknown loads by name; NaN where open. ``rest`` is what is left of the equations, as a
    fraction of the loads.
    """

    joints: list[Array]
    determined: list[npt.NDArray[np.bool_]]
    loads: dict[str, float]
    rest: float


Read = Callable[[Number], Any]
"""What is taken of a number: its double, or more digits."""


def double(number: Number) -> float:
    """The nearest double."""
    return number.value


def place(case: Case, name: str, read: Read = double) -> Array:
    """A point's coordinates."""
    assert case.space is not None
    given = case.space.points[name]
    if isinstance(given, Centroid):
        return sum(place(case, other, read) for other in given.of) / len(given.of)
    return np.array([read(number) for number in given])


def along(case: Case, axis: object, read: Read = double) -> Array:
    """Unit vector of an axis."""
    if isinstance(axis, Along):
        vector = np.eye(3)["xyz".index(axis.word[-1])] * (-1.0 if axis.word.startswith("-") else 1.0)
    elif isinstance(axis, Vector):
        vector = np.array([read(number) for number in axis])
    else:
        assert isinstance(axis, FromTo)
        vector = place(case, axis.b, read) - place(case, axis.a, read)
    return vector / (vector @ vector) ** 0.5


def solve(case: Case) -> Solution:
    """All joints of a case without gears, and its unknown forces and torques along axes."""
    matrix, right, count, names = system(case)
    return solved(matrix, right, count, names)


def system(case: Case, read: Read = double) -> tuple[Array, Array, int, list[str]]:
    """The equations of all links, and what joints cannot carry: matrix, right side, joints, unknowns."""
    assert case.space is not None
    links = [link for link in case.links if link != case.ground]
    row_of = {link: 6 * n for n, link in enumerate(links)}
    joints, loads = case.space.joints, case.space.loads
    unknown = [
        load for load in loads if isinstance(load, SpatialForce | SpatialTorque) and load.value is None
    ]
    columns = 6 * len(joints) + len(unknown)
    kind = np.array([read(case.gravity)]).dtype
    rows, right = [np.zeros((6 * len(links), columns), kind)], [np.zeros(6 * len(links), kind)]
    for n, joint in enumerate(joints):
        spread = wrench_matrix(place(case, joint.at, read))
        for link, sign in ((joint.links[1], 1.0), (joint.links[0], -1.0)):
            if link in row_of:
                rows[0][row_of[link] : row_of[link] + 6, 6 * n : 6 * n + 6] += sign * spread
        for limit in limits(case, joint, read):
            row = np.zeros((1, columns), kind)
            row[0, 6 * n : 6 * n + 6] = limit
            rows.append(row)
            right.append(np.zeros(1))
    for load in loads:
        wrench = load_wrench(case, load, read)
        for link, sign in ((load.link, 1.0), (getattr(load, "against", None) or case.ground, -1.0)):
            if link not in row_of:
                continue
            if load in unknown:
                column = 6 * len(joints) + unknown.index(load)  # type: ignore[arg-type]
                rows[0][row_of[link] : row_of[link] + 6, column] += sign * wrench
            else:
                right[0][row_of[link] : row_of[link] + 6] -= sign * wrench
    return np.vstack(rows), np.concatenate(right), len(joints), [load.name for load in unknown]


def solved(matrix: Array, right: Array, joints: int, names: list[str]) -> Solution:
    """Least squares, with what the null space leaves open."""
    u, sizes, vt = np.linalg.svd(matrix)
    rank = int(np.sum(sizes > 1e-10 * sizes[0]))
    x = vt[:rank].T @ ((u[:, :rank].T @ right) / sizes[:rank])
    rest = float(np.max(np.abs(matrix @ x - right)) / (np.max(np.abs(right)) or 1.0))
    is_open = np.any(np.abs(vt[rank:]) > 1e-9, axis=0)
    loads = {
        name: float("nan") if is_open[6 * joints + n] else float(x[6 * joints + n])
        for n, name in enumerate(names)
    }
    parts = [slice(6 * n, 6 * n + 6) for n in range(joints)]
    return Solution([x[part] for part in parts], [~is_open[part] for part in parts], loads, rest)


def wrench_matrix(p: Array) -> Array:
    """A force and couple at p to force and moment about the origin."""
    x, y, z = p
    spread = np.eye(6).astype(p.dtype)
    spread[3:, :3] = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return spread


def limits(case: Case, joint: object, read: Read = double) -> list[Array]:
    """What a joint cannot carry, as rows whose product with its components is zero."""
    couples = [np.eye(6)[k] for k in (3, 4, 5)]
    if isinstance(joint, SphericalJoint | Thrust):
        return couples
    if isinstance(joint, Radial):
        return [*couples, np.concatenate([along(case, joint.axis, read), np.zeros(3)])]
    if isinstance(joint, Hinge):
        return [np.concatenate([np.zeros(3), along(case, joint.axis, read)])]
    return []


def load_wrench(case: Case, load: object, read: Read = double) -> Array:
    """Force and moment about the origin; of an unknown load for a number of 1."""
    if isinstance(load, SpatialTorque):
        size = 1.0 if load.value is None else read(load.value)
        return np.concatenate([np.zeros(3), size * along(case, load.heading, read)])
    if isinstance(load, SpatialForceVector):
        force = np.array([read(part) for part in load.parts])
    else:
        assert isinstance(load, SpatialForce)
        size = 1.0 if load.value is None else read(load.value)
        force = size * along(case, load.heading, read)
    return np.concatenate([force, np.cross(place(case, load.at, read), force)])
