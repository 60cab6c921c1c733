"""What a varied number does: it moves the mechanism, reshapes it, or changes a load.

A number that only poses the figure becomes a condition on where the links are. Of the other data that
pose it, as many are held as the mechanism has freedoms left.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from icsolve.arithmetic import FLOATS, Scalar
from icsolve.case import Case, Coordinates, Number
from icsolve.errors import SceneError, Status
from icsolve.figure import solve_figure
from icsolve.figure.board import Board
from icsolve.figure.data import CORNER, LENGTH, RAY, Datum, X, Y, data_of, number_of
from icsolve.plane import Point
from icsolve.sentences import listed, plural
from icsolve.turn.constraints import Apart, Constraint, Drawn, Immovable, Line, OnLine, Pointed, Rows, Turning
from icsolve.turn.mechanism import Mechanism
from icsolve.turn.numbers import with_numbers
from icsolve.turn.poses import Rotation, Spot, Still
from icsolve.turn.smallest import Matrix, bases_of, jacobian, matrix, rank

CENTRED = {X: ((0.0, 1.0), 0), Y: ((1.0, 0.0), 1)}
"""A given coordinate: the line's direction, and the axis on which it is given."""
ALIGNED = 1e-9
"""An angle that the figure has to this many degrees is the written one."""


class Pose(NamedTuple):
    """A datum that poses the figure, and the spots of its points."""

    datum: Datum
    spots: tuple[Spot, ...]


class Drive(NamedTuple):
    """Which of the varied paths move the mechanism, and which data are held while it moves."""

    moving: tuple[str, ...]
    held: tuple[Pose, ...]
    locked: tuple[int, ...]
    """bodies that only spin, which are kept from it"""


def pose_of(mechanism: Mechanism, path: str) -> Pose | None:
    """The datum at a path if it poses the figure: it is not one of the shape of a link."""
    case = mechanism.case
    for datum in data_of(case):
        if datum.kind in (LENGTH, RAY, CORNER, X, Y) and number_of(case, datum).path == path:
            return _posing(mechanism, datum)
    section, _, name = path.partition(".")
    point, _, axis = name.rpartition(".")
    place = case.points.get(point) if section == "points" else None
    if isinstance(place, Coordinates) and _slides(mechanism, path):
        return _posing(mechanism, Datum(X if axis == "x" else Y, point, (point,)))
    return None


def _posing(mechanism: Mechanism, datum: Datum) -> Pose | None:
    """None where the points are all of one link (of the frame, for a direction or a coordinate)."""
    ground = mechanism.top.ground
    carriers = [_carriers(mechanism, name) for name in datum.points]
    if not all(carriers):
        return None
    common = set.intersection(*carriers)
    if datum.kind in (RAY, X, Y):
        if ground in common:
            return None
    elif common:
        return None
    if common:
        body = min(common)
        return Pose(datum, tuple((body, name) for name in datum.points))
    return Pose(datum, tuple((ground if ground in c else min(c), p) for c, p in zip(carriers, datum.points)))


def _carriers(mechanism: Mechanism, name: str) -> set[int]:
    return {body for body, spots in mechanism.spots.items() if (body, name) in spots}


# --- the condition that a datum is ----------------------------------------------------------------


def condition(mechanism: Mechanism, pose: Pose, value: Scalar) -> Constraint:
    """The datum as a condition on the links; ``value`` is its number."""
    datum, spots, scale = pose.datum, pose.spots, mechanism.frame.scale
    bodies = {spot[0] for spot in spots}
    if datum.kind == RAY and len(bodies) == 1:
        return _pointed(mechanism, spots, number_of(mechanism.case, datum), value)
    if datum.kind == LENGTH:
        return Apart(spots[0], spots[1], value * scale)
    if datum.kind in (X, Y):
        along, axis = CENTRED[datum.kind]
        place = (value - mechanism.frame[axis]) * scale
        through = (place, 0.0) if axis == 0 else (0.0, place)
        return OnLine(spots[0], Line(mechanism.top.ground, through, along))
    if datum.kind == CORNER:
        arms = _arms(mechanism, datum)
        if arms is not None:
            written = number_of(mechanism.case, datum).value
            return Turning(((arms[1], 1.0), (arms[0], -1.0)), value - written)
    if datum.kind == RAY and spots[0][0] == mechanism.top.ground:
        line = Line(mechanism.top.ground, mechanism.shape.ref[datum.points[0]], _turned(mechanism, value))
        return OnLine(spots[1], line)
    return Drawn(datum, spots)


def _turned(mechanism: Mechanism, value: Scalar) -> Point:
    return mechanism.shape.record.turned(value)


def _pointed(mechanism: Mechanism, spots: Sequence[Spot], number: Number, value: Scalar) -> Pointed:
    """The direction from one point of a body to another; its turning is counted from the figure's own."""
    (p, q), shape = spots, mechanism.shape
    x, y = shape.between(p, q)
    length = shape.span(p, q)
    found = math.degrees(math.atan2(float(y), float(x)))
    off = math.remainder(found - number.value, 360.0)
    written = number.value if abs(off) <= ALIGNED else number.value + off
    rotation = Rotation(_turned(mechanism, value), (x / length, y / length), value - written, (p, q, length))
    return Pointed(p[0], rotation)


def _arms(mechanism: Mechanism, datum: Datum) -> tuple[int, int] | None:
    """The bodies that carry the arms of a corner, if there are two; the frame where it can be."""
    a, at, b = (_carriers(mechanism, name) for name in datum.points)
    ground = mechanism.top.ground
    one, two = sorted(a & at, key=lambda body: body != ground), sorted(b & at, key=lambda body: body != ground)
    pairs = [(i, j) for i in one for j in two if i != j]
    return pairs[0] if pairs else None


def turning(mechanism: Mechanism, link: str, degrees: Scalar) -> Turning:
    """A link turned from the position as written."""
    return Turning(((mechanism.top.body_of[link], 1.0),), degrees)


# --- what moves, what is held ---------------------------------------------------------------------


def drive_of(mechanism: Mechanism, paths: Sequence[str], links: Sequence[str]) -> Drive:
    """Which varied paths move the mechanism, and what is held.

    Raises SceneError where a link cannot be turned, or all is rigid.
    """
    case = mechanism.case
    bodies = [body for body in mechanism.spots if body != mechanism.top.ground]
    rows = jacobian(mechanism, bodies, mechanism.constraints)
    left = 3 * len(bodies) - rank(rows)
    for link in links:
        body = mechanism.top.body_of[link]
        rows, taken = _added(mechanism, bodies, rows, Turning(((body, 1.0),)))
        if not taken:
            raise _cannot_turn(case, link, left, body == mechanism.top.ground)
        left -= 1
    moving: list[str] = []
    before, freedoms = rows, left
    for path in paths:
        pose = pose_of(mechanism, path)
        if pose is None:
            continue
        rows, taken = _added(mechanism, bodies, rows, condition(mechanism, pose, _value(case, pose)))
        if taken:
            moving.append(path)
            left -= 1
        elif links:
            raise _too_many(path, freedoms + len(links), links)
        elif moving or freedoms == 0:
            moving, rows, left = [], before, freedoms
            break
    if not moving and not links:
        return Drive((), (), ())
    held, rows, left = _held(mechanism, bodies, rows, left, moving)
    return Drive(tuple(moving), held, _spinning(mechanism, bodies, rows, left))


def _value(case: Case, pose: Pose) -> float:
    datum = pose.datum
    if datum.kind in (X, Y):
        place = case.points[datum.points[0]]
        assert isinstance(place, Coordinates)
        number = place.x if datum.kind == X else place.y
        assert number is not None
        return number.value
    return number_of(case, datum).value


def _added(
    mechanism: Mechanism, bodies: Sequence[int], rows: Matrix, constraint: Constraint
) -> tuple[Matrix, bool]:
    """The equations with one more, if it takes a freedom."""
    still = Rows(
        mechanism.shape,
        Still(mechanism.shape),
        bases_of(mechanism, bodies),
        Board(mechanism.case, mechanism.frame, FLOATS),
    )
    more = np.vstack([rows, matrix(bodies, [still.of(constraint)])])
    return (more, True) if rank(more) > rank(rows) else (rows, False)


def _held(
    mechanism: Mechanism, bodies: Sequence[int], rows: Matrix, left: int, moving: Sequence[str]
) -> tuple[tuple[Pose, ...], Matrix, int]:
    """The other data that pose the figure, as many as there are freedoms."""
    held = []
    for datum in data_of(mechanism.case):
        if not left:
            break
        if datum.kind not in (LENGTH, RAY, CORNER, X, Y) or number_of(mechanism.case, datum).path in moving:
            continue
        pose = _posing(mechanism, datum)
        if pose is None:
            continue
        rows, taken = _added(mechanism, bodies, rows, condition(mechanism, pose, _value(mechanism.case, pose)))
        if taken:
            held.append(pose)
            left -= 1
    return tuple(held), rows, left


def _spinning(mechanism: Mechanism, bodies: Sequence[int], rows: Matrix, left: int) -> tuple[int, ...]:
    """Bodies that are free to spin while all others stand."""
    if not left:
        return ()
    free = np.linalg.svd(rows)[2][rows.shape[1] - left :]
    locked = []
    for n, body in enumerate(bodies):
        others = np.delete(free, [3 * n, 3 * n + 1, 3 * n + 2], axis=1)
        if rank(others) < left - len(locked):
            locked.append(body)
    return tuple(locked)


def _too_many(path: str, freedoms: int, links: Sequence[str]) -> SceneError:
    return SceneError(
        Status.MOBILITY,
        f"{path} and the turning of {'link' if len(links) == 1 else 'links'} {listed(links)} cannot both be given: the "
        f"mechanism has {plural(freedoms, 'degree')} of freedom. Leave one out.",
    )


def _cannot_turn(case: Case, link: str, left: int, ground: bool) -> SceneError:
    why = f"link {link} is the frame" if ground else f"link {link} does not turn, or not by itself"
    if not left and not ground:
        why = "no freedom is left for it"
    return SceneError(
        Status.MOBILITY,
        f"link {link} cannot be the driving link: {why}. Turn another link, or vary an angle, a length or a coordinate "
        "that poses the figure.",
    )


# --- coordinates that only pose -------------------------------------------------------------------


def _slides(mechanism: Mechanism, path: str) -> bool:
    """Whether a given coordinate only poses the figure: changed a little, it leaves every link's shape.

    The figure is solved again as if written so; what hangs on it must be as far apart as before.
    """
    case, point = mechanism.case, path.split(".")[1]
    if (mechanism.top.ground, point) in mechanism.spots[mechanism.top.ground]:
        return False
    if any(isinstance(c, Immovable) for c in mechanism.constraints):
        return False
    written = _value(case, Pose(Datum(X if path.endswith("x") else Y, point, (point,)), ()))
    step = 2.0**-10 / mechanism.frame.scale
    for change in (step, -step):
        try:
            return _same_shapes(mechanism, with_numbers(case, {path: written + change}))
        except SceneError:
            continue
    return False


def _same_shapes(mechanism: Mechanism, other: Case) -> bool:
    frame, shape = mechanism.frame, mechanism.shape
    still = Still(shape)
    near = {name: case_place(frame, still.place((0, name))) for name in shape.ref if not name.startswith("@")}
    figure = solve_figure(_near(other, near), [n for n in shape.ref if n in mechanism.owners])
    other_frame = figure.frame
    places = {}
    for name, (x, y) in figure.points.items():
        cx, cy = case_place(other_frame, (x, y))
        places[name] = ((cx - frame.ox) * frame.scale, (cy - frame.oy) * frame.scale)
    return _unmoved(mechanism, places) and _unbent(mechanism, places)


def case_place(frame: tuple[float, float, float], p: Point) -> tuple[float, float]:
    """A normalised place in case units."""
    return float(p[0]) / frame[2] + frame[0], float(p[1]) / frame[2] + frame[1]


def _near(case: Case, near: Mapping[str, tuple[float, float]]) -> Case:
    from dataclasses import replace

    return replace(case, near=dict(near))


SAME = 1e-8
"""Change of a distance that is none, where a coordinate changed by a thousandth (normalised)."""


def _unbent(mechanism: Mechanism, places: Mapping[str, tuple[float, float]]) -> bool:
    for body, spots in mechanism.spots.items():
        names = [name for _, name in spots if name in places]
        for n, p in enumerate(names):
            for q in names[n + 1 :]:
                before = mechanism.shape.apart((body, p), (body, q))
                if abs(math.dist(places[p], places[q]) - before) > SAME:
                    return False
    return True


def _unmoved(mechanism: Mechanism, places: Mapping[str, tuple[float, float]]) -> bool:
    """The frame's points are where they were, and guides on links that have not turned beside their points."""
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


def _beside(mechanism: Mechanism, index: int, line: Line, places: Mapping[str, tuple[float, float]]) -> bool:
    """A guide, drawn anew as if written so, has the points of its link as far beside it as before."""
    joint = mechanism.case.joints[index]
    guide = getattr(joint, "guide", None)
    name = (guide and (guide.through or (guide.ends and guide.ends[0]))) or getattr(joint, "at", "")
    c, s = (float(x) for x in line.along)
    body, ground = line.body, mechanism.top.ground
    before = Still(mechanism.shape).place((body, name))
    if name not in places:
        return True
    moved = _off(places[name], before, c, s)
    if body == ground:
        return abs(moved) <= SAME
    own = [spot[1] for spot in mechanism.spots[body] if spot[1] in places and spot[1] != name]
    shifts = [_off(places[n], Still(mechanism.shape).place((body, n)), c, s) for n in own]
    return all(abs(shift - moved) <= SAME for shift in shifts)


def _off(now: tuple[float, float], before: Point, c: float, s: float) -> float:
    """How far a point has gone square to a direction."""
    return c * (now[1] - float(before[1])) - s * (now[0] - float(before[0]))
