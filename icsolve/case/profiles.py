"""What a case says of profiles: frozen values."""

from __future__ import annotations

from icsolve.case.joints import Friction
from icsolve.numbers.units import Number
from icsolve.tuples import NamedTuple

Direction = Number | str
"""Degrees ccw from +x in this position, or a point that lies that way."""
Line = Number | tuple[str, str]
"""A direction in degrees in this position, or two points."""


class Polygon(NamedTuple):
    """Corners joined by straight edges, back to the first."""

    corners: tuple[str, ...]


class Arc(NamedTuple):
    """Part of a circle about ``centre`` from one direction to another, ccw unless ``turns`` is ``cw``.

    Without a ``radius``, ``start`` is a point of the arc.
    """

    centre: str
    radius: Number | None
    start: Direction
    stop: Direction
    turns: str = "ccw"


class Arcs(NamedTuple):
    """Arcs one after the other, joined by straight lines where the ends are apart, back to the first."""

    arcs: tuple[Arc, ...]


class Circle(NamedTuple):
    """A whole circle."""

    centre: str
    radius: Number


class Radii(NamedTuple):
    """Radius about a point against the angle from ``zero``: a periodic cubic spline through the table."""

    about: str
    zero: Line
    table: tuple[tuple[Number, Number], ...]
    turns: str = "ccw"


class Flat(NamedTuple):
    """A flat face through ``at``."""

    at: str
    along: Line


class Roller(NamedTuple):
    """A roller about ``at``, which takes part as a point of its link with a radius."""

    at: str
    radius: Number


class Knife(NamedTuple):
    """A sharp edge at ``at``."""

    at: str


Shape = Polygon | Arcs | Circle | Radii
Follower = Flat | Roller | Knife


class Touch(NamedTuple):
    """A contact whose point and normal come from the profiles of its links.

    ``place`` is where it stands among the joints of the case; ``normal`` chooses among those of a corner;
    ``shown`` is false where only doubles brought its follower to the cam, of which no bound can be told.
    """

    links: tuple[str, str]
    place: int
    normal: Number | None = None
    friction: Friction | None = None
    shown: bool = True


class Profiles(NamedTuple):
    """The profiles of a case by link, and the contacts that they have still to place: none where these are
    among the joints."""

    shapes: dict[str, Shape | Follower]
    touches: tuple[Touch, ...]


def points_of(profile: Shape | Follower) -> tuple[str, ...]:
    """The points that a profile names, each once."""
    found: list[str] = []
    stack: list[object] = [profile]
    while stack:
        item = stack.pop()
        if isinstance(item, Number):
            continue
        if isinstance(item, str) and item not in ("ccw", "cw"):
            found.append(item)
        elif isinstance(item, tuple):
            stack.extend(reversed(item))
    return tuple(dict.fromkeys(found))
