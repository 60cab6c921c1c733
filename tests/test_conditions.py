"""What each datum of a figure asks of points: derivatives against differences, misfits as distances, where
loci that do not meet come closest, and searches that lose no solution."""

from __future__ import annotations

import math
from random import Random
from typing import Any

import numpy as np
import pytest

import icsolve
from icsolve.assembly import solve_figure
from icsolve.assembly.conditions import FigureEquation, parts_of, residual
from icsolve.assembly.exclusion import _narrow_ball
from icsolve.assembly.loci import PlacedCircle, PlacedLine, gaps_of
from icsolve.assembly.refusals import step_words
from icsolve.assembly.walk import _middle_of_gap
from icsolve.assembly.workspace import Workspace, data_of, frame_of, names_of, normalised
from icsolve.errors import SceneError
from icsolve.numbers import FLOATS
from sizes import sampled

ALL = icsolve.load("""
icsolve: 1
points: {A: [0, 0], B: [4, 0.2], P: [1, 2], E: [unknown, 1.5], G: {centroid: [A, C, D]}}
lengths: {AC: 2}
angles: {BD: 100, BCD: 35}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: C}
  - {slide: [3, 1], at: D, along: [P, B]}
  - {slide: [4, 1], at: E, along: 20, through: B}
  - {rope: [C, P, D], on: [2, 1, 3], length: 3.2, radii: {P: 0.2}, wraps: {P: cw}}
loads: {F: {force: 1, link: 3, at: D, angle: 0}, T: {torque: unknown, link: 2}}
""")


def placed(rng: Random) -> Workspace:
    """The case with its points anywhere."""
    workspace = Workspace(ALL, frame_of(ALL), FLOATS)
    workspace.points.update({p: (rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)) for p in names_of(ALL)})
    return workspace


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("datum", data_of(ALL), ids=lambda datum: datum.kind)
def test_derivatives_are_the_limits_of_differences(datum: Any, seed: int) -> None:
    """Within 1e-7: a central difference over 2e-5 leaves 1e-10 of curvature and 1e-11 of rounding."""
    workspace = placed(Random(seed))
    for equation in (FigureEquation(datum, part) for part in parts_of(datum)):
        row = equation.row(workspace)
        for name, axis in equation.unknowns():
            at, found = workspace.points[name], []
            for step in (1e-5, -1e-5):
                workspace.points[name] = tuple(c + step * (k == axis) for k, c in enumerate(at))
                found.append(float(equation.at(workspace).value))
            workspace.points[name] = at
            assert row.by.get((name, axis), 0.0) == pytest.approx((found[0] - found[1]) / 2e-5, abs=1e-7)


def test_every_kind_of_datum_is_among_them() -> None:
    assert len({datum.kind for datum in data_of(ALL)}) == 8


@pytest.mark.parametrize("off", [0.3, -0.2, 1e-9])
@pytest.mark.parametrize(
    ("kind", "point", "along"),
    [("y", "E", (0.0, 1.0)), ("guide", "E", (-math.sin(math.radians(20)), math.cos(math.radians(20))))],
)
def test_a_misfit_is_told_as_the_distance_that_it_is(
    kind: str, point: str, along: tuple[float, float], off: float
) -> None:
    """Of a coordinate and of a guide: a point that is so far off, square to it, misses by that."""
    workspace = Workspace(ALL, frame_of(ALL), FLOATS)
    bx, by = workspace.points.setdefault("B", (0.4, 0.1))
    datum = next(d for d in data_of(ALL) if d.kind == kind)
    y = normalised(frame_of(ALL), (0.0, 1.5))[1] if kind == "y" else by + 0.5 * math.sin(math.radians(20))
    met = (bx + 0.5 * math.cos(math.radians(20)), y)
    workspace.points[point] = (met[0] + off * along[0], met[1] + off * along[1])
    assert abs(residual(workspace, datum)[0]) == pytest.approx(abs(off), rel=1e-6)


class TwoLoci:
    """What stands for a step: its loci."""

    def __init__(self, one: Any, two: Any) -> None:
        self.both = (one, two)

    def loci(self, _workspace: Workspace) -> Any:
        return self.both

    def gaps(self, _workspace: Workspace, *loci: Any) -> Any:
        return gaps_of(*loci, FLOATS)


def away(locus: Any, at: Any) -> float:
    """How far a place is from a locus."""
    if isinstance(locus, PlacedCircle):
        return abs(math.dist(at, locus.centre) - locus.radius)
    (x, y), (c, s) = locus
    return abs(c * (at[1] - y) - s * (at[0] - x))


@sampled(3)
@pytest.mark.parametrize("kind", ["apart", "inside", "about", "a line"])
@pytest.mark.parametrize("seed", range(10))
def test_loci_that_do_not_meet_come_closest_at_the_middle_of_the_gap(kind: str, seed: int) -> None:
    """As far from both, and no other place is nearer to the farther one: among 4,000 about it."""
    rng = Random(seed)
    centre, turn = (rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)), rng.uniform(0.0, 2.0 * math.pi)
    c, s, small = math.cos(turn), math.sin(turn), rng.uniform(0.1, 0.4)
    gap, large = rng.uniform(0.05, 0.3), rng.uniform(0.9, 1.5)
    reach = {"apart": large + small + gap, "a line": small + gap}.get(kind, large - small - gap)
    two = PlacedCircle(centre, large if kind == "about" else small)
    if kind == "a line":
        x, y = centre[0] + reach * c, centre[1] + reach * s
        shift = rng.uniform(-1.0, 1.0)
        one: Any = PlacedLine((x - shift * s, y + shift * c), (-s, c))
    else:
        one = PlacedCircle(
            (centre[0] + reach * c, centre[1] + reach * s), small if kind == "about" else large
        )
    at: Any = _middle_of_gap(TwoLoci(one, two), Workspace(ALL, frame_of(ALL), FLOATS))  # type: ignore[arg-type]
    assert away(one, at) == pytest.approx(gap / 2.0, rel=1e-9)
    assert away(two, at) == pytest.approx(gap / 2.0, rel=1e-9)
    for _ in range(4000):
        beside = (at[0] + rng.gauss(0.0, 0.3), at[1] + rng.gauss(0.0, 0.3))
        assert max(away(one, beside), away(two, beside)) > gap / 2.0 - 1e-12


@pytest.mark.parametrize("seed", range(20))
def test_a_box_narrowed_by_a_ball_keeps_what_both_hold(seed: int) -> None:
    rng = np.random.default_rng(seed)
    centre, radius = rng.uniform(-1.0, 0.0, 4), rng.uniform(0.5, 1.5)
    low = rng.uniform(-2.0, 0.0, (50, 4))
    high = low + rng.uniform(0.1, 2.0, (50, 4))
    held = rng.uniform(low, high)
    inside = np.linalg.norm(held - centre, axis=1) <= radius
    held[~inside] = np.clip(centre, low, high)[~inside]
    inside = np.linalg.norm(held - centre, axis=1) <= radius
    before = (high - low).sum()
    _narrow_ball(centre, radius, low, high)
    assert (low <= held)[inside].all() and (held <= high)[inside].all()
    assert inside.any() and (high - low).sum() < before


@sampled(2)
@pytest.mark.parametrize("off", [0.0, 0.5, 1.0, None])
def test_a_group_on_a_rope_is_found_from_wherever_near_is(off: float | None) -> None:
    """Two points that only a rope and lengths place together, drawn from C = B + 2.5 at 60 degrees with the
    rope rounded to 1e-6; without `near` other ways are found, too."""
    rng = Random(3)
    c, d = (1.763030, 3.574602), (4.110198, 3.073801)
    near = ", ".join(
        f"{name}: [{x + rng.uniform(-1, 1) * (off or 0.0)}, {y + rng.uniform(-1, 1) * (off or 0.0)}]"
        for name, (x, y) in {"C": c, "D": d}.items()
    )
    case = icsolve.load(f"""
icsolve: 1
points: {{A: [0, 0], P: [1.5, 6], Q: [3.5, 6.2], E: [5, 0]}}
lengths: {{AB: 1.5, BC: 2.5, CD: 2.4, DE: 3.2}}
angles: {{AB: 70}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 5], at: D}}
  - {{pin: [5, 1], at: E}}
  - {{rope: [C, P, Q, D], on: [3, 1, 1, 4], length: 7.634788}}
{"" if off is None else f"near: {{{near}}}"}
loads: {{W: {{weight: 100, link: 3, at: C}}, T: {{torque: unknown, link: 2}}}}
""")
    if off is None:
        with pytest.raises(SceneError, match="C and D can only be found together"):
            icsolve.solve(case)
        return
    points = icsolve.solve(case, examine=True).points
    assert points["C"] == pytest.approx(c, abs=3e-6)
    assert points["D"] == pytest.approx(d, abs=3e-6)


def test_a_step_by_a_centroid_names_the_points_that_it_is_of() -> None:
    text = "points: {A: [0, 0], B: [3, 0], C: [0, 6], G: {centroid: [A, B, C]}}"
    joints = "joints: [{pin: [1, 2], at: A}]"
    loads = "loads: {W: {weight: 1, link: 2, at: G}, T: {torque: unknown, link: 2}}"
    figure = solve_figure(icsolve.load(f"icsolve: 1\n{text}\n{joints}\n{loads}\n"))
    assert "G: centroid of A, B, C" in [step_words(step) for step in figure.steps]
