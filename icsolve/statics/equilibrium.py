"""Equilibrium of every link, in the plane and in space: sums of forces and of moments, linear in what the
joints transmit. A link has three equations in the plane and six in space; all else is told once.

The moments of each link are taken about a point of its own, so that nothing of a long chain is lost
to its distance from the origin.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import accumulate
from typing import TYPE_CHECKING, Any

from icsolve.numbers import Arithmetic, Scalar, decider
from icsolve.numbers.linear import General, Row, eliminate
from icsolve.statics.load_wrenches import L, UnitWrench, Wrench, number_of, place_of
from icsolve.statics.power import Balance, PowerFactors, force_scale, unknown_loads
from icsolve.statics.reaction_basis import Force, Position, RopeTie, Tie
from icsolve.tuples import Generic, LateModule, NamedTuple, Protocol, TypeVar

if TYPE_CHECKING:
    from icsolve.screws import space
else:
    space = LateModule("icsolve.screws.space")

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
    def at(self) -> Components:
        """Its point [frame]."""

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
    asks : asks a question of the same on balls, by the fewest digits that settle it; None where no bounds are
        asked for
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
    asks: Callable[[Callable[[Any], Any]], Any] | None = None

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
        vanishes = decider(self.arithmetic) or (lambda value, size: abs(value) <= UNIQUE * size)
        return all(vanishes(row.get(c, 0.0), size) for c, size in sizes.items())


Statics = Equilibrium[Tie]
"""That of a case in the plane."""


def value_of(row: Row, parameters: Mapping[int, Scalar]) -> Scalar:
    """What a combination has for these parameters [scaled], free columns at zero."""
    return sum((a * parameters[c] for c, a in row.items() if c in parameters), 0.0)


def equilibrium(
    position: Position,
    ties: Sequence[Tie],
    balance: Balance,
    rubs: Sequence[Rub] = (),
    general: General | None = None,
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
    general : the general solution, where it is known already

    Returns
    -------
    Statics
        Nothing is refused: forces that equilibrium does not determine hang on free columns.
    """
    bare = columns_of(tuple(ties), balance, position.arithmetic, position.ropes, tuple(rubs))
    ground = position.case.ground
    return solve_statics(bare, actions_of(bare, position, balance.wrenches), ground, general)


def columns_of(
    ties: tuple[T, ...],
    balance: PowerFactors[L],
    arithmetic: Arithmetic,
    ropes: tuple[RopeTie, ...] = (),
    rubs: tuple[Rub, ...] = (),
) -> Equilibrium[T]:
    """The columns of what is to be solved: statics without equations."""
    *first, count = accumulate((len(tie.units) for tie in ties), initial=0)
    roots, known = tuple(w.root for w in unknown_loads(balance)), count + len(ropes)
    nothing = General({}, (), ())
    return Equilibrium(
        ties, ropes, tuple(first), known, roots, rubs, force_scale(balance), {}, nothing, arithmetic
    )


def solve_statics(
    bare: Equilibrium[T], actions: Iterable[Action], ground: str, general: General | None = None
) -> Equilibrium[T]:
    """The statics with its equations and their general solution.

    Parameters
    ----------
    bare : ties, columns, scale
    actions : of all columns; those of the joints first
    ground : link without equations
    general : the general solution, where it is known already
    """
    equations = _equations(actions, bare.known, ground)
    if general is None:
        rows = [row for _, rows in equations.values() for row in rows]
        general = eliminate(rows, bare.known, vanishes=decider(bare.arithmetic))
    return bare._replace(equations=equations, general=general)


UNIQUE = 1e-9
"""In floats a share below this fraction of the largest is rounding."""


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


def tie_actions(statics: Equilibrium[T]) -> Iterator[Action]:
    """What the units of the ties do."""
    for tie, column in zip(statics.ties, statics.first, strict=True):
        for n, unit in enumerate(tie.units):
            yield Action(column + n, tie.on, tie.by, tie.at, unit)


def actions_of(statics: Statics, position: Position, wrenches: Sequence[Wrench]) -> Iterator[Action]:
    """What every column does, in the arithmetic of the position: joints, screws on their rotors, each part of
    a rope on both of its links (of the last, on the free end), loads, friction."""
    yield from tie_actions(statics)
    for tie, column in zip(statics.ties, statics.first, strict=True):
        for n, couple in enumerate(tie.couples if tie.screw is not None else ()):
            if couple and tie.screw is not None:
                yield Action(column + n, tie.screw.rotor, "", tie.at, (0.0, 0.0, couple))
    for n, rope in enumerate(statics.ropes):
        for k, part in enumerate(rope.parts):
            yield Action(statics.tension(n), part.links[0], part.links[1] or rope.rope.end, *rope.unit(k))
    for w in wrenches:
        yield _load_action(w, statics, position)
    for n, rub in enumerate(statics.rubs):
        tie = statics.ties[rub.tie]
        yield Action(statics.rub(n), tie.on, tie.by, tie.at, rub.unit)
        if tie.screw is not None and rub.spin:
            yield Action(statics.rub(n), tie.screw.rotor, "", tie.at, (0.0, 0.0, rub.spin))


def equations_of(statics: Statics, position: Position, wrenches: Sequence[Wrench]) -> Equations:
    """The equations of all links but the frame in the arithmetic of the position, for these columns."""
    return _equations(actions_of(statics, position, wrenches), statics.known, position.case.ground)


def _load_action(w: Wrench, statics: Statics, position: Position) -> Action:
    """A load where its resultant acts."""
    place = place_of(w.load, position.points, position.arithmetic)
    at, force = (place, (w.unit[1], 0.0 - w.unit[0], 0.0)) if place else ((0.0, 0.0), (0.0, 0.0, w.unit[2]))
    return load_action(w, statics, at, force)


def load_action(w: UnitWrench[L], statics: Equilibrium[T], at: Components, unit: Components) -> Action:
    """A load on its link, the opposite on the link against which it acts: so many times a unit at a point."""
    if w.root in statics.roots:
        column, factor = statics.root(statics.roots.index(w.root)), w.ratio
    else:
        column, factor = statics.known, number_of(w, statics.arithmetic) * statics.scale * w.ratio
    gain = w.gain * w.measure * factor
    return Action(column, w.load.link, w.against, at, tuple([gain * part for part in unit]))
