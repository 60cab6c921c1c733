"""A full turn in other ways: three mechanisms by their closed forms, in numpy by hand and in C, beside the
same as cases; and the four-bar by other programs, where they are installed.

Each program is used as its own examples use it. What gives no torque is timed for what it gives.
"""

from __future__ import annotations

import contextlib
import ctypes
import io
import math
import os
import shutil
import subprocess
from collections.abc import Callable, Sequence
from importlib.metadata import PackageNotFoundError, version
from importlib.resources import files
from typing import Any

import numpy as np
import numpy.typing as npt

from icsolve.assembly.loci import PlacedCircle, intersection
from icsolve.bench.gates import once
from icsolve.numbers import FLOATS, turn_of
from icsolve.screws import Triple, cross, dyad_twists, pairing, pin_twist
from icsolve.tuples import NamedTuple

Array = npt.NDArray[np.float64]
Closed = Callable[[Array], Array]
"""Torque on the crank for its angles in radians."""


class CrankTurning(NamedTuple):
    """A mechanism that makes a full turn: its case, and the numbers of its closed form."""

    name: str
    case: str
    data: tuple[float, ...]
    function: str
    by_hand: Closed


def _dyad(px: Array, py: Array, qx: float, qy: float, b: float, c: float) -> tuple[Array, Array]:
    dx, dy = qx - px, qy - py
    s = np.sqrt(dx * dx + dy * dy)
    ux, uy = dx / s, dy / s
    along = ((s - c) * (s + c) + b * b) / (2.0 * s)
    h = np.sqrt((s + b + c) * (b + c - s) * (s - b + c) * (s + b - c)) / (2.0 * s)
    return px + along * ux - h * uy, py + along * uy + h * ux


FOUR_BAR = (1.0, 3.5, 2.5, 4.0, 10.0)
SLIDER_CRANK = (1.0, 3.0, 0.4, 10.0)
STEPHENSON = (1.0, 3.5, 2.5, 4.0, 2.0, 1.0, 4.0, 3.0, 5.5, -1.0, 10.0)


def four_bar(angle: Array, data: Sequence[Any] = FOUR_BAR) -> Array:
    """Torque on the crank for one on the rocker, (rows,); numbers of one four-bar, or of one a row."""
    a, b, c, d, t = data
    bx, by = a * np.cos(angle), a * np.sin(angle)
    cx, cy = _dyad(bx, by, d, 0.0, b, c)
    ex, ey = cx - bx, cy - by
    torque: Array = -t * (ey * bx - ex * by) / (ey * (cx - d) - ex * cy)
    return torque


def slider_crank(angle: Array) -> Array:
    """Torque on the crank for a force on the piston, (rows,)."""
    r, rod, offset, f = SLIDER_CRANK
    bx, by = r * np.cos(angle), r * np.sin(angle)
    rise = by - offset
    return f * (by + bx * rise / np.sqrt((rod - rise) * (rod + rise)))


def stephenson(angle: Array) -> Array:
    """Torque on the crank for one on the last rocker, (rows,)."""
    a, b, c, d, share, height, b2, c2, gx, gy, t = STEPHENSON
    bx, by = a * np.cos(angle), a * np.sin(angle)
    cx, cy = _dyad(bx, by, d, 0.0, b, c)
    ux, uy = (cx - bx) / b, (cy - by) / b
    ex, ey = bx + share * ux - height * uy, by + share * uy + height * ux
    fx, fy = _dyad(ex, ey, gx, gy, b2, c2)
    rx, dx, dy = cx - d, cx - bx, cy - by
    w3 = (by * rx - bx * cy) / (dx * cy - dy * rx)
    vx, vy = -by - w3 * (ey - by), bx + w3 * (ex - bx)
    px, py = fx - ex, fy - ey
    return -t * (vx * px + vy * py) / (py * (fx - gx) - px * (fy - gy))


FOUR_BAR_CASE = """\
icsolve: 1
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 1, BC: 3.5, CD: 2.5}
angles: {AB: 60}
near: {C: [3.1, 2.3]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads: {T4: {torque: 10, link: 4}, T2: {torque: unknown, link: 2}}
"""
SLIDER_CRANK_CASE = """\
icsolve: 1
points: {A: [0, 0], Q: [0, 0.4]}
lengths: {AB: 1, BC: 3}
angles: {AB: 60}
near: {C: [3.5, 0.4]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0, through: Q}
links: {1: [Q]}
loads: {P: {force: 10, link: 4, at: C, angle: 0}, T2: {torque: unknown, link: 2}}
"""
STEPHENSON_CASE = """\
icsolve: 1
points: {A: [0, 0], D: [4, 0], G: [5.5, -1]}
lengths: {AB: 1, BC: 3.5, CD: 2.5, BE: 2.23606797749979, EF: 4, FG: 3}
angles: {AB: 60, CBE: 26.56505117707799}
near: {C: [3.1, 2.3], F: [5.9, 2]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
  - {pin: [3, 5], at: E}
  - {pin: [5, 6], at: F}
  - {pin: [6, 1], at: G}
loads: {T6: {torque: 10, link: 6}, T2: {torque: unknown, link: 2}}
"""

MECHANISMS = (
    CrankTurning("four-bar", FOUR_BAR_CASE, FOUR_BAR, "four_bar", four_bar),
    CrankTurning("slider-crank", SLIDER_CRANK_CASE, SLIDER_CRANK, "slider_crank", slider_crank),
    CrankTurning("Stephenson six-bar", STEPHENSON_CASE, STEPHENSON, "stephenson", stephenson),
)


def _compiler() -> list[str]:
    named = os.environ.get("CC") or shutil.which("cc") or shutil.which("gcc") or shutil.which("clang") or ""
    return named.split()


def compiler_version() -> str:
    """What the C compiler says of itself, in a line; empty without one."""
    try:
        ran = subprocess.run([*_compiler(), "--version"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return ""
    return ran.stdout.partition("\n")[0]


def compiled(folder: str) -> ctypes.CDLL | None:
    """The closed forms in C, compiled into a folder; None without a C compiler."""
    compiler = _compiler()
    if not compiler:
        return None
    target = os.path.join(folder, "closed.so")
    source = files("icsolve.bench").joinpath("closed.c").read_text(encoding="utf-8")
    command = [*compiler, "-O3", "-shared", "-fPIC", "-x", "c", "-", "-o", target, "-lm"]
    try:
        subprocess.run(command, input=source, text=True, capture_output=True, check=True)
        return ctypes.CDLL(target)
    except (OSError, subprocess.CalledProcessError):
        return None


def in_c(
    library: ctypes.CDLL, name: str, data: Sequence[float], angle: Array, out: Array
) -> Callable[[], object]:
    """A call of a C function by its name and numbers, on arrays that are there."""
    numbers = (ctypes.c_double * len(data))(*data)
    pointers = [array.ctypes.data_as(ctypes.c_void_p) for array in (angle, out)]
    function, count = getattr(library, name), ctypes.c_int(len(angle))

    def call() -> object:
        return function(count, pointers[0], numbers, pointers[1])

    return call


HERE: Triple = (0.0, 0.0, 1.0)
COUPLE: Triple = (0.0, 0.0, 1.0)


def componentwise(
    d: float, a: float, b: float, c: float, angle: float, torque: float
) -> tuple[Triple, float]:
    """The coupler's centre with the frame and the torque on the crank, by the kernels that icsolve uses.

    A is the origin, D at (d, 0); a, b, c are the lengths AB, BC, CD; the angle is that of AB in
    degrees, the torque that on the rocker.
    """
    cosine, sine = turn_of(angle)
    crank = (a * cosine, a * sine)
    found = intersection(PlacedCircle(crank, b), PlacedCircle((d, 0.0), c))
    assert found.factors is not None
    rod = found.at(FLOATS.sqrt(found.factors[0][0] * found.factors[1][0]))
    p12, p23, p34, p14 = HERE, pin_twist(crank), pin_twist(rod), (d, 0.0, 1.0)
    centre = cross(cross(p12, p23), cross(p14, p34))
    factor, _, rocker = dyad_twists(p23, p34, p14, (0.0, 0.0, -1.0))
    turning = pairing(COUPLE, (rocker * p14[0], rocker * p14[1], rocker * p14[2]))
    return centre, -torque * turning / pairing(COUPLE, (0.0, 0.0, factor))


def written_out(d: float, a: float, b: float, c: float, angle: float, torque: float) -> tuple[Triple, float]:
    """The same without a function call but sine, cosine and square root."""
    radians = math.radians(angle)
    bx, by = a * math.cos(radians), a * math.sin(radians)
    dx, dy = d - bx, -by
    s = math.sqrt(dx * dx + dy * dy)
    ux, uy = dx / s, dy / s
    along = ((s - c) * (s + c) + b * b) / (2.0 * s)
    h = math.sqrt((s + b + c) * (b + c - s) * (s - b + c) * (s + b - c)) / (2.0 * s)
    cx, cy = bx + along * ux - h * uy, by + along * uy + h * ux
    rx, m = cx - d, cy * d
    centre = (-bx * m, -by * m, by * rx - bx * cy)
    ex, ey = cx - bx, cy - by
    return centre, -torque * (ey * bx - ex * by) / (ey * rx - ex * cy)


# --- other programs ---------------------------------------------------------------------------------

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
