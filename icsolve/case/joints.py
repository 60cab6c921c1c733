"""The kinds of joint, as a case gives them."""

from typing import NamedTuple

from icsolve.case.figure import Guide
from icsolve.numbers.given import Number


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


class Thread(NamedTuple):
    """Of a screw that a torque turns, out of the plane: by ``lead`` a turn, right-handed; square, of mean
    ``radius``, with ``mu`` where it rubs."""

    lead: Number
    radius: Number | None = None
    mu: Number | None = None


class Slide(NamedTuple):
    """A prismatic: block ``links[0]``, carrying ``at``, on a guide of ``links[1]``; of a screw it has the
    ``thread``, on which ``links[1]`` moves."""

    links: tuple[str, str]
    at: str
    guide: Guide
    friction: Friction | None = None
    thread: Thread | None = None


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
    """Helical teeth: their angle with the axis; the span of each shaft's bearings, where it is given.

    With ``normal`` the mesh has its pressure angle square to the teeth, not in the plane of the wheels.
    """

    angle: Number
    span: Number | None = None
    normal: bool = False


class Gears(NamedTuple):
    """A mesh; negative ``teeth`` are internal. The pivots are pins to one carrier.

    Pitch and module are those in the plane of the wheels; the pressure angle too, but for that of a helix.
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
