"""The arithmetics on which the same kernels run; here what a kernel needs of a number type beyond + - * /.

Another number type (arrays in a sweep, numbers on a tape, mpmath in tests) brings an object with
the same methods as `Floats`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Sequence
from typing import Any

from icsolve.numbers.units import ExactRatio, Number, nearest
from icsolve.tuples import Protocol

Scalar = Any
"""A float, an array of them, or any number type with + - * /."""
RADIAN = math.pi / 180.0
"""A degree, in radians."""
DEGREE: ExactRatio = (1, 180, 1)
"""The same exactly."""
HALF_TURN = 1e-13
"""Of a turn: of two numbers of whole turns that are so nearly as near to a guess the lower is taken."""


def magnitude(value: Scalar) -> float:
    """Largest absolute value: of a float, a ball, a number on a tape, or an array of any shape."""
    size = abs(value)
    return size if type(size) is float else float(size.max() if hasattr(size, "max") else size)


def largest_of(values: Collection[Scalar]) -> float:
    """The largest `magnitude` of some; 0 of none."""
    try:
        found = max(map(abs, values), default=0.0)
    except ValueError:  # arrays
        found = None
    return found if type(found) is float else max(map(magnitude, values))


def sum_of_sizes(values: Sequence[Scalar]) -> float:
    """What the magnitudes of some add up to."""
    found = sum(map(abs, values))
    return found if type(found) is float else float(sum(map(magnitude, values)))


def turn_of(degrees: float) -> tuple[float, float]:
    """Cosine and sine of an angle [degrees]; exact at multiples of 90.

    The angle is reduced exactly (``fmod``) to within 45 degrees of an axis before it meets pi, so that a
    large angle loses nothing. Raises ValueError for an infinite angle.
    """
    reduced = math.fmod(degrees, 360.0)
    quarter = round(reduced / 90.0)
    rest = math.radians(reduced - 90.0 * quarter)
    c, s = math.cos(rest), math.sin(rest)
    return ((c, s), (-s, c), (-c, -s), (s, -c))[quarter % 4]


class Arithmetic(Protocol):
    """Where the numbers of a case come from, and the functions that are not operators."""

    def given(self, number: Number) -> Scalar:
        """A number of the case in case units."""

    def ratio(self, exact: ExactRatio) -> Scalar:
        """An exact ratio, as of two units."""

    def turn(self, number: Number) -> tuple[Scalar, Scalar]:
        """Cosine and sine of an angle of the case (degrees)."""

    def sqrt(self, value: Scalar) -> Scalar:
        """Square root; the value is never negative by more than rounding."""

    def angle(self, x: Scalar, y: Scalar) -> Scalar:
        """Direction of a vector, degrees in (-180, 180]."""

    def vanishes(self, value: Scalar, size: float) -> bool:
        """Whether a value is zero (in floats: but for rounding); ``size`` is that of the products it is
        summed from. Balls raise MoreDigits where that is open."""


class Showing(Arithmetic, Protocol):
    """An arithmetic whose numbers are shown: floats, or balls."""

    def rounded(self, value: Scalar, size: float = 0.0) -> tuple[float, float]:
        """The nearest double, and a bound on its error (in floats nothing is known of it: infinite)."""


ROUNDING = 2.0**-53
ZERO = 64 * ROUNDING
"""A pivot below this fraction of the largest is zero, times the number of rows (normalised frame)."""
ROUNDING_NOISE = 2e-14
"""Rounding of a few hundred operations, as a fraction; numbers on a tape know their own."""


class Floats:
    """Plain floats: one scene."""

    def given(self, number: Number) -> float:
        """The nearest double."""
        return number.value

    def ratio(self, exact: ExactRatio) -> Scalar:
        """The nearest double."""
        return nearest(exact)

    def turn(self, number: Number) -> tuple[float, float]:
        """Cosine and sine, exact at multiples of 90 degrees."""
        return turn_of(number.value)

    def sqrt(self, value: float) -> float:
        """Square root, of rounding noise below zero: zero."""
        return math.sqrt(value) if value > 0.0 else 0.0

    def angle(self, x: float, y: float) -> float:
        """Direction of a vector, degrees in (-180, 180]."""
        return math.degrees(math.atan2(y, x))

    def vanishes(self, value: float, size: float) -> bool:
        """Zero where it is below a fraction of its products that rounding explains."""
        return abs(value) <= ROUNDING_NOISE * size

    def rounded(self, value: float, size: float = 0.0) -> tuple[float, float]:
        """The number itself."""
        return value + 0.0, math.inf


FLOATS = Floats()


def decider(a: Arithmetic) -> Callable[[Scalar, float], bool] | None:
    """The test for zero of an arithmetic that knows it for certain (balls); None in floats, where a caller
    takes a threshold of its own.
    """
    return a.vanishes if getattr(a, "certain", False) else None


def exponential(value: Scalar) -> Scalar:
    """e to the power of a float, a ball or a number on a tape."""
    return value.exp() if hasattr(value, "exp") else math.exp(value)


def size_of(value: Scalar) -> Scalar:
    """The absolute value, as a number of its arithmetic."""
    return value if float(value) >= 0.0 else 0.0 - value


def zero_of(value: Scalar) -> Scalar:
    """The zero that a value was found to be; a ball keeps how far it may lie from it."""
    return value.as_zero() if hasattr(value, "as_zero") else 0.0


def all_vanish(a: Arithmetic, terms: Iterable[tuple[Scalar, float]]) -> bool:
    """Whether all values are zero.

    Parameters
    ----------
    a : arithmetic of the values, which decides (`Arithmetic.vanishes`)
    terms : pairs of a value and the size of the products that it is summed from, same units

    Raises
    ------
    MoreDigits
        Of balls, where it is open; not where one value is certainly not zero, though others be open.
    """
    terms = list(terms)
    if any(getattr(value, "is_certain", False) and not a.vanishes(value, size) for value, size in terms):
        return False
    return all(a.vanishes(value, size) for value, size in terms)
