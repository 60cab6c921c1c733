"""Which of several ways of assembling is meant: the one nearest to `near`, or none."""

from __future__ import annotations

import math

from icsolve.assembly.board import Board, Point
from icsolve.assembly.frame import case_point, normalised
from icsolve.assembly.steps import Meet
from icsolve.assembly.ways import Way, nearer
from icsolve.assembly.words import plain
from icsolve.errors import SceneError, Status

SAME = 1e-11
"""Points nearer than this (normalised, over 1 + their distance from the origin) are one point."""
MOST_LISTED = 4


def choose(board: Board, ways: list[Way], points: tuple[str, ...]) -> Way:
    """The way that is meant.

    Raises
    ------
    SceneError
        ``ambiguous``: several are left, listed point by point.
    """
    ways = _distinct(ways, points)
    best = ways[0]
    for way in ways[1:]:
        if _nearer(board, way, best, points):
            best = way
    rivals = [way for way in ways if way is best or not _nearer(board, best, way, points)]
    if len(rivals) > 1:
        raise SceneError(Status.AMBIGUOUS, _listing(board, rivals, points))
    return best


def _distinct(ways: list[Way], points: tuple[str, ...]) -> list[Way]:
    out: list[Way] = []
    for way in ways:
        if not any(not _differing(way, other, points) for other in out):
            out.append(way)
    return out


def _differing(one: Way, two: Way, points: tuple[str, ...]) -> list[str]:
    """The points that are not in the same place in both."""
    out = []
    for p in points:
        (ax, ay), (bx, by) = one.points[p], two.points[p]
        if math.hypot(ax - bx, ay - by) > SAME * (1.0 + math.hypot(ax, ay)):
            out.append(p)
    return out


def _nearer(board: Board, one: Way, two: Way, points: tuple[str, ...]) -> bool:
    """Whether the one way is clearly nearer to `near` where the two differ."""
    held = [p for p in _differing(one, two, points) if p in board.case.near]
    near: list[Point] = [normalised(board.frame, board.case.near[p]) for p in held]
    return nearer([one.points[p] for p in held], [two.points[p] for p in held], near)


def _listing(board: Board, rivals: list[Way], points: tuple[str, ...]) -> str:
    """The ways point by point: first the points that have a choice of their own."""
    differing = [p for p in points if any(_differing(rivals[0], way, (p,)) for way in rivals[1:])]
    forks = [
        step.target
        for step in rivals[0].steps
        if isinstance(step, Meet) and step.sign and step.target in differing
    ] or differing
    lines = [f"{plain(p)}: {_places(board, rivals, str(p))}" for p in forks]
    hint = _hint(board, rivals, str(next((p for p in forks if p not in board.case.near), forks[0])))
    return f"the figure assembles in several ways, {'; '.join(lines)}; {hint}"


def _places(board: Board, rivals: list[Way], point: str) -> str:
    seen: list[tuple[float, float]] = []
    for way in rivals:
        at = way.points[point]
        if all(math.dist(at, other) > SAME * (1.0 + math.hypot(*at)) for other in seen):
            seen.append(at)
    places = [_pair(case_point(board.frame, at)) for at in seen[:MOST_LISTED]]
    more = f" or {len(seen) - MOST_LISTED} more" if len(seen) > MOST_LISTED else ""
    return " or ".join(f"({place})" for place in places) + more


def _hint(board: Board, rivals: list[Way], point: str) -> str:
    example = _pair(case_point(board.frame, rivals[0].points[point]))
    if point in board.case.near:
        return (
            f"near: for {plain(point)} is about as far from the one as from the other; "
            "move it nearer to the one that is meant"
        )
    return f"add near: {{{plain(point)}: [{example}]}} for the one that is meant"


def _pair(at: tuple[float, float]) -> str:
    return f"{at[0]:.6g}, {at[1]:.6g}"
