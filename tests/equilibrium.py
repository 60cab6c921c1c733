"""A second witness: free-body equilibrium of every moving link, all joint forces unknown, least squares.

It knows nothing of motions: each joint is here the forces and couples that it can transmit. A mesh
pushes along the common tangent at the pitch point, a belt pulls along its tangent strand.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from icsolve import case as c
from reference import DOUBLE, Frame, Motions, Place, Points, along, frame_of, pivots, points_of
from witness import parts, share

Wrench = tuple[float, float, float]
"""Force components, and the moment about the origin of the normalised frame."""


def push(p: Place, u: Place) -> Wrench:
    """A unit force along u through p."""
    return u[0], u[1], p[0] * u[1] - p[1] * u[0]


COUPLE: Wrench = (0.0, 0.0, 1.0)


def transmitted(case: c.Case, joint: c.Joint, points: Points, frame: Frame) -> list[tuple[str, str, Wrench]]:
    """Unit forces and couples of a joint: on the second link named, their opposites on the first."""
    i, j = joint.links[0], joint.links[1]
    if isinstance(joint, c.Gears | c.Belt):
        return [(i, j, _wheels(case, joint, points, frame))]
    at = getattr(joint, "at", None)
    p = frame.place(points[at], float) if at is not None else (0.0, 0.0)
    both = [push(p, (1.0, 0.0)), push(p, (0.0, 1.0))]
    if isinstance(joint, c.Pin):
        return [(i, k, w) for k in joint.links[1:] for w in both]
    if isinstance(joint, c.Contact):
        return [(i, j, push(p, DOUBLE.turn(joint.normal.value)))]
    if isinstance(joint, c.Slide | c.Slot):
        ux, uy = along(joint.guide, points, DOUBLE)
        both = [push(p, (-uy, ux))] + ([COUPLE] if isinstance(joint, c.Slide) else [])
    elif isinstance(joint, c.KnownCentre) and joint.toward is not None:
        both = [push(p, DOUBLE.turn(joint.toward.value)), COUPLE]
    elif isinstance(joint, c.Weld):
        both = [*both, COUPLE]
    return [(i, j, w) for w in both]


def _wheels(case: c.Case, joint: c.Gears | c.Belt, points: Points, frame: Frame) -> Wrench:
    """The tooth force at the pitch point, or the pull of a strand."""
    _, first, second = pivots(case, joint)
    a, b = (frame.place(points[p], float) for p in (first, second))
    dx, dy = b[0] - a[0], b[1] - a[1]
    if isinstance(joint, c.Gears):
        n, m = (t.value for t in joint.teeth)
        pitch = (a[0] + dx * n / (n + m), a[1] + dy * n / (n + m))
        return push(pitch, (-dy, dx))
    r, s = (q.value / frame.size for q in joint.radii)
    apart = math.hypot(dx, dy)
    across = (r + s if joint.crossed else r - s) / apart
    up = math.sqrt(1 - across * across)
    normal = (across * dx / apart - up * dy / apart, across * dy / apart + up * dx / apart)
    return push((a[0] + r * normal[0], a[1] + r * normal[1]), (-normal[1], normal[0]))


def equations(case: c.Case, points: Points) -> tuple[Any, Any, list[str]]:
    """Matrix (joint unknowns first, then the unknown loads), right-hand side, names of the unknown loads."""
    frame = frame_of(case, points)
    row = {n: 3 * k for k, n in enumerate(n for n in case.links if n != case.ground)}
    wrenches = [w for joint in case.joints for w in transmitted(case, joint, points, frame)]
    unknowns = [q.name for q in case.loads if not isinstance(q, c.ForceVector) and q.value is None]
    a = np.zeros((3 * len(row), len(wrenches) + len(unknowns)))
    b = np.zeros(3 * len(row))
    for k, (i, j, wrench) in enumerate(wrenches):
        for link, sign in ((i, -1.0), (j, 1.0)):
            if link in row:
                a[row[link] : row[link] + 3, k] += sign * np.array(wrench)
    _apply_loads(case, points, row, (a[:, len(wrenches) :], b, unknowns))
    return a, b, unknowns


def _apply_loads(case: c.Case, points: Points, row: dict[str, int], into: tuple[Any, Any, list[str]]) -> None:
    columns, b, unknowns = into
    found = Motions(case, points, frame_of(case, points), DOUBLE, [])
    for load in case.loads:
        value, unknown = share(case, load)
        for part in (p for p in parts(load, found) if p.link in row):
            x, y, moment = push(part.at, part.force)
            wrench = value * np.array([x, y, moment + part.couple], dtype=float)
            place = slice(row[part.link], row[part.link] + 3)
            if unknown is None:
                b[place] -= wrench
            else:
                columns[place, unknowns.index(unknown)] += wrench


def answers(case: c.Case, points: Points | None = None) -> dict[str, float]:
    """The unknown loads that hold every link in equilibrium, in case units."""
    points = points_of(case) if points is None else points
    a, b, unknowns = equations(case, points)
    x, _, _, _ = np.linalg.lstsq(a, b, rcond=1e-11)
    _, s, vt = np.linalg.svd(a)
    idle = vt[int(np.sum(s > 1e-11 * s[0])) :]
    first = a.shape[1] - len(unknowns)
    assert np.all(np.abs(idle[:, first:]) < 1e-8), "the unknown loads are not determined"
    assert np.allclose(a @ x, b, atol=1e-8 * max(1e-300, *np.abs(b), *np.abs(x))), "no equilibrium"
    return dict(zip(unknowns, (float(v) for v in x[first:]), strict=True))
