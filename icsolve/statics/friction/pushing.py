"""What friction within its limits can do, contacts that only push, and ropes that slip and only pull: linear
inequalities by parts, and the ranges of one unknown load in which they hold.

Equilibrium leaves the frictions open, and what redundant joints share. Each friction is at most its
coefficient times the force that presses, and a contact's force is not less than zero; nor is the pull of a
rope, and beside a place where it slips neither part pulls with more than exp(mu beta) times the other. Where
the senses in which guides press are given, and whereto the forces of pins point, these are linear
inequalities: what keeps them is a part of what can be, and so are they, nearly, where the force of a pin lies
within an angle: all that can be is in it. Guides are taken in either sense, and angles are cut, until every
such part lies in ranges that hold.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import product
from typing import TYPE_CHECKING

from icsolve.errors import SceneError, Status
from icsolve.numbers import Scalar, Showing, all_vanish, decider, largest_of, zero_of
from icsolve.numbers.inequalities import Form
from icsolve.numbers.linear import Row, eliminate
from icsolve.statics.equilibrium import Action, Rub, Statics, actions_of, columns_of, solve_statics
from icsolve.statics.friction import rubs_of
from icsolve.statics.friction.equations import combined
from icsolve.statics.power import Balance
from icsolve.statics.reaction_basis import Position, Tie, meshes, slipping, ties_of, with_flanks
from icsolve.statics.witness import refuse_doubt
from icsolve.tuples import LateModule, NamedTuple, Protocol, TypeVar

if TYPE_CHECKING:
    from icsolve.screws import ropes as rope_screws
else:
    rope_screws = LateModule("icsolve.screws.ropes")

T = TypeVar("T")
MOST_FLANKS = 6
"""More meshes have too many combinations of flanks."""
ROUNDED = 2.0**-44
"""What is left of terms that cancel, as a fraction of them, is rounding."""


class AsksStatics(Protocol):
    """Asks a question of a scene in the numbers that settle it."""

    def __call__(self, question: Callable[[Position, Balance, Showing], T]) -> T:
        """The answer; SceneError where no digits do."""


class RestingScene(NamedTuple):
    """A scene whose loads are all known: in floats, and what asks the same in numbers that settle it."""

    position: Position
    balance: Balance
    ask: AsksStatics


class RubLimit(NamedTuple):
    """A rub: the one or two components of the force that presses, times the coefficient, and its friction."""

    tie: int
    forces: tuple[Row, ...]
    friction: Row


class FrictionLimits(NamedTuple):
    """What bounds friction, as combinations of what is open (frictions, shares) and of the known loads.

    Attributes
    ----------
    known, root : the columns of the known loads and of the unknown one; None where there is none
    scale : of these loads, times their number in case units
    free : columns that say how joints share
    equations : each is zero
    normals : of each contact, by its tie, not less than zero
    rows : each is not less than zero, beside those
    rubs : all of them
    """

    known: int
    root: int | None
    scale: float
    free: tuple[int, ...]
    equations: tuple[Row, ...]
    normals: Mapping[int, Row]
    rows: tuple[Row, ...]
    rubs: tuple[RubLimit, ...]

    def each(self, change: Callable[[Row], Row]) -> FrictionLimits:
        """With every combination changed."""
        rubs = (rub._replace(forces=tuple(map(change, rub.forces))) for rub in self.rubs)
        return self._replace(
            equations=tuple(map(change, self.equations)),
            normals={t: change(row) for t, row in self.normals.items()},
            rows=tuple(map(change, self.rows)),
            rubs=tuple([rub._replace(friction=change(rub.friction)) for rub in rubs]),
        )

    def without(self, lost: frozenset[int]) -> FrictionLimits:
        """The same where some contacts carry nothing."""
        gone = [row for t, row in self.normals.items() if t in lost]
        gone += [rub.friction for rub in self.rubs if rub.tie in lost]
        return self._replace(
            equations=(*self.equations, *gone),
            normals={t: row for t, row in self.normals.items() if t not in lost},
            rubs=tuple([rub for rub in self.rubs if rub.tie not in lost]),
        )

    @property
    def pushing(self) -> tuple[Pointing | None, ...]:
        """Whereto the forces that press point: contacts push, all else is open."""
        return tuple([SENSES[0] if rub.tie in self.normals else None for rub in self.rubs])


def limits_of(position: Position, balance: Balance, flanks: Mapping[int, float]) -> FrictionLimits:
    """The limits in the arithmetic of a position, with teeth that carry on these flanks."""
    still = slipping(position, ((0.0,) * (len(rope.parts) - 1) for rope in position.ropes))
    ties = with_flanks(still, ties_of(still), flanks)
    statics, slips = with_slips(still, ties, balance, rubs_of(still, ties))
    refuse_doubt(len(statics.general.left), position.mobility)
    equations, rubs = list(statics.general.left), list[RubLimit]()
    for k, rub in enumerate(statics.rubs):
        own: Row = {statics.rub(k): 1.0}
        if not rub.limit:
            equations.append(own)
            continue
        forces = (combined(statics, rub.tie, row) for row in rub.normal)
        rubs.append(
            RubLimit(rub.tie, tuple({c: a * rub.limit for c, a in row.items()} for row in forces), own)
        )
    normals = {t: combined(statics, t, (1.0,)) for t, tie in enumerate(ties) if tie.joint.only_pushes}
    rows = [*pulls_of(statics), *(row for slip in slips for row in between_pulls(statics, slip))]
    rows += [combined(statics, t, (1.0,)) for t in flanks]
    root = statics.root(0) if statics.roots else None
    which = statics.known, root, statics.scale, statics.general.free
    return FrictionLimits(*which, tuple(equations), normals, tuple(rows), tuple(rubs))


def every_flanks(scene: RestingScene) -> Iterator[Mapping[int, float]]:
    """The flanks on which the teeth of meshes may carry, in turn.

    Raises SceneError where they are too many.
    """
    teeth = meshes(ties_of(scene.position))
    if len(teeth) > MOST_FLANKS:
        raise SceneError(Status.UNSUPPORTED, TOO_MANY)
    for flanks in product((1.0, -1.0), repeat=len(teeth)):
        yield dict(zip(teeth, flanks, strict=True))


TOO_MANY = "too many joints rub in which more than one sense of what presses would have to be tried."


def limits_in_floats(scene: RestingScene, flanks: Mapping[int, float]) -> FrictionLimits:
    """In floats: those of balls, rounded, without what may be none."""
    with suppress(SceneError):  # what no digits decide is left to rounding
        exact = scene.ask(lambda position, balance, _: limits_of(position, balance, flanks))
        return exact.each(lambda row: {c: float(a) for c, a in row.items() if getattr(a, "is_certain", a)})

    def cleared(row: Row) -> Row:
        least = ROUNDED * largest_of(row.values())
        return {c: a for c, a in row.items() if abs(a) > least}

    return limits_of(scene.position, scene.balance, flanks).each(cleared)


class Pointing(NamedTuple):
    """Whereto the force that presses at a rub points: along the positive sense or the other (``half`` is 0),
    or within an angle to both sides of a direction [rad]."""

    middle: float
    half: float = 0.0

    def cut(self, at: float) -> tuple[Pointing, ...]:
        """The two parts of an angle beside a direction in it, neither much narrower than the other."""
        off = math.remainder(at - self.middle, 2.0 * math.pi)
        off = max(-LEAST * self.half, min(off, LEAST * self.half))
        low, high = 0.5 * (self.half + off), 0.5 * (self.half - off)
        return Pointing(self.middle - self.half + low, low), Pointing(self.middle + self.half - high, high)


LAPPED = 1.01
"""Angles lap over one another, so that rounding loses no force that points along an end of two, and is not
taken for one that points beyond."""
LEAST = 0.9
"""A cut leaves the narrower of two parts a twentieth of an angle."""
SENSES = (Pointing(1.0), Pointing(-1.0))


ReducedRow = tuple[Form, float, int | None]
"""What is not less than zero, whether its depth counts (1.0), and the rub that it limits."""


class ReducedLimits:
    """The limits in floats, in variables that the equations leave open."""

    def __init__(self, limits: FrictionLimits) -> None:
        self.limits = limits
        every = [*limits.equations, *every_row(limits)]
        root: Row = {} if limits.root is None else {limits.root: 1.0}
        columns = sorted({c for row in (*every, root) for c in row} - {limits.known})
        self.place = {c: n for n, c in enumerate([*columns, limits.known])}
        self.last = len(columns)
        self.general = eliminate([self._placed(row) for row in limits.equations], self.last)
        size = largest_of([row.get(limits.known, 0.0) for row in every])
        left = (row.get(self.last, 0.0) for row in self.general.left)
        self.balances = all(abs(a) <= ROUNDED * size for a in left)
        self.open = [n for n in range(self.last) if n not in self.general.solved]
        self.units = [1.0] * len(self.open)
        sizes = zip(*(self.form(row)[1:] for row in every_row(limits)), strict=True)
        self.units = [1.0 / (largest_of(own) or 1.0) for own in sizes]
        self.rubs = [tuple(map(self.form, (*rub.forces, rub.friction))) for rub in limits.rubs]
        self.sizes = [largest_of([a for form in rub for a in form]) or 1.0 for rub in self.rubs]
        self.always = [(self.form(row), 1.0, None) for row in (*limits.normals.values(), *limits.rows)]
        self.bounds: dict[tuple[int, Pointing | None], list[ReducedRow]] = {}

    def _placed(self, row: Row) -> Row:
        return {self.place[c]: a for c, a in row.items()}

    def form(self, row: Row) -> Form:
        """A combination by the known loads and the open variables, in units that make these compare."""
        terms: dict[int, list[float]] = {}
        for c, a in self._placed(row).items():
            for d, b in self.general.of(c).items():
                terms.setdefault(d, []).append(a * b)
        sums = {d: sum_of(own) for d, own in terms.items()}
        open_ = zip(self.open, self.units, strict=True)
        return (sums.get(self.last, 0.0), *(sums.get(n, 0.0) * unit for n, unit in open_))

    def rows(self, toward: Sequence[Pointing | None]) -> list[ReducedRow]:
        """`rows_of` in these variables; what parts have in common is worked out once."""
        found: list[ReducedRow] = [*self.always]
        for key in enumerate(toward):
            if key not in self.bounds:
                self.bounds[key] = [
                    (self.form(row), many, of) for row, many, of in bounds_of(self.limits, *key)
                ]
            found += self.bounds[key]
        return found

    def spare(self, k: int, point: Sequence[float]) -> float:
        """How far a friction is from its limit at a point (w, x), whereto its force may point there."""
        *forces, friction = self.rubs[k]
        return (math.hypot(*(at(form, point) for form in forces)) - abs(at(friction, point))) / self.sizes[k]

    def cut(self, k: int, to: Pointing | None, point: Sequence[float]) -> tuple[Pointing, ...]:
        """Whereto the force of a rub may point, cut: a guide's in either sense, a pin's within narrower
        angles, that end where it points at a point (w, x): there they say of it what is so."""
        x, *y = (at(form, point) for form in self.rubs[k][:-1])
        if not y:
            return SENSES
        here = math.atan2(y[0], x)
        if to is not None:
            return to.cut(here)
        third = math.pi / 3.0
        return tuple([Pointing(here + n * third, third) for n in (1, 3, 5)])

    def toward(self, part: Sequence[Pointing | None], point: Sequence[float]) -> tuple[Pointing | None, ...]:
        """Whereto the forces that press point at a point (w, x) of a part; as this where one is none."""
        found = list(part)
        for k, (*forces, _) in enumerate(self.rubs):
            to, (x, *y) = found[k], [at(form, point) for form in forces]
            if to is None and not y:
                found[k] = Pointing(math.copysign(1.0, x))
            elif y and (to is None or to.half):
                none = math.hypot(x, *y) <= ROUNDED * self.sizes[k]
                found[k] = Pointing(to.middle if none and to else math.atan2(y[0], x))
        return tuple(found)


def every_row(limits: FrictionLimits) -> Iterator[Row]:
    yield from (*limits.normals.values(), *limits.rows)
    for rub in limits.rubs:
        yield from (*rub.forces, rub.friction)


def sum_of(terms: Sequence[float]) -> float:
    """A sum, zero where that is rounding."""
    total = sum(terms)
    return total if abs(total) > ROUNDED * largest_of(terms) else 0.0


def at(form: Form, point: Sequence[float]) -> float:
    """The value of a form at a point (w, x)."""
    return sum(a * x for a, x in zip(form, point, strict=True))


def rows_of(
    limits: FrictionLimits, toward: Sequence[Pointing | None]
) -> Iterator[tuple[Row, float, int | None]]:
    """What is not less than zero in a part, whether its depth counts (1.0), and the rub that it limits."""
    for row in (*limits.normals.values(), *limits.rows):
        yield row, 1.0, None
    for k, to in enumerate(toward):
        yield from bounds_of(limits, k, to)


def bounds_of(limits: FrictionLimits, k: int, to: Pointing | None) -> Iterator[tuple[Row, float, int | None]]:
    """Those of one rub."""
    _, forces, friction = limits.rubs[k]
    if to is None:
        return
    shares = [to.middle] if len(forces) == 1 else [math.cos(to.middle), math.sin(to.middle)]
    if to.half:
        wide = LAPPED * to.half
        far = math.cos(wide)
        shares = [math.cos(to.middle) / far, math.sin(to.middle) / far]
        for end, side in ((to.middle - wide, 1.0), (to.middle + wide, -1.0)):
            yield _summed(forces, (-side * math.sin(end), side * math.cos(end))), 0.0, None
    for side in (1.0, -1.0):
        yield _summed((*forces, friction), (*shares, side)), 1.0, k


def _summed(rows: Sequence[Row], shares: Sequence[float]) -> Row:
    total: Row = {}
    for row, share in zip(rows, shares, strict=True):
        for c, a in row.items():
            total[c] = total.get(c, 0.0) + a * share
    return total


def value_where(
    limits: FrictionLimits, rows: Sequence[Row], of: Sequence[int], column: int, a: Showing
) -> Scalar | None:
    """What a column has where some rows are equations, in the numbers of the limits (balls); None where they
    hang on each other, or do not say.

    Raises MoreDigits where the balls leave that open.
    """
    chosen = [*limits.equations, *(rows[n] for n in of)]
    columns = sorted({c for row in (*rows, *limits.equations) for c in row} - {column, limits.known})
    place, count = {c: n for n, c in enumerate([*columns, column, limits.known])}, len(columns)
    whole = [{place[c]: x for c, x in row.items()} for row in chosen]
    left = eliminate(whole, count, vanishes=decider(a)).left
    both = [(row.get(count, 0.0), row.get(count + 1, 0.0)) for row in left]
    said = [one for one in both if getattr(one[0], "is_certain", bool(one[0]))]
    if len(said) != 1:
        return None
    ((factor, known),) = said
    zero = all_vanish(a, [(known, largest_of([row.get(count + 1, 0.0) for row in whole]))])
    return (zero_of(known) if zero else known) / (0.0 - factor)


def vanishes_where(
    limits: FrictionLimits, rows: Sequence[Row], of: Sequence[int], force: Row, a: Showing
) -> bool:
    """Whether a combination is none where some rows are equations; raises as `value_where` does."""
    column = 1 + max(limits.known, *(c for row in (*rows, *limits.equations) for c in row))
    with_it = limits._replace(equations=(*limits.equations, {**force, column: -1.0}))
    value = value_where(with_it, rows, of, column, a)
    return value is not None and not float(value)


# --- ropes --------------------------------------------------------------------------------------------


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
