"""The drawing board on which a construction runs: its case, its arithmetic, and the points so far."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from icsolve.assembly.data import Datum, X, number_of
from icsolve.assembly.frame import Frame, respelled
from icsolve.case import Case, Coordinates
from icsolve.numbers.arithmetic import Arithmetic, Scalar

if TYPE_CHECKING:
    from icsolve.assembly.heading import Heading, Span

Key = str | tuple[int, str]
"""A point of the figure by its name, or of a link's own sheet by the sheet and the name."""
Point = tuple[Scalar, Scalar]


class Board:
    """Points in normalised coordinates, and how to measure on them.

    ``margins`` collects, for each point where two loci meet, what must not be negative for it to
    assemble: gaps of circles, distances along rays (normalised). Groups that
    Newton's method solves start from ``starts`` where it has them, and take ``rounds`` steps.
    """

    __slots__ = ("arithmetic", "case", "frame", "margins", "points", "rounds", "starts")

    def __init__(self, case: Case, frame: Frame, arithmetic: Arithmetic) -> None:
        self.case = case
        self.frame = frame
        self.arithmetic = arithmetic
        self.points: dict[Key, Point] = {}
        self.margins: dict[Key, tuple[Scalar, ...]] = {}
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
        place = self.case.points[respelled(self.case).get(name, name)]
        assert type(place) is Coordinates
        assert place.x is not None
        assert place.y is not None
        given, (ox, oy, scale) = self.arithmetic.given, self.frame
        return (given(place.x) - ox) * scale, (given(place.y) - oy) * scale

    def coordinate(self, datum: Datum) -> Scalar:
        """The one coordinate that the case gives of a point."""
        value = self.arithmetic.given(number_of(self.case, datum))
        return (value - (self.frame.ox if datum.kind == X else self.frame.oy)) * self.frame.scale
