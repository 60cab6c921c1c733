"""Equilibrium of every link: the sum of forces and of moments, linear in what the joints transmit.

The moments of each link are taken about a point of its own, so that nothing of a long chain is lost
to its distance from the origin.

The unknown loads from free bodies alone, against those from power.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from icsolve.answer.bodies import Witness
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import Arithmetic, Scalar, decider
from icsolve.numbers.linear import inverse, solve_square
from icsolve.numbers.sparse import General, Row, eliminate
from icsolve.screws.plane import Point, velocity
from icsolve.statics.power import Balance, Wrench, force_scale, is_unknown, number_of, place_of
from icsolve.statics.reaction_basis import Force, Position, RopeTie, Tie


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


class Statics(NamedTuple):
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
    general : each unit as a combination of parameters, and what the joints leave open
    arithmetic : of all coefficients
    """

    ties: tuple[Tie, ...]
    ropes: tuple[RopeTie, ...]
    first: tuple[int, ...]
    known: int
    roots: tuple[str, ...]
    rubs: tuple[Rub, ...]
    scale: float
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
        return sum((a * parameters.get(c, 0.0) for c, a in self.general.of(column).items()), 0.0)

    def filled(self, parameters: Mapping[int, Scalar]) -> Row:
        """Values of all columns, scaled."""
        return {c: self.value(c, parameters) for c in range(self.known)} | dict(parameters)


def equilibrium(
    position: Position,
    ties: Sequence[Tie],
    balance: Balance,
    rubs: Sequence[Rub] = (),
) -> Statics:
    """Solve the equilibrium of every link but the frame for what the joints transmit.

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
    rows = _BodyRows(position, ties)
    first = []
    column = 0
    for tie in ties:
        first.append(column)
        for n in range(len(tie.units)):
            rows.tie(tie, n, column)
            column += 1
    for tension in position.ropes:
        rows.rope(tension, column)
        column += 1
    scale = force_scale(balance)
    roots = tuple(w.load.name for w in balance.wrenches if is_unknown(w.load))
    for w in balance.wrenches:
        rows.load(w, *_share(w, position.arithmetic, roots, column, scale))
    for n, rub in enumerate(rubs):
        rows.rub(ties[rub.tie], rub, column + 1 + len(roots) + n)
    general = _eliminated(rows.all(), column, position)
    return Statics(
        tuple(ties),
        position.ropes,
        tuple(first),
        column,
        roots,
        tuple(rubs),
        scale,
        general,
        position.arithmetic,
    )


def _eliminated(rows: list[Row], columns: int, position: Position) -> General:
    """The elimination in which as many equations lose all joints as the links have motions.

    Where the rounding of floats hides that number, it is looked for a little above and below.
    """
    mobility, vanishes = position.mobility, decider(position.arithmetic)
    tries = [eliminate(rows, columns, vanishes=vanishes)]
    if vanishes is not None:
        return tries[0]
    for spent in SPENT_TRIES:
        if len(tries[-1].left) == mobility:
            return tries[-1]
        tries.append(eliminate(rows, columns, spent))
    return tries[-1] if len(tries[-1].left) == mobility else tries[0]


UNIQUE = 1e-9
"""In floats a share below this fraction of the largest is rounding."""
SPENT_TRIES = (1e-12, 1e-11, 1e-10, 1e-14, 1e-15)


def _share(
    w: Wrench, arithmetic: Arithmetic, roots: Sequence[str], known: int, scale: float
) -> tuple[int, Scalar]:
    """The parameter that a load's number belongs to, and its factor."""
    if w.root in roots:
        return known + 1 + roots.index(w.root), w.ratio
    return known, number_of(w, arithmetic) * scale * w.ratio


class _BodyRows:
    """Three equations a link: forces along x and y, moments about the link's first point."""

    def __init__(self, position: Position, ties: Iterable[Tie]) -> None:
        self.position = position
        self.about: dict[str, Point] = {}
        for tie in ties:
            self.about.setdefault(tie.by, tie.at)
            self.about.setdefault(tie.on, tie.at)
        for rope in position.ropes:
            for part in rope.parts:
                for link in filter(None, part.links):
                    self.about.setdefault(link, part.at)
        self.about.pop(position.case.ground, None)
        self.rows: dict[str, tuple[Row, Row, Row]] = {link: ({}, {}, {}) for link in self.about}

    def between(self, tie: Tie, unit: Force, column: int) -> None:
        """A unit on the tie's second link, the opposite on its first."""
        self.add(tie.on, tie.at, unit, column)
        self.add(tie.by, tie.at, (-unit[0], -unit[1], -unit[2]), column)

    def tie(self, tie: Tie, n: int, column: int) -> None:
        """A unit of a tie, on the rotor of a screw too."""
        self.between(tie, tie.units[n], column)
        if tie.screw is not None and tie.couples[n]:
            self.add(tie.screw.rotor, tie.at, (0.0, 0.0, tie.couples[n]), column)

    def rub(self, tie: Tie, rub: Rub, column: int) -> None:
        """A unit of friction."""
        self.between(tie, rub.unit, column)
        if tie.screw is not None and rub.spin:
            self.add(tie.screw.rotor, tie.at, (0.0, 0.0, rub.spin), column)

    def rope(self, tie: RopeTie, column: int) -> None:
        """The pull of every part of a rope on both of its links (of the last, on the free end)."""
        for k, part in enumerate(tie.parts):
            at, (x, y, couple) = tie.unit(k)
            self.add(part.links[0], at, (x, y, couple), column)
            self.add(part.links[1] or tie.rope.end, at, (-x, -y, -couple), column)

    def load(self, w: Wrench, column: int, factor: Scalar) -> None:
        """A load on its link, the opposite on the link against which it acts."""
        gain = w.gain * w.measure * factor
        x, y, couple = (gain * u for u in (w.unit[1], 0.0 - w.unit[0], w.unit[2]))
        place = place_of(w.load, self.position.points, self.position.arithmetic)
        at, unit = (place, (x, y, 0.0)) if place else ((0.0, 0.0), (0.0, 0.0, couple))
        self.add(w.load.link, at, unit, column)
        self.add(w.against, at, (-unit[0], -unit[1], -unit[2]), column)

    def add(self, link: str, at: Point, force: Force, column: int) -> None:
        """A force and couple at a point of a link."""
        if link not in self.rows:
            return
        x, y, couple = force
        px, py = at[0] - self.about[link][0], at[1] - self.about[link][1]
        for row, value in zip(self.rows[link], (x, y, couple + px * y - py * x), strict=True):
            row[column] = row.get(column, 0.0) + value

    def all(self) -> list[Row]:
        """The equations of all links."""
        return [row for link in self.rows.values() for row in link]


def terms_of(
    position: Position, statics: Statics, balance: Balance, parameters: Mapping[int, Scalar]
) -> Terms:
    """What the equations of every link are summed from, in the solution with these parameters."""
    x = statics.filled(parameters)
    equations = equations_of(position, statics, balance)
    return {link: (about, _summed(three, x)) for link, (about, three) in equations.items()}


def equations_of(position: Position, statics: Statics, balance: Balance) -> Equations:
    """The equations of every link, by the columns of the statics."""
    rows = _BodyRows(position, statics.ties)
    for t, tie in enumerate(statics.ties):
        for n in range(len(tie.units)):
            rows.tie(tie, n, statics.first[t] + n)
    for n, rope in enumerate(statics.ropes):
        rows.rope(rope, statics.tension(n))
    for w in balance.wrenches:
        rows.load(w, *_share(w, position.arithmetic, statics.roots, statics.known, statics.scale))
    for n, rub in enumerate(statics.rubs):
        rows.rub(statics.ties[rub.tie], rub, statics.rub(n))
    return {link: (rows.about[link], three) for link, three in rows.rows.items()}


def _summed(rows: tuple[Row, Row, Row], x: Mapping[int, Scalar]) -> tuple[tuple[float, float], ...]:
    """Size and sum of each equation; a moment is as uncertain as the forces on the figure's size."""
    terms = [[float(a * x[c]) for c, a in row.items()] for row in rows]
    sizes = [sum(map(abs, row)) for row in terms]
    return tuple(
        (size + (sizes[0] + sizes[1] if n == 2 else 0.0), math.fsum(row))
        for n, (size, row) in enumerate(zip(sizes, terms, strict=True))
    )


def residual(terms: Terms) -> float:
    """What is left of the equilibrium of any link, as a fraction of the largest sum of all; 0 where nothing
    acts.
    """
    sums = [both for _, equations in terms.values() for both in equations]
    largest = max((size for size, _ in sums), default=0.0)
    return max((abs(rest) for _, rest in sums), default=0.0) / (largest or 1.0)


Terms = dict[str, tuple[Point, tuple[tuple[float, float], ...]]]
"""For each link the point of its moments; of its equations the sum of absolute terms, and the sum."""
Equations = dict[str, tuple[Point, tuple[Row, Row, Row]]]
"""For each link the point of its moments, and its three equations."""


AGREE = 1e-9
"""Power and free bodies may differ by this fraction of the largest term, or by the bound if that is more."""
ROUNDINGS = 32 * 2.0**-53
"""What the operations from a point to a term of an equation can lose together, of the term."""


def unknowns_of(statics: Statics, friction: Mapping[int, float] | None = None) -> dict[str, Scalar] | None:
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


def bounds_of(position: Position, statics: Statics, balance: Balance, terms: Terms) -> dict[str, float]:
    """What rounding can make of the difference between power and free bodies, by unknown load [case units].

    The residual of every equation, and the rounding of its terms, does power on the motions; divided by
    the power of a unit of the unknown that is its error (the motions are the adjoint solution). inf where the
    motions do not determine the loads.
    """
    columns = [[n for n, w in enumerate(balance.wrenches) if w.root == root] for root in statics.roots]
    rows = []
    for m, factors in enumerate(balance.factors):
        both = zip(balance.wrenches, factors, strict=True)
        powers = [float(w.ratio) * float(f) * w.measure for w, f in both]
        row = [sum(powers[n] for n in ns) for ns in columns]
        rows.append([*row, _lost(position, terms, m)])
    rows = independent(rows, len(columns))
    by_motion = inverse([row[:-1] for row in rows]) if len(rows) == len(columns) else None
    if by_motion is None:
        return dict.fromkeys(statics.roots, float("inf"))
    lost = [row[-1] / statics.scale for row in rows]
    sums = [sum(abs(a) * p for a, p in zip(row, lost, strict=True)) for row in by_motion]
    return dict(zip(statics.roots, sums, strict=True))


def _lost(position: Position, terms: Terms, motion: int) -> float:
    """Power of the residuals and of the roundings of all equations on a motion."""
    lost = 0.0
    for link, (about, equations) in terms.items():
        twist = position.twists[link][motion]
        vx, vy = velocity(twist, about)
        for speed, (size, rest) in zip((vx, vy, twist[2]), equations, strict=True):
            lost += abs(speed) * (ROUNDINGS * size + abs(rest))
    return lost


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
