"""What is more than joints between links: their masses, the ropes that run over them, driven screws."""

from __future__ import annotations

from icsolve.case.joints import Guided, Thread
from icsolve.numbers.units import Number
from icsolve.tuples import NamedTuple


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
