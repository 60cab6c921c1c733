"""The figure of a mechanism: its parts in order, its labels where they can be read, its captions."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import shapely

from icsolve.construction import Known, Step
from icsolve.draw.centres import centre_parts
from icsolve.draw.frame import belts, frame_parts, joint_parts, point_parts, rims
from icsolve.draw.links import Body, bars, body_of, link_part, outline, wheel_parts
from icsolve.draw.loads import load_parts
from icsolve.draw.marks import Box, Mark
from icsolve.draw.place import Label, Placer
from icsolve.draw.profiled import outline_boxes
from icsolve.draw.scene import Part, Scene, together
from icsolve.draw.shapes import joined
from icsolve.draw.velocities import velocity_parts
from icsolve.draw.view import view_of
from icsolve.draw.wheels import Round, round_things


def scene_of(known: Known, steps: Sequence[Step] = ()) -> Scene:
    """A known scene in the view that suits it and the centres of these steps."""
    shapes = round_things(known.case, known.points)
    used = {name for names in known.case.carries.values() for name in names}
    used |= {at for joint in known.case.joints if (at := getattr(joint, "at", None))}
    boxes = [(*known.points[p], *known.points[p]) for p in known.points if p in used]
    boxes += [*_wheel_boxes(shapes), *outline_boxes(known.case, known.points)]
    centres = [step.centre.place for step in steps if step.centre.kind == "at"]
    finite = [(x, y) for x, y in centres if math.isfinite(x) and math.isfinite(y)]
    view = view_of(boxes, finite, known.size)
    return Scene(known, view, {name: view.at(p) for name, p in known.points.items()}, shapes)


def _wheel_boxes(shapes: Round) -> list[Box]:
    return [
        (w.centre[0] - w.radius, w.centre[1] - w.radius, w.centre[0] + w.radius, w.centre[1] + w.radius)
        for w in shapes.wheels
    ]


def figure_marks(scene: Scene, steps: Sequence[Step] = (), *, velocities: bool = False) -> list[Mark]:
    """The whole figure: frame, links, centres, joints, loads, and all labels."""
    bodies = [body_of(scene, link) for link in scene.case.links if link != scene.case.ground]
    bodies.sort(key=_depth)
    links = joined([bars(body) for body in bodies]) if bodies else shapely.Polygon()
    parts = [
        *wheel_parts(bodies),
        *rims(scene),
        *frame_parts(scene, links),
        *(link_part(scene, body) for body in bodies),
        *belts(scene),
        *joint_parts(scene),
        *centre_parts(scene, steps),
        *load_parts(scene, links),
        *(velocity_parts(scene) if velocities else ()),
        *point_parts(scene),
    ]
    return with_labels(together(parts), scene.view.window)


def _depth(body: Body) -> tuple[int, float]:
    """Rods under blocks, large plates under small ones."""
    return (len(body.blocks), -float(shapely.area(outline(body))))


ORDER = ("t-point", "t-unknown", "t-known", "t-centre", "t-velocity", "t-link")
"""Whose labels choose their places first."""


def with_labels(part: Part, window: Box) -> list[Mark]:
    """The marks of a part and its labels, placed."""
    placer = Placer(part.solid, part.soft, window)
    labels = sorted(part.labels, key=lambda label: ORDER.index(label.kind) if label.kind in ORDER else 9)
    return [*part.marks, *(placer.put(label) for label in _told(labels))]


def _told(labels: Iterable[Label]) -> Iterable[Label]:
    return (label for label in labels if label.runs)
