"""Inertia forces as loads: the wrenches -m a and -I alpha in any arithmetic."""

from __future__ import annotations

from collections.abc import Sequence

from icsolve.assembly.workspace import PlacedCase
from icsolve.case import Case, ForceVector, Torque
from icsolve.kinematics.accelerations import Moving, moving
from icsolve.kinematics.motion import Motions
from icsolve.numbers.arithmetic import Scalar
from icsolve.numbers.units import exact_ratio, parse_unit
from icsolve.screws.plane import Point, force_wrench
from icsolve.statics.load_wrenches import Wrench
from icsolve.statics.power import number_of
from icsolve.tuples import replace

FORCE = "inertia force {}"

COUPLE = "inertia couple {}"
"""Names of the loads, by link; a load of the file has no blank in its name."""


def is_loaded(case: Case) -> bool:
    """Whether the inertia forces are among the loads of a case."""
    return any(load.name.startswith("inertia ") for load in case.loads)


def as_given(case: Case) -> Case:
    """The case without inertia forces among its loads: what other positions are solved from."""
    loads = tuple(load for load in case.loads if not load.name.startswith("inertia "))
    return case if loads == case.loads else replace(case, loads=loads)


def as_posed(case: Case) -> Case:
    """The case as it asks for its inertia forces, where they are among its loads."""
    return replace(as_given(case), dynamic=True) if is_loaded(case) else case


def exactly(place: PlacedCase, motions: Motions, wrenches: Sequence[Wrench]) -> tuple[Wrench, ...]:
    """The wrenches with those of the inertia forces as this arithmetic has them; the loads are rounded.

    D'Alembert's principle: ``-m a`` at the centre of mass and the couple ``-I alpha``, in case units.

    Raises
    ------
    SceneError
        As `icsolve.kinematics.accelerations.moving`.
    """
    forces = inertia_forces(place, moving(place, motions.twists, motions.slack))
    found = []
    for w in wrenches:
        load = w.load
        if load.name == FORCE.format(load.link) and isinstance(load, ForceVector):
            _, force, _ = forces[load.link]
            assert force is not None
            size = number_of(w, place.arithmetic) or 1.0
            found.append(
                w._replace(unit=force_wrench((force[0] / size, force[1] / size), place.points[load.at]))
            )
        elif load.name == COUPLE.format(load.link) and isinstance(load, Torque):
            couple = forces[load.link][2]
            assert couple is not None
            size = number_of(w, place.arithmetic) or 1.0
            found.append(w._replace(unit=(0.0, 0.0, couple / size)))
        else:
            found.append(w)
    return tuple(found)


InertiaForce = tuple[str | None, Point | None, Scalar | None]
"""Of a link its centre of mass, the force there and the couple, in case units."""


def inertia_forces(place: PlacedCase, moves: Moving) -> dict[str, InertiaForce]:
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
