"""Wrong answers that need nothing but the right one: sign, powers of ten, unit factors, half, double."""

from __future__ import annotations

from collections.abc import Iterator

from icsolve.grade.malrules.messages import Wrong

FACTORS = {
    "in and mm": 25.4,
    "ft and in": 12.0,
    "lb and N": 4.4482216152605,
    "kg and N": 9.80665,
    "ft and m": 0.3048,
    "degrees and radians": 57.29577951308232,
}
"""Unit factors that are forgotten or applied twice."""
_RATE = {"rev/min and rad/s": 9.549296585513721, "revolutions and radians": 6.283185307179586}


def plain_wrongs(value: float, rate: bool = False) -> Iterator[Wrong]:
    """The wrong answers about a right ``value``; of an angular speed (``rate``) with those of revolutions."""
    yield Wrong("sign", -value)
    for power in (*range(-6, 0), *range(1, 7)):
        yield Wrong("power-of-ten", value * 10.0**power)
        yield Wrong("power-of-ten", -value * 10.0**power)
    for name, factor in (FACTORS | (_RATE if rate else {})).items():
        yield Wrong("unit-factor", value * factor, name)
        yield Wrong("unit-factor", value / factor, name)
    yield Wrong("half", value / 2.0)
    yield Wrong("double", value * 2.0)
