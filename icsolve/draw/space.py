"""A case in space, seen from above and aside: shafts and members, bearings, gears, loads.

Couples are arrows with two heads along their axis, by the right-hand rule.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise

import shapely

from icsolve.answer.bodies import Parts
from icsolve.case import is_named
from icsolve.draw.bodies import BUT_SMALL, NOTHING, TO_SCALE, panel, titled
from icsolve.draw.marks import (
    AreaMark,
    Box,
    Disc,
    Mark,
    MarkGroup,
    Point,
    Stroke,
    TextMark,
    TextRun,
    View,
    along,
    arrow,
    bounds,
    head,
    plain_text,
    unit,
    view_of,
)
from icsolve.draw.place import Label, Soft, area, bar, hatched, joined, plate, tilted
from icsolve.draw.scene import HALF, PIN, Part, aims, around, together, with_labels
from icsolve.draw.words import figure_number, force_runs, name_runs, quantity, unit_word
from icsolve.report.derivation.known import Known
from icsolve.report.derivation.spatial import InSpace, Push, in_space
from icsolve.screws import add, cross, subtract
from icsolve.screws.space import AXES, ZERO, Vec, dot, size, times
from icsolve.statics.space.reaction_basis import SpatialTie
from icsolve.tuples import NamedTuple

TURN, RISE = math.radians(32.0), math.radians(24.0)
"""Where the picture is seen from: turned about z, and raised."""
RIGHT: Vec = (math.cos(TURN), math.sin(TURN), 0.0)
UP: Vec = (-math.sin(RISE) * math.sin(TURN), math.sin(RISE) * math.cos(TURN), math.cos(RISE))
ARROW = 58.0
LEAST = 13.0
EDGE_ON = 0.22
"""A direction of which the picture shows less than this fraction points at the reader, or away."""


def flat(p: Vec) -> Point:
    """A place as the picture has it, y up."""
    return (dot(p, RIGHT), dot(p, UP))


class Sketch(NamedTuple):
    """A case in space in a view."""

    scene: InSpace
    view: View

    def at(self, p: Vec) -> Point:
        """A place in the picture."""
        return self.view.at(flat(p))


def space_marks(known: Known) -> tuple[Sketch, list[Mark]]:
    """The figure of a case in space."""
    scene = in_space(known)
    used = _used(scene)
    points = [flat(p) for p in (*used, *(q for ring in _rings(scene).values() for q in ring))]
    extent = max((math.dist(p, q) for p in points for q in points), default=0.0)
    sketch = Sketch(scene, view_of([(*p, *p) for p in points], (), extent))
    solid = joined([outline_of(sketch, link) for link in moving_links(scene)] or [shapely.Polygon()])
    parts = [*(body_part(sketch, link) for link in moving_links(scene))]
    parts += [part for tie in scene.ties for part in _joint(sketch, tie)]
    drawn: list[Soft] = []
    for push in scene.loads:
        parts.append(_load(sketch, push, solid, drawn))
        drawn += parts[-1].soft
    parts += _letters(sketch)
    marks = with_labels(together(parts), sketch.view.window)
    return sketch, [*marks, _triad(bounds(marks))]


def moving_links(scene: InSpace) -> list[str]:
    return [link for link in scene.case.links if link != scene.case.ground]


def _rings(scene: InSpace) -> dict[tuple[str, int], list[Vec]]:
    """The pitch circles of gears, by link and number."""
    rings = {}
    for n, tie in enumerate(scene.ties):
        mesh = tie.mesh
        centres: tuple[str, ...] = getattr(tie.joint, "centres", ())
        if mesh is None or any(c not in scene.places for c in centres):
            continue
        for link, centre, radius in zip(tie.joint.links, centres, mesh.radii, strict=False):
            rings[(link, n)] = _circle(scene.places[centre], mesh.axis, radius)
    return rings


def _circle(centre: Vec, axis: Vec, radius: float) -> list[Vec]:
    first = cross(axis, min(AXES, key=lambda e: abs(dot(e, axis))))
    first = times(1.0 / size(first), first)
    second = cross(axis, first)
    angles = (2.0 * math.pi * k / 48 for k in range(48))
    return [
        add(centre, add(times(radius * math.cos(a), first), times(radius * math.sin(a), second)))
        for a in angles
    ]


def _axis(scene: InSpace, link: str) -> tuple[Vec, Vec] | None:
    """A point and the direction of the line of a link's bearings or hinge."""
    for tie in scene.ties:
        if link in (tie.by, tie.on) and not tie.mesh and size(tie.axis) > 0.5:
            return scene.at(tie), tie.axis
    return None


def _bones(scene: InSpace, link: str) -> list[tuple[Vec, Vec]]:
    """The lines of a link's members: its shaft, and arms from there to its other points."""
    points = scene.carried(link)
    line = _axis(scene, link)
    if line is None:
        return list(pairwise(points))
    start, axis = line
    feet = [add(start, times(dot(subtract(p, start), axis), axis)) for p in points]
    heights = sorted((dot(subtract(foot, start), axis), foot) for foot in feet)
    bones = [(heights[0][1], heights[-1][1])] if heights[-1][0] - heights[0][0] > 0.0 else []
    apart = zip(feet, points, strict=True)
    return [*bones, *((foot, p) for foot, p in apart if size(subtract(foot, p)) > 1e-9 * size(p))]


def outline_of(sketch: Sketch, link: str) -> shapely.Geometry:
    shapes = [bar([sketch.at(a), sketch.at(b)], HALF) for a, b in _bones(sketch.scene, link)]
    if _axis(sketch.scene, link) is None and len(sketch.scene.carried(link)) > 2:
        shapes = [plate([sketch.at(p) for p in sketch.scene.carried(link)], HALF)]
    return joined(shapes) if shapes else shapely.Polygon()


def body_part(sketch: Sketch, link: str) -> Part:
    shape = outline_of(sketch, link)
    wheels = [ring for (owner, _), ring in _rings(sketch.scene).items() if owner == link]
    marks: list[Mark] = [AreaMark((tuple(sketch.at(p) for p in ring),), "wheel") for ring in wheels]
    marks += [] if shape.is_empty else [area(shape, "body")]
    soft = [] if shape.is_empty else [Soft(shape, 1.6)]
    soft += [Soft(shapely.LinearRing([sketch.at(p) for p in ring]), 1.5) for ring in wheels]
    bones = [(sketch.at(a), sketch.at(b)) for a, b in _bones(sketch.scene, link)]
    anchors = [((a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0) for a, b in bones]
    anchors += [sketch.at(p) for p in sketch.scene.carried(link)]
    group = MarkGroup(f"link-{link}", "", tuple(marks), f"link {link}")
    label = Label(f"number-{link}", (TextRun(link),), "t-link", 12.0, tuple(anchors[:8]), 10.0, badge=True)
    return Part((group,) if marks else (), tuple(soft), (), (label,) if anchors else ())


def _joint(sketch: Sketch, tie: SpatialTie) -> Iterable[Part]:
    """A bearing as a sleeve along its axis, a ball as a ring, a weld as a square; the frame's are hatched."""
    if tie.mesh is not None:
        return
    p, name = sketch.at(sketch.scene.at(tie)), f"joint-{tie.joint_kind}-{tie.where}-{tie.by}-{tie.on}"
    u = _seen(tie.axis)
    if size(tie.axis) > 0.5:
        symbol: Mark = area(tilted(p, unit(*u), max(24.0 * math.hypot(*u), 12.0), 17.0), "block")
    elif tie.joint_kind == "weld":
        symbol = area(shapely.box(p[0] - 4.0, p[1] - 4.0, p[0] + 4.0, p[1] + 4.0), "pin")
    else:
        symbol = Disc(p, PIN, "pin")
    marks: list[Mark] = [symbol]
    soft: list[Soft] = []
    if sketch.scene.case.ground in (tie.by, tie.on):
        ends = (p[0] - 15.0, p[1] + 12.0), (p[0] + 15.0, p[1] + 12.0)
        marks += hatched(ends[0], ends[1], 1.0)
        soft.append(Soft(shapely.box(p[0] - 15.0, p[1] + 8.0, p[0] + 15.0, p[1] + 20.0), 1.5))
    yield Part(
        (MarkGroup(name, "", tuple(marks), f"{tie.joint_kind} of {tie.by} and {tie.on}"),),
        tuple(soft),
        (around(p, 8.0),),
    )


def _seen(direction: Vec) -> Point:
    """A direction in the picture (y down), shorter as it points at the reader."""
    x, y = flat(direction)
    return (x, -y)


def _load(sketch: Sketch, push: Push, solid: shapely.Geometry, drawn: Sequence[Soft]) -> Part:
    """A load, and between two links the opposite one with its name alone."""
    kind, runs, name = _kind(push), _load_runs(push), f"label-{push.name}"
    sign = -1.0 if dot(add(push.force, push.couple), push.direction) < 0.0 else 1.0
    acts = [(name, runs, sign, _acts_at(sketch, push.link, push.at))]
    if push.against != sketch.scene.case.ground:
        end = _acts_at(sketch, push.against, push.end)
        acts.append((f"{name}-opposite", name_runs(push.name), -sign, end))
    arrows: list[Mark] = []
    soft: list[Soft] = []
    labels = []
    for label, words, way, at in acts:
        room = (solid, (*drawn, *soft))
        marks, far = vector(at, times(way, push.direction), ARROW, kind, room, double=push.at is None)
        arrows += marks
        soft.append(along_arrow(at, far))
        labels.append(Label(label, words, f"t-{kind}", 14.0, (far, at), 7.0))
    group = MarkGroup(f"load-{push.name}", "", tuple(arrows), plain_text(runs))
    return Part((group,), tuple(soft), (), tuple(labels))


def _kind(push: Push) -> str:
    return "unknown" if push.unknown else "known"


def _load_runs(push: Push) -> tuple[TextRun, ...]:
    value = "?" if push.value is None else quantity(abs(push.value), push.unit)
    return (*name_runs(push.name), TextRun(f" = {value}"))


def _acting(push: Push, unit: str) -> Push:
    """A load as the force that it is: of a spring not its stiffness, of a mass its weight."""
    return push if push.value is None else push._replace(value=size(push.force), unit=unit)


def along_arrow(at: Point, far: Point) -> Soft:
    """The room of an arrow, and a little beyond its end."""
    shape = shapely.Point(at) if at == far else shapely.LineString([at, far])
    return Soft(shape.buffer(9.0, quad_segs=1), 4.0)


def _acts_at(sketch: Sketch, link: str, at: Vec | None) -> Point:
    """A place in the picture; of a couple on its link's axis."""
    if at is not None:
        return sketch.at(at)
    line = _axis(sketch.scene, link)
    carried = sketch.scene.carried(link)
    if line is not None:
        ends = [sketch.at(b) for _, b in _bones(sketch.scene, link)[:1]]
        return ends[0] if ends else sketch.at(line[0])
    return sketch.at(carried[0]) if carried else (0.0, 0.0)


Room = tuple[shapely.Geometry, Sequence[Soft]]
"""The links that an arrow had better not hide, and the arrows with which it must not fuse."""


def vector(
    at: Point, direction: Vec, length: float, kind: str, room: Room, *, double: bool = False
) -> tuple[tuple[Mark, ...], Point]:
    """An arrow from or onto a point, or farther along its line where others are; and its far end. One that
    points at the reader is a dot in a ring."""
    seen = _seen(direction)
    share = math.hypot(*seen)
    if share < EDGE_ON:
        toward = dot(direction, cross(RIGHT, UP)) > 0.0
        inner: list[Mark] = [Disc(at, 2.0, f"{kind}-head")]
        if not toward:
            inner = [Stroke(((at[0] - 5, at[1] - 5), (at[0] + 5, at[1] + 5)), kind)]
            inner.append(Stroke(((at[0] - 5, at[1] + 5), (at[0] + 5, at[1] - 5)), kind))
        return (Disc(at, 8.0, kind), *inner), at
    u = unit(*seen)
    reach = max(length * share, LEAST)
    solid, drawn = room

    def in_the_way(start: float) -> float:
        """So much of the arrow, of its width of 12: of the links once, of arrows twice; farther off is
        nearly as bad."""
        line = shapely.LineString([along(at, u, start), along(at, u, start + reach)])
        fused = sum(shapely.length(shapely.intersection(line, other.geometry)) for other in drawn)
        farther = max(-start - 8.0 - reach, start - 8.0) / (reach + 20.0)
        hidden = shapely.area(shapely.intersection(line.buffer(6.0), solid)) / 12.0
        return float(hidden + 2.0 * fused + 1.8 * reach * farther)

    steps = [n * (reach + 20.0) for n in range(3)]
    starts = [start for step in steps for start in (-8.0 - reach - step, 8.0 + step)]
    start = min(starts, key=in_the_way)
    tail, tip = along(at, u, start), along(at, u, start + reach)
    marks = arrow(tail, tip, kind)
    if double:
        marks = (*marks, head(along(tip, u, -9.0), u, f"{kind}-head"))
    return marks, max((tail, tip), key=lambda p: math.dist(p, at))


def _used(scene: InSpace) -> list[Vec]:
    """Where points are that links carry, or toward which loads act."""
    carried = [p for link in scene.case.links for p in scene.carried(link)]
    return [*carried, *(scene.places[p] for p in aims(scene.case) if p in scene.places)]


def _letters(sketch: Sketch) -> list[Part]:
    """The names of these points."""
    scene = sketch.scene
    used = _used(scene)
    jointed = {tie.where for tie in scene.ties if not tie.mesh}
    parts = []
    for name, place in scene.places.items():
        if place in used and is_named(name):
            p = sketch.at(place)
            label = Label(
                f"point-{name}", name_runs(name), "t-point", 15.0, (p,), 9.0 if name in jointed else 5.0
            )
            dot_mark = () if name in jointed else (Disc(p, 2.2, "dot"),)
            parts.append(Part(dot_mark, (), (around(p, 2.6),), (label,)))
    return parts


def _triad(box: Box) -> MarkGroup:
    """The directions of the axes, at the lower left of the figure."""
    origin = (box[0] + 8.0, box[3] + 56.0)
    marks: list[Mark] = []
    for name, axis in zip("xyz", AXES, strict=True):
        u = _seen(axis)
        tip = (origin[0] + 34.0 * u[0], origin[1] + 34.0 * u[1])
        marks += arrow(origin, tip, "far", 7.0)
        marks.append(TextMark(along(tip, unit(*u), 9.0), (TextRun(name),), "t-note", 12.0))
    return MarkGroup("axes", "", tuple(marks), "the axes")


# --- free bodies -----------------------------------------------------------------------------------------


def space_panels(known: Known, sketch: Sketch, left: float, top: float, width: float) -> list[Mark]:
    """Every link by itself with the forces and couples on it, forces to one scale."""
    spatial = known.answer.spatial if known.answer is not None else None
    if spatial is None:
        return []
    pushes = {link: list(_pushes(sketch, known, link)) for link in moving_links(sketch.scene)}
    largest = max((size(f) for some in pushes.values() for _, _, f, _, _ in some), default=0.0) or 1.0
    panels = [_panel(sketch, link, some, largest) for link, some in pushes.items()]
    forces = [f for some in pushes.values() for _, _, f, _, _ in some if size(f) > NOTHING * largest]
    seen = [math.hypot(*_seen(f)) for f in forces if math.hypot(*_seen(f)) >= EDGE_ON * size(f)]
    small = any(ARROW * one < LEAST * largest for one in seen)
    return titled(panels, left, top, width, BUT_SMALL if small else TO_SCALE)


On = tuple[str, tuple[TextRun, ...], Vec, Vec, tuple[str, Vec]]


def _pushes(sketch: Sketch, known: Known, link: str) -> Iterable[On]:
    """Name, words, force, couple, and kind with place, of all that acts on a link."""
    assert known.answer is not None and known.answer.spatial is not None
    units = known.case.units
    for name, r in known.answer.spatial.reactions.of_link(link):
        words = _sized(r.force, r.magnitude, units.force)
        words += "" if r.moment == 0.0 else f", M = {_sized(r.couple, r.moment, units.torque)}"
        runs: tuple[TextRun, ...] = (*force_runs(name, r.by, r.on, r.where), TextRun(f" = {words}"))
        force, couple = ((x or 0.0, y or 0.0, z or 0.0) for x, y, z in (r.force, r.couple))
        yield f"reaction-{name}-on-{r.on}", runs, force, couple, ("reaction", r.at)
    for push in sketch.scene.loads:
        if link in (push.link, push.against):
            sign = 1.0 if link == push.link else -1.0
            place = push.at if link == push.link else push.end
            place = place or next(iter(sketch.scene.carried(link)), ZERO)
            force, couple = times(sign, push.force), times(sign, push.couple)
            told = _load_runs(push if push.at is None else _acting(push, units.force))
            yield f"body-load-{push.name}-on-{link}", told, force, couple, (_kind(push), place)


def _sized(parts: Parts, whole: float | None, unit: str) -> str:
    """The size of a force or couple; where equilibrium leaves some of it open its parts along x, y and z."""
    if whole is not None:
        return quantity(whole, unit)
    told = ["?" if part is None else figure_number(part) for part in parts]
    return f"({', '.join(told)}) {unit_word(unit)}" if {*told} != {"?"} else "?"


def _panel(sketch: Sketch, link: str, pushes: Sequence[On], largest: float) -> list[Mark]:
    solid, parts = outline_of(sketch, link), [body_part(sketch, link)]
    drawn: list[Soft] = []
    for name, words, force, couple, (kind, place) in pushes:
        at = sketch.at(place)
        marks: tuple[Mark, ...] = ()
        far, soft = at, []
        if size(force) > NOTHING * largest:
            direction = times(1.0 / size(force), force)
            marks, far = vector(at, direction, ARROW * size(force) / largest, kind, (solid, drawn))
            soft.append(along_arrow(at, far))
            drawn += soft
        if size(couple):
            way = times(1.0 / size(couple), couple)
            more, end = vector(at, way, 0.6 * ARROW, kind, (solid, drawn), double=True)
            marks, far = (*marks, *more), (far if far != at else end)
            soft.append(along_arrow(at, end))
            drawn.append(soft[-1])
        label = Label(f"label-{name}", words, f"t-{kind}", 12.5, (far, at), 7.0)
        group = (MarkGroup(name, "", marks, plain_text(words)),) if marks else ()
        parts.append(Part(group, tuple(soft), (around(at, 2.8),), (label,)))
    return panel(link, parts)
