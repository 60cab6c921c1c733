"""A construction from end to end: order the steps, walk the ways, compare the spare data, choose."""

from __future__ import annotations

from icsolve.assembly.board import Board
from icsolve.assembly.data import Datum
from icsolve.assembly.frame import Frame
from icsolve.assembly.given import Given
from icsolve.assembly.lead import leading_to, points_of
from icsolve.assembly.misfit import agrees, size_of
from icsolve.assembly.order import Order, order_of
from icsolve.assembly.refusals import Miss
from icsolve.assembly.solution import Figure
from icsolve.assembly.ways import Walker, Way, refusal
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import FLOATS

MOST_RETRIES = 20

Fit = tuple[Way, dict[Datum, float]]
"""A way that agrees with all data, and how far off each is."""


def construct(case: Case, frame: Frame, goal: list[str], names: list[str]) -> Figure:
    """The wanted points of a figure that needs construction (see ``solve_figure``)."""
    try:
        figure = _constructed(case, frame, goal, best_effort=False)
    except SceneError as error:
        if error.status != Status.AMBIGUOUS or set(names) <= set(goal):
            raise
        figure = _by_the_rest(case, frame, goal, names, error)
    return figure._replace(skipped=tuple(p.lstrip("@") for p in names if p not in figure.points))


def _by_the_rest(case: Case, frame: Frame, goal: list[str], names: list[str], error: SceneError) -> Figure:
    """Let the data of the points that nothing asked for decide between the ways."""
    try:
        whole = _constructed(case, frame, names, best_effort=True)
    except SceneError:
        raise error from None
    if not set(goal) <= whole.points.keys():
        raise error
    steps = leading_to(goal, whole.steps)
    return whole._replace(steps=steps, points={p: whole.points[p] for p in points_of(steps)})


def _constructed(case: Case, frame: Frame, goal: list[str], best_effort: bool) -> Figure:
    """Construct, and again by other data where two loci turned out to be one."""
    first: Miss | None = None
    banned: frozenset[frozenset[object]] = frozenset()
    for _ in range(MOST_RETRIES):
        try:
            order = order_of(case, goal, banned, best_effort)
        except SceneError as error:
            if first is not None:
                raise SceneError(first.status, first.message) from error
            raise
        outcome = _assembled(case, frame, order)
        if isinstance(outcome, Figure):
            return outcome
        first = first or outcome
        if outcome.loci is None:
            told = first if outcome.vague else outcome
            raise SceneError(told.status, told.message)
        banned |= {outcome.loci}
    raise SceneError(
        Status.NEAR_SINGULAR, "too many lines and circles of the figure coincide to construct it"
    )


def _assembled(case: Case, frame: Frame, order: Order) -> Figure | Miss:
    """The one way in which an order of construction assembles, or why it does not."""
    board = Board(case, frame, FLOATS)
    walk = Walker(order, board).walk()
    if not walk.ways or walk.gave_up:
        return refusal(walk)
    fits: list[Fit] = []
    misses: list[Miss] = []
    used = order.used()
    for way in walk.ways:
        board.points = way.points
        miss, offs = _compared(board, order, way, used)
        if miss is None:
            fits.append((way, offs))
        else:
            misses.append(miss)
    if not fits:
        return min(misses, key=lambda miss: miss.amount)
    return _figure(board, order, fits, used)


def _compared(
    board: Board, order: Order, way: Way, used: frozenset[Datum]
) -> tuple[Miss | None, dict[Datum, float]]:
    """Compare the points with the data that did not make them."""
    size = size_of(board, order.points)
    data = [d for d in order.facts.data if all(p in way.points for p in d.points)]
    if used.issuperset(data) and agrees(board, data, size):
        return None, {}
    from icsolve.assembly.compare import compare

    return compare(board, way.steps, data, size)


def _figure(board: Board, order: Order, fits: list[Fit], used: frozenset[Datum]) -> Figure:
    """The figure of the way that is meant."""
    way, offs = fits[0]
    if len(fits) > 1:
        from icsolve.assembly.choice import choose

        way = choose(board, [each for each, _ in fits], order.points)
        offs = next(offs for each, offs in fits if each is way)
    board.points = way.points
    notes: tuple[str, ...] = ()
    if offs:
        from icsolve.assembly.compare import notes_of

        given = any(isinstance(step, Given) for step in order.steps)
        notes = notes_of(board, offs, used, given, size_of(board, order.points))
    return Figure(board.frame, {p: way.points[p] for p in order.points}, way.steps, notes, ())
