"""The kinds of load, and the motion that a case gives; what is more than joints between links: their masses,
the ropes that run over them, driven screws."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from icsolve.case.figure import is_link
from icsolve.case.joints import Guided, Thread
from icsolve.numbers.units import ExactRatio, Number
from icsolve.tuples import NamedTuple, TypeVar

T = TypeVar("T")


class Inertia(NamedTuple):
    """The mass of a link [kg], its centre of mass, and its moment of inertia about it [kg*m^2].

    Without a ``moment`` the mass counts as one point; without a ``mass`` the link is balanced about an axis
    that stands still.
    """

    mass: Number | None
    centre: str | None
    moment: Number | None = None


class Screw(NamedTuple):
    """A screw that a torque turns, by the slide that it is among the joints."""

    slide: Guided
    thread: Thread

    @property
    def links(self) -> tuple[str, str]:
        """The second moves on the first."""
        on, by = self.slide.links
        return by, on

    @property
    def rotor(self) -> str:
        """What stands for a link where a torque turns it: no link of the case has such a name."""
        return f"@screw {'-'.join(self.links)}"

    @property
    def rubs(self) -> bool:
        """Whether its thread does."""
        return self.thread.mu is not None and self.thread.mu.value > 0.0


class Rope(NamedTuple):
    """A rope through ``points``, in order, each on the link of ``links`` at the same place; ``name`` is
    ``A-P-B``, with ``#2`` where another runs through the same points.

    The first and the last are its ends, the others pulleys; where ``links`` has one less than ``points``,
    the last end is free and loads pull it. For each place ``radii`` has a pulley's (or drum's) radius,
    ``wraps`` the sense (``cw``, ``ccw``) in which one goes round it from the first end to the last, and
    ``mu`` the friction of a rope that slips there; None where there is none. ``turns`` has the whole turns
    about a place beside what the figure shows.
    """

    name: str
    points: tuple[str, ...]
    links: tuple[str, ...]
    radii: tuple[Number | None, ...]
    wraps: tuple[str | None, ...]
    mu: tuple[Number | None, ...]
    length: Number | None = None
    turns: tuple[Number | None, ...] = ()

    @property
    def slips(self) -> bool:
        """Whether it rubs on anything that it goes round."""
        return any(mu is not None and mu.value > 0.0 for mu in self.mu)

    def whole_turns(self, place: int) -> float:
        """How often it goes all round the pulley at a place, beside the angle that the figure shows."""
        turns = self.turns[place] if self.turns else None
        return 0.0 if turns is None else turns.value

    @property
    def end(self) -> str:
        """What stands for a link where loads pull the last end: no link of the case has such a name."""
        return f"@{self.name}"

    @property
    def is_free(self) -> bool:
        """Whether its last end is one that loads pull."""
        return len(self.links) < len(self.points)

    def tied_to(self, stands: Sequence[T], at: T) -> tuple[T, int] | None:
        """What straight parts alone lead from to one of what ``stands`` at its places, and how many do; None
        where they come from several, or go round something."""
        own = [k for k, pair in enumerate(pairwise(stands)) if at in pair]
        others = {end for k in own for end in stands[k : k + 2]} - {at}
        if len(others) != 1 or any(self.radii[n] is not None for k in own for n in (k, k + 1)):
            return None
        return next(iter(others)), len(own)


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


class Area(NamedTuple):
    """The area on which a pressure acts: as given, or a circle's of ``bore`` less that of ``rod``.

    ``per`` is, exactly, the force in case units that a unit of pressure makes on a unit of case length
    squared, for a bore times pi/4.
    """

    per: ExactRatio
    area: Number | None = None
    bore: Number | None = None
    rod: Number | None = None


class Stretch(NamedTuple):
    """The line from ``a`` to ``b`` along which a force per length acts.

    Uniform, or linear from the force's own number at ``a`` to ``end`` at ``b``.
    """

    a: str
    b: str
    end: Number | None = None


class Force(NamedTuple):
    """A force on ``link`` at ``at``; the opposite goes on ``against`` (None: the frame).

    With an ``over`` its number is a pressure on that area, or a force per length of that stretch; ``at`` is
    then the middle of the stretch, a hidden point.
    """

    name: str
    link: str
    at: str
    value: Magnitude
    heading: Heading
    against: str | None = None
    turns_with: str | None = None
    """In a sweep the heading turns with this link; None: it stays absolute."""
    over: Area | Stretch | None = None


class ForceVector(NamedTuple):
    """A known force by its components."""

    name: str
    link: str
    at: str
    x: Number
    y: Number
    against: str | None = None
    turns_with: str | None = None

    @property
    def parts(self) -> tuple[Number, Number]:
        """Its components."""
        return self.x, self.y


class Torque(NamedTuple):
    """A torque, positive ccw unless ``turns`` is ``cw``."""

    name: str
    link: str
    value: Magnitude
    turns: str = "ccw"
    against: str | None = None

    @property
    def positive(self) -> str:
        """The sense that counts as positive; of one that turns a screw, as one looks along its axis."""
        return self.turns if is_link(self.link) else "cw"


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


class TorsionSpring(NamedTuple):
    """A torsion spring between ``link`` and ``against`` (None: the frame); ``value`` is its stiffness.

    It pushes ``link`` with stiffness times (``free`` - angle), ccw positive. The angle is that of ``corner``:
    of three points, at the middle one from the arm to the first to the arm to the last; of two points the
    direction from the first to the second. Of its turns those nearest to ``about`` count [degrees]; as
    written (None) those by which ``free`` - angle lies in (-180, 180].
    """

    name: str
    link: str
    corner: tuple[str, ...]
    value: Magnitude
    free: Number
    against: str | None = None
    about: float | None = None

    @property
    def at(self) -> str:
        """The point about which it turns."""
        return self.corner[-2]


Load = Force | ForceVector | Torque | Weight | Spring | TorsionSpring


def aim_of(load: object) -> str:
    """The point that a load is toward or away from, or to which a spring goes, in the plane or in space, at
    which its opposite acts too; '' of others."""
    return str(getattr(load, "to", None) or getattr(getattr(load, "heading", None), "point", None) or "")


def name_of_inertia(name: str) -> bool:
    """Whether a load stands for the inertia of a link: one of the file has no blank in its name."""
    return name.startswith("inertia ")


class Motion(NamedTuple):
    """A given motion: of a link (rad/s, or only its sense), or of a point on a link."""

    link: str
    speed: Number | None = None
    turns: str | None = None
    point: str | None = None
    angle: Number | None = None
    acceleration: Number | None = None
    """rad/s^2 of a link, of a point along its path: positive where it gets faster"""
