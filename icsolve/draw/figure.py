"""The figure of a mechanism: its parts in order, its labels where they can be read, its captions."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import combinations

import shapely

from icsolve.case import Pin
from icsolve.construction import Known, Step
from icsolve.draw.centres import centre_parts
from icsolve.draw.frame import belts, frame_parts, joint_parts, point_parts, rims
from icsolve.draw.links import Body, bars, body_of, inside_plate, link_part, outline, wheel_parts
from icsolve.draw.loads import load_parts
from icsolve.draw.marks import Box, Mark
from icsolve.draw.place import Label, Placer
from icsolve.draw.scene import Part, Scene, together
from icsolve.draw.shapes import joined
from icsolve.draw.velocities import velocity_parts
from icsolve.draw.view import HEIGHT, WIDTH, view_of
from icsolve.draw.wheels import Round, round_things

SHORT, LARGER = 52.0, 1.5
"""A mechanism with a link that would be shorter is drawn so many times larger at most."""
FOOT = 10.0
"""How much of the inside of a plate around its pin hides a foot."""
TOGETHER = 0.02
"""Pins that are nearer to each other than this, of the figure's size, count as one."""


def scene_of(known: Known, steps: Sequence[Step] = ()) -> Scene:
    """A known scene in the view that suits it and the centres of these steps."""
    shapes = round_things(known.case, known.points)
    used = {name for names in known.case.carries.values() for name in names}
    used |= {at for joint in known.case.joints if (at := getattr(joint, "at", None))}
    boxes = [(*known.points[p], *known.points[p]) for p in known.points if p in used]
    boxes += [*_wheel_boxes(shapes), *_outline_boxes(known)]
    centres = [step.centre.place for step in steps if step.centre.kind == "at"]
    finite = [(x, y) for x, y in centres if math.isfinite(x) and math.isfinite(y)]
    view = view_of(boxes, finite, known.size)
    larger = min(SHORT / max(_shortest(known) * view.scale, 1e-9), LARGER)
    if larger > 1.0:
        view = view_of(boxes, finite, known.size, (larger * WIDTH, larger * HEIGHT))
    return Scene(known, view, {name: view.at(p) for name, p in known.points.items()}, shapes)


def _shortest(known: Known) -> float:
    """The length of the shortest link, from pin to pin; infinite where no link has two."""
    ends: dict[str, set[str]] = {}
    for joint in known.case.joints:
        if isinstance(joint, Pin) and joint.at in known.points:
            for link in joint.links:
                ends.setdefault(link, set()).add(joint.at)
    places = ([known.points[p] for p in sorted(some)] for some in ends.values() if len(some) > 1)
    spans = (max(math.dist(p, q) for p, q in combinations(some, 2)) for some in places)
    return min((span for span in spans if span > TOGETHER * known.size), default=math.inf)


def _outline_boxes(known: Known) -> list[Box]:
    """The room of the profiles that the case gives."""
    if known.case.profiles is None:
        return []
    from icsolve.draw.profiled import outline_boxes

    return outline_boxes(known.case, known.points)


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
    speeds = velocity_parts(scene) if velocities else []
    under = [body for body in bodies if _hides_its_foot(scene, body)]
    parts = [
        *wheel_parts(bodies),
        *rims(scene),
        *(link_part(scene, body) for body in under),
        *frame_parts(scene, links),
        *(link_part(scene, body) for body in bodies if body not in under),
        *belts(scene),
        *joint_parts(scene),
        *centre_parts(scene, steps),
        *load_parts(scene, _filled(links, speeds)),
        *speeds,
        *point_parts(scene),
    ]
    return with_labels(together(parts), scene.view.window)


def _hides_its_foot(scene: Scene, body: Body) -> bool:
    """Whether a link is so large around its pin on the frame that the foot is drawn above it."""
    plate, both = inside_plate(body), {body.link, scene.case.ground}
    pins = [scene.at[j.at] for j in scene.joints() if isinstance(j, Pin) and both <= set(j.links)]
    return any(shapely.contains(plate, shapely.Point(pin).buffer(FOOT)) for pin in pins)


def _filled(links: shapely.Geometry, parts: Iterable[Part]) -> shapely.Geometry:
    """What the arrow of a load had better not cover."""
    return joined([links, *(soft.geometry for part in parts for soft in part.soft)])


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
