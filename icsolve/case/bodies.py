"""What makes a link more than its joints: its mass; and the ropes that run over links."""

from typing import NamedTuple

from icsolve.numbers.given import Number


class Inertia(NamedTuple):
    """The mass of a link [kg], its centre of mass, and its moment of inertia about it [kg*m^2].

    Without a ``moment`` the mass counts as one point; without a ``mass`` the link is balanced about an axis
    that stands still.
    """

    mass: Number | None
    centre: str | None
    moment: Number | None = None


class Rope(NamedTuple):
    """A rope through ``points``, in order, each on the link of ``links`` at the same place.

    The first and the last are its ends, the others pulleys; where ``links`` has one less than ``points``,
    the last end is free and loads pull it. For each place ``radii`` has a pulley's (or drum's) radius,
    ``wraps`` the sense (``cw``, ``ccw``) in which one goes round it from the first end to the last, and
    ``mu`` the friction of a rope that slips there; None where there is none.
    """

    points: tuple[str, ...]
    links: tuple[str, ...]
    radii: tuple[Number | None, ...]
    wraps: tuple[str | None, ...]
    mu: tuple[Number | None, ...]
    length: Number | None = None

    @property
    def name(self) -> str:
        """Its points: ``A-P-B``."""
        return "-".join(self.points)

    @property
    def slips(self) -> bool:
        """Whether it rubs on anything that it goes round."""
        return any(mu is not None and mu.value > 0.0 for mu in self.mu)

    @property
    def end(self) -> str:
        """What stands for a link where loads pull the last end: no link of the case has such a name."""
        return f"@{self.name}"

    @property
    def is_free(self) -> bool:
        """Whether its last end is one that loads pull."""
        return len(self.links) < len(self.points)
