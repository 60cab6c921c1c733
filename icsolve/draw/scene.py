"""What a drawing is made from: a known scene in a view, with its round things and straight edges.

Gear wheels, pulleys, rolling wheels, cams and racks are found in case units; rooms of a drawing add `Part`s.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

from icsolve.case import Case, Joint, Spring
from icsolve.case.joints import Guided, Mesh, Rolling, Sliding
from icsolve.case.profiles import Circle, Flat, Knife, Roller, points_of
from icsolve.draw.marks import Box, Mark, MarkGroup, Point, View, along
from icsolve.draw.place import Label, Placer, Soft
from icsolve.errors import SceneError
from icsolve.numbers import FLOATS, turn_of
from icsolve.report.derivation.known import Known
from icsolve.screws.joints import guide_direction, mesh_weights
from icsolve.structure import Bond, topology
from icsolve.tuples import NamedTuple

NEAR = 0.02
"""A point is a wheel's centre where it is so near, of the radius, to that distance from the contact."""


class Wheel(NamedTuple):
    """A circle that belongs to a link; ``rim`` where its teeth are inside (an annulus)."""

    link: str
    centre: Point
    radius: float
    kind: str
    rim: bool = False


class Edge(NamedTuple):
    """A straight edge of a link through ``at``; the other body lies on the side of ``normal``."""

    link: str
    at: Point
    normal: Point


class BeltLoop(NamedTuple):
    """A belt over two wheels."""

    first: Wheel
    second: Wheel
    crossed: bool


class Ratchet(NamedTuple):
    """A toothed wheel about ``centre`` that pushes a pawl on a pin at ``pivot``: by the face of a tooth at
    ``at``, along the unit vector ``push``. Case units."""

    wheel: str
    centre: Point
    pawl: str
    pivot: Point
    at: Point
    push: Point


class Round(NamedTuple):
    """All of them in one mechanism; ``cams`` are contacts whose first link has no circle to draw, ``feet``
    the points with which links stand on the frame."""

    wheels: tuple[Wheel, ...]
    edges: tuple[Edge, ...]
    loops: tuple[BeltLoop, ...]
    cams: tuple[Sliding, ...]
    feet: tuple[tuple[str, str], ...] = ()
    ratchets: tuple[Ratchet, ...] = ()


def round_things(case: Case, points: Mapping[str, Point]) -> Round:
    """The wheels, edges, belts and cams whose places are known."""
    things: list[Wheel | Edge] = []
    loops: list[BeltLoop] = []
    cams: list[Sliding] = []
    feet: list[tuple[str, str]] = []
    ratchets: list[Ratchet] = []
    for bond in _meshes(case):
        if set(bond.pivots) <= set(points):
            both = _mesh(bond, points)
            things += both
            if isinstance(bond.joint, Mesh) and bond.joint.pulls:
                loops.append(BeltLoop(both[0], both[1], not bond.joint.turns_alike))
    for joint in case.joints:
        if isinstance(joint, Rolling) and joint.at in points:
            things += _rolled(case, joint, points)
        if isinstance(joint, Sliding) and joint.only_pushes and joint.at in points:
            if case.profiles is not None and {*joint.links} <= case.profiles.shapes.keys():
                things += surfaces(case, joint, points)
                continue
            ratchet = _ratchet(case, joint, points)
            if ratchet is not None:
                ratchets.append(ratchet)
                continue
            first, second = _touching(case, joint, points)
            if case.ground in joint.links and not isinstance(first, Wheel) and not isinstance(second, Wheel):
                feet += [(link, joint.at) for link in joint.links if link != case.ground]
                n = normal_of(joint)
                out = 1.0 if joint.links[0] == case.ground else -1.0
                things.append(Edge(case.ground, points[joint.at], (out * n[0], out * n[1])))
                continue
            things += [second] if first is None else [first, second]
            cams += [joint] if first is None else []
    things += _drums(case, points)
    wheels = _once([thing for thing in things if isinstance(thing, Wheel)])
    edges = tuple(thing for thing in things if isinstance(thing, Edge))
    return Round(tuple(wheels), edges, tuple(loops), tuple(cams), tuple(feet), tuple(ratchets))


def _drums(case: Case, points: Mapping[str, Point]) -> Iterable[Wheel]:
    """What ropes are wound on or slip on: wheels of links, posts of the frame."""
    for rope in case.ropes:
        for k, (p, link) in enumerate(zip(rope.points, rope.links, strict=False)):
            radius = rope.radii[k]
            held = k in (0, len(rope.points) - 1) or rope.mu[k] is not None
            if radius is not None and held and p in points:
                yield Wheel(link, points[p], radius.value, "post" if link == case.ground else "pulley")


def _once(wheels: Sequence[Wheel]) -> Iterable[Wheel]:
    """Each circle once (a gear may mesh with several)."""
    seen: dict[tuple[str, float, float, float], Wheel] = {}
    fine = 1e6 / (max((wheel.radius for wheel in wheels), default=0.0) or 1.0)
    for wheel in wheels:
        x, y, radius = (float(f"{size * fine:.0f}") for size in (*wheel.centre, wheel.radius))
        seen.setdefault((wheel.link, x, y, radius), wheel)
    return seen.values()


def _meshes(case: Case) -> Iterable[Bond]:
    if not any(isinstance(joint, Mesh) for joint in case.joints):
        return ()
    try:
        bonds = topology(case).bonds
    except SceneError:
        return ()
    return (bond for bond in bonds if isinstance(bond.joint, Mesh))


def _mesh(bond: Bond, points: Mapping[str, Point]) -> tuple[Wheel, ...]:
    """The two pitch circles, or the two pulleys."""
    joint = bond.joint
    assert isinstance(joint, Mesh)
    a, b = (points[p] for p in bond.pivots)
    if joint.pulls:
        radii = tuple(abs(r.value) for r in joint.sizes)
    else:
        p, q = mesh_weights(joint, FLOATS)
        span, whole = math.dist(a, b), abs(p + q)
        radii = (abs(q) * span / whole, abs(p) * span / whole) if whole > 1e-9 else (0.0, 0.0)
    rims = tuple(n.value < 0 and not joint.pulls for n in joint.sizes)
    kind = "pulley" if joint.pulls else "gear"
    both = zip(bond.links, (a, b), radii, rims, strict=True)
    return tuple(Wheel(link, centre, radius, kind, rim) for link, centre, radius, rim in both)


def _rolled(case: Case, joint: Rolling, points: Mapping[str, Point]) -> list[Wheel | Edge]:
    """Wheels, and edges for the straight ones."""
    at = points[joint.at]
    radii: tuple[float | None, ...] = (None, None)
    if joint.radii is not None:
        radii = tuple(r.value for r in joint.radii)
    wheels = [_wheel(case, link, at, r, points) for link, r in zip(joint.links, radii, strict=True)]
    found: list[Wheel | Edge] = [wheel for wheel in wheels if wheel is not None]
    for n, link in enumerate(joint.links):
        other = wheels[1 - n]
        if wheels[n] is None and other is not None:
            gap = math.dist(other.centre, at) or 1.0
            normal = ((other.centre[0] - at[0]) / gap, (other.centre[1] - at[1]) / gap)
            found.append(Edge(link, at, normal))
    return found


def _wheel(
    case: Case, link: str, at: Point, radius: float | None, points: Mapping[str, Point]
) -> Wheel | None:
    """The circle of a link that rolls at a point; None for a straight one, and where no centre is known."""
    if radius == 0.0 or (radius is None and (link == case.ground or _slides(case, link))):
        return None
    pins = [p for p in case.pivots(link) if p in points]
    if radius is None:
        rolls = any(isinstance(j, Rolling) and {link, case.ground} == {*j.links} for j in case.joints)
        own = [p for p in case.carries.get(link, ()) if p in points and points[p] != at] if rolls else []
        own.sort(key=lambda p: abs(points[p][0] - at[0]) / math.dist(points[p], at))  # most upright ground
        found = [points[p] for p in (*pins, *own) if math.dist(points[p], at) > 0.0]
        return Wheel(link, found[0], math.dist(found[0], at), "roll") if found else None
    size = abs(radius)
    near = [*pins, *case.carries.get(link, ()), *points]
    for p in near:
        if p in points and abs(math.dist(points[p], at) - size) <= NEAR * size:
            return Wheel(link, points[p], size, "roll", radius < 0.0)
    return None


def _slides(case: Case, link: str) -> bool:
    """Whether a link slides along the frame, and so does not turn."""
    return any(j.keeps_direction and {link, case.ground} == {*j.links} for j in case.joints)


def _touching(
    case: Case, joint: Sliding, points: Mapping[str, Point]
) -> tuple[Wheel | Edge | None, Wheel | Edge]:
    """The two surfaces of a contact: circles where centres are known, else edges; None: a cam to invent."""
    at, n = points[joint.at], normal_of(joint)
    back = (-n[0], -n[1])
    first = _disc(case, joint.links[0], at, back, points, free=True)
    second = _disc(case, joint.links[1], at, n, points, free=False)
    if first is None and joint.links[0] == case.ground:
        return Edge(joint.links[0], at, n), second or Edge(joint.links[1], at, back)
    return first, second or Edge(joint.links[1], at, back)


PAWL, RATCHET = re.compile(r"pawl|click", re.IGNORECASE), re.compile(r"ratchet", re.IGNORECASE)
"""What links of a ratchet are called; no geometry tells them from a lever on a drum."""


def _ratchet(case: Case, joint: Sliding, points: Mapping[str, Point]) -> Ratchet | None:
    """A contact of a ratchet wheel and its pawl, as the names of its links say, or the title: the pawl is
    then the link whose pin the force goes by the nearer."""
    at, (x, y) = points[joint.at], normal_of(joint)
    told = [*joint.links, case.title or ""]
    pins = [[points[p] for p in case.pivots(link) if points.get(p, at) != at] for link in joint.links]
    if not all(pins) or not any(word.search(name) for word in (PAWL, RATCHET) for name in told):
        return None
    one, two = (some[0] for some in pins)
    sines = [abs((px - at[0]) * y - (py - at[1]) * x) / math.dist((px, py), at) for px, py in (one, two)]
    named = [bool(PAWL.search(link)) - bool(RATCHET.search(link)) for link in joint.links]
    second = named[1] > named[0] if named[0] != named[1] else sines[1] < sines[0]
    (a, b), push = joint.links, (x, y) if second else (-x, -y)
    return Ratchet(a, one, b, two, at, push) if second else Ratchet(b, two, a, one, at, push)


def _disc(
    case: Case, link: str, at: Point, side: Point, points: Mapping[str, Point], *, free: bool
) -> Wheel | None:
    """A circle about a point of the common normal on the link's side: a pin of it, a point in which the
    normals of all its contacts meet, or a point of no link."""
    pins = [*case.pivots(link), *_hubs(case, link, points)]
    owned = {p for ps in case.carries.values() for p in ps} | {getattr(j, "at", None) for j in case.joints}
    loose = [p for p in points if p not in owned] if free else []
    for name in (*loose, *pins):
        if name not in points:
            continue
        dx, dy = points[name][0] - at[0], points[name][1] - at[1]
        gap = dx * side[0] + dy * side[1]
        if gap > 0.0 and abs(dx * side[1] - dy * side[0]) <= 0.01 * gap:
            return Wheel(link, points[name], math.hypot(dx, dy), "cam")
    return None


def _hubs(case: Case, link: str, points: Mapping[str, Point]) -> Iterable[str]:
    """The points of a link from which all its contacts, two or more, are as far and along their normals."""
    touching = [j for j in case.joints if isinstance(j, Sliding) and j.only_pushes and link in j.links]
    both = [(points[j.at], normal_of(j)) for j in touching if j.at in points]
    for name in case.carries.get(link, ()) if len(both) == len(touching) > 1 else ():
        if name not in points:
            continue
        gaps = [(points[name][0] - x, points[name][1] - y) for (x, y), _ in both]
        radius = math.hypot(*gaps[0])
        alike = all(abs(math.hypot(*gap) - radius) <= NEAR * radius for gap in gaps)
        normals = zip(gaps, (n for _, n in both), strict=True)
        if radius and alike and all(abs(x * b - y * a) <= 0.01 * radius for (x, y), (a, b) in normals):
            yield name


class Geneva(NamedTuple):
    """A Geneva wheel with its crank's pin in one of its slots, case units: the distance of the pivots, and
    the crank's arm, which is square to a slot as its pin enters it."""

    centre: Point
    pin: Point
    slots: int
    reach: float
    arm: float

    @property
    def radius(self) -> float:
        """To where its slots end."""
        return math.sqrt(self.reach - self.arm) * math.sqrt(self.reach + self.arm)


MOST_SLOTS = 60
"""Slots of a Geneva wheel; those of machines have 3 to 18."""


def geneva_of(case: Case, points: Mapping[str, Point], link: str) -> Geneva | None:
    """A link as a Geneva wheel: it is pinned to the frame and has one slot, toward its pivot, in which a
    crank has its pin whose arm is to the distance of the pivots as sin(180 deg / n) to 1, engaged."""
    own = [joint for joint in case.joints if link in joint.links]
    slots = [joint for joint in own if isinstance(joint, Guided) and not joint.keeps_direction]
    if len(own) != 2 or len(slots) != 1 or slots[0].links[1] != link or slots[0].at not in points:
        return None
    pins = (p for one in slots[0].links[::-1] for p in case.pivots(case.ground, one))
    pivots = [points[p] for p in pins if p in points]
    if len(pivots) != 2 or not {*(slots[0].guide.ends or ())} <= points.keys():
        return None
    centre, pin = pivots[0], points[slots[0].at]
    reach, arm = math.dist(*pivots), math.dist(pivots[1], pin)
    count = round(math.pi / math.asin(arm / reach)) if 0.0 < arm < reach else 0
    x, y = guide_direction(slots[0].guide, points, FLOATS)
    aside = (pin[0] - centre[0]) * y - (pin[1] - centre[1]) * x
    exact = (
        abs(aside) <= 1e-6 * reach and abs(arm - reach * math.sin(math.pi / max(count, 1))) <= 1e-6 * reach
    )
    wheel = Geneva(centre, pin, count, reach, arm)
    return wheel if 2 < count <= MOST_SLOTS and exact and math.dist(centre, pin) <= wheel.radius else None


# --- surfaces of cams and followers whose profiles a case gives ------------------------------------------


def normal_of(joint: Sliding) -> Point:
    """The unit normal of a contact, out of its first link."""
    assert joint.direction is not None
    return turn_of(joint.direction.value)


def surfaces(case: Case, joint: Sliding, points: Mapping[str, Point]) -> list[Wheel | Edge]:
    """The circles and faces that touch at a contact; other profiles are `outlines`."""
    assert case.profiles is not None
    found: list[Wheel | Edge] = []
    for link, sign in zip(joint.links, (1.0, -1.0), strict=True):
        match case.profiles.shapes[link]:
            case Circle(centre, radius) | Roller(centre, radius) if centre in points:
                found.append(Wheel(link, points[centre], radius.value, "cam"))
            case Flat():
                x, y = normal_of(joint)
                found.append(Edge(link, points[joint.at], (sign * x, sign * y)))
    return found


def outlines(case: Case, points: Mapping[str, Point]) -> list[tuple[str, list[Point]]]:
    """Links with the corners of their profiles, curved pieces by short chords; but circles and followers."""
    if case.profiles is None:
        return []
    from icsolve.cams.curve import placed

    found = []
    for link, shape in case.profiles.shapes.items():
        if isinstance(shape, Circle | Flat | Roller | Knife) or not set(points_of(shape)) <= points.keys():
            continue
        try:
            curve = placed(shape, points, f"the profile of link {link}")
        except SceneError:
            continue
        found.append((link, [place for place, _, _ in curve.chords]))
    return found


# --- a known scene in a view, and the parts of a drawing -------------------------------------------------


PIN = 5.0
"""Radius of a pin."""
HALF = 6.5
"""Half the width of a bar."""
BLOCK = (32.0, 20.0)
"""A slider's block."""
RAIL = 58.0
"""How far a guide reaches to each side of its block."""
SLOT = 34.0
"""How far a slot reaches to each side of its pin."""


class Scene(NamedTuple):
    """A known scene in a view; ``at`` has its points in picture units.

    ``travel`` is how far a joint's place goes along its guide, back (negative) and forth along the guide's
    direction in the picture, by the guide's link and the joint's place: rails and rods reach so much farther.
    """

    known: Known
    view: View
    at: Mapping[str, Point]
    round: Round
    travel: Mapping[tuple[str, Point], tuple[float, float]] = MappingProxyType({})

    @property
    def case(self) -> Case:
        """The case."""
        return self.known.case

    def ends(self, link: str, place: Point, p: Point, u: Point, reach: float) -> tuple[Point, Point]:
        """The ends of a guide of a link along u about p, the picture of ``place``."""
        back, forth = self.travel.get((link, place), (0.0, 0.0))
        return along(p, u, back - reach), along(p, u, forth + reach)

    def circle(self, wheel: Wheel) -> tuple[Point, float]:
        """The centre and the radius of a wheel in the picture."""
        return self.view.at(wheel.centre), wheel.radius * self.view.scale

    def carried(self, link: str) -> list[Point]:
        """The points that a link carries and that can be placed."""
        return [self.at[p] for p in self.case.carries.get(link, ()) if p in self.at]

    def joints(self) -> Iterable[Joint]:
        """The joints whose points can be placed."""
        return (joint for joint in self.case.joints if all(p in self.at for p in joint.points))


def fixed_springs(case: Case) -> list[Spring]:
    """The springs whose far end is held by the frame."""
    return [load for load in case.loads if isinstance(load, Spring) and load.against in (None, case.ground)]


def aims(case: Case) -> tuple[str, ...]:
    """The points toward which loads act, or away from which."""
    loads = case.loads if case.space is None else case.space.loads
    found = (getattr(getattr(load, "heading", None), "point", None) for load in loads)
    return tuple(name for name in found if name)


class Part(NamedTuple):
    """What a room adds: marks, what labels had better not cover, what they must not, and labels."""

    marks: tuple[Mark, ...] = ()
    soft: tuple[Soft, ...] = ()
    solid: tuple[Box, ...] = ()
    labels: tuple[Label, ...] = ()


def together(parts: Iterable[Part]) -> Part:
    """Several parts as one, in order."""
    parts = list(parts)
    return Part(
        tuple(mark for part in parts for mark in part.marks),
        tuple(soft for part in parts for soft in part.soft),
        tuple(box for part in parts for box in part.solid),
        tuple(label for part in parts for label in part.labels),
    )


def around(p: Point, reach: float) -> Box:
    """A square about a point."""
    return (p[0] - reach, p[1] - reach, p[0] + reach, p[1] + reach)


ORDER = ("t-point", "t-unknown", "t-known", "t-centre", "t-velocity", "t-link")
"""Whose labels choose their places first."""


def placed_labels(part: Part, window: Box) -> Iterable[tuple[Label, MarkGroup]]:
    """The labels of a part that say something, each with its marks at its place."""
    placer = Placer(part.solid, part.soft, window)
    labels = sorted(part.labels, key=lambda label: ORDER.index(label.kind) if label.kind in ORDER else 9)
    return ((label, placer.put(label)) for label in labels if label.runs)


def with_labels(part: Part, window: Box) -> list[Mark]:
    """The marks of a part and its labels, placed."""
    return [*part.marks, *(marks for _, marks in placed_labels(part, window))]
