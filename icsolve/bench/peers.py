"""The same full turn of the same four-bar by other programs, where they are installed.

Each is used as its own examples use it. What gives no torque is timed for what it gives.
"""

from __future__ import annotations

import contextlib
import io
import math
from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np

from icsolve.bench.closed import FOUR_BAR, Array, four_bar
from icsolve.bench.timing import once
from icsolve.tuples import NamedTuple

POSITIONS = 3600
"""Of a full turn, here and in the sweeps."""


class Peer(NamedTuple):
    """Another program: what it gives, a call that makes the full turn ready to be run, and whether it
    is compiled by numba where that is installed."""

    package: str
    gives: str
    prepare: Callable[[Array], Callable[[], Array]]
    compiles: bool = False


class Ran(NamedTuple):
    """How long a peer took for the full turn, its worst relative error, or why it did not run."""

    name: str
    gives: str
    seconds: float
    error: float
    why: str = ""


def _kinepy(angle: Array) -> Callable[[], Array]:
    from kinepy import System

    a, b, c, d, t = FOUR_BAR
    system = System()
    crank, rod, rocker = (system.add_solid(name) for name in ("crank", "rod", "rocker"))
    motor = system.add_revolute(0, crank, (0.0, 0.0), (0.0, 0.0))
    system.add_revolute(crank, rod, (a, 0.0), (0.0, 0.0))
    system.add_revolute(rod, rocker, (b, 0.0), (c, 0.0))
    system.add_revolute(rocker, 0, (0.0, 0.0), (d, 0.0))
    system.pilot(motor)
    system.compile()
    rocker.add_torque(t)

    def run() -> Array:
        system.solve_statics(angle.copy()[None, :])
        return -np.asarray(motor.torque, dtype=np.float64)

    for sign in (1, -1):
        system.change_signs([sign])
        if np.allclose(run(), four_bar(angle)):
            return run
    raise ValueError("no sign of the assembly gives the torque")


def _pylinkage(angle: Array) -> Callable[[], Array]:
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import RRRDyad
    from pylinkage.simulation import Linkage

    a, b, c, d, _ = FOUR_BAR
    step = float(angle[1] - angle[0])

    def run() -> Array:
        one, two = Ground(0.0, 0.0, name="A"), Ground(d, 0.0, name="D")
        crank = Crank(
            anchor=one, radius=a, angular_velocity=step, initial_angle=float(angle[0]) - step, name="AB"
        )
        rocker = RRRDyad(anchor1=crank.output, anchor2=two, distance1=b, distance2=c, name="C")
        linkage = Linkage([one, two, crank, rocker], name="four-bar")
        return np.asarray(linkage.step_fast(len(angle)), dtype=np.float64)

    return run


def _loop(angle: Any, rod: Any, rocker: Any, cos: Any, sin: Any) -> tuple[Any, Any]:
    """The two equations that close the four-bar."""
    a, b, c, d, _ = FOUR_BAR
    return (
        a * cos(angle) + b * cos(rod) - c * cos(rocker) - d,
        a * sin(angle) + b * sin(rod) - c * sin(rocker),
    )


def _start(angle: float) -> tuple[float, float]:
    """Rod and rocker angles that close the first position."""
    a, b, c, d, _ = FOUR_BAR
    bx, by = a * math.cos(angle), a * math.sin(angle)
    apart = math.hypot(d - bx, by)
    rod = math.acos((b * b + apart * apart - c * c) / (2 * b * apart)) + math.atan2(-by, d - bx)
    return rod, math.atan2(by + b * math.sin(rod), bx + b * math.cos(rod) - d)


def _scipy(angle: Array) -> Callable[[], Array]:
    from scipy.optimize import fsolve

    a, _, c, _, t = FOUR_BAR

    def run() -> Array:
        torque, guess = np.empty(len(angle)), np.array(_start(float(angle[0])))
        for k, theta in enumerate(angle):
            guess = fsolve(lambda x, q=theta: _loop(q, x[0], x[1], np.cos, np.sin), guess, xtol=1e-12)
            rod, rocker = guess
            torque[k] = -t * (a * np.sin(rod - theta)) / (c * np.sin(rod - rocker))
        return torque

    return run


def _sympy(angle: Array) -> Callable[[], Array]:
    import sympy

    q, rod, rocker = sympy.symbols("q rod rocker")
    equations = sympy.Matrix(_loop(q, rod, rocker, sympy.cos, sympy.sin))
    slopes = equations.jacobian([rod, rocker])
    rates = -slopes.LUsolve(equations.jacobian([q]))
    closes = sympy.lambdify((q, rod, rocker), (equations, slopes), "numpy")
    torque_of = sympy.lambdify((q, rod, rocker), -FOUR_BAR[4] * rates[1], "math")

    def run() -> Array:
        torque, x = np.empty(len(angle)), np.array(_start(float(angle[0])))
        for k, theta in enumerate(angle):
            for _ in range(20):
                off, matrix = closes(theta, *x)
                step = np.linalg.solve(matrix, off[:, 0])
                x = x - step
                if np.abs(step).max() < 1e-14:
                    break
            torque[k] = torque_of(theta, *x)
        return torque

    return run


TORQUE, PLACES = "torque", "positions only"
PEERS = (
    Peer("kinepy", TORQUE, _kinepy),
    Peer("sympy", TORQUE, _sympy),
    Peer("scipy", TORQUE, _scipy),
    Peer("pylinkage", PLACES, _pylinkage, compiles=True),
)


def ran(peer: Peer, rounds: int) -> Ran:
    """Run a peer's full turn; what goes wrong with it is told, not raised."""
    try:
        name = _named(peer)
    except PackageNotFoundError:
        return Ran(peer.package, peer.gives, math.nan, math.nan, "not installed")
    angle: Array = np.linspace(0.0, 2.0 * np.pi, POSITIONS, endpoint=False)
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            run = peer.prepare(angle)
            found = run()
            seconds = min(once(run) for _ in range(rounds))
    except Exception as error:  # another program's failure is its own
        return Ran(name, peer.gives, math.nan, math.nan, f"{type(error).__name__}: {error}"[:80])
    return Ran(name, peer.gives, seconds, _error(peer, angle, found))


def _named(peer: Peer) -> str:
    """A peer with its version; one that compiles where numba is there, with that.

    Raises PackageNotFoundError.
    """
    name = f"{peer.package} {version(peer.package)}"
    with contextlib.suppress(PackageNotFoundError):
        return f"{name} with numba {version('numba')}" if peer.compiles else name
    return name


def _error(peer: Peer, angle: Array, found: Array) -> float:
    """Largest error of the torque over its largest value; of positions, of the rocker's length."""
    if peer.gives == TORQUE:
        true = four_bar(angle)
        return float(np.abs(found - true).max() / np.abs(true).max())
    ends = found[:, -1, :] - np.array([FOUR_BAR[3], 0.0])
    return float(np.abs(np.hypot(ends[:, 0], ends[:, 1]) / FOUR_BAR[2] - 1.0).max())
