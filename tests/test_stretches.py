"""Where a figure assembles over stretches of its free datum alone, however narrow these or the gaps between
them are: positions of equilibrium in all of them."""

from __future__ import annotations

import math
from contextlib import suppress
from random import Random

import pytest

import icsolve
from icsolve.errors import SceneError
from sizes import FULL

Guide = tuple[float, float, float]
"""Direction of its normal, its distance from the crank's pivot along that, and the length of its rod."""


def guided(crank: float, free: str, *guides: Guide) -> str:
    """A crank that a torque turns, and from its end a rod to a block on each guide."""
    points, lengths, joints = "A: [0, 0]", f"AB: {crank!r}", "  - {pin: [1, 2], at: A}\n"
    for n, (normal, off, rod) in enumerate(guides):
        x, y = off * math.cos(math.radians(normal)), off * math.sin(math.radians(normal))
        points += f", G{n}: [{x!r}, {y!r}]"
        lengths += f", B-C{n}: {rod!r}"
        joints += (
            f"  - {{pin: [2, {3 + 2 * n}], at: B}}\n  - {{pin: [{3 + 2 * n}, {4 + 2 * n}], at: C{n}}}\n"
            f"  - {{slide: [{4 + 2 * n}, 1], at: C{n}, along: {normal - 90.0!r}, through: G{n}}}\n"
        )
    return (
        f"icsolve: 1\npoints: {{{points}}}\nlengths: {{{lengths}}}\nangles: {{AB: {free}}}\n"
        f"joints:\n{joints}loads: {{T: {{torque: 9, link: 2}}}}\n"
    )


def rests(text: str) -> list[tuple[float, str]]:
    """Where it rests, with the kind."""
    with suppress(SceneError):
        found = icsolve.solve(icsolve.load(text)).positions or ()
        return [(one.at["angles.AB"], str(one.stability)) for one in found]
    return []


@pytest.mark.parametrize("kind", ["stretch", "gap", "corner"])
@pytest.mark.parametrize("seed", range(100 if FULL else 2))
def test_what_assembles_between_two_samples_alone_rests_at_its_limits(kind: str, seed: int) -> None:
    """A crank under a torque rests where its rod stands square to its guide, and lets it turn no farther:
    at both ends of the stretch over which it assembles, or of the gap in which it does not, of some
    thousandths of a degree; where one rod ends it and another begins it, in both ways of the other."""
    dice = Random(f"stretch {seed}")
    centre, half = dice.uniform(20.0, 340.0), 10.0 ** dice.uniform(-3.0, -0.8)
    crank, rod = round(dice.uniform(0.5, 2.0), 2), round(dice.uniform(0.5, 2.0), 2)
    reach = crank * math.cos(math.radians(half))
    if kind == "stretch":
        guides: tuple[Guide, ...] = ((centre, rod + reach, rod),)
    elif kind == "gap":  # the crank's end goes farther beyond the guide than the rod reaches
        guides = ((centre, reach - (rod + crank), rod + crank),)
    else:
        wide = [dice.uniform(20.0, 60.0) for _ in range(2)]
        sides = [(centre + half - wide[0], wide[0]), (centre - half + wide[1], wide[1])]
        guides = tuple((at, rod + crank * math.cos(math.radians(w)), rod) for at, w in sides)
    found = rests(guided(crank, "{unknown: [0, 360]}", *guides))
    ends = [(centre - half, "unstable"), (centre + half, "stable")]
    if kind == "gap":
        ends = [(at, "stable" if sort == "unstable" else "unstable") for at, sort in ends]
    each = 2 if kind == "corner" else 1
    assert [sort for _, sort in found] == [sort for _, sort in ends for _ in range(each)]
    assert [at for at, _ in found] == pytest.approx([at for at, _ in ends for _ in range(each)], abs=1e-7)
