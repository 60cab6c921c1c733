"""The same program in sixty digits of mpmath, on the decimals of the file: the reference of bounds."""

from __future__ import annotations

from typing import Any

from mpmath import mp, mpf

from icsolve.case import Number
from icsolve.numbers.units import ExactRatio

mp.dps = 60


class SixtyDigits:
    """An arithmetic of mpmath numbers, on the decimals of the file and the exact ratios of their units."""

    rounds = 5

    def given(self, number: Number) -> Any:
        return mpf(number.digits) if number.exact is None else self.ratio(number.exact)

    def ratio(self, exact: ExactRatio) -> Any:
        num, den, power = exact
        return mpf(num) / den * mp.pi**power

    def turn(self, number: Number) -> tuple[Any, Any]:
        radians = self.given(number) * mp.pi / 180
        return mp.cos(radians), mp.sin(radians)

    def sqrt(self, value: Any) -> Any:
        return mp.sqrt(max(mpf(value), mpf(0)))

    def vanishes(self, value: Any, size: Any) -> bool:
        return bool(abs(value) <= mpf(10) ** -40 * size)


class AsRead(SixtyDigits):
    """The same on the doubles as they were read: what remains is the error of the method alone."""

    def given(self, number: Number) -> Any:
        return mpf(number.value)
