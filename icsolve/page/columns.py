"""Numbers of all positions in few bytes: whole numbers as differences where the picture needs no more, plain
numbers else. The script of the page reads both."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from icsolve.page.poses import Array

FINE = {"px": 10, "deg": 100}
"""Steps a picture unit, or a degree: a tenth of a unit, a hundredth of a degree."""
FAR = 1e5
"""Numbers beyond this are written plainly, to five significant digits."""
DIGITS = 12
"""Significant digits of an answer: those that anyone is shown, and more."""


def compact(values: Array, fine: int) -> dict[str, Any]:
    """A column in steps of 1 / ``fine``; what is not a number is null."""
    if np.isfinite(values).all() and float(np.abs(values).max(initial=0.0)) < FAR:
        whole = np.rint(values * fine).astype(np.int64)
        return {"s": fine, "d": [int(whole[0]), *map(int, np.diff(whole))]}
    return {"v": [_rounded(v, 5) for v in values.tolist()]}


def exact(values: Iterable[float]) -> dict[str, Any]:
    """A column of numbers that are read: all digits that are shown."""
    return {"v": [_rounded(v, DIGITS) for v in values]}


def _rounded(value: float, digits: int) -> float | int | None:
    if not math.isfinite(value):
        return None
    value = float(format(value, f".{digits}g")) + 0.0
    return int(value) if value == int(value) and abs(value) < 1e15 else value


def moves(values: Array, fine: int) -> bool:
    """Whether a column changes as the picture shows it."""
    return bool(np.ptp(values) * fine > 0.5) if np.isfinite(values).all() else True


_UNSAFE = {"<": "\\u003c", ">": "\\u003e", "&": "\\u0026", "\u2028": "\\u2028", "\u2029": "\\u2029"}


def script_json(value: object) -> str:
    """JSON that can stand in a script element whatever its texts say."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    text = "".join(_UNSAFE.get(c, c) for c in text)
    return text.encode("utf-8", "replace").decode("utf-8")
