"""Conservation of power: the loads' wrenches on the twists give the unknown loads, a term a load.

In equilibrium the power of all loads is zero for every motion that the joints allow. Each load is a
number times a unit wrench; its factor for a motion is the pairing of that wrench with the relative
twist of the bodies between which it acts.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import reduce
from operator import add, mul, sub
from typing import TYPE_CHECKING, TypeVar

from icsolve.assembly.workspace import PlacedCase
from icsolve.case import (
    AlongRope,
    Area,
    Case,
    Force,
    ForceVector,
    Friction,
    Joint,
    Like,
    Load,
    Number,
    Slope,
    Spring,
    Stretch,
    Torque,
    TorsionSpring,
    Toward,
    Weight,
)
from icsolve.errors import SceneError, Status
from icsolve.kinematics.motion import Motions
from icsolve.numbers.arithmetic import (
    FLOATS,
    Arithmetic,
    Scalar,
    Showing,
    all_vanish,
    decider,
    largest,
    magnitude,
    sum_of_sizes,
    zero_of,
)
from icsolve.screws.plane import Point, Triple, force_wrench, unit_between
from icsolve.tuples import Generic, LateModule, NamedTuple

if TYPE_CHECKING:
    from icsolve.case.space import Load as SpatialLoad
    from icsolve.numbers import linear
    from icsolve.numbers.tape import Tape
    from icsolve.screws import ropes as rope_screws
else:
    linear = LateModule("icsolve.numbers.linear")
    rope_screws = LateModule("icsolve.screws.ropes")

Points = Mapping[str, Point]
L = TypeVar("L", bound="Load | SpatialLoad")


class UnitWrench(NamedTuple, Generic[L]):
    """A load per unit of its number, in the plane or in space: ``gain * measure * unit`` acts on the load's
    link, the opposite on ``against``.

    Attributes
    ----------
    load : the load
    against : link that takes the opposite
    unit : (3,) or (6,), wrench of a force of 1, or a couple of 1, about the origin [frame lengths]: in the
        plane (-Fy, Fx, M)
    gain : what brings the load's own unit to force units (a couple: force times case length); of a spring its
        stretch [case length], of a pressure its area
    root, ratio : the load whose number it takes, ``ratio`` times as large
    measure : the power of two that brings case lengths into the frame (of a couple, else 1), kept apart so
        that nothing overflows
    number : that of the root, of a vector its components; None where it is to find
    reach : size of the terms of the gain, which for a spring are its length and its free length
    """

    load: L
    against: str
    unit: tuple[Scalar, ...]
    gain: Scalar
    root: str
    ratio: Scalar
    measure: float
    number: Number | tuple[Number, ...] | None
    reach: float


Wrench = UnitWrench[Load]
"""Of a load in the plane."""


def wrenches(place: PlacedCase, *, vectors: bool = False) -> tuple[Wrench, ...]:
    """The unit wrenches of all loads of a case, in its order.

    Parameters
    ----------
    place : with the points that `points_of` tells of each load
    vectors : whether the unit of a spring that is free at no length is its own vector [frame], and its gain
        the case length of a unit of it: the same force, smooth where its points meet

    A direction between two points at one place divides by zero; of a spring that is free at no length the
    wrench is zero there.
    """
    case, frame, points, arithmetic = place
    by_name = {load.name: load for load in case.loads}
    result = []
    for load in case.loads:
        if vectors and may_vanish(load):
            (ax, ay), (bx, by) = (points[name] for name in points_of(load))
            unit, gain = force_wrench((bx - ax, by - ay), (ax, ay)), 1.0 / frame.scale
        else:
            unit, gain = _unit_wrench(load, place)
        measure = frame.scale if isinstance(load, Torque | TorsionSpring) else 1.0
        result.append(acting(load, by_name, case, unit, gain, measure, arithmetic))
    return tuple(result)


def acting(
    load: L,
    by_name: Mapping[str, L],
    case: Case,
    unit: tuple[Scalar, ...],
    gain: Scalar,
    measure: float,
    arithmetic: Arithmetic,
) -> UnitWrench[L]:
    """The unit wrench of a load, with the number that it takes."""
    root, ratio, number = number_taken(load, by_name, arithmetic)
    reach = magnitude(gain)
    if isinstance(load, TorsionSpring):  # its gain is a difference of angles, up to a whole turn
        reach += 2.0 * math.pi / case.units.torque_per_force_length
    elif isinstance(load, Spring):  # and this one of lengths
        reach += 2.0 * load.free.value
    return UnitWrench(load, reacting(case, load), unit, gain, root, ratio, measure, number, reach)


def number_taken(
    load: L, by_name: Mapping[str, L], arithmetic: Arithmetic
) -> tuple[str, Scalar, Number | tuple[Number, ...] | None]:
    """The name of the load whose number another takes (its own, where it has one), how many times, and that
    number: of a vector its components."""
    ratio: Scalar = 1.0
    while isinstance(value := getattr(load, "value", None), Like):
        if value.times is not None:
            ratio = ratio * arithmetic.given(value.times)
        load = by_name[value.load]
    return load.name, ratio, getattr(load, "parts", None) if value is None else value


def reacting(case: Case, load: L) -> str:
    """The link that takes the opposite of a load: the one it is against, or the frame."""
    return getattr(load, "against", None) or case.ground


def points_of(load: Load) -> tuple[str, ...]:
    """The points that a load's wrench needs."""
    if isinstance(load, Force) and isinstance(load.heading, AlongRope):
        return load.heading.rope.points
    if isinstance(load, Torque):
        return ()
    if isinstance(load, Spring):
        return (load.at, load.to)
    if isinstance(load, TorsionSpring):
        return load.corner
    toward: tuple[str, ...] = ()
    if isinstance(load, Force) and isinstance(load.heading, Toward):
        toward = (load.heading.point,)
    if isinstance(load, Force) and isinstance(load.over, Stretch):
        return (load.at, load.over.a, load.over.b, *toward)
    return (load.at, *toward)


def may_vanish(load: Load) -> bool:
    """Whether a load is nothing where its two points meet: a spring that is free at no length."""
    return isinstance(load, Spring) and load.free.value == 0.0


def line_of(load: Load) -> tuple[str, str] | None:
    """The two points that give a load its direction, where points do."""
    if isinstance(load, Spring):
        return (load.at, load.to)
    if isinstance(load, Force) and isinstance(load.heading, Toward):
        return (load.at, load.heading.point)
    return None


def _unit_wrench(load: Load, place: PlacedCase) -> tuple[Triple, Scalar]:
    case, frame, points, arithmetic = place
    match load:
        case Torque():
            sign = -1.0 if load.turns == "cw" else 1.0
            num, den, pi = case.units.exact_torque
            return (0.0, 0.0, sign), arithmetic.ratio((den, num, -pi))
        case Weight():
            gain: Scalar = 1.0
            if load.mass:
                gain = arithmetic.given(case.gravity) * arithmetic.ratio(case.units.exact_newton)
            return force_wrench((0.0, -1.0), points[load.at]), gain
        case Spring() if may_vanish(load) and at_one_place(points[load.at], points[load.to], arithmetic):
            return (0.0, 0.0, 0.0), 0.0
        case Spring():
            along, length = unit_between(points[load.at], points[load.to], arithmetic)
            stretch = length / frame.scale - arithmetic.given(load.free)
            return force_wrench(along, points[load.at]), stretch
        case ForceVector():
            size = vector_size(load.parts) or 1.0
            x, y = arithmetic.given(load.x) / size, arithmetic.given(load.y) / size
            return force_wrench((x, y), points[load.at]), 1.0
        case TorsionSpring():
            num, den, pi = case.units.exact_torque
            slack = arithmetic.given(load.free) - spring_angle(load, points, arithmetic)
            return (0.0, 0.0, 1.0), slack * arithmetic.ratio((den, 180 * num, 1 - pi))
        case Force(over=Area() as area):
            gain = arithmetic.ratio(area.per) * _size_of(area, arithmetic)
            return force_wrench(direction(load, points, arithmetic), points[load.at]), gain
        case Force(over=Stretch() as over):
            return _spread(load, over, place)
        case Force(heading=AlongRope(rope)):
            along = rope_screws.rope_parts(rope, points, frame.scale, arithmetic)[-1].along
            return force_wrench(along, points[load.at]), 1.0
        case Force():
            return force_wrench(direction(load, points, arithmetic), points[load.at]), 1.0
    raise TypeError(type(load).__name__)


def _size_of(area: Area, arithmetic: Arithmetic) -> Scalar:
    """The area itself, or what pi/4 makes it: the square of the bore less that of the rod."""
    if area.bore is None:
        assert area.area is not None
        return arithmetic.given(area.area)
    bore = arithmetic.given(area.bore)
    if area.rod is None:
        return bore * bore
    rod = arithmetic.given(area.rod)
    return (bore - rod) * (bore + rod)


def _spread(load: Force, over: Stretch, place: PlacedCase) -> tuple[Triple, Scalar]:
    """The wrench of a force per length: of two triangles, one for the number at each end.

    A triangle's resultant is half its length times its number, at a third of the length from its high end.
    """
    _, frame, points, arithmetic = place
    a, b = points[over.a], points[over.b]
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = arithmetic.sqrt(dx * dx + dy * dy) / frame.scale
    along, value = direction(load, points, arithmetic), load.value
    if over.end is None:
        return force_wrench(along, points[load.at]), length
    assert isinstance(value, Number)
    ratio = arithmetic.given(over.end) / arithmetic.given(value) if value.value else 0.0
    near = force_wrench(along, ((2.0 * a[0] + b[0]) / 3.0, (2.0 * a[1] + b[1]) / 3.0))
    far = force_wrench(along, ((a[0] + 2.0 * b[0]) / 3.0, (a[1] + 2.0 * b[1]) / 3.0))
    both, half = 1.0 + ratio, 0.5 * length
    unit = (near[0] + ratio * far[0], near[1] + ratio * far[1], near[2] + ratio * far[2])
    if _is_couple(load):
        return (0.0, 0.0, unit[2]), half
    return (unit[0] / both, unit[1] / both, unit[2] / both), half * both


def _is_couple(load: Load) -> bool:
    """Whether a load has no resultant force: a torque, a torsion spring, a line load that turns over."""
    if isinstance(load, Force) and isinstance(load.over, Stretch) and load.over.end is not None:
        return isinstance(load.value, Number) and load.value.value == -load.over.end.value
    return isinstance(load, Torque | TorsionSpring)


def place_of(load: Load, points: Points, arithmetic: Arithmetic = FLOATS) -> Point | None:
    """Where the resultant of a load acts, in the units of ``points``; None of a couple.

    Of a line load from q_a to q_b that is ``(q_a + 2 q_b) / (3 (q_a + q_b))`` of its length from a.
    """
    if isinstance(load, Torque | TorsionSpring) or _is_couple(load):
        return None
    over = load.over if isinstance(load, Force) else None
    if not isinstance(over, Stretch) or over.end is None or not isinstance(load, Force):
        return points[load.at]
    assert isinstance(load.value, Number)
    ratio = arithmetic.given(over.end) / arithmetic.given(load.value) if load.value.value else 0.0
    share = (1.0 + 2.0 * ratio) / (3.0 * (1.0 + ratio))
    (x, y), (u, v) = points[over.a], points[over.b]
    return x + share * (u - x), y + share * (v - y)


def spring_angle(load: TorsionSpring, points: Points, arithmetic: Arithmetic) -> Scalar:
    """The angle that a torsion spring follows, degrees: so that free - angle lies in (-180, 180] as written.

    In a motion it goes on from there, with whole turns.
    """
    *arm, at, end = (points[name] for name in load.corner)
    x, y = end[0] - at[0], end[1] - at[1]
    if arm:
        u, v = arm[0][0] - at[0], arm[0][1] - at[1]
        x, y = u * x + v * y, u * y - v * x
    counted = getattr(arithmetic, "turns", None)
    angle = counted(x, y, arithmetic.given(load.free)) if callable(counted) else arithmetic.angle(x, y)
    about = load.free.value if load.about is None else load.about
    whole = math.ceil((about - float(angle) - 180.0) / 360.0)
    return angle + 360.0 * whole if whole else angle


def direction(load: Force, points: Points, arithmetic: Arithmetic) -> Point:
    """Unit vector (cos, sin) along which a force acts; not of one along a rope."""
    heading = load.heading
    assert not isinstance(heading, AlongRope)
    if isinstance(heading, Toward):
        x, y = unit_between(points[load.at], points[heading.point], arithmetic)[0]
        return (-x, -y) if heading.away else (x, y)
    if isinstance(heading, Slope):
        run, rise = arithmetic.given(heading.run), arithmetic.given(heading.rise)
        return unit_between((0.0, 0.0), (run, rise), arithmetic)[0]
    return arithmetic.turn(heading)


def at_one_place(a: Point, b: Point, arithmetic: Arithmetic) -> bool:
    """Whether two points [frame] are one."""
    return all_vanish(arithmetic, ((q - p, 1.0 + magnitude(p)) for p, q in zip(a, b, strict=True)))


class PowerFactors(NamedTuple, Generic[L]):
    """Factors of every load for every motion, in the plane or in space.

    Attributes
    ----------
    wrenches : n loads
    factors : (motions, n), the power of a load per unit of its number, over its ``measure``
    sizes : (motions, n), what that would be summed from if its links moved as fast as the fastest, against
        which a zero is judged
    """

    wrenches: tuple[UnitWrench[L], ...]
    factors: tuple[tuple[Scalar, ...], ...]
    sizes: tuple[tuple[float, ...], ...]


Balance = PowerFactors[Load]
"""Of a case in the plane."""


def balance(
    all_wrenches: Sequence[UnitWrench[L]], twists: Mapping[str, Sequence[tuple[Scalar, ...]]], motions: int
) -> PowerFactors[L]:
    """Factors of the loads on the twists of their links.

    Parameters
    ----------
    all_wrenches : as of `wrenches`
    twists : by link, ``motions`` twists (3,) or (6,) relative to the frame [frame length/s, rad/s]
    motions : number of freedoms
    """
    factors, sizes = [], []
    for m in range(motions):
        row, scale = [], []
        fastest = largest([x for ts in twists.values() for x in ts[m]])
        for load, against, unit, gain, _, _, _, _, reach in all_wrenches:
            relative = map(sub, twists[load.link][m], twists[against][m])
            row.append(gain * reduce(add, map(mul, unit, relative)))
            scale.append(reach * sum_of_sizes(unit) * fastest)
        factors.append(tuple(row))
        sizes.append(tuple(scale))
    return PowerFactors(tuple(all_wrenches), tuple(factors), tuple(sizes))


class Solution(NamedTuple):
    """Values of the unknown loads, or why there are none.

    Attributes
    ----------
    verdict : ``balanced``; ``no value`` / ``any value`` (an unknown does no work; the known loads do, do
        not), ``too few unknowns`` or ``too many unknowns``
    values : by name [case units]; what vanishes is the zero of its arithmetic (`zero_of`)
    idle : the motions in which no load does work
    culprit : of ``no value`` and the like, the load that it is about
    """

    verdict: str
    values: dict[str, Scalar]
    idle: tuple[int, ...] = ()
    culprit: str = ""


class PowerRow(NamedTuple):
    """The equation of power of a motion: of each unknown, then of the known loads together.

    Attributes
    ----------
    values : the factor of each unknown, and the power of the known loads [scaled]
    sizes : what these are summed from
    zero : the places of those that are zero
    """

    values: list[Scalar]
    sizes: list[float]
    zero: set[int]


def solve_balance(b: Balance, arithmetic: Arithmetic) -> Solution:
    """The unknown loads from the sums of power of all motions (principle of virtual power).

    In equilibrium the power of all loads is zero in every motion: as many linear equations as freedoms.

    Returns
    -------
    Solution
        With a verdict in the place of values where they are not determined.

    Raises
    ------
    SceneError
        ``near-singular`` where the equations can't be told from dependent ones.
    MoreDigits
        Of balls, where a zero is open.
    """
    unknown, scale, rows = power_rows(b, arithmetic)
    idle = tuple([m for m, row in enumerate(rows) if len(row.zero) > len(unknown)])
    working = [row for m, row in enumerate(rows) if m not in idle]
    if (len(working), len(unknown)) != (1, 1):
        return _solved_many(working, unknown, scale, idle, arithmetic)
    (factor, known), root = working[0].values, unknown[0].root
    if 0 in working[0].zero:
        return Solution("no value", {}, idle, root)
    return Solution("balanced", {root: -known / factor / scale / unknown[0].measure}, idle)


def unknown_loads(b: PowerFactors[L]) -> list[UnitWrench[L]]:
    """The loads whose own number is to find."""
    return [w for w in b.wrenches if w.number is None and w.root == w.load.name]


def power_rows(
    b: PowerFactors[L], arithmetic: Arithmetic
) -> tuple[list[UnitWrench[L]], float, list[PowerRow]]:
    """The unknown loads, `force_scale`, and the equation of power of every motion, in the unknown loads over
    their ``measure``, all times that scale."""
    unknown, scale = unknown_loads(b), force_scale(b)
    place = {w.root: k for k, w in enumerate(unknown)}
    shares = []
    for w in b.wrenches:
        k = place.get(w.root)
        if k is None:
            shares.append((len(unknown), _known(w, scale, arithmetic)))
        else:
            shares.append((k, w.ratio * (w.measure / unknown[k].measure)))
    both = zip(b.factors, b.sizes, strict=True)
    rows = [_row(shares, factors, sizes, len(unknown) + 1, arithmetic) for factors, sizes in both]
    return unknown, scale, rows


def is_unknown(load: Load | SpatialLoad) -> bool:
    """Whether a load's own number is to find; what is given by components has none."""
    return getattr(load, "value", 0.0) is None


def has_number(load: Load) -> bool:
    """Whether a load's own number is known, and not zero."""
    if isinstance(load, ForceVector):
        return vector_size(load.parts) > 0.0
    return load.value is not None and not isinstance(load.value, Like) and load.value.value != 0.0


def friction_of(joint: Joint) -> Friction | None:
    """A joint's friction, where its coefficient is not zero."""
    friction = joint.friction
    return friction if friction is not None and friction.mu.value > 0.0 else None


def has_friction(case: Case) -> bool:
    """Whether a joint, a rope or a screw has friction."""
    ropes = any(rope.slips for rope in case.ropes) or any(screw.rubs for screw in case.screws)
    return ropes or any(friction_of(joint) is not None for joint in case.joints)


def force_scale(b: PowerFactors[L]) -> float:
    """A power of two that brings the largest known load near 1, so that nothing overflows."""
    most = 0.0
    for _, _, _, gain, _, _, measure, number, _ in b.wrenches:
        if number:
            value = number.value if isinstance(number, Number) else vector_size(number)
            most = max(most, abs(value) * abs(gain) * measure)
    return math.ldexp(1.0, -math.frexp(most)[1]) if 0.0 < most < math.inf else 1.0


def vector_size(parts: Sequence[Number]) -> float:
    """Magnitude of a force or torque that is given by its components."""
    return math.hypot(*(part.value for part in parts))


def known_value(w: UnitWrench[L]) -> float | None:
    """The number of a load in its own case unit; None where it hangs on an unknown."""
    return number_of(w, FLOATS) if w.number else None


def _known(w: UnitWrench[L], scale: float, arithmetic: Arithmetic) -> Scalar:
    """The number of a known load, scaled."""
    return number_of(w, arithmetic) * scale * w.measure * w.ratio


def number_of(w: UnitWrench[L], arithmetic: Arithmetic) -> Scalar:
    """The number of a known load in its own unit; 0 of one that hangs on an unknown."""
    number = w.number
    if isinstance(number, Number):
        return arithmetic.given(number)
    return vector_size(number) if number else 0.0


def load_value(w: UnitWrench[L], values: Mapping[str, Scalar], a: Arithmetic) -> Scalar:
    """The number of a load, known or found (``values``, by the load that has it), in its own unit."""
    return w.ratio * (values[w.root] if w.root in values else number_of(w, a))


def advantage(wrenches: Sequence[UnitWrench[L]], values: Mapping[str, Scalar], a: Showing) -> float | None:
    """unknown / known where there is one of each and the known one is not zero."""
    if len(wrenches) != 2 or (wrenches[0].root in values) == (wrenches[1].root in values):
        return None
    ours, known = wrenches if wrenches[0].root in values else wrenches[::-1]
    above, below = load_value(ours, values, a), load_value(known, values, a)
    return None if below == 0.0 else a.rounded(above / below)[0]


def _row(
    shares: Sequence[tuple[int, Scalar]],
    factors: Sequence[Scalar],
    sizes: Sequence[float],
    columns: int,
    arithmetic: Arithmetic,
) -> PowerRow:
    """The equation of power of one motion, the known loads scaled."""
    sums: list[Scalar] = [0.0] * columns
    terms = [0.0] * columns
    for (k, amount), factor, size in zip(shares, factors, sizes, strict=True):
        sums[k] = sums[k] + amount * factor
        terms[k] += abs(amount) * size
    zero = {k for k, size in enumerate(terms) if arithmetic.vanishes(sums[k], size)}
    for k in zero:
        sums[k] = zero_of(sums[k])
    return PowerRow(sums, terms, zero)


def _solved_many(
    powers: Sequence[PowerRow],
    unknown: Sequence[UnitWrench[L]],
    scale: float,
    idle: tuple[int, ...],
    arithmetic: Arithmetic,
) -> Solution:
    roots = [w.root for w in unknown]
    # over powers of two that bring their largest entries near 1
    sizes = [math.ldexp(1.0, math.frexp(max(map(abs, row.values)))[1]) for row in powers]
    count, rows = len(roots), [[v / s for v in row.values] for row, s in zip(powers, sizes, strict=True)]
    free = linear.null_space([row[:count] for row in rows], count, 1e-13, vanishes=decider(arithmetic))
    whole = linear.null_space(rows, count + 1, 1e-13, vanishes=decider(arithmetic))
    if whole.rank > free.rank:
        verdict = "no value" if free.rank < count and len(rows) <= count else "too few unknowns"
        return Solution(verdict, {}, idle, _workless(powers, roots))
    if free.rank < count:
        verdict = "too many unknowns" if count > len(rows) + len(idle) else "any value"
        return Solution(verdict, {}, idle, _workless(powers, roots))
    if not whole.basis or not roots:
        return Solution("balanced", dict.fromkeys(roots, 0.0), idle)
    vector = whole.basis[0]
    if abs(vector[-1]) == 0.0:
        raise SceneError(
            Status.NEAR_SINGULAR, "the equations of power of the motions can't be told from dependent ones"
        )
    most = max(map(abs, vector))
    values: dict[str, Scalar] = {}
    for k, w in enumerate(unknown):
        zero = arithmetic.vanishes(vector[k], most)
        value = vector[k] / (vector[-1] * scale * w.measure)
        values[w.root] = zero_of(value) if zero else value
    return Solution("balanced", values, idle)


def _workless(rows: Sequence[PowerRow], roots: Sequence[str]) -> str:
    """The first unknown that does no work in any motion, if there is one; else the first."""
    idle = (root for k, root in enumerate(roots) if all(k in row.zero for row in rows))
    return next(idle, roots[0] if roots else "")


def known_power(b: Balance, m: int, arithmetic: Arithmetic) -> Scalar:
    """The power of the known loads in motion m [force units times frame length, a unit of the motion], times
    `force_scale`.
    """
    scale = force_scale(b)
    total: Scalar = 0.0
    for w, factor in zip(b.wrenches, b.factors[m], strict=True):
        if w.number:
            total = total + _known(w, scale, arithmetic) * factor
    return total


class Outcome(NamedTuple):
    """A scene in one arithmetic: its place, motions, the sum of power and what it gives."""

    place: PlacedCase
    motions: Motions
    balance: Balance
    solution: Solution

    @property
    def points(self) -> Points:
        """By name [frame]."""
        return self.place.points


class Value(NamedTuple):
    """An unknown load and the bound on its error; None with the reason where none is proven."""

    value: float
    error: float | None
    why: str = ""


class Bounded(NamedTuple):
    """A scene evaluated on a tape: its values carry their derivatives, and bounds of first order."""

    outcome: Outcome
    tape: Tape

    def of(self, value: Scalar) -> float:
        """Bound on the absolute error of a value on the tape."""
        return self.tape.bound(value)
