"""What statics in space finds, as frozen values in case units."""

from __future__ import annotations

import math

from icsolve.answer.bodies import Witness, names_of
from icsolve.tuples import NamedTuple

Parts = tuple[float | None, float | None, float | None]


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


class SpatialReactions(dict[str, SpatialReaction]):
    """Reactions by name; ``F43`` finds the opposite of ``F34``."""

    def __missing__(self, name: str) -> SpatialReaction:
        for reaction in self.values():
            if name in names_of(reaction.on, reaction.by, reaction.where):
                return reaction.reversed()
        raise KeyError(name)


class Spatial(NamedTuple):
    """What a case in space has beyond its unknown loads, case units.

    ``residual`` is what is left of the equilibrium of any body, as a fraction of the largest term.
    """

    points: dict[str, tuple[float, float, float]]
    reactions: SpatialReactions
    witnesses: tuple[Witness, ...] = ()
    residual: float = 0.0


__all__ = ["Parts", "Spatial", "SpatialReaction", "SpatialReactions", "Witness"]
