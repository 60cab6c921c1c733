"""Balls: decimals of as many digits as are asked for, each with a bound on its error.

A `Ball` stands for every number within ``radius`` of ``value``. Each operation encloses its result: the
errors of its operands, carried through, and its own rounding, at p digits at most 5 in the (p + 1)-th
(R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis, 2009, ch. 2 and 4; centred
form: A. Neumaier, Interval Methods for Systems of Equations, 1990, ch. 1). The numbers of a case are exact
here: the decimals of the file times the exact ratios of their units.

A question that a ball leaves open (a sign, a zero) raises `MoreDigits`, and the caller asks again with more.
At the highest precision what is zero to within 1e-40 of its terms is zero.

The operations go through contexts of their own, never the default context of `decimal`.
"""

import math
from collections.abc import Mapping, Sequence
from decimal import Decimal
from typing import Union, final

from icsolve.numbers import Scalar
from icsolve.numbers.decimals import (
    GUARD,
    WIDE,
    context_of,
    cos_sin_within,
    decimal_of,
    pi,
    quarter_turns,
)
from icsolve.numbers.units import ExactRatio, Number

UP = 1.0 + 2.0**-49
"""Times this, a few roundings of floats err upward."""
TINY = 5e-323
"""More than what a few products of floats that underflow have lost."""
ZERO_FRACTION = 1e-40
"""What is smaller than this fraction of its terms, at the highest precision, is zero."""
ROW_FRACTION = 1e-60
"""What is smaller than this fraction of its terms is zero at any precision: only a row of a sweep, whose
coordinates are rounded, comes so near to a singular position."""
PRECISIONS = (30, 60, 120)
"""Digits with which a scene is evaluated, one after the other, until everything is decided."""
NORMAL = 2.3e-308
"""Above this floats have all their digits."""
SPENT = 30
"""Digits that a number of a scene loses on the way, at the most, where it is zero and its terms are too."""
INEXACT = -(10**9)
"""The last digit's exponent of a number that is not known to be exact."""

FOUND_ZERO = INEXACT - 1
"""In its place, where a number was found to be zero."""

Operand = Union["Ball", float]


class MoreDigits(Exception):
    """A question that this many digits leave open."""


class BelowZero(ValueError):
    """The square root of a number that is less than zero."""


@final
class Ball:
    """A decimal and a bound on its error.

    ``size`` is an upper bound of ``abs(value)``. Where ``radius`` is zero the value is exact, and a whole
    multiple of ten to the power ``last``.
    """

    __slots__ = ("arithmetic", "last", "radius", "size", "value")

    def __init__(self, arithmetic: "Balls", value: Decimal, radius: float, size: float, last: int) -> None:
        self.arithmetic, self.value, self.radius, self.size = arithmetic, value, radius, size
        self.last = last

    def __repr__(self) -> str:
        return f"<{self.value} +- {self.radius:.3g}>"

    def __add__(self, other: Operand) -> "Ball":
        a = self.arithmetic
        if type(other) is not Ball:
            if other == 0.0:
                return self
            other = a.ball(other)
        x, y = self.value, other.value
        value = a.add(x, y)
        if x.is_signed() is y.is_signed():
            size = (self.size + other.size) * a.up
        else:
            size = abs(float(value)) * UP + TINY
        return self._summed(other, value, size)

    __radd__ = __add__

    def __sub__(self, other: Operand) -> "Ball":
        a = self.arithmetic
        if type(other) is not Ball:
            if other == 0.0:
                return self
            other = a.ball(other)
        x, y = self.value, other.value
        value = a.subtract(x, y)
        if x.is_signed() is y.is_signed():
            size = abs(float(value)) * UP + TINY
        else:
            size = (self.size + other.size) * a.up
        return self._summed(other, value, size)

    def _summed(self, other: "Ball", value: Decimal, size: float) -> "Ball":
        """A sum or difference with its bound: exact where no digit fell off the end."""
        a, spread = self.arithmetic, self.radius + other.radius
        if not value:
            spread *= a.carried
            return Ball(a, value, spread * UP, 0.0, self.last if self.last < other.last else other.last)
        if spread == 0.0:
            last = self.last if self.last < other.last else other.last
            if value.adjusted() - last < a.digits:
                return Ball(a, value, 0.0, size, last)
        return Ball(a, value, (spread * a.carried + a.unit * size) * UP + TINY, size, INEXACT)

    def __rsub__(self, other: float) -> "Ball":
        if other == 0.0:
            return -self
        return self.arithmetic.ball(other) - self

    def __neg__(self) -> "Ball":
        return Ball(self.arithmetic, self.value.copy_negate(), self.radius, self.size, self.last)

    def __mul__(self, other: Operand) -> Scalar:
        a = self.arithmetic
        if type(other) is not Ball:
            if other == 1.0:
                return self
            if other == 0.0:
                return 0.0
            other = a.ball(other)
        value = a.multiply(self.value, other.value)
        m, n, r, s = self.size, other.size, self.radius, other.radius
        if not value and (m == r == 0.0 or n == s == 0.0):
            return 0.0
        size = m * n * a.up + TINY
        if r == 0.0 and s == 0.0:
            last = self.last + other.last
            if not value or value.adjusted() - last < a.digits:
                return Ball(a, value, 0.0, size, last)
            return Ball(a, value, (a.unit * size) * UP + TINY, size, INEXACT)
        radius = ((m * s + n * r + r * s) * a.carried + a.unit * size) * UP + TINY
        zero = not value and FOUND_ZERO in (self.last, other.last)
        return Ball(a, value, radius, size, FOUND_ZERO if zero else INEXACT)

    __rmul__ = __mul__

    def __truediv__(self, other: Operand) -> "Ball":
        a = self.arithmetic
        if type(other) is not Ball:
            if other == 1.0:
                return self
            if abs(math.frexp(other)[0]) == 0.5 and 2.0**-1023 <= abs(other) < 2.0**1000:
                halved: Ball = self * (1.0 / other)
                return halved
            other = a.ball(other)
        least = abs(float(other.value)) / UP - other.radius
        if not least > NORMAL:
            raise ZeroDivisionError if not other.value and other.radius == 0.0 else MoreDigits
        if not self.value and self.radius == 0.0:
            return self
        value = a.divide(self.value, other.value)
        size = abs(float(value)) * UP + TINY
        radius = (self.radius + size * other.radius) / least
        if radius == 0.0 and (last := _exact_quotient(self, other, value)) is not None:
            return Ball(a, value, 0.0, size, last)
        last = FOUND_ZERO if self.last == FOUND_ZERO else INEXACT
        return Ball(a, value, (radius * a.carried + a.unit * size) * UP + TINY, size, last)

    def __rtruediv__(self, other: float) -> "Ball":
        return self.arithmetic.ball(other) / self

    def __abs__(self) -> float:
        return abs(float(self.value))

    def __float__(self) -> float:
        return float(self.value)

    def __bool__(self) -> bool:
        """False for the exact zero alone."""
        return bool(self.value) or self.radius != 0.0

    def __eq__(self, other: object) -> bool:
        """Whether the two are known to be the same exact number; never open."""
        if type(other) is Ball:
            return self.radius == 0.0 and other.radius == 0.0 and self.value == other.value
        return self.radius == 0.0 and isinstance(other, int | float) and self.value == Decimal(other)

    def __lt__(self, other: Operand) -> bool:
        return (self - other).sign < 0

    def __gt__(self, other: Operand) -> bool:
        return (self - other).sign > 0

    def __le__(self, other: Operand) -> bool:
        return (self - other).sign <= 0

    def __ge__(self, other: Operand) -> bool:
        return (self - other).sign >= 0

    __hash__ = None  # type: ignore[assignment]

    @property
    def sign(self) -> int:
        """-1, 0 or 1; raises MoreDigits where the ball leaves it open (0 is exact)."""
        if self.holds_zero:
            if self.radius == 0.0:
                return 0
            raise MoreDigits
        return -1 if self.value.is_signed() else 1

    def exp(self) -> "Ball":
        """e to its power: the value's is the nearest decimal, and e^d - 1 bounds what a change by d adds."""
        a, value = self.arithmetic, self.arithmetic.power(self.value)
        size = float(value) * UP + TINY
        radius = math.expm1(self.radius) * size * UP * UP
        return Ball(a, value, (radius * a.carried + a.unit * size) * UP + TINY, size, INEXACT)

    def as_zero(self) -> "Ball":
        """The zero that this was found to be, with the distance that it may lie off."""
        radius = (abs(float(self.value)) + self.radius) * UP
        return Ball(self.arithmetic, Decimal(0), radius, 0.0, FOUND_ZERO if radius else 0)

    @property
    def is_certain(self) -> bool:
        """Whether it is certainly not zero."""
        return not self.holds_zero

    @property
    def holds_zero(self) -> bool:
        """Whether zero lies in the ball."""
        return not self.value if self.radius == 0.0 else not abs(float(self.value)) > self.radius * UP + TINY

    @property
    def exact(self) -> bool:
        """Whether the ball is a single number."""
        return self.radius == 0.0


def _exact_quotient(above: Ball, below: Ball, value: Decimal) -> int | None:
    """The last digit's exponent of a quotient of exact numbers that has no remainder; else None."""
    quotient = value.normalize(WIDE)
    _, digits, last = quotient.as_tuple()
    assert isinstance(last, int)
    if len(digits) >= above.arithmetic.digits or WIDE.multiply(quotient, below.value) != above.value:
        return None
    return last


class Balls:
    """The arithmetic of `Ball` at a number of digits; an `icsolve.numbers.Arithmetic`.

    ``highest`` says that no more digits will be asked for: then what is zero to within 1e-40 of its terms
    is zero. With ``carried`` 0 a ball has its own rounding alone: along very long chains radii explode that
    the true errors do not fill, and a tape then tells how these add up, to first order.
    """

    certain = True
    """what it says of a zero is so"""

    def __init__(self, digits: int, highest: bool = False, carried: float = 1.0) -> None:
        self.digits, self.highest, self.carried = digits, highest, carried
        context = context_of(digits)
        self.add, self.subtract = context.add, context.subtract
        self.multiply, self.divide, self.root = context.multiply, context.divide, context.sqrt
        self.power = context.exp
        self.unit = max(float(f"1e-{digits}"), TINY) * UP * 5.0
        """half a unit of the last digit, over the value: at most 5 in the digit after it"""
        self.up = UP * (1.0 + self.unit)
        self.nothing = float(f"1e{SPENT - digits}")
        """what is zero in a frame of size 1, though its terms vanish too"""
        self.inputs: dict[str, tuple[Number, Ball]] = {}
        self.turns: dict[str, tuple[Number, tuple[Scalar, Scalar]]] = {}
        self.floats: dict[float, Ball] = {}

    def ball(self, value: float) -> Ball:
        """An exact number."""
        found = self.floats.get(value)
        if found is None:
            found = self.floats[value] = self.exactly(Decimal(value))
        return found

    def exactly(self, value: Decimal) -> Ball:
        """A decimal, however many digits it has."""
        last = value.as_tuple().exponent
        assert isinstance(last, int)
        return Ball(self, value, 0.0, abs(float(value)) * UP + (TINY if value else 0.0), last)

    def ratio(self, exact: ExactRatio) -> Ball:
        """``num / den * pi**power``."""
        num, den, power = exact
        found = self.exactly(Decimal(num)) / self.exactly(Decimal(den))
        for _ in range(abs(power)):
            found = found * self.pi() if power > 0 else found / self.pi()
        return found

    def pi(self) -> Ball:
        """The ratio of the circumference of a circle to its diameter."""
        return self._rounded(pi(self.digits + GUARD), float(f"1e-{self.digits}") + TINY)

    def given(self, number: Number) -> Ball:
        """A number of the case in case units, as its file writes it."""
        found = self.inputs.get(number.path)
        if found is None or found[0] is not number:
            found = self.inputs[number.path] = (number, self._read(number))
        return found[1]

    def _read(self, number: Number) -> Ball:
        if number.exact is not None:
            return self.ratio(number.exact)
        return self.exactly(decimal_of(number))

    def turn(self, number: Number) -> tuple[Scalar, Scalar]:
        """Cosine and sine of an angle of the case (degrees)."""
        found = self.turns.get(number.path)
        if found is None or found[0] is not number:
            found = self.turns[number.path] = (number, self.cos_sin(self.given(number)))
        return found[1]

    def cos_sin(self, degrees: Ball) -> tuple[Scalar, Scalar]:
        """Cosine and sine of an angle in degrees; exact at multiples of 90, and the halves at 30."""
        quarter, rest = quarter_turns(degrees.value)
        c: Scalar = 1.0
        s: Scalar = 0.0
        if rest or degrees.radius:
            cosine, sine = cos_sin_within(rest, self.digits)
            off, own = degrees.radius * 0.0174533, float(f"1e-{self.digits + 2}")
            c, s = (self._rounded(v, (off + abs(float(v)) * own) * UP + TINY) for v in (cosine, sine))
            if degrees.radius == 0.0 and rest.copy_abs() == 30:  # abs() rounds to 28 digits
                s = self.ball(0.5 if rest > 0 else -0.5)
        return ((c, s), (-s, c), (-c, -s), (s, -c))[quarter]

    def _rounded(self, value: Decimal, radius: float) -> Ball:
        return Ball(self, value, radius, abs(float(value)) * UP + TINY, INEXACT)

    def sqrt(self, value: Scalar) -> Scalar:
        """Square root.

        Raises MoreDigits where the sign is open, except at the highest precision, where a value that may be
        zero is taken as not below it; raises BelowZero below zero.
        """
        if type(value) is not Ball:
            value = self.ball(value)
        if value.holds_zero:
            if value.radius == 0.0:
                return 0.0
            if not self.highest:
                raise MoreDigits
            most = math.sqrt(abs(float(value.value)) + value.radius) * UP + TINY
            return Ball(self, Decimal(0), most, 0.0, INEXACT)
        if value.value.is_signed():
            raise BelowZero
        root = self.root(value.value)
        size = abs(float(root)) * UP + TINY
        if value.radius == 0.0:
            last = (value.last - 1) // 2
            if root.adjusted() - last < self.digits and WIDE.multiply(root, root) == value.value:
                return Ball(self, root, 0.0, size, last)
        radius = value.radius / size * UP * UP  # |sqrt x - sqrt v| <= |x - v| / sqrt v
        return Ball(self, root, (radius * self.carried + self.unit * size) * UP + TINY, size, INEXACT)

    def vanishes(self, value: Scalar, size: float) -> bool:
        """Whether a value is zero; ``size`` is that of the products it is summed from.

        Raises MoreDigits where that is open.
        """
        if type(value) is not Ball:
            return bool(value == 0.0)
        if not self.carried and value.radius:
            return not abs(float(value.value)) > ZERO_FRACTION * size
        if not value.holds_zero:
            return abs(float(value.value)) <= ROW_FRACTION * size
        if value.radius == 0.0:
            return True
        if self.highest and value.radius <= max(ZERO_FRACTION * size, self.nothing):
            return True
        raise MoreDigits

    def angle(self, x: Scalar, y: Scalar) -> Scalar:
        """Direction of a vector, degrees in (-180, 180].

        What is left of it at the angle that floats give is an arc tangent of 1e-15, of which four terms of
        the series are good to 1e-135; what they leave out is less than the fifth.
        """
        near = math.degrees(math.atan2(float(y), float(x))) + 0.0
        c, s = self.cos_sin(self.ball(near))
        t = (y * c - x * s) / (x * c + y * s)
        if type(t) is not Ball or not t:
            return near
        square = t * t
        power = t * square
        left = (t - power / 3.0 + power * square / 5.0 - power * square * square / 7.0) * 180.0 / self.pi()
        off = left.radius + (t.size + t.radius) ** 9 * 10.0 + TINY
        return Ball(self, left.value, off, left.size, INEXACT) + near

    def rounded(self, value: Scalar, size: float = 0.0) -> tuple[float, float]:
        """The nearest double, and a bound on its error (at most 2 units in its last place).

        A value that is zero to within 1e-40 of ``size`` is 0.0, and how far it may lie from it its error.
        Raises MoreDigits where the digits do not suffice.
        """
        if type(value) is not Ball:
            return float(value) + 0.0, 0.0
        near = float(value.value)
        if math.isinf(near):
            return near, math.inf
        if value.last == FOUND_ZERO:
            return 0.0, value.radius
        if value.holds_zero and self.vanishes(value, size):
            return 0.0, (abs(near) + value.radius) * UP
        if not value.radius <= 0.25 * math.ulp(near):
            raise MoreDigits
        off = abs(float(self.subtract(value.value, Decimal(near))))
        return near + 0.0, (off * UP + value.radius) * UP if off or value.radius else 0.0


class HalfUnits(Balls):
    """Numbers of 15 digits or more stand for all that round to them, those of 17 at most for all that round
    to their double: what half a unit of their last digits may make zero, or so many (``count``), is zero."""

    def __init__(self, digits: int, highest: bool = False, count: float = 1.0) -> None:
        super().__init__(digits, highest)
        self.count = count

    def _read(self, number: Number) -> Ball:
        found = super()._read(number)
        if is_long(number):
            half = number.half
            if not half or _digits(number) <= DOUBLE:
                half = max(half, math.ulp(number.value) / 2.0)
            half *= self.count
            found = Ball(self, found.value, half * UP, found.size + half, INEXACT)
        return found

    def vanishes(self, value: Scalar, size: float) -> bool:
        """Whether a value may be zero; raises MoreDigits where that would say nothing."""
        if type(value) is not Ball or value.radius == 0.0 or not value.holds_zero:
            return super().vanishes(value, size)
        if value.radius > COARSE * size:
            raise MoreDigits
        return True

    def rounded(self, value: Scalar, size: float = 0.0) -> tuple[float, float]:
        """The nearest double, and how far off half units may put it."""
        if type(value) is not Ball or value.last == FOUND_ZERO:
            return super().rounded(value, size)
        near = float(value.value)
        return near + 0.0, (value.radius + math.ulp(near)) * UP


class MovedBalls(Balls):
    """The numbers of a case, some of them moved by steps, by path."""

    def __init__(self, steps: Mapping[str, Decimal], digits: int) -> None:
        super().__init__(digits, highest=True)
        self.steps = steps

    def _read(self, number: Number) -> Ball:
        found, step = super()._read(number), self.steps.get(number.path)
        return found if step is None else found + self.exactly(step)


COARSE = 1e-9
"""Half units that put a zero in doubt by more than this fraction of its terms explain nothing."""
LONG = 15
"""Digits from which on a number was written by a program."""
DOUBLE = 17
"""Digits that a double is written with at most: its spacing may be more than their last unit."""


def is_long(number: Number) -> bool:
    """Whether a number has at least 15 digits, as programs write them."""
    return _digits(number) >= LONG


def is_double(number: Number) -> bool:
    """Whether a number is written as programs write doubles: in no more digits than tell one apart, and in
    those that so many of its double are."""
    digits = _digits(number)
    if not LONG <= digits <= DOUBLE:
        return False
    return Decimal(number.digits) == Decimal(format(float(number.digits), f".{digits}g"))


def _digits(number: Number) -> int:
    """How many digits a number is written with, zeros before the first left out."""
    digits = number.digits.lower().partition("e")[0]
    return len(digits.replace(".", "").lstrip("+-−0"))


def widest(values: Sequence[Scalar]) -> float:
    """The largest radius among some numbers."""
    return max((value.radius for value in values if type(value) is Ball), default=0.0)
