"""What a case in space says: frozen values beside those of the plane (`icsolve.case`)."""

from __future__ import annotations

from icsolve.case.figure import Centroid
from icsolve.case.loads import Magnitude, Spring, Toward, Weight
from icsolve.numbers.units import Number
from icsolve.tuples import NamedTuple


class SpatialPoint(NamedTuple):
    """A point by its coordinates, case lengths."""

    x: Number
    y: Number
    z: Number


class Along(NamedTuple):
    """A direction along a coordinate axis: ``x``, ``-z``."""

    word: str


class Vector(NamedTuple):
    """A direction by its components; their size does not matter."""

    x: Number
    y: Number
    z: Number


class FromTo(NamedTuple):
    """A direction from one point to another."""

    a: str
    b: str


Axis = Along | Vector | FromTo


class SphericalJoint(NamedTuple):
    """A spherical joint: it carries a force and no couple."""

    links: tuple[str, str]
    at: str


class Radial(NamedTuple):
    """A bearing that carries force square to its axis only."""

    links: tuple[str, str]
    at: str
    axis: Axis


class Thrust(NamedTuple):
    """A bearing that carries force along its axis too."""

    links: tuple[str, str]
    at: str
    axis: Axis


class Hinge(NamedTuple):
    """A hinge: it carries a force, and couples square to its axis."""

    links: tuple[str, str]
    at: str
    axis: Axis


class RigidJoint(NamedTuple):
    """A rigid joint: it carries a force and a couple."""

    links: tuple[str, str]
    at: str


class Teeth(NamedTuple):
    """The form of teeth.

    ``normal_angle`` says that the pressure angle is that of the section square to the teeth, ``normal_pitch``
    the same of the pitch or module; else they are those of the plane of the wheel. ``hand`` is that of
    the gear named first.
    """

    pressure_angle: Number
    normal_angle: bool = False
    helix_angle: Number | None = None
    hand: str = "right"
    diametral_pitch: Number | None = None
    module: Number | None = None
    normal_pitch: bool = False


class GearPair(NamedTuple):
    """A mesh of gears with parallel axes; negative teeth are internal.

    ``centres`` and ``counts`` of teeth are those of both gears; or of the first link's alone, and then
    its mate, which the case does not show, lies ``toward`` and is borne by the second link.
    """

    links: tuple[str, str]
    centres: tuple[str, ...]
    counts: tuple[Number, ...]
    axis: Axis
    teeth: Teeth
    toward: Axis | Toward | None = None


Joint = SphericalJoint | Radial | Thrust | Hinge | RigidJoint | GearPair

Heading = Axis | Toward


class SpatialForce(NamedTuple):
    """A force on ``link`` at ``at``; the opposite goes on ``against`` (None: the frame)."""

    name: str
    link: str
    at: str
    value: Magnitude
    heading: Heading
    against: str | None = None


class SpatialForceVector(NamedTuple):
    """A known force by its components."""

    name: str
    link: str
    at: str
    parts: tuple[Number, Number, Number]
    against: str | None = None


class SpatialTorque(NamedTuple):
    """A torque about an axis, by the right-hand rule."""

    name: str
    link: str
    value: Magnitude
    heading: Axis
    against: str | None = None


class TorqueVector(NamedTuple):
    """A known torque by its components."""

    name: str
    link: str
    parts: tuple[Number, Number, Number]
    against: str | None = None


Load = SpatialForce | SpatialForceVector | SpatialTorque | TorqueVector | Weight | Spring


class Space(NamedTuple):
    """The figure, joints and loads of a case in space; weights pull along ``down``."""

    points: dict[str, SpatialPoint | Centroid]
    joints: tuple[Joint, ...]
    loads: tuple[Load, ...]
    down: Axis = Along("-z")
