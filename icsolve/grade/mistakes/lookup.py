"""Known mistakes: their codes and what a student is told of them, and which of them a value may be: one, or
two at once.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache

from icsolve.tuples import NamedTuple, cached_property

CODES: dict[str, str] = {
    "unit": "The number is right, but not in this unit.",
    "no-unit": "The number is right; its unit is missing.",
    "unit-case": "The number is right; the capitals of its unit are not.",
    "figures": "The number is right, but written with too few figures.",
    "sign": "Right size, wrong sense. Check the sign of the power of each load.",
    "direction": "Right size, but this is not how the direction of this quantity is given.",
    "no-direction": "Right size; say its direction in words as well.",
    "one-end": "One end of the range is right; the other is missing or wrong.",
    "power-of-ten": "The digits are right, the power of ten is not. Check mm and m, N and kN.",
    "unit-factor": "Off by a unit factor: in and mm, ft and in, lb and N, kg and N, degrees and radians.",
    "deg-rad": "Was the calculator set to radians?",
    "no-cos": "Use only the component of the velocity along the force{at}.",
    "sin-cos": "Sine and cosine are exchanged{at}.",
    "inverse-ratio": "A velocity ratio is upside down{at}.",
    "wrong-ic": "A distance is taken from another centre of the same link{at}. About which one does it turn?",
    "mesh-sense": "An outer mesh is taken for an inner one, or a crossed belt for an open one.",
    "missed-load": "The power of one load is missing{at}.",
    "load-sense": "The power of one load has the wrong sign{at}.",
    "other-unknown": "This is the size of another unknown{at}.",
    "half": "Half the right size. Is something counted once that is there twice?",
    "double": "Twice the right size. Is something counted twice?",
    "other-mode": "This belongs to the other way in which the mechanism assembles. Compare with the figure.",
    "no-friction": "Friction is left out.",
    "friction-sense": "Friction acts against the motion; here it acts with it.",
    "ratio-one": "A velocity ratio is taken as 1{at}.",
    "missed-stage": "One stage of the chain of ratios is left out{at}.",
    "one-component": "Only one component of the arm or the force is taken{at}.",
    "one-arm": "Of the two distances of a ratio one is left out{at}.",
    "angle-sense": "An angle is measured the other way round{at}.",
    "rpm": "Revolutions a minute are taken for radians a second, or the other way.",
    "free-length": "The free length, or the free angle, of a spring is left out{at}.",
    "area": "The area under a pressure is taken wrong{at}: pi/4 of the bore squared, less that of the rod.",
    "line-load": "A force per length is taken wrong{at}: how large is its resultant, and where does it act?",
    "mass": "A mass is taken for a weight, or a weight for a mass{at}.",
    "rope-parts": "The parts of a rope that pull are counted wrong{at}.",
    "wrap": "The angle over which a rope lies is taken wrong, or left out of the exponent{at}.",
    "lead": "A screw moves by its lead a turn, which is 2 pi radians.",
    "no-inertia": "An inertia force or couple is left out{at}.",
    "no-acceleration": "The acceleration that is given is left out, or has the wrong sense.",
    "neighbour": "This is the right answer to other numbers than yours{at}.",
    "swapped": "The two coordinates are exchanged.",
    "carried": "The method is right; the error comes from an earlier answer{at}.",
    "override": "Marked by hand.",
    "near-miss": "Close, but not within the tolerance. Rounding on the way? Keep four figures.",
}
"""Stable codes in order of simplicity: of several that fit, the first is told."""

ORDER = {code: index for index, code in enumerate(CODES)}


class Wrong(NamedTuple):
    """A wrong answer whose cause is known: its code, its signed value, and where the mistake sits."""

    code: str
    value: float
    where: str = ""
    load: str = ""
    """the load whose share it changes, where it changes no other"""


_OTHERWISE = {
    ("direction", "vector"): "Right size; the angle of its direction is wrong by more than a degree.",
    ("no-direction", "vector"): "Right size; say its direction as well, as an angle.",
    ("sign", "ratio"): "Right size, wrong sense. Do the two links turn the same way?",
    ("sign", "rate"): "Right size, wrong sense. Which way does the link turn?",
    ("sign", "speed"): "Right size, wrong sense. Which way does the point move?",
    ("sign", "place"): "The sizes are right; a coordinate has the wrong sign.",
    ("sign", "reaction"): "Right size, wrong sense. Which link's force on which is asked?",
    ("sign", "length"): "Right size; a distance has no sign.",
    ("power-of-ten", "ratio"): "The digits are right, the power of ten is not. A ratio has no unit.",
    ("power-of-ten", "place"): "The digits are right, the power of ten is not. Check mm and m.",
    ("power-of-ten", "length"): "The digits are right, the power of ten is not. Check mm and m.",
    ("unit-factor", "place"): "Off by a unit factor: in and mm, ft and in.",
    ("unit-factor", "length"): "Off by a unit factor: in and mm, ft and in.",
    ("unit-factor", "ratio"): "Off by a factor of units; a ratio has none.",
    ("wrong-ic", "place"): "This is another centre{at}.",
    ("sign", "position"): "Right size, wrong sense. From where, and which way round, is it measured?",
    ("power-of-ten", "position"): "The digits are right, the power of ten is not. Check mm and m.",
    ("unit-factor", "position"): "Off by a unit factor: degrees and radians, in and mm.",
    ("sin-cos", "position"): "This is the angle from the other axis.",
    ("angle-sense", "position"): "This is the angle from the other end of the line.",
    ("missed-load", "position"): "One load is missing{at}.",
    ("load-sense", "position"): "One load has the wrong sense{at}.",
    ("half", "ratio"): "Half the right size. Is a ratio counted once that stands there twice?",
}
"""What is told where a question asks for something else than a load."""


@lru_cache(maxsize=4096)
def message(code: str, where: str = "", kind: str = "load") -> str:
    """The line for a mistake in an answer of a ``kind``: what was asked for.

    It names the cause and the load, link or centre, never the answer.
    """
    told = _OTHERWISE.get((code, kind)) or CODES[code]
    return told.format(at=f" ({where})" if where else "")


def together(one: Wrong, two: Wrong, kind: str = "load") -> str:
    """The line for two mistakes that were made at once."""
    said = " ".join(message(wrong.code, wrong.where, kind) for wrong in (one, two))
    return f"Two mistakes at once: {said}"


PLAIN = frozenset({"sign", "power-of-ten", "unit-factor", "half", "double", "rpm"})
"""Mistakes that need nothing but the right answer: a factor on it."""


FACTORS = {
    "in and mm": 25.4,
    "ft and in": 12.0,
    "lb and N": 4.4482216152605,
    "kg and N": 9.80665,
    "ft and m": 0.3048,
    "degrees and radians": 57.29577951308232,
}
"""Unit factors that are forgotten or applied twice."""
_REVOLUTIONS = {"revolutions and radians": 6.283185307179586}
_RPM = 9.549296585513721


def plain_wrongs(value: float, rate: bool) -> Iterator[Wrong]:
    """The wrong answers about a right ``value``; of an angular speed (``rate``) with those of revolutions."""
    yield Wrong("sign", -value)
    for power in (*range(-6, 0), *range(1, 7)):
        yield Wrong("power-of-ten", value * 10.0**power)
        yield Wrong("power-of-ten", -value * 10.0**power)
    for name, factor in (FACTORS | (_REVOLUTIONS if rate else {})).items():
        yield Wrong("unit-factor", value * factor, name)
        yield Wrong("unit-factor", value / factor, name)
    if rate:
        yield Wrong("rpm", value * _RPM)
        yield Wrong("rpm", value / _RPM)
    yield Wrong("half", value / 2.0)
    yield Wrong("double", value * 2.0)


# --- which of them a value may be -------------------------------------------------------------------

MOST = 3
"""Causes that are named where several fit."""
_ROUNDING = 0.002
"""Relative difference that rounding on the way leaves between an answer and the mistake that it shows."""
_DIGITS = 0.005
"""Half a unit in the last of three figures, where it is not known how many were written."""
_FOUR = 0.0003
"""That of four figures, in the middle."""
_CHANCE = 0.076
"""Part of all answers that named mistakes may cover together, so that a cause is seldom told by chance."""
_SPAN = 3.0


def near_miss(half: float, period: float) -> float:
    """How far off an answer is close: three times the tolerance; of an angle, of which a percent is much near
    a whole turn, a 72nd of a turn at most."""
    return min(3.0 * half, max(half, period / 72.0)) if period else 3.0 * half


class Pair(NamedTuple):
    """Two mistakes at once, and the value that they give together."""

    value: float
    one: Wrong
    two: Wrong


class Room:
    """What mistakes may cover of all answers, those that are even up to three times the right one, and those
    that are even in their powers of ten from a thousandth to a thousand times of it; of an angle, which whole
    turns do not change, those that are even over the ``period``. With ``others`` right answers beside this
    one each has its part. Near misses have theirs first."""

    def __init__(self, right: float, half: float, period: float, others: int) -> None:
        self._right = right
        self._period = period
        self._even = self._decades = _CHANCE / (1.0 + others)
        if right:
            self.take(right, (near_miss(half, period) - half) / abs(right))

    def take(self, value: float, width: float) -> bool:
        """Whether there is room for a value with its relative half-width; it is taken then. Of a negative one
        the bare size is an answer too."""
        size = abs(value / self._right)
        width *= 2.0 if self._right < 0.0 and value < 0.0 and not self._period else 1.0
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
        self._room = Room(right, half, period, others)
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
            beyond = min((abs(1.0 - other.value / wrong.value) for other in kept), default=math.inf) / 2.0
            if self._room.take(wrong.value, min(self.width(wrong.code, _FOUR), beyond)):
                kept.append(wrong)
        return kept

    def width(self, code: str, digits: float = _DIGITS) -> float:
        """The relative half-width within which a mistake is recognised; half a unit of an answer's last
        figure is ``digits`` of it."""
        return self.reach if code in PLAIN else min(self.reach, digits + _ROUNDING)

    @cached_property
    def _values(self) -> list[float]:
        return [wrong.value for wrong in self.all]

    def near(self, value: float, digits: str = "") -> tuple[Wrong, ...]:
        """The wrong answers that a value may be, simplest cause first, one of each code; ``digits`` as it was
        written, if that is known."""
        reach = self.reach
        first, last = _within(self._values, value, reach * abs(value) * (1.0 + reach))
        if first == last:
            return ()
        some = self.all[first:last]
        if len(some) == 1 and some[0].code in PLAIN:
            return some if abs(value - some[0].value) <= reach * abs(some[0].value) else ()
        last_figure = _last_figure(digits)
        fitting = [w for w in some if abs(value - w.value) <= self.width(w.code, last_figure) * abs(w.value)]
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
        width = min(self.reach, _DIGITS + _ROUNDING) * abs(value)
        first, last = _within(self._pair_values, value, width)
        if first == last:
            return ()
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


def _within(values: list[float], value: float, width: float) -> tuple[int, int]:
    """Which of sorted values lie within a width of one: from the first to before the last."""
    first = bisect_left(values, value - width)
    if first == len(values) or not values[first] <= value + width < math.inf:
        return first, first
    return first, bisect_right(values, value + width, first)


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


def _simplest(fitting: list[Wrong], value: float) -> tuple[Wrong, ...]:
    """The nearest of each code, simplest code first."""
    nearest: dict[str, Wrong] = {}
    for wrong in sorted(fitting, key=lambda w: abs(value - w.value)):
        nearest.setdefault(wrong.code, wrong)
    return tuple(sorted(nearest.values(), key=lambda w: ORDER[w.code])[:MOST])
