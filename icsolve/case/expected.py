"""Published values, and how near an answer must come to the right one."""

from __future__ import annotations

from icsolve.case.figure import is_angle
from icsolve.case.joints import Pair
from icsolve.numbers.units import Number
from icsolve.tuples import NamedTuple


class LoadIs(NamedTuple):
    """Expected: the value of a load."""

    load: str


class CentreIs(NamedTuple):
    """Expected: where a centre lies."""

    pair: Pair


class DistanceIs(NamedTuple):
    """Expected: a distance; each end is a pair of links (a centre) or a point's name."""

    a: Pair | str
    b: Pair | str


class RatioIs(NamedTuple):
    """Expected: the ratio of two links' angular velocities."""

    over: str
    under: str


class RateIs(NamedTuple):
    """Expected: a link's angular velocity."""

    link: str


class SpeedIs(NamedTuple):
    """Expected: the speed of a point on a link."""

    point: str
    link: str


class ReactionIs(NamedTuple):
    """Expected: part of the force of link ``by`` on link ``on``.

    ``part`` is '' (its size), 'x', 'y', 'z', 'moment' (the couple), 'moment x', or a share of it by name:
    'normal', 'thrust', 'tangential'.
    """

    by: str
    on: str
    part: str = ""
    at: str | None = None


class ArmIs(NamedTuple):
    """Expected: the arm of the force of ``by`` on ``on`` about a point."""

    by: str
    on: str
    point: str


class FrictionRadiusIs(NamedTuple):
    """Expected: the radius of the friction circle at a point."""

    point: str


class TensionIs(NamedTuple):
    """Expected: the pull of a rope, by its name; of one that slips, in its first ``part``, or another."""

    rope: str
    part: int = 1


OfBodies = ReactionIs | TensionIs | ArmIs | FrictionRadiusIs
"""What free bodies tell."""


class PositionIs(NamedTuple):
    """Expected: a datum of the figure in a position of equilibrium, by its path: ``angles.AB``."""

    path: str


Target = LoadIs | PositionIs | CentreIs | DistanceIs | RatioIs | RateIs | SpeedIs | OfBodies


def dimension_of(target: Target) -> str:
    """The dimension of what is expected; '' of a load, which has its own."""
    match target:
        case LoadIs():
            return ""
        case RatioIs():
            return "number"
        case RateIs():
            return "angular speed"
        case SpeedIs():
            return "speed"
        case PositionIs(path) if is_angle(path):
            return "angle"
        case ReactionIs(part=part):
            return "torque" if part.partition(" ")[0] in ("moment", "couple") else "force"
        case TensionIs():
            return "force"
    return "length"


class Expected(NamedTuple):
    """A published value.

    ``value`` holds one number, or two for a centre's place; ``toward`` a direction in degrees;
    ``sense`` a published sense in words (``ccw``, ``cw``). ``within`` is an absolute width or,
    with ``relative``, a fraction; None: to the digits given. ``erratum`` says what is wrong
    with the published value. ``holds`` is the range in which a load holds still by friction (None: no end),
    ``stability`` the kind of position that is meant.
    """

    key: str
    target: Target
    value: tuple[Number, ...]
    toward: Number | None = None
    sense: str | None = None
    within: float | None = None
    relative: bool = False
    erratum: str | None = None
    holds: tuple[Number | None, Number | None] | None = None
    stability: str | None = None

    @property
    def sign(self) -> int:
        """-1 of a negative number, which with a sense in words is its size the other way; else 1."""
        return -1 if any(number.value < 0.0 for number in self.value) else 1


class Tolerance(NamedTuple):
    """How far an answer may lie from the right one, where the case is set as a task: the widest of these.

    ``relative`` is a fraction of the value, ``absolute`` a width in ``unit`` ('': the answer's own),
    ``figures`` half a unit of that significant figure, ``drawing`` the accuracy of a drawing, a length.
    """

    relative: float = 0.0
    absolute: float = 0.0
    unit: str = ""
    figures: int = 0
    drawing: str = ""


class Variable(NamedTuple):
    """A number that is another for each student, as written.

    One of ``choices``, or one from ``start`` to ``stop`` in steps of ``step``.
    """

    name: str
    choices: tuple[str, ...] = ()
    start: str = ""
    stop: str = ""
    step: str = ""
