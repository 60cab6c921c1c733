"""Whether a given coordinate only poses a figure: written otherwise, it leaves every link's shape."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import replace

from icsolve.assembly import case_point, solve_figure
from icsolve.assembly.workspace import normalised
from icsolve.case import Belt, Case, Gears, Roll, Slide, Slot
from icsolve.errors import SceneError
from icsolve.screws.plane import Point
from icsolve.sweep.constraints import Immovable, Line, Turning
from icsolve.sweep.mechanism import Mechanism
from icsolve.sweep.numbers import with_numbers
from icsolve.sweep.poses import Still, minus

SAME = 1e-8
"""Change of a distance that is none, where a coordinate changed by a thousandth (normalised)."""

WHEELS = (Gears, Belt, Roll)

Places = Mapping[str, tuple[float, float]]


def only_poses(mechanism: Mechanism, path: str, point: str, written: float) -> bool:
    """Whether a given coordinate only poses the figure: changed a little, it leaves every link's shape.

    The figure is solved again as if written so; what hangs on it must be as far apart as before.
    """
    if (mechanism.top.ground, point) in mechanism.spots[mechanism.top.ground]:
        return False
    return _leaves_shapes(mechanism, path, written)


def turns_a_wheel(mechanism: Mechanism, path: str, moved: Collection[str], written: float) -> bool:
    """Whether a number that moves these points turns what carries them: bodies that mesh, roll or bear a
    belt and so turn others, all of which keep their shapes."""
    wheels = {b for bond in mechanism.top.bonds if isinstance(bond.joint, WHEELS) for b in (bond.a, bond.b)}
    carriers = {body for body, spots in mechanism.spots.items() if any(name in moved for _, name in spots)}
    if not carriers or not carriers <= wheels - {mechanism.top.ground}:
        return False
    return _leaves_shapes(mechanism, path, written)


def _leaves_shapes(mechanism: Mechanism, path: str, written: float) -> bool:
    if any(isinstance(c, Immovable) for c in mechanism.constraints):
        return False
    step = 2.0**-10 / mechanism.frame.scale
    for change in (step, -step):
        try:
            return _same_shapes(mechanism, with_numbers(mechanism.case, {path: written + change}))
        except SceneError:
            continue
    return False


def _same_shapes(mechanism: Mechanism, other: Case) -> bool:
    """Whether a case, solved near the places of the mechanism, has links of the same shapes."""
    frame, still = mechanism.frame, Still(mechanism.shape)
    names = [name for name in mechanism.shape.ref if not name.startswith("@")]
    near = {name: case_point(frame, still.place((0, name))) for name in names}
    figure = solve_figure(replace(other, near=near), [name for name in names if name in mechanism.owners])
    at = {name: case_point(figure.frame, place) for name, place in figure.points.items()}
    places = {name: normalised(frame, place) for name, place in at.items()}
    return _unmoved(mechanism, places) and _unbent(mechanism, places)


def _unbent(mechanism: Mechanism, places: Places) -> bool:
    """Points of a link are as far apart as before."""
    for body, spots in mechanism.spots.items():
        names = [name for _, name in spots if name in places]
        for n, p in enumerate(names):
            for q in names[n + 1 :]:
                before = mechanism.shape.apart((body, p), (body, q))
                if abs(math.dist(places[p], places[q]) - before) > SAME:
                    return False
    return True


def _unmoved(mechanism: Mechanism, places: Places) -> bool:
    """The frame's points are where they were, and so are guides beside the points of links that slide."""
    ground, still = mechanism.top.ground, Still(mechanism.shape)
    for spot in mechanism.spots[ground]:
        if spot[1] in places and math.dist(places[spot[1]], still.place(spot)) > SAME:
            return False
    return all(
        _beside(mechanism, index, line, places)
        for index, line in mechanism.lines.items()
        if line.body == ground or _slides_on(mechanism, line.body, ground)
    )


def _slides_on(mechanism: Mechanism, body: int, ground: int) -> bool:
    """Whether a body keeps its direction."""
    return any(
        isinstance(c, Turning) and c.alike and c.bodies == frozenset((body, ground))
        for c in mechanism.constraints
    )


def _beside(mechanism: Mechanism, index: int, line: Line, places: Places) -> bool:
    """A guide, drawn anew as if written so, has the points of its link as far beside it as before."""
    joint = mechanism.case.joints[index]
    assert isinstance(joint, Slide | Slot)
    guide = joint.guide
    name = guide.through or (guide.ends[0] if guide.ends else joint.at)
    if name not in places:
        return True
    still, body = Still(mechanism.shape), line.body
    moved = _off(places[name], still.place((body, name)), line)
    if body == mechanism.top.ground:
        return abs(moved) <= SAME
    own = [spot for spot in mechanism.spots[body] if spot[1] in places and spot[1] != name]
    return all(abs(_off(places[spot[1]], still.place(spot), line) - moved) <= SAME for spot in own)


def _off(now: tuple[float, float], before: Point, line: Line) -> float:
    """How far a point has gone square to a line."""
    (x, y), (c, s) = minus(now, before), line.along
    return float(c * y - s * x)
