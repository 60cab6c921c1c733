"""The methods that are compared: each takes a drawn case and gives its unknown load."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from icsolve.bench import matrices
from icsolve.bench.closure import Cartesian, Homogeneous, closed
from icsolve.bench.rivals import Drawn
from icsolve.solve import solve


class Method(NamedTuple):
    """A method by its name in tables and pictures."""

    name: str
    run: Callable[[Drawn], float]


def _icsolve(scene: Drawn) -> float:
    return solve(scene.case, bound=False).answers["U"].value


def _bounded(scene: Drawn) -> float:
    return solve(scene.case).answers["U"].value


OWN = ("icsolve", "icsolve with bound")
"""The names of our own, the one with bounds last."""

METHODS: tuple[Method, ...] = (
    Method(OWN[0], _icsolve),
    Method(OWN[1], _bounded),
    Method("slope and intercept", lambda scene: closed(scene, Cartesian(), False)),
    Method("homogeneous, raw", lambda scene: closed(scene, Homogeneous(), False)),
    Method("homogeneous, normalised", lambda scene: closed(scene, Homogeneous(), True)),
    Method("SVD null space", lambda scene: matrices.by_svd(scene, False)),
    Method("LU, input fixed", lambda scene: matrices.by_lu(scene, False)),
    Method("free bodies, LU", lambda scene: matrices.by_free_bodies(scene, False)),
    Method("Newton and SVD", lambda scene: matrices.by_newton(scene, False)),
)
