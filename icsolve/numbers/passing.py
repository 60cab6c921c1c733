"""One backward pass as straight-line steps: the weights of all values from the last to the first."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

from icsolve.numbers import RADIAN
from icsolve.numbers.adjoint import ANGLE_NOISE, ROUNDINGS, shares
from icsolve.numbers.record import Implicit, Op, Record, Traced
from icsolve.numbers.replay import Array, Code, Step
from icsolve.numbers.tape import UNIT
from icsolve.tuples import NamedTuple, Protocol

FACTORED = (Op.MUL, Op.DIV, Op.SQRT, Op.NEG)
"""Operations whose operands' relative errors are those of the result."""

Weight = tuple[Array, float]
"""An array and a sign."""


class Source(Protocol):
    """What a pass goes through: a record, its values, what is exact, and groups that were solved."""

    record: Record
    code: Code
    exact: frozenset[int]
    groups: dict[int, Implicit]
    member: dict[int, Implicit]

    def reached(self, targets: Iterable[int]) -> set[int]:
        """The nodes that lead to the targets."""

    def noise(self, k: int) -> float:
        """Bound of the error of a value that is the same in every row."""

    def scratch(self, room: int) -> Scratch:
        """Buffers of so many rows."""


class Scratch(NamedTuple):
    """Buffers that the passes of one record share: one pass at a time runs on them.

    Attributes
    ----------
    free : arrays (room,) for weights
    products : (terms, room), the terms of a bound
    """

    free: list[Array]
    products: Array


class Passed(NamedTuple):
    """A target's error, a row each.

    Attributes
    ----------
    bound : (rows,), of the absolute error [units of the target]
    by : by input node, the derivative of the target, (rows,) [per unit of the input]
    """

    bound: Array
    by: dict[int, Array]


class Pass:
    """One target's pass as straight-line steps on buffers of so many rows."""

    def __init__(self, backward: Source, target: int, room: int) -> None:
        self.backward, self.record, self.room = backward, backward.record, room
        self.buffers = backward.code.bound(room)[1]
        self.steps: list[Step] = []
        self.weights: dict[int, Weight] = {}
        self.by: dict[int, Weight] = {}
        self.factors: list[float] = []
        self.holders: dict[int, int] = {}
        nodes = sorted(backward.reached((target,)), reverse=True)
        self.merged = _merged(self.record, nodes)
        self.free, self.products = backward.scratch(room)
        self.weights[target] = self._held((np.ones(room), 1.0), forever=True)
        for k in nodes:
            self._node(k)
        self.products = self.products[: len(self.factors)]
        self.row = np.array(self.factors)

    def run(self, rows: int) -> Passed:
        """The bound of every row, and the weights of the inputs."""
        for function, arguments in self.steps:
            function(*arguments)
        np.abs(self.products, self.products)
        by = {k: sign * w[:rows] for k, (w, sign) in self.by.items()}
        return Passed((self.row @ self.products)[:rows], by)

    # --- buffers ----------------------------------------------------------------------------------

    def _fresh(self) -> Array:
        return self.free.pop() if self.free else np.empty(self.room)

    def _held(self, weight: Weight, forever: bool = False) -> Weight:
        """A weight that one more node has."""
        key = id(weight[0])
        self.holders[key] = self.holders.get(key, 0) + 1 + (1 << 30) * forever
        return weight

    def _released(self, weight: Weight) -> None:
        """A weight that one node less has: its buffer may be free."""
        key = id(weight[0])
        self.holders[key] -= 1
        if not self.holders[key]:
            self.free.append(weight[0])

    def _do(self, function: Callable[..., Any], *arguments: Any) -> None:
        self.steps.append((function, arguments))

    # --- the nodes, last to first -----------------------------------------------------------------

    def _node(self, k: int) -> None:
        if k in self.backward.member:
            if k in self.backward.groups:
                self._group(self.backward.groups[k])
            return
        weight = self.weights.pop(k, None)
        if weight is None:
            return
        node = self.record.nodes[k]
        if node.op == Op.INPUT:
            self.by[k] = self._held(weight, forever=True)
        if k not in self.merged:
            self._error(self._share(k), weight, self._value(k))
        if node.op == Op.ANGLE:
            self._error(ANGLE_NOISE, weight, None)
        for n, part in shares(self.record, k, weight, self):
            if self.record.nodes[n].row:
                self._add(n, part)
            elif node.op in (Op.ADD, Op.SUB) or not self.record.nodes[n].value:
                self._error(self.backward.noise(n), part, None)
        self._released(weight)

    def _error(self, factor: float, weight: Weight, value: Array | None) -> None:
        """A term of the bound: a factor times the weight (times a value)."""
        if not factor:
            return
        out = self.products[len(self.factors)]
        self.factors.append(factor)
        if value is None:
            self._do(np.copyto, out, weight[0])
        else:
            self._do(np.multiply, weight[0], value, out)

    def _share(self, k: int) -> float:
        """Relative error of a value, with that of the factors that are counted with it."""
        node = self.record.nodes[k]
        if not node.row:
            return self.backward.noise(k) / abs(node.value) if node.value else 0.0
        if node.op == Op.INPUT:
            return 0.0 if k in self.backward.exact else UNIT
        own = 0.0 if _shifted(self.record, k) else ROUNDINGS.get(node.op, UNIT)
        if node.op in FACTORED:
            part = 0.5 if node.op == Op.SQRT else 1.0
            own += part * sum(self._share(n) for n in self.record.nodes[k].of if self._counted(n))
        return own

    def _counted(self, n: int) -> bool:
        return n in self.merged or not self.record.nodes[n].row

    def _add(self, k: int, weight: Weight) -> None:
        """One more part of a node's weight."""
        known = self.weights.get(k)
        if known is None:
            self.weights[k] = self._held(weight)
            return
        out = self._fresh()
        self._do(np.add if known[1] == weight[1] else np.subtract, known[0], weight[0], out)
        self._released(known)
        if not self.holders.get(id(weight[0])):
            self.free.append(weight[0])
        self.weights[k] = self._held((out, known[1]))

    # --- weights as arrays on buffers (`adjoint.Adjoints`) -------------------------------------------

    def _value(self, k: int) -> Array:
        return self.backward.code.held(k, self.buffers)

    def wants(self, n: int) -> bool:
        """Whether a node needs a weight: it varies, or is a zero with an error."""
        node = self.record.nodes[n]
        return node.row or (not node.value and bool(self.backward.noise(n)))

    def negated(self, w: Weight) -> Weight:
        """The same array with the other sign."""
        return (w[0], -w[1])

    def times(self, w: Weight, n: int, factor: float = 1.0) -> Weight:
        """In a buffer of its own."""
        return self._scaled(np.multiply, w, self._value(n), factor)

    def over(self, w: Weight, n: int, factor: float = 1.0) -> Weight:
        """In a buffer of its own."""
        return self._scaled(np.divide, w, self._value(n), factor)

    def over_square(self, w: Weight, x: int, y: int) -> Weight:
        """In a buffer of its own."""
        size, square = np.empty(self.room), np.empty(self.room)
        for n, out in ((x, size), (y, square)):
            self._do(np.multiply, self._value(n), self._value(n), out)
        self._do(np.add, size, square, size)
        self._do(np.multiply, size, RADIAN, size)
        return self._scaled(np.divide, w, size, 1.0)

    def _scaled(self, function: Callable[..., Any], w: Weight, value: Array, factor: float) -> Weight:
        out = self._fresh()
        self._do(function, w[0], value, out)
        if abs(factor) != 1.0:
            self._do(np.multiply, out, abs(factor), out)
        return (out, w[1] * math.copysign(1.0, factor))

    def _group(self, group: Implicit) -> None:
        """Through a solved group: the weights of its equations (implicit differentiation)."""
        mine = [self.weights.get(k) for k in group.solved]
        if not any(mine):
            return
        flat = [v for row in group.derivatives for v in row]
        values = [self._value(v.index) if isinstance(v, Traced) else v for v in flat]
        outs = np.empty((len(group.residuals), self.room))
        self._do(_implicit, mine, values, (self.room, len(group.residuals), len(group.solved)), outs)
        for n, residual in enumerate(group.residuals):
            if isinstance(residual, Traced):
                self._add(residual.index, self._held((outs[n], -1.0), forever=True))


def _implicit(
    mine: list[Weight | None], values: list[Array | float], shape: tuple[int, int, int], outs: Array
) -> None:
    """Weights of the equations of a group from those of its unknowns (degrees in every third)."""
    w = np.zeros((shape[0], shape[2]))
    for n, weight in enumerate(mine):
        if weight is not None:
            w[:, n] = weight[0] * weight[1]
    w[:, 2::3] /= RADIAN
    j = np.empty((shape[0], len(values)))
    for n, value in enumerate(values):
        j[:, n] = value
    outs[:] = solved_transposed(j.reshape(shape), w).T


def _shifted(record: Record, k: int) -> bool:
    """A product with a power of two rounds nothing."""
    node = record.nodes[k]
    if node.op not in (Op.MUL, Op.DIV):
        return False
    factors = (node.a, node.b) if node.op == Op.MUL else (node.b,)
    constants = (record.nodes[n] for n in factors)
    return any(n.op == Op.CONST and abs(np.frexp(n.value)[0]) == 0.5 for n in constants)


def _merged(record: Record, nodes: Sequence[int]) -> set[int]:
    """Nodes that are a factor of one product and nothing else: their relative error is counted with its."""
    count: dict[int, int] = {}
    factor: set[int] = set()
    for k in nodes:
        for n in record.nodes[k].of:
            count[n] = count.get(n, 0) + 1
            if record.nodes[k].op in FACTORED:
                factor.add(n)
    return {n for n in factor if count[n] == 1 and record.nodes[n].op not in (Op.ANGLE, Op.NEAREST)}


def solved_transposed(j: Array, w: Array) -> Array:
    """Solutions x of the transposed systems ``j^T x = w``, one a row.

    Parameters
    ----------
    j : (rows, equations, unknowns), at least as many equations as unknowns
    w : (rows, unknowns)

    Returns
    -------
    Array
        (rows, equations): where there are more equations, ``j (j^T j)^-1 w``, the adjoint of least squares.
        Where any of them is singular all are solved with the pseudoinverse.
    """
    turned = np.swapaxes(j, 1, 2)
    try:
        if j.shape[1] == j.shape[2]:
            found = np.linalg.solve(turned, w[:, :, None])
        else:
            found = j @ np.linalg.solve(turned @ j, w[:, :, None])
    except np.linalg.LinAlgError:
        found = np.swapaxes(np.linalg.pinv(np.nan_to_num(j)), 1, 2) @ w[:, :, None]
    return np.asarray(found[:, :, 0], dtype=np.float64)
