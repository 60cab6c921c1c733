"""Free-body diagrams: every link by itself with its loads and the forces of its neighbours, all forces to one
scale."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import shapely

from icsolve.answer.bodies import Reaction
from icsolve.case import is_link, told_links
from icsolve.case.loads import aim_of
from icsolve.draw.frame import point_parts, rims
from icsolve.draw.links import bars, body_of, link_part, wheel_parts
from icsolve.draw.loads import ARC, axle, heads, hidden, is_no_inertia, kind_of, ways
from icsolve.draw.marks import (
    Disc,
    Mark,
    MarkGroup,
    Point,
    Stroke,
    TextMark,
    TextRun,
    arrow,
    bounds,
    moved,
    plain_text,
    turning,
)
from icsolve.draw.place import Label, Soft, joined, nearest
from icsolve.draw.scene import Part, Scene, around, together, with_labels
from icsolve.draw.words import force_runs, name_runs, quantity
from icsolve.report.derivation.known import Acting, acting_loads, pulls_on
from icsolve.tuples import NamedTuple

LONGEST = 78.0
"""The largest force of all links."""
SMALLER = 0.66
"""Links by themselves are drawn so much smaller than in the figure."""
LEAST = 13.0
"""An arrow is never drawn shorter."""
BESIDE = 12.0
"""A force that acts farther from its link than this is tied to it by a dashed line."""
WIDEST = 10.0
"""A friction circle wider than so many figures is not drawn: its force stands at the pin, with a couple."""
GAP = 26.0
ROUND = 30.0
"""Room for labels around a link with its forces."""
TO_SCALE = "Free bodies, forces to one scale"
BUT_SMALL = f"{TO_SCALE}, but for small ones, which would be shorter"
NONE_TOLD = "Free bodies: none, since the answer leaves the reactions open."
"""As where friction holds the links within its limits."""
NOTHING = 1e-9
"""A force below this, of the largest, is none."""


class DrawnPush(NamedTuple):
    """A force or couple on a link at a point (picture units), with the words beside it."""

    name: str
    words: tuple[TextRun, ...]
    kind: str
    at: Point
    force: Point
    couple: float
    pull: bool = False
    """drawn from where it acts outward"""
    circle: Point | None = None
    """the middle of the friction circle that it touches"""


def body_panels(scene: Scene, left: float, top: float, width: float) -> list[Mark]:
    """The free bodies of all moving links in rows below a corner, ``width`` wide."""
    answer = scene.known.answer
    if answer is None or not answer.reactions:
        return [] if answer is None else titled([], left, top, width, NONE_TOLD)
    view = scene.view._replace(scale=SMALLER * scene.view.scale)
    scene = scene._replace(view=view, at={name: view.at(p) for name, p in scene.known.points.items()})
    pushes = {
        link: list(pushes_on(scene, link)) for link in told_links(scene.case) if link != scene.case.ground
    }
    largest = max((math.hypot(*push.force) for some in pushes.values() for push in some), default=0.0)
    panels = [_panel(scene, link, some, largest) for link, some in pushes.items()]
    sizes = {math.hypot(*push.force) / largest for some in pushes.values() for push in some if largest}
    small = any(NOTHING < size < LEAST / LONGEST for size in sizes)
    return titled(panels, left, top, width, BUT_SMALL if small else TO_SCALE)


def support_parts(scene: Scene, solid: shapely.Geometry) -> list[Part]:
    """The forces of the frame on a structure, in the figure itself."""
    answer, ground = scene.known.answer, scene.case.ground
    assert answer is not None
    pushes = [
        _reaction(scene, name, r if r.by == ground else r.reversed())
        for name, r in (answer.reactions or {}).items()
        if ground in (r.by, r.on)
    ]
    largest = max((math.hypot(*push.force) for push in pushes), default=0.0)
    return [part for n, push in enumerate(pushes) for part in _drawn(scene, push, largest, solid, n, solid)]


def titled(
    panels: Iterable[list[Mark]], left: float, top: float, width: float, title: str = TO_SCALE
) -> list[Mark]:
    """Panels beside and below each other, under a title."""
    return [
        TextMark((left, top + 4.0), (TextRun(title),), "t-note", 12.5, "start"),
        *_rows(panels, left, top + 24.0, width),
    ]


def _rows(panels: Iterable[list[Mark]], left: float, top: float, width: float) -> Iterable[Mark]:
    x, y, lowest = left, top, top
    for panel in panels:
        a, b, c, d = bounds(panel)
        if x > left and x + (c - a) > left + width:
            x, y = left, lowest + GAP
        yield from (moved(mark, x - a, y - b) for mark in panel)
        x, lowest = x + (c - a) + GAP, max(lowest, y + (d - b))


def pushes_on(scene: Scene, link: str) -> Iterable[DrawnPush]:
    """All that acts on a link."""
    answer = scene.known.answer
    assert answer is not None
    for name, reaction in answer.reactions.of_link(link) if answer.reactions else ():
        yield _reaction(scene, name, reaction)
    yield from _pulls(scene, link)
    for acting in acting_loads(scene.known):
        if not is_link(acting.link) or is_no_inertia(acting):
            continue
        if link in (acting.link, acting.against):
            yield _load(scene, acting, 1.0 if link == acting.link else -1.0)


def _pulls(scene: Scene, link: str) -> Iterable[DrawnPush]:
    """The pulls of ropes; those of several parts along one line as one."""
    for n, pull in enumerate(pulls_on(scene.known, link), 1):
        times = (TextRun(f"{pull.strands} "),) if pull.strands > 1 else ()
        low = (TextRun(pull.symbol[1], True),) if pull.symbol[1] else ()
        (x, y), unit = pull.force, scene.case.units.force
        words = (*times, TextRun(pull.symbol[0]), *low, TextRun(f" = {quantity(math.hypot(x, y), unit)}"))
        yield DrawnPush(
            f"body-rope-{n}-on-{link}", words, "reaction", scene.view.at(pull.at), (x, -y), 0.0, True
        )


def _reaction(scene: Scene, name: str, reaction: Reaction) -> DrawnPush:
    at = scene.view.at(reaction.at)
    runs = force_runs(name, reaction.by, reaction.on, reaction.where)
    words = f"reaction-{name}-on-{reaction.on}"
    if reaction.x is None or reaction.y is None:
        axis, part, other = ("y", reaction.y, "x") if reaction.x is None else ("x", reaction.x, "y")
        if part is None:
            return DrawnPush(words, (*runs, TextRun(" = ?")), "reaction", at, (0.0, 0.0), 0.0)
        low, open_ = (runs[1]._replace(text=runs[1].text + way) for way in (axis, other))
        left = (runs[0], open_, TextRun(" = ?"))
        known = TextRun(f" = {quantity(abs(part), scene.case.units.force)}, ")
        force = (0.0, -part) if axis == "y" else (part, 0.0)
        return DrawnPush(words, (runs[0], low, known, *left) if part else left, "reaction", at, force, 0.0)
    size, force = math.hypot(reaction.x, reaction.y), (reaction.x, -reaction.y)
    text: tuple[TextRun, ...] = (*runs, TextRun(f" = {quantity(size, scene.case.units.force)}"))
    offset = _off_pin(scene, reaction, size)
    if offset is not None:
        p = scene.view.at((reaction.at[0] + offset[0], reaction.at[1] + offset[1]))
        return DrawnPush(words, text, "reaction", p, force, 0.0, circle=at)
    if reaction.moment and abs(reaction.moment) > NOTHING * size * scene.known.size:
        couple = quantity(abs(reaction.moment), scene.case.units.torque)
        text = (*text, TextRun(", M"), runs[1], TextRun(f" = {couple}"))
    return DrawnPush(words, text, "reaction", at, force, reaction.moment or 0.0)


def _off_pin(scene: Scene, reaction: Reaction, size: float) -> Point | None:
    """From a pin that rubs to where its force touches the friction circle, case lengths: there it has the
    moment of the friction. None where the pin does not rub, or the circle is far beyond the figure."""
    pins = (pin for pin in scene.case.joints if pin.pivot and pin.friction is not None)
    rubbed = any(pin.at == reaction.where and {reaction.by, reaction.on} <= {*pin.links} for pin in pins)
    moment = (reaction.moment or 0.0) / scene.case.units.torque_per_force_length
    whole = size * scene.known.size
    if not rubbed or not NOTHING * whole < abs(moment) < WIDEST * whole:
        return None
    assert reaction.x is not None and reaction.y is not None
    return (moment / size * (reaction.y / size), -moment / size * (reaction.x / size))


def _load(scene: Scene, acting: Acting, sign: float) -> DrawnPush:
    kind, link = kind_of(acting), acting.link if sign > 0 else acting.against
    name = f"body-load-{acting.load.name}-on-{link}"
    x, y = acting.force
    ratio = scene.case.units.torque_per_force_length
    value = abs(acting.couple) * ratio if acting.at is None else math.hypot(x, y)
    unit = scene.case.units.torque if acting.at is None else scene.case.units.force
    words = (*name_runs(acting.load.name), TextRun(f" = {quantity(value, unit)}"))
    place = acting.at
    if place is not None and sign < 0.0:
        place = scene.known.points.get(aim_of(acting.load), place)
    at = (axle(scene, link) or (0.0, 0.0)) if place is None else scene.view.at(place)
    return DrawnPush(name, words, kind, at, (sign * x, -sign * y), sign * acting.couple)


def _panel(scene: Scene, link: str, pushes: Sequence[DrawnPush], largest: float) -> list[Mark]:
    body = body_of(scene, link)
    solid = bars(body)
    own = scene.case.carries.get(link, ())
    alone = scene._replace(at={p: q for p, q in scene.at.items() if p in own})
    parts = [*wheel_parts([body]), *rims(scene, link), link_part(scene, body)]
    dots = dict.fromkeys(alone.at.values())
    parts += [Part((Disc(p, 2.4, "dot"),), (), (around(p, 2.8),)) for p in dots]
    taken = solid
    pulls_first = sorted(pushes, key=lambda push: not push.pull)  # a rope can't be drawn otherwise
    for n, push in enumerate(pulls_first):
        drawn = list(_drawn(scene, push, largest, solid, n, taken))
        taken = joined([taken, *(soft.geometry for part in drawn for soft in part.soft)])
        parts += drawn
    parts += [part._replace(marks=()) for part in point_parts(alone)]
    return panel(link, parts, ROUND)


def panel(link: str, parts: Iterable[Part], room: float = 0.0) -> list[Mark]:
    """A link by itself, with its labels in so much room around it."""
    whole = together(parts)
    marks = (_renamed(link, mark) for mark in with_labels(whole, bounds(whole.marks, room)))
    return [MarkGroup(f"body-{link}", "", tuple(marks), f"link {link} by itself")]


def _renamed(link: str, mark: Mark) -> Mark:
    """Ids stand once: those that the figure has too get a prefix."""
    own = ("reaction-", "body-", "label-reaction", "label-body")
    if isinstance(mark, MarkGroup) and mark.name and not mark.name.startswith(own):
        return mark._replace(name=f"free-{link}-{mark.name}")
    return mark


def _drawn(
    scene: Scene, push: DrawnPush, largest: float, solid: shapely.Geometry, n: int, taken: shapely.Geometry
) -> Iterable[Part]:
    """A force or couple with its words; of two places for its arrow the one that hides less of ``taken``."""
    size = math.hypot(*push.force)
    marks: list[Mark] = []
    soft: list[Soft] = []
    anchors: list[Point] = [push.at]
    if push.circle is not None:
        marks.append(Disc(push.circle, math.dist(push.at, push.circle), "box"))
    foot = push.at if solid.is_empty else nearest(solid, push.at)
    if size and math.dist(foot, push.at) > BESIDE:
        marks.append(Stroke((foot, push.at), "box"))
    if size > NOTHING * largest:
        u = (push.force[0] / size, push.force[1] / size)
        length = max(LONGEST * size / largest, LEAST)
        both = ways(push.at, u, length)
        tail, tip, _ = both[1] if push.pull else min(both, key=lambda way: hidden(scene, way, taken))
        marks += arrow(tail, tip, push.kind)
        soft.append(Soft(shapely.LineString([tail, tip]).buffer(4.0, quad_segs=1), 4.0))
        far = max((tail, tip), key=lambda p: math.dist(p, push.at))
        anchors = [far, ((tail[0] + tip[0]) / 2.0, (tail[1] + tip[1]) / 2.0)]
    if push.couple:
        marks += turning(push.at, ARC - 6.0, 300.0 + 40.0 * n, push.couple > 0.0, push.kind)
        ring = shapely.Point(push.at).buffer(ARC - 3.0)
        soft.append(Soft(ring, 1.0))
        anchors.append((push.at[0], push.at[1] + ARC - 6.0))
    soft += heads(marks)
    label = Label(f"label-{push.name}", push.words, f"t-{push.kind}", 12.5, tuple(anchors), 6.0)
    group = MarkGroup(push.name, "", tuple(marks), plain_text(push.words))
    yield Part((group,) if marks else (), tuple(soft), (), (label,))
