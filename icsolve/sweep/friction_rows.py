"""Friction in all rows at once: the equations of the rubs on the record, their senses as masks.

Every force that presses where links rub is affine in the frictions, with coefficients that the record gives
row by row (`statics.friction.equations`). Where the sizes of these forces are the one fixed point of a
contraction, iteration finds them in all rows together; every other row is a scene of its own.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np

from icsolve.kinematics.motion import Motions
from icsolve.kinematics.speeds import fastest
from icsolve.numbers import Scalar
from icsolve.numbers.record import Traced, varies
from icsolve.numbers.replay import Array, Mask
from icsolve.statics.equilibrium import Statics, equilibrium
from icsolve.statics.friction import rates_of, rubs_of
from icsolve.statics.friction.equations import forces_of
from icsolve.statics.power import Balance
from icsolve.statics.reaction_basis import Position, meshes, ties_of
from icsolve.sweep.recorded_scene import RecordedScene, sign_of_speed
from icsolve.tuples import NamedTuple

SENSE = 1e-7
"""A rubbing rate below this fraction of what it is where the record was made leaves its sense open."""
CONTRACTS = 0.98
"""Where y -> |v(y)| shrinks all differences to this, its fixed point is the only one."""
SHAPED = 12
"""Steps by which the norm is found in which it shrinks."""
ITERATIONS, STEPS = 24, 12
"""Plain iterations of all rows; Newton's steps of those that are still on their way."""
SETTLED = 2.0**-49
"""A change of this fraction of the largest force is none."""
CANCELLED = 1e-9
"""A load below this fraction of its terms is what rounding left of them: the row is a scene, which has its
digits and its zero."""

Take = Callable[[Scalar], Array | float]
"""The rows' values of an expression."""
Form = tuple[Scalar, ...]
"""An affine form on the record: the constant, then the coefficients of the sizes of the forces."""


class FrictionRows(NamedTuple):
    """The friction of a sweep, as expressions on its record. k rubs press with the sizes y, (k,), of their
    forces.

    Attributes
    ----------
    forces : of each rub the components of the force that presses there, each an affine form in y, (1 + k,),
        for senses against which friction is positive [scaled force]
    load : the unknown load, an affine form too [case units]
    rates : (k,), rubbing rates of the second links [frame length/s, of pins rad/s], whose signs are the
        senses
    drive : rate of the link whose motion is given, so that it turns as asked where positive; None: nothing is
        given, and the load holds over a range
    ratios : by load that takes the unknown's number, how many times
    """

    forces: tuple[tuple[Form, ...], ...]
    load: Form
    rates: tuple[Scalar, ...]
    drive: Scalar | None
    ratios: dict[str, Scalar]

    @property
    def nodes(self) -> list[int]:
        """The nodes that vary from row to row."""
        every = [
            *self.load,
            *self.rates,
            *self.ratios.values(),
            *(a for f in self.forces for v in f for a in v),
        ]
        every += [] if self.drive is None else [self.drive]
        return sorted({v.index for v in every if isinstance(v, Traced) and v.row})

    def run(self, values: dict[int, Array], rows: int) -> Balanced:
        """The unknown loads of all rows.

        Parameters
        ----------
        values : by node of ``nodes``, (rows,)
        rows : how many

        Returns
        -------
        Balanced
            Rows in which a sense is open, the forces do not contract (Collatz and Wielandt) or do not settle
            are not ``sure``; what stands there means nothing.
        """

        def take(v: Scalar) -> Array | float:
            return values[v.index] if isinstance(v, Traced) and v.row else float(v)

        sure = np.ones(rows, dtype=bool)
        for rate in (*self.rates, *(() if self.drive is None else (self.drive,))):
            sure &= np.abs(take(rate)) > SENSE * abs(rate) if varies(rate) else True
        forces = [[[take(a) for a in form] for form in three] for three in self.forces]
        sure &= _contracts(forces, rows)
        senses = [np.sign(take(rate)) for rate in self.rates]
        if self.drive is not None:
            found, settled = self._moving(take, forces, [s * np.sign(take(self.drive)) for s in senses], rows)
            return Balanced({n: take(r) * found for n, r in self.ratios.items()}, {}, sure & settled)
        ends = [self._moving(take, forces, [side * s for s in senses], rows) for side in (1.0, -1.0)]
        both = np.sort(np.stack([value for value, _ in ends], axis=1), axis=1)
        # without a width nothing may rub, and the scene says what it is
        wide = both[:, 1] - both[:, 0] > SENSE * np.abs(both).max(axis=1)
        sure &= ends[0][1] & ends[1][1] & wide
        holds = {n: np.sort(np.asarray(take(r))[..., None] * both, axis=1) for n, r in self.ratios.items()}
        return Balanced({}, holds, sure)

    def _moving(
        self, take: Take, forces: list[list[list[Array | float]]], senses: list[Array], rows: int
    ) -> tuple[Array, Mask]:
        """The unknown load at full friction of these senses, and in which rows it settled."""
        signed = [
            [
                [form[0], *(0.0 if _none(a) else -s * a for s, a in zip(senses, form[1:], strict=True))]
                for form in three
            ]
            for three in forces
        ]
        sizes, settled = _fixed_point(signed, rows)
        load: Array = np.broadcast_to(np.asarray(take(self.load[0])), rows).copy()
        largest = np.abs(load)
        for s, a, y in zip(senses, self.load[1:], sizes, strict=True):
            part = s * take(a) * y
            load -= part
            largest = np.maximum(largest, np.abs(part))
        return load, settled & np.isfinite(load) & ~(np.abs(load) < CANCELLED * largest)


class Balanced(NamedTuple):
    """The unknown loads of rows with friction; one of ``answers`` and ``holds`` is empty.

    Attributes
    ----------
    answers : by load, (rows,) [case units], in the given motion
    holds : by load, the least and the most that hold, (rows, 2) [case units], where no motion is given
    sure : (rows,)
    """

    answers: dict[str, Array]
    holds: dict[str, Array]
    sure: Mask


# --- on the record --------------------------------------------------------------------------------


def rubbing(scene: RecordedScene, motions: Motions, balance: Balance) -> FrictionRows | None:
    """The friction of a scene on the record; None where each row has to be a scene of its own."""
    case = scene.case
    turned = case.motion[0] if case.motion else None
    other = len(case.motion) > 1 or (turned is not None and turned.point is not None)
    if case.ropes or case.screws or other or motions.mobility != 1 or motions.slack or motions.redundant:
        return None
    if turned is None and any(joint.only_pushes for joint in case.joints):  # where one parts a range ends
        return None
    position = Position(*scene.place, motions.twists)
    ties = ties_of(position)
    if meshes(ties):
        return None
    rubs = rubs_of(position, ties)
    statics = equilibrium(position, ties, balance, rubs)
    try:
        pressing = forces_of(statics)
    except LookupError:
        return None
    if len(statics.general.left) != 1 or len(statics.roots) != 1 or not pressing:
        return None
    rates = tuple(rates_of(position, ties, rubs, 0))
    drive = None
    if turned is not None:
        if turned.speed is not None and not turned.speed.value:
            return None
        rate = motions.twists[turned.link][0][2]
        if turned.speed is not None:
            rate = rate * sign_of_speed(scene.record, turned.speed)
        drive = -rate if turned.turns == "cw" else rate
    largest = fastest(motions.twists)
    turning = () if drive is None else (drive,)
    if any(scene.record.vanishes(r, largest) and varies(r) for r in (*rates, *turning)):
        return None
    load, forces = _reduced(statics, pressing)
    ratios = {w.load.name: w.ratio for w in balance.wrenches if w.root in statics.roots}
    return FrictionRows(forces, load, rates, drive, ratios)


def _reduced(
    statics: Statics, pressing: tuple[tuple[dict[int, Scalar], ...], ...]
) -> tuple[Form, tuple[tuple[Form, ...], ...]]:
    """The unknown load (case units) and the forces that press by the sizes of these forces."""
    (left,) = statics.general.left
    root, columns = statics.root(0), [statics.known, *(statics.rub(k) for k in range(len(statics.rubs)))]
    limits: list[Scalar] = [1.0, *(rub.limit for rub in statics.rubs)]
    own = [(0.0 - left.get(c, 0.0)) / left[root] for c in columns]
    load = tuple(a * limit / statics.scale for a, limit in zip(own, limits, strict=True))

    def form(row: dict[int, Scalar]) -> Form:
        whole = (row.get(c, 0.0) + row.get(root, 0.0) * a for c, a in zip(columns, own, strict=True))
        return tuple(a * limit for a, limit in zip(whole, limits, strict=True))

    return load, tuple(tuple(form(row) for row in three) for three in pressing)


# --- in all rows ----------------------------------------------------------------------------------


def _none(a: Array | float) -> bool:
    return isinstance(a, float) and a == 0.0


def _sum(terms: Iterator[Array | float]) -> Array | float:
    total: Array | float = 0.0
    for term in terms:
        total = term if _none(total) else total + term
    return total


def _length(parts: list[Array | float]) -> Array:
    """Length of a vector; of one component its size."""
    if len(parts) == 1:
        return np.abs(parts[0])
    return np.sqrt(_sum(p * p for p in parts))


def _contracts(forces: list[list[list[Array | float]]], rows: int) -> Mask:
    """Rows in which the map of the sizes contracts: for some z > 0 the matrix L of the lengths of the
    derivatives makes L z < z (Collatz and Wielandt), so that its spectral radius is below 1."""
    count = len(forces)
    lengths = [
        [
            _length([form[j + 1] for form in three]) if not all(_none(form[j + 1]) for form in three) else 0.0
            for j in range(count)
        ]
        for three in forces
    ]
    z: list[Array | float] = [np.ones(rows)] * count
    for _ in range(SHAPED):
        grown = [_sum(a * b for a, b in zip(row, z, strict=True) if not _none(a)) for row in lengths]
        shrinks = np.all(
            [np.broadcast_to(g <= CONTRACTS * b, rows) for g, b in zip(grown, z, strict=True)], axis=0
        )
        if shrinks.all():
            break
        z = [1.0 + g for g in grown]
    return np.broadcast_to(shrinks, rows)


def _fixed_point(forms: list[list[list[Array | float]]], rows: int) -> tuple[list[Array], Mask]:
    """Sizes y = |v(y)| in every row, and which rows have settled."""
    y: list[Array] = [np.broadcast_to(_length([form[0] for form in three]), rows) for three in forms]
    for _ in range(ITERATIONS):
        new = [np.broadcast_to(size, rows) for size in _sizes(forms, y)]
        moving = _moved(y, new)
        y = new
        if not moving.any():
            return y, ~moving
    y = [np.array(part) for part in y]
    late = np.flatnonzero(moving)
    some = [
        [[a if isinstance(a, float) or not a.ndim else a[late] for a in f] for f in three] for three in forms
    ]
    near = [part[late] for part in y]
    for _ in range(STEPS):
        new = _newton(some, near)
        far = _moved(near, new)
        near = new
        if not far.any():
            break
    for part, own in zip(y, near, strict=True):
        part[late] = own
    moving[late] = far | (np.min(near, axis=0) < 0.0)
    return y, ~moving


def _sizes(forms: list[list[list[Array | float]]], y: list[Array]) -> list[Array]:
    return [_length([_value(form, y) for form in three]) for three in forms]


def _value(form: list[Array | float], y: list[Array]) -> Array | float:
    return _sum(iter([form[0], *(a * x for a, x in zip(form[1:], y, strict=True) if not _none(a))]))


def _moved(old: list[Array], new: list[Array]) -> Mask:
    """Rows in which a size has changed."""
    largest = np.maximum.reduce(new)
    change = np.maximum.reduce([np.abs(b - a) for a, b in zip(old, new, strict=True)])
    return np.asarray(~(change <= SETTLED * largest))


def _newton(forms: list[list[list[Array | float]]], y: list[Array]) -> list[Array]:
    """One step of Newton's method on y - |v(y)| in every row."""
    count, rows = len(forms), len(y[0])
    matrix, right = np.zeros((rows, count, count)), np.empty((rows, count))
    for k, three in enumerate(forms):
        parts = [_value(form, y) for form in three]
        size = _length(parts)
        right[:, k] = y[k] - size
        matrix[:, k, k] = 1.0
        for j in range(count):
            slope = _sum(
                p * form[j + 1] for p, form in zip(parts, three, strict=True) if not _none(form[j + 1])
            )
            matrix[:, k, j] -= slope / np.where(size > 0.0, size, 1.0)
    try:
        step = np.linalg.solve(matrix, right[..., None])[..., 0]
    except np.linalg.LinAlgError:
        step = np.full((rows, count), math.nan)
    return [part - step[:, k] for k, part in enumerate(y)]
