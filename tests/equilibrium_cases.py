"""The potentials of the cases under `cases/equilibrium`, written apart: by hand from each figure.

Angles in degrees as the cases have them; a position of equilibrium is where the derivative vanishes, stable
where the second is positive (the principle of virtual work).
"""

from __future__ import annotations

from collections.abc import Callable
from math import acos, cos, hypot, radians, sin, sqrt

Potential = Callable[[float], float]


def slider(u: float, crank: float, rod: float) -> float:
    """Where the slider of an in-line slider-crank is along its guide."""
    return crank * cos(u) + sqrt(rod * rod - (crank * sin(u)) ** 2)


def boom(length: float) -> float:
    """The angle of a boom of 2 m at the pivot, by a cylinder from 1 m beside it, radians."""
    return acos((5.0 - length * length) / 4.0)


def gable(u: float) -> float:
    """Height of the middle of a rod of 2 m whose ends lie on slopes at 150 and 60 degrees."""
    a, b = -2.0 * cos(u - radians(150)), 2.0 * cos(u - radians(60))
    return 0.5 * (a * sin(radians(150)) + b * sin(radians(60)))


def strut(u: float, weight: float) -> float:
    """A weight on a strut of 2 m that a spring of 10 N/m and free length 1 m holds from 4 m above its pin."""
    return 2 * weight * sin(u) + 5 * (sqrt(20 - 16 * sin(u)) - 1) ** 2


POTENTIALS: dict[str, Potential] = {
    "crank_with_couple": lambda d: 20 * sin(radians(d)) - 8 * radians(d),
    "slider_crank_on_spring": lambda d: 17.658 * sin(radians(d)) + 400 * (0.6 * cos(radians(d)) - 0.2) ** 2,
    "strut_below_critical_load": lambda d: strut(radians(d), 15),
    "strut_above_critical_load": lambda d: strut(radians(d), 24),
    "ladder_on_spring": lambda d: 400 * sin(radians(d)) + 60 * (-4 * cos(radians(d)) - 0.5) ** 2,
    "rod_between_two_slopes": lambda d: 50 * gable(radians(d)),
    "lamp_arm": lambda d: 10 * sin(radians(d)) + 30 * (sqrt(0.61 - 0.6 * sin(radians(d))) - 0.2) ** 2,
    "bascule_bridge": lambda d: 5400 * sin(radians(d)) + 200 * (sqrt(72 - 72 * sin(radians(d))) - 3) ** 2,
    "strut_on_stiff_torsion_spring": lambda d: 20 * sin(radians(d)) + 15 * radians(d - 90) ** 2,
    "strut_on_soft_torsion_spring": lambda d: 20 * sin(radians(d)) + 7.5 * radians(d - 90) ** 2,
    "toggle_with_spring": lambda d: 12 * sin(radians(d)) + 25 * (1.4 - slider(radians(d), 0.4, 0.6)) ** 2,
    "toggle_under_thrust": lambda d: 12 * sin(radians(d)) + 40 * slider(radians(d), 0.4, 0.6),
    "heavy_bar_on_spring": lambda d: 90 * sin(radians(d)) + 12.5 * (sqrt(25 - 24 * sin(radians(d))) - 1) ** 2,
    "gears_with_weights": lambda d: 20 * sin(radians(d)) + 8 * sin(radians(90 - 2 * d)),
    "boom_by_its_cylinder": lambda s: 20 * sin(boom(s)) - 10 * boom(s),
    "collar_on_level_rod": lambda x: 50 * (hypot(x, 1) - 0.5) ** 2 - 60 * x,
    "collar_on_upright_rod": lambda y: 12 * y + 40 * (hypot(y, 0.4) - 0.3) ** 2,
    "two_springs_on_a_crank": lambda d: (
        6 * sin(radians(d))
        + 10 * (hypot(cos(radians(d)) - 2, sin(radians(d))) - 0.5) ** 2
        + 15 * (hypot(cos(radians(d)), sin(radians(d)) - 2) - 0.5) ** 2
    ),
    "ladder_on_slope": lambda d: 300 * sin(radians(d)) - 80 * 3 * cos(radians(d)),
    "piston_under_pressure": lambda d: 12 * sin(radians(d)) + 400 * 0.05 * slider(radians(d), 0.4, 0.6),
}
