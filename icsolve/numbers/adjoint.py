"""Derivatives of a recorded value by inputs, as values of the same record.

One pass backwards over the nodes (reverse differentiation; A. Griewank and A. Walther, Evaluating
Derivatives, 2nd ed. 2008, ch. 3) writes the derivative by every input as new nodes: what runs a record runs
its gradient.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from icsolve.numbers.arithmetic import Scalar
from icsolve.numbers.record import Op, Record, Traced, operands

DEGREE = math.pi / 180.0


def gradient(record: Record, target: Scalar, inputs: Iterable[int]) -> dict[int, Scalar]:
    """The derivatives of ``target`` by the nodes ``inputs``: numbers of the record, or 0.0.

    Reverse differentiation (A. Griewank and A. Walther, Evaluating Derivatives, 2nd ed. 2008, ch. 3): all
    derivatives of one value cost a few times that value.

    Parameters
    ----------
    record : the record in which ``target`` stands; the derivatives are written to it as new nodes
    target : number of the record, or a plain number
    inputs : indices of nodes

    Returns
    -------
    dict[int, Scalar]
        By input: the derivative [units of the target over those of the input; per degree by an angle], 0.0
        where the target does not depend on it. A root at zero has none: when it is run it divides by zero.
    """
    wanted = tuple(inputs)
    result: dict[int, Scalar] = dict.fromkeys(wanted, 0.0)
    if not (isinstance(target, Traced) and target.row):
        return result
    weights: dict[int, Scalar] = {target.index: 1.0}
    for k in reversed(behind(record, target.index)):
        weight = weights.pop(k, None)
        if weight is None:
            continue
        if k in result:
            result[k] = weight
            continue
        for n, part in _parts(record, k, weight):
            if record.nodes[n].row:
                weights[n] = weights[n] + part if n in weights else part
    return result


def behind(record: Record, target: int) -> list[int]:
    """The nodes that vary from row to row and lead to the node ``target``, itself among them, in order."""
    seen: set[int] = set()
    stack = [target]
    while stack:
        k = stack.pop()
        if k not in seen and record.nodes[k].row:
            seen.add(k)
            stack.extend(operands(record, k))
    return sorted(seen)


def _parts(record: Record, k: int, weight: Scalar) -> list[tuple[int, Scalar]]:
    """What the weight of a node gives to the nodes that it is made of."""
    node = record.nodes[k]
    a, b = node.a, node.b
    match node.op:
        case Op.ADD:
            return [(a, weight), (b, weight)]
        case Op.SUB:
            return [(a, weight), (b, -weight)]
        case Op.MUL:
            return [(a, weight * record.at(b)), (b, weight * record.at(a))]
        case Op.DIV:
            share = weight / record.at(b)
            return [(a, share), (b, -(share * record.at(k)))]
        case Op.NEG:
            return [(a, -weight)]
        case Op.SQRT:
            return [(a, weight * 0.5 / record.at(k))]
        case Op.COS:
            return [(a, -(weight * record.at(k + 1) * DEGREE))]
        case Op.SIN:
            return [(a, weight * record.at(b) * DEGREE)]
        case Op.ANGLE:
            x, y = record.at(a), record.at(b)
            share = weight / ((x * x + y * y) * DEGREE)
            return [(a, -(share * y)), (b, share * x)]
    return []
