"""A record over whole cells of its input: values and two derivatives, each with a radius that holds them.

Taylor arithmetic of order two on balls (midpoint and radius, arrays over cells), after R. E. Moore, Interval
Analysis (1966). What a radius leaves out, no place in the cell has: so zeros are excluded, and those that are
there told to be single, without looking between samples.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np

from icsolve.numbers.record import Op, Record, Traced, live
from icsolve.numbers.replay import Array
from icsolve.tuples import NamedTuple

ROUNDED = 2.0**-51
"""Relative rounding of an operation on a midpoint."""
UP = 1.0 + 2.0**-49
"""Makes up for the roundings of a radius."""
RADIAN = float(np.pi / 180.0)


class BallArray(NamedTuple):
    """Numbers between ``mid - rad`` and ``mid + rad``.

    Attributes
    ----------
    mid : (cells,)
    rad : (cells,), not negative; infinite where nothing is known
    """

    mid: Array
    rad: Array

    def __add__(self, other: BallArray) -> BallArray:  # type: ignore[override]
        return _rounded(self.mid + other.mid, self.rad + other.rad)

    def __sub__(self, other: BallArray) -> BallArray:
        return _rounded(self.mid - other.mid, self.rad + other.rad)

    def __mul__(self, other: BallArray) -> BallArray:  # type: ignore[override]
        one, two = np.abs(self.mid), np.abs(other.mid)
        return _rounded(self.mid * other.mid, one * other.rad + self.rad * (two + other.rad))

    def __neg__(self) -> BallArray:
        return BallArray(-self.mid, self.rad)

    def times(self, factor: float) -> BallArray:
        """A multiple by an exact factor, (cells,)."""
        return _rounded(self.mid * factor, self.rad * abs(factor))

    def inverse(self) -> BallArray:
        """1 over the numbers, (cells,); radius infinite where zero is among them."""
        size = np.abs(self.mid)
        low = size - self.rad
        return _rounded(1.0 / self.mid, np.where(low > 0.0, self.rad / (size * low), np.inf))

    def root(self) -> BallArray:
        """Square root of those that are not negative, (cells,); 0 where all are negative."""
        high = np.sqrt(np.maximum(self.mid + self.rad, 0.0))
        low = np.sqrt(np.maximum(self.mid - self.rad, 0.0))
        mid = 0.5 * (high + low)
        return _rounded(mid, 0.5 * (high - low) + ROUNDED * mid)

    def narrower(self, other: BallArray) -> BallArray:
        """Of each two that hold the same number, the narrower, (cells,)."""
        mine = ~(other.rad < self.rad)
        return BallArray(np.where(mine, self.mid, other.mid), np.where(mine, self.rad, other.rad))

    @property
    def excludes_zero(self) -> np.typing.NDArray[np.bool_]:
        """Where none of the numbers is zero, (cells,)."""
        return np.asarray(np.abs(self.mid) > self.rad)


def _rounded(mid: Array, rad: Array) -> BallArray:
    """What an operation makes, with room for its roundings."""
    return BallArray(mid, (rad + ROUNDED * np.abs(mid)) * UP)


class Jet(NamedTuple):
    """A value and its first two derivatives by the one input of `Cells`.

    Attributes
    ----------
    value, first, second : (cells,) each [unit, unit per unit of the input, and per its square; angles in
        degrees]. Sums, products and so on follow from Leibniz' rule, and enclose (R. E. Moore, Interval
        Analysis, 1966).
    """

    value: BallArray
    first: BallArray
    second: BallArray

    def __add__(self, other: Jet) -> Jet:  # type: ignore[override]
        (a, a1, a2), (b, b1, b2) = self, other
        if isinstance(other, StillJet):
            return type(self)(a + b, a1, a2)
        return Jet(a + b, b1, b2) if isinstance(self, StillJet) else Jet(a + b, a1 + b1, a2 + b2)

    def __sub__(self, other: Jet) -> Jet:
        (a, a1, a2), (b, b1, b2) = self, other
        if isinstance(other, StillJet):
            return type(self)(a - b, a1, a2)
        return Jet(a - b, -b1, -b2) if isinstance(self, StillJet) else Jet(a - b, a1 - b1, a2 - b2)

    def __neg__(self) -> Jet:
        return type(self)(*(-a for a in self))

    def __mul__(self, other: Jet) -> Jet:  # type: ignore[override]
        (a, a1, a2), (b, b1, b2) = self, other
        if isinstance(other, StillJet):
            return StillJet(a * b, a1, a2) if isinstance(self, StillJet) else Jet(a * b, a1 * b, a2 * b)
        if isinstance(self, StillJet):
            return Jet(a * b, a * b1, a * b2)
        return Jet(a * b, a1 * b + a * b1, a2 * b + (a1 * b1).times(2.0) + a * b2)

    def over(self, other: Jet) -> Jet:
        """Quotient; unbounded in the cells in which ``other`` may be zero."""
        (a, a1, a2), (b, b1, b2) = self, other
        inverse = b.inverse()
        q = a * inverse
        q1 = (a1 - q * b1) * inverse
        return Jet(q, q1, (a2 - (q1 * b1).times(2.0) - q * b2) * inverse)

    def within(self, middle: Jet, half: Array) -> Jet:
        """The narrower of these bounds and of those about the middles of the cells (mean value form).

        Parameters
        ----------
        middle : the same jet at the middles
        half : (cells,), half-widths of the cells
        """
        bend = np.abs(self.second.mid) + self.second.rad
        slope = np.abs(middle.first.mid) + middle.first.rad
        value = BallArray(middle.value.mid, (middle.value.rad + slope * half + bend * half * half) * UP)
        first = BallArray(middle.first.mid, (middle.first.rad + bend * half) * UP)
        return Jet(self.value.narrower(value), self.first.narrower(first), self.second)

    def root(self) -> Jet:
        """Square root; its derivatives are unbounded where the value may be zero."""
        a, a1, a2 = self
        s = a.root()
        half = s.inverse().times(0.5)
        s1 = a1 * half
        return Jet(s, s1, (a2 - (s1 * s1).times(2.0)) * half)

    def cos_sin(self) -> tuple[Jet, Jet]:
        """Cosine and sine of an angle [degrees]."""
        x, x1, x2 = (part.times(RADIAN) for part in self)
        c, s = np.cos(x.mid), np.sin(x.mid)
        wide = np.minimum(x.rad, 4.0)
        rad = wide * wide * 0.5 + 4.0 * ROUNDED
        cos = BallArray(c, np.minimum(np.abs(s) * wide + rad, 2.0))
        sin = BallArray(s, np.minimum(np.abs(c) * wide + rad, 2.0))
        square = x1 * x1
        return (
            Jet(cos, -(sin * x1), -(cos * square) - sin * x2),
            Jet(sin, cos * x1, cos * x2 - sin * square),
        )

    def direction(self, other: Jet) -> Jet:
        """Direction of a vector (self, other) [degrees]; the middle in (-180, 180], widened by a whole turn
        in cells that hold the cut, unbounded where they hold the origin.
        """
        (x, x1, x2), (y, y1, y2) = self, other
        inverse = (x * x + y * y).inverse()
        turned = (x * y1 - y * x1) * inverse
        bent = ((x * y2 - y * x2) - ((x * x1 + y * y1) * turned).times(2.0)) * inverse
        mid = np.degrees(np.arctan2(y.mid, x.mid))
        off, far = np.hypot(x.rad, y.rad), np.hypot(x.mid, y.mid)
        rad = np.where(off < far, np.degrees(np.arcsin(off / far)), np.inf)
        rad = np.where(np.abs(mid) + rad < 180.0, rad, rad + 360.0) + 360.0 * ROUNDED
        return Jet(BallArray(mid, rad), turned.times(1.0 / RADIAN), bent.times(1.0 / RADIAN))

    def nearest(self) -> Jet:
        """The nearest whole number, which is the same in a cell or has no derivative there."""
        mid, rad = np.rint(self.value.mid), self.value.rad
        same = np.rint(self.value.mid - rad) == np.rint(self.value.mid + rad)
        nothing = np.zeros_like(mid)
        open_ = BallArray(nothing, np.where(same, 0.0, np.inf))
        return Jet(BallArray(mid, np.where(same, 0.0, rad + 1.0)), open_, open_)


class StillJet(Jet):
    """One that is the same at all inputs: its derivatives are zero."""

    __slots__ = ()


class Cells:
    """A record over cells of one input.

    Parameters
    ----------
    record : the record
    wanted : indices of nodes
    main : node of the input that runs through the cells
    inputs : by node, the numbers of the other inputs (those that vary, too); 0 of one that is not there
    """

    def __init__(self, record: Record, wanted: Sequence[int], main: int, inputs: Mapping[int, float]) -> None:
        self.record, self.wanted, self.main, self.inputs = record, tuple(wanted), main, inputs
        self.order = live(record.nodes, self.wanted)
        last = {n: k for k in self.order for n in record.nodes[k].of}
        self.gone: dict[int, list[int]] = {}
        """by node, those that no later one needs"""
        for n, k in last.items():
            if n not in self.wanted:
                self.gone.setdefault(k, []).append(n)

    def run(self, mid: Array, half: Array) -> tuple[list[Jet], list[Jet]]:
        """The wanted nodes over the cells ``mid - half`` to ``mid + half``, and at their middles.

        What a root is taken of, and what is divided by, has the narrower of its bounds: that of its own
        terms, or that about the middle.

        Parameters
        ----------
        mid, half : (cells,) [unit of the main input; degrees for an angle]; ``half`` is not negative

        Returns
        -------
        tuple[list[Jet], list[Jet]]
            A jet a wanted node: over the cells, and at the middles (whose derivatives hold there alone).
        """
        whole: dict[int, Jet] = {}
        middle: dict[int, Jet] = {}
        nothing = BallArray(np.zeros_like(mid), np.zeros_like(mid))
        one = BallArray(np.ones_like(mid), np.zeros_like(mid))

        def still(value: float, noise: float) -> Jet:
            return StillJet(BallArray(np.full_like(mid, value), np.full_like(mid, noise)), nothing, nothing)

        def of(jets: dict[int, Jet], k: int) -> Jet:
            if k not in jets:
                value = self.record.nodes[k].value
                jets[k] = still(value, STILL * abs(value))
            return jets[k]

        with np.errstate(all="ignore"):
            for k in self.order:
                node = self.record.nodes[k]
                if node.op == Op.INPUT:
                    noise = ROUNDED * np.abs(mid)
                    number = self.inputs.get(k, 0.0)
                    whole[k] = still(number, ROUNDED * abs(number))
                    middle[k] = whole[k]
                    if k == self.main:
                        whole[k] = Jet(BallArray(mid, half + noise), one, nothing)
                        middle[k] = Jet(BallArray(mid, noise), one, nothing)
                    continue
                narrow = {Op.SQRT: node.a, Op.DIV: node.b}.get(node.op)
                if narrow is not None:
                    whole[narrow] = of(whole, narrow).within(of(middle, narrow), half)
                for jets in (whole, middle):
                    jets[k] = _result(node, partial(of, jets))
                    for n in self.gone.get(k, ()):
                        jets.pop(n, None)
            return [of(whole, k) for k in self.wanted], [of(middle, k) for k in self.wanted]


def _result(node: Traced, of: Callable[[int], Jet]) -> Jet:
    """The jet of a node from those of what it is made of."""
    match node.op:
        case Op.ADD:
            return of(node.a) + of(node.b)
        case Op.SUB:
            return of(node.a) - of(node.b)
        case Op.MUL:
            return of(node.a) * of(node.b)
        case Op.DIV:
            return of(node.a).over(of(node.b))
        case Op.NEG:
            return -of(node.a)
        case Op.SQRT:
            return of(node.a).root()
        case Op.ANGLE:
            return of(node.a).direction(of(node.b))
        case Op.NEAREST:
            return of(node.a).nearest()
        case Op.COS:
            return of(node.a).cos_sin()[0]
        case Op.SIN:
            return of(node.a).cos_sin()[1]
    raise TypeError(node.op)


STILL = 2.0**-45
"""Relative error that is allowed for what is the same in every row."""
