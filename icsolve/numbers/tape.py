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
from decimal import Decimal
from typing import Union

from icsolve.numbers import Scalar, turn_of
from icsolve.numbers.units import ExactRatio, Number, nearest
from icsolve.tuples import NamedTuple

UNIT = 2.0**-53
TURN_NOISE = 3.0 * UNIT
"""Relative error of a sine or cosine of an angle that was reduced exactly to within 45 degrees."""
CANCELLED = 1e-6
"""A divisor or radicand this much smaller than its terms is looked at before it is trusted."""

SPENT = 16.0 * UNIT
"""A derivative below this fraction of its terms is their rounding."""

SMALL = 1e-3
"""A first-order bound is trusted below this fraction of its value."""

LARGE = 1e-3
"""A sum above this fraction of its terms is not zero by rounding alone."""

LONG = 500
"""On a tape of more values than this those that one was made from are sought first: they are few where a
mechanism is long."""

Operand = Union["Taped", float]


Node = tuple[int, float, int, float, float]
"""One recorded value: first operand and the derivative by it, second operand and the derivative by
it, own rounding error. Operand 0 is none."""
NONE = (0, 0.0, 0, 0.0)
"""No operands."""


class Taped:
    """A float on a tape; ``size`` is the size of the terms that it was summed from.

    The operators are written out, and what does nothing (+ 0, * 1) is not recorded: they run a hundred
    times a scene.
    """

    __slots__ = ("index", "size", "tape", "value")

    def __init__(self, tape: Tape, node: Node, value: float, size: float) -> None:
        nodes = tape.nodes
        self.tape, self.index, self.value, self.size = tape, len(nodes), value, size
        nodes.append(node)

    def __add__(self, other: Operand) -> Taped:
        x, size = self.value, self.size
        if type(other) is Taped:
            y, k = other.value, other.index
            size = size if size > other.size else other.size
        else:
            y, k = float(other), 0
            if y == 0.0:
                return self
            size = max(size, abs(y))
        value = x + y
        noise = UNIT * abs(value)
        return Taped(self.tape, (self.index, 1.0, k, 1.0, noise if x and y else 0.0), value, size)

    __radd__ = __add__

    def __neg__(self) -> Taped:
        return Taped(self.tape, (self.index, -1.0, 0, 0.0, 0.0), -self.value, self.size)

    def __sub__(self, other: Operand) -> Taped:
        x, size = self.value, self.size
        if type(other) is Taped:
            y, k = other.value, other.index
            size = size if size > other.size else other.size
        else:
            y, k = float(other), 0
            if y == 0.0:
                return self
            size = max(size, abs(y))
        value = x - y
        noise = UNIT * abs(value)
        return Taped(self.tape, (self.index, 1.0, k, -1.0, noise if x and y else 0.0), value, size)

    def __rsub__(self, other: float) -> Taped:
        return (-self) + other

    def __mul__(self, other: Operand) -> Scalar:
        x = self.value
        if type(other) is Taped:
            y, k, size = other.value, other.index, other.size
            value = x * y
            noise = UNIT * abs(value)
            return Taped(self.tape, (self.index, y, k, x, noise), value, self.size * size)
        y = float(other)
        if y == 1.0:
            return self
        if y == 0.0:
            return 0.0
        value = x * y
        noise = 0.0 if _is_power_of_two(y) else UNIT * abs(value)
        return Taped(self.tape, (self.index, y, 0, 0.0, noise), value, self.size * abs(y))

    __rmul__ = __mul__

    def __truediv__(self, other: Operand) -> Taped:
        x = self.value
        if type(other) is Taped:
            y, k = other.value, other.index
            if abs(y) < CANCELLED * other.size:
                self.tape.suspects.append((k, y))
            value = x / y
            node = (self.index, 1.0 / y, k, -value / y, UNIT * abs(value))
            return Taped(self.tape, node, value, self.size / abs(y))
        y = float(other)
        if y == 1.0:
            return self
        value = x / y
        noise = 0.0 if _is_power_of_two(y) else UNIT * abs(value)
        return Taped(self.tape, (self.index, 1.0 / y, 0, 0.0, noise), value, self.size / abs(y))

    def __rtruediv__(self, other: float) -> Taped:
        return self.tape.constant(other) / self

    def __abs__(self) -> float:
        return abs(self.value)

    def __float__(self) -> float:
        return self.value

    def exp(self) -> Taped:
        """e to its power."""
        value = math.exp(self.value)
        return Taped(self.tape, (self.index, value, 0, 0.0, 2.0 * UNIT * value), value, value)

    def as_zero(self) -> Taped:
        """The zero that this was found to be, with its derivatives."""
        return self - self.value

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


class BackwardPass(NamedTuple):
    """What one backward pass says of a result: its error bound, and its derivatives by path."""

    bound: float
    by_path: dict[str, float]


class Tape:
    """The record; an `icsolve.numbers.Arithmetic` whose numbers are `Taped`."""

    def __init__(self) -> None:
        self.nodes: list[Node] = [(*NONE, 0.0)]
        self.inputs: dict[str, Taped] = {}
        self.turns: dict[str, tuple[Taped, Taped]] = {}
        self.suspects: list[tuple[int, float]] = []
        """index and value of divisors and radicands that nearly vanish"""
        self.converted: dict[str, float] = {}
        """rounding of the numbers whose units were converted"""

    def constant(self, value: float) -> Taped:
        """An exact number."""
        return self._leaf(value, 0.0)

    def _leaf(self, value: float, noise: float) -> Taped:
        """A number that is made of no others."""
        return Taped(self, (*NONE, noise), value, abs(value))

    def given(self, number: Number) -> Taped:
        """A number of the case, with the rounding of its decimals; one node a path."""
        found = self.inputs.get(number.path)
        if found is None:
            noise = decimal_noise(number)
            found = self.inputs[number.path] = self._leaf(number.value, noise)
            if number.factor != 1.0:
                self.converted[number.path] = noise
        return found

    def ratio(self, exact: ExactRatio) -> Taped:
        """The nearest double, with its rounding."""
        value = nearest(exact)
        return self._leaf(value, 0.0 if value == 1.0 else UNIT * abs(value))

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
        return Taped(self, (angle.index, derivative, 0, 0.0, noise), value, abs(value))

    def sqrt(self, value: Operand) -> Taped:
        """Square root; of rounding noise below zero: zero, with no derivative."""
        if not isinstance(value, Taped):
            return self.constant(math.sqrt(max(value, 0.0)))
        x, size = value.value, value.size
        if x <= CANCELLED * size:
            self.suspects.append((value.index, x))
        if x <= 0.0:
            return Taped(self, (*NONE, math.sqrt(UNIT * size)), 0.0, math.sqrt(size))
        root = math.sqrt(x)
        return Taped(self, (value.index, 0.5 / root, 0, 0.0, UNIT * root), root, math.sqrt(size))

    def angle(self, x: Operand, y: Operand) -> Taped:
        """Direction of a vector, degrees in (-180, 180]."""
        u, v = (value if isinstance(value, Taped) else self.constant(value) for value in (x, y))
        degrees = math.degrees(math.atan2(v.value, u.value))
        rate = math.degrees(1.0) / (u.value * u.value + v.value * v.value or 1.0)
        node = (u.index, -v.value * rate, v.index, u.value * rate, 4.0 * UNIT * abs(degrees))
        return Taped(self, node, degrees, 180.0)

    def vanishes(self, value: Operand, size: float) -> bool:
        """Zero where it lies within its own bound.

        A value that is not small against its ``size`` is left to the bound of what is made from it.
        """
        return abs(value) <= LARGE * size and abs(value) <= self.bound(value)

    def bound(self, value: Operand) -> float:
        """Bound, to first order, on the absolute error of a value [its units]; 0 of a plain number."""
        return self._swept(value.index)[0] if type(value) is Taped else 0.0

    def back(self, result: Operand) -> BackwardPass:
        """The backward pass from a result: the bound of its error, and its derivative by every number of the
        case, by path [units of the result over those of the number]; 0.0 where that is rounding.
        """
        if type(result) is not Taped:
            return BackwardPass(0.0, {})
        last = result.index
        bound, weights = self._swept(last)
        sizes = self._sizes(last)
        leaves = {p: leaf.index for p, leaf in self.inputs.items() if leaf.index <= last}
        return BackwardPass(
            bound, {p: weights[k] if abs(weights[k]) > SPENT * sizes[k] else 0.0 for p, k in leaves.items()}
        )

    def _swept(self, last: int) -> tuple[float, list[float]]:
        """Sum of the effects of all roundings on the value at ``last``, and its derivative by every value
        recorded before it."""
        weights = [0.0] * (last + 1)
        weights[last] = 1.0
        bound = 0.0
        for k in self._reached(last) if last > LONG else range(last, 0, -1):
            w = weights[k]
            if w:
                a, da, b, db, noise = self.nodes[k]
                bound += w * noise if w > 0.0 else -w * noise
                weights[a] += w * da
                if b:
                    weights[b] += w * db
        return bound, weights

    def _reached(self, last: int) -> list[int]:
        """The values that the one at ``last`` was made from, and itself, the last first."""
        found, seen = [last], {0, last}
        for k in found:
            a, _, b, _, _ = self.nodes[k]
            for operand in (a, b):
                if operand not in seen:
                    seen.add(operand)
                    found.append(operand)
        found.sort(reverse=True)
        return found

    def _sizes(self, last: int) -> list[float]:
        """Of the derivatives of the value at ``last``, the sum of the absolute values of their terms."""
        sizes = [0.0] * (last + 1)
        sizes[last] = 1.0
        for k in range(last, 0, -1):
            if size := sizes[k]:
                a, da, b, db, _ = self.nodes[k]
                sizes[a] += size * abs(da)
                if b:
                    sizes[b] += size * abs(db)
        return sizes

    def doubts(self, fraction: float) -> Iterable[float]:
        """Bound over value of the divisors and radicands that nearly vanish, where above a fraction."""
        for k, value in dict.fromkeys(self.suspects):
            bound = self._swept(k)[0]
            if bound > fraction * abs(value):
                yield bound / abs(value) if value else 0.0


SHORT = 15
"""A decimal of no more characters that rounds to a whole number is that number."""


def _is_exact(number: Number) -> bool:
    """Whether a whole double is the number itself, in case units."""
    if number.exact is not None:
        num, den, power = number.exact
        return not power and num == int(number.value) * den
    return len(number.digits) <= SHORT or Decimal(number.digits) == number.value


def decimal_noise(number: Number) -> float:
    """Bound on the rounding of a written decimal to a double (and of its unit's factor) [case units]."""
    value = number.value
    whole = number.factor == 1.0 and value.is_integer() and abs(value) < 2.0**53
    if whole and _is_exact(number):
        return 0.0
    return (UNIT if number.factor == 1.0 else 3.0 * UNIT) * abs(value)
