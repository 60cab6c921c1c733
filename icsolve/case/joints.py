"""The kinds of joint, as a case gives them; each class answers what the theory asks of a joint.

What a joint leaves free is told by the centres about which its second link can move against its first:
`screws.joints` makes basis twists of them, and twists, transmitted wrenches, loops, rates and accelerations,
free bodies and error bounds follow. Families share answers: `Sliding` surfaces, `Guided` ones among them;
`Rolling` links; a `Mesh` of wheels on a common carrier. How a kind is read, said and drawn stands in three
tables: `read.joints`, `wording.joints` and `draw.frame`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from icsolve.case.figure import Guide
from icsolve.numbers.units import Number
from icsolve.tuples import NamedTuple, cached_property

if TYPE_CHECKING:
    from collections.abc import Container
    from typing import Self

Pair = tuple[str, str]
"""Two links."""


class Friction(NamedTuple):
    """Friction of a joint: coefficient; pin radius; length of a block."""

    mu: Number
    radius: Number | None = None
    length: Number | None = None


class CentreAt(NamedTuple):
    """A centre at a named point, which ``link`` carries; '' where it is known in one position only."""

    point: str
    link: str = ""


class CentreSquareTo(NamedTuple):
    """A centre at infinity, square to a guide of ``link``."""

    guide: Guide
    link: str


class CentreToward(NamedTuple):
    """A centre at infinity in a direction, known in one position only."""

    direction: Number
    link: str = ""


JointCentre = CentreAt | CentreSquareTo | CentreToward


class JointKind:
    """What a kind of joint answers where it says nothing else."""

    @property
    def links(self) -> tuple[str, ...]:
        """The links that it joins, in its own order."""
        raise NotImplementedError

    @property
    def kind(self) -> str:
        """The kind in the words of the format."""
        return type(self).__name__.lower()

    @property
    def at(self) -> str | None:
        """The point at which it is, where it has one."""
        return None

    @property
    def guide(self) -> Guide | None:
        """The line along which its point runs."""
        return None

    @property
    def friction(self) -> Friction | None:
        """How it rubs."""
        return None

    @property
    def pressure_angle(self) -> Number | None:
        """That of its teeth."""
        return None

    @property
    def helix(self) -> Helix | None:
        """The slant of its teeth."""
        return None

    @property
    def direction(self) -> Number | None:
        """The angle that directs it, degrees."""
        return None

    @property
    def curvature(self) -> tuple[Radius, Radius] | None:
        """The radii of curvature of links that slip on one another, where profiles tell."""
        return None

    @cached_property
    def centres(self) -> tuple[JointCentre, ...]:
        """The centres that span its freedoms: one, or two on whose line its centre lies; none of a weld."""
        raise NotImplementedError

    @property
    def freedom(self) -> int:
        """Relative freedoms that it leaves to its links."""
        return len(self.centres)

    @cached_property
    def pivot(self) -> str | None:
        """The point about which its links turn and which is a point of each, as of a pin."""
        match self.centres:
            case (CentreAt(point, link),) if link:
                return point
        return None

    @property
    def keeps_direction(self) -> bool:
        """Whether its links cannot turn against each other."""
        return not any(isinstance(centre, CentreAt) for centre in self.centres)

    @property
    def has_normal(self) -> bool:
        """Whether its centre lies anywhere on a line through ``at``: the normal of what touches."""
        return len(self.centres) > 1

    @property
    def stays_known(self) -> bool:
        """Whether its centres go with its links, so that it is known in all positions."""
        return all(centre.link for centre in self.centres)

    @property
    def has_written_centre(self) -> bool:
        """Whether its one centre is a place of the file, which others may miss by its last digits."""
        return self.freedom == 1 and not self.stays_known

    @property
    def stands_in(self) -> bool:
        """Whether it stands for joints that the case does not show."""
        return False

    @property
    def only_pushes(self) -> bool:
        """Whether its links part where they would have to pull."""
        return False

    @property
    def pulls(self) -> bool:
        """Whether its strands pull, which slacken where they would have to push."""
        return False

    def among(self, links: Container[str]) -> Self | None:
        """What is left of it where these links alone are: nothing without one of two."""
        return self if all(link in links for link in self.links) else None

    @property
    def carried(self) -> tuple[tuple[str, str], ...]:
        """Its points, each after the link whose point it is."""
        return ()

    @property
    def points(self) -> tuple[str, ...]:
        """The points that place it."""
        ends = () if self.guide is None else self.guide.ends or ()
        return (self.at, *ends) if self.at is not None else ends

    @property
    def named(self) -> tuple[str, ...]:
        """All points that it names."""
        through = self.guide.through if self.guide is not None else None
        return (*self.points, *((through,) if through is not None else ()))


class Sliding(JointKind):
    """Surfaces that slide on each other at the point ``at``, and press square to that."""

    at: str


class Guided(Sliding):
    """A point of ``links[0]`` that runs along a guide of ``links[1]``."""

    guide: Guide

    @property
    def thread(self) -> Thread | None:
        """Of a screw, whose nut is ``links[1]``."""
        return None

    @property
    def direction(self) -> Number | None:
        """The angle of the guide."""
        return self.guide.angle

    @property
    def carried(self) -> tuple[tuple[str, str], ...]:
        """The point that runs, and the points of the guide."""
        on = (*(self.guide.ends or ()), *((self.guide.through,) if self.guide.through else ()))
        return ((self.links[0], self.at), *((self.links[1], point) for point in on))


class Rolling(JointKind):
    """Links that roll on each other without slip at the point ``at``."""

    at: str
    radii: tuple[Number, Number] | None


class Mesh(JointKind):
    """Two wheels that are pinned to one carrier; their pitch point divides the line of the pivots."""

    carrier: str | None

    @cached_property
    def centres(self) -> tuple[JointCentre, ...]:
        """Told by the pivots, which a bond knows: the pitch point, and square to the line of the pivots."""
        return ()

    @property
    def freedom(self) -> int:
        """A mesh is one constraint."""
        return 2

    @property
    def keeps_direction(self) -> bool:
        """Wheels turn."""
        return False

    @property
    def sizes(self) -> tuple[Number, Number]:
        """Numbers of teeth, or radii."""
        raise NotImplementedError

    def resized(self, sizes: tuple[Number, Number]) -> Gears | Belt:
        """The same with other numbers of teeth, or radii."""
        raise NotImplementedError

    def turned_round(self) -> Gears | Belt:
        """The same with the second wheel turning the other way."""
        raise NotImplementedError

    @property
    def turns_alike(self) -> bool:
        """Whether both wheels turn the same way, seen from the carrier: the pitch point lies outside."""
        raise NotImplementedError

    @property
    def module(self) -> Number | None:
        """Pitch diameter for each tooth."""
        return None

    @property
    def diametral_pitch(self) -> Number | None:
        """Teeth for each unit of the pitch diameter."""
        return None


class _Pin(NamedTuple):
    links: tuple[str, ...]
    at: str
    friction: Friction | None = None


class Pin(_Pin, JointKind):
    """A revolute of two or more links about the point ``at``."""

    @cached_property
    def centres(self) -> tuple[JointCentre, ...]:
        """Its point."""
        return (CentreAt(self.at, self.links[0]),)

    @property
    def carried(self) -> tuple[tuple[str, str], ...]:
        """Its point, of every link."""
        return tuple((link, self.at) for link in self.links)

    def among(self, links: Container[str]) -> Pin | None:
        """A pin of those of its links that are there, if these are two at least."""
        own = tuple(link for link in self.links if link in links)
        return self._replace(links=own) if len(own) > 1 else None


class Thread(NamedTuple):
    """Of a screw that a torque turns, out of the plane: by ``lead`` a turn, right-handed; square, of mean
    ``radius``, with ``mu`` where it rubs."""

    lead: Number
    radius: Number | None = None
    mu: Number | None = None


class _Slide(NamedTuple):
    links: tuple[str, str]
    at: str
    guide: Guide
    friction: Friction | None = None
    thread: Thread | None = None


class Slide(_Slide, Guided):
    """A prismatic: block ``links[0]``, carrying ``at``, on a guide of ``links[1]``; of a screw it has the
    ``thread``, on which ``links[1]`` moves."""

    @cached_property
    def centres(self) -> tuple[JointCentre, ...]:
        """At infinity."""
        return (CentreSquareTo(self.guide, self.links[1]),)


class _Slot(NamedTuple):
    links: tuple[str, str]
    at: str
    guide: Guide
    friction: Friction | None = None


class Slot(_Slot, Guided):
    """A pin of ``links[0]`` at ``at`` in a slot of ``links[1]``."""

    @cached_property
    def centres(self) -> tuple[JointCentre, ...]:
        """The pin, and square to the slot."""
        return CentreAt(self.at, self.links[0]), CentreSquareTo(self.guide, self.links[1])


class RadiusOfRow(NamedTuple):
    """The radius of curvature of a profile where each row of a sweep touches it: ``above / below``, of which
    ``below`` is 0 where it is straight."""

    above: Number
    below: Number


Radius = Number | RadiusOfRow | None
"""A radius of curvature (None: straight)."""


class _Contact(NamedTuple):
    links: tuple[str, str]
    at: str
    normal: Number
    friction: Friction | None = None
    radii: tuple[Radius, Radius] | None = None


class Contact(_Contact, Sliding):
    """Contact that rolls and slips; the normal points from ``links[0]`` into ``links[1]``.

    Where profiles place it ``radii`` are those of curvature of the two links (negative: hollow; None:
    straight).
    """

    @cached_property
    def centres(self) -> tuple[JointCentre, ...]:
        """On the common normal; how it moves hangs on profiles that the joint does not know."""
        return CentreAt(self.at), CentreToward(self.normal)

    @property
    def curvature(self) -> tuple[Radius, Radius] | None:
        """Where profiles place it."""
        return self.radii

    @property
    def direction(self) -> Number:
        """That of the normal."""
        return self.normal

    @property
    def only_pushes(self) -> bool:
        """Nothing holds the surfaces together."""
        return True


class _Roll(NamedTuple):
    links: tuple[str, str]
    at: str
    radii: tuple[Number, Number] | None = None
    pressure_angle: Number | None = None


class Roll(_Roll, Rolling):
    """Rolling without slip, in contact at ``at``; ``radii`` as the format says.

    With ``pressure_angle`` it rolls by teeth (a rack and its pinion).
    """

    @cached_property
    def centres(self) -> tuple[JointCentre, ...]:
        """Where they touch, which is a point of neither link."""
        return (CentreAt(self.at),)


class Helix(NamedTuple):
    """Helical teeth: their angle with the axis; the span of each shaft's bearings, where it is given.

    With ``normal`` the mesh has its pressure angle square to the teeth, not in the plane of the wheels; with
    ``normal_pitch`` its pitch or module.
    """

    angle: Number
    span: Number | None = None
    normal: bool = False
    normal_pitch: bool = False


class _Gears(NamedTuple):
    links: tuple[str, str]
    teeth: tuple[Number, Number]
    carrier: str | None = None
    pressure_angle: Number | None = None
    diametral_pitch: Number | None = None
    module: Number | None = None
    helix: Helix | None = None


class Gears(_Gears, Mesh):
    """A mesh; negative ``teeth`` are internal. The pivots are pins to one carrier.

    Pitch, module and pressure angle are those in the plane of the wheels, or as the helix says.
    """

    @property
    def sizes(self) -> tuple[Number, Number]:
        """Numbers of teeth."""
        return self.teeth

    def resized(self, sizes: tuple[Number, Number]) -> Gears:
        """With other numbers of teeth."""
        return self._replace(teeth=sizes)

    def turned_round(self) -> Gears:
        """With a wheel internal that was external, or external that was internal."""
        first, second = self.teeth
        sign = "" if second.digits.startswith("-") else "-"
        return self._replace(
            teeth=(first, second._replace(value=-second.value, digits=sign + second.digits.lstrip("-")))
        )

    @property
    def turns_alike(self) -> bool:
        """With one internal wheel."""
        return (self.teeth[0].value < 0) != (self.teeth[1].value < 0)


class _Belt(NamedTuple):
    links: tuple[str, str]
    radii: tuple[Number, Number]
    crossed: bool = False
    carrier: str | None = None


class Belt(_Belt, Mesh):
    """A belt or chain over two pulleys that are pinned to one carrier."""

    @property
    def sizes(self) -> tuple[Number, Number]:
        """Radii."""
        return self.radii

    def resized(self, sizes: tuple[Number, Number]) -> Belt:
        """With other radii."""
        return self._replace(radii=sizes)

    def turned_round(self) -> Belt:
        """Crossed where it was open, open where it was crossed."""
        return self._replace(crossed=not self.crossed)

    @property
    def turns_alike(self) -> bool:
        """Where it is open."""
        return not self.crossed

    @property
    def pulls(self) -> bool:
        """By its two strands."""
        return True


class _KnownCentre(NamedTuple):
    links: tuple[str, str]
    at: str | None
    toward: Number | None = None


class KnownCentre(_KnownCentre, JointKind):
    """A relative centre that the case gives: at a point, or at infinity toward a direction."""

    @property
    def kind(self) -> str:
        """As the format has it."""
        return "centre"

    @property
    def direction(self) -> Number | None:
        """Toward the centre."""
        return self.toward

    @cached_property
    def centres(self) -> tuple[JointCentre, ...]:
        """As given."""
        if self.at is not None:
            return (CentreAt(self.at),)
        assert self.toward is not None
        return (CentreToward(self.toward),)

    @property
    def stands_in(self) -> bool:
        """For all between its links."""
        return True


class _Weld(NamedTuple):
    links: tuple[str, str]
    at: str | None = None


class Weld(_Weld, JointKind):
    """Two links that move as one; ``at`` serves only its reaction."""

    @cached_property
    def centres(self) -> tuple[JointCentre, ...]:
        """It leaves no freedom."""
        return ()

    @property
    def carried(self) -> tuple[tuple[str, str], ...]:
        """Its point, of both links."""
        return tuple((link, self.at) for link in self.links) if self.at else ()


Joint = Pin | Slide | Slot | Roll | Gears | Belt | Contact | KnownCentre | Weld


def without_friction(joint: Joint) -> Joint:
    """The joint with smooth surfaces, and a smooth thread."""
    if isinstance(joint, Slide) and joint.thread is not None:
        joint = joint._replace(thread=joint.thread._replace(mu=None))
    return joint._replace(friction=None) if isinstance(joint, Pin | Slide | Slot | Contact) else joint


def with_friction(joint: Joint, own: Joint) -> Joint:
    """The joint with the friction of another of its kind."""
    if isinstance(joint, Slide) and isinstance(own, Slide):
        joint = joint._replace(thread=own.thread)
    return joint._replace(friction=own.friction) if isinstance(joint, Pin | Slide | Slot | Contact) else joint
