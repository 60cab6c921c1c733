"""Positions where each row is a scene of its own: with friction, on cam profiles, in families one by one.

There is no record to bound over whole cells: the range is searched at many places, more closely toward its
ends and toward limits, each change between two of them is closed in on, and a note says so. What is closed
in on counts where rows with proven bounds show it: signs on both sides of a value, less on both sides of a
peak.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Iterator

import numpy as np

from icsolve.assembly.order import order_of
from icsolve.assembly.steps import PointGroup
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers.replay import Array, Mask
from icsolve.numbers.tape import UNIT
from icsolve.scene.refusals import rubs
from icsolve.statics.power import is_unknown
from icsolve.sweep import sweep
from icsolve.sweep.program import wanted_points
from icsolve.sweep.request import Columns, RequestError
from icsolve.sweep.table import CODE, Codes
from icsolve.tuples import NamedTuple

PLACES = 360
"""Places at which the range is searched."""
ASIDE = math.sqrt(2.0) / 16.0
"""Of a step: peaks are looked for at no round numbers, as of which an answer that jumps there has, for that
instant, the value of neither side: it would make a peak beside it, or hide one."""
RINGS, CLOSER = 8, 0.125
"""Toward each end so many more, each this many times as far from it as the one before."""
WITHIN, ROUNDS = 7, 10
"""Between a place where the links assemble and the next, where they do not, so many more, and so many times
over between the last such two: beside a limit an answer runs like the root of the distance."""
SEARCHED, APART = 48, 4
"""The same where points of the figure are searched for at each: every so-manyth first, and those between only
beside one that assembles."""
FOUND, MISSED = 4, 24
"""Such a scene counts for so many, and for so many more where nothing is found."""
RUBBING = 1.5
"""A scene with friction counts for so many: where it jams its forces are searched for in vain."""
CLOSED = 1e-12
"""Places are closed in to this part of the range."""
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
UNSHOWN = "where the answer hardly changes, by less than its own rounding error, no position is told."
HAS = "{load} has this value over whole stretches, of which the ends are given."
JUMPED = (
    "near {where} {load} jumps past this value, from {before:.6g} to {after:.6g}: where friction changes its "
    "sense or a contact goes over to another place it has no value between, but perhaps at that very instant."
)
HOLDS = (
    "with friction and no motion {load} holds over a range, not at one value, so no position is looked for. "
    "Give a `motion`, or leave out the friction."
)
BESIDE, GROWN = 1000.0, 3.0
"""What runs off to infinity grows as one over the distance: ``BESIDE`` widths away, or so much farther that
it is finite, it is more than ``GROWN`` times as large as ten times as far away."""
FADED = 0.1
"""What runs off to infinity is not larger far from there than near it: where both ends of a shorter stretch
have less than this part of what the longer one had, the answer passes through zero."""
ROOM = 2.0**-6
"""To both sides of where a chord meets a value, as a part of the chord."""
STEADY, SHARP = 1e-9, 1e-13
"""A peak is closed in on by doubles until it stands so little above what is beside it, relative to it
(``SHARP`` where it is a corner, which doubles tell so long); rows with bounds show the rest."""
UNPROVEN = 1e-9
"""Relative error of an answer of which no bound is proven."""
LEVELS, ENOUGH = 6, 24
"""Beside a peak an answer grows no more: that it doubles while its stretch is halved so many times, after so
many in all, shows that it runs off to infinity."""
JUMPS = 10.0
"""A change that closes in to a part w of its stretch keeps at most so many times the root of w of its size,
or it is a jump."""
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


class Asked(NamedTuple):
    """Places that a search asks for; ``proven`` where the bounds of their answers are asked, too."""

    at: Array
    proven: bool = False


class SeenRows(NamedTuple):
    """What is seen at places, (n,) each: answers [case units], statuses (their codes), and bounds of the
    errors of the answers where these were asked."""

    answers: Array
    codes: Codes
    errors: Array


Search = Generator[Asked, SeenRows, list[FoundPosition]]
"""Yields places, is sent what is seen there, and returns what it found."""
Measure = Callable[[Array], Array]
"""Of answers."""


class Top(NamedTuple):
    """Where a measure of the answer is largest, as doubles and a parabola tell.

    Attributes
    ----------
    at : the place
    answer, height, error : the answer there, its measure, and the bound of their error [case units]
    reach, drop : so far to both sides of it the measure is less by so much, on one side at least
    grows : whether it grows as the place is closed in on, to infinity
    corner : whether it falls from there as the distance, so that between places it may be ``drop`` larger
    measure : of answers
    """

    at: float
    answer: float
    height: float
    error: float
    reach: float
    drop: float
    grows: bool
    corner: bool
    measure: Measure


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
        self.span = float(values.min()), float(values.max())
        self.searched = _is_searched(case)
        self.places = np.linspace(values.min(), values.max(), (SEARCHED if self.searched else PLACES) + 1)
        self.each = FOUND if self.searched else RUBBING if rubs(case) else 1.0
        """what a scene counts for"""
        self.scenes = 0.0
        self.width = max(CLOSED * float(np.ptp(values)), 4.0 * float(np.spacing(np.abs(values).max())))
        if query.kind == "max":
            self.places[1:-1] += ASIDE * (self.places[1] - self.places[0])
            self.places[[0, -1]] += [self.width, -self.width]
        self.rounded = UNIT * abs(query.value)
        """how far the value may be from the decimal that it is written as"""
        self.room = self.rounded
        """the same with the bounds of the answers at places that have it"""
        self.notes: dict[str, None] = {}

    def spots(self) -> FoundPositions:
        """All positions that are found, in order."""
        self._swept(self.places[:1])  # what holds mostly does so there, and is refused before the others
        found, codes = self._first()
        finder = {"value": self._values, "max": self._peaks, "dead": self._dead}[self.query.kind]
        spots = FoundPositions()
        self.notes[SAID.format(count=len(self.places))] = None
        try:
            searches = list(finder(found, codes))
            for first in range(0, len(searches), TOGETHER):
                spots += self._together(searches[first : first + TOGETHER])
        except _EnoughError:
            self.notes[MANY] = None
        spots = FoundPositions(_once(spots))
        spots.notes = tuple(self.notes)
        return spots

    def _first(self) -> tuple[Array, Codes]:
        """What is seen at the places, which are all, or those that are worth a search, and at rings toward
        the ends and limits, so that what turns in the first or the last stretch is seen to; where the answer
        is largest at an end, a step beyond it."""
        kept = np.arange(len(self.places)) % (APART if self.searched else 1) == 0
        found, codes = np.full(len(kept), np.nan), np.zeros(len(kept), dtype=np.int8)
        found[kept], codes[kept] = self._swept(self.places[kept])[:2]
        if self.searched:
            missed = np.isin(codes[kept], MISSES)
            between = ~kept & ~np.append(np.repeat(missed[:-1] & missed[1:], APART), False)
            if between.any():
                found[between], codes[between] = self._swept(self.places[between])[:2]
            kept |= between
        self.places, found, codes = self.places[kept], found[kept], codes[kept]
        step = (self.places[1] - self.places[0]) * CLOSER ** np.arange(1.0, RINGS + 1.0)
        more: list[tuple[Array, SeenRows]] = []
        for k, near, inward in ((0, 1, step), (-1, -2, -step)):
            if codes[k]:
                continue
            beyond = self._beyond(k, near, found) if self.query.kind == "max" else None
            rings = np.setdiff1d(self.places[k] + inward, self.places)
            more.append((rings, self._swept(rings)) if beyond is None else beyond)
        found, codes = self._joined(found, codes, more)
        for _ in range(ROUNDS if self.query.kind != "dead" and not self.searched else 0):
            gone = np.isin(codes, MISSES)
            last = np.flatnonzero((gone[1:] != gone[:-1]) & (np.diff(self.places) > self.width))
            if not last.size or self.scenes > 0.75 * MOST_SCENES:
                break
            at = np.linspace(self.places[last], self.places[last + 1], WITHIN + 2)[1:-1].ravel()
            found, codes = self._joined(found, codes, [(at, self._swept(at))])
        return found, codes

    def _joined(self, found: Array, codes: Codes, more: list[tuple[Array, SeenRows]]) -> tuple[Array, Codes]:
        """What is seen at the places and at more, which become places, in order."""
        places = np.concatenate([self.places, *(at for at, _ in more)])
        order = np.argsort(places)
        self.places = places[order]
        found = np.concatenate([found, *(seen.answers for _, seen in more)])
        return found[order], np.concatenate([codes, *(seen.codes for _, seen in more)])[order]

    def _beyond(self, k: int, near: int, found: Array) -> tuple[Array, SeenRows] | None:
        """What is seen a step beyond an end, where the answer is larger at that than there and inside."""
        at = np.array([2.0 * self.places[k] - self.places[near]])
        try:
            seen = self._swept(at)
        except RequestError:  # no case may have such a number
            return None
        beside, here, inside = np.abs([seen.answers[0], found[k], found[near]])
        return (at, seen) if beside < here >= inside else None

    def _swept(self, at: Array, proven: bool = False) -> SeenRows:
        self.scenes += len(at) * self.each
        if self.scenes > MOST_SCENES:
            raise _EnoughError
        rows = {own: np.full(len(at), float(a[0])) for own, a in self.columns.arrays.items()}
        rows[self.name] = at
        vary = {own: rows[own] for own in self.columns.paths}
        want = ("answers", "status", *(["error"] if proven else []))
        found = sweep(self.case, vary, want, drive={own: rows[own] for own in self.columns.links})
        if (found.codes == CODE["holds"]).any():
            raise SceneError(Status.UNSUPPORTED, HOLDS.format(load=self.load))
        self.scenes += MISSED * self.searched * int(np.isin(found.codes, MISSES).sum())
        nothing = np.full(len(at), np.nan)
        answers = found.answers.get(self.load, nothing)
        errors = found.error.get(self.load, nothing) if proven else nothing
        return SeenRows(answers, found.codes, np.where(np.isnan(errors), UNPROVEN * np.abs(answers), errors))

    def _together(self, searches: list[Search]) -> Iterator[FoundPosition]:
        """What searches find that go on side by side, each step of all by one sweep."""
        sent: dict[Search, SeenRows | None] = dict.fromkeys(searches)
        while sent:
            asked: dict[Search, Asked] = {}
            for search, seen in sent.items():
                try:
                    asked[search] = next(search) if seen is None else search.send(seen)
                except StopIteration as ended:
                    yield from ended.value
            sent = {}
            for proven in (False, True):
                some = {search: one.at for search, one in asked.items() if one.proven == proven}
                if some:
                    seen = self._swept(np.concatenate(list(some.values())), proven)
                    cuts = np.cumsum([len(at) for at in some.values()])[:-1]
                    parts = zip(*(np.split(part, cuts) for part in seen), strict=True)
                    sent |= zip(some, (SeenRows(*part) for part in parts), strict=True)

    # --- kinds ------------------------------------------------------------------------------------

    def _values(self, found: Array, codes: Codes) -> Iterator[Search]:
        """Where the answer passes through the value, turns back at it, or begins or ceases to have it."""
        miss = self._misses(found)
        sign, size = np.sign(miss), np.abs(miss)
        for k in range(len(sign)):
            before, after = (sign[j] if 0 <= j < len(sign) else math.nan for j in (k - 1, k + 1))
            if sign[k] * after < 0.0:
                yield self._crossing(k, k + 1, miss)
            elif sign[k] == 0.0 and before * after < 0.0:
                yield self._crossing(k - 1, k + 1, miss)
            elif before * after > 0.0 and sign[k] * after >= 0.0:
                least, most = sorted(size[[k - 1, k + 1]])
                bent = size[k] <= most - size[k]  # a parabola may reach it, or a corner
                if size[k] <= least and (bent or any(self._meets(size, k, way) for way in (-1, 1))):
                    yield self._touching(k, float(after), found)
            elif sign[k] == 0.0:
                yield self._having(k, before, after, not miss.any())

    def _misses(self, found: Array) -> Array:
        """By how much the answers at the places miss the value. Where that is next to nothing rows with
        bounds tell it: 0 where these leave its side open, for no row beyond such a place would show that the
        answer passes through; so at an end of the range to which the answer runs, but for last digits."""
        value, least = self.query.value, SHARP * abs(self.query.value)
        miss = found - value
        close = np.abs(miss) <= least
        close[1:-1] &= np.abs(miss[1:-1]) > self.rounded
        if close.any():
            answers, _, errors = self._swept(self.places[close], True)
            off, error = answers - value, self.rounded + np.minimum(errors, least)
            inward = np.abs(miss[np.clip(np.flatnonzero(close), 1, len(miss) - 2)])
            at_end = np.isin(np.flatnonzero(close), (0, len(miss) - 1)) & (8.0 * np.abs(off) < inward)
            has = at_end | (np.abs(off) <= error)
            miss[close] = np.where(has, 0.0, off)
            self.room = max(self.room, *error[has].tolist()) if has.any() else self.room
        miss[np.abs(miss) <= self.rounded] = 0.0
        return miss

    def _meets(self, size: Array, k: int, way: int) -> bool:
        """Whether there may be a corner at the value beyond place ``k``: as it falls up to there, and rises
        behind the next, two chords meet at less than half of what is left."""
        if not 0 <= k + 2 * way < len(size):
            return False
        at, off = ([float(some[k + n * way]) for n in (-1, 0, 1, 2)] for some in (self.places, size))
        fall, rise = (off[1] - off[0]) / (at[1] - at[0]), (off[3] - off[2]) / (at[3] - at[2])
        if not fall * way < 0.0 < rise * way:
            return False
        meet = at[1] + (off[2] - off[1] + rise * (at[1] - at[2])) / (fall - rise)
        return off[1] + fall * (meet - at[1]) <= 0.5 * off[1]

    def _crossing(self, k: int, n: int, miss: Array) -> Search:
        """The change of sign between two places."""
        return self._through((float(self.places[k]), float(self.places[n])), (float(miss[k]), float(miss[n])))

    def _through(self, stretch: tuple[float, float], miss: tuple[float, float]) -> Search:
        """The same between the ends of a stretch, at which the answer misses the value by so much."""
        low, high = yield from self._narrowed(stretch, miss)
        shown = yield from self._shown(stretch, (low + high) / 2.0, (high - low) / 2.0, self.query.value)
        if shown is None:
            self.notes[UNSHOWN] = None
            return []
        at, error, (before, after) = shown
        part = 2.0 * error / (stretch[1] - stretch[0])
        if abs(after - before) > JUMPS * math.sqrt(part) * abs(miss[1] - miss[0]):
            where = f"{self.columns.names[self.name]} = {at:.9g}"
            self.notes[JUMPED.format(load=self.load, where=where, before=before, after=after)] = None
            return []
        return [FoundPosition(at, "value", self.query.value, error)]

    def _narrowed(
        self, stretch: tuple[float, float], miss: tuple[float, float]
    ) -> Generator[Asked, SeenRows, tuple[float, float]]:
        """A stretch whose ends miss the value to both sides, as narrow as is asked: where the chord meets it,
        with room to both sides, and halved."""
        (low, high), (f, g) = stretch, miss
        while high - low > self.width:
            chord, room = low - f * (high - low) / (g - f), max((high - low) * ROOM, self.width / 4.0)
            at = np.clip([chord - room, chord + room, (low + high) / 2.0], low, high)
            at = np.unique(at[(at > low) & (at < high)])
            if not at.size:
                break
            m = np.nan_to_num((yield Asked(at)).answers - self.query.value, nan=g)
            at, m = np.array([low, *at, high]), np.array([f, *m, g])
            j = int(np.flatnonzero((m > 0.0) == (g > 0.0))[0])
            (low, high), (f, g) = (float(at[j - 1]), float(at[j])), (float(m[j - 1]), float(m[j]))
            if f == 0.0 or g == 0.0:
                return (low, low) if f == 0.0 else (high, high)
        return low, high

    def _shown(
        self, stretch: tuple[float, float], at: float, wide: float, value: float
    ) -> Generator[Asked, SeenRows, tuple[float, float, tuple[float, float]] | None]:
        """A place with its error and the answers before and behind that, where rows with bounds show these
        on both sides of a value; None where none do."""
        wide = max(wide, self.width / 2.0)
        while True:
            ends = np.clip([at - wide, at + wide], *stretch)
            answers, _, errors = yield Asked(ends, True)
            miss = answers - value
            if (np.abs(miss) > errors + self.rounded).all() and (miss[0] < 0.0) != (miss[1] < 0.0):
                return at, float(max(at - ends[0], ends[1] - at)), (float(answers[0]), float(answers[1]))
            if (ends == stretch).all():
                return None
            wide *= SECTIONS

    def _touching(self, k: int, side: float, found: Array) -> Search:
        """Where the answer, to this ``side`` of the value, comes nearest to it: it turns back there, or has
        passed through it and comes back."""
        value, stretch = self.query.value, (float(self.places[k - 1]), float(self.places[k + 1]))
        top = yield from self._topmost(k, lambda answers: -side * (answers - value), found)
        top = top._replace(error=top.error + self.rounded)
        if top.height < -top.error - (top.drop if top.corner else 0.0):
            return []
        if top.height > top.error:
            spots = []
            for n, end in ((k - 1, stretch[0]), (k + 1, stretch[1])):
                ends = sorted([(end, float(found[n]) - value), (top.at, -side * top.height)])
                spots += yield from self._through(*zip(*ends, strict=True))
            return spots
        error = yield from self._above(stretch, top._replace(height=min(top.height, 0.0)))
        if error is None:
            self.notes[UNSHOWN] = None
            return []
        return [FoundPosition(top.at, "value", value, error)]

    def _having(self, k: int, before: float, after: float, throughout: bool) -> Search:
        """A place that has the value, at the end of the range or of the places that have an answer, or where
        a stretch that has it begins or ends; the ends of a range that has it throughout."""
        value = self.query.value
        if before == after == 0.0:
            return []
        if 0.0 in (before, after):
            self.notes[HAS.format(load=self.load)] = None
            if math.isnan(before + after):
                at = float(self.places[k])
                return [FoundPosition(at, "value", value, 0.0)] if throughout else []
            n = k - 1 if after == 0.0 else k
            low, high = yield from self._closed(lambda seen: np.abs(seen.answers - value) <= self.room, n)
            return [FoundPosition(high if after == 0.0 else low, "value", value, high - low)]
        at, wide = float(self.places[k]), self.width
        inner = float(self.places[k + 1 if math.isnan(before) else k - 1])
        while abs(wide) < abs(inner - at):
            seen = yield Asked(np.array([at + math.copysign(wide, inner - at)]), True)
            if abs(seen.answers[0] - value) > seen.errors[0] + self.rounded:
                return [FoundPosition(at, "value", value, wide)]
            wide *= SECTIONS
        return []

    def _dead(self, found: Array, codes: Codes) -> Iterator[Search]:
        """Changes of sign through infinity, places from which it runs off there to one side, and where the
        mechanism begins to lock or reaches its limit."""
        sign = np.sign(found)
        for k in np.flatnonzero(sign[:-1] * sign[1:] < 0.0).tolist():
            yield self._pole(k, found)
        for k in self._crests(np.abs(found)):
            if sign[k - 1] == sign[k] == sign[k + 1]:
                yield self._growing(k, found)
        for kind, wanted in (("dead", LOCKED), ("limit", [CODE[Status.CANNOT_ASSEMBLE]])):
            there = np.isin(codes, wanted)
            for k in np.flatnonzero(there[:-1] != there[1:]).tolist():
                yield self._end(kind, wanted, k, bool(there[k]))

    def _pole(self, k: int, found: Array) -> Search:
        """Where the answer grows to infinity at a change of sign: a jump stays as it is, also where friction
        jams so near to it that there is no answer."""
        stretch = (float(self.places[k]), float(self.places[k + 1]))
        low, high = yield from self._closed(lambda seen: seen.answers > 0.0, k, np.abs(found[k : k + 2]))
        if high - low > self.width:
            return []
        at, away, near, far = (low + high) / 2.0, BESIDE * self.width, math.nan, math.nan
        while math.isnan(near) and away <= stretch[1] - stretch[0]:
            size = np.abs((yield Asked(at + away * np.array([-1.0, 1.0, -10.0, 10.0]))).answers)
            near, far = size[:2].max(), size[2:].max()
            away *= 10.0
        if near <= GROWN * far:
            return []
        shown = yield from self._shown(stretch, at, (high - low) / 2.0, 0.0)
        return [FoundPosition(at, "dead", None, high - low if shown is None else shown[1])]

    def _growing(self, k: int, found: Array) -> Search:
        """Where the answer grows to infinity to one side."""
        top = yield from self._topmost(k, np.abs, found)
        return [FoundPosition(top.at, "dead", None, 2.0 * top.reach)] if top.grows else []

    def _end(self, kind: str, wanted: list[int], k: int, before: bool) -> Search:
        """Where a status begins or ends between two places: the last that has none of it."""
        low, high = yield from self._closed(lambda seen: np.isin(seen.codes, wanted), k)
        at = high if before else low
        answer = float((yield Asked(np.array([at]))).answers[0]) if kind == "limit" else math.nan
        return [FoundPosition(at, kind, None if math.isnan(answer) else answer, high - low)]

    def _peaks(self, found: Array, codes: Codes) -> Iterator[Search]:
        """Where the size of the answer is larger than on both sides."""
        for k in self._crests(np.abs(found)):
            yield self._peak(k, found)

    def _crests(self, size: Array) -> list[int]:
        """Places at which the answer is larger than at the ones beside."""
        here = size[1:-1]
        return (1 + np.flatnonzero((size[:-2] < here) & (here >= size[2:]))).tolist()

    def _peak(self, k: int, found: Array) -> Search:
        top = yield from self._topmost(k, np.abs, found)
        if top.grows:
            return []
        error = yield from self._above((float(self.places[k - 1]), float(self.places[k + 1])), top)
        (low, high), off = self.span, error or 0.0
        off = -off if top.corner else off  # a jump at an end has a peak on one of its sides, if it has
        inside = low - off <= top.at <= high + off
        if error is None:
            self.notes |= {UNSHOWN: None} if inside else {}
            return []
        return [FoundPosition(min(max(top.at, low), high), "max", top.answer, error)] if inside else []

    def _topmost(self, k: int, measure: Measure, found: Array) -> Generator[Asked, SeenRows, Top]:
        """Where a measure of the answer is largest between the places beside place ``k``, which have less of
        it than that."""
        at, height = self.places[k - 1 : k + 2], measure(found[k - 1 : k + 2])
        size, tops, grows = float(np.abs(found[k])), [height[1]], False
        drops = [height[1] - min(height[0], height[-1])]
        while at[-1] - at[0] > self.width and drops[-1] > (STEADY if _bends(drops) else SHARP) * size:
            fine = np.insert(at, [1, 2], (at[:-1] + at[1:]) / 2.0)
            between = np.nan_to_num(measure((yield Asked(fine[1::2])).answers), nan=-np.inf)
            heights = np.insert(height, [1, 2], between)
            top = 1 + int(heights[1:-1].argmax())
            at, height, tops = fine[top - 1 : top + 2], heights[top - 1 : top + 2], [*tops, heights[top]]
            drops.append(height[1] - min(height[0], height[-1]))
            grows = len(tops) > LEVELS and tops[-1] > 2.0 * abs(tops[-1 - LEVELS])
            if self.query.kind == "dead" and len(drops) > LEVELS and _bends(drops):
                break
            if grows and len(tops) > ENOUGH and self.query.kind != "dead":
                break
        seen = yield Asked(at, True)
        height, bound = measure(seen.answers), seen.errors
        reach, drop = (at[2] - at[0]) / 2.0, float(height[1] - min(height[0], height[2]))
        (before, after), (less, lower) = at[::2] - at[1], (height[::2] - height[1]) / (at[::2] - at[1])
        bend = (less - lower) / (before - after)
        crest = at[1] - ((less - bend * before) / (2.0 * bend) if bend < 0.0 else 0.0)
        best = at[1], seen.answers[1], height[1], bound[1]
        if crest != at[1] and at[0] < crest < at[2]:  # that of a parabola
            own = yield Asked(np.array([crest]), True)
            if measure(own.answers)[0] >= height[1]:
                best = crest, own.answers[0], measure(own.answers)[0], own.errors[0]
        place, answer, most, error = map(float, best)
        return Top(place, answer, most, error, float(reach), drop, grows, not _bends(drops, 8), measure)

    def _above(self, stretch: tuple[float, float], top: Top) -> Generator[Asked, SeenRows, float | None]:
        """The error of the place of a peak: as far away to both sides rows with bounds show less; None where
        none do."""
        ends, least = np.array(stretch), self.width / 2.0
        share = 8.0 * top.error / top.drop if top.drop > 0.0 else 1.0
        wide = np.full(2, max(least, top.reach * math.sqrt(min(share, 1.0))))
        while True:
            at = np.clip(top.at + wide * [-1.0, 1.0], *stretch)
            answers, _, errors = yield Asked(at, True)
            less = top.measure(answers) + errors < top.height - top.error
            if less.all():
                return float(np.abs(at - top.at).max())
            if (~less & (at == ends)).any():
                return None
            wide = np.where(less, wide, SECTIONS * wide)

    def _closed(
        self, state: Callable[[SeenRows], Mask], k: int, sizes: Array | None = None
    ) -> Generator[Asked, SeenRows, tuple[float, float]]:
        """The two places, as near as is asked, between which a state changes after place ``k``; less near
        where the answers, of these ``sizes`` at first, fade as toward a zero."""
        low, high = float(self.places[k]), float(self.places[k + 1])
        first = state((yield Asked(np.array([low]))))[0]
        least = -1.0 if sizes is None else FADED * float(sizes.max())
        ends = np.zeros(2) if sizes is None else sizes
        while high - low > self.width and not ends.max() < least:
            at = np.linspace(low, high, SECTIONS + 1)
            seen = yield Asked(at[1:-1])
            j = int(np.append(state(seen) != first, True).argmax())
            low, high = float(at[j]), float(at[j + 1])
            ends = np.array([ends[0], *np.abs(seen.answers), ends[1]])[j : j + 2]
        return low, high


def _once(spots: list[FoundPosition]) -> Iterator[FoundPosition]:
    """In order. Where the mechanism begins and ceases to lock within the errors, it locks in one place; a
    limit says more."""
    said = [spot for spot in spots if spot.kind == "limit"]
    for spot in sorted(spots, key=lambda spot: spot.at):
        if spot.kind == "dead":
            if any(abs(spot.at - other.at) <= spot.error + other.error for other in said):
                continue
            said.append(spot)
        yield spot


def _bends(drops: list[float], halved: int = 4) -> bool:
    """Whether what a peak stands above the places beside it falls as the square of their distance, while that
    was halved some times, and not as the distance itself, as beside a corner, whose sides may be unlike."""
    return len(drops) <= halved or 2.0 ** (halved + halved // 2 - 1) * drops[-1] < drops[-1 - halved]
