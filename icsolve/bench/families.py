"""Families of random scenes, as case texts with one known load and one unknown."""

from __future__ import annotations

from typing import NamedTuple

from icsolve.bench.kinds import all_joints, coupler_slot, geared_five_bar
from icsolve.bench.pinned import (
    BUTTERFLY,
    FOUR_BAR,
    STEPHENSON,
    WATT,
    Draw,
    by_sides,
    chain,
    from_lengths,
    linkage,
    moved,
    near_toggle,
    nearly_parallel,
)


class Family(NamedTuple):
    """Scenes of one kind: a name for tables, how one is drawn, how many of them count for one."""

    name: str
    draw: Draw
    weight: int = 1


ALL_JOINTS = Family("all joints", all_joints)
SIX_BARS = (Family("Watt", linkage(WATT)), Family("Stephenson", linkage(STEPHENSON)))
DELTAS = tuple(10.0**-k for k in range(1, 16))

FAMILIES: tuple[Family, ...] = (
    Family("four-bar", linkage(FOUR_BAR)),
    *SIX_BARS,
    ALL_JOINTS,
    Family("geared five-bar", geared_five_bar),
    Family("slot on a moving link", coupler_slot),
    Family("double butterfly", linkage(BUTTERFLY)),
    Family("from lengths", from_lengths()),
    *(Family(f"lengths, toggle {delta:.0e}", from_lengths(delta)) for delta in (1e-3, 1e-6, 1e-9, 1e-12)),
    *(Family(f"toggle {delta:.0e}", near_toggle(delta)) for delta in DELTAS[::2]),
    *(Family(f"parallel {delta:.0e}", nearly_parallel(delta)) for delta in DELTAS[2::4]),
    Family("parallel", nearly_parallel(0.0)),
    *(Family(f"offset {o:.0e}", moved(linkage(STEPHENSON), o, exact=True)) for o in (1e2, 1e6, 1e10)),
    *(Family(f"size {s:.0e}", moved(linkage(STEPHENSON), scale=s)) for s in (1e-300, 1e-12, 1e12, 1e300)),
    Family("chain of 12", chain(12), 4),
    Family("chain of 50", chain(50), 20),
)
"""In the order of the tables, from easy to hard within each kind."""

BOUNDED: tuple[Family, ...] = (
    ALL_JOINTS,
    Family("four-bar", linkage(FOUR_BAR)),
    Family("from lengths", from_lengths()),
    Family("chain of 12 from lengths", by_sides(chain(12), (1, 2)), 10),
    Family("double butterfly from lengths", by_sides(linkage(BUTTERFLY), (1, 4)), 50),
    Family("geared five-bar", geared_five_bar),
    Family("slot on a moving link", coupler_slot),
    Family("toggle 1e-06", near_toggle(1e-6)),
    Family("lengths, toggle 1e-06", from_lengths(1e-6)),
    Family("parallel 1e-07", nearly_parallel(1e-7)),
    Family("offset 1e+06", moved(linkage(STEPHENSON), offset=1e6)),
    Family("size 1e-12", moved(linkage(STEPHENSON), scale=1e-12)),
)
"""On which the error bound is held against sixty digits on the decimals."""
