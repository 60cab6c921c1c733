"""Instant centres: primary ones filled, secondary ones hollow, the lines that find them dashed; far ones as
an arrow at the edge with the distance, those at infinity as a direction. Kennedy's circle has the links on a
circle and a chord for every centre that is known, dashed and numbered in the order of finding."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import shapely

from icsolve.answer import Centre
from icsolve.case import Joint, Pair, pair_name, told_links
from icsolve.case.joints import Guided, Sliding
from icsolve.draw.links import guide_in_picture
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
    along,
    arrow,
    direction,
    text_width,
    unit,
)
from icsolve.draw.place import Label, Soft, clipped
from icsolve.draw.scene import Part, Scene, around, with_labels
from icsolve.draw.words import centre_runs, quantity
from icsolve.report.derivation.known import Known
from icsolve.report.derivation.ratios import Step
from icsolve.tuples import NamedTuple
from icsolve.wording.joints import joint_of_normal

BEYOND = 16.0
"""How far a line of centres goes on beyond the last of them."""


class CentreSpot(NamedTuple):
    """Where a centre is: in the picture (``far`` where that is outside the window), or only a direction
    (``toward``, a unit vector)."""

    centre: Centre
    at: Point | None
    toward: Point | None
    far: bool


def spot_of(scene: Scene, centre: Centre) -> CentreSpot:
    """A centre in the picture."""
    if centre.kind == "toward":
        return CentreSpot(centre, None, direction(centre.place[0]), True)
    at = scene.view.at((centre.place[0], centre.place[1]))
    return CentreSpot(centre, at, None, not scene.view.holds(at))


def centre_parts(scene: Scene, steps: Sequence[Step]) -> list[Part]:
    """Lines first, then the centres with their names; the last step's lines are the heavier ones."""
    spots = {step.centre.pair: spot_of(scene, step.centre) for step in steps}
    parts = [line for step in steps for line in _lines(scene, spots, step)]
    return [*parts, *_near(scene, spots.values()), *_far(scene, spots.values())]


def _name(known: Known, pair: Pair) -> str:
    return pair_name(known.case, pair)


def _lines(scene: Scene, spots: dict[Pair, CentreSpot], step: Step) -> Iterable[Part]:
    """The lines on which a centre was found."""
    target = spots[step.centre.pair]
    lines = step.centre.lines
    for number, ends in enumerate(lines, 1):
        places = [spots[end] for end in ends if end in spots]
        if len(ends) == 2:
            chain = _chain([*places, target])
        else:
            chain = _normal(scene, joint_of_normal(scene.case, lines, number - 1), target)
        pieces = clipped(chain, scene.view.window) if chain else ()
        if not pieces:
            continue
        names = " and ".join(f"I{_name(scene.known, end)}" for end in ends)
        title = f"line through {names}" if len(ends) == 2 else f"common normal of {names[1:]}"
        marks = tuple(Stroke(piece, "construction") for piece in pieces)
        name = f"line-{_name(scene.known, step.centre.pair)}-{number}"
        soft = tuple(Soft(shapely.LineString(piece), 0.7) for piece in pieces)
        yield Part((MarkGroup(name, "", marks, title, _step_data(step)),), soft)


def _step_data(step: Step) -> tuple[tuple[str, str], ...]:
    """By which a page shows a step."""
    return (("data-step", str(step.number)),)


def _chain(places: Sequence[CentreSpot]) -> tuple[Point, ...]:
    """The line from the first to the last of the places on it, a little longer; to the edge if one is far."""
    finite = [spot.at for spot in places if spot.at is not None]
    infinite = [spot.toward for spot in places if spot.toward is not None]
    if not finite:
        return ()
    far = max(finite, key=lambda p: math.dist(p, finite[0]))
    if math.dist(far, finite[0]) > 1e-6:
        u = unit(far[0] - finite[0][0], far[1] - finite[0][1])
    elif infinite:
        u = infinite[0]
    else:
        return ()
    reach = [(p[0] - finite[0][0]) * u[0] + (p[1] - finite[0][1]) * u[1] for p in finite]
    first, last = min(reach) - BEYOND, max(reach) + BEYOND
    if infinite:
        first, last = first - 1e4, last + 1e4
    limit = 2e4
    return (along(finite[0], u, max(first, -limit)), along(finite[0], u, min(last, limit)))


def _normal(scene: Scene, joint: Joint | None, target: CentreSpot) -> tuple[Point, ...]:
    """The common normal of a slot or contact, from its point to the centre (or to the edge)."""
    if not isinstance(joint, Sliding) or any(point not in scene.at for point in joint.points):
        return ()
    p = scene.at[joint.at]
    if isinstance(joint, Guided):
        x, y = guide_in_picture(scene, joint)
        u = (-y, x)
    else:
        u = direction(joint.normal.value)
    reach = [0.0]
    if target.at is not None:
        reach.append((target.at[0] - p[0]) * u[0] + (target.at[1] - p[1]) * u[1])
    more = 1e4 if target.at is None else BEYOND
    return (along(p, u, min(reach) - more), along(p, u, max(reach) + more))


def _near(scene: Scene, spots: Iterable[CentreSpot]) -> Iterable[Part]:
    """Centres in the window; those in one place share a mark and a label."""
    places: dict[tuple[int, int], list[CentreSpot]] = {}
    for spot in spots:
        if not spot.far and spot.at is not None:
            places.setdefault((round(spot.at[0]), round(spot.at[1])), []).append(spot)
    for together in places.values():
        at = together[0].at
        assert at is not None
        primary = [spot for spot in together if spot.centre.by in ("inspection", "given")]
        disc = Disc(at, 3.2, "primary") if primary else Disc(at, 4.6, "secondary")
        marks: Mark = disc
        for spot in together:
            name = _name(scene.known, spot.centre.pair)
            marks = MarkGroup(f"centre-{name}", "", (marks,), f"I{name}")
        label = _label(scene, together, _names(together), (at,), 8.0)
        yield Part((marks,), (), (around(at, disc.radius + 1.0),), (label,))


def _label(
    scene: Scene,
    together: Sequence[CentreSpot],
    runs: tuple[TextRun, ...],
    anchors: tuple[Point, ...],
    gap: float,
) -> Label:
    """The label of centres in one place, under the id of the first."""
    return Label(f"name-{_name(scene.known, together[0].centre.pair)}", runs, "t-centre", 13.0, anchors, gap)


def _names(together: Sequence[CentreSpot]) -> tuple[TextRun, ...]:
    runs: list[TextRun] = []
    for spot in together:
        runs += [TextRun(", ")] if runs else []
        runs += centre_runs(*spot.centre.pair)
    return tuple(runs)


def _far(scene: Scene, spots: Iterable[CentreSpot]) -> Iterable[Part]:
    """Arrows at the edge; those at infinity in one direction share one."""
    left, top, right, bottom = scene.view.window
    middle = ((left + right) / 2.0, (top + bottom) / 2.0)
    ways: dict[tuple[float, bool], list[CentreSpot]] = {}
    for spot in spots:
        if spot.far:
            key = (round(spot.centre.place[0], 6), True) if spot.at is None else (float(len(ways)), False)
            ways.setdefault(key, []).append(spot)
    for n, together in enumerate(ways.values()):
        first = together[0]
        if first.at is None:
            assert first.toward is not None
            u = first.toward
            text = "∞"
        else:
            u = unit(first.at[0] - middle[0], first.at[1] - middle[1])
            gap = math.dist(first.at, middle) / scene.view.scale
            text = f"{quantity(gap, scene.case.units.length, 3)} away"
        tip = _edge(middle, u, scene.view.window, 10.0 + 3.0 * n)
        tail = along(tip, u, -30.0)
        marks = arrow(tail, tip, "far", 9.0)
        group: Mark | None = None
        for spot in together:
            name = _name(scene.known, spot.centre.pair)
            group = MarkGroup(f"centre-{name}", "", marks if group is None else (group,), f"I{name}, {text}")
        runs = (*_names(together), TextRun(f" {text}" if first.at is None else f", {text}"))
        label = _label(scene, together, runs, (along(tip, u, -15.0), tail, tip), 6.0)
        soft = (Soft(shapely.LineString([tail, tip]).buffer(5.0, quad_segs=1), 4.0),)
        yield Part((group,) if group else (), soft, (), (label,))


def _edge(middle: Point, u: Point, window: tuple[float, float, float, float], inside: float) -> Point:
    """Where a ray from the middle comes near the edge of the window."""
    left, top, right, bottom = window
    across = (right - middle[0] if u[0] > 0 else left - middle[0]) / u[0] if abs(u[0]) > 1e-9 else math.inf
    down = (bottom - middle[1] if u[1] > 0 else top - middle[1]) / u[1] if abs(u[1]) > 1e-9 else math.inf
    return along(middle, u, min(across, down) - inside)


# --- Kennedy's circle ------------------------------------------------------------------------------------


ALONG = (0.5, 0.44, 0.56, 0.38, 0.62, 0.32, 0.68, 0.26, 0.74, 0.2, 0.8)
"""Where on its chord a number may stand."""
SIZE = 11.5
"""Font size of the link names and of the order."""


def circle_marks(
    known: Known, steps: Sequence[Step], at: Point, lit: int | None = None, *, each: bool = False
) -> list[Mark]:
    """The diagram with its upper left corner at a point; ``lit`` is the step whose triangles are filled, with
    ``each`` they are there for every step, in groups."""
    steps = [*_inspected(known, steps), *steps]
    links = told_links(known.case)
    reach = max(text_width(link, SIZE) / 2.0 + 5.0 for link in links)
    node = max(11.0, reach)
    radius = max(28.0 + 14.0 * len(links), node * 2.6 * len(links) / (2.0 * math.pi))
    centre = (at[0] + radius + node, at[1] + radius + node + 22.0)
    places = _places(links, centre, radius)
    chords = Part(tuple(mark for step in steps for mark in _chord(known, places, step)))
    now = [step for step in steps if step.number and (each or step.number == lit)]
    triangles: list[Mark] = [mark for step in now for mark in _triangles(places, step)]
    if each:
        triangles = [
            MarkGroup(f"closed-{s.number}", "", tuple(_triangles(places, s)), "", _step_data(s)) for s in now
        ]
    numbers = Part(
        soft=tuple(Soft(shapely.LineString([places[link] for link in s.centre.pair]), 0.5) for s in steps),
        solid=tuple(around(p, node) for p in places.values()),
        labels=tuple(_order(places, step) for step in steps if step.number),
    )
    title = TextMark((centre[0], at[1] + 6.0), (TextRun("Kennedy circle"),), "t-note", 12.0)
    window: Box = (at[0], at[1], at[0] + 2.0 * (radius + node), at[1] + 2.0 * (radius + node) + 22.0)
    nodes: list[Mark] = []
    for link, p in places.items():
        nodes += [Disc(p, node, "node"), TextMark(p, (TextRun(link),), "t-link", SIZE)]
    marks = [title, *triangles, *with_labels(chords, window), *nodes, *with_labels(numbers, window)]
    return [MarkGroup("circle", "", tuple(marks), "Kennedy circle diagram")]


def _inspected(known: Known, steps: Sequence[Step]) -> list[Step]:
    """The centres by inspection that no step needs: the diagram starts from all of them."""
    centres = () if known.whole is None else known.whole.centres.values()
    needed = {step.centre.pair for step in steps}
    return [Step(0, c) for c in centres if c.by in ("inspection", "given") and c.pair not in needed]


def _places(links: Sequence[str], centre: Point, radius: float) -> dict[str, Point]:
    angles = (2.0 * math.pi * n / len(links) for n in range(len(links)))
    return {
        link: (centre[0] + radius * math.sin(a), centre[1] - radius * math.cos(a))
        for link, a in zip(links, angles, strict=True)
    }


def _chord(known: Known, places: dict[str, Point], step: Step) -> list[Mark]:
    a, b = step.centre.pair
    kind = "edge-found" if step.number else "edge-known"
    name = pair_name(known.case, step.centre.pair)
    found = f", found as number {step.number}" if step.number else ", by inspection"
    line = Stroke((places[a], places[b]), kind)
    return [MarkGroup(f"chord-{name}", "", (line,), f"I{name}{found}", _step_data(step))]


def _triangles(places: dict[str, Point], step: Step) -> list[Mark]:
    """The two triangles that a found chord closes."""
    marks: list[Mark] = []
    for line in step.centre.lines:
        corners = sorted({link for pair in (*line, step.centre.pair) for link in pair})
        if len(corners) == 3:
            marks.append(AreaMark((tuple(places[link] for link in corners),), "lit"))
    return marks


def _order(places: dict[str, Point], step: Step) -> Label:
    """The number of a found chord, near its middle."""
    a, b = (places[link] for link in step.centre.pair)
    anchors = tuple((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])) for t in ALONG)
    return Label(
        f"order-{step.number}", (TextRun(str(step.number)),), "t-centre", SIZE, anchors, 1.0, True, True
    )
