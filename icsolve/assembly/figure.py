"""From a case to the points of its figure."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING, NamedTuple

from icsolve.assembly.data import GUIDE, LINE, Datum, data_of, names_of
from icsolve.assembly.residuals import agrees, size_of
from icsolve.assembly.steps import Given
from icsolve.assembly.workspace import Frame, Key, Point, Workspace, frame_of
from icsolve.case import Case, Coordinates
from icsolve.errors import SceneError
from icsolve.numbers.arithmetic import FLOATS, Arithmetic, Scalar

if TYPE_CHECKING:
    from icsolve.assembly.steps import Step


class Figure(NamedTuple):
    """The points of one position, and the construction that found them.

    ``points`` are in the normalised frame; ``steps`` ran in this order, with the branches that
    they settled on; ``notes`` are sentences for the reader; ``skipped`` names the points that
    nothing asked for.
    """

    frame: Frame
    points: dict[str, Point]
    steps: tuple[Step, ...]
    notes: tuple[str, ...] = ()
    skipped: tuple[str, ...] = ()


class Placement(NamedTuple):
    """Points of the same construction in another arithmetic.

    ``margins`` has, for each point where two loci meet, what must not be negative (normalised):
    gaps of circles, distances along rays. Callers with arrays test them outside. (Points on the
    cluster of a loose shape have keys of the cluster's number and the name.)
    """

    points: dict[str, Point]
    margins: dict[Key, tuple[Scalar, ...]]


def place(
    figure: Figure,
    case: Case,
    arithmetic: Arithmetic = FLOATS,
    rounds: int = 1,
    starts: Mapping[str, Point] | None = None,
) -> Placement:
    """Run a figure's construction again, on the numbers of a case of the same shape.

    The same steps with the same branches, without a test on any value.

    Parameters
    ----------
    rounds : Newton steps for groups without an order of construction; 1 is enough at the
        figure's own numbers, where that step carries the derivatives by all data
    starts : where such groups start (normalised); left out, at the figure's own points
    """
    workspace = Workspace(case, figure.frame, arithmetic)
    workspace.rounds, workspace.starts = rounds, starts or {}
    for step in figure.steps:
        step.place(workspace)
    return Placement({p: at for p, at in workspace.points.items() if isinstance(p, str)}, workspace.margins)


def solve_figure(case: Case, wanted: Collection[str] | None = None) -> Figure:
    """The figure of a case: the wanted points (None: every point), and those that they need.

    Raises
    ------
    SceneError
        ``underdetermined``, ``inconsistent``, ``cannot-assemble``, ``ambiguous``,
        ``near-singular``; the message says where, by how much, and what would mend it.
    """
    frame = frame_of(case)
    names = names_of(case)
    goal = list(names if wanted is None else dict.fromkeys(wanted))
    if all(_is_given(case, p) for p in goal):
        return _drawn(case, frame, goal, names)
    from icsolve.assembly.construct import construct

    return construct(case, frame, goal, names)


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
            notes.append(f"left out, as nothing needs it: {refusal.message}")
        else:
            placed[point] = None
    figure = solve_figure(case, placed)
    return figure._replace(notes=(*figure.notes, *dict.fromkeys(notes)))


def _is_given(case: Case, point: str) -> bool:
    place = case.points.get(point)
    return type(place) is Coordinates and place.x is not None and place.y is not None


def _drawn(case: Case, frame: Frame, goal: list[str], names: list[str]) -> Figure:
    """The figure where every point is given: nothing to construct, the other data are compared."""
    workspace = Workspace(case, frame, FLOATS)
    steps: tuple[Step, ...] = (Given(tuple(goal)),)
    steps[0].place(workspace)
    data = [d for d in data_of(case) if all(p in workspace.points for p in d.points)]
    notes = _compared(workspace, steps, data, goal) if data else ()
    points = {p: workspace.points[p] for p in goal}
    return Figure(frame, points, steps, notes, tuple(p.lstrip("@") for p in names if p not in points))


def _compared(
    workspace: Workspace, steps: tuple[Step, ...], data: list[Datum], goal: list[str]
) -> tuple[str, ...]:
    """Notes on the data that the coordinates make spare; guides that are met need none."""
    size = size_of(workspace, goal)
    if agrees(workspace, data, size) and all(d.kind in (GUIDE, LINE) for d in data):
        return ()
    from icsolve.assembly.residuals import compare, notes_of

    miss, offs = compare(workspace, steps, data, size)
    if miss is not None:
        raise SceneError(miss.status, miss.message)
    return notes_of(workspace, offs, frozenset(), True, size)
