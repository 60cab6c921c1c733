"""Bounds of the rounding errors of every row: the backward pass of `icsolve.tape`, on arrays.

The weight of a value (the derivative of the result by it) times its own rounding error, summed over all
values that lead to the result. Values that are the same in every row bring the bound of their own
errors; a group that Newton's method solved brings those of its equations.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from icsolve.tape import TURN_NOISE, UNIT
from icsolve.turn.constraints import RADIAN
from icsolve.turn.record import Op, Record, Traced
from icsolve.turn.replay import Array, Code, operands
from icsolve.turn.together import Together

SLICE = 1024
"""Rows of one pass: every value of them fits the second-level cache."""
ANGLE_NOISE = 4.0 * UNIT
ROUNDED = (Op.ADD, Op.SUB, Op.MUL, Op.DIV, Op.SQRT)


class Passed(NamedTuple):
    """Bounds of a result and its derivatives by the inputs, a row each."""

    bound: Array
    by: dict[int, Array]


class Backward:
    """Backward passes over a record from some of its nodes.

    ``exact`` are inputs that carry no rounding: signs, guesses, counts of turns.
    """

    def __init__(
        self, record: Record, targets: Sequence[int], groups: Sequence[Together], exact: Iterable[int]
    ) -> None:
        self.record, self.targets, self.exact = record, targets, frozenset(exact)
        self.groups = {min(group.solved): group for group in groups}
        self.member = {k: group for group in groups for k in group.solved}
        self.nodes = self._reached(targets)
        guesses = {g: s for group in groups for g, s in zip(group.guesses, group.solved, strict=True)}
        self.guesses = {g: s for g, s in guesses.items() if g in self.nodes}
        self.code = Code(record, sorted(self.nodes), keep=True)
        self._still: dict[int, float] = {}

    def _reached(self, targets: Iterable[int]) -> set[int]:
        """The nodes that vary and lead to the targets, through groups as well."""
        seen: set[int] = set()
        stack = [k for k in targets if self.record.nodes[k].row]
        while stack:
            k = stack.pop()
            if k in seen:
                continue
            seen.add(k)
            stack += [n for n in self._behind(k) if self.record.nodes[n].row]
        return seen

    def _behind(self, k: int) -> Iterable[int]:
        op = self.record.nodes[k].op
        if op in (Op.COS, Op.SIN):
            return (*operands(self.record, k), k + 1 if op == Op.COS else self.record.nodes[k].b)
        if k not in self.member:
            return operands(self.record, k)
        group = self.member[k]
        parts = (*group.residuals, *(v for row in group.derivatives for v in row))
        return [*(v.index for v in parts if isinstance(v, Traced)), *group.solved, *group.guesses]

    def run(self, given: Mapping[int, Array], rows: int) -> list[Passed]:
        """Bounds of the targets for the given inputs (of at most ``SLICE`` rows)."""
        values = {**given, **{g: given[s] for g, s in self.guesses.items()}}
        self.code.run(values, rows)
        with np.errstate(all="ignore"):
            return [self._passed(target, rows) for target in self.targets]

    def _passed(self, target: int, rows: int) -> Passed:
        if not self.record.nodes[target].row:
            return Passed(np.full(rows, self._noise(target)), {})
        weights: dict[int, Array] = {target: np.ones(rows)}
        bound, units, by = np.zeros(rows), np.zeros(rows), {}
        for k in sorted(self._reached((target,)), reverse=True):
            if k in self.groups:
                self._through(self.groups[k], weights, rows)
            w = weights.pop(k, None)
            if w is None:
                continue
            if self.record.nodes[k].op == Op.INPUT:
                by[k] = w
            self._own(k, w, rows, units, bound)
            self._spread(k, w, rows, weights, bound)
        return Passed(bound + UNIT * units, by)

    def _own(self, k: int, w: Array, rows: int, units: Array, bound: Array) -> None:
        """The error of a value's own rounding."""
        node = self.record.nodes[k]
        if node.op in ROUNDED and not self._shifted(k):
            units += np.abs(w * self.code.value(k, rows))
        elif node.op in (Op.COS, Op.SIN):
            bound += TURN_NOISE * np.abs(w * self.code.value(k, rows))
        elif node.op == Op.ANGLE:
            bound += ANGLE_NOISE * 180.0 * np.abs(w)
        elif node.op == Op.INPUT and k not in self.exact:
            units += np.abs(w * self.code.value(k, rows))

    def _shifted(self, k: int) -> bool:
        """A product with a power of two rounds nothing."""
        node = self.record.nodes[k]
        if node.op not in (Op.MUL, Op.DIV):
            return False
        factors = (node.a, node.b) if node.op == Op.MUL else (node.b,)
        return any(self._power(n) for n in factors)

    def _power(self, n: int) -> bool:
        node = self.record.nodes[n]
        return node.op == Op.CONST and abs(np.frexp(node.value)[0]) == 0.5

    def _spread(self, k: int, w: Array, rows: int, weights: dict[int, Array], bound: Array) -> None:
        """Pass a weight on to what a value was made of."""
        for n, part in self._parts(k, w, rows):
            if self.record.nodes[n].row:
                weights[n] = weights[n] + part if n in weights else part
            else:
                noise = self._noise(n)
                if noise:
                    bound += noise * np.abs(part)

    def _parts(self, k: int, w: Array, rows: int) -> Iterable[tuple[int, Array]]:
        node, value = self.record.nodes[k], self.code.value
        a, b = node.a, node.b
        match node.op:
            case Op.ADD:
                return ((a, w), (b, w))
            case Op.SUB:
                return ((a, w), (b, -w))
            case Op.MUL:
                return ((a, w * value(b, rows)), (b, w * value(a, rows)))
            case Op.DIV:
                part = w / value(b, rows)
                return ((a, part), (b, -part * value(k, rows)))
            case Op.NEG:
                return ((a, -w),)
            case Op.SQRT:
                return ((a, 0.5 * w / value(k, rows)),)
            case Op.COS:
                return ((a, -RADIAN * w * value(k + 1, rows)),)
            case Op.SIN:
                return ((a, RADIAN * w * value(b, rows)),)
            case Op.ANGLE:
                x, y = value(a, rows), value(b, rows)
                size = (x * x + y * y) * RADIAN
                return ((a, -w * y / size), (b, w * x / size))
        return ()

    def _through(self, group: Together, weights: dict[int, Array], rows: int) -> None:
        """Through a solved group: the weights of its equations (implicit differentiation)."""
        w = np.stack([weights.get(k, np.zeros(rows)) for k in group.solved], axis=1)
        w[:, 2::3] /= RADIAN
        flat = [v for row in group.derivatives for v in row]
        j = np.empty((rows, len(flat)))
        for n, v in enumerate(flat):
            j[:, n] = self.code.value(v.index, rows) if isinstance(v, Traced) else v
        j = j.reshape(rows, len(group.residuals), len(group.solved))
        back = adjoint(j, w)
        for n, residual in enumerate(group.residuals):
            if isinstance(residual, Traced):
                k, part = residual.index, -back[:, n]
                weights[k] = weights[k] + part if k in weights else part

    def _noise(self, k: int) -> float:
        """Bound of the error of a value that is the same in every row."""
        if k not in self._still:
            self._still[k] = still_bound(self.record, k)
        return self._still[k]


def adjoint(j: Array, w: Array) -> Array:
    """Solutions of the transposed systems; of the least squares where there are more equations."""
    turned = np.swapaxes(j, 1, 2)
    try:
        if j.shape[1] == j.shape[2]:
            return np.linalg.solve(turned, w[:, :, None])[:, :, 0]
        return (j @ np.linalg.solve(turned @ j, w[:, :, None]))[:, :, 0]
    except np.linalg.LinAlgError:
        return (np.swapaxes(np.linalg.pinv(j), 1, 2) @ w[:, :, None])[:, :, 0]


def still_bound(record: Record, target: int) -> float:
    """The backward pass over values that are the same in every row."""
    nodes, weights = record.nodes, {target: 1.0}
    bound = 0.0
    for k in range(target, -1, -1):
        w = weights.pop(k, 0.0)
        if not w:
            continue
        node = nodes[k]
        exact = node.op in (Op.CONST, Op.NEG, Op.NEAREST)
        noise = node.noise if node.op == Op.CONST else 0.0 if exact else UNIT * abs(node.value)
        if node.op in (Op.COS, Op.SIN, Op.ANGLE):
            noise = 180.0 * ANGLE_NOISE if node.op == Op.ANGLE else TURN_NOISE * abs(node.value)
        bound += abs(w) * noise
        for n, part in _still_parts(record, k, w):
            weights[n] = weights.get(n, 0.0) + part
    return bound


def _still_parts(record: Record, k: int, w: float) -> Iterable[tuple[int, float]]:
    node, nodes = record.nodes[k], record.nodes
    a, b = nodes[node.a].value, nodes[node.b].value
    match node.op:
        case Op.ADD:
            return ((node.a, w), (node.b, w))
        case Op.SUB:
            return ((node.a, w), (node.b, -w))
        case Op.MUL:
            return ((node.a, w * b), (node.b, w * a))
        case Op.DIV:
            return ((node.a, w / b), (node.b, -w * node.value / b)) if b else ()
        case Op.NEG:
            return ((node.a, -w),)
        case Op.SQRT:
            return ((node.a, 0.5 * w / node.value),) if node.value else ()
        case Op.COS:
            return ((node.a, -RADIAN * w * nodes[k + 1].value),)
        case Op.SIN:
            return ((node.a, RADIAN * w * b),)
        case Op.ANGLE:
            size = (a * a + b * b) * RADIAN
            return ((node.a, -w * b / size), (node.b, w * a / size)) if size else ()
    return ()
