"""Tooth forces: along the line of action, through the pitch point at the pressure angle.

The tangential part follows from the torques; the separating part, its size times the tangent of the
pressure angle, pushes each externally toothed gear toward its own pivot, whichever flank carries.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from icsolve.assembly.meshing import MISFIT
from icsolve.case import Gears, Pin, Roll
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import FLOATS, Arithmetic
from icsolve.screws.plane import Point
from icsolve.statics.ties import Position, Tie


def meshes(ties: Sequence[Tie]) -> list[int]:
    """The ties that are meshes of known pressure angle: gears, and rolling by teeth (a rack)."""
    return [t for t, tie in enumerate(ties) if _has_teeth(tie)]


def _has_teeth(tie: Tie) -> bool:
    if isinstance(tie.joint, Gears):
        return tie.joint.pressure_angle is not None and tie.pivots[0] != ""
    return isinstance(tie.joint, Roll) and tie.joint.pressure_angle is not None


def with_flanks(
    position: Position, ties: Sequence[Tie], flanks: Mapping[int, float], arithmetic: Arithmetic = FLOATS
) -> tuple[Tie, ...]:
    """The ties with the tooth force of each mesh along the line of action of the flank that carries.

    ``flanks`` has the sign of the tangential force of each mesh; 0 leaves the two parts apart.
    """
    along = {t: _along_action(position, ties[t], flank, arithmetic) for t, flank in flanks.items()}
    return tuple(along.get(t, tie) for t, tie in enumerate(ties))


def _along_action(position: Position, tie: Tie, flank: float, arithmetic: Arithmetic) -> Tie:
    """The tangential and the separating force; with a flank one unit: a tangential 1 with its share."""
    assert isinstance(tie.joint, Gears | Roll) and tie.joint.pressure_angle is not None
    (tx, ty), (sx, sy) = tangent_and_separating(position, tie, arithmetic)
    if not flank:
        return tie._replace(units=((tx, ty, 0.0), (sx, sy, 0.0)))
    cosine, sine = arithmetic.turn(tie.joint.pressure_angle)
    apart = sine / cosine
    return tie._replace(units=((flank * tx + apart * sx, flank * ty + apart * sy, 0.0),))


def tangent_and_separating(
    position: Position, tie: Tie, arithmetic: Arithmetic = FLOATS
) -> tuple[Point, Point]:
    """Unit vectors at the pitch point: the common tangent, and the separating force on link ``on``."""
    if isinstance(tie.joint, Roll):
        link, centre = _wheel(position, tie)
        ex, ey = _unit(tie.at, centre, arithmetic)
        return (-ey, ex), ((ex, ey) if link == tie.on else (-ex, -ey))
    a, b = (position.points[p] for p in tie.pivots)
    ex, ey = _unit(a, b, arithmetic)
    assert isinstance(tie.joint, Gears)
    internal_on = tie.joint.teeth[1].value < 0
    return (-ey, ex), (
        _unit(a, tie.at, arithmetic) if internal_on else _unit(tie.at, b, arithmetic)
    )


def axial_shares(position: Position, tie: Tie, tangential: float) -> tuple[tuple[str, float], ...]:
    """Of helical teeth the axial force, square to the plane, and the couple that it makes about each wheel.

    Where the span of the bearings is given, ``bearing`` is what each carries more for that couple.
    """
    helix = tie.joint.helix if isinstance(tie.joint, Gears) else None
    if helix is None:
        return ()
    axial = tangential * math.tan(math.radians(helix.angle.value))
    parts = [("axial", axial)]
    for link, pivot in zip(tie.joint.links, tie.pivots, strict=True):
        couple = axial * math.dist(position.points[pivot], tie.at) / position.scale
        parts.append((f"couple {link}", couple * position.case.units.torque_per_force_length))
        if helix.span is not None:
            parts.append((f"bearing {link}", couple / helix.span.value))
    return tuple(parts)


def _wheel(position: Position, tie: Tie) -> tuple[str, Point]:
    """The round link of a rolling contact (not a hollow one), and its centre: the pin at its radius."""
    assert isinstance(tie.joint, Roll)
    radii = tie.joint.radii or (None, None)
    for link, radius in zip(tie.joint.links, radii, strict=True):
        if link == position.case.ground or (radius is not None and radius.value <= 0.0):
            continue
        for joint in position.case.joints:
            if isinstance(joint, Pin) and link in joint.links and joint.at != tie.joint.at:
                centre = position.points[joint.at]
                apart = math.dist(centre, tie.at) / position.scale
                if radius is None or abs(apart - radius.value) <= MISFIT * radius.value:
                    return link, centre
    raise SceneError(
        Status.UNSUPPORTED,
        f"the teeth of links {tie.by} and {tie.on} need the pin of the round one: give `radii`, and the pin "
        "at that distance.",
    )


def _unit(a: Point, b: Point, arithmetic: Arithmetic) -> Point:
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = arithmetic.sqrt(dx * dx + dy * dy)
    return dx / length, dy / length
