"""A number that varies from row to row, and what it is made of, in the arithmetic of a record."""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, Any

from icsolve.numbers.arithmetic import Scalar
from icsolve.tuples import NamedTuple

if TYPE_CHECKING:
    from icsolve.numbers.record import Record


class Op(IntEnum):
    """What a node is or does to the nodes ``a`` and ``b``."""

    INPUT = 0
    CONST = 1
    ADD = 2
    SUB = 3
    MUL = 4
    DIV = 5
    NEG = 6
    SQRT = 7
    COS = 8
    SIN = 9
    ANGLE = 10
    """the angle (degrees, within half a turn) of a vector by its components x and y"""
    NEAREST = 11
    """the nearest whole number"""


class Node(NamedTuple):
    """One recorded value.

    Attributes
    ----------
    op : the operation
    a, b : nodes of its operands, 0 where there is none
    value : in the position in which the record was made
    row : whether it varies from row to row
    noise : bounds the rounding of a constant
    """

    op: Op
    a: int
    b: int
    value: float
    row: bool
    noise: float = 0.0


class Traced:
    """A number of a record; ``value`` is its value in the position in which the record was made."""

    __slots__ = ("index", "record", "row", "value")

    def __init__(self, record: Record, index: int, value: float, row: bool) -> None:
        self.record, self.index, self.value, self.row = record, index, value, row

    def __add__(self, other: Scalar) -> Scalar:
        return self.record.add(self, other)

    __radd__ = __add__

    def __sub__(self, other: Scalar) -> Scalar:
        return self.record.subtract(self, other)

    def __rsub__(self, other: Scalar) -> Scalar:
        return self.record.subtract(other, self)

    def __mul__(self, other: Scalar) -> Scalar:
        return self.record.multiply(self, other)

    __rmul__ = __mul__

    def __truediv__(self, other: Scalar) -> Scalar:
        return self.record.divide(self, other)

    def __rtruediv__(self, other: Scalar) -> Scalar:
        return self.record.divide(other, self)

    def __neg__(self) -> Scalar:
        return self.record.negate(self)

    def __abs__(self) -> float:
        return abs(self.value)

    def __float__(self) -> float:
        return self.value

    def max(self) -> float:
        """As an array's, where a size is asked for."""
        return self.value

    def __eq__(self, other: object) -> bool:
        """No number that varies is equal to a constant in every row."""
        if isinstance(other, Traced):
            return self.index == other.index
        return not self.row and self.value == other

    def __lt__(self, other: Scalar) -> bool:
        return self.value < float(other)

    def __gt__(self, other: Scalar) -> bool:
        return self.value > float(other)

    def __le__(self, other: Scalar) -> bool:
        return self.value <= float(other)

    def __ge__(self, other: Scalar) -> bool:
        return self.value >= float(other)

    def __hash__(self) -> int:
        return self.index


class Root(NamedTuple):
    """Where two loci meet: the node of the square root that is half their chord, its radicand, and the
    two margins (node, size of its terms) whose product that is."""

    node: int
    radicand: int
    margins: tuple[tuple[int, int], tuple[int, int]]


def varies(value: Scalar) -> bool:
    """Whether a value differs from row to row."""
    return isinstance(value, Traced) and value.row


def is_plainly(value: Any, constant: float) -> bool:
    """Whether a value is this number itself, without noise."""
    return isinstance(value, float) and value == constant
