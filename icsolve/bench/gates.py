"""What the product promises in figures, each as measured beside its limit; how much is measured; tables."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence

from icsolve.bench.accuracy import Score
from icsolve.tuples import NamedTuple


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(table_row(line) for line in lines)


def table_row(cells: Sequence[str]) -> str:
    """One row of it."""
    return "| " + " | ".join(cells) + " |"


class Gate(NamedTuple):
    """A figure and its limit, which it may not pass (with ``floor``: not fall short of).

    ``timed`` figures depend on what else the machine does; the others are laws.
    """

    what: str
    found: float
    limit: float
    unit: str = ""
    floor: bool = False
    timed: bool = True

    @property
    def held(self) -> bool:
        """Whether the figure keeps its limit; nan does not."""
        return self.found >= self.limit if self.floor else self.found <= self.limit


def ratio(what: str, found: float, limit: float, *, floor: bool = False) -> Gate:
    """How many times."""
    return Gate(what, found, limit, " x", floor)


def lawful(what: str, found: float, limit: float) -> Gate:
    """What holds on any machine."""
    return Gate(what, found, limit, timed=False)


def gate_table(gates: Iterable[Gate]) -> str:
    """Every figure with its limit, and whether it is kept."""
    return table(("figure", "measured", "asked", "kept"), map(_row, gates))


def _row(gate: Gate) -> list[str]:
    asked = f"{'at least' if gate.floor else 'at most'} {gate.limit:g}{gate.unit}"
    return [gate.what, f"{gate.found:.3g}{gate.unit}", asked, "yes" if gate.held else "NO"]


class Effort(NamedTuple):
    """Scenes a family of the tables, scenes a family of each law (of the digits, of the first), seconds a
    timing, processes."""

    scenes: int
    forward: int
    bounds: int
    bits: int
    digits: int
    seconds: float
    jobs: int

    @property
    def rounds(self) -> int:
        """Runs of what takes a tenth of a second or more."""
        return max(2, int(4 * self.seconds))


USUAL = Effort(80, 1_000, 500, 200, 400, 3.0, 1)
FULL = Effort(400, 10_000, 12_000, 2_000, 40_000, 6.0, os.cpu_count() or 1)


class Kept(NamedTuple):
    """What the tables leave: scores of single scenes, of full turns, peers that did not run, figures."""

    scenes: list[Score]
    turns: list[Score]
    absent: list[str]
    gates: list[Gate]


def nothing() -> Kept:
    """Before anything is measured."""
    return Kept([], [], [], [])
