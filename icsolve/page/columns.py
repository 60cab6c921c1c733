"""Columns of numbers, and JSON, as they stand in a page."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from typing import Any

import numpy as np

Array = np.ndarray

FINE = {"px": 10, "deg": 100, "told": 100_000, "far": 1e-5}
"""Steps a picture unit, or a degree: a tenth of a unit, a hundredth of a degree; of a point whose place is
read as a number, far finer; of a direction to infinity, whose numbers are large."""
FAR = 1e5
"""Numbers beyond this are written plainly, to five significant digits."""
DIGITS = 12
"""Significant digits of an answer: those that anyone is shown, and more."""


def compact(values: Array, fine: float) -> dict[str, Any]:
    """A column in steps of 1 / ``fine``, as differences of differences, which are small where a motion is
    smooth; ``n`` are the rows in which it is not a number."""
    known = np.isfinite(values)
    if known.any() and float(np.abs(values[known]).max()) * min(fine, 1.0) < FAR:
        rows = np.arange(len(values))
        whole = np.rint(np.interp(rows, rows[known], values[known]) * fine).astype(np.int64)
        none = {} if known.all() else {"n": np.flatnonzero(~known).tolist()}
        return {"s": fine, "d": np.diff(whole, 2, prepend=(0, 0)).tolist(), **none}
    return {"v": [_rounded(v, 5) for v in values.tolist()]}


def exact(values: Iterable[float], digits: int = DIGITS) -> dict[str, Any]:
    """A column of numbers that are read: all digits that are shown."""
    return {"v": [_rounded(v, digits) for v in values]}


def _rounded(value: float, digits: int) -> float | int | None:
    if not math.isfinite(value):
        return None
    value = float(format(value, f".{digits}g")) + 0.0
    return int(value) if value == int(value) and abs(value) < 1e15 else value


def moves(values: Array, fine: float) -> bool:
    """Whether a column changes as the picture shows it."""
    return bool(np.ptp(values) * fine > 0.5) if np.isfinite(values).all() else True


_UNSAFE = str.maketrans(
    {"<": "\\u003c", ">": "\\u003e", "&": "\\u0026", "\u2028": "\\u2028", "\u2029": "\\u2029"}
)


def script_json(value: object) -> str:
    """JSON that can stand in a script element whatever its texts say."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return text.translate(_UNSAFE).encode("utf-8", "replace").decode("utf-8")
