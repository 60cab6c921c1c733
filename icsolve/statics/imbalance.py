"""A mechanism without an unknown load: its known loads hold it still, or what they do is named."""

from __future__ import annotations

import math
from collections.abc import Sequence

from icsolve.case import ForceVector, Number
from icsolve.errors import SceneError, Status
from icsolve.kinematics.speeds import joint_order
from icsolve.screws.plane import velocity
from icsolve.statics.power import Balance, Wrench, known_value
from icsolve.statics.rubs import has_friction
from icsolve.statics.ties import Position
from icsolve.wording.sentences import listed

ROUNDED = 1e-9
"""Power of this fraction of the largest term is rounding, where all numbers are exact."""
NOISE = 1e-13
"""A power below this fraction of the products that it is summed from is none."""


def refuse_imbalance(position: Position, balance: Balance) -> tuple[str, ...]:
    """Refuse reactions of known loads that do not balance; the notes on what their decimals leave open.

    What half a unit of the last decimals may be the cause of is no refusal: it is said. With friction nothing
    says how much of it acts, unless a load is unknown.
    """
    notes = []
    if has_friction(position.case):
        raise SceneError(
            Status.UNBALANCED,
            "with friction, and no unknown load, nothing says how much of the friction acts: make one load "
            "`unknown`, or take out `mu`.",
        )
    for motion, factors in enumerate(balance.factors):
        powers = [_power(w, float(f)) for w, f in zip(balance.wrenches, factors, strict=True)]
        room = sum(_room(w, float(f)) for w, f in zip(balance.wrenches, factors, strict=True))
        sizes = [_power(w, size) for w, size in zip(balance.wrenches, balance.sizes[motion], strict=True)]
        rounding = ROUNDED * max(map(abs, powers), default=0.0) + NOISE * sum(map(abs, sizes))
        if abs(sum(powers)) > room + rounding:
            raise SceneError(Status.UNBALANCED, _named(position, balance, motion, powers))
        if abs(sum(powers)) > rounding:
            notes.append(_within_decimals(position, balance, motion, powers))
    return tuple(notes)


def _power(w: Wrench, factor: float) -> float:
    return (known_value(w) or 0.0) * float(w.ratio) * factor * w.measure


def _room(w: Wrench, factor: float) -> float:
    """Power of half a unit of the last decimal of a load's number."""
    source = w.source
    if isinstance(source, ForceVector):
        half = max(source.x.half, source.y.half)
    else:
        half = source.value.half if isinstance(source.value, Number) else 0.0
    return abs(half * float(w.ratio) * factor * w.measure)


def _named(position: Position, balance: Balance, motion: int, powers: Sequence[float]) -> str:
    """What the loads leave on which link, and what would mend it."""
    return (
        f"the known loads do not balance: {_leave(position, balance, motion, powers)}, so there are no "
        "reactions at rest. Make one of the loads `unknown`, or add one."
    )


def _within_decimals(position: Position, balance: Balance, motion: int, powers: Sequence[float]) -> str:
    """What the loads leave, where the decimals that they are written with may be the cause."""
    return (
        f"{_leave(position, balance, motion, powers)}, which is within half a unit of the last decimals: "
        "the reactions are given without it. To balance the loads, make one of them `unknown`."
    )


def _leave(position: Position, balance: Balance, motion: int, powers: Sequence[float]) -> str:
    working = [w.load.name for w, power in zip(balance.wrenches, powers, strict=True) if power]
    verb = "leaves" if len(working) == 1 else "leave"
    return f"{listed(working)} {verb} {_left(position, motion, sum(powers))}"


def _left(position: Position, motion: int, drive: float) -> str:
    """The power that is left, as a torque on a link that turns or a force along a link's motion."""
    link, rate = _first_turning(position, motion)
    units = position.case.units
    if rate:
        torque = drive / rate / position.scale * units.torque_per_force_length
        return f"{abs(torque):.6g} {units.torque} {'ccw' if torque > 0.0 else 'cw'} on link {link}"
    x, y = velocity(position.twists[link][motion], (0.0, 0.0))
    force = drive / math.hypot(x, y)
    toward = math.degrees(math.atan2(y * force, x * force)) % 360.0
    return f"{abs(force):.6g} {units.force} at {toward:.6g} deg on link {link}"


def _first_turning(position: Position, motion: int) -> tuple[str, float]:
    """The first link, as the joints name them, that turns in a motion, and its rate; else that moves."""
    case, twists = position.case, position.twists
    fastest = max((abs(x) for ts in twists.values() for x in ts[motion]), default=0.0)
    for link in joint_order(case):
        rate = twists[link][motion][2] - twists[case.ground][motion][2]
        if abs(rate) > 1e-12 * fastest:
            return link, rate
    moving = [q for q in joint_order(case) if max(map(abs, twists[q][motion])) > 1e-12 * fastest]
    return (moving or [case.ground])[0], 0.0
