"""The figure of a page: the marks of a drawing, in a view that holds every position, told what they follow.

The script of the page moves each so (`Follows`).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from icsolve.case.joints import Guided
from icsolve.draw.figure import genevas, mechanism_of, scene_over, used_points
from icsolve.draw.frame import point_parts
from icsolve.draw.links import guide_in_picture
from icsolve.draw.loads import load_parts
from icsolve.draw.marks import Box, Mark, MarkGroup, Point, TextMark, bounds
from icsolve.draw.place import Label
from icsolve.draw.ropes import RopeCourse
from icsolve.draw.scene import Scene, around, placed_labels, together
from icsolve.page.columns import Array
from icsolve.page.motion import PageMotion
from icsolve.page.poses import moved
from icsolve.report.derivation.known import Known
from icsolve.report.derivation.ratios import Step
from icsolve.tuples import NamedTuple

ROOM = (430.0, 350.0)
"""The largest that the mechanism is drawn, through all its positions."""


class PageFigure(NamedTuple):
    """The marks of a page's figure, its scene and its window, its ropes as written."""

    scene: Scene
    marks: tuple[Mark, ...]
    window: Box
    ropes: tuple[RopeCourse, ...]


def figure_of(known: Known, steps: Sequence[Step], motion: PageMotion | None) -> PageFigure:
    """The figure in its position as written, without its centres, which the script of the page draws."""
    scene = _scene(known, steps, motion)
    mechanism = mechanism_of(scene, moving=True)
    under = together(mechanism.parts)
    over = together([*load_parts(scene, mechanism.filled), *point_parts(scene)])
    whole = together([under, over])
    going = whole._replace(labels=tuple(label for label in whole.labels if label.follows))
    placed = [_told(label, marks) for label, marks in placed_labels(going, scene.view.window)]
    layers = (
        MarkGroup("mechanism", "", under.marks),
        MarkGroup("centres", "", ()),
        MarkGroup("loads", "", over.marks),
        MarkGroup("labels", "", tuple(placed)),
    )
    left, top, right, bottom = bounds(layers)
    a, b, c, d = scene.view.window
    window = (min(a, left), min(b, top), max(c, right), max(d, bottom))
    return PageFigure(scene, layers, window, mechanism.ropes)


def _told(label: Label, group: MarkGroup) -> MarkGroup:
    """A label that tells what it follows, and from where."""
    x, y = next(mark.at for mark in group.marks if isinstance(mark, TextMark))
    name = f"link-{label.name}" if label.badge else label.name  # the fields of the page are number-PATH
    follows = (*label.follows, ("x", f"{x:.1f}"), ("y", f"{y:.1f}"))
    return group._replace(name=name, kind="label", follows=follows)


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
