"""The given motion, and how it changes: twists of the links in real time, and the derivatives of these.

Each joint transmits wrenches w that do no work on the relative twist t of its two links: w . t = 0. The
derivative of that by time, w . t' = -w' . t, is linear in the rates t' of the twists, with the same
coefficients as the equilibrium of the links; w' follows from how the joint's own point or guide moves. The
rate of a twist is that of the velocity of the fixed point at the origin and of the angular velocity, so a
point p of the link has the acceleration velocity(t', p) + omega x v. (J. M. Rico Martinez, J. Duffy, Mech.
Mach. Theory 31, 1996.)
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations_with_replacement

from icsolve.assembly.workspace import PlacedCase
from icsolve.case import Joint, Motion, Number, Rope
from icsolve.case.joints import CentreAt, JointCentre, JointKind, Mesh, Radius, RadiusOfRow, Rolling
from icsolve.errors import SceneError, Status
from icsolve.kinematics.speeds import LOOSE, NO_SPEED, fastest, meant, path_of, speed_of
from icsolve.numbers import Scalar, all_vanish, decider, largest_of
from icsolve.numbers.linear import SPENT, General, Row, eliminate
from icsolve.numbers.tape import UNIT
from icsolve.screws import Point, Triple, add, blend, cross, pairing, subtract, velocity
from icsolve.screws.joints import centre_twist, freedoms, mesh_weights, rolling_centres, transmitted
from icsolve.screws.ropes import part_changes, rope_parts
from icsolve.structure import Bond, Topology
from icsolve.tuples import NamedTuple
from icsolve.wording import listed
from icsolve.wording.joints import why_no_acceleration

NEAR = 2e-3
"""Contacts as written may miss a motion by so much of the figure's size."""
GROWN = 1e4
"""By so much what contacts miss may grow in the elimination."""


Twists = Mapping[str, Triple]
"""By link."""


Drive = tuple[Motion, Point | None, Scalar]
"""A given motion, the direction of its point, the acceleration."""


class Moving(NamedTuple):
    """The given motion and its change.

    Attributes
    ----------
    twists : by link, (X, Y, W) [frame length/s, frame length/s, rad/s]
    rates : by link, its derivative by time [the same a second]
    open : links that a freedom moves which no given motion fixes
    """

    twists: Twists
    rates: Mapping[str, Triple]
    open: frozenset[str]

    @property
    def size(self) -> float:
        """What accelerations are summed from: beside it one may be zero."""
        turned = largest_of([x for t in self.twists.values() for x in t]) ** 2
        return max(turned, largest_of([x for t in self.rates.values() for x in t]))

    def acceleration(self, link: str, p: Point) -> Point:
        """Acceleration (ax, ay) [frame length/s^2] of the point p [frame] of a link: ``velocity(t', p) +
        omega x v``.
        """
        (x, y), (vx, vy) = velocity(self.rates[link], p), velocity(self.twists[link], p)
        omega = self.twists[link][2]
        return x - omega * vy, y + omega * vx


def moving(place: PlacedCase, motions: Mapping[str, Sequence[Triple]], slack: float = 0.0) -> Moving:
    """The motion that the case gives, with its accelerations.

    Parameters
    ----------
    place : the scene; given speeds in rad/s or case lengths a second
    motions : by link, one twist a freedom
    slack : by how much rolling contacts as written miss the motion [fraction of the figure's size]

    Raises
    ------
    SceneError
        Where no speed is given, where given motions contradict each other, where a joint does not tell how it
        moves on, and where the links move only for an instant.
    """
    case, top, arithmetic = place.case, place.top, place.arithmetic
    if not case.motion or any(given.speed is None for given in case.motion):
        raise SceneError(Status.MOBILITY, NO_SPEED)
    speed = speed_of(place, motions)
    twists: dict[str, Triple] = {}
    idle = set()
    for link in (link for link in motions if link in top.body_of):
        (x, y, w), *open_ = meant(motions, speed, link)
        twists[link] = (x / speed.divisor, y / speed.divisor, w / speed.divisor)
        size = LOOSE * largest_of([part for t in motions[link] for part in t])
        if not all_vanish(arithmetic, ((part, size) for t in open_ for part in t)):
            idle.add(link)
    moves = accelerated(place, twists, drives_of(place, motions), slack)
    return moves._replace(open=moves.open | idle)


def accelerated(place: PlacedCase, twists: Twists, drives: Sequence[Drive], slack: float = 0.0) -> Moving:
    """The motion in which the links have these twists, (3,) each as of `Moving`, and what is driven these
    accelerations. Raises SceneError as `moving`."""
    rates, loose = _rates(place, twists, drives, slack)
    return Moving(twists, {link: rates[place.top.body_of[link]] for link in twists}, frozenset(loose))


def drives_of(place: PlacedCase, motions: Mapping[str, Sequence[Triple]]) -> list[Drive]:
    """What each given motion accelerates: as its speed goes, faster where that is positive."""
    case, frame, points, arithmetic = place
    found: list[Drive] = []
    for given in case.motion:
        assert given.speed is not None
        more: Scalar = arithmetic.given(given.acceleration) if given.acceleration is not None else 0.0
        more = -more if given.speed.value < 0.0 else more
        if given.point is None:
            found.append((given, None, -more if given.turns == "cw" else more))
        else:
            along = path_of(given, motions[given.link], fastest(motions), points[given.point], arithmetic)
            found.append((given, along, more * frame.scale))
    return found


def rate_rows(place: PlacedCase, twists: Twists, drives: Sequence[Drive]) -> tuple[list[Row], list[float]]:
    """What the rates of the bodies' twists fulfil, three columns a body and the known part behind them, and
    the sizes of the known parts' terms."""
    top, known = place.top, 3 * len(place.top.members)
    rows: list[Row] = []
    sizes: list[float] = []
    for bond in top.bonds:
        relative = subtract(twists[bond.links[1]], twists[bond.links[0]])
        basis, change = freedoms(bond, place.points, place.arithmetic), _changes(place, twists, bond)
        told = zip(transmitted(basis), _transmitted_changes(basis, change), strict=True)
        for w, dw in _by_normal(place, bond.joint, tuple(told)) if isinstance(bond.joint, Rolling) else told:
            rows.append(_rate_condition(top, bond, w, pairing(dw, relative), known))
            sizes.append(sum(abs(a * b) for a, b in zip(dw, relative, strict=True)))
    for rope in top.ropes:
        row, moved = _roped(place, rope, twists)
        rows.append({**row, known: moved})
        sizes.append(abs(moved))
    for given, along, more in drives:
        rows.append(_driven(place, given, along, more, twists))
        sizes.append(abs(more))
    return rows, sizes


def goes_on(place: PlacedCase, twists: Twists) -> bool | None:
    """Whether the one motion that redundant joints leave extends to second order: there are accelerations.

    Where there are none the links yield only for an instant (R. Connelly, W. Whiteley, SIAM J. Discrete Math.
    9, 1996). None where a joint does not tell how it moves on. Raises MoreDigits of balls, where it is open.
    """
    try:
        return _solved(place, twists, (), 0.0)[1]
    except SceneError:
        return None


def go_on_together(place: PlacedCase, twists: Mapping[str, Sequence[Triple]]) -> bool | None:
    """Whether all of several motions, and all that are made of them, extend to second order: at a change
    point only some do. Each of the motions and each sum of two tells all, as the condition is quadratic.

    None where a joint does not tell how it moves on. Raises MoreDigits of balls, where it is open.
    """
    count = max(map(len, twists.values()))
    for k, n in combinations_with_replacement(range(count), 2):
        one = {link: own[k] if k == n else add(own[k], own[n]) for link, own in twists.items()}
        if not (on := goes_on(place, one)):
            return on
    return True


def _solved(place: PlacedCase, twists: Twists, drives: Sequence[Drive], slack: float) -> tuple[General, bool]:
    """The rates of all bodies' twists in general, and whether there are any."""
    arithmetic, known = place.arithmetic, 3 * len(place.top.members)
    rows, sizes = rate_rows(place, twists, drives)
    # contacts may happen to miss by less than their last bits let them: what follows does not
    near, largest = min(NEAR, GROWN * max(slack, UNIT)) if slack else 0.0, max(sizes, default=0.0)
    general = eliminate(rows, known, near or SPENT, None if slack else decider(arithmetic))
    rest = [left.get(known, 0.0) for left in general.left]
    fits = all(abs(float(a)) <= near * largest or arithmetic.vanishes(a, largest) for a in rest)
    return general, fits


def _rates(
    place: PlacedCase, twists: Twists, drives: Sequence[Drive], slack: float
) -> tuple[list[Triple], set[str]]:
    """The rate of each body's twist, and the links whose rate a freedom leaves open.

    Where written numbers all but fit the motion, so they do what follows from it.
    """
    top, arithmetic = place.top, place.arithmetic
    known = 3 * len(top.members)
    general, fits = _solved(place, twists, drives, slack)
    if not fits:
        raise SceneError(
            Status.CHANGE_POINT,
            "the links move only for an instant in this position (its joints do not fit together a moment "
            "later), so it has no accelerations. Take another position, or correct the figure"
            + ("; give the points of its rolling contacts with more digits." if slack else "."),
        )
    ground = 3 * top.ground
    found, idle = [], set()
    for body, links in enumerate(top.members):
        columns = [general.of(3 * body + n) for n in range(3)] if body != top.ground else [{}] * 3
        found.append(tuple(row.get(known, 0.0) for row in columns))
        loose = any(not arithmetic.vanishes(a, 1.0) for row in columns for c, a in row.items() if c < known)
        idle |= {*links} if loose and 3 * body != ground else set()
    return found, idle


def _rate_condition(top: Topology, bond: Bond, w: Triple, change: Scalar, known: int) -> Row:
    """``w . (rate of b - rate of a) + change = 0``."""
    row: Row = {known: change}
    for body, sign in ((bond.b, 1.0), (bond.a, -1.0)):
        if body != top.ground:
            for n, part in enumerate(w):
                row[3 * body + n] = sign * part
    return row


def _roped(place: PlacedCase, rope: Rope, twists: Twists) -> tuple[Row, Scalar]:
    """The condition that a rope goes on keeping its length, and what its turning parts make of it."""
    (_, frame, points, arithmetic), top = place, place.top
    row: Row = {}
    total: Scalar = 0.0
    centres = zip(rope.points, rope.points[1:], strict=False)
    for part, (p, q) in zip(rope_parts(rope, points, frame.scale, arithmetic), centres, strict=True):
        change = part_changes(part, points[p], twists, points[q])
        total = total + pairing(change, subtract(twists[part.links[1]], twists[part.links[0]]))
        for link, sign in zip(part.links, (-1.0, 1.0), strict=True):
            body = top.body_of[link]
            for n, a in enumerate(part.wrench if body != top.ground else ()):
                row[3 * body + n] = row.get(3 * body + n, 0.0) + sign * a
    return row, total


def _driven(place: PlacedCase, given: Motion, along: Point | None, more: Scalar, twists: Twists) -> Row:
    """The acceleration that a motion gives to its link, or to a point of it along its path."""
    first, known = 3 * place.top.body_of[given.link], 3 * len(place.top.members)
    if along is None or given.point is None:
        return {first + 2: 1.0, known: -more}
    p, (ux, uy) = place.points[given.point], along
    vx, vy = velocity(twists[given.link], p)
    turned = twists[given.link][2] * (uy * vx - ux * vy)
    return {first: -uy, first + 1: ux, first + 2: uy * p[0] - ux * p[1], known: turned - more}


def _transmitted_changes(basis: tuple[Triple, ...], change: tuple[Triple, ...]) -> tuple[Triple, ...]:
    """Rates of the wrenches that `transmitted` gives, from those of the basis twists."""
    if len(basis) == 2:
        return (add(cross(change[0], basis[1]), cross(basis[0], change[1])),)
    x, y, w = change[0]
    if type(basis[0][2]) is float and basis[0][2] == 0.0:
        return ((0.0, 0.0, 0.0), (y, -x, 0.0))
    return ((w, 0.0, -x), (0.0, w, -y))


def _changes(place: PlacedCase, twists: Twists, bond: Bond) -> tuple[Triple, ...]:
    """Rates of a bond's basis twists."""
    joint, (by, on) = bond.joint, bond.links
    if isinstance(joint, Mesh):
        p, q = mesh_weights(joint, place.arithmetic)
        a, b = (place.points[pivot] for pivot in bond.pivots)
        (ax, ay), (bx, by_) = velocity(twists[by], a), velocity(twists[on], b)
        return (p * ax + q * bx, p * ay + q * by_, 0.0), (ay - by_, bx - ax, 0.0)
    if isinstance(joint, Rolling):
        return (_rolled(place, twists, joint),)
    if joint.curvature is not None and joint.direction is not None:
        return _contact(place, twists, joint, joint.curvature, place.arithmetic.turn(joint.direction))
    return tuple(_change(place, twists, joint, centre) for centre in joint.centres)


def _change(place: PlacedCase, twists: Twists, joint: Joint, centre: JointCentre) -> Triple:
    """Rate of a basis twist whose centre a link carries."""
    if not centre.link:
        raise SceneError(Status.UNSUPPORTED, why_no_acceleration(joint))
    if isinstance(centre, CentreAt):
        return _moved(velocity(twists[centre.link], place.points[centre.point]))
    x, y, _ = centre_twist(centre, place.points, place.arithmetic)  # turns with its link
    omega = twists[centre.link][2]
    return -(omega * y), omega * x, 0.0


def _unknown(joint: JointKind, why: str) -> SceneError:
    what = "rolling" if isinstance(joint, Rolling) else "contact"
    message = f"the {what} of links {listed(joint.links)} has no acceleration: {why}."
    return SceneError(Status.UNSUPPORTED, message)


def _moved(v: Point) -> Triple:
    return (v[0], v[1], 0.0)


def _contact(
    place: PlacedCase, twists: Twists, joint: Joint, radii: tuple[Radius, ...], normal: Point
) -> tuple[Triple, ...]:
    """How the point and the normal of a contact move, by the radii r, s of curvature of the two links (None:
    straight).

    The centres of curvature C = P - r n and D = P + s n are points of the links whose distance stays for two
    derivatives. With t square to n, u the slip along t and w, o the links' rates, n turns at
    (u + s o + r w) / (r + s) and the point goes with the first link and on by (r u + r s (o - w)) / (r + s).
    A straight link is the limit of a large radius: each is a / b with b = 0 there.
    """
    assert joint.at is not None
    (one, two), p = joint.links, place.points[joint.at]
    (a, b), (c, d) = (_fraction(place, radius) for radius in radii)
    nx, ny = normal
    tx, ty = 0.0 - ny, nx
    (vx, vy), (ux, uy) = velocity(twists[one], p), velocity(twists[two], p)
    w, o = twists[one][2], twists[two][2]
    slip = (ux - vx) * tx + (uy - vy) * ty
    whole = a * d + b * c
    if not abs(whole) > 0.0:
        raise _unknown(joint, "it is one of two corners")
    turning = (b * d * slip + b * c * o + a * d * w) / whole
    on = (a * d * slip + a * c * (o - w)) / whole
    return (vx + on * tx, vy + on * ty, 0.0), (turning * tx, turning * ty, 0.0)


def _fraction(place: PlacedCase, radius: Radius) -> tuple[Scalar, Scalar]:
    """What a radius of curvature [frame] is the ratio of; the second is 0 where it is straight."""
    given, scale = place.arithmetic.given, place.frame.scale
    if radius is None:
        return 1.0, 0.0
    if isinstance(radius, RadiusOfRow):
        return given(radius.above) * scale, given(radius.below)
    return given(radius) * scale, 1.0


def _rolled(place: PlacedCase, twists: Twists, joint: Rolling) -> Triple:
    """How the contact of links that roll on each other moves: it keeps its place on the normal, beside the
    centre of a round link.

    The normal turns with the line of both centres, with a straight link, or by the radii where only one
    centre is a point of the figure. So what the links leave redundant stays so, however near the written
    radii are to the distances of the figure.
    """
    radii = joint.radii or ()
    if sum(radius.value for radius in radii) == 0.0:
        raise _unknown(joint, "one fills the other, and touches it everywhere. Correct the `radii`")
    (centre, twist), *other = ((place.points[p], twists[link]) for p, link in _wheels(place, joint))
    x, y = velocity(twist, centre)
    turning = _between(centre, (x, y), *other[0]) if other else _by_radii(place, twists, joint.links, radii)
    px, py = place.points[joint.at]
    return _moved((x - turning * (py - centre[1]), y + turning * (px - centre[0])))


def _wheels(place: PlacedCase, joint: Rolling) -> list[tuple[str, str]]:
    """The centres of the round links that are points of the figure, each with its link."""
    try:
        found = rolling_centres(joint, place.case, place.points, place.frame.scale)
    except LookupError as why:
        raise _unknown(joint, why.args[0]) from None
    return [(p, link) for p, link in zip(found, joint.links, strict=True) if p is not None]


def _by_normal(
    place: PlacedCase, joint: Rolling, wrenches: tuple[tuple[Triple, Triple], ...]
) -> Iterator[tuple[Triple, Triple]]:
    """The forces along x and y at a rolling contact, and their changes, as those along the normal and square
    to it: the first may only repeat what pins and guides say, and to few digits; the other alone tells how
    the links turn one another. The normal has the digits of the arithmetic: a double would bring its own."""
    centre, _ = _wheels(place, joint)[0]
    (x, y), (u, v) = place.points[centre], place.points[joint.at]
    nx, ny = u - x, v - y
    size = math.ldexp(1.0, math.frexp(largest_of((nx, ny)))[1])  # rounds nothing
    nx, ny = nx / size, ny / size
    (first, one), (second, two) = wrenches
    for c, s in ((nx, ny), (ny, -nx)):
        yield blend(c, first, s, second), blend(c, one, s, two)


def _between(centre: Point, v: Point, other: Point, twist: Triple) -> Scalar:
    """The rate at which the line from one centre to another turns."""
    (x, y), (u, w) = (other[0] - centre[0], other[1] - centre[1]), velocity(twist, other)
    return (x * (w - v[1]) - y * (u - v[0])) / (x * x + y * y)


def _by_radii(place: PlacedCase, twists: Twists, links: tuple[str, ...], radii: tuple[Number, ...]) -> Scalar:
    """The rate at which the normal turns where two links roll: ``(s o + r w) / (r + s)``, that of a straight
    link where one is."""
    (w, o), (r, s) = (twists[link][2] for link in links), radii
    if not r.value or not s.value:
        return o if not s.value else w
    a, b = place.arithmetic.given(r), place.arithmetic.given(s)
    return (b * o + a * w) / (a + b)
