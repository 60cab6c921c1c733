"""Numbers that record a program: the kernels of one scene run on them once, and then on arrays of rows.

A `Traced` number knows the operation that made it and its value in one position of the sweep, so that
the kernels may choose pivots and branches by it. Operations on numbers that are the same in every row
are carried out at once, those on 0 and 1 not at all, equal ones once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Iterable, Sequence
from typing import Any, cast
from weakref import ref

from icsolve.numbers import DEGREE, HALF_TURN, ROUNDING_NOISE, Scalar, turn_of
from icsolve.numbers.tape import UNIT, decimal_noise
from icsolve.numbers.units import ExactRatio, Number, nearest
from icsolve.tuples import NamedTuple


class Op:
    """What a node is or does to the nodes ``a`` and ``b``: plain numbers, since members of an `enum` take as
    long to look up as an operation takes.
    """

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


OPERATIONS = 12
ADD, SUB, MUL, NEG = Op.ADD, Op.SUB, Op.MUL, Op.NEG


class Traced:
    """One recorded value: a number of a record.

    Attributes
    ----------
    record : that of all its operands, which has to be kept: a number does not keep it, so that one that is no
        longer used is gone at once, without the garbage collector
    index : its place there
    op : the operation
    a, b : places of its operands, 0 where there is none; ``of`` has those that there are
    value : in the position in which the record was made
    row : whether it varies from row to row
    noise : bounds the rounding of a constant
    """

    __slots__ = ("a", "b", "index", "noise", "of", "op", "recorder", "row", "value")

    def __init__(
        self,
        record: Record,
        op: int,
        a: int,
        b: int,
        value: float,
        row: bool,
        noise: float,
        of: tuple[int, ...],
    ) -> None:
        nodes = record.nodes
        self.recorder = record.itself
        self.index = len(nodes)
        self.op = op
        self.a = a
        self.b = b
        self.of = of
        self.value = value
        self.row = row
        self.noise = noise
        nodes.append(self)

    @property
    def record(self) -> Record:
        return self.recorder()

    def __add__(self, other: Scalar) -> Scalar:
        return self.recorder().add(self, other)

    __radd__ = __add__

    def __sub__(self, other: Scalar) -> Scalar:
        return self.recorder().subtract(self, other)

    def __rsub__(self, other: Scalar) -> Scalar:
        return self.recorder().subtract(other, self)

    def __mul__(self, other: Scalar) -> Scalar:
        return self.recorder().multiply(self, other)

    __rmul__ = __mul__

    def __truediv__(self, other: Scalar) -> Scalar:
        return self.recorder().divide(self, other)

    def __rtruediv__(self, other: Scalar) -> Scalar:
        return self.recorder().divide(other, self)

    def __neg__(self) -> Scalar:
        return self.recorder().negate(self)

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


class Implicit(NamedTuple):
    """Numbers that equations give, row by row.

    Attributes
    ----------
    guesses, solved : (n,), nodes of the inputs at which the equations stand, and of those that solve them
    residuals : (equations,), nodes or floats
    derivatives : (equations, n), the same, by the unknowns
    """

    guesses: tuple[int, ...]
    solved: tuple[int, ...]
    residuals: tuple[Scalar, ...]
    derivatives: tuple[tuple[Scalar, ...], ...]

    @property
    def parts(self) -> list[Scalar]:
        """Residuals and derivatives, row by row."""
        return [*self.residuals, *(value for row in self.derivatives for value in row)]

    @property
    def is_square(self) -> bool:
        """Whether there are as many equations as unknowns."""
        return len(self.residuals) == len(self.solved)


def varies(value: Scalar) -> bool:
    """Whether a value differs from row to row."""
    return isinstance(value, Traced) and value.row


class Record:
    """The nodes in order; an `icsolve.numbers.Arithmetic` whose numbers are `Traced` or floats."""

    def __init__(self) -> None:
        self.itself = cast("Callable[[], Record]", ref(self))
        self.nodes: list[Traced] = []
        self.inputs: dict[str, Traced] = {}
        self.roots: dict[int, Root] = {}
        self.implicit: list[Implicit] = []
        self.follows = True
        """whether rows are positions of one motion, in which turns are counted on"""
        self.counted: dict[int, tuple[Traced, Scalar]] = {}
        """angles that count whole turns: the guess, and the angle with the turns of the guess"""
        self.vary: dict[str, Scalar] = {}
        """by path, what stands for a number of the case; the number itself where there is nothing"""
        self.directions: dict[int, tuple[Number, Scalar, Scalar]] = {}
        """by the number's id: cosine and sine of a direction that moves with a link"""
        self.kept: dict[tuple[str, tuple[int, ...]], Any] = {}
        """what was made of some of its nodes, by what it is: nodes never change"""
        self._known: list[dict[tuple[int, ...], Traced]] = [{} for _ in range(OPERATIONS)]
        self._constants: dict[tuple[float, str], Traced] = {}
        self.spent: dict[int, float] = {}
        """nodes that were taken as zero, of which rounding has left no digit that says so, and beside what
        size"""
        self.ratios: dict[int, ExactRatio] = {}
        """by node, what constants are that no double is"""

    # --- numbers of the case ----------------------------------------------------------------------

    def given(self, number: Number) -> Scalar:
        """A number of the case: what stands for it, or a constant with the rounding of its decimals."""
        held = self.vary.get(number.path)
        if held is not None:
            return held
        noise = decimal_noise(number)
        if not noise and not number.value:  # a 1 that is no node would be rounded unseen in sums of doubles
            return number.value
        return self._constant(number.value, noise, number.path)

    def written(self, number: Number) -> Scalar:
        """A number as the case has it, from which a varied one is counted."""
        noise = decimal_noise(number)
        return self._constant(number.value, noise, number.path) if noise else number.value

    def turn(self, number: Number) -> tuple[Scalar, Scalar]:
        """Cosine and sine of an angle of the case (degrees)."""
        moved = self.directions.get(id(number))
        return (moved[1], moved[2]) if moved is not None else self.turned(self.given(number))

    def turned(self, degrees: Scalar) -> tuple[Scalar, Scalar]:
        """Cosine and sine of an angle in degrees."""
        c, s = turn_of(float(degrees))
        if abs(c) in (0.0, 1.0) and not varies(degrees) and self._is_exact(degrees):
            return c, s
        angle = self.lifted(degrees)
        cos = self._of_one(Op.COS, angle, c)
        return cos, self._of_one(Op.SIN, angle, s, cos.index)

    def direct(self, number: Number, direction: tuple[Scalar, Scalar]) -> Number:
        """A number that stands for a direction which moves with a link."""
        own = number._replace(path=f"{number.path}@")
        self.directions[id(own)] = (own, *direction)
        return own

    def stand(self, number: Number, value: Scalar) -> Number:
        """A number of its own for which a value stands."""
        own = number._replace(path=f"{number.path}@")
        self.vary[own.path] = value
        return own

    def input(self, name: str, value: float) -> Traced:
        """A number that varies from row to row."""
        found = self.inputs[name] = Traced(self, Op.INPUT, 0, 0, value, True, 0.0, ())
        return found

    def about(self, value: float, noise: float) -> Traced:
        """A constant that is known to within some noise."""
        return self._constant(value, noise, f"about {noise!r}")

    @property
    def radian(self) -> Scalar:
        """A degree, in radians."""
        return self.ratio(DEGREE)

    def ratio(self, exact: ExactRatio) -> Scalar:
        """An exact ratio, as of two units: a double where one is that, else a constant with the rounding of
        the nearest one, and ``ratios`` has which it is."""
        num, den, power = exact
        value = nearest(exact)
        top, bottom = value.as_integer_ratio()
        if not power and top * den == bottom * num:
            return value
        found = self._constant(value, UNIT * abs(value), f"ratio {num}/{den} {power}")
        self.ratios[found.index] = exact
        return found

    def _constant(self, value: float, noise: float, name: str) -> Traced:
        found = self._constants.get((value, name))
        if found is None:
            found = self._constants[value, name] = Traced(self, Op.CONST, 0, 0, value, False, noise, ())
        return found

    # --- operations -------------------------------------------------------------------------------

    def sqrt(self, value: Scalar) -> Scalar:
        """Square root; of what is below zero: zero."""
        root = math.sqrt(max(float(value), 0.0))
        return self._of_one(Op.SQRT, value, root) if isinstance(value, Traced) else root

    def root(self, one: tuple[Scalar, Scalar], two: tuple[Scalar, Scalar]) -> Scalar:
        """Square root of a product of two margins, each with the size of its terms."""
        radicand = one[0] * two[0]
        found = self.sqrt(radicand)
        if isinstance(found, Traced) and found.row:
            margins = (self._indices(one), self._indices(two))
            self.roots[found.index] = Root(found.index, self.lifted(radicand).index, margins)
        return found

    def _indices(self, pair: tuple[Scalar, Scalar]) -> tuple[int, int]:
        return self.lifted(pair[0]).index, self.lifted(pair[1]).index

    def angle(self, x: Scalar, y: Scalar) -> Scalar:
        """Direction of a vector in degrees, within half a turn."""
        degrees = math.degrees(math.atan2(float(y), float(x)))
        if not (isinstance(x, Traced) or isinstance(y, Traced)):
            return degrees
        one, two = self.lifted(x), self.lifted(y)
        return self._of_two(Op.ANGLE, one.index, two.index, degrees, one.row or two.row)

    def turns(self, x: Scalar, y: Scalar, about: Scalar = 0.0) -> Scalar:
        """By how much a vector has turned from +x, whole turns too: those nearest to a guess, which
        becomes an input of the record (one of ``counted``); those nearest to ``about`` where each row is
        written anew."""
        angle = self.angle(x, y)
        if not self.follows:
            return angle + 360.0 * self.nearest((about - angle) / 360.0 - HALF_TURN)
        if not (isinstance(angle, Traced) and angle.row):
            return angle
        if angle.index not in self.counted:
            guess = self.input(f"turns {len(self.counted)}", angle.value)
            self.counted[angle.index] = (guess, angle + 360.0 * self.nearest((guess - angle) / 360.0))
        return self.counted[angle.index][1]

    def nearest(self, value: Scalar) -> Scalar:
        """The nearest whole number."""
        whole = float(round(float(value)))
        return self._of_one(Op.NEAREST, value, whole) if isinstance(value, Traced) else whole

    def vanishes(self, value: Scalar, size: float) -> bool:
        """Zero in every row, as its value in this one tells."""
        return bool(abs(value) <= ROUNDING_NOISE * size)

    def add(self, a: Scalar, b: Scalar) -> Scalar:
        """a + b"""
        if type(b) is not Traced:
            a, b = b, a
        if type(a) is not Traced:
            if a == 0.0:
                return b
            a = self.lifted(a)
            b = self.lifted(b)
        if b.op is NEG:
            return self.subtract(a, self.nodes[b.a])
        if a.op is NEG:
            return self.subtract(b, self.nodes[a.a])
        if a.index > b.index:
            a, b = b, a
        return self._sum(ADD, a, b, a.value + b.value)

    def subtract(self, a: Scalar, b: Scalar) -> Scalar:
        """a - b"""
        if type(b) is not Traced:
            if b == 0.0:
                return a
            b = self.lifted(b)
        if type(a) is not Traced:
            if a == 0.0:
                return self.negate(b)
            a = self.lifted(a)
        if a is b:
            return 0.0
        if b.op is NEG:
            return self.add(a, self.nodes[b.a])
        return self._sum(SUB, a, b, a.value - b.value)

    def _sum(self, op: int, a: Traced, b: Traced, value: float) -> Scalar:
        """A sum or difference; two exact numbers that cancel leave nothing."""
        row = a.row or b.row
        if value == 0.0 and not row and self._exact(a.index) and self._exact(b.index):
            return 0.0
        known, of = self._known[op], (a.index, b.index)  # as `_of_two`, which half of all numbers call
        found = known.get(of)
        if found is None:
            found = known[of] = Traced(self, op, a.index, b.index, value, row, 0.0, of)
        return found

    def multiply(self, a: Scalar, b: Scalar) -> Scalar:
        """a b"""
        if type(b) is not Traced:
            a, b = b, a
        if type(a) is not Traced:
            if a == 0.0:
                return 0.0
            if a == 1.0:
                return b
            if a == -1.0:
                return self.negate(b)
            a = self.lifted(a)
        if a.op is NEG or b.op is NEG:
            return self._outside(self.multiply, a, b)
        if a.index > b.index:
            a, b = b, a
        known, of = self._known[MUL], (a.index, b.index)
        found = known.get(of)
        if found is None:
            value, row = a.value * b.value, a.row or b.row
            found = known[of] = Traced(self, MUL, a.index, b.index, value, row, 0.0, of)
        return found

    def divide(self, a: Scalar, b: Scalar) -> Scalar:
        """a / b"""
        if type(a) is not Traced:
            if a == 0.0:
                return 0.0
            a = self.lifted(a)
        if type(b) is not Traced:
            if b == 1.0:
                return a
            if b == -1.0:
                return self.negate(a)
            b = self.lifted(b)
        if a.op is NEG or b.op is NEG:
            return self._outside(self.divide, a, b)
        value = a.value / b.value if b.value else math.copysign(math.inf, a.value)
        return self._of_two(Op.DIV, a.index, b.index, value, a.row or b.row)

    def _outside(self, operation: Callable[[Scalar, Scalar], Scalar], a: Traced, b: Traced) -> Scalar:
        """A product or quotient with the minus signs of its operands before it."""
        one, two = self.nodes[a.a] if a.op is NEG else a, self.nodes[b.a] if b.op is NEG else b
        found = operation(one, two)
        return found if a.op is b.op else self.negate(found)

    def negate(self, a: Scalar) -> Scalar:
        """-a"""
        if type(a) is not Traced:
            return -a
        if a.op is NEG:
            return self.nodes[a.a]
        if a.op is SUB:
            return self._sum(SUB, self.nodes[a.b], self.nodes[a.a], -a.value)
        return self._of_one(NEG, a, -a.value)

    def lifted(self, value: Scalar) -> Traced:
        """A number as a node of this record."""
        return value if isinstance(value, Traced) else self._constant(float(value), 0.0, "exact")

    def _of_two(self, op: int, a: int, b: int, value: float, row: bool) -> Traced:
        """What an operation makes of two nodes; the same is made once."""
        known, of = self._known[op], (a, b)
        found = known.get(of)
        if found is None:
            found = known[of] = Traced(self, op, a, b, value, row, 0.0, of)
        return found

    def _of_one(self, op: int, a: Traced, value: float, beside: int = 0) -> Traced:
        """The same of one node."""
        known, of = self._known[op], (a.index,)
        found = known.get(of)
        if found is None:
            found = known[of] = Traced(self, op, a.index, beside, value, a.row, 0.0, of)
        return found

    def _is_exact(self, value: Scalar) -> bool:
        return not isinstance(value, Traced) or self._exact(value.index)

    def _exact(self, k: int) -> bool:
        """Whether a number was given and is exact, or a multiple of one by a power of two."""
        node = self.nodes[k]
        if node.op == Op.MUL and not node.row:
            return (
                self._exact(node.a)
                and self._exact(node.b)
                and abs(math.frexp(self.nodes[node.b].value)[0]) == 0.5
            )
        return node.op == Op.CONST and not node.noise


def live(nodes: Sequence[Traced], wanted: Iterable[int], given: Container[int] = ()) -> list[int]:
    """The nodes that vary and lead to the wanted ones from the given ones, in the order of their record.

    Nodes that are the same in every row are left out: their values stand in the record.
    """
    found = {k for k in wanted if nodes[k].row}
    waiting = [*found]
    while waiting:
        k = waiting.pop()
        if k not in given:
            for n in nodes[k].of:
                if n not in found and nodes[n].row:
                    found.add(n)
                    waiting.append(n)
    return sorted(found)  # operands stand before what is made of them


def terms_of(nodes: Sequence[Traced], k: int) -> float:
    """The size of the terms that a value is summed from, where the record was made."""
    node = nodes[k]
    if node.op in (Op.ADD, Op.SUB):
        return terms_of(nodes, node.a) + terms_of(nodes, node.b)
    return terms_of(nodes, node.a) if node.op == Op.NEG else abs(node.value)


CANCELLED = 1e-9
"""A value is rounding of its terms below this fraction of them."""


def terms_within(nodes: Sequence[Traced], k: int) -> float:
    """The same, where what is multiplied or divided may be a sum that vanishes and counts by its terms."""
    sizes: dict[int, float] = {}
    waiting = [k]
    while waiting:
        node = nodes[waiting[-1]]
        parts = node.of if node.op in (Op.ADD, Op.SUB, Op.NEG, Op.MUL) else node.of[:1] * (node.op == Op.DIV)
        if missing := [n for n in parts if n not in sizes]:
            waiting += missing
            continue
        found = [sizes[n] for n in parts]
        if node.op in (Op.MUL, Op.DIV):
            values = [abs(nodes[n].value) for n in parts]
            found = [v if v > CANCELLED * size else size for v, size in zip(values, found, strict=True)]
            below = abs(nodes[node.b].value) or math.inf
            size = found[0] * found[1] if node.op == Op.MUL else found[0] / below
        else:
            size = sum(found) if found else abs(node.value)
        sizes[waiting.pop()] = size
    return sizes[k]
