"""Questions that floats leave in doubt, put to the decimals as written.

The steps that lead to a doubtful one run again on balls of more and more digits, until its signs are
certain.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Protocol, TypeVar

from icsolve.assembly.intersections import PlacedCircle, gaps_of
from icsolve.assembly.steps import Meet, Step, aims
from icsolve.assembly.workspace import Key, Point, Workspace
from icsolve.numbers.arithmetic import Scalar
from icsolve.tuples import NamedTuple

T = TypeVar("T")


LONG_CHAINS = 300
"""Digits where bounds have grown along some hundred steps."""


class Placed(Protocol):
    """A step as it was settled; the same object as long as all before it are the same."""

    @property
    def step(self) -> Step | None:
        """The step."""


class _Decision(NamedTuple):
    """A construction on balls of some digits: what put each point, and the points that these digits lose."""

    workspace: Workspace
    made: dict[Key, Placed]
    lost: dict[Key, Placed]


class Decimals:
    """A construction run again on balls, as far as doubtful steps need it.

    ``placed`` has for each point the step that put it. What was run stays as long as that is the same one,
    so that a chain of doubtful steps runs once.
    """

    def __init__(self, workspace: Workspace, placed: Mapping[Key, Placed]) -> None:
        self.workspace, self.placed = workspace, placed
        self.runs: dict[int, _Decision] = {}

    def decided(self, step: Step, question: Callable[[Workspace], T]) -> T | None:
        """The answer to a question about a step; None where the digits leave it open."""
        from icsolve.numbers.balls import PRECISIONS, Balls, BelowZero, MoreDigits

        for digits in (*PRECISIONS, LONG_CHAINS):
            if digits not in self.runs:
                balls = Balls(digits, highest=digits >= PRECISIONS[-1])
                exact = Workspace(self.workspace.case, self.workspace.frame, balls)
                self.runs[digits] = _Decision(exact, {}, {})
            run = self.runs[digits]
            try:
                if not self._place(step.needs(), run):
                    return None
                for target in step.targets:
                    run.made.pop(target, None)
                return question(run.workspace)
            except (MoreDigits, BelowZero, ZeroDivisionError):
                continue
        return None

    def _place(self, keys: Iterable[Key], run: _Decision) -> bool:
        """Put points and all that they need; False where a start of Newton's method is being tried."""
        from icsolve.numbers.balls import BelowZero, MoreDigits

        stack = [key for key in keys if run.made.get(key) is not self.placed[key]]
        while stack:
            settled = self.placed[stack[-1]]
            step = settled.step
            if step is None:
                return False
            ahead = [key for key in step.needs() if run.made.get(key) is not self.placed[key]]
            try:
                if any(run.lost.get(key) is self.placed[key] for key in (stack[-1], *ahead)):
                    raise MoreDigits
                if ahead:
                    stack += ahead
                    continue
                if run.made.get(stack[-1]) is not settled:
                    step.place(run.workspace)
                    run.made.update(dict.fromkeys(step.targets, settled))
            except (MoreDigits, BelowZero, ZeroDivisionError):
                run.lost.update({key: self.placed[key] for key in stack if self._leads(key, stack[-1])})
                raise
            stack.pop()
        return True

    def _leads(self, key: Key, lost: Key) -> bool:
        """Whether a point is the one that was lost, or needs it directly."""
        step = self.placed[key].step
        return key == lost or (step is not None and lost in step.needs())


class Gap(NamedTuple):
    """A value in floats and its sign, -1, 0 or 1."""

    sign: int
    value: float


def _gap(workspace: Workspace, value: Scalar, size: float) -> Gap:
    if value == 0.0 if type(value) is float else workspace.arithmetic.vanishes(value, size):
        return Gap(0, 0.0)
    return Gap(1 if value > 0.0 else -1, float(value))


def gaps_between(step: Meet, workspace: Workspace) -> list[Gap]:
    """What must not be negative for two loci to meet, as `gaps_of` has it."""
    loci = step.loci(workspace)
    gaps = gaps_of(*loci, workspace.arithmetic)
    size = sum(abs(locus.radius) for locus in loci if isinstance(locus, PlacedCircle)) + 1.0
    size = size + abs(gaps[3]) if len(gaps) > 3 else size
    return [_gap(workspace, gap, size) for gap in gaps]


def gaps_ahead(step: Meet, workspace: Workspace) -> list[Gap]:
    """How far ahead on each ray the point lies, which is in place."""
    return [_gap(workspace, value, 1.0) for value in step.ahead(workspace)]


def gaps_ahead_of(step: Meet, workspace: Workspace) -> list[Gap]:
    """How far ahead on each ray the point comes to lie."""
    step.place(workspace)
    return gaps_ahead(step, workspace)


def merged_pairs(step: Step, workspace: Workspace) -> list[tuple[Key, Key]]:
    """The pairs of points that a step aims by and that are one place."""
    out = []
    for a, b in aims(step):
        (ax, ay), (bx, by) = workspace.points[a], workspace.points[b]
        if _gap(workspace, bx - ax, 1.0).sign == 0 and _gap(workspace, by - ay, 1.0).sign == 0:
            out.append((a, b))
    return out


def places_of(step: Step, workspace: Workspace) -> dict[Key, Point]:
    """Where a step puts its points, each coordinate the nearest double."""
    from icsolve.numbers.balls import Balls

    step.place(workspace)
    balls = workspace.arithmetic
    assert isinstance(balls, Balls)
    points = workspace.points
    return {
        t: (balls.rounded(points[t][0], 1.0)[0], balls.rounded(points[t][1], 1.0)[0]) for t in step.targets
    }
