"""Joints in space as free bodies see them: where two links touch, and the forces and couples that pass."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from icsolve.case import Case
from icsolve.case.space import Ball, Gears, Hinge, Joint, Radial, Thrust, Weld
from icsolve.errors import SceneError, Status
from icsolve.statics.space.figure import Figure, direction, in_case
from icsolve.statics.space.teeth import Mesh, mesh_of
from icsolve.statics.space.vectors import AXES, ZERO, Vec, cross, size, square_to, sub

Wrench = tuple[Vec, Vec]
"""Force, and couple about the tie's own point (normalised lengths)."""


class Tie(NamedTuple):
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
    mesh: Mesh | None = None


def ties_of(case: Case, figure: Figure) -> tuple[Tie, ...]:
    """Every joint of a case in space.

    Raises SceneError where an axis has no direction, gears do not fit, or hinges are out of line.
    """
    lines = (case.marks.get(f"joints[{n}]", (0, 0))[0] for n, _ in enumerate(in_case(case).joints))
    ties = tuple(_tie(joint, figure, line) for joint, line in zip(in_case(case).joints, lines, strict=True))
    _refuse_out_of_line(ties, figure)
    return ties


def kind_of(joint: Joint) -> str:
    """A joint's kind in the words of the format."""
    return type(joint).__name__.lower()


def _tie(joint: Joint, figure: Figure, line: int) -> Tie:
    by, on = joint.links
    where = f" (line {line})" if line else ""
    if isinstance(joint, Gears):
        return _meshing(joint, figure, f"gears {by} and {on}{where}")
    what = f"the {kind_of(joint)} of links {by} and {on}{where}"
    axis = ZERO
    if isinstance(joint, Radial | Thrust | Hinge):
        axis = direction(joint.axis, figure.places, f"the axis of {what}")
    return Tie(joint, by, on, figure.points[joint.at], joint.at, _units(joint, axis), axis)


def _units(joint: Joint, axis: Vec) -> tuple[Wrench, ...]:
    forces = tuple((e, ZERO) for e in AXES)
    match joint:
        case Radial():
            return tuple((e, ZERO) for e in square_to(axis))
        case Thrust():
            return (*((e, ZERO) for e in square_to(axis)), (axis, ZERO))
        case Hinge():
            return (*forces, *((ZERO, e) for e in square_to(axis)))
        case Weld():
            return (*forces, *((ZERO, e) for e in AXES))
        case Ball():
            return forces
    raise TypeError(type(joint).__name__)


def _meshing(joint: Gears, figure: Figure, what: str) -> Tie:
    """The tangential part alone; which flank carries shows the rest (`flanked`)."""
    axis = direction(joint.axis, figure.places, f"the axis of {what}")
    mesh = mesh_of(joint, axis, figure.places, what)
    at = figure.frame.normalised(mesh.at)
    where = joint.centres[joint.links.index(mesh.on)] if joint.toward is None else joint.centres[0]
    return Tie(joint, mesh.by, mesh.on, at, where, ((mesh.tangent, ZERO),), axis, mesh)


def flanked(ties: tuple[Tie, ...], flanks: Mapping[int, float]) -> tuple[Tie, ...]:
    """The ties with the whole tooth force of each mesh, on the flank that ``flanks`` has for it."""
    return tuple(
        tie._replace(units=((tie.mesh.force(flanks[t]), ZERO),)) if tie.mesh and t in flanks else tie
        for t, tie in enumerate(ties)
    )


ALIGNED = 2e-3
"""Hinges whose axes differ by less (sine, or fraction of their distance) are meant to share one axis."""
EXACT = 1e-12


def _refuse_out_of_line(ties: Iterable[Tie], figure: Figure) -> None:
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


def _nearly_one_axis(a: Tie, b: Tie) -> bool:
    apart = sub(a.at, b.at)
    off = size(cross(a.axis, b.axis))
    beside = size(cross(apart, b.axis)) / (size(apart) or 1.0)
    return max(off, beside) <= ALIGNED and max(off, beside) > EXACT
