"""Steps along a way, and what lies between them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from icsolve.numbers.arithmetic import RADIAN
from icsolve.numbers.replay import Array

FAR = 0.35
"""The longest move (normalised, radians) that one step may bring."""
BENT = 0.25
"""How far a solution may lie from where the last steps pointed, as a part of the move."""
COUNTED = 60.0
"""The most, in degrees, that a counted angle may turn in one step."""

Step = tuple[float, Array, Array]
"""A place on the way, the unknowns of the groups there, and the counted turns."""


class WayStretch(NamedTuple):
    """Steps without a break: places in order, and the state at each."""

    s: Array
    q: Array
    turns: Array


def goes_on(q: Array, guess: Array, found: Array, pointed: bool) -> bool:
    """Whether a step went on where the last ones pointed."""
    if not q.size:
        return True
    unit = np.ones_like(q)
    unit[2::3] = RADIAN
    move, off = float(np.abs((found - q) * unit).max()), float(np.abs((found - guess) * unit).max())
    return move <= FAR and (not pointed or off <= BENT * move + 1e-6)


def counts(turns: Array, found: Array) -> bool:
    """Whether no counted angle may have missed a turn."""
    return bool(np.all(np.abs(found - turns) < COUNTED))


def stretch_of(steps: Sequence[Step]) -> WayStretch:
    """Steps, in order of their places, as arrays."""
    places, states, turns = zip(*steps, strict=True)
    return WayStretch(np.array(places), np.array(states), np.array(turns))


def cubic(known: Array, values: Array, at: Array) -> Array:
    """Lagrange's polynomial through the four (or as many as there are) nearest places."""
    count = min(4, len(known))
    first = np.clip(np.searchsorted(known, at) - count // 2, 0, len(known) - count)
    nodes = [known[first + n] for n in range(count)]
    total = np.zeros((len(at), values.shape[1]))
    for n in range(count):
        weight = np.ones(len(at))
        for m in range(count):
            if m != n:
                weight *= (at - nodes[m]) / (nodes[n] - nodes[m])
        total += weight[:, None] * values[first + n]
    return total
