"""What a joint leaves free and what it transmits: basis twists and wrenches, per joint kind.

Each basis twist is a homogeneous point: the relative centre of a joint with one freedom is that
point; with two freedoms it lies on the line that joins them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from itertools import product

from icsolve.case import Case, Guide, Joint
from icsolve.case.joints import CentreAt, CentreSquareTo, JointCentre, Mesh, Rolling
from icsolve.numbers import Arithmetic, Scalar
from icsolve.screws import Point, Triple, normal_twist, pin_twist, slide_twist, unit_between
from icsolve.structure import Bond, topology

Points = Mapping[str, Point]


def freedoms(bond: Bond, points: Points, arithmetic: Arithmetic) -> tuple[Triple, ...]:
    """Basis twists that the bond leaves to its two bodies.

    Parameters
    ----------
    bond : joint between two bodies, with the pivots of its links where it is a mesh
    points : by name, (x, y) [frame]; those of `points_of`
    arithmetic : of the points

    Returns
    -------
    tuple[Triple, ...]
        One (pin, slide) or two (slot, contact, mesh). Two span the line of possible relative centres.
    """
    _, _, _, joint, _, pivots, _ = bond
    return _mesh(bond, points, arithmetic) if pivots else joint_freedoms(joint, points, arithmetic)


def joint_freedoms(joint: Joint, points: Points, arithmetic: Arithmetic) -> tuple[Triple, ...]:
    """Basis twists of a joint that needs no pivots of its own links (any but a mesh), one or two."""
    return tuple([centre_twist(centre, points, arithmetic) for centre in joint.centres])


def centre_twist(centre: JointCentre, points: Points, arithmetic: Arithmetic) -> Triple:
    """Unit motion about a centre."""
    if isinstance(centre, CentreAt):
        return pin_twist(points[centre.point])
    if isinstance(centre, CentreSquareTo):
        return slide_twist(guide_direction(centre.guide, points, arithmetic))
    return normal_twist(arithmetic.turn(centre.direction))


def points_of(bond: Bond) -> tuple[str, ...]:
    """The points whose places the basis twists need."""
    return bond.pivots or joint_points(bond.joint)


def joint_points(joint: Joint) -> tuple[str, ...]:
    """The points whose places the basis twists of a joint need, without pivots."""
    return tuple(point for centre in joint.centres for point in _points(centre))


def _points(centre: JointCentre) -> tuple[str, ...]:
    if isinstance(centre, CentreAt):
        return (centre.point,)
    return centre.guide.ends or () if isinstance(centre, CentreSquareTo) else ()


OFF_RADIUS = 2e-3
"""The centre of a wheel may miss its radius by this fraction of it, and the line of the contact and the other
centre by this fraction of the figure."""


def circle_margin(centre: Point, contact: Point, radius: Scalar) -> Scalar:
    """Not negative where a centre is at its radius from where its link rolls; in any arithmetic."""
    x, y, square = contact[0] - centre[0], contact[1] - centre[1], radius * radius
    off = x * x + y * y - square
    return 4.0 * OFF_RADIUS**2 * square * square - off * off


def line_margins(
    centres: tuple[Point, Point], contact: Point, radii: tuple[Scalar, Scalar]
) -> tuple[Scalar, Scalar]:
    """Neither negative where the contact lies on the line of two centres, and as their radii say between or
    beyond them; in any arithmetic."""
    (px, py), (qx, qy), (x, y), (r, s) = *centres, contact, radii
    ax, ay, bx, by = x - px, y - py, qx - x, qy - y
    limit, off = OFF_RADIUS * (r * r + s * s), ax * by - ay * bx
    return limit * limit - off * off, (ax * bx + ay * by) * r * s


def at_radius(names: Iterable[str], contact: str, radius: float, points: Points) -> list[str]:
    """The points that may be the centre of a link that rolls: at its radius from where it touches, the
    nearest to it first.

    Parameters
    ----------
    names : points of the link; those without a place are left out
    radius : of either sign [frame]; at 0 there is none
    points : by name [frame]
    """
    r = abs(radius)
    placed = [p for p in names if p != contact and p in points]
    at = {p: (float(points[p][0]), float(points[p][1])) for p in (*placed, contact)}
    found = [p for p in placed if r and circle_margin(at[p], at[contact], r) >= 0.0]
    return sorted(found, key=lambda p: abs(math.dist(at[p], at[contact]) - r))


def carried_round(joint: Rolling, case: Case) -> list[list[str]]:
    """The points of each of two bodies that roll on each other, among which its centre is."""
    top = topology(case)
    bodies = (top.members[top.body_of[link]] for link in joint.links)
    return [list(dict.fromkeys(p for name in body for p in case.carries.get(name, ()))) for body in bodies]


def rolling_centres(
    joint: Rolling, case: Case, points: Points, scale: float
) -> tuple[str | None, str | None]:
    """The points of two links that roll on each other which are their centres: at their radii from where they
    touch; None of a straight link, and where only the other has one.

    Of two such points those most nearly in line with the contact; else a pin before others.

    Parameters
    ----------
    points : by name, as written [frame]
    scale : frame lengths a case length

    Raises
    ------
    LookupError
        With what would mend it, where the radii are not given or no one point can be the centre.
    """
    if joint.radii is None:
        raise LookupError("without `radii` nothing says how the contact moves on. Add them")
    if all(radius.value == 0.0 for radius in joint.radii):
        raise LookupError("both `radii` are 0, and straight links cannot roll on one another. Correct them")
    pins, sides = case.pivots(), list(zip(joint.links, joint.radii, strict=True))
    options = [
        at_radius(names, joint.at, radius.value * scale, points)
        for names, radius in zip(carried_round(joint, case), joint.radii, strict=True)
    ]
    one, two = options
    if one and two:
        pair = max(product(one, two), key=lambda pair: _in_line(joint, pair, points, scale))
        if _in_line(joint, pair, points, scale) < 0.0:
            raise LookupError(
                f"{' and '.join(pair)} lie at their radii from {joint.at}, and not in line with it, on two "
                "sides of it (on one where a radius is negative). Correct the radii or the points"
            )
        return pair
    for (link, _), found in zip(sides, options, strict=True):
        named = [name for name in found if name in pins] or found
        if len(named) > 1:
            raise LookupError(
                f"{' and '.join(named)} of link {link} both lie at its radius from {joint.at}, and nothing "
                "says which is the centre. Name the centre of the other link too, under `links`, or take one "
                "of them out"
            )
        if named:
            return (named[0], None) if found is one else (None, named[0])
    link, radius = next(side for side in sides if side[1].value != 0.0)
    off = f"no point of link {link} lies {abs(radius.value):g} from {joint.at}"
    raise LookupError(f"{off}. Name its centre, under `links`")


def _in_line(joint: Rolling, pair: tuple[str, str], points: Points, scale: float) -> float:
    """The least of `line_margins` of two named centres."""
    r, s = (radius.value * scale for radius in joint.radii or ())
    return float(min(line_margins((points[pair[0]], points[pair[1]]), points[joint.at], (r, s))))


def held_centres(joint: Rolling, case: Case) -> list[tuple[str | None, str | None]]:
    """The pins by which one further link carries two that roll on each other, where it carries both: these
    are their centres, for nothing else keeps them rolling. None of one that slides on it."""
    body_of, carried = topology(case).body_of, []
    for link in joint.links:
        on: dict[int, str | None] = {}
        for other in case.joints:
            bodies = {body_of[name] for name in other.links}
            if body_of[link] in bodies and (other.pivot is not None or other.keeps_direction):
                on |= dict.fromkeys(bodies - {body_of[link]}, other.pivot)
        carried.append(on)
    one, two = carried
    return [(one[c], two[c]) for c in one.keys() & two.keys() if one[c] or two[c]]


def guide_direction(guide: Guide, points: Points, arithmetic: Arithmetic) -> Point:
    """Unit vector (cos, sin) along a guide: of its angle, or from its first end to its second.

    Divides by zero (ZeroDivisionError in floats, nan in arrays) where both ends are at one place.
    """
    if guide.angle is not None:
        return arithmetic.turn(guide.angle)
    assert guide.ends is not None
    first, second = (points[end] for end in guide.ends)
    return unit_between(first, second, arithmetic)[0]


def mesh_weights(joint: Mesh, arithmetic: Arithmetic) -> tuple[float, float]:
    """Weights (p, q) of the pivots in the pitch point ``(p O_a + q O_b, p + q)``.

    Teeth or radii n_a, n_b: the pitch point divides the line of the pivots as n_a : n_b, inside for
    external gears and crossed belts (p + q = 1), outside for internal gears and open belts, at infinity where
    those are of one size (Kennedy's theorem: omega_a / omega_b is the inverse ratio of the distances to it).
    """
    a, b = (_size(arithmetic.given(n)) for n in joint.sizes)
    whole = a + b
    return (b / whole, -a / whole) if joint.turns_alike else (b / whole, a / whole)


def weights_of(bond: Bond, arithmetic: Arithmetic) -> tuple[float, float]:
    """The weights (p, q) of the pivots for the bond of a mesh, as in `mesh_weights`."""
    assert isinstance(bond.joint, Mesh)
    return mesh_weights(bond.joint, arithmetic)


def _size(n: float) -> float:
    return -n if n < 0 else n


def _mesh(bond: Bond, points: Points, arithmetic: Arithmetic) -> tuple[Triple, Triple]:
    """The pitch point and the point at infinity square to the line of the pivots."""
    p, q = weights_of(bond, arithmetic)
    (ax, ay), (bx, by) = (points[p] for p in bond.pivots)
    pitch = (p * ax + q * bx, p * ay + q * by, p + q)
    return pitch, (ay - by, bx - ax, 0.0)


def pitch_point(bond: Bond, points: Points, arithmetic: Arithmetic) -> Triple:
    """Relative centre of two gears or pulleys, (X, Y, W) [frame]; W = 0 where it is at infinity."""
    return _mesh(bond, points, arithmetic)[0]


def transmitted(basis: tuple[Triple, ...]) -> tuple[Triple, ...]:
    """Wrenches that a joint with these freedoms transmits: rows that vanish on its basis twists.

    Two freedoms leave the line that joins them. One freedom (X, Y, W) leaves two: for a finite centre
    the forces along x and y through it; for one at infinity the couple and the force square to the
    guide through the origin. A joint without friction does no work (reciprocity: R. S. Ball, A Treatise on
    the Theory of Screws, 1900).

    Parameters
    ----------
    basis : one or two basis twists

    Returns
    -------
    tuple[Triple, ...]
        Two wrenches or one, as (-Fy, Fx, M), not of unit size.
    """
    if len(basis) == 2:
        (x1, y1, w1), (x2, y2, w2) = basis
        return ((y1 * w2 - w1 * y2, w1 * x2 - x1 * w2, x1 * y2 - y1 * x2),)
    x, y, w = basis[0]
    if type(w) is float and w == 0.0:
        return ((0.0, 0.0, 1.0), (y, -x, 0.0))
    return ((w, 0.0, -x), (0.0, w, -y))
