"""The second look at doubtful rows: do they assemble, does rounding decide them, what would one scene say.

Whether links reach one another is told by the margins of the branches. What is divided by, and the
answers, are held against their error bounds; a row that its bounds leave open is solved as a scene.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from icsolve.answer import Answer
from icsolve.case import Case, Coordinates
from icsolve.errors import SceneError, Status
from icsolve.numbers.replay import Array, Code
from icsolve.solve import solve
from icsolve.sweep.branches import TOUCH
from icsolve.sweep.runner import AGREED, Found, Key, Rows, Runner, column

OPEN = 1e-3
"""An answer whose bound is a larger fraction of it is not trusted."""
WIDE = 4.0
"""A divisor within so many of its bounds may be zero."""
ROUNDED = 1e-14
"""A margin of the figure that is this little below zero is zero (normalised)."""
PLACED = 1e-11
"""A row whose points have larger bounds (normalised) is not decided by a scene of its own."""
MOST_SCENES = 2000
"""More doubtful rows than these are not solved one by one."""

Mask = npt.NDArray[np.bool_]
WORDS = (
    Status.OK,
    Status.CANNOT_ASSEMBLE,
    Status.CHANGE_POINT,
    Status.DEAD_CENTRE,
    Status.NO_VALUE,
    Status.ANY_VALUE,
    Status.NEAR_SINGULAR,
    Status.MOBILITY,
    Status.STRUCTURE,
    Status.UNSUPPORTED,
    Status.INCONSISTENT,
    Status.CONTRADICTORY,
    Status.LOOSE,
    Status.AMBIGUOUS,
    Status.UNDERDETERMINED,
    "holds",
    Status.JAM,
    Status.UNBALANCED,
)
"""The statuses of rows; ``holds``: with friction and no motion, the unknown holds over a range."""
CODE = {word: n for n, word in enumerate(WORDS)}

Codes = npt.NDArray[np.int8]


class Look(NamedTuple):
    """What a second look has: the runner and its rows, and how a row becomes a case."""

    runner: Runner
    given: Callable[[Rows], dict[int, Array]]
    found: Found
    codes: Codes
    case_of: Callable[[int], Case]


def look_again(look: Look) -> None:
    """Settle doubtful rows: their status, and their values where there are some."""
    rows = look.found.doubtful[look.codes[look.found.doubtful] == 0]
    _as_written(look, rows)
    rows = rows[look.codes[rows] == 0]
    touching = _margins(look, rows)
    rows, touching = rows[look.codes[rows] == 0], touching[look.codes[rows] == 0]
    _flatten(look, rows, touching)
    flat = touching.any(axis=1)
    singular, loose = _against_bounds(look, rows)
    loose &= ~flat
    doubtful = rows[singular | loose | flat]
    for row in doubtful[:MOST_SCENES]:
        _as_scene(look, int(row))
    open_, drifting = rows[loose & ~singular], _adrift(look, rows[singular & ~flat])
    left = np.concatenate([doubtful[MOST_SCENES:], open_, drifting])
    _silence(look, left[look.codes[left] == 0], Status.NEAR_SINGULAR)


def _adrift(look: Look, rows: Rows) -> Rows:
    """Rows whose places are not known well enough for a scene of their own to decide them."""
    rows = rows[look.codes[rows] == 0]
    if not rows.size:
        return rows
    passes = look.runner.places
    off = np.zeros(len(rows), dtype=bool)
    for start in range(0, len(rows), passes.rows):
        here = slice(start, start + passes.rows)
        for passed in passes.run(look.given(rows[here]), len(rows[here])):
            off[here] |= ~(passed.bound <= PLACED)
    return rows[off]


def _silence(look: Look, rows: Rows, status: str) -> None:
    """Rows that have no answer."""
    look.codes[rows] = CODE.get(status, CODE[Status.NEAR_SINGULAR])
    for key, array in look.found.values.items():
        if key[0] == "answers":
            array[rows] = np.nan


def _as_written(look: Look, rows: Rows) -> None:
    """Mark the rows whose figure cannot assemble as if written so, or whose spare conditions are not met."""
    margins, checks = look.runner.margins, look.runner.checks
    if not (margins or checks) or not len(rows):
        return
    found = look.runner.conditions.run(look.given(rows), len(rows))
    for n, value in enumerate(found):
        apart = ~(value >= -ROUNDED) if n < len(margins) else ~(np.abs(value) <= AGREED)
        look.codes[rows[np.broadcast_to(apart, len(rows))]] = CODE[Status.CANNOT_ASSEMBLE]


def _margins(look: Look, rows: Rows) -> Mask:
    """Mark the rows that cannot assemble; which branches touch in the others (rows, branches)."""
    roots = look.runner.branches
    touching = np.zeros((len(rows), len(roots)), dtype=bool)
    if not roots or not len(rows):
        return touching
    found = [np.broadcast_to(v, len(rows)) for v in look.runner.reaching.run(look.given(rows), len(rows))]
    apart = np.zeros(len(rows), dtype=bool)
    with np.errstate(all="ignore"):
        for n in range(len(roots)):
            a, a_size, b, b_size = found[4 * n : 4 * n + 4]
            margin = np.minimum(a / a_size, b / b_size)
            apart |= ~(margin >= -TOUCH)
            touching[:, n] = np.abs(margin) <= TOUCH
    look.codes[rows[apart]] = CODE[Status.CANNOT_ASSEMBLE]
    return touching


def _flatten(look: Look, rows: Rows, touching: Mask) -> None:
    """Run rows again whose branches touch, the chord of those being zero."""
    runner, roots = look.runner, look.runner.branches
    for pattern in np.unique(touching[touching.any(axis=1)], axis=0):
        flat = [root.node for root, touches in zip(roots, pattern, strict=True) if touches]
        some = rows[(touching == pattern).all(axis=1)]
        code = Code(runner.sheet.record, [index for _, _, index in runner.moving], flat)
        given = {**look.given(some), **dict.fromkeys(flat, np.array(0.0))}
        for (key, part, _), array in zip(runner.moving, code.run(given, len(some)), strict=True):
            column(look.found.values[key], part)[some] = array


def _against_bounds(look: Look, rows: Rows) -> tuple[Mask, Mask]:
    """Rows in which something that is divided by may be zero, and those whose answer rounding leaves open;
    an answer within its own bound becomes zero."""
    runner = look.runner
    answers, passes = runner.answers, runner.doubts
    singular, loose = np.zeros(len(rows), dtype=bool), np.zeros(len(rows), dtype=bool)
    if not passes.targets:
        return singular, loose
    for start in range(0, len(rows), passes.rows):
        here = slice(start, start + passes.rows)
        some = rows[here]
        bounds = passes.run(look.given(some), len(some))
        with np.errstate(all="ignore"):
            for target, passed in zip(runner.divisors, bounds[len(answers) :], strict=True):
                singular[here] |= ~(np.abs(passes.value(target, len(some))) > WIDE * passed.bound)
            for (key, _), passed in zip(answers, bounds, strict=False):
                value = look.found.values[key][some]
                inside = np.abs(value) <= passed.bound
                look.found.values[key][some[inside & ~singular[here]]] = 0.0
                loose[here] |= ~inside & ~(passed.bound <= OPEN * np.abs(value))
    return singular, loose


def _as_scene(look: Look, row: int) -> None:
    """Solve one row as a scene: its status, or its values."""
    outputs, case = look.found.values, look.case_of(row)
    if not _placed(case):
        _silence(look, np.array([row]), Status.CHANGE_POINT)
        return
    try:
        rates = any(key[0] in ("rates", "centres") for key in outputs)
        answer = solve(case, rates=rates, all_centres=rates)
    except SceneError as error:
        _silence(look, np.array([row]), error.status)
        return
    for key in outputs:
        if key[0] == "answers" and key[1] in answer.answers:
            look.found.values[key][row] = answer.answers[key[1]].value
    _motions(look, row, answer)


def _placed(case: Case) -> bool:
    """Whether every point has a place: two circles that have become one meet everywhere."""
    given = [at for at in case.points.values() if isinstance(at, Coordinates)]
    return all(math.isfinite(n.value) for at in given for n in (at.x, at.y) if n is not None)


def _motions(look: Look, row: int, answer: Answer) -> None:
    for kind, name in look.found.values:
        if kind == "rates" and answer.rates is not None:
            rate = answer.rates.get(name)
            if isinstance(rate, float):
                look.found.values[kind, name][row] = rate


__all__ = ["CODE", "WORDS", "Codes", "Key", "Look", "look_again"]
