"""Decimals of many digits: pi, cosine and sine, directions, and the numbers that a file has.

What balls bound (`icsolve.numbers.balls`) and what a row of a sweep is run on in high precision
(`icsolve.sweep.exact_record`) is worked out here, through contexts of their own, never the default one of
`decimal`.
"""

from __future__ import annotations

import math
from decimal import (
    MAX_EMAX,
    MIN_EMIN,
    ROUND_HALF_EVEN,
    Context,
    Decimal,
    DivisionByZero,
    InvalidOperation,
    Overflow,
    localcontext,
)
from functools import cache, lru_cache

from icsolve.numbers.units import ExactRatio, Number

GUARD = 10
"""Digits that functions are taken further than their result needs."""
DIGITS = 240
"""Digits of a row of a sweep in high precision."""
CONTEXT = Context(prec=DIGITS, Emin=-999_999, Emax=999_999, traps=[DivisionByZero])
"""The context of such a row: what is not a number compares with nothing."""


def context_of(digits: int) -> Context:
    """A context that owes nothing to the default one."""
    traps = [InvalidOperation, DivisionByZero, Overflow]
    return Context(digits, ROUND_HALF_EVEN, MIN_EMIN, MAX_EMAX, capitals=1, clamp=0, flags=[], traps=traps)


WIDE = context_of(20_000)
"""Wide enough that sums and products of two numbers of a scene are exact."""
_guarded = cache(context_of)
_TURN = Decimal(360)


@cache
def pi(digits: int) -> Decimal:
    """Pi to so many digits, by Machin's formula in whole numbers; the error is less than one in the last."""
    one: int = 10 ** (digits - 1 + GUARD)

    def arc_tangent(n: int) -> int:
        k, term = 1, one // n
        total = term
        while term:
            term = -(term // (n * n)) if term > 0 else (-term) // (n * n)
            k += 2
            total += term // k
        return total

    found = (16 * arc_tangent(5) - 4 * arc_tangent(239)) // 10**GUARD
    return Decimal(found).scaleb(1 - digits, WIDE)


def quarter_turns(degrees: Decimal) -> tuple[int, Decimal]:
    """The nearest whole number of quarter turns, of those of one turn, and the rest of an angle [degrees],
    within 45: exact."""
    within = WIDE.remainder(degrees, _TURN)
    quarter = round(float(within) / 90.0)
    return quarter % 4, WIDE.subtract(within, Decimal(90 * quarter))


def cos_sin_within(rest: Decimal, digits: int) -> tuple[Decimal, Decimal]:
    """Cosine and sine of an angle within 45 degrees, each but for 1e-(digits + 2) of it.

    The series of sin(h) / h in h squared, where h is half the angle, is summed in whole numbers of units of
    2**-bits, and twice its product with cos(h) is sin(2h) / h. Its terms alternate and fall, and each loses
    less than two units: of at most 150, and with what follows, that is less than 1e-(digits + 15). The other
    steps are rounded in the last of digits + `GUARD`.
    """
    bits = 10 * digits // 3 + 64
    one, context = Decimal(1 << bits), _guarded(digits + GUARD)
    half = context.divide(context.multiply(rest, pi(digits + GUARD)), _TURN)
    squared, term, total, k = int(context.multiply(context.multiply(half, half), one)), 1 << bits, 0, 1
    while term:
        total += term
        k += 2
        term = -(term * squared >> bits) // (k * (k - 1))
    square = (total * total >> bits) * squared >> bits  # of the sine of half the angle
    cosine = math.isqrt((1 << 2 * bits) - (square << bits))
    c, over = Decimal((1 << bits) - 2 * square), Decimal(total * cosine >> bits - 1)
    return context.divide(c, one), context.multiply(context.divide(over, one), half)


@lru_cache(maxsize=64)
def cos_sin(degrees: Decimal) -> tuple[Decimal, Decimal]:
    """Cosine and sine of an angle [degrees] of a row, exact at multiples of 90; not a number of so many turns
    that a sum has no digit of it."""
    if not degrees.is_finite() or degrees.adjusted() > DIGITS // 2:
        return Decimal("NaN"), Decimal("NaN")
    quarter, rest = quarter_turns(degrees)
    c, s = cos_sin_within(rest, DIGITS)
    return ((c, s), (-s, c), (-c, -s), (s, -c))[quarter]


FIFTH = Decimal("1e-50")
"""The fifth power of a smaller angle is nothing to all digits: two terms of its arc tangent suffice."""


def angle(x: Decimal, y: Decimal) -> Decimal:
    """Direction of a vector [degrees] of a row, within half a turn."""
    with localcontext(CONTEXT):
        size = max(abs(x), abs(y))
        if not size or not size.is_finite():
            return Decimal("NaN") if size else Decimal(0)
        x, y = x / size, y / size
        if not y:
            return Decimal(0 if x > 0 else -180)
        if not x:
            return Decimal(90 if y > 0 else -90)
        found, tangent = Decimal(math.degrees(math.atan2(float(y), float(x)))), Decimal(1)
        while abs(tangent) > FIFTH:
            c, s = cos_sin(found)
            across, along = y * c - x * s, x * c + y * s
            tangent = across / along
            found += (tangent - tangent**3 / 3) * 180 / pi(DIGITS)
        return found


# --- what a file has --------------------------------------------------------------------------------


def as_written(value: float) -> Decimal:
    """The decimal by which a file would name a double."""
    return Decimal(repr(float(value)))


def decimal_of(number: Number) -> Decimal:
    """A number of the case, as the file has it: its unit by the exact factor [case units]."""
    if number.exact is not None:
        return decimal_ratio(number.exact)
    return Decimal(number.digits) if number.factor == 1.0 else Decimal(number.value)


def decimal_ratio(exact: ExactRatio) -> Decimal:
    """An exact ratio, in the digits of the context."""
    num, den, power = exact
    return Decimal(num) / den * pi(DIGITS) ** power if power else Decimal(num) / den
