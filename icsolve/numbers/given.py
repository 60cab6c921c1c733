"""A number as the case gives it: its double, its decimals and its unit."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from icsolve.numbers.units import ExactRatio
from icsolve.tuples import NamedTuple


class Number(NamedTuple):
    """A number that the case gives.

    ``value`` is the nearest double in case units, ``half`` half a unit of the last decimal
    that was written (case units), ``path`` its place (``lengths.AB``, ``loads.P.angle``),
    ``digits`` the numeral as written and ``factor`` case units per written unit. ``exact`` is the value as
    it was meant, where that is not the decimal ``digits``: a unit was converted, or arithmetic gave it.
    ``bound`` names what any number in its place keeps to (`BOUNDS`).
    """

    value: float
    half: float
    path: str
    digits: str
    factor: float = 1.0
    exact: ExactRatio | None = None
    bound: str = ""


BOUNDS: dict[str, tuple[tuple[Callable[[Any], Any], str], ...]] = {
    "": (),
    "positive": ((lambda v: v > 0.0, "should be greater than zero"),),
    "not negative": ((lambda v: v >= 0.0, "should not be negative"),),
    "acute": (
        (lambda v: v > 0.0, "should be greater than zero"),
        (lambda v: v < 90.0, "should be less than 90 degrees"),
    ),
    "acute or zero": (
        (lambda v: v >= 0.0, "should not be negative"),
        (lambda v: v < 90.0, "should be less than 90 degrees"),
    ),
    "teeth": ((lambda v: (v % 1.0 == 0.0) & (v != 0.0), "should be whole numbers other than 0"),),
}
"""What bounds a number (or all in an array), and what is said of one that is out of it."""


def numbers_in(*values: object) -> Iterator[Number]:
    """The numbers that values of a case hold, in their order: in tuples, named ones too, and in dicts."""
    for value in values:
        if isinstance(value, Number):
            yield value
        elif isinstance(value, dict):
            yield from numbers_in(*value.values())
        elif isinstance(value, tuple):
            yield from numbers_in(*value)
