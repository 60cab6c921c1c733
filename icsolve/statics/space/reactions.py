"""What is told of a case in space: units, senses, motions in words, the force of each link on each other, why
there is no answer, and what a reader of one should know.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

from icsolve import wording
from icsolve.answer import Term
from icsolve.answer.bodies import SpatialReaction, SpatialReactions
from icsolve.case import Case, Spring, Toward, Weight, is_named, ordered_pair
from icsolve.case.space import (
    Along,
    FromTo,
    GearPair,
    Hinge,
    Load,
    Radial,
    SpatialForce,
    SpatialTorque,
    Thrust,
    TorqueVector,
    Vector,
)
from icsolve.errors import SceneError, Status, refuse_overflow
from icsolve.numbers import Arithmetic, Scalar, Showing, decider, largest_of, zero_of
from icsolve.numbers.linear import Row
from icsolve.screws import cross, subtract
from icsolve.screws.space import AXES, Vec, dot, size, square_to, times, unit
from icsolve.statics.equilibrium import value_of
from icsolve.statics.power import unknown_loads
from icsolve.statics.reactions import REDUNDANT, SHARED, left_open, names_by_tie
from icsolve.statics.space.power import NEARLY, SpatialBalance, SpatialSolution, SpatialWrench, is_couple
from icsolve.statics.space.reaction_basis import SpatialFigure, SpatialTie
from icsolve.structure import reached
from icsolve.wording import at_words, plural, sentences
from icsolve.wording.sentences import wrong_count


def unit_of(load: Load, case: Case) -> str:
    """Unit in which a load's number is given and printed."""
    return case.units.torque if is_couple(load) else wording.unit_of(load, case)


def way_words(w: SpatialWrench) -> str:
    """Which way a load acts where its number is positive: ``toward A``, ``along -z``, ``about x``."""
    match w.load:
        case SpatialForce(heading=Toward(point, away)):
            return f"{'away from' if away else 'toward'} {point}"
        case SpatialTorque() | TorqueVector():
            return f"about {direction_words(w.unit[3:])}"
    return f"along {direction_words(w.unit[:3])}"


def sense_of(w: SpatialWrench, value: float) -> str:
    """Sense of an unknown load: ``along -z``, ``about x``, ``toward A``, ``pull``; '' for zero."""
    if value == 0.0:
        return ""
    forth = value > 0.0
    match w.load:
        case Spring():
            return "pull" if forth == (float(w.gain) > 0.0) else "push"
        case Weight():
            return "down" if forth else "up"
        case SpatialTorque(heading=Along() | Vector() | FromTo() as heading):
            return f"about {heading_words(heading, forth)}"
        case SpatialForce(heading=Along() | Vector() | FromTo() as heading):
            return f"along {heading_words(heading, forth)}"
        case SpatialForce(heading=Toward() as toward):
            drawn = forth != toward.away
            if w.load.against is not None:
                return "pull" if drawn else "push"
            return f"{'toward' if drawn else 'away from'} {toward.point}"
    return ""


def heading_words(heading: Along | Vector | FromTo, forth: bool) -> str:
    """``-z``; ``A to B``; the components of the unit vector."""
    match heading:
        case Along(word):
            return word if forth else word[1:] if word[0] == "-" else f"-{word}"
        case FromTo(a, b):
            return f"{a} to {b}" if forth else f"{b} to {a}"
        case Vector(x, y, z):
            sign = 1.0 if forth else -1.0
            return direction_words(unit((sign * x.value, sign * y.value, sign * z.value)))


def terms_of_power(solved: SpatialSolution, values: Mapping[str, float], a: Arithmetic) -> tuple[Term, ...]:
    """The sum of power, for the motion in which the one unknown load moves at 1 (length or rad a second)."""
    case, powers, unknowns = solved.case, solved.powers, unknown_loads(solved.powers)
    if len(unknowns) != 1:
        return ()
    (one,), loads = unknowns, powers.wrenches
    rows = []
    for row, sizes in zip(powers.factors, powers.sizes, strict=True):
        each = zip(loads, row, sizes, strict=True)
        rows.append([0.0 if a.vanishes(f, size) else float(f) * w.measure for w, f, size in each])
    asked = [float(w.ratio) if w.root == one.root else 0.0 for w in loads]
    shares = [sum(p * times for p, times in zip(row, asked, strict=True)) for row in rows]
    most = max(range(len(shares)), key=lambda m: abs(shares[m]))
    whole = shares[most] * (case.units.torque_per_force_length if is_couple(one.load) else 1.0)
    terms = []
    for w, power in zip(loads, rows[most], strict=True):
        name, link, value, factor = w.load.name, w.load.link, values[w.load.name], power / whole
        numbers = value, unit_of(w.load, case), factor, value * factor
        refuse_overflow(f"the power of {name}", value * factor)
        words = f"{name} on link {link}{at_words(getattr(w.load, 'at', None))}"
        terms.append(Term(name, link, *numbers, w.root == one.root, words))
    return tuple(terms)


SMALL = 1e-9
"""A part of a twist that is below this fraction of the whole is none (rounding)."""


Motion = Mapping[str, Sequence[float]]
"""The twist of every link, (6,)."""


def _parts(twist: Sequence[float]) -> tuple[Vec, Vec]:
    """Velocity at the origin and angular velocity."""
    u, v, w, a, b, c = twist
    return (u, v, w), (a, b, c)


def _speed(twist: Sequence[float]) -> float:
    return float(sum(map(size, _parts(twist))))


def motion_words(link: str, motion: Motion, figure: SpatialFigure) -> str:
    """How a link moves: `link 2 turns about the line through A along z`."""
    v, w = _parts(motion[link])
    fastest = max(map(_speed, motion.values()))
    if size(w) <= SMALL * fastest:
        return f"link {link} slides along {direction_words(unit(v))}"
    axis = unit(w)
    on_axis = times(1.0 / dot(w, w), cross(w, v))
    pitch = dot(v, axis) / size(w)
    screw = abs(pitch) > SMALL * (1.0 + size(v) / size(w))
    verb = "screws" if screw else "turns"
    return f"link {link} {verb} about the line {_line(on_axis, axis, figure)}"


def _line(p: Vec, axis: Vec, figure: SpatialFigure) -> str:
    """A line by the named points on it, or by a point and its direction."""
    shown = [(name, point) for name, point in figure.points.items() if is_named(name)]
    named = [(name, point) for name, point in shown if _is_on(point, p, axis)]
    apart = [name for name, point in named if size(subtract(point, named[0][1])) > SMALL]
    if apart:
        return f"through {named[0][0]} and {apart[0]}"
    if named:
        return f"through {named[0][0]} along {direction_words(axis)}"
    return f"through {point_words(figure.frame.shown(p))} along {direction_words(axis)}"


def _is_on(point: Vec, p: Vec, axis: Vec) -> bool:
    """Whether a point lies on the line through p along a unit vector."""
    apart = subtract(point, p)
    return float(size(cross(apart, axis))) <= SMALL * (1.0 + float(size(apart)))


def direction_words(direction: Vec) -> str:
    """``z``, ``-x``, or the components of the unit vector."""
    for name, axis in zip("xyz", AXES, strict=True):
        if size(cross(direction, axis)) <= SMALL:
            return name if dot(direction, axis) > 0.0 else f"-{name}"
    return point_words(direction)


def point_words(p: Vec) -> str:
    """Three numbers in brackets."""
    x, y, z = (0.0 if abs(c) <= SMALL * size(p) else c for c in p)
    return f"[{x:.6g}, {y:.6g}, {z:.6g}]"


def moving(motion: Motion, first: Iterable[str]) -> str:
    """The first link that moves: of those named, or else of all."""
    fastest = max(map(_speed, motion.values()))
    moves = [link for link, twist in motion.items() if _speed(twist) > SMALL * fastest]
    return next((link for link in first if link in moves), moves[0])


NOTHING = 1e-14
"""In floats a force below this fraction of the largest is none (rounding)."""
ROUNDING = 1e-15
"""In floats a sum below this fraction of its terms is none."""


def reactions_of(solved: SpatialSolution, a: Showing) -> SpatialReactions:
    """Every joint's reaction [case units]."""
    reader, names = _Reader(solved, a), names_by_tie(solved.case, solved.statics.ties)
    found = SpatialReactions((name, reader.reaction(t)) for t, name in enumerate(names))
    for name, own in found.items():
        refuse_overflow(name, *own.force, *own.couple)
    return found


class _Reader:
    """Reads forces and couples along given directions off the general solution."""

    def __init__(self, solved: SpatialSolution, a: Showing) -> None:
        self.case, self.frame, self.a = solved.case, solved.figure.frame, a
        self.statics, self.parameters = statics, parameters = solved.statics, solved.parameters
        self.sizes = statics.open_sizes()
        self.largest = largest_of([statics.value(c, parameters) for c in range(statics.known)])
        num, den, pi = self.case.units.exact_torque
        self.per_torque = a.ratio((den, num, -pi)) * self.frame.scale
        self.rows = [statics.transmitted(t) for t in range(len(statics.ties))]

    def along(self, rows: Sequence[Row], direction: Vec) -> Scalar | None:
        """Of a force (or couple) by its components along x, y, z that along a direction; None where open."""
        row: Row = {}
        for share, part in zip(direction, rows, strict=True):
            for c, x in part.items() if share else ():
                row[c] = row.get(c, 0.0) + share * x
        if not self.statics.determines(row, self.sizes):
            return None
        value, vanishes = value_of(row, self.parameters), decider(self.a)
        if vanishes:
            return zero_of(value) if vanishes(value, self.largest) else value
        size = sum(abs(x * self.parameters.get(c, 0.0)) for c, x in row.items())
        return 0.0 if abs(value) <= max(NOTHING * self.largest, ROUNDING * size) else value

    def force(self, t: int, direction: Vec) -> float | None:
        """The force of a tie along a direction, case units; None where it is open."""
        return self._rounded(self.rows[t][:3], direction, self.statics.scale)[0]

    def _rounded(
        self, rows: Sequence[Row], direction: Vec, per: Scalar
    ) -> tuple[float, float] | tuple[None, None]:
        """A force or couple along a direction over a unit, and the bound of its error; None where open."""
        value = self.along(rows, direction)
        return (None, None) if value is None else self.a.rounded(value / per)

    def reaction(self, t: int) -> SpatialReaction:
        """The reaction of a tie, in the order of its links' names."""
        tie, scale, rows = self.statics.ties[t], self.statics.scale, self.rows[t]
        (x, dx), (y, dy), (z, dz) = (self._rounded(rows[:3], axis, scale) for axis in AXES)
        per = scale * self.per_torque
        (u, du), (v, dv), (w, dw) = (self._rounded(rows[3:], axis, per) for axis in AXES)
        i, j, k = map(float, self.frame.shown(tie.at))
        why = SHARED if None in (x, y, z, u, v, w) else ""
        both, errors = ((x, y, z), (u, v, w)), ((dx, dy, dz), (du, dv, dw))
        found = SpatialReaction(
            tie.by,
            tie.on,
            tie.joint_kind,
            tie.where,
            (i, j, k),
            *both,
            why,
            tuple(self.parts(t, tie)),
            errors if decider(self.a) else None,
        )
        ordered = ordered_pair(self.case, tie.by, tie.on) == (tie.by, tie.on)
        return found if ordered else found.reversed()

    def parts(self, t: int, tie: SpatialTie) -> list[tuple[str, float | None]]:
        """Shares of the force that the joint is about."""
        if isinstance(tie.joint, GearPair):
            return self.tooth_parts(t, tie)
        if not isinstance(tie.joint, Radial | Thrust | Hinge):
            return []
        square = [self.force(t, e) for e in square_to(tie.axis, self.a)]
        known = [part for part in square if part is not None]
        parts: list[tuple[str, float | None]] = [("radial", math.hypot(*known) if len(known) == 2 else None)]
        if not isinstance(tie.joint, Radial):
            thrust = self.force(t, tie.axis)
            parts.append(("thrust", None if thrust is None else abs(thrust)))
        return parts

    def tooth_parts(self, t: int, tie: SpatialTie) -> list[tuple[str, float | None]]:
        """Shares of a tooth force, the couples of its axial share, and what bearings carry of them."""
        mesh = tie.mesh
        assert mesh is not None
        tangential = self.force(t, mesh.tangent)
        if tangential is None:
            return [("tangential", None)]
        size = abs(tangential)
        apart, axial = size * float(mesh.separating), size * abs(float(mesh.axial))
        parts: list[tuple[str, float | None]] = [("tangential", size), ("separating", apart)]
        parts.append(("transverse", math.hypot(size, apart)))
        if axial:
            parts.append(("axial", axial))
            parts += self.axial_couples(tie, axial)
        return parts

    def axial_couples(self, tie: SpatialTie, axial: float) -> list[tuple[str, float | None]]:
        """The couple that the axial share makes about each wheel's centre, and its load on two bearings."""
        assert isinstance(tie.joint, GearPair) and tie.mesh is not None
        parts: list[tuple[str, float | None]] = []
        alone = len(tie.mesh.radii) == 1
        for link, radius in zip(tie.joint.links, tie.mesh.radii, strict=False):
            of = "" if alone else f" {link}"
            couple = axial * float(radius)
            parts.append((f"couple{of}", couple * self.case.units.torque_per_force_length))
            span = self.span(link, tie.axis)
            if span:
                parts.append((f"bearing{of}", couple / span))
        return parts

    def span(self, link: str, axis: Vec) -> float | None:
        """How far apart along the axis a link's two bearings are, case lengths; None for other than two."""
        places = [
            float(dot(tie.at, axis)) / self.frame.scale
            for tie in self.statics.ties
            if link in (tie.by, tie.on) and isinstance(tie.joint, Radial | Thrust | Hinge)
        ]
        return abs(places[0] - places[1]) if len(places) == 2 else None


def refuse_loose(case: Case, ties: Sequence[SpatialTie]) -> None:
    """Refuse links that no chain of joints ties to the frame."""

    def beside(link: str) -> list[str]:
        return [other for tie in ties if link in (tie.by, tie.on) for other in (tie.by, tie.on)]

    seen = reached((case.ground,), beside)
    loose = [link for link in case.links if link not in seen]
    if loose:
        raise SceneError(Status.LOOSE, sentences.loose(case, loose))


def refuse_unbalanced(solved: SpatialSolution) -> None:
    """Refuse unknown loads that have no value, or any, and known loads that nothing balances."""
    unknowns, balance = unknown_loads(solved.powers), solved.balance
    if unknowns and not solved.mobility:
        raise SceneError(
            Status.STRUCTURE,
            f"the joints hold every link, so any value of {unknowns[0].load.name} is carried. Give it a "
            "number, or take out what holds its link.",
        )
    unbalanced = balance.off > NEARLY
    if balance.free:
        raise _undetermined(unknowns, balance, unbalanced)
    if unbalanced:
        raise SceneError(
            Status.MOBILITY,
            f"the joints leave {plural(solved.mobility, 'degree')} of freedom and the loads do not balance: "
            f"they drive a motion in which {driven_motion(solved)}. Add an unknown load that does work on "
            "it, or a joint that prevents it; or correct a point or a load that is off.",
        )


def _undetermined(unknowns: Sequence[SpatialWrench], balance: SpatialBalance, unbalanced: bool) -> SceneError:
    """An unknown that does no work, or more of them than motions that they work on."""
    lazy = (w for n, w in enumerate(unknowns) if all(n in row.zero for row in balance.rows))
    idle, mobility = next(lazy, None), len(balance.rows)
    if idle is None:
        working = len(unknowns) - len(balance.free)
        return SceneError(Status.MOBILITY, wrong_count(mobility, len(unknowns), mobility - working))
    name = idle.load.name
    why = f"{name} does no work on any motion that the joints leave to link {idle.load.link}"
    if unbalanced:
        said = f"no value of {name} balances: {why}, but the known loads do work."
        return SceneError(Status.NO_VALUE, f"{said} Give it another direction, or put it on another link.")
    said = f"any value of {name} balances: {why}, and the known loads do none either."
    return SceneError(Status.ANY_VALUE, f"{said} The joints carry it; ask for another load.")


def driven_motion(solved: SpatialSolution) -> str:
    """The motion that the loads drive most, by that of the first loaded link that takes part."""
    shares = solved.balance.shares
    most = max(range(len(shares)), key=lambda m: abs(shares[m]))
    back = shares[most] < 0.0
    motion = {q: [-float(a) if back else float(a) for a in each[most]] for q, each in solved.twists.items()}
    link = moving(motion, [w.load.link for w in solved.powers.wrenches])
    return motion_words(link, motion, solved.figure)


def _is_huge(solved: SpatialSolution) -> bool:
    """Whether joints carry what only a figure out of true by its last digits would make them carry."""
    statics, parameters = solved.statics, solved.parameters
    loads = largest_of(parameters.values())
    carried = largest_of([statics.value(column, parameters) for column in range(statics.known)])
    return bool(loads and carried > HUGE * loads)


HUGE = 1e6
"""Joints that carry so many times the loads are said to."""


def notes_of(solved: SpatialSolution, reactions: SpatialReactions) -> tuple[str, ...]:
    """All that a reader of the answer should know."""
    balance, mobility, notes = solved.balance, solved.mobility, []
    working = len(balance.unknowns)
    if not mobility:
        notes.append("the joints hold every link: statics alone gives the reactions.")
    if mobility > working:
        idle = plural(mobility - working, "degree")
        notes.append(f"the joints leave {idle} of freedom in which the loads are in balance.")
    if _is_huge(solved):
        notes.append(
            f"the joints carry more than {HUGE:.0g} times the loads: the bodies are within a hair's breadth "
            "of a position in which they can move, and the last digits of points and axes tell how much."
        )
    if balance.off:
        notes.append(
            f"the loads balance to a fraction of {balance.off:.1g} only (a motion in which "
            f"{driven_motion(solved)}): taken as balanced, the rest being rounding of the data."
        )
    named = [part for name, reaction in reactions.items() for part in _open_parts(name, reaction)]
    if named:
        notes.append(left_open(solved.statics, named, REDUNDANT))
    return tuple(notes)


def _open_parts(name: str, reaction: SpatialReaction) -> Iterable[str]:
    force = "".join(axis for axis, part in zip("xyz", reaction.force, strict=True) if part is None)
    couple = "".join(axis for axis, part in zip("xyz", reaction.couple, strict=True) if part is None)
    if force:
        yield name if force == "xyz" else f"{name} along {' and '.join(force)}"
    if couple:
        about = "" if couple == "xyz" else f" about {' and '.join(couple)}"
        yield f"the couple of {name}{about}"
