"""Which of the motions is meant, and how fast: link rates, velocities, and relative twists.

The motions form a space with one coefficient per freedom. What the case says of speeds fixes some
combinations of them; what stays open is named as undetermined, never guessed.
"""

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from icsolve.assembly.workspace import Frame
from icsolve.case import Case, SpeedIs
from icsolve.case import Motion as Given
from icsolve.errors import SceneError, Status
from icsolve.numbers.null_space import null_space
from icsolve.screws.plane import Point, Triple, velocity

Twists = Mapping[str, Sequence[Triple]]
STILL = 2e-14
"""What moves slower than this fraction of the fastest link is at rest (rounding); normalised frame."""

OPEN = "a freedom that no given motion fixes moves it."


class Speed(NamedTuple):
    """The motions that are meant: ``particular / divisor`` plus any combination of ``open``
    (coefficients of the motions)."""

    particular: tuple[float, ...]
    open: tuple[tuple[float, ...], ...]
    divisor: float = 1.0
    reference: tuple[str, str | None] | None = None
    """the link (and point of it) whose rate (speed) in the one motion is ``divisor``"""

    def of(self, values: Sequence[float], scale: float) -> float | None:
        """A quantity that has ``values[m]`` in motion m; None where it is undetermined.

        ``scale`` is the size of ``values`` before cancellation; below `STILL` of it the value is zero.
        """
        if any(abs(_dot(direction, values)) > 1e-9 * scale for direction in self.open):
            return None
        return self.particular_of(values, scale)

    def particular_of(self, values: Sequence[float], scale: float) -> float:
        """The same in one motion of those that are meant, as good as any other."""
        value = _dot(self.particular, values)
        size = scale * max(map(abs, self.particular), default=0.0)
        return 0.0 if abs(value) <= STILL * size else value / self.divisor


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))


def speed_of(case: Case, twists: Twists, frame: Frame, points: Mapping[str, Point]) -> Speed:
    """The motion that the case asks for, or the normalised one of the format.

    Raises SceneError where the given motion cannot be: a dead centre, or motions that contradict.
    """
    motions = len(next(iter(twists.values())))
    if motions == 1 and len(case.motion) <= 1:
        return _single(case, twists, frame, points)
    rows = [_row(given, case, twists, frame, points) for given in case.motion]
    if not rows:
        rows = [_normal_row(case, twists, frame)[1:]]
    return _combined(rows, motions)


def _single(case: Case, twists: Twists, frame: Frame, points: Mapping[str, Point]) -> Speed:
    if case.motion:
        given = case.motion[0]
        values, target = _row(given, case, twists, frame, points)
        return Speed((target,), (), values[0], (given.link, given.point))
    link, values, target = _normal_row(case, twists, frame)
    turns = values[0] == twists[link][0][2]
    return Speed((target,), (), values[0], (link, None) if turns else None)


Row = tuple[tuple[float, ...], float]
"""What a condition takes from each motion, and what their sum is to be."""


def _combined(rows: list[Row], motions: int) -> Speed:
    matrix = [[*values, -target] for values, target in rows]
    sizes = [max(map(abs, row)) or 1.0 for row in matrix]
    scaled = [[v / s for v in row] for row, s in zip(matrix, sizes, strict=True)]
    found = null_space(scaled, motions + 1, 1e-12)
    with_target = [vector for vector in found.basis if abs(vector[-1]) > 1e-9]
    if not with_target:
        message = "the motions given contradict each other: no motion has all of them."
        raise SceneError(Status.INCONSISTENT, message)
    first = with_target[0]
    particular = tuple(v / first[-1] for v in first[:-1])
    rest = [v for v in found.basis if v is not first]
    open_ = tuple(tuple(v[k] - v[-1] * particular[k] for k in range(motions)) for v in rest)
    return Speed(particular, open_)


def _row(given: Given, case: Case, twists: Twists, frame: Frame, points: Mapping[str, Point]) -> Row:
    """The condition that a given motion puts on the coefficients."""
    if given.link == case.ground:
        message = f"link {given.link} is the frame and has no motion: give the motion of another link."
        raise SceneError(Status.INCONSISTENT, message)
    link = twists[given.link]
    if given.point is not None:
        return _point_row(given, link, fastest(twists), frame, points[given.point])
    rates = tuple(t[2] for t in link)
    largest = fastest(twists)
    if all(abs(rate) <= STILL * largest for rate in rates):
        raise SceneError(Status.DEAD_CENTRE, _cannot_turn(given.link, link, largest))
    sign = -1.0 if given.turns == "cw" else 1.0
    return rates, sign * (given.speed.value if given.speed is not None else 1.0)


def _cannot_turn(name: str, link: Sequence[Triple], largest: float) -> str:
    if all(_extent(t) <= STILL * largest for t in link):
        return (
            f"link {name} cannot drive in this position (dead centre): when the mechanism moves, link {name} "
            "stands still. Give the motion of another link, or another position."
        )
    return (
        f"link {name} does not turn, it only slides: give `motion` as the speed of one of its points, "
        "or of another link."
    )


def _point_row(given: Given, link: Sequence[Triple], largest: float, frame: Frame, p: Point) -> Row:
    velocities = [velocity(t, p) for t in link]
    sizes = [math.hypot(*v) for v in velocities]
    assert given.speed is not None
    target = given.speed.value * frame.scale
    if max(sizes) <= STILL * largest:
        raise SceneError(
            Status.DEAD_CENTRE,
            f"point {given.point} of link {given.link} is at rest in this position when the mechanism moves: "
            "it cannot be given a speed. Give the motion of another point or link.",
        )
    if given.angle is None:
        v = velocities[sizes.index(max(sizes))]
        along = (v[0] / max(sizes), v[1] / max(sizes))
        along = along if along[0] > 0 or (along[0] == 0 and along[1] > 0) else (-along[0], -along[1])
    else:
        radians = math.radians(given.angle.value)
        along = (math.cos(radians), math.sin(radians))
        if len(link) == 1:
            _check_direction(given, velocities[0], along)
            sign = 1.0 if velocities[0][0] * along[0] + velocities[0][1] * along[1] > 0 else -1.0
            return (sign * sizes[0],), target
    return tuple(v[0] * along[0] + v[1] * along[1] for v in velocities), target


def _check_direction(given: Given, v: Point, along: Point) -> None:
    sine: float = abs(v[0] * along[1] - v[1] * along[0]) / math.hypot(*v)
    if sine > math.sin(math.radians(1.0)):
        own = math.degrees(math.atan2(v[1], v[0])) % 180.0
        assert given.angle is not None
        raise SceneError(
            Status.INCONSISTENT,
            f"point {given.point} of link {given.link} can only move at {own:.4g} or {own + 180.0:.4g} deg "
            f"in this position, not at {given.angle.value:g} deg: correct the angle of `motion`.",
        )


def _extent(t: Triple) -> float:
    return max(abs(float(x)) for x in t)


def fastest(twists: Twists) -> float:
    """Size of the largest twist of a scene, against which rest is judged."""
    return max((_extent(t) for link in twists.values() for t in link), default=0.0)


def joint_order(case: Case) -> list[str]:
    """Links in the order in which the joints name them."""
    return list(dict.fromkeys(link for joint in case.joints for link in joint.links))


def _normal_row(case: Case, twists: Twists, frame: Frame) -> tuple[str, tuple[float, ...], float]:
    """The first link that turns does so at +1; where none turns, unit speed of the first that moves."""
    largest = fastest(twists)
    for link in joint_order(case):
        rates = tuple(t[2] for t in twists.get(link, ()))
        if any(abs(rate) > STILL * largest for rate in rates):
            return link, rates, 1.0
    for link in joint_order(case):
        speeds = [(t[1], -t[0]) for t in twists.get(link, ())]
        fast = max(speeds, key=lambda v: math.hypot(*v), default=(0.0, 0.0))
        size = math.hypot(*fast)
        if size > STILL * largest:
            x, y = fast[0] / size, fast[1] / size
            along = (x, y) if x > STILL or (abs(x) <= STILL and y > 0) else (-x, -y)
            return link, tuple(v[0] * along[0] + v[1] * along[1] for v in speeds), frame.scale
    raise SceneError(Status.STRUCTURE, "no link of the mechanism moves in this position.")


def link_rates(case: Case, twists: Twists, speed: Speed) -> dict[str, float | str]:
    """Angular velocity of every link; a sentence where it is undetermined."""
    rates: dict[str, float | str] = {}
    largest = fastest(twists)
    for link in case.links:
        value = speed.of([t[2] for t in twists[link]], largest)
        rates[link] = f"the speed of link {link} is left open: {OPEN}" if value is None else value + 0.0
    return rates


def point_velocities(
    case: Case, twists: Twists, speed: Speed, frame: Frame, points: Mapping[str, Point]
) -> dict[tuple[str, str], tuple[float, float] | str]:
    """Velocity (case length a second) of every point on the links that carry it."""
    result: dict[tuple[str, str], tuple[float, float] | str] = {}
    largest = fastest(twists)
    for link in case.links:
        for name in moving_points(case, link):
            if name.startswith("@") or name not in points:
                continue
            both = _velocity(twists[link], speed, largest, points[name])
            words = f"the velocity of {name} on link {link} is left open: {OPEN}"
            result[(name, link)] = words if both is None else (both[0] / frame.scale, both[1] / frame.scale)
    return result


def moving_points(case: Case, link: str) -> list[str]:
    """The points whose velocity on a link is told: those that it carries or whose speed is published."""
    asked = [e.target.point for e in case.expect if isinstance(e.target, SpeedIs) and e.target.link == link]
    return list(dict.fromkeys((*case.carries.get(link, ()), *asked)))


def _velocity(motions: Sequence[Triple], speed: Speed, largest: float, p: Point) -> Point | None:
    """Velocity (normalised) of a point of a link; None where it is undetermined."""
    x = speed.of([velocity(t, p)[0] for t in motions], largest)
    y = speed.of([velocity(t, p)[1] for t in motions], largest)
    return None if x is None or y is None else (x + 0.0, y + 0.0)


def meant(twists: Twists, speed: Speed, link: str) -> tuple[Triple, ...]:
    """The twists of a link in the motions that are meant: one per open direction, the particular first."""
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


