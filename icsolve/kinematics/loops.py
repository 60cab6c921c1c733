"""Motions from the loop equations: every body hangs on a known one by a path of joints, and each joint that
closes a loop says that the wrenches that it transmits do no work on the relative twist of its two bodies.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from icsolve.numbers import ZERO, Scalar
from icsolve.screws import (
    FREE,
    ORIGIN,
    Bases,
    Triple,
    add,
    blend,
    pairing,
    subtract,
)
from icsolve.screws.joints import transmitted
from icsolve.structure import Topology
from icsolve.tuples import LateModule, NamedTuple

if TYPE_CHECKING:
    from icsolve.numbers import linear
    from icsolve.screws.ropes import RopePart
else:
    linear = LateModule("icsolve.numbers.linear")


class Branch(NamedTuple):
    """A body on the spanning tree: its known root and the (column, basis twist) on its path."""

    root: int
    path: tuple[tuple[int, Triple], ...]


class Tree(NamedTuple):
    """A spanning tree of a group: a branch per body, the bonds that close loops, the unknown rates."""

    branches: dict[int, Branch]
    closing: tuple[int, ...]
    columns: int


def span(
    top: Topology, bonds: Sequence[int], roots: Iterable[int], bases: Bases, afloat: Iterable[int] = ()
) -> Tree:
    """Spanning tree over ``bonds`` from the known ``roots``; joints with one freedom come first.

    Parameters
    ----------
    top : bodies and bonds
    bonds : indices of the bonds that may be used
    roots : bodies whose twists are known
    bases : by bond, its basis twists (one or two)
    afloat : bodies to which no joints lead; each moves freely (three columns) beside the first root

    Returns
    -------
    Tree
        A column for every basis twist on it; bonds that are not on it close loops.
    """
    branches = {root: Branch(root, ()) for root in roots}
    left = sorted(bonds, key=lambda k: top.bonds[k].freedom)
    columns = 0
    for body in afloat:
        first = next(iter(branches))
        branches[body] = Branch(first, tuple((columns + n, basis) for n, basis in enumerate(FREE)))
        columns += len(FREE)
    grown = True
    while grown:
        grown = False
        for k in left:
            a, b = top.bonds[k].a, top.bonds[k].b
            if (a in branches) == (b in branches):
                continue
            known, new = (a, b) if a in branches else (b, a)
            steps = tuple((columns + n, basis) for n, basis in enumerate(bases[k]))
            branches[new] = Branch(branches[known].root, branches[known].path + steps)
            columns += len(steps)
            left.remove(k)
            grown = True
            break
    return Tree(branches, tuple(left), columns)


def loop_rows(top: Topology, tree: Tree, bases: Bases, roots: Mapping[int, Triple]) -> list[list[Scalar]]:
    """The loop equations: one row a wrench of each closing joint.

    Parameters
    ----------
    top, tree, bases : as of `span`
    roots : by body, its known twist

    Returns
    -------
    list[list[Scalar]]
        (equations, ``tree.columns`` + 1): coefficients of the joint rates, and last the factor on the twists
        of the roots. Their sums are powers [frame length/s a unit force], zero in every motion.
    """
    rows = []
    for k in tree.closing:
        one, two = tree.branches[top.bonds[k].a], tree.branches[top.bonds[k].b]
        for wrench in transmitted(bases[k]):
            row: list[Scalar] = [0.0] * (tree.columns + 1)
            shared = _shared(one.path, two.path)
            for column, basis in two.path[shared:]:
                row[column] = pairing(wrench, basis)
            for column, basis in one.path[shared:]:
                row[column] = -pairing(wrench, basis)
            if one.root != two.root:
                row[-1] = pairing(wrench, subtract(roots[two.root], roots[one.root]))
            rows.append(row)
    return rows


def _shared(one: tuple[tuple[int, Triple], ...], two: tuple[tuple[int, Triple], ...]) -> int:
    shared = 0
    for (a, _), (b, _) in zip(one, two, strict=False):
        if a != b:
            break
        shared += 1
    return shared


def twists_on(tree: Tree, rates: Sequence[Scalar], roots: Mapping[int, Triple]) -> dict[int, Triple]:
    """Twist of each body of the tree, in the units of the rates.

    Parameters
    ----------
    tree : as of `span`
    rates : (``tree.columns`` + 1,), joint rates and last the factor on the roots' twists
    roots : by body, its known twist
    """
    twists = {}
    for body, branch in tree.branches.items():
        root = roots[branch.root]
        twist = blend(rates[-1], root, 0.0, root)
        for column, basis in branch.path:
            twist = add(twist, (rates[column] * basis[0], rates[column] * basis[1], rates[column] * basis[2]))
        twists[body] = twist
    return twists


class LoopMotions(NamedTuple):
    """All motions of a scene.

    Attributes
    ----------
    twists : by body, one twist a freedom, relative to the frame of the mechanism
    found : rank, pivots and basis of the joint rates
    """

    twists: dict[int, tuple[Triple, ...]]
    found: linear.NullSpace


def rope_row(top: Topology, tree: Tree, parts: Sequence[RopePart]) -> list[Scalar]:
    """The condition that a rope keeps its length, in the rates of the tree, (``tree.columns``,): each part
    pulls with the same force, and their powers add up to nothing.
    """
    row: list[Scalar] = [0.0] * tree.columns
    for part in parts:
        for link, sign in zip(part.links, (-1.0, 1.0), strict=True):
            for column, basis in tree.branches[top.body_of[link]].path:
                row[column] = row[column] + sign * pairing(part.wrench, basis)
    return row


def all_motions(
    top: Topology,
    bases: Bases,
    zero: float = ZERO,
    ropes: Sequence[Sequence[RopePart]] = (),
    vanishes: linear.Vanishes | None = None,
) -> LoopMotions:
    """Null space of the loop equations of the bonds in ``bases`` and of ropes.

    Parameters
    ----------
    top : bodies and bonds
    bases : by bond, its basis twists [frame of size 1]
    zero : fraction of the first pivot below which one counts as none (times the number of equations)
    ropes : the parts of each rope
    vanishes : of balls, what decides instead

    Raises
    ------
    MoreDigits
        Of balls, where the rank is open.
    """
    tree = span(top, sorted(bases), (top.ground,), bases, [group[0] for group in top.afloat])
    rows = [row[:-1] for row in loop_rows(top, tree, bases, {top.ground: ORIGIN})]
    rows += [rope_row(top, tree, parts) for parts in ropes]
    found = linear.null_space(rows, tree.columns, zero, 1.0, vanishes)
    motions = [twists_on(tree, (*rates, 0.0), {top.ground: ORIGIN}) for rates in found.basis]
    return LoopMotions({body: tuple(m[body] for m in motions) for body in tree.branches}, found)
