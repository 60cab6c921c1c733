"""Laws over random figures: what was measured off a figure gives the figure back."""

from __future__ import annotations

import math

import pytest

from figure_drafts import Draft, aligned, block_on_a_bent_link, framework, sequence
from icsolve.assembly import Figure, case_point, solve_figure
from icsolve.assembly.refusals import step_words
from icsolve.errors import SceneError, Status
from sizes import MORE, few


def error(draft: Draft, figure: Figure) -> float:
    return max(math.dist(case_point(figure.frame, figure.points[p]), at) for p, at in draft.at.items())


def off_near(draft: Draft, places: dict[str, tuple[float, float]]) -> float:
    return math.hypot(*(math.dist(draft.near[p], places[p]) for p in draft.near))


def solved(draft: Draft) -> Figure | None:
    """The figure; None where `near` does not decide, or lies at a way that misses by far less than `near` is
    off, and where two centroids of the same points coincide."""
    try:
        return solve_figure(draft.case())
    except SceneError as refused:
        if refused.status == Status.AMBIGUOUS and "about as far" in refused.message:
            return None
        if refused.status == Status.CANNOT_ASSEMBLE and (
            "these coincide" in refused.message or "what lies at near: does not" in refused.message
        ):
            return None
        raise


def errors(drafts: list[Draft]) -> list[float]:
    """Errors of the figures found, sorted.

    `near` is off by 0.02, so now and then another assembly is as near: such a figure counts only where
    no point of it is nearer to its `near` than the figure that was measured.
    """
    found = []
    for draft in drafts:
        if len({*draft.at.values()}) < len(draft.at):
            continue  # about two points in one place another may lie anywhere
        figure = solved(draft)
        if figure is None:
            continue
        miss = error(draft, figure)
        places = {p: case_point(figure.frame, at) for p, at in figure.points.items()}
        if miss > 1e-6 and any(
            math.dist(places[p], draft.near[p]) < math.dist(draft.at[p], draft.near[p])
            for p in draft.near
            if math.dist(places[p], draft.at[p]) > 1e-6
        ):
            continue
        found.append(miss)
    return sorted(found)


@pytest.mark.parametrize("count", [5, 9, 20])
def test_sequences_of_data_of_every_kind(count: int) -> None:
    """The errors are a figure's own condition times rounding; the worst of hundreds is badly conditioned."""
    many = few(200) * MORE
    found = errors([sequence(seed, count) for seed in range(many)])
    assert len(found) > 0.95 * many
    assert found[len(found) // 2] < 3e-13
    assert found[int(0.9 * len(found))] < 1e-11
    assert found[-1] < 1e-6


def test_bars_and_corners_that_leave_shapes_in_the_middle_of_chains() -> None:
    many = few(200) * MORE
    drafts = [framework(seed, 8, 0.0, 0.4) for seed in range(many)]
    found = errors(drafts)
    assert len(found) > 0.975 * many
    assert found[len(found) // 2] < 1e-13
    assert found[-1] < 1e-8
    carried = sum(
        "carried" in step_words(step) for draft in drafts[:50] for step in solve_figure(draft.case()).steps
    )
    assert carried > 50


def test_frameworks_without_an_order_of_construction() -> None:
    """Three in ten have groups of 5 to 14 unknowns for Newton's method."""
    found = errors([framework(seed, 7, 0.4, 0.4) for seed in range(60 * MORE)])
    assert len(found) > 56 * MORE
    assert found[len(found) // 2] < 1e-13
    assert found[-1] < 1e-8


def test_points_on_lines_of_others_are_held_by_them() -> None:
    """A slot or a flat angle counts in a group too, also where the link that it shapes is drawn first."""
    many = few(150) * MORE
    drafts = [draft for seed in range(many) if (draft := aligned(seed, 6 + seed % 4)) is not None]
    assert len(drafts) > 0.26 * many
    found = errors(drafts)
    assert len(found) > 0.8 * len(drafts)
    assert found[len(found) // 2] < 1e-12
    assert found[int(0.9 * len(found))] < 1e-9


def test_a_guide_and_the_direction_along_it_are_one_line() -> None:
    """An angle from a guide to its block tells no second line for the guide's points, in whatever order they
    are drawn."""
    many = few(100) * MORE
    drafts = [draft for seed in range(many) if (draft := block_on_a_bent_link(seed)) is not None]
    assert len(drafts) > 0.3 * many
    found = errors(drafts)
    assert len(found) > 0.9 * len(drafts)
    assert found[len(found) // 2] < 1e-12
    assert found[-1] < 1e-8


def test_near_is_where_the_assembly_is_nearest() -> None:
    """Whatever is found is nearer to `near` than the figure measured, or is that figure."""
    for seed in range(40 * MORE):
        draft = framework(1000 + seed, 6, 0.5, 0.0)
        figure = solved(draft)
        if figure is None:
            continue
        places = {p: case_point(figure.frame, at) for p, at in figure.points.items()}
        assert error(draft, figure) < 1e-8 or off_near(draft, places) < 2 * off_near(draft, draft.at)


def test_the_order_of_mention_does_not_matter() -> None:
    """The same data shuffled give the same figure, to rounding."""
    for seed in range(30 * MORE):
        draft = sequence(seed)
        figures = [figure for _ in range(3) if (figure := solved(draft)) is not None]
        for figure in figures[1:]:
            places = [
                [case_point(each.frame, each.points[p]) for p in draft.names] for each in (figure, figures[0])
            ]
            assert max(map(math.dist, *places)) < 1e-9


def test_a_chain_of_four_bars_takes_time_in_proportion() -> None:
    """Two thousand dyads in a full run, each point by `near`: no recursion, no search."""
    draft = Draft(0, 0)
    draft.at = {"B0": (0.3, 1.0), "A0": (0.0, 0.0)}
    draft.coordinates("B0")
    count = few(2000)
    for k in range(1, count + 1):
        draft.at[f"A{k}"], draft.at[f"B{k}"] = (2.0 * k, 0.0), (2.0 * k + 0.3 + 0.1 * math.sin(k), 1.0)
        draft.coordinates(f"A{k}")
        draft.length(f"B{k - 1}", f"B{k}")
        draft.length(f"A{k}", f"B{k}")
        draft.approximately(f"B{k}", 0.02)
    case = draft.case()
    figure = solve_figure(case, [f"B{k}" for k in range(count + 1)])
    places = {p: case_point(figure.frame, at) for p, at in figure.points.items()}
    assert max(math.dist(places[p], draft.at[p]) for p in places) < 1e-9
    assert len(solve_figure(case, ["B3"]).steps) == 4
