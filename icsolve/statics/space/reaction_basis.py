"""Points and joints in space: where two links touch, and the forces and couples that pass there.

Points stand in a frame whose numbers are about 1, in any arithmetic.

The force between the teeth of gears with parallel axes, spur or helical: with the pressure angle a_t in the
plane of the wheel and the helix angle h, a tangential force W goes with a separating force W tan(a_t)
toward the wheel's own axis and an axial force W tan(h) (K. J. Waldron, G. L. Kinzel and S. K. Agrawal,
Kinematics, Dynamics, and Design of Machinery, ch. 11 and 13). In the section square to the teeth the
pressure angle a_n has tan(a_n) = tan(a_t) cos(h), and the module m_n is m_t cos(h).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import assert_never

from icsolve.assembly.wheels import refuse_unfit
from icsolve.case import Case, Centroid, Number, Spring, Toward, is_named
from icsolve.case.space import (
    Along,
    Axis,
    FromTo,
    GearPair,
    Hinge,
    Joint,
    Radial,
    RigidJoint,
    Space,
    SphericalJoint,
    Teeth,
    Thrust,
    Vector,
)
from icsolve.errors import SceneError, Status
from icsolve.numbers import FLOATS, Arithmetic, Scalar, largest_of
from icsolve.screws import add, cross, subtract
from icsolve.screws.space import AXES, ZERO, Components, Vec, dot, size, square_to, times, unit
from icsolve.tuples import NamedTuple

Places = Mapping[str, Vec]


class SpatialFrame(NamedTuple):
    """Normalised points are (p - origin) * scale; ``scale`` is a power of two, so that it rounds nothing.

    ``origin`` is a place of doubles [case length].
    """

    origin: tuple[float, float, float]
    scale: float

    def normalised(self, p: Vec) -> Vec:
        """A point in case units, normalised."""
        return times(self.scale, subtract(p, self.origin))

    def shown(self, p: Vec) -> Vec:
        """A normalised point in case units."""
        x, y, z = (a / self.scale + o + 0.0 for a, o in zip(p, self.origin, strict=True))
        return (x, y, z)


class SpatialFigure(NamedTuple):
    """Every point of a case.

    Attributes
    ----------
    places : by name, (3,) [case length]
    points : the same (3,) [frame]
    frame : origin and scale of the points
    arithmetic : of both
    """

    places: Places
    points: Places
    frame: SpatialFrame
    arithmetic: Arithmetic = FLOATS


def figure_of(space: Space, arithmetic: Arithmetic = FLOATS) -> SpatialFigure:
    """The points of a case in space.

    Raises
    ------
    SceneError
        ``underdetermined`` where centroids are of each other, ``near-singular`` where doubles cannot resolve
        the figure.
    """
    places: dict[str, Vec] = {}
    for name in space.points:
        _place(space, name, places, (), arithmetic)
    frame = frame_of(places)
    return SpatialFigure(places, {name: frame.normalised(p) for name, p in places.items()}, frame, arithmetic)


def _place(
    space: Space, name: str, places: dict[str, Vec], below: tuple[str, ...], arithmetic: Arithmetic
) -> Vec:
    if name in places:
        return places[name]
    if name in below:
        raise SceneError(Status.UNDERDETERMINED, f"{name} is the centroid of points that depend on it.")
    given = space.points[name]
    if isinstance(given, Centroid):
        of = [_place(space, other, places, (*below, name), arithmetic) for other in given.of]
        x, y, z = (sum(values, 0.0) / len(of) for values in zip(*of, strict=True))
    else:
        x, y, z = vector_of((given.x, given.y, given.z), arithmetic)
    places[name] = (x, y, z)
    return places[name]


def frame_of(places: Places) -> SpatialFrame:
    """The frame about the first point; the farthest point is 1/2 to 1 from it along an axis.

    Raises SceneError (``near-singular``) where doubles there are farther apart than a thousandth of that.
    """
    rough = [(float(x), float(y), float(z)) for x, y, z in places.values()]
    origin = next(iter(rough), (0.0, 0.0, 0.0))
    reach = largest_of([c for p in rough for c in subtract(p, origin)])
    offset = largest_of([c for p in rough for c in p])
    if reach and math.ulp(offset) > 1e-3 * reach:
        raise SceneError(
            Status.NEAR_SINGULAR,
            "the points lie so far from the origin that doubles cannot resolve the figure: move the origin.",
        )
    exponent = math.frexp(reach)[1] if reach else 0
    return SpatialFrame(origin, math.ldexp(1.0, -exponent))


def direction(axis: Axis, figure: SpatialFigure, what: str) -> Vec:
    """The unit vector of an axis.

    Raises SceneError, about ``what``, where its two points lie at one place.
    """
    match axis:
        case Along(word):
            vector = AXES["xyz".index(word[-1])]
            return times(-1.0, vector) if word[0] == "-" else vector
        case Vector():
            return unit(vector_of(axis, figure.arithmetic), figure.arithmetic)
        case FromTo(a, b):
            return between(a, b, figure, what)


def vector_of(parts: tuple[Number, ...], arithmetic: Arithmetic) -> Vec:
    """Three numbers as a vector."""
    x, y, z = (arithmetic.given(part) for part in parts)
    return (x, y, z)


def between(a: str, b: str, figure: SpatialFigure, what: str) -> Vec:
    """The unit vector from one point to another.

    Raises SceneError, about ``what``, where they lie at one place.
    """
    apart = subtract(figure.places[b], figure.places[a])
    if not any(map(float, apart)):
        raise SceneError(
            Status.INCONSISTENT,
            f"{what} has no direction: {_shown(a)} and {_shown(b)} lie at one place. Give it by its "
            "components, or correct the points.",
        )
    return unit(apart, figure.arithmetic)


def heading(load_heading: Axis | Toward, at: str, figure: SpatialFigure, what: str) -> Vec:
    """The unit vector of a force at a point."""
    if isinstance(load_heading, Toward):
        sign = -1.0 if load_heading.away else 1.0
        return times(sign, between(at, load_heading.point, figure, what))
    return direction(load_heading, figure, what)


def spring_length(spring: Spring, figure: SpatialFigure) -> Scalar:
    """Distance of a spring's ends, case lengths."""
    return size(subtract(figure.places[spring.to], figure.places[spring.at]), figure.arithmetic)


def _shown(name: str) -> str:
    return name if is_named(name) else "its point"


def in_case(case: Case) -> Space:
    """What a case in space says of it."""
    assert case.space is not None
    return case.space


class SpatialTie(NamedTuple):
    """A joint between two links: ``units`` act on link ``on`` at ``at``, their opposites on ``by``.

    Attributes
    ----------
    at : point of the joint [frame]
    where : its name
    units : what passes, each (Fx, Fy, Fz, Mx, My, Mz) about ``at`` [force, force times frame length]
    axis : unit vector of a bearing, hinge or mesh
    mesh : of gears, where they touch and how
    """

    joint: Joint
    by: str
    on: str
    at: Vec
    where: str
    units: tuple[Components, ...]
    axis: Vec = ZERO
    mesh: SpatialMesh | None = None

    @property
    def joint_kind(self) -> str:
        """The joint's kind in the words of the format."""
        return kind_of(self.joint)


def ties_of(case: Case, figure: SpatialFigure) -> tuple[SpatialTie, ...]:
    """Every joint of a case in space, in its order, in the arithmetic of the figure.

    Raises
    ------
    SceneError
        ``inconsistent`` where an axis has no direction, gears do not fit, or hinges are out of line.
    """
    lines = (case.marks.get(f"joints[{n}]", (0, 0))[0] for n, _ in enumerate(in_case(case).joints))
    ties = tuple(_tie(joint, figure, line) for joint, line in zip(in_case(case).joints, lines, strict=True))
    _refuse_out_of_line(ties)
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
        axis = direction(joint.axis, figure, f"the axis of {what}")
    units = _units(joint, axis, figure.arithmetic)
    return SpatialTie(joint, by, on, figure.points[joint.at], joint.at, units, axis)


def _units(joint: Joint, axis: Vec, arithmetic: Arithmetic) -> tuple[Components, ...]:
    """The forces, then the couples, that a joint passes: what does no work on the motions that it leaves."""
    forces: tuple[Vec, ...] = AXES
    couples: tuple[Vec, ...] = ()
    match joint:
        case Radial():
            forces = square_to(axis, arithmetic)
        case Thrust():
            forces = (*square_to(axis, arithmetic), axis)
        case Hinge():
            couples = square_to(axis, arithmetic)
        case RigidJoint():
            couples = AXES
        case SphericalJoint() | GearPair():  # what gears pass, `_meshing` tells
            pass
        case _:
            assert_never(joint)
    return (*((*e, *ZERO) for e in forces), *((*ZERO, *e) for e in couples))


def _meshing(joint: GearPair, figure: SpatialFigure, what: str) -> SpatialTie:
    """The tangential part alone; which flank carries shows the rest (`flanked`)."""
    axis = direction(joint.axis, figure, f"the axis of {what}")
    mesh = mesh_of(joint, axis, figure, what)
    at = figure.frame.normalised(mesh.at)
    where = joint.centres[joint.links.index(mesh.on)] if joint.toward is None else joint.centres[0]
    return SpatialTie(joint, mesh.by, mesh.on, at, where, ((*mesh.tangent, *ZERO),), axis, mesh)


def flanked(ties: tuple[SpatialTie, ...], flanks: Mapping[int, float]) -> tuple[SpatialTie, ...]:
    """The ties with the whole tooth force of each mesh, on the flank that ``flanks`` has for it.

    ``flanks`` has, by the place of a tie, the sign of its tangential force.
    """
    return tuple(
        tie._replace(units=((*tie.mesh.force(flanks[t]), *ZERO),)) if tie.mesh and t in flanks else tie
        for t, tie in enumerate(ties)
    )


ALIGNED = 2e-3
"""Hinges whose axes differ by less (sine, or fraction of their distance) are meant to share one axis."""
EXACT = 1e-12


def _refuse_out_of_line(ties: Iterable[SpatialTie]) -> None:
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
    apart = subtract(a.at, b.at)
    off = float(size(cross(a.axis, b.axis)))
    beside = float(size(cross(apart, b.axis))) / (float(size(apart)) or 1.0)
    return max(off, beside) <= ALIGNED and max(off, beside) > EXACT


SQUARE = 2e-3
"""The line of the centres may lean against the plane of the wheels by this (sine)."""


class SpatialMesh(NamedTuple):
    """Where two gears touch, and the parts of the force there on the link ``on`` (an external gear).

    Attributes
    ----------
    at : pitch point [case length]
    axis : unit vector of both axes
    tangent : unit vector along the motion of ``on`` for positive turning about ``axis``
    inward : unit vector toward the axis of ``on``
    separating, axial : parts of the force along ``inward`` and ``axis``, per unit of the tangential one
    radii : pitch radii of the gears that the case shows [case length]
    """

    by: str
    on: str
    at: Vec
    axis: Vec
    tangent: Vec
    inward: Vec
    separating: Scalar
    axial: Scalar
    radii: tuple[Scalar, ...]

    def force(self, flank: float) -> Vec:
        """The force on ``on`` per unit of tangential force on a flank (+1 or -1; 0: the tangential part)."""
        if flank == 0.0:
            return self.tangent
        apart = times(self.separating, self.inward)
        return add(apart, times(flank, add(self.tangent, times(self.axial, self.axis))))


def _helix(teeth: Teeth, arithmetic: Arithmetic) -> tuple[Scalar, Scalar]:
    """Cosine and sine of the helix angle."""
    return arithmetic.turn(teeth.helix_angle) if teeth.helix_angle is not None else (1.0, 0.0)


def _separating(teeth: Teeth, arithmetic: Arithmetic) -> Scalar:
    """Tangent of the pressure angle in the plane of the wheel."""
    cosine, sine = arithmetic.turn(teeth.pressure_angle)
    return sine / cosine / (_helix(teeth, arithmetic)[0] if teeth.normal_angle else 1.0)


def _transverse_module(teeth: Teeth, arithmetic: Arithmetic) -> Scalar | None:
    """Pitch diameter per tooth, case lengths; None where the case does not give it."""
    if teeth.module is not None:
        module = arithmetic.given(teeth.module)
    elif teeth.diametral_pitch is not None:
        module = 1.0 / arithmetic.given(teeth.diametral_pitch)
    else:
        return None
    return module / _helix(teeth, arithmetic)[0] if teeth.normal_pitch else module


def mesh_of(joint: GearPair, axis: Vec, figure: SpatialFigure, what: str) -> SpatialMesh:
    """The mesh of a joint.

    Parameters
    ----------
    joint : gears with parallel axes
    axis : unit vector of both
    figure : places of the centres
    what : the joint in words, for refusals

    Raises
    ------
    SceneError
        ``inconsistent`` where the wheels do not lie in one plane square to the axis, or do not fit.
    """
    if joint.toward is not None:
        return _alone(joint, axis, figure, what)
    arithmetic = figure.arithmetic
    first, second = (figure.places[c] for c in joint.centres)
    line = subtract(second, first)
    if not any(map(float, line)):
        raise SceneError(Status.INCONSISTENT, f"the centres of {what} lie at one place. Correct the points.")
    apart = size(line, arithmetic)
    _refuse_oblique(unit(line, arithmetic), axis, what)
    module, (a, b) = _transverse_module(joint.teeth, arithmetic), joint.centres
    if module is not None:
        refuse_unfit(what, joint.counts, float(module), float(apart), (a, b, "centres"))
    n, m = map(arithmetic.given, joint.counts)
    at = add(first, times(n / (n + m), line))
    radii = (abs(n / (n + m)) * apart, abs(m / (n + m)) * apart)
    base = 0 if joint.counts[0].value > 0 else 1  # a wheel with internal teeth has the hand of its pinion
    radial = unit(subtract(at, (first, second)[base]), arithmetic)
    return _mesh(joint, base, at, radial, axis, radii, arithmetic)


def _alone(joint: GearPair, axis: Vec, figure: SpatialFigure, what: str) -> SpatialMesh:
    """A gear with a mate that the case does not show."""
    assert joint.toward is not None
    centre, arithmetic = joint.centres[0], figure.arithmetic
    if isinstance(joint.toward, Toward) and joint.toward.point == centre:
        raise SceneError(Status.INCONSISTENT, f"{what} cannot lie toward their own centre {centre}.")
    outward = heading(joint.toward, centre, figure, f"the line to the mate of {what}")
    _refuse_oblique(outward, axis, what)
    module = _transverse_module(joint.teeth, arithmetic)
    assert module is not None
    radius = arithmetic.given(joint.counts[0]) * module / 2.0
    at = add(figure.places[centre], times(radius, outward))
    return _mesh(joint, 0, at, outward, axis, (radius,), arithmetic)


def _mesh(
    joint: GearPair,
    base: int,
    at: Vec,
    outward: Vec,
    axis: Vec,
    radii: tuple[Scalar, ...],
    arithmetic: Arithmetic,
) -> SpatialMesh:
    """The mesh with its force on the gear ``base``, which has external teeth."""
    hand = 1.0 if joint.teeth.hand == "right" else -1.0
    cosine, sine = _helix(joint.teeth, arithmetic)
    outward = unit(subtract(outward, times(dot(outward, axis), axis)), arithmetic)
    tangent = cross(axis, outward)
    on, by = joint.links[base], joint.links[1 - base]
    apart = _separating(joint.teeth, arithmetic)
    return SpatialMesh(by, on, at, axis, tangent, times(-1.0, outward), apart, -hand * sine / cosine, radii)


def _refuse_oblique(line: Vec, axis: Vec, what: str) -> None:
    if abs(float(dot(line, axis))) > SQUARE:
        raise SceneError(
            Status.INCONSISTENT,
            f"the line of the centres of {what} is not square to their axis: gears here have parallel axes "
            "and lie in one plane. Correct the centres or the axis.",
        )
