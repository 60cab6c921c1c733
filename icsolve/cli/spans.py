"""Ranges of numbers as they stand on the command line: ``PATH=FROM:TO:STEP``, or ``PATH=VALUE,VALUE,...``."""

from __future__ import annotations

import math
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Values = npt.NDArray[np.float64]

MOST_ROWS = 20_000_000
"""More rows than this are refused: their arrays would not fit a common machine."""
EXACT = 2**53
"""Whole numbers below this are exact as doubles."""
LONGEST = 60
"""Decimals of more places are no range of a mechanism."""


class SweepSpan(click.ParamType):  # type: ignore[type-arg]
    """A path and its values."""

    name = "PATH=FROM:TO:STEP"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str, Values]:
        """The path and its values."""
        path, equals, span = str(value).partition("=")
        numbers = _numbers(span)
        if not (path.strip() and equals) or numbers is None:
            self.fail(f"{value!r} is not PATH=FROM:TO:STEP, e.g. angles.AB=0:360:1", param, ctx)
        if ":" not in span:
            return path.strip(), _array([float(number) for number in numbers])
        first, last, step = numbers
        if step == 0 or (last - first) / step < 0:
            turned = f"; write {path.strip()}={_reversed(span)}" if step else ""
            message = f"{value!r} is an empty range: the step should lead from the first to the last{turned}"
            self.fail(message, param, ctx)
        count = int((last - first) // step) + 1
        if count > MOST_ROWS:
            self.fail(f"{value!r} has {count} values; at most {MOST_ROWS} rows fit", param, ctx)
        return path.strip(), progression(first, step, count)


def _reversed(span: str) -> str:
    """A range with its step the other way."""
    first, last, step = (word.strip() for word in span.split(":"))
    return f"{first}:{last}:{step[1:] if step[0] in '+-' else '-' + step}"


def _numbers(span: str) -> list[Fraction] | None:
    """The numbers of a span, exact; None where it is none."""
    words = span.split(":" if ":" in span else ",")
    try:
        numbers = [Decimal(word.strip()) for word in words]
    except InvalidOperation:
        return None
    if not all(number.is_finite() and abs(number.adjusted()) < LONGEST for number in numbers):
        return None
    return [Fraction(number) for number in numbers] if ":" not in span or len(numbers) == 3 else None


def _array(values: list[float]) -> Values:
    import numpy as np

    return np.array(values, dtype=np.float64)


def progression(first: Fraction, step: Fraction, count: int) -> Values:
    """``first + k step`` as written in decimals, each rounded once: 0.3, and not 0.1 + 0.1 + 0.1."""
    import numpy as np

    under = math.lcm(first.denominator, step.denominator)
    start, by = int(first * under), int(step * under)
    if max(abs(start), abs(start + by * count), under) >= EXACT:
        return _array([float(first + k * step) for k in range(count)])
    whole = start + by * np.arange(count, dtype=np.int64)
    return np.asarray(whole / float(under), dtype=np.float64)
