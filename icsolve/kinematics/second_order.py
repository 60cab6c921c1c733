"""Whether links with redundant constraints go on moving, or yield only for an instant.

Joint rates s are a first-order motion where the loops close, ``sum s_i $_i = 0``. They extend to second
order where accelerations can make up for the brackets ``sum_{i<j} s_i s_j [$_i, $_j]``, that is, where
every self-stress (a wrench system of the joints in balance without load) does no work on them. (J. M.
Rico Martinez, J. Duffy, Mech. Mach. Theory 31, 1996; R. Connelly, W. Whiteley, SIAM J. Discrete Math.
9, 1996.)
"""

from __future__ import annotations

from collections.abc import Sequence

from icsolve.kinematics.twists import ORIGIN, Bases, Branch, loop_rows, span
from icsolve.numbers.null_space import null_space
from icsolve.screws.joints import transmitted
from icsolve.screws.plane import Triple, add, pairing, subtract, times
from icsolve.structure.topology import Topology

BINDS = 1e-9
"""Work of a self-stress on the second-order misfit, over the products that it is summed from."""


def goes_on(top: Topology, bases: Bases) -> bool | None:
    """Whether the one motion of a redundant scene extends to second order.

    Parameters
    ----------
    top : bodies and bonds
    bases : by bond, its basis twists [frame of size 1], floats

    Returns
    -------
    bool | None
        None where a joint has not one centre that goes with its links, or there is not one motion.
    """
    if any(top.bonds[k].joint.freedom > 1 or not top.bonds[k].joint.stays_known for k in bases):
        return None
    tree = span(top, sorted(bases), (top.ground,), bases)
    if any(body not in tree.branches for k in bases for body in (top.bonds[k].a, top.bonds[k].b)):
        return None  # what no joint ties to the frame floats: more motions than one
    rows = [row[:-1] for row in loop_rows(top, tree, bases, {top.ground: ORIGIN})]
    motion = null_space(rows, tree.columns, unit=1.0).basis
    if len(motion) != 1:
        return None
    misfits: list[float] = []
    for k in tree.closing:
        (one, ba), (two, bb) = (
            _second(tree.branches[body], motion[0]) for body in (top.bonds[k].a, top.bonds[k].b)
        )
        misfit = subtract(subtract(bb, ba), bracket(one, two))
        misfits += [pairing(wrench, misfit) for wrench in transmitted(bases[k])]
    stresses = null_space([list(column) for column in zip(*rows, strict=True)], len(rows), unit=1.0).basis
    return all(_idle(stress, misfits, motion[0]) for stress in stresses)


def _second(branch: Branch, rates: Sequence[float]) -> tuple[Triple, Triple]:
    """Twist of a body, and the brackets of the joint rates on its path."""
    twist, brackets = ORIGIN, ORIGIN
    for column, basis in branch.path:
        step = times(rates[column], basis)
        brackets = add(brackets, bracket(twist, step))
        twist = add(twist, step)
    return twist, brackets


def bracket(a: Triple, b: Triple) -> Triple:
    """Lie bracket of two twists: how far two small motions fail to commute.

    For ``a = (X, Y, W)``: ``(Ya Wb - Wa Yb, Wa Xb - Xa Wb, 0)``, a translation.
    """
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], 0.0)


def _idle(stress: Sequence[float], misfits: Sequence[float], rates: Sequence[float]) -> bool:
    work = sum(s * m for s, m in zip(stress, misfits, strict=True))
    size = max(map(abs, stress)) * max(map(abs, rates)) ** 2
    return bool(abs(work) <= BINDS * size)
