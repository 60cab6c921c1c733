"""What joints can carry without a load: where constraints are redundant, and whether a motion hangs on it."""

from __future__ import annotations

from icsolve.assembly.workspace import PlacedCase
from icsolve.errors import SceneError
from icsolve.numbers import Scalar, decider
from icsolve.numbers.linear import eliminate
from icsolve.screws import Triple
from icsolve.screws.joints import freedoms, transmitted
from icsolve.screws.ropes import rope_parts
from icsolve.statics.reaction_basis import Position, line_of_action
from icsolve.structure import Bond, reached
from icsolve.tuples import NamedTuple

Pushes = tuple[tuple[int, float, Triple], ...]
"""What one size of force does: on which bodies, with which sign, by which wrench."""


class SelfStress(NamedTuple):
    """The ways in which joints can be stressed without a load.

    Attributes
    ----------
    ways : how many independent ones there are
    links : those at the stressed joints
    moving : how many of the ways are among links that move against one another where they have the stressed
        joints alone
    """

    ways: int
    links: tuple[str, ...]
    moving: int


def self_stress(place: PlacedCase) -> SelfStress:
    """Of the joints as they take freedoms whatever the numbers are: teeth that roll push along their line of
    action alone, and in a ring of links that only slide on each other one guide need not keep its direction.

    Raises MoreDigits of balls, where it is open what is stressed.
    """
    top, arithmetic = place.top, place.arithmetic
    joints: list[list[Pushes]] = []
    group = list(range(len(top.members)))
    for bond in top.bonds:
        wrenches = _constraints(place, bond)
        if bond.joint.keeps_direction:
            a, b = group[bond.a], group[bond.b]
            wrenches = wrenches[1:] if a == b else wrenches  # the couple is the first
            group = [a if one == b else one for one in group]
        joints.append([((bond.b, 1.0, wrench), (bond.a, -1.0, wrench)) for wrench in wrenches])
    for rope in top.ropes:
        parts = rope_parts(rope, place.points, place.frame.scale, arithmetic)
        ends = [(part.wrench, zip(part.links, (-1.0, 1.0), strict=True)) for part in parts]
        joints.append([tuple((top.body_of[link], s, wrench) for wrench, both in ends for link, s in both)])
    columns = [(n, pushes) for n, one in enumerate(joints) for pushes in one]
    rows: list[dict[int, Scalar]] = [{} for _ in range(3 * len(top.members))]  # equilibrium of each body
    for column, (_, pushes) in enumerate(columns):
        for body, sign, wrench in pushes:
            for n, part in enumerate(wrench if body != top.ground else ()):
                row = rows[3 * body + n]
                row[column] = row.get(column, 0.0) + sign * part
    general = eliminate(rows, len(columns), vanishes=decider(arithmetic))
    stressed = {
        n
        for column, (n, _) in enumerate(columns)
        if any(not arithmetic.vanishes(share, 1.0) for share in general.of(column).values())
    }
    beside: dict[int, set[int]] = {}  # the bodies that a stressed joint ties to each
    for n in stressed:
        ends_of = {body for pushes in joints[n] for body, _, _ in pushes}
        for body in ends_of:
            beside.setdefault(body, set()).update(ends_of)
    links = tuple(link for link in place.case.links if top.body_of[link] in beside)
    moving = 0
    for some in {frozenset(reached((body,), beside.__getitem__)) for body in beside}:
        own = {n for n in stressed if joints[n][0][0][0] in some}
        ways = sum(columns[column][0] in own for column in general.free)
        rank = sum(len(joints[n]) for n in own) - ways
        moving += ways if 3 * (len(some) - 1) > rank else 0
    return SelfStress(len(general.free), links, moving)


def _constraints(place: PlacedCase, bond: Bond) -> tuple[Triple, ...]:
    """The wrenches that keep two bodies from moving on each other."""
    if bond.freedom == 1 and bond.joint.pressure_angle is not None:
        position = Position(place.case, place.frame, place.points, place.arithmetic, {})
        try:
            (x, y), (fx, fy, _) = line_of_action(position, bond)
        except SceneError:  # which of the two is the wheel is not told
            pass
        else:
            return ((0.0 - fy, fx, x * fy - y * fx),)
    return transmitted(freedoms(bond, place.points, place.arithmetic))
