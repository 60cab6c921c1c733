"""`near` is a promise: the way nearest to it is taken, or the scene is refused with what lies near."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise
from random import Random

import numpy as np
import pytest
import yaml

from figure_drafts import Draft, Place, framework, sequence, straight_plates
from icsolve.assembly import Figure, case_point, modes, newton, solve_figure
from icsolve.assembly.conditions import FigureEquation
from icsolve.assembly.steps import PointGroup
from icsolve.assembly.ways import ways_of
from icsolve.assembly.workspace import LENGTH, Workspace, data_of, frame_of, normalised
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers import FLOATS
from icsolve.read import load
from icsolve.solve import solve
from icsolve.sweep import sweep
from sizes import MORE, crossed, few, sampled


def places_of(case: Case) -> dict[str, Place]:
    figure = solve_figure(case)
    return {p: case_point(figure.frame, at) for p, at in figure.points.items()}


def off(near: dict[str, Place], places: dict[str, Place]) -> float:
    return math.hypot(*(math.dist(near[p], places[p]) for p in near))


def apart(one: dict[str, Place], two: dict[str, Place]) -> float:
    return max(math.dist(one[p], two[p]) for p in one)


def linkage(seed: int, links: int) -> Draft:
    """Rods and plates that hold one another: no point has an order of construction but by chance."""
    return framework(seed, 2 + max(3, links), 0.9, 0.0)


def unless_even(case: Case) -> dict[str, Place] | None:
    """The points; None where two ways are about as near."""
    try:
        return places_of(case)
    except SceneError as refused:
        if refused.status == Status.AMBIGUOUS and "about as far" in refused.message:
            return None
        raise


def refusal(case: Case) -> str:
    """Why a figure is refused; nothing where it is not."""
    try:
        places_of(case)
    except SceneError as refused:
        return refused.message
    return ""


AT_NEAR = "what lies at near: does not assemble"


@sampled(2, "spread", "links")
@pytest.mark.parametrize("spread", [1e-3, 0.02, 0.15])
@pytest.mark.parametrize("links", range(3, 13) if MORE > 1 else (3, 5, 8, 12))
def test_a_group_takes_the_way_nearest_to_near(links: int, spread: float) -> None:
    """The figure that was measured, or one that is nearer to `near` than it."""
    for seed in range(2 * MORE):
        draft = linkage(7000 + 100 * links + seed, links)
        for p in draft.names:
            if p not in draft.points:
                draft.approximately(p, spread)
        case, (refused, places) = draft.case(), ("", None)
        try:
            places = unless_even(case)
        except SceneError as error:
            refused = error.message
        if places is None:
            assert not refused or (spread > 0.1 and AT_NEAR in refused), (links, seed)
            continue
        nearest = off(draft.near, places) <= off(draft.near, draft.at) * (1.0 + 1e-9)
        assert nearest or apart(places, draft.at) < 1e-6, (links, seed)


@sampled(2)
@pytest.mark.parametrize("links", [4, 5, 6, 7])
def test_of_all_ways_of_a_group_none_is_nearer_however_rough_near_is(links: int) -> None:
    """Off by about the length of a rod. Every way is listed by exclusion; the one that is taken is the
    nearest of them. Where a draft by chance has points that are placed one by one, `near` may be so rough
    that what lies there does not assemble: it is refused, and told where another lies."""
    for seed in range(MORE if MORE > 1 else 1 + (links < 6)):
        draft = linkage(9000 + 100 * links + seed, links)
        for p in draft.names:
            if p not in draft.points:
                draft.approximately(p, 1.2)
        case, places = draft.case(), None
        if AT_NEAR not in refusal(case):
            places = unless_even(case)
        if places is not None:
            ways = ways_of(case)
            assert ways.complete
            nearest = min(off(draft.near, way.points) for way in ways.ways)
            assert off(draft.near, places) <= nearest * (1.0 + 1e-9), (links, seed)


def test_of_two_ways_that_are_nearly_one_the_nearer_is_found() -> None:
    """The descent from `near` ends at one; the other lies 0.01 beside it and is nearer to `near`."""
    draft = linkage(91212, 12)
    for p in draft.names:
        if p not in draft.points:
            draft.approximately(p, 0.15)
    assert apart(places_of(draft.case()), draft.at) < 1e-6


def places_near(text: str) -> dict[str, Place]:
    """What a case says under `near`."""
    return {p: (float(x), float(y)) for p, (x, y) in yaml.safe_load(text)["near"].items()}


def ring(count: int, seed: int) -> tuple[str, dict[str, Place]]:
    """Points joined in a ring by rods, each on a leg of its own."""
    rng = Random(seed)
    at: dict[str, Place] = {}
    for k in range(count):
        turn = math.tau * k / count
        at[f"G{k}"] = (math.cos(turn), math.sin(turn))
        out, off = 0.5 + rng.uniform(-0.1, 0.1), turn + rng.uniform(0.4, 1.2)
        at[f"P{k}"] = (at[f"G{k}"][0] + out * math.cos(off), at[f"G{k}"][1] + out * math.sin(off))
    ground = ", ".join(f"G{k}: [{at[f'G{k}'][0]!r}, {at[f'G{k}'][1]!r}]" for k in range(count))
    bars = [(f"G{k}", f"P{k}") for k in range(count)]
    bars += [(f"P{k}", f"P{(k + 1) % count}") for k in range(count)]
    lengths = ", ".join(f"{a}-{b}: {math.dist(at[a], at[b])!r}" for a, b in bars)
    near = ", ".join(
        f"P{k}: [{at[f'P{k}'][0] + rng.uniform(-1, 1) * 2e-3:.6f}, "
        f"{at[f'P{k}'][1] + rng.uniform(-1, 1) * 2e-3:.6f}]" for k in range(count)
    )  # fmt: skip
    text = f"points: {{{ground}}}\nlengths: {{{lengths}}}\nnear: {{{near}}}\n"
    joints = "".join(f"  - {{pin: [1, {k + 2}], at: G{k}}}\n" for k in range(count))
    return f"icsolve: 1\n{text}joints:\n{joints}", at


@sampled(2)
@pytest.mark.parametrize("count", [3, 6, 12, 28, *([40] * (MORE > 1))])
def test_rings_of_points_each_on_a_leg(count: int) -> None:
    text, at = ring(count, count)
    places = places_of(load(text))
    assert max(math.dist(places[p], at[p]) for p in at) < 1e-6


@pytest.mark.parametrize("seed", [5002, *([5004, 5008, *range(5009, 5021)] if MORE > 1 else [])])
def test_rings_of_forty_beside_others(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of two ways 1.4e-3 apart the one that is nearer to `near`, and one to which plain steps do not lead.

    Where the one is expected from the other, it is nearer than that.
    """
    pair, shares = newton._pair, []

    def kept(group: PointGroup, workspace: Workspace, end: newton.Start, reach: float) -> list[newton.Start]:
        starts = pair(group, workspace, end, reach)
        start = max(starts, key=lambda other: apart(end, other))
        there = newton._descend(group, workspace, start, 1.0, 60).end
        if apart(end, there) < 0.01:
            shares.append(apart(start, there) / apart(end, there))
        return starts

    def apart(one: newton.Start, two: newton.Start) -> float:
        return math.hypot(*(math.dist(one[p], two[p]) for p in one))

    monkeypatch.setattr(newton, "_pair", kept)
    text, at = ring(40, seed)
    places = places_of(load(text))
    near = {p: at for p, at in places_near(text).items() if p in places}
    assert off(near, places) <= off(near, at) * (1.0 + 1e-9)
    assert max(shares, default=1.0 if seed < 5009 else 0.0) < 0.7


def test_data_that_no_place_meets_are_violated_least_where_the_descent_from_near_ends(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A plate on three legs that are too short: there the gradient of the squares' sum vanishes."""
    descent, ends = newton._least_residual, []

    def kept(group: PointGroup, workspace: Workspace, start: newton.Start, reach: float) -> newton.Start:
        end = descent(group, workspace, start, reach)
        for at in (start, end):
            workspace.points.update(at)
            values, rows = group.system(workspace)
            slope = [sum(row.get(k, 0.0) * v for row, v in zip(rows, values, strict=True)) for k in range(6)]
            ends.append((math.hypot(*values), math.hypot(*slope)))
        return end

    monkeypatch.setattr(newton, "_least_residual", kept)
    for k in range(6 * MORE):
        rng = Random(f"legs {k}")
        feet, near = ([[rng.uniform(-s, s) for _ in "xy"] for _ in range(3)] for s in (6.0, 4.0))
        text = f"""icsolve: 1
points: {{{", ".join(f"{p}: {at}" for p, at in zip("ABC", feet, strict=True))}}}
lengths: {{AP: 0.3, BQ: 0.2, CR: 0.4, PQ: 1, QR: {rng.uniform(0.6, 1.5)}, PR: 0.9}}
near: {{{", ".join(f"{p}: {at}" for p, at in zip("PQR", near, strict=True))}}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [1, 3], at: B}}, {{pin: [1, 4], at: C}}]
"""
        with pytest.raises(SceneError, match="no position found"):
            solve_figure(load(text), ["P"])
    assert len(ends) == 12 * MORE
    for (before, steep), (after, flat) in zip(ends[::2], ends[1::2], strict=True):
        assert after < before and flat < 1e-3 * steep


@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e3])
def test_of_two_placements_one_is_nearer_by_a_share_of_how_far_off_both_are(unit: float) -> None:
    """Whatever the unit; (-1, 0) and (1, 0) seen from a place a little left of the line midway."""
    ours, theirs = [(-unit, 0.0)], [(unit, 0.0)]
    for height in (20.0, 50.0):
        both = modes.SIDEWAYS * math.hypot(1.0, height)
        for left, clear in ((0.95 * both, False), (1.05 * both, True)):
            assert modes.nearer(ours, theirs, [(-left * unit, height * unit)]) == clear
            assert not modes.nearer(theirs, ours, [(-left * unit, height * unit)])


def test_starts_are_spread_evenly_over_a_square() -> None:
    """Of 400 places a hundred in each quarter, a few more or less, for every point of a group."""
    for j in range(3):
        places = [newton.even(k, j, (5.0, -2.0), 0.5) for k in range(1, 401)]
        assert all(max(abs(x - 5.0), abs(y + 2.0)) <= 0.5 for x, y in places)
        for east in (False, True):
            for north in (False, True):
                assert 90 <= sum((x > 5.0, y > -2.0) == (east, north) for x, y in places) <= 110


def rods(at: dict[str, Place], names: list[str]) -> tuple[Workspace, PointGroup]:
    """All but the first two points as one group, placed by a rod from each of the two."""
    a, b, *free = names
    lengths = [(p, q, math.dist(at[p], at[q])) for q in free for p in (a, b)]
    text = f"points: {{{a}: {[*at[a]]}, {b}: {[*at[b]]}}}\n"
    text += f"lengths: {{{', '.join(f'{p}-{q}: {size!r}' for p, q, size in lengths)}}}\n"
    case = load(f"icsolve: 1\n{text}joints: [{{pin: [1, 2], at: {a}}}]\n")
    workspace = Workspace(case, frame_of(case), FLOATS)
    workspace.points |= {p: normalised(workspace.frame, at[p]) for p in (a, b)}
    data = [datum for datum in data_of(case) if datum.kind == LENGTH]
    return workspace, PointGroup(tuple(free), tuple(map(FigureEquation, data)))


@pytest.mark.parametrize("off", [1e-4, 1e-3, 1e-2])
def test_two_ways_close_together_are_expected_where_they_are(off: float) -> None:
    """Two rods nearly in line: from the middle of both places and from either, to second order; of rods that
    do not reach none is."""
    at = {"A": (0.0, 0.0), "B": (1.0, 0.0), "P": (0.4, off)}
    workspace, group = rods(at, ["A", "B", "P"])
    for x, y in ((0.4, 0.0), (0.4, 0.3 * off), (0.4, off), (0.4, -off)):
        one, two = newton._pair(group, workspace, {"P": normalised(workspace.frame, (x, y))}, 0.6)
        found = sorted(case_point(workspace.frame, start["P"])[1] for start in (one, two))
        assert found == pytest.approx([-off, off], rel=0.02)
    workspace.points["B"] = (workspace.points["B"][0] + 1e-3, 0.0)
    assert not newton._pair(group, workspace, {"P": normalised(workspace.frame, (0.4, 0.0))}, 0.6)


def test_starts_about_near_begin_opposite_to_what_was_found_and_lie_as_near() -> None:
    near, end = {"P": (0.3, -0.2), "Q": (1.0, 0.5)}, {"P": (0.4, 0.1), "Q": (0.8, 0.6), "R": (0.1, 0.7)}
    first, *others = newton._about(near, end)
    assert len(others) == newton.SPREAD // 2 and first["R"] == end["R"]
    for p, about in near.items():
        assert [(u + v) / 2.0 for u, v in zip(first[p], end[p], strict=True)] == pytest.approx(about)
    radius = max(math.dist(near[p], end[p]) for p in near)
    for start in others:
        for p, (x, y) in {**end, **near}.items():
            assert max(abs(start[p][0] - x), abs(start[p][1] - y)) <= radius


def test_of_the_starts_by_closed_forms_one_is_the_figure_that_near_is_exact_for() -> None:
    """With one point held where it is, and its rods to the others: on whichever side these lie."""
    for signs in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        at = {"A": (0.0, 0.0), "B": (1.0, 0.2), "P": (0.3, 0.6 * signs[0]), "Q": (0.5, 0.4 * signs[1])}
        workspace, group = rods(at, ["A", "B", "P", "Q"])
        places = {p: normalised(workspace.frame, at[p]) for p in "PQ"}
        starts = list(newton._constructed(group, workspace, {"P": places["P"]}, ["P"], 0.6))
        assert min(max(math.dist(start[p], places[p]) for p in "PQ") for start in starts) < 1e-12


SIX = """
points: {{A: [0, 0], D: [6, 0]}}
lengths: {{AB: 2, BC: 5, CD: 3.5, AE: 3, DF: 4.5, EG: {eg}, FG: {fg}}}
angles: {{AB: 80, BAE: 35, CDF: -25}}
near: {{{near}}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{pin: [4, 1], at: D}}
  - {{pin: [2, 5], at: E}}
  - {{pin: [5, 6], at: G}}
  - {{pin: [6, 4], at: F}}
"""


def six(near: str, eg: float = 3.5, fg: float = 3.0) -> Case:
    return load("icsolve: 1\n" + SIX.format(eg=eg, fg=fg, near=near))


@pytest.mark.parametrize("near", ["C: [5.5, 3.4], G: [4.5, 6]", "C: [5.5, 3.4]", "C: [5, 3.5], F: [7, 4.5]"])
def test_a_way_that_does_not_assemble_is_not_exchanged_for_another(near: str) -> None:
    """With rods EG and FG that do not reach, C would have to land on the other side."""
    drawn = places_of(six("C: [5.5, 3.4], G: [4.5, 6]", 5.0, 5.0))
    assert drawn["C"] == pytest.approx((5.14047, 3.39282), abs=1e-5)
    with pytest.raises(SceneError) as refused:
        places_of(six(near))
    assert refused.value.status == Status.CANNOT_ASSEMBLE
    for part in ("near", "G", "C", "(3.21819, -2.12404)"):
        assert part in refused.value.message
    assert places_of(six("C: [3.2, -2.1], G: [6, 0]"))["C"] == pytest.approx((3.21819, -2.12404), abs=1e-3)


def test_the_sum_of_squares_decides_where_two_points_disagree() -> None:
    """C lies a little nearer to the one side, G clearly on the other."""
    places = places_of(six("C: [4.2, 0.75], G: [2.2, 6.3]", 5.0, 5.0))
    assert places["C"][1] > 0.0
    below = places_of(six("C: [3.2, -2.1], G: [6, 0]", 5.0, 5.0))
    other = places_of(six(f"C: [4.2, 0.55], G: [{below['G'][0]}, {below['G'][1]}]", 5.0, 5.0))
    assert other["C"][1] < 0.0


TURNED = "points: {A: [0, 0], D: [4, 0]}\nlengths: {AB: 2, BC: 3, CD: 3}\nangles: {%s}\nnear: {C: [3, 3]%s}\n"
PINS = "joints:\n" + "".join(
    f"  - {{pin: [{k}, {k % 4 + 1}], at: {p}}}\n" for k, p in ((1, "A"), (2, "B"), (3, "C"), (4, "D"))
)


def turned(angle: str, near: str) -> Case:
    return load("icsolve: 1\n" + TURNED % (angle, near) + PINS)


@pytest.mark.parametrize("angle", ["BAD: 60", "AB: -60"])
def test_a_near_on_the_mirrored_side_of_an_angle_is_said(angle: str) -> None:
    """BAD: 60 counts from AB to AD, so that B lies below."""
    assert places_of(turned(angle, ""))["B"][1] < 0.0
    assert places_of(turned(angle, ", B: [1.1, -1.6]"))["B"][1] < 0.0
    with pytest.raises(SceneError) as refused:
        places_of(turned(angle, ", B: [1.1, 1.6]"))
    assert refused.value.status == Status.INCONSISTENT
    for part in ("near", "B", "mirrored", angle.split(":", maxsplit=1)[0]):
        assert part in refused.value.message


def test_a_near_that_is_only_rough_is_not_taken_for_a_mirrored_one() -> None:
    """Off by a twenty-fifth of the figure's size, to whichever side; many are mirrored by less than that."""
    placed = 0
    for seed in range(150 * MORE):
        draft = sequence(seed, 5 + seed % 8)
        size = max(
            max(at[k] for at in draft.at.values()) - min(at[k] for at in draft.at.values()) for k in (0, 1)
        )
        for p, (x, y) in draft.at.items():
            turn = draft.rng.uniform(0.0, math.tau)
            draft.near[p] = (x + 0.04 * size * math.cos(turn), y + 0.04 * size * math.sin(turn))
        message = refusal(draft.case())
        assert "mirrored" not in message, seed
        placed += not message
    assert placed > 140 * MORE


@pytest.mark.parametrize(("y", "told"), [(0.0, False), (0.4, True), (1.5, True)])
def test_a_near_means_the_mirrored_place_that_is_nearer_than_a_guess_may_be_off(y: float, told: bool) -> None:
    """B lies at (1, -1.73), mirrored at (1, 1.73)."""
    assert ("mirrored" in refusal(turned("AB: -60", f", B: [1.1, {y}]"))) == told


def test_a_near_farther_off_than_half_the_figure_is_said() -> None:
    figure = solve_figure(turned("DAB: 60", ", B: [-4, -3]"))
    assert [note for note in figure.notes if "near" in note and "B" in note]
    assert not solve_figure(turned("DAB: 60", ", B: [1.2, 1.5]")).notes


def test_near_of_a_point_that_nothing_asks_for_counts_as_the_others() -> None:
    """The coupler's point E picks the side of C."""
    text = TURNED.replace("CD: 3", "CD: 3, BE: 2, CE: 2") % ("DAB: 60", "")
    text = text.replace("C: [3, 3]", "E: [3.4, 3.4]")
    figure = solve_figure(load("icsolve: 1\n" + text + PINS), ["B", "C"])
    assert figure.points["C"][1] > 0.0


def test_a_group_that_does_not_close_about_near_is_not_found_elsewhere_in_silence() -> None:
    """One rod made longer or shorter: what is found lies about `near`, or that is said."""
    refusals = 0
    for seed in range(few(30) * MORE):
        draft = linkage(9000 + seed, 3 + seed % 5)
        for p in draft.names:
            if p not in draft.points:
                draft.approximately(p, 0.02)
        rod = draft.rng.randrange(len(draft.lengths))
        said = draft.lengths[rod].value
        draft.lengths[rod] = draft.lengths[rod]._replace(value=said._replace(value=said.value * 1.4))
        try:
            figure = solve_figure(draft.case())
        except SceneError as refused:
            refusals += refused.status == Status.CANNOT_ASSEMBLE and "near" in refused.message
            continue
        places = {p: case_point(figure.frame, at) for p, at in figure.points.items()}
        spans = [max(at[k] for at in places.values()) - min(at[k] for at in places.values()) for k in (0, 1)]
        far = [p for p in draft.near if math.dist(places[p], draft.near[p]) > max(spans) / 2.0]
        assert not far or any("near" in note for note in figure.notes)
    assert refusals >= few(3) * MORE


def test_a_group_whose_near_is_far_from_all_that_comes_close_is_found_and_that_said() -> None:
    """A plate on three legs, with a `near` farther off than the figure is large."""
    text = """icsolve: 1
points: {A: [0, 0], B: [5, 0], C: [3, 4]}
lengths: {AP: 1.803, BQ: 1.664, CR: 1.612, PQ: 3.513, QR: 2.247, PR: 1.836}
near: {P: [3.7, -4.3], Q: [3.4, 4.1], R: [-1.1, 7.9]}
joints: [{pin: [1, 2], at: A}, {pin: [1, 3], at: B}, {pin: [1, 4], at: C}]
"""
    figure = solve_figure(load(text), ["P", "Q", "R"])
    assert any("near" in note for note in figure.notes)


BARS = ((0, 3), (1, 4), (2, 5), (3, 4), (4, 5), (3, 5))
"""A plate DEF (3 to 5) on three legs from A, B and C (0 to 2): no point has an order of construction."""


def on_legs(sizes: np.ndarray, places: np.ndarray) -> Case:
    """The plate, (6,) lengths of BARS; ``places`` (6, 2), the last three roughly."""
    at = ["[{:.9f}, {:.9f}]".format(*place) for place in places]
    names = [f"{'ABCDEF'[i]}{'ABCDEF'[j]}" for i, j in BARS]
    return load(
        f"icsolve: 1\npoints: {{A: {at[0]}, B: {at[1]}, C: {at[2]}}}\n"
        f"lengths: {{{', '.join(f'{n}: {s:.9f}' for n, s in zip(names, sizes, strict=True))}}}\n"
        f"near: {{D: {at[3]}, E: {at[4]}, F: {at[5]}}}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [1, 3], at: B}, {pin: [1, 4], at: C}, {pin: [2, 5], at: D}, "
        "{pin: [3, 5], at: E}, {pin: [4, 5], at: F}]\n"
    )


def figure_or_refusal(case: Case) -> tuple[Figure | None, SceneError | None]:
    try:
        return solve_figure(case), None
    except SceneError as refused:
        return None, refused


def any_way(case: Case) -> bool:
    """Whether the figure assembles in some way, by exclusion."""
    try:
        return bool(ways_of(case).ways)
    except SceneError:
        return False


def misses(places: np.ndarray, sizes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """By how much squares of lengths miss, (6,), and their derivatives by D, E and F, (6, 6)."""
    slopes = np.zeros((6, 12))
    for n, (i, j) in enumerate(BARS):
        across = places[i] - places[j]
        slopes[n, 2 * i : 2 * i + 2], slopes[n, 2 * j : 2 * j + 2] = 2 * across, -2 * across
    lengths = np.array([np.sum((places[i] - places[j]) ** 2) for i, j in BARS])
    return lengths - sizes**2, slopes[:, 6:]


def downhill(places: np.ndarray, sizes: np.ndarray) -> np.ndarray:
    """Where the sum of the squares of the misses is least, downhill in damped steps of least squares."""
    damping = 1.0
    for _ in range(400):
        off, slopes = misses(places, sizes)
        step = np.linalg.solve(slopes.T @ slopes + damping * np.eye(6), -slopes.T @ off).reshape(3, 2)
        after = np.vstack([places[:3], places[3:] + step])
        better = np.linalg.norm(misses(after, sizes)[0]) < np.linalg.norm(off)
        places, damping = (after, damping / 3) if better else (places, damping * 4)
        if damping > 1e12:
            break
    return places


@sampled(3, "rough")
@pytest.mark.parametrize(("seed", "rough"), crossed(range(12 * MORE), [0.02, 0.15, 0.4]))
def test_a_way_of_a_group_that_dies_is_not_exchanged_for_one_that_is_farther(seed: int, rough: float) -> None:
    """As of a dyad: where the data come closest to being met, downhill from `near`, is the way that `near`
    means; if they are not met there, a way that lies twice as far is no answer, and is told. About a way
    that assembles nothing is refused for it."""
    random = np.random.default_rng([seed, round(100 * rough)])
    places = random.uniform(-2.0, 2.0, (6, 2))
    sizes = np.array([np.linalg.norm(places[i] - places[j]) for i, j in BARS])
    near = places.copy()
    near[3:] += random.normal(0.0, 0.01, (3, 2))
    met = on_legs(sizes, near)
    assert unless_even(met) is not None or np.linalg.cond(misses(places, sizes)[1]) > 20.0
    sizes[2] *= 1.0 + (rough if seed % 2 else -rough)
    beside = downhill(near, sizes)
    dead = float(np.linalg.norm(misses(beside, sizes)[0])) > 1e-6
    away = float(np.linalg.norm(beside - near))
    found, refused = figure_or_refusal(on_legs(sizes, near))
    if refused is not None:
        if refused.status == Status.AMBIGUOUS:  # between two
            assert "about as far" in refused.message
            return
        assert refused.status == Status.CANNOT_ASSEMBLE
        assert dead or away > 2.0  # what lies half a figure off is no more meant than what misses
        assert ("assembles only with" in refused.message) == any_way(on_legs(sizes, near)), refused.message
        return
    assert found is not None
    at = np.array([case_point(found.frame, found.points[p]) for p in "DEF"])
    assert not dead or float(np.linalg.norm(at - near[3:])) < 2.0 * away


FOLDED = """icsolve: 1
points: {{A: [0, 0], D: [4, 0]}}
lengths: {{AB: 1, BC: 2, CD: 1.{off:026d}, DE: 1.5}}
angles: {{AB: 0, CDE: {turned}}}
near: {{{point}: [{near[0]!r}, {near[1]!r}]}}
joints: [{{pin: [1, 2], at: A}}, {{pin: [2, 3], at: B}}, {{pin: [3, 4], at: C}}, {{pin: [4, 1], at: D}}]
loads: {{P: {{force: 100, link: 4, at: E, angle: 45}}, T: {{torque: unknown, link: 2}}}}
"""
"""BC and CD are all but in line: by so many units of the 26th decimal CD is too long for that."""


@sampled(2)
@pytest.mark.parametrize("point", ["C", "E"])
def test_of_two_places_that_all_but_coincide_near_picks_the_same_however_near_they_are(point: str) -> None:
    """From 0.1 to 1e-13 apart, with `near` 0.3 off in some direction: of C itself, and of E, which a turned
    arm carries, so that its places lie apart across that. Where it is square to what parts them, within 3
    degrees, it is refused as equally near."""
    draw = Random(3)
    for _ in range(12):
        turned = draw.choice((0, 50, 140))
        home, across = (3.0, 0.0), 90.0
        if point == "E":
            home = (
                4.0 + 1.5 * math.cos(math.radians(180 + turned)),
                1.5 * math.sin(math.radians(180 + turned)),
            )
            across = 270.0 + turned
        toward = draw.choice((draw.uniform(-80, 80), draw.uniform(100, 260), 90.5, -89.0))
        way = math.radians(across + toward)
        near = (home[0] + 0.3 * math.cos(way), home[1] + 0.3 * math.sin(way))
        sides: set[object] = set()
        for power in (22, 18, 14, 10, 6, 2, 0):
            text = FOLDED.format(off=10**power, turned=turned, point=point, near=near)
            try:
                places = solve(load(text)).points
                gone = (places[point][0] - home[0], places[point][1] - home[1])
                sides.add(
                    gone[0] * math.cos(math.radians(across)) + gone[1] * math.sin(math.radians(across)) > 0
                )
            except SceneError as refused:
                sides.add(None if refused.status == Status.AMBIGUOUS else refused.message)
        assert sides == {None if abs(abs(toward) - 90) < 2 else abs(toward) < 90}, (turned, toward)


TRIAD = """icsolve: 1
points: {{A: [0, 0], D: {d}, E: {e}}}
lengths: {{AB: {ab}, BP: {bp}, DQ: {dq}, ER: {er}, {plate}}}
angles: {{AB: {free}{angle}}}
near: {{P: {p}, Q: {q}, R: {r}}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 6], at: P}}
  - {{pin: [6, 4], at: Q}}
  - {{pin: [6, 5], at: R}}
  - {{pin: [4, 1], at: D}}
  - {{pin: [5, 1], at: E}}
loads:
  T: {{torque: unknown, link: 2}}
  W: {{weight: 10, link: 6, at: Q}}
"""


@sampled(3, "beyond")
@pytest.mark.parametrize("beyond", [False, True])
@pytest.mark.parametrize("seed", range(few(60, 10)))
def test_a_straight_ternary_link_of_a_group_may_be_written_by_three_lengths(seed: int, beyond: bool) -> None:
    """PR + RQ = PQ, or RQ - PR = PQ: a flat triangle, whose lengths are dependent to first order. By two of
    them and the angle of R it is the same figure: in a scene, in the rows of a motion and of another
    length, and where rows with other numbers are read anew."""
    random = Random(f"straight {seed} {beyond}")

    def drawn(low: float, high: float) -> float:
        return round(random.uniform(low, high), 2)

    at = {"b": (0.5, 3**0.5 / 2), "p": (drawn(0.5, 1.5), drawn(2, 3)), "d": (drawn(4, 5), 0.0)}
    whole, along, turn = drawn(2.5, 3.5), drawn(0.8, 1.6), math.radians(drawn(-30, 30))
    for name, distance in (("q", whole), ("r", -along if beyond else along)):
        at[name] = (at["p"][0] + distance * math.cos(turn), at["p"][1] + distance * math.sin(turn))
    at["e"] = (drawn(1, 3), drawn(-2, -1))
    rods = {a + b: round(math.dist(at[a], at[b]), 6) for a, b in ("bp", "dq", "er")}
    rest = round(whole + along if beyond else whole - along, 2)
    numbers = {name: [round(x, 6) for x in place] for name, place in at.items() if name != "b"}
    plates = {
        f"PQ: {whole}, PR: {along}, RQ: {rest}": "",
        f"PQ: {whole}, PR: {along}": f", QPR: {180 if beyond else 0}",
    }
    by_lengths, by_angle = (
        load(TRIAD.format(ab=1, free=60, plate=plate, angle=angle, **rods, **numbers))
        for plate, angle in plates.items()
    )
    one, other = (solve(case) for case in (by_lengths, by_angle))
    assert one.points == other.points
    assert one.answers["T"].value == pytest.approx(other.answers["T"].value, rel=4e-16)
    assert one.answers["T"].error is not None
    for path, values in (
        ("angles.AB", 60 + np.arange(-2.0, 2.5, 0.5)),
        ("lengths.ER", rods["er"] + np.linspace(0, 0.01, 4)),
    ):
        rows, expected = (sweep(case, {path: values}) for case in (by_lengths, by_angle))
        assert [*rows.status] == [*expected.status]
        assert rows.answers["T"] == pytest.approx(expected.answers["T"], rel=1e-11, nan_ok=True)


@pytest.mark.parametrize("seed", range(few(40, 10)))
@pytest.mark.parametrize("links", [2, 3, 5, 8])
def test_a_ring_of_straight_ternary_links_is_placed_at_near(links: int, seed: int) -> None:
    draft = straight_plates(seed, links)
    assert apart(places_of(draft.case()), draft.at) < 1e-9


@pytest.mark.parametrize("group", [False, True])
@pytest.mark.parametrize("above", [False, True])
@pytest.mark.parametrize("seed", range(few(12, 6)))
def test_points_in_line_to_the_last_digits_of_doubles_are_in_line(
    seed: int, above: bool, group: bool
) -> None:
    """Lengths that a program writes: their sum misses the whole by a spacing of doubles or less.
    The scene is that of the direction, and a note says so; lengths in few decimals are what they are."""
    random = Random(f"doubles {seed}")
    whole, along = random.uniform(2.5, 3.5), random.uniform(0.8, 1.6)
    exact = Fraction(repr(whole)) - Fraction(repr(along))
    rest = float(exact)
    if (Fraction(repr(rest)) > exact) != above or Fraction(repr(rest)) == exact:
        rest = math.nextafter(rest, math.inf if above else -math.inf)
    form = TRIAD if group else STRAIGHT
    at = {"p": (0.9, 2.6), "q": (0.9 + whole, 2.6), "r": (0.9 + along, 2.6), "d": (4.6, 0), "e": (2, -1.5)}
    rods = {a + b: math.dist(at[a], at[b]) for a, b in (("p", "q"), ("d", "q"), ("e", "r"))}
    numbers = {name: list(place) for name, place in at.items()} | {"dq": rods["dq"], "er": rods["er"]}
    numbers |= {"ab": 1, "free": 60, "bp": math.dist((0.5, 3**0.5 / 2), at["p"])}
    plates = {f"PQ: {whole!r}, PR: {along!r}, RQ: {rest!r}": "", f"PQ: {whole!r}, PR: {along!r}": ", QPR: 0"}
    one, other = (
        solve(load(form.format(plate=plate, angle=angle, **numbers))) for plate, angle in plates.items()
    )
    assert one.answers["T"].value == pytest.approx(other.answers["T"].value, rel=1e-12)
    assert any("half a unit of the last digit" in note for note in one.notes)
    rounded = f"PQ: {whole:.4f}, PR: {along:.4f}, RQ: {round(whole, 4) - round(along, 4) - 1e-4:.4f}"
    with pytest.raises(SceneError):
        solve(load(form.format(plate=rounded, angle="", **numbers)))


STRAIGHT = """icsolve: 1
points: {{A: [0, 0], D: {d}}}
lengths: {{AB: {ab}, BP: {bp}, DQ: {dq}, {plate}}}
angles: {{AB: {free}, BP: 77{angle}}}
near: {{Q: {q}}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: P}}
  - {{pin: [3, 4], at: Q}}
  - {{pin: [4, 1], at: D}}
loads:
  T: {{torque: unknown, link: 2}}
  W: {{weight: 10, link: 3, at: R}}
"""


def boom(dice: Random, panels: int) -> tuple[str, dict[str, Place]]:
    """A lattice boom of bars by their lengths, from its foot D to the rod that holds its head: a case that is
    to have its `near`, and where the joints of the boom are."""
    at, joints = {"D": (0.0, 0.0)}, [f"J{k}" for k in range(1, panels + 2)]
    for k, name in enumerate(joints, 1):
        at[name] = (0.5 * k + dice.uniform(-0.05, 0.05), 0.4 * (k % 2) + dice.uniform(-0.05, 0.05))
    names = list(at)
    bars = [*pairwise(names), *zip(names, names[2:], strict=False)]
    lengths = ", ".join(f"{p}-{q}: {math.dist(at[p], at[q]):.6f}" for p, q in bars)
    x, y = at[names[-1]]
    rod = math.dist((-2.0 + 0.5, 1.0), (x, y))
    return (
        f"""icsolve: 1
points: {{A: [-2, 1], D: [0, 0]}}
lengths: {{AB: 0.5, B-{names[-1]}: {rod:.6f}, {lengths}}}
angles: {{AB: 0}}
NEAR
links: {{boom: [{", ".join(joints)}]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, boom], at: {names[-1]}}}
  - {{pin: [boom, 1], at: D}}
""",
        {p: at[p] for p in joints},
    )


def with_near(text: str, near: dict[str, Place]) -> Case:
    return load(
        text.replace("NEAR", f"near: {{{', '.join(f'{p}: [{x}, {y}]' for p, (x, y) in near.items())}}}")
    )


@pytest.mark.parametrize("panels", [4, 16, 40])
def test_a_link_of_many_triangles_is_found_from_where_its_joints_roughly_are(panels: int) -> None:
    """Two shapes of each, of which `near` means one: not all that they make together are tried."""
    text, at = boom(Random(f"boom {panels}"), panels)
    places = places_of(with_near(text, {p: (round(x, 1), round(y, 1)) for p, (x, y) in at.items()}))
    assert apart(at, {p: places[p] for p in at}) < 1e-3 * panels


@sampled(4)
@pytest.mark.parametrize("seed", range(40 * MORE))
def test_of_the_shapes_of_a_link_the_nearest_is_taken_wherever_near_is(seed: int) -> None:
    """Of some joints anywhere about: the way with the least sum of squared distances, or a refusal."""
    dice = Random(f"shapes {seed}")
    text, at = boom(dice, dice.randint(2, 4))
    wide = dice.choice([0.05, 0.5, 2.0])
    some = dice.sample(sorted(at), dice.randint(1, len(at)))
    near = {p: (at[p][0] + dice.uniform(-wide, wide), at[p][1] + dice.uniform(-wide, wide)) for p in some}
    every = [off(near, way.points) for way in ways_of(load(text.replace("NEAR", ""))).ways]
    try:
        taken = off(near, places_of(with_near(text, near)))
    except SceneError as refused:
        if refused.status == Status.AMBIGUOUS or "lies at near" in refused.message:
            return
        raise
    assert taken == pytest.approx(min(every), rel=1e-9)
