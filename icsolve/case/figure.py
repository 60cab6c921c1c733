"""What places a figure: numbers with their decimals, units, points, lengths, angles, guide lines."""

from __future__ import annotations

from icsolve.numbers.units import ExactRatio, Number
from icsolve.tuples import NamedTuple

Mark = tuple[int, int]
"""Line and column of a key or value in its file, both from 1."""


class Units(NamedTuple):
    """Unit names in which bare numbers stand and answers are given."""

    length: str = "m"
    force: str = "N"
    torque: str = "N*m"
    torque_per_force_length: float = 1.0
    """How many ``torque`` units make one ``force * length``."""
    force_per_newton: float = 1.0
    """How many ``force`` units make one newton: a mass in kg times gravity in m/s^2, in ``force``."""
    length_per_metre: float = 1.0
    exact_torque: ExactRatio = (1, 1, 0)
    """``torque_per_force_length``, exactly"""
    exact_newton: ExactRatio = (1, 1, 0)
    """``force_per_newton``, exactly"""

    @property
    def pressure(self) -> str:
        """The unit in which a pressure is answered."""
        if self.force == "N" and self.length in ("m", "mm", "cm"):
            return "MPa"
        if self.force == "lbf" and self.length in ("in", "ft"):
            return "psi"
        return f"{self.force}/{self.length}^2"


class Coordinates(NamedTuple):
    """A point by its coordinates; None stands for ``unknown``."""

    x: Number | None
    y: Number | None


class Centroid(NamedTuple):
    """A point as the mean of others."""

    of: tuple[str, ...]


class Length(NamedTuple):
    """Distance between two points."""

    a: str
    b: str
    value: Number


class Direction(NamedTuple):
    """Direction from a to b, degrees ccw from +x."""

    a: str
    b: str
    value: Number


class Corner(NamedTuple):
    """Angle at ``at`` from the arm to ``a`` to the arm to ``b``, degrees ccw."""

    a: str
    at: str
    b: str
    value: Number


HIDDEN = "@"
"""Begins what stands for a name in a case where its file has none: no name in a file begins so."""


def is_named(point: str) -> bool:
    """Whether a point has a name in the case, rather than being told where a joint or load stands."""
    return not point.startswith(HIDDEN)


def bare_name(name: str) -> str:
    """What a place or body without a name of its own is called by: that of its joint, load or screw."""
    return name.lstrip(HIDDEN)


def is_link(name: str) -> bool:
    """Whether a link of the case, rather than what stands for one: the end of a rope that loads pull, a screw
    that they turn."""
    return not name.startswith(HIDDEN)


def is_angle(path: str) -> bool:
    """Whether a datum of the figure is an angle, by its path: it is the same again after a whole turn."""
    return path.startswith("angles.")


class Unknown(NamedTuple):
    """A datum of the figure that is to find: in which of its positions the mechanism rests.

    ``path`` is its place, ``angles.AB``, ``lengths.CD`` or ``points.B.x``; ``low`` and ``high`` are the ends
    of the range to search, both None for all that it can be; ``start`` is where the figure is written. An
    angle or length stands in the case with a number of ``digits`` "unknown" and the value of ``start``, else
    of the middle of the range, else nan; a coordinate stands there as None.
    """

    path: str
    low: Number | None = None
    high: Number | None = None
    start: Number | None = None
    mark: Mark = (1, 1)


class Guide(NamedTuple):
    """A guide line: by ``angle`` (degrees, modulo 180) or by two of its points ``ends``.

    ``through`` is a point of the line; None with ``ends`` means the line of the ends, None with
    ``angle`` means the joint's own point.
    """

    angle: Number | None
    ends: tuple[str, str] | None
    through: str | None
