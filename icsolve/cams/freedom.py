"""How the joints of a follower let it move against a link that stands, and the datum that is missing."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

from icsolve.assembly import case_point, solve_figure
from icsolve.cams.lift import Freedom, Shift, Turn
from icsolve.cams.pieces import Point, unit
from icsolve.case import Case, Coordinates, Direction, Number, Pin, Slide
from icsolve.case.profiles import Follower, Roller
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import turn_of

Places = dict[str, Point]


class Guided(NamedTuple):
    """A follower's freedom, and the link against which it has it."""

    freedom: Freedom
    against: str


def places_of(case: Case, names: tuple[str, ...]) -> Places:
    """Points of the figure, in case units.

    Raises SceneError as `icsolve.assembly.solve_figure`.
    """
    figure = solve_figure(case, names)
    return {name: case_point(figure.frame, figure.points[name]) for name in names}


def carrier(case: Case, link: str, follower: Follower) -> str:
    """The link by whose guide a follower moves: that on which a roller of its own turns, else itself."""
    for joint in case.joints if isinstance(follower, Roller) else ():
        if isinstance(joint, Pin) and link in joint.links and joint.at == follower.at:
            return next(other for other in joint.links if other != link)
    return link


def guided(case: Case, link: str) -> Guided | None:
    """How a link is guided: by a slide, or by a pin whose place is known; None where neither is.

    The frame guides it where it can.
    """
    own = [joint for joint in case.joints if link in joint.links and isinstance(joint, Pin | Slide)]
    for joint in sorted(own, key=lambda joint: case.ground not in joint.links):
        others = [other for other in joint.links if other != link]
        against = case.ground if case.ground in others else others[0]
        try:
            freedom = _freedom(case, joint)
        except SceneError:
            continue
        return Guided(freedom, against)
    return None


def _freedom(case: Case, joint: Pin | Slide) -> Freedom:
    if isinstance(joint, Pin):
        return Turn(places_of(case, (joint.at,))[joint.at])
    guide = joint.guide
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
        if isinstance(freedom, Turn):
            value = self.trial + math.degrees(by)
            datum = Direction(self.pivot, self.point, self.number(value))
            return replace(case, angles=(*case.angles, datum))
        value = self.trial + by * freedom.along[self.axis]
        old = case.points.get(self.point)
        kept = old if isinstance(old, Coordinates) else Coordinates(None, None)
        number = self.number(value)
        point = kept._replace(y=number) if self.axis else kept._replace(x=number)
        return replace(case, points={**case.points, self.point: point})

    def number(self, value: float) -> Number:
        """A number that the profile gives."""
        return Number(value, 0.0, f"profile.{self.point}", repr(value))


def missing(case: Case, link: str, points: tuple[str, ...], freedom: Freedom) -> Missing:
    """Which datum to try, and where to start.

    Raises SceneError where the follower has no point that could carry it.
    """
    if isinstance(freedom, Shift):
        axis = 0 if abs(freedom.along[0]) > abs(freedom.along[1]) else 1
        return Missing(points[0], "", axis, case.near.get(points[0], (0.0, 0.0))[axis])
    pivot = next(
        joint.at
        for joint in case.joints
        if isinstance(joint, Pin) and link in joint.links and _is_at(case, joint.at, freedom.about)
    )
    arm = next((p for p in (*points, *case.carries.get(link, ())) if p != pivot), None)
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


__all__ = ["Guided", "Mapping", "Missing", "Places", "guided", "missing", "places_of"]
