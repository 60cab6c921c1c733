"""Positions in a sweep: where it locks, where the answer peaks, where it takes a value, to the last digit.

An answer is a quotient of two powers, per unit of the unknown and of the known loads. Its poles are the
zeros of the one (the unknown does no work: a dead centre), its own zeros those of the other. Zeros are
isolated over whole cells of the range by bounds of the function and its derivatives, so that none is missed
and none invented, touching ones and close pairs too; each is then closed in on the record in decimals.
Groups of links that Newton's method places have no such bounds: there the range is searched at many places,
and a note says so.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from decimal import Decimal, localcontext
from functools import cached_property, partial
from itertools import islice, pairwise, product

import numpy as np
import numpy.typing as npt

from icsolve.answer import by_load
from icsolve.case import Case, refuse_no_case
from icsolve.errors import SceneError, Status
from icsolve.numbers import Scalar
from icsolve.numbers.decimals import CONTEXT, as_written
from icsolve.numbers.jets import BallArray, Cells, Jet
from icsolve.numbers.record import Op, Record, Traced, live, terms_of
from icsolve.numbers.replay import Array, Mask
from icsolve.numbers.roots import MOST_ORDER, NOTHING, STEP, last_that_holds, slope, zeros_between
from icsolve.numbers.tape import UNIT
from icsolve.scene import solve_scene, wanted
from icsolve.scene.needed_part import moving_part
from icsolve.scene.program import Want
from icsolve.scene.refusals import rubs
from icsolve.statics.power import loads_to_find
from icsolve.sweep.continuation import SAME
from icsolve.sweep.exact_record import APART, Unreached, Values, hides
from icsolve.sweep.find_by_scenes import HAS, FoundPosition, FoundPositions, Query, Scenes
from icsolve.sweep.program import RowRequest
from icsolve.sweep.recheck import Recheck
from icsolve.sweep.request import RequestError, along_of, columns_of
from icsolve.sweep.row_parts import SweepPart, SweepParts
from icsolve.sweep.starting_position import start_of
from icsolve.wording.sentences import left_out

__all__ = ["FoundPosition", "FoundPositions", "Query", "find"]

CELLS = 256
"""Cells at first."""
WITHIN = (0.5, 0.25, 0.75, 0.0, 1.0)
"""Where in a range its branch is looked for."""
MOST_CELLS = 60_000
"""More cells than these are not looked at: what is left is said."""
NARROW = 2.0**-32
"""Cells that are this part of the range wide are at an end of it, or at a change point."""
PLACES = 2048
"""Places at which groups are searched."""
NEAR = Decimal("1e-20")
"""Places nearer to each other than this are one."""


def find(
    case: Case,
    vary: Mapping[str, npt.ArrayLike] | None,
    query: Query,
    *,
    drive: Mapping[str, npt.ArrayLike] | None = None,
) -> FoundPositions:
    """The positions in a sweep along one number, in order: all that lie from its first to its last value.

    Parameters
    ----------
    case, vary, drive : as for `icsolve.sweep`; one number varies, and only its least and greatest value count
    query : what to look for

    Returns
    -------
    FoundPositions
        In order of the number; ``notes`` say so where nothing shows that none is missing.

    Raises
    ------
    CaseError
        For a path that the case does not have.
    SceneError
        Where the case cannot be moved so.
    ValueError
        Where several numbers vary, or the load is not an unknown one.
    """
    refuse_no_case(case)
    columns = columns_of(case, vary, drive)
    along = along_of(case, columns)
    loads = loads_to_find(case)
    if query.load not in {"", *loads}:
        raise RequestError(
            f"{query.load} is no unknown load of this case ({', '.join(loads) or 'which has none'})"
        )
    by_itself = rubs(case) or bool(case.touches)
    if not by_itself and not wanted(case, Want()).everything:  # as the scene of a place solves no more
        case = moving_part(case, columns.paths, columns.links) or case
    start = None if by_itself else start_of(case, columns, RowRequest(dynamic=case.dynamic))
    # dead centres and limits hang on no load that is known
    if start is None or start.one_by_one or hides(start.compiled(), query.kind != "dead"):
        return Scenes(case, columns, along, query).spots()
    spots, refusal = FoundPositions(), start.compiled().refusal
    if refusal is not None and refusal.status == Status.MOBILITY:
        raise refusal
    if refusal is None:
        parts = SweepParts(start, columns)
        search = RangeSearch(parts, parts.whole(), along, query)
        spots.extend(search.found())
        spots.notes = tuple(search.notes)
    return spots


class RangeSearch:
    """Positions in a sweep along one number, ``name``, on the record of its rows."""

    def __init__(self, parts: SweepParts, part: SweepPart, name: str, query: Query) -> None:
        self.part, self.query, self.name = part, query, name
        self.along = Recheck(parts, part)
        self.compiled = part.runner.compiled
        self.record = self.compiled.record
        self.exact = self.along.scenes.exact
        self.roots = self.along.scenes.roots
        values = parts.arrays[name][part.rows]
        self.span = (as_written(values.min()), as_written(values.max()))
        aside = ROUGH * max(1.0, float(np.abs(values).max()))
        self.ends = (float(values.min()) - aside, float(values.max()) + aside)
        """searched from here to there: what lies at the very end of the span may come out beyond it"""
        self.paths = {path: as_written(a[part.rows[0]]) for path, a in parts.columns.paths.items()}
        self.notes: dict[str, None] = {}
        self.places: dict[Decimal, Values | None] = {}
        """the inputs at every place that was looked at, groups solved; None where these have no solution"""
        self.edges: list[Decimal] | None = None
        self.probes: list[Decimal] | None = None
        low, high = map(as_written, self.ends)
        touching = {s: exact for s, exact in self.along.touching(name) if low <= s <= high}
        self.touches = sorted(touching)
        self.rough = Decimal(SAME * self.along.widest)
        """as far off may a place be that doubles alone tell"""
        self.about = {s for s, exact in touching.items() if not exact}

    def found(self) -> list[FoundPosition]:
        """All positions of the kind that is asked, in order."""
        with localcontext(CONTEXT):
            return sorted(self.spots(), key=lambda spot: (spot.at, spot.kind))

    def scene(self, s: Decimal) -> Case:
        """The row at a value as a scene of its own. Raises SceneError where the links do not assemble."""
        numbers = {**self.paths, self.name: s} if self.name in self.paths else self.paths
        with localcontext(CONTEXT):
            try:
                return self.along.scenes.case(self.along.at(self.name, s), numbers)
            except Unreached:
                raise SceneError(Status.CANNOT_ASSEMBLE, APART) from None

    def answer(self, s: Decimal) -> tuple[float, float]:
        """The unknown load at a value [case units], and its derivative by the number."""
        (answer,) = self.compiled.outputs["answers", self.query.load]
        with localcontext(CONTEXT):
            low, here, high = (self._value(answer, s + k * STEP) for k in (-1, 0, 1))
            return float(here), float((high - low) / (2 * STEP))

    def _inside(self, s: Decimal, off: Decimal = NEAR) -> Iterator[Decimal]:
        """A place in the span, which is known so well: an end, where it may be that."""
        low, high = self.span
        if low - off <= s <= high + off:
            yield next((end for end in self.span if abs(s - end) <= off), s)

    def spots(self) -> Iterator[FoundPosition]:
        """All positions of the kind that is asked."""
        load = self.query.load or next((k[1] for k in self.compiled.outputs if k[0] == "answers"), "")
        key = ("answers", load)
        if key not in self.compiled.outputs:
            names = [name for kind, name in self.compiled.outputs if kind == "answers"]
            known = f" ({', '.join(names)})" if names else ", which has none"
            raise RequestError(f"{load or 'an answer'} is no unknown load of this case{known}")
        (answer,) = self.compiled.outputs[key]
        if self.query.kind == "value":
            yield from self._values(answer, load)
        elif self.query.kind == "max":
            yield from (spot for s in self._peaks(answer) for spot in self._pulling(s, "max", load))
        else:
            yield from self._dead(answer, load)

    # --- kinds ------------------------------------------------------------------------------------

    def _values(self, answer: Scalar, load: str) -> Iterator[FoundPosition]:
        """Where the answer takes a value: its numerator less so many times its denominator vanishes; of a
        range that has it throughout the ends."""
        top, bottom = fraction(self.record, answer)
        value = self.record.ratio((*as_written(self.query.value).as_integer_ratio(), 0))
        miss = top - value * bottom
        limits = [s for s, _ in self._limits()]
        places = [*self._zeros(miss), *(s for s in limits if self._is_nothing(miss, s))]
        if self._vanishes(miss) and not self._vanishes(bottom):
            self.notes[HAS.format(load=load)] = None
            places = [*dict.fromkeys((*self.span, *limits))]
        places = [s for s in places if not self._is_nothing(bottom, s)]
        if not self.query.value:
            places += [s for s in self._between_powers(answer, bottom) if s not in places]
        for s in places:
            for spot in self._pulling(s, "value", load):
                yield spot if spot.answer is None else spot._replace(answer=self.query.value)

    def _between_powers(self, answer: Scalar, bottom: Scalar) -> Iterator[Decimal]:
        """Where the answer is zero, its numerator is not and its denominator without bound: what gives the
        links their scale, the motion of one of them, stands still there."""
        size = Decimal(abs(float(answer)) or 1.0)
        for divisor in self._divisors(bottom):
            for s in self._zeros(divisor):
                if all(abs(self._value(answer, s + k * NEAR)) * LARGE < size for k in (-1, 1)):
                    yield s

    def _dead(self, answer: Scalar, load: str) -> Iterator[FoundPosition]:
        """Where the unknown does no work, where the links reach their limit, where branches meet. Where the
        known loads do none either, any value balances, or the quotient goes through: no dead centre."""
        seen: dict[Decimal, Decimal] = {}
        for touch in sorted(self.touches, key=self.about.__contains__):  # those that are exact first
            off = self.rough if touch in self.about else NEAR
            for s in self._inside(touch, off):
                if all(abs(s - other) > off for other in seen):  # several branches may change in one place
                    seen[s] = off
                    yield self._spot(s, "change-point", None, None if off is NEAR else float(off))
        for s, off in self._passages():
            if all(abs(s - other) > off for other in seen):
                seen[s] = off
                yield self._spot(s, "change-point", None, None if off is NEAR else float(off))
        for bottom in self._divisors(answer):
            for s in self._zeros(bottom):
                if self._is_pole(answer, s) and all(abs(s - other) > off for other, off in seen.items()):
                    seen[s] = NEAR
                    yield self._spot(s, "dead", None)
        for s, error in self._limits():
            yield self._spot(s, "limit", load, error)

    def _passages(self) -> Iterator[tuple[Decimal, Decimal]]:
        """Singular positions of groups through which these go on, and how far off they may be."""
        if self._follows_groups:
            for place, exact in self.along.passages():
                off = NEAR if exact else self.rough
                yield from ((s, off) for s in self._inside(place, off))

    def _divisors(self, answer: Scalar) -> Iterator[Traced]:
        """What is divided by on the way to the answer: without its zeros that is bounded."""
        nodes = self.record.nodes
        wanted = [answer.index] if isinstance(answer, Traced) else []
        quotients = (nodes[k] for k in live(self.record.nodes, wanted) if nodes[k].op == Op.DIV)
        for k in dict.fromkeys(node.b for node in quotients if nodes[node.b].row):
            yield nodes[k]

    def _peaks(self, answer: Scalar) -> Iterator[Decimal]:
        """Where the size of the answer is larger than on both sides."""
        if not isinstance(answer, Traced) or not answer.row:
            return
        top, bottom = fraction(self.record, answer)
        probed = [self._value(answer, s) for s in self._probes()]
        same = len(probed) == PROBES and max(probed) - min(probed) <= NOTHING * abs(probed[0])
        if self._vanishes(bottom) or same:
            return

        rise = slope(partial(self._value, answer))
        for low, high, order in self._isolated(top, bottom, peaks=True):
            turns = sorted(zeros_between(rise, low, high, order))
            gaps = [b - a for a, b in pairwise([low, *turns, high]) if b > a]
            for s in turns:
                value, wide = self._value(answer, s), min(gaps) / 1000
                beside = [self._value(answer, s + k * wide) for k in (-1, 1)]
                if all(abs(value) > abs(other) for other in beside) and not self._is_nothing(bottom, s):
                    yield from self._inside(s)

    def _limits(self) -> Iterator[tuple[Decimal, float | None]]:
        """Where the links assemble on one side only; with the error, where it is more than the last digit."""
        if self._follows_groups:  # what lies behind a group may have its own limit before the group's
            yield from (end for end in self._ends if self._assembles(end[0]) or not self._reaches(end[0]))
        seen: list[Decimal] = []
        margins = [node for root in self.roots for node, _ in root.margins]
        for node in dict.fromkeys(
            [*margins, *self.compiled.margins]
        ):  # of a motion, and of a figure read anew
            for s in self._zeros(self.record.nodes[node]):
                here = all(abs(s - other) > NEAR for other in seen)
                if here and self._assembles(s - NEAR) != self._assembles(s + NEAR):
                    seen.append(s)  # of several groups that end in one place
                    yield s, None

    def _assembles(self, s: Decimal) -> bool:
        try:
            given = self.along.at(self.name, s)
            margins = self.exact.margins(self.roots, given)
            margins += self.exact.values([self.record.nodes[k] for k in self.compiled.margins], given)
        except Unreached:
            return False
        return all(m.is_nan() or m >= 0 for m in margins)

    # --- values -----------------------------------------------------------------------------------

    def _value(self, value: Scalar, s: Decimal) -> Decimal:
        """A value at a position, in decimals; not a number where the links do not assemble."""
        if s not in self.places:
            self.places[s] = self._solved(s)
        solved = self.places[s]
        return Decimal("NaN") if solved is None else self.exact.values_at([value], solved)[0]

    def _is_nothing(self, value: Scalar, s: Decimal) -> bool:
        """Whether a value is zero there, beside its terms where the record was made."""
        size = terms_of(self.record.nodes, value.index) if isinstance(value, Traced) else abs(float(value))
        return abs(self._value(value, s)) <= NOTHING * Decimal(size or 1.0)

    def _is_pole(self, answer: Scalar, s: Decimal) -> bool:
        """Whether the answer is without bound beside a place: else both of its powers vanish there."""
        size = Decimal(abs(float(answer)) or 1.0)
        return any(abs(self._value(answer, s + k * NEAR)) > LARGE * size for k in (-1, 1))

    def _vanishes(self, value: Scalar) -> bool:
        """Whether a value is zero in the whole range."""
        probes = self._probes()
        return len(probes) == PROBES and all(self._is_nothing(value, s) for s in probes)

    def _probes(self) -> list[Decimal]:
        """Places that tell whether a value is the same in the whole range: some at which the links assemble;
        too few where hardly any does."""
        if self.probes is None:
            low, high = map(as_written, self.ends)
            tried = (low + (k * GOLDEN + PROBED) % 1 * (high - low) for k in range(MOST_PROBES))
            self.probes = list(islice(filter(self._assembles, tried), PROBES))
        return self.probes

    def _pulling(self, s: Decimal, kind: str, load: str) -> Iterator[FoundPosition]:
        """The position at a value; none where the links do not assemble, and none, and a note, where a rope
        would have to push there."""
        if not (self._assembles(s - NEAR) or self._assembles(s + NEAR)):
            return
        if self.compiled.scene.case.ropes:
            try:
                solve_scene(self.scene(s))
            except SceneError as refusal:
                if refusal.status == Status.SLACK:
                    self.notes[left_out(f"{self.name} = {float(s):.6g}", refusal.message)] = None
                    return
        yield self._spot(s, kind, load)

    def _spot(self, s: Decimal, kind: str, load: str | None, error: float | None = None) -> FoundPosition:
        s = Decimal(0) if abs(s) < NEAR * NEAR else s  # what is told is the scene there
        at, answer = float(s), None
        if load is not None:
            with suppress(SceneError):
                answer = float(by_load(solve_scene(self.scene(s)).answers)[load].value)
        return FoundPosition(at, kind, answer, abs(at) * UNIT if error is None else error)

    # --- zeros ------------------------------------------------------------------------------------

    def _zeros(self, value: Scalar) -> Iterator[Decimal]:
        """All zeros in the range, each once."""
        if not isinstance(value, Traced) or not value.row:
            return
        if self._vanishes(value):
            return
        seen: list[Decimal] = []
        for low, high, order in self._isolated(value, None):
            for s in (s for zero in self._of_cell(value, low, high, order) for s in self._inside(zero)):
                if all(abs(s - other) > NEAR * NEAR for other in seen):
                    seen.append(s)
                    yield s

    def _of_cell(self, value: Traced, low: Decimal, high: Decimal, order: int) -> Iterator[Decimal]:
        """The zeros of a cell, as `zeros_between`."""
        if all(self._is_nothing(value, s) for s in (low, (low + high) / 2, high)):
            return  # three zeros are more than it has: it vanishes all over the cell, and has no sign there
        yield from zeros_between(partial(self._value, value), low, high, order)

    # --- cells ------------------------------------------------------------------------------------

    @property
    def _follows_groups(self) -> bool:
        return self.part.followed is not None and bool(self.part.followed.tracker.segments)

    def _isolated(
        self, value: Scalar, bottom: Scalar | None, peaks: bool = False
    ) -> Iterator[tuple[Decimal, Decimal, int]]:
        """Cells that may hold a zero, and the order of the derivative that keeps its sign in each: 1 where
        the function is monotone, 2 where its slope is, `MOST_ORDER` where no bound shows which (of a
        quotient's slope, where ``peaks``)."""
        wanted = [v for v in (value, bottom) if v is not None]
        by = self._by_places if self._follows_groups else self._by_bounds
        cuts = [as_written(self.ends[0]), *self.touches, as_written(self.ends[1])]
        for first, last in pairwise(cuts):
            beside = Decimal(BESIDE * self.along.widest)
            low = first + beside if first in self.touches else first
            high = last - beside if last in self.touches else last
            if low < high:
                yield from by(wanted, peaks, float(low), float(high))
            for touch, away in ((first, 1), (last, -1)):
                if touch in self.touches:
                    self.notes[RINGED] = None
                    wide = min(beside, (last - first) / 2)
                    ring = [touch + away * wide / 2**n for n in range(RINGS)]
                    yield from ((min(pair), max(pair), 1) for pair in pairwise(ring))

    def _by_bounds(
        self, wanted: Sequence[Scalar], peaks: bool, first: float, last: float
    ) -> Iterator[tuple[Decimal, Decimal, int]]:
        """By bounds of the function over whole cells, cut until each is decided."""
        given = self._reached(first, last)
        if given is None:
            return
        main = self.compiled.inputs[self.name]
        radicands = [*(root.radicand for root in self.roots), *self.compiled.margins]
        nodes = [self.record.lifted(v).index for v in wanted]
        inputs = {k: float(v) for k, v in given.items()}
        cells = Cells(self.record, [*nodes, *radicands], main, inputs)
        edges = np.linspace(first, last, CELLS + 1)
        mid, half = (edges[:-1] + edges[1:]) / 2.0, np.diff(edges) / 2.0
        seen, narrow, open_ = 0, (last - first) * NARROW, 0
        found: list[tuple[Decimal, Decimal, float, int]] = []
        while mid.size:
            seen += mid.size
            if seen > MOST_CELLS:
                open_ += mid.size
                break
            whole, points = cells.run(mid, half)
            there, inside = np.ones((2, len(mid)), dtype=bool)
            for radicand in whole[len(nodes) :]:
                there &= ~(radicand.value.mid < -radicand.value.rad)
                inside &= radicand.value.excludes_zero
            for one in whole[: len(nodes)]:
                inside &= np.isfinite(one.second.mid) & np.isfinite(one.second.rad)
            decide = _decided_peak if peaks else _decided
            empty, rises, bent = decide(whole[: len(nodes)], points[: len(nodes)], half)
            decided = (rises != 0.0) | bent
            done = ~there | empty | decided
            tangled = ~done & (half <= narrow) & inside  # beside an end there are no bounds, nor zeros
            for k in np.flatnonzero((there & ~empty & decided) | tangled):
                low, high = as_written(mid[k] - half[k]), as_written(mid[k] + half[k])
                order = MOST_ORDER if tangled[k] else 1 if rises[k] else 2
                found.append((low, high, float(rises[k]), order))
            if tangled.any():
                self.notes[TANGLED] = None
            left = np.flatnonzero(~done & (half > narrow))
            mid, half = (
                np.concatenate([mid[left] - half[left] / 2.0, mid[left] + half[left] / 2.0]),
                np.concatenate([half[left], half[left]]) / 2.0,
            )
        if open_:
            self.notes[UNSHOWN.format(count=open_)] = None
        runs: list[tuple[Decimal, Decimal, float, int]] = []
        # cells side by side in which it rises, or falls, are one
        for low, high, sign, order in sorted(found):
            side = bool(runs) and low - runs[-1][1] <= Decimal(narrow / 2.0)
            if side and order != 2 and (sign, order) == runs[-1][2:]:
                runs[-1] = (runs[-1][0], high, sign, order)
            else:
                runs.append((low, high, sign, order))
        yield from ((low, high, order) for low, high, _, order in runs)

    def _reached(self, first: float, last: float) -> Mapping[int, Decimal] | None:
        """The inputs at a place between two; None where the links reach one another at none that is tried."""
        for share in WITHIN:
            with suppress(Unreached):
                return self.along.at(self.name, as_written(first + share * (last - first)))
        return None

    # --- groups -----------------------------------------------------------------------------------

    def _by_places(
        self, wanted: Sequence[Scalar], peaks: bool, first: float, last: float
    ) -> Iterator[tuple[Decimal, Decimal, int]]:
        """By the function and its slope at many places, toward a limit each half as far from it."""
        limits = [s for s in self._edges() if first < s < last]
        rings = (last - first) / PLACES * 0.5 ** np.arange(RINGS)
        beside = [float(limit) + np.r_[-rings, rings] for limit in limits]
        at = np.unique(np.concatenate([np.linspace(first, last, PLACES + 1), *beside]))
        at = at[(first <= at) & (at <= last)]
        self.notes[SEARCHED.format(count=PLACES)] = None
        values, slopes = zip(*(self._sampled(v, at) for v in wanted), strict=True)
        if peaks:
            f = slopes[0] * values[1] - values[0] * slopes[1]
            turns = np.zeros(len(at) - 1, dtype=bool)
        else:
            f = values[0]
            turns = _may_touch(f, slopes[0], np.diff(at))
        changes = f[:-1] * f[1:] <= 0.0
        for k in np.flatnonzero(changes | turns):
            yield as_written(at[k]), as_written(at[k + 1]), 1 + int(turns[k])
        good = np.isfinite(f)
        for end, side in product(() if peaks else limits, (-1, 1)):  # doubles stop short of a limit
            beyond = good & ((at - float(end)) * side > 0.0)
            if beyond.any():
                there, k = end + side * NEAR, np.argmin(np.where(beyond, np.abs(at - float(end)), np.inf))
                if f[k] * float(self._value(wanted[0], there)) <= 0.0:
                    yield min(as_written(at[k]), there), max(as_written(at[k]), there), 1

    def _sampled(self, value: Scalar, at: Array) -> tuple[Array, Array]:
        """A value and its slope at places; not a number where the links do not assemble."""
        if not isinstance(value, Traced) or not value.row:
            return np.full(len(at), float(value)), np.zeros(len(at))
        passes, main = self.part.runner.passes([value.index]), self.compiled.inputs[self.name]
        found, slope = np.full(len(at), np.nan), np.full(len(at), np.nan)
        for start in range(0, len(at), passes.rows):
            here = slice(start, start + passes.rows)
            given, good = self.along.floats(self.name, at[here])
            (passed,) = passes.run(given, len(at[here]))
            found[here] = np.where(good, passes.value(value.index, len(good)), np.nan)
            slope[here] = np.where(good, passed.by.get(main, np.zeros(len(good))), np.nan)
        return found, slope

    @cached_property
    def _ends(self) -> list[tuple[Decimal, float]]:
        return list(self._ends_of_groups())

    def _edges(self) -> list[Decimal]:
        """All limits, and ends of groups; while those beside the latter are looked for, these."""
        if self.edges is None:
            self.edges = [s for s, _ in self._ends]
            self.edges = list(dict.fromkeys((*self.edges, *(limit for limit, _ in self._limits()))))
        return self.edges

    def _ends_of_groups(self) -> Iterator[tuple[Decimal, float]]:
        """Where groups are followed no further: about where by the steps, which stop short of it, and the
        nearest double by decimals, which tell whether the links reach a place along the same path."""
        tracker = self.along.tracker
        assert tracker is not None
        for segment, end, sense in tracker.limits():
            with self.along.on(segment):
                last, beyond = self._limit(end - sense * tracker.slack, end + 3.0 * sense * tracker.slack)
            error = abs(beyond - last)
            yield from ((s, error) for s in self._inside(as_written(last), Decimal(error)))

    def _limit(self, inside: float, outside: float) -> tuple[float, float]:
        """The last double at which the links reach one another, and the next; another way of assembling that
        lies beyond is none."""
        if not self._reaches(inside) or self._reaches(outside):
            return inside, outside
        while True:
            last, beyond = last_that_holds(self._reaches, inside, outside, vanishing=self._determinants)
            between = np.linspace(inside, last, BETWEEN)[1:-1].tolist()
            gap = next((s for s in between if not self._reaches(s)), None)
            if gap is None:
                return last, beyond
            outside = gap

    def _reaches(self, s: float | Decimal) -> bool:
        """Whether the links of groups reach one another at a value."""
        return self._solved(as_written(s) if isinstance(s, float) else s) is not None

    def _determinants(self, s: float) -> float | None:
        """The product of the squares of the groups' determinants: at a fold one vanishes like the root of the
        distance. None where a group has equations to spare."""
        solved = self._solved(as_written(s))
        groups = self.record.implicit
        if solved is None or not all(group.is_square for group in groups):
            return None
        guesses = {guess: solved[k] for g in groups for guess, k in zip(g.guesses, g.solved, strict=True)}
        return float(math.prod(self.exact.determinant(g, {**solved, **guesses}) for g in groups) ** 2)

    def _solved(self, s: Decimal) -> Values | None:
        """The inputs with the groups' unknowns at a value; None where links do not reach one another."""
        with suppress(Unreached):
            return self.exact.solved(self.along.at(self.name, s))
        return None


LARGE = Decimal("1e12")
"""So many times larger than elsewhere an answer is so near to its pole."""
BESIDE = 2.0**-4
"""This part of the longest step to both sides of a change point, where no bound is tight, is searched in"""
RINGS = 24
"""rings, each half as far from it."""
PROBES, MOST_PROBES = 3, 89
"""Whether a value is the same throughout is asked at so many places, of so many that are tried,"""
PROBED, GOLDEN = Decimal("0.2137"), Decimal("0.6180339887")
"""each this part of the range from the last, from the first on: they lie ever closer, and evenly."""
ROUGH = 1e-12
"""So much farther than the span is searched, of its values: more than doubles round."""
BETWEEN = 18
"""Places up to a limit at which it is looked whether the links reach one another all the way."""
UNSHOWN = (
    "{count} parts of the range are left undecided: there the bounds are too wide to show what is there."
)
RINGED = (
    "beside a change point, where no bound shows what is there, the range was searched in rings, each half "
    "as far from it: two positions in one ring may be missed."
)
TANGLED = (
    "where no bound tells how the answer runs, beside a limit or where its slopes all but vanish with it, "
    "positions were looked for between those in which its derivatives vanish, up to the sixth."
)
SEARCHED = (
    "a group of links has to be placed by Newton's method, or turns to be counted: the range was searched at "
    "{count} places, and two positions between two of them may be missed."
)


def _may_touch(f: Array, slope: Array, step: Array) -> Mask:
    """Between which places a function that turns may reach zero: there its tangents meet beyond it."""
    (a, b), (p, q) = (f[:-1], f[1:]), (slope[:-1], slope[1:])
    with np.errstate(all="ignore"):
        along = (b - a - q * step) / (p - q)
        meet = a + p * along
    return np.asarray((p * q <= 0.0) & (a * b > 0.0) & (meet * a <= 0.5 * a * a))


def _decided(whole: Sequence[Jet], points: Sequence[Jet], half: Array) -> tuple[Mask, Array, Mask]:
    """Cells without a zero; the sign of the slope where the function is monotone, else 0; whether the slope
    is monotone."""
    (cell,), (at,) = whole, points
    bend = np.abs(cell.second.mid) + cell.second.rad
    slope = np.abs(at.first.mid) + at.first.rad
    with np.errstate(all="ignore"):
        reach = slope * half + bend * half * half / 2.0
        empty = cell.value.excludes_zero | (np.abs(at.value.mid) - at.value.rad > reach)
        single = cell.first.excludes_zero | (np.abs(at.first.mid) - at.first.rad > bend * half)
    return empty, np.where(single, np.sign(at.first.mid), 0.0), cell.second.excludes_zero


def _decided_peak(whole: Sequence[Jet], points: Sequence[Jet], half: Array) -> tuple[Mask, Array, Mask]:
    """The same for the numerator of a quotient's slope."""
    with np.errstate(all="ignore"):  # what is unbounded in a cell leaves it undecided
        wide, narrow = _wronskian(*whole), _wronskian(*points)
        reach = (np.abs(wide[1].mid) + wide[1].rad) * half
        empty = wide[0].excludes_zero | (np.abs(narrow[0].mid) - narrow[0].rad > reach)
    rises = np.where(wide[1].excludes_zero, np.sign(wide[1].mid), 0.0)
    return empty, rises, np.zeros_like(empty)


def _wronskian(top: Jet, bottom: Jet) -> tuple[BallArray, BallArray]:
    """``n' d - n d'``, which is zero where n / d has no slope, and its derivative."""
    first = top.first * bottom.value - top.value * bottom.first
    return first, top.second * bottom.value - top.value * bottom.second


def fraction(record: Record, value: Scalar) -> tuple[Scalar, Scalar]:
    """A value as numerator and denominator: the quotient that it is, times constants."""
    if not isinstance(value, Traced) or not value.row:
        return value, 1.0
    node = record.nodes[value.index]
    a, b = record.nodes[node.a], record.nodes[node.b]
    if node.op == Op.NEG:
        top, bottom = fraction(record, a)
        return -top, bottom
    if node.op == Op.DIV and b.row:
        return a, b
    if node.op == Op.DIV:
        top, bottom = fraction(record, a)
        return top / b, bottom
    if node.op == Op.MUL and a.row != b.row:
        moving, still = (a, b) if a.row else (b, a)
        top, bottom = fraction(record, moving)
        return top * still, bottom
    return value, 1.0
