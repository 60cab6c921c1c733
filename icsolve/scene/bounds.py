"""A scene in as many digits as its questions need, and the numbers that are read from it.

The kernels run on balls of 30 digits. Where these leave a question open (a sign, a zero, a pivot), or a
number wider than a quarter of the last digit of its double, they run again with 60, then with 120. What that
leaves open is refused as too near a singular position. Each number is rounded once; its error is what that
rounding did, and the radius of its ball.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import TypeVar

from icsolve.errors import SceneError
from icsolve.numbers.arithmetic import FLOATS, Showing
from icsolve.numbers.balls import PRECISIONS, Balls, BelowZero, HalfUnits, MoreDigits
from icsolve.numbers.tape import Tape
from icsolve.scene import refusals
from icsolve.scene.program import Program, evaluate
from icsolve.screws.plane import Triple
from icsolve.statics.power import Bounded, Outcome, Value
from icsolve.tuples import NamedTuple

T = TypeVar("T")
Run = Callable[[Program, Showing], tuple[Program, Outcome]]
"""What evaluates a program: all of it, or its places alone."""


class Evaluation(NamedTuple):
    """A program that ran, its values, and the arithmetic in which it did."""

    program: Program
    outcome: Outcome
    arithmetic: Showing


class EvaluatedScene:
    """A program, evaluated in more digits as questions need them; ``certain`` False: in floats alone.

    With ``explained`` what half a unit of the last digits of long numbers may make zero is zero.
    """

    def __init__(self, program: Program, certain: bool, explained: bool = False, run: Run = evaluate) -> None:
        self.program, self.certain, self.explained, self.run = program, certain, explained, run
        self._arithmetics: list[Callable[[], Showing]] = [lambda: FLOATS]
        if certain:
            self._arithmetics = [lambda: HalfUnits(PRECISIONS[0])] if explained else _arithmetics(program)
        self._found: list[Evaluation | None] = []

    def ask(self, question: Callable[[Evaluation], T]) -> T:
        """The answer to a question by the fewest digits that settle it.

        Raises SceneError where the scene has no answer, and where the highest precision leaves it open.
        """
        for k in range(len(self._arithmetics)):
            found = self._evaluated(k)
            if found is not None:
                try:
                    return question(found)
                except MoreDigits:
                    continue
        raise self.too_close()

    def _evaluated(self, k: int) -> Evaluation | None:
        """The program in one of the arithmetics; None where its digits do not suffice."""
        if k == len(self._found):
            self._found.append(self._evaluate(self._arithmetics[k]()))
        return self._found[k]

    def _evaluate(self, arithmetic: Showing) -> Evaluation | None:
        try:
            return Evaluation(*self.run(self.program, arithmetic), arithmetic)
        except MoreDigits:
            return None
        except (BelowZero, ZeroDivisionError):
            raise refusals.not_as_written() from None

    def too_close(self) -> SceneError:
        """The refusal of what the highest precision leaves open."""
        program, outcome = self.run(self.program, FLOATS)
        unknown = next(iter(outcome.solution.values), "the answer")
        return refusals.too_close(program.top, outcome.motions, unknown, None)


MOST = 160
"""Digits that a chain may cost: with more, radii go beyond what floats hold."""


def _arithmetics(program: Program) -> list[Callable[[], Showing]]:
    """Balls of more and more digits, by as many more as a chain costs.

    Measured: a step that places a point costs some 1.1 digits, a group of the plan 0.1.
    """
    spent = 1.2 * len(program.figure.steps) + (0.15 * len(program.plan.groups) if program.plan else 0.0)
    extra = max(round(spent) - 12, 0)
    if extra > MOST:
        return [partial(Balls, PRECISIONS[1], highest=True, carried=0.0)]
    last = PRECISIONS[-1]
    return [partial(Balls, p + extra, highest=p == last) for p in PRECISIONS]


def points_shown(found: Evaluation) -> dict[str, tuple[float, float]]:
    """The points that have a name in the case, in case units."""
    a, (ox, oy, scale) = found.arithmetic, found.program.figure.frame
    shown = {}
    for name, (x, y) in found.outcome.points.items():
        if not name.startswith("@"):
            px, _ = a.rounded(x / scale + ox, 1.0 / scale + abs(ox))
            py, _ = a.rounded(y / scale + oy, 1.0 / scale + abs(oy))
            shown[name] = (px, py)
    return shown


def unknown_values(found: Evaluation) -> dict[str, Value]:
    """The unknown loads by name, and those that are like them."""
    solution, values = found.outcome.solution, {}
    for w in found.outcome.balance.wrenches:
        if w.root in solution.values:
            exact = w.ratio * solution.values[w.root]
            value, error = found.arithmetic.rounded(exact)
            if not abs(value) < math.inf:
                raise refusals.overflow(w.load.name)
            error += abs(w.ratio) * solution.off.get(w.root, 0.0)
            known = error < math.inf
            values[w.load.name] = Value(value, error if known else None, "" if known else UNASKED)
    return values


UNASKED = "no bound was asked for"


def evaluate_bounded(program: Program) -> Bounded:
    """Evaluate a program on a tape."""
    tape = Tape()
    return Bounded(evaluate(program, tape)[1], tape)


def slopes(scene: Bounded) -> dict[str, dict[str, float]]:
    """Derivative of every unknown load (and those like it) by every number of the case, by its path."""
    values = scene.outcome.solution.values
    by_root = {root: scene.tape.back(value).by_path for root, value in values.items()}
    return {
        w.load.name: {path: float(w.ratio) * slope for path, slope in by_root[w.root].items()}
        for w in scene.outcome.balance.wrenches
        if w.root in by_root
    }


def plain(outcome: Outcome) -> Outcome:
    """The outcome in floats, each number rounded once."""
    motions, balance = outcome.motions, outcome.balance
    twists = {link: tuple(map(floats, ts)) for link, ts in motions.twists.items()}
    wrenches = tuple(
        w._replace(unit=floats(w.unit), gain=float(w.gain), ratio=float(w.ratio)) for w in balance.wrenches
    )
    factors = tuple(tuple(map(float, row)) for row in balance.factors)
    return outcome._replace(
        points={name: (float(x), float(y)) for name, (x, y) in outcome.points.items()},
        motions=motions._replace(twists=twists),
        balance=balance._replace(wrenches=wrenches, factors=factors),
    )


def floats(t: Triple) -> Triple:
    """A triple off the tape."""
    return (float(t[0]), float(t[1]), float(t[2]))
