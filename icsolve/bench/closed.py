"""Three mechanisms whose full turn has a closed form: as a case, in numpy by hand, and in C."""

from __future__ import annotations

import ctypes
import math
import os
import shutil
import subprocess
from collections.abc import Callable
from importlib.resources import files

import numpy as np
import numpy.typing as npt

from icsolve.assembly.loci import PlacedCircle, intersection
from icsolve.numbers.arithmetic import FLOATS, turn_of
from icsolve.screws.plane import Triple, cross, dyad_twists, pairing, pin_twist
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


def four_bar(angle: Array) -> Array:
    """Torque on the crank for one on the rocker, (rows,)."""
    a, b, c, d, t = FOUR_BAR
    bx, by = a * np.cos(angle), a * np.sin(angle)
    cx, cy = _dyad(bx, by, d, 0.0, b, c)
    ex, ey = cx - bx, cy - by
    return -t * (ey * bx - ex * by) / (ey * (cx - d) - ex * cy)


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


def in_c(library: ctypes.CDLL, mechanism: CrankTurning, angle: Array, out: Array) -> Callable[[], object]:
    """A call of the C function on arrays that are there."""
    data = (ctypes.c_double * len(mechanism.data))(*mechanism.data)
    pointers = [array.ctypes.data_as(ctypes.c_void_p) for array in (angle, out)]
    function, count = getattr(library, mechanism.function), ctypes.c_int(len(angle))

    def call() -> object:
        return function(count, pointers[0], data, pointers[1])

    return call


HERE: Triple = (0.0, 0.0, 1.0)
TORQUE: Triple = (0.0, 0.0, 1.0)


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
    turning = pairing(TORQUE, (rocker * p14[0], rocker * p14[1], rocker * p14[2]))
    return centre, -torque * turning / pairing(TORQUE, (0.0, 0.0, factor))


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
