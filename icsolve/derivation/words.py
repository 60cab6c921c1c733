"""An answer in words: its sense, and the range in which friction lets it be."""

from __future__ import annotations

import math
from collections.abc import Callable

from icsolve.answer import Found

SENSES = {"ccw": "counterclockwise", "cw": "clockwise", "pull": "pulling", "push": "pushing"}


def range_words(found: Found, show: Callable[[float], str]) -> str:
    """``holds still from 3 to 4 N``; ``show`` writes a number."""
    least, most = found.holds or (math.nan, math.nan)
    if math.isfinite(least) and math.isfinite(most):
        reach = f"from {show(least)} to {show(most)} {found.unit}"
    elif math.isfinite(least):
        reach = f"from {show(least)} {found.unit} up"
    else:
        reach = f"up to {show(most)} {found.unit}" if math.isfinite(most) else "at any value"
    return f"holds still {reach}" + (", self-locking" if found.self_locking else "")


def sense_words(sense: str, show: Callable[[float], str]) -> str:
    """``ccw`` spelt out, ``at 339.778 deg`` with the digits of ``show``."""
    if sense.startswith("at ") and sense.endswith(" deg"):
        return f"at {show(float(sense[3:-4]))}°"
    return SENSES.get(sense, sense)
