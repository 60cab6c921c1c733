"""Doubtful rows: each decided in high precision, and solved as a scene of its own.

Where something that is divided by, or whose root is taken, is small, doubles leave open whether the links
reach one another, on which side of a change point the row stands, and what balances. The record in decimals
says where the points are; the scene by those coordinates goes to `icsolve.solve`, whose status and value the
row then has. Nothing here looks at another row.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from decimal import Decimal, localcontext

import numpy as np
import numpy.typing as npt

from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers.decimals import CONTEXT, as_written
from icsolve.numbers.record import Implicit
from icsolve.numbers.replay import Array
from icsolve.numbers.roots import closed_in
from icsolve.sweep.continuation import PathSegment
from icsolve.sweep.exact_record import APART, ZERO, RowScenes, Unreached, lowest
from icsolve.sweep.path_tracking import Along
from icsolve.sweep.row_parts import SweepPart, SweepParts

CLEAR = 2.0**-12
"""A row farther from a change point than this part of the longest step is on the side that floats say."""
PASSED = Decimal(2) ** -14
"""Within this part of the longest step doubles tell where a group goes through a singular position."""
BESIDE = 2.0**-20
"""A state is a guess for another that is this part of the longest step away."""


class Recheck:
    """Rows of one part of a sweep, in high precision; ``exact`` are varied numbers, by path or link, of which
    a row knows more than the arrays have."""

    def __init__(
        self, parts: SweepParts, part: SweepPart, exact: Mapping[str, Decimal] | None = None
    ) -> None:
        self.parts, self.part, self.exact = parts, part, exact or {}
        self.compiled = part.runner.compiled
        self.scenes: RowScenes = part.runner.cases
        self.tracker = part.followed.tracker if part.followed else None
        self.change_points: dict[tuple[str, float], Decimal | None] = {}
        self.solved: tuple[Decimal, dict[int, Decimal]] | None = None
        self.unreached: set[Decimal] = set()
        self.last: tuple[int, dict[int, Decimal]] = (-1, {})

    def given(self, row: int) -> dict[int, Decimal]:
        """The inputs of a row (its number in the sweep) by node."""
        if self.last[0] != row:
            self.last = (row, self._given(row))
        return self.last[1]

    def _given(self, row: int) -> dict[int, Decimal]:
        arrays, inputs = self.parts.arrays, self.compiled.inputs
        varied = {k: as_written(arrays[n][row]) for n, k in inputs.items() if n in arrays}
        varied |= {inputs[n]: value for n, value in self.exact.items()}
        if self.tracker is None:
            return varied
        (main,) = self.tracker.line.slope
        place = as_written(arrays[main][row])
        for segment in self.tracker.ended(float(place)):
            with suppress(Unreached), self.on(segment):
                given = self._along(row, place) | varied
                self.scenes.exact.solved(given)
                return given
        return self._along(row, place) | varied

    def _along(self, row: int, place: Decimal) -> dict[int, Decimal]:
        """The inputs that the line has at the place of a row: signs, and states of groups."""
        floats, good = self.parts.given(self.part.some(np.flatnonzero(self.part.rows == row)))
        if not good.all():
            raise SceneError(Status.CANNOT_ASSEMBLE, APART)
        given = {k: Decimal(float(np.ravel(v)[0])) for k, v in floats.items()}
        return given | self._signs(place) | self._states(float(place))

    def refuse_apart(self, row: int) -> None:
        """Raise SceneError where the links do not reach one another."""
        self.scenes.refuse_apart(self.given(row))

    def case(self, row: int) -> Case:
        """The row, by its index in the sweep, as a scene of its own: its points by coordinates."""
        given = self.given(row)
        return self.scenes.case(given, {p: as_written(a[row]) for p, a in self.parts.columns.paths.items()})

    def outputs(self, row: int) -> dict[tuple[str, str], list[float]]:
        """All outputs of a row, each rounded once, by (kind, name) and part [case units]; not a number where
        one is without a value, and where an answer is so small that it may be zero: its scene tells.
        """
        outputs = self.compiled.outputs
        flat = self.scenes.exact.values([v for parts in outputs.values() for v in parts], self.given(row))
        found = iter(flat)
        return {
            key: [_rounded(next(found), float(part), key[0] == "answers") for part in parts]
            for key, parts in outputs.items()
        }

    # --- places between rows ------------------------------------------------------------------------

    def at(self, name: str, s: Decimal) -> dict[int, Decimal]:
        """The inputs, by node, where the varied number ``name`` is ``s`` and the others have the values of
        the first row.
        """
        row, inputs = int(self.part.rows[0]), self.compiled.inputs
        arrays = self.parts.arrays
        given = {k: as_written(arrays[n][row]) for n, k in inputs.items() if n in arrays}
        if self.tracker is None:
            return {**given, inputs[name]: s}
        (main,) = self.tracker.line.slope
        place = s if main == name else as_written(arrays[main][row])
        along = self.tracker.exactly(place) | self._signs(place) | self._near_states(place)
        return {**along, inputs[name]: s}

    def _near_states(self, s: Decimal) -> dict[int, Decimal]:
        """States of groups from those that were solved last, where that was near."""
        assert self.tracker is not None
        if not self.tracker.groups:
            return {}
        if self.solved is not None and abs(self.solved[0] - s) < Decimal(BESIDE * self.tracker.line.widest):
            given = self.tracker.exactly(s) | self._signs(s) | self.solved[1]
            with suppress(Unreached):  # beside a limit, where two ways meet, it is far all the same
                self.scenes.exact.solved(given)
                return self.solved[1]
        if s in self.unreached:
            raise Unreached
        columns = [k for group, _ in self.tracker.groups for k in group.equations.solved]
        try:
            states = self._states_at(s, columns)
        except Unreached:
            self.unreached.add(s)
            raise
        self.solved = (s, dict(zip(columns, states, strict=True)))
        return self.solved[1]

    def _states_at(self, s: Decimal, columns: Sequence[int]) -> list[Decimal]:
        """States of groups from what doubles tell; where these stop short of an end, from their last."""
        assert self.tracker is not None
        exact, given = self.scenes.exact, self.tracker.exactly(s)
        try:
            return exact.states(given | self._states(float(s)), columns)
        except Unreached:
            if not self.tracker.ending(np.array([float(s)]))[0]:
                raise
        end = as_written(min(self.tracker.ends, key=lambda end: abs(end - float(s))))
        last = exact.states(self.tracker.exactly(end), columns)
        return exact.states(given | dict(zip(columns, last, strict=True)), columns)

    def floats(self, name: str, at: Array) -> tuple[dict[int, Array], npt.NDArray[np.bool_]]:
        """As `at`, in doubles, at many values.

        Parameters
        ----------
        name : path or link
        at : (values,) [case units, degrees]

        Returns
        -------
        tuple[dict[int, Array], Mask]
            By node, (values,) or one number; and at which values groups have a solution, (values,).
        """
        row, inputs = int(self.part.rows[0]), self.compiled.inputs
        given = {inputs[n]: np.array(a[row]) for n, a in self.parts.arrays.items() if n in inputs}
        good = np.ones(len(at), dtype=bool)
        if self.tracker is not None:
            (main,) = self.tracker.line.slope
            places = at if main == name else np.full(len(at), self.parts.arrays[main][row])
            along, good = self.tracker.given(places)
            given = {**along, **given}
        return {**given, inputs[name]: at}, good

    @property
    def widest(self) -> float:
        """The longest step of the line."""
        return self.tracker.line.widest if self.tracker is not None else 0.0

    def touching(self, name: str) -> Iterator[tuple[Decimal, bool]]:
        """The places of change points along a number, and whether they are exact."""
        if self.part.followed is None or name not in self.part.followed.tracker.line.slope:
            return
        for branch, passing in self.part.followed.passed.items():
            for place in passing.change_points:
                exact = self._exact_place(branch, place)
                yield (as_written(place), False) if exact is None else (exact, True)

    # --- groups -----------------------------------------------------------------------------------

    @contextmanager
    def on(self, segment: PathSegment) -> Iterator[None]:
        """With the groups on one part of their path alone: where another begins at a limit, a turn of the
        driven link away, it counts for nothing."""
        tracker = self.tracker
        assert tracker is not None
        every, tracker.segments, tracker.last = tracker.segments, [segment], None
        known, tracker.known = tracker.known, {}
        solved, unreached, self.solved, self.unreached = self.solved, self.unreached, None, set()
        try:
            yield
        finally:
            tracker.segments, tracker.last, tracker.known = every, None, known
            self.solved, self.unreached = solved, unreached

    def _states(self, s: float) -> dict[int, Decimal]:
        """The states of groups near a singular position, by the polynomial through states around it: the line
        goes straight on there, where Newton's method alone might take the other one."""
        tracker = self.tracker
        if tracker is None or not tracker.groups or not tracker.bent(np.array([s]))[0]:
            return {}
        columns = [k for group, _ in tracker.groups for k in group.equations.solved]
        with localcontext(CONTEXT), suppress(Unreached):
            states = tracker.along(self.scenes.exact, columns, s)(as_written(s))
            return dict(zip(columns, states, strict=True))
        return {}

    def passages(self) -> Iterator[tuple[Decimal, bool]]:
        """The singular positions through which groups go on, and whether they are exact."""
        for near in self.tracker.passages() if self.tracker else ():
            exact = self._passage(near)
            yield (as_written(near), False) if exact is None else (exact, True)

    def _passage(self, near: float) -> Decimal | None:
        """Where the determinant of a group vanishes; None where it does not lead there."""
        tracker, exact = self.tracker, self.scenes.exact
        assert tracker is not None
        low, high = (as_written(near) + k * PASSED * as_written(tracker.line.widest) for k in (-1, 1))
        groups = [group.equations for group, _ in tracker.groups]
        with localcontext(CONTEXT), suppress(Unreached):
            along = tracker.around(exact, [k for group in groups for k in group.solved], near)
            if along is None:
                return None
            guesses = [k for group in groups for k in group.guesses]
            for group in groups:

                def size(s: Decimal, group: Implicit = group, along: Along = along) -> Decimal:
                    known = tracker.exactly(s) | dict(zip(guesses, along(s), strict=True))
                    return exact.determinant(group, known)

                for place in closed_in(size, low, high) if group.is_square else ():
                    return place
        return None

    # --- sides of change points -------------------------------------------------------------------

    def _signs(self, s: Decimal) -> dict[int, Decimal]:
        """The signs of branches that change near a place of the line, by the exact places of the changes."""
        assert self.tracker is not None
        tracker, found = self.tracker, {}
        for name, places in tracker.change_points.places.items():
            for place in places:
                copy = self._copy(place, float(s))
                clear = CLEAR * tracker.line.widest
                if abs(float(s) - copy) >= clear or name not in self.compiled.inputs:
                    continue
                exact = self._place(name, copy)
                side = np.array([copy + clear * (1.0 if s > exact else -1.0)])
                flip = float(tracker.change_points.flips(name, side, tracker.line)[0])
                found[self.compiled.inputs[name]] = Decimal(tracker.start.signs[name] * flip)
        return found

    def _copy(self, place: float, s: float) -> float:
        """A place, so many whole turns away that it is near to another."""
        period = self.tracker.line.period if self.tracker else None
        return place if period is None else place + period * round((s - place) / period)

    def _place(self, name: str, near: float) -> Decimal:
        """Where exactly a branch changes; else about there."""
        exact = self._exact_place(name, near)
        return as_written(near) if exact is None else exact

    def _exact_place(self, name: str, near: float) -> Decimal | None:
        """Where a branch changes: its radicand is lowest there. None where nothing leads to that, as where a
        group has a singular position too."""
        if (name, near) not in self.change_points:
            assert self.tracker is not None
            motion = self.compiled.motion
            root = next(r for r in self.scenes.roots if motion and motion.branches[r.node] == name)
            radicand = self.tracker.along(self.scenes.exact, [root.radicand], near)
            self.change_points[name, near] = lowest(lambda s: radicand(s)[0], near)
        return self.change_points[name, near]


def _rounded(value: Decimal, usual: float, open_: bool) -> float:
    """The nearest double; for what is nothing beside the value elsewhere zero, or not a number where it is
    left open (a small load has a small answer)."""
    found = float(value)
    if abs(found) < float(ZERO) * abs(usual):
        return float("nan") if open_ and found else 0.0
    return found
