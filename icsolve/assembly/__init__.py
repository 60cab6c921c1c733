"""The figure: lengths, angles, guides and coordinates of a case become points in one position.

`solve_figure` constructs the points that are wanted and settles the branches; `place` runs the same
construction again with another arithmetic (arrays, numbers on a tape, more digits).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

from icsolve.assembly.conditions import agrees, size_of
from icsolve.assembly.steps import Figure, Given, Placement, Step, place
from icsolve.assembly.workspace import (
    GUIDE,
    LINE,
    Datum,
    Frame,
    Key,
    Workspace,
    case_point,
    data_of,
    frame_of,
    given_points,
    names_of,
)
from icsolve.case import Case, bare_name
from icsolve.errors import SceneError
from icsolve.numbers import FLOATS
from icsolve.screws import Point
from icsolve.tuples import LateModule

if TYPE_CHECKING:
    from icsolve.assembly import refusals
else:
    refusals = LateModule("icsolve.assembly.refusals")

__all__ = [
    "LEFT_OUT",
    "NOT_NEEDED",
    "Figure",
    "Frame",
    "Key",
    "Placement",
    "Point",
    "case_point",
    "place",
    "placed_figure",
    "solve_figure",
]


def solve_figure(case: Case, wanted: Collection[str] | None = None) -> Figure:
    """The figure of a case.

    Parameters
    ----------
    case : the case
    wanted : names of points; None: every point. Those that they need are placed too

    Returns
    -------
    Figure
        Places in a frame of size 1 about the figure (``icsolve.assembly.case_point`` brings one back to case
        lengths), with how each was found.

    Raises
    ------
    SceneError
        ``underdetermined``, ``inconsistent``, ``cannot-assemble``, ``ambiguous``,
        ``near-singular``; the message says where, by how much, and what would mend it.
    """
    frame = frame_of(case)
    names = names_of(case)
    order = {name: n for n, name in enumerate(names)}  # whoever asks, a figure is constructed in one way
    goal = (
        names if wanted is None else sorted({*wanted}, key=lambda name: (order.get(name, len(order)), name))
    )
    if {*given_points(case)}.issuperset(goal):
        return _drawn(case, frame, goal, names)
    from icsolve.assembly.construction import construct

    return construct(case, frame, goal, names)


LEFT_OUT = "left out"
"""How a note begins on what can't be placed and no answer needs."""
NOT_NEEDED = f"{LEFT_OUT}, as nothing needs it: "


def placed_figure(case: Case, wanted: Collection[str], needed: Collection[str]) -> Figure:
    """The figure with the wanted points that the data place; those that are ``needed`` have to be.

    A note says of each of the others why it is left out. Raises SceneError as `solve_figure`, for needed
    points alone.
    """
    try:
        return solve_figure(case, wanted)
    except SceneError:
        solve_figure(case, needed)
    placed = dict.fromkeys(needed)
    notes = []
    for point in wanted:
        try:
            solve_figure(case, [*placed, point])
        except SceneError as refusal:
            notes.append(f"{NOT_NEEDED}{refusal.message}")
        else:
            placed[point] = None
    figure = solve_figure(case, placed)
    return figure._replace(notes=(*figure.notes, *dict.fromkeys(notes)))


def _drawn(case: Case, frame: Frame, goal: Sequence[str], names: Sequence[str]) -> Figure:
    """The figure where every point is given: nothing to construct, the other data are compared."""
    workspace = Workspace(case, frame, FLOATS)
    steps: tuple[Step, ...] = (Given(tuple(goal)),)
    steps[0].place(workspace)
    data = [d for d in data_of(case) if all(p in workspace.points for p in d.points)]
    notes = _compared(workspace, steps, data, goal) if data else ()
    points = {p: workspace.points[p] for p in goal}
    return Figure(frame, points, steps, notes, tuple(bare_name(p) for p in names if p not in points))


def _compared(
    workspace: Workspace, steps: tuple[Step, ...], data: list[Datum], goal: Sequence[str]
) -> tuple[str, ...]:
    """Notes on the data that the coordinates make spare; guides that are met need none."""
    size = size_of(workspace, goal)
    if agrees(workspace, data, size) and all(d.kind in (GUIDE, LINE) for d in data):
        return ()
    miss, offs = refusals.compare(workspace, steps, data, size)
    if miss is not None:
        raise SceneError(miss.status, miss.message)
    return refusals.notes_of(workspace, offs, frozenset(), True, size)
