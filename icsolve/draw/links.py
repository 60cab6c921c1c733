"""The outline of every link: bars and plates between its points, blocks, slotted levers, wheels and cams."""

from __future__ import annotations

import math
from collections.abc import Iterable

import shapely

from icsolve.case import Force, Toward, Weight
from icsolve.case.joints import Guided
from icsolve.draw.marks import Disc, Follows, Mark, MarkGroup, Point, Stroke, TextRun, along, unit
from icsolve.draw.place import Label, Soft, area, bar, joined, nearest, plate, tilted, without_slits
from icsolve.draw.scene import (
    BLOCK,
    HALF,
    PIN,
    RAIL,
    SLOT,
    Part,
    Ratchet,
    Scene,
    geneva_of,
    normal_of,
    outlines,
)
from icsolve.numbers import FLOATS
from icsolve.screws.joints import guide_direction
from icsolve.tuples import NamedTuple

ROD = 5.0
"""Half the width of a rod on which a block slides."""
WIDE, STRIP = 46.0, 10.0
"""How far a wedge reaches beyond its joints; half the width of one between two walls."""
COVER = 1.6
"""What it costs a label to cover a link."""
RIM, PLATE = 15.0, 0.12
"""Farther from its outline than the first, the inside of a plate costs a label only the second."""
OUTLINE = 0.4
"""What it costs a label to cover a unit of a link's outline."""


class DrawnBody(NamedTuple):
    """A link's own outline (None where it has none but wheels), its blocks above it, holes in it, and where
    its number may stand."""

    link: str
    shape: shapely.Geometry | None
    wheels: tuple[Disc, ...]
    blocks: tuple[shapely.Geometry, ...]
    holes: tuple[shapely.Geometry, ...]
    anchors: tuple[Point, ...]
    dashed: bool = False


def body_of(scene: Scene, link: str) -> DrawnBody:
    """The outline of a link that moves (or of a black box, dashed)."""
    points = _own_points(scene, link)
    wedge = _wedge(scene, link)
    if wedge is not None:
        inside = wedge.representative_point()
        return DrawnBody(link, wedge, (), (), (), ((inside.x, inside.y),))
    geneva = _geneva(scene, link)
    if geneva is not None:
        return DrawnBody(link, geneva, (), (), (), tuple(points))
    levers = list(_lines(scene, link, SLOT, turns=True))
    rods = list(_lines(scene, link, RAIL, turns=False))
    crates = dict(_crates(scene, link, [*levers, *rods]))
    ratchets = [one for one in scene.round.ratchets if link in (one.wheel, one.pawl)]
    toothed = {scene.view.at(one.at) for one in ratchets}
    points = [p for p in points if p not in crates and p not in toothed]
    sliding = list(_guided(scene, link, 0, turns=False))
    blocks = [tilted(block_place(scene, j), guide_in_picture(scene, j), *BLOCK) for j in sliding]
    blocks += crates.values()
    wheels = tuple(
        Disc(*scene.circle(w), "wheel" if w.kind == "gear" else "body")
        for w in scene.round.wheels
        if w.link == link and not w.rim
    )
    square = not any(p in scene.at for p in scene.case.pivots(link, scene.case.ground))
    parts = [*_frame_of_points(points, rods, levers, wheels, square=square)]
    parts += [bar(ends, 11.0) for ends in levers]
    stems = ((scene.at[joint.at], block_place(scene, joint)) for joint in sliding)  # of followers
    parts += [bar(ends, HALF) for ends in stems if ends[0] != ends[1]]
    given = (corners for own, corners in outlines(scene.case, scene.known.points) if own == link)
    parts += _cams(scene, link)
    parts += [_ratchet(scene, one) if one.wheel == link else _pawl(scene, one) for one in ratchets]
    parts += [shapely.Polygon(map(scene.view.at, corners)) for corners in given]
    parts += _edges(scene, link, points, square=square)
    dashed = bool(points) and all(j.stands_in for j in scene.case.joints if link in j.links)
    if dashed:
        parts = [plate(points, 4.0)] if len(points) != 2 else [bar(points, 0.01)]
    shape = without_slits(joined(parts)) if parts else None
    holes = tuple(bar(_inside(ends), PIN + 0.8) for ends in levers)
    return DrawnBody(link, shape, wheels, tuple(blocks), holes, _anchors(points, rods, wheels, shape), dashed)


def _only_slides(scene: Scene, link: str) -> bool:
    """Whether a link never turns, and slides on others or has pins in their slots."""
    own = [joint for joint in scene.case.joints if link in joint.links]
    guided = [joint for joint in own if isinstance(joint, Guided) and joint.thread is None]
    sliding = guided == own and all(joint.keeps_direction or joint.links[0] == link for joint in guided)
    return sliding and _never_turns(scene, link) and len(own) > 1


def _never_turns(scene: Scene, link: str) -> bool:
    """Whether a link is known to move without turning."""
    x, y, w = scene.known.twists.get(link, (0.0, 0.0, 1.0))
    return link != scene.case.ground and abs(w) * scene.known.size <= 1e-12 * math.hypot(x, y)


def _wedge(scene: Scene, link: str) -> shapely.Geometry | None:
    """A body between the planes of its guides, where it slides on others that only slide too; else None.

    It lies on the side of each plane on which its other joints are, or away from the body that it slides on;
    along a guide through all its joints it is a strip.
    """
    if not _only_slides(scene, link):
        return None
    joints = [j for j in scene.joints() if isinstance(j, Guided) and link in j.links]
    others = {one for joint in joints for one in joint.links if one not in (link, scene.case.ground)}
    if not others or not all(_only_slides(scene, one) for one in others):
        return None
    places = [scene.at[joint.at] for joint in joints]
    xs, ys = [x for x, _ in places], [y for _, y in places]
    shape: shapely.Geometry = shapely.box(min(xs) - WIDE, min(ys) - WIDE, max(xs) + WIDE, max(ys) + WIDE)
    for joint in joints:
        p, u = scene.at[joint.at], guide_in_picture(scene, joint)
        v, fixed = (-u[1], u[0]), scene.case.ground in joint.links
        (other,) = (one for one in joint.links if one != link)
        side = _side(p, v, places) or -_side(p, v, _own_points(scene, other))
        reach = 2.0 * WIDE + max(max(xs) - min(xs), max(ys) - min(ys))
        strip = fixed and not _side(p, v, places)
        low, high = (-STRIP, STRIP) if strip else (-BLOCK[1] / 2.0 if fixed else 0.0, 2.0 * reach)
        way = v if side >= 0.0 else (-v[0], -v[1])
        corners = ((-reach, low), (reach, low), (reach, high), (-reach, high))
        band = shapely.Polygon([along(along(p, u, a), way, b) for a, b in corners])
        shape = shapely.intersection(shape, band)
    return shape if shape.geom_type == "Polygon" and not shape.is_empty else None


ROUNDED = 0.78
"""The radius of a Geneva wheel's arcs between two slots, as part of the crank's."""


def _geneva(scene: Scene, link: str) -> shapely.Geometry | None:
    """A Geneva wheel."""
    wheel = geneva_of(scene.case, scene.known.points, link)
    if wheel is None:
        return None
    centre, pin = scene.view.at(wheel.centre), scene.view.at(wheel.pin)
    reach, arm = wheel.reach * scene.view.scale, wheel.arm * scene.view.scale
    first = math.atan2(pin[1] - centre[1], pin[0] - centre[0])
    shape: shapely.Geometry = shapely.Point(centre).buffer(wheel.radius * scene.view.scale)
    for n in range(wheel.slots):
        ways = [first + 2.0 * math.pi * (n + half) / wheel.slots for half in (0.0, 0.5)]
        slotted, between = ((math.cos(a), math.sin(a)) for a in ways)
        slot = bar([along(centre, slotted, length) for length in (reach - arm, 1.2 * reach)], PIN + 0.8)
        cut = shapely.Point(along(centre, between, reach)).buffer(ROUNDED * arm)
        shape = shape.difference(slot).difference(cut)
    return shape if shape.geom_type == "Polygon" else None


def _crates(
    scene: Scene, link: str, lines: Iterable[tuple[Point, Point]]
) -> Iterable[tuple[Point, shapely.Geometry]]:
    """What stands on a level table that never turns: a weight above it is in the middle of a crate."""
    joints = {joint.at for joint in scene.joints() if link in joint.links}
    for load in scene.case.loads:
        if not isinstance(load, Weight) or load.link != link or load.at in joints or load.at not in scene.at:
            continue
        x, y = scene.at[load.at]
        for (_, top), (_, other) in lines:
            half = top - HALF - y
            if abs(top - other) < 0.5 and CRATE[0] < half < CRATE[1] and _never_turns(scene, link):
                wide = min(1.2 * half, 0.8 * CRATE[1])
                yield (x, y), shapely.box(x - wide, y - half, x + wide, y + half)


CRATE = (10.0, 120.0)
"""A crate is so high from its middle."""


def under_wedge(scene: Scene, joint: Guided) -> tuple[float, float]:
    """From where to where a body stands on its guide, from the joint's place along the guide; nothing of a
    strip that runs in it."""
    body = _wedge(scene, joint.links[0])
    p, u = scene.at[joint.at], guide_in_picture(scene, joint)
    if body is None:
        return 0.0, 0.0
    gaps = [(x - p[0], y - p[1]) for x, y in body.exterior.coords]
    wide = [dy * u[0] - dx * u[1] for dx, dy in gaps]
    foot = [dx * u[0] + dy * u[1] for dx, dy in gaps]
    return (min(foot), max(foot)) if max(wide) - min(wide) > 2.0 * STRIP + 1.0 else (0.0, 0.0)


def _side(p: Point, v: Point, places: Iterable[Point]) -> float:
    """How far the farthest of some places lies from a line through p, positive toward v; 0 for on it."""
    gaps = [(x - p[0]) * v[0] + (y - p[1]) * v[1] for x, y in places]
    farthest = max(gaps, key=abs, default=0.0)
    return farthest if abs(farthest) > 1.0 else 0.0


def _own_points(scene: Scene, link: str) -> list[Point]:
    """Where the link has joints, loads and other points; each place once."""
    names = [p for p in scene.case.carries.get(link, ()) if p in scene.at]
    names += [j.at for j in scene.joints() if j.stands_in and link in j.links and j.at]
    names += [p for p in _taken_at(scene, link) if p in scene.at]
    names += [at for own, at in scene.round.feet if own == link]
    return list(dict.fromkeys(scene.at[p] for p in names))


def _taken_at(scene: Scene, link: str) -> Iterable[str]:
    """The points of no link at which a link takes the opposite of a load toward them."""
    carried = {name for names in scene.case.carries.values() for name in names}
    for load in scene.case.loads:
        heading = load.heading if isinstance(load, Force) and load.against == link else None
        if isinstance(heading, Toward) and heading.point not in carried and link != scene.case.ground:
            yield heading.point


def guide_in_picture(scene: Scene, joint: Guided) -> Point:
    """Unit vector along a guide, in the picture."""
    x, y = guide_direction(joint.guide, scene.known.points, FLOATS)
    return (x, -y)


def _guided(scene: Scene, link: str, place: int, *, turns: bool) -> Iterable[Guided]:
    """The joints that have the link in a place and a guide, about whose point it turns or does not."""
    joints = (j for j in scene.joints() if isinstance(j, Guided) and j.links[place] == link)
    return (joint for joint in joints if joint.keeps_direction != turns)


def block_place(scene: Scene, joint: Guided) -> Point:
    """Where a block is drawn: at its point; where a roller is about that, on the stem of the follower, beyond
    the roller and away from what it touches."""
    p, u = scene.at[joint.at], guide_in_picture(scene, joint)
    for wheel in scene.round.wheels if joint.keeps_direction else ():
        centre, radius = scene.circle(wheel)
        rolled = (j for j in scene.joints() if not j.stays_known and not j.stands_in)
        touching = [scene.at[j.at or ""] for j in rolled if wheel.link in j.links]
        if math.dist(p, centre) > 1.0 or radius < BLOCK[0] / 2.0 or not touching:
            continue
        (x, y) = touching[0]
        away = 1.0 if (p[0] - x) * u[0] + (p[1] - y) * u[1] >= 0.0 else -1.0
        return along(p, u, away * (radius + RAIL))
    return p


def _lines(scene: Scene, link: str, reach: float, *, turns: bool) -> Iterable[tuple[Point, Point]]:
    """The rods of a moving link along which blocks of others slide, or the slots in which their pins turn."""
    for joint in _guided(scene, link, 1, turns=turns):
        p, u = scene.at[joint.at], guide_in_picture(scene, joint)
        yield scene.ends(link, scene.known.points[joint.at], p, u, reach)


def _inside(lever: tuple[Point, Point]) -> list[Point]:
    """The ends of the hole in a slotted lever."""
    a, b = lever
    u = unit(b[0] - a[0], b[1] - a[1])
    return [along(a, u, 12.0), along(b, u, -12.0)]


def _frame_of_points(
    points: list[Point],
    rods: list[tuple[Point, Point]],
    levers: list[tuple[Point, Point]],
    wheels: tuple[Disc, ...],
    *,
    square: bool,
) -> Iterable[shapely.Geometry]:
    """Bars and plates that hold a link's points, rods, slotted levers and wheels together."""
    outside = [p for p in points if not any(math.dist(p, w.centre) <= w.radius + 2.0 for w in wheels)]
    held = [*outside, *(w.centre for w in wheels)] if outside or rods or levers else []
    for a, b in rods:
        yield bar(_stretched(a, b, held), ROD)
    lines = [shapely.LineString(ends) for ends in (*rods, *levers)]
    for line in lines[1:]:
        held.append(nearest(line, lines[0].centroid.coords[0]))
    for p in held if lines else ():
        stem = _stem(lines[0], p, square=square and not rods)
        if stem:
            yield bar(stem, ROD if rods else HALF)
    if not lines and len(held) > 1:
        yield plate(held, HALF)
    elif not lines and len(held) == 1 and not wheels:
        yield bar(held, HALF + 2.5)


def _stem(line: shapely.LineString, p: Point, *, square: bool) -> list[Point]:
    """From a point to a straight part of its link; ``square``: by a right angle with the part's own line,
    which goes on so far."""
    foot = nearest(line, p)
    if math.dist(p, foot) <= 1.0:
        return []
    (ax, ay), (bx, by) = line.coords
    u = unit(bx - ax, by - ay)
    corner = along((ax, ay), u, (p[0] - ax) * u[0] + (p[1] - ay) * u[1])
    if not square or min(math.dist(corner, foot), math.dist(corner, p)) <= 1.0:
        return [p, foot]
    return [p, corner, foot]


def _stretched(a: Point, b: Point, points: list[Point]) -> list[Point]:
    """A rod made longer to reach the points on its line."""
    u = unit(b[0] - a[0], b[1] - a[1])
    reach = [0.0, math.dist(a, b)]
    for p in points:
        dx, dy = p[0] - a[0], p[1] - a[1]
        if abs(dx * u[1] - dy * u[0]) <= 1.0:
            reach.append(dx * u[0] + dy * u[1])
    return [along(a, u, min(reach)), along(a, u, max(reach))]


def _cams(scene: Scene, link: str) -> Iterable[shapely.Geometry]:
    """A rounded cam where the case gives its contact alone."""
    for joint in scene.round.cams:
        if joint.links[0] != link:
            continue
        at, n = scene.at[joint.at], normal_of(joint)
        points = _own_points(scene, link)
        gap = math.dist(points[0], at) if points else 40.0
        radius = min(max(0.4 * gap, 6.0), 34.0)
        nose = bar([(at[0] - n[0] * radius, at[1] + n[1] * radius)], radius)
        yield shapely.convex_hull(joined([nose, *(bar([p], 13.0) for p in points)]))


TEETH, DEEP = 16, 0.16
"""Of a ratchet wheel, and how deep they are, of its radius."""


def _ratchet(scene: Scene, one: Ratchet) -> shapely.Geometry:
    """A wheel with saw teeth, each with a steep face square to the push on the pawl."""
    centre, at = scene.view.at(one.centre), scene.view.at(one.at)
    radius = math.dist(centre, at)
    out, push = unit(at[0] - centre[0], at[1] - centre[1]), (one.push[0], -one.push[1])
    way = 1.0 if out[0] * push[1] - out[1] * push[0] >= 0.0 else -1.0
    face = (way * push[1], -way * push[0])  # outward, as far as the push goes by the centre
    steep = face if face[0] * out[0] + face[1] * out[1] > 0.5 else out
    tooth = [along(at, steep, share * DEEP * radius) for share in (-0.75, 0.25)]
    corners = [turned(p, centre, -way * 2.0 * math.pi * n / TEETH) for n in range(TEETH) for p in tooth]
    return shapely.Polygon(corners)


def turned(p: Point, centre: Point, angle: float) -> Point:
    """A point turned about another by an angle [rad], in the picture."""
    (dx, dy), c, s = (p[0] - centre[0], p[1] - centre[1]), math.cos(angle), math.sin(angle)
    return (centre[0] + c * dx - s * dy, centre[1] + s * dx + c * dy)


def _pawl(scene: Scene, one: Ratchet) -> shapely.Geometry:
    """A finger from its pin to the tooth."""
    pivot, at = scene.view.at(one.pivot), scene.view.at(one.at)
    tip = along(at, (one.push[0], -one.push[1]), TIP)
    return shapely.convex_hull(joined([bar([pivot], HALF + 2.5), bar([tip], TIP)]))


TIP = 3.0
"""Half the width of a pawl where it meets the tooth."""


def _edges(scene: Scene, link: str, points: list[Point], *, square: bool) -> Iterable[shapely.Geometry]:
    """Straight faces of racks and followers, on a stem to the link's nearest point."""
    for edge in scene.round.edges:
        if edge.link != link:
            continue
        at, n = scene.view.at(edge.at), (edge.normal[0], -edge.normal[1])
        first, last = scene.ends(link, edge.at, at, (-n[1], n[0]), 42.0)
        middle = ((first[0] + last[0]) / 2.0, (first[1] + last[1]) / 2.0)
        face = tilted(along(middle, n, -4.5), (-n[1], n[0]), math.dist(first, last), 9.0)
        yield face
        if points:
            back, u = along(at, n, -4.5), (-n[1], n[0])
            middle = shapely.LineString([along(back, u, -40.0), along(back, u, 40.0)])
            stem = _stem(middle, min(points, key=lambda p: math.dist(p, at)), square=square)
            if stem:
                yield bar(stem, HALF)


def _anchors(
    points: list[Point],
    rods: list[tuple[Point, Point]],
    wheels: tuple[Disc, ...],
    shape: shapely.Geometry | None,
) -> tuple[Point, ...]:
    """Where a link's number may stand beside: the middle of its bar, its rim."""
    spots: list[Point] = []
    for k, p in enumerate(points):
        for q in points[k + 1 :]:
            way = (q[0] - p[0], q[1] - p[1])
            spots += [along(p, way, share) for share in (0.5, 0.36, 0.64)]
    for w in wheels:
        corners = ((1, -1), (-1, -1), (1, 1), (-1, 1))
        spots += [along(w.centre, unit(a, b), 0.62 * w.radius) for a, b in corners]
    if not spots:
        spots = [q for rod in rods for q in rod] + points
    if not spots and shape is not None:
        inside = shape.representative_point()
        spots = [(inside.x, inside.y)]
    return tuple(spots[:9])


def wheel_parts(bodies: Iterable[DrawnBody], *, spokes: bool = False) -> Iterable[Part]:
    """The wheels of all links, large ones under small ones, all under bars and feet; spokes show how they
    turn."""
    wheels = [(disc, body.link, n) for body in bodies for n, disc in enumerate(body.wheels)]
    for disc, link, n in sorted(wheels, key=lambda found: -found[0].radius):
        (x, y), r = disc.centre, disc.radius
        cross = (((x - r, y), (x + r, y)), ((x, y - r), (x, y + r))) if spokes else ()
        marks: tuple[Mark, ...] = (disc, *(Stroke(ends, "faint") for ends in cross))
        name = f"wheel-{link}" if n == 0 else ""
        group = MarkGroup(name, "", marks, f"link {link}", (), turns(link))
        yield Part((group,), (Soft(shapely.Point(disc.centre).buffer(r).boundary, 1.5),))


def turns(link: str) -> Follows:
    """What goes and turns with a link."""
    return (("turn", link),)


def link_part(scene: Scene, body: DrawnBody) -> Part:
    """A link's bars, plates and blocks, and its number."""
    marks: list[Mark] = []
    if body.shape is not None:
        marks.append(area(body.shape, "box" if body.dashed else "body"))
    marks += [area(hole, "hole") for hole in body.holes]
    marks += [area(block, "block") for block in body.blocks]
    solids = [shape for shape in (body.shape, *body.blocks) if shape is not None]
    inside = inside_plate(body)
    soft = [Soft(shape.difference(inside), 0.3 if body.dashed else COVER) for shape in solids]
    soft += [Soft(shape.boundary, OUTLINE) for shape in solids] + [Soft(inside, PLATE)]
    group = MarkGroup(f"link-{body.link}", "", tuple(marks), f"link {body.link}", (), turns(body.link))
    rim = any(wheel.rim and wheel.link == body.link for wheel in scene.round.wheels)
    middle = shapely.centroid(inside)
    on = not inside.is_empty and bool(shapely.contains(inside, middle))
    anchors = ((middle.x, middle.y),) if on else body.anchors
    number = number_label(body.link, anchors, 10.0)._replace(on=on)
    return Part((group,) if marks else (), tuple(soft), (), (number,) if body.anchors and not rim else ())


def number_label(link: str, anchors: tuple[Point, ...], gap: float) -> Label:
    """The number of a link."""
    runs, follows = (TextRun(link),), (("on", link),)
    return Label(f"number-{link}", runs, "t-link", 12.0, anchors, gap, badge=True, follows=follows)


def inside_plate(body: DrawnBody) -> shapely.Geometry:
    """The part of a plate where a number has room."""
    if body.shape is None or body.dashed or body.wheels:
        return shapely.Polygon()
    return shapely.buffer(body.shape, -RIM, quad_segs=1)


def bars(body: DrawnBody) -> shapely.Geometry:
    """What a link fills beside its wheels."""
    shapes = [shape for shape in (body.shape, *body.blocks) if shape is not None]
    return joined(shapes) if shapes else shapely.Polygon()


def outline(body: DrawnBody) -> shapely.Geometry:
    """All that a link fills."""
    return joined([bars(body), *(shapely.Point(w.centre).buffer(w.radius) for w in body.wheels)])
