"""Derivatives of a recorded value by what it was made of, from one pass backwards over the nodes.

Reverse differentiation (A. Griewank and A. Walther, Evaluating Derivatives, 2nd ed. 2008, ch. 3): the weight
of a node is the derivative of the result by it, and each operation hands its weight on to its operands. The
derivatives of the operations, and their roundings, are told here once, for weights of any kind: numbers of
the record itself (`gradient`), floats (`still_noise`), arrays on buffers (`icsolve.numbers.passing`).
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from icsolve.numbers import RADIAN, Scalar
from icsolve.numbers.record import Op, Record, Traced, live
from icsolve.numbers.tape import TURN_NOISE, UNIT
from icsolve.tuples import Protocol, TypeVar

ROUNDINGS = {Op.NEG: 0.0, Op.NEAREST: 0.0, Op.COS: TURN_NOISE, Op.SIN: TURN_NOISE, Op.ANGLE: 0.0}
"""Relative rounding error of an operation's own; of all others it is `UNIT`."""
ANGLE_NOISE = 720.0 * UNIT
"""Error of an angle that an arc tangent gives, degrees."""

W = TypeVar("W")


class Adjoints(Protocol[W]):
    """Adjoints of one kind, and the values of a record that they are multiplied by."""

    def wants(self, n: int) -> bool:
        """Whether a node needs a weight."""

    def negated(self, w: W) -> W:
        """The opposite weight."""

    def times(self, w: W, n: int, factor: float = 1.0) -> W:
        """A weight times the value of a node, times a factor."""

    def over(self, w: W, n: int, factor: float = 1.0) -> W:
        """A weight over the value of a node, times a factor."""

    def over_square(self, w: W, x: int, y: int) -> W:
        """A weight over the square of the length of a vector, by its components, in radians a degree."""


def shares(record: Record, k: int, w: W, weights: Adjoints[W]) -> list[tuple[int, W]]:
    """What the weight of node ``k`` adds to the weights of its operands, as pairs of node and weight."""
    node = record.nodes[k]
    a, b = node.a, node.b
    match node.op:
        case Op.ADD:
            return [(a, w), (b, w)]
        case Op.SUB:
            return [(a, w), (b, weights.negated(w))]
        case Op.MUL:
            return [(m, weights.times(w, n)) for m, n in ((a, b), (b, a)) if weights.wants(m)]
        case Op.DIV:
            share = weights.over(w, b)
            divisor = [(b, weights.times(share, k, -1.0))] if weights.wants(b) else []
            return [*divisor, (a, share)]
        case Op.NEG:
            return [(a, weights.negated(w))]
        case Op.SQRT:
            return [(a, weights.over(w, k, 0.5))]
        case Op.COS:
            return [(a, weights.times(w, k + 1, -RADIAN))]
        case Op.SIN:
            return [(a, weights.times(w, b, RADIAN))]
        case Op.ANGLE:
            share = weights.over_square(w, a, b)
            return [(a, weights.times(share, b, -1.0)), (b, weights.times(share, a))]
    return []


# --- as numbers of the record --------------------------------------------------------------------------


class RecordedAdjoints:
    """Adjoints that are numbers of the record: what runs a record runs its gradient."""

    def __init__(self, record: Record) -> None:
        self.record = record

    def wants(self, n: int) -> bool:
        """Whether it varies."""
        return self.record.nodes[n].row

    def negated(self, w: Scalar) -> Scalar:
        """-w"""
        return -w

    def times(self, w: Scalar, n: int, factor: float = 1.0) -> Scalar:
        """w v, times a factor; of radians a degree all digits are known"""
        if abs(factor) == RADIAN:
            return w * self.record.nodes[n] * math.copysign(1.0, factor) * self.record.radian
        return w * self.record.nodes[n] * factor

    def over(self, w: Scalar, n: int, factor: float = 1.0) -> Scalar:
        """w / v, times a factor"""
        return w * factor / self.record.nodes[n]

    def over_square(self, w: Scalar, x: int, y: int) -> Scalar:
        """w / (x^2 + y^2)"""
        u, v = self.record.nodes[x], self.record.nodes[y]
        return w / ((u * u + v * v) * self.record.radian)


def gradient(record: Record, target: Scalar, inputs: Iterable[int]) -> dict[int, Scalar]:
    """The derivatives of ``target`` by the nodes ``inputs``: numbers of the record, or 0.0.

    All derivatives of one value cost a few times that value.

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
    result: dict[int, Scalar] = dict.fromkeys(inputs, 0.0)
    if not (isinstance(target, Traced) and target.row):
        return result
    kind = RecordedAdjoints(record)
    weights: dict[int, Scalar] = {target.index: 1.0}
    for k in reversed(live(record.nodes, (target.index,))):
        weight = weights.pop(k, None)
        if weight is None:
            continue
        if k in result:
            result[k] = weight
            continue
        for n, part in shares(record, k, weight, kind):
            if record.nodes[n].row:
                weights[n] = weights[n] + part if n in weights else part
    return result


# --- errors of values that are the same in every row -----------------------------------------------------


class FloatAdjoints:
    """Adjoints as floats, in the position in which the record was made; by a zero nothing is divided."""

    def __init__(self, record: Record) -> None:
        self.nodes = record.nodes

    def wants(self, n: int) -> bool:
        """Always: a constant has an error too."""
        return True

    def negated(self, w: float) -> float:
        """-w"""
        return -w

    def times(self, w: float, n: int, factor: float = 1.0) -> float:
        """w v, times a factor"""
        return w * self.nodes[n].value * factor

    def over(self, w: float, n: int, factor: float = 1.0) -> float:
        """w / v, times a factor; 0 where v is"""
        value = self.nodes[n].value
        return w / value * factor if value else 0.0

    def over_square(self, w: float, x: int, y: int) -> float:
        """w / (x^2 + y^2); 0 where that is"""
        u, v = self.nodes[x].value, self.nodes[y].value
        size = (u * u + v * v) * RADIAN
        return w / size if size else 0.0


def noise_of(record: Record, value: Scalar) -> float:
    """Bound on the error of an expression that is the same in every row [its units]; 0 of a plain number."""
    return still_noise(record, value.index) if isinstance(value, Traced) else 0.0


def still_noise(record: Record, target: int) -> float:
    """Bound, to first order, on the error of the node ``target``, which is the same in every row [its units].

    The sum over all nodes behind it of the derivative by the node times the node's own rounding (the running
    error bound of N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2002, sec. 3.3).
    """
    kind = FloatAdjoints(record)
    weights = {target: 1.0}
    bound = 0.0
    for k in range(target, -1, -1):
        w = weights.pop(k, 0.0)
        if w:
            bound += abs(w) * _rounding(record, k)
            for n, part in shares(record, k, w, kind):
                weights[n] = weights.get(n, 0.0) + part
    return bound


def _rounding(record: Record, k: int) -> float:
    """The error of a value's own rounding [its units]."""
    node = record.nodes[k]
    if node.op == Op.CONST:
        return node.noise
    return ANGLE_NOISE if node.op == Op.ANGLE else ROUNDINGS.get(node.op, UNIT) * abs(node.value)


KNOWN = 0.25
"""What is four times its bound is not zero, however small it is beside what it is compared with."""


class BoundedRecord(Record):
    """A record that looks at the bound of what seems to be zero. Rates of long reductions, and by short
    cranks, are small and known; what rounding leaves of terms that cancel is small and unknown."""

    def vanishes(self, value: Scalar, size: float) -> bool:
        """Zero in every row, as its value in this one and the bound of that tell."""
        if not super().vanishes(value, size):
            return False
        noise = noise_of(self, value)
        if isinstance(value, Traced) and noise:
            if noise < KNOWN * abs(value):
                return False
            self.spent[value.index] = float(size)
        return True
