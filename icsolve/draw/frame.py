"""The frame and the joints in the field's symbols (ISO 3952): hatched feet, rails, pins, contacts, belts."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import assert_never

import shapely

from icsolve.case import Belt, Contact, Gears, Joint, KnownCentre, Pin, Roll, Slide, Slot, Weld, is_named
from icsolve.case.joints import Guided
from icsolve.draw.links import ROD, block_place, guide_in_picture, number_label, turns, under_wedge
from icsolve.draw.marks import Disc, Follows, Mark, MarkGroup, Point, Stroke, along, unit
from icsolve.draw.place import Label, Soft, area, bar, hatched, joined
from icsolve.draw.scene import (
    BLOCK,
    PIN,
    RAIL,
    SLOT,
    Edge,
    Part,
    Scene,
    Wheel,
    aims,
    around,
    fixed_springs,
    outlines,
)
from icsolve.draw.words import name_runs
from icsolve.tuples import NamedTuple

FOOT = (17.0, 13.0)
"""Height of a foot and half its width."""
PITCH = 7.0
"""From thread to thread of a screw."""
DOWN, UP, LEFT, RIGHT = (0.0, 1.0), (0.0, -1.0), (-1.0, 0.0), (1.0, 0.0)


class FramePiece(NamedTuple):
    """A part of the frame, what labels had better not cover of it, where the frame's number may stand, and
    what it follows."""

    marks: tuple[Mark, ...]
    soft: tuple[Soft, ...]
    anchors: tuple[Point, ...]
    follows: Follows = ()


def frame_parts(scene: Scene, links: shapely.Geometry) -> list[Part]:
    """Feet, rails and straight edges of the frame, and its number."""
    ground = scene.case.ground
    guides = [joint for joint in _guides(scene) if joint.links[1] == ground]
    pieces = [_foot(name, scene.at[name], links) for name in _feet(scene)]
    pieces += [_rail(scene, joint, links) for joint in guides if joint.thread is None]
    pieces += [_spindle(scene, joint) for joint in guides if joint.thread is not None]
    pieces += [_surface(scene, edge) for edge in scene.round.edges if edge.link == ground]
    pieces += [_annulus(scene, w) for w in scene.round.wheels if w.link == ground]
    marks = tuple(MarkGroup("", "", piece.marks, follows=piece.follows) for piece in pieces)
    soft = tuple(soft for piece in pieces for soft in piece.soft)
    anchors = tuple(a for piece in pieces for a in piece.anchors)[:6]
    number = (number_label(ground, anchors, 5.0),) if anchors else ()
    group = MarkGroup(f"link-{ground}", "", marks, f"frame {ground}")
    return [Part((group,), soft, (), number)] if marks else []


def _feet(scene: Scene) -> list[str]:
    """Where the frame holds something: its pins, welds, blocks on it, and the ends of springs."""
    ground = scene.case.ground
    found: list[str] = []
    for joint in scene.joints():
        own = joint.carried[:1] if isinstance(joint, Guided) else joint.carried
        if joint.at is not None and (ground, joint.at) in own:
            found.append(joint.at)
    for rope in scene.case.ropes:
        held = zip(rope.points, rope.links, rope.mu, strict=False)
        found += [p for p, link, mu in held if link == ground and mu is None and p in scene.at]
    found += [spring.to for spring in fixed_springs(scene.case) if spring.to in scene.at]
    places: dict[Point, str] = {}
    for name in found:
        places.setdefault(scene.at[name], name)
    return list(places.values())


def _guides(scene: Scene) -> Iterable[Guided]:
    return (joint for joint in scene.joints() if isinstance(joint, Guided))


def _foot(name: str, p: Point, links: shapely.Geometry) -> FramePiece:
    """A pin's foot: a triangle on hatched ground, where it hides least of the links."""
    height, half = FOOT

    def corners(d: Point) -> tuple[Point, Point, Point]:
        base, side = along(p, d, height), (-d[1], d[0])
        return p, along(base, side, -half), along(base, side, half)

    def hidden(d: Point) -> float:
        grown = shapely.Polygon(corners(d)).buffer(4.0)
        return float(shapely.area(shapely.intersection(grown, links))) + {DOWN: 0.0, UP: 60.0}.get(d, 40.0)

    down = min((DOWN, LEFT, RIGHT, UP), key=hidden)
    apex, left, right = corners(down)
    side = unit(right[0] - left[0], right[1] - left[1])
    ends = (along(left, side, -5.0), along(right, side, 5.0))
    triangle = shapely.Polygon([apex, left, right])
    ground = hatched(ends[0], ends[1], 1.0 if _turns_left(side, down) else -1.0)
    shape = shapely.Polygon([apex, ends[0], ends[1]]).buffer(7.0, quad_segs=1)
    beside = (along(ends[0], down, 3.0), along(ends[1], down, 3.0))
    return FramePiece((area(triangle, "foot"), *ground), (Soft(shape, 1.5),), beside, (("at", name),))


def _turns_left(u: Point, v: Point) -> bool:
    """Whether v lies where `hatched` draws for side 1 when going along u."""
    return -u[1] * v[0] + u[0] * v[1] > 0.0


def _rail(scene: Scene, joint: Guided, links: shapely.Geometry) -> FramePiece:
    """A hatched rail beside a block; two beside a pin that runs in a slot of the frame."""
    p, u = block_place(scene, joint), guide_in_picture(scene, joint)
    first, last = scene.ends(joint.links[1], scene.known.points[joint.at], p, u, 0.0)
    low, high = under_wedge(scene, joint)
    first, last = (
        along(first, u, min(low + RAIL - FOOT[1], 0.0)),
        along(last, u, max(high - RAIL + FOOT[1], 0.0)),
    )
    if u[0] < 0.0 or (u[0] == 0.0 and u[1] > 0.0):
        u, first, last = (-u[0], -u[1]), last, first
    v = (-u[1], u[0])
    sides: tuple[float, ...] = (1.0, -1.0)
    if joint.keeps_direction:
        offset, reach = BLOCK[1] / 2.0 + 1.0, RAIL
        sides = (min(sides, key=lambda side: _cover(along(p, v, side * 16.0), u, links) - 5.0 * side),)
    else:
        offset, reach = PIN + 1.5, SLOT
    marks: list[Mark] = []
    for side in sides:
        start, end = (along(q, v, side * offset) for q in (first, last))
        for rail in _beside_cams(scene, p, along(start, u, -reach), along(end, u, reach)):
            marks += hatched(*rail, side)
    beyond = (along(last, u, reach - 6.0), along(first, u, 6.0 - reach))
    ends = tuple(along(q, v, sides[0] * (offset + 5.0)) for q in beyond)
    rails = [mark.points for mark in marks if isinstance(mark, Stroke) and mark.kind == "frame"]
    lines = [Soft(_band(points), 1.5) for points in rails]
    return FramePiece(tuple(marks), tuple(lines), ends, (("rail", joint.at),))


def _beside_cams(scene: Scene, p: Point, a: Point, b: Point) -> Iterable[tuple[Point, Point]]:
    """The part of a rail next to p that does not run through a cam."""
    shapes = [
        shapely.Polygon(map(scene.view.at, corners))
        for _, corners in outlines(scene.case, scene.known.points)
    ]
    for wheel in scene.round.wheels:
        if wheel.kind == "cam":
            centre, radius = scene.circle(wheel)
            shapes.append(shapely.Point(centre).buffer(radius))
    cams = joined(shapes).buffer(8.0)
    clear = shapely.difference(shapely.LineString([a, b]), cams)
    pieces = [piece for piece in getattr(clear, "geoms", (clear,)) if piece.length > 12.0]
    if pieces:
        near = min(pieces, key=lambda piece: shapely.distance(piece, shapely.Point(p)))
        yield (near.coords[0], near.coords[-1])


def _spindle(scene: Scene, joint: Guided) -> FramePiece:
    """The rod of a screw that the frame holds, with its bearing."""
    p, u = scene.at[joint.at], guide_in_picture(scene, joint)
    first, last = scene.ends(joint.links[1], scene.known.points[joint.at], p, u, RAIL)
    v = (-u[1], u[0])
    ends = (along(first, v, -14.0), along(first, v, 14.0))
    marks: tuple[Mark, ...] = (area(bar((first, last), ROD), "body"), *hatched(*ends, 1.0))
    soft = (Soft(bar((first, last), ROD), 1.5), Soft(_band(ends), 1.5))
    return FramePiece(marks, soft, ends)


def threads(scene: Scene) -> list[Part]:
    """The threads of screws on both sides of their nuts."""
    parts = []
    for joint in _guides(scene):
        if joint.thread is None:
            continue
        p, u = scene.at[joint.at], guide_in_picture(scene, joint)
        ends = scene.ends(joint.links[1], scene.known.points[joint.at], p, u, RAIL)
        marks: list[Mark] = []
        for end in ends:
            way, v = unit(end[0] - p[0], end[1] - p[1]), (-u[1], u[0])
            start, count = along(p, way, BLOCK[0] / 2.0), int((math.dist(p, end) - BLOCK[0] / 2.0) / PITCH)
            for n in range(count):
                middle = along(start, way, (n + 0.5) * PITCH)
                lean = tuple(along(along(middle, v, s * ROD), u, s * PITCH / 2.0) for s in (-1.0, 1.0))
                marks.append(Stroke(lean, "hatch"))
        parts.append(Part((MarkGroup(f"screw-{'-'.join(joint.links)}", "", tuple(marks), "screw"),)))
    return parts


def _band(points: tuple[Point, ...]) -> shapely.Geometry:
    return shapely.LineString(points).buffer(6.0, quad_segs=1, cap_style="flat")


def _cover(middle: Point, u: Point, links: shapely.Geometry) -> float:
    """How much of the links a rail through a point would hide."""
    line = shapely.LineString([along(middle, u, -RAIL), along(middle, u, RAIL)])
    return float(shapely.length(shapely.intersection(line, links)))


def _surface(scene: Scene, edge: Edge) -> FramePiece:
    """Level ground on which something rolls or rubs."""
    at, n = scene.view.at(edge.at), (edge.normal[0], -edge.normal[1])
    u = (-n[1], n[0])
    ends = scene.ends(edge.link, edge.at, at, u, 74.0)
    marks = hatched(ends[0], ends[1], 1.0 if _turns_left(u, (-n[0], -n[1])) else -1.0)
    beside = tuple(along(end, n, -5.0) for end in ends)
    return FramePiece(tuple(marks), (Soft(_band(ends), 1.5),), beside)


def _annulus(scene: Scene, wheel: Wheel) -> FramePiece:
    """A pitch circle of the frame with hatching outside."""
    centre, radius = scene.circle(wheel)
    count = max(int(2.0 * math.pi * radius / 9.0), 12)
    marks: list[Mark] = [Disc(centre, radius, "rim" if wheel.kind == "gear" else "foot")]
    outer = radius + 5.0 if wheel.rim else radius - 5.0
    marks.append(Disc(centre, outer, "frame"))
    step = 2.0 * math.pi / count
    depth = 7.0 if wheel.rim else -7.0
    for k in range(count):
        a, b = k * step, (k + 0.6) * step
        marks.append(Stroke((_polar(centre, outer, a), _polar(centre, outer + depth, b)), "hatch"))
    ring = shapely.Point(centre).buffer(outer + depth).boundary
    spots = tuple(_polar(centre, outer + depth, a) for a in (-0.8, -2.3, 0.8, 2.3))
    return FramePiece(tuple(marks), (Soft(ring, 2.0),), spots)


def _polar(centre: Point, radius: float, angle: float) -> Point:
    return (centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle))


def rims(scene: Scene, link: str = "") -> list[Part]:
    """The annuli of moving links, or of one."""
    parts = []
    for wheel in scene.round.wheels:
        if wheel.rim and wheel.link != scene.case.ground and link in ("", wheel.link):
            centre, radius = scene.circle(wheel)
            marks = (Disc(centre, radius, "rim"), Disc(centre, radius + 7.0, "frame"))
            ring = shapely.Point(centre).buffer(radius + 3.0).boundary
            spots = tuple(_polar(centre, radius + 7.0, a) for a in (-0.8, -2.3, 0.8, 2.3))
            group = MarkGroup(f"rim-{wheel.link}", "", marks, f"link {wheel.link}", (), turns(wheel.link))
            label = number_label(wheel.link, spots, 4.0)
            parts.append(Part((group,), (Soft(ring, 2.0),), (), (label,)))
    return parts


def joint_parts(scene: Scene) -> list[Part]:
    """Pins, contacts, welds and known centres, on top of the links; labels keep off them."""
    parts = []
    for joint in scene.joints():
        marks = _symbol(scene, joint)
        if marks:
            at = joint.at or ""
            name = "-".join(("joint", type(joint).__name__.lower(), at.replace("@", "at-"), *joint.links))
            group = MarkGroup(name, "", tuple(marks), follows=(("at", at),))
            reach = PIN + 1.0 if joint.pivot or joint.guide else 4.0
            parts.append(Part((group,), (), (around(scene.at[at], reach),)))
    return parts


def _symbol(scene: Scene, joint: Joint) -> list[Mark]:
    at = joint.at
    if at is None:
        return []
    p = scene.at[at]
    match joint:
        case Pin() | Slot():
            return [
                *_friction_circle(scene, joint, p),
                Disc(p, PIN, "pin"),
                *([Disc(p, PIN + 3.0, "faint")] if len(joint.links) > 2 else []),
            ]
        case Slide():
            return [Disc(p, 1.6, "dot")]
        case Roll() | Contact():
            return [Disc(p, 2.4, "dot")]
        case Weld():
            return [area(shapely.box(p[0] - 4.0, p[1] - 4.0, p[0] + 4.0, p[1] + 4.0), "pin")]
        case KnownCentre():
            return [Disc(p, 4.0, "primary")]
        case Gears() | Belt():  # their wheels show them
            return []
        case _:
            assert_never(joint)


def _friction_circle(scene: Scene, joint: Joint, p: Point) -> list[Mark]:
    """The circle of radius r sin phi to which the force in a rubbing pin is tangent, where it can be seen."""
    friction = joint.friction if joint.pivot else None
    if friction is None or friction.radius is None:
        return []
    radius = friction.radius.value * math.sin(math.atan(friction.mu.value)) * scene.view.scale
    return [Disc(p, radius, "box")] if radius > 1.0 else []


def point_parts(scene: Scene) -> list[Part]:
    """The letter of every point that a link carries, a joint has or a load acts toward, and a dot where no
    joint shows it."""
    jointed = {joint.at for joint in scene.joints() if joint.freedom}
    named = [p for ps in scene.case.carries.values() for p in ps]
    named += [*(joint.at for joint in scene.case.joints if joint.at), *aims(scene.case)]
    parts = []
    for name in dict.fromkeys(named):
        if name not in scene.at or not is_named(name):
            continue
        p = scene.at[name]
        pinned, follows = name in jointed, (("at", name),)
        gap = PIN + 3.0 if pinned else 5.0
        label = Label(f"point-{name}", name_runs(name), "t-point", 15.0, (p,), gap, follows=follows)
        dot = () if pinned else (MarkGroup("", "", (Disc(p, 2.2, "dot"),), follows=follows),)
        parts.append(Part(dot, (), () if pinned else (around(p, 2.6),), (label,)))
    return parts
