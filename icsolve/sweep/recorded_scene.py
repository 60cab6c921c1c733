"""The statics of every row: plan, twists and power of one scene, with the same kernels, on the record."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress

from icsolve.assembly.driven.constraints import ConditionRows
from icsolve.assembly.driven.groups import as_written
from icsolve.assembly.driven.mechanism import Mechanism
from icsolve.assembly.driven.motion import DrivenMotion, pace
from icsolve.assembly.driven.poses import Moved, Spot, plus, product
from icsolve.assembly.workspace import Frame, PlacedCase, Workspace
from icsolve.case import (
    AlongRope,
    Case,
    Centroid,
    Contact,
    Force,
    ForceVector,
    Guide,
    Inertia,
    Joint,
    Load,
    Motion,
    Number,
    Pair,
    Rope,
    Slope,
    Spring,
    Stretch,
    TorsionSpring,
    Toward,
    Weight,
    is_named,
    ordered_pair,
)
from icsolve.case.joints import Guided, Mesh, Radius, RadiusOfRow
from icsolve.errors import SceneError
from icsolve.kinematics import accelerations, motion, speeds
from icsolve.kinematics.accelerations import Moving
from icsolve.numbers import FLOATS, Scalar, all_vanish, largest_of, turn_of
from icsolve.numbers.record import Record, varies
from icsolve.scene import refusals
from icsolve.screws import Point, Triple, subtract, velocity
from icsolve.screws.joints import freedoms, pitch_point
from icsolve.statics import load_wrenches, power
from icsolve.statics.equilibrium import equilibrium
from icsolve.statics.reaction_basis import Position, rope_ties, ties_of
from icsolve.structure import Topology, topology
from icsolve.structure.plan import make_plan
from icsolve.sweep.varied_numbers import number_at, with_numbers
from icsolve.tuples import NamedTuple, replace

Points = dict[str, Point]

TILT = 40.0
"""Degrees by which the normal of a contact is off where the record is made, toward the way in which its
follower moves: nothing rests there, as in a dwell, and nothing all but jams."""


Twists = Mapping[str, tuple[Triple, ...]]


class RowDriver(NamedTuple):
    """What drives a mechanism of one freedom: how fast it changes in the motion of a row; whether it grows
    (1) or falls (-1) where points of links move as given in the position as written, by link and point."""

    pace: Callable[[Twists], Scalar]
    written: Mapping[tuple[str, str], float]


class RecordedScene(NamedTuple):
    """A case on a record.

    Attributes
    ----------
    case : whose guides and headings are directions on the record
    frame : scale and origin of the frame of size 1
    record : that of all expressions
    points : by name, (x, y) [frame]
    driver : where points have given motions that go on from row to row
    """

    case: Case
    top: Topology
    frame: Frame
    record: Record
    points: Points
    driver: RowDriver | None = None

    @property
    def place(self) -> PlacedCase:
        """As the kernels take it."""
        return PlacedCase(self.case, self.frame, self.points, self.record)


class RecordedStatics(NamedTuple):
    """The statics of every row.

    Attributes
    ----------
    answers : by unknown load, an expression [case units]
    motions : by link, one twist a freedom, expressions [frame length/s, frame length/s, rad/s]
    refusal : why there are no answers in any row; None where there are
    balance : factors of the loads
    spent : nodes of what was taken as zero in the sums of power, though doubles do not show it, and beside
        what size
    moves : the given motion with its accelerations; None where a scene of its own has to tell it, or it is
        not asked for
    """

    answers: dict[str, Scalar]
    motions: motion.Motions
    refusal: SceneError | None
    balance: power.Balance
    spent: tuple[tuple[int, float], ...] = ()
    moves: Moving | None = None

    @property
    def cancels(self) -> bool:
        """Whether the powers of the known loads all but cancel, or those of what a load is made of."""
        sizes = [
            power.known_terms(self.balance, self.motions.twists, m) for m in range(len(self.balance.factors))
        ]
        return any(0.0 < abs(left) < power.CANCELLED * size for left, size in sizes)

    @property
    def delicate(self) -> bool:
        """Whether it moves only because its data are exact, or nearly so."""
        return bool(self.motions.redundant or self.motions.slack)

    @property
    def idle(self) -> bool:
        """Whether the known loads do no work in any row: what the unknown one does may then be rounding
        alone, and any value of it balances.
        """
        return any(not varies(value) and not float(value) for value in self.answers.values())


# --- a case in motion -----------------------------------------------------------------------------


class _Writer:
    """Rewrites joints and loads so that what they name is told by the links that carry it."""

    def __init__(self, mechanism: Mechanism, moved: Moved) -> None:
        self.mechanism, self.moved = mechanism, moved
        self.record, self.body_of = mechanism.shape.record, mechanism.top.body_of
        self.points = {name: moved.place(spot) for name, spot in mechanism.owners.items()}
        self.points |= {name: contact.place(moved) for name, contact in mechanism.contacts.items()}
        self.ropes = tuple(map(self._rope, mechanism.case.ropes))
        for name, place in mechanism.case.points.items():
            if isinstance(place, Centroid) and set(place.of) <= self.points.keys():
                self.points.setdefault(name, _mean([self.points[p] for p in place.of]))

    def on(self, spot: Spot) -> str:
        """A name for the point as this body carries it; a rolling contact goes on along both of its links."""
        one, owner = self.mechanism.shape.one, self.mechanism.owners.get(spot[1])
        if owner is not None and one(owner) == one(spot) and spot[1] not in self.mechanism.contacts:
            return spot[1]
        key = f"@{spot[1]} on {self.mechanism.top.members[spot[0]][0]}"
        self.points[key] = self.moved.place(spot)
        return key

    def inertia(self, link: str, inertia: Inertia) -> Inertia:
        """A mass at a point that its link carries."""
        if inertia.centre is None:
            return inertia
        return inertia._replace(centre=self.on((self.body_of[link], inertia.centre)))

    def joint(self, index: int, joint: Joint) -> Joint:
        """A joint whose guide is a direction that its link carries."""
        if not isinstance(joint, Guided):
            return joint
        line = self.mechanism.lines[index]
        number = joint.guide.angle or Number(0.0, 0.0, f"joints.{index}.along", "0")
        along = self.record.direct(number, self.moved.vector(line.body, line.along))
        at = self.on((self.body_of[joint.links[0]], joint.at))
        return joint._replace(at=at, guide=Guide(along, None, None))

    def _rope(self, rope: Rope) -> Rope:
        """A rope at points that its links carry; a free end keeps its way from the last pulley."""
        spots = [(self.body_of[link], point) for link, point in zip(rope.links, rope.points, strict=False)]
        points = [self.on(spot) for spot in spots]
        if rope.is_free:
            end = rope.points[-1]
            points.append(end if end not in self.mechanism.owners else f"@{end} of {rope.name}")
            line = self.mechanism.shape.between(spots[-1], (spots[-1][0], rope.points[-1]))
            self.points[points[-1]] = plus(self.moved.place(spots[-1]), line)
        return rope._replace(points=tuple(points))

    def load(self, load: Load) -> Load:
        """A load at points that its links carry, in a direction that holds or turns with a link."""
        ground = self.mechanism.case.ground
        if isinstance(load, TorsionSpring):
            return load._replace(corner=self._corner(load, load.against or ground))
        if not isinstance(load, (Force, ForceVector, Weight, Spring)):
            return load
        if load.link not in self.body_of:
            rope = next(rope for rope in self.ropes if rope.end == load.link)
            load = load._replace(at=rope.points[-1])
            return load._replace(heading=AlongRope(rope)) if isinstance(load, Force) else load
        spot = (self.body_of[load.link], load.at)
        load = load._replace(at=self.on(spot))
        if isinstance(load, Weight):
            return load
        if isinstance(load, Spring):
            return load._replace(to=self.on((self.body_of[load.against or ground], load.to)))
        if isinstance(load, Force) and isinstance(load.over, Stretch):
            a, b = (self.on((spot[0], end)) for end in (load.over.a, load.over.b))
            load = load._replace(over=load.over._replace(a=a, b=b))
        return self._turned(load, spot) if load.turns_with else load

    def _corner(self, load: TorsionSpring, against: str) -> tuple[str, ...]:
        """The corner that a torsion spring follows: its last arm is of the spring's link, the first of the
        link against it, which may have its own point there."""
        *arm, at, end = load.corner
        body, other = self.body_of[load.link], self.body_of[against]
        own = (self.on((body, at)), self.on((body, end)))
        if not arm:
            return own
        if self.on((other, at)) == own[0]:
            return (self.on((other, arm[0])), *own)
        line = self.mechanism.shape.between((other, at), (other, arm[0]))
        self.points[f"@{load.name} against"] = plus(self.points[own[0]], self.moved.vector(other, line))
        return (f"@{load.name} against", *own)

    def _turned(self, load: Force | ForceVector, spot: Spot) -> Load:
        """A load whose direction turns with a link: one toward a point as it did where it is written."""
        record = self.record
        z = self.moved.vector(self.body_of[load.turns_with or ""], (1.0, 0.0))
        if isinstance(load, ForceVector):
            x, y = product(z, (record.given(load.x), record.given(load.y)))
            return load._replace(x=record.stand(load.x, x), y=record.stand(load.y, y))
        if isinstance(load.heading, Slope):
            run, rise = load.heading
            x, y = product(z, (record.given(run), record.given(rise)))
            return load._replace(heading=Slope(record.stand(run, x), record.stand(rise, y)))
        if isinstance(load.heading, Toward):
            line = product(z, self.mechanism.shape.between(spot, (spot[0], load.heading.point)))
            self.points[f"@{load.name} turned"] = plus(self.moved.place(spot), line)
            return load._replace(heading=load.heading._replace(point=f"@{load.name} turned"))
        assert isinstance(load.heading, Number)
        return load._replace(heading=record.direct(load.heading, product(z, record.turn(load.heading))))


def _mean(places: Sequence[Point]) -> Point:
    x, y = places[0]
    for px, py in places[1:]:
        x, y = x + px, y + py
    return (x / float(len(places)), y / float(len(places)))


def moved_scene(driven: DrivenMotion) -> RecordedScene:
    """The case with each point told by the link that carries it, and directions that links carry."""
    mechanism, moved = driven.mechanism, driven.moved
    write, case = _Writer(mechanism, moved), mechanism.case
    joints = tuple(write.joint(i, joint) for i, joint in enumerate(case.joints))
    loads = tuple(map(write.load, case.loads))
    inertia = {link: write.inertia(link, own) for link, own in case.inertia.items()}
    rewritten, told = case, (joints, loads, write.ropes, inertia)
    if told != (case.joints, case.loads, case.ropes, case.inertia):
        rewritten = replace(case, joints=joints, loads=loads, ropes=write.ropes, inertia=inertia)
    scene = RecordedScene(
        rewritten, topology(rewritten), mechanism.frame, mechanism.shape.record, write.points
    )
    if not any(given.point for given in case.motion):
        return scene
    return _going_on(scene, driven)


def _going_on(scene: RecordedScene, driven: DrivenMotion) -> RecordedScene:
    """The scene whose given motions go on: a point's direction along its path, where there is one freedom."""
    found = motions_of(scene)
    if found.mobility == 1:
        scene = scene._replace(driver=_driver(driven))
    turned = []
    for given in scene.case.motion:
        if given.point is not None and given.angle is not None:
            angle = None
            if found.mobility == 1:
                v = velocity(found.twists[given.link][0], scene.points[given.point])
                sense = _sense(scene, found.twists, given)
                angle = scene.record.direct(given.angle, (sense * v[0], sense * v[1]))
            given = given._replace(angle=angle)  # noqa: PLW2901
        turned.append(given)
    return scene._replace(case=replace(scene.case, motion=tuple(turned)))


def _driver(driven: DrivenMotion) -> RowDriver:
    """The driver of a mechanism, with the senses of the given motions."""
    held, moved = driven.mechanism, driven.moved
    rows = ConditionRows(held.shape, moved, moved.bases, Workspace(held.case, held.frame, held.shape.record))
    points, senses = held.shape.still, {}
    with suppress(SceneError):  # there the motion is not told
        twists = motion.by_loops(PlacedCase(held.case, held.frame, points, FLOATS)).twists
        largest, still = speeds.fastest(twists), as_written(held, [*moved.bases])
        rate = pace(held, still, driven.driver, twists)
        for given in held.case.motion:
            if given.point is None or len(twists[given.link]) > 1:
                continue
            v = velocity(twists[given.link][0], points[given.point])
            if not (FLOATS.vanishes(rate, largest) or all_vanish(FLOATS, ((x, largest) for x in v))):
                senses[given.link, given.point] = (1.0 if rate > 0.0 else -1.0) * _along(v, given)
    return RowDriver(lambda twists: pace(held, rows, driven.driver, twists), senses)


def _sense(scene: RecordedScene, twists: Twists, given: Motion) -> Scalar:
    """1 or -1: whether a point's given motion goes on in the sense of the twists of a row.

    In it the driver goes on as in the position as written. Where the mechanism passes through a change point
    the twists turn round; where the driver is at a limit they are those of the rows beside it.
    """
    assert given.point is not None
    now = _along(velocity(twists[given.link][0], scene.points[given.point]), given)
    if scene.driver is None:
        return now
    rate = scene.driver.pace(twists)
    here = 1.0 if float(rate) > 0.0 else -1.0
    onward, _ = scene.record.turned(scene.record.angle(here * rate, 0.0))  # 1 where it has this sign
    written = scene.driver.written.get((given.link, given.point))
    return onward * (now if written is None else written * here)


def _along(v: Point, given: Motion) -> float:
    """1 where a velocity has the sense of a given direction, else -1."""
    assert given.angle is not None
    c, s = FLOATS.turn(given.angle)
    return 1.0 if float(v[0]) * c + float(v[1]) * s > 0.0 else -1.0


class RestingContact(NamedTuple):
    """A contact whose place and normal every row tells for itself, and the cam's radius of curvature there.

    Attributes
    ----------
    place : where it stands among the joints
    joint, at : the contact as written, and its place there [case units]
    cam, radius : which of its links is the cam; its radius of curvature there, a ratio
    tilt : by how many degrees the normal is off where the record is made
    roller : of a roller, of which the normal tells the place, the centre, and how far the contact is from it
        along the normal
    """

    place: int
    joint: Contact
    at: Point
    cam: int
    radius: tuple[float, float]
    tilt: float
    roller: tuple[str, float] | None = None

    @property
    def inputs(self) -> tuple[str, ...]:
        """The names of the inputs: those of the unit normal and of the radius, `RadiusOfRow`; x and y where
        the normal does not tell the place."""
        parts = ("across", "up", "above", "below", "x", "y")[: 4 if self.roller else 6]
        return tuple(f"{self.joint.at} {part}" for part in parts)

    @property
    def written(self) -> tuple[float, ...]:
        """Values of the inputs beside the position as written."""
        return (*turn_of(self.joint.normal.value + self.tilt), *self.radius, *self.at)


def rested(scene: RecordedScene, contacts: Sequence[RestingContact], inputs: dict[str, int]) -> RecordedScene:
    """The scene with these contacts; the inputs of the record are noted."""
    if not contacts:
        return scene
    joints, points, record = list(scene.case.joints), dict(scene.points), scene.record
    ox, oy, scale = scene.frame
    for contact in contacts:
        own = contact.joint
        nodes = [record.input(name, v) for name, v in zip(contact.inputs, contact.written, strict=False)]
        inputs |= {name: node.index for name, node in zip(contact.inputs, nodes, strict=True)}
        c, s, above, below, *place = nodes
        if contact.roller is not None:
            (x, y), off = scene.points[contact.roller[0]], contact.roller[1] * scale
            points[own.at] = (x + off * c, y + off * s)
        else:
            points[own.at] = ((place[0] - ox) * scale, (place[1] - oy) * scale)
        normal = record.direct(own.normal, (c, s))
        assert own.radii is not None
        radii: list[Radius] = list(own.radii)
        numbers = (Number(0.0, 0.0, name, "0") for name in contact.inputs[2:4])
        radii[contact.cam] = RadiusOfRow(*map(record.stand, numbers, (above, below)))
        joints.insert(contact.place, own._replace(normal=normal, radii=(radii[0], radii[1])))
    case = replace(scene.case, joints=tuple(joints))
    return scene._replace(case=case, top=topology(case), points=points)


# --- statics --------------------------------------------------------------------------------------


def statics(scene: RecordedScene, everything: bool, dynamic: bool = False) -> RecordedStatics:
    """Unknown loads and twists of the scene on the record; with ``everything`` the twist of every link,
    ``dynamic`` with the inertia forces of the given motion."""
    case, top, place = scene.case, scene.top, scene.place
    unknown = any(map(power.is_unknown, case.loads))
    some = unknown and not (everything or dynamic or case.ropes or case.screws)
    wanted = frozenset(top.body_of[link] for link in load_wrenches.moving_links(case)) if some else None
    motions = motions_of(scene, wanted)
    moves = moving(scene, motions) if dynamic else None
    scene.record.spent.clear()  # of what the motions were found by
    if moves is not None:
        loads = (*case.loads, *load_wrenches.inertia_of_one(case))
        place = place._replace(case=replace(case, loads=loads))
    wrenches = load_wrenches.wrenches(place)
    if moves is not None:
        wrenches = load_wrenches.exactly(place, moves, wrenches)
    balance = power.balance(wrenches, motions.twists, motions.mobility)
    solution = power.solve_balance(balance, scene.record)
    spent = tuple(scene.record.spent.items())
    try:
        floats = place._replace(arithmetic=FLOATS)
        refusals.refuse_unbalanced(power.Outcome(floats, motions, balance, solution))
    except SceneError as error:
        return RecordedStatics({}, motions, error, balance, moves=moves)
    answers = {w.load.name: w.ratio * solution.values[w.root] for w in wrenches if w.root in solution.values}
    return RecordedStatics(answers, motions, None, balance, spent, moves)


def motions_of(scene: RecordedScene, wanted: Collection[int] | None = None) -> motion.Motions:
    """The motions of the wanted bodies (None: of all), by the plan or by all loop equations at once."""
    top = scene.top
    plan = make_plan(top, wanted if wanted is not None else range(len(top.members)))
    found = None
    if plan is not None and plan.closed and not scene.case.ropes:
        found = motion.by_plan(plan, scene.place, wanted)
    if found is None:
        found = motion.by_loops(scene.place)
    return motion.with_ends(found, scene.place)


def moving(scene: RecordedScene, found: motion.Motions) -> Moving | None:
    """The given motion of every row with its accelerations, as one scene has them; None where that takes a
    scene of its own: where a given speed is open in a row, or inertia forces, or joints are redundant."""
    given, top, record = scene.case.motion, scene.top, scene.record
    within = 0 < len(given) <= found.mobility
    if not within or found.redundant or found.slack or any(m.speed is None for m in given):
        return None
    try:
        if found.mobility > 1:
            speeds_vary = any(varies(record.given(m.speed)) for m in given if m.speed is not None)
            open_ = speeds_vary or any(m.point is not None for m in given)
            moves = None if open_ else accelerations.moving(scene.place, found.twists)
        else:
            per, links = _in_time(scene, found), (link for link in found.twists if link in top.body_of)
            twists = {link: per(found.twists[link][0]) for link in links}
            more = record.given(given[0].acceleration) if given[0].acceleration is not None else 0.0
            moves = accelerations.accelerated(scene.place, twists, [_driven(scene, twists, more)])
    except SceneError:
        return None
    return None if moves is None or moves.open & scene.case.inertia.keys() else moves


def sign_of_speed(record: Record, given: Number) -> Scalar:
    """1 or -1, the sign of a given speed in each row; not a number in a row whose speed is zero."""
    speed = record.given(given)
    return speed / record.sqrt(speed * speed) if varies(speed) else math.copysign(1.0, given.value)


def _driven(scene: RecordedScene, twists: Mapping[str, Triple], more: Scalar) -> accelerations.Drive:
    """What the one given motion accelerates, the way it goes in each row."""
    (given,), record = scene.case.motion, scene.record
    assert given.speed is not None
    if given.point is None:
        sign = sign_of_speed(record, given.speed)
        return given, None, -(sign * more) if given.turns == "cw" else sign * more
    x, y = velocity(twists[given.link], scene.points[given.point])
    size = record.sqrt(x * x + y * y)
    return given, (x / size, y / size), more * scene.frame.scale


class Pressing(NamedTuple):
    """Forces of one sense (scaled): the normal forces of contacts, by their points, of those that equilibrium
    determines; the pulls of all ropes, None where it leaves one open."""

    contacts: dict[str, Scalar]
    pulls: tuple[Scalar, ...] | None


def pressing(
    scene: RecordedScene, found: RecordedStatics, contacts: Sequence[RestingContact] = ()
) -> Pressing:
    """What may only push or only pull, where unknown loads balance the others."""
    position = Position(*scene.place, found.motions.twists, ropes=rope_ties(scene.place))
    loaded = {load.link for load in scene.case.loads if power.is_unknown(load)}
    # a follower's own equilibrium tells its force, that of the link with the unknown not in a dwell
    ties = sorted(ties_of(position), key=lambda tie: bool(loaded & {tie.by, tie.on}))
    solved = equilibrium(position, ties, found.balance)
    values = {solved.known: 1.0}
    values |= {solved.root(n): found.answers[name] * solved.scale for n, name in enumerate(solved.roots)}

    def value(column: int) -> Scalar | None:
        total: Scalar = 0.0
        for own, factor in solved.general.of(column).items():
            if own not in values:
                return None
            total = total + factor * values[own]
        return total

    normals = {}
    for contact in contacts:
        t = next(t for t, tie in enumerate(ties) if getattr(tie.joint, "at", None) == contact.joint.at)
        normal = value(solved.first[t])
        if normal is not None:
            normals[contact.joint.at] = normal
    ropes = range(len(solved.ropes))
    pulls = [pull for pull in (value(solved.tension(n)) for n in ropes) if pull is not None]
    return Pressing(normals, tuple(pulls) if len(pulls) == len(ropes) else None)


def motion_fits(
    scene: RecordedScene, found: RecordedStatics, paths: Sequence[str], *, sense: bool
) -> tuple[int, ...]:
    """The nodes of `speeds.motion_margins` that vary; the numbers of ``paths`` are exact in every row,
    and not written to so many decimals.

    Raises SceneError where the given motions can be in no row.
    """
    given, motions = scene.case.motion, found.motions
    if not given:
        return ()
    speeds_of_rows = {path: number_at(scene.case, path).value for path in paths if path.startswith("motion.")}
    place = scene.place._replace(case=with_numbers(scene.case, speeds_of_rows))
    margins = list(speeds.motion_margins(place, motions.twists, sense=sense))
    still = any(not varies(m) and float(m) <= 0.0 for m in margins)
    if still or motions.mobility > 1:
        speeds.speed_of(scene.place, motions.twists)
    return tuple(m.index for m in margins if varies(m))


# --- rates and centres ----------------------------------------------------------------------------


def rates(scene: RecordedScene, found: motion.Motions) -> dict[str, Scalar]:
    """Angular velocity of every link in rad/s, scaled as in one scene; those left open are not there."""
    if found.mobility > 1:
        speed = speeds.speed_of(scene.place, found.twists)
        told = speeds.link_rates(scene.case, found.twists, speed)
        return {link: rate for link, rate in told.items() if not isinstance(rate, str)}
    per, largest = _in_time(scene, found), speeds.fastest(found.twists)
    shown = {}
    for link in scene.case.links:
        x, y, rate = found.twists[link][0]
        shown[link] = 0.0 if scene.record.vanishes(rate, largest) else per((x, y, rate))[2]
    return shown


def unit_powers(scene: RecordedScene, found: RecordedStatics) -> Iterator[tuple[str, Scalar]]:
    """By load the power of a unit of it in the motion whose rates are told [force units times case length a
    second, over the load's unit]."""
    twists, scale, balance = found.motions.twists, scene.frame.scale, found.balance
    if found.motions.mobility > 1:
        speed = speeds.speed_of(scene.place, twists)
    else:
        divisor, target = _scale(scene, twists)
        speed = speeds.Speed((target,), (), divisor, arithmetic=scene.record)
    for n, w in enumerate(balance.wrenches):
        row = [factors[n] for factors in balance.factors]
        size = max(sizes[n] for sizes in balance.sizes)
        yield w.load.name, speed.particular_of(row, size) * (w.measure / scale)


def velocities(scene: RecordedScene, found: motion.Motions) -> Iterator[tuple[tuple[str, str], Point]]:
    """Velocities of points on the links that carry them, by point and link [case length/s]; those left open
    are not there."""
    if found.mobility > 1:
        speed = speeds.speed_of(scene.place, found.twists)
        for spot, told in speeds.point_velocities(scene.place, found.twists, speed).items():
            if not isinstance(told, str):
                yield spot, told
        return
    per = _in_time(scene, found)
    twists = {link: per(t) for link, (t,) in found.twists.items()}
    largest = largest_of([x for t in twists.values() for x in t])
    for point, link in _carried(scene):
        yield (point, link), _shown(scene, velocity(twists[link], scene.points[point]), largest)


def point_accelerations(scene: RecordedScene, moves: Moving) -> Iterator[tuple[tuple[str, str], Point]]:
    """The same of their accelerations [case length/s^2]."""
    for point, link in _carried(scene):
        if link not in moves.open:
            yield (point, link), _shown(scene, moves.acceleration(link, scene.points[point]), moves.size)


def link_accelerations(scene: RecordedScene, moves: Moving) -> Iterator[tuple[str, Scalar]]:
    """Angular accelerations of the links [rad/s^2]; those left open are not there."""
    for link in scene.case.links:
        if link not in moves.open:
            rate = moves.rates[link][2]
            yield link, 0.0 if scene.record.vanishes(rate, moves.size) else rate


def _shown(scene: RecordedScene, v: Point, size: float) -> Point:
    """A vector [case units], of which what is zero in every row is that."""
    x, y = (0.0 if scene.record.vanishes(part, size) else part / scene.frame.scale for part in v)
    return x, y


def _carried(scene: RecordedScene) -> Iterator[tuple[str, str]]:
    """The points that have a name, and links that carry them."""
    for link in scene.case.links:
        for point in speeds.moving_points(scene.case, link):
            if is_named(point) and point in scene.points:
                yield point, link


def _in_time(scene: RecordedScene, found: motion.Motions) -> Callable[[Triple], Triple]:
    """What makes of a twist of the one freedom that of the motion of a row, scaled as in one scene."""
    divisor, target = _scale(scene, found.twists)
    return lambda t: (t[0] * target / divisor, t[1] * target / divisor, t[2] * target / divisor)


def _scale(scene: RecordedScene, twists: Mapping[str, tuple[Triple, ...]]) -> tuple[Scalar, float]:
    """What the rates are divided by, and what they are scaled to."""
    speed = speeds.speed_of(scene.place._replace(case=_plain(scene.case)), twists)
    (target,) = speed.particular
    if speed.reference is not None:
        link, point = speed.reference
        x, y, w = twists[link][0]
        if point is None:
            return w, target
        v = velocity((x, y, w), scene.points[point])
        given, record = scene.case.motion[0], scene.record
        if given.angle is not None and not record.follows:  # a row as if written so goes as is written
            c, s = record.turn(given.angle)
            along = v[0] * c + v[1] * s
            return _signed(scene, v, True) * (along / record.sqrt(along * along)), target
        if given.angle is None:
            return _signed(scene, v, float(speed.divisor) > 0.0), target
        return _signed(scene, v, True) * _sense(scene, twists, given), target
    link = next(n for n in speeds.joint_order(scene.case) if any(map(float, twists[n][0])))
    (x, y), record = (twists[link][0][1], -twists[link][0][0]), scene.record
    if not record.follows and not record.vanishes(x, speeds.fastest(twists)):  # toward +x in each row
        return _signed(scene, (x, y), True) * (x / record.sqrt(x * x)), target
    return _signed(scene, (x, y), float(speed.divisor) > 0.0), target


def _plain(case: Case) -> Case:
    """A point's given direction holds as written only; in a sweep its sense goes on. Of motions that repeat
    one another the first counts."""
    return replace(case, motion=tuple(m._replace(angle=None) if m.point else m for m in case.motion[:1]))


def _signed(scene: RecordedScene, v: Point, forward: bool) -> Scalar:
    size = scene.record.sqrt(v[0] * v[0] + v[1] * v[1])
    return size if forward else -size


def centres(
    scene: RecordedScene, found: motion.Motions, wanted: Iterable[Pair]
) -> Iterator[tuple[Pair, Triple]]:
    """Relative centres in case units, homogeneous, of the pairs that have one; of several freedoms in the
    given motion."""
    twists, largest = found.twists, speeds.fastest(found.twists)
    if scene.case.motion and found.mobility > 1:
        speed = speeds.speed_of(scene.place, twists)
        twists = {link: speeds.meant(twists, speed, link) for link in twists}
    ox, oy, scale = scene.frame
    for pair in wanted:
        own = _own(scene, pair)
        if own is None:
            relative = [subtract(b, a) for a, b in zip(*(twists[link] for link in pair), strict=True)]
            moving = [t for t in relative if not all(scene.record.vanishes(x, largest) for x in t)]
            if len(moving) != 1:
                continue
            (own,) = moving
        x, y, w = own
        yield pair, (x / scale + ox * w, y / scale + oy * w, w)


def _own(scene: RecordedScene, pair: Pair) -> Triple | None:
    """The centre of a joint between the two links."""
    bodies = {scene.top.body_of[link] for link in pair}
    for bond in scene.top.bonds:
        if {bond.a, bond.b} == bodies:
            if isinstance(bond.joint, Mesh):
                return pitch_point(bond, scene.points, scene.record)
            basis = freedoms(bond, scene.points, scene.record)
            if len(basis) == 1:
                return basis[0]
    for joint in scene.case.joints:  # two links on a pin that a third one carries
        if joint.pivot in scene.points and {*pair} <= {*joint.links} and len(bodies) > 1:
            return (*scene.points[joint.pivot], 1.0)
    return None


def pairs(case: Case) -> Iterable[Pair]:
    """All pairs of links, in the order in which they are named."""
    links = list(case.links)
    if all(link.isdigit() for link in links):
        links.sort(key=int)
    return (ordered_pair(case, a, b) for n, a in enumerate(links) for b in links[n + 1 :])
