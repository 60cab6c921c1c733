"""A mechanism without an unknown load: its known loads hold it still, or what they do is named."""

from __future__ import annotations

from collections.abc import Sequence

from icsolve.bodies.rubs import has_friction
from icsolve.bodies.ties import Position
from icsolve.case import ForceVector, Number
from icsolve.errors import SceneError, Status
from icsolve.power import Balance, Wrench, known_value
from icsolve.sentences import listed
from icsolve.speeds import joint_order

ROUNDED = 1e-9
"""Power of this fraction of the largest term is rounding, where all numbers are exact."""
NOISE = 1e-13
"""A power below this fraction of the products that it is summed from is none."""


def refuse_imbalance(position: Position, balance: Balance) -> None:
    """Refuse reactions of known loads that do not balance, within half a unit of their last decimals.

    With friction nothing says how much of it acts, unless a load is unknown.
    """
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
    """Which loads drive which link which way, and what would mend it."""
    drive = sum(powers)
    link, rate = _first_turning(position, motion)
    working = [w.load.name for w, power in zip(balance.wrenches, powers, strict=True) if power]
    sense = "" if rate == 0.0 else " ccw" if rate * drive > 0.0 else " cw"
    does = ("turn" if rate else "move") + ("s" if len(working) == 1 else "")
    return (
        f"the known loads do not balance: {listed(working)} {does} link {link}{sense}, so there are no "
        "reactions at rest. Make one of the loads `unknown`, or add one."
    )


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
