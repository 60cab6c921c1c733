"""Numbers of fifty digits on the file's own decimals: what confirms a scene too near a singular one.

`Long` wraps `decimal.Decimal` (imported only here) so that the same kernels run on it.
"""

from __future__ import annotations

from decimal import Context, Decimal

from icsolve.numbers.arithmetic import Scalar
from icsolve.numbers.given import Number

PRECISION = 50
CONTEXT = Context(prec=PRECISION)
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899")


class Long:
    """A decimal number of fifty digits with the operators that kernels use; floats are exact in it."""

    __slots__ = ("value",)

    def __init__(self, value: Decimal) -> None:
        self.value = value

    def __add__(self, other: Scalar) -> Long:
        return Long(CONTEXT.add(self.value, _decimal(other)))

    __radd__ = __add__

    def __sub__(self, other: Scalar) -> Long:
        return Long(CONTEXT.subtract(self.value, _decimal(other)))

    def __rsub__(self, other: Scalar) -> Long:
        return Long(CONTEXT.subtract(_decimal(other), self.value))

    def __mul__(self, other: Scalar) -> Long:
        return Long(CONTEXT.multiply(self.value, _decimal(other)))

    __rmul__ = __mul__

    def __truediv__(self, other: Scalar) -> Long:
        return Long(CONTEXT.divide(self.value, _decimal(other)))

    def __rtruediv__(self, other: Scalar) -> Long:
        return Long(CONTEXT.divide(_decimal(other), self.value))

    def __neg__(self) -> Long:
        return Long(-self.value)

    def __abs__(self) -> float:
        return abs(float(self.value))

    def __float__(self) -> float:
        return float(self.value)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, int | float | Long) and self.value == _decimal(other)

    def __lt__(self, other: Scalar) -> bool:
        return self.value < _decimal(other)

    def __gt__(self, other: Scalar) -> bool:
        return self.value > _decimal(other)

    def __le__(self, other: Scalar) -> bool:
        return self.value <= _decimal(other)

    def __ge__(self, other: Scalar) -> bool:
        return self.value >= _decimal(other)

    __hash__ = None  # type: ignore[assignment]


def _decimal(other: Scalar) -> Decimal:
    return other.value if isinstance(other, Long) else Decimal(other)


class Digits:
    """The arithmetic of `Long`: numbers as the file writes them, unless their unit was converted."""

    def given(self, number: Number) -> Long:
        """The decimal as written; the double where a unit was converted."""
        if number.factor == 1.0:
            return Long(Decimal(number.digits))
        return Long(Decimal(number.value))

    def turn(self, number: Number) -> tuple[Long, Long]:
        """Cosine and sine of an angle in degrees, by their series after exact reduction."""
        degrees = self.given(number).value % 360
        quarter = int((degrees / 90).to_integral_value())
        rest = CONTEXT.multiply(degrees - 90 * quarter, CONTEXT.divide(PI, Decimal(180)))
        c, s = _series(rest, Decimal(1)), _series(rest, rest)
        c, s = ((c, s), (-s, c), (-c, -s), (s, -c))[quarter % 4]
        return Long(c), Long(s)

    def sqrt(self, value: Scalar) -> Long:
        """Square root, of noise below zero: zero."""
        decimal = _decimal(value)
        return Long(CONTEXT.sqrt(decimal) if decimal > 0 else Decimal(0))

    def vanishes(self, value: Scalar, size: float) -> bool:
        """Zero to half of the digits."""
        return bool(abs(value) <= 10.0 ** (-PRECISION // 2) * size)


def _series(x: Decimal, first: Decimal) -> Decimal:
    """Cosine (first term 1) or sine (first term x) by the power series."""
    term = total = first
    n = 0 if first == 1 else 1
    while abs(term) > Decimal(10) ** (-PRECISION - 5):
        n += 2
        term = CONTEXT.divide(CONTEXT.multiply(-term, CONTEXT.multiply(x, x)), Decimal(n * (n - 1)))
        total = CONTEXT.add(total, term)
        if term == 0:
            break
    return total
