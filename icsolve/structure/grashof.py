"""Four-bars and slider-cranks by their lengths: who turns fully, where the input stops, how well it drives.

Formulas: K. J. Waldron, G. L. Kinzel and S. K. Agrawal, Kinematics, Dynamics, and Design of
Machinery, 3rd ed., chapters 1 and 6; each is the law of cosines on the diagonal of the loop.
"""

from __future__ import annotations

import math

from icsolve.tuples import NamedTuple

_EVEN = 1e-9
"""Relative to the sum of the lengths: closer than this, two sums of lengths are equal."""


class AngleRange(NamedTuple):
    """Transmission angle in degrees: in this position, and between what it moves."""

    now: float
    least: float
    greatest: float


class Side(NamedTuple):
    """A four-bar seen from its input: lengths of input, coupler, output and base.

    ``turned`` is the direction of the input less that of the base (from the input's pivot), degrees.
    """

    driver: float
    coupler: float
    output: float
    base: float
    turned: float


class Crank(NamedTuple):
    """A slider-crank: crank and rod lengths; height of the slider's path over the crank's pivot.

    ``turned`` is the direction of the crank less that of the path, degrees.
    """

    radius: float
    rod: float
    offset: float
    turned: float


def grashof_excess(lengths: tuple[float, float, float, float]) -> float:
    """Shortest plus longest less the other two; 0 where they are equal within rounding (change point)."""
    ordered = sorted(lengths)
    excess = ordered[0] + ordered[3] - ordered[1] - ordered[2]
    return 0.0 if abs(excess) <= _EVEN * sum(lengths) else excess


def transmission_of(side: Side) -> AngleRange:
    """Angle between coupler and output: the diagonal opposite to it is longest with the input stretched out.

    cos mu = (b^2 + c^2 - f^2) / 2bc, with f^2 = a^2 + d^2 - 2ad cos(turned).
    """
    a, b, c, d, turned = side
    diagonal = math.sqrt(max(a * a + d * d - 2.0 * a * d * math.cos(math.radians(turned)), 0.0))
    least, greatest = max(abs(d - a), abs(b - c)), min(d + a, b + c)
    return AngleRange(*(_angle_opposite(f, b, c) for f in (diagonal, least, greatest)))


def limits_of(side: Side) -> tuple[float, ...]:
    """Where the input stops, as degrees from the base, the two ends of its range; empty if it turns fully.

    It stops where coupler and output lie in line: stretched out (f = b + c) or folded (f = |b - c|).
    """
    a, b, c, d, turned = side
    far = _angle_opposite(b + c, a, d) if b + c < (a + d) * (1.0 - _EVEN) else None
    near = _angle_opposite(abs(b - c), a, d) if abs(b - c) > abs(a - d) + _EVEN * (a + d) else None
    if far is not None and near is not None:
        return (near, far) if math.sin(math.radians(turned)) >= 0.0 else (-far, -near)
    if far is not None:
        return (-far, far)
    return () if near is None else (near, 360.0 - near)


def transmission_in_slider_crank(crank: Crank) -> AngleRange:
    """Angle between the rod and the normal of the guide: cos mu = |e - r sin(turned)| / l."""
    r, rod, e, turned = crank
    now = abs(e - r * math.sin(math.radians(turned)))
    most, fewest = min(r + abs(e), rod), max(abs(e) - r, 0.0)
    return AngleRange(*(_arccos(height / rod) for height in (now, most, fewest)))


def limits_in_slider_crank(crank: Crank) -> tuple[float, ...]:
    """Where the crank stops, degrees from the guide, the two ends of its range; empty if it turns fully.

    It stops where the rod is square to the guide: r sin(turned) = e - l or e + l.
    """
    r, rod, e, turned = crank
    high = _arcsin((e + rod) / r) if (e + rod) / r < 1.0 - _EVEN else None
    low = _arcsin((e - rod) / r) if (e - rod) / r > _EVEN - 1.0 else None
    if high is not None and low is not None:
        return (low, high) if math.cos(math.radians(turned)) >= 0.0 else (180.0 - high, 180.0 - low)
    if high is not None:
        return (180.0 - high, 360.0 + high)
    return () if low is None else (low, 180.0 - low)


def stroke_of(crank: Crank) -> tuple[float, float] | None:
    """Where the slider turns back, along its path from the foot of the crank's pivot.

    There crank and rod lie in line, folded and stretched out. None if the crank does not turn fully.
    """
    r, rod, e, _ = crank
    if r + abs(e) > rod * (1.0 + _EVEN):
        return None
    folded, stretched = (math.sqrt(max(sum_ * sum_ - e * e, 0.0)) for sum_ in (rod - r, rod + r))
    return folded, stretched


def _angle_opposite(side: float, b: float, c: float) -> float:
    """Angle of a triangle opposite to a side, degrees, by the other two (law of cosines)."""
    return _arccos((b * b + c * c - side * side) / (2.0 * b * c))


def _arccos(value: float) -> float:
    return math.degrees(math.acos(min(max(value, -1.0), 1.0)))


def _arcsin(value: float) -> float:
    return math.degrees(math.asin(min(max(value, -1.0), 1.0)))
