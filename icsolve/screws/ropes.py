"""A rope as a constraint of several links: its straight parts, and the wrench of its tension on each link.

A part runs from one circle (a pulley, a drum; of radius 0 a point) to the next, along a line that touches
both. With d from centre to centre, s the sense of a wrap (1 ccw) and a = s' r' - s r, the direction u and the
length l of the part follow from d = l u - a n, n = (u_y, -u_x), l^2 = d^2 - a^2. Where the centre of the
first is C, the line's moment about the origin is C x u + s r. The length of the rope stays where the sum of
u . (v' - v) over the parts is zero, with the velocities of points of the links on their lines: the tension
does no work.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from icsolve.case import Rope
from icsolve.errors import SceneError, Status
from icsolve.numbers import DEGREE, FLOATS, Arithmetic, Scalar, exponential
from icsolve.screws import Point, Triple, force_wrench, pairing, velocity
from icsolve.tuples import NamedTuple

TOUCHING = 5e-8
"""A rope that turns by less (degrees) on a pulley, in either sense, passes it: it does not go all round."""
MOST_GROWN = 300.0
"""Exponents of a pull beyond this leave no room for the loads beside it."""

Points = Mapping[str, Point]


class RopePart(NamedTuple):
    """A straight part of a rope.

    Attributes
    ----------
    links : those between which it runs (the second '' at a free end)
    at : where it leaves the first circle [frame]
    along : unit vector from there to the second
    length : [frame]
    wrench : what a unit of tension does on the first link, (-Fy, Fx, M); its opposite acts on the second
    offset : moment of the line about the centre of the first circle [frame]
    """

    links: tuple[str, str]
    at: Point
    along: Point
    length: Scalar
    wrench: Triple
    offset: Scalar


def rope_parts(rope: Rope, points: Points, scale: float, arithmetic: Arithmetic) -> tuple[RopePart, ...]:
    """The straight parts of a rope, from its first end to its last.

    Parameters
    ----------
    points : by name [frame]
    scale : frame lengths a case length, for the radii
    arithmetic : of the points

    Raises
    ------
    SceneError
        Where a part has no length, or two pulleys overlap.
    """
    circles = list(zip((points[p] for p in rope.points), offsets_of(rope, scale, arithmetic), strict=True))
    pairs = enumerate(pairwise(circles))
    return tuple(part_between(rope, k, one, two, scale, arithmetic) for k, (one, two) in pairs)


Circle = tuple[Point, Scalar]
"""Its centre; its radius, positive where a rope goes round it ccw (normalised)."""


HAS_SQUARE = (1e-145, 1e145)
"""Lengths whose squares are doubles of full precision."""


def part_between(
    rope: Rope, k: int, one: Circle, two: Circle, scale: float, arithmetic: Arithmetic
) -> RopePart:
    """The straight part of a rope from its circle ``k`` to the next."""
    ((ax, ay), offset), ((bx, by), next_offset) = one, two
    d = (bx - ax, by - ay)
    between = next_offset - offset
    apart = math.hypot(float(d[0]), float(d[1]))
    if apart <= abs(float(between)) or math.isinf(apart):
        raise SceneError(Status.INCONSISTENT, _no_part(rope, k, apart, scale))
    unit = 1.0 if HAS_SQUARE[0] < apart < HAS_SQUARE[1] else math.ldexp(1.0, math.frexp(apart)[1])
    if unit != 1.0:  # a power of two: this rounds nothing
        d, between = (d[0] / unit, d[1] / unit), between / unit
    square = d[0] * d[0] + d[1] * d[1]
    length = arithmetic.sqrt(square - between * between)
    u = (
        (length * d[0] + between * d[1]) / square,
        (length * d[1] - between * d[0]) / square,
    )
    if unit != 1.0:
        length = length * unit
    at = (ax + offset * u[1], ay - offset * u[0])
    x, y, moment = force_wrench(u, (ax, ay))
    links = (*rope.links, "")
    return RopePart((links[k], links[k + 1]), at, u, length, (x, y, moment + offset), offset)


def part_rooms(rope: Rope, points: Points, scale: float, arithmetic: Arithmetic) -> Iterator[Scalar]:
    """The squared lengths of straight parts beside a circle [frame^2]: where one is negative an end has come
    into its pulley, or two pulleys overlap."""
    circles = zip((points[p] for p in rope.points), offsets_of(rope, scale, arithmetic), strict=True)
    for ((ax, ay), offset), ((bx, by), next_offset) in pairwise(circles):
        x, y, between = bx - ax, by - ay, next_offset - offset
        if type(between) is not float or between:
            yield x * x + y * y - between * between


def offsets_of(rope: Rope, scale: float, arithmetic: Arithmetic) -> tuple[Scalar, ...]:
    """Radii of the circles, positive where the rope goes round ccw (normalised)."""
    sizes = [0.0 if radius is None else arithmetic.given(radius) * scale for radius in rope.radii]
    wraps = zip(sizes, rope.wraps, strict=True)
    return tuple(size if wrap != "cw" else 0.0 - size for size, wrap in wraps)


def _no_part(rope: Rope, k: int, apart: float, scale: float) -> str:
    a, b = rope.points[k : k + 2]
    if not apart * apart:
        return (
            f"the rope {rope.name} has no direction from {a} to {b}: they lie at one place. Correct the "
            "order of its points, or take one of them out; whole turns round one are given by `turns`."
        )
    return (
        f"the rope {rope.name} has no straight part from {a} to {b}: they are {apart / scale:.6g} apart, "
        "which is no more than their radii need. Correct the `radii` or the `wraps`, or put one of the "
        "points farther along the rope."
    )


def rope_length(
    rope: Rope, points: Points, scale: float, arithmetic: Arithmetic, without: str = ""
) -> Scalar:
    """Length along the centre line from the first end to the last, without the parts at a point.

    On a pulley it lies over the angle of its wrap; what is wound on a drum at an end does not count.
    """
    circles = zip(map(points.get, rope.points), offsets_of(rope, scale, arithmetic), strict=True)
    total: Scalar = 0.0
    before: RopePart | None = None
    for k, ((one, radius), (two, next_radius)) in enumerate(pairwise(circles)):
        part = None
        if without not in rope.points[k : k + 2]:
            assert one is not None
            assert two is not None
            part = part_between(rope, k, (one, radius), (two, next_radius), scale, arithmetic)
            total = total + part.length
        if before is not None and part is not None and rope.radii[k] is not None:
            size = radius if rope.wraps[k] == "ccw" else 0.0 - radius
            total = total + size * wrap_angle(rope, k, before, part, arithmetic)
        before = part
    return total


def lengthening(parts: tuple[RopePart, ...], twists: Mapping[str, Triple]) -> Scalar:
    """How fast the parts between links grow together, less what a free end's part gives away."""
    total: Scalar = 0.0
    for part in parts:
        total = total - pairing(part.wrench, twists[part.links[0]])
        if part.links[1]:
            total = total + pairing(part.wrench, twists[part.links[1]])
    return total


def end_twist(parts: tuple[RopePart, ...], twists: Mapping[str, Triple]) -> Triple:
    """The motion of a free end along its part, as the twist of a body that carries it."""
    speed = 0.0 - lengthening(parts, twists)
    x, y = parts[-1].along
    return (0.0 - speed * y, speed * x, 0.0)


def part_changes(part: RopePart, centre: Point, twists: Mapping[str, Triple], other: Point) -> Triple:
    """Rate of a part's wrench; ``centre`` and ``other`` are the centres of its two circles."""
    (vx, vy), (wx, wy) = (velocity(twists[q], p) for q, p in zip(part.links, (centre, other), strict=True))
    ux, uy = part.along
    turning = (ux * (wy - vy) - uy * (wx - vx)) / part.length
    du = (0.0 - turning * uy, turning * ux)
    moved = force_wrench((ux, uy), (vx, vy))[2]
    a, b, turned = force_wrench(du, centre)
    return (a, b, moved + turned)


def wrap_angle(
    rope: Rope, k: int, before: RopePart, after: RopePart, arithmetic: Arithmetic = FLOATS
) -> Scalar:
    """The angle (rad) over which a rope lies on a pulley between two parts: of one turn, and its `turns`."""
    (ax, ay), (bx, by) = before.along, after.along
    turned = arithmetic.angle(ax * bx + ay * by, ax * by - ay * bx)
    signed = turned if rope.wraps[k] == "ccw" else 0.0 - turned
    counted = getattr(arithmetic, "round_it", None)  # of a record whose numbers are typed anew
    round_it = counted(signed) if counted else signed + 360.0 if float(signed) < -TOUCHING else signed
    return (round_it + 360.0 * rope.whole_turns(k)) * arithmetic.ratio(DEGREE)


def slip_rates(parts: tuple[RopePart, ...], twists: Mapping[str, Triple]) -> tuple[Scalar, ...]:
    """How fast the rope runs on, toward its last end, over what it goes round between its parts."""
    speed = pairing(parts[0].wrench, twists[parts[0].links[0]])
    found = []
    for before, after in pairwise(parts):
        twist = twists[after.links[0]]
        found.append(speed - pairing(before.wrench, twist))
        speed = speed + pairing(after.wrench, twist) - pairing(before.wrench, twist)
    return tuple(found)


def tension_ratios(
    rope: Rope, parts: tuple[RopePart, ...], senses: Sequence[float], arithmetic: Arithmetic
) -> tuple[Scalar, ...]:
    """The tension of each part over that of the first, where the rope slips in these senses.

    The pull grows in the sense in which the rope runs on by exp(mu beta), with the angle of wrap beta
    (Euler's and Eytelwein's formula); sense 0: it does not slip there. Raises SceneError where no number
    holds that.
    """
    ratios: list[Scalar] = [1.0]
    for k, sense in enumerate(senses, start=1):
        mu = rope.mu[k]
        if mu is None or not sense:
            ratios.append(ratios[-1])
            continue
        angle = wrap_angle(rope, k, parts[k - 1], parts[k], arithmetic)
        exponent = sense * arithmetic.given(mu) * angle
        grown = float(exponent)
        if grown > MOST_GROWN:
            raise SceneError(
                Status.UNSUPPORTED,
                f"the rope {rope.name} slips at {rope.points[k]}, where its pull grows by exp({grown:.4g}): "
                "no number holds that. Look at its mu.",
            )
        ratios.append(ratios[-1] * exponential(exponent))
    return tuple(ratios)
