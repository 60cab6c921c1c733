"""Where a mechanism rubs: the friction that each joint can have, and what bounds it.

A pin: a couple, at most its radius times sin(atan mu) times its force (the friction circle). A slide, a
slot and a contact: a force along the guide (the tangent), at most mu times the normal force; a block of
given length rubs at both ends, which carry its couple.

The sums of power with the losses of friction counted, apart from the equilibrium of the links.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from icsolve.answer import Term, bodies
from icsolve.case import Case, Friction, Number, Rope, Screw
from icsolve.errors import SceneError, Status
from icsolve.kinematics.speeds import Speed, fastest
from icsolve.numbers import FLOATS, Arithmetic, Scalar
from icsolve.numbers.linear import solve_square
from icsolve.screws import pairing, subtract, velocity
from icsolve.screws.joints import guide_direction
from icsolve.statics.equilibrium import Rub, Statics
from icsolve.statics.power import Balance, force_scale, friction_of, known_power
from icsolve.statics.reaction_basis import COUPLE, Force, Position, RopeTie, Tie, thread, ties_of
from icsolve.statics.witness import independent, powers_of
from icsolve.tuples import LateModule, NamedTuple

if TYPE_CHECKING:
    from icsolve.screws import ropes as rope_screws
else:
    rope_screws = LateModule("icsolve.screws.ropes")


def rubs_of(position: Position, ties: Sequence[Tie]) -> tuple[Rub, ...]:
    """Every place that can rub, in the order of the joints: a pin, slide, slot, contact or thread once, a
    block of given length at both ends.

    Coulomb's law: the friction is at most ``limit`` times the length of ``normal`` [frame lengths for the
    radius of a pin's friction circle, ``r sin(atan mu)``; else mu].
    """
    arithmetic = position.arithmetic
    found: list[Rub] = []
    for t, tie in enumerate(ties):
        friction = friction_of(tie.joint)
        if tie.screw is not None and tie.screw.rubs:
            found.append(_threaded(position, t, tie, tie.screw, arithmetic))
        if friction is None:
            continue
        if friction.radius is None:
            found += _guided(position, t, tie, friction, arithmetic)
        else:
            found.append(_pin(position, t, tie, friction, friction.radius, arithmetic))
    return tuple(found)


def _pin(
    position: Position, t: int, tie: Tie, friction: Friction, given: Number, arithmetic: Arithmetic
) -> Rub:
    mu = arithmetic.given(friction.mu)
    radius = arithmetic.given(given) * position.scale * mu / arithmetic.sqrt(mu * mu + 1.0)
    both = tuple(tuple(unit[part] for unit in tie.units) for part in (0, 1))
    return Rub(t, COUPLE, both, radius)


def _threaded(position: Position, t: int, tie: Tie, screw: Screw, arithmetic: Arithmetic) -> Rub:
    """Friction along a thread: at most mu times the force square to it."""
    _, mean, mu = screw.thread
    assert mean is not None
    assert mu is not None
    along, turned = thread(screw.thread, position.scale, arithmetic)
    radius = arithmetic.given(mean) * position.scale
    x, y = guide_direction(screw.slide.guide, position.points, arithmetic)
    rise = turned / radius
    unit: Force = (0.0 - rise * x, 0.0 - rise * y, 0.0)
    normal = (*(0.0 for _ in tie.units[:-1]), 1.0)
    return Rub(t, unit, (normal,), arithmetic.given(mu), radius * along)


def _guided(position: Position, t: int, tie: Tie, friction: Friction, arithmetic: Arithmetic) -> list[Rub]:
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
    """Rubbing rate at every rub in a motion, (rubs,): the power of a unit of its friction on the second link
    [frame length/s, of a pin rad/s].
    """
    return [_rate(position, ties[rub.tie], rub, motion) for rub in rubs]


def _rate(position: Position, tie: Tie, rub: Rub, motion: int) -> Scalar:
    twist = position.relative(tie.by, tie.on, motion)
    vx, vy = velocity(twist, tie.at)
    rate = rub.unit[0] * vx + rub.unit[1] * vy + rub.unit[2] * twist[2]
    return rate if tie.screw is None else rate + rub.spin * position.twists[tie.screw.rotor][motion][2]


AS_SHARED = "as its joints share the load, which equilibrium leaves open, in one way at least."
"""How it holds where some of the ways in which joints that rub share the load balance it."""
PROVEN = "proven: no friction within its limits holds more"
"""How it is known where a range ends."""


class SharedError(SceneError):
    """Friction that hangs on a force that equilibrium leaves open, whatever the loads are."""


def shared(tie: Tie, ties: Sequence[Tie]) -> SharedError:
    """That the friction of a joint hangs on such a force, and what would mend it."""
    remedy = "Take out `mu` there, or make the joints fewer (a pin in a slot in place of a slide)."
    cause = "the joints are redundant and share the load by their fit"
    meshes = [other.joint for other in ties if other.pivots]
    if any(not mesh.pulls and mesh.pressure_angle is None for mesh in meshes):
        cause, remedy = "it hangs on how hard teeth push apart", "Give the gears their `pressure angle`."
    elif any(mesh.pulls for mesh in meshes):
        cause = "it hangs on the initial tension of the belt"
        remedy = "Take out `mu` there, or in place of the belt put its two pulls on the pulleys as loads."
    return SharedError(
        Status.UNSUPPORTED,
        f"the friction of links {tie.by} and {tie.on}{place_of(tie)} depends on a force that equilibrium "
        f"leaves open: {cause}. {remedy}",
    )


class RubbingRates(NamedTuple):
    """How fast what can rub does in the motion that is meant, each zero where it does not.

    Attributes
    ----------
    rubs : of the second link of every rub [frame length/s, of a pin rad/s]
    ropes : of every rope over each place between its parts [frame length/s]; 0.0 where it has no friction
    """

    rubs: tuple[Scalar, ...]
    ropes: tuple[tuple[Scalar, ...], ...]

    @property
    def in_floats(self) -> RubbingRates:
        """Each rounded."""
        return self._each(float)

    @property
    def senses(self) -> RubbingRates:
        """1, -1, or 0 in place of each rate."""
        return self._each(lambda rate: math.copysign(1.0, rate) if rate else 0.0)

    def times(self, way: float) -> RubbingRates:
        """Those of a multiple of the motion."""
        return self._each(lambda rate: way * float(rate) + 0.0)

    def _each(self, change: Callable[[Scalar], float]) -> RubbingRates:
        return RubbingRates(
            tuple(map(change, self.rubs)), tuple(tuple(map(change, row)) for row in self.ropes)
        )

    @property
    def every(self) -> list[Scalar]:
        """All of them."""
        return [rate for row in (self.rubs, *self.ropes) for rate in row]


def rubbing_rates(position: Position, speed: Speed) -> RubbingRates:
    """The rates of all rubs and ropes.

    Raises SceneError where a freedom that no given motion fixes moves one.
    """
    ties = ties_of(position)
    rubs, motions = rubs_of(position, ties), range(position.mobility)
    largest = fastest(position.twists)

    def rate(by_motion: Sequence[Scalar], refusal: Callable[[], str]) -> Scalar:
        found = speed.of(by_motion, largest)
        if found is None:
            raise SceneError(Status.MOBILITY, refusal())
        return found

    by_motion = zip(*(rates_of(position, ties, rubs, m) for m in motions), strict=True)
    own = [rate(rates, partial(_open, ties[rub.tie])) for rub, rates in zip(rubs, by_motion, strict=True)]
    ropes = []
    for tie in position.ropes:
        runs = [
            rope_screws.slip_rates(tie.parts, {link: ts[m] for link, ts in position.twists.items()})
            for m in motions
        ]
        places = zip(tie.rope.mu[1:-1], zip(*runs, strict=True), strict=True)
        refusal = partial(_open_rope, tie.rope)
        ropes.append(tuple([0.0 if mu is None else rate(rates, refusal) for mu, rates in places]))
    return RubbingRates(tuple(own), tuple(ropes))


def _open_rope(rope: Rope) -> str:
    return (
        f"the sense in which the rope {rope.name} slips is open: a freedom that no given motion fixes moves "
        "it. Give its `motion` too, or weld what does not turn."
    )


def _open(tie: Tie) -> str:
    return (
        f"the sense of the friction of links {tie.by} and {tie.on}{place_of(tie)} is open: a freedom that no "
        "given motion fixes moves them. Give its `motion` too, or weld what does not turn."
    )


def place_of(tie: Tie) -> str:
    """`` at B``; nothing where the joint's point has no name."""
    return f" at {tie.where}" if tie.where else ""


def unknowns_by_power(
    position: Position,
    balance: Balance,
    statics: Statics,
    friction: Sequence[float],
    pulls: Sequence[float],
) -> dict[str, float]:
    """The unknown loads that leave no power in any motion, friction counted: apart from the equilibrium of
    the links.

    Parameters
    ----------
    position, balance, statics : the scene
    friction : (rubs,) [scaled]
    pulls : tension of the first part of each rope [case units]

    Returns
    -------
    dict[str, float]
        By name [case units]; not a number where the motions do not determine them.
    """
    rows, scale = [], force_scale(balance)
    for m, row in enumerate(powers_of(statics, balance)):
        rates = rates_of(position, statics.ties, statics.rubs, m)
        lost = sum(f * rate for f, rate in zip(friction, rates, strict=True)) / statics.scale
        slipping = (_slipping(position, tie, m) for tie in statics.ropes)
        lost += sum(pull * power for pull, power in zip(pulls, slipping, strict=True))
        rows.append([*row, -float(known_power(balance, m, FLOATS)) / scale - lost])
    chosen = independent(rows, len(statics.roots))
    values = solve_square([row[:-1] for row in chosen], [row[-1] for row in chosen])
    return dict(zip(statics.roots, values or [float("nan")] * len(statics.roots), strict=True))


def _slipping(position: Position, tie: RopeTie, motion: int) -> float:
    """Power of a rope on its links per unit of its first part's tension; none where it does not slip."""
    twists = {link: ts[motion] for link, ts in position.twists.items()}
    total = 0.0
    for part, ratio in zip(tie.parts, tie.ratios, strict=True):
        there = twists[part.links[1] or tie.rope.end]
        total -= ratio * float(pairing(part.wrench, subtract(there, twists[part.links[0]])))
    return total


def efficiency(terms: Sequence[Term]) -> float | None:
    """Power that comes out of the loads' sum of power, over what goes in; None where nothing goes in."""
    into = sum(term.power for term in terms if term.power > 0.0)
    out = -sum(term.power for term in terms if term.power < 0.0)
    return out / into if into else None


def friction_terms(friction: bodies.FrictionFound, case: Case) -> Iterable[Term]:
    """One term of the sum of power for each rub."""
    for rub in friction.rubbing:
        unit = case.units.torque if rub.kind == "pin" else case.units.force
        name = f"friction {rub.joint}" + (f" at {rub.where}" if rub.where else "")
        words = f"{name} in the {rub.kind}"
        link = rub.joint
        factor = -rub.loss / rub.value if rub.value else 0.0
        yield Term(name, link, rub.value, unit, factor, 0.0 - rub.loss, False, words)
