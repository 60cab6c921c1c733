"""A full turn: `icsolve.sweep` against hand-written numpy and C, and the memory of a million positions."""

from __future__ import annotations

import ctypes
import tempfile
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from icsolve.bench.closed import FOUR_BAR_CASE, MECHANISMS, Array, Turning, compiled, in_c
from icsolve.bench.peers import POSITIONS
from icsolve.bench.reference import Truth, truth
from icsolve.bench.startup import peak_memory
from icsolve.bench.timing import least
from icsolve.case import Case
from icsolve.read import load
from icsolve.sweep import sweep

TURN, MILLION = POSITIONS, 1_000_000
PATH = "angles.AB"
SWEPT, BOUNDED, BY_HAND, IN_C = "icsolve sweep", "icsolve sweep, bounds", "numpy by hand", "C -O3"
SAMPLE = 24
"""Positions of a turn at which the torque is known to sixty digits."""

Torque = Callable[[], Array]


class Timed(NamedTuple):
    """A method on so many positions of a mechanism: its seconds, and its worst error over a sample,
    relative and over (kappa + 1) u."""

    method: str
    mechanism: str
    positions: int
    seconds: float
    error: float
    per_unit: float


def full_turns(positions: int, seconds: float) -> dict[str, dict[str, Timed]]:
    """Every mechanism at so many positions of its crank, by every method; C where it compiles."""
    with tempfile.TemporaryDirectory() as folder:
        library = compiled(folder)
        each = seconds / len(MECHANISMS)
        return {m.name: _timed(m, positions, each, library) for m in MECHANISMS}


def _timed(
    mechanism: Turning, positions: int, seconds: float, library: ctypes.CDLL | None
) -> dict[str, Timed]:
    degrees: Array = np.linspace(60.0, 420.0, positions, endpoint=False)
    calls = _calls(mechanism, degrees, library)
    times = least(list(calls.values()), seconds)
    known = _known(mechanism, degrees)
    result = {}
    for (method, call), took in zip(calls.items(), times, strict=True):
        found = call()
        errors = [(true.error(float(found[k])), true) for k, true in known.items()]
        worst = max(true.per_unit(error) for error, true in errors)
        error = max(error for error, _ in errors)
        result[method] = Timed(method, mechanism.name, positions, took, error, worst)
    return result


def _calls(mechanism: Turning, degrees: Array, library: ctypes.CDLL | None) -> dict[str, Torque]:
    case = load(mechanism.case)
    radians, out = np.asarray(np.radians(degrees), dtype=np.float64), np.empty(len(degrees))
    calls: dict[str, Torque] = {
        BY_HAND: lambda: mechanism.by_hand(radians),
        SWEPT: lambda: swept(case, degrees, ("answers",)),
        BOUNDED: lambda: swept(case, degrees, ("answers", "error")),
    }
    if library is not None:
        run = in_c(library, mechanism, radians, out)

        def compiled_turn() -> Array:
            run()
            return out

        calls[IN_C] = compiled_turn
    return calls


def _known(mechanism: Turning, degrees: Array) -> dict[int, Truth]:
    """The torque at some positions, on the doubles; but where `near` picks the other way to assemble."""
    known = {}
    for k in range(0, len(degrees), max(1, len(degrees) // SAMPLE)):
        angle = float(degrees[k])
        by_hand = mechanism.by_hand(np.radians(degrees[k : k + 1]))[0]
        true = truth(load(mechanism.case.replace("AB: 60", f"AB: {angle!r}")))
        if true.error(float(by_hand)) < 1e-6:
            known[k] = true
    return known


def swept(case: Case, degrees: Array, want: tuple[str, ...]) -> Array:
    """The crank's torque at every angle."""
    return sweep(case, {PATH: degrees}, want).answers["T2"]


def memory() -> float | None:
    """Largest resident memory in MB of a process that sweeps a million positions."""
    code = (
        "import numpy as np, icsolve\nfrom icsolve.sweep import sweep\n"
        f"case = icsolve.load({FOUR_BAR_CASE!r})\n"
        f"sweep(case, {{{PATH!r}: np.linspace(60.0, 420.0, {MILLION})}}, ('answers',))"
    )
    return peak_memory(code)
