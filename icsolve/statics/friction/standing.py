"""Whether friction holds loads that are all known, however many freedoms there are, and however redundant
contacts share the loads.

Equilibrium leaves the frictions open, and what redundant joints share. Each friction is at most its
coefficient times the force that presses, contacts only push, ropes only pull. Where the senses in which
guides and teeth press are given these are linear inequalities, and so are they, nearly, where the force of
a pin lies in a narrow angle. The loads are held where one point keeps all of them; how far from zero the
least can be there is how far they are from slipping. Guides are looked at in either sense, and angles are cut
until they say enough.

Redundant joints may be pressed together by their fit alone, as a block is between two walls: then friction
holds as much as that makes it. Where it holds without one of those contacts too, fit has no part in it.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import product
from typing import TypeVar

from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import Showing, decider, largest_of
from icsolve.numbers.inequalities import Form, deepest
from icsolve.numbers.linear import Row, eliminate
from icsolve.statics.friction.equations import combined
from icsolve.statics.friction.interface import rubs_of, shared
from icsolve.statics.friction.pushing import between_pulls, pulls_of, with_slips
from icsolve.statics.power import Balance
from icsolve.statics.reaction_basis import Position, meshes, slipping, ties_of, with_flanks
from icsolve.statics.witness import refuse_doubt
from icsolve.tuples import NamedTuple, Protocol

T = TypeVar("T")


class AsksStatics(Protocol):
    """Asks a question of a scene in the numbers that settle it."""

    def __call__(self, question: Callable[[Position, Balance, Showing], T]) -> T:
        """The answer; SceneError where no digits do."""


class RestingScene(NamedTuple):
    """A scene whose loads are all known: in floats, and what asks the same in numbers that settle it."""

    position: Position
    balance: Balance
    ask: AsksStatics


MOST_FLANKS = 6
"""More meshes have too many combinations of flanks."""
MOST_PARTS = 2000
"""So many parts of what guides and pins can do are looked at at most."""
ROUNDED = 2.0**-44
"""What is left of terms that cancel, as a fraction of them, is rounding."""


class Standing(NamedTuple):
    """Whether known loads are held.

    Attributes
    ----------
    depth : how far they are from slipping, as a share of the forces that bound friction; negative where they
        do slip
    error : bound of its error
    shared : whether equilibrium leaves open how the joints share the load: it holds where they share it so
    """

    depth: float
    error: float
    shared: bool


class RubLimit(NamedTuple):
    """A rub: the one or two components of the force that presses, times the coefficient, and its friction."""

    tie: int
    forces: tuple[Row, ...]
    friction: Row


class FrictionLimits(NamedTuple):
    """What bounds friction, as combinations of what is open (frictions, shares) and of the known loads.

    Attributes
    ----------
    known : the column of the known loads
    free : columns that say how joints share
    equations : each is zero
    normals : of each contact, by its tie, not less than zero
    rows : each is not less than zero, beside those
    rubs : all of them
    """

    known: int
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
    return FrictionLimits(
        statics.known, statics.general.free, tuple(equations), normals, tuple(rows), tuple(rubs)
    )


class Pressed(NamedTuple):
    """Joints that their fit may press together: at one that rubs, and the contacts that push then."""

    tie: int
    contacts: tuple[int, ...]


def standing(scene: RestingScene) -> Standing:
    """How far loads that are all known are from slipping.

    Raises SceneError where that hangs on how hard the fit of the joints presses them together, and where it
    is too much to look at.
    """
    ties = ties_of(scene.position)
    teeth = meshes(ties)
    if len(teeth) > MOST_FLANKS:
        raise SceneError(Status.UNSUPPORTED, TOO_MANY)
    found = []
    for flanks in product((1.0, -1.0), repeat=len(teeth)):
        on = dict(zip(teeth, flanks, strict=True))
        found.append(_standing(scene, on, _limits(scene, on), frozenset()))
    sure = max((one for one in found if isinstance(one, Standing)), key=lambda one: one.depth, default=None)
    fitted = next((one for one in found if isinstance(one, Pressed)), None)
    if fitted is not None and (sure is None or sure.depth < 0.0):
        raise SceneError(Status.UNSUPPORTED, shared(ties[fitted.tie], ties))
    assert sure is not None
    return sure


TOO_MANY = "too many joints rub in which more than one sense of what presses would have to be tried."


def _limits(scene: RestingScene, flanks: Mapping[int, float]) -> FrictionLimits:
    """In floats: those of balls, rounded."""
    with suppress(SceneError):  # what no digits decide is left to rounding
        exact = scene.ask(lambda position, balance, _: limits_of(position, balance, flanks))
        return exact.each(lambda row: {c: float(a) for c, a in row.items()})
    return limits_of(scene.position, scene.balance, flanks)


def _standing(
    scene: RestingScene, flanks: Mapping[int, float], limits: FrictionLimits, lost: frozenset[int]
) -> Standing | Pressed:
    """With some contacts lost; where it holds only as the fit of the others presses them together, these."""
    own = limits.without(lost)
    part, open_ = _deepest_part(own), _is_shared(own)
    depth, error = (part.depth, ROUNDED) if part.depth < 0.0 else (part.sure, part.depth - part.sure)
    if part.of and depth == part.depth:
        with suppress(SceneError):
            depth, error = scene.ask(
                lambda position, balance, a: _exactly(
                    limits_of(position, balance, flanks).without(lost), part, a
                )
            )
    if abs(depth) <= error:  # no digits tell it from the limit
        depth = 0.0
    found = Standing(depth, error, open_)
    pressed = _pressed_by_fit(own) if depth >= 0.0 and open_ else None
    if pressed is None:
        return found
    without = (_standing(scene, flanks, limits, lost | {tie}) for tie in pressed.contacts)
    held = (one for one in without if isinstance(one, Standing) and one.depth >= 0.0)
    return next(held, pressed)


# --- the deepest point ------------------------------------------------------------------------------


class Pointing(NamedTuple):
    """Whereto the force that presses at a rub points: along the positive sense or the other (``half`` is 0),
    or within an angle to both sides of a direction [rad]."""

    middle: float
    half: float = 0.0

    def halves(self) -> tuple[Pointing, ...]:
        """The two halves of an angle."""
        quarter = 0.5 * self.half
        return Pointing(self.middle - quarter, quarter), Pointing(self.middle + quarter, quarter)


LAPPED = 1.01
"""Angles lap over one another, so that rounding loses no force that points along an end of two."""
SENSES = (Pointing(1.0), Pointing(-1.0))
CIRCLE = tuple([Pointing(2.0 * math.pi * k / 3.0, math.pi / 3.0) for k in range(3)])


class ForcePart(NamedTuple):
    """A part of what guides and pins can do, and how deep it is.

    Attributes
    ----------
    toward : of each rub whereto its force points; None where that is open
    depth : at most so deep
    sure : at least so deep, at a point
    of : the places of the rows that set the depth
    sizes : of all rows, 0.0 of those whose depth does not count
    worst : the rub that is the least deep there, for which its force is to be told closer; None where none is
    """

    toward: tuple[Pointing | None, ...]
    depth: float
    sure: float
    of: tuple[int, ...]
    sizes: tuple[float, ...]
    worst: int | None


def _deepest_part(limits: FrictionLimits) -> ForcePart:
    """The deepest part; the first that is looked at where it is found to be less than nothing.

    Raises SceneError where that takes too many parts.
    """
    reduced = _Reduced(limits)
    pushes = [SENSES[0] if rub.tie in limits.normals else None for rub in limits.rubs]
    parts = [(-one.depth, 0, one) for one in [reduced.part(tuple(pushes))]]
    for made in range(MOST_PARTS):
        _, _, part = heapq.heappop(parts)
        if part.worst is None or part.depth < -ROUNDED:
            return part
        k, to = part.worst, part.toward[part.worst]
        whole = SENSES if len(limits.rubs[k].forces) == 1 else CIRCLE
        for n, half in enumerate(whole if to is None else to.halves()):
            one = reduced.part((*part.toward[:k], half, *part.toward[k + 1 :]))
            heapq.heappush(parts, (-one.depth, 3 * made + n + 1, one))
    raise SceneError(Status.UNSUPPORTED, TOO_MANY)


class _Reduced:
    """The limits in floats, in variables that the equations leave open."""

    def __init__(self, limits: FrictionLimits) -> None:
        self.limits = limits
        every = [*limits.equations, *_every(limits)]
        columns = sorted({c for row in every for c in row} - {limits.known})
        self.place = {c: n for n, c in enumerate([*columns, limits.known])}
        self.last = len(columns)
        self.general = eliminate([self._placed(row) for row in limits.equations], self.last)
        size = largest_of([row.get(limits.known, 0.0) for row in every])
        left = (row.get(self.last, 0.0) for row in self.general.left)
        self.balances = all(abs(a) <= ROUNDED * size for a in left)
        self.open = [n for n in range(self.last) if n not in self.general.solved]
        self.units = [1.0] * len(self.open)
        sizes = zip(*(self.form(row)[1:] for row in _every(limits)), strict=True)
        self.units = [1.0 / (largest_of(own) or 1.0) for own in sizes]
        self.rubs = [tuple(map(self.form, (*rub.forces, rub.friction))) for rub in limits.rubs]
        self.sizes = [largest_of([a for form in rub for a in form]) or 1.0 for rub in self.rubs]

    def _placed(self, row: Row) -> Row:
        return {self.place[c]: a for c, a in row.items()}

    def form(self, row: Row) -> Form:
        """A combination by the known loads and the open variables, in units that make these compare."""
        terms: dict[int, list[float]] = {}
        for c, a in self._placed(row).items():
            for d, b in self.general.of(c).items():
                terms.setdefault(d, []).append(a * b)
        sums = {d: _sum(own) for d, own in terms.items()}
        open_ = zip(self.open, self.units, strict=True)
        return (sums.get(self.last, 0.0), *(sums.get(n, 0.0) * unit for n, unit in open_))

    def part(self, toward: tuple[Pointing | None, ...]) -> ForcePart:
        """How deep a part is."""
        if not self.balances:
            return ForcePart(toward, -math.inf, -math.inf, (), (), None)
        rows = list(_rows(self.limits, toward))
        forms = [self.form(row) for row, *_ in rows]
        sizes = [
            counts * (largest_of(form) if k is None else self.sizes[k])
            for form, (_, counts, k) in zip(forms, rows, strict=True)
        ]
        kept = [n for n, form in enumerate(forms) if any(form)]
        nothing = (1.0, *[0.0] * len(self.open))  # says no more than how deep the deepest is
        deep = [tuple([a / (sizes[n] or largest_of(forms[n])) for a in forms[n]]) for n in kept]
        depth, of, point, _ = deepest([*deep, nothing], [*(rows[n][1] for n in kept), 1.0])
        kept_by = tuple([kept[n] for n in of if n < len(kept)])
        spare = {k: self.spare(k, point) for k, to in enumerate(toward) if to is None or to.half}
        sure = min((depth, *spare.values()))
        short = [k for k, left in spare.items() if left < depth - ROUNDED]
        worst = min(short, key=lambda k: (toward[k] is not None, spare[k]), default=None)
        if 2.0 * sure > depth > 0.0 and all(toward[k] for k in short):
            worst = None  # angles that are narrower would not say other
        return ForcePart(toward, depth, sure, kept_by, tuple(sizes), worst)

    def spare(self, k: int, point: Sequence[float]) -> float:
        """How far a friction is from its limit at a point, whereto its force may point there."""
        *forces, friction = self.rubs[k]
        force = math.hypot(*(_at(form, point) for form in forces))
        return (force - abs(_at(friction, point))) / self.sizes[k]


def _every(limits: FrictionLimits) -> Iterator[Row]:
    yield from (*limits.normals.values(), *limits.rows)
    for rub in limits.rubs:
        yield from (*rub.forces, rub.friction)


def _sum(terms: Sequence[float]) -> float:
    """A sum, zero where that is rounding."""
    total = sum(terms)
    return total if abs(total) > ROUNDED * largest_of(terms) else 0.0


def _at(form: Form, point: Sequence[float]) -> float:
    return form[0] + sum(a * x for a, x in zip(form[1:], point, strict=True))


def _rows(
    limits: FrictionLimits, toward: Sequence[Pointing | None]
) -> Iterator[tuple[Row, float, int | None]]:
    """What is not less than zero in a part, whether its depth counts (1.0), and the rub that it limits."""
    for row in (*limits.normals.values(), *limits.rows):
        yield row, 1.0, None
    for k, ((_, forces, friction), to) in enumerate(zip(limits.rubs, toward, strict=True)):
        if to is None:
            continue
        shares = [to.middle]
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


def _exactly(limits: FrictionLimits, part: ForcePart, a: Showing) -> tuple[float, float]:
    """The depth of a part, where its rows are equations, in the numbers of the limits (balls), and its bound.

    Raises MoreDigits where the balls leave that open.
    """
    rows = [row for row, *_ in _rows(limits, part.toward)]
    columns = sorted({c for row in (*rows, *limits.equations) for c in row} - {limits.known})
    place = {c: n for n, c in enumerate([*columns, limits.known])}
    depth, known = len(place), len(place) - 1
    whole = [{place[c]: x for c, x in row.items()} for row in limits.equations]
    for n in part.of:
        whole.append({**{place[c]: x for c, x in rows[n].items()}, depth: 0.0 - part.sizes[n]})
    left = [row for row in eliminate(whole, known, vanishes=decider(a)).left if row]
    count = left[0].get(depth, 0.0) if len(left) == 1 else 0.0  # several: the rows hang on each other
    if not getattr(count, "is_certain", bool(count)):
        return part.depth, ROUNDED
    value = left[0].get(known, 0.0) / (0.0 - count)
    if a.vanishes(value, largest_of([row.get(known, 0.0) for row in whole])):
        return 0.0, 0.0
    return a.rounded(value)


# --- what redundant joints share --------------------------------------------------------------------


def _is_shared(limits: FrictionLimits) -> bool:
    """Whether what bounds friction hangs on how joints share the load."""
    bounds = [*limits.normals.values(), *limits.rows, *(row for rub in limits.rubs for row in rub.forces)]
    sizes = ((row, largest_of(row.values())) for row in bounds)
    return any(abs(row.get(c, 0.0)) > ROUNDED * size for row, size in sizes for c in limits.free)


def _pressed_by_fit(limits: FrictionLimits) -> Pressed | None:
    """Joints that rub, pressed together without any load or friction; None where none can be."""
    bare = limits.each(lambda row: {c: a for c, a in row.items() if c in limits.free})
    reduced = _Reduced(bare)
    least = [reduced.form(row) for row in (*bare.normals.values(), *bare.rows)]
    for rub in bare.rubs:
        for force, side in product(rub.forces, (1.0, -1.0)):
            form = tuple([side * a for a in reduced.form(force)])
            depth, _, point, _ = deepest([*least, form], [*[0.0] * len(least), 1.0])
            if depth > 0.5:  # a cone: 0 or, however far, the most that is looked for
                pushing = zip(bare.normals, least, strict=False)
                return Pressed(rub.tie, tuple([t for t, own in pushing if _at(own, point) > ROUNDED]))
    return None
