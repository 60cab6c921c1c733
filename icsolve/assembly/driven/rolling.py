"""Rolling joints: where the centres of the two round links are, and which way the contact faces."""

from __future__ import annotations

import math
from collections.abc import Mapping

from icsolve.assembly.driven.constraints import (
    BodyLine,
    Constraint,
    OnLine,
    RolledRound,
    RolledStraight,
    SpotDistance,
)
from icsolve.assembly.driven.poses import Places, Spot, minus, plus, scaled, square
from icsolve.case.joints import Rolling
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import Scalar
from icsolve.screws.plane import Point
from icsolve.tuples import NamedTuple

NEAR = 2e-3
"""A centre may miss its radius by this fraction of it."""
ROUNDED = 1e-14
"""A distance that misses the given one by no more is the given one, rounded (normalised)."""

Sizes = tuple[float, float]


class RollingContact(NamedTuple):
    """Where two links touch: from the centre of the round one, along a flank's normal or toward the
    other centre."""

    centre: Spot
    radius: Scalar
    flank: BodyLine | None
    other: Spot | None
    whole: Scalar = 1.0

    def place(self, places: Places) -> Point:
        """The point of contact."""
        centre = places.place(self.centre)
        if self.flank is not None:
            along = places.vector(self.flank.body, self.flank.along)
            return minus(centre, scaled(self.radius, square(along)))
        assert self.other is not None
        share = self.radius / self.whole
        return plus(centre, scaled(share, minus(places.place(self.other), centre)))


class Rolled(NamedTuple):
    """A rolling joint: its conditions, its contact, and the places of centres that have no name."""

    constraints: tuple[Constraint, ...]
    contact: RollingContact
    centres: dict[str, Point]


class RollingSide(NamedTuple):
    """A link of a rolling joint: its body, its signed radius (normalised), the points it carries."""

    link: str
    body: int
    radius: Scalar
    points: tuple[str, ...]
    pins: frozenset[str]


def rolling(joint: Rolling, sides: tuple[RollingSide, RollingSide], ref: Mapping[str, Point]) -> Rolled:
    """The conditions of a rolling joint (``ref``: places as written).

    Raises SceneError where the radii are not given, or no point lies at a radius from the contact.
    """
    a, b = sides
    if joint.radii is None:
        raise _refusal(joint, "without `radii` nothing says how the contact moves on. Add them")
    if float(a.radius) == 0.0 and float(b.radius) == 0.0:
        raise _refusal(
            joint, "both `radii` are 0, and straight links cannot roll on one another. Correct them"
        )
    contact = ref[joint.at]
    found = _centres(joint, (a, b), ref)
    normal = _normal(joint, (a, b), found, ref)
    centres: dict[str, Point] = {}
    spots = []
    for side, name, sense in ((a, found[0], -1.0), (b, found[1], 1.0)):
        own = name or f"@centre of {side.link} on {joint.at}"
        if name is None:
            centres[own] = plus(contact, scaled(sense * side.radius, normal))
        spots.append((side.body, own))
    places = {**ref, **centres}
    if float(a.radius) == 0.0 or float(b.radius) == 0.0:
        return _on_flank(a, b, (spots[0], spots[1]), normal, contact, places, centres)
    return _on_round((a, b), (spots[0], spots[1]), centres)


def _on_flank(
    a: RollingSide,
    b: RollingSide,
    spots: tuple[Spot, Spot],
    normal: Point,
    contact: Point,
    places: Mapping[str, Point],
    centres: dict[str, Point],
) -> Rolled:
    """One of the two is straight: ``normal`` points from a into b."""
    first = float(b.radius) == 0.0
    side, centre, flank = (a, spots[0], b.body) if first else (b, spots[1], a.body)
    out = normal if first else (-normal[0], -normal[1])
    along = square(out)  # the centre is on its left: minus the outward normal is along turned by 90 degrees
    line = BodyLine(flank, contact, along)
    radius = side.radius if float(side.radius) > 0.0 else -side.radius
    away = minus(places[centre[1]], contact)
    offset = square(along)[0] * away[0] + square(along)[1] * away[1]
    if abs(float(offset) - float(radius)) <= ROUNDED:
        offset = radius
    kept = {name: place for name, place in centres.items() if name == centre[1]}
    conditions = (OnLine(centre, line, offset), RolledStraight(centre, line, radius))
    return Rolled(conditions, RollingContact(centre, offset, line, None), kept)


def _on_round(
    sides: tuple[RollingSide, RollingSide], spots: tuple[Spot, Spot], centres: dict[str, Point]
) -> Rolled:
    radii = (sides[0].radius, sides[1].radius)
    whole = radii[0] + radii[1]
    distance = whole if float(whole) > 0.0 else -whole
    conditions = (SpotDistance(*spots, distance), RolledRound(*spots, radii))
    return Rolled(conditions, RollingContact(spots[0], radii[0], None, spots[1], whole), centres)


def _centres(
    joint: Rolling, sides: tuple[RollingSide, RollingSide], ref: Mapping[str, Point]
) -> tuple[str | None, str | None]:
    """A point of each round link that lies at its radius from the contact; None where there is none."""
    at = ref[joint.at]
    one, two = (_options(side, joint.at, at, ref) for side in sides)
    if one and two:
        return min(((p, q) for p in one for q in two), key=lambda pair: _bend(at, ref[pair[0]], ref[pair[1]]))
    if one:
        return _only(joint, sides[0], one), None
    if two:
        return None, _only(joint, sides[1], two)
    assert joint.radii is not None
    link, radius = next((s.link, n) for s, n in zip(sides, joint.radii, strict=True) if n.value != 0.0)
    off = f"no point of link {link} lies {abs(radius.value):g} from {joint.at}"
    raise _refusal(joint, f"{off}. Name its centre, under `links`")


def _only(joint: Rolling, side: RollingSide, options: list[str]) -> str:
    """The one point that can be the centre; a pin before others."""
    named = [name for name in options if name in side.pins] or options
    if len(named) == 1:
        return named[0]
    raise _refusal(
        joint,
        f"{' and '.join(named)} of link {side.link} both lie at its radius from {joint.at}, and nothing says "
        "which is the centre. Name the centre of the other link too, under `links`, or take one of them out",
    )


def _options(side: RollingSide, contact: str, at: Point, ref: Mapping[str, Point]) -> list[str]:
    """The points of a link at its radius from the contact, the nearest to it first."""
    r = abs(float(side.radius))
    if r == 0.0:
        return []
    off = {
        name: abs(math.hypot(float(ref[name][0] - at[0]), float(ref[name][1] - at[1])) - r)
        for name in side.points
        if name != contact and name in ref
    }
    return sorted((name for name in off if off[name] <= NEAR * r), key=lambda name: off[name])


def _bend(at: Point, p: Point, q: Point) -> float:
    """How far two centres and the contact are from one line."""
    (ax, ay), (bx, by) = minus(p, at), minus(q, at)
    size = math.hypot(float(ax), float(ay)) * math.hypot(float(bx), float(by))
    return abs(float(ax * by - ay * bx)) / size


def _normal(
    joint: Rolling,
    sides: tuple[RollingSide, RollingSide],
    found: tuple[str | None, str | None],
    ref: Mapping[str, Point],
) -> Point:
    """Unit normal out of the first link into the second."""
    for side, name, sense in zip(sides, found, (-1.0, 1.0), strict=True):
        if name is not None:
            x, y = minus(ref[name], ref[joint.at])
            r = math.copysign(math.hypot(float(x), float(y)), float(side.radius))
            size = side.radius if abs(r - float(side.radius)) <= ROUNDED else r
            return (sense * x / size, sense * y / size)
    raise AssertionError(joint)


def _refusal(joint: Rolling, why: str) -> SceneError:
    what = f"the rolling of links {' and '.join(joint.links)} at {joint.at}"
    return SceneError(Status.UNSUPPORTED, f"{what} cannot be moved: {why}.")
