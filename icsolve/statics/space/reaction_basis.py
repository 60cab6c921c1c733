"""Joints in space as free bodies see them: where two links touch, and the forces and couples that pass.

The force between the teeth of gears with parallel axes, spur or helical.

With the pressure angle a_t in the plane of the wheel and the helix angle h, a tangential force W goes with
a separating force W tan(a_t) toward the wheel's own axis and an axial force W tan(h) (K. J. Waldron,
G. L. Kinzel and S. K. Agrawal, Kinematics, Dynamics, and Design of Machinery, ch. 11 and 13). In the
section square to the teeth the pressure angle a_n has tan(a_n) = tan(a_t) cos(h), and the module m_n is
m_t cos(h).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from icsolve.case import Case, Toward
from icsolve.case.space import GearPair, Hinge, Joint, Radial, RigidJoint, SphericalJoint, Teeth, Thrust
from icsolve.errors import SceneError, Status
from icsolve.statics.space.figure import (
    AXES,
    ZERO,
    Places,
    SpatialFigure,
    Vec,
    add,
    cross,
    direction,
    dot,
    heading,
    in_case,
    size,
    square_to,
    sub,
    times,
    unit,
)

Wrench = tuple[Vec, Vec]
"""Force, and couple about the tie's own point (normalised lengths)."""


class SpatialTie(NamedTuple):
    """A joint between two links: ``units`` act on link ``on`` at ``at``, their opposites on ``by``.

    ``at`` is normalised; ``axis`` is that of a bearing, hinge or mesh; ``where`` names the joint's point.
    """

    joint: Joint
    by: str
    on: str
    at: Vec
    where: str
    units: tuple[Wrench, ...]
    axis: Vec = ZERO
    mesh: SpatialMesh | None = None


def ties_of(case: Case, figure: SpatialFigure) -> tuple[SpatialTie, ...]:
    """Every joint of a case in space.

    Raises SceneError where an axis has no direction, gears do not fit, or hinges are out of line.
    """
    lines = (case.marks.get(f"joints[{n}]", (0, 0))[0] for n, _ in enumerate(in_case(case).joints))
    ties = tuple(_tie(joint, figure, line) for joint, line in zip(in_case(case).joints, lines, strict=True))
    _refuse_out_of_line(ties, figure)
    return ties


def kind_of(joint: Joint) -> str:
    """A joint's kind in the words of the format."""
    words = {SphericalJoint: "ball", RigidJoint: "weld", GearPair: "gears"}
    return words.get(type(joint)) or type(joint).__name__.lower()


def _tie(joint: Joint, figure: SpatialFigure, line: int) -> SpatialTie:
    by, on = joint.links
    where = f" (line {line})" if line else ""
    if isinstance(joint, GearPair):
        return _meshing(joint, figure, f"gears {by} and {on}{where}")
    what = f"the {kind_of(joint)} of links {by} and {on}{where}"
    axis = ZERO
    if isinstance(joint, Radial | Thrust | Hinge):
        axis = direction(joint.axis, figure.places, f"the axis of {what}")
    return SpatialTie(joint, by, on, figure.points[joint.at], joint.at, _units(joint, axis), axis)


def _units(joint: Joint, axis: Vec) -> tuple[Wrench, ...]:
    forces = tuple((e, ZERO) for e in AXES)
    match joint:
        case Radial():
            return tuple((e, ZERO) for e in square_to(axis))
        case Thrust():
            return (*((e, ZERO) for e in square_to(axis)), (axis, ZERO))
        case Hinge():
            return (*forces, *((ZERO, e) for e in square_to(axis)))
        case RigidJoint():
            return (*forces, *((ZERO, e) for e in AXES))
        case SphericalJoint():
            return forces
    raise TypeError(type(joint).__name__)


def _meshing(joint: GearPair, figure: SpatialFigure, what: str) -> SpatialTie:
    """The tangential part alone; which flank carries shows the rest (`flanked`)."""
    axis = direction(joint.axis, figure.places, f"the axis of {what}")
    mesh = mesh_of(joint, axis, figure.places, what)
    at = figure.frame.normalised(mesh.at)
    where = joint.centres[joint.links.index(mesh.on)] if joint.toward is None else joint.centres[0]
    return SpatialTie(joint, mesh.by, mesh.on, at, where, ((mesh.tangent, ZERO),), axis, mesh)


def flanked(ties: tuple[SpatialTie, ...], flanks: Mapping[int, float]) -> tuple[SpatialTie, ...]:
    """The ties with the whole tooth force of each mesh, on the flank that ``flanks`` has for it."""
    return tuple(
        tie._replace(units=((tie.mesh.force(flanks[t]), ZERO),)) if tie.mesh and t in flanks else tie
        for t, tie in enumerate(ties)
    )


ALIGNED = 2e-3
"""Hinges whose axes differ by less (sine, or fraction of their distance) are meant to share one axis."""
EXACT = 1e-12


def _refuse_out_of_line(ties: Iterable[SpatialTie], figure: SpatialFigure) -> None:
    """Refuse hinges of one pair of links that nearly share an axis: they would bind in the model alone."""
    hinges = [tie for tie in ties if isinstance(tie.joint, Hinge)]
    for n, a in enumerate(hinges):
        for b in hinges[:n]:
            if {a.by, a.on} == {b.by, b.on} and _nearly_one_axis(a, b):
                raise SceneError(
                    Status.INCONSISTENT,
                    f"the hinges of links {a.by} and {a.on} at {b.where} and {a.where} are out of line by a "
                    "little, so they would bind. Give both the axis through their points, "
                    f"`axis: [{b.where}, {a.where}]`.",
                )


def _nearly_one_axis(a: SpatialTie, b: SpatialTie) -> bool:
    apart = sub(a.at, b.at)
    off = size(cross(a.axis, b.axis))
    beside = size(cross(apart, b.axis)) / (size(apart) or 1.0)
    return max(off, beside) <= ALIGNED and max(off, beside) > EXACT


SQUARE = 2e-3
"""The line of the centres may lean against the plane of the wheels by this (sine)."""
MISFIT = 2e-3
"""Centres may miss the distance of the pitch radii by this fraction of it."""


class SpatialMesh(NamedTuple):
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


def mesh_of(joint: GearPair, axis: Vec, places: Places, what: str) -> SpatialMesh:
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


def _alone(joint: GearPair, axis: Vec, places: Places, what: str) -> SpatialMesh:
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


def _mesh(
    joint: GearPair, base: int, at: Vec, outward: Vec, axis: Vec, radii: tuple[float, ...]
) -> SpatialMesh:
    """The mesh with its force on the gear ``base``, which has external teeth."""
    hand = 1.0 if joint.teeth.hand == "right" else -1.0
    axial = -hand * math.tan(helix(joint.teeth))
    outward = unit(sub(outward, times(dot(outward, axis), axis)))
    tangent = cross(axis, outward)
    on, by = joint.links[base], joint.links[1 - base]
    apart = math.tan(transverse_angle(joint.teeth))
    return SpatialMesh(by, on, at, axis, tangent, times(-1.0, outward), apart, axial, radii)


def _refuse_oblique(line: Vec, axis: Vec, what: str) -> None:
    if abs(dot(line, axis)) > SQUARE:
        raise SceneError(
            Status.INCONSISTENT,
            f"the line of the centres of {what} is not square to their axis: gears here have parallel axes "
            "and lie in one plane. Correct the centres or the axis.",
        )


def _refuse_misfit(joint: GearPair, apart: float, what: str) -> None:
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
