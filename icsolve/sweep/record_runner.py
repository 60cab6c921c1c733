"""The rows of a sweep, block by block: the outputs as arrays, and which rows need a second look.

A row is looked at again where something that is divided by, or whose root is taken, is small beside its
terms, or where an answer is very small or very large. The others are what one scene would give. What is
small is told by the place where the record was made, never by the other rows.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np
import numpy.typing as npt

from icsolve.numbers.adjoint import noise_of
from icsolve.numbers.backward import Backward
from icsolve.numbers.record import Op, Record, Root, Traced, live, terms_of, varies
from icsolve.numbers.replay import BLOCK, Array, Code, Mask
from icsolve.sweep.exact_record import RowScenes
from icsolve.sweep.friction_rows import FrictionRows
from icsolve.sweep.program import CompiledSweep, live_roots, living_checks
from icsolve.tuples import NamedTuple, cached_property

SHALLOW = 1e-6
"""A radicand below this fraction of its terms makes its row doubtful: what doubles leave of an answer beside
there, of which place and speed each lose these digits, is right to a few 1e-9."""
SMALL = 4e-7
"""Below this fraction of the terms that it is summed from (where the record was made) a divisor or an answer
makes its row doubtful, and so does an answer that many times larger than there. Twice as much, and in a
family of a hundred four-bars the rows that are scenes cost as much as all others."""
STEEP = 1e-2
"""The same of a divisor with inertia forces, and its square of a radicand: beside a singular position
accelerations grow, and what rounds them, as the third power of what is divided by."""
CLOSE = 1e-7
"""Below this a margin of the figure makes its row doubtful (normalised)."""
AGREED = 1e-9
"""Conditions that were not needed to place the links are met to this (normalised)."""
LEANING = 1e-4
"""The same of an answer where contacts are told row by row: their places are rounded."""
BATCH = 8
"""So many outputs are bounded at once: each takes a few megabytes."""

Key = tuple[str, str]
Rows = npt.NDArray[np.int64]
Progress = Callable[[int], None]
"""Called with a number of rows that were done."""


class RowsFound(NamedTuple):
    """What a run gave.

    Attributes
    ----------
    values : by (kind, name), (rows,) or (rows, parts) [case units], as the arrays of `Sweep`
    doubtful : indices of the rows that are to be solved as scenes: their values are not to be shown
    """

    values: dict[Key, Array]
    doubtful: Rows


class Runner:
    """A sweep compiled for its outputs: which nodes to run, and which of them to watch.

    It may run in several threads, each with its own buffers. A row is doubtful where a radicand, a divisor, a
    margin of the figure or an answer is small beside what it is where the record was made.
    """

    def __init__(self, compiled: CompiledSweep) -> None:
        self.compiled = compiled
        record = compiled.record
        flat = [(key, part, v) for key, values in compiled.outputs.items() for part, v in enumerate(values)]
        self.still = [(key, part, float(v)) for key, part, v in flat if not varies(v)]
        self.moving = [(key, part, v.index) for key, part, v in flat if varies(v)]
        wanted = [index for _, _, index in self.moving]
        self.rubs = compiled.rubbing.nodes if compiled.rubbing is not None else []
        nodes = record.nodes
        behind = live(record.nodes, [*wanted, *self.rubs])
        answers = [n for n, (key, _, _) in enumerate(self.moving) if key[0] == "answers"]
        standing = live(nodes, [*wanted, *self.rubs, *compiled.loaded]) if compiled.loaded else behind
        checks = living_checks(compiled, standing)
        leading = live(nodes, [*standing, *checks]) if checks else standing
        self.roots = [record.roots[k] for k in leading if k in record.roots]
        shallow, divisor = (STEEP * STEEP, STEEP) if compiled.dynamic else (SHALLOW, SMALL)
        self.watched = [
            *(Watched(root.radicand, shallow * _size_of(record, root)) for root in self.roots),
            *(Watched(k, divisor * terms_of(nodes, k), sized=True) for k in _divisors(nodes, behind)),
            *(Watched(k, CLOSE) for k in (*compiled.margins, *compiled.fits)),
            *(Watched(k, -math.inf, AGREED, True) for k in checks),
        ]
        small = LEANING if compiled.rests else SMALL
        for k in (wanted[n] for n in answers):
            usual, terms = usual_and_terms(record, k)
            self.watched += [Watched(k, small * terms, usual / small, True)] if usual else []
        self.code = Code(record, [*wanted, *(one.node for one in self.watched), *self.rubs])

    @cached_property
    def sequential(self) -> bool:
        """Whether states have to be followed from row to row."""
        motion = self.compiled.motion
        return motion is not None and bool(motion.groups or self.compiled.record.counted)

    @cached_property
    def bearing(self) -> tuple[str, ...]:
        """The inputs on which branches, groups and counted turns hang."""
        compiled = self.compiled
        if compiled.motion is None:
            return ()
        if self.sequential:
            return tuple(compiled.inputs)
        behind = set(live(compiled.record.nodes, [root.radicand for root in self.roots]))
        return tuple(name for name, k in compiled.inputs.items() if k in behind)

    @cached_property
    def constants(self) -> list[tuple[Key, int, float]]:
        """Bounds of the outputs that are the same in every row, by output and part."""
        outputs, record = self.compiled.outputs, self.compiled.record
        return [(key, part, noise_of(record, outputs[key][part])) for key, part, _ in self.still]

    @cached_property
    def answers(self) -> list[tuple[Key, int]]:
        """The answers that vary, and their nodes."""
        return [(key, index) for key, _, index in self.moving if key[0] == "answers"]

    @cached_property
    def bounds(self) -> Backward:
        """Backward passes from the answers."""
        return self.passes([index for _, index in self.answers])

    def batches(self) -> Iterator[tuple[list[tuple[Key, int]], Backward]]:
        """Outputs that vary, some at a time, by output and part, and the backward passes from them."""
        if self.answers:
            yield [(key, 0) for key, _ in self.answers], self.bounds
        others = [(key, part, index) for key, part, index in self.moving if key[0] != "answers"]
        for start in range(0, len(others), BATCH):
            some = others[start : start + BATCH]
            yield [(key, part) for key, part, _ in some], self.passes([index for *_, index in some])

    @cached_property
    def reaching(self) -> Code:
        """The margins of the branches, each with its size."""
        return Code(
            self.compiled.record, [n for r in live_roots(self.compiled) for m in r.margins for n in m]
        )

    def apart(self, given: Mapping[int, Array], rows: int) -> Mask:
        """Rows whose links clearly do not reach one another, (rows,); the others may still be in doubt."""
        out = np.zeros(rows, dtype=bool)
        found = self.reaching.run(given, rows) if self.reaching.wanted else ()
        for margin, size in zip(found[::2], found[1::2], strict=True):
            out |= margin < -SHALLOW * np.abs(size)
        return out

    @cached_property
    def cases(self) -> RowScenes:
        """Rows as cases of their own."""
        return RowScenes(self.compiled)

    def passes(self, targets: Sequence[int]) -> Backward:
        """Backward passes from some nodes: signs, guesses and counts of turns are exact."""
        compiled = self.compiled
        exact = [k for name, k in compiled.inputs.items() if name.startswith(("branch ", "swing "))]
        exact += [guess.index for guess, _ in compiled.record.counted.values()]
        exact += [k for group in compiled.record.implicit for k in (*group.guesses, *group.solved)]
        return Backward(compiled.record, targets, exact)

    def blank(self, rows: int) -> dict[Key, Array]:
        """Arrays for the outputs, (rows,) or (rows, parts), of which nothing is filled."""
        widths = {key: len(parts) for key, parts in self.compiled.outputs.items()} | self.rubbed
        return {key: np.empty(rows if width == 1 else (rows, width)) for key, width in widths.items()}

    @cached_property
    def rubbed(self) -> dict[Key, int]:
        """What friction gives, and how many numbers a row."""
        found = self.compiled.rubbing
        names = found.ratios if found is not None else ()
        ranges = {("holds", name): 2 for name in names if found is not None and found.drive is None}
        return {("answers", name): 1 for name in names} | ranges

    def empty(self, rows: int) -> dict[Key, Array]:
        """Arrays for the outputs, (rows,) or (rows, parts); those that no row changes are filled."""
        values = self.blank(rows)
        for key, part, value in self.still:
            column(values[key], part)[:] = value
        return values

    def run(self, given: Mapping[int, Array], rows: int, progress: Progress | None = None) -> RowsFound:
        """All rows.

        Parameters
        ----------
        given : by node, an array (rows,) or one number (an array of no dimension), for every input of the
            record
        rows : how many
        progress : called with the number of rows of every block

        Raises
        ------
        KeyError
            Where an input is not given.
        """
        values, doubtful = self.empty(rows), []
        for start in range(0, rows, BLOCK):
            stop = min(start + BLOCK, rows)
            here = {k: v[start:stop] if v.ndim else v for k, v in given.items()}
            found = self.code.run(here, stop - start)
            for (key, part, _), array in zip(self.moving, found, strict=False):
                column(values[key], part)[start:stop] = array
            again = self._watch(found[len(self.moving) :], stop - start)
            if self.compiled.rubbing is not None:
                again = self._rub(self.compiled.rubbing, found, slice(start, stop), values, again)
            if again.size:
                doubtful.append(again + start)
            if progress is not None:
                progress(stop - start)
        return RowsFound(values, np.concatenate(doubtful) if doubtful else np.empty(0, np.int64))

    def _rub(
        self, by: FrictionRows, found: list[Array], rows: slice, values: dict[Key, Array], again: Rows
    ) -> Rows:
        """Fill in what friction gives; the rows of a block that are to be looked at again."""
        count = rows.stop - rows.start
        nodes = dict(zip(self.rubs, found[len(found) - len(self.rubs) :], strict=True))
        with np.errstate(all="ignore"):
            balanced = by.run(nodes, count)
        again = np.union1d(again, np.flatnonzero(~balanced.sure))
        for (kind, name), array in ((key, values[key]) for key in self.rubbed):
            given = balanced.answers if kind == "answers" else balanced.holds
            array[rows] = given.get(name, np.nan)
            array[rows][again] = np.nan
        return again

    def _watch(self, found: list[Array], rows: int) -> Rows:
        """Rows of a block to look at again, from what is watched."""
        scratch = self.code.bound(rows)[1][-1][:rows]
        sure: Mask | None = None
        with np.errstate(all="ignore"):
            for (_, low, high, sized), values in zip(self.watched, found, strict=False):
                size = np.abs(values, scratch) if sized else values
                if not np.minimum.reduce(size) > low:
                    sure = size > low if sure is None else sure & (size > low)
                if high < math.inf and not np.maximum.reduce(size) < high:
                    sure = size < high if sure is None else sure & (size < high)
        return np.empty(0, np.int64) if sure is None else np.flatnonzero(~sure)


class Watched(NamedTuple):
    """A node that makes a row doubtful where its value (``sized``: the size of it) is not between two."""

    node: int
    low: float
    high: float = math.inf
    sized: bool = False


def _size_of(record: Record, root: Root) -> float:
    """The size of the terms of a root's radicand, where the record was made."""
    return math.prod(record.nodes[size].value for _, size in root.margins)


def column(array: Array, part: int) -> Array:
    """One part of an output's array, a view (rows,); of an array (rows,) itself."""
    return array if array.ndim == 1 else array[:, part]


def usual_and_terms(record: Record, k: int) -> tuple[float, float]:
    """The size of an answer where the record was made, and of the terms that it is summed from."""
    nodes, top = record.nodes, k
    while nodes[top].op in (Op.DIV, Op.NEG) or (nodes[top].op == Op.MUL and not nodes[nodes[top].b].row):
        top = nodes[top].a
    usual, size = abs(nodes[k].value), abs(nodes[top].value)
    return (usual, usual * (terms_of(nodes, top) / size)) if size else (0.0, 0.0)


def _divisors(nodes: Sequence[Traced], alive: Sequence[int]) -> list[int]:
    """What is divided by and varies."""
    found = {nodes[k].b for k in alive if nodes[k].op == Op.DIV and nodes[nodes[k].b].row}
    return sorted(found)
