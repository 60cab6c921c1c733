"""Positions where each row is a scene of its own: with friction, on cam profiles, in families one by one.

There is no record to bound over whole cells: the range is searched at many places, each change between two of
them is closed in scene by scene, and a note says so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np

from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers.replay import Array
from icsolve.statics.power import is_unknown
from icsolve.sweep.request import Columns
from icsolve.sweep.sweeping import sweep
from icsolve.sweep.table import CODE, Codes
from icsolve.tuples import NamedTuple

PLACES = 360
"""Places at which the range is searched."""
CLOSED = 1e-12
"""Places are closed in to this part of the range."""
FLAT = 1e-7
"""A peak, to which an answer is flat, to this."""
GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
MOST_SCENES = 1200
"""Scenes that are solved before a search ends with what it has."""
MANY = "so much changes in this range that not all of it was closed in on: take a shorter one."
SAID = (
    "each position is a scene of its own: the range was searched at {count} places, and two positions "
    "between two of them may be missed."
)
HOLDS = (
    "with friction and no motion {load} holds over a range, not at one value, so no position is looked for. "
    "Give a `motion`, or leave out the friction."
)
BESIDE, GROWN = 1000.0, 3.0
"""What runs off to infinity grows as one over the distance: ``BESIDE`` widths away, or so much farther that
it is finite, it is more than ``GROWN`` times as large as ten times as far away."""
LOCKED = [CODE[word] for word in (Status.DEAD_CENTRE, Status.NO_VALUE, Status.JAM)]


class FoundPosition(NamedTuple):
    """A position that was found.

    Attributes
    ----------
    at : the varied number there [case units, degrees]
    kind : ``dead``, ``limit``, ``change-point``, ``max`` or ``value``
    answer : the unknown load [case units]; None where it has none
    error : bound of the absolute error of ``at``
    """

    at: float
    kind: str
    answer: float | None
    error: float = 0.0


class Query(NamedTuple):
    """What to look for.

    Attributes
    ----------
    kind : ``dead``, ``max`` or ``value``
    load : name of an unknown load; '' the first
    value : that it is to have [case units]
    """

    kind: str
    load: str = ""
    value: float = 0.0


class FoundPositions(list[FoundPosition]):
    """Positions in order; ``notes`` say what was searched where nothing shows that none is missing."""

    notes: tuple[str, ...] = ()


class _EnoughError(Exception):
    """A search has solved so many scenes that it ends."""


class Scenes:
    """Positions along one number, scene by scene."""

    def __init__(self, case: Case, columns: Columns, name: str, query: Query) -> None:
        self.case, self.columns, self.name, self.query = case, columns, name, query
        self.load = query.load or next(load.name for load in case.loads if is_unknown(load))
        values = columns.arrays[name]
        self.places = np.linspace(values.min(), values.max(), PLACES + 1)
        self.scenes = 0
        self.width = CLOSED * float(np.ptp(values))

    def spots(self) -> FoundPositions:
        """All positions that are found, in order."""
        found, codes = self._swept(self.places)
        if (codes == CODE["holds"]).any():
            raise SceneError(Status.UNSUPPORTED, HOLDS.format(load=self.load))
        finder = {"value": self._values, "max": self._peaks, "dead": self._dead}[self.query.kind]
        spots = FoundPositions()
        spots.notes = (SAID.format(count=PLACES),)
        try:
            for spot in finder(found, codes):
                spots.append(spot)
        except _EnoughError:
            spots.notes += (MANY,)
        spots.sort(key=lambda spot: spot.at)
        return spots

    def _swept(self, at: Array) -> tuple[Array, Codes]:
        """The answer and the status (its code) at places."""
        self.scenes += len(at)
        if self.scenes > MOST_SCENES:
            raise _EnoughError
        rows = {own: np.full(len(at), float(a[0])) for own, a in self.columns.arrays.items()}
        rows[self.name] = at
        vary = {own: rows[own] for own in self.columns.paths}
        found = sweep(self.case, vary, drive={own: rows[own] for own in self.columns.links})
        return found.answers.get(self.load, np.full(len(at), np.nan)), found.codes

    def _answer(self, at: float) -> float:
        return float(self._swept(np.array([at]))[0][0])

    # --- kinds ------------------------------------------------------------------------------------

    def _values(self, found: Array, codes: Codes) -> Iterator[FoundPosition]:
        """Where the answer has the value, and its changes of sign less the value but through infinity."""
        miss = found - self.query.value
        for k in np.flatnonzero(miss == 0.0).tolist():
            yield FoundPosition(float(self.places[k]), "value", float(found[k]), self.width)
        for k in np.flatnonzero(miss[:-1] * miss[1:] < 0.0).tolist():
            at, wide = self._closed(lambda s: self._answer(s) - self.query.value, k)
            answer = self._answer(at)
            if abs(answer - self.query.value) <= min(abs(miss[k]), abs(miss[k + 1])) + abs(self.width):
                yield FoundPosition(at, "value", answer, wide)

    def _dead(self, found: Array, codes: Codes) -> Iterator[FoundPosition]:
        """Changes of sign through infinity, and where the mechanism begins to lock or reaches its limit."""
        for k in np.flatnonzero(found[:-1] * found[1:] < 0.0).tolist():
            at, wide = self._closed(self._answer, k)
            if self._runs_off(at, float(self.places[k + 1] - self.places[k])):
                yield FoundPosition(at, "dead", None, wide)
        locked, apart = np.isin(codes, LOCKED), codes == CODE[Status.CANNOT_ASSEMBLE]
        for kind, state in (("dead", locked), ("limit", apart)):
            wanted = LOCKED if kind == "dead" else [CODE[Status.CANNOT_ASSEMBLE]]
            for k in np.flatnonzero(state[:-1] != state[1:]).tolist():
                at, wide = self._ends(wanted, bool(state[k]), k)
                answer = self._answer(at) if kind == "limit" else math.nan
                yield FoundPosition(at, kind, None if math.isnan(answer) else answer, wide)

    def _runs_off(self, at: float, step: float) -> bool:
        """Whether the answer grows to infinity at a change of sign: a jump stays as it is, also where
        friction jams so near to it that there is no answer."""
        away = BESIDE * self.width
        near = self._size(at, away)
        while True:
            away *= 10.0
            far = self._size(at, away)
            if not math.isnan(near) or away > step:
                return not near <= GROWN * far
            near = far

    def _size(self, at: float, away: float) -> float:
        """The larger answer of both sides of a place; nan where one has none."""
        return float(np.abs(self._swept(np.array([at - away, at + away]))[0]).max())

    def _peaks(self, found: Array, codes: Codes) -> Iterator[FoundPosition]:
        """Where the size of the answer is larger than on both sides, by golden sections."""
        size = np.abs(found)
        for k in range(len(size)):
            around = size[max(k - 1, 0) : k + 2]
            inside = 0 < k < len(size) - 1 and np.isfinite(around).all()
            if inside and size[k] > around[0] and size[k] >= around[-1]:
                low, high = float(self.places[k - 1]), float(self.places[k + 1])
                while high - low > FLAT * self.width / CLOSED:
                    one, two = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
                    if abs(self._answer(one)) < abs(self._answer(two)):
                        low = one
                    else:
                        high = two
                at = (low + high) / 2.0
                answer = self._answer(at)
                if abs(answer) <= 10.0 * size[k] and answer * found[k] > 0.0:
                    yield FoundPosition(at, "max", answer, high - low)

    # --- closing in -------------------------------------------------------------------------------

    def _closed(self, function: Callable[[float], float], k: int) -> tuple[float, float]:
        """A change of sign between two places, halved in, and how wide it is open still."""
        low, high = float(self.places[k]), float(self.places[k + 1])
        first = function(low)
        while high - low > self.width:
            middle = (low + high) / 2.0
            here = function(middle)
            if here == 0.0:
                return middle, self.width
            low, high = (middle, high) if (here > 0.0) == (first > 0.0) else (low, middle)
        return (low + high) / 2.0, high - low

    def _ends(self, wanted: list[int], before: bool, k: int) -> tuple[float, float]:
        """Where a status begins or ends between two places: the last that has none of it."""
        low, high = float(self.places[k]), float(self.places[k + 1])
        while high - low > self.width:
            middle = (low + high) / 2.0
            there = bool(np.isin(self._swept(np.array([middle]))[1], wanted)[0])
            low, high = (middle, high) if there == before else (low, middle)
        return (high if before else low), high - low
