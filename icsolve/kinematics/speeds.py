"""Which of the motions is meant, and how fast: link rates, velocities, and relative twists.

The motions form a space with one coefficient per freedom. What the case says of speeds fixes some
combinations of them; what stays open is named as undetermined, never guessed.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from icsolve.assembly.workspace import PlacedCase
from icsolve.case import Case, is_named, told_links
from icsolve.case import Motion as Given
from icsolve.errors import SceneError, Status
from icsolve.numbers import (
    FLOATS,
    Arithmetic,
    Scalar,
    all_vanish,
    decider,
    largest_of,
    size_of,
    zero_of,
)
from icsolve.screws import Point, Triple, velocity
from icsolve.tuples import LateModule, NamedTuple

if TYPE_CHECKING:
    from icsolve.numbers import linear
else:
    linear = LateModule("icsolve.numbers.linear")

Twists = Mapping[str, Sequence[Triple]]
SLANT = math.sin(math.radians(1.0))
"""The direction of a given motion may be that far from the path of its point (a sine)."""
ROUNDED = 1e-12
"""What rounding leaves of a speed that other data repeat."""
LOOSE = 5e4
"""In floats a combination of several motions is zero within so many times as much."""

NO_SPEED = (
    "inertia forces need to know how fast the mechanism moves: give `motion` a `speed`, as in "
    "`motion: {link: 2, speed: 12 rad/s}`."
)
OPEN = "a freedom that no given motion fixes moves it."


class Speed(NamedTuple):
    """The motions that are meant: ``particular / divisor`` plus any combination of ``open``.

    Attributes
    ----------
    particular : (freedoms,), coefficients of the motions
    open : coefficients, (freedoms,) each, of the directions that no given motion fixes
    divisor : the rate by which ``particular`` is still to be divided
    """

    particular: tuple[Scalar, ...]
    open: tuple[tuple[Scalar, ...], ...]
    divisor: Scalar = 1.0
    reference: tuple[str, str | None] | None = None
    """the link (and point of it) whose rate (speed) in the one motion is ``divisor``"""
    arithmetic: Arithmetic = FLOATS

    def of(self, values: Sequence[Scalar], scale: float) -> Scalar | None:
        """A quantity that has ``values[m]`` in motion m; None where a freedom that no motion fixes changes
        it.

        Parameters
        ----------
        values : (freedoms,) [units of the quantity]
        scale : size of ``values`` before cancellation, by which a zero is judged [the same]
        """
        if any(not self.arithmetic.vanishes(_dot(d, values), LOOSE * scale) for d in self.open):
            return None
        return self.particular_of(values, scale)

    def particular_of(self, values: Sequence[Scalar], scale: float) -> Scalar:
        """The same in one motion of those that are meant, as good as any other."""
        value = _dot(self.particular, values)
        size = scale * largest_of(self.particular)
        if self.arithmetic.vanishes(value, size):
            return zero_of(value / self.divisor)
        return value / self.divisor


def _dot(a: Sequence[Scalar], b: Sequence[Scalar]) -> Scalar:
    return sum((x * y for x, y in zip(a, b, strict=True)), 0.0)


def speed_of(place: PlacedCase, twists: Twists) -> Speed:
    """The motion that the case asks for, or the normalised one of the format.

    Without a given motion the first link that the joints name and that turns does so at +1 rad/s; where none
    turns, the first that moves goes at 1 case length a second.

    Parameters
    ----------
    place : the case with its given motions
    twists : by link, one twist a freedom [frame lengths, radians]

    Raises
    ------
    SceneError
        Where the given motion cannot be: at a dead centre, where given motions contradict each other, at an
        angle at which a point can't move, and where nothing moves.
    """
    case, motions = place.case, len(next(iter(twists.values())))
    if motions == 1:
        return _single(place, twists)
    rows = [_row(given, place, twists) for given in case.motion]
    if not rows:
        rows = [_normal_row(place, twists)[1:]]
    return _combined(rows, motions, place.arithmetic)


def _single(place: PlacedCase, twists: Twists) -> Speed:
    case, a = place.case, place.arithmetic
    if case.motion:
        given, rows = case.motion[0], [_row(one, place, twists) for one in case.motion]
        for one, off, room in _spare(place, rows):
            if abs(float(off)) > float(room):
                raise SceneError(Status.INCONSISTENT, _off(place, one, rows))
        values, target = rows[0]
        return Speed((target,), (), values[0], (given.link, given.point), a)
    link, values, target = _normal_row(place, twists)
    turns = values[0] is twists[link][0][2]
    return Speed((target,), (), values[0], (link, None) if turns else None, a)


Row = tuple[tuple[Scalar, ...], Scalar]
"""What a condition takes from each motion, and what their sum is to be."""


def _spare(place: PlacedCase, rows: Sequence[Row]) -> Iterator[tuple[int, Scalar, Scalar]]:
    """Of one freedom the motions that are given beside the first, by their places: how far each is off what
    the first one makes of it, and how far it may be, by half a unit of the last decimal of both."""
    (own,), set_by = rows[0]
    halves = [_half(given, place) for given in place.case.motion]
    for n, ((value,), target) in enumerate(rows[1:], 1):
        ratio = value / own
        yield n, ratio * set_by - target, halves[n] + size_of(ratio) * halves[0]


def _half(given: Given, place: PlacedCase) -> float:
    """Half a unit of the last decimal of a speed, and its rounding [frame lengths]."""
    scale = 1.0 if given.point is None else place.frame.scale
    return scale * (given.speed.half + ROUNDED * abs(given.speed.value) if given.speed else ROUNDED)


def _off(place: PlacedCase, n: int, rows: Sequence[Row]) -> str:
    """That a motion is not that which the first one makes."""
    one = place.case.motion[n]
    what = f"link {one.link}" if one.point is None else f"point {one.point} of link {one.link}"
    ((own,), set_by), ((value,), target) = rows[0], rows[n]
    per = place.frame.scale if one.point is not None else 1.0
    found, given = float(value / own * set_by) / per, float(target) / per
    unit = "rad/s" if one.point is None else f"{place.case.units.length}/s"
    return (
        f"the motions given contradict each other: by the first one the speed of {what} is {found:.6g} "
        f"{unit}, and {given:.6g} {unit} is given. Correct one, or leave it out."
    )


def _combined(rows: list[Row], motions: int, a: Arithmetic) -> Speed:
    matrix = [[*values, -target] for values, target in rows]
    sizes = [math.ldexp(1.0, math.frexp(max(map(abs, row)))[1]) for row in matrix]  # rounds nothing
    scaled = [[v / s for v in row] for row, s in zip(matrix, sizes, strict=True)]
    found = linear.null_space(scaled, motions + 1, 1e-12, vanishes=decider(a))
    with_target = [vector for vector in found.basis if not a.vanishes(vector[-1], LOOSE)]
    if not with_target:
        message = "the motions given contradict each other: no motion has all of them."
        raise SceneError(Status.INCONSISTENT, message)
    first = with_target[0]
    particular = tuple(v / first[-1] for v in first[:-1])
    rest = [v for v in found.basis if v is not first]
    open_ = tuple(tuple(v[k] - v[-1] * particular[k] for k in range(motions)) for v in rest)
    return Speed(particular, open_, arithmetic=a)


def _row(given: Given, place: PlacedCase, twists: Twists) -> Row:
    """The condition that a given motion puts on the coefficients."""
    a = place.arithmetic
    if given.link == place.case.ground:
        message = f"link {given.link} is the frame and has no motion: give the motion of another link."
        raise SceneError(Status.INCONSISTENT, message)
    link = twists[given.link]
    if given.point is not None:
        assert given.speed is not None
        p, target = place.points[given.point], a.given(given.speed) * place.frame.scale
        c, s = path_of(given, link, fastest(twists), p, a)
        return tuple(vx * c + vy * s for vx, vy in (velocity(t, p) for t in link)), target
    rates = tuple(t[2] for t in link)
    largest = fastest(twists)
    if all_vanish(a, ((rate, largest) for rate in rates)):
        raise SceneError(Status.DEAD_CENTRE, _cannot_turn(given.link, link, largest, a))
    sign = -1.0 if given.turns == "cw" else 1.0
    return rates, sign * (a.given(given.speed) if given.speed is not None else 1.0)


def _cannot_turn(name: str, link: Sequence[Triple], largest: float, a: Arithmetic) -> str:
    if all_vanish(a, ((x, largest) for t in link for x in t)):
        return (
            f"link {name} cannot drive in this position (dead centre): when the mechanism moves, link {name} "
            "stands still. Give the motion of another link, or another position."
        )
    return (
        f"link {name} does not turn, it only slides: give `motion` as the speed of one of its points, "
        "or of another link."
    )


def path_of(given: Given, link: Sequence[Triple], largest: float, p: Point, a: Arithmetic) -> Point:
    """Unit vector along which the given speed of a point counts.

    Where the point has one path, along that: in the sense of the given angle, else toward +x.

    Raises
    ------
    SceneError
        Where the point is at rest in all motions, and where it can't move at the given angle.
    """
    velocities = [velocity(t, p) for t in link]
    if all_vanish(a, ((x, largest) for v in velocities for x in v)):
        raise SceneError(
            Status.DEAD_CENTRE,
            f"point {given.point} of link {given.link} is at rest in this position when the mechanism moves: "
            "it cannot be given a speed. Give the motion of another point or link.",
        )
    if given.angle is None:
        return _rightward(max(velocities, key=_speed), largest, a)
    along = a.turn(given.angle)
    if len(link) > 1:
        return along
    (x, y), (c, s) = velocities[0], along
    _check_direction(given, (float(x), float(y)), (float(c), float(s)))
    size = a.sqrt(x * x + y * y)
    return (x / size, y / size) if x * c + y * s > 0.0 else (-x / size, -y / size)


def _speed(v: Point) -> float:
    return math.hypot(float(v[0]), float(v[1]))


def _rightward(v: Point, largest: float, a: Arithmetic) -> Point:
    """Unit vector along a velocity, in the sense toward +x (+y where it is upright)."""
    size = a.sqrt(v[0] * v[0] + v[1] * v[1])
    x, y = v[0] / size, v[1] / size
    positive = y > 0.0 if a.vanishes(x, largest / _speed(v)) else x > 0.0
    return (x, y) if positive else (-x, -y)


def _check_direction(given: Given, v: Point, along: Point) -> None:
    sine: float = abs(v[0] * along[1] - v[1] * along[0]) / math.hypot(*v)
    if sine > SLANT:
        own = math.degrees(math.atan2(v[1], v[0])) % 180.0
        assert given.angle is not None
        raise SceneError(
            Status.INCONSISTENT,
            f"point {given.point} of link {given.link} can only move at {own:.4g} or {own + 180.0:.4g} deg "
            f"in this position, not at {given.angle.value:g} deg: correct the angle of `motion`.",
        )


def motion_margins(place: PlacedCase, twists: Twists, *, sense: bool) -> Iterator[Scalar]:
    """In any arithmetic, numbers of which none is negative but where `speed_of` may refuse or, where
    ``sense`` counts, take the motion of a point in the other sense than in this position."""
    case, a, largest = place.case, place.arithmetic, fastest(twists)
    for given in case.motion:
        link = twists[given.link]
        if given.link == case.ground:
            yield -1.0
        elif len(link) > 1:
            continue  # what they are together is no number
        elif given.point is None:
            rate = link[0][2]
            share = rate / (float(rate) or 1.0)
            yield share * share if not a.vanishes(rate, largest) else -1.0
        else:
            x, y = velocity(link[0], place.points[given.point])
            if all_vanish(a, ((x, largest), (y, largest))):
                yield -1.0
                continue
            assert given.angle is not None
            size, (c, s) = a.sqrt(x * x + y * y), a.turn(given.angle)
            off, along = (x * s - y * c) / size, (x * c + y * s) / size
            yield SLANT * SLANT - off * off
            if sense:
                yield along if float(along) > 0.0 else -along
    if len(case.motion) > 1 and len(twists[case.motion[0].link]) == 1:
        with suppress(SceneError):  # of one that a row above refuses
            for _, off, room in _spare(place, [_row(given, place, twists) for given in case.motion]):
                yield room * room - off * off


def fastest(twists: Twists) -> float:
    """Size of the largest twist of a scene, against which rest is judged."""
    return largest_of([float(x) for link in twists.values() for t in link for x in t])


def joint_order(case: Case) -> list[str]:
    """Links in the order in which the joints, and then the ropes, name them."""
    return list(dict.fromkeys(link for joint in (*case.joints, *case.ropes) for link in joint.links))


def _normal_row(place: PlacedCase, twists: Twists) -> tuple[str, tuple[Scalar, ...], Scalar]:
    """The first link that turns does so at +1; where none turns, unit speed of the first that moves."""
    case, frame, _, a = place
    largest = fastest(twists)
    for link in joint_order(case):
        rates = tuple(t[2] for t in twists.get(link, ()))
        if rates and not all_vanish(a, ((rate, largest) for rate in rates)):
            return link, rates, 1.0
    for link in joint_order(case):
        speeds = [(t[1], -t[0]) for t in twists.get(link, ())]
        if speeds and not all_vanish(a, ((x, largest) for v in speeds for x in v)):
            along = _rightward(max(speeds, key=_speed), largest, a)
            return link, tuple(v[0] * along[0] + v[1] * along[1] for v in speeds), frame.scale
    raise SceneError(Status.STRUCTURE, "no link of the mechanism moves in this position.")


def link_rates(case: Case, twists: Twists, speed: Speed) -> dict[str, Scalar | str]:
    """Angular velocity of every link [rad/s, ccw positive]; a sentence where it is undetermined."""
    rates: dict[str, Scalar | str] = {}
    largest = fastest(twists)
    for link in told_links(case):
        value = speed.of([t[2] for t in twists[link]], largest) if link in twists else None
        rates[link] = f"the speed of link {link} is left open: {OPEN}" if value is None else value + 0.0
    return rates


def point_velocities(
    place: PlacedCase, twists: Twists, speed: Speed
) -> dict[tuple[str, str], tuple[Scalar, Scalar] | str]:
    """Velocity (vx, vy) [case length/s] of every point on the links that carry it, by (point, link); a
    sentence where it is undetermined.
    """
    case, frame, points, _ = place
    result: dict[tuple[str, str], tuple[Scalar, Scalar] | str] = {}
    largest = fastest(twists)
    for link in told_links(case):
        for name in moving_points(case, link):
            if not is_named(name) or name not in points:
                continue
            both = _velocity(twists[link], speed, largest, points[name]) if link in twists else None
            words = f"the velocity of {name} on link {link} is left open: {OPEN}"
            result[(name, link)] = words if both is None else (both[0] / frame.scale, both[1] / frame.scale)
    return result


def moving_points(case: Case, link: str) -> list[str]:
    """The points whose velocity on a link is told: those that it carries or whose speed is published."""
    asked = []
    if case.expect:
        from icsolve.case.expected import SpeedIs

        targets = [e.target for e in case.expect]
        asked = [t.point for t in targets if isinstance(t, SpeedIs) and t.link == link]
    return list(dict.fromkeys((*case.carries.get(link, ()), *asked)))


def _velocity(motions: Sequence[Triple], speed: Speed, largest: float, p: Point) -> Point | None:
    """Velocity (normalised) of a point of a link; None where it is undetermined."""
    x = speed.of([velocity(t, p)[0] for t in motions], largest)
    y = speed.of([velocity(t, p)[1] for t in motions], largest)
    return None if x is None or y is None else (x + 0.0, y + 0.0)


def meant(twists: Twists, speed: Speed, link: str) -> tuple[Triple, ...]:
    """The twists of a link in the motions that are meant: one per open direction, the particular first (not
    yet over ``speed.divisor``).
    """
    motions = twists[link]
    directions = (speed.particular, *speed.open)
    return tuple(
        (
            _dot(c, [t[0] for t in motions]),
            _dot(c, [t[1] for t in motions]),
            _dot(c, [t[2] for t in motions]),
        )
        for c in directions
    )
