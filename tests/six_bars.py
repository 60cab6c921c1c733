"""Watt I and Stephenson III with masses, and their dynamics by Newton and Euler, written apart from icsolve.

Geometry and masses are those of the PMKS verification project (github.com/PMKS-Web/PMKS_Verification, cases
watt_i and stephenson_iii_example_2). Velocities and accelerations of the joints follow from the constant
distances within each link; the forces from three equations a link.
"""

from __future__ import annotations

from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

SPEED = 1.0471975511965976
Vector = np.ndarray[Any, Any]


class SixBar(NamedTuple):
    """Joints with their place and links, masses (kg, kg m^2, place), and the load: force, link, place.

    The first joint is the crank's pivot, and ``ground`` the frame of every link name.
    """

    joints: dict[str, tuple[tuple[float, float], tuple[str, str]]]
    masses: dict[str, tuple[float, float, tuple[float, float]]]
    force: tuple[float, float]
    loaded: str
    at: tuple[float, float]

    def of(self, link: str) -> list[str]:
        """The joints of a link."""
        return [name for name, (_, links) in self.joints.items() if link in links]


WATT = SixBar(
    {
        "A": ((-3.74, -2.41), ("ground", "AB")), "B": ((-2.72, 0.91), ("AB", "BCD")),
        "C": ((1.58, 0.43), ("BCD", "CFG")), "D": ((-0.24, 4.01), ("BCD", "DE")),
        "E": ((5.08, 5.31), ("DE", "EF")), "F": ((8.14, 3.35), ("EF", "CFG")),
        "G": ((7.32, -3.51), ("CFG", "ground")),
    },
    {
        "AB": (5, 0.1, (-3.23, -0.75)), "BCD": (10, 0.2, (-0.46, 1.7833333333333334)),
        "DE": (5, 0.1, (2.42, 4.66)), "EF": (10, 0.2, (6.61, 4.33)), "CFG": (5, 0.1, (5.68, 0.09)),
    },
    (50, 25), "CFG", (5.68, 0.09),
)  # fmt: skip
STEPHENSON = SixBar(
    {
        "A": ((7, 4), ("ground", "AB")), "B": ((5, 16), ("AB", "BCE")), "C": ((25, 25), ("BCE", "CD")),
        "D": ((23, 10), ("CD", "ground")), "E": ((18, 35), ("BCE", "EF")), "F": ((43, 32), ("EF", "FG")),
        "G": ((45, 17), ("FG", "ground")),
    },
    {
        "AB": (5, 0.1, (6, 10)), "BCE": (10, 0.2, (16, 25.333333333333332)), "CD": (5, 0.1, (24, 17.5)),
        "EF": (10, 0.2, (30.5, 33.5)), "FG": (5, 0.1, (44, 24.5)),
    },
    (50, 0), "FG", (44, 24.5),
)  # fmt: skip


def text(bar: SixBar, speed: float, gravity: bool) -> str:
    """The case in the position as written; the torque on the crank is unknown."""
    points = {name: at for name, (at, _) in bar.joints.items()}
    points |= {f"G{link}": at for link, (_, _, at) in bar.masses.items()} | {"L": bar.at}
    extra = {link: [f"G{link}", *(["L"] if link == bar.loaded else [])] for link in bar.masses}
    links = [
        f"  {link}: {{points: [{', '.join(extra[link])}], mass: {m} kg, centre: G{link}, "
        f"inertia: {i} kg*m^2}}"
        for link, (m, i, _) in bar.masses.items()
    ]
    joints = [f"  - {{pin: [{a}, {b}], at: {name}}}" for name, (_, (a, b)) in bar.joints.items()]
    loads = [f"  P: {{force: [{bar.force[0]}, {bar.force[1]}], link: {bar.loaded}, at: L}}"]
    if gravity:
        loads += [f"  W{q}: {{mass: {m} kg, link: {q}, at: G{q}}}" for q, (m, _, _) in bar.masses.items()]
    placed = ", ".join(f"{name}: [{x!r}, {y!r}]" for name, (x, y) in points.items())
    return "\n".join([
        "icsolve: 1", "ground: ground", f"points: {{{placed}}}", "links:", *links, "joints:", *joints,
        "loads:", *loads, "  T: {torque: unknown, link: AB}",
        f"motion: {{link: AB, speed: {speed!r}}}", "dynamic: yes\n",
    ])  # fmt: skip


def newton_euler(
    bar: SixBar, at: dict[str, Vector], speed: float, gravity: bool
) -> tuple[float, dict[str, Vector]]:
    """The torque on the crank, and the force of the first link of each joint on its second.

    ``at`` has the places of the joints, of the centres of mass and of the load.
    """
    first = next(iter(bar.joints))
    fixed = {name for name, (_, links) in bar.joints.items() if "ground" in links}
    v, a = _rates(bar, at, fixed, first, speed)
    unknowns = {name: 2 * n for n, name in enumerate(bar.joints)}
    rows, right = [], []
    for link, (mass, inertia, _) in bar.masses.items():
        p, q = bar.of(link)[:2]
        arm, dv, da = at[q] - at[p], v[q] - v[p], a[q] - a[p]
        square = arm @ arm
        omega, alpha = _cross(arm, dv) / square, _cross(arm, da) / square
        g = at[f"G{link}"]
        out = g - at[p]
        acceleration = a[p] + alpha * _square(out) - omega**2 * out
        pushed = mass * acceleration
        if gravity:
            pushed = pushed + np.array([0.0, 9.81 * mass])
        turned = inertia * alpha
        if link == bar.loaded:
            pushed = pushed - np.array(bar.force, dtype=float)
            turned -= _cross(at["L"] - g, np.array(bar.force, dtype=float))
        three = np.zeros((3, 2 * len(bar.joints) + 1))
        for name in bar.of(link):
            sign = 1.0 if bar.joints[name][1][1] == link else -1.0
            k, (x, y) = unknowns[name], at[name] - g
            three[0, k], three[1, k + 1] = sign, sign
            three[2, k], three[2, k + 1] = -sign * y, sign * x
        if link == "AB":
            three[2, -1] = 1.0
        rows.append(three)
        right += [*pushed, turned]
    found = np.linalg.solve(np.vstack(rows), np.array(right))
    return float(found[-1]), {name: found[k : k + 2] for name, k in unknowns.items()}


def _rates(
    bar: SixBar, at: dict[str, Vector], fixed: set[str], first: str, speed: float
) -> tuple[dict[str, Vector], dict[str, Vector]]:
    """Velocities and accelerations of the joints: distances within links stay, the crank turns evenly."""
    crank = next(name for name in bar.of("AB") if name != first)
    arm = at[crank] - at[first]
    v = {name: np.zeros(2) for name in fixed} | {crank: speed * _square(arm)}
    a = {name: np.zeros(2) for name in fixed} | {crank: -(speed**2) * arm}
    free = [name for name in bar.joints if name not in v]
    pairs = [pair for link in bar.masses if link != "AB" for pair in combinations(bar.of(link), 2)]
    matrix = np.zeros((len(pairs), 2 * len(free)))
    for n, (p, q) in enumerate(pairs):
        for name, sign in ((p, 1.0), (q, -1.0)):
            if name in free:
                k = 2 * free.index(name)
                matrix[n, k : k + 2] = sign * (at[p] - at[q])

    def solved(known: dict[str, Vector], more: list[float]) -> dict[str, Vector]:
        right = [
            -(at[p] - at[q]) @ (known.get(p, np.zeros(2)) - known.get(q, np.zeros(2))) - extra
            for (p, q), extra in zip(pairs, more, strict=True)
        ]
        found = np.linalg.lstsq(matrix, np.array(right), rcond=None)[0]
        return known | {name: found[2 * n : 2 * n + 2] for n, name in enumerate(free)}

    v = solved(v, [0.0] * len(pairs))
    return v, solved(a, [(v[p] - v[q]) @ (v[p] - v[q]) for p, q in pairs])


def _square(r: Vector) -> Vector:
    return np.array([-r[1], r[0]])


def _cross(r: Vector, f: Vector) -> float:
    return float(r[0] * f[1] - r[1] * f[0])
