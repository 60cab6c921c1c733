"""The figure of a page: the marks of a drawing, in a view that holds every position, told what they follow.

``data-turn`` follows a link, ``data-at`` a point, ``data-on`` a place of a link without turning,
``data-load`` a load; the script of the page moves them so.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import shapely

from icsolve.case import Force, Spring
from icsolve.case.joints import Guided
from icsolve.draw.figure import genevas, scene_over, used_points
from icsolve.draw.frame import frame_parts, joint_name, joint_parts, point_parts, rims
from icsolve.draw.links import DrawnBody, bars, body_of, guide_in_picture, link_part, outline
from icsolve.draw.loads import load_parts
from icsolve.draw.marks import Box, Mark, MarkGroup, Point, Stroke, TextMark, bounds
from icsolve.draw.place import Label, joined
from icsolve.draw.ropes import RopeCourse, belts, courses, filled, pulley_marks, rope_marks
from icsolve.draw.scene import Part, Scene, Wheel, around, placed_labels, together
from icsolve.page.columns import Array
from icsolve.page.motion import PageMotion
from icsolve.page.poses import moved
from icsolve.report.derivation.known import Acting, Known, acting_loads
from icsolve.report.derivation.ratios import Step
from icsolve.tuples import NamedTuple

ROOM = (430.0, 350.0)
"""The largest that the mechanism is drawn, through all its positions."""
Data = tuple[tuple[str, str], ...]


class PageFigure(NamedTuple):
    """The marks of a page's figure, its scene and its window, its ropes as written."""

    scene: Scene
    marks: tuple[Mark, ...]
    window: Box
    ropes: tuple[RopeCourse, ...]


def figure_of(known: Known, steps: Sequence[Step], motion: PageMotion | None) -> PageFigure:
    """The figure in its position as written, without its centres, which the script of the page draws."""
    scene = _scene(known, steps, motion)
    bodies = [body_of(scene, link) for link in scene.case.links if link != scene.case.ground]
    bodies.sort(key=lambda body: (len(body.blocks), -float(shapely.area(outline(body)))))
    ropes = tuple(courses(scene))
    links = joined([*map(bars, bodies), *filled(ropes)])
    inside = [w.link for w in scene.round.wheels if w.rim and w.link != scene.case.ground]
    parts = [
        *_wheels(bodies),
        *(_following(part, f"rim-{w}", ("data-turn", w)) for part in rims(scene) for w in inside),
        *frame_parts(scene, links, following=True),
        *(_turning(link_part(scene, body), body.link) for body in bodies),
        *_belts(scene),
        *_ropes(scene, ropes),
        *_joints(scene),
    ]
    under = together(parts)
    over = together([*_loads(scene, links), *_points(scene)])
    whole = together([under, over])
    placed = [_told(label, marks) for label, marks in placed_labels(whole, scene.view.window)]
    layers = (
        MarkGroup("mechanism", "", under.marks),
        MarkGroup("centres", "", ()),
        MarkGroup("loads", "", over.marks),
        MarkGroup("labels", "", tuple(placed)),
    )
    left, top, right, bottom = bounds(layers)
    a, b, c, d = scene.view.window
    return PageFigure(scene, layers, (min(a, left), min(b, top), max(c, right), max(d, bottom)), ropes)


def _scene(known: Known, steps: Sequence[Step], motion: PageMotion | None) -> Scene:
    """The scene in a view that holds all positions."""
    if motion is None:
        return scene_over(known, steps, room=ROOM)
    ways = [_box(*_way(motion, p)) for p in used_points(known.case) & motion.found.points.keys()]
    ways += [around(wheel.centre, wheel.radius) for wheel in genevas(known)]

    def swept(link: str, p: Point, reach: float) -> Box:
        pose = motion.poses.get(link)
        if pose is None:
            return around(p, reach)
        rows = slice(motion.first, motion.last + 1)
        xs, ys = moved(pose, known.points[pose.point], p)
        left, low, right, high = _box(xs[rows], ys[rows])
        return left - reach, low - reach, right + reach, high + reach

    scene = scene_over(known, steps, swept, ways, ROOM)
    return scene._replace(travel=travel_of(scene, motion))


def _way(motion: PageMotion, point: str) -> tuple[Array, Array]:
    places = motion.found.points[point][motion.first : motion.last + 1]
    return places[:, 0], places[:, 1]


def _box(x: Array, y: Array) -> Box:
    return (float(x.min()), float(y.min()), float(x.max()), float(y.max()))


def travel_of(scene: Scene, motion: PageMotion) -> dict[tuple[str, Point], tuple[float, float]]:
    """How far each joint's place goes along its guide, in picture units (see `Scene`)."""
    found: dict[tuple[str, Point], tuple[float, float]] = {}
    for joint in scene.joints():
        if isinstance(joint, Guided) and joint.at in motion.found.points:
            u = guide_in_picture(scene, joint)
            found[(joint.links[1], scene.known.points[joint.at])] = _along(
                scene, motion, joint.links[1], joint.at, u
            )
        if not joint.stays_known and not joint.stands_in and joint.at in motion.found.points:
            for edge in scene.round.edges:
                if edge.at == scene.known.points[joint.at]:
                    u = (edge.normal[1], edge.normal[0])
                    found[(edge.link, edge.at)] = _along(scene, motion, edge.link, joint.at, u)
    return found


def _along(scene: Scene, motion: PageMotion, link: str, point: str, u: Point) -> tuple[float, float]:
    """The least and largest way of a point along a direction of a link, from its place as written."""
    rows = slice(motion.first, motion.last + 1)
    x, y = motion.found.points[point][rows].T
    pose = motion.poses.get(link)
    x0, y0 = scene.known.points[point]
    if pose is None:
        dx, dy = x - x0, y - y0
    else:
        turn = np.radians(-pose.angle[rows])
        rx, ry = x - pose.x[rows], y - pose.y[rows]
        px, py = scene.known.points[pose.point]
        dx = np.cos(turn) * rx - np.sin(turn) * ry + px - x0
        dy = np.sin(turn) * rx + np.cos(turn) * ry + py - y0
    way = (dx * u[0] - dy * u[1]) * scene.view.scale
    return min(float(way.min()), 0.0), max(float(way.max()), 0.0)


def _following(part: Part, name: str, data: tuple[str, str]) -> Part:
    """A part whose group of this name follows something."""
    marks = tuple(
        m._replace(data=(*m.data, data)) if isinstance(m, MarkGroup) and m.name == name else m
        for m in part.marks
    )
    return part._replace(marks=marks)


def _turning(part: Part, link: str) -> Part:
    return _following(part, f"link-{link}", ("data-turn", link))


def _wheels(bodies: Sequence[DrawnBody]) -> Iterable[Part]:
    """Wheels, each with a spoke that shows how it turns."""
    discs = [(disc, body.link, n) for body in bodies for n, disc in enumerate(body.wheels)]
    discs.sort(key=lambda found: -found[0].radius)
    for disc, link, n in discs:
        (x, y), r = disc.centre, disc.radius
        spokes = [Stroke(((x - r, y), (x + r, y)), "faint"), Stroke(((x, y - r), (x, y + r)), "faint")]
        name = f"wheel-{link}" if n == 0 else f"wheel-{link}-{n}"
        yield Part((MarkGroup(name, "", (disc, *spokes), f"link {link}", (("data-turn", link),)),))


def _belts(scene: Scene) -> Iterable[Part]:
    """Belts go round with the link that carries both wheels."""
    for loop, part in zip(scene.round.loops, belts(scene), strict=True):
        carriers = [
            link
            for link in scene.case.links
            if all(_pinned(scene, link, w) for w in (loop.first, loop.second)) and link != scene.case.ground
        ]
        name = f"belt-{loop.first.link}-{loop.second.link}"
        yield _following(part, name, ("data-turn", carriers[0])) if carriers else part


def _ropes(scene: Scene, ropes: Sequence[RopeCourse]) -> Iterable[Part]:
    """Pulleys follow their points; the script lays the ropes round them. The tensions are those of the
    position as written alone, and are left out."""
    for name, marks in pulley_marks(ropes).items():
        yield Part((MarkGroup("", "", marks, "pulley", (("data-at", name),)),))
    for rope, part in zip(ropes, rope_marks(scene, ropes), strict=True):
        name = rope.rope.name
        yield _following(part._replace(labels=()), f"rope-{name}", ("data-rope", name))


def _pinned(scene: Scene, link: str, wheel: Wheel) -> bool:
    return any(scene.known.points.get(p) == wheel.centre for p in scene.case.pivots(link, wheel.link))


def _joints(scene: Scene) -> Iterable[Part]:
    names = {joint_name(joint): str(getattr(joint, "at", "")) for joint in scene.joints()}
    for part in joint_parts(scene):
        name = part.marks[0].name if isinstance(part.marks[0], MarkGroup) else ""
        yield _following(part, name, ("data-at", names[name]))


def _points(scene: Scene) -> Iterable[Part]:
    for part in point_parts(scene):
        name = part.labels[0].name.removeprefix("point-")
        dot = (MarkGroup("", "", part.marks, "", (("data-at", name),)),) if part.marks else ()
        yield part._replace(marks=dot)


def _loads(scene: Scene, links: shapely.Geometry) -> Iterable[Part]:
    """Arrows and arcs follow their load; the second arrow of a pair follows where it acts."""
    acting = {a.load.name: a for a in acting_loads(scene.known)}
    for part in load_parts(scene, links):
        name = part.labels[0].name.removeprefix("label-")
        group = part.marks[0]
        assert isinstance(group, MarkGroup)
        yield part._replace(marks=(group._replace(marks=tuple(_arrows(acting[name], group.marks))),))


def _arrows(acting: Acting, marks: Sequence[Mark]) -> Iterable[Mark]:
    load = acting.load
    if isinstance(load, Spring):
        yield MarkGroup("", "", tuple(marks), "", (("data-span", load.name),))
        return
    name = load.name
    yield MarkGroup("", "", tuple(marks[:2]), "", (("data-load", name),))
    if len(marks) > 2:
        other = str(getattr(load.heading, "point", load.at)) if isinstance(load, Force) else ""
        yield MarkGroup("", "", tuple(marks[2:]), "", (("data-load", name), ("data-end", other)))


def _told(label: Label, group: MarkGroup) -> MarkGroup:
    """A label that knows what it follows."""
    kind, _, name = label.name.partition("-")
    x, y = _middle(group)
    data: Data = (("data-x", f"{x:.1f}"), ("data-y", f"{y:.1f}"))
    key = {"point": "data-at", "number": "data-on", "label": "data-label"}[kind]
    own = f"link-number-{name}" if kind == "number" else group.name  # the fields of the page are number-PATH
    return group._replace(name=own, data=((key, name), *data), kind="label")


def _middle(group: MarkGroup) -> Point:
    text = next(mark for mark in group.marks if isinstance(mark, TextMark))
    return text.at
