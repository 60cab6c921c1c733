"""The steps by which a way is followed (predictor and corrector), and states between them by a polynomial.

A step is taken where Newton's method, from where the last steps point, comes to a state near to that: it then
has not gone over to another assembly mode.
"""

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
    """Steps without a break.

    Attributes
    ----------
    s : (steps,), places in order
    q : (steps, unknowns), the groups' states there [frame, frame, degrees for each body]
    turns : (steps, counted) [degrees]
    """

    s: Array
    q: Array
    turns: Array


def goes_on(q: Array, guess: Array, found: Array, pointed: bool) -> bool:
    """Whether a step went on where the last ones pointed.

    Parameters
    ----------
    q, guess, found : (unknowns,), the state before, that to which the last steps point, and that which was
        found [frame, frame, degrees for each body]
    pointed : whether there were steps to point; else only the length of the move is judged
    """
    if not q.size:
        return True
    unit = np.ones_like(q)
    unit[2::3] = RADIAN
    move, off = float(np.abs((found - q) * unit).max()), float(np.abs((found - guess) * unit).max())
    return move <= FAR and (not pointed or off <= BENT * move + 1e-6)


def counts(turns: Array, found: Array) -> bool:
    """Whether no counted angle may have missed a turn in a step: each changed by less than 60 degrees.

    ``turns`` and ``found``: (counted,) [degrees], before and after.
    """
    return bool(np.all(np.abs(found - turns) < COUNTED))


def stretch_of(steps: Sequence[Step]) -> WayStretch:
    """Steps, in order of their places, as arrays."""
    places, states, turns = zip(*steps, strict=True)
    return WayStretch(np.array(places), np.array(states), np.array(turns))


def cubic(known: Array, values: Array, at: Array) -> Array:
    """Lagrange's polynomial through the four (or as many as there are) nearest places.

    Parameters
    ----------
    known : (steps,), increasing
    values : (steps, columns)
    at : (places,); beyond the ends it extrapolates

    Returns
    -------
    Array
        (places, columns).
    """
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
