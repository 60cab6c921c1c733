"""Inertia forces of the given motion among the loads: d'Alembert's way.

The accelerations come from the second derivative of the closure, in fifty digits; the forces -m a at the
centres of mass and the couples -I alpha are then loads of a case like any other, so power, free bodies,
friction and pictures treat them as they treat all loads.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

from icsolve.answer import Answer, Deferred
from icsolve.case import Case, ForceVector, Inertia, Load, Torque
from icsolve.errors import SceneError, Status
from icsolve.kinematics.accelerations import NO_SPEED, Moving, moving
from icsolve.kinematics.speeds import OPEN, moving_points
from icsolve.numbers.arithmetic import Arithmetic, Scalar
from icsolve.numbers.given import Number
from icsolve.screws.plane import Point
from icsolve.solve.program import Program, Want, evaluate, prepare
from icsolve.wording.sentences import listed

FORCE = "inertia force {}"
COUPLE = "inertia couple {}"
"""Names of the loads, by link; a load of the file has no blank in its name."""


class Accelerations(NamedTuple):
    """Of links [rad/s^2] and of points on links [case length/s^2]; a sentence where one is open."""

    links: dict[str, float | str]
    points: dict[tuple[str, str], tuple[float, float] | str]


def with_inertia(case: Case) -> tuple[Case, Accelerations, tuple[str, ...]]:
    """The case with its inertia forces as loads, the accelerations, and notes.

    Raises SceneError where the motion is not given with its speed, or leaves a link with a mass open.
    """
    from icsolve.numbers.decimals import Digits

    if any(given.speed is None for given in case.motion) or not case.motion:
        raise SceneError(Status.MOBILITY, NO_SPEED)
    arithmetic = Digits()
    program = prepare(case, Want(rates=True, bodies=True))
    program, outcome = evaluate(program, arithmetic)
    twists = outcome.motions.twists
    moves = moving(case, program.top, program.figure.frame, outcome.points, twists, arithmetic)
    _refuse_open(case, moves)
    loads = [
        load
        for link, inertia in case.inertia.items()
        for load in _loads(case, program, moves, outcome.points[inertia.centre], link, inertia, arithmetic)
    ]
    shown = _shown(case, program, moves, outcome.points)
    return replace(case, loads=(*case.loads, *loads), dynamic=False), shown, _notes(case, moves)


def dynamic(answer: Answer, found: Accelerations, notes: tuple[str, ...]) -> Answer:
    """The answer of a case whose loads include the inertia forces, with its accelerations."""
    return replace(
        answer,
        accelerations=found.points,
        angular_accelerations=found.links,
        notes=(*answer.notes, *notes),
        sensitivities=Deferred(_no_sensitivities),
    )


def _no_sensitivities() -> Mapping[str, Mapping[str, float]]:
    message = "sensitivities and tolerance bands are not worked out where inertia forces are among the loads."
    raise SceneError(Status.UNSUPPORTED, message)


def _refuse_open(case: Case, moves: Moving) -> None:
    heavy = [link for link in case.inertia if link in moves.open]
    if heavy:
        raise SceneError(
            Status.MOBILITY,
            f"the motion of link {listed(heavy)}, which has a mass, is left open: {OPEN} Give its `motion` too.",
        )


def _loads(
    case: Case,
    program: Program,
    moves: Moving,
    centre: Point,
    link: str,
    inertia: Inertia,
    arithmetic: Arithmetic,
) -> tuple[Load, ...]:
    """The inertia force and couple of a link, in case units."""
    units, scale = case.units, program.figure.frame.scale
    mass = arithmetic.given(inertia.mass)
    per = units.force_per_newton / (scale * units.length_per_metre)
    x, y = (_number(0.0 - mass * a * per, f"inertia.{link}.{axis}") for a, axis in zip(
        moves.acceleration(link, centre), "xy", strict=True
    ))
    force = ForceVector(FORCE.format(link), link, inertia.centre, x, y)
    if inertia.moment is None:
        return (force,)
    moment = arithmetic.given(inertia.moment)
    gain = units.force_per_newton * units.length_per_metre * units.torque_per_force_length
    couple = _number(0.0 - moment * moves.rates[link][2] * gain, f"inertia.{link}.couple")
    return force, Torque(COUPLE.format(link), link, couple)


def _number(value: Scalar, path: str) -> Number:
    """A number with all the digits that it was found with."""
    digits = str(value.value) if hasattr(value, "value") else repr(float(value))
    return Number(float(value) + 0.0, 0.0, path, digits)


def _shown(case: Case, program: Program, moves: Moving, points: Mapping[str, Point]) -> Accelerations:
    """Accelerations of every link and of every point on the links that carry it."""
    scale = program.figure.frame.scale
    links: dict[str, float | str] = {}
    places: dict[tuple[str, str], tuple[float, float] | str] = {}
    for link in case.links:
        if link in moves.open:
            links[link] = f"the acceleration of link {link} is left open: {OPEN}"
        else:
            links[link] = float(moves.rates[link][2]) + 0.0
        for name in moving_points(case, link):
            if name.startswith("@") or name not in points:
                continue
            if link in moves.open:
                places[name, link] = f"the acceleration of {name} on link {link} is left open: {OPEN}"
            else:
                x, y = moves.acceleration(link, points[name])
                places[name, link] = (float(x / scale) + 0.0, float(y / scale) + 0.0)
    return Accelerations(links, places)


def _notes(case: Case, moves: Moving) -> tuple[str, ...]:
    """What a reader should know of the masses."""
    if not case.inertia:
        return ("no link has a mass, so there are no inertia forces: give masses under `links`.",)
    turning = [q for q, one in case.inertia.items() if one.moment is None and float(moves.rates[q][2]) != 0.0]
    if not turning:
        return ()
    return (f"link {listed(turning)} turns and has no `inertia`: its mass counts as one point.",)
