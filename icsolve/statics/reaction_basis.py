"""Joints as free bodies see them: where two links touch, and the unit forces and couples that pass.

A wrench is here (force x, force y, couple about the tie's own point), in the normalised frame.

Tooth forces: along the line of action, through the pitch point at the pressure angle.

The tangential part follows from the torques; the separating part, its size times the tangent of the
pressure angle, pushes each externally toothed gear toward its own pivot, whichever flank carries.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from icsolve.assembly.workspace import Frame, PlacedCase
from icsolve.case import Case, Guide, Joint, Number, Pin, Rope, Screw, Slide, Thread, is_named
from icsolve.case.joints import Guided, Mesh, Rolling
from icsolve.errors import SceneError, Status
from icsolve.kinematics.motion import TURN
from icsolve.numbers import Arithmetic, Scalar
from icsolve.screws import Point, Triple, basis_at, shift, subtract, unit_between
from icsolve.screws.joints import Points, freedoms, guide_direction, pitch_point, rolling_centres, transmitted
from icsolve.structure import Bond, Topology, pairs_of, topology
from icsolve.tuples import LateModule, NamedTuple

if TYPE_CHECKING:
    from icsolve.screws import ropes as rope_screws
else:
    rope_screws = LateModule("icsolve.screws.ropes")

Force = tuple[Scalar, Scalar, Scalar]
"""Force and couple about the tie's point."""

X: Force = (1.0, 0.0, 0.0)
Y: Force = (0.0, 1.0, 0.0)
COUPLE: Force = (0.0, 0.0, 1.0)


class Tie(NamedTuple):
    """A joint between two links: ``units`` act on link ``on`` at ``at``, their opposites on ``by``.

    Attributes
    ----------
    at : point of the joint [frame]
    where : its name ('' where it has none)
    units : what passes, each (Fx, Fy, couple about ``at``) [force, force, force times frame length]
    pivots : of a mesh the pivots of its two links
    screw, couples : of a screw the thread, and what each unit does on its rotor
    """

    joint: Joint
    by: str
    on: str
    at: Point
    where: str
    units: tuple[Force, ...]
    pivots: tuple[str, str] | tuple[()] = ()
    screw: Screw | None = None
    couples: tuple[Scalar, ...] = ()
    """of a screw what each unit does on its rotor"""

    @property
    def joint_kind(self) -> str:
        """The joint's kind in the words of the format."""
        return self.joint.kind

    @property
    def kind(self) -> str:
        """``screw``, or the joint's kind."""
        return "screw" if self.screw is not None else self.joint.kind


class RopeTie(NamedTuple):
    """A rope between links: the tension of part k is ``ratios[k]`` times that of the first.

    ``senses`` are those in which it slips on what it goes round between its parts: 1 (it runs toward its last
    end), -1, or 0.
    """

    rope: Rope
    parts: tuple[rope_screws.RopePart, ...]
    ratios: tuple[Scalar, ...]
    senses: tuple[float, ...]

    def unit(self, k: int) -> tuple[Point, Force]:
        """What a unit of tension in the first part does on the first link of a part: a force at a point."""
        part, ratio = self.parts[k], self.ratios[k]
        return part.at, (ratio * part.along[0], ratio * part.along[1], 0.0)


class Position(NamedTuple):
    """A case in one position and in motion: a `PlacedCase`, with the twists of the links (one per freedom;
    none: a structure)."""

    case: Case
    frame: Frame
    points: Points
    arithmetic: Arithmetic
    twists: Mapping[str, tuple[Triple, ...]]
    slack: float = 0.0
    ropes: tuple[RopeTie, ...] = ()

    @property
    def top(self) -> Topology:
        """Its bodies and bonds."""
        return topology(self.case)

    @property
    def scale(self) -> float:
        """Frame lengths a case length."""
        return self.frame.scale

    @property
    def mobility(self) -> int:
        """Motions that the joints leave."""
        return len(next(iter(self.twists.values()), ()))

    def relative(self, by: str, on: str, motion: int = 0) -> Triple:
        """Twist of a link as another sees it."""
        return subtract(self.twists[on][motion], self.twists[by][motion])


def ties_of(position: Position) -> tuple[Tie, ...]:
    """Every joint of a case, a pin of several links as one tie for each but the first; last what keeps the
    free ends of ropes, and the rotors of screws.

    Raises SceneError where teeth need the pin of a round link that the case does not give.
    """
    pivots = {(id(bond.joint), bond.links): bond.pivots for bond in position.top.bonds}
    found = []
    for joint in position.case.joints:
        for by, on in pairs_of(joint):
            bond = Bond(0, 1, 0, joint, (by, on), pivots.get((id(joint), (by, on)), ()))
            found.append(_tie(position, bond))
    ends = [_end_tie(position, tie) for tie in position.ropes if tie.rope.is_free]
    return (*found, *ends, *(_rotor_tie(position, screw) for screw in position.case.screws))


def _rotor_tie(position: Position, screw: Screw) -> Tie:
    """What keeps the rotor of a screw in its place."""
    ground, at = position.case.ground, screw.slide.at
    joint = Pin((ground, screw.rotor), at)
    return Tie(joint, ground, screw.rotor, position.points[at], "", (X, Y))


def rope_ties(place: PlacedCase) -> tuple[RopeTie, ...]:
    """Every rope of a case, without friction: its tension is one."""
    found = []
    for rope in place.case.ropes:
        parts = rope_screws.rope_parts(rope, place.points, place.frame.scale, place.arithmetic)
        found.append(RopeTie(rope, parts, (1.0,) * len(parts), (0.0,) * (len(parts) - 1)))
    return tuple(found)


def slipping(position: Position, senses: Iterable[tuple[float, ...]]) -> Position:
    """A position whose ropes slip in these senses.

    Raises SceneError where no number holds how much the pull of one grows.
    """
    ropes = [
        tie._replace(
            ratios=rope_screws.tension_ratios(tie.rope, tie.parts, own, position.arithmetic), senses=own
        )
        for tie, own in zip(position.ropes, senses, strict=True)
    ]
    return position._replace(ropes=tuple(ropes))


def _end_tie(position: Position, tie: RopeTie) -> Tie:
    """What keeps the free end of a rope on the line of its last part, beside the tension."""
    rope, (x, y) = tie.rope, tie.parts[-1].along
    guide = Guide(None, (rope.points[-2], rope.points[-1]), None)
    joint = Slide((rope.end, position.case.ground), rope.points[-1], guide)
    at = position.points[rope.points[-1]]
    return Tie(joint, position.case.ground, rope.end, at, "", ((0.0 - y, x, 0.0), COUPLE))


def _tie(position: Position, bond: Bond) -> Tie:
    joint, (by, on), points = bond.joint, bond.links, position.points
    if bond.pivots:
        at, units = _on_pivots(position, bond)
        return Tie(joint, by, on, at, "", units, bond.pivots)
    meshed = isinstance(joint, Mesh)
    if meshed or not joint.freedom:  # its links move as one: it may carry anything
        where = joint.at or _meeting(position, by, on)
        return Tie(joint, by, on, points.get(where, (0.0, 0.0)), "" if meshed else where, (X, Y, COUPLE))
    at = (0.0, 0.0) if joint.at is None else points[joint.at]
    basis = freedoms(bond, points, position.arithmetic)
    if position.slack and joint.has_written_centre:
        basis = _as_it_moves(position, bond, basis)
    where = joint.at if joint.at is not None and is_named(joint.at) else ""
    found = Tie(joint, by, on, at, where, _forces(tuple(basis_at(at, b) for b in basis)))
    if isinstance(joint, Guided) and joint.thread is not None:
        return _screwed(position, found, Screw(joint, joint.thread))
    return found


def _on_pivots(position: Position, bond: Bond) -> tuple[Point, tuple[Force, ...]]:
    """Where a mesh or a belt acts, and the two parts of its force: it is one constraint, but all passes that
    does no work on the turning about the pitch point (a tangential and a separating force, two strands).

    The forces of a belt lie along the line of the pivots, and across it through the pitch point; where that
    lies at infinity, since the pulleys turn as one, the second is a couple.
    """
    pitch = pitch_point(bond, position.points, position.arithmetic)
    if not bond.joint.pulls:
        return (pitch[0] / pitch[2], pitch[1] / pitch[2]), _forces(((0.0, 0.0, 1.0),))
    (ax, ay), (bx, by) = (position.points[p] for p in bond.pivots)
    at, (dx, dy) = ((ax + bx) / 2.0, (ay + by) / 2.0), (bx - ax, by - ay)
    x, y, w = shift(pitch, at)
    return at, ((dx, dy, 0.0), (0.0 - w * dy, w * dx, x * dx + y * dy))


def _screwed(position: Position, slide: Tie, screw: Screw) -> Tie:
    """The slide of a screw, with the force on its thread: along the axis, and a couple on the rotor.

    A force N square to a thread of radius r that rises by the angle l has N cos l along the axis and the
    couple N r sin l about it; 2 pi r tan l is the lead. Without friction any radius will do.
    """
    x, y = guide_direction(screw.slide.guide, position.points, position.arithmetic)
    along, turned = thread(screw.thread, position.scale, position.arithmetic)
    # the slide's second link is the one that the screw moves on: the unit acts on it the other way
    unit: Force = (0.0 - along * x, 0.0 - along * y, 0.0)
    couples = (*(0.0 for _ in slide.units), 0.0 - turned)
    return slide._replace(units=(*slide.units, unit), screw=screw, couples=couples)


def thread(screw: Thread, scale: float, arithmetic: Arithmetic) -> tuple[Scalar, Scalar]:
    """Of a unit force square to a screw's thread: its part along the axis, and its couple [frame length].

    With the lead angle l, ``tan l = lead / (2 pi r)``: cos l and r sin l; without a radius 1 and
    ``lead / (2 pi)``.
    """
    rise = arithmetic.given(screw.lead) * scale / arithmetic.given(TURN)
    if screw.radius is None:
        return 1.0, rise
    radius = arithmetic.given(screw.radius) * scale
    slant = arithmetic.sqrt(radius * radius + rise * rise)
    return radius / slant, radius * rise / slant


def _meeting(position: Position, by: str, on: str) -> str:
    """A point for the reaction of a weld that names none: one that both links carry, else one of either."""
    carries, points = position.case.carries, position.points
    mine, other = ([p for p in carries.get(link, ()) if p in points] for link in (by, on))
    named = [p for p in (*(p for p in mine if p in other), *other, *mine) if is_named(p)]
    return named[0] if named else ""


def _forces(basis: tuple[Triple, ...]) -> tuple[Force, ...]:
    return tuple((w[1], 0.0 - w[0], w[2]) for w in transmitted(basis))


def _as_it_moves(position: Position, bond: Bond, basis: tuple[Triple, ...]) -> tuple[Triple, ...]:
    """The centre that the motion has, where given centres miss it by a few digits of the figure."""
    x, y, w = position.relative(*bond.links)
    size = max(abs(x), abs(y), abs(w))
    if size <= 1e-9:
        return basis
    return ((x / w, y / w, 1.0),) if abs(w) > 1e-9 * size else ((x / size, y / size, 0.0),)


def meshes(ties: Sequence[Tie]) -> list[int]:
    """The ties that are meshes of known pressure angle: gears, and rolling by teeth (a rack)."""
    fixed = {t for t, tie in enumerate(ties) if isinstance(tie.joint, Mesh) and not tie.pivots}
    return [t for t, tie in enumerate(ties) if tie.joint.pressure_angle is not None and t not in fixed]


def with_flanks(position: Position, ties: Sequence[Tie], flanks: Mapping[int, float]) -> tuple[Tie, ...]:
    """The ties with the tooth force of each mesh along the line of action of the flank that carries.

    ``flanks`` has the sign of the tangential force of each mesh; 0 leaves the two parts apart.
    """
    along = {t: _along_action(position, ties[t], flank) for t, flank in flanks.items()}
    return tuple(along.get(t, tie) for t, tie in enumerate(ties))


def _along_action(position: Position, tie: Tie, flank: float) -> Tie:
    """The tangential and the separating force; with a flank one unit: a tangential 1 with its share."""
    assert tie.joint.pressure_angle is not None
    (tx, ty), (sx, sy) = tangent_and_separating(position, tie)
    if not flank:
        return tie._replace(units=((tx, ty, 0.0), (sx, sy, 0.0)))
    cosine, sine = position.arithmetic.turn(tie.joint.pressure_angle)
    apart = sine / cosine
    helix = tie.joint.helix
    if helix is not None and helix.normal:  # the tangent in the plane is that of the normal section / cos
        apart = apart / position.arithmetic.turn(helix.angle)[0]
    return tie._replace(units=((flank * tx + apart * sx, flank * ty + apart * sy, 0.0),))


def line_of_action(position: Position, bond: Bond) -> tuple[Point, Force]:
    """Of teeth of known pressure angle: the pitch point, and what passes there on one of their flanks."""
    tie = _along_action(position, _tie(position, bond), 1.0)
    return tie.at, tie.units[0]


def tangent_and_separating(position: Position, tie: Tie) -> tuple[Point, Point]:
    """Unit vectors at the pitch point: the common tangent, and the separating force on link ``on``."""
    arithmetic = position.arithmetic
    if not isinstance(tie.joint, Mesh):
        link, centre = _wheel(position, tie)
        (ex, ey), _ = unit_between(tie.at, centre, arithmetic)
        return (-ey, ex), ((ex, ey) if link == tie.on else (-ex, -ey))
    a, b = (position.points[p] for p in tie.pivots)
    (ex, ey), _ = unit_between(a, b, arithmetic)
    internal_on = tie.joint.sizes[1].value < 0
    inward, _ = unit_between(a, tie.at, arithmetic) if internal_on else unit_between(tie.at, b, arithmetic)
    return (-ey, ex), inward


def axial_shares(position: Position, tie: Tie, tangential: Scalar) -> list[tuple[str, Scalar]]:
    """Of helical teeth what acts square to the plane, by name.

    ``axial`` is the tangential force times the tangent of the helix angle [force]; ``couple L`` what it makes
    about the wheel L at its radius [case torque]; where the span of the bearings is given, ``bearing L`` is
    what each carries more for that couple [force].
    """
    helix = tie.joint.helix
    if helix is None:
        return []
    a = position.arithmetic
    cosine, sine = a.turn(helix.angle)
    axial = tangential * (sine / cosine)
    parts = [("axial", axial)]
    for link, pivot in zip(tie.joint.links, tie.pivots, strict=True):
        (px, py), (x, y) = position.points[pivot], tie.at
        couple = axial * a.sqrt((px - x) * (px - x) + (py - y) * (py - y)) / position.scale
        parts.append((f"couple {link}", couple * a.ratio(position.case.units.exact_torque)))
        if helix.span is not None:
            parts.append((f"bearing {link}", couple / a.given(helix.span)))
    return parts


def _wheel(position: Position, tie: Tie) -> tuple[str, Point]:
    """The round link of teeth that roll (a ring about it is hollow), and a point that its centre lies toward:
    by the radii, without them the nearest of the pins.

    Raises SceneError where there is none, or several could be it.
    """
    assert isinstance(tie.joint, Rolling)
    if tie.joint.radii is not None:
        return _by_radii(position, tie, tie.joint, tie.joint.radii)
    moving = [link for link in tie.joint.links if link != position.case.ground]
    pins = [(link, p) for link in moving for p in position.case.pivots(link) if p != tie.joint.at]
    found = [(link, position.points[p]) for link, p in pins]
    found.sort(key=lambda one: math.hypot(*_from(tie.at, one[1])))
    if not found or any(_is_aside(tie, found[0][1], other) for _, other in found[1:]):
        raise _no_wheel(tie, "give `radii`, and the pin at that distance")
    return found[0]


def _by_radii(
    position: Position, tie: Tie, joint: Rolling, radii: tuple[Number, Number]
) -> tuple[str, Point]:
    try:
        centres = rolling_centres(joint, position.case, position.points, position.scale)
    except LookupError as why:
        raise _no_wheel(tie, why.args[0]) from None
    for link, other, radius, centre in zip(joint.links, joint.links[::-1], radii, centres, strict=True):
        if centre is not None:
            return link if radius.value > 0.0 else other, position.points[centre]
    raise AssertionError(joint)


def _no_wheel(tie: Tie, why: str) -> SceneError:
    said = f"the teeth of links {tie.by} and {tie.on} need the pin of the round one: {why}."
    return SceneError(Status.UNSUPPORTED, said)


def _from(at: Point, p: Point) -> tuple[float, float]:
    return float(p[0] - at[0]), float(p[1] - at[1])


def _is_aside(tie: Tie, centre: Point, other: Point) -> bool:
    """Whether a pin lies off the line from the contact to a centre."""
    (ax, ay), (bx, by) = _from(tie.at, centre), _from(tie.at, other)
    return abs(ax * by - ay * bx) > ASIDE * math.hypot(ax, ay) * math.hypot(bx, by)


ASIDE = 1e-6
"""Sine of an angle that is more than what rounded coordinates leave."""
