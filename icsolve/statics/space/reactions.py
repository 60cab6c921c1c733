"""The force of each link on each other at every joint in space, in case units.

Why a case in space has no answer, in full sentences; and what a reader of the answer should know.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from icsolve.answer.bodies import names_of
from icsolve.answer.space import Parts, SpatialReaction, SpatialReactions
from icsolve.case import Case
from icsolve.case.names import ordered_pair
from icsolve.case.space import GearPair, Hinge, Radial, Thrust
from icsolve.errors import SceneError, Status
from icsolve.numbers.sparse import Row
from icsolve.statics.space.equilibrium import SpatialStatics
from icsolve.statics.space.figure import AXES, SpatialFigure, SpatialFrame, Vec, dot, square_to
from icsolve.statics.space.power import (
    NEARLY,
    SpatialBalance,
    Twist,
    Wrenched,
    combined,
    is_unknown,
    power_of,
)
from icsolve.statics.space.reaction_basis import SpatialTie, kind_of
from icsolve.statics.space.report import motion_words, moving
from icsolve.wording.sentences import listed, plural, wrong_count

UNIQUE = 1e-9
"""A share in what the joints leave open that is below this, of the largest, is none (rounding)."""
NOTHING = 1e-14
"""A force below this fraction of the largest is none (rounding)."""
ROUNDING = 1e-15
"""A sum below this fraction of its terms is none."""
OPEN = "the joints share the load in a way that equilibrium alone does not determine"


def reactions_of(
    case: Case, frame: SpatialFrame, statics: SpatialStatics, parameters: Mapping[int, float]
) -> SpatialReactions:
    """Every joint's reaction; ``parameters`` are the known loads and the unknown ones."""
    reader = _Reader(case, frame, statics, parameters)
    found = SpatialReactions()
    for t, name in enumerate(names_by_tie(case, statics.ties)):
        found[name] = reader.reaction(t)
    return found


def names_by_tie(case: Case, ties: Sequence[SpatialTie]) -> list[str]:
    """``F34``, ``F3-14``, ``Fcrank-rod``; with the place where a pair has several joints: ``F1-2@B``."""
    pairs = [ordered_pair(case, tie.by, tie.on) for tie in ties]
    shared = Counter(pairs)
    names: list[str] = []
    for tie, (by, on) in zip(ties, pairs, strict=True):
        options = names_of(by, on, tie.where)
        name = options[0] if shared[by, on] == 1 else options[-1]
        names.append(name if name not in names else f"{name} {kind_of(tie.joint)} {names.count(name) + 1}")
    return names


def open_sizes(statics: SpatialStatics) -> dict[int, float]:
    """For each free column the largest share that any joint unknown has in it."""
    sizes = dict.fromkeys(statics.general.free, 1.0)
    for row in statics.general.solved.values():
        for c, a in row.items():
            if c in sizes:
                sizes[c] = max(sizes[c], abs(a))
    return sizes


def is_determined(statics: SpatialStatics, row: Row, sizes: Mapping[int, float]) -> bool:
    """Whether equilibrium determines a combination of the joints' unknowns."""
    return all(abs(row.get(c, 0.0)) <= UNIQUE * size for c, size in sizes.items())


class _Reader:
    """Reads forces and couples along given directions off the general solution."""

    def __init__(
        self, case: Case, frame: SpatialFrame, statics: SpatialStatics, parameters: Mapping[int, float]
    ) -> None:
        self.case, self.frame, self.statics, self.parameters = case, frame, statics, parameters
        self.sizes = open_sizes(statics)
        values = [abs(statics.value(c, parameters)) for c in range(statics.known)]
        self.least = NOTHING * max(values, default=0.0)

    def along(self, t: int, which: int, direction: Vec) -> float | None:
        """The force (``which`` 0) or couple (1) of a tie along a direction, scaled; None where it is open."""
        statics = self.statics
        row: Row = {}
        for column, wrench in zip(statics.columns(t), statics.ties[t].units, strict=True):
            share = dot(wrench[which], direction)
            for c, a in statics.general.of(column).items() if share else ():
                row[c] = row.get(c, 0.0) + share * a
        if not is_determined(statics, row, self.sizes):
            return None
        terms = [a * self.parameters.get(c, 0.0) for c, a in row.items()]
        value, size = math.fsum(terms), math.fsum(map(abs, terms))
        return 0.0 if abs(value) <= max(self.least, ROUNDING * size) else value

    def shown(self, value: float | None, which: int) -> float | None:
        """A scaled force or couple in case units."""
        if value is None:
            return None
        per_torque = self.frame.scale / self.case.units.torque_per_force_length
        return value / self.statics.scale / (per_torque if which else 1.0) + 0.0

    def triple(self, t: int, which: int) -> Parts:
        """Components of the force or couple of a tie, case units."""
        x, y, z = (self.shown(self.along(t, which, axis), which) for axis in AXES)
        return (x, y, z)

    def reaction(self, t: int) -> SpatialReaction:
        """The reaction of a tie, in the order of its links' names."""
        tie = self.statics.ties[t]
        force, couple = self.triple(t, 0), self.triple(t, 1)
        at = self.frame.shown(tie.at)
        why = OPEN if None in (*force, *couple) else ""
        parts = tuple((name, value) for name, value in self.parts(t, tie))
        found = SpatialReaction(tie.by, tie.on, kind_of(tie.joint), tie.where, at, force, couple, why, parts)
        ordered = ordered_pair(self.case, tie.by, tie.on) == (tie.by, tie.on)
        return found if ordered else found.reversed()

    def parts(self, t: int, tie: SpatialTie) -> list[tuple[str, float | None]]:
        """Shares of the force that the joint is about."""
        if isinstance(tie.joint, GearPair):
            return self.tooth_parts(t, tie)
        if not isinstance(tie.joint, Radial | Thrust | Hinge):
            return []
        square = [self.shown(self.along(t, 0, e), 0) for e in square_to(tie.axis)]
        known = [part for part in square if part is not None]
        parts: list[tuple[str, float | None]] = [("radial", math.hypot(*known) if len(known) == 2 else None)]
        if not isinstance(tie.joint, Radial):
            thrust = self.shown(self.along(t, 0, tie.axis), 0)
            parts.append(("thrust", None if thrust is None else abs(thrust)))
        return parts

    def tooth_parts(self, t: int, tie: SpatialTie) -> list[tuple[str, float | None]]:
        """Shares of a tooth force, the couples of its axial share, and what bearings carry of them."""
        mesh = tie.mesh
        assert mesh is not None
        tangential = self.shown(self.along(t, 0, mesh.tangent), 0)
        if tangential is None:
            return [("tangential", None)]
        size = abs(tangential)
        apart, axial = size * mesh.separating, size * abs(mesh.axial)
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
            couple = axial * radius
            parts.append((f"couple{of}", couple * self.case.units.torque_per_force_length))
            span = self.span(link, tie.axis)
            if span:
                parts.append((f"bearing{of}", couple / span))
        return parts

    def span(self, link: str, axis: Vec) -> float | None:
        """How far apart along the axis a link's two bearings are, case lengths; None for other than two."""
        places = [
            dot(tie.at, axis) / self.frame.scale
            for tie in self.statics.ties
            if link in (tie.by, tie.on) and isinstance(tie.joint, Radial | Thrust | Hinge)
        ]
        return abs(places[0] - places[1]) if len(places) == 2 else None


Motions = Sequence[Mapping[str, Twist]]


def refuse_loose(case: Case, ties: Iterable[SpatialTie]) -> None:
    """Refuse links that no chain of joints ties to the frame."""
    beside: dict[str, set[str]] = {}
    for tie in ties:
        beside.setdefault(tie.by, set()).add(tie.on)
        beside.setdefault(tie.on, set()).add(tie.by)
    seen, stack = {case.ground}, [case.ground]
    while stack:
        new = beside.get(stack.pop(), set()) - seen
        seen |= new
        stack.extend(new)
    loose = [link for link in case.links if link not in seen]
    if loose:
        which = f"link {loose[0]}" if len(loose) == 1 else f"links {listed(loose)}"
        said = f"no chain of joints ties {which} to the frame {case.ground}. Add a joint."
        raise SceneError(Status.LOOSE, said)


def refuse_unbalanced(
    figure: SpatialFigure, motions: Motions, loads: Sequence[Wrenched], balance: SpatialBalance
) -> None:
    """Refuse unknown loads that have no value, or any, and known loads that nothing balances."""
    unknowns = [w for w in loads if is_unknown(w.load)]
    if unknowns and not motions:
        raise SceneError(
            Status.STRUCTURE,
            f"the joints hold every link, so any value of {unknowns[0].load.name} is carried. Give it a "
            "number, or take out what holds its link.",
        )
    unbalanced = balance.off > NEARLY
    if balance.free:
        raise _undetermined(motions, unknowns, balance, unbalanced)
    if unbalanced:
        raise SceneError(Status.MOBILITY, _driven(figure, motions, loads, balance))


def _undetermined(
    motions: Motions, unknowns: Sequence[Wrenched], balance: SpatialBalance, unbalanced: bool
) -> SceneError:
    """An unknown that does no work, or more of them than motions that they work on."""
    idle = next((w for w in unknowns if not any(power_of(w, motion).value for motion in motions)), None)
    if idle is None:
        working = len(unknowns) - len(balance.free)
        return SceneError(Status.MOBILITY, wrong_count(len(motions), len(unknowns), len(motions) - working))
    name = idle.load.name
    why = f"{name} does no work on any motion that the joints leave to link {idle.load.link}"
    if unbalanced:
        said = f"no value of {name} balances: {why}, but the known loads do work."
        return SceneError(Status.NO_VALUE, f"{said} Give it another direction, or put it on another link.")
    said = f"any value of {name} balances: {why}, and the known loads do none either."
    return SceneError(Status.ANY_VALUE, f"{said} The joints carry it; ask for another load.")


def _driven(
    figure: SpatialFigure, motions: Motions, loads: Sequence[Wrenched], balance: SpatialBalance
) -> str:
    words = driven_motion(figure, motions, loads, balance)
    return (
        f"the joints leave {plural(len(motions), 'degree')} of freedom and the loads do not balance: they "
        f"drive a motion in which {words}. Add an unknown load that does work on it, or a joint that "
        "prevents it; or correct a point or a load that is off."
    )


def driven_motion(
    figure: SpatialFigure, motions: Motions, loads: Sequence[Wrenched], balance: SpatialBalance
) -> str:
    """The motion that the loads drive most, by that of the first loaded link that takes part."""
    rests = zip(balance.unbalanced, balance.left, strict=True)
    shares = [rest / most if rest else 0.0 for rest, (_, most) in rests]
    most = max(range(len(shares)), key=lambda m: abs(shares[m]))
    motion = combined((motions[most],), (math.copysign(1.0, shares[most]),))
    link = moving(motion, [w.load.link for w in loads])
    return motion_words(link, motion, figure)


def refuse_huge(statics: SpatialStatics, parameters: Mapping[int, float]) -> None:
    """Refuse forces that only a figure out of true by its last digits would make."""
    loads = max((abs(value) for value in parameters.values()), default=0.0)
    values = [abs(statics.value(column, parameters)) for column in range(statics.known)]
    if loads and max(values, default=0.0) > HUGE * loads:
        raise SceneError(
            Status.NEAR_SINGULAR,
            f"the joints would carry more than {HUGE:.0g} times the loads: the bodies are within a hair's "
            "breadth of a position in which they can move. Give the points and axes with more digits, or an "
            "axis by two points of it.",
        )


HUGE = 1e6


def notes_of(
    figure: SpatialFigure,
    motions: Motions,
    loads: Sequence[Wrenched],
    balance: SpatialBalance,
    statics: SpatialStatics,
    reactions: SpatialReactions,
) -> tuple[str, ...]:
    """All that a reader of the answer should know."""
    working, notes = len(balance.unknowns), []
    if not motions:
        notes.append("the joints hold every link: statics alone gives the reactions.")
    if len(motions) > working:
        idle = plural(len(motions) - working, "degree")
        notes.append(f"the joints leave {idle} of freedom in which the loads are in balance.")
    if balance.off:
        words = driven_motion(figure, motions, loads, balance)
        notes.append(
            f"the loads balance to a fraction of {balance.off:.1g} only (a motion in which {words}): taken "
            "as balanced, the rest being rounding of the data."
        )
    return (*notes, *_not_unique(statics, reactions))


def _not_unique(statics: SpatialStatics, reactions: SpatialReactions) -> Iterable[str]:
    named = [part for name, reaction in reactions.items() for part in _open_parts(name, reaction)]
    if not named:
        return
    yield (
        f"equilibrium leaves {plural(len(statics.general.free), 'part')} of the reactions open; not "
        f"determined: {', '.join(named)}. "
        "The joints are redundant: how they share the load depends on their fit and stiffness."
    )


def _open_parts(name: str, reaction: SpatialReaction) -> Iterable[str]:
    force = "".join(axis for axis, part in zip("xyz", reaction.force, strict=True) if part is None)
    couple = "".join(axis for axis, part in zip("xyz", reaction.couple, strict=True) if part is None)
    if force:
        yield name if force == "xyz" else f"{name} along {' and '.join(force)}"
    if couple:
        about = "" if couple == "xyz" else f" about {' and '.join(couple)}"
        yield f"the couple of {name}{about}"
