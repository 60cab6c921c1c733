"""Errors of values that are the same in every row: the backward pass of a tape over a record."""

from __future__ import annotations

from collections.abc import Iterable

from icsolve.numbers.arithmetic import RADIAN, Scalar
from icsolve.numbers.record import Op, Record, Traced
from icsolve.numbers.tape import TURN_NOISE, UNIT

ANGLE_NOISE = 720.0 * UNIT
"""Error of an angle that an arc tangent gives, degrees."""


def noise_of(record: Record, value: Scalar) -> float:
    """Bound on the error of an expression that is the same in every row [its units]; 0 of a plain number."""
    return still_noise(record, value.index) if isinstance(value, Traced) else 0.0


def still_noise(record: Record, target: int) -> float:
    """Bound, to first order, on the error of the node ``target``, which is the same in every row [its units].

    The sum over all nodes behind it of the derivative by the node times the node's own rounding (the running
    error bound of N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2002, sec. 3.3, by reverse
    differentiation).
    """
    weights = {target: 1.0}
    bound = 0.0
    for k in range(target, -1, -1):
        w = weights.pop(k, 0.0)
        if w:
            bound += abs(w) * _own(record, k)
            for n, part in _parts(record, k, w):
                weights[n] = weights.get(n, 0.0) + part
    return bound


def _own(record: Record, k: int) -> float:
    """The error of a value's own rounding."""
    node = record.nodes[k]
    match node.op:
        case Op.CONST:
            return node.noise
        case Op.NEG | Op.NEAREST:
            return 0.0
        case Op.COS | Op.SIN:
            return TURN_NOISE * abs(node.value)
        case Op.ANGLE:
            return ANGLE_NOISE
    return UNIT * abs(node.value)


def _parts(record: Record, k: int, w: float) -> Iterable[tuple[int, float]]:
    """The weights of what a value was made of."""
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
