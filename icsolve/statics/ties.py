"""Joints as free bodies see them: where two links touch, and the unit forces and couples that pass.

A wrench is here (force x, force y, couple about the tie's own point), in the normalised frame.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from icsolve.case import Belt, Case, Contact, Gears, Joint, KnownCentre, Pin, Roll, Slide, Slot, Weld
from icsolve.numbers.arithmetic import FLOATS, Arithmetic, Scalar
from icsolve.screws.joints import Points, freedoms, pitch_point, transmitted
from icsolve.screws.plane import Point, Triple, shift, subtract
from icsolve.structure.topology import Bond, Topology, pairs_of

Force = tuple[Scalar, Scalar, Scalar]
"""Force and couple about the tie's point."""

X: Force = (1.0, 0.0, 0.0)
Y: Force = (0.0, 1.0, 0.0)
COUPLE: Force = (0.0, 0.0, 1.0)


class Tie(NamedTuple):
    """A joint between two links: ``units`` act on link ``on`` at ``at``, their opposites on ``by``.

    ``where`` names the point ('' where it has no name).
    """

    joint: Joint
    by: str
    on: str
    at: Point
    where: str
    units: tuple[Force, ...]
    pivots: tuple[str, str] = ("", "")


class Position(NamedTuple):
    """A case in one position: normalised points, twists of the links (one per freedom; none: a structure)."""

    case: Case
    top: Topology
    points: Points
    scale: float
    """normalised lengths per case length"""
    twists: Mapping[str, tuple[Triple, ...]]
    slack: float = 0.0

    @property
    def mobility(self) -> int:
        """Motions that the joints leave."""
        return len(next(iter(self.twists.values()), ()))

    def relative(self, by: str, on: str, motion: int = 0) -> Triple:
        """Twist of a link as another sees it."""
        return subtract(self.twists[on][motion], self.twists[by][motion])


def ties_of(position: Position, arithmetic: Arithmetic = FLOATS) -> tuple[Tie, ...]:
    """Every joint of a case, a pin of several links as one tie for each but the first.

    The points of the position are numbers of the same arithmetic.
    """
    pivots = {(id(bond.joint), bond.links): bond.pivots for bond in position.top.bonds}
    found = []
    for joint in position.case.joints:
        for by, on in pairs_of(joint):
            bond = Bond(0, 1, 0, joint, (by, on), pivots.get((id(joint), (by, on)), ("", "")))
            found.append(_tie(position, bond, arithmetic))
    return tuple(found)


def _tie(position: Position, bond: Bond, arithmetic: Arithmetic) -> Tie:
    joint, (by, on) = bond.joint, bond.links
    if isinstance(joint, Weld):
        where = joint.at or _meeting(position, by, on)
        return Tie(joint, by, on, position.points.get(where, (0.0, 0.0)), where, (X, Y, COUPLE))
    where, at = _place(bond, position.points, arithmetic)
    return Tie(joint, by, on, at, where, _units(position, bond, at, arithmetic), bond.pivots)


def _meeting(position: Position, by: str, on: str) -> str:
    """A point for the reaction of a weld that names none: one that both links carry, else one of either."""
    carries, points = position.case.carries, position.points
    mine, other = ([p for p in carries.get(link, ()) if p in points] for link in (by, on))
    named = [p for p in (*(p for p in mine if p in other), *other, *mine) if not p.startswith("@")]
    return named[0] if named else ""


def _place(bond: Bond, points: Points, arithmetic: Arithmetic) -> tuple[str, Point]:
    joint = bond.joint
    if isinstance(joint, Gears):
        x, y, w = pitch_point(bond, points, arithmetic)
        return "", (x / w, y / w)
    if isinstance(joint, Belt):
        (ax, ay), (bx, by) = (points[p] for p in bond.pivots)
        return "", ((ax + bx) / 2.0, (ay + by) / 2.0)
    at = getattr(joint, "at", None)
    if at is None:
        return "", (0.0, 0.0)
    return ("" if at.startswith("@") else at), points[at]


def _units(position: Position, bond: Bond, at: Point, arithmetic: Arithmetic) -> tuple[Force, ...]:
    """What the joint transmits: the wrenches that do no work on the freedoms that it leaves.

    A mesh or a belt is one constraint, but the force in it has two unknown parts (tangential and
    separating, the pulls of two strands): all that does no work on the turning about the pitch point.
    """
    basis = freedoms(bond, position.points, arithmetic)
    if isinstance(bond.joint, Gears | Belt):
        basis = basis[:1]
    if position.slack and isinstance(bond.joint, KnownCentre | Roll):
        basis = _as_it_moves(position, bond, basis)
    return tuple((w[1], -w[0], w[2]) for w in transmitted(tuple(shift(b, at) for b in basis)))


def _as_it_moves(position: Position, bond: Bond, basis: tuple[Triple, ...]) -> tuple[Triple, ...]:
    """The centre that the motion has, where given centres miss it by a few digits of the figure."""
    x, y, w = position.relative(*bond.links)
    size = max(abs(x), abs(y), abs(w))
    if size <= 1e-9 or position.mobility != 1:
        return basis
    return ((x / w, y / w, 1.0),) if abs(w) > 1e-9 * size else ((x / size, y / size, 0.0),)


def is_touching(joint: Joint) -> bool:
    """Whether a joint can push and not pull."""
    return isinstance(joint, Contact)


def kind_of(joint: Joint) -> str:
    """A joint's kind in the words of the format."""
    return "centre" if isinstance(joint, KnownCentre) else type(joint).__name__.lower()


__all__ = ["COUPLE", "Force", "Pin", "Position", "Slide", "Slot", "Tie", "is_touching", "kind_of", "ties_of"]
