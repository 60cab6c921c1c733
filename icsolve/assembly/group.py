"""Points that have no order of construction: the smallest group that its data determine together."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from icsolve.assembly.board import Board, Key
from icsolve.assembly.data import CORNER, LENGTH, LINE, MEAN, Datum
from icsolve.assembly.equations import Equation, Pivot, Unknown, solved
from icsolve.assembly.free import underdetermined
from icsolve.assembly.given import told
from icsolve.assembly.matching import groups_of, leading, system_of
from icsolve.assembly.sheet import Drawing
from icsolve.case import Case
from icsolve.numbers.arithmetic import Scalar


class Group(NamedTuple):
    """Points placed by Newton's method. ``start`` is the solution that was settled on.

    ``place`` takes ``board.rounds`` steps from there with the elimination's order held: at the
    solution, one step carries the derivatives by all data.
    """

    targets: tuple[str, ...]
    equations: tuple[Equation, ...]
    start: tuple[tuple[float, float], ...] = ()
    order: tuple[Pivot, ...] = ()

    @property
    def name(self) -> str:
        """What the step does."""
        return told(self)

    def place(self, board: Board) -> None:
        """Put the points, and improve them."""
        for target, at in zip(self.targets, self.start, strict=True):
            board.points[target] = board.starts.get(target, at)
        unknown = set(self.unknowns())
        for _ in range(board.rounds):
            self.improve(board, unknown)

    def improve(self, board: Board, unknown: set[Unknown]) -> None:
        """One Newton step."""
        rows = [equation.row(board) for equation in self.equations]
        inner = [{u: v for u, v in row.by.items() if u in unknown} for row in rows]
        move = solved(inner, [row.value for row in rows], list(self.order))
        for target in self.targets:
            x, y = board.points[target]
            board.points[target] = (x - _moved(move, target, 0), y - _moved(move, target, 1))

    def unknowns(self) -> list[Unknown]:
        """The coordinates that it solves for."""
        return [(target, part) for target in self.targets for part in (0, 1)]

    def data(self) -> tuple[Datum, ...]:
        """The data of its equations."""
        return tuple(dict.fromkeys(equation.datum for equation in self.equations))

    def needs(self) -> tuple[Key, ...]:
        """The points that its equations bind to it."""
        own = set(self.targets)
        return tuple(dict.fromkeys(p for e in self.equations for p in e.datum.points if p not in own))


def _moved(move: dict[Unknown, Scalar], target: str, part: int) -> Scalar:
    return move.get((target, part), 0.0)


def _counting(drawing: Drawing) -> list[Datum]:
    """The data without those that only repeat the shape of a loose sheet: they hold nothing more."""
    used = {datum for step in drawing.steps for datum in step.data()}
    shapes = [sheet.placed.keys() for sheet in drawing.sheets[1:]]
    return [
        datum
        for datum in drawing.facts.data
        if datum in used
        or datum.kind not in (LENGTH, CORNER, LINE, MEAN)
        or not any(shape >= set(datum.points) for shape in shapes)
    ]


def next_group(drawing: Drawing, case: Case, wanted: Iterable[str]) -> tuple[Group, tuple[str, ...]]:
    """The smallest group that leads to the wanted points.

    Raises
    ------
    SceneError
        ``underdetermined`` with what is free.
    """
    placed = drawing.ground.placed.keys()
    goal = [p for p in wanted if p not in placed]
    system = system_of(_counting(drawing), placed, goal)
    goal = leading(system, goal)
    if any((p, part) in system.free for p in goal for part in (0, 1)):
        raise underdetermined(case, system, placed, goal)
    points = min(groups_of(system, goal), key=len)
    own = {(p, part) for p in points for part in (0, 1)}
    equations = tuple(system.equations[i] for i in sorted(system.matched[u] for u in own))
    return Group(points, equations), points
