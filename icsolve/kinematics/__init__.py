"""A plan on a figure: the twist of every planned body, from one virtual input, without division.

Each group gives a factor D that multiplies all that was known before it, so a dead centre of the virtual
input (D = 0) is a value like any other: the bodies before the group then stand still.

Twists are triples (X, Y, W) [frame length/s, frame length/s, rad/s] as in `icsolve.screws`, all of
one scene to one common scale that is not told: only their ratios mean anything until a speed is given.
Groups are those of L. V. Assur (1914): dyads by Cramer's rule, larger ones by elimination of their loop
equations: every body hangs on a known one by a path of joints; each joint that closes a loop says that the
wrenches that it transmits do no work on the relative twist of its two bodies. (Independent loop equations
on screws: Valderrama-Rodriguez, Rico and others, Robotics 2022, 11(1), 6.)
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING

from icsolve.numbers import Arithmetic, Scalar, all_vanish, decider, magnitude
from icsolve.screws import (
    ORIGIN,
    Bases,
    Point,
    Triple,
    basis_at,
    blend,
    cross,
    dyad_twists,
    monad_twist,
    shift,
    subtract,
    times,
)
from icsolve.screws.joints import weights_of
from icsolve.structure import Bond, Topology
from icsolve.structure.plan import Group, Plan
from icsolve.tuples import LateModule, NamedTuple

if TYPE_CHECKING:
    from icsolve.kinematics import loops
    from icsolve.numbers import linear
else:
    linear, loops = map(LateModule, ("icsolve.numbers.linear", "icsolve.kinematics.loops"))


Seen = tuple[Triple, Point]
"""A twist, and the origin from which it is seen."""
LONG = 4
"""Plans with more groups are rescaled by powers of two on the way: determinants multiply up."""


class Closure(NamedTuple):
    """How a group closed.

    Attributes
    ----------
    group : its bodies, bonds and the known bodies on which it hangs
    factor : D, the determinant of the joint twists
    numerators : the rates of its bodies' first joints times D (of an eliminated group, of all joints of its
        tree)
    columns : the triples whose determinants these are, the relative twist of the known bodies last; empty for
        a group that was eliminated, and for a wheel on the carrier of its mesh
    """

    group: Group
    factor: Scalar
    numerators: tuple[Scalar, ...]
    columns: tuple[Triple, ...] = ()


class _Pool:
    """Known twists: each as seen from an origin of its own, so that nothing of a long chain is lost to
    its distance, and at the level (number of groups) to which its scale belongs."""

    def __init__(self) -> None:
        self.held: dict[int, tuple[Triple, Point, int]] = {}
        self.factors: list[Scalar] = []
        self.drift = 0.0
        """log2 of what rescaling by whole powers of two has left of the common scale"""

    def put(self, found: Mapping[int, Seen]) -> None:
        """Hold twists at the present level."""
        level = len(self.factors)
        for body, (twist, o) in found.items():
            self.held[body] = (twist, o, level)

    def now(self, body: int, o: Point) -> Triple:
        """The twist at the present level, as seen from o."""
        twist, own, level = self.held[body]
        if twist is ORIGIN:
            return twist
        if level < len(self.factors):
            for factor in self.factors[level:]:
                twist = times(factor, twist)
            self.put({body: (twist, own)})
        return twist if own is o else shift(twist, (o[0] - own[0], o[1] - own[1]))

    def all_now(self, wanted: Collection[int]) -> dict[int, Triple]:
        """Those of some bodies at the present level, in linear time, as seen from the origin of the frame."""
        suffix: list[Scalar] = [1.0]
        for factor in reversed(self.factors):
            suffix.append(suffix[-1] * factor)
        last, result = len(self.factors), {}
        for body, (twist, (ox, oy), level) in self.held.items():
            if body not in wanted:
                continue
            if twist is not ORIGIN:
                x, y, w = twist if level == last else times(suffix[last - level], twist)
                result[body] = (x + w * ox, y + w * oy, w)
            else:
                result[body] = ORIGIN
        return result


def run(
    plan: Plan,
    top: Topology,
    bases: Bases,
    arithmetic: Arithmetic,
    wanted: Collection[int] | None = None,
) -> tuple[dict[int, Triple], tuple[Closure, ...]]:
    """Twists of planned bodies.

    Parameters
    ----------
    plan : a bond that is driven at rate 1, and the groups that follow from it
    top : bodies and bonds
    bases : by bond, its basis twists, of every bond in the plan
    arithmetic : of the bases
    wanted : bodies; None: all that are planned

    Returns
    -------
    twists : by body, (X, Y, W) relative to the entry's first body, all to one scale
    closures : how each group closed, in the order of the plan
        A group that leaves a freedom of its own has D and all numerators 0 (`is_singular`), one at a dead
        centre D = 0 (`is_dead`): neither is refused here.
    """
    pool = _Pool()
    entry = top.bonds[plan.entry]
    o = _origin(bases[plan.entry][0])
    pool.put({entry.a: (ORIGIN, o), entry.b: (basis_at(o, bases[plan.entry][0]), o)})
    closures = []
    for group in plan.groups:
        last = group is plan.groups[-1]  # of which nothing hangs on what is not wanted
        closure, found = _close(group, top, bases, arithmetic, pool, wanted if last else None)
        if len(plan.groups) > LONG:
            closure, found = _rescaled(closure, found, pool)
        closures.append(closure)
        pool.factors.append(closure.factor)
        pool.put(found)
    return pool.all_now(pool.held if wanted is None else wanted), tuple(closures)


Closed = tuple[Closure, dict[int, Seen]]
"""How a group closed, and the twists of its bodies."""


def _rescaled(closure: Closure, found: dict[int, Seen], pool: _Pool) -> Closed:
    """Times a power of two that brings the largest determinant, and what was left over before, near 1.

    The largest alone would lie between 1/2 and 1 at every step, and all twists fade along a chain.
    """
    largest = max(magnitude(value) for value in (closure.factor, *closure.numerators))
    scale = 1.0
    if 0.0 < largest < math.inf:
        exponent = round(math.log2(largest) + pool.drift)
        pool.drift += math.log2(largest) - exponent
        scale = math.ldexp(1.0, -exponent)
    numerators = tuple(scale * value for value in closure.numerators)
    columns = tuple(times(scale, column) for column in closure.columns[:1]) + closure.columns[1:]
    scaled = {body: (times(scale, twist), o) for body, (twist, o) in found.items()}
    return Closure(closure.group, scale * closure.factor, numerators, columns), scaled


def _close(
    group: Group,
    top: Topology,
    bases: Bases,
    arithmetic: Arithmetic,
    pool: _Pool,
    wanted: Collection[int] | None,
) -> Closed:
    if group.kind == "dyad":
        return _dyad(group, bases, pool, group.bodies if wanted is None else wanted)
    if group.kind == "monad":
        mesh = top.bonds[group.bonds[1]]
        if mesh.pivots and _on_carrier(group, top):
            return _wheel(group, mesh, bases, weights_of(mesh, arithmetic), pool)
        return _monad(group, bases, pool)
    return _eliminated(group, top, bases, pool, arithmetic)


def _monad(group: Group, bases: Bases, pool: _Pool) -> Closed:
    (body,), (one, two), (a, c) = group.bodies, group.bonds, group.ends
    basis, line = bases[one][0], bases[two]
    o = _origin(basis, line[0])
    ta, tc = pool.now(a, o), pool.now(c, o)
    here = basis_at(o, basis)
    first, second = basis_at(o, line[0]), basis_at(o, line[1])
    r = subtract(tc, ta)
    d, s = monad_twist(here, cross(first, second), r)
    return Closure(group, d, (s,), (first, second, here, r)), {body: (blend(d, ta, s, here), o)}


def _on_carrier(group: Group, top: Topology) -> bool:
    """Whether a wheel hangs on a body that carries the pivots of both wheels of its mesh."""
    one, two = (top.bonds[k] for k in group.bonds)
    carrier, other = group.ends
    mine, its = tuple(two.pivots if two.b == other else two.pivots[::-1])
    if one.joint.pivot != mine:
        return False
    here = _pinned(top, other, its)
    return carrier in here or (bool(here) and bool(_pinned(top, carrier, its)))


def _pinned(top: Topology, body: int, at: str) -> set[int]:
    """A body and those that a pin at a point joins it to; none where it has no pin there."""
    bonds = [top.bonds[k] for k in top.at[body]]
    return {end for bond in bonds if bond.joint.pivot == at for end in (bond.a, bond.b)}


def _wheel(group: Group, mesh: Bond, bases: Bases, weights: tuple[Scalar, Scalar], pool: _Pool) -> Closed:
    """A wheel on the carrier of its mesh, seen from which the two rates are as -q : p (weights crosswise).

    No point enters: a pitch point rounded in the frame costs digits where the wheels are small.
    """
    (body,), (a, c) = group.bodies, group.ends
    basis = bases[group.bonds[0]][0]
    o = _origin(basis)
    here, ta = basis_at(o, basis), pool.now(a, o)
    spin = pool.now(c, o)[2] - ta[2]
    p, q = weights if body == mesh.b else weights[::-1]
    d, s = p, -(q * spin)
    return Closure(group, d, (s,)), {body: (blend(d, ta, s, here), o)}


def _dyad(group: Group, bases: Bases, pool: _Pool, wanted: Collection[int]) -> Closed:
    (u, v), (outer_u, inner, outer_v), (a, c) = group.bodies, group.bonds, group.ends
    b1, b3, b2 = bases[outer_u][0], bases[inner][0], bases[outer_v][0]
    o = _origin(b3, b1, b2)  # the inner pin is in every determinant: each is of differences then
    ta, tc = pool.now(a, o), pool.now(c, o)
    columns = (basis_at(o, b1), basis_at(o, b3), basis_at(o, b2), subtract(tc, ta))
    d, s1, s2 = dyad_twists(*columns)
    hung = ((u, a, b1, s1), (v, c, b2, s2))
    found = {body: _hung(pool, root, b, (d, s), o) for body, root, b, s in hung if body in wanted}
    return Closure(group, d, (s1, s2), columns), found


def _hung(pool: _Pool, root: int, basis: Triple, rates: tuple[Scalar, Scalar], o: Point) -> Seen:
    """The twist of a body that a joint ties to a known one, as seen from its pin, where that is not turned
    into a difference; else from o."""
    own = _origin(basis)
    own = o if own is FRAME else own
    d, s = rates
    return blend(d, pool.now(root, own), s, basis_at(own, basis)), own


def _origin(*bases: Triple) -> Point:
    """A pin of the group."""
    for x, y, w in bases:
        if type(w) is float and w == 1.0:
            return (x, y)
    return FRAME


FRAME: Point = (0.0, 0.0)


def _eliminated(group: Group, top: Topology, bases: Bases, pool: _Pool, arithmetic: Arithmetic) -> Closed:
    ends = {body for k in group.bonds for body in (top.bonds[k].a, top.bonds[k].b)}
    roots = {body: pool.now(body, FRAME) for body in sorted(ends - set(group.bodies))}
    tree = loops.span(top, group.bonds, roots, bases)
    if not ends <= tree.branches.keys():  # part of it hangs on nothing known: all joints at once then
        return _open(group)
    rows = loops.loop_rows(top, tree, bases, roots)
    solved = linear.null_space(rows, tree.columns + 1, unit=1.0, vanishes=decider(arithmetic))
    if len(solved.basis) != 1:
        return _open(group)
    rates = solved.basis[0]
    twists = loops.twists_on(tree, rates, roots)
    found = {body: (twists[body], FRAME) for body in group.bodies}
    return Closure(group, rates[-1], tuple(rates[:-1])), found


def _open(group: Group) -> Closed:
    """A group that has more motions than the one that drives it."""
    return Closure(group, 0.0, (0.0,)), dict.fromkeys(group.bodies, (ORIGIN, FRAME))


CLEAR = 1e-6
"""A determinant above this is looked at no closer: in the normalised frame the products are of order 1."""


def is_singular(closure: Closure, arithmetic: Arithmetic) -> bool:
    """Whether D and all rates vanish: the group leaves a freedom of its own (a change point)."""
    if not closure.columns:
        return bool(closure.factor == 0.0 and all(n == 0.0 for n in closure.numerators))
    if abs(closure.factor) > CLEAR:
        return False
    *bases, _ = closure.columns
    sizes = (products(*bases), *rate_sizes(closure))
    return all_vanish(arithmetic, zip((closure.factor, *closure.numerators), sizes, strict=True))


def is_dead(closure: Closure, arithmetic: Arithmetic) -> bool:
    """Whether D vanishes: what drives the group from before stands still."""
    if not closure.columns:
        return arithmetic.vanishes(closure.factor, max(map(abs, closure.numerators)))
    *bases, _ = closure.columns
    return arithmetic.vanishes(closure.factor, products(*bases))


def rate_sizes(closure: Closure) -> tuple[float, ...]:
    """For each numerator of a dyad or monad the sum of the absolute products that it is summed from, by which
    a zero is judged.
    """
    b1, b3, b2, r = closure.columns
    if closure.group.kind == "monad":
        return (products(b1, b3, r),)
    return (products(r, b3, b2), products(b1, b3, r))


def products(*columns: Triple) -> float:
    """Sum of the absolute values of the products in the determinant of three columns."""
    (a, b, c), (d, e, f), (g, h, i) = (tuple(map(abs, column)) for column in columns)
    return float(a * (e * i + f * h) + b * (f * g + d * i) + c * (d * h + e * g))
