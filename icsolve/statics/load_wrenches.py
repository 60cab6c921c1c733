"""The wrench of every load per unit of its number, in the plane: where and along what it acts.

A load is a number times a unit wrench: of a spring its stiffness times its stretch, of a pressure its number
times an area, of a force per length the resultant of two triangles. Inertia forces are loads too: the
wrenches -m a and -I alpha, in any arithmetic.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from icsolve.assembly.workspace import PlacedCase
from icsolve.case import (
    AlongRope,
    Area,
    Case,
    Force,
    ForceVector,
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
from icsolve.case.loads import name_of_inertia
from icsolve.numbers import FLOATS, HALF_TURN, Arithmetic, Scalar, all_vanish, magnitude
from icsolve.numbers.units import exact_ratio, parse_unit
from icsolve.screws import Point, Triple, force_wrench, unit_between
from icsolve.tuples import Generic, LateModule, NamedTuple, TypeVar, replace

if TYPE_CHECKING:
    from icsolve.case.space import Load as SpatialLoad  # noqa: F401  of a bound
    from icsolve.kinematics import accelerations
    from icsolve.screws import ropes as rope_screws
else:
    accelerations = LateModule("icsolve.kinematics.accelerations")
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
        measure = frame.scale if isinstance(load, (Torque, TorsionSpring)) else 1.0
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


def number_of(w: UnitWrench[L], arithmetic: Arithmetic) -> Scalar:
    """The number of a known load in its own unit; 0 of one that hangs on an unknown."""
    number = w.number
    if isinstance(number, Number):
        return arithmetic.given(number)
    return vector_size(number) if number else 0.0


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


def moving_links(case: Case) -> set[str]:
    """The links whose twists the sum of power needs: those that loads act on or between, those whose motion
    is given, and the frame, by which that is told."""
    links = {link for load in case.loads for link in (load.link, reacting(case, load))}
    return links | {case.ground, *(given.link for given in case.motion)}


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


def corner_vector(load: TorsionSpring, points: Points) -> tuple[Scalar, Scalar]:
    """A vector whose direction is the angle that a torsion spring follows."""
    *arm, at, end = (points[name] for name in load.corner)
    x, y = end[0] - at[0], end[1] - at[1]
    if not arm:
        return x, y
    u, v = arm[0][0] - at[0], arm[0][1] - at[1]
    return u * x + v * y, u * y - v * x


def spring_angle(load: TorsionSpring, points: Points, arithmetic: Arithmetic) -> Scalar:
    """The angle that a torsion spring follows, degrees: so that free - angle lies in (-180, 180] as written.

    In a motion it goes on from there, with whole turns.
    """
    x, y = corner_vector(load, points)
    counted, about = getattr(arithmetic, "turns", None), load.free.value if load.about is None else load.about
    angle, free, wound = arithmetic.angle(x, y), arithmetic.given(load.free), None
    if callable(counted):
        angle = counted(x, y, free if load.about is None else about)
        if not getattr(arithmetic, "follows", True):  # in every row within half a turn
            return angle
        if not isinstance(free, float):  # it varies: in every row as if written so
            wound = 360.0 * getattr(arithmetic, "nearest", round)((free - about) / 360.0 - HALF_TURN)
    whole = math.ceil((about - float(angle) - 180.0) / 360.0 - HALF_TURN)
    angle = angle + 360.0 * whole if whole else angle
    return angle if wound is None else angle + wound


def counted_about(case: Case, angles: Mapping[str, float]) -> Case:
    """The case with its torsion springs' turns counted about angles, by load [degrees]."""
    if not angles:
        return case
    loads = [
        load._replace(about=angles[load.name])
        if isinstance(load, TorsionSpring) and load.name in angles
        else load
        for load in case.loads
    ]
    return replace(case, loads=tuple(loads))


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


def vector_size(parts: Sequence[Number]) -> float:
    """Magnitude of a force or torque that is given by its components."""
    return math.hypot(*(part.value for part in parts))


# --- inertia forces ------------------------------------------------------------------------------------


FORCE = "inertia force {}"

COUPLE = "inertia couple {}"
"""Names of the loads, by link."""


def is_loaded(case: Case) -> bool:
    """Whether the inertia forces are among the loads of a case."""
    return any(name_of_inertia(load.name) for load in case.loads)


def as_given(case: Case) -> Case:
    """The case without inertia forces among its loads: what other positions are solved from."""
    loads = tuple(load for load in case.loads if not name_of_inertia(load.name))
    return case if loads == case.loads else replace(case, loads=loads)


def as_posed(case: Case) -> Case:
    """The case as it asks for its inertia forces, where they are among its loads."""
    return replace(as_given(case), dynamic=True) if is_loaded(case) else case


def inertia_of_one(case: Case) -> Iterator[Load]:
    """The inertia forces of a case as loads of the number one, whose wrenches `exactly` tells."""
    one = Number(1.0, 0.0, "", "1")
    for link, inertia in case.inertia.items():
        if inertia.mass is not None and inertia.centre is not None:
            zero = one._replace(value=0.0, digits="0")
            yield ForceVector(FORCE.format(link), link, inertia.centre, one, zero)
        if inertia.moment is not None:
            yield Torque(COUPLE.format(link), link, one)


def exactly(place: PlacedCase, moves: accelerations.Moving, wrenches: Sequence[Wrench]) -> tuple[Wrench, ...]:
    """The wrenches with those of the inertia forces as this arithmetic has them; the loads are rounded.

    D'Alembert's principle: ``-m a`` at the centre of mass and the couple ``-I alpha``, in case units.
    """
    forces = inertia_forces(place, moves)
    found = []
    for w in wrenches:
        if not name_of_inertia(w.load.name):
            found.append(w)
            continue
        _, force, couple = forces[w.load.link]
        size = number_of(w, place.arithmetic) or 1.0
        if isinstance(w.load, ForceVector):
            assert force is not None
            unit = force_wrench((force[0] / size, force[1] / size), place.points[w.load.at])
        else:
            assert couple is not None
            unit = (0.0, 0.0, couple / size)
        found.append(w._replace(unit=unit))
    return tuple(found)


InertiaForce = tuple[str | None, Point | None, Scalar | None]
"""Of a link its centre of mass, the force there and the couple, in case units."""


def inertia_forces(place: PlacedCase, moves: accelerations.Moving) -> dict[str, InertiaForce]:
    """-m a and -I alpha of every link that has a mass."""
    case, frame, points, arithmetic = place
    newton = arithmetic.ratio(case.units.exact_newton)
    metre = arithmetic.ratio(exact_ratio(parse_unit("m"), parse_unit(case.units.length)))
    found: dict[str, InertiaForce] = {}
    for link, inertia in case.inertia.items():
        force: Point | None = None
        couple: Scalar | None = None
        if inertia.mass is not None and inertia.centre is not None:
            per = arithmetic.given(inertia.mass) * newton / (metre * frame.scale)
            x, y = moves.acceleration(link, points[inertia.centre])
            force = (0.0 - per * x, 0.0 - per * y)
        if inertia.moment is not None:
            moment = arithmetic.given(inertia.moment) * newton * metre
            couple = 0.0 - moment * arithmetic.ratio(case.units.exact_torque) * moves.rates[link][2]
        found[link] = (inertia.centre, force, couple)
    return found
