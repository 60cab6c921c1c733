"""A case with profiles on the move: its cams turn as the sweep says, and each follower rests on its cam.

Without its contacts the mechanism has a freedom more for each follower. In every row a cam is where the
others put it; the follower is moved along its guide to the first meeting from outside; the sweep with these
motions given places everything that hangs on it.

How far a link has moved from the position as written: a turning and where a point of it is.

Profiles whose every direction is told by points of their link, so that all of them moves with it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from decimal import Decimal
from functools import lru_cache

import numpy as np

from icsolve.answer.bodies import Touching
from icsolve.cams.contact_candidates import (
    Candidate,
    Freedom,
    Meeting,
    Shift,
    Turn,
    gap_of,
    meeting_of,
    outermost,
)
from icsolve.cams.contact_search import ROUNDED, ContactSearch, FollowerGuide, found, guided, places_of
from icsolve.cams.curve import Body, Curve, Foot, placed
from icsolve.cams.enclosed_contact import DIGITS, Vector, ball_places, exact_number
from icsolve.cams.pieces import Point
from icsolve.cams.words import not_guided
from icsolve.case import Case, Contact, Coordinates, Length, Number, is_named
from icsolve.case.profiles import Arc, Arcs, Circle, Flat, Follower, Radii, Roller, Shape, points_of
from icsolve.errors import SceneError, Status
from icsolve.numbers import turn_of
from icsolve.numbers.balls import Balls
from icsolve.numbers.decimals import CONTEXT, as_written
from icsolve.numbers.replay import Array, Mask
from icsolve.scene.refusals import rubs
from icsolve.structure import welded
from icsolve.sweep.branches import signs_of
from icsolve.sweep.exact_record import hides
from icsolve.sweep.first_contact import FirstContact, FirstContacts, radius_ratio
from icsolve.sweep.program import RowRequest
from icsolve.sweep.record_runner import Key
from icsolve.sweep.recorded_scene import TILT, RestingContact
from icsolve.sweep.request import Columns
from icsolve.sweep.rows_on_record import SweepRun
from icsolve.sweep.starting_position import start_of
from icsolve.sweep.table import CODE, Codes
from icsolve.tuples import NamedTuple, replace

FAR = 4.0
"""Where the way of a sliding follower is measured from, in sizes of the figure: it stays positive."""

APART = 1e-9
"""By so much of a cam's size no rounding moves a contact."""

MARKERS = ("@pose.", "@origin.", "@follower.", "@profile.")
"""Hidden points that tell where links are; no part of a row's figure."""


class Follow(NamedTuple):
    """A follower on its cam in the position as written.

    Attributes
    ----------
    seeking : the contact, and how it is named
    curve, body, freedom : profile, follower and its guide [case length, rad]
    side : of a flat face the side on which it has its body
    sense : 1 where the gap grows as the follower moves on
    lean : 1 where the way of the follower lies ccw from the normal, else -1
    driver : the link that a sweep turns, or the length that it varies from ``start``, to move the follower
    frame, written : names and places of two points of the cam
    pivot : of a cam that is pinned to the frame [case length]; else not a number
    """

    seeking: ContactSearch
    curve: Curve
    body: Body
    freedom: Freedom
    side: float
    sense: float
    lean: float
    driver: str
    start: float
    frame: tuple[str, str]
    written: tuple[Point, Point]
    pivot: Point

    def driven(self, by: Array) -> Array:
        """The driver's values, (n,) [degrees, or case length], for motions along the freedom, (n,) [rad, case
        length].
        """
        return np.degrees(by) if isinstance(self.freedom, Turn) else self.start + by

    def met(self, pose: LinkPose) -> Candidate | None:
        """Where the follower meets the cam first, in this pose of the cam; as the cam sees it."""
        body, freedom = pose.body_back(self.body), pose.freedom_back(self.freedom)
        return outermost(self.curve, body, freedom, self.side, self.sense)

    def as_written(self) -> float:
        """The driver's value where the follower meets the cam of the position as written."""
        met = self.met(pose_of(self.written, self.written))
        return float(self.driven(np.array(0.0 if met is None else met.by)))

    def rested(self, first: Array, second: Array) -> FirstContacts:
        """Where the follower meets the cam in every row.

        Parameters
        ----------
        first, second : places of the cam's two points, (n, 2) [case length]

        Returns
        -------
        Met
            ``point`` and ``normal`` as the frame sees them.
        """
        pose = pose_of(self.written, (_parts(first), _parts(second)))
        body, freedom = pose.body_back(self.body), pose.freedom_back(self.freedom)
        met = FirstContact(self.curve, body, freedom, self.side, self.sense).run()
        point, normal = pose.place(_parts(met.point)), pose.out(_parts(met.normal))
        return met._replace(point=np.stack(point, axis=1), normal=np.stack(normal, axis=1))

    def pressure(self, at: Array, normal: Array) -> Array:
        """Pressure angles [degrees] at contacts, as `contact_search.pressure_angle`.

        Parameters
        ----------
        at : where they touch, (n, 2) [case length]
        normal : unit normals into the follower, (n, 2)

        Returns
        -------
        Array
            (n,), from 0 to 90: between the normal and the way of the follower's point (of a roller, its
            centre).
        """
        x, y = self.freedom.velocity(_parts(at + self.body.radius * normal))
        along, across = x * normal[:, 0] + y * normal[:, 1], x * normal[:, 1] - y * normal[:, 0]
        angle = np.degrees(np.arctan2(np.abs(across), np.abs(along)))
        return np.where(np.abs(across) <= ROUNDED * np.abs(along), 0.0, angle)

    def resting(self, whole: Case) -> RestingContact:
        """The contact, whose place and normal each row tells."""
        hidden = self.seeking.hidden
        joint = next(j for j in whole.joints if isinstance(j, Contact) and j.at == hidden)
        place = whole.points[hidden]
        assert isinstance(place, Coordinates) and place.x is not None and place.y is not None
        touch, follower = self.seeking.touch, self.seeking.follower
        cam = touch.links.index(self.seeking.cam)
        roller = None
        if isinstance(follower, Roller):
            off = -1.0 if cam == 0 else 1.0
            roller = (follower.at, off * follower.radius.value)
        assert joint.radii is not None
        at, bend = (place.x.value, place.y.value), joint.radii[cam]
        ends = (bend.value, 1.0) if isinstance(bend, Number) else (1.0, 0.0)
        above, below = radius_ratio(np.array(ends[0]), np.array(ends[1]), self.curve.size).tolist()
        return RestingContact(touch.place, joint, at, cam, (above, below), self.lean * TILT, roller)

    def contact(self, case: Case, pose: LinkPose, met: Candidate) -> Touching:
        """A row's contact; raises SceneError where there is no one."""
        meeting = meeting_of(self.curve, met.body, self.side)
        self.seeking.refuse_shared(meeting)
        return self.seeking.contact(case, self.curve, pose.meeting(meeting), self.freedom, note=False)[1]


class CamMotion:
    """A case that moves; ``open`` is without its contacts, ``whole`` has them where they are as written.

    Raises SceneError where the position as written has no contact, or a follower is not guided by the frame.
    """

    def __init__(self, case: Case) -> None:
        assert case.profiles is not None
        known = found(case)
        self.case, self.touching = case, known.touching
        self.whole = anchored(known.case)
        touching = [joint.at for joint in self.whole.joints if joint.only_pushes]
        hidden = {at for at in touching if at is not None and not is_named(at)}
        joints = tuple(j for j in self.whole.joints if j.at not in hidden)
        points = {name: place for name, place in self.whole.points.items() if name not in hidden}
        carries = {link: tuple(n for n in ns if n not in hidden) for link, ns in self.whole.carries.items()}
        bare = replace(self.whole, joints=joints, profiles=None, expect=())
        self.open = replace(bare, points=points, carries=carries)
        self.follows: list[Follow] = []
        for k in range(len(self.touching)):
            self.follows.append(self._follow(k))

    def _follow(self, k: int) -> Follow:
        """One follower as written; what moves it is added to the open case."""
        assert self.case.profiles is not None and self.whole.profiles is not None
        touch = self.case.profiles.touches[k]
        seeking = ContactSearch(self.case, self.whole.profiles, touch, self.whole)
        guide = guided(self.whole, seeking.guided)
        if guide is None or guide.against != self.whole.ground:
            raise SceneError(Status.UNSUPPORTED, not_guided(seeking.guided, seeking.cam))
        freedom = guide.freedom
        own = points_of(seeking.shape)
        curve = placed(seeking.shape, places_of(self.whole, own), seeking.where)
        body = seeking.body(places_of(self.whole, points_of(seeking.follower)))
        side = min((1.0, -1.0), key=lambda side: abs(gap_of(curve, body, side)[0]))
        outward = 0.0 if touch.links[0] == seeking.cam else 180.0
        normal = turn_of(self.touching[k].normal + outward)
        x, y = freedom.velocity(seeking.trace(self.touching[k].at, normal))
        along, across = x * normal[0] + y * normal[1], y * normal[0] - x * normal[1]
        sense, lean = math.copysign(1.0, along), math.copysign(1.0, along * across)
        frame, written = self._frame(seeking.cam, own[0])
        as_one = welded(self.whole, seeking.guided)  # in a frame about a cam two faces move by one freedom
        other = next((one for one in self.follows if one.seeking.guided in as_one), None)
        if other is None:
            driver, start = self._driver(seeking.guided, body.at, guide)
        else:
            driver, start = other.driver, other.start
        turns = guided(self.whole, seeking.cam)
        pivot = (math.nan, math.nan)
        if turns is not None and turns.against == self.whole.ground and isinstance(turns.freedom, Turn):
            pivot = turns.freedom.about
        return Follow(seeking, curve, body, freedom, side, sense, lean, driver, start, frame, written, pivot)

    def _frame(self, cam: str, first: str) -> tuple[tuple[str, str], tuple[Point, Point]]:
        """Two points of a cam that tell its pose."""
        name = f"@pose.{cam}"
        x, y = places_of(self.open, (first,))[first]
        second = (x + self._size(), y)
        self._carry(cam, {name: second})
        return (first, name), ((x, y), second)

    def _driver(self, link: str, at: Point, guide: FollowerGuide) -> tuple[str, float]:
        """What a sweep varies to move a follower, and its value as written."""
        if isinstance(guide.freedom, Turn):
            return link, 0.0
        origin, carried, start = f"@origin.{link}", f"@follower.{link}", FAR * self._size()
        x, y = guide.along(self.whole, Balls(DIGITS))
        away = (at[0] - x * start, at[1] - y * start)
        self._carry(self.open.ground, {origin: away})
        self._carry(link, {carried: at})
        path = f"lengths.{origin}.{carried}"
        length = Length(origin, carried, Number(start, 0.0, path, repr(start)))
        self.open = replace(self.open, lengths=(*self.open.lengths, length))
        return path, start

    def _carry(self, link: str, places: Mapping[str, Vector]) -> None:
        """Hidden points that a link carries."""
        points = {name: coordinates(name, place) for name, place in places.items()}
        carries = {**self.open.carries, link: (*self.open.carries.get(link, ()), *places)}
        self.open = replace(self.open, points={**self.open.points, **points}, carries=carries)

    def _size(self) -> float:
        """The extent of everything that a follower can reach."""
        names = [name for names in self.whole.carries.values() for name in names]
        places = places_of(self.whole, tuple(dict.fromkeys(names))).values()
        xs, ys = [x for x, _ in places], [y for _, y in places]
        assert self.whole.profiles is not None
        shapes = self.whole.profiles.shapes.values()
        radii = (shape.radius.value for shape in shapes if isinstance(shape, Circle | Roller))
        return math.hypot(max(xs) - min(xs), max(ys) - min(ys)) + 2.0 * math.fsum(radii)


@lru_cache(maxsize=16)
def cam_motion(case: Case) -> CamMotion:
    """The motion of a case, once a case."""
    return CamMotion(case)


class Rows:
    """The rows of a sweep that one course runs through."""

    def __init__(self, course: CamMotion, columns: Columns) -> None:
        self.course, self.columns = course, columns
        self.codes: Codes = np.zeros(columns.rows, dtype=np.int8)
        self.contacts: dict[tuple[int, int], tuple[LinkPose, Candidate] | None] = {}
        self.frames: list[tuple[Array, Array]] = []
        self.rested: list[FirstContacts] = []
        """where each follower touches in every row, in the figure"""
        self.drivers = {f.driver: np.full(columns.rows, f.start) for f in course.follows}
        for follow in course.follows:
            self._place(follow)
        self.work = self._work(())
        self.work.run()
        moved = np.where(self.work.codes == CODE[Status.CHANGE_POINT], 0, self.work.codes)
        self.codes = np.where(self.codes == 0, moved, self.codes).astype(np.int8)

    def _work(self, points: tuple[str, ...]) -> SweepRun:
        """The sweep of the open case with what is known of the drivers."""
        links = {f.driver for f in self.course.follows if isinstance(f.freedom, Turn)}
        paths = {**self.columns.paths, **{k: v for k, v in self.drivers.items() if k not in links}}
        turned = {**self.columns.links, **{k: v for k, v in self.drivers.items() if k in links}}
        names = {**self.columns.names, **{k: k for k in self.drivers}}
        columns = Columns(paths, turned, names)
        return SweepRun(start_of(self.course.open, columns, RowRequest(False, points)), columns, False)

    def _place(self, follow: Follow) -> None:
        """Move a follower to its cam in every row."""
        work = self._work(follow.frame)
        work.run()
        first, second = (work.values["points", name] for name in follow.frame)
        turned, placed = self.codes == 0, np.isin(work.codes, (0, CODE[Status.CHANGE_POINT]))
        self.codes[turned & ~placed] = CODE[Status.CANNOT_ASSEMBLE]
        rested = follow.rested(first, second)
        rested.sure[~(turned & placed)] = False
        self.frames.append((first, second))
        self.rested.append(rested)
        for row in np.flatnonzero(turned & placed & ~rested.sure).tolist():
            one = self._contact(len(self.rested) - 1, row)
            if one is None:
                self.codes[row] = CODE[Status.CANNOT_ASSEMBLE]
            rested.by[row] = one[1].by if one is not None else 0.0
        by = np.where(turned & placed & np.isfinite(rested.by), rested.by, 0.0)
        moved = follow.driven(by)
        others = self.course.follows[: len(self.rested) - 1]
        other = next((one for one in others if one.driver == follow.driver), None)
        if other is not None:  # it binds where one face would leave the cam, or enter it
            off = np.abs(moved - self.drivers[follow.driver]) - abs(follow.as_written() - other.as_written())
            self.codes[turned & placed & (off > APART * follow.curve.size)] = CODE[Status.CANNOT_ASSEMBLE]
        self.drivers[follow.driver] = moved

    def _contact(self, k: int, row: int) -> tuple[LinkPose, Candidate] | None:
        """Where a follower meets its cam in a row, with every rule of a single scene."""
        if (k, row) not in self.contacts:
            first, second = self.frames[k]
            pose = pose_of(self.course.follows[k].written, (_point(first[row]), _point(second[row])))
            found = self.course.follows[k].met(pose)
            self.contacts[k, row] = (pose, found) if found is not None else None
        return self.contacts[k, row]

    @property
    def dwelling(self) -> Mask:
        """In which rows every follower rests on an arc about the pin on which its cam turns, (rows,)."""
        resting = np.ones(self.columns.rows, dtype=bool)
        for follow, rested in zip(self.course.follows, self.rested, strict=True):
            with np.errstate(invalid="ignore"):
                resting &= rested.sure & (rested.centre == follow.pivot).all(axis=1)
        return resting

    def together(self, asked: RowRequest) -> tuple[dict[Key, Array], Mask]:
        """What is asked of the rows, from one record.

        Returns
        -------
        tuple[dict[Key, Array], Mask]
            By (kind, name), (rows,) or (rows, parts) [case units], as of `Table`; and in which rows that is
            sure, (rows,):
            the others are to be solved one by one.
        """
        if len(self.drivers) < len(self.course.follows):  # contacts of one freedom are redundant
            return {}, np.zeros(self.columns.rows, dtype=bool)
        sure = np.logical_and.reduce([one.sure & one.within for one in self.rested]) & (self.codes == 0)
        if asked.dynamic:
            sure &= np.logical_and.reduce([np.isfinite(one.radius).all(axis=1) for one in self.rested])
        contacts = tuple(follow.resting(self.course.whole) for follow in self.course.follows)
        start = self.work.start._replace(asked=asked._replace(contacts=contacts))
        values: dict[Key, Array] = {}
        for part in self.work.done:
            runner = start.runner(signs_of(part.followed.compiled) if part.followed else ())
            compiled, old = runner.compiled, part.runner.compiled
            if (
                compiled.refusal is not None
                or compiled.delicate
                or runner.sequential
                or rubs(compiled.scene.case)
                or hides(compiled)
            ):
                return {}, np.zeros(len(sure), dtype=bool)
            given, good = self.work.parts.given(part)
            by_name = {name: given[k] for name, k in old.inputs.items()}
            for follow, contact, rested in zip(self.course.follows, contacts, self.rested, strict=True):
                normal = (
                    rested.normal if follow.seeking.touch.links[0] == follow.seeking.cam else -rested.normal
                )
                columns = np.hstack([normal, rested.radius, rested.point])[part.rows].T
                by_name |= dict(zip(contact.inputs, columns, strict=False))
            found = runner.run({k: by_name[name] for name, k in compiled.inputs.items()}, len(part.rows))
            values = values or runner.blank(len(sure))
            for key, array in found.values.items():
                values[key][part.rows] = array
            sure[part.rows[~good]] = False
            sure[part.rows[found.doubtful]] = False
        for follow, rested in zip(self.course.follows, self.rested, strict=True):
            at, angles = rested.point, follow.pressure(rested.point, rested.normal)
            force = values.pop(("contact", follow.seeking.hidden), np.zeros(len(sure)))
            name = "-".join(follow.seeking.touch.links)
            values["touching", name] = np.column_stack([at, angles, force < 0.0])
        return values, sure

    def pressures(self) -> dict[tuple[str, str], Array]:
        """The pressure angles of the contacts by their links, (rows,) each [degrees].

        Raises SceneError where in a row there is no one contact.
        """
        found = {}
        for k, (follow, rested) in enumerate(zip(self.course.follows, self.rested, strict=True)):
            angles = follow.pressure(rested.point, rested.normal)
            for row in np.flatnonzero(~rested.sure).tolist():
                one = self._contact(k, row)
                assert one is not None
                angles[row] = follow.contact(self.course.open, *one).pressure_angle
            found[follow.seeking.touch.links] = angles
        return found

    def case_of(self, row: int) -> Case:
        """A row as a case whose contacts are to be found on its profiles: its followers are brought to their
        cams with all digits.

        Raises SceneError where there is no one contact.
        """
        profiles, touches = self.course.whole.profiles, self.course.case.profiles
        assert profiles is not None and touches is not None
        exact: dict[str, Decimal] = {}
        at = list(touches.touches)
        for follow in self.course.follows:
            seeking = follow.seeking
            case = self.work.case_of(row, exact)
            short = ContactSearch(self.course.case, profiles, seeking.touch, case).short(follow.sense)
            if short is None:
                n = at.index(seeking.touch)
                at[n] = at[n]._replace(shown=False)
            else:
                known = exact.get(follow.driver, as_written(self.drivers[follow.driver][row]))
                exact[follow.driver] = CONTEXT.add(known, short)
        case = self.work.case_of(row, exact)
        carries = {
            link: tuple(name for name in names if not name.startswith(MARKERS))
            for link, names in case.carries.items()
        }
        return replace(case, profiles=profiles._replace(touches=tuple(at)), carries=carries)


def _point(place: Array) -> Point:
    return (float(place[0]), float(place[1]))


def _parts(places: Array) -> Vector:
    """x and y of places or vectors, (n, 2), as arrays of their own."""
    x, y = places.T
    return x, y


class LinkPose(NamedTuple):
    """How far a link has moved from the position as written: in one position, or (numbers being arrays) in
    many at once.

    Attributes
    ----------
    turn : (cos, sin) of its turning
    written, now : the places of one of its points, then and now [case length]
    """

    turn: Vector
    written: Vector
    now: Vector

    def out(self, v: Vector) -> Vector:
        """A vector that the link carries, as it is now."""
        (c, s), (x, y) = self.turn, v
        return (c * x - s * y, s * x + c * y)

    def back(self, v: Vector) -> Vector:
        """A vector as the link carried it in the position as written."""
        (c, s), (x, y) = self.turn, v
        return (c * x + s * y, c * y - s * x)

    def place(self, p: Vector) -> Vector:
        """A point that the link carries, as it is now."""
        x, y = self.out((p[0] - self.written[0], p[1] - self.written[1]))
        return (x + self.now[0], y + self.now[1])

    def place_back(self, p: Vector) -> Vector:
        """Where a point is as the link sees it, in the position as written."""
        x, y = self.back((p[0] - self.now[0], p[1] - self.now[1]))
        return (x + self.written[0], y + self.written[1])

    def body_back(self, body: Body) -> Body:
        """A follower as the link sees it."""
        return body._replace(at=self.place_back(body.at), face=self.back(body.face))

    def freedom_back(self, freedom: Freedom) -> Freedom:
        """A follower's freedom as the link sees it."""
        if isinstance(freedom, Turn):
            return Turn(self.place_back(freedom.about))
        return Shift(self.back(freedom.along))

    def meeting(self, meeting: Meeting) -> Meeting:
        """A meeting that the link sees, as it is now."""
        foot = meeting.foot
        turned = Foot(self.place(foot.point), foot.piece, foot.u, tuple(map(self.out, foot.normals)))
        return Meeting(meeting.gap, turned, tuple(map(self.out, meeting.normals)))


def pose_of(written: tuple[Point, Point], now: tuple[Vector, Vector]) -> LinkPose:
    """The pose of a link by two of its points, then and now [case length].

    Divides by zero where they lie at one place.
    """
    (ax, ay), (bx, by) = written
    (cx, cy), (dx, dy) = now
    ux, uy, vx, vy = bx - ax, by - ay, dx - cx, dy - cy
    c, s = ux * vx + uy * vy, ux * vy - uy * vx
    size = math.hypot(c, s) if isinstance(c, float) else np.hypot(c, s)
    return LinkPose((c / size, s / size), written[0], now[0])


def anchored(case: Case) -> Case:
    """The case with hidden points in the place of directions in degrees, carried by the links that have them.

    Raises SceneError where a point of a profile is not determined.
    """
    assert case.profiles is not None
    shapes, points, carries = {}, dict(case.points), dict(case.carries)
    for link, shape in case.profiles.shapes.items():
        own = _Anchors(link, case, points_of(shape))
        shapes[link] = own.of(shape)
        points |= own.added
        carries[link] = (*carries.get(link, ()), *own.added)
    profiles = case.profiles._replace(shapes=shapes)
    return replace(case, profiles=profiles, points=points, carries=carries)


def coordinates(name: str, place: Vector, size: float = 1.0) -> Coordinates:
    """A hidden point's place [case length], with as many digits of a size as a scene needs."""
    x, y = (exact_number(v, size, f"points.{name}.{axis}") for v, axis in zip(place, "xy", strict=True))
    return Coordinates(x, y)


class _Anchors:
    """The points that stand for the directions of one profile."""

    def __init__(self, link: str, case: Case, names: tuple[str, ...]) -> None:
        self.link, self.balls = link, Balls(DIGITS)
        self.places = ball_places(case, names, self.balls)
        self.added: dict[str, Coordinates] = {}

    def of(self, shape: Shape | Follower) -> Shape | Follower:
        """The profile with points for directions."""
        match shape:
            case Flat(at, Number() as angle):
                return Flat(at, (at, self.point(at, angle, 1.0)))
            case Radii(about, Number() as angle):
                return shape._replace(zero=(about, self.point(about, angle, 1.0)))
            case Arcs(arcs):
                return Arcs(tuple(map(self.arc, arcs)))
        return shape

    def arc(self, arc: Arc) -> Arc:
        """An arc whose ends are points of it."""
        radius = arc.radius.value if arc.radius is not None else self.distance(arc)
        start, stop = (
            self.point(arc.centre, end, radius) if isinstance(end, Number) else end
            for end in (arc.start, arc.stop)
        )
        return arc._replace(start=start, stop=stop)

    def distance(self, arc: Arc) -> float:
        """The radius of an arc that is given by a point of it."""
        ends = (end for end in (arc.start, arc.stop) if isinstance(end, str))
        places = {name: (float(x), float(y)) for name, (x, y) in self.places.items()}
        return max(math.dist(places[end], places[arc.centre]) for end in ends)

    def point(self, at: str, angle: Number, away: float) -> str:
        """A new point, so far from another in a direction."""
        (x, y), (c, s) = self.places[at], self.balls.turn(angle)
        name = f"@profile.{self.link}.{len(self.added)}"
        self.added[name] = coordinates(name, (x + c * away, y + s * away), away)
        return name
