"""The force between the teeth of gears with parallel axes, spur or helical.

With the pressure angle a_t in the plane of the wheel and the helix angle h, a tangential force W goes with
a separating force W tan(a_t) toward the wheel's own axis and an axial force W tan(h) (K. J. Waldron,
G. L. Kinzel and S. K. Agrawal, Kinematics, Dynamics, and Design of Machinery, ch. 11 and 13). In the
section square to the teeth the pressure angle a_n has tan(a_n) = tan(a_t) cos(h), and the module m_n is
m_t cos(h).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from icsolve.case import Toward
from icsolve.case.space import Gears, Teeth
from icsolve.errors import SceneError, Status
from icsolve.statics.space.figure import Places, heading
from icsolve.statics.space.vectors import Vec, add, cross, dot, size, sub, times, unit

SQUARE = 2e-3
"""The line of the centres may lean against the plane of the wheels by this (sine)."""
MISFIT = 2e-3
"""Centres may miss the distance of the pitch radii by this fraction of it."""


class Mesh(NamedTuple):
    """Where two gears touch, and the parts of the force there on the link ``on`` (an external gear).

    ``tangent`` is along the motion of ``on`` for positive turning about ``axis``, ``inward`` toward its own
    axis. ``separating`` and ``axial`` are per unit of tangential force. ``radii`` are the pitch radii of the
    gears that the case shows, case lengths.
    """

    by: str
    on: str
    at: Vec
    axis: Vec
    tangent: Vec
    inward: Vec
    separating: float
    axial: float
    radii: tuple[float, ...]

    def force(self, flank: float) -> Vec:
        """The force on ``on`` per unit of tangential force on a flank (+1 or -1; 0: the tangential part)."""
        if flank == 0.0:
            return self.tangent
        apart = times(self.separating, self.inward)
        return add(apart, times(flank, add(self.tangent, times(self.axial, self.axis))))


def transverse_angle(teeth: Teeth) -> float:
    """Pressure angle in the plane of the wheel, rad."""
    angle = math.radians(teeth.pressure_angle.value)
    return math.atan2(math.tan(angle), math.cos(helix(teeth))) if teeth.normal_angle else angle


def helix(teeth: Teeth) -> float:
    """Helix angle, rad; 0 of straight teeth."""
    return math.radians(teeth.helix_angle.value) if teeth.helix_angle is not None else 0.0


def transverse_module(teeth: Teeth) -> float | None:
    """Pitch diameter per tooth, case lengths; None where the case does not give it."""
    if teeth.module is not None:
        module = teeth.module.value
    elif teeth.diametral_pitch is not None:
        module = 1.0 / teeth.diametral_pitch.value
    else:
        return None
    return module / math.cos(helix(teeth)) if teeth.normal_pitch else module


def mesh_of(joint: Gears, axis: Vec, places: Places, what: str) -> Mesh:
    """The mesh of a joint.

    Raises SceneError where the wheels do not lie in one plane square to the axis, or do not fit each other.
    """
    if joint.toward is not None:
        return _alone(joint, axis, places, what)
    first, second = (places[c] for c in joint.centres)
    line = sub(second, first)
    if size(line) == 0.0:
        raise SceneError(Status.INCONSISTENT, f"the centres of {what} lie at one place. Correct the points.")
    _refuse_oblique(unit(line), axis, what)
    n, m = (count.value for count in joint.counts)
    _refuse_misfit(joint, size(line), what)
    at = add(first, times(n / (n + m), line))
    radii = (abs(n / (n + m)) * size(line), abs(m / (n + m)) * size(line))
    base = 0 if n > 0 else 1  # a wheel with internal teeth has the hand of its pinion
    return _mesh(joint, base, at, unit(sub(at, (first, second)[base])), axis, radii)


def _alone(joint: Gears, axis: Vec, places: Places, what: str) -> Mesh:
    """A gear with a mate that the case does not show."""
    assert joint.toward is not None
    centre = joint.centres[0]
    if isinstance(joint.toward, Toward) and joint.toward.point == centre:
        raise SceneError(Status.INCONSISTENT, f"{what} cannot lie toward their own centre {centre}.")
    outward = heading(joint.toward, centre, places, f"the line to the mate of {what}")
    _refuse_oblique(outward, axis, what)
    module = transverse_module(joint.teeth)
    assert module is not None
    radius = joint.counts[0].value * module / 2.0
    at = add(places[centre], times(radius, outward))
    return _mesh(joint, 0, at, outward, axis, (radius,))


def _mesh(joint: Gears, base: int, at: Vec, outward: Vec, axis: Vec, radii: tuple[float, ...]) -> Mesh:
    """The mesh with its force on the gear ``base``, which has external teeth."""
    hand = 1.0 if joint.teeth.hand == "right" else -1.0
    axial = -hand * math.tan(helix(joint.teeth))
    outward = unit(sub(outward, times(dot(outward, axis), axis)))
    tangent = cross(axis, outward)
    on, by = joint.links[base], joint.links[1 - base]
    apart = math.tan(transverse_angle(joint.teeth))
    return Mesh(by, on, at, axis, tangent, times(-1.0, outward), apart, axial, radii)


def _refuse_oblique(line: Vec, axis: Vec, what: str) -> None:
    if abs(dot(line, axis)) > SQUARE:
        raise SceneError(
            Status.INCONSISTENT,
            f"the line of the centres of {what} is not square to their axis: gears here have parallel axes "
            "and lie in one plane. Correct the centres or the axis.",
        )


def _refuse_misfit(joint: Gears, apart: float, what: str) -> None:
    module = transverse_module(joint.teeth)
    if module is None:
        return
    fit = abs(sum(count.value for count in joint.counts)) * module / 2.0
    if abs(apart - fit) > MISFIT * fit:
        g, h = joint.centres
        raise SceneError(
            Status.INCONSISTENT,
            f"the teeth of {what} do not fit: their pitch circles touch where the centres are {fit:.6g} "
            f"apart, and {g} and {h} are {apart:.6g} apart. Correct the teeth, the pitch or module, or the "
            "centres.",
        )
