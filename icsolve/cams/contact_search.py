"""A case with profiles to the same case with its contacts where they are.

How the joints of a follower let it move against a link that stands, and the datum that is missing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from decimal import Decimal

from icsolve.answer.bodies import Touching
from icsolve.assembly import case_point, solve_figure
from icsolve.cams.contact_candidates import (
    ALONG,
    TWICE,
    Candidate,
    Freedom,
    Meeting,
    Shift,
    Turn,
    candidates,
    gap_of,
    meeting_of,
)
from icsolve.cams.curve import Body, Curve, Foot, body_of, placed
from icsolve.cams.enclosed_contact import (
    DIGITS,
    EnclosedContact,
    FollowerPlaces,
    LocusFinder,
    TouchingAbout,
    Vector,
    at_least,
    ball_places,
    enclosed_contact,
    exact_number,
    kept_digits,
)
from icsolve.cams.enclosed_contact import direction as direction_in_balls
from icsolve.cams.pieces import Point, Straight, unit
from icsolve.cams.words import (
    corner_refusal,
    left_open,
    never_meets,
    passes_corner,
    piece_words,
    several_ways,
)
from icsolve.case import Case, Contact, Coordinates, Direction, Joint, Number
from icsolve.case.profiles import (
    Circle,
    Flat,
    Follower,
    Knife,
    Profiles,
    Radii,
    Roller,
    Shape,
    Touch,
    points_of,
)
from icsolve.errors import SceneError, Status
from icsolve.numbers import Scalar, turn_of
from icsolve.numbers.balls import Balls, BelowZero, MoreDigits
from icsolve.structure import welded
from icsolve.tuples import NamedTuple, replace

FITS = 2e-3
"""A follower whose place is given may miss the profile by this fraction of the profile's size."""
ROUNDED = 1e-14
"""A pressure angle of this sine is rounding."""
BESIDE = 1e-6
"""So near to the end of a piece (of its length), and to its normal, both end and piece are looked at."""
CLEARLY = 0.9
"""A way is meant where it is nearer to `near` than this fraction of the distance of the next."""


class FoundContacts(NamedTuple):
    """The case with plain contacts, and what was found of each."""

    case: Case
    touching: tuple[Touching, ...]
    used: frozenset[str]
    """the points that profiles name"""
    enclosed: bool = False
    """whether all are placed with more digits than a scene needs"""


def found(case: Case, enclosed: bool = False) -> FoundContacts:
    """The contacts of a case with profiles; ``enclosed`` with more digits than a scene needs, where that can
    be shown.

    Raises SceneError where a profile crosses itself, a follower never meets it or does so in several ways,
    and where the figure is not determined.
    """
    assert case.profiles is not None
    current = replace(case, profiles=case.profiles._replace(touches=()))
    touching = []
    for touch in case.touches:
        search = ContactSearch(case, case.profiles, touch, current)
        current, one = search.found(enclosed)
        enclosed = enclosed and search.enclosed is not None
        touching.append(one)
    used = (name for shape in case.profiles.shapes.values() for name in points_of(shape))
    return FoundContacts(current, tuple(touching), frozenset(used), enclosed)


class ContactSearch:
    """One contact while it is looked for; ``case`` has the contacts that were found before."""

    def __init__(self, original: Case, profiles: Profiles, touch: Touch, case: Case) -> None:
        self.touch, self.case = touch, case
        a, b = touch.links
        self.cam, self.link = (b, a) if isinstance(profiles.shapes[a], Flat | Roller | Knife) else (a, b)
        shape, follower = profiles.shapes[self.cam], profiles.shapes[self.link]
        assert isinstance(follower, Flat | Roller | Knife) and not isinstance(shape, Flat | Roller | Knife)
        self.shape: Shape = shape
        self.follower: Follower = follower
        self.guided = carrier(case, self.link, follower)
        mark = original.marks.get(f"profile.{self.cam}")
        self.hidden = f"@{'-'.join(touch.links)}.{touch.place}"
        """the name of the point of contact"""
        self.profile = f"the profile of link {self.cam}"
        self.where = self.profile + (f" ({original.path}:{mark[0]}:{mark[1]})" if mark else "")
        self.what = f"link {self.link} on {self.where}"
        self.freed: Freed | None = None
        self.enclosed: EnclosedContact | None = None

    def found(self, enclosed: bool) -> tuple[Case, Touching]:
        """The case with this contact, and what was found of it; ``enclosed`` where that can be shown."""
        curve = self.curve()
        meeting = self._meeting(curve)
        sense = -1.0 if self.freed is None else self.freed.sense  # a gap is no wider than the least
        asked = enclosed or meeting.shared or len(meeting.normals) > 1  # as near as doubles tell
        if asked and self.touch.shown and (shown := self._enclosed(curve, meeting, sense)):
            self.enclosed, meeting = shown[0], meeting._replace(foot=shown[1], normals=shown[1].normals[:1])
        if self.enclosed is None:
            self.refuse_shared(meeting)
        freed = self.freed
        if self.enclosed is not None and freed is not None:
            value = self.enclosed.change + Balls(DIGITS).given(freed.number(0.0))
            size = 360.0 if isinstance(freed.freedom, Turn) else curve.size
            self.case = freed.datum.put(freed.case, exact_number(value, size, ""))
        return self.contact(self.case, curve, meeting, self.guide())

    def short(self, sense: float) -> Decimal | None:
        """How far the guide has still to take a follower whose place is given until it touches [case length,
        or degrees], from where the gap grows in this ``sense`` of its motion; None where that is not shown.

        Raises SceneError where it is far from that.
        """
        curve, guide = self.curve(), guided(self.case, self.guided)
        found = self._enclosed(curve, self._meeting(curve), sense, guide) if guide is not None else None
        return found and kept_digits(found[0].change, curve.size)

    def curve(self) -> Curve:
        """The profile where its link is."""
        return placed(self.shape, places_of(self.case, points_of(self.shape)), self.where)

    def _meeting(self, curve: Curve) -> Meeting:
        """Where the follower touches; one that is free is moved there."""
        try:
            body = self.body(places_of(self.case, points_of(self.follower)))
        except SceneError as refusal:
            if refusal.status != Status.UNDERDETERMINED:
                raise
            self.case, way = self.followed(curve, refusal)
            side = way.side
            body = self.body(places_of(self.case, points_of(self.follower)))
        else:
            side = min((1.0, -1.0), key=lambda side: abs(gap_of(curve, body, side)[0]))
        gap = gap_of(curve, body, side)[0]
        if abs(gap) > FITS * curve.size:
            raise SceneError(Status.CANNOT_ASSEMBLE, never_meets(self.what, body.kind, gap))
        return meeting_of(curve, body, side)

    def refuse_shared(self, meeting: Meeting) -> None:
        """Raise SceneError where the follower seems to touch at several places at once."""
        if meeting.shared:
            raise SceneError(Status.UNSUPPORTED, f"{self.what}: {meeting.shared}")

    def _enclosed(
        self, curve: Curve, meeting: Meeting, sense: float, guide: FollowerGuide | None = None
    ) -> tuple[EnclosedContact, Foot] | None:
        """The contact with all digits and what is touched: of all that doubles see as near what is met first
        by a follower that comes from where its gap grows, in this ``sense`` of its motion; None where that is
        not shown. One whose place is given moves by a ``guide``, where one is named.

        Raises SceneError where it touches at several places.
        """
        feet = [*meeting.ties]
        if len(meeting.normals) == 1:
            feet.insert(0, (meeting.foot, meeting.normals[0]))
        elif self.touch.normal is not None:
            return None
        spots: dict[Point | int, tuple[Foot, Point]] = {}
        for foot, normal in feet:
            for spot, way in self._spots(curve, foot, normal, meeting.gap):
                spots.setdefault(spot.point if spot.is_corner else spot.piece, (spot, way))
        outer: tuple[EnclosedContact, Foot] | None = None
        try:
            for spot, normal in spots.values():
                one = self._enclosed_on(curve, meeting._replace(foot=spot, normals=(normal,)), guide)
                if one is None or not at_least(one.opens * sense):  # met from within, on the way out
                    continue
                if outer is None or self._ahead(one, outer[0], sense, guide):
                    outer = one, spot
        except (MoreDigits, BelowZero, ZeroDivisionError):
            return None
        if outer is None and guide is not None and isinstance(self.follower, Knife) and len(spots) > 1:
            raise SceneError(Status.UNSUPPORTED, passes_corner(self.what))
        return outer

    def _ahead(
        self, one: EnclosedContact, other: EnclosedContact, sense: float, guide: FollowerGuide | None
    ) -> bool:
        """Whether a contact is met before another; MoreDigits where they are one, but for their normals.

        Raises SceneError where both are met at once.
        """
        a, b = one.change, other.change
        if isinstance(self.follower, Knife) and (guide or self.freed) is None:  # a gap on either side
            a, b = a * a, b * b
        ahead = (a - b) * sense
        if not (at_least(ahead) and at_least(0.0 - ahead)):
            return at_least(ahead)
        if not all(at_least(p - q) and at_least(q - p) for p, q in zip(one.at, other.at, strict=True)):
            raise SceneError(
                Status.UNSUPPORTED, f"{self.what}: {ALONG if isinstance(self.follower, Flat) else TWICE}"
            )
        if isinstance(self.follower, Knife):
            raise MoreDigits
        return False

    def _spots(self, curve: Curve, foot: Foot, normal: Point, gap: float) -> Iterator[tuple[Foot, Point]]:
        """What may be touched about a foot, with the normals there: its piece, where that is square to the
        normal, and the end of it there, be it a corner or not.
        """
        piece, own, end = curve.pieces[foot.piece], curve.normal(foot.piece, foot.u), float(round(foot.u))
        face, knife = isinstance(self.follower, Flat), isinstance(self.follower, Knife)
        if math.dist(own, normal) <= BESIDE and not (face and isinstance(piece, Straight)):
            yield foot._replace(normals=(own,)), normal
        if abs(foot.u - end) <= BESIDE and not (knife or isinstance(self.shape, Circle | Radii)):
            at = piece.at(end)
            out = gap + (self.follower.radius.value if isinstance(self.follower, Roller) else 0.0)
            if not face:
                (px, py), (nx, ny), (x, y) = foot.point, normal, at
                normal = unit(px + out * nx - x, py + out * ny - y)
            yield Foot(at, foot.piece, end, (own, own)), normal

    def _enclosed_on(
        self, curve: Curve, meeting: Meeting, guide: FollowerGuide | None
    ) -> EnclosedContact | None:
        """The contact on what the meeting's foot is; None where that does not reach so far, MoreDigits where
        no one place is shown."""
        balls, freed, follower = Balls(DIGITS), self.freed, self.follower
        case = self.case if freed is None else freed.moved(0.0)
        own = points_of(follower)
        places = ball_places(case, (*own, *points_of(self.shape)), balls)
        face = direction_in_balls(follower.along, places, balls) if isinstance(follower, Flat) else None
        body = FollowerPlaces(follower, places[follower.at], face)
        by = meeting.gap
        if guide is not None:
            body, by = guide.moving(body, case, balls), 0.0
        elif freed is not None and isinstance(freed.freedom, Turn):
            pivot = freed.datum.pivot
            body = body._replace(about=ball_places(self.case, (pivot,), balls)[pivot])
            by = freed.by
        elif freed is not None and isinstance(freed.freedom, Shift):
            one = ball_places(freed.moved(curve.size), own, balls)[follower.at]
            step = balls.given(freed.number(curve.size)) - balls.given(freed.number(0.0))
            body = body._replace(along=((one[0] - body.at[0]) / step, (one[1] - body.at[1]) / step))
            by = freed.by * freed.freedom.along[freed.datum.axis]
        finder = LocusFinder(self.shape, curve, places, balls)
        start = TouchingAbout(meeting.foot.point, meeting.normals[0], by)
        return enclosed_contact(finder.locus(meeting.foot), body, start, finder.size, balls)

    def guide(self) -> Freedom | None:
        """How the frame guides the follower; None where something else does."""
        guide = guided(self.case, self.guided)
        return guide.freedom if guide is not None and guide.against == self.case.ground else None

    def body(self, places: Places) -> Body:
        """The follower with its points at these places."""
        return body_of(self.follower, places, f"link {self.link}")

    def followed(self, curve: Curve, refusal: SceneError) -> tuple[Case, Candidate]:
        """The case with the follower where it touches."""
        guide = guided(self.case, self.guided)
        if guide is None:
            raise refusal
        names = points_of(self.follower)
        datum = missing(self.case, self.guided, names, guide.freedom)
        freedom = along_data(self.case, names, datum, guide.freedom, self.guided)
        trial = datum.given(self.case, 0.0, freedom)
        body = self.body(places_of(trial, names))
        all_ways = candidates(curve, body, freedom)
        if not all_ways:
            raise SceneError(Status.CANNOT_ASSEMBLE, never_meets(self.what, body.kind, None))
        chosen = self.meant(all_ways, freedom, datum, trial)
        self.freed = Freed(self.case, datum, freedom, chosen.by, chosen.sense)
        return datum.given(self.case, chosen.by, freedom), chosen

    def meant(self, all_ways: list[Candidate], freedom: Freedom, datum: Missing, trial: Case) -> Candidate:
        """The way that `near` means, or the only one."""
        if len(all_ways) == 1:
            return all_ways[0]
        own = (*points_of(self.follower), *self.case.carries.get(self.guided, ()))
        names = [name for name in dict.fromkeys(own) if name in self.case.near]
        start = places_of(trial, tuple(names) or (datum.point,))
        off = sorted((self.off(way, freedom, start), n) for n, way in enumerate(all_ways))
        if not names or off[0][0] > CLEARLY * off[1][0]:
            here = places_of(trial, (datum.point,))[datum.point]
            ends = [_moved(freedom, way.by, here) for way in all_ways]
            raise SceneError(Status.AMBIGUOUS, several_ways(self.what, datum.point, ends, bool(names)))
        return all_ways[off[0][1]]

    def off(self, way: Candidate, freedom: Freedom, start: Places) -> float:
        """How far a way is from where `near` says."""
        near = self.case.near
        return math.fsum(math.dist(_moved(freedom, way.by, p), near.get(n, p)) for n, p in start.items())

    def contact(
        self, case: Case, curve: Curve, meeting: Meeting, guide: Freedom | None, note: bool = True
    ) -> tuple[Case, Touching]:
        """A case with a plain contact in the place of this one."""
        nx, ny = self.normal(meeting)
        sign = 1.0 if self.touch.links[0] == self.cam else -1.0
        degrees = math.degrees(math.atan2(sign * ny, sign * nx))
        at, path = meeting.foot.point, f"profile.{self.cam}.{self.link}"
        values: tuple[Scalar, ...] = (*at, degrees)
        if self.enclosed is not None:
            (nx, ny), a = self.enclosed.normal, Balls(DIGITS)
            values = (*self.enclosed.at, a.angle(nx * sign, ny * sign))
        sizes = (curve.size, curve.size, 360.0)
        x, y, normal = (
            exact_number(value, size, f"{path}.{key}")
            for key, value, size in zip(("x", "y", "normal"), values, sizes, strict=True)
        )
        at, degrees = (x.value, y.value), normal.value
        radii = self.radii(curve, meeting)
        joint = Contact(self.touch.links, self.hidden, normal, self.touch.friction, radii)
        joints = (*case.joints[: self.touch.place], joint, *case.joints[self.touch.place :])
        case = replace(case, joints=joints, points={**case.points, self.hidden: Coordinates(x, y)})
        said = left_open(self.shape, curve, meeting.foot, self.profile) if note else ""
        on = piece_words(self.shape, curve, meeting.foot)
        trace = self.trace(at, (nx, ny))
        pressure = pressure_angle(guide, trace, (nx, ny)) if guide is not None else None
        return case, Touching(self.touch.links, at, degrees % 360.0, on, pressure, said)

    def radii(self, curve: Curve, meeting: Meeting) -> tuple[Number | None, Number | None]:
        """The radii of curvature where they touch, in the order of the links."""
        own = self.follower.radius.value if isinstance(self.follower, Roller) else 0.0
        cam = self.enclosed.radius if self.enclosed is not None else curve.radius_at(meeting.foot)
        pair = (cam, None if isinstance(self.follower, Flat) else own)
        path = f"profile.{self.cam}.{self.link}.radius"
        first, second = (None if r is None else exact_number(r, curve.size, path) for r in pair)
        return (first, second) if self.touch.links[0] == self.cam else (second, first)

    def trace(self, at: Point, normal: Point) -> Point:
        """The point whose motion makes the pressure angle: a roller's centre, else the contact."""
        r = self.follower.radius.value if isinstance(self.follower, Roller) else 0.0
        return (at[0] + r * normal[0], at[1] + r * normal[1])

    def normal(self, meeting: Meeting) -> Point:
        """The normal from the profile into the follower."""
        if len(meeting.normals) == 1:
            return meeting.normals[0]
        before, after = (math.degrees(math.atan2(y, x)) for x, y in meeting.normals)
        spread = (after - before) % 360.0
        given = self.touch.normal
        if given is not None:
            inward = 0.0 if self.touch.links[0] == self.cam else 180.0
            turned = (given.value + inward - before) % 360.0
            if min(turned, 360.0 - turned) < 1e-9 or turned <= spread + 1e-9:
                angle = math.radians(before + turned)
                return (math.cos(angle), math.sin(angle))
        raise SceneError(Status.UNSUPPORTED, corner_refusal(self.what, before, spread, given))


def pressure_angle(guide: Freedom, at: Point, normal: Point) -> float:
    """Degrees, from 0 to 90, between the normal and the motion of a point of the follower.

    Parameters
    ----------
    guide : how the follower is guided
    at : the point [case length]
    normal : vector along the common normal, in either sense
    """
    x, y = guide.velocity(at)
    along, across = x * normal[0] + y * normal[1], x * normal[1] - y * normal[0]
    if abs(across) <= ROUNDED * abs(along):
        return 0.0
    return math.degrees(math.atan2(abs(across), abs(along)))


def _moved(freedom: Freedom, by: float, p: Point) -> Point:
    return freedom.moved(Body("", p), by).at


Places = dict[str, Point]


class FollowerGuide(NamedTuple):
    """A follower's freedom, the joint that leaves it, and the link against which it has it."""

    freedom: Freedom
    joint: Joint
    against: str

    def along(self, case: Case, balls: Balls) -> Vector:
        """The unit vector along which a follower slides."""
        guide = self.joint.guide
        assert guide is not None
        if guide.angle is not None:
            return balls.turn(guide.angle)
        assert guide.ends is not None
        return direction_in_balls(guide.ends, ball_places(case, guide.ends, balls), balls)

    def moving(self, body: FollowerPlaces, case: Case, balls: Balls) -> FollowerPlaces:
        """A follower that moves so."""
        if isinstance(self.freedom, Shift):
            return body._replace(along=self.along(case, balls))
        pivot = self.joint.at
        assert pivot is not None
        return body._replace(about=ball_places(case, (pivot,), balls)[pivot])


def places_of(case: Case, names: tuple[str, ...]) -> Places:
    """Points of the figure, in case units.

    Raises SceneError as `icsolve.assembly.solve_figure`.
    """
    figure = solve_figure(case, names)
    return {name: case_point(figure.frame, figure.points[name]) for name in names}


def carrier(case: Case, link: str, follower: Follower) -> str:
    """The link by whose guide a follower moves: that on which a roller of its own turns, else itself."""
    own = welded(case, link)
    for joint in case.joints if isinstance(follower, Roller) else ():
        if joint.pivot == follower.at and (others := _others(joint, own)):
            return others[0]
    return link


def _others(joint: Joint, body: tuple[str, ...]) -> list[str]:
    """The links to which a joint ties a body of welded links; none where it is no joint of it."""
    others = [link for link in joint.links if link not in body]
    return others if len(others) < len(joint.links) else []


def guided(case: Case, link: str) -> FollowerGuide | None:
    """How a link is guided: by a slide, or by a pin whose place is known; None where neither is.

    The frame guides it where it can.
    """
    body, frame = welded(case, link), {*welded(case, case.ground)}
    own = [joint for joint in case.joints if _guides(joint) and _others(joint, body)]
    for joint in sorted(own, key=lambda joint: frame.isdisjoint(joint.links)):
        others = _others(joint, body)
        against = others[0] if frame.isdisjoint(others) else case.ground
        try:
            freedom = _freedom(case, joint)
        except SceneError:
            continue
        return FollowerGuide(freedom, joint, against)
    return None


def _guides(joint: Joint) -> bool:
    """Whether it leaves one freedom, whose centre goes with its links."""
    return joint.freedom == 1 and joint.stays_known


def _freedom(case: Case, joint: Joint) -> Freedom:
    guide = joint.guide
    if guide is None:
        assert joint.at is not None
        return Turn(places_of(case, (joint.at,))[joint.at])
    if guide.angle is not None:
        return Shift(turn_of(guide.angle.value))
    assert guide.ends is not None
    (ax, ay), (bx, by) = places_of(case, guide.ends).values()
    return Shift(unit(bx - ax, by - ay))


class Missing(NamedTuple):
    """The datum that fixes a follower: the direction of a point from its pivot, or one of its coordinates."""

    point: str
    pivot: str
    axis: int
    trial: float

    def given(self, case: Case, by: float, freedom: Freedom) -> Case:
        """The case with the datum as it is after the follower has moved."""
        change = math.degrees(by) if isinstance(freedom, Turn) else by * freedom.along[self.axis]
        value = self.trial + change
        return self.put(case, Number(value, 0.0, "", repr(value)))

    def put(self, case: Case, number: Number) -> Case:
        """The case with a value of the datum."""
        number = number._replace(path=f"profile.{self.point}")
        if self.pivot:
            return replace(case, angles=(*case.angles, Direction(self.pivot, self.point, number)))
        old = case.points.get(self.point)
        kept = old if isinstance(old, Coordinates) else Coordinates(None, None)
        point = kept._replace(y=number) if self.axis else kept._replace(x=number)
        return replace(case, points={**case.points, self.point: point})


class Freed(NamedTuple):
    """A case whose follower is still free, the datum that fixes it, how far doubles moved it, and the sense
    (1 or -1) in which its gap grows there."""

    case: Case
    datum: Missing
    freedom: Freedom
    by: float
    sense: float

    def number(self, change: float) -> Number:
        """The datum, changed by so much [its unit] from where the search began."""
        value = self.datum.trial + change
        return Number(value, 0.0, "", repr(value))

    def moved(self, change: float) -> Case:
        """The case with the datum so changed."""
        return self.datum.put(self.case, self.number(change))


def missing(case: Case, link: str, points: tuple[str, ...], freedom: Freedom) -> Missing:
    """Which datum to try, and where to start.

    Raises SceneError where the follower has no point that could carry it.
    """
    if isinstance(freedom, Shift):
        axis = 0 if abs(freedom.along[0]) > abs(freedom.along[1]) else 1
        return Missing(points[0], "", axis, case.near.get(points[0], (0.0, 0.0))[axis])
    body = welded(case, link)
    pivot = next(p for one in body for p in case.pivots(one) if _is_at(case, p, freedom.about))
    carried = (p for one in body for p in case.carries.get(one, ()))
    arm = next((p for p in (*points, *carried) if p != pivot), None)
    if arm is None:
        raise SceneError(
            Status.UNDERDETERMINED,
            f"link {link} has no point besides its pin {pivot} by which its face could be turned. Give the "
            "face by two points, `along: [D, E]`.",
        )
    x, y = case.near.get(arm, (freedom.about[0] + 1.0, freedom.about[1]))
    return Missing(arm, pivot, 0, math.degrees(math.atan2(y - freedom.about[1], x - freedom.about[0])))


def along_data(case: Case, names: tuple[str, ...], datum: Missing, freedom: Freedom, link: str) -> Freedom:
    """The way in which the data let a follower slide: a coordinate that they give may lead beside its guide.

    Raises SceneError where they let it turn as well.
    """
    if isinstance(freedom, Turn):
        return freedom
    unit_way = tuple(float(axis == datum.axis) for axis in (0, 1))
    there = datum.given(case, 1.0, Shift((unit_way[0], unit_way[1])))
    first, second = (places_of(one, names) for one in (datum.given(case, 0.0, freedom), there))
    moves = [(second[n][0] - first[n][0], second[n][1] - first[n][1]) for n in names]
    x, y = moves[0]
    if any(math.dist(move, moves[0]) > 1e-9 * math.hypot(x, y) for move in moves):
        raise SceneError(
            Status.UNDERDETERMINED,
            f"the data of link {link} do not say how it slides: give its points by lengths and angles from "
            "one of them.",
        )
    return Shift(unit(x, y))


def _is_at(case: Case, name: str, place: Point) -> bool:
    try:
        return places_of(case, (name,))[name] == place
    except SceneError:
        return False
