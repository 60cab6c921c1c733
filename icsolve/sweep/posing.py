"""The data that pose a figure, as conditions on where the links are."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from icsolve.assembly.data import CORNER, LENGTH, RAY, Datum, X, Y, data_of, number_of
from icsolve.case import Case, Coordinates, Number
from icsolve.numbers.arithmetic import Scalar
from icsolve.screws.plane import Point
from icsolve.sweep.constraints import Apart, Constraint, Drawn, Line, OnLine, Pointed, Turning
from icsolve.sweep.mechanism import Mechanism
from icsolve.sweep.poses import Rotation, Spot
from icsolve.sweep.reshaping import only_poses

KINDS = (LENGTH, RAY, CORNER, X, Y)
"""Data that can pose a figure."""
CENTRED = {X: ((0.0, 1.0), 0), Y: ((1.0, 0.0), 1)}
"""A given coordinate: the line's direction, and the axis on which it is given."""
ALIGNED = 1e-9
"""An angle that the figure has to this many degrees is the written one."""


class Pose(NamedTuple):
    """A datum that poses the figure, and the spots of its points."""

    datum: Datum
    spots: tuple[Spot, ...]


def pose_of(mechanism: Mechanism, path: str) -> Pose | None:
    """The datum at a path if it poses the figure: it is not one of the shape of a link."""
    case = mechanism.case
    for datum in data_of(case):
        if datum.kind in KINDS and number_of(case, datum).path == path:
            return posing(mechanism, datum)
    section, _, name = path.partition(".")
    point, _, axis = name.rpartition(".")
    if section != "points" or not isinstance(case.points.get(point), Coordinates):
        return None
    datum = Datum(X if axis == "x" else Y, point, (point,))
    return posing(mechanism, datum) if only_poses(mechanism, path, point, value_of(case, datum)) else None


def posing(mechanism: Mechanism, datum: Datum) -> Pose | None:
    """A datum with the spots of its points; None where they are all of one link (of the frame, for a
    direction or a coordinate)."""
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
    spots = zip(carriers, datum.points, strict=True)
    return Pose(datum, tuple((ground if ground in c else min(c), p) for c, p in spots))


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
    one, two = (sorted(arm & at, key=lambda body: body != ground) for arm in (a, b))
    pairs = [(i, j) for i in one for j in two if i != j]
    return pairs[0] if pairs else None


def turning(mechanism: Mechanism, link: str, degrees: Scalar) -> Turning:
    """A link turned from the position as written."""
    return Turning(((mechanism.top.body_of[link], 1.0),), degrees)


def value_of(case: Case, datum: Datum) -> float:
    """The number that the case writes for a datum."""
    if datum.kind in (X, Y):
        place = case.points[datum.points[0]]
        assert isinstance(place, Coordinates)
        number = place.x if datum.kind == X else place.y
        assert number is not None
        return number.value
    return number_of(case, datum).value
