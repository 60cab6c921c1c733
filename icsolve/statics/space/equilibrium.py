"""Equilibrium of every body in space: sums of forces and of moments, linear in what the joints transmit."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from icsolve.numbers.sparse import General, Row, eliminate
from icsolve.statics.space.loading import Wrenched, acting, is_unknown, scale_of
from icsolve.statics.space.ties import Tie, Wrench
from icsolve.statics.space.vectors import Vec, add, cross, sub, times

SPENT_TRIES = (1e-13, 1e-12, 1e-11, 1e-10, 1e-14)
"""Below these fractions of its size the largest entry of a row counts as rounding: the usual one first."""


class Statics(NamedTuple):
    """The general solution of the equilibrium of all bodies but the frame.

    Column numbers: the units of the ties from ``first[t]`` on, then the parameters: the known loads
    together (``known``, times ``scale``), then the unknown loads ``roots`` (theirs times ``scale``).
    """

    ties: tuple[Tie, ...]
    first: tuple[int, ...]
    known: int
    roots: tuple[str, ...]
    scale: float
    general: General
    equations: dict[str, tuple[Vec, tuple[Row, ...]]]
    """for each link the point of its moments, and its three forces and three moments"""

    def parameters(self, unknowns: Mapping[str, float]) -> Row:
        """Values of all parameters, from numbers in case units."""
        return {
            self.known: 1.0,
            **{self.known + 1 + n: unknowns[root] * self.scale for n, root in enumerate(self.roots)},
        }

    def columns(self, t: int) -> range:
        """The columns of a tie."""
        return range(self.first[t], self.first[t] + len(self.ties[t].units))

    def value(self, column: int, parameters: Mapping[int, float]) -> float:
        """A joint's unknown, scaled, where the free columns are zero."""
        return math.fsum(a * parameters.get(c, 0.0) for c, a in self.general.of(column).items())


def statics_of(
    links: Sequence[str], ties: tuple[Tie, ...], loads: Sequence[Wrenched], freedoms: int
) -> Statics:
    """Solve the equilibrium of ``links`` for what the ties transmit.

    ``freedoms`` is how many equations have to lose all joints: rounding that hides it is seen through.
    """
    first, known = _columns(ties)
    roots = tuple(w.root for w in loads if is_unknown(w.load))
    scale = scale_of(loads)
    equations = _equations(links, ties, first, loads, roots, known, scale)
    rows = [row for _, six in equations.values() for row in six]
    general = eliminate(rows, known)
    for spent in SPENT_TRIES[1:]:
        if len(general.left) == freedoms:
            break
        other = eliminate(rows, known, spent)
        general = other if len(other.left) == freedoms else general
    return Statics(ties, first, known, roots, scale, general, equations)


def _columns(ties: Sequence[Tie]) -> tuple[tuple[int, ...], int]:
    """The first column of each tie, and their number."""
    first, column = [], 0
    for tie in ties:
        first.append(column)
        column += len(tie.units)
    return tuple(first), column


def _equations(
    links: Sequence[str],
    ties: Sequence[Tie],
    first: Sequence[int],
    loads: Sequence[Wrenched],
    roots: Sequence[str],
    known: int,
    scale: float,
) -> dict[str, tuple[Vec, tuple[Row, ...]]]:
    """Six equations a link; the moments are taken about a point of its own."""
    rows = _Rows(links, ties)
    for tie, column in zip(ties, first, strict=True):
        for n, wrench in enumerate(tie.units):
            rows.between(tie.on, tie.by, tie.at, wrench, column + n)
    for w in loads:
        force, couple = acting(w)
        column = known if w.known is not None else known + 1 + roots.index(w.root)
        share = 1.0 if w.known is None else w.known * scale
        wrench = (times(share, force), times(share, couple))
        rows.between(w.load.link, w.against, w.at, wrench, column)
    return {link: (rows.about[link], six) for link, six in rows.rows.items()}


class _Rows:
    """The equations while they are summed."""

    def __init__(self, links: Sequence[str], ties: Sequence[Tie]) -> None:
        self.about: dict[str, Vec] = {}
        for tie in ties:
            self.about.setdefault(tie.on, tie.at)
            self.about.setdefault(tie.by, tie.at)
        self.rows: dict[str, tuple[Row, ...]] = {link: tuple({} for _ in range(6)) for link in links}

    def between(self, on: str, by: str, at: Vec, wrench: Wrench, column: int) -> None:
        """A force and couple on one link, the opposite on the other."""
        force, couple = wrench
        self.add(on, at, force, couple, column)
        self.add(by, at, times(-1.0, force), times(-1.0, couple), column)

    def add(self, link: str, at: Vec, force: Vec, couple: Vec, column: int) -> None:
        """A force and couple at a point of a link."""
        if link not in self.rows:
            return
        moment = add(couple, cross(sub(at, self.about[link]), force))
        for row, value in zip(self.rows[link], (*force, *moment), strict=True):
            if value:
                row[column] = row.get(column, 0.0) + value
