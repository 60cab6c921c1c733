"""Positions in a sweep: where it locks, where the answer peaks, where it takes a value, to full precision.

An answer is a quotient of two powers, per unit of the unknown and of the known loads. Its poles are the
zeros of the one (the unknown does no work: a dead centre), its own zeros those of the other, so that each
is a change of sign between rows, and is closed in from there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from decimal import Decimal
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import Scalar
from icsolve.numbers.backward import Backward
from icsolve.numbers.record import Op, Record, Traced
from icsolve.numbers.replay import Array, Code
from icsolve.solve import solve
from icsolve.solve.refusals import rubs
from icsolve.sweep.ask import AskError, columns_of
from icsolve.sweep.exact import as_written
from icsolve.sweep.parts import Part
from icsolve.sweep.program import Asked
from icsolve.sweep.start import start_of
from icsolve.sweep.work import Work

SECTIONS = 64
ROUNDS = 12
"""A bracket is cut in so many parts, so many times: to the last digit."""


class Spot(NamedTuple):
    """A position that was found: the varied number there, what it is (``dead``, ``limit``, ``change-point``,
    ``max``, ``value``), and the answer (None where there is none)."""

    at: float
    kind: str
    answer: float | None


class Query(NamedTuple):
    """What to look for: ``dead``, ``max``, or ``value`` (of an unknown load)."""

    kind: str
    load: str = ""
    value: float = 0.0


def find(
    case: Case,
    vary: Mapping[str, npt.ArrayLike] | None,
    query: Query,
    *,
    drive: Mapping[str, npt.ArrayLike] | None = None,
) -> list[Spot]:
    """The positions in a sweep along one number, in order.

    Parameters
    ----------
    case, vary, drive : as for `icsolve.sweep`; the values are the rows between which is looked
    query : what to look for

    Raises
    ------
    CaseError
        For a path that the case does not have.
    SceneError
        Where the case cannot be moved so, or rows can only be solved one by one.
    ValueError
        Where several numbers vary, or the load is not an unknown one.
    """
    columns = columns_of(case, vary, drive)
    names = [name for name, array in columns.arrays.items() if np.ptp(array) > 0.0]
    if len(names) != 1:
        raise AskError("positions are found along one varied number")
    why = "positions cannot be found where each row has to be solved as a scene of its own."
    if case.profiles is not None and case.profiles.touches:
        raise SceneError(Status.UNSUPPORTED, why)
    start = start_of(case, columns, Asked())
    if start.one_by_one or rubs(case):
        raise SceneError(Status.UNSUPPORTED, why)
    work = Work(start, columns, False)
    work.run()
    spots = (spot for part in work.done for spot in _Search(work, part, names[0], query).spots())
    return sorted(spots, key=lambda spot: (spot.at, spot.kind))


class _Search:
    """Positions in one part of a sweep."""

    def __init__(self, work: Work, part: Part, name: str, query: Query) -> None:
        self.work, self.part, self.query, self.name = work, part, query, name
        self.sheet = part.runner.sheet
        self.record = self.sheet.record
        self.input = self.sheet.inputs[name]
        order = np.argsort(work.columns.arrays[name][part.rows], kind="stable")
        self.places, first = np.unique(work.columns.arrays[name][part.rows][order], return_index=True)
        self.codes = work.codes[part.rows][order][first]

    def spots(self) -> Iterator[Spot]:
        """All positions of the kind that is asked."""
        load = self.query.load or next((k[1] for k in self.sheet.outputs if k[0] == "answers"), "")
        key = ("answers", load)
        if key not in self.sheet.outputs:
            names = [name for kind, name in self.sheet.outputs if kind == "answers"]
            known = f" ({', '.join(names)})" if names else ", which has none"
            raise AskError(f"{load or 'an answer'} is no unknown load of this case{known}")
        (answer,) = self.sheet.outputs[key]
        if self.query.kind == "value":
            yield from self._values(answer, load)
        elif self.query.kind == "max":
            yield from self._peaks(answer, load)
        else:
            yield from self._dead(answer, load)

    # --- values on the way ------------------------------------------------------------------------

    def given(self, at: Array) -> dict[int, Array]:
        """The inputs at places of the way."""
        arrays, inputs = self.work.columns.arrays, self.sheet.inputs
        row = self.part.rows[0]
        given = {inputs[name]: np.array(a[row]) for name, a in arrays.items() if name in inputs}
        if self.part.followed is not None:
            along, good = self.part.followed.track.given(at)
            given = {**along, **given}
            at = np.where(good, at, np.nan)
        return {**given, self.input: at}

    def evaluator(self, value: Scalar) -> Callable[[Array], Array]:
        """A value as a function of the varied number; not a number where the links do not assemble."""
        if not isinstance(value, Traced) or not value.row:
            return lambda at: np.full(len(at), float(value))
        roots = [root.radicand for root in self.part.runner.roots]
        code = Code(self.record, [value.index, *roots])

        def evaluate(at: Array) -> Array:
            found, *radicands = code.run(self.given(at), len(at))
            out = np.array(np.broadcast_to(found, len(at)))
            for radicand in radicands:
                out[~(np.broadcast_to(radicand, len(at)) >= 0.0)] = np.nan
            return out

        return evaluate

    def slope(self, value: Traced) -> Callable[[Array], Array]:
        """The derivative of a value by the varied number."""
        passes: Backward = self.part.runner.passes([value.index])

        def evaluate(at: Array) -> Array:
            parts = [at[n : n + passes.rows] for n in range(0, len(at), passes.rows)]
            return np.concatenate([self._slope(passes, part) for part in parts])

        return evaluate

    def _slope(self, passes: Backward, at: Array) -> Array:
        (passed,) = passes.run(self.given(at), len(at))
        return np.array(passed.by.get(self.input, np.zeros(len(at))))

    def answer(self, at: float, load: str) -> float | None:
        """The answer of the scene at a position."""
        case = self._case(at)
        try:
            return float(solve(case).answers[load].value) if case is not None else None
        except SceneError:
            return None

    def _case(self, at: float) -> Case | None:
        given = self.given(np.array([at]))
        if not np.isfinite(given[self.input][0]):
            return None
        numbers = {path: as_written(a[self.part.rows[0]]) for path, a in self.work.columns.paths.items()}
        if self.name in numbers:
            numbers[self.name] = as_written(at)
        exact = {k: Decimal(float(np.ravel(v)[0])) for k, v in given.items()}
        inputs = self.sheet.inputs
        exact |= {inputs[name]: value for name, value in numbers.items() if name in inputs}
        return self.part.runner.cases.case({**exact, self.input: as_written(at)}, numbers)

    # --- kinds ------------------------------------------------------------------------------------

    def _values(self, answer: Scalar, load: str) -> Iterator[Spot]:
        """Where the answer takes a value: its numerator less so many times its denominator vanishes."""
        top, bottom = fraction(self.record, answer)
        miss = top - self.query.value * bottom
        for at in self._zeros(self.evaluator(miss)):
            yield Spot(at, "value", self.answer(at, load))

    def _dead(self, answer: Scalar, load: str) -> Iterator[Spot]:
        """Where the unknown does no work, where the links reach their limit, where branches meet."""
        _, bottom = fraction(self.record, answer)
        evaluate = self.evaluator(bottom)
        changes = list(self._change_points())
        yield from (Spot(at, "change-point", None) for at in changes)
        for at in self._zeros(evaluate):
            if all(abs(at - other) > MERGED * max(1.0, abs(at)) for other in changes):
                yield Spot(at, "dead", None)
        yield from (Spot(at, "limit", self.answer(at, load)) for at in self._limits(evaluate))

    def _change_points(self) -> Iterator[float]:
        """Where branches meet: their radicands are lowest there, so their slopes change sign."""
        if self.part.followed is None:
            return
        names = self.sheet.motion.branches if self.sheet.motion else {}
        seen: list[float] = []
        for root in self.part.runner.roots:
            passing = self.part.followed.passed.get(names[root.node])
            slope = self.slope(self.record.at(root.radicand))
            for at in passing.touches if passing else ():
                near = next(self._closed(slope, at - NEAR, at + NEAR), at)
                if self.places[0] <= near <= self.places[-1] and all(abs(near - s) > NEAR for s in seen):
                    seen.append(near)
                    yield near

    def _peaks(self, answer: Scalar, load: str) -> Iterator[Spot]:
        """Where the size of the answer is larger than on both sides."""
        if not isinstance(answer, Traced) or not answer.row:
            return
        _, bottom = fraction(self.record, answer)
        size, slope = np.abs(self.evaluator(answer)(self.places)), self.slope(answer)
        poles = np.sign(self.evaluator(bottom)(self.places))
        for k in range(1, len(self.places) - 1):
            around = slice(k - 1, k + 2)
            if not (size[k] > size[k - 1] and size[k] >= size[k + 1]) or abs(poles[around].sum()) != 3.0:
                continue
            for at in self._closed(slope, self.places[k - 1], self.places[k + 1]):
                yield Spot(at, "max", self.answer(at, load))

    def _zeros(self, evaluate: Callable[[Array], Array]) -> Iterator[float]:
        """Changes of sign from row to row, and rows at which it vanishes."""
        values = evaluate(self.places)
        size = float(np.nanmax(np.abs(values), initial=0.0))
        tiny = np.abs(values) <= TINY * size
        yield from self.places[tiny].tolist()
        for k in np.flatnonzero((values[:-1] * values[1:] < 0.0) & ~tiny[:-1] & ~tiny[1:]):
            yield from self._closed(evaluate, self.places[k], self.places[k + 1])

    def _closed(self, evaluate: Callable[[Array], Array], low: float, high: float) -> Iterator[float]:
        """A change of sign between two places, closed in to the last digit (of the places about zero)."""
        least = TINY * max(abs(low), abs(high))
        for _ in range(ROUNDS):
            cuts = np.linspace(low, high, SECTIONS + 1)
            sign = np.sign(evaluate(cuts))
            change = np.flatnonzero(sign[:-1] * sign[1:] <= 0.0)
            if not change.size:
                return
            low, high = float(cuts[change[0]]), float(cuts[change[0] + 1])
            if high <= math.nextafter(math.nextafter(low, math.inf), math.inf):
                break
        ends = np.array([low, high])
        at = float(ends[np.nanargmin(np.abs(evaluate(ends)))])
        yield at if abs(at) > least else 0.0

    def _limits(self, evaluate: Callable[[Array], Array]) -> Iterator[float]:
        """Where rows that assemble border on rows that do not."""
        good = np.isfinite(evaluate(self.places))
        for k in np.flatnonzero(good[:-1] != good[1:]):
            low, high = float(self.places[k]), float(self.places[k + 1])
            for _ in range(ROUNDS):
                at = np.linspace(low, high, SECTIONS + 1)
                here = np.isfinite(evaluate(at))
                change = np.flatnonzero(here[:-1] != here[1:])
                if not change.size:
                    break
                low, high = float(at[change[0]]), float(at[change[0] + 1])
            yield low if good[k] else high


NEAR = 1e-4
"""A change point is closed in from this far on both sides."""
MERGED = 1e-6
"""A pole that is this near to a change point is that."""
TINY = 1e-14
"""A row at which a value is below this fraction of its largest is at its zero."""


def fraction(record: Record, value: Scalar) -> tuple[Scalar, Scalar]:
    """A value as numerator and denominator: the quotient that it is, times constants."""
    if not isinstance(value, Traced) or not value.row:
        return value, 1.0
    node = record.nodes[value.index]
    a, b = record.at(node.a), record.at(node.b)
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
