"""What varied numbers do: they move the mechanism, reshape it, or change a load.

A number that only poses the figure becomes a condition on where the links are. Of the other data that
pose it, as many are held as the mechanism has freedoms left.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence

from icsolve.assembly import case_point, solve_figure
from icsolve.assembly.conditions import ahead_of
from icsolve.assembly.driven.constraints import (
    BodyLine,
    Constraint,
    Drawn,
    Immovable,
    OnLine,
    Pointed,
    Roped,
    SpotDistance,
    Turning,
)
from icsolve.assembly.driven.groups import DEPENDENT, as_written, derivatives, jacobian
from icsolve.assembly.driven.mechanism import Mechanism
from icsolve.assembly.driven.order import (
    AssemblyOrder,
    AssemblyStep,
    Closing,
    PlaceAtIntersection,
    PlaceByPoint,
    PlaceByTwoPoints,
    RotateWith,
)
from icsolve.assembly.driven.poses import Arm, Spot, minus, product
from icsolve.assembly.driven.poses import Places as Still
from icsolve.assembly.workspace import (
    CORNER,
    LENGTH,
    POSING,
    RAY,
    Datum,
    PlacedCase,
    X,
    Y,
    data_of,
    datum_at,
    normalised,
    number_of,
)
from icsolve.case import Case, Coordinates, Number, is_named
from icsolve.case.joints import Guided, Mesh, Rolling
from icsolve.errors import SceneError, Status
from icsolve.kinematics.accelerations import go_on_together
from icsolve.kinematics.motion import by_loops
from icsolve.numbers import FLOATS, Scalar
from icsolve.numbers.linear import Row, eliminate
from icsolve.screws import Point
from icsolve.sweep.varied_numbers import with_numbers
from icsolve.tuples import NamedTuple, replace
from icsolve.wording import listed, plural

SAME = 1e-8
"""Change of a distance that is none, where a coordinate changed by a thousandth (normalised)."""


Places = Mapping[str, tuple[float, float]]


def only_poses(mechanism: Mechanism, path: str, point: str, written: float) -> bool:
    """Whether a given coordinate only poses the figure: changed a little, it leaves every link's shape.

    The figure is solved again as if written so; what hangs on it must be as far apart as before.

    Parameters
    ----------
    path : of the coordinate
    point : its point; one of the frame's is none that poses
    written : its value [case length]
    """
    if (mechanism.top.ground, point) in mechanism.spots[mechanism.top.ground]:
        return False
    return _leaves_shapes(mechanism, path, written)


def turns_links(mechanism: Mechanism, path: str, moved: Collection[str], written: float) -> bool:
    """Whether a number that moves these points turns the links that carry them: links whose direction no
    joint's place tells, since they mesh, roll, bear a belt, or turn about one pivot alone; and all keep their
    shapes."""
    bonds = mechanism.top.bonds
    wheels = {b for bond in bonds if isinstance(bond.joint, Rolling | Mesh) for b in (bond.a, bond.b)}
    for body in range(len(mechanism.top.members)):
        own = [bond.joint for bond in bonds if body in (bond.a, bond.b)]
        if len({joint.pivot for joint in own}) == 1 and own[0].pivot is not None:
            wheels.add(body)
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
    names = [name for name in mechanism.shape.still if is_named(name)]
    near = {name: case_point(frame, still.place((0, name))) for name in names}
    known = mechanism.owners.keys() | mechanism.contacts.keys()
    figure = solve_figure(replace(other, near=near), [name for name in names if name in known])
    at = {name: case_point(figure.frame, place) for name, place in figure.points.items()}
    places = {name: normalised(frame, place) for name, place in at.items()}
    return _unmoved(mechanism, places) and _unbent(mechanism, places)


def _unbent(mechanism: Mechanism, places: Places) -> bool:
    """Points of a link are as far apart as before, and so is a rolling contact from the centres."""
    still = Still(mechanism.shape)
    for at, contact in mechanism.contacts.items():
        for centre in (contact.centre, contact.other):
            if at in places and centre is not None and centre[1] in places:
                before = math.dist(contact.place(still), still.place(centre))
                if abs(math.dist(places[at], places[centre[1]]) - before) > SAME:
                    return False
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
        isinstance(c, Turning) and c.alike and {one for one, _ in c.terms} == {body, ground}
        for c in mechanism.constraints
    )


def _beside(mechanism: Mechanism, index: int, line: BodyLine, places: Places) -> bool:
    """A guide, drawn anew as if written so, has the points of its link as far beside it as before."""
    joint = mechanism.case.joints[index]
    assert isinstance(joint, Guided)
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


def _off(now: tuple[float, float], before: Point, line: BodyLine) -> float:
    """How far a point has gone square to a line."""
    (x, y), (c, s) = minus(now, before), line.along
    return float(c * y - s * x)


# --- the data that pose a figure, as conditions on where the links are ---


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
    case, own = mechanism.case, datum_at(mechanism.case, path)
    if own is not None:
        return posing(mechanism, own)
    section, _, name = path.partition(".")
    point, _, axis = name.rpartition(".")
    if section != "points" or not isinstance(case.points.get(point), Coordinates):
        return None
    datum = Datum(X if axis == "x" else Y, point, (point,))
    return posing(mechanism, datum) if only_poses(mechanism, path, point, value_of(case, datum)) else None


def posing(mechanism: Mechanism, datum: Datum) -> Pose | None:
    """A datum with the spots of its points; None where they are all of one link (of the frame, for a
    direction or a coordinate), and where it puts a contact in another place, which is known as written alone:
    each value then is a figure written so."""
    ground = mechanism.top.ground
    if any(c.only_pushes and not c.stays_known and c.at in datum.points for c in mechanism.case.joints):
        return None
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
        return SpotDistance(spots[0], spots[1], value * scale)
    if datum.kind in (X, Y):
        along, axis = CENTRED[datum.kind]
        place = (value - mechanism.frame[axis]) * scale
        through = (place, 0.0) if axis == 0 else (0.0, place)
        return OnLine(spots[0], BodyLine(mechanism.top.ground, through, along))
    if datum.kind == CORNER:
        arms = _arms(mechanism, datum)
        if arms is not None:
            written = mechanism.shape.record.written(number_of(mechanism.case, datum))
            return Turning(((arms[1], 1.0), (arms[0], -1.0)), value - written)
        seen = _seen_from(mechanism, pose, value)
        if seen is not None:
            return seen
    if datum.kind == RAY and spots[0][0] == mechanism.top.ground:
        line = BodyLine(mechanism.top.ground, mechanism.shape.ref[datum.points[0]], _turned(mechanism, value))
        return OnLine(spots[1], line)
    return Drawn(datum, spots)


def _seen_from(mechanism: Mechanism, pose: Pose, value: Scalar) -> OnLine | None:
    """The end of a corner's arm on a line of the body that carries the corner and its other arm, if one
    does."""
    shape, (a, at, b) = mechanism.shape, pose.datum.points
    for near, far, sign in ((a, pose.spots[2], 1.0), (b, pose.spots[0], -1.0)):
        common = _carriers(mechanism, near) & _carriers(mechanism, at)
        if common:
            body = min(common, key=lambda body: body != mechanism.top.ground)
            x, y = minus(shape.ref[near], shape.ref[at])
            span = shape.span((body, at), (body, near))
            along = product((x / span, y / span), _turned(mechanism, sign * value))
            return OnLine(far, BodyLine(body, shape.ref[at], along))
    return None


def ahead_on(mechanism: Mechanism, pose: Pose, value: Scalar, places: Still) -> Scalar:
    """How far an angle between points of several links goes its way, which as a condition it has both ways;
    1 of any other datum."""
    datum, spots = pose.datum, pose.spots
    if datum.kind not in (RAY, CORNER) or len({spot[0] for spot in spots}) == 1:
        return 1.0
    if datum.kind == CORNER and _arms(mechanism, datum) is not None:
        return 1.0
    return ahead_of([places.place(spot) for spot in spots], _turned(mechanism, value))


def _turned(mechanism: Mechanism, value: Scalar) -> Point:
    return mechanism.shape.record.turned(value)


def _pointed(mechanism: Mechanism, spots: Sequence[Spot], number: Number, value: Scalar) -> Pointed:
    """The direction from one point of a body to another; its turning is counted from the figure's own."""
    (p, q), shape = spots, mechanism.shape
    length = shape.span(p, q)
    if not float(length):
        said = f"{p[1]} and {q[1]} lie at one place, so no direction from one to the other moves anything."
        raise SceneError(Status.UNSUPPORTED, said)
    x, y = minus(shape.still[q[1]], shape.still[p[1]])
    found = math.degrees(math.atan2(y, x))
    off = math.remainder(found - number.value, 360.0)
    written = shape.record.written(number)
    written = written if abs(off) <= ALIGNED else written + off
    return Pointed(p[0], Arm(p, q, length), value, written)


def _arms(mechanism: Mechanism, datum: Datum) -> tuple[int, int] | None:
    """The bodies that carry the arms of a corner, if there are two; the frame where it can be."""
    a, at, b = (_carriers(mechanism, name) for name in datum.points)
    ground = mechanism.top.ground
    one, two = (sorted(arm & at, key=lambda body: body != ground) for arm in (a, b))
    pairs = [(i, j) for i in one for j in two if i != j]
    return pairs[0] if pairs else None


def turning(mechanism: Mechanism, link: str, degrees: Scalar) -> Turning:
    """The condition that a link is turned by ``degrees`` from the position as written."""
    return Turning(((mechanism.top.body_of[link], 1.0),), degrees)


def value_of(case: Case, datum: Datum) -> float:
    """The number that the case writes for a datum [case units, degrees]."""
    if datum.kind in (X, Y):
        place = case.points[datum.points[0]]
        assert isinstance(place, Coordinates)
        number = place.x if datum.kind == X else place.y
        assert number is not None
        return number.value
    return number_of(case, datum).value


# --- what varied numbers do: they move the mechanism, reshape it, or change a load ---


class Freedoms(NamedTuple):
    """The motions that conditions leave to a mechanism in one position.

    Attributes
    ----------
    motions : independent ones, each the steps of the bodies by column (three a body: x, y of its base
        [frame], angle [rad]), the largest of them 1
    """

    motions: tuple[Row, ...]

    def without(self, condition: Row) -> Freedoms | None:
        """Those that keep one more condition; None where all of them keep it."""
        rates = [sum(a * motion.get(c, 0.0) for c, a in condition.items()) for motion in self.motions]
        most = max(range(len(rates)), key=lambda k: abs(rates[k]), default=None)
        if most is None or abs(rates[most]) <= DEPENDENT * max(map(abs, condition.values()), default=0.0):
            return None
        return Freedoms(
            tuple(
                _unit(_sum(motion, self.motions[most], -rates[k] / rates[most]))
                for k, motion in enumerate(self.motions)
                if k != most
            )
        )

    def alone(self, body: int) -> bool:
        """Whether one body (by its place in the columns) can move while all others stand."""
        others = [
            {c: a for c, a in motion.items() if c // 3 != body and abs(a) > NOISE} for motion in self.motions
        ]
        columns = max((c for motion in others for c in motion), default=-1) + 1
        return len(eliminate(others, columns, NOISE).pivots) < len(others)


NOISE = 1e-9
"""A part of a unit motion that is none (rounding)."""


def _freedoms(rows: Sequence[Row], bodies: int) -> Freedoms:
    """Of so many bodies under conditions."""
    found = eliminate(rows, 3 * bodies, DEPENDENT)
    motions = (
        {free: 1.0} | {c: row[free] for c, row in found.solved.items() if free in row} for free in found.free
    )
    return Freedoms(tuple(map(_unit, motions)))


def _unit(motion: Row) -> Row:
    most = max(map(abs, motion.values()))
    return {c: a / most for c, a in motion.items()}


def _sum(one: Row, other: Row, factor: float) -> Row:
    return {c: one.get(c, 0.0) + factor * other.get(c, 0.0) for c in one | other}


class Drive(NamedTuple):
    """What varied numbers do.

    Attributes
    ----------
    moving : the varied paths that move the mechanism; the others give another case in each row
    held : the data that are held while it moves, as many as it has freedoms left
    locked : bodies that only spin, which are kept from it
    closing : how the links close with all these as drivers, where that showed it; its conditions are
        those of the turned links, of the numbers, and of the mechanism
    poses : by path the data of ``moving``, where that showed it
    """

    moving: tuple[str, ...]
    held: tuple[Pose, ...]
    locked: tuple[int, ...]
    """bodies that only spin, which are kept from it"""
    closing: Closing | None = None
    poses: Mapping[str, Pose] = {}


def drive_of(mechanism: Mechanism, paths: Sequence[str], links: Sequence[str]) -> Drive:
    """Which varied paths move the mechanism, and what is held.

    Parameters
    ----------
    mechanism : in the position as written
    paths : of the varied numbers
    links : those that are turned

    Raises
    ------
    SceneError
        ``mobility`` where a link cannot be turned, or a number and a link take the same freedom; what a joint
        says that cannot be moved.
    """
    case = mechanism.case
    bodies = [body for body in mechanism.spots if body != mechanism.top.ground]
    written = as_written(mechanism, bodies)

    def row(constraint: Constraint) -> Row:
        return derivatives(bodies, written.of(constraint))

    left = _freedoms(jacobian(mechanism, bodies, mechanism.constraints), len(bodies))
    for n, link in enumerate(links):
        body = mechanism.top.body_of[link]
        taken = left.without(row(Turning(((body, 1.0),))))
        if taken is None:
            still = next((c for c in mechanism.constraints if isinstance(c, Immovable)), None)
            if still is not None and not left.motions:
                raise still.refusal
            if n and not left.motions:
                raise _too_many(f"the turning of link {link}", n, links[:n])
            raise _cannot_turn(link, bool(left.motions), body == mechanism.top.ground)
        left = taken
    moving: list[str] = []
    before = left
    for path in paths:
        pose = pose_of(mechanism, path)
        if pose is None:
            continue
        taken = left.without(row(condition(mechanism, pose, value_of(case, pose.datum))))
        if taken is not None:
            moving.append(path)
            left = taken
        elif links:
            raise _too_many(path, len(before.motions) + len(links), links)
        elif moving or not before.motions:
            moving, left = [], before
            break
    if not moving and not links:
        return Drive((), (), ())
    held, left = _held(mechanism, row, left, moving)
    drive = Drive(tuple(moving), held, _spinning(bodies, left))
    _refuse_change_point(mechanism, drive)
    return drive


def closed_drive(mechanism: Mechanism, paths: Sequence[str], links: Sequence[str]) -> Drive | None:
    """The drive where the links close step by step with these as drivers, and a count of freedoms leaves no
    condition to spare: each driver then takes a freedom of its own, and none is left. None where that does
    not show it, and the derivatives of all conditions have to (`drive_of`)."""
    poses = {path: pose for path in paths if (pose := pose_of(mechanism, path)) is not None}
    if mechanism.top.freedoms_by_count != len(poses) + len(links) or len(poses) + len(links) == 0:
        return None
    drivers: list[Constraint] = [turning(mechanism, link, 0.0) for link in links]
    drivers += [condition(mechanism, pose, value_of(mechanism.case, pose.datum)) for pose in poses.values()]
    constraints = [*drivers, *mechanism.constraints]
    if any(isinstance(c, (Immovable, Roped)) for c in constraints):
        return None
    order = AssemblyOrder(mechanism.shape, mechanism.spots, constraints)
    while len(order.full) < len(mechanism.spots):
        if not order.advance() or not _is_regular(order.steps[-1]):
            return None
    return Drive(tuple(poses), (), (), order.closing, poses)


def _is_regular(step: AssemblyStep) -> bool:
    """Whether a step takes as many conditions as it makes known numbers, and is nowhere singular: of
    the rotations that of a driver, of a body that turns alike, or of one that is geared to others."""
    if isinstance(step, RotateWith):
        by = step.by
        own = [float(f) for body, f in by.terms if body == step.body] if isinstance(by, Turning) else []
        return step.instead is None and (isinstance(by, Pointed) or sum(own) != 0.0)
    return isinstance(step, (PlaceByPoint, PlaceByTwoPoints, PlaceAtIntersection))


def _held(
    mechanism: Mechanism, row: Callable[[Constraint], Row], left: Freedoms, moving: Sequence[str]
) -> tuple[tuple[Pose, ...], Freedoms]:
    """The other data that pose the figure, as many as there are freedoms, and the freedoms they leave."""
    held = []
    for datum in data_of(mechanism.case):
        if not left.motions:
            break
        if datum.kind not in POSING or number_of(mechanism.case, datum).path in moving:
            continue
        pose = posing(mechanism, datum)
        if pose is None:
            continue
        taken = left.without(row(condition(mechanism, pose, value_of(mechanism.case, datum))))
        if taken is not None:
            held.append(pose)
            left = taken
    return tuple(held), left


def _refuse_change_point(mechanism: Mechanism, drive: Drive) -> None:
    """Refuse a position as written some of whose motions are for an instant alone, where something is held
    or spins by itself: it would be so by the first order of a motion that is none."""
    if not (drive.held or drive.locked):
        return
    place = PlacedCase(mechanism.case, mechanism.frame, mechanism.shape.still, FLOATS)
    try:
        motions = by_loops(place)
    except SceneError:  # a joint tells no motion there
        return
    if motions.redundant and go_on_together(place, motions.twists) is False:
        raise SceneError(
            Status.CHANGE_POINT,
            "the position as written is a change point: its links can move for an instant in more ways than "
            "they go on. Write the case in another position.",
        )


def _spinning(bodies: Sequence[int], left: Freedoms) -> tuple[int, ...]:
    """Bodies that are free to spin while all others stand."""
    return tuple(body for n, body in enumerate(bodies) if left.motions and left.alone(n))


def _too_many(path: str, freedoms: int, links: Sequence[str]) -> SceneError:
    return SceneError(
        Status.MOBILITY,
        f"{path} and the turning of {'link' if len(links) == 1 else 'links'} {listed(links)} cannot both be "
        f"given: the mechanism has {plural(freedoms, 'degree')} of freedom. Leave one out.",
    )


def _cannot_turn(link: str, left: bool, ground: bool) -> SceneError:
    why = f"link {link} is the frame" if ground else f"link {link} does not turn, or not by itself"
    other = "Turn another link, or vary"
    if not left and not ground:
        why, other = "nothing is left to move, the links hold one another", "Vary a load, or"
    return SceneError(
        Status.MOBILITY,
        f"link {link} cannot be the driving link: {why}. {other} an angle, a length or a coordinate that "
        "poses the figure.",
    )
