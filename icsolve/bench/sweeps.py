"""A full turn: `icsolve.sweep` against hand-written numpy and C, and the memory of a million positions."""

from __future__ import annotations

import ctypes
import tempfile
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from icsolve.bench.closed import FOUR_BAR_CASE, MECHANISMS, Array, Turning, compiled, in_c
from icsolve.bench.startup import peak_memory
from icsolve.bench.timing import least
from icsolve.case import Case
from icsolve.read import load
from icsolve.turn import sweep

TURN, MILLION = 3600, 1_000_000
PATH = "angles.AB"


class Timed(NamedTuple):
    """Seconds for so many positions of a mechanism, and the worst relative error of the torque.

    ``in_c`` is None without a C compiler.
    """

    name: str
    positions: int
    by_hand: float
    in_c: float | None
    swept: float
    bounded: float
    error: float


def full_turns(positions: int, seconds: float) -> list[Timed]:
    """Every mechanism at so many positions of its crank."""
    with tempfile.TemporaryDirectory() as folder:
        library = compiled(folder)
        return [_timed(mechanism, positions, seconds / len(MECHANISMS), library) for mechanism in MECHANISMS]


def _timed(mechanism: Turning, positions: int, seconds: float, library: ctypes.CDLL | None) -> Timed:
    degrees: Array = np.linspace(60.0, 420.0, positions, endpoint=False)
    radians, out = np.asarray(np.radians(degrees), dtype=np.float64), np.empty(positions)
    case = load(mechanism.case)
    calls: list[Callable[[], object]] = [
        lambda: mechanism.by_hand(radians),
        lambda: swept(case, degrees, ("answers",)),
        lambda: swept(case, degrees, ("answers", "error")),
    ]
    if library is not None:
        calls.append(in_c(library, mechanism, radians, out))
    times = least(calls, seconds)
    true = mechanism.by_hand(radians)
    error = float(np.abs(swept(case, degrees, ("answers",)) - true).max() / np.abs(true).max())
    in_c_seconds = times[3] if library is not None else None
    return Timed(mechanism.name, positions, times[0], in_c_seconds, times[1], times[2], error)


def swept(case: Case, degrees: Array, want: tuple[str, ...]) -> Array:
    """The crank's torque at every angle."""
    return sweep(case, {PATH: degrees}, want).answers["T2"]


def memory() -> float | None:
    """Largest resident memory in MB of a process that sweeps a million positions."""
    code = (
        "import numpy as np, icsolve\nfrom icsolve.turn import sweep\n"
        f"case = icsolve.load({FOUR_BAR_CASE!r})\n"
        f"sweep(case, {{{PATH!r}: np.linspace(60.0, 420.0, {MILLION})}}, ('answers',))"
    )
    return peak_memory(code)
