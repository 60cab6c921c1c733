"""What a drawing is made from: a known scene in a view, and the parts that each room of a drawing adds."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import NamedTuple

from icsolve.case import Case, Contact, Joint, KnownCentre, Pin, Roll, Slide, Slot, Spring, Weld
from icsolve.construction import Known
from icsolve.draw.marks import Box, Mark, Point
from icsolve.draw.place import Label, Soft
from icsolve.draw.view import View, along
from icsolve.draw.wheels import Round

PIN = 5.0
"""Radius of a pin."""
HALF = 6.5
"""Half the width of a bar."""
BLOCK = (32.0, 20.0)
"""A slider's block."""
RAIL = 58.0
"""How far a guide reaches to each side of its block."""
SLOT = 34.0
"""How far a slot reaches to each side of its pin."""


class Scene(NamedTuple):
    """A known scene in a view; ``at`` has its points in picture units.

    ``travel`` is how far a joint's place goes along its guide, back (negative) and forth along the guide's
    direction in the picture, by the guide's link and the joint's place: rails and rods reach so much farther.
    """

    known: Known
    view: View
    at: Mapping[str, Point]
    round: Round
    travel: Mapping[tuple[str, Point], tuple[float, float]] = MappingProxyType({})

    @property
    def case(self) -> Case:
        """The case."""
        return self.known.case

    def ends(self, link: str, place: Point, p: Point, u: Point, reach: float) -> tuple[Point, Point]:
        """The ends of a guide of a link along u about p, the picture of ``place``."""
        back, forth = self.travel.get((link, place), (0.0, 0.0))
        return along(p, u, back - reach), along(p, u, forth + reach)

    def joints(self) -> Iterable[Joint]:
        """The joints whose points can be placed."""
        return (joint for joint in self.case.joints if all(p in self.at for p in needs(joint)))


def needs(joint: Joint) -> tuple[str, ...]:
    """The points without which a joint can't be drawn."""
    match joint:
        case Pin() | Roll() | Contact():
            return (joint.at,)
        case Slide() | Slot():
            return (joint.at, *(joint.guide.ends or ()))
        case KnownCentre():
            return (joint.at,) if joint.at else ()
        case Weld():
            return (joint.at,) if joint.at else ()
    return ()


def fixed_springs(case: Case) -> list[Spring]:
    """The springs whose far end is held by the frame."""
    return [load for load in case.loads if isinstance(load, Spring) and load.against in (None, case.ground)]


class Part(NamedTuple):
    """What a room adds: marks, what labels had better not cover, what they must not, and labels."""

    marks: tuple[Mark, ...] = ()
    soft: tuple[Soft, ...] = ()
    solid: tuple[Box, ...] = ()
    labels: tuple[Label, ...] = ()


def together(parts: Iterable[Part]) -> Part:
    """Several parts as one, in order."""
    parts = list(parts)
    return Part(
        tuple(mark for part in parts for mark in part.marks),
        tuple(soft for part in parts for soft in part.soft),
        tuple(box for part in parts for box in part.solid),
        tuple(label for part in parts for label in part.labels),
    )


def around(p: Point, reach: float) -> Box:
    """A square about a point."""
    return (p[0] - reach, p[1] - reach, p[0] + reach, p[1] + reach)
