"""A construction from end to end: order the steps, walk the ways, compare the spare data, choose."""

from __future__ import annotations

from icsolve.arithmetic import FLOATS
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.figure.board import Board
from icsolve.figure.choice import choose
from icsolve.figure.compare import compare, notes_of, size_of
from icsolve.figure.data import Datum
from icsolve.figure.frame import Frame
from icsolve.figure.order import Order, order_of
from icsolve.figure.refusals import Miss
from icsolve.figure.solution import Figure
from icsolve.figure.steps import Given
from icsolve.figure.ways import Walker, Way, refusal
from icsolve.figure.words import plain

MOST_RETRIES = 20


def construct(case: Case, frame: Frame, goal: list[str], names: list[str]) -> Figure:
    """The wanted points of a figure that needs construction (see ``solve_figure``)."""
    banned: frozenset[frozenset[object]] = frozenset()
    for _ in range(MOST_RETRIES):
        try:
            order = order_of(case, goal, banned)
        except SceneError as error:
            if not banned:
                raise
            raise SceneError(Status.UNDERDETERMINED, degenerate.message) from error
        outcome = _assemble(case, frame, order)
        if isinstance(outcome, Figure):
            return outcome._replace(skipped=tuple(plain(p) for p in names if p not in outcome.points))
        degenerate = outcome
        if outcome.loci is None:
            break
        banned |= {outcome.loci}
    raise SceneError(degenerate.status, degenerate.message)


def _assemble(case: Case, frame: Frame, order: Order) -> Figure | Miss:
    """The one way in which an order of construction assembles, or why it does not."""
    board = Board(case, frame, FLOATS)
    walk = Walker(order, board).walk()
    if not walk.ways:
        return refusal(walk)
    fits: list[tuple[Way, dict[Datum, float], float]] = []
    misses: list[Miss] = []
    for way in walk.ways:
        board.points = way.points
        size = size_of(board, order.points)
        data = [d for d in order.facts.data if all(p in way.points for p in d.points)]
        miss, offs = compare(board, way.steps, data, size)
        if miss is None:
            fits.append((way, offs, size))
        else:
            misses.append(miss)
    if not fits:
        return min(misses, key=lambda miss: miss.amount)
    return _figure(board, order, fits)


def _figure(board: Board, order: Order, fits: list[tuple[Way, dict[Datum, float], float]]) -> Figure:
    way = choose(board, [fit[0] for fit in fits], order.points)
    offs, size = next((offs, size) for each, offs, size in fits if each is way)
    board.points = way.points
    given = any(isinstance(step, Given) for step in order.steps)
    notes = notes_of(board, offs, order.used(), given, size)
    points = {p: way.points[p] for p in order.points}
    return Figure(board.frame, points, way.steps, tuple(notes), ())
