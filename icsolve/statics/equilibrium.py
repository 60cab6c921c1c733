"""Equilibrium of every link, in the plane and in space: sums of forces and of moments, linear in what the
joints transmit. A link has three equations in the plane and six in space; all else is told once.

The moments of each link are taken about a point of its own, so that nothing of a long chain is lost
to its distance from the origin.

The unknown loads from free bodies alone, against those from power.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Generic, Protocol, TypeVar

from icsolve.answer.bodies import Witness
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import Arithmetic, Scalar, decider
from icsolve.numbers.linear import inverse, solve_square
from icsolve.numbers.sparse import General, Row, eliminate
from icsolve.screws import space
from icsolve.screws.plane import velocity
from icsolve.statics.power import Balance, Wrench, force_scale, is_unknown, number_of, place_of
from icsolve.statics.reaction_basis import Force, Position, RopeTie, Tie
from icsolve.tuples import NamedTuple
from icsolve.wording.sentences import plural

Components = tuple[Scalar, ...]
"""Of a point its 2 or 3 coordinates; of a force with its couple 3 or 6 components; of a twist as many."""


class Transmits(Protocol):
    """What the equilibrium asks of a joint between two links, in the plane or in space."""

    @property
    def joint_kind(self) -> str:
        """The joint's kind in the words of the format."""

    @property
    def by(self) -> str:
        """The link on which the opposite acts."""

    @property
    def on(self) -> str:
        """The link on which the units act."""

    @property
    def where(self) -> str:
        """The name of its point."""

    @property
    def units(self) -> tuple[Components, ...]:
        """What passes, each a force with its couple about the joint's point."""


T = TypeVar("T", bound=Transmits)


class Action(NamedTuple):
    """What a unit of a column does to links.

    Attributes
    ----------
    column : of the statics
    on, by : the links on which ``force`` and its opposite act; '' for none
    at : (2,) or (3,) [frame]
    force : (3,) or (6,), force and couple about ``at`` [force, force times frame length]
    """

    column: int
    on: str
    by: str
    at: Components
    force: Components


Equations = dict[str, tuple[Components, tuple[Row, ...]]]
"""For each link the point of its moments, and its three or six equations, forces first."""
Terms = dict[str, tuple[Components, tuple[tuple[float, float], ...]]]
"""For each link the point of its moments; of its equations the sum of absolute terms, and the sum."""


class Rub(NamedTuple):
    """A place where a joint rubs: ``unit`` is the friction on the tie's link ``on`` per unit of it.

    ``tie`` is its place among the ties; ``normal`` has, for each of the tie's units, its share in the
    vector whose length (times ``limit``) bounds the friction.
    """

    tie: int
    unit: Force
    normal: tuple[tuple[float, ...], ...]
    limit: float
    spin: float = 0.0
    """of a screw's thread what a unit of friction does on the rotor"""


class Equilibrium(NamedTuple, Generic[T]):
    """The general solution of the equilibrium of all links.

    Columns: the units of the ties from ``first[t]`` on, the tension of each rope's first part, then the
    parameters: the known loads together (``known``, of value 1), the unknown loads (``root(n)``), the
    friction of each rub (``rub(n)``).

    Attributes
    ----------
    ties, ropes : what transmits
    first : by tie, the column of its first unit
    known : column of the known loads, and so the number of what the joints transmit
    roots : names of the unknown loads
    rubs : places that rub
    scale : power of two: loads and forces are ``scale`` times their number in case units
    equations : of every link, by column
    general : each unit as a combination of parameters, and what the joints leave open
    arithmetic : of all coefficients
    """

    ties: tuple[T, ...]
    ropes: tuple[RopeTie, ...]
    first: tuple[int, ...]
    known: int
    roots: tuple[str, ...]
    rubs: tuple[Rub, ...]
    scale: float
    equations: Equations
    general: General
    arithmetic: Arithmetic

    def is_none(self, value: Scalar, size: float) -> bool:
        """Whether a share in what the joints leave open, of this largest one, is none."""
        vanishes = decider(self.arithmetic)
        return vanishes(value, size) if vanishes else abs(value) <= UNIQUE * size

    def tension(self, n: int) -> int:
        """Column of the tension of a rope."""
        return self.known - len(self.ropes) + n

    def root(self, n: int) -> int:
        """Column of an unknown load."""
        return self.known + 1 + n

    def rub(self, n: int) -> int:
        """Column of the friction at a rub."""
        return self.known + 1 + len(self.roots) + n

    def parameters(self, unknowns: Mapping[str, Scalar], friction: Sequence[Scalar] = ()) -> Row:
        """Values of all parameters, by column.

        Parameters
        ----------
        unknowns : by name [case units]
        friction : (rubs,) [scaled]
        """
        row = {self.known: 1.0}
        row.update({self.root(n): unknowns[name] * self.scale for n, name in enumerate(self.roots)})
        row.update({self.rub(n): f for n, f in enumerate(friction)})
        return row

    def value(self, column: int, parameters: Mapping[int, Scalar]) -> Scalar:
        """What a column has for these parameters [scaled force], free columns at zero."""
        return value_of(self.general.of(column), parameters)

    def filled(self, parameters: Mapping[int, Scalar]) -> Row:
        """Values of all columns, scaled."""
        return {c: self.value(c, parameters) for c in range(self.known)} | dict(parameters)

    def transmitted(self, t: int) -> list[Row]:
        """Each component of a tie's force and couple, as a combination of parameters and free columns."""
        units = self.ties[t].units
        rows: list[Row] = [{} for _ in units[0]]
        amounts = [(unit, self.general.of(self.first[t] + n)) for n, unit in enumerate(units)]
        amounts += [(rub.unit, {self.rub(n): 1.0}) for n, rub in enumerate(self.rubs) if rub.tie == t]
        for unit, combined in amounts:
            for row, share in zip(rows, unit, strict=True):
                for c, a in combined.items() if share else ():
                    row[c] = row.get(c, 0.0) + share * a
        return rows

    def open_sizes(self) -> dict[int, float]:
        """For each free column the largest share that any joint unknown has in it."""
        sizes = dict.fromkeys(self.general.free, 1.0)
        for row in self.general.solved.values():
            for c, a in row.items():
                if c in sizes:
                    sizes[c] = max(sizes[c], abs(a))
        return sizes

    def determines(self, row: Row, sizes: Mapping[int, float]) -> bool:
        """Whether equilibrium determines a combination; ``sizes`` are those of `open_sizes`."""
        return all(self.is_none(row.get(c, 0.0), size) for c, size in sizes.items())


Statics = Equilibrium[Tie]
"""That of a case in the plane."""


def value_of(row: Row, parameters: Mapping[int, Scalar]) -> Scalar:
    """What a combination has for these parameters [scaled], free columns at zero."""
    return sum((a * parameters[c] for c, a in row.items() if c in parameters), 0.0)


def equilibrium(
    position: Position, ties: Sequence[Tie], balance: Balance, rubs: Sequence[Rub] = ()
) -> Statics:
    """Solve the equilibrium of every link in the plane but the frame for what the joints transmit.

    Three equations a link: forces along x and y, moments about a point of its own. As many of them lose all
    joints as the links have motions: these give the unknown loads, and are the sums of power.

    Parameters
    ----------
    position : points and twists [frame]
    ties : as of `ties_of`
    balance : the loads
    rubs : places whose friction is a parameter

    Returns
    -------
    Statics
        Nothing is refused: forces that equilibrium does not determine hang on free columns.
    """
    first, count = columns_of(ties)
    roots = tuple(w.load.name for w in balance.wrenches if is_unknown(w.load))
    bare = Statics(
        tuple(ties),
        position.ropes,
        first,
        count + len(position.ropes),
        roots,
        tuple(rubs),
        force_scale(balance),
        {},
        NOTHING_SOLVED,
        position.arithmetic,
    )
    ground = position.case.ground
    return solve_statics(bare, actions_of(bare, position, balance.wrenches), ground, position.mobility)


NOTHING_SOLVED = General({}, (), ())


def columns_of(ties: Sequence[Transmits]) -> tuple[tuple[int, ...], int]:
    """The first column of each tie, and the number of all."""
    first, column = [], 0
    for tie in ties:
        first.append(column)
        column += len(tie.units)
    return tuple(first), column


def solve_statics(
    bare: Equilibrium[T], actions: Iterable[Action], ground: str, mobility: int
) -> Equilibrium[T]:
    """The statics with its equations and their general solution.

    Parameters
    ----------
    bare : ties, columns, scale
    actions : of all columns; those of the joints first
    ground : link without equations
    mobility : motions of the links: how many equations have to lose all joints. Where the rounding of
        floats hides that number, it is looked for a little above and below
    """
    equations = _equations(actions, bare.known, ground)
    rows = [row for _, rows in equations.values() for row in rows]
    vanishes = decider(bare.arithmetic)
    general = usual = eliminate(rows, bare.known, vanishes=vanishes)
    if vanishes is None:
        for spent in SPENT_TRIES:
            if len(general.left) == mobility:
                break
            general = eliminate(rows, bare.known, spent)
    fits = vanishes is not None or len(general.left) == mobility
    return bare._replace(equations=equations, general=general if fits else usual)


UNIQUE = 1e-9
"""In floats a share below this fraction of the largest is rounding."""
SPENT_TRIES = (1e-12, 1e-11, 1e-10, 1e-14, 1e-15)


def _equations(actions: Iterable[Action], known: int, ground: str) -> Equations:
    """The sums over all actions; each link has its moments about the first point at which a joint acts."""
    found: Equations = {}
    for action in actions:
        opposite = tuple(-part for part in action.force)
        for link, force in ((action.by, opposite), (action.on, action.force)):
            if link not in found and action.column < known and link not in ("", ground):
                found[link] = (action.at, tuple({} for _ in force))
            if link in found:
                about, rows = found[link]
                for row, value in zip(rows, _moved(force, action.at, about), strict=True):
                    row[action.column] = row.get(action.column, 0.0) + value
    return found


def _moved(force: Components, at: Components, about: Components) -> Components:
    """A force with its couple about another point: M + (at - about) x F."""
    if len(force) == 6:
        return space.moved(force, at, about)
    x, y, couple = force
    px, py = at[0] - about[0], at[1] - about[1]
    return (x, y, couple + px * y - py * x)


def tie_actions(ties: Sequence[Tie], first: Sequence[int]) -> Iterator[Action]:
    """What the units of the ties do, on the rotor of a screw too."""
    for tie, column in zip(ties, first, strict=True):
        for n, unit in enumerate(tie.units):
            yield Action(column + n, tie.on, tie.by, tie.at, unit)
            if tie.screw is not None and tie.couples[n]:
                yield Action(column + n, tie.screw.rotor, "", tie.at, (0.0, 0.0, tie.couples[n]))


def rope_actions(ropes: Sequence[RopeTie], first: int) -> Iterator[Action]:
    """The pull of every part of each rope on both of its links (of the last, on the free end)."""
    for column, rope in enumerate(ropes, start=first):
        for k, part in enumerate(rope.parts):
            at, unit = rope.unit(k)
            yield Action(column, part.links[0], part.links[1] or rope.rope.end, at, unit)


def rub_actions(ties: Sequence[Tie], rubs: Sequence[Rub], first: int) -> Iterator[Action]:
    """A unit of friction at every rub, on the rotor of a screw too."""
    for column, rub in enumerate(rubs, start=first):
        tie = ties[rub.tie]
        yield Action(column, tie.on, tie.by, tie.at, rub.unit)
        if tie.screw is not None and rub.spin:
            yield Action(column, tie.screw.rotor, "", tie.at, (0.0, 0.0, rub.spin))


def actions_of(statics: Statics, position: Position, wrenches: Sequence[Wrench]) -> Iterator[Action]:
    """What every column does, in the arithmetic of the position: joints, ropes, loads, friction."""
    yield from tie_actions(statics.ties, statics.first)
    yield from rope_actions(statics.ropes, statics.tension(0))
    for w in wrenches:
        yield _load_action(w, statics, position)
    yield from rub_actions(statics.ties, statics.rubs, statics.rub(0))


def _load_action(w: Wrench, statics: Statics, position: Position) -> Action:
    """A load on its link, the opposite on the link against which it acts."""
    arithmetic = position.arithmetic
    if w.root in statics.roots:
        column, factor = statics.root(statics.roots.index(w.root)), w.ratio
    else:
        column, factor = statics.known, number_of(w, arithmetic) * statics.scale * w.ratio
    gain = w.gain * w.measure * factor
    x, y, couple = (gain * u for u in (w.unit[1], 0.0 - w.unit[0], w.unit[2]))
    place = place_of(w.load, position.points, arithmetic)
    at, force = (place, (x, y, 0.0)) if place else ((0.0, 0.0), (0.0, 0.0, couple))
    return Action(column, w.load.link, w.against, at, force)


def terms_of(statics: Equilibrium[T], parameters: Mapping[int, Scalar]) -> Terms:
    """What the equations of every link are summed from, in the solution with these parameters."""
    x = statics.filled(parameters)
    return {link: (about, _summed(rows, x)) for link, (about, rows) in statics.equations.items()}


def _summed(rows: tuple[Row, ...], x: Mapping[int, Scalar]) -> tuple[tuple[float, float], ...]:
    """Size and sum of each equation; a moment is as uncertain as the forces on the figure's size."""
    terms = [[float(a * x[c]) for c, a in row.items()] for row in rows]
    sizes = [sum(map(abs, row)) for row in terms]
    forces = 3 if len(rows) == 6 else 2
    force = sum(sizes[:forces])
    return tuple(
        (size + (force if n >= forces else 0.0), math.fsum(row))
        for n, (size, row) in enumerate(zip(sizes, terms, strict=True))
    )


def residual(terms: Terms) -> float:
    """What is left of the equilibrium of any link, as a fraction of the largest sum of all; 0 where nothing
    acts.
    """
    sums = [both for _, equations in terms.values() for both in equations]
    largest = max((size for size, _ in sums), default=0.0)
    return max((abs(rest) for _, rest in sums), default=0.0) / (largest or 1.0)


AGREE = 1e-9
"""Power and free bodies may differ by this fraction of the largest term, or by the bound if that is more."""
ROUNDINGS = 32 * 2.0**-53
"""What the operations from a point to a term of an equation can lose together, of the term."""


def unknowns_of(
    statics: Equilibrium[T], friction: Mapping[int, float] | None = None
) -> dict[str, Scalar] | None:
    """The unknown loads [case units] from the equations in which no joint is left.

    Parameters
    ----------
    statics : as of `equilibrium`
    friction : by friction column, its value [scaled]; 0 of those that are not there

    Returns
    -------
    dict[str, Scalar] | None
        None where these equations do not determine them.
    """
    fixed = {statics.known: 1.0, **(friction or {})}
    vanishes = decider(statics.arithmetic)
    columns = [statics.root(n) for n in range(len(statics.roots))]
    rows = [
        [*(left.get(c, 0.0) for c in columns), -sum(a * fixed.get(c, 0.0) for c, a in left.items())]
        for left in statics.general.left
    ]
    rows = independent(rows, len(columns))
    if len(rows) < len(columns):
        return None
    values = solve_square([row[:-1] for row in rows], [row[-1] for row in rows], vanishes)
    if values is None:
        return None
    return {root: value / statics.scale for root, value in zip(statics.roots, values, strict=True)}


def independent(rows: Sequence[Sequence[Scalar]], count: int) -> list[list[Scalar]]:
    """As many rows as there are unknowns (the first ``count`` entries), those with most to say about them.

    Parameters
    ----------
    rows : (m, at least ``count``)

    Returns
    -------
    list[list[Scalar]]
        At most ``count`` of the rows as given, in the order of complete pivoting; fewer where m is less.
    """
    work = [(row, list(row)) for row in map(list, rows)]
    chosen = []
    for _ in range(min(count, len(work))):
        _, r, c = max((abs(left[c]), r, c) for r, (_, left) in enumerate(work) for c in range(count))
        row, pivot = work.pop(r)
        chosen.append(row)
        if pivot[c]:
            for _, left in work:
                ratio = left[c] / pivot[c]
                left[:] = [a - ratio * b for a, b in zip(left, pivot, strict=True)]
                left[c] = 0.0
    return chosen


def bounds_of(
    statics: Equilibrium[T],
    powers: Sequence[Sequence[float]],
    twists: Mapping[str, Sequence[Components]],
    terms: Terms,
) -> dict[str, float]:
    """What rounding can make of the difference between power and free bodies, by unknown load [case units].

    The residual of every equation, and the rounding of its terms, does power on the motions; divided by
    the power of a unit of the unknown that is its error (the motions are the adjoint solution). inf where the
    motions do not determine the loads.

    Parameters
    ----------
    statics : as solved
    powers : (motions, unknowns), the power of a unit of each unknown load
    twists : by link, one a motion
    terms : of the solution
    """
    count = len(statics.roots)
    lost = (_lost(twists, terms, m) for m in range(len(powers)))
    rows = independent([[*row, rest] for row, rest in zip(powers, lost, strict=True)], count)
    by_motion = inverse([row[:-1] for row in rows]) if len(rows) == count else None
    if by_motion is None:
        return dict.fromkeys(statics.roots, float("inf"))
    left = [row[-1] / statics.scale for row in rows]
    sums = [sum(abs(a) * p for a, p in zip(row, left, strict=True)) for row in by_motion]
    return dict(zip(statics.roots, sums, strict=True))


def powers_of(statics: Equilibrium[T], balance: Balance) -> list[list[float]]:
    """The power of a unit of each unknown load, (motions, unknowns)."""
    columns = [[n for n, w in enumerate(balance.wrenches) if w.root == root] for root in statics.roots]
    rows = []
    for factors in balance.factors:
        both = zip(balance.wrenches, factors, strict=True)
        powers = [float(w.ratio) * float(f) * w.measure for w, f in both]
        rows.append([sum(powers[n] for n in ns) for ns in columns])
    return rows


def _lost(twists: Mapping[str, Sequence[Components]], terms: Terms, motion: int) -> float:
    """Power of the residuals and of the roundings of all equations on a motion."""
    lost = 0.0
    for link, (about, equations) in terms.items():
        speeds = _speeds(twists[link][motion], about)
        for speed, (size, rest) in zip(speeds, equations, strict=True):
            lost += abs(speed) * (ROUNDINGS * size + abs(rest))
    return lost


def _speeds(twist: Components, at: Components) -> Components:
    """Velocity of the point of a link, then its angular velocity."""
    if len(twist) == 6:
        return (*space.velocity_of(twist, at), *twist[3:])
    x, y, w = twist
    return (*velocity((x, y, w), (at[0], at[1])), w)


def witnesses(
    power: Mapping[str, tuple[float, float]], bodies: Mapping[str, float], bounds: Mapping[str, float]
) -> tuple[Witness, ...]:
    """Both values of each unknown beside each other; that of power comes with its own bound."""
    return tuple(
        Witness(q, power[q][0], value, value - power[q][0], bounds[q] + power[q][1])
        for q, value in bodies.items()
    )


def refuse_apart(found: Sequence[Witness], slack: float) -> None:
    """Raise SceneError (``near-singular``) where power and free bodies disagree by more than their bounds.

    ``slack`` is how far given centres contradict each other [fraction of the figure's size].
    """
    for w in found:
        room = max(w.bound, max(AGREE, slack) * max(abs(w.power), abs(w.bodies)))
        if not abs(w.difference) <= room:
            raise SceneError(Status.NEAR_SINGULAR, _apart(w))


def _apart(w: Witness) -> str:
    return (
        f"power gives {w.load} = {w.power:.9g} and the equilibrium of the links {w.bodies:.9g}: they should "
        "be one number, so this position is too near to a singular one. Take another position, or give its "
        "data with more digits."
    )


def refuse_doubt(freedoms: int, mobility: int) -> None:
    """Refuse a position in which the links' equilibrium and their motions count different freedoms."""
    if freedoms != mobility:
        raise SceneError(
            Status.NEAR_SINGULAR,
            f"by its motions the mechanism has {plural(mobility, 'degree')} of freedom, by the "
            f"equilibrium of its links {freedoms}: this position is too near to a singular one. Take another "
            "position, or give its data with more digits.",
        )
