"""Friction by brute force: the equilibrium of all links for every combination of senses, written apart.

Dense, in least squares; each rub is a couple or a force that is its coefficient times the size of the
force that presses there. Friction is brought in little by little and Newton's method follows. Of all 2^k
combinations those count whose friction opposes the rates of the reference's null space everywhere.
"""

from __future__ import annotations

import math
from itertools import product
from random import Random
from typing import Any, NamedTuple

import numpy as np

import equilibrium
from icsolve import case as c
from reference import DOUBLE, Motions, Points, along, frame_of, motions
from transcribe import Scene

STEPS = 15
CAREFUL = 100


class Place(NamedTuple):
    """A rub: its wrench on the second link (normalised), the links, the rows of its pressing force."""

    wrench: Any
    by: str
    on: str
    force: Any
    limit: float


class Combination(NamedTuple):
    """One combination of senses: friction per rub on the second link, the unknown loads, None if it jams."""

    senses: tuple[float, ...]
    friction: tuple[float, ...] | None
    unknowns: dict[str, float] | None


def places_of(case: c.Case, points: Points) -> list[Place]:
    """Every rub of a case."""
    frame, column, found = frame_of(case, points), 0, []
    total = equilibrium.equations(case, points)[0].shape[1]
    for joint in case.joints:
        wrenches = equilibrium.transmitted(case, joint, points, frame)
        if getattr(joint, "friction", None) is not None and joint.friction.mu.value:
            found += _rubs(joint, wrenches, (column, total), points, frame)
        column += len(wrenches)
    return found


def _rubs(joint: Any, wrenches: list[Any], at: tuple[int, int], points: Points, frame: Any) -> list[Place]:
    column, total = at
    friction, p = joint.friction, frame.place(points[joint.at], float)
    mu = friction.mu.value
    if isinstance(joint, c.Pin):
        radius = friction.radius.value / frame.size * math.sin(math.atan(mu))
        found = []
        for k in range(0, len(wrenches), 2):
            rows = np.zeros((2, total))
            rows[0, column + k] = rows[1, column + k + 1] = 1.0
            found.append(Place(np.array([0, 0, 1.0]), wrenches[k][0], wrenches[k][1], rows, radius))
        return found
    if isinstance(joint, c.Contact):
        nx, ny = DOUBLE.turn(joint.normal.value)
        ux, uy = -ny, nx
    else:
        ux, uy = along(joint.guide, points, DOUBLE)
    wrench = np.array(equilibrium.push(p, (ux, uy)))
    normal = np.zeros((1, total))
    normal[0, column] = 1.0
    i, j = wrenches[0][0], wrenches[0][1]
    if friction.length is None:
        return [Place(wrench, i, j, normal, mu)]
    couple = np.zeros((1, total))
    couple[0, column + 1] = frame.size / friction.length.value
    return [Place(wrench, i, j, normal / 2 + side * couple, mu) for side in (-1.0, 1.0)]


def rates(found: Motions, places: list[Place]) -> list[float]:
    """Rubbing rate of each place in the one motion: power of a unit of its friction."""
    (motion,) = found.basis
    return [
        _power(place.wrench, motion[place.on]) - _power(place.wrench, motion[place.by]) for place in places
    ]


def _power(wrench: Any, twist: Any) -> float:
    x, y, w = (float(t) for t in twist)
    return float(wrench[0] * y - wrench[1] * x + wrench[2] * w)


Senses = tuple[float, ...]


def combinations(case: c.Case, points: Points, of: list[Senses] | None = None) -> list[Combination]:
    """All 2^k combinations of senses (or only these), solved."""
    places = places_of(case, points)
    a, b, unknowns = equilibrium.equations(case, points)
    row = {n: 3 * k for k, n in enumerate(n for n in case.links if n != case.ground)}
    columns = np.zeros((a.shape[0], len(places)))
    for k, place in enumerate(places):
        for link, sign in ((place.on, 1.0), (place.by, -1.0)):
            if link in row:
                columns[row[link] : row[link] + 3, k] += sign * place.wrench
    found = []
    for senses in of or product((1.0, -1.0), repeat=len(places)):
        x = followed(a, b, columns, places, senses, CAREFUL if of else STEPS)
        if x is None:
            found.append(Combination(senses, None, None))
            continue
        friction = tuple(
            -s * place.limit * float(np.linalg.norm(place.force @ x))
            for s, place in zip(senses, places, strict=True)
        )
        values = {name: float(x[a.shape[1] - len(unknowns) + n]) for n, name in enumerate(unknowns)}
        found.append(Combination(senses, friction, values))
    return found


def followed(a: Any, b: Any, columns: Any, places: list[Place], senses: Senses, steps: int) -> Any:
    """The solution at full friction of these senses, followed from none; None where it is lost."""
    x = np.linalg.lstsq(a, b, rcond=1e-12)[0]
    first = np.abs(x).max()
    for share in np.linspace(0.0, 1.0, steps + 1)[1:]:
        for _ in range(15):
            rest, slope = a @ x - b, a.copy()
            for k, (s, place) in enumerate(zip(senses, places, strict=True)):
                v = place.force @ x
                size = np.linalg.norm(v) or 1e-300
                rest = rest - share * s * place.limit * size * columns[:, k]
                slope = slope - share * s * place.limit * np.outer(columns[:, k], v @ place.force / size)
            step = np.linalg.lstsq(slope, rest, rcond=1e-12)[0]
            x = x - step
            if np.abs(step).max() <= 1e-13 * np.abs(x).max():
                break
        else:
            return None
        if np.abs(x).max() > 1e6 * first or np.abs(a @ x - b).max() > 1e12 * np.abs(b).max():
            return None
    return x


def against_the_motion(case: c.Case, points: Points, sense: float, every: bool = True) -> Combination:
    """The one combination whose friction takes power everywhere in the motion (times ``sense``).

    Without ``every`` only that one is solved, the others are taken to give power somewhere.
    """
    speeds = [sense * rate for rate in rates(motions(case, points), places_of(case, points))]
    assert min(map(abs, speeds), default=1.0) > 1e-9 * max(map(abs, speeds), default=1.0), "a rub is at rest"
    right = tuple(math.copysign(1.0, rate) for rate in speeds)
    takes = [
        each
        for each in combinations(case, points, None if every else [right])
        if all(s * rate > 0.0 for s, rate in zip(each.senses, speeds, strict=True))
    ]
    (only,) = takes
    return only


def motion_sense(case: c.Case, points: Points) -> float:
    """1 where the reference's motion turns the driven link as ``motion`` says, else -1."""
    (given,) = case.motion
    (motion,) = motions(case, points).basis
    turns = float(motion[given.link][2])
    return math.copysign(1.0, turns) * (-1.0 if given.turns == "cw" else 1.0)


def roughened(rng: Random, scene: Scene, most: int) -> Scene:
    """A scene with friction at random joints, in at most so many places."""
    joints = [dict(joint) for joint in scene["joints"]]
    left = most
    for joint in rng.sample(joints, len(joints)):
        kind = next(iter(joint))
        places = len(joint["pin"]) - 1 if kind == "pin" else 1
        if kind not in ("pin", "slide", "slot", "contact") or places > left:
            continue
        left -= places
        joint["mu"] = round(rng.choice([rng.uniform(0.05, 0.3), rng.uniform(0.05, 0.9)]), 3)
        if kind == "pin":
            joint["radius"] = round(rng.uniform(0.05, 0.5), 3)
        if kind == "slide" and left and rng.random() < 0.4:
            joint["length"] = round(rng.uniform(0.5, 3), 3)
            left -= 1
    return {**scene, "joints": joints}
