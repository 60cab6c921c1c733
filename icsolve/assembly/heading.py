"""Where a construction takes its directions and its lengths from."""

from __future__ import annotations

from typing import NamedTuple

from icsolve.assembly.board import Key
from icsolve.assembly.data import Datum


class Apart(NamedTuple):
    """The distance (or the direction) from one constructed point to another."""

    a: Key
    b: Key


class Heading(NamedTuple):
    """A direction: that of a datum or between two points, turned by corners, reversed if ``flip``."""

    root: Datum | Apart
    flip: bool = False
    turns: tuple[tuple[Datum, int], ...] = ()

    def reverse(self) -> Heading:
        """The opposite direction."""
        if isinstance(self.root, Apart):
            return Heading(Apart(self.root.b, self.root.a), self.flip, self.turns)
        return Heading(self.root, not self.flip, self.turns)

    def turned(self, corner: Datum, sense: int) -> Heading:
        """Turned by a corner, ccw with sense +1."""
        return Heading(self.root, self.flip, (*self.turns, (corner, sense)))

    def data(self) -> tuple[Datum, ...]:
        """The data that it comes from."""
        root = data_in(self.root)
        return (*root, *(datum for datum, _ in self.turns))

    def needs(self) -> tuple[Key, ...]:
        """The points that it comes from."""
        return () if isinstance(self.root, Datum) else (self.root.a, self.root.b)


Span = Datum | Apart
"""Where a length comes from: a length of the case, or two points that are in place."""


def data_in(span: Span) -> tuple[Datum, ...]:
    """The data that a length is."""
    return (span,) if isinstance(span, Datum) else ()


def ends_of(span: Span) -> tuple[Key, ...]:
    """The points that a length is taken from."""
    return () if isinstance(span, Datum) else (span.a, span.b)
