"""Whether teeth of a given pitch or module fit the pivots of their wheels."""

from __future__ import annotations

import math

from icsolve.case import Case, Gears
from icsolve.errors import SceneError, Status
from icsolve.screws.joints import Points
from icsolve.structure.topology import Bond, Topology

MISFIT = 2e-3
"""Pivots may miss the distance of the pitch radii by this fraction of it."""


def refuse_misfit(case: Case, top: Topology, points: Points, scale: float) -> None:
    """Refuse teeth whose pitch circles do not touch on their pivots, as far as these are among the points."""
    for bond in top.bonds:
        module = _module(bond)
        if module is None or not {*bond.pivots} <= points.keys():
            continue
        assert isinstance(bond.joint, Gears)
        fit = abs(bond.joint.teeth[0].value + bond.joint.teeth[1].value) * module / 2.0
        apart = math.dist(*(points[p] for p in bond.pivots)) / scale
        if abs(apart - fit) > MISFIT * fit:
            raise SceneError(Status.INCONSISTENT, _misfit(case, bond, fit, apart))


def _module(bond: Bond) -> float | None:
    """Pitch diameter per tooth (case lengths), where the case gives it."""
    if not isinstance(bond.joint, Gears) or not bond.pivots[0]:
        return None
    if bond.joint.module is not None:
        return bond.joint.module.value
    return None if bond.joint.diametral_pitch is None else 1.0 / bond.joint.diametral_pitch.value


def _misfit(case: Case, bond: Bond, fit: float, apart: float) -> str:
    a, b = bond.links
    line, _ = case.marks.get(f"joints.{a}-{b}", (0, 0))
    where = f" (line {line})" if line else ""
    unit, (p, q) = case.units.length, bond.pivots
    return (
        f"the teeth of gears {a} and {b}{where} do not fit: their pitch circles touch where the pivots are "
        f"{fit:.6g} {unit} apart, and {p} and {q} are {apart:.6g} {unit} apart. Correct the teeth, the pitch "
        "or module, or the pivots."
    )
