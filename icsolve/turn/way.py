"""The way from the position as written to the rows, and what is to be followed along it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from icsolve.turn.program import Sheet
from icsolve.turn.replay import Array


class Way(NamedTuple):
    """Inputs (by name) as ``base + slope * s``; it starts at ``start`` and has steps of at most ``widest``.

    After a ``period`` (of an angle) all is as before.
    """

    base: dict[str, float]
    slope: dict[str, float]
    start: float
    widest: float
    period: float | None = None

    def inputs(self, sheet: Sheet, s: Array) -> dict[int, Array]:
        """The inputs at places of the way."""
        names = [name for name in self.base if name in sheet.inputs]
        return {sheet.inputs[name]: self.base[name] + self.slope.get(name, 0.0) * s for name in names}


class State(NamedTuple):
    """What is followed at a place: unknowns of the groups one after another, counted turns (degrees),
    and the signs of branches."""

    q: Array
    turns: Array
    signs: dict[str, float]


def written_state(sheet: Sheet) -> State:
    """The state in the position as written."""
    motion = sheet.motion
    assert motion is not None
    ref = motion.mechanism.shape.ref
    q = [
        x
        for group in motion.groups
        for body in group.bodies
        for x in (*map(float, ref[group.bases[body][1]]), 0.0)
    ]
    return State(np.array(q), np.zeros(len(sheet.record.counted)), dict(motion.written))


def flips(at: Array, start: float, touches: Sequence[float]) -> Array:
    """+1 or -1: the sign after the touches between the start and each place."""
    if not len(touches):
        return np.ones_like(at)
    ordered = np.sort(np.array(touches))
    passed = np.searchsorted(ordered, at) - np.searchsorted(ordered, start)
    return np.asarray(1.0 - 2.0 * (passed & 1), dtype=np.float64)
