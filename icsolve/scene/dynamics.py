"""Inertia forces of the given motion among the loads: d'Alembert's way.

The accelerations come from the second derivative of the closure, in as many digits as settle them; the
forces -m a at the centres of mass and the couples -I alpha are then loads of a case like any other, so power,
free bodies, friction and pictures treat them as they treat all loads.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from icsolve.answer import Answer, Deferred, Later
from icsolve.assembly.workspace import PlacedCase
from icsolve.case import Case, ForceVector, Load, Torque, is_named, told_links
from icsolve.errors import SceneError, Status
from icsolve.kinematics.accelerations import Moving, moving
from icsolve.kinematics.speeds import OPEN, moving_points
from icsolve.numbers import Scalar, Showing
from icsolve.numbers.units import Number
from icsolve.scene.needed_part import by_needed_part
from icsolve.scene.program import EvaluatedScene, Evaluation, Want, prepare
from icsolve.statics.load_wrenches import COUPLE, FORCE, as_given, inertia_forces, inertia_of_one
from icsolve.statics.power import is_unknown
from icsolve.tuples import NamedTuple, replace
from icsolve.wording import listed

TOO_FAST = (
    "a force of inertia in this motion is beyond any number: give the motion a smaller speed, or the figure "
    "smaller coordinates."
)


class Accelerations(NamedTuple):
    """Of links [rad/s^2] and of points on links [case length/s^2]; a sentence where one is open. ``errors``
    has bounds of both."""

    links: dict[str, float | str]
    points: dict[tuple[str, str], tuple[float, float] | str]
    errors: dict[str, Mapping[Any, Any]]


def solve_dynamic(case: Case, solve: Callable[..., Answer], **options: bool) -> Answer:
    """The answer of a case with the inertia forces of its motion, by `icsolve.solve` with these options.

    Raises SceneError as that does, and where the motion or an acceleration is open.
    """
    loaded, found, notes = with_inertia(case)
    answer = solve(loaded, **options)
    return replace(
        answer,
        advantage=None,
        accelerations=found.points,
        angular_accelerations=found.links,
        errors={**answer.errors, **found.errors},
        notes=Later(lambda: (*answer.notes, *notes)),
        sensitivities=Deferred(lambda: _slopes(loaded, solve)),
    )


def with_inertia(case: Case) -> tuple[Case, Accelerations, tuple[str, ...]]:
    """The case with its inertia forces as loads, the accelerations, and notes.

    Raises SceneError where the motion is not given with its speed, or leaves a link with a mass open.
    """
    case = replace(case, dynamic=True)
    try:
        (loaded, found, notes), left_out = by_needed_part(case, _loaded, bodies=True)
    except OverflowError:
        raise SceneError(Status.UNSUPPORTED, TOO_FAST) from None
    except SceneError as refusal:
        if refusal.status != Status.STRUCTURE or any(map(is_unknown, case.loads)):
            raise
        raise SceneError(Status.STRUCTURE, STILL) from None
    return loaded, found, (*notes, left_out) if left_out else notes


def _loaded(case: Case) -> tuple[Case, Accelerations, tuple[str, ...]]:
    """The same where all links have a place."""
    return EvaluatedScene(prepare(case, Want(bodies=True)), True).ask(partial(_found, case))


STILL = (
    "the links form a structure: nothing moves, and there are no inertia forces. Without `--dynamic` and "
    "`dynamic: yes` its reactions are found by statics."
)


def _found(case: Case, found: Evaluation) -> tuple[Case, Accelerations, tuple[str, ...]]:
    """The same from an evaluated scene; raises MoreDigits where its digits leave something open."""
    _, outcome, arithmetic = found
    place = outcome.place
    moves = moving(place, outcome.motions.twists, outcome.motions.slack)
    _refuse_open(case, moves)

    def number(value: Scalar, path: str) -> Number:
        near = _rounded(value, arithmetic, moves.size)
        if not math.isfinite(near):
            raise OverflowError
        return Number(near, 0.0, path, repr(near))

    loads: list[Load] = []
    for link, (centre, force, couple) in inertia_forces(place, moves).items():
        path = f"inertia.{link}"
        if force is not None and centre is not None:
            x, y = (number(part, f"{path}.{axis}") for part, axis in zip(force, "xy", strict=True))
            loads.append(ForceVector(FORCE.format(link), link, centre, x, y))
        if couple is not None:
            loads.append(Torque(COUPLE.format(link), link, number(couple, f"{path}.couple")))
    loaded = replace(case, loads=(*case.loads, *loads), dynamic=bool(loads))
    return loaded, _shown(place, moves, arithmetic), _notes(case, moves, arithmetic)


def _slopes(loaded: Case, solve: Callable[..., Answer]) -> Mapping[str, Mapping[str, float]]:
    """Slopes of the unknown loads, inertia forces included.

    On a tape these stand in the wrenches, a number times as large (`load_wrenches.exactly`). With a
    number of one what is zero has its slopes too.
    """
    loads = (*as_given(loaded).loads, *inertia_of_one(loaded))
    found = solve(replace(loaded, loads=loads)).sensitivities
    return {load: {path: slope for path, slope in by.items() if path} for load, by in found.items()}


def _refuse_open(case: Case, moves: Moving) -> None:
    heavy = [link for link in case.inertia if link in moves.open]
    if heavy:
        raise SceneError(
            Status.MOBILITY,
            f"the motion of link {listed(heavy)}, which has a mass, is open: {OPEN} Give its motion too.",
        )


def _shown(place: PlacedCase, moves: Moving, arithmetic: Showing) -> Accelerations:
    """Accelerations of every link and of every point on the links that carry it."""
    (case, (_, _, scale), points, _), size = place, moves.size
    links: dict[str, float | str] = {}
    places: dict[tuple[str, str], tuple[float, float] | str] = {}
    off_links: dict[str, float] = {}
    off_places: dict[tuple[str, str], tuple[float, float]] = {}
    for link in told_links(case):
        if link in moves.open:
            links[link] = f"the acceleration of link {link} is left open: {OPEN}"
        else:
            links[link], off_links[link] = arithmetic.rounded(moves.rates[link][2], size)
        for name in moving_points(case, link):
            if not is_named(name) or name not in points:
                continue
            if link in moves.open:
                places[name, link] = f"the acceleration of {name} on link {link} is left open: {OPEN}"
            else:
                both = (arithmetic.rounded(a / scale, size) for a in moves.acceleration(link, points[name]))
                (x, off_x), (y, off_y) = both
                places[name, link], off_places[name, link] = (x, y), (off_x, off_y)
    return Accelerations(links, places, {"accelerations": off_places, "angular_accelerations": off_links})


def _rounded(value: Scalar, arithmetic: Showing, size: float) -> float:
    """The nearest double; ``size`` is that of what it is summed from."""
    return arithmetic.rounded(value, size)[0]


def _notes(case: Case, moves: Moving, arithmetic: Showing) -> tuple[str, ...]:
    """What a reader should know of the masses."""
    if not case.inertia:
        return ("no link has a mass, so there are no inertia forces: give masses under `links`.",)
    points = [link for link, inertia in case.inertia.items() if inertia.moment is None]
    turning = [link for link in points if _rounded(moves.rates[link][2], arithmetic, moves.size) != 0.0]
    if not turning:
        return ()
    return (f"link {listed(turning)} turns and has no `inertia`: its mass counts as one point.",)
