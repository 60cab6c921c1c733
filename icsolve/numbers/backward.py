"""Bounds of the rounding errors of every row: the backward pass of `icsolve.numbers.tape`, on arrays.

The weight of a value (the derivative of the result by it) times its own rounding error, summed over all
values that lead to the result. In a product, a quotient or a root the relative errors of the factors
weigh the same and are counted together. Values that are the same in every row bring the bound of
their own errors; a group that Newton's method solved brings those of its equations.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from icsolve.numbers.adjoint import still_noise
from icsolve.numbers.passing import Pass, Passed, Scratch
from icsolve.numbers.record import Op, Record, Traced
from icsolve.numbers.replay import Array, Code

SLICE = 1024
"""Rows of one pass; fewer where there are very many values."""
MANY = 600


class Backward:
    """Backward passes over a record from some of its nodes: first-order bounds of their rounding errors.

    Parameters
    ----------
    record : the record
    targets : nodes whose errors are asked for
    exact : inputs that carry no rounding: signs, guesses, counts of turns

    At most ``rows`` rows go through at once.
    """

    def __init__(self, record: Record, targets: Sequence[int], exact: Iterable[int]) -> None:
        self.record, self.targets, self.exact = record, targets, frozenset(exact)
        self.groups = {min(group.solved): group for group in record.implicit}
        self.member = {k: group for group in record.implicit for k in group.solved}
        self._ahead: dict[int, list[int]] = {}
        nodes = self.reached(targets)
        self.guesses = {
            g: s
            for group in record.implicit
            for g, s in zip(group.guesses, group.solved, strict=True)
            if g in nodes
        }
        self.code = Code(record, sorted(nodes), keep=True)
        self.rows = SLICE if len(nodes) < MANY else SLICE // 4
        self._still: dict[int, float] = {}
        self._passes: dict[tuple[int, int], Pass] = {}
        self._scratch: dict[int, Scratch] = {}
        self._terms = 3 * len(nodes) + 3

    def reached(self, targets: Iterable[int]) -> set[int]:
        """The nodes that vary and lead to the targets, through groups as well."""
        seen: set[int] = set()
        nodes, known = self.record.nodes, self._ahead
        stack = [k for k in targets if nodes[k].row]
        while stack:
            k = stack.pop()
            if k not in seen:
                seen.add(k)
                if k not in known:
                    known[k] = [n for n in self._behind(k) if nodes[n].row]
                stack += known[k]
        return seen

    def _behind(self, k: int) -> Iterable[int]:
        op = self.record.nodes[k].op
        if op in (Op.COS, Op.SIN):
            return (*self.record.nodes[k].of, k + 1 if op == Op.COS else self.record.nodes[k].b)
        if k not in self.member:
            return self.record.nodes[k].of
        group = self.member[k]
        return [*(v.index for v in group.parts if isinstance(v, Traced)), *group.solved, *group.guesses]

    def noise(self, k: int) -> float:
        """Bound of the error of a value that is the same in every row [its units]."""
        if k not in self._still:
            self._still[k] = still_noise(self.record, k)
        return self._still[k]

    def scratch(self, room: int) -> Scratch:
        """Buffers of so many rows, which all passes share."""
        if room not in self._scratch:
            self._scratch[room] = Scratch([], np.empty((self._terms, room)))
        return self._scratch[room]

    def run(self, given: Mapping[int, Array], rows: int) -> list[Passed]:
        """Bounds of the targets.

        Parameters
        ----------
        given : by node, values of the inputs and of the groups' unknowns, (rows,) or one number
        rows : at most `Backward.rows`

        Returns
        -------
        list[Passed]
            For each target the bound of its absolute error, (rows,) [its units]; inf or nan where a value
            that leads to it does not exist.
        """
        self.code.fill({**given, **{g: given[s] for g, s in self.guesses.items()}}, rows)
        with np.errstate(all="ignore"):
            return [self._passed(target, rows) for target in self.targets]

    def _passed(self, target: int, rows: int) -> Passed:
        if not self.record.nodes[target].row:
            return Passed(np.full(rows, self.noise(target)), {})
        room = self.code.bound(rows)[1].shape[1]
        if (target, room) not in self._passes:
            self._passes[target, room] = Pass(self, target, room)
        return self._passes[target, room].run(rows)

    def value(self, k: int, rows: int) -> Array:
        """A node's value in the last run, (rows,)."""
        return self.code.value(k, rows)
