"""The loads: forces and weights as arrows, torques as arcs, springs as coils; the unknown in its own colour
with the answer beside it."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import shapely

from icsolve.arithmetic import FLOATS
from icsolve.case import Force, ForceVector, Like, Load, Pin, Spring, Torque, Weight
from icsolve.draw.arrows import arrow, turning
from icsolve.draw.marks import Group, Mark, Point, Run, Stroke
from icsolve.draw.place import Label, Soft
from icsolve.draw.scene import Part, Scene, fixed_springs
from icsolve.draw.view import along, unit
from icsolve.draw.words import name_runs, quantity
from icsolve.errors import SceneError
from icsolve.power import direction, is_unknown, vector_size
from icsolve.sense import unit_of

ARROW = 56.0
"""Length of a load's arrow."""
ARC = 25.0
"""Radius of a torque's arc."""


class Shown(NamedTuple):
    """A load's number: None where it was not found; ``unknown`` where it is asked for."""

    value: float | None
    unit: str
    unknown: bool

    @property
    def kind(self) -> str:
        """The class of its marks."""
        return "unknown" if self.unknown else "known"


def shown(scene: Scene, load: Load) -> Shown:
    """The number of a load, as the case gives it or as it was found."""
    unit_name = unit_of(load, scene.case)
    by_name = {other.name: other for other in scene.case.loads}
    root, ratio = load, 1.0
    while not isinstance(root, ForceVector) and isinstance(root.value, Like):
        ratio *= root.value.times.value if root.value.times else 1.0
        root = by_name[root.value.load]
    if isinstance(root, ForceVector):
        return Shown(ratio * vector_size(root), unit_name, False)
    if not is_unknown(root):
        assert root.value is not None and not isinstance(root.value, Like)
        return Shown(ratio * root.value.value, unit_name, False)
    answer = scene.known.answer
    found = None if answer is None else answer.answers.get(load.name)
    return Shown(None if found is None else found.value, unit_name, True)


def load_parts(scene: Scene, links: shapely.Geometry) -> list[Part]:
    """Every load whose place is known."""
    parts = []
    turned: dict[Point, int] = {}
    for load in scene.case.loads:
        number = shown(scene, load)
        if isinstance(load, Torque):
            part = _torque(scene, load, number, turned)
        elif load.at not in scene.at:
            continue
        elif isinstance(load, Spring):
            part = _spring(scene, load, number)
        else:
            part = _force(scene, load, number, links)
        if part is not None:
            parts.append(part)
    return parts


def _words(scene: Scene, load: Load, number: Shown) -> tuple[Run, ...]:
    """``T_12 = 33.76 lbf·in cw``."""
    name = name_runs(load.name)
    if number.value is None:
        return (*name, Run(" = ?"))
    text = f" = {quantity(abs(number.value), number.unit)}"
    if isinstance(load, Torque):
        text += " ccw" if _is_ccw(load, number) else " cw"
    if isinstance(load, Spring):
        text = f": k{text}"
    return (*name, Run(text if number.value else f" = {quantity(0.0, number.unit)}"))


def _is_ccw(load: Torque, number: Shown) -> bool:
    return ((number.value or 0.0) >= 0.0) == (load.turns == "ccw")


def _heading(scene: Scene, load: Force | ForceVector | Weight, number: Shown) -> Point | None:
    """Unit vector in the picture of the force as it acts; None where a point that it needs is not known."""
    if isinstance(load, Weight):
        x, y = 0.0, -1.0
    elif isinstance(load, ForceVector):
        x, y = unit(load.x.value, load.y.value)
    else:
        try:
            x, y = direction(load, scene.known.points, FLOATS)
        except (KeyError, ZeroDivisionError, SceneError):
            return None
    sign = -1.0 if (number.value or 0.0) < 0.0 else 1.0
    return (sign * x, -sign * y)


def _force(
    scene: Scene, load: Force | ForceVector | Weight, number: Shown, links: shapely.Geometry
) -> Part | None:
    at, u = scene.at[load.at], _heading(scene, load, number)
    if u is None:
        return None
    ends = min(_ways(at, u, isinstance(load, Weight)), key=lambda way: _hidden(scene, way, links))
    lines = [ends[:2]]
    against = getattr(load, "against", None)
    if against not in (None, scene.case.ground):
        partner = _partner(scene, load)
        lines.append((along(partner, u, -8.0), along(partner, u, -8.0 - ARROW)))
    marks = tuple(mark for tail, tip in lines for mark in arrow(tail, tip, number.kind))
    soft = tuple(Soft(shapely.LineString(line).buffer(4.0, quad_segs=1), 4.0) for line in lines)
    tail, tip = lines[0]
    outer, inner = (tail, tip) if math.dist(tail, at) > math.dist(tip, at) else (tip, tail)
    middle = ((outer[0] + inner[0]) / 2.0, (outer[1] + inner[1]) / 2.0)
    return _with_label(scene, load, number, marks, soft, (outer, along(outer, unit(at[0] - outer[0], at[1] - outer[1]), 12.0), middle))


def _ways(at: Point, u: Point, weight: bool) -> list[tuple[Point, Point, float]]:
    """From the point outward (a pull), or from outside onto it (a push), and what speaks against each."""
    pull = (along(at, u, 8.0), along(at, u, 8.0 + ARROW), 0.0 if weight else 30.0)
    push = (along(at, u, -8.0 - ARROW), along(at, u, -8.0), 60.0 if weight else 0.0)
    return [push, pull]


def _hidden(scene: Scene, way: tuple[Point, Point, float], links: shapely.Geometry) -> float:
    """How much of the links an arrow would hide, and how far it leaves the window."""
    tail, tip, bias = way
    shape = shapely.LineString([tail, tip]).buffer(6.0, quad_segs=1)
    out = 0.0 if scene.view.holds(tail) and scene.view.holds(tip) else 200.0
    return float(shapely.area(shapely.intersection(shape, links))) + bias + out


def _partner(scene: Scene, load: Load) -> Point:
    """Where the opposite of a force between two links acts: the point that it is toward, or its own."""
    heading = getattr(load, "heading", None)
    name = getattr(heading, "point", None)
    at = getattr(load, "at", "")
    return scene.at[name if name in scene.at else at]


def _spring(scene: Scene, load: Spring, number: Shown) -> Part | None:
    if load.to not in scene.at:
        return None
    a, b = scene.at[load.at], scene.at[load.to]
    line = Stroke(tuple(_coil(a, b)), "unknown" if number.unknown else "spring")
    soft = (Soft(shapely.LineString([a, b]).buffer(7.0, quad_segs=1), 3.0),)
    middle = [(a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])) for s in (0.5, 0.35, 0.65)]
    return _with_label(scene, load, number, (line,), soft, tuple(middle), gap=10.0)


def _coil(a: Point, b: Point) -> Iterable[Point]:
    """A zigzag between two points with straight ends."""
    span = math.dist(a, b)
    u = unit(b[0] - a[0], b[1] - a[1])
    v = (-u[1], u[0])
    lead = min(16.0, 0.2 * span)
    count = max(int((span - 2.0 * lead) / 7.0), 4)
    yield a
    yield along(a, u, lead)
    for k in range(count):
        middle = along(a, u, lead + (k + 0.5) * (span - 2.0 * lead) / count)
        yield along(middle, v, 6.5 if k % 2 else -6.5)
    yield along(b, u, -lead)
    yield b


def _torque(scene: Scene, load: Torque, number: Shown, turned: dict[Point, int]) -> Part | None:
    centre = _axle(scene, load.link)
    if centre is None:
        return None
    earlier = turned.setdefault(centre, 0)
    turned[centre] += 1
    radius = ARC + 11.0 * earlier
    others = [scene.at[p] for p in scene.case.carries.get(load.link, ()) if p in scene.at]
    far = max(others, key=lambda p: math.dist(p, centre), default=centre)
    gap = math.degrees(math.atan2(centre[1] - far[1], far[0] - centre[0])) if far != centre else 270.0
    ccw = _is_ccw(load, number)
    marks = turning(centre, radius, gap + (50.0 if ccw else -50.0), ccw, number.kind)
    ring = shapely.Point(centre).buffer(radius + 3.0).difference(shapely.Point(centre).buffer(radius - 3.0))
    sides = tuple(along(centre, unit(math.cos(a), math.sin(a)), radius) for a in (0.0, math.pi, -1.57, 1.57, -0.8, 2.4))
    return _with_label(scene, load, number, marks, (Soft(ring, 4.0),), sides)


def _axle(scene: Scene, link: str) -> Point | None:
    """The point about which a torque's arc is drawn: a pin of the link with the frame, else another."""
    pins = [j for j in scene.joints() if isinstance(j, Pin) and link in j.links]
    pins.sort(key=lambda joint: scene.case.ground not in joint.links)
    if pins:
        return scene.at[pins[0].at]
    own = scene.known.centre(scene.case.ground, link)
    if own is not None and own.kind == "at":
        place = scene.view.at((own.place[0], own.place[1]))
        if scene.view.holds(place):
            return place
    points = [scene.at[p] for p in scene.case.carries.get(link, ()) if p in scene.at]
    wheels = [scene.view.at(w.centre) for w in scene.round.wheels if w.link == link]
    joints = [scene.at[j.at] for j in scene.joints() if link in j.links and getattr(j, "at", None)]
    return next(iter([*wheels, *points, *joints]), None)


def _with_label(
    scene: Scene,
    load: Load,
    number: Shown,
    marks: tuple[Mark, ...],
    soft: tuple[Soft, ...],
    anchors: tuple[Point, ...],
    gap: float = 6.0,
) -> Part:
    runs = _words(scene, load, number)
    title = "".join(run.text for run in runs)
    label = Label(f"label-{load.name}", runs, f"t-{number.kind}", 14.0, anchors, gap)
    return Part((Group(f"load-{load.name}", "", marks, title),), soft, (), (label,))


__all__ = ["fixed_springs", "load_parts", "shown"]
