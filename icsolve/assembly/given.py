"""The first step of most constructions: points whose coordinates the case gives."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from icsolve.assembly.board import Board, Key
from icsolve.assembly.data import Datum

if TYPE_CHECKING:
    from icsolve.assembly.step import Step


def told(step: Step) -> str:
    """A step as a sentence."""
    from icsolve.assembly.words import step_words

    return step_words(step)


class Given(NamedTuple):
    """Points whose coordinates the case gives."""

    targets: tuple[Key, ...]

    @property
    def name(self) -> str:
        """What the step does."""
        return told(self)

    def place(self, board: Board) -> None:
        """Put the points."""
        for key in self.targets:
            board.points[key] = board.coordinates(key if isinstance(key, str) else key[1])

    def data(self) -> tuple[Datum, ...]:
        """None but the coordinates."""
        return ()

    def needs(self) -> tuple[Key, ...]:
        """Nothing."""
        return ()
