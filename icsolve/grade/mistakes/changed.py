"""Cases with one thing done wrong, as values: a load dropped or turned, degrees fed as radians, a part of a
rope not counted.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import islice

from icsolve.answer import Answer
from icsolve.case import (
    Area,
    Case,
    Corner,
    Direction,
    Force,
    ForceVector,
    Joint,
    Load,
    Motion,
    Number,
    Rope,
    Slide,
    Slope,
    Spring,
    Stretch,
    Torque,
    TorsionSpring,
    Toward,
    Weight,
    pair_name,
)
from icsolve.case.joints import Guided, Mesh, Sliding
from icsolve.case.joints import without_friction as smooth
from icsolve.numbers import FLOATS
from icsolve.screws.ropes import rope_parts, wrap_angle
from icsolve.statics.load_wrenches import as_given
from icsolve.tuples import NamedTuple, TypeVar, replace

Place = tuple[float, float]
MOST_MODES = 12
"""Other ways to assemble that are tried for one case."""


class Changed(NamedTuple):
    """A case that a student may have solved instead: the code of the mistake, where it sits, and the load
    whose share it changes, where it changes no other."""

    code: str
    case: Case
    where: str = ""
    load: str = ""


def changed_figures(case: Case, answer: Answer) -> Iterator[Changed]:
    """The case with its figure, its joints or its directions misread; ``answer`` has its points.

    A datum that is to find is read by nobody, so that no misreading of it is tried.
    """
    for figure, loads in ((True, True), (False, True), (True, False)):
        changed = _in_radians(case, figure, loads)
        if changed is not None:
            yield Changed("deg-rad", changed)
    for joint in case.joints:
        if isinstance(joint, Mesh):
            turned = _instead(case.joints, joint, joint.turned_round())
            yield Changed("mesh-sense", replace(case, joints=turned))
    for other in _other_modes(case, answer):
        yield Changed("other-mode", other)
    smooth = without_friction(case)
    if smooth is not None:
        yield Changed("no-friction", smooth)
        if case.motion:
            yield Changed("friction-sense", replace(case, motion=tuple(map(_reversed, case.motion))))
    yield from _changed_angles(case)
    yield from _wrong_stages(case)
    yield from _misread_bodies(case, answer)


def moves_otherwise(changed: Case, case: Case) -> bool:
    """Whether not the loads alone are others: else centres and ratios are the same."""
    return changed.angles is not case.angles or changed.joints is not case.joints or changed.near != case.near


def changed_loads(case: Case, points: Mapping[str, Place]) -> Iterator[Changed]:
    """The case without a load, with it reversed, and with what makes it misread."""
    known = list(known_loads(case))
    for load in known if len(known) > 1 else ():
        yield Changed("missed-load", with_load(case, scaled(load, 0.0)), load.name, load.name)
        yield Changed("load-sense", with_load(case, scaled(load, -1.0)), load.name, load.name)
    for load in case.loads:
        own = load.name if load in known else ""
        for code, other in _misread_load(load, points):
            yield Changed(code, with_load(case, other), load.name, own)


def _misread_load(load: Load, points: Mapping[str, Place]) -> Iterator[tuple[str, Load]]:
    """What a spring, a pressure, a force per length or a mass is often taken for."""
    match load:
        case Spring():
            yield "free-length", load._replace(free=_times(load.free, 0.0))
        case TorsionSpring():
            yield "free-length", load._replace(free=_times(load.free, 0.0))
            if isinstance(load.value, Number):
                yield "deg-rad", scaled(load, math.degrees(1.0))
        case Weight(value=Number()):
            yield "mass", load._replace(mass=not load.mass)
        case Force(over=Area() as area):
            num, den, pi = area.per
            for power in (pi, pi - 1) if area.bore is not None else ():  # a bore as radius, or squared alone
                yield "area", load._replace(over=area._replace(per=(4 * num, den, power)))
            if area.rod is not None:
                yield "area", load._replace(over=area._replace(rod=None))
        case Force(over=Stretch() as over):
            yield from (("line-load", other) for other in _elsewhere(load, over, points))


def _elsewhere(load: Force, over: Stretch, points: Mapping[str, Place]) -> Iterator[Force]:
    """A force per length whose length is left out, or whose resultant acts in another place."""
    yield load._replace(over=None)
    if not isinstance(load.value, Number) or over.a not in points or over.b not in points:
        return
    last = load.value.value if over.end is None else over.end.value
    length = math.dist(points[over.a], points[over.b])
    whole = _times(load.value, 0.5 * length * (1.0 + (last / load.value.value if load.value.value else 0.0)))
    yield load._replace(over=None, at=over.a, value=whole)
    yield load._replace(over=None, at=over.b, value=whole)
    if over.end is not None:
        yield load._replace(over=None, value=whole)  # in the middle
        yield load._replace(over=over._replace(end=None))  # uniform, as large as at its larger end
        yield load._replace(over=Stretch(over.b, over.a, over.end))  # its ends exchanged


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
    value = _times(load.value, factor)
    if isinstance(load, Force) and isinstance(load.over, Stretch) and load.over.end is not None:
        return load._replace(value=value, over=load.over._replace(end=_times(load.over.end, factor)))
    return load._replace(value=value)


def _times(number: Number, factor: float) -> Number:
    return _written(number, number.value * factor)


def _written(number: Number, value: float) -> Number:
    """Another value in place of a number, as if the case gave it."""
    return Number(value, 0.0, number.path, repr(value))


def turned_loads(answer: Answer) -> dict[str, Case]:
    """The case with each known load a quarter turn ccw, by its name, and with an unknown that is alone; those
    that have no direction of their own are left out."""
    case = answer.case
    single = len(answer.answers) == 1
    loads = [*known_loads(case), *(load for load in case.loads if single and load.name in answer.answers)]
    found = {load.name: turned(load, answer) for load in loads}
    return {name: with_load(case, load) for name, load in found.items() if load is not None}


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


def _in_radians(case: Case, figure: bool, loads: bool) -> Case | None:
    """The case with its degrees taken for radians, in the figure or in the loads; None where it has none."""
    angles, forces, joints = case.angles, case.loads, case.joints
    if figure:
        fed = (a._replace(value=_as_radians(a.value)) if _is_given(a, case) else a for a in angles)
        angles = tuple(fed)
        joints = tuple(_fed_joint(joint) for joint in joints)
    if loads:
        forces = tuple(_fed_load(load) for load in forces)
    if (angles, forces, joints) == (case.angles, case.loads, case.joints):
        return None
    return replace(case, angles=angles, loads=forces, joints=joints)


def _is_given(angle: Direction | Corner, case: Case) -> bool:
    """Whether an angle is a number of the case, and not what is asked."""
    return all(unknown.path != angle.value.path for unknown in case.unknowns)


def _fed_joint(joint: Joint) -> Joint:
    """A guide's direction or a contact's normal; multiples of 90 degrees need no calculator."""
    if isinstance(joint, Guided):
        angle = joint.guide.angle
        odd = angle is not None and angle.value % 90.0
        return (
            joint._replace(guide=joint.guide._replace(angle=_as_radians(angle))) if angle and odd else joint
        )
    if isinstance(joint, Sliding) and joint.normal.value % 90.0:
        return joint._replace(normal=_as_radians(joint.normal))
    return joint


T = TypeVar("T")


def _instead(items: tuple[T, ...], old: T, new: T) -> tuple[T, ...]:
    """The items with one of them replaced."""
    return tuple(new if item is old else item for item in items)


def _as_radians(angle: Number) -> Number:
    """``60`` taken for 60 rad, in degrees again."""
    return _written(angle, math.degrees(angle.value) % 360.0)


def _fed_load(load: Load) -> Load:
    if isinstance(load, Force) and isinstance(load.heading, Number):
        return load._replace(heading=_as_radians(load.heading))
    return load


def without_friction(case: Case) -> Case | None:
    """The case with smooth joints; None where they are so already."""
    joints = tuple(smooth(joint) for joint in case.joints)
    ropes = tuple(rope._replace(mu=(None,) * len(rope.mu)) for rope in case.ropes)
    if (joints, ropes) == (case.joints, case.ropes):
        return None
    return replace(case, joints=joints, ropes=ropes)


def _reversed(given: Motion) -> Motion:
    if given.turns is not None:
        return given._replace(turns="cw" if given.turns == "ccw" else "ccw")
    if given.angle is not None:
        return given._replace(angle=_written(given.angle, given.angle.value + 180.0))
    return given._replace(speed=_times(given.speed, -1.0)) if given.speed is not None else given


def _other_modes(case: Case, answer: Answer) -> Iterator[Case]:
    """The case started in the mirror image of each point that ``near`` places.

    A point at given distances from two others has two places, mirror images about the line of the two;
    one on a guide has two as well, about the foot of the other on the guide. At most `MOST_MODES`: each is
    solved, and points that are found together have images by the square of their lengths.
    """
    others = (
        replace(case, near={**case.near, name: image})
        for name in case.near
        if (here := answer.points.get(name)) is not None
        for image in _images(name, here, case, answer)
        if math.dist(here, image) > 1e-6 * (1.0 + math.hypot(*here))
    )
    yield from islice(others, MOST_MODES)


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
        guide = joint.guide
        if guide is None or joint.at != name or guide.angle is None:
            continue
        angle = math.radians(guide.angle.value)
        for centre in places:
            across = (centre[0] - math.sin(angle), centre[1] + math.cos(angle))
            yield _mirrored(here, centre, across)


def same_kind(a: Load, b: Load) -> bool:
    """Whether both are torques, or both forces."""
    return isinstance(a, Torque) == isinstance(b, Torque)


def _changed_angles(case: Case) -> Iterator[Changed]:
    """One given angle fed in radians, its sine taken for its cosine, or turned round."""
    for angle in case.angles:
        if not _is_given(angle, case):
            continue
        name = angle.a + angle.at + angle.b if isinstance(angle, Corner) else angle.a + angle.b
        for code, value in _misread(angle.value, len(case.angles) > 1):
            angles = _instead(case.angles, angle, angle._replace(value=value))
            yield Changed(code, replace(case, angles=angles), f"angle {name}")
    for load in known_loads(case):
        if isinstance(load, Force) and isinstance(load.heading, Number):
            for code, value in _misread(load.heading, True):
                other_load = with_load(case, load._replace(heading=value))
                yield Changed(code, other_load, f"angle of {load.name}")


def _misread(angle: Number, alone: bool) -> Iterator[tuple[str, Number]]:
    """An angle that is misread; of multiples of 90 degrees nothing is misread but their sense."""
    degrees = angle.value % 360.0
    if degrees % 90.0:
        if alone:
            yield "deg-rad", _as_radians(angle)
        if degrees % 45.0:
            yield "sin-cos", _written(angle, 90.0 - angle.value)
    if degrees % 180.0:
        yield "angle-sense", _written(angle, -angle.value)


def _wrong_stages(case: Case) -> Iterator[Changed]:
    """The case with the ratio of one mesh or belt left out, or upside down: between wheels that turn about
    the frame, where it is the ratio of their speeds."""
    for joint in case.joints:
        if not isinstance(joint, Mesh):
            continue
        first, second = joint.sizes
        if abs(first.value) != abs(second.value):
            links = pair_name(case, (joint.links[0], joint.links[1]))
            other = _written(first, abs(second.value))
            fixed = all(case.pivots(link, case.ground) for link in joint.links)
            for code, one in ([("inverse-ratio", other)] if fixed else []) + [("missed-stage", first)]:
                two = _written(second, math.copysign(first.value, second.value * first.value))
                joints = _instead(case.joints, joint, joint.resized((one, two)))
                yield Changed(code, replace(case, joints=joints), links)


TURN = 2.0 * math.pi
RPM = 30.0 / math.pi


def _misread_bodies(case: Case, answer: Answer) -> Iterator[Changed]:
    """The case with its ropes, screws and inertia forces misread; ``answer`` has its points."""
    for rope in case.ropes:
        for code, other in _ropes(rope, answer):
            ropes = _instead(case.ropes, rope, other)
            yield Changed(code, replace(case, ropes=ropes), f"rope {rope.name}")
    for joint in case.joints:
        for other_slide in _screws(joint) if isinstance(joint, Slide) and joint.thread is not None else ():
            yield Changed("lead", replace(case, joints=_instead(case.joints, joint, other_slide)))
    if case.dynamic:
        yield from _masses(as_given(case))


def _ropes(rope: Rope, answer: Answer) -> Iterator[tuple[str, Rope]]:
    """A rope with parts not counted, round another side of a pulley, or with a wrong angle of wrap."""
    last = len(rope.points) - 1
    for k in range(1, last - 1):
        if rope.points[k] == rope.points[k + 2] or rope.points[k - 1] == rope.points[k + 1]:
            yield "rope-parts", _without(rope, (k, k + 1))
    if not rope.is_free and last > 1:
        yield from (("rope-parts", _without(rope, (k,))) for k in range(1, last))
    for k, mu in enumerate(rope.mu):
        if mu is None or not all(p in answer.points for p in rope.points):
            continue
        parts = rope_parts(rope, answer.points, 1.0, FLOATS)
        beta = wrap_angle(rope, k, parts[k - 1], parts[k])
        whole = TURN * rope.whole_turns(k)
        angles = [TURN - beta + 2.0 * whole, math.pi - beta, 1.0]  # the other side, its supplement
        angles += [beta - whole, beta - TURN, beta + TURN] if whole else []
        for code, angle in [*(("wrap", a) for a in angles), ("deg-rad", math.degrees(beta))]:
            if angle > 0.0 and beta and mu.value * angle < 700.0:
                other = _written(mu, mu.value * angle / beta)
                yield code, rope._replace(mu=(*rope.mu[:k], other, *rope.mu[k + 1 :]))


def _without(rope: Rope, places: tuple[int, ...]) -> Rope:
    """The rope past some of its pulleys."""
    kept = [k for k in range(len(rope.points)) if k not in places]
    return rope._replace(
        points=tuple(rope.points[k] for k in kept),
        links=tuple(rope.links[k] for k in kept if k < len(rope.links)),
        radii=tuple(rope.radii[k] for k in kept),
        wraps=tuple(rope.wraps[k] for k in kept),
        mu=tuple(rope.mu[k] for k in kept),
        turns=tuple(rope.turns[k] for k in kept if rope.turns),
    )


def _screws(slide: Slide) -> Iterator[Slide]:
    """A screw whose lead is taken for its way a radian, or that a radius alone measures."""
    assert slide.thread is not None
    lead = slide.thread.lead
    for factor in (TURN, 0.5, 2.0):
        yield slide._replace(thread=slide.thread._replace(lead=_written(lead, lead.value * factor)))


def _masses(case: Case) -> Iterator[Changed]:
    """Inertia forces left out, of one link or all; revolutions for radians; an acceleration left out."""
    yield Changed("no-inertia", replace(case, dynamic=False))
    for link, own in case.inertia.items():
        others = {name: inertia for name, inertia in case.inertia.items() if name != link}
        if others:
            yield Changed("no-inertia", replace(case, inertia=others), f"link {link}")
        if own.mass is not None and own.moment is not None:
            point = case.inertia | {link: own._replace(moment=None)}
            yield Changed("no-inertia", replace(case, inertia=point), f"the couple of link {link}")
    for factor in (RPM, 1.0 / RPM):
        faster = (given._replace(speed=given.speed and _times(given.speed, factor)) for given in case.motion)
        yield Changed("rpm", replace(case, motion=tuple(faster)))
    if any(given.acceleration is not None for given in case.motion):
        steady = tuple(given._replace(acceleration=None) for given in case.motion)
        yield Changed("no-acceleration", replace(case, motion=steady))
        turned = (given.acceleration and _times(given.acceleration, -1.0) for given in case.motion)
        slowing = (given._replace(acceleration=a) for given, a in zip(case.motion, turned, strict=True))
        yield Changed("no-acceleration", replace(case, motion=tuple(slowing)))
