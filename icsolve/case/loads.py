"""The kinds of load, and the motion that a case gives."""

from typing import NamedTuple

from icsolve.case.bodies import Rope
from icsolve.numbers.given import Number


class Like(NamedTuple):
    """A load as large as another one, times a factor."""

    load: str
    times: Number | None = None


Magnitude = Number | Like | None
"""A load's number; None where it is the unknown."""


class Toward(NamedTuple):
    """A heading toward a point (or away from it)."""

    point: str
    away: bool = False


class Slope(NamedTuple):
    """A heading by its run and rise."""

    run: Number
    rise: Number


class AlongRope(NamedTuple):
    """Along the last part of a rope, away from its last pulley."""

    rope: Rope


Heading = Number | Toward | Slope | AlongRope
"""Direction of a force: degrees ccw from +x, toward or away from a point, run and rise, or along a rope."""


class Force(NamedTuple):
    """A force on ``link`` at ``at``; the opposite goes on ``against`` (None: the frame)."""

    name: str
    link: str
    at: str
    value: Magnitude
    heading: Heading
    against: str | None = None
    turns_with: str | None = None
    """In a sweep the heading turns with this link; None: it stays absolute."""


class ForceVector(NamedTuple):
    """A known force by its components."""

    name: str
    link: str
    at: str
    x: Number
    y: Number
    against: str | None = None
    turns_with: str | None = None


class Torque(NamedTuple):
    """A torque, positive ccw unless ``turns`` is ``cw``."""

    name: str
    link: str
    value: Magnitude
    turns: str = "ccw"
    against: str | None = None


class Weight(NamedTuple):
    """A force along -y at ``at``; with ``mass`` the number is a mass in kg."""

    name: str
    link: str
    at: str
    value: Magnitude
    mass: bool = False


class Spring(NamedTuple):
    """A spring from ``at`` on ``link`` to ``to`` on ``against``; ``value`` is its stiffness."""

    name: str
    link: str
    at: str
    to: str
    value: Magnitude
    free: Number
    against: str | None = None


Load = Force | ForceVector | Torque | Weight | Spring


class Motion(NamedTuple):
    """A given motion: of a link (rad/s, or only its sense), or of a point on a link."""

    link: str
    speed: Number | None = None
    turns: str | None = None
    point: str | None = None
    angle: Number | None = None
    acceleration: Number | None = None
    """rad/s^2 of a link, of a point along its path: positive where it gets faster"""
