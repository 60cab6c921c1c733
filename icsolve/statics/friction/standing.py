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
from collections.abc import Callable, Mapping
from contextlib import suppress
from itertools import product

from icsolve.errors import SceneError, Status
from icsolve.numbers import Showing, largest_of
from icsolve.numbers.inequalities import deepest
from icsolve.statics.equilibrium import equilibrium
from icsolve.statics.free_bodies import FreeBodies, Solved, told, with_tooth_forces
from icsolve.statics.friction import rubs_of, shared
from icsolve.statics.friction.pushing import (
    ROUNDED,
    TOO_MANY,
    FrictionLimits,
    Pointing,
    ReducedLimits,
    RestingScene,
    at,
    every_flanks,
    limits_in_floats,
    limits_of,
    rows_of,
    value_where,
)
from icsolve.statics.power import Balance
from icsolve.statics.reaction_basis import Position, ties_of
from icsolve.tuples import NamedTuple

MOST_PARTS = 2000
"""So many parts of what guides and pins can do are looked at at most."""


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
    found = []
    for flanks in every_flanks(scene):
        found.append(_standing(scene, flanks, limits_in_floats(scene, flanks), frozenset()))
    sure = max((one for one in found if isinstance(one, Standing)), key=lambda one: one.depth, default=None)
    fitted = next((one for one in found if isinstance(one, Pressed)), None)
    if fitted is not None and (sure is None or sure.depth < 0.0):
        raise shared(ties[fitted.tie], ties)
    assert sure is not None
    return sure


def beyond_friction(scene: RestingScene) -> str:
    """The sentence on what no friction helps where known loads are not held: contacts and ropes that let go,
    and motions that rub nowhere; empty where more friction would hold them."""
    case = scene.position.case
    if any(rope.slips for rope in case.ropes):
        return ""
    for flanks in every_flanks(scene):
        limits = limits_in_floats(scene, flanks)
        if not ReducedLimits(limits._replace(rubs=(), normals={}, rows=())).balances:
            return FREE
        depth, error = _depth(scene, flanks, limits, lambda one: one._replace(rubs=()))
        if depth >= -error:
            return ""
    contacts = any(joint.only_pushes for joint in case.joints)
    return LETS_GO.format("a contact would have to pull" if contacts else "a rope would have to push")


FREE = "However much friction there is, the loads move what rubs nowhere."
LETS_GO = "However much friction there is, {}: the links part there, and tip or lift off."


def held_bodies(position: Position, balance: Balance, a: Showing) -> FreeBodies:
    """The reactions of known loads that friction holds, as far as equilibrium says how much of it acts: at
    rest a joint that rubs carries what acts along it too."""
    bare = ties_of(position)
    rubbing = {rub.tie: rub.unit for rub in rubs_of(position, bare)}
    ties = [
        tie._replace(units=(*tie.units, rubbing[t])) if t in rubbing else tie for t, tie in enumerate(bare)
    ]
    solved = with_tooth_forces(
        position, ties, lambda flanked: Solved(equilibrium(position, flanked, balance), {})
    )
    return told(position, balance, solved, None, a)


def _standing(
    scene: RestingScene, flanks: Mapping[int, float], limits: FrictionLimits, lost: frozenset[int]
) -> Standing | Pressed:
    """With some contacts lost; where it holds only as the fit of the others presses them together, these."""
    own = limits.without(lost)
    open_ = _is_shared(own)
    depth, error = _depth(scene, flanks, limits, lambda one: one.without(lost))
    if abs(depth) <= error:  # no digits tell it from the limit
        depth = 0.0
    found = Standing(depth, error, open_)
    pressed = _pressed_by_fit(own) if depth >= 0.0 and open_ else None
    if pressed is None:
        return found
    without = (_standing(scene, flanks, limits, lost | {tie}) for tie in pressed.contacts)
    held = (one for one in without if isinstance(one, Standing) and one.depth >= 0.0)
    return next(held, pressed)


def _depth(
    scene: RestingScene,
    flanks: Mapping[int, float],
    limits: FrictionLimits,
    change: Callable[[FrictionLimits], FrictionLimits],
) -> tuple[float, float]:
    """How deep the deepest point is within limits that are changed, and the error of that."""

    def exactly(part: ForcePart) -> tuple[float, float]:
        found = (part.depth, ROUNDED) if part.depth < 0.0 else (part.sure, part.depth - part.sure)
        if part.of and found[0] == part.depth:
            with suppress(SceneError):
                return scene.ask(
                    lambda position, balance, a: _exactly(
                        change(limits_of(position, balance, flanks)), part, a
                    )
                )
        return found

    return _deepest(change(limits), exactly)


# --- the deepest point ------------------------------------------------------------------------------


class ForcePart(NamedTuple):
    """A part of what guides and pins can do, and how deep it is.

    Attributes
    ----------
    toward : of each rub whereto its force points; None where that is open
    depth : at most so deep
    sure : at least so deep, at a point
    of : the places of the rows that set the depth
    sizes : of all rows, 0.0 of those whose depth does not count
    point : (w, x), the deepest
    worst : the rub that is the least deep there, for which its force is to be told closer; None where none is
    """

    toward: tuple[Pointing | None, ...]
    depth: float
    sure: float
    of: tuple[int, ...]
    sizes: tuple[float, ...]
    point: tuple[float, ...]
    worst: int | None


def _deepest(
    limits: FrictionLimits, exactly: Callable[[ForcePart], tuple[float, float]]
) -> tuple[float, float]:
    """How deep the deepest part is, and the error of that; of the first that is looked at where it is found
    to be less than nothing, ``exactly`` too: in narrow angles rounding may say so of what is not.

    Raises SceneError where that takes too many parts.
    """
    reduced = ReducedLimits(limits)
    parts = [(-one.depth, 0, one) for one in [_part(reduced, limits.pushing)]]
    for made in range(MOST_PARTS):
        _, _, part = heapq.heappop(parts)
        if part.worst is None or part.depth < -ROUNDED:
            depth, error = exactly(part)
            if part.worst is None or depth < -error:
                return depth, error
        k = part.worst
        for n, angle in enumerate(reduced.cut(k, part.toward[k], part.point)):
            one = _part(reduced, (*part.toward[:k], angle, *part.toward[k + 1 :]))
            heapq.heappush(parts, (-one.depth, 3 * made + n + 1, one))
    raise SceneError(Status.UNSUPPORTED, TOO_MANY)


def _part(reduced: ReducedLimits, toward: tuple[Pointing | None, ...]) -> ForcePart:
    """How deep a part is."""
    if not reduced.balances:
        return ForcePart(toward, -math.inf, -math.inf, (), (), (), None)
    rows = reduced.rows(toward)
    forms = [form for form, *_ in rows]
    sizes = [counts * (largest_of(form) if k is None else reduced.sizes[k]) for form, counts, k in rows]
    kept = [n for n, form in enumerate(forms) if any(form)]
    nothing = (1.0, *[0.0] * len(reduced.open))  # says no more than how deep the deepest is
    deep = [tuple([a / (sizes[n] or largest_of(forms[n])) for a in forms[n]]) for n in kept]
    depth, of, point, _ = deepest([*deep, nothing], [*(rows[n][1] for n in kept), 1.0])
    kept_by = tuple([kept[n] for n in of if n < len(kept)])
    spare = {k: reduced.spare(k, (1.0, *point)) for k, to in enumerate(toward) if to is None or to.half}
    sure = min((depth, *spare.values()))
    short = [k for k, left in spare.items() if left < depth - ROUNDED]
    worst = min(short, key=lambda k: (toward[k] is not None, spare[k]), default=None)
    if 2.0 * sure > depth > 0.0 and all(toward[k] for k in short):
        worst = None  # angles that are narrower would not say other
    return ForcePart(toward, depth, sure, kept_by, tuple(sizes), (1.0, *point), worst)


def _exactly(limits: FrictionLimits, part: ForcePart, a: Showing) -> tuple[float, float]:
    """The depth of a part, where its rows are equations, in the numbers of the limits (balls), and its bound.

    Raises MoreDigits where the balls leave that open.
    """
    rows = [row for row, *_ in rows_of(limits, part.toward)]
    depth = 1 + max(c for row in (*rows, *limits.equations) for c in row)
    counting = [{**row, depth: 0.0 - size} for row, size in zip(rows, part.sizes, strict=True)]
    value = value_where(limits, counting, part.of, depth, a)
    return (part.depth, ROUNDED) if value is None else a.rounded(value)


# --- what redundant joints share --------------------------------------------------------------------


def _is_shared(limits: FrictionLimits) -> bool:
    """Whether what bounds friction hangs on how joints share the load."""
    bounds = [*limits.normals.values(), *limits.rows, *(row for rub in limits.rubs for row in rub.forces)]
    sizes = ((row, largest_of(row.values())) for row in bounds)
    return any(abs(row.get(c, 0.0)) > ROUNDED * size for row, size in sizes for c in limits.free)


def refuse_fit(scene: RestingScene) -> bool:
    """Refuse joints that rub and that their fit alone may press together; whether equilibrium leaves open how
    the others share the load."""
    ties, open_ = ties_of(scene.position), False
    for flanks in every_flanks(scene):
        limits = limits_in_floats(scene, flanks)
        if pressed := _pressed_by_fit(limits):
            raise shared(ties[pressed.tie], ties)
        open_ |= _is_shared(limits)
    return open_


def _pressed_by_fit(limits: FrictionLimits) -> Pressed | None:
    """Joints that rub, pressed together without any load or friction; None where none can be."""
    bare = limits.each(lambda row: {c: a for c, a in row.items() if c in limits.free})
    reduced = ReducedLimits(bare)
    least = [reduced.form(row) for row in (*bare.normals.values(), *bare.rows)]
    for rub in bare.rubs:
        for force, side in product(rub.forces, (1.0, -1.0)):
            form = tuple([side * a for a in reduced.form(force)])
            depth, _, point, _ = deepest([*least, form], [*[0.0] * len(least), 1.0])
            if depth > 0.5:  # a cone: 0 or, however far, the most that is looked for
                pushing = zip(bare.normals, least, strict=False)
                return Pressed(rub.tie, tuple([t for t, own in pushing if at(own, (1.0, *point)) > ROUNDED]))
    return None
