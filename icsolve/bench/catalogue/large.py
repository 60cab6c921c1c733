"""Entry 34: a chain of 5000 four-bars."""

from __future__ import annotations

from random import Random

from icsolve.bench.catalogue.scenes import scene
from icsolve.bench.stress import Stress, Value, answered

LOOPS = 5000


def chain(loops: int) -> str:
    """Four-bars in series: the rocker of one is the crank of the next."""
    rng = Random(1)
    places, joints = ["  A0: [0, 0]\n  B0: [0.1, 1.2]\n"], ["  - {pin: [0, 1], at: A0}\n"]
    for k in range(1, loops + 1):
        places.append(f"  A{k}: [{3 * k + rng.uniform(-0.4, 0.4):.4f}, {rng.uniform(-0.4, 0.4):.4f}]\n")
        places.append(f"  B{k}: [{3 * k + rng.uniform(-0.6, 0.6):.4f}, {rng.uniform(1.0, 2.0):.4f}]\n")
        rod = 2 * k
        joints.append(f"  - {{pin: [{rod - 1}, {rod}], at: B{k - 1}}}\n")
        joints.append(f"  - {{pin: [{rod}, {rod + 1}], at: B{k}}}\n  - {{pin: [{rod + 1}, 0], at: A{k}}}\n")
    loads = f"K: {{torque: 1, link: {2 * loops + 1}}}, U: {{torque: unknown, link: 1}}"
    return scene(f"points:\n{''.join(places)}joints:\n{''.join(joints)}", loads)


def long_chain() -> str:
    """The entry's own."""
    return chain(LOOPS)


ENTRIES = (
    Stress(
        "34",
        f"chain of {LOOPS} four-bars",
        long_chain,
        answered({"U": Value(-11.522422276394837, 1e-15, 1e-14)}),
    ),
)
