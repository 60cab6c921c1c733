"""A number as the case gives it: its double, its decimals and its unit."""

from typing import NamedTuple


class Number(NamedTuple):
    """A number that the case gives.

    ``value`` is the nearest double in case units, ``half`` half a unit of the last decimal
    that was written (case units), ``path`` its place (``lengths.AB``, ``loads.P.angle``),
    ``digits`` the numeral as written and ``factor`` case units per written unit.
    """

    value: float
    half: float
    path: str
    digits: str
    factor: float = 1.0
