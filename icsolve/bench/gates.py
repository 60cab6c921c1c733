"""What the product promises in figures: each as measured, beside the limit that it is held to."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from icsolve.bench.tables import table


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
