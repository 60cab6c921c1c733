"""Positions where each row is a scene of its own: with friction, on cam profiles, in families one by one.

There is no record to bound over whole cells: the range is searched at many places, each change between two of
them is closed in scene by scene, and a note says so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Iterator

import numpy as np
import numpy.typing as npt

from icsolve.assembly.order import order_of
from icsolve.assembly.steps import PointGroup
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers.replay import Array
from icsolve.statics.power import is_unknown
from icsolve.sweep.program import wanted_points
from icsolve.sweep.request import Columns
from icsolve.sweep.sweeping import sweep
from icsolve.sweep.table import CODE, Codes
from icsolve.tuples import NamedTuple

PLACES = 360
"""Places at which the range is searched."""
SEARCHED, APART = 48, 4
"""The same where points of the figure are searched for at each: every so-manyth first, and those between only
beside one that assembles."""
FOUND, MISSED = 4, 24
"""Such a scene counts for so many, and for so many more where nothing is found."""
CLOSED = 1e-12
"""Places are closed in to this part of the range."""
FLAT = 1e-7
"""A peak, to which an answer is flat, to this."""
SECTIONS = 4
"""A search closes in by this factor in one sweep, and"""
TOGETHER = 8
"""so many searches share their sweeps: each sweep follows the figure from the case's own position anew, which
may take as long as many scenes."""
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
FADED = 0.01
"""What runs off to infinity is not larger far from there than near it: where both ends of a shorter stretch
have less than this part of what the longer one had, the answer passes through zero."""
MISSES = [CODE[Status.CANNOT_ASSEMBLE], CODE[Status.AMBIGUOUS]]
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


Mask = npt.NDArray[np.bool_]
Seen = tuple[Array, Codes]
"""Answers and statuses (their codes) at places."""
Search = Generator[Array, Seen, FoundPosition | None]
"""Yields places, is sent what is seen there, and returns what it found."""


def _is_searched(case: Case) -> bool:
    """Whether points of a figure are searched for; not those that a contact alone places."""
    try:
        return any(isinstance(step, PointGroup) for step in order_of(case, wanted_points(case)[1]).steps)
    except SceneError:
        return False


class Scenes:
    """Positions along one number, scene by scene."""

    def __init__(self, case: Case, columns: Columns, name: str, query: Query) -> None:
        self.case, self.columns, self.name, self.query = case, columns, name, query
        self.load = query.load or next(load.name for load in case.loads if is_unknown(load))
        values = columns.arrays[name]
        self.searched = _is_searched(case)
        count = SEARCHED if self.searched else PLACES
        self.places = np.linspace(values.min(), values.max(), count + 1)
        self.scenes = 0
        self.width = max(CLOSED * float(np.ptp(values)), 4.0 * float(np.spacing(np.abs(values).max())))

    def spots(self) -> FoundPositions:
        """All positions that are found, in order."""
        found, codes = self._first()
        if (codes == CODE["holds"]).any():
            raise SceneError(Status.UNSUPPORTED, HOLDS.format(load=self.load))
        finder = {"value": self._values, "max": self._peaks, "dead": self._dead}[self.query.kind]
        searches = list(finder(found, codes))
        spots = FoundPositions()
        spots.notes = (SAID.format(count=len(self.places)),)
        try:
            for first in range(0, len(searches), TOGETHER):
                spots += self._together(searches[first : first + TOGETHER])
        except _EnoughError:
            spots.notes += (MANY,)
        spots.sort(key=lambda spot: spot.at)
        return spots

    def _first(self) -> Seen:
        """What is seen at the places, which are all, or those that are worth a search."""
        kept = np.arange(len(self.places)) % (APART if self.searched else 1) == 0
        found, codes = np.full(len(kept), np.nan), np.zeros(len(kept), dtype=np.int8)
        found[kept], codes[kept] = self._swept(self.places[kept])
        if self.searched:
            missed = np.isin(codes[kept], MISSES)
            between = ~kept & ~np.append(np.repeat(missed[:-1] & missed[1:], APART), False)
            if between.any():
                found[between], codes[between] = self._swept(self.places[between])
            kept |= between
        self.places = self.places[kept]
        return found[kept], codes[kept]

    def _swept(self, at: Array) -> Seen:
        self.scenes += len(at) * (FOUND if self.searched else 1)
        if self.scenes > MOST_SCENES:
            raise _EnoughError
        rows = {own: np.full(len(at), float(a[0])) for own, a in self.columns.arrays.items()}
        rows[self.name] = at
        vary = {own: rows[own] for own in self.columns.paths}
        found = sweep(self.case, vary, drive={own: rows[own] for own in self.columns.links})
        self.scenes += MISSED * self.searched * int(np.isin(found.codes, MISSES).sum())
        return found.answers.get(self.load, np.full(len(at), np.nan)), found.codes

    def _together(self, searches: list[Search]) -> Iterator[FoundPosition]:
        """What searches find that go on side by side, each step of all by one sweep."""
        sent: dict[Search, Seen | None] = dict.fromkeys(searches)
        while sent:
            asked: dict[Search, Array] = {}
            for search, seen in sent.items():
                try:
                    asked[search] = next(search) if seen is None else search.send(seen)
                except StopIteration as ended:
                    if ended.value is not None:
                        yield ended.value
            if not asked:
                return
            answers, codes = self._swept(np.concatenate(list(asked.values())))
            cuts = np.cumsum([len(at) for at in asked.values()])[:-1]
            sent = dict(
                zip(asked, zip(np.split(answers, cuts), np.split(codes, cuts), strict=True), strict=True)
            )

    # --- kinds ------------------------------------------------------------------------------------

    def _values(self, found: Array, codes: Codes) -> Iterator[Search]:
        """Where the answer has the value, and its changes of sign less the value but through infinity."""
        miss = found - self.query.value
        for k in np.flatnonzero((miss == 0.0) | np.append(miss[:-1] * miss[1:] < 0.0, False)).tolist():
            yield self._value(k, miss)

    def _value(self, k: int, miss: Array) -> Search:
        if miss[k] == 0.0:
            return FoundPosition(
                float(self.places[k]), "value", float(miss[k] + self.query.value), self.width
            )
        low, high = yield from self._closed(lambda seen: seen[0] > self.query.value, k)
        at = (low + high) / 2.0
        answer = float((yield np.array([at]))[0][0])
        if abs(answer - self.query.value) <= min(abs(miss[k]), abs(miss[k + 1])) + abs(self.width):
            return FoundPosition(at, "value", answer, high - low)
        return None  # a jump, in which there may be no answer

    def _dead(self, found: Array, codes: Codes) -> Iterator[Search]:
        """Changes of sign through infinity, and where the mechanism begins to lock or reaches its limit."""
        for k in np.flatnonzero(found[:-1] * found[1:] < 0.0).tolist():
            yield self._pole(k, found)
        for kind, wanted in (("dead", LOCKED), ("limit", [CODE[Status.CANNOT_ASSEMBLE]])):
            there = np.isin(codes, wanted)
            for k in np.flatnonzero(there[:-1] != there[1:]).tolist():
                yield self._end(kind, wanted, k, bool(there[k]))

    def _pole(self, k: int, found: Array) -> Search:
        """Where the answer grows to infinity at a change of sign: a jump stays as it is, also where friction
        jams so near to it that there is no answer."""
        low, high = yield from self._closed(lambda seen: seen[0] > 0.0, k, np.abs(found[k : k + 2]))
        if high - low > self.width:
            return None
        at, away, near, far = (low + high) / 2.0, BESIDE * self.width, math.nan, math.nan
        while math.isnan(near) and away <= self.places[k + 1] - self.places[k]:
            size = np.abs((yield at + away * np.array([-1.0, 1.0, -10.0, 10.0]))[0])
            near, far = size[:2].max(), size[2:].max()
            away *= 10.0
        return None if near <= GROWN * far else FoundPosition(at, "dead", None, high - low)

    def _end(self, kind: str, wanted: list[int], k: int, before: bool) -> Search:
        """Where a status begins or ends between two places: the last that has none of it."""
        low, high = yield from self._closed(lambda seen: np.isin(seen[1], wanted), k)
        at = high if before else low
        answer = float((yield np.array([at]))[0][0]) if kind == "limit" else math.nan
        return FoundPosition(at, kind, None if math.isnan(answer) else answer, high - low)

    def _peaks(self, found: Array, codes: Codes) -> Iterator[Search]:
        """Where the size of the answer is larger than on both sides."""
        size = np.abs(found)
        for k in range(1, len(size) - 1):
            if np.isfinite(size[k - 1 : k + 2]).all() and size[k - 1] < size[k] >= size[k + 1]:
                yield self._peak(k, float(found[k]))

    def _peak(self, k: int, beside: float) -> Search:
        low, high = float(self.places[k - 1]), float(self.places[k + 1])
        while high - low > FLAT * self.width / CLOSED:
            at = np.linspace(low, high, 2 * SECTIONS + 1)
            most = int(np.nan_to_num(np.abs((yield at[1:-1])[0])).argmax()) + 1
            low, high = float(at[most - 1]), float(at[most + 1])
        at = np.array([(low + high) / 2.0])
        answer = float((yield at)[0][0])
        grown = abs(answer) > 10.0 * abs(beside) or answer * beside <= 0.0
        return None if grown else FoundPosition(float(at[0]), "max", answer, high - low)

    def _closed(
        self, state: Callable[[Seen], Mask], k: int, sizes: Array | None = None
    ) -> Generator[Array, Seen, tuple[float, float]]:
        """The two places, as near as is asked, between which a state changes after place ``k``; less near
        where the answers, of these ``sizes`` at first, fade as toward a zero."""
        low, high = float(self.places[k]), float(self.places[k + 1])
        first = state((yield np.array([low])))[0]
        least = -1.0 if sizes is None else FADED * float(sizes.max())
        ends = np.zeros(2) if sizes is None else sizes
        while high - low > self.width and not ends.max() < least:
            at = np.linspace(low, high, SECTIONS + 1)
            seen = yield at[1:-1]
            j = int(np.append(state(seen) != first, True).argmax())
            low, high = float(at[j]), float(at[j + 1])
            ends = np.array([ends[0], *np.abs(seen[0]), ends[1]])[j : j + 2]
        return low, high
