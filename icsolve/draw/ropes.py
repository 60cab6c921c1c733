"""Ropes round their pulleys, and belts: straight parts that touch both circles, arcs between them, and the
tension beside each part that has one of its own.

A pulley without a radius is drawn with a small one, each in a place larger than the one before: the strands
of a tackle lie apart as they do on its sheaves.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import shapely

from icsolve.case import Rope
from icsolve.draw.marks import Disc, Mark, MarkGroup, Point, Stroke, TextRun
from icsolve.draw.place import Label, Soft
from icsolve.draw.scene import BeltLoop, Part, Scene, Wheel, around
from icsolve.draw.words import quantity
from icsolve.errors import SceneError
from icsolve.numbers import FLOATS
from icsolve.numbers.units import Number
from icsolve.report.derivation.known import tension_name
from icsolve.screws.ropes import offsets_of, rope_parts
from icsolve.tuples import NamedTuple

SMALL, LARGER = 10.0, 6.0
"""Radius of a pulley that is given none, and by how much the next one in its place is larger."""
AXLE = 3.0
"""Radius of a pulley's pin."""
CHORD = math.radians(6.0)
"""Of an arc the part that is drawn straight."""


class RopeCourse(NamedTuple):
    """A rope as it is drawn (picture units): its straight parts, its whole line, its loose pulleys by their
    points, and the radius of every circle that it goes round, positive where it does so clockwise."""

    rope: Rope
    parts: tuple[tuple[Point, Point], ...]
    line: tuple[Point, ...]
    pulleys: tuple[tuple[str, Disc], ...]
    radii: tuple[float, ...]


def courses(scene: Scene) -> list[RopeCourse]:
    """The ropes of a case whose points are known."""
    ropes = [rope for rope in scene.case.ropes if set(rope.points) <= scene.known.points.keys()]
    return [course for rope in ropes if (course := _course(scene, rope)) is not None]


def _course(scene: Scene, rope: Rope) -> RopeCourse | None:
    for one in (
        _with_pulleys(scene, rope),
        rope,
    ):  # of small pulleys that are too large for the figure, points
        try:
            return _laid(scene, one)
        except SceneError:
            continue
    return None


def _with_pulleys(scene: Scene, rope: Rope) -> Rope:
    """A rope with a radius and a sense at each pulley."""
    radii, wraps = list(rope.radii), list(rope.wraps)
    places = [scene.known.points[p] for p in rope.points]
    for k in range(1, len(places) - 1):
        if radii[k] is None:
            size = SMALL + LARGER * places[1:k].count(places[k])
            radii[k] = _number(size / scene.view.scale)
        if wraps[k] is None:
            (ax, ay), (bx, by), (cx, cy) = places[k - 1 : k + 2]
            wraps[k] = "cw" if (bx - ax) * (cy - by) - (by - ay) * (cx - bx) < 0.0 else "ccw"
    return rope._replace(radii=tuple(radii), wraps=tuple(wraps))


def free_ends(scene: Scene) -> dict[str, Point]:
    """Where the free ends of ropes are drawn: beside the rim of their last pulley."""
    ropes = [rope for rope in scene.case.ropes if rope.is_free]
    placed = [rope for rope in ropes if set(rope.points) <= scene.known.points.keys()]
    return {rope.points[-1]: scene.view.at(_free_end(scene, _with_pulleys(scene, rope))) for rope in placed}


def _free_end(scene: Scene, rope: Rope) -> Point:
    (ax, ay), (bx, by) = (scene.known.points[p] for p in rope.points[-2:])
    given = next(own for own in scene.case.ropes if own.name == rope.name).radii[-2]
    radius, span = rope.radii[-2], math.dist((ax, ay), (bx, by))
    if radius is None or given is not None or span == 0.0:
        return (bx, by)
    aside = radius.value / span * (1.0 if rope.wraps[-2] == "ccw" else -1.0)
    return (bx + aside * (by - ay), by - aside * (bx - ax))


def _number(value: float) -> Number:
    return Number(value, 0.0, "", repr(value))


def _laid(scene: Scene, rope: Rope) -> RopeCourse:
    """A rope round its circles; raises SceneError where it has no straight part between two of them."""
    straight, points = [], scene.known.points
    if rope.is_free:
        points = {**points, rope.points[-1]: _free_end(scene, rope)}
    for part in rope_parts(rope, points, 1.0, FLOATS):
        (x, y), (u, v), length = part.at, part.along, float(part.length)
        straight.append(((x, y), (x + length * u, y + length * v)))
    line: list[Point] = [*straight[0]]
    scale, pulleys = scene.view.scale, []
    for k in range(1, len(straight)):
        centre, radius = scene.known.points[rope.points[k]], rope.radii[k]
        line += _arc(centre, straight[k - 1][1], straight[k][0], rope.wraps[k] == "ccw")
        line += straight[k]
        if radius is not None and rope.mu[k] is None:
            pulleys.append((rope.points[k], Disc(scene.view.at(centre), radius.value * scale, "body")))
    parts = tuple((scene.view.at(a), scene.view.at(b)) for a, b in straight)
    radii = tuple(-scale * float(offset) for offset in offsets_of(rope, 1.0, FLOATS))
    return RopeCourse(rope, parts, tuple(map(scene.view.at, line)), tuple(pulleys), radii)


def _arc(centre: Point, start: Point, end: Point, ccw: bool) -> Iterable[Point]:
    """Points between two of a circle."""
    radius = math.dist(centre, start)
    first, last = (math.atan2(p[1] - centre[1], p[0] - centre[0]) for p in (start, end))
    turned = (last - first if ccw else first - last) % (2.0 * math.pi)
    count = int(turned / CHORD) if radius and turned < 2.0 * math.pi - CHORD else 0
    for n in range(1, count + 1):
        angle = first + (1.0 if ccw else -1.0) * turned * n / (count + 1)
        yield (centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle))


def filled(ropes: Sequence[RopeCourse]) -> list[shapely.Geometry]:
    """What ropes and their pulleys fill: feet and arrows keep off them."""
    lines = [shapely.LineString(rope.line).buffer(3.0, quad_segs=1) for rope in ropes]
    return [*lines, *(shapely.Point(d.centre).buffer(d.radius) for rope in ropes for _, d in rope.pulleys)]


def pulley_parts(ropes: Sequence[RopeCourse]) -> list[Part]:
    """The pulleys in each place with their pins, the largest first."""
    found: dict[str, tuple[Mark, ...]] = {}
    every = dict.fromkeys(pulley for rope in ropes for pulley in rope.pulleys)
    for name, disc in sorted(every, key=lambda pulley: -pulley[1].radius):
        found[name] = (*found.get(name, ()), disc, Disc(disc.centre, AXLE, "pin"))
    places = tuple(MarkGroup("", "", marks, follows=(("at", name),)) for name, marks in found.items())
    return [Part((MarkGroup("pulleys", "", places, "pulleys"),))] if places else []


def rope_marks(scene: Scene, ropes: Sequence[RopeCourse]) -> list[Part]:
    """The ropes, and the tensions."""
    parts = []
    for rope in ropes:
        name, line = rope.rope.name, Stroke(rope.line, "rope")
        group = MarkGroup(f"rope-{name}", "", (line,), f"rope {name}", follows=(("rope", name),))
        solid = tuple(around(disc.centre, AXLE) for _, disc in rope.pulleys)
        rims = (shapely.Point(disc.centre).buffer(disc.radius).boundary for _, disc in rope.pulleys)
        soft = (Soft(shapely.LineString(rope.line), 3.0), *(Soft(ring, 1.5) for ring in rims))
        parts.append(Part((group,), soft, solid, tuple(_tensions(scene, rope))))
    return parts


def _tensions(scene: Scene, course: RopeCourse) -> Iterable[Label]:
    """The tension beside the longest part, of a rope that slips beside every part."""
    answer, name = scene.known.answer, course.rope.name
    found = next((t for t in (answer.tensions if answer else ()) if t.rope == name), None)
    if found is None or found.tension is None:
        return
    longest = max(course.parts, key=lambda ends: math.dist(*ends))
    shown = [(0, found.tension, longest)]
    if found.parts:
        shown = [(n, *one) for n, one in enumerate(zip(found.parts, course.parts, strict=True), 1)]
    for n, pull, ((ax, ay), (bx, by)) in shown:
        base, low = tension_name(scene.case, course.rope, n)
        runs = (TextRun(base), TextRun(low, True), TextRun(f" = {quantity(pull, scene.case.units.force)}"))
        spots = tuple((ax + s * (bx - ax), ay + s * (by - ay)) for s in (0.5, 0.35, 0.65))
        yield Label(f"tension-{name}-{n}", tuple(r for r in runs if r.text), "t-reaction", 13.0, spots, 6.0)


def belts(scene: Scene) -> list[Part]:
    """The two strands of each belt; they go round with the link that carries both wheels."""
    parts = []
    for loop in scene.round.loops:
        strands = [Stroke(ends, "rope") for ends in _strands(scene, loop)]
        soft = tuple(Soft(shapely.LineString(strand.points), 2.0) for strand in strands)
        name, carriers = f"belt-{loop.first.link}-{loop.second.link}", _carriers(scene, loop)
        follows = tuple(("turn", link) for link in carriers[:1])
        parts.append(Part((MarkGroup(name, "", tuple(strands), "belt", follows=follows),), soft))
    return parts


def _carriers(scene: Scene, loop: BeltLoop) -> list[str]:
    """The moving links about whose pins both wheels turn."""

    def pinned(link: str, wheel: Wheel) -> bool:
        return any(scene.known.points.get(p) == wheel.centre for p in scene.case.pivots(link, wheel.link))

    links = (link for link in scene.case.links if link != scene.case.ground)
    return [link for link in links if pinned(link, loop.first) and pinned(link, loop.second)]


def _strands(scene: Scene, loop: BeltLoop) -> Iterable[tuple[Point, Point]]:
    """A belt is a rope to the second wheel and back."""
    points = {"A": loop.first.centre, "B": loop.second.centre}
    radii = tuple(_number(wheel.radius) for wheel in (loop.first, loop.second, loop.first))
    wraps = ("ccw", "cw" if loop.crossed else "ccw", "ccw")
    try:
        return _laid(
            scene._replace(known=scene.known._replace(points=points)),
            Rope("", ("A", "B", "A"), ("", "", ""), radii, wraps, (None,) * 3),
        ).parts
    except SceneError:
        return ()
