"""Closed forms of three mechanisms, batched in numpy and in C, with the cases that they are of."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


class Rival(NamedTuple):
    """A mechanism: its case, its dimensions in the order in which the closed forms take them."""

    name: str
    case: str
    dimensions: tuple[float, ...]
    numpy: Callable[[Array, tuple[float, ...]], Array]


def four_bar(degrees: Array, d: tuple[float, ...]) -> Array:
    """Crank torque of a four-bar whose rocker bears a force along -x."""
    a, b, c, f, p, load = d
    t = np.radians(degrees)
    bx, by = a * np.cos(t), a * np.sin(t)
    dx, dy = f - bx, -by
    e2 = dx * dx + dy * dy
    e = np.sqrt(e2)
    along = (e2 + b * b - c * c) / (2.0 * e)
    h = np.sqrt(b * b - along * along)
    cx, cy = bx + (along * dx - h * dy) / e, by + (along * dy + h * dx) / e
    ux, uy, vx, vy = cx - bx, cy - by, cx - f, cy
    w4 = (bx * uy - by * ux) / (vx * uy - vy * ux)
    return np.asarray(-load * w4 * (p / c) * vy)


def slider_crank(degrees: Array, d: tuple[float, ...]) -> Array:
    """Crank torque of a slider-crank whose block bears a force along -x."""
    r, rod, e, load = d
    t = np.radians(degrees)
    bx, by = r * np.cos(t), r * np.sin(t)
    h = e - by
    along = np.sqrt(rod * rod - h * h)
    return np.asarray(load * (-by + bx * h / along))


def stephenson(degrees: Array, d: tuple[float, ...]) -> Array:
    """Crank torque of a Stephenson six-bar whose last link bears a torque."""
    a, b, c, f, px, py, s, u, gx, gy, load = d
    t = np.radians(degrees)
    bx, by = a * np.cos(t), a * np.sin(t)
    cx, cy = _meet(bx, by, f, 0.0, b, c)
    ux, uy, vx, vy = cx - bx, cy - by, cx - f, cy
    w3 = (bx * vy - by * vx) / (vx * uy - vy * ux)
    ex, ey = bx + (px * ux - py * uy) / b, by + (px * uy + py * ux) / b
    vex, vey = -by - w3 * (ey - by), bx + w3 * (ex - bx)
    fx, fy = _meet(ex, ey, gx, gy, s, u)
    mx, my, nx, ny = fx - ex, fy - ey, fx - gx, fy - gy
    return np.asarray(-load * (vex * mx + vey * my) / (nx * my - ny * mx))


def _meet(px: Array, py: Array, qx: float, qy: float, r: float, s: float) -> tuple[Array, Array]:
    """Where two circles meet, left of the line from p to q."""
    dx, dy = qx - px, qy - py
    e2 = dx * dx + dy * dy
    e = np.sqrt(e2)
    along = (e2 + r * r - s * s) / (2.0 * e)
    h = np.sqrt(r * r - along * along)
    return px + (along * dx - h * dy) / e, py + (along * dy + h * dx) / e


FOUR_BAR = Rival(
    "four_bar",
    """icsolve: 1
points: {A: [0, 0], D: [4, 0]}
lengths: {AB: 1, BC: 3.5, CD: 2.5, DE: 1.5}
angles: {AB: 60, CDE: 0}
near: {C: [3.5, 2.4]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
loads:
  P: {force: 100, link: 4, at: E, angle: 180}
  T: {torque: unknown, link: 2}
""",
    (1.0, 3.5, 2.5, 4.0, 1.5, 100.0),
    four_bar,
)

SLIDER_CRANK = Rival(
    "slider_crank",
    """icsolve: 1
points: {A: [0, 0], C: [unknown, 0.25]}
lengths: {AB: 1, BC: 3.5}
angles: {AB: 60}
near: {C: [4, 0.25]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads:
  P: {force: 100, link: 4, at: C, angle: 180}
  T: {torque: unknown, link: 2}
""",
    (1.0, 3.5, 0.25, 100.0),
    slider_crank,
)

STEPHENSON = Rival(
    "stephenson",
    """icsolve: 1
points: {A: [0, 0], D: [4, 0], G: [4, 2]}
lengths: {AB: 1, BC: 3.5, CD: 2.5, BE: 2.5, EF: 2.5, FG: 2}
angles: {AB: 60, CBE: 36.86989764584402}
near: {C: [3.5, 2.4], F: [3.9, 4.0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
  - {pin: [3, 5], at: E}
  - {pin: [5, 6], at: F}
  - {pin: [6, 1], at: G}
loads:
  M: {torque: 10, link: 6}
  T: {torque: unknown, link: 2}
""",
    (1.0, 3.5, 2.5, 4.0, 2.0, 1.5, 2.5, 2.0, 4.0, 2.0, 10.0),
    stephenson,
)

RIVALS = (FOUR_BAR, SLIDER_CRANK, STEPHENSON)


def compiled(folder: Path) -> ctypes.CDLL | None:
    """The closed forms in C, with full optimisation; None without a compiler."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None:
        return None
    library = folder / "closed_forms.so"
    source = Path(__file__).with_name("closed_forms.c")
    subprocess.run([compiler, "-O3", "-shared", "-fPIC", "-o", library, source, "-lm"], check=True)
    return ctypes.CDLL(str(library))


def in_c(library: ctypes.CDLL, rival: Rival, degrees: Array) -> Array:
    """Crank torques by the closed form in C."""
    out = np.empty_like(degrees)
    dimensions = (ctypes.c_double * len(rival.dimensions))(*rival.dimensions)
    pointers = (degrees.ctypes.data_as(ctypes.c_void_p), out.ctypes.data_as(ctypes.c_void_p))
    getattr(library, rival.name)(*pointers, ctypes.c_long(len(degrees)), dimensions)
    return out
