"""Instant centres: primary ones filled, secondary ones hollow, the lines that find them dashed; far ones as
an arrow at the edge with the distance, those at infinity as a direction."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import shapely

from icsolve.answer import Centre
from icsolve.case import Contact, Pair, Slot
from icsolve.case.names import pair_name
from icsolve.construction import Known, Step
from icsolve.draw.arrows import arrow
from icsolve.draw.links import guide_in_picture
from icsolve.draw.marks import Disc, Group, Mark, Point, Run, Stroke
from icsolve.draw.place import Label, Soft
from icsolve.draw.scene import Part, Scene, around
from icsolve.draw.shapes import clipped
from icsolve.draw.view import along, direction, unit
from icsolve.draw.words import centre_runs, quantity

BEYOND = 16.0
"""How far a line of centres goes on beyond the last of them."""


class Spot(NamedTuple):
    """Where a centre is: in the picture (``far`` where that is outside the window), or only a direction
    (``toward``, a unit vector)."""

    centre: Centre
    at: Point | None
    toward: Point | None
    far: bool


def spot_of(scene: Scene, centre: Centre) -> Spot:
    """A centre in the picture."""
    if centre.kind == "toward":
        return Spot(centre, None, direction(centre.place[0]), True)
    at = scene.view.at((centre.place[0], centre.place[1]))
    return Spot(centre, at, None, not scene.view.holds(at))


def centre_parts(scene: Scene, steps: Sequence[Step]) -> list[Part]:
    """Lines first, then the centres with their names; the last step's lines are the heavier ones."""
    spots = {step.centre.pair: spot_of(scene, step.centre) for step in steps}
    parts = [line for step in steps for line in _lines(scene, spots, step)]
    return [*parts, *_near(scene, spots.values()), *_far(scene, spots.values())]


def _name(known: Known, pair: Pair) -> str:
    return pair_name(known.case, pair)


def _lines(scene: Scene, spots: dict[Pair, Spot], step: Step) -> Iterable[Part]:
    """The lines on which a centre was found."""
    target = spots[step.centre.pair]
    for number, ends in enumerate(step.centre.lines, 1):
        places = [spots[end] for end in ends if end in spots]
        chain = _chain([*places, target], scene) if len(ends) == 2 else _normal(scene, ends[0], target)
        pieces = clipped(chain, scene.view.window) if chain else ()
        if not pieces:
            continue
        names = " and ".join(f"I{_name(scene.known, end)}" for end in ends)
        title = f"line through {names}" if len(ends) == 2 else f"common normal of {names[1:]}"
        marks = tuple(Stroke(piece, "construction") for piece in pieces)
        name = f"line-{_name(scene.known, step.centre.pair)}-{number}"
        soft = tuple(Soft(shapely.LineString(piece), 0.7) for piece in pieces)
        data = (("data-step", str(step.number)),)
        yield Part((Group(name, "", marks, title, data),), soft)


def _chain(places: Sequence[Spot], scene: Scene) -> tuple[Point, ...]:
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


def _normal(scene: Scene, pair: Pair, target: Spot) -> tuple[Point, ...]:
    """The common normal of a slot or contact, from its point to the centre (or to the edge)."""
    for joint in scene.joints():
        if isinstance(joint, Slot | Contact) and set(joint.links) == set(pair):
            p = scene.at[joint.at]
            if isinstance(joint, Contact):
                u = direction(joint.normal.value)
            else:
                x, y = guide_in_picture(scene, joint)
                u = (-y, x)
            reach = [0.0]
            if target.at is not None:
                reach.append((target.at[0] - p[0]) * u[0] + (target.at[1] - p[1]) * u[1])
            more = 1e4 if target.at is None else BEYOND
            return (along(p, u, min(reach) - more), along(p, u, max(reach) + more))
    return ()


def _near(scene: Scene, spots: Iterable[Spot]) -> Iterable[Part]:
    """Centres in the window; those in one place share a mark and a label."""
    places: dict[tuple[int, int], list[Spot]] = {}
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
            marks = Group(f"centre-{name}", "", (marks,), f"I{name}")
        label = _label(scene, together, _names(together), (at,), 8.0)
        yield Part((marks,), (), (around(at, disc.radius + 1.0),), (label,))


def _label(
    scene: Scene, together: Sequence[Spot], runs: tuple[Run, ...], anchors: tuple[Point, ...], gap: float
) -> Label:
    """The label of centres in one place, under the id of the first."""
    return Label(f"name-{_name(scene.known, together[0].centre.pair)}", runs, "t-centre", 13.0, anchors, gap)


def _names(together: Sequence[Spot]) -> tuple[Run, ...]:
    runs: list[Run] = []
    for spot in together:
        runs += [Run(", ")] if runs else []
        runs += centre_runs(*spot.centre.pair)
    return tuple(runs)


def _far(scene: Scene, spots: Iterable[Spot]) -> Iterable[Part]:
    """Arrows at the edge; those at infinity in one direction share one."""
    left, top, right, bottom = scene.view.window
    middle = ((left + right) / 2.0, (top + bottom) / 2.0)
    ways: dict[tuple[float, bool], list[Spot]] = {}
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
            group = Group(f"centre-{name}", "", marks if group is None else (group,), f"I{name}, {text}")
        runs = (*_names(together), Run(f" {text}" if first.at is None else f", {text}"))
        label = _label(scene, together, runs, (along(tip, u, -15.0), tail, tip), 6.0)
        soft = (Soft(shapely.LineString([tail, tip]).buffer(5.0, quad_segs=1), 4.0),)
        yield Part((group,) if group else (), soft, (), (label,))


def _edge(middle: Point, u: Point, window: tuple[float, float, float, float], inside: float) -> Point:
    """Where a ray from the middle comes near the edge of the window."""
    left, top, right, bottom = window
    across = (right - middle[0] if u[0] > 0 else left - middle[0]) / u[0] if abs(u[0]) > 1e-9 else math.inf
    down = (bottom - middle[1] if u[1] > 0 else top - middle[1]) / u[1] if abs(u[1]) > 1e-9 else math.inf
    return along(middle, u, min(across, down) - inside)
