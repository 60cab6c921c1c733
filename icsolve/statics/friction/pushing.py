"""Where contacts only push, ropes slip, or nothing presses without friction: the loads that friction within
its limits can hold.

Each friction is at most its coefficient times the force that presses, and a contact's force is not less than
zero; nor is the pull of a rope, and beside a place where it slips neither part pulls with more than
exp(mu beta) times the other. Where the sense of each force that presses is given, these are linear
inequalities in the unknown load and the frictions. The sense of a guide's force is tried both ways; that of a
pin's is turned to where the force lies at the end that was found, until the end goes no farther: each time
the range is one of equilibria.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import product
from typing import TYPE_CHECKING

from icsolve.numbers.arithmetic import Scalar, all_vanish, decider, largest_of, zero_of
from icsolve.numbers.inequalities import Form, region
from icsolve.numbers.linear import Row, eliminate
from icsolve.statics.equilibrium import Action, Rub, Statics, actions_of, columns_of, solve_statics
from icsolve.statics.friction.equations import at, forces_of, shared_normals, smooth_normals
from icsolve.statics.power import Balance
from icsolve.statics.reaction_basis import Position, Tie
from icsolve.tuples import LateModule, NamedTuple

if TYPE_CHECKING:
    from icsolve.screws import ropes as rope_screws
else:
    rope_screws = LateModule("icsolve.screws.ropes")

MOST_GUIDES = 6
"""More have too many combinations of senses."""
TURNS = 60
"""A pin's force is turned so often at most."""
LOADS = (0.0, 1.0, -1.0, 1e3, -1e3)
"""Loads at which the forces of pins are looked at first, in their unit."""
ROUNDED = 2.0**-48
"""What is left of terms that cancel, as a fraction of them, is rounding."""
PROVEN = "proven: no friction within its limits holds more"
TURNED = "the forces of pins were turned until no friction was found that holds more"
Toward = Callable[[Sequence[float]], list[tuple[float, ...]]]
"""Directions of the forces that press, of a load and frictions."""


class Vertex(NamedTuple):
    """What an end of a range follows from.

    Attributes
    ----------
    end : 0 of the least load, 1 of the most
    of : sets of inequalities, by their places, of each of which as equations the end follows; empty where
        forces of pins were turned
    senses : (rubs,) in which the forces press
    """

    end: int
    of: tuple[frozenset[int], ...]
    senses: tuple[float, ...]


class HeldRange(NamedTuple):
    """From what load to what load it holds, perhaps infinite, and what the two ends follow from."""

    low: float
    high: float
    vertices: tuple[Vertex, Vertex]


class RopeSlip(NamedTuple):
    """A place where a rope can slip.

    Attributes
    ----------
    before : columns of the statics whose sum is the pull of the part before it
    column : the parameter that is what the part after it pulls more
    grown : the most that one of the two pulls is of the other
    """

    before: tuple[int, ...]
    column: int
    grown: Scalar


def with_slips(
    position: Position, ties: Sequence[Tie], balance: Balance, rubs: Sequence[Rub]
) -> tuple[Statics, tuple[RopeSlip, ...]]:
    """The statics of ropes each part of which has a pull of its own, and where they slip; ``position`` has
    them as they are without friction."""
    bare = columns_of(tuple(ties), balance, position.arithmetic, position.ropes, tuple(rubs))
    actions, slips = [*actions_of(bare, position, balance.wrenches)], list[RopeSlip]()
    for n, tie in enumerate(position.ropes):
        before = [bare.tension(n)]
        for k in range(1, len(tie.parts)):
            if tie.rope.mu[k] is None:
                continue
            column, here = bare.rub(len(rubs) + len(slips)), [float(j == k) for j in range(1, len(tie.parts))]
            grown = rope_screws.tension_ratios(tie.rope, tie.parts, here, position.arithmetic)[k]
            for j, part in enumerate(tie.parts[k:], start=k):
                on, by = part.links[0], part.links[1] or tie.rope.end
                actions.append(Action(column, on, by, *tie.unit(j)))
            slips.append(RopeSlip(tuple(before), column, grown))
            before.append(column)
    return solve_statics(bare, actions, position.case.ground), tuple(slips)


class Limits(NamedTuple):
    """Affine forms in the unknown load and the frictions, each over its limit, without the one that follows
    from the sum of power [scaled].

    Attributes
    ----------
    load : the unit of the unknown load, which makes its largest coefficient 1 [scaled]
    presses : of each rub the components of the force that presses
    frictions : of each rub
    smooth : the normal forces of contacts without friction, the pulls of ropes, and what these leave one
        another where they slip
    kept : the places of the rubs, and after them of the slips, whose frictions are variables; last those of
        what equilibrium leaves open of contacts that share a load
    """

    load: float
    presses: tuple[tuple[Form, ...], ...]
    frictions: tuple[Form, ...]
    smooth: tuple[Form, ...]
    kept: tuple[int, ...]

    def inside(self, statics: Statics, start: Sequence[float]) -> list[float]:
        """The variables at a load with its frictions."""
        count = len(statics.rubs)
        own = (start[1 + k] / statics.rubs[k].limit if k < count else 0.0 for k in self.kept)
        return [start[0] / self.load, *own]

    def forms(self, toward: Sequence[Sequence[float]]) -> list[Form]:
        """What is not less than zero in an equilibrium where each force that presses has, toward its unit
        vector, at least the friction over its limit."""
        found = list(self.smooth)
        for forces, unit, friction in zip(self.presses, toward, self.frictions, strict=True):
            force = _summed(forces, unit)
            found += [_summed((force, friction), (1.0, side)) for side in (1.0, -1.0)]
        return found


def held(
    statics: Statics, starts: Sequence[Sequence[float]] = (), slips: Sequence[RopeSlip] = ()
) -> list[HeldRange] | None:
    """The ranges of the one unknown load in which friction within its limits holds, by rising value [case
    units]; None where no friction does work, and where guides rub in too many places.

    ``starts`` are loads with their frictions, (1 + rubs,) [scaled], at which the forces of pins are looked at
    first; with ``slips`` the statics are those of `with_slips`.
    """
    limits = _limits(statics, slips)
    guides = [
        k
        for k, rub in enumerate(statics.rubs)
        if len(rub.normal) == 1 and not statics.ties[rub.tie].joint.only_pushes
    ]
    if limits is None or len(guides) > MOST_GUIDES:
        return None
    found: list[HeldRange] = []
    for senses in product((1.0, -1.0), repeat=len(guides)):
        by_guide = dict(zip(guides, senses, strict=True))
        own = [by_guide.get(k, 1.0) for k in range(len(statics.rubs))]
        found += _with_senses(limits, own, [limits.inside(statics, start) for start in starts])
    unit = limits.load / statics.scale
    return _joined([one._replace(low=one.low * unit, high=one.high * unit) for one in found])


def how(statics: Statics) -> str:
    """How it is known that no friction holds more."""
    return TURNED if any(len(rub.normal) == 2 for rub in statics.rubs) else PROVEN


def _limits(statics: Statics, slips: Sequence[RopeSlip]) -> Limits | None:
    """None where there is not one sum of power, or no friction in it."""
    left, count = statics.general.left[0], len(statics.rubs)
    if len(statics.general.left) > 1:
        return None

    count += len(slips)
    shared = shared_normals(statics)
    free = [c for c in statics.general.free if any(row.get(c) for row in shared)]
    columns = (statics.known, statics.root(0), *map(statics.rub, range(count)), *free)
    sizes = [largest_of([row.get(c, 0.0) for row in statics.general.solved.values()]) for c in columns]
    load = 1.0 / (sizes[1] or 1.0)
    pulls = (1.0 / (size or 1.0) for size in sizes[2 + len(statics.rubs) :])
    units = (1.0, load, *(rub.limit for rub in statics.rubs), *pulls)  # the last of slips, and of shares

    def whole(row: Row) -> Form:
        three = zip(columns, sizes, units, strict=True)
        return tuple(
            [a * unit if abs(a := row.get(c, 0.0)) > ROUNDED * size else 0.0 for c, size, unit in three]
        )

    power = whole(left)
    gone = max(range(2, 2 + count), key=lambda k: abs(power[k]), default=0)
    fixed = not gone or not power[gone]
    if fixed and not slips:
        return None

    def form(row: Row) -> Form:
        own = whole(row)
        if fixed:
            return own
        share = -own[gone] / power[gone]
        return _summed((own[:gone] + own[gone + 1 :], power[:gone] + power[gone + 1 :]), (1.0, share))

    presses = tuple(tuple(map(form, rows)) for rows in forces_of(statics))
    frictions = tuple(form({statics.rub(k): 1.0 / rub.limit}) for k, rub in enumerate(statics.rubs))
    kept = tuple([k for k in range(count + len(free)) if fixed or k != gone - 2])
    between = [row for slip in slips for row in between_pulls(statics, slip)]
    between += [left, {c: -a for c, a in left.items()}] if fixed else []  # without friction in it
    smooth = tuple(map(form, (*smooth_normals(statics), *shared, *pulls_of(statics), *between)))
    return Limits(load, presses, frictions, smooth, kept)


def _summed(forms: Sequence[Form], shares: Sequence[float]) -> Form:
    columns = [[a * s for a, s in zip(column, shares, strict=True)] for column in zip(*forms, strict=True)]
    return tuple(
        [total if abs(total := sum(terms)) > ROUNDED * largest_of(terms) else 0.0 for terms in columns]
    )


def _with_senses(
    limits: Limits, senses: Sequence[float], starts: Sequence[Sequence[float]]
) -> Iterator[HeldRange]:
    """The ranges where guides and contacts press in these senses, and pins in any direction."""
    pins = [k for k, forces in enumerate(limits.presses) if len(forces) == 2]

    def toward(inside: Sequence[float]) -> list[tuple[float, ...]]:
        """The directions of the forces at a load and frictions."""
        found: list[tuple[float, ...]] = [(sense,) for sense in senses]
        for k in pins:
            x, y = (at(form, inside) for form in limits.presses[k])
            size = math.hypot(x, y) or 1.0
            found[k] = (x / size, y / size)
        return found

    if not pins:
        part = region(limits.forms([(sense,) for sense in senses]))
        if part.first is not None:
            yield HeldRange(*part.first, _vertices(senses, part.vertex(0), part.vertex(1)))
        return
    for start in (*starts, *((load, *[0.0] * len(limits.kept)) for load in LOADS)):
        units = toward(start)
        if region(limits.forms(units)).first is not None:
            least, most = (_turned(limits, toward, units, end) for end in (0, 1))
            yield HeldRange(least, most, _vertices(senses, (), ()))


def _vertices(
    senses: Sequence[float], least: tuple[frozenset[int], ...], most: tuple[frozenset[int], ...]
) -> tuple[Vertex, Vertex]:
    return Vertex(0, least, tuple(senses)), Vertex(1, most, tuple(senses))


def _turned(limits: Limits, toward: Toward, units: Sequence[tuple[float, ...]], end: int) -> float:
    """An end of the range, the least or the most, with the forces of pins turned to where they lie there."""
    last = math.nan
    for _ in range(TURNS):
        part = region(limits.forms(units))
        if part.first is None or part.first[end] == last:  # but for rounding it is not empty
            break
        last = part.first[end]
        if math.isinf(last):
            break
        units = toward((last, *part.point(last)))
    return last


def _joined(found: Sequence[HeldRange]) -> list[HeldRange]:
    """The ranges that meet as one."""
    joined: list[HeldRange] = []
    for one in sorted(found, key=lambda one: (one.low, one.high)):
        room = ROUNDED * largest_of([end for end in (one.low, one.high) if math.isfinite(end)])
        if joined and one.low <= joined[-1].high + room:
            last = joined[-1]
            if one.high > last.high:
                joined[-1] = last._replace(high=one.high, vertices=(last.vertices[0], one.vertices[1]))
        else:
            joined.append(one)
    return joined


def exactly(statics: Statics, vertex: Vertex) -> Scalar | None:
    """The load at a vertex in the numbers of the statics (balls) [scaled]; None where none follows there.

    Raises MoreDigits where the balls leave that open.
    """
    open_ = [*map(statics.rub, range(len(statics.rubs))), *statics.general.free]
    count, found = len(open_), []
    place = {c: n for n, c in enumerate([*open_, statics.root(0), statics.known])}
    inequalities = _inequalities(statics, vertex.senses)
    for of in vertex.of:
        rows = [statics.general.left[0], *(inequalities[n] for n in of)]
        by_place = [{place[c]: a for c, a in row.items() if c in place} for row in rows]
        left = eliminate(by_place, count, vanishes=decider(statics.arithmetic)).left
        loads = [row for row in left if getattr(row.get(count, 0.0), "is_certain", False)]
        if len(loads) != 1:
            return None
        known, size = loads[0].get(count + 1, 0.0), largest_of([row.get(count + 1, 0.0) for row in by_place])
        if all_vanish(statics.arithmetic, [(known, size)]):
            known = zero_of(known)
        found.append(known / (0.0 - loads[0][count]))
    return (max, min)[vertex.end](found, key=float, default=None)


def _inequalities(statics: Statics, senses: Sequence[float]) -> list[Row]:
    """The inequalities in the order of `Limits.forms`, as combinations of the parameters."""
    found = [*smooth_normals(statics), *shared_normals(statics), *pulls_of(statics)]
    for k, (forces, sense) in enumerate(zip(forces_of(statics), senses, strict=True)):
        most = statics.rubs[k].limit * sense
        for side in (1.0, -1.0):
            row = {c: a * most for c, a in forces[0].items()}
            row[statics.rub(k)] = row.get(statics.rub(k), 0.0) + side
            found.append(row)
    return found


def pulls_of(statics: Statics) -> list[Row]:
    """The pulls of ropes, as combinations of the parameters."""
    return [statics.general.of(statics.tension(n)) for n in range(len(statics.ropes))]


def between_pulls(statics: Statics, slip: RopeSlip) -> tuple[Row, Row]:
    """How much less than it may be each of the pulls beside a place is, as combinations of the parameters."""
    rows = [statics.general.of(column) for column in slip.before]
    before = {c: sum(row.get(c, 0.0) for row in rows) for row in rows for c in row}
    after = {**before, slip.column: before.get(slip.column, 0.0) + 1.0}

    def spare(one: Row, other: Row) -> Row:
        return {c: slip.grown * one.get(c, 0.0) - other.get(c, 0.0) for c in after}

    return spare(before, after), spare(after, before)
