"""The loads: forces and weights as arrows, torques as arcs, springs as coils; the unknown in its own colour
with the answer beside it. Velocities of the points, square to their radii."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import shapely

from icsolve.case import Area as Face
from icsolve.case import Force, Load, Number, Screw, Spring, Stretch, TorsionSpring, Weight, is_link
from icsolve.case.loads import aim_of, name_of_inertia
from icsolve.draw.links import guide_in_picture
from icsolve.draw.marks import (
    AreaMark,
    Mark,
    MarkGroup,
    Point,
    Stroke,
    TextMark,
    TextRun,
    along,
    arrow,
    leaves,
    plain_text,
    turning,
    unit,
)
from icsolve.draw.place import Label, Soft, area, joined
from icsolve.draw.scene import BLOCK, HALF, RAIL, Part, Scene
from icsolve.draw.words import figure_number, name_runs, quantity, unit_word
from icsolve.numbers import FLOATS
from icsolve.report.derivation.known import Acting, acting_loads
from icsolve.statics.load_wrenches import direction
from icsolve.tuples import NamedTuple
from icsolve.wording import held, sense_of

ARROW = 56.0
"""Length of a load's arrow."""
LINE, HEADS = 34.0, 7.0
"""Length of the largest arrow of a force per length, and the heads of arrows side by side."""
ARC = 25.0
"""Radius of a torque's arc."""
HUNG = (30.0, 24.0)
"""Width and height of a weight that hangs on a rope."""
SPIRAL = 24.0
"""Radius of a torsion spring."""
DOWN = (0.0, 1.0)


def load_parts(scene: Scene, links: shapely.Geometry, *, whole: bool = False) -> list[Part]:
    """Every load whose place is known; ``whole``: one of unknown direction, once found, by one arrow."""
    parts = []
    turned: dict[Point, int] = {}
    for acting in _whole(scene) if whole else acting_loads(scene.known):
        if isinstance(acting.load, TorsionSpring):
            part = _spiral(scene, acting, acting.load)
        elif isinstance(getattr(acting.load, "over", None), Stretch):
            part = _line_load(scene, acting)
        elif acting.at is None:
            part = _torque(scene, acting, turned)
        elif isinstance(acting.load, Spring):
            part = _spring(scene, acting, acting.load)
        else:
            part = _force(scene, acting, links)
        if part is not None:
            parts.append(part)
            links = joined([links, *(soft.geometry for soft in part.soft)])  # arrows keep off each other
    return parts


def _whole(scene: Scene) -> list[Acting]:
    """The loads, with a force in place of its two components, and no inertia of what does not accelerate."""
    acting_here = acting_loads(scene.known)
    loads = {acting.load.name: acting for acting in acting_here if not is_no_inertia(acting)}
    for name in scene.case.directed:
        x, y = (loads.get(f"{name}.{axis}") for axis in "xy")
        size = math.hypot(x.value or 0.0, y.value or 0.0) if x is not None and y is not None else 0.0
        if x is None or y is None or not size:
            continue
        way = ((x.value or 0.0) / size, (y.value or 0.0) / size)
        load = x.load._replace(name=name) if isinstance(x.load, Force) else x.load
        loads[x.load.name] = x._replace(load=load, direction=way, value=size)
        del loads[y.load.name]
    return list(loads.values())


def is_no_inertia(acting: Acting) -> bool:
    """Whether an inertia force or couple is zero, as of a wheel at a steady speed: no load of the figure."""
    return acting.value == 0.0 and name_of_inertia(acting.load.name)


def kind_of(acting: Acting) -> str:
    """The class of a load's marks."""
    return "unknown" if acting.unknown else "known"


def load_words(acting: Acting) -> tuple[TextRun, ...]:
    """``T_12 = 33.76 lbf·in cw``."""
    name = name_runs(acting.load.name)
    if acting.held is not None:
        told = acting.held._replace(unit=unit_word(acting.unit))
        return (*name, TextRun(f": {held(told, figure_number)}"))
    if acting.value is None:
        return (*name, TextRun(" = ?"))
    text = f" = {quantity(abs(acting.value), acting.unit)}"
    if ends := intensities(acting.load):
        ends = ends if max(ends) > 0.0 else (-ends[0], -ends[1])  # as its arrows point
        text = f" = {figure_number(min(ends))} to {quantity(max(ends), acting.unit)}"
    elif acting.at is None and acting.value:
        text += f" {sense_of(acting.load, acting.value, acting.gain, 0.0)}"
    if isinstance(acting.load, Spring | TorsionSpring):
        return (*name, TextRun(f": k = {quantity(abs(acting.value), acting.unit)}"))
    return (*name, TextRun(text))


def _force(scene: Scene, acting: Acting, links: shapely.Geometry) -> Part | None:
    assert acting.at is not None
    at, kind = scene.view.at(acting.at), kind_of(acting)
    sign = -1.0 if (acting.value or 0.0) < 0.0 else 1.0
    u = (sign * acting.direction[0], -sign * acting.direction[1])  # as it acts
    if not is_link(acting.link):  # the free end of a rope, as it is drawn
        at = scene.at[getattr(acting.load, "at", "")]
    hung = _hung(acting, at)
    at = along(at, DOWN, HUNG[1]) if hung else at
    pressed = isinstance(getattr(acting.load, "over", None), Face)
    both = ways(at, u, ARROW, isinstance(acting.load, Weight))
    ends = min(both, key=lambda way: hidden(scene, way, links))
    if pressed:  # it pushes on the face of a block
        at = along(at, u, 10.0 - BLOCK[0] / 2.0)
        ends = ways(at, u, 0.6 * ARROW)[0]
    tail, tip = ends[:2]
    spread = _pressed(tail, tip) if pressed else []
    lines = [(tail, tip), *spread]
    sheaf = [mark for line in spread for mark in arrow(*line, kind, HEADS)]
    marks: list[Mark] = [*(sheaf or arrow(tail, tip, kind)), *hung]
    soft = tuple(Soft(shapely.LineString(line).buffer(4.0, quad_segs=1), 4.0) for line in lines)
    outer, inner = (tail, tip) if math.dist(tail, at) > math.dist(tip, at) else (tip, tail)
    middle = ((outer[0] + inner[0]) / 2.0, (outer[1] + inner[1]) / 2.0)
    inward = along(outer, unit(at[0] - outer[0], at[1] - outer[1]), 12.0)
    part = _with_label(acting, [_following(acting, marks)], soft, (outer, inward, middle))
    return _and_opposite(scene, acting, part, u)


def _and_opposite(scene: Scene, acting: Acting, part: Part, u: Point) -> Part:
    """A force along ``u`` with the opposite one, where it acts between two links."""
    if acting.against == scene.case.ground:
        return part
    name = aim_of(acting.load)
    partner = name if name in scene.at else str(getattr(acting.load, "at", ""))
    tail = along(scene.at[partner], u, -8.0)
    tip = along(tail, u, -ARROW)
    soft = Soft(shapely.LineString([tail, tip]).buffer(4.0, quad_segs=1), 4.0)
    return _with_other(acting, part, arrow(tail, tip, kind_of(acting)), ("end", partner), soft, (tip, tail))


def _with_other(
    acting: Acting,
    part: Part,
    marks: Iterable[Mark],
    place: tuple[str, str] | None,
    soft: Soft,
    anchors: tuple[Point, ...],
) -> Part:
    """A load with what it does to the link that it acts against, which has its name alone."""
    group = MarkGroup("", "", tuple(marks)) if place is None else _following(acting, marks, place)
    other = MarkGroup("", "", (group,))
    name, kind = f"label-{acting.load.name}-opposite", f"t-{kind_of(acting)}"
    label = Label(name, name_runs(acting.load.name), kind, 14.0, anchors, 6.0)
    (own,) = part.marks
    assert isinstance(own, MarkGroup)
    return part._replace(
        marks=(own._replace(marks=(*own.marks, *other.marks)),),
        soft=(*part.soft, soft, *heads([other])),
        labels=(*part.labels, label),
    )


def _pressed(tail: Point, tip: Point) -> list[tuple[Point, Point]]:
    """The arrows of a pressure, side by side."""
    u = unit(tip[0] - tail[0], tip[1] - tail[1])
    v = (-u[1], u[0])
    return [(along(tail, v, s), along(tip, v, s)) for s in (-8.0, 0.0, 8.0)]


def _line_load(scene: Scene, acting: Acting) -> Part | None:
    """A force per length: arrows of its size side by side, each as it acts, on a line through their tails.

    In a picture that moves every arrow keeps to its place between the two ends of the line.
    """
    load, kind = acting.load, kind_of(acting)
    assert isinstance(load, Force) and isinstance(load.over, Stretch)
    a, b = load.over.a, load.over.b
    if not {a, b} <= scene.at.keys():
        return None
    x, y = acting.direction if acting.at is not None else direction(load, scene.known.points, FLOATS)
    sign = -1.0 if (acting.value or 0.0) < 0.0 else 1.0
    first, last = intensities(load) or (sign, sign)
    count = max(int(math.dist(scene.at[a], scene.at[b]) / 22.0), 3)
    lines, groups = [], []
    for n in range(count + 1):
        s = n / count
        size = LINE * (first + s * (last - first)) / (max(abs(first), abs(last)) or 1.0)
        way = math.copysign(1.0, size)
        u = (way * x, -way * y)
        (ax, ay), (bx, by) = scene.at[a], scene.at[b]
        foot = along((ax + s * (bx - ax), ay + s * (by - ay)), u, -HALF)
        lines.append((along(foot, u, -abs(size)), foot))
        groups.append(_following(acting, arrow(*lines[-1], kind, HEADS), ("end", f"{a} {b} {s:.4f}")))
    tails = [line[0] for line in lines]
    far = [c - d for p, q in ((tails[0], a), (tails[-1], b)) for c, d in zip(p, scene.at[q], strict=True)]
    ends = " ".join([load.name, a, b, *(f"{c:.1f}" for c in far)])
    groups.append(MarkGroup("", "", (Stroke(tuple(tails), kind),), follows=(("tails", ends),)))
    soft = tuple(Soft(shapely.LineString(line).buffer(4.0, quad_segs=1), 4.0) for line in lines)
    largest = tails[-1] if abs(last) > abs(first) else tails[0]
    part = _with_label(acting, groups, soft, (tails[len(tails) // 2], largest))
    return part if acting.at is None else _and_opposite(scene, acting, part, (sign * x, -sign * y))


def intensities(load: Load) -> tuple[float, float] | None:
    """The force per length at both ends of a stretch over which it is not uniform."""
    over, value = getattr(load, "over", None), getattr(load, "value", None)
    if not isinstance(over, Stretch) or over.end is None or not isinstance(value, Number):
        return None
    return value.value, over.end.value


def _hung(acting: Acting, at: Point) -> tuple[Mark, ...]:
    """The body of a weight that hangs on the free end of a rope."""
    if not (isinstance(acting.load, Weight) and not is_link(acting.link)):
        return ()
    width, height = HUNG
    return (area(shapely.box(at[0] - width / 2.0, at[1], at[0] + width / 2.0, at[1] + height), "block"),)


def ways(at: Point, u: Point, length: float, weight: bool = False) -> list[tuple[Point, Point, float]]:
    """From the point outward (a pull), or from outside onto it (a push), and what speaks against each."""
    pull = (along(at, u, 8.0), along(at, u, 8.0 + length), 0.0 if weight else 30.0)
    push = (along(at, u, -8.0 - length), along(at, u, -8.0), 60.0 if weight else 0.0)
    return [push, pull]


def hidden(scene: Scene, way: tuple[Point, Point, float], links: shapely.Geometry) -> float:
    """How much of the links an arrow would hide, and how far it leaves the window."""
    tail, tip, bias = way
    shape = shapely.LineString([tail, tip]).buffer(6.0, quad_segs=1)
    out = 0.0 if scene.view.holds(tail) and scene.view.holds(tip) else 200.0
    return float(shapely.area(shapely.intersection(shape, links))) + bias + out


def _spring(scene: Scene, acting: Acting, load: Spring) -> Part:
    a, b = scene.at[load.at], scene.at[load.to]
    line = Stroke(tuple(_coil(a, b)), "unknown" if acting.unknown else "spring")
    coil = MarkGroup("", "", (line,), follows=(("span", load.name),))
    soft = (Soft(shapely.LineString([a, b]).buffer(7.0, quad_segs=1), 3.0),)
    middle = [(a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])) for s in (0.5, 0.35, 0.65)]
    return _with_label(acting, [coil], soft, tuple(middle), gap=10.0)


def _spiral(scene: Scene, acting: Acting, load: TorsionSpring) -> Part | None:
    """A torsion spring about its corner, its last end toward what it turns."""
    if load.at not in scene.at or load.corner[-1] not in scene.at:
        return None
    centre, end = scene.at[load.at], scene.at[load.corner[-1]]
    toward = math.atan2(end[1] - centre[1], end[0] - centre[0])
    steps = [n / 60.0 for n in range(61)]
    places = [(toward + 5.0 * math.pi * (s - 1.0), 9.0 + (SPIRAL - 9.0) * s) for s in steps]
    chain = tuple(along(centre, (math.cos(a), math.sin(a)), r) for a, r in places)
    soft = (Soft(shapely.Point(centre).buffer(SPIRAL), 1.0),)
    sides = tuple(along(centre, (math.cos(a), math.sin(a)), SPIRAL) for a in (0.0, math.pi, -1.57, 1.57))
    line = Stroke(chain, "unknown" if acting.unknown else "spring")
    return _with_label(acting, [_following(acting, [line])], soft, sides)


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


def _screwed(scene: Scene, acting: Acting, screw: Screw) -> Part:
    """A torque that turns a screw: an arrow round its rod, as one sees it from the side."""
    p, u = scene.at[screw.slide.at], guide_in_picture(scene, screw.slide)
    centre, v = along(p, u, 0.8 * RAIL), (-u[1], u[0])  # v: in front, clockwise as one looks along u
    sense = 1.0 if acting.couple > 0.0 or (not acting.couple and acting.gain > 0.0) else -1.0
    angles = [math.radians(sense * (12.0 * n - 120.0)) for n in range(21)]
    ring = [along(along(centre, v, 15.0 * math.sin(a)), u, -6.0 * math.cos(a)) for a in angles]
    marks = (*arrow(ring[-2], ring[-1], kind_of(acting)), Stroke(tuple(ring[:-1]), kind_of(acting)))
    soft = (Soft(shapely.Point(centre).buffer(17.0), 3.0),)
    anchors = (along(centre, v, 15.0), along(centre, v, -15.0), along(centre, u, 8.0))
    return _with_label(acting, [_following(acting, marks)], soft, anchors)


def _torque(scene: Scene, acting: Acting, turned: dict[Point, int]) -> Part | None:
    link = acting.link
    for screw in scene.case.screws:
        if screw.rotor == link:  # where on its axis nothing says, nothing is drawn
            return _screwed(scene, acting, screw) if screw.slide.at in scene.at else None
    ccw = acting.couple > 0.0 or (not acting.couple and acting.gain > 0.0)
    own = _arc(scene, link, ccw, kind_of(acting), turned)
    if own is None:
        return None
    part = _with_label(acting, [_following(acting, own.marks)], (own.soft,), own.sides)
    if acting.against == scene.case.ground:
        return part
    other = _arc(scene, acting.against, not ccw, kind_of(acting), turned)
    if other is None:
        return part
    place = next((("end", p) for p, at in scene.at.items() if at == other.centre), None)
    return _with_other(acting, part, other.marks, place, other.soft, other.sides)


class _Arc(NamedTuple):
    """A couple's arc about a centre, and where its label may stand."""

    centre: Point
    marks: tuple[Mark, ...]
    soft: Soft
    sides: tuple[Point, ...]


def _arc(scene: Scene, link: str, ccw: bool, kind: str, turned: dict[Point, int]) -> _Arc | None:
    """The arc of a couple on a link, outside of those that its axle has: ``turned`` counts them."""
    centre = axle(scene, link)
    if centre is None:
        return None
    earlier = turned.setdefault(centre, 0)
    turned[centre] += 1
    radius = ARC + 11.0 * earlier
    far = max(scene.carried(link), key=lambda p: math.dist(p, centre), default=centre)
    gap = math.degrees(math.atan2(centre[1] - far[1], far[0] - centre[0])) if far != centre else 270.0
    marks = turning(centre, radius, gap + (50.0 if ccw else -50.0), ccw, kind)
    ring = shapely.Point(centre).buffer(radius + 3.0).difference(shapely.Point(centre).buffer(radius - 3.0))
    angles = (0.0, math.pi, -1.57, 1.57, -0.8, 2.4)
    sides = tuple(along(centre, (math.cos(a), math.sin(a)), radius) for a in angles)
    return _Arc(centre, marks, Soft(ring, 4.0), sides)


def axle(scene: Scene, link: str) -> Point | None:
    """The point about which a torque's arc is drawn: a pin of the link with the frame, else another."""
    case = scene.case
    for p in (*case.pivots(link, case.ground), *case.pivots(link)):
        if p in scene.at:
            return scene.at[p]
    own = scene.known.centre(scene.case.ground, link)
    if own is not None and own.kind == "at":
        place = scene.view.at((own.place[0], own.place[1]))
        if scene.view.holds(place):
            return place
    wheels = [scene.view.at(w.centre) for w in scene.round.wheels if w.link == link]
    joints = [scene.at[at] for j in scene.joints() if link in j.links and (at := getattr(j, "at", None))]
    return next(iter([*wheels, *scene.carried(link), *joints]), None)


def _following(acting: Acting, marks: Iterable[Mark], *more: tuple[str, str]) -> MarkGroup:
    """Marks that go with a load."""
    return MarkGroup("", "", tuple(marks), follows=(("load", acting.load.name), *more))


def _with_label(
    acting: Acting,
    marks: Sequence[Mark],
    soft: tuple[Soft, ...],
    anchors: tuple[Point, ...],
    gap: float = 6.0,
) -> Part:
    runs, name, kind = load_words(acting), acting.load.name, f"t-{kind_of(acting)}"
    label = Label(f"label-{name}", runs, kind, 14.0, anchors, gap, follows=(("label", name),))
    group = MarkGroup(f"load-{name}", "", tuple(marks), plain_text(runs))
    return Part((group,), (*soft, *heads(marks)), (), (label,))


def heads(marks: Iterable[Mark]) -> list[Soft]:
    """The heads of arrows, which no label should cover."""
    return [
        Soft(shapely.Polygon(m.rings[0]).buffer(2.0), 6.0) for m in leaves(marks) if isinstance(m, AreaMark)
    ]


# --- velocities of the points, on a scale of their own ---------------------------------------------------


LONGEST = 84.0
LEAST = 3.0
"""An arrow shorter than this is not drawn."""


def velocity_parts(scene: Scene) -> list[Part]:
    """An arrow at each point that moves; points that two links carry together have one."""
    found = _velocities(scene)
    fastest = max((math.hypot(*v) for v in found.values()), default=0.0)
    if fastest == 0.0:
        return []
    parts = []
    for (point, link), v in found.items():
        size = math.hypot(*v)
        length = LONGEST * size / fastest
        if length < LEAST:
            continue
        several = sum(other == point for other, _ in found) > 1  # one for each of its links
        parts.append(_arrow(scene, point, link, (v[0] / size, -v[1] / size), length, several))
    return parts


def _velocities(scene: Scene) -> dict[tuple[str, str], Point]:
    """Velocity of each point on the first link that has it so."""
    whole = scene.known.whole
    found: dict[tuple[str, str], Point] = {}
    for (point, link), v in ((whole and whole.velocities) or {}).items():
        if isinstance(v, str) or point not in scene.at or link == scene.case.ground:
            continue
        least = 1e-9 * math.hypot(*v)
        if not any(other == point and math.dist(v, w) <= least for (other, _), w in found.items()):
            found[(point, link)] = v
    return found


def _arrow(scene: Scene, point: str, link: str, u: Point, length: float, several: bool) -> Part:
    tail = scene.at[point]
    tip = along(tail, u, length)
    name = f"velocity-{point}-{link}"
    marks = arrow(tail, tip, "velocity", 10.0)
    low = f"{point}{link}" if several and len(link) == 1 else f"{point} on {link}" if several else point
    label = Label(f"label-{name}", (TextRun("v"), TextRun(low, True)), "t-velocity", 13.0, (tip,), 6.0)
    soft = (Soft(shapely.LineString([tail, tip]).buffer(3.0, quad_segs=1), 4.0),)
    return Part((MarkGroup(name, "", marks, f"velocity of {point} on link {link}"),), soft, (), (label,))


def legend(scene: Scene, at: Point) -> MarkGroup | None:
    """A bar as long as a round speed, and what the speeds are relative to."""
    found = _velocities(scene)
    fastest = max((math.hypot(*v) for v in found.values()), default=0.0)
    if fastest == 0.0:
        return None
    speed = round_at_most(fastest)
    end = along(at, (1.0, 0.0), LONGEST * speed / fastest)
    unit_name = f"{scene.case.units.length}/s"
    text = f"{quantity(speed, unit_name)} ({_reference(scene)})"
    words = TextMark((end[0] + 10.0, end[1]), (TextRun(text),), "t-velocity", 12.0, "start")
    return MarkGroup("velocity-scale", "", (*arrow(at, end, "velocity", 8.0), words), text)


def round_at_most(value: float) -> float:
    """1, 2 or 5 times a power of ten, at most the value (but for rounding: 99.99999999999999 is 100)."""
    value *= 1.0 + 1e-9
    power = 10.0 ** math.floor(math.log10(value))
    return max(m for m in (1.0, 2.0, 5.0) if m * power <= value) * power


def _reference(scene: Scene) -> str:
    if any(m.speed is not None for m in scene.case.motion):
        return "velocities"
    rates = (scene.known.whole and scene.known.whole.rates) or {}
    one = next((link for link, rate in rates.items() if isinstance(rate, float) and abs(rate) == 1.0), None)
    return f"velocities for 1 rad/s of link {one}" if one else "velocities, scaled"
