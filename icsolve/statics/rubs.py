"""Where a mechanism rubs: the friction that each joint can have, and what bounds it.

A pin: a couple, at most its radius times sin(atan mu) times its force (the friction circle). A slide, a
slot and a contact: a force along the guide (the tangent), at most mu times the normal force; a block of
given length rubs at both ends, which carry its couple.
"""

from __future__ import annotations

from collections.abc import Sequence

from icsolve.case import Case, Contact, Friction, Pin, Slide, Slot
from icsolve.numbers.arithmetic import FLOATS, Arithmetic, Scalar
from icsolve.screws.plane import velocity
from icsolve.statics.equilibrium import Rub
from icsolve.statics.ties import COUPLE, Force, Position, Tie


def friction_of(joint: object) -> Friction | None:
    """A joint's friction, where its coefficient is not zero."""
    friction: Friction | None = getattr(joint, "friction", None)
    return friction if friction is not None and friction.mu.value > 0.0 else None


def has_friction(case: Case) -> bool:
    """Whether any joint rubs."""
    return any(friction_of(joint) is not None for joint in case.joints)


def rubs_of(
    position: Position, ties: Sequence[Tie], arithmetic: Arithmetic = FLOATS
) -> tuple[Rub, ...]:
    """Every place that can rub, in the order of the joints."""
    found: list[Rub] = []
    for t, tie in enumerate(ties):
        friction = friction_of(tie.joint)
        if friction is None:
            continue
        if isinstance(tie.joint, Pin):
            found.append(_pin(position, t, tie, friction, arithmetic))
        elif isinstance(tie.joint, Slide | Slot | Contact):
            found += _guided(position, t, tie, friction, arithmetic)
    return tuple(found)


def _pin(position: Position, t: int, tie: Tie, friction: Friction, arithmetic: Arithmetic) -> Rub:
    assert friction.radius is not None
    mu = arithmetic.given(friction.mu)
    radius = arithmetic.given(friction.radius) * position.scale * mu / arithmetic.sqrt(mu * mu + 1.0)
    both = tuple(tuple(unit[part] for unit in tie.units) for part in (0, 1))
    return Rub(t, COUPLE, both, radius)


def _guided(
    position: Position, t: int, tie: Tie, friction: Friction, arithmetic: Arithmetic
) -> list[Rub]:
    """One rub, or one at each end of a block with a length."""
    nx, ny = next((unit[0], unit[1]) for unit in tie.units if float(unit[2]) == 0.0)
    along: Force = (-ny, nx, 0.0)
    normal = tuple(unit[0] * nx + unit[1] * ny for unit in tie.units)
    mu = arithmetic.given(friction.mu)
    if friction.length is None:
        return [Rub(t, along, (normal,), mu)]
    length = arithmetic.given(friction.length) * position.scale
    couple = tuple(unit[2] for unit in tie.units)
    ends = [
        tuple(n * 0.5 + side * c / length for n, c in zip(normal, couple, strict=True))
        for side in (-1.0, 1.0)
    ]
    return [Rub(t, along, (end,), mu) for end in ends]


def rates_of(position: Position, ties: Sequence[Tie], rubs: Sequence[Rub], motion: int) -> list[Scalar]:
    """Rubbing rate at every rub in a motion: the power of a unit of its friction."""
    return [_rate(position, ties[rub.tie], rub, motion) for rub in rubs]


def _rate(position: Position, tie: Tie, rub: Rub, motion: int) -> Scalar:
    twist = position.relative(tie.by, tie.on, motion)
    vx, vy = velocity(twist, tie.at)
    return rub.unit[0] * vx + rub.unit[1] * vy + rub.unit[2] * twist[2]


def kind_of_rub(tie: Tie) -> str:
    """``pin``, ``slide``, ``slot`` or ``contact``."""
    return type(tie.joint).__name__.lower()
