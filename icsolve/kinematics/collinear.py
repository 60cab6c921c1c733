"""What lies on one line where a group of a plan is dead or leaves a body at rest, and how nearly."""

from __future__ import annotations

from collections.abc import Iterable

from icsolve.case import Pin
from icsolve.case.joints import Sliding
from icsolve.kinematics.twists import Closure, is_dead, products, rate_sizes
from icsolve.numbers.arithmetic import Arithmetic
from icsolve.structure.topology import Bond, Topology
from icsolve.wording.joints import normal_words
from icsolve.wording.sentences import listed


def lined_up(closure: Closure, top: Topology, body: int, arithmetic: Arithmetic) -> tuple[int, ...]:
    """The bonds whose centres lie on one line and so hold a body at rest; empty where none do.

    A dead group holds the bodies before it. A body of the group itself rests where the line of its own
    two centres passes through the relative centre of the bodies that drive the group, where that is a
    joint's.
    """
    bodies, bonds = closure.group.bodies, closure.group.bonds
    if not closure.columns:
        return ()
    if body not in bodies:
        return tuple(sorted(bonds)) if is_dead(closure, arithmetic) else ()
    n = bodies.index(body)
    if not arithmetic.vanishes(closure.numerators[n], rate_sizes(closure)[n]):
        return ()
    kept = (bonds[1], bonds[2 if n == 0 else 0]) if closure.group.kind == "dyad" else bonds[1:]
    ends = closure.group.ends
    shared = (k for k in top.at[ends[0]] if top.bonds[k].other(ends[0]) == ends[1])
    driver = next((k for k in shared if top.bonds[k].freedom == 1), None)
    return () if driver is None else tuple(sorted((driver, *kept)))


def tightest(closures: Iterable[Closure]) -> Closure | None:
    """The group that is nearest to dead, or to leaving a body at rest."""
    return min((closure for closure in closures if closure.columns), key=_tightness, default=None)


def _tightness(closure: Closure) -> float:
    """The smallest determinant of a group, over the products that it is summed from."""
    *bases, _ = closure.columns
    pairs = zip((closure.factor, *closure.numerators), (products(*bases), *rate_sizes(closure)), strict=True)
    return min(abs(value) / size if size > 0.0 else 1.0 for value, size in pairs)


def aligned(top: Topology, bonds: Iterable[int], verb: str = "lie on") -> str:
    """Names the centres of bonds that lie on one line; empty where one of them has no name."""
    joints = [top.bonds[k] for k in bonds]
    names = [_place(bond) for bond in joints if bond.freedom == 1]
    normals = [_normal(bond) for bond in joints if bond.freedom == 2]
    if not all((*names, *normals)):
        return ""
    if len(names) == 3:
        return f"{listed(names)} {verb} one line"
    if len(names) == len(normals) == 1:
        return f"{normals[0]} {'passes through' if verb == 'lie on' else 'nearly passes through'} {names[0]}"
    return ""


def _place(bond: Bond) -> str:
    return bond.joint.at if isinstance(bond.joint, Pin) and not bond.joint.at.startswith("@") else ""


def _normal(bond: Bond) -> str:
    joint = bond.joint
    if not isinstance(joint, Sliding) or joint.freedom == 1 or joint.at.startswith("@"):
        return ""
    return f"the {normal_words(joint)} at {joint.at}"
