"""Bounds of rows that stand at a limit: two places of a pin have become one.

There half their chord is the root of a radicand that is zero to within its own bound b, and its derivative
is without bound. The chord itself is not: it is zero to within the root of b, and weighs like any number.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from icsolve.numbers.record import Root
from icsolve.numbers.replay import Array
from icsolve.sweep.branches import TOUCH
from icsolve.sweep.runner import Key, Rows, Runner, column

Given = Callable[[Rows], dict[int, Array]]


def bound_flat(runner: Runner, given: Given, errors: dict[Key, Array], rows: Rows, into: Rows) -> None:
    """Bound all outputs of rows whose first bounds are not numbers, where a chord has vanished.

    ``rows`` are places among those that ``given`` has the inputs of, ``into`` their places in the tables.
    """
    roots = runner.branches
    flat = _flat(runner, given, rows)
    for pattern in np.unique(flat[flat.any(axis=1)], axis=0):
        some = (flat == pattern).all(axis=1)
        leaves = [root for root, is_flat in zip(roots, pattern, strict=True) if is_flat]
        _bound(runner, leaves, given(rows[some]), errors, into[some])


def _flat(runner: Runner, given: Given, rows: Rows) -> np.typing.NDArray[np.bool_]:
    """Which chords have vanished, (rows, roots)."""
    flat = np.zeros((len(rows), len(runner.branches)), dtype=bool)
    found = runner.reaching.run(given(rows), len(rows)) if runner.branches else []
    for n in range(len(runner.branches)):
        a, a_size, b, b_size = found[4 * n : 4 * n + 4]
        flat[:, n] = np.minimum(np.abs(a) / a_size, np.abs(b) / b_size) <= TOUCH
    return flat


def _bound(
    runner: Runner, leaves: list[Root], given: dict[int, Array], errors: dict[Key, Array], into: Rows
) -> None:
    """The bounds with some chords as numbers of their own, each zero to within the root of a bound."""
    nodes = [root.node for root in leaves]
    given = {**given, **dict.fromkeys(nodes, np.array(0.0))}
    radicands = runner.passes([root.radicand for root in leaves], nodes).run(given, len(into))
    chords = {node: np.sqrt(passed.bound) for node, passed in zip(nodes, radicands, strict=True)}
    outputs = [(key, part, index) for key, part, index in runner.moving]
    found = runner.passes([index for *_, index in outputs], nodes).run(given, len(into))
    for (key, part, _), passed in zip(outputs, found, strict=True):
        chord = sum((np.abs(w) * chords[k] for k, w in passed.by.items() if k in chords), np.zeros(len(into)))
        column(errors[key], part)[into] = passed.bound + chord
