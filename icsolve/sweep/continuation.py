"""A straight line through the inputs, followed from the position as written by predictor and corrector.

A step is taken where Newton's method, from where the last steps point, comes to a state near to that: it then
has not gone over to another assembly mode. States between steps follow by a polynomial (E. L. Allgower and
K. Georg, Introduction to Numerical Continuation Methods, 2003, ch. 2).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from icsolve.numbers import RADIAN
from icsolve.numbers.replay import Array, Mask
from icsolve.sweep.program import CompiledSweep
from icsolve.tuples import NamedTuple

FAR = 0.35
"""The longest move (normalised, radians) that one step may bring."""
BENT = 0.25
"""How far a solution may lie from where the last steps pointed, as a part of the move."""
COUNTED = 60.0
"""The most, in degrees, that a counted angle may turn in one step."""

Step = tuple[float, Array, Array]
"""A place on the line, the unknowns of the groups there, and the counted turns."""
SAME = 1e-6
"""Touches that are nearer to each other, as a part of a turn, are one."""


class InputLine(NamedTuple):
    """A straight line through the inputs: each is ``base + slope * s``, where s is a value of the main one.

    Attributes
    ----------
    base, slope : by name [units of the input; of an angle degrees]
    start : s in the position as written, or where another line ended
    widest : the longest step of s
    period : of an angle 360: after it all is as before; None else
    """

    base: dict[str, float]
    slope: dict[str, float]
    start: float
    widest: float
    period: float | None = None

    def inputs(self, compiled: CompiledSweep, s: Array) -> dict[int, Array]:
        """The inputs at places of the line.

        Parameters
        ----------
        s : (places,)

        Returns
        -------
        dict[int, Array]
            By node, (places,).
        """
        names = [name for name in self.base if name in compiled.inputs]
        return {compiled.inputs[name]: self.base[name] + self.slope.get(name, 0.0) * s for name in names}


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


def written_state(compiled: CompiledSweep) -> State:
    """The state in the position as written."""
    motion = compiled.motion
    assert motion is not None
    still = motion.mechanism.shape.still
    q = [x for group in motion.groups for body in group.bodies for x in (*still[group.bases[body][1]], 0.0)]
    turns = [guess.value for guess, _ in compiled.record.counted.values()]
    return State(np.array(q), np.array(turns, dtype=float), dict(motion.written))


class ChangePoints(NamedTuple):
    """The places of a line at which a branch changes its sign, by the branch's name, and how far the motion
    leads from the start to both sides."""

    places: Mapping[str, Sequence[float]]
    limits: tuple[float, float] = (-math.inf, math.inf)

    def flips(self, name: str, at: Array, line: InputLine) -> Array:
        """+1 or -1: the sign of a branch after the touches between the start and each place.

        Beyond a limit it is as a whole turn before, where the motion leads there from the other side.

        Parameters
        ----------
        name : of the branch
        at : (places,) on the line
        line : where it starts, and its period

        Returns
        -------
        Array
            (places,), factors on the sign at the start.
        """
        places = np.sort(np.array(self.places.get(name, ())))
        if not len(places):
            return np.ones_like(at)
        if line.period is not None and any(map(math.isfinite, self.limits)):
            at, places = self._followed(at, line), self._copies(places, line.period)
        passed = np.searchsorted(places, at) - np.searchsorted(places, line.start)
        return np.asarray(1.0 - 2.0 * (passed & 1), dtype=np.float64)

    def reached(self, at: Array, line: InputLine) -> Mask:
        """To which places, (places,), the motion leads, also by turning the other way round."""
        return self._inside(self._within(at, line))

    def _inside(self, at: Array) -> Mask:
        low, high = self.limits
        return (at >= low) & (at <= high)

    def _followed(self, at: Array, line: InputLine) -> Array:
        """Each place so many whole turns away that the motion leads there; where none does, the nearest to
        the start: beyond a limit on both sides a branch goes on from the sign as written."""
        period = line.period or math.inf
        back = self._within(at, line)
        nearest = line.start + np.remainder(at - line.start + period / 2.0, period) - period / 2.0
        return np.where(self._inside(back), back, nearest)

    def _within(self, at: Array, line: InputLine) -> Array:
        """The places, those beyond a limit so many whole turns away that they are not beyond that limit."""
        if line.period is None:
            return at
        low, high = self.limits
        above, below = np.maximum(at - high, 0.0), np.maximum(low - at, 0.0)
        return at - line.period * (np.ceil(above / line.period) - np.ceil(below / line.period))

    def _copies(self, places: Array, period: float) -> Array:
        """The touches, whole turns away too."""
        ends = [end for end in self.limits if math.isfinite(end)]
        reach = int(max(abs(end) for end in (*ends, *places)) / period) + 2
        every = np.sort((places[:, None] + period * np.arange(-reach, reach + 1)).ravel())
        return every[np.diff(every, prepend=-math.inf) > SAME * period]


class PathSegment(NamedTuple):
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

    def at(self, places: Array) -> tuple[Array, Array]:
        """States (places, unknowns) and turns (places, counted) at places of the line, (places,): Lagrange's
        polynomial through the four (or as many as there are) nearest steps, beyond the ends too.
        """
        count = min(4, len(self.s))
        first = np.maximum(np.minimum(self.s.searchsorted(places) - count // 2, len(self.s) - count), 0)
        each = np.arange(count)
        nearest = first + each[:, None]
        nodes = self.s[nearest]
        off, apart = np.repeat((places - nodes)[None], count, axis=0), nodes[:, None] - nodes
        off[each, each] = apart[each, each] = 1.0
        weights = np.multiply.reduce(off / apart, axis=1)[:, :, None]
        q, turns = (
            np.asarray(sum(weight * values[n] for weight, n in zip(weights, nearest, strict=True)))
            for values in (self.q, self.turns)
        )
        return q, turns


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


def segment_of(steps: Sequence[Step]) -> PathSegment:
    """Steps, in order of their places, as arrays."""
    places, states, turns = zip(*steps, strict=True)
    return PathSegment(np.array(places), np.array(states), np.array(turns))
