"""What a case says: frozen values, one representation of a mechanism from the file to the answer.

Every number is in case units (lengths, forces, and torques as force times length unless
``units.torque`` says otherwise; angles in degrees, angular speeds in rad/s, masses in kg,
times in s). Points are named; a position that a load or a centre gives by coordinates has a
hidden name that starts with ``@``.
"""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from icsolve.profile.case import Profiles
    from icsolve.space.case import Space

Mark = tuple[int, int]
"""Line and column of a key or value in its file, both from 1."""


class Number(NamedTuple):
    """A number that the case gives.

    ``value`` is the nearest double in case units, ``half`` half a unit of the last decimal
    that was written (case units), ``path`` its place (``lengths.AB``, ``loads.P.angle``),
    ``digits`` the numeral as written and ``factor`` case units per written unit.
    """

    value: float
    half: float
    path: str
    digits: str
    factor: float = 1.0


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


class Guide(NamedTuple):
    """A guide line: by ``angle`` (degrees, modulo 180) or by two of its points ``ends``.

    ``through`` is a point of the line; None with ``ends`` means the line of the ends, None with
    ``angle`` means the joint's own point.
    """

    angle: Number | None
    ends: tuple[str, str] | None
    through: str | None


class Friction(NamedTuple):
    """Friction of a joint: coefficient; pin radius; length of a block."""

    mu: Number
    radius: Number | None = None
    length: Number | None = None


class Pin(NamedTuple):
    """A revolute of two or more links about the point ``at``."""

    links: tuple[str, ...]
    at: str
    friction: Friction | None = None


class Slide(NamedTuple):
    """A prismatic: block ``links[0]``, carrying ``at``, on a guide of ``links[1]``."""

    links: tuple[str, str]
    at: str
    guide: Guide
    friction: Friction | None = None


class Slot(NamedTuple):
    """A pin of ``links[0]`` at ``at`` in a slot of ``links[1]``."""

    links: tuple[str, str]
    at: str
    guide: Guide
    friction: Friction | None = None


class Roll(NamedTuple):
    """Rolling without slip, in contact at ``at``; ``radii`` as the format says.

    With ``pressure_angle`` it rolls by teeth (a rack and its pinion).
    """

    links: tuple[str, str]
    at: str
    radii: tuple[Number, Number] | None = None
    pressure_angle: Number | None = None


class Helix(NamedTuple):
    """Helical teeth: their angle with the axis; the span of each shaft's bearings, where it is given."""

    angle: Number
    span: Number | None = None


class Gears(NamedTuple):
    """A mesh; negative ``teeth`` are internal. The pivots are pins to one carrier.

    Pressure angle, pitch and module are those in the plane of the wheels.
    """

    links: tuple[str, str]
    teeth: tuple[Number, Number]
    carrier: str | None = None
    pressure_angle: Number | None = None
    diametral_pitch: Number | None = None
    module: Number | None = None
    helix: Helix | None = None


class Belt(NamedTuple):
    """A belt or chain over two pulleys that are pinned to one carrier."""

    links: tuple[str, str]
    radii: tuple[Number, Number]
    crossed: bool = False
    carrier: str | None = None


class Contact(NamedTuple):
    """Contact that rolls and slips; the normal points from ``links[0]`` into ``links[1]``."""

    links: tuple[str, str]
    at: str
    normal: Number
    friction: Friction | None = None


class KnownCentre(NamedTuple):
    """A relative centre that the case gives: at a point, or at infinity toward a direction."""

    links: tuple[str, str]
    at: str | None
    toward: Number | None = None


class Weld(NamedTuple):
    """Two links that move as one; ``at`` serves only its reaction."""

    links: tuple[str, str]
    at: str | None = None


Joint = Pin | Slide | Slot | Roll | Gears | Belt | Contact | KnownCentre | Weld


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


Heading = Number | Toward | Slope
"""Direction of a force: degrees ccw from +x, toward or away from a point, or run and rise."""


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


Pair = tuple[str, str]


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


Target = (
    LoadIs | CentreIs | DistanceIs | RatioIs | RateIs | SpeedIs | ReactionIs | ArmIs | FrictionRadiusIs
)


class Expected(NamedTuple):
    """A published value.

    ``value`` holds one number, or two for a centre's place; ``toward`` a direction in degrees;
    ``sense`` a published sense in words (``ccw``, ``cw``). ``within`` is an absolute width or,
    with ``relative``, a fraction; None: to the digits given. ``erratum`` says what is wrong
    with the published value.
    """

    key: str
    target: Target
    value: tuple[Number, ...]
    toward: Number | None = None
    sense: str | None = None
    within: float | None = None
    relative: bool = False
    erratum: str | None = None


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


@dataclass(frozen=True, eq=False)
class Case:
    """One mechanism in one position, as its file gives it.

    ``links`` are in the order of first mention in the joints, the frame among them; ``carries``
    has for each link the points that its joints, loads and ``links:`` put on it; ``marks`` the
    line and column of every path.
    """

    name: str = "case"
    path: str = "<text>"
    title: str = ""
    source: str = ""
    reconstructed: str = ""
    units: Units = Units()
    ground: str = "1"
    links: tuple[str, ...] = ()
    points: dict[str, Coordinates | Centroid] = field(default_factory=dict)
    lengths: tuple[Length, ...] = ()
    angles: tuple[Direction | Corner, ...] = ()
    near: dict[str, tuple[float, float]] = field(default_factory=dict)
    joints: tuple[Joint, ...] = ()
    loads: tuple[Load, ...] = ()
    motion: tuple[Motion, ...] = ()
    expect: tuple[Expected, ...] = ()
    carries: dict[str, tuple[str, ...]] = field(default_factory=dict)
    gravity: Number = Number(9.81, 0.005, "gravity", "9.81")
    """m/s^2, along -y"""
    tolerance: Tolerance | None = None
    variables: tuple[Variable, ...] = ()
    profiles: "Profiles | None" = None
    """shapes of cams and followers, and the contacts that they place; these are not among the joints"""
    space: "Space | None" = None
    """figure, joints and loads where the points have three coordinates; those of the plane are then empty"""
    marks: dict[str, Mark] = field(default_factory=dict)
