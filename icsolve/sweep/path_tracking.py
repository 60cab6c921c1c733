"""Following a line of inputs step by step: groups that Newton's method places, and turns that are counted.

Each step starts from the last ones, so that rows between two steps start from near their solution and
stay on the branch. Beyond a limit nothing is taken up: where the links assemble again, no motion leads.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from decimal import Decimal, localcontext
from functools import partial
from itertools import chain

import numpy as np

from icsolve.assembly.driven.groups import ROUNDS, NewtonGroup, Solver
from icsolve.numbers.decimals import CONTEXT, as_written
from icsolve.numbers.record import Op
from icsolve.numbers.replay import Array, Code, Mask
from icsolve.sweep.continuation import (
    ChangePoints,
    InputLine,
    PathSegment,
    State,
    Step,
    counts,
    goes_on,
    segment_of,
)
from icsolve.sweep.exact_record import ExactRecord, Unreached
from icsolve.sweep.program import CompiledSweep

FIRST = 2.0**-5
"""The first step, as a part of the longest."""
SHORTEST = 2.0**-16
"""A line that needs shorter steps, as a part of the longest, has come to a limit."""
AGAIN = 8
"""Segments at most in each turn beyond a limit: where what is as it was a turn before leads nowhere, more
are bits of a line that is not one."""
TRIALS = 64
QUICK = 6
"""Rounds of Newton's method that a step may take."""
HALVINGS = 30

AROUND, PLACES = [Decimal(2) ** -k for k in (14, 12, 10)], 6
"""Beside a singular position values are those of the polynomial through so many places on each side of it,
which are these parts of the longest step apart: the first at which doubles lead Newton's method along one
way."""
SMOOTH = Decimal("1e-12")
"""Values of one way follow from those around them to this part of their size; two ways differ by about as
much as the places do."""
DUST = Decimal("1e-100")
"""What is less is 0."""
BENT = 1e-4
"""Below this part of its size elsewhere the determinant of a group makes its row doubtful."""


Along = Callable[[Decimal], list[Decimal]]
"""Values by place of a line."""


class PathTracker:
    """Follows a line of inputs from a state, as far as the links assemble.

    Parameters
    ----------
    compiled : the record and its groups
    line : inputs by place
    start : the state where the line starts
    change_points : the places at which branches change
    reach : the least and the greatest place to which it is followed
    """

    def __init__(
        self,
        compiled: CompiledSweep,
        line: InputLine,
        start: State,
        change_points: ChangePoints,
        reach: tuple[float, float],
    ) -> None:
        self.compiled, self.line, self.start, self.change_points = compiled, line, start, change_points
        record, motion = compiled.record, compiled.motion
        assert motion is not None
        self.groups = [(group, Solver(record, group.equations)) for group in motion.groups]
        self.counted = list(record.counted.values())
        self.turning = Code(record, [record.lifted(value).index for _, value in self.counted])
        self.breaks: list[tuple[float, float]] = []
        """steps in which a group goes through a singular position and on"""
        self.senses: dict[float, Array] = {}
        self.last: tuple[Array, dict[int, Array], Mask, Mask] | None = None
        """the places that were asked for last, what was given of them, and where doubles settled it"""
        self.known: dict[tuple[tuple[int, ...], Decimal, Decimal], list[tuple[Decimal, list[Decimal]]]] = {}
        """by nodes, the places around which they were asked for, and how far these are apart"""
        self.reach = reach
        self.ends = (-math.inf, math.inf)
        """how far groups were followed to both sides, where that ended"""
        self.segments = self._followed(reach) if self.groups or self.counted else []

    # --- inputs -----------------------------------------------------------------------------------

    def given(self, s: Array) -> tuple[dict[int, Array], Mask]:
        """All inputs at places of the line.

        Parameters
        ----------
        s : (places,)

        Returns
        -------
        tuple[dict[int, Array], Mask]
            By node (inputs, signs, states of groups, counted turns), (places,) each; and to which places the
            groups were followed, (places,). Beyond a limit they were to none.
        """
        return self._at(s)[1:3]

    def unsettled(self, s: Array) -> Mask:
        """To which places, (places,), the groups were followed without that doubles solve them there."""
        _, _, good, settled = self._at(s)
        return good & ~settled

    def _at(self, s: Array) -> tuple[Array, dict[int, Array], Mask, Mask]:
        if not (self.last is not None and np.array_equal(self.last[0], s)):
            self.last = (s, *self._given(s))
        return self.last

    def exactly(self, s: Decimal) -> dict[int, Decimal]:
        """All inputs by node at a place of the line, those of the line itself in all digits.

        Raises Unreached where the groups have no solution.
        """
        floats, good = self.given(np.array([float(s)]))
        if not good.all():
            raise Unreached
        line, inputs = self.line, self.compiled.inputs
        given = {k: Decimal(float(np.ravel(v)[0])) for k, v in floats.items()}
        with localcontext(CONTEXT):
            for name, base in line.base.items():
                if name in inputs:
                    given[inputs[name]] = as_written(base) + as_written(line.slope.get(name, 0.0)) * s
        return given

    def along(self, exact: ExactRecord, nodes: Sequence[int], near: float) -> Along:
        """Nodes by places of the line near one of them, in all digits.

        Beside a singular position of a group, where Newton's method finds nothing or another way of
        assembling, and where the sign of a branch changes, which leaves what follows it undefined, the motion
        goes straight on: they are as `around` there.

        What is returned may raise Unreached where the groups have no solution.
        """
        found = self.around(exact, nodes, near) if self.turns_over(near) else None
        return found or self._values(exact, nodes)

    def around(self, exact: ExactRecord, nodes: Sequence[int], near: float) -> Along | None:
        """Nodes near a place of the line, in all digits: of the polynomial through places around it. None
        where these are not of one way."""
        for apart in AROUND:
            step = apart * as_written(self.line.widest)
            with localcontext(CONTEXT):
                middle = (as_written(near) / step).to_integral_value()
            key = (tuple(nodes), middle, step)
            if key not in self.known:
                self.known[key] = self._smooth(exact, nodes, middle, step)
            if known := self.known[key]:
                return partial(through, known)
        return None

    def _smooth(
        self, exact: ExactRecord, nodes: Sequence[int], middle: Decimal, step: Decimal
    ) -> list[tuple[Decimal, list[Decimal]]]:
        """Nodes at places around a multiple of a step, which neighbours share; none where they are not of one
        way."""
        values = self._values(exact, nodes)
        with localcontext(CONTEXT), suppress(Unreached):
            places = [(middle + k) * step for k in range(-PLACES, PLACES + 1) if k]
            if self.unbroken(float(places[0]), float(places[-1])):
                known = [(place, values(place)) for place in places]
                return known if is_smooth(known) else []
        return []

    def _values(self, exact: ExactRecord, nodes: Sequence[int]) -> Along:
        wanted = [exact.record.nodes[k] for k in nodes]
        return lambda s: exact.values(wanted, self.exactly(s))

    def turns_over(self, near: float) -> bool:
        """Whether a group is singular, or a branch changes its sign, about at a place of the line: doubles do
        not tell what follows from it there."""
        apart = float(AROUND[0]) * self.line.widest
        changes = chain.from_iterable(self.change_points.places.values())
        return any(abs(near - at) < apart for at in changes) or bool(self.bent(np.array([near]))[0])

    def _given(self, s: Array) -> tuple[dict[int, Array], Mask, Mask]:
        given, good = self._plain(s), np.ones(len(s), dtype=bool)
        if not (self.groups or self.counted):
            return given, good, good
        q, turns, good = self._interpolated(s)
        solved, _, right = self._solved(given, q, turns)
        solved = np.where(right[:, None], solved, q)
        return {**given, **self._state(solved, turns)}, good, right

    def singular(self, s: Array) -> Mask:
        """Which places, (places,), lie in a step through a singular position."""
        found = np.zeros(len(s), dtype=bool)
        for one, two in self.breaks:
            found |= (s > min(one, two)) & (s < max(one, two))
        return found

    def ending(self, s: Array) -> Mask:
        """Which places, (places,), lie so near to where the following ended that doubles leave open whether
        the groups reach there."""
        low, high = self.ends
        return (np.abs(s - low) <= self.slack) | (np.abs(s - high) <= self.slack)

    def ended(self, s: float) -> list[PathSegment]:
        """Where the path ended so near to a place that doubles leave open whether it reaches there, and
        another part of it, a turn away, does: its parts there, in the order in which they count."""
        here = [one for one in self.segments if one.s[0] - self.slack <= s <= one.s[-1] + self.slack]
        return sorted(here, key=self._is_main, reverse=True) if len(here) > 1 else []

    def unbroken(self, low: float, high: float) -> bool:
        """Whether the groups were followed from one place to another without a break."""
        if not (self.groups or self.counted):
            return True
        return any(segment.s[0] <= low and high <= segment.s[-1] for segment in self.segments)

    def limits(self) -> Iterator[tuple[PathSegment, float, float]]:
        """Where the groups were followed no further: the part of the path, its end, and whether that is the
        upper one (1) or the lower (-1). Others end where they would repeat, or were asked for no more."""
        done = (*self.reach, *self.ends)
        for segment in self.segments:
            main = self._is_main(segment)
            for end, sense in ((float(segment.s[0]), -1.0), (float(segment.s[-1]), 1.0)):
                cut = any(abs(end - place) <= self.line.widest * SHORTEST for place in done)
                if end in self.ends if main else not cut:
                    yield segment, end, sense

    def passages(self) -> list[float]:
        """The singular positions that groups go through."""
        return [self._passage(one, two) for one, two in self.breaks]

    def _passage(self, one: float, two: float) -> float:
        sense = self.senses[one]
        for _ in range(HALVINGS):
            middle = np.array([(one + two) / 2.0])
            q, turns, _ = self._interpolated(middle)
            given = self._plain(middle)
            q, turns, _ = self._solved(given, q, turns)
            if np.array_equal(self._senses(given, q, turns), sense):
                one = float(middle[0])
            else:
                two = float(middle[0])
        return (one + two) / 2.0

    def _plain(self, s: Array) -> dict[int, Array]:
        """Inputs and signs."""
        given = self.line.inputs(self.compiled, s)
        for name in self.compiled.motion.written if self.compiled.motion else ():
            if name in self.compiled.inputs:
                sign = self.start.signs[name]
                given[self.compiled.inputs[name]] = sign * self.change_points.flips(name, s, self.line)
        return given

    def _state(self, q: Array, turns: Array) -> dict[int, Array]:
        columns = [k for group, _ in self.groups for k in group.equations.solved]
        given = {k: q[:, n] for n, k in enumerate(columns)}
        return {**given, **{guess.index: turns[:, n] for n, (guess, _) in enumerate(self.counted)}}

    def end(self, s: float) -> State:
        """The state at a place, from which another line may go on."""
        at = np.array([s])
        signs = {
            name: sign * float(self.change_points.flips(name, at, self.line)[0])
            for name, sign in self.start.signs.items()
        }
        if not self.segments:
            return State(self.start.q, self.start.turns, signs)
        q, turns, _ = self._interpolated(at)
        given = self._plain(at)
        q, turns, _ = self._solved(given, q, turns)
        return State(q[0], turns[0], signs)

    # --- steps ------------------------------------------------------------------------------------

    def _solved(
        self, given: Mapping[int, Array], q: Array, turns: Array, rounds: int = ROUNDS
    ) -> tuple[Array, Array, Mask]:
        """Solutions of all groups from a guess, the turns counted on, and where it went well."""
        rows = len(q)
        good, found = np.ones(rows, dtype=bool), q.copy()
        first = 0
        for group, solver in self.groups:
            last = first + len(group.equations.solved)
            env = {**given, **self._state(found, turns)}
            found[:, first:last], right = solver.solve(env, q[:, first:last], rounds)
            good &= right
            first = last
        if self.counted:
            values = self.turning.run({**given, **self._state(found, turns)}, rows)
            turns = np.stack([np.broadcast_to(v, rows) for v in values], axis=1)
        return found, turns, good

    def _followed(self, reach: tuple[float, float]) -> list[PathSegment]:
        """Segments from the start to both ends of the reach."""
        at = np.array([self.line.start])
        q, turns, good = self._solved(self._plain(at), self.start.q[None, :], self.start.turns[None, :])
        if not good[0]:
            return []
        first = (self.line.start, q[0], turns[0])
        self.senses[self.line.start] = self._senses(self._plain(at), q, turns)
        down, up = self._both(first, reach)
        steps = [*reversed(down[1:]), *up]
        self.ends = (
            down[-1][0] if down[-1][0] > reach[0] else -math.inf,
            up[-1][0] if up[-1][0] < reach[1] else math.inf,
        )
        more = [
            segment
            for last, end in ((down[-1], reach[0]), (up[-1], reach[1]))
            for segment in self._beyond(last, end, steps)
        ]
        return sorted([segment_of(steps), *more], key=lambda segment: float(segment.s[0]))

    def _both(self, first: Step, reach: tuple[float, float]) -> tuple[list[Step], list[Step]]:
        """Steps down and up; from a limit on what lies beyond is reached from the other side."""
        down, up = self._steps(first, reach[0]), self._steps(first, reach[1])
        if self.line.period is not None and up[-1][0] < reach[1]:
            further = min(reach[0], up[-1][0] - self.line.period)
            down = self._steps(first, further)
        elif self.line.period is not None and down[-1][0] > reach[0]:
            up = self._steps(first, max(reach[1], down[-1][0] + self.line.period))
        return down, up

    def _beyond(self, last: Step, end: float, known: Sequence[Step]) -> Iterator[PathSegment]:
        """Segments beyond a limit, where it is as it was a turn before."""
        left = int(AGAIN * (1.0 + abs(last[0] - end) / (self.line.period or math.inf)))
        while left and abs(last[0] - end) > self.line.widest * SHORTEST:
            left -= 1
            again = self._again(last, end, known)
            if again is None:
                break
            back, on = self._steps(again, last[0]), self._steps(again, end)
            yield segment_of(sorted([*back[1:], *on], key=lambda step: step[0]))
            last = on[-1]

    def _again(self, last: Step, end: float, steps: Sequence[Step]) -> Step | None:
        """The first place beyond a limit that is a whole turn from one of the steps: there it is as before.

        Elsewhere beyond a limit the links may assemble, but no motion leads there.
        """
        if self.line.period is None:
            return None
        sense = 1.0 if end >= last[0] else -1.0
        trials = np.linspace(last[0], end, TRIALS)[1:]
        known = segment_of(sorted(steps, key=lambda step: step[0]))
        back = trials - sense * self.line.period * np.ceil(np.abs(trials - last[0]) / self.line.period)
        inside = (back >= known.s[0]) & (back <= known.s[-1])
        if not inside.any():
            return None
        trials, back = trials[inside], back[inside]
        guess, ahead = known.at(back)
        guess += (trials - back)[:, None] * self._driven()
        found, counted, good = self._solved(self._plain(trials), guess, ahead, QUICK)
        for k in np.flatnonzero(good):
            if goes_on(guess[k], guess[k], found[k], False):
                return (float(trials[k]), found[k], counted[k])
        return None

    def _driven(self) -> Array:
        """Which of the unknowns is the turning of the link that is driven (1, the others 0)."""
        setting = self.compiled.setting
        driven = {setting.top.body_of[link] for link in setting.links if link in self.line.slope}
        bodies = [body for group, _ in self.groups for body in group.bodies]
        return np.array([float(body in driven and part == 2) for body in bodies for part in range(3)])

    def _steps(self, first: Step, end: float) -> list[Step]:
        """Steps toward an end, as far as they go."""
        steps, widest = [first], self.line.widest
        sense = 1.0 if end >= first[0] else -1.0
        h = widest * FIRST
        while sense * (end - steps[-1][0]) > 0.0 and h > widest * SHORTEST:
            s = steps[-1][0]
            there = s + sense * min(h, sense * (end - s))
            at = np.array([there])
            found, counted, right = self._step(steps[-4:], there)
            if not right and len(steps) > 1 and (tangent := self._tangent(steps[-1], sense)) is not None:
                found, counted, right = self._step([tangent, steps[-1]], there)
            if right:
                self._orient(s, there, at, found, counted)
                steps.append((there, found[0], counted[0]))
                h = min(1.5 * h, widest)
            else:
                h /= 2.0
        return steps

    def _step(self, steps: Sequence[Step], there: float) -> tuple[Array, Array, bool]:
        """The state, (1, unknowns), and the counted turns at a place to which steps point, the last of them
        the one before it; and whether it went on there."""
        at, (_, q, turns) = np.array([there]), steps[-1]
        guess, ahead = segment_of(steps).at(at)
        found, counted, good = self._solved(self._plain(at), guess, ahead, QUICK)
        on = good[0] and goes_on(q, guess[0], found[0], len(steps) > 1) and counts(turns, counted[0])
        return found, counted, bool(on)

    def _tangent(self, step: Step, sense: float) -> Step | None:
        """A step so short that it and the given one tell the tangent, ahead of it: before a limit the last
        steps, which were long, point beside it however short the next one is."""
        there = step[0] + sense * self.line.widest * SHORTEST / 4.0
        found, counted, right = self._step([step], there)
        return (there, found[0], counted[0]) if right else None

    def _orient(self, s: float, there: float, at: Array, q: Array, turns: Array) -> None:
        """Note a singular position between two steps: the groups' determinants change sign there."""
        now = self._senses(self._plain(at), q, turns)
        if s in self.senses and not np.array_equal(self.senses[s], now):
            self.breaks.append((s, there))
        self.senses[there] = now

    def bent(self, s: Array) -> Mask:
        """Which of the places, (places,), are near a singular position of a group: its determinant is small
        beside what it is where the record was made.
        """
        small = np.zeros(len(s), dtype=bool)
        if not self.groups or not self.segments:
            return small
        given, _ = self.given(s)
        for group, solver in self.groups:
            q = np.stack([np.broadcast_to(given[k], len(s)) for k in group.equations.solved], axis=1)
            small |= ~(solver.determinant(given, q) > BENT * self._typical(group, solver))
        return small

    def _typical(self, group: NewtonGroup, solver: Solver) -> float:
        nodes = self.compiled.record.nodes
        env = {k: np.array([node.value]) for k, node in enumerate(nodes) if node.op == Op.INPUT}
        q = np.array([[nodes[k].value for k in group.equations.solved]])
        return float(solver.determinant(env, q)[0])

    def _senses(self, given: Mapping[int, Array], q: Array, turns: Array) -> Array:
        """Signs of the determinants of the groups at one place."""
        signs, first = [], 0
        for group, solver in self.groups:
            last = first + len(group.equations.solved)
            _, j = solver.system({**given, **self._state(q, turns)}, q[:, first:last])
            if j.shape[1] == j.shape[2]:
                signs.append(np.linalg.slogdet(j[0])[0])
            first = last
        return np.array(signs)

    # --- between steps ----------------------------------------------------------------------------

    @property
    def slack(self) -> float:
        """How far beyond a last step the links may reach."""
        return self.line.widest * SHORTEST * 16.0

    def _is_main(self, segment: PathSegment) -> bool:
        """Whether the path leads there from the position as written, and not from a turn away."""
        return bool(segment.s[0] <= self.line.start <= segment.s[-1])

    def _interpolated(self, s: Array) -> tuple[Array, Array, Mask]:
        """States between the steps, by the cubic through the four nearest."""
        q = np.full((len(s), self.start.q.size), np.nan)
        turns = np.zeros((len(s), self.start.turns.size))
        good = np.zeros(len(s), dtype=bool)
        for segment in sorted(self.segments, key=self._is_main):  # beside a limit that counts, the last
            here = (s >= segment.s[0] - self.slack) & (s <= segment.s[-1] + self.slack)
            if here.any():
                at = np.clip(s[here], segment.s[0], segment.s[-1])
                q[here], turns[here] = segment.at(at)
                good |= here
        q[~good] = self.start.q
        return q, turns, good


def through(known: Sequence[tuple[Decimal, Sequence[Decimal]]], s: Decimal) -> list[Decimal]:
    """The polynomials (Lagrange's) through values at places, each at another place."""
    weights = []
    for n, (at, _) in enumerate(known):
        others = [other for m, (other, _) in enumerate(known) if m != n]
        weights.append(math.prod(((s - other) / (at - other) for other in others), start=Decimal(1)))
    columns = zip(*(values for _, values in known), strict=True)
    return [sum((w * v for w, v in zip(weights, column, strict=True)), Decimal(0)) for column in columns]


def is_smooth(known: Sequence[tuple[Decimal, Sequence[Decimal]]]) -> bool:
    """Whether values at places in order are of one way: those at both ends follow from the others."""
    within = known[1:-1]
    sizes = [max(map(abs, column)) for column in zip(*(values for _, values in known), strict=True)]
    return all(
        abs(one - other) <= max(SMOOTH * size, DUST)
        for at, values in (known[0], known[-1])
        for one, other, size in zip(values, through(within, at), sizes, strict=True)
    )
