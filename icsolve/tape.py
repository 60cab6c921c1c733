"""Numbers that record their operations: one backward pass bounds the rounding error of a result and
gives its sensitivity to every number of the case.

Each operation leaves a rounding error of at most u times its value. The derivative of the result by
every recorded value, from one pass backwards over the tape (reverse differentiation; S. Linnainmaa,
BIT 16, 1976), weighs these errors, and those of the file's decimals, in the result. To first order
errors that cancel are seen to cancel, so the bound grows as the error does.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple, Union

from icsolve.arithmetic import turn_of
from icsolve.case import Number

UNIT = 2.0**-53
TURN_NOISE = 3.0 * UNIT
"""Relative error of a sine or cosine of an angle that was reduced exactly to within 45 degrees."""
CANCELLED = 1e-6
"""A divisor or radicand this much smaller than its terms is looked at before it is trusted."""

Operand = Union["Taped", float]


class Node(NamedTuple):
    """One recorded value: its operands with the derivatives by them, and its own rounding error."""

    a: int
    da: float
    b: int
    db: float
    noise: float


class Taped:
    """A float on a tape; ``size`` is the size of the terms that it was summed from."""

    __slots__ = ("index", "size", "tape", "value")

    def __init__(self, tape: Tape, index: int, value: float, size: float) -> None:
        self.tape, self.index, self.value, self.size = tape, index, value, size

    def _same(self, other: object) -> tuple[float, int, float]:
        if isinstance(other, Taped):
            return other.value, other.index, other.size
        constant = float(other)  # type: ignore[arg-type]
        return constant, 0, abs(constant)

    def __add__(self, other: Operand) -> Taped:
        v, k, size = self._same(other)
        value = self.value + v
        noise = 0.0 if v == 0.0 or self.value == 0.0 else UNIT * abs(value)
        return self.tape.put(Node(self.index, 1.0, k, 1.0, noise), value, max(self.size, size))

    __radd__ = __add__

    def __neg__(self) -> Taped:
        return self.tape.put(Node(self.index, -1.0, 0, 0.0, 0.0), -self.value, self.size)

    def __sub__(self, other: Operand) -> Taped:
        v, k, size = self._same(other)
        value = self.value - v
        noise = 0.0 if v == 0.0 or self.value == 0.0 else UNIT * abs(value)
        return self.tape.put(Node(self.index, 1.0, k, -1.0, noise), value, max(self.size, size))

    def __rsub__(self, other: Operand) -> Taped:
        return (-self) + other

    def __mul__(self, other: Operand) -> Taped:
        v, k, size = self._same(other)
        value = self.value * v
        noise = 0.0 if k == 0 and _is_power_of_two(v) else UNIT * abs(value)
        return self.tape.put(Node(self.index, v, k, self.value, noise), value, self.size * size)

    __rmul__ = __mul__

    def __truediv__(self, other: Operand) -> Taped:
        v, k, size = self._same(other)
        if k and abs(v) < CANCELLED * size:
            self.tape.suspects.append(k)
        value = self.value / v
        noise = 0.0 if k == 0 and _is_power_of_two(v) else UNIT * abs(value)
        return self.tape.put(Node(self.index, 1.0 / v, k, -value / v, noise), value, self.size / abs(v))

    def __rtruediv__(self, other: float) -> Taped:
        return self.tape.constant(other) / self

    def __abs__(self) -> float:
        return abs(self.value)

    def __float__(self) -> float:
        return self.value

    def __eq__(self, other: object) -> bool:
        return self.value == float(other)  # type: ignore[arg-type]

    def __lt__(self, other: Operand) -> bool:
        return self.value < float(other)

    def __gt__(self, other: Operand) -> bool:
        return self.value > float(other)

    def __le__(self, other: Operand) -> bool:
        return self.value <= float(other)

    def __ge__(self, other: Operand) -> bool:
        return self.value >= float(other)

    __hash__ = None  # type: ignore[assignment]


def _is_power_of_two(value: float) -> bool:
    return abs(math.frexp(value)[0]) == 0.5


class Pass(NamedTuple):
    """What one backward pass says of a result: its error bound, and its derivatives by path."""

    bound: float
    by_path: dict[str, float]


class Tape:
    """The record; an `icsolve.arithmetic.Arithmetic` whose numbers are `Taped`."""

    def __init__(self) -> None:
        self.nodes: list[Node] = [Node(0, 0.0, 0, 0.0, 0.0)]
        self.inputs: dict[str, Taped] = {}
        self.turns: dict[str, tuple[Taped, Taped]] = {}
        self.suspects: list[int] = []
        """indices of divisors and radicands that nearly vanish"""
        self.values: list[float] = [0.0]
        self.converted: dict[str, float] = {}
        """rounding of the numbers whose units were converted"""

    def put(self, node: Node, value: float, size: float) -> Taped:
        """Record a value."""
        self.nodes.append(node)
        self.values.append(value)
        return Taped(self, len(self.nodes) - 1, value, size)

    def constant(self, value: float) -> Taped:
        """An exact number."""
        return self.put(Node(0, 0.0, 0, 0.0, 0.0), value, abs(value))

    def given(self, number: Number) -> Taped:
        """A number of the case, with the rounding of its decimals; one node a path."""
        found = self.inputs.get(number.path)
        if found is None:
            node = Node(0, 0.0, 0, 0.0, decimal_noise(number))
            found = self.put(node, number.value, abs(number.value))
            self.inputs[number.path] = found
            if number.factor != 1.0:
                self.converted[number.path] = node.noise
        return found

    def turn(self, number: Number) -> tuple[Taped, Taped]:
        """Cosine and sine of an angle of the case (degrees)."""
        found = self.turns.get(number.path)
        if found is None:
            angle = self.given(number)
            c, s = turn_of(number.value)
            rate = math.pi / 180.0
            found = (self._function(angle, c, -s * rate), self._function(angle, s, c * rate))
            self.turns[number.path] = found
        return found

    def _function(self, angle: Taped, value: float, derivative: float) -> Taped:
        noise = 0.0 if value in (0.0, 1.0, -1.0) else TURN_NOISE * abs(value)
        return self.put(Node(angle.index, derivative, 0, 0.0, noise), value, abs(value))

    def sqrt(self, value: Operand) -> Taped:
        """Square root; of rounding noise below zero: zero, with no derivative."""
        if not isinstance(value, Taped):
            return self.constant(math.sqrt(max(value, 0.0)))
        if value.value <= CANCELLED * value.size:
            self.suspects.append(value.index)
        if value.value <= 0.0:
            return self.put(Node(0, 0.0, 0, 0.0, math.sqrt(UNIT * value.size)), 0.0, math.sqrt(value.size))
        root = math.sqrt(value.value)
        return self.put(Node(value.index, 0.5 / root, 0, 0.0, UNIT * root), root, math.sqrt(value.size))

    def vanishes(self, value: Operand, size: float) -> bool:
        """Zero where it lies within its own bound."""
        return abs(value) <= self.back(value).bound

    def back(self, result: Operand) -> Pass:
        """The backward pass from a result."""
        if not isinstance(result, Taped):
            return Pass(0.0, {})
        weights = self._weights(result.index)
        bound = sum(abs(w) * node.noise for w, node in zip(weights, self.nodes, strict=False) if w)
        by_path = {
            path: weights[leaf.index] for path, leaf in self.inputs.items() if leaf.index < len(weights)
        }
        return Pass(bound, by_path)

    def _weights(self, last: int) -> list[float]:
        """Derivative of the value at ``last`` by every value recorded before it."""
        weights = [0.0] * (last + 1)
        weights[last] = 1.0
        nodes = self.nodes
        for k in range(last, 0, -1):
            w = weights[k]
            if w:
                a, da, b, db, _ = nodes[k]
                weights[a] += w * da
                weights[b] += w * db
        weights[0] = 0.0
        return weights

    def doubts(self, fraction: float) -> Iterable[float]:
        """Bound over value of the divisors and radicands that nearly vanish, where above a fraction."""
        for k in dict.fromkeys(self.suspects):
            weights = self._weights(k)
            bound = sum(abs(w) * node.noise for w, node in zip(weights, self.nodes, strict=False) if w)
            if bound > fraction * abs(self.values[k]):
                yield bound / abs(self.values[k]) if self.values[k] else 0.0


def decimal_noise(number: Number) -> float:
    """Bound on the rounding of a written decimal to a double (and of its unit's factor)."""
    value = number.value
    if number.factor == 1.0 and value.is_integer() and abs(value) < 2.0**53:
        return 0.0
    return (UNIT if number.factor == 1.0 else 3.0 * UNIT) * abs(value)
