"""The steps that place one point from others: a centroid, a length along a direction, two loci."""

from typing import NamedTuple

from icsolve.assembly.board import Board, Key
from icsolve.assembly.data import Datum
from icsolve.assembly.given import told
from icsolve.assembly.heading import Heading, Span, data_in, ends_of
from icsolve.assembly.loci import Crossing, Locus, crossing, is_ray


class Mean(NamedTuple):
    """A centroid, or the one point that a known centroid leaves open.

    ``target`` = (``whole`` * centroid - the sum of ``others``) / ``parts`` where the centroid is
    known; the mean of ``others`` where it is not.
    """

    target: Key
    datum: Datum
    others: tuple[Key, ...]
    centroid: Key | None = None
    parts: int = 1

    @property
    def targets(self) -> tuple[Key, ...]:
        """The point placed."""
        return (self.target,)

    @property
    def name(self) -> str:
        """What the step does."""
        return told(self)

    def place(self, board: Board) -> None:
        """Put the point."""
        points = board.points
        x, y = 0.0, 0.0
        for key in self.others:
            px, py = points[key]
            x, y = x + px, y + py
        if self.centroid is None:
            n = float(len(self.others))
            board.points[self.target] = (x / n, y / n)
        else:
            n, k = float(len(self.others) + self.parts), float(self.parts)
            gx, gy = points[self.centroid]
            board.points[self.target] = ((n * gx - x) / k, (n * gy - y) / k)

    def data(self) -> tuple[Datum, ...]:
        """The centroid."""
        return (self.datum,)

    def needs(self) -> tuple[Key, ...]:
        """The other points."""
        return self.others if self.centroid is None else (*self.others, self.centroid)


class Polar(NamedTuple):
    """A point at a known distance in a known direction."""

    target: Key
    base: Key
    span: Span
    heading: Heading

    @property
    def targets(self) -> tuple[Key, ...]:
        """The point placed."""
        return (self.target,)

    @property
    def name(self) -> str:
        """What the step does."""
        return told(self)

    def place(self, board: Board) -> None:
        """Put the point."""
        x, y = board.points[self.base]
        length = board.length(self.span)
        c, s = board.unit(self.heading)
        board.points[self.target] = (x + length * c, y + length * s)

    def data(self) -> tuple[Datum, ...]:
        """Length and directions."""
        return (*data_in(self.span), *self.heading.data())

    def needs(self) -> tuple[Key, ...]:
        """What it starts from."""
        return (self.base, *ends_of(self.span), *self.heading.needs())


class Meet(NamedTuple):
    """A point where two loci meet; a line is the first of them if there is one.

    ``sign`` +1 or -1 takes the first or the second of two places; 0 the one place (two lines, or a
    circle that touches).
    """

    target: Key
    first: Locus
    second: Locus
    sign: int = 1

    @property
    def targets(self) -> tuple[Key, ...]:
        """The point placed."""
        return (self.target,)

    @property
    def name(self) -> str:
        """What the step does."""
        return told(self)

    def cross(self, board: Board) -> Crossing:
        """Where the loci meet, both places."""
        return crossing(self.first, self.second, board, self.sign == 0)

    def put(self, board: Board, found: Crossing) -> None:
        """Put the point that ``sign`` takes."""
        x, y = found.middle
        if self.sign != 0 and found.half is not None:
            hx, hy = found.half
            x, y = (x + hx, y + hy) if self.sign > 0 else (x - hx, y - hy)
        board.points[self.target] = (x, y)

    def ahead(self, board: Board) -> list[float]:
        """How far ahead on each ray among the loci the point lies."""
        x, y = board.points[self.target]
        out = []
        for locus in (self.first, self.second):
            if is_ray(locus):
                px, py, vx, vy = locus.values(board)
                out.append((x - px) * vx + (y - py) * vy)
        return out

    def place(self, board: Board) -> None:
        """Put the point, and note the margins."""
        found = self.cross(board)
        self.put(board, found)
        board.margins[self.target] = (*found.margins, *self.ahead(board))

    def data(self) -> tuple[Datum, ...]:
        """The data of both loci."""
        return (*self.first.data(), *self.second.data())

    def needs(self) -> tuple[Key, ...]:
        """The points of both loci."""
        return (*self.first.needs(), *self.second.needs())
