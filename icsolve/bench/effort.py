"""How much is measured, and what is kept of it beside the tables."""

from __future__ import annotations

import os
from typing import NamedTuple

from icsolve.bench.accuracy import Score
from icsolve.bench.gates import Gate


class Effort(NamedTuple):
    """Scenes a family of the tables, scenes a family of each law, seconds a timing, processes."""

    scenes: int
    forward: int
    bounds: int
    bits: int
    seconds: float
    jobs: int

    @property
    def rounds(self) -> int:
        """Runs of what takes a tenth of a second or more."""
        return max(2, int(4 * self.seconds))


USUAL = Effort(80, 1_000, 500, 200, 3.0, 1)
FULL = Effort(400, 10_000, 12_000, 2_000, 6.0, os.cpu_count() or 1)


class Kept(NamedTuple):
    """What the tables leave: scores of single scenes, of full turns, peers that did not run, figures."""

    scenes: list[Score]
    turns: list[Score]
    absent: list[str]
    gates: list[Gate]


def nothing() -> Kept:
    """Before anything is measured."""
    return Kept([], [], [], [])
