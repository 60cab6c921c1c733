"""How far an answer may lie from the right one, and how that is said."""

from __future__ import annotations

import math

from icsolve.case import Tolerance

SLACK = 1e-9
"""Relative room, so that 101 passes for 100 within 1 %."""
_FIGURES = 1.02
"""A unit in the last figure is taken this much wider, as graders that count figures do."""


DEFAULT = Tolerance(relative=0.01)


def half_width(tolerance: Tolerance, value: float, absolute: float, zero: float) -> float:
    """Half the width of the accepted band about ``value``, in its unit.

    ``absolute`` is the tolerance's own width in that unit; ``zero`` the width for a true zero, which
    has no relative band.
    """
    if value == 0.0:
        return max(zero, absolute)
    size = abs(value)
    unit_of_figure = (
        10.0 ** (math.floor(math.log10(size)) - tolerance.figures + 1) if tolerance.figures else 0.0
    )
    return max(tolerance.relative * size, absolute, 0.5 * unit_of_figure * _FIGURES) + SLACK * size


def in_words(tolerance: Tolerance) -> str:
    """What a student may know before the answer: ``within 1 % of the right value``."""
    parts = []
    if tolerance.relative:
        parts.append(f"within {100.0 * tolerance.relative:.10g} % of the right value")
    if tolerance.figures:
        parts.append(f"right to {tolerance.figures} significant figures")
    if tolerance.absolute:
        parts.append(f"within {tolerance.absolute:.10g} {tolerance.unit}".rstrip() + " of the right value")
    if tolerance.drawing:
        parts.append(f"within what a drawing accurate to {tolerance.drawing} allows")
    return " or ".join(parts)


def range_in_words(value: float, half: float, unit: str) -> str:
    """The accepted band: ``from 408.6 to 416.8 N``; of magnitudes, as signs are judged apart."""
    low, high = max(abs(value) - half, 0.0), abs(value) + half
    return f"from {_rounded(low, half)} to {_rounded(high, half)} {unit}".rstrip()


def _rounded(number: float, half: float) -> str:
    """Three figures of the band's own width, no more."""
    if half <= 0.0 or not math.isfinite(half):
        return f"{number:.10g}"
    places = 1 - math.floor(math.log10(half))
    rounded = round(number, places)
    return f"{rounded:.{min(places, 12)}f}" if 0 < places <= 12 and abs(rounded) < 1e12 else f"{rounded:.10g}"
