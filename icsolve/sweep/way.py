"""The way from the position as written to the rows, and what is to be followed along it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from icsolve.numbers.replay import Array
from icsolve.sweep.program import Sheet


class Way(NamedTuple):
    """A way through the inputs: each is ``base + slope * s``, where s is a value of the main one.

    Attributes
    ----------
    base, slope : by name [units of the input; of an angle degrees]
    start : s in the position as written, or where another way ended
    widest : the longest step of s
    period : of an angle 360: after it all is as before; None else
    """

    base: dict[str, float]
    slope: dict[str, float]
    start: float
    widest: float
    period: float | None = None

    def inputs(self, sheet: Sheet, s: Array) -> dict[int, Array]:
        """The inputs at places of the way.

        Parameters
        ----------
        s : (places,)

        Returns
        -------
        dict[int, Array]
            By node, (places,).
        """
        names = [name for name in self.base if name in sheet.inputs]
        return {sheet.inputs[name]: self.base[name] + self.slope.get(name, 0.0) * s for name in names}


class State(NamedTuple):
    """What is followed at a place.

    Attributes
    ----------
    q : unknowns of the groups one after another, (3 bodies,) [frame, frame, degrees]
    turns : counted angles with their whole turns, (counted,) [degrees]
    signs : by branch, 1 or -1
    """

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


class Touches(NamedTuple):
    """The places of a way at which a branch changes its sign, by the branch's name, and how far the motion
    leads from the start to both sides."""

    places: Mapping[str, Sequence[float]]
    limits: tuple[float, float] = (-math.inf, math.inf)

    def flips(self, name: str, at: Array, way: Way) -> Array:
        """+1 or -1: the sign of a branch after the touches between the start and each place.

        Beyond a limit it is as a whole turn before, where the motion leads there from the other side.

        Parameters
        ----------
        name : of the branch
        at : (places,) on the way
        way : where it starts, and its period

        Returns
        -------
        Array
            (places,), factors on the sign at the start.
        """
        places = np.sort(np.array(self.places.get(name, ())))
        if not len(places):
            return np.ones_like(at)
        low, high = self.limits
        if way.period is not None and not (math.isinf(low) and math.isinf(high)):
            at, places = self._within(at, way.period), self._copies(places, way.period)
        passed = np.searchsorted(places, at) - np.searchsorted(places, way.start)
        return np.asarray(1.0 - 2.0 * (passed & 1), dtype=np.float64)

    def _within(self, at: Array, period: float) -> Array:
        """The places, those beyond a limit so many whole turns away that the motion leads there."""
        low, high = self.limits
        above, below = np.maximum(at - high, 0.0), np.maximum(low - at, 0.0)
        back = at - period * (np.ceil(above / period) - np.ceil(below / period))
        return np.where((back >= low) & (back <= high), back, at)

    def _copies(self, places: Array, period: float) -> Array:
        """The touches between the limits, whole turns away too."""
        low, high = self.limits
        reach = int(max(abs(end) for end in (low, high, *places) if math.isfinite(end)) / period) + 2
        every = (places[:, None] + period * np.arange(-reach, reach + 1)).ravel()
        kept = np.sort(every[(every > low) & (every < high)])
        return kept[np.diff(kept, prepend=-math.inf) > SAME * period]


SAME = 1e-6
"""Touches that are nearer to each other, as a part of a turn, are one."""
