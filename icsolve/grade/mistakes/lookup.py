"""Known wrong answers, sorted, and which of them a value may be: one mistake, or two at once."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Iterator
from functools import cached_property
from typing import NamedTuple

from icsolve.grade.mistakes.codes import FACTORS, ORDER, PLAIN, Wrong

MOST = 3
"""Causes that are named where several fit."""
_ROUNDING = 0.002
"""Relative difference that rounding on the way leaves between an answer and the mistake that it shows."""
_DIGITS = 0.005
"""Half a unit in the last of three figures, where it is not known how many were written."""
_FOUR = 0.0003
"""That of four figures, in the middle."""
_CHANCE = 0.07
"""Part of all answers that named mistakes may cover together, so that a cause is seldom told by chance."""
_SPAN = 3.0


class Pair(NamedTuple):
    """Two mistakes at once, and the value that they give together."""

    value: float
    one: Wrong
    two: Wrong


class Room:
    """What mistakes may cover of all answers, those that are even up to three times the right one, and those
    that are even in their powers of ten from a thousandth to a thousand times of it; of an angle, which whole
    turns do not change, those that are even over the ``period``. With ``others`` right answers beside this
    one each has its part."""

    def __init__(self, right: float, period: float, others: int) -> None:
        self._right = right
        self._period = period
        self._even = self._decades = _CHANCE / (1.0 + others)

    def take(self, value: float, width: float) -> bool:
        """Whether there is room for a value with its relative half-width; it is taken then."""
        size = abs(value / self._right)
        even = size * width / _SPAN if size <= _SPAN else 0.0
        if self._period:
            even, size = 2.0 * abs(value) * width / self._period, 0.0
        decades = width / (6.0 * math.log(10.0)) if 1e-3 <= size <= 1e3 else 0.0
        if even > self._even or decades > self._decades:
            return False
        self._even -= even
        self._decades -= decades
        return True


class Wrongs:
    """Wrong answers sorted by value, made when the first wrong answer asks for them.

    What the band about the ``right`` answer holds is dropped. ``reach`` is the relative half-width within
    which a plain mistake is recognised: that of the right one, 5 % at most. One that takes a wrong step is
    recognised within what rounding leaves, so that a random number seldom meets one; mistakes beyond those
    that a hit by chance allows are left out, the least simple first.
    """

    def __init__(
        self,
        make: Callable[[], Iterable[Wrong]],
        right: float,
        half: float,
        period: float = 0.0,
        others: int = 0,
    ) -> None:
        self._make = make
        self._room = Room(right, period, others)
        self._right = right
        self._half = half
        self.reach = min(half / abs(right), 0.05) if right else 0.01

    @cached_property
    def all(self) -> tuple[Wrong, ...]:
        """The wrong answers by value."""
        right, half = self._right, self._half
        kept = [w for w in self._make() if math.isfinite(w.value) and w.value and abs(w.value - right) > half]
        return tuple(sorted(self._likely(kept), key=lambda w: (w.value, ORDER[w.code])))

    def _likely(self, wrongs: list[Wrong]) -> list[Wrong]:
        """As many as may be hit by chance, the simplest first."""
        if not self._right:
            return wrongs
        kept: list[Wrong] = []
        for wrong in sorted(wrongs, key=lambda w: ORDER[w.code]):
            if _is_known(wrong.value, kept) or self._room.take(wrong.value, self._width(wrong.code, _FOUR)):
                kept.append(wrong)
        return kept

    def _width(self, code: str, digits: float) -> float:
        return self.reach if code in PLAIN else min(self.reach, digits + _ROUNDING)

    @cached_property
    def _values(self) -> list[float]:
        return [wrong.value for wrong in self.all]

    def near(self, value: float, digits: str = "") -> tuple[Wrong, ...]:
        """The wrong answers that a value may be, simplest cause first, one of each code; ``digits`` as it was
        written, if that is known."""
        values, reach = self._values, self.reach
        width = reach * abs(value) * (1.0 + reach)
        first = bisect_left(values, value - width)
        if first == len(values) or not values[first] <= value + width < math.inf:
            return ()
        last = bisect_right(values, value + width, first)
        some = self.all[first:last]
        if last - first == 1 and some[0].code in PLAIN:
            return some if abs(value - some[0].value) <= reach * abs(some[0].value) else ()
        last_figure = _last_figure(digits)
        fitting = [w for w in some if abs(value - w.value) <= self._width(w.code, last_figure) * abs(w.value)]
        return tuple(fitting) if len(fitting) < 2 else _simplest(fitting, value)

    @cached_property
    def _pairs(self) -> list[Pair]:
        """Two mistakes at once, by value; as many as may be hit by chance beside the single ones."""
        kept: list[Pair] = []
        seen = [w.value for w in self.all]
        for pair in _likeliest(self._two_at_once()):
            size = abs(pair.value)
            if not (math.isfinite(size) and size) or abs(pair.value - self._right) <= 2.0 * self._half:
                continue
            if any(abs(pair.value - v) <= 2.0 * _ROUNDING * size for v in seen):
                continue
            if not self._room.take(pair.value, min(self.reach, _FOUR + _ROUNDING)):
                break
            kept.append(pair)
            seen.append(pair.value)
        return sorted(kept, key=lambda p: p.value)

    @cached_property
    def _pair_values(self) -> list[float]:
        return [pair.value for pair in self._pairs]

    def _two_at_once(self) -> Iterator[Pair]:
        """A wrong step with a plain mistake on top; two wrong steps at different loads, whose shares add
        up.
        """
        steps = [w for w in self.all if w.code not in PLAIN]
        for wrong in steps:
            for code, factor, where in _ON_TOP:
                yield Pair(wrong.value * factor, Wrong(code, 0.0, where), wrong)
        for n, one in enumerate(steps):
            for two in steps[n + 1 :]:
                if one.load and two.load and one.load != two.load:
                    yield Pair(one.value + two.value - self._right, one, two)
        for code, factor, where in _ON_TOP[1:]:
            yield Pair(-self._right * factor, Wrong("sign", 0.0), Wrong(code, 0.0, where))

    def two(self, value: float, digits: str = "") -> tuple[Wrong, ...]:
        """The two mistakes that give a value together; none where it is no such value, or of several
        pairs.
        """
        if not self._right:
            return ()
        values, width = self._pair_values, min(self.reach, _DIGITS + _ROUNDING) * abs(value)
        first = bisect_left(values, value - width)
        if first == len(values) or not values[first] <= value + width < math.inf:
            return ()
        last = bisect_right(values, value + width, first)
        nearest = min(self._pairs[first:last], key=lambda p: abs(p.value - value))
        last_figure = _last_figure(digits)
        if last_figure > _DIGITS or abs(nearest.value - value) > (last_figure + _ROUNDING) * abs(value):
            return ()
        return nearest.one, nearest.two


_ON_TOP: tuple[tuple[str, float, str], ...] = (
    ("sign", -1.0, ""),
    ("half", 0.5, ""),
    ("double", 2.0, ""),
    *(("power-of-ten", 10.0**k, "") for k in (-3, 3, -1, 1)),
    *(
        ("unit-factor", FACTORS[name] ** k, name)
        for name in ("in and mm", "ft and in", "lb and N", "kg and N")
        for k in (1, -1)
    ),
)
"""Plain mistakes that are made on top of another."""


def _last_figure(digits: str) -> float:
    """Half a unit of the last written figure as a part of the number; for a fraction that of three."""
    mantissa = digits.lower().partition("e")[0].lstrip("+-")
    size = abs(float(mantissa)) if mantissa else 0.0
    return 0.5 * 10.0 ** -len(mantissa.partition(".")[2]) / size if size else _DIGITS


def _likeliest(pairs: Iterable[Pair]) -> list[Pair]:
    """A lost sign on top of a wrong step first, then two wrong steps at different loads, then other slips."""

    def rank(pair: Pair) -> tuple[int, int]:
        tier = 0 if pair.one.code == "sign" else 1 if pair.one.code not in PLAIN else 2
        return tier, ORDER[pair.one.code] + ORDER[pair.two.code]

    return sorted(pairs, key=rank)


def _is_known(value: float, kept: list[Wrong]) -> bool:
    return any(abs(value - other.value) <= _ROUNDING * abs(value) for other in kept)


def _simplest(fitting: list[Wrong], value: float) -> tuple[Wrong, ...]:
    """The nearest of each code, simplest code first."""
    nearest: dict[str, Wrong] = {}
    for wrong in sorted(fitting, key=lambda w: abs(value - w.value)):
        nearest.setdefault(wrong.code, wrong)
    return tuple(sorted(nearest.values(), key=lambda w: ORDER[w.code])[:MOST])
