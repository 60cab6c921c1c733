"""What free bodies find, in the plane and in space, as frozen values in case units."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from types import MappingProxyType

from icsolve.tuples import NamedTuple, TypeVar

Parts = tuple[float | None, float | None, float | None]
"""Components along x, y and z; None for one that equilibrium leaves open."""


class Reaction(NamedTuple):
    """The force of link ``by`` on link ``on`` at a joint, with its couple about ``at``.

    A part that the joints leave open is None, and ``why`` says so. ``kind`` is the joint's;
    ``where`` the name of its point, '' where it has none. ``parts`` are shares by name:
    ``normal`` and ``friction``, ``tangential`` and ``separating``. ``magnitude`` is the size of the force,
    ``direction`` where it acts (degrees in [0, 360); None for no force), ``opposite`` that of its opposite.
    ``errors`` bounds the errors of these numbers by their names; empty where none is proven.
    """

    by: str
    on: str
    kind: str
    where: str
    at: tuple[float, float]
    x: float | None
    y: float | None
    moment: float | None
    why: str = ""
    parts: tuple[tuple[str, float], ...] = ()
    magnitude: float | None = None
    direction: float | None = None
    opposite: float | None = None
    errors: Mapping[str, float] = MappingProxyType({})

    @property
    def components(self) -> tuple[Parts, Parts]:
        """Force and couple along x, y and z."""
        return (self.x, self.y, 0.0), (0.0, 0.0, self.moment)

    @property
    def bounds(self) -> tuple[Parts, Parts] | None:
        """Of the errors of the components; None where none is proven."""
        x, y, moment = (self.errors.get(name) for name in ("x", "y", "moment"))
        return ((x, y, 0.0), (0.0, 0.0, moment)) if self.errors else None

    def reversed(self) -> Reaction:
        """The force of ``on`` on ``by``: equal and opposite."""
        x, y, moment = (None if v is None else 0.0 - v for v in (self.x, self.y, self.moment))
        turned = self._replace(by=self.on, on=self.by, x=x, y=y, moment=moment)
        return turned._replace(direction=self.opposite, opposite=self.direction)


class SpatialReaction(NamedTuple):
    """The force of link ``by`` on link ``on`` at a joint, with its couple about ``at``.

    ``force`` and ``couple`` are along x, y, z; a component that equilibrium leaves open is None, and ``why``
    says so. ``kind`` is the joint's, ``where`` the name of its point. ``parts`` are shares by name:
    ``radial``, ``thrust``, ``tangential``, ``separating``, ``axial`` (None where open). ``errors`` bounds the
    errors of the components of force and couple; empty where none is proven.
    """

    by: str
    on: str
    kind: str
    where: str
    at: tuple[float, float, float]
    force: Parts
    couple: Parts
    why: str = ""
    parts: tuple[tuple[str, float | None], ...] = ()
    errors: tuple[Parts, Parts] | None = None

    @property
    def components(self) -> tuple[Parts, Parts]:
        """Force and couple along x, y and z."""
        return self.force, self.couple

    @property
    def bounds(self) -> tuple[Parts, Parts] | None:
        """Of the errors of the components; None where none is proven."""
        return self.errors

    @property
    def magnitude(self) -> float | None:
        """Size of the force."""
        return _size(self.force)

    @property
    def moment(self) -> float | None:
        """Size of the couple."""
        return _size(self.couple)

    def reversed(self) -> SpatialReaction:
        """The force of ``on`` on ``by``: equal and opposite."""
        force, couple = _negative(self.force), _negative(self.couple)
        return self._replace(by=self.on, on=self.by, force=force, couple=couple)


def _size(parts: Parts) -> float | None:
    known = [part for part in parts if part is not None]
    return math.hypot(*known) if len(known) == 3 else None


def _negative(parts: Parts) -> Parts:
    x, y, z = (None if part is None else 0.0 - part for part in parts)
    return (x, y, z)


R = TypeVar("R", Reaction, SpatialReaction)


class ByJoint(dict[str, R]):
    """Reactions by name; ``F43`` finds the opposite of ``F34``."""

    def __missing__(self, name: str) -> R:
        for reaction in self.values():
            if name in names_of(reaction.on, reaction.by, reaction.where):
                return reaction.reversed()
        raise KeyError(name)

    def of_link(self, link: str) -> Iterator[tuple[str, R]]:
        """The reactions in the joints of a link, each as it acts on the link."""
        for name, one in self.items():
            if link in (one.by, one.on):
                yield name, one if one.on == link else one.reversed()


Reactions = ByJoint[Reaction]
SpatialReactions = ByJoint[SpatialReaction]


class Tension(NamedTuple):
    """The pull of a rope (case units), by the points that it runs through: ``T A-P-B``.

    ``tension`` is that of the first part; where the rope slips on a link, ``parts`` has that of every part,
    in order. It is None where equilibrium leaves it open, and ``why`` says so. ``error`` bounds its error;
    None where no bound is proven.
    """

    rope: str
    tension: float | None
    parts: tuple[float, ...] = ()
    why: str = ""
    error: float | None = None

    @property
    def name(self) -> str:
        """As reactions name it."""
        return f"T {self.rope}"


def names_of(by: str, on: str, where: str) -> tuple[str, ...]:
    """The names of a force between two links, the usual one first."""
    long = (f"F{by}-{on}", f"F{by}-{on}@{where}")
    return (f"F{by}{on}", *long) if len(by) == len(on) == 1 and (by + on).isdigit() else long


class Witness(NamedTuple):
    """An unknown load by power and by free bodies, in case units.

    ``bound`` is what rounding can make of their difference.
    """

    load: str
    power: float
    bodies: float
    difference: float
    bound: float


class Spatial(NamedTuple):
    """What a case in space has beyond its unknown loads, case units.

    ``residual`` is what is left of the equilibrium of any body, as a fraction of the largest term.
    """

    points: dict[str, tuple[float, float, float]]
    reactions: SpatialReactions
    witnesses: tuple[Witness, ...] = ()
    residual: float = 0.0


class Rubbing(NamedTuple):
    """Friction at one place: what it is, how far it is from its limit, and what it costs.

    ``joint`` is the joint's reaction by name, ``kind`` ``pin`` (a couple), ``slide``, ``slot`` or ``contact``
    (forces). ``value`` acts on the joint's second link, ccw or along the guide (the tangent);
    ``limit`` is the most that it can be there; ``rate`` the rubbing motion of the second link against
    the first; ``loss`` the power that it takes. ``radius`` is that of a pin's friction circle.
    """

    joint: str
    where: str
    kind: str
    value: float
    limit: float
    rate: float
    loss: float
    radius: float | None = None


class FrictionFound(NamedTuple):
    """How friction was solved.

    ``rubbing`` has every place that rubs (empty where a range was found, as there nothing moves yet);
    ``residual`` is what is left of the equilibrium of any link, as a fraction of the largest term;
    ``error`` bounds the relative error of the friction forces from the iteration (None: nothing bounds it);
    ``unique`` says how
    it is known that there is no other solution, '' where that is not known. At rest ``possible`` has
    the range of the unknown load in which friction within its limits can hold, ``unique`` says how
    it was found, and ``again`` has the ranges beyond it in which it may hold again, ``grown`` the parts of
    these and of it, beside the range that is told, that hold however friction was left (None: ``again``, as
    far as is known); ``shared`` is whether equilibrium leaves open how joints that rub share the load.
    """

    rubbing: tuple[Rubbing, ...]
    residual: float
    error: float | None
    unique: str
    losses: float = 0.0
    efficiency: float | None = None
    possible: tuple[float, float] | None = None
    again: tuple[tuple[float, float], ...] = ()
    grown: tuple[tuple[float, float], ...] | None = None
    shared: bool = False


# --- contacts by profiles -------------------------------------------------------------------------------


class Touching(NamedTuple):
    """Where two links touch: the point, and the normal in degrees from the first link into the second.

    ``on`` says which part of the profile; ``pressure_angle`` is in degrees, None where the follower is not
    guided by the frame; ``note`` is a sentence about what an interpolated profile leaves open. ``force`` is
    the normal force, None where it is not determined; the contact is ``lost`` where it would have to pull.
    """

    links: tuple[str, str]
    at: tuple[float, float]
    normal: float
    on: str
    pressure_angle: float | None
    note: str = ""
    force: float | None = None
    lost: bool = False
