"""Where a figure assembles over stretches of its free datum alone, however narrow these or the gaps between
them are: positions of equilibrium in all of them, and those that no motion reaches."""

from __future__ import annotations

import math
from contextlib import suppress
from random import Random

import pytest

import icsolve
from icsolve.errors import SceneError
from icsolve.solve.positions import find_along
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


@pytest.mark.parametrize("tie", ["rod", "rope"])
@pytest.mark.parametrize("seed", range(100 if FULL else 2))
def test_a_datum_to_find_is_searched_where_rows_of_a_sweep_go(tie: str, seed: int) -> None:
    """Two cranks, tied by a rod or by a rope over a pulley, rest in the same positions where the angle of one
    is to find from where the figure is written and where a sweep looks for them: beyond the limits too, and
    in a part of the range alone as in the whole."""
    dice = Random(f"written {tie} {seed}")
    start, crank, rocker = dice.uniform(-170, 170), dice.uniform(0.5, 2), dice.uniform(0.5, 2)
    base, turned = complex(dice.uniform(1, 3), dice.uniform(-1, 1)), math.radians(dice.uniform(0, 360))
    end = base + rocker * complex(math.cos(turned), math.sin(turned))
    tied = "{pin: [2, 4], at: B}\n  - {pin: [4, 3], at: E}"
    if tie == "rope":
        tied = "{rope: [B, P, E], on: [2, 1, 3]}"
    angle = "{unknown: [%r, %r], from: %r}"
    text = f"""icsolve: 1
points: {{A: [0, 0], P: [1.5, 4], D: [{base.real!r}, {base.imag!r}], E: [{end.real!r}, {end.imag!r}]}}
lengths: {{AB: {crank!r}}}
angles: {{AB: ANGLE}}
links: {{1: [P]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [1, 3], at: D}}
  - {tied}
loads:
  T: {{torque: {dice.uniform(-9, 9)!r}, link: 2}}
  W: {{weight: {dice.uniform(1, 9)!r}, link: 3, at: E}}
"""
    low = start - dice.choice([20, 90, 150])
    for span in ((low, low + 330.0), (start + 40.0, low + 330.0), (low - 60.0, start - 5.0)):
        case = icsolve.load(text.replace("ANGLE", repr(start)))
        swept = [(one.value, str(one.stability)) for one in find_along(case, "angles.AB", *span)[0]]
        found = rests(text.replace("ANGLE", angle % (*span, start)))
        assert [sort for _, sort in found] == [sort for _, sort in swept]
        assert [at for at, _ in found] == pytest.approx([at for at, _ in swept], abs=1e-7)
