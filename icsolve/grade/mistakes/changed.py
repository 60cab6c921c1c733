"""Cases with one thing done wrong, as values: a load dropped or turned, degrees fed as radians."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

from icsolve.answer import Answer
from icsolve.case import (
    Belt,
    Case,
    Contact,
    Corner,
    Direction,
    Force,
    ForceVector,
    Gears,
    Joint,
    Load,
    Motion,
    Number,
    Slide,
    Slope,
    Slot,
    Torque,
    Toward,
    Weight,
)

Place = tuple[float, float]


def known_loads(case: Case) -> Iterator[Load]:
    """The loads whose own numbers are given."""
    for load in case.loads:
        if isinstance(load, ForceVector) or isinstance(load.value, Number):
            yield load


def with_load(case: Case, changed: Load) -> Case:
    """The case with the load of that name replaced."""
    return replace(case, loads=tuple(changed if load.name == changed.name else load for load in case.loads))


def scaled(load: Load, factor: float) -> Load:
    """The load times a factor: 0 leaves it out, -1 reverses it."""
    if isinstance(load, ForceVector):
        return load._replace(x=_times(load.x, factor), y=_times(load.y, factor))
    assert isinstance(load.value, Number)
    return load._replace(value=_times(load.value, factor))


def _times(number: Number, factor: float) -> Number:
    return number._replace(value=number.value * factor)


def turned(load: Load, answer: Answer) -> Load | None:
    """The force a quarter turn ccw; None for a load without a direction of its own."""
    if isinstance(load, ForceVector):
        return load._replace(x=_times(load.y, -1.0), y=load.x)
    if isinstance(load, Weight):
        if load.mass:
            return None
        return Force(load.name, load.link, load.at, load.value, _degrees(0.0))
    if not isinstance(load, Force):
        return None
    heading = heading_of(load, answer)
    return load._replace(heading=_degrees(heading + 90.0)) if heading is not None else None


def heading_of(load: Load, answer: Answer) -> float | None:
    """The direction of a positive load in degrees ccw from +x; None for a load that has none."""
    match load:
        case Weight():
            return -90.0
        case ForceVector():
            return math.degrees(math.atan2(load.y.value, load.x.value))
        case Force(heading=Number() as angle):
            return angle.value
        case Force(heading=Slope() as slope):
            return math.degrees(math.atan2(slope.rise.value, slope.run.value))
        case Force(heading=Toward() as toward):
            here, there = place_of(load.at, answer), place_of(toward.point, answer)
            if here is None or there is None:
                return None
            angle_there = math.degrees(math.atan2(there[1] - here[1], there[0] - here[0]))
            return angle_there + (180.0 if toward.away else 0.0)
    return None


def place_of(name: str, answer: Answer) -> Place | None:
    """Where a point is, also one that a load gives by coordinates."""
    if name in answer.points:
        return answer.points[name]
    given = answer.case.points.get(name)
    x, y = getattr(given, "x", None), getattr(given, "y", None)
    return (x.value, y.value) if x is not None and y is not None else None


def _degrees(value: float) -> Number:
    return Number(value, 0.0, "angle", f"{value:.17g}")


def in_radians(case: Case, figure: bool, loads: bool) -> Case | None:
    """The case with its degrees taken for radians, in the figure or in the loads; None where it has none."""
    angles, forces, joints = case.angles, case.loads, case.joints
    if figure:
        angles = tuple(_fed(angle) for angle in angles)
        joints = tuple(_fed_joint(joint) for joint in joints)
    if loads:
        forces = tuple(_fed_load(load) for load in forces)
    if (angles, forces, joints) == (case.angles, case.loads, case.joints):
        return None
    return replace(case, angles=angles, loads=forces, joints=joints)


def _fed_joint(joint: Joint) -> Joint:
    """A guide's direction or a contact's normal; multiples of 90 degrees need no calculator."""
    if isinstance(joint, Slide | Slot) and joint.guide.angle is not None and joint.guide.angle.value % 90.0:
        return joint._replace(guide=joint.guide._replace(angle=as_radians(joint.guide.angle)))
    if isinstance(joint, Contact) and joint.normal.value % 90.0:
        return joint._replace(normal=as_radians(joint.normal))
    return joint


def with_other_meshes(case: Case) -> Iterator[Case]:
    """The case with one mesh or belt turning its wheels the other way."""
    for n, joint in enumerate(case.joints):
        other: Joint | None = None
        if isinstance(joint, Gears):
            first, second = joint.teeth
            other = joint._replace(teeth=(first, _times(second, -1.0)))
        elif isinstance(joint, Belt):
            other = joint._replace(crossed=not joint.crossed)
        if other is not None:
            yield replace(case, joints=(*case.joints[:n], other, *case.joints[n + 1 :]))


def _fed(angle: Direction | Corner) -> Direction | Corner:
    return angle._replace(value=as_radians(angle.value))


def as_radians(angle: Number) -> Number:
    """``60`` taken for 60 rad, in degrees again."""
    return angle._replace(value=math.degrees(angle.value) % 360.0)


def _fed_load(load: Load) -> Load:
    if isinstance(load, Force) and isinstance(load.heading, Number):
        return load._replace(heading=as_radians(load.heading))
    return load


def without_friction(case: Case) -> Case | None:
    """The case with smooth joints; None where they are so already."""
    joints = tuple(_smooth(joint) for joint in case.joints)
    return replace(case, joints=joints) if joints != case.joints else None


def _smooth(joint: Any) -> Any:
    return joint._replace(friction=None) if getattr(joint, "friction", None) is not None else joint


def with_motion_reversed(case: Case) -> Case | None:
    """The case moving the other way, so that its friction is turned; None where none is given."""
    if not case.motion or without_friction(case) is None:
        return None
    return replace(case, motion=tuple(_reversed(given) for given in case.motion))


def _reversed(given: Motion) -> Motion:
    if given.turns is not None:
        return given._replace(turns="cw" if given.turns == "ccw" else "ccw")
    if given.angle is not None:
        return given._replace(angle=_times(given.angle, 1.0)._replace(value=given.angle.value + 180.0))
    return given._replace(speed=_times(given.speed, -1.0)) if given.speed is not None else given


def other_modes(case: Case, answer: Answer) -> Iterator[Case]:
    """The case started in the mirror image of each point that ``near`` places.

    A point at given distances from two others has two places, mirror images about the line of the two;
    one on a guide has two as well, about the foot of the other on the guide.
    """
    for name in case.near:
        here = answer.points.get(name)
        if here is None:
            continue
        for image in _images(name, here, case, answer):
            if math.dist(here, image) > 1e-6 * (1.0 + math.hypot(*here)):
                yield replace(case, near={**case.near, name: image})


def _images(name: str, here: Place, case: Case, answer: Answer) -> Iterator[Place]:
    """Mirror images of a point about the lines of the points at given distances from it."""
    others = [b if a == name else a for a, b, _ in case.lengths if name in (a, b)]
    places = [answer.points[other] for other in others if other in answer.points]
    for index, first in enumerate(places):
        for second in places[index + 1 :]:
            yield _mirrored(here, first, second)
    yield from _on_guides(name, here, places, case)


def _mirrored(p: Place, a: Place, b: Place) -> Place:
    """p mirrored about the line through a and b; about a where they coincide."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    if square == 0.0:
        return 2.0 * a[0] - p[0], 2.0 * a[1] - p[1]
    along = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square
    foot = (a[0] + along * dx, a[1] + along * dy)
    return 2.0 * foot[0] - p[0], 2.0 * foot[1] - p[1]


def _on_guides(name: str, here: Place, places: list[Place], case: Case) -> Iterator[Place]:
    """The other end of the chord that a guide of a given direction cuts from a circle about a point."""
    for joint in case.joints:
        guide = getattr(joint, "guide", None)
        if guide is None or joint.at != name or guide.angle is None:  # type: ignore[union-attr]
            continue
        angle = math.radians(guide.angle.value)
        for centre in places:
            across = (centre[0] - math.sin(angle), centre[1] + math.cos(angle))
            yield _mirrored(here, centre, across)


Resolve = Callable[[Case | None], "dict[str, float]"]
"""The answers of a changed case by name; empty where it has none."""


def same_kind(a: Load, b: Load) -> bool:
    """Whether both are torques, or both forces."""
    return isinstance(a, Torque) == isinstance(b, Torque)
