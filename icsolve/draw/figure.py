"""The figure of a mechanism: its parts in order, its labels where they can be read; the drawing that is
asked for: which steps and panels, what stands above and below them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import combinations

import shapely

from icsolve.case import Case
from icsolve.draw.centres import centre_parts, circle_marks
from icsolve.draw.frame import frame_parts, joint_parts, point_parts, rims, threads
from icsolve.draw.links import DrawnBody, bars, body_of, inside_plate, link_part, outline, wheel_parts
from icsolve.draw.loads import legend, load_parts, velocity_parts
from icsolve.draw.marks import HEIGHT, WIDTH, Box, Mark, Point, bounds, view_of
from icsolve.draw.place import joined
from icsolve.draw.ropes import RopeCourse, belts, courses, filled, free_ends, pulley_parts, rope_marks
from icsolve.draw.scene import (
    Geneva,
    Part,
    Scene,
    aims,
    around,
    geneva_of,
    outlines,
    round_things,
    together,
    with_labels,
)
from icsolve.draw.svg import document
from icsolve.draw.tikz import standalone
from icsolve.draw.words import captioned, description
from icsolve.report.derivation.known import Known, known_of
from icsolve.report.derivation.ratios import Step, all_steps, needed_steps
from icsolve.tuples import NamedTuple

SHORT, LARGER = 52.0, 1.5
"""A mechanism with a link that would be shorter is drawn so many times larger at most."""
FOOT = 10.0
"""How much of the inside of a plate around its pin hides a foot."""
TOGETHER = 0.02
"""Pins that are nearer to each other than this, of the figure's size, count as one."""


def scene_of(known: Known, steps: Sequence[Step] = ()) -> Scene:
    """A known scene in the view that suits it and the centres of these steps."""
    ways = [around(wheel.centre, wheel.radius) for wheel in genevas(known)]
    scene = scene_over(known, steps, ways=ways)
    larger = min(SHORT / max(_shortest(known) * scene.view.scale, 1e-9), LARGER)
    room = (larger * WIDTH, larger * HEIGHT)
    return scene_over(known, steps, ways=ways, room=room) if larger > 1.0 else scene


def genevas(known: Known) -> list[Geneva]:
    """The Geneva wheels among the links."""
    wheels = (geneva_of(known.case, known.points, link) for link in known.case.links)
    return [wheel for wheel in wheels if wheel is not None]


def used_points(case: Case) -> set[str]:
    """The points that a link, a joint or a rope has, and those that loads act toward."""
    used = {name for names in case.carries.values() for name in names} | {*aims(case)}
    used |= {at for joint in case.joints if (at := getattr(joint, "at", None))}
    return used | {p for rope in case.ropes for p in rope.points}


Swept = Callable[[str, Point, float], Box]
"""The room that a circle of a link takes: the link, its centre as written, its radius; case units."""


def scene_over(
    known: Known,
    steps: Sequence[Step],
    swept: Swept = lambda _, p, reach: around(p, reach),
    ways: Sequence[Box] = (),
    room: Point = (WIDTH, HEIGHT),
) -> Scene:
    """A known scene in a room, with all that its links sweep and the ``ways`` of points, and the centres of
    these steps that are not far."""
    case, points = known.case, known.points
    shapes = round_things(case, points)
    boxes = [around(points[p], 0.0) for p in used_points(case) & points.keys()]
    boxes += [swept(wheel.link, wheel.centre, wheel.radius) for wheel in shapes.wheels]
    boxes += [swept(one.wheel, one.centre, 1.05 * math.dist(one.centre, one.at)) for one in shapes.ratchets]
    boxes += [swept(link, corner, 0.0) for link, corners in outlines(case, points) for corner in corners[::6]]
    boxes += [
        swept(link, points[p], radius.value)
        for rope in case.ropes
        for p, link, radius in zip(rope.points, (*rope.links, case.ground), rope.radii, strict=False)
        if radius is not None and p in points
    ]
    centres = [step.centre.place for step in steps if step.centre.kind == "at"]
    finite = [(x, y) for x, y in centres if math.isfinite(x) and math.isfinite(y)]
    view = view_of([*boxes, *ways], finite, known.size, room)
    scene = Scene(known, view, {name: view.at(p) for name, p in points.items()}, shapes)
    return scene._replace(at={**scene.at, **free_ends(scene)})


def _shortest(known: Known) -> float:
    """The length of the shortest link, from pin to pin; infinite where no link has two."""
    ends: dict[str, set[str]] = {}
    for joint in known.case.joints:
        if joint.pivot is not None and joint.pivot in known.points:
            for link in joint.links:
                ends.setdefault(link, set()).add(joint.pivot)
    places = ([known.points[p] for p in sorted(some)] for some in ends.values() if len(some) > 1)
    spans = (max(math.dist(p, q) for p, q in combinations(some, 2)) for some in places)
    return min((span for span in spans if span > TOGETHER * known.size), default=math.inf)


class DrawnMechanism(NamedTuple):
    """What lies under centres and loads: frame, links, ropes and joints; what links and ropes fill."""

    parts: tuple[Part, ...]
    filled: shapely.Geometry
    ropes: tuple[RopeCourse, ...]


def mechanism_of(scene: Scene, *, moving: bool = False) -> DrawnMechanism:
    """The mechanism of a figure. In one that is moving wheels show how they turn, and screws no threads,
    which would stay behind their nuts."""
    bodies = [body_of(scene, link) for link in scene.case.links if link != scene.case.ground]
    bodies.sort(key=lambda body: (len(body.blocks), -float(shapely.area(outline(body)))))  # rods first
    ropes = tuple(courses(scene))
    links = joined([*(bars(body) for body in bodies), *filled(ropes)])
    under = [body for body in bodies if _hides_its_foot(scene, body)]
    parts = (
        *wheel_parts(bodies, spokes=moving),
        *rims(scene),
        *(link_part(scene, body) for body in under),
        *frame_parts(scene, links),
        *(link_part(scene, body) for body in bodies if body not in under),
        *(() if moving else threads(scene)),
        *belts(scene),
        *pulley_parts(ropes),
        *rope_marks(scene, ropes),
        *joint_parts(scene),
    )
    return DrawnMechanism(parts, links, ropes)


def figure_marks(scene: Scene, steps: Sequence[Step], *, velocities: bool) -> list[Mark]:
    """The whole figure: mechanism, centres, loads, and all labels."""
    mechanism = mechanism_of(scene)
    speeds = velocity_parts(scene) if velocities else []
    filled = joined([mechanism.filled, *(soft.geometry for p in speeds for soft in p.soft)])
    parts = [
        *mechanism.parts,
        *centre_parts(scene, steps),
        *load_parts(scene, filled, whole=True),
        *_supports(scene, mechanism.filled),
        *speeds,
        *point_parts(scene),
    ]
    return with_labels(together(parts), scene.view.window)


def _supports(scene: Scene, links: shapely.Geometry) -> list[Part]:
    """The forces of the frame on a structure."""
    if not scene.known.structure:
        return []
    from icsolve.draw.bodies import support_parts

    return support_parts(scene, links)


def _hides_its_foot(scene: Scene, body: DrawnBody) -> bool:
    """Whether a link is so large around its pin on the frame that the foot is drawn above it."""
    plate, pins = inside_plate(body), scene.case.pivots(body.link, scene.case.ground)
    places = (scene.at[pin] for pin in pins if pin in scene.at)
    return any(shapely.contains(plate, shapely.Point(place).buffer(FOOT)) for place in places)


# --- the drawing that is asked for -----------------------------------------------------------------------


PAD = 14.0


class Drawing(NamedTuple):
    """What to draw beside the mechanism and its loads.

    ``centres`` is ``needed``, ``all`` or ``none``; ``step`` cuts the construction after so many
    centres found; ``circle`` adds the Kennedy circle, ``velocities`` the velocities of the points,
    ``bodies`` the free-body diagrams of all links. Without ``captions`` title and answer are left to the
    page around it.
    """

    centres: str = "needed"
    step: int | None = None
    circle: bool = False
    velocities: bool = False
    bodies: bool = False
    captions: bool = True


PLAIN = Drawing()
ASKED = Drawing(centres="none", captions=False)
"""An exercise shows neither answer nor centres; to draw with `Known.as_asked`."""


def draw(case: Case, drawing: Drawing = PLAIN, known: Known | None = None, form: str = "svg") -> str:
    """The drawing of a case as a document, the same bytes every time: ``svg``, or ``tex`` (TikZ).

    A case that has no answer is drawn as far as it is known, with the reason below.
    """
    known = known or known_of(case, reactions=drawing.bodies)
    marks = drawn(known, drawing)
    if form == "tex":
        return standalone(marks, known.title)
    return document(marks, bounds(marks, PAD), known.title, description(known))


def drawn(known: Known, drawing: Drawing) -> list[Mark]:
    """The marks of a drawing."""
    marks, steps = _in_space(known, drawing) if known.case.space is not None else _in_plane(known, drawing)
    if drawing.captions or not marks:
        marks = captioned(known, marks, steps, drawing.step)
    return marks


def _in_space(known: Known, drawing: Drawing) -> tuple[list[Mark], tuple[Step, ...]]:
    """The figure of a case in space, which has no centres."""
    from icsolve.draw.space import space_marks

    sketch, marks = space_marks(known)
    if drawing.bodies:
        from icsolve.draw.space import space_panels

        left, _, right, bottom = bounds(marks)
        marks += space_panels(known, sketch, left, bottom + 30.0, max(right - left, 760.0))
    return marks, ()


def _in_plane(known: Known, drawing: Drawing) -> tuple[list[Mark], tuple[Step, ...]]:
    """Figure, circle and free bodies of a case in the plane."""
    steps = steps_shown(known, drawing)
    scene = scene_of(known, steps)
    marks = figure_marks(scene, steps, velocities=drawing.velocities)
    marks += _beside(scene, steps, drawing, marks)
    marks += _under(scene, drawing, marks)
    return marks, steps


def steps_shown(known: Known, drawing: Drawing) -> tuple[Step, ...]:
    """The centres to draw, in order."""
    if drawing.centres == "none" or known.whole is None or known.case.space is not None:
        return ()
    steps = all_steps(known) if drawing.centres == "all" else needed_steps(known)
    return tuple(s for s in steps if drawing.step is None or s.number <= drawing.step)


def _beside(scene: Scene, steps: Sequence[Step], drawing: Drawing, marks: Sequence[Mark]) -> list[Mark]:
    """The circle diagram, at the right of the figure."""
    if not drawing.circle or not steps:
        return []
    _, top, right, _ = bounds(marks)
    return circle_marks(scene.known, steps, (right + 34.0, top), drawing.step)


def _under(scene: Scene, drawing: Drawing, marks: Sequence[Mark]) -> list[Mark]:
    """The scale of the velocities, and the free bodies, below the figure."""
    found: list[Mark] = []
    left, _, right, bottom = bounds(marks)
    if drawing.velocities:
        scale = legend(scene, (left + 6.0, bottom + 20.0))
        found += [scale] if scale is not None else []
        bottom = max(bottom, bounds(found)[3]) if found else bottom
    if drawing.bodies:
        from icsolve.draw.bodies import body_panels

        found += body_panels(scene, left, bottom + 30.0, max(right - left, 760.0))
    return found
