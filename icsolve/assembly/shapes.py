"""Shapes that move as a whole: how one begins on a sheet of its own, and how it carries its points.

A shape is carried by two of its points that are in place, or by one and a known direction in it.
"""

from typing import NamedTuple

from icsolve.assembly.board import Board, Key
from icsolve.assembly.data import Datum
from icsolve.assembly.given import told
from icsolve.assembly.heading import Heading, Span, data_in, ends_of


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


class Turned(NamedTuple):
    """A point of a shape that one point in place and a known direction in it hold.

    ``heading`` is the direction of the shape's pair ``shape[:2]``; ``shape[2:]`` are the point in place
    and the one to place, on the shape's own sheet.
    """

    target: Key
    base: Key
    heading: Heading
    shape: tuple[Key, Key, Key, Key]

    @property
    def targets(self) -> tuple[Key, ...]:
        """The point placed."""
        return (self.target,)

    @property
    def name(self) -> str:
        """What the step does."""
        return told(self)

    def place(self, board: Board) -> None:
        """Put the point: the shape turned until its pair lies in the known direction."""
        (px, py), (ux, uy) = board.points[self.base], board.unit(self.heading)
        (ax, ay), (bx, by), (qx, qy), (tx, ty) = (board.points[key] for key in self.shape)
        ex, ey, dx, dy = bx - ax, by - ay, tx - qx, ty - qy
        norm = board.arithmetic.sqrt(ex * ex + ey * ey)
        c, s = (ux * ex + uy * ey) / norm, (uy * ex - ux * ey) / norm
        board.points[self.target] = (px + c * dx - s * dy, py + s * dx + c * dy)

    def data(self) -> tuple[Datum, ...]:
        """The direction."""
        return self.heading.data()

    def needs(self) -> tuple[Key, ...]:
        """What it starts from, and the shape."""
        return (self.base, *self.heading.needs(), *self.shape)
