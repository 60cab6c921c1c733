"""A case as links that keep their shapes: which points and lines each carries, and what ties them.

Of rolling joints also where the centres of the two round links are, and which way the contact faces.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping

from icsolve.assembly.driven.constraints import (
    BodyLine,
    Constraint,
    Immovable,
    OnLine,
    RolledRound,
    RolledStraight,
    Roped,
    SpotDistance,
    Turning,
)
from icsolve.assembly.driven.poses import Places, Shape, Spot, WrittenPlaces, dot, minus, plus, scaled, square
from icsolve.assembly.steps import Figure
from icsolve.assembly.wheels import why_not_rolled
from icsolve.assembly.workspace import Frame, PlacedCase, Workspace
from icsolve.case import Case, Centroid, Guide, Joint, Rope, Toward
from icsolve.case.joints import CentreAt, Guided, Mesh, Rolling
from icsolve.errors import SceneError, Status
from icsolve.numbers import FLOATS, Scalar
from icsolve.numbers.record import Record
from icsolve.screws import Point
from icsolve.screws.joints import OFF_RADIUS, guide_direction, joint_freedoms, rolling_centres, transmitted
from icsolve.screws.ropes import offsets_of, rope_parts
from icsolve.structure import Bond, Topology, topology
from icsolve.structure.torn_points import owners_of_points
from icsolve.tuples import NamedTuple
from icsolve.wording.joints import why_not_moved

ROUNDED = 1e-14
"""A distance that misses the given one by no more is the given one, rounded (normalised)."""

Sizes = tuple[float, float]

Guides = Mapping[tuple[int, Spot], Point]


class RollingContact(NamedTuple):
    """Where two links touch: from the centre of the round one so far along a flank, or the way to the other
    centre, and so far to its left [of a flank: frame; else: shares of the way]."""

    centre: Spot
    flank: BodyLine | None
    other: Spot | None
    beside: Point

    def place(self, places: Places) -> Point:
        """The point of contact."""
        centre, (ahead, left) = places.place(self.centre), self.beside
        if self.flank is not None:
            way = places.vector(self.flank.body, self.flank.along)
        else:
            assert self.other is not None
            way = minus(places.place(self.other), centre)
        return plus(plus(centre, scaled(ahead, way)), scaled(left, square(way)))


class Rolled(NamedTuple):
    """A rolling joint: its conditions, its contact, and the places of centres that have no name."""

    constraints: tuple[Constraint, ...]
    contact: RollingContact
    centres: dict[str, Point]


class RollingSide(NamedTuple):
    """A link of a rolling joint: its body, its signed radius (normalised), the point that is its centre, and
    on which side of the contact that lies along the normal out of the first link: -1 of that, 1 of the other.
    """

    link: str
    body: int
    radius: Scalar
    centre: str | None
    side: float


def rolling(
    joint: Rolling, sides: tuple[RollingSide, RollingSide], ref: WrittenPlaces, guides: Guides
) -> Rolled:
    """The conditions of a rolling joint.

    Parameters
    ----------
    ref : places as written
    guides : where a body slides beside the pin of another, by both, the direction of its guide
    """
    contact, normal = ref[joint.at], _normal(joint, sides, ref)
    names = [side.centre or f"@centre of {side.link} on {joint.at}" for side in sides]
    centres = {
        name: plus(contact, scaled(side.side * side.radius, normal))
        for side, name in zip(sides, names, strict=True)
        if side.centre is None
    }
    one, two = ((side.body, name) for side, name in zip(sides, names, strict=True))
    flat = next((n for n, side in enumerate(sides) if float(side.radius) == 0.0), None)
    if flat is None:
        radii = (sides[0].radius, sides[1].radius)
        distance, beside = _apart(radii, contact, *(centres.get(name) or ref[name] for name in names))
        conditions = (SpotDistance(one, two, distance), RolledRound(one, two, radii))
        return Rolled(conditions, RollingContact(one, None, two, beside), centres)
    side, centre = sides[1 - flat], (one, two)[1 - flat]
    # the centre is on the left of the flank: minus the outward normal is along turned by 90 degrees
    at = centres[centre[1]] if centre[1] in centres else ref[centre[1]]
    guide = guides.get((sides[flat].body, centre))
    along = _as_guided(square(scaled(-side.side, normal)), guide, minus(contact, at))
    line = BodyLine(sides[flat].body, contact, along)
    radius = side.radius if float(side.radius) > 0.0 else -side.radius
    ahead, offset = dot(along, minus(contact, at)), dot(square(along), minus(at, contact))
    if abs(float(offset) - float(radius)) <= ROUNDED:
        offset = radius
    if abs(float(ahead)) <= ROUNDED:
        ahead = 0.0
    kept = {name: place for name, place in centres.items() if name == centre[1]}
    rolls = (OnLine(centre, line, offset), RolledStraight(centre, line, radius))
    return Rolled(rolls, RollingContact(centre, line, None, (ahead, -offset)), kept)


def _apart(radii: tuple[Scalar, Scalar], contact: Point, centre: Point, other: Point) -> tuple[Scalar, Point]:
    """How far apart the centres of two round links are, and where beside the way from one to the other they
    touch: by their radii, or as written where these fit to few digits only."""
    whole = radii[0] + radii[1]
    if not float(whole):
        return whole, (0.0, 0.0)
    distance, ahead = whole if float(whole) > 0.0 else -whole, radii[0] / whole
    (x, y), (u, v) = ((float(a), float(b)) for a, b in (minus(other, centre), minus(contact, centre)))
    apart, square_of = math.hypot(x, y), x * x + y * y
    written, left = (u * x + v * y) / square_of, (v * x - u * y) / square_of
    if max(abs(apart - float(distance)), abs(written - float(ahead)), abs(left)) <= ROUNDED:
        return distance, (ahead, 0.0)
    return apart, (written, left)


def _as_guided(along: Point, guide: Point | None, contact: Point) -> Point:
    """The direction of a flank: that of the guide on which it slides past the wheel, where the contact (seen
    from the centre) misses it by no more than contacts as written may."""
    if guide is None or abs(float(dot(guide, contact))) > OFF_RADIUS:
        return along
    return guide if float(dot(along, guide)) > 0.0 else scaled(-1.0, guide)


def _normal(joint: Rolling, sides: Iterable[RollingSide], ref: Mapping[str, Point]) -> Point:
    """Unit normal out of the first link into the second."""
    for side in sides:
        if side.centre is not None:
            x, y = minus(ref[side.centre], ref[joint.at])
            r = math.copysign(math.hypot(float(x), float(y)), float(side.radius))
            size = side.radius if abs(r - float(side.radius)) <= ROUNDED else r
            return (side.side * x / size, side.side * y / size)
    raise AssertionError(joint)


class Mechanism(NamedTuple):
    """A case as links that keep their shapes, and their conditions.

    Attributes
    ----------
    frame, shape : scale of the frame, and the places as written in it
    spots : by body, the points that it carries
    owners : by point, the spot that its name stands for
    constraints : what ties the bodies, but for pins
    lines : by a slide's or slot's place among the joints, its guide as its body carries it
    contacts : by point, the rolling contacts
    """

    case: Case
    top: Topology
    frame: Frame
    shape: Shape
    spots: dict[int, list[Spot]]
    owners: dict[str, Spot]
    constraints: list[Constraint]
    lines: dict[int, BodyLine]
    contacts: dict[str, RollingContact]


def placed_late(figure: Figure, case: Case, record: Record) -> Callable[[str], Point]:
    """The points of a figure as written, on the record: one by its name is placed, with those that come
    before it, when it is asked for, whatever varies by then."""
    workspace, steps = Workspace(case, figure.frame, record), iter(figure.steps)

    def point(name: str) -> Point:
        varied, record.vary = record.vary, {}
        try:
            while name not in workspace.points:
                next(steps).place(workspace)
        finally:
            record.vary = varied
        return workspace.points[name]

    return point


def mechanism(
    case: Case,
    frame: Frame,
    record: Record,
    written: Mapping[str, Point],
    late: Callable[[str], Point] | None = None,
) -> Mechanism:
    """The mechanism of a case in the position as written.

    Parameters
    ----------
    case : the case
    frame : scale of the frame
    record : on which a motion will be written
    written : by name, places as written [frame]
    late : what works one out on the record, where it is needed there; None where ``written`` has that

    A joint that is known as written only becomes an `Immovable`, with the reason: it is refused by whoever
    moves it.
    """
    top, places = topology(case), WrittenPlaces(written, late or written.__getitem__)
    spots = _spots(case, top, written)
    joined = _joined(case, top)
    shape = Shape(record, places, joined, _spans(case, frame, record, places.still), top.ground)
    lines = {
        i: _line(joint.guide, joint.at, top.body_of[joint.links[1]], places, record)
        for i, joint in enumerate(case.joints)
        if isinstance(joint, Guided)
    }
    guides = _guides_beside(case, top, lines)
    constraints: list[Constraint] = []
    contacts: dict[str, RollingContact] = {}
    for i, joint in enumerate(case.joints):
        if isinstance(joint, Rolling):
            try:
                found = rolling(
                    joint, _sides(joint, PlacedCase(case, frame, places.still, record)), places, guides
                )
            except SceneError as unknown:
                constraints += _immovable(joint, top, places.still, unknown)
                continue
            for name, at in found.centres.items():
                places.add(name, at)
            _carry(spots, found.constraints)
            constraints += found.constraints
            contacts[joint.at] = found.contact
        elif not joint.stays_known:
            refusal = SceneError(Status.UNSUPPORTED, why_not_moved(joint))
            constraints += _immovable(joint, top, places.still, refusal)
        else:
            constraints += _conditions(joint, lines.get(i), shape, top.body_of)
    constraints += [_meshed(bond, record) for bond in top.bonds if bond.pivots]
    constraints += [_roped(rope, top, frame, record, places) for rope in top.ropes]
    _base(spots, lines.values(), places)
    owners = _owners(case, top, spots, contacts)
    return Mechanism(case, top, frame, shape, spots, owners, constraints, lines, contacts)


def _guides_beside(case: Case, top: Topology, lines: Mapping[int, BodyLine]) -> dict[tuple[int, Spot], Point]:
    """Where a body slides on one that bears the pin of a third: its guide's direction, by it and that pin."""
    found: dict[tuple[int, Spot], Point] = {}
    for i, line in lines.items():
        joint = case.joints[i]
        one, two = (top.body_of[link] for link in joint.links)
        for slider, bearer in ((one, two), (two, one)) if joint.keeps_direction else ():
            for pin in case.joints:
                bodies = {top.body_of[link] for link in pin.links} if pin.pivot is not None else set()
                if pin.pivot is not None and bearer in bodies:
                    found |= {(slider, (body, pin.pivot)): line.along for body in bodies - {slider}}
    return found


def _roped(rope: Rope, top: Topology, frame: Frame, record: Record, ref: Mapping[str, Point]) -> Roped:
    """A rope that is fixed at both ends."""
    offsets = offsets_of(rope, frame.scale, record)
    written = rope_parts(rope, ref, frame.scale, record)
    spots = tuple((top.body_of[link], p) for link, p in zip(rope.links, rope.points, strict=True))
    return Roped(rope, spots, offsets, written, frame.scale)


def _immovable(
    joint: Joint, top: Topology, still: Mapping[str, Point], refusal: SceneError
) -> Iterator[Immovable]:
    """What such a joint transmits in the position as written."""
    ends = (top.body_of[joint.links[0]], top.body_of[joint.links[1]])
    if ends[0] != ends[1]:
        for wrench in transmitted(joint_freedoms(joint, still, FLOATS)):
            yield Immovable(ends, wrench, refusal)


def _spots(case: Case, top: Topology, ref: Mapping[str, Point]) -> dict[int, list[Spot]]:
    """The points of each body, in order of mention; points that no link carries go to one by inference."""
    found: dict[int, dict[Spot, None]] = {body: {} for body in range(len(top.members))}
    for link in case.links:
        for name in case.carries.get(link, ()):
            if name in ref:
                found[top.body_of[link]][top.body_of[link], name] = None
    told = {name for spots in found.values() for _, name in spots} | case.left_out
    told |= {rope.points[-1] for rope in case.ropes if rope.is_free}
    for name in ref:
        if name not in told:
            body = _inferred(case, name, found, top)
            if body is not None:
                found[body][body, name] = None
    return {body: list(spots) for body, spots in found.items()}


def _inferred(case: Case, name: str, spots: Mapping[int, Iterable[Spot]], top: Topology) -> int | None:
    """The body that a point belongs to which no link is said to carry: the one that takes the opposite of a
    force toward it, or that carries all the points to which its data tie it; the frame where nothing
    does (None: a centroid, or torn)."""
    if isinstance(case.points.get(name), Centroid) or any(
        isinstance(joint, Rolling) and joint.at == name for joint in case.joints
    ):
        return None
    for load in case.loads:
        heading, against = getattr(load, "heading", None), getattr(load, "against", None)
        if isinstance(heading, Toward) and heading.point == name and against is not None:
            return top.body_of[against]
    tied: set[str] = set()
    for datum in (*case.lengths, *case.angles):
        names = {getattr(datum, key) for key in ("a", "at", "b") if hasattr(datum, key)}
        if name in names:
            tied |= names - {name}
    if name in case.points or not tied:
        return top.ground
    bodies = [body for body, carried in spots.items() if tied <= {own for _, own in carried}]
    return bodies[0] if bodies else None


def _joined(case: Case, top: Topology) -> dict[Spot, Spot]:
    """For each pinned spot the one that stands for its pin; the frame's where it has one."""
    groups: list[tuple[str, set[int]]] = []
    for joint in case.joints:
        if joint.pivot is not None:
            bodies = {top.body_of[link] for link in joint.links}
            for group in [g for g in groups if g[0] == joint.pivot and g[1] & bodies]:
                groups.remove(group)
                bodies |= group[1]
            groups.append((joint.pivot, bodies))
    joined: dict[Spot, Spot] = {}
    for name, bodies in groups:
        first = top.ground if top.ground in bodies else min(bodies)
        joined.update({(body, name): (first, name) for body in bodies})
    return joined


def _spans(
    case: Case, frame: Frame, record: Record, ref: Mapping[str, Point]
) -> dict[frozenset[str], Scalar]:
    """The lengths that the case gives, where the figure has them to rounding."""
    spans: dict[frozenset[str], Scalar] = {}
    for length in case.lengths:
        if length.a in ref and length.b in ref:
            x, y = minus(ref[length.b], ref[length.a])
            value = record.given(length.value) * frame.scale
            if abs(abs(complex(float(x), float(y))) - float(value)) <= ROUNDED:
                spans[frozenset((length.a, length.b))] = value
    return spans


def _line(guide: Guide, at: str, body: int, ref: WrittenPlaces, record: Record) -> BodyLine:
    """The guide's line: through its own point, or through the joint's where that misses it."""
    along = guide_direction(guide, ref, record)
    name = guide.through or (guide.ends[0] if guide.ends else at)
    off = dot(square((float(along[0]), float(along[1]))), minus(ref.still[at], ref.still[name]))
    return BodyLine(body, ref[name] if abs(off) <= ROUNDED else ref[at], along)


def _conditions(
    joint: Joint, line: BodyLine | None, shape: Shape, body_of: Mapping[str, int]
) -> Iterator[Constraint]:
    """What the centres that span a joint's freedoms say of its links as they move; of a pin nothing, which is
    one spot of several bodies."""
    one, two = (body_of[link] for link in joint.links[:2])
    if one == two:
        return
    if line is not None and joint.at is not None:
        yield OnLine((one, joint.at), line)
    if joint.keeps_direction:
        yield Turning(((one, 1.0), (two, -1.0)))
    match joint.centres:
        case (CentreAt(a, carrier), CentreAt(b, other)):
            ends = (body_of[carrier], a), (body_of[other], b)
            yield SpotDistance(*ends, shape.span(*ends))


def _sides(joint: Rolling, place: PlacedCase) -> tuple[RollingSide, RollingSide]:
    """Both links.

    Raises SceneError where the radii are not given, and where no point lies at one from the contact.
    """
    try:
        found = rolling_centres(joint, place.case, place.points, place.frame.scale)
    except LookupError as why:
        raise SceneError(Status.UNSUPPORTED, why_not_rolled(joint, why)) from None
    given, scale = place.arithmetic.given, place.frame.scale
    one, two = (
        RollingSide(link, place.top.body_of[link], given(radius) * scale, centre, side)
        for link, radius, centre, side in zip(joint.links, joint.radii or (), found, (-1.0, 1.0), strict=True)
    )
    return one, two


def _carry(spots: dict[int, list[Spot]], constraints: Iterable[Constraint]) -> None:
    """The centres of rolling links become spots of theirs."""
    for c in constraints:
        for spot in (getattr(c, key, None) for key in ("centre", "one", "two")):
            if spot is not None and spot not in spots[spot[0]]:
                spots[spot[0]].append(spot)


def _meshed(bond: Bond, record: Record) -> Turning:
    """Two gears or pulleys seen from their carrier: ``n_a (w_a - w_c) = -+ n_b (w_b - w_c)``."""
    joint = bond.joint
    assert isinstance(joint, Mesh)
    a, b = (record.given(n) for n in joint.sizes)
    a, b = (-n if float(n) < 0.0 else n for n in (a, b))
    b = -b if joint.turns_alike else b
    return Turning(((bond.a, a), (bond.b, b), (bond.carrier, -(a + b))))


def _base(spots: dict[int, list[Spot]], lines: Iterable[BodyLine], ref: WrittenPlaces) -> None:
    """A body that carries no point has one of its own: on a guide of its, else at the origin."""
    for line in lines:
        if not spots[line.body]:
            _add_base(spots, line.body, line.through, ref)
    for body, own in spots.items():
        if not own:
            _add_base(spots, body, (0.0, 0.0), ref)


def _add_base(spots: dict[int, list[Spot]], body: int, at: Point, ref: WrittenPlaces) -> None:
    name = f"@base {body}"
    ref.add(name, at)
    spots[body].append((body, name))


def _owners(
    case: Case, top: Topology, spots: Mapping[int, list[Spot]], contacts: Mapping[str, RollingContact]
) -> dict[str, Spot]:
    """The spot that a name stands for: a pin's, the first link's of a slide or slot, a carrier's."""
    owners: dict[str, Spot] = {}
    lost = {*contacts, *(name for name, link in case.taken_along.items() if not link)}
    for name, link in owners_of_points(case).items():
        spot = (top.body_of[link], name) if link in top.body_of else None
        if spot is not None and name not in lost and spot in spots[spot[0]]:
            owners[name] = spot
    for carried in spots.values():
        for spot in carried:
            if spot[1] not in lost:
                owners.setdefault(spot[1], spot)
    return owners
