"""Branches: the modes of a figure followed along the free datum, straight on through change points.

They are sampled evenly, and once more wherever between two samples a mode assembles at which it does not, or
ends and begins again.

Zeros of the power of the loads over the whole range of it are enclosed in intervals first, then closed in on:
the range is cut into cells. A cell on which the figure nowhere assembles, or whose enclosure of the power
does not hold zero, has no position; one on which the figure assembles and the power's derivative keeps its
sign has one at most, told by the signs at its ends; the others are halved. Nothing is missed but in cells
that stay open to the last, which are handed on.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from decimal import Decimal, localcontext
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from icsolve.case import Case
from icsolve.numbers.decimals import CONTEXT, as_written
from icsolve.numbers.intervals import Interval, enclose
from icsolve.numbers.replay import Array, Code
from icsolve.solve.load_function import EVEN, LoadFunction, nearest
from icsolve.solve.refinement import plain_within
from icsolve.sweep.branches import DOUBT, may_vanish
from icsolve.sweep.exact_record import Unreached, exact_record, lowest, open_by
from icsolve.tuples import NamedTuple

SAMPLES = 720
ZOOMS = 5
"""So many times the place where a margin is lowest is looked for sixteen times more closely."""
ROUND = 1e-3
"""To so much of its size a figure is the same beside both ends of a whole turn, at a limit too."""
CLOSER = 3
"""So many times the place where a branch comes nearest to `near` is looked for eight times more closely."""
CONTRARY = -2
"""In place of a branch that contradicts data which no step needs."""
DRAWN = 1e-14
"""Of several that pass through `near` one does so at a value of few decimals, as it was drawn: to so much of
the figure."""


class Branches:
    """The modes sampled from ``low`` to ``high``, and which samples one varying figure joins."""

    def __init__(self, functions: Sequence[LoadFunction], low: float, high: float) -> None:
        self.functions, self.low, self.high = functions, low, high
        self.names = [name for name in functions[0].places if all(name in f.places for f in functions)]
        self.slack = 1e-9 * (high - low)
        self.open = open_by(functions[0].compiled.scene.case, functions[0].compiled.scene.frame.scale)
        even = np.linspace(low, high, SAMPLES + 1)
        self.values = np.unique([*even, *self._turned_over(even)])
        beside = np.append(self.values[:-1] + self.slack, high - self.slack)  # where loci coincide none meet
        self.places = np.array([self._places(f, beside) for f in functions])  # (mode, sample, 2 points)
        self.whole, self.untold = self._assemble(self.values)  # (modes, samples)
        self.whole[:, [0, -1]] &= self.assemble(np.array([low + self.slack, high - self.slack]))
        some = np.flatnonzero(self.untold.any(axis=0))
        self.whole[:, some] &= ~self.untold[:, some] | self.assemble(beside[some])
        self.ids = self._followed()
        if functions[0].compiled.motion is None:
            self._leave_out_contrary()

    def _turned_over(self, even: Array) -> list[float]:
        """Values between two of the even ones at both of which a mode assembles, and there it does not, or
        the other way round."""
        whole, _ = self._assemble(even)
        extreme = [(n, x) for n, f in enumerate(self.functions) for x in _extremes(f, even, whole[n])]
        if not extreme:
            return []
        there, _ = self._assemble(np.array([x for _, x in extreme]))
        before = np.searchsorted(even, [x for _, x in extreme]) - 1
        return [x for k, (n, x) in enumerate(extreme) if there[n, k] != whole[n, before[k]]]

    def _leave_out_contrary(self) -> None:
        """Mark the branches that contradict data which no step needs, but for places where they pass through
        agreement."""
        agree = np.array([function.agrees(self.values) for function in self.functions])
        own = [self.ids == branch for branch in np.unique(self.ids[self.ids >= 0])]
        contrary = [some for some in own if 2 * np.mean(agree[some]) < 1]
        for some in contrary if len(contrary) < len(own) else ():
            self.ids[some] = CONTRARY

    def _places(self, function: LoadFunction, values: Array) -> Array:
        nodes = [k for name in self.names for k in function.places[name]]
        found = Code(function.record, nodes).run(function.given(values), len(values))
        columns = [np.array(np.broadcast_to(v, len(values))) for v in found]
        ox, oy, scale = function.compiled.scene.frame
        origin = np.tile([ox, oy], len(self.names))
        return np.array(np.stack(columns, axis=1) / scale + origin)

    def assemble(self, values: Array) -> npt.NDArray[np.bool_]:
        """Whether each mode assembles at each value (modes, n); of margins about zero decimals say it."""
        whole, untold = self._assemble(values)
        return whole & ~untold

    def _assemble(self, values: Array) -> tuple[npt.NDArray[np.bool_], npt.NDArray[np.bool_]]:
        """The same by the margins that have a value, and where some have none, as loci coincide."""
        whole = np.ones((len(self.functions), len(values)), dtype=bool)
        untold = np.zeros_like(whole)
        for n, function in enumerate(self.functions):
            found = Code(function.record, function.margins).run(function.given(values), len(values))
            for node, margin in zip(function.margins, found, strict=True):
                untold[n] |= np.isnan(margin)
                holds = np.array(np.broadcast_to(~(margin < 0.0), len(values)))
                for k in np.flatnonzero(~holds & np.broadcast_to(margin > -DOUBT, len(values))):
                    least = _exactly(function, node, as_written(values[k]))
                    holds[k] = not least.is_nan() and least >= -self.open
                whole[n] &= holds
        return whole, untold

    def _followed(self) -> npt.NDArray[np.int64]:
        """The branch of every sample of every mode; -1 where it does not assemble."""
        modes, samples = self.whole.shape
        ids = np.full((modes, samples), -1, dtype=np.int64)
        ids[:, 0] = np.where(self.whole[:, 0], np.arange(modes), -1)
        count, plain, same = modes, self._goes_straight_on(), True
        for k in range(1, samples):
            if plain[k - 1] and same:
                ids[:, k] = ids[:, k - 1]
                continue
            taken: dict[int, int] = {}
            for m in range(modes):
                if ids[m, k - 1] < 0:
                    continue
                ahead = self._ahead(ids, m, k)
                off = np.where(self.whole[:, k], np.abs(self.places[:, k] - ahead).max(axis=1), np.inf)
                off[list(taken)] = np.inf
                n = int(np.argmin(off))
                stays = self.whole[m, k] and m not in taken
                stays = stays and not (self.untold[m, k] and self._turns_over(m, m, k, ahead))
                if off[n] < np.inf and (not stays or off[n] < 0.25 * off[m]):
                    meets = self._meets(m, n, k, ahead)
                    if meets < 0 and not self.whole[m, k]:
                        continue  # it ends, whatever another does
                    taken[m if meets > 0 else n] = int(ids[m, k - 1]) if meets >= 0 else -1
                elif stays:
                    taken[m] = int(ids[m, k - 1])
            for n in range(modes):
                if not self.whole[n, k]:
                    continue
                if taken.get(n, -1) >= 0:
                    ids[n, k] = taken[n]
                else:
                    ids[n, k], count = count, count + 1
            same = np.array_equal(ids[:, k], ids[:, k - 1])
        return self._closed(ids)

    def _goes_straight_on(self) -> npt.NDArray[np.bool_]:
        """Between which samples, (samples - 1,), no other mode lies where one is heading: all keep to their
        branches there, if they did before."""
        here, there = self.places[:, :-1], self.places[:, 1:]
        steps = np.diff(self.values)
        grown = (steps[1:] / steps[:-1])[:, np.newaxis]
        ahead = np.concatenate([here[:, :1], here[:, 1:] + grown * (here[:, 1:] - here[:, :-1])], axis=1)
        stays = (self.whole[:, 1:] == self.whole[:, :-1]).all(axis=0)
        for m in range(len(ahead)):
            with np.errstate(invalid="ignore"):  # of modes that do not assemble
                off = np.where(self.whole[:, 1:], np.abs(there - ahead[m]).max(axis=2), np.inf)
            stays &= ~(self.whole[m, 1:] & (off < 0.25 * off[m]).any(axis=0))
        return np.asarray(stays)

    def _ahead(self, ids: npt.NDArray[np.int64], m: int, k: int) -> Array:
        """Where a branch would be at the next sample, going straight on."""
        here = self.places[m, k - 1]
        if k < 2:
            return np.asarray(here)
        before = np.flatnonzero(ids[:, k - 2] == ids[m, k - 1])
        if not before.size:
            return np.asarray(here)
        steps = np.diff(self.values, append=self.values[-1] + self.values[1] - self.values[0])
        return np.asarray(here + steps[k - 1] / steps[k - 2] * (here - self.places[before[0], k - 2]))

    def _meets(self, m: int, n: int, k: int, ahead: Array) -> int:
        """Between two samples: 0 where a branch passes from one mode to another that it meets there, 1 where
        it turns back before it does, and -1 where it ends. A figure goes straight on, too, where one mode of
        it ends and the other begins: a ray turns over where its point passes another."""
        if m == n:
            return 0
        if not (self.whole[m, k] and self.whole[n, k - 1]):
            ends = not (self.whole[m, k] or self.whole[n, k - 1])
            return 0 if ends and not self._turns_over(m, n, k, ahead) else -1
        gap = min(np.abs(self.places[m, j] - self.places[n, j]).max() for j in (k - 1, k))
        step = np.abs(self.places[m, k] - self.places[m, k - 1]).max()
        return self._margin(m, k) if gap <= 4.0 * step else -1

    def _turns_over(self, m: int, n: int, k: int, ahead: Array) -> bool:
        """Whether a mode is elsewhere at a sample than where one was heading from that before."""
        step = np.abs(self.places[n, k] - self.places[m, k - 1]).max()
        return not np.abs(self.places[n, k] - ahead).max() <= 0.25 * step

    def _margin(self, m: int, k: int) -> int:
        """Between two samples the sign of the margins of a mode that come near to zero, by the decimals as
        written; 0 where one vanishes, or none comes near."""
        signs = [sign for sign, _ in self._lowest_margins(m, k)]
        return 0 if 0 in signs else min(signs, default=0)

    def _lowest_margins(self, m: int, k: int) -> Iterator[tuple[int, float]]:
        """Between two samples the margins of a mode that come near to zero: the sign of each where it is
        lowest, and where that is."""
        function = self.functions[m]
        exact, record = exact_record(function.compiled), function.record
        for node in function.margins:
            near = self._lowest(function, node, float(self.values[k - 1]), float(self.values[k]))
            if near is None:
                continue
            reach = Decimal(float(self.values[k] - self.values[k - 1]))

            def margin(at: Decimal, node: int = node) -> Decimal:
                return exact.values([record.nodes[node]], _given(function, at))[0]

            found = []
            for smooth in (margin, lambda at: margin(at) ** 2):  # one with a corner is smooth in its square
                with localcontext(CONTEXT), suppress(Unreached):
                    at = lowest(smooth, near, reach)
                    at = as_written(near) if at is None else at
                    least = margin(at)
                    found += [(abs(least), least, float(at))] if not least.is_nan() else []
            if found:
                size, least, place = min(found)
                yield (0 if not size > self.open else 1 if least > 0 else -1), place

    def _lowest(self, function: LoadFunction, node: int, low: float, high: float) -> float | None:
        """About where a margin is lowest between two values; None where it cannot vanish there."""
        code = Code(function.record, [node])
        for zoom in range(ZOOMS):
            values = np.linspace(low, high, 33)
            margin = np.broadcast_to(code.run(function.given(values), len(values))[0], len(values))
            if not zoom and not may_vanish(margin):
                return None
            k = int(np.argmin(margin))
            low, high = float(values[max(k - 1, 0)]), float(values[min(k + 1, 32)])
        return float(values[k])

    def _closed(self, ids: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
        """A whole turn ends where it begins, where nothing rolls on: what goes straight on there is one
        branch."""
        if self.high - self.low != 360.0 or not self.functions[0].turns_links or not self._comes_round():
            return ids
        for m in np.flatnonzero(ids[:, -1] >= 0).tolist():
            ahead = self._ahead(ids, m, len(self.values))
            off = np.where(self.whole[:, 1], np.abs(self.places[:, 1] - ahead).max(axis=1), np.inf)
            n = int(np.argmin(off))
            margin = self._margin(m, 1) if n != m and self.whole[m, 0] and np.isfinite(off[n]) else 0
            n = int(m) if margin > 0 else n
            if self.whole[m, 0] and np.isfinite(off[n]) and margin >= 0:
                ids[ids == ids[m, -1]] = ids[n, 1]
        return ids

    def _comes_round(self) -> bool:
        """Whether a whole turn leads back to the same figure in the modes that assemble at both ends."""
        both = self.whole[:, 0] & self.whole[:, -1]
        gap = np.abs(self.places[both, -1] - self.places[both, 0])
        return not gap.size or float(gap.max()) <= ROUND / self.functions[0].compiled.scene.frame.scale

    def islands(self, m: int, branch: int) -> frozenset[int]:
        """The branches of a mode at the values to which another branch does not lead in any mode."""
        away = ~(self.ids == branch).any(axis=0)
        return frozenset(self.ids[m, away].tolist()) - {-1}

    def samples(self, branch: int) -> list[tuple[int, float]]:
        """The sampled modes and values of a branch, by rising value."""
        pairs = sorted((int(k), int(m)) for m, k in np.argwhere(self.ids == branch))
        return [(m, float(self.values[k])) for k, m in pairs]

    def parts(self, m: int, without: frozenset[int]) -> list[tuple[float, float]]:
        """Where a mode is on none of some branches: between change points, and to the ends of the range."""
        if not without & set(self.ids[m].tolist()):
            return [(self.low - self.slack, self.high + self.slack)]
        left = [int(i) in without for i in self.ids[m]]
        cuts = [k for k in range(len(left) - 1) if left[k] != left[k + 1]]
        ends = [self.low, *(self._change_point(m, k, left[k]) for k in cuts), self.high]
        return [(a, b) for n, (a, b) in enumerate(pairwise(ends)) if left[0] == bool(n % 2) and a < b]

    def _change_point(self, m: int, k: int, first: bool) -> float:
        """Between two samples, where a mode comes nearest to the one that takes on its branch."""
        others = [n for n in range(len(self.ids)) if n != m and self.ids[n, k + 1] == self.ids[m, k]]
        if not others:
            return float(self.values[k if first else k + 1])
        met = [place for sign, place in self._lowest_margins(m, k + 1) if not sign]
        if met:
            return met[0]
        low, high = float(self.values[k]), float(self.values[k + 1])
        while True:
            values = np.linspace(low, high, 33)
            one, two = (self._places(self.functions[n], values) for n in (m, others[0]))
            least = int(np.argmin(np.abs(one - two).max(axis=1)))
            closer = float(values[max(least - 1, 0)]), float(values[min(least + 1, 32)])
            if closer[1] - closer[0] >= 0.5 * (high - low):
                return 0.5 * (low + high)
            low, high = closer

    def assembling(self, m: int) -> list[float]:
        """The sampled values at which a mode assembles."""
        found: list[float] = self.values[self.whole[m]].tolist()
        return found

    def on(self, m: int, value: float) -> int:
        """The branch of a mode at a value."""
        k = int(np.clip(np.searchsorted(self.values, value, side="right") - 1, 0, len(self.values) - 2))
        one, two = int(self.ids[m, k]), int(self.ids[m, k + 1])
        if one == two == CONTRARY:
            return one
        if one != two and -1 not in (one, two):
            return one if value <= self._change_point(m, k, True) else two
        beside = self.ids[m, max(k - 1, 0) : k + 3].tolist()
        return max(one, two) if max(one, two) >= 0 else next((int(i) for i in beside if i >= 0), -1)

    def nearest(self, case: Case, among: frozenset[int] | None = None) -> frozenset[int]:
        """The branch (of some: None: of all) that passes nearest to `near` at any value.

        Raises SceneError where two are about equally near.
        """
        meant = {2 * self.names.index(name): at for name, at in case.near.items() if name in self.names}

        def off(places: Array) -> Array:
            columns = ((k + axis, at[axis]) for k, at in meant.items() for axis in (0, 1))
            squares = [(places[..., k] - c) ** 2 for k, c in columns]
            return np.asarray(np.sqrt(np.sum(squares, axis=0)))

        sampled = np.where(self.whole, off(self.places), np.inf) if meant else np.zeros(self.whole.shape)
        every = [int(i) for i in np.unique(self.ids) if i >= 0]
        ids = [i for i in every if among is None or i in among]
        best, drawn, rough = [], [], 0.0
        for i in ids:
            best_one = int(np.argmin(np.where(self.ids == i, sampled, np.inf)))
            m, k = divmod(best_one, len(self.values))
            least, at, step = float(sampled[m, k]), float(self.values[k]), (self.high - self.low) / SAMPLES

            def along(values: Array, i: int = i, m: int = m) -> Array:
                there = off(self._places(self.functions[m], values))
                return np.where([self.on(m, float(v)) == i for v in values], there, np.nan)

            for _ in range(CLOSER if meant else 0):
                values = np.clip(np.linspace(at - step, at + step, 33), self.low, self.high)
                there = np.nan_to_num(along(values), nan=np.inf)
                least, at = min((least, at), (float(there.min()), float(values[np.argmin(there)])))
                step /= 8.0
            if meant:
                sides = (at - 8.0 * step, at + 8.0 * step, at - step, at + step)
                there = along(np.array([*sides, plain_within(at, step)]))
                wide, close = np.nan_to_num(np.abs(there[:4] - least), nan=0.0).reshape(2, 2)  # it may end
                goes_on = close <= 0.5 * wide  # where its steps do not shrink a mode passes to another place
                rough = max(rough, float(close[goes_on].max(initial=0.0)))  # it may come nearer between
                drawn += [i] if there[4] <= DRAWN * np.nanmax(np.abs(self.places)) else []
            best.append(least)
        even = [i for i, d in zip(ids, best, strict=True) if EVEN * max(d, rough) <= max(min(best), rough)]
        if len(even) > 1 and len(drawn) == 1:
            return frozenset(drawn)
        return frozenset({ids[nearest(case, best, rough)]})


def _given(function: LoadFunction, value: Decimal) -> dict[int, Decimal]:
    """The inputs of a mode at a decimal of its free number."""
    given = function.given(np.array([float(value)]))
    return {node: Decimal(float(at[0])) for node, at in given.items()} | {function.input: value}


def _exactly(function: LoadFunction, node: int, value: Decimal) -> Decimal:
    """A node of a mode in all digits; not a number where the figure before it does not assemble."""
    with localcontext(CONTEXT), suppress(Unreached):
        (found,) = exact_record(function.compiled).values(
            [function.record.nodes[node]], _given(function, value)
        )
        return found
    return Decimal("NaN")


def _extremes(function: LoadFunction, values: Array, whole: npt.NDArray[np.bool_]) -> list[float]:
    """Where between some values the least of a mode's margins is extreme, and has another sign than at the
    two about it."""

    if not function.margins:
        return []
    code = Code(function.record, function.margins)

    def level(at: Array, side: Array) -> Array:
        found = code.run(function.given(at.ravel()), at.size)
        margins = [np.broadcast_to(margin, at.size).reshape(at.shape) for margin in found]
        return np.asarray(np.nan_to_num(side * np.fmin.reduce(margins), nan=-np.inf))

    side = np.where(whole, -1.0, 1.0)
    off = np.append(level(values, side), -np.inf)  # also of what is before the first
    same = np.append(whole[1:] == whole[:-1], False)  # as the next one
    k = np.arange(len(values))
    before, after = (np.where(on, off[at], -np.inf) for on, at in ((same[k - 1], k - 1), (same, k + 1)))
    k = np.flatnonzero((off[:-1] > before) & (off[:-1] >= after))
    if not k.size:
        return []
    low, high, side = values[k - same[k - 1]], values[k + same[k]], side[k]
    here = values[k]
    for _ in range(ZOOMS):
        places = np.linspace(low, high, 33)
        top = np.argmax(level(places, side), axis=0)
        low, here, high = (
            np.take_along_axis(places, np.clip(top + n, 0, 32)[np.newaxis], axis=0)[0] for n in (-1, 0, 1)
        )
    found: list[float] = here[level(here, side) > 0.0].tolist()
    return found


CELLS = 256

HALVINGS = 46

MOST_CELLS = 4096

POINTLIKE = 1e-3
"""Open cells that together take less than this fraction of the range lie about single points."""


class Enclosed(NamedTuple):
    """Brackets with one position each; clusters of cells that stay open; whether none is too wide to look
    into; and where in those that are the power changes its sign, perhaps where it is 0."""

    brackets: list[tuple[float, float]]
    open_cells: list[tuple[float, float]]
    complete: bool
    changes: list[tuple[float, float]]


def isolate(function: LoadFunction, low: float, high: float) -> Enclosed:
    """The zeros of a mode's power from ``low`` to ``high``."""
    edges = np.linspace(low, high, CELLS + 1)
    edges[1:-1] += (high - low) / CELLS * 0.0137  # not on the round numbers where symmetric figures rest
    cells = Interval(edges[:-1].copy(), edges[1:].copy())
    brackets: list[tuple[float, float]] = []
    complete = True
    level: list[Interval] = []
    crowds: list[tuple[float, float]] = []
    changes: list[tuple[float, float]] = []
    for _ in range(HALVINGS):
        look = look_into(function, cells)
        cells = look.left
        brackets += look.brackets
        level.append(look.level)
        if cells.low.size > MOST_CELLS:
            complete &= float(np.sum(cells.high - cells.low)) <= POINTLIKE * (high - low)
            cells, crowded = _without_crowds(cells)
            crowds += _clusters(*_in_order(crowded))
            changes += _sign_changes(function, crowded)
        if not cells.low.size:
            break
        middle = 0.5 * (cells.low + cells.high)
        inside = (middle > cells.low) & (middle < cells.high)
        if not inside.any():
            break
        cells = Interval(
            np.concatenate([cells.low, middle[inside]]),
            np.concatenate([np.where(inside, middle, cells.high), cells.high[inside]]),
        )
    complete &= sum(float(np.sum(one.high - one.low)) for one in level) <= POINTLIKE * (high - low)
    open_cells = _clusters(
        *_in_order(Interval(*(np.concatenate(ends) for ends in zip(cells, *level, strict=True))))
    )
    return Enclosed(sorted(brackets), sorted([*open_cells, *crowds]), complete, sorted(changes))


def _without_crowds(cells: Interval) -> tuple[Interval, Interval]:
    """The cells but those of which the most lie side by side, as around a place where points of the figure
    coincide: no halving decides these, and they would take the others' turn; and these."""
    low, high = _in_order(cells)
    clusters = np.cumsum(np.append(False, low[1:] > high[:-1]))
    sizes = np.bincount(clusters)
    largest = np.argsort(-sizes)
    many = np.cumsum(sizes[largest][::-1])[::-1] > MOST_CELLS // 4
    crowded = np.isin(clusters, largest[many])
    return Interval(low[~crowded], high[~crowded]), Interval(low[crowded], high[crowded])


def _sign_changes(function: LoadFunction, cells: Interval) -> list[tuple[float, float]]:
    """The cells at whose ends the power has unlike signs."""
    places = np.concatenate([cells.low, cells.high])
    (power,) = enclose(function.record, [function.power], function.enclosed(Interval(places, places)))
    low, high = np.split(_signs(Interval(*(np.broadcast_to(side, places.shape) for side in power))), 2)
    other = low * high < 0
    return list(zip(cells.low[other].tolist(), cells.high[other].tolist(), strict=True))


def _in_order(cells: Interval) -> tuple[Array, Array]:
    order = np.argsort(cells.low)
    return cells.low[order], cells.high[order]


class Look(NamedTuple):
    """Of the cells that were looked into: those to halve, brackets, and those that stay open if halved."""

    left: Interval
    brackets: list[tuple[float, float]]
    level: Interval


def look_into(function: LoadFunction, cells: Interval) -> Look:
    """One look into cells, and at the middle and the ends of each. A cell is level where rounding makes the
    power and the margins that leave it open, or leaves the power without bound at all three places."""
    middle = 0.5 * (cells.low + cells.high)
    low, high = (np.concatenate([end, middle, *cells]) for end in cells)
    asked = [function.power, function.slope, *function.margins]
    value, slope, *margins = (
        Interval(*(np.broadcast_to(end, low.shape).reshape(4, -1) for end in one))
        for one in enclose(function.record, asked, function.enclosed(Interval(low, high)))
    )
    apart, whole = np.zeros(middle.shape, dtype=bool), np.ones(middle.shape, dtype=bool)
    for margin in margins:
        apart |= margin.high[0] < 0.0
        whole &= margin.low[0] > 0.0
    with np.errstate(all="ignore"):
        half = np.nextafter(0.5 * (cells.high - cells.low), np.inf) * (1.0 + 1e-15)
        reach = half * np.maximum(np.abs(slope.low[0]), np.abs(slope.high[0]))
        reach = np.where(np.isnan(reach), np.inf, reach)
        least, most = np.nextafter(value.low[1] - reach, -np.inf), np.nextafter(value.high[1] + reach, np.inf)
        least = np.maximum(value.low[0], np.where(whole, least, -np.inf))
        most = np.minimum(value.high[0], np.where(whole, most, np.inf))
    possible = ~apart & ~(least > 0.0) & ~(most < 0.0)
    steady = whole & ((slope.low[0] > 0.0) | (slope.high[0] < 0.0))
    _, before, after = _signs(value)[1:]
    decided = possible & steady & (before != 0) & (after != 0)
    crossing = decided & (before != after)
    found = list(zip(cells.low[crossing].tolist(), cells.high[crossing].tolist(), strict=True))
    left = possible & ~decided
    level = left & _is_rounding(value)
    unbounded = left & np.isinf(value.high - value.low)[1:].all(axis=0)
    for margin in margins:
        level &= (margin.low[0] > 0.0) | _is_rounding(margin)
        unbounded &= (margin.high[1:] >= 0.0).all(axis=0)
    level |= unbounded
    left &= ~level
    return Look(
        Interval(cells.low[left], cells.high[left]), found, Interval(cells.low[level], cells.high[level])
    )


def _is_rounding(value: Interval) -> npt.NDArray[np.bool_]:
    """Where a cell's enclosure is at most twice as wide as those at its middle and its ends."""
    with np.errstate(invalid="ignore"):
        width = value.high - value.low
    return np.asarray(width[0] <= 2.0 * width[1:].min(axis=0))


def _signs(value: Interval) -> npt.NDArray[np.int64]:
    """Signs of enclosed values; 0 where rounding leaves them open."""
    return np.where(value.low > 0.0, 1, np.where(value.high < 0.0, -1, 0))


def _clusters(low: Array, high: Array) -> list[tuple[float, float]]:
    """Cells that touch, as one."""
    found: list[tuple[float, float]] = []
    for a, b in zip(low.tolist(), high.tolist(), strict=True):
        if found and a <= found[-1][1]:
            found[-1] = (found[-1][0], max(b, found[-1][1]))
        else:
            found.append((a, b))
    return found
