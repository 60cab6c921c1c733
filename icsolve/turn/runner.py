"""The rows of a sweep, block by block: the outputs as arrays, and which rows need a second look.

A row is looked at again where something that is divided by, or whose root is taken, is small beside what
it is in the other rows, or where the answer nearly vanishes. The others are what one scene would give.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from icsolve.arithmetic import Scalar
from icsolve.turn.program import Sheet
from icsolve.turn.record import Op, Traced
from icsolve.turn.replay import BLOCK, Array, Code

SMALL = 1e-7
"""Below this fraction of its size elsewhere a divisor or radicand makes its row doubtful."""
FAINT = 1e-9
"""Below this fraction of its size elsewhere an answer may be zero."""
STEEP = 2.0
"""A radicand that may vanish between rows is smaller than so many of its steps from row to row."""

Key = tuple[str, str]
Rows = npt.NDArray[np.int64]


class Found(NamedTuple):
    """Arrays by output; rows to look at again; whether a branch may change between rows."""

    values: dict[Key, Array]
    doubtful: Rows
    touching: bool


class Runner:
    """A sheet compiled for its outputs; may run in several threads, each with its own."""

    def __init__(self, sheet: Sheet) -> None:
        self.sheet = sheet
        record = sheet.record
        flat = [(key, part, value) for key, values in sheet.outputs.items() for part, value in enumerate(values)]
        self.still = [(key, part, float(v)) for key, part, v in flat if not varies(v)]
        self.moving = [(key, part, v.index) for key, part, v in flat if varies(v)]
        wanted = [index for _, _, index in self.moving]
        alive = Code(record, wanted).order
        self.roots = [record.roots[k] for k in alive if k in record.roots]
        self.divisors = _divisors(record.nodes, alive)
        self.faint = [n for n, (key, _, _) in enumerate(self.moving) if key[0] == "answers"]
        self.code = Code(record, [*wanted, *(root.radicand for root in self.roots), *self.divisors])
        self.typical = np.array([abs(record.nodes[k].value) for k in self.divisors])
        self.deep = np.array([record.nodes[root.radicand].value for root in self.roots])

    def empty(self, rows: int) -> dict[Key, Array]:
        """Arrays for the outputs; those that are the same in every row are filled."""
        values = {
            key: np.empty(rows) if len(parts) == 1 else np.empty((rows, len(parts)))
            for key, parts in self.sheet.outputs.items()
        }
        for key, part, value in self.still:
            column(values[key], part)[:] = value
        return values

    def run(self, given: Mapping[int, Array], rows: int) -> Found:
        """All rows; ``given`` has an array or one number for every input."""
        values, doubtful, touching = self.empty(rows), [], False
        last: list[Array] = []
        for start in range(0, rows, BLOCK):
            stop = min(start + BLOCK, rows)
            here = {k: v[start:stop] if v.ndim else v for k, v in given.items()}
            found = self.code.run(here, stop - start)
            for (key, part, _), array in zip(self.moving, found, strict=False):
                column(values[key], part)[start:stop] = array
            again, steep, last = self._watch(found, last)
            touching = touching or steep
            if again.size:
                doubtful.append(again + start)
        return Found(values, np.concatenate(doubtful) if doubtful else np.empty(0, np.int64), touching)

    def _watch(self, found: list[Array], last: list[Array]) -> tuple[Rows, bool, list[Array]]:
        """Rows of a block to look at again; whether a radicand may vanish between its rows."""
        bad: list[Rows] = []
        steep = False
        count, roots = len(self.moving), len(self.roots)
        with np.errstate(all="ignore"):
            for n, radicand in enumerate(found[count : count + roots]):
                low, high = float(np.minimum.reduce(radicand)), float(np.maximum.reduce(radicand))
                high = max(high, float(self.deep[n]))
                if not low > SMALL * high:
                    bad.append(np.flatnonzero(~(radicand > SMALL * high)))
                step = float(np.abs(np.diff(radicand, prepend=last[n] if last else radicand[:1])).max())
                steep = steep or low <= STEEP * step
            for n, divisor in enumerate(found[count + roots :]):
                size = np.abs(divisor)
                typical = max(float(self.typical[n]), float(np.maximum.reduce(size)))
                if not float(np.minimum.reduce(size)) > SMALL * typical:
                    bad.append(np.flatnonzero(~(size > SMALL * typical)))
            for n in self.faint:
                size = np.abs(found[n])
                limit = FAINT * float(np.maximum.reduce(size))
                if not float(np.minimum.reduce(size)) > limit:
                    bad.append(np.flatnonzero(~(size > limit)))
        ends = [radicand[-1:].copy() for radicand in found[count : count + roots]]
        return np.unique(np.concatenate(bad)) if bad else np.empty(0, np.int64), steep, ends


def varies(value: Scalar) -> bool:
    """Whether an output differs from row to row."""
    return isinstance(value, Traced) and value.row


def column(array: Array, part: int) -> Array:
    """One part of an output's array."""
    return array if array.ndim == 1 else array[:, part]


def _divisors(nodes, alive: list[int]) -> list[int]:  # type: ignore[no-untyped-def]
    """What is divided by and varies."""
    found = {nodes[k].b for k in alive if nodes[k].op == Op.DIV and nodes[nodes[k].b].row}
    return sorted(found)
