"""The drawing board on which a construction runs: its case, its arithmetic, and the points so far."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from icsolve.arithmetic import Arithmetic, Scalar
from icsolve.case import Case, Coordinates
from icsolve.figure.data import Datum, X, number_of
from icsolve.figure.frame import Frame

Key = str | tuple[int, str]
"""A point of the figure by its name, or of a link's own sheet by the sheet and the name."""
Point = tuple[Scalar, Scalar]


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


class Board:
    """Points in normalised coordinates, and how to measure on them.

    ``margins`` collects, for each step by its place in the construction, what must not be
    negative for it to assemble: gaps of circles, distances along rays (normalised). Groups that
    Newton's method solves start from ``starts`` where it has them, and take ``rounds`` steps.
    """

    __slots__ = ("arithmetic", "case", "frame", "margins", "points", "rounds", "starts")

    def __init__(self, case: Case, frame: Frame, arithmetic: Arithmetic) -> None:
        self.case = case
        self.frame = frame
        self.arithmetic = arithmetic
        self.points: dict[Key, Point] = {}
        self.margins: list[tuple[Scalar, ...]] = []
        self.starts: Mapping[str, Point] = {}
        self.rounds = 1

    def length(self, span: Span) -> Scalar:
        """A length, normalised."""
        if isinstance(span, Datum):
            return self.arithmetic.given(number_of(self.case, span)) * self.frame.scale
        (ax, ay), (bx, by) = self.points[span.a], self.points[span.b]
        dx, dy = bx - ax, by - ay
        return self.arithmetic.sqrt(dx * dx + dy * dy)

    def turn(self, datum: Datum) -> Point:
        """Cosine and sine of an angle of the case."""
        return self.arithmetic.turn(number_of(self.case, datum))

    def unit(self, heading: Heading) -> Point:
        """The unit vector of a direction."""
        root = heading.root
        if isinstance(root, Datum):
            x, y = self.turn(root)
        else:
            (ax, ay), (bx, by) = self.points[root.a], self.points[root.b]
            x, y = bx - ax, by - ay
            d = self.arithmetic.sqrt(x * x + y * y)
            x, y = x / d, y / d
        for datum, sense in heading.turns:
            c, s = self.turn(datum)
            x, y = (c * x - s * y, s * x + c * y) if sense > 0 else (c * x + s * y, c * y - s * x)
        return (-x, -y) if heading.flip else (x, y)

    def coordinates(self, name: str) -> Point:
        """A point that the case gives."""
        place = self.case.points[name]
        assert type(place) is Coordinates
        assert place.x is not None
        assert place.y is not None
        given, (ox, oy, scale) = self.arithmetic.given, self.frame
        return (given(place.x) - ox) * scale, (given(place.y) - oy) * scale

    def coordinate(self, datum: Datum) -> Scalar:
        """The one coordinate that the case gives of a point."""
        value = self.arithmetic.given(number_of(self.case, datum))
        return (value - (self.frame.ox if datum.kind == X else self.frame.oy)) * self.frame.scale
