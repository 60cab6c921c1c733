"""The steps of a construction. Each puts points on a board, and can tell in words what it does."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Union

from icsolve.figure.board import Board, Key
from icsolve.figure.data import Datum
from icsolve.figure.given import Given, told
from icsolve.figure.heading import Apart, Heading, Span, data_in, ends_of
from icsolve.figure.loci import Crossing, Locus, crossing, headings_of, is_ray

if TYPE_CHECKING:
    from icsolve.figure.group import Group

Step = Union["Given", "Mean", "Polar", "Meet", "Base", "Transfer", "Group"]
"""Each puts points on a board (``place``), and tells its ``targets``, what it ``needs``, its ``data``
and its ``name``, a sentence."""


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
        board.margins.append((*found.margins, *self.ahead(board)))

    def data(self) -> tuple[Datum, ...]:
        """The data of both loci."""
        return (*self.first.data(), *self.second.data())

    def needs(self) -> tuple[Key, ...]:
        """The points of both loci."""
        return (*self.first.needs(), *self.second.needs())


def aims(step: Step) -> list[tuple[Key, Key]]:
    """The pairs of points whose direction a step goes by."""
    if isinstance(step, Transfer):
        return [step.pose, step.shape[:2]]
    headings = [step.heading] if isinstance(step, Polar) else []
    for locus in (step.first, step.second) if isinstance(step, Meet) else ():
        headings += headings_of(locus)
    return [(h.root.a, h.root.b) for h in headings if isinstance(h.root, Apart)]


class Base(NamedTuple):
    """The first two points of a link's own sheet: one at its origin, the other along its x."""

    a: Key
    b: Key
    span: Span

    @property
    def targets(self) -> tuple[Key, ...]:
        """Both points."""
        return (self.a, self.b)

    @property
    def name(self) -> str:
        """What the step does."""
        return told(self)

    def place(self, board: Board) -> None:
        """Put both points."""
        board.points[self.a] = (0.0, 0.0)
        board.points[self.b] = (board.length(self.span), 0.0)

    def data(self) -> tuple[Datum, ...]:
        """The length."""
        return data_in(self.span)

    def needs(self) -> tuple[Key, ...]:
        """What the length comes from."""
        return ends_of(self.span)


class Transfer(NamedTuple):
    """A point of a shape that two other points hold: ``pose`` here, ``shape`` on its own sheet.

    ``shape`` has the sheet's keys of the two points and of the one to place. As complex numbers:
    target = p + (q - p) (s_target - s_p) / (s_q - s_p), of length one.
    """

    target: Key
    pose: tuple[Key, Key]
    shape: tuple[Key, Key, Key]

    @property
    def targets(self) -> tuple[Key, ...]:
        """The point placed."""
        return (self.target,)

    @property
    def name(self) -> str:
        """What the step does."""
        return told(self)

    def place(self, board: Board) -> None:
        """Put the point: the shape turned as p to q is, and not stretched."""
        points, sqrt = board.points, board.arithmetic.sqrt
        (px, py), (qx, qy) = (points[key] for key in self.pose)
        (ax, ay), (bx, by), (tx, ty) = (points[key] for key in self.shape)
        dx, dy, ex, ey = qx - px, qy - py, bx - ax, by - ay
        norm = sqrt(dx * dx + dy * dy) * sqrt(ex * ex + ey * ey)
        c, s = (dx * ex + dy * ey) / norm, (dy * ex - dx * ey) / norm
        tx, ty = tx - ax, ty - ay
        points[self.target] = (px + c * tx - s * ty, py + s * tx + c * ty)

    def data(self) -> tuple[Datum, ...]:
        """None of its own."""
        return ()

    def needs(self) -> tuple[Key, ...]:
        """The pose and the shape."""
        return (*self.pose, *self.shape)
