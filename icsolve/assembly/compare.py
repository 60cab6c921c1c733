"""Data that the construction did not need: compared with the figure, and said so.

A datum may be off by half a unit of the last decimal written, its own and those of the numbers that
it is compared with, and by 0.2 % of the figure's size, whichever is less.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from icsolve.assembly.board import Board
from icsolve.assembly.data import CORNER, GUIDE, LENGTH, LINE, MEAN, RAY, Datum, number_of
from icsolve.assembly.given import Given
from icsolve.assembly.lead import leading_to
from icsolve.assembly.misfit import ROUNDING, misfit
from icsolve.assembly.refusals import Miss, clash, measure
from icsolve.case import Coordinates, Number
from icsolve.numbers.arithmetic import Floats, turn_of

if TYPE_CHECKING:
    from icsolve.assembly.step import Step
from icsolve.assembly.words import datum_words, joined, listed

OF_SIZE = 0.002
MOST_WORK = 50_000
"""Steps that the propagation of half units may run again; beyond, only the size decides."""


class Nudged(Floats):
    """Floats with one number moved by half a unit of its last decimal."""

    def __init__(self, path: str) -> None:
        self.path = path

    def _value(self, number: Number) -> float:
        return number.value + number.half if number.path == self.path else number.value

    def given(self, number: Number) -> float:
        """The number, moved if it is the one."""
        return self._value(number)

    def turn(self, number: Number) -> tuple[float, float]:
        """Cosine and sine, moved if it is the one."""
        return turn_of(self._value(number))


def compare(
    board: Board, steps: tuple[Step, ...], data: list[Datum], size: float
) -> tuple[Miss | None, dict[Datum, float]]:
    """The first datum that the points contradict, and how far off each of the others is."""
    offs: dict[Datum, float] = {}
    for datum in data:
        off, ahead = misfit(board, datum)
        if not ahead:
            return clash(board, datum, off, ahead), offs
        offs[datum] = abs(off)
        if abs(off) <= ROUNDING * size:
            continue
        if abs(off) > OF_SIZE * size or abs(off) > _allowance(board, steps, datum, off, OF_SIZE * size):
            return clash(board, datum, off, ahead), offs
    return None, offs


def _allowance(board: Board, steps: tuple[Step, ...], datum: Datum, off: float, limit: float) -> float:
    """Sum over the numbers involved of what half a unit of each does to the misfit."""
    cone = leading_to(datum.points, steps)
    numbers = _numbers(board, cone, datum)
    if len(numbers) * len(cone) > MOST_WORK:
        return limit
    total = 0.0
    for number in numbers:
        moved = Board(board.case, board.frame, Nudged(number.path))
        try:
            for step in cone:
                step.place(moved)
            total += abs(misfit(moved, datum)[0] - off)
        except ZeroDivisionError:
            return limit
    return total


def _numbers(board: Board, cone: tuple[Step, ...], datum: Datum) -> list[Number]:
    """The distinct numbers that a datum and its points come from."""
    case = board.case
    numbers: dict[str, Number] = {}
    for each in (datum, *(d for step in cone for d in step.data())):
        if each.kind not in (MEAN, LINE):
            number = number_of(case, each)
            numbers[number.path] = number
    for step in cone:
        for key in step.targets if isinstance(step, Given) else ():
            place = case.points[str(key)]
            if isinstance(place, Coordinates):
                numbers.update((n.path, n) for n in (place.x, place.y) if n is not None)
    return list(numbers.values())


def notes_of(
    board: Board, offs: dict[Datum, float], used: frozenset[Datum], given: bool, size: float
) -> tuple[str, ...]:
    """Which data set the points and which were only compared, where there were more than needed."""
    spare = {
        datum: off
        for datum, off in offs.items()
        if datum not in used and (off > ROUNDING * size or datum.kind not in (GUIDE, LINE))
    }
    if not spare:
        return ()
    setters = ["the coordinates"] if given else []
    for kinds, one, many in (((LENGTH,), "length", "lengths"), ((RAY, CORNER), "angle", "angles")):
        names = sorted(joined(*d.points) for d in used if d.kind in kinds)
        if names:
            setters.append(f"{one if len(names) == 1 else many} {', '.join(names)}")
    only = "; ".join(f"{_said(board, datum)} {_off(board, off, size)}" for datum, off in spare.items())
    by = f"set by {listed(setters)}" if setters else "set by the other data"
    return (f"more data than the figure needs: the points are {by}; only compared: {only}",)


def _said(board: Board, datum: Datum) -> str:
    if datum.kind in (MEAN, LINE, GUIDE):
        return datum_words(datum)
    return f"{datum_words(datum)} = {number_of(board.case, datum).value:.6g}"


def _off(board: Board, off: float, size: float) -> str:
    return "(agrees)" if off <= ROUNDING * size else f"(off by {measure(board, off)})"
