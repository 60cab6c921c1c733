"""Free bodies of a scene without friction: reactions, and the witness for the unknown loads.

A mechanism without an unknown load: its known loads hold it still, or what they do is named.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

from icsolve.answer import Answer
from icsolve.answer.bodies import FrictionFound, Reactions, Tension, Witness
from icsolve.errors import SceneError, Status
from icsolve.kinematics import FRAME
from icsolve.kinematics.speeds import joint_order
from icsolve.numbers import FLOATS, Arithmetic, Scalar, Showing, largest_of
from icsolve.numbers.linear import Row
from icsolve.numbers.units import numbers_in
from icsolve.screws import velocity
from icsolve.statics import reaction_basis
from icsolve.statics.equilibrium import Equilibrium, Statics, T, equilibrium
from icsolve.statics.friction import efficiency, friction_terms
from icsolve.statics.load_wrenches import Wrench
from icsolve.statics.power import Balance, force_scale, has_friction, is_unknown, known_power, power_of
from icsolve.statics.reaction_basis import Position, Tie, ties_of
from icsolve.statics.reactions import names_by_tie, notes_of, reactions_of, tensions_of
from icsolve.statics.witness import (
    bounds_of,
    compared,
    refuse_doubt,
    terms_of,
    unknowns_of,
)
from icsolve.tuples import NamedTuple, Protocol, TypeVar, replace
from icsolve.wording import direction_words, listed


class FreeBodies(NamedTuple):
    """What free bodies say of a scene."""

    reactions: Reactions
    witnesses: tuple[Witness, ...] = ()
    notes: tuple[str, ...] = ()
    friction: FrictionFound | None = None
    tensions: tuple[Tension, ...] = ()

    def added_to(self, answer: Answer, reactions: bool = True) -> Answer:
        """An answer with what free bodies add to it; friction brings its losses to the sum of power."""
        friction, terms = self.friction, answer.terms
        if friction is not None:
            friction = friction._replace(efficiency=efficiency(terms))
            terms = (*terms, *friction_terms(friction, answer.case))
        return replace(
            answer,
            terms=terms,
            reactions=self.reactions if reactions else None,
            tensions=self.tensions if reactions else (),
            witnesses=self.witnesses if reactions else (),
            friction=friction,
            notes=(*answer.notes, *self.notes),
        )


def free_bodies(
    position: Position,
    balance: Balance,
    power: Mapping[str, tuple[float, float]],
    a: Showing,
    figure: Reach = lambda motion: 0.0,
) -> FreeBodies:
    """Equilibrium of every link; ``power`` has the unknown loads as power found them, and their bounds.

    ``figure`` is as in `refuse_imbalance`. Raises SceneError where the two disagree.
    """
    known = position.mobility and not any(is_unknown(w.load) for w in balance.wrenches)
    left = refuse_imbalance(position, balance, a, figure) if known else ()
    solved = frictionless(position, balance, ties_of(position))
    found = told(position, balance, solved, power, a)
    return found._replace(notes=(*left, *found.notes))


def told(
    position: Position,
    balance: Balance,
    solved: Solved,
    power: Mapping[str, tuple[float, float]] | None,
    a: Showing,
    asked: bool = True,
) -> FreeBodies:
    """What a solution of the free bodies says: reactions, pulls, the unknown loads beside those from power.

    Parameters
    ----------
    position, balance : the scene
    solved : its equilibrium, with friction or without
    power : by unknown load its value by power and the bound of that [case units]; None where power says none
    a : arithmetic of the solution
    asked : whether all reactions are asked for, or those alone of which something is to be said

    Raises
    ------
    SceneError
        ``near-singular`` where power and free bodies disagree, ``slack`` where a rope would have to push.
    """
    statics, parameters = solved.statics, solved.parameters
    both: tuple[Witness, ...] = ()
    if power is not None:
        roundings = None
        if a is FLOATS and position.mobility:
            terms = terms_of(statics, parameters)
            roundings = bounds_of(statics, balance, position.twists, terms)
        both = compared(power, solved.unknowns, roundings, position.slack, statics, parameters, a)
    reactions = Reactions()
    if asked or statics.general.free or any(tie.joint.only_pushes for tie in statics.ties):
        reactions = reactions_of(position, statics, parameters, a)
    notes = notes_of(statics, reactions, names_by_tie(position.case, statics.ties), parameters, a)
    return FreeBodies(
        reactions, both, notes, tensions=tensions_of(statics, parameters, a, position.case.units.force)
    )


class Solved(NamedTuple):
    """Statics with the values of its parameters: unknown loads in case units, friction scaled."""

    statics: Statics
    unknowns: dict[str, Scalar]
    friction: tuple[Scalar, ...] = ()

    @property
    def parameters(self) -> Row:
        """Values by column."""
        return self.statics.parameters(self.unknowns, self.friction)

    def carrying(self, t: int) -> float:
        """As `carrying`."""
        return carrying(self.statics, self.parameters, t)


def frictionless(position: Position, balance: Balance, ties: Sequence[Tie]) -> Solved:
    """The statics without friction, with the tooth forces on the flanks that carry."""
    return with_tooth_forces(position, ties, lambda flanked: _without_friction(position, balance, flanked))


def carrying_flanks(position: Position, ties: Sequence[Tie], found: Solved) -> dict[int, float]:
    """The flanks on which the tooth forces of a solution lie."""
    flanks = {}
    for t in reaction_basis.meshes(ties):
        if len(found.statics.ties[t].units) == 1:
            tangent, _ = reaction_basis.tangent_and_separating(position, ties[t])
            x, y, _ = found.statics.ties[t].units[0]
            flanks[t] = math.copysign(1.0, x * tangent[0] + y * tangent[1])
    return flanks


def _without_friction(position: Position, balance: Balance, ties: Sequence[Tie]) -> Solved:
    statics = equilibrium(position, ties, balance)
    refuse_doubt(len(statics.general.left), position.mobility)
    unknowns = unknowns_of(statics)
    if unknowns is None:
        refuse_doubt(0, position.mobility)
    return Solved(statics, unknowns or {})


MOST_TURNS = 4
"""Flanks are tried again where friction, or a separating force, turns a tooth force."""


class Carries(Protocol):
    """A solution, in the plane or in space, that says on which flanks its teeth carry."""

    def carrying(self, t: int) -> float:
        """Sign of the force in a mesh along its first unit."""


S = TypeVar("S", bound=Carries)
Solve = Callable[[Sequence[Tie]], Solved]


def with_tooth_forces(position: Position, ties: Sequence[Tie], solve: Solve) -> Solved:
    """Solve with the tooth forces on the flanks that carry.

    The tangential forces are found first, with the separating ones open. Where equilibrium determines
    both parts of a force (wheels that no bearing keeps apart), it needs no pressure angle.
    """
    meshes = reaction_basis.meshes(ties)
    if not meshes:
        return solve(ties)
    found = solve(reaction_basis.with_flanks(position, ties, dict.fromkeys(meshes, 0.0)))
    sizes, first = found.statics.open_sizes(), found.statics.first
    open_flanks = {}
    for t in meshes:
        tangential, separating = (found.statics.general.of(first[t] + n) for n in (0, 1))
        if found.statics.determines(tangential, sizes) and not found.statics.determines(separating, sizes):
            open_flanks[t] = found.carrying(t)
    return on_flanks(open_flanks, lambda flanks: solve(reaction_basis.with_flanks(position, ties, flanks)))


def on_flanks(flanks: Mapping[int, float], solve: Callable[[Mapping[int, float]], S]) -> S:
    """Solve with tooth forces on these flanks first; where a force pulls, on the other one."""
    for _ in range(MOST_TURNS):
        found = solve(flanks)
        turned = {t: flank * found.carrying(t) for t, flank in flanks.items()}
        if turned == flanks:
            break
        flanks = turned
    return found


def carrying(statics: Equilibrium[T], parameters: Mapping[int, Scalar], t: int) -> float:
    """Sign of the force in a mesh along its first unit; 1 for no force."""
    value = statics.value(statics.first[t], parameters)
    largest = max(abs(statics.value(column, parameters)) for column in range(statics.known))
    return 1.0 if statics.arithmetic.vanishes(value, largest) else math.copysign(1.0, value)


TOLERATED = 1e-9
"""Loads whose powers leave this fraction of the largest are taken as balanced, and that is said."""
Reach = Callable[[int], float]
"""What half a unit of the last decimals of a figure may make of the power of the known loads in a motion."""


class LeftOver(NamedTuple):
    """What the powers of known loads leave in a motion [case units times the motion's speed].

    Attributes
    ----------
    motion : in which
    left : what they add up to
    powers : of each load
    within : what that may be for want of; '' where the loads do not balance
    """

    motion: int
    left: float
    powers: tuple[float, ...]
    within: str


def left_over(balance: Balance, a: Arithmetic, figure: Reach) -> Iterator[LeftOver]:
    """Where the powers of known loads do not add up to zero, and whether that may be for want of decimals, of
    the loads or of the ``figure``, or is next to nothing."""
    for motion, factors in enumerate(balance.factors):
        powers = tuple(power_of(w, float(f)) for w, f in zip(balance.wrenches, factors, strict=True))
        sizes = [power_of(w, size) for w, size in zip(balance.wrenches, balance.sizes[motion], strict=True)]
        scale = force_scale(balance)
        exact = known_power(balance, motion, a)
        if a.vanishes(exact, sum(map(abs, sizes)) * scale):
            continue
        left, largest = float(exact) / scale, max(map(abs, powers))
        room = sum(_room(w, float(f)) for w, f in zip(balance.wrenches, factors, strict=True))
        within = ""
        if abs(left) <= room or room + TOLERATED * largest < abs(left) <= room + figure(motion):
            within = "half a unit of the last decimals"
        elif abs(left) <= room + TOLERATED * largest:
            within = f"a fraction of {abs(left) / largest:.1g} of what they do"
        yield LeftOver(motion, left, powers, within)


def refuse_imbalance(
    position: Position, balance: Balance, a: Arithmetic, figure: Reach = lambda motion: 0.0
) -> tuple[str, ...]:
    """Refuse reactions of known loads that do not balance; the notes on what decimals leave open.

    With friction nothing says how much of it acts, unless a load is unknown.
    """
    if has_friction(position.case):
        raise SceneError(
            Status.UNBALANCED,
            "with friction, and no unknown load, nothing says how much of the friction acts: make one load "
            "`unknown`, or take out `mu`.",
        )
    notes = []
    for one in left_over(balance, a, figure):
        said = _leave(position, balance, one.motion, one.powers, one.left)
        if not one.within:
            raise SceneError(Status.UNBALANCED, _named(said))
        notes.append(_taken(said, one.within))
    return tuple(notes)


def _room(w: Wrench, factor: float) -> float:
    """Power of half a unit of the last decimal of a load's number."""
    half = max(number.half for number in numbers_in(w.number))
    return abs(half * float(w.ratio) * factor * w.measure)


def _named(left: str) -> str:
    """What the loads leave on which link, and what would mend it."""
    return (
        f"the known loads do not balance: {left}, so there are no reactions at rest. Make one of the loads "
        "`unknown`, or add one."
    )


def _taken(left: str, within: str) -> str:
    """What the loads leave, where that is so little that it may be for want of decimals."""
    return (
        f"{left}, which is within {within}: the reactions are given without it. To balance the loads, make "
        "one of them `unknown`."
    )


def _leave(position: Position, balance: Balance, motion: int, powers: Sequence[float], left: float) -> str:
    working = [w.load.name for w, power in zip(balance.wrenches, powers, strict=True) if power]
    verb = "leaves" if len(working) == 1 else "leave"
    return f"{listed(working)} {verb} {_left(position, motion, left)}"


def _left(position: Position, motion: int, drive: float) -> str:
    """The power that is left, as a torque on a link that turns or a force along a link's motion."""
    link, rate = _first_turning(position, motion)
    units = position.case.units
    if rate:
        torque = drive / rate / position.scale * units.torque_per_force_length
        return f"{abs(torque):.6g} {units.torque} {'ccw' if torque > 0.0 else 'cw'} on link {link}"
    x, y = velocity(position.twists[link][motion], FRAME)
    force = drive / math.hypot(x, y)
    toward = direction_words(math.degrees(math.atan2(y * force, x * force)))
    return f"{abs(force):.6g} {units.force} at {toward} on link {link}"


def _first_turning(position: Position, motion: int) -> tuple[str, float]:
    """The first link, as the joints name them, that turns in a motion, and its rate; else that moves."""
    case, twists = position.case, position.twists
    fastest = largest_of([x for ts in twists.values() for x in ts[motion]])
    for link in joint_order(case):
        rate = twists[link][motion][2] - twists[case.ground][motion][2]
        if abs(rate) > 1e-12 * fastest:
            return link, rate
    moving = [q for q in joint_order(case) if max(map(abs, twists[q][motion])) > 1e-12 * fastest]
    return (moving or [case.ground])[0], 0.0
